//! What a sweep says when something is wrong.

use super::plan::NoPlan;
use crate::base::failure::Failure;
use crate::files::study_folder::problem::Problem;

/// A study that cannot be run.
pub(crate) fn no_plan(reason: NoPlan) -> Failure {
    match reason.0.starts_with("error") {
        true => Failure::CouldNotRun(reason.0),
        false => Failure::plain(reason.0),
    }
}

/// A problem of the folder, in words.
pub(crate) fn told(problem: Problem) -> Failure {
    let help = problem.help();
    let broke_off =
        matches!(problem, Problem::Io { doing: "write", .. } | Problem::Table { .. } | Problem::Incomplete { .. });
    let help = help.map(|h| format!("\n = help: {h}")).unwrap_or_default();
    let message = format!("error: {problem}{help}");
    match broke_off {
        true => Failure::BrokeOff(message),
        false => Failure::CouldNotRun(message),
    }
}
