//! Outcome of a run: its end, first contacts, and errors with time, location and reason.

use crate::results::checkpoint::CheckpointError;
use crate::results::energy::EnergyCheck;
use crate::results::recorder::RecorderError;
use crate::results::sample::Effort;

/// End of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Reason.
    pub status: Status,
    /// Time reached, s.
    pub time_s: f64,
    /// Work of the integrator.
    pub effort: Effort,
    /// First contact of each sphere with each surface, in order of time.
    pub first_touches: Vec<FirstTouch>,
    /// Energy error.
    pub energy: EnergyCheck,
}

/// Reason for the end of a run.
#[derive(Clone, Debug, PartialEq)]
pub enum Status {
    /// At its end time.
    Completed,
    /// A recorder stopped it.
    Stopped,
    /// The integration failed.
    Failed(StepError),
}

/// First accepted step with contact of a sphere and a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstTouch {
    /// Index of the sphere.
    pub sphere: usize,
    /// Index of the surface, of the solid after all surfaces, or of another sphere of the body after all solids.
    pub surface: usize,
    /// Time of the step's end, s; the start of the run for contacts at the start.
    pub time_s: f64,
    /// Speed of the sphere's centre relative to the surface, m/s.
    pub speed_m_s: f64,
    /// Its component towards the surface, m/s.
    pub closing_m_s: f64,
}

/// Failure of the integration.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StepError {
    /// The motion of a live vehicle is not known yet.
    #[error(
        "the vehicle motion is known only up to t = {known_s:.6} s, but the run goes to {target_s:.6} s; if you step the run yourself, push a frame first"
    )]
    NotTold {
        /// End of the known time, s.
        known_s: f64,
        /// Requested time, s.
        target_s: f64,
    },
    /// A component of the state has become NaN or infinite.
    #[error(
        "at t = {time_s:.6} s, in a step of {step_s:.3e} s, the {component} is no longer finite; try a smaller step, or softer springs and dampers"
    )]
    NotFinite {
        /// Start of the step, s.
        time_s: f64,
        /// Step, s.
        step_s: f64,
        /// Name of the component.
        component: String,
    },
    /// Forces could not be computed.
    #[error(
        "at t = {time_s:.6} s, in a step of {step_s:.3e} s, {why}; try a smaller step, or smoother curves of the element"
    )]
    Unsolved {
        /// Start of the step, s.
        time_s: f64,
        /// Step, s.
        step_s: f64,
        /// Element and residual, as text.
        why: String,
    },
    /// It would cost more evaluations than it may.
    #[error(
        "at t = {time_s:.6} s the run has cost {evaluations} evaluations, more than `time.max_evaluations` permits ({most}); look for values that are too stiff or too strongly damped"
    )]
    TooManyEvaluations {
        /// Time, s.
        time_s: f64,
        /// Evaluations so far.
        evaluations: u64,
        /// Those permitted.
        most: u64,
    },
    /// It takes longer than it may.
    #[error(
        "at t = {time_s:.6} s the run has taken longer than `time.max_wall_time` permits ({most_s} s); look for values that are too stiff or too strongly damped"
    )]
    TookTooLong {
        /// Time of the run, s.
        time_s: f64,
        /// Wall time permitted, s.
        most_s: f64,
    },
    /// The error control asks for a step below the smallest allowed.
    #[error(
        "at t = {time_s:.6} s the error control needs a step of {step_s:.3e} s, below the minimum of {min_step_s:.3e} s (error {error:.2} times the tolerance); try a looser tolerance or a smaller `min_step`"
    )]
    StepTooSmall {
        /// Time, s.
        time_s: f64,
        /// Requested step, s.
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
    /// The integration failed; recorded outputs stay valid.
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
    /// Error of the recorder.
    pub source: RecorderError,
}

/// Reason why a run could not be resumed or recorded.
#[derive(Debug, thiserror::Error)]
pub enum ResumeError {
    /// The checkpoint does not belong to the model.
    #[error("{0}")]
    Refused(#[source] CheckpointError),
    /// The recorder failed.
    #[error(transparent)]
    Recording(RecordingFailed),
}
