//! Whole steps from output to output.

use super::Course;
use super::corner::Touching;
use super::switch::Search;
use crate::forces::{Follow, History, Memory};
use crate::kernel::{Scratch, Situation};
use crate::model::Model;
use crate::motion::frame::Frames;
use crate::motion::integrate::bogacki_shampine::Stage;
use crate::motion::integrate::rk4::Stages;
use crate::motion::state::State;
use crate::results::outcome::StepError;
use crate::run::observers::{Felt, Met};
use crate::vehicle::PathCursor;

/// Largest number of parts of a step with switches, each up to its next switch.
const MOST_PARTS: u32 = 16;

/// Steps from one output to the next: all of one length except the last, which ends at the output.
#[derive(Clone, Copy, Debug)]
pub struct Stretch {
    from_s: f64,
    target_s: f64,
    step_s: f64,
    count: f64,
    done: f64,
}

/// One step.
#[derive(Clone, Copy, Debug, Default)]
pub struct Step {
    /// Start, s.
    pub start_s: f64,
    /// End, s.
    pub end_s: f64,
}

impl Stretch {
    /// Steps of `step_s`, the last one shortened to end at the target.
    pub(crate) fn new(from_s: f64, target_s: f64, step_s: f64) -> Self {
        Stretch { from_s, target_s, step_s, count: (((target_s - from_s) / step_s) - 1e-9).ceil().max(1.0), done: 0.0 }
    }
}

impl Stretch {
    /// Whether the last step is done.
    #[inline]
    pub(crate) fn is_over(&self) -> bool {
        self.done >= self.count
    }
}

impl Iterator for Stretch {
    type Item = Step;

    #[inline]
    fn next(&mut self) -> Option<Step> {
        let i = self.done;
        if self.is_over() {
            return None;
        }
        self.done = i + 1.0;
        // t_i = t_{i−1} + Δt (125), counted from the last output
        let end_s = if self.done < self.count { self.from_s + self.done * self.step_s } else { self.target_s };
        let start_s = self.from_s + i * self.step_s;
        Some(Step { start_s, end_s })
    }
}

/// Least part of a step. Only speeds of a run that has blown up ask for less, and it would never end.
const LEAST_PART: f64 = 1e-4;

impl Step {
    /// Length, s.
    #[inline]
    pub fn length_s(self) -> f64 {
        self.end_s - self.start_s
    }

    /// Start, middle and end, s.
    #[inline]
    pub(crate) fn times_s(self) -> [f64; 3] {
        [self.start_s, 0.5 * (self.start_s + self.end_s), self.end_s]
    }

    /// Time of a stage under error control, s.
    #[inline]
    pub(crate) fn at_s(self, stage: Stage) -> f64 {
        match stage {
            Stage::Within(part) => self.start_s + part * self.length_s(),
            Stage::End => self.end_s,
        }
    }

    /// Middle of it, or of an equal step before it, s.
    #[inline]
    pub(crate) fn middle_beside_s(self, is_before: bool) -> f64 {
        let half_s = 0.5 * self.length_s();
        self.start_s + if is_before { -half_s } else { half_s }
    }

    /// Frames at its middle and end, after those of its start.
    #[inline]
    pub(crate) fn move_frames(self, frames: &mut [Frames<f64>; 3], model: &Model, cursor: &mut PathCursor) {
        let times_s = self.times_s();
        for (frames, t_s) in frames.iter_mut().zip(times_s).skip(1) {
            model.move_frames(frames, t_s, times_s[1], cursor);
        }
    }

    /// Its first part, of the permitted length; usually all of it.
    #[inline]
    pub(crate) fn first_part(self, bears: impl FnOnce(f64) -> f64) -> Step {
        let whole_s = self.length_s();
        let (bears_s, least_s) = (bears(whole_s), LEAST_PART * whole_s);
        let length_s = if bears_s < least_s { least_s } else { bears_s };
        let end_s = self.start_s + length_s;
        // a rest that the clock can hardly tell is no step
        if length_s < whole_s && end_s < self.end_s - 1e-3 * length_s { Step { end_s, ..self } } else { self }
    }
}

/// Functions and buffers for fixed steps.
struct Stepper<'a> {
    model: &'a Model,
    scratch: Scratch<f64>,
    stages: Stages<f64>,
    frames: [Frames<f64>; 3],
}

impl<'a> Stepper<'a> {
    fn new(model: &'a Model, state: &State<f64>) -> Self {
        let (scratch, stages) = (Scratch::blank(model.system()), Stages::new(state.shape()));
        Stepper { model, scratch, stages, frames: [Frames::still(0.0); 3] }
    }

    /// Begins a step at the start of `rest`, with `history` updated there and contacts and readings in `met` and
    /// `felt`: all of it, or the part that near pairs permit.
    fn begin(
        &mut self,
        rest: Step,
        from: &State<f64>,
        (history, met, felt): (&mut History<f64>, &mut Vec<Touching>, &mut Felt),
        cursor: &mut PathCursor,
    ) -> Step {
        let Stepper { model, scratch, stages, frames } = self;
        let [start_s, middle_s, _] = rest.times_s();
        model.move_frames(&mut frames[0], start_s, middle_s, cursor);
        let (system, mut met) = (model.system(), Follow(Met::anew(met, felt)));
        stages.begin(from, |_, state, rate| {
            let situation = Situation::accepted(state, &frames[0]);
            system.rate_alone(scratch, situation, history, &mut Some(&mut met), rate);
        });
        system.read(scratch, &frames[0], &mut |of, reading| felt.readings[of] = *reading);
        rest.first_part(|h| history.step(h))
    }

    /// State after the rest of `step`.
    fn go(&mut self, step: Step, from: &State<f64>, history: &mut History<f64>, cursor: &mut PathCursor) -> State<f64> {
        let Stepper { model, scratch, stages, frames, .. } = self;
        step.move_frames(frames, model, cursor);
        *stages.go(from, step.length_s(), |stage, state, rate| {
            let situation = Situation::within(state, &frames[stage as usize]);
            model.system().rate_alone(scratch, situation, history, &mut None::<&mut Follow<Met<'_>>>, rate);
        })
    }

    /// Updates `history` with a state at the end of a step.
    fn commit(&mut self, time_s: f64, state: &State<f64>, history: &mut History<f64>, cursor: &mut PathCursor) {
        let frames = &mut self.frames[0];
        self.model.move_frames(frames, time_s, time_s, cursor);
        let (situation, mut rate) = (Situation::accepted(state, frames), State::zero(state.shape()));
        self.model.system().rate_alone(
            &mut self.scratch,
            situation,
            history,
            &mut None::<&mut Follow<Met<'_>>>,
            &mut rate,
        );
    }
}

impl Course {
    /// The rest of a step, if any, and all steps of `stretch`.
    pub(crate) fn advance_rk4(&mut self, model: &Model, left: Option<Step>, stretch: Stretch) -> Result<(), StepError> {
        let stepper = &mut Stepper::new(model, &self.state);
        for whole in left.into_iter().chain(stretch) {
            let mut rest = whole;
            while rest.start_s < whole.end_s {
                rest.start_s = self.step_rk4(stepper, rest)?;
            }
        }
        // who follows the steps must not see one that is taken back later
        if self.taken.is_some() { self.look_back(stepper) } else { Ok(()) }
    }

    /// A step of the length of `rest`, or of the part that near pairs permit; returns its end. It ends at its start if
    /// an element had switched within the step before: that step was repeated.
    fn step_rk4(&mut self, stepper: &mut Stepper<'_>, rest: Step) -> Result<f64, StepError> {
        if let Some(rear) = &mut self.rear {
            rear.keep(&self.history);
        }
        let step =
            stepper.begin(rest, &self.state, (&mut self.history, &mut self.met, &mut self.felt), &mut self.cursor);
        if let Some(latest) = self.take_back() {
            self.take_again(stepper, latest)?;
            return Ok(rest.start_s);
        }
        let next = stepper.go(step, &self.state, &mut self.history, &mut self.cursor);
        self.effort.evaluations += 4;
        self.note_by_own(stepper.model, step.start_s);
        if let Some(rear) = &mut self.rear {
            let (forces, now) = (&stepper.model.system().forces, &self.history.memory);
            self.switches.note(forces, step.start_s, rear.kept(), now);
            rear.is_at(step, &self.state);
        }
        self.accept(stepper.model, next, step)?;
        Ok(step.end_s)
    }

    /// Repeats the latest step if an element switched within it.
    fn look_back(&mut self, stepper: &mut Stepper<'_>) -> Result<(), StepError> {
        let Some(rear) = self.rear.as_mut().filter(|rear| rear.step.is_some()) else { return Ok(()) };
        rear.keep(&self.history);
        stepper.commit(self.time_s, &self.state, &mut self.history, &mut self.cursor);
        match self.take_back() {
            Some(latest) => self.take_again(stepper, latest),
            None => {
                if let Some(rear) = &mut self.rear {
                    rear.step = None;
                    self.history.take_over(&rear.spare);
                }
                Ok(())
            }
        }
    }

    /// Goes back to the start of the latest step if the commit at its end, just done, shows a switch within it.
    pub(super) fn take_back(&mut self) -> Option<Step> {
        let rear = self.rear.as_mut()?;
        let has_switched = rear.step.is_some() && rear.spare.memory.has_switched(&self.history.memory);
        let latest = has_switched.then(|| rear.step.take()).flatten()?;
        self.state = rear.state;
        self.history.take_over(&rear.history);
        Some(latest)
    }

    /// The same for a run whose state and history, set by the caller, are those before the commit at the start of
    /// `latest`.
    #[cfg(any(target_arch = "x86_64", test))]
    pub(super) fn go_back(&mut self, model: &Model, latest: Step) -> Result<(), StepError> {
        let stepper = &mut Stepper::new(model, &self.state);
        self.take_again(stepper, latest)
    }

    /// Repeats the latest step if the commit of an output, just done, shows a switch within it; returns whether it did.
    pub(super) fn take_back_from_output(&mut self, model: &Model) -> bool {
        let Some(rear) = &self.rear else { return false };
        let kept = rear.step.is_some().then(|| (self.state, rear.spare.clone(), self.time_s));
        let Some((latest, (state, history, time_s))) = self.take_back().zip(kept) else { return false };
        let stepper = &mut Stepper::new(model, &self.state);
        if self.take_again(stepper, latest).is_err() {
            // the parts of a step that led to numbers do not: it stays whole
            (self.state, self.history, self.time_s) = (state, history, time_s);
        }
        true
    }

    /// Repeats `step` from its start, in parts that end at switches.
    fn take_again(&mut self, stepper: &mut Stepper<'_>, step: Step) -> Result<(), StepError> {
        let Some(mut rear) = self.rear.take() else { return Ok(()) };
        self.effort.steps -= 1;
        if let Some(taken) = &mut self.taken {
            taken.pop();
        }
        let (mut start_s, mut parts, mut last_s) = (step.start_s, 0, step.length_s());
        let mut done = Ok(());
        while done.is_ok() && start_s < step.end_s {
            let (part, next) = self.part(stepper, &mut rear, Step { start_s, ..step }, parts < MOST_PARTS, last_s);
            let (forces, before) = (&stepper.model.system().forces, &self.history.memory);
            self.switches.note(forces, start_s, before, &rear.history.memory);
            self.history.take_over(&rear.history);
            self.note_by_own(stepper.model, start_s);
            done = self.accept(stepper.model, next, part);
            (start_s, parts, last_s) = (part.end_s, parts + 1, part.length_s());
        }
        self.rear = Some(rear);
        done
    }

    /// First part of `step` up to a switch, and the state at its end; `rear` gets the history of its start.
    fn part(
        &mut self,
        stepper: &mut Stepper<'_>,
        rear: &mut Rear,
        step: Step,
        looks: bool,
        last_s: f64,
    ) -> (Step, State<f64>) {
        let (mut part, forces) = (step, &stepper.model.system().forces);
        rear.search.rest();
        loop {
            rear.history.take_over(&self.history);
            part =
                stepper.begin(part, &self.state, (&mut rear.history, &mut self.met, &mut self.felt), &mut self.cursor);
            let next = stepper.go(part, &self.state, &mut rear.history, &mut self.cursor);
            self.effort.evaluations += 4;
            if !looks || !next.is_finite() {
                return (part, next);
            }
            rear.spare.take_over(&rear.history);
            stepper.commit(part.end_s, &next, &mut rear.spare, &mut self.cursor);
            self.effort.evaluations += 1;
            let memory = [&rear.history.memory, &rear.spare.memory];
            let Some(end_s) = rear.search.end_earlier(forces, part, memory, last_s) else { return (part, next) };
            self.effort.rejected += 1;
            part.end_s = end_s;
        }
    }

    /// Notes contacts and readings at the start of an accepted step, after the history's update.
    fn note_by_own(&mut self, model: &Model, time_s: f64) {
        let past = &self.history.memory.contacts;
        self.seen.see(model, time_s, &self.met, &self.felt, |pair| past[pair].phase);
    }

    /// The same, with the memory of pairs given by `phase`.
    #[cfg(any(target_arch = "x86_64", test))]
    pub(super) fn note(&mut self, model: &Model, time_s: f64, phase: impl Fn(usize) -> f64) {
        self.seen.see(model, time_s, &self.met, &self.felt, phase);
    }
}

/// Start of the latest step of fixed length, to go back to.
///
///
/// The result of a step is committed with the first evaluation of the next one, or with an output. Only then are
/// switches within it known.
#[derive(Clone, Debug)]
pub(super) struct Rear {
    /// The latest step; none if there is none to go back to.
    pub(super) step: Option<Step>,
    /// State at its start; the history is that before the commit there.
    pub(super) state: State<f64>,
    pub(super) history: History<f64>,
    /// History before the present commit.
    spare: History<f64>,
    search: Search,
}

impl Rear {
    /// For a run at `state`.
    pub(super) fn new(state: &State<f64>, history: &History<f64>) -> Self {
        let search = Search::new(&history.memory);
        Rear { step: None, state: *state, history: history.clone(), spare: history.clone(), search }
    }

    /// Sets `step`, from `state` on, as the latest; the spare history is that before its first commit.
    fn is_at(&mut self, step: Step, state: &State<f64>) {
        (self.step, self.state) = (Some(step), *state);
        std::mem::swap(&mut self.history, &mut self.spare);
    }

    /// Keeps the history before a commit.
    pub(super) fn keep(&mut self, history: &History<f64>) {
        self.spare.take_over(history);
    }

    /// Keeps the memory before and after a commit, from lanes.
    #[cfg(any(target_arch = "x86_64", test))]
    pub(super) fn fetch<L>(&mut self, [before, now]: [&mut Memory<L>; 2], lane: impl Fn(&L) -> f64) {
        let mut fetch = |lanes: &mut L, x: &mut f64| *x = lane(lanes);
        before.each(&mut self.history.memory, &mut fetch);
        now.each(&mut self.spare.memory, &mut fetch);
    }

    /// Memory copied from lanes.
    #[cfg(any(target_arch = "x86_64", test))]
    pub(super) fn fetched(&self) -> [&Memory<f64>; 2] {
        [&self.history.memory, &self.spare.memory]
    }

    /// Memory kept.
    pub(super) fn kept(&self) -> &Memory<f64> {
        &self.spare.memory
    }

    /// Removes the step to go back to.
    pub(super) fn forget(&mut self) {
        self.step = None;
    }
}
