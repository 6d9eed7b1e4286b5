//! Whatever switches in a joint of a rod or in an air bag, against an integration by itself or a balance of energy, under the default
//! integrator and others.

use crate::closed::INTEGRATORS;
use occupant_core::model::Model;
use occupant_core::results::channel::{Series, channels};
use occupant_core::results::outcome::Status;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use occupant_tests::gas_bag::GasBag;
use occupant_tests::measure::assert_below;
use occupant_tests::random::Random;
use occupant_tests::rod::{self, Pin, Rod};
use occupant_tests::room::setup;

/// A rod that a locked pin holds level until its moment is reached. What the pin has taken up until then is lost, and one that
/// slips takes up its moment from then on: the rest of what the rod has fallen is in its motion.
#[test]
fn a_joint_opens_or_slips_at_its_moment() {
    let mut random = Random::new(5);
    let mut worst = [0.0_f64; 4];
    for i in 0..20 {
        let (mass_kg, length_m) = (random.between(0.5, 8.0), random.between(0.2, 0.6));
        let weight = mass_kg * 9.806_65 * 0.5 * length_m;
        let (until, per_rad) = (weight * random.between(0.3, 1.4), weight * random.between(4.0, 40.0));
        let (slips, spin) = (i % 2 == 1 && until < 0.8 * weight, mass_kg * length_m * length_m / 12.0);
        let pin = format!("lock = {{ until = {until}, stiffness = {per_rad}, slips = {slips} }}");
        let text = rod::text(mass_kg, length_m, &pin, 0.15);
        for ((integrator, _), worst) in INTEGRATORS.iter().zip(&mut worst) {
            let model = Model::new(setup(&text, &[integrator])).unwrap();
            let (mut fallen_m, mut speed_m_s) = (0.0, 0.0);
            let watch = Watch(|s: &Sample<'_>| {
                let rod = s.model.body().tree.landmarks().head.unwrap();
                (fallen_m, speed_m_s) = (s.cg_m(rod).z, s.cg_velocity_m_s(rod).norm());
            });
            assert_eq!(simulate(&model, watch).unwrap().status, Status::Completed);
            let (arm_m, opened_rad) = (0.5 * length_m, until / per_rad);
            let turned_rad = (fallen_m / arm_m).asin();
            assert!(turned_rad > 1.1 * opened_rad, "{turned_rad} {opened_rad}");
            let slipped_rad = if slips { turned_rad - opened_rad } else { 0.0 };
            let lost = 0.5 * per_rad * opened_rad.powi(2) + until * slipped_rad;
            let expected = weight / arm_m * fallen_m - lost;
            let moving = 0.5 * (mass_kg + spin / arm_m.powi(2)) * speed_m_s.powi(2);
            *worst = worst.max((moving / expected - 1.0).abs());
        }
    }
    for ((integrator, bound), worst) in INTEGRATORS.iter().zip(worst) {
        assert_below(integrator, worst, *bound);
    }
}

/// The worst angle at the end of twenty such rods, as a part of all that each has turned; `least` is how often the pin begins to act.
fn check_rods(what: &str, least: u32, any: impl Fn(&mut Random) -> Rod) {
    let mut random = Random::new(17);
    let mut worst = [0.0_f64; 4];
    let mut begins = 0;
    for _ in 0..20 {
        let rod = any(&mut random);
        let expected = rod.expected();
        begins += expected.begins;
        for ((integrator, _), worst) in INTEGRATORS.iter().zip(&mut worst) {
            *worst = worst.max((rod.run(&[integrator]) - expected.angle).abs() / expected.way);
        }
    }
    assert!(begins >= 20 * least, "{what}: {begins}");
    for ((integrator, bound), worst) in INTEGRATORS.iter().zip(worst) {
        assert_below(&format!("{what}, {integrator}"), worst, *bound);
    }
}

fn any_rod(r: &mut Random, end_s: f64, pin: impl Fn(&mut Random, f64) -> Pin) -> Rod {
    let (mass_kg, length_m) = (r.between(0.5, 8.0), r.between(0.2, 0.6));
    let weight = mass_kg * 9.806_65 * 0.5 * length_m;
    Rod { mass_kg, length_m, pin: pin(r, weight), end_s }
}

#[test]
fn limits_stops_and_locks_of_joints_close_open_and_close_again() {
    check_rods("limit", 2, |r| {
        any_rod(r, 1.0, |r, weight| Pin::Limit {
            from_rad: r.between(0.5, 1.2),
            per_rad: weight * r.between(5.0, 60.0),
            returned: r.between(0.2, 1.0),
        })
    });
    check_rods("stop", 2, |r| {
        any_rod(r, 2.5, |r, weight| {
            let begin_rad = r.between(1.6, 1.8);
            Pin::Stop {
                begin_rad,
                full_rad: begin_rad + r.between(0.05, 0.2),
                damping: weight * r.between(0.005, 0.03),
            }
        })
    });
    check_rods("lock", 1, |r| {
        any_rod(r, 1.0, |r, weight| Pin::Lock {
            until: weight * r.between(0.3, 0.95),
            per_rad: weight * r.between(8.0, 40.0),
            below: r.between(0.3, 2.0),
        })
    });
}

#[test]
fn the_vent_of_an_air_bag_opens_at_its_pressure() {
    let mut random = Random::new(12);
    let (mut worst, mut opened, mut cases) = ([0.0_f64; 4], 0, 0);
    while cases < 20 {
        let r = &mut random;
        let speed_m_s = r.between(2.0, 6.0);
        let bag = GasBag {
            mass_kg: r.between(2.0, 12.0),
            above_m: 0.016 * speed_m_s + r.between(0.0, 0.1),
            speed_m_s,
            gravity_m_s2: r.between(0.0, 9.81),
            radius_m: r.between(0.2, 0.28),
            flow_kg_s: [r.between(1.5, 4.0), r.between(1.5, 4.0)],
            hole_m2: r.between(5e-4, 4e-3),
            opens_at_pa: r.between(2e3, 20e3),
            leak_m2: r.between(1e-5, 5e-4),
            end_s: 0.06,
        };
        let ([z, gauge, way, most], opened_s) = bag.expected();
        if !bag.stays_off_the_middle(way) {
            continue;
        }
        (cases, opened) = (cases + 1, opened + u32::from(opened_s.is_some()));
        for ((integrator, _), worst) in INTEGRATORS.iter().zip(&mut worst) {
            let (model, mut at) = (bag.model(&[integrator]), f64::NAN);
            let wanted = channels(&model).into_iter().filter(|channel| channel.name == "bag.g.pressure");
            let mut series = Series::new(wanted.collect());
            let watch = Watch(|s: &Sample<'_>| at = s.sphere_centre_m(0).z);
            assert_eq!(simulate(&model, (watch, &mut series)).unwrap().status, Status::Completed);
            let pressure = series.values[0].last().unwrap();
            *worst = worst.max((at - z).abs() / way).max((pressure - gauge).abs() / most);
        }
    }
    assert!(opened >= 15, "{opened}");
    for ((integrator, bound), worst) in INTEGRATORS.iter().zip(worst) {
        assert_below(integrator, worst, *bound);
    }
}
