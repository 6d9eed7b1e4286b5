//! A response by the values of crossed parameters, or of parameters with words: one row for each combination.

use std::cmp::Ordering;

use occupant_study::sketch::Sketch;
use occupant_study::spread::Spread;

use super::{Finding, Input, Samples, caution};
use crate::base::shown::{given_with_unit, shown};
use occupant_pictures::html::{Cell, Html};

/// Largest number of rows of the table.
const MOST: usize = 24;

/// Values of a response by combination of the inputs' values.
#[derive(Clone, Debug, Default)]
pub struct Groups {
    /// The inputs.
    keys: Vec<usize>,
    /// What a new combination begins with.
    empty: Sketch,
    /// Values by combination; more than [`MOST`] are too many.
    all: Vec<(Vec<f64>, Sketch)>,
}

impl Groups {
    /// No values yet: by the crossed inputs, or by those with words.
    pub fn of(inputs: &[Input], empty: Sketch) -> Self {
        let crossed = inputs.iter().any(|input| input.crossed);
        let has_words = |input: &Input| !input.is_number() && (input.values.is_empty() || input.varies());
        let is_key = |i: &usize| if crossed { inputs[*i].crossed } else { has_words(&inputs[*i]) };
        Groups { keys: (0..inputs.len()).filter(is_key).collect(), empty, all: Vec::new() }
    }

    /// The values of a table.
    pub fn of_table(samples: &Samples, values: &[f64]) -> Self {
        let mut groups = Groups::of(&samples.inputs, Sketch::exact(&[]));
        values.iter().enumerate().for_each(|(row, value)| groups.see(|i| samples.inputs[i].values[row], *value));
        groups
    }

    /// Adds a value with its inputs.
    pub fn see(&mut self, input: impl Fn(usize) -> f64, value: f64) {
        let has_key = |known: &[f64]| self.keys.iter().zip(known).all(|(i, known)| input(*i) == *known);
        let at = self.all.iter().position(|(known, _)| has_key(known));
        match at {
            Some(at) => self.all[at].1.see(value),
            None if self.keys.is_empty() || self.all.len() > MOST => {}
            None => {
                let mut values = self.empty.clone();
                values.see(value);
                self.all.push((self.keys.iter().map(|i| input(*i)).collect(), values));
            }
        }
    }

    /// Values by combination, in the order of the inputs' values; none if there are too many combinations.
    fn sorted(&self) -> Option<Vec<&(Vec<f64>, Sketch)>> {
        let mut all: Vec<_> = self.all.iter().collect();
        all.sort_by(|a, b| a.0.partial_cmp(&b.0).unwrap_or(Ordering::Equal));
        (all.len() <= MOST).then_some(all)
    }

    /// Values by combination, described; none if there are too many combinations.
    pub fn named(&self, inputs: &[Input]) -> Option<Vec<(String, &Sketch)>> {
        let named = |(key, _): &'_ (Vec<f64>, Sketch)| {
            let of = self.keys.iter().map(|i| &inputs[*i]).zip(key);
            let words = of.map(|(input, value)| format!("{} = {}", input.name, word(input, *value)));
            words.collect::<Vec<_>>().join(", ")
        };
        Some(self.sorted()?.into_iter().map(|group| (named(group), &group.1)).collect())
    }
}

/// The table; empty without such a parameter, or with too many combinations.
pub fn table(html: &mut Html, of: &Finding<'_>) {
    let keys: Vec<&Input> = of.groups.keys.iter().map(|i| &of.samples.inputs[*i]).collect();
    let Some(groups) = of.groups.sorted().filter(|_| !keys.is_empty()) else { return };
    let names: Vec<&str> = keys.iter().map(|input| input.name.as_str()).collect();
    html.text("h3", &format!("By {}", names.join(" and ")));
    let row = |(key, values): &&(Vec<f64>, Sketch)| {
        let words = keys.iter().zip(key).map(|(input, value)| Cell::Words(word(input, *value)));
        let spread = Spread::of_sketch(values);
        let mark = caution::lacking(spread.as_ref());
        let numbers = spread.map_or([f64::NAN; 5], |s| [s.least, s.q05, s.median, s.q95, s.greatest]);
        let numbers = numbers.map(|x| Cell::of(shown(x, &of.response.unit), mark.clone()));
        words.chain([Cell::Number(spread.map_or(0, |s| s.members).to_string())]).chain(numbers).collect::<Vec<_>>()
    };
    let head = names.into_iter().chain(["samples", "least", "5 %", "median", "95 %", "greatest"]);
    html.table(&head.collect::<Vec<_>>(), &groups.iter().map(row).collect::<Vec<_>>());
}

/// A value as printed.
fn word(input: &Input, value: f64) -> String {
    let words = input.words.as_ref().and_then(|words| words.get(value as usize));
    words.cloned().unwrap_or_else(|| given_with_unit(value, &input.unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_gathered_by_every_combination() {
        let input = |values: &[f64]| Input { values: values.to_vec(), crossed: true, ..Input::default() };
        let inputs = vec![input(&[1.0, 0.0, 1.0, 0.0, 1.0]), input(&[0.0, 0.0, 1.0, 1.0, 0.0])];
        let samples = Samples { inputs, ..Samples::default() };
        let groups = Groups::of_table(&samples, &[1.0, 2.0, 3.0, 4.0, f64::NAN]);
        let found = groups.sorted().unwrap();
        let keys: Vec<&[f64]> = found.iter().map(|group| group.0.as_slice()).collect();
        assert_eq!(keys, [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]]);
        let counts = found.iter().map(|group| (group.1.len(), group.1.missing())).collect::<Vec<_>>();
        assert_eq!((counts, found[0].1.ends()), (vec![(1, 0), (1, 0), (1, 1), (1, 0)], Some([2.0; 2])));
        let many = Samples { inputs: vec![input(&(0..25).map(f64::from).collect::<Vec<_>>())], ..Samples::default() };
        assert!(Groups::of_table(&many, &[1.0; 25]).named(&many.inputs).is_none());
    }
}
