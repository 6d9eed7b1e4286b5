//! The instruments: channels of head, neck, chest, pelvis and femurs.

use crash_measures::injury::{Components, Signals};
use nalgebra::Vector3;

use crate::model::Model;
use crate::quantity::to_j211;
use crate::results::reaction::Loads;
use crate::results::recorder::{Flow, Recorder, RecorderError};
use crate::results::sample::Sample;

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
        let marks = s.model.body().tree.landmarks();
        push(&mut self.head_m_s2, s.specific_force_m_s2(marks.head));
        push(&mut self.chest_m_s2, s.specific_force_m_s2(marks.chest));
        push(&mut self.pelvis_m_s2, s.specific_force_m_s2(marks.pelvis));
        push(&mut self.head_rad_s, s.angular_velocity_rad_s(marks.head));
        push(&mut self.head_rad_s2, s.angular_acceleration_rad_s2(marks.head));
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
