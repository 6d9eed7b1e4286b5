//! Runs side by side under error control: each takes, to the bit, the steps that it would take alone.

use occupant_core::forces::contact::material::Memory;
use occupant_core::model::setup::{Integrator, Setup};
use occupant_core::results::outcome::Status;
use occupant_core::run::batch::Kernel;
use occupant_tests::room::{room, setup};

use crate::lanes::{Case, Texts, cart, compare, kernels};

/// A case under error control whose materials, end, outputs and tolerances are its own.
fn own(i: usize, mut setup: Setup, end_s: f64) -> Case {
    let scale = 1.0 + 0.06 * i as f64;
    for material in &mut setup.materials {
        if let Some(spring) = material.force.bilinear_mut() {
            spring.k1_n_per_m *= scale;
        }
        material.friction /= scale;
        if i.is_multiple_of(2) {
            material.memory = Memory::Retain;
        }
    }
    let relative = 1e-5 * [1.0, 3.0, 0.5, 10.0][i % 4];
    setup.integrator = Integrator::Adaptive {
        relative,
        absolute_m: 0.1 * relative,
        absolute_m_s: relative,
        min_step_s: 1e-9,
        max_step_s: 2e-3 - 3e-4 * (i % 3) as f64,
    };
    setup.time.end_s = end_s * (1.0 + 0.07 * (i % 4) as f64);
    setup.time.output_s = 1e-3 * (1 + i % 3) as f64;
    Case { setup, texts: Texts::default() }
}

fn controlled_cart(i: usize) -> Case {
    own(i, cart(i).setup, 0.09)
}

fn scenario(text: &str, count: usize, end_s: f64) -> Vec<Case> {
    (0..count).map(|i| own(i, setup(text, &[]), end_s)).collect()
}

/// All in lanes, all completed, and no two of the same number of steps.
fn differ_and_agree(cases: &[Case]) {
    for kernel in kernels() {
        let mut steps = Vec::new();
        for ((outcome, _), used) in compare(cases, kernel) {
            let outcome = outcome.unwrap();
            assert_eq!((outcome.status, used), (Status::Completed, kernel));
            steps.push(outcome.effort.steps);
        }
        steps.sort_unstable();
        steps.dedup();
        assert!(steps.len() == cases.len(), "{steps:?}");
    }
}

#[test]
fn carts_side_by_side_take_steps_of_their_own() {
    for count in [2, 5, 11] {
        differ_and_agree(&(0..count).map(controlled_cart).collect::<Vec<_>>());
    }
}

/// Spools lock, pretensioners fire and stall, limiters yield at times of their own.
#[test]
fn so_do_drivers_with_three_point_belts() {
    differ_and_agree(&scenario(include_str!("../../tests/data/hand/three-point.toml"), 6, 0.05));
}

/// Bags fire at times of their own.
#[test]
fn so_do_drivers_with_air_bags() {
    let delays = ["12 ms", "9 ms", "15 ms", "12.7 ms", "10 ms"];
    let fired = |i: usize| {
        let delay = format!("bags.driver.delay={:?}", delays[i]);
        own(i, setup(include_str!("../../tests/data/hand/airbag-driver.toml"), &[&delay]), 0.045)
    };
    differ_and_agree(&(0..5).map(fired).collect::<Vec<_>>());
}

#[test]
fn so_do_drivers_behind_columns() {
    differ_and_agree(&scenario(include_str!("../../tests/data/hand/column-driver.toml"), 4, 0.04));
}

/// Corners of contacts come before switches in the same trial.
#[test]
fn so_do_drivers_who_leave_the_road() {
    let ditch = include_str!("../../scenarios/ditch.toml");
    let driver =
        |i: usize| own(i, setup(ditch, &[&format!("drive.vehicles.car.start.speed=\"{} km/h\"", 60 + 13 * i)]), 1.0);
    differ_and_agree(&(0..4).map(driver).collect::<Vec<_>>());
}

#[test]
fn so_do_persons_on_sleds() {
    differ_and_agree(&scenario(include_str!("../../scenarios/sled-person.toml"), 5, 0.03));
}

#[test]
fn so_do_bodies_of_17_segments() {
    differ_and_agree(&scenario(include_str!("../../scenarios/sled-17-segments.toml"), 5, 0.03));
}

/// Steps end where what flies first touches.
#[test]
fn so_do_bodies_that_fall_through_a_room() {
    let spins = "0, 3, 0, ".repeat(6);
    let fast = [&*format!("initial_state.rates=[25, 0.6, -2.5, {spins} 0, 0, 0, 3, 0, 0, 3, 0, 0, 0]")];
    let cases: Vec<Case> = (0..5).map(|i| own(i, room(if i == 2 { &fast } else { &[] }), 0.1)).collect();
    differ_and_agree(&cases);
}

#[test]
fn the_order_of_jobs_makes_no_difference() {
    for kernel in kernels() {
        let mut cases: Vec<Case> = (0..7).map(controlled_cart).collect();
        cases.reverse();
        compare(&cases, kernel);
        cases.swap(0, 4);
        compare(&cases, kernel);
    }
}

#[test]
fn runs_of_fixed_steps_and_under_error_control_are_not_mixed() {
    for kernel in kernels() {
        let cases = [controlled_cart(0), cart(1), controlled_cart(2), cart(3)];
        let used: Vec<_> = compare(&cases, kernel).into_iter().map(|(_, used)| used).collect();
        assert_eq!(used, [kernel, Kernel::Scalar, kernel, Kernel::Scalar]);
    }
}

#[test]
fn a_run_that_fails_stops_or_breaks_leaves_its_neighbours_alone() {
    for kernel in kernels() {
        let mut cases: Vec<Case> = (0..10).map(controlled_cart).collect();
        // no step is short enough: at once, and at the first touch
        for (i, least_s) in [(1, 1.6e-3), (4, 1e-3)] {
            if let Integrator::Adaptive { min_step_s, .. } = &mut cases[i].setup.integrator {
                *min_step_s = least_s;
            }
        }
        cases[2].texts.stop_at = Some(31);
        cases[3].texts.stop_at = Some(0);
        cases[5].texts.break_at = Some(17);
        cases[6].texts.break_at = Some(0);
        let results = compare(&cases, kernel);
        let outcome = |i: usize| &results[i].0.0;
        let failed = |i: usize| matches!(outcome(i), Ok(o) if matches!(o.status, Status::Failed(_)));
        assert!(failed(1) && failed(4), "{:?} {:?}", outcome(1), outcome(4));
        let stopped = |i: usize| outcome(i).as_ref().unwrap().status == Status::Stopped;
        assert!(stopped(2) && stopped(3));
        assert!(outcome(5).is_err() && outcome(6).is_err());
    }
}
