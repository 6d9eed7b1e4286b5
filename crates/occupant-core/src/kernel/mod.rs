//! The derivative kernel: from a state to its rate of change.
//!
//! One evaluation reads as the report's method: places and velocities of the segments, loads from contacts, belts and
//! joints, then the accelerations of the tree. It allocates nothing, and is written once over [`scalar::Scalar`].
//!
//! Results that are not integrated (which surface is touched, how strongly) go to an [`Observer`]; the unit observer `()`
//! costs nothing.

mod dispatch;
mod zip;

pub use zip::Unlike;

pub(crate) use dispatch::{Bench, Machine};

use crate::body::SEGMENTS;
use crate::forces::belt::law::BeltLaw;
use crate::forces::contact::ContactSystem;
use crate::forces::contact::encounter::Sphere;
use crate::forces::contact::history::{Looking, Near, Nearing};
use crate::forces::joint::JointSystem;
use crate::forces::{History, Observer};
use crate::motion::dynamics::{self, Accelerations, Wrench};
use crate::motion::frame::{Frames, VEHICLE};
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::FREE;
use crate::motion::scalar::Scalar;
use crate::motion::skeleton::Skeleton;
use crate::motion::state::{State, Work};
use crate::motion::vector::V3;

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
    pub fn rate<const COMMIT: bool>(&self, state: &State<S>, frames: &Frames<S>, history: &mut History<S>) -> State<S> {
        self.rate_observed::<COMMIT>(state, frames, history, &mut ())
    }

    /// [`System::rate`] with an observer.
    #[inline(always)]
    pub fn rate_observed<const COMMIT: bool>(
        &self,
        state: &State<S>,
        frames: &Frames<S>,
        history: &mut History<S>,
        observer: &mut impl Observer<S>,
    ) -> State<S> {
        let k = Kinematics::new(&self.skeleton, state);
        let (wrench, power) = self.loads::<COMMIT>(&k, state, frames, history, observer);
        let accelerations = dynamics::solve(&self.skeleton, &k, &state.hinge_rate, &wrench);
        let mut rate = State {
            t1: state.velocity,
            velocity: accelerations.joint[0],
            hinge: state.hinge_rate,
            hinge_rate: accelerations.hinge,
            work: power,
            ..*state
        };
        for (slot, &n) in FREE.iter().enumerate() {
            rate.orientation[slot] = state.orientation[slot].rate(state.omega[slot]);
            rate.omega[slot] = accelerations.alpha[n];
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
        let (wrench, power) = self.loads::<COMMIT>(&kinematics, state, frames, history, observer);
        let accelerations = dynamics::solve(&self.skeleton, &kinematics, &state.hinge_rate, &wrench);
        Evaluation { kinematics, wrench, accelerations, power }
    }

    /// All loads on the segments but gravity, and their powers.
    #[inline(always)]
    fn loads<const COMMIT: bool>(
        &self,
        k: &Kinematics<S>,
        state: &State<S>,
        frames: &Frames<S>,
        history: &mut History<S>,
        observer: &mut impl Observer<S>,
    ) -> ([Wrench<S>; SEGMENTS], Work<S>) {
        let mut wrench = [Wrench::zero(); SEGMENTS];
        let mut power = Work::zero();
        self.add_contacts::<COMMIT>(k, frames, history, &mut wrench, &mut power, observer);
        self.add_belts::<COMMIT>(k, frames, history, &mut wrench, &mut power, observer);
        power.joints = self.joints.apply(k, state, &mut wrench);
        (wrench, power)
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
        let mut power = Work::zero();
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
        for (g, group) in contacts.groups.iter().enumerate() {
            let near = history.near_of(g, group);
            if !COMMIT && near.is_empty() {
                continue;
            }
            let mut sphere = Sphere::new(contacts, group, k, &frames[group.frame]);
            if !COMMIT {
                for at in near {
                    let Near { pair, lanes } = history.near[at];
                    let i = pair as usize;
                    let depth = contacts.planes[i].depth(sphere.centre_f);
                    let contact = depth.gt(S::zero()) & lanes;
                    let pair = &mut history.pairs[i];
                    sphere.meet::<false>(i, depth, contact, pair, power, observer);
                }
            } else {
                let mut near = Nearing::new(group);
                if history.must_look(g, sphere.centre_f) {
                    let mut look = Looking::new(group);
                    for i in group.pairs.clone() {
                        let depth = sphere.commit(i, history, power, observer);
                        look.at(i, depth, contacts, history);
                        near.at(i, depth, contacts, history);
                    }
                    look.end(g, &sphere, contacts, history);
                } else {
                    for at in history.watched_of(g, group) {
                        let i = history.watched[at] as usize;
                        let depth = sphere.commit(i, history, power, observer);
                        near.at(i, depth, contacts, history);
                    }
                }
                near.end(g, history);
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
        (arm, k.joint[n] + arm, k.joint_velocity[n] + k.omega[n].cross(arm))
    }
}
