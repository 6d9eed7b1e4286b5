//! Warnings about numbers that are possible but look like a slip of units: inches read as metres, radians as degrees,
//! lbf/in as N/m, milliseconds as seconds.

use super::builder::Builder;
use super::posture::PostureSection;
use super::{Angle, Scenario};
use crate::body::tti12::TTI12;
use crate::forces::spring::BilinearSpring;
use crate::model::seating::InitialPosture;
use crate::model::setup::Setup;
use crate::problem::Problem;
use crate::scenario::text::with_key;

/// What is usual, and what an unusual value is likely to be.
struct Usual {
    low: f64,
    high: f64,
    unit: &'static str,
    range: &'static str,
    what: &'static str,
    slip: &'static str,
}

const GRAVITY: Usual = Usual {
    low: 9.5,
    high: 10.1,
    unit: "m/s²",
    range: "9.5 to 10.1 m/s²",
    what: "gravity on earth",
    slip: "386.09 is standard gravity in in/s², 32.17 in ft/s²",
};
const PLACE: Usual = Usual {
    low: 0.0,
    high: 10.0,
    unit: "m",
    range: "within 10 m of the origin",
    what: "a place in a vehicle",
    slip: "bare numbers are metres unless units = \"in-lbf-s\" says inches",
};
const RADIUS: Usual = Usual {
    low: 0.005,
    high: 0.5,
    unit: "m",
    range: "5 mm to 0.5 m",
    what: "the radius of a sphere of the body",
    slip: "bare numbers are metres unless units = \"in-lbf-s\" says inches",
};
const BODY_MASS: Usual = Usual {
    low: 3.0,
    high: 250.0,
    unit: "kg",
    range: "3 kg to 250 kg",
    what: "the mass of a person",
    slip: "a bare mass is in kg, under units = \"in-lbf-s\" in lbf·s²/in; use \"11.5 lb\", or `weight`",
};
const STIFFNESS: Usual = Usual {
    low: 500.0,
    high: 1e9,
    unit: "N/m",
    range: "500 N/m to 1 GN/m",
    what: "the stiffness of a part of a car",
    slip: "bare numbers are N/m unless units = \"in-lbf-s\" says lbf/in; 1 lbf/in is 175 N/m",
};
const END: Usual = Usual {
    low: 0.01,
    high: 20.0,
    unit: "s",
    range: "10 ms to 20 s",
    what: "the length of a crash",
    slip: "bare numbers are seconds; use \"200 ms\"",
};

/// Values of one kind and the paths they stand at.
type Values = Vec<(String, f64)>;

/// Adds a warning for every kind of number that looks like a slip.
pub(super) fn check(b: &mut Builder, setup: &Setup, scenario: &Scenario) {
    let one = |path: &str, value: f64| vec![(path.to_owned(), value)];
    if setup.gravity_m_s2 != 0.0 {
        warn_unless(b, one("gravity", setup.gravity_m_s2), &GRAVITY);
    }
    warn_unless(b, one("body.segments", setup.body.mass_kg()), &BODY_MASS);
    warn_unless(b, one("time.end", setup.time.end_s - setup.time.start_s), &END);
    warn_unless(b, radii(setup), &RADIUS);
    warn_unless(b, stiffnesses(setup), &STIFFNESS);
    warn_unless(b, places(setup), &PLACE);
    if let Some(posture) = &scenario.posture {
        check_posture_angles(b, posture);
    }
    check_stop_angles(b, scenario);
}

/// One warning for all values of a kind that are out of the usual range, at the first of them.
fn warn_unless(b: &mut Builder, values: Values, usual: &Usual) {
    let mut unusual = values.into_iter().filter(|(_, v)| !(usual.low..=usual.high).contains(v));
    let Some((path, value)) = unusual.next() else {
        return;
    };
    let more = match unusual.count() {
        0 => String::new(),
        n => format!(", and so are {n} more"),
    };
    let value = (value * 1e6).round() / 1e6;
    let found = format!("{value} {} is unusual for {}{more}", usual.unit, usual.what);
    b.report(Problem::warning(path, found, usual.range).with_hint(Some(usual.slip)));
}

fn radii(setup: &Setup) -> Values {
    let path = |name: &str| with_key(&with_key("body.spheres", name), "radius");
    let spheres = setup.body.spheres.iter();
    spheres.map(|s| (path(&s.name), s.radius_m)).collect()
}

fn stiffnesses(setup: &Setup) -> Values {
    let k1 = |group: &str, name: &str, spring: &BilinearSpring| {
        let path = with_key(&with_key(group, name), "k1");
        (path, spring.k1_n_per_m)
    };
    let materials = setup.materials.iter().map(|m| k1("materials", &m.name, &m.spring));
    let belts = setup.belts.iter().map(|b| k1("belts", &b.name, &b.webbing));
    materials.chain(belts).collect()
}

fn places(setup: &Setup) -> Values {
    let mut places = Values::new();
    for belt in &setup.belts {
        let path = with_key("belts", &belt.name);
        let each = belt.anchors_m.iter().enumerate();
        places.extend(each.map(|(i, a)| (format!("{path}.anchors[{i}]"), a.coords.norm())));
    }
    if let InitialPosture::Seated(seating) = &setup.posture {
        let each = seating.heels_m.iter().enumerate();
        places.extend(each.map(|(i, h)| (format!("posture.heels[{i}]"), h.abs())));
    }
    places
}

/// Bare angles that are all below π, and not all whole or nearly nothing, were meant in radians. A text carries its unit
/// and is what it says.
fn look_like_radians(angles: &[&Angle]) -> bool {
    let degrees: Option<Vec<f64>> = angles.iter().map(|a| a.bare()).collect();
    degrees.is_some_and(|all| {
        all.iter().all(|a| a.abs() <= std::f64::consts::PI) && all.iter().any(|a| a.abs() > 0.05 && a.fract() != 0.0)
    })
}

fn check_posture_angles(b: &mut Builder, p: &PostureSection) {
    let angles = [&p.middle_torso, &p.upper_torso, &p.head, &p.lower_torso, &p.upper_arms, &p.elbows];
    if look_like_radians(&angles) {
        let found = "angles of the posture that are all below 3.2°, as if they were radians";
        let hint = "bare angles are degrees; write \"0.26 rad\" for radians";
        b.report(Problem::warning("posture", found, "degrees").with_hint(Some(hint)));
    }
}

fn check_stop_angles(b: &mut Builder, scenario: &Scenario) {
    for joint in TTI12.joint_rows() {
        let Some(section) = scenario.joints.of(joint.name) else {
            continue;
        };
        let stops = [("stop", &section.stop), ("lower_stop", &section.lower_stop), ("upper_stop", &section.upper_stop)];
        for (key, stop) in stops {
            if stop.as_ref().is_some_and(|s| look_like_radians(&[&s.begin, &s.full])) {
                let found = "angles of a stop that are both below 3.2°, as if they were radians";
                let hint = "bare angles are degrees; write \"0.79 rad\" for radians";
                let path = format!("joints.{}.{key}", joint.name);
                b.report(Problem::warning(path, found, "degrees").with_hint(Some(hint)));
            }
        }
    }
}
