use nalgebra::Vector3;

use super::support::{Seeded, acceleration_at, assert_below, differentiate};
use super::*;

#[test]
fn the_vehicle_axes_are_forward_right_down() {
    let path = FixedPath::new(VehiclePose::default()).expect("a sound pose");
    let motion = VehiclePath::Fixed(path).motion(3.0, 3.0, &mut PathCursor::default());
    assert_eq!(motion.vector_to_space(Vector3::new(1.0, 2.0, 3.0)), Vector3::new(1.0, -2.0, -3.0));
    assert_eq!(motion.velocity_at(Vector3::new(4.0, 5.0, 6.0)), Vector3::zeros());
}

#[test]
fn a_quarter_turn_by_hand() {
    // 10 m ahead, 3 m to the right, yawed 90° to the right: its nose points to −Y′, its right side to −X′.
    let attitude = Attitude { yaw_rad: std::f64::consts::FRAC_PI_2, ..Attitude::default() };
    let pose = VehiclePose { position_m: Vector3::new(10.0, 3.0, 0.0), attitude };
    let motion = FixedPath::new(pose).expect("a sound pose").motion;
    let bumper = motion.point_to_space(Vector3::new(2.0, 0.5, -1.0));
    assert_below(
        "bumper",
        (bumper - Vector3::new(9.5, -5.0, 1.0)).amax(),
        1e-14, // 0
    );
    assert_below(
        "back",
        (motion.point_to_frame(bumper) - Vector3::new(2.0, 0.5, -1.0)).amax(),
        1e-15, // 1.1e-16
    );
}

#[test]
fn points_and_vectors_go_to_space_and_back() {
    let mut seeded = Seeded(31);
    let mut worst: f64 = 0.0;
    for _ in 0..100 {
        let attitude = Attitude::from_vector(seeded.vector(-3.0, 3.0));
        let pose = VehiclePose { position_m: seeded.vector(-50.0, 50.0), attitude };
        let motion = FixedPath::new(pose).expect("a sound pose").motion;
        let point = seeded.vector(-2.0, 2.0);
        worst = worst.max((motion.point_to_frame(motion.point_to_space(point)) - point).amax());
        worst = worst.max((motion.vector_to_frame(motion.vector_to_space(point)) - point).amax());
    }
    assert_below("there and back, m", worst, 1e-13); // 4.0e-15
    assert_eq!(FrameMotion::space().point_to_space(Vector3::x()), Vector3::x());
}

#[test]
fn a_point_of_the_vehicle_moves_as_its_place_does() {
    let mut seeded = Seeded(32);
    let stations = (0..8)
        .map(|i| Station::new(f64::from(i) * 0.2, seeded.vector(-1.0, 1.0).into(), seeded.vector(-0.7, 0.7).into()))
        .collect();
    let table = TablePath::new(stations, Interpolation::Spline, AfterEnd::Error).expect("a sound table");
    let path = VehiclePath::Table(table);
    let at = |t_s: f64| path.motion(t_s, t_s, &mut PathCursor::default());
    let arm = Vector3::new(1.0, -0.5, 0.3);
    let (mut velocity, mut acceleration) = (0.0f64, 0.0f64);
    for i in 0..7 {
        let t_s = 0.1 + 0.2 * f64::from(i);
        let (now, place) = (at(t_s), |t: f64| at(t).point_to_space(arm));
        let v = differentiate(place, t_s, 1e-4);
        let a = differentiate(|t| at(t).velocity_at(place(t)), t_s, 1e-4);
        velocity = velocity.max((v - now.velocity_at(place(t_s))).amax());
        acceleration = acceleration.max((a - acceleration_at(&now, place(t_s))).amax());
    }
    assert_below("velocity", velocity, 1e-11); // 3.3e-12
    assert_below("acceleration", acceleration, 1e-9); // 8.3e-11
}

#[test]
fn a_frame_at_rest_has_no_span_and_no_breaks() {
    let path = VehiclePath::Fixed(FixedPath::new(VehiclePose::default()).expect("a sound pose"));
    assert_eq!(path.check_span(-5.0, 5.0), Ok(()));
    assert!(path.check_span(0.0, f64::INFINITY).is_err());
    assert!(path.breaks_s().is_empty());
    assert_eq!(path.attitude(1.0, &mut PathCursor::default()), VehiclePose::default());
}

#[test]
fn every_number_of_a_pose_that_is_not_finite_is_told() {
    let attitude = Attitude { pitch_rad: f64::NAN, ..Attitude::default() };
    let pose = VehiclePose { position_m: Vector3::new(0.0, f64::INFINITY, 0.0), attitude };
    let messages: Vec<String> = FixedPath::new(pose).expect_err("unsound").iter().map(ToString::to_string).collect();
    assert_eq!(
        messages,
        ["found position y = inf, expected a finite number", "found pitch = NaN, expected a finite number"]
    );
}

#[test]
fn breaks_are_where_the_motion_has_corners() {
    let stations = || (0..3).map(|i| Station::new(f64::from(i), [0.0; 3], [0.0; 3])).collect::<Vec<_>>();
    let table = |interpolation| TablePath::new(stations(), interpolation, AfterEnd::Coast).expect("a sound table");
    assert_eq!(VehiclePath::Table(table(Interpolation::Linear)).breaks_s(), [0.0, 1.0, 2.0]);
    assert_eq!(VehiclePath::Table(table(Interpolation::Spline)).breaks_s(), [0.0, 2.0]);
    let definition = PulseDefinition {
        initial: VehiclePose::default(),
        initial_speed_m_s: 15.0,
        direction: TravelDirection::Heading,
        starts_at_s: 1.0,
        shape: PulseShape::Trapezoid {
            strength: Strength::PeakDeceleration(10.0),
            rise_s: 0.5,
            plateau_s: 1.0,
            fall_s: 0.5,
        },
        rebound_m_s: None,
    };
    let pulse = |initial_speed_m_s| {
        let definition = PulseDefinition { initial_speed_m_s, ..definition.clone() };
        VehiclePath::Pulse(PulsePath::new(definition).expect("a sound pulse")).breaks_s()
    };
    // Takes 2.5 m/s on the rise, 10 m/s on the plateau, 2.5 m/s on the fall.
    assert_eq!(pulse(20.0), [1.0, 1.5, 2.5, 3.0]);
    assert_eq!(pulse(7.5), [1.0, 1.5, 2.0]);
}
