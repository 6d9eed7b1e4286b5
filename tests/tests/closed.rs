//! Whatever switches on a mass on a strap, or on a pendulum that a lock holds, against an integration by itself or a balance of
//! energy, under the default integrator and others.

use occupant_core::model::Model;
use occupant_core::results::outcome::Status;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use occupant_tests::gas_bag::GasBag;
use occupant_tests::measure::assert_below;
use occupant_tests::random::Random;
use occupant_tests::rod::{self, Pin, Rod};
use occupant_tests::room::{ends_alike_side_by_side, setup};
use occupant_tests::strap::{Cue, FALLS, PULLED, Pull, Strap, Watched};

/// With how near each must come: the default, looser tolerances, steps of fixed length, and those where they are long.
const INTEGRATORS: [(&str, f64); 4] = [
    ("integrator={ kind = \"adaptive\" }", 1e-4),
    ("integrator={ kind = \"adaptive\", relative = 3e-6, absolute_length = 3e-7, absolute_speed = 3e-5 }", 2e-3),
    ("integrator={ kind = \"rk4\", step = \"0.1 ms\" }", 1e-4),
    ("integrator={ kind = \"rk4\", step = \"0.37 ms\" }", 1e-3),
];

/// A strap of random mass, webbing, speed and limiter.
fn any(random: &mut Random) -> Strap {
    Strap {
        mass_kg: random.between(2.0, 60.0),
        webbing_n: random.between(20e3, 300e3),
        spool_n: random.between(2.0, 20.0),
        place_m: random.between(0.3, 1.5),
        speed_m_s: random.between(1.0, 6.0),
        gravity_m_s2: random.between(0.0, 9.81),
        knee: [random.between(0.005, 0.05), random.between(500.0, 4000.0)],
        returned: 10_f64.powf(random.between(-2.0, 0.0)),
        end_s: random.between(0.05, 0.07),
        lock: None,
        ..FALLS
    }
}

/// The worst place at the end of forty such cases, as a part of the furthest way.
fn check(what: &str, case: impl Fn(&mut Random) -> Strap) {
    let mut random = Random::new(33);
    let mut worst = [0.0_f64; 4];
    for _ in 0..40 {
        let case = case(&mut random);
        let expected = case.expected();
        for ((integrator, _), worst) in INTEGRATORS.iter().zip(&mut worst) {
            let [z, _] = case.run(&[integrator]);
            *worst = worst.max((z - expected.z).abs() / expected.way_m.max(1e-3));
        }
    }
    for ((integrator, bound), worst) in INTEGRATORS.iter().zip(worst) {
        assert_below(&format!("{what}, {integrator}"), worst, *bound);
    }
}

fn cue(random: &mut Random) -> Cue {
    Cue::At(random.between(0.002, 0.03))
}

fn pull(random: &mut Random, cue: Cue, level_n: f64) -> Pull {
    Pull {
        cue,
        delay_s: random.between(0.0, 0.005),
        speed_m_s: random.between(2.0, 14.0),
        lasts_s: random.between(0.004, 0.012),
        stall_n: level_n * random.between(0.3, 2.5),
    }
}

#[test]
fn spools_lock_where_a_closed_integration_says() {
    check("lock", |r| Strap { lock: Some((cue(r), r.between(0.0, 0.03))), ..any(r) });
}

#[test]
fn pretensioners_stall_or_end_where_a_closed_integration_says() {
    check("pull", |r| {
        let case = Strap { speed_m_s: r.between(-0.5, 2.0), gravity_m_s2: 0.0, ..any(r) };
        let fires = cue(r);
        Strap { pull: Some(pull(r, fires, case.knee[1])), ..case }
    });
    check("small pull", |r| {
        let case = Strap { speed_m_s: r.between(-0.1, 0.1), end_s: 0.03, place_m: 1.0, ..PULLED };
        let fires = cue(r);
        Strap { pull: Some(pull(r, fires, case.knee[1])), ..case }
    });
}

#[test]
fn locks_and_pretensioners_act_together_and_at_once() {
    check("lock and pull", |r| {
        let case = Strap { lock: Some((cue(r), r.between(0.0, 0.03))), ..any(r) };
        let fires = cue(r);
        Strap { pull: Some(pull(r, fires, case.knee[1])), ..case }
    });
    check("at once", |r| {
        let at = cue(r);
        let case = Strap { lock: Some((at, 0.0)), ..any(r) };
        let second = Some((at, [case.knee[0], case.knee[1] * r.between(0.3, 2.0)], 0.004));
        Strap { pull: Some(Pull { delay_s: 0.0, ..pull(r, at, case.knee[1]) }), second, ..case }
    });
}

#[test]
fn a_second_limiter_takes_over_where_a_closed_integration_says() {
    check("second limiter", |r| {
        let case = Strap { lock: Some((Cue::At(r.between(0.001, 0.01)), 0.0)), ..any(r) };
        let knee = [r.between(0.005, 0.05), case.knee[1] * r.between(0.2, 2.0)];
        let over = match r.between(0.0, 3.0) {
            x if x < 1.0 => Cue::At(r.between(0.01, 0.04)),
            x if x < 2.0 => Cue::Watch(Watched::Payout, r.between(0.03, 0.1), 0.0),
            _ => Cue::Watch(Watched::Tension, case.knee[1] * r.between(0.3, 0.9), 0.0),
        };
        Strap { second: Some((over, knee, r.between(0.001, 0.01))), ..case }
    });
}

#[test]
fn triggers_fire_where_what_they_watch_passes_its_threshold() {
    for of in [Watched::Payout, Watched::Speed] {
        check(&format!("watches {of:?}"), |r| {
            let case = any(r);
            let spool = Strap { gravity_m_s2: 9.81, end_s: 0.08, ..case };
            let t = r.between(0.005, 0.03);
            let threshold = match of {
                Watched::Speed => spool.speed_m_s + (9.81 - spool.spool_n / spool.mass_kg) * t,
                _ => spool.speed_m_s * t,
            };
            let lasting_s = if r.chance(0.5) { 0.0 } else { r.between(0.001, 0.01) };
            Strap { lock: Some((Cue::Watch(of, threshold, lasting_s), r.between(0.0, 0.02))), ..spool }
        });
    }
    check("pull by tension", |r| {
        let case = Strap { lock: Some((cue(r), 0.0)), ..any(r) };
        let fires = Cue::Watch(Watched::Tension, case.knee[1] * r.between(0.05, 0.5), r.between(0.0, 0.003));
        Strap { pull: Some(pull(r, fires, case.knee[1])), ..case }
    });
}

#[test]
fn belts_are_freed_and_tear_where_a_closed_integration_says() {
    check("release", |r| Strap { lock: Some((cue(r), 0.0)), release: Some(Cue::At(r.between(0.01, 0.05))), ..any(r) });
    check("release by tension", |r| {
        let case = Strap { lock: Some((cue(r), 0.0)), ..any(r) };
        let frees = Cue::Watch(Watched::Tension, case.knee[1] * r.between(0.1, 0.9), r.between(0.0, 0.01));
        Strap { release: Some(frees), ..case }
    });
    check("tear", |r| {
        let case = Strap { lock: Some((cue(r), 0.0)), ..any(r) };
        Strap { strength_n: Some(case.knee[1] * r.between(0.1, 0.95)), ..case }
    });
}

/// A tension that swings about the threshold of a release that wants it for a second.
#[test]
fn a_trigger_that_chatters_takes_some_evaluations_and_no_end() {
    let swings = Strap { mass_kg: 1.0, speed_m_s: 1.0, gravity_m_s2: 300.0, returned: 1.0, end_s: 0.3, ..FALLS };
    let swings = Strap { lock: Some((Cue::At(0.0), 0.0)), knee: [0.001, 5000.0], ..swings };
    let chatters = Strap { release: Some(Cue::Watch(Watched::Tension, 301.0, 1.0)), ..swings };
    for (integrator, _) in INTEGRATORS {
        let [without, with] = [swings, chatters].map(|case| {
            let mut changes = 0;
            let mut was = false;
            let watch = Watch(|s: &Sample<'_>| {
                let is = s.actions.chains[0].force > 301.0;
                changes += u32::from(is != was);
                was = is;
            });
            let outcome = simulate(&case.model(&[integrator]), watch).unwrap();
            assert_eq!(outcome.status, Status::Completed);
            assert!(changes > 20, "{changes}");
            outcome.effort.evaluations as f64
        });
        assert_below(integrator, with / without, 3.0);
    }
}

#[test]
fn all_that_switches_has_the_bits_of_single_runs_side_by_side() {
    for (kind, (integrator, _)) in INTEGRATORS.iter().enumerate().skip(2) {
        ends_alike_side_by_side(|i| {
            let r = &mut Random::new(u64::from(i) + 100 * kind as u64);
            let case = Strap { lock: Some((cue(r), r.between(0.0, 0.02))), end_s: 0.06, ..any(r) };
            let watch = Cue::Watch(Watched::Tension, 0.5 * case.knee[1], 0.0);
            let case = Strap { pull: Some(pull(r, watch, case.knee[1])), strength_n: Some(9e3), ..case };
            let second = Some((Cue::At(0.03), [0.01, 1.3 * case.knee[1]], 0.004));
            Strap { second, ..case }.model(&[integrator, "output.interval=\"0.9 ms\""])
        });
    }
}

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
        any_rod(r, 0.7, |r, weight| Pin::Limit {
            from_rad: r.between(0.5, 1.2),
            per_rad: weight * r.between(5.0, 60.0),
            returned: r.between(0.2, 1.0),
        })
    });
    check_rods("stop", 2, |r| {
        any_rod(r, 1.2, |r, weight| {
            let begin_rad = r.between(1.6, 2.2);
            Pin::Stop { begin_rad, full_rad: begin_rad + r.between(0.05, 0.2), damping: weight * r.between(0.01, 0.05) }
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
fn webbing_that_keeps_a_part_of_its_work_turns_round_within_a_step() {
    let returned = |r: &mut Random| 10_f64.powf(r.between(-1.5, 0.0));
    check("anchor", |r| {
        let case =
            Strap { is_fixed: true, webbing_returned: returned(r), gravity_m_s2: r.between(3.0, 300.0), ..any(r) };
        Strap { webbing_n: r.between(10e3, 100e3), end_s: 0.3, ..case }
    });
    check("spool", |r| Strap { lock: Some((cue(r), 0.0)), webbing_returned: returned(r), ..any(r) });
    check("pretensioner", |r| {
        let case =
            Strap { gravity_m_s2: 0.0, speed_m_s: r.between(-0.5, 2.0), webbing_returned: returned(r), ..any(r) };
        let fires = cue(r);
        Strap { pull: Some(pull(r, fires, case.knee[1])), ..case }
    });
}

#[test]
fn the_vent_of_an_air_bag_opens_at_its_pressure() {
    let mut random = Random::new(12);
    let (mut worst, mut opened) = ([0.0_f64; 4], 0);
    for _ in 0..20 {
        let r = &mut random;
        let speed_m_s = r.between(2.0, 8.0);
        let bag = GasBag {
            mass_kg: r.between(3.0, 30.0),
            above_m: 0.016 * speed_m_s + r.between(0.0, 0.1),
            speed_m_s,
            gravity_m_s2: r.between(0.0, 9.81),
            radius_m: r.between(0.2, 0.28),
            flow_kg_s: [r.between(0.5, 2.5), r.between(0.5, 2.5)],
            hole_m2: r.between(5e-4, 4e-3),
            opens_at_pa: r.between(2e3, 40e3),
            leak_m2: r.between(1e-5, 5e-4),
            end_s: 0.06,
        };
        let ([z, gauge, way, most], opened_s) = bag.expected();
        opened += u32::from(opened_s.is_some());
        for ((integrator, _), worst) in INTEGRATORS.iter().zip(&mut worst) {
            let (mut at, mut pressure) = (f64::NAN, f64::NAN);
            let watch = Watch(|s: &Sample<'_>| (at, pressure) = (s.sphere_centre_m(0).z, s.actions.bags[0].pressure));
            assert_eq!(simulate(&bag.model(&[integrator]), watch).unwrap().status, Status::Completed);
            *worst = worst.max((at - z).abs() / way).max((pressure - gauge).abs() / most);
        }
    }
    assert!(opened >= 15, "{opened}");
    for ((integrator, bound), worst) in INTEGRATORS.iter().zip(worst) {
        assert_below(integrator, worst, *bound);
    }
}
