//! A state in the coordinates of a tree of relative joints: MuJoCo's qpos, qvel and qacc of a free joint, ball joints and
//! hinges, segments depth first.
//!
//! Root: place, quaternion; velocity in space axes, angular velocity in its own. Ball: quaternion from parent to child;
//! angular velocity relative to the parent in the child's axes. Hinge: angle about Y.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use occupant_bench::Instant;
use occupant_core::body::SEGMENTS;
use occupant_core::body::tti12::TTI12;
use occupant_core::model::Model;
use occupant_core::motion::dynamics::Accelerations;
use occupant_core::motion::frame::{Moving, VEHICLE};
use occupant_core::motion::layout::Layout;
use occupant_core::motion::state::{Quat, State};
use occupant_core::motion::vector::V3;

/// Segment that carries each segment: the middle torso carries the upper one at the common root.
pub const PARENTS: [Option<usize>; SEGMENTS] =
    [None, Some(0), Some(1), Some(0), Some(1), Some(1), Some(4), Some(5), Some(3), Some(3), Some(8), Some(9)];

/// Segments depth first.
pub const ORDER: [usize; SEGMENTS] = [0, 1, 2, 4, 6, 5, 7, 3, 8, 10, 9, 11];

/// The limb whose lower segment `n` is.
pub fn limb(n: usize) -> Option<usize> {
    Layout::of(&TTI12).hinge_slot(n)
}

/// The instants that models are set to.
pub struct Placed {
    /// The scenario's start.
    pub start: Instant,
    /// The chosen instant.
    pub then: Instant,
    /// The same with every angular velocity raised, so that gyroscopic terms weigh as much as gravity.
    pub spun: Instant,
}

impl Placed {
    /// The start, the instant `instant_s`, and that spun.
    pub fn all(model: &Model, instant_s: f64) -> Placed {
        let mut start = Instant::full(model, 0.0);
        let mut then = Instant::full(model, instant_s);
        let home = start.frames[VEHICLE];
        for now in [&mut start, &mut then] {
            now.state = seen_from_vehicle(&now.state, &now.frames[VEHICLE], &home);
        }
        let mut spun = then.clone();
        for slot in spun.state.turns() {
            let i = slot as f64;
            let more = V3::of(&Vector3::new(3.0 - i, 2.0 * i - 5.0, 4.0 - 0.7 * i));
            spun.state.set_omega(slot, spun.state.omega(slot) + more);
        }
        Placed { start, then, spun }
    }
}

/// `state` as seen from the moving `vehicle`, in a vehicle that is at rest at `home`.
fn seen_from_vehicle(state: &State<f64>, vehicle: &Moving<f64>, home: &Moving<f64>) -> State<f64> {
    let carry = |v: V3<f64>| home.axes.out(vehicle.axes.into_frame(v));
    let turn = home.axes.to_matrix() * vehicle.axes.to_matrix().transpose();
    let turn = UnitQuaternion::from_matrix(&turn);
    let mut seen = *state;
    seen.set_t1(home.origin + carry(state.t1() - vehicle.origin));
    seen.set_velocity(carry(state.velocity() - vehicle.velocity_at(state.t1())));
    for slot in state.turns() {
        let turned = turn.into_inner() * quaternion(&state.orientation(slot));
        seen.set_orientation(slot, Quat { w: turned.w, v: V3::of(&turned.imag()) });
        seen.set_omega(slot, carry(state.omega(slot) - vehicle.omega));
    }
    seen
}

/// Place of the orientation of segment `n`.
fn free_slot(n: usize) -> usize {
    Layout::of(&TTI12).free_slot(n).expect("a free segment")
}

fn quaternion(q: &Quat<f64>) -> Quaternion<f64> {
    Quaternion::from_parts(q.w, q.v.to_vector())
}

/// Turn of a free segment.
fn turn(state: &State<f64>, n: usize) -> UnitQuaternion<f64> {
    UnitQuaternion::from_quaternion(quaternion(&state.orientation(free_slot(n))))
}

fn push(numbers: &mut Vec<f64>, v: Vector3<f64>) {
    numbers.extend(v.iter());
}

/// q.
pub fn positions(state: &State<f64>) -> Vec<f64> {
    let mut q = Vec::new();
    for n in ORDER {
        if let Some(limb) = limb(n) {
            q.push(state.hinge()[limb]);
            continue;
        }
        let relative = match PARENTS[n] {
            Some(parent) => turn(state, parent).inverse() * turn(state, n),
            None => {
                push(&mut q, state.t1().to_vector());
                turn(state, n)
            }
        };
        q.extend([relative.w, relative.i, relative.j, relative.k]);
    }
    q
}

/// v.
pub fn speeds(state: &State<f64>) -> Vec<f64> {
    let omega = |n: usize| state.omega(free_slot(n)).to_vector();
    let mut v = Vec::new();
    for n in ORDER {
        if let Some(limb) = limb(n) {
            v.push(state.hinge_rate()[limb]);
            continue;
        }
        let mut relative = omega(n);
        match PARENTS[n] {
            Some(parent) => relative -= omega(parent),
            None => push(&mut v, state.velocity().to_vector()),
        }
        push(&mut v, turn(state, n).inverse() * relative);
    }
    v
}

/// v̇ for the accelerations of the segments: d/dt of Rᵀ(ω − ω_p) is Rᵀ(α − α_p + ω × ω_p).
pub fn rates(state: &State<f64>, motion: &Accelerations<f64>) -> Vec<f64> {
    let omega = |n: usize| state.omega(free_slot(n)).to_vector();
    let alpha = |n: usize| motion.alpha[n].to_vector();
    let mut rates = Vec::new();
    for n in ORDER {
        if let Some(limb) = limb(n) {
            rates.push(motion.hinge[limb]);
            continue;
        }
        let mut relative = alpha(n);
        match PARENTS[n] {
            Some(parent) => relative += omega(n).cross(&omega(parent)) - alpha(parent),
            None => push(&mut rates, motion.joint[0].to_vector()),
        }
        push(&mut rates, turn(state, n).inverse() * relative);
    }
    rates
}
