//! Measures that may be left out, and why.

use std::fmt;

use crash_measures::signal::SignalError;

/// A measure, or why it was left out.
pub type Measured<T> = Result<T, Missing>;

/// Why a measure was left out.
#[derive(Clone, Debug, PartialEq)]
pub enum Missing {
    /// It needs channels that the record does not have.
    Channels(Vec<&'static str>),
    /// The signals do not allow it.
    Signal(SignalError),
    /// The rates do not lead to an attitude: why not.
    Turning(String),
}

impl Missing {
    /// Needs these channels.
    pub fn channels(names: &[&'static str]) -> Self {
        Missing::Channels(names.to_vec())
    }
}

impl From<SignalError> for Missing {
    fn from(error: SignalError) -> Self {
        Missing::Signal(error)
    }
}

impl fmt::Display for Missing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Missing::Channels(names) => {
                write!(f, "needs {}, which the record does not have", names.join(" and "))
            }
            Missing::Signal(error) => error.fmt(f),
            Missing::Turning(reason) => f.write_str(reason),
        }
    }
}

/// Two things that are both needed; the channels that both lack are named together.
pub(super) fn both<A, B>(a: Measured<A>, b: Measured<B>) -> Measured<(A, B)> {
    match (a, b) {
        (Ok(a), Ok(b)) => Ok((a, b)),
        (Err(Missing::Channels(a)), Err(Missing::Channels(b))) => Err(Missing::Channels([a, b].concat())),
        (Err(missing), _) | (_, Err(missing)) => Err(missing),
    }
}
