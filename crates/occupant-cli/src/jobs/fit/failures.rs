//! What a fit says when something is wrong.

use crate::base::failure::Failure;
use crate::files::study_folder::problem::Problem;

/// A problem with the folder, as the end of the command.
pub(crate) fn told(problem: Problem) -> Failure {
    match (&problem, problem.help()) {
        (Problem::Io { .. } | Problem::Table { .. }, _) => Failure::BrokeOff(format!("error: {problem}")),
        (_, Some(help)) => Failure::with_help(problem.to_string(), help),
        (_, None) => Failure::plain(problem.to_string()),
    }
}

/// The words of a failure.
pub(crate) fn of_failure(failure: Failure) -> String {
    match failure {
        Failure::CouldNotRun(words) | Failure::BrokeOff(words) => words,
    }
}
