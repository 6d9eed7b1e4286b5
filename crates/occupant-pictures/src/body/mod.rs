//! The occupant in pictures: rounded parts fixed to the segments. Only for display; the physics uses only the contact
//! spheres.
//!
//! A part is the convex hull of two ellipsoids whose axes are the segment's. Limbs are capsules through their spheres;
//! the trunk has the elliptic section that gives it its mass and inertia.

mod snapshot;

use nalgebra::Vector3;
use occupant_core::body::{Body, ContactSphere, Limb, Pair, Segment, SegmentProperties};

pub use snapshot::{PATCH_M, Snapshot};

use occupant_files::mcap::scene::body::slim_axes_m;
pub use occupant_files::mcap::scene::body::{Tone, sphere_centre_m};

/// Drawn width of the trunk relative to the width of equal inertia.
const SLIM: f64 = 0.85;
/// Radius of the drawn neck relative to the head.
const NECK: f64 = 0.5;
/// Size of the nose relative to the head's radius.
const NOSE: f64 = 0.22;
/// Distance of a sphere from its segment's long axis beyond which it is not part of the limb, m.
const OFF_AXIS_M: f64 = 0.02;
/// Distance from the end of a limb within which its last sphere forms the end, m.
const NEAR_END_M: f64 = 0.02;

/// An ellipsoid along its segment's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lump {
    /// Centre from the centre of gravity, segment axes.
    pub centre_m: Vector3<f64>,
    /// Half axes.
    pub half_m: Vector3<f64>,
}

/// The convex hull of two ellipsoids.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// The segment it is fixed to.
    pub segment: Segment,
    /// Its clothing.
    pub tone: Tone,
    /// Its ends.
    pub ends: [Lump; 2],
}

/// All parts of a body, in the order of the segments.
pub fn parts(body: &Body) -> Vec<Part> {
    let of_segment = |segment| {
        let marks = body.tree.landmarks_at(segment);
        let ends = match segment {
            _ if Some(segment) == marks.head => head(body, segment),
            _ if Some(segment) == marks.chest => upper_torso(body, segment),
            _ if Some(segment) == marks.pelvis => lower_torso(body, segment),
            _ => match marks.arms().find(|arm| body.tree.carries(segment, arm.upper)) {
                Some(arm) => vec![clavicle(body, segment, &arm)],
                None if body.tree.is_trunk(segment) => vec![trunk(body, segment)],
                None => limb(body, segment),
            },
        };
        let tone = Tone::of(body.tree, segment);
        ends.into_iter().map(move |ends| Part { segment, tone, ends })
    };
    body.tree.segments().flat_map(of_segment).collect()
}

/// Neck, head and a nose that shows its direction. Without a sphere the head's width follows from its inertia.
fn head(body: &Body, segment: Segment) -> Vec<[Lump; 2]> {
    let p = body.segment(segment);
    let own = body.spheres.iter().filter(|sphere| sphere.segment == segment);
    let (centre, radius) = match own.max_by(|a, b| a.radius_m.total_cmp(&b.radius_m)) {
        Some(sphere) => (sphere_centre_m(body, sphere), sphere.radius_m),
        None => {
            let radius = mean_radius(p).min(0.5 * p.length_m);
            (Vector3::z() * (p.length_m - radius) - p.cg_m(), radius)
        }
    };
    let skull = ball(centre, radius);
    let neck = NECK * radius;
    let bridge = centre + Vector3::new(0.8 * radius, 0.0, 0.1 * radius);
    let nose = centre + Vector3::new(radius, 0.0, -0.1 * radius);
    vec![
        [ball(body.joint_m(segment) - p.cg_m(), neck), ball(centre, neck)],
        [skull, skull],
        [ball(bridge, NOSE * radius), ball(nose, NOSE * radius)],
    ]
}

/// The chest, the bar between the shoulders, and the part of the neck that does not turn with the head.
fn upper_torso(body: &Body, segment: Segment) -> Vec<[Lump; 2]> {
    let p = body.segment(segment);
    let marks = body.tree.landmarks_at(segment);
    let arms = &marks.arms;
    let neck = || marks.head.map_or(0.0, |head| NECK * limb_radius(body, head));
    let shoulder = arms.left.or(arms.right).map_or_else(neck, |arm| limb_radius(body, arm.upper));
    let mut parts = vec![trunk(body, segment)];
    parts.extend(bar(body, segment, arms, shoulder));
    if let Some(above_m) = body.neck_above_m(segment).filter(|above_m| *above_m > 0.0) {
        let upper = Vector3::z() * p.length_m - p.cg_m();
        parts.push([0.0, above_m].map(|above_m| ball(upper + Vector3::z() * above_m, shoulder)));
    }
    parts
}

/// The pelvis and the bar between the hips.
fn lower_torso(body: &Body, segment: Segment) -> Vec<[Lump; 2]> {
    let legs = &body.tree.landmarks_at(segment).legs;
    let hip = 0.9 * limb_radius(body, legs.left.or(legs.right).map_or(segment, |leg| leg.upper));
    [trunk(body, segment)].into_iter().chain(bar(body, segment, legs, hip)).collect()
}

/// A capsule from the joint of the left limb to that of the right one, if the segment carries both.
fn bar(body: &Body, segment: Segment, limbs: &Pair<Option<Limb>>, radius_m: f64) -> Option<[Lump; 2]> {
    let cg_m = body.segment(segment).cg_m();
    let limbs = [limbs.left?, limbs.right?];
    let ends = limbs.map(|limb| ball(body.socket_m(limb.upper) - cg_m, radius_m));
    limbs.iter().all(|limb| body.tree.carries(segment, limb.upper)).then_some(ends)
}

/// A capsule from a segment's own joint to that of the arm that it carries.
fn clavicle(body: &Body, segment: Segment, arm: &Limb) -> [Lump; 2] {
    let (cg_m, radius_m) = (body.segment(segment).cg_m(), limb_radius(body, arm.upper));
    [ball(body.joint_m(segment) - cg_m, 0.6 * radius_m), ball(body.socket_m(arm.upper) - cg_m, radius_m)]
}

/// The elliptic column of a segment of the trunk, rounded at its ends.
fn trunk(body: &Body, segment: Segment) -> [Lump; 2] {
    let p = body.segment(segment);
    let (a, b) = slim_axes_m(p, SLIM);
    let half = Vector3::new(a, b, 0.25 * p.length_m);
    let lower = -p.cg_from_lower_end_m + half.z;
    let end = |z: f64| Lump { centre_m: on_axis(p, z), half_m: half };
    [end(lower), end(lower + 2.0 * half.z)]
}

/// Capsules from one sphere of a limb to the next, and on to its ends.
fn limb(body: &Body, segment: Segment) -> Vec<[Lump; 2]> {
    let p = body.segment(segment);
    let (lower, upper) = (-p.cg_from_lower_end_m, p.length_m - p.cg_from_lower_end_m);
    let mut stations = stations(body, segment);
    let radius = limb_radius(body, segment);
    let first = stations.first().copied().unwrap_or((upper, radius));
    if first.0 - first.1 > lower + NEAR_END_M {
        stations.insert(0, (lower, first.1));
    }
    let last = stations.last().copied().unwrap_or((lower, radius));
    if last.0 < upper - NEAR_END_M {
        stations.push((upper, last.1));
    }
    let at = |&(z, r): &(f64, f64)| ball(on_axis(p, z), r);
    let along = stations.windows(2).map(|two| [at(&two[0]), at(&two[1])]);
    let mut parts: Vec<_> = along.collect();
    match sole(p, radius) {
        Some(sole) => parts.push(sole),
        None => parts.extend(beside(body, segment, &stations)),
    }
    parts
}

/// Spheres off a limb's axis, such as the toes of a leg without a separate foot, each with the nearest position on the
/// limb.
fn beside(body: &Body, segment: Segment, stations: &[(f64, f64)]) -> Vec<[Lump; 2]> {
    let p = body.segment(segment);
    let own = body.spheres.iter().filter(|s| s.segment == segment && !is_on_axis(s));
    let capsule = |sphere: &ContactSphere| {
        let centre_m = sphere_centre_m(body, sphere);
        let apart = |station: &(f64, f64)| (station.0 - centre_m.z).abs();
        let &(z, radius_m) = stations.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)))?;
        Some([ball(on_axis(p, z), radius_m.min(sphere.radius_m)), ball(centre_m, sphere.radius_m)])
    };
    own.filter_map(capsule).collect()
}

fn is_on_axis(sphere: &ContactSphere) -> bool {
    sphere.centre_from_lower_end_m.coords.xy().norm() < OFF_AXIS_M
}

/// Front part of a segment longer than high: a foot, from the heel to the same distance beyond its centre of gravity.
fn sole(p: &SegmentProperties, radius: f64) -> Option<[Lump; 2]> {
    let half_m = p.cg_beside_m.x;
    let height_m = radius - p.cg_from_lower_end_m;
    let end = |x: f64| ball(Vector3::new(x, -p.cg_beside_m.y, height_m), radius);
    (half_m.abs() > 0.5 * p.length_m).then(|| [end(-half_m), end(half_m)])
}

/// Heights and radii of the spheres on a segment's long axis, from the lower end up.
fn stations(body: &Body, segment: Segment) -> Vec<(f64, f64)> {
    let cg = body.segment(segment).cg_from_lower_end_m;
    let own = body.spheres.iter().filter(|s| s.segment == segment);
    let on_axis = own.filter(|s| is_on_axis(s));
    let mut stations: Vec<_> = on_axis.map(|s| (s.centre_from_lower_end_m.z - cg, s.radius_m)).collect();
    stations.sort_by(|a, b| a.0.total_cmp(&b.0));
    stations
}

/// Radius of a limb's upper end: that of its highest sphere, else from its inertia.
fn limb_radius(body: &Body, segment: Segment) -> f64 {
    let highest = stations(body, segment).last().map(|s| s.1);
    highest.unwrap_or_else(|| SLIM * mean_radius(body.segment(segment)))
}

/// Radius of the cylinder with the segment's mass and I_z.
fn mean_radius(p: &SegmentProperties) -> f64 {
    (2.0 * p.inertia_kg_m2.z.max(0.0) / p.mass_kg).sqrt()
}

/// The point of a segment's long axis at a height over the centre of gravity.
fn on_axis(p: &SegmentProperties, height_m: f64) -> Vector3<f64> {
    Vector3::new(-p.cg_beside_m.x, -p.cg_beside_m.y, height_m)
}

fn ball(centre_m: Vector3<f64>, radius_m: f64) -> Lump {
    Lump { centre_m, half_m: Vector3::repeat(radius_m) }
}
