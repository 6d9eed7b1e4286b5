//! The five reference states of `data/appendix3.json`.

use crate::reference::{DOF, PointForce, System};
use nalgebra::{Point3, Vector3};
use occupant_core::body::Body;
use occupant_core::body::ContactSphere;
use occupant_core::body::SegmentProperties;
use occupant_core::body::tti12::{self, TTI12};
use occupant_core::forces::joint::AngularSpring;
use occupant_core::forces::joint::BallJoint;
use occupant_core::forces::joint::HingeJoint;
use occupant_core::forces::joint::Joints;
use serde::Deserialize;

/// The whole file; index 0 is the report's number 1. Inches, pounds-force, seconds, radians.
#[derive(Deserialize)]
pub struct Golden {
    gravity: f64,
    shoulder_half_width: f64,
    hip_half_width: f64,
    segments: Vec<GoldenSegment>,
    spheres: Vec<GoldenSphere>,
    joint_damping: [f64; 11],
    upper_back_spring: GoldenSpring,
    lower_back_spring: GoldenSpring,
    /// The states.
    pub states: Vec<GoldenState>,
}

#[derive(Deserialize)]
struct GoldenSegment {
    mass: f64,
    length: f64,
    cg_from_lower_end: f64,
    inertia: [f64; 3],
}

#[derive(Deserialize)]
struct GoldenSphere {
    name: String,
    segment: usize,
    centre_from_lower_end: [f64; 3],
    radius: f64,
}

#[derive(Deserialize)]
struct GoldenSpring {
    stiffness: f64,
    rest: f64,
}

/// One state with every term of Eq. 53.
#[derive(Deserialize)]
pub struct GoldenState {
    /// q.
    pub q: Vec<f64>,
    /// q̇.
    pub q_rate: Vec<f64>,
    /// Force on each sphere, space axes.
    pub sphere_force: Vec<[f64; 3]>,
    /// r of each sphere, axes of its segment.
    pub sphere_arm: Vec<[f64; 3]>,
    /// β of joint 4.
    pub upper_back_angle: f64,
    /// β of joint 7.
    pub lower_back_angle: f64,
    /// U.
    pub kinetic_energy: f64,
    /// D.
    pub d: Vec<Vec<f64>>,
    /// E.
    pub e: Vec<f64>,
    /// F_p.
    pub f_p: Vec<f64>,
    /// F_s.
    pub f_s: Vec<f64>,
    /// Q_f.
    pub q_f: Vec<f64>,
    /// R.
    pub r: Vec<f64>,
    /// q̈.
    pub q_acceleration: Vec<f64>,
}

impl Golden {
    /// The file of this crate.
    ///
    /// # Panics
    /// If the file has another shape.
    pub fn load() -> Golden {
        serde_json::from_str(include_str!("../data/appendix3.json")).expect("appendix3.json")
    }

    /// The body, in the file's units.
    pub fn body(&self) -> Body {
        let segment =
            |s: &GoldenSegment| SegmentProperties::new(s.length, s.mass, s.cg_from_lower_end, Vector3::from(s.inertia));
        let sphere = |s: &GoldenSphere| {
            let segment = TTI12.segment(s.segment - 1);
            ContactSphere::new(&s.name, segment, Point3::from(s.centre_from_lower_end), s.radius)
        };
        Body {
            name: "appendix3".to_owned(),
            tree: &TTI12,
            segments: self.segments.iter().map(segment).collect(),
            places: Vec::new(),
            shoulder_half_width_m: self.shoulder_half_width,
            hip_half_width_m: self.hip_half_width,
            neck_height_m: 0.0,
            condyles_m: None,
            spheres: self.spheres.iter().map(sphere).collect(),
            plates: Vec::new(),
            chests: Vec::new(),
            sides: Vec::new(),
        }
    }

    /// The joints without stops, ε = 0.
    pub fn joints(&self) -> Joints {
        let ball = |number: usize, spring: Option<&GoldenSpring>| BallJoint {
            damping_n_m_s: self.joint_damping[number - 1],
            spring: spring.map(|s| AngularSpring { stiffness_n_m: s.stiffness, rest_rad: Some(s.rest) }),
            ..BallJoint::default()
        };
        let hinge =
            |number: usize| HingeJoint { damping_n_m_s: self.joint_damping[number - 1], ..HingeJoint::default() };
        Joints::free(&TTI12)
            .with(tti12::NECK, ball(1, None))
            .with(tti12::RIGHT_SHOULDER, ball(2, None))
            .with(tti12::LEFT_SHOULDER, ball(3, None))
            .with(tti12::UPPER_BACK, ball(4, Some(&self.upper_back_spring)))
            .with(tti12::LEFT_ELBOW, hinge(5))
            .with(tti12::RIGHT_ELBOW, hinge(6))
            .with(tti12::LOWER_BACK, ball(7, Some(&self.lower_back_spring)))
            .with(tti12::RIGHT_HIP, ball(8, None))
            .with(tti12::LEFT_HIP, ball(9, None))
            .with(tti12::RIGHT_KNEE, hinge(10))
            .with(tti12::LEFT_KNEE, hinge(11))
            .with_epsilon(0.0)
    }

    /// Body, joints, gravity and the forces of one state.
    pub fn system(&self, state: &GoldenState) -> System {
        let body = self.body();
        let force = |(i, sphere): (usize, &ContactSphere)| PointForce {
            segment: sphere.segment,
            point: sphere.centre_from_lower_end_m.coords + Vector3::from(state.sphere_arm[i]),
            force: Vector3::from(state.sphere_force[i]),
        };
        System {
            forces: body.spheres.iter().enumerate().map(force).collect(),
            joints: self.joints(),
            gravity: Vector3::new(0.0, 0.0, -self.gravity),
            body,
        }
    }
}

impl GoldenState {
    /// q₁…q₃₁ and their rates.
    pub fn coordinates(&self) -> ([f64; DOF], [f64; DOF]) {
        let array = |v: &[f64]| std::array::from_fn(|j| v[j]);
        (array(&self.q), array(&self.q_rate))
    }
}
