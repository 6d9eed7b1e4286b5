//! The runs in lanes under error control. Each tries steps of its own, with the same acceptance as a single run; only
//! the evaluations of the trials are shared.

use std::ops::ControlFlow;

use super::bench::{Bench, move_frames};
use super::group::Group;
use super::machine::Machine;
use super::place::{Next, Place, Sees, Witness};
use super::{Jobs, MOST_PLACES};
use crate::motion::integrate::bogacki_shampine::{Errors, Stage};
use crate::motion::lanes::Lanes;
use crate::results::outcome::{Status, StepError};
use crate::run::Step;
use crate::run::ahead::Ahead;

/// Stages of a trial at which rates are evaluated, in the order of the frames on a bench.
const STAGES: [Stage; 3] = [Stage::Within(0.5), Stage::Within(0.75), Stage::End];

impl<L: Machine> Group<L> {
    /// Starts the steps of the run of `place`, after its first output, in lane `i`, or ends it.
    pub(super) fn begin_steps(
        &mut self,
        i: usize,
        mut place: Box<Place>,
        next: Next,
        jobs: &mut dyn Jobs,
    ) -> ControlFlow<()> {
        place.unread.set_all(place.run.history.memory.contacts.len());
        if let Next::Ends(status) = next {
            return self.hand_out(i, *place, status, jobs);
        }
        let (bench, front) = (self.bench.as_deref_mut(), place.run.front.as_deref());
        if let (Some(Bench { ahead: Some(ahead), tolerance, .. }), Some(front), Some(control)) =
            (bench, front, place.control)
        {
            tolerance.relative.set_lane(i, control.tolerance.relative);
            tolerance.absolute_m.set_lane(i, control.tolerance.absolute_m);
            tolerance.absolute_m_s.set_lane(i, control.tolerance.absolute_m_s);
            ahead.begin(i, &front.ahead);
        }
        self.places[i] = Some(place);
        ControlFlow::Continue(())
    }

    /// A trial of every run, and the outputs reached.
    pub(super) fn try_steps(&mut self, jobs: &mut dyn Jobs) -> ControlFlow<()> {
        let h = self.propose(jobs)?;
        let Group { bench: Some(bench), places, .. } = self else { return ControlFlow::Continue(()) };
        let (errors, switched) = L::attempt(bench, h, &mut Witness::of(places, Sees::Trial));
        let mut verdicts = [const { None }; MOST_PLACES];
        for (i, place) in places.iter_mut().enumerate() {
            let (Some(place), Some(ahead)) = (place, &mut bench.ahead) else { continue };
            let errors = Errors { whole: errors.whole.lane(i), within: errors.within.lane(i) };
            place.jumps = switched.lane(i) > 0.0;
            place.unread.add(ahead.stale());
            verdicts[i] = Some(place.judge(i, ahead, errors));
        }
        shift(bench, &verdicts, places);
        for (i, verdict) in verdicts.into_iter().enumerate() {
            match verdict {
                Some(Ok(true)) => self.reach_outputs(i, jobs)?,
                Some(Err(error)) => self.fail(i, error, jobs)?,
                _ => {}
            }
        }
        ControlFlow::Continue(())
    }

    /// Trial steps of every run: their lengths, 0 without a trial; moves the frames.
    fn propose(&mut self, jobs: &mut dyn Jobs) -> ControlFlow<(), L> {
        let (mut h, mut looks) = (L::zero(), L::zero());
        let Group { bench: Some(bench), places, .. } = self else { return ControlFlow::Continue(h) };
        for (i, place) in places.iter_mut().enumerate() {
            let Some(place) = place else { continue };
            let middle_s = place.propose();
            h.set_lane(i, place.step.length_s());
            if place.looks {
                looks.set_lane(i, 1.0);
                move_frames(i, place, &mut bench.around.frames[0], [place.step.start_s, middle_s]);
            }
        }
        let bears = L::look(bench, looks, h, &mut Witness::of(places, Sees::Front));
        let mut failed = [const { None }; MOST_PLACES];
        for (i, place) in places.iter_mut().enumerate() {
            let (Some(place), Some(ahead)) = (place, &mut bench.ahead) else { continue };
            if place.looks {
                ahead.take_look(i);
                place.unread.add(ahead.stale());
            }
            failed[i] = place.shorten(bears.lane(i)).err();
            h.set_lane(i, if failed[i].is_none() { place.step.length_s() } else { 0.0 });
            let [_, middle_s, _] = place.step.times_s();
            for (frames, stage) in bench.around.frames.iter_mut().zip(STAGES) {
                move_frames(i, place, frames, [place.step.at_s(stage), middle_s]);
            }
        }
        for (i, error) in failed.into_iter().enumerate() {
            if let Some(error) = error {
                self.fail(i, error, jobs)?;
            }
        }
        ControlFlow::Continue(h)
    }

    /// Records the outputs within the latest step of run `i`.
    fn reach_outputs(&mut self, i: usize, jobs: &mut dyn Jobs) -> ControlFlow<()> {
        let mut is_fetched = false;
        while let (Some(place), Some(bench)) = (&mut self.places[i], &mut self.bench)
            && let Some(ahead) = &mut bench.ahead
        {
            let Some((target_s, end_s)) = place.ahead_s() else { break };
            if target_s >= end_s {
                place.note(i, ahead);
            }
            if target_s > end_s {
                break;
            }
            if !std::mem::replace(&mut is_fetched, true) {
                place.fetch_step(i, ahead);
            }
            place.show(target_s, i, ahead);
            if let Next::Ends(status) = place.output(jobs.recorder(i))
                && let Some(place) = self.leave(i)
            {
                return self.hand_out(i, *place, status, jobs);
            }
        }
        ControlFlow::Continue(())
    }

    /// Ends run `i` after a failed step.
    fn fail(&mut self, i: usize, error: StepError, jobs: &mut dyn Jobs) -> ControlFlow<()> {
        let Some(mut place) = self.leave(i) else { return ControlFlow::Continue(()) };
        place.stand_at_front();
        self.hand_out(i, *place, Ok(Status::Failed(error)), jobs)
    }

    /// Removes run `i`; nothing moves in its lane afterwards.
    fn leave(&mut self, i: usize) -> Option<Box<Place>> {
        if let Some(Bench { ahead: Some(ahead), .. }) = self.bench.as_deref_mut() {
            ahead.rest(i);
        }
        self.places[i].take()
    }

    /// Copies the run of `place` from lane `i`, to continue alone.
    pub(super) fn fetch_ahead(&mut self, i: usize, place: &mut Place) {
        let Some(Bench { ahead: Some(ahead), .. }) = self.bench.as_deref_mut() else { return };
        place.fetch_step(i, ahead);
        place.fetch_after(i, ahead);
    }
}

/// Shifts the lanes with an accepted trial.
fn shift<L: Machine>(
    bench: &mut Bench<L>,
    verdicts: &[Option<Result<bool, StepError>>; MOST_PLACES],
    places: &mut [Option<Box<Place>>],
) {
    let stays = |verdict: &Option<Result<bool, StepError>>| matches!(verdict, Some(Ok(false) | Err(_)));
    let Some(ahead) = bench.ahead.as_mut().filter(|_| verdicts.iter().any(|v| matches!(v, Some(Ok(true))))) else {
        return;
    };
    for place in places.iter_mut().flatten() {
        place.behind.add(ahead.moved());
    }
    ahead.shift();
    if verdicts.iter().any(stays) {
        let mut kept = L::zero();
        for i in (0..L::COUNT).filter(|i| stays(&verdicts[*i])) {
            ahead.shift_back(i);
            kept.set_lane(i, 1.0);
        }
        L::keep_hints(bench, kept);
    }
}

impl Place {
    /// Proposes the next trial; returns the middle of its step, or of one before it, s, for the rate at its start.
    fn propose(&mut self) -> f64 {
        let (Some(control), Some(mut front)) = (&self.control, self.run.front.take()) else { return f64::NAN };
        self.step = self.run.propose(&mut front, control);
        self.looks = front.must_look();
        let follows = front.pending.is_some_and(|pending| pending.follows);
        self.run.front = Some(front);
        self.step.middle_beside_s(follows)
    }

    /// Shortens the trial to `bears_s`.
    fn shorten(&mut self, bears_s: f64) -> Result<(), StepError> {
        let (Some(control), Some(mut front)) = (&self.control, self.run.front.take()) else { return Ok(()) };
        let part = self.run.shorten(&mut front, self.step.first_part(|_| bears_s), control);
        self.run.front = Some(front);
        self.step = part?;
        Ok(())
    }

    /// Judges the trial of lane `i`.
    fn judge<L: Lanes>(&mut self, i: usize, ahead: &mut Ahead<L>, errors: Errors<f64>) -> Result<bool, StepError> {
        let (Some(control), Some(mut front)) = (&self.control, self.run.front.take()) else { return Ok(false) };
        self.jumps &= front.can_switch();
        let is_asked_for = self.jumps || front.searches() || !errors.whole.is_finite();
        let Ahead { after, trial, .. } = &mut front.ahead;
        if is_asked_for {
            let fetch = &mut |lanes: &mut L, x: &mut f64| *x = lanes.lane(i);
            ahead.after.memory.each_marked(&mut after.memory, &self.unread, fetch);
            ahead.trial.memory.each_marked(&mut trial.memory, &self.unread, fetch);
            self.unread.take_over(ahead.stale());
        } else {
            // corners ask for no more
            for touching in &front.met_in_trial {
                let pair = touching.meeting.pair;
                after.memory.contacts[pair].greatest = ahead.after.memory.contacts[pair].greatest.lane(i);
            }
        }
        let verdict = self.run.judge(&self.model, &mut front, errors, self.jumps, control);
        self.run.front = Some(front);
        verdict
    }

    /// Next output, and end of the latest step, s.
    fn ahead_s(&self) -> Option<(f64, f64)> {
        let target_s = self.run.next_output_s(&self.model)?;
        Some((target_s, self.run.front.as_ref()?.step.end_s))
    }

    /// Notes contacts and readings at the end of the latest step of lane `i`, once.
    fn note<L: Lanes>(&mut self, i: usize, ahead: &mut Ahead<L>) {
        let Some(front) = self.run.front.as_mut() else { return };
        if !front.must_note() {
            return;
        }
        let Step { end_s, .. } = front.step;
        if self.jumps {
            let fetch = &mut |lanes: &mut L, x: &mut f64| *x = lanes.lane(i);
            ahead.before.memory.each_marked(&mut front.ahead.before.memory, &self.behind, fetch);
            self.unseen.add(&self.behind);
            self.behind.clear();
            ahead.after.memory.each_marked(&mut front.ahead.after.memory, &self.unread, fetch);
            let [before, now] = [&front.ahead.before.memory, &front.ahead.after.memory];
            self.run.switches.note(&self.model.system().forces, end_s, before, now);
        }
        let past = &ahead.after.memory.contacts;
        self.run.seen.see(&self.model, end_s, &front.met, &front.felt, |pair| past[pair].phase.lane(i));
    }

    /// Copies the data for outputs within the latest step of lane `i`.
    fn fetch_step<L: Lanes>(&mut self, i: usize, ahead: &mut Ahead<L>) {
        let Some(front) = &mut self.run.front else { return };
        let alone = &mut front.ahead;
        ahead.from.lane(i, &mut alone.from);
        ahead.to.lane(i, &mut alone.to);
        ahead.rates[0].lane(i, &mut alone.rates[0]);
        ahead.rates[1].lane(i, &mut alone.rates[1]);
        let fetch = &mut |lanes: &mut L, x: &mut f64| *x = lanes.lane(i);
        ahead.before.memory.each_marked(&mut alone.before.memory, &self.behind, fetch);
        self.unseen.add(&self.behind);
        self.behind.clear();
        alone.before.look_again();
    }

    /// Copies the further data for the next trial of lane `i`.
    fn fetch_after<L: Lanes>(&mut self, i: usize, ahead: &mut Ahead<L>) {
        let Some(front) = &mut self.run.front else { return };
        let alone = &mut front.ahead.after;
        ahead.after.memory.each(&mut alone.memory, &mut |lanes: &mut L, x: &mut f64| *x = lanes.lane(i));
        alone.begin_anew(&self.model.system().forces, ahead.after.pace().map(|lanes| lanes.lane(i)));
        front.ahead.forget_marks();
    }

    /// Moves the run to a time within its latest step, that of lane `i`.
    fn show<L: Lanes>(&mut self, time_s: f64, i: usize, ahead: &Ahead<L>) {
        let run = &mut self.run;
        if let Some(front) = &run.front {
            run.state = front.state_at(time_s);
            self.unseen.add(run.history.changed());
            run.history.remember(&front.ahead.before.memory, &self.unseen);
            run.history.watch_as(&ahead.before, i);
            self.unseen.clear();
        }
        run.time_s = time_s;
    }

    /// Moves the run to the end of its latest step.
    fn stand_at_front(&mut self) {
        if let Some(front) = &self.run.front {
            self.run.time_s = front.step.end_s;
        }
    }
}
