//! The runs side by side: each has its place, with a lane of numbers of its own.
//!
//! All take their next step together, each with its own times. A run that reaches an output is looked at alone, with the
//! scalar kernel, as [`crate::run::simulate::simulate`] does; one that ends leaves its place to the next job.

use std::ops::ControlFlow;

use super::machine::{Bench, Machine};
use super::place::{Next, Place, Rider, Witness};
use super::{Ended, Job, Kernel, run_alone};
use crate::forces::History;
use crate::model::Model;
use crate::model::setup::Integrator;
use crate::motion::frame::VEHICLE;
use crate::motion::state::State;
use crate::results::outcome::Status;
use crate::results::recorder::Recorder;
use crate::run::Run;

/// Runs side by side in lanes of `L`.
pub(super) struct Group<L: Machine, T, R> {
    kernel: Kernel,
    /// None before the first run.
    bench: Option<Bench<L>>,
    state: State<L>,
    /// Boxed, as they change hands at every step.
    places: Vec<Option<Box<Place>>>,
    /// Beside the places, so that the step knows nothing of tags and recorders and is compiled once.
    riders: Vec<Option<Rider<T, R>>>,
}

impl<L: Machine, T, R: Recorder> Group<L, T, R> {
    /// No runs yet.
    pub(super) fn new(kernel: Kernel) -> Self {
        Group { kernel, bench: None, state: State::zero(), places: none::<L, _>(), riders: none::<L, _>() }
    }

    /// Runs all `jobs`; `on_end` gets each when it has ended.
    pub(super) fn run_all(
        &mut self,
        mut jobs: impl Iterator<Item = Job<T, R>>,
        on_end: &mut impl FnMut(Ended<T, R>) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let mut more = true;
        loop {
            for i in 0..L::COUNT {
                while more && self.places[i].is_none() {
                    match jobs.next() {
                        Some(job) => self.seat(i, job, on_end)?,
                        None => more = false,
                    }
                }
            }
            match self.places.iter().flatten().count() {
                0 => return ControlFlow::Continue(()),
                // a step of all lanes takes longer than one of a run alone
                1 => self.finish_the_last(on_end)?,
                _ => self.step(on_end)?,
            }
        }
    }

    /// Gives the run of `job` place `i`, or runs it alone if it has no place among these.
    fn seat(
        &mut self,
        i: usize,
        job: Job<T, R>,
        on_end: &mut impl FnMut(Ended<T, R>) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let Integrator::Rk4 { step_s } = job.model.setup().integrator else {
            return on_end(run_alone(job));
        };
        if !self.make_room(i, &job.model) {
            return on_end(run_alone(job));
        }
        let mut place = Box::new(Place::new(job.model, step_s));
        let mut rider = Rider { tag: job.tag, recorder: job.recorder };
        let next = place.begin(&mut rider.recorder);
        self.go_on_or_end(i, place, rider, next, on_end)
    }

    /// Puts the constants of `model` into lane `i`; false if its structure is another than that of the runs here.
    fn make_room(&mut self, i: usize, model: &Model) -> bool {
        let alone = self.places.iter().all(Option::is_none);
        let put = |lanes: L, x: f64| lanes.with_lane(i, x);
        let joined = self.bench.as_ref().map(|b| b.system.zip(model.system(), put));
        match (&mut self.bench, joined) {
            (Some(bench), Some(Ok(joined))) => {
                bench.system = joined;
                bench.history.look_again();
            }
            (bench, _) if alone => {
                *bench = new_bench(model);
                let start = &model.start().state;
                self.state = start.zip(start, |x, _| L::of(x));
            }
            _ => return false,
        }
        self.bench.is_some()
    }

    /// One step of every run, and the outputs that are reached.
    fn step(&mut self, on_end: &mut impl FnMut(Ended<T, R>) -> ControlFlow<()>) -> ControlFlow<()> {
        let Some(bench) = &mut self.bench else {
            return ControlFlow::Continue(());
        };
        let mut h = L::zero();
        for (i, place) in self.places.iter_mut().enumerate() {
            // an idle lane stands still: h = 0
            let Some(place) = place else { continue };
            let Some(step) = place.stretch.next() else {
                continue;
            };
            place.step = step;
            h.set_lane(i, step.length_s());
            let frames = step.frames(&place.model, &mut place.run.cursor);
            for (lanes, frames) in bench.frames.iter_mut().zip(&frames) {
                // space stands still
                lanes[VEHICLE].each(&frames[VEHICLE], &mut |lanes: &mut L, x| lanes.set_lane(i, x));
            }
        }
        let mut witness = Witness(&mut self.places);
        let finite;
        (self.state, finite) = L::step(bench, &self.state, h, &mut witness);
        for i in 0..L::COUNT {
            if let (Some(place), Some(rider)) = (self.places[i].take(), self.riders[i].take()) {
                self.settle(i, place, rider, finite.lane(i) > 0.0, on_end)?;
            }
        }
        ControlFlow::Continue(())
    }

    /// Accepts the step of the run of place `i`, if it led to numbers, and records an output that it reached.
    fn settle(
        &mut self,
        i: usize,
        mut place: Box<Place>,
        mut rider: Rider<T, R>,
        finite: bool,
        on_end: &mut impl FnMut(Ended<T, R>) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        place.run.effort.evaluations += 4;
        if finite && !place.stretch.is_over() {
            place.run.accept_time(place.step);
            self.put(i, place, rider);
            return ControlFlow::Continue(());
        }
        let state = self.lane_state(i);
        let next = match place.run.accept(state, place.step) {
            Err(error) => Next::ended(Status::Failed(error)),
            Ok(()) => {
                self.fetch_history(i, &mut place.run);
                place.output(&mut rider.recorder)
            }
        };
        self.go_on_or_end(i, place, rider, next, on_end)
    }

    fn put(&mut self, i: usize, place: Box<Place>, rider: Rider<T, R>) {
        self.places[i] = Some(place);
        self.riders[i] = Some(rider);
    }

    /// Puts a run back into its place, or hands it out.
    fn go_on_or_end(
        &mut self,
        i: usize,
        mut place: Box<Place>,
        rider: Rider<T, R>,
        next: Next,
        on_end: &mut impl FnMut(Ended<T, R>) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        // the output touched the history; and a lane that failed gets numbers again
        if let Some(bench) = &mut self.bench {
            let put = &mut |lanes: &mut L, x: &mut f64| lanes.set_lane(i, *x);
            bench.history.memory.each(&mut place.run.history.memory, put);
        }
        let state = &place.run.state;
        self.state = self.state.zip(state, |lanes, x| lanes.with_lane(i, x));
        match next {
            Next::GoesOn => {
                self.put(i, place, rider);
                ControlFlow::Continue(())
            }
            Next::Ends(status) => on_end(place.end(rider, self.kernel, status)),
        }
    }

    /// The state of the run in place `i`.
    fn lane_state(&self, i: usize) -> State<f64> {
        self.state.zip(&self.state, |lanes, _| lanes.lane(i))
    }

    /// Brings the history of the run in place `i` up to date.
    fn fetch_history(&mut self, i: usize, run: &mut Run) {
        if let Some(bench) = &mut self.bench {
            let fetch = &mut |lanes: &mut L, x: &mut f64| *x = lanes.lane(i);
            bench.history.memory.each(&mut run.history.memory, fetch);
        }
        run.history.look_again();
    }

    /// Finishes the only run left with the scalar kernel.
    fn finish_the_last(&mut self, on_end: &mut impl FnMut(Ended<T, R>) -> ControlFlow<()>) -> ControlFlow<()> {
        for i in 0..L::COUNT {
            let (Some(mut place), Some(mut rider)) = (self.places[i].take(), self.riders[i].take()) else {
                continue;
            };
            place.run.state = self.lane_state(i);
            self.fetch_history(i, &mut place.run);
            let status = place.finish(&mut rider.recorder);
            on_end(place.end(rider, self.kernel, status))?;
        }
        ControlFlow::Continue(())
    }
}

/// As many empty places as there are lanes.
fn none<L: Machine, P>() -> Vec<Option<P>> {
    (0..L::COUNT).map(|_| None).collect()
}

/// A bench on which every lane is that of `model`.
fn new_bench<L: Machine>(model: &Model) -> Option<Bench<L>> {
    let system = model.system();
    let system = system.zip(system, |x, _| L::of(x)).ok()?;
    let history = History::new(&system.forces, model.start().history.memory.map(&mut L::of));
    let mut cursor = Default::default();
    let start_s = model.setup().time.start_s;
    let frames = model.frames(start_s, start_s, &mut cursor);
    let frames = frames.map(|frame| frame.zip(&frame, &|x, _| L::of(x)));
    Some(Bench { system, history, frames: [frames; 3] })
}
