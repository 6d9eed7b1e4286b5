//! Panes: glass that breaks as a whole under the first segment that reaches its limit, against closed forms.

use occupant_core::model::Model;
use occupant_core::results::checkpoint::Checkpoint;
use occupant_core::results::outcome::{Outcome, Status};
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::{Summarizer, Summary};
use occupant_core::run::simulate::{resume, simulate};
use occupant_tests::measure::assert_below;
use occupant_tests::room::{ends_alike_side_by_side, setup};

/// An occupant who is far away, a pane 1 mm ahead of a ball, and one 11 mm ahead of another that comes 2.5 ms later.
const SPACE: &str = r#"
title = "two balls and a pane"
gravity = 0
time = { end = "12 ms" }
output = { interval = "0.1 ms" }
path = { kind = "fixed" }
contact = { bodies = [] }
body = { preset = "male50" }
joints = { preset = "male50" }
initial_state = { q = [900, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0], rates = [0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0] }

[materials.glass]
k1 = "1 MN/m"
mu1 = 1
friction = 0

[loose.one]
mass = 4
inertia = [0.1, 0.1, 0.1]
at = [-0.101, 0, 0]
velocity = [4, 0, 0]
spheres = { all = { centre = [0, 0, 0], radius = 0.1 } }

[loose.two]
mass = 3
inertia = [0.1, 0.1, 0.1]
at = [-0.111, 0.5, 0]
velocity = [4, 0, 0]
spheres = { all = { centre = [0, 0, 0], radius = 0.1 } }
"#;

const FACE: &str = "[surfaces.pane]\nframe = 'space'\nmaterial = 'glass'\n\
                    points = [[0, -1, -1], [0, 1, -1], [0, 1, 1], [0, -1, 1]]\ninside = [-1, 0, 0]\n";
const PLATE: &str =
    "[solids.pane]\nframe = 'space'\nkind = 'box'\nmaterial = 'glass'\ncentre = [0.1, 0, 0]\nlengths = [0.2, 2, 2]\n";
/// Two beside each other, which are one pane.
const HALVES: &str = "[solids.pane]\nframe = 'space'\nkind = 'box'\ngroup = 'g'\nmaterial = 'glass'\ncentre = [0.1, 0.75, 0]\n\
                      lengths = [0.2, 1, 2]\n\
                      [solids.rest]\nframe = 'space'\nkind = 'box'\ngroup = 'g'\nmaterial = 'glass'\ncentre = [0.1, -0.25, 0]\n\
                      lengths = [0.2, 1, 2]\n";
const SHAPES: [&str; 3] = [FACE, PLATE, HALVES];
const INTEGRATORS: [&str; 2] =
    ["integrator={ kind = \"rk4\", step = \"0.02 ms\" }", "integrator={ kind = \"adaptive\", relative = 1e-8 }"];
const FORCE: &str = "materials.glass.breaks.force=2 kN";
/// What is left bears 800 N from 4 mm on.
const LEFT: &str =
    "materials.glass.breaks={ force = \"2 kN\", depth = [0, \"4 mm\", \"1 m\"], left = [0, \"800 N\", \"800 N\"] }";
/// ½F²/k of a force of 2 kN, J.
const BREAKS_J: f64 = 2.0;

struct Ran {
    /// Velocities of both balls along x at the end, m/s.
    speeds: [f64; 2],
    /// Deepest of both, m.
    depths: [f64; 2],
    /// Energy that contacts have lost, J.
    lost_j: f64,
    summary: Summary,
    outcome: Outcome,
}

fn model(pane: &str, set: &[&str]) -> Model {
    Model::new(setup(&format!("{SPACE}{pane}"), set)).unwrap_or_else(|problems| panic!("{problems}"))
}

fn ran(pane: &str, set: &[&str]) -> Ran {
    let model = model(pane, set);
    let mut summarizer = Summarizer::new();
    let (mut speeds, mut depths, mut lost_j) = ([0.0; 2], [0.0_f64; 2], 0.0);
    let watch = Watch(|s: &Sample<'_>| {
        for i in 0..2 {
            let (place, velocity) = s.centre_of_body(i + 1);
            speeds[i] = velocity.x;
            depths[i] = depths[i].max(place.x + 0.1);
        }
        lost_j = s.energy.lost_j[occupant_core::forces::contact::PRESS];
    });
    let outcome = simulate(&model, (&mut summarizer, watch)).unwrap();
    assert_eq!(outcome.status, Status::Completed);
    Ran { speeds, depths, lost_j, summary: summarizer.summary(None).unwrap(), outcome }
}

/// When a ball of 4 kg that comes with 4 m/s from 1 mm away has pressed a spring of 1 MN/m with a force of 2 kN, s.
fn expected_s() -> f64 {
    let (k, m, v, force) = (1e6_f64, 4.0, 4.0, 2e3);
    1e-3 / v + (force / (k * m).sqrt() / v).asin() * (m / k).sqrt()
}

fn assert_near(what: &str, found: f64, expected: f64, within: f64) {
    assert_below(&format!("{what}: {found} for {expected}"), (found - expected).abs(), within);
}

#[test]
fn a_pane_breaks_under_the_first_ball_and_is_not_there_for_the_second() {
    for (pane, integrator) in SHAPES.iter().flat_map(|pane| INTEGRATORS.map(|integrator| (pane, integrator))) {
        for limit in [FORCE, "materials.glass.breaks.energy=2 J"] {
            let ran = ran(pane, &[integrator, limit]);
            // measured: 1.2e-5 m/s
            assert_near("one", ran.speeds[0], f64::sqrt(16.0 - 2.0 * BREAKS_J / 4.0), 2e-5);
            assert_eq!(ran.speeds[1], 4.0);
            // a contact begins with the step behind the touch: 1.9e-4 J with steps of 0.02 ms
            assert_near("lost", ran.lost_j, BREAKS_J, 5e-4);
            let [event] = &ran.summary.events[..] else { panic!("{:?}", ran.summary.events) };
            assert_eq!((&event.name[..], &event.what[..]), ("pane", "breaks under the one"));
            assert_near("time", event.time_s, expected_s(), 2e-7);
            assert_below("balance", ran.outcome.energy.balance_error, 1e-5);
        }
    }
}

#[test]
fn what_is_left_of_a_pane_acts_on_the_second_ball_from_its_surface_on() {
    for (pane, integrator) in SHAPES.iter().flat_map(|pane| INTEGRATORS.map(|integrator| (pane, integrator))) {
        let ran = ran(pane, &[integrator, LEFT, "time.end=40 ms", "output.interval=0.05 ms"]);
        // ½mv² = 800 N (d − 2 mm) of the second; of the first 2 J less, and what is left begins 2 mm deep
        let [one, two] = [(0.5 * 4.0 * 16.0 - BREAKS_J + 0.4) / 800.0, 0.5 * 3.0 * 16.0 / 800.0].map(|way| way + 2e-3);
        assert_near("one", ran.depths[0], one, 1e-5);
        assert_near("two", ran.depths[1], two, 1e-5);
        assert_eq!(ran.summary.events.len(), 1, "{:?}", ran.summary.events);
        assert_below("balance", ran.outcome.energy.balance_error, 1e-5);
    }
}

/// Below the limit nothing breaks; two spheres of a body press together, those of two bodies do not.
#[test]
fn spheres_of_one_segment_add_up_and_those_of_two_do_not() {
    let slow = "loose.one.velocity=[1, 0, 0]";
    let whole =
        ran(FACE, &[FORCE, slow, "loose.two.velocity=[1.1, 0, 0]", "loose.two.at=[-0.101, 0.5, 0]", "time.end=15 ms"]);
    assert!(whole.summary.events.is_empty() && whole.speeds[0] < -0.99, "{:?}", whole.speeds);
    // each takes half of the force, at half of the depth
    let two = "loose.one.spheres={ up = { centre = [0, 0, -0.3], radius = 0.1 }, down = { centre = [0, 0, 0.3], radius = 0.1 } }";
    let together = ran(PLATE, &[FORCE, two]);
    assert_near("one", together.speeds[0], f64::sqrt(16.0 - BREAKS_J / 4.0), 2e-5);
    assert_eq!(together.speeds[1], 4.0);
}

#[test]
fn a_pane_broken_or_whole_goes_on_from_any_output_with_the_same_bits() {
    for (pane, set) in [(FACE, FORCE), (PLATE, FORCE), (HALVES, LEFT), (FACE, LEFT)] {
        for integrator in INTEGRATORS {
            let model = model(pane, &[integrator, set]);
            let mut all: Vec<Checkpoint> = Vec::new();
            simulate(&model, Watch(|s: &Sample<'_>| all.push(s.checkpoint()))).unwrap();
            for (i, from) in all.iter().enumerate().step_by(4) {
                let mut again: Vec<Checkpoint> = Vec::new();
                resume(&model, from, Watch(|s: &Sample<'_>| again.push(s.checkpoint()))).unwrap();
                assert!(again[..] == all[i..], "{integrator}, from output {i}");
            }
        }
    }
}

#[test]
fn panes_side_by_side_have_the_bits_of_each_alone() {
    for (pane, set) in [(FACE, FORCE), (PLATE, LEFT), (HALVES, FORCE)] {
        for integrator in INTEGRATORS {
            ends_alike_side_by_side(|i| {
                let speed = format!("loose.one.velocity=[{}, 0, 0]", 1.5 + 0.7 * f64::from(i));
                model(pane, &[integrator, set, &speed])
            });
        }
    }
}

#[test]
fn a_pane_whose_limit_or_law_means_nothing_is_refused() {
    for (set, expected) in [
        ("materials.glass.breaks={}", "force"),
        ("materials.glass.breaks={ force = 1, energy = 1 }", "energy"),
        ("materials.glass.breaks.force=0", "force"),
        ("materials.glass.breaks={ force = 1, left = [0, 1] }", "depth"),
        ("materials.glass.breaks={ force = 1, depth = [0, 1], left = [1, 1] }", "breaks"),
        (
            "materials.glass={ depth = [0, 1], force = [0, 1], beyond = \"limits\", friction = 0, breaks = { force = 1 } }",
            "breaks",
        ),
        ("contact.skin=glass;materials.glass.breaks.force=1;contact.bodies=[[\"one\", \"two\"]]", "breaks"),
    ] {
        let text = format!("{SPACE}{FACE}");
        let mut draft = occupant_scenario::Draft::read(&text, occupant_scenario::Format::Toml, "test").unwrap();
        let wrong = set.split(';').try_for_each(|assignment| draft.set(assignment)).err().map(|e| e.to_string());
        let wrong = wrong.or_else(|| {
            let built = draft.load(&|name: &str| Err(format!("no file {name}"))).and_then(|loaded| loaded.build());
            match built {
                Err(problems) => Some(problems.to_string()),
                Ok((setup, _)) => Model::new(setup).err().map(|problems| problems.to_string()),
            }
        });
        let wrong = wrong.unwrap_or_else(|| panic!("{set} is accepted"));
        assert!(wrong.contains(expected), "{set}: {wrong}");
    }
}
