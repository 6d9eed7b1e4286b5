//! Distance from a point of a plane to a bounded face of that plane.
//!
//! Bounded faces are our decision (the report's planes have no printed edges): d = distance from the projection of a
//! sphere's centre to the face, 0 inside; ê = the in-plane direction away from the face.

use crate::motion::scalar::Scalar;

/// A point or a direction in the two coordinates of a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct V2<S> {
    /// Along the plane's first axis.
    pub u: S,
    /// Along the plane's second axis.
    pub v: S,
}

/// A side of a convex polygon, run through counter-clockwise.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge<S> {
    start: V2<S>,
    direction: V2<S>,
    length: S,
}

/// Outline of a face in plane coordinates.
#[derive(Clone, Debug)]
pub(crate) enum Outline<S> {
    /// Convex polygon.
    Polygon(Vec<Edge<S>>),
    /// Disc.
    Disc {
        /// Centre.
        centre: V2<S>,
        /// Radius, m.
        radius: S,
    },
    /// The whole plane.
    Unbounded,
}

/// Offset of a point from the nearest point of a face.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Offset<S> {
    /// d, m; 0 inside.
    pub distance: S,
    /// ê; 0 inside.
    pub away: V2<S>,
}

impl<S: Copy> V2<S> {
    pub(super) fn zip<A: Copy, T>(&self, other: &V2<A>, f: &impl Fn(S, A) -> T) -> V2<T> {
        V2 { u: f(self.u, other.u), v: f(self.v, other.v) }
    }
}

impl<S: Copy> Outline<S> {
    /// f applied to every number and the one in the same place of `other`; none if that is of another kind or has another
    /// number of sides.
    pub(crate) fn zip<A: Copy, T>(&self, other: &Outline<A>, f: &impl Fn(S, A) -> T) -> Option<Outline<T>> {
        match (self, other) {
            (Outline::Polygon(a), Outline::Polygon(b)) if a.len() == b.len() => {
                let edge = |(a, b): (&Edge<S>, &Edge<A>)| Edge {
                    start: a.start.zip(&b.start, f),
                    direction: a.direction.zip(&b.direction, f),
                    length: f(a.length, b.length),
                };
                Some(Outline::Polygon(a.iter().zip(b).map(edge).collect()))
            }
            (Outline::Disc { centre, radius }, Outline::Disc { centre: centre_b, radius: radius_b }) => {
                Some(Outline::Disc { centre: centre.zip(centre_b, f), radius: f(*radius, *radius_b) })
            }
            (Outline::Unbounded, Outline::Unbounded) => Some(Outline::Unbounded),
            _ => None,
        }
    }
}

impl<S: Scalar> Outline<S> {
    /// Polygon through corners given counter-clockwise in plane coordinates.
    pub(crate) fn polygon(corners: &[[f64; 2]]) -> Self {
        let edges = (0..corners.len()).map(|i| {
            let ([u, v], [u2, v2]) = (corners[i], corners[(i + 1) % corners.len()]);
            let length = ((u2 - u).powi(2) + (v2 - v).powi(2)).sqrt();
            Edge {
                start: V2 { u: S::of(u), v: S::of(v) },
                direction: V2 { u: S::of((u2 - u) / length), v: S::of((v2 - v) / length) },
                length: S::of(length),
            }
        });
        Outline::Polygon(edges.collect())
    }

    /// Offset of `point` from the face.
    #[inline(always)]
    pub(crate) fn offset(&self, point: V2<S>) -> Offset<S> {
        let o = S::zero();
        match self {
            Outline::Unbounded => Offset { distance: o, away: V2 { u: o, v: o } },
            Outline::Disc { centre, radius } => {
                let (u, v) = (point.u - centre.u, point.v - centre.v);
                let from_centre = (u * u + v * v).sqrt();
                let inverse = S::one() / from_centre.max(*radius);
                let distance = (from_centre - *radius).max(o);
                outside(distance, V2 { u: u * inverse, v: v * inverse })
            }
            Outline::Polygon(edges) => from_polygon(edges, point),
        }
    }
}

/// Distance beyond the line of a side from which a point is outside whatever the rounding, m.
const OUTSIDE_M: f64 = 1e-9;

impl Outline<f64> {
    /// Whether d = 0 of `point`.
    pub(crate) fn holds(&self, point: V2<f64>) -> bool {
        let is_outside = match self {
            Outline::Polygon(edges) => edges.iter().any(|edge| edge.outward(point) > OUTSIDE_M),
            Outline::Disc { .. } | Outline::Unbounded => false,
        };
        !is_outside && self.offset(point).distance == 0.0
    }
}

/// The offset with ê only where d > 0.
#[inline(always)]
fn outside<S: Scalar>(distance: S, away: V2<S>) -> Offset<S> {
    let o = S::zero();
    let out = distance.gt(o);
    Offset { distance, away: V2 { u: S::select(out, away.u, o), v: S::select(out, away.v, o) } }
}

#[inline(always)]
fn from_polygon<S: Scalar>(edges: &[Edge<S>], p: V2<S>) -> Offset<S> {
    let o = S::zero();
    // largest signed distance outside any side: ≤ 0 inside the polygon
    let mut greatest = S::of(f64::NEG_INFINITY);
    for edge in edges {
        greatest = greatest.max(edge.outward(p));
    }
    let out = greatest.gt(o);
    if !S::any(out) {
        return Offset { distance: o, away: V2 { u: o, v: o } };
    }
    let mut least = S::of(f64::INFINITY);
    let mut from = V2 { u: o, v: o };
    for edge in edges {
        let gap = edge.gap(p);
        let squared = gap.u * gap.u + gap.v * gap.v;
        let nearer = squared.lt(least);
        least = S::select(nearer, squared, least);
        from = V2 { u: S::select(nearer, gap.u, from.u), v: S::select(nearer, gap.v, from.v) };
    }
    let distance = S::select(out, least.sqrt(), o);
    let inverse = S::one() / distance.max(S::of(1e-300));
    outside(distance, V2 { u: from.u * inverse, v: from.v * inverse })
}

impl<S: Scalar> Edge<S> {
    /// Signed distance of `p` from the side's line, positive outside the polygon.
    #[inline(always)]
    fn outward(&self, p: V2<S>) -> S {
        (p.u - self.start.u) * self.direction.v - (p.v - self.start.v) * self.direction.u
    }

    /// From the nearest point of the side to `p`.
    #[inline(always)]
    fn gap(&self, p: V2<S>) -> V2<S> {
        let (u, v) = (p.u - self.start.u, p.v - self.start.v);
        let along = (u * self.direction.u + v * self.direction.v).max(S::zero()).min(self.length);
        V2 { u: u - along * self.direction.u, v: v - along * self.direction.v }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_outline_holds_the_points_that_are_not_beside_it() {
        let roof = [[0.0, 0.0], [0.9, 0.1], [1.1, 0.7], [0.3, 0.8]];
        let disc = Outline::Disc { centre: V2 { u: 0.5, v: 0.5 }, radius: 0.4 };
        for outline in [Outline::polygon(&roof), disc, Outline::Unbounded] {
            let mut held = 0;
            let grid = (-20..=40).flat_map(|i| (-20..=40).map(move |j| [0.04 * f64::from(i), 0.04 * f64::from(j)]));
            let sides = (0..4).flat_map(|i| (0..=20).map(move |j| (i, f64::from(j) / 20.0)));
            let on_sides = sides.flat_map(|(i, part)| {
                let ([u, v], [u2, v2]) = (roof[i], roof[(i + 1) % 4]);
                [0.0, 1e-16, 1e-12, 1e-8].map(|off| [u + part * (u2 - u) + off, v + part * (v2 - v) - off])
            });
            for [u, v] in grid.chain(on_sides) {
                let is_held = outline.holds(V2 { u, v });
                assert_eq!(is_held, outline.offset(V2 { u, v }).distance == 0.0, "{u} {v}");
                held += u32::from(is_held);
            }
            assert!(held > 200, "{held}");
        }
    }
}
