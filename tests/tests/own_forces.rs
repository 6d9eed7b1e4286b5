//! Forces that a program brings itself: they do what built-in ones do, energy balance and step control know them, and where
//! numbers are not plain they are refused by name.

use std::ops::ControlFlow;
use std::sync::Arc;

use nalgebra::{Point3, Vector3};
use occupant_core::body::Body;
use occupant_core::forces::contact::material::Material;
use occupant_core::forces::contact::surface::{Facing, Frame, Outline, Surface};
use occupant_core::forces::joint::Joints;
use occupant_core::forces::own::{Force, ForceChannel, OwnForce, Place, Pushes, Scene};
use occupant_core::forces::spring::BilinearSpring;
use occupant_core::model::Model;
use occupant_core::model::seating::InitialPosture;
use occupant_core::model::setup::{Integrator, Setup, SetupBuilder};
use occupant_core::motion::report_coordinates::{DOF, ReportCoordinates};
use occupant_core::results::channel::{Series, channels, find};
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::Run;
use occupant_core::run::batch::{Job, Kernel, simulate_many};
use occupant_core::run::simulate::simulate;
use occupant_core::vehicle::VehiclePath;
use occupant_study::sensitivity::{Built, Parameter};
use occupant_units::unit::Unit;

const RK4: Integrator = Integrator::Rk4 { step_s: 1e-4 };
const STIFFNESS_N_M: f64 = 2e4;

/// A floor at z = 0 that pushes every sphere straight up by what it is deep in it.
#[derive(Debug)]
struct Floor {
    radius_m: Vec<f64>,
}

impl Force for Floor {
    fn apply(&self, scene: &Scene<'_>, _memory: &[f64], pushes: &mut Pushes<'_, '_>) {
        let mut deepest_m = 0.0_f64;
        for (i, radius_m) in self.radius_m.iter().enumerate() {
            let depth_m = radius_m - scene.motion(&Place::Sphere(i)).place_m.z;
            if depth_m > 0.0 {
                pushes.force(&Place::Sphere(i), Vector3::z() * (STIFFNESS_N_M * depth_m));
                pushes.stored_j(0.5 * STIFFNESS_N_M * depth_m * depth_m);
            }
            deepest_m = deepest_m.max(depth_m);
        }
        pushes.show(0, deepest_m);
    }

    fn channels(&self) -> Vec<ForceChannel> {
        vec![ForceChannel::new("depth", Unit::Metre)]
    }
}

/// Resists the motion of a point, and remembers the latest step that it has seen and how fast it has been.
#[derive(Debug)]
struct Drag(Place, f64);

impl Force for Drag {
    fn apply(&self, scene: &Scene<'_>, _memory: &[f64], pushes: &mut Pushes<'_, '_>) {
        pushes.force(&self.0, scene.motion(&self.0).velocity_m_s * -self.1);
    }

    fn start(&self, _scene: &Scene<'_>) -> Vec<f64> {
        vec![0.0; 2]
    }

    fn accept(&self, scene: &Scene<'_>, memory: &mut [f64]) {
        memory[0] = memory[0].max(scene.time_s());
        memory[1] = memory[1].max(scene.motion(&self.0).velocity_m_s.norm());
    }
}

/// A body that falls 0.3 m.
fn falling(integrator: Integrator) -> SetupBuilder {
    let mut case = SetupBuilder::new("fall", Body::male50(), Joints::male50());
    case.setup.integrator = integrator;
    case
}

fn ended(case: SetupBuilder, end_s: f64) -> Setup {
    let mut q = [0.0; DOF];
    q[2] = 1.4;
    let posture = InitialPosture::Coordinates(Box::new(ReportCoordinates { q, rates: [0.0; DOF] }));
    case.build(VehiclePath::parked(), posture, end_s)
}

fn own_floor(integrator: Integrator) -> Setup {
    let mut case = falling(integrator);
    let radius_m = case.setup.body.spheres.iter().map(|sphere| sphere.radius_m).collect();
    case.force("floor", Floor { radius_m });
    ended(case, 0.5)
}

fn built_in_floor(integrator: Integrator) -> Setup {
    let mut case = falling(integrator);
    let material = case.material(Material::new("rubber", BilinearSpring::linear(STIFFNESS_N_M, 1.0), 0.0));
    let outline = Outline::Unbounded { point_m: Point3::origin(), axis: Vector3::z() };
    let (name, frame, facing) = ("floor".into(), Frame::Space, Facing::Order);
    case.surface(Surface { name, frame, outline, facing, material, spheres: None });
    ended(case, 0.5)
}

fn places(setup: Setup) -> Vec<Vector3<f64>> {
    let model = Model::new(setup).unwrap();
    let mut places = Vec::new();
    let look = |s: &Sample<'_>| places.extend((0..17).map(|i| s.sphere_centre_m(i).coords));
    let outcome = simulate(&model, Watch(look)).unwrap();
    assert!(outcome.energy.balance_error < 1e-5, "{:?}", outcome.energy);
    places
}

/// Measured: 2e-8 m after half a second.
#[test]
fn a_spring_of_ones_own_is_the_built_in_one() {
    let (own, built_in) = (places(own_floor(RK4)), places(built_in_floor(RK4)));
    assert!(own.len() > 8000 && own.len() == built_in.len());
    let worst = own.iter().zip(&built_in).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    assert!(worst < 1e-6, "{worst}");
}

/// What it has taken is what the body has lost: of a spring all of it is stored, of a damper none.
#[test]
fn the_energy_balance_counts_it() {
    let model = Model::new(own_floor(Integrator::default())).unwrap();
    let mut series = Series::new(
        ["energy.own_forces", "own_force.floor.taken", "own_force.floor.stored", "own_force.floor.depth"]
            .map(|name| find(&model, name).unwrap())
            .to_vec(),
    );
    let outcome = simulate(&model, &mut series).unwrap();
    assert!(outcome.energy.balance_error < 1e-6, "{:?}", outcome.energy);
    let [all, taken, stored, depth] = [0, 1, 2, 3].map(|i| &series.values[i]);
    let most = stored.iter().copied().fold(0.0, f64::max);
    assert!(most > 50.0 && depth.iter().any(|m| *m > 0.02));
    for i in 0..all.len() {
        assert_eq!(all[i], taken[i]);
        assert!((taken[i] - stored[i]).abs() < 1e-4 * most, "{} {} of {most}", taken[i], stored[i]);
    }
    let mut case = falling(Integrator::default());
    let chest = case.setup.body.sphere("chest").unwrap();
    case.force("drag", Drag(Place::Sphere(chest), 200.0));
    let model = Model::new(ended(case, 0.5)).unwrap();
    let mut lost = Series::new(vec![find(&model, "own_force.drag.taken").unwrap()]);
    let outcome = simulate(&model, &mut lost).unwrap();
    assert!(outcome.energy.balance_error < 1e-6, "{:?}", outcome.energy);
    assert!(lost.values[0].windows(2).all(|two| two[1] >= two[0]) && lost.values[0].last().unwrap() > &50.0);
}

/// A hundred thousand times the damping takes many times the steps: 524 for 63.
#[test]
fn the_step_control_sees_it() {
    let long = Integrator::Adaptive {
        relative: 1e-7,
        absolute_m: 1e-8,
        absolute_m_s: 1e-6,
        min_step_s: 1e-10,
        max_step_s: 2e-3,
    };
    let steps = |damping: f64| {
        let mut case = falling(long);
        let chest = case.setup.body.sphere("chest").unwrap();
        case.force("drag", Drag(Place::Sphere(chest), damping));
        let model = Model::new(ended(case, 0.1)).unwrap();
        simulate(&model, ()).unwrap().effort.steps
    };
    let (soft, stiff) = (steps(10.0), steps(1e6));
    assert!(stiff > 5 * soft, "{soft} and {stiff} steps");
}

/// It remembers accepted steps alone, and goes on from where it was put away.
#[test]
fn it_remembers_accepted_steps_and_is_saved() {
    let mut case = falling(Integrator::default());
    let chest = case.setup.body.sphere("chest").unwrap();
    case.force("drag", Drag(Place::Sphere(chest), 50.0));
    let model = Model::new(ended(case, 0.2)).unwrap();
    let mut run = Run::new(&model);
    run.advance_to(0.1003).unwrap();
    let mut other = Run::load(&model, &run.save().unwrap()).unwrap();
    for run in [&mut run, &mut other] {
        run.advance_to(0.2).unwrap();
    }
    assert_eq!(run.state().numbers(), other.state().numbers());
    let [own, loaded] = [&run, &other].map(|run| run.history().memory.own.clone());
    assert_eq!(own, loaded);
    assert!(own[0][0] > 0.19 && own[0][0] <= 0.2, "{} s", own[0][0]);
    assert!((own[0][1] - 9.80665 * 0.2).abs() < 0.2, "{}", own[0][1]);
}

/// Side by side with others it is run alone, to the same bits; a derivative is refused with its name.
#[test]
fn lanes_and_derivatives_are_refused_by_name() {
    let model = Model::new(own_floor(RK4)).unwrap();
    let alone = simulate(&model, ()).unwrap();
    for kernel in [Kernel::Scalar, Kernel::Lanes4, Kernel::Lanes8] {
        let jobs = (0..3).map(|tag| Job { tag, model: model.clone(), recorder: () });
        let mut count = 0;
        simulate_many(kernel, jobs, |ended| {
            assert_eq!((ended.kernel, ended.outcome.unwrap()), (Kernel::Scalar, alone.clone()));
            count += 1;
            ControlFlow::Continue(())
        });
        assert_eq!(count, 3);
    }
    let model_at = |gravity_m_s2: f64| {
        let mut setup = own_floor(RK4);
        setup.gravity_m_s2 = gravity_m_s2;
        Model::new(setup).map_err(|problems| problems.to_string())
    };
    let (name, unit) = ("gravity".to_owned(), "m/s^2".to_owned());
    let by = Parameter { name, unit, nominal: 9.80665, size: 9.80665, model_at: Box::new(model_at) };
    let error = Built::new(&model, &by).unwrap_err().to_string();
    assert!(error.contains("own forces"), "{error}");
}

/// Does whatever is worst.
#[derive(Debug, Default)]
struct Wild {
    start: Vec<f64>,
    channels: Vec<&'static str>,
    on: Option<Place>,
    force: [f64; 3],
}

impl Force for Wild {
    fn apply(&self, _scene: &Scene<'_>, _memory: &[f64], pushes: &mut Pushes<'_, '_>) {
        if let Some(on) = &self.on {
            pushes.force(on, self.force.into());
        }
        pushes.show(99, 1.0);
    }

    fn start(&self, _scene: &Scene<'_>) -> Vec<f64> {
        self.start.clone()
    }

    fn channels(&self) -> Vec<ForceChannel> {
        self.channels.iter().map(|name| ForceChannel::new(*name, Unit::One)).collect()
    }
}

#[test]
fn a_wild_force_is_refused_or_ends_its_run_with_words() {
    let with = |names: &[&str], wild: Wild| {
        let mut setup = ended(falling(Integrator::default()), 0.02);
        let force: Arc<dyn Force> = Arc::new(wild);
        setup.own_forces = names.iter().map(|name| OwnForce { name: (*name).into(), force: force.clone() }).collect();
        Model::new(setup).map_err(|problems| problems.to_string())
    };
    let many = (0..9).map(|i| format!("f{i}")).collect::<Vec<_>>();
    let many: Vec<&str> = many.iter().map(String::as_str).collect();
    let refused = [
        with(&[""], Wild::default()),
        with(&["My force"], Wild::default()),
        with(&["a", "a"], Wild::default()),
        with(&many, Wild::default()),
        with(&["a"], Wild { start: vec![0.0; 17], ..Wild::default() }),
        with(&["a"], Wild { start: vec![f64::NAN], ..Wild::default() }),
        with(&["a"], Wild { channels: vec!["x"; 2], ..Wild::default() }),
        with(&["a"], Wild { channels: vec!["force"], ..Wild::default() }),
        with(&["a"], Wild { channels: vec!["A b"], ..Wild::default() }),
        with(&["a"], Wild { channels: vec!["a", "b", "c", "d", "e", "f", "g", "h", "i"], ..Wild::default() }),
    ];
    for (i, model) in refused.into_iter().enumerate() {
        let words = model.map(|_| ()).expect_err(&i.to_string());
        assert!(words.contains("own_forces"), "{words}");
    }
    let body = Body::male50();
    let beyond = body.tree.segment(99);
    let lost = [Place::Sphere(999), Place::Segment(beyond, Point3::origin())];
    let wild = lost.map(|on| Wild { on: Some(on), force: [1.0; 3], ..Wild::default() });
    let none = Wild { on: Some(Place::Sphere(0)), force: [f64::NAN; 3], ..Wild::default() };
    for wild in wild.into_iter().chain([none]) {
        let model = with(&["a"], wild).unwrap();
        assert!(simulate(&model, ()).is_err());
    }
    // nothing at all, and a push against a frame that there is not: neither moves the body
    for on in [None, Some(Place::Frame(Frame::Vehicle, Point3::origin()))] {
        let model = with(&["a"], Wild { on, force: [1.0; 3], ..Wild::default() }).unwrap();
        assert!(simulate(&model, ()).unwrap().energy.balance_error < 1e-6);
        assert!(channels(&model).iter().any(|channel| channel.name == "own_force.a.taken"));
    }
}
