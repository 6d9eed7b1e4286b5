//! `[seats]`, `[posture]` and `[initial_state]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Angle, Length, Speed};

/// A place to sit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SeatSection {
    /// Name of the cushion in `surfaces`.
    pub cushion: String,
    /// Name of the seat back in `surfaces`.
    pub back: String,
    /// Lateral place of the occupant's middle plane; left is negative; 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y: Option<Length>,
}

/// How the occupant sits. Angles lean the top of a segment back from the vehicle's vertical.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-at-most-one" = [["moves_with_vehicle", "velocity"]]))]
pub struct PostureSection {
    /// Name of the seat in `seats`.
    pub seat: String,
    /// γ₁.
    pub middle_torso: Angle,
    /// γ₂.
    pub upper_torso: Angle,
    /// γ₃.
    pub head: Angle,
    /// γ₄.
    pub lower_torso: Angle,
    /// γ₅, both upper arms; positive brings the elbows ahead of the shoulders.
    pub upper_arms: Angle,
    /// α, both elbows; negative brings the hands forward.
    pub elbows: Angle,
    /// [x, z] of both heels, vehicle axes.
    pub heels: [Length; 2],
    /// Move the seated body as one piece until cushion, back and belts carry it; false if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub settle: Option<bool>,
    /// True: every point starts with the velocity of the vehicle there. False: all start with the velocity of the
    /// vehicle's origin. True if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub moves_with_vehicle: Option<bool>,
    /// Velocity of every point at the start, vehicle axes, instead of the vehicle's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity: Option<[Speed; 3]>,
}

/// Position and velocity at the start in the report's generalized coordinates.
///
/// The numbers have no unit of their own: q₁ to q₃ and their rates are in the file's length (m or in) and per second, all
/// others in radians and radians per second, as the report prints them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InitialStateSection {
    /// q₁…q₃₁.
    #[schemars(extend("minItems" = 31, "maxItems" = 31))]
    pub q: Vec<f64>,
    /// Their rates.
    #[schemars(extend("minItems" = 31, "maxItems" = 31))]
    pub rates: Vec<f64>,
    /// To extend a run from cards: [sphere, surface] of the pairs that have passed each other; all others that overlap
    /// touch. If absent, a sphere whose centre is beyond the plane or beside the face has passed it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub passed: Option<Vec<[String; 2]>>,
}
