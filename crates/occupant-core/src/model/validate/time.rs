//! Times and the integrator.

use crate::model::setup::{Integrator, TimeSpan};
use placed_text::{Problems, number};

/// More steps than this are a slip of the pen.
const MOST_STEPS: f64 = 1e9;
/// More outputs than this are, too.
const MOST_OUTPUTS: f64 = 1e7;

pub(super) fn check_time(time: &TimeSpan, integrator: &Integrator, problems: &mut Problems) {
    let span_s = time.end_s - time.start_s;
    if !(span_s > 0.0 && span_s.is_finite()) {
        problems.error(
            "time.end",
            format!("a run from {} s to {} s", number(time.start_s), number(time.end_s)),
            "an end after the start",
        );
    }
    let mut at_most = |path: &str, interval_s: f64, most: f64, what: &str| {
        if problems.check_positive(path, interval_s, "s") && span_s / interval_s > most {
            problems.error(
                path,
                format!("{} s, which makes {:.1e} {what}", number(interval_s), span_s / interval_s),
                format!("at most {most:.0e} {what}"),
            );
        }
    };
    at_most("output.interval", time.output_s, MOST_OUTPUTS, "outputs");
    match *integrator {
        Integrator::Rk4 { step_s } => at_most("integrator.step", step_s, MOST_STEPS, "steps"),
        Integrator::Adaptive { relative, absolute_m, absolute_m_s, min_step_s, max_step_s } => {
            at_most("integrator.max_step", max_step_s, MOST_STEPS, "steps");
            problems.check_positive("integrator.relative", relative, "");
            problems.check_positive("integrator.absolute_length", absolute_m, "m");
            problems.check_positive("integrator.absolute_speed", absolute_m_s, "m/s");
            problems.check_positive("integrator.min_step", min_step_s, "s");
            if max_step_s < min_step_s {
                problems.error(
                    "integrator.max_step",
                    format!("{} s, below the smallest step {} s", number(max_step_s), number(min_step_s)),
                    "a largest step above the smallest",
                );
            }
        }
    }
}
