use std::f64::consts::PI;

use super::super::support::{Seeded, assert_below, differentiate};
use super::super::{Attitude, VehiclePath};
use super::*;

const STANDARD_GRAVITY_M_S2: f64 = 9.80665;
const INCH_M: f64 = 0.0254;

/// A pulse from t = 0 on, straight ahead.
fn ahead(initial_speed_m_s: f64, shape: PulseShape) -> PulseDefinition {
    PulseDefinition {
        initial: VehiclePose::default(),
        initial_speed_m_s,
        direction: TravelDirection::Heading,
        starts_at_s: 0.0,
        shape,
        rebound_m_s: None,
    }
}

fn path(definition: PulseDefinition) -> PulsePath {
    PulsePath::new(definition).expect("a sound pulse")
}

fn at(path: &PulsePath, t_s: f64) -> FrameMotion {
    path.motion(t_s, &mut PathCursor::default())
}

/// Shapes of 0.1 s with the given strength, and the fraction of Δv·T by which each shortens the distance at constant
/// speed (the first moment of the deceleration).
fn shapes(strength: Strength) -> Vec<(PulseShape, f64)> {
    let duration_s = 0.1;
    let trapezoid = PulseShape::Trapezoid { strength, rise_s: 0.02, plateau_s: 0.05, fall_s: 0.03 };
    // Areas 0.01, 0.05, 0.015 about their centroids 0.0133, 0.045, 0.08 from the start; T − centroid of the whole.
    let centroid_s = (0.01 * 0.04 / 3.0 + 0.05 * 0.045 + 0.015 * 0.08) / 0.075;
    vec![
        (PulseShape::HalfSine { strength, duration_s }, 0.5),
        (PulseShape::Haversine { strength, duration_s }, 0.5),
        (PulseShape::Square { strength, duration_s }, 0.5),
        // Centroid of a triangle: (1 + peak fraction)/3.
        (PulseShape::Triangle { strength, duration_s, peak_fraction: 0.2 }, 0.6),
        (PulseShape::Triangle { strength, duration_s, peak_fraction: 0.0 }, 2.0 / 3.0),
        (PulseShape::Triangle { strength, duration_s, peak_fraction: 1.0 }, 1.0 / 3.0),
        (trapezoid, 1.0 - centroid_s / duration_s),
    ]
}

#[test]
fn peaks_follow_from_delta_v() {
    let delta_v_m_s = 15.0;
    let peaks = [PI / 0.2, 20.0, 10.0, 20.0, 20.0, 20.0, 2.0 / 0.15].map(|per_s| per_s * delta_v_m_s);
    for ((shape, _), peak) in shapes(Strength::DeltaV(delta_v_m_s)).into_iter().zip(peaks) {
        let found = path(ahead(20.0, shape));
        assert_below(
            "peak, m/s²",
            (found.peak_deceleration_m_s2() - peak).abs(),
            1e-13, // 2.8e-14
        );
        assert_below(
            "Δv, m/s",
            (found.pulse_delta_v_m_s() - delta_v_m_s).abs(),
            1e-14, // 1.8e-15
        );
        assert_below(
            "Δv of the vehicle, m/s",
            (found.delta_v_m_s() - delta_v_m_s).abs(),
            1e-14, // 1.8e-15
        );
        assert_below(
            "final speed, m/s",
            (at(&found, 0.3).velocity_m_s.x - 5.0).abs(),
            1e-14, // 1.8e-15
        );
        assert_eq!(found.stop(), None);
    }
    for ((shape, _), peak) in shapes(Strength::PeakDeceleration(100.0)).into_iter().zip(peaks) {
        let found = path(ahead(20.0, shape)).pulse_delta_v_m_s();
        assert_below(
            "Δv from the peak, m/s",
            (found - 100.0 * delta_v_m_s / peak).abs(),
            1e-14, // 8.9e-16
        );
    }
}

#[test]
fn a_pulse_as_strong_as_the_speed_stops_at_its_end_after_its_own_distance() {
    let speed_m_s = 13.7;
    for (shape, fraction) in shapes(Strength::DeltaV(speed_m_s)) {
        let found = path(ahead(speed_m_s, shape));
        let stop = found.stop().expect("a stop");
        assert_below("stop time, s", (stop.time_s - 0.1).abs(), 1e-15); // 0
        assert_below(
            "stopping distance, m",
            (stop.distance_m - speed_m_s * 0.1 * (1.0 - fraction)).abs(),
            1e-15, // 2.2e-16
        );
        assert_eq!(at(&found, 0.2).velocity_m_s, Vector3::zeros());
        assert_eq!(at(&found, 0.2).origin_m, at(&found, 9.0).origin_m);
    }
}

#[test]
fn the_report_s_cart_stop_as_a_half_sine() {
    // 20 mph = 352 in/s to rest in 80 ms: πΔv/(2T) = 6911.5 in/s², 17.9 g at 386.04 in/s² to the g.
    let speed_m_s = 352.0 * INCH_M;
    let shape = PulseShape::HalfSine { strength: Strength::DeltaV(speed_m_s), duration_s: 0.08 };
    let found = path(ahead(speed_m_s, shape));
    let peak_g = found.peak_deceleration_m_s2() / INCH_M / 386.04;
    assert_below("peak, g", (peak_g - 17.9).abs(), 0.05); // 3.6e-03
    let distance_in = found.stop().expect("a stop").distance_m / INCH_M;
    assert_below(
        "stopping distance, in",
        (distance_in - 352.0 * 0.04).abs(),
        1e-12, // 0
    );
}

#[test]
fn a_volunteer_sled_pulse_has_its_change_of_velocity() {
    // Sled run of the ATB validation set human.lin: g every 4 ms; its own Δv is 20.5 mph.
    let pulse_g = [
        0.03, 0.10, 0.0, 0.03, 0.0, 0.03, 0.10, 0.0, 0.03, 0.0, 0.03, 0.05, 0.02, 0.12, 0.22, 0.55, 1.76, 2.22, 2.75,
        3.67, 4.61, 5.65, 6.59, 7.46, 8.38, 8.98, 9.40, 9.40, 9.42, 9.25, 9.18, 9.18, 8.98, 8.82, 8.62, 8.62, 8.57,
        8.40, 8.14, 7.78, 7.41, 7.00, 6.57, 6.11, 5.72, 5.14, 4.47, 3.89, 3.26, 2.56, 1.81, 0.99, 0.26, 0.56, 0.51,
        0.24, 0.0,
    ];
    let table = |sign: f64| PulseShape::Tabulated {
        points: (0..pulse_g.len())
            .map(|i| DecelerationPoint {
                time_s: 0.004 * i as f64,
                deceleration_m_s2: sign * pulse_g[i] * STANDARD_GRAVITY_M_S2,
            })
            .collect(),
    };
    let mph = 0.44704;
    let braked = path(ahead(20.5 * mph, table(1.0)));
    assert_below(
        "Δv, mph",
        (braked.pulse_delta_v_m_s() / mph - 20.5).abs(),
        1e-4, // 1.2e-05
    );
    assert_below(
        "peak, g",
        (braked.peak_deceleration_m_s2() / STANDARD_GRAVITY_M_S2 - 9.42).abs(),
        1e-12, // 0
    );
    // The same pulse thrusts a sled at rest up to speed; it mirrors the braked one.
    let thrust = path(ahead(0.0, table(-1.0)));
    assert_eq!(thrust.stop(), None);
    for i in 0..60 {
        let t_s = 0.004 * f64::from(i) + 0.001;
        if braked.stop().is_none_or(|stop| t_s < stop.time_s) {
            let sum = at(&braked, t_s).velocity_m_s.x + at(&thrust, t_s).velocity_m_s.x;
            assert_below("sum of speeds, m/s", (sum - 20.5 * mph).abs(), 1e-13); // 0
        }
    }
}

#[test]
fn a_stronger_pulse_stops_the_vehicle_on_the_way_and_for_good() {
    // Constant deceleration: stops at v/a after v²/2a.
    let square = PulseShape::Square { strength: Strength::PeakDeceleration(100.0), duration_s: 0.5 };
    let found = path(ahead(10.0, square));
    let stop = found.stop().expect("a stop");
    assert_below("stop time, s", (stop.time_s - 0.1).abs(), 1e-15); // 0
    assert_below("stopping distance, m", (stop.distance_m - 0.5).abs(), 1e-15); // 0
    assert_eq!(found.delta_v_m_s(), 10.0);
    assert_eq!(found.pulse_delta_v_m_s(), 50.0);
    for (shape, _) in shapes(Strength::DeltaV(20.0)) {
        let found = path(ahead(12.0, shape));
        let stop = found.stop().expect("a stop");
        assert!(stop.time_s > 0.0 && stop.time_s < 0.1);
        let (before, after) = (at(&found, stop.time_s - 1e-13), at(&found, stop.time_s));
        assert_below("speed just before, m/s", before.velocity_m_s.norm(), 1e-9); // 3.9e-11
        assert_below(
            "place across the stop, m",
            (after.origin_m - before.origin_m).amax(),
            1e-15, // 1.1e-16
        );
        assert_eq!((after.velocity_m_s, after.acceleration_m_s2), (Vector3::zeros(), Vector3::zeros()));
        assert_eq!(at(&found, 5.0), after);
        assert_eq!(found.breaks_s().last(), Some(&stop.time_s));
    }
}

#[test]
fn a_table_that_would_drive_a_stopped_vehicle_on_leaves_it_at_rest() {
    let points = [(0.0, 100.0), (0.2, 100.0), (0.25, -100.0), (0.4, -100.0)]
        .map(|(time_s, deceleration_m_s2)| DecelerationPoint { time_s, deceleration_m_s2 });
    let found = path(ahead(10.0, PulseShape::Tabulated { points: points.to_vec() }));
    assert_below(
        "stop time, s",
        (found.stop().expect("a stop").time_s - 0.1).abs(),
        1e-15, // 0
    );
    assert_eq!(at(&found, 0.4).velocity_m_s, Vector3::zeros());
}

#[test]
fn a_rebound_lets_the_vehicle_go_back_so_fast_and_no_faster() {
    for (shape, _) in shapes(Strength::DeltaV(20.0)) {
        let found = path(PulseDefinition { rebound_m_s: Some(3.0), ..ahead(12.0, shape.clone()) });
        let without = path(ahead(12.0, shape.clone()));
        assert_eq!(found.stop(), without.stop());
        assert_eq!(found.delta_v_m_s(), 15.0);
        let stop = found.stop().expect("a stop");
        assert_eq!(at(&found, 0.1).velocity_m_s.x, -3.0);
        assert!(at(&found, 0.1).origin_m.x < stop.distance_m);
        let floor_s = *found.breaks_s().last().expect("a break");
        let across = at(&found, floor_s + 1e-13).origin_m - at(&found, floor_s - 1e-13).origin_m;
        assert_below("place across the floor, m", across.amax(), 1e-11); // 6.0e-13
        // A rebound that the pulse does not reach leaves the vehicle with what the pulse gives.
        let weak = path(PulseDefinition { rebound_m_s: Some(50.0), ..ahead(12.0, shape) });
        assert_below(
            "final speed, m/s",
            (at(&weak, 1.0).velocity_m_s.x + 8.0).abs(),
            1e-13, // 3.6e-15
        );
    }
}

#[test]
fn velocity_and_acceleration_are_the_derivatives_of_the_place() {
    for (shape, _) in shapes(Strength::DeltaV(20.0)) {
        let found = path(PulseDefinition { rebound_m_s: Some(3.0), ..ahead(12.0, shape) });
        let breaks_s = found.breaks_s();
        let ends_s = [&breaks_s[..], &[breaks_s[breaks_s.len() - 1] + 0.05]].concat();
        for pair in ends_s.windows(2) {
            let (t_s, step_s) = (0.5 * (pair[0] + pair[1]), (pair[1] - pair[0]) / 500.0);
            let v = differentiate(|t| at(&found, t).origin_m, t_s, step_s);
            let a = differentiate(|t| at(&found, t).velocity_m_s, t_s, step_s);
            assert_below(
                "velocity, m/s",
                (v - at(&found, t_s).velocity_m_s).amax(),
                1e-8, // 3.9e-10
            );
            assert_below(
                "acceleration, m/s²",
                (a - at(&found, t_s).acceleration_m_s2).amax(),
                1e-7, // 1.1e-08
            );
        }
    }
}

#[test]
fn a_delayed_pulse_is_the_same_pulse_later_and_farther_on() {
    let shape = PulseShape::Haversine { strength: Strength::DeltaV(9.0), duration_s: 0.1 };
    let now = path(ahead(10.0, shape.clone()));
    let later = path(PulseDefinition { starts_at_s: 0.25, ..ahead(10.0, shape) });
    assert_eq!(later.pulse_span_s(), (0.25, 0.35));
    assert_eq!(at(&later, 0.0).origin_m, Vector3::zeros());
    assert_below(
        "place at the start, m",
        (at(&later, 0.25).origin_m.x - 2.5).abs(),
        1e-15, // 0
    );
    for i in 0..20 {
        let t_s = 0.01 * f64::from(i);
        let apart = at(&later, 0.25 + t_s).origin_m.x - at(&now, t_s).origin_m.x - 2.5;
        assert_below("place, m", apart.abs(), 1e-14); // 8.9e-16
    }
    // A table whose first point is late delays the pulse just so.
    let points = [0.25, 0.35].map(|time_s| DecelerationPoint { time_s, deceleration_m_s2: 50.0 });
    let table = path(ahead(10.0, PulseShape::Tabulated { points: points.to_vec() }));
    assert_eq!(table.pulse_span_s(), (0.25, 0.25 + (0.35 - 0.25)));
    assert_eq!(at(&table, 0.2).acceleration_m_s2, Vector3::zeros());
}

#[test]
fn the_vehicle_travels_along_its_heading_or_the_direction_given() {
    let attitude = Attitude { roll_rad: 0.1, pitch_rad: -0.2, yaw_rad: 0.7 };
    let initial = VehiclePose { position_m: Vector3::new(1.0, 2.0, -0.5), attitude };
    let shape = PulseShape::Square { strength: Strength::DeltaV(4.0), duration_s: 0.1 };
    let nose_first = path(PulseDefinition { initial, ..ahead(10.0, shape.clone()) });
    let motion = at(&nose_first, 0.05);
    let in_vehicle = motion.vector_to_frame(motion.velocity_m_s);
    assert_below(
        "velocity along X_v, m/s",
        (in_vehicle - Vector3::new(8.0, 0.0, 0.0)).amax(),
        1e-14, // 7.2e-16
    );
    // Sideways to the right, whatever the length of the vector.
    let direction = TravelDirection::Along(Vector3::new(0.0, 1e-3, 0.0));
    let sideways = path(PulseDefinition { initial, direction, ..ahead(10.0, shape) });
    let motion = at(&sideways, 0.05);
    assert_below(
        "velocity, m/s",
        (motion.velocity_m_s - Vector3::new(0.0, -8.0, 0.0)).amax(),
        1e-14, // 0
    );
    assert_below(
        "acceleration, m/s²",
        (motion.acceleration_m_s2 - Vector3::new(0.0, 40.0, 0.0)).amax(),
        1e-13, // 0
    );
    let pose = sideways.pose(0.05, &mut PathCursor::default());
    assert_eq!(pose.attitude, attitude);
    assert_below(
        "place, m",
        (pose.position_m - Vector3::new(1.0, 2.45, -0.5)).amax(),
        1e-15, // 0
    );
    assert_below(
        "same place, m",
        (to_space(pose.position_m) - motion.origin_m).amax(),
        1e-15, // 0
    );
}

#[test]
fn a_cursor_that_jumps_about_answers_like_a_fresh_one() {
    let mut seeded = Seeded(61);
    let points = (0..200)
        .map(|i| DecelerationPoint { time_s: 0.001 * f64::from(i), deceleration_m_s2: seeded.between(-50.0, 120.0) })
        .collect();
    let found = VehiclePath::Pulse(path(ahead(14.0, PulseShape::Tabulated { points })));
    let mut cursor = PathCursor::default();
    for _ in 0..2000 {
        let t_s = seeded.between(-0.1, 0.3);
        assert_eq!(found.motion(t_s, t_s, &mut cursor), found.motion(t_s, 0.0, &mut PathCursor::default()));
    }
}

#[test]
fn everything_wrong_with_a_pulse_is_told_at_once() {
    let shape = PulseShape::Triangle { strength: Strength::DeltaV(f64::NAN), duration_s: 0.0, peak_fraction: 1.5 };
    let definition = PulseDefinition {
        initial_speed_m_s: -1.0,
        direction: TravelDirection::Along(Vector3::zeros()),
        starts_at_s: f64::INFINITY,
        rebound_m_s: Some(-2.0),
        ..ahead(0.0, shape)
    };
    let messages: Vec<String> =
        PulsePath::new(definition).expect_err("unsound").iter().map(ToString::to_string).collect();
    let expected = [
        "found initial speed = -1, expected 0 or more",
        "found start of the pulse = inf, expected a finite number",
        "found rebound = -2, expected 0 or more",
        "the direction of travel is zero, expected a vector with a length",
        "found delta-v = NaN, expected a finite number",
        "found duration = 0, expected more than 0",
        "found a peak at the fraction 1.5 of the pulse, expected 0 to 1",
    ];
    assert_eq!(messages, expected);
}

#[test]
fn pulses_that_do_nothing_are_refused_with_their_reason() {
    let words = |definition: PulseDefinition| {
        let problems = PulsePath::new(definition).expect_err("refused");
        problems.iter().map(PathProblem::to_string).collect::<Vec<_>>()
    };
    let starts = |definition: PulseDefinition, beginning: &str| {
        let words = words(definition);
        assert!(words.len() == 1 && words[0].starts_with(beginning), "{words:?}");
    };
    let square = |strength| PulseShape::Square { strength, duration_s: 0.1 };
    starts(ahead(5.0, square(Strength::DeltaV(0.0))), "the pulse is zero throughout, expected a deceleration");
    let held = words(ahead(0.0, square(Strength::DeltaV(5.0))));
    assert!(
        held.len() == 1 && held[0].contains("the vehicle stands still from 0 s on; give an initial speed"),
        "{held:?}"
    );
    let early = PulseDefinition { starts_at_s: -0.1, ..ahead(5.0, square(Strength::DeltaV(5.0))) };
    starts(early, "the pulse begins at -0.1 s, expected 0 s or later");
    let nothing = PulseShape::Trapezoid { strength: Strength::DeltaV(5.0), rise_s: 0.0, plateau_s: 0.0, fall_s: 0.0 };
    starts(ahead(5.0, nothing), "found rise + plateau + fall = 0, expected more than 0");
    let points = [(0.0, 1.0), (0.0, f64::NAN)]
        .map(|(time_s, deceleration_m_s2)| DecelerationPoint { time_s, deceleration_m_s2 });
    let problems = words(ahead(5.0, PulseShape::Tabulated { points: points.to_vec() }));
    let expected = [
        "station 2: found deceleration = NaN, expected a finite number",
        "station 2: found t = 0 s, expected a time after that of the station before (0 s)",
    ];
    assert_eq!(problems, expected);
}

#[test]
fn a_measured_thrust_whose_noise_would_stop_the_sled_is_refused_unless_it_may_move_back() {
    // 0.1 s of thrust at 100 m/s² after noise of some hundredths of g.
    let noisy = [(0.0, -0.2), (0.01, 0.3), (0.02, -0.2), (0.03, -100.0), (0.13, -100.0), (0.14, 0.0)]
        .map(|(time_s, deceleration_m_s2)| DecelerationPoint { time_s, deceleration_m_s2 });
    let shape = PulseShape::Tabulated { points: noisy.to_vec() };
    let problems = PulsePath::new(ahead(0.0, shape.clone())).expect_err("refused");
    let [PathProblem { found, .. }] = &problems[..] else { panic!("{problems:?}") };
    let stop_s =
        found.split_once("stands still from ").and_then(|(_, rest)| rest.split(' ').next()?.parse::<f64>().ok());
    assert!(stop_s.is_some_and(|stop_s| stop_s > 0.0 && stop_s < 0.02), "{found}");
    let found = path(PulseDefinition { rebound_m_s: Some(0.1), ..ahead(0.0, shape) });
    // Areas of the ramps: −0.0005 − 0.0005 + 0.501 + 10 + 0.5 m/s.
    assert_below("final speed, m/s", (at(&found, 1.0).velocity_m_s.x - 11.0).abs(), 1e-14); // 0
    // Thrust and brake from rest to rest is no such case.
    let there = [(0.0, -10.0), (1.0, -10.0), (2.0, 10.0), (3.0, 10.0)]
        .map(|(time_s, deceleration_m_s2)| DecelerationPoint { time_s, deceleration_m_s2 });
    let found = path(ahead(0.0, PulseShape::Tabulated { points: there.to_vec() }));
    assert_eq!(found.stop().map(|stop| stop.time_s), Some(3.0));
    assert_eq!(at(&found, 4.0).velocity_m_s, Vector3::zeros());
}

#[test]
fn numbers_too_great_to_be_integrated_are_refused() {
    let shape = PulseShape::Square { strength: Strength::PeakDeceleration(1e300), duration_s: 1e100 };
    let problems = PulsePath::new(ahead(1.0, shape)).expect_err("refused");
    assert_eq!(problems[0].to_string(), "found delta-v = inf, expected a finite number");
}
