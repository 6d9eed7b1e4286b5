//! The state at the last output of the file, which cards of series 6 and 14 would carry. Results do not hold the pair
//! states, so the run is repeated up to there and compared with what was recorded.

use cardio_legacy::spine_rest;
use occupant_core::body::Segment;
use occupant_core::recorder::{Flow, Recorder, RecorderError};
use occupant_core::report_coordinates::ReportCoordinates;
use occupant_core::sample::Sample;
use occupant_core::simulate::simulate;

use super::case::Case;
use crate::mcap::groups::SEGMENT;
use crate::mcap::topics;

/// The state at the last output.
#[derive(Clone, Debug)]
pub struct LastState {
    /// q and their rates.
    pub coordinates: ReportCoordinates,
    /// β₀ of the upper and the lower back joint, rad.
    pub spine_rest_rad: [f64; 2],
    /// Pairs with NARRY = 0, by index.
    pub passed: Vec<(usize, usize)>,
    /// Greatest distance of a segment's end from where it was recorded, m.
    pub difference_m: f64,
}

impl LastState {
    /// Repeats the run up to output `last`.
    ///
    /// # Errors
    /// The run does not get there; the recorded state cannot be read.
    pub fn repeated(case: &Case, last: usize) -> Result<Self, String> {
        let mut watch = Repeat {
            case,
            last,
            rest: None,
            found: None,
        };
        let outcome = simulate(&case.model, &mut watch).map_err(|error| error.to_string())?;
        watch.found.ok_or_else(|| {
            format!(
                "repeated, the run ended at {:.6} s ({:?})",
                outcome.time_s, outcome.status
            )
        })
    }
}

struct Repeat<'a> {
    case: &'a Case,
    last: usize,
    rest: Option<[f64; 2]>,
    found: Option<LastState>,
}

impl Recorder for Repeat<'_> {
    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        let rest = *self.rest.get_or_insert_with(|| spine_rest(sample));
        if sample.index < self.last {
            return Ok(Flow::Continue);
        }
        self.found = Some(LastState {
            coordinates: sample.report_coordinates(),
            spine_rest_rad: rest,
            passed: self.case.passed(&sample.history.pairs),
            difference_m: difference_m(self.case, sample)?,
        });
        Ok(Flow::Stop)
    }
}

/// Greatest distance between a segment's ends and the recorded ones, m; not a number where one of them is none.
fn difference_m(case: &Case, sample: &Sample<'_>) -> Result<f64, String> {
    let mut greatest: f64 = 0.0;
    for segment in Segment::ALL {
        let message = case.message(&topics::segment(segment), &SEGMENT, sample.index)?;
        let ends = sample.end_points_m(segment);
        for (name, end) in ["upper_end_vehicle_m", "lower_end_vehicle_m"]
            .iter()
            .zip(ends)
        {
            let recorded = nalgebra::Vector3::from(message.components(name));
            let distance = (end.coords - recorded).norm();
            if distance.is_nan() {
                return Ok(distance);
            }
            greatest = greatest.max(distance);
        }
    }
    Ok(greatest)
}
