//! A scenario as it is written: one field for each key of the text.
//!
//! The doc comments are the descriptions of the JSON Schema, so they speak to the person who writes a scenario. Nothing
//! here is checked or converted; that is the work of `check` and `build`.

mod belt;
mod body;
mod contact;
mod joint;
mod material;
mod path;
mod posture;
mod run;
mod surface;

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use belt::BeltSection;
pub use body::{BodySection, SegmentSection, Segments, SphereSection};
pub use contact::{ContactSection, EdgeForceChoice};
pub use joint::{JointSection, JointsSection, StopSection};
pub use material::{MaterialSection, MemoryChoice};
pub use path::{
    After, FilterClass, Interpolate, PathSection, PoseSection, PulseSection, PulseShape, RecordedGravity, SensorAxes,
    SensorsSection, TableSection,
};
pub use posture::{InitialStateSection, PostureSection, SeatSection};
pub use run::{AdaptiveSection, IntegratorSection, OutputSection, Rk4Section, TimeSection};
pub use surface::{DiscSection, FacingChoice, FrameChoice, PlaneSection, SurfaceSection};

use super::kind;
use super::kind::UnitSystem;
use super::quantity::Quantity;

/// Length.
pub type Length = Quantity<{ kind::LENGTH }>;
/// Time.
pub type Time = Quantity<{ kind::TIME }>;
/// Plane angle.
pub type Angle = Quantity<{ kind::ANGLE }>;
/// Speed.
pub type Speed = Quantity<{ kind::SPEED }>;
/// Acceleration.
pub type Acceleration = Quantity<{ kind::ACCELERATION }>;
/// Mass.
pub type Mass = Quantity<{ kind::MASS }>;
/// Force.
pub type Force = Quantity<{ kind::FORCE }>;
/// Moment of inertia.
pub type Inertia = Quantity<{ kind::INERTIA }>;
/// Stiffness.
pub type Stiffness = Quantity<{ kind::STIFFNESS }>;
/// Rotational stiffness.
pub type RotationalStiffness = Quantity<{ kind::ROTATIONAL_STIFFNESS }>;
/// Rotational damping.
pub type RotationalDamping = Quantity<{ kind::ROTATIONAL_DAMPING }>;
/// Plain number.
pub type Ratio = Quantity<{ kind::RATIO }>;

/// A crash or a violent manoeuvre with one occupant.
///
/// A bare number is in SI units with angles in degrees, or in the units named by `units`; a text carries its own unit,
/// such as "20 mph", "48 lbf/in", "5.73 in·lbf·s/rad".
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["posture", "initial_state"]]))]
pub struct Scenario {
    /// One line that names the case.
    pub title: String,
    /// What the case is about, for readers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub notes: Option<String>,
    /// Units of bare numbers; "si" if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub units: Option<UnitSystem>,
    /// Acceleration of gravity, downwards in space; standard gravity, 9.80665 m/s², if absent; 0 switches it off.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub gravity: Option<Acceleration>,
    /// A point inside the compartment, vehicle axes: the open side of every vehicle surface that does not say otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inside: Option<[Length; 3]>,
    /// Where numbers come from: a path such as `materials.seat`, and its source.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub provenance: IndexMap<String, String>,
    /// When the run starts and ends.
    pub time: TimeSection,
    /// What is recorded.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub output: Option<OutputSection>,
    /// How the equations of motion are integrated; "adaptive" with its own defaults if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub integrator: Option<IntegratorSection>,
    /// Motion of the vehicle.
    pub path: PathSection,
    /// The occupant.
    pub body: BodySection,
    /// How the occupant sits.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub posture: Option<PostureSection>,
    /// Exact position and velocity at the start, instead of a posture.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub initial_state: Option<InitialStateSection>,
    /// Seats by name.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub seats: IndexMap<String, SeatSection>,
    /// The occupant's joints.
    pub joints: JointsSection,
    /// Joint properties named once, for joints to refer to.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub joint_sets: IndexMap<String, JointSection>,
    /// Belts by name.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub belts: IndexMap<String, BeltSection>,
    /// Contact materials by name.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub materials: IndexMap<String, MaterialSection>,
    /// How contact forces act.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact: Option<ContactSection>,
    /// Surfaces by name.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub surfaces: IndexMap<String, SurfaceSection>,
}
