//! The spheres of the body in the kernel: surfaces press on them, and belts go round them.

use crate::body::{Body, ContactSphere, Shares};
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::MOST_SLIDES;
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;

/// Use of a sphere: each use may move in its own way with yielding parts of a segment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Use {
    /// Surfaces, solids and other spheres.
    #[default]
    Contact,
    /// Belts.
    Belt,
    /// Air bags.
    Bag,
    /// Support of the spine: it does not move with plates.
    Back,
}

/// Largest number of plates that one point moves with.
pub(crate) const MOST_RIDDEN: usize = 3;

/// Motion of a point with plates: its shares of their deflections.
#[derive(Clone, Copy, Debug)]
pub struct Riding<S> {
    plates: [u8; MOST_RIDDEN],
    count: u8,
    shares: [S; MOST_RIDDEN],
}

impl Riding<f64> {
    /// Shares of the first few of these plates.
    pub(crate) fn new(shares: &Shares) -> Self {
        let mut riding = Riding { plates: [0; MOST_RIDDEN], count: 0, shares: [0.0; MOST_RIDDEN] };
        for (i, (plate, share)) in shares.iter().take(MOST_RIDDEN).enumerate() {
            (riding.plates[i], riding.shares[i], riding.count) = (*plate as u8, *share, i as u8 + 1);
        }
        riding
    }
}

impl<S: Copy> Riding<S> {
    /// Whether another moves with the same plates.
    pub(crate) fn is_like<A: Copy>(&self, other: &Riding<A>) -> bool {
        self.count == other.count && self.plates == other.plates
    }

    /// The plates.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = usize> {
        self.plates.iter().take(self.count as usize).map(|plate| *plate as usize)
    }

    pub(crate) fn zip<A: Copy, T>(&self, other: &Riding<A>, f: &impl Fn(S, A) -> T) -> Riding<T> {
        let shares = std::array::from_fn(|i| f(self.shares[i], other.shares[i]));
        Riding { plates: self.plates, count: self.count, shares }
    }

    /// The plates with their shares.
    #[inline(always)]
    pub(crate) fn plates(&self) -> impl Iterator<Item = (usize, S)> {
        let all = self.plates.iter().zip(&self.shares).take(self.count as usize);
        all.map(|(plate, share)| (*plate as usize % MOST_SLIDES, *share))
    }
}

impl<S: Scalar> Riding<S> {
    /// Displacement, and velocity relative to the segment, space axes.
    #[inline(always)]
    pub(crate) fn carried(&self, k: &Kinematics<S>) -> [V3<S>; 2] {
        let mut sum = [V3::zero(); 2];
        for (plate, share) in self.plates() {
            let slid = &k.slides[plate];
            sum[0] += slid.axis * (share * slid.way);
            sum[1] += slid.axis * (share * slid.speed);
        }
        sum
    }
}

/// A sphere of the body.
#[derive(Clone, Copy, Debug)]
pub struct Site<S> {
    /// Index of its segment.
    pub segment: usize,
    /// Centre from the segment's proximal joint, segment axes, m.
    pub offset: V3<S>,
    /// r, m.
    pub radius: S,
    /// Leg at whose knee it is, among those of all bodies; none for other spheres.
    pub knee: Option<usize>,
    /// Motion with plates under contact, belts and bags; none for a sphere without any.
    pub(crate) ride: Option<[Riding<S>; 3]>,
}

impl<S: Copy> Site<S> {
    /// Whether another is of the same segment and moves with the same plates.
    pub(crate) fn is_like<A: Copy>(&self, other: &Site<A>) -> bool {
        let rides = match (&self.ride, &other.ride) {
            (Some(own), Some(other)) => own.iter().zip(other).all(|(a, b)| a.is_like(b)),
            (own, other) => own.is_none() && other.is_none(),
        };
        rides && self.segment == other.segment
    }

    pub(crate) fn zip<A: Copy, T>(&self, other: &Site<A>, f: &impl Fn(S, A) -> T) -> Site<T> {
        Site {
            segment: self.segment,
            offset: self.offset.zip(&other.offset, f),
            radius: f(self.radius, other.radius),
            knee: self.knee,
            ride: self.ride.zip(other.ride).map(|(a, b)| std::array::from_fn(|i| a[i].zip(&b[i], f))),
        }
    }
}

impl<S: Scalar> Site<S> {
    pub(crate) fn new(body: &Body, sphere: &ContactSphere) -> Site<S> {
        let offset = sphere.centre_from_lower_end_m.coords - body.joint_m(sphere.segment);
        let on = |shares: &Shares| {
            let riding = Riding::new(shares);
            riding.zip(&riding, &|share, _: f64| S::of(share))
        };
        let rides = !sphere.ride.plates().is_empty();
        let ride = rides.then(|| [&sphere.ride.contact, &sphere.ride.belt, &sphere.ride.bag].map(on));
        Site {
            segment: sphere.segment.index(),
            offset: V3::of(&offset),
            radius: S::of(sphere.radius_m),
            knee: None,
            ride,
        }
    }

    /// The spheres of `body`, in its order.
    pub fn all(body: &Body) -> Vec<Site<S>> {
        body.spheres.iter().map(|sphere| Site::new(body, sphere)).collect()
    }

    /// Motion with plates for a use.
    #[inline(always)]
    pub(crate) fn riding(&self, by: Use) -> Option<&Riding<S>> {
        let ride = self.ride.as_ref()?;
        ride.get(by as usize)
    }

    /// Vector from the segment's joint to the centre, and velocity, for a use; space axes.
    #[inline(always)]
    pub(crate) fn place(&self, k: &Kinematics<S>, by: Use) -> (V3<S>, V3<S>, V3<S>) {
        let n = self.segment;
        if let Some(riding) = self.riding(by) {
            let [way, speed] = riding.carried(k);
            let arm = k.axes[n].out(self.offset) + way;
            return (arm, k.joint[n] + arm, k.joint_velocity[n] + k.omega[n].cross(arm) + speed);
        }
        let arm = k.axes[n].out(self.offset);
        // the centre; A of (65) lies r̄ = −r N̂ from it
        (arm, k.joint[n] + arm, k.joint_velocity[n] + k.omega[n].cross(arm))
    }
}
