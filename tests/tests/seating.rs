//! Seats: the cushion carries what it should, legs reach their heels, settled bodies stay.

use std::fs;
use std::path::{Path, PathBuf};

use nalgebra::{Matrix3, Vector3};
use occupant_core::body::tti12::{self, TTI12};
use occupant_core::body::{Body, Segment};
use occupant_core::forces::contact::surface::Outline;
use occupant_core::forces::joint::{BallJoint, HingeJoint, Joints};
use occupant_core::model::Model;
use occupant_core::model::seating::{InitialPosture, InitialVelocity, Seating, Settling};
use occupant_core::model::setup::{Integrator, Setup};
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::{Contact, Sample};
use occupant_core::results::summary::Summarizer;
use occupant_core::run::simulate::simulate;
use occupant_core::vehicle::{Attitude, FixedPath, VehiclePath, VehiclePose};
use occupant_scenario::{Draft, Format};
use occupant_tests::cart::{self, GRAVITY_M_S2, lap};
use occupant_tests::cases::{INCH_M, male50, parked};
use occupant_tests::measure::{assert_below, assert_within};
use occupant_tests::room::{run, setup};

const PELVIS: usize = 2;

/// The cart's occupant, unbelted, in a parked vehicle.
fn seated(change: impl FnOnce(&mut Seating)) -> Setup {
    let mut setup = lap(Integrator::Rk4 { step_s: 1e-4 });
    let mut seating = cart::seating();
    change(&mut seating);
    setup.belts.clear();
    setup.path = parked();
    setup.posture = InitialPosture::Seated(seating);
    setup
}

/// What a look at the start tells.
struct Start {
    contacts: Vec<Contact>,
    pelvis_m: Vector3<f64>,
    joints_m: Vec<[Vector3<f64>; 2]>,
    model: Model,
}

fn start(mut setup: Setup) -> Start {
    setup.time.end_s = setup.time.start_s + 1e-4;
    let model = Model::new(setup).unwrap_or_else(|p| panic!("{p}"));
    let mut seen = None;
    simulate(
        &model,
        Watch(|s: &Sample<'_>| {
            seen.get_or_insert_with(|| {
                let ends = TTI12.segments().map(|n| s.end_points_m(n).map(|p| p.coords));
                (s.contacts().collect(), s.sphere_centre_m(PELVIS).coords, ends.collect())
            });
        }),
    )
    .unwrap();
    let (contacts, pelvis_m, joints_m) = seen.unwrap();
    Start { contacts, pelvis_m, joints_m, model }
}

/// g·(M₁+…+M₈ + ½(M₉+M₁₀)), N.
fn carried(body: &Body) -> f64 {
    let mass: f64 = body.segments[..8].iter().map(|s| s.mass_kg).sum();
    GRAVITY_M_S2 * (mass + body.segments[8].mass_kg)
}

/// Weight that the cushion carries, from its normal force on the pelvis, less what it should, as a fraction.
fn imbalance(start: &Start) -> f64 {
    let on = |surface: usize| move |c: &&Contact| c.sphere == PELVIS && c.surface == surface;
    let cushion = start.contacts.iter().find(on(0)).expect("the pelvis on the cushion");
    let back = start.contacts.iter().find(on(1));
    // tangent to the back: its force there is rounding
    assert!(back.is_none_or(|c| c.normal_force_n < 1e-6), "{back:?}");
    let vehicle = start.model.setup().path.motion(0.0, 0.0, &mut Default::default());
    let normal = vehicle.rotation * start.model.faces()[0].normal;
    cushion.normal_force_n * normal.z / carried(start.model.body()) - 1.0
}

#[test]
fn the_cushion_carries_head_trunk_arms_and_half_the_thighs() {
    // Measured: 8.7e-15.
    assert_below("weight, relative", imbalance(&start(seated(|_| {}))), 1e-9);
}

#[test]
fn the_cushion_does_so_in_the_softer_and_in_the_stiffer_range_of_its_curve() {
    for break_m in [0.005, 0.5] {
        let mut setup = seated(|_| {});
        setup.materials[0].force.bilinear_mut().unwrap().break_m = break_m;
        // Measured: 8.7e-15.
        assert_below("weight, relative", imbalance(&start(setup)), 1e-9);
    }
}

#[test]
fn in_a_pitched_and_rolled_vehicle_the_cushion_carries_the_weight_along_gravity() {
    let mut setup = seated(|_| {});
    let pose = VehiclePose {
        position_m: Vector3::new(3.0, -2.0, 1.0),
        attitude: Attitude { roll_rad: 0.15, pitch_rad: 0.2, yaw_rad: 1.1 },
    };
    setup.path = VehiclePath::Fixed(FixedPath::new(pose).unwrap());
    // Measured: 8.7e-15.
    assert_below("weight, relative", imbalance(&start(setup)), 1e-9);
}

#[test]
fn without_gravity_the_pelvis_is_tangent_to_cushion_and_back() {
    let mut setup = seated(|_| {});
    setup.gravity_m_s2 = 0.0;
    let start = start(setup);
    let radius = start.model.body().spheres[PELVIS].radius_m;
    for face in &start.model.faces()[..2] {
        let gap = face.normal.dot(&start.pelvis_m) - face.offset_m - radius;
        // Measured: 1.4e-17.
        assert_below("gap, m", gap, 1e-15);
    }
}

#[test]
fn the_heels_stand_where_they_should_with_the_knees_above_and_the_posture_as_given() {
    let start = start(seated(|_| {}));
    let ends = |n: Segment| start.joints_m[n.index()];
    for (thigh, shank) in [(tti12::LEFT_THIGH, tti12::LEFT_LOWER_LEG), (tti12::RIGHT_THIGH, tti12::RIGHT_LOWER_LEG)] {
        let ([hip, knee], [_, heel]) = (ends(thigh), ends(shank));
        // Measured: 1.1e-16.
        assert_below("heel x, m", heel.x - 27.0 * INCH_M, 1e-14);
        // Measured: 1.7e-16.
        assert_below("heel z, m", heel.z - 13.0 * INCH_M, 1e-14);
        // Z_v points down: above is less
        let line = hip.z + (heel.z - hip.z) * (knee.x - hip.x) / (heel.x - hip.x);
        assert!(knee.z < line - 0.05);
    }
    let hinges = start.model.start().state.hinge().to_vec();
    assert!(hinges[2] > 0.0 && hinges[3] > 0.0);
    let gamma = |n: Segment| {
        let [upper, lower] = ends(n);
        (-(upper - lower).x).atan2(-(upper - lower).z)
    };
    for (segment, degrees) in [
        (tti12::MIDDLE_TORSO, 15.0_f64),
        (tti12::UPPER_TORSO, 18.0),
        (tti12::HEAD, 5.0),
        (tti12::LOWER_TORSO, 20.0),
        (tti12::LEFT_UPPER_ARM, 35.0),
        (tti12::RIGHT_UPPER_ARM, 35.0),
    ] {
        // Measured: 1.7e-16.
        assert_below("lean, rad", gamma(segment) - degrees.to_radians(), 1e-14);
    }
    // Measured: 0.
    assert_below("elbow, rad", hinges[0] - (-60_f64).to_radians(), 1e-15);
}

#[test]
fn the_occupants_left_is_the_vehicles_left_and_the_body_is_symmetric() {
    let start = start(seated(|_| {}));
    let ends = |n: Segment| start.joints_m[n.index()][1];
    let middle = -14.0 * INCH_M;
    for (left, right) in [(tti12::LEFT_FOREARM, tti12::RIGHT_FOREARM), (tti12::LEFT_LOWER_LEG, tti12::RIGHT_LOWER_LEG)]
    {
        let (l, r) = (ends(left), ends(right));
        // Y_v points to the right
        assert!(l.y < middle && r.y > middle);
        // Measured: 0.
        assert_below("symmetry, m", (l + r).y - 2.0 * middle, 1e-15);
        // Measured: 0.
        assert_below("symmetry, m", (l - r).xz().norm(), 1e-15);
    }
}

/// The compartment with a second row 0.9 m behind, seats as wide as the cart's floor.
fn four_seats(rear: bool, right: bool) -> Start {
    let mut setup = seated(|s| {
        s.lateral_m = if right { 0.35 } else { -0.35 };
        if rear {
            (s.cushion, s.back) = (9, 10);
            s.heels_m[0] -= 0.9;
        }
    });
    for seat in 0..2 {
        if let Outline::Polygon(corners) = &mut setup.surfaces[seat].outline {
            corners.iter_mut().for_each(|c| c.y = c.y.signum() * 0.7);
            (corners[0].y, corners[1].y) = (-0.7, -0.7);
            (corners[2].y, corners[3].y) = (0.7, 0.7);
        }
        let mut behind = setup.surfaces[seat].clone();
        behind.name = format!("rear {}", behind.name);
        if let Outline::Polygon(corners) = &mut behind.outline {
            corners.iter_mut().for_each(|c| c.x -= 0.9);
        }
        setup.surfaces.push(behind);
    }
    start(setup)
}

#[test]
fn all_four_seats_seat_the_body_alike() {
    let first = four_seats(false, false);
    for (rear, right) in [(false, true), (true, false), (true, true)] {
        let other = four_seats(rear, right);
        let shift = Vector3::new(if rear { -0.9 } else { 0.0 }, if right { 0.7 } else { 0.0 }, 0.0);
        for (a, b) in first.joints_m.iter().flatten().zip(other.joints_m.iter().flatten()) {
            // Measured: 3.5e-16.
            assert_below("place less the shift, m", (b - a - shift).norm(), 1e-14);
        }
    }
}

/// The error text of a seating that cannot be.
fn refused(setup: Setup) -> String {
    Model::new(setup).expect_err("a seat that cannot be").to_string()
}

#[test]
fn heels_out_of_reach_are_an_error_that_says_by_how_much() {
    let far = refused(seated(|s| s.heels_m = [1.5, 0.3]));
    let body = male50();
    let leg: f64 = [8, 10].map(|n: usize| body.segments[n].length_m).iter().sum();
    // the hip is the pelvis sphere's centre: at (−3.973, 1.020) in
    let hip = start(seated(|_| {})).pelvis_m;
    let by = (1.5 - hip.x).hypot(0.3 - hip.z) - leg;
    for part in ["posture.heels", &format!("{by:.4} m out of reach"), "nearer to the seat"] {
        assert!(far.contains(part), "{part} in {far}");
    }
    // both legs are told of
    assert_eq!(far.lines().count(), 2);
    let near = refused(seated(|s| s.heels_m = [hip.x, hip.z + 0.01]));
    assert!(near.contains("away from the seat"), "{near}");
}

/// Where the hands begin that should be at [x, z], m, and what is said of them.
fn hands_at(hands_m: [f64; 2]) -> (Vec<Vector3<f64>>, String) {
    let mut setup = seated(|s| s.hands_m = Some(hands_m));
    setup.time.end_s = setup.time.start_s + 1e-4;
    let model = Model::new(setup).unwrap();
    let hands = ["left_hand", "right_hand"].map(|name| model.body().sphere(name).unwrap());
    let mut seen = Vec::new();
    let watch = Watch(|s: &Sample<'_>| {
        if seen.is_empty() {
            seen.extend(hands.map(|hand| s.sphere_centre_m(hand).coords));
        }
    });
    simulate(&model, watch).unwrap();
    (seen, model.warnings().iter().map(|problem| problem.to_string()).collect())
}

#[test]
fn hands_are_where_they_should_be_or_on_the_line_to_it() {
    for hands_m in [[0.30, -0.25], [0.15, -0.40], [0.15, 0.0]] {
        let (hands, said) = hands_at(hands_m);
        assert!(said.is_empty(), "{said}");
        for hand in &hands {
            assert_below("hand x, m", hand.x - hands_m[0], 1e-9);
            assert_below("hand z, m", hand.z - hands_m[1], 1e-9);
        }
        assert!(hands[0].y < hands[1].y - 0.2);
    }
    let (hands, said) = hands_at([2.0, -0.3]);
    assert!(hands.iter().all(|hand| hand.x < 1.0) && said.contains("arms are too short"), "{said}");
}

#[test]
fn a_cushion_that_faces_down_is_an_error() {
    let mut setup = seated(|_| {});
    let below = nalgebra::Point3::new(0.0, -0.35, 2.0);
    setup.surfaces[0].facing = occupant_core::forces::contact::surface::Facing::Towards(below);
    let text = refused(setup);
    assert!(text.contains("seat.cushion") && text.contains("faces up"), "{text}");
}

#[test]
fn cushion_and_back_in_one_plane_are_an_error() {
    let text = refused(seated(|s| s.back = s.cushion));
    assert!(text.contains("parallel"), "{text}");
}

#[test]
fn the_body_starts_as_part_of_the_vehicle_or_with_a_velocity_of_its_own() {
    let moving = |velocity: InitialVelocity| {
        let mut setup = lap(Integrator::Rk4 { step_s: 1e-4 });
        setup.velocity = velocity;
        Model::new(setup).unwrap().start().state.velocity().to_vector()
    };
    let speed = 352.0 * INCH_M;
    let with = moving(InitialVelocity::WithVehicle);
    // Measured: 0.
    assert_below("with the vehicle, m/s", (with - Vector3::x() * speed).norm(), 1e-14);
    let given = moving(InitialVelocity::Given(Vector3::new(1.0, 2.0, 3.0)));
    assert_eq!(given, Vector3::new(1.0, -2.0, -3.0));
}

/// All joints damped by `damping` N·m·s against bending, turning and twisting.
fn stiff(damping: f64) -> Joints {
    let ball = BallJoint { damping_n_m_s: damping, twist_damping_n_m_s: damping, ..BallJoint::default() };
    let hinge = HingeJoint { damping_n_m_s: damping, ..HingeJoint::default() };
    Joints::alike(&TTI12, ball, hinge).with_epsilon(0.1)
}

/// How far the pelvis goes in 0.1 s with stiff joints, m.
fn drift(settle: Settling, damping: f64) -> f64 {
    let mut setup = seated(|s| s.settle = settle);
    setup.joints = stiff(damping);
    setup.integrator = Integrator::Rk4 { step_s: 2e-5 };
    setup.time.end_s = 0.1;
    let model = Model::new(setup).unwrap();
    let (mut first, mut last) = (None, Vector3::zeros());
    simulate(
        &model,
        Watch(|s: &Sample<'_>| {
            last = s.sphere_centre_m(PELVIS).coords;
            first.get_or_insert(last);
        }),
    )
    .unwrap();
    (last - first.unwrap()).norm()
}

#[test]
fn a_settled_body_with_locked_joints_leaves_no_residual_and_stays_where_it_is() {
    let model = Model::new(seated(|s| s.settle = Settling::Locked)).unwrap();
    let settled = model.start().settled.unwrap();
    // Measured: 1.5e-12.
    assert_below("residual, of the weight", settled.residual_force_n / settled.weight_n, 1e-8);
    // Measured: 7.9e-11.
    assert_below("residual moment, N·m", settled.residual_moment_n_m, 1e-6);
    assert!(model.warnings().is_empty());
    // Measured: 0.00666.
    assert_within("moved, m", settled.moved_m, [1e-3, 0.1]);
    // joints that give way slowly let it creep in proportion to 1/J
    let (soft, hard) = (drift(Settling::Locked, 250.0), drift(Settling::Locked, 500.0));
    // Measured: 2.7e-5.
    assert_below("drift of rigid joints by extrapolation, m", 2.0 * hard - soft, 1e-4);
    // Measured: 0.00397.
    assert_within("drift of an unsettled body, m", drift(Settling::Not, 500.0), [1e-3, 0.1]);
}

#[test]
fn settling_keeps_the_posture() {
    let states = [Settling::Not, Settling::Locked].map(|settle| {
        let model = Model::new(seated(|s| s.settle = settle)).unwrap();
        let k = occupant_core::motion::kinematics::Kinematics::new(&model.system().skeleton, &model.start().state);
        k.axes.map(|a| a.to_matrix()).to_vec()
    });
    let [before, after] = states;
    let turn: Matrix3<f64> = after[0] * before[0].transpose();
    for (a, b) in before.iter().zip(&after).take(12) {
        // Measured: 3.1e-16.
        assert_below("one turn for all", (turn * a - b).norm(), 1e-12);
    }
}

/// Nearer heels raise the thighs off the cushion: nothing but the pelvis touches then, and its sphere does not resist turning.
#[test]
fn a_body_whose_feet_hang_tips_until_they_stand() {
    let mut start = start(seated(|s| {
        s.settle = Settling::Locked;
        s.heels_m = [22.0 * INCH_M, 13.0 * INCH_M];
    }));
    let settled = start.model.start().settled.unwrap();
    assert_below("residual, of the weight", settled.residual_force_n / settled.weight_n, 1e-7);
    assert_below("residual moment, N·m", settled.residual_moment_n_m, 1e-4);
    assert!(start.model.warnings().is_empty());
    start.contacts.retain(|c| c.surface == 2);
    assert_eq!(start.contacts.len(), 2, "both feet on the floor: {:?}", start.contacts);
}

/// Friction holds what the 6 N of a spool pull at one shoulder; without it they turned the body by 6 degrees.
#[test]
fn the_spool_of_a_retractor_does_not_turn_a_seated_body() {
    let start = start(setup(include_str!("../../tests/data/hand/three-point.toml"), &[]));
    assert!(start.model.start().settled.unwrap().moved_m > 1e-3);
    let [l, r] = [tti12::LEFT_LOWER_LEG, tti12::RIGHT_LOWER_LEG].map(|n| start.joints_m[n.index()][0]);
    assert_below("one knee ahead of the other, m", l.x - r.x, 1e-3);
    assert_below("to the side, m", (l + r).y / 2.0 + 0.35, 1e-3);
}

/// A summary says whose start is not in balance, and of which figures that takes the sense: pressed 2.6 mm into a bolster each knee feels
/// 1.8 kN, which are gone after a few milliseconds.
#[test]
fn figures_of_an_unbalanced_start_are_marked() {
    let shipped = include_str!("../../scenarios/sled-person.toml");
    let pressed = r#"surfaces.bolster.edge=[["459.5 mm", "-87.6 mm"], ["620.2 mm", "103.9 mm"]]"#;
    let caveat = |set: &[&str]| {
        let mut summarizer = Summarizer::new();
        run(setup(shipped, set), &mut summarizer);
        summarizer.summary(None).unwrap().caveats.into_iter().find(|caveat| caveat.name == "start_unbalanced")
    };
    assert_eq!(caveat(&["time.end=20 ms"]), None);
    let marked = caveat(&["time.end=20 ms", pressed]).expect("3.6 kN are left over");
    assert!(marked.text.contains("a force of 3554 N is left over (weight 740 N)"), "{}", marked.text);
    for figure in ["pelvis.peak", "contacts.left_knee.peak", "hic15"] {
        assert!(marked.touches(figure), "{figure}: {:?}", marked.figures);
    }
    // what comes later stands
    let marked = caveat(&[pressed]).unwrap();
    assert!(!marked.touches("head.peak") && marked.touches("contacts.left_knee.peak"), "{:?}", marked.figures);
}

/// The scenarios in a folder of the repository.
fn shipped(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(folder);
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    files.filter(|path| path.extension().is_some_and(|ending| ending == "toml")).collect()
}

/// A scenario with the tables beside it.
fn read(path: &Path) -> Setup {
    let beside = |name: &str| fs::read(path.with_file_name(name)).map_err(|e| e.to_string());
    let draft = Draft::read(&fs::read_to_string(path).unwrap(), Format::Toml, "test").unwrap();
    draft.load(&beside).and_then(|loaded| loaded.build()).unwrap().0
}

#[test]
fn every_shipped_body_begins_in_balance() {
    let mut seen = 0;
    for path in ["scenarios", "scenarios/templates"].into_iter().flat_map(shipped) {
        let name = path.display();
        let model = Model::new(read(&path)).unwrap_or_else(|e| panic!("{name}: {e:?}"));
        let all = if model.alone().is_empty() { std::slice::from_ref(&model) } else { model.alone() };
        for alone in all {
            let left = alone.start().unsettled.or(alone.start().settled);
            assert!(!left.is_some_and(|left| left.is_unbalanced()), "{name}: {left:?}");
            seen += usize::from(left.is_some());
        }
    }
    assert!(seen > 15, "{seen} seated bodies");
}
