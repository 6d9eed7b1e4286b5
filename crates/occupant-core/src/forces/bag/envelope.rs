//! The envelope of a bag and the spheres of the body in it.
//!
//! The envelope holds V_e, of which the spheres displace ΣV_k. With X = ΣV_k/V_e the gas has V_free = V_e φ(X), φ = 1 − X as far
//! as X = 0.8 and 0.2 e^((0.8 − X)/0.2) beyond: a body in a bag that has hardly unfolded would leave it less than nothing.
//! With κ = −φ′
//!
//! ```text
//! V̇_free = V̇_e (φ + κX) − κ Σ A_k δ̇_k,   force on a sphere = κ (p − p_a) A_k ∇s
//! ```
//!
//! so that the work of the gas is that of the forces exactly.

use super::MOST_SPHERES;
use super::data::Bag;
use super::shape::{ShapeLaw, displaced, size};
use super::unfold::Unfolded;
use crate::forces::decay::decay;
use crate::forces::element::Instant;
use crate::forces::sphere::Use;
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;

/// X beyond which φ is no longer 1 − X.
const CROWDED: f64 = 0.8;
/// Distance from the middle of a ball or capsule over R below which the direction of its force is lost.
const LOST: f64 = 0.1;

/// Constants of an envelope.
#[derive(Clone, Debug)]
pub(super) struct EnvelopeLaw<S> {
    /// Index of what it is fixed to.
    pub(super) frame: usize,
    /// Where, in the axes of that frame, m.
    mount: V3<S>,
    shape: ShapeLaw<S>,
    /// V_f, m³.
    pub(super) volume: S,
    /// Of the full envelope, m².
    pub(super) area: S,
    /// Indices of the spheres, and their reach.
    pub(super) spheres: Vec<(usize, S)>,
}

/// An envelope at one instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Envelope<S> {
    /// What each sphere does to it.
    pub(super) pressed: [Pressed<S>; MOST_SPHERES],
    /// V_free, m³, and its rate, m³/s.
    pub(super) free: S,
    pub(super) growth: S,
    /// κ.
    pub(super) crowd: S,
    /// Σ V_k, m³, and Σ A_k, m².
    pub(super) taken: S,
    pub(super) covered: S,
    /// The spheres that have reached the mount plane or the middle: the sum of 2^i of their places i.
    pub(super) bottoms: S,
}

/// What a sphere does to an envelope.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pressed<S> {
    /// A and V, m² and m³.
    pub(super) area: S,
    volume: S,
    /// δ̇, m/s.
    closing: S,
    /// ∇s, space axes.
    pub(super) gradient: V3<S>,
    /// 1 where it has reached the mount plane or the middle.
    bottoms: S,
    /// Depth at which it is held, m.
    pub(super) held: S,
}

impl<S: Scalar> Pressed<S> {
    #[inline(always)]
    fn none() -> Self {
        let o = S::zero();
        Pressed { area: o, volume: o, closing: o, gradient: V3::zero(), bottoms: o, held: o }
    }
}

impl EnvelopeLaw<f64> {
    pub(super) fn new(bag: &Bag) -> Self {
        EnvelopeLaw {
            frame: bag.frame.index(&[]),
            mount: V3::of(&bag.mount_m.coords),
            shape: ShapeLaw::new(bag),
            volume: bag.volume_m3,
            area: size(&bag.shape)[1],
            spheres: bag.spheres.iter().take(MOST_SPHERES).copied().collect(),
        }
    }
}

impl<S: Copy> EnvelopeLaw<S> {
    pub(super) fn is_like<A: Copy>(&self, other: &EnvelopeLaw<A>) -> bool {
        let spheres = self.spheres.iter().map(|s| s.0).eq(other.spheres.iter().map(|s| s.0));
        spheres && self.frame == other.frame && self.shape.kind() == other.shape.kind()
    }

    pub(super) fn zip<A: Copy, T>(&self, other: &EnvelopeLaw<A>, f: &impl Fn(S, A) -> T) -> Option<EnvelopeLaw<T>> {
        let spheres = self.spheres.iter().zip(&other.spheres);
        Some(EnvelopeLaw {
            frame: self.frame,
            mount: self.mount.zip(&other.mount, f),
            shape: self.shape.zip(&other.shape, f)?,
            volume: f(self.volume, other.volume),
            area: f(self.area, other.area),
            spheres: spheres.map(|((sphere, a), (_, b))| (*sphere, f(*a, *b))).collect(),
        })
    }
}

impl<S: Scalar> EnvelopeLaw<S> {
    /// The envelope, with the depths at which spheres are held.
    #[inline(always)]
    pub(super) fn at(&self, at: &Instant<'_, S>, unfolded: &Unfolded<S>, held: &[S; MOST_SPHERES]) -> Envelope<S> {
        let o = S::zero();
        let (mut taken, mut closing, mut covered, mut bottoms) = (o, o, o, o);
        let mut pressed = [Pressed::none(); MOST_SPHERES];
        for (i, (sphere, reach)) in self.spheres.iter().enumerate() {
            let one = self.press(at, unfolded, (*sphere, *reach), held[i]);
            taken += one.volume;
            closing += one.area * one.closing;
            covered += one.area;
            bottoms += one.bottoms * flag(i);
            pressed[i] = one;
        }
        let whole = self.volume * unfolded.share;
        let part = taken / whole;
        let (share, crowd) = free(part);
        let growth = self.volume * unfolded.growth * (share + crowd * part) - crowd * closing;
        Envelope { pressed, free: whole * share, growth, crowd, taken, covered, bottoms }
    }

    /// What a sphere displaces, with its reach.
    #[inline(always)]
    fn press(&self, at: &Instant<'_, S>, unfolded: &Unfolded<S>, (sphere, reach): (usize, S), held: S) -> Pressed<S> {
        let (o, frame, site) = (S::zero(), &at.frames[self.frame], &at.spheres[sphere]);
        let seen = self.seen(at, sphere);
        let near = self.shape.near(seen, unfolded.scale);
        let depth = site.radius - near.distance;
        let (is_held, touches) = (held.gt(o), depth.gt(o));
        if !S::any(touches | is_held) {
            return Pressed::none();
        }
        let (_, centre, velocity) = site.place(at.k, Use::Bag);
        let [area, volume] = displaced(S::select(is_held, held, depth).max(o), site.radius, self.shape.face());
        let relative = frame.axes.into_frame(velocity - frame.velocity_at(centre));
        let spread = unfolded.growth / (S::of(3.0) * unfolded.share) * (near.distance - near.gradient.dot(seen));
        let (mut reaches, mut is_lost) = (S::truth(false), S::truth(false));
        if let Some(left) = near.left {
            reaches = !depth.lt(left);
        }
        if let Some(part) = near.from_middle {
            is_lost = part.lt(S::of(LOST));
        }
        let holds = S::select(is_held, held, S::select(is_lost, depth, o));
        Pressed {
            area: S::select(touches & !is_held, area.max(o) * reach, o),
            volume: S::select(touches | is_held, volume * reach, o),
            closing: -near.gradient.dot(relative) - spread,
            gradient: frame.axes.out(near.gradient),
            bottoms: S::select(reaches | is_lost | is_held, S::one(), o),
            held: S::select(touches, holds, o),
        }
    }

    /// The spheres whose centres are within the full envelope: the sum of 2^i of their places i.
    #[inline(always)]
    pub(super) fn caught(&self, at: &Instant<'_, S>) -> S {
        let (o, mut sum) = (S::zero(), S::zero());
        for (i, (sphere, _)) in self.spheres.iter().enumerate() {
            let distance = self.shape.near(self.seen(at, *sphere), S::one()).distance;
            sum += S::select(distance.lt(o), flag(i), o);
        }
        sum
    }

    /// A sphere's centre seen from the mount, in the axes of the frame, m.
    #[inline(always)]
    fn seen(&self, at: &Instant<'_, S>, sphere: usize) -> V3<S> {
        at.centre_in(sphere, Use::Bag, self.frame) - self.mount
    }
}

/// 2^i.
#[inline(always)]
fn flag<S: Scalar>(i: usize) -> S {
    S::of(f64::from(1_u32 << i))
}

/// φ and κ.
#[inline(always)]
fn free<S: Scalar>(taken: S) -> (S, S) {
    let (one, rest) = (S::one(), S::of(1.0 - CROWDED));
    let beyond = (taken - S::of(CROWDED)).max(S::zero());
    if !S::any(beyond.gt(S::zero())) {
        return (one - taken, one);
    }
    let crowd = decay(beyond / rest);
    (S::select(beyond.gt(S::zero()), rest * crowd, one - taken), crowd)
}
