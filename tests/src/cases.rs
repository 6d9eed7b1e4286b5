//! Bodies, materials, surfaces and whole cases, built in code from published figures.

use nalgebra::{Point3, Vector3};
use occupant_core::body::tti12::TTI12;
use occupant_core::body::{Body, SEGMENTS, SegmentProperties};
use occupant_core::forces::belt::{Belt, RestLength};
use occupant_core::forces::contact::EdgeForce;
use occupant_core::forces::contact::material::Material;
use occupant_core::forces::contact::surface::{Facing, Frame, Outline, Surface};
use occupant_core::forces::joint::Joints;
use occupant_core::forces::spring::BilinearSpring;
use occupant_core::model::seating::{InitialPosture, InitialVelocity};
use occupant_core::model::setup::{Allowance, Integrator, OutputOptions, Setup, TimeSpan};
use occupant_core::motion::report_coordinates::{DOF, ReportCoordinates};
use occupant_core::vehicle::{FixedPath, VehiclePath, VehiclePose};

/// Metres in an inch.
pub const INCH_M: f64 = 0.0254;
/// Newtons in a pound-force.
pub const LBF_N: f64 = 4.448_221_615_260_5;

/// The 50th-percentile male of the United States Air Force's GEBOD generator, in 12 segments.
pub fn male50() -> Body {
    // length, ρ (in), weight (lb), I_x, I_y, I_z (lb·in·s²)
    let figures = [
        (3.08, 2.25, 5.10, 0.1448, 0.0809, 0.2189),
        (11.34, 6.99, 52.87, 4.2574, 3.2111, 2.8241),
        (13.71, 7.94, 11.55, 0.2728, 0.3336, 0.1892),
        (3.76, 1.52, 24.87, 0.9202, 0.8451, 1.0672),
        (10.26, 5.04, 4.21, 0.1141, 0.1213, 0.0236),
        (10.26, 5.04, 4.21, 0.1141, 0.1213, 0.0236),
        (16.28, 9.20, 4.05, 0.2667, 0.2654, 0.0154),
        (16.28, 9.20, 4.05, 0.2667, 0.2654, 0.0154),
        (17.35, 9.80, 21.03, 1.3844, 1.4593, 0.3829),
        (17.35, 9.80, 21.03, 1.3844, 1.4593, 0.3829),
        (19.45, 10.31, 10.29, 1.0495, 1.1301, 0.1420),
        (19.45, 10.31, 10.29, 1.0495, 1.1301, 0.1420),
    ];
    let segment = |(l, rho, weight, ix, iy, iz): (f64, f64, f64, f64, f64, f64)| {
        let mass_kg = weight / 386.04 * LBF_N / INCH_M;
        SegmentProperties::new(l * INCH_M, mass_kg, rho * INCH_M, Vector3::new(ix, iy, iz) * (LBF_N * INCH_M))
    };
    let segments = figures.map(segment).to_vec();
    let radius_m =
        [3.9, 4.8, 4.7, 2.5, 2.5, 2.0, 2.0, 1.8, 1.8, 3.4, 3.4, 2.4, 2.4, 2.3, 2.3, 1.9, 1.9].map(|r| r * INCH_M);
    let mut body = Body {
        name: "male50-1970".into(),
        tree: &TTI12,
        segments,
        places: Vec::new(),
        shoulder_half_width_m: 6.57 * INCH_M,
        hip_half_width_m: 3.35 * INCH_M,
        neck_height_m: 0.0,
        condyles_m: None,
        spheres: Vec::new(),
        plates: Vec::new(),
        chests: Vec::new(),
        sides: Vec::new(),
    };
    body.spheres = body.standard_spheres(&radius_m);
    body
}

/// `male50` without width: standing straight, all its joints and centres of gravity lie on one vertical line, so that
/// vertical forces on that line move it as one point mass, exactly.
pub fn pillar() -> Body {
    Body { name: "pillar".into(), shoulder_half_width_m: 0.0, hip_half_width_m: 0.0, ..male50() }
}

/// Length of the bead's heavy segment, m; its centre of gravity is its upper end, T1.
pub const BEAD_LENGTH_M: f64 = 0.2;

/// One heavy segment, 10 kg with its centre of gravity at T1, and eleven that weigh a part in 10⁹ of it.
pub fn bead(inertia_kg_m2: f64) -> Body {
    let light = SegmentProperties::new(0.1, 1e-8, 0.05, Vector3::repeat(1e-10));
    let mut segments = vec![light; SEGMENTS];
    segments[0] = SegmentProperties::new(BEAD_LENGTH_M, 10.0, BEAD_LENGTH_M, Vector3::repeat(inertia_kg_m2));
    Body {
        name: "bead".into(),
        tree: &TTI12,
        segments,
        places: Vec::new(),
        shoulder_half_width_m: 0.0,
        hip_half_width_m: 0.0,
        neck_height_m: 0.0,
        condyles_m: None,
        spheres: Vec::new(),
        plates: Vec::new(),
        chests: Vec::new(),
        sides: Vec::new(),
    }
}

/// A vehicle at rest at the origin of space.
pub fn parked() -> VehiclePath {
    VehiclePath::Fixed(FixedPath::new(VehiclePose::default()).expect("a finite pose"))
}

/// A body afloat in space: straight, upright, at rest, T1 at the origin; free joints, no gravity, nothing to touch.
pub fn afloat(body: Body, end_s: f64, step_s: f64) -> Setup {
    Setup {
        frames: Vec::new(),
        members: Vec::new(),
        scenery: Vec::new(),
        facts: Vec::new(),
        logs: Vec::new(),
        title: "afloat".into(),
        body,
        joints: Joints::free(&TTI12),
        gravity_m_s2: 0.0,
        materials: Vec::new(),
        surfaces: Vec::new(),
        solids: Vec::new(),
        self_contact: None,
        edge_force: EdgeForce::AtContactPoint,
        belts: Vec::new(),
        chains: Vec::new(),
        bags: Vec::new(),
        columns: Vec::new(),
        bands: Vec::new(),
        behind: Vec::new(),
        own_forces: Vec::new(),
        path: parked(),
        posture: straight(Vector3::zeros(), Vector3::zeros()),
        velocity: InitialVelocity::WithVehicle,
        time: TimeSpan { start_s: 0.0, end_s, output_s: end_s, stops_at_rest: false, allowance: Allowance::default() },
        integrator: Integrator::Rk4 { step_s },
        output: OutputOptions::default(),
    }
}

/// Upright, all segments in line, T1 at a place (m) with a velocity (m/s), space axes.
pub fn straight(t1_m: Vector3<f64>, velocity_m_s: Vector3<f64>) -> InitialPosture {
    let (mut q, mut rates) = ([0.0; DOF], [0.0; DOF]);
    q[..3].copy_from_slice(t1_m.as_slice());
    rates[..3].copy_from_slice(velocity_m_s.as_slice());
    InitialPosture::Coordinates(Box::new(ReportCoordinates { q, rates }))
}

/// A bilinear spring.
pub fn spring(k1: f64, break_m: f64, k2: f64, mu1: f64, mu2: f64) -> BilinearSpring {
    BilinearSpring { k1_n_per_m: k1, k2_n_per_m: k2, break_m, returned_1: mu1, returned_2: mu2 }
}

/// A material of that spring, without friction, that forgets its crush.
pub fn smooth(spring: BilinearSpring) -> Material {
    Material::new("smooth", spring, 0.0)
}

/// The whole plane through the origin of space with normal `axis`, of material 0.
pub fn plane(axis: Vector3<f64>) -> Surface {
    Surface {
        name: "plane".into(),
        frame: Frame::Space,
        outline: Outline::Unbounded { point_m: Point3::origin(), axis },
        facing: Facing::Order,
        material: 0,
        spheres: None,
    }
}

/// A rectangle in the plane Z′ = 0 of space, facing up, of material 0.
pub fn rectangle(name: &str, x_m: [f64; 2], y_m: [f64; 2]) -> Surface {
    let corner = |x: f64, y: f64| Point3::new(x, y, 0.0);
    Surface {
        name: name.into(),
        frame: Frame::Space,
        outline: Outline::Polygon(vec![
            corner(x_m[0], y_m[0]),
            corner(x_m[1], y_m[0]),
            corner(x_m[1], y_m[1]),
            corner(x_m[0], y_m[1]),
        ]),
        facing: Facing::Order,
        material: 0,
        spheres: None,
    }
}

/// A belt round sphere 0 with a straight-line webbing of stiffness `k`, N/m.
pub fn belt(anchors_m: [Point3<f64>; 2], k: f64, slack_m: f64) -> Belt {
    Belt {
        frame: Frame::Vehicle,
        name: "belt".into(),
        sphere: 0,
        anchors_m,
        webbing: spring(k, 0.05, k, 1.0, 1.0),
        rest: RestLength::Slack { slack_m },
    }
}
