//! The surfaces and the sides of the solids, as translucent plates with edges.

use occupant_units::trig;
use std::f64::consts::TAU;

use nalgebra::Point3;
use occupant_core::forces::contact::flat_face::FlatFace;
use occupant_core::forces::contact::surface::{Frame, Outline};
use occupant_core::model::Model;

use super::primitive::{Closing, line, polygon};
use super::{Color, entity};
use crate::mcap::topics::{SPACE_FRAME, VEHICLE_FRAME, origin_frame, other_frame};
use crate::mcap::wire::Wire;

/// Opacity of the plates.
const OPACITY: f64 = 0.3;
/// Half side of the square drawn for an unbounded plane, m.
const PATCH_M: f64 = 2.5;
/// Number of corners of the polygon drawn for a disc.
const DISC_CORNERS: usize = 48;
const EDGE_M: f64 = 0.006;
/// Colours of road and other scenery, by the last or the first word of its name.
const SCENERY: [(&str, Color); 3] = [
    ("marks", Color(0.12, 0.12, 0.12, 0.8)),
    ("barrier", Color(0.45, 0.47, 0.50, 0.8)),
    ("outside", Color(0.25, 0.42, 0.62, 0.25)),
];
const ROAD: Color = Color(0.62, 0.61, 0.57, 0.6);
/// Colours of the materials in order, repeated if there are more.
const PALETTE: [Color; 8] = [
    Color(0.35, 0.55, 0.75, OPACITY),
    Color(0.75, 0.60, 0.40, OPACITY),
    Color(0.55, 0.65, 0.45, OPACITY),
    Color(0.60, 0.75, 0.80, OPACITY),
    Color(0.70, 0.50, 0.60, OPACITY),
    Color(0.45, 0.45, 0.50, OPACITY),
    Color(0.80, 0.75, 0.50, OPACITY),
    Color(0.50, 0.70, 0.65, OPACITY),
];

/// One entity per surface, per solid, then per scenery object.
pub fn write(wire: &mut Wire, model: &Model) {
    let setup = model.setup();
    let surfaces = setup.surfaces.iter().zip(model.faces());
    let surfaces = surfaces.map(|(s, face)| (&s.name, s.frame, s.material, vec![corners_m(face)]));
    let solids = setup.solids.iter().map(|s| (&s.name, s.frame, s.material, s.outline()));
    let touched = surfaces.chain(solids).map(|(name, frame, material, sides)| (name, frame, color_of(material), sides));
    let scenery =
        setup.scenery.iter().map(|own| (&own.name, own.frame, scenery_color(&own.name), own.polygons_m.clone()));
    for (name, frame, color, polygons) in touched.chain(scenery) {
        entity(wire, 0, &frame_name(model, frame), name, |w| {
            for corners in &polygons {
                polygon(w, corners, color);
                line(w, Closing::Closed, corners, EDGE_M, color.with_opacity(0.9));
            }
        });
    }
}

/// Colour of scenery, by its name.
pub fn scenery_color(name: &str) -> Color {
    let is_it = |word: &str| name.ends_with(word) || name.starts_with(word);
    SCENERY.into_iter().find(|(word, _)| is_it(word)).map_or(ROAD, |(_, color)| color)
}

/// Colour of a material, by its index.
pub fn color_of(material: usize) -> Color {
    PALETTE[material % PALETTE.len()]
}

/// Name of a surface's frame in the viewer.
pub fn frame_name(model: &Model, frame: Frame) -> String {
    match frame {
        Frame::Vehicle => VEHICLE_FRAME.to_owned(),
        Frame::Space => SPACE_FRAME.to_owned(),
        Frame::Other(i) => model.setup().frames.get(i).map_or_else(String::new, |frame| other_frame(&frame.name)),
        Frame::Segment(n) => origin_frame(model.body().tree.segment_rows()[n].name),
    }
}

/// The outline as a polygon, counter-clockwise seen from the open side, in the axes of its frame.
pub fn corners_m(face: &FlatFace) -> Vec<Point3<f64>> {
    let (u, v) = face.plane_axes();
    match &face.outline {
        Outline::Polygon(corners) => corners.clone(),
        Outline::Disc { centre_m, radius_m, .. } => {
            let corner = |i| {
                let angle = TAU * i as f64 / DISC_CORNERS as f64;
                centre_m + (u * trig::cos(angle) + v * trig::sin(angle)) * *radius_m
            };
            (0..DISC_CORNERS).map(corner).collect()
        }
        Outline::Unbounded { point_m, .. } => square_m(face, *point_m, PATCH_M),
    }
}

/// A square of an unbounded plane around a point.
pub fn square_m(face: &FlatFace, about_m: Point3<f64>, half_m: f64) -> Vec<Point3<f64>> {
    let (u, v) = face.plane_axes();
    [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].map(|(a, b)| about_m + (u * a + v * b) * half_m).to_vec()
}
