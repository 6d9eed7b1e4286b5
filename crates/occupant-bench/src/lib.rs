//! Case of the benchmarks and the helper programs: one car, one occupant, one instant with a realistic number of contacts.
//!
//! Three sizes of the same problem: *bare* (the skeleton under given loads), *held* (joint moments and belts as well), *full*
//! (all 17 × 25 contact pairs as well).

#![allow(clippy::missing_panics_doc, reason = "its scenes are valid")]

use occupant_core::forces::contact::{ContactSystem, Touch};
use occupant_core::forces::{History, Memory, Observer};
use occupant_core::kernel::{Scratch, Situation, System};
use occupant_core::model::Model;
use occupant_core::motion::dynamics::{self, Accelerations, Wrench};
use occupant_core::motion::frame::Frames;
use occupant_core::motion::integrate::rk4::{self, Stage, Stages};
use occupant_core::motion::kinematics::Kinematics;
use occupant_core::motion::layout::MOST_SEGMENTS;
use occupant_core::motion::state::{State, Work};
use occupant_core::vehicle::PathCursor;
use occupant_scenario::{Draft, Format, Loaded, Scenario};

/// The scenario's text.
pub const TEXT: &str = include_str!("../car.toml");

/// A driver in a three-point belt, as shipped.
pub const BELTED: &str = include_str!("../../../tests/data/hand/three-point.toml");

/// A driver with belt and air bag, as shipped.
pub const BAGGED: &str = include_str!("../../../tests/data/hand/airbag-driver.toml");

/// The same with a collapsing column, as shipped.
pub const STROKING: &str = include_str!("../../../tests/data/hand/column-driver.toml");

/// A person of 19 segments on a sled, as shipped.
pub const SLED: &str = include_str!("../../../scenarios/sled-person.toml");

/// Timed instant of the crash with air bag, s: the bag is full, head and chest press on it, gas flows in and out.
pub const PRESSED_S: f64 = 0.058;

/// Timed instant of that crash, s: the limiter pays out, webbing slides over the rings.
pub const LIMITED_S: f64 = 0.06;

const SOLIDS: &str = include_str!("../../../tests/data/hand/cabin.toml");

/// Solids of that car far from the driver.
const LEFT_OUT: [&str; 9] = [
    "left_window",
    "right_window",
    "left_front_pillar",
    "right_front_pillar",
    "left_middle_pillar",
    "right_middle_pillar",
    "right_door",
    "roof",
    "rear_end",
];

/// Step of the integrator, s.
pub const STEP_S: f64 = 1e-4;

/// Timed instant of the crash, s: belts taut, seven pairs on seat, floor and wheel in contact.
pub const TOUCHING_S: f64 = 0.09;

fn no_file(name: &str) -> Result<Vec<u8>, String> {
    Err(format!("{name}: the scene has no file beside it"))
}

/// The scenario, read and checked.
pub fn load() -> Loaded {
    read(TEXT)
}

fn read(text: &str) -> Loaded {
    Scenario::from_text(text, Format::Toml, "car.toml", &no_file).expect("the scene is valid")
}

/// The model.
pub fn model() -> Model {
    load().model().expect("the scene is valid").0
}

/// The driver in a three-point belt.
pub fn belted() -> Model {
    read(BELTED).model().expect("the scene is valid").0
}

/// The driver with belt and air bag.
pub fn bagged() -> Model {
    read(BAGGED).model().expect("the scene is valid").0
}

/// The person on the sled.
pub fn sled() -> Model {
    read(SLED).model().expect("the scene is valid").0
}

/// The driver with a collapsing column.
pub fn stroking() -> Model {
    read(STROKING).model().expect("the scene is valid").0
}

/// The driver of `occupant new` among 15 of the solids of his car, with these changes.
pub fn model_among_solids(set: &[&str]) -> Model {
    let mut draft = Draft::read(SOLIDS, Format::Toml, "driver.toml").expect("the scene is valid");
    let left_out = LEFT_OUT.iter().map(|solid| format!("solids.{solid}=null"));
    let words = set.iter().map(|word| (*word).to_owned()).chain(left_out);
    words.for_each(|word| draft.set(&word).expect("the scene is valid"));
    draft.load(&no_file).and_then(|loaded| loaded.model()).expect("the scene is valid").0
}

/// Models for a sweep: all different, all of one structure.
pub fn models(count: usize) -> Vec<Model> {
    let (setup, _) = load().build().expect("the scene is valid");
    let model = |i: usize| {
        let mut setup = setup.clone();
        let scale = 1.0 + 0.02 * i as f64;
        for material in &mut setup.materials {
            material.force.bilinear_mut().expect("the scene has springs").k1_n_per_m *= scale;
        }
        for belt in &mut setup.belts {
            belt.webbing.k1_n_per_m /= scale;
        }
        Model::new(setup).expect("the scene is valid")
    };
    (0..count).map(model).collect()
}

/// A system with its occupant at one instant of the crash.
#[derive(Clone)]
pub struct Instant {
    /// Skeleton, contacts, joints, belts.
    pub system: System<f64>,
    /// The body's motion.
    pub state: State<f64>,
    /// Motion of space and of the vehicle.
    pub frames: Frames<f64>,
    /// Stored state of contacts and belts.
    pub history: History<f64>,
    scratch: Scratch<f64>,
    stages: Stages<f64>,
    rate: State<f64>,
}

impl Instant {
    /// The scene at `time_s` of the crash, with every contact and belt.
    pub fn full(model: &Model, time_s: f64) -> Instant {
        let (mut cursor, start) = (PathCursor::default(), model.start());
        let mut now = Instant {
            system: model.system().clone(),
            state: start.state,
            frames: model.frames(0.0, 0.0, &mut cursor),
            history: start.history.clone(),
            scratch: Scratch::blank(model.system()),
            stages: Stages::new(start.state.shape()),
            rate: start.state,
        };
        for i in 0..(time_s / STEP_S).round() as usize {
            let t = i as f64 * STEP_S;
            now.frames = model.frames(t, t + 0.5 * STEP_S, &mut cursor);
            now.state = *now.step();
        }
        now.frames = model.frames(time_s, time_s + 0.5 * STEP_S, &mut cursor);
        now.commit();
        now
    }

    /// The same instant without surfaces.
    pub fn held(&self) -> Instant {
        let mut now = self.clone();
        now.system.forces.contacts = ContactSystem::default();
        let memory = Memory { contacts: Vec::new(), ..self.history.memory.clone() };
        now.history = History::new(&now.system.forces, memory);
        now
    }

    /// The same instant without belts over several nodes.
    pub fn unbelted(&self) -> Instant {
        let mut now = self.clone();
        now.system.forces.chains = Vec::new();
        let memory = Memory { chains: Vec::new(), ..self.history.memory.clone() };
        now.history = History::new(&now.system.forces, memory);
        now.commit();
        now
    }

    /// The same without air bags.
    pub fn without_bags(&self) -> Self {
        let mut now = self.clone();
        now.system.forces.bags = Vec::new();
        let memory = Memory { bags: Vec::new(), ..self.history.memory.clone() };
        now.history = History::new(&now.system.forces, memory);
        now.commit();
        now
    }

    /// The rate of change, with the history committed.
    pub fn commit(&mut self) -> &State<f64> {
        let Instant { system, state, frames, history, scratch, rate, .. } = self;
        system.rate_alone(scratch, Situation::accepted(state, frames), history, &mut (), rate);
        rate
    }

    /// The rate of change within a step.
    pub fn rate(&mut self) -> &State<f64> {
        let Instant { system, state, frames, history, scratch, rate, .. } = self;
        system.rate_alone(scratch, Situation::within(state, frames), history, &mut (), rate);
        rate
    }

    /// The skeleton alone: accelerations under given loads, the output of an articulated-body algorithm.
    pub fn bare(&self, loads: &[Wrench<f64>; MOST_SEGMENTS]) -> Accelerations<f64> {
        let skeleton = &self.system.skeleton;
        let kinematics = Kinematics::new(skeleton, &self.state);
        dynamics::solve(skeleton, &kinematics, self.state.hinge_rate(), loads)
    }

    /// One step in a vehicle at rest: four evaluations and the sums of the integrator.
    pub fn step(&mut self) -> &State<f64> {
        let Instant { system, state, frames, history, scratch, stages, .. } = self;
        stages.step(state, STEP_S, |stage, state, rate| match stage {
            Stage::Start => system.rate_alone(scratch, Situation::accepted(state, frames), history, &mut (), rate),
            Stage::Middle | Stage::End => {
                system.rate_alone(scratch, Situation::within(state, frames), history, &mut (), rate)
            }
        })
    }

    /// A step of the skeleton alone under given loads.
    pub fn bare_step(&self, loads: &[Wrench<f64>; MOST_SEGMENTS]) -> State<f64> {
        let skeleton = &self.system.skeleton;
        rk4::step(&self.state, STEP_S, |_, state, rate| {
            let kinematics = Kinematics::new(skeleton, state);
            let motion = dynamics::solve(skeleton, &kinematics, state.hinge_rate(), loads);
            *rate = motion.rate(&skeleton.layout, state, &[Work::zero()]);
        })
    }

    /// Number of pairs that exert a force.
    pub fn touches(&mut self) -> usize {
        let mut count = Count(0);
        self.system.rate(Situation::within(&self.state, &self.frames), &mut self.history, &mut count);
        count.0
    }
}

/// No load on any segment.
pub fn no_loads() -> [Wrench<f64>; MOST_SEGMENTS] {
    [Wrench::zero(); MOST_SEGMENTS]
}

struct Count(usize);

impl Observer<f64> for Count {
    fn contacts(&mut self, _touch: &Touch<f64>) {
        self.0 += 1;
    }
}
