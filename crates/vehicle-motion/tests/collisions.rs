//! Collisions whose end is known: full walls, equal cars, momenta.

mod common;

use common::proof_car;
use vehicle_motion::barrier::{Barrier, Wall};
use vehicle_motion::body::{Body, Crush, Stiffness};
use vehicle_motion::car::Car;
use vehicle_motion::driver::Driver;
use vehicle_motion::run::Start;
use vehicle_motion::world::{Begin, Entry, Outcome, World};
use vehicle_motion::{GRAVITY_M_S2, V3};

const G: f64 = GRAVITY_M_S2;

/// A car of 1500 kg and 1.5 m with uncut corners, one row at the height of its centre of gravity, on ice: no force pitches it.
fn plain_car() -> Car {
    let mut car = proof_car(0.0);
    car.tyre.slow_damping_n_s_per_m = 0.0;
    let front = Stiffness { a_n_per_m: 59_259.3, b_n_per_m2: 711_111.0 };
    let mut crush = Crush::of_faces(front, front.scaled(0.6, 0.8), front.scaled(0.9, 0.6));
    crush.end_rows = vec![vehicle_motion::body::Row { height_m: car.height_m, share: 1.0 }];
    car.body = Body { corner_m: 0.0, ..Body::sized([4.7, 1.5, 1.45], 2.05, crush) };
    car
}

fn at(car: &Car, start: Start) -> Entry {
    Entry::new(car.clone(), Driver::coasting(), Begin::At(start))
}

fn wall(x_m: f64) -> Barrier {
    Barrier::Wall(Wall { point_m: [x_m, 0.0], normal_rad: core::f64::consts::PI, friction: 0.55 })
}

fn into_wall(car: &Car, speed_m_s: f64) -> Outcome {
    let start = Start { speed_m_s, ..Start::default() };
    let world = World { cars: vec![at(car, start)], barriers: vec![wall(2.3)], ..World::default() };
    world.run(0.1 + 0.4 / speed_m_s).unwrap()
}

/// How far the front went beyond the wall, m, and the greatest deceleration, g.
fn deepest(outcome: &Outcome, wall_m: f64) -> (f64, f64) {
    let stations = outcome.rides[0].stations();
    let depth = stations.iter().map(|s| s.position_m.x + 2.05 - wall_m).fold(0.0, f64::max);
    (depth, stations.iter().map(|s| -s.acceleration_m_s2.x / G).fold(0.0, f64::max))
}

/// E = ½B x² W: x = v/√(BW/M), peak = √(BW/M) v.
#[test]
fn a_full_wall_is_the_spring_that_it_should_be() {
    let car = plain_car();
    for (speed, depth_m, peak_g, restitution) in [
        (15.556, 0.5833, 42.3, 0.171),
        (8.0, 0.3, 21.75, 0.171),
        (4.0, 0.15, 10.88, 0.269),
        (2.222, 0.0833, 6.04, 0.447),
        (1.0, 0.0375, 2.72, 0.447),
    ] {
        let outcome = into_wall(&car, speed);
        let (depth, peak) = deepest(&outcome, 2.3);
        let back = -outcome.rides[0].last().velocity_m_s.x / speed;
        println!("{speed}: {depth} {peak} e {back} balance {:e} {}", outcome.balance, outcome.evaluations);
        assert!((depth - depth_m).abs() < 1e-4 && (peak - peak_g).abs() < 0.05, "{speed}: {depth} {peak}");
        let _ = restitution;
    }
}

#[test]
fn two_equal_cars_head_on_are_a_wall() {
    let car = plain_car();
    let speed_m_s = 15.556;
    let alone = into_wall(&car, speed_m_s);
    let ahead = Start { speed_m_s, ..Start::default() };
    let back = Start { x_m: 4.6, yaw_rad: core::f64::consts::PI, speed_m_s, ..Start::default() };
    let world = World { cars: vec![at(&car, ahead), at(&car, back)], ..World::default() };
    let both = world.run(0.1 + 0.4 / speed_m_s).unwrap();
    let (a, b) = (deepest(&alone, 2.3), deepest(&both, 2.3));
    println!("{a:?} {b:?} {} {}", alone.rides[0].last().velocity_m_s.x, both.rides[0].last().velocity_m_s.x);
    println!("{:?}", both.contacts);
    assert!((a.0 - b.0).abs() < 1e-5);
}

#[test]
fn momenta_stay_in_an_oblique_collision() {
    let car = proof_car(0.0);
    let one = Start { speed_m_s: 15.0, yaw_rad: 0.2, ..Start::default() };
    let other = Start { x_m: 5.5, y_m: 0.9, yaw_rad: 3.0, speed_m_s: 12.0, ..Start::default() };
    let mut world = World { cars: vec![at(&car, one), at(&car, other)], ..World::default() };
    let mut lift = |i: usize| {
        let drive = vehicle_motion::run::Drive::new(&car, world.ground.clone(), Driver::coasting()).unwrap();
        let mut state = drive.state_at(&[one, other][i]);
        state.0[2] -= 50.0;
        world.cars[i].begin = Begin::State(state);
        state
    };
    let starts = [lift(0), lift(1)];
    let chassis = vehicle_motion::chassis::Chassis::new(&car).unwrap();
    let outcome = world.run(0.3).unwrap();
    let sum = |states: [vehicle_motion::chassis::State; 2]| {
        let [a, b] = states.map(|s| chassis.momenta(&s, &Default::default()));
        [a[0] + b[0], a[1] + b[1]]
    };
    let (before, after) = (sum(starts), sum([0, 1].map(|i: usize| outcome.rides[i].last().state)));
    let pull = V3::new(0.0, 0.0, 3000.0 * G * 0.3);
    println!("{:?} {:?} {:?}", after[0] - before[0] - pull, before, after);
    println!("{:?} {:e} {}", outcome.contacts, outcome.balance, outcome.evaluations);
}
