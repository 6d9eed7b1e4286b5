//! Switches within a step: a spool locks, a vent opens, webbing leaves a node.
//!
//! Force elements change their memory only at commits. If it jumps, the step must end there; otherwise the jump is late
//! by up to the length of the step. A trial shows that something has switched, and the memory at both ends shows
//! roughly when; trials of other lengths approach that time. The step then ends just behind it, and its commit is the
//! switch.

use super::Step;
use crate::forces::{Forces, Listed, Memory, Visitor, visit_kinds};
use crate::results::sample::Switched;

/// Accuracy of the time of a switch, as a fraction of the step; also limited by [`CLOSEST_S`].
const CLOSE: f64 = 1e-3;
const CLOSEST_S: f64 = 1e-6;

/// Distance of a trial's end behind the expected switch, as a fraction of that accuracy.
const BEHIND: f64 = 0.3;

/// Largest number of trials of one search; bisection alone takes ten.
const MOST: u32 = 40;

/// End of a step with a switch, for callers that follow the steps.
#[derive(Clone, Debug)]
pub struct Jump {
    /// Time, s.
    pub time_s: f64,
    /// Memory of the force elements before and after; [`Memory::switched`] lists the switched elements.
    pub memory: [Memory<f64>; 2],
}

/// Switches of a run.
#[derive(Clone, Debug)]
pub(super) struct Switches {
    /// Since the last output.
    pub(super) told: Vec<Switched>,
    /// All since it was last emptied, if requested.
    pub(super) followed: Option<Vec<Jump>>,
}

impl Switches {
    pub(super) fn new() -> Self {
        Switches { told: Vec::with_capacity(ROOM), followed: None }
    }

    /// Notes the switches between two commits, the second at this time.
    pub(super) fn note(&mut self, forces: &Forces<f64>, time_s: f64, before: &Memory<f64>, now: &Memory<f64>) {
        if !before.has_switched(now) {
            return;
        }
        visit_kinds(&mut Telling { forces, time_s, before, now, told: &mut self.told });
        if let Some(list) = &mut self.followed {
            list.push(Jump { time_s, memory: [before.clone(), now.clone()] });
        }
    }
}

/// Number of events between two outputs with reserved space; more are recorded as well.
pub(super) const ROOM: usize = 64;

struct Telling<'a> {
    forces: &'a Forces<f64>,
    time_s: f64,
    before: &'a Memory<f64>,
    now: &'a Memory<f64>,
    told: &'a mut Vec<Switched>,
}

impl Visitor for Telling<'_> {
    fn visit<E: Listed>(&mut self) {
        let (time_s, of) = (self.time_s, E::NAMES[0]);
        let told = &mut *self.told;
        let show = &mut |element, what| told.push(Switched { time_s, of, element, what });
        E::switched(E::law(self.forces), E::past(self.before), E::past(self.now), show);
    }
}

/// Switches from the start to a commit.
#[derive(Clone, Debug)]
struct Seen {
    time_s: f64,
    memory: Memory<f64>,
}

/// Search for the first switch within a step.
#[derive(Clone, Debug)]
pub(super) struct Search {
    /// Longest trial without a switch, and shortest with one.
    before: Seen,
    behind: Seen,
    close_s: f64,
    trials: u32,
}

impl Search {
    /// No search; with space for a memory like `memory`.
    pub(super) fn new(memory: &Memory<f64>) -> Self {
        let seen = || Seen { time_s: 0.0, memory: memory.clone() };
        Search { before: seen(), behind: seen(), close_s: 0.0, trials: 0 }
    }

    /// Ends the search until a trial shows a switch.
    pub(super) fn rest(&mut self) {
        self.trials = 0;
    }

    /// Whether a search is in progress.
    pub(super) fn is_under_way(&self) -> bool {
        self.trials > 0
    }

    /// End of the step instead of `step.end_s`, s; none if it may end there. `memory` is that of both ends of the
    /// trial, `last_s` the length of the step before.
    pub(super) fn end_earlier(
        &mut self,
        forces: &Forces<f64>,
        step: Step,
        memory: [&Memory<f64>; 2],
        last_s: f64,
    ) -> Option<f64> {
        let [start, end] = memory;
        let switched = start.has_switched(end);
        if !self.is_under_way() {
            if !switched {
                return None;
            }
            let h = step.length_s();
            (self.before.time_s, self.close_s) = (step.start_s, (CLOSE * h).min(CLOSEST_S));
            self.before.memory.take_over(start);
        }
        let side = if switched { &mut self.behind } else { &mut self.before };
        side.time_s = step.end_s;
        side.memory.take_over(end);
        let is_first = self.trials == 0;
        self.trials += 1;

        let [low_s, high_s] = [self.before.time_s, self.behind.time_s];
        let due = self.before.memory.due(&self.behind.memory, forces, [low_s, high_s]);
        // what was due at the start of the step, or cannot tell, and follows another at once comes with the end of the step:
        // it might switch to and fro
        let may_come_late = !due.is_known || due.share <= 0.0;
        let comes_late = may_come_late && last_s <= 2.0 * CLOSE * step.length_s();
        let due_s = low_s + due.share.min(1.0) * (high_s - low_s);
        let found = high_s - low_s <= self.close_s || switched && high_s - due_s <= self.close_s;
        if is_first && comes_late || found || self.trials > MOST {
            return (!switched).then_some(high_s);
        }
        let halves = self.trials.is_multiple_of(4);
        let wanted_s = if halves { 0.5 * (low_s + high_s) } else { due_s + BEHIND * self.close_s };
        let least_s = low_s + BEHIND * self.close_s;
        let end_s = wanted_s.clamp(least_s, (high_s - BEHIND * self.close_s).max(least_s));
        if low_s < end_s && end_s < high_s { Some(end_s) } else { (!switched).then_some(high_s) }
    }
}
