//! A run that goes on from a checkpoint is, to the bit, the run that was never interrupted.

use occupant_core::forces::Misfit;
use occupant_core::forces::contact::material::Memory;
use occupant_core::forces::contact::{OPEN, PASSED, TOUCHING};
use occupant_core::model::Model;
use occupant_core::model::seating::InitialPosture;
use occupant_core::model::setup::{Integrator, Setup};
use occupant_core::motion::report_coordinates::ReportCoordinates;
use occupant_core::results::checkpoint::{Checkpoint, CheckpointError};
use occupant_core::results::outcome::{Outcome, ResumeError, Status};
use occupant_core::results::recorder::{Flow, Recorder, RecorderError, Watch};
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::simulate::{replay, resume, simulate};
use occupant_scenario::{Format, Scenario};
use occupant_tests::cart::lap;
use occupant_tests::room::setup;

const RK4: Integrator = Integrator::Rk4 { step_s: 3e-4 };
const ADAPTIVE: Integrator =
    Integrator::Adaptive { relative: 1e-4, absolute_m: 1e-4, absolute_m_s: 1e-4, min_step_s: 1e-9, max_step_s: 1e-3 };

/// Outputs of a run: everything in them as text, which shows every bit, and their checkpoints.
#[derive(Default)]
struct Outputs {
    texts: Vec<String>,
    checkpoints: Vec<Checkpoint>,
    /// The run stops after this output.
    stop_at: Option<usize>,
}

impl Recorder for Outputs {
    fn record(&mut self, s: &Sample<'_>) -> Result<Flow, RecorderError> {
        let checkpoint = s.checkpoint();
        let derived = (s.evaluation, s.actions, s.energy, s.vehicle);
        self.texts.push(format!("{checkpoint:?} {derived:?}"));
        self.checkpoints.push(checkpoint);
        Ok(match self.stop_at == Some(s.index) {
            true => Flow::Stop,
            false => Flow::Continue,
        })
    }
}

fn run(setup: &Setup) -> (Model, Outputs, Outcome) {
    let model = Model::new(setup.clone()).unwrap();
    let mut outputs = Outputs::default();
    let outcome = simulate(&model, &mut outputs).unwrap();
    (model, outputs, outcome)
}

/// Two belts, and crush that stays.
fn lap_and_torso(integrator: Integrator) -> Setup {
    let text = include_str!("../data/carts/cart-lap-torso.toml");
    let alone = |name: &str| Err(format!("no file beside the text: {name}"));
    let loaded = Scenario::from_text(text, Format::Toml, "cart", &alone);
    let mut setup = loaded.and_then(|s| s.build()).unwrap().0;
    setup.integrator = integrator;
    for material in &mut setup.materials {
        material.memory = Memory::Retain;
    }
    setup
}

/// Elastic limits instead of viscous stops, locks that open, slip and close again, and muscles with reflexes.
fn limited(integrator: Integrator) -> Setup {
    let text = include_str!("../data/carts/cart-lap-torso.toml");
    let joints = "[joints]\npreset = \"gebod\"\nelbows.lock = { until = \"10 N m\", relock_below = 20 }\n\
                  neck.lock = { until = \"15 N m\", slips = true }";
    let text = text.replace("[joints]\npreset = \"male50\"", joints)
        + "[triggers]\ngo = { kind = \"time\", at = 0.05 }\n\
           [muscles]\nhips = { trigger = \"go\", rise = 0.02, stiffness = 60, damping = 2, limit = 20, \
           reflex = { stiffness = 40, damping = 3, delay = 0.03 } }\n";
    let alone = |name: &str| Err(format!("no file beside the text: {name}"));
    let setup = Scenario::from_text(&text, Format::Toml, "cart", &alone).and_then(|s| s.build()).unwrap().0;
    assert!(setup.joints.has_limits());
    Setup { integrator, ..setup }
}

/// A body of 17 segments.
fn seventeen(integrator: Integrator) -> Setup {
    let text = include_str!("../../scenarios/sled-17-segments.toml");
    Setup { integrator, ..setup(text, &["time.end=\"120 ms\""]) }
}

fn cases() -> [Setup; 8] {
    [
        lap(RK4),
        lap(ADAPTIVE),
        lap_and_torso(RK4),
        lap_and_torso(ADAPTIVE),
        limited(RK4),
        limited(ADAPTIVE),
        seventeen(RK4),
        seventeen(ADAPTIVE),
    ]
}

/// Resumes a run at some of its outputs: what comes must have the bits of the whole run.
pub(crate) fn goes_on(setup: &Setup) -> Outcome {
    let (model, whole, outcome) = run(setup);
    let last = whole.texts.len() - 1;
    for at in [0, 1, 57, 100, last - 1, last] {
        let mut rest = Outputs::default();
        let ended = resume(&model, &whole.checkpoints[at], &mut rest).unwrap();
        assert!(rest.texts == whole.texts[at..], "from output {at}");
        assert_eq!(ended, outcome);
    }
    outcome
}

#[test]
fn a_run_resumed_at_any_output_has_the_bits_of_the_whole_run() {
    for setup in cases() {
        let outcome = goes_on(&setup);
        assert_eq!(outcome.status, Status::Completed);
        assert!(!outcome.first_touches.is_empty());
    }
}

#[test]
fn a_finished_run_goes_on_to_a_later_end() {
    for mut setup in cases() {
        let (model, whole, outcome) = run(&setup);
        setup.time.end_s = setup.time.start_s + 0.1;
        let (_, first, _) = run(&setup);
        let from = first.checkpoints.last().unwrap();
        let mut rest = Outputs::default();
        let ended = resume(&model, from, &mut rest).unwrap();
        assert!(rest.texts == whole.texts[from.index..]);
        assert_eq!(ended, outcome);
    }
}

#[test]
fn an_interrupted_run_goes_on() {
    let (model, whole, outcome) = run(&lap(RK4));
    let mut first = Outputs { stop_at: Some(83), ..Outputs::default() };
    assert_eq!(simulate(&model, &mut first).unwrap().status, Status::Stopped);
    let mut rest = Outputs::default();
    let ended = resume(&model, first.checkpoints.last().unwrap(), &mut rest).unwrap();
    assert!(first.texts[..83] == whole.texts[..83] && rest.texts == whole.texts[83..]);
    assert_eq!(ended, outcome);
}

/// The end of a run that lies between two output times is no output of a longer run.
#[test]
fn an_end_between_outputs_is_refused_and_the_output_before_it_is_not() {
    let mut setup = lap(RK4);
    let (model, whole, _) = run(&setup);
    setup.time.end_s = 0.0504;
    let (_, first, _) = run(&setup);
    let [.., before, last] = first.checkpoints.as_slice() else { panic!("no outputs") };
    // 51 intervals of a millisecond are not 0.051 s to the last bit
    let refused = CheckpointError::Time { index: 51, found_s: 0.0504, expected_s: Some(51.0 * 1e-3) };
    assert_eq!(last.check(&model), Err(refused));
    let mut rest = Outputs::default();
    resume(&model, before, &mut rest).unwrap();
    assert!(rest.texts == whole.texts[50..]);
}

#[test]
fn every_output_can_be_replayed_from_its_checkpoint() {
    let (model, whole, _) = run(&lap(ADAPTIVE));
    let mut again = Outputs::default();
    for checkpoint in &whole.checkpoints {
        replay(&model, checkpoint, &mut again).unwrap();
    }
    assert!(again.texts == whole.texts);
}

/// What is done to a checkpoint.
type Change<'a> = &'a dyn Fn(&mut Checkpoint);

#[test]
fn a_checkpoint_of_another_scenario_is_refused() {
    let (model, outputs, _) = run(&lap(RK4));
    let sound = &outputs.checkpoints[90];
    let refused = |change: Change<'_>| {
        let mut checkpoint = sound.clone();
        change(&mut checkpoint);
        let watch = Watch(|_: &Sample<'_>| panic!("it ran"));
        match resume(&model, &checkpoint, watch) {
            Err(ResumeError::Refused(error)) => error,
            other => panic!("{other:?}"),
        }
    };
    let pairs = sound.memory.contacts.len();
    let (many, belts) = ("pairs of spheres and surfaces", "belts");
    let count = |of, found, expected| CheckpointError::Memory(Misfit::Count { of, found, expected });
    let pair = |number| CheckpointError::Memory(Misfit::Impossible { of: "pair", number });
    let not_finite = CheckpointError::Memory(Misfit::NotFinite);
    let cases: [(CheckpointError, Change<'_>); 9] = [
        (count("numbers of the state", 74, 79), &|c| c.state.truncate(74)),
        (count(many, pairs - 1, pairs), &|c| c.memory.contacts.truncate(pairs - 1)),
        (count(belts, 0, 1), &|c| c.memory.belts.clear()),
        (CheckpointError::Time { index: 300, found_s: sound.time_s, expected_s: None }, &|c| c.index = 300),
        (pair(3), &|c| c.memory.contacts[3].phase = 7.0),
        (pair(4), &|c| c.memory.contacts[4].greatest = -1.0),
        (CheckpointError::Touch { sphere: 17, surface: sound.first_touches[0].surface }, &|c| {
            c.first_touches[0].sphere = 17
        }),
        (not_finite, &|c| c.state[40] = f64::NAN),
        (not_finite, &|c| c.progress.energy_start.mechanical_j = f64::INFINITY),
    ];
    for (expected, change) in cases {
        assert_eq!(refused(change), expected);
    }
}

/// With error control most outputs lie within a step, which the checkpoint tells the start of.
#[test]
fn a_checkpoint_with_an_impossible_step_is_refused() {
    let (model, outputs, _) = run(&lap(ADAPTIVE));
    let within = |c: &&Checkpoint| c.under_way.is_some();
    assert!(outputs.checkpoints.iter().filter(within).count() > 150);
    let sound = outputs.checkpoints.iter().rev().find(within).unwrap();
    let refused = |change: Change<'_>| {
        let mut checkpoint = sound.clone();
        change(&mut checkpoint);
        checkpoint.check(&model)
    };
    let step = sound.under_way.as_ref().unwrap();
    let (start_s, time_s) = (step.start_s, sound.time_s);
    assert_eq!(refused(&|_| {}), Ok(()));
    let early = CheckpointError::Step { start_s, end_s: start_s, time_s };
    let ends_early: Change<'_> = &|c| c.under_way.as_mut().unwrap().end_s = start_s;
    assert_eq!(refused(ends_early), Err(early));
    let short: Change<'_> = &|c| c.under_way.as_mut().unwrap().memory.contacts.truncate(1);
    assert!(matches!(refused(short), Err(CheckpointError::Memory(Misfit::Count { found: 1, .. }))));
    let broken: Change<'_> = &|c| c.under_way.as_mut().unwrap().state[0] = f64::NAN;
    assert_eq!(refused(broken), Err(CheckpointError::Memory(Misfit::NotFinite)));
}

/// Files before plates have no work of these in a state, those before columns none of columns, those before air bags none of bags,
/// those of 0.1.0 none of muscles either, one to four numbers less: they go on as if nothing was missing.
#[test]
fn a_checkpoint_of_an_older_version_goes_on() {
    let (model, whole, _) = run(&lap(RK4));
    let mut from = whole.checkpoints[110].clone();
    for count in [79, 78, 77, 76] {
        assert_eq!((from.state.len(), from.state.remove(74)), (count, 0.0));
        let mut rest = Outputs::default();
        resume(&model, &from, &mut rest).unwrap();
        assert!(rest.texts[1..] == whole.texts[111..]);
    }
    from.state.pop();
    let misfit = Misfit::Count { of: "numbers of the state", found: 74, expected: 79 };
    assert_eq!(Checkpoint::state_of(&model, &from.state).err(), Some(CheckpointError::Memory(misfit)));
}

/// The loads of the legs that files of an older version lack, 12 numbers at the end of each reading, are left out of their measures.
#[test]
fn a_file_without_the_loads_of_legs_has_all_other_measures() {
    const LEGS: usize = 12;
    let (model, whole, outcome) = run(&seventeen(RK4));
    let measures = |checkpoints: &[Checkpoint]| {
        let mut summarizer = Summarizer::new();
        summarizer.begin(&model).unwrap();
        checkpoints.iter().for_each(|checkpoint| replay(&model, checkpoint, &mut summarizer).unwrap());
        summarizer.end(&outcome).unwrap();
        let summary = summarizer.summary(None).unwrap();
        let all = summary.measures.into_iter().map(|m| (m.name, m.value.map(f64::to_bits)));
        all.collect::<Vec<_>>()
    };
    let each = whole.checkpoints[0].readings_before.len() - 2;
    let mut older = whole.checkpoints.clone();
    for checkpoint in &mut older {
        checkpoint.readings_before.truncate(2 + each - LEGS);
        let readings = checkpoint.readings.chunks_exact(each).flat_map(|own| &own[..each - LEGS]).copied();
        checkpoint.readings = readings.collect();
    }
    let now = measures(&whole.checkpoints);
    let of_legs = |(name, _): &(&str, Option<u64>)| name.contains("tibia");
    assert_eq!(now.iter().filter(|m| of_legs(m)).count(), 4);
    let others: Vec<_> = now.into_iter().filter(|m| !of_legs(m)).collect();
    assert_eq!(measures(&older), others);
    let mut rest = Outputs::default();
    resume(&model, &older[100], &mut rest).unwrap();
    assert_eq!(rest.checkpoints[3].state, whole.checkpoints[103].state);
}

/// The proofs above mean something only if there is history to lose.
#[test]
fn without_its_history_a_run_goes_on_differently() {
    let (model, whole, _) = run(&lap(RK4));
    let mut from = whole.checkpoints[110].clone();
    let greatest = |p: &occupant_core::forces::contact::PairHistory<f64>| p.greatest;
    assert!(from.memory.contacts.iter().map(greatest).fold(0.0, f64::max) > 0.01);
    for pair in from.memory.contacts.iter_mut().filter(|p| p.phase == TOUCHING) {
        pair.greatest = 0.0;
    }
    let mut rest = Outputs::default();
    resume(&model, &from, &mut rest).unwrap();
    assert!(rest.texts[1..] != whole.texts[111..]);
}

/// Cards tell which pairs have passed; all others that overlap touch, from their present depth.
#[test]
fn where_cards_tell_the_pairs_these_have_passed_and_all_others_touch() {
    let (model, outputs, _) = run(&lap(RK4));
    let overlapping = |c: &Checkpoint| c.memory.contacts.iter().filter(|p| p.phase != OPEN).count();
    let from = outputs.checkpoints.iter().max_by_key(|c| overlapping(c));
    let from = from.unwrap();
    let groups = &model.system().forces.contacts.groups;
    let named = groups.iter().flat_map(|group| {
        let pairs = group.pairs.clone();
        pairs.map(|i| (i, (group.sphere, surface_of(&model, i))))
    });
    let (one, other): (Vec<_>, Vec<_>) =
        named.filter(|(i, _)| from.memory.contacts[*i].phase != OPEN).partition(|(i, _)| i % 2 == 0);
    assert!(one.len() > 5 && other.len() > 5);
    let mut setup = model.setup().clone();
    setup.time.start_s = from.time_s;
    let coordinates =
        Box::new(ReportCoordinates::from_state(&Checkpoint::state_of(&model, &from.state).unwrap()).unwrap());
    setup.posture = InitialPosture::Continued { coordinates, passed: one.iter().map(|(_, names)| *names).collect() };
    let continued = Model::new(setup).unwrap();
    let pairs = &continued.start().history.memory.contacts;
    for (i, _) in &one {
        assert_eq!((pairs[*i].phase, pairs[*i].greatest), (PASSED, 0.0));
    }
    for (i, _) in &other {
        assert_eq!(pairs[*i].phase, TOUCHING);
        assert!(pairs[*i].greatest > 0.0);
    }
    let rest = pairs.iter().filter(|p| p.phase == OPEN).count();
    assert_eq!(rest + one.len() + other.len(), pairs.len());
}

/// The first of a pair's surfaces.
fn surface_of(model: &Model, pair: usize) -> usize {
    model.system().forces.contacts.pairs[pair].parts[0].surface
}
