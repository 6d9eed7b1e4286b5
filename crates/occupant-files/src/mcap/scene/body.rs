//! The occupant's shape: limbs and trunk on one topic, contact spheres on another. For the eye only; the physics knows
//! the spheres alone.
//!
//! A segment is drawn as the elliptic cylinder that has its mass and inertia, slimmed so that spheres and belts stand out:
//! with half axes a along X and b along Y, I_z = ¼M(a² + b²) and I_x − I_y = ¼M(b² − a²) give
//! a² = 2(I_z − I_x + I_y)/M and b² = 2(I_z + I_x − I_y)/M.

use nalgebra::{UnitQuaternion, Vector3};
use occupant_core::body::{Body, ContactSphere, Limb, Pair, Segment, SegmentProperties, Tree};

use super::primitive::{cylinder, ellipsoid};
use super::{Color, entity};
use crate::mcap::transforms::FrameNames;
use crate::mcap::wire::Wire;

/// Drawn width relative to the width of equal inertia.
const SLIM: f64 = 0.8;
/// Width of the neck relative to head and neck.
const NECK: f64 = 0.55;
/// Length of the drawn neck relative to head and neck.
const NECK_LENGTH: f64 = 0.6;
const SKIN: Color = Color(0.85, 0.65, 0.52, 1.0);
const SHIRT: Color = Color(0.30, 0.42, 0.58, 1.0);
const TROUSERS: Color = Color(0.25, 0.27, 0.33, 1.0);
const SPHERE: Color = Color(0.95, 0.80, 0.30, 0.35);

/// Limbs and trunk, one entity per segment.
pub fn write(wire: &mut Wire, body: &Body, frames: &FrameNames) {
    for segment in body.tree.segments() {
        entity(wire, 0, frames.of(segment), body.tree[segment].name, |w| {
            write_segment(w, body, segment);
        });
    }
}

/// Contact spheres, one entity per sphere.
pub fn write_spheres(wire: &mut Wire, body: &Body, frames: &FrameNames) {
    for (i, sphere) in body.spheres.iter().enumerate() {
        let centre = sphere_centre_m(body, sphere);
        let size = Vector3::repeat(2.0 * sphere.radius_m);
        entity(wire, 0, frames.of_sphere(body, i), &sphere.name, |w| {
            ellipsoid(w, centre, size, SPHERE);
        });
    }
}

fn write_segment(wire: &mut Wire, body: &Body, segment: Segment) {
    let p = body.segment(segment);
    let marks = body.tree.landmarks_at(segment);
    let color = Tone::of(body.tree, segment).color();
    let is_carried = |arm: &Limb| body.tree.carries(segment, arm.upper);
    if let Some(arm) = marks.arms().find(is_carried).filter(|_| Some(segment) != marks.chest) {
        let ends = [body.joint_m(segment), body.socket_m(arm.upper)].map(|end| end - p.cg_m());
        return bar(wire, ends, half_axes_m(body, arm.upper).0, color);
    }
    let length = if Some(segment) == marks.head { NECK_LENGTH * p.length_m } else { p.length_m };
    let [lower, upper] = [0.0, length].map(|z| Vector3::z() * z - p.cg_m());
    let (a, b) = half_axes_m(body, segment);
    let size = Vector3::new(2.0 * a, 2.0 * b, length);
    cylinder(wire, (lower + upper) * 0.5, UnitQuaternion::identity(), size, color);
    let cap = Vector3::new(2.0 * a, 2.0 * b, (a + b).min(0.5 * length));
    ellipsoid(wire, lower, cap, color);
    ellipsoid(wire, upper, cap, color);
    if Some(segment) == marks.head {
        for s in body.spheres.iter().filter(|s| s.segment == segment) {
            let centre = sphere_centre_m(body, s);
            ellipsoid(wire, centre, Vector3::repeat(2.0 * s.radius_m), SKIN);
        }
    }
    if Some(segment) == marks.chest {
        girdle(wire, body, segment, marks.arms, color);
        let radius = marks.arms().next().map_or(a, |arm| half_axes_m(body, arm.upper).0);
        if let Some(height_m) = body.neck_above_m(segment).filter(|height_m| *height_m > 0.0) {
            let size = Vector3::new(2.0 * radius, 2.0 * radius, height_m);
            cylinder(wire, upper + Vector3::z() * (0.5 * height_m), UnitQuaternion::identity(), size, color);
        }
    }
    if Some(segment) == marks.pelvis {
        girdle(wire, body, segment, marks.legs, color);
    }
}

/// The bar between shoulders or hips, if the segment carries both.
fn girdle(wire: &mut Wire, body: &Body, segment: Segment, limbs: Pair<Option<Limb>>, color: Color) {
    let (Some(left), Some(right)) = (limbs.left, limbs.right) else { return };
    if [left, right].iter().all(|limb| body.tree.carries(segment, limb.upper)) {
        let ends = [left, right].map(|limb| body.socket_m(limb.upper) - body.segment(segment).cg_m());
        bar(wire, ends, half_axes_m(body, left.upper).0, color);
    }
}

/// A bar with rounded ends.
fn bar(wire: &mut Wire, ends: [Vector3<f64>; 2], radius_m: f64, color: Color) {
    let along = ends[0] - ends[1];
    let turn = UnitQuaternion::rotation_between(&Vector3::z(), &along).unwrap_or_default();
    let size = Vector3::new(2.0 * radius_m, 2.0 * radius_m, along.norm());
    cylinder(wire, (ends[0] + ends[1]) * 0.5, turn, size, color);
    for end in ends {
        ellipsoid(wire, end, Vector3::repeat(2.0 * radius_m), color);
    }
}

/// a and b as drawn.
fn half_axes_m(body: &Body, segment: Segment) -> (f64, f64) {
    let width = if Some(segment) == body.tree.landmarks_at(segment).head { SLIM * NECK } else { SLIM };
    slim_axes_m(body.segment(segment), width)
}

/// `width` times a and b.
pub fn slim_axes_m(p: &SegmentProperties, width: f64) -> (f64, f64) {
    let i = p.inertia_kg_m2;
    let axis = |moment: f64| width * (2.0 * moment.max(0.0) / p.mass_kg).sqrt();
    (axis(i.z - i.x + i.y), axis(i.z + i.x - i.y))
}

/// Centre of a sphere from its segment's centre of gravity, segment axes, m.
pub fn sphere_centre_m(body: &Body, sphere: &ContactSphere) -> Vector3<f64> {
    sphere.centre_from_lower_end_m.coords - body.segment(sphere.segment).cg_m()
}

/// Clothing of a part of the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// Head, neck, forearms, hands.
    Skin,
    /// Upper trunk, clavicles, upper arms.
    Shirt,
    /// Lower trunk, legs.
    Trousers,
}

impl Tone {
    /// Clothing of a segment's body part.
    pub fn of(tree: &Tree, segment: Segment) -> Self {
        let marks = tree.landmarks_at(segment);
        if Some(segment) == marks.pelvis || marks.legs().any(|leg| tree.is_of(segment, &leg)) {
            Tone::Trousers
        } else if tree.is_trunk(segment)
            || marks.arms().any(|arm| segment == arm.upper || tree.carries(segment, arm.upper))
        {
            Tone::Shirt
        } else {
            Tone::Skin
        }
    }

    /// Its colour.
    pub fn color(self) -> Color {
        match self {
            Tone::Skin => SKIN,
            Tone::Shirt => SHIRT,
            Tone::Trousers => TROUSERS,
        }
    }
}
