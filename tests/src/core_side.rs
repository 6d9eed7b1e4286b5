//! The simulator's own answer to the reference's questions.

use crate::{
    reference::{SpaceMotion, System},
    space_state::SpaceState,
};
use nalgebra::Vector3;
use occupant_core::body::tti12::TTI12;
use occupant_core::forces::joint::{DAMPING, JointSystem};
use occupant_core::motion::dynamics;
use occupant_core::motion::dynamics::Accelerations;
use occupant_core::motion::dynamics::Wrench;
use occupant_core::motion::kinematics::Kinematics;
use occupant_core::motion::layout::{Layout, MOST_SEGMENTS};
use occupant_core::motion::skeleton::Skeleton;
use occupant_core::motion::state::Quat;
use occupant_core::motion::state::{Shape, State};
use occupant_core::motion::vector::V3;
use occupant_core::motion::vector::v3;

impl SpaceState {
    /// As the simulator's state.
    pub fn to_core(&self) -> State<f64> {
        let mut state = State::zero(Shape::of(&Layout::of(&TTI12)));
        state.set_t1(V3::of(&self.t1));
        state.set_velocity(V3::of(&self.speed.t1));
        for (slot, (q, w)) in self.turn.iter().zip(&self.speed.angular).enumerate() {
            state.set_orientation(slot, Quat { w: q.w, v: v3(q.i, q.j, q.k) });
            state.set_omega(slot, V3::of(w));
        }
        state.hinge_mut().copy_from_slice(&self.hinge);
        state.hinge_rate_mut().copy_from_slice(&self.speed.hinge);
        state
    }
}

/// What the simulator's kernel derives from one state.
pub struct CoreSide {
    /// Constants.
    pub skeleton: Skeleton<f64>,
    /// Joint laws.
    pub joints: JointSystem<f64>,
    /// Places and velocities.
    pub kinematics: Kinematics<f64>,
    /// Power that the joints dissipate.
    pub dissipated: f64,
    /// Accelerations of the degrees of freedom.
    pub accelerations: SpaceMotion,
    /// Accelerations of all segments.
    pub segments: Accelerations<f64>,
}

impl CoreSide {
    /// Gravity must point along −Z'.
    pub fn new(system: &System, state: &SpaceState) -> CoreSide {
        assert_eq!(system.gravity.xy().norm(), 0.0);
        let state = state.to_core();
        let skeleton = Skeleton::new(&system.body, -system.gravity.z);
        let joints = JointSystem::new(&system.joints, &skeleton, |_| f64::NAN);
        let kinematics = Kinematics::new(&skeleton, &state);
        let mut wrench = external(system, &kinematics);
        let by_joints = joints.loads(&kinematics, &state, &skeleton.layout);
        for (sum, own) in wrench.iter_mut().zip(&by_joints.wrench) {
            sum.moment += own.moment;
        }
        let dissipated = by_joints.power[0].sums[DAMPING];
        let found = dynamics::solve(&skeleton, &kinematics, state.hinge_rate(), &wrench);
        let accelerations = SpaceMotion::of_core(&found);
        CoreSide { skeleton, joints, kinematics, dissipated, accelerations, segments: found }
    }
}

impl SpaceMotion {
    /// From the simulator's accelerations.
    pub fn of_core(found: &Accelerations<f64>) -> SpaceMotion {
        let free = Layout::of(&TTI12).free().to_vec();
        SpaceMotion {
            t1: found.joint[0].to_vector(),
            angular: std::array::from_fn(|i| found.alpha[free[i]].to_vector()),
            hinge: std::array::from_fn(|i| found.hinge[i]),
        }
    }
}

/// External forces, moments about each segment's proximal joint.
fn external(system: &System, kinematics: &Kinematics<f64>) -> [Wrench<f64>; MOST_SEGMENTS] {
    let mut wrench = [Wrench::zero(); MOST_SEGMENTS];
    for f in &system.forces {
        let n = f.segment.index();
        let upper_end = Vector3::z() * system.body.segment(f.segment).length_m;
        let from_joint = if system.body.tree[f.segment].hangs() { f.point - upper_end } else { f.point };
        let (arm, force) = (kinematics.axes[n].out(V3::of(&from_joint)), V3::of(&f.force));
        wrench[n].force += force;
        wrench[n].moment += arm.cross(force);
    }
    wrench
}

/// Σ M v and Σ (M (x − about) × v + I ω), space axes: kg·m/s and kg·m²/s.
pub fn momentum(body: &Skeleton<f64>, k: &Kinematics<f64>, about: V3<f64>) -> (V3<f64>, V3<f64>) {
    let (mut linear, mut angular) = (V3::zero(), V3::zero());
    for (n, link) in body.links.iter().enumerate() {
        let p = k.cg_velocity(body, n) * link.mass;
        let w = k.axes[n].into_frame(k.omega[n]);
        linear += p;
        angular += (k.cg(body, n) - about).cross(p);
        angular += k.axes[n].out(link.by_inertia(w));
    }
    (linear, angular)
}
