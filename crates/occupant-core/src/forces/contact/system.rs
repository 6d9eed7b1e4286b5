//! Contact of spheres with bounded plane surfaces: pair states, normal force, edge band, friction.
//!
//! Report: Figs 15 and 16. L = G − N̂·x_c, Δ = r + L; Δ > 0 is contact and Δ the deformation. Our decisions: bounded
//! faces with weight w = clamp01(1 − d/r); the states open, touching and passed; coplanar faces that share an edge act
//! as one; regularised friction. With (F, U) of the spring at Δ, the sphere receives the normal force wF N̂, the edge
//! force (U/r) ê, and at A = centre − r N̂ the friction −f·wF·v_t/√(v_t² + v_s²).
//!
//! The edge force is minus the gradient of wU over the position of the centre. It is conservative if it acts at the
//! centre, as any frictionless force on a sphere must. At A, with the rest of the contact force, it has the moment −U
//! N̂×ê about the centre. That moment does work on a turning segment that no potential stores. [`EdgeForce`] names both
//! versions.

use serde::{Deserialize, Serialize};

use crate::forces::contact::encounter::Approach;
use crate::forces::contact::face::{Offset, Outline, V2};
use crate::forces::contact::law::{Law, MaterialLaw, Meeting};
use crate::forces::contact::pane::Pane;
use crate::forces::contact::self_contact::SelfPairs;
use crate::forces::contact::shared::Shared;
use crate::forces::contact::solid::Solids;
use crate::forces::sphere::Use;
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;

/// Where the edge force acts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(rename = "EdgeForceChoice"))]
pub enum EdgeForce {
    /// At the point of contact, like the rest of the contact force, as in the report.
    // A = centre − r N̂, the specification's words
    #[serde(rename = "contact_point")]
    AtContactPoint,
    /// At the sphere's centre, where the edge force conserves energy on a turning segment too.
    #[default]
    #[serde(rename = "centre")]
    AtCentre,
}

/// A pair is open: apart, or not yet committed.
pub const OPEN: f64 = 0.0;
/// A pair touches.
pub const TOUCHING: f64 = 1.0;
/// The sphere went round the edge: no force until Δ ≤ 0.
pub const PASSED: f64 = 2.0;
/// A sphere that touches a solid remembers face 0 of it, with 1 more face 1, and so on.
pub(crate) const FACE: f64 = 3.0;
/// Faces that may be remembered of a solid, at most.
pub(crate) const MOST_FACES: f64 = 16.0;

/// One bounded part of a face with its material.
#[derive(Clone, Debug)]
pub struct Part<S> {
    /// Index of the surface in the model.
    pub surface: usize,
    pub(crate) outline: Outline<S>,
    pub(crate) law: MaterialLaw<S>,
}

/// A face that spheres meet: coplanar parts that share edges.
#[derive(Clone, Debug)]
pub struct Pair<S> {
    /// Plane axes in the face's frame, u × v = N̂.
    pub(crate) u: V3<S>,
    pub(crate) v: V3<S>,
    /// N̂.
    pub(crate) normal: V3<S>,
    /// The parts.
    pub parts: Vec<Part<S>>,
    /// 1 where Δ_m is kept after opening, else 0.
    pub(crate) retain: S,
}

/// Plane of a pair: N̂ and r + G, so that Δ = reach − N̂·x.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane<S> {
    pub(crate) normal: V3<S>,
    pub(crate) reach: S,
}

impl<S: Scalar> Plane<S> {
    /// Δ = r + L (92) with L = G − N̂·x_c (89), for a centre in the face's frame.
    #[inline(always)]
    pub(crate) fn depth(&self, centre: V3<S>) -> S {
        self.reach - self.normal.dot(centre)
    }
}

/// Pairs of one sphere with faces of one frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// Index of the sphere.
    pub sphere: usize,
    /// Index of the frame.
    pub frame: usize,
    /// As what its faces use the sphere: by what the spine leans on, or by contact.
    pub by: Use,
    /// Its pairs.
    pub pairs: std::ops::Range<usize>,
}

/// Stored state of a pair between steps, of a sphere on one of several solids met as one, or of a pane; `greatest` of a pane is
/// the largest fraction of its limit that a segment has reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairHistory<S> {
    /// [`OPEN`], [`TOUCHING`] or [`PASSED`], or the remembered face of a solid.
    pub phase: S,
    /// Δ_m, largest committed deformation, m.
    pub greatest: S,
}

/// A touching pair at one instant, axes of the face's frame.
#[derive(Clone, Copy, Debug)]
pub struct Touch<S> {
    /// Index of the sphere.
    pub sphere: usize,
    /// Index of the frame of the surface.
    pub frame: usize,
    /// Index of the pair.
    pub pair: usize,
    /// Which of the pair's parts is nearest and gives the material (an index, as a number per lane). Of two spheres of the body
    /// 0 is the second, 1 the first.
    pub part: S,
    /// w, greater than 0 where the pair exerts a force: in one lane at least.
    pub weight: S,
    /// N̂.
    pub normal: V3<S>,
    /// Δ, m.
    pub depth: S,
    /// Δ̇, speed of the centre towards the face, m/s.
    pub closing: S,
    /// Velocity of the centre relative to the face, m/s.
    pub velocity: V3<S>,
    /// wF, N.
    pub normal_force: S,
    /// Edge force, N.
    pub edge: V3<S>,
    /// Friction, N.
    pub friction: V3<S>,
    /// wU, recoverable energy, J.
    pub stored: S,
    /// Slip: tangential velocity of A relative to the surface, m/s.
    pub slip: V3<S>,
    /// Normal, edge and friction force on the sphere, space axes, N.
    pub force: V3<S>,
}

/// All pairs of spheres and faces.
#[derive(Clone, Debug, Default)]
pub struct ContactSystem<S> {
    /// Groups of pairs by sphere and frame.
    pub groups: Vec<Group>,
    pub(crate) planes: Vec<Plane<S>>,
    /// The pairs.
    pub pairs: Shared<Pair<S>>,
    /// 1 where the edge force acts at A, 0 at the centre.
    pub(crate) edge_lever: S,
    /// Bodies with thickness; their pairs are numbered behind those of faces.
    pub(crate) solids: Solids<S>,
    /// Pairs of spheres of the body, numbered behind all that is remembered of solids.
    pub(crate) own: SelfPairs<S>,
    /// Segments that carry faces, whose frames stand behind all others.
    pub(crate) carriers: Vec<usize>,
    /// What breaks as a whole, remembered behind all pairs.
    pub(crate) panes: Vec<Pane>,
    /// A face farther than this, m, cannot be met within one step unless something goes faster than any crash.
    pub(crate) reach_of_a_step: S,
}

impl<S: Scalar> ContactSystem<S> {
    /// Forces of pair `i` on its sphere in the lanes where it is `live`: in contact and not passed; `None` if there are none
    /// in any lane. At an accepted step the pair's history first takes over the present position.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "one call, inlined")]
    pub(crate) fn touch(
        &self,
        accepted: bool,
        group: &Group,
        i: usize,
        depth: S,
        live: S::Mask,
        approach: &Approach<S>,
        past: &mut [PairHistory<S>],
    ) -> Option<Touch<S>> {
        let (o, touching) = (S::zero(), S::of(TOUCHING));
        let pair = &self.pairs[i];
        let radius = approach.radius;
        let (offset, nearest) = pair.nearest(approach.centre);
        let live = live & !pair.is_gone(nearest, past);
        let w = S::select(live, weight(offset.distance, radius), o);
        if accepted {
            let history = &mut past[i];
            let on = w.gt(o);
            let phase = S::select(on, touching, S::of(PASSED));
            history.phase = S::select(live, phase, history.phase);
            history.greatest = S::select(on, history.greatest.max(depth), history.greatest);
        }
        if !S::any(w.gt(o)) {
            return None;
        }
        Some(pair.press(group, i, nearest, approach, depth, w, &offset, past))
    }

    /// Opens a pair that is apart, and forgets its crush unless its material keeps it.
    #[inline(always)]
    pub(crate) fn open(&self, i: usize, depth: S, history: &mut PairHistory<S>) {
        let o = S::zero();
        let contact = depth.gt(o);
        let closed = history.phase.gt(o) | history.greatest.gt(o);
        if S::any(!contact & closed) {
            let kept = history.greatest * self.pairs[i].retain;
            history.phase = S::select(contact, history.phase, o);
            history.greatest = S::select(contact, history.greatest, kept);
        }
    }
}

impl Pair<f64> {
    /// Whether the projection of a centre is on a part, in the frame of the face.
    pub(crate) fn is_over(&self, part: &Part<f64>, centre: V3<f64>) -> bool {
        part.outline.holds(V2 { u: self.u.dot(centre), v: self.v.dot(centre) })
    }
}

impl<S: Scalar> Pair<S> {
    /// How far the projection of a centre is from a part, in the frame of the face, m.
    pub(crate) fn beside(&self, part: &Part<S>, centre: V3<S>) -> S {
        part.outline.offset(V2 { u: self.u.dot(centre), v: self.v.dot(centre) }).distance
    }

    /// Offset from the union of the parts, and the index of the nearest part in each lane (as a number).
    #[inline(always)]
    pub(super) fn nearest(&self, centre: V3<S>) -> (Offset<S>, S) {
        // P (88), in coordinates of the plane
        let point = V2 { u: self.u.dot(centre), v: self.v.dot(centre) };
        let mut best = self.parts[0].outline.offset(point);
        let mut index = S::zero();
        for (i, part) in self.parts.iter().enumerate().skip(1) {
            let offset = part.outline.offset(point);
            let nearer = offset.distance.lt(best.distance);
            best = Offset {
                distance: S::select(nearer, offset.distance, best.distance),
                away: V2 {
                    u: S::select(nearer, offset.away.u, best.away.u),
                    v: S::select(nearer, offset.away.v, best.away.v),
                },
            };
            index = S::select(nearer, S::of(i as f64), index);
        }
        (best, index)
    }

    /// Forces at deformation `depth` and weight `w` > 0.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "one call; the values are already in registers")]
    fn press(
        &self,
        group: &Group,
        index: usize,
        part: S,
        approach: &Approach<S>,
        depth: S,
        w: S,
        offset: &Offset<S>,
        past: &[PairHistory<S>],
    ) -> Touch<S> {
        let radius = approach.radius;
        let meeting = approach.meeting(self.normal, radius, depth, past[index].greatest, w);
        let law = self.law(part, &meeting, past);
        let stored = w * law.energy;
        let edge_force = law.energy * S::select(w.lt(S::one()), S::one(), S::zero()) / radius;
        let edge = (self.u * offset.away.u + self.v * offset.away.v) * edge_force;

        Touch {
            sphere: group.sphere,
            frame: group.frame,
            pair: index,
            part,
            weight: w,
            normal: self.normal,
            depth,
            closing: meeting.closing,
            velocity: approach.velocity,
            normal_force: law.force,
            edge,
            friction: law.rubbing(&meeting),
            stored,
            slip: meeting.slip,
            force: V3::zero(),
        }
    }

    /// Where nothing is left of the part that each lane is nearest to.
    #[inline(always)]
    fn is_gone(&self, part: S, past: &[PairHistory<S>]) -> S::Mask {
        let mut gone = S::truth(false);
        for (i, own) in self.parts.iter().enumerate() {
            if own.law.breaks.is_some() {
                gone = gone | is_part(part, i) & own.law.is_gone(past);
            }
        }
        gone
    }

    /// Force and friction of the part that each lane is nearest to.
    #[inline(always)]
    fn law(&self, part: S, meeting: &Meeting<S>, past: &[PairHistory<S>]) -> Law<S> {
        let o = S::zero();
        let mut law = Law { force: o, energy: o, friction: o, friction_speed_squared: o };
        for (i, p) in self.parts.iter().enumerate() {
            let here = is_part(part, i);
            if S::any(here) {
                let l = p.law.at(meeting, past);
                law = Law {
                    force: S::select(here, l.force, law.force),
                    energy: S::select(here, l.energy, law.energy),
                    friction: S::select(here, l.friction, law.friction),
                    friction_speed_squared: S::select(here, l.friction_speed_squared, law.friction_speed_squared),
                };
            }
        }
        law
    }
}

impl Touch<f64> {
    /// The same as the other sphere of a pair feels it.
    pub(crate) fn mirrored(&self, spheres: [usize; 2]) -> Self {
        let (normal, friction) = (-self.normal, -self.friction);
        let (velocity, slip, force) = (-self.velocity, -self.slip, -self.force);
        let (sphere, part) = if self.sphere == spheres[0] { (spheres[1], 1.0) } else { (spheres[0], 0.0) };
        Touch { sphere, part, normal, friction, velocity, slip, force, ..*self }
    }
}

/// Where the nearest part is number `i`.
#[inline(always)]
pub(super) fn is_part<S: Scalar>(part: S, i: usize) -> S::Mask {
    S::of(i as f64 - 0.5).lt(part) & part.lt(S::of(i as f64 + 0.5))
}

/// w = clamp01(1 − d/r).
#[inline(always)]
pub(super) fn weight<S: Scalar>(distance: S, radius: S) -> S {
    (S::one() - distance / radius).clamp01()
}
