//! A run in dual numbers, on the very steps that the plain run takes.

use super::built::{Built, dual_frames, dual_history, dual_state, dual_system};
use super::events::Scene;
use super::trouble::Trouble;
use crate::integrate::dormand_prince;
use crate::integrate::rk4::{self, Stage};
use crate::kernel::dual::Dual;
use crate::kernel::state::State;
use crate::kernel::{Frames, History, System};
use crate::model::Model;
use crate::path::PathCursor;
use crate::run::Step;
use crate::setup::Integrator;

/// A run in progress, with its derivatives in `N` directions.
pub(super) struct Tangent<'a, const N: usize> {
    model: &'a Model,
    built: &'a mut [Built],
    system: System<Dual<N>>,
    pub state: State<Dual<N>>,
    pub history: History<Dual<N>>,
    cursor: PathCursor,
    /// The rate at the start of the next step, where the embedded pair knows it.
    first: Option<State<Dual<N>>>,
}

impl<'a, const N: usize> Tangent<'a, N> {
    /// At the start of a run of `model`.
    pub fn new(model: &'a Model, built: &'a mut [Built]) -> Result<Self, Trouble> {
        let system = dual_system(model, built)?;
        Ok(Tangent {
            state: dual_state(model, built),
            history: dual_history(model, &system, built),
            system,
            model,
            built,
            cursor: PathCursor::default(),
            first: None,
        })
    }

    fn frames(&mut self, t_s: f64, middle_s: f64) -> Frames<Dual<N>> {
        let plain = self.model.frames(t_s, middle_s, &mut self.cursor);
        dual_frames(&plain, self.built, t_s, middle_s)
    }

    /// Takes the present position over into the history; the rate there.
    fn commit(&mut self, frames: &Frames<Dual<N>>, scene: &mut Scene<N>) -> State<Dual<N>> {
        rate_at_start(&self.system, &self.state, frames, &mut self.history, scene)
    }

    /// Takes an output's position over into the history, as [`crate::run::Run::record`] does.
    pub fn output(&mut self, time_s: f64, scene: &mut Scene<N>) {
        let frames = self.frames(time_s, time_s);
        self.commit(&frames, scene);
        self.first = None;
    }

    /// The step that the plain run has taken on its way to the output at `target_s`; `scene` sees where it began.
    pub fn step(&mut self, step: Step, target_s: f64, stop_s: f64, scene: &mut Scene<N>) {
        match self.model.setup().integrator {
            Integrator::Rk4 { .. } => self.rk4(step, scene),
            Integrator::Adaptive { .. } => self.embedded(step, target_s, stop_s, scene),
        }
    }

    fn rk4(&mut self, step: Step, scene: &mut Scene<N>) {
        let middle_s = 0.5 * (step.start_s + step.end_s);
        let [start, middle, end] =
            [step.start_s, middle_s, step.end_s].map(|t| self.frames(t, middle_s));
        let (system, history) = (&self.system, &mut self.history);
        let h = Dual::new(step.length_s(), [0.0; N]);
        scene.begin(step.start_s, &self.state);
        self.state = rk4::step(&self.state, h, |stage, state| match stage {
            Stage::Start => rate_at_start(system, state, &start, history, scene),
            Stage::Middle => rate_within(system, state, &middle, history),
            Stage::End => rate_within(system, state, &end, history),
        });
    }

    /// As the adaptive run takes an accepted step; `stop_s` is the next break of the path.
    fn embedded(&mut self, step: Step, target_s: f64, stop_s: f64, scene: &mut Scene<N>) {
        let (t, end) = (step.start_s, step.end_s);
        let (h, middle) = (end - t, 0.5 * (t + end));
        let start = match self.first.take() {
            Some(rate) => rate,
            None => {
                let frames = self.frames(t, middle);
                scene.begin(t, &self.state);
                self.commit(&frames, scene)
            }
        };
        let state = self.state;
        let (next, rates) = dormand_prince::stages(&state, &start, h, |c, state| {
            let frames = self.frames(t + c * h, middle);
            rate_within(&self.system, state, &frames, &mut self.history)
        });
        self.state = next;
        if end < target_s {
            let frames = self.frames(end, middle);
            scene.begin(end, &self.state);
            self.commit(&frames, scene);
        }
        self.first = (end < stop_s).then_some(rates[6]);
    }
}

// The kernel in duals is large: these two are the only copies of it for each number of directions.

/// The rate at an accepted step, which the history takes over and `scene` sees.
#[inline(never)]
fn rate_at_start<const N: usize>(
    system: &System<Dual<N>>,
    state: &State<Dual<N>>,
    frames: &Frames<Dual<N>>,
    history: &mut History<Dual<N>>,
    scene: &mut Scene<N>,
) -> State<Dual<N>> {
    system.rate_observed::<true>(state, frames, history, scene)
}

/// The rate within a step.
#[inline(never)]
fn rate_within<const N: usize>(
    system: &System<Dual<N>>,
    state: &State<Dual<N>>,
    frames: &Frames<Dual<N>>,
    history: &mut History<Dual<N>>,
) -> State<Dual<N>> {
    system.rate::<false>(state, frames, history)
}
