//! Position and motion of every segment: derived from the state, overwritten at every evaluation.
//!
//! Report: "Body Geometry and Coordinate Systems". Every joint is T1 plus constant vectors in axes of the segments, in the
//! report's body multiples of Y and Z; all vectors are in space axes.

use crate::motion::closed;
use crate::motion::frame::{Frames, Moving};
use crate::motion::layout::{Axis, Freedom, MOST_HINGES, MOST_SEGMENTS, MOST_SLIDES, Row};
use crate::motion::scalar::Scalar;
use crate::motion::skeleton::{Link, Skeleton};
use crate::motion::state::{Quat, SLIDE_UNITS, State};
use crate::motion::vector::{M3, V3, v3};

/// A sliding point mass.
#[derive(Clone, Copy, Debug)]
pub struct Slid<S> {
    /// û in space.
    pub axis: V3<S>,
    /// Undeflected position from the segment's joint, space axes, m.
    pub rest: V3<S>,
    /// s, m.
    pub way: S,
    /// ṡ, m/s.
    pub speed: S,
}

impl<S: Scalar> Slid<S> {
    fn none() -> Self {
        Slid { axis: V3::zero(), rest: V3::zero(), way: S::zero(), speed: S::zero() }
    }

    /// r, position from the segment's joint, space axes, m.
    #[inline(always)]
    pub fn arm(&self) -> V3<S> {
        self.rest + self.axis * self.way
    }
}

/// Derived motion of all segments.
#[derive(Clone, Copy, Debug)]
pub struct Kinematics<S> {
    /// Axes X, Y, Z of each segment as columns.
    pub axes: [M3<S>; MOST_SEGMENTS],
    /// Absolute angular velocity, space axes, rad/s.
    pub omega: [V3<S>; MOST_SEGMENTS],
    /// Position of the proximal joint, m; that of the root is T1.
    pub joint: [V3<S>; MOST_SEGMENTS],
    /// Its velocity, m/s.
    pub joint_velocity: [V3<S>; MOST_SEGMENTS],
    /// Axes of the hinges, in the order of the state's hinges: rotations are relative to the carrying segment.
    pub hinge_axis: [V3<S>; MOST_HINGES],
    /// sin α and cos α of the hinges.
    pub(crate) hinge_sin_cos: [(S, S); MOST_HINGES],
    /// Sliding point masses, in the order of the skeleton's.
    pub slides: [Slid<S>; MOST_SLIDES],
    /// Number of them in the state; 0 while a body is being placed.
    pub(crate) sliding: usize,
}

impl<S: Scalar> Kinematics<S> {
    /// Kinematics of `state`.
    #[inline(always)]
    pub fn new(body: &Skeleton<S>, state: &State<S>) -> Self {
        let mut k = Kinematics::blank();
        k.follow(body, state, None);
        k
    }

    /// Empty kinematics.
    #[inline(always)]
    pub(crate) fn blank() -> Self {
        Kinematics {
            axes: [M3::identity(); MOST_SEGMENTS],
            omega: [V3::zero(); MOST_SEGMENTS],
            joint: [V3::zero(); MOST_SEGMENTS],
            joint_velocity: [V3::zero(); MOST_SEGMENTS],
            hinge_axis: [V3::zero(); MOST_HINGES],
            hinge_sin_cos: [(S::zero(), S::one()); MOST_HINGES],
            slides: [Slid::none(); MOST_SLIDES],
            sliding: 0,
        }
    }

    /// Sets the kinematics of `state`; among `frames`, a guided root moves with its mount, not by the state.
    #[inline(always)]
    pub(crate) fn follow(&mut self, body: &Skeleton<S>, state: &State<S>, frames: Option<&Frames<S>>) {
        for (i, angle) in state.hinge().iter().enumerate() {
            self.hinge_sin_cos[i] = angle.sin_cos();
        }
        for (i, root) in body.roots.iter().enumerate() {
            if root.is_closed {
                closed::place(self, body, state, i);
            } else {
                self.place(body, state, i, frames);
            }
        }
        if !body.slides.is_empty() {
            self.slide(body, state);
        }
    }

    /// Positions of the sliding point masses; the elements' state variables begin with s and ṡ of each.
    #[inline(always)]
    fn slide(&mut self, body: &Skeleton<S>, state: &State<S>) {
        let own = state.own();
        self.sliding = if own.len() < 2 * body.slides.len() { 0 } else { body.slides.len() };
        for (i, (slid, slide)) in self.slides.iter_mut().zip(&body.slides).enumerate() {
            let axes = &self.axes[slide.segment];
            let [way, speed] = match own.get(2 * i..2 * i + 2) {
                Some(own) if i < self.sliding => [own[0] * S::of(SLIDE_UNITS[0]), own[1] * S::of(SLIDE_UNITS[1])],
                _ => [S::zero(); 2],
            };
            *slid = Slid { axis: axes.out(slide.axis), rest: axes.out(slide.place), way, speed };
        }
    }

    /// Positions of any tree.
    #[inline(always)]
    fn place(&mut self, body: &Skeleton<S>, state: &State<S>, tree: usize, frames: Option<&Frames<S>>) {
        let mount = body.roots[tree].mount.as_ref();
        let root = mount.zip(frames).map(|(mount, frames)| mount.of(frames));
        let root = root.as_ref();
        let segments = body.layout.trunks()[tree].segments();
        let parts = body.layout.rows()[segments.clone()].iter().zip(&body.links[segments.clone()]);
        for (n, (row, link)) in segments.zip(parts) {
            match (row.parent, root) {
                (Some(parent), _) => {
                    let arm = self.axes[parent].out(link.joint);
                    self.joint[n] = self.joint[parent] + arm;
                    self.joint_velocity[n] = self.joint_velocity[parent] + self.omega[parent].cross(arm);
                }
                (None, Some(root)) => (self.joint[n], self.joint_velocity[n]) = (root.origin, root.velocity),
                (None, None) => {
                    (self.joint[n], self.joint_velocity[n]) = (state.t1_of(tree), state.velocity_of(tree));
                }
            }
            (self.axes[n], self.omega[n]) = match (row.freedom, root) {
                (Freedom::Hinges(_), _) => self.turned(row, link, state.hinge_rate()),
                (Freedom::Guided, Some(root)) => (root.axes, root.omega),
                _ => (axes(&state.orientation(row.slot)), state.omega(row.slot)),
            };
        }
    }

    /// Motion of a segment for contacts; its origin is its joint.
    #[inline(always)]
    pub(crate) fn moving(&self, segment: usize) -> Moving<S> {
        Moving {
            origin: self.joint[segment],
            axes: self.axes[segment],
            velocity: self.joint_velocity[segment],
            omega: self.omega[segment],
            ..Moving::space()
        }
    }

    /// Axes and angular velocity of a segment on hinges.
    #[inline(always)]
    fn turned(&mut self, row: &Row, link: &Link<S>, rates: &[S]) -> (M3<S>, V3<S>) {
        let [inner, outer] = &link.triads;
        let carrier = row.parent.unwrap_or(0);
        let (mut triad, mut omega) = (self.axes[carrier].times(inner), self.omega[carrier]);
        for (i, axis) in (row.slot..).zip(row.axes()) {
            let (s, c) = self.hinge_sin_cos[i];
            let M3 { x, y, z } = triad;
            (self.hinge_axis[i], triad) = match axis {
                Axis::X => (x, M3 { x, y: y * c + z * s, z: z * c - y * s }),
                Axis::Y => (y, M3 { x: x * c - z * s, y, z: x * s + z * c }),
                Axis::Z => (z, M3 { x: x * c + y * s, y: y * c - x * s, z }),
            };
            omega += self.hinge_axis[i] * rates[i];
        }
        (triad.times(&outer.transposed()), omega)
    }

    /// Centre of gravity of segment `n`; (13) is that of segment 1, (14) that of segment 8.
    #[inline(always)]
    pub fn cg(&self, body: &Skeleton<S>, n: usize) -> V3<S> {
        // segments 1 to 12: (15), (16), (17), (18), (19), (20), (21), (22), (23), (24), (25), (26)
        self.joint[n] + self.axes[n].out(body.links[n].cg)
    }

    /// Velocity of the centre of gravity of segment `n`.
    #[inline(always)]
    pub fn cg_velocity(&self, body: &Skeleton<S>, n: usize) -> V3<S> {
        // its square is, for segments 1 to 12: (27), (28), (29), (30), (31), (32), (33), (34), (35), (36), (37), (38)
        self.joint_velocity[n] + self.omega[n].cross(self.axes[n].out(body.links[n].cg))
    }
}

/// Axes of the orientation of a quaternion, which need not have unit length.
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
