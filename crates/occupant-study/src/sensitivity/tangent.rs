//! A run in dual numbers, on the very steps that the plain run takes.

use super::built::{Built, dual_frames, dual_history, dual_state, dual_system};
use super::clock::{Clock, Jerk};
use super::events::Scene;
use super::trouble::Trouble;
use occupant_core::forces::{Actions, History};
use occupant_core::kernel::{Scratch, Situation, System};
use occupant_core::model::Model;
use occupant_core::model::setup::Integrator;
use occupant_core::motion::dual::Dual;
use occupant_core::motion::frame::Frames;
use occupant_core::motion::integrate::bogacki_shampine::{Stage, stages, within};
use occupant_core::motion::integrate::rk4;
use occupant_core::motion::state::State;
use occupant_core::run::Step;
use occupant_core::vehicle::PathCursor;

/// A run in progress with its derivatives in `N` directions, the last of which is the end time of the latest step.
pub(super) struct Tangent<'a, const N: usize> {
    model: &'a Model,
    built: &'a mut [Built],
    system: System<Dual<N>>,
    scratch: Scratch<Dual<N>>,
    /// State at an output, at a fixed time.
    pub state: State<Dual<N>>,
    pub history: History<Dual<N>>,
    cursor: PathCursor,
    front: Front<N>,
}

/// The latest step, at whose end the integration is. Under error control it is ahead of the outputs, as in the plain
/// run.
struct Front<const N: usize> {
    step: Step,
    /// Start and end time. The end is free until the next step begins.
    begun: Clock<N>,
    end: Clock<N>,
    from: State<Dual<N>>,
    to: State<Dual<N>>,
    /// Rates at `from` and `to`.
    rates: [State<Dual<N>>; 2],
    /// Whether the rate at `to` is that of the next step.
    rate_is_known: bool,
    /// For a fixed step: whether the history includes `to`.
    is_committed: bool,
    /// History at `from`; for a fixed step before `to` is included.
    before: History<Dual<N>>,
    /// History at `to`.
    after: History<Dual<N>>,
    /// Buffer for the history at the next step's end.
    spare: History<Dual<N>>,
}

impl<'a, const N: usize> Tangent<'a, N> {
    /// At the start of a run of `model`.
    ///
    /// # Errors
    /// Parameters of another model.
    pub fn new(model: &'a Model, built: &'a mut [Built]) -> Result<Self, Trouble> {
        let system = dual_system(model, built)?;
        let state = dual_state(model, built);
        let history = dual_history(model, &system, built);
        let time_s = model.setup().time.start_s;
        let front = Front {
            step: Step { start_s: time_s, end_s: time_s },
            begun: Clock::FIXED,
            end: Clock::FIXED,
            from: state,
            to: state,
            rates: [State::zero(state.shape()); 2],
            rate_is_known: false,
            is_committed: false,
            before: history.clone(),
            after: history.clone(),
            spare: history.clone(),
        };
        Ok(Tangent {
            state,
            history,
            scratch: Scratch::blank(&system),
            system,
            model,
            built,
            cursor: PathCursor::default(),
            front,
        })
    }

    /// Frames at `t_s`, a time that shifts with `clock`.
    fn frames(&mut self, t_s: f64, middle_s: f64, clock: &Clock<N>, jerk: &Jerk) -> Frames<Dual<N>> {
        let plain = self.model.frames(t_s, middle_s, &mut self.cursor);
        let mut frames = dual_frames(&plain, self.built, t_s, middle_s);
        clock.carry(&mut frames, jerk);
        frames
    }

    /// Rate of change of accelerations over a step.
    fn jerk(&mut self, step: Step, middle_s: f64) -> Jerk {
        let ends = [step.start_s, step.end_s].map(|t_s| self.model.frames(t_s, middle_s, &mut self.cursor));
        Jerk::between(&ends[0], &ends[1])
    }

    /// Includes an output's state in the history, as [`occupant_core::run::Run::record`] does.
    pub fn output(&mut self, time_s: f64, scene: &mut Scene<N>) {
        match self.model.setup().integrator {
            Integrator::Adaptive { .. } => {
                self.front.show(time_s, &mut self.state, &mut self.history);
                let frames = self.frames(time_s, time_s, &Clock::FIXED, &Jerk::NONE);
                self.look(time_s, &frames, scene);
            }
            Integrator::Rk4 { .. } => {
                let end = self.front.end;
                let frames = self.frames(time_s, time_s, &end, &Jerk::NONE);
                self.front.keep();
                self.state = self.front.to;
                self.history.take_over(&self.front.after);
                self.look(time_s, &frames, scene);
                // the step to come commits what the output has committed
                self.front.after.take_over(&self.history);
                Clock::FIXED.fix_state(&mut self.state);
                Clock::FIXED.fix_memory(&mut self.history.memory, &mut self.front.spare.memory);
            }
        }
    }

    /// Evaluates the shown state and commits it.
    fn look(&mut self, time_s: f64, frames: &Frames<Dual<N>>, scene: &mut Scene<N>) {
        scene.begin(time_s, &self.state);
        let Tangent { system, scratch, state, history, .. } = self;
        let (situation, mut k) = (Situation::accepted(state, frames), State::zero(state.shape()));
        rate(system, scratch, situation, history, Some(&mut scene.actions), &mut k);
    }

    /// Follows a step of the plain run; `stop_s` is the next break of the path, `scene` sees the start of the step.
    pub fn step(&mut self, step: Step, stop_s: f64, scene: &mut Scene<N>) {
        match self.model.setup().integrator {
            Integrator::Rk4 { .. } => self.rk4(step, scene),
            Integrator::Adaptive { .. } => self.embedded(step, stop_s, scene),
        }
    }

    /// Shift of the latest step's end: an event time, or a time known before the run.
    fn end(&self) -> Clock<N> {
        let now_s = self.front.step.end_s;
        let shift = |k: usize| self.built.get(k).map_or(0.0, |built| built.shift(now_s));
        if self.front.end == Clock::FIXED {
            return Clock::FIXED;
        }
        self.switch().unwrap_or_else(|| Clock(std::array::from_fn(shift)))
    }

    /// Time of a switch at the end of the latest step, if it can be differentiated.
    fn switch(&self) -> Option<Clock<N>> {
        let Front { step, begun, end, before, after, .. } = &self.front;
        let [from, to] = [before, after].map(|history| &history.memory);
        if !from.has_switched(to) {
            return None;
        }
        let times_s = [Dual::new(step.start_s, begun.0), Dual::new(step.end_s, end.0)];
        let due = from.due(to, &self.system.forces, times_s);
        Clock::of_level(&due.share).filter(|_| due.is_known)
    }

    fn rk4(&mut self, step: Step, scene: &mut Scene<N>) {
        let middle_s = 0.5 * (step.start_s + step.end_s);
        let jerk = self.jerk(step, middle_s);
        let end = self.front.end;
        let start = self.frames(step.start_s, middle_s, &end, &jerk);
        scene.begin(step.start_s, &self.front.to);
        self.front.keep();
        let Tangent { system, scratch, front, .. } = self;
        let Front { to, after, rates: [_, k], .. } = front;
        rate(system, scratch, Situation::accepted(to, &start), after, Some(&mut scene.actions), k);
        let begun = self.depart();
        let places = [(middle_s, 0.5), (step.end_s, 1.0)];
        let [middle, end] = places.map(|(t_s, s)| self.frames(t_s, middle_s, &begun.towards_end(s), &jerk));
        let Tangent { system, scratch, front, .. } = self;
        let h = begun.until(&Clock::free(), step.length_s());
        let (from, k1, history) = (front.to, front.rates[1], &mut front.after);
        front.to = rk4::step(&from, h, |stage, state, k| match stage {
            rk4::Stage::Start => *k = k1,
            rk4::Stage::Middle => rate(system, scratch, Situation::within(state, &middle), history, None, k),
            rk4::Stage::End => rate(system, scratch, Situation::within(state, &end), history, None, k),
        });
        (front.step, front.begun, front.end, front.is_committed) = (step, begun, Clock::free(), false);
    }

    /// Shifts the end of the latest step with the parameters; the next step begins there.
    fn depart(&mut self) -> Clock<N> {
        let begun = self.end();
        let Front { to, rates: [_, rate], after, spare, .. } = &mut self.front;
        begun.fix_state(to);
        begun.fix_state(rate);
        begun.fix_memory(&mut after.memory, &mut spare.memory);
        begun
    }

    /// Follows an accepted step of the adaptive run; `scene` sees its end.
    fn embedded(&mut self, step: Step, stop_s: f64, scene: &mut Scene<N>) {
        let t = step.start_s;
        let middle_s = 0.5 * (t + step.end_s);
        let begun = self.depart();
        let jerk = self.jerk(step, middle_s);
        let h = begun.until(&Clock::free(), step.length_s());
        let places = [(t, 0.0), (t + 0.5 * h.value, 0.5), (t + 0.75 * h.value, 0.75), (step.end_s, 1.0)];
        let frames = places.map(|(at_s, s)| self.frames(at_s, middle_s, &begun.towards_end(s), &jerk));
        let [start, half, late, end] = frames;
        let Tangent { system, scratch, front, .. } = self;
        if !front.rate_is_known {
            scene.begin(t, &front.to);
            let Front { to, after, rates: [_, k], .. } = front;
            rate(system, scratch, Situation::accepted(to, &start), after, Some(&mut scene.actions), k);
        }
        front.spare.take_over(&front.after);
        let (k1, history) = (front.rates[1], &mut front.spare);
        let (to, [.., k4]) = stages(&front.to, &k1, h, |stage, state, k| match stage {
            Stage::Within(0.5) => rate(system, scratch, Situation::within(state, &half), history, None, k),
            Stage::Within(_) => rate(system, scratch, Situation::within(state, &late), history, None, k),
            Stage::End => {
                scene.begin(step.end_s, state);
                rate(system, scratch, Situation::accepted(state, &end), history, Some(&mut scene.actions), k);
            }
        });
        (front.step, front.begun, front.end) = (step, begun, Clock::free());
        front.from = std::mem::replace(&mut front.to, to);
        front.rates = [k1, k4];
        front.rate_is_known = step.end_s < stop_s;
        std::mem::swap(&mut front.before, &mut front.after);
        std::mem::swap(&mut front.after, &mut front.spare);
    }

    /// The history after the latest step.
    pub fn latest(&self) -> &History<Dual<N>> {
        &self.front.after
    }
}

impl<const N: usize> Front<N> {
    /// Keeps the history from before the end of a fixed step.
    fn keep(&mut self) {
        if !self.is_committed {
            self.before.take_over(&self.after);
            self.is_committed = true;
        }
    }

    /// State and history at the fixed time `time_s` within the step; the history is that of the step's start.
    fn show(&self, time_s: f64, state: &mut State<Dual<N>>, history: &mut History<Dual<N>>) {
        let (mut to, [k1, mut k4]) = (self.to, self.rates);
        Clock::FIXED.fix_state(&mut to);
        Clock::FIXED.fix_state(&mut k4);
        *state = if time_s >= self.step.end_s {
            to
        } else {
            let h = self.begun.until(&Clock::FIXED, self.step.length_s());
            let s = self.begun.until(&Clock::FIXED, time_s - self.step.start_s) / h;
            within([&self.from, &k1], [&to, &k4], h, s)
        };
        history.take_over(&self.before);
    }
}

/// The rate, also written to `actions`. The kernel in dual numbers is large: this is its only instantiation.
#[inline(never)]
fn rate<const N: usize>(
    system: &System<Dual<N>>,
    scratch: &mut Scratch<Dual<N>>,
    situation: Situation<'_, Dual<N>>,
    history: &mut History<Dual<N>>,
    mut actions: Option<&mut Actions<Dual<N>>>,
    to: &mut State<Dual<N>>,
) {
    system.rate_with(scratch, situation, history, &mut actions, to);
}
