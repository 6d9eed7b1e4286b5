//! Deformable chests, as keys of a scenario.
//!
//! `person`: sternum and skin fitted to frontal hub tests (Lebarbé and Petit 2012, 4.3 and 6.7 m/s; the damper's linear
//! part by Kent 2004), the share of a belt from Kent 2004; lower ribs and links to means of Shaw 2009. `dummy50`,
//! `dummy05f`: fitted to 49 CFR 572.34 and 572.134, the share of a belt to vehicle test NHTSA 7292. The mass of
//! `dummy50` is a guess.
//!
//! Ribs and abdomen to the side: those of `person` have the laws of its sternum and of its abdomen, fitted to no test
//! from the side. The ribs of `es2`, three as one, are fitted to drops of 7.78 kg on one rib at 2, 3 and 4 m/s (UN R95,
//! Annex 6, from memory: 23.5 to 27.5, 36 to 40, 46 to 51 mm), its abdomen to 49 CFR 572.186.

use crate::sections::{ChestChoice, SidesChoice, above};
use occupant_core::body::people::Person;
use occupant_core::body::{Body, Segment, shape};
use occupant_core::forces::chain::wing::PLACE;
use occupant_units::trig;

/// Height of the sternum's plate above the upper torso's lower end, as a fraction of its length.
const HEIGHT: f64 = 0.62;
/// Exponent of the stiffness of chests over their depth, from the two dummies.
const BY_DEPTH: f64 = 0.27;

/// Plates of the ribs to the sides, with the sign of their Y, and of the abdomen.
pub(crate) const SIDES: [(&str, f64); 2] = [("left_side", 1.0), ("right_side", -1.0)];
pub(crate) const ABDOMEN_SIDE: &str = "abdomen_side";
/// Plates of the sides of the pelvis, named as the spheres that press them.
pub(crate) const PELVIS: [(&str, f64); 2] = [("left_pelvis", 1.0), ("right_pelvis", -1.0)];

/// Numbers of a part that yields: of an average man's sternum, and of others.
struct Part {
    mass_kg: f64,
    /// m and N.
    spring: &'static [[f64; 2]],
    returned: f64,
    /// N·s/m, N·s²/m², and N·s/m outwards.
    damper: [f64; 3],
    /// Shares of belts and of bags.
    share: f64,
}

const PERSON: Part = Part {
    mass_kg: 0.20,
    spring: &[[0.0, 0.0], [0.022, 220.0], [0.1, 4120.0]],
    returned: 0.3,
    damper: [40.0, 116.0, 650.0],
    share: 0.35,
};
const DUMMY_50: Part = Part {
    mass_kg: 0.9,
    spring: &[[0.0, 0.0], [0.1, 6000.0]],
    returned: 1.0,
    damper: [640.0, 0.0, 640.0],
    share: 0.20,
};
const DUMMY_05F: Part = Part {
    mass_kg: 0.2,
    spring: &[[0.0, 0.0], [0.04, 2000.0], [0.1, 12200.0]],
    returned: 0.7,
    damper: [440.0, 0.0, 440.0],
    share: 0.20,
};

/// Ribs of a side of `es2`: mass and returned fraction are guesses.
const ES2_RIBS: Part =
    Part { mass_kg: 1.2, spring: &[[0.0, 0.0], [0.1, 9600.0]], returned: 0.9, damper: [480.0, 0.0, 480.0], share: 0.0 };
/// Flesh, trochanter and pelvic ring of a side of an average man's pelvis, fitted to hubs at 5.2 m/s (Viano 1989); returned
/// fraction and damper outwards are guesses.
const PELVIS_OF_PERSON: Part = Part {
    mass_kg: 0.3,
    spring: &[[0.0, 0.0], [0.006, 312.0], [0.1, 8866.0]],
    returned: 0.3,
    damper: [20.0, 475.0, 184.0],
    share: 0.0,
};
/// The same of `es2`, fitted to 49 CFR 572.188: peak and its time. Mass and returned fraction are guesses.
const ES2_PELVIS: Part = Part {
    mass_kg: 0.5,
    spring: &[[0.0, 0.0], [0.0125, 500.0], [0.1, 34625.0]],
    returned: 0.7,
    damper: [600.0, 0.0, 600.0],
    share: 0.0,
};
/// Share of the force on the pelvis of `es2` that its pubic symphysis feels: the means of 49 CFR 572.188, 1.41 and 5.05 kN.
const PUBIC_SHARE: f64 = 0.28;
/// Abdomen of `es2`: the share of a contact's force that its load cells feel, spring, N/m, and damper, N·s/m.
const ES2_ABDOMEN: [f64; 3] = [0.55, 44e3, 60.0];
/// The same of a person, as from the front.
const ABDOMEN: [f64; 3] = [1.0, 30e3, 300.0];
/// Half of the breadth of the chest of an ES-2, m.
const ES2_HALF_M: f64 = 0.140;

/// Scale factors of a chest.
struct Scale {
    mass: f64,
    force: f64,
    depth: f64,
}

/// From two masses and a spring at equal speed: forces scale as √(R_m R_k), depths as √(R_m/R_k), times stay.
impl Scale {
    const NONE: Scale = Scale { mass: 1.0, force: 1.0, depth: 1.0 };

    fn of(mass: f64, depth: f64) -> Self {
        let stiffness = trig::pow(depth, BY_DEPTH);
        Scale { mass, force: (mass * stiffness).sqrt(), depth: (mass / stiffness).sqrt() }
    }
}

/// The keys under `[body]` of the chest of a body, scaled from `reference` as from one person to another.
pub(super) fn words(
    choice: ChestChoice,
    body: &Body,
    [person, of_reference]: [Person; 2],
    reference: &Body,
) -> Vec<String> {
    let Some(torso) = body.tree.landmarks().chest else { return Vec::new() };
    let (own, other) = (body.segment(torso), reference.segment(torso));
    let depth_m = person.chest_depth_m();
    let (breastbone, scale, depth_m) = match choice {
        ChestChoice::Rigid => return Vec::new(),
        ChestChoice::Person => {
            let scale = Scale::of(own.mass_kg / other.mass_kg, depth_m / of_reference.chest_depth_m());
            (PERSON, scale, depth_m)
        }
        ChestChoice::Dummy50 => (DUMMY_50, Scale::NONE, 0.229),
        ChestChoice::Dummy05f => (DUMMY_05F, Scale::NONE, 0.187),
    };
    let name = body.tree[torso].name;
    let (stretch, height_m) = (own.length_m / other.length_m, HEIGHT * own.length_m);
    let at = |y_m: f64, below_m: f64| [0.1 * stretch, y_m * stretch, height_m - below_m * stretch];
    let plate = |plate: &str, at: [f64; 3], mass_kg: f64| header(plate, name, at, "[-1, 0, 0]", mass_kg, Some(depth_m));
    let mut lines = vec![ride(breastbone.share)];
    lines.extend(plate("sternum", at(0.0, 0.0), scale.mass * breastbone.mass_kg));
    lines.extend(breastbone.words(&scale));
    if choice == ChestChoice::Person {
        for (side, y_m) in [("left_ribs", 0.1), ("right_ribs", -0.1)] {
            lines.extend(plate(side, at(y_m, 0.115), scale.mass * 0.3));
        }
        lines.extend(link("rib_cage", 1.0, 37.5e3, 150.0, &scale));
        lines.extend(link("rocking", -1.0, 6.7e3, 60.0, &scale));
    }
    lines
}

/// The keys under `[body]` of ribs and of an abdomen that yield to the side, scaled as those of [`words`].
pub(super) fn sides(
    choice: SidesChoice,
    body: &Body,
    [person, of_reference]: [Person; 2],
    reference: &Body,
) -> Vec<String> {
    let (Some(torso), Some(chest)) = (body.tree.landmarks().chest, body.sphere("chest")) else { return Vec::new() };
    let larger = |segment: Segment| body.segment(segment).mass_kg / reference.segment(segment).mass_kg;
    let (ribs, pelvis, [_, stiffness, damping], scale) = match choice {
        SidesChoice::Rigid => return Vec::new(),
        SidesChoice::Person => {
            let scale = Scale::of(larger(torso), person.chest_depth_m() / of_reference.chest_depth_m());
            (PERSON, PELVIS_OF_PERSON, ABDOMEN, scale)
        }
        SidesChoice::Es2 => (ES2_RIBS, ES2_PELVIS, ES2_ABDOMEN, Scale::NONE),
    };
    let (half_m, chest) = (half_breadth_m(choice, body), &body.spheres[chest]);
    let (name, z_m) = (body.tree[torso].name, chest.centre_from_lower_end_m.z);
    let mut lines = Vec::new();
    for (plate, sign) in SIDES {
        let inward = format!("[0, {}, 0]", -sign);
        let at = [0.0, sign * half_m, z_m];
        lines.extend(header(plate, name, at, &inward, scale.mass * ribs.mass_kg, Some(2.0 * half_m)));
        lines.extend(ribs.words(&scale));
    }
    lines.extend(pelvis_sides(choice, &pelvis, body, larger));
    let Some(above) = middle(body) else { return lines };
    let (name, length_m) = (body.tree[above].name, body.segment(above).length_m);
    let mass_kg = (0.1 * body.segment(above).mass_kg).min(0.5);
    lines.extend(header(ABDOMEN_SIDE, name, [0.0, 0.0, 0.5 * length_m], "[0, -1, 0]", mass_kg, None));
    lines.push(format!("spring = {{ depth = [0, 1], force = [0, {}], returned = 0.3 }}", number(stiffness)));
    lines.push(format!("damper = {{ linear = {} }}", number(damping)));
    lines
}

/// The same of the sides of a pelvis; `larger` is the ratio of a segment's mass to that of the reference.
fn pelvis_sides(choice: SidesChoice, own: &Part, body: &Body, larger: impl Fn(Segment) -> f64) -> Vec<String> {
    let Some((segment, sphere)) = body.tree.landmarks().pelvis.zip(body.sphere("pelvis")) else { return Vec::new() };
    let scale = if choice == SidesChoice::Es2 { Scale::NONE } else { Scale::of(larger(segment), 1.0) };
    let (name, sphere) = (body.tree[segment].name, &body.spheres[sphere]);
    let side = |(plate, sign): (&str, f64)| {
        let at = [0.0, sign * shape::PELVIS_OUT * sphere.radius_m, sphere.centre_from_lower_end_m.z];
        let inward = format!("[0, {}, 0]", -sign);
        let mut lines = header(plate, name, at, &inward, scale.mass * own.mass_kg, None);
        lines.extend(own.words(&scale));
        lines
    };
    PELVIS.into_iter().flat_map(side).collect()
}

/// Half of the breadth of a chest: out to the surface of the spheres at its sides; of a dummy the defined value, m.
pub(crate) fn half_breadth_m(choice: SidesChoice, body: &Body) -> f64 {
    let chest_m = body.sphere("chest").map_or(f64::NAN, |chest| body.spheres[chest].radius_m);
    if choice == SidesChoice::Es2 { ES2_HALF_M } else { shape::CHEST_OUT * chest_m }
}

/// Share of the force of a contact from the side on the abdomen's plate.
pub(crate) fn share_of_abdomen(choice: SidesChoice) -> f64 {
    if choice == SidesChoice::Es2 { ES2_ABDOMEN[0] } else { ABDOMEN[0] }
}

/// Share of the force on the pelvis that a dummy's pubic symphysis feels.
pub(crate) fn pubic_share(choice: SidesChoice) -> Option<f64> {
    (choice == SidesChoice::Es2).then_some(PUBIC_SHARE)
}

/// Part of the trunk between chest and pelvis.
fn middle(body: &Body) -> Option<Segment> {
    let marks = body.tree.landmarks();
    above(body, marks.pelvis?).filter(|segment| Some(*segment) != marks.chest)
}

/// First keys of a plate.
fn header(plate: &str, segment: &str, at: [f64; 3], inward: &str, mass_kg: f64, depth_m: Option<f64>) -> Vec<String> {
    let mut lines = vec![
        format!("[body.plates.{plate}]"),
        format!("segment = {segment:?}"),
        format!("at = {}", list(&at)),
        format!("inward = {inward}"),
        format!("mass = {}", number(mass_kg)),
    ];
    lines.extend(depth_m.map(|depth_m| format!("depth = {}", number(depth_m))));
    lines
}

/// The keys under `[body]` of flesh between a lap belt and the pelvis. All values are guesses within a factor of two,
/// not from any curve of a lap belt on a pelvis. Its depth is that of the flesh in front of an average man's iliac
/// spines, some 40 mm: 60 kN/m to 20 mm, then it bottoms out, and from 35 mm on the belt bears on bone with 1 MN/m.
pub(super) fn flesh(body: &Body) -> [String; 2] {
    let Some(pelvis) = body.tree.landmarks().pelvis else { return [String::new(), String::new()] };
    let radius_m = body.sphere("pelvis").map_or(0.1, |sphere| body.spheres[sphere].radius_m);
    let plate = [
        "[body.plates.flesh]".to_owned(),
        format!("segment = {:?}", body.tree[pelvis].name),
        format!("at = {}", list(&[PLACE[0] * radius_m, 0.0, PLACE[1] * radius_m])),
        "inward = [-1, 0, 0]".to_owned(),
        "mass = 0.5".to_owned(),
        "spring = { depth = [0, 0.02, 0.035, 0.06], force = [0, 1200, 6200, 31200], returned = 0.3 }".to_owned(),
        "damper = { linear = 500 }".to_owned(),
    ];
    ["pelvis.ride = { belt = { flesh = 1 } }".to_owned(), plate.join("\n")]
}

/// The keys under `[body]` of an abdomen on the part of the trunk above the pelvis: those of its sphere, then those of
/// its plate. 30 kN/m and 300 N·s/m: 2.7 kN at 49 mm and 4 m/s, 8 kN at 138 mm and 13 m/s, two corner figures of belt
/// pretensioners on eight abdomens (Foster 2006); mass, position and size are guesses.
pub(super) fn abdomen(body: &Body) -> Option<[String; 2]> {
    let above = middle(body)?;
    let (name, length_m) = (body.tree[above].name, body.segment(above).length_m);
    let pelvis_m = body.sphere("pelvis").map_or(0.1, |sphere| body.spheres[sphere].radius_m);
    let (radius_m, height_m) = (0.9 * pelvis_m, 0.5 * length_m);
    let sphere = format!(
        "abdomen = {{ segment = {name:?}, radius = {}, centre = {}, ride = {{ contact = {{ abdomen = 1 }}, belt = {{ abdomen = 1 }}, bag = {{ abdomen = 1 }} }} }}",
        number(radius_m),
        list(&[0.1 * pelvis_m, 0.0, height_m])
    );
    let plate = [
        "[body.plates.abdomen]".to_owned(),
        format!("segment = {name:?}"),
        format!("at = {}", list(&[0.1 * pelvis_m + radius_m, 0.0, height_m])),
        "inward = [-1, 0, 0]".to_owned(),
        format!("mass = {}", number((0.1 * body.segment(above).mass_kg).min(0.5))),
        "spring = { depth = [0, 0.138], force = [0, 4140], returned = 0.3 }".to_owned(),
        "damper = { linear = 300 }".to_owned(),
    ];
    Some([sphere, plate.join("\n")])
}

/// Motion of the chest sphere with the plates; the preceding lines are those of `[body.spheres]`.
fn ride(share: f64) -> String {
    format!(
        "chest.ride = {{ contact = {{ sternum = 1 }}, belt = {{ sternum = {share} }}, bag = {{ sternum = {share} }} }}"
    )
}

impl Part {
    fn words(&self, scale: &Scale) -> Vec<String> {
        let axis = |i: usize, by: f64| list(&self.spring.iter().map(|point| point[i] * by).collect::<Vec<_>>());
        let [linear, quadratic, outward] = self.damper.map(|c| number(c * scale.force));
        let (depths, forces) = (axis(0, scale.depth), axis(1, scale.force));
        vec![
            format!("spring = {{ depth = {depths}, force = {forces}, returned = {} }}", self.returned),
            format!("damper = {{ linear = {linear}, quadratic = {quadratic}, outward = {outward} }}"),
        ]
    }
}

/// A number with a fixed width.
fn number(value: f64) -> String {
    format!("{value:.16e}")
}

fn list(values: &[f64]) -> String {
    format!("[{}]", values.iter().map(|value| number(*value)).collect::<Vec<_>>().join(", "))
}

/// A link between the lower ribs of both sides: their sum or their difference.
fn link(name: &str, right: f64, stiffness: f64, damping: f64, scale: &Scale) -> Vec<String> {
    vec![
        format!("[body.plate_links.{name}]"),
        format!("of = {{ left_ribs = 1, right_ribs = {right} }}"),
        format!("spring = {{ stiffness = {} }}", number(stiffness * scale.force / scale.depth)),
        format!("damper = {{ linear = {} }}", number(damping * scale.force)),
    ]
}
