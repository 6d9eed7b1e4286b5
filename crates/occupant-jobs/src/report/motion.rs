//! The motion, output by output: poses, lines of force elements, contacts.

use nalgebra::{Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};
use occupant_core::forces::contact::surface::Frame;
use occupant_core::forces::shown::{Line, Section};
use occupant_core::model::Model;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use serde::Serialize;

use super::array::Array;
use occupant_files::mcap::scene::compartment::corners_m;

/// Number of points of a line whose course changes from output to output, and the most of any other.
const LINE_POINTS: usize = 20;

/// Moving parts: positions in m and forces in N, in vehicle axes.
#[derive(Debug, Default, Serialize)]
pub struct Motion {
    /// Lines of force elements, and outlines of sections.
    #[serde(rename = "belts")]
    lines: Vec<MovingLine>,
    /// Poses of the segments: x, y, z, quaternion x, y, z, w.
    poses: Array,
    /// Displacements of the spheres of `ridden` by deformable parts: x, y, z, axes of their segments.
    carried: Array,
    /// Spheres (indices).
    ridden: Vec<usize>,
    /// Poses of the vehicle in vehicle-space: Y right, Z down.
    vehicle: Array,
    contacts: Contacts,
}

/// A line of a force element; points x, y, z, `count` of them per output.
#[derive(Debug, Default, Serialize)]
struct MovingLine {
    name: String,
    count: usize,
    points: Array,
    force: Array,
    /// Its own points, while it has as many at every output.
    #[serde(skip)]
    own: Option<(usize, Array)>,
}

impl MovingLine {
    fn add(&mut self, line: Line) {
        let floats = |points: &[Point3<f64>]| points.iter().flat_map(|p| [p.x, p.y, p.z]).collect::<Vec<_>>();
        let count = line.points_m.len();
        let is_first = self.count == 0;
        self.own = if is_first { Some((count, Array::default())) } else { self.own.take() };
        self.own = self.own.take().filter(|(own, _)| *own == count && count <= LINE_POINTS);
        self.own.iter_mut().for_each(|(_, own)| own.float32(floats(&line.points_m)));
        self.points.float32(floats(&evenly(&line.points_m)));
        self.force.float32([line.force_n]);
        (self.name, self.count) = (line.name, LINE_POINTS);
    }
}

impl Motion {
    /// Leaves each line its own points where their number is constant.
    pub fn finish(&mut self) {
        for line in &mut self.lines {
            if let Some((count, points)) = line.own.take() {
                (line.count, line.points) = (count, points);
            }
        }
    }
}

/// Contacts; those of output i are from `start[i]` to `start[i + 1]`. Forces act on the body.
#[derive(Debug, Default, Serialize)]
struct Contacts {
    start: Array,
    sphere: Array,
    surface: Array,
    point: Array,
    force: Array,
    #[serde(skip)]
    count: usize,
}

impl Recorder for Motion {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        let spheres = model.body().spheres.iter().enumerate();
        self.ridden = spheres.filter(|(_, sphere)| !sphere.ride.contact.is_empty()).map(|(i, _)| i).collect();
        self.contacts.start.uint32(0);
        Ok(())
    }

    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        let sample = &sample.seen_by_vehicle();
        for segment in sample.model.body().tree.segments() {
            add_pose(&mut self.poses, sample.cg_m(segment).coords, &sample.orientation(segment));
        }
        let carried = self.ridden.iter().flat_map(|sphere| sample.sphere_carried_m(*sphere));
        self.carried.float32(carried.flat_map(<[f64; 3]>::from));
        let turned = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0));
        let rotation = Rotation3::from_matrix_unchecked(turned * sample.vehicle.rotation);
        let turn = UnitQuaternion::from_rotation_matrix(&rotation);
        add_pose(&mut self.vehicle, turned * sample.vehicle.origin_m, &turn);
        let mut lines = sample.lines();
        lines.extend(sample.sections().into_iter().map(closed));
        lines.extend(moving(sample).into_iter().map(closed));
        self.lines.resize_with(lines.len(), MovingLine::default);
        self.lines.iter_mut().zip(lines).for_each(|(moving, line)| moving.add(line));
        self.contacts.add(sample);
        Ok(Flow::Continue)
    }
}

/// Edges of surfaces and solids that move within a vehicle, and of the exteriors of other vehicles, for which the page
/// has no plates.
fn moving(sample: &Sample<'_>) -> Vec<Section> {
    let setup = sample.model.setup();
    let moves = |frame: Frame| matches!(frame, Frame::Other(i) if setup.frames[i].parent.is_some());
    let faces = setup.surfaces.iter().zip(sample.model.faces());
    let faces = faces.map(|(surface, face)| (&surface.name, face.frame, corners_m(face)));
    let solids = setup.solids.iter().map(|solid| (&solid.name, solid.frame, solid.edge()));
    let is_other = |frame: Frame| matches!(frame, Frame::Other(i) if setup.frames[i].parent.is_none());
    let drawn = setup.scenery.iter().filter(|own| is_other(own.frame));
    let outside = drawn.flat_map(|own| own.polygons_m.iter().map(move |side| (&own.name, own.frame, side.clone())));
    let all = faces.chain(solids).filter(|(_, frame, _)| moves(*frame)).chain(outside);
    all.map(|(name, frame, corners_m)| {
        let motion = sample.frame(frame);
        let placed = |p: &Point3<f64>| sample.vehicle.point_to_frame(motion.point_to_space(p.coords)).into();
        Section { name: name.clone(), corners_m: corners_m.iter().map(placed).collect() }
    })
    .collect()
}

/// Outline of a section as a closed line.
fn closed(section: Section) -> Line {
    let Section { name, corners_m: mut points_m } = section;
    points_m.extend(points_m.first().copied());
    Line { name, points_m, force_n: 0.0 }
}

impl Contacts {
    fn add(&mut self, sample: &Sample<'_>) {
        for contact in sample.contacts() {
            self.sphere.uint16(contact.sphere);
            self.surface.uint16(contact.surface);
            self.point.float32(<[f64; 3]>::from(contact.point_m));
            self.force.float32(<[f64; 3]>::from(contact.force_n));
            self.count += 1;
        }
        self.start.uint32(self.count);
    }
}

fn add_pose(poses: &mut Array, place: Vector3<f64>, turn: &UnitQuaternion<f64>) {
    poses.float32([place.x, place.y, place.z, turn.i, turn.j, turn.k, turn.w]);
}

/// The same number of points for every course: its ends, and points evenly spaced along the part on the body.
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

    /// Lines of one element with so many points at each output: what the page gets of it.
    fn kept(counts: &[usize]) -> (usize, usize) {
        let mut line = MovingLine::default();
        for n in counts {
            let points_m = (0..*n).map(|i| Point3::new(i as f64, 0.0, 0.0)).collect();
            line.add(Line { name: String::new(), points_m, force_n: 0.0 });
        }
        let mut motion = Motion { lines: vec![line], ..Motion::default() };
        motion.finish();
        let text = serde_json::to_string(&motion.lines[0].points).unwrap();
        (motion.lines[0].count, (text.len() - 2) / 4 * 3 / 12)
    }

    #[test]
    fn a_line_keeps_its_points_where_their_number_is_constant() {
        assert_eq!(kept(&[2, 2, 2]), (2, 6));
        assert_eq!(kept(&[5; 4]), (5, 20));
        for changing in [&[2, 5, 2][..], &[30, 30, 30], &[5, 5, 2]] {
            assert_eq!(kept(changing), (20, 60));
        }
    }

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
