//! A response by the values of crossed parameters, or of parameters with words: one row for each combination.

use std::cmp::Ordering;

use occupant_study::spread::Spread;

use super::{Finding, Input, Samples, caution};
use crate::base::shown::{given_with_unit, shown};
use occupant_pictures::html::{Cell, Html};

/// Largest number of rows of the table.
const MOST: usize = 24;

/// The table; empty without such a parameter, or with too many combinations.
pub fn table(html: &mut Html, of: &Finding<'_>) {
    let inputs = &of.samples.inputs;
    let crossed = inputs.iter().any(|input| input.crossed);
    let keys: Vec<&Input> = inputs
        .iter()
        .filter(|input| if crossed { input.crossed } else { !input.is_number() && input.varies() })
        .collect();
    let groups = groups(&keys, &of.response.values);
    if keys.is_empty() || groups.len() > MOST {
        return;
    }
    let names: Vec<&str> = keys.iter().map(|input| input.name.as_str()).collect();
    html.text("h3", &format!("By {}", names.join(" and ")));
    let row = |(key, values): &(Vec<f64>, Vec<f64>)| {
        let words = keys.iter().zip(key).map(|(input, value)| Cell::Words(word(input, *value)));
        let spread = Spread::of(values);
        let mark = caution::lacking(spread.as_ref());
        let numbers = spread.map_or([f64::NAN; 5], |s| [s.least, s.q05, s.median, s.q95, s.greatest]);
        let numbers = numbers.map(|x| Cell::of(shown(x, &of.response.unit), mark.clone()));
        words.chain([Cell::Number(spread.map_or(0, |s| s.members).to_string())]).chain(numbers).collect::<Vec<_>>()
    };
    let head = names.into_iter().chain(["samples", "least", "5 %", "median", "95 %", "greatest"]);
    html.table(&head.collect::<Vec<_>>(), &groups.iter().map(row).collect::<Vec<_>>());
}

/// Values of a response by combination of the crossed inputs, described; none with too many combinations.
pub fn crossed(samples: &Samples, values: &[f64]) -> Option<Vec<(String, Vec<f64>)>> {
    let keys: Vec<&Input> = samples.inputs.iter().filter(|input| input.crossed).collect();
    let groups = groups(&keys, values);
    let named = |(key, values): (Vec<f64>, Vec<f64>)| {
        let words = keys.iter().zip(&key).map(|(input, value)| format!("{} = {}", input.name, word(input, *value)));
        (words.collect::<Vec<_>>().join(", "), values)
    };
    (groups.len() <= MOST).then(|| groups.into_iter().map(named).collect())
}

/// Values of a response by combination of the inputs' values, in their order.
fn groups(keys: &[&Input], values: &[f64]) -> Vec<(Vec<f64>, Vec<f64>)> {
    let mut groups: Vec<(Vec<f64>, Vec<f64>)> = Vec::new();
    for (row, value) in values.iter().enumerate() {
        let key: Vec<f64> = keys.iter().map(|input| input.values[row]).collect();
        match groups.iter().position(|(known, _)| *known == key) {
            Some(at) => groups[at].1.push(*value),
            None if groups.len() > MOST => {}
            None => groups.push((key, vec![*value])),
        }
    }
    groups.sort_by(|a, b| a.0.partial_cmp(&b.0).unwrap_or(Ordering::Equal));
    groups
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
        let input = |values: &[f64]| Input { values: values.to_vec(), ..Input::default() };
        let (pulse, person) = (input(&[1.0, 0.0, 1.0, 0.0, 1.0]), input(&[0.0, 0.0, 1.0, 1.0, 0.0]));
        let found = groups(&[&pulse, &person], &[1.0, 2.0, 3.0, 4.0, f64::NAN]);
        let keys: Vec<&[f64]> = found.iter().map(|group| group.0.as_slice()).collect();
        assert_eq!(keys, [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]]);
        assert_eq!((found[0].1.as_slice(), found[2].1[0], found[2].1.len()), (&[2.0][..], 1.0, 2));
    }
}
