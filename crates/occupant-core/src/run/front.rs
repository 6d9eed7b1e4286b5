//! The integration under error control, which runs ahead of the outputs.
//!
//! It stands at the end of its latest step. Outputs within that step are read off its course and change nothing: how often
//! a run is recorded, and when it ends, makes no difference to its motion.

use std::mem::swap;

use super::Step;
use super::corner::{Crossing, Touching};
use crate::forces::{Follow, History};
use crate::kernel::{Scratch, Situation};
use crate::model::Model;
use crate::motion::frame::Frames;
use crate::motion::integrate::bogacki_shampine::{Stage, Tolerance, Trial, attempt, within};
use crate::motion::state::State;
use crate::results::checkpoint::{StepStart, StepUnderWay};
use crate::run::observers::{Felt, Met, Seen};
use crate::run::switch::{Search, Switches};
use crate::vehicle::PathCursor;

/// What may end a step early.
pub(super) struct Asks<'a> {
    /// Whether corners are looked for.
    pub corners: bool,
    pub tolerance: &'a Tolerance,
    pub last_s: f64,
}

/// The latest step of the integration, and where it stands.
#[derive(Clone)]
pub(super) struct Front {
    pub step: Step,
    from: State<f64>,
    to: State<f64>,
    /// Rates at `from` and `to`.
    rates: [State<f64>; 2],
    /// Whether the rate at `to` is that of the step to come; not at the start, nor at a break of the path.
    rate_is_known: bool,
    /// Whether the step is known by its start alone, as after a checkpoint.
    is_half_known: bool,
    /// History at `from`.
    before: History<f64>,
    /// History at `to`.
    after: History<f64>,
    /// History of a trial.
    trial: History<f64>,
    /// What touches at `to`.
    met: Vec<Touching>,
    /// What touches at the end of a trial.
    met_in_trial: Vec<Touching>,
    /// What is felt at `to`, and at the end of a trial.
    felt: Felt,
    felt_in_trial: Felt,
    /// Whether the end of the step was noted.
    is_noted: bool,
    /// For what switches, if anything can.
    search: Option<Search>,
    scratch: Scratch<f64>,
    frames: Frames<f64>,
}

impl Front {
    /// Standing at `state`, before any step.
    pub(super) fn new(model: &Model, time_s: f64, state: &State<f64>, history: &History<f64>) -> Self {
        Front {
            step: Step { start_s: time_s, end_s: time_s },
            from: *state,
            to: *state,
            rates: [State::zero(state.shape()); 2],
            rate_is_known: false,
            is_half_known: false,
            before: history.clone(),
            after: history.clone(),
            trial: history.clone(),
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

    /// Within the step that a checkpoint tells the start of, at `state`.
    pub(super) fn within(model: &Model, start: &StepStart, state: &State<f64>) -> Self {
        let history = History::new(&model.system().forces, start.memory.clone());
        let mut front = Front::new(model, start.start_s, state, &history);
        front.step.end_s = start.end_s;
        front.is_half_known = true;
        front
    }

    /// Takes the step again of which only the start is known.
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
            let trial = self.attempt(model, step, tolerance, cursor);
            self.take_over(trial, step, breaks_s.contains(&step.end_s));
        }
    }

    /// Evaluates the rate at the start of `step`, which begins where the front stands, unless it is known; `follows`: as the end of
    /// the step before, at no break.
    pub(super) fn look(&mut self, model: &Model, step: Step, follows: bool, cursor: &mut PathCursor) {
        if self.rate_is_known {
            return;
        }
        self.rate_is_known = true;
        let half_s = 0.5 * step.length_s();
        let middle_s = step.start_s + if follows { -half_s } else { half_s };
        model.move_frames(&mut self.frames, step.start_s, middle_s, cursor);
        let system = model.system();
        let situation = Situation::accepted(&self.to, &self.frames);
        let mut met = Follow(Met::anew(&mut self.met, &mut self.felt));
        system.rate_alone(&mut self.scratch, situation, &mut self.after, &mut Some(&mut met), &mut self.rates[1]);
        system.read(&self.scratch, &self.frames, &mut |of, reading| self.felt.readings[of] = *reading);
    }

    /// The part of `step`, which begins where the front stands, in which nothing is passed unseen: all of it, as a rule.
    pub(super) fn part_that_sees(&self, step: Step) -> Step {
        step.first_part(|h| self.after.step(h))
    }

    /// Tries `step`, which begins where the front stands.
    pub(super) fn attempt(
        &mut self,
        model: &Model,
        step: Step,
        tolerance: &Tolerance,
        cursor: &mut PathCursor,
    ) -> Trial {
        let (system, h) = (model.system(), step.length_s());
        let middle_s = 0.5 * (step.start_s + step.end_s);
        self.trial.take_over(&self.after);
        let Felt { numbers, readings } = &mut self.felt_in_trial;
        self.met_in_trial.clear();
        numbers.clear();
        let (history, mut met) = (&mut self.trial, Follow(Met { met: &mut self.met_in_trial, numbers }));
        let (scratch, frames) = (&mut self.scratch, &mut self.frames);
        attempt(&self.to, &self.rates[1], h, tolerance, |stage, state, rate| {
            let (time_s, accepted) = match stage {
                Stage::Within(s) => (step.start_s + s * h, false),
                Stage::End => (step.end_s, true),
            };
            model.move_frames(frames, time_s, middle_s, cursor);
            let situation = Situation { state, frames, accepted };
            system.rate_alone(scratch, situation, history, &mut accepted.then_some(&mut met), rate);
            if accepted {
                system.read(scratch, frames, &mut |of, reading| readings[of] = *reading);
            }
        })
    }

    /// Accepts `trial` of `step`; `at_break`: the velocity of the vehicle may jump at its end.
    pub(super) fn take_over(&mut self, trial: Trial, step: Step, at_break: bool) {
        (self.step, self.is_noted) = (step, false);
        self.from = self.to;
        self.to = trial.state;
        self.rates = [self.rates[1], trial.rate];
        self.rate_is_known = !at_break;
        swap(&mut self.before, &mut self.after);
        swap(&mut self.after, &mut self.trial);
        swap(&mut self.met, &mut self.met_in_trial);
        swap(&mut self.felt, &mut self.felt_in_trial);
    }

    /// Looks for no switch until a trial shows one.
    pub(super) fn begin_step(&mut self) {
        if let Some(search) = &mut self.search {
            search.rest();
        }
    }

    /// Where to end `step` instead, which was just tried: where something switches, or just behind its first corner that
    /// matters, whichever comes first, s; `last_s` is the length of the step before. All that ends a step early is listed here.
    pub(super) fn end_earlier(&mut self, model: &Model, step: Step, asks: &Asks<'_>) -> Option<f64> {
        let switch = |search: &mut Search| {
            search.end_earlier(&model.system().forces, step, [&self.after.memory, &self.trial.memory], asks.last_s)
        };
        let switch_s = self.search.as_mut().and_then(switch);
        let corner_s = asks.corners.then(|| self.end_behind_corner(model, step, asks.tolerance)).flatten();
        if corner_s.is_some_and(|corner| switch_s.is_none_or(|switch| corner < switch)) {
            self.begin_step();
        }
        switch_s.into_iter().chain(corner_s).reduce(f64::min)
    }

    /// Just behind the first corner of `step` that matters, s.
    fn end_behind_corner(&self, model: &Model, step: Step, tolerance: &Tolerance) -> Option<f64> {
        let crossing =
            Crossing { model, step, at_start: &self.met, at_end: &self.met_in_trial, history: &self.after, tolerance };
        crossing.end_behind_corner()
    }

    /// Whether something has switched by the end of the last trial.
    pub(super) fn has_switched(&self) -> bool {
        self.search.is_some() && self.after.memory.has_switched(&self.trial.memory)
    }

    /// What could not be worked out within the last trial, in words.
    pub(super) fn failure(&self, model: &Model) -> Option<String> {
        self.trial.memory.failure(&model.setup().forces(&[]), &model.system().forces)
    }

    /// Notes once what is felt and what touches at the end of the step, as all outputs before it are recorded: an output there
    /// belongs to the step.
    pub(super) fn note(&mut self, model: &Model, seen: &mut Seen, switches: &mut Switches) {
        // before the first step nothing was evaluated
        if self.step.length_s() > 0.0 && !self.is_noted {
            self.is_noted = true;
            if self.search.is_some() {
                let [before, now] = [&self.before.memory, &self.after.memory];
                switches.note(&model.system().forces, self.step.end_s, before, now);
            }
            let past = &self.after.memory.contacts;
            seen.see(model, self.step.end_s, &self.met, &self.felt, |pair| past[pair].phase);
        }
    }

    /// State and history at `time_s` within the step; the history is that of the step's start, into which the present
    /// position is not yet taken over.
    pub(super) fn show(&self, time_s: f64, state: &mut State<f64>, history: &mut History<f64>) {
        let h = self.step.length_s();
        *state = if time_s >= self.step.end_s {
            self.to
        } else {
            let s = (time_s - self.step.start_s) / h;
            within([&self.from, &self.rates[0]], [&self.to, &self.rates[1]], h, s)
        };
        history.take_over(&self.before);
    }

    /// The start of the step, if it goes on beyond `time_s`.
    pub(super) fn under_way(&self, time_s: f64) -> Option<StepUnderWay<'_>> {
        let at = if self.is_half_known { &self.to } else { &self.from };
        (time_s < self.step.end_s).then_some(StepUnderWay {
            start_s: self.step.start_s,
            end_s: self.step.end_s,
            state: at,
            history: &self.before,
        })
    }
}
