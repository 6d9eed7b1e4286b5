//! What pairs and belts remember between steps, and which pairs are worth looking at.
//!
//! Nearly all pairs of a sphere and a face are far apart. A commit looks at all pairs of a group, keeps in mind those that
//! are near, in contact or passed, and how far the nearest of the others is. As long as the sphere has not moved as far
//! as that, the others cannot have come near: later commits leave them alone. No result depends on it.

use super::belts::BeltHistory;
use super::contact::{ContactSystem, Group, OPEN, PairHistory};
use super::encounter::Sphere;
use super::scalar::Scalar;
use super::vector::{V3, v3};

/// Distances are trusted to this, m.
const MARGIN_M: f64 = 1e-9;

/// What pairs and belts remember between steps; changed only at accepted steps.
#[derive(Clone, Debug)]
pub struct History<S: Scalar> {
    /// By pair.
    pub pairs: Vec<PairHistory<S>>,
    /// By belt.
    pub belts: Vec<BeltHistory<S>>,
    /// The watched pairs of each group in ascending order, from the place of its first pair on.
    pub(super) watched: Vec<Watched<S>>,
    /// By group of pairs.
    pub(super) looks: Vec<Look<S>>,
}

/// A pair that a commit must look at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Watched<S: Scalar> {
    pub pair: u32,
    /// Where it can exert a force before the next commit.
    pub near: S::Mask,
}

/// The last look at all pairs of a group.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look<S> {
    /// How many pairs are watched since.
    pub count: usize,
    /// Where the sphere was, axes of the frame, m.
    centre: V3<S>,
    /// Square of the way that the sphere may go before the next look, m²; negative if there must be one.
    reach_squared: S,
}

impl<S: Scalar> History<S> {
    /// A history in which every pair counts as near until the first commit.
    pub fn new(
        contacts: &ContactSystem<S>,
        pairs: Vec<PairHistory<S>>,
        belts: Vec<BeltHistory<S>>,
    ) -> Self {
        let near = S::truth(true);
        let watched = (0..pairs.len() as u32).map(|pair| Watched { pair, near });
        let looks = contacts.groups.iter().map(|group| Look {
            count: group.pairs.len(),
            centre: V3::zero(),
            reach_squared: -S::one(),
        });
        History {
            watched: watched.collect(),
            looks: looks.collect(),
            pairs,
            belts,
        }
    }

    /// A history of the shape of `other` whose numbers are all `value`.
    pub fn like<A: Scalar>(contacts: &ContactSystem<S>, other: &History<A>, value: S) -> Self {
        let pair = PairHistory {
            phase: value,
            greatest: value,
        };
        let belt = BeltHistory {
            normal: v3(value, value, value),
            greatest: value,
        };
        let pairs = vec![pair; other.pairs.len()];
        History::new(contacts, pairs, vec![belt; other.belts.len()])
    }

    /// f called with every remembered number and the one in the same place of `other`, a history of the same pairs and
    /// belts: to hand numbers over, either way. Which pairs are watched is not handed over; see [`History::look_again`].
    pub fn each<A: Scalar>(&mut self, other: &mut History<A>, f: &mut impl FnMut(&mut S, &mut A)) {
        for (a, b) in self.pairs.iter_mut().zip(&mut other.pairs) {
            f(&mut a.phase, &mut b.phase);
            f(&mut a.greatest, &mut b.greatest);
        }
        for (a, b) in self.belts.iter_mut().zip(&mut other.belts) {
            f(&mut a.normal.x, &mut b.normal.x);
            f(&mut a.normal.y, &mut b.normal.y);
            f(&mut a.normal.z, &mut b.normal.z);
            f(&mut a.greatest, &mut b.greatest);
        }
    }

    /// Becomes what `other`, a history of the same pairs and belts, is.
    pub fn take_over(&mut self, other: &History<S>) {
        self.pairs.copy_from_slice(&other.pairs);
        self.belts.copy_from_slice(&other.belts);
        self.watched.copy_from_slice(&other.watched);
        self.looks.copy_from_slice(&other.looks);
    }

    /// Lets the next commit look at every pair, as it must where the remembered numbers are those of another place.
    pub fn look_again(&mut self) {
        for look in &mut self.looks {
            look.reach_squared = -S::one();
        }
    }

    /// The watched pairs of `group`, number `g`.
    #[inline(always)]
    pub(super) fn watched_of(&self, g: usize, group: &Group) -> std::ops::Range<usize> {
        let start = group.pairs.start;
        start..start + self.looks[g].count
    }

    /// True if the sphere may have come near pairs of group `g` that are not watched.
    #[inline(always)]
    pub(super) fn must_look(&self, g: usize, centre: V3<S>) -> bool {
        let look = &self.looks[g];
        let way = (centre - look.centre).norm_squared();
        S::any(!way.lt(look.reach_squared))
    }
}

/// A look at all pairs of a group, under way.
pub(super) struct Looking<S> {
    first: usize,
    count: usize,
    /// Δ of the nearest pair that is not watched, negative.
    nearest: S,
}

impl<S: Scalar> Looking<S> {
    #[inline(always)]
    pub fn new(group: &Group) -> Self {
        Looking {
            first: group.pairs.start,
            count: 0,
            nearest: S::of(f64::NEG_INFINITY),
        }
    }

    /// Decides whether pair `i`, committed at deformation `depth`, is watched.
    #[inline(always)]
    pub fn at(
        &mut self,
        i: usize,
        depth: S,
        contacts: &ContactSystem<S>,
        history: &mut History<S>,
    ) {
        let pair = &history.pairs[i];
        let within = (-contacts.reach_of_a_step).lt(depth);
        if S::any(within | pair.phase.gt(S::of(OPEN))) {
            history.watched[self.first + self.count] = Watched {
                pair: i as u32,
                near: contacts.is_near(depth, pair),
            };
            self.count += 1;
        } else {
            self.nearest = self.nearest.max(depth);
        }
    }

    /// Remembers the look of `sphere` at group `g`.
    #[inline(always)]
    pub fn end(
        self,
        g: usize,
        sphere: &Sphere<'_, S>,
        contacts: &ContactSystem<S>,
        history: &mut History<S>,
    ) {
        let reach = -self.nearest - contacts.reach_of_a_step - S::of(MARGIN_M);
        let reach = reach.max(S::zero());
        history.looks[g] = Look {
            count: self.count,
            centre: sphere.centre_f,
            reach_squared: reach * reach,
        };
    }
}
