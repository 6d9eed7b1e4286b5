//! From a record to signals of the c.g.: even samples, filter, place of the sensors, gravity, first contact.

use nalgebra::Vector3;

use super::{CHANNELS, VehicleSignals};
use crash_measures::signal::{
    CfcFamily, ChannelClass, Interpolant, Interpolation, STANDARD_GRAVITY_MPS2, SignalError, filter_cfc,
    uniform_interval,
};
use occupant_core::vehicle::{AccelerationRecord, Attitude, Baseline, PathProblem};
use placed_text::number;

/// Gravity in the vertical channel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum VerticalGravity {
    /// Zeroed at rest, or gravity was removed: a level vehicle at rest reads 0.
    #[default]
    Removed,
    /// A level vehicle at rest reads −1 g on z (down): 1 g is added to the channel. The correction does not rotate with
    /// the vehicle.
    Included,
}

/// Preparation of a record before measures are computed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Preparation {
    /// Low-pass filter of all channels; none leaves them unfiltered.
    pub filter: Option<(ChannelClass, CfcFamily)>,
    /// New sample interval, s, by linear interpolation; the record's own if none.
    pub interval_s: Option<f64>,
    /// Position of the sensors relative to the c.g., x forward, y right, z down, m.
    pub offset_m: [f64; 3],
    /// Gravity in az.
    pub gravity: VerticalGravity,
    /// Durations of the rest at the beginning of the record and at its end, s, whose mean readings are removed as zero
    /// offsets; with both, along a straight line. A rest at the end needs one at the beginning.
    pub baseline_s: [Option<f64>; 2],
    /// Time of first contact, s; the first sample if none.
    pub start_s: Option<f64>,
    /// Last time used, s; the last sample if none.
    pub end_s: Option<f64>,
}

/// Reason why a record cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Unprepared {
    /// It has no channel.
    #[error("there is no acceleration and no angular rate")]
    NoChannel,
    /// A channel, or the times ("t"), are wrong.
    #[error("{name}: {error}")]
    Channel {
        /// The channel.
        name: &'static str,
        /// The error.
        error: SignalError,
    },
    /// Sensors away from the c.g. need rates that are missing.
    #[error(
        "sensors away from the centre of gravity need all three rates; {} {} missing",
        missing.join(", "), if missing.len() == 1 { "is" } else { "are" }
    )]
    OffsetNeedsRates {
        /// The missing rates.
        missing: Vec<&'static str>,
    },
    /// The rest used for zero offsets is invalid.
    #[error("{0}")]
    Baseline(PathProblem),
    /// First contact and end are not in the record, in this order.
    #[error(
        "the window from {} s to {} s is outside the record, which covers {} s to {} s",
        number(*start_s), number(*end_s), number(*first_s), number(*last_s)
    )]
    Window {
        /// First contact, s.
        start_s: f64,
        /// End, s.
        end_s: f64,
        /// First sample, s.
        first_s: f64,
        /// Last sample, s.
        last_s: f64,
    },
}

/// Signals of the c.g. from a record.
///
/// # Errors
/// No channel; times that are not even, unless an interval is given; samples too coarse for the filter; an offset without the
/// rates that it needs; a window outside the record.
pub fn prepare(record: &AccelerationRecord, preparation: &Preparation) -> Result<VehicleSignals, Unprepared> {
    let mut signals = even(record, preparation.interval_s)?;
    take_baseline(&mut signals, preparation)?;
    if let Some((class, family)) = preparation.filter {
        for (name, channel) in CHANNELS.into_iter().zip(&mut signals.channels) {
            if let Some(samples) = channel {
                *samples = filter_cfc(samples, signals.dt_s, class, family)
                    .map_err(|error| Unprepared::Channel { name, error })?;
            }
        }
    }
    if preparation.offset_m != [0.0; 3] {
        move_to_centre(&mut signals, Vector3::from(preparation.offset_m))?;
    }
    if let (VerticalGravity::Included, Some(az)) = (preparation.gravity, &mut signals.channels[2]) {
        az.iter_mut().for_each(|a| *a += STANDARD_GRAVITY_MPS2);
    }
    window(signals, preparation)
}

/// Removes zero offsets.
fn take_baseline(signals: &mut VehicleSignals, preparation: &Preparation) -> Result<(), Unprepared> {
    let [Some(start_s), end_s] = preparation.baseline_s else { return Ok(()) };
    let time_s: Vec<f64> = (0..signals.samples()).map(|i| i as f64 * signals.dt_s).collect();
    let rests = Baseline::of(&time_s, start_s, end_s).map_err(Unprepared::Baseline)?;
    for (i, channel) in signals.channels.iter_mut().enumerate() {
        let is_lifted = i == 2 && preparation.gravity == VerticalGravity::Included;
        let should_read = if is_lifted { -STANDARD_GRAVITY_MPS2 } else { 0.0 };
        channel.iter_mut().for_each(|samples| rests.take(&time_s, samples, should_read));
    }
    Ok(())
}

/// The whole record, resampled at even intervals.
fn even(record: &AccelerationRecord, interval_s: Option<f64>) -> Result<VehicleSignals, Unprepared> {
    let of_time = |error| Unprepared::Channel { name: "t", error };
    let mut all = record.acceleration_m_s2.iter().chain(&record.rate_rad_s);
    let given: [Option<&Vec<f64>>; 6] = std::array::from_fn(|_| all.next().and_then(Option::as_ref));
    if given.iter().all(Option::is_none) {
        return Err(Unprepared::NoChannel);
    }
    let dt_s = match interval_s {
        Some(interval_s) => interval_s,
        None => uniform_interval(&record.time_s).map_err(of_time)?,
    };
    let mut channels = [const { None }; 6];
    for (i, channel) in given.into_iter().enumerate() {
        let Some(values) = channel else { continue };
        // the interpolant also checks lengths and numbers
        let through = Interpolant::new(&record.time_s, values, Interpolation::Linear);
        let even = through.and_then(|through| match interval_s {
            Some(interval_s) => through.resample(interval_s),
            None => Ok(values.clone()),
        });
        let name = CHANNELS[i];
        channels[i] = Some(even.map_err(|error| Unprepared::Channel { name, error })?);
    }
    let start_s = record.time_s.first().copied().unwrap_or(0.0);
    Ok(VehicleSignals { start_s, dt_s, channels, lead: Default::default(), initial: Attitude::default() })
}

/// a_cg = a_s − ω̇ × r − ω × (ω × r), with ω̇ from central differences of the filtered rates.
fn move_to_centre(signals: &mut VehicleSignals, arm_m: Vector3<f64>) -> Result<(), Unprepared> {
    let [ax, ay, az, wx, wy, wz] = &mut signals.channels;
    let (Some(wx), Some(wy), Some(wz)) = (wx, wy, wz) else {
        let missing = (3..6).filter(|&i| signals.channels[i].is_none());
        return Err(Unprepared::OffsetNeedsRates { missing: missing.map(|i| CHANNELS[i]).collect() });
    };
    let omega = |i: usize| Vector3::new(wx[i], wy[i], wz[i]);
    let count = wx.len();
    for i in 0..count {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(count - 1));
        let alpha = (omega(after) - omega(before)) / ((after - before) as f64 * signals.dt_s);
        let lever = alpha.cross(&arm_m) + omega(i).cross(&omega(i).cross(&arm_m));
        for (axis, channel) in [&mut *ax, &mut *ay, &mut *az].into_iter().enumerate() {
            if let Some(samples) = channel {
                samples[i] -= lever[axis];
            }
        }
    }
    Ok(())
}

/// The part from first contact to the end, from the first sample not before first contact.
fn window(mut signals: VehicleSignals, preparation: &Preparation) -> Result<VehicleSignals, Unprepared> {
    let (first_s, last_s, dt_s) = (signals.start_s, signals.end_s(), signals.dt_s);
    let start_s = preparation.start_s.unwrap_or(first_s);
    let end_s = preparation.end_s.unwrap_or(last_s);
    // a thousandth of an interval forgives times written with few digits
    let from = ((start_s - first_s) / dt_s - 1e-3).ceil().max(0.0);
    let to = ((end_s - first_s) / dt_s + 1e-3).floor();
    let slack_s = 1e-3 * dt_s;
    let inside = start_s >= first_s - slack_s && end_s <= last_s + slack_s;
    if !(inside && to > from && to < signals.samples() as f64) {
        return Err(Unprepared::Window { start_s, end_s, first_s, last_s });
    }
    let (from, to) = (from as usize, to as usize);
    signals.start_s = first_s + from as f64 * dt_s;
    for (channel, lead) in signals.channels.iter_mut().zip(&mut signals.lead) {
        *lead = channel.as_ref().map_or_else(Vec::new, |channel| channel[..from].to_vec());
    }
    signals.channels.iter_mut().flatten().for_each(|channel| *channel = channel[from..=to].to_vec());
    Ok(signals)
}
