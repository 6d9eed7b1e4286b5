//! The driver: tables of steering, brake, drive and speed, a line to follow, wheels that lock.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vehicle_motion::GRAVITY_M_S2;
use vehicle_motion::car::Car;
use vehicle_motion::driver::{Driver, Follower, OnImpact, Steering, Table, TableError};

use super::super::builder::Builder;
use super::super::quantity::{FRACTION, NOT_NEGATIVE, POSITIVE, Quantity, si_or};
use super::super::{Angle, Length, Moment, Ratio, Speed, Time};
use super::vehicle::DrivenSection;
use placed_text::with_key;

/// Steering over time, linear between the times.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["wheel", "angle"]]))]
pub(crate) struct SteerSection {
    /// Times, increasing.
    pub(crate) time: Vec<Time>,
    /// Steering-wheel angle at each time; positive to the right.
    pub(crate) wheel: Option<Vec<Angle>>,
    /// Mean front-wheel angle at each time, instead of `wheel`.
    pub(crate) angle: Option<Vec<Angle>>,
}

/// Brake over time, linear between the times.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["pedal", "torque"]]))]
pub(crate) struct BrakeSection {
    /// Times, increasing.
    pub(crate) time: Vec<Time>,
    /// Brake torque at each time, as a fraction of the full torque, 0 to 1.
    pub(crate) pedal: Option<Vec<Ratio<FRACTION>>>,
    /// Brake torque of all wheels at each time, instead of `pedal`.
    pub(crate) torque: Option<Vec<Moment<NOT_NEGATIVE>>>,
}

/// Drive torque over time, linear between the times.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ThrottleSection {
    /// Times, increasing.
    pub(crate) time: Vec<Time>,
    /// Drive torque of all wheels at each time; negative for engine braking.
    pub(crate) torque: Vec<Moment>,
}

/// Speed over time, such as a recorder's pre-crash data; drive and brakes follow it as far as the tyres allow.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SpeedSection {
    /// Times, increasing.
    pub(crate) time: Vec<Time>,
    /// Speed at each time.
    pub(crate) speed: Vec<Speed<NOT_NEGATIVE>>,
}

/// A path-following driver: he aims at the point of the line 0.6 s ahead, at least 6 m.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FollowSection {
    /// Corners [x, y] of the line.
    pub(crate) line: Vec<[Length; 2]>,
    /// Reaction time; 0.1 s if absent.
    pub(crate) delay: Option<Time<NOT_NEGATIVE>>,
    /// Time at which the driver stops steering; the wheels then keep their angle. Never if absent.
    pub(crate) until: Option<Time<POSITIVE>>,
}

/// Wheels.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct WheelsSection {
    /// Left front.
    pub(crate) left_front: Option<WheelSection>,
    /// Right front.
    pub(crate) right_front: Option<WheelSection>,
    /// Left rear.
    pub(crate) left_rear: Option<WheelSection>,
    /// Right rear.
    pub(crate) right_rear: Option<WheelSection>,
}

/// A wheel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct WheelSection {
    /// Time at which it locks.
    pub(crate) locked_from: Option<Time<NOT_NEGATIVE>>,
    /// True: it locks at the first collision.
    pub(crate) locked_on_impact: Option<bool>,
}

/// Reaction of the driver to his first collision.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum AfterImpact {
    /// Releases the pedals.
    Release,
    /// Holds the pedals.
    Hold,
    /// Brakes with full pedal.
    Brake,
    /// Continues unchanged.
    Continue,
}

/// Deceleration at full pedal, g.
const FULL_PEDAL_G: f64 = 1.2;
/// Ratio of steering-wheel angle to front-wheel angle.
const STEERING_RATIO: f64 = 16.0;

/// The driver of a vehicle; mistakes are reported.
pub(super) fn driver(b: &mut Builder, at: &str, s: &DrivenSection, car: &Car) -> Option<Driver> {
    let ratio = si_or(&s.steering_ratio, STEERING_RATIO);
    let mut driver = Driver::coasting();
    if let Some(steer) = &s.steer {
        let at = with_key(at, "steer");
        let table = match (&steer.wheel, &steer.angle) {
            (Some(wheel), _) => table(b, &at, "wheel", &steer.time, wheel, 1.0 / ratio),
            (None, angle) => table(b, &at, "angle", &steer.time, angle.as_deref().unwrap_or_default(), 1.0),
        };
        driver.steering = Steering::Table(table?);
    }
    if let Some(follow) = &s.follow {
        let line = follow.line.iter().map(|place| [place[0].si(), place[1].si()]).collect();
        match Follower::new(line) {
            Ok(mut follower) => {
                follower.delay_s = si_or(&follow.delay, follower.delay_s);
                follower.until_s = si_or(&follow.until, f64::INFINITY);
                follower.rate_rad_s *= 16.0 / ratio;
                driver.steering = Steering::Follow(follower);
            }
            Err(error) => {
                b.error(&with_key(&with_key(at, "follow"), "line"), error.to_string(), "corners that lie apart")
            }
        }
    }
    let full = s.brakes.as_ref().and_then(|brakes| brakes.max_torque.as_ref());
    let full_n_m = full.map_or(FULL_PEDAL_G * car.mass_kg * GRAVITY_M_S2 * car.tyre.radius_m, |torque| torque.si());
    driver.on_impact = match s.on_impact {
        None | Some(AfterImpact::Release) => OnImpact::Release,
        Some(AfterImpact::Hold) => OnImpact::Hold,
        Some(AfterImpact::Brake) => OnImpact::Brake(full_n_m),
        Some(AfterImpact::Continue) => OnImpact::Continue,
    };
    if let Some(brake) = &s.brake {
        let at = with_key(at, "brake");
        driver.brake_n_m = match (&brake.pedal, &brake.torque) {
            (Some(pedal), _) => table(b, &at, "pedal", &brake.time, pedal, full_n_m),
            (None, torque) => table(b, &at, "torque", &brake.time, torque.as_deref().unwrap_or_default(), 1.0),
        }?;
    }
    if let Some(drive) = &s.drive {
        driver.drive_n_m = table(b, &with_key(at, "drive"), "torque", &drive.time, &drive.torque, 1.0)?;
    }
    if let Some(speed) = &s.speed {
        driver.speed_m_s = Some(table(b, &with_key(at, "speed"), "speed", &speed.time, &speed.speed, 1.0)?);
    }
    if let Some(speed) = &s.hold_speed {
        driver.speed_m_s = Some(Table::constant(speed.si()));
    }
    if let Some(w) = &s.wheels {
        let locked = [&w.left_front, &w.right_front, &w.left_rear, &w.right_rear];
        driver.locked_from_s = locked.map(|wheel| Some(wheel.as_ref()?.locked_from.as_ref()?.si()));
        driver.locked_on_impact =
            locked.map(|wheel| wheel.as_ref().is_some_and(|own| own.locked_on_impact == Some(true)));
    }
    Some(driver)
}

/// A table over time, its values times `factor`.
fn table<const KIND: usize, const RANGE: usize>(
    b: &mut Builder,
    at: &str,
    key: &str,
    time: &[Time],
    values: &[Quantity<KIND, RANGE>],
    factor: f64,
) -> Option<Table> {
    let times_s = time.iter().map(Quantity::si).collect();
    match Table::new(times_s, values.iter().map(|value| value.si() * factor).collect()) {
        Ok(table) => Some(table),
        Err(TableError::Order { number, time_s, before_s }) => {
            let found = format!("time {number} is {time_s} s, after {before_s} s");
            b.error(&format!("{at}.time[{}]", number - 1), found, "times that rise");
            None
        }
        Err(error) => {
            b.error(&with_key(at, key), error.to_string(), "a value for each time");
            None
        }
    }
}
