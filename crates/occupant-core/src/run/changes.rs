//! Events of force elements between accepted steps, from the numbers that they track there: webbing goes slack, a bag
//! is touched. They do not depend on the output interval.

use super::switch::ROOM;
use crate::forces::shown::Reported;
use crate::forces::{Listed, Visitor, visit_kinds};
use crate::model::Model;
use crate::results::sample::Switched;

/// Compares the tracked values of each accepted step with those of the step before.
#[derive(Clone)]
pub(super) struct Changes {
    kinds: Vec<OfKind>,
    /// Values of the step before; empty before the first.
    before: Vec<f64>,
    /// Events since it was last emptied.
    pub told: Vec<Switched>,
}

/// Reports events between the values of two steps.
type Told = fn(&[f64], &[f64], &mut dyn FnMut(&'static str));

/// Elements of a kind that reports events.
#[derive(Clone, Copy)]
struct OfKind {
    of: &'static str,
    /// Index of their first value, number of values of each, and number of elements.
    first: usize,
    each: usize,
    count: usize,
    told: Told,
}

impl Changes {
    /// Empty record for a run of `model`.
    pub(super) fn new(model: &Model) -> Self {
        let mut find = Find { model, first: 0, kinds: Vec::new() };
        visit_kinds(&mut find);
        let numbers = if find.kinds.is_empty() { 0 } else { find.first };
        Changes { kinds: find.kinds, before: Vec::with_capacity(numbers), told: Vec::with_capacity(ROOM) }
    }

    /// Takes the values of an accepted step; repeating the same values has no effect.
    pub(super) fn see(&mut self, time_s: f64, numbers: &[f64]) {
        for kind in &self.kinds {
            let range = kind.first..kind.first + kind.count * kind.each;
            let (Some(before), Some(now)) = (self.before.get(range.clone()), numbers.get(range)) else { break };
            for (element, (before, now)) in before.chunks(kind.each).zip(now.chunks(kind.each)).enumerate() {
                let told = &mut self.told;
                (kind.told)(before, now, &mut |what| told.push(Switched { time_s, of: kind.of, element, what }));
            }
        }
        if !self.kinds.is_empty() {
            self.before.clear();
            self.before.extend_from_slice(numbers);
        }
    }
}

struct Find<'a> {
    model: &'a Model,
    first: usize,
    kinds: Vec<OfKind>,
}

impl Visitor for Find<'_> {
    fn visit<E: Listed>(&mut self) {
        let (each, count) = (E::PEAKS.len(), E::most_actions(E::law(&self.model.system().forces)));
        if E::TELLS && count > 0 {
            let (of, first, told) = (E::NAMES[0], self.first, <E as Reported>::told);
            self.kinds.push(OfKind { of, first, each, count, told });
        }
        self.first += each * count;
    }
}
