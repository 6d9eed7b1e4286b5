//! What can be wrong with a vehicle path.

use std::error::Error;
use std::fmt;

/// One thing that is wrong with a vehicle path, with what was found and what was expected.
///
/// Stations (and points of a tabulated pulse) are counted from 0 in the fields and from 1 in the message.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PathProblem {
    /// A table or a tabulated pulse needs two stations.
    TooFewStations {
        /// How many there are.
        found: usize,
    },
    /// A station is not later than the one before it.
    TimeNotIncreasing {
        /// The later one of the two stations.
        station: usize,
        /// Its time, s.
        time_s: f64,
        /// The time of the station before it, s.
        previous_s: f64,
    },
    /// A number at a station is infinite or not a number.
    StationNotFinite {
        /// The station.
        station: usize,
        /// Which of its quantities.
        quantity: &'static str,
        /// What was found.
        value: f64,
    },
    /// An angle changes by more than half a turn from one station to the next.
    AngleJump {
        /// The later one of the two stations.
        station: usize,
        /// Which angle.
        angle: &'static str,
        /// The angle at the station before, rad.
        from_rad: f64,
        /// The angle at the station, rad.
        to_rad: f64,
    },
    /// A quantity changes so much in so short a time that its rate is no number.
    TooSteep {
        /// The later one of the two stations.
        station: usize,
        /// Which quantity.
        quantity: &'static str,
    },
    /// A number is infinite or not a number.
    NotFinite {
        /// Which quantity.
        quantity: &'static str,
        /// What was found.
        value: f64,
    },
    /// A number that must be above zero is not.
    NotPositive {
        /// Which quantity.
        quantity: &'static str,
        /// What was found, SI.
        value: f64,
    },
    /// A number that must be zero or above is not.
    Negative {
        /// Which quantity.
        quantity: &'static str,
        /// What was found, SI.
        value: f64,
    },
    /// The direction of travel is the zero vector.
    NoDirection,
    /// The peak of a triangle lies outside its duration.
    PeakFractionOutside {
        /// What was found; expected between 0 and 1.
        value: f64,
    },
    /// A pulse begins before t = 0, where its initial speed and position hold.
    PulseBeforeZero {
        /// When it begins, s.
        begin_s: f64,
    },
    /// The pulse decelerates nothing: its peak, or its change of velocity, is zero.
    PulseIsZero,
    /// A vehicle that starts at rest is stopped by the pulse before the pulse has set it going.
    PulseHoldsBack {
        /// When it is stopped for good, s.
        stop_s: f64,
    },
    /// A record has none of the channels that move a vehicle.
    NoSensorChannel,
    /// A channel of a record is longer or shorter than its times.
    ChannelLength {
        /// Which channel.
        quantity: &'static str,
        /// Its length.
        found: usize,
        /// How many times there are.
        expected: usize,
    },
    /// The vehicle turns so far from one sample to the next that they say little of the turning.
    TurnsTooFar {
        /// The later one of the two samples.
        station: usize,
        /// How far, rad.
        turn_rad: f64,
    },
    /// A record that is to be filtered is not evenly sampled.
    NotUniform {
        /// The first sample off the grid.
        station: usize,
        /// Its time, s.
        time_s: f64,
        /// The time that an even grid has there, s.
        expected_s: f64,
    },
    /// A record is sampled too coarsely for the filter.
    FilterTooFast {
        /// Corner of one pass of the filter, Hz.
        corner_hz: f64,
        /// Half the sample rate, Hz.
        nyquist_hz: f64,
    },
    /// A path from a record starts outside of it.
    StartOutsideRecord {
        /// Where it starts, s.
        start_s: f64,
        /// First sample, s.
        first_s: f64,
        /// Last sample, s.
        last_s: f64,
    },
    /// The rest at the beginning of a record has too few samples, or is all of it.
    BaselineOutsideRecord {
        /// Its length, s.
        baseline_s: f64,
        /// How many samples are in it.
        samples: usize,
    },
    /// A run starts before the first station.
    StartsBeforePath {
        /// Start of the run, s.
        start_s: f64,
        /// First station, s.
        first_s: f64,
    },
    /// A run ends past the last station, and the path says nothing of what comes after.
    EndsAfterPath {
        /// End of the run, s.
        end_s: f64,
        /// Last station, s.
        last_s: f64,
    },
    /// The run leaves the times for which a program's own path has an answer.
    OutsideOwnPath {
        /// Start of the run, s.
        start_s: f64,
        /// End of the run, s.
        end_s: f64,
        /// First time of the path, s.
        first_s: f64,
        /// Last time of the path, s.
        last_s: f64,
    },
    /// A program's own path answers with numbers that are not finite.
    OwnPathNotFinite {
        /// When, s.
        time_s: f64,
    },
}

impl fmt::Display for PathProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use PathProblem as P;
        match *self {
            P::TooFewStations { found } => write!(f, "found {found} stations, expected at least 2"),
            P::TimeNotIncreasing { station, time_s, previous_s } => write!(
                f,
                "station {}: found t = {time_s} s, expected a time after that of the station before ({previous_s} s)",
                station + 1
            ),
            P::StationNotFinite { station, quantity, value } => {
                write!(f, "station {}: found {quantity} = {value}, expected a finite number", station + 1)
            }
            P::AngleJump { station, angle, from_rad, to_rad } => write!(
                f,
                "station {}: {angle} goes from {:.3}° to {:.3}°, expected less than half a turn between stations; unwrap \
                 the angles (add or take whole turns) or give more stations",
                station + 1,
                from_rad.to_degrees(),
                to_rad.to_degrees()
            ),
            P::TooSteep { station, quantity } => write!(
                f,
                "station {}: {quantity} changes too much since the station before for its rate to be a number, expected \
                 stations farther apart in time",
                station + 1
            ),
            P::NotFinite { quantity, value } => {
                write!(f, "found {quantity} = {value}, expected a finite number")
            }
            P::NotPositive { quantity, value } => {
                write!(f, "found {quantity} = {value}, expected more than 0")
            }
            P::Negative { quantity, value } => {
                write!(f, "found {quantity} = {value}, expected 0 or more")
            }
            P::NoDirection => write!(f, "the direction of travel is zero, expected a vector with a length"),
            P::PeakFractionOutside { value } => {
                write!(f, "found a peak at the fraction {value} of the pulse, expected 0 to 1")
            }
            P::PulseBeforeZero { begin_s } => write!(
                f,
                "the pulse begins at {begin_s} s, expected 0 s or later: the initial speed and position are those at 0 s"
            ),
            P::PulseIsZero => write!(f, "the pulse is zero throughout, expected a deceleration somewhere"),
            P::PulseHoldsBack { stop_s } => write!(
                f,
                "the initial speed is 0 and the pulse decelerates before it has set the vehicle going, so that the \
                 vehicle stands still from {stop_s} s on; give an initial speed, or a negative deceleration for a \
                 vehicle that is accelerated, or a rebound for one that may move back"
            ),
            P::NoSensorChannel => {
                write!(f, "found no channel that moves the vehicle, expected accelerations, rates or velocity changes")
            }
            P::ChannelLength { quantity, found, expected } => {
                write!(f, "found {found} samples of {quantity}, expected {expected}, one for each time")
            }
            P::TurnsTooFar { station, turn_rad } => write!(
                f,
                "station {}: the vehicle turns by {:.1}° since the sample before, expected at most 90°; give rates in \
                 their true unit, or more samples",
                station + 1,
                turn_rad.to_degrees()
            ),
            P::NotUniform { station, time_s, expected_s } => write!(
                f,
                "station {}: found t = {time_s} s, expected {expected_s} s, for a filter needs samples evenly spaced \
                 in time; resample the record, or leave `filter` out",
                station + 1
            ),
            P::FilterTooFast { corner_hz, nyquist_hz } => write!(
                f,
                "the filter's corner is {corner_hz:.1} Hz, expected less than half the sample rate, {nyquist_hz:.1} Hz; \
                 use a lower class or a record with more samples a second, or leave `filter` out"
            ),
            P::StartOutsideRecord { start_s, first_s, last_s } => write!(
                f,
                "the path starts at {start_s} s, expected a time of the record, from {first_s} s to before {last_s} s"
            ),
            P::BaselineOutsideRecord { baseline_s, samples } => write!(
                f,
                "the baseline of {baseline_s} s has {samples} samples, expected at least 2, and fewer than the record has"
            ),
            P::StartsBeforePath { start_s, first_s } => {
                write!(f, "the run starts at {start_s} s, expected at or after the first station at {first_s} s")
            }
            P::EndsAfterPath { end_s, last_s } => write!(
                f,
                "the run ends at {end_s} s, expected at or before the last station at {last_s} s; shorten the run, or say \
                 what the vehicle does after the last station: after = \"coast\" or \"hold\""
            ),
            P::OutsideOwnPath { start_s, end_s, first_s, last_s } => write!(
                f,
                "the run lasts from {start_s} s to {end_s} s, expected times from {first_s} s to {last_s} s, for which the \
                 program's own path has an answer"
            ),
            P::OwnPathNotFinite { time_s } => {
                write!(
                    f,
                    "the program's own path has numbers that are not finite at {time_s} s, expected finite numbers"
                )
            }
        }
    }
}

impl Error for PathProblem {}

/// Adds a problem to `problems` unless `value` is finite.
pub(super) fn expect_finite(problems: &mut Vec<PathProblem>, quantity: &'static str, value: f64) {
    if !value.is_finite() {
        problems.push(PathProblem::NotFinite { quantity, value });
    }
}
