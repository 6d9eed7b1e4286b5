//! Devices of belts in runs: closed forms, and their books against the ledger.

use super::belts::changed;
use super::*;
use nalgebra::Vector3;
use occupant_core::forces::belt::STRETCH;
use occupant_core::forces::chain::StrapAction;
use occupant_core::model::Model;
use occupant_core::results::outcome::{Status, StepError};
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::batch::{Job, Kernel, simulate_many};
use occupant_core::run::simulate::attempt;
use std::ops::ControlFlow;

const WEBBING: &str = "webbings.w={ strain = [0, 0.05, 0.1], force = [0, 4000, 12000], returned = 0.6 }";

/// The sled with a belt over chest and pelvis, and these changes.
fn belted(changes: &[&str]) -> Model {
    let belt = "belts.b={ webbing = \"w\", nodes = [{ name = \"a\", at = [-0.4, -0.3, -0.6] }, { sphere = \"chest\" }, \
                { name = \"c\", at = [-0.1, 0.2, 0.1], friction = 0.2 }, { sphere = \"pelvis\" }, { name = \"e\", at = [-0.15, -0.25, 0.23] }] }";
    let rk4 = "integrator={ kind = \"rk4\", step = \"0.1 ms\" }";
    let all = [&["belts.lap=null", WEBBING, belt, rk4], changes].concat();
    changed(SHORT, &all).unwrap_or_else(|said| panic!("{said}")).0
}

/// Runs a case; `look` sees time and straps of every output. The ledger must balance, and what straps book as lost must be what
/// it says, to 1 %.
fn run(model: &Model, mut look: impl FnMut(f64, &[StrapAction<f64>])) {
    let (mut booked, mut lost, mut greatest) = (0.0, 0.0, 0.0_f64);
    let outcome = attempt(
        model,
        Watch(|s: &Sample<'_>| {
            let straps = &s.actions.chains;
            look(s.time_s, straps);
            booked = straps.iter().map(|strap| strap.lost).sum();
            lost = s.energy.lost_j[STRETCH];
            greatest = greatest.max(lost + straps.iter().map(|strap| strap.stored).sum::<f64>());
        }),
    )
    .unwrap();
    assert_eq!(outcome.status, Status::Completed);
    assert!(outcome.energy.balance_error < 1e-5, "{}", outcome.energy.balance_error);
    assert!((booked - lost).abs() < 0.01 * greatest, "{booked} {lost} of {greatest}");
}

#[test]
fn webbing_does_not_pass_a_tie() {
    let model = belted(&["belts.b.nodes[2].tie=true", "belts.b.nodes[2].friction=0"]);
    let names: Vec<&str> = model.setup().chains.iter().flat_map(|chain| &chain.straps).map(String::as_str).collect();
    assert_eq!(names, ["b.a_c", "b.c_e"]);
    let (mut first, mut peaks) = ([0.0; 2], [0.0_f64; 2]);
    run(&model, |time, straps| {
        let own: [f64; 2] = std::array::from_fn(|i| straps[i].unstretched);
        if time == 0.0 {
            first = own;
        }
        for i in 0..2 {
            assert!((own[i] - first[i]).abs() < 1e-12, "{own:?} {first:?}");
            peaks[i] = peaks[i].max(straps[i].force);
        }
    });
    assert!(peaks[0] > 500.0 && peaks[1] > 500.0 && (peaks[0] / peaks[1] - 1.0).abs() > 0.05, "{peaks:?}");
}

/// A broken ring joins both straps; torn webbing and a released belt carry no force.
#[test]
fn what_breaks_or_is_released_is_lost_with_its_energy() {
    let peak = |changes: &[&str]| {
        let mut most = 0.0_f64;
        run(&belted(changes), |_, straps| most = most.max(straps[0].force));
        most
    };
    let whole = peak(&[]);
    assert!(whole > 2500.0, "{whole}");
    let mut after = Vec::new();
    run(&belted(&["belts.b.nodes[2].strength=2000"]), |_, straps| {
        if straps[1].passes == 0.0 {
            after.push((straps[0].force, straps[1].force, straps[1].node_force.to_vector().norm()));
        }
    });
    assert!(after.len() > 10);
    for (one, other, ring) in after {
        assert!((one - other).abs() <= 1e-9 * one && ring == 0.0, "{one} {other} {ring}");
    }
    for end in ["belts.b.strength=2000", "belts.b.release=\"out\""] {
        let (mut most, mut last) = (0.0_f64, 1.0);
        run(&belted(&["triggers.out={ kind = \"time\", at = 0.06 }", end]), |_, straps| {
            most = most.max(straps[0].force);
            last = straps.iter().map(|strap| strap.force).sum();
        });
        assert!(most < whole && most > 1000.0 && last == 0.0, "{end}: {most} {last}");
    }
}

/// A guide on the chest holds webbing that presses on it and releases webbing that pulls away.
#[test]
fn a_guide_with_a_normal_lets_go_of_what_pulls_away() {
    for (normal, holds) in [("[1, 0, 0]", true), ("[-1, 0, 0]", false)] {
        let guide = format!(
            "belts.b.nodes[1]={{ name = \"g\", on = \"upper_torso\", at = [0.12, 0, 0.2], normal = {normal}, friction = 0.2 }}"
        );
        let mut last = Vec::new();
        run(&belted(&[&guide, "belts.b.pretension=50"]), |_, straps| {
            last = straps.iter().map(|strap| strap.passes).collect();
        });
        assert_eq!(last, [1.0, if holds { 1.0 } else { 0.0 }, 1.0], "{normal}");
    }
}

/// A pretensioner moves its node along its direction by its table until the belt's force against it stops it for good; its work
/// is its force times its way.
#[test]
fn a_pulled_buckle_goes_its_way_until_it_stalls() {
    let pull = |stall: &str| {
        format!(
            "belts.b.nodes[2].pretensioner={{ trigger = \"fire\", delay = 0.002, direction = [-0.6, 0, 0.8], times = [0, 0.01, 0.02], \
             pull = [0, 0.03, 0.05]{stall} }}"
        )
    };
    let fire = "triggers.fire={ kind = \"time\", at = 0.01 }";
    let ways = |stall: &str| {
        let (mut list, mut driven) = (Vec::new(), 0.0);
        let mut start = Vector3::zeros();
        run(&belted(&[fire, &pull(stall)]), |time, straps| {
            let at = straps[1].ends[0].to_vector();
            if time == 0.0 {
                start = at;
            }
            let moved = at - start;
            assert!(moved.cross(&Vector3::new(-0.6, 0.0, 0.8)).norm() < 1e-12);
            list.push((time, moved.norm()));
            driven = straps[0].driven;
        });
        (list, driven)
    };
    let (free, work) = ways("");
    for (time, way) in free {
        let age = time - 0.012;
        let expected = if age < 0.0 {
            0.0
        } else if age < 0.01 {
            3.0 * age
        } else {
            (0.03 + 2.0 * (age - 0.01)).min(0.05)
        };
        assert!((way - expected).abs() < 1e-12, "{time}: {way} {expected}");
    }
    assert!(work > 1.0, "{work}");
    let (stalled, less) = ways(", stall_force = 2000");
    let end = stalled.last().unwrap().1;
    assert!(end > 0.002 && end < 0.05 && less < work && less > 0.0, "{end} {less} {work}");
    assert!(stalled.iter().filter(|(time, _)| *time > 0.04).all(|(_, way)| *way == end));
}

/// Of a half sine the change of speed is ½Δv(1 − cos πt/T), counted from where its acceleration rose above `wake`.
#[test]
fn triggers_by_change_of_speed_and_groups_fire_at_their_closed_times() {
    let triggers = [
        "triggers.dv={ kind = \"delta_v\", threshold = \"10 km/h\", wake = \"1 g\" }",
        "triggers.early={ kind = \"time\", at = 0.02 }",
        "triggers.one={ kind = \"any\", of = [\"dv\", \"early\"] }",
        "triggers.both={ kind = \"all\", of = [\"dv\", \"early\"] }",
    ];
    let due = |name: &str| {
        let release = format!("belts.b.release={name:?}");
        belted(&[&triggers[..], &[&release]].concat()).setup().chains[0].release.due_s
    };
    let (change, length) = (30.0 / 3.6, 0.1);
    let peak = change * std::f64::consts::PI / (2.0 * length);
    let wakes = length / std::f64::consts::PI * (9.80665 / peak).asin();
    let speed = |t: f64| 0.5 * change * (1.0 - (std::f64::consts::PI * t / length).cos());
    let target = speed(wakes) + 10.0 / 3.6;
    let expected = length / std::f64::consts::PI * (1.0 - 2.0 * target / change).acos();
    // measured: 1e-7 s
    assert!((due("dv") - expected).abs() < 2e-5, "{} {expected}", due("dv"));
    assert_eq!((due("one"), due("both")), (0.02, due("dv")));
}

/// Webbing that rubs on chest and pelvis: nowhere a greater ratio of tensions than that of a capstan, that ratio where most is
/// lost, and the forces on the body are those of its lengths.
#[test]
fn webbing_rubs_on_spheres_as_over_a_capstan() {
    let rough = ["belts.b.nodes[1].friction=0.3", "belts.b.nodes[3].friction=0.2", "webbings.w.returned=1"];
    // beside the belt, one from the hip up, and one that the shoulder's turning winds over the chest
    for more in ["", "belts.b.nodes[2].at=[-0.1, 0.2, -0.3]", "belts.b.nodes[0].at=[-0.1, -0.5, -0.5]"] {
        let set: Vec<&str> = rough.into_iter().chain([more]).filter(|set| !set.is_empty()).collect();
        let model = belted(&set);
        assert_eq!(model.setup().chains[0].straps, ["b.a_chest", "b.chest_c", "b.c_pelvis", "b.pelvis_e"]);
        let (mut slides, mut lost) = (0, 0.0);
        run(&model, |_, straps| {
            for (i, mu) in [(1, 0.3), (2, 0.2), (3, 0.2)] {
                let (before, own) = (&straps[i - 1], &straps[i]);
                if own.force > 100.0 {
                    let share = (own.force / before.force).ln().abs() / (mu * own.turn);
                    assert!(share < 1.0 + 1e-9, "{i}: {} {}", own.force, before.force);
                    slides += usize::from(i == 1 && share > 1.0 - 1e-9);
                }
            }
            lost = straps[1].lost;
        });
        assert!(slides > 20 && lost > 5.0, "{more}: {slides} {lost}");
    }
}

/// A belt with its nodes in reverse order is the same belt.
#[test]
fn the_order_of_nodes_does_not_matter() {
    let straps = |nodes: [&str; 5]| {
        let belt = format!("belts.b={{ webbing = \"w\", nodes = [{}] }}", nodes.join(", "));
        let mut list = Vec::new();
        run(&belted(&[&belt, "time.end=0.1"]), |_, straps| {
            list.push(straps.iter().map(|s| [s.force, s.length, s.unstretched]).collect::<Vec<_>>());
        });
        list
    };
    let mut nodes = [
        "{ name = \"a\", at = [-0.4, -0.3, -0.6] }",
        "{ sphere = \"chest\", friction = 0.3 }",
        "{ name = \"c\", at = [-0.1, 0.2, 0.1], friction = 0.2 }",
        "{ sphere = \"pelvis\", friction = 0.2 }",
        "{ name = \"e\", at = [-0.15, -0.25, 0.23] }",
    ];
    let one = straps(nodes);
    nodes.reverse();
    let other = straps(nodes);
    for (one, other) in one.iter().zip(&other) {
        for (a, b) in one.iter().flatten().zip(other.iter().rev().flatten()) {
            assert!((a - b).abs() < 1e-6 * (1.0 + a.abs()), "{one:?} {other:?}");
        }
    }
}

/// Curves exceeded in a run: of webbing, of its limiter, of the cushion.
const SHORT_CURVES: [(&str, &str, &str); 3] = [
    (
        "webbings.w={ strain = [0, 0.03], force = [0, 3000]BEYOND }",
        "the webbing of the belt b went to 3.",
        "b.a_c_stretched",
    ),
    (
        "limiters.l={ payout = [0, 0.01, 0.03], force = [0, 2000, 2000]BEYOND }",
        "the limiter of the belt b went to 30.",
        "b_limiter_bottomed",
    ),
    (
        "materials.foam={ depth = [0, 0.03], force = [0, 900], friction = 0.8BEYOND }",
        "a sphere in ",
        "pelvis_beyond_curve",
    ),
];

/// The sled with a curve of webbing, limiter or foam that ends early.
fn short_curved(curve: &str, beyond: &str, integrator: &str) -> Model {
    let integrator = format!("integrator={integrator}");
    let mut set = vec![curve.replace("BEYOND", beyond), integrator];
    if curve.starts_with("limiters") {
        set.push("belts.b.limiter=\"l\"".to_owned());
    }
    belted(&set.iter().map(String::as_str).collect::<Vec<_>>())
}

const INTEGRATORS: [&str; 2] = ["{ kind = \"rk4\", step = \"0.1 ms\" }", "{ kind = \"adaptive\" }"];

#[test]
fn a_run_ends_where_a_curve_is_not_known_further() {
    for (curve, why, caveat) in SHORT_CURVES {
        for integrator in INTEGRATORS {
            let mut summarizer = Summarizer::new();
            let outcome = attempt(&short_curved(curve, ", beyond = \"limits\"", integrator), &mut summarizer).unwrap();
            let Status::Failed(StepError::Unsolved { why: said, time_s, .. }) = outcome.status else {
                panic!("{curve} {integrator}: {:?}", outcome.status)
            };
            assert!(said.contains(why) && time_s > 0.0, "{curve} {integrator}: {said}");
            assert!(summarizer.summary(None).unwrap().caveats.iter().any(|caveat| caveat.name == "run_failed"));
            // where the last line continues the run does too, with a caveat
            let outcome = attempt(&short_curved(curve, "", integrator), &mut summarizer).unwrap();
            assert_eq!(outcome.status, Status::Completed, "{curve}");
            let caveats = summarizer.summary(None).unwrap().caveats;
            assert!(caveats.iter().any(|found| found.name == caveat), "{caveat}: {caveats:?}");
        }
    }
}

/// Of runs side by side one ends where its webbing is not known further; the others go on, each with the bits that it has alone.
#[test]
fn a_run_that_ends_early_ends_alone_among_its_lanes() {
    let jobs = || {
        let model = |end: f64| {
            let most = 1e5 * end;
            let webbing = format!("webbings.w={{ strain = [0, {end}], force = [0, {most}], beyond = \"limits\" }}");
            belted(&[&webbing, "belts.b.nodes[1].friction=0.3", "belts.b.nodes[3].friction=0.2"])
        };
        [0.2, 0.02, 0.3, 0.25].map(model)
    };
    let alone = jobs().map(|model| attempt(&model, ()).unwrap());
    assert_eq!(alone.each_ref().map(|o| o.status == Status::Completed), [true, false, true, true], "{alone:?}");
    for kernel in [Kernel::Scalar, Kernel::Lanes4].into_iter().filter(|kernel| kernel.is_available()) {
        let jobs = (0..).zip(jobs()).map(|(tag, model)| Job { tag, model, recorder: () });
        let mut seen = 0;
        simulate_many(kernel, jobs, |ended| {
            assert_eq!(ended.outcome.as_ref().unwrap(), &alone[ended.tag], "{kernel:?}");
            seen += 1;
            ControlFlow::Continue(())
        });
        assert_eq!(seen, 4);
    }
}
