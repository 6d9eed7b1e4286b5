//! Limbs and leaves of the tree (arms and legs; the head) in the inward sweep, in closed form.
//!
//! The lower segment l of a limb turns about Y of the upper segment m, and everything in the limb lies in its X–Z
//! plane, so in axes of m the matrices of [`super`] have few elements: J and M̃ couple X with Z only, B couples Y with
//! X and Z only. With P, Q, R the inertias of l about the hinge, σ = M·cg of l, c = cos α, s = sin α, X_l = (c, 0, −s):
//! the hinge releases the moment about Y, α̈ = −(ŷ·n + Q α_y + σ X_l·a_E)/Q, and leaves the matrix m − (σ²/Q) X_l X_lᵀ.

use super::{Demand, LIMBS, Links, SEGMENTS, Seen};
use crate::motion::dynamics::Wrench;
use crate::motion::scalar::Scalar;
use crate::motion::vector::{M3, Sym3, V3, v3};

/// A limb after the inward sweep, in axes of its upper segment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limb<S> {
    /// J⁻¹(τ − β_τ).
    alpha_free: V3<S>,
    /// Elements of B J⁻¹.
    gain: Gain<S>,
    /// ŷ·n of the lower segment for the upper one at rest.
    hinge_bias: S,
    sigma: S,
    inverse_iy: S,
    sin_cos: (S, S),
}

/// The four non-zero elements of B J⁻¹.
#[derive(Clone, Copy, Debug)]
struct Gain<S> {
    xy: S,
    zy: S,
    yx: S,
    yz: S,
}

impl<S: Scalar> Gain<S> {
    #[inline(always)]
    fn zero() -> Self {
        let o = S::zero();
        Gain { xy: o, zy: o, yx: o, yz: o }
    }
}

impl<S: Scalar> Limb<S> {
    /// Zero, before reduction.
    #[inline(always)]
    pub(crate) fn zero() -> Self {
        let o = S::zero();
        Limb { alpha_free: V3::zero(), gain: Gain::zero(), hinge_bias: o, sigma: o, inverse_iy: o, sin_cos: (o, o) }
    }

    /// Angular acceleration of the upper segment, space axes, for an acceleration `a` of its joint.
    #[inline(always)]
    pub(crate) fn alpha(&self, k: &Seen<'_, S>, upper: usize, a: V3<S>) -> V3<S> {
        let axes = &k.axes[upper];
        let a = axes.into_frame(a);
        let g = &self.gain;
        let turn = v3(g.yx * a.y, g.xy * a.x + g.zy * a.z, g.yz * a.y);
        axes.out(self.alpha_free + turn)
    }

    /// α̈ for the upper segment's angular acceleration and the hinge's acceleration, both in space axes.
    #[inline(always)]
    pub(crate) fn hinge_acceleration(&self, k: &Seen<'_, S>, upper: usize, alpha: V3<S>, a: V3<S>) -> S {
        let axes = &k.axes[upper];
        let (s, c) = self.sin_cos;
        let along_x = axes.x.dot(a) * c - axes.z.dot(a) * s;
        -(axes.y.dot(alpha)) - (self.hinge_bias + self.sigma * along_x) * self.inverse_iy
    }
}

/// Reduces limb `i` of [`LIMBS`] to the demand at its shoulder or hip, the first result.
#[inline(always)]
pub(crate) fn reduce<S: Scalar>(
    links: &Links<S>,
    k: &Seen<'_, S>,
    i: usize,
    hinge_rate: S,
    wrench: &[Wrench<S>; SEGMENTS],
) -> (Demand<S>, Limb<S>) {
    let (upper, lower) = LIMBS[i];
    let (m, l) = (&links[upper], &links[lower]);
    let axes = &k.axes[upper];
    let (s, c) = k.hinge_sin_cos[i];
    let w = axes.into_frame(k.omega[upper]);
    let (force_m, moment_m) = wrench[upper].into_frame(axes);
    let (force_l, moment_l) = wrench[lower].into_frame(axes);

    // lower segment, in its own axes: what it needs when neither hinge nor elbow accelerates
    let into_lower = |v: V3<S>| v3(v.x * c - v.z * s, v.y, v.x * s + v.z * c);
    let into_upper = |v: V3<S>| v3(v.x * c + v.z * s, v.y, v.z * c - v.x * s);
    let wl = into_lower(w);
    let turning = wl.y + hinge_rate;
    let moment_l = into_lower(moment_l);
    let hinge_bias = (l.inertia.xx - l.inertia.zz) * wl.z * wl.x - moment_l.y;
    let n_x = (l.inertia.zz - l.inertia.yy) * turning * wl.z - l.inertia.xx * hinge_rate * wl.z - moment_l.x;
    let n_z = (l.inertia.yy - l.inertia.xx) * wl.x * turning + l.inertia.zz * hinge_rate * wl.x - moment_l.z;
    let swing = v3(wl.x * wl.z, turning * wl.z + hinge_rate * wl.z, -(wl.x * wl.x + turning * turning)) * l.sigma.z;
    let hinge_release = l.sigma.z * l.inverse_iy * hinge_bias;
    let f_0 = into_upper(v3(swing.x - hinge_release, swing.y, swing.z)) - force_l;
    let n_0 = into_upper(v3(n_x, S::zero(), n_z));

    // both segments, in axes of the upper one
    let (lambda, kappa) = (l.joint.z, l.sigma.z * l.sigma.z * l.inverse_iy);
    let centripetal = v3(w.x * w.z, w.y * w.z, -(w.x * w.x + w.y * w.y));
    let at_hinge = centripetal * lambda;
    let along_x = kappa * (c * at_hinge.x - s * at_hinge.z);
    let u = v3(l.mass * at_hinge.x - along_x * c, l.mass * at_hinge.y, l.mass * at_hinge.z + along_x * s) + f_0;
    let bias_force = centripetal * m.sigma.z + u - force_m;
    let gyroscopic = v3(
        (m.inertia.zz - m.inertia.yy) * w.y * w.z,
        (m.inertia.xx - m.inertia.zz) * w.z * w.x,
        (m.inertia.yy - m.inertia.xx) * w.x * w.y,
    );
    let coupled = l.sigma.z * at_hinge.y;
    let moment = moment_m - gyroscopic - n_0 - v3(-lambda * u.y - coupled * c, lambda * u.x, coupled * s);

    let first = m.sigma.z + l.mass * lambda;
    let b = Gain {
        xy: kappa * lambda * c * c - first,
        zy: -(kappa * lambda * c * s),
        yx: first + l.sigma.z * c,
        yz: -(l.sigma.z * s),
    };
    let (cc, ss, cs) = (c * c, s * s, c * s);
    let reach = l.mass * lambda * lambda;
    let lever = l.sigma.z * lambda;
    let j_xx = m.inertia.xx + l.inertia.xx * cc + l.inertia.zz * ss + (lever + lever) * c + reach;
    let j_zz = m.inertia.zz + l.inertia.xx * ss + l.inertia.zz * cc;
    let j_xz = (l.inertia.zz - l.inertia.xx) * cs - lever * s;
    let j_yy = m.inertia.yy + reach - kappa * lambda * lambda * cc;
    let one = S::one();
    let (inv_yy, inv_det) = (one / j_yy, one / (j_xx * j_zz - j_xz * j_xz));
    let (inv_xx, inv_zz, inv_xz) = (j_zz * inv_det, j_xx * inv_det, -(j_xz * inv_det));
    let gain = Gain {
        xy: b.xy * inv_yy,
        zy: b.zy * inv_yy,
        yx: b.yx * inv_xx + b.yz * inv_xz,
        yz: b.yx * inv_xz + b.yz * inv_zz,
    };
    let alpha_free =
        v3(inv_xx * moment.x + inv_xz * moment.z, inv_yy * moment.y, inv_xz * moment.x + inv_zz * moment.z);
    let total = m.mass + l.mass;
    let mass = PlaneMass {
        xx: total - kappa * cc - gain.xy * b.xy,
        xz: kappa * cs - gain.xy * b.zy,
        zz: total - kappa * ss - gain.zy * b.zy,
        yy: total - gain.yx * b.yx - gain.yz * b.yz,
    };
    let bias = bias_force - v3(gain.xy * moment.y, gain.yx * moment.x + gain.yz * moment.z, gain.zy * moment.y);
    let demand = Demand { mass: mass.out(axes), bias: axes.out(bias) };
    (demand, Limb { alpha_free, gain, hinge_bias, sigma: l.sigma.z, inverse_iy: l.inverse_iy, sin_cos: (s, c) })
}

/// A symmetric matrix that couples X with Z only.
struct PlaneMass<S> {
    xx: S,
    xz: S,
    zz: S,
    yy: S,
}

impl<S: Scalar> PlaneMass<S> {
    /// In space axes; with 1 = XXᵀ + YYᵀ + ZZᵀ the Y part becomes a multiple of the unit matrix.
    #[inline(always)]
    fn out(&self, axes: &M3<S>) -> Sym3<S> {
        let mut sum = Sym3::scaled_identity(self.yy);
        sum.add_outer(self.xx - self.yy, axes.x);
        sum.add_outer(self.zz - self.yy, axes.z);
        sum.add_outer_pair(self.xz, axes.x, axes.z);
        sum
    }
}

/// A leaf after the inward sweep: a ball joint without children, so that J and M̃ are diagonal in its own axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leaf<S> {
    alpha_free: V3<S>,
    gain: Gain<S>,
}

impl<S: Scalar> Leaf<S> {
    /// Zero, before reduction.
    #[inline(always)]
    pub(crate) fn zero() -> Self {
        Leaf { alpha_free: V3::zero(), gain: Gain::zero() }
    }

    /// Angular acceleration of segment `n`, space axes, for an acceleration `a` of its joint.
    #[inline(always)]
    pub(crate) fn alpha(&self, k: &Seen<'_, S>, n: usize, a: V3<S>) -> V3<S> {
        let axes = &k.axes[n];
        let a = axes.into_frame(a);
        axes.out(self.alpha_free + v3(self.gain.yx * a.y, self.gain.xy * a.x, S::zero()))
    }
}

/// Reduces the leaf `n` to the demand at its joint, the first result.
#[inline(always)]
pub(crate) fn reduce_leaf<S: Scalar>(
    links: &Links<S>,
    k: &Seen<'_, S>,
    n: usize,
    wrench: &[Wrench<S>; SEGMENTS],
) -> (Demand<S>, Leaf<S>) {
    let (h, axes, wrench) = (&links[n], &k.axes[n], &wrench[n]);
    let w = axes.into_frame(k.omega[n]);
    let force = axes.into_frame(wrench.force);
    let moment = axes.into_frame(wrench.moment)
        - v3(
            (h.inertia.zz - h.inertia.yy) * w.y * w.z,
            (h.inertia.xx - h.inertia.zz) * w.z * w.x,
            (h.inertia.yy - h.inertia.xx) * w.x * w.y,
        );
    let one = S::one();
    let inverse_ix = one / h.inertia.xx;
    let gain = Gain { xy: -(h.sigma.z * h.inverse_iy), zy: S::zero(), yx: h.sigma.z * inverse_ix, yz: S::zero() };
    let alpha_free = v3(moment.x * inverse_ix, moment.y * h.inverse_iy, moment.z / h.inertia.zz);
    let mass =
        PlaneMass { xx: h.mass + gain.xy * h.sigma.z, xz: S::zero(), zz: h.mass, yy: h.mass - gain.yx * h.sigma.z };
    let swing = v3(w.x * w.z, w.y * w.z, -(w.x * w.x + w.y * w.y)) * h.sigma.z;
    let bias = swing - force - v3(gain.xy * moment.y, gain.yx * moment.x, S::zero());
    (Demand { mass: mass.out(axes), bias: axes.out(bias) }, Leaf { alpha_free, gain })
}
