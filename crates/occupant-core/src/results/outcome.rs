//! How a run ended: its outcome, first contacts, and errors with time, place and reason.

use crate::results::checkpoint::CheckpointError;
use crate::results::energy::EnergyCheck;
use crate::results::recorder::RecorderError;
use crate::results::sample::Effort;

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Why.
    pub status: Status,
    /// Time reached, s.
    pub time_s: f64,
    /// Work of the integrator.
    pub effort: Effort,
    /// First touch of each sphere with each surface, in the order in which they happened.
    pub first_touches: Vec<FirstTouch>,
    /// How well it kept its energy.
    pub energy: EnergyCheck,
}

/// Why a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Status {
    /// At its end time.
    Completed,
    /// A recorder stopped it.
    Stopped,
    /// The integration failed.
    Failed(StepError),
}

/// The first accepted step at which a sphere touched a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstTouch {
    /// Index of the sphere.
    pub sphere: usize,
    /// Index of the surface, of the solid behind all surfaces, or of another sphere of the body behind all solids.
    pub surface: usize,
    /// Time of the step's end, s; the start of the run for what touches at the start.
    pub time_s: f64,
    /// Speed of the sphere's centre relative to the surface, m/s.
    pub speed_m_s: f64,
    /// The part of it towards the surface, m/s.
    pub closing_m_s: f64,
}

/// The integration cannot go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StepError {
    /// The vehicle is live, and its motion is not known yet.
    #[error(
        "the vehicle motion is known only up to t = {known_s:.6} s, but the run goes to {target_s:.6} s; if you step the run yourself, push a frame first"
    )]
    NotTold {
        /// Up to when it is known, s.
        known_s: f64,
        /// Up to when it was asked for, s.
        target_s: f64,
    },
    /// A component of the state is no longer a number.
    #[error(
        "at t = {time_s:.6} s, in a step of {step_s:.3e} s, the {component} is no longer finite; try a smaller step, or softer springs and dampers"
    )]
    NotFinite {
        /// Start of the step, s.
        time_s: f64,
        /// Step, s.
        step_s: f64,
        /// Which component.
        component: String,
    },
    /// Forces could not be worked out.
    #[error(
        "at t = {time_s:.6} s, in a step of {step_s:.3e} s, {why}; try a smaller step, or smoother curves of the element"
    )]
    Unsolved {
        /// Start of the step, s.
        time_s: f64,
        /// Step, s.
        step_s: f64,
        /// Of what, and what is left over.
        why: String,
    },
    /// The error control asks for a step below the smallest allowed.
    #[error(
        "at t = {time_s:.6} s the error control needs a step of {step_s:.3e} s, below the minimum of {min_step_s:.3e} s (error {error:.2} times the tolerance); try a looser tolerance or a smaller `min_step`"
    )]
    StepTooSmall {
        /// Time, s.
        time_s: f64,
        /// Step asked for, s.
        step_s: f64,
        /// Smallest step allowed, s.
        min_step_s: f64,
        /// Error of the last trial in units of the tolerance.
        error: f64,
    },
}

/// A run that did not reach its end.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SimulationError {
    /// The integration could not continue; recorded outputs stay valid.
    #[error("{}", failed(.0))]
    Failed(Box<Outcome>),
    /// The recorder failed.
    #[error(transparent)]
    Recording(#[from] RecordingFailed),
}

fn failed(outcome: &Outcome) -> String {
    match &outcome.status {
        Status::Failed(error) => error.to_string(),
        status => format!("the run ended at t = {:.6} s: {status:?}", outcome.time_s),
    }
}

impl Outcome {
    /// The same, if the integration did not fail.
    ///
    /// # Errors
    /// The step that failed.
    pub fn succeeded(self) -> Result<Self, SimulationError> {
        match self.status {
            Status::Failed(_) => Err(SimulationError::Failed(Box::new(self))),
            Status::Completed | Status::Stopped => Ok(self),
        }
    }
}

/// A run that could not be recorded.
#[derive(Debug, thiserror::Error)]
#[error("recording failed at t = {time_s:.6} s: {source}")]
pub struct RecordingFailed {
    /// Time, s.
    pub time_s: f64,
    /// What the recorder said.
    pub source: RecorderError,
}

/// Why a run could not be resumed, or not recorded.
#[derive(Debug, thiserror::Error)]
pub enum ResumeError {
    /// The checkpoint is none of the model's.
    #[error("{0}")]
    Refused(#[source] CheckpointError),
    /// The recorder failed.
    #[error(transparent)]
    Recording(RecordingFailed),
}
