//! The derivative kernel: from a state to its rate of change.
//!
//! One evaluation reads as the report's method: places and velocities of the segments, loads from contacts, belts and
//! joints, then the accelerations of the tree. It allocates nothing, and is written once over [`scalar::Scalar`].
//!
//! Results that are not integrated (which surface is touched, how strongly) go to an [`Observer`]; the unit observer `()`
//! costs nothing.

pub mod assembly;
pub mod belts;
pub mod contact;
pub mod dynamics;
mod encounter;
pub mod face;
pub mod frame;
pub mod joints;
pub mod kinematics;
pub mod limb;
pub mod scalar;
pub mod skeleton;
pub mod spring;
pub mod state;
pub mod vector;

use belts::{BeltAction, BeltHistory, BeltLaw};
use contact::{ContactSystem, PairHistory, Touch};
use dynamics::{Accelerations, Wrench};
use encounter::Sphere;
use frame::{Moving, VEHICLE};
use joints::JointSystem;
use kinematics::Kinematics;
use scalar::Scalar;
use skeleton::Skeleton;
use state::{FREE, State, Work};
use vector::V3;

use crate::body::SEGMENTS;

/// Motions of the frames at one instant, by [`frame::SPACE`] and [`frame::VEHICLE`].
pub type Frames<S> = [Moving<S>; 2];

/// Constants of everything that acts: body, joints, contacts, belts.
#[derive(Clone, Debug)]
pub struct System<S> {
    /// Masses and geometry.
    pub skeleton: Skeleton<S>,
    /// Joint moments.
    pub joints: JointSystem<S>,
    /// Spheres and surfaces.
    pub contacts: ContactSystem<S>,
    /// Belts.
    pub belts: Vec<BeltLaw<S>>,
}

/// What pairs and belts remember between steps; changed only at accepted steps.
#[derive(Clone, Debug)]
pub struct History<S> {
    /// By pair.
    pub pairs: Vec<PairHistory<S>>,
    /// By belt.
    pub belts: Vec<BeltHistory<S>>,
    /// Pairs that can exert a force before the next commit, in ascending order.
    near: Vec<u32>,
    /// By group of pairs: where its part of `near` ends.
    near_end: Vec<u32>,
}

impl<S: Scalar> History<S> {
    /// A history in which every pair counts as near until the first commit.
    pub fn new(
        contacts: &ContactSystem<S>,
        pairs: Vec<PairHistory<S>>,
        belts: Vec<BeltHistory<S>>,
    ) -> Self {
        let near = (0..pairs.len() as u32).collect();
        let near_end = contacts.groups.iter().map(|g| g.pairs.end as u32).collect();
        History {
            pairs,
            belts,
            near,
            near_end,
        }
    }

    /// Places in `near` of the pairs of group `g`.
    #[inline(always)]
    fn near_of(&self, g: usize) -> std::ops::Range<usize> {
        let start = if g == 0 { 0 } else { self.near_end[g - 1] };
        start as usize..self.near_end[g] as usize
    }
}

/// Receives what happens in an evaluation.
pub trait Observer<S> {
    /// A pair exerts a force.
    #[inline(always)]
    fn touch(&mut self, _touch: &Touch<S>) {}
    /// Shape and force of belt `_index`.
    #[inline(always)]
    fn belt(&mut self, _index: usize, _action: &BeltAction<S>) {}
}

impl<S> Observer<S> for () {}

/// One evaluation with all that it derived.
#[derive(Clone, Copy, Debug)]
pub struct Evaluation<S> {
    /// Places and velocities.
    pub kinematics: Kinematics<S>,
    /// Loads on the segments, without gravity.
    pub wrench: [Wrench<S>; SEGMENTS],
    /// Accelerations.
    pub accelerations: Accelerations<S>,
    /// Powers for the energy ledger, W.
    pub power: Work<S>,
}

impl<S: Scalar> System<S> {
    /// Rate of change of `state`. With `COMMIT` the history first takes over the present position, which must be that of
    /// an accepted step; without it the history is only read.
    #[inline]
    pub fn rate<const COMMIT: bool>(
        &self,
        state: &State<S>,
        frames: &Frames<S>,
        history: &mut History<S>,
    ) -> State<S> {
        self.rate_observed::<COMMIT>(state, frames, history, &mut ())
    }

    /// [`System::rate`] with an observer.
    #[inline]
    pub fn rate_observed<const COMMIT: bool>(
        &self,
        state: &State<S>,
        frames: &Frames<S>,
        history: &mut History<S>,
        observer: &mut impl Observer<S>,
    ) -> State<S> {
        let e = self.evaluate::<COMMIT>(state, frames, history, observer);
        let mut rate = State {
            t1: state.velocity,
            velocity: e.accelerations.joint[0],
            hinge: state.hinge_rate,
            hinge_rate: e.accelerations.hinge,
            work: e.power,
            ..*state
        };
        for (slot, &n) in FREE.iter().enumerate() {
            rate.orientation[slot] = state.orientation[slot].rate(state.omega[slot]);
            rate.omega[slot] = e.accelerations.alpha[n];
        }
        rate
    }

    /// Everything that [`System::rate`] derives.
    #[inline(always)]
    pub fn evaluate<const COMMIT: bool>(
        &self,
        state: &State<S>,
        frames: &Frames<S>,
        history: &mut History<S>,
        observer: &mut impl Observer<S>,
    ) -> Evaluation<S> {
        let kinematics = Kinematics::new(&self.skeleton, state);
        let mut wrench = [Wrench::zero(); SEGMENTS];
        let mut power = State::zero().work;
        self.add_contacts::<COMMIT>(
            &kinematics,
            frames,
            history,
            &mut wrench,
            &mut power,
            observer,
        );
        self.add_belts::<COMMIT>(
            &kinematics,
            frames,
            history,
            &mut wrench,
            &mut power,
            observer,
        );
        power.joints = self.joints.apply(&kinematics, state, &mut wrench);
        let accelerations =
            dynamics::solve(&self.skeleton, &kinematics, &state.hinge_rate, &wrench);
        Evaluation {
            kinematics,
            wrench,
            accelerations,
            power,
        }
    }

    /// Takes over the position of an accepted step into the history.
    #[inline]
    pub fn commit(
        &self,
        state: &State<S>,
        frames: &Frames<S>,
        history: &mut History<S>,
        observer: &mut impl Observer<S>,
    ) {
        let k = Kinematics::new(&self.skeleton, state);
        let mut wrench = [Wrench::zero(); SEGMENTS];
        let mut power = State::zero().work;
        self.add_contacts::<true>(&k, frames, history, &mut wrench, &mut power, observer);
        self.add_belts::<true>(&k, frames, history, &mut wrench, &mut power, observer);
    }

    /// Contact forces on the segments (Eqs 84–94, 63–68).
    #[inline(always)]
    fn add_contacts<const COMMIT: bool>(
        &self,
        k: &Kinematics<S>,
        frames: &Frames<S>,
        history: &mut History<S>,
        wrench: &mut [Wrench<S>; SEGMENTS],
        power: &mut Work<S>,
        observer: &mut impl Observer<S>,
    ) {
        let contacts = &self.contacts;
        if COMMIT {
            history.near.clear();
        }
        for (g, group) in contacts.groups.iter().enumerate() {
            let near = if COMMIT { 0..0 } else { history.near_of(g) };
            if !COMMIT && near.is_empty() {
                continue;
            }
            let mut sphere = Sphere::new(contacts, group, k, &frames[group.frame]);
            if COMMIT {
                for i in group.pairs.clone() {
                    let pair = &mut history.pairs[i];
                    let depth = contacts.planes[i].depth(sphere.centre_f);
                    contacts.open(i, depth, pair);
                    sphere.meet::<COMMIT>(i, depth, pair, power, observer);
                    if contacts.is_near(depth, pair) {
                        history.near.push(i as u32);
                    }
                }
                history.near_end[g] = history.near.len() as u32;
            } else {
                for &i in &history.near[near] {
                    let i = i as usize;
                    let depth = contacts.planes[i].depth(sphere.centre_f);
                    sphere.meet::<COMMIT>(i, depth, &mut history.pairs[i], power, observer);
                }
            }
            sphere.load(wrench, power);
        }
    }

    /// Belt forces (Eqs 95–108), at the spheres' centres.
    #[inline(always)]
    fn add_belts<const COMMIT: bool>(
        &self,
        k: &Kinematics<S>,
        frames: &Frames<S>,
        history: &mut History<S>,
        wrench: &mut [Wrench<S>; SEGMENTS],
        power: &mut Work<S>,
        observer: &mut impl Observer<S>,
    ) {
        let frame = &frames[VEHICLE];
        for (i, belt) in self.belts.iter().enumerate() {
            let n = self.contacts.sites[belt.sphere].segment;
            let (arm, centre, velocity) = self.sphere(k, belt.sphere);
            let centre_v = frame.axes.into_frame(centre - frame.origin);
            let action = belt.act(centre_v, &history.belts[i]);
            if COMMIT {
                belt.commit(&action, &mut history.belts[i]);
            }
            let force = frame.axes.out(action.force);
            let carried = frame.velocity_at(centre);
            wrench[n].force += force;
            wrench[n].moment += arm.cross(force);
            power.belts -= force.dot(velocity - carried);
            power.vehicle += force.dot(carried);
            observer.belt(i, &action);
        }
    }

    /// A sphere's centre seen from its segment's joint, in space, and its velocity; all in space axes.
    #[inline(always)]
    pub fn sphere(&self, k: &Kinematics<S>, sphere: usize) -> (V3<S>, V3<S>, V3<S>) {
        let site = &self.contacts.sites[sphere];
        let n = site.segment;
        let arm = k.axes[n].out(site.offset);
        (
            arm,
            k.joint[n] + arm,
            k.joint_velocity[n] + k.omega[n].cross(arm),
        )
    }
}
