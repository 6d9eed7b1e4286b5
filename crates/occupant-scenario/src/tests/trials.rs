//! A body on a rope, falling: rings, a limiter, and a spool that locks, against closed forms.

use super::belts::changed;

use nalgebra::Vector3;
use occupant_core::forces::chain::StrapAction;
use occupant_core::model::Model;
use occupant_core::results::outcome::Status;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;

const G: f64 = 9.806_65;

/// A limp body that falls upright from rest at T1 = 0.
fn fall(changes: &[&str]) -> Model {
    let zeros = vec!["0"; 31].join(", ");
    let text = format!(
        "title = \"A weight on a rope\"\ntime = {{ end = 0.3 }}\noutput = {{ interval = \"0.1 ms\" }}\npath = {{ kind = \"fixed\" }}\n\
         integrator = {{ kind = \"rk4\", step = \"0.1 ms\" }}\nbody = {{ preset = \"male50\" }}\njoints = {{ preset = \"male50\" }}\n\
         initial_state = {{ q = [{zeros}], rates = [{zeros}] }}\n[webbings.rope]\nstrain = [0, 0.1]\nforce = [0, \"20 kN\"]\n"
    );
    changed(&text, changes).unwrap_or_else(|said| panic!("{said}")).0
}

/// Nodes of a rope to the upper torso, and the rest of the belt's keys.
fn rope(nodes: &str, keys: &str) -> String {
    format!(
        "belts.rope={{ webbing = \"rope\", nodes = [{nodes}, {{ name = \"weight\", on = \"upper_torso\", at = [0, 0, 0.3] }}]{keys} }}"
    )
}

/// Runs a case; `look` sees time, straps, and the body's momentum downward, kg·m/s.
fn run(model: &Model, mut look: impl FnMut(f64, &[StrapAction<f64>], f64)) {
    let body = model.body();
    let watch = Watch(|s: &Sample<'_>| {
        let k = &s.evaluation.kinematics;
        // in space Z is up
        let down =
            |segment| -body.segment(segment).mass_kg * k.cg_velocity(&model.system().skeleton, segment.index()).z;
        look(s.time_s, &s.actions.chains, body.tree.segments().map(down).sum());
    });
    let outcome = simulate(model, watch).unwrap();
    assert_eq!(outcome.status, Status::Completed);
    assert!(outcome.energy.balance_error < 1e-5, "{}", outcome.energy.balance_error);
}

/// A rope over two rings that slides towards the weight has e^(μ₁θ₁ + μ₂θ₂) times the tension there, θ by where the rings are.
#[test]
fn a_weight_on_a_rope_over_two_rings_is_held_by_a_capstan() {
    for (mu, slack, far) in [([0.1, 0.2], 0.02, 0.8), ([0.35, 0.05], 0.1, 0.4), ([0.25, 0.5], 0.0, 1.2)] {
        let nodes = format!(
            "{{ name = \"a\", at = [{far}, 0, 0.3] }}, {{ name = \"b\", at = [{far}, 0, -1], friction = {} }}, \
             {{ name = \"c\", at = [0, 0, -1], friction = {} }}",
            mu[0], mu[1]
        );
        let (mut most, mut ratio) = (0.0, 0.0);
        run(&fall(&[&rope(&nodes, &format!(", slack = {slack}"))]), |_, straps, _| {
            if straps[2].force > most {
                let ends: Vec<Vector3<f64>> = straps.iter().map(|strap| strap.ends[1].to_vector()).collect();
                let down = (ends[2] - ends[1]).normalize();
                // from down to level, and from level to the weight
                let turns = [std::f64::consts::FRAC_PI_2, Vector3::x().dot(&-down).acos()];
                most = straps[2].force;
                ratio = (most / straps[0].force).ln() / (mu[0] * turns[0] + mu[1] * turns[1]);
            }
        });
        // measured: 2e-11
        assert!(most > 700.0 && (ratio - 1.0).abs() < 1e-9, "{mu:?}: {most} {ratio}");
    }
}

/// On its plateau, a limiter decelerates the whole body by F − m g, for any motion of its limbs, and absorbs its stroke times F.
#[test]
fn a_limiter_pulled_by_a_falling_body_takes_its_level_from_the_momentum() {
    for (level, slack) in [(1500.0, 0.1), (2500.0, 0.3), (4000.0, 0.05)] {
        let limiter = format!("limiters.bar={{ payout = [0, 0.01, 2], force = [0, {level}, {level}] }}");
        let keys = format!(", slack = {slack}, limiter = \"bar\"");
        let model = fall(&[&limiter, &rope("{ name = \"a\", at = [0, 0, -1] }", &keys)]);
        let weight = G * model.body().mass_kg();
        let (mut last, mut steps): (Option<(f64, f64, f64)>, _) = (None, 0);
        run(&model, |time, straps, momentum| {
            let strap = &straps[0];
            let [from, to] = strap.ends.map(|end| end.to_vector());
            let up = strap.force * (to - from).normalize().z;
            if strap.force == level
                && let Some((before, was, pulled)) = last
            {
                let gained = momentum - was - (time - before) * (weight - 0.5 * (up + pulled));
                // measured: 1e-9 of the momentum
                assert!(gained.abs() < 1e-6 * weight * (time - before), "{time}: {gained}");
                steps += 1;
            }
            last = (strap.force == level).then_some((time, momentum, up));
        });
        assert!(steps > 50, "{level}: {steps}");
    }
}

/// An open retractor pays out as the body falls from rest, ½ g t², and locks at the given payout.
#[test]
fn a_spool_locks_where_so_much_webbing_has_left_it() {
    for (payout, more) in [(0.05, 0.0), (0.12, 0.02), (0.3, 0.0)] {
        let trigger = format!("triggers.out={{ kind = \"payout\", threshold = {payout} }}");
        let reel = format!(
            "retractors.reel={{ on_spool = 2, spool_tension = 0.1, lock = {{ trigger = \"out\", payout = {more} }} }}"
        );
        let model = fall(&[&trigger, &reel, &rope("{ name = \"a\", at = [0, 0, -1], retractor = \"reel\" }", "")]);
        let (mut locked, mut after, mut length) = (None, Vec::new(), (0.0, 0.0));
        run(&model, |time, straps, _| {
            if time == 0.0 {
                length.0 = straps[0].length;
            }
            length.1 = f64::max(length.1, straps[0].length);
            match locked {
                None if straps[0].phase == 4.0 => locked = Some((time, straps[0].fed)),
                Some(_) => after.push(straps[0].fed),
                None => {}
            }
        });
        let (time, out) = locked.unwrap();
        let expected = (2.0 * (payout + more) / G).sqrt();
        // the spool's 0.1 N and a step of 0.1 ms
        assert!((time - expected).abs() < 2e-3 * expected + 1e-4, "{payout}: {time} {expected}");
        assert!(out >= payout + more && out < payout + more + 2e-4 * G * time * 1.1, "{payout}: {out}");
        assert!(after.len() > 100 && after.iter().all(|fed| (fed - out).abs() < 1e-12), "{payout}");
        assert!(length.1 > length.0 + out, "{length:?} {out}");
    }
}
