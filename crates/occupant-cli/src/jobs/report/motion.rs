//! The motion, output by output: poses, lines of force elements, contacts.

use nalgebra::{Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};
use occupant_core::results::sample::{Contact, Sample};
use occupant_core::vehicle::FrameMotion;
use serde::Serialize;

use super::array::Array;

/// Points of a line at every output.
const LINE_POINTS: usize = 20;

/// Gathers what moves.
#[derive(Debug)]
pub(crate) struct Motion {
    poses: Vec<f64>,
    vehicle: Vec<f64>,
    lines: Vec<Course>,
    contacts: Vec<Contact>,
    starts: Vec<usize>,
}

/// A line of a force element at all outputs.
#[derive(Debug, Default)]
struct Course {
    name: String,
    points: Vec<f64>,
    forces: Vec<f64>,
}

/// The same as the page has it; points x, y, z, `count` of them an output, vehicle axes, m.
#[derive(Debug, Serialize)]
pub(crate) struct MovingLine {
    name: String,
    count: usize,
    points: Array,
    /// N.
    force: Array,
}

/// Contacts; those of output i are from `start[i]` to `start[i + 1]`. Points in m, forces on the body in N, vehicle axes.
#[derive(Debug, Serialize)]
pub(crate) struct Contacts {
    start: Array,
    sphere: Array,
    surface: Array,
    point: Array,
    force: Array,
}

impl Motion {
    pub(crate) fn new() -> Self {
        Motion { poses: Vec::new(), vehicle: Vec::new(), lines: Vec::new(), contacts: Vec::new(), starts: vec![0] }
    }

    pub(crate) fn add(&mut self, sample: &Sample<'_>) {
        for segment in sample.model.body().tree.segments() {
            let turn = sample.orientation(segment);
            push_pose(&mut self.poses, sample.cg_m(segment).coords, &turn);
        }
        self.add_vehicle(sample.vehicle);
        let lines = sample.lines();
        self.lines.resize_with(lines.len(), Course::default);
        for (course, line) in self.lines.iter_mut().zip(lines) {
            course.points.extend(evenly(&line.points_m).iter().flat_map(|p| [p.x, p.y, p.z]));
            course.forces.push(line.force_n);
            course.name = line.name;
        }
        self.contacts.extend(sample.contacts());
        self.starts.push(self.contacts.len());
    }

    /// The vehicle in vehicle-space: Y right, Z down.
    fn add_vehicle(&mut self, motion: &FrameMotion) {
        let turned = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0));
        let rotation = Rotation3::from_matrix_unchecked(turned * motion.rotation);
        let turn = UnitQuaternion::from_rotation_matrix(&rotation);
        push_pose(&mut self.vehicle, turned * motion.origin_m, &turn);
    }

    /// Poses of the segments: x, y, z, quaternion x, y, z, w; vehicle axes.
    pub(crate) fn poses(&self) -> Array {
        Array::float32(self.poses.iter().copied())
    }

    /// Poses of the vehicle in vehicle-space.
    pub(crate) fn vehicle(&self) -> Array {
        Array::float32(self.vehicle.iter().copied())
    }

    pub(crate) fn lines(&self) -> Vec<MovingLine> {
        let line = |course: &Course| MovingLine {
            name: course.name.clone(),
            count: LINE_POINTS,
            points: Array::float32(course.points.iter().copied()),
            force: Array::float32(course.forces.iter().copied()),
        };
        self.lines.iter().map(line).collect()
    }

    pub(crate) fn contacts(&self) -> Contacts {
        let all = || self.contacts.iter();
        Contacts {
            start: Array::uint32(self.starts.iter().copied()),
            sphere: Array::uint16(all().map(|c| c.sphere)),
            surface: Array::uint16(all().map(|c| c.surface)),
            point: Array::float32(all().flat_map(|c| <[f64; 3]>::from(c.point_m))),
            force: Array::float32(all().flat_map(|c| <[f64; 3]>::from(c.force_n))),
        }
    }
}

fn push_pose(poses: &mut Vec<f64>, place: Vector3<f64>, turn: &UnitQuaternion<f64>) {
    poses.extend(place.iter());
    poses.extend([turn.i, turn.j, turn.k, turn.w]);
}

/// As many points for every course: its first, its last, and between them points that are evenly spaced along the part
/// on the body.
fn evenly(course: &[Point3<f64>]) -> Vec<Point3<f64>> {
    let inner = match course {
        [_, inner @ .., _] if inner.len() > 1 => inner,
        _ => course,
    };
    let (Some(first), Some(last)) = (course.first(), course.last()) else {
        return vec![Point3::origin(); LINE_POINTS];
    };
    let count = LINE_POINTS - 2;
    let mut points = vec![*first];
    for i in 0..count {
        let at = (inner.len() - 1) as f64 * i as f64 / (count - 1) as f64;
        let low = (at.floor() as usize).min(inner.len() - 1);
        let high = (low + 1).min(inner.len() - 1);
        points.push(inner[low] + (inner[high] - inner[low]) * at.fract());
    }
    points.push(*last);
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn courses_of_any_length_get_as_many_points() {
        let line = |n: usize| -> Vec<_> { (0..n).map(|i| Point3::new(i as f64, 0.0, 0.0)).collect() };
        for n in [2, 4, 5, 30] {
            let points = evenly(&line(n));
            assert_eq!(points.len(), LINE_POINTS);
            assert_eq!((points[0].x, points[19].x), (0.0, (n - 1) as f64));
            assert!(points.windows(2).all(|w| w[0].x <= w[1].x), "{n}");
        }
        assert_eq!(evenly(&line(4))[1].x, 1.0);
        assert_eq!(evenly(&line(4))[18].x, 2.0);
    }
}
