//! Why there is no derivative.

use occupant_core::forces::Unlike;
use occupant_core::results::Unknown;
use occupant_core::results::recorder::RecorderError;
use thiserror::Error;

/// Reason why there is no derivative.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Trouble {
    /// A measure that no run of the model has.
    #[error(transparent)]
    Unknown(#[from] Unknown),
    /// A parameter without a value or a size, or one of another model.
    #[error("{0}")]
    Parameter(String),
    /// No valid model close to a parameter's value.
    #[error("the scenario is invalid just above and below the value of `{parameter}`: {reason}")]
    Refused {
        /// The parameter.
        parameter: String,
        /// The scenario's message for the values nearby.
        reason: String,
    },
    /// The parameter changes which parts are in contact, not only how strongly.
    #[error("`{parameter}` changes the structure of the model, so there is no derivative: {unlike}")]
    Structure {
        /// The parameter.
        parameter: String,
        /// The difference.
        unlike: Unlike,
    },
    /// The parameter changes the times or steps of the run.
    #[error("`{parameter}` changes the times or steps of the run; such a derivative is not available")]
    Times {
        /// The parameter.
        parameter: String,
    },
    /// The start of the run is not a smooth function of the parameter.
    #[error(
        "the start of the run is not smooth in `{parameter}`: two extrapolations of its slope differ by {:.2} %",
        100.0 * doubt
    )]
    Rough {
        /// The parameter.
        parameter: String,
        /// Relative distance of two extrapolations.
        doubt: f64,
    },
    /// The run did not complete.
    #[error("the run did not complete: {0}")]
    Run(String),
    /// The run in dual numbers differs from the plain run: a defect of this program.
    #[error("the run in dual numbers differs from the plain run before t = {time_s} s: a defect of this program")]
    Apart {
        /// At this output time, s.
        time_s: f64,
    },
    /// A displaced output could not be evaluated.
    #[error("an output cannot be evaluated: {0}")]
    Output(String),
    /// A recorder could not take an output.
    #[error("an output cannot be evaluated: {0}")]
    Recorder(#[from] RecorderError),
}
