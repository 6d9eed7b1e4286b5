//! Checks of a signal, with what was found and what was needed.

/// Reason why a signal cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SignalError {
    /// Fewer samples than the operation needs.
    #[error("{what} has {found} samples, at least {needed} are needed")]
    TooShort {
        /// The signal.
        what: &'static str,
        /// Samples found.
        found: usize,
        /// Samples needed.
        needed: usize,
    },
    /// The signal lasts less than the window or event looked for.
    #[error("{what} lasts {found_s} s, at least {needed_s} s are needed")]
    TooBrief {
        /// The signal or window.
        what: &'static str,
        /// Duration found, s.
        found_s: f64,
        /// Duration needed, s.
        needed_s: f64,
    },
    /// A sample is NaN, infinite or beyond 1e100 in magnitude.
    #[error("{what}: sample {index} is {found}, every sample must be a finite number within 1e100")]
    NotFinite {
        /// The signal.
        what: &'static str,
        /// Index of the first such sample.
        index: usize,
        /// Its value.
        found: f64,
    },
    /// Two signals that belong together differ in length.
    #[error("{what} has {found} samples, expected {expected} like its companion")]
    LengthMismatch {
        /// The second signal.
        what: &'static str,
        /// Its length.
        found: usize,
        /// The length of the first.
        expected: usize,
    },
    /// A parameter lies outside its admissible range.
    #[error("{what} is {found}, expected {expected}")]
    OutOfRange {
        /// The parameter with its unit.
        what: &'static str,
        /// Its value.
        found: f64,
        /// The admissible range in words.
        expected: &'static str,
    },
    /// Times do not increase.
    #[error("time {index} is {found_s} s, it must be above the one before, {previous_s} s")]
    NotIncreasing {
        /// Index of the first time that is not above the one before.
        index: usize,
        /// That time, s.
        found_s: f64,
        /// The time before it, s.
        previous_s: f64,
    },
    /// Times are not equally spaced: resample first.
    #[error("time {index} is {found_s} s, a uniform grid has {expected_s} s there: resample first")]
    NotUniform {
        /// Index of the first time off the grid.
        index: usize,
        /// That time, s.
        found_s: f64,
        /// The time a uniform grid would have there, s.
        expected_s: f64,
    },
    /// A filter's corner is not below half the sample rate.
    #[error(
        "the filter's corner is {corner_hz} Hz, it must be below half the sample rate, {nyquist_hz} Hz: record with a shorter \
         interval or use a lower class"
    )]
    CornerAboveNyquist {
        /// Corner of one filter pass, Hz.
        corner_hz: f64,
        /// Half the sample rate, Hz.
        nyquist_hz: f64,
    },
    /// A signal that a ratio divides by is zero throughout (or has no variation).
    #[error("{what} has no content to compare with: it never varies or is zero")]
    NoContent {
        /// The signal.
        what: &'static str,
    },
    /// A condition (an impact, a crossing) is never met within the signal.
    #[error("{what}: the signal reaches {reached}, {needed} is needed")]
    NeverReached {
        /// The condition.
        what: &'static str,
        /// The largest value reached.
        reached: f64,
        /// The value needed.
        needed: f64,
    },
}
