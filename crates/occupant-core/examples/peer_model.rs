//! The benchmarks' occupant as plain numbers, and our own accelerations of it: what other engines are built from and
//! checked against (`benches/peers`). Prints JSON; SI, space axes, quaternions as w, x, y, z.
//!
//! The state is that of the crash at its timed instant, with every angular velocity raised, so that gyroscopic terms
//! weigh as much as gravity. The accelerations are those of the free body: gravity, no contact, no belt, free joints.

#[path = "../benches/scene/mod.rs"]
mod scene;

use occupant_core::body::{SEGMENTS, Segment};
use occupant_core::kernel::Frames;
use occupant_core::kernel::frame::VEHICLE;
use occupant_core::kernel::kinematics::LIMBS;
use occupant_core::kernel::state::{FREE, HINGED};
use occupant_core::kernel::vector::{V3, v3};
use occupant_core::model::Model;
use occupant_core::surface::Outline;
use scene::{Instant, TOUCHING_S};
use serde_json::{Value, json};

/// Segment that carries each segment, and where: the middle torso carries the upper one at the common root.
const PARENTS: [Option<usize>; SEGMENTS] = [
    None,
    Some(0),
    Some(1),
    Some(0),
    Some(1),
    Some(1),
    Some(4),
    Some(5),
    Some(3),
    Some(3),
    Some(8),
    Some(9),
];

#[allow(clippy::print_stdout, reason = "an example prints its result")]
fn main() {
    let model = scene::model();
    let mut now = Instant::full(&model, TOUCHING_S);
    for (i, omega) in now.state.omega.iter_mut().enumerate() {
        let i = i as f64;
        *omega += v3(3.0 - i, 2.0 * i - 5.0, 4.0 - 0.7 * i);
    }
    let motion = now.bare(&scene::no_loads());
    let state = &now.state;
    let printed = json!({
        "gravity": now.system.skeleton.gravity,
        "bodies": (0..SEGMENTS).map(|n| body(&now, n)).collect::<Vec<_>>(),
        "free": FREE,
        "hinged": HINGED,
        "spheres": spheres(&now),
        "faces": faces(&model, &now.frames),
        "state": {
            "t1": list(state.t1),
            "orientation": state.orientation.map(|q| [q.w, q.v.x, q.v.y, q.v.z]),
            "hinge": state.hinge,
            "velocity": list(state.velocity),
            "omega": state.omega.map(list),
            "hinge_rate": state.hinge_rate,
        },
        "accelerations": {
            "t1": list(motion.joint[0]),
            "alpha": FREE.map(|n| list(motion.alpha[n])),
            "hinge": motion.hinge,
        },
    });
    println!("{printed}");
}

/// Mass, inertia and place of segment `n` in its parent's axes, seen from the parent's joint.
fn body(now: &Instant, n: usize) -> Value {
    let skeleton = &now.system.skeleton;
    let link = &skeleton.links[n];
    let half_width = match n {
        4 => skeleton.shoulder,
        5 => -skeleton.shoulder,
        8 => skeleton.hip,
        9 => -skeleton.hip,
        _ => 0.0,
    };
    // the upper torso sits at the root itself, every other segment at the far end of its parent
    let far = |parent: usize| {
        if n == 1 {
            0.0
        } else {
            skeleton.links[parent].far
        }
    };
    json!({
        "name": Segment::ALL[n].name(),
        "parent": PARENTS[n],
        "hinge": LIMBS.iter().any(|&(_, lower)| lower == n),
        "place": PARENTS[n].map_or([0.0; 3], |parent| [0.0, half_width, far(parent)]),
        "mass": link.mass,
        "cg": link.cg,
        "inertia": link.central,
    })
}

fn spheres(now: &Instant) -> Vec<Value> {
    let sites = now.system.contacts.sites.iter();
    let sphere = |site: &occupant_core::kernel::contact::Site<f64>| json!({ "body": site.segment, "place": list(site.offset), "radius": site.radius });
    sites.map(sphere).collect()
}

/// Centre, half sizes and axes (u, v, normal) of the rectangle round every face, in space.
fn faces(model: &Model, frames: &Frames<f64>) -> Vec<Value> {
    let vehicle = &frames[VEHICLE];
    let faces = model.faces().iter().map(|face| {
        let (u, v) = face.plane_axes();
        let corners = match &face.outline {
            Outline::Polygon(corners) => corners.clone(),
            Outline::Disc {
                centre_m, radius_m, ..
            } => {
                let (u, v) = (u * *radius_m, v * *radius_m);
                vec![centre_m + u + v, centre_m - u - v]
            }
            Outline::Unbounded { .. } => Vec::new(),
        };
        let range = |axis: &nalgebra::Vector3<f64>| {
            let along = corners.iter().map(|c| axis.dot(&c.coords));
            let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), a| {
                (l.min(a), h.max(a))
            });
            (0.5 * (low + high), 0.5 * (high - low))
        };
        let ((at_u, half_u), (at_v, half_v), (at_n, _)) =
            (range(&u), range(&v), range(&face.normal));
        let centre = V3::of(&(u * at_u + v * at_v + face.normal * at_n));
        let turn = |axis| list(vehicle.axes.out(V3::of(&axis)));
        json!({
            "centre": list(vehicle.origin + vehicle.axes.out(centre)),
            "half": [half_u, half_v],
            "axes": [turn(u), turn(v), turn(face.normal)],
        })
    });
    faces.collect()
}

fn list(v: V3<f64>) -> [f64; 3] {
    [v.x, v.y, v.z]
}
