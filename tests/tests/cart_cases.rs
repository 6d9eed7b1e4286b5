//! The three cart cases as their scenarios give them: energy accounts, and the lap case against the one built in code.

use nalgebra::Point3;
use occupant_core::forces::contact::EdgeForce;
use occupant_core::model::Model;
use occupant_core::model::setup::{Integrator, Setup};
use occupant_core::results::energy::EnergyLedger;
use occupant_core::results::outcome::Status;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use occupant_scenario::{Format, Scenario};
use occupant_tests::cart;
use occupant_tests::measure::assert_below;

const CARTS: [(&str, &str); 3] = [
    ("unbelted", include_str!("../data/carts/cart-unbelted.toml")),
    ("lap", include_str!("../data/carts/cart-lap.toml")),
    ("lap and torso", include_str!("../data/carts/cart-lap-torso.toml")),
];

/// The plain data of a scenario that names no other file.
fn setup(text: &str) -> Setup {
    let alone = |name: &str| Err(format!("no file beside the text: {name}"));
    let loaded = Scenario::from_text(text, Format::Toml, "cart", &alone);
    let built = loaded.and_then(|s| s.build()).unwrap_or_else(|d| panic!("{d}"));
    built.0
}

/// Sphere centres at every output.
fn places(setup: Setup) -> Vec<Point3<f64>> {
    let model = Model::new(setup).unwrap_or_else(|p| panic!("{p}"));
    let mut places = Vec::new();
    simulate(&model, Watch(|s: &Sample<'_>| places.extend((0..17).map(|i| s.sphere_centre_m(i))))).unwrap();
    places
}

#[test]
fn the_lap_scenario_is_the_case_built_in_code() {
    let scenario = setup(CARTS[1].1);
    let mut code = cart::lap(scenario.integrator);
    code.edge_force = scenario.edge_force;
    let (a, b) = (places(scenario), places(code));
    assert_eq!(a.len(), 201 * 17);
    let far = a.iter().zip(&b).map(|(p, q)| (p - q).norm());
    // units are converted in another order; rounding grows a little after the head contact
    // Measured: 7.4e-15.
    assert_below("sphere paths, m", far.fold(0.0, f64::max), 1e-9);
}

#[test]
fn the_energy_balance_of_every_cart_case_closes_and_does_so_better_with_half_the_step() {
    for (name, text) in CARTS {
        let error = |step_s: f64| {
            let mut setup = setup(text);
            setup.integrator = Integrator::Rk4 { step_s };
            let outcome = simulate(&Model::new(setup).unwrap(), ()).unwrap();
            assert_eq!(outcome.status, Status::Completed);
            outcome.energy.balance_error
        };
        let (whole, half) = (error(1e-4), error(5e-5));
        // Measured: 2.3e-6.
        assert_below(&format!("{name}: imbalance at 0.1 ms"), whole, 1e-3);
        // Measured: 1.7e-7.
        assert_below(&format!("{name}: imbalance at 0.05 ms"), half, 0.7 * whole);
    }
}

/// Losses of contacts, friction, joints and belts, J.
fn losses(e: &EnergyLedger) -> [f64; 4] {
    std::array::from_fn(|i| e.lost_j[i])
}

#[test]
fn what_is_lost_stays_lost() {
    for (name, text) in CARTS {
        let mut setup = setup(text);
        setup.edge_force = EdgeForce::AtCentre;
        let model = Model::new(setup).unwrap();
        let (mut last, mut gained) = ([0.0; 4], 0.0_f64);
        simulate(
            &model,
            Watch(|s: &Sample<'_>| {
                let now = losses(&s.energy);
                for (now, last) in now.iter().zip(last) {
                    gained = gained.max(last - now);
                }
                last = now;
            }),
        )
        .unwrap();
        assert!(last[0] > 100.0 && last[1] > 10.0 && last[2] > 10.0, "{last:?}");
        // elastic webbing loses nothing; edges met between two steps may err by a fraction of a millijoule
        // Measured: 2.8e-4.
        assert_below(&format!("{name}: energy that comes back, J"), gained, 2e-3);
    }
}
