//! The sections of a scenario: for each its keys, as written, and their conversion to plain data.
//!
//! The structs are the only declaration of the keys: the JSON Schema, and so the check, the overrides and the hints,
//! come from them. Their doc comments are the descriptions in the schema, so they address the author of a scenario.

mod adjusted;
mod bags;
mod belts;
mod body;
mod body_joints;
mod builder;
mod car;
mod chains;
mod columns;
mod drive;
mod frames;
mod functions;
mod heading;
mod joints;
mod limits;
mod many;
mod markers;
mod materials;
mod mount;
mod muscles;
mod nodes;
mod number_table;
mod path;
mod plates;
mod plausible;
mod posture;
mod pulse;
mod quantity;
mod record_file;
mod retractors;
mod run;
mod self_contact;
mod sensors;
mod setup;
mod solids;
mod stance;
mod surface_file;
mod surfaces;
mod three_point;
mod triggers;
mod wings;

use std::sync::OnceLock;

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use drive::{Drawing, DrivenVehicle, Drives, Solved, drawings, moving_rails};
pub(super) use drive::{People, Pushers, asks_for_people, caveats, solve};
pub use heading::{folded, heading as column_named, heading_in as column_in, speed_named};
pub(super) use many::together;
pub(super) use quantity::si_or;
pub use quantity::{FRACTION, NOT_NEGATIVE, POSITIVE, Quantity};
pub use record_file::{RecordFile, read_record};
pub(super) use setup::{occupant, setup};

use self::bags::{BagSection, GasSection};
use self::belts::BeltSection;
pub(super) use self::body::{BodySection, DummyChoice};
pub(super) use self::car::{
    AnchorSection, CAR_TITLE, CarBelt, CarClass, CarSeatSection, CarSection, CarYears, IntrusionSection,
};
use self::drive::DriveSection;
use self::frames::{FrameSection, GroundSection, VehicleSection};
use self::functions::{LimiterSection, WebbingSection};
use self::joints::{JointSection, JointsSection};
use self::many::{LooseSection, OccupantSection};
use self::markers::MarkerSection;
pub(super) use self::materials::MaterialSection;
use self::mount::MountSection;
use self::muscles::MusclesSection;
use self::path::PathSection;
pub(super) use self::plates::{AbdomenChoice, ChestChoice, PelvisChoice, SidesChoice};
use self::posture::{InitialStateSection, PostureSection, SeatSection};
use self::quantity::ANY;
use self::retractors::RetractorSection;
use self::run::{IntegratorSection, OutputSection, TimeSection};
use self::self_contact::SelfContactSection;
use self::solids::SolidSection;
use self::stance::StanceSection;
pub(super) use self::surface_file::{Basis, SurfaceFile};
use self::surfaces::{ContactSection, SurfaceSection};
pub(super) use self::three_point::Side;
use self::triggers::TriggerSection;
pub(super) use self::wings::above;
use super::check::schema::schema_of;
use super::kind::{self, UnitSystem};

/// The JSON Schema of a scenario.
pub fn schema() -> &'static serde_json::Value {
    static SCHEMA: OnceLock<serde_json::Value> = OnceLock::new();
    SCHEMA.get_or_init(|| schema_of::<Scenario>("occupant scenario"))
}

/// The JSON Schema of a surface file.
pub fn surface_schema() -> &'static serde_json::Value {
    static SCHEMA: OnceLock<serde_json::Value> = OnceLock::new();
    SCHEMA.get_or_init(|| schema_of::<SurfaceFile>("occupant surface"))
}

/// Length.
pub type Length<const RANGE: usize = ANY> = Quantity<{ kind::LENGTH }, RANGE>;
/// Time.
pub type Time<const RANGE: usize = ANY> = Quantity<{ kind::TIME }, RANGE>;
/// Plane angle.
pub type Angle<const RANGE: usize = ANY> = Quantity<{ kind::ANGLE }, RANGE>;
/// Plain number.
pub type Ratio<const RANGE: usize = ANY> = Quantity<{ kind::RATIO }, RANGE>;
type Speed<const RANGE: usize = ANY> = Quantity<{ kind::SPEED }, RANGE>;
type Acceleration<const RANGE: usize = ANY> = Quantity<{ kind::ACCELERATION }, RANGE>;
type Mass<const RANGE: usize = ANY> = Quantity<{ kind::MASS }, RANGE>;
pub(crate) type Force<const RANGE: usize = ANY> = Quantity<{ kind::FORCE }, RANGE>;
type Inertia<const RANGE: usize = ANY> = Quantity<{ kind::INERTIA }, RANGE>;
type Stiffness<const RANGE: usize = ANY> = Quantity<{ kind::STIFFNESS }, RANGE>;
type RotationalStiffness<const RANGE: usize = ANY> = Quantity<{ kind::ROTATIONAL_STIFFNESS }, RANGE>;
type RotationalDamping<const RANGE: usize = ANY> = Quantity<{ kind::ROTATIONAL_DAMPING }, RANGE>;
type AngularVelocity<const RANGE: usize = ANY> = Quantity<{ kind::ANGULAR_VELOCITY }, RANGE>;
pub(crate) type Moment<const RANGE: usize = ANY> = Quantity<{ kind::MOMENT }, RANGE>;
type MomentPerAngle2<const RANGE: usize = ANY> = Quantity<{ kind::MOMENT_PER_ANGLE_2 }, RANGE>;
type MomentPerAngle3<const RANGE: usize = ANY> = Quantity<{ kind::MOMENT_PER_ANGLE_3 }, RANGE>;
type Area<const RANGE: usize = ANY> = Quantity<{ kind::AREA }, RANGE>;
type Volume<const RANGE: usize = ANY> = Quantity<{ kind::VOLUME }, RANGE>;
type Pressure<const RANGE: usize = ANY> = Quantity<{ kind::PRESSURE }, RANGE>;
type Temperature<const RANGE: usize = ANY> = Quantity<{ kind::TEMPERATURE }, RANGE>;
type MassFlow<const RANGE: usize = ANY> = Quantity<{ kind::MASS_FLOW }, RANGE>;
type MolarMass<const RANGE: usize = ANY> = Quantity<{ kind::MOLAR_MASS }, RANGE>;
type SpecificHeat<const RANGE: usize = ANY> = Quantity<{ kind::SPECIFIC_HEAT }, RANGE>;
type SpecificHeatSlope<const RANGE: usize = ANY> = Quantity<{ kind::SPECIFIC_HEAT_SLOPE }, RANGE>;
type Energy<const RANGE: usize = ANY> = Quantity<{ kind::ENERGY }, RANGE>;
type Damping<const RANGE: usize = ANY> = Quantity<{ kind::DAMPING }, RANGE>;
type QuadraticDamping<const RANGE: usize = ANY> = Quantity<{ kind::QUADRATIC_DAMPING }, RANGE>;
type Frequency<const RANGE: usize = ANY> = Quantity<{ kind::FREQUENCY }, RANGE>;
type HeatTransfer<const RANGE: usize = ANY> = Quantity<{ kind::HEAT_TRANSFER }, RANGE>;

/// A crash or a violent manoeuvre with one occupant, or several.
///
/// A bare number is in SI units with angles in degrees, or in the units named by `units`; a text carries its own unit,
/// such as "20 mph", "48 lbf/in", "5.73 in·lbf·s/rad".
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend(
    "x-at-most-one" = [["body", "occupants"], ["posture", "initial_state", "mount", "stance"]],
    "x-together" = [["body", "joints"]],
))]
pub struct Scenario {
    /// Title of the case, in one line.
    pub title: String,
    /// Description of the case.
    pub notes: Option<String>,
    /// Units of bare numbers; "si" if absent.
    pub units: Option<UnitSystem>,
    /// Gravity, downwards; standard gravity, 9.80665 m/s², if absent; 0 switches it off.
    pub(crate) gravity: Option<Acceleration<NOT_NEGATIVE>>,
    /// A point inside the compartment, vehicle axes. It marks the open side of every vehicle surface that does not give
    /// its own.
    pub(crate) inside: Option<[Length; 3]>,
    /// Sources of the numbers: a path, such as `materials.seat`, and its source.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub provenance: IndexMap<String, String>,
    /// Start and end of the run.
    pub(crate) time: TimeSection,
    /// Recorded outputs.
    pub(crate) output: Option<OutputSection>,
    /// Time integration; "adaptive" with the accuracy "engineering" if absent.
    pub(crate) integrator: Option<IntegratorSection>,
    /// The interior of the first vehicle, by class and measured dimensions.
    pub(crate) car: Option<CarSection>,
    /// Vehicles with tyres and a driver, simulated before the occupants.
    pub(crate) drive: Option<DriveSection>,
    /// Motion of the vehicle. With several vehicles, that of the one named "vehicle". If absent, the first of
    /// `vehicles` also takes that name.
    pub(crate) path: Option<PathSection>,
    /// Other vehicles by name.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) vehicles: IndexMap<String, VehicleSection>,
    /// The ground.
    pub(crate) ground: Option<GroundSection>,
    /// Frames that move within a vehicle, by name: intruding panels, collapsing steering columns, hinges. Attach a
    /// surface or solid with `frame` = that name.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) frames: IndexMap<String, FrameSection>,
    /// Several occupants by name (lower-case letters, digits, `_`), instead of `body`, `joints` and the other sections
    /// of one occupant.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) occupants: IndexMap<String, OccupantSection>,
    /// Loose rigid bodies by name, such as cargo or an impactor.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) loose: IndexMap<String, LooseSection>,
    /// The occupant.
    pub(crate) body: Option<BodySection>,
    /// Seated posture of the occupant.
    pub(crate) posture: Option<PostureSection>,
    /// Exact initial position and velocity, instead of a posture.
    pub(crate) initial_state: Option<InitialStateSection>,
    /// A mount that holds a segment of the occupant, or of a part such as head and neck.
    pub(crate) mount: Option<MountSection>,
    /// Standing posture of the occupant, instead of a seated one.
    pub(crate) stance: Option<StanceSection>,
    /// Seats by name.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) seats: IndexMap<String, SeatSection>,
    /// The occupant's joints.
    pub(crate) joints: Option<JointsSection>,
    /// Named sets of joint properties that joints can refer to.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) joint_sets: IndexMap<String, JointSection>,
    /// The occupant's muscles.
    pub(crate) muscles: Option<MusclesSection>,
    /// Triggers of devices, by name.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) triggers: IndexMap<String, TriggerSection>,
    /// Markers by name: points of segments whose motion is recorded.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) markers: IndexMap<String, MarkerSection>,
    /// Belts by name.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) belts: IndexMap<String, BeltSection>,
    /// Webbings by name, for belts with nodes.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) webbings: IndexMap<String, WebbingSection>,
    /// Limiters of belt force by name.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) limiters: IndexMap<String, LimiterSection>,
    /// Retractors by name; each serves one belt.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) retractors: IndexMap<String, RetractorSection>,
    /// Air bags by name.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) bags: IndexMap<String, BagSection>,
    /// Gases by name, for inflators; "air", "nitrogen", "carbon_dioxide", "water", "helium" and "argon" are known.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) gases: IndexMap<String, GasSection>,
    /// Contact materials by name.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) materials: IndexMap<String, MaterialSection>,
    /// Options for contact forces.
    pub(crate) contact: Option<ContactSection>,
    /// Contact between parts of the body.
    pub(crate) self_contact: Option<SelfContactSection>,
    /// Surfaces by name.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) surfaces: IndexMap<String, SurfaceSection>,
    /// Solids by name: bodies with thickness that spheres can touch from all sides.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) solids: IndexMap<String, SolidSection>,
}
