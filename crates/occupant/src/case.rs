//! A case in code.

use nalgebra::{Point3, Vector3};
use occupant_core::forces::bag::Bag;
use occupant_core::forces::belt::Belt;
use occupant_core::forces::chain::Chain;
use occupant_core::forces::column::Column;
use occupant_core::forces::contact::material::Material;
use occupant_core::forces::contact::solid::{Shape, Solid};
use occupant_core::forces::contact::surface::{Facing, Frame, Outline, Surface};
use occupant_core::forces::own::{Force, OwnForce};
use occupant_core::forces::spring::BilinearSpring;
use occupant_core::model::Model;
use occupant_core::model::seating::InitialPosture;
use occupant_core::model::setup::{Integrator, Marker, MarkerFrame, OtherFrame, Setup, SetupBuilder};
use occupant_core::motion::report_coordinates::{DOF, ReportCoordinates};
use occupant_core::vehicle::VehiclePath;
use placed_text::Problem;

use crate::error::unknown;
use crate::ids::Origin;
use crate::{
    BeltId, Error, ErrorKind, FrameId, MaterialId, Occupant, Scenario, Seat, SegmentId, SolidId, SphereId, SurfaceId,
};

/// A case that can be built into a model. Nothing is checked before [`Case::model`], which reports all problems at
/// once.
#[derive(Clone, Debug)]
pub struct Case {
    pub(crate) setup: Setup,
    /// Its text, unless it was changed in code.
    pub(crate) text: Option<Scenario>,
    /// Triggers that need the path in advance, and that path.
    pub(crate) look_ahead: Option<(Vec<String>, VehiclePath)>,
    warnings: Vec<Problem>,
    /// Whether it was created in code.
    is_of_code: bool,
    origin: Origin,
    /// Names of calls that received ids of another case.
    strange: Vec<String>,
}

impl Case {
    /// An occupant in a parked vehicle without surroundings.
    pub fn new(title: impl Into<String>, occupant: Occupant) -> Self {
        let mut setup = SetupBuilder::new(title, occupant.body, occupant.joints).setup;
        setup.time.end_s = 0.2;
        Case { is_of_code: true, ..Case::from_setup(setup) }
    }

    /// A case from plain data.
    pub fn from_setup(setup: Setup) -> Self {
        let (warnings, strange) = (Vec::new(), Vec::new());
        Case { setup, text: None, look_ahead: None, warnings, is_of_code: false, origin: Origin::new(), strange }
    }

    /// The case of a scenario's text without files.
    ///
    /// # Errors
    /// All mistakes, each with line and column.
    pub fn from_toml(text: &str) -> Result<Self, Error> {
        Case::from_scenario(&Scenario::from_toml(text)?)
    }

    /// The case of a scenario.
    ///
    /// # Errors
    /// All mistakes, each with line and column.
    pub fn from_scenario(scenario: &Scenario) -> Result<Self, Error> {
        let (setup, triggers, warnings) = scenario.build()?;
        let look_ahead = (!triggers.is_empty()).then(|| (triggers, setup.path.clone()));
        Ok(Case { text: Some(scenario.clone()), look_ahead, warnings, ..Case::from_setup(setup) })
    }

    /// The text as TOML, for a case read from one.
    ///
    /// # Errors
    /// A case built or changed in code, which has no text. To write a case, build it from a text: [`Scenario::set`]
    /// accepts whole tables, such as `set("belts.lap", "{ … }")`.
    pub fn to_toml(&self) -> Result<String, Error> {
        match &self.text {
            Some(text) => text.to_toml(),
            None => {
                let expected =
                    "a case read from an unchanged text: use `Scenario::set` to change the text or add tables";
                Err(Error::new(ErrorKind::Text, format!("a case built or changed in code; expected {expected}")))
            }
        }
    }

    /// Warnings of the case's text.
    pub fn warnings(&self) -> &[Problem] {
        &self.warnings
    }

    /// The plain data.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// The plain data, mutable.
    pub fn setup_mut(&mut self) -> &mut Setup {
        self.text = None;
        &mut self.setup
    }

    /// The contact sphere of this name.
    ///
    /// # Errors
    /// A name that no sphere of the body has.
    pub fn sphere(&self, name: &str) -> Result<SphereId, Error> {
        let spheres = &self.setup.body.spheres;
        let names = || spheres.iter().map(|sphere| sphere.name.as_str());
        names()
            .position(|own| own == name)
            .map(|i| SphereId(i, self.origin))
            .ok_or_else(|| unknown("sphere", name, names()))
    }

    /// The segment of this name.
    ///
    /// # Errors
    /// A name that no segment of the body has.
    pub fn segment(&self, name: &str) -> Result<SegmentId, Error> {
        let tree = self.setup.body.tree;
        let names = tree.segment_rows().iter().map(|row| row.name);
        tree.segment_named(name)
            .map(|segment| SegmentId(segment, self.origin))
            .ok_or_else(|| unknown("segment", name, names))
    }

    /// The surface of this name.
    ///
    /// # Errors
    /// A name that no surface has.
    pub fn surface_named(&self, name: &str) -> Result<SurfaceId, Error> {
        let names = || self.setup.surfaces.iter().map(|surface| surface.name.as_str());
        names()
            .position(|own| own == name)
            .map(|i| SurfaceId(i, self.origin))
            .ok_or_else(|| unknown("surface", name, names()))
    }

    /// Adds a material.
    pub fn material(&mut self, material: Material) -> MaterialId {
        self.setup_mut().materials.push(material);
        MaterialId(self.setup.materials.len() - 1, self.origin)
    }

    /// Adds a surface of the vehicle whose open side faces a point, m.
    pub fn surface(&mut self, name: &str, of: MaterialId, outline: Outline, open_to_m: [f64; 3]) -> SurfaceId {
        self.know(name, of.1);
        let open_to = Point3::from(open_to_m);
        self.any_surface(Surface::new(name, of.0, outline, open_to))
    }

    /// Adds a level ground in space at a height, m.
    pub fn ground(&mut self, name: &str, of: MaterialId, height_m: f64) -> SurfaceId {
        self.know(name, of.1);
        let point_m = Point3::new(0.0, 0.0, height_m);
        self.any_surface(Surface {
            name: name.into(),
            frame: Frame::Space,
            outline: Outline::Unbounded { point_m, axis: Vector3::z() },
            facing: Facing::Order,
            material: of.0,
            spheres: None,
        })
    }

    /// Adds any surface; its material is an index.
    pub fn any_surface(&mut self, surface: Surface) -> SurfaceId {
        self.setup_mut().surfaces.push(surface);
        SurfaceId(self.setup.surfaces.len() - 1, self.origin)
    }

    /// Adds a solid of the vehicle that all spheres can touch.
    pub fn solid(&mut self, name: &str, of: MaterialId, shape: Shape) -> SolidId {
        self.know(name, of.1);
        let (name, frame, material) = (name.to_owned(), Frame::Vehicle, of.0);
        self.setup_mut().solids.push(Solid { name, frame, shape, material, group: None, spheres: None });
        SolidId(self.setup.solids.len() - 1, self.origin)
    }

    /// Attaches a surface to a frame.
    pub fn carry(&mut self, surface: SurfaceId, with: FrameId) {
        let found = self.setup_mut().surfaces.get_mut(surface.0);
        let name = found.map(|found| {
            found.frame = with.frame();
            found.name.clone()
        });
        let name = name.unwrap_or_else(|| "a surface".to_owned());
        self.know(&name, surface.1);
        self.know(&name, with.1);
    }

    /// Adds a belt around a sphere, from anchor to anchor, m.
    pub fn belt(&mut self, name: &str, round: SphereId, anchors_m: [[f64; 3]; 2], webbing: BilinearSpring) -> BeltId {
        self.know(name, round.1);
        self.setup_mut().belts.push(Belt::new(name, round.0, anchors_m.map(Point3::from), webbing));
        BeltId(self.setup.belts.len() - 1, self.origin)
    }

    /// Adds a belt over several nodes.
    pub fn chain(&mut self, chain: Chain) {
        self.setup_mut().chains.push(chain);
    }

    /// Adds an air bag.
    pub fn bag(&mut self, bag: Bag) {
        self.setup_mut().bags.push(bag);
    }

    /// Adds a collapsing steering column; it carries the frame that it names.
    pub fn column(&mut self, column: Column) {
        self.setup_mut().columns.push(column);
    }

    /// Adds another vehicle.
    pub fn vehicle(&mut self, name: &str, path: VehiclePath) -> FrameId {
        self.frame(OtherFrame { name: name.into(), path, parent: None })
    }

    /// Adds a panel that moves relative to the vehicle and rotates about a point of it, m.
    pub fn panel(&mut self, name: &str, path: VehiclePath, about_m: [f64; 3]) -> FrameId {
        self.frame(OtherFrame { name: name.into(), path, parent: Some((Frame::Vehicle, about_m.into())) })
    }

    fn frame(&mut self, frame: OtherFrame) -> FrameId {
        self.setup_mut().frames.push(frame);
        FrameId(self.setup.frames.len() - 1, self.origin)
    }

    /// Adds a recorded point of a segment, from the segment's lower end, m.
    pub fn marker(&mut self, name: &str, of: SegmentId, from_lower_end_m: [f64; 3]) {
        self.know(name, of.1);
        let place_from_lower_end_m = from_lower_end_m.into();
        let marker = Marker { name: name.into(), segment: of.0, place_from_lower_end_m, frame: MarkerFrame::Vehicle };
        self.setup_mut().output.markers.push(marker);
    }

    /// Adds a force of your own; its channels are `own_force.NAME.*`.
    pub fn force(&mut self, name: &str, force: impl Force + 'static) {
        self.setup_mut().own_forces.push(OwnForce::new(name, force));
    }

    /// Seats the body.
    pub fn seat(&mut self, seat: Seat) {
        seat.surfaces.iter().for_each(|surface| self.know("the seat", surface.1));
        self.setup_mut().posture = InitialPosture::Seated(seat.seating);
    }

    /// Notes a call with an id of another case.
    fn know(&mut self, name: &str, of: Origin) {
        if of != self.origin {
            self.strange.push(format!("`{name}` was given a part of another case"));
        }
    }

    /// Places a body with the report's 12 segments upright with hanging arms, the upper end of its middle torso at this
    /// position in space, m.
    pub fn standing_at(&mut self, place_m: [f64; 3]) {
        let mut q = [0.0; DOF];
        q[..3].copy_from_slice(&place_m);
        let coordinates = ReportCoordinates { q, rates: [0.0; DOF] };
        self.setup_mut().posture = InitialPosture::Coordinates(Box::new(coordinates));
    }

    /// End time of the run, s.
    pub fn ends_at(&mut self, end_s: f64) {
        self.setup_mut().time.end_s = end_s;
    }

    /// Output interval, s.
    pub fn outputs_every(&mut self, interval_s: f64) {
        self.setup_mut().time.output_s = interval_s;
    }

    /// The integrator; by default with the accuracy of
    /// [`Accuracy::Engineering`](occupant_core::model::accuracy::Accuracy).
    pub fn integrator(&mut self, integrator: Integrator) {
        self.setup_mut().integrator = integrator;
    }

    /// The model.
    ///
    /// # Errors
    /// All problems of the case.
    pub fn model(&self) -> Result<Model, Error> {
        self.check_triggers()?;
        if !self.strange.is_empty() {
            let expected = "a part of this case, or of the one it was cloned from";
            return Err(Error::new(ErrorKind::Case, format!("{}; expected {expected}", self.strange.join("; "))));
        }
        let mut setup = self.setup.clone();
        if self.is_of_code {
            setup.integrator = setup.integrator.or_engineering(setup.time.end_s - setup.time.start_s);
        }
        Ok(Model::new(setup)?)
    }
}
