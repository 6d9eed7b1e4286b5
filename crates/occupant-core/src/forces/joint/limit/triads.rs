//! Reference axes of a ball joint, the angles between them, and how these change.
//!
//! The centre axis ĉ, x̂ ⟂ ĉ and ŷ = ĉ × x̂ are fixed in the inner segment k; the axis ẑ and its own x̂_l, ŷ_l in the
//! outer segment l. With z_x = ẑ·x̂ and so on, bend θ = atan2(√(z_x² + z_y²), z_c), azimuth φ = atan2(z_y, z_x), and
//! twist τ is the rest of the rotation from (x̂, ŷ, ĉ) to (x̂_l, ŷ_l, ẑ) after ĉ has been swung straight to ẑ: τ =
//! atan2(x̂_l·ŷ − ŷ_l·x̂, x̂_l·x̂ + ŷ_l·ŷ). Left joints mirror the right ones: ŷ and ŷ_l are reversed.

use nalgebra::{UnitQuaternion, Vector3};

use super::Centre;
use crate::body::{Body, Joint, JointSite, Side};
use crate::motion::scalar::Scalar;
use crate::motion::vector::{M3, V3};
use occupant_units::trig;

/// Axes (x̂, ŷ, ĉ) in the inner segment and (x̂_l, ŷ_l, ẑ) in the outer one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triads<S> {
    inner: M3<S>,
    outer: M3<S>,
    /// −1 for left joints.
    hand: S,
}

/// Pose of the outer triad relative to the inner one; vectors in space axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose<S> {
    inner: M3<S>,
    /// ẑ.
    z: V3<S>,
    /// z_x, z_y, z_c.
    along: V3<S>,
    /// (1 + z_c) sin τ, (1 + z_c) cos τ.
    turn: [S; 2],
    hand: S,
}

impl Triads<f64> {
    /// Triads of a joint of `body`, in the joint's axes on both segments. ĉ and ẑ point along the outer segment's Z
    /// away from the joint unless the centre is given.
    pub(super) fn new(body: &Body, joint: Joint, centre: &Centre) -> Self {
        let (row, place) = (&body.tree[joint], body.place(joint));
        let along = if body.tree[row.distal].hangs() { -1.0 } else { 1.0 };
        let hand = if row.side() == Some(Side::Left) { -1.0 } else { 1.0 };
        let (axis, forward) = match *centre {
            Centre::Pitch { pitch_rad } => {
                let (s, c) = trig::sin_cos(pitch_rad);
                (Vector3::new(s, 0.0, c) * along, Vector3::new(c, 0.0, -s))
            }
            Centre::Axes { axis, forward } => {
                let mirrored = |v: Vector3<f64>| Vector3::new(v.x, hand * v.y, v.z);
                (mirrored(axis), mirrored(forward))
            }
        };
        let triad = |site: JointSite, axis: Vector3<f64>, forward: Vector3<f64>| {
            let c = axis.normalize();
            let x = (forward - c * c.dot(&forward)).normalize();
            // no turn keeps even the signs of zeros
            let turned = |v: Vector3<f64>| if site.axes == UnitQuaternion::identity() { v } else { site.axes * v };
            let [x, y, z] = [x, c.cross(&x) * hand, c].map(|v| V3::of(&turned(v)));
            M3 { x, y, z }
        };
        let outer = triad(place.distal, Vector3::z() * along, Vector3::x());
        Triads { inner: triad(place.proximal, axis, forward), outer, hand }
    }
}

impl<S: Copy> Triads<S> {
    pub(super) fn zip<A: Copy, T>(&self, other: &Triads<A>, f: &impl Fn(S, A) -> T) -> Triads<T> {
        Triads {
            inner: self.inner.zip(&other.inner, f),
            outer: self.outer.zip(&other.outer, f),
            hand: f(self.hand, other.hand),
        }
    }
}

impl<S: Scalar> Triads<S> {
    /// Pose for these axes of the two segments.
    #[inline(always)]
    pub(super) fn pose(&self, k: &M3<S>, l: &M3<S>) -> Pose<S> {
        let inner = M3 { x: k.out(self.inner.x), y: k.out(self.inner.y), z: k.out(self.inner.z) };
        let (x_l, y_l, z) = (l.out(self.outer.x), l.out(self.outer.y), l.out(self.outer.z));
        Pose {
            inner,
            z,
            along: inner.into_frame(z),
            turn: [x_l.dot(inner.y) - y_l.dot(inner.x), x_l.dot(inner.x) + y_l.dot(inner.y)],
            hand: self.hand,
        }
    }
}

impl<S: Scalar> Pose<S> {
    #[inline(always)]
    fn sine_squared(&self) -> S {
        self.along.x * self.along.x + self.along.y * self.along.y
    }

    /// θ, 0 to π.
    #[inline(always)]
    pub(super) fn bend(&self) -> S {
        self.sine_squared().sqrt().atan2(self.along.z)
    }

    /// φ, −π to π; 0 at θ = 0, where it is undefined.
    #[inline(always)]
    pub(super) fn azimuth(&self) -> S {
        self.along.y.atan2(self.along.x)
    }

    /// τ, −π to π.
    #[inline(always)]
    pub(super) fn twist(&self) -> S {
        self.turn[0].atan2(self.turn[1])
    }

    /// Lanes where θ exceeds the angle with this cosine.
    #[inline(always)]
    pub(super) fn is_bent_beyond(&self, cosine: S) -> S::Mask {
        self.along.z.lt(cosine)
    }

    /// Lanes where |τ| exceeds the angle with this cosine.
    #[inline(always)]
    pub(super) fn is_twisted_beyond(&self, cosine: S) -> S::Mask {
        self.turn[1].lt(cosine * (S::one() + self.along.z))
    }

    /// e_θ with θ̇ = ω·e_θ.
    #[inline(always)]
    pub(super) fn bending(&self) -> V3<S> {
        self.inner.z.cross(self.z) * (S::one() / self.sine_squared().sqrt().max(S::of(1e-30)))
    }

    /// e_φ with φ̇ = ω·e_φ.
    #[inline(always)]
    pub(super) fn swinging(&self) -> V3<S> {
        let across = self.inner.y * self.along.x - self.inner.x * self.along.y;
        self.z.cross(across) * (S::one() / self.sine_squared().max(S::of(1e-30)))
    }

    /// e_τ with τ̇ = ω·e_τ.
    #[inline(always)]
    pub(super) fn twisting(&self) -> V3<S> {
        (self.inner.z + self.z) * (self.hand / (S::one() + self.along.z).max(S::of(1e-30)))
    }
}
