//! Inputs of the runs in lanes: one lane of numbers for each.

use super::place::Place;
use crate::forces::{History, Memory};
use crate::kernel::{Scratch, System};
use crate::model::Model;
use crate::motion::frame::{Frames, VEHICLE};
use crate::motion::integrate::bogacki_shampine::Tolerance;
use crate::motion::integrate::rk4::Stages;
use crate::motion::lanes::Lanes;
use crate::motion::state::State;
use crate::run::ahead::Ahead;

/// Force elements of the runs side by side, with their memory.
#[derive(Clone, Debug)]
pub(crate) struct Bench<L: Lanes> {
    pub state: State<L>,
    /// Start of the latest step, if any element can switch in any of the runs.
    pub rear: Option<Rear<L>>,
    pub stages: Stages<L>,
    pub history: History<L>,
    /// Data of runs under error control, which need none of the above.
    pub ahead: Option<Box<Ahead<L>>>,
    pub tolerance: Tolerance<L>,
    pub around: Around<L>,
}

/// Data of a rate other than the state.
#[derive(Clone, Debug)]
pub(crate) struct Around<L: Lanes> {
    pub system: System<L>,
    /// At the step's start, middle and end; under error control, at the stages of a trial.
    pub frames: [Frames<L>; 3],
    pub scratch: Scratch<L>,
}

/// Start of the latest step of all runs, and of the present one.
#[derive(Clone, Debug)]
pub(crate) struct Rear<L: Lanes> {
    // boxed, as they change hands at every step
    pub latest: Box<Start<L>>,
    pub ahead: Box<Start<L>>,
}

/// Start of a step: states, and the memory before the commit there.
#[derive(Clone, Debug)]
pub(crate) struct Start<L: Lanes> {
    pub state: State<L>,
    pub memory: Memory<L>,
}

impl<L: Lanes> Bench<L> {
    /// Keeps the start of the next step.
    pub fn keep_start(&mut self) {
        if let Some(rear) = &mut self.rear {
            rear.ahead.state.take_over(&self.state);
            rear.ahead.memory.take_over(&self.history.memory);
        }
    }

    /// Lanes in which the commit of the present step shows that an element switched within the latest.
    pub fn has_switched(&self) -> L {
        let mask = self.rear.as_ref().map(|rear| rear.ahead.memory.has_switched(&self.history.memory));
        mask.map_or(L::zero(), |mask| L::select(mask, L::one(), L::zero()))
    }

    /// The present step becomes the latest.
    pub fn shift(&mut self) {
        if let Some(rear) = &mut self.rear {
            std::mem::swap(&mut rear.latest, &mut rear.ahead);
        }
    }
}

/// Moves the frames of lane `i` to a time of its step, given with the step's middle.
pub(super) fn move_frames<L: Lanes>(i: usize, place: &mut Place, lanes: &mut Frames<L>, [t_s, middle_s]: [f64; 2]) {
    // space is at rest
    let Place { frames, model, run, .. } = place;
    model.move_frames(frames, t_s, middle_s, &mut run.cursor);
    lanes.time.set_lane(i, t_s);
    for frame in VEHICLE..=VEHICLE + model.setup().frames.len() {
        lanes[frame].each(&frames[frame], &mut |lanes: &mut L, x: f64| lanes.set_lane(i, x));
    }
}

/// A bench with `model` in every lane.
pub(super) fn new_bench<L: Lanes>(model: &Model) -> Option<Box<Bench<L>>> {
    let system = model.system();
    let system = system.zip(system, |x, _| L::of(x)).ok()?;
    let history = History::new(&system.forces, model.start().history.memory.map(&mut L::of));
    let mut cursor = Default::default();
    let start_s = model.setup().time.start_s;
    let frames = model.frames(start_s, start_s, &mut cursor);
    let frames = frames.zip(&frames, &|x, _| L::of(x));
    let start = &model.start().state;
    let (scratch, stages) = (Scratch::blank(&system), Stages::new(start.shape()));
    let around = Around { system, frames: [frames; 3], scratch };
    let state = start.zip(start, |x, _| L::of(x));
    let tolerance = Tolerance { relative: L::one(), absolute_m: L::one(), absolute_m_s: L::one() };
    Some(Box::new(Bench { state, rear: None, stages, history, ahead: None, tolerance, around }))
}
