//! Which pairs to evaluate.
//!
//! Nearly all pairs of a sphere and a face are far apart, or have passed each other for good. A commit checks all pairs
//! of a group. It stores those that touch or may soon come near or open, and the distance of the nearest of the others.
//! Until the sphere has moved that far, nothing can have happened to the others, and later commits skip them. Among the
//! watched pairs those that can exert a force before the next commit are near: first within the longest step, then within
//! the one that is taken. Evaluations within a step use no others. Results do not depend on it.

use std::ops::Range;

use crate::forces::contact::{ContactSystem, Group, OPEN, PASSED, PairHistory};
use crate::forces::element::Hints;
use crate::forces::marks::Marks;
use crate::forces::pace::Pace;
#[cfg(any(target_arch = "x86_64", test))]
use crate::motion::lanes::Lanes;
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;
#[cfg(any(target_arch = "x86_64", test))]
use crate::motion::vector::v3;

/// Distances are trusted to this, m.
const MARGIN_M: f64 = 1e-9;
/// How far a sphere goes at least before all its pairs are looked at again, m: a longer way costs more watched pairs, a
/// shorter one more looks.
pub(super) const LEAST_WAY_M: f64 = 0.02;

/// Which pairs to evaluate.
#[derive(Clone, Debug)]
pub struct ContactHints<S: Scalar> {
    /// Pairs that a commit must look at: those of each group in ascending order, from the place of its first pair on.
    pub(super) watched: Vec<u32>,
    /// Pairs that an evaluation within a step must look at, in the same way.
    pub(super) near: Vec<Near<S>>,
    /// By group of pairs.
    looks: Vec<Look<S>>,
    pub(super) own: OwnHints<S>,
    /// How far any sphere may come in the longest step from the latest commit, m.
    pub(super) reach: S,
    /// How long the step may be that begins at the latest commit.
    pub(in crate::forces) pace: Pace<S>,
    /// What the latest commit looked at, and so may have changed.
    pub(in crate::forces) changed: Marks,
    spare: Spare<S>,
}

/// Room for lists that become one.
#[derive(Clone, Debug)]
struct Spare<S: Scalar> {
    watched: Vec<u32>,
    near: Vec<Near<S>>,
}

/// Which pairs of spheres of the body are worth looking at.
#[derive(Clone, Debug)]
pub(super) struct OwnHints<S: Scalar> {
    /// The first of them, `count`, can exert a force before the next commit.
    pub near: Vec<Near<S>>,
    pub count: usize,
    /// Room for the centres of all spheres.
    pub centres: Vec<V3<S>>,
    /// And for their velocities.
    pub velocities: Vec<V3<S>>,
}

impl<S: Scalar> OwnHints<S> {
    fn new(pairs: usize, spheres: usize) -> Self {
        let near: Vec<_> = (0..pairs as u32).map(Near::always).collect();
        let room = vec![V3::zero(); if pairs > 0 { spheres } else { 0 }];
        OwnHints { near, count: pairs, centres: room.clone(), velocities: room }
    }

    /// Adds pair `i`, committed at deformation `depth`, in these lanes.
    #[inline(always)]
    pub(super) fn note(&mut self, i: usize, depth: S, lanes: S::Mask) {
        if S::any(lanes) {
            self.near[self.count] = Near { pair: i as u32, depth, lanes };
            self.count += 1;
        }
    }
}

/// A pair that can exert a force before the next commit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near<S: Scalar> {
    pub pair: u32,
    /// Deformation at the commit, m.
    depth: S,
    /// Where it can.
    pub lanes: S::Mask,
}

impl<S: Scalar> Near<S> {
    /// Near however short the step.
    #[inline(always)]
    fn always(pair: u32) -> Self {
        Near { pair, depth: S::of(f64::INFINITY), lanes: S::truth(true) }
    }

    /// Copies to `list` those of `all` that a sphere meets on the way `reach`; how many they are.
    #[inline(always)]
    fn within(list: &mut [Near<S>], all: &[Near<S>], reach: S) -> usize {
        let mut count = 0;
        for near in all {
            let lanes = near.lanes & (-reach).lt(near.depth);
            if S::any(lanes) {
                list[count] = Near { lanes, ..*near };
                count += 1;
            }
        }
        count
    }
}

/// The last look at all pairs of a group.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look<S> {
    /// Place of its first pair.
    first: usize,
    /// How many pairs are watched since.
    watched: usize,
    /// How many pairs were near at the last commit.
    near: usize,
    /// Where the sphere was, axes of the frame, m.
    centre: V3<S>,
    /// How far the nearest pair that is not watched was at least, m; negative if there must be a look.
    least: S,
    /// How far the sphere may come in the longest step from the latest commit, m.
    reach: S,
}

impl<S: Scalar> ContactHints<S> {
    /// Every pair counts as near until the first commit.
    pub(super) fn new(contacts: &ContactSystem<S>) -> Self {
        let all = 0..(contacts.pairs.len() + contacts.solids.pairs.len()) as u32;
        let looks = contacts.groups.iter().chain(&contacts.solids.groups).map(|group| Look {
            first: group.pairs.start,
            watched: group.pairs.len(),
            near: group.pairs.len(),
            centre: V3::zero(),
            least: -S::one(),
            reach: S::zero(),
        });
        ContactHints {
            watched: all.clone().collect(),
            near: all.map(Near::always).collect(),
            looks: looks.collect(),
            own: OwnHints::new(contacts.own.pairs.len(), contacts.own.spheres),
            reach: S::zero(),
            pace: Pace::any(),
            changed: Marks::none(contacts.first_pane() + contacts.panes.len()),
            spare: Spare { watched: Vec::new(), near: Vec::new() },
        }
    }

    /// Places of the watched pairs of `group`, number `g`.
    #[inline(always)]
    pub(super) fn watched_of(&self, g: usize, group: &Group) -> Range<usize> {
        let start = group.pairs.start;
        start..start + self.looks[g].watched
    }

    /// Places of the near pairs of `group`, number `g`.
    #[inline(always)]
    pub(super) fn near_of(&self, g: usize, group: &Group) -> Range<usize> {
        let start = group.pairs.start;
        start..start + self.looks[g].near
    }

    /// No pair of group `g` is near until the next commit.
    #[inline(always)]
    pub(super) fn has_none_near(&mut self, g: usize) {
        self.looks[g].near = 0;
    }

    /// Whether pair `i` of `group`, number `g`, may touch at the next commit; of what the last commit has not seen all may.
    #[inline(always)]
    pub(super) fn may_touch(&self, g: usize, group: &Group, i: usize) -> bool {
        let near = &self.near[self.near_of(g, group)];
        near.iter().any(|near| near.pair as usize == i) || S::any(self.looks[g].least.lt(S::zero()))
    }

    /// Makes the watched pairs of `group`, number `g`, those that an evaluation looks at; returns how many there are.
    pub(super) fn look_at_watched(&mut self, g: usize, group: &Group) -> usize {
        for place in self.watched_of(g, group) {
            self.near[place] = Near::always(self.watched[place]);
        }
        self.looks[g].near = self.looks[g].watched;
        self.looks[g].near
    }

    /// True if the sphere may come within `reach` of pairs of group `g` that are not watched.
    #[inline(always)]
    pub(super) fn must_look(&self, g: usize, centre: V3<S>, reach: S) -> bool {
        let look = &self.looks[g];
        let way = (look.least - reach).max(S::zero());
        S::any(!(centre - look.centre).norm_squared().lt(way * way))
    }
}

#[cfg(any(target_arch = "x86_64", test))]
impl ContactHints<f64> {
    /// Watches what `lanes`, of like elements, watch; with what they know of lane `i`. Of what is near any lane all counts as
    /// near.
    pub(in crate::forces) fn watch_as<L: Lanes>(&mut self, lanes: &ContactHints<L>, i: usize) {
        for (own, look) in self.looks.iter_mut().zip(&lanes.looks) {
            let Look { first, watched, near, centre, least, reach } = look;
            *own = Look {
                first: *first,
                watched: *watched,
                near: *near,
                centre: v3(centre.x.lane(i), centre.y.lane(i), centre.z.lane(i)),
                least: least.lane(i),
                reach: reach.lane(i),
            };
            for place in *first..first + watched {
                self.watched[place] = lanes.watched[place];
            }
            for place in *first..first + near {
                self.near[place] = Near::always(lanes.near[place].pair);
            }
        }
        self.pace = Pace::any();
    }
}

impl<S: Scalar> Hints<S> for ContactHints<S> {
    fn take_over(&mut self, other: &Self) {
        self.looks.copy_from_slice(&other.looks);
        for Look { first, watched, near, .. } in &self.looks {
            self.watched[*first..][..*watched].copy_from_slice(&other.watched[*first..][..*watched]);
            self.near[*first..][..*near].copy_from_slice(&other.near[*first..][..*near]);
        }
        self.own.count = other.own.count;
        self.own.near[..other.own.count].copy_from_slice(&other.own.near[..other.own.count]);
        self.reach = other.reach;
        self.pace = other.pace;
    }

    fn look_again(&mut self, lanes: S::Mask) {
        for look in &mut self.looks {
            look.least = S::select(lanes, -S::one(), look.least);
        }
        self.pace = Pace::select(lanes, Pace::any(), self.pace);
    }

    #[inline(always)]
    fn blend(&mut self, other: &Self, lanes: S::Mask) {
        let ContactHints { watched, near, looks, own, reach, pace, spare, changed: _ } = self;
        for (look, others) in looks.iter_mut().zip(&other.looks) {
            let first = look.first;
            look.watched = spare.join(&mut watched[first..], look.watched, &other.watched[first..][..others.watched]);
            look.near = spare.blend(&mut near[first..], look.near, &other.near[first..][..others.near], lanes);
            look.centre = V3::select(lanes, others.centre, look.centre);
            look.least = S::select(lanes, others.least, look.least);
            look.reach = S::select(lanes, others.reach, look.reach);
        }
        own.count = spare.blend(&mut own.near, own.count, &other.own.near[..other.own.count], lanes);
        *reach = S::select(lanes, other.reach, *reach);
        *pace = Pace::select(lanes, other.pace, *pace);
    }

    #[inline(always)]
    fn take_over_for(&mut self, other: &Self, share: S) {
        for (own, look) in self.looks.iter_mut().zip(&other.looks) {
            *own = *look;
            // mostly a few, for which a loop is quicker than a call
            for place in look.first..look.first + look.watched {
                self.watched[place] = other.watched[place];
            }
            let near = &other.near[look.first..look.first + look.near];
            own.near = Near::within(&mut self.near[look.first..], near, look.reach * share);
        }
        let reach = other.reach * share;
        self.own.count = Near::within(&mut self.own.near, &other.own.near[..other.own.count], reach);
        self.reach = other.reach;
        self.pace = other.pace;
    }
}

impl<S: Scalar> Spare<S> {
    /// Adds the pairs of `other` to the first `count` of `list`; both are in ascending order. How many there are then.
    fn join(&mut self, list: &mut [u32], count: usize, other: &[u32]) -> usize {
        if list[..count] == *other {
            return count;
        }
        let all = &mut self.watched;
        all.clear();
        all.extend_from_slice(&list[..count]);
        all.extend_from_slice(other);
        all.sort_unstable();
        all.dedup();
        list[..all.len()].copy_from_slice(all);
        all.len()
    }

    /// Makes the first `count` of `list` those of `other` in these lanes; both are in ascending order. How many there are
    /// then.
    #[inline(always)]
    fn blend(&mut self, list: &mut [Near<S>], count: usize, other: &[Near<S>], lanes: S::Mask) -> usize {
        let all = &mut self.near;
        all.clear();
        let (mut i, mut j) = (0, 0);
        while i < count || j < other.len() {
            let own = if i < count { list[i].pair } else { u32::MAX };
            let others = if j < other.len() { other[j].pair } else { u32::MAX };
            let (pair, mut mask, mut depth) = (own.min(others), S::truth(false), S::zero());
            if own == pair {
                (mask, depth) = (list[i].lanes & !lanes, list[i].depth);
                i += 1;
            }
            if others == pair {
                mask = mask | (other[j].lanes & lanes);
                depth = S::select(lanes, other[j].depth, depth);
                j += 1;
            }
            if S::any(mask) {
                all.push(Near { pair, depth, lanes: mask });
            }
        }
        list[..all.len()].copy_from_slice(all);
        all.len()
    }
}

/// The near pairs of a group, being collected.
pub(super) struct Nearing {
    first: usize,
    count: usize,
}

impl Nearing {
    #[inline(always)]
    pub(super) fn new(group: &Group) -> Self {
        Nearing { first: group.pairs.start, count: 0 }
    }

    /// Decides whether pair `i`, committed at deformation `depth`, is near.
    #[inline(always)]
    pub(super) fn at<S: Scalar>(
        &mut self,
        i: usize,
        depth: S,
        reach: S,
        pair: &PairHistory<S>,
        hints: &mut ContactHints<S>,
    ) {
        // not passed, and within reach of a step
        let lanes = (-reach).lt(depth) & pair.phase.lt(S::of(PASSED));
        if S::any(lanes) {
            let pair = i as u32;
            hints.near[self.first + self.count] = Near { pair, depth, lanes };
            self.count += 1;
        }
    }

    /// Stores the near pairs of group `g`, whose sphere comes within `reach` in the longest step.
    #[inline(always)]
    pub(super) fn end<S: Scalar>(self, g: usize, reach: S, hints: &mut ContactHints<S>) {
        (hints.looks[g].near, hints.looks[g].reach) = (self.count, reach);
    }
}

/// A look at all pairs of a group, under way.
pub(super) struct Looking<S> {
    first: usize,
    count: usize,
    /// |Δ| of the pair that is not watched and has the least.
    least: S,
}

impl<S: Scalar> Looking<S> {
    #[inline(always)]
    pub(super) fn new(group: &Group) -> Self {
        Looking { first: group.pairs.start, count: 0, least: S::of(f64::INFINITY) }
    }

    /// Decides whether pair `i`, committed at deformation `depth`, is watched: an open one until the sphere comes near, a
    /// passed one until the sphere comes back, one that touches always.
    #[inline(always)]
    pub(super) fn at(&mut self, i: usize, depth: S, reach: S, pair: &PairHistory<S>, hints: &mut ContactHints<S>) {
        let phase = pair.phase;
        let touches = phase.gt(S::of(OPEN)) & phase.lt(S::of(PASSED));
        let (off, enough) = (depth.abs(), reach + S::of(LEAST_WAY_M));
        self.watch(i, touches | off.lt(enough), off, hints);
    }

    /// Watches pair `i` if `is_near` in any lane; else nothing happens to it on the way `off`.
    #[inline(always)]
    pub(super) fn watch(&mut self, i: usize, is_near: S::Mask, off: S, hints: &mut ContactHints<S>) {
        if S::any(is_near) {
            hints.watched[self.first + self.count] = i as u32;
            self.count += 1;
        } else {
            self.pass(off);
        }
    }

    /// Does not watch a pair, to which nothing happens on the way `off`.
    #[inline(always)]
    pub(super) fn pass(&mut self, off: S) {
        self.least = self.least.min(off);
    }

    /// Stores the look at group `g` from `centre`.
    #[inline(always)]
    pub(super) fn end(self, g: usize, centre: V3<S>, hints: &mut ContactHints<S>) {
        let look = &mut hints.looks[g];
        look.watched = self.count;
        look.centre = centre;
        look.least = (self.least - S::of(MARGIN_M)).max(S::zero());
    }
}
