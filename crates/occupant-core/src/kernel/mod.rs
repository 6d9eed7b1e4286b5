//! The derivative kernel: from a state to its rate of change.
//!
//! One evaluation follows the report's method: positions and velocities of the segments, loads from force elements,
//! then the accelerations of the tree. It allocates nothing, and is written once over `Scalar`.
//!
//! Results that are not integrated (which surface is touched, how strongly) go to an [`Observer`]; the unit observer `()`
//! costs nothing.

pub(crate) mod carried;
mod dispatch;
pub(crate) mod instruments;

use crate::forces::column;
use crate::forces::sphere::{Site, Use};
use crate::forces::{Forces, History, Instant, Load, MOST_LEGS, Observer, Unlike};
use crate::kernel::instruments::Instruments;
use crate::motion::dynamics::{Accelerations, Sweep, Wrench};
use crate::motion::frame::{Frames, Moving};
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::{MOST_BODIES, MOST_SEGMENTS, MOST_SLIDES};
use crate::motion::scalar::Scalar;
use crate::motion::skeleton::Skeleton;
use crate::motion::state::{SLIDE_UNITS, State, Work};
use crate::motion::vector::V3;

/// Another tree, or a tree on another frame.
pub(crate) const OTHER_TREE: Unlike = Unlike("the bodies have other trees of segments");
/// Other spheres, or spheres on other segments.
pub(crate) const OTHER_SPHERES: Unlike = Unlike("the contact spheres are others or on other segments");

/// Constants of the body and of everything that acts on it.
#[derive(Clone, Debug)]
pub struct System<S> {
    /// Masses and geometry.
    pub skeleton: Skeleton<S>,
    /// Spheres, in the body's order.
    pub spheres: Vec<Site<S>>,
    /// Segments that carry contact faces; their frames have indices after all others.
    pub carriers: Vec<usize>,
    /// Force elements.
    pub forces: Forces<S>,
    /// Instruments of the bodies; empty for bodies without.
    pub(crate) instruments: Vec<Instruments<S>>,
}

impl<S> System<S> {
    /// System of these parts; the segments with faces are those of contacts.
    pub fn new(skeleton: Skeleton<S>, spheres: Vec<Site<S>>, forces: Forces<S>) -> Self {
        System { skeleton, spheres, carriers: forces.contacts.carriers.clone(), forces, instruments: Vec::new() }
    }
}

impl<S: Copy> System<S> {
    /// f applied to every number and the one in the same place of `other`: with `f` = (lanes, number) ↦ lanes with that
    /// number in lane i, a system takes its place among others; with (value, derivative) ↦ dual number, a system and its
    /// derivative become one.
    ///
    /// # Errors
    /// Systems of unlike structure.
    pub fn zip<A: Copy, T>(&self, other: &System<A>, f: impl Fn(S, A) -> T) -> Result<System<T>, Unlike> {
        let spheres = self.spheres.iter().zip(&other.spheres);
        if self.spheres.len() != other.spheres.len() || spheres.clone().any(|(a, b)| !a.is_like(b)) {
            return Err(OTHER_SPHERES);
        }
        let instruments = self.instruments.iter().zip(&other.instruments);
        let is_like = self.skeleton.is_like(&other.skeleton) && instruments.clone().all(|(a, b)| a.is_like(b));
        if !is_like || self.carriers != other.carriers {
            return Err(OTHER_TREE);
        }
        Ok(System {
            skeleton: self.skeleton.zip(&other.skeleton, &f),
            spheres: spheres.map(|(a, b)| a.zip(b, &f)).collect(),
            carriers: self.carriers.clone(),
            forces: self.forces.zip(&other.forces, &f)?,
            instruments: instruments.map(|(a, b)| a.zip(b, &f)).collect(),
        })
    }
}

/// Arguments of a rate.
#[derive(Clone, Copy, Debug)]
pub struct Situation<'a, S> {
    /// State of the body.
    pub state: &'a State<S>,
    /// Frames at its time.
    pub frames: &'a Frames<S>,
    /// Whether this is an accepted step: the history is then first updated with the present position; else it is only
    /// read.
    pub accepted: bool,
}

impl<'a, S> Situation<'a, S> {
    /// Within a step.
    pub fn within(state: &'a State<S>, frames: &'a Frames<S>) -> Self {
        Situation { state, frames, accepted: false }
    }

    /// At an accepted step.
    pub fn accepted(state: &'a State<S>, frames: &'a Frames<S>) -> Self {
        Situation { state, frames, accepted: true }
    }
}

/// One evaluation with its intermediate values.
#[derive(Clone, Copy, Debug)]
pub struct Evaluation<S> {
    /// Positions and velocities.
    pub kinematics: Kinematics<S>,
    /// Loads on the segments, without gravity.
    pub wrench: [Wrench<S>; MOST_SEGMENTS],
    /// Accelerations.
    pub accelerations: Accelerations<S>,
    /// Powers for the energy ledger by body, W.
    pub power: [Work<S>; MOST_BODIES],
    /// By segment: moment of all loads except joints, N·m.
    pub(crate) outer: [V3<S>; MOST_SEGMENTS],
    /// By leg: force on the spheres at its knee, N.
    pub(crate) knees: [V3<S>; MOST_LEGS],
    /// Resistance of the plates, N.
    pub(crate) resist: [S; MOST_SLIDES],
}

/// Scratch space of an evaluation, reused by the next.
#[derive(Clone, Debug)]
pub struct Scratch<S> {
    kinematics: Kinematics<S>,
    /// By [`System::carriers`].
    carried: Vec<Moving<S>>,
    load: Load<S>,
    sweep: Sweep<S>,
    /// Frames with those that columns and hinges carry; none without such frames.
    frames: Option<Box<Frames<S>>>,
}

impl<S: Scalar> Scratch<S> {
    /// Empty scratch space for a system like this.
    #[inline(always)]
    pub fn blank(system: &System<S>) -> Self {
        Scratch {
            kinematics: Kinematics::blank(),
            carried: vec![Moving::space(); system.carriers.len()],
            load: Load::zero(&system.skeleton.layout, system.forces.giving()),
            sweep: Sweep::blank(&system.skeleton),
            frames: system.forces.gives().then(|| Box::new(Frames::still(S::zero()))),
        }
    }

    /// Writes the rate of the latest evaluation.
    #[inline(always)]
    fn write_rate(&self, body: &Skeleton<S>, state: &State<S>, rate: &mut State<S>) {
        let Load { power, own, .. } = &self.load;
        self.sweep.accelerations.write_rate(&body.layout, state, power, rate);
        let numbers = rate.own_mut();
        numbers.copy_from_slice(&own[..numbers.len()]);
        let slides = self.kinematics.slides.iter().zip(&self.sweep.accelerations.slides).take(self.kinematics.sliding);
        for (own, (slid, acceleration)) in numbers.chunks_exact_mut(2).zip(slides) {
            own[0] = slid.speed * S::of(1.0 / SLIDE_UNITS[0]);
            own[1] = *acceleration * S::of(1.0 / SLIDE_UNITS[1]);
        }
    }
}

impl<S: Scalar> System<S> {
    /// Rate of change of the state, written to `rate`, with reused scratch space: clearing and copying cost lanes a
    /// fifth of an evaluation.
    #[inline(always)]
    pub fn rate_with(
        &self,
        scratch: &mut Scratch<S>,
        situation: Situation<'_, S>,
        history: &mut History<S>,
        observer: &mut impl Observer<S>,
        rate: &mut State<S>,
    ) {
        self.derive(scratch, situation, history, observer);
        scratch.write_rate(&self.skeleton, situation.state, rate);
    }

    /// Motion, loads and accelerations.
    #[inline(always)]
    fn derive(
        &self,
        scratch: &mut Scratch<S>,
        situation: Situation<'_, S>,
        history: &mut History<S>,
        observer: &mut (impl Observer<S> + ?Sized),
    ) {
        self.bear(scratch, situation, history, observer);
        self.solve(scratch, situation);
    }

    /// Motion and loads.
    #[inline(always)]
    fn bear(
        &self,
        scratch: &mut Scratch<S>,
        situation: Situation<'_, S>,
        history: &mut History<S>,
        observer: &mut (impl Observer<S> + ?Sized),
    ) {
        let Scratch { kinematics: k, carried, load, frames: own, .. } = scratch;
        let Situation { state, mut frames, accepted } = situation;
        if let Some(own) = own {
            **own = *frames;
            self.carry(state, own);
            frames = own;
        }
        k.follow(&self.skeleton, state, Some(frames));
        for (moving, &segment) in carried.iter_mut().zip(&self.carriers) {
            *moving = k.moving(segment);
        }
        let at = Instant { k, state, frames, carried, spheres: &self.spheres, accepted };
        load.clear(self.skeleton.layout.len(), self.skeleton.slides.len());
        self.forces.apply(&at, history, observer, load); // Q_f + R (48), and F_s
    }

    /// Accelerations from motion and loads.
    #[inline(always)]
    fn solve(&self, scratch: &mut Scratch<S>, situation: Situation<'_, S>) {
        let Scratch { kinematics: k, load, sweep, frames: own, .. } = scratch;
        // q̈ from q̇ and q (114)
        let mut drive = [S::zero(); MOST_SLIDES];
        for (i, drive) in drive[..k.sliding].iter_mut().enumerate() {
            *drive = k.slides[i].axis.dot(load.rides[i]) - load.resist[i];
        }
        let motion = Some((own.as_deref().unwrap_or(situation.frames), &mut load.power[..]));
        sweep.solve(&self.skeleton, k, situation.state.hinge_rate(), (&load.wrench, &drive), motion);
    }

    /// Moves the frames that columns and hinges carry; `frames` contains their parents.
    #[inline(always)]
    pub(crate) fn carry(&self, state: &State<S>, frames: &mut Frames<S>) {
        column::carry(&self.forces.columns, state, frames);
        column::carry(&self.forces.hinges, state, frames);
    }

    /// Vector from a segment's joint to a sphere's centre, and the sphere's velocity, space axes.
    pub fn sphere(&self, k: &Kinematics<S>, sphere: usize) -> (V3<S>, V3<S>, V3<S>) {
        self.spheres[sphere].place(k, Use::Contact)
    }
}
