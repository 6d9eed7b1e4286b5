//! Steps with error control.

use super::front::Asks;
use super::{Course, Front, Step};
use crate::model::Model;
use crate::model::setup::Integrator;
use crate::motion::integrate::bogacki_shampine::{ERROR_ORDER, EVALUATIONS, Errors, Tolerance};
use crate::results::outcome::StepError;
use occupant_units::trig;

/// Bounds of the steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Control {
    pub tolerance: Tolerance,
    pub min_step_s: f64,
    pub max_step_s: f64,
}

impl Control {
    /// Control of an integrator with error control.
    pub(super) fn of(integrator: &Integrator) -> Option<Self> {
        let &Integrator::Adaptive { relative, absolute_m, absolute_m_s, min_step_s, max_step_s } = integrator else {
            return None;
        };
        Some(Control { tolerance: Tolerance { relative, absolute_m, absolute_m_s }, min_step_s, max_step_s })
    }
}

/// Memory of the error control between steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Memory {
    /// Planned length of the next step, s.
    pub wanted_s: f64,
    /// Error of the last accepted step in units of the tolerance.
    pub error: f64,
}

impl Memory {
    /// Memory before any step.
    pub(super) fn new(first_step_s: f64) -> Self {
        Memory { wanted_s: first_step_s, error: 1.0 }
    }

    /// Updates it after an accepted step of length `h`; `is_full`: the step was bounded by the error control only.
    ///
    ///
    /// Proportional–integral control (Gustafsson 1991): a step near the stability limit is approached without
    /// overshoot.
    fn accept(&mut self, h: f64, error: f64, is_full: bool, was_rejected: bool) {
        let error = error.max(1e-6);
        let power = |x: f64, share: f64| trig::pow(x, share / ERROR_ORDER);
        let growth = 0.9 * power(error, -0.7) * power(self.error, 0.4);
        // what was just found too long is not tried at once again
        let most = if was_rejected { 1.0 } else { 5.0 };
        let next_s = h * growth.clamp(0.2, most);
        self.wanted_s = if is_full { next_s } else { self.wanted_s.max(next_s) };
        self.error = error.max(1e-4);
    }

    /// Updates it after a rejected step of length `h`; a trial with NaN is reduced to a tenth.
    fn reject(&mut self, h: f64, error: f64) {
        let shrink = if error.is_finite() { (0.9 * trig::pow(error, -1.0 / ERROR_ORDER)).clamp(0.1, 0.9) } else { 0.1 };
        self.wanted_s = h * shrink;
    }
}

impl Course {
    /// Steps until one reaches `target_s`, none across a discontinuity of the path; then shows the state at `target_s`.
    pub(super) fn advance_adaptive(
        &mut self,
        model: &Model,
        target_s: f64,
        control: &Control,
    ) -> Result<(), StepError> {
        let Some(mut front) = self.front.take() else {
            return Ok(());
        };
        front.complete(model, &control.tolerance, &self.breaks_s, (&mut self.cursor, &mut self.seen));
        let mut failed = Ok(());
        while failed.is_ok() && front.step.end_s < target_s {
            front.note(model, &mut self.seen, &mut self.switches);
            failed = self.step_on(model, &mut front, control);
        }
        if front.step.end_s <= target_s {
            front.note(model, &mut self.seen, &mut self.switches);
        }
        self.time_s = match failed {
            Ok(()) => {
                front.show(target_s, &mut self.state, &mut self.history);
                target_s
            }
            Err(_) => front.step.end_s,
        };
        self.front = Some(front);
        failed
    }

    /// One accepted step of the front.
    fn step_on(&mut self, model: &Model, front: &mut Front, control: &Control) -> Result<(), StepError> {
        loop {
            let step = self.propose(front, control);
            let follows = front.pending.is_some_and(|pending| pending.follows);
            front.look(model, step, follows, &mut self.cursor);
            let step = self.shorten(front, step.first_part(|h| front.ahead.after.step(h)), control)?;
            let errors = front.attempt(model, step, &control.tolerance, &mut self.cursor);
            if self.judge(model, front, errors, front.has_switched(), control)? {
                front.ahead.shift();
                return Ok(());
            }
        }
    }

    /// Next trial step from the front, as long as error control and discontinuities of the path permit.
    pub(super) fn propose(&mut self, front: &mut Front, control: &Control) -> Step {
        let start_s = front.step.end_s;
        let mut pending = front.pending.take().unwrap_or_else(|| {
            front.begin_step();
            self.pending(start_s)
        });
        pending.wanted_s = self.control.wanted_s.min(control.max_step_s);
        let located = pending.behind_s.take();
        pending.is_located = located.is_some();
        pending.step.end_s = located.unwrap_or_else(|| end_of_step(start_s, pending.wanted_s, pending.stop_s));
        front.pending = Some(pending);
        pending.step
    }

    /// Begins a step.
    fn pending(&mut self, start_s: f64) -> Pending {
        // they are in increasing order
        let next = self.breaks_s.partition_point(|&b| b <= start_s);
        let stop_s = self.breaks_s.get(next).copied().unwrap_or(f64::INFINITY);
        // the rate is then that of the end of the step before
        let is_break = next > 0 && self.breaks_s[next - 1] == start_s;
        let follows = self.effort.steps > 0 && !is_break;
        self.effort.evaluations += u64::from(!follows);
        Pending {
            step: Step { start_s, end_s: start_s },
            follows,
            stop_s,
            last_s: self.effort.step_s,
            wanted_s: 0.0,
            is_located: false,
            behind_s: None,
            was_rejected: false,
        }
    }

    /// Sets `step` as the trial: the proposal, or the part of it in which no contact is missed.
    pub(super) fn shorten(&self, front: &mut Front, step: Step, control: &Control) -> Result<Step, StepError> {
        let Some(pending) = &mut front.pending else { return Ok(step) };
        self.refuse_beyond_allowance(step.start_s)?;
        pending.step = step;
        if step.length_s() <= 0.0 {
            // the clock no longer tells the step's ends apart
            return Err(too_small(step.start_s, pending.wanted_s, control, 0.0));
        }
        Ok(step)
    }

    /// Whether the trial with these errors is accepted: then it becomes the latest step. `jumps`: an element has
    /// switched by its end.
    pub(super) fn judge(
        &mut self,
        model: &Model,
        front: &mut Front,
        errors: Errors<f64>,
        jumps: bool,
        control: &Control,
    ) -> Result<bool, StepError> {
        self.effort.evaluations += EVALUATIONS;
        let Some(mut pending) = front.pending.take() else { return Ok(false) };
        let (step, error) = (pending.step, errors.counting(jumps));
        if error.is_finite() {
            let corners = !pending.is_located;
            let asks = Asks { corners, jumps, tolerance: &control.tolerance, last_s: pending.last_s };
            pending.behind_s = front.end_earlier(model, step, &asks);
        }
        let h = step.length_s();
        if pending.behind_s.is_none() && error <= 1.0 {
            let is_full = !pending.is_located && h >= pending.wanted_s * 0.99;
            self.control.accept(h, error, is_full, pending.was_rejected);
            self.count(step);
            front.accept(step, step.end_s >= pending.stop_s);
            return Ok(true);
        }
        self.effort.rejected += 1;
        if pending.behind_s.is_some() {
            if error > 1.0 && !pending.is_located {
                self.control.reject(h, error);
            }
            front.pending = Some(pending);
            return Ok(false);
        }
        pending.was_rejected = true;
        front.pending = Some(pending);
        self.control.reject(h, error);
        front.begin_step();
        let wanted_s = self.control.wanted_s;
        if wanted_s < control.min_step_s {
            let failure = front.failure(model).filter(|_| !error.is_finite());
            return Err(failure.map_or_else(
                || too_small(step.start_s, wanted_s, control, error),
                |why| StepError::Unsolved { time_s: step.start_s, step_s: h, why },
            ));
        }
        Ok(false)
    }
}

/// A step that is being tried.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pending {
    /// The trial.
    step: Step,
    /// Whether it continues from the end of the step before, without a discontinuity.
    pub follows: bool,
    /// Latest end of the step, s.
    stop_s: f64,
    /// Length of the step before, s.
    last_s: f64,
    /// Length planned by the error control, s.
    wanted_s: f64,
    /// Whether the trial ends at a switch or after a kink.
    is_located: bool,
    /// End of the next trial for that purpose, s.
    behind_s: Option<f64>,
    was_rejected: bool,
}

/// A step that would leave a very short rest before `stop_s` includes it; one that would leave less than its own length
/// is halved.
fn end_of_step(start_s: f64, wanted_s: f64, stop_s: f64) -> f64 {
    if start_s + 1.01 * wanted_s >= stop_s {
        stop_s
    } else if start_s + 2.0 * wanted_s > stop_s {
        0.5 * (start_s + stop_s)
    } else {
        start_s + wanted_s
    }
}

fn too_small(time_s: f64, step_s: f64, control: &Control, error: f64) -> StepError {
    StepError::StepTooSmall { time_s, step_s, min_step_s: control.min_step_s, error }
}
