//! Belts over several nodes: what is wrong with them, what a preset comes to, and runs with them.

use super::*;
use crate::Draft;
use nalgebra::Vector3;
use occupant_core::forces::chain::{Chain, Site};
use occupant_core::model::Model;
use occupant_core::results::outcome::{Outcome, Status};
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::simulate::{resume, simulate};

const DRIVER: &str = include_str!("../../testdata/hand/three-point.toml");

/// A scenario with these changes, or its messages.
pub(super) fn changed(text: &str, changes: &[&str]) -> Result<(Model, String), String> {
    let mut draft = Draft::read(text, Format::Toml, "test").unwrap();
    changes.iter().for_each(|change| draft.set(change).unwrap());
    let built = draft.load(&no_files).and_then(|scenario| scenario.model());
    built.map(|(model, warnings)| (model, warnings.to_string())).map_err(|problems| problems.to_string())
}

fn driver(changes: &[&str]) -> Model {
    changed(DRIVER, changes).unwrap_or_else(|said| panic!("{said}")).0
}

const BELT: &str = "belts.b={ webbing = \"w\", nodes = [{ name = \"a\", at = [-0.4, -0.3, -0.6] }, { sphere = \"chest\" }, \
                    { name = \"c\", at = [-0.1, 0.2, 0.1], friction = 0.2 }, { sphere = \"pelvis\" }, { name = \"e\", at = [-0.15, -0.25, 0.23] }] }";
const WEBBING: &str = "webbings.w={ strain = [0, 0.05, 0.1], force = [0, 4000, 12000], returned = 0.6 }";

#[test]
fn what_is_wrong_with_belts_is_said_at_its_place() {
    let reel = "retractors.r={ lock = { trigger = \"go\" } }";
    let go = "triggers.go={ kind = \"time\", at = 0.01 }";
    for (changes, expected) in [
        (&[BELT][..], "no webbing is named \"w\""),
        (&[WEBBING, BELT, "belts.b.k1=5e4"], "`k1` without `anchors`"),
        (&[WEBBING, BELT, "belts.b.webbing=\"v\""], "no webbing is named \"v\""),
        (&[WEBBING, BELT, "belts.lap.nodes=[]"], "together"),
        (&[WEBBING, BELT, "belts.b.nodes[1].sphere=\"chset\""], "did you mean \"chest\"?"),
        (
            &[WEBBING, BELT, "belts.b.nodes[2]={ sphere = \"left_shoulder\" }", "belts.b.nodes[1].friction=0.2"],
            "friction on a sphere beside a sphere",
        ),
        (&[WEBBING, BELT, "belts.b.nodes[2]={ sphere = \"left_shoulder\" }"], "between the planes of webbing"),
        (&[WEBBING, BELT, "belts.b.nodes[2].friction=0.9"], "0.1 to 0.6"),
        (&[WEBBING, BELT, "belts.b.nodes[2].retractor=\"r\"", go, reel], "reverse the order of the nodes"),
        (
            &[WEBBING, BELT, "belts.b.nodes[0].retractor=\"r\"", go, reel, "belts.b.slack=0.1"],
            "`slack` with a retractor",
        ),
        (&[WEBBING, BELT, "belts.b.nodes[2].on=\"upper_torse\""], "did you mean \"upper_torso\"?"),
        (&[WEBBING, BELT, "webbings.w.force=[0, 4000]"], "the same number in both"),
        (&[WEBBING, BELT, "webbings.w.force=[0, 4000, 4000]"], "forces that rise from point to point"),
        (
            &[WEBBING, BELT, "limiters.l={ payout = [0, 0.1, 0.2], force = [0, 4000, 3000] }", "belts.b.limiter=\"l\""],
            "a force that falls needs a second limiter",
        ),
        (&[WEBBING, BELT, "belts.b.pretension=500"], "a tension of 500 N at the start"),
        (&[WEBBING, BELT, "belts.b.nodes[4].at=[-0.05, 0, 0]"], "outside the sphere beside it"),
        (
            &[go, "triggers.a={ kind = \"any\", of = [\"b\"] }", "triggers.b={ kind = \"all\", of = [\"a\"] }"],
            "in a loop",
        ),
        (
            &[
                "triggers.p={ kind = \"payout\", threshold = 0.1 }",
                "muscles.neck={ trigger = \"p\", rise = 0.03, stiffness = 3 }",
            ],
            "a trigger on a belt",
        ),
        (&["belts.lap.k1=5e4", "belts.lap.k2=4e4", "belts.lap.delta_b=0.01"], "softer than k1"),
    ] {
        let said = match changed(SHORT, changes) {
            Ok((_, warnings)) => warnings,
            Err(said) => said,
        };
        assert!(said.contains(expected), "{changes:?}: {said}");
    }
    assert!(changed(SHORT, &[WEBBING, BELT]).unwrap().1.is_empty());
}

/// Every number of a belt can be swept: a change of it is one of the data.
#[test]
fn numbers_of_belts_come_to_their_data() {
    let chain = |set: &[&str]| driver(set).setup().chains[0].clone();
    let plain = chain(&[]);
    assert_eq!(
        plain.straps,
        ["driver.reel_d_ring", "driver.d_ring_shoulder", "driver.shoulder_buckle", "driver.buckle_sill"]
    );
    for change in [
        "limiters.torsion_bar.force[1]=3000",
        "limiters.torsion_bar.payout[1]=0.02",
        "retractors.driver.on_spool=0.7",
        "retractors.driver.spool_tension=8",
        "retractors.driver.lock.payout=0.01",
        "retractors.driver.pretensioner.pull[1]=0.08",
        "retractors.driver.pretensioner.stall_force=1500",
        "retractors.driver.pretensioner.delay=0.005",
        "triggers.sensor.threshold=\"0.6 g\"",
        "seats.driver.y=-0.36",
        "belts.driver.strength=9000",
    ] {
        assert_ne!(chain(&[change]), plain, "{change}");
    }
}

/// Results of a run of the driver.
#[derive(Default)]
struct Seen {
    peaks_n: Vec<f64>,
    payout_m: f64,
    pull_in_m: f64,
    ahead_m: f64,
    balance: f64,
    driven_j: f64,
    book_error: f64,
    /// Natural logarithm of the ratio of tensions over the upper ring and the angle there, where the spool pulls most.
    ring: [f64; 2],
}

fn seen(model: &Model) -> Seen {
    let mut seen = Seen::default();
    let chest = model.body().sphere("chest").unwrap();
    let mut start = None;
    let outcome = simulate(
        model,
        Watch(|s: &Sample<'_>| {
            let straps = &s.actions.chains;
            seen.peaks_n.resize(straps.len(), 0.0);
            if straps[0].force > seen.peaks_n[0] {
                seen.ring = [(straps[1].force / straps[0].force).ln(), straps[1].turn];
            }
            for (peak, strap) in seen.peaks_n.iter_mut().zip(straps) {
                *peak = peak.max(strap.force);
            }
            seen.payout_m = seen.payout_m.max(straps[0].fed);
            seen.pull_in_m = seen.pull_in_m.max(-straps[0].fed);
            let x = s.sphere_centre_m(chest).x;
            seen.ahead_m = seen.ahead_m.max(x - *start.get_or_insert(x));
            seen.driven_j = straps[0].driven;
            let books: f64 = straps.iter().map(|strap| strap.lost).sum();
            let lost_j = s.energy.lost_j[occupant_core::forces::belt::STRETCH];
            seen.book_error = (books / lost_j - 1.0).abs();
        }),
    )
    .unwrap();
    assert_eq!(outcome.status, Status::Completed, "{outcome:?}");
    seen.balance = outcome.energy.balance_error;
    seen
}

#[test]
fn a_limiter_trades_force_for_excursion_and_a_pretensioner_gives_some_back() {
    let rk4 = "integrator={ kind = \"rk4\", step = \"0.1 ms\" }";
    let plain = [rk4, "retractors.driver={ lock = { trigger = \"sensor\" } }"];
    let limited = [rk4, "retractors.driver={ lock = { trigger = \"sensor\" }, limiter = \"torsion_bar\" }"];
    let [all, limited, plain] = [&[rk4][..], &limited, &plain].map(|set| seen(&driver(set)));
    for run in [&all, &limited, &plain] {
        // measured: 1.5e-6 to 1.7e-6
        assert!(run.balance < 1e-5, "{}", run.balance);
        assert!(run.book_error < 0.01, "{}", run.book_error);
    }
    // measured: 4000, 4000, 11834 N at the spool; 285, 310, 158 mm of the chest; 50 mm of the pretensioner
    let peaks = [&all, &limited, &plain].map(|run| run.peaks_n[0]);
    assert!(peaks[0] < 4000.1 && peaks[1] < 4000.1 && peaks[2] > 8000.0, "{peaks:?}");
    assert!(limited.ahead_m > plain.ahead_m + 0.03, "{} {}", limited.ahead_m, plain.ahead_m);
    assert!(all.ahead_m < limited.ahead_m, "{} {}", all.ahead_m, limited.ahead_m);
    assert!(all.pull_in_m > 0.01 && all.driven_j > 5.0, "{} {}", all.pull_in_m, all.driven_j);
    // webbing slides over the upper ring where the spool pulls most: e^(μθ) with μ = 0.1
    let [ratio, turn] = limited.ring;
    assert!((ratio / (0.1 * turn) - 1.0).abs() < 1e-6 && turn > 1.0, "{ratio} {turn}");
}

#[test]
fn a_driver_on_the_right_is_the_mirror_image() {
    let left = ["time.end=0.06", "integrator={ kind = \"rk4\", step = \"0.1 ms\" }"];
    let places = ["seats.driver.y", "solids.seat_foam.y", "solids.seat_pan.y", "solids.seat_back.y"];
    let mut right: Vec<String> = left.map(str::to_owned).into();
    right.extend(places.map(|place| format!("{place}=0.35")));
    right.extend(["solids.wheel_rim.centre[1]=0.35", "solids.wheel_hub.centre[1]=0.35"].map(str::to_owned));
    right.push("belts.driver.side=\"right\"".to_owned());
    let right: Vec<&str> = right.iter().map(String::as_str).collect();
    let [left, right] = [&left[..], &right].map(|set| seen(&driver(set)));
    for (a, b) in left.peaks_n.iter().zip(&right.peaks_n) {
        assert!((a / b - 1.0).abs() < 1e-6, "{a} {b}");
    }
}

/// Everything of every output as text, which shows every bit.
fn texts(list: &mut Vec<String>) -> impl FnMut(&Sample<'_>) + use<'_> {
    |s| list.push(format!("{:?} {:?} {:?}", s.checkpoint(), s.evaluation, s.actions.chains))
}

#[test]
fn a_run_resumed_in_any_phase_of_a_belt_has_the_bits_of_the_whole() {
    for integrator in ["{ kind = \"rk4\", step = \"0.2 ms\" }", "{ kind = \"adaptive\" }"] {
        let model = driver(&["time.end=0.05", &format!("integrator={integrator}")]);
        let (mut whole, mut checkpoints, mut phases) = (Vec::new(), Vec::new(), Vec::new());
        let outcome: Outcome = {
            let mut text = texts(&mut whole);
            let recorder = Watch(|s: &Sample<'_>| {
                text(s);
                checkpoints.push(s.checkpoint());
                phases.push(s.actions.chains[0].phase);
            });
            simulate(&model, recorder).unwrap()
        };
        for phase in [1.0, 3.0, 4.0] {
            let at = phases
                .iter()
                .position(|found| *found == phase)
                .unwrap_or_else(|| panic!("no phase {phase}: {phases:?}"));
            let mut rest = Vec::new();
            let resumed = resume(&model, &checkpoints[at], Watch(texts(&mut rest))).unwrap();
            assert!(rest[..] == whole[at..], "{integrator}, phase {phase}");
            assert_eq!(resumed, outcome);
        }
    }
}

#[test]
fn a_preset_lies_on_a_track_over_the_shoulder() {
    let model = driver(&[]);
    let [chain]: &[Chain; 1] = model.setup().chains[..].try_into().unwrap();
    assert!(matches!(chain.nodes[2].site, Site::Track(..)));
    // anchors round the pelvis of the seated body: the upper ring highest, the sill's anchor lowest
    let pelvis = model.start().seated.as_ref().unwrap().pelvis_m;
    let fixed = chain.nodes.iter().filter_map(|node| match node.site {
        Site::Vehicle(point, _) => Some(point.coords - pelvis),
        _ => None,
    });
    let fixed: Vec<Vector3<f64>> = fixed.collect();
    assert_eq!(fixed.len(), 4);
    let expected = [[-0.40, -0.27, 0.12], [-0.40, -0.27, -0.64], [-0.06, 0.19, 0.04], [-0.12, -0.25, 0.20]];
    for (from, expected) in fixed.iter().zip(expected.map(Vector3::from)) {
        assert!((from - expected).norm() < 0.05, "{from} {expected}");
    }
}

/// What is drawn is as long as the webbing: arcs are drawn as chords of 0.15 rad at most. On the shoulder it stays throughout.
#[test]
fn straps_are_drawn_as_long_as_they_are() {
    let model = driver(&["time.end=0.1", "output.interval=\"10 ms\""]);
    let mut arcs = 0;
    let look = |s: &Sample<'_>| {
        for (line, strap) in s.lines().iter().zip(&s.actions.chains) {
            let drawn: f64 = line.points_m.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
            let (name, length) = (&line.name, strap.length);
            assert!(length > 0.1 && drawn <= length + 1e-9 && drawn > length - 3e-3, "{name}: {drawn} {length}");
            assert_eq!(line.force_n, strap.force);
            arcs += line.points_m.len() - 2;
        }
    };
    simulate(&model, Watch(look)).unwrap();
    assert!(arcs > 50, "{arcs} points of arcs");
}

/// A run reports the locking of its retractor and the firing of its pretensioner at the first output after them.
#[test]
fn a_summary_tells_what_happens_to_a_belt() {
    let mut summarizer = Summarizer::new();
    simulate(&driver(&["time.end=0.05"]), &mut summarizer).unwrap();
    let events = summarizer.summary(None).unwrap().events;
    let time = |what: &str| {
        let own = events.iter().find(|event| event.name == "driver.reel_d_ring" && event.what == what);
        own.unwrap_or_else(|| panic!("{what}: {events:?}")).time_s
    };
    let [pulled, locked] = [time("is pulled in by its pretensioner"), time("locks")];
    assert!(0.0 < pulled && pulled < locked && locked < 0.03, "{events:?}");
    assert!(events.is_sorted_by_key(|event| event.time_s));
}

/// A belt without a wearer is omitted, whether a loop or a belt over nodes.
#[test]
fn a_belt_that_is_not_worn_is_not_there() {
    assert_eq!(build(SHORT).belts.len(), 1);
    let off = SHORT.replace("[belts.lap]\n", "[belts.lap]\nworn = false\n");
    assert!(build(&off).belts.is_empty());
    let worn = SHORT.replace("[belts.lap]\n", "[belts.lap]\nworn = true\n");
    assert_eq!(build(&worn).belts.len(), 1);
    let draft = include_str!("../../testdata/hand/three-point.toml");
    let name = draft.lines().find_map(|line| line.strip_prefix("[belts.")?.strip_suffix(']')).unwrap();
    assert!(!build(draft).chains.is_empty());
    let off = draft.replacen(&format!("[belts.{name}]\n"), &format!("[belts.{name}]\nworn = false\n"), 1);
    assert!(build(&off).chains.is_empty(), "{name}");
}
