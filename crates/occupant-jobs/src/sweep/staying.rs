//! How many samples the constraints of a study leave.

use std::ops::Range;

use occupant_study::Study;
use occupant_study::engine::Engine;
use rayon::prelude::*;

/// Number of samples up to which all are judged; of more as many, evenly spread.
const JUDGED: u64 = 200_000;

/// Samples of a range that are to be run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Staying {
    /// Number of samples.
    pub samples: u64,
    /// Those that were judged.
    judged: u64,
    /// Those of them that stay.
    kept: u64,
}

impl Staying {
    /// All of so many samples.
    pub fn all(samples: u64) -> Staying {
        Staying { samples, judged: samples, kept: samples }
    }

    /// Of these samples of a study.
    pub fn of(study: &Study, samples: &Range<u64>, engine: &Engine) -> Staying {
        let count = samples.end.saturating_sub(samples.start);
        if study.relations.is_empty() {
            return Staying::all(count);
        }
        let judged = count.min(JUDGED);
        let place = |i: u64| samples.start + (u128::from(i) * u128::from(count) / u128::from(judged.max(1))) as u64;
        let is_kept = |i: &u64| study.excluded(place(*i)).is_none();
        let kept = engine.share(|| (0..judged).into_par_iter().filter(is_kept).count());
        Staying { samples: count, judged, kept: kept as u64 }
    }

    /// Number of samples that stay; an estimate of many.
    pub fn kept(&self) -> f64 {
        self.samples as f64 * self.kept as f64 / self.judged.max(1) as f64
    }

    /// In words.
    pub fn words(&self) -> String {
        let percent = 100.0 * self.kept as f64 / self.judged.max(1) as f64;
        let about = if self.judged < self.samples { "about " } else { "" };
        let excluded = self.samples as f64 - self.kept();
        format!("{about}{:.0} samples stay ({percent:.1} %), {about}{excluded:.0} break a constraint", self.kept())
    }
}
