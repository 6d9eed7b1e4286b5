//! A whole run with its derivatives.

use super::built::Built;
use super::events::{Event, Lookout, Scene, join};
use super::tangent::Tangent;
use super::trouble::Trouble;
#[cfg(doc)]
use occupant_core::forces::Memory;
use occupant_core::model::Model;
use occupant_core::model::setup::Integrator;
use occupant_core::motion::state::Shape;
#[cfg(doc)]
use occupant_core::motion::state::State;
use occupant_core::results::checkpoint::Checkpoint;
use occupant_core::results::outcome::{Outcome, Status};
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use occupant_core::run::{Run, Step};

/// Directions carried side by side; those beyond the last parameter are at rest. One width is compiled, as each is a whole
/// kernel in the build and in the binary. A product of duals is 4 floating-point operations in one direction; in four it is
/// 13, 7 instructions with two slopes in a register, 4 with four: a parameter alone takes at most 1.75 times as long as in a
/// kernel of its own.
const SIDE_BY_SIDE: usize = 4;
/// Directions available to parameters; the last is for the ends of steps.
const OF_PARAMETERS: usize = SIDE_BY_SIDE - 1;

/// A run with derivatives of its integrated and stored state, at every output.
#[derive(Clone, Debug)]
pub struct Trajectory {
    /// The plain run's outputs.
    pub checkpoints: Vec<Checkpoint>,
    /// Outcome.
    pub outcome: Outcome,
    /// Events where the motion is not differentiable.
    pub events: Vec<Event>,
    /// Number of events not kept.
    pub dropped_events: u64,
    /// By parameter, then by output.
    slopes: Vec<Vec<Displacement>>,
    shape: Shape,
}

/// Derivative of an output with respect to a parameter, per unit.
#[derive(Clone, Debug)]
struct Displacement {
    state: Vec<f64>,
    /// Changing numbers of the stored state, by position in the order of [`Memory::each`].
    memory: Vec<(u32, f64)>,
}

/// Runs `model` with derivatives by the parameters of `built`. The path's derivatives are evaluated on the way.
///
/// # Errors
/// Parameters or start of another model; a run that does not reach its end.
pub fn follow(model: &Model, built: &mut [Built]) -> Result<Trajectory, Trouble> {
    follow_watched(model, built, &mut |_, _| ())
}

/// As [`follow`]; `computed` is called with the number of computed outputs and of all outputs, over all passes.
///
/// # Errors
/// As [`follow`].
pub fn follow_watched(
    model: &Model,
    built: &mut [Built],
    computed: &mut dyn FnMut(usize, usize),
) -> Result<Trajectory, Trouble> {
    if built.iter().any(|built| !built.is_of(model)) {
        return Err(Trouble::Parameter("derivatives of another model; expected `Built::new` of this one".to_owned()));
    }
    let mut whole: Option<Trajectory> = None;
    let (outputs, passes) = (model.output_count(), built.len().div_ceil(OF_PARAMETERS));
    for (number, some) in built.chunks_mut(OF_PARAMETERS).enumerate() {
        let pass = pass::<SIDE_BY_SIDE>(model, some, &mut |output| {
            computed(number * outputs + output, passes * outputs);
        })?;
        match &mut whole {
            None => whole = Some(pass),
            Some(whole) => {
                join(&mut whole.events, &pass.events)?;
                whole.slopes.extend(pass.slopes);
            }
        }
    }
    whole.ok_or_else(|| Trouble::Output("no parameters".to_owned()))
}

/// Keeps the outputs of the plain run.
struct Keeper(Vec<Checkpoint>);

impl Recorder for Keeper {
    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        self.0.push(sample.checkpoint());
        Ok(Flow::Continue)
    }
}

/// The plain run and the run in dual numbers, step by step.
fn pass<const N: usize>(
    model: &Model,
    built: &mut [Built],
    computed: &mut dyn FnMut(usize),
) -> Result<Trajectory, Trouble> {
    let count = built.len().min(N - 1);
    let mut run = Run::new(model);
    run.follow_steps(steps_to_an_output(model));
    let mut taken: Vec<Step> = Vec::with_capacity(steps_to_an_output(model));
    let breaks_s = run.breaks_s().to_vec();
    let mut keeper = Keeper(Vec::new());
    let mut tangent = Tangent::<N>::new(model, built)?;
    let mut slopes = vec![Vec::new(); count];
    let mut scene = Scene::new(model);
    let mut lookout = Lookout::new(model);
    let failed = |e: &dyn std::fmt::Display| Trouble::Run(e.to_string());
    loop {
        run.record(&mut keeper).map_err(|e| failed(&e))?;
        tangent.output(run.time_s(), &mut scene);
        compare(&tangent, &run)?;
        for (k, slopes) in slopes.iter_mut().enumerate() {
            slopes.push(Displacement::of(&tangent, k));
        }
        computed(keeper.0.len());
        let Some(target_s) = run.next_output_s() else { break };
        run.advance_to(target_s).map_err(|e| failed(&e))?;
        taken = run.take_steps(taken);
        for step in taken.drain(..) {
            let stop_s = breaks_s.iter().copied().find(|&b| b > step.start_s);
            tangent.step(step, stop_s.unwrap_or(f64::INFINITY), &mut scene);
            lookout.look(model, &mut scene, tangent.latest());
        }
    }
    let outcome = run.end(Status::Completed, &mut keeper).map_err(|e| failed(&e))?;
    let (events, dropped_events) = lookout.events(count);
    let shape = model.start().state.shape();
    Ok(Trajectory { checkpoints: keeper.0, outcome, events, dropped_events, slopes, shape })
}

/// Buffer for the steps between two outputs.
fn steps_to_an_output(model: &Model) -> usize {
    let time = &model.setup().time;
    match model.setup().integrator {
        Integrator::Rk4 { step_s } => (time.output_s / step_s).min(1e6) as usize + 2,
        Integrator::Adaptive { .. } => 256,
    }
}

/// Checks that the values of the dual run equal those of the plain run bit for bit.
fn compare<const N: usize>(tangent: &Tangent<'_, N>, run: &Run<'_>) -> Result<(), Trouble> {
    let values = tangent.state.numbers().iter().map(|x| x.value);
    let state = values.zip(run.state().numbers()).all(|(a, b)| a.to_bits() == b.to_bits());
    let mut memory = true;
    let mut plain = run.history().memory.clone();
    tangent.history.memory.clone().each(&mut plain, &mut |a, b| memory &= a.value.to_bits() == b.to_bits());
    if state && memory { Ok(()) } else { Err(Trouble::Apart { time_s: run.time_s() }) }
}

impl Displacement {
    /// Direction `k` of a dual run at an output.
    fn of<const N: usize>(tangent: &Tangent<'_, N>, k: usize) -> Self {
        let state = tangent.state.numbers().iter().map(|x| x.slopes[k]).collect();
        let mut slopes = Vec::new();
        tangent.history.memory.map(&mut |x| slopes.push(x.slopes[k]));
        let memory = (0..).zip(slopes).filter(|(_, slope)| *slope != 0.0);
        Displacement { state, memory: memory.collect() }
    }
}

impl Trajectory {
    /// Number of parameters with derivatives.
    pub fn parameters(&self) -> usize {
        self.slopes.len()
    }

    /// Derivatives of the state by parameter `k` at an output, in the order of [`State::numbers`]; none if parameter or
    /// output does not exist.
    pub fn state_slopes(&self, k: usize, output: usize) -> &[f64] {
        self.slopes.get(k).and_then(|slopes| slopes.get(output)).map_or(&[], |slopes| &slopes.state)
    }

    /// Largest change of the state per unit of parameter `k`: m, rad, and tenths of m/s and rad/s. Infinite if a
    /// derivative overflows, 0 for a parameter that does not exist.
    pub fn reach(&self, k: usize) -> f64 {
        // places, quaternions and hinges come first, then speeds, then work sums, which move nothing
        let (places, moving) = (self.shape.places(), self.shape.moving());
        let outputs = self.slopes.get(k).into_iter().flatten();
        let greatest = outputs.flat_map(|d| {
            let scaled = |(i, x): (usize, &f64)| if i < places { x.abs() } else { 0.1 * x.abs() };
            d.state[..moving].iter().enumerate().map(scaled)
        });
        let worse = |a: f64, b: f64| {
            if b.is_finite() { a.max(b) } else { f64::INFINITY }
        };
        greatest.fold(0.0, worse)
    }

    /// An output displaced along parameter `k` by `by` units, to first order.
    pub(super) fn displaced(&self, k: usize, output: usize, by: f64) -> Checkpoint {
        let mut checkpoint = self.checkpoints[output].clone();
        let slopes = &self.slopes[k][output];
        for (x, slope) in checkpoint.state.iter_mut().zip(&slopes.state) {
            *x += by * slope;
        }
        let mut changing = slopes.memory.iter().peekable();
        let mut place = 0;
        checkpoint.memory = checkpoint.memory.map(&mut |x| {
            let slope = changing.next_if(|(at, _)| *at == place).map(|(_, slope)| slope);
            place += 1;
            slope.map_or(x, |slope| x + by * slope)
        });
        checkpoint.memory.confine();
        checkpoint
    }
}
