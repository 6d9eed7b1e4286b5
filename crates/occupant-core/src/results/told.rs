//! Events of force elements in a run, as plain numbers: texts are given by their indices.

use super::sample::Switched;
use crate::forces::{Forces, Listed, Visitor, visit_kinds};

/// Three numbers per event: indices of its kind, its element and its text.
pub(crate) fn to_indices(list: &[Switched]) -> Vec<u32> {
    let kinds = kinds();
    let number = |one: &Switched| {
        let (kind, (_, words)) = kinds.iter().enumerate().find(|(_, (of, _))| *of == one.of)?;
        let what = words.iter().position(|words| *words == one.what)?;
        Some([kind as u32, one.element as u32, what as u32])
    };
    list.iter().filter_map(number).flatten().collect()
}

/// From these numbers, with times, s; none if they are invalid.
pub(crate) fn from_indices(times_s: &[f64], indices: &[u32]) -> Option<Vec<Switched>> {
    let kinds = kinds();
    let (rows, rest) = indices.as_chunks();
    let event = |(&[kind, element, what], &time_s): (&[u32; 3], &f64)| {
        let (of, words) = kinds.get(kind as usize)?;
        let what = words.get(what as usize)?;
        Some(Switched { time_s, of, element: element as usize, what })
    };
    let fits = rest.is_empty() && rows.len() == times_s.len() && times_s.iter().all(|time_s| time_s.is_finite());
    rows.iter().zip(times_s).map(event).collect::<Option<_>>().filter(|_| fits)
}

/// Whether all belong to elements of `forces`.
pub(crate) fn fit(list: &[Switched], forces: &Forces<f64>) -> bool {
    let mut counts = Counts(forces, Vec::new());
    visit_kinds(&mut counts);
    list.iter().all(|one| counts.1.contains(&(one.of, one.element)))
}

struct Counts<'a>(&'a Forces<f64>, Vec<(&'static str, usize)>);

impl Visitor for Counts<'_> {
    fn visit<E: Listed>(&mut self) {
        let count = E::most_told(E::law(self.0));
        self.1.extend((0..count).map(|element| (E::NAMES[0], element)));
    }
}

/// Names of the kinds of elements, and their possible events at steps.
fn kinds() -> Vec<(&'static str, &'static [&'static str])> {
    let mut words = Words(Vec::new());
    visit_kinds(&mut words);
    words.0
}

struct Words(Vec<(&'static str, &'static [&'static str])>);

impl Visitor for Words {
    fn visit<E: Listed>(&mut self) {
        self.0.push((E::NAMES[0], E::BY_STEPS));
    }
}
