//! A sphere led by hand through the kernel: prescribed places and velocities, and the load that the surfaces answer with.

use nalgebra::{Point3, Vector3};
use occupant_core::body::ContactSphere;
use occupant_core::body::tti12;
use occupant_core::forces::contact::EdgeForce;
use occupant_core::forces::contact::Touch;
use occupant_core::forces::contact::material::Material;
use occupant_core::forces::contact::surface::Surface;
use occupant_core::forces::{History, Observer};
use occupant_core::kernel::Situation;
use occupant_core::model::Model;
use occupant_core::model::setup::Setup;
use occupant_core::motion::frame::Frames;
use occupant_core::motion::state::State;
use occupant_core::motion::vector::V3;
use occupant_core::vehicle::PathCursor;

use crate::cases::{BEAD_LENGTH_M, afloat, bead, straight};

/// Radius of the probe's sphere, m.
pub const RADIUS_M: f64 = 0.1;

/// A body with one sphere round T1, led by hand.
pub struct Probe {
    model: Model,
    history: History<f64>,
    state: State<f64>,
    frames: Frames<f64>,
}

/// What the surfaces do to the sphere, space axes.
#[derive(Clone, Debug)]
pub struct Load {
    /// Resultant at the centre, N.
    pub force_n: Vector3<f64>,
    /// Moment about the centre, N·m.
    pub moment_n_m: Vector3<f64>,
    /// The touching pairs.
    pub touches: Vec<Touch<f64>>,
}

/// A bead with one sphere of [`RADIUS_M`] round T1 (and its centre of gravity) among `surfaces`.
pub fn bead_among(materials: Vec<Material>, surfaces: Vec<Surface>, edge_force: EdgeForce) -> Setup {
    let mut setup = afloat(bead(0.04), 1.0, 1e-3);
    setup.body.spheres = vec![sphere_round_t1()];
    setup.materials = materials;
    setup.surfaces = surfaces;
    setup.edge_force = edge_force;
    setup
}

/// The probe's sphere.
pub fn sphere_round_t1() -> ContactSphere {
    ContactSphere::new("probe", tti12::MIDDLE_TORSO, Point3::new(0.0, 0.0, BEAD_LENGTH_M), RADIUS_M)
}

impl Probe {
    /// A probe that starts at `centre_m`.
    pub fn new(
        materials: Vec<Material>,
        surfaces: Vec<Surface>,
        edge_force: EdgeForce,
        centre_m: Vector3<f64>,
    ) -> Probe {
        let mut setup = bead_among(materials, surfaces, edge_force);
        setup.posture = straight(centre_m, Vector3::zeros());
        let model = Model::new(setup).unwrap_or_else(|p| panic!("{p}"));
        Probe {
            history: model.start().history.clone(),
            state: model.start().state,
            frames: model.frames(0.0, 0.0, &mut PathCursor::default()),
            model,
        }
    }

    /// Takes the sphere to `centre_m`, at rest, as an accepted step.
    pub fn at(&mut self, centre_m: Vector3<f64>) -> Load {
        self.moving(centre_m, Vector3::zeros(), Vector3::zeros())
    }

    /// Takes the sphere to `centre_m` with a velocity and an angular velocity, as an accepted step.
    pub fn moving(&mut self, centre_m: Vector3<f64>, velocity_m_s: Vector3<f64>, omega_rad_s: Vector3<f64>) -> Load {
        self.place(centre_m, velocity_m_s, omega_rad_s);
        self.evaluate(true)
    }

    /// Asks what would act at `centre_m` within a step, without accepting it.
    pub fn tried_at(&mut self, centre_m: Vector3<f64>) -> Load {
        self.place(centre_m, Vector3::zeros(), Vector3::zeros());
        self.evaluate(false)
    }

    /// State of pair `i`: open, touching or passed.
    pub fn phase(&self, i: usize) -> f64 {
        self.history.memory.contacts[i].phase
    }

    /// Δ_m of pair `i`, m.
    pub fn greatest_m(&self, i: usize) -> f64 {
        self.history.memory.contacts[i].greatest
    }

    /// Number of pairs.
    pub fn pairs(&self) -> usize {
        self.history.memory.contacts.len()
    }

    fn place(&mut self, centre_m: Vector3<f64>, velocity_m_s: Vector3<f64>, omega: Vector3<f64>) {
        self.state.set_t1(V3::of(&centre_m));
        self.state.set_velocity(V3::of(&velocity_m_s));
        self.state.set_omega(0, V3::of(&omega));
    }

    fn evaluate(&mut self, accepted: bool) -> Load {
        let mut touches = Touches(Vec::new());
        let situation = Situation { state: &self.state, frames: &self.frames, accepted };
        let evaluation = self.model.system().evaluate(situation, &mut self.history, &mut touches);
        let wrench = &evaluation.wrench[tti12::MIDDLE_TORSO.index()];
        Load { force_n: wrench.force.to_vector(), moment_n_m: wrench.moment.to_vector(), touches: touches.0 }
    }
}

struct Touches(Vec<Touch<f64>>);

impl Observer<f64> for Touches {
    fn contacts(&mut self, touch: &Touch<f64>) {
        self.0.push(*touch);
    }
}
