//! The integration under error control, which runs ahead of the outputs.
//!
//! It is at the end of its latest step. Outputs within that step are interpolated and change nothing: neither the
//! output interval nor the end of the run affects the motion.

use std::mem::swap;

use super::Step;
use super::adaptive::Pending;
use super::ahead::Ahead;
use super::corner::{Crossing, Touching};
use crate::forces::{Follow, History};
use crate::kernel::{Scratch, Situation};
use crate::model::Model;
use crate::motion::frame::Frames;
use crate::motion::integrate::bogacki_shampine::{Errors, Stage, Tolerance, within};
use crate::motion::state::State;
use crate::results::checkpoint::{StepStart, StepUnderWay};
use crate::run::observers::{Felt, Met, Seen};
use crate::run::switch::{Search, Switches};
use crate::vehicle::PathCursor;

/// Reasons to end a step early.
pub(super) struct Asks<'a> {
    /// Whether kinks are searched for.
    pub corners: bool,
    /// Whether an element has switched by the end of the trial. If not, and without a search, the memory is not needed.
    pub jumps: bool,
    pub tolerance: &'a Tolerance,
    pub last_s: f64,
}

/// The latest step of the integration, and its end.
#[derive(Clone)]
pub(super) struct Front {
    pub step: Step,
    /// Data of the steps. For a run side by side with others, it is that of the last request.
    pub ahead: Ahead<f64>,
    /// Step being tried, if any.
    pub pending: Option<Pending>,
    /// Whether the rate at the end of the step is that of the next step; not at the start, nor at a discontinuity of
    /// the path.
    rate_is_known: bool,
    /// Whether only the start of the step is known, as after a checkpoint.
    is_half_known: bool,
    /// Contacts at the end of the step.
    pub met: Vec<Touching>,
    /// Contacts at the end of a trial.
    pub met_in_trial: Vec<Touching>,
    /// Readings at the end of the step, and at the end of a trial.
    pub felt: Felt,
    pub felt_in_trial: Felt,
    /// Whether the end of the step has been noted.
    is_noted: bool,
    /// Search for switches, if any element can switch.
    search: Option<Search>,
    scratch: Scratch<f64>,
    frames: Frames<f64>,
}

impl Front {
    /// At `state`, before any step.
    pub(super) fn new(model: &Model, time_s: f64, state: &State<f64>, history: &History<f64>) -> Self {
        Front {
            step: Step { start_s: time_s, end_s: time_s },
            ahead: Ahead::new(state, history),
            pending: None,
            rate_is_known: false,
            is_half_known: false,
            met: Vec::with_capacity(history.memory.contacts.len()),
            met_in_trial: Vec::with_capacity(history.memory.contacts.len()),
            felt: Felt::new(model),
            felt_in_trial: Felt::new(model),
            is_noted: false,
            search: model.system().forces.can_switch().then(|| Search::new(&history.memory)),
            scratch: Scratch::blank(model.system()),
            frames: Frames::still(time_s),
        }
    }

    /// Within the step of a checkpoint, known by its start, at `state`.
    pub(super) fn within(model: &Model, start: &StepStart, state: &State<f64>) -> Self {
        let history = History::new(&model.system().forces, start.memory.clone());
        let mut front = Front::new(model, start.start_s, state, &history);
        front.step.end_s = start.end_s;
        front.is_half_known = true;
        front
    }

    /// Repeats a step known by its start only.
    pub(super) fn complete(
        &mut self,
        model: &Model,
        tolerance: &Tolerance,
        breaks_s: &[f64],
        (cursor, seen): (&mut PathCursor, &mut Seen),
    ) {
        if self.is_half_known {
            self.is_half_known = false;
            let step = self.step;
            let follows = step.start_s > model.setup().time.start_s && !breaks_s.contains(&step.start_s);
            self.look(model, step, follows, cursor);
            seen.compare(model, step.start_s, &self.met, &self.felt);
            self.attempt(model, step, tolerance, cursor);
            self.ahead.shift();
            self.accept(step, breaks_s.contains(&step.end_s));
        }
    }

    /// Whether the rate at the end of the step is still to be evaluated; the caller must do so.
    pub(super) fn must_look(&mut self) -> bool {
        !std::mem::replace(&mut self.rate_is_known, true)
    }

    /// Evaluates the rate at the start of `step`, which begins at the front, unless it is known; `follows`: it
    /// continues from the step before, without a discontinuity.
    pub(super) fn look(&mut self, model: &Model, step: Step, follows: bool, cursor: &mut PathCursor) {
        if !self.must_look() {
            return;
        }
        model.move_frames(&mut self.frames, step.start_s, step.middle_beside_s(follows), cursor);
        let (system, ahead) = (model.system(), &mut self.ahead);
        let situation = Situation::accepted(&ahead.to, &self.frames);
        let mut met = Follow(Met::anew(&mut self.met, &mut self.felt));
        let (history, rate) = (&mut ahead.after, &mut *ahead.rates[1]);
        system.rate_alone(&mut self.scratch, situation, history, &mut Some(&mut met), rate);
        ahead.note_commit();
        system.read(&self.scratch, &self.frames, &mut |of, reading| self.felt.readings[of] = *reading);
    }

    /// Tries `step`, which begins at the front.
    pub(super) fn attempt(
        &mut self,
        model: &Model,
        step: Step,
        tolerance: &Tolerance,
        cursor: &mut PathCursor,
    ) -> Errors<f64> {
        let (system, h) = (model.system(), step.length_s());
        let [_, middle_s, _] = step.times_s();
        self.ahead.begin_trial(&system.forces, h);
        let Ahead { to, rates, trial: history, room, .. } = &mut self.ahead;
        let Felt { numbers, readings } = &mut self.felt_in_trial;
        self.met_in_trial.clear();
        numbers.clear();
        let mut met = Follow(Met { met: &mut self.met_in_trial, numbers });
        let (scratch, frames) = (&mut self.scratch, &mut self.frames);
        let errors = room.attempt(to, &rates[1], h, tolerance, |stage, state, rate| {
            let accepted = stage == Stage::End;
            model.move_frames(frames, step.at_s(stage), middle_s, cursor);
            let situation = Situation { state, frames, accepted };
            system.rate_alone(scratch, situation, history, &mut accepted.then_some(&mut met), rate);
            if accepted {
                system.read(scratch, frames, &mut |of, reading| readings[of] = *reading);
            }
        });
        self.ahead.end_trial();
        errors
    }

    /// Accepts the tried `step` as the latest; `at_break`: the velocity of the vehicle may jump at its end.
    pub(super) fn accept(&mut self, step: Step, at_break: bool) {
        (self.step, self.is_noted) = (step, false);
        self.rate_is_known = !at_break;
        swap(&mut self.met, &mut self.met_in_trial);
        swap(&mut self.felt, &mut self.felt_in_trial);
    }

    /// Ends any search for switches until a trial shows one.
    pub(super) fn begin_step(&mut self) {
        if let Some(search) = &mut self.search {
            search.rest();
        }
    }

    /// Earlier end of the tried `step`, s: at a switch, or just behind its first relevant kink, whichever comes first;
    /// `last_s` is the length of the step before. All reasons to end a step early are listed here.
    pub(super) fn end_earlier(&mut self, model: &Model, step: Step, asks: &Asks<'_>) -> Option<f64> {
        let switch = |search: &mut Search| {
            let Ahead { after, trial, .. } = &self.ahead;
            search.end_earlier(&model.system().forces, step, [&after.memory, &trial.memory], asks.last_s)
        };
        let asked = self.search.as_mut().filter(|search| asks.jumps || search.is_under_way());
        let switch_s = asked.and_then(switch);
        let corner_s = asks.corners.then(|| self.end_behind_corner(model, step, asks.tolerance)).flatten();
        if corner_s.is_some_and(|corner| switch_s.is_none_or(|switch| corner < switch)) {
            self.begin_step();
        }
        switch_s.into_iter().chain(corner_s).reduce(f64::min)
    }

    /// Time just behind the first relevant kink of `step`, s.
    fn end_behind_corner(&self, model: &Model, step: Step, tolerance: &Tolerance) -> Option<f64> {
        let crossing = Crossing {
            model,
            step,
            at_start: &self.met,
            at_end: &self.met_in_trial,
            history: &self.ahead.after,
            tolerance,
        };
        crossing.end_behind_corner()
    }

    /// Whether an element has switched by the end of the last trial.
    pub(super) fn has_switched(&self) -> bool {
        self.can_switch() && self.ahead.after.memory.has_switched(&self.ahead.trial.memory)
    }

    /// Whether any element can switch.
    pub(super) fn can_switch(&self) -> bool {
        self.search.is_some()
    }

    /// Whether a search for a switch within the next step is in progress.
    #[cfg(any(target_arch = "x86_64", test))]
    pub(super) fn searches(&self) -> bool {
        self.search.as_ref().is_some_and(Search::is_under_way)
    }

    /// Elements that could not be computed within the last trial, as text.
    pub(super) fn failure(&self, model: &Model) -> Option<String> {
        self.ahead.trial.memory.failure(&model.setup().forces(&[]), &model.system().forces)
    }

    /// Notes contacts and readings at the end of the step, once, after all earlier outputs are recorded: an output
    /// there belongs to the step.
    pub(super) fn note(&mut self, model: &Model, seen: &mut Seen, switches: &mut Switches) {
        if self.must_note() {
            if self.can_switch() {
                let [before, now] = [&self.ahead.before.memory, &self.ahead.after.memory];
                switches.note(&model.system().forces, self.step.end_s, before, now);
            }
            let past = &self.ahead.after.memory.contacts;
            seen.see(model, self.step.end_s, &self.met, &self.felt, |pair| past[pair].phase);
        }
    }

    /// Whether the end of the step is still to be noted; the caller must do so.
    pub(super) fn must_note(&mut self) -> bool {
        // before the first step nothing was evaluated
        self.step.length_s() > 0.0 && !std::mem::replace(&mut self.is_noted, true)
    }

    /// State and history at `time_s` within the step; the history is that of the step's start, before its update with
    /// the present position.
    pub(super) fn show(&self, time_s: f64, state: &mut State<f64>, history: &mut History<f64>) {
        *state = self.state_at(time_s);
        history.take_over(&self.ahead.before);
    }

    /// State at `time_s` within the step.
    pub(super) fn state_at(&self, time_s: f64) -> State<f64> {
        let (h, Ahead { from, to, rates: [at_from, at_to], .. }) = (self.step.length_s(), &self.ahead);
        if time_s >= self.step.end_s {
            return **to;
        }
        within([from, at_from], [to, at_to], h, (time_s - self.step.start_s) / h)
    }

    /// Start of the step, if it continues beyond `time_s`.
    pub(super) fn under_way(&self, time_s: f64) -> Option<StepUnderWay<'_>> {
        let at = if self.is_half_known { &self.ahead.to } else { &self.ahead.from };
        (time_s < self.step.end_s).then_some(StepUnderWay {
            start_s: self.step.start_s,
            end_s: self.step.end_s,
            state: at,
            history: &self.ahead.before,
        })
    }
}
