//! Random planes in space and in a vehicle that moves anyhow, and what they do to the spheres by the plain formulas.

use crate::{
    random::Random,
    reference::{DOF, Dual, PointForce, System, pose},
};
use nalgebra::{Matrix3, Point3, Rotation3, Vector3};
use occupant_core::Problems;
use occupant_core::forces::contact::ContactData;
use occupant_core::forces::contact::ContactSystem;
use occupant_core::forces::contact::EdgeForce;
use occupant_core::forces::contact::OPEN;
use occupant_core::forces::contact::PairHistory;
use occupant_core::forces::contact::flat_face::FlatFace;
use occupant_core::forces::contact::material::Material;
use occupant_core::forces::contact::surface::Facing;
use occupant_core::forces::contact::surface::Frame;
use occupant_core::forces::contact::surface::Outline;
use occupant_core::forces::contact::surface::Surface;
use occupant_core::forces::joint::JointSystem;
use occupant_core::forces::sphere::Site;
use occupant_core::forces::spring::BilinearSpring;
use occupant_core::forces::{Forces, History, Memory};
use occupant_core::kernel;
use occupant_core::motion::frame::Frames;
use occupant_core::motion::frame::{Moving, VEHICLE};
use occupant_core::motion::skeleton::Skeleton;
use occupant_core::motion::vector::M3;
use occupant_core::motion::vector::V3;

/// A frame's motion: origin, axes as columns, velocity, angular velocity; all in space.
#[derive(Clone, Copy, Debug)]
pub struct FrameState {
    /// Place of the origin.
    pub origin: Vector3<f64>,
    /// Axes.
    pub axes: Matrix3<f64>,
    /// Velocity of the origin.
    pub velocity: Vector3<f64>,
    /// Angular velocity.
    pub omega: Vector3<f64>,
}

/// Planes and their frames.
#[derive(Clone, Debug)]
pub struct Compartment {
    /// Unbounded planes, material by index.
    pub surfaces: Vec<Surface>,
    /// Materials.
    pub materials: Vec<Material>,
    /// The vehicle.
    pub vehicle: FrameState,
}

impl Compartment {
    /// Two planes in the vehicle and one in space.
    pub fn random(random: &mut Random) -> Compartment {
        let surfaces = [Frame::Vehicle, Frame::Vehicle, Frame::Space];
        let surface = |(i, frame)| Surface {
            name: format!("plane {i}"),
            frame,
            outline: Outline::Unbounded {
                point_m: Point3::from(random.vector(0.5)),
                axis: random.turn() * Vector3::z(),
            },
            facing: Facing::Order,
            material: i,
            spheres: None,
        };
        let surfaces: Vec<_> = surfaces.into_iter().enumerate().map(surface).collect();
        Compartment {
            materials: (0..3).map(|_| material(random)).collect(),
            surfaces,
            vehicle: FrameState {
                origin: random.vector(1.0),
                axes: random.turn().to_rotation_matrix().into_inner(),
                velocity: random.vector(10.0),
                omega: random.vector(5.0),
            },
        }
    }

    /// Motion of the frame that surface `index` is fixed to.
    pub fn frame(&self, index: usize) -> FrameState {
        match self.surfaces[index].frame {
            Frame::Vehicle => self.vehicle,
            _ => FrameState {
                origin: Vector3::zeros(),
                axes: Matrix3::identity(),
                velocity: Vector3::zeros(),
                omega: Vector3::zeros(),
            },
        }
    }

    /// The kernel's constants of `system` in this compartment, with pairs that have not touched yet.
    pub fn kernel(&self, system: &System) -> (kernel::System<f64>, Frames<f64>, History<f64>) {
        let mut problems = Problems::new();
        let face = |s| FlatFace::new(s, "", &mut problems);
        let faces: Vec<_> = self.surfaces.iter().filter_map(face).collect();
        assert!(problems.is_empty(), "{problems}");
        let data = ContactData {
            surfaces: &self.surfaces,
            faces: &faces,
            solids: &[],
            behind: &[],
            self_contact: None,
            materials: &self.materials,
            edge_force: EdgeForce::AtContactPoint,
            longest_step_s: 1e-3,
        };
        let skeleton = Skeleton::new(&system.body, -system.gravity.z);
        let forces = Forces {
            plates: Default::default(),
            contacts: ContactSystem::new(&system.body, &data),
            belts: Vec::new(),
            chains: Vec::new(),
            bags: Vec::new(),
            own: Default::default(),
            columns: Vec::new(),
            hinges: Vec::new(),
            joints: JointSystem::new(&system.joints, &skeleton, |_| f64::NAN),
            limits: Vec::new(),
            muscles: Vec::new(),
        };
        let untouched = PairHistory { phase: OPEN, greatest: 0.0 };
        let contacts = vec![untouched; forces.contacts.pairs.len()];
        let history = History::new(&forces, Memory { contacts, ..Memory::none() });
        let vehicle = Moving {
            origin: V3::of(&self.vehicle.origin),
            axes: M3::of(&self.vehicle.axes),
            velocity: V3::of(&self.vehicle.velocity),
            omega: V3::of(&self.vehicle.omega),
            ..Moving::space()
        };
        let kernel = kernel::System::new(skeleton, Site::all(&system.body), forces);
        let mut frames = Frames::still(0.0);
        frames[VEHICLE] = vehicle;
        (kernel, frames, history)
    }

    /// The same compartment in a scene turned by `r`; it must have no plane in space.
    pub fn turned(&self, r: &Rotation3<f64>) -> Compartment {
        assert!(self.surfaces.iter().all(|s| s.frame == Frame::Vehicle));
        let v = self.vehicle;
        Compartment {
            vehicle: FrameState {
                origin: r * v.origin,
                axes: r * v.axes,
                velocity: r * v.velocity,
                omega: r * v.omega,
            },
            ..self.clone()
        }
    }

    /// Forces of all planes on all spheres that are in them for the first time: Eqs 84–94 and regularised friction.
    pub fn forces(&self, system: &System, q: &[f64; DOF], rates: &[f64; DOF]) -> Vec<ContactForce> {
        let mut found = Vec::new();
        for sphere in 0..system.body.spheres.len() {
            for surface in 0..self.surfaces.len() {
                found.extend(self.force(system, sphere, surface, q, rates));
            }
        }
        found
    }

    fn force(
        &self,
        system: &System,
        sphere: usize,
        surface: usize,
        q: &[f64; DOF],
        rates: &[f64; DOF],
    ) -> Option<ContactForce> {
        let sphere = &system.body.spheres[sphere];
        let frame = self.frame(surface);
        let Outline::Unbounded { point_m, axis } = &self.surfaces[surface].outline else {
            return None;
        };
        let material = &self.materials[self.surfaces[surface].material];
        let normal = frame.axes * axis;
        let on_plane = frame.origin + frame.axes * point_m.coords;

        let i = sphere.segment.index();
        let pose = pose(&system.body, q);
        let columns = [pose.axes[i].x, pose.axes[i].y, pose.axes[i].z].map(Vector3::from);
        let turn = Matrix3::from_columns(&columns);
        let end = Vector3::from(pose.lower_end[i]);
        let centre = end + turn * sphere.centre_from_lower_end_m.coords;
        let depth = sphere.radius_m - normal.dot(&(centre - on_plane)); // (91), (92)
        if depth <= 0.0 {
            return None;
        }
        let point = centre - normal * sphere.radius_m; // A
        let at = turn.tr_mul(&(point - end));
        let velocity = point_velocity(system, i, &at, q, rates);
        let carried = frame.velocity + frame.omega.cross(&(point - frame.origin));
        let relative = velocity - carried;
        let slip = relative - normal * normal.dot(&relative);
        let spring = material.force.bilinear().expect("the cases have springs");
        let soft = depth.min(spring.break_m) * spring.k1_n_per_m;
        let press = soft + (depth - spring.break_m).max(0.0) * spring.k2_n_per_m;
        let speed = slip.norm_squared() + material.friction_speed_m_s.powi(2);
        let force = normal * press - slip * (material.friction * press / speed.sqrt());
        Some(ContactForce {
            force: PointForce { segment: sphere.segment, point: at, force },
            power: force.dot(&velocity),
            friction_loss: -(force - normal * press).dot(&slip),
            carried_power: force.dot(&carried),
        })
    }
}

/// A contact force with its powers.
#[derive(Clone, Debug)]
pub struct ContactForce {
    /// The force at A.
    pub force: PointForce,
    /// F·v of A.
    pub power: f64,
    /// What friction dissipates.
    pub friction_loss: f64,
    /// F·v of the surface at A.
    pub carried_power: f64,
}

/// Velocity of a point of a segment: the slope of its place along q̇.
fn point_velocity(
    system: &System,
    segment: usize,
    at: &Vector3<f64>,
    q: &[f64; DOF],
    rates: &[f64; DOF],
) -> Vector3<f64> {
    let moving = std::array::from_fn(|j| Dual::new(q[j], rates[j]));
    let pose = pose(&system.body, &moving);
    let axes = pose.axes[segment];
    let point = pose.lower_end[segment] + at.x * axes.x + at.y * axes.y + at.z * axes.z;
    Vector3::from(point.slope())
}

fn material(random: &mut Random) -> Material {
    let spring = BilinearSpring {
        k1_n_per_m: random.between(1e3, 1e4),
        k2_n_per_m: random.between(1e4, 5e4),
        break_m: random.between(0.02, 0.5),
        returned_1: random.between(0.1, 1.0),
        returned_2: random.between(0.1, 1.0),
    };
    let plain = Material::new("random", spring, random.between(0.1, 1.0));
    Material { friction_speed_m_s: random.between(0.05, 1.0), ..plain }
}
