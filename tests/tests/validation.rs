//! Wrong setups: every problem at once, each with its place, what was found and what was expected.

use nalgebra::{Point3, Vector3};
use occupant_core::body::tti12;
use occupant_core::forces::contact::surface::{Facing, Frame, Outline};
use occupant_core::forces::joint::Stop;
use occupant_core::model::Model;
use occupant_core::model::seating::InitialPosture;
use occupant_core::model::setup::{Integrator, Setup};
use occupant_core::vehicle::{AfterEnd, Interpolation, Station, TablePath, VehiclePath};
use occupant_core::{Problems, Severity};
use occupant_tests::cart::lap;

fn sound() -> Setup {
    lap(Integrator::Rk4 { step_s: 1e-4 })
}

/// Paths of the errors of a changed lap case.
fn errors(change: impl FnOnce(&mut Setup)) -> Problems {
    let mut setup = sound();
    change(&mut setup);
    Model::new(setup).expect_err("a setup with a fault")
}

/// One fault: what to change, where it must be reported, what the text must say.
type Fault = (fn(&mut Setup), &'static str, &'static str);

fn polygon(points: &[[f64; 3]]) -> Outline {
    Outline::Polygon(points.iter().map(|&[x, y, z]| Point3::new(x, y, z)).collect())
}

const FAULTS: &[Fault] = &[
    (|s| s.body.segments[2].mass_kg = -1.0, "body.segments.head.mass", "-1 kg"),
    (|s| s.body.segments[2].mass_kg = f64::NAN, "body.segments.head.mass", "NaN"),
    (|s| s.body.segments[8].length_m = 0.0, "body.segments.left_thigh.length", "0 m"),
    (|s| s.body.segments[0].inertia_kg_m2 = Vector3::new(0.1, 0.1, 0.21), "body.segments.middle_torso.inertia", "I_z"),
    (|s| s.body.segments[0].inertia_kg_m2.x = -0.1, "body.segments.middle_torso.inertia", "about x"),
    (|s| s.body.segments[11].cg_from_lower_end_m = 0.9, "body.segments.right_lower_leg.cg", "0.9 m"),
    (|s| s.body.hip_half_width_m = -0.1, "body.hip_half_width", "-0.1 m"),
    (|s| s.body.spheres[0].radius_m = 0.0, "body.spheres.head.radius", "0 m"),
    (|s| s.body.spheres[0].centre_from_lower_end_m.z = 1.0, "body.spheres.head", "on its segment"),
    (|s| s.body.spheres[1].name = "head".into(), "body.spheres.head", "a second sphere"),
    (|s| s.body.spheres[2].name = "bottom".into(), "body.spheres", "`pelvis`"),
    (|s| s.joints.ball_mut(tti12::NECK).unwrap().damping_n_m_s = -2.0, "joints.neck.damping", "-2 N·m·s"),
    (
        |s| {
            s.joints.ball_mut(tti12::NECK).unwrap().stop =
                Some(Stop { begin_rad: 1.0, full_rad: 0.5, damping_n_m_s: 100.0 });
        },
        "joints.neck.stop",
        "interchange",
    ),
    (
        |s| {
            s.joints.hinge_mut(tti12::LEFT_KNEE).unwrap().lower_stop =
                Some(Stop { begin_rad: 0.0, full_rad: 0.1, damping_n_m_s: 100.0 });
        },
        "joints.left_knee.lower_stop",
        "lower stop",
    ),
    (|s| s.joints.epsilon = 0.5, "joints.epsilon", "0.5"),
    (|s| s.materials[0].force.bilinear_mut().unwrap().k1_n_per_m = -5.0, "materials.seat.k1", "-5 N/m"),
    (|s| s.materials[0].force.bilinear_mut().unwrap().returned_1 = 1.2, "materials.seat.mu1", "1.2"),
    (|s| s.materials[0].friction = -0.1, "materials.seat.friction", "-0.1"),
    (|s| s.materials[0].friction_speed_m_s = 0.0, "materials.seat.friction_speed", "0 m/s"),
    (|s| s.surfaces[1].name = "cushion".into(), "surfaces.cushion", "a second surface"),
    (|s| s.surfaces[2].material = 77, "surfaces.floor.material", "no such material"),
    (|s| s.surfaces[2].spheres = Some(vec![0, 17]), "surfaces.floor.spheres", "no such sphere"),
    (|s| s.surfaces[2].outline = polygon(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]), "surfaces.floor", "at least three"),
    (
        |s| {
            s.surfaces[2].outline = polygon(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]);
        },
        "surfaces.floor",
        "on one line",
    ),
    (
        // an arrow head
        |s| {
            s.surfaces[2].outline = polygon(&[[0.0, 0.0, 0.5], [1.0, 0.0, 0.5], [0.2, 0.2, 0.5], [0.0, 1.0, 0.5]]);
        },
        "surfaces.floor",
        "convex",
    ),
    (
        // a bow tie
        |s| {
            s.surfaces[2].outline = polygon(&[[0.0, 0.0, 0.5], [1.0, 1.0, 0.5], [1.0, 0.0, 0.5], [0.0, 1.1, 0.5]]);
        },
        "surfaces.floor",
        "convex",
    ),
    (
        // a five-pointed star: every corner turns the same way, twice round
        |s| {
            let corner = |i: i32| {
                let (y, x) = (f64::from(2 * i) * std::f64::consts::TAU / 5.0).sin_cos();
                Point3::new(x, y, 0.5)
            };
            s.surfaces[2].outline = Outline::Polygon((0..5).map(corner).collect());
        },
        "surfaces.floor",
        "convex",
    ),
    (
        |s| {
            s.surfaces[2].outline = polygon(&[[0.0, 0.0, 0.5], [1.0, 0.0, 0.5], [1.0, 1.0, 0.6], [0.0, 1.0, 0.5]]);
        },
        "surfaces.floor",
        "plane",
    ),
    (|s| s.surfaces[2].facing = Facing::Towards(Point3::new(0.0, 0.0, 14.0 * 0.0254)), "surfaces.floor", "open side"),
    (
        |s| {
            s.surfaces[8].outline = Outline::Disc { centre_m: Point3::origin(), radius_m: -0.2, axis: Vector3::z() };
        },
        "surfaces.wheel",
        "radius",
    ),
    (
        |s| {
            s.surfaces[8].outline = Outline::Unbounded { point_m: Point3::origin(), axis: Vector3::zeros() };
        },
        "surfaces.wheel",
        "direction",
    ),
    (|s| s.belts[0].sphere = 99, "belts.lap.sphere", "no such sphere"),
    (|s| s.belts[0].anchors_m[1] = s.belts[0].anchors_m[0], "belts.lap.anchors", "one place"),
    (|s| s.belts[0].anchors_m[1].x = f64::NAN, "belts.lap.anchors", "finite"),
    (
        |s| s.belts[0].rest = occupant_core::forces::belt::RestLength::Given { length_m: -0.1 },
        "belts.lap",
        "unstretched length",
    ),
    (|s| s.gravity_m_s2 = -9.81, "gravity", "-9.81"),
    (|s| s.time.end_s = 0.0, "time.end", "after the start"),
    (|s| s.time.output_s = 0.0, "output.interval", "positive"),
    (|s| s.time.output_s = 1e300, "output.interval", "no longer than the run"),
    (|s| s.integrator = Integrator::Rk4 { step_s: -1e-4 }, "integrator.step", "-0.0001 s"),
    (
        |s| {
            s.integrator = Integrator::Adaptive {
                relative: 1e-6,
                absolute_m: 1e-6,
                absolute_m_s: 1e-6,
                min_step_s: 1e-3,
                max_step_s: 1e-4,
            };
        },
        "integrator.max_step",
        "largest step",
    ),
    (
        |s| {
            let station = |t: f64| Station::new(t, [t, 0.0, 0.0], [0.0; 3]);
            let stations = vec![station(0.0), station(0.1)];
            let table = TablePath::new(stations, Interpolation::Linear, AfterEnd::Error);
            s.path = VehiclePath::Table(table.expect("two stations"));
        },
        "path",
        "0.2",
    ),
    (
        |s| {
            if let InitialPosture::Seated(seating) = &mut s.posture {
                seating.cushion = 40;
            }
        },
        "seat.cushion",
        "no such surface",
    ),
    (
        |s| {
            if let InitialPosture::Seated(seating) = &mut s.posture {
                seating.angles_rad[2].1 = f64::NAN;
            }
        },
        "posture.head",
        "an angle from −180° to 180°",
    ),
];

#[test]
fn each_fault_is_reported_at_its_place_with_what_was_found_and_expected() {
    let mut wrong = Vec::new();
    for (i, (change, path, text)) in FAULTS.iter().enumerate() {
        let mut setup = sound();
        change(&mut setup);
        let problems = match Model::new(setup) {
            Ok(_) => {
                wrong.push(format!("{i}: {path} ({text}): accepted"));
                continue;
            }
            Err(problems) => problems,
        };
        let told =
            problems.iter().any(|p| p.severity == Severity::Error && p.path == *path && p.to_string().contains(text));
        if !told {
            wrong.push(format!("{i}: {path} ({text}): got {problems}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn all_faults_of_numbers_and_surfaces_are_reported_at_once() {
    let independent = [0, 5, 6, 7, 11, 14, 15, 17, 20, 21, 22, 33, 36, 38];
    let problems = errors(|s| {
        for i in independent {
            FAULTS[i].0(s);
        }
    });
    for i in independent {
        let (_, path, _) = FAULTS[i];
        assert!(problems.iter().any(|p| p.path == path), "{path} in {problems}");
    }
    assert_eq!(problems.iter().count(), independent.len(), "{problems}");
}

#[test]
fn the_case_without_faults_is_accepted_without_a_warning() {
    let model = Model::new(sound()).unwrap();
    assert!(model.warnings().is_empty(), "{}", model.warnings());
}

#[test]
fn what_is_odd_but_usable_is_a_warning() {
    let mut setup = sound();
    setup.materials[0].force.bilinear_mut().unwrap().returned_2 = 0.0;
    setup.joints.ball_mut(tti12::NECK).unwrap().stop = Some(Stop { begin_rad: 0.5, full_rad: 1.0, damping_n_m_s: 0.1 });
    let model = Model::new(setup).unwrap();
    let paths: Vec<_> = model.warnings().iter().map(|p| p.path.as_str()).collect();
    assert_eq!(paths, ["joints.neck.stop", "materials.seat.mu2"]);
    assert!(!model.warnings().has_errors());
}

#[test]
fn polygons_may_name_their_corners_in_either_order_when_a_point_tells_the_open_side() {
    let mut setup = sound();
    if let Outline::Polygon(corners) = &mut setup.surfaces[2].outline {
        corners.reverse();
    }
    let (one, other) = (Model::new(sound()).unwrap(), Model::new(setup).unwrap());
    let (a, b) = (&one.faces()[2], &other.faces()[2]);
    assert!((a.normal - b.normal).norm() < 1e-15);
    assert_eq!(a.frame, Frame::Vehicle);
    // seen from the open side both run counter-clockwise
    for face in [a, b] {
        let Outline::Polygon(c) = &face.outline else { panic!("a polygon") };
        let turn = (c[1] - c[0]).cross(&(c[2] - c[1]));
        assert!(turn.dot(&face.normal) > 0.0);
    }
}
