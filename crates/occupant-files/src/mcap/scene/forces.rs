//! Forces on the occupant as arrows, where they act.

use nalgebra::{Point3, Vector3};
use occupant_core::results::sample::Sample;

use super::primitive::arrow;
use super::{Color, entity, replace};
use crate::mcap::topics::VEHICLE_FRAME;
use crate::mcap::wire::Wire;

/// Arrows shorter than this are left out, m.
const SHORTEST_M: f64 = 1e-3;
const DIAMETER_M: f64 = 0.015;
const CONTACT: Color = Color(0.90, 0.15, 0.15, 1.0);
const OTHER: Color = Color(0.95, 0.55, 0.10, 1.0);

/// A message with one arrow per force, vehicle axes, `m_per_n` long.
pub fn write(wire: &mut Wire, ns: u64, sample: &Sample<'_>, m_per_n: f64) {
    let (sample, setup) = (&sample.seen_by_vehicle(), sample.model.setup());
    let show = |w: &mut Wire, id: &dyn Fn() -> String, point_m: Point3<f64>, force_n: Vector3<f64>, color| {
        let drawn = force_n * m_per_n;
        if drawn.norm() >= SHORTEST_M {
            entity(w, ns, VEHICLE_FRAME, &id(), |w| arrow(w, point_m.coords, drawn, DIAMETER_M, color));
        }
    };
    replace(wire, ns, |w| {
        for contact in sample.contacts() {
            let sphere = &setup.body.spheres[contact.sphere].name;
            let surface = setup.surface_name(contact.surface).unwrap_or_default();
            show(w, &|| format!("{sphere}__{surface}"), contact.point_m, contact.force_n, CONTACT);
        }
        sample.pulls(&mut |pull| {
            show(w, &|| format!("{}__{}", pull.of, pull.name), pull.point_m, pull.force_n, OTHER);
        });
    });
}
