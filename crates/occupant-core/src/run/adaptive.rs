//! Steps with error control.

use super::{Run, Step};
use crate::integrate::dormand_prince::{self, Tolerance};
use crate::kernel::state::State;
use crate::model::Model;
use crate::observers::SeenAt;
use crate::outcome::StepError;
use crate::trig;

impl Run {
    /// Steps of the embedded pair until `target_s`, none across a break of the path.
    pub(super) fn advance_adaptive(
        &mut self,
        model: &Model,
        target_s: f64,
        tolerance: &Tolerance,
        min_step_s: f64,
        max_step_s: f64,
    ) -> Result<(), StepError> {
        let system = model.system();
        let mut first: Option<State<f64>> = None;
        while self.time_s < target_s {
            let t = self.time_s;
            let stop = self
                .breaks_s
                .iter()
                .copied()
                .find(|&b| b > t)
                .unwrap_or(f64::INFINITY);
            let limit = target_s.min(stop);
            let wanted = self.wanted_s.min(max_step_s);
            // a step that would leave a sliver takes it along
            let end = if t + wanted * 1.01 >= limit {
                limit
            } else {
                t + wanted
            };
            if end <= t {
                // the clock no longer tells the step's ends apart
                return Err(StepError::StepTooSmall {
                    time_s: t,
                    step_s: wanted,
                    min_step_s,
                    error: 0.0,
                });
            }
            let (h, middle) = (end - t, 0.5 * (t + end));
            let cursor = &mut self.cursor;
            let history = &mut self.history;
            let start_rate = first.unwrap_or_else(|| {
                self.effort.evaluations += 1;
                let frames = model.frames(t, middle, cursor);
                let mut observer = SeenAt {
                    model,
                    seen: &mut self.seen,
                    time_s: t,
                };
                system.rate_observed::<true>(&self.state, &frames, history, &mut observer)
            });
            let trial =
                dormand_prince::attempt(&self.state, &start_rate, h, tolerance, |c, state| {
                    let frames = model.frames(t + c * h, middle, cursor);
                    system.rate::<false>(state, &frames, history)
                });
            self.effort.evaluations += 6;
            // fifth-order growth with a safety factor; a trial that is not a number asks for a tenth
            let growth = if trial.error.is_finite() {
                (0.9 * trig::pow(trial.error.max(1e-10), -0.2)).clamp(0.1, 5.0)
            } else {
                0.1
            };
            if trial.error <= 1.0 {
                let full = h >= wanted * 0.99;
                self.wanted_s = if full {
                    h * growth
                } else {
                    self.wanted_s.max(h * growth)
                };
                let step = Step {
                    start_s: t,
                    end_s: end,
                };
                self.accept(trial.state, step)?;
                if end < target_s {
                    let frames = model.frames(end, middle, &mut self.cursor);
                    let mut observer = SeenAt {
                        model,
                        seen: &mut self.seen,
                        time_s: end,
                    };
                    system.commit(&self.state, &frames, &mut self.history, &mut observer);
                }
                // the velocity of the vehicle may jump at a break
                first = (end < stop).then_some(trial.rate);
            } else {
                self.effort.rejected += 1;
                first = Some(start_rate);
                self.wanted_s = h * growth.min(0.9);
                if self.wanted_s < min_step_s {
                    return Err(StepError::StepTooSmall {
                        time_s: t,
                        step_s: self.wanted_s,
                        min_step_s,
                        error: trial.error,
                    });
                }
            }
        }
        Ok(())
    }
}
