//! Drivers who hold a speed, and drivers who follow a line.

use vehicle_motion::GRAVITY_M_S2;
use vehicle_motion::car::{Car, Class};
use vehicle_motion::driver::{Driver, Follower, Steering, Table};
use vehicle_motion::ground::Ground;
use vehicle_motion::run::{Drive, Ride, Start, Station};

fn holding(table: Table) -> Driver {
    Driver { speed_m_s: Some(table), ..Driver::coasting() }
}

/// A sedan on tyres of a friction.
fn drives(friction: f64, driver: Driver, start_m_s: f64, end_s: f64) -> Ride {
    let mut car = Car::of_class(Class::Sedan);
    car.tyre.friction = friction;
    let drive = Drive::new(&car, Ground::level(), driver).unwrap();
    drive.run(&Start { speed_m_s: start_m_s, ..Start::default() }, end_s).unwrap()
}

fn greatest(ride: &Ride, number: impl Fn(&Station) -> f64) -> f64 {
    ride.stations().iter().map(number).fold(f64::NEG_INFINITY, f64::max)
}

/// From rest, and from a speed far from the wanted one: the car stays on its wheels, no wheel spins up, and the speed
/// settles.
#[test]
fn a_speed_is_reached_as_a_driver_would() {
    for (friction, start_m_s, end_s) in [(1.0, 0.0, 8.0), (1.0, 5.0, 7.0), (0.2, 0.0, 40.0), (1.0, 40.0, 8.0)] {
        let ride = drives(friction, holding(Table::constant(20.0)), start_m_s, end_s);
        let pitch = greatest(&ride, |s| s.state.yaw_pitch_roll_rad()[1].abs()).to_degrees();
        assert!(pitch < 5.0, "{friction} {start_m_s}: pitch {pitch}");
        assert!(ride.stations().iter().all(|s| s.wheels.iter().all(|wheel| wheel.load_n > 0.0)));
        // a fifth of slip, and what the start from rest allows
        let spins = |s: &Station| s.state.spin_rad_s().into_iter().fold(0.0, f64::max);
        let over = greatest(&ride, |s| spins(s) * 0.32 - 1.25 * s.velocity_m_s.norm());
        assert!(over < 1.5, "{friction} {start_m_s}: a wheel spins {over} m/s too fast");
        let most = greatest(&ride, |s| s.velocity_m_s.x);
        assert!(most < start_m_s.max(20.0) + 0.01, "{friction} {start_m_s}: {most}");
        let late: Vec<f64> =
            ride.stations().iter().filter(|s| s.time_s > end_s - 1.0).map(|s| s.velocity_m_s.x).collect();
        assert!(late.iter().all(|speed| (speed - 20.0).abs() < 0.1), "{friction} {start_m_s}: {:?}", late.last());
        let [least, most] =
            [late.iter().fold(f64::MAX, |a, b| a.min(*b)), late.iter().fold(0.0, |a: f64, b| a.max(*b))];
        assert!(most - least < 0.02, "{friction} {start_m_s}: swings by {}", most - least);
    }
}

/// What a table asks for is followed as far as a tyre can, a jump only as fast as a driver would.
#[test]
fn recorded_speeds_are_followed_within_reason() {
    let felt = |ride: &Ride| {
        let felt = ride.stations().iter().filter(|s| s.time_s > 0.5).map(|s| s.felt_m_s2.x / GRAVITY_M_S2);
        felt.fold([0.0f64; 2], |[least, most], x| [least.min(x), most.max(x)])
    };
    let table =
        |points: [[f64; 2]; 2]| Table::new(points.map(|p| p[0]).to_vec(), points.map(|p| p[1]).to_vec()).unwrap();
    let jump = drives(1.3, holding(table([[1.0, 5.0], [1.1, 25.0]])), 5.0, 4.0);
    let launch = drives(1.3, holding(table([[0.0, 5.0], [3.0, 17.0]])), 5.0, 2.9);
    let stop = drives(1.3, holding(table([[0.0, 30.0], [3.0, 3.0]])), 30.0, 2.9);
    assert!(felt(&jump)[1] < 1.1, "{:?}", felt(&jump));
    assert!((launch.last().velocity_m_s.x - 16.6).abs() < 0.3, "{:?}", launch.last().velocity_m_s);
    assert!((stop.last().velocity_m_s.x - 3.9).abs() < 0.3, "{:?}", stop.last().velocity_m_s);
}

/// A right angle and sharper corners, to both sides: the car turns near the corner, and drives on the last piece of the
/// line and straight on beyond its end.
#[test]
fn corners_of_any_angle_are_turned() {
    for (speed_m_s, wide_m) in [(5.0, 2.5), (10.0, 12.0)] {
        for degrees in [85.0f64, 90.0, 95.0, 120.0, 150.0, -90.0, -150.0] {
            let (across, along) = degrees.to_radians().sin_cos();
            let line = vec![[0.0, 0.0], [60.0, 0.0], [60.0 + 60.0 * along, 60.0 * across]];
            let steering = Steering::Follow(Follower::new(line).unwrap());
            let driver = Driver { steering, ..holding(Table::constant(speed_m_s)) };
            let ride = drives(0.8, driver, speed_m_s, 190.0 / speed_m_s);
            // from the corner: along the second piece, and to its right
            let (x, y) = (ride.last().position_m.x - 60.0, ride.last().position_m.y);
            let [way_m, aside_m] = [x * along + y * across, y * along - x * across];
            assert!(way_m > 80.0 && aside_m.abs() < 0.02, "{speed_m_s} {degrees}: {way_m} {aside_m}");
            let beyond_m = greatest(&ride, |s| if s.time_s < 80.0 / speed_m_s { s.position_m.x } else { 0.0 });
            // at 10 m/s by grip: v²/μg is 12.7 m; measured 2.0 and 10.7 m
            assert!(beyond_m - 60.0 < wide_m, "{speed_m_s} {degrees}: {} m beyond the corner", beyond_m - 60.0);
        }
    }
}

/// Too fast for the corner: he steers no further than the tyres take, runs wide and comes back to the line.
#[test]
fn a_corner_taken_too_fast_is_run_wide() {
    for degrees in [60.0f64, 90.0, -150.0] {
        let (across, along) = degrees.to_radians().sin_cos();
        let line = vec![[0.0, 0.0], [60.0, 0.0], [60.0 + 60.0 * along, 60.0 * across]];
        let steering = Steering::Follow(Follower::new(line).unwrap());
        let driver = Driver { steering, ..holding(Table::constant(15.0)) };
        let ride = drives(0.8, driver, 15.0, 27.0);
        let (x, y) = (ride.last().position_m.x - 60.0, ride.last().position_m.y);
        let aside_m = y * along - x * across;
        // with full lock he weaved about the line for longer than this, 0.9 to 9 m aside, at 4 to 9 m/s
        assert!(aside_m.abs() < 0.1, "{degrees}: {aside_m}");
        assert!(ride.last().velocity_m_s.norm() > 14.9, "{degrees}: {}", ride.last().velocity_m_s.norm());
    }
}
