//! Times and the integrator.

use crate::model::setup::{DEFAULT_OUTPUT_S, Integrator, TimeSpan};
use placed_text::{Problems, number};

/// Largest number of steps; more is a mistake.
const MOST_STEPS: f64 = 1e9;
/// Largest number of outputs or readings.
const MOST_OUTPUTS: f64 = 1e7;

/// Smallest relative tolerance, of quantities of the order of 1.
const FINEST: f64 = 1e-13;
/// Smallest step that changes times of the order of 1 s, s.
const SHORTEST_S: f64 = 1e-15;

/// Interval that is permitted for runs of any length, s.
const LONGEST_ANYWAY_S: f64 = 10.0 * DEFAULT_OUTPUT_S;

pub(crate) fn check_time(time: &TimeSpan, integrator: &Integrator, problems: &mut Problems) {
    let span_s = time.end_s - time.start_s;
    if !(span_s > 0.0 && span_s.is_finite()) {
        problems.error(
            "time.end",
            format!("a run from {} s to {} s", number(time.start_s), number(time.end_s)),
            "an end after the start",
        );
    }
    at_most(problems, ("output.interval", time.output_s), span_s, (MOST_OUTPUTS, "outputs"));
    within_run(problems, time.output_s, span_s);
    match *integrator {
        Integrator::Rk4 { step_s } => {
            at_most(problems, ("integrator.step", step_s), span_s, (MOST_STEPS, "steps"));
        }
        Integrator::Adaptive { relative, absolute_m, absolute_m_s, min_step_s, max_step_s } => {
            at_most(problems, ("integrator.max_step", max_step_s), span_s, (MOST_STEPS, "steps"));
            at_least(problems, ("integrator.relative", relative, ""), FINEST);
            at_least(problems, ("integrator.absolute_length", absolute_m, "m"), 0.1 * FINEST);
            at_least(problems, ("integrator.absolute_speed", absolute_m_s, "m/s"), FINEST);
            at_least(problems, ("integrator.min_step", min_step_s, "s"), SHORTEST_S);
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

/// Reports a number that is not positive, or so small that a run with 16 digits would not end.
fn at_least(problems: &mut Problems, (path, value, unit): (&str, f64, &str), least: f64) {
    if problems.check_positive(path, value, unit) && !(value >= least && value.is_finite()) {
        let found = format!("{} {unit}", number(value));
        problems.error(
            path,
            found.trim_end(),
            format!("at least {least:.0e} {unit}, which numbers of 16 digits can tell"),
        );
    }
}

/// Checks the interval of instrument readings, if given; scenarios have no key for it.
pub(super) fn check_readings(readings_s: Option<f64>, time: &TimeSpan, problems: &mut Problems) {
    let span_s = time.end_s - time.start_s;
    if let Some(interval_s) = readings_s {
        at_most(problems, ("output.interval", interval_s), span_s, (MOST_OUTPUTS, "readings"));
        within_run(problems, interval_s, span_s);
    }
}

/// Reports an interval longer than the run.
fn within_run(problems: &mut Problems, interval_s: f64, span_s: f64) {
    if span_s > 0.0 && interval_s > span_s.max(LONGEST_ANYWAY_S) {
        problems.error(
            "output.interval",
            format!("{} s, in a run of {} s", number(interval_s), number(span_s)),
            "an interval no longer than the run",
        );
    }
}

/// Reports an interval that is not positive, or so short that the span has more than `most` of them.
fn at_most(problems: &mut Problems, (path, interval_s): (&str, f64), span_s: f64, (most, what): (f64, &str)) {
    if problems.check_positive(path, interval_s, "s") && span_s / interval_s > most {
        problems.error(
            path,
            format!("{} s, which makes {:.1e} {what}", number(interval_s), span_s / interval_s),
            format!("at most {most:.0e} {what}"),
        );
    }
}
