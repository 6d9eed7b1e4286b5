//! Everything that a run needs, as plain SI data: the content of a scenario as numbers.
//!
//! [`SetupBuilder`] puts one together in code. A `Setup` may still be wrong; [`crate::model::Model::new`] checks it and reports every problem at once.

use std::sync::Arc;

use nalgebra::Point3;
use placed_text::with_key;
use serde::{Deserialize, Serialize};

use crate::body::{Body, ContactSphere, Segment, called};
use crate::forces::Data;
use crate::forces::bag::Bag;
use crate::forces::belt::Belt;
use crate::forces::chain::Chain;
use crate::forces::column::{Column, ColumnData};
use crate::forces::contact::flat_face::FlatFace;
use crate::forces::contact::material::Material;
use crate::forces::contact::self_contact::SelfContact;
use crate::forces::contact::solid::Solid;
use crate::forces::contact::surface::{Frame, Surface};
use crate::forces::contact::{ContactData, EdgeForce};
use crate::forces::joint::Joints;
use crate::forces::own::{Force, OwnData, OwnForce};
use crate::forces::plate::{Band, PlateData};
use crate::forces::sphere::Site;
use crate::model::accuracy::Accuracy;
use crate::model::seating::{InitialPosture, InitialVelocity, Mounting, upright};
use crate::motion::frame::{Frames, MOST_FRAMES, Moving, VEHICLE};
use crate::motion::report_coordinates::{DOF, ReportCoordinates};
use crate::motion::vector::{M3, V3};
use crate::vehicle::{PathCursor, VehiclePath};

/// Standard gravity, 9.80665 m/s².
pub const STANDARD_GRAVITY_M_S2: f64 = 9.80665;

/// Default time between two outputs, s.
pub const DEFAULT_OUTPUT_S: f64 = 1e-3;

/// Start, end and output times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeSpan {
    /// Start of the run, s.
    pub start_s: f64,
    /// End of the run, s.
    pub end_s: f64,
    /// Interval of results, s: at `start_s + k·output_s` exactly, and at the end.
    pub output_s: f64,
    /// Whether the run ends early when all bodies have come to rest in space.
    pub stops_at_rest: bool,
    /// Work after which the run is given up.
    pub allowance: Allowance,
}

/// Work that a run may cost; beyond it, it ends as failed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Allowance {
    /// Evaluations of the derivative.
    pub evaluations: u64,
    /// Wall time since its start, s. Whether a run ends by it depends on the machine; infinite by default.
    pub wall_time_s: f64,
}

impl Default for Allowance {
    /// No limit.
    fn default() -> Self {
        Allowance { evaluations: u64::MAX, wall_time_s: f64::INFINITY }
    }
}

impl TimeSpan {
    /// Number of output intervals before the last, which may be shorter; one that misses the end by rounding only is
    /// the last.
    pub(crate) fn whole_intervals(&self) -> f64 {
        ((self.end_s - self.start_s) / self.output_s - 1e-9).floor().max(0.0)
    }
}

/// Integration of the equations of motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Integrator {
    /// Classical fourth-order Runge–Kutta with a fixed step.
    Rk4 {
        /// Step, s.
        step_s: f64,
    },
    /// Embedded 3(2) pair with error control.
    Adaptive {
        /// Relative tolerance of velocities; positions have an absolute one only.
        relative: f64,
        /// Absolute tolerance of positions, m; angles count at a radius of 1 m.
        absolute_m: f64,
        /// Absolute tolerance of velocities, m/s.
        absolute_m_s: f64,
        /// Smallest step of error control, s; a smaller one ends the run with an error. The first trial is ten times as
        /// long.
        min_step_s: f64,
        /// Largest step, s.
        max_step_s: f64,
    },
}

impl Default for Integrator {
    /// Error control as chosen in `docs/accuracy.md`.
    fn default() -> Self {
        Integrator::Adaptive {
            relative: 3e-8,
            absolute_m: 3e-9,
            absolute_m_s: 3e-7,
            min_step_s: 1e-10,
            max_step_s: 2e-3,
        }
    }
}

impl Integrator {
    /// Default for a run of `span_s` seconds: as accurate as a scenario without `[integrator]`.
    #[must_use]
    pub fn or_engineering(self, span_s: f64) -> Self {
        if self == Integrator::default() { Accuracy::default().integrator(span_s) } else { self }
    }

    /// Its `kind` in scenarios.
    pub(crate) const fn name(&self) -> &'static str {
        match self {
            Integrator::Rk4 { .. } => "rk4",
            Integrator::Adaptive { .. } => "adaptive",
        }
    }

    /// Longest possible step, s.
    pub(crate) fn longest_step_s(&self) -> f64 {
        match *self {
            Integrator::Rk4 { step_s } => step_s,
            Integrator::Adaptive { max_step_s, .. } => max_step_s,
        }
    }
}

/// Optional outputs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OutputOptions {
    /// Whether the report's q₁…q₃₁ and their rates are recorded.
    pub report_coordinates: bool,
    /// Points of segments whose motion is recorded.
    pub markers: Vec<Marker>,
    /// Interval at which instruments are read for measures, s; default 0.1 ms.
    pub readings_s: Option<f64>,
}

/// A named point of a segment whose motion is recorded.
#[derive(Clone, Debug, PartialEq)]
pub struct Marker {
    /// Name in results.
    pub name: String,
    /// Segment that carries it.
    pub segment: Segment,
    /// Position, segment axes.
    pub place_from_lower_end_m: Point3<f64>,
    /// Frame of reference of its motion.
    pub frame: MarkerFrame,
}

impl Marker {
    /// The same for one of several bodies, with this name, whose segments begin at index `first`.
    pub(crate) fn of_member(&self, name: &str, first: usize) -> Self {
        let segment = self.segment.behind(first);
        Marker { name: called(name, &self.name), segment, ..self.clone() }
    }

    /// Sphere without radius, for the kernel.
    pub(crate) fn site(&self, body: &Body) -> Site<f64> {
        let (segment, centre_from_lower_end_m) = (self.segment, self.place_from_lower_end_m);
        Site::new(body, &ContactSphere::new(&self.name, segment, centre_from_lower_end_m, 0.0))
    }
}

/// Frame of reference of a marker's motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum MarkerFrame {
    /// The vehicle.
    #[default]
    Vehicle,
    /// Space.
    Space,
    /// Accelerometer on the segment.
    Segment,
}

/// Frame other than the first vehicle: another vehicle, the ground, a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct OtherFrame {
    /// Unique name.
    pub name: String,
    /// Motion in space; of a panel, relative to its parent: displacement from the position in which its geometry is
    /// given.
    pub path: VehiclePath,
    /// Parent of a panel, a frame before it, and the point of the parent about which the panel turns, m.
    pub parent: Option<(Frame, Point3<f64>)>,
}

impl OtherFrame {
    /// Its motion, given those of the frames before it.
    fn moving(&self, frames: &Frames<f64>, t_s: f64, step_middle_s: f64) -> Moving<f64> {
        let motion = Moving::of(&self.path.motion_within(t_s, step_middle_s, &mut PathCursor::default()));
        let Some((parent, origin_m)) = &self.parent else { return motion };
        // as seen in vehicle-space, then about the origin
        let upright = Moving { axes: M3::of(&upright()), ..Moving::space() };
        let origin = V3::of(&origin_m.coords);
        let mut seen = upright.carrying(&motion).carried(-origin, &M3::identity());
        seen.origin += origin;
        frames[parent.index(&[])].carrying(&seen)
    }
}

/// History of a driven vehicle at its stations; clones share it.
#[derive(Clone, Debug, PartialEq)]
pub struct DriveLog {
    /// Name of the vehicle.
    pub name: String,
    /// Times of the stations, s, increasing.
    pub times_s: Arc<[f64]>,
    /// Values at each station, SI, in the order of the catalogue: speed, slip angle, steering, crush, force of the
    /// struck object, force of the ground on its hull, then of each wheel load, travel, spin, brake torque,
    /// longitudinal and lateral slip, longitudinal and lateral force, saturation.
    pub rows: Arc<[[f64; DRIVE_NUMBERS]]>,
}

/// Count of values at a station of a drive: of the vehicle, and of each of four wheels.
pub const DRIVE_NUMBERS: usize = 6 + 4 * 9;

/// A result computed before the run, such as where a vehicle came to rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Fact {
    /// Name, such as `drive.car.delta_v`.
    pub name: String,
    /// SI unit.
    pub unit: &'static str,
    /// Value, SI.
    pub value: f64,
}

/// Drawn geometry without contact.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenery {
    /// Its name.
    pub name: String,
    /// Frame that carries it.
    pub frame: Frame,
    /// Convex polygons, m.
    pub polygons_m: Vec<Vec<Point3<f64>>>,
}

/// One of several bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct Member {
    /// Name: small letters, digits and `_`; none for a first body at the top of a scenario.
    pub name: String,
    /// Home frame, in whose axes it begins and its positions are reported.
    pub home: Frame,
    /// Spheres (indices) that can touch each surface, then each solid; all where there is no list.
    pub meets: Vec<Option<Vec<usize>>>,
    /// The body alone, with its home as the vehicle.
    pub alone: Setup,
}

impl Member {
    /// Whether it is a free rigid body, not an occupant.
    pub(crate) fn is_loose(&self) -> bool {
        self.alone.body.name == LOOSE
    }

    /// Its path in a scenario.
    pub(crate) fn path(&self) -> String {
        with_key(if self.is_loose() { "loose" } else { "occupants" }, &self.name)
    }
}

/// Name of the frame at rest.
pub const GROUND: &str = "ground";

/// Name of the segment of a free rigid body.
pub const LOOSE: &str = "body";

/// Input of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Setup {
    /// Title, one line.
    pub title: String,
    /// The occupant.
    pub body: Body,
    /// Its joints.
    pub joints: Joints,
    /// g, along −Z′, m/s²; 0: no gravity.
    pub gravity_m_s2: f64,
    /// Contact materials.
    pub materials: Vec<Material>,
    /// Surfaces of vehicles and of space.
    pub surfaces: Vec<Surface>,
    /// Solids of vehicles and of space. Indices of results and seats count them after all surfaces.
    pub solids: Vec<Solid>,
    /// Surfaces, and solids after all surfaces (indices), that support the spine, such as a seat back: to them, a
    /// deformable chest is rigid.
    pub behind: Vec<usize>,
    /// Condition of the edge force.
    pub edge_force: EdgeForce,
    /// Contact of the body with itself; none as in the report, where its parts pass through each other.
    pub self_contact: Option<SelfContact>,
    /// Belts.
    pub belts: Vec<Belt>,
    /// Belts over several nodes.
    pub chains: Vec<Chain>,
    /// Air bags.
    pub bags: Vec<Bag>,
    /// Yielding steering columns and hinges, each of which carries one of `frames`.
    pub columns: Vec<Column>,
    /// Springs and dampers of the body's plates.
    pub bands: Vec<Band>,
    /// Forces of the calling program.
    pub own_forces: Vec<OwnForce>,
    /// Motion of the vehicle.
    pub path: VehiclePath,
    /// Drawn geometry without contact: the road, the outside of vehicles.
    pub scenery: Vec<Scenery>,
    /// Results computed before the run, for tables.
    pub facts: Vec<Fact>,
    /// Histories of vehicles driven before the run.
    pub logs: Vec<DriveLog>,
    /// Frames other than the vehicle and space.
    pub frames: Vec<OtherFrame>,
    /// The bodies, if there are several.
    pub members: Vec<Member>,
    /// Initial position.
    pub posture: InitialPosture,
    /// Initial velocity.
    pub velocity: InitialVelocity,
    /// Times.
    pub time: TimeSpan,
    /// Integrator.
    pub integrator: Integrator,
    /// Extra outputs.
    pub output: OutputOptions,
}

impl Setup {
    /// Parts that no scenario can contain, as text: those of the calling program.
    pub fn beyond_scenario(&self) -> Vec<String> {
        let forces = self.own_forces.iter().map(|own| format!("the program's own force `{}`", own.name));
        let path = match self.path {
            VehiclePath::Own(_) => Some("a vehicle that the program moves"),
            VehiclePath::Live(_) => Some("a vehicle whose motion is given during the run"),
            _ => None,
        };
        path.map(str::to_owned).into_iter().chain(forces).collect()
    }

    /// Largest length of a fixed step, at most an output interval, s; none with error control.
    pub(crate) fn fixed_step_s(&self) -> Option<f64> {
        let longest_s = self.time.output_s.min(self.time.end_s - self.time.start_s);
        match self.integrator {
            Integrator::Rk4 { step_s } => Some(step_s.min(longest_s)),
            Integrator::Adaptive { .. } => None,
        }
    }

    /// Adds the motions of all frames except space and the vehicle.
    pub(crate) fn place_frames(&self, frames: &mut Frames<f64>, step_middle_s: f64) {
        for (i, other) in self.frames.iter().take(MOST_FRAMES - VEHICLE - 1).enumerate() {
            frames[VEHICLE + 1 + i] = other.moving(frames, frames.time, step_middle_s);
        }
    }

    /// Vehicle, space or ground that carries a frame, directly or through other frames.
    pub(crate) fn belongs_to(&self, frame: Frame) -> Frame {
        let parent = |frame: Frame| match frame {
            Frame::Other(i) => self.frames.get(i)?.parent.map(|(parent, _)| parent),
            _ => None,
        };
        // no frame carries itself
        let all = std::iter::successors(Some(frame), |frame| parent(*frame)).take(MOST_FRAMES);
        all.last().unwrap_or(frame)
    }

    /// Whether a frame is space or the ground.
    pub(crate) fn is_ground(&self, frame: Frame) -> bool {
        match frame {
            Frame::Space => true,
            Frame::Other(i) => self.frames.get(i).is_some_and(|frame| frame.name == GROUND),
            Frame::Vehicle | Frame::Segment(_) => false,
        }
    }

    /// Whether any vehicle contains more than one body, so that bodies may strike each other.
    pub(crate) fn is_open(&self) -> bool {
        let mut frames = self.surfaces.iter().map(|s| s.frame).chain(self.solids.iter().map(|s| s.frame));
        !self.members.is_empty() || frames.any(|frame| matches!(self.belongs_to(frame), Frame::Other(_)))
    }

    /// By body: its home frame, and the condyles from the neck's joint.
    pub(crate) fn instrument_sites(&self) -> Vec<(usize, Option<nalgebra::Vector3<f64>>)> {
        let condyles_m = |of: usize| self.members.get(of).map_or(self.body.condyles_m, |m| m.alone.body.condyles_m);
        self.homes().iter().enumerate().map(|(of, home)| (home.index(&[]), condyles_m(of))).collect()
    }

    /// Homes of the bodies.
    pub(crate) fn homes(&self) -> Vec<Frame> {
        if self.members.is_empty() { vec![Frame::Vehicle] } else { self.members.iter().map(|m| m.home).collect() }
    }

    /// Whether the body is mounted or placed as on a rig: then it may be part of a whole body.
    pub(crate) fn is_on_rig(&self) -> bool {
        match &self.posture {
            InitialPosture::Placed(placing) => !placing.stands,
            posture => matches!(posture, InitialPosture::Mounted(_)),
        }
    }

    /// Mounting of the body's first segment; none for a free body.
    pub fn mounting(&self) -> Option<&Mounting> {
        if let InitialPosture::Mounted(mounting) = &self.posture { Some(mounting) } else { None }
    }

    /// Names of surfaces, then of solids, then of spheres that others can touch.
    pub fn surface_names(&self) -> impl Iterator<Item = &str> {
        let spheres = self.self_contact.iter().flat_map(|_| self.body.spheres.iter().map(|s| s.name.as_str()));
        let solids = self.solids.iter().map(|s| s.name.as_str());
        self.surfaces.iter().map(|s| s.name.as_str()).chain(solids).chain(spheres)
    }

    /// Name of the surface, solid or sphere with this index, if there is one.
    pub fn surface_name(&self, index: usize) -> Option<&str> {
        self.surface_names().nth(index)
    }

    /// Index of the material of the surface, solid or sphere with this index, which must exist.
    pub fn surface_material(&self, index: usize) -> usize {
        let solids = self.solids.iter().map(|s| s.material);
        let skins = self.self_contact.iter().flat_map(|own| own.skins.iter().copied());
        let mut all = self.surfaces.iter().map(|s| s.material).chain(solids).chain(skins);
        all.nth(index).unwrap_or_default()
    }

    /// Data of force elements; `faces` are the planes of its surfaces.
    pub(crate) fn forces<'a>(&'a self, faces: &'a [FlatFace]) -> Data<'a> {
        let contacts = ContactData {
            surfaces: &self.surfaces,
            faces,
            solids: &self.solids,
            behind: &self.behind,
            self_contact: self.self_contact.as_ref(),
            materials: &self.materials,
            edge_force: self.edge_force,
            longest_step_s: self.integrator.longest_step_s(),
        };
        Data {
            plates: PlateData { plates: &self.body.plates, bands: &self.bands },
            contacts,
            belts: &self.belts,
            chains: &self.chains,
            bags: &self.bags,
            own: OwnData { forces: &self.own_forces, others: self.frames.len() },
            columns: ColumnData { columns: &self.columns, gravity_m_s2: self.gravity_m_s2 },
            hinges: ColumnData { columns: &self.columns, gravity_m_s2: self.gravity_m_s2 },
            joints: &self.joints,
            limits: &self.joints,
            muscles: &self.joints,
        }
    }
}

/// Builder of a [`Setup`]. Defaults are those of scenarios.
#[derive(Clone, Debug)]
pub struct SetupBuilder {
    /// The setup so far, with the defaults of scenarios. Path, posture and end are given last.
    pub setup: Setup,
}

impl SetupBuilder {
    /// A setup with this occupant, without belts and contacts.
    pub fn new(title: impl Into<String>, body: Body, joints: Joints) -> Self {
        let setup = Setup {
            title: title.into(),
            body,
            joints,
            gravity_m_s2: STANDARD_GRAVITY_M_S2,
            materials: Vec::new(),
            surfaces: Vec::new(),
            solids: Vec::new(),
            behind: Vec::new(),
            edge_force: EdgeForce::default(),
            self_contact: None,
            belts: Vec::new(),
            chains: Vec::new(),
            bags: Vec::new(),
            columns: Vec::new(),
            bands: Vec::new(),
            own_forces: Vec::new(),
            path: VehiclePath::parked(),
            scenery: Vec::new(),
            facts: Vec::new(),
            logs: Vec::new(),
            frames: Vec::new(),
            members: Vec::new(),
            posture: InitialPosture::Coordinates(Box::new(ReportCoordinates { q: [0.0; DOF], rates: [0.0; DOF] })),
            velocity: InitialVelocity::default(),
            time: TimeSpan {
                start_s: 0.0,
                end_s: 0.0,
                output_s: DEFAULT_OUTPUT_S,
                stops_at_rest: false,
                allowance: Allowance::default(),
            },
            integrator: Integrator::default(),
            output: OutputOptions::default(),
        };
        SetupBuilder { setup }
    }

    /// Adds a material and returns its index, for surfaces.
    pub fn material(&mut self, material: Material) -> usize {
        self.setup.materials.push(material);
        self.setup.materials.len() - 1
    }

    /// Adds a surface and returns its index, for a [`Seating`](crate::model::seating::Seating).
    pub fn surface(&mut self, surface: Surface) -> usize {
        self.setup.surfaces.push(surface);
        self.setup.surfaces.len() - 1
    }

    /// Adds a belt.
    pub fn belt(&mut self, belt: Belt) {
        self.setup.belts.push(belt);
    }

    /// Adds an own force with a name: its channels are `own_force.NAME.*`.
    pub fn force(&mut self, name: impl Into<String>, force: impl Force + 'static) {
        self.setup.own_forces.push(OwnForce::new(name, force));
    }

    /// The setup: this occupant in a vehicle that moves along `path`, from `posture` until `end_s`.
    ///
    ///
    /// Not checked here: [`Model::new`](crate::model::Model::new) reports all problems at once.
    pub fn build(self, path: VehiclePath, posture: InitialPosture, end_s: f64) -> Setup {
        let time = TimeSpan { end_s, ..self.setup.time };
        let integrator = self.setup.integrator.or_engineering(time.end_s - time.start_s);
        Setup { path, posture, time, integrator, ..self.setup }
    }
}
