//! Why there is no derivative.

use std::fmt;

use occupant_core::forces::Unlike;
use occupant_core::results::checkpoint::CheckpointError;
use occupant_core::results::recorder::RecorderError;

/// Why there is no derivative.
#[derive(Debug)]
pub enum Trouble {
    /// No model a little to either side of a parameter's value.
    Refused {
        /// The parameter.
        parameter: String,
        /// What the scenario says of the values beside it.
        reason: String,
    },
    /// The parameter changes what touches what, not only how strongly.
    Structure {
        /// The parameter.
        parameter: String,
        /// What differs.
        unlike: Unlike,
    },
    /// The parameter changes the times or steps of the run.
    Times {
        /// The parameter.
        parameter: String,
    },
    /// The start of the run is not a smooth function of the parameter.
    Rough {
        /// The parameter.
        parameter: String,
        /// Relative distance of two extrapolations.
        doubt: f64,
    },
    /// The run did not come to its end.
    Run(String),
    /// The run in dual numbers left the plain run: a defect of this program.
    Apart {
        /// At this output time, s.
        time_s: f64,
    },
    /// An output could not be evaluated beside its place.
    Output(String),
}

impl fmt::Display for Trouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Trouble::Refused { parameter, reason } => {
                write!(f, "there is no scenario a little above or below the value of `{parameter}`: {reason}")
            }
            Trouble::Structure { parameter, unlike } => {
                write!(f, "`{parameter}` changes the structure of the model, so there is no derivative: {unlike}")
            }
            Trouble::Times { parameter } => write!(
                f,
                "`{parameter}` changes the times or the steps of the run, of which there is no derivative here"
            ),
            Trouble::Rough { parameter, doubt } => write!(
                f,
                "the start of the run is not smooth in `{parameter}`: two extrapolations of its slope differ by {:.2} %",
                doubt * 100.0
            ),
            Trouble::Run(reason) => write!(f, "the run was not completed: {reason}"),
            Trouble::Apart { time_s } => {
                write!(f, "the run in dual numbers left the plain run before t = {time_s} s: a defect of this program")
            }
            Trouble::Output(reason) => write!(f, "an output cannot be evaluated: {reason}"),
        }
    }
}

impl std::error::Error for Trouble {}

impl From<RecorderError> for Trouble {
    fn from(error: RecorderError) -> Self {
        Trouble::Output(error.to_string())
    }
}

impl From<CheckpointError> for Trouble {
    fn from(error: CheckpointError) -> Self {
        Trouble::Output(error.to_string())
    }
}
