//! The runs in lanes: each has its place, with its own lane of numbers.
//!
//! All take their next step together, each with its own times. A run that reaches an output is evaluated alone, with
//! the scalar kernel, as in [`crate::run::simulate::simulate`]; one that ends leaves its place to the next job.

use std::ops::ControlFlow;

use super::bench::{Bench, Rear, Start, move_frames, new_bench};
use super::machine::Machine;
use super::place::{Next, Place, Sees, Witness};
use super::{Jobs, Kernel, MOST_PLACES, run_alone};
use crate::model::Model;
use crate::motion::state::State;
use crate::results::outcome::{RecordingFailed, Status};
use crate::run::adaptive::Control;
use crate::run::ahead::Ahead;
use crate::run::{Course, Step, broken};

/// Runs side by side in lanes of `L`.
pub(super) struct Group<L: Machine> {
    kernel: Kernel,
    /// None before the first run.
    pub(super) bench: Option<Box<Bench<L>>>,
    /// Boxed, as they change hands at every step.
    pub(super) places: Vec<Option<Box<Place>>>,
    /// Runs that did not fit the others since the last that did.
    unlike: usize,
}

impl<L: Machine> Group<L> {
    /// No runs yet.
    pub(super) fn new(kernel: Kernel) -> Self {
        Group { kernel, bench: None, places: (0..L::COUNT).map(|_| None).collect(), unlike: 0 }
    }

    /// Runs all `jobs`.
    pub(super) fn run_all(&mut self, jobs: &mut dyn Jobs) -> ControlFlow<()> {
        let mut more = true;
        loop {
            for i in 0..L::COUNT {
                while more && self.places[i].is_none() {
                    match jobs.next(i) {
                        Some(model) => self.seat(i, model, jobs)?,
                        None => more = false,
                    }
                }
            }
            match self.places.iter().flatten().count() {
                0 => return ControlFlow::Continue(()),
                // a step of all lanes takes longer than one of a run alone
                1 => self.finish_alone(jobs)?,
                _ if self.is_controlled() => self.try_steps(jobs)?,
                _ => self.step(jobs)?,
            }
        }
    }

    /// Adds the run of `model` at index `i`, or runs it alone if it does not fit the others.
    fn seat(&mut self, i: usize, model: Model, jobs: &mut dyn Jobs) -> ControlFlow<()> {
        let is_controlled = Control::of(&model.setup().integrator).is_some();
        let is_alike = self.places.iter().flatten().all(|place| place.control.is_some() == is_controlled);
        if model.setup().path.is_live() || !is_alike || !self.take_in(i, &model, jobs)? {
            return run_alone(i, model, jobs);
        }
        let mut place = Box::new(Place::new(model));
        let next = place.begin(jobs.recorder(i));
        if is_controlled {
            return self.begin_steps(i, place, next, jobs);
        }
        place.differs_anywhere();
        self.go_on_or_end(i, place, next, jobs)
    }

    /// Makes room for `model` in lane `i`; false if it does not fit the others. Of two structures, that of which more runs
    /// come keeps the lanes: an odd run does not make all after it run alone.
    fn take_in(&mut self, i: usize, model: &Model, jobs: &mut dyn Jobs) -> ControlFlow<(), bool> {
        if !self.make_room(i, model) {
            self.unlike += 1;
            if self.unlike < self.places.iter().flatten().count() {
                return ControlFlow::Continue(false);
            }
            self.finish_alone(jobs)?;
            if !self.make_room(i, model) {
                return ControlFlow::Continue(false);
            }
        }
        self.unlike = 0;
        ControlFlow::Continue(true)
    }

    /// Whether the runs here are under error control.
    fn is_controlled(&self) -> bool {
        self.places.iter().flatten().all(|place| place.control.is_some())
    }

    /// Copies the constants of `model` to lane `i`; false if its structure differs from that of the other runs.
    fn make_room(&mut self, i: usize, model: &Model) -> bool {
        let alone = self.places.iter().all(Option::is_none);
        let put = |lanes: L, x: f64| lanes.with_lane(i, x);
        let joined = self.bench.as_ref().map(|b| b.around.system.zip(model.system(), put));
        match (&mut self.bench, joined) {
            (Some(bench), Some(Ok(joined))) => {
                bench.around.system = joined;
                bench.history.look_again();
            }
            (bench, _) if alone => {
                *bench = new_bench(model);
            }
            _ => return false,
        }
        match &mut self.bench {
            Some(bench) if Control::of(&model.setup().integrator).is_some() => {
                bench.ahead.get_or_insert_with(|| Box::new(Ahead::new(&bench.state, &bench.history)));
            }
            Some(bench) if bench.rear.is_none() && model.system().forces.can_switch() => {
                let start = Box::new(Start { state: bench.state, memory: bench.history.memory.clone() });
                bench.rear = Some(Rear { latest: start.clone(), ahead: start });
            }
            _ => {}
        }
        self.bench.is_some()
    }

    /// One step of every run, and the outputs reached.
    fn step(&mut self, jobs: &mut dyn Jobs) -> ControlFlow<()> {
        let Some(bench) = &mut self.bench else {
            return ControlFlow::Continue(());
        };
        let mut h = L::zero();
        for (i, place) in self.places.iter_mut().enumerate() {
            // an idle lane is at rest: h = 0
            let Some(place) = place else { continue };
            let Some(step) = place.next_step() else {
                continue;
            };
            place.step = step;
            h.set_lane(i, step.length_s());
            let [start_s, middle_s, _] = step.times_s();
            move_frames(i, place, &mut bench.around.frames[0], [start_s, middle_s]);
        }
        bench.keep_start();
        let bears = L::begin(bench, h, &mut Witness::of(&mut self.places, Sees::Start));
        let switched = bench.has_switched();
        for (i, place) in self.places.iter_mut().enumerate() {
            let Some(place) = place.as_mut().filter(|_| h.lane(i) > 0.0) else { continue };
            place.behind.add(bench.history.changed());
            place.step = place.step.first_part(|_| bears.lane(i));
            h.set_lane(i, place.step.length_s());
            let [_, middle_s, end_s] = place.step.times_s();
            let [_, middle, end] = &mut bench.around.frames;
            move_frames(i, place, middle, [middle_s, middle_s]);
            move_frames(i, place, end, [end_s, middle_s]);
        }
        let finite = L::go(bench, h, &mut Witness::of(&mut self.places, Sees::Start));
        let gone_back = self.go_back(switched, jobs)?;
        if let Some(bench) = &mut self.bench {
            bench.shift();
        }
        for i in (0..L::COUNT).filter(|i| !gone_back[*i]) {
            if let Some(mut place) = self.places[i].take() {
                if switched.lane(i) > 0.0 {
                    self.note_switches(i, &mut place);
                }
                self.settle(i, place, finite.lane(i) > 0.0, jobs)?;
            }
        }
        ControlFlow::Continue(())
    }

    /// Notes the switches at the start of the present step of run `i`.
    fn note_switches(&mut self, i: usize, place: &mut Place) {
        let Some((bench, rear)) = self.bench.as_mut().zip(place.run.rear.as_deref_mut()) else { return };
        let Some(lanes) = &mut bench.rear else { return };
        rear.fetch([&mut lanes.latest.memory, &mut bench.history.memory], |lanes| lanes.lane(i));
        let [before, now] = rear.fetched();
        place.run.switches.note(&place.model.system().forces, place.step.start_s, before, now);
    }

    /// Reverts the present step and the one before it in each run in which an element switched within the latter, and
    /// repeats that step alone; returns these runs.
    fn go_back(&mut self, switched: L, jobs: &mut dyn Jobs) -> ControlFlow<(), [bool; MOST_PLACES]> {
        let mut gone_back = [false; MOST_PLACES];
        for i in (0..L::COUNT).filter(|i| switched.lane(*i) > 0.0) {
            let Some(mut place) = self.places[i].take() else { continue };
            let Some(latest) = place.latest.take().filter(|_| place.run.rear.is_some()) else {
                self.places[i] = Some(place);
                continue;
            };
            gone_back[i] = true;
            self.fetch_start(i, &mut place.run);
            let next = place.go_back(latest);
            place.differs_anywhere();
            self.go_on_or_end(i, place, next, jobs)?;
        }
        ControlFlow::Continue(gone_back)
    }

    /// Moves run `i` back to the start of its latest step.
    fn fetch_start(&mut self, i: usize, run: &mut Course) {
        if let Some(rear) = self.bench.as_mut().and_then(|bench| bench.rear.as_mut()) {
            let Start { state, memory } = &mut *rear.latest;
            each(&mut run.state, state, |x, lanes| *x = lanes.lane(i));
            memory.each(&mut run.history.memory, &mut |lanes: &mut L, x: &mut f64| *x = lanes.lane(i));
            run.history.look_again();
        }
    }

    /// Gives run `i` the start of its latest accepted step.
    fn fetch_rear(&mut self, i: usize, run: &mut Course, step: Step) {
        let lanes = self.bench.as_mut().and_then(|bench| bench.rear.as_mut());
        if let (Some(lanes), Some(rear)) = (lanes, &mut run.rear) {
            let Start { state, memory } = &mut *lanes.latest;
            rear.step = Some(step);
            each(&mut rear.state, state, |x, lanes| *x = lanes.lane(i));
            memory.each(&mut rear.history.memory, &mut |lanes: &mut L, x: &mut f64| *x = lanes.lane(i));
            rear.history.look_again();
        }
    }

    /// Accepts the step of run `i` if it is finite, and records an output reached.
    fn settle(&mut self, i: usize, mut place: Box<Place>, finite: bool, jobs: &mut dyn Jobs) -> ControlFlow<()> {
        if let Some(bench) = &self.bench {
            let past = &bench.history.memory.contacts;
            place.take_step(|pair| past[pair].phase.lane(i));
        }
        if finite && place.run.is_within_allowance() {
            place.run.accept_time(place.step);
            if !place.is_at_output() {
                place.latest = Some(place.step);
                self.places[i] = Some(place);
                return ControlFlow::Continue(());
            }
            if let Some(bench) = &self.bench {
                each(&mut place.run.state, &bench.state, |x, lanes| *x = lanes.lane(i));
            }
            let next = self.reach_output(i, &mut place, jobs);
            return self.go_on_or_end(i, place, next, jobs);
        }
        let state = self.lane_state(i, &place.run);
        let next = match place.run.accept(&place.model, state, place.step) {
            Err(error) if finite => {
                self.fetch_history(i, &mut place);
                Next::ended(Status::Failed(error))
            }
            Err(_) => {
                let kept = place.run.history.memory.clone();
                self.fetch_history(i, &mut place);
                let failed = std::mem::replace(&mut place.run.history.memory, kept);
                place.differs_anywhere();
                Next::ended(Status::Failed(broken(&place.model, &failed, place.step, &state)))
            }
            Ok(()) => self.reach_output(i, &mut place, jobs),
        };
        self.go_on_or_end(i, place, next, jobs)
    }

    /// Records the output that run `i` has reached with the present step, whose state it has.
    fn reach_output(&mut self, i: usize, place: &mut Place, jobs: &mut dyn Jobs) -> Next {
        self.fetch_history(i, place);
        self.fetch_rear(i, &mut place.run, place.step);
        let next = place.output(jobs.recorder(i));
        // one commit, but where steps can be repeated
        match place.run.rear {
            None => place.behind.add(place.run.history.changed()),
            Some(_) => place.differs_anywhere(),
        }
        next
    }

    /// Puts a run back at its index, or ends it.
    fn go_on_or_end(&mut self, i: usize, mut place: Box<Place>, next: Next, jobs: &mut dyn Jobs) -> ControlFlow<()> {
        // the output touched the history; and a lane that failed gets numbers again
        if let Some(bench) = &mut self.bench {
            let put = &mut |lanes: &mut L, x: &mut f64| lanes.set_lane(i, *x);
            bench.history.memory.each_marked(&mut place.run.history.memory, &place.behind, put);
            place.behind.clear();
            each(&mut bench.state, &place.run.state, |lanes, x| lanes.set_lane(i, x));
        }
        match next {
            Next::GoesOn => {
                self.places[i] = Some(place);
                ControlFlow::Continue(())
            }
            Next::Ends(status) => self.hand_out(i, *place, status, jobs),
        }
    }

    pub(super) fn hand_out(
        &self,
        i: usize,
        place: Place,
        status: Result<Status, RecordingFailed>,
        jobs: &mut dyn Jobs,
    ) -> ControlFlow<()> {
        let (model, outcome) = place.end(status, jobs.recorder(i));
        jobs.end(i, model, outcome, self.kernel)
    }

    /// State of `run` at index `i`.
    fn lane_state(&self, i: usize, run: &Course) -> State<f64> {
        let mut state = run.state;
        if let Some(bench) = &self.bench {
            each(&mut state, &bench.state, |x, lanes| *x = lanes.lane(i));
        }
        state
    }

    /// Updates the history of run `i`.
    fn fetch_history(&mut self, i: usize, place: &mut Place) {
        let (Some(bench), Place { run, behind, .. }) = (&mut self.bench, place) else { return };
        run.history.watch_as(&bench.history, i);
        bench
            .history
            .memory
            .each_marked(&mut run.history.memory, behind, &mut |lanes: &mut L, x: &mut f64| *x = lanes.lane(i));
        behind.clear();
    }

    /// Finishes all runs with the scalar kernel.
    fn finish_alone(&mut self, jobs: &mut dyn Jobs) -> ControlFlow<()> {
        for i in 0..L::COUNT {
            let Some(mut place) = self.places[i].take() else { continue };
            if place.control.is_some() {
                self.fetch_ahead(i, &mut place);
            } else {
                place.run.state = self.lane_state(i, &place.run);
                self.fetch_history(i, &mut place);
            }
            if let Some(latest) = place.latest {
                self.fetch_rear(i, &mut place.run, latest);
            }
            let status = place.finish(jobs.recorder(i));
            self.hand_out(i, *place, status, jobs)?;
        }
        ControlFlow::Continue(())
    }
}

/// Calls f with corresponding numbers in use of this and `other`, of the same shape.
#[inline(always)]
fn each<A: Copy, B: Copy>(own: &mut State<A>, other: &State<B>, f: impl Fn(&mut A, B)) {
    own.numbers_mut().iter_mut().zip(other.numbers()).for_each(|(own, other)| f(own, *other));
}
