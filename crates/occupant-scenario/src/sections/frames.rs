//! `[vehicles]`, `[ground]` and `[frames]`: frames besides the first vehicle and space, and which bodies can touch what
//! is fixed to them.

use nalgebra::{Point3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::{Builder, index_of};
use super::drive;
use super::path::{self, PathSection};
use super::quantity::{NOT_NEGATIVE, POSITIVE, point, si_or};
use super::solids::SolidSection;
use super::{Angle, Force, Inertia, Length, Mass, Moment, Ratio, RotationalStiffness, Scenario, Stiffness};
use occupant_core::forces::contact::surface::{Facing, Frame, Outline, Surface};
use occupant_core::forces::function::{Beyond, Shape};
use occupant_core::model::setup::OtherFrame;
use occupant_core::motion::frame::MOST_FRAMES;
use occupant_core::vehicle::VehiclePath;
use placed_text::{Diagnostics, Document, Entry, Node, with_key};

/// Another vehicle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct VehicleSection {
    /// Its motion. All vehicles share one vehicle-space and one clock.
    pub(crate) path: PathSection,
    /// Its interior; names of the expanded parts begin with the vehicle's, as in `NAME_wheel_rim`.
    pub(crate) car: Option<super::CarSection>,
}

/// The ground: a level plane in vehicle-space that every body can touch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct GroundSection {
    /// Name of its material in `materials`.
    pub(crate) material: String,
    /// Depth below the origin of vehicle-space, which is the height of a vehicle's centre of gravity where its path has
    /// z = 0; 0 if absent.
    pub(crate) below: Option<Length>,
}

/// A frame that moves within another: an intruding panel, a collapsing steering column, or a hinge, such as a seat
/// recliner. Geometry on it is given in its parent's axes, at its initial position.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-together" = [["stroke", "force"], ["angle", "moment"]]))]
pub(crate) struct FrameSection {
    /// "panel" moves as `path` says; "column" strokes along `axis` when bodies or bags push it; "hinge" turns about
    /// `axis`. "panel" if absent.
    pub(crate) kind: Option<FrameKind>,
    /// Parent frame: a vehicle, or a panel defined before it; "vehicle" if absent.
    pub(crate) parent: Option<String>,
    /// Centre of rotation of a panel or hinge, or centre of the stroking mass, in the parent's axes; [0, 0, 0] if
    /// absent.
    pub(crate) origin: Option<[Length; 3]>,
    /// Motion of a panel from its initial position, along the parent's axes.
    pub(crate) path: Option<PathSection>,
    /// Stroke direction of a column, or rotation axis of a hinge (right-hand rule), in the parent's axes; any length. A
    /// forward-facing seat back leans back about [0, 1, 0].
    pub(crate) axis: Option<[Ratio; 3]>,
    /// Mass that strokes with a column or turns with a hinge.
    pub(crate) mass: Option<Mass<POSITIVE>>,
    /// Strokes of a column, from 0.
    pub(crate) stroke: Option<Vec<Length<NOT_NEGATIVE>>>,
    /// Force at each stroke; may fall. A rise in the last interval is the end stop.
    pub(crate) force: Option<Vec<Force<NOT_NEGATIVE>>>,
    /// Centre of the mass that turns with a hinge, in the parent's axes, before it turns.
    pub(crate) centre: Option<[Length; 3]>,
    /// Moment of inertia of that mass about an axis through `centre`, parallel to `axis`.
    pub(crate) inertia: Option<Inertia<POSITIVE>>,
    /// Angles of a hinge, from 0.
    pub(crate) angle: Option<Vec<Angle<NOT_NEGATIVE>>>,
    /// Moment at each angle; may fall. The hinge yields only in the positive sense of `axis`; in the other sense it is
    /// a spring. A rise in the last interval is the end stop.
    pub(crate) moment: Option<Vec<Moment<NOT_NEGATIVE>>>,
    /// Interpolation of the force or moment between points; "lines" if absent.
    pub(crate) shape: Option<Shape>,
    /// Force or moment beyond the last point; "extends" if absent.
    pub(crate) beyond: Option<Beyond>,
    /// Unloading and reloading slope of a column, no less than the steepest slope of the force; that slope if absent.
    pub(crate) unload_slope: Option<Stiffness<POSITIVE>>,
    /// The same for a hinge.
    pub(crate) unload_stiffness: Option<RotationalStiffness<POSITIVE>>,
    /// Name of a column of the library. Other keys override its values.
    #[schemars(extend("enum" = ["column_1969"]))]
    pub(crate) library: Option<String>,
}

/// Kind of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum FrameKind {
    /// It moves along a given path.
    Panel,
    /// It strokes under load, permanently.
    Column,
    /// It rotates under load, permanently.
    Hinge,
}

/// Which bodies can touch a surface or solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Meets {
    /// Bodies that start in its vehicle.
    Own,
    /// All other bodies.
    Others,
    /// All.
    All,
}

/// Name of the ground as a frame and as a surface.
pub(super) use occupant_core::model::setup::GROUND;
/// The first vehicle.
pub(super) const VEHICLE: &str = "vehicle";

impl Scenario {
    /// Vehicles besides the first, which is that of `path` or the first of all.
    fn other_vehicles(&self) -> impl Iterator<Item = (&String, &VehicleSection)> {
        self.vehicles.iter().skip(usize::from(self.path.is_none()))
    }

    /// The path of the first vehicle and its position in the text; none without motion.
    pub(super) fn first_path(&self) -> Option<(Vec<&str>, &PathSection)> {
        let named = || self.vehicles.first().map(|(name, vehicle)| (vec!["vehicles", name, "path"], &vehicle.path));
        self.path.as_ref().map(|path| (vec!["path"], path)).or_else(named)
    }

    /// Names of the frames besides space and the first vehicle, in the core's order: vehicles, the ground, panels.
    pub(super) fn frame_names(&self) -> Vec<&str> {
        let vehicles = self.other_vehicles().map(|(name, _)| name.as_str());
        vehicles.chain([GROUND]).chain(self.frames.keys().map(String::as_str)).collect()
    }

    /// The frame of this name; for a loose body its index among loose bodies, until its segment is known.
    pub(super) fn frame_named(&self, name: &str) -> Option<Frame> {
        let is_first = self.path.is_none() && self.vehicles.get_index_of(name) == Some(0);
        match name {
            VEHICLE => Some(Frame::Vehicle),
            _ if is_first => Some(Frame::Vehicle),
            "space" => Some(Frame::Space),
            name => {
                let other = self.frame_names().iter().position(|own| *own == name).map(Frame::Other);
                other.or_else(|| self.loose.get_index_of(name).map(Frame::Segment))
            }
        }
    }

    /// The vehicle that a frame belongs to; none for the ground, space and loose bodies.
    pub(super) fn vehicle_of(&self, frame: Frame) -> Option<Frame> {
        let vehicles = self.other_vehicles().count();
        match frame {
            Frame::Vehicle => Some(Frame::Vehicle),
            Frame::Other(i) if i < vehicles => Some(frame),
            Frame::Other(i) => {
                let at = i.checked_sub(vehicles + 1)?;
                let (_, panel) = self.frames.get_index(at)?;
                let parent = self.frame_named(panel.parent.as_deref().unwrap_or(VEHICLE))?;
                // one of those before it, as the frames are checked to be
                if matches!(parent, Frame::Other(j) if j >= i) { None } else { self.vehicle_of(parent) }
            }
            Frame::Space | Frame::Segment(_) => None,
        }
    }

    /// The home of a body with this `vehicle`; none if there is no such vehicle.
    pub(super) fn home(&self, vehicle: Option<&str>) -> Option<Frame> {
        let frame = self.frame_named(vehicle.unwrap_or(GROUND))?;
        (vehicle.is_none() || self.vehicle_of(frame) == Some(frame)).then_some(frame)
    }

    /// Whether a body with this home can touch objects fixed to a frame.
    pub(super) fn is_met(&self, meets: Meets, frame: Frame, home: Frame) -> bool {
        let of = self.vehicle_of(frame);
        match meets {
            Meets::Own => of.is_none_or(|vehicle| vehicle == home),
            Meets::Others => of != Some(home),
            Meets::All => true,
        }
    }

    /// Whether it has several bodies.
    pub(crate) fn has_several(&self) -> bool {
        !self.occupants.is_empty() || !self.loose.is_empty()
    }
}

impl Builder<'_> {
    /// The frame named at `path`; "vehicle" if absent.
    pub(super) fn frame(&mut self, scenario: &Scenario, path: &str, name: Option<&str>) -> Frame {
        let Some(name) = name else { return Frame::Vehicle };
        scenario.frame_named(name).unwrap_or_else(|| {
            let mut names = vec![VEHICLE, "space"];
            names.extend(scenario.frame_names());
            names.extend(scenario.loose.keys().map(String::as_str));
            self.unknown(path, "frame", name, &names);
            Frame::Vehicle
        })
    }
}

/// The frames besides space and the first vehicle; none if nothing is attached to any.
pub(super) fn frames(b: &mut Builder, s: &Scenario, gravity_m_s2: f64) -> Vec<OtherFrame> {
    let is_needed = !s.vehicles.is_empty() || !s.frames.is_empty() || s.ground.is_some() || s.has_several();
    let names = s.surfaces.values().map(|own| own.frame.as_deref()).chain(s.solids.values().map(SolidSection::frame));
    if !is_needed && !names.flatten().any(|name| name == GROUND) {
        return Vec::new();
    }
    check_names(b, s);
    drive::check_names(b, s);
    let mut list = Vec::new();
    for (name, section) in s.other_vehicles() {
        let path = moving(b, &["vehicles", name, "path"], &section.path, gravity_m_s2);
        list.extend(path.map(|path| OtherFrame { name: name.clone(), path, parent: None }));
    }
    list.push(OtherFrame { name: GROUND.to_owned(), path: VehiclePath::parked(), parent: None });
    for (name, section) in &s.frames {
        let at = with_key("frames", name);
        section.check_keys(b, &at);
        let parent = b.frame(s, &with_key(&at, "parent"), section.parent.as_deref());
        let own = list.len();
        if matches!(parent, Frame::Other(i) if i >= own) || matches!(parent, Frame::Segment(_)) {
            let expected = "a vehicle, or a frame defined above it";
            b.error(&with_key(&at, "parent"), format!("the parent of `{name}` is not defined before it"), expected);
        }
        let origin_m = section.origin.as_ref().map_or_else(Point3::origin, point);
        let own = section.path.as_ref().filter(|_| !section.gives());
        let path =
            own.map_or(Some(VehiclePath::parked()), |own| moving(b, &["frames", name, "path"], own, gravity_m_s2));
        list.extend(path.map(|path| OtherFrame { name: name.clone(), path, parent: Some((parent, origin_m)) }));
    }
    let most = MOST_FRAMES - 2;
    if list.len() > most {
        b.error(
            "frames",
            format!("{} frames besides space and the first vehicle", list.len()),
            format!("at most {most}, including the ground"),
        );
    }
    list
}

/// Reports duplicate names of vehicles, frames and loose bodies.
fn check_names(b: &mut Builder, s: &Scenario) {
    let known = s.frame_names();
    for (i, name) in known.iter().enumerate() {
        let is_taken = known[..i].contains(name) || [VEHICLE, "space"].contains(name) || s.loose.contains_key(*name);
        let at = ["vehicles", "frames"]
            .into_iter()
            .find(|key| b.document.root.get(key).is_some_and(|t| t.get(name).is_some()));
        if let (true, Some(at)) = (is_taken, at) {
            b.error(
                &with_key(at, name),
                format!("a second frame named {name}"),
                "unique names of vehicles, frames and loose bodies, none of them vehicle, space or ground",
            );
        }
    }
}

/// The path at `at`.
pub(super) fn moving(b: &mut Builder, at: &[&str], section: &PathSection, gravity_m_s2: f64) -> Option<VehiclePath> {
    let root = with_path(&b.document.root, at)?;
    let document = Document { root, ..b.document.clone() };
    let own = &mut Builder { document: &document, problems: Diagnostics::new(), drives: b.drives };
    let path = path::path(own, section, gravity_m_s2);
    let problems = std::mem::take(&mut own.problems);
    b.problems.extend(problems);
    path
}

/// The ground as a surface, after all others.
pub(super) fn ground(s: &Scenario) -> Option<Surface> {
    let section = s.ground.as_ref()?;
    let below_m = si_or(&section.below, 0.0);
    Some(Surface {
        name: GROUND.to_owned(),
        frame: s.frame_named(GROUND)?,
        outline: Outline::Unbounded { point_m: Point3::new(0.0, 0.0, below_m), axis: -Vector3::z() },
        facing: Facing::Order,
        material: index_of(&section.material, s.materials.keys().map(String::as_str)),
        spheres: None,
    })
}

/// The same tree with the path at `of`.
pub(super) fn with_path(root: &Node, of: &[&str]) -> Option<Node> {
    let mut whole = root.clone();
    let path = of.iter().try_fold(root, |node, key| node.get(key))?.clone();
    whole.as_table_mut()?.insert("path".to_owned(), Entry { key_span: path.span, node: path });
    Some(whole)
}
