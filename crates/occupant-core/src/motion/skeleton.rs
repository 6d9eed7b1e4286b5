//! Constants of the multibody system: masses, inertias and joint places, seen from each segment's own joint.
//!
//! Report: "Body Geometry and Coordinate Systems". Seen from its proximal joint, the centre of gravity of a segment lies on its Z axis: at −ρ̄
//! for the hanging segments, at +ρ for the upper torso and the head (Eq. 15 as printed has ρ₁ for ρ̄₁).

use std::array::from_fn;

use crate::body::{Body, SEGMENTS, Segment};
use crate::motion::scalar::Scalar;

/// Constants of one segment.
#[derive(Clone, Copy, Debug)]
pub struct Link<S> {
    /// M, kg.
    pub mass: S,
    /// Z of the centre of gravity seen from the proximal joint, m.
    pub cg: S,
    /// Z of the far end seen from the proximal joint, m.
    pub far: S,
    /// Y of the proximal joint seen from that of the segment that carries this one, in that one's axes, m.
    pub joint_y: S,
    /// Z of it.
    pub joint_z: S,
    /// First moment of mass M·cg, kg·m.
    pub sigma: S,
    /// I_x + M·cg²: about the proximal joint, kg·m².
    pub ix: S,
    /// I_y + M·cg².
    pub iy: S,
    /// I_z.
    pub iz: S,
    /// 1/(I_y + M·cg²).
    pub inverse_iy: S,
    /// Principal inertias about the centre of gravity, kg·m².
    pub central: [S; 3],
}

/// Constants of the whole body.
#[derive(Clone, Debug)]
pub struct Skeleton<S> {
    /// Segments in the tree's order.
    pub links: [Link<S>; SEGMENTS],
    /// g along −Z′, m/s².
    pub gravity: S,
}

impl<S: Copy> Link<S> {
    /// f applied to every number and the one in the same place of `other`.
    pub(crate) fn zip<A: Copy, T>(&self, other: &Link<A>, f: &impl Fn(S, A) -> T) -> Link<T> {
        Link {
            mass: f(self.mass, other.mass),
            cg: f(self.cg, other.cg),
            far: f(self.far, other.far),
            joint_y: f(self.joint_y, other.joint_y),
            joint_z: f(self.joint_z, other.joint_z),
            sigma: f(self.sigma, other.sigma),
            ix: f(self.ix, other.ix),
            iy: f(self.iy, other.iy),
            iz: f(self.iz, other.iz),
            inverse_iy: f(self.inverse_iy, other.inverse_iy),
            central: from_fn(|i| f(self.central[i], other.central[i])),
        }
    }
}

impl<S: Copy> Skeleton<S> {
    /// f applied to every number and the one in the same place of `other`.
    pub(crate) fn zip<A: Copy, T>(&self, other: &Skeleton<A>, f: &impl Fn(S, A) -> T) -> Skeleton<T> {
        Skeleton { links: from_fn(|n| self.links[n].zip(&other.links[n], f)), gravity: f(self.gravity, other.gravity) }
    }
}

impl<S: Scalar> Skeleton<S> {
    /// Constants of `body` under gravity `gravity_m_s2`.
    pub fn new(body: &Body, gravity_m_s2: f64) -> Self {
        Skeleton { links: from_fn(|n| link(body, body.tree.segment(n))), gravity: S::of(gravity_m_s2) }
    }
}

fn link<S: Scalar>(body: &Body, segment: Segment) -> Link<S> {
    let p = body.segment(segment);
    let cg = (p.cg_m() - body.joint_m(segment)).z;
    let [_, joint_y, joint_z] = body.offset_m(segment).into();
    let [ix, iy, iz] = p.inertia_kg_m2.into();
    let about_joint = p.mass_kg * cg * cg;
    Link {
        mass: S::of(p.mass_kg),
        cg: S::of(cg),
        far: S::of(body.far_m(segment)),
        joint_y: S::of(joint_y),
        joint_z: S::of(joint_z),
        sigma: S::of(p.mass_kg * cg),
        ix: S::of(ix + about_joint),
        iy: S::of(iy + about_joint),
        iz: S::of(iz),
        inverse_iy: S::of(1.0 / (iy + about_joint)),
        central: [S::of(ix), S::of(iy), S::of(iz)],
    }
}
