//! Effect of sensor errors on measures: the same signals many times, each time with other errors within their bounds.
//!
//! A Monte Carlo study: every error is uniform between minus and plus its bound, independent of the others and constant
//! in time. The numbers depend only on the member, so the same record gives the same intervals. Member 0 is the record
//! itself.

use nalgebra::{Rotation3, Vector3};

use super::VehicleSignals;
use crate::random::{Purpose, unit};

/// Bounds of sensor errors, to both sides.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SensorErrors {
    /// Of the gain of each channel, relative.
    pub gain: f64,
    /// Zero offset of each acceleration, m/s².
    pub offset_m_s2: f64,
    /// Zero offset of each rate, rad/s.
    pub rate_rad_s: f64,
    /// Mounting angle of the sensors about each axis, rad.
    pub angle_rad: f64,
    /// Position of the sensors along each axis, m. It needs all three rates.
    pub place_m: f64,
}

impl SensorErrors {
    /// Whether all bounds are 0.
    pub fn is_none(&self) -> bool {
        *self == SensorErrors::default()
    }

    /// The signals with the sensor errors of this member.
    pub fn member(&self, signals: &VehicleSignals, member: u64) -> VehicleSignals {
        let mut changed = signals.clone();
        if member == 0 {
            return changed;
        }
        let draw = |place: u32| 2.0 * unit(0, Purpose::SensorErrors, member, place) - 1.0;
        let three = |from: u32, bound: f64| Vector3::from_fn(|axis, _| bound * draw(from + axis as u32));
        for (i, channel) in changed.channels.iter_mut().enumerate() {
            let (gain, bound) =
                (1.0 + self.gain * draw(i as u32), if i < 3 { self.offset_m_s2 } else { self.rate_rad_s });
            let offset = bound * draw(6 + i as u32);
            let lead = changed.lead.get_mut(i).into_iter().flatten();
            channel.iter_mut().flatten().chain(lead).for_each(|value| *value = *value * gain + offset);
        }
        let turn = Rotation3::from_scaled_axis(three(12, self.angle_rad));
        if self.angle_rad > 0.0 {
            let [ax, ay, az, wx, wy, wz] = &mut changed.channels;
            rotate([ax, ay, az].map(|channel| channel.as_mut()), &turn);
            rotate([wx, wy, wz].map(|channel| channel.as_mut()), &turn);
            rotate(changed.lead.each_mut().map(Some), &turn);
        }
        if self.place_m > 0.0 {
            displace(&mut changed, three(15, self.place_m));
        }
        changed
    }
}

/// Rotates a vector of three channels; a missing one is zero.
fn rotate(mut channels: [Option<&mut Vec<f64>>; 3], turn: &Rotation3<f64>) {
    let count = channels.iter().flatten().map(|samples| samples.len()).max().unwrap_or(0);
    for i in 0..count {
        let told = Vector3::from_fn(|axis, _| channels[axis].as_ref().and_then(|c| c.get(i)).copied().unwrap_or(0.0));
        let turned = turn * told;
        for (axis, channel) in channels.iter_mut().enumerate() {
            if let Some(value) = channel.as_mut().and_then(|samples| samples.get_mut(i)) {
                *value = turned[axis];
            }
        }
    }
}

/// Acceleration at a displaced sensor: a + ω̇ × r + ω × (ω × r).
fn displace(signals: &mut VehicleSignals, arm_m: Vector3<f64>) {
    let dt_s = signals.dt_s;
    let [ax, ay, az, Some(wx), Some(wy), Some(wz)] = &mut signals.channels else { return };
    let omega = |i: usize| Vector3::new(wx[i], wy[i], wz[i]);
    let count = wx.len();
    for i in 0..count {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(count - 1));
        let alpha = (omega(after) - omega(before)) / ((after - before).max(1) as f64 * dt_s);
        let felt = alpha.cross(&arm_m) + omega(i).cross(&omega(i).cross(&arm_m));
        for (axis, channel) in [&mut *ax, &mut *ay, &mut *az].into_iter().enumerate() {
            if let Some(samples) = channel {
                samples[i] += felt[axis];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::risk::{Flight, VehicleRisk};

    fn steady(x: f64, yaw: f64) -> VehicleSignals {
        let channels = [x, 0.0, 0.0, 0.0, 0.0, yaw].map(|value| Some(vec![value; 2001]));
        VehicleSignals { start_s: 0.0, dt_s: 1e-4, channels, lead: Default::default(), initial: Default::default() }
    }

    /// OIV of a steady deceleration is √(2 a d): an error of ±2 % in a moves it by ±1 %, and the middle 95 % of an even spread by 0.95 of that.
    #[test]
    fn the_spread_is_that_of_the_closed_form() {
        let errors = SensorErrors { gain: 0.02, ..SensorErrors::default() };
        let signals = steady(-98.0665, 0.0);
        let of =
            |member| VehicleRisk::of(&errors.member(&signals, member), &Flight::default()).flail.unwrap().oiv_x_mps;
        let whole = (2.0 * 98.0665 * 0.6_f64).sqrt();
        assert!((of(0) - whole).abs() < 1e-9);
        let found: Vec<f64> = (1..401).map(of).collect();
        let ends = [0.025, 0.975].map(|part| crate::spread::quantile(&found, part).unwrap() / whole - 1.0);
        // measured -0.0095 and 0.0095
        assert!((ends[0] + 0.0095).abs() < 6e-4 && (ends[1] - 0.0095).abs() < 6e-4, "{ends:?}");
        assert!(of(1) == of(1) && of(1) != of(2));
    }

    #[test]
    fn each_error_acts_where_it_says() {
        let signals = steady(-100.0, 2.0);
        let offset = SensorErrors { offset_m_s2: 1.0, ..SensorErrors::default() }.member(&signals, 3);
        let [ax, .., wz] = &offset.channels;
        assert!((ax.as_ref().unwrap()[5] + 100.0).abs() <= 1.0 && wz.as_ref().unwrap()[5] == 2.0);
        // a sensor off by r feels ω² r towards the centre
        let place = SensorErrors { place_m: 0.1, ..SensorErrors::default() }.member(&signals, 3);
        let felt = place.channels[0].as_ref().unwrap()[7] + 100.0;
        assert!(felt != 0.0 && felt.abs() <= 4.0 * 0.1 && place.channels[2] == signals.channels[2]);
        // turned sensors keep the magnitude
        let turned = SensorErrors { angle_rad: 0.05, ..SensorErrors::default() }.member(&signals, 3);
        let square: f64 = (0..3).map(|i| turned.channels[i].as_ref().unwrap()[9].powi(2)).sum();
        assert!((square.sqrt() - 100.0).abs() < 1e-9 && turned.channels[0] != signals.channels[0]);
    }
}
