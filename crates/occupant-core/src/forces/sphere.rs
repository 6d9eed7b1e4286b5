//! The spheres of the body as the kernel sees them: what surfaces press on and belts go round.

use crate::body::{Body, ContactSphere};
use crate::motion::kinematics::Kinematics;
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;

/// A sphere of the body.
#[derive(Clone, Copy, Debug)]
pub struct Site<S> {
    /// Index of its segment.
    pub segment: usize,
    /// Centre seen from the segment's proximal joint, segment axes, m.
    pub offset: V3<S>,
    /// r, m.
    pub radius: S,
    /// The leg at whose knee it is, among those of all bodies; none of other spheres.
    pub knee: Option<usize>,
}

impl<S: Copy> Site<S> {
    pub(crate) fn zip<A: Copy, T>(&self, other: &Site<A>, f: &impl Fn(S, A) -> T) -> Site<T> {
        Site {
            segment: self.segment,
            offset: self.offset.zip(&other.offset, f),
            radius: f(self.radius, other.radius),
            knee: self.knee,
        }
    }
}

impl<S: Scalar> Site<S> {
    pub(crate) fn new(body: &Body, sphere: &ContactSphere) -> Site<S> {
        let offset = sphere.centre_from_lower_end_m.coords - body.joint_m(sphere.segment);
        Site { segment: sphere.segment.index(), offset: V3::of(&offset), radius: S::of(sphere.radius_m), knee: None }
    }

    /// The spheres of `body`, in its order.
    pub fn all(body: &Body) -> Vec<Site<S>> {
        body.spheres.iter().map(|sphere| Site::new(body, sphere)).collect()
    }

    /// The centre seen from the segment's joint, in space, and its velocity; all in space axes.
    #[inline(always)]
    pub(crate) fn place(&self, k: &Kinematics<S>) -> (V3<S>, V3<S>, V3<S>) {
        let n = self.segment;
        let arm = k.axes[n].out(self.offset);
        // the centre; A of (65) lies r̄ = −r N̂ from it
        (arm, k.joint[n] + arm, k.joint_velocity[n] + k.omega[n].cross(arm))
    }
}
