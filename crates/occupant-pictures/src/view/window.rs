//! The part of the world that all panels of one view show: the body at all moments, the lines of force elements, and the surfaces near it.

use nalgebra::{Point3, Vector3};
use occupant_core::forces::contact::solid::Shape;
use occupant_core::forces::contact::surface::{Frame, Outline};

use super::Strip;
use super::projection::View;
use crate::body::{Snapshot, parts};

/// Margin around the region shown, m.
const MARGIN_M: f64 = 0.06;
/// Distance from the body up to which surfaces of the vehicle are shown, m.
const REACH_M: f64 = 0.7;

/// A box along the vehicle's axes, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    low: Vector3<f64>,
    high: Vector3<f64>,
}

impl Window {
    /// Region that contains all panels of a strip.
    pub fn of(strip: &Strip<'_>) -> Self {
        let mut window = Window { low: Vector3::repeat(f64::INFINITY), high: Vector3::repeat(f64::NEG_INFINITY) };
        for moment in &strip.moments {
            window.add_body(strip, moment);
        }
        let near = window.grown(REACH_M);
        if let Some(moment) = strip.moments.first() {
            window.add_surfaces(strip, moment, &near);
        }
        window.add_scenery(strip);
        window.grown(MARGIN_M)
    }

    /// Width and height in a view, m.
    pub fn size_m(&self, view: View) -> [f64; 2] {
        let size = view.turn(self.high - self.low);
        [size.x.abs(), size.y.abs()]
    }

    /// Picture place of its upper left corner in a view, m.
    pub fn corner_m(&self, view: View) -> [f64; 2] {
        let (a, b) = (view.turn(self.low), view.turn(self.high));
        [a.x.min(b.x), a.y.min(b.y)]
    }

    fn add_body(&mut self, strip: &Strip<'_>, moment: &Snapshot) {
        for (sphere, centre) in strip.model.body().spheres.iter().zip(&moment.spheres_m) {
            let reach = Vector3::repeat(sphere.radius_m);
            self.add(&(centre - reach));
            self.add(&(centre + reach));
        }
        let ends = parts(strip.model.body());
        for part in &ends {
            let pose = &moment.poses[part.segment.index()];
            for lump in &part.ends {
                self.add(&(pose * Point3::from(lump.centre_m)));
            }
        }
        let sections = moment.sections.iter().flat_map(|section| &section.corners_m);
        for point in moment.lines.iter().flat_map(|line| &line.points_m).chain(sections) {
            self.add(point);
        }
    }

    fn add_surfaces(&mut self, strip: &Strip<'_>, at: &Snapshot, near: &Window) {
        for face in strip.model.faces() {
            let bounded = !matches!(face.outline, Outline::Unbounded { .. });
            if bounded && face.frame == Frame::Vehicle {
                for corner in at.corners_m(face) {
                    self.add(&near.nearest(&corner));
                }
            }
        }
        for solid in &strip.model.setup().solids {
            if solid.frame == Frame::Vehicle && !matches!(solid.shape, Shape::HalfSpace { .. }) {
                for corner in solid.outline().iter().flatten() {
                    self.add(&near.nearest(corner));
                }
            }
        }
    }

    /// The outside of the vehicle, whole.
    fn add_scenery(&mut self, strip: &Strip<'_>) {
        let own = strip.model.setup().scenery.iter().filter(|own| own.frame == Frame::Vehicle);
        own.flat_map(|own| own.polygons_m.iter().flatten()).for_each(|corner| self.add(corner));
    }

    fn add(&mut self, p: &Point3<f64>) {
        self.low = self.low.inf(&p.coords);
        self.high = self.high.sup(&p.coords);
    }

    fn nearest(&self, p: &Point3<f64>) -> Point3<f64> {
        p.coords.sup(&self.low).inf(&self.high).into()
    }

    fn grown(&self, by_m: f64) -> Self {
        Window { low: self.low.add_scalar(-by_m), high: self.high.add_scalar(by_m) }
    }
}
