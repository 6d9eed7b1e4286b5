//! A run in dual numbers, on the very steps that the plain run takes.

use super::built::{Built, dual_frames, dual_history, dual_state, dual_system};
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

/// A run in progress, with its derivatives in `N` directions.
pub(super) struct Tangent<'a, const N: usize> {
    model: &'a Model,
    built: &'a mut [Built],
    system: System<Dual<N>>,
    scratch: Scratch<Dual<N>>,
    pub state: State<Dual<N>>,
    pub history: History<Dual<N>>,
    cursor: PathCursor,
    /// The integration under error control, which runs ahead of the outputs.
    front: Front<N>,
}

/// The latest step under error control, as the plain run's front keeps it.
struct Front<const N: usize> {
    step: Step,
    from: State<Dual<N>>,
    to: State<Dual<N>>,
    /// Rates at `from` and `to`.
    rates: [State<Dual<N>>; 2],
    /// Whether the rate at `to` is that of the step to come.
    rate_is_known: bool,
    /// History at `from`.
    before: History<Dual<N>>,
    /// History at `to`.
    after: History<Dual<N>>,
    /// Room for the history of the next step's end.
    spare: History<Dual<N>>,
}

impl<'a, const N: usize> Tangent<'a, N> {
    /// At the start of a run of `model`.
    pub fn new(model: &'a Model, built: &'a mut [Built]) -> Result<Self, Trouble> {
        let system = dual_system(model, built)?;
        let state = dual_state(model, built);
        let history = dual_history(model, &system, built);
        let time_s = model.setup().time.start_s;
        let front = Front {
            step: Step { start_s: time_s, end_s: time_s },
            from: state,
            to: state,
            rates: [State::zero(state.shape()); 2],
            rate_is_known: false,
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

    fn frames(&mut self, t_s: f64, middle_s: f64) -> Frames<Dual<N>> {
        let plain = self.model.frames(t_s, middle_s, &mut self.cursor);
        dual_frames(&plain, self.built, t_s, middle_s)
    }

    /// Takes an output's position over into the history, as [`occupant_core::run::Run::record`] does.
    pub fn output(&mut self, time_s: f64, scene: &mut Scene<N>) {
        if let Integrator::Adaptive { .. } = self.model.setup().integrator {
            self.front.show(time_s, &mut self.state, &mut self.history);
        }
        let frames = self.frames(time_s, time_s);
        scene.begin(time_s, &self.state);
        let Tangent { system, scratch, state, history, .. } = self;
        let (situation, mut k) = (Situation::accepted(state, &frames), State::zero(state.shape()));
        rate(system, scratch, situation, history, Some(&mut scene.actions), &mut k);
    }

    /// A step that the plain run has taken; `stop_s` is the next break of the path, `scene` sees where it began.
    pub fn step(&mut self, step: Step, stop_s: f64, scene: &mut Scene<N>) {
        match self.model.setup().integrator {
            Integrator::Rk4 { .. } => self.rk4(step, scene),
            Integrator::Adaptive { .. } => self.embedded(step, stop_s, scene),
        }
    }

    fn rk4(&mut self, step: Step, scene: &mut Scene<N>) {
        let middle_s = 0.5 * (step.start_s + step.end_s);
        let [start, middle, end] = [step.start_s, middle_s, step.end_s].map(|t| self.frames(t, middle_s));
        let Tangent { system, scratch, history, .. } = self;
        let h = Dual::new(step.length_s(), [0.0; N]);
        scene.begin(step.start_s, &self.state);
        self.state = rk4::step(&self.state, h, |stage, state, k| match stage {
            rk4::Stage::Start => {
                rate(system, scratch, Situation::accepted(state, &start), history, Some(&mut scene.actions), k);
            }
            rk4::Stage::Middle => rate(system, scratch, Situation::within(state, &middle), history, None, k),
            rk4::Stage::End => rate(system, scratch, Situation::within(state, &end), history, None, k),
        });
    }

    /// As the adaptive run takes an accepted step; `scene` sees where it ended.
    fn embedded(&mut self, step: Step, stop_s: f64, scene: &mut Scene<N>) {
        let (t, h) = (step.start_s, step.length_s());
        let middle_s = 0.5 * (t + step.end_s);
        let places = [t, t + 0.5 * h, t + 0.75 * h, step.end_s];
        let [start, half, late, end] = places.map(|at_s| self.frames(at_s, middle_s));
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
        front.step = step;
        front.from = std::mem::replace(&mut front.to, to);
        front.rates = [k1, k4];
        front.rate_is_known = step.end_s < stop_s;
        std::mem::swap(&mut front.before, &mut front.after);
        std::mem::swap(&mut front.after, &mut front.spare);
    }

    /// The history after the latest step.
    pub fn latest(&self) -> &History<Dual<N>> {
        match self.model.setup().integrator {
            Integrator::Rk4 { .. } => &self.history,
            Integrator::Adaptive { .. } => &self.front.after,
        }
    }
}

impl<const N: usize> Front<N> {
    /// State and history at `time_s` within the step; the history is that of the step's start.
    fn show(&self, time_s: f64, state: &mut State<Dual<N>>, history: &mut History<Dual<N>>) {
        let h = self.step.length_s();
        *state = if time_s >= self.step.end_s {
            self.to
        } else {
            let s = (time_s - self.step.start_s) / h;
            let [k1, k4] = &self.rates;
            within([&self.from, k1], [&self.to, k4], h, s)
        };
        history.take_over(&self.before);
    }
}

/// The rate, which `actions` shows: the kernel in duals is large, and this is the only copy of it.
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
