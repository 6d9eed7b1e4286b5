//! Occupant risk from the vehicle's motion alone: the criteria of roadside safety tests.
//!
//! ```text
//! record ─ prepare ─┐
//!                   ├─ VehicleSignals ─ VehicleRisk ─ judge against the limits of rules
//! path  ─ sampled ──┘
//! ```
//!
//! Axes are those of SAE J211 and J670: x forward, y right, z down. A measure without its channels is omitted with the
//! reason, never computed from zeros. The formulas are those of [`crash_measures::measure`].

mod angles;
mod errors;
mod judgement;
mod missing;
mod prepare;
mod sampled;

pub use angles::Angles;
use crash_measures::measure::{
    AsiEdition, FlailDistances, FlailSpace, HeadFlight, Olc, Peak, Thiv, asi, flail_space, max_50ms_average, olc, thiv,
};
use crash_measures::signal::{CumulativeIntegral, WindowExtreme};
pub use errors::SensorErrors;
pub use judgement::{Attained, Judgement, ROADSIDE_RULES, attained, judge};
pub use missing::{Measured, Missing};
use occupant_core::vehicle::Attitude;
pub use prepare::{Preparation, Unprepared, VerticalGravity, prepare};
pub use sampled::sampled;

/// Names of the axes.
pub const AXES: [&str; 3] = ["x", "y", "z"];

/// Names of the channels.
const CHANNELS: [&str; 6] = ["ax", "ay", "az", "wx", "wy", "wz"];

/// Accelerations of the c.g. and angular rates along the vehicle's axes, evenly sampled, filtered, from first contact.
#[derive(Clone, Debug, PartialEq)]
pub struct VehicleSignals {
    /// Time of the first sample, s; times of measures are relative to it.
    pub start_s: f64,
    /// Sample interval, s.
    pub dt_s: f64,
    /// Accelerations along x, y, z without gravity, m/s²; rates about x, y, z, rad/s.
    pub channels: [Option<Vec<f64>>; 6],
    /// Accelerations before the first sample, as far as recorded, for the run-in of filters. Without rates.
    pub lead: [Vec<f64>; 3],
    /// Attitude at the first sample.
    pub initial: Attitude,
}

impl VehicleSignals {
    /// Number of samples.
    pub fn samples(&self) -> usize {
        self.channels.iter().flatten().map(Vec::len).max().unwrap_or(0)
    }

    /// Time of the last sample, s.
    pub fn end_s(&self) -> f64 {
        self.start_s + self.samples().saturating_sub(1) as f64 * self.dt_s
    }

    /// A channel by its index.
    fn channel(&self, place: usize) -> Measured<&[f64]> {
        self.channels[place].as_deref().ok_or_else(|| Missing::Channels(vec![CHANNELS[place]]))
    }
}

/// Geometry of the flail space.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Flight {
    /// Distances of the flail-space model.
    pub distances: FlailDistances,
    /// Head of THIV.
    pub head: HeadFlight,
}

/// Velocity change along a vehicle-fixed axis: ∫a dt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VelocityChange {
    /// At the end of the record, m/s.
    pub final_m_s: f64,
    /// The largest in magnitude, m/s, with its time.
    pub largest: Peak,
}

/// All risk measures of a vehicle's motion.
#[derive(Clone, Debug, PartialEq)]
pub struct VehicleRisk {
    /// Occupant impact velocity and ridedown acceleration.
    pub flail: Measured<FlailSpace>,
    /// THIV and PHD.
    pub thiv: Measured<Thiv>,
    /// ASI of EN 1317-1:1998.
    pub asi_1998: Measured<Peak>,
    /// ASI of EN 1317-1:2010.
    pub asi_2010: Measured<Peak>,
    /// The index at the end of the record, as a fraction of its maximum: if large, it may rise further after the
    /// record's end.
    pub asi_left_at_end: Option<f64>,
    /// Largest 50 ms averages along x, y, z, m/s².
    pub max_50ms: [Measured<WindowExtreme>; 3],
    /// Velocity changes along x, y, z.
    pub velocity_change: [Measured<VelocityChange>; 3],
    /// Largest roll, pitch and yaw.
    pub angles: Angles,
    /// Occupant load criterion of the longitudinal acceleration.
    pub olc: Measured<Olc>,
}

impl VehicleRisk {
    /// Computes the measures that the channels allow.
    pub fn of(signals: &VehicleSignals, flight: &Flight) -> Self {
        let asi_2010 = severity(signals, AsiEdition::Edition2010);
        VehicleRisk {
            flail: flail(signals, flight),
            thiv: head_impact(signals, flight),
            asi_1998: severity(signals, AsiEdition::Edition1998).map(|(peak, _)| peak),
            asi_left_at_end: asi_2010.as_ref().ok().map(|(_, left)| *left),
            asi_2010: asi_2010.map(|(peak, _)| peak),
            max_50ms: [0, 1, 2].map(|axis| {
                let a = signals.channel(axis)?;
                Ok(max_50ms_average(a, signals.dt_s)?)
            }),
            velocity_change: [0, 1, 2].map(|axis| velocity_change(signals, axis)),
            angles: Angles::of(signals),
            olc: signals.channel(0).and_then(|a| Ok(olc(a, signals.dt_s)?)),
        }
    }
}

fn flail(signals: &VehicleSignals, flight: &Flight) -> Measured<FlailSpace> {
    let (ax, ay) = missing::both(signals.channel(0), signals.channel(1))?;
    Ok(flail_space(ax, ay, signals.dt_s, flight.distances)?)
}

fn head_impact(signals: &VehicleSignals, flight: &Flight) -> Measured<Thiv> {
    let planar = missing::both(signals.channel(0), signals.channel(1));
    let ((ax, ay), yaw_rate) = missing::both(planar, signals.channel(5))?;
    Ok(thiv(ax, ay, yaw_rate, signals.dt_s, flight.head)?)
}

/// The index from first contact, and its fraction left at the end of the record. The filter of the 2010 edition also
/// uses samples before contact.
fn severity(signals: &VehicleSignals, edition: AsiEdition) -> Measured<(Peak, f64)> {
    let planar = missing::both(signals.channel(0), signals.channel(1));
    let ((ax, ay), az) = missing::both(planar, signals.channel(2))?;
    if edition == AsiEdition::Edition1998 {
        return Ok((asi(ax, ay, az, signals.dt_s, edition)?.peak, 0.0));
    }
    let [x, y, z] = &signals.lead;
    let whole = |lead: &[f64], part: &[f64]| [lead, part].concat();
    let found = asi(&whole(x, ax), &whole(y, ay), &whole(z, az), signals.dt_s, edition)?;
    let peak = found.peak_from(x.len(), signals.dt_s)?;
    Ok((Peak { time_s: peak.time_s - x.len() as f64 * signals.dt_s, ..peak }, found.left_at_end()))
}

fn velocity_change(signals: &VehicleSignals, axis: usize) -> Measured<VelocityChange> {
    let integral = CumulativeIntegral::new(signals.channel(axis)?, signals.dt_s)?;
    let velocity = integral.at_samples();
    Ok(VelocityChange {
        final_m_s: velocity[velocity.len() - 1],
        largest: crash_measures::measure::largest_magnitude(velocity, signals.dt_s)?,
    })
}

#[cfg(test)]
mod tests;
