//! Builds the distance function of a solid, whole and without the faces that are far from each face.

use nalgebra::{Point3, Vector3};

use super::Shape;
use super::distance::{Form, Section, Side};
use super::faced::{Face, Faced};
use crate::forces::contact::face::V2;
use crate::forces::contact::flat_face::{SAME_M, plane_axes};
use crate::motion::vector::{M3, V3};
use occupant_units::trig;

/// Farther than anything is, m.
pub(super) const FAR_M: f64 = 1e6;
/// Corners of a prism at least and at most.
const CORNERS: std::ops::RangeInclusive<usize> = 3..=12;
/// Corners may leave their plane by this part of the prism's size.
const FLAT: f64 = 1e-6;
/// Cosine of the angle beyond which the normals of two faces look away from each other: 120°.
const AWAY: f64 = -0.5 - 1e-9;

/// Problems of a shape, and what was expected.
pub(crate) type Wrong = (String, &'static str);

type V = Vector3<f64>;

/// The distance function of `shape`.
///
/// # Errors
/// Shapes without thickness.
pub(crate) fn build(shape: &Shape) -> Result<Faced<f64>, Wrong> {
    match shape {
        Shape::Prism { corners_m, half_width_m, rounding_m } => prism(corners_m, *half_width_m, *rounding_m),
        &Shape::Disc { centre_m, axis, radius_m, thickness_m, rounding_m } => {
            let (radius_m, half_m) = (positive("radius", radius_m)?, 0.5 * positive("thickness", thickness_m)?);
            let rounding_m = rounded(rounding_m, radius_m.min(half_m))?;
            let whole = along(centre_m, axis, Section::Round(radius_m - rounding_m), [half_m - rounding_m; 2])?;
            Ok(between_ends(whole.rounded(rounding_m), Vec::new(), 2.0 * radius_m, 2.0 * half_m))
        }
        &Shape::Capsule { ends_m: [from, to], radius_m } => {
            let (radius, half) = (positive("radius", radius_m)?, 0.5 * (to - from).norm());
            if half < SAME_M {
                return Err(("two ends at one place".to_owned(), "two different points"));
            }
            let line = along(nalgebra::center(&from, &to), to - from, Section::Round(0.0), [half; 2])?;
            Ok(Faced::new(line.rounded(radius), Vec::new(), 2.0 * radius))
        }
        &Shape::Rim { centre_m, axis, ring_radius_m, tube_radius_m } => {
            let (ring, radius) = (positive("radius", ring_radius_m)?, positive("tube radius", tube_radius_m)?);
            if radius >= ring {
                let found = format!("a tube of radius {radius} m about a ring of radius {ring} m");
                return Err((found, "a tube thinner than the ring"));
            }
            let line = along(centre_m, axis, Section::Ring(ring), [0.0; 2])?;
            Ok(Faced::new(line.rounded(radius), Vec::new(), 2.0 * radius))
        }
        &Shape::HalfSpace { point_m, normal } => {
            let behind = along(point_m, normal, Section::Sides(Vec::new()), [0.0, FAR_M])?;
            Ok(Faced::new(behind, Vec::new(), FAR_M))
        }
    }
}

fn positive(what: &str, length_m: f64) -> Result<f64, Wrong> {
    let is_length = length_m > 0.0 && length_m < FAR_M;
    is_length.then_some(length_m).ok_or_else(|| (format!("{what} {length_m} m"), "a length above 0"))
}

/// ρ below the least half thickness.
fn rounded(rounding_m: f64, half_m: f64) -> Result<f64, Wrong> {
    let fits = (0.0..half_m).contains(&rounding_m);
    let found = || format!("edges rounded by {rounding_m} m on a solid that is {half_m} m to each side");
    fits.then_some(rounding_m).ok_or_else(|| (found(), "a rounding below half the thickness"))
}

/// A section with sharp edges about a place, along an axis of any length.
fn along(centre: Point3<f64>, axis: V, section: Section<f64>, ends: [f64; 2]) -> Result<Form<f64>, Wrong> {
    let Some(axis) = axis.try_normalize(1e-12).filter(|n| n.iter().all(|c| c.is_finite())) else {
        return Err(("an axis of length zero".to_owned(), "a direction"));
    };
    if !centre.iter().all(|c| c.abs() < FAR_M) {
        return Err(("a position that is not finite".to_owned(), "finite coordinates"));
    }
    let (u, v) = plane_axes(&axis);
    let axes = M3 { x: V3::of(&u), y: V3::of(&v), z: V3::of(&axis) };
    Ok(Form { centre: V3::of(&centre.coords), axes, section, ends, rounding: 0.0 })
}

impl Form<f64> {
    fn rounded(self, rounding: f64) -> Self {
        Form { rounding, ..self }
    }
}

/// A line with a side of a polygon to its left.
#[derive(Clone, Copy)]
struct Line {
    start: [f64; 2],
    direction: [f64; 2],
}

impl Line {
    /// Outward distance of a point.
    fn outward(&self, [u, v]: [f64; 2]) -> f64 {
        (u - self.start[0]) * self.direction[1] - (v - self.start[1]) * self.direction[0]
    }

    /// Sine and cosine of the turn to the next line.
    fn turn(&self, next: &Line) -> [f64; 2] {
        let ([a, b], [c, d]) = (self.direction, next.direction);
        [a * d - b * c, a * c + b * d]
    }

    /// How far along it another line is met; without bound where it is not met in that sense.
    fn meets(&self, other: &Line, sense: f64) -> f64 {
        let [sine, _] = self.turn(other);
        let way = -other.outward(self.start) / sine;
        if sense * sine > 1e-9 { way.clamp(-FAR_M, FAR_M) } else { sense * FAR_M }
    }
}

/// The sides of what lies to the left of all `lines`, which turn counter-clockwise.
fn sides(lines: &[Line]) -> Vec<Side<f64>> {
    let count = lines.len();
    let side = |i: usize| {
        let (before, own, next) = (&lines[(i + count - 1) % count], &lines[i], &lines[(i + 1) % count]);
        let ([u, v], [du, dv]) = (own.start, own.direction);
        let part = [own.meets(before, -1.0), own.meets(next, 1.0)];
        Side { start: V2 { u, v }, direction: V2 { u: du, v: dv }, part }
    };
    (0..count).map(side).collect()
}

fn prism(corners: &[Point3<f64>], half_width_m: f64, rounding_m: f64) -> Result<Faced<f64>, Wrong> {
    let half_m = positive("half width", half_width_m)?;
    let rounding = rounded(rounding_m, half_m)?;
    let (centre, normal, corners) = flat(corners)?;
    let lines: Vec<Line> = (0..corners.len()).map(|i| side_line(&corners, i, rounding)).collect();
    let drawn_in = sides(&lines);
    if let Some(i) = drawn_in.iter().position(|side| side.part[1] - side.part[0] < SAME_M) {
        let found = format!("edges rounded by {rounding_m} m take away side {} of the prism", i + 1);
        return Err((found, "a smaller rounding, or longer sides"));
    }
    let whole = along(centre, normal, Section::Sides(drawn_in), [half_m - rounding; 2])?.rounded(rounding);
    let face = |k: usize| {
        let is_near = |j: usize| {
            let steps = (j + lines.len() - k) % lines.len();
            steps.min(lines.len() - steps) < 2 || lines[k].turn(&lines[j])[1] > AWAY
        };
        let near: Vec<Line> = (0..lines.len()).filter(|j| is_near(*j)).map(|j| lines[j]).collect();
        let ([u, v], [du, dv]) = (lines[k].start, lines[k].direction);
        let depth_m = corners.iter().map(|p| -lines[k].outward(*p)).fold(0.0, f64::max);
        Face {
            normal: whole.axes.x * dv - whole.axes.y * du,
            offset: (whole.axes.x * dv - whole.axes.y * du).dot(whole.centre) + u * dv - v * du + rounding,
            rest: Form { section: Section::Sides(sides(&near)), ..whole.clone() },
            thickness: depth_m + rounding,
        }
    };
    let faces = (0..lines.len()).map(face).collect();
    Ok(between_ends(whole, faces, FAR_M, 2.0 * half_m))
}

/// With the two ends as faces, each of which is far from the other.
fn between_ends(whole: Form<f64>, mut faces: Vec<Face<f64>>, across_m: f64, thickness: f64) -> Faced<f64> {
    for end in 0..2 {
        let mut rest = whole.clone();
        rest.ends[1 - end] = FAR_M;
        let normal = if end == 0 { whole.axes.z } else { -whole.axes.z };
        faces.push(Face { normal, rest, offset: normal.dot(whole.centre) + 0.5 * thickness, thickness });
    }
    Faced::new(whole, faces, across_m)
}

/// The line of side `i`, drawn in.
fn side_line(corners: &[[f64; 2]], i: usize, by_m: f64) -> Line {
    let ([u, v], [u2, v2]) = (corners[i], corners[(i + 1) % corners.len()]);
    let length = trig::hypot(u2 - u, v2 - v);
    let [du, dv] = [(u2 - u) / length, (v2 - v) / length];
    Line { start: [u - dv * by_m, v + du * by_m], direction: [du, dv] }
}

/// Middle, normal, and corners in the plane.
type Flat = (Point3<f64>, V, Vec<[f64; 2]>);

/// The middle and the normal of the plane of `corners`, and the corners in that plane, counter-clockwise.
pub(super) fn flat(corners: &[Point3<f64>]) -> Result<Flat, Wrong> {
    if !CORNERS.contains(&corners.len()) {
        return Err((format!("{} corners", corners.len()), "3 to 12 corners"));
    }
    let centre = Point3::from(corners.iter().map(|p| p.coords).sum::<V>() / corners.len() as f64);
    let arms: Vec<V> = corners.iter().map(|p| p - centre).collect();
    let size = arms.iter().map(V::norm).fold(0.0, f64::max);
    let spans = arms.iter().flat_map(|a| arms.iter().map(move |b| a.cross(b)));
    let widest = spans.fold(V::zeros(), |most, span| if span.norm() > most.norm() { span } else { most });
    if !size.is_finite() || widest.norm() <= FLAT * size * size {
        return Err(("corners on one line".to_owned(), "corners that span a plane"));
    }
    let normal = widest.normalize();
    if let Some(i) = arms.iter().position(|arm| normal.dot(arm).abs() > FLAT * size) {
        let off_mm = 1e3 * normal.dot(&arms[i]).abs();
        return Err((
            format!("corner {} is {off_mm:.3} mm off the plane of the others", i + 1),
            "corners in one plane",
        ));
    }
    let (u, v) = plane_axes(&normal);
    let mut order: Vec<(f64, usize, [f64; 2])> = Vec::with_capacity(arms.len());
    for (i, arm) in arms.iter().enumerate() {
        let place = [u.dot(arm), v.dot(arm)];
        order.push((trig::atan2(place[1], place[0]), i, place));
    }
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    for at in 0..order.len() {
        let [p, q, r] = [0, 1, 2].map(|step| order[(at + step) % order.len()].2);
        let turn = (q[0] - p[0]) * (r[1] - q[1]) - (q[1] - p[1]) * (r[0] - q[0]);
        if turn <= 1e-9 * size * size || trig::hypot(q[0] - p[0], q[1] - p[1]) < SAME_M {
            let number = order[(at + 1) % order.len()].1 + 1;
            return Err((
                format!("corner {number} is no corner of the convex hull of all"),
                "corners of a convex polygon",
            ));
        }
    }
    Ok((centre, normal, order.into_iter().map(|(_, _, place)| place).collect()))
}
