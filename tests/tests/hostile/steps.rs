//! Runs that are stepped in ways in which time does not go, and recorders of other runs.

use nalgebra::{Point3, Vector3};
use occupant_core::body::people::{Division, Person};
use occupant_core::model::Model;
use occupant_core::model::setup::{Integrator, Setup};
use occupant_core::results::channel::{Series, channels, find};
use occupant_core::results::recorder::{Recorder, Watch};
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::simulate::{attempt, resume, simulate};
use occupant_core::run::{Run, RunError};
use occupant_core::vehicle::{VehicleInput, VehiclePath, VehicleState};

use super::{Came, came, cart, report};

const INTEGRATORS: [fn() -> Integrator; 2] = [|| Integrator::Rk4 { step_s: 1e-4 }, Integrator::default];

fn short(integrator: Integrator) -> Setup {
    let mut setup = cart();
    setup.integrator = integrator;
    setup.time.end_s = 0.02;
    setup
}

fn said(done: Result<impl Sized, impl std::fmt::Display>) -> Result<(), String> {
    done.map(|_| ()).map_err(|error| error.to_string())
}

/// A name, what is done with a run that stands at 5 ms, and whether it is refused.
type Row = (&'static str, fn(&mut Run<'_>) -> Result<(), String>, bool);

fn head(run: &Run<'_>) -> occupant_core::body::Segment {
    run.model().body().tree.segment_named("head").unwrap()
}

fn other_segment() -> occupant_core::body::Segment {
    Person::named("male50").unwrap().body(Division::of(17).unwrap()).0.tree.segments().last().unwrap()
}

#[rustfmt::skip]
const ROWS: &[Row] = &[
    ("to no time", |run| said(run.advance_to(f64::NAN)), true),
    ("for ever", |run| said(run.advance_to(f64::INFINITY)), true),
    ("back", |run| said(run.advance_to(0.0)), true),
    ("back for ever", |run| said(run.advance_to(f64::NEG_INFINITY)), true),
    ("beyond the end", |run| said(run.advance_to(1e9)), true),
    ("by no time", |run| said(run.advance_by(f64::NAN)), true),
    ("by less than none", |run| said(run.advance_by(-1e-3)), true),
    ("to where it stands", |run| said(run.advance_to(run.time_s())), false),
    ("by next to nothing", |run| said(run.advance_by(1e-300)), false),
    ("by the last digit", |run| said(run.advance_to(run.time_s().next_up())), false),
    ("to the end", |run| said(run.advance_to(run.end_s())), false),
    ("kick a segment that there is not", |run| said(run.kick(other_segment(), Point3::origin(), Vector3::x())), true),
    ("kick with no number", |run| { let head = head(run); said(run.kick(head, Point3::origin(), Vector3::repeat(f64::NAN))) }, true),
    ("kick nowhere", |run| { let head = head(run); said(run.kick(head, Point3::new(f64::INFINITY, 0.0, 0.0), Vector3::x())) }, true),
    ("kick with nothing", |run| { let head = head(run); said(run.kick(head, Point3::origin(), Vector3::zeros())) }, false),
    ("a state of no numbers", |run| { let mut state = *run.state(); state.numbers_mut()[0] = f64::NAN; said(run.set_state(state)) }, true),
    ("a state without an attitude", |run| { let mut state = *run.state(); state.numbers_mut()[3..7].fill(0.0); said(run.set_state(state)) }, true),
    ("its own state", |run| { let state = *run.state(); said(run.set_state(state)) }, false),
    ("a frame of a path that is known", |run| said(run.push(0.01, &VehicleInput::acceleration([0.0; 3]))), true),
    ("look a thousand times", |run| (0..1000).try_for_each(|_| said(run.look(|_| ()))), false),
    ("record a thousand times", |run| (0..1000).try_for_each(|_| said(run.record(&mut Watch(|s: &Sample<'_>| { let _ = s.is_last(); })))), false),
    ("a summary that began with nothing", |run| { said(run.look(|s| Summarizer::new().record(s).map(|_| ()).map_err(|e| e.to_string())).unwrap()) }, true),
    ("bytes that are no run", |run| said(Run::load(run.model(), b"nothing")), true),
    ("no bytes", |run| said(Run::load(run.model(), &[])), true),
    ("half of a run", |run| { let bytes = run.save().unwrap(); said(Run::load(run.model(), &bytes[..bytes.len() / 2])) }, true),
    ("a run and more", |run| { let mut bytes = run.save().unwrap(); bytes.push(0); said(Run::load(run.model(), &bytes)) }, true),
    ("a run that was put away", |run| { let bytes = run.save().unwrap(); said(Run::load(run.model(), &bytes)) }, false),
    ("a checkpoint of no numbers", |run| { let mut one = run.checkpoint().unwrap(); one.state[0] = f64::NAN; said(Run::from_checkpoint(run.model(), &one)) }, true),
    ("a checkpoint of half a state", |run| { let mut one = run.checkpoint().unwrap(); one.state.truncate(3); said(Run::from_checkpoint(run.model(), &one)) }, true),
    ("a checkpoint of no time", |run| { let mut one = run.checkpoint().unwrap(); one.time_s = f64::NAN; said(Run::from_checkpoint(run.model(), &one)) }, true),
    ("a checkpoint of a number without end", |run| { let mut one = run.checkpoint().unwrap(); one.index = usize::MAX; said(Run::from_checkpoint(run.model(), &one)) }, true),
    ("a checkpoint between outputs, to be resumed", |run| { run.advance_by(3e-4).unwrap(); let one = run.checkpoint().unwrap(); said(resume(run.model(), &one, ())) }, true),
    ("no such sphere", |run| run.look(|s| said(s.sphere_pull_n(9999, None))).unwrap(), true),
    ("no such belt", |run| run.look(|s| said(s.sphere_pull_n(0, Some("lop")))).unwrap(), true),
    ("the lap belt", |run| run.look(|s| said(s.sphere_pull_n(0, Some("lap")))).unwrap(), false),
    ("all belts", |run| run.look(|s| said(s.sphere_pull_n(0, Some("belt")))).unwrap(), false),
];

#[test]
fn a_run_refuses_what_it_cannot_do_and_goes_on() {
    let mut failures = Vec::new();
    for integrator in INTEGRATORS {
        let model = Model::new(short(integrator())).unwrap();
        for (name, call, refused) in ROWS {
            let mut run = Run::new(&model);
            run.advance_to(5e-3).unwrap();
            match came(name, || call(&mut run)) {
                Ok(came) if matches!(came, Came::Refused(_)) == *refused => {}
                Ok(came) => failures.push(format!("{name}: {came:?}")),
                Err(words) => failures.push(words),
            }
            if let Err(error) = run.advance_to(model.setup().time.end_s) {
                failures.push(format!("{name}: does not go on: {error}"));
            }
        }
    }
    report(&failures);
}

/// What is asked of a segment, sphere or body that there is not, is no number; it is no panic and no 0.
#[test]
fn what_there_is_not_has_no_place() {
    let model = Model::new(short(Integrator::default())).unwrap();
    let lost = other_segment();
    let numbers = Run::new(&model)
        .look(|s| {
            [
                s.cg_m(lost).x,
                s.end_points_m(lost)[0].x,
                s.orientation(lost).w,
                s.cg_velocity_m_s(lost).x,
                s.cg_acceleration_m_s2(lost).x,
                s.specific_force_m_s2(lost).x,
                s.angular_velocity_rad_s(lost).x,
                s.angular_acceleration_rad_s2(lost).x,
                s.sphere_centre_m(9999).x,
                s.sphere_force_n(9999).x,
                s.centre_of_body(7).0.x,
                s.frame(occupant_core::forces::contact::surface::Frame::Other(5)).origin_m.x,
                s.frame(occupant_core::forces::contact::surface::Frame::Segment(99)).origin_m.x,
                s.model.body().segment(lost).mass_kg,
                s.of_body(7).cg_m(lost).x,
            ]
        })
        .unwrap();
    assert!(numbers.iter().all(|x| x.is_nan()), "{numbers:?}");
}

/// A run that blew up does not pass for one that came to its end.
#[test]
fn a_run_that_failed_is_an_error() {
    let mut setup = short(Integrator::Rk4 { step_s: 0.05 });
    (setup.time.end_s, setup.time.output_s) = (0.2, 0.05);
    let model = Model::new(setup).unwrap();
    let mut summarizer = Summarizer::new();
    assert!(simulate(&model, &mut summarizer).is_err());
    assert!(attempt(&model, ()).unwrap().succeeded().is_err());
    let mut run = Run::new(&model);
    assert!(matches!(run.advance_to(0.2), Err(RunError::Step(_))));
    assert!(Run::new(&model).finish(&mut ()).is_err());
}

/// Nothing that is recorded of one model passes for another's.
#[test]
fn recorders_know_their_model() {
    let ours = Model::new(short(Integrator::default())).unwrap();
    let mut other = short(Integrator::default());
    other.belts.clear();
    let other = Model::new(other).unwrap();
    assert!(simulate(&other, Series::new(channels(&ours))).is_err());
    assert!(simulate(&ours, Series::new(channels(&ours))).is_ok());
    let channel = find(&ours, "belt.lap.force").unwrap();
    assert!(Run::new(&other).look(|s| channel.value(s)).unwrap().is_nan());
    let bytes = Run::new(&ours).save().unwrap();
    assert!(Run::load(&other, &bytes).is_err());
    for name in ["", "hed.acceleration.resultant", "belt.lop.force", "*"] {
        assert!(find(&ours, name).is_err(), "{name}");
    }
    assert_eq!(
        find(&ours, "hed.acceleration.resultant").unwrap_err().nearest.as_deref(),
        Some("head.acceleration.resultant")
    );
}

/// A vehicle that is told on the way is never guessed.
#[test]
fn nobody_goes_on_without_being_told() {
    for integrator in INTEGRATORS {
        let mut setup = short(integrator());
        let start = VehicleState { velocity_m_s: Vector3::new(10.0, 0.0, 0.0), ..VehicleState::default() };
        setup.path = VehiclePath::live(start);
        let model = Model::new(setup).unwrap();
        assert!(simulate(&model, ()).is_err());
        let mut run = Run::new(&model);
        assert!(run.advance_to(1e-3).is_err());
        for until_s in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(run.push(until_s, &VehicleInput::acceleration([0.0; 3])).is_err(), "{until_s}");
        }
        assert!(run.push(1e-3, &VehicleInput::acceleration([f64::NAN; 3])).is_err());
        run.push(1e-3, &VehicleInput::acceleration([-50.0, 0.0, 0.0])).unwrap();
        assert!(run.push(2e-3, &VehicleInput::acceleration([0.0; 3])).is_err(), "the run stands before it");
        assert!(run.advance_to(2e-3).is_err());
        run.advance_to(1e-3).unwrap();
        assert!((run.vehicle().velocity_m_s.x - 9.95).abs() < 1e-12);
    }
}
