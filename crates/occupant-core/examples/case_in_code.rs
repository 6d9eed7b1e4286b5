//! A case built in code, without a text: a driver in lap and torso belt, in the cart of `scenarios/cart-lap-torso.toml` that
//! stops from 20 mph. A test holds it to the text: with the body of the text it gives the same bits.
//!
//! Vehicle axes: x forward, y right, z down. The crate takes SI units only; the drawings are in inches and pounds.
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use std::error::Error;

use nalgebra::Point3;
use occupant_core::body::Body;
use occupant_core::forces::belt::Belt;
use occupant_core::forces::contact::EdgeForce;
use occupant_core::forces::contact::material::Material;
use occupant_core::forces::contact::surface::{Frame, Outline, Surface};
use occupant_core::forces::joint::Joints;
use occupant_core::forces::spring::BilinearSpring;
use occupant_core::model::Model;
use occupant_core::model::seating::{InitialPosture, Seating, Settling};
use occupant_core::model::setup::{Integrator, Setup, SetupBuilder};
use occupant_core::results::summary::Summarizer;
use occupant_core::run::simulate::simulate;
use occupant_core::vehicle::{PulseDefinition, PulsePath, PulseShape, Strength, VehiclePath};

const INCH_M: f64 = 0.0254;
const LBF_PER_INCH: f64 = 4.448_221_615_260_5 / INCH_M;
const MPH_M_S: f64 = 0.447_04;
/// The driver's middle plane, in: left of the car's.
const DRIVER_Y: f64 = -14.0;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let model = Model::new(cart()?)?;
    let mut summarizer = Summarizer::new();
    simulate(&model, &mut summarizer)?;
    let summary = summarizer.summary(None).ok_or("the run did not end")?;
    println!("{}", summary.title);
    let (head, chest) = (summary.accelerations.head, summary.accelerations.chest);
    println!("  head  {:4.1} g at {:5.1} ms", head.peak_g, 1e3 * head.peak_time_s);
    println!("  chest {:4.1} g at {:5.1} ms", chest.peak_g, 1e3 * chest.peak_time_s);
    for belt in ["lap", "torso"] {
        let force_n = summary.elements["belts"].number(belt, "loop_force_n").unwrap_or(0.0);
        println!("  {belt} belt {:.1} kN", 1e-3 * force_n);
    }
    Ok(())
}

/// The whole case.
pub(crate) fn cart() -> Result<Setup, Box<dyn Error>> {
    let body = Body::male50();
    let (pelvis, chest) = (body.sphere("pelvis").ok_or("no pelvis")?, body.sphere("chest").ok_or("no chest")?);
    let mut case = SetupBuilder::new("Cart, 20 mph, lap and torso belt", body, Joints::male50());
    // as in the report, where all of a contact force acts there
    case.setup.edge_force = EdgeForce::AtContactPoint;
    case.setup.gravity_m_s2 = 386.04 * INCH_M;
    case.setup.integrator = Integrator::Rk4 { step_s: 1e-4 };

    // Materials: lbf/in up to a deformation in inches, then lbf/in; fraction of the energy that comes back; friction.
    let mut material = |name, k1, break_in, k2, returned, friction| {
        case.material(Material::new(name, spring(k1, break_in, k2, returned), friction))
    };
    let seat = material("seat", 48.0, 2.0, 270.0, 0.5, 0.8);
    let dash = material("dash", 130.0, 0.75, 400.0, 0.4, 0.4);
    let floor = material("floor", 300.0, 1.0, 2700.0, 0.3, 0.5);
    let glass = material("glass", 300.0, 1.0, 2700.0, 0.3, 0.2);
    let rim = material("steering_wheel", 100.0, 2.0, 500.0, 0.3, 0.4);

    // Surfaces: a line x, z seen from the side and half a width; all are open towards a point before the driver's chest.
    let inside = inches([5.0, DRIVER_Y, -12.0]);
    let mut strip = |name, material, edge: [[f64; 2]; 2], y: f64, half_width: f64| {
        let (edge_m, half_m) = (edge.map(|end| end.map(|x| x * INCH_M)), half_width * INCH_M);
        case.surface(Surface::new(name, material, Outline::strip(edge_m, y * INCH_M, half_m, half_m), inside))
    };
    let cushion = strip("front_cushion", seat, [[-8.0, 4.0], [12.0, 2.0]], DRIVER_Y, 10.0);
    let back = strip("front_seat_back", seat, [[-8.0, 4.0], [-15.0, -20.0]], DRIVER_Y, 10.0);
    strip("floor", floor, [[-8.0, 14.0], [29.0, 14.0]], 0.0, 30.0);
    strip("toe_board", floor, [[29.0, 14.0], [38.0, 5.0]], 0.0, 30.0);
    strip("panel_face", dash, [[22.0, -9.0], [22.0, 2.0]], 0.0, 30.0);
    strip("panel_top", dash, [[22.0, -9.0], [38.0, -12.0]], 0.0, 30.0);
    strip("windshield", glass, [[38.0, -12.0], [16.0, -32.0]], 0.0, 28.0);
    strip("roof", glass, [[16.0, -32.0], [-20.0, -32.0]], 0.0, 24.0);
    let wheel = Outline::wheel(Frame::Vehicle, inches([15.0, DRIVER_Y, -13.0]), 15.0 * INCH_M, 25_f64.to_radians());
    case.surface(Surface::new("steering_wheel", rim, wheel, inside));

    let buckle = inches([-6.0, -5.0, 9.0]);
    let anchors = [inches([-6.0, -23.0, 9.0]), buckle];
    case.belt(Belt::new("lap", pelvis, anchors, spring(400.0, 1.0, 900.0, 1.0)));
    let anchors = [inches([-18.0, -23.0, -20.0]), buckle];
    case.belt(Belt::new("torso", chest, anchors, spring(250.0, 1.5, 600.0, 1.0)));

    let posture = InitialPosture::Seated(Seating {
        cushion,
        back,
        lateral_m: DRIVER_Y * INCH_M,
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
    });
    Ok(case.build(stop_from(20.0 * MPH_M_S)?, posture, 0.2))
}

/// A half sine of 80 ms that takes away the whole speed.
pub(crate) fn stop_from(speed_m_s: f64) -> Result<VehiclePath, Box<dyn Error>> {
    let shape = PulseShape::HalfSine { strength: Strength::DeltaV(speed_m_s), duration_s: 0.08 };
    let path = PulsePath::new(PulseDefinition::new(speed_m_s, shape));
    Ok(VehiclePath::Pulse(path.map_err(|problems| format!("{problems:?}"))?))
}

fn spring(k1: f64, break_in: f64, k2: f64, returned: f64) -> BilinearSpring {
    BilinearSpring::linear(k1 * LBF_PER_INCH, returned).then(break_in * INCH_M, k2 * LBF_PER_INCH)
}

fn inches(point: [f64; 3]) -> Point3<f64> {
    Point3::from(point.map(|x| x * INCH_M))
}
