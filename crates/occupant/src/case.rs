//! A case in code.

use nalgebra::{Point3, Vector3};
use occupant_core::body::people::Division;
use occupant_core::body::{Body, Sex};
use occupant_core::forces::bag::Bag;
use occupant_core::forces::belt::Belt;
use occupant_core::forces::chain::Chain;
use occupant_core::forces::column::Column;
use occupant_core::forces::contact::material::Material;
use occupant_core::forces::contact::solid::{Shape, Solid};
use occupant_core::forces::contact::surface::{Facing, Frame, Outline, Surface};
use occupant_core::forces::joint::Joints;
use occupant_core::forces::own::{Force, OwnForce};
use occupant_core::forces::spring::BilinearSpring;
use occupant_core::model::Model;
use occupant_core::model::seating::{InitialPosture, Seating, Settling};
use occupant_core::model::setup::{Integrator, Marker, MarkerFrame, OtherFrame, Setup, SetupBuilder};
use occupant_core::motion::report_coordinates::{DOF, ReportCoordinates};
use occupant_core::vehicle::{PulseDefinition, PulsePath, PulseShape, VehiclePath, VehicleState};
use placed_text::Problem;

use crate::error::unknown;
use crate::{BeltId, Error, ErrorKind, FrameId, MaterialId, Scenario, SegmentId, SolidId, SphereId, SurfaceId};

/// A body with what acts in its joints.
#[derive(Clone, Debug, PartialEq)]
pub struct Occupant {
    body: Body,
    joints: Joints,
}

impl Occupant {
    /// A man of median size, in 12 segments.
    pub fn male50() -> Self {
        Occupant { body: Body::male50(), joints: Joints::male50() }
    }

    /// A person of this stature, m, and mass, kg, in 12 segments.
    ///
    /// # Errors
    /// A size of which the surveys know nobody.
    pub fn person(sex: Sex, stature_m: f64, mass_kg: f64) -> Result<Self, Error> {
        let found = || Error::new(ErrorKind::Input, format!("nobody of {stature_m} m and {mass_kg} kg is known"));
        Ok(Occupant { body: Body::person(sex, stature_m, mass_kg).ok_or_else(found)?, joints: Joints::male50() })
    }

    /// A body of one's own with joints of its tree.
    pub fn custom(body: Body, joints: Joints) -> Self {
        Occupant { body, joints }
    }

    /// How many segments bodies of people can have.
    pub fn divisions() -> Vec<i64> {
        (1..=64).filter(|segments| Division::of(*segments).is_some()).collect()
    }
}

/// Where and how a body sits.
#[derive(Clone, Debug, PartialEq)]
pub struct Seat {
    seating: Seating,
}

impl Seat {
    /// On a cushion, against a back, the heels at x and z of the vehicle, m. The body is lowered until springs and weight balance.
    pub fn new(cushion: SurfaceId, back: SurfaceId, heels_m: [f64; 2]) -> Self {
        let (cushion, back) = (cushion.0, back.0);
        let angles_rad = Vec::new();
        Seat { seating: Seating { cushion, back, lateral_m: 0.0, angles_rad, heels_m, settle: Settling::Locked } }
    }

    /// Beside the middle of the vehicle, m: to the right.
    #[must_use]
    pub fn lateral(mut self, lateral_m: f64) -> Self {
        self.seating.lateral_m = lateral_m;
        self
    }

    /// Leaning back by an angle of a segment, or turned by one of a hinge, rad: `upper_torso`, `elbows`.
    #[must_use]
    pub fn angle(mut self, name: &str, angle_rad: f64) -> Self {
        self.seating.angles_rad.push((name.to_owned(), angle_rad));
        self
    }

    /// What is moved until springs and weight balance.
    #[must_use]
    pub fn settle(mut self, settle: Settling) -> Self {
        self.seating.settle = settle;
        self
    }
}

/// A case that becomes a model. Nothing is checked before [`Case::model`], which reports every problem at once.
#[derive(Clone, Debug)]
pub struct Case {
    setup: Setup,
    /// Its text, as long as nothing was added in code.
    text: Option<Scenario>,
    /// Triggers that look ahead along the path.
    look_ahead: Vec<String>,
    warnings: Vec<Problem>,
}

impl Case {
    /// An occupant in a parked vehicle, nothing to touch.
    pub fn new(title: impl Into<String>, occupant: Occupant) -> Self {
        let mut setup = SetupBuilder::new(title, occupant.body, occupant.joints).setup;
        setup.time.end_s = 0.2;
        Case::from_setup(setup)
    }

    /// Of the simulator's plain data.
    pub fn from_setup(setup: Setup) -> Self {
        Case { setup, text: None, look_ahead: Vec::new(), warnings: Vec::new() }
    }

    /// The case of a scenario's text that names no files.
    ///
    /// # Errors
    /// All that is wrong with it, each with line and column.
    pub fn from_toml(text: &str) -> Result<Self, Error> {
        Case::from_scenario(&Scenario::from_toml(text)?)
    }

    /// The case of a scenario.
    ///
    /// # Errors
    /// All that is wrong with it, each with line and column.
    pub fn from_scenario(scenario: &Scenario) -> Result<Self, Error> {
        let (setup, look_ahead, warnings) = scenario.build()?;
        Ok(Case { setup, text: Some(scenario.clone()), look_ahead, warnings })
    }

    /// The text as TOML of a case that was read from one.
    ///
    /// # Errors
    /// A case built or changed in code: code has no text.
    pub fn to_toml(&self) -> Result<String, Error> {
        match &self.text {
            Some(text) => text.to_toml(),
            None => Err(Error::new(ErrorKind::Text, "a case built or changed in code; expected one read from a text")),
        }
    }

    /// What the text of the case warned of.
    pub fn warnings(&self) -> &[Problem] {
        &self.warnings
    }

    /// The simulator's plain data.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// The same, to be changed.
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
        names().position(|own| own == name).map(SphereId).ok_or_else(|| unknown("sphere", name, names()))
    }

    /// The segment of this name.
    ///
    /// # Errors
    /// A name that no segment of the body has.
    pub fn segment(&self, name: &str) -> Result<SegmentId, Error> {
        let tree = self.setup.body.tree;
        let names = tree.segment_rows().iter().map(|row| row.name);
        tree.segment_named(name).map(SegmentId).ok_or_else(|| unknown("segment", name, names))
    }

    /// The surface of this name.
    ///
    /// # Errors
    /// A name that no surface has.
    pub fn surface_named(&self, name: &str) -> Result<SurfaceId, Error> {
        let names = || self.setup.surfaces.iter().map(|surface| surface.name.as_str());
        names().position(|own| own == name).map(SurfaceId).ok_or_else(|| unknown("surface", name, names()))
    }

    /// Adds a material.
    pub fn material(&mut self, material: Material) -> MaterialId {
        self.setup_mut().materials.push(material);
        MaterialId(self.setup.materials.len() - 1)
    }

    /// Adds a surface of the vehicle that is open towards a point, m.
    pub fn surface(&mut self, name: &str, of: MaterialId, outline: Outline, open_to_m: [f64; 3]) -> SurfaceId {
        let open_to = Point3::from(open_to_m);
        self.any_surface(Surface::new(name, of.0, outline, open_to))
    }

    /// Adds a level ground in space at a height, m.
    pub fn ground(&mut self, name: &str, of: MaterialId, height_m: f64) -> SurfaceId {
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
        SurfaceId(self.setup.surfaces.len() - 1)
    }

    /// Adds a solid of the vehicle that every sphere can touch.
    pub fn solid(&mut self, name: &str, of: MaterialId, shape: Shape) -> SolidId {
        let (name, frame, material) = (name.to_owned(), Frame::Vehicle, of.0);
        self.setup_mut().solids.push(Solid { name, frame, shape, material, group: None, spheres: None });
        SolidId(self.setup.solids.len() - 1)
    }

    /// Moves a surface with a frame.
    pub fn carry(&mut self, surface: SurfaceId, with: FrameId) {
        if let Some(surface) = self.setup_mut().surfaces.get_mut(surface.0) {
            surface.frame = with.frame();
        }
    }

    /// Adds a belt round a sphere, from anchor to anchor, m.
    pub fn belt(&mut self, name: &str, round: SphereId, anchors_m: [[f64; 3]; 2], webbing: BilinearSpring) -> BeltId {
        self.setup_mut().belts.push(Belt::new(name, round.0, anchors_m.map(Point3::from), webbing));
        BeltId(self.setup.belts.len() - 1)
    }

    /// Adds a belt over several nodes.
    pub fn chain(&mut self, chain: Chain) {
        self.setup_mut().chains.push(chain);
    }

    /// Adds an air bag.
    pub fn bag(&mut self, bag: Bag) {
        self.setup_mut().bags.push(bag);
    }

    /// Adds a steering column that gives way; it carries the frame that it names.
    pub fn column(&mut self, column: Column) {
        self.setup_mut().columns.push(column);
    }

    /// Adds another vehicle.
    pub fn vehicle(&mut self, name: &str, path: VehiclePath) -> FrameId {
        self.frame(OtherFrame { name: name.into(), path, parent: None })
    }

    /// Adds a panel that moves against the vehicle and turns about a point of it, m.
    pub fn panel(&mut self, name: &str, path: VehiclePath, about_m: [f64; 3]) -> FrameId {
        self.frame(OtherFrame { name: name.into(), path, parent: Some((Frame::Vehicle, about_m.into())) })
    }

    fn frame(&mut self, frame: OtherFrame) -> FrameId {
        self.setup_mut().frames.push(frame);
        FrameId(self.setup.frames.len() - 1)
    }

    /// Adds a point of a segment whose motion is recorded, from the segment's lower end, m.
    pub fn marker(&mut self, name: &str, of: SegmentId, from_lower_end_m: [f64; 3]) {
        let place_from_lower_end_m = from_lower_end_m.into();
        let marker = Marker { name: name.into(), segment: of.0, place_from_lower_end_m, frame: MarkerFrame::Vehicle };
        self.setup_mut().output.markers.push(marker);
    }

    /// Adds a force of one's own; its channels are `own_force.NAME.*`.
    pub fn force(&mut self, name: &str, force: impl Force + 'static) {
        self.setup_mut().own_forces.push(OwnForce::new(name, force));
    }

    /// Seats the body.
    pub fn seat(&mut self, seat: Seat) {
        self.setup_mut().posture = InitialPosture::Seated(seat.seating);
    }

    /// Lets a body of the report's 12 segments stand upright with hanging arms, the upper end of its middle torso in this place
    /// of space, m.
    pub fn standing_at(&mut self, place_m: [f64; 3]) {
        let mut q = [0.0; DOF];
        q[..3].copy_from_slice(&place_m);
        let coordinates = ReportCoordinates { q, rates: [0.0; DOF] };
        self.setup_mut().posture = InitialPosture::Coordinates(Box::new(coordinates));
    }

    /// Gives the vehicle a path.
    pub fn path(&mut self, path: VehiclePath) {
        self.setup_mut().path = path;
    }

    /// Lets the vehicle go straight ahead, m/s, slowed by a pulse.
    ///
    /// # Errors
    /// A pulse that cannot be.
    pub fn pulse(&mut self, speed_m_s: f64, shape: PulseShape) -> Result<(), Error> {
        self.path(VehiclePath::Pulse(PulsePath::new(PulseDefinition::new(speed_m_s, shape))?));
        Ok(())
    }

    /// Leaves the vehicle's motion to be told on the way: [`Run::push`](crate::Run::push). It begins as `start` says.
    ///
    /// # Errors
    /// A text with triggers that look ahead along its path: of what is not known nothing can be looked at.
    pub fn live(&mut self, start: VehicleState) -> Result<(), Error> {
        if !self.look_ahead.is_empty() {
            let found = format!("triggers that look ahead along the path: {}", self.look_ahead.join(", "));
            return Err(Error::new(ErrorKind::Case, found + "; expected triggers by time, or by what belts do"));
        }
        self.path(VehiclePath::live(start));
        Ok(())
    }

    /// When the run ends, s.
    pub fn ends_at(&mut self, end_s: f64) {
        self.setup_mut().time.end_s = end_s;
    }

    /// How often results are recorded, s.
    pub fn outputs_every(&mut self, interval_s: f64) {
        self.setup_mut().time.output_s = interval_s;
    }

    /// How it is integrated; error control with default tolerances if nobody says.
    pub fn integrator(&mut self, integrator: Integrator) {
        self.setup_mut().integrator = integrator;
    }

    /// The model.
    ///
    /// # Errors
    /// All that is wrong with the case.
    pub fn model(&self) -> Result<Model, Error> {
        Ok(Model::new(self.setup.clone())?)
    }
}
