//! A [`Setup`] put together in code.

use crate::body::Body;
use crate::forces::belt::Belt;
use crate::forces::contact::EdgeForce;
use crate::forces::contact::material::Material;
use crate::forces::contact::surface::Surface;
use crate::forces::joint::Joints;
use crate::model::seating::{InitialPosture, InitialVelocity};
use crate::model::setup::{DEFAULT_OUTPUT_S, Integrator, OutputOptions, STANDARD_GRAVITY_M_S2, Setup, TimeSpan};
use crate::vehicle::VehiclePath;

/// Puts a [`Setup`] together. What is not said is as in a scenario that does not say it: the fields start with its defaults.
#[derive(Clone, Debug)]
pub struct SetupBuilder {
    title: String,
    body: Body,
    joints: Joints,
    materials: Vec<Material>,
    surfaces: Vec<Surface>,
    belts: Vec<Belt>,
    /// g, along −Z′, m/s².
    pub gravity_m_s2: f64,
    /// Where the edge force acts.
    pub edge_force: EdgeForce,
    /// Velocity of a seated body at the start.
    pub velocity: InitialVelocity,
    /// Start of the run, s.
    pub start_s: f64,
    /// Time between two outputs, s.
    pub output_s: f64,
    /// Integrator.
    pub integrator: Integrator,
    /// Extra outputs.
    pub output: OutputOptions,
}

impl SetupBuilder {
    /// A case with this occupant, without belts and with nothing to touch.
    pub fn new(title: impl Into<String>, body: Body, joints: Joints) -> Self {
        SetupBuilder {
            title: title.into(),
            body,
            joints,
            materials: Vec::new(),
            surfaces: Vec::new(),
            belts: Vec::new(),
            gravity_m_s2: STANDARD_GRAVITY_M_S2,
            edge_force: EdgeForce::default(),
            velocity: InitialVelocity::default(),
            start_s: 0.0,
            output_s: DEFAULT_OUTPUT_S,
            integrator: Integrator::default(),
            output: OutputOptions::default(),
        }
    }

    /// Adds a material and gives its index, which surfaces refer to.
    pub fn material(&mut self, material: Material) -> usize {
        self.materials.push(material);
        self.materials.len() - 1
    }

    /// Adds a surface and gives its index, which a [`Seating`](crate::model::seating::Seating) refers to.
    pub fn surface(&mut self, surface: Surface) -> usize {
        self.surfaces.push(surface);
        self.surfaces.len() - 1
    }

    /// Adds a belt.
    pub fn belt(&mut self, belt: Belt) {
        self.belts.push(belt);
    }

    /// The setup: this occupant in a vehicle that moves along `path`, from `posture` until `end_s`.
    ///
    /// Nothing is checked here: [`Model::new`](crate::model::Model::new) reports all problems at once.
    pub fn build(self, path: VehiclePath, posture: InitialPosture, end_s: f64) -> Setup {
        Setup {
            title: self.title,
            body: self.body,
            joints: self.joints,
            gravity_m_s2: self.gravity_m_s2,
            materials: self.materials,
            surfaces: self.surfaces,
            edge_force: self.edge_force,
            belts: self.belts,
            path,
            posture,
            velocity: self.velocity,
            time: TimeSpan { start_s: self.start_s, end_s, output_s: self.output_s },
            integrator: self.integrator,
            output: self.output,
        }
    }
}
