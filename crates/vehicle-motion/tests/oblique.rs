//! Four oblique offset tests of NHTSA and a run of another program, blind: class stiffness, friction 0.55, nothing fitted.

mod common;

use common::proof_car;
use vehicle_motion::body::{Body, Crush, Stiffness};
use vehicle_motion::car::Car;
use vehicle_motion::driver::Driver;
use vehicle_motion::run::Start;
use vehicle_motion::world::{Begin, Entry, World};

const LB: f64 = 0.453_592_37;
const FT: f64 = 0.3048;
const MPH: f64 = 0.447_04;
const SLUG: f64 = LB * 9.80665 / FT;

struct Vehicle {
    mass_kg: f64,
    yaw_kg_m2: f64,
    size_m: [f64; 3],
    front_m: f64,
    b1: f64,
}

impl Vehicle {
    fn car(&self) -> Car {
        let mut car = proof_car(0.7);
        let factor = self.mass_kg / car.mass_kg;
        car.mass_kg = self.mass_kg;
        car.inertia_kg_m2 *= factor;
        car.inertia_kg_m2[(1, 1)] = 0.9 * self.yaw_kg_m2;
        car.inertia_kg_m2[(2, 2)] = self.yaw_kg_m2;
        for axle in [&mut car.front, &mut car.rear] {
            axle.rate_n_per_m *= factor;
        }
        let front = Stiffness::by_speed(self.mass_kg, self.size_m[1], self.b1);
        let crush = Crush::of_faces(front, front.scaled(0.6, 0.8), front.scaled(0.9, 0.6));
        car.body = Body::sized(self.size_m, self.front_m, crush);
        car
    }
}

/// Published: a planar model of impact without tyres, its restitution fitted to each test; so the impulse of the contact is compared. Measured Δv:
/// +2.6 and +2.3, +0.2 and +0.4, +2.4 and +2.3, −2.8 and −2.6 %. With what tyres do meanwhile it is +0.3, +0.7, −1.9, −0.9, +0.5, +1.0, −4.8, −4.0 %.
#[test]
fn four_oblique_offset_tests_come_out_blind() {
    struct Case {
        name: &'static str,
        masses_lb: [f64; 2],
        inertias: [f64; 2],
        arms_ft: [f64; 2],
        bearings_deg: [f64; 2],
        heading_deg: f64,
        speeds_mph: [f64; 2],
        expected: [f64; 4],
        size_m: [f64; 3],
        front_m: f64,
    }
    let cases = [
        Case {
            name: "4363",
            masses_lb: [3451.1, 4695.4],
            inertias: [2152.0, 2805.0],
            arms_ft: [2.6, 5.7],
            bearings_deg: [23.8, 10.6],
            heading_deg: 32.0,
            speeds_mph: [35.1, 35.0],
            expected: [39.5, 31.0, 29.1, 182.0],
            size_m: [4.655, 1.722, 1.63],
            front_m: 2.09,
        },
        Case {
            name: "4364",
            masses_lb: [3451.1, 5192.5],
            inertias: [2152.0, 3563.0],
            arms_ft: [2.3, 7.1],
            bearings_deg: [45.7, 11.2],
            heading_deg: 30.0,
            speeds_mph: [35.0, 34.9],
            expected: [40.1, 108.0, 26.6, 148.0],
            size_m: [4.87, 1.895, 1.74],
            front_m: 2.25,
        },
        Case {
            name: "4438",
            masses_lb: [3305.7, 4725.3],
            inertias: [2066.0, 2889.0],
            arms_ft: [2.8, 5.0],
            bearings_deg: [35.3, 13.2],
            heading_deg: 30.0,
            speeds_mph: [34.7, 35.0],
            expected: [39.7, 68.0, 27.8, 166.0],
            size_m: [4.53, 1.775, 1.74],
            front_m: 2.0,
        },
        Case {
            name: "4474",
            masses_lb: [3305.7, 4657.0],
            inertias: [2066.0, 2863.0],
            arms_ft: [2.9, 5.5],
            bearings_deg: [34.7, 15.2],
            heading_deg: 31.6,
            speeds_mph: [35.0, 35.0],
            expected: [40.5, 40.0, 28.7, 194.0],
            size_m: [4.53, 1.775, 1.74],
            front_m: 2.0,
        },
    ];
    for case in cases {
        // the planar model's centre of impact: paper axes turn anticlockwise; it is the same seen from below
        let vehicle = |i: usize| Vehicle {
            mass_kg: case.masses_lb[i] * LB,
            yaw_kg_m2: case.inertias[i] * SLUG * FT * FT,
            size_m: [[4.805, 1.785, 1.45], case.size_m][i],
            front_m: [2.05, case.front_m][i],
            b1: [27.7, 26.5][i],
        };
        let start = |i: usize| {
            let heading = [180.0, case.heading_deg][i].to_radians();
            let bearing = heading + case.bearings_deg[i].to_radians();
            let speed_m_s = case.speeds_mph[i] * MPH;
            // 0.12 s before the cars are where the planar model has them
            let ahead = 0.12 * speed_m_s;
            Start {
                x_m: -case.arms_ft[i] * FT * bearing.cos() - ahead * heading.cos(),
                y_m: -case.arms_ft[i] * FT * bearing.sin() - ahead * heading.sin(),
                yaw_rad: heading,
                speed_m_s,
                ..Start::default()
            }
        };
        let cars = (0..2).map(|i| Entry::new(vehicle(i).car(), Driver::coasting(), Begin::At(start(i)))).collect();
        let world = World { cars, ..World::default() };
        let outcome = world.run(0.4).unwrap();
        let of = |i: usize| outcome.contacts[0].struck[i].unwrap().by_contact_m_s.norm() / MPH;
        let turns = |i: usize| outcome.contacts[0].struck[i].unwrap().yaw_rates_rad_s[1].to_degrees().abs();
        for i in 0..2 {
            let off = of(i) / case.expected[2 * i] - 1.0;
            assert!(off.abs() < 0.035, "{} {i}: {off}", case.name);
        }
        // after a nearly central hit the turn is ill-conditioned: friction 0.3 to 0.8 moves it by 100 °/s
        assert!((turns(0) - case.expected[1]).abs() < 60.0 && (turns(1) - case.expected[3]).abs() < 60.0);
        assert!(outcome.balance.abs() < 2e-5, "{}", outcome.balance);
    }
}
