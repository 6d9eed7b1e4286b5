//! The posture of a joint: the orientation of the outer segment relative to the inner one, and the rotation from there.

use crate::motion::scalar::Scalar;
use crate::motion::vector::{M3, V3};

/// Axes of the outer segment in those of the inner one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Posture<S>(pub(super) M3<S>);

impl<S: Copy> Posture<S> {
    #[inline(always)]
    pub(super) fn zip<A: Copy, T>(&self, other: &Posture<A>, f: &impl Fn(S, A) -> T) -> Posture<T> {
        Posture(self.0.zip(&other.0, f))
    }
}

impl<S: Scalar> Posture<S> {
    /// Posture of segments with the axes k and l, the outer one first turned back by the rotation vector `back`, space
    /// axes, rad.
    #[inline(always)]
    pub(super) fn new(k: &M3<S>, l: &M3<S>, back: V3<S>) -> Self {
        let angle = length(back);
        let (sine, cosine) = angle.sin_cos();
        let axis = back * (S::one() / angle);
        let mut turned = *l;
        for a in [&mut turned.x, &mut turned.y, &mut turned.z] {
            // a cos|ρ| − n × a sin|ρ| + n (n·a) (1 − cos|ρ|)
            let along = axis * (axis.dot(*a) * (S::one() - cosine));
            *a = k.into_frame(*a * cosine - axis.cross(*a) * sine + along);
        }
        Posture(turned)
    }

    /// ρ, the rotation vector from this posture to that of segments with the axes k and l, space axes, rad. Then
    /// d(½|ρ|²)/dt = ρ·ω exactly. Its direction jumps where |ρ| = π.
    #[inline(always)]
    pub(super) fn turned_to(&self, k: &M3<S>, l: &M3<S>) -> V3<S> {
        let Posture(axes) = self;
        let (x, y, z) = (k.out(axes.x), k.out(axes.y), k.out(axes.z));
        // sin|ρ| n = ½ Σ h × l, cos|ρ| = ½ (Σ h·l − 1) over the axes h of the posture and l
        let half = S::of(0.5);
        let sine = (x.cross(l.x) + y.cross(l.y) + z.cross(l.z)) * half;
        let cosine = (x.dot(l.x) + y.dot(l.y) + z.dot(l.z) - S::one()) * half;
        let size = length(sine);
        sine * (size.atan2(cosine) / size)
    }
}

/// Length of a vector, plus 1e-60 to avoid a zero derivative.
#[inline(always)]
pub(super) fn length<S: Scalar>(v: V3<S>) -> S {
    (v.norm_squared() + S::of(1e-60)).sqrt()
}
