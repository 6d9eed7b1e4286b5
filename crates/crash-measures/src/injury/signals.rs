//! The channels of a dummy that measures are made of.

use std::collections::BTreeMap;

use super::special::Special;
use crate::measure::Peak;

/// Three components over time.
pub type Components = [Vec<f64>; 3];

/// Peaks of unfiltered signals known more accurately than from samples, in the order of [`Extreme`]; −∞ for missing
/// ones. Times are those of the run.
pub type Extremes = [Peak; 10];

/// Signal of a peak.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extreme {
    /// Resultant acceleration of the head.
    Head,
    /// Of the chest.
    Chest,
    /// Of the pelvis.
    Pelvis,
    /// Tension of the neck.
    Tension,
    /// Its compression.
    Compression,
    /// Its shear.
    Shear,
    /// Flexion moment of the neck.
    Flexion,
    /// Extension moment.
    Extension,
    /// Compression of the right femur.
    RightFemur,
    /// Of the left one.
    LeftFemur,
}

/// The person whose chest is recorded, if it is no dummy's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Person {
    /// Depth of the chest, m.
    pub chest_depth_m: f64,
    /// Age, years, if it is known.
    pub age_years: Option<f64>,
}

/// Whose ribs yield to the side, in a simulated body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ribs {
    /// A dummy's: its limits apply.
    Dummy,
    /// A person's, with half of the breadth of the chest, m: no limit of a dummy applies.
    Person {
        /// Reference of the viscous criterion, m.
        half_breadth_m: f64,
    },
}

/// Time histories at regular intervals, in SAE J211 axes of the segments (X forward, Y right, Z down), SI.
///
/// A last output before its regular time is left out: the measures need equal intervals.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Signals {
    /// Time of the first sample, s.
    pub start_s: f64,
    /// Interval, s.
    pub interval_s: f64,
    /// Accelerometer reading at the head's centre of gravity, m/s².
    pub head_m_s2: Components,
    /// Accelerometer reading of the upper torso, m/s².
    pub chest_m_s2: Components,
    /// Accelerometer reading of the lower torso, m/s².
    pub pelvis_m_s2: Components,
    /// Resultants of these three, m/s², where not all their components were recorded.
    pub resultants: [Option<Vec<f64>>; 3],
    /// Angular velocity of the head, rad/s.
    pub head_rad_s: Components,
    /// Angular acceleration of the head, rad/s².
    pub head_rad_s2: Components,
    /// Force of the neck on the head, N: +z tension.
    pub neck_n: Components,
    /// Moment of the neck on the head, N·m: +y flexion.
    pub neck_n_m: Components,
    /// Axial force of the right and the left femur, N: tension positive.
    pub femur_n: [Vec<f64>; 2],
    /// Signals of some bodies and tests only, as long as the others. A body with such an instrument has an entry, even
    /// without samples: its measures are then listed.
    pub special: BTreeMap<Special, Vec<f64>>,
    /// The person whose chest it is; none for the dummy of the limits.
    pub person: Option<Person>,
    /// Whose ribs yield to the side, in a simulated body; none for a test.
    pub sides: Option<Ribs>,
    /// Largest values between the samples, if they are known.
    pub peaks: Option<Extremes>,
}

impl Signals {
    /// Signals without samples.
    pub fn new() -> Self {
        Signals::default()
    }

    /// Number of samples.
    pub fn len(&self) -> usize {
        self.femur_n[0].len()
    }

    /// Whether there are no samples.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Every other sample, from `first`.
    pub(super) fn every_other(&self, first: usize) -> Signals {
        let mut half = self.clone();
        half.interval_s *= 2.0;
        let thin = |values: &mut Vec<f64>| {
            let count = values.len().saturating_sub(first).div_ceil(2);
            (0..count).for_each(|i| values[i] = values[first + 2 * i]);
            values.truncate(count);
        };
        half.special.values_mut().for_each(thin);
        half.resultants.iter_mut().flatten().for_each(thin);
        half.all_mut().for_each(thin);
        half
    }

    /// Every channel that all bodies have.
    pub fn all_mut(&mut self) -> impl Iterator<Item = &mut Vec<f64>> {
        [
            &mut self.head_m_s2,
            &mut self.chest_m_s2,
            &mut self.pelvis_m_s2,
            &mut self.head_rad_s,
            &mut self.head_rad_s2,
            &mut self.neck_n,
            &mut self.neck_n_m,
        ]
        .into_iter()
        .flatten()
        .chain(&mut self.femur_n)
    }
}
