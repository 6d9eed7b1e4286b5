//! The interface of a kind of force element.

use std::fmt::Debug;

use crate::body::Body;
use crate::forces::list::STORES;
use crate::forces::pace::Pace;
use crate::forces::rate::Rate;
use crate::forces::sphere::{Riding, Site, Use};
use crate::motion::dynamics::Wrench;
use crate::motion::frame::{Frames, MOST_FRAMES, Moving};
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::{Layout, MOST_BODIES, MOST_SEGMENTS, MOST_SLIDES};
use crate::motion::mobility::Mobility;
use crate::motion::scalar::Scalar;
use crate::motion::state::{MOST_OWN, State, Work};
use crate::motion::vector::V3;
use crate::quantity::{Energy, FieldWords, Quantity};
use placed_text::Problems;

/// A kind of force element: all elements of one kind in a model share a law, a place in the energy ledger, and the code
/// that checks, places, stores and compares them.
///
/// The implementing type is only a name; the types of its law and memory are associated types. A kind may use the body,
/// its motion and the frames, and knows no other kind.
pub trait Element: Copy + Debug {
    /// Whether results list the kind only where a model has elements of it.
    const OPTIONAL: bool = false;
    /// Work sums of other kinds (indices) to which the elements also contribute.
    const SHARES: &'static [usize] = &[];
    /// Energies that the elements store; the first is also their first place in the energy ledger.
    const STORED: &'static [StoredEnergy];
    /// Work sums to which they contribute.
    const SUMS: &'static [WorkSum];
    /// Name in messages, singular and plural.
    const NAMES: [&'static str; 2];

    /// Setup data of the elements.
    type Data<'a>: Copy;
    /// Constants of the law.
    type Law<S>;
    /// Memory of one element between steps: numbers that change at accepted steps only.
    type Past<S>;
    /// Data that save evaluations unnecessary work, without effect on results.
    type Hints<S: Scalar>: Hints<S>;
    /// State of one element at one instant: forces, energies.
    type Action<S>;

    /// Reports problems of the data alone.
    fn check(data: Self::Data<'_>, body: &Body, problems: &mut Problems);

    /// Constants that do not depend on the position of the body.
    fn new(data: Self::Data<'_>, body: &Body) -> Self::Law<f64>;

    /// Constants that follow from the position of the body, called during settling with locked joints and at the start
    /// of the run.
    fn lay(_law: &mut Self::Law<f64>, _data: Self::Data<'_>, _body: &Body, _at: &Instant<'_, f64>) {}

    /// Constants that follow from the position of the body at the start of the run only; reports problems of the start.
    fn begin(
        _law: &mut Self::Law<f64>,
        _data: Self::Data<'_>,
        _body: &Body,
        _at: &Instant<'_, f64>,
        _problems: &mut Problems,
    ) {
    }

    /// Appends the initial state variables of the elements, scaled to the order of 1; each element keeps its index.
    fn own(_law: &mut Self::Law<f64>, _numbers: &mut Vec<f64>) {}

    /// Initial memory of each element for a body at rest in its position.
    fn start(law: &Self::Law<f64>, at: &Instant<'_, f64>) -> Vec<Self::Past<f64>>;

    /// Updates memory and `hints` after a small motion of the body, enough for evaluations that do not commit. Returns
    /// the number of elements that an evaluation visits.
    fn restart(
        law: &Self::Law<f64>,
        at: &Instant<'_, f64>,
        past: &mut Vec<Self::Past<f64>>,
        _hints: &mut Self::Hints<f64>,
    ) -> usize {
        *past = Self::start(law, at);
        past.len()
    }

    /// Hints that skip nothing.
    fn hints<S: Scalar>(law: &Self::Law<S>) -> Self::Hints<S>;

    /// Largest length of the step that begins at the commit that left these hints.
    fn pace<S: Scalar>(_hints: &Self::Hints<S>) -> Pace<S> {
        Pace::any()
    }

    /// Number of elements with a memory.
    fn count<S>(law: &Self::Law<S>) -> usize;

    /// Largest number of elements that act at one instant.
    fn most_actions<S>(law: &Self::Law<S>) -> usize {
        Self::count(law)
    }

    /// f applied to every number of a law and the one in the same place of another.
    ///
    /// # Errors
    /// Laws of unlike structure.
    fn zip<S: Copy, A: Copy, T>(
        one: &Self::Law<S>,
        other: &Self::Law<A>,
        f: &impl Fn(S, A) -> T,
    ) -> Result<Self::Law<T>, Unlike>;

    /// Whether a commit marks the elements whose memory it may have changed; otherwise it may have changed any. Histories have
    /// room for the marks of one kind.
    const MARKS: bool = false;

    /// Calls f with each pair of corresponding numbers of two memories, in a fixed order.
    fn each<S, A>(one: &mut Self::Past<S>, other: &mut Self::Past<A>, f: &mut impl FnMut(&mut S, &mut A));

    /// Memory with each number replaced by f of it, in the order of [`Element::each`].
    fn map<A: Copy, S>(past: &Self::Past<A>, f: &mut impl FnMut(A) -> S) -> Self::Past<S>;

    /// Whether this is a possible memory of the element with this index.
    fn is_possible(_law: &Self::Law<f64>, _number: usize, _past: &Self::Past<f64>) -> bool {
        true
    }

    /// What could not be computed within the last step, as text; none if everything was. The memory may then contain
    /// NaN.
    fn failure(_data: Self::Data<'_>, _law: &Self::Law<f64>, _past: &[Self::Past<f64>]) -> Option<String> {
        None
    }

    /// Whether the memory can jump because an element can switch during a run. A change of slope does not count.
    fn can_switch(_law: &Self::Law<f64>) -> bool {
        false
    }

    /// Switch state of an element, as a number that differs after each switch.
    #[inline(always)]
    fn switches<S: Scalar>(_past: &Self::Past<S>) -> S {
        S::zero()
    }

    /// Lanes where any element has switched between two memories of all.
    #[inline(always)]
    fn any_switched<S: Scalar>(before: &[Self::Past<S>], now: &[Self::Past<S>]) -> S::Mask {
        // a loop: the closure of a fold is a function of its own, without the caller's vector instructions
        let mut mask = S::truth(false);
        for (before, now) in before.iter().zip(now) {
            let (before, now) = (Self::switches::<S>(before), Self::switches::<S>(now));
            mask = mask | before.lt(now) | now.lt(before);
        }
        mask
    }

    /// Fraction of the interval between `before` and `now`, at the times `times_s`, at which the first switch of the element
    /// with this number was due; none if unknown. Up to 0 it was due before.
    fn due<S: Scalar<Mask = bool>>(
        _law: &Self::Law<S>,
        _number: usize,
        _before: &Self::Past<S>,
        _now: &Self::Past<S>,
        _times_s: [S; 2],
    ) -> Option<S> {
        None
    }

    /// Restores a memory to its permitted range after small changes of its numbers.
    fn confine(_past: &mut Self::Past<f64>) {}

    /// Adds forces and powers to `load` and passes on every action. At an accepted step each element first updates its
    /// memory with the present position; within a step the memory is only read.
    fn apply<S: Scalar>(
        law: &Self::Law<S>,
        at: &Instant<'_, S>,
        past: &mut [Self::Past<S>],
        hints: &mut Self::Hints<S>,
        load: &mut Load<S>,
        show: &mut impl FnMut(&Self::Action<S>),
    );

    /// Fastest rates that the elements add to the equations of motion at the start, each acting alone.
    fn rates(
        _data: Self::Data<'_>,
        _body: &Body,
        _at: &Instant<'_, f64>,
        _actions: &[Self::Action<f64>],
        _mobility: &Mobility<'_>,
    ) -> Vec<Rate> {
        Vec::new()
    }

    /// Segment whose body's energy ledger contains an action (index).
    fn segment(law: &Self::Law<f64>, spheres: &[Site<f64>], number: usize, action: &Self::Action<f64>) -> usize;

    /// Writes the energies of [`Element::STORED`] at one instant to their places, J.
    fn stored_j(actions: &[Self::Action<f64>], stored_j: &mut [f64; STORES]);
}

/// Fraction of the linear path from one number to another, greater one at which a level is reached. Beyond the path,
/// its derivatives are those of the remaining difference.
pub(crate) fn passes<S: Scalar>(level: S, before: S, now: S) -> S {
    let way = (now - before).value_alone();
    S::select(now.gt(before), S::one() + (level - now) / way, S::zero())
}

/// Data that save evaluations unnecessary work; unless it says otherwise, data of which nothing outlasts an evaluation.
pub trait Hints<S: Scalar>: Clone + Debug {
    /// Copies `other`, of the same elements, without allocation.
    #[inline(always)]
    fn take_over(&mut self, _other: &Self) {}

    /// Visits every element in these lanes until the next commit, as required if the memory belongs to another
    /// position.
    #[inline(always)]
    fn look_again(&mut self, _lanes: S::Mask) {}

    /// Copies `other`, of the same elements, in these lanes.
    #[inline(always)]
    fn blend(&mut self, _other: &Self, _lanes: S::Mask) {}

    /// Copies `other` without what cannot act within the step from its commit, which is this share of the longest.
    #[inline(always)]
    fn take_over_for(&mut self, _other: &Self, _share: S) {}
}

/// No hints.
impl<S: Scalar> Hints<S> for () {}

/// Room that evaluations reuse, if there are elements that need it.
impl<S: Scalar, T: Clone + Debug> Hints<S> for Option<Box<T>> {}

/// Energy stored by the elements of a kind, or dissipated according to their memory.
#[derive(Clone, Copy, Debug)]
pub struct StoredEnergy {
    /// Index in the energy ledger.
    pub at: usize,
    /// Name in results.
    pub quantity: Quantity<Energy>,
    /// Work sum that also contains it; none if it follows from the posture alone.
    pub held_by: Option<HeldBy>,
}

/// Work sum that contains a stored energy: dissipation is the sum less the change of stored energy since the start.
#[derive(Clone, Copy, Debug)]
pub struct HeldBy {
    /// Index of the sum.
    pub sum: usize,
    /// Field of a result file for the energy at the start of the run.
    pub start: FieldWords,
}

impl HeldBy {
    /// The sum with this index, and the field of the energy at the start.
    pub(crate) const fn sum(sum: usize, number: u32, stem: &'static str, meaning: &'static str) -> Option<Self> {
        Some(HeldBy { sum, start: FieldWords { number, stem, meaning } })
    }
}

/// A sum of work in [`Work::sums`].
#[derive(Clone, Copy, Debug)]
pub struct WorkSum {
    /// Index there and among the losses of the energy ledger.
    pub at: usize,
    /// Name of the loss in results.
    pub quantity: Quantity<Energy>,
}

/// Positions and velocities of the body and the frames at one instant.
#[derive(Clone, Copy, Debug)]
pub struct Instant<'a, S> {
    /// Positions and velocities of the segments.
    pub k: &'a Kinematics<S>,
    /// State.
    pub state: &'a State<S>,
    /// Frames.
    pub frames: &'a Frames<S>,
    /// Motion of the segments that carry contact faces.
    pub carried: &'a [Moving<S>],
    /// Spheres of the bodies.
    pub spheres: &'a [Site<S>],
    /// Whether this is an accepted step, at which memory is updated.
    pub accepted: bool,
}

impl<'a, S: Scalar> Instant<'a, S> {
    /// Motion of a frame, or of a segment that carries faces; the latter have indices after all frames.
    #[inline(always)]
    pub(crate) fn frame(&self, index: usize) -> &'a Moving<S> {
        if index < MOST_FRAMES { &self.frames[index] } else { &self.carried[index - MOST_FRAMES] }
    }

    /// Centre of a sphere for this use, in axes of the frame, m.
    #[inline(always)]
    pub(crate) fn centre_in(&self, sphere: usize, by: Use, frame: usize) -> V3<S> {
        let frame = self.frame(frame);
        let (_, centre, _) = self.spheres[sphere].place(self.k, by);
        frame.axes.into_frame(centre - frame.origin)
    }
}

/// Largest number of legs of all bodies.
pub(crate) const MOST_LEGS: usize = 2 * MOST_BODIES;
/// Most frames that yield.
pub(crate) const MOST_GIVING: usize = 4;

/// Loads on the segments except gravity, and their powers.
#[derive(Clone, Copy, Debug)]
pub struct Load<S> {
    /// By segment.
    pub wrench: [Wrench<S>; MOST_SEGMENTS],
    /// By body, W.
    pub power: [Work<S>; MOST_BODIES],
    /// Forces of each body on the yielding frames, and their moments about the origin of space, space axes, N and N·m.
    pub(crate) onto: [[Wrench<S>; MOST_GIVING]; MOST_BODIES],
    /// One plus the index there of each yielding frame; 0 of other frames.
    giving: [u8; MOST_FRAMES],
    body_of: [u8; MOST_SEGMENTS],
    bodies: usize,
    /// Rates of the state variables that force elements own, 1/s; each element writes its own at every evaluation.
    pub own: [S; MOST_OWN],
    /// By segment: moment of all loads except joints, N·m.
    pub(crate) outer: [V3<S>; MOST_SEGMENTS],
    /// By leg: force on the spheres at its knee, space axes, N.
    pub(crate) knees: [V3<S>; MOST_LEGS],
    /// By plate: forces on the points that move with it, weighted by their shares, space axes, N.
    pub(crate) rides: [V3<S>; MOST_SLIDES],
    /// Generalized resistance S of each plate, N.
    pub(crate) resist: [S; MOST_SLIDES],
    segments: usize,
}

impl<S: Scalar> Load<S> {
    /// Zero loads with these yielding frames.
    #[inline(always)]
    pub(crate) fn zero(layout: &Layout, giving: impl IntoIterator<Item = usize>) -> Self {
        let mut body_of = [0; MOST_SEGMENTS];
        for (to, row) in body_of.iter_mut().zip(layout.rows()) {
            *to = row.body as u8;
        }
        let (wrench, power) = ([Wrench::zero(); MOST_SEGMENTS], [Work::zero(); MOST_BODIES]);
        let (bodies, own) = (layout.trunks().len(), [S::zero(); MOST_OWN]);
        let onto = [[Wrench::zero(); MOST_GIVING]; MOST_BODIES];
        let (outer, knees) = ([V3::zero(); MOST_SEGMENTS], [V3::zero(); MOST_LEGS]);
        let (none, segments) = ([0; MOST_FRAMES], layout.len());
        let (rides, resist) = ([V3::zero(); MOST_SLIDES], [S::zero(); MOST_SLIDES]);
        let mut load =
            Load { wrench, power, onto, giving: none, body_of, bodies, own, outer, knees, rides, resist, segments };
        for (frame, behind) in giving.into_iter().zip(1..=MOST_GIVING as u8) {
            load.giving[frame % MOST_FRAMES] = behind;
        }
        load
    }

    /// Sets all loads to zero for this number of segments.
    #[inline(always)]
    pub(crate) fn clear(&mut self, segments: usize, slides: usize) {
        self.wrench[..segments].fill(Wrench::zero());
        self.power[..self.bodies].fill(Work::zero());
        self.onto[..self.bodies].fill([Wrench::zero(); MOST_GIVING]);
        self.knees[..2 * self.bodies].fill(V3::zero());
        self.segments = segments;
        self.rides[..slides].fill(V3::zero());
        self.resist[..slides].fill(S::zero());
    }

    /// Stores the moments so far; later ones are of joints.
    #[inline(always)]
    pub(crate) fn end_of_outer(&mut self) {
        let both = self.outer.iter_mut().zip(&self.wrench).take(self.segments);
        both.for_each(|(outer, wrench)| *outer = wrench.moment);
    }

    /// Notes a force on a sphere for this use, space axes, N, in the `live` lanes: for the plates that it moves with
    /// and for a sphere at a knee.
    #[inline(always)]
    pub(crate) fn press(&mut self, site: &Site<S>, by: Use, force: V3<S>, live: S::Mask) {
        if let Some(riding) = site.riding(by) {
            self.ride(riding, force, live);
        }
        let Some(knee) = site.knee else { return };
        let on = &mut self.knees[knee % MOST_LEGS];
        *on = V3::select(live, *on + force, *on);
    }

    /// Notes a force on a point that moves with plates, space axes, N, in the `live` lanes.
    #[inline(always)]
    pub(crate) fn ride(&mut self, riding: &Riding<S>, force: V3<S>, live: S::Mask) {
        for (plate, share) in riding.plates() {
            let on = &mut self.rides[plate];
            *on = V3::select(live, *on + force * share, *on);
        }
    }

    /// Number of bodies.
    #[inline(always)]
    pub(crate) fn bodies(&self) -> usize {
        self.bodies
    }

    /// Adds the reaction to a frame of a force on a segment at a point, and of a moment, space axes, N, m and N·m, in
    /// the `live` lanes.
    #[inline(always)]
    pub(crate) fn push(&mut self, [frame, segment]: [usize; 2], force: V3<S>, at: V3<S>, twist: V3<S>, live: S::Mask) {
        let Some(place) = self.giving.get(frame).and_then(|behind| behind.checked_sub(1)) else { return };
        let body = self.body_of[segment] as usize % MOST_BODIES;
        let onto = &mut self.onto[body][place as usize % MOST_GIVING];
        onto.force = V3::select(live, onto.force - force, onto.force);
        onto.moment = V3::select(live, onto.moment - at.cross(force) - twist, onto.moment);
    }

    /// Books power that the body of one segment gives to that of another, if they differ, in the `live` lanes, W.
    #[inline(always)]
    pub(crate) fn hand_over(&mut self, [from, to]: [usize; 2], power: S, live: S::Mask) {
        if self.body_of[from] != self.body_of[to] {
            for (segment, work) in [(to, power), (from, -power)] {
                let others = &mut self.power_at(segment).others;
                *others = S::select(live, *others + work, *others);
            }
        }
    }

    /// Powers of the body of a segment.
    #[inline(always)]
    pub(crate) fn power_at(&mut self, segment: usize) -> &mut Work<S> {
        // no more bodies than powers
        &mut self.power[self.body_of[segment] as usize % MOST_BODIES]
    }
}

/// Reason why two systems cannot be computed side by side, as text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Unlike(pub &'static str);

/// Mismatch between a memory and its elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Misfit {
    /// Different number of elements.
    #[error("the checkpoint has {found} {of}, the scenario {expected}")]
    Count {
        /// Kind of element.
        of: &'static str,
        /// Number in the checkpoint.
        found: usize,
        /// Number in the model.
        expected: usize,
    },
    /// Impossible state of an element.
    #[error("the checkpoint's {of} {number} is in no possible state")]
    Impossible {
        /// Kind of element.
        of: &'static str,
        /// Index of the element.
        number: usize,
    },
    /// Number that is not finite.
    #[error("the checkpoint holds numbers that are not finite")]
    NotFinite,
}
