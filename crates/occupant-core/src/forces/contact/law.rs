//! Forces of a material on a sphere: normal force, and friction at the point of contact.
//!
//! With (F, U) of the material's force law and the weight w the normal force is wF; friction is −f φ ψ wF v_t/√(v_t² + v_s²),
//! φ and ψ tables over the slip speed and the normal force (6.11).

use crate::forces::contact::encounter::Approach;
use crate::forces::contact::material::{Breaking, Force, Limit, Material};
use crate::forces::contact::system::PairHistory;
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
    pub(crate) breaks: Option<Box<BreakLaw<S>>>,
}

/// Constants of what breaks.
#[derive(Clone, Debug)]
pub(crate) struct BreakLaw<S> {
    /// Where the pane stands in what is remembered.
    pub(crate) pane: usize,
    /// 1/limit over force (1/N) and over work (1/J); one of them is 0.
    pub(crate) per: [S; 2],
    pub(crate) left: Option<ForceLaw<S>>,
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
            force: ForceLaw::new(&material.force, share),
            friction: material.friction,
            friction_speed_squared: material.friction_speed_m_s.powi(2),
            friction_factors: material.friction_factors.each_ref().map(|rows| Steps::new(rows)),
            breaks: material.breaks.as_ref().map(|breaks| Box::new(BreakLaw::new(breaks, share))),
        }
    }
}

impl ForceLaw<f64> {
    fn new(force: &Force, share: f64) -> Self {
        match force {
            Force::Bilinear(spring) => ForceLaw::Bilinear(Spring::new(&spring.times(share))),
            Force::Deflection(law) => ForceLaw::Deflection(Box::new(DeflectionLaw::new(law, share))),
        }
    }

    /// Depth of the last point of a force function, m; infinite of a spring.
    pub(super) fn last_point_m(&self) -> f64 {
        if let ForceLaw::Deflection(law) = self { law.last_point() } else { f64::INFINITY }
    }
}

impl BreakLaw<f64> {
    /// Of a pane whose place is not known yet.
    fn new(breaks: &Breaking, share: f64) -> Self {
        let per = match breaks.limit {
            Limit::Force(limit) => [1.0 / limit, 0.0],
            Limit::Energy(limit) => [0.0, 1.0 / limit],
        };
        BreakLaw { pane: usize::MAX, per, left: breaks.left.as_ref().map(|left| ForceLaw::new(left, share)) }
    }
}

impl<S: Scalar> ForceLaw<S> {
    #[inline(always)]
    fn respond(&self, meeting: &Meeting<S>) -> (S, S) {
        match self {
            ForceLaw::Bilinear(spring) => spring.respond(meeting.depth, meeting.greatest),
            ForceLaw::Deflection(law) => law.respond(meeting.depth, meeting.greatest, meeting.closing),
        }
    }

    /// Work of loading up to the largest depth, J.
    #[inline(always)]
    fn work(&self, meeting: &Meeting<S>) -> S {
        let top = meeting.depth.max(meeting.greatest);
        match self {
            ForceLaw::Bilinear(spring) => spring.work(top),
            ForceLaw::Deflection(law) => law.work(top),
        }
    }
}

impl<S: Scalar> MaterialLaw<S> {
    /// `past` is what all remember, panes too.
    #[inline(always)]
    pub(super) fn at(&self, meeting: &Meeting<S>, past: &[PairHistory<S>]) -> Law<S> {
        let (mut force, mut energy) = self.force.respond(meeting);
        if let Some(breaks) = &self.breaks {
            let (is_broken, o) = (past[breaks.pane].is_broken(), S::zero());
            if S::any(is_broken) {
                let left = match &breaks.left {
                    Some(left) => left.respond(meeting),
                    None => (o, o),
                };
                (force, energy) = (S::select(is_broken, left.0, force), S::select(is_broken, left.1, energy));
            }
        }
        let (force, friction_speed_squared) = (meeting.weight * force, self.friction_speed_squared);
        let [over_slip, over_force] = &self.friction_factors;
        let mut friction = self.friction;
        if over_slip.len() + over_force.len() > 0 {
            friction = over_slip.scale(over_force.scale(friction, force), meeting.slip.norm_squared().sqrt());
        }
        Law { force, energy, friction, friction_speed_squared }
    }

    /// Where nothing is left of it.
    #[inline(always)]
    pub(super) fn is_gone(&self, past: &[PairHistory<S>]) -> S::Mask {
        match &self.breaks {
            Some(breaks) if breaks.left.is_none() => past[breaks.pane].is_broken(),
            _ => S::truth(false),
        }
    }

    /// What a sphere takes of the limit of a pane while it is whole, as a part of it; of another pane or of what never breaks 0.
    #[inline(always)]
    pub(super) fn strain(&self, meeting: &Meeting<S>, pane: usize) -> S {
        let Some(breaks) = &self.breaks else { return S::zero() };
        if breaks.pane != pane {
            return S::zero();
        }
        let [per_newton, per_joule] = breaks.per;
        meeting.weight * (self.force.respond(meeting).0 * per_newton + self.force.work(meeting) * per_joule)
    }
}
