//! The derivative kernel: from a state to its rate of change.
//!
//! One evaluation reads as the report's method: places and velocities of the segments, loads from force elements,
//! then the accelerations of the tree. It allocates nothing, and is written once over `Scalar`.
//!
//! Results that are not integrated (which surface is touched, how strongly) go to an [`Observer`]; the unit observer `()`
//! costs nothing.

mod dispatch;

use crate::forces::sphere::Site;
use crate::forces::{Forces, History, Instant, Load, Observer, Unlike};
use crate::motion::dynamics::{Accelerations, Sweep, Wrench};
use crate::motion::frame::{Frames, Moving};
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::MOST_SEGMENTS;
use crate::motion::scalar::Scalar;
use crate::motion::skeleton::Skeleton;
use crate::motion::state::{State, Work};
use crate::motion::vector::V3;

/// Another tree, or one on another frame.
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
    /// Force elements.
    pub forces: Forces<S>,
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
        if self.spheres.len() != other.spheres.len() || spheres.clone().any(|(a, b)| a.segment != b.segment) {
            return Err(OTHER_SPHERES);
        }
        if !self.skeleton.is_like(&other.skeleton) {
            return Err(OTHER_TREE);
        }
        Ok(System {
            skeleton: self.skeleton.zip(&other.skeleton, &f),
            spheres: spheres.map(|(a, b)| a.zip(b, &f)).collect(),
            forces: self.forces.zip(&other.forces, &f)?,
        })
    }
}

/// One evaluation with all that it derived.
#[derive(Clone, Copy, Debug)]
pub struct Evaluation<S> {
    /// Places and velocities.
    pub kinematics: Kinematics<S>,
    /// Loads on the segments, without gravity.
    pub wrench: [Wrench<S>; MOST_SEGMENTS],
    /// Accelerations.
    pub accelerations: Accelerations<S>,
    /// Powers for the energy ledger, W.
    pub power: Work<S>,
}

/// What an evaluation writes on its way: a place that the next one uses again.
#[derive(Clone, Debug)]
pub struct Scratch<S> {
    kinematics: Kinematics<S>,
    load: Load<S>,
    sweep: Sweep<S>,
}

impl<S: Scalar> Scratch<S> {
    /// Nothing written yet of a body like `body`.
    #[inline(always)]
    pub fn blank(body: &Skeleton<S>) -> Self {
        Scratch { kinematics: Kinematics::blank(), load: Load::zero(), sweep: Sweep::blank(body) }
    }
}

impl<S: Scalar> System<S> {
    /// Rate of change of `state`, written to `rate`, with a place for what is on the way that is used again: clearing and
    /// copying cost lanes a fifth of an evaluation. With `COMMIT` the history first takes over the present position, which
    /// must be that of an accepted step; without it the history is only read.
    #[inline(always)]
    pub fn rate_with<const COMMIT: bool>(
        &self,
        scratch: &mut Scratch<S>,
        state: &State<S>,
        frames: &Frames<S>,
        history: &mut History<S>,
        observer: &mut impl Observer<S>,
        rate: &mut State<S>,
    ) {
        self.derive::<COMMIT>(scratch, state, frames, history, observer);
        scratch.sweep.accelerations.write_rate(&self.skeleton.layout, state, scratch.load.power, rate);
    }

    /// Motion, loads and accelerations.
    #[inline(always)]
    fn derive<const COMMIT: bool>(
        &self,
        scratch: &mut Scratch<S>,
        state: &State<S>,
        frames: &Frames<S>,
        history: &mut History<S>,
        observer: &mut (impl Observer<S> + ?Sized),
    ) {
        let Scratch { kinematics: k, load, sweep } = scratch;
        let root = self.skeleton.mount.as_ref().map(|mount| mount.of(frames));
        if S::HAS_SLOPES {
            follow_apart(k, &self.skeleton, state, root.as_ref());
        } else {
            k.follow(&self.skeleton, state, root.as_ref());
        }
        let at = Instant { k, state, frames, spheres: &self.spheres };
        load.clear(self.skeleton.layout.len());
        self.forces.apply::<COMMIT>(&at, history, observer, load); // Q_f + R (48), and F_s
        // q̈ from q̇ and q (114)
        let by_mount = if S::HAS_SLOPES {
            solve_apart(sweep, &self.skeleton, k, state, &load.wrench, root.as_ref())
        } else {
            sweep.solve(&self.skeleton, k, state.hinge_rate(), &load.wrench, root.as_ref())
        };
        if root.is_some() {
            // of a mount in space, which stands still, it is 0
            load.power.vehicle += by_mount;
        }
    }

    /// A sphere's centre seen from its segment's joint, in space, and its velocity; all in space axes.
    pub fn sphere(&self, k: &Kinematics<S>, sphere: usize) -> (V3<S>, V3<S>, V3<S>) {
        self.spheres[sphere].place(k)
    }
}

// In numbers of a register or two the kernel is fastest inlined whole. In duals it is 700 kB: what stages and starts of steps
// have in common is one function for both.

/// [`Kinematics::follow`].
#[inline(never)]
fn follow_apart<S: Scalar>(k: &mut Kinematics<S>, body: &Skeleton<S>, state: &State<S>, root: Option<&Moving<S>>) {
    k.follow(body, state, root);
}

/// [`Sweep::solve`].
#[inline(never)]
fn solve_apart<S: Scalar>(
    sweep: &mut Sweep<S>,
    body: &Skeleton<S>,
    k: &Kinematics<S>,
    state: &State<S>,
    wrench: &[Wrench<S>; MOST_SEGMENTS],
    root: Option<&Moving<S>>,
) -> S {
    sweep.solve(body, k, state.hinge_rate(), wrench, root)
}
