//! The report's body of 12 segments, its tree written out.
//!
//! A ball joint transmits a force but no moment, so a symmetric matrix and a vector represent a whole subtree at its
//! parent: the force that the subtree requires at the joint is f = M̃ a + b̃, a the joint's acceleration. For a body
//! with joint P, moment of inertia J about P, c.g. at r, and subtrees (M̃ₖ, b̃ₖ) attached at cₖ, with α its angular
//! acceleration:
//!
//! ```text
//! force    f = A a − B α + β_f     A = m1 + ΣM̃ₖ     B = m[r]× + ΣM̃ₖ[cₖ]×
//! moment   τ = J α − Bᵀ a + β_τ
//! ```
//!
//! so α = J⁻¹(τ − β_τ) + (BJ⁻¹)ᵀ a, M̃ = A − BJ⁻¹Bᵀ, b̃ = β_f − BJ⁻¹(τ − β_τ). The root T1 carries subtrees and no
//! mass. No matrix larger than 3 × 3 is ever formed, and all loops have constant bounds; `limb` treats limbs and
//! leaves. Other bodies, and this one if its joints or centres of gravity are off the axes, use [`super::articulated`].

mod limb;

use limb::{Leaf, Limb};

use crate::body::tti12::TTI12;
use crate::motion::dynamics::{Accelerations, Wrench};
use crate::motion::kinematics::{Kinematics, axes};
use crate::motion::layout::{Layout, MOST_SEGMENTS, Trunk as Tree};
use crate::motion::scalar::Scalar;
use crate::motion::skeleton::{Link, Skeleton};
#[cfg(test)]
use crate::motion::state::Shape;
use crate::motion::state::{Quat, State};
use crate::motion::vector::{M3, Sym3, V3, v3};

/// Number of segments.
const SEGMENTS: usize = 12;
/// Segments with free orientation.
pub(crate) const FREE: [usize; 8] = [0, 1, 2, 3, 4, 5, 8, 9];
/// Upper and lower segment of each limb: the lower one turns about Y of the upper one.
pub(crate) const LIMBS: [(usize, usize); 4] = [(4, 6), (5, 7), (8, 10), (9, 11)];
/// Segments on a ball joint without children.
const LEAVES: [usize; 1] = [2];
/// Segments on a ball joint that carry others on ball joints, and those others; no segment precedes its carrier.
const TRUNKS: [(usize, &[usize]); 3] = [(0, &[3]), (1, &[2, 4, 5]), (3, &[8, 9])];
/// Carriers and the segments that they carry, each after its carrier: of trunks, then of limbs.
const HUNG: [(usize, usize); 10] = [(3, 0), (2, 1), (4, 1), (5, 1), (8, 3), (9, 3), (6, 4), (7, 5), (10, 8), (11, 9)];
/// Segments whose joint is T1.
const ROOTS: [usize; 2] = [0, 1];

/// Counts of the numbers of its state.
#[cfg(test)]
const SHAPE: Shape = Shape::new(FREE.len(), LIMBS.len());

/// Constants of its segments.
type Links<S> = [Link<S>; SEGMENTS];

/// Whether a tree is that of the report's body.
pub(crate) fn holds(layout: &Layout) -> bool {
    *layout == Layout::of(&TTI12)
}

/// Constants of the segments of this body.
#[inline(always)]
fn links<'a, S>(body: &'a Skeleton<S>, trunk: &Tree) -> &'a Links<S> {
    body.links[trunk.first..][..SEGMENTS].try_into().expect("is_closed says so")
}

/// Kinematics of this body in `state`.
#[inline(always)]
pub(crate) fn place<S: Scalar>(all: &mut Kinematics<S>, bodies: &Skeleton<S>, state: &State<S>, body: usize) {
    let trunk = &bodies.layout.trunks()[body];
    let links = links(bodies, trunk);
    let Kinematics { axes: turns, omega, joint, joint_velocity, hinge_axis, hinge_sin_cos, .. } = all;
    // known sizes save checks of indices
    let (first, hinge) = (trunk.first, trunk.hinge);
    let turned: &mut [M3<S>; SEGMENTS] = of(&mut turns[first..]);
    let omega: &mut [V3<S>; SEGMENTS] = of(&mut omega[first..]);
    let joint: &mut [V3<S>; SEGMENTS] = of(&mut joint[first..]);
    let joint_velocity: &mut [V3<S>; SEGMENTS] = of(&mut joint_velocity[first..]);
    let hinge_axis: &mut [V3<S>; LIMBS.len()] = of(&mut hinge_axis[hinge..]);
    let (sin_cos, rates) = (&hinge_sin_cos[hinge..][..LIMBS.len()], &state.hinge_rate()[hinge..][..LIMBS.len()]);
    let shape = state.shape();
    let quaternions: &[S; 4 * FREE.len()] = state.block(shape.turn(trunk.free));
    let spins: &[S; 3 * FREE.len()] = state.block(shape.spin(trunk.free));
    for n in ROOTS {
        (joint[n], joint_velocity[n]) = (state.t1_of(body), state.velocity_of(body));
    }
    for (slot, &n) in FREE.iter().enumerate() {
        let q = 4 * slot;
        let (w, x, y, z) = (quaternions[q], quaternions[q + 1], quaternions[q + 2], quaternions[q + 3]);
        turned[n] = axes(&Quat { w, v: v3(x, y, z) });
        omega[n] = v3(spins[3 * slot], spins[3 * slot + 1], spins[3 * slot + 2]);
    }
    for (limb, &(upper, lower)) in LIMBS.iter().enumerate() {
        // X_j = R_y(α) X_m (8) for the lower segment m of a limb on its upper segment j
        let (s, c) = sin_cos[limb];
        let M3 { x, y, z } = turned[upper];
        hinge_axis[limb] = y;
        // T^nm = Tⁿ R_y(α) (9), (10) by columns: from those of Tⁿ X_m = c X_j − s Z_j and Z_m = s X_j + c Z_j (11)
        turned[lower] = M3 { x: x * c - z * s, y, z: x * s + z * c };
        omega[lower] = omega[upper] + y * rates[limb]; // (45), in space axes
    }
    for (child, parent) in HUNG {
        // a joint at (0, y, z) of the segment that carries it
        let (axes, link) = (&turned[parent], &links[child]);
        let offset = axes.y * link.joint.y + axes.z * link.joint.z;
        joint[child] = joint[parent] + offset;
        joint_velocity[child] = joint_velocity[parent] + omega[parent].cross(offset);
    }
}

/// The first N of a slice.
#[inline(always)]
fn of<T, const N: usize>(all: &mut [T]) -> &mut [T; N] {
    (&mut all[..N]).try_into().expect("is_closed says so")
}

/// Motion of this body among others.
pub(crate) struct Seen<'a, S> {
    axes: &'a [M3<S>; SEGMENTS],
    omega: &'a [V3<S>; SEGMENTS],
    joint: &'a [V3<S>; SEGMENTS],
    hinge_sin_cos: &'a [(S, S); LIMBS.len()],
}

impl<'a, S> Seen<'a, S> {
    #[inline(always)]
    fn new(all: &'a Kinematics<S>, tree: &Tree) -> Self {
        let (first, hinge) = (tree.first, tree.hinge);
        Seen {
            axes: seen(&all.axes[first..]),
            omega: seen(&all.omega[first..]),
            joint: seen(&all.joint[first..]),
            hinge_sin_cos: seen(&all.hinge_sin_cos[hinge..]),
        }
    }
}

/// The first N of a slice.
#[inline(always)]
fn seen<T, const N: usize>(all: &[T]) -> &[T; N] {
    all[..N].try_into().expect("is_closed says so")
}

/// Demand of a subtree at the joint that carries it: f = `mass`·a + `bias`, space axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Demand<S> {
    /// M̃, kg.
    pub mass: Sym3<S>,
    /// b̃, N; without gravity.
    pub bias: V3<S>,
}

impl<S: Scalar> Demand<S> {
    /// Zero demand.
    #[inline(always)]
    fn zero() -> Self {
        Demand { mass: Sym3::scaled_identity(S::zero()), bias: V3::zero() }
    }

    /// Force at the joint for an acceleration `a` of the joint, without gravity.
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
    /// Zero, before reduction.
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

/// Both sweeps through the tree, with the results of the inward sweep that the outward one uses. Every number that is
/// read was written before in the same call, so the space can be reused without clearing.
#[derive(Clone, Debug)]
pub(crate) struct Sweep<S> {
    demand: [Demand<S>; SEGMENTS],
    limbs: [Limb<S>; LIMBS.len()],
    leaves: [Leaf<S>; LEAVES.len()],
    trunks: [Trunk<S>; TRUNKS.len()],
}

impl<S: Scalar> Sweep<S> {
    /// Empty sweep.
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
        bodies: &Skeleton<S>,
        body: usize,
        k: &Kinematics<S>,
        hinge_rate: &[S],
        wrench: &[Wrench<S>; MOST_SEGMENTS],
        out: &mut Accelerations<S>,
    ) {
        let tree = &bodies.layout.trunks()[body];
        let (links, hinge_rate) = (links(bodies, tree), &hinge_rate[tree.hinge..][..LIMBS.len()]);
        let (k, wrench) = (&Seen::new(k, tree), seen(&wrench[tree.first..]));
        let (joint, alpha) = (of(&mut out.joint[tree.first..]), of(&mut out.alpha[tree.first..]));
        let hinge: &mut [S; LIMBS.len()] = of(&mut out.hinge[tree.hinge..]);
        let mut out = Outward { joint, alpha, hinge };
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

/// Accelerations of this body among others.
struct Outward<'a, S> {
    joint: &'a mut [V3<S>; SEGMENTS],
    alpha: &'a mut [V3<S>; SEGMENTS],
    hinge: &'a mut [S; LIMBS.len()],
}

impl<S: Scalar> Outward<'_, S> {
    /// a_child = a_parent + α×c + ω×(ω×c).
    #[inline(always)]
    fn carry(&mut self, k: &Seen<'_, S>, child: usize, parent: usize) {
        let (c, w) = (k.joint[child] - k.joint[parent], k.omega[parent]);
        self.joint[child] = self.joint[parent] + self.alpha[parent].cross(c) + w.cross(w.cross(c));
    }
}

/// Reduces a trunk segment to the demand at its joint, the first result; `demands` of the segments that it carries are
/// known.
#[inline(always)]
fn reduce<S: Scalar>(
    links: &Links<S>,
    k: &Seen<'_, S>,
    n: usize,
    children: &[usize],
    wrench: &[Wrench<S>; SEGMENTS],
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
            let own = layout
                .subtree(n)
                .filter(|child| layout.parent(*child) == Some(n))
                .filter(|child| !hinged(child) && !ROOTS.contains(child));
            assert_eq!(own.collect::<Vec<_>>(), children);
        }
        assert!(LEAVES.iter().all(|&n| layout.subtree(n).count() == 1));
        let of_trunks =
            TRUNKS.iter().flat_map(|(parent, children)| children.iter().map(move |child| (*child, *parent)));
        assert!(of_trunks.chain(LIMBS.map(|(upper, lower)| (lower, upper))).eq(HUNG));
        assert_eq!(TRUNKS.len() + LEAVES.len() + 2 * LIMBS.len(), SEGMENTS);
    }
}
