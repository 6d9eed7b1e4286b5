//! Forces on the occupant as arrows: contacts where they act, belts at the centres of their spheres.

use occupant_core::results::sample::Sample;

use super::primitive::arrow;
use super::{Color, entity, replace};
use crate::files::mcap::topics::VEHICLE_FRAME;
use crate::files::mcap::wire::Wire;

/// Arrows shorter than this are left out, m.
const SHORTEST_M: f64 = 1e-3;
const DIAMETER_M: f64 = 0.015;
const CONTACT: Color = Color(0.90, 0.15, 0.15, 1.0);
const BELT: Color = Color(0.95, 0.55, 0.10, 1.0);

/// A message with one entity for each force, vehicle axes, drawn with `m_per_n`.
pub(crate) fn write(wire: &mut Wire, ns: u64, sample: &Sample<'_>, m_per_n: f64) {
    let setup = sample.model.setup();
    replace(wire, ns, |w| {
        for contact in sample.contacts() {
            let drawn = contact.force_n * m_per_n;
            if drawn.norm() < SHORTEST_M {
                continue;
            }
            let sphere = &setup.body.spheres[contact.sphere].name;
            let surface = &setup.surfaces[contact.surface].name;
            let id = format!("{sphere}__{surface}");
            entity(w, ns, VEHICLE_FRAME, &id, |w| {
                arrow(w, contact.point_m.coords, drawn, DIAMETER_M, CONTACT);
            });
        }
        for (belt, action) in setup.belts.iter().zip(&sample.actions.belts) {
            let drawn = action.force.to_vector() * m_per_n;
            if drawn.norm() < SHORTEST_M {
                continue;
            }
            let centre = sample.sphere_centre_m(belt.sphere);
            let id = format!("belt__{}", belt.name);
            entity(w, ns, VEHICLE_FRAME, &id, |w| {
                arrow(w, centre.coords, drawn, DIAMETER_M, BELT);
            });
        }
    });
}
