//! The latest step under error control, and the outcome of a trial of the next one: for one run, or for several in
//! lanes.

use crate::forces::marks::Marks;
use crate::forces::{Forces, History};
use crate::motion::integrate::bogacki_shampine::Room;
#[cfg(any(target_arch = "x86_64", test))]
use crate::motion::lanes::Lanes;
use crate::motion::scalar::Scalar;
use crate::motion::state::State;

/// The latest step, at whose end the integration is, and a trial of the next.
#[derive(Clone, Debug)]
pub(crate) struct Ahead<S: Scalar> {
    /// States at the start and the end of the latest step.
    // boxed, as they change hands at every step
    pub from: Box<State<S>>,
    pub to: Box<State<S>>,
    /// Rates there.
    pub rates: [Box<State<S>>; 2],
    /// Histories there.
    pub before: History<S>,
    pub after: History<S>,
    /// History of a trial.
    pub trial: History<S>,
    /// Where the memory of the trial, and that at the start of the latest step, may differ from that at its end.
    stale: Marks,
    moved: Marks,
    /// Results of a trial.
    pub room: Room<S>,
}

impl<S: Scalar> Ahead<S> {
    /// At `state`, before any step.
    pub(crate) fn new(state: &State<S>, history: &History<S>) -> Self {
        let (at, zero) = (|| Box::new(*state), || Box::new(State::zero(state.shape())));
        Ahead {
            from: at(),
            to: at(),
            rates: [zero(), zero()],
            before: history.clone(),
            after: history.clone(),
            trial: history.clone(),
            stale: history.changed().blank(),
            moved: history.changed().blank(),
            room: Room::new(state.shape()),
        }
    }

    /// Begins a trial of the length `h` (s) with the history at the end of the latest step.
    #[inline(always)]
    pub(crate) fn begin_trial(&mut self, forces: &Forces<S>, h: S) {
        self.trial.take_over_for(&self.after, &self.stale, forces, h);
    }

    /// Ends a trial, which has one commit.
    #[inline(always)]
    pub(crate) fn end_trial(&mut self) {
        self.stale.take_over(self.trial.changed());
    }

    /// Notes a commit of the history at the end of the latest step.
    pub(crate) fn note_commit(&mut self) {
        self.stale.add(self.after.changed());
        self.moved.add(self.after.changed());
    }

    /// The trial becomes the latest step.
    pub(crate) fn shift(&mut self) {
        use std::mem::swap;
        self.moved.add(&self.stale);
        swap(&mut self.moved, &mut self.stale);
        swap(&mut self.from, &mut self.to);
        swap(&mut self.to, &mut self.room.end);
        self.rates.swap(0, 1);
        swap(&mut self.rates[1], &mut self.room.rate);
        swap(&mut self.before, &mut self.after);
        swap(&mut self.after, &mut self.trial);
    }
}

#[cfg(any(target_arch = "x86_64", test))]
impl<S: Scalar> Ahead<S> {
    /// After the memories were written from outside: they may differ anywhere.
    pub(crate) fn forget_marks(&mut self) {
        let count = self.after.memory.contacts.len();
        self.stale.set_all(count);
        self.moved.set_all(count);
    }
}

#[cfg(any(target_arch = "x86_64", test))]
impl<L: Lanes> Ahead<L> {
    /// Sets lane `i` to the state of a single run.
    pub(crate) fn begin(&mut self, i: usize, alone: &Ahead<f64>) {
        for state in [&mut self.from, &mut self.to] {
            state.set_lane(i, &alone.to);
        }
        self.rest(i);
        self.forget_marks();
        for history in [&mut self.before, &mut self.after] {
            let from = &mut alone.after.memory.clone();
            history.memory.each(from, &mut |lanes: &mut L, x: &mut f64| lanes.set_lane(i, *x));
        }
        self.after.look_again_in(L::zero().with_lane(i, 1.0).gt(L::zero()));
    }

    /// Where the memory at the start of the latest step may differ from that at its end.
    pub(crate) fn moved(&self) -> &Marks {
        &self.moved
    }

    /// Where the memory of the latest commit of a trial or a look may differ from that at the end of the latest step.
    pub(crate) fn stale(&self) -> &Marks {
        &self.stale
    }

    /// Stops all motion in lane `i`.
    pub(crate) fn rest(&mut self, i: usize) {
        for rate in &mut self.rates {
            rate.numbers_mut().iter_mut().for_each(|lanes| lanes.set_lane(i, 0.0));
        }
    }

    /// Copies the results of a look to lane `i`, except the hints.
    pub(crate) fn take_look(&mut self, i: usize) {
        self.rates[1].copy_lane(i, &self.room.rate);
        let copy = &mut |lanes: &mut L, from: &mut L| lanes.set_lane(i, from.lane(i));
        self.after.memory.each_marked(&mut self.trial.memory, &self.stale, copy);
        self.moved.add(&self.stale);
    }

    /// Restores lane `i` to the time before a shift, except the hints.
    pub(crate) fn shift_back(&mut self, i: usize) {
        self.to.copy_lane(i, &self.from);
        self.from.copy_lane(i, &self.room.end);
        let [start, end] = &mut self.rates;
        end.copy_lane(i, start);
        start.copy_lane(i, &self.room.rate);
        let copy = &mut |lanes: &mut L, from: &mut L| lanes.set_lane(i, from.lane(i));
        self.after.memory.each_marked(&mut self.before.memory, &self.stale, copy);
        self.before.memory.each_marked(&mut self.trial.memory, &self.stale, copy);
        self.moved.take_over(&self.stale);
    }
}
