//! Where every segment is and how it moves: derived from the state, overwritten at every evaluation.
//!
//! Report: "Body Geometry and Coordinate Systems". Every joint is T1 plus constant multiples of Y and Z of the
//! segments; all vectors are in space axes.

use crate::body::SEGMENTS;
use crate::motion::layout::{FREE, HUNG, LIMBS, ROOTS};
use crate::motion::scalar::Scalar;
use crate::motion::skeleton::Skeleton;
use crate::motion::state::{Quat, State};
use crate::motion::vector::{M3, V3, v3};

/// Derived motion of all segments.
#[derive(Clone, Copy, Debug)]
pub struct Kinematics<S> {
    /// Axes X, Y, Z of each segment as columns.
    pub axes: [M3<S>; SEGMENTS],
    /// Absolute angular velocity.
    pub omega: [V3<S>; SEGMENTS],
    /// Proximal joint: T1 for segments 1 and 2.
    pub joint: [V3<S>; SEGMENTS],
    /// Its velocity.
    pub joint_velocity: [V3<S>; SEGMENTS],
    /// sin α and cos α of the lower segment of each limb.
    pub hinge_sin_cos: [(S, S); LIMBS.len()],
}

impl<S: Scalar> Kinematics<S> {
    /// Kinematics of `state`.
    #[inline(always)]
    pub fn new(body: &Skeleton<S>, state: &State<S>) -> Self {
        let mut k = Kinematics::blank();
        k.follow(body, state);
        k
    }

    /// Of nothing yet.
    #[inline(always)]
    pub(crate) fn blank() -> Self {
        Kinematics {
            axes: [M3::identity(); SEGMENTS],
            omega: [V3::zero(); SEGMENTS],
            joint: [V3::zero(); SEGMENTS],
            joint_velocity: [V3::zero(); SEGMENTS],
            hinge_sin_cos: [(S::zero(), S::one()); LIMBS.len()],
        }
    }

    /// Becomes the kinematics of `state`.
    #[inline(always)]
    pub(crate) fn follow(&mut self, body: &Skeleton<S>, state: &State<S>) {
        for &n in ROOTS {
            (self.joint[n], self.joint_velocity[n]) = (state.t1, state.velocity);
        }
        for (slot, &n) in FREE.iter().enumerate() {
            self.axes[n] = axes(&state.orientation[slot]);
            self.omega[n] = state.omega[slot];
        }
        for (limb, &(upper, lower)) in LIMBS.iter().enumerate() {
            self.turn_hinge(limb, upper, lower, state);
        }
        self.place_joints(body);
    }

    /// X_j = R_y(α) X_m (8) for the lower segment m of a limb on its upper segment j, and its angular velocity.
    #[inline(always)]
    fn turn_hinge(&mut self, limb: usize, upper: usize, lower: usize, state: &State<S>) {
        let (s, c) = state.hinge[limb].sin_cos();
        let M3 { x, y, z } = self.axes[upper];
        self.hinge_sin_cos[limb] = (s, c);
        // T^nm = Tⁿ R_y(α) (9), (10) by columns: from those of Tⁿ X_m = c X_j − s Z_j and Z_m = s X_j + c Z_j (11)
        self.axes[lower] = M3 { x: x * c - z * s, y, z: x * s + z * c };
        self.omega[lower] = self.omega[upper] + y * state.hinge_rate[limb]; // (45), in space axes
    }

    /// Joints from the root outwards, each at (0, y, z) of the segment that carries it.
    #[inline(always)]
    fn place_joints(&mut self, body: &Skeleton<S>) {
        for &(child, parent) in HUNG {
            let (axes, link) = (&self.axes[parent], &body.links[child]);
            let offset = axes.y * link.joint_y + axes.z * link.joint_z;
            self.joint[child] = self.joint[parent] + offset;
            self.joint_velocity[child] = self.joint_velocity[parent] + self.omega[parent].cross(offset);
        }
    }

    /// Centre of gravity of segment `n`; (13) is that of segment 1, (14) that of segment 8.
    #[inline(always)]
    pub fn cg(&self, body: &Skeleton<S>, n: usize) -> V3<S> {
        // segments 1 to 12: (15), (16), (17), (18), (19), (20), (21), (22), (23), (24), (25), (26)
        self.joint[n] + self.axes[n].z * body.links[n].cg
    }

    /// Velocity of the centre of gravity of segment `n`.
    #[inline(always)]
    pub fn cg_velocity(&self, body: &Skeleton<S>, n: usize) -> V3<S> {
        // its square is, for segments 1 to 12: (27), (28), (29), (30), (31), (32), (33), (34), (35), (36), (37), (38)
        self.joint_velocity[n] + self.omega[n].cross(self.axes[n].z * body.links[n].cg)
    }
}

/// Axes of the frame that a quaternion turns to; it need not be of unit length.
#[inline(always)]
pub fn axes<S: Scalar>(q: &Quat<S>) -> M3<S> {
    let one = S::one();
    let k = S::of(2.0) / q.norm_squared();
    let (x, y, z) = (q.v.x, q.v.y, q.v.z);
    let (kx, ky, kz) = (k * x, k * y, k * z);
    let (wx, wy, wz) = (q.w * kx, q.w * ky, q.w * kz);
    let (xx, yy, zz) = (x * kx, y * ky, z * kz);
    let (xy, xz, yz) = (x * ky, x * kz, y * kz);
    M3 {
        x: v3(one - yy - zz, xy + wz, xz - wy),
        y: v3(xy - wz, one - xx - zz, yz + wx),
        z: v3(xz + wy, yz - wx, one - xx - yy),
    }
}
