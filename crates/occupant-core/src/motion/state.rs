//! What is integrated: place, orientations, hinge angles, their speeds, and the work sums of the energy ledger.
//!
//! Report: Eqs 8, 13–26 for the place of a segment; the state itself is ours, because Euler angles are singular for an
//! upright torso. A rate of change has the same shape, so that Runge–Kutta stages are sums of states.

use std::array::from_fn;

use crate::motion::layout::{FREE, HINGED};
use crate::motion::scalar::Scalar;
use crate::motion::vector::{V3, v3};

/// Numbers in a [`State`].
pub const NUMBERS: usize = 7 + 7 * FREE.len() + 2 * HINGED.len() + WORK_SUMS;

/// A quaternion w + xi + yj + zk; a unit quaternion turns segment axes into space axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quat<S> {
    /// Real part.
    pub w: S,
    /// Imaginary part.
    pub v: V3<S>,
}

impl<S: Copy> Quat<S> {
    /// f applied to every number and the one in the same place of `other`.
    #[inline(always)]
    pub(crate) fn zip<A: Copy, T>(&self, other: &Quat<A>, f: &impl Fn(S, A) -> T) -> Quat<T> {
        Quat { w: f(self.w, other.w), v: self.v.zip(&other.v, f) }
    }
}

impl<S: Scalar> Quat<S> {
    /// q̇ = ½ ω q for an angular velocity in space axes.
    #[inline(always)]
    pub fn rate(&self, omega: V3<S>) -> Self {
        let half = omega * S::of(0.5);
        Quat { w: -half.dot(self.v), v: half * self.w + half.cross(self.v) }
    }

    /// q·q.
    #[inline(always)]
    pub(crate) fn norm_squared(&self) -> S {
        self.w * self.w + self.v.norm_squared()
    }
}

/// Work sums of the force elements.
pub(crate) const WORK_SUMS: usize = 5;

/// Work done since the start, for the energy ledger, J.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Work<S> {
    /// Done on force elements, as each of them says (`forces::SUMS`).
    pub sums: [S; WORK_SUMS],
    /// Done on the occupant by the motion of the vehicle through force elements.
    pub vehicle: S,
}

/// The integrated state, or its rate of change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<S> {
    /// T1, space axes, m.
    pub t1: V3<S>,
    /// Orientations of the free segments.
    pub orientation: [Quat<S>; FREE.len()],
    /// α of the hinged segments, rad.
    pub hinge: [S; HINGED.len()],
    /// Velocity of T1, space axes, m/s.
    pub velocity: V3<S>,
    /// Absolute angular velocities of the free segments, space axes, rad/s.
    pub omega: [V3<S>; FREE.len()],
    /// α̇, rad/s.
    pub hinge_rate: [S; HINGED.len()],
    /// Work sums.
    pub work: Work<S>,
}

#[inline(always)]
fn zip_4<S: Copy, A: Copy, T>(a: &[S; 4], b: &[A; 4], f: &impl Fn(S, A) -> T) -> [T; 4] {
    [f(a[0], b[0]), f(a[1], b[1]), f(a[2], b[2]), f(a[3], b[3])]
}

#[inline(always)]
fn zip_5<S: Copy, A: Copy, T>(a: &[S; 5], b: &[A; 5], f: &impl Fn(S, A) -> T) -> [T; 5] {
    [f(a[0], b[0]), f(a[1], b[1]), f(a[2], b[2]), f(a[3], b[3]), f(a[4], b[4])]
}

impl<S: Scalar> Work<S> {
    /// None yet.
    #[inline(always)]
    pub(crate) fn zero() -> Self {
        let o = S::zero();
        Work { sums: [o; WORK_SUMS], vehicle: o }
    }
}

impl<S: Copy> State<S> {
    /// f applied to every number and the one in the same place of `other`.
    #[inline(always)]
    pub fn zip<A: Copy, T>(&self, other: &State<A>, f: impl Fn(S, A) -> T) -> State<T> {
        // written out: every call in here must be inlined into code for the lanes' instructions
        let (p, q) = (&self.orientation, &other.orientation);
        let (u, v) = (&self.omega, &other.omega);
        let (a, b) = (&self.work, &other.work);
        State {
            t1: self.t1.zip(&other.t1, &f),
            orientation: [
                p[0].zip(&q[0], &f),
                p[1].zip(&q[1], &f),
                p[2].zip(&q[2], &f),
                p[3].zip(&q[3], &f),
                p[4].zip(&q[4], &f),
                p[5].zip(&q[5], &f),
                p[6].zip(&q[6], &f),
                p[7].zip(&q[7], &f),
            ],
            hinge: zip_4(&self.hinge, &other.hinge, &f),
            velocity: self.velocity.zip(&other.velocity, &f),
            omega: [
                u[0].zip(&v[0], &f),
                u[1].zip(&v[1], &f),
                u[2].zip(&v[2], &f),
                u[3].zip(&v[3], &f),
                u[4].zip(&v[4], &f),
                u[5].zip(&v[5], &f),
                u[6].zip(&v[6], &f),
                u[7].zip(&v[7], &f),
            ],
            hinge_rate: zip_4(&self.hinge_rate, &other.hinge_rate, &f),
            work: Work { sums: zip_5(&a.sums, &b.sums, &f), vehicle: f(a.vehicle, b.vehicle) },
        }
    }
}

impl<S: Scalar> State<S> {
    /// All zero: the neutral element of sums, not a posture.
    pub fn zero() -> Self {
        let o = S::zero();
        State {
            t1: V3::zero(),
            orientation: [Quat { w: o, v: V3::zero() }; FREE.len()],
            hinge: [o; HINGED.len()],
            velocity: V3::zero(),
            omega: [V3::zero(); FREE.len()],
            hinge_rate: [o; HINGED.len()],
            work: Work::zero(),
        }
    }

    /// self + h·rate.
    #[inline(always)]
    pub(crate) fn advanced(&self, h: S, rate: &Self) -> Self {
        self.zip(rate, |a, b| a + h * b)
    }

    /// Where every component but the work sums is a finite number.
    #[inline(always)]
    pub(crate) fn finite(&self) -> S::Mask {
        let mut all = finite(self.t1) & finite(self.velocity);
        for q in &self.orientation {
            all = all & finite(q.v) & q.w.abs().lt(S::of(f64::INFINITY));
        }
        for omega in &self.omega {
            all = all & finite(*omega);
        }
        for angle in self.hinge.iter().chain(&self.hinge_rate) {
            all = all & angle.abs().lt(S::of(f64::INFINITY));
        }
        all
    }

    /// Brings the quaternions back to unit length, which the integration keeps only to its order.
    #[inline(always)]
    pub(crate) fn normalize(&mut self) {
        for q in &mut self.orientation {
            let k = S::one() / q.norm_squared().sqrt();
            *q = Quat { w: q.w * k, v: q.v * k };
        }
    }
}

#[inline(always)]
fn finite<S: Scalar>(v: V3<S>) -> S::Mask {
    let limit = S::of(f64::INFINITY);
    v.x.abs().lt(limit) & v.y.abs().lt(limit) & v.z.abs().lt(limit)
}

/// The next three numbers.
fn vector(next: &mut impl FnMut() -> f64) -> V3<f64> {
    v3(next(), next(), next())
}

impl State<f64> {
    /// All components in a row: T1, orientations (w, x, y, z), hinges, velocity, angular velocities, hinge rates, work sums.
    pub fn to_numbers(&self) -> [f64; NUMBERS] {
        let mut numbers = [0.0; NUMBERS];
        let mut at = 0;
        self.each(|x| {
            numbers[at] = x;
            at += 1;
        });
        numbers
    }

    /// The state whose [`State::to_numbers`] these are.
    pub fn from_numbers(numbers: &[f64; NUMBERS]) -> Self {
        let mut rest = numbers.iter().copied();
        let mut n = || rest.next().unwrap_or(f64::NAN);
        // in the order in which the fields are written
        State {
            t1: vector(&mut n),
            orientation: from_fn(|_| Quat { w: n(), v: vector(&mut n) }),
            hinge: from_fn(|_| n()),
            velocity: vector(&mut n),
            omega: from_fn(|_| vector(&mut n)),
            hinge_rate: from_fn(|_| n()),
            work: Work { sums: from_fn(|_| n()), vehicle: n() },
        }
    }

    /// Every component in the order of [`State::to_numbers`].
    fn each(&self, mut see: impl FnMut(f64)) {
        let mut see_all = |numbers: &[f64]| numbers.iter().for_each(|x| see(*x));
        let of = |v: &V3<f64>| [v.x, v.y, v.z];
        see_all(&of(&self.t1));
        for q in &self.orientation {
            see_all(&[q.w]);
            see_all(&of(&q.v));
        }
        see_all(&self.hinge);
        see_all(&of(&self.velocity));
        for w in &self.omega {
            see_all(&of(w));
        }
        see_all(&self.hinge_rate);
        let w = &self.work;
        see_all(&w.sums);
        see_all(&[w.vehicle]);
    }

    /// True if every component but the work sums is a finite number.
    pub(crate) fn is_finite(&self) -> bool {
        self.finite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_state_is_its_numbers() {
        let numbers: [f64; NUMBERS] = from_fn(|i| i as f64 + 0.5);
        let state = State::from_numbers(&numbers);
        assert_eq!(state.to_numbers(), numbers);
        assert_eq!(state.orientation[7].v.z, 34.5);
        assert_eq!(state.work.sums[0], 70.5);
    }
}
