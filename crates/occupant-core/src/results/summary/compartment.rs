//! Parts that leave the compartment of a vehicle: which part, when, to which side, past what.
//!
//! The compartment is the smallest box, in the axes of the vehicle, that contains the bounded surfaces facing the body
//! at the start, the solids of the vehicle, and the initial body. A sphere has left it once all of it is beyond one
//! side. If nothing is modelled on that side, what it would have struck outside is unknown.

use nalgebra::Point3;
use serde::Serialize;

use crate::body::ContactSphere;
use crate::body::tree::BodyRow;
use crate::forces::contact::near::Bounds;
use crate::forces::contact::surface::{Frame, Outline};
use crate::model::Model;
use crate::results::sample::Sample;

/// Ejection of a body from the compartment of its vehicle.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ejection {
    /// Partial or complete.
    pub degree: Degree,
    /// First time with the whole body outside.
    pub complete_s: Option<f64>,
    /// Parts that left it, in order of time.
    pub parts: Vec<Exit>,
    /// Parts that never did.
    pub inside: Vec<String>,
}

/// Degree of ejection.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Degree {
    /// Some parts.
    Partial,
    /// All parts at one time.
    Complete,
}

/// Ejection of a part of the body.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Exit {
    /// The part.
    pub part: String,
    /// First output with a sphere of it outside.
    pub time_s: f64,
    /// Side of the compartment.
    pub side: Side,
    /// Nearest surface or solid of the compartment there.
    pub past: Option<String>,
    /// Position of the sphere's centre, vehicle axes.
    pub place_m: [f64; 3],
}

/// Side of a compartment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// Towards the rear.
    Behind,
    /// Towards the front.
    Ahead,
    /// To the left.
    Left,
    /// To the right.
    Right,
    /// Over the roof.
    Above,
    /// Below the floor.
    Below,
}

impl Side {
    /// Sides against and along the axes of a vehicle.
    const ALL: [[Side; 2]; 3] = [[Side::Behind, Side::Ahead], [Side::Left, Side::Right], [Side::Above, Side::Below]];

    /// As text.
    pub fn words(self) -> &'static str {
        match self {
            Side::Behind => "to the rear",
            Side::Ahead => "ahead",
            Side::Left => "to the left",
            Side::Right => "to the right",
            Side::Above => "upward",
            Side::Below => "downward",
        }
    }
}

/// Initial compartment of a body, and the parts that have left it.
#[derive(Clone, Debug)]
pub(super) struct Compartment {
    pub name: &'static str,
    /// Its spheres (indices), and whether each is of the head, the chest or the pelvis.
    spheres: Vec<(usize, bool)>,
    /// Surfaces and solids of the vehicle (indices), and their bounds.
    walls: Vec<(usize, Bounds)>,
    /// Bounds of the compartment, known from the first output on.
    room: Option<Bounds>,
    /// Exits by sphere.
    exits: Vec<Option<(f64, Side, Point3<f64>)>>,
    complete_s: Option<f64>,
}

impl Compartment {
    /// Compartments of all bodies of a model that start in a vehicle: of occupants, free ones.
    pub(super) fn all(model: &Model) -> Vec<Compartment> {
        let (setup, body) = (model.setup(), model.body());
        if setup.is_on_rig() && setup.members.is_empty() {
            return Vec::new();
        }
        let bodies = body.tree.bodies().into_iter().enumerate().zip(setup.homes());
        let inside = bodies.filter(|((of, row), home)| {
            let is_occupant = row.landmarks.head.is_some() && row.landmarks.pelvis.is_some();
            let held = setup.members.get(*of).is_some_and(|member| member.alone.is_on_rig());
            is_occupant && !held && !setup.is_ground(*home)
        });
        let all = inside.map(|((of, row), home)| Compartment::new(model, of, row, home));
        all.filter(|compartment| !compartment.walls.is_empty()).collect()
    }

    fn new(model: &Model, of: usize, row: BodyRow, home: Frame) -> Self {
        let (setup, body) = (model.setup(), model.body());
        let own = body.spheres.iter().enumerate().filter(|(_, sphere)| body.tree.body_of(sphere.segment) == of);
        let trunk = row.landmarks.instruments();
        let spheres: Vec<_> = own.map(|(i, sphere)| (i, trunk.contains(&Some(sphere.segment)))).collect();
        let surfaces = setup.surfaces.iter().map(|own| (own.frame, bounds_of(&own.outline)));
        let solids = setup.solids.iter().map(|own| (own.frame, Some(own.shape.bounds())));
        let walls = surfaces.chain(solids).enumerate().filter(|(_, (frame, _))| setup.belongs_to(*frame) == home);
        let walls = walls.filter_map(|(i, (_, bounds))| Some((i, bounds.filter(Bounds::is_bounded)?)));
        Compartment {
            name: row.name,
            exits: vec![None; spheres.len()],
            spheres,
            walls: walls.collect(),
            room: None,
            complete_s: None,
        }
    }

    pub(super) fn see(&mut self, sample: &Sample<'_>) {
        let room = *self.room.get_or_insert_with(|| {
            let faces = sample.model.faces();
            let chest = self.spheres.iter().find(|(_, is_trunk)| *is_trunk).or(self.spheres.first());
            let start_m = chest.map_or_else(Point3::origin, |(i, _)| sample.sphere_centre_m(*i));
            self.walls
                .retain(|(i, _)| faces.get(*i).is_none_or(|face| face.normal.dot(&start_m.coords) > face.offset_m));
            let body = self.spheres.iter().map(|(i, _)| ball(sample, *i));
            self.walls.iter().map(|(_, wall)| *wall).chain(body).fold(Bounds::NONE, Bounds::and)
        });
        let mut all_out = !self.spheres.is_empty();
        for ((i, _), exit) in self.spheres.iter().zip(&mut self.exits) {
            let centre_m = sample.sphere_centre_m(*i);
            let is_out = room.is_beyond(&centre_m, sample.model.body().spheres[*i].radius_m);
            all_out &= is_out;
            if is_out {
                let (_, axis, end) = room.beyond_m(&centre_m);
                exit.get_or_insert((sample.time_s, Side::ALL[axis][end], centre_m));
            }
        }
        if all_out {
            self.complete_s.get_or_insert(sample.time_s);
        }
    }

    /// Ejection; none unless head, chest or pelvis left.
    pub(super) fn ejection(&self, spheres: &[ContactSphere], surfaces: &[String]) -> Option<Ejection> {
        let left = || self.spheres.iter().zip(&self.exits).filter_map(|(sphere, exit)| Some((sphere, (*exit)?)));
        left().find(|((_, is_trunk), _)| *is_trunk)?;
        let mut parts: Vec<Exit> = Vec::new();
        for ((i, _), (time_s, side, place_m)) in left() {
            let part = &spheres[*i].part;
            let past = self.walls.iter().min_by(|a, b| a.1.distance_m(&place_m).total_cmp(&b.1.distance_m(&place_m)));
            let exit = Exit {
                part: part.clone(),
                time_s,
                side,
                past: past.map(|(wall, _)| surfaces[*wall].clone()),
                place_m: place_m.coords.into(),
            };
            match parts.iter_mut().find(|known| known.part == *part) {
                Some(known) if known.time_s > time_s => *known = exit,
                Some(_) => {}
                None => parts.push(exit),
            }
        }
        parts.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
        let degree = if self.complete_s.is_some() { Degree::Complete } else { Degree::Partial };
        let mut inside: Vec<String> = Vec::new();
        for (i, _) in &self.spheres {
            let part = &spheres[*i].part;
            if !inside.contains(part) && parts.iter().all(|exit| exit.part != *part) {
                inside.push(part.clone());
            }
        }
        Some(Ejection { degree, complete_s: self.complete_s, parts, inside })
    }
}

fn ball(sample: &Sample<'_>, sphere: usize) -> Bounds {
    Bounds::ball(&sample.sphere_centre_m(sphere), sample.model.body().spheres[sphere].radius_m)
}

/// Bounding box of a bounded surface.
fn bounds_of(outline: &Outline) -> Option<Bounds> {
    match outline {
        Outline::Polygon(corners) => Some(Bounds::of(corners)),
        Outline::Disc { centre_m, radius_m, .. } => Some(Bounds::ball(centre_m, *radius_m)),
        Outline::Unbounded { .. } => None,
    }
}
