//! What can be wrong with a vehicle path.

/// One thing that is wrong with a vehicle path, with what was found and what was expected.
///
/// Stations (and points of a tabulated pulse) are counted from 0 in the fields and from 1 in the message.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PathProblem {
    /// A table or a tabulated pulse needs two stations.
    #[error("found {found} stations, expected at least 2")]
    TooFewStations {
        /// How many there are.
        found: usize,
    },
    /// A station is not later than the one before it.
    #[error("station {}: found t = {time_s} s, expected a time after that of the station before ({previous_s} s)", station + 1)]
    TimeNotIncreasing {
        /// The later one of the two stations.
        station: usize,
        /// Its time, s.
        time_s: f64,
        /// The time of the station before it, s.
        previous_s: f64,
    },
    /// A number at a station is infinite or not a number.
    #[error("station {}: found {quantity} = {value}, expected a finite number", station + 1)]
    StationNotFinite {
        /// The station.
        station: usize,
        /// Which of its quantities.
        quantity: &'static str,
        /// What was found.
        value: f64,
    },
    /// A number at a station is greater than any of a vehicle.
    #[error("station {}: found {quantity} = {value}, expected at most {largest:e}", station + 1)]
    StationTooLarge {
        /// The station.
        station: usize,
        /// Which of its quantities.
        quantity: &'static str,
        /// What was found.
        value: f64,
        /// The largest magnitude.
        largest: f64,
    },
    /// An angle changes by more than half a turn from one station to the next.
    #[error(
        "station {}: {angle} goes from {:.3}° to {:.3}°, expected less than half a turn between stations; unwrap the angles (add \
         or take whole turns) or give more stations",
        station + 1, from_rad.to_degrees(), to_rad.to_degrees()
    )]
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
    #[error(
        "station {}: {quantity} changes too much since the station before for its rate to be a number, expected stations farther \
         apart in time",
        station + 1
    )]
    TooSteep {
        /// The later one of the two stations.
        station: usize,
        /// Which quantity.
        quantity: &'static str,
    },
    /// A number is infinite or not a number.
    #[error("found {quantity} = {value}, expected a finite number")]
    NotFinite {
        /// Which quantity.
        quantity: &'static str,
        /// What was found.
        value: f64,
    },
    /// A number that must be above zero is not.
    #[error("found {quantity} = {value}, expected more than 0")]
    NotPositive {
        /// Which quantity.
        quantity: &'static str,
        /// What was found, SI.
        value: f64,
    },
    /// A number that must be zero or above is not.
    #[error("found {quantity} = {value}, expected 0 or more")]
    Negative {
        /// Which quantity.
        quantity: &'static str,
        /// What was found, SI.
        value: f64,
    },
    /// The direction of travel is the zero vector.
    #[error("the direction of travel is zero, expected a vector with a length")]
    NoDirection,
    /// The peak of a triangle lies outside its duration.
    #[error("found a peak at the fraction {value} of the pulse, expected 0 to 1")]
    PeakFractionOutside {
        /// What was found; expected between 0 and 1.
        value: f64,
    },
    /// A pulse begins before t = 0, where its initial speed and position hold.
    #[error("the pulse begins at {begin_s} s, expected 0 s or later: the initial speed and position are those at 0 s")]
    PulseBeforeZero {
        /// When it begins, s.
        begin_s: f64,
    },
    /// The pulse decelerates nothing: its peak, or its change of velocity, is zero.
    #[error("the pulse is zero throughout, expected a deceleration somewhere")]
    PulseIsZero,
    /// A vehicle that starts at rest is stopped by the pulse before the pulse has set it going.
    #[error(
        "the initial speed is 0 and the pulse decelerates before it has set the vehicle going, so that the vehicle stands still \
         from {stop_s} s on; give an initial speed, or a negative deceleration for a vehicle that is accelerated, or a rebound \
         for one that may move back"
    )]
    PulseHoldsBack {
        /// When it is stopped for good, s.
        stop_s: f64,
    },
    /// A record has none of the channels that move a vehicle.
    #[error("found no channel that moves the vehicle, expected accelerations, rates or velocity changes")]
    NoSensorChannel,
    /// A channel of a record is longer or shorter than its times.
    #[error("found {found} samples of {quantity}, expected {expected}, one for each time")]
    ChannelLength {
        /// Which channel.
        quantity: &'static str,
        /// Its length.
        found: usize,
        /// How many times there are.
        expected: usize,
    },
    /// The vehicle turns so far from one sample to the next that they say little of the turning.
    #[error(
        "station {}: the vehicle turns by {:.1}° since the sample before, expected at most 90°; give rates in their true unit, \
         or more samples",
        station + 1, turn_rad.to_degrees()
    )]
    TurnsTooFar {
        /// The later one of the two samples.
        station: usize,
        /// How far, rad.
        turn_rad: f64,
    },
    /// A record that is to be filtered is not evenly sampled.
    #[error(
        "station {}: found t = {time_s} s, expected {expected_s} s, for a filter needs samples evenly spaced in time; resample \
         the record, or leave `filter` out",
        station + 1
    )]
    NotUniform {
        /// The first sample off the grid.
        station: usize,
        /// Its time, s.
        time_s: f64,
        /// The time that an even grid has there, s.
        expected_s: f64,
    },
    /// A record is sampled too coarsely for the filter.
    #[error(
        "the filter's corner is {corner_hz:.1} Hz, expected less than half the sample rate, {nyquist_hz:.1} Hz; use a lower class \
         or a record with more samples a second, or leave `filter` out"
    )]
    FilterTooFast {
        /// Corner of one pass of the filter, Hz.
        corner_hz: f64,
        /// Half the sample rate, Hz.
        nyquist_hz: f64,
    },
    /// A path from a record starts outside of it.
    #[error("the path starts at {start_s} s, expected a time of the record, from {first_s} s to before {last_s} s")]
    StartOutsideRecord {
        /// Where it starts, s.
        start_s: f64,
        /// First sample, s.
        first_s: f64,
        /// Last sample, s.
        last_s: f64,
    },
    /// The rest at the beginning of a record has too few samples, or is all of it.
    #[error("the baseline of {baseline_s} s has {samples} samples, expected at least 2, and fewer than the record has")]
    BaselineOutsideRecord {
        /// Its length, s.
        baseline_s: f64,
        /// How many samples are in it.
        samples: usize,
    },
    /// A run starts before the first station.
    #[error("the run starts at {start_s} s, expected at or after the first station at {first_s} s")]
    StartsBeforePath {
        /// Start of the run, s.
        start_s: f64,
        /// First station, s.
        first_s: f64,
    },
    /// A run ends past the last station, and the path says nothing of what comes after.
    #[error(
        "the run ends at {end_s} s, expected at or before the last station at {last_s} s; shorten the run, or say what the \
         vehicle does after the last station: after = \"coast\" or \"hold\""
    )]
    EndsAfterPath {
        /// End of the run, s.
        end_s: f64,
        /// Last station, s.
        last_s: f64,
    },
    /// The run leaves the times for which a program's own path has an answer.
    #[error(
        "the run lasts from {start_s} s to {end_s} s, expected times from {first_s} s to {last_s} s, for which the program's own \
         path has an answer"
    )]
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
    #[error("the program's own path has numbers that are not finite at {time_s} s, expected finite numbers")]
    OwnPathNotFinite {
        /// When, s.
        time_s: f64,
    },
}

/// Adds a problem to `problems` unless `value` is finite.
pub(super) fn expect_finite(problems: &mut Vec<PathProblem>, quantity: &'static str, value: f64) {
    if !value.is_finite() {
        problems.push(PathProblem::NotFinite { quantity, value });
    }
}

/// Adds what is wrong with row `station` of numbers over time: those that are not finite or beyond `largest` in magnitude, and a
/// time that is not after that of the row before.
pub(super) fn check_row(
    problems: &mut Vec<PathProblem>,
    station: usize,
    time_s: f64,
    previous_s: Option<f64>,
    numbers: impl IntoIterator<Item = (&'static str, f64)>,
    largest: f64,
) {
    let all = std::iter::once(("t", time_s)).chain(numbers);
    problems.extend(all.filter_map(|(quantity, value)| match value {
        _ if !value.is_finite() => Some(PathProblem::StationNotFinite { station, quantity, value }),
        _ if value.abs() > largest => Some(PathProblem::StationTooLarge { station, quantity, value, largest }),
        _ => None,
    }));
    if let Some(previous_s) = previous_s.filter(|previous_s| time_s <= *previous_s) {
        problems.push(PathProblem::TimeNotIncreasing { station, time_s, previous_s });
    }
}
