//! The law of pairs of spheres, and the owner of each pair's memory.

use super::SelfContact;
use super::series::series;
use crate::body::Body;
use crate::forces::contact::ahead::Way;
use crate::forces::contact::encounter::Approach;
use crate::forces::contact::hints::ContactHints;
use crate::forces::contact::material::{Material, Memory};
use crate::forces::contact::zip::OTHER_PAIRS;
use crate::forces::contact::{FRICTION, MaterialLaw, OPEN, PASSED, PRESS, PairHistory, TOUCHING, Touch};
use crate::forces::element::{Instant, Load, Unlike};
use crate::forces::pace::Pace;
use crate::forces::sphere::{Site, Use};
use crate::motion::frame::SPACE;
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;

/// Squares of distances below this have no direction, m².
const NO_WAY: f64 = 1e-18;

/// Pairs of spheres of the body.
#[derive(Clone, Debug, Default)]
pub(crate) struct SelfPairs<S> {
    /// Number of the first among all pairs that remember something.
    pub first: usize,
    /// What the first sphere is called among surfaces: its index behind all surfaces and solids.
    pub surface: usize,
    pub pairs: Vec<SelfPair<S>>,
    /// How many spheres the body has.
    pub spheres: usize,
}

/// A pair of spheres.
#[derive(Clone, Debug)]
pub(crate) struct SelfPair<S> {
    pub spheres: [usize; 2],
    pub law: MaterialLaw<S>,
    /// 1 where Δ_m is kept after opening, else 0.
    pub retain: S,
}

impl SelfPairs<f64> {
    /// The pairs of `data`, numbered from `first` on; there are `surfaces` surfaces and solids.
    pub(crate) fn new(
        body: &Body,
        data: Option<&SelfContact>,
        materials: &[Material],
        first: usize,
        surfaces: usize,
    ) -> Self {
        let pair = |data: &SelfContact, spheres: [usize; 2]| {
            let skins = spheres.map(|sphere| &materials[data.skins[sphere]]);
            let share = spheres.map(|sphere| body.spheres[sphere].share);
            let retain = skins.iter().any(|skin| skin.memory == Memory::Retain);
            let pair = Material {
                force: series([0, 1].map(|i| (&skins[i].force, share[i]))),
                friction: (skins[0].friction * skins[1].friction).sqrt(),
                breaks: None,
                friction_speed_m_s: skins[0].friction_speed_m_s.max(skins[1].friction_speed_m_s),
                ..skins[0].clone()
            };
            SelfPair { spheres, law: MaterialLaw::new(&pair, 1.0), retain: if retain { 1.0 } else { 0.0 } }
        };
        let pairs = data.iter().flat_map(|data| data.pairs.iter().map(|spheres| pair(data, *spheres))).collect();
        SelfPairs { first, surface: surfaces, pairs, spheres: body.spheres.len() }
    }

    /// What each remembers at the start: those that overlap have passed, until they come apart.
    pub(crate) fn start(&self, at: &Instant<'_, f64>) -> impl Iterator<Item = PairHistory<f64>> {
        self.pairs.iter().map(|pair| {
            let is_apart = pair.overlap(at.spheres, pair.centres(at)).0 <= 0.0;
            PairHistory { phase: if is_apart { OPEN } else { PASSED }, greatest: 0.0 }
        })
    }
}

impl<S: Scalar> SelfPairs<S> {
    /// The pair of this number among all, if it is one of these.
    pub(crate) fn get(&self, number: usize) -> Option<&SelfPair<S>> {
        self.pairs.get(number.checked_sub(self.first)?)
    }

    /// Adds the forces of all pairs. At an accepted step what they remember first takes over the present position; until the
    /// next, which is no later than `longest`, none comes nearer than by `reach`.
    #[inline(always)]
    pub(in crate::forces::contact) fn apply(
        &self,
        at: &Instant<'_, S>,
        past: &mut [PairHistory<S>],
        hints: &mut ContactHints<S>,
        [reach, longest]: [S; 2],
        load: &mut Load<S>,
        show: &mut impl FnMut(&Touch<S>),
    ) {
        let ContactHints { own: hints, pace, .. } = hints;
        if !at.accepted {
            for place in 0..hints.count {
                let near = hints.near[place];
                let i = near.pair as usize;
                let pair = &self.pairs[i];
                let (depth, normal) = pair.overlap(at.spheres, pair.centres(at));
                let past = &past[self.first + i];
                let live = depth.gt(S::zero()) & near.lanes & past.phase.lt(S::of(PASSED));
                pair.press(self.first + i, depth, normal, live, past.greatest, at, load, show);
            }
            return;
        }
        for ((centre, velocity), site) in hints.centres.iter_mut().zip(&mut hints.velocities).zip(at.spheres) {
            (_, *centre, *velocity) = site.place(at.k, Use::Contact);
        }
        hints.count = 0;
        for (i, pair) in self.pairs.iter().enumerate() {
            let [one, other] = pair.spheres;
            let centres = [hints.centres[one], hints.centres[other]];
            let (depth, normal) = pair.overlap(at.spheres, centres);
            let past = &mut past[self.first + i];
            pair.commit(depth, past);
            let is_here = past.phase.lt(S::of(PASSED));
            let live = depth.gt(S::zero()) & is_here;
            pair.press(self.first + i, depth, normal, live, past.greatest, at, load, show);
            let near = (-reach).lt(depth) & is_here;
            hints.note(i, depth, near);
            if S::any(near) {
                let velocity = hints.velocities[other] - hints.velocities[one];
                pair.look_ahead(at.spheres, centres, velocity, longest, near, pace);
            }
        }
    }
}

impl<S: Scalar> SelfPair<S> {
    #[inline(always)]
    fn centres(&self, at: &Instant<'_, S>) -> [V3<S>; 2] {
        let [one, other] = self.spheres;
        [at.spheres[one].place(at.k, Use::Contact).1, at.spheres[other].place(at.k, Use::Contact).1]
    }

    /// Δ and n̂ (6.4), space axes; spheres that are in the same place have a direction by rule.
    #[inline(always)]
    fn overlap(&self, sites: &[Site<S>], [from, to]: [V3<S>; 2]) -> (S, V3<S>) {
        let way = to - from;
        let squared = way.norm_squared();
        let has_way = squared.gt(S::of(NO_WAY));
        let distance = S::select(has_way, squared, S::one()).sqrt();
        let [one, other] = self.spheres.map(|sphere| sites[sphere].radius);
        let depth = one + other - S::select(has_way, distance, S::zero());
        let up = V3 { z: S::one(), ..V3::zero() };
        (depth, V3::select(has_way, way * (S::one() / distance), up))
    }

    /// Bounds the pace where the second sphere comes fast, as seen from the first.
    #[inline(always)]
    fn look_ahead(
        &self,
        sites: &[Site<S>],
        [from, to]: [V3<S>; 2],
        velocity: V3<S>,
        longest: S,
        near: S::Mask,
        pace: &mut Pace<S>,
    ) {
        let [one, other] = self.spheres.map(|sphere| sites[sphere].radius);
        let way = Way::new(to - from, velocity, one + other, longest);
        let fast = near & way.is_fast();
        if !S::any(fast) {
            return;
        }
        let gap = |place| {
            let (depth, normal) = self.overlap(sites, [V3::zero(), place]);
            (-depth, normal)
        };
        let (here, normal) = gap(way.centre);
        let touches = here.lt(S::zero());
        way.in_touch(fast & touches, normal, pace);
        way.until_touch(fast & !touches, pace, gap);
    }

    /// Takes the depth at an accepted step over.
    #[inline(always)]
    fn commit(&self, depth: S, past: &mut PairHistory<S>) {
        let touches = depth.gt(S::zero());
        let presses = past.phase.lt(S::of(PASSED));
        past.phase = S::select(touches, past.phase.max(S::of(TOUCHING)), S::of(OPEN));
        let deepest = S::select(presses, past.greatest.max(depth), past.greatest);
        past.greatest = S::select(touches, deepest, past.greatest * self.retain);
    }

    /// Adds the forces on both segments, where the pair is `live`.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "two calls, both inlined")]
    fn press(
        &self,
        number: usize,
        depth: S,
        normal: V3<S>,
        live: S::Mask,
        greatest: S,
        at: &Instant<'_, S>,
        load: &mut Load<S>,
        show: &mut impl FnMut(&Touch<S>),
    ) {
        if !S::any(live) {
            return;
        }
        let (approach, weight) = (self.approach(at), S::select(live, S::one(), S::zero()));
        let meeting = approach.meeting(-normal, lever(depth, approach.radius), depth, greatest, weight);
        let law = self.law.at(&meeting, &[]);
        let mut touch = Touch {
            sphere: self.spheres[0],
            frame: SPACE,
            pair: number,
            part: S::zero(),
            weight,
            normal: -normal,
            depth,
            closing: meeting.closing,
            velocity: approach.velocity,
            normal_force: law.force,
            edge: V3::zero(),
            friction: law.rubbing(&meeting),
            stored: weight * law.energy,
            slip: meeting.slip,
            force: V3::zero(),
        };
        touch.force = touch.normal * touch.normal_force + touch.friction;
        self.push(&touch, approach.centre, live, at, load);
        show(&touch);
    }

    /// How the first sphere moves relative to the second's segment, which is to it what a frame is to a sphere on a surface;
    /// space axes.
    #[inline(always)]
    fn approach(&self, at: &Instant<'_, S>) -> Approach<S> {
        let [one, other] = self.spheres.map(|sphere| &at.spheres[sphere]);
        let ((_, centre, velocity), (_, other_centre, other_velocity)) =
            (one.place(at.k, Use::Contact), other.place(at.k, Use::Contact));
        let (omega, other_omega) = (at.k.omega[one.segment], at.k.omega[other.segment]);
        let carried = other_velocity + other_omega.cross(centre - other_centre);
        Approach { centre, velocity: velocity - carried, omega: omega - other_omega, radius: one.radius }
    }

    /// Puts opposite forces on both segments at P, and their powers into the sums; `centre` is that of the first sphere.
    #[inline(always)]
    fn push(&self, touch: &Touch<S>, centre: V3<S>, live: S::Mask, at: &Instant<'_, S>, load: &mut Load<S>) {
        let force = touch.force;
        let [one, other] = self.spheres.map(|sphere| &at.spheres[sphere]);
        let point = centre - touch.normal * lever(touch.depth, one.radius);
        for (site, force) in [(one, force), (other, -force)] {
            let segment = site.segment;
            let (arm, on) = (point - at.k.joint[segment], &mut load.wrench[segment]);
            on.force = V3::select(live, on.force + force, on.force);
            on.moment = V3::select(live, on.moment + arm.cross(force), on.moment);
            load.press(site, Use::Contact, force, live);
        }
        // with what the second sphere rides on
        let (_, other_centre, other_velocity) = other.place(at.k, Use::Contact);
        let carried = other_velocity + at.k.omega[other.segment].cross(point - other_centre);
        load.hand_over([other.segment, one.segment], force.dot(carried), live);
        let sums = &mut load.power_at(one.segment).sums;
        let (pressing, rubbing) = (touch.normal_force * touch.closing, touch.friction.dot(touch.slip));
        sums[PRESS] = S::select(live, sums[PRESS] + pressing, sums[PRESS]);
        sums[FRICTION] = S::select(live, sums[FRICTION] - rubbing, sums[FRICTION]);
    }
}

/// How far P is from the centre of a sphere towards the other (6.4).
#[inline(always)]
pub(crate) fn lever<S: Scalar>(depth: S, radius: S) -> S {
    radius - depth * S::of(0.5)
}

impl<S: Copy> SelfPairs<S> {
    pub(crate) fn zip<A: Copy, T>(&self, other: &SelfPairs<A>, f: &impl Fn(S, A) -> T) -> Result<SelfPairs<T>, Unlike> {
        let pairs = self.pairs.iter().zip(&other.pairs);
        if self.pairs.len() != other.pairs.len() || pairs.clone().any(|(a, b)| a.spheres != b.spheres) {
            return Err(OTHER_PAIRS);
        }
        let pair = |(a, b): (&SelfPair<S>, &SelfPair<A>)| {
            Ok(SelfPair { spheres: a.spheres, law: a.law.zip(&b.law, f)?, retain: f(a.retain, b.retain) })
        };
        let &SelfPairs { first, surface, spheres, .. } = self;
        Ok(SelfPairs { first, surface, pairs: pairs.map(pair).collect::<Result<_, _>>()?, spheres })
    }
}
