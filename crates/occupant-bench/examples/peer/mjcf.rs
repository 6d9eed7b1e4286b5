//! The model as MJCF. What MuJoCo cannot say it gets in its own words, as much work of the same kind: a damper that resists
//! bending resists all three turns, a spring in β holds the whole turn of its joint, a belt is a tendon round its sphere
//! with one stiffness. Stops that damp and the force law of the contacts have no counterpart and are left out.

use occupant_bench::Instant;
use occupant_core::body::SEGMENTS;
use occupant_core::body::tti12::{self, TTI12};
use occupant_core::forces::joint::{BallJoint, Joints};
use occupant_core::model::Model;

use crate::coordinates::{ORDER, PARENTS, Placed, limb, positions, speeds};
use crate::{belts, faces};

/// How much of the model is written.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
pub enum Parts {
    /// The skeleton under gravity.
    Free,
    /// Also the hinges' dampers, which both engines know.
    Hinges,
    /// Also dampers and springs of the ball joints, and belts.
    Held,
    /// Also spheres and surfaces.
    Contact,
}

impl Parts {
    /// The parts of that name.
    pub fn named(name: &str) -> Option<Parts> {
        Some(match name {
            "free" => Parts::Free,
            "hinges" => Parts::Hinges,
            "held" => Parts::Held,
            "contact" => Parts::Contact,
            _ => return None,
        })
    }
}

/// The MJCF with a keyframe for each instant.
pub fn write(model: &Model, parts: Parts, instants: &Placed) -> String {
    let now = &instants.start;
    let surfaces: String = match parts {
        Parts::Contact => surfaces(model, now),
        _ => String::new(),
    };
    let (anchors, tendons) = match parts >= Parts::Held {
        true => (belts::anchors(model, now), belts::tendons(model)),
        false => (String::new(), String::new()),
    };
    let key = |name: &str, now: &Instant| {
        let (q, v) = (positions(&now.state), speeds(&now.state));
        format!("<key name=\"{name}\" qpos=\"{}\" qvel=\"{}\"/>\n", list(&q), list(&v))
    };
    format!(
        "<mujoco>\n<compiler angle=\"radian\" inertiafromgeom=\"false\"/>\n\
         <option gravity=\"0 0 {}\" timestep=\"0.0001\" integrator=\"RK4\"/>\n\
         <worldbody>\n{surfaces}{anchors}{}</worldbody>\n<tendon>\n{tendons}</tendon>\n\
         <keyframe>\n{}{}{}</keyframe>\n</mujoco>",
        -now.system.skeleton.gravity,
        body(model, now, parts, 0),
        key("start", &instants.start),
        key("then", &instants.then),
        key("spun", &instants.spun),
    )
}

/// Numbers with a space between, every digit kept.
pub fn list(numbers: &[f64]) -> String {
    let words: Vec<String> = numbers.iter().map(f64::to_string).collect();
    words.join(" ")
}

fn surfaces(model: &Model, now: &Instant) -> String {
    let setup = model.setup();
    let faces = model.faces().iter().zip(&setup.surfaces);
    let geom = |(face, surface): (_, &occupant_core::forces::contact::surface::Surface)| {
        faces::geom(face, setup.materials[surface.material].friction, &now.frames) + "\n"
    };
    faces.map(geom).collect()
}

/// Segment `n` with everything that it carries.
fn body(model: &Model, now: &Instant, parts: Parts, n: usize) -> String {
    let link = &now.system.skeleton.links[n];
    let mut text = format!(
        "<body name=\"{}\" pos=\"{}\">\n{}\n<inertial pos=\"0 0 {}\" mass=\"{}\" diaginertia=\"{}\"/>\n",
        TTI12.segment_rows()[n].name,
        list(&place(now, n)),
        joint(&model.setup().joints, parts, n),
        link.cg.z,
        link.mass,
        list(&inertia(model, n)),
    );
    for (i, site) in now.system.spheres.iter().enumerate() {
        if site.segment == n && parts >= Parts::Held {
            let centre = [site.offset.x, site.offset.y, site.offset.z];
            text += &format!(
                "<geom name=\"sphere {i}\" type=\"sphere\" size=\"{}\" pos=\"{}\" friction=\"0 0 0\" contype=\"{}\" conaffinity=\"0\"/>\n",
                site.radius,
                list(&centre),
                u8::from(parts == Parts::Contact),
            );
            text += &belts::sides(model, now, i);
        }
    }
    let children = ORDER.iter().filter(|&&child| PARENTS[child] == Some(n));
    for &child in children {
        text += &body(model, now, parts, child);
    }
    text + "</body>\n"
}

/// Proximal joint of segment `n` in its parent's axes, seen from the parent's joint.
pub fn place(now: &Instant, n: usize) -> [f64; 3] {
    let link = &now.system.skeleton.links[n];
    [0.0, link.joint.y, link.joint.z]
}

/// Principal inertias of segment `n`, kg·m².
pub fn inertia(model: &Model, n: usize) -> [f64; 3] {
    model.body().segment(TTI12.segment(n)).inertia_kg_m2.into()
}

fn joint(joints: &Joints, parts: Parts, n: usize) -> String {
    let of = |least: Parts, damping: f64| if parts >= least { damping } else { 0.0 };
    let (hinge, ball) = (Parts::Hinges, Parts::Held);
    let j = joints;
    let damping: [f64; SEGMENTS] = [
        0.0,
        of(ball, j[tti12::UPPER_BACK].ball().unwrap().damping_n_m_s),
        of(ball, j[tti12::NECK].ball().unwrap().damping_n_m_s),
        of(ball, j[tti12::LOWER_BACK].ball().unwrap().damping_n_m_s),
        of(ball, j[tti12::LEFT_SHOULDER].ball().unwrap().damping_n_m_s),
        of(ball, j[tti12::RIGHT_SHOULDER].ball().unwrap().damping_n_m_s),
        of(hinge, j[tti12::LEFT_ELBOW].hinge().unwrap().damping_n_m_s),
        of(hinge, j[tti12::RIGHT_ELBOW].hinge().unwrap().damping_n_m_s),
        of(ball, j[tti12::LEFT_HIP].ball().unwrap().damping_n_m_s),
        of(ball, j[tti12::RIGHT_HIP].ball().unwrap().damping_n_m_s),
        of(hinge, j[tti12::LEFT_KNEE].hinge().unwrap().damping_n_m_s),
        of(hinge, j[tti12::RIGHT_KNEE].hinge().unwrap().damping_n_m_s),
    ];
    let spring = |joint: &BallJoint| joint.spring.map_or(0.0, |s| of(ball, s.stiffness_n_m));
    let stiffness = |n: usize| match n {
        1 => spring(j[tti12::UPPER_BACK].ball().unwrap()),
        3 => spring(j[tti12::LOWER_BACK].ball().unwrap()),
        _ => 0.0,
    };
    match (PARENTS[n], limb(n)) {
        (None, _) => "<freejoint/>".to_owned(),
        (_, Some(_)) => format!("<joint type=\"hinge\" axis=\"0 1 0\" damping=\"{}\"/>", damping[n]),
        (_, None) => format!("<joint type=\"ball\" damping=\"{}\" stiffness=\"{}\"/>", damping[n], stiffness(n)),
    }
}
