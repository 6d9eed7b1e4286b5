//! Panes: what breaks as a whole.
//!
//! A surface, a solid, or the solids of one group whose material breaks are a pane. It is whole or broken, for all spheres alike.
//! A commit first adds up what each segment takes of the limit, with all its spheres, by the law of the whole pane. Where one
//! reaches it, the pane is broken in that commit already: whatever presses on it then follows the law of what is left, or goes
//! through. The energy that was stored in the whole pane and is not in what is left is lost in contacts. Depth and crush are
//! those of each sphere before and after.

use super::encounter::Sphere;
use super::system::is_part;
use super::{
    ContactData, ContactHints, ContactSystem, FACE, Group, MOST_FACES, MaterialLaw, PASSED, PairHistory, weight,
};
use crate::body::Body;
use crate::forces::contact::solid::lever;
use crate::forces::element::Instant;
use crate::motion::layout::MOST_SEGMENTS;
use crate::motion::scalar::Scalar;

/// A pane is whole. No pair has such a phase.
pub(super) const WHOLE: f64 = FACE + MOST_FACES;
/// It broke under segment 0, with 1 more under segment 1, and so on.
const BROKEN: f64 = WHOLE + 1.0;

/// A pane and who meets it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Pane {
    /// Index of the surface, or of a solid behind all surfaces.
    pub surface: usize,
    /// How many segments there are.
    pub segments: usize,
    /// Groups of pairs and pairs.
    met: Vec<[usize; 2]>,
}

impl<S: Scalar> PairHistory<S> {
    /// Where it is that of a broken pane.
    #[inline(always)]
    pub(super) fn is_broken(&self) -> S::Mask {
        S::of(BROKEN - 0.5).lt(self.phase)
    }
}

impl PairHistory<f64> {
    /// The segment under which the pane broke whose memory this is.
    pub(super) fn broken_by(&self) -> Option<usize> {
        self.is_broken().then_some((self.phase - BROKEN) as usize)
    }
}

/// Where a pane has broken between two commits; panes stand behind all else.
#[inline(always)]
pub(super) fn any_broke<S: Scalar>(before: &[PairHistory<S>], now: &[PairHistory<S>]) -> S::Mask {
    // loops: closures of iterators are functions of their own, without the caller's vector instructions
    let mut broke = S::truth(false);
    for place in (0..before.len().min(now.len())).rev() {
        if !S::any(S::of(WHOLE - 0.5).lt(before[place].phase)) {
            break;
        }
        let (was, is) = (before[place].is_broken(), now[place].is_broken());
        broke = broke | (was & !is) | (is & !was);
    }
    broke
}

impl ContactSystem<f64> {
    /// Numbers panes, and tells their laws where they are remembered.
    pub(super) fn find_panes(&mut self, body: &Body, data: &ContactData<'_>) {
        let (first, surfaces, segments) = (self.first_pane(), data.surfaces.len(), body.tree.segments().len());
        // what is met as one breaks as one
        let first_of_group = |solid: usize| match &data.solids[solid].group {
            Some(group) => data.solids.iter().position(|s| s.group.as_ref() == Some(group)).unwrap_or(solid),
            None => solid,
        };
        let ContactSystem { groups, pairs, solids, panes, .. } = self;
        let mut note = |law: &mut MaterialLaw<f64>, surface: usize, met: [usize; 2]| {
            let Some(breaks) = &mut law.breaks else { return };
            let known = panes.iter().position(|pane| pane.surface == surface);
            let pane = known.unwrap_or(panes.len());
            if known.is_none() {
                panes.push(Pane { surface, segments, met: Vec::new() });
            }
            panes[pane].met.push(met);
            breaks.pane = first + pane;
        };
        let numbered = |groups: &[Group], first: usize| -> Vec<[usize; 2]> {
            let of = |(g, group): (usize, &Group)| group.pairs.clone().map(move |i| [g, i]).collect::<Vec<_>>();
            (first..).zip(groups).flat_map(of).collect()
        };
        for [g, i] in numbered(groups, 0) {
            pairs.get_mut(i).parts.iter_mut().for_each(|part| note(&mut part.law, part.surface, [g, i]));
        }
        for (j, [g, i]) in numbered(&solids.groups, groups.len()).into_iter().enumerate() {
            let pane = surfaces + first_of_group(solids.pairs[j].members[0].solid);
            note(&mut solids.laws.get_mut(j).law, pane, [g, i]);
        }
    }

    /// Whether this is a possible memory of the pane that stands at this number.
    pub(super) fn is_pane(&self, number: usize, past: &PairHistory<f64>) -> bool {
        let segments = number.checked_sub(self.first_pane()).and_then(|i| self.panes.get(i)).map(|pane| pane.segments);
        let is_state = |segments: usize| past.phase == WHOLE || (0..segments).any(|n| past.phase == BROKEN + n as f64);
        segments.is_some_and(is_state) && past.greatest.is_finite() && past.greatest >= 0.0
    }
}

impl<S> ContactSystem<S> {
    /// Place of the first pane in what is remembered.
    pub(super) fn first_pane(&self) -> usize {
        self.own.first + self.own.pairs.len()
    }

    /// A group of pairs of faces, or of solids behind them.
    fn group(&self, g: usize) -> &Group {
        self.groups.get(g).unwrap_or_else(|| &self.solids.groups[g - self.groups.len()])
    }
}

impl<S: Scalar> ContactSystem<S> {
    /// Takes over at a commit what presses on the panes that are whole; breaks those that bear no more.
    #[inline(always)]
    pub(super) fn strain_panes(&self, at: &Instant<'_, S>, past: &mut [PairHistory<S>], hints: &ContactHints<S>) {
        for (place, pane) in (self.first_pane()..).zip(&self.panes) {
            let is_whole = !past[place].is_broken();
            if !S::any(is_whole) {
                continue;
            }
            let mut strains = [S::zero(); MOST_SEGMENTS];
            for [g, i] in &pane.met {
                let group = self.group(*g);
                if hints.may_touch(*g, group, *i) {
                    let strain = &mut strains[at.spheres[group.sphere].segment];
                    *strain += self.strain(group, *i, place, at, past);
                }
            }
            let (mut most, mut by) = (S::zero(), S::zero());
            for (n, strain) in strains[..pane.segments].iter().enumerate() {
                by = S::select(most.lt(*strain), S::of(n as f64), by);
                most = most.max(*strain);
            }
            let breaks = is_whole & !most.lt(S::one());
            let history = &mut past[place];
            history.greatest = S::select(is_whole, most, history.greatest);
            history.phase = S::select(breaks, S::of(BROKEN) + by, history.phase);
        }
    }

    /// What the sphere of a group takes of the limit of a pane through pair `i`.
    #[inline(always)]
    fn strain(&self, group: &Group, i: usize, pane: usize, at: &Instant<'_, S>, past: &mut [PairHistory<S>]) -> S {
        let (mut sphere, radius, o) = (Sphere::new(self, group, at), at.spheres[group.sphere].radius, S::zero());
        let Some(pair) = self.pairs.get(i) else {
            let (j, centre) = (i - self.pairs.len(), sphere.centre_f);
            let nearest = self.solids.nearest(j, centre, radius, past, true);
            let touches = nearest.depth.gt(o);
            if !S::any(touches) {
                return o;
            }
            let (arm, weight) = (lever(nearest.depth, radius), S::select(touches, S::one(), o));
            let meeting = sphere.approach().meeting(nearest.normal, arm, nearest.depth, past[i].greatest, weight);
            return S::select(touches, self.solids.laws[j].law.strain(&meeting, pane), o);
        };
        let depth = self.planes[i].depth(sphere.centre_f);
        let live = depth.gt(o) & past[i].phase.lt(S::of(PASSED));
        if !S::any(live) {
            return o;
        }
        let approach = sphere.approach();
        let (offset, nearest) = pair.nearest(approach.centre);
        let weight = S::select(live, weight(offset.distance, radius), o);
        let meeting = approach.meeting(pair.normal, radius, depth, past[i].greatest, weight);
        let mut sum = o;
        for (k, part) in pair.parts.iter().enumerate() {
            sum += S::select(is_part(nearest, k), part.law.strain(&meeting, pane), o);
        }
        sum
    }
}
