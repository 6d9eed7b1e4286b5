//! A program's own vehicle model as the path: alone, side by side, resumed and diagnosed like any other.

#[path = "../examples/own_vehicle_path.rs"]
#[allow(dead_code, reason = "the example's main")]
mod example;

use std::ops::ControlFlow;

use example::ObliqueCollision;
use nalgebra::Vector3;
use occupant_core::diagnosis::diagnose;
use occupant_core::model::Model;
use occupant_core::model::setup::{Integrator, Setup};
use occupant_core::results::checkpoint::Checkpoint;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use occupant_core::run::batch::{Job, Kernel, simulate_many};
use occupant_core::run::simulate::{resume, simulate};
use occupant_core::vehicle::{Attitude, PathCursor, VehicleMotion, VehiclePath, VehiclePose, VehicleState};
use occupant_scenario::{Format, Scenario};

const RK4: Integrator = Integrator::Rk4 { step_s: 2e-4 };
const ADAPTIVE: Integrator =
    Integrator::Adaptive { relative: 1e-4, absolute_m: 1e-4, absolute_m_s: 1e-4, min_step_s: 1e-9, max_step_s: 1e-3 };

/// Every output as text, which shows every bit, and its checkpoint.
#[derive(Clone, Default)]
struct Outputs {
    texts: Vec<String>,
    checkpoints: Vec<Checkpoint>,
}

impl Recorder for Outputs {
    fn record(&mut self, s: &Sample<'_>) -> Result<Flow, RecorderError> {
        let derived = (s.evaluation, s.actions, s.energy, s.vehicle, s.vehicle_pose);
        self.texts.push(format!("{:?} {derived:?}", s.checkpoint()));
        self.checkpoints.push(s.checkpoint());
        Ok(Flow::Continue)
    }
}

/// The driver in a lap belt on a cart that stops.
fn lap(integrator: Integrator) -> Setup {
    let text = include_str!("../testdata/carts/cart-lap.toml");
    let no_files = |name: &str| Err(format!("{name}: no files here"));
    let loaded = Scenario::from_text(text, Format::Toml, "cart-lap.toml", &no_files).unwrap();
    Setup { integrator, ..loaded.build().unwrap().0 }
}

fn struck(integrator: Integrator, yaw_rate_after_rad_s: f64) -> Model {
    let mut setup = lap(integrator);
    setup.path = VehiclePath::own(ObliqueCollision {
        speed_m_s: 15.0,
        delta_v_m_s: Vector3::new(-8.0, 3.0, 0.0),
        yaw_rate_after_rad_s,
        duration_s: 0.1,
    });
    setup.time.end_s = 0.15;
    Model::new(setup).unwrap()
}

fn alone(model: &Model) -> Outputs {
    let mut outputs = Outputs::default();
    let outcome = simulate(model, &mut outputs).unwrap();
    assert!(outcome.energy.balance_error < 1e-4, "{:?}", outcome.energy);
    outputs
}

#[test]
fn side_by_side_and_in_another_thread_it_gives_the_same_bits() {
    let models: Vec<Model> = (0..9).map(|i| struck(RK4, 0.5 * f64::from(i))).collect();
    let expected: Vec<Outputs> = models.iter().map(alone).collect();
    let kernels = [Kernel::Scalar, Kernel::Lanes4, Kernel::Lanes8].into_iter().filter(|k| k.is_available());
    for kernel in kernels {
        let run_all = || {
            let jobs = models.iter().enumerate();
            let jobs = jobs.map(|(tag, model)| Job { tag, model: model.clone(), recorder: Outputs::default() });
            let mut seen = 0;
            simulate_many(kernel, jobs, |ended| {
                assert!(ended.recorder.texts == expected[ended.tag].texts, "run {} with {kernel}", ended.tag);
                seen += 1;
                ControlFlow::Continue(())
            });
            seen
        };
        let seen = std::thread::scope(|scope| scope.spawn(run_all).join()).unwrap();
        assert_eq!(seen, models.len());
    }
}

#[test]
fn a_resumed_run_has_the_bits_of_the_whole_run() {
    for integrator in [RK4, ADAPTIVE] {
        let model = struck(integrator, 2.5);
        let whole = alone(&model);
        for at in [0, 33, 99, 100, 101, 150] {
            let mut rest = Outputs::default();
            resume(&model, &whole.checkpoints[at], &mut rest).unwrap();
            assert!(rest.texts == whole.texts[at..], "from output {at}");
        }
    }
}

#[test]
fn its_diagnosis_knows_speed_and_change_of_velocity() {
    let diagnosis = diagnose(&struck(RK4, 2.5));
    assert_eq!(diagnosis.vehicle.path, "own");
    assert_eq!(diagnosis.vehicle.start_speed_m_s, 15.0);
    assert!((diagnosis.vehicle.velocity_change_m_s - 73_f64.sqrt()).abs() < 1e-12);
}

/// A built-in path asked as if it were somebody's own.
#[derive(Debug)]
struct Straight(VehiclePath);

impl VehicleMotion for Straight {
    fn at(&self, t_s: f64) -> VehicleState {
        let mut cursor = PathCursor::default();
        let motion = self.0.motion(t_s, t_s, &mut cursor);
        VehicleState {
            pose: self.0.attitude(t_s, &mut cursor),
            velocity_m_s: Vector3::new(motion.velocity_m_s.x, 0.0, 0.0),
            acceleration_m_s2: Vector3::new(motion.acceleration_m_s2.x, 0.0, 0.0),
            ..VehicleState::default()
        }
    }

    fn breaks_s(&self) -> Vec<f64> {
        self.0.breaks_s()
    }
}

#[test]
fn an_own_pulse_moves_the_occupant_as_the_built_in_one() {
    let built_in = lap(ADAPTIVE);
    let own = Setup { path: VehiclePath::own(Straight(built_in.path.clone())), ..built_in.clone() };
    let states = |setup: Setup| -> Vec<_> {
        let outputs = alone(&Model::new(setup).unwrap());
        outputs.checkpoints.iter().map(|c| c.state.clone()).collect()
    };
    assert!(states(own) == states(built_in));
}

/// A vehicle known from 0 to 0.1 s, without a place after 50 ms.
#[derive(Debug)]
struct Lost;

impl VehicleMotion for Lost {
    fn at(&self, t_s: f64) -> VehicleState {
        let x = if t_s > 0.05 { f64::NAN } else { 0.0 };
        let pose = VehiclePose { position_m: Vector3::new(x, 0.0, 0.0), attitude: Attitude::default() };
        VehicleState { pose, ..VehicleState::default() }
    }

    fn span_s(&self) -> (f64, f64) {
        (0.0, 0.1)
    }
}

#[test]
fn a_run_without_an_answer_is_refused() {
    let refusal = |end_s: f64| {
        let mut setup = lap(RK4);
        setup.path = VehiclePath::own(Lost);
        setup.time.end_s = end_s;
        Model::new(setup).map(|_| ()).unwrap_err().to_string()
    };
    assert_eq!(
        refusal(0.2),
        "error: path: the run lasts from 0 s to 0.2 s, expected times from 0 s to 0.1 s, for which the program's own path \
         has an answer; expected a path for the whole run"
    );
    assert_eq!(
        refusal(0.1),
        "error: path: the program's own path has numbers that are not finite at 0.1 s, expected finite numbers; expected \
         a path for the whole run"
    );
}
