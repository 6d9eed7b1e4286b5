//! What the instruments read, filtered as asked: the signals that measures are made of, and the levels of the resultant
//! accelerations.

use std::collections::BTreeMap;

use super::definition::{Definition, Lack};
use super::signals::{Components, Extreme, Extremes, Person, Ribs, Signals};
use super::special::Special;
use super::{Filtering, Measure, Options, measures, parts, rear};
use crate::measure::{Peak, ThreeMs, maximum, three_ms_both};
use crate::signal::ChannelClass::{self, Cfc60, Cfc180, Cfc600, Cfc1000};
use crate::signal::{SignalError, filter_cfc, resultant};

/// The lists of measures, from head to legs.
const LISTS: [&[Definition]; 7] = [
    measures::HEAD_AND_NECK,
    rear::WHIPLASH,
    measures::CHEST,
    parts::CHEST_PARTS,
    parts::SIDE,
    measures::PELVIS_AND_FEMURS,
    parts::LEGS,
];

/// The readings of one run.
#[derive(Clone, Debug)]
pub struct Readings {
    pub(super) options: Options,
    pub(super) start_s: f64,
    pub(super) interval_s: f64,
    /// Head, CFC 1000.
    pub head: Acceleration,
    /// Chest, CFC 180.
    pub chest: Acceleration,
    /// Pelvis, CFC 1000.
    pub pelvis: Acceleration,
    pub(super) head_rad_s: Result<Components, SignalError>,
    pub(super) head_rad_s2: Result<Components, SignalError>,
    pub(super) neck_n: Result<Components, SignalError>,
    pub(super) neck_n_m: Result<Components, SignalError>,
    /// Compression of the right and the left femur.
    pub(super) femur_n: [Result<Vec<f64>, SignalError>; 2],
    /// Forward reading of the head, CFC 60, and shear of the neck, CFC 600, as used by whiplash criteria.
    pub(super) head_ahead_m_s2: Result<Vec<f64>, SignalError>,
    pub(super) neck_shear_n: Result<Vec<f64>, SignalError>,
    special: BTreeMap<Special, Result<Vec<f64>, SignalError>>,
    pub(super) person: Option<Person>,
    pub(super) sides: Option<Ribs>,
    /// Peaks known more accurately than from samples; times are relative to the first sample.
    peaks: Option<Extremes>,
}

/// A resultant acceleration and its levels.
#[derive(Clone, Debug)]
pub struct Acceleration {
    pub(super) resultant_m_s2: Result<Vec<f64>, SignalError>,
    /// Largest value; its time is relative to the first sample.
    pub peak: Result<Peak, SignalError>,
    /// Level held for 3 ms without interruption.
    pub three_ms_contiguous: Result<ThreeMs, SignalError>,
    /// Level exceeded for 3 ms in total.
    pub three_ms_cumulative: Result<ThreeMs, SignalError>,
}

impl Readings {
    /// Filters the signals and computes the levels.
    pub fn new(signals: &Signals, options: &Options) -> Self {
        let dt_s = signals.interval_s;
        let one = |values: &[f64], class| filtered(values, dt_s, class, options.filtering);
        let all = |[x, y, z]: &Components, class| Ok([one(x, class)?, one(y, class)?, one(z, class)?]);
        let known = signals.peaks.filter(|_| options.filtering == Filtering::None);
        let peaks = known.map(|peaks| peaks.map(|peak| Peak { time_s: peak.time_s - signals.start_s, ..peak }));
        let acceleration = |components, class, which: Extreme| {
            let resultant = match &signals.resultants[which as usize] {
                Some(alone) => one(alone, class),
                None => all(components, class).and_then(|[x, y, z]| resultant(&x, &y, &z)),
            };
            let mut acceleration = Acceleration::new(resultant, dt_s);
            if let Some(peak) = peak_of(&peaks, which) {
                acceleration.peak = Ok(peak);
            }
            acceleration
        };
        let compression = |tension: &Vec<f64>| one(&tension.iter().map(|f| -f).collect::<Vec<_>>(), Cfc600);
        Readings {
            options: *options,
            start_s: signals.start_s,
            interval_s: dt_s,
            head: acceleration(&signals.head_m_s2, Cfc1000, Extreme::Head),
            chest: acceleration(&signals.chest_m_s2, Cfc180, Extreme::Chest),
            pelvis: acceleration(&signals.pelvis_m_s2, Cfc1000, Extreme::Pelvis),
            head_rad_s: all(&signals.head_rad_s, Cfc60),
            head_rad_s2: all(&signals.head_rad_s2, Cfc60),
            neck_n: all(&signals.neck_n, Cfc1000),
            neck_n_m: all(&signals.neck_n_m, Cfc600),
            femur_n: signals.femur_n.each_ref().map(compression),
            head_ahead_m_s2: one(&signals.head_m_s2[0], Cfc60),
            neck_shear_n: one(&signals.neck_n[0], Cfc600),
            special: signals.special.iter().map(|(which, values)| (*which, one(values, which.class()))).collect(),
            person: signals.person,
            sides: signals.sides,
            peaks,
        }
    }

    /// A signal recorded by some bodies only.
    pub(super) fn special(&self, which: Special) -> Result<Vec<f64>, Lack> {
        Ok(self.special.get(&which).ok_or(Lack::Absent)?.clone()?)
    }

    /// Whether it is recorded.
    pub(super) fn has(&self, which: Special) -> bool {
        self.special.contains_key(&which)
    }

    /// A peak known more accurately than from samples.
    pub(super) fn peak_of(&self, which: Extreme) -> Option<Peak> {
        peak_of(&self.peaks, which)
    }

    /// All measures, in the order of a dummy from head to legs. The list has the same names for every run of a body.
    pub fn measures(&self) -> Vec<Measure> {
        LISTS.iter().flat_map(|list| *list).filter_map(|definition| definition.of(self)).collect()
    }
}

/// The limit by which changes of a measure are weighed where no limit applies to the body; none without.
pub(super) fn weight(name: &str) -> Option<f64> {
    LISTS.iter().flat_map(|list| *list).find_map(|definition| definition.weight(name))
}

fn peak_of(peaks: &Option<Extremes>, which: Extreme) -> Option<Peak> {
    peaks.map(|peaks| peaks[which as usize]).filter(|peak| peak.value.is_finite())
}

impl Acceleration {
    fn new(resultant_m_s2: Result<Vec<f64>, SignalError>, dt_s: f64) -> Self {
        let signal = resultant_m_s2.as_ref().map_err(Clone::clone);
        let levels = signal.clone().and_then(|a| three_ms_both(a, dt_s));
        Acceleration {
            peak: signal.and_then(|a| maximum(a, dt_s)),
            three_ms_contiguous: levels.clone().map(|[level, _]| level),
            three_ms_cumulative: levels.map(|[_, level]| level),
            resultant_m_s2,
        }
    }
}

/// A channel that was not recorded stays without values, so that those beside it can be used.
fn filtered(values: &[f64], dt_s: f64, class: ChannelClass, filtering: Filtering) -> Result<Vec<f64>, SignalError> {
    match filtering {
        _ if values.iter().all(|value| value.is_nan()) => Ok(values.to_vec()),
        Filtering::None => Ok(values.to_vec()),
        Filtering::Classes(family) => filter_cfc(values, dt_s, class, family),
    }
}
