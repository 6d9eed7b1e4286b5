//! Vehicles at their starts: in equilibrium on the ground.

use vehicle_motion::GRAVITY_M_S2;
use vehicle_motion::car::{Car, Class};
use vehicle_motion::driver::Driver;
use vehicle_motion::ground::Ground;
use vehicle_motion::run::{Drive, Start};

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
