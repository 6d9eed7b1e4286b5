//! What is damaged, and what is not.

use vehicle_motion::V3;
use vehicle_motion::barrier::{Barrier, Pole, Wall};
use vehicle_motion::body::Side;
use vehicle_motion::car::{Car, Class};
use vehicle_motion::driver::Driver;
use vehicle_motion::run::Start;
use vehicle_motion::world::{Begin, Entry, Outcome, World};

fn sedan() -> Car {
    let mut car = Car::of_class(Class::Sedan);
    car.tyre.friction = 0.7;
    car
}

fn hit(start: Start, barrier: Barrier) -> Outcome {
    let cars = vec![Entry::new(sedan(), Driver::coasting(), Begin::At(start))];
    World { cars, barriers: vec![barrier], ..World::default() }.run(0.4).unwrap()
}

/// A wall ahead damages the front alone, though it passes nodes of both sides.
#[test]
fn a_wall_ahead_damages_the_front_alone() {
    let wall = Barrier::Wall(Wall { point_m: [2.2, 0.0], normal_rad: core::f64::consts::PI, friction: 0.55 });
    let outcome = hit(Start { speed_m_s: 15.0, ..Start::default() }, wall);
    let sides: Vec<Side> = outcome.damage[0].profiles.iter().map(|profile| profile.side).collect();
    assert_eq!(sides, [Side::Front]);
    assert!(outcome.damage[0].dents.iter().all(|dent| dent.side == Side::Front));
    assert_eq!(outcome.damage[0].front_m(), outcome.damage[0].dynamic_m);
    // what it took is told at every station, and never less than before
    let crush = |i: usize| outcome.rides[0].stations()[i].crush_m;
    let last = outcome.rides[0].stations().len() - 1;
    assert!(
        (1..=last).all(|i| crush(i) >= crush(i - 1)) && (crush(last) / outcome.damage[0].dynamic_m - 1.0).abs() < 1e-3
    );
}

/// A pole beside him reaches him, as deep as it went and a door is thick; not the one on the other side, and not over the roof.
#[test]
fn crush_reaches_who_sits_behind_it() {
    let pole = Barrier::Pole(Pole { at_m: [0.0, -1.2], radius_m: 0.15, friction: 0.55 });
    let start =
        Start { speed_m_s: 8.0, sideslip_rad: -core::f64::consts::FRAC_PI_2, wheels_stand: true, ..Start::default() };
    let outcome = hit(start, pole);
    let (damage, car) = (&outcome.damage[0], sedan());
    let deepest = damage.dents.iter().map(|dent| dent.depth_m).fold(0.0, f64::max);
    assert!(damage.dents.iter().all(|dent| dent.side == Side::Left) && deepest > 0.2, "{deepest}");
    let reach = |y: f64, z: f64| damage.reaches_m(&V3::new(0.0, y, z), 0.1, &car);
    // the sheet stands at 0.91 m: depth, 0.2 m of door and the sphere's radius, less the way to its middle
    let expected = deepest + 0.2 + 0.1 - (0.91 - 0.4);
    assert!((reach(-0.4, 0.0).unwrap() - expected).abs() < 0.02, "{:?} {expected}", reach(-0.4, 0.0));
    assert!(reach(0.4, 0.0).unwrap() < 0.0 && reach(-0.4, -0.8).is_none());
}
