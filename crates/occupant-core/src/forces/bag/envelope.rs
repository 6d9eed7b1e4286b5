//! The envelope of a bag and the spheres of the body in it.
//!
//! The envelope has the volume V_e, of which the spheres together displace V, the volume of `union`. With X = V/V_e the
//! gas has V_free = V_e φ(X), φ = 1 − X up to X = 0.8 and 0.2 e^((0.8 − X)/0.2) beyond: a body in a bag that has hardly
//! unfolded would otherwise leave it a negative volume. With κ = −φ′
//!
//! ```text
//! V̇_free = V̇_e (φ + κX) − κV̇,   force on a sphere = −κ (p − p_a) ∂V/∂x
//! ```
//!
//! so that the work of the gas is exactly that of the forces.
//!
//! While it unfolds a bag throws cover and fabric of the mass m ahead of it. The mass is distributed evenly along the
//! way from the mount: m/(3V_f λ²(1 − λ_folded)) per volume that the bag takes next. The part that meets a sphere stays
//! there and gives it its momentum, the force m/(3V_f λ²(1 − λ_folded)) A_k δ̇_k².

use super::MOST_SPHERES;
use super::data::{Bag, FOLDED};
use super::shape::{ShapeLaw, displaced, full_depth, section, size};
use super::unfold::Unfolded;
use super::union::{Cap, unite};
use crate::forces::decay::decay;
use crate::forces::element::Instant;
use crate::forces::sphere::Use;
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;
use occupant_units::trig;

/// X beyond which φ is no longer 1 − X.
const CROWDED: f64 = 0.8;
/// Distance from the centre of a ball or capsule, relative to R, below which the direction of its force is undefined.
const LOST: f64 = 0.1;

/// Constants of an envelope.
#[derive(Clone, Debug)]
pub(super) struct EnvelopeLaw<S> {
    /// Index of its frame.
    pub(super) frame: usize,
    /// Mounting point, axes of that frame, m.
    mount: V3<S>,
    shape: ShapeLaw<S>,
    /// V_f, m³.
    pub(super) volume: S,
    /// Area of the full envelope, m².
    pub(super) area: S,
    /// Mass of cover and fabric over 3V_f(1 − λ_folded), kg/m³.
    thrown: S,
    /// Indices of the spheres, and their area factors.
    pub(super) spheres: Vec<(usize, S)>,
}

/// An envelope at one instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Envelope<'a, S> {
    /// Effect of each sphere.
    pub(super) pressed: &'a [Pressed<S>],
    /// V_free, m³, and its rate, m³/s.
    pub(super) free: S,
    pub(super) growth: S,
    /// κ.
    pub(super) crowd: S,
    /// V, m³, and the area of the union, m².
    pub(super) taken: S,
    pub(super) covered: S,
    /// Bit set 2^i of the spheres i that have reached the mount plane or the centre.
    pub(super) bottoms: S,
}

/// Room for the spheres of a bag at one instant, reused by the next: it is large to clear and to copy.
#[derive(Clone, Debug)]
pub struct Room<S> {
    pressed: [Pressed<S>; MOST_SPHERES],
    caps: [Cap<S>; MOST_SPHERES],
}

impl<S: Scalar> Room<S> {
    pub(super) fn new() -> Self {
        Room { pressed: [Pressed::none(); MOST_SPHERES], caps: [no_cap(); MOST_SPHERES] }
    }
}

/// Effect of a sphere on an envelope.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pressed<S> {
    /// −∂V/∂x, space axes, m²: its force per pressure.
    pub(super) push: V3<S>,
    /// Its share of the area, m², and ∇s, space axes.
    pub(super) area: S,
    pub(super) gradient: V3<S>,
    /// Force of cover and fabric thrown at it, over |∇s|, N.
    pub(super) blow: S,
    /// 1 if it touches and is not held.
    pub(super) touches: S,
    /// Depth at which it is held, m.
    pub(super) held: S,
}

impl<S: Scalar> Pressed<S> {
    #[inline(always)]
    fn none() -> Self {
        let (o, none) = (S::zero(), V3::zero());
        Pressed { push: none, area: o, gradient: none, blow: o, touches: o, held: o }
    }
}

/// A sphere without contact.
#[inline(always)]
fn no_cap<S: Scalar>() -> Cap<S> {
    let (o, none) = (S::zero(), V3::zero());
    Cap {
        on: o,
        depth: o,
        closing: o,
        full: o,
        radius: o,
        reach: o,
        area: o,
        slope: o,
        volume: o,
        distance: o,
        gradient: none,
        seen: none,
        velocity: none,
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
            thrown: bag.cover_kg / (3.0 * bag.volume_m3 * (1.0 - trig::cbrt(FOLDED))),
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
            thrown: f(self.thrown, other.thrown),
            spheres: spheres.map(|((sphere, a), (_, b))| (*sphere, f(*a, *b))).collect(),
        })
    }
}

impl<S: Scalar> EnvelopeLaw<S> {
    /// The envelope, with the depths at which spheres are held.
    #[inline(always)]
    pub(super) fn at<'a>(
        &self,
        at: &Instant<'_, S>,
        unfolded: &Unfolded<S>,
        held: &[S; MOST_SPHERES],
        room: &'a mut Room<S>,
    ) -> Envelope<'a, S> {
        let (mut bottoms, mut touched, count) = (S::zero(), false, self.spheres.len());
        let (pressed, caps) = (&mut room.pressed[..count], &mut room.caps[..count]);
        pressed.fill(Pressed::none());
        caps.fill(no_cap());
        for (i, (sphere, reach)) in self.spheres.iter().enumerate() {
            let [has_bottomed, holds] = self.press(at, unfolded, (*sphere, *reach), held[i], &mut caps[i]);
            bottoms += has_bottomed * flag(i);
            pressed[i].held = holds;
            touched |= S::any(caps[i].volume.gt(S::zero()));
        }
        let whole = self.volume * unfolded.share;
        if !touched {
            let growth = self.volume * unfolded.growth;
            let (one, o) = (S::one(), S::zero());
            return Envelope { pressed, free: whole, growth, crowd: one, taken: o, covered: o, bottoms };
        }
        let union = unite(caps, self.shape.face());
        let axes = &at.frames[self.frame].axes;
        let is_thrown = unfolded.growth.gt(S::zero());
        let thrown = S::select(is_thrown, self.thrown / (unfolded.scale * unfolded.scale), S::zero());
        for ((pressed, cap), (area, aside)) in pressed.iter_mut().zip(&*caps).zip(&union.slopes) {
            let push = axes.out(cap.gradient * *area - *aside);
            let speed = cap.closing.max(S::zero());
            let blow = thrown * area.max(S::zero()) * speed * speed;
            let gradient = axes.out(cap.gradient);
            *pressed = Pressed { push, area: *area, gradient, blow, touches: cap.on, ..*pressed };
        }
        let part = union.volume / whole;
        let (share, crowd) = free(part);
        let growth = self.volume * unfolded.growth * (share + crowd * part) - crowd * union.rate;
        Envelope { pressed, free: whole * share, growth, crowd, taken: union.volume, covered: union.area, bottoms }
    }

    /// Computes the displacement of a single sphere; 1 where it has reached the mount plane or the centre, and the
    /// depth at which it is held.
    #[inline(always)]
    fn press(
        &self,
        at: &Instant<'_, S>,
        unfolded: &Unfolded<S>,
        (sphere, reach): (usize, S),
        held: S,
        cap: &mut Cap<S>,
    ) -> [S; 2] {
        let (o, frame, site, face) = (S::zero(), &at.frames[self.frame], &at.spheres[sphere], self.shape.face());
        let seen = self.seen(at, sphere);
        let near = self.shape.near(seen, unfolded.scale);
        let depth = site.radius - near.distance;
        let (is_held, touches) = (held.gt(o), depth.gt(o));
        if !S::any(touches | is_held) {
            return [o; 2];
        }
        let (_, centre, velocity) = site.place(at.k, Use::Bag);
        let depth_alone = S::select(is_held, held, depth).max(o);
        let [area, volume] = displaced(depth_alone, site.radius, face);
        let [_, slope] = section(depth_alone, site.radius, face);
        let relative = frame.axes.into_frame(velocity - frame.velocity_at(centre));
        let spread = unfolded.growth / (S::of(3.0) * unfolded.share) * (near.distance - near.gradient.dot(seen));
        let reaches = if let Some(left) = near.left { !depth.lt(left) } else { S::truth(false) };
        let is_lost = if let Some(part) = near.from_middle { part.lt(S::of(LOST)) } else { S::truth(false) };
        let holds = S::select(is_held, held, S::select(is_lost, depth, o));
        let presses = touches & !is_held;
        *cap = Cap {
            on: S::select(presses, S::one(), o),
            depth,
            closing: -near.gradient.dot(relative) - spread,
            full: full_depth(site.radius, face),
            radius: site.radius,
            reach,
            area: S::select(presses, area.max(o) * reach, o),
            slope: S::select(presses, slope * reach, o),
            volume: S::select(touches | is_held, volume * reach, o),
            distance: near.distance,
            gradient: near.gradient,
            seen,
            velocity: relative,
        };
        let bottoms = reaches | is_lost | is_held;
        [S::select(bottoms, S::one(), o), S::select(touches, holds, o)]
    }

    /// Bit set 2^i of the spheres i whose centres are within the full envelope.
    #[inline(always)]
    pub(super) fn caught(&self, at: &Instant<'_, S>) -> S {
        let (o, mut sum) = (S::zero(), S::zero());
        for (i, (sphere, _)) in self.spheres.iter().enumerate() {
            let distance = self.shape.near(self.seen(at, *sphere), S::one()).distance;
            sum += S::select(distance.lt(o), flag(i), o);
        }
        sum
    }

    /// A sphere's centre from the mount, axes of the frame, m.
    #[inline(always)]
    fn seen(&self, at: &Instant<'_, S>, sphere: usize) -> V3<S> {
        at.centre_in(sphere, Use::Bag, self.frame) - self.mount
    }
}

/// Bit 2^i.
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
