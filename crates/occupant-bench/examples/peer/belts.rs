//! Belts as tendons that wrap round their spheres: K₁ beyond the length at rest, nothing below it.

use occupant_bench::Instant;
use occupant_core::model::Model;
use occupant_core::motion::frame::VEHICLE;
use occupant_core::motion::kinematics::Kinematics;
use occupant_core::motion::vector::V3;

use crate::mjcf::list;

/// Sites in space where the anchors are, in a vehicle that stands as at `now`.
pub fn anchors(model: &Model, now: &Instant) -> String {
    let mut text = String::new();
    for (i, belt) in model.setup().belts.iter().enumerate() {
        for (end, anchor) in belt.anchors_m.iter().enumerate() {
            let place = in_space(now, V3::of(&anchor.coords));
            text += &format!("<site name=\"anchor {i} {end}\" pos=\"{}\"/>\n", list(&[place.x, place.y, place.z]));
        }
    }
    text
}

/// Sites on the segment of `sphere` that say on which side the belts round it lie: away from their anchors.
pub fn sides(model: &Model, now: &Instant, sphere: usize) -> String {
    let system = &now.system;
    let site = &system.spheres[sphere];
    let k = Kinematics::new(&system.skeleton, &now.state);
    let (_, centre, _) = system.sphere(&k, sphere);
    let mut text = String::new();
    for (i, belt) in model.setup().belts.iter().enumerate() {
        if belt.sphere != sphere {
            continue;
        }
        let [a, b] = belt.anchors_m.map(|anchor| in_space(now, V3::of(&anchor.coords)));
        let away = centre - (a + b) * 0.5;
        let away = away * (2.0 * site.radius / away.norm_squared().sqrt());
        let place = site.offset + k.axes[site.segment].into_frame(away);
        text += &format!("<site name=\"side {i}\" pos=\"{}\"/>\n", list(&[place.x, place.y, place.z]));
    }
    text
}

/// The tendons.
pub fn tendons(model: &Model) -> String {
    let mut text = String::new();
    for (i, (belt, law)) in model.setup().belts.iter().zip(&model.system().forces.belts).enumerate() {
        text += &format!(
            "<spatial name=\"belt {i}\" stiffness=\"{}\" springlength=\"0 {}\">\
             <site site=\"anchor {i} 0\"/><geom geom=\"sphere {}\" sidesite=\"side {i}\"/><site site=\"anchor {i} 1\"/>\
             </spatial>\n",
            belt.webbing.k1_n_per_m, law.rest_length, belt.sphere,
        );
    }
    text
}

fn in_space(now: &Instant, place: V3<f64>) -> V3<f64> {
    let vehicle = &now.frames[VEHICLE];
    vehicle.origin + vehicle.axes.out(place)
}
