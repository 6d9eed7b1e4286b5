//! What a viewer draws: transforms, shapes, belts and forces.

use nalgebra::{Isometry3, Matrix3, Point3, Quaternion, Translation3, UnitQuaternion, Vector3};
use occupant_core::body::tti12::TTI12;
use occupant_core::forces::contact::solid::{Shape, Solid};
use occupant_core::forces::contact::surface::Frame;
use occupant_core::model::Model;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use prost_reflect::DynamicMessage;

use super::support::{components, field, model, numbers, part, parts, read, record, setup, text};

fn point(message: &DynamicMessage) -> Point3<f64> {
    let n = components(message);
    Point3::new(n[0], n[1], n[2])
}

fn isometry(translation: &DynamicMessage, rotation: &DynamicMessage) -> Isometry3<f64> {
    let q = components(rotation);
    let q = Quaternion::new(q[3], q[0], q[1], q[2]);
    // measured: 2.3e-16
    assert!((q.norm() - 1.0).abs() < 1e-14, "{}", q.norm());
    Isometry3::from_parts(Translation3::from(point(translation)), UnitQuaternion::new_unchecked(q))
}

/// T1 is the upper end of the middle torso; every segment's upper end in space, from the sample and through the frames.
#[test]
fn transforms_put_every_segment_where_it_is() {
    let model = model();
    let mut samples = Vec::new();
    let (bytes, _) = record(
        &model,
        Watch(|s: &Sample<'_>| {
            let end = |n| s.vehicle.point_to_space(s.end_points_m(n)[0].coords);
            samples.push(TTI12.segments().map(end).collect::<Vec<_>>());
        }),
    );
    let frames = &read(&bytes)["/tf"];
    // 41 outputs at 1 ms, at most 500 a second: 0, 2, … 40 (the last)
    assert_eq!(frames.len(), 21);
    let mut worst = 0.0_f64;
    for (frame, ends) in frames.iter().zip(samples.iter().step_by(2)) {
        let transforms = parts(&frame.message, "transforms");
        assert_eq!(transforms.len(), 13);
        let pose = |t: &DynamicMessage| isometry(&part(t, "translation"), &part(t, "rotation"));
        let names = |t: &DynamicMessage| (text(t, "parent_frame_id"), text(t, "child_frame_id"));
        let vehicle = pose(&transforms[0]);
        assert_eq!(names(&transforms[0]), ("space".into(), "vehicle".into()));
        for (segment, t) in TTI12.segments().zip(&transforms[1..]) {
            let own = format!("occupant/{}", TTI12[segment].name);
            assert_eq!(names(t), ("vehicle".into(), own));
            let p = model.body().segment(segment);
            let local = Point3::new(0.0, 0.0, p.length_m - p.cg_from_lower_end_m);
            let end = vehicle * pose(t) * local;
            worst = worst.max((end.coords - ends[segment.index()]).norm());
            assert_eq!(time_ns(&part(t, "timestamp")), frame.ns);
        }
    }
    assert!(worst < 1e-14, "{worst}"); // measured: 1.3e-16
}

fn time_ns(time: &DynamicMessage) -> u64 {
    let whole = |name: &str| match field(time, name) {
        prost_reflect::Value::I64(n) => n as u64,
        prost_reflect::Value::I32(n) => n as u64,
        other => panic!("{other:?}"),
    };
    whole("seconds") * 1_000_000_000 + whole("nanos")
}

#[test]
fn shapes_are_written_once_and_locked_to_their_frames() {
    let model = model();
    let (bytes, _) = record(&model, ());
    let topics = read(&bytes);
    let setup = model.setup();
    for (topic, count) in [
        ("/scene/compartment", setup.surfaces.len()),
        ("/scene/labels", setup.surfaces.len()),
        ("/scene/body", 12),
        ("/scene/spheres", setup.body.spheres.len()),
    ] {
        assert_eq!(topics[topic].len(), 1, "{topic}");
        let entities = parts(&topics[topic][0].message, "entities");
        assert_eq!(entities.len(), count, "{topic}");
        for entity in &entities {
            assert_eq!(field(entity, "frame_locked").as_bool(), Some(true));
            assert_eq!(time_ns(&part(entity, "lifetime")), 0);
        }
    }
    let entities = parts(&topics["/scene/spheres"][0].message, "entities");
    for (entity, sphere) in entities.iter().zip(&setup.body.spheres) {
        assert_eq!(text(entity, "id"), sphere.name);
        let drawn = &parts(entity, "spheres")[0];
        let size = numbers(&field(drawn, "size"));
        assert_eq!(size, [2.0 * sphere.radius_m; 3]);
    }
}

/// The triangles of each surface make its area and look towards its open side.
#[test]
fn surfaces_are_drawn_with_their_area_and_side() {
    let model = model();
    let (bytes, _) = record(&model, ());
    let topics = read(&bytes);
    let entities = parts(&topics["/scene/compartment"][0].message, "entities");
    for (entity, face) in entities.iter().zip(model.faces()) {
        let plate = &parts(entity, "triangles")[0];
        let points: Vec<_> = parts(plate, "points").iter().map(point).collect();
        let value = field(plate, "indices");
        let indices: Vec<usize> = value.as_list().unwrap().iter().map(|i| i.as_u32().unwrap() as usize).collect();
        assert_eq!(indices.len(), 3 * (points.len() - 2));
        let area = |t: &[usize]| {
            let [a, b, c] = [points[t[0]], points[t[1]], points[t[2]]];
            0.5 * (b - a).cross(&(c - a))
        };
        for triangle in indices.chunks(3) {
            assert!(area(triangle).dot(&face.normal) > 0.0);
        }
        for p in &points {
            assert!((face.normal.dot(&p.coords) - face.offset_m).abs() < 1e-12);
        }
    }
    // the cushion: 20 in × 2 in edge, 0.5 m wide
    let cushion = &parts(&entities[0], "triangles")[0];
    let points: Vec<_> = parts(cushion, "points").iter().map(point).collect();
    let long = (points[1] - points[0]).norm() * (points[2] - points[1]).norm();
    let expected = 0.0254 * (20.0_f64.powi(2) + 2.0_f64.powi(2)).sqrt() * 0.5;
    assert!((long - expected).abs() < 1e-12, "{long} {expected}");
}

/// Six sides of a box with their area, one entity of its name behind the surfaces.
#[test]
fn solids_are_drawn_behind_the_surfaces() {
    let mut setup = setup();
    let (centre, lengths) = (Point3::new(0.7, 0.0, 0.1), Vector3::new(0.2, 0.6, 0.3));
    let shape = Shape::block(centre, lengths, &Matrix3::identity(), 0.01);
    let name = "block".to_owned();
    setup.solids.push(Solid { name, frame: Frame::Vehicle, shape, material: 0, group: None, spheres: None });
    let (bytes, _) = record(&Model::new(setup).unwrap(), ());
    let topics = read(&bytes);
    for topic in ["/scene/compartment", "/scene/labels"] {
        let entities = parts(&topics[topic][0].message, "entities");
        assert_eq!(text(entities.last().unwrap(), "id"), "block", "{topic}");
    }
    let entities = parts(&topics["/scene/compartment"][0].message, "entities");
    let area = |plate: &DynamicMessage| {
        let p: Vec<_> = parts(plate, "points").iter().map(point).collect();
        (p[1] - p[0]).norm() * (p[2] - p[1]).norm()
    };
    let sides = parts(entities.last().unwrap(), "triangles");
    let all: f64 = sides.iter().map(area).sum();
    assert_eq!(sides.len(), 6);
    assert!((all - 2.0 * (0.2 * 0.6 + 0.6 * 0.3 + 0.3 * 0.2)).abs() < 1e-12, "{all}");
}

/// Independent of how the arc is drawn: it ends at the second tangent point, and anchor to anchor it has the belt's length.
#[test]
fn belts_go_from_anchor_to_anchor_round_the_sphere() {
    let model = model();
    let (mut worst_end, mut worst_length) = (0.0_f64, 0.0_f64);
    let watch = Watch(|s: &Sample<'_>| {
        for ((belt, action), line) in model.setup().belts.iter().zip(&s.actions.belts).zip(s.lines()) {
            let radius = model.body().spheres[belt.sphere].radius_m;
            let centre = s.sphere_centre_m(belt.sphere);
            let course = line.points_m;
            let last = course.len() - 1;
            assert_eq!((course[0], course[last]), (belt.anchors_m[0], belt.anchors_m[1]));
            for p in &course[1..last] {
                assert!(((p - centre).norm() - radius).abs() < 1e-12);
            }
            let free = belt.anchors_m[1] - course[last - 1];
            let tangent: Vector3<f64> = action.free[1].to_vector();
            worst_end = worst_end.max((free.normalize() - tangent).norm());
            // each chord is shorter than its arc by the factor sin(x)/x of half its angle
            let half = 0.5 * action.wrap / (last - 2) as f64;
            let chord = radius * action.wrap * half.sin() / half;
            let sides: f64 = course.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
            let exact = action.length - radius * action.wrap + chord;
            worst_length = worst_length.max((sides - exact).abs());
        }
    });
    let (bytes, _) = record(&model, watch);
    assert!(worst_end < 1e-14, "{worst_end}"); // measured: 3.5e-16
    assert!(worst_length < 1e-12, "{worst_length}");
    let frames = &read(&bytes)["/scene/belts"];
    assert_eq!(frames.len(), 21);
    for frame in frames {
        let deletion = &parts(&frame.message, "deletions")[0];
        assert_eq!(field(deletion, "type").as_enum_number(), Some(1));
        let entities = parts(&frame.message, "entities");
        let ids: Vec<_> = entities.iter().map(|e| text(e, "id")).collect();
        assert_eq!(ids, ["lap", "torso"]);
    }
}

/// An arrow along its own X, turned by its pose, is the force on the sphere at 0.1 mm a newton.
#[test]
fn arrows_are_the_forces() {
    let model = model();
    let mut samples: Vec<Vec<(String, Vector3<f64>)>> = Vec::new();
    let watch = Watch(|s: &Sample<'_>| {
        let setup = s.model.setup();
        let contacts = s.contacts().map(|c| {
            let sphere = &setup.body.spheres[c.sphere].name;
            let id = format!("{sphere}__{}", setup.surfaces[c.surface].name);
            (id, c.force_n)
        });
        let belts = setup.belts.iter().zip(&s.actions.belts);
        let belts = belts.map(|(b, a)| (format!("belt__{}", b.name), a.force.to_vector()));
        samples.push(contacts.chain(belts).filter(|(_, f)| f.norm() >= 10.0).collect());
    });
    let (bytes, _) = record(&model, watch);
    let (mut drawn, mut worst) = (0, 0.0_f64);
    for (frame, forces) in read(&bytes)["/scene/forces"].iter().zip(samples.iter().step_by(2)) {
        let entities = parts(&frame.message, "entities");
        assert_eq!(entities.len(), forces.len());
        for (entity, (id, force)) in entities.iter().zip(forces) {
            assert_eq!(&text(entity, "id"), id);
            let arrow = &parts(entity, "arrows")[0];
            let number = |name: &str| numbers(&field(arrow, name))[0];
            let pose = part(arrow, "pose");
            let turn = isometry(&part(&pose, "position"), &part(&pose, "orientation"));
            let along = turn.rotation * Vector3::x();
            let shown = along * (number("shaft_length") + number("head_length"));
            worst = worst.max((shown - force * 1e-4).norm());
            drawn += 1;
        }
    }
    assert!(drawn > 40, "{drawn}");
    assert!(worst < 1e-14, "{worst}"); // measured: 5.0e-16
}
