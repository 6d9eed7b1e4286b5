//! Whole steps from output to output.

use super::Run;
use crate::kernel::{Scratch, Situation};
use crate::model::Model;
use crate::motion::frame::Frames;
use crate::motion::integrate::rk4::Stages;
use crate::results::outcome::StepError;
use crate::run::observers::Met;
use crate::vehicle::PathCursor;

/// The steps from one output to the next: all of one length but the last, which ends at the output.
#[derive(Clone, Copy, Debug)]
pub struct Stretch {
    from_s: f64,
    target_s: f64,
    step_s: f64,
    count: f64,
    done: f64,
}

/// One step.
#[derive(Clone, Copy, Debug, Default)]
pub struct Step {
    /// Its start, s.
    pub start_s: f64,
    /// Its end, s.
    pub end_s: f64,
}

impl Stretch {
    /// Steps of `step_s`, the last one shortened to end at the target.
    pub(crate) fn new(from_s: f64, target_s: f64, step_s: f64) -> Self {
        Stretch { from_s, target_s, step_s, count: (((target_s - from_s) / step_s) - 1e-9).ceil().max(1.0), done: 0.0 }
    }
}

impl Stretch {
    /// True after the last step.
    #[inline]
    pub(crate) fn is_over(&self) -> bool {
        self.done >= self.count
    }
}

impl Iterator for Stretch {
    type Item = Step;

    #[inline]
    fn next(&mut self) -> Option<Step> {
        let i = self.done;
        if self.is_over() {
            return None;
        }
        self.done = i + 1.0;
        // t_i = t_{i−1} + Δt (125), counted from the last output
        let end_s = if self.done < self.count { self.from_s + self.done * self.step_s } else { self.target_s };
        let start_s = self.from_s + i * self.step_s;
        Some(Step { start_s, end_s })
    }
}

impl Step {
    /// Its length, s.
    #[inline]
    pub fn length_s(self) -> f64 {
        self.end_s - self.start_s
    }

    /// When it starts, its middle and its end, s.
    #[inline]
    pub(crate) fn times_s(self) -> [f64; 3] {
        [self.start_s, 0.5 * (self.start_s + self.end_s), self.end_s]
    }

    /// Frames at its middle and end, behind those of its start.
    #[inline]
    pub(crate) fn move_frames(self, frames: &mut [Frames<f64>; 3], model: &Model, cursor: &mut PathCursor) {
        let times_s = self.times_s();
        for (frames, t_s) in frames.iter_mut().zip(times_s).skip(1) {
            model.move_frames(frames, t_s, times_s[1], cursor);
        }
    }

    /// Its first part, of the length that a step of this length may have; all of it, as a rule.
    #[inline]
    pub(crate) fn first_part(self, bears: impl FnOnce(f64) -> f64) -> Step {
        let whole_s = self.length_s();
        let length_s = bears(whole_s);
        let end_s = self.start_s + length_s;
        // a rest that the clock can hardly tell is no step
        if length_s < whole_s && end_s < self.end_s - 1e-3 * length_s { Step { end_s, ..self } } else { self }
    }
}

impl Run {
    /// What is left of a step, if anything, and all steps of `stretch`.
    pub(crate) fn advance_rk4(&mut self, model: &Model, left: Option<Step>, stretch: Stretch) -> Result<(), StepError> {
        let (scratch, stages) = (&mut Scratch::blank(model.system()), &mut Stages::new(self.state.shape()));
        let mut frames = [Frames::still(self.time_s); 3];
        for whole in left.into_iter().chain(stretch) {
            let mut rest = whole;
            loop {
                let step = self.step_rk4(model, rest, (scratch, stages, &mut frames))?;
                if step.end_s >= whole.end_s {
                    break;
                }
                rest.start_s = step.end_s;
            }
        }
        Ok(())
    }

    /// A step of the length of `rest`, or of the part of it that what is near bears; returns it.
    fn step_rk4(
        &mut self,
        model: &Model,
        rest: Step,
        (scratch, stages, frames): (&mut Scratch<f64>, &mut Stages<f64>, &mut [Frames<f64>; 3]),
    ) -> Result<Step, StepError> {
        let system = model.system();
        let [start_s, middle_s, _] = rest.times_s();
        model.move_frames(&mut frames[0], start_s, middle_s, &mut self.cursor);
        self.met.clear();
        stages.begin(&self.state, |_, state, rate| {
            let situation = Situation::accepted(state, &frames[0]);
            let met = &mut Some(&mut Met(&mut self.met));
            system.rate_alone(scratch, situation, &mut self.history, met, rate);
        });
        self.seen.peaks.see(system.readings(scratch));
        let step = rest.first_part(|h| self.history.step(h));
        step.move_frames(frames, model, &mut self.cursor);
        let next = *stages.go(&self.state, step.length_s(), |stage, state, rate| {
            let situation = Situation::within(state, &frames[stage as usize]);
            system.rate_alone(scratch, situation, &mut self.history, &mut None::<&mut Met<'_>>, rate);
        });
        for touching in &self.met {
            self.seen.note(model, step.start_s, touching.meeting);
        }
        self.effort.evaluations += 4;
        self.accept(model, next, step)?;
        Ok(step)
    }
}
