//! The path of a fast sphere: no step may carry it through an object or past its middle.
//!
//! A contact begins at the end of a step. If a sphere moves by less than its radius in a step, its centre is then still
//! outside, on the side from which it came. A step in which it would move farther ends at first contact: from the
//! position at the commit its centre is projected straight ahead, relative to what it may meet, by its distance from
//! there. This approaches the point of contact from below, whatever the shape. In contact it approaches by at most half
//! its radius per step, so that it does not jump past the axis of a bar. Slower spheres are not checked: they cost
//! nothing, and their steps are those of the integrator.

use super::hints::Near;
use super::{ContactHints, ContactSystem, FASTEST_M_S, Group, PASSED, PairHistory, weight};
use crate::forces::element::Instant;
use crate::forces::pace::Pace;
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;

/// Largest approach of a sphere in contact per step, as a fraction of its radius.
const PART: f64 = 0.5;
/// Distance of the step's end beyond first contact, as a fraction of the radius.
const BEYOND: f64 = 1e-3;
/// Distance from first contact, as a fraction of the radius, that counts as contact.
const THERE: f64 = 1e-4;
/// Fraction of its speed below which an approaching sphere only grazes: its penetration per step is at most this
/// fraction of its path.
const GRAZES: f64 = 0.02;
/// Largest number of iterations along a path; a centre that moves straight towards a plane needs one.
const MOST_LEAPS: usize = 60;
/// Relative speeds are looked for above this, m/s: with the sum of two such and their turning nothing reaches [`FASTEST_M_S`].
const FAST_M_S: f64 = 40.0;

/// What a step may add to the speed of a sphere relative to a frame: by this factor, and by this much, m/s. It is 4000 g over half a
/// millisecond.
const FASTER: f64 = 1.5;
const FASTER_M_S: f64 = 20.0;

/// A centre that goes straight on.
#[derive(Clone, Copy)]
pub(super) struct Way<S> {
    pub centre: V3<S>,
    pub velocity: V3<S>,
    pub speed: S,
    /// Of what must not pass: the radius, or those of both spheres of a pair.
    pub radius: S,
    /// How long it is followed, s.
    longest: S,
}

impl<S: Scalar> Way<S> {
    #[inline(always)]
    pub(super) fn new(centre: V3<S>, velocity: V3<S>, radius: S, longest: S) -> Self {
        Way { centre, velocity, speed: velocity.norm_squared().sqrt(), radius, longest }
    }

    /// Where it is so fast that a step may carry it too far.
    #[inline(always)]
    pub(super) fn is_fast(&self) -> S::Mask {
        (self.radius * S::of(PART)).lt(self.speed * self.longest)
    }

    /// Bounds `pace` for a pair that is `apart` by the gap and normal that `gap` tells of a centre.
    #[inline(always)]
    pub(super) fn until_touch(&self, apart: S::Mask, pace: &mut Pace<S>, gap: impl FnMut(V3<S>) -> (S, V3<S>)) {
        let (hits, time) = self.follow(apart, gap);
        let per_speed = self.radius / self.speed;
        pace.bound(hits, per_speed, time + per_speed * S::of(BEYOND));
    }

    /// Bounds `pace` for a pair that is in touch.
    #[inline(always)]
    pub(super) fn in_touch(&self, touches: S::Mask, normal: V3<S>, pace: &mut Pace<S>) {
        let closing = -normal.dot(self.velocity);
        let closes = touches & (self.speed * S::of(GRAZES)).lt(closing);
        let most = self.radius * S::of(PART) / closing;
        pace.bound(closes, most, most);
    }

    /// Where it touches, and when, s.
    #[inline(always)]
    fn follow(&self, apart: S::Mask, mut gap: impl FnMut(V3<S>) -> (S, V3<S>)) -> (S::Mask, S) {
        let (mut time, mut hits, mut goes_on) = (S::zero(), S::truth(false), apart);
        for _ in 0..MOST_LEAPS {
            let (way, normal) = gap(self.centre + self.velocity * time);
            let is_there = way.lt(self.radius * S::of(THERE));
            let closes = (self.speed * S::of(GRAZES)).lt(-normal.dot(self.velocity));
            hits = hits | (goes_on & is_there & closes);
            goes_on = goes_on & !is_there;
            time = S::select(goes_on, time + way / self.speed, time);
            goes_on = goes_on & time.lt(self.longest);
            if !S::any(goes_on) {
                break;
            }
        }
        (hits, time)
    }
}

impl<S: Scalar> ContactSystem<S> {
    /// The longest step that the integrator can take, s.
    #[inline(always)]
    pub(in crate::forces) fn longest_step(&self) -> S {
        self.reach_of_a_step / S::of(FASTEST_M_S)
    }

    /// How far a sphere may come in a step, m: what [`FASTEST_M_S`] allows, or as fast as things move now.
    #[inline(always)]
    pub(super) fn reach(&self, at: &Instant<'_, S>) -> S {
        let (mut squared, mut of_frames) = (S::zero(), S::zero());
        // many in succession are on one segment, or of one frame
        let mut last = usize::MAX;
        for site in at.spheres {
            if std::mem::replace(&mut last, site.segment) != site.segment {
                squared = squared.max(at.k.joint_velocity[site.segment].norm_squared());
            }
        }
        last = usize::MAX;
        for group in self.groups.iter().chain(&self.solids.groups) {
            if std::mem::replace(&mut last, group.frame) != group.frame {
                of_frames = of_frames.max(at.frame(group.frame).velocity.norm_squared());
            }
        }
        if !S::any(squared.max(of_frames).gt(S::of(FAST_M_S * FAST_M_S))) {
            return self.reach_of_a_step;
        }
        // twice, for what a step adds
        let speed = (squared.sqrt() + of_frames.sqrt()) * S::of(2.0);
        self.reach_of_a_step.max(speed * self.longest_step())
    }

    /// How far a sphere on its way may come in a step, m: at most `reach`, which holds for all spheres.
    #[inline(always)]
    pub(super) fn reach_of(&self, way: &Way<S>, reach: S) -> S {
        let own = (way.speed * S::of(FASTER) + S::of(FASTER_M_S)) * self.longest_step();
        S::select(self.reach_of_a_step.lt(reach), reach, own.min(reach))
    }

    /// Bounds the pace for the near pairs of a group, number `g`.
    #[inline(always)]
    pub(super) fn look_ahead<const SOLID: bool>(
        &self,
        (g, group): (usize, &Group),
        way: &Way<S>,
        past: &mut [PairHistory<S>],
        hints: &mut ContactHints<S>,
    ) {
        let near = hints.near_of(g, group);
        if near.is_empty() || !S::any(way.is_fast()) {
            return;
        }
        let near = &hints.near[near];
        if S::IS_WIDE {
            self.within::<SOLID>(near, way, past, &mut hints.pace);
        } else {
            self.apart::<SOLID>(near, way, past, &mut hints.pace);
        }
    }

    /// Bounds the pace for these pairs, in the instructions of the caller.
    #[inline(always)]
    fn within<const SOLID: bool>(
        &self,
        near: &[Near<S>],
        way: &Way<S>,
        past: &mut [PairHistory<S>],
        pace: &mut Pace<S>,
    ) {
        for near in near {
            let (i, on) = (near.pair as usize, near.lanes & way.is_fast());
            if SOLID {
                self.ahead_of_solid(i, on, way, past, pace);
            } else {
                self.ahead_of_face(i, on, way, past, pace);
            }
        }
    }

    /// The same by itself: few runs need it, and the kernel without it is smaller.
    #[cold]
    #[inline(never)]
    fn apart<const SOLID: bool>(
        &self,
        near: &[Near<S>],
        way: &Way<S>,
        past: &mut [PairHistory<S>],
        pace: &mut Pace<S>,
    ) {
        self.within::<SOLID>(near, way, past, pace);
    }

    /// Bounds the pace for pair `i` of solids, in the lanes of `on`.
    #[inline(always)]
    fn ahead_of_solid(&self, i: usize, on: S::Mask, way: &Way<S>, past: &mut [PairHistory<S>], pace: &mut Pace<S>) {
        let j = i - self.pairs.len();
        let mut nearest = |centre| self.solids.nearest(j, centre, way.radius, past, false);
        let here = nearest(way.centre);
        let touches = here.depth.gt(S::zero());
        way.in_touch(on & touches, here.normal, pace);
        way.until_touch(on & !touches, pace, |centre| {
            let ahead = nearest(centre);
            (-ahead.depth, ahead.normal)
        });
    }

    /// The same for a pair of faces: a plane, and what of it is face where the centre meets it.
    #[inline(always)]
    fn ahead_of_face(&self, i: usize, on: S::Mask, way: &Way<S>, past: &[PairHistory<S>], pace: &mut Pace<S>) {
        let (plane, on) = (&self.planes[i], on & past[i].phase.lt(S::of(PASSED)));
        let touches = plane.depth(way.centre).gt(S::zero());
        way.in_touch(on & touches, plane.normal, pace);
        let closing = -plane.normal.dot(way.velocity);
        let apart = on & !touches & (way.speed * S::of(GRAZES)).lt(closing);
        let time = -plane.depth(way.centre) / closing;
        let (offset, _) = self.pairs[i].nearest(way.centre + way.velocity * time);
        let hits = apart & weight(offset.distance, way.radius).gt(S::zero()) & time.lt(way.longest);
        let per_speed = way.radius / way.speed;
        pace.bound(hits, per_speed, time + per_speed * S::of(BEYOND));
    }
}
