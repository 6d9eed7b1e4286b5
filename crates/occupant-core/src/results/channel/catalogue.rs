//! The list of channels of a model.

use super::quantity::{Component, Source};
use super::{Axes, Channel};
use crate::body::joint::Joint;
use crate::body::tree::{JointRow, Landmarks};
use crate::body::{Segment, Tree};
use crate::model::Model;
use crate::results::energy::EnergyLedger;
use crash_measures::unit::Unit;

/// All channels of a model, in a fixed order: vehicle, segments, neck and femurs, spheres, belts, joints, energies.
pub fn channels(model: &Model) -> Vec<Channel> {
    let tree = model.body().tree;
    let mut list = List::default();
    list.vehicle();
    for segment in tree.segments() {
        list.segment(segment, tree[segment].name);
    }
    list.neck_and_femurs(tree);
    for (i, sphere) in model.body().spheres.iter().enumerate() {
        list.sphere(i, &sphere.name);
    }
    for (i, belt) in model.setup().belts.iter().enumerate() {
        list.belt(i, &belt.name);
    }
    for joint in tree.joints() {
        list.joint(joint, &tree[joint]);
    }
    list.energies();
    list.0
}

/// A list of channels that grows.
#[derive(Default)]
struct List(Vec<Channel>);

impl List {
    fn vehicle(&mut self) {
        use Source::*;
        let v = Axes::Vehicle;
        let cg = "of the vehicle's centre of gravity";
        self.vector(
            "vehicle.acceleration",
            Unit::MetrePerSecondSquared,
            v,
            &format!("kinematic acceleration {cg}"),
            VehicleAcceleration,
        );
        self.vector("vehicle.velocity", Unit::MetrePerSecond, v, &format!("velocity {cg}"), VehicleVelocity);
        self.vector(
            "vehicle.angular_velocity",
            Unit::RadianPerSecond,
            v,
            "angular velocity of the vehicle",
            VehicleAngularVelocity,
        );
        let space = Axes::VehicleSpace;
        self.vector("vehicle.position", Unit::Metre, space, &format!("place {cg}"), VehiclePosition);
        for (component, name) in [(Component::X, "roll"), (Component::Y, "pitch"), (Component::Z, "yaw")] {
            let meaning = format!("{name} of the vehicle");
            self.push(format!("vehicle.{name}"), Unit::Radian, Axes::None, meaning, VehicleAttitude, component);
        }
    }

    fn segment(&mut self, segment: Segment, name: &str) {
        use Source::*;
        let words = name.replace('_', " ");
        let s = Axes::Segment;
        let mut add = |what: &str, unit, axes, meaning: &str, source| {
            self.vector(&format!("{name}.{what}"), unit, axes, &format!("{meaning} of the {words}"), source);
        };
        add(
            "acceleration",
            Unit::MetrePerSecondSquared,
            s,
            "accelerometer reading (acceleration minus gravity) at the centre of gravity",
            SpecificForce(segment),
        );
        add(
            "kinematic_acceleration",
            Unit::MetrePerSecondSquared,
            s,
            "kinematic acceleration of the centre of gravity",
            Acceleration(segment),
        );
        add("angular_velocity", Unit::RadianPerSecond, s, "absolute angular velocity", AngularVelocity(segment));
        add(
            "angular_acceleration",
            Unit::RadianPerSecondSquared,
            s,
            "angular acceleration",
            AngularAcceleration(segment),
        );
        add(
            "velocity",
            Unit::MetrePerSecond,
            Axes::Vehicle,
            "absolute velocity of the centre of gravity",
            Velocity(segment),
        );
        add("position", Unit::Metre, Axes::Vehicle, "place of the centre of gravity", Position(segment));
    }

    fn neck_and_femurs(&mut self, tree: &Tree) {
        let Landmarks { neck, legs, .. } = tree.landmarks();
        let (force, moment) = (Source::NeckForce(*neck), Source::NeckMoment(*neck));
        self.vector(
            "neck.force",
            Unit::Newton,
            Axes::J211,
            "upper neck force on the head at its joint: +x shear that pushes the head ahead, +z tension",
            force,
        );
        self.vector(
            "neck.moment",
            Unit::NewtonMetre,
            Axes::J211,
            "upper neck moment on the head at its joint: +y in flexion",
            moment,
        );
        for (thigh, name) in [(legs.right.upper, "right_femur"), (legs.left.upper, "left_femur")] {
            let meaning = "axial force at the knee end of the thigh, tension positive".to_owned();
            self.push(format!("{name}.axial"), Unit::Newton, Axes::None, meaning, Source::Femur(thigh), Component::X);
        }
    }

    fn sphere(&mut self, i: usize, name: &str) {
        let v = Axes::Vehicle;
        self.vector(
            &format!("sphere.{name}.position"),
            Unit::Metre,
            v,
            &format!("centre of the sphere {name}"),
            Source::SpherePlace(i),
        );
        self.vector(
            &format!("sphere.{name}.force"),
            Unit::Newton,
            v,
            &format!("all contact forces on the sphere {name}, belts apart"),
            Source::SphereForce(i),
        );
        self.vector(
            &format!("sphere.{name}.belt_force"),
            Unit::Newton,
            v,
            &format!("belt forces on the sphere {name}"),
            Source::SphereBeltForce(i),
        );
        let meaning = format!("greatest contact penetration of the sphere {name}");
        self.push(
            format!("sphere.{name}.penetration"),
            Unit::Metre,
            Axes::None,
            meaning,
            Source::Penetration(i),
            Component::X,
        );
    }

    fn belt(&mut self, i: usize, name: &str) {
        let mut scalar = |what: &str, unit, meaning: &str, source| {
            self.push(
                format!("belt.{name}.{what}"),
                unit,
                Axes::None,
                format!("{meaning} the belt {name}"),
                source,
                Component::X,
            );
        };
        scalar("force", Unit::Newton, "loop force of", Source::LoopForce(i));
        scalar("elongation", Unit::Metre, "elongation of", Source::Elongation(i));
        self.vector(
            &format!("belt.{name}.body_force"),
            Unit::Newton,
            Axes::Vehicle,
            &format!("force on the body of the belt {name}"),
            Source::BeltForce(i),
        );
    }

    fn joint(&mut self, joint: Joint, row: &JointRow) {
        let name = row.name;
        let words = name.replace('_', " ");
        let kind = if row.is_hinge() { "α" } else { "β" };
        self.push(
            format!("joint.{name}.angle"),
            Unit::Radian,
            Axes::None,
            format!("{kind} of the {words}"),
            Source::Angle(joint),
            Component::X,
        );
        let on = "exerts on the distal one, in its axes";
        self.vector(
            &format!("joint.{name}.force"),
            Unit::Newton,
            Axes::Segment,
            &format!("force that the proximal segment of the {words} {on}"),
            Source::JointForce(joint),
        );
        self.vector(
            &format!("joint.{name}.moment"),
            Unit::NewtonMetre,
            Axes::Segment,
            &format!("moment that the proximal segment of the {words} {on}"),
            Source::JointMoment(joint),
        );
    }

    fn energies(&mut self) {
        type Named = (&'static str, &'static str, fn(&EnergyLedger) -> f64);
        let energies: [Named; 12] = [
            ("kinetic", "kinetic energy in space", |e| e.kinetic_j),
            ("kinetic_relative", "kinetic energy of the motion relative to the vehicle", |e| e.kinetic_relative_j),
            ("gravity", "potential energy of gravity, zero at Z′ = 0", |e| e.gravity_j),
            ("spine", "stored in the joints' springs", |e| e.spine_j),
            ("contacts", "stored in contacts", |e| e.contacts_j),
            ("belts", "stored in belts", |e| e.belts_j),
            ("lost_contacts", "dissipated by contacts", |e| e.lost_contacts_j),
            ("lost_friction", "dissipated by friction", |e| e.lost_friction_j),
            ("lost_joints", "dissipated by joints", |e| e.lost_joints_j),
            ("lost_belts", "dissipated by belts", |e| e.lost_belts_j),
            ("vehicle_work", "work of the vehicle on the occupant", |e| e.vehicle_work_j),
            ("balance", "present sum less the sum at the start", |e| e.balance_j),
        ];
        for (name, meaning, of) in energies {
            self.push(
                format!("energy.{name}"),
                Unit::Joule,
                Axes::None,
                meaning.to_owned(),
                Source::Energy(of),
                Component::X,
            );
        }
    }

    /// Three components and the resultant.
    fn vector(&mut self, name: &str, unit: Unit, axes: Axes, meaning: &str, source: Source) {
        for (component, suffix) in Component::ALL {
            let axes = match component {
                Component::Resultant => Axes::None,
                _ => axes,
            };
            let name = format!("{name}.{suffix}");
            self.push(name, unit, axes, meaning.to_owned(), source, component);
        }
    }

    fn push(&mut self, name: String, unit: Unit, axes: Axes, meaning: String, source: Source, component: Component) {
        self.0.push(Channel { name, unit, axes, meaning, source, component });
    }
}
