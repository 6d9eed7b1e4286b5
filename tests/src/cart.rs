//! The lap-belted occupant on a cart that stops from 20 mph: compartment, joints, belt and pulse.

use nalgebra::{Point3, Vector3};
use occupant_core::body::tti12::{self, TTI12};
use occupant_core::forces::belt::{Belt, RestLength};
use occupant_core::forces::contact::EdgeForce;
use occupant_core::forces::contact::material::Material;
use occupant_core::forces::contact::surface::{Facing, Frame, Outline, Surface};
use occupant_core::forces::joint::{AngularSpring, BallJoint, HingeJoint, Joints, Stop};
use occupant_core::model::seating::{InitialPosture, InitialVelocity, Seating, Settling};
use occupant_core::model::setup::{Allowance, Integrator, OutputOptions, Setup, TimeSpan};
use occupant_core::vehicle::{
    PulseDefinition, PulsePath, PulseShape, Strength, TravelDirection, VehiclePath, VehiclePose,
};

use crate::cases::{INCH_M, LBF_N, male50, spring};

/// Y_v of the driver's middle plane, in.
const DRIVER_IN: f64 = -14.0;
/// Standard gravity as the case has it, m/s².
pub const GRAVITY_M_S2: f64 = 386.04 * INCH_M;

/// The lap case: 0.2 s with outputs every millisecond.
pub fn lap(integrator: Integrator) -> Setup {
    Setup {
        frames: Vec::new(),
        members: Vec::new(),
        scenery: Vec::new(),
        facts: Vec::new(),
        logs: Vec::new(),
        title: "cart, lap belt".into(),
        body: male50(),
        joints: joints(),
        gravity_m_s2: GRAVITY_M_S2,
        materials: materials(),
        surfaces: surfaces(),
        solids: Vec::new(),
        self_contact: None,
        edge_force: EdgeForce::AtContactPoint,
        belts: vec![lap_belt()],
        chains: Vec::new(),
        bags: Vec::new(),
        columns: Vec::new(),
        bands: Vec::new(),
        behind: Vec::new(),
        own_forces: Vec::new(),
        path: path(),
        posture: InitialPosture::Seated(seating()),
        velocity: InitialVelocity::WithVehicle,
        time: TimeSpan {
            start_s: 0.0,
            end_s: 0.2,
            output_s: 1e-3,
            stops_at_rest: false,
            allowance: Allowance::default(),
        },
        integrator,
        output: OutputOptions::default(),
    }
}

/// The driver's posture on the front seat.
pub fn seating() -> Seating {
    Seating {
        cushion: 0,
        back: 1,
        lateral_m: DRIVER_IN * INCH_M,
        angles_rad: Seating::angles(&[
            ("middle_torso", 15_f64.to_radians()),
            ("upper_torso", 18_f64.to_radians()),
            ("head", 5_f64.to_radians()),
            ("lower_torso", 20_f64.to_radians()),
            ("upper_arms", 35_f64.to_radians()),
            ("elbows", (-60_f64).to_radians()),
        ]),
        hands_m: None,
        heels_m: [27.0 * INCH_M, 13.0 * INCH_M],
        settle: Settling::Not,
    }
}

fn materials() -> Vec<Material> {
    // K₁ (lb/in), Δ_b (in), K₂ (lb/in), μ, f
    [
        ("seat", 48.0, 2.0, 270.0, 0.5, 0.8),
        ("dash", 130.0, 0.75, 400.0, 0.4, 0.4),
        ("floor", 300.0, 1.0, 2700.0, 0.3, 0.5),
        ("glass", 300.0, 1.0, 2700.0, 0.3, 0.2),
        ("wheel", 100.0, 2.0, 500.0, 0.3, 0.4),
    ]
    .map(|(name, k1, break_in, k2, mu, friction)| {
        Material::new(name, spring(k1 * LBF_N / INCH_M, break_in * INCH_M, k2 * LBF_N / INCH_M, mu, mu), friction)
    })
    .into()
}

fn inside() -> Point3<f64> {
    Point3::new(5.0, DRIVER_IN, -12.0) * INCH_M
}

/// A rectangle between two edges in X_v, Z_v (in), its half width about Y_v = `middle` (in).
fn panel(name: &str, [a, b]: [(f64, f64); 2], half: f64, middle: f64, material: usize) -> Surface {
    let corner = |(x, z): (f64, f64), side: f64| Point3::new(x, middle + side * half, z) * INCH_M;
    Surface {
        name: name.into(),
        frame: Frame::Vehicle,
        outline: Outline::Polygon(vec![corner(a, -1.0), corner(b, -1.0), corner(b, 1.0), corner(a, 1.0)]),
        facing: Facing::Towards(inside()),
        material,
        spheres: None,
    }
}

fn surfaces() -> Vec<Surface> {
    let tilt = 25_f64.to_radians();
    vec![
        panel("cushion", [(-8.0, 4.0), (12.0, 2.0)], 10.0, DRIVER_IN, 0),
        panel("back", [(-8.0, 4.0), (-15.0, -20.0)], 10.0, DRIVER_IN, 0),
        panel("floor", [(-8.0, 14.0), (29.0, 14.0)], 30.0, 0.0, 2),
        panel("toe board", [(29.0, 14.0), (38.0, 5.0)], 30.0, 0.0, 2),
        panel("panel", [(22.0, -9.0), (22.0, 2.0)], 30.0, 0.0, 1),
        panel("panel top", [(22.0, -9.0), (38.0, -12.0)], 30.0, 0.0, 1),
        panel("windshield", [(38.0, -12.0), (16.0, -32.0)], 28.0, 0.0, 3),
        panel("roof", [(16.0, -32.0), (-20.0, -32.0)], 24.0, 0.0, 3),
        Surface {
            name: "wheel".into(),
            frame: Frame::Vehicle,
            outline: Outline::Disc {
                centre_m: Point3::new(15.0, DRIVER_IN, -13.0) * INCH_M,
                radius_m: 7.5 * INCH_M,
                axis: Vector3::new(-tilt.cos(), 0.0, -tilt.sin()),
            },
            facing: Facing::Towards(inside()),
            material: 4,
            spheres: None,
        },
    ]
}

/// The joints of the cart cases.
pub fn joints() -> Joints {
    let unit = LBF_N * INCH_M;
    let stop = |begin: f64, full: f64, damping: f64| Stop {
        begin_rad: begin.to_radians(),
        full_rad: full.to_radians(),
        damping_n_m_s: damping * unit,
    };
    let ball = |damping: f64, limit: Stop, stiffness: Option<f64>| BallJoint {
        damping_n_m_s: damping * unit,
        twist_damping_n_m_s: 0.0,
        stop: Some(limit),
        spring: stiffness.map(|k| AngularSpring { stiffness_n_m: k * unit, rest_rad: None }),
    };
    let hinge = |lower: Stop, upper: Stop| HingeJoint {
        damping_n_m_s: 6.0 * unit,
        lower_stop: Some(lower),
        upper_stop: Some(upper),
    };
    let shoulder = ball(6.0, stop(170.0, 175.0, 300.0), None);
    let hip = ball(6.0, stop(115.0, 120.0, 600.0), None);
    let elbow = hinge(stop(-125.0, -130.0, 200.0), stop(-15.0, -10.0, 200.0));
    let knee = hinge(stop(5.0, 0.0, 400.0), stop(135.0, 140.0, 400.0));
    Joints::free(&TTI12)
        .with(tti12::NECK, ball(20.0, stop(45.0, 60.0, 120.0), None))
        .with(tti12::RIGHT_SHOULDER, shoulder)
        .with(tti12::LEFT_SHOULDER, shoulder)
        .with(tti12::UPPER_BACK, ball(6.0, stop(30.0, 35.0, 800.0), Some(1000.0)))
        .with(tti12::LEFT_ELBOW, elbow)
        .with(tti12::RIGHT_ELBOW, elbow)
        .with(tti12::LOWER_BACK, ball(6.0, stop(35.0, 40.0, 800.0), Some(1000.0)))
        .with(tti12::RIGHT_HIP, hip)
        .with(tti12::LEFT_HIP, hip)
        .with(tti12::RIGHT_KNEE, knee)
        .with(tti12::LEFT_KNEE, knee)
        .with_epsilon(1e-3)
}

fn lap_belt() -> Belt {
    let anchor = |side: f64| Point3::new(-6.0, DRIVER_IN + side * 9.0, 9.0) * INCH_M;
    Belt {
        frame: Frame::Vehicle,
        name: "lap".into(),
        sphere: 2,
        anchors_m: [anchor(-1.0), anchor(1.0)],
        webbing: spring(400.0 * LBF_N / INCH_M, INCH_M, 900.0 * LBF_N / INCH_M, 1.0, 1.0),
        rest: RestLength::Slack { slack_m: 0.0 },
    }
}

fn path() -> VehiclePath {
    let speed_m_s = 352.0 * INCH_M;
    let pulse = PulsePath::new(PulseDefinition {
        initial: VehiclePose::default(),
        initial_speed_m_s: speed_m_s,
        direction: TravelDirection::Heading,
        starts_at_s: 0.0,
        shape: PulseShape::HalfSine { duration_s: 0.08, strength: Strength::DeltaV(speed_m_s) },
        rebound_m_s: None,
    });
    VehiclePath::Pulse(pulse.expect("a pulse that stops the cart"))
}
