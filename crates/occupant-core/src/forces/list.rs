//! The list of all kinds of force elements, and what follows from it.

use super::bag::Bags;
use super::belt::Belts;
use super::chain::Chains;
use super::column::{Columns, Hinges};
use super::contact::Contacts;
use super::element::{Element, Hints, Instant, Load, Misfit, StoredEnergy, Unlike, WorkSum};
use super::joint::JointMoments;
use super::joint::limit::JointLimits;
use super::joint::muscle::Muscles;
use super::marks::Marks;
use super::own::OwnForces;
use super::pace::Pace;
use super::plate::Plates;
use super::rate::Rate;
use super::shown::{Reported, Tracker};
use super::stored::Archive;
use crate::body::Body;
use crate::forces::sphere::Site;
#[cfg(any(target_arch = "x86_64", test))]
use crate::motion::lanes::Lanes;
use crate::motion::layout::Layout;
use crate::motion::mobility::Mobility;
use crate::motion::scalar::Scalar;
use crate::motion::state::WORK_SUMS;
use crate::quantity::{Energy, Quantity};
use placed_text::Problems;

/// Code for all kinds of elements, in the order in which their forces are added.
macro_rules! kinds {
    ($($kind:ident: $Kind:ident),+ $(,)?) => {
        /// Number of kinds.
        pub(crate) const KINDS: usize = [$(stringify!($kind)),+].len();

        const _: () = assert!(0 $(+ $Kind::MARKS as usize)+ <= 1, "a history has the marks of one kind");

        /// Number of stored energies.
        pub(crate) const STORES: usize = 0 $(+ $Kind::STORED.len())+;

        /// Stored energies, in the order of results.
        pub(crate) const STORED: [StoredEnergy; STORES] = stored_in_order([$($Kind::STORED),+]);

        /// Work sums of the elements, in their order in [`crate::motion::state::Work`].
        pub(crate) const SUMS: [WorkSum; WORK_SUMS] = sums_in_order([$($Kind::SUMS),+]);

        /// Setup data of all force elements.
        #[derive(Clone, Copy)]
        #[allow(missing_docs, reason = "one field for each kind")]
        pub struct Data<'a> {
            $(pub $kind: <$Kind as Element>::Data<'a>),+
        }

        /// Force laws of all elements.
        #[derive(Clone, Debug)]
        #[allow(missing_docs, reason = "one field for each kind")]
        pub struct Forces<S> {
            $(pub $kind: <$Kind as Element>::Law<S>),+
        }

        /// Memory of the force elements between steps: plain numbers that a run carries on.
        #[derive(Clone, Debug, PartialEq)]
        #[allow(missing_docs, reason = "one field for each kind")]
        pub struct Memory<S> {
            $(pub $kind: Vec<<$Kind as Element>::Past<S>>),+
        }

        #[derive(Clone, Debug)]
        struct AllHints<S: Scalar> {
            $($kind: <$Kind as Element>::Hints<S>),+
        }

        /// State of all force elements at one instant.
        #[derive(Clone, Debug)]
        #[allow(missing_docs, reason = "one field for each kind")]
        pub struct Actions<S> {
            $(pub $kind: Vec<<$Kind as Element>::Action<S>>),+
        }

        /// Receives the actions of an evaluation.
        #[allow(missing_docs, reason = "one method for each kind")]
        pub trait Observer<S> {
            $(
                #[inline(always)]
                fn $kind(&mut self, _action: &<$Kind as Element>::Action<S>) {}
            )+
        }

        /// Collects all actions.
        impl<S: Copy> Observer<S> for Actions<S> {
            $(
                #[inline(always)]
                fn $kind(&mut self, action: &<$Kind as Element>::Action<S>) {
                    self.$kind.push(*action);
                }
            )+
        }

        /// Calls a follower for all kinds, in their order.
        #[derive(Debug)]
        pub(crate) struct Follow<T>(pub T);

        impl<S: Scalar, T: Tracker<S>> Observer<S> for Follow<T> {
            $(
                #[inline(always)]
                fn $kind(&mut self, action: &<$Kind as Element>::Action<S>) {
                    $Kind::track(action, &mut self.0);
                }
            )+
        }

        /// Passes everything to another observer, or nothing: one kernel for evaluations that are observed now and
        /// then.
        impl<S, O: Observer<S>> Observer<S> for Option<&mut O> {
            $(
                #[inline(always)]
                fn $kind(&mut self, action: &<$Kind as Element>::Action<S>) {
                    if let Some(observer) = self {
                        observer.$kind(action);
                    }
                }
            )+
        }

        $(
            impl Listed for $Kind {
                fn data<'a>(all: &Data<'a>) -> Self::Data<'a> {
                    all.$kind
                }
                fn law<S>(all: &Forces<S>) -> &Self::Law<S> {
                    &all.$kind
                }
                fn past<S>(all: &Memory<S>) -> &[Self::Past<S>] {
                    &all.$kind
                }
                fn actions<S>(all: &Actions<S>) -> &[Self::Action<S>] {
                    &all.$kind
                }
            }
        )+

        /// Visits the kinds in the order in which their forces are added.
        pub fn visit_kinds(visitor: &mut impl Visitor) {
            $(visitor.visit::<$Kind>();)+
        }

        impl<S> Actions<S> {
            /// Reserves space for all actions of `forces`.
            pub fn with_room(forces: &Forces<impl Sized>) -> Self {
                Actions { $($kind: Vec::with_capacity($Kind::most_actions(&forces.$kind))),+ }
            }

            /// Clears all actions.
            pub fn clear(&mut self) {
                $(self.$kind.clear();)+
            }

            /// Copies `other`, without allocation if the space suffices.
            pub(crate) fn take_over(&mut self, other: &Self)
            where
                S: Copy,
            {
                $(
                    self.$kind.clear();
                    self.$kind.extend_from_slice(&other.$kind);
                )+
            }
        }

        impl Actions<f64> {
            /// Passes all actions to a follower, in the order of the kinds.
            pub(crate) fn follow(&self, tracker: &mut impl Tracker<f64>) {
                $(self.$kind.iter().for_each(|action| $Kind::track(action, tracker));)+
            }

            /// Stored energies in the order of [`STORED`], J.
            pub(crate) fn stored_j(&self) -> [f64; STORES] {
                let mut list = [0.0; STORES];
                $($Kind::stored_j(&self.$kind, &mut list);)+
                list
            }

            /// Stored energies of the elements that act on one of several bodies, J.
            pub(crate) fn stored_of(
                &self,
                forces: &Forces<f64>,
                spheres: &[Site<f64>],
                layout: &Layout,
                body: usize,
            ) -> [f64; STORES] {
                let rows = layout.rows();
                if layout.trunks().len() == 1 {
                    return self.stored_j();
                }
                let mut own = Actions { $($kind: Vec::new()),+ };
                $(
                    let law = &forces.$kind;
                    let is_own = |(i, action): &(usize, &<$Kind as Element>::Action<f64>)| {
                        rows[$Kind::segment(law, spheres, *i, action)].body == body
                    };
                    own.$kind.extend(self.$kind.iter().enumerate().filter(is_own).map(|(_, action)| *action));
                )+
                own.stored_j()
            }
        }

        impl Data<'_> {
            /// Reports problems of the data alone, in the order of [`STORED`], then of elements that store nothing.
            pub(crate) fn check(&self, body: &Body, problems: &mut Problems) {
                let mut found = [const { Problems::new() }; STORES + 1];
                $(
                    let place = $Kind::STORED.first().map_or(STORES, |energy| energy.at);
                    $Kind::check(self.$kind, body, &mut found[place]);
                )+
                found.into_iter().for_each(|some| problems.extend(some));
            }

            /// Fastest rates of the elements at the start; see [`Element::rates`].
            pub(crate) fn rates(
                &self,
                body: &Body,
                at: &Instant<'_, f64>,
                actions: &Actions<f64>,
                mobility: &Mobility<'_>,
            ) -> Vec<Rate> {
                let mut list = Vec::new();
                $(list.extend($Kind::rates(self.$kind, body, at, &actions.$kind, mobility));)+
                list
            }
        }

        impl Forces<f64> {
            /// No elements.
            pub fn none() -> Self {
                Forces { $($kind: Default::default()),+ }
            }

            /// Laws of a body without a position yet.
            pub(crate) fn new(data: &Data<'_>, body: &Body) -> Self {
                Forces { $($kind: $Kind::new(data.$kind, body)),+ }
            }

            /// Constants that depend on the position, during settling or at the start; see [`Element::lay`].
            pub(crate) fn lay(&mut self, data: &Data<'_>, body: &Body, at: &Instant<'_, f64>) {
                $($Kind::lay(&mut self.$kind, data.$kind, body, at);)+
            }

            /// Constants that depend on the initial position; see [`Element::begin`].
            pub(crate) fn begin(
                &mut self,
                data: &Data<'_>,
                body: &Body,
                at: &Instant<'_, f64>,
                problems: &mut Problems,
            ) {
                $($Kind::begin(&mut self.$kind, data.$kind, body, at, problems);)+
            }

            /// Initial state variables that elements own; see [`Element::own`].
            pub(crate) fn own(&mut self) -> Vec<f64> {
                let mut numbers = Vec::new();
                $($Kind::own(&mut self.$kind, &mut numbers);)+
                numbers
            }

            /// Initial memory of all elements of a body at rest in its position.
            pub(crate) fn start(&self, at: &Instant<'_, f64>) -> History<f64> {
                History::new(self, Memory { $($kind: $Kind::start(&self.$kind, at)),+ })
            }

            /// Memory for a body that moves from position to position, for evaluations without a commit; see
            /// [`Element::restart`].
            pub(crate) fn restart(&self, at: &Instant<'_, f64>, history: &mut History<f64>) -> usize {
                let History { memory, hints } = history;
                0 $(+ $Kind::restart(&self.$kind, at, &mut memory.$kind, &mut hints.$kind))+
            }
        }

        impl<S: Copy> Forces<S> {
            /// Whether results list an energy of [`STORED`] or [`SUMS`]; see [`Element::OPTIONAL`].
            pub(crate) fn tells(&self, energy: &Quantity<Energy>) -> bool {
                let field = |energy: &Quantity<Energy>| energy.field.map(|words| words.number);
                let is = |own: Quantity<Energy>| field(&own) == field(energy);
                let mut tells = true;
                $(if $Kind::STORED.iter().any(|own| is(own.quantity)) || $Kind::SUMS.iter().any(|own| is(own.quantity)) {
                    tells = !$Kind::OPTIONAL || $Kind::most_actions(&self.$kind) > 0;
                })+
                $(tells |= $Kind::SHARES.iter().any(|at| is(SUMS[*at].quantity)) && $Kind::most_actions(&self.$kind) > 0;)+
                tells
            }

            /// f applied to every number and the one in the same place of `other`.
            ///
            /// # Errors
            /// Elements of unlike structure.
            pub(crate) fn zip<A: Copy, T>(&self, other: &Forces<A>, f: &impl Fn(S, A) -> T) -> Result<Forces<T>, Unlike> {
                Ok(Forces { $($kind: $Kind::zip(&self.$kind, &other.$kind, f)?),+ })
            }
        }

        impl<S: Scalar> Forces<S> {
            /// All loads and powers at one instant. At an accepted step the history is first updated with the present
            /// position; within a step it is only read.
            #[inline(always)]
            pub(crate) fn apply(
                &self,
                at: &Instant<'_, S>,
                history: &mut History<S>,
                observer: &mut (impl Observer<S> + ?Sized),
                load: &mut Load<S>,
            ) {
                $($Kind::apply(
                    &self.$kind,
                    at,
                    &mut history.memory.$kind,
                    &mut history.hints.$kind,
                    load,
                    &mut |action| observer.$kind(action),
                );)+
            }
        }

        impl Forces<f64> {
            /// Whether any element can switch; see [`Element::can_switch`].
            pub(crate) fn can_switch(&self) -> bool {
                false $(|| $Kind::can_switch(&self.$kind))+
            }
        }

        impl<S: Scalar> Memory<S> {
            /// Lanes where an element has switched between this memory and `now`, of the same elements.
            #[inline(always)]
            pub fn has_switched(&self, now: &Self) -> S::Mask {
                S::truth(false) $(| $Kind::any_switched::<S>(&self.$kind, &now.$kind))+
            }
        }

        impl Memory<f64> {
            /// Elements that have switched between this memory and `now`: their kind and index.
            pub fn switched(&self, now: &Self) -> Vec<(&'static str, usize)> {
                let mut list = Vec::new();
                $(
                    let both = self.$kind.iter().zip(&now.$kind).enumerate();
                    let switched = both.filter(|(_, (a, b))| $Kind::switches::<f64>(a) != $Kind::switches::<f64>(b));
                    list.extend(switched.map(|(i, _)| ($Kind::NAMES[0], i)));
                )+
                list
            }
        }

        impl<S: Scalar<Mask = bool>> Memory<S> {
            /// When the first switch between this memory and `now` was due; see [`Element::due`].
            pub fn due(&self, now: &Self, forces: &Forces<S>, times_s: [S; 2]) -> Due<S> {
                let mut due = Due { share: S::of(f64::INFINITY), is_known: true };
                $(
                    for (i, (before, now)) in self.$kind.iter().zip(&now.$kind).enumerate() {
                        let [was, is] = [before, now].map($Kind::switches::<S>);
                        if was.lt(is) || is.lt(was) {
                            due.see($Kind::due(&forces.$kind, i, before, now, times_s));
                        }
                    }
                )+
                due
            }
        }

        impl<S> Memory<S> {
            /// Memory of no elements.
            pub fn none() -> Self {
                Memory { $($kind: Vec::new()),+ }
            }

            /// Calls f with each pair of corresponding numbers of two memories of the same elements.
            pub fn each<A>(&mut self, other: &mut Memory<A>, f: &mut impl FnMut(&mut S, &mut A)) {
                $(
                    for (one, other) in self.$kind.iter_mut().zip(&mut other.$kind) {
                        $Kind::each(one, other, f);
                    }
                )+
            }

            /// The same without the elements that have no mark, of kinds that mark.
            #[cfg(any(target_arch = "x86_64", test))]
            pub(crate) fn each_marked<A>(
                &mut self,
                other: &mut Memory<A>,
                marks: &Marks,
                f: &mut impl FnMut(&mut S, &mut A),
            ) {
                $(
                    if $Kind::MARKS {
                        for i in marks.iter() {
                            $Kind::each(&mut self.$kind[i], &mut other.$kind[i], f);
                        }
                    } else {
                        for (one, other) in self.$kind.iter_mut().zip(&mut other.$kind) {
                            $Kind::each(one, other, f);
                        }
                    }
                )+
            }
        }

        impl<S: Copy> Memory<S> {
            /// Memory with each number replaced by f of it, in the order of [`Memory::each`].
            pub fn map<T>(&self, f: &mut impl FnMut(S) -> T) -> Memory<T> {
                Memory { $($kind: self.$kind.iter().map(|past| $Kind::map(past, f)).collect()),+ }
            }

            pub(crate) fn take_over(&mut self, other: &Self) {
                $(self.$kind.copy_from_slice(&other.$kind);)+
            }

            /// The same, where both are equal in the elements that have no mark, of kinds that mark.
            #[inline(always)]
            pub(crate) fn take_over_marked(&mut self, other: &Self, marks: &Marks) {
                $(
                    if $Kind::MARKS {
                        for i in marks.iter() {
                            self.$kind[i] = other.$kind[i];
                        }
                    } else {
                        self.$kind.copy_from_slice(&other.$kind);
                    }
                )+
            }
        }

        impl Memory<f64> {
            /// Reads or writes everything in a result file; see [`Reported::keep`].
            pub(crate) fn keep(&mut self, like: Option<&Self>, file: &mut dyn Archive) {
                $($Kind::keep(&mut self.$kind, like.map(|all| &all.$kind[..]), file);)+
            }

            /// Whether it is of as many elements as `forces` has.
            ///
            /// # Errors
            /// The first kind that it has another number of.
            pub(crate) fn check_count(&self, forces: &Forces<f64>) -> Result<(), Misfit> {
                $(
                    let [_, of] = $Kind::NAMES;
                    let (found, expected) = (self.$kind.len(), $Kind::count(&forces.$kind));
                    if found != expected {
                        return Err(Misfit::Count { of, found, expected });
                    }
                )+
                Ok(())
            }

            /// Whether the elements of `forces`, of which there are as many, can remember this.
            ///
            /// # Errors
            /// The first that cannot.
            pub(crate) fn check(&self, forces: &Forces<f64>) -> Result<(), Misfit> {
                $(
                    let [of, _] = $Kind::NAMES;
                    let mut list = self.$kind.iter().enumerate();
                    if let Some((number, _)) = list.find(|(i, past)| !$Kind::is_possible(&forces.$kind, *i, past)) {
                        return Err(Misfit::Impossible { of, number });
                    }
                )+
                let mut is_finite = true;
                self.map(&mut |x: f64| is_finite &= x.is_finite());
                if is_finite { Ok(()) } else { Err(Misfit::NotFinite) }
            }

            /// Elements with these data that could not be computed; see [`Element::failure`].
            pub(crate) fn failure(&self, data: &Data<'_>, law: &Forces<f64>) -> Option<String> {
                None$(.or_else(|| $Kind::failure(data.$kind, &law.$kind, &self.$kind)))+
            }

            /// Restores everything to its permitted range after small changes of the numbers.
            pub fn confine(&mut self) {
                $(self.$kind.iter_mut().for_each($Kind::confine);)+
            }
        }

        impl<S: Scalar> AllHints<S> {
            fn new(forces: &Forces<S>) -> Self {
                AllHints { $($kind: $Kind::hints(&forces.$kind)),+ }
            }

            fn take_over(&mut self, other: &Self) {
                $(Hints::<S>::take_over(&mut self.$kind, &other.$kind);)+
            }

            fn look_again(&mut self, lanes: S::Mask) {
                $(Hints::<S>::look_again(&mut self.$kind, lanes);)+
            }

            #[cfg(any(target_arch = "x86_64", test))]
            #[inline(always)]
            fn blend(&mut self, other: &Self, lanes: S::Mask) {
                $(Hints::<S>::blend(&mut self.$kind, &other.$kind, lanes);)+
            }

            #[inline(always)]
            fn take_over_for(&mut self, other: &Self, share: S) {
                $(Hints::<S>::take_over_for(&mut self.$kind, &other.$kind, share);)+
            }

            #[inline(always)]
            fn pace(&self) -> Pace<S> {
                Pace::any()$(.and($Kind::pace(&self.$kind)))+
            }
        }
    };
}

kinds! {
    plates: Plates,
    contacts: Contacts,
    belts: Belts,
    chains: Chains,
    bags: Bags,
    own: OwnForces,
    columns: Columns,
    hinges: Hinges,
    joints: JointMoments,
    limits: JointLimits,
    muscles: Muscles,
}

/// A kind of the list, with access to its part of the data of all kinds.
pub trait Listed: Reported {
    /// Its setup data.
    fn data<'a>(all: &Data<'a>) -> Self::Data<'a>;
    /// Its law.
    fn law<S>(all: &Forces<S>) -> &Self::Law<S>;
    /// Its memory.
    fn past<S>(all: &Memory<S>) -> &[Self::Past<S>];
    /// Its actions.
    fn actions<S>(all: &Actions<S>) -> &[Self::Action<S>];
}

/// An operation on every kind of the list.
pub trait Visitor {
    /// The operation on one kind.
    fn visit<E: Listed>(&mut self);
}

/// Ignores everything.
impl<S> Observer<S> for () {}

/// When the first of several switches was due.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Due<S> {
    /// Fraction of the interval between two memories; the middle for one that is unknown.
    pub share: S,
    /// Whether all are known.
    pub is_known: bool,
}

impl<S: Scalar> Due<S> {
    fn see(&mut self, share: Option<S>) {
        self.is_known &= share.is_some();
        self.share = self.share.min(share.unwrap_or(S::of(0.5)));
    }
}

/// Memory of the force elements between steps, changed only at accepted steps, and hints that save work.
#[derive(Clone, Debug)]
pub struct History<S: Scalar> {
    /// Everything that a run carries on.
    pub memory: Memory<S>,
    hints: AllHints<S>,
}

impl<S: Scalar> History<S> {
    /// Initial history of the elements of `forces`; nothing is skipped until the first commit.
    pub fn new(forces: &Forces<S>, memory: Memory<S>) -> Self {
        History { memory, hints: AllHints::new(forces) }
    }

    /// Copies `other`, a history of the same elements.
    pub fn take_over(&mut self, other: &History<S>) {
        self.memory.take_over(&other.memory);
        self.hints.take_over(&other.hints);
    }

    /// Copies `other` for a step of the length `h`, s, where the memories are equal in the elements that have no mark.
    #[inline(always)]
    pub(crate) fn take_over_for(&mut self, other: &History<S>, marks: &Marks, forces: &Forces<S>, h: S) {
        self.memory.take_over_marked(&other.memory, marks);
        self.hints.take_over_for(&other.hints, h / forces.contacts.longest_step());
    }

    /// Elements whose memory the latest commit may have changed, of the kind that marks them.
    pub(crate) fn changed(&self) -> &Marks {
        &self.hints.contacts.changed
    }

    /// Length of the step that begins at the latest commit, given the planned length `h`, s.
    #[inline(always)]
    pub(crate) fn step(&self, h: S) -> S {
        self.hints.pace().step(h)
    }

    /// Makes the next commit visit all elements, as required if the memory belongs to another position.
    pub(crate) fn look_again(&mut self) {
        self.look_again_in(S::truth(true));
    }

    /// The same in these lanes only.
    pub(crate) fn look_again_in(&mut self, lanes: S::Mask) {
        self.hints.look_again(lanes);
    }

    /// Copies the hints of `other`, a history of the same elements, in these lanes.
    #[cfg(any(target_arch = "x86_64", test))]
    #[inline(always)]
    pub(crate) fn blend_hints(&mut self, other: &History<S>, lanes: S::Mask) {
        self.hints.blend(&other.hints, lanes);
    }

    /// Largest length of the step that begins at the latest commit.
    #[cfg(any(target_arch = "x86_64", test))]
    pub(crate) fn pace(&self) -> Pace<S> {
        self.hints.pace()
    }

    /// Skips nothing, and limits the step to `pace`, which was found where the numbers were stored.
    #[cfg(any(target_arch = "x86_64", test))]
    pub(crate) fn begin_anew(&mut self, forces: &Forces<S>, pace: Pace<S>) {
        self.hints = AllHints::new(forces);
        // no other kind bounds it
        self.hints.contacts.pace = pace;
    }
}

#[cfg(any(target_arch = "x86_64", test))]
impl History<f64> {
    /// Stores `memory`, of another position; pairs that have no mark are equal. The next commit must be told what to visit.
    pub(crate) fn remember(&mut self, memory: &Memory<f64>, marks: &Marks) {
        self.memory.take_over_marked(memory, marks);
    }

    /// Makes the next commit visit what one of `lanes` would visit, whose memory in lane `i` this is.
    pub(crate) fn watch_as<L: Lanes>(&mut self, lanes: &History<L>, i: usize) {
        self.hints.contacts.watch_as(&lanes.hints.contacts, i);
    }
}

/// A function that writes the entries of all kinds to their places, of which each must be used once.
macro_rules! in_order {
    ($name:ident, $Type:ty, $count:expr) => {
        const fn $name(kinds: [&[$Type]; KINDS]) -> [$Type; $count] {
            let (mut list, mut is_taken, mut count, mut i) = ([kinds[0][0]; $count], [false; $count], 0, 0);
            while i < KINDS {
                let mut j = 0;
                while j < kinds[i].len() {
                    let at = kinds[i][j].at;
                    assert!(!is_taken[at], "two of one place");
                    (is_taken[at], list[at]) = (true, kinds[i][j]);
                    (count, j) = (count + 1, j + 1);
                }
                i += 1;
            }
            assert!(count == $count, "a place that no element takes");
            list
        }
    };
}

in_order!(stored_in_order, StoredEnergy, STORES);
in_order!(sums_in_order, WorkSum, WORK_SUMS);
