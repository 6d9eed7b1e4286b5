//! Equations of motion: D·u̇ = E + F_p + F_s + Q_f + R (Eq. 53) solved by one sweep in and one sweep out of the tree.
//!
//! A ball joint hands on a force but no moment, so a whole subtree shows its parent only a symmetric matrix and a vector:
//! the force that the subtree needs at the joint is f = M̃ a + b̃, a the joint's acceleration. For a body with joint P,
//! moment of inertia J about P, c.g. at r, and subtrees (M̃ₖ, b̃ₖ) hung at cₖ, with α its angular acceleration:
//!
//! ```text
//! force    f = A a − B α + β_f     A = m1 + ΣM̃ₖ     B = m[r]× + ΣM̃ₖ[cₖ]×
//! moment   τ = J α − Bᵀ a + β_τ
//! ```
//!
//! so α = J⁻¹(τ − β_τ) + (BJ⁻¹)ᵀ a, M̃ = A − BJ⁻¹Bᵀ, b̃ = β_f − BJ⁻¹(τ − β_τ). The root T1 carries subtrees and no mass.
//! Gravity is uniform: it only shifts every acceleration, and is added at the root.
//!
//! The result is the report's; no matrix larger than 3 × 3 is ever formed. `limb` treats limbs and leaves.

use crate::body::SEGMENTS;
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::{HINGED, LEAVES, LIMBS, ROOTS, TRUNKS, hung_from};
use crate::motion::limb::{self, Leaf, Limb};
use crate::motion::scalar::Scalar;
use crate::motion::skeleton::Skeleton;
use crate::motion::vector::{M3, Sym3, V3, v3};

/// Force and moment on a segment, space axes; the moment is about the segment's proximal joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<S> {
    /// N.
    pub force: V3<S>,
    /// N·m.
    pub moment: V3<S>,
}

impl<S: Scalar> Wrench<S> {
    /// Force and moment along the axes of a frame.
    #[inline(always)]
    pub(crate) fn into_frame(self, axes: &M3<S>) -> (V3<S>, V3<S>) {
        (axes.into_frame(self.force), axes.into_frame(self.moment))
    }

    /// No load.
    #[inline(always)]
    pub fn zero() -> Self {
        Wrench { force: V3::zero(), moment: V3::zero() }
    }
}

/// What a subtree asks of the joint that carries it: f = `mass`·a + `bias`, space axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Demand<S> {
    /// M̃, kg.
    pub mass: Sym3<S>,
    /// b̃, N; without gravity.
    pub bias: V3<S>,
}

impl<S: Scalar> Demand<S> {
    /// Nothing.
    #[inline(always)]
    fn zero() -> Self {
        Demand { mass: Sym3::scaled_identity(S::zero()), bias: V3::zero() }
    }

    /// The force at the joint for an acceleration `a` of the joint, gravity excluded.
    #[inline(always)]
    pub(crate) fn force(&self, a: V3<S>) -> V3<S> {
        self.mass.mul(a) + self.bias
    }
}

/// Accelerations of the tree, space axes, and the forces that its joints carry.
#[derive(Clone, Copy, Debug)]
pub struct Accelerations<S> {
    /// Of each segment's proximal joint, m/s².
    pub joint: [V3<S>; SEGMENTS],
    /// Angular acceleration of each segment, rad/s².
    pub alpha: [V3<S>; SEGMENTS],
    /// α̈ of the limbs' hinges, rad/s².
    pub hinge: [S; HINGED.len()],
}

/// A trunk segment after the inward sweep.
#[derive(Clone, Copy, Debug)]
struct Trunk<S> {
    inverse_inertia: Sym3<S>,
    moment: V3<S>,
    /// Columns of (B J⁻¹)ᵀ, i.e. rows of B J⁻¹.
    gain: M3<S>,
}

impl<S: Scalar> Trunk<S> {
    /// Not yet reduced.
    #[inline(always)]
    fn zero() -> Self {
        let o = V3::zero();
        Trunk { inverse_inertia: Sym3::scaled_identity(S::zero()), moment: o, gain: M3 { x: o, y: o, z: o } }
    }

    /// α = J⁻¹(τ − β_τ) + (BJ⁻¹)ᵀ a.
    #[inline(always)]
    fn alpha(&self, a: V3<S>) -> V3<S> {
        self.inverse_inertia.mul(self.moment) + self.gain.out(a)
    }
}

/// Accelerations under the loads `wrench` (without gravity, which is added here): solves (53).
#[inline(always)]
pub fn solve<S: Scalar>(
    body: &Skeleton<S>,
    k: &Kinematics<S>,
    hinge_rate: &[S; HINGED.len()],
    wrench: &[Wrench<S>; SEGMENTS],
) -> Accelerations<S> {
    let mut sweep = Sweep::blank();
    sweep.solve(body, k, hinge_rate, wrench);
    sweep.accelerations
}

/// Both sweeps through the tree, with what the one outward takes over from the one inward. Every number that is read was
/// written before in the same call, so that one may be used again without being cleared.
#[derive(Clone, Debug)]
pub(crate) struct Sweep<S> {
    demand: [Demand<S>; SEGMENTS],
    limbs: [Limb<S>; LIMBS.len()],
    leaves: [Leaf<S>; LEAVES.len()],
    trunks: [Trunk<S>; TRUNKS.len()],
    /// Of the last call of [`Sweep::solve`].
    pub accelerations: Accelerations<S>,
}

impl<S: Scalar> Sweep<S> {
    /// Nothing solved yet.
    #[inline(always)]
    pub(crate) fn blank() -> Self {
        let o = V3::zero();
        Sweep {
            demand: [Demand::zero(); SEGMENTS],
            limbs: [Limb::zero(); LIMBS.len()],
            leaves: [Leaf::zero(); LEAVES.len()],
            trunks: [Trunk::zero(); TRUNKS.len()],
            accelerations: Accelerations {
                joint: [o; SEGMENTS],
                alpha: [o; SEGMENTS],
                hinge: [S::zero(); HINGED.len()],
            },
        }
    }

    /// As [`solve`].
    #[inline(always)]
    pub(crate) fn solve(
        &mut self,
        body: &Skeleton<S>,
        k: &Kinematics<S>,
        hinge_rate: &[S; HINGED.len()],
        wrench: &[Wrench<S>; SEGMENTS],
    ) {
        let Sweep { demand, limbs, leaves, trunks, accelerations: out } = self;
        // inward: what carries nothing but itself, then the trunk from its ends
        for (i, &(upper, _)) in LIMBS.iter().enumerate() {
            (demand[upper], limbs[i]) = limb::reduce(body, k, i, hinge_rate[i], wrench);
        }
        for (i, &n) in LEAVES.iter().enumerate() {
            (demand[n], leaves[i]) = limb::reduce_leaf(body, k, n, wrench);
        }
        for (i, &n) in TRUNKS.iter().enumerate().rev() {
            (demand[n], trunks[i]) = reduce(body, k, n, wrench, demand);
        }

        // root: the forces that all halves ask of T1 vanish together
        let (mut mass, mut bias) = (demand[ROOTS[0]].mass, demand[ROOTS[0]].bias);
        for &n in &ROOTS[1..] {
            mass = mass + demand[n].mass;
            bias += demand[n].bias;
        }
        let a_root = -mass.inverse().mul(bias);

        // outward
        for &n in ROOTS {
            out.joint[n] = a_root;
        }
        for (&n, trunk) in TRUNKS.iter().zip(&*trunks) {
            out.alpha[n] = trunk.alpha(out.joint[n]);
            for &(child, _) in hung_from(n) {
                out.carry(k, child, n);
            }
        }
        for (&n, leaf) in LEAVES.iter().zip(&*leaves) {
            out.alpha[n] = leaf.alpha(k, n, out.joint[n]);
        }
        for (i, (&(upper, lower), limb)) in LIMBS.iter().zip(&*limbs).enumerate() {
            out.alpha[upper] = limb.alpha(k, upper, out.joint[upper]);
            out.carry(k, lower, upper);
            out.hinge[i] = limb.hinge_acceleration(k, upper, out.alpha[upper], out.joint[lower]);
            out.alpha[lower] = out.alpha[upper]
                + k.axes[upper].y * out.hinge[i]
                + k.omega[upper].cross(k.axes[upper].y) * hinge_rate[i];
        }
        // F_p (51a), (56): a uniform acceleration of all joints
        let gravity = v3(S::zero(), S::zero(), -body.gravity);
        for a in &mut out.joint {
            *a += gravity;
        }
    }
}

impl<S: Scalar> Accelerations<S> {
    /// a_child = a_parent + α×c + ω×(ω×c).
    #[inline(always)]
    fn carry(&mut self, k: &Kinematics<S>, child: usize, parent: usize) {
        let c = k.joint[child] - k.joint[parent];
        let w = k.omega[parent];
        self.joint[child] = self.joint[parent] + self.alpha[parent].cross(c) + w.cross(w.cross(c));
    }

    /// Acceleration of the centre of gravity of segment `n`.
    #[inline]
    pub fn cg(&self, body: &Skeleton<S>, k: &Kinematics<S>, n: usize) -> V3<S> {
        let r = k.axes[n].z * body.links[n].cg;
        let w = k.omega[n];
        self.joint[n] + self.alpha[n].cross(r) + w.cross(w.cross(r))
    }
}

/// Reduces a trunk segment to what it asks of its joint, the first result; `demands` of the segments it carries are known.
#[inline(always)]
fn reduce<S: Scalar>(
    body: &Skeleton<S>,
    k: &Kinematics<S>,
    n: usize,
    wrench: &[Wrench<S>; SEGMENTS],
    demands: &[Demand<S>; SEGMENTS],
) -> (Demand<S>, Trunk<S>) {
    let (link, wrench) = (&body.links[n], &wrench[n]);
    let (axes, w) = (&k.axes[n], k.omega[n]);
    let mut inertia = Sym3::scaled_identity(link.iz);
    inertia.add_outer(link.ix - link.iz, axes.x);
    inertia.add_outer(link.iy - link.iz, axes.y);
    let gyroscopic = w.cross(inertia.mul(w));
    let moment_of_mass = axes.z * link.sigma;

    let mut mass = Sym3::scaled_identity(link.mass);
    // rows of B = m[r]× + ΣM̃ₖ[cₖ]×; a row of M[c]× is (row of M) × c
    let r = moment_of_mass;
    let mut b_x = v3(S::zero(), -r.z, r.y);
    let mut b_y = v3(r.z, S::zero(), -r.x);
    let mut b_z = v3(-r.y, r.x, S::zero());
    let mut bias_force = w.cross(w.cross(moment_of_mass)) - wrench.force;
    let mut moment = wrench.moment - gyroscopic;
    for &(child, _) in hung_from(n) {
        let (c, demand) = (k.joint[child] - k.joint[n], &demands[child]);
        mass = mass + demand.mass;
        let m = &demand.mass;
        let (gx, gy, gz) = (m.row_x().cross(c), m.row_y().cross(c), m.row_z().cross(c));
        b_x += gx;
        b_y += gy;
        b_z += gz;
        // −[c]× M̃[c]×
        inertia.xx += c.z * gy.x - c.y * gz.x;
        inertia.yy += c.x * gz.y - c.z * gx.y;
        inertia.zz += c.y * gx.z - c.x * gy.z;
        inertia.xy += c.z * gy.y - c.y * gz.y;
        inertia.xz += c.z * gy.z - c.y * gz.z;
        inertia.yz += c.x * gz.z - c.z * gx.z;
        let u = demand.force(w.cross(w.cross(c)));
        bias_force += u;
        moment -= c.cross(u);
    }
    let inverse = inertia.inverse();
    let (k_x, k_y, k_z) = (inverse.mul(b_x), inverse.mul(b_y), inverse.mul(b_z));
    mass.xx -= k_x.dot(b_x);
    mass.yy -= k_y.dot(b_y);
    mass.zz -= k_z.dot(b_z);
    mass.xy -= k_x.dot(b_y);
    mass.xz -= k_x.dot(b_z);
    mass.yz -= k_y.dot(b_z);
    let gain = M3 { x: k_x, y: k_y, z: k_z };
    let bias = bias_force - gain.into_frame(moment);
    (Demand { mass, bias }, Trunk { inverse_inertia: inverse, moment, gain })
}
