//! Course and length of the webbing of a chain, and the gradient of that length.
//!
//! With centres x and radii r of the nodes (0 of points), D = |x₊ − x₋|, a = r₋ − r₊, a span has the length S = √(D² −
//! a²). A sphere with p and q from its centre to the nodes on either side wraps the webbing by W = 2π − θ − acos((r −
//! r₋)/|p|) − acos((r − r₊)/|q|), with θ the angle from p to q about the normal m = ±p × q/|p × q|, which keeps its
//! sense; the length is Σ S + Σ r W. Forces are −T times its gradient, so the approximation in it (each sphere wraps in
//! the plane of the three centres) creates no energy. Nodes that the webbing has left are skipped.
//!
//! Where webbing has friction on a sphere, its gradient is divided: the webbing before pulls along its free span, and
//! so does the webbing behind.

use std::f64::consts::TAU;

use super::MOST_NODES;
use super::past::NodePast;
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;

/// A node's geometry: a point, or a sphere of this radius.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place<S> {
    pub(super) centre: V3<S>,
    pub(super) radius: S,
    pub(super) is_sphere: bool,
    /// Whether a strap ends here.
    pub(super) rubs: bool,
    pub(super) may_leave: bool,
    /// Stored normal of a sphere's plane.
    pub(super) sense: V3<S>,
}

impl<S: Scalar> Place<S> {
    #[inline(always)]
    pub(super) fn nowhere() -> Self {
        let (o, none) = (S::zero(), V3::zero());
        Place { centre: none, radius: o, is_sphere: false, rubs: false, may_leave: false, sense: none }
    }
}

/// Webbing geometry at a node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bend<S> {
    /// Length of the span that ends here, and of the arc on a sphere, m.
    pub(super) span: S,
    pub(super) arc: S,
    /// −∂ℓ/∂x of the webbing before and after the node.
    pub(super) back: V3<S>,
    pub(super) ahead: V3<S>,
    /// W, rad.
    pub(super) wrap: S,
    /// m.
    pub(super) normal: V3<S>,
    /// From the centre to the tangent point on a sphere, relative to the radius. For a sphere with friction that it has
    /// left: to the nearest point of the free span, and the distance along the span to that, m.
    pub(super) touch: V3<S>,
    pub(super) beside: S,
}

impl<S: Scalar> Bend<S> {
    /// No node.
    #[inline(always)]
    pub(super) fn none() -> Self {
        let (o, none) = (S::zero(), V3::zero());
        Bend { span: o, arc: o, back: none, ahead: none, wrap: o, normal: none, touch: none, beside: o }
    }
}

/// Deflection angle of webbing with these gradients, rad.
#[inline(always)]
pub(super) fn turn<S: Scalar>(back: V3<S>, ahead: V3<S>) -> S {
    let sine = back.cross(ahead).norm_squared().max(S::of(1e-60)).sqrt();
    sine.atan2(-back.dot(ahead))
}

#[inline(always)]
fn is_on<S: Scalar>(place: &Place<S>, past: &NodePast<S>) -> S::Mask {
    if place.may_leave { past.is_on() } else { S::truth(true) }
}

/// Centre and radius of the next node that the webbing passes.
#[inline(always)]
fn behind<S: Scalar>(places: &[Place<S>], past: &[NodePast<S>; MOST_NODES]) -> [(V3<S>, S); MOST_NODES] {
    let count = places.len();
    let mut behind = [(places[count - 1].centre, places[count - 1].radius); MOST_NODES];
    for k in (1..count - 1).rev() {
        let (next, on) = (&places[k + 1], is_on(&places[k + 1], &past[k + 1]));
        let (centre, radius) = behind[k + 1];
        behind[k] = (V3::select(on, next.centre, centre), S::select(on, next.radius, radius));
    }
    behind
}

/// The webbing along `places`; `past` gives the nodes passed, and senses of normals.
#[inline(always)]
pub(super) fn bends<S: Scalar>(
    places: &[Place<S>],
    past: &[NodePast<S>; MOST_NODES],
    bends: &mut [Bend<S>; MOST_NODES],
) {
    let (o, none) = (S::zero(), V3::zero());
    let count = places.len();
    bends[..count].fill(Bend::none());
    let behind = behind(places, past);
    // from the node before: where it is, and what its arc gives to the gradient at the next node
    let (mut before, mut given) = ((places[0].centre, places[0].radius), none);
    // what the span and arc of each node give to the gradient at the node before
    let mut lead = [none; MOST_NODES];
    for k in 1..count {
        let (place, on) = (&places[k], is_on(&places[k], &past[k]));
        let way = place.centre - before.0;
        let (square, a) = (way.norm_squared(), before.1 - place.radius);
        let span = (square - a * a).max(o).sqrt();
        let pull = way * (span / square.max(S::of(1e-24))); // t u = S (x₊ − x₋)/D²
        let bend = &mut bends[k];
        (bend.span, bend.back, lead[k]) = (span, given - pull, pull);
        let mut gives = none;
        if place.is_sphere {
            let arc = wrapped(place, before, behind[k]);
            (bend.wrap, bend.arc) = (arc.wrap, place.radius * arc.wrap);
            (bend.normal, bend.touch) = (arc.normal, arc.touch);
            if place.rubs {
                (bend.back, bend.ahead) = (bend.back - arc.to_before, -arc.to_next);
                let (nearest, beside) = nearest(place, before.0, behind[k].0);
                bend.touch = V3::select(on, arc.touch, nearest * (S::one() / place.radius));
                bend.beside = beside;
            } else {
                bend.back -= arc.to_before + arc.to_next;
            }
            lead[k] += arc.to_before;
            gives = arc.to_next;
        }
        if place.may_leave {
            bend.span = S::select(on, span, o);
            bend.arc = S::select(on, bend.arc, o);
            bend.back = V3::select(on, bend.back, none);
        }
        before = (V3::select(on, place.centre, before.0), S::select(on, place.radius, before.1));
        given = V3::select(on, gives, given);
    }
    let mut next = none;
    for k in (0..count).rev() {
        let on = is_on(&places[k], &past[k]);
        let ahead = if places[k].rubs { bends[k].ahead + next } else { next };
        bends[k].ahead = V3::select(on, ahead, none);
        next = V3::select(on, lead[k], next);
    }
}

/// An arc on a sphere, and its contribution to −gradient at the neighbouring nodes.
struct Arc<S> {
    wrap: S,
    normal: V3<S>,
    touch: V3<S>,
    to_before: V3<S>,
    to_next: V3<S>,
}

#[inline(always)]
fn wrapped<S: Scalar>(place: &Place<S>, before: (V3<S>, S), next: (V3<S>, S)) -> Arc<S> {
    let sense = place.sense;
    let (p, q) = (before.0 - place.centre, next.0 - place.centre);
    let (pp, qq) = (p.norm_squared().max(S::of(1e-24)), q.norm_squared().max(S::of(1e-24)));
    let cross = p.cross(q);
    let backward = cross.dot(sense).lt(S::zero());
    let square = cross.norm_squared();
    // in line with both neighbours the plane is undetermined: it stays what it was
    let in_line = square.lt(pp * qq * S::of(1e-24));
    let area = square.max(S::of(1e-60)).sqrt();
    let normal = V3::select(in_line, sense, cross * (S::select(backward, -S::one(), S::one()) / area));
    let angle = S::select(backward, -area, area).atan2(p.dot(q));
    let angle = S::select(angle.lt(S::zero()), angle + S::of(TAU), angle);
    let r = place.radius;
    let (one, inverse) = (S::one(), S::one() / pp.sqrt());
    let cosine = ((r - before.1) * inverse).max(-one).min(one);
    let other = ((r - next.1) / qq.sqrt()).max(-one).min(one);
    let sine = (one - cosine * cosine).max(S::zero()).sqrt();
    Arc {
        wrap: S::of(TAU) - angle - cosine.acos() - other.acos(),
        normal,
        // p/|p| turned about −m
        touch: (p * cosine - normal.cross(p) * sine) * inverse,
        to_before: p.cross(normal) * (r / pp),
        to_next: normal.cross(q) * (r / qq),
    }
}

/// From the centre to the nearest point of a free span from `before` to `next`, and the distance along the span, m.
#[inline(always)]
fn nearest<S: Scalar>(place: &Place<S>, before: V3<S>, next: V3<S>) -> (V3<S>, S) {
    let (p, span) = (before - place.centre, next - before);
    let square = span.norm_squared().max(S::of(1e-24));
    let part = (-p.dot(span) / square).clamp01();
    (p + span * part, part * square.sqrt())
}
