//! The instruments: channels of head, neck, chest, pelvis and femurs.

use crash_measures::injury::{Components, Signals};
use nalgebra::Vector3;

use crate::body::Segment;
use crate::model::Model;
use crate::quantity::to_j211;
use crate::results::reaction::Loads;
use crate::results::recorder::{Flow, Recorder, RecorderError};
use crate::results::sample::Sample;

/// What is read at a segment; no numbers where a part of a body lacks it.
fn reading<'a>(
    sample: &Sample<'a>,
    segment: Option<Segment>,
    read: impl Fn(&Sample<'a>, Segment) -> Vector3<f64>,
) -> Vector3<f64> {
    segment.map_or_else(|| Vector3::repeat(f64::NAN), |segment| read(sample, segment))
}

/// Adds a vector of segment axes in J211 axes.
fn push(into: &mut Components, v: Vector3<f64>) {
    for (values, component) in into.iter_mut().zip(&to_j211(v)) {
        values.push(*component);
    }
}

impl Recorder for Signals {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        let outputs = model.output_count();
        self.interval_s = model.setup().time.output_s;
        for values in self.all_mut() {
            values.clear();
            values.reserve(outputs);
        }
        Ok(())
    }

    fn record(&mut self, s: &Sample<'_>) -> Result<Flow, RecorderError> {
        let time = &s.model.setup().time;
        let due_s = time.start_s + s.index as f64 * time.output_s;
        if (s.time_s - due_s).abs() > 1e-6 * time.output_s {
            return Ok(Flow::Continue);
        }
        if self.is_empty() {
            self.start_s = s.time_s;
        }
        let marks = s.landmarks();
        push(&mut self.head_m_s2, reading(s, marks.head, Sample::specific_force_m_s2));
        push(&mut self.chest_m_s2, reading(s, marks.chest, Sample::specific_force_m_s2));
        push(&mut self.pelvis_m_s2, reading(s, marks.pelvis, Sample::specific_force_m_s2));
        push(&mut self.head_rad_s, reading(s, marks.head, Sample::angular_velocity_rad_s));
        push(&mut self.head_rad_s2, reading(s, marks.head, Sample::angular_acceleration_rad_s2));
        let loads = Loads::new(s);
        let neck = loads.upper_neck();
        push(&mut self.neck_n, neck.force_n);
        push(&mut self.neck_n_m, neck.moment_n_m);
        for (values, leg) in self.femur_n.iter_mut().zip([marks.legs.right, marks.legs.left]) {
            values.push(leg.map_or(f64::NAN, |leg| loads.femur_axial_n(leg.upper)));
        }
        Ok(Flow::Continue)
    }
}
