//! Occupants and their posture.

use occupant_core::body::people::Division;
use occupant_core::body::{Body, Sex};
use occupant_core::forces::joint::Joints;
use occupant_core::model::seating::{Seating, Settling};

use crate::{Error, ErrorKind, SurfaceId};

/// A body with its joints.
#[derive(Clone, Debug, PartialEq)]
pub struct Occupant {
    pub(crate) body: Body,
    pub(crate) joints: Joints,
}

impl Occupant {
    /// A man of median size, in 12 segments.
    pub fn male50() -> Self {
        Occupant { body: Body::male50(), joints: Joints::male50() }
    }

    /// A person of this stature, m, and mass, kg, in 12 segments.
    ///
    /// # Errors
    /// A size outside the surveys.
    pub fn person(sex: Sex, stature_m: f64, mass_kg: f64) -> Result<Self, Error> {
        let found = || Error::new(ErrorKind::Input, format!("no person of {stature_m} m and {mass_kg} kg is known"));
        Ok(Occupant { body: Body::person(sex, stature_m, mass_kg).ok_or_else(found)?, joints: Joints::male50() })
    }

    /// Your own body, with joints of its tree.
    pub fn custom(body: Body, joints: Joints) -> Self {
        Occupant { body, joints }
    }

    /// Allowed numbers of segments of a person.
    pub fn divisions() -> Vec<i64> {
        (1..=64).filter(|segments| Division::of(*segments).is_some()).collect()
    }
}

/// Seat and posture of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Seat {
    pub(crate) seating: Seating,
    pub(crate) surfaces: [SurfaceId; 2],
}

impl Seat {
    /// On a cushion, against a back, the heels at x and z of the vehicle, m. The body is lowered until springs and
    /// weight are in balance.
    pub fn new(cushion: SurfaceId, back: SurfaceId, heels_m: [f64; 2]) -> Self {
        let surfaces = [cushion, back];
        let (cushion, back, angles_rad) = (cushion.0, back.0, Vec::new());
        let seating =
            Seating { cushion, back, lateral_m: 0.0, angles_rad, heels_m, hands_m: None, settle: Settling::Locked };
        Seat { seating, surfaces }
    }

    /// Lateral position, m to the right of the vehicle's middle plane.
    #[must_use]
    pub fn lateral(mut self, lateral_m: f64) -> Self {
        self.seating.lateral_m = lateral_m;
        self
    }

    /// Pitch of a segment (backward) or angle of a hinge, rad: `upper_torso`, `elbows`.
    #[must_use]
    pub fn angle(mut self, name: &str, angle_rad: f64) -> Self {
        self.seating.angles_rad.push((name.to_owned(), angle_rad));
        self
    }

    /// The part that is moved until springs and weight are in balance.
    #[must_use]
    pub fn settle(mut self, settle: Settling) -> Self {
        self.seating.settle = settle;
        self
    }
}
