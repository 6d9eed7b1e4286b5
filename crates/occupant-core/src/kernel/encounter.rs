//! One sphere against the faces of one frame, within one evaluation.

use super::Observer;
use super::contact::{ContactSystem, Group, PASSED, PairHistory, Site};
use super::dynamics::Wrench;
use super::frame::Moving;
use super::kinematics::Kinematics;
use super::scalar::Scalar;
use super::state::Work;
use super::vector::V3;
use crate::body::SEGMENTS;

/// A sphere's motion relative to a frame, in the frame's axes.
#[derive(Clone, Copy)]
pub(super) struct Approach<S> {
    pub centre: V3<S>,
    pub velocity: V3<S>,
    pub omega: V3<S>,
}

/// A sphere among the faces of a frame, and the load that it gathers.
pub(super) struct Sphere<'a, S> {
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
    /// Worked out at the first live pair: most spheres touch nothing.
    load: Option<Load<S>>,
}

/// Resultant of the contact forces at the centre, axes of the frame.
struct Load<S> {
    approach: Approach<S>,
    force: V3<S>,
    twist: V3<S>,
}

impl<'a, S: Scalar> Sphere<'a, S> {
    /// The sphere of `group`, with no load yet.
    #[inline(always)]
    pub fn new(
        contacts: &'a ContactSystem<S>,
        group: &'a Group,
        k: &'a Kinematics<S>,
        frame: &'a Moving<S>,
    ) -> Self {
        let site = &contacts.sites[group.sphere];
        let arm = k.axes[site.segment].out(site.offset);
        let centre = k.joint[site.segment] + arm;
        let centre_f = frame.axes.into_frame(centre - frame.origin);
        Sphere {
            contacts,
            group,
            site,
            frame,
            k,
            arm,
            centre,
            centre_f,
            load: None,
        }
    }

    /// Adds the forces of pair `i` at deformation `depth`.
    #[inline(always)]
    pub fn meet<const COMMIT: bool>(
        &mut self,
        i: usize,
        depth: S,
        history: &mut PairHistory<S>,
        power: &mut Work<S>,
        observer: &mut impl Observer<S>,
    ) {
        let contact = depth.gt(S::zero());
        if !(S::any(contact) && S::any(contact & history.phase.lt(S::of(PASSED)))) {
            return;
        }
        let approach = self.approach();
        let touch = self
            .contacts
            .touch::<COMMIT>(self.group, i, depth, &approach, history);
        let (Some(t), Some(load)) = (touch, &mut self.load) else {
            return;
        };
        let press = t.normal * t.normal_force + t.edge;
        let arm = t.normal * -self.site.radius;
        let edge_twist = arm.cross(t.edge) * self.contacts.edge_lever;
        load.force += press + t.friction;
        load.twist += arm.cross(t.friction) + edge_twist;
        power.contact -= press.dot(approach.velocity) + edge_twist.dot(approach.omega);
        power.friction -= t.friction.dot(t.slip);
        observer.touch(&t);
    }

    /// Puts the gathered load on the sphere's segment (Eqs 94, 63–68).
    #[inline(always)]
    pub fn load(self, wrench: &mut [Wrench<S>; SEGMENTS], power: &mut Work<S>) {
        let Some(load) = self.load else { return };
        let frame = self.frame;
        let (force, twist) = (frame.axes.out(load.force), frame.axes.out(load.twist));
        let on = &mut wrench[self.site.segment];
        on.force += force;
        on.moment += self.arm.cross(force) + twist;
        // F·v of the frame at the centre, and the lever about it
        power.vehicle += force.dot(frame.velocity_at(self.centre)) + twist.dot(frame.omega);
    }

    /// How the sphere moves relative to the frame.
    #[inline(always)]
    fn approach(&mut self) -> Approach<S> {
        let (n, k, frame) = (self.site.segment, self.k, self.frame);
        let (arm, centre, centre_f) = (self.arm, self.centre, self.centre_f);
        let load = self.load.get_or_insert_with(|| {
            let velocity = k.joint_velocity[n] + k.omega[n].cross(arm);
            let approach = Approach {
                centre: centre_f,
                velocity: frame.axes.into_frame(velocity - frame.velocity_at(centre)),
                omega: frame.axes.into_frame(k.omega[n] - frame.omega),
            };
            Load {
                approach,
                force: V3::zero(),
                twist: V3::zero(),
            }
        });
        load.approach
    }
}
