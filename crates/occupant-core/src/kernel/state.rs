//! What is integrated: place, orientations, hinge angles, their speeds, and the work sums of the energy ledger.
//!
//! Report: Eqs 8, 13–26 for the place of a segment; the state itself is ours, because Euler angles are singular for an
//! upright torso. A rate of change has the same shape, so that Runge–Kutta stages are sums of states.

use super::scalar::Scalar;
use super::vector::{V3, v3};

/// Segments (indices) whose orientation is free, in the order of [`State::orientation`].
pub const FREE: [usize; 8] = [0, 1, 2, 3, 4, 5, 8, 9];

/// Hinged segments (indices), in the order of [`State::hinge`].
pub const HINGED: [usize; 4] = [6, 7, 10, 11];

/// Numbers in a [`State`].
pub const NUMBERS: usize = 75;

/// Place of a free segment in [`FREE`]; hinged segments are not in it.
pub const fn free_slot(segment: usize) -> usize {
    if segment < 6 { segment } else { segment - 2 }
}

/// A quaternion w + xi + yj + zk; a unit quaternion turns segment axes into space axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quat<S> {
    /// Real part.
    pub w: S,
    /// Imaginary part.
    pub v: V3<S>,
}

impl<S: Scalar> Quat<S> {
    /// q̇ = ½ ω q for an angular velocity in space axes.
    #[inline(always)]
    pub fn rate(&self, omega: V3<S>) -> Self {
        let half = omega * S::of(0.5);
        Quat {
            w: -half.dot(self.v),
            v: half * self.w + half.cross(self.v),
        }
    }

    /// q·q.
    #[inline(always)]
    pub fn norm_squared(&self) -> S {
        self.w * self.w + self.v.norm_squared()
    }
}

/// Work done since the start, for the energy ledger, J.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Work<S> {
    /// Put into contacts along their normals and edge bands (stored and dissipated).
    pub contact: S,
    /// Dissipated by friction.
    pub friction: S,
    /// Dissipated by joint dampers and stops.
    pub joints: S,
    /// Put into belts (stored and dissipated).
    pub belts: S,
    /// Done on the occupant by the motion of the vehicle through contacts and belts.
    pub vehicle: S,
}

/// The integrated state, or its rate of change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<S> {
    /// T1, space axes, m.
    pub t1: V3<S>,
    /// Orientations of the free segments.
    pub orientation: [Quat<S>; 8],
    /// α of the hinged segments, rad.
    pub hinge: [S; 4],
    /// Velocity of T1, space axes, m/s.
    pub velocity: V3<S>,
    /// Absolute angular velocities of the free segments, space axes, rad/s.
    pub omega: [V3<S>; 8],
    /// α̇, rad/s.
    pub hinge_rate: [S; 4],
    /// Work sums.
    pub work: Work<S>,
}

impl<S: Scalar> State<S> {
    /// All zero: the neutral element of sums, not a posture.
    pub fn zero() -> Self {
        let o = S::zero();
        State {
            t1: V3::zero(),
            orientation: [Quat {
                w: o,
                v: V3::zero(),
            }; 8],
            hinge: [o; 4],
            velocity: V3::zero(),
            omega: [V3::zero(); 8],
            hinge_rate: [o; 4],
            work: Work {
                contact: o,
                friction: o,
                joints: o,
                belts: o,
                vehicle: o,
            },
        }
    }

    /// f applied to every pair of components.
    #[inline(always)]
    pub fn zip(&self, other: &Self, f: impl Fn(S, S) -> S) -> Self {
        let vector = |a: V3<S>, b: V3<S>| v3(f(a.x, b.x), f(a.y, b.y), f(a.z, b.z));
        let mut out = *self;
        out.t1 = vector(self.t1, other.t1);
        for i in 0..8 {
            let (a, b) = (self.orientation[i], other.orientation[i]);
            out.orientation[i] = Quat {
                w: f(a.w, b.w),
                v: vector(a.v, b.v),
            };
            out.omega[i] = vector(self.omega[i], other.omega[i]);
        }
        for i in 0..4 {
            out.hinge[i] = f(self.hinge[i], other.hinge[i]);
            out.hinge_rate[i] = f(self.hinge_rate[i], other.hinge_rate[i]);
        }
        out.velocity = vector(self.velocity, other.velocity);
        let (a, b) = (&self.work, &other.work);
        out.work = Work {
            contact: f(a.contact, b.contact),
            friction: f(a.friction, b.friction),
            joints: f(a.joints, b.joints),
            belts: f(a.belts, b.belts),
            vehicle: f(a.vehicle, b.vehicle),
        };
        out
    }

    /// self + h·rate.
    #[inline(always)]
    pub fn advanced(&self, h: S, rate: &Self) -> Self {
        self.zip(rate, |a, b| a + h * b)
    }

    /// Brings the quaternions back to unit length, which the integration keeps only to its order.
    #[inline(always)]
    pub fn normalize(&mut self) {
        for q in &mut self.orientation {
            let k = S::one() / q.norm_squared().sqrt();
            *q = Quat {
                w: q.w * k,
                v: q.v * k,
            };
        }
    }
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
        let n = |i: usize| numbers[i];
        let vector = |i: usize| v3(n(i), n(i + 1), n(i + 2));
        State {
            t1: vector(0),
            orientation: std::array::from_fn(|k| Quat {
                w: n(3 + 4 * k),
                v: vector(4 + 4 * k),
            }),
            hinge: std::array::from_fn(|k| n(35 + k)),
            velocity: vector(39),
            omega: std::array::from_fn(|k| vector(42 + 3 * k)),
            hinge_rate: std::array::from_fn(|k| n(66 + k)),
            work: Work {
                contact: n(70),
                friction: n(71),
                joints: n(72),
                belts: n(73),
                vehicle: n(74),
            },
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
        see_all(&[w.contact, w.friction, w.joints, w.belts, w.vehicle]);
    }

    /// True if every component is a finite number.
    pub fn is_finite(&self) -> bool {
        let v = |a: &V3<f64>| a.x.is_finite() && a.y.is_finite() && a.z.is_finite();
        v(&self.t1)
            && v(&self.velocity)
            && self.orientation.iter().all(|q| q.w.is_finite() && v(&q.v))
            && self.omega.iter().all(v)
            && self
                .hinge
                .iter()
                .chain(&self.hinge_rate)
                .all(|a| a.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_state_is_its_numbers() {
        let numbers: [f64; NUMBERS] = std::array::from_fn(|i| i as f64 + 0.5);
        let state = State::from_numbers(&numbers);
        assert_eq!(state.to_numbers(), numbers);
        assert_eq!(state.orientation[7].v.z, 34.5);
        assert_eq!(state.work.contact, 70.5);
    }
}
