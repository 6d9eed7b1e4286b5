//! Checks of a bag: its data, and the initial position of the body.

use super::data::{Bag, FOLDED, Gas, Inflator, Leakage, Shape};
use super::{BagLaw, MOST_SPHERES, MOST_VENTS};
use crate::body::Body;
use crate::forces::element::Instant;
use placed_text::{Problems, with_key};

/// Largest relative difference of the given volume from that of the shape.
const MOST_OFF: f64 = 0.3;
/// Range of the filling of an unloaded bag, relative to its volume, outside which it is slack or too small.
const FILLS: [f64; 2] = [0.8, 3.0];
/// Temperature up to which the specific heats are valid, K.
const HOTTEST_K: f64 = 1500.0;
/// Largest relative difference of the tank pressure from the given one.
const TANK_OFF: f64 = 0.1;

pub(super) fn data(bag: &Bag, body: &Body, problems: &mut Problems) {
    let path = with_key("bags", &bag.name);
    let at = |key: &str| format!("{path}.{key}");
    if bag.mount_m.iter().any(|c| !c.is_finite()) {
        problems.error(at("mount"), "not finite numbers", "a point");
    }
    problems.check_positive(&at("deploy"), bag.deploy_s, "s");
    let due_s = bag.inflators.iter().map(|one| one.due_s).chain(bag.vents.iter().map(|vent| vent.due_s));
    if let Some(time_s) = [bag.fires_s].into_iter().chain(due_s).find(|time_s| !time_s.is_finite()) {
        problems.error(at("trigger"), format!("{time_s} s"), "finite times; `chain::NEVER` for what does not happen");
    }
    problems.check_positive(&at("ambient.pressure"), bag.ambient[0], "Pa");
    problems.check_positive(&at("ambient.temperature"), bag.ambient[1], "K");
    problems.check_at_least_zero(&at("cover"), bag.cover_kg, "kg");
    problems.check_at_least_zero(&at("heat_transfer"), bag.heat_w_m2_k, "W/(m^2*K)");
    problems.check_at_least_zero(&at("friction"), bag.friction, "1");
    problems.check_positive(&at("friction_speed"), bag.friction_speed_m_s, "m/s");
    if shape(&bag.shape, &at("shape"), problems) && problems.check_positive(&at("volume"), bag.volume_m3, "m^3") {
        volume(bag, &at("volume"), problems);
    }
    for (i, inflator) in bag.inflators.iter().enumerate() {
        check_inflator(inflator, &format!("{path}.inflators[{i}]"), bag.ambient, problems);
    }
    if bag.inflators.len() > 2 {
        problems.error(at("inflators"), format!("{} inflators", bag.inflators.len()), "at most two stages");
    }
    outlets(bag, &path, problems);
    spheres(bag, body, &at("spheres"), problems);
}

/// Checks the shape.
fn shape(shape: &Shape, path: &str, problems: &mut Problems) -> bool {
    let mut wrong = |found: &str, expected: &str| {
        problems.error(path, found, expected);
        false
    };
    let is_length = |length: f64| length > 0.0 && length.is_finite();
    match *shape {
        Shape::Dome { axis, depth_m, radius_m, face_radius_m, edge_m } => {
            if !(axis.norm() > 0.0 && axis.norm().is_finite()) {
                wrong("no direction", "an axis towards the occupant")
            } else if ![depth_m, radius_m, face_radius_m].into_iter().all(is_length) {
                wrong("lengths that are not positive", "a radius, depth and face radius above 0")
            } else if face_radius_m <= depth_m {
                wrong("a face radius that is not above the depth", "a flatter face: the dome is widest at its mount")
            } else if !(edge_m >= 0.0 && edge_m <= depth_m.min(radius_m)) {
                wrong("an edge rounder than the dome is deep or wide", "an edge of at most its depth and radius")
            } else {
                true
            }
        }
        Shape::Sphere { radius_m, .. } => is_length(radius_m) || wrong("no radius", "a radius above 0"),
        Shape::Capsule { ends_m: [from, to], radius_m } => {
            let is_one = is_length(radius_m) && is_length((to - from).norm());
            is_one || wrong("no capsule", "two ends apart and a radius above 0")
        }
    }
}

fn volume(bag: &Bag, path: &str, problems: &mut Problems) {
    let of_shape = bag.shape.volume_m3();
    if (bag.volume_m3 / of_shape - 1.0).abs() > MOST_OFF {
        let [said, of_shape] = [bag.volume_m3, of_shape].map(|volume| 1e3 * volume);
        let found = format!("{said:.1} l of a shape that holds {of_shape:.1} l");
        problems.error(path, found, "the shape's volume within 30 %, or none: it is then the shape's");
    }
    let [_, filled] = bag.filled();
    let [least, most] = FILLS.map(|part| part * bag.volume_m3);
    if !bag.inflators.is_empty() && !(least..=most).contains(&filled) {
        let found =
            format!("gas for {:.1} l at the pressure outside in a bag of {:.1} l", 1e3 * filled, 1e3 * bag.volume_m3);
        problems.warning(path, found, "gas for 0.8 to 3 times the volume");
    }
}

fn check_inflator(inflator: &Inflator, path: &str, ambient: [f64; 2], problems: &mut Problems) {
    let rows = &inflator.rows;
    if rows.len() < 2 {
        return problems.error(format!("{path}.times"), "a table without two rows", "times, flows and temperatures");
    }
    if rows.windows(2).any(|pair| pair[1][0].partial_cmp(&pair[0][0]) != Some(std::cmp::Ordering::Greater)) {
        problems.error(format!("{path}.times"), "times that do not rise", "times that rise from row to row");
    }
    if rows.iter().any(|row| !row[0].is_finite()) {
        problems.error(format!("{path}.times"), "a time that is not finite", "finite times");
    }
    if rows.iter().any(|row| !(row[1] >= 0.0 && row[1].is_finite())) {
        problems.error(format!("{path}.flow"), "a flow below 0", "flows of at least 0");
    }
    if rows.iter().any(|row| !(row[2] > 0.0 && row[2].is_finite())) {
        problems.error(format!("{path}.temperature"), "a temperature that is not above 0 K", "temperatures in K");
    }
    if rows.iter().any(|row| row[2] > HOTTEST_K) {
        let found = format!("gas hotter than {HOTTEST_K} K");
        problems.warning(
            format!("{path}.temperature"),
            found,
            "cooler gas: the specific heats are fitted up to 1000 K",
        );
    }
    if let Some([volume, said]) = inflator.tank {
        let found = tank_pa(inflator, volume, ambient);
        let off = (found / said - 1.0).abs();
        if off.is_nan() || off > TANK_OFF {
            let found = format!("a table that gives {:.1} kPa in the tank, not {:.1}", 1e-3 * found, 1e-3 * said);
            problems.warning(
                format!("{path}.tank.pressure"),
                found,
                "the table's within 10 %, in a tank that loses no heat",
            );
        }
    }
}

/// Gauge pressure in a closed adiabatic tank of air, Pa.
fn tank_pa(inflator: &Inflator, volume: f64, [p_a, t_a]: [f64; 2]) -> f64 {
    let air_kg = p_a * volume / (Gas::AIR.r_j_kg_k * t_a);
    let [mass, enthalpy] = inflator.given();
    let gas = Gas::mixed([(Gas::AIR, air_kg), (inflator.gas, mass)]);
    let energy = air_kg * (Gas::AIR.enthalpy_j_kg(t_a) - Gas::AIR.r_j_kg_k * t_a) + enthalpy;
    let b = gas.a_j_kg_k - gas.r_j_kg_k;
    let temperature = 2.0 * energy / (b + (b * b + 2.0 * gas.b_j_kg_k2 * energy).sqrt());
    gas.r_j_kg_k * temperature / volume - p_a
}

fn outlets(bag: &Bag, path: &str, problems: &mut Problems) {
    if bag.vents.len() > MOST_VENTS {
        problems.error(format!("{path}.vents"), format!("{} vents", bag.vents.len()), format!("at most {MOST_VENTS}"));
    }
    for (i, vent) in bag.vents.iter().enumerate() {
        let at = |key: &str| format!("{path}.vents[{i}].{key}");
        problems.check_at_least_zero(&at("area"), vent.area_m2, "m^2");
        problems.check_positive(&at("discharge"), vent.discharge, "1");
        problems.check_at_least_zero(&at("opens_at"), vent.opens_at_pa, "Pa");
        if vent.discharge > 1.0 {
            problems.warning(
                at("discharge"),
                format!("{}", vent.discharge),
                "0.6 to 0.8: no hole passes more than its area",
            );
        }
    }
    match &bag.leakage {
        Leakage::Fraction(part) => problems.check_at_least_zero(&format!("{path}.leakage"), *part, "1"),
        Leakage::Speed(rows) => {
            let rises = rows.windows(2).all(|pair| pair[1][0] > pair[0][0] && pair[1][1] >= pair[0][1]);
            if rows.len() < 2 || rows[0] != [0.0, 0.0] || !rises {
                let expected = "rows from pressure 0 and speed 0 on, pressures that rise, speeds that do not fall";
                problems.error(format!("{path}.leakage"), "another table", expected);
            }
        }
    }
}

fn spheres(bag: &Bag, body: &Body, path: &str, problems: &mut Problems) {
    let count = bag.spheres.len();
    if count > MOST_SPHERES {
        problems.error(
            path,
            format!("{count} spheres"),
            format!("at most {MOST_SPHERES} spheres that the bag can touch"),
        );
    }
    for (sphere, reach) in &bag.spheres {
        let name = body.spheres.get(*sphere).map_or("a sphere", |sphere| sphere.name.as_str());
        if *sphere >= body.spheres.len() {
            problems.error(path, "no such sphere", "a sphere of the body");
        }
        problems.check_positive(&format!("{path}.{name}.reach"), *reach, "1");
    }
    let across = bag.shape.cross_section_m2();
    for (sphere, reach) in &bag.spheres {
        let Some(sphere) = body.spheres.get(*sphere) else { continue };
        let area = sphere.radius_m.powi(2) * std::f64::consts::PI * reach;
        if area > across {
            let found = format!("{} with {area:.2} m² on a bag of {across:.2} m² across", sphere.name);
            problems.warning(path, found, "a sphere that is less wide than the bag");
        }
    }
}

/// Checks for parts of the body within the unfolded bag at the start of the run.
pub(super) fn laid(law: &BagLaw<f64>, bag: &Bag, body: &Body, at: &Instant<'_, f64>, problems: &mut Problems) {
    let caught = law.envelope.caught(at) as u32;
    let within = bag.spheres.iter().enumerate().filter(|(i, _)| caught >> i & 1 == 1);
    let names: Vec<&str> = within.map(|(_, (sphere, _))| body.spheres[*sphere].name.as_str()).collect();
    if !names.is_empty() {
        let found = format!("within the full bag at the start: {}", names.join(", "));
        let expected = if bag.cover_kg > 0.0 {
            "a body in front of it: out of position the blow is that of `cover` alone"
        } else {
            "a body in front of it: out of position there is no blow without `cover`"
        };
        problems.warning(with_key("bags", &bag.name), found, expected);
    }
}

impl Inflator {
    /// Total gas mass of an inflator, kg, and its enthalpy, J: h is a polynomial of the temperature, so that Simpson's
    /// rule is exact to the third power of time.
    fn given(&self) -> [f64; 2] {
        let flow = |row: [f64; 3]| [row[1], row[1] * self.gas.enthalpy_j_kg(row[2])];
        let middle = |a: &[f64; 3], b: &[f64; 3]| std::array::from_fn(|i| 0.5 * (a[i] + b[i]));
        let piece = |pair: &[[f64; 3]]| {
            let (a, m, b) = (flow(pair[0]), flow(middle(&pair[0], &pair[1])), flow(pair[1]));
            let h = (pair[1][0] - pair[0][0]) / 6.0;
            [0, 1].map(|i| h * (a[i] + 4.0 * m[i] + b[i]))
        };
        self.rows.windows(2).map(piece).fold([0.0; 2], |sum, one| [sum[0] + one[0], sum[1] + one[1]])
    }
}

impl Bag {
    /// Total gas mass, kg, and the volume of it and the air in the folded bag at ambient pressure, m³, without load and
    /// heat loss.
    pub(crate) fn filled(&self) -> [f64; 2] {
        let [p_a, t_a] = self.ambient;
        let air_kg = FOLDED * p_a * self.volume_m3 / (Gas::AIR.r_j_kg_k * t_a);
        let (mut parts, mut mass_kg) = (vec![(Gas::AIR, air_kg)], 0.0);
        let mut enthalpy = air_kg * Gas::AIR.enthalpy_j_kg(t_a);
        for inflator in &self.inflators {
            let [mass, brought] = inflator.given();
            parts.push((inflator.gas, mass));
            (mass_kg, enthalpy) = (mass_kg + mass, enthalpy + brought);
        }
        let gas = Gas::mixed(parts);
        let a = gas.a_j_kg_k;
        let temperature = 2.0 * enthalpy / (a + (a * a + 2.0 * gas.b_j_kg_k2 * enthalpy).sqrt());
        [mass_kg, gas.r_j_kg_k * temperature / p_a]
    }
}

impl Shape {
    /// Largest area normal to the direction of compression, m².
    fn cross_section_m2(&self) -> f64 {
        use std::f64::consts::PI;
        match *self {
            Shape::Dome { radius_m, .. } | Shape::Sphere { radius_m, .. } => PI * radius_m * radius_m,
            Shape::Capsule { ends_m: [from, to], radius_m } => radius_m * (PI * radius_m + 2.0 * (to - from).norm()),
        }
    }
}
