//! Seeded random bodies, joints, states and forces, the same on every machine.
//!
//! Sizes are those of a person in SI units; left and right differ everywhere.

use crate::{
    reference::{DOF, PointForce, SpaceMotion, System},
    space_state::SpaceState,
};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use occupant_core::body::Body;
use occupant_core::body::Segment;
use occupant_core::body::SegmentProperties;
use occupant_core::body::tti12::{self, TTI12};
use occupant_core::forces::joint::AngularSpring;
use occupant_core::forces::joint::BallJoint;
use occupant_core::forces::joint::HingeJoint;
use occupant_core::forces::joint::Joints;
use occupant_core::forces::joint::Stop;
use std::f64::consts::PI;

/// SplitMix64 (Steele, Lea, Flood 2014).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Self {
        Random(seed)
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Evenly in [`from`, `to`).
    pub fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// True in this share of cases.
    pub fn chance(&mut self, share: f64) -> bool {
        self.between(0.0, 1.0) < share
    }

    /// Each component within ±`size`.
    pub fn vector(&mut self, size: f64) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.between(-size, size))
    }

    /// Any orientation.
    pub fn turn(&mut self) -> UnitQuaternion<f64> {
        UnitQuaternion::from_scaled_axis(self.vector(PI))
    }

    /// A body with positive masses and possible inertias, every segment different.
    pub fn body(&mut self) -> Body {
        let segments = TTI12.segments().map(|_| self.segment()).collect();
        let radius: [f64; 17] = std::array::from_fn(|_| self.between(0.03, 0.12));
        let shoulder_half_width_m = self.between(0.1, 0.25);
        let mut body = Body {
            name: "random".to_owned(),
            tree: &TTI12,
            segments,
            places: Vec::new(),
            shoulder_half_width_m,
            hip_half_width_m: self.between(0.05, 0.15),
            neck_height_m: 0.5 * shoulder_half_width_m,
            condyles_m: None,
            spheres: Vec::new(),
            plates: Vec::new(),
            chests: Vec::new(),
            sides: Vec::new(),
        };
        body.spheres = body.standard_spheres(&radius);
        body
    }

    fn segment(&mut self) -> SegmentProperties {
        let length_m = self.between(0.15, 0.5);
        let mass_kg = self.between(1.0, 15.0);
        // Σ m x², Σ m y², Σ m z² of the matter: whatever is positive is possible (triangle inequality).
        let spread = Vector3::from_fn(|_, _| mass_kg * self.between(0.03, 0.15).powi(2));
        let inertia_kg_m2 = Vector3::new(spread.y + spread.z, spread.z + spread.x, spread.x + spread.y);
        SegmentProperties::new(length_m, mass_kg, length_m * self.between(0.2, 0.8), inertia_kg_m2)
    }

    /// Joints with all of damping, twist, stops and springs here and there.
    pub fn joints(&mut self) -> Joints {
        Joints::free(&TTI12)
            .with(tti12::NECK, self.ball())
            .with(tti12::RIGHT_SHOULDER, self.ball())
            .with(tti12::LEFT_SHOULDER, self.ball())
            .with(tti12::UPPER_BACK, self.spring_ball())
            .with(tti12::LEFT_ELBOW, self.hinge())
            .with(tti12::RIGHT_ELBOW, self.hinge())
            .with(tti12::LOWER_BACK, self.spring_ball())
            .with(tti12::RIGHT_HIP, self.ball())
            .with(tti12::LEFT_HIP, self.ball())
            .with(tti12::RIGHT_KNEE, self.hinge())
            .with(tti12::LEFT_KNEE, self.hinge())
            .with_epsilon(self.between(1e-3, 0.05))
    }

    fn ball(&mut self) -> BallJoint {
        let begin_rad = self.between(0.3, 2.0);
        let stop =
            Stop { begin_rad, full_rad: begin_rad + self.between(0.05, 1.0), damping_n_m_s: self.between(5.0, 50.0) };
        BallJoint {
            damping_n_m_s: self.between(0.1, 5.0),
            twist_damping_n_m_s: self.between(0.0, 2.0),
            stop: self.chance(0.7).then_some(stop),
            spring: None,
        }
    }

    fn spring_ball(&mut self) -> BallJoint {
        let spring = AngularSpring { stiffness_n_m: self.between(50.0, 400.0), rest_rad: Some(self.between(0.0, 1.0)) };
        BallJoint { spring: Some(spring), ..self.ball() }
    }

    fn hinge(&mut self) -> HingeJoint {
        let (low, high) = (self.between(-2.5, -0.5), self.between(0.5, 2.5));
        let mut stop = |begin_rad: f64, outward: f64| Stop {
            begin_rad,
            full_rad: begin_rad + outward * self.between(0.05, 1.0),
            damping_n_m_s: self.between(5.0, 50.0),
        };
        let (lower_stop, upper_stop) = (Some(stop(low, -1.0)), Some(stop(high, 1.0)));
        HingeJoint { damping_n_m_s: self.between(0.1, 5.0), lower_stop, upper_stop }
    }

    /// q and q̇ with every free segment at least 0.3 rad from vertical.
    pub fn report_state(&mut self) -> ([f64; DOF], [f64; DOF]) {
        let mut q: [f64; DOF] = std::array::from_fn(|_| self.between(-PI, PI));
        for theta in [5, 8, 11, 14, 17, 20, 25, 28] {
            q[theta - 1] = self.between(0.3, PI - 0.3);
        }
        let rates = std::array::from_fn(|_| self.between(-8.0, 8.0));
        (q, rates)
    }

    /// Any state.
    pub fn space_state(&mut self) -> SpaceState {
        SpaceState {
            t1: self.vector(3.0),
            turn: std::array::from_fn(|_| self.turn()),
            hinge: std::array::from_fn(|_| self.between(-2.5, 2.5)),
            speed: self.speed(),
        }
    }

    /// A state at a singular posture of the report's coordinates: most free segments exactly vertical, all of them either
    /// upright or head down.
    ///
    /// Two neighbours folded back by exactly 180° are left out: there the sign of β̇, and with it a stop, is undecided.
    pub fn vertical_state(&mut self) -> SpaceState {
        let mut state = self.space_state();
        let head_down = self.chance(0.3);
        for (slot, turn) in state.turn.iter_mut().enumerate() {
            if slot == 0 || self.chance(0.7) {
                *turn = self.vertical_turn(head_down);
            }
        }
        state
    }

    fn vertical_turn(&mut self, head_down: bool) -> UnitQuaternion<f64> {
        let yaw = UnitQuaternion::from_scaled_axis(Vector3::z() * self.between(-PI, PI));
        let half_turn = Quaternion::new(0.0, 1.0, 0.0, 0.0);
        match head_down {
            true => yaw * UnitQuaternion::new_unchecked(half_turn),
            false => yaw,
        }
    }

    fn speed(&mut self) -> SpaceMotion {
        SpaceMotion {
            t1: self.vector(10.0),
            angular: std::array::from_fn(|_| self.vector(8.0)),
            hinge: std::array::from_fn(|_| self.between(-8.0, 8.0)),
        }
    }

    /// A force on the surface of every sphere.
    pub fn forces(&mut self, body: &Body) -> Vec<PointForce> {
        let mut force = |segment: Segment, centre: Vector3<f64>, radius: f64| PointForce {
            segment,
            point: centre + self.turn() * Vector3::z() * radius,
            force: self.vector(2000.0),
        };
        let spheres = body.spheres.iter();
        spheres.map(|s| force(s.segment, s.centre_from_lower_end_m.coords, s.radius_m)).collect()
    }

    /// Body, joints, forces and the earth's gravity.
    pub fn system(&mut self) -> System {
        let body = self.body();
        System { joints: self.joints(), gravity: Vector3::new(0.0, 0.0, -9.806_65), forces: self.forces(&body), body }
    }
}
