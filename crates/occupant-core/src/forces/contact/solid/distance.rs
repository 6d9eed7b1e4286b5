//! Signed distance φ of a point from a body with thickness, and its gradient N̂.
//!
//! Ours; the report has only planes. φ is positive outside, the distance to the nearest point, and negative inside,
//! minus the depth below the nearest surface. One form covers all: a section along an axis between two ends, and
//! everything within ρ of it. With φ₂ the distance from the section and s the distance beyond the nearer end
//!
//! φ = hypot(φ₂⁺, s⁺) + min(max(φ₂, s), 0) − ρ                                                                      (6.1)
//!
//! The section is a convex polygon (prism, box, plate; half space: one without sides, with one end), a circle (disc; with
//! radius 0 a capsule) or the line of a circle, whose φ₂ is never negative (rim).
//!
//! Where φ has a kink, N̂ is by rule the unit normal of the first of the equally near faces.

use crate::forces::contact::face::V2;
use crate::motion::scalar::Scalar;
use crate::motion::vector::{M3, V3, v3};

/// Squares of lengths below this are no lengths, m².
const NOTHING: f64 = 1e-280;

/// Boxes are larger by this than what they hold, m.
const BOX_M: f64 = 1e-9;

/// A body with thickness in the axes of its frame.
#[derive(Clone, Debug)]
pub(crate) struct Form<S> {
    /// Origin of its own axes.
    pub centre: V3<S>,
    /// Its own axes; the third is the axis between its ends.
    pub axes: M3<S>,
    pub section: Section<S>,
    /// How far the ends are from the origin, ahead and behind.
    pub ends: [S; 2],
    /// ρ, radius of its edges and corners, by which section and ends are drawn in.
    pub rounding: S,
}

/// Section of a body across its axis.
#[derive(Clone, Debug)]
pub(crate) enum Section<S> {
    /// Sides of a convex polygon, counter-clockwise; without any the whole plane.
    Sides(Vec<Side<S>>),
    /// What is within this radius of the origin.
    Round(S),
    /// A circle of this radius about the origin.
    Ring(S),
}

/// A side of a polygon: the line from a point in a unit direction, and the part of it that is side.
#[derive(Clone, Debug)]
pub(crate) struct Side<S> {
    pub start: V2<S>,
    pub direction: V2<S>,
    /// Where it begins and ends along the direction, from the point.
    pub part: [S; 2],
}

/// Distance of a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Distance<S> {
    /// φ, m.
    pub phi: S,
    /// N̂ = ∇φ, a unit vector.
    pub normal: V3<S>,
}

/// Distance in a plane.
type Distance2<S> = (S, V2<S>);

impl<S: Scalar> Distance<S> {
    /// `yes` where the mask is true, else `no`.
    #[inline(always)]
    pub(crate) fn select(mask: S::Mask, yes: Self, no: Self) -> Self {
        Distance { phi: S::select(mask, yes.phi, no.phi), normal: V3::select(mask, yes.normal, no.normal) }
    }
}

impl<S: Scalar> Form<S> {
    /// φ and N̂ of `point`, in the axes of the frame.
    #[inline(always)]
    pub(crate) fn distance(&self, point: V3<S>) -> Distance<S> {
        let p = self.axes.into_frame(point - self.centre);
        let (phi_2, g) = self.section.distance(V2 { u: p.x, v: p.y });
        let (ahead, behind) = (p.z - self.ends[0], -p.z - self.ends[1]);
        let sense = S::select(ahead.lt(behind), -S::one(), S::one());
        let (beyond, o) = (ahead.max(behind), S::zero());
        let is_side = !phi_2.lt(beyond);
        let inside = V2 { u: S::select(is_side, S::one(), o), v: S::select(is_side, o, S::one()) };
        let (outside, n) = polar(V2 { u: phi_2.max(o), v: beyond.max(o) }, inside);
        let phi = outside + phi_2.max(beyond).min(o) - self.rounding; // (6.1)
        Distance { phi, normal: self.axes.out(v3(g.u * n.u, g.v * n.u, sense * n.v)) }
    }

    /// How far outside a box along the axes of the frame a point is at least along one of them, negative inside.
    #[inline(always)]
    pub(super) fn off_box([least, most]: &[V3<S>; 2], point: V3<S>) -> S {
        let (below, above) = (*least - point, point - *most);
        let [x, y, z] = [below.x.max(above.x), below.y.max(above.y), below.z.max(above.z)];
        x.max(y).max(z)
    }

    /// Whether it is all that is behind a plane.
    pub(super) fn is_half_space(&self) -> bool {
        matches!(&self.section, Section::Sides(sides) if sides.is_empty())
    }

    /// How much of a direction is across the axis, for a body whose side is round.
    #[inline(always)]
    pub(crate) fn round(&self, normal: V3<S>) -> S {
        if let Section::Sides(_) = self.section {
            return S::of(f64::NEG_INFINITY);
        }
        let along = self.axes.z.dot(normal);
        (S::one() - along * along).max(S::zero()).sqrt()
    }
}

impl Form<f64> {
    /// A box along the axes of the frame that holds all of it, its least and greatest coordinates, m.
    pub(super) fn bounds(&self) -> [V3<f64>; 2] {
        let axes = &self.axes;
        // how far it reaches along a direction
        let along = |way: V3<f64>| {
            let [u, v, w] = [axes.x.dot(way), axes.y.dot(way), axes.z.dot(way)];
            let across = match &self.section {
                Section::Sides(sides) if sides.is_empty() => f64::INFINITY,
                Section::Sides(sides) => {
                    let ends = sides.iter().flat_map(|side| side.part.map(|part| (side, part)));
                    let corner = |(Side { start, direction, .. }, part): (&Side<f64>, f64)| {
                        (start.u + direction.u * part) * u + (start.v + direction.v * part) * v
                    };
                    ends.map(corner).fold(f64::NEG_INFINITY, f64::max)
                }
                Section::Round(radius) | Section::Ring(radius) => radius * (u * u + v * v).sqrt(),
            };
            let end = (self.ends[0] * w).max(-self.ends[1] * w);
            self.centre.dot(way) + across + end + self.rounding + BOX_M
        };
        let [x, y, z] = [v3(1.0, 0.0, 0.0), v3(0.0, 1.0, 0.0), v3(0.0, 0.0, 1.0)];
        [v3(-along(-x), -along(-y), -along(-z)), v3(along(x), along(y), along(z))]
    }
}

impl<S: Scalar> Section<S> {
    #[inline(always)]
    fn distance(&self, p: V2<S>) -> Distance2<S> {
        match self {
            Section::Round(radius) => {
                let (out, radial) = polar(p, first());
                (out - *radius, radial)
            }
            Section::Ring(radius) => {
                let (out, radial) = polar(p, first());
                let sense = S::select(out.lt(*radius), -S::one(), S::one());
                ((out - *radius).abs(), V2 { u: radial.u * sense, v: radial.v * sense })
            }
            Section::Sides(sides) => from_sides(sides, p),
        }
    }
}

/// Largest distance from a side's line inside the polygon, distance from the nearest side outside.
#[inline(always)]
fn from_sides<S: Scalar>(sides: &[Side<S>], p: V2<S>) -> Distance2<S> {
    let o = S::zero();
    let (mut greatest, mut inner) = (S::of(f64::NEG_INFINITY), V2 { u: o, v: o });
    let (mut least, mut outer) = (S::of(f64::INFINITY), V2 { u: o, v: o });
    for Side { start, direction: d, part } in sides {
        let (u, v) = (p.u - start.u, p.v - start.v);
        // exact where the foot is on the side: nothing is lost by turning back and forth
        let off = u * d.v - v * d.u;
        let along = u * d.u + v * d.v;
        let past = along - along.max(part[0]).min(part[1]);
        let is_greater = greatest.lt(off);
        greatest = S::select(is_greater, off, greatest);
        inner = select2(is_greater, V2 { u: d.v, v: -d.u }, inner);
        let squared = off * off + past * past;
        let is_nearer = squared.lt(least);
        least = S::select(is_nearer, squared, least);
        outer = select2(is_nearer, V2 { u: d.v * off + d.u * past, v: d.v * past - d.u * off }, outer);
    }
    let out = greatest.gt(o) & least.gt(S::of(NOTHING));
    let distance = S::select(out, least, S::one()).sqrt();
    let outer = V2 { u: outer.u / distance, v: outer.v / distance };
    (S::select(out, distance, greatest), select2(out, outer, inner))
}

/// Length and direction of a vector; where it has none, `otherwise`.
#[inline(always)]
fn polar<S: Scalar>(v: V2<S>, otherwise: V2<S>) -> Distance2<S> {
    let squared = v.u * v.u + v.v * v.v;
    let some = squared.gt(S::of(NOTHING));
    let length = S::select(some, squared, S::one()).sqrt();
    let along = V2 { u: v.u / length, v: v.v / length };
    (S::select(some, length, S::zero()), select2(some, along, otherwise))
}

#[inline(always)]
fn first<S: Scalar>() -> V2<S> {
    V2 { u: S::one(), v: S::zero() }
}

#[inline(always)]
fn select2<S: Scalar>(mask: S::Mask, yes: V2<S>, no: V2<S>) -> V2<S> {
    V2 { u: S::select(mask, yes.u, no.u), v: S::select(mask, yes.v, no.v) }
}

impl<S: Copy> Form<S> {
    /// f applied to every number and the one in the same place of `other`; none for one of another form.
    pub(super) fn zip<A: Copy, T>(&self, other: &Form<A>, f: &impl Fn(S, A) -> T) -> Option<Form<T>> {
        let [a, b] = self.ends;
        Some(Form {
            centre: self.centre.zip(&other.centre, f),
            axes: self.axes.zip(&other.axes, f),
            section: self.section.zip(&other.section, f)?,
            ends: [f(a, other.ends[0]), f(b, other.ends[1])],
            rounding: f(self.rounding, other.rounding),
        })
    }
}

impl<S: Copy> Section<S> {
    fn zip<A: Copy, T>(&self, other: &Section<A>, f: &impl Fn(S, A) -> T) -> Option<Section<T>> {
        match (self, other) {
            (Section::Round(a), Section::Round(b)) => Some(Section::Round(f(*a, *b))),
            (Section::Ring(a), Section::Ring(b)) => Some(Section::Ring(f(*a, *b))),
            (Section::Sides(a), Section::Sides(b)) if a.len() == b.len() => {
                let side = |(a, b): (&Side<S>, &Side<A>)| Side {
                    start: a.start.zip(&b.start, f),
                    direction: a.direction.zip(&b.direction, f),
                    part: [f(a.part[0], b.part[0]), f(a.part[1], b.part[1])],
                };
                Some(Section::Sides(a.iter().zip(b).map(side).collect()))
            }
            _ => None,
        }
    }
}
