//! Intervals of the measures due to sensor errors.

use std::collections::BTreeMap;

use crash_measures::signal::STANDARD_GRAVITY_MPS2;
use occupant_study::risk::{Flight, SensorErrors, VehicleRisk, VehicleSignals};
use occupant_study::spread::quantile;
use rayon::prelude::*;

use super::Figures;

/// Number of records with random errors.
const MEMBERS: u64 = 400;
/// Ends of the interval.
const ENDS: [f64; 2] = [0.025, 0.975];

/// 95 % intervals of each measure.
#[derive(Clone, Debug)]
pub struct Intervals {
    errors: SensorErrors,
    ends: BTreeMap<String, [f64; 2]>,
}

impl Intervals {
    /// Intervals by Monte Carlo, the same for any number of threads.
    pub fn of(signals: &VehicleSignals, flight: &Flight, errors: SensorErrors) -> Self {
        let member = |member: u64| -> Vec<(String, f64)> {
            let signals = errors.member(signals, member);
            let figures = Figures::of_risk(&VehicleRisk::of(&signals, flight), &signals).figures;
            figures.into_iter().map(|figure| (figure.key, figure.value)).collect()
        };
        let members: Vec<_> = (1..=MEMBERS).into_par_iter().map(member).collect();
        let mut values: BTreeMap<String, Vec<f64>> = BTreeMap::new();
        for (key, value) in members.into_iter().flatten() {
            values.entry(key).or_default().push(value);
        }
        // a measure that some members lack has no interval
        values.retain(|_, values| values.len() as u64 == MEMBERS);
        let ends = |values: &[f64]| ENDS.map(|part| quantile(values, part).unwrap_or(f64::NAN));
        let ends = values.iter().map(|(key, values)| (key.clone(), ends(values))).collect();
        Intervals { errors, ends }
    }

    /// The interval of a measure by its key, SI.
    pub fn of_key(&self, key: &str) -> Option<[f64; 2]> {
        self.ends.get(key).copied()
    }

    /// Description of the method.
    pub fn words(&self) -> String {
        let SensorErrors { gain, offset_m_s2, rate_rad_s, angle_rad, place_m } = self.errors;
        let bounds = [
            (gain, format!("gain {} %", 100.0 * gain)),
            (offset_m_s2, format!("acceleration offset {:.4} g", offset_m_s2 / STANDARD_GRAVITY_MPS2)),
            (rate_rad_s, format!("rate offset {:.3} deg/s", rate_rad_s.to_degrees())),
            (angle_rad, format!("mounting {:.3} deg", angle_rad.to_degrees())),
            (place_m, format!("place {} mm", 1e3 * place_m)),
        ];
        let told: Vec<String> = bounds.into_iter().filter(|(bound, _)| *bound > 0.0).map(|(_, words)| words).collect();
        format!(
            "95 % interval of {MEMBERS} records (Monte Carlo), with sensor errors drawn uniformly within ±: {}",
            told.join(", ")
        )
    }
}
