//! The rates of the state against an independent, dense formulation (`reference_rate.py`), and what must hold whatever the state.

mod common;

use common::proof_car;
use serde_json::Value;
use vehicle_motion::car::Car;
use vehicle_motion::chassis::{Chassis, Controls};
use vehicle_motion::ground::Ground;
use vehicle_motion::state::{NUMBERS, Outside, State};
use vehicle_motion::tyre::Tyre;

fn reference_car() -> Car {
    let mut car = proof_car(0.8);
    car.tyre = Tyre { sliding_share: 0.875, friction_loss: 0.05, rolling: 0.012, ..car.tyre };
    car.drag_n_s2_per_m2 = 0.4;
    (car.front.anti_pitch, car.rear.anti_pitch) = (0.05, -0.08);
    car.rear.spin_kg_m2 = 1.2;
    for axle in [&mut car.front, &mut car.rear] {
        (axle.bump_steer_rad_per_m, axle.bump_camber_rad_per_m) = (0.3, 0.5);
    }
    car
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

#[test]
fn rates_are_those_of_a_dense_formulation() {
    let reference: Value = serde_json::from_str(include_str!("reference_rate.json")).unwrap();
    let ground = Ground::plane(0.0, reference["slope"].as_f64().unwrap());
    let chassis = Chassis::new(&reference_car()).unwrap();
    let mut worst = 0.0f64;
    for case in reference["cases"].as_array().unwrap() {
        let mut state = State([0.0; NUMBERS]);
        state.0[..33].copy_from_slice(&numbers(&case["state"]));
        let number = |key: &str| case[key].as_f64().unwrap();
        let steer = number("steer");
        // the reference steers all wheels
        let controls = Controls {
            steer_rad: [steer; 4],
            brake_n_m: number("brake"),
            drive_n_m: number("drive"),
            ..Controls::default()
        };
        let mut rates = State([0.0; NUMBERS]);
        let report = chassis.rates(&state, &controls, [false; 4], &ground, &Outside::default(), &mut rates);
        for (i, (found, expected)) in rates.0.iter().zip(numbers(&case["rate"])).enumerate() {
            let off = (found - expected).abs() / expected.abs().max(1.0);
            assert!(off < 1e-9, "number {i}: {found}, expected {expected}");
            worst = worst.max(off);
        }
        for (wheel, load) in report.wheels.iter().zip(numbers(&case["loads"])) {
            assert!((wheel.load_n - load).abs() < 1e-6 * load.max(1.0));
        }
    }
    // measured 8.2e-11
    assert!(worst < 1e-9, "{worst}");
}

/// Mirrored about the middle plane, a state has the mirrored rates.
#[test]
fn the_mirrored_state_has_the_mirrored_rates() {
    let reference: Value = serde_json::from_str(include_str!("reference_rate.json")).unwrap();
    let chassis = Chassis::new(&reference_car()).unwrap();
    // signs of place, attitude, velocity and rotation in the mirror
    let signs = [1.0, -1.0, 1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0];
    let mirrored = |state: &[f64]| {
        let mut out: Vec<f64> = state[..13].iter().zip(signs).map(|(x, sign)| x * sign).collect();
        for block in 0..5 {
            // lateral slips change their sign with their side
            let sign = if block == 4 { -1.0 } else { 1.0 };
            out.extend([1, 0, 3, 2].map(|i| sign * state[13 + 4 * block + i]));
        }
        out
    };
    for case in reference["cases"].as_array().unwrap() {
        let rates = |numbers: &[f64], sign: f64| {
            let mut state = State([0.0; NUMBERS]);
            state.0[..33].copy_from_slice(numbers);
            let steer = sign * case["steer"].as_f64().unwrap();
            let controls =
                Controls { steer_rad: [steer; 4], brake_n_m: 2000.0, drive_n_m: 300.0, ..Controls::default() };
            let mut rates = State([0.0; NUMBERS]);
            chassis.rates(
                &state,
                &controls,
                [false; 4],
                &Ground::plane(0.0, sign * 0.25),
                &Outside::default(),
                &mut rates,
            );
            rates.0[..33].to_vec()
        };
        let state = numbers(&case["state"]);
        for (a, b) in rates(&mirrored(&state), -1.0).iter().zip(mirrored(&rates(&state, 1.0))) {
            // measured 5e-10 where loads reach 200 kN
            assert!((a - b).abs() < 1e-8 * a.abs().max(1.0), "{a} {b}");
        }
    }
}
