//! Times and the integrator.

use super::positive;
use crate::problem::Problems;
use crate::setup::{Integrator, TimeSpan};

pub(super) fn check_time(time: &TimeSpan, integrator: &Integrator, problems: &mut Problems) {
    if !time.start_s.is_finite() || !time.end_s.is_finite() || time.end_s <= time.start_s {
        problems.error(
            "time",
            format!("a run from {} s to {} s", time.start_s, time.end_s),
            "an end after the start",
        );
    }
    positive(problems, "time.output", time.output_s, "s");
    match *integrator {
        Integrator::Rk4 { step_s } => {
            if positive(problems, "integrator.step", step_s, "s") {
                let steps = (time.end_s - time.start_s) / step_s;
                if steps > 1e9 {
                    problems.error(
                        "integrator.step",
                        format!("{step_s} s, {steps:.1e} steps"),
                        "fewer than 1e9 steps",
                    );
                }
            }
        }
        Integrator::Adaptive {
            relative,
            absolute_m,
            absolute_m_s,
            min_step_s,
            max_step_s,
        } => {
            positive(problems, "integrator.relative", relative, "");
            positive(problems, "integrator.absolute", absolute_m, "m");
            positive(problems, "integrator.absolute_speed", absolute_m_s, "m/s");
            positive(problems, "integrator.min_step", min_step_s, "s");
            if positive(problems, "integrator.max_step", max_step_s, "s") && max_step_s < min_step_s
            {
                problems.error(
                    "integrator.max_step",
                    format!("{max_step_s} s, below the smallest step {min_step_s} s"),
                    "a largest step above the smallest",
                );
            }
        }
    }
}
