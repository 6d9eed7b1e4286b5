//! Paths from recorded motion: closed forms, identities, order, and what is refused.

use nalgebra::{Matrix3, Vector3};

use super::*;
use crate::vehicle::support::{Seeded, assert_below, differentiate, omega_of};
use crate::vehicle::{PathCursor, VehiclePath};

const G: f64 = 9.806_65;

/// Times `dt_s` apart from 0 to `end_s`.
fn times(dt_s: f64, end_s: f64) -> Vec<f64> {
    let steps = (end_s / dt_s).round() as usize;
    (0..=steps).map(|i| i as f64 * dt_s).collect()
}

/// A record of six channels, sampled from functions of time.
fn recorded(
    time_s: Vec<f64>,
    acceleration: impl Fn(f64) -> Vector3<f64>,
    rate: impl Fn(f64) -> Vector3<f64>,
) -> AccelerationRecord {
    let of = |f: &dyn Fn(f64) -> Vector3<f64>| [0, 1, 2].map(|axis| Some(time_s.iter().map(|&t| f(t)[axis]).collect()));
    AccelerationRecord { acceleration_m_s2: of(&acceleration), rate_rad_s: of(&rate), time_s }
}

fn definition(record: AccelerationRecord) -> SensorDefinition {
    SensorDefinition {
        record: SensorRecord::Accelerations(record),
        initial: VehiclePose::default(),
        initial_speed_m_s: 0.0,
        direction: TravelDirection::Heading,
        offset_m: Vector3::zeros(),
        gravity: SensorGravity::Removed,
        gravity_m_s2: G,
        filter: None,
        baseline_s: None,
        baseline_end_s: None,
        strength: 1.0,
        starts_at_s: None,
        after: AfterEnd::Error,
    }
}

fn pose(path: &SensorPath, t_s: f64) -> VehiclePose {
    path.pose(t_s, &mut PathCursor::default())
}

fn constant(x: f64, y: f64, z: f64) -> impl Fn(f64) -> Vector3<f64> {
    move |_| Vector3::new(x, y, z)
}

fn tilted() -> Attitude {
    Attitude { roll_rad: 0.3, pitch_rad: -0.2, yaw_rad: 1.1 }
}

#[test]
fn a_steady_turn_is_a_circle() {
    // ay = V r; the circle has the radius V/r
    let (v, r) = (20.0, 0.5);
    let record = recorded(times(1e-3, 4.0), constant(0.0, v * r, 0.0), constant(0.0, 0.0, r));
    let path = SensorPath::new(SensorDefinition { initial_speed_m_s: v, ..definition(record) }).unwrap();
    let mut cursor = PathCursor::default();
    for t in [0.5, 1.2345, 4.0] {
        let (sin, cos) = (r * t).sin_cos();
        let circle = Vector3::new(v / r * sin, v / r * (1.0 - cos), 0.0);
        let found = pose(&path, t);
        // measured 9.5e-14 m
        assert_below("place", (found.position_m - circle).norm(), 1e-10);
        assert_below("yaw", (found.attitude.yaw_rad - r * t).abs(), 1e-12); // 6.0e-15
        let speed = path.motion(t, t, &mut cursor).velocity_m_s.norm();
        assert_below("speed", (speed - v).abs(), 1e-11); // 9.9e-14
    }
}

#[test]
fn a_level_of_gravity_at_rest_stays_at_rest_in_any_attitude() {
    let attitude = tilted();
    let felt = attitude.matrix().tr_mul(&Vector3::new(0.0, 0.0, -G));
    for (gravity, reading) in [
        (SensorGravity::Included, felt),
        (SensorGravity::Zeroed, Vector3::zeros()),
        (SensorGravity::Removed, Vector3::zeros()),
    ] {
        let record = recorded(times(1e-3, 1.0), move |_| reading, constant(0.0, 0.0, 0.0));
        let path = SensorPath::new(SensorDefinition {
            initial: VehiclePose { attitude, ..VehiclePose::default() },
            offset_m: Vector3::new(0.4, -0.2, 0.1),
            gravity,
            ..definition(record)
        })
        .unwrap();
        let end = pose(&path, 1.0);
        assert_below("drift", end.position_m.norm(), 1e-14); // 5.6e-17
        let turned = (end.attitude.to_vector() - attitude.to_vector()).norm();
        assert_below("turn", turned, 1e-14);
    }
}

#[test]
fn sensors_that_feel_nothing_fall() {
    let record = recorded(times(1e-2, 1.0), constant(0.0, 0.0, 0.0), constant(0.7, 2.0, -1.0));
    let path = SensorPath::new(SensorDefinition { gravity: SensorGravity::Included, ..definition(record) }).unwrap();
    let fall = pose(&path, 1.0).position_m - Vector3::new(0.0, 0.0, 0.5 * G);
    assert_below("fall while tumbling", fall.norm(), 1e-13); // 8.9e-16
}

#[test]
fn a_vehicle_that_spins_about_its_centre_leaves_it_where_it_is() {
    // sensors at r feel ω̇ × r + ω × (ω × r)
    let (arm, slope) = (Vector3::new(1.5, 0.3, -0.2), 4.0);
    let felt = move |t: f64| {
        let (omega, alpha) = (Vector3::z() * (3.0 + slope * t), Vector3::z() * slope);
        alpha.cross(&arm) + omega.cross(&omega.cross(&arm))
    };
    let rate = move |t: f64| Vector3::z() * (3.0 + slope * t);
    let drift_of = |dt_s: f64| {
        let path =
            SensorPath::new(SensorDefinition { offset_m: arm, ..definition(recorded(times(dt_s, 1.0), felt, rate)) })
                .unwrap();
        assert_below("yaw", (pose(&path, 1.0).attitude.yaw_rad - 5.0).abs(), 1e-12);
        pose(&path, 1.0).position_m.norm()
    };
    // the parabola ω(t)² between samples is read as a straight line: an error of order 2
    let (coarse, fine) = (drift_of(1e-3), drift_of(5e-4));
    assert_below("drift", coarse, 2e-6); // 1.16e-6 m
    assert_below("order", (coarse / fine - 4.0).abs(), 0.01);
}

#[test]
fn zeroed_sensors_feel_gravity_come_in_as_the_vehicle_rolls() {
    // the c.g. stays while the vehicle rolls; zeroing took (0, 0, −g) away
    let felt = |t: f64| {
        let (sin, cos) = (2.0 * t).sin_cos();
        Vector3::new(0.0, -G * sin, -G * cos + G)
    };
    let record = recorded(times(1e-3, 0.5), felt, constant(2.0, 0.0, 0.0));
    let path = SensorPath::new(SensorDefinition { gravity: SensorGravity::Zeroed, ..definition(record) }).unwrap();
    let end = pose(&path, 0.5);
    assert_below("drift", end.position_m.norm(), 1e-6); // 4.1e-7 m, order 2 in the interval
    assert_below("roll", (end.attitude.roll_rad - 1.0).abs(), 1e-12);
}

/// Rz(σt) Ry(β) Rz(−σt): coning motion without spin.
fn cone(half_angle: f64, sigma: f64, t: f64) -> Matrix3<f64> {
    let about_z = |angle: f64| rotation(Vector3::z() * angle);
    about_z(sigma * t) * rotation(Vector3::y() * half_angle) * about_z(-sigma * t)
}

fn rotation(turn: Vector3<f64>) -> Matrix3<f64> {
    nalgebra::Rotation3::new(turn).into_inner()
}

#[test]
fn coning_does_not_drift() {
    let (half_angle, sigma) = (0.1, std::f64::consts::TAU * 5.0);
    let rate = |t: f64| {
        let turned = cone(half_angle, sigma, t);
        turned.tr_mul(&(Vector3::z() * sigma)) - Vector3::z() * sigma
    };
    let error_of = |dt_s: f64| {
        let start = VehiclePose {
            attitude: Attitude::from_matrix(&cone(half_angle, sigma, 0.0), &Attitude::default()),
            ..VehiclePose::default()
        };
        let path = SensorPath::new(SensorDefinition {
            initial: start,
            ..definition(recorded(times(dt_s, 1.0), constant(0.0, 0.0, 0.0), rate))
        })
        .unwrap();
        (pose(&path, 1.0).attitude.matrix() - cone(half_angle, sigma, 1.0)).norm()
    };
    let (coarse, fine) = (error_of(2e-3), error_of(1e-3));
    // 3.6e-5 of 0.157 rad that the solid angle of five cones makes about the axis
    assert_below("attitude after five cones", fine, 1e-4);
    assert!(coarse / fine > 3.9, "order: {coarse:e} {fine:e}");
}

/// A smooth tumbling motion: position and its derivatives, attitude with rates.
fn wild(seed: u64, t: f64) -> (Vector3<f64>, Vector3<f64>, Vector3<f64>, Attitude) {
    let mut seeded = Seeded(seed);
    let mut waves = |size: f64| {
        let (amplitude, phase) = (seeded.vector(-size, size), seeded.vector(-3.0, 3.0));
        let frequency = seeded.vector(2.0, 9.0);
        move |derivative: i32| {
            Vector3::from_fn(|i, _| {
                let angle = frequency[i] * t + phase[i];
                let value = match derivative {
                    0 => angle.sin(),
                    1 => angle.cos(),
                    _ => -angle.sin(),
                };
                amplitude[i] * frequency[i].powi(derivative) * value
            })
        }
    };
    let (place, angles) = (waves(2.0), waves(0.8));
    (place(0), place(1), place(2), Attitude::from_vector(angles(0)))
}

#[test]
fn sensors_on_a_tumbling_vehicle_give_its_path_back() {
    let offset_m = Vector3::new(-0.7, 0.3, 0.2);
    for seed in 1..=5 {
        let attitude = |t: f64| wild(seed, t).3.matrix();
        let rate = |t: f64| {
            let derivative = differentiate(attitude, t, 1e-3);
            attitude(t).tr_mul(&omega_of(attitude(t), derivative, 1e-6))
        };
        let felt = |t: f64| {
            let (omega, alpha) = (rate(t), differentiate(rate, t, 1e-3));
            let down = Vector3::new(0.0, 0.0, G);
            attitude(t).tr_mul(&(wild(seed, t).2 - down))
                + alpha.cross(&offset_m)
                + omega.cross(&omega.cross(&offset_m))
        };
        let error_of = |dt_s: f64| {
            let (place, velocity, _, attitude) = wild(seed, 0.0);
            let path = SensorPath::new(SensorDefinition {
                initial: VehiclePose { position_m: place, attitude },
                initial_speed_m_s: velocity.norm(),
                direction: TravelDirection::Along(velocity),
                offset_m,
                gravity: SensorGravity::Included,
                ..definition(recorded(times(dt_s, 0.5), felt, rate))
            })
            .unwrap();
            let (found, expected) = (pose(&path, 0.5), wild(seed, 0.5));
            let turn = found.attitude.matrix() - expected.3.matrix();
            (found.position_m - expected.0).norm() + turn.norm()
        };
        let (coarse, fine) = (error_of(2e-3), error_of(1e-3));
        assert_below("place (m) and attitude at the end", fine, 2e-4); // worst of the seeds: 2.5e-5
        assert!((3.5..4.5).contains(&(coarse / fine)), "order: {coarse:e} {fine:e}");
    }
}

#[test]
fn velocities_are_the_derivatives_of_the_path() {
    let mut seeded = Seeded(7);
    let random = |seeded: &mut Seeded, size: f64| -> Option<Vec<f64>> {
        Some((0..=20).map(|_| seeded.between(-size, size)).collect())
    };
    let record = AccelerationRecord {
        time_s: times(1e-3, 0.02),
        acceleration_m_s2: [(); 3].map(|()| random(&mut seeded, 300.0)),
        rate_rad_s: [(); 3].map(|()| random(&mut seeded, 8.0)),
    };
    let path = SensorPath::new(SensorDefinition {
        offset_m: Vector3::new(0.5, -0.4, 0.3),
        gravity: SensorGravity::Included,
        ..definition(record)
    })
    .unwrap();
    let motion = |t: f64| path.motion(t, t, &mut PathCursor::default());
    for i in 0..20 {
        // in the middle of each interval and close to both of its ends
        for part in [0.02, 0.5, 0.98] {
            let (t, step) = ((f64::from(i) + part) * 1e-3, 4e-6);
            let velocity = differentiate(|t| motion(t).origin_m, t, step);
            let here = motion(t);
            // the rate is a straight line, and the attitude its integral to the third order: measured 1.3e-5 m/s and 2.6e-5 rad/s
            assert_below("velocity", (velocity - here.velocity_m_s).norm(), 1e-4);
            let turning = differentiate(|t| motion(t).rotation, t, step);
            let omega = omega_of(here.rotation, turning, 1e-8);
            assert_below("angular velocity", (omega - here.angular_velocity_rad_s).norm(), 1e-4);
            let acceleration = differentiate(|t| motion(t).velocity_m_s, t, step);
            let error = (acceleration - here.acceleration_m_s2).norm();
            assert_below("acceleration", error, 2e-3); // 2.0e-4
        }
        let (before, after) = (motion(1e-3 * f64::from(i) - 1e-9), motion(1e-3 * f64::from(i) + 1e-9));
        let jump = (before.velocity_m_s - after.velocity_m_s).norm();
        assert_below("jump of the velocity at a sample", jump, 1e-4); // 1.2e-5
    }
}

#[test]
fn a_channel_that_is_not_there_is_a_motion_that_is_not_there() {
    // a planar record in a vehicle that would otherwise fall
    let record = AccelerationRecord {
        time_s: times(1e-3, 1.0),
        acceleration_m_s2: [Some(vec![-2.0; 1001]), None, None],
        rate_rad_s: [None, None, None],
    };
    let path = SensorPath::new(SensorDefinition {
        initial_speed_m_s: 10.0,
        gravity: SensorGravity::Included,
        ..definition(record)
    })
    .unwrap();
    let end = pose(&path, 1.0);
    assert_below("place", (end.position_m - Vector3::new(9.0, 0.0, 0.0)).norm(), 1e-12); // 3.3e-13
    assert_eq!(end.attitude, Attitude::default());
}

#[test]
fn velocity_changes_come_back_at_every_point() {
    let delta_v = vec![0.0, -0.4, -3.0, -7.5, -11.0, -12.6, -12.6, -12.4];
    let time_s: Vec<f64> = (0..8).map(|i| 0.01 * f64::from(i)).collect();
    let record =
        DeltaVRecord { time_s: time_s.clone(), longitudinal_m_s: Some(delta_v.clone()), ..DeltaVRecord::default() };
    let path = SensorPath::new(SensorDefinition {
        record: SensorRecord::DeltaV(record),
        initial_speed_m_s: 15.0,
        ..definition(AccelerationRecord::default())
    })
    .unwrap();
    let motion = |t: f64| path.motion(t, t, &mut PathCursor::default());
    for (t, lost) in time_s.iter().zip(&delta_v) {
        let speed = motion(*t).velocity_m_s.x;
        assert_below("speed", (speed - (15.0 + lost)).abs(), 1e-12); // 2.7e-15
    }
    // no acceleration where the velocity is level, none against the change where it falls
    assert_below("level", motion(0.055).acceleration_m_s2.norm(), 1e-9);
    for i in 0..600 {
        assert!(motion(f64::from(i) * 1e-4).acceleration_m_s2.x < 1e-9);
    }
}

#[test]
fn velocity_changes_turn_with_the_yaw_rate() {
    // dvy = V r t in a steady turn
    let (v, r) = (20.0, 0.5);
    let time_s: Vec<f64> = (0..=25).map(|i| 0.01 * f64::from(i)).collect();
    let record = DeltaVRecord {
        longitudinal_m_s: Some(vec![0.0; 26]),
        lateral_m_s: Some(time_s.iter().map(|t| v * r * t).collect()),
        yaw_rate_rad_s: Some(vec![r; 26]),
        time_s,
    };
    let path = SensorPath::new(SensorDefinition {
        record: SensorRecord::DeltaV(record),
        initial_speed_m_s: v,
        ..definition(AccelerationRecord::default())
    })
    .unwrap();
    let (sin, cos) = (r * 0.25f64).sin_cos();
    let circle = Vector3::new(v / r * sin, v / r * (1.0 - cos), 0.0);
    let end = pose(&path, 0.25).position_m;
    assert_below("place", (end - circle).norm(), 1e-12); // 2.7e-15
}

#[test]
fn a_baseline_takes_the_zero_errors_away() {
    let attitude = tilted();
    let at_rest = attitude.matrix().tr_mul(&Vector3::new(0.0, 0.0, -G));
    let error = Vector3::new(0.5, -0.3, 0.2);
    let brakes = |t: f64| Vector3::x() * if t > 0.1 { -5.0 } else { 0.0 };
    let with = |wrong: Vector3<f64>, baseline_s| {
        let felt = move |t: f64| at_rest + brakes(t) + wrong;
        let record = recorded(times(1e-3, 0.4), felt, move |_| wrong * 0.1);
        SensorPath::new(SensorDefinition {
            initial: VehiclePose { attitude, ..VehiclePose::default() },
            initial_speed_m_s: 10.0,
            gravity: SensorGravity::Included,
            baseline_s,
            ..definition(record)
        })
        .unwrap()
    };
    let (ideal, mended) = (with(Vector3::zeros(), None), with(error, Some(0.05)));
    let (ideal, mended) = (pose(&ideal, 0.4), pose(&mended, 0.4));
    assert_below("place", (ideal.position_m - mended.position_m).norm(), 1e-12); // 0
    let turned = (ideal.attitude.to_vector() - mended.attitude.to_vector()).norm();
    assert_below("attitude", turned, 1e-12);
}

#[test]
fn a_path_may_start_inside_its_record() {
    let ramp = |t: f64| Vector3::new(-30.0 * t, 0.0, 0.0);
    let record = recorded(times(1e-2, 1.0), ramp, constant(0.0, 0.0, 0.0));
    let path =
        SensorPath::new(SensorDefinition { initial_speed_m_s: 20.0, starts_at_s: Some(0.505), ..definition(record) })
            .unwrap();
    assert_eq!(path.span_s(), (0.505, 1.0));
    let end = path.motion(1.0, 1.0, &mut PathCursor::default());
    let lost = 15.0 * (1.0 - 0.505 * 0.505);
    assert_below("speed", (end.velocity_m_s.x - (20.0 - lost)).abs(), 1e-12);
}

#[test]
fn a_filter_keeps_a_level_and_takes_a_hum_away() {
    let hum = |t: f64| Vector3::x() * (-20.0 + 100.0 * (std::f64::consts::TAU * 2000.0 * t).sin());
    let record = recorded(times(1e-4, 0.2), hum, constant(0.0, 0.0, 0.0));
    let path = SensorPath::new(SensorDefinition {
        initial_speed_m_s: 10.0,
        filter: Some(ChannelClass::Cfc60),
        ..definition(record)
    })
    .unwrap();
    let middle = path.motion(0.1, 0.1, &mut PathCursor::default());
    assert_below("hum", (middle.acceleration_m_s2.x + 20.0).abs(), 1e-3); // 9.3e-13
    assert_below("speed", (middle.velocity_m_s.x - 8.0).abs(), 2e-3); // 6.6e-6
}

#[test]
fn after_the_record_the_vehicle_coasts_or_stands_as_it_is_told() {
    let with = |after| {
        let record = recorded(times(1e-3, 0.5), constant(-4.0, 0.0, 0.0), constant(0.0, 0.0, 0.4));
        VehiclePath::Sensors(Box::new(
            SensorPath::new(SensorDefinition {
                initial_speed_m_s: 10.0,
                offset_m: Vector3::new(1.0, 0.0, 0.0),
                after,
                ..definition(record)
            })
            .unwrap(),
        ))
    };
    assert!(with(AfterEnd::Error).check_span(0.0, 0.5).is_ok());
    let found = |after, start_s, end_s| with(after).check_span(start_s, end_s).unwrap_err().found;
    assert_eq!(found(AfterEnd::Error, 0.0, 0.6), "the run ends at 0.6 s");
    assert_eq!(found(AfterEnd::Coast, -0.1, 0.6), "the run starts at -0.1 s");
    let motion = |path: &VehiclePath, t: f64| path.motion(t, t, &mut PathCursor::default());
    let coasting = with(AfterEnd::Coast);
    let (end, later) = (motion(&coasting, 0.5), motion(&coasting, 0.8));
    let gone = later.origin_m - end.origin_m - end.velocity_m_s * 0.3;
    assert_below("coasting", gone.norm(), 1e-12);
    let yaw = |t| coasting.attitude(t, &mut PathCursor::default()).attitude.yaw_rad;
    assert_below("yaw", (yaw(0.8) - 0.4 * 0.8).abs(), 1e-12);
    assert_below("yaw after turns", (yaw(50.0) - 0.4 * 50.0).abs(), 1e-9);
    let standing = with(AfterEnd::Hold);
    assert_eq!(motion(&standing, 0.8).velocity_m_s, Vector3::zeros());
    let same = motion(&standing, 0.8).origin_m - motion(&standing, 0.5).origin_m;
    assert_eq!(same, Vector3::zeros());
}

#[test]
fn everything_wrong_is_said_at_once() {
    let mut record = recorded(times(0.1, 0.5), constant(1.0, 0.0, 0.0), constant(0.0, 0.0, 0.0));
    record.time_s[2] = 0.05;
    record.acceleration_m_s2[1] = Some(vec![f64::NAN; 6]);
    record.rate_rad_s[2] = Some(vec![0.0; 4]);
    let problems = SensorPath::new(SensorDefinition {
        initial_speed_m_s: -1.0,
        direction: TravelDirection::Along(Vector3::zeros()),
        starts_at_s: Some(7.0),
        ..definition(record)
    })
    .unwrap_err();
    let count = |words: &str| problems.iter().filter(|p| p.to_string().contains(words)).count();
    assert_eq!(count(": found ay = NaN, expected a finite number"), 6);
    assert_eq!(count("station 3: found t = "), 1);
    assert_eq!(count("samples of wz, expected "), 1);
    assert_eq!(count("expected 0 or more"), 1);
    assert_eq!(count("the direction of travel is zero"), 1);
    assert_eq!(count("expected a time of the record"), 1);
    assert_eq!(problems.len(), 11);
}

#[test]
fn what_cannot_be_integrated_is_refused() {
    let refused = |change: &dyn Fn(&mut SensorDefinition)| {
        let record = recorded(times(0.01, 0.5), constant(1.0, 0.0, 0.0), constant(0.0, 0.0, 1.0));
        let mut asked = definition(record);
        change(&mut asked);
        SensorPath::new(asked).unwrap_err().iter().map(PathProblem::to_string).collect::<Vec<_>>()
    };
    let record = |d: &mut SensorDefinition, change: &dyn Fn(&mut AccelerationRecord)| {
        if let SensorRecord::Accelerations(record) = &mut d.record {
            change(record);
        }
    };
    let only = |problems: Vec<String>, words: &str| {
        assert!(problems.len() == 1 && problems[0].contains(words), "{problems:?}");
    };
    let too_fast = "Hz, expected less than half the sample rate, 50.0 Hz; use a lower class";
    only(refused(&|d| d.filter = Some(ChannelClass::Cfc180)), too_fast);
    let uneven = refused(&|d| {
        d.filter = Some(ChannelClass::Cfc60);
        record(d, &|r| r.time_s[50] += 0.007);
    });
    only(uneven, "for a filter needs samples evenly spaced in time");
    let spinning = refused(&|d| record(d, &|r| r.rate_rad_s[2] = Some(vec![200.0; 51])));
    assert!(spinning[0].starts_with("station 2: the vehicle turns by 114.6° since the sample before"), "{spinning:?}");
    only(refused(&|d| d.baseline_s = Some(0.5)), "the baseline of 0.5 s has 51 samples");
    let empty = AccelerationRecord { time_s: vec![0.0, 1.0], ..AccelerationRecord::default() };
    only(
        refused(&|d| d.record = SensorRecord::Accelerations(empty.clone())),
        "found no channel that moves the vehicle",
    );
}
