//! Signed distance from the envelope of a bag, and the part of it that a sphere displaces.
//!
//! A dome extends from its mount plane along its axis: at the height h and the distance ϱ from the axis, with f = √(ϱ² +
//! (h + R_f − H)²) − R_f and g = ϱ − a,
//!
//! ```text
//! s = hypot(max(f + e, 0), max(g + e, 0)) + min(max(f, g) + e, 0) − e
//! ```
//!
//! It has no lower end, so it pushes nothing towards its mount. For balls and capsules s is the distance from their
//! middle minus R. While a bag unfolds all its lengths, measured from the mount, are λ times the full ones.

use super::data::{Bag, Shape};
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;

/// Constants of a shape, in the axes of its frame, from the mount.
#[derive(Clone, Copy, Debug)]
pub(super) enum ShapeLaw<S> {
    Dome { axis: V3<S>, depth: S, radius: S, face: S, edge: S },
    Sphere { centre: V3<S>, radius: S },
    Capsule { from: V3<S>, along: V3<S>, radius: S },
}

/// Distance of a point to the bag.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near<S> {
    /// s, m.
    pub(super) distance: S,
    /// ∇s.
    pub(super) gradient: V3<S>,
    /// Depth of a sphere around the point at which the bag bottoms out, minus its own, m; dome only.
    pub(super) left: Option<S>,
    /// Distance from the centre relative to R; ball or capsule only.
    pub(super) from_middle: Option<S>,
}

impl ShapeLaw<f64> {
    pub(super) fn new(bag: &Bag) -> Self {
        let seen = |point: nalgebra::Point3<f64>| V3::of(&(point - bag.mount_m));
        match bag.shape {
            Shape::Dome { axis, depth_m, radius_m, face_radius_m, edge_m } => ShapeLaw::Dome {
                axis: V3::of(&axis.normalize()),
                depth: depth_m,
                radius: radius_m,
                face: face_radius_m,
                edge: edge_m,
            },
            Shape::Sphere { centre_m, radius_m } => ShapeLaw::Sphere { centre: seen(centre_m), radius: radius_m },
            Shape::Capsule { ends_m: [from, to], radius_m } => {
                ShapeLaw::Capsule { from: seen(from), along: V3::of(&(to - from)), radius: radius_m }
            }
        }
    }
}

impl<S: Copy> ShapeLaw<S> {
    /// Its kind; shapes of the same kind can be evaluated side by side.
    pub(super) fn kind(&self) -> usize {
        match self {
            ShapeLaw::Dome { .. } => 0,
            ShapeLaw::Sphere { .. } => 1,
            ShapeLaw::Capsule { .. } => 2,
        }
    }

    pub(super) fn zip<A: Copy, T>(&self, other: &ShapeLaw<A>, f: &impl Fn(S, A) -> T) -> Option<ShapeLaw<T>> {
        Some(match (self, other) {
            (
                ShapeLaw::Dome { axis, depth, radius, face, edge },
                ShapeLaw::Dome { axis: axis_b, depth: depth_b, radius: radius_b, face: face_b, edge: edge_b },
            ) => ShapeLaw::Dome {
                axis: axis.zip(axis_b, f),
                depth: f(*depth, *depth_b),
                radius: f(*radius, *radius_b),
                face: f(*face, *face_b),
                edge: f(*edge, *edge_b),
            },
            (ShapeLaw::Sphere { centre, radius }, ShapeLaw::Sphere { centre: centre_b, radius: radius_b }) => {
                ShapeLaw::Sphere { centre: centre.zip(centre_b, f), radius: f(*radius, *radius_b) }
            }
            (
                ShapeLaw::Capsule { from, along, radius },
                ShapeLaw::Capsule { from: from_b, along: along_b, radius: radius_b },
            ) => ShapeLaw::Capsule {
                from: from.zip(from_b, f),
                along: along.zip(along_b, f),
                radius: f(*radius, *radius_b),
            },
            _ => return None,
        })
    }
}

impl<S: Scalar> ShapeLaw<S> {
    /// Distance of the point `seen` from the mount, with all lengths scaled by `scale`.
    #[inline(always)]
    pub(super) fn near(&self, seen: V3<S>, scale: S) -> Near<S> {
        let seen = seen * (S::one() / scale);
        let mut near = match self {
            ShapeLaw::Dome { .. } => self.near_dome(seen),
            ShapeLaw::Sphere { centre, radius } => near_round(seen - *centre, *radius),
            ShapeLaw::Capsule { from, along, radius } => {
                let ahead = seen - *from;
                let part = (ahead.dot(*along) / along.norm_squared()).clamp01();
                near_round(ahead - *along * part, *radius)
            }
        };
        near.distance = near.distance * scale;
        if let Some(left) = &mut near.left {
            *left = *left * scale;
        }
        near
    }

    #[inline(always)]
    fn near_dome(&self, seen: V3<S>) -> Near<S> {
        let ShapeLaw::Dome { axis, depth, radius, face, edge } = *self else {
            return near_round(seen, S::one());
        };
        let o = S::zero();
        let height = seen.dot(axis);
        let across = seen - axis * height;
        let beside = length(across);
        let arm = seen + axis * (face - depth);
        let from_centre = length(arm);
        let (f, g) = (from_centre - face, beside - radius);
        let (over_face, over_side) = ((f + edge).max(o), (g + edge).max(o));
        let round = (over_face * over_face + over_side * over_side).sqrt();
        let (to_face, to_side) = (arm * (S::one() / from_centre), across * (S::one() / beside));
        let inner = V3::select(g.lt(f), to_face, to_side);
        let outer = (to_face * over_face + to_side * over_side) * (S::one() / round.max(S::of(1e-12)));
        Near {
            distance: round + (f.max(g) + edge).min(o) - edge,
            gradient: V3::select(round.gt(o), outer, inner),
            left: Some(depth),
            from_middle: None,
        }
    }

    /// R_f, m; none of a flat face.
    #[inline(always)]
    pub(super) fn face(&self) -> Option<S> {
        match self {
            ShapeLaw::Dome { face, .. } => Some(*face),
            ShapeLaw::Sphere { radius, .. } => Some(*radius),
            ShapeLaw::Capsule { .. } => None,
        }
    }
}

/// Distance to a round shape, from its centre to the point `seen`.
#[inline(always)]
fn near_round<S: Scalar>(seen: V3<S>, radius: S) -> Near<S> {
    let far = length(seen);
    Near { distance: far - radius, gradient: seen * (S::one() / far), left: None, from_middle: Some(far / radius) }
}

/// |v|, bounded away from 0.
#[inline(always)]
fn length<S: Scalar>(v: V3<S>) -> S {
    (v.norm_squared() + S::of(1e-24)).sqrt()
}

/// Area and volume that a sphere of radius r displaces at the depth δ: V(δ) and A = V′(δ), m² and m³.
///
/// Behind a flat face A = π(2rδ − δ²) until δ = r. Behind a face of radius R, the distance of the centres being
/// d = R + r − δ, A = π(4d²R² − (d² − r² + R²)²)/(4d²) until d² = |R² − r²|. From there on A stays: the body behind the
/// sphere's centre is as wide as the sphere.
#[inline(always)]
pub(super) fn displaced<S: Scalar>(depth: S, r: S, face: Option<S>) -> [S; 2] {
    let (pi, third) = (S::of(std::f64::consts::PI), S::of(1.0 / 3.0));
    let [area, _] = section(depth, r, face);
    let Some(big) = face else {
        let d = depth.min(r);
        return [area, pi * d * d * (r - d * third) + area * (depth - d)];
    };
    let apart = big + r - depth;
    let d = apart.max(least_apart(r, big));
    let cap = big + r - d;
    let lens = d * d + S::of(2.0) * d * (r + big) - S::of(3.0) * (r - big) * (r - big);
    [area, pi * cap * cap * lens / (S::of(12.0) * d) + area * (d - apart)]
}

/// A and A′ of [`displaced`], m² and m.
#[inline(always)]
pub(super) fn section<S: Scalar>(depth: S, r: S, face: Option<S>) -> [S; 2] {
    let (o, pi) = (S::zero(), S::of(std::f64::consts::PI));
    let Some(big) = face else {
        let d = depth.min(r);
        return [pi * d * (r + r - d), (pi + pi) * (r - d)];
    };
    let (rr, bb) = (r * r, big * big);
    let (apart, least) = (big + r - depth, least_apart(r, big));
    let d = apart.max(least);
    let dd = d * d;
    let inner = dd - rr + bb;
    let slope = pi * inner * (dd + rr - bb) / (S::of(2.0) * dd * d);
    [pi * (bb - inner * inner / (S::of(4.0) * dd)), S::select(apart.gt(least), slope, o)]
}

/// Depth from which A is constant, m.
#[inline(always)]
pub(super) fn full_depth<S: Scalar>(r: S, face: Option<S>) -> S {
    match face {
        Some(big) => big + r - least_apart(r, big),
        None => r,
    }
}

/// Distance of the centres of sphere and face at which A is largest.
#[inline(always)]
fn least_apart<S: Scalar>(r: S, big: S) -> S {
    (big * big - r * r).abs().sqrt().max(S::of(1e-6))
}

impl Shape {
    /// Its volume, m³.
    pub fn volume_m3(&self) -> f64 {
        size(self)[0]
    }
}

/// The volume of a full bag, m³, and the area of its envelope, m².
pub(crate) fn size(shape: &Shape) -> [f64; 2] {
    use std::f64::consts::PI;
    match *shape {
        Shape::Dome { depth_m: depth, radius_m: a, face_radius_m: face, edge_m: edge, .. } => {
            // the face meets the side at this height; the rounding takes the fourth part of a torus's corner off
            let reach = a.min(face);
            let rise = face - (face * face - reach * reach).max(0.0).sqrt();
            let side = (depth - rise).max(0.0);
            let corner = (1.0 - 0.25 * PI) * edge * edge * 2.0 * PI * (a - 0.5 * edge).max(0.0);
            let cap = PI * rise * rise * (face - rise / 3.0);
            [PI * a * a * side + cap - corner, PI * a * a + 2.0 * PI * a * side + 2.0 * PI * face * rise]
        }
        Shape::Sphere { radius_m: r, .. } => [4.0 / 3.0 * PI * r * r * r, 4.0 * PI * r * r],
        Shape::Capsule { ends_m: [from, to], radius_m: r } => {
            let along = (to - from).norm();
            [PI * r * r * (along + 4.0 / 3.0 * r), 2.0 * PI * r * (along + 2.0 * r)]
        }
    }
}
