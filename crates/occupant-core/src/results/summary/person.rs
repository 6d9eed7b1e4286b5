//! What is seen of the instruments of one body in a run.

use nalgebra::Point3;

use super::{Acceleration, Accelerations, Excursion, Level, Peak, Person};
use crate::model::Model;
use crate::model::setup::STANDARD_GRAVITY_M_S2;
use crate::results::recorder::{Recorder, RecorderError};
use crate::results::sample::Sample;
use crash_measures::injury::{self, Options, Readings, Signals};
use crash_measures::measure::ThreeMs;

/// What is seen of the instruments of a body.
#[derive(Clone, Debug, Default)]
pub(super) struct Watched {
    /// Its place among the bodies.
    of: usize,
    pub(super) name: &'static str,
    pub(super) mass_kg: f64,
    head: Option<usize>,
    /// Of head, chest and pelvis.
    pub(super) accelerations: [Option<Peak>; 3],
    pub(super) signals: Signals,
    head_start: Option<Point3<f64>>,
    /// Of the head.
    excursion: Option<Excursion>,
}

impl Watched {
    /// The bodies of a model that have anything to tell; at least the first.
    pub(super) fn all(model: &Model) -> Result<Vec<Watched>, RecorderError> {
        let body = model.body();
        let mut all = Vec::new();
        for (of, row) in body.tree.bodies().into_iter().enumerate() {
            let marks = &row.landmarks;
            if of > 0 && marks.head.or(marks.chest).or(marks.pelvis).is_none() {
                continue;
            }
            let head = if row.name.is_empty() { "head".to_owned() } else { format!("{}.head", row.name) };
            let own = body.tree.segments().filter(|segment| body.tree.body_of(*segment) == of);
            all.push(Watched {
                of,
                name: row.name,
                mass_kg: own.map(|segment| body.segment(segment).mass_kg).sum(),
                head: body.sphere(&head),
                signals: begun(model)?,
                ..Watched::default()
            });
        }
        Ok(all)
    }

    pub(super) fn see(&mut self, sample: &Sample<'_>) -> Result<(), RecorderError> {
        let sample = &sample.of_body(self.of);
        let marks = sample.landmarks();
        for (peak, segment) in self.accelerations.iter_mut().zip(marks.instruments()) {
            if let Some(segment) = segment {
                peak.get_or_insert(Peak::NONE).see(sample.specific_force_m_s2(segment).norm(), sample.time_s);
            }
        }
        self.see_head(sample);
        self.signals.record(sample).map(|_| ())
    }

    fn see_head(&mut self, sample: &Sample<'_>) {
        let Some(head) = self.head else {
            return;
        };
        let place = sample.sphere_centre_m(head);
        let moved = place - *self.head_start.get_or_insert(place);
        let Excursion { forward, rearward, left, right, up, down } = self.excursion.get_or_insert(Excursion::NONE);
        let axes = [[forward, rearward], [right, left], [down, up]];
        for ([along, against], moved) in axes.into_iter().zip([moved.x, moved.y, moved.z]) {
            along.see(moved, sample.time_s);
            against.see(-moved, sample.time_s);
        }
    }

    pub(super) fn person(&self, options: &Options) -> Person {
        let readings = Readings::new(&self.signals, options);
        let parts = [&readings.head, &readings.chest, &readings.pelvis];
        let [head, chest, pelvis] = std::array::from_fn(|i| self.acceleration(i, parts[i]));
        let accelerations = Accelerations { head, chest, pelvis };
        Person { accelerations, head_excursion: self.excursion, measures: readings.measures() }
    }

    fn acceleration(&self, i: usize, levels: &injury::Acceleration) -> Acceleration {
        // no numbers of what a part of a body lacks
        let peak = self.accelerations[i].unwrap_or(Peak { value: f64::NAN, time_s: f64::NAN });
        let level = |held: &ThreeMs| Level {
            level_m_s2: held.level_mps2,
            level_g: in_g(held.level_mps2),
            from_s: self.signals.start_s + held.start_s,
            to_s: self.signals.start_s + held.end_s,
        };
        Acceleration {
            peak_m_s2: peak.value,
            peak_g: in_g(peak.value),
            peak_time_s: peak.time_s,
            three_ms_contiguous: levels.three_ms_contiguous.as_ref().ok().map(level),
            three_ms_cumulative: levels.three_ms_cumulative.as_ref().ok().map(level),
        }
    }
}

/// Instruments with room for a whole run.
fn begun(model: &Model) -> Result<Signals, RecorderError> {
    let mut signals = Signals::new();
    signals.begin(model)?;
    Ok(signals)
}

fn in_g(acceleration_m_s2: f64) -> f64 {
    acceleration_m_s2 / STANDARD_GRAVITY_M_S2
}
