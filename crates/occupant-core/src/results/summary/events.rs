//! Events of force elements in a run: spools lock, webbing leaves a node.

use std::borrow::Cow;

use serde::Serialize;

use crate::forces::shown::Reported;
use crate::forces::{Actions, Listed, Visitor, visit_kinds};
use crate::model::Model;
use crate::results::sample::Sample;

/// Largest number of listed events; more are counted only.
const MOST: usize = 100;

/// Event of a force element.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Event {
    /// End of the step in which it occurs, s; for events seen at outputs only, the first output after it.
    pub time_s: f64,
    /// Name of the element.
    pub name: String,
    /// What it did, in words that follow its name.
    pub what: Cow<'static, str>,
}

/// Events so far, of the kinds that report them. Allocates at the start of a run only.
#[derive(Clone, Debug, Default)]
pub(super) struct Events {
    /// Actions at the output before.
    before: Option<Actions<f64>>,
    /// Of each that has events a name, and what follows the words.
    names: Vec<[String; 2]>,
    seen: Seen,
}

/// First events, and the number of further ones.
#[derive(Clone, Debug, Default)]
struct Seen {
    /// Time, index of the name, text.
    first: Vec<(f64, usize, &'static str)>,
    more: u64,
}

impl Seen {
    fn note(&mut self, time_s: f64, name: usize, what: &'static str) {
        // what switches at an output is seen there, and told with the next
        if self.first.contains(&(time_s, name, what)) {
            return;
        }
        if self.first.len() < MOST {
            self.first.push((time_s, name, what));
        } else {
            self.more += 1;
        }
    }
}

impl Events {
    /// No events yet.
    pub(super) fn new(model: &Model) -> Self {
        let mut names = Names(model, Vec::new());
        visit_kinds(&mut names);
        let before = (!names.1.is_empty()).then(|| Actions::with_room(&model.system().forces));
        Events { before, names: names.1, seen: Seen { first: Vec::with_capacity(MOST), more: 0 } }
    }

    pub(super) fn see(&mut self, sample: &Sample<'_>) {
        let Some(before) = &mut self.before else { return };
        visit_kinds(&mut See { sample, before, first: 0, seen: &mut self.seen });
        before.take_over(sample.actions);
    }

    /// Number of events beyond the list.
    pub(super) fn more(&self) -> u64 {
        self.seen.more
    }

    /// First events, in order of time.
    pub(super) fn list(&self) -> Vec<Event> {
        let event = |(time_s, i, what): &(f64, usize, &'static str)| {
            let [name, rest] = &self.names[*i];
            let what = if rest.is_empty() { Cow::from(*what) } else { format!("{what} {rest}").into() };
            Event { time_s: *time_s, name: name.clone(), what }
        };
        let mut list: Vec<Event> = self.seen.first.iter().map(event).collect();
        list.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
        list
    }
}

struct Names<'a>(&'a Model, Vec<[String; 2]>);

impl Visitor for Names<'_> {
    fn visit<E: Listed>(&mut self) {
        let model = self.0;
        let data = E::data(&model.setup().forces(model.faces()));
        self.1.extend(E::tellers(data, E::law(&model.system().forces), model.body()));
    }
}

struct See<'s, 'a> {
    sample: &'s Sample<'a>,
    before: &'s Actions<f64>,
    /// Index of the kind's first name.
    first: usize,
    seen: &'s mut Seen,
}

impl Visitor for See<'_, '_> {
    fn visit<E: Listed>(&mut self) {
        let count = E::most_told(E::law(&self.sample.model.system().forces));
        let now = E::actions(self.sample.actions);
        for one in self.sample.switched.iter().filter(|one| one.of == E::NAMES[0]) {
            self.seen.note(one.time_s, self.first + one.element, one.what);
        }
        if !<E as Reported>::TELLS {
            self.first += count;
            return;
        }
        // files of 0.1.0 know no steps
        let is_told = |what| E::BY_STEPS.contains(&what) && !self.sample.step_peaks.are_unknown();
        for (i, (before, now)) in E::actions(self.before).iter().zip(now).enumerate() {
            if let Some((what, _)) = E::event(before, now).filter(|(what, _)| !is_told(*what)) {
                self.seen.note(self.sample.time_s, self.first + i, what);
            }
        }
        self.first += now.len();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn events_beyond_the_list_are_counted() {
        let mut events = Events { names: vec![["strap".to_owned(), String::new()]], ..Events::default() };
        (0..MOST + 27).for_each(|i| events.seen.note(i as f64, 0, "goes slack"));
        assert_eq!((events.list().len(), events.more()), (MOST, 27));
        assert_eq!(events.list().last().unwrap().time_s, 99.0);
    }
}
