//! The car of the proofs.

use nalgebra::{Matrix3, Vector3};
use vehicle_motion::car::{Axle, Car, Class};
use vehicle_motion::tyre::Tyre;

/// 1500 kg, the car of all golden numbers.
pub fn proof_car(friction: f64) -> Car {
    let axle = |front: bool| Axle {
        ahead_m: if front { 1.1 } else { -1.6 },
        track_m: 1.52,
        wheel_kg: 40.0,
        spin_kg_m2: 1.0,
        rate_n_per_m: 22e3,
        jounce_n_s_per_m: 1200.0,
        rebound_n_s_per_m: 1800.0,
        anti_roll_n_per_m: if front { 12e3 } else { 4e3 },
        roll_centre_m: if front { 0.05 } else { 0.10 },
        anti_pitch: 0.0,
        jounce_stop_m: 0.08,
        rebound_stop_m: 0.09,
        stop_n_per_m: 2e5,
        bump_steer_rad_per_m: 0.0,
        bump_camber_rad_per_m: 0.0,
        is_steered: front,
    };
    Car {
        mass_kg: 1500.0,
        inertia_kg_m2: Matrix3::from_diagonal(&Vector3::new(550.0, 2300.0, 2500.0)),
        height_m: 0.55,
        front: axle(true),
        rear: axle(false),
        tyre: Tyre { friction, rolling: 0.0, ..Tyre::usual() },
        drag_n_s2_per_m2: 0.0,
        ackermann: 0.0,
        ..Car::of_class(Class::Sedan)
    }
}
