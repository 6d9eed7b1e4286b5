use std::f64::consts::{PI, TAU};

use nalgebra::Matrix3;

use super::super::support::{Seeded, assert_below, differentiate, omega_of};
use super::super::{VehiclePath, unwrap_angles};
use super::*;

const SPEED_M_S: f64 = 12.0;
const RADIUS_M: f64 = 20.0;
const YAW_RATE_RAD_S: f64 = SPEED_M_S / RADIUS_M;

/// A steady turn to the right, nose along the path.
fn turn(t_s: f64) -> Station {
    let yaw = YAW_RATE_RAD_S * t_s;
    Station::new(t_s, [RADIUS_M * yaw.sin(), RADIUS_M * (1.0 - yaw.cos()), 0.0], [0.0, 0.0, yaw])
}

/// Stations of a vehicle that tumbles: every channel random, steps uneven.
fn tumble(seed: u64, count: usize) -> Vec<Station> {
    let mut seeded = Seeded(seed);
    let mut t_s = 0.3;
    let mut angles = [0.0; 3];
    (0..count)
        .map(|_| {
            t_s += seeded.between(0.05, 0.2);
            angles = angles.map(|angle| angle + seeded.between(-0.5, 0.9));
            Station::new(t_s, seeded.vector(-1.0, 1.0).into(), angles)
        })
        .collect()
}

fn table(stations: Vec<Station>, interpolation: Interpolation, after: AfterEnd) -> TablePath {
    TablePath::new(stations, interpolation, after).expect("a sound table")
}

fn fresh(path: &TablePath, t_s: f64) -> FrameMotion {
    path.motion(t_s, t_s, &mut PathCursor::default())
}

/// Largest errors of place and velocity over the middle of a steady turn of 2 s with this many steps.
fn turn_errors(steps: usize) -> (f64, f64) {
    let stations = (0..=steps).map(|i| turn(2.0 * i as f64 / steps as f64)).collect();
    let path = table(stations, Interpolation::Spline, AfterEnd::Error);
    let mut errors = (0.0f64, 0.0f64);
    for i in 0..1000 {
        let t_s = 0.7 + 0.6 * f64::from(i) / 1000.0;
        let motion = fresh(&path, t_s);
        let yaw = YAW_RATE_RAD_S * t_s;
        // To the right is −Y′ in space.
        let place = Vector3::new(RADIUS_M * yaw.sin(), -RADIUS_M * (1.0 - yaw.cos()), 0.0);
        let velocity = Vector3::new(yaw.cos(), -yaw.sin(), 0.0) * SPEED_M_S;
        errors.0 = errors.0.max((motion.origin_m - place).amax());
        errors.1 = errors.1.max((motion.velocity_m_s - velocity).amax());
        assert_below(
            "yaw rate",
            (motion.angular_velocity_rad_s.z + YAW_RATE_RAD_S).abs(),
            1e-13, // 4.0e-15
        );
    }
    errors
}

#[test]
fn a_steady_turn_converges_at_the_fourth_order() {
    let (coarse, fine) = (turn_errors(40), turn_errors(80));
    // 16 and 8 in the limit of small steps.
    assert_below(
        "fourth order of place",
        (coarse.0 / fine.0 - 16.0).abs(),
        0.5, // 4.9e-02
    );
    assert_below(
        "third order of velocity",
        (coarse.1 / fine.1 - 8.0).abs(),
        0.5, // 2.3e-02
    );
    assert_below("place with stations every 25 ms, m", fine.0, 1e-8); // 2.4e-09
}

#[test]
fn the_motion_of_a_spline_is_the_derivative_of_its_pose() {
    for seed in 0..5 {
        let path = table(tumble(seed, 12), Interpolation::Spline, AfterEnd::Error);
        let (mut velocity, mut acceleration, mut omega, mut alpha) = (0.0f64, 0.0f64, 0.0f64, 0.0f64);
        for pair in path.stations().windows(2) {
            // Inside one cubic, so that the differences see no corner of the third derivative.
            let t_s = 0.5 * (pair[0].time_s + pair[1].time_s);
            let now = fresh(&path, t_s);
            let v = differentiate(|t| fresh(&path, t).origin_m, t_s, 1e-4);
            let a = differentiate(|t| fresh(&path, t).velocity_m_s, t_s, 1e-4);
            let turned = differentiate(|t| fresh(&path, t).rotation, t_s, 1e-4);
            let spun = differentiate(|t| fresh(&path, t).angular_velocity_rad_s, t_s, 1e-4);
            velocity = velocity.max((v - now.velocity_m_s).amax());
            acceleration = acceleration.max((a - now.acceleration_m_s2).amax());
            omega = omega.max((omega_of(now.rotation, turned, 1e-6) - now.angular_velocity_rad_s).amax());
            alpha = alpha.max((spun - now.angular_acceleration_rad_s2).amax());
        }
        assert_below("velocity", velocity, 1e-10); // 4.5e-12
        assert_below("acceleration", acceleration, 1e-9); // 5.9e-11
        assert_below("angular velocity", omega, 1e-8); // 8.5e-10
        assert_below("angular acceleration", alpha, 1e-7); // 7.3e-09
    }
}

#[test]
fn every_station_is_met_in_place_and_attitude() {
    for interpolation in [Interpolation::Linear, Interpolation::Spline] {
        let path = table(tumble(21, 15), interpolation, AfterEnd::Error);
        let f = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0));
        for station in path.stations() {
            let motion = fresh(&path, station.time_s);
            assert_below(
                "place",
                (motion.origin_m - f * station.pose.position_m).amax(),
                1e-14, // 4.4e-16
            );
            assert_below(
                "rotation",
                (motion.rotation - f * station.pose.attitude.matrix()).amax(),
                1e-14, // 0
            );
            assert_below("proper", (motion.rotation.determinant() - 1.0).abs(), 1e-15); // 2.2e-16
        }
    }
}

#[test]
fn straight_lines_move_at_the_pace_of_the_interval_of_the_step_middle() {
    let stations = vec![
        Station::new(0.0, [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
        Station::new(1.0, [10.0, 2.0, 0.0], [0.0, 0.0, 0.5]),
        Station::new(3.0, [12.0, 2.0, 4.0], [0.0, 0.0, -0.5]),
    ];
    let path = table(stations, Interpolation::Linear, AfterEnd::Error);
    let at = |t_s: f64, middle_s: f64| path.motion(t_s, middle_s, &mut PathCursor::default());
    // A step from 0.9 s to 1.0 s: all its stages see the first interval, also the one at the station.
    for t_s in [0.9, 0.95, 1.0] {
        assert_eq!(at(t_s, 0.95).velocity_m_s, Vector3::new(10.0, -2.0, 0.0));
        assert_eq!(at(t_s, 0.95).angular_velocity_rad_s, Vector3::new(0.0, 0.0, -0.5));
        assert_eq!(at(t_s, 0.95).acceleration_m_s2, Vector3::zeros());
    }
    // The next step, 1.0 s to 1.1 s, sees the second; so does one that straddles the station, for its larger part.
    for (t_s, middle_s) in [(1.0, 1.05), (0.99, 1.04)] {
        assert_eq!(at(t_s, middle_s).velocity_m_s, Vector3::new(1.0, 0.0, -2.0));
        assert_eq!(at(t_s, middle_s).angular_velocity_rad_s, Vector3::new(0.0, 0.0, 0.5));
    }
    // The place always belongs to the time itself.
    assert_below(
        "place",
        (at(0.5, 2.0).origin_m - Vector3::new(5.0, -1.0, 0.0)).amax(),
        1e-15, // 0
    );
    assert_below(
        "place",
        (at(2.0, 0.5).origin_m - Vector3::new(11.0, -2.0, -2.0)).amax(),
        1e-15, // 0
    );
}

#[test]
fn straight_lines_turn_as_their_rotation_does() {
    let path = table(tumble(22, 10), Interpolation::Linear, AfterEnd::Error);
    let (mut omega, mut alpha) = (0.0f64, 0.0f64);
    for pair in path.stations().windows(2) {
        let t_s = 0.5 * (pair[0].time_s + pair[1].time_s);
        let now = fresh(&path, t_s);
        let turned = differentiate(|t| fresh(&path, t).rotation, t_s, 1e-4);
        let spun = differentiate(|t| fresh(&path, t).angular_velocity_rad_s, t_s, 1e-4);
        omega = omega.max((omega_of(now.rotation, turned, 1e-7) - now.angular_velocity_rad_s).amax());
        alpha = alpha.max((spun - now.angular_acceleration_rad_s2).amax());
    }
    assert_below("angular velocity", omega, 1e-11); // 1.8e-12
    assert_below("angular acceleration", alpha, 1e-10); // 1.0e-11
}

#[test]
fn coasting_goes_on_as_it_was() {
    for interpolation in [Interpolation::Linear, Interpolation::Spline] {
        let path = table(tumble(23, 9), interpolation, AfterEnd::Coast);
        let (_, last_s) = path.span_s();
        let end = fresh(&path, last_s);
        let just_after = path.motion(last_s + 1e-12, last_s + 1e-12, &mut PathCursor::default());
        assert_below(
            "place at the end",
            (just_after.origin_m - end.origin_m).amax(),
            1e-10, // 9.5e-12
        );
        assert_below(
            "rotation at the end",
            (just_after.rotation - end.rotation).amax(),
            1e-11, // 1.9e-12
        );
        for after_s in [0.1, 1.0, 7.0] {
            let t_s = last_s + after_s;
            let now = fresh(&path, t_s);
            assert_eq!(now.velocity_m_s, end.velocity_m_s);
            assert_eq!(now.angular_velocity_rad_s, end.angular_velocity_rad_s);
            assert_eq!(now.acceleration_m_s2, Vector3::zeros());
            assert_eq!(now.angular_acceleration_rad_s2, Vector3::zeros());
            assert_below(
                "place",
                (now.origin_m - end.origin_m - end.velocity_m_s * after_s).amax(),
                1e-13, // 1.4e-14
            );
            let turned = differentiate(|t| fresh(&path, t).rotation, t_s, 1e-4);
            let omega = omega_of(now.rotation, turned, 1e-8);
            assert_below(
                "rotation",
                (omega - end.angular_velocity_rad_s).amax(),
                1e-10, // 8.7e-12
            );
        }
    }
}

#[test]
fn holding_stands_still_from_the_first_step_past_the_end() {
    for interpolation in [Interpolation::Linear, Interpolation::Spline] {
        let path = table(tumble(24, 9), interpolation, AfterEnd::Hold);
        let (_, last_s) = path.span_s();
        let end = fresh(&path, last_s);
        // a spline comes to rest there, straight lines stop at once
        assert_eq!(end.velocity_m_s.norm() > 0.1, interpolation == Interpolation::Linear);
        for t_s in [last_s, last_s + 0.005, last_s + 3.0] {
            let now = path.motion(t_s, last_s + 0.0025, &mut PathCursor::default());
            assert_eq!(now, end.held());
        }
        // The stages of the step that ends at the last station still move.
        assert_eq!(path.motion(last_s, last_s - 0.005, &mut PathCursor::default()).velocity_m_s, end.velocity_m_s);
    }
}

#[test]
fn the_attitude_for_output_is_the_attitude_of_the_motion() {
    let f = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0));
    for after in [AfterEnd::Coast, AfterEnd::Hold] {
        for interpolation in [Interpolation::Linear, Interpolation::Spline] {
            let path = table(tumble(25, 9), interpolation, after);
            let (first_s, last_s) = path.span_s();
            let mut worst: f64 = 0.0;
            for i in 0..400 {
                let t_s = first_s + (last_s - first_s) * f64::from(i) / 200.0;
                let (pose, motion) = (path.pose(t_s, &mut PathCursor::default()), fresh(&path, t_s));
                worst = worst.max((f * pose.position_m - motion.origin_m).amax());
                worst = worst.max((f * pose.attitude.matrix() - motion.rotation).amax());
            }
            assert_below("pose", worst, 1e-14); // 2.1e-15
        }
    }
}

#[test]
fn a_spinning_vehicle_that_coasts_counts_its_turns() {
    let stations = vec![turn(0.0), turn(0.5), turn(1.0)];
    let path = table(stations, Interpolation::Linear, AfterEnd::Coast);
    // Up to 9.5 turns.
    for t_s in [1.5, 10.0, 100.0] {
        let yaw_rad = path.pose(t_s, &mut PathCursor::default()).attitude.yaw_rad;
        assert_below("yaw", (yaw_rad - YAW_RATE_RAD_S * t_s).abs(), 1e-14); // 8.9e-16
    }
}

#[test]
fn a_cursor_that_jumps_about_answers_like_a_fresh_one() {
    for interpolation in [Interpolation::Linear, Interpolation::Spline] {
        let table = table(tumble(26, 50), interpolation, AfterEnd::Coast);
        let (first_s, last_s) = table.span_s();
        let path = VehiclePath::Table(table);
        let (mut seeded, mut cursor) = (Seeded(27), PathCursor::default());
        for _ in 0..2000 {
            let t_s = seeded.between(first_s - 0.1, last_s + 0.1);
            let middle_s = t_s + seeded.between(-0.01, 0.01);
            let found = path.motion(t_s, middle_s, &mut cursor);
            assert_eq!(found, path.motion(t_s, middle_s, &mut PathCursor::default()));
            assert_eq!(path.attitude(t_s, &mut cursor), path.attitude(t_s, &mut PathCursor::default()));
        }
    }
}

#[test]
fn a_run_must_fit_the_table() {
    let spanning = |after| VehiclePath::Table(table(vec![turn(0.5), turn(1.0)], Interpolation::Linear, after));
    let path = spanning(AfterEnd::Error);
    assert_eq!(path.check_span(0.5, 1.0), Ok(()));
    let early = path.check_span(0.4, 1.0).expect_err("before the start").to_string();
    assert_eq!(early, "the run starts at 0.4 s, expected at or after the first station at 0.5 s");
    let past = path.check_span(0.5, 1.2);
    let message = past.expect_err("past the end").to_string();
    assert!(message.contains("1.2 s") && message.contains("1 s") && message.contains("coast"), "{message}");
    for after in [AfterEnd::Coast, AfterEnd::Hold] {
        assert_eq!(spanning(after).check_span(0.5, 9.0), Ok(()));
        assert!(spanning(after).check_span(0.0, 9.0).is_err());
    }
    let endless = path.check_span(0.5, f64::NAN).expect_err("no end").to_string();
    assert_eq!(endless, "found end of the run = NaN, expected a finite number");
}

#[test]
fn everything_wrong_with_a_table_is_told_at_once() {
    let stations = vec![
        Station::new(0.0, [0.0; 3], [0.0, 0.0, 3.0]),
        Station::new(0.0, [0.0, f64::INFINITY, 0.0], [0.0, 0.0, -3.0]),
        Station::new(-1.0, [0.0; 3], [0.0, 0.0, -3.0]),
    ];
    let problems = TablePath::new(stations, Interpolation::Spline, AfterEnd::Error).expect_err("an unsound table");
    let expected = [
        "station 2: found y = inf",
        "station 2: found t = 0 s",
        "station 2: yaw goes from 171.887° to -171.887°",
        "station 3: found t = -1 s",
    ];
    assert_eq!(problems.iter().map(|p| p.found.as_str()).collect::<Vec<_>>(), expected);
    assert_eq!(problems.iter().map(|p| p.station).collect::<Vec<_>>(), [Some(1), Some(1), Some(1), Some(2)]);
    assert_eq!(problems[1].expected, "a time after that of the station before (0 s)");
    let steep = vec![turn(0.0), Station { time_s: 1e-200, ..turn(1.0) }];
    let problems = TablePath::new(steep, Interpolation::Linear, AfterEnd::Error).expect_err("too steep");
    let words =
        ["x", "y", "yaw"].map(|quantity| format!("station 2: {quantity} changes too much since the station before"));
    assert!(
        problems.len() == 3 && problems.iter().zip(&words).all(|(p, words)| p.found.starts_with(words)),
        "{problems:?}"
    );
    for stations in [vec![], vec![turn(0.0)]] {
        let found = format!("found {} stations, expected at least 2", stations.len());
        let problems = TablePath::new(stations, Interpolation::Linear, AfterEnd::Error).expect_err("too short");
        assert_eq!(problems.iter().map(PathProblem::to_string).collect::<Vec<_>>(), [found]);
    }
}

#[test]
fn wrapped_angles_can_be_unwrapped() {
    let mut stations: Vec<Station> = (0..60).map(|i| turn(0.4 * f64::from(i))).collect();
    let smooth = stations.clone();
    for station in &mut stations {
        let yaw = &mut station.pose.attitude.yaw_rad;
        *yaw -= TAU * ((*yaw + PI) / TAU).floor();
    }
    assert!(TablePath::new(stations.clone(), Interpolation::Spline, AfterEnd::Error).is_err());
    unwrap_angles(&mut stations);
    for (found, expected) in stations.iter().zip(&smooth) {
        let apart = found.pose.attitude.yaw_rad - expected.pose.attitude.yaw_rad;
        assert_below("yaw", apart.abs(), 1e-13); // 0
    }
    assert!(TablePath::new(stations, Interpolation::Spline, AfterEnd::Error).is_ok());
}

fn shown(path: &TablePath, t_s: f64) -> FrameMotion {
    VehiclePath::Table(path.clone()).shown_motion(t_s, &mut PathCursor::default())
}

/// A car that brakes at a, m/s², while it rolls over at a growing rate.
fn braking(t_s: f64) -> Station {
    Station::new(t_s, [15.0 * t_s - 4.0 * t_s * t_s, 0.0, 0.0], [2.5 * t_s * t_s, 0.0, 0.0])
}

#[test]
fn accelerations_of_straight_lines_are_the_second_differences_of_the_stations() {
    let uneven = [0.0, 0.01, 0.03, 0.06, 0.07, 0.1, 0.15];
    let path = table(uneven.map(braking).to_vec(), Interpolation::Linear, AfterEnd::Error);
    for t_s in [0.0, 0.005, 0.02, 0.0601, 0.1, 0.149] {
        // of a parabola they are exact, wherever the stations are
        let a = shown(&path, t_s);
        assert_below("acceleration", (a.acceleration_m_s2 - Vector3::new(-8.0, 0.0, 0.0)).amax(), 1e-9); // 5.2e-12
        assert_below("angular acceleration", (a.angular_acceleration_rad_s2.x - 5.0).abs(), 1e-9); // 3.4e-12
        let felt = fresh(&path, t_s);
        assert_eq!(felt.acceleration_m_s2, Vector3::zeros(), "no force depends on what is told");
        assert_eq!((a.velocity_m_s, a.origin_m), (felt.velocity_m_s, felt.origin_m));
    }
    let spline = table(uneven.map(braking).to_vec(), Interpolation::Spline, AfterEnd::Error);
    assert_eq!(shown(&spline, 0.02), fresh(&spline, 0.02));
}

#[test]
fn differences_converge_at_the_second_order_and_hold_the_change_of_velocity() {
    // a = −150 sin(π t / 0.1) over 0.1 s, from 10 m/s
    let (p, length_s) = (150.0, 0.1);
    let place = |t: f64| {
        let w = PI / length_s;
        10.0 * t - p / w * (t - (w * t).sin() / w)
    };
    let error = |steps: usize| {
        let at = |i: usize| length_s * i as f64 / steps as f64;
        let stations = (0..=steps).map(|i| Station::new(at(i), [place(at(i)), 0.0, 0.0], [0.0; 3])).collect();
        let path = table(stations, Interpolation::Linear, AfterEnd::Error);
        let worst = |i: usize| {
            let t_s = 0.02 + 0.06 * i as f64 / 100.0;
            (shown(&path, t_s).acceleration_m_s2.x + p * (PI * t_s / length_s).sin()).abs()
        };
        (0..=100).map(worst).fold(0.0, f64::max)
    };
    let (coarse, fine) = (error(25), error(50));
    assert_below("order", (coarse / fine - 4.0).abs(), 0.3); // 9.6e-02
    assert_below("greatest error with stations every 2 ms, of 150 m/s²", fine, 0.2);
}

#[test]
fn what_a_table_does_after_its_end_counts_as_one_more_interval() {
    let stations = || [0.0, 0.1, 0.2].map(|t_s| Station::new(t_s, [12.0 * t_s, 0.0, 0.0], [0.0; 3])).to_vec();
    let at = |after, t_s| shown(&table(stations(), Interpolation::Linear, after), t_s).acceleration_m_s2.x;
    assert_eq!([at(AfterEnd::Error, 0.2), at(AfterEnd::Coast, 0.2), at(AfterEnd::Coast, 0.5)], [0.0; 3]);
    // 12 m/s are lost between the middles of two intervals of 0.1 s
    assert_below("stop", (at(AfterEnd::Hold, 0.2) + 120.0).abs(), 1e-9); // 0
    assert_below("half-way down", (at(AfterEnd::Hold, 0.25) + 60.0).abs(), 1e-9); // 0
    assert_eq!(at(AfterEnd::Hold, 0.31), 0.0);
}
