//! Vehicles at their starts: in equilibrium on the ground.

use vehicle_motion::GRAVITY_M_S2;
use vehicle_motion::car::{Car, Class};
use vehicle_motion::driver::Driver;
use vehicle_motion::ground::{Curb, Ground};
use vehicle_motion::run::{Drive, Start};
use vehicle_motion::world::WorldError;

/// However heavy, even where it stands on its rims: the wheels bear its weight at the start and stay at rest.
#[test]
fn the_wheels_bear_the_weight_from_the_start() {
    for mass_kg in [2150.0, 4000.0, 4500.0, 6000.0, 12_000.0] {
        let mut car = Car::of_class(Class::Van);
        car.inertia_kg_m2 *= mass_kg / car.mass_kg;
        car.mass_kg = mass_kg;
        let drive = Drive::new(&car, Ground::level(), Driver::coasting()).unwrap();
        let ride = drive.run(&Start { speed_m_s: 20.0, ..Start::default() }, 1.0).unwrap();
        for station in ride.stations() {
            let load_n: f64 = station.wheels.iter().map(|wheel| wheel.load_n).sum();
            let weights = load_n / (mass_kg * GRAVITY_M_S2);
            assert!((weights - 1.0).abs() < 1e-3, "{mass_kg} at {} s: {weights}", station.time_s);
        }
        // the wheels roll: drag alone slows it, and rolling resistance
        let first = &ride.stations()[0];
        assert!(first.wheels.iter().all(|wheel| wheel.slide_m_s[0].abs() < 1e-9), "{mass_kg}: {:?}", first.wheels[0]);
    }
}

/// Across a curb the wheels of one side would start within it; beside it, and astride no more than a rise that a tyre takes,
/// they stand.
#[test]
fn a_start_across_a_curb_is_refused() {
    let starts = |right_m: f64, height_m: f64, yaw_deg: f64| {
        let curb = Curb { right_m, height_m, face_rad: 80f64.to_radians() };
        let ground = Ground::level().with_curbs(&[curb]).unwrap();
        let drive = Drive::new(&Car::of_class(Class::Sedan), ground, Driver::coasting()).unwrap();
        let start = Start { speed_m_s: 5.0, yaw_rad: yaw_deg.to_radians(), ..Start::default() };
        drive.run(&start, 0.1).map(|ride| ride.stations().len())
    };
    for (right_m, height_m, yaw_deg, first) in
        [(0.1, 0.15, 0.0, 1), (0.1, 1.0, 0.0, 1), (0.1, 6.0, 0.0, 1), (-0.1, -0.15, 0.0, 0), (0.5, 0.15, 90.0, 0)]
    {
        match starts(right_m, height_m, yaw_deg) {
            Err(WorldError::Buried { car: 0, wheel, depth_m, most_m }) => {
                assert_eq!(wheel, first, "{right_m} {height_m} {yaw_deg}");
                assert!(depth_m > 0.1 && most_m == 0.055, "{depth_m} {most_m}");
            }
            other => panic!("{right_m} {height_m} {yaw_deg}: {other:?}"),
        }
    }
    let said = starts(0.1, 0.15, 0.0).unwrap_err().to_string();
    let expected = "vehicle 1: its right front wheel is 0.172 m deep in the ground at the start; expected at most 0.055 m: \
                    move the start, or the curb or edge that it lies across";
    assert_eq!(said, expected);
    for (right_m, height_m) in [(1.0, 0.15), (0.1, 0.02), (0.1, -0.15), (-1.0, 0.15)] {
        starts(right_m, height_m, 0.0).unwrap();
    }
}
