//! Runs that a program steps itself, and vehicles that it tells how to move on the way.

use nalgebra::{Point3, Vector3};
use occupant_core::body::Body;
use occupant_core::forces::joint::Joints;
use occupant_core::model::Model;
use occupant_core::model::seating::InitialPosture;
use occupant_core::model::setup::{Integrator, Setup, SetupBuilder};
use occupant_core::motion::report_coordinates::{DOF, ReportCoordinates};
use occupant_core::results::channel::{Series, channels};
use occupant_core::results::outcome::Status;
use occupant_core::run::Run;
use occupant_core::run::simulate::simulate;
use occupant_core::vehicle::{VehicleInput, VehicleMotion, VehiclePath, VehicleState};
use occupant_scenario::{Format, Scenario};

const INTEGRATORS: [fn() -> Integrator; 2] = [|| Integrator::Rk4 { step_s: 1e-4 }, Integrator::default];

fn cart(integrator: Integrator, end_s: f64) -> Setup {
    let text = include_str!("../../scenarios/cart-lap-torso.toml");
    let none = |name: &str| Err(format!("no file {name}"));
    let mut setup = Scenario::from_text(text, Format::Toml, "cart", &none).unwrap().build().unwrap().0;
    (setup.integrator, setup.time.end_s) = (integrator, end_s);
    setup
}

/// Stepped from output to output, looked at on the way, it is to the bit the run from start to end.
#[test]
fn a_run_that_is_stepped_is_the_run() {
    for integrator in INTEGRATORS {
        let model = Model::new(cart(integrator(), 0.08)).unwrap();
        let (mut whole, mut stepped) = (Series::new(channels(&model)), Series::new(channels(&model)));
        let outcome = simulate(&model, &mut whole).unwrap();
        let mut run = Run::new(&model);
        run.record(&mut stepped).unwrap();
        while let Some(output_s) = run.next_output_s() {
            run.look(|sample| sample.time_s).unwrap();
            run.advance_to(output_s).unwrap();
            for _ in 0..3 {
                run.look(|sample| sample.energy.kinetic_j).unwrap();
            }
            run.record(&mut stepped).unwrap();
        }
        let ended = run.end(Status::Completed, &mut stepped).unwrap();
        assert_eq!(whole.time_s, stepped.time_s);
        let bits = |series: &Series| series.values.concat().iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&whole), bits(&stepped));
        assert_eq!(ended, outcome);
    }
}

/// A clone and a run that was put away and taken up go on to the same bits, from anywhere.
#[test]
fn a_run_is_cloned_and_saved_anywhere() {
    for integrator in INTEGRATORS {
        let model = Model::new(cart(integrator(), 0.1)).unwrap();
        for at_s in [0.0, 1e-5, 0.0413, 0.06] {
            let mut run = Run::new(&model);
            run.advance_to(at_s).unwrap();
            let (mut clone, bytes) = (run.clone(), run.save().unwrap());
            let mut loaded = Run::load(&model, &bytes).unwrap();
            let mut resumed = Run::from_checkpoint(&model, &run.checkpoint().unwrap()).unwrap();
            let ends = [&mut run, &mut clone, &mut loaded, &mut resumed].map(|run| {
                for to_s in [0.065, 0.07031, 0.1] {
                    run.advance_to(to_s).unwrap();
                }
                run.state().numbers().iter().map(|x| x.to_bits()).collect::<Vec<_>>()
            });
            assert!(ends.iter().all(|end| *end == ends[0]), "at {at_s} s");
        }
    }
}

/// A body that falls freely far above everything.
fn free(integrator: Integrator) -> Model {
    let mut case = SetupBuilder::new("free", Body::male50(), Joints::free(Body::male50().tree));
    case.setup.integrator = integrator;
    case.setup.gravity_m_s2 = 0.0;
    let mut q = [0.0; DOF];
    (q[2], q[5], q[9]) = (10.0, 0.4, -0.3);
    let posture = InitialPosture::Coordinates(Box::new(ReportCoordinates { q, rates: [0.0; DOF] }));
    Model::new(case.build(VehiclePath::parked(), posture, 0.2)).unwrap()
}

/// A kick gives its impulse to the whole body, and its moment about the body's centre. The energy balance goes on.
#[test]
fn a_kick_gives_its_impulse() {
    for integrator in INTEGRATORS {
        let model = free(integrator());
        let (mut run, impulse_n_s) = (Run::new(&model), Vector3::new(6.0, -11.0, 4.0));
        run.advance_to(0.013).unwrap();
        let hand = model.body().tree.segment_named("right_forearm").unwrap();
        run.kick(hand, Point3::origin(), impulse_n_s).unwrap();
        let mass_kg = model.body().mass_kg();
        let velocity = |run: &mut Run<'_>| run.look(|sample| sample.centre_of_body(0).1).unwrap();
        assert!((velocity(&mut run) * mass_kg - impulse_n_s).norm() < 1e-10);
        let struck = run.look(|sample| sample.cg_velocity_m_s(hand).norm()).unwrap();
        assert!(struck > 2.0, "{struck}");
        run.advance_to(0.2).unwrap();
        assert!((velocity(&mut run) * mass_kg - impulse_n_s).norm() < 1e-5);
        let [balance_j, kinetic_j] = run.look(|s| [s.energy.balance_j, s.energy.kinetic_j]).unwrap();
        assert!(balance_j.abs() < 1e-5 * kinetic_j, "{balance_j} of {kinetic_j} J");
    }
}

/// 3 m/s more, put into the state, moves the body by 3 cm in 10 ms, under both integrators: nobody ignores it.
#[test]
fn a_state_that_was_changed_counts() {
    for integrator in INTEGRATORS {
        let model = free(integrator());
        let moved = [0.0, 3.0].map(|more| {
            let mut run = Run::new(&model);
            run.advance_to(0.01).unwrap();
            let mut state = *run.state();
            let mut velocity = state.velocity();
            velocity.y += more;
            state.set_velocity(velocity);
            for slot in state.turns() {
                state.set_omega(slot, state.omega(slot));
            }
            run.set_state(state).unwrap();
            run.advance_to(0.011).unwrap();
            run.state().t1().y
        });
        assert!((moved[1] - moved[0] - 3e-3).abs() < 2e-4, "{moved:?}");
    }
}

const BRAKING: f64 = -80.0;

/// The same motion, known beforehand.
#[derive(Debug)]
struct Braked;

impl VehicleMotion for Braked {
    fn at(&self, t_s: f64) -> VehicleState {
        let mut state = VehicleState::default();
        state.pose.position_m.x = 10.0 * t_s + 0.5 * BRAKING * t_s * t_s;
        state.velocity_m_s.x = 10.0 + BRAKING * t_s;
        state.acceleration_m_s2.x = BRAKING;
        state
    }
}

fn rolling() -> VehicleState {
    VehicleState { velocity_m_s: Vector3::new(10.0, 0.0, 0.0), ..VehicleState::default() }
}

/// Told frame by frame, by accelerations or by states, a vehicle moves the body as when its path was known: within 1e-6 m
/// (measured: 3e-9 m).
#[test]
fn a_vehicle_that_is_told_is_the_vehicle_that_was_known() {
    let by_state: fn(f64) -> VehicleInput = |t_s| VehicleInput::State(Braked.at(t_s));
    let by_acceleration: fn(f64) -> VehicleInput = |_| VehicleInput::acceleration([BRAKING, 0.0, 0.0]);
    for integrator in INTEGRATORS {
        let mut known = cart(integrator(), 0.1);
        known.path = VehiclePath::own(Braked);
        let known = Model::new(known).unwrap();
        let mut told = cart(integrator(), 0.1);
        told.path = VehiclePath::live(rolling());
        let told = Model::new(told).unwrap();
        for input in [by_acceleration, by_state] {
            let (mut own, mut live) = (Run::new(&known), Run::new(&told));
            for frame in 1..=100 {
                let until_s = 1e-3 * f64::from(frame);
                live.push(until_s, &input(until_s)).unwrap();
                live.advance_to(until_s).unwrap();
                own.advance_to(until_s).unwrap();
            }
            let apart = own.state().numbers().iter().zip(live.state().numbers());
            let apart = apart.take(3).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(apart < 1e-6, "{apart} m");
            assert!((live.vehicle().velocity_m_s.x - 2.0).abs() < 1e-9);
        }
    }
}

/// A lane change that begins: it goes aside and turns.
#[derive(Debug)]
struct Turning;

impl VehicleMotion for Turning {
    fn at(&self, t_s: f64) -> VehicleState {
        let mut state = rolling();
        state.pose.position_m = Vector3::new(10.0 * t_s, 0.2 * t_s * t_s, 0.0);
        state.pose.attitude.yaw_rad = 1.5 * t_s * t_s;
        state.velocity_m_s.y = 0.4 * t_s;
        state.acceleration_m_s2.y = 0.4;
        state.angle_rates_rad_s.z = 3.0 * t_s;
        state.angle_accelerations_rad_s2.z = 3.0;
        state
    }
}

/// It turns as well, as when its path was known, and a run that was put away in the middle of a frame knows the frame.
#[test]
fn a_vehicle_that_is_told_turns_and_is_saved() {
    for integrator in INTEGRATORS {
        let mut setup = cart(integrator(), 0.1);
        setup.path = VehiclePath::live(rolling());
        let model = Model::new(setup).unwrap();
        let mut known = cart(integrator(), 0.1);
        known.path = VehiclePath::own(Turning);
        let known = Model::new(known).unwrap();
        let (mut run, mut own) = (Run::new(&model), Run::new(&known));
        for frame in 1..=10 {
            let until_s = 4e-3 * f64::from(frame);
            run.push(until_s, &VehicleInput::State(Turning.at(until_s))).unwrap();
            run.advance_to(until_s - 1.7e-3).unwrap();
            let mut loaded = Run::load(&model, &run.save().unwrap()).unwrap();
            run.advance_to(until_s).unwrap();
            loaded.advance_to(until_s).unwrap();
            let [own, other] = [&run, &loaded].map(|run| run.state().numbers().to_vec());
            assert_eq!(own, other);
            run = loaded;
        }
        let vehicle = run.vehicle();
        assert!((vehicle.angular_velocity_rad_s.z + 3.0 * 0.04).abs() < 1e-12, "space axes have Z up");
        let yaw_rad = run.look(|sample| sample.vehicle_pose.attitude.yaw_rad).unwrap();
        assert!((yaw_rad - 1.5 * 0.04 * 0.04).abs() < 1e-12);
        own.advance_to(0.04).unwrap();
        let apart = own.state().numbers().iter().zip(run.state().numbers());
        let apart = apart.take(3).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-6, "{apart} m");
        let [told_j, known_j] = [&mut run, &mut own].map(|run| run.look(|s| s.energy.balance_j).unwrap());
        assert!((told_j - known_j).abs() < 1e-3, "{told_j} and {known_j} J");
    }
}
