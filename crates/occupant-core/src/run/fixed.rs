//! Whole steps from output to output.

use super::Run;
use crate::kernel::{Scratch, Situation};
use crate::model::Model;
use crate::motion::frame::Frames;
use crate::motion::integrate::rk4::{Stage, Stages};
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

    /// Frames at its start, middle and end.
    #[inline]
    pub(crate) fn move_frames(self, frames: &mut [Frames<f64>; 3], model: &Model, cursor: &mut PathCursor) {
        let times_s = self.times_s();
        for (frames, t_s) in frames.iter_mut().zip(times_s) {
            model.move_frames(frames, t_s, times_s[1], cursor);
        }
    }
}

impl Run {
    /// All steps of `stretch`.
    pub(crate) fn advance_rk4(&mut self, model: &Model, stretch: Stretch) -> Result<(), StepError> {
        let system = model.system();
        let (scratch, stages) = (&mut Scratch::blank(system), &mut Stages::new(self.state.shape()));
        let mut frames = [Frames::still(self.time_s); 3];
        for step in stretch {
            step.move_frames(&mut frames, model, &mut self.cursor);
            self.met.clear();
            let (history, mut met) = (&mut self.history, Met(&mut self.met));
            let peaks = &mut self.seen.peaks;
            // one call: each would be a whole kernel
            let next = *stages.step(&self.state, step.length_s(), |stage, state, rate| {
                let accepted = stage == Stage::Start;
                let situation = Situation { state, frames: &frames[stage as usize], accepted };
                system.rate_alone(scratch, situation, history, &mut accepted.then_some(&mut met), rate);
                if accepted {
                    peaks.see(system.readings(scratch));
                }
            });
            for touching in &self.met {
                self.seen.note(model, step.start_s, touching.meeting);
            }
            self.effort.evaluations += 4;
            self.accept(model, next, step)?;
        }
        Ok(())
    }
}
