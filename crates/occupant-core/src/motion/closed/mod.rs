//! The report's body of 12 segments, its tree written out.
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
//! No matrix larger than 3 × 3 is ever formed, and all loops have constant bounds; `limb` treats limbs and leaves. Other
//! bodies, and this one where its joints or centres of gravity lie off the axes, are left to [`super::articulated`].

mod limb;

use limb::{Leaf, Limb};

use crate::body::tti12::TTI12;
use crate::motion::dynamics::{Accelerations, Wrench};
use crate::motion::kinematics::{Kinematics, axes};
use crate::motion::layout::{Layout, MOST_SEGMENTS};
use crate::motion::scalar::Scalar;
use crate::motion::skeleton::{Link, Skeleton};
use crate::motion::state::{Shape, State};
use crate::motion::vector::{M3, Sym3, V3, v3};

/// Number of segments.
const SEGMENTS: usize = 12;
/// Segments whose orientation is free.
pub(crate) const FREE: [usize; 8] = [0, 1, 2, 3, 4, 5, 8, 9];
/// Upper and lower segment of each limb: the lower one turns about Y of the upper one.
pub(crate) const LIMBS: [(usize, usize); 4] = [(4, 6), (5, 7), (8, 10), (9, 11)];
/// Segments on a ball joint that carry nothing.
const LEAVES: [usize; 1] = [2];
/// Segments on a ball joint that carry others on ball joints, and those: none stands before the one that carries it.
const TRUNKS: [(usize, &[usize]); 3] = [(0, &[3]), (1, &[2, 4, 5]), (3, &[8, 9])];
/// Segments whose joint is T1.
const ROOTS: [usize; 2] = [0, 1];

/// How many numbers of each kind its state has.
const SHAPE: Shape = Shape::new(FREE.len(), LIMBS.len());

/// Constants of its segments.
type Links<S> = [Link<S>; SEGMENTS];

/// Whether a tree is that of the report's body.
pub(crate) fn holds(layout: &Layout) -> bool {
    *layout == Layout::of(&TTI12)
}

/// Constants of the segments of such a body.
#[inline(always)]
fn links<S>(body: &Skeleton<S>) -> &Links<S> {
    body.links.as_slice().try_into().expect("is_closed says so")
}

/// Kinematics of `state`.
#[inline(always)]
pub(crate) fn place<S: Scalar>(k: &mut Kinematics<S>, body: &Skeleton<S>, state: &State<S>) {
    let links = links(body);
    // known sizes save checks of indices
    assert!(state.shape().with_own(0) == SHAPE, "the state is one of another tree");
    for n in ROOTS {
        (k.joint[n], k.joint_velocity[n]) = (state.t1(), state.velocity());
    }
    for (slot, &n) in FREE.iter().enumerate() {
        k.axes[n] = axes(&state.orientation(slot));
        k.omega[n] = state.omega(slot);
    }
    for (limb, &(upper, lower)) in LIMBS.iter().enumerate() {
        // X_j = R_y(α) X_m (8) for the lower segment m of a limb on its upper segment j
        let (s, c) = k.hinge_sin_cos[limb];
        let M3 { x, y, z } = k.axes[upper];
        k.hinge_axis[limb] = y;
        // T^nm = Tⁿ R_y(α) (9), (10) by columns: from those of Tⁿ X_m = c X_j − s Z_j and Z_m = s X_j + c Z_j (11)
        k.axes[lower] = M3 { x: x * c - z * s, y, z: x * s + z * c };
        k.omega[lower] = k.omega[upper] + y * state.hinge_rate()[limb]; // (45), in space axes
    }
    for &(parent, children) in &TRUNKS {
        for &child in children {
            place_joint(k, links, child, parent);
        }
    }
    for &(upper, lower) in &LIMBS {
        place_joint(k, links, lower, upper);
    }
}

/// A joint at (0, y, z) of the segment that carries it.
#[inline(always)]
fn place_joint<S: Scalar>(k: &mut Kinematics<S>, links: &Links<S>, child: usize, parent: usize) {
    let (axes, link) = (&k.axes[parent], &links[child]);
    let offset = axes.y * link.joint.y + axes.z * link.joint.z;
    k.joint[child] = k.joint[parent] + offset;
    k.joint_velocity[child] = k.joint_velocity[parent] + k.omega[parent].cross(offset);
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

/// Both sweeps through the tree, with what the one outward takes over from the one inward. Every number that is read was
/// written before in the same call, so that one may be used again without being cleared.
#[derive(Clone, Debug)]
pub(crate) struct Sweep<S> {
    demand: [Demand<S>; SEGMENTS],
    limbs: [Limb<S>; LIMBS.len()],
    leaves: [Leaf<S>; LEAVES.len()],
    trunks: [Trunk<S>; TRUNKS.len()],
}

impl<S: Scalar> Sweep<S> {
    /// Nothing solved yet.
    #[inline(always)]
    pub(crate) fn blank() -> Self {
        Sweep {
            demand: [Demand::zero(); SEGMENTS],
            limbs: [Limb::zero(); LIMBS.len()],
            leaves: [Leaf::zero(); LEAVES.len()],
            trunks: [Trunk::zero(); TRUNKS.len()],
        }
    }

    /// Accelerations without gravity.
    #[inline(always)]
    pub(crate) fn solve(
        &mut self,
        body: &Skeleton<S>,
        k: &Kinematics<S>,
        hinge_rate: &[S],
        wrench: &[Wrench<S>; MOST_SEGMENTS],
        out: &mut Accelerations<S>,
    ) {
        let (links, hinge_rate) = (links(body), &hinge_rate[..LIMBS.len()]);
        let Sweep { demand, limbs, leaves, trunks } = self;
        // inward: what carries nothing but itself, then the trunk from its ends
        for (i, &(upper, _)) in LIMBS.iter().enumerate() {
            (demand[upper], limbs[i]) = limb::reduce(links, k, i, hinge_rate[i], wrench);
        }
        for (i, &n) in LEAVES.iter().enumerate() {
            (demand[n], leaves[i]) = limb::reduce_leaf(links, k, n, wrench);
        }
        for (i, &(n, children)) in TRUNKS.iter().enumerate().rev() {
            (demand[n], trunks[i]) = reduce(links, k, n, children, wrench, demand);
        }

        // root: the forces that all halves ask of T1 vanish together
        let (mut mass, mut bias) = (demand[ROOTS[0]].mass, demand[ROOTS[0]].bias);
        for &n in &ROOTS[1..] {
            mass += demand[n].mass;
            bias += demand[n].bias;
        }
        let a_root = -mass.inverse().mul(bias);

        // outward
        for n in ROOTS {
            out.joint[n] = a_root;
        }
        for (&(n, children), trunk) in TRUNKS.iter().zip(&*trunks) {
            out.alpha[n] = trunk.alpha(out.joint[n]);
            for &child in children {
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
    }
}

/// Reduces a trunk segment to what it asks of its joint, the first result; `demands` of the segments it carries are known.
#[inline(always)]
fn reduce<S: Scalar>(
    links: &Links<S>,
    k: &Kinematics<S>,
    n: usize,
    children: &[usize],
    wrench: &[Wrench<S>; MOST_SEGMENTS],
    demands: &[Demand<S>; SEGMENTS],
) -> (Demand<S>, Trunk<S>) {
    let (link, wrench) = (&links[n], &wrench[n]);
    let (axes, w) = (&k.axes[n], k.omega[n]);
    let principal = &link.inertia;
    let mut inertia = Sym3::scaled_identity(principal.zz);
    inertia.add_outer(principal.xx - principal.zz, axes.x);
    inertia.add_outer(principal.yy - principal.zz, axes.y);
    let gyroscopic = w.cross(inertia.mul(w));
    let moment_of_mass = axes.z * link.sigma.z;

    let mut mass = Sym3::scaled_identity(link.mass);
    // rows of B = m[r]× + ΣM̃ₖ[cₖ]×; a row of M[c]× is (row of M) × c
    let r = moment_of_mass;
    let mut b_x = v3(S::zero(), -r.z, r.y);
    let mut b_y = v3(r.z, S::zero(), -r.x);
    let mut b_z = v3(-r.y, r.x, S::zero());
    let mut bias_force = w.cross(w.cross(moment_of_mass)) - wrench.force;
    let mut moment = wrench.moment - gyroscopic;
    for &child in children {
        let (c, demand) = (k.joint[child] - k.joint[n], &demands[child]);
        mass += demand.mass;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_constants_are_those_of_the_reports_tree() {
        let layout = Layout::of(&TTI12);
        let hinged = |n: &usize| layout.hinge_slot(*n).is_some();
        assert_eq!((layout.len(), layout.free()), (SEGMENTS, &FREE[..]));
        assert_eq!(SHAPE, Shape::of(&layout));
        assert_eq!(LIMBS.map(|limb| limb.1), layout.hinged());
        assert!(LIMBS.iter().all(|&(upper, lower)| layout.parent(lower) == Some(upper)));
        for (n, children) in TRUNKS {
            let own = layout.children(n).filter(|child| !hinged(child) && !ROOTS.contains(child));
            assert_eq!(own.collect::<Vec<_>>(), children);
        }
        assert!(LEAVES.iter().all(|&n| layout.children(n).next().is_none()));
        assert_eq!(TRUNKS.len() + LEAVES.len() + 2 * LIMBS.len(), SEGMENTS);
    }
}
