//! The simulator's own answer to the reference's questions.

use crate::{
    reference::{SpaceMotion, System},
    space_state::SpaceState,
};
use nalgebra::Vector3;
use occupant_core::body::SEGMENTS;
use occupant_core::forces::joint::JointSystem;
use occupant_core::motion::dynamics;
use occupant_core::motion::dynamics::Accelerations;
use occupant_core::motion::dynamics::Wrench;
use occupant_core::motion::kinematics::Kinematics;
use occupant_core::motion::layout::FREE;
use occupant_core::motion::skeleton::Skeleton;
use occupant_core::motion::state::Quat;
use occupant_core::motion::state::State;
use occupant_core::motion::vector::V3;
use occupant_core::motion::vector::v3;

impl SpaceState {
    /// As the simulator's state.
    pub fn to_core(&self) -> State<f64> {
        State {
            t1: V3::of(&self.t1),
            orientation: self.turn.map(|q| Quat { w: q.w, v: v3(q.i, q.j, q.k) }),
            hinge: self.hinge,
            velocity: V3::of(&self.speed.t1),
            omega: self.speed.angular.map(|w| V3::of(&w)),
            hinge_rate: self.speed.hinge,
            ..State::zero()
        }
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
        let joints = JointSystem::new(&system.joints, &[f64::NAN; 7]);
        let kinematics = Kinematics::new(&skeleton, &state);
        let mut wrench = external(system, &kinematics);
        let dissipated = joints.apply(&kinematics, &state, &mut wrench, &mut |_| {});
        let found = dynamics::solve(&skeleton, &kinematics, &state.hinge_rate, &wrench);
        let accelerations = SpaceMotion {
            t1: found.joint[0].to_vector(),
            angular: std::array::from_fn(|i| found.alpha[FREE[i]].to_vector()),
            hinge: found.hinge,
        };
        CoreSide { skeleton, joints, kinematics, dissipated, accelerations, segments: found }
    }
}

/// External forces, moments about each segment's proximal joint.
fn external(system: &System, kinematics: &Kinematics<f64>) -> [Wrench<f64>; SEGMENTS] {
    let mut wrench = [Wrench::zero(); SEGMENTS];
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
        let [ix, iy, iz] = link.central;
        linear += p;
        angular += (k.cg(body, n) - about).cross(p);
        angular += k.axes[n].out(V3 { x: ix * w.x, y: iy * w.y, z: iz * w.z });
    }
    (linear, angular)
}
