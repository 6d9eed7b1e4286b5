//! Friction of webbing on a sphere: the mark at which its two straps meet.
//!
//! The straps before and behind meet at a mark on the surface, at the arc σ behind the point where the webbing comes
//! onto the sphere: ℓ₋ = S₋ + σ, ℓ₊ = S₊ + rW − σ. The mark is fixed to the segment, so σ falls by the travel of the
//! touching point along the webbing over the surface: with its direction τ from the centre and the normal m of the
//! webbing's plane in segment axes σ̇ = r m·(τ × τ̇), exact over a step in one plane, to second order where the plane
//! turns. Rotation across the webbing moves it sideways without resistance (our decision). With T₋û₋ + T₊û₊ at the
//! centre and the moment −r(T₊ − T₋)m, Σ T ℓ̇ is the power of the webbing. All friction of the arc acts at the mark,
//! over which webbing slips as over a ring with the angle W.
//!
//! The mark does not leave the arc: where the surface carries it to an end, the straps exchange webbing there without
//! slip.

use super::past::NodePast;
use super::path::{Bend, Place};
use super::site::{NodeLaw, SiteLaw};
use crate::forces::element::Instant;
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;

/// A material mark on the webbing at one instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mark<S> {
    /// σ, m.
    pub(super) way: S,
    /// Distance by which the surface has carried it beyond the end of the arc since the last commit, m; negative before
    /// its start.
    pub(super) beyond: S,
}

impl<S: Scalar> NodeLaw<S> {
    /// Whether it is a sphere with friction.
    pub(super) fn is_rough(&self) -> bool {
        self.rubs && self.is_sphere()
    }

    /// A direction in the axes of the sphere's segment.
    #[inline(always)]
    fn on_sphere(&self, at: &Instant<'_, S>, v: V3<S>) -> V3<S> {
        match self.segment(at.spheres) {
            Some(segment) => at.k.axes[segment].into_frame(v),
            None => v,
        }
    }

    /// The mark on a sphere that the webbing passes.
    #[inline(always)]
    pub(super) fn mark(&self, at: &Instant<'_, S>, place: &Place<S>, bend: &Bend<S>, past: &NodePast<S>) -> Mark<S> {
        let (o, before, touch) = (S::zero(), past.touch(), self.on_sphere(at, bend.touch));
        let normal = (past.normal() + self.on_sphere(at, bend.normal)) * S::of(0.5);
        let turned = normal.dot(before.cross(touch)).atan2(before.dot(touch));
        let free = past.way + place.radius * turned;
        let way = free.max(o).min(bend.arc.max(o));
        Mark { way, beyond: free - way }
    }

    /// Stores the geometry on a sphere; a new contact's mark begins in the middle.
    #[inline(always)]
    pub(super) fn remember(
        &self,
        at: &Instant<'_, S>,
        place: &Place<S>,
        bend: &Bend<S>,
        way: S,
        past: &mut NodePast<S>,
    ) {
        if let SiteLaw::Sphere(_) = self.site {
            past.set_normal(self.on_sphere(at, bend.normal));
            past.across = bend.wrap;
        }
        if self.is_rough() {
            past.way = S::select(past.is_on(), way, place.radius * bend.wrap * S::of(0.5));
            past.set_touch(self.on_sphere(at, bend.touch));
        }
    }
}
