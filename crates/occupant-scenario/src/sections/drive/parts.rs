//! Suspension, tyres and brakes of a vehicle of `[drive]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vehicle_motion::car::{Axle, Car};

use super::super::quantity::{FRACTION, NOT_NEGATIVE, POSITIVE, Quantity, si_or};
use super::super::{Force, Inertia, Length, Mass, Moment, Ratio, RotationalStiffness, Stiffness};

/// Suspension.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SuspensionSection {
    /// Front axle.
    pub(crate) front: Option<AxleSection>,
    /// Rear axle.
    pub(crate) rear: Option<AxleSection>,
}

/// An axle; numbers are those of one wheel, at the wheel.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct AxleSection {
    /// Track width.
    pub(crate) track: Option<Length<POSITIVE>>,
    /// Unsprung mass at one wheel.
    pub(crate) wheel_mass: Option<Mass<POSITIVE>>,
    /// Spin inertia of the wheel.
    pub(crate) spin_inertia: Option<Inertia<POSITIVE>>,
    /// Spring rate.
    pub(crate) rate: Option<Stiffness<POSITIVE>>,
    /// Damping ratio in jounce.
    pub(crate) jounce_damping: Option<Ratio<NOT_NEGATIVE>>,
    /// Damping ratio in rebound.
    pub(crate) rebound_damping: Option<Ratio<NOT_NEGATIVE>>,
    /// Stiffness of the axle's anti-roll bar.
    pub(crate) anti_roll: Option<RotationalStiffness<NOT_NEGATIVE>>,
    /// Height of the roll centre above the road.
    pub(crate) roll_centre: Option<Length>,
    /// Jounce at which the bump stop touches.
    pub(crate) jounce_stop: Option<Length<POSITIVE>>,
    /// Rebound at which the rebound stop touches.
    pub(crate) rebound_stop: Option<Length<POSITIVE>>,
}

/// Tyres, all alike.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TyresSection {
    /// Factor on the friction of the ground; 1 if absent.
    pub(crate) grip: Option<Ratio<NOT_NEGATIVE>>,
    /// Free radius.
    pub(crate) radius: Option<Length<POSITIVE>>,
    /// Radial stiffness.
    pub(crate) stiffness: Option<Stiffness<POSITIVE>>,
    /// Cornering coefficient at the reference load: cornering stiffness per radian over load.
    pub(crate) cornering: Option<Ratio<POSITIVE>>,
    /// Reference load, at which `cornering` applies.
    pub(crate) reference_load: Option<Force<POSITIVE>>,
    /// Load at which cornering stiffness peaks, relative to the reference load. A large value makes cornering stiffness
    /// proportional to load.
    pub(crate) greatest_at: Option<Ratio<POSITIVE>>,
    /// Longitudinal slip stiffness over load.
    pub(crate) slip_stiffness: Option<Ratio<POSITIVE>>,
    /// Camber stiffness per radian over load.
    pub(crate) camber: Option<Ratio<NOT_NEGATIVE>>,
    /// Sliding friction relative to peak friction.
    pub(crate) sliding_share: Option<Ratio<FRACTION>>,
    /// Relaxation length.
    pub(crate) relaxation: Option<Length<POSITIVE>>,
    /// Coefficient of rolling resistance.
    pub(crate) rolling: Option<Ratio<NOT_NEGATIVE>>,
}

/// Brakes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BrakesSection {
    /// Brake torque of all wheels at full pedal; enough for 1.2 g if absent.
    pub(crate) max_torque: Option<Moment<POSITIVE>>,
    /// Shares: left front, right front, left rear, right rear.
    pub(crate) shares: Option<[Ratio<NOT_NEGATIVE>; 4]>,
}

/// Replaces a number by the scenario's, if there is one.
pub(super) fn put<const KIND: usize, const RANGE: usize>(to: &mut f64, written: &Option<Quantity<KIND, RANGE>>) {
    *to = si_or(written, *to);
}

impl AxleSection {
    pub(super) fn fit(&self, axle: &mut Axle, load_n: f64) {
        put(&mut axle.track_m, &self.track);
        put(&mut axle.wheel_kg, &self.wheel_mass);
        put(&mut axle.spin_kg_m2, &self.spin_inertia);
        put(&mut axle.rate_n_per_m, &self.rate);
        put(&mut axle.roll_centre_m, &self.roll_centre);
        put(&mut axle.jounce_stop_m, &self.jounce_stop);
        put(&mut axle.rebound_stop_m, &self.rebound_stop);
        let corner_kg = load_n / vehicle_motion::GRAVITY_M_S2 - axle.wheel_kg;
        let critical = 2.0 * (axle.rate_n_per_m * corner_kg.max(0.0)).sqrt();
        let damper = |ratio: &Ratio<NOT_NEGATIVE>| ratio.si() * critical;
        axle.jounce_n_s_per_m = self.jounce_damping.as_ref().map_or(axle.jounce_n_s_per_m, damper);
        axle.rebound_n_s_per_m = self.rebound_damping.as_ref().map_or(axle.rebound_n_s_per_m, damper);
        if let Some(bar) = &self.anti_roll {
            axle.anti_roll_n_per_m = bar.si() / (axle.track_m * axle.track_m);
        }
    }
}

impl TyresSection {
    pub(super) fn fit(&self, car: &mut Car) {
        let tyre = &mut car.tyre;
        tyre.friction *= si_or(&self.grip, 1.0);
        put(&mut tyre.radius_m, &self.radius);
        put(&mut tyre.stiffness_n_per_m, &self.stiffness);
        put(&mut tyre.cornering_per_rad, &self.cornering);
        put(&mut tyre.reference_load_n, &self.reference_load);
        put(&mut tyre.greatest_at, &self.greatest_at);
        put(&mut tyre.slip_stiffness, &self.slip_stiffness);
        put(&mut tyre.camber_per_rad, &self.camber);
        put(&mut tyre.sliding_share, &self.sliding_share);
        put(&mut tyre.relaxation_m, &self.relaxation);
        put(&mut tyre.rolling, &self.rolling);
    }
}
