//! Checks of plates.

use nalgebra::{Matrix3, SymmetricEigen, Vector3};

use super::data::{Band, PlateData};
use crate::body::{Body, Plate, Ride, Segment, Shares};
use crate::forces::function::Goes;
use crate::forces::sphere::MOST_RIDDEN;
use crate::motion::layout::MOST_SLIDES;
use placed_text::{Problems, number, with_key};

/// Smallest fraction of a segment's mass that its plates must leave.
const LEAST_LEFT: f64 = 0.8;

const FACTOR: &str = "a number";

pub(super) fn check(data: &PlateData<'_>, body: &Body, problems: &mut Problems) {
    if data.plates.len() > MOST_SLIDES {
        let found = format!("{} plates", data.plates.len());
        problems.error("body.plates", found, format!("at most {MOST_SLIDES} of all bodies together"));
        return;
    }
    problems.check_unique("body.plates", "plate", data.plates.iter().map(|plate| plate.name.as_str()));
    data.plates.iter().for_each(|one| plate(one, body, problems));
    data.bands.iter().for_each(|one| band(one, data.plates.len(), problems));
    if !problems.has_errors() {
        body.tree.segments().for_each(|segment| left(segment, data.plates, body, problems));
    }
    for sphere in &body.spheres {
        ride(&sphere.ride, &with_key("body.spheres", &sphere.name), sphere.segment, data.plates, problems);
    }
}

fn plate(plate: &Plate, body: &Body, problems: &mut Problems) {
    let path = with_key("body.plates", &plate.name);
    let at = |key: &str| format!("{path}.{key}");
    if plate.segment.index() >= body.segments.len() {
        problems.error(at("segment"), "no such segment", "a segment of the body");
    }
    let size = plate.inward.norm();
    if !(size > 1e-12 && size.is_finite()) {
        problems.error(at("inward"), "no direction", "the direction in which it yields, in axes of its segment");
    }
    if plate.place_from_lower_end_m.iter().any(|c| !c.is_finite()) {
        problems.error(at("at"), "not finite numbers", "where its mass is, from the segment's lower end");
    }
    problems.check_positive(&at("mass"), plate.mass_kg, "kg");
    if let Some(depth_m) = plate.depth_m {
        problems.check_positive(&at("depth"), depth_m, "m");
    }
}

fn band(band: &Band, plates: usize, problems: &mut Problems) {
    let own = matches!(band.of[..], [(_, 1.0)]);
    let path = with_key(if own { "body.plates" } else { "body.plate_links" }, &band.name);
    let at = |key: &str| format!("{path}.{key}");
    if band.of.is_empty() || band.of.iter().any(|(plate, _)| *plate >= plates) {
        problems.error(at("of"), "no such plate", "plates of the body with their factors");
    }
    if band.of.iter().any(|(_, factor)| !factor.is_finite() || *factor == 0.0) {
        problems.error(at("of"), "a factor of 0, or none that is finite", FACTOR);
    }
    let falls = "forces that do not fall with the deflection";
    band.spring.check(&at("spring"), Goes::NotDown, falls, problems);
    if let Some(outward) = &band.outward {
        outward.check(&at("outward_spring"), Goes::NotDown, falls, problems);
    }
    let damper = &band.damper;
    let dampings =
        [("linear", damper.linear_n_s_m), ("quadratic", damper.quadratic_n_s2_m2), ("outward", damper.outward_n_s_m)];
    for (key, damping) in dampings {
        if !(damping >= 0.0 && damping.is_finite()) {
            let found = format!("{}, which would give energy back", number(damping));
            problems.error(at(&format!("damper.{key}")), found, "at least 0: a damper takes energy");
        }
    }
    for (key, value, unit) in band.viscous.iter().flat_map(|[k, t]| [("stiffness", *k, "N/m"), ("time", *t, "s")]) {
        problems.check_positive(&at(&format!("viscous.{key}")), value, unit);
    }
}

/// Checks that the segment without its plates keeps most of its mass and a valid inertia.
fn left(segment: Segment, plates: &[Plate], body: &Body, problems: &mut Problems) {
    let own = || plates.iter().filter(|plate| plate.segment == segment);
    let (whole, taken) = (body.segment(segment), own().map(|plate| plate.mass_kg).sum::<f64>());
    if own().next().is_none() {
        return;
    }
    let name = body.tree[segment].name;
    let path = with_key("body.segments", name);
    let left_kg = whole.mass_kg - taken;
    if left_kg.is_nan() || left_kg < LEAST_LEFT * whole.mass_kg {
        let found = format!("{} kg, of which its plates are {} kg", number(whole.mass_kg), number(taken));
        problems.error(path, found, "plates of at most a fifth of their segment's mass");
        return;
    }
    let point = |mass: f64, at: Vector3<f64>| (Matrix3::identity() * at.norm_squared() - at * at.transpose()) * mass;
    let turn = whole.principal.to_rotation_matrix().into_inner();
    let mut inertia = turn * Matrix3::from_diagonal(&whole.inertia_kg_m2) * turn.transpose();
    let mut shift = Vector3::zeros();
    for plate in own() {
        let at = plate.place_from_lower_end_m.coords - whole.cg_m();
        inertia -= point(plate.mass_kg, at);
        shift -= at * plate.mass_kg;
    }
    inertia -= point(left_kg, shift / left_kg);
    let moments = SymmetricEigen::new(inertia).eigenvalues;
    let is_body = moments.min() > 0.0 && 2.0 * moments.max() <= moments.sum() * (1.0 + 1e-9);
    if !is_body {
        let found = "moments of inertia that no matter has once its plates are taken off";
        problems.error(path, found, "lighter plates, or plates nearer to the centre of gravity");
    }
}

/// Checks a point of a segment that moves with plates.
pub(crate) fn ride(ride: &Ride, path: &str, segment: Segment, plates: &[Plate], problems: &mut Problems) {
    for (key, shares) in [("contact", &ride.contact), ("belt", &ride.belt), ("bag", &ride.bag)] {
        rides(shares, &format!("{path}.ride.{key}"), segment, plates, problems);
    }
}

/// The same for one use.
pub(crate) fn rides(shares: &Shares, path: &str, segment: Segment, plates: &[Plate], problems: &mut Problems) {
    if shares.len() > MOST_RIDDEN {
        problems.error(path, format!("{} plates", shares.len()), format!("at most {MOST_RIDDEN}"));
    }
    for (plate, share) in shares {
        let Some(plate) = plates.get(*plate) else {
            problems.error(path, "no such plate", "plates of its segment");
            continue;
        };
        if !(0.0..=1.0).contains(share) {
            let found = format!("{} of {}", number(*share), plate.name);
            problems.error(path, found, "a share from 0 to 1");
        }
        if plate.segment != segment {
            let found = format!("{}, which is a part of another segment", plate.name);
            problems.error(path, found, "a plate of the segment that carries what rides on it");
        }
    }
}
