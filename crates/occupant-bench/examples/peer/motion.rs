//! Our own motion of the body without contacts, belts and moments in its ball joints, with the hinges' dampers: physics
//! that every engine states alike.

use occupant_bench::{self as scene, Instant};
use occupant_core::body::SEGMENTS;
use occupant_core::body::tti12::TTI12;
use occupant_core::forces::joint::JointSystem;
use occupant_core::forces::joint::{HingeJoint, JointLaw, Joints};
use occupant_core::forces::{Forces, History, Memory};
use occupant_core::kernel::Situation;
use occupant_core::model::Model;
use occupant_core::motion::frame::VEHICLE;
use occupant_core::motion::integrate::rk4;
use occupant_core::motion::kinematics::Kinematics;
use occupant_core::motion::state::State;
use occupant_core::motion::vector::V3;
use occupant_core::vehicle::PathCursor;
use serde_json::{Value, json};

use crate::coordinates::{ORDER, PARENTS, limb, positions, rates, speeds};
use crate::mjcf::{inertia, place};

/// Length of the motion that is compared, its step and the interval of its places, s.
const LENGTH_S: f64 = 0.25;
const STEP_S: f64 = 5e-5;
const STEPS_PER_PLACE: usize = 200;

/// Body, state, accelerations and motion from `now` on, and what the vehicle does, as JSON.
pub fn describe(model: &Model, now: &Instant) -> Value {
    let accelerations = now.bare(&scene::no_loads());
    let bodies: Vec<Value> = ORDER.iter().map(|&n| body(model, now, n)).collect();
    json!({
        "gravity": now.system.skeleton.gravity,
        "bodies": bodies,
        "q": positions(&now.state),
        "v": speeds(&now.state),
        "acceleration": rates(&now.state, &accelerations),
        "interval": STEPS_PER_PLACE as f64 * STEP_S,
        "places": places(model, now),
        "vehicle": vehicle(model),
        "belts": model.system().forces.belts.iter().map(|belt| belt.rest_length).collect::<Vec<_>>(),
    })
}

/// Constants of segment `n`, for engines that are built joint by joint.
fn body(model: &Model, now: &Instant, n: usize) -> Value {
    let link = &now.system.skeleton.links[n];
    json!({
        "parent": PARENTS[n].map(|parent| ORDER.iter().position(|&o| o == parent)),
        "hinge": limb(n).is_some(),
        "place": place(now, n),
        "mass": link.mass,
        "cg": link.cg.z,
        "far": far_m(model, n),
        "inertia": inertia(model, n),
    })
}

/// Both ends of every segment, in [`ORDER`], at every interval.
fn places(model: &Model, now: &Instant) -> Vec<Vec<[f64; 3]>> {
    let mut now = alone(model, now);
    let steps = (LENGTH_S / STEP_S).round() as usize;
    let mut found = vec![ends(model, &now)];
    for i in 1..=steps {
        let (system, frames, history) = (&now.system, &now.frames, &mut now.history);
        now.state = rk4::step(&now.state, STEP_S, |_, state, rate| {
            *rate = system.rate(Situation::within(state, frames), history, &mut ())
        });
        if i.is_multiple_of(STEPS_PER_PLACE) {
            found.push(ends(model, &now));
        }
    }
    found
}

/// The body with nothing but its hinges' dampers.
fn alone(model: &Model, now: &Instant) -> Instant {
    let setup = model.setup();
    let mut joints = Joints::free(setup.body.tree).with_epsilon(setup.joints.epsilon);
    for (joint, law) in setup.joints.iter() {
        if let JointLaw::Hinge(HingeJoint { damping_n_m_s, .. }) = *law {
            joints = joints.with(joint, HingeJoint { damping_n_m_s, ..HingeJoint::default() });
        }
    }
    let mut now = now.held();
    let joints = JointSystem::new(&joints, &now.system.skeleton, |_| 0.0);
    now.system.forces = Forces { joints, ..Forces::none() };
    now.history = History::new(&now.system.forces, Memory::none());
    now
}

/// Z of the far end of segment `n`, seen from its joint, m.
fn far_m(model: &Model, n: usize) -> f64 {
    let segment = TTI12.segment(n);
    let length_m = model.body().segment(segment).length_m;
    if TTI12[segment].hangs() { -length_m } else { length_m }
}

fn ends(model: &Model, now: &Instant) -> Vec<[f64; 3]> {
    let (skeleton, state): (_, &State<f64>) = (&now.system.skeleton, &now.state);
    let k = Kinematics::new(skeleton, state);
    let list = |v: V3<f64>| [v.x, v.y, v.z];
    let ends = |&n: &usize| {
        let far = k.joint[n] + k.axes[n].z * far_m(model, n);
        [list(k.joint[n]), list(far)]
    };
    debug_assert_eq!(ORDER.len(), SEGMENTS);
    ORDER.iter().flat_map(ends).collect()
}

/// Mean acceleration of the vehicle in every millisecond of the scenario, space axes, and the largest turn of its axes.
fn vehicle(model: &Model) -> Value {
    let time = &model.setup().time;
    let mut cursor = PathCursor::default();
    let count = ((time.end_s - time.start_s) * 1e3).round() as usize;
    let mut frame = |i: usize| {
        let t = (time.start_s + i as f64 * 1e-3).min(time.end_s);
        model.frames(t, t, &mut cursor)[VEHICLE]
    };
    let frames: Vec<_> = (0..=count).map(&mut frame).collect();
    let accelerations = frames.windows(2).map(|pair| {
        let a = (pair[1].velocity - pair[0].velocity) * 1e3;
        [a.x, a.y, a.z]
    });
    let turns = frames.iter().map(|f| f.omega.norm_squared().sqrt());
    json!({
        "acceleration": accelerations.collect::<Vec<_>>(),
        "greatest_turn": turns.fold(0.0, f64::max),
    })
}
