//! The requested accuracy of a run.

use serde::{Deserialize, Serialize};

use super::setup::Integrator;

/// Accuracy of the integration: largest error of the head's path and of peaks.
///
/// `docs/accuracy.md` lists the errors at each level in all shipped scenarios with varied materials.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "schema", schemars(rename = "AccuracyChoice"))]
pub enum Accuracy {
    /// 1 mm of the head's path and 0.5 % of its peak, for a first look at many variants.
    Survey,
    /// 0.1 mm and 0.1 %.
    #[default]
    Engineering,
    /// A thousandth of that, as a reference for the others.
    Reference,
}

/// Durations of a blow, a crash and a short manoeuvre, s: errors grow with the duration, and the tolerance falls with
/// it.
const UP_TO_S: [f64; 3] = [0.05, 0.35, 1.0];
/// Longest step in a blow or crash, s: longer ones miss short contacts and require more pairs of surfaces to be
/// checked.
const IN_CRASH_S: f64 = 5e-4;
/// Longest step in longer runs, s.
const IN_LONG_S: f64 = 2e-3;

impl Accuracy {
    /// Error control that keeps the accuracy over a run of `span_s` seconds, by the table of `docs/accuracy.md`.
    pub fn integrator(self, span_s: f64) -> Integrator {
        let (by_length, min_step_s) = match self {
            Accuracy::Survey => ([2e-6, 2e-5, 3e-6, 3e-7], 1e-10),
            Accuracy::Engineering => ([1e-7, 1e-6, 1e-7, 3e-8], 1e-10),
            Accuracy::Reference => ([1e-11; 4], 1e-12),
        };
        let class = UP_TO_S.iter().filter(|most_s| span_s > **most_s).count();
        let relative = by_length[class];
        Integrator::Adaptive {
            relative,
            absolute_m: 0.1 * relative,
            absolute_m_s: 10.0 * relative,
            min_step_s,
            max_step_s: if class < 2 { IN_CRASH_S } else { IN_LONG_S },
        }
    }
}
