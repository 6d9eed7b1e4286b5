//! People who push the car: drives with them as rigid mass, then with the force that they exerted, against both moved together.

mod common;

use common::proof_car;
use vehicle_motion::barrier::{Barrier, Wall};
use vehicle_motion::body::{Body, Crush, Row, Stiffness};
use vehicle_motion::car::{Car, CarError, Riders};
use vehicle_motion::driver::{Driver, Table};
use vehicle_motion::run::{Ride, Start};
use vehicle_motion::world::{Begin, Entry, World, Wrench};
use vehicle_motion::{GRAVITY_M_S2 as G, V3};

const PERSON_KG: f64 = 75.0;
const SPEED_M_S: f64 = 15.6;

/// 1350 kg without people, on ice; its front as stiff as the table's.
fn car(people_kg: f64) -> Car {
    let mut car = proof_car(0.0);
    car.mass_kg = 1350.0;
    car.tyre.slow_damping_n_s_per_m = 0.0;
    let front = Stiffness { a_n_per_m: 60e3, b_n_per_m2: 770e3 };
    let mut crush = Crush::of_faces(front, front, front);
    crush.end_rows = vec![Row { height_m: 0.55, share: 1.0 }];
    car.body = Body { corner_m: 0.0, ..Body::sized([4.7, 1.8, 1.45], 2.05, crush) };
    car.with_load(people_kg, V3::zeros()).0
}

fn drive(car: &Car, push: Option<Wrench>) -> (Ride, f64, f64) {
    let start = Start { speed_m_s: SPEED_M_S, ..Start::default() };
    let entry = Entry { push, ..Entry::new(car.clone(), Driver::coasting(), Begin::At(start)) };
    let wall = Barrier::Wall(Wall { point_m: [2.051, 0.0], normal_rad: core::f64::consts::PI, friction: 0.55 });
    let mut outcome = World { cars: vec![entry], barriers: vec![wall], ..World::default() }.run(0.2).unwrap();
    let ride = outcome.rides.swap_remove(0);
    let deepest = ride.stations().iter().map(|s| s.position_m.x - 0.001).fold(0.0, f64::max);
    let peak = ride.stations().iter().map(|s| -s.acceleration_m_s2.x / G).fold(0.0, f64::max);
    (ride, deepest, peak)
}

/// A person on a belt of 250 kN/m with 30 mm of slack and a plateau of 18 kN: way in the car, and force on the car over time.
fn person(ride: &Ride) -> (f64, Table) {
    let (mut at, mut speed, mut way) = (0.0, SPEED_M_S, 0.0f64);
    let (mut times, mut forces) = (Vec::new(), Vec::new());
    let h = 1e-5;
    for i in 0..20_000 {
        let time_s = h * f64::from(i);
        let in_car = at - ride.at(time_s).0.x;
        let force = (2.5e5 * (in_car - 0.03)).clamp(0.0, 18e3);
        if i % 50 == 0 {
            times.push(time_s);
            forces.push(force);
        }
        way = way.max(in_car);
        speed -= h * force / PERSON_KG;
        at += h * speed;
    }
    (way, Table::new(times, forces).unwrap())
}

#[test]
fn two_passes_are_the_coupled_motion() {
    // deepest crush, peak and way of a person, m, g and m: as rigid mass, coupled, after passes 1 and 2
    let table = [
        (1.0, [0.5002, 0.5740], [0.4895, 49.9, 0.5617], [0.5618, 0.5617]),
        (2.0, [0.5132, 0.5665], [0.4922, 48.8, 0.5440], [0.5443, 0.5439]),
        (4.0, [0.5383, 0.5521], [0.4980, 46.7, 0.5137], [0.5151, 0.5137]),
    ];
    for (people, rigid, coupled, passes) in table {
        let (ride, deepest, _) = drive(&car(people * PERSON_KG), None);
        let (mut way, mut force) = person(&ride);
        assert!((deepest / rigid[0] - 1.0).abs() < 2e-3 && (way / rigid[1] - 1.0).abs() < 5e-3, "{deepest} {way}");
        for expected in passes {
            let zero = || Table::constant(0.0);
            let of_all = scaled(&force, people);
            let components = [of_all, zero(), zero(), zero(), zero(), zero()];
            let (ride, deepest, peak) = drive(&car(0.0), Some(Wrench { about_m: V3::zeros(), components }));
            (way, force) = person(&ride);
            // measured the same to four digits
            assert!((way / expected - 1.0).abs() < 0.01 && (deepest / coupled[0] - 1.0).abs() < 0.01);
            assert!((peak / coupled[1] - 1.0).abs() < 0.01);
            assert!(ride.balance().abs() < 1e-4, "{}", ride.balance());
        }
    }
}

/// Passes with a massless person change nothing: what a light one does to the last position goes in proportion to his mass.
/// The table of his force cuts steps, which is within the tolerance of 0.1 mm.
#[test]
fn a_massless_person_pushes_nothing() {
    let (alone, ..) = drive(&car(0.0), None);
    let (_, force) = person(&alone);
    let pushed = |people: f64| {
        let [about_all, rest] = [scaled(&force, people), Table::constant(0.0)];
        let components = [about_all, rest.clone(), rest.clone(), rest.clone(), rest.clone(), rest];
        drive(&car(0.0), Some(Wrench { about_m: V3::zeros(), components })).0.last().position_m
    };
    let none = pushed(0.0);
    let steps_m = (none - alone.last().position_m).norm();
    let shift_m = |people: f64| (pushed(people) - none).norm();
    let [hardly_m, light_m, heavier_m] = [1e-9, 1e-4, 1e-2].map(shift_m);
    // measured 4.7e-5 m; 2.1e-9 m, where touches are found; 0.14198 and 0.14197 m for a whole person
    assert!(steps_m < 1e-4 && hardly_m < 1e-8, "{steps_m:e} {hardly_m:e}");
    assert!((100.0 * light_m / heavier_m - 1.0).abs() < 1e-3, "{light_m:e} {heavier_m:e}");
}

fn scaled(table: &Table, factor: f64) -> Table {
    let times: Vec<f64> = table.corners_s().to_vec();
    let values = times.iter().map(|t| factor * table.at(*t)).collect();
    Table::new(times, values).unwrap()
}

/// A load taken out again leaves the car that there was; a car without people and push is the car.
#[test]
fn a_load_goes_in_and_out() {
    let before = car(0.0);
    let place = V3::new(-0.4, 0.3, -0.1);
    let (loaded, shift) = before.with_load(80.0, place);
    let (after, back) = loaded.with_load(-80.0, place - shift);
    assert!((after.mass_kg - before.mass_kg).abs() < 1e-9 && (shift + back).norm() < 1e-12);
    assert!((after.inertia_kg_m2 - before.inertia_kg_m2).norm() < 1e-9);
    assert!((after.front.ahead_m - before.front.ahead_m).abs() < 1e-12);
    assert!(
        (after.body.front_m - before.body.front_m).abs() < 1e-12 && (after.height_m - before.height_m).abs() < 1e-12
    );
}

/// Riders whose weight presses on the floor as a wrench: the car stands as one that carries them, and drives away level.
#[test]
fn riders_press_a_car_as_their_mass_does() {
    let (mass_kg, place) = (150.0, V3::new(-0.3, 0.25, -0.1));
    let mut light = proof_car(0.8);
    light.riders = Some(Riders { mass_kg, place_m: place });
    let loads = light.wheel_loads_n();
    assert!((loads.iter().sum::<f64>() - 1650.0 * G).abs() < 1e-9);
    let [front, rear] = proof_car(0.8).with_load(mass_kg, place).0.static_loads_n();
    assert!((loads[0] + loads[1] - 2.0 * front).abs() < 1e-9 && (loads[2] + loads[3] - 2.0 * rear).abs() < 1e-9);
    assert!(loads[1] > loads[0] && loads[3] > loads[2]);
    let constant = [0.0, 0.0, mass_kg * G, 0.0, 0.0, 0.0].map(Table::constant);
    let push = Some(Wrench { about_m: place, components: constant });
    let start = Start { speed_m_s: 10.0, ..Start::default() };
    let entry = Entry { push, ..Entry::new(light.clone(), Driver::coasting(), Begin::At(start)) };
    let ride = World { cars: vec![entry], ..World::default() }.run(2.0).unwrap().rides.swap_remove(0);
    for station in ride.stations() {
        let [_, pitch, roll] = station.state.yaw_pitch_roll_rad();
        // the slides lean, so that sideways preload meets the tyres: 2e-5 rad
        assert!(pitch.abs() < 1e-4 && roll.abs() < 1e-4 && (station.position_m.z + 0.55).abs() < 1e-4);
    }
    light.riders = Some(Riders { mass_kg, place_m: V3::new(-30.0, 0.0, 0.0) });
    assert!(matches!(light.check(), Err(CarError::Riders { .. })));
}
