//! One error for everything.

use std::fmt;

use occupant_core::model::Model;
use occupant_core::results::Unknown;
use occupant_core::results::outcome::{RecordingFailed, SimulationError};
use occupant_core::run::RunError;
use occupant_core::vehicle::PathProblem;
use occupant_scenario::Diagnostics;
use placed_text::Problems;

/// Kind of an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ErrorKind {
    /// An invalid text: [`Error::diagnostics`] has the positions.
    Text,
    /// An invalid case: [`Error::problems`] lists all problems.
    Case,
    /// An unknown name.
    Name,
    /// An invalid input: a time, a frame of the vehicle, a number.
    Input,
    /// The integration could not continue.
    Integration,
    /// Results could not be recorded.
    Recording,
}

/// Description: what was found, what was expected and how to correct it.
pub struct Error {
    kind: ErrorKind,
    source: Box<dyn std::error::Error + Send + Sync>,
}

impl Error {
    /// An error of a kind, with a description or a cause.
    pub fn new(kind: ErrorKind, source: impl Into<Box<dyn std::error::Error + Send + Sync>>) -> Self {
        Error { kind, source: source.into() }
    }

    /// Its kind.
    pub fn kind(&self) -> ErrorKind {
        self.kind
    }

    /// Problems of a text, each with line and column.
    pub fn diagnostics(&self) -> Option<&Diagnostics> {
        self.source.downcast_ref()
    }

    /// Problems of a case, each with its path.
    pub fn problems(&self) -> Option<&Problems> {
        self.source.downcast_ref()
    }

    /// The unknown name, with the nearest existing one.
    pub fn unknown(&self) -> Option<&Unknown> {
        self.source.downcast_ref()
    }
}

impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // what `main` prints
        write!(f, "{}", self.source)
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.source)
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.source.source()
    }
}

/// Implements `From` for errors of these kinds.
macro_rules! from {
    ($($Type:ty: $kind:ident),+ $(,)?) => {
        $(impl From<$Type> for Error {
            fn from(error: $Type) -> Self {
                Error::new(ErrorKind::$kind, error)
            }
        })+
    };
}

from! {
    Diagnostics: Text,
    Problems: Case,
    Unknown: Name,
    RecordingFailed: Recording,
    PathProblem: Input,
}

impl From<Vec<PathProblem>> for Error {
    fn from(problems: Vec<PathProblem>) -> Self {
        let words: Vec<String> = problems.iter().map(ToString::to_string).collect();
        Error::new(ErrorKind::Input, words.join("; "))
    }
}

impl From<SimulationError> for Error {
    fn from(error: SimulationError) -> Self {
        let kind = match error {
            SimulationError::Recording(_) => ErrorKind::Recording,
            _ => ErrorKind::Integration,
        };
        Error::new(kind, error)
    }
}

impl From<RunError> for Error {
    fn from(error: RunError) -> Self {
        let kind = match error {
            RunError::Step(_) => ErrorKind::Integration,
            RunError::Recording(_) => ErrorKind::Recording,
            _ => ErrorKind::Input,
        };
        Error::new(kind, error)
    }
}

/// Error for a name that a model does not have.
pub(crate) fn unknown<'n>(what: &'static str, name: &str, names: impl Iterator<Item = &'n str>) -> Error {
    Error::from(Unknown::new(what, name, names))
}

/// The channel of a name, or the error that the model has none.
pub(crate) fn no_channel(model: &Model, name: &str) -> Error {
    let all = occupant_core::results::channel::channels(model);
    let names = || all.iter().map(|channel| channel.name.as_str());
    let mut error = Unknown::new("channel", name, names());
    // `head.place.x` means `head.position.x`: of the same thing, along the same axis, the one that begins most alike
    let ends = |name: &str| Some((name.split_once('.')?.0.to_owned(), name.rsplit_once('.')?.1.to_owned()));
    let common = |own: &&str| own.bytes().zip(name.bytes()).take_while(|(a, b)| a == b).count();
    let alike = || names().filter(|own| ends(own).is_some() && ends(own) == ends(name)).max_by_key(common);
    error.nearest = error.nearest.or_else(|| alike().map(str::to_owned));
    Error::from(error)
}
