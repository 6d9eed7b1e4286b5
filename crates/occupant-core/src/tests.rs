//! Cases that unit tests of several rooms share, built in code.

#[path = "../examples/case_in_code.rs"]
#[allow(dead_code, reason = "an example's own parts")]
pub(crate) mod case_in_code;

use nalgebra::{Point3, Vector3};

use crate::body::Body;
use crate::body::tti12::UPPER_TORSO;
use crate::forces::chain::{Chain, Cue, Device, NEVER, Node, Pull, Reel, Rest, Site, Track};
use crate::forces::contact::material::Material;
use crate::forces::contact::surface::{Facing, Frame, Outline, Surface};
use crate::forces::function::Function;
use crate::forces::joint::Joints;
use crate::forces::spring::BilinearSpring;
use crate::model::Model;
use crate::model::seating::InitialPosture;
use crate::model::setup::{Setup, SetupBuilder};
use crate::motion::mobility::Mobility;
use crate::motion::report_coordinates::{DOF, ReportCoordinates};
use crate::vehicle::VehiclePath;

/// A body with these coordinates and rates in a parked vehicle.
pub(crate) fn placed(case: SetupBuilder, q: [f64; DOF], rates: [f64; DOF], end_s: f64) -> Setup {
    let posture = InitialPosture::Coordinates(Box::new(ReportCoordinates { q, rates }));
    case.build(VehiclePath::parked(), posture, end_s)
}

/// A body at rest in an irregular posture, over a floor in space at this height, m, if any.
pub(crate) fn crooked(end_s: f64, floor: Option<(f64, Material)>) -> Setup {
    let mut case = SetupBuilder::new("crooked", Body::male50(), Joints::male50());
    if let Some((height_m, material)) = floor {
        let material = case.material(material);
        let outline = Outline::Unbounded { point_m: Point3::new(0.0, 0.0, height_m), axis: Vector3::z() };
        let name = "floor".into();
        case.surface(Surface { name, frame: Frame::Space, outline, facing: Facing::Order, material, spheres: None });
    }
    placed(case, std::array::from_fn(|i| 0.3 + 0.07 * i as f64), [0.0; DOF], end_s)
}

/// A floor of 50 kN/m with a returned fraction of one half.
pub(crate) fn hard(friction: f64) -> Material {
    Material::new("floor", BilinearSpring::linear(50e3, 0.5), friction)
}

/// Height of the lowest point of the spheres of this body, m.
pub(crate) fn lowest_m() -> f64 {
    let model = Model::new(crooked(0.1, None)).unwrap();
    let mobility = Mobility::new(&model.system().skeleton, &model.start().state);
    let bottom = model.body().spheres.iter().enumerate().map(|(i, sphere)| {
        let (_, centre, _) = model.system().sphere(&mobility.kinematics, i);
        centre.z - sphere.radius_m
    });
    bottom.fold(f64::INFINITY, f64::min)
}

/// Belt of the cart's driver over ring, shoulder, chest, buckle and pelvis: its retractor locks at `due_s`, its
/// pretensioner fires 5 ms later and its limiter holds 3 kN.
pub(crate) fn three_point(body: &Body, due_s: f64) -> Chain {
    let vehicle = |inches: [f64; 3]| Site::Vehicle(Point3::from(inches.map(|x| 0.0254 * x)), None);
    let sphere = |name| Site::Sphere(body.sphere(name).unwrap());
    let shoulder = &body.spheres[body.sphere("left_shoulder").unwrap()];
    let (centre, r) = (shoulder.centre_from_lower_end_m, shoulder.radius_m);
    let at =
        |share: f64, beyond: f64, up: f64| Point3::new(0.5 * up * r, share * centre.y + beyond * r, centre.z + up * r);
    let points_m = [at(0.3, 0.0, 0.9), at(0.7, 0.0, 0.9), at(1.0, 0.9, -0.3)];
    let track = Track { points_m, friction: 0.3, drag_n_s_m: 100.0, wing: None, then: None };
    let node = |name: &str, site, friction| Node {
        name: name.to_owned(),
        site,
        friction,
        strength_n: NEVER,
        ride: Vec::new(),
        frame: None,
    };
    let cue = |due_s| Cue { due_s, watch: None };
    let lines = |points: &[[f64; 2]], returned| Function::lines(points.to_vec(), returned);
    let way = vec![[0.0, 0.0], [8e-3, 0.1]];
    let pull = Pull { cue: cue(due_s + 5e-3), table: way, by_force: None, stall_n: 2e3 };
    let reel = Reel { on_spool_m: 0.8, tension_n: 6.0, lock: cue(due_s), lock_after: [0.0; 2], pull: Some(pull) };
    Chain {
        frame: Frame::Vehicle,
        belt: "driver".to_owned(),
        nodes: vec![
            node("reel", vehicle([-18.0, -23.0, 4.0]), 0.0),
            node("ring", vehicle([-18.0, -23.0, -24.0]), 0.1),
            node("shoulder", Site::Track(UPPER_TORSO.index(), track), 0.2),
            node("chest", sphere("chest"), 0.2),
            node("buckle", vehicle([-6.0, -5.0, 9.0]), 0.1),
            node("pelvis", sphere("pelvis"), 0.2),
            node("sill", vehicle([-6.0, -23.0, 9.0]), 0.0),
        ],
        straps: (0..6).map(|i| i.to_string()).collect(),
        webbing: lines(&[[0.0, 0.0], [0.1, 11e3]], 0.8),
        viscous: None,
        rest: Rest::Slack(0.02),
        device: Device {
            limiter: Some(lines(&[[0.0, 0.0], [0.03, 3e3], [0.5, 3e3]], 0.01)),
            second: None,
            reel: Some(reel),
        },
        release: Cue::NEVER,
        strength_n: NEVER,
    }
}
