//! A rail on posts: alone under a load, and hit by a pickup and a small car.

mod common;

use common::proof_car;
use nalgebra::Matrix3;
use vehicle_motion::V3;
use vehicle_motion::barrier::{Barrier, Rail};
use vehicle_motion::body::{Body, Crush, Row, Stiffness};
use vehicle_motion::driver::Driver;
use vehicle_motion::run::Start;
use vehicle_motion::world::{Begin, Entry, Outcome, World};

fn hit(mass: f64, yaw: f64, size: [f64; 3], front: f64, speed_m_s: f64, deg: f64, anchor_n_per_m: f64) -> Outcome {
    let mut car = proof_car(0.6);
    let factor = mass / car.mass_kg;
    car.mass_kg = mass;
    car.inertia_kg_m2 = Matrix3::from_diagonal(&V3::new(0.25 * yaw, 0.9 * yaw, yaw));
    (car.front.ahead_m, car.rear.ahead_m) = (1.5, -2.0);
    if mass < 1500.0 {
        (car.front.ahead_m, car.rear.ahead_m) = (1.0, -1.5);
    }
    for axle in [&mut car.front, &mut car.rear] {
        axle.rate_n_per_m *= factor;
        axle.anti_roll_n_per_m *= factor;
    }
    let face = Stiffness::by_speed(mass, size[1], 26.7);
    let mut crush = Crush::of_faces(face, face.scaled(0.8, 0.8), face);
    crush.end_rows = vec![Row { height_m: 0.55, share: 1.0 }];
    crush.side_rows = crush.end_rows.clone();
    car.body = Body::sized(size, front, crush);
    let rail = Rail { anchor_n_per_m, ..Rail::w_beam([[0.0, 4.0], [55.7, 4.0]]) };
    let start = Start { x_m: 14.0, y_m: 0.0, yaw_rad: deg.to_radians(), speed_m_s, ..Start::default() };
    let cars = vec![Entry::new(car, Driver::coasting(), Begin::At(start))];
    World { cars, barriers: vec![Barrier::Rail(rail)], ..World::default() }.run(1.3).unwrap()
}

/// Another program, in plan, with simpler tyres. Exit angles hang on every number (5 to 25°): they are not held.
#[test]
fn cars_leave_a_rail_as_another_program_says() {
    let pickup = (2270.0, 6000.0, [5.8, 1.95, 1.88], 2.6, 28.1, 25.5);
    let small = (1100.0, 1600.0, [4.2, 1.66, 1.45], 1.85, 27.1, 25.4);
    // anchors; deflection m, exit km/h, tension kN
    let cases = [
        (pickup, 1e6, [1.26, 61.0, 154.0]),
        (pickup, 3e6, [0.93, 67.0, 223.0]),
        (small, 1e6, [0.68, 57.0, 0.0]),
        (small, 3e6, [0.54, 64.0, 0.0]),
    ];
    for ((mass, yaw, size, front, speed_m_s, deg), anchor, [deflection_m, exit_kmh, tension_kn]) in cases {
        let outcome = hit(mass, yaw, size, front, speed_m_s, deg, anchor);
        let (rail, v) = (&outcome.rails[0], outcome.rides[0].last().velocity_m_s);
        // measured 1.270, 0.928, 0.690, 0.513 m; 61.1, 66.9, 59.1, 63.9 km/h; 160, 232 kN
        assert!((rail.deflection_m / deflection_m - 1.0).abs() < 0.06, "{rail:?}");
        assert!((3.6 * v.norm() / exit_kmh - 1.0).abs() < 0.05, "{}", 3.6 * v.norm());
        assert!(tension_kn == 0.0 || (rail.tension_n / 1e3 / tension_kn - 1.0).abs() < 0.05, "{rail:?}");
        // it is sent back, and turned along the rail
        let exit_deg = (-v.y).atan2(v.x).to_degrees();
        assert!((5.0..25.0).contains(&exit_deg), "{exit_deg}");
        // measured 3e-4: the rail's light masses are followed less closely
        assert!(outcome.balance.abs() < 5e-4, "{}", outcome.balance);
    }
}
