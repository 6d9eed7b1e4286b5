//! One sphere against the faces of one frame, within one evaluation.

use crate::forces::contact::ahead::Way;
use crate::forces::contact::solid::lever;
use crate::forces::contact::{ContactSystem, FRICTION, Group, PASSED, PRESS, PairHistory, Touch};
use crate::forces::element::{Instant, Load as AllLoads};
use crate::forces::sphere::Site;
use crate::motion::dynamics::Wrench;
use crate::motion::frame::Moving;
use crate::motion::kinematics::Kinematics;
use crate::motion::scalar::Scalar;
use crate::motion::state::Work;
use crate::motion::vector::V3;

/// A sphere's motion relative to a frame, in the frame's axes.
#[derive(Clone, Copy)]
pub(crate) struct Approach<S> {
    pub centre: V3<S>,
    pub velocity: V3<S>,
    pub omega: V3<S>,
    /// r, m.
    pub radius: S,
}

/// A sphere among the faces of a frame, and the load that it gathers.
pub(crate) struct Sphere<'a, S: Scalar> {
    contacts: &'a ContactSystem<S>,
    group: &'a Group,
    site: &'a Site<S>,
    frame: &'a Moving<S>,
    k: &'a Kinematics<S>,
    /// Centre seen from the segment's joint, space axes.
    arm: V3<S>,
    centre: V3<S>,
    /// Centre in the frame.
    pub centre_f: V3<S>,
    /// Whether at an accepted step.
    accepted: bool,
    /// Worked out at the first live pair: most spheres touch nothing.
    load: Option<Load<S>>,
}

/// Resultant of the contact forces at the centre, axes of the frame.
struct Load<S: Scalar> {
    approach: Approach<S>,
    force: V3<S>,
    twist: V3<S>,
    /// Where there is one.
    lanes: S::Mask,
}

impl<'a, S: Scalar> Sphere<'a, S> {
    /// The sphere of `group`, with no load yet.
    #[inline(always)]
    pub(super) fn new(contacts: &'a ContactSystem<S>, group: &'a Group, at: &Instant<'a, S>) -> Self {
        let (site, frame, k) = (&at.spheres[group.sphere], at.frame(group.frame), at.k);
        let mut arm = k.axes[site.segment].out(site.offset);
        if let Some(riding) = site.riding(group.by) {
            arm += riding.carried(k)[0];
        }
        let centre = k.joint[site.segment] + arm;
        let centre_f = frame.axes.into_frame(centre - frame.origin); // (83)
        Sphere { contacts, group, site, frame, k, arm, centre, centre_f, accepted: at.accepted, load: None }
    }

    /// How far the sphere is at least from pair `i` of solids, m, if it is farther than `enough` in all lanes and nothing of the
    /// pair is remembered: then there is no force, and a commit would change nothing.
    #[inline(always)]
    pub(super) fn keeps_off(&self, i: usize, enough: S, past: &[PairHistory<S>]) -> Option<S> {
        let solids = &self.contacts.solids;
        let j = i - self.contacts.pairs.len();
        if S::any(!solids.laws[j].stays(&past[i]) | solids.remember(j, past)) {
            return None;
        }
        solids.farther(j, self.centre_f, self.site.radius, enough)
    }

    /// Adds the forces of pair `i`, of faces or of solids, in the lanes of `near`; returns the deformation. At an
    /// accepted step the pair's history first takes over the present position.
    #[inline(always)]
    pub(super) fn look_at<const SOLID: bool>(
        &mut self,
        i: usize,
        near: S::Mask,
        past: &mut [PairHistory<S>],
        power: &mut Work<S>,
        show: &mut impl FnMut(&Touch<S>),
    ) -> S {
        if SOLID {
            return self.meet_solid(i, near, past, power, show);
        }
        let depth = self.contacts.planes[i].depth(self.centre_f);
        if self.accepted {
            self.contacts.open(i, depth, &mut past[i]);
        }
        self.meet(i, depth, depth.gt(S::zero()) & near, past, power, show);
        depth
    }

    /// Adds the forces of pair `i` at deformation `depth`, in the lanes of `contact`. In all others nothing changes, not
    /// even the sign of a zero.
    #[inline(always)]
    fn meet(
        &mut self,
        i: usize,
        depth: S,
        contact: S::Mask,
        past: &mut [PairHistory<S>],
        power: &mut Work<S>,
        show: &mut impl FnMut(&Touch<S>),
    ) {
        if !S::any(contact) {
            return;
        }
        let live = contact & past[i].phase.lt(S::of(PASSED));
        if !S::any(live) {
            return;
        }
        let approach = self.approach();
        let touch = self.contacts.touch(self.accepted, self.group, i, depth, live, &approach, past);
        if let Some(touch) = touch {
            self.take(touch, &approach, self.site.radius, power, show);
        }
    }

    /// Adds the forces of pair `i` with solids, in the lanes of `near`; returns the deformation. At an accepted step its
    /// history first takes over the present position.
    #[inline(always)]
    fn meet_solid(
        &mut self,
        i: usize,
        near: S::Mask,
        past: &mut [PairHistory<S>],
        power: &mut Work<S>,
        show: &mut impl FnMut(&Touch<S>),
    ) -> S {
        let (contacts, radius) = (self.contacts, self.site.radius);
        let j = i - contacts.pairs.len();
        let union = &contacts.solids.laws[j];
        let nearest = contacts.solids.nearest(j, self.centre_f, radius, past, self.accepted);
        if self.accepted {
            union.commit(nearest.depth, &mut past[i]);
        }
        let live = nearest.depth.gt(S::zero()) & near & !union.law.is_gone(past);
        if S::any(live) {
            let approach = self.approach();
            let touch = union.press(self.group, i, nearest, live, &approach, past);
            self.take(touch, &approach, lever(nearest.depth, radius), power, show);
        }
        nearest.depth
    }

    /// Adds the forces of a touch that acts at A, `lever` from the centre against N̂.
    #[inline(always)]
    fn take(
        &mut self,
        t: Touch<S>,
        approach: &Approach<S>,
        lever: S,
        power: &mut Work<S>,
        show: &mut impl FnMut(&Touch<S>),
    ) {
        let Some(load) = &mut self.load else { return };
        let on = t.weight.gt(S::zero());
        let press = t.normal * t.normal_force + t.edge;
        let arm = t.normal * -lever; // r̄ of (65)
        let edge_twist = arm.cross(t.edge) * self.contacts.edge_lever;
        let force = load.force + (press + t.friction); // F_N + F_f (93)
        let twist = load.twist + (arm.cross(t.friction) + edge_twist);
        load.force = V3::select(on, force, load.force);
        load.twist = V3::select(on, twist, load.twist);
        load.lanes = load.lanes | on;
        // work of the contact forces, relative to the frame, as a power (63)
        let pressing = press.dot(approach.velocity) + edge_twist.dot(approach.omega);
        let rubbing = t.friction.dot(t.slip);
        let sums = &mut power.sums;
        sums[PRESS] = S::select(on, sums[PRESS] - pressing, sums[PRESS]);
        sums[FRICTION] = S::select(on, sums[FRICTION] - rubbing, sums[FRICTION]);
        show(&Touch { force: self.frame.axes.out(press + t.friction), ..t });
    }

    /// Puts the gathered load on the sphere's segment.
    #[inline(always)]
    pub(super) fn load(self, all: &mut AllLoads<S>) {
        let Some(load) = self.load else { return };
        let frame = self.frame;
        let (force, twist) = (frame.axes.out(load.force), frame.axes.out(load.twist)); // (94)
        let moment = self.arm.cross(force) + twist; // with the force, Q_f (68)
        // F·v of the frame at the centre, and the lever about it
        let carrying = force.dot(frame.velocity_at(self.centre)) + twist.dot(frame.omega);
        let on = &mut all.wrench[self.site.segment];
        on.force = V3::select(load.lanes, on.force + force, on.force);
        on.moment = V3::select(load.lanes, on.moment + moment, on.moment);
        let vehicle = &mut all.power_at(self.site.segment).vehicle;
        *vehicle = S::select(load.lanes, *vehicle + carrying, *vehicle);
        all.push([self.group.frame, self.site.segment], force, self.centre, twist, load.lanes);
        all.press(self.site, self.group.by, force, load.lanes);
    }

    /// Velocity beside its segment, of what it rides on.
    #[inline(always)]
    fn beside(&self) -> V3<S> {
        let Some(riding) = self.site.riding(self.group.by) else { return V3::zero() };
        riding.carried(self.k)[1]
    }

    /// Its way straight ahead relative to the frame, in the frame's axes, for as long as a step can be.
    #[inline(always)]
    pub(super) fn way(&self, longest: S) -> Way<S> {
        let (n, k, frame) = (self.site.segment, self.k, self.frame);
        let velocity =
            k.joint_velocity[n] + k.omega[n].cross(self.arm) + self.beside() - frame.velocity_at(self.centre);
        Way::new(self.centre_f, frame.axes.into_frame(velocity), self.site.radius, longest)
    }

    /// How the sphere moves relative to the frame.
    #[inline(always)]
    pub(super) fn approach(&mut self) -> Approach<S> {
        let (n, k, frame) = (self.site.segment, self.k, self.frame);
        let (arm, centre, centre_f) = (self.arm, self.centre, self.centre_f);
        if let Some(load) = &self.load {
            return load.approach;
        }
        let mut velocity = k.joint_velocity[n] + k.omega[n].cross(arm);
        if self.site.riding(self.group.by).is_some() {
            velocity += self.beside();
        }
        let approach = Approach {
            centre: centre_f,
            velocity: frame.axes.into_frame(velocity - frame.velocity_at(centre)),
            omega: frame.axes.into_frame(k.omega[n] - frame.omega),
            radius: self.site.radius,
        };
        self.load = Some(Load { approach, force: V3::zero(), twist: V3::zero(), lanes: S::truth(false) });
        approach
    }
}

/// What a sphere's segment gets from faces that another segment carries, apart from what it had before.
pub(super) struct Aside<S> {
    segments: [usize; 2],
    wrench: Wrench<S>,
    vehicle: S,
}

impl<S: Scalar> Aside<S> {
    /// Puts aside what the segment of a sphere has.
    #[inline(always)]
    pub(super) fn new(segments: [usize; 2], all: &mut AllLoads<S>) -> Self {
        let [own, _] = segments;
        let wrench = std::mem::replace(&mut all.wrench[own], Wrench::zero());
        let vehicle = std::mem::replace(&mut all.power_at(own).vehicle, S::zero());
        Aside { segments, wrench, vehicle }
    }

    /// Puts the opposite on the segment that carries the faces; what one body gets the other gives.
    #[inline(always)]
    pub(super) fn react(self, k: &Kinematics<S>, all: &mut AllLoads<S>) {
        let [own, carrier] = self.segments;
        let Wrench { force, moment } = all.wrench[own];
        let lever = k.joint[own] - k.joint[carrier];
        let on = &mut all.wrench[carrier];
        on.force -= force;
        on.moment -= moment + lever.cross(force);
        all.wrench[own] = Wrench { force: self.wrench.force + force, moment: self.wrench.moment + moment };
        let carrying = std::mem::replace(&mut all.power_at(own).vehicle, self.vehicle);
        all.hand_over([carrier, own], carrying, S::truth(true));
    }
}
