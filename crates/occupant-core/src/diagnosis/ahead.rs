//! Whether there is anything ahead of the head of an occupant without a belt.

use nalgebra::Point3;
use serde::Serialize;

use super::rates::frame_at;
use crate::body::Segment;
use crate::forces::chain::Site;
use crate::forces::contact::near::Bounds;
use crate::forces::contact::solid::Shape;
use crate::forces::contact::surface::{Frame, Outline};
use crate::model::Model;
use crate::model::setup::Setup;
use crate::motion::kinematics::Kinematics;

/// Least loss of speed that throws an occupant forward, m/s.
const LEAST_LOSS_M_S: f64 = 2.0;

/// An unbelted occupant with neither panel nor windscreen in front of the head.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OpenAhead {
    /// The sphere of the head.
    pub sphere: String,
    /// Loss of his vehicle's forward speed, m/s.
    pub loss_m_s: f64,
}

/// All such occupants.
pub(super) fn open_ahead(model: &Model) -> Vec<OpenAhead> {
    let setup = model.setup();
    if setup.members.is_empty() && setup.is_on_rig() {
        return Vec::new();
    }
    let bodies = model.body().tree.bodies().into_iter().zip(setup.homes()).enumerate();
    bodies.filter_map(|(of, (row, home))| one(model, of, (row.landmarks.head?, row.landmarks.chest?), home)).collect()
}

fn one(model: &Model, of: usize, (head, chest): (Segment, Segment), home: Frame) -> Option<OpenAhead> {
    let (setup, body) = (model.setup(), model.body());
    if setup.is_ground(home) || is_belted(setup, of) {
        return None;
    }
    let time = &setup.time;
    let start = frame_at(model, home, time.start_s);
    let ahead = start.rotation.column(0);
    let lost = |time_s: f64| -ahead.dot(&(frame_at(model, home, time_s).velocity_m_s - start.velocity_m_s));
    let loss_m_s =
        (1..=20).map(|i| lost(time.start_s + f64::from(i) / 20.0 * (time.end_s - time.start_s))).fold(0.0, f64::max);
    if loss_m_s < LEAST_LOSS_M_S {
        return None;
    }
    let place = |segment| {
        let sphere = body.spheres.iter().position(|sphere| sphere.segment == segment)?;
        let k = Kinematics::new(&model.system().skeleton, &model.start().state);
        let centre = model.system().sphere(&k, sphere).1.to_vector();
        Some((sphere, Point3::from(start.point_to_frame(centre))))
    };
    let ((sphere, head_m), (_, chest_m)) = (place(head)?, place(chest)?);
    let radius_m = body.spheres[sphere].radius_m;
    // as wide as the head, from its top down to the chest: z is down
    let [top, low] = [
        Point3::new(head_m.x, head_m.y - radius_m, head_m.z - radius_m),
        Point3::new(head_m.x + FAR_M, head_m.y + radius_m, chest_m.z),
    ];
    let way = Bounds::of(&[top, low]);
    let surfaces = setup.surfaces.iter().map(|own| (own.frame, plate(&own.outline)));
    let solids = setup.solids.iter().map(|own| (own.frame, block(&own.shape)));
    let mut walls =
        surfaces.chain(solids).filter(|(frame, _)| setup.belongs_to(*frame) == home).filter_map(|(_, wall)| wall);
    let stands = walls.any(|wall| wall.is_near(&way, 0.0) && wall.most_along(0) > head_m.x + radius_m);
    (!stands).then(|| OpenAhead { sphere: body.spheres[sphere].name.clone(), loss_m_s })
}

/// Largest forward distance in a compartment, m.
const FAR_M: f64 = 3.0;

/// Whether a belt goes around any part of a body.
fn is_belted(setup: &Setup, of: usize) -> bool {
    let tree = setup.body.tree;
    let own_sphere = |sphere: usize| setup.body.spheres.get(sphere).is_some_and(|s| tree.body_of(s.segment) == of);
    let loops = setup.belts.iter().any(|belt| own_sphere(belt.sphere));
    let nodes = setup.chains.iter().flat_map(|chain| &chain.nodes);
    let mut led = nodes.map(|node| match node.site {
        Site::Sphere(sphere) => own_sphere(sphere),
        Site::Segment(segment, ..) | Site::Track(segment, _) => tree.body_of(tree.segment(segment)) == of,
        Site::Vehicle(..) => false,
    });
    loops || led.any(|is_own| is_own)
}

/// Bounding box of a surface, except a steering wheel.
fn plate(outline: &Outline) -> Option<Bounds> {
    match outline {
        Outline::Polygon(corners) => Some(Bounds::of(corners)),
        Outline::Disc { .. } | Outline::Unbounded { .. } => None,
    }
}

/// Bounding box of a solid, except wheels.
fn block(shape: &Shape) -> Option<Bounds> {
    match shape {
        Shape::Disc { .. } | Shape::Rim { .. } => None,
        shape => Some(shape.bounds()),
    }
}
