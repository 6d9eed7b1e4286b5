//! Forces of a material on a sphere: normal force, and friction at the point of contact.
//!
//! With (F, U) of the material's force law and the weight w the normal force is wF; friction is −f φ ψ wF v_t/√(v_t² + v_s²),
//! φ and ψ tables over the slip speed and the normal force (6.11).

use crate::forces::contact::encounter::Approach;
use crate::forces::contact::material::{Force, Material};
use crate::forces::function::DeflectionLaw;
use crate::forces::function::steps::Steps;
use crate::forces::spring::Spring;
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;

/// Constants of a material.
#[derive(Clone, Debug)]
pub(crate) struct MaterialLaw<S> {
    pub(crate) force: ForceLaw<S>,
    pub(crate) friction: S,
    pub(crate) friction_speed_squared: S,
    /// Of f over the slip speed and over the normal force.
    pub(crate) friction_factors: [Steps<S>; 2],
}

/// Constants of a normal force law.
#[derive(Clone, Debug)]
pub(crate) enum ForceLaw<S> {
    Bilinear(Spring<S>),
    Deflection(Box<DeflectionLaw<S>>),
}

/// Kinematics of a contact between a sphere and a material.
#[derive(Clone, Copy)]
pub(super) struct Meeting<S> {
    /// Δ and Δ_m, m.
    depth: S,
    greatest: S,
    /// w.
    weight: S,
    /// Δ̇, m/s.
    pub closing: S,
    /// v_t of A, m/s.
    pub slip: V3<S>,
}

impl<S: Scalar> Approach<S> {
    /// Contact with its point A at `lever` from the centre against N̂.
    #[inline(always)]
    pub(super) fn meeting(&self, normal: V3<S>, lever: S, depth: S, greatest: S, weight: S) -> Meeting<S> {
        let velocity = self.velocity + self.omega.cross(normal * -lever);
        let slip = velocity - normal * normal.dot(velocity);
        Meeting { depth, greatest, weight, closing: -normal.dot(self.velocity), slip }
    }
}

/// Forces of a material on a sphere.
pub(super) struct Law<S> {
    /// wF, N.
    pub force: S,
    /// U, J.
    pub energy: S,
    pub friction: S,
    pub friction_speed_squared: S,
}

impl<S: Scalar> Law<S> {
    /// Friction, N.
    #[inline(always)]
    pub(super) fn rubbing(&self, meeting: &Meeting<S>) -> V3<S> {
        let speed = (meeting.slip.norm_squared() + self.friction_speed_squared).sqrt();
        meeting.slip * -(self.friction * self.force / speed)
    }
}

impl MaterialLaw<f64> {
    /// Law of a material with all forces multiplied by `share`.
    pub(super) fn new(material: &Material, share: f64) -> Self {
        MaterialLaw {
            force: match &material.force {
                Force::Bilinear(spring) => ForceLaw::Bilinear(Spring::new(&spring.times(share))),
                Force::Deflection(law) => ForceLaw::Deflection(Box::new(DeflectionLaw::new(law, share))),
            },
            friction: material.friction,
            friction_speed_squared: material.friction_speed_m_s.powi(2),
            friction_factors: material.friction_factors.each_ref().map(|rows| Steps::new(rows)),
        }
    }
}

impl<S: Scalar> MaterialLaw<S> {
    #[inline(always)]
    pub(super) fn at(&self, meeting: &Meeting<S>) -> Law<S> {
        let (force, energy) = match &self.force {
            ForceLaw::Bilinear(spring) => spring.respond(meeting.depth, meeting.greatest),
            ForceLaw::Deflection(law) => law.respond(meeting.depth, meeting.greatest, meeting.closing),
        };
        let (force, friction_speed_squared) = (meeting.weight * force, self.friction_speed_squared);
        let [over_slip, over_force] = &self.friction_factors;
        let mut friction = self.friction;
        if over_slip.len() + over_force.len() > 0 {
            friction = over_slip.scale(over_force.scale(friction, force), meeting.slip.norm_squared().sqrt());
        }
        Law { force, energy, friction, friction_speed_squared }
    }
}
