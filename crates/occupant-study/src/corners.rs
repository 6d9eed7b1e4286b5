//! The corners of a study: each parameter at its least and its largest value, alone and with all others.

use super::Study;
use super::law::{Law, Value};
use super::parameter::{Parameter, put};
use occupant_scenario::{Diagnostics, Draft};

/// Tail probability at which an unbounded distribution has its corner.
const TAIL: f64 = 1e-3;
/// Largest number of parameters for which every combination is a corner.
const MOST_COMBINED: usize = 6;

/// A corner.
#[derive(Clone, Debug, PartialEq)]
pub struct Corner {
    /// Indices and values of the parameters that differ from the base scenario.
    pub values: Vec<(usize, Value)>,
}

impl Study {
    /// The corners that keep the constraints: each parameter alone at its bounds, then all together; for a few parameters every
    /// combination.
    pub fn corners(&self) -> Vec<Corner> {
        let ends: Vec<(usize, [Value; 2])> =
            self.parameters.iter().enumerate().filter_map(|(i, of)| Some((i, ends(of)?))).collect();
        let alone = ends.iter().flat_map(|(i, ends)| ends.iter().map(|end| Corner { values: vec![(*i, end.clone())] }));
        let combinations: Vec<u32> = match ends.len() {
            0 | 1 => Vec::new(),
            few if few <= MOST_COMBINED => (0..1 << few).collect(),
            _ => vec![0, u32::MAX],
        };
        let combined = combinations.into_iter().map(|bits| {
            let end =
                |(at, (i, ends)): (usize, &(usize, [Value; 2]))| (*i, ends[(bits >> at.min(31) & 1) as usize].clone());
            Corner { values: ends.iter().enumerate().map(end).collect() }
        });
        alone.chain(combined).filter(|corner| self.keeps(corner)).collect()
    }

    fn keeps(&self, corner: &Corner) -> bool {
        let mut values: Vec<Value> = self.parameters.iter().map(Parameter::nominal).collect();
        corner.values.iter().for_each(|(i, value)| values[*i] = value.clone());
        self.broken(values.into_iter()).is_none()
    }

    /// The scenario of a corner.
    ///
    /// # Errors
    /// None for a study that has been bound to its base.
    pub fn draft_at(&self, corner: &Corner) -> Result<Draft, Diagnostics> {
        let (mut list, mut draft) = (Vec::new(), self.base.clone());
        for (i, value) in &corner.values {
            self.parameters[*i].assign(value, &mut list);
        }
        put(&list, &mut draft)?;
        Ok(draft)
    }
}

/// Least and largest value of a parameter; none for a parameter given by a table.
fn ends(of: &Parameter) -> Option<[Value; 2]> {
    match &of.law {
        Law::Table => None,
        Law::List(values) => {
            let number = |value: &Value| if let Value::Number(x) = value { *x } else { 0.0 };
            let mut sorted = values.clone();
            sorted.sort_by(|a, b| number(a).total_cmp(&number(b)));
            Some([sorted.first()?.clone(), sorted.last()?.clone()])
        }
        law => Some([0.0, 1.0].map(|p| law.bounded_quantile(p, TAIL))),
    }
}
