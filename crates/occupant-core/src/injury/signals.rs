//! The instruments: channels of head, neck, chest, pelvis and femurs.

use nalgebra::Vector3;

use crate::body::Segment;
use crate::joint::Joint;
use crate::model::Model;
use crate::reaction::{femur_axial_n, reaction};
use crate::recorder::{Flow, Recorder, RecorderError};
use crate::sample::Sample;
use crate::simulate::output_count;

/// Three components over time.
pub type Components = [Vec<f64>; 3];

/// Time histories at regular outputs, in SAE J211 axes of the segments (X ahead, Y right, Z down), SI.
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
    /// That of the upper torso, m/s².
    pub chest_m_s2: Components,
    /// That of the lower torso, m/s².
    pub pelvis_m_s2: Components,
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
}

impl Signals {
    /// Nothing seen yet.
    pub fn new() -> Self {
        Signals::default()
    }

    /// Number of samples.
    pub fn len(&self) -> usize {
        self.femur_n[0].len()
    }

    /// Whether nothing was seen.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    fn all(&mut self) -> impl Iterator<Item = &mut Vec<f64>> {
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

/// Segment axes (left, up) to J211 axes (right, down).
fn push(into: &mut Components, v: Vector3<f64>) {
    into[0].push(v.x);
    into[1].push(-v.y);
    into[2].push(-v.z);
}

impl Recorder for Signals {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        let outputs = output_count(model);
        self.interval_s = model.setup().time.output_s;
        for values in self.all() {
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
        push(&mut self.head_m_s2, s.specific_force_m_s2(Segment::Head));
        push(&mut self.chest_m_s2, s.specific_force_m_s2(Segment::UpperTorso));
        push(&mut self.pelvis_m_s2, s.specific_force_m_s2(Segment::LowerTorso));
        push(&mut self.head_rad_s, s.angular_velocity_rad_s(Segment::Head));
        push(&mut self.head_rad_s2, s.angular_acceleration_rad_s2(Segment::Head));
        let neck = reaction(s, Joint::Neck);
        push(&mut self.neck_n, neck.force_n);
        push(&mut self.neck_n_m, neck.moment_n_m);
        let thighs = [Segment::RightThigh, Segment::LeftThigh];
        for (values, thigh) in self.femur_n.iter_mut().zip(thighs) {
            values.push(femur_axial_n(s, thigh));
        }
        Ok(Flow::Continue)
    }
}
