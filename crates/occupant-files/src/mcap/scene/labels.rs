//! Names of surfaces and solids, and an arrow on each surface towards its open side.

use nalgebra::{Point3, Vector3};
use occupant_core::model::Model;

use super::compartment::{corners_m, frame_name};
use super::primitive::{arrow, text};
use super::{Color, entity};
use crate::mcap::wire::Wire;

const INK: Color = Color(0.15, 0.15, 0.2, 1.0);
const HEIGHT_M: f64 = 0.04;
const ARROW_M: f64 = 0.08;

/// One label per surface, then per solid.
pub fn write(wire: &mut Wire, model: &Model) {
    for (surface, face) in model.setup().surfaces.iter().zip(model.faces()) {
        let middle = middle_m(&corners_m(face));
        let tip = face.normal * ARROW_M;
        entity(wire, 0, &frame_name(model, face.frame), &surface.name, |w| {
            arrow(w, middle, tip, 0.008, INK);
            text(w, middle + tip * 1.3, HEIGHT_M, INK, &surface.name);
        });
    }
    for solid in &model.setup().solids {
        let middle = middle_m(&solid.outline().concat());
        entity(wire, 0, &frame_name(model, solid.frame), &solid.name, |w| text(w, middle, HEIGHT_M, INK, &solid.name));
    }
}

fn middle_m(points: &[Point3<f64>]) -> Vector3<f64> {
    let sum: Vector3<f64> = points.iter().map(|p| p.coords).sum();
    sum / points.len() as f64
}
