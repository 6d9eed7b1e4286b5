//! Measures that may be left out, and why.

use crash_measures::signal::SignalError;

/// A measure, or why it was left out.
pub type Measured<T> = Result<T, Missing>;

/// Why a measure was left out.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Missing {
    /// It needs channels that the record does not have.
    #[error("needs {}, which the record does not have", .0.join(" and "))]
    Channels(Vec<&'static str>),
    /// The signals do not allow it.
    #[error("{0}")]
    Signal(#[from] SignalError),
    /// The rates do not give an attitude, with the reason.
    #[error("{0}")]
    Turning(String),
}

/// Two values that are both needed; missing channels of both are named together.
pub(super) fn both<A, B>(a: Measured<A>, b: Measured<B>) -> Measured<(A, B)> {
    match (a, b) {
        (Ok(a), Ok(b)) => Ok((a, b)),
        (Err(Missing::Channels(a)), Err(Missing::Channels(b))) => Err(Missing::Channels([a, b].concat())),
        (Err(missing), _) | (_, Err(missing)) => Err(missing),
    }
}
