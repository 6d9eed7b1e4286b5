//! Steering runs of another program, PC-Crash, kept in the repository of pycrash (J. Cormier): a Chevrolet Malibu of 2004
//! without pedals on a level road. Its places are those of workbooks there; its steering wheel every 0.1 s is that of the
//! driver inputs drawn beside them (`figure_22.html`, `Veh1_driver_inputs.html`).
//!
//! Blind: mass, axles, yaw inertia, friction and the slip of 10 degrees at which its linear tyre slides are PC-Crash's; the
//! slope of our tyre is four fifths of the way to that corner; springs and the rest are those of the proof car.

mod common;

use common::proof_car;
use vehicle_motion::car::Car;
use vehicle_motion::driver::{Driver, Steering, Table};
use vehicle_motion::ground::Ground;
use vehicle_motion::run::{Drive, Ride, Start};

/// Steering wheel over the outer front wheel. In the slow circle at the end of the 15 mph run speed and yaw rate give a mean
/// of both front wheels of 25.4 degrees: 22.6 of the outer one by this ratio, 28.6 of the inner one as Ackermann has it.
const RATIO: f64 = 15.9;
const MPH_M_S: f64 = 0.44704;

/// Steering wheel over time, s and degrees to the right: a turn to the left that is held.
const TURN: [(f64, f64); 2] = [(1.0, 0.0), (2.0, -360.0)];

/// NHTSA's fishhook: left, right, back.
const FISHHOOK: [(f64, f64); 15] = [
    (1.0, 0.0),
    (1.1, -64.868),
    (1.2, -108.834),
    (1.3, -152.8),
    (1.6, -152.8),
    (1.7, -122.475),
    (1.8, -92.150),
    (1.9, -24.260),
    (2.0, 43.630),
    (2.1, 119.442),
    (2.2, 152.8),
    (5.0, 152.8),
    (5.2, 148.980),
    (7.0, 11.460),
    (7.2, 0.0),
];

fn malibu() -> Car {
    let mut car = proof_car(0.76);
    car.mass_kg = 1496.0;
    car.inertia_kg_m2[(2, 2)] = 2766.0;
    car.height_m = 0.546;
    (car.front.ahead_m, car.rear.ahead_m) = (0.968, -1.725);
    (car.front.track_m, car.rear.track_m) = (1.524, 1.524);
    // a slope of 0.8 · 3 · 0.76 over 10 degrees, in proportion to the load
    car.tyre.cornering_per_rad = 10.45;
    car.tyre.greatest_at = 1e3;
    car
}

/// Mean angle of the front wheels for an angle of the steering wheel, degrees: rad.
fn mean_rad(car: &Car, wheel_deg: f64) -> f64 {
    let outer = wheel_deg.abs().to_radians() / RATIO;
    // cot δ_inner = cot δ_outer − T/L
    let inner = 1.0 / (1.0 / outer.tan() - car.front.track_m / car.wheelbase_m());
    0.5 * (outer + inner.atan()).copysign(wheel_deg)
}

fn drive(table: &[(f64, f64)], mph: f64) -> Ride {
    let car = malibu();
    let (times, angles) = table.iter().map(|(time_s, deg)| (*time_s, mean_rad(&car, *deg))).unzip();
    let steering = Steering::Table(Table::new(times, angles).unwrap());
    let drive = Drive::new(&car, Ground::level(), Driver { steering, ..Driver::coasting() }).unwrap();
    drive.run(&Start { speed_m_s: mph * MPH_M_S, ..Start::default() }, 10.0).unwrap()
}

/// x, y, m, heading, degrees, and speed, m/s, at a time.
fn at(ride: &Ride, time_s: f64) -> [f64; 4] {
    let (mut heading, mut before) = (0.0, 0.0);
    let mut rows = ride.stations().iter().map(|station| {
        let yaw = station.state.yaw_pitch_roll_rad()[0].to_degrees();
        heading += (yaw - before + 180.0).rem_euclid(360.0) - 180.0;
        before = yaw;
        let (place, velocity) = (station.position_m, station.velocity_m_s);
        (station.time_s, [place.x, place.y, heading, velocity.x.hypot(velocity.y)])
    });
    let mut last = rows.next().unwrap();
    for next in rows {
        if next.0 >= time_s {
            let share = (time_s - last.0) / (next.0 - last.0);
            return [0, 1, 2, 3].map(|i| last.1[i] + share * (next.1[i] - last.1[i]));
        }
        last = next;
    }
    last.1
}

/// Holds a run to PC-Crash's rows: time, s; x, y, m, heading, degrees, speed, m/s; largest gap of the place, m, of the
/// heading, degrees, and of the speed, m/s. Its largest roll, degrees, is the last number.
fn compare(table: &[(f64, f64)], mph: f64, rows: &[(f64, [f64; 4], [f64; 3])], roll_deg: f64) {
    let ride = drive(table, mph);
    for (time_s, [x, y, heading, speed], [place, turn, pace]) in rows {
        let found = at(&ride, *time_s);
        let gap = (found[0] - x).hypot(found[1] - y);
        assert!(gap < *place, "{mph} mph, {time_s} s: {found:?}, {gap} m off");
        assert!(
            (found[2] - heading).abs() < *turn && (found[3] - speed).abs() < *pace,
            "{mph} mph, {time_s} s: {found:?}"
        );
    }
    let roll = ride.stations().iter().map(|station| station.state.yaw_pitch_roll_rad()[2].abs()).fold(0.0, f64::max);
    // its springs are not known
    assert!((roll.to_degrees() - roll_deg).abs() < 0.8, "{mph} mph: rolls {}", roll.to_degrees());
    assert!(ride.balance().abs() < 1e-4, "{}", ride.balance());
}

// bounds of places: 1.2 times the gaps of a prototype of this model whose input were the angles of both wheels

#[test]
fn a_turn_at_30_mph_and_at_15_mph() {
    let rows = [
        // measured 0.04, 0.24, 1.42 m
        (4.0, [36.30, -16.49, -99.0, 7.46], [0.18, 2.8, 0.2]),
        (6.0, [26.58, -20.34, -208.7, 5.53], [0.60, 6.2, 0.2]),
        (10.0, [34.78, -11.81, -393.9, 4.36], [1.56, 17.2, 0.2]),
    ];
    compare(&TURN, 30.0, &rows, 4.44);
    // measured 0.17, 0.78 m
    let rows =
        [(4.0, [13.56, -10.76, -129.4, 5.12], [0.22, 4.8, 0.2]), (6.0, [5.04, -9.56, -221.4, 4.56], [0.96, 9.7, 0.2])];
    compare(&TURN, 15.0, &rows, 3.83);
}

#[test]
fn a_fishhook_at_40_mph_and_at_45_mph() {
    // measured 0.83 m, 9.1°, 1.2 m/s
    compare(&FISHHOOK, 40.0, &[(6.0, [79.08, -3.50, 120.5, 3.17], [1.8, 12.0, 1.4])], 4.82);
    // measured 0.74 and 1.08 m, 2.8° and 10.3°
    let rows =
        [(4.0, [72.29, -16.62, 14.1, 16.04], [1.02, 3.5, 0.5]), (6.0, [93.01, -13.45, 109.3, 4.21], [3.0, 12.0, 0.5])];
    compare(&FISHHOOK, 45.0, &rows, 4.86);
}
