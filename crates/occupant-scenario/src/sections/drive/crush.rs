//! `crush` of a vehicle of `[drive]`, and `[[drive.impacts]]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vehicle_motion::body::{Crush, Reading, Stiffness as Face};
use vehicle_motion::car::Car;
use vehicle_motion::world::{Impact, Partner};

use super::super::builder::Builder;
use super::super::quantity::{FRACTION, NOT_NEGATIVE, POSITIVE, all_si, si_or};
use super::super::{Angle, Length, Pressure, Ratio, Speed, Stiffness, Time};
use super::DriveSection;
use placed_text::with_key;

/// Crush properties of a vehicle. Absent keys take the values of the preset.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-at-most-one" = [["front", "test"]]))]
pub(crate) struct CrushSection {
    /// Interpretation of the stiffness coefficients. If absent, "dynamic" if the vehicle has occupants, else
    /// "residual".
    pub(crate) reading: Option<CrushReading>,
    /// Increase of the maximum dynamic crush over the residual interpretation, as a fraction; 0.2 if absent, from one
    /// test.
    pub(crate) longer: Option<Ratio<NOT_NEGATIVE>>,
    /// Front.
    pub(crate) front: Option<FaceSection>,
    /// Both sides.
    pub(crate) side: Option<FaceSection>,
    /// Rear.
    pub(crate) rear: Option<FaceSection>,
    /// A full-width wall test from which the front stiffness is computed.
    pub(crate) test: Option<WallTestSection>,
    /// Fractions of energy returned: of the part below A/B, and of the rest; [0.2, 0.015] if absent.
    pub(crate) returned: Option<[Ratio<FRACTION>; 2]>,
}

/// Interpretation of the stiffness coefficients.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum CrushReading {
    /// Maximum crush = residual crush + A/B: for damage and reconstruction. The pulse is too short for occupants.
    Residual,
    /// Larger maximum crush at the same energy and residual crush: for pulses on occupants.
    Dynamic,
}

/// Force per width of a face over its residual crush C: A + B C.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FaceSection {
    /// A, force per width at the onset of residual crush.
    #[serde(rename = "A")]
    pub(crate) a: Stiffness<POSITIVE>,
    /// B, rise of the force per width with residual crush, such as "632 kN/m^2".
    #[serde(rename = "B")]
    pub(crate) b: Pressure<POSITIVE>,
}

/// A full-width test against a rigid wall.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct WallTestSection {
    /// Speed.
    pub(crate) speed: Speed<POSITIVE>,
    /// Residual crush C1 to C6, equally spaced over the width.
    pub(crate) depths: [Length<NOT_NEGATIVE>; 6],
    /// Test mass of the vehicle; its kerb mass if absent.
    pub(crate) mass: Option<super::super::Mass<POSITIVE>>,
}

/// An impact by impulse and momentum; the pair does not crush.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ImpactSection {
    /// Names of a vehicle and of another vehicle or a barrier.
    pub(crate) between: [String; 2],
    /// Time of the impact; first contact if absent.
    pub(crate) time: Option<Time<NOT_NEGATIVE>>,
    /// Point of impact, [x, y]; the first point of contact of the outlines if absent, which is a corner in a square
    /// impact.
    pub(crate) at: Option<[Length; 2]>,
    /// Direction normal to the contact plane, to the right of x, in either sense.
    pub(crate) normal: Angle,
    /// Coefficient of restitution; 0.1 if absent.
    pub(crate) restitution: Option<Ratio<FRACTION>>,
    /// Largest ratio of tangential to normal impulse; 0.55 if absent.
    pub(crate) friction: Option<Ratio<NOT_NEGATIVE>>,
    /// Duration of the impact; 0.1 s if absent, 0 is instantaneous.
    pub(crate) duration: Option<Time<NOT_NEGATIVE>>,
}

/// Default increase of the maximum crush of vehicles with occupants, as a fraction.
const LONGER: f64 = 0.2;

impl CrushSection {
    /// Replaces the crush of a preset by the scenario's; reports a test that gives no stiffness.
    pub(super) fn fit(&self, b: &mut Builder, at: &str, car: &mut Car, has_people: bool) {
        let (mass_kg, width_m) = (car.mass_kg, car.body.width_m);
        let crush: &mut Crush = &mut car.body.crush;
        if let Some(test) = &self.test {
            let depths_m = all_si(&test.depths);
            let mean_m = depths_m.iter().sum::<f64>() / 6.0;
            let speed_m_s = test.speed.si();
            if mean_m <= 0.0 || speed_m_s <= vehicle_motion::body::NO_CRUSH_M_S {
                let found = format!("a mean crush of {mean_m} m at {speed_m_s:.2} m/s");
                b.error(
                    &with_key(at, "test"),
                    found,
                    "crush above 0 and a speed above 2.22 m/s, below which no crush remains",
                );
                return;
            }
            crush.front = Face::by_test(si_or(&test.mass, mass_kg), width_m, speed_m_s, depths_m);
        }
        let faces = [(&self.front, &mut crush.front), (&self.side, &mut crush.side), (&self.rear, &mut crush.rear)];
        for (written, face) in faces {
            if let Some(own) = written {
                *face = Face { a_n_per_m: own.a.si(), b_n_per_m2: own.b.si() };
            }
        }
        if let Some(returned) = &self.returned {
            crush.returned = all_si(returned);
        }
        let is_dynamic = self.reading.map_or(has_people, |reading| reading == CrushReading::Dynamic);
        if is_dynamic {
            crush.reading = Reading::Dynamic { longer: si_or(&self.longer, LONGER) };
        } else if self.longer.is_some() {
            b.error(
                &with_key(at, "longer"),
                "a longer crush in residual reading",
                "reading = \"dynamic\", or no `longer`",
            );
        }
    }
}

impl ImpactSection {
    /// The impact; reports unknown names.
    pub(super) fn impact(&self, b: &mut Builder, at: &str, drive: &DriveSection) -> Option<Impact> {
        let [first, second] = &self.between;
        let cars: Vec<&str> = drive.vehicles.keys().map(String::as_str).collect();
        let barriers: Vec<&str> = drive.barriers.keys().map(String::as_str).collect();
        let at = with_key(at, "between");
        let Some(car) = cars.iter().position(|name| name == first) else {
            b.unknown(&format!("{at}[0]"), "vehicle of `drive`", first, &cars);
            return None;
        };
        let other = cars.iter().position(|name| name == second).map(Partner::Car);
        let other = other.or_else(|| barriers.iter().position(|name| name == second).map(Partner::Barrier));
        let Some(partner) = other else {
            b.unknown(&format!("{at}[1]"), "vehicle or barrier of `drive`", second, &[cars, barriers].concat());
            return None;
        };
        if partner == Partner::Car(car) {
            b.error(&at, format!("an impact of {first} with itself"), "two that meet");
            return None;
        }
        Some(Impact {
            between: (car, partner),
            time_s: self.time.as_ref().map(|time| time.si()),
            at_m: self.at.as_ref().map(all_si),
            normal_rad: self.normal.si(),
            restitution: si_or(&self.restitution, 0.1),
            friction: si_or(&self.friction, 0.55),
            duration_s: si_or(&self.duration, 0.1),
        })
    }
}
