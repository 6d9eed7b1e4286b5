//! Bodies of people of any size: one measured body, scaled segment by segment.
//!
//! The base body is the 50th-percentile male of the GEBOD generator (US Air Force) in its 15 segments. Each segment's
//! depth, breadth and length scale with a measure of the person. A regression over the 4082 men or 1986 women of the
//! ANSUR II survey (US Army) gives that measure from sex, stature and mass. There is no such survey of children: theirs
//! are scalings of the same body, from the weights and sitting heights of 49 CFR 571.208 S7.1.4 and mass fractions of
//! Jensen; the lengths of their segments are the least certain numbers here.
//!
//! The 15 segments are used directly (`divided`), or are merged to the 12 of [`super::tti12::TTI12`] by the
//! parallel-axis theorem, products of inertia neglected. The neck's joint of the 12 is 125 mm below the centre of
//! gravity of the reference head. There a single joint gives the path of a dummy's head in the neck pendulum of 49 CFR
//! 572.7 (chords of 2ρ sin(θ/2) with ρ = 122 to 128 mm at 30, 60 and 68 degrees). The neck's mass belongs to the upper
//! torso.

mod divided;
mod merged;
mod spread;

use super::Body;

/// Sex, which selects the regressions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sex {
    /// Female.
    Female,
    /// Male.
    Male,
}

/// Scaling of a body relative to the reference.
struct Stretch {
    /// Depth, breadth and length of each part relative to the reference's.
    scale: [[f64; 3]; PARTS],
    mass_kg: [f64; PARTS],
    shoulder_half_width: f64,
    hip_half_width: f64,
}

const PARTS: usize = 10;
// places of the parts in the tables below; from the thigh on one of two
const LT: usize = 0; // lower torso
const CT: usize = 1; // centre torso
const UT: usize = 2; // upper torso
const N: usize = 3; // neck
const H: usize = 4; // head
const UL: usize = 5; // thigh
const LL: usize = 6; // shank
const F: usize = 7; // foot
const UA: usize = 8; // upper arm
const LA: usize = 9; // forearm with hand

const INCH_M: f64 = 0.0254;
const POUND_KG: f64 = 0.453_592_37;
/// lbf in s² in kg m².
const INERTIA_KG_M2: f64 = 0.112_984_829;

/// Division of a body into segments.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Division {
    /// 12, as in the report.
    #[default]
    Twelve,
    /// 15, with a neck and feet.
    Fifteen,
    /// 17, with hands too.
    Seventeen,
    /// 19, with clavicles too.
    Nineteen,
}

impl Division {
    /// The division with this number of segments.
    pub fn of(segments: i64) -> Option<Division> {
        match segments {
            12 => Some(Division::Twelve),
            15 => Some(Division::Fifteen),
            17 => Some(Division::Seventeen),
            19 => Some(Division::Nineteen),
            _ => None,
        }
    }

    const fn has_hands(self) -> bool {
        matches!(self, Division::Seventeen | Division::Nineteen)
    }

    const fn has_clavicles(self) -> bool {
        matches!(self, Division::Nineteen)
    }
}

/// A part of the reference: weight in lb; principal inertias in lbf in s²; rotation of the principal axes about Y in
/// degrees.
struct Part(f64, [f64; 3], f64);

const REFERENCE: [Part; PARTS] = [
    Part(24.87, [0.9202, 0.8451, 1.0672], 0.0),
    Part(5.10, [0.1448, 0.0809, 0.2189], 0.0),
    Part(52.87, [4.3586, 3.2111, 2.7229], 14.4),
    Part(2.26, [0.0154, 0.0185, 0.0231], 0.0),
    Part(9.29, [0.1808, 0.2063, 0.1340], 36.0),
    Part(21.03, [1.3844, 1.4593, 0.3829], 0.0),
    Part(8.23, [0.5118, 0.5196, 0.0600], 0.0),
    Part(2.06, [0.0397, 0.0376, 0.0072], 0.0),
    Part(4.21, [0.1141, 0.1213, 0.0236], 0.0),
    Part(4.05, [0.2667, 0.2654, 0.0154], 0.0),
];
/// Half widths of shoulders and hips, inches.
const REFERENCE_HALF_WIDTHS: [f64; 2] = [6.57, 3.35];
/// Radius of each standard sphere in inches, the part it scales with, and the axis of that part.
const REFERENCE_SPHERES: [(f64, usize, usize); 17] = [
    (3.9, H, 2),
    (4.8, UT, 0),
    (4.7, LT, 0),
    (2.5, UA, 0),
    (2.5, UA, 0),
    (2.0, UA, 0),
    (2.0, UA, 0),
    (1.8, LA, 0),
    (1.8, LA, 0),
    (3.4, UL, 0),
    (3.4, UL, 0),
    (2.4, LL, 0),
    (2.4, LL, 0),
    (2.3, LL, 0),
    (2.3, LL, 0),
    (1.9, F, 1),
    (1.9, F, 1),
];

/// A measure of the body, mm: b₀ + b₁·stature/mm + b₂·mass/kg, of men and of women.
type Measure = [[f64; 3]; 2];

const STATURE: Measure = [[0.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
const SUPRASTERNALE: Measure = [[-70.78, 0.84194, 0.3595], [-66.20, 0.84309, 0.3386]];
const TROCHANTERION: Measure = [[-189.02, 0.63152, -0.2237], [-121.29, 0.59070, 0.0694]];
const CERVICALE: Measure = [[-56.09, 0.88332, 0.2582], [-84.60, 0.90600, 0.0718]];
const EPICONDYLE: Measure = [[-96.58, 0.33691, -0.0403], [-72.84, 0.32491, 0.1428]];
const MALLEOLUS: Measure = [[11.73, 0.03098, 0.0791], [6.92, 0.03381, 0.0113]];
const UPPER_ARM_LENGTH: Measure = [[-14.56, 0.19553, 0.0749], [-18.53, 0.19451, 0.1915]];
const FOREARM_HAND_LENGTH: Measure = [[21.97, 0.25443, 0.1334], [14.25, 0.25042, 0.2629]];
const FOOT_LENGTH: Measure = [[44.93, 0.12038, 0.1735], [37.85, 0.11804, 0.2393]];
const BUTTOCK_DEPTH: Measure = [[259.04, -0.09808, 1.8598], [263.63, -0.11128, 2.2215]];
const HIP_BREADTH: Measure = [[232.57, -0.00647, 1.4562], [262.42, -0.03156, 2.1078]];
const WAIST_DEPTH: Measure = [[302.40, -0.15329, 2.3921], [317.07, -0.18103, 2.8154]];
const WAIST_BREADTH: Measure = [[306.01, -0.10326, 2.3593], [295.90, -0.11378, 2.7934]];
const CHEST_DEPTH: Measure = [[258.13, -0.08938, 1.7853], [277.81, -0.11634, 2.3473]];
const CHEST_BREADTH: Measure = [[206.20, 0.00356, 0.9002], [206.35, -0.01285, 1.2383]];
const NECK_GIRTH: Measure = [[407.76, -0.08508, 1.6290], [305.82, -0.04685, 1.4799]];
const THIGH_GIRTH: Measure = [[594.74, -0.18359, 4.1254], [584.01, -0.19423, 5.1423]];
const CALF_GIRTH: Measure = [[350.96, -0.06845, 1.8884], [305.85, -0.05141, 2.2304]];
const UPPER_ARM_GIRTH: Measure = [[380.30, -0.12234, 2.2531], [341.41, -0.13988, 2.8331]];
const FOREARM_GIRTH: Measure = [[252.74, -0.03150, 1.3172], [215.88, -0.03185, 1.4768]];
const HEAD_LENGTH: Measure = [[144.73, 0.02454, 0.1366], [134.30, 0.02787, 0.1496]];
const HEAD_BREADTH: Measure = [[156.56, -0.00861, 0.1508], [135.12, 0.00368, 0.0981]];
const HEAD_HEIGHT: Measure = [[103.22, 0.01396, 0.0400], [98.18, 0.01328, 0.0983]];
const BIACROMIAL: Measure = [[204.59, 0.09168, 0.5855], [131.99, 0.12829, 0.3607]];
const BICRISTAL: Measure = [[105.89, 0.06345, 0.6795], [165.83, 0.00934, 1.3616]];

const TRUNK_LENGTH: Measure = above(SUPRASTERNALE, TROCHANTERION);

/// Measures that scale depth, breadth and length of each part.
const MEASURES: [[Measure; 3]; PARTS] = [
    [BUTTOCK_DEPTH, HIP_BREADTH, TRUNK_LENGTH],
    [WAIST_DEPTH, WAIST_BREADTH, TRUNK_LENGTH],
    [CHEST_DEPTH, CHEST_BREADTH, TRUNK_LENGTH],
    [NECK_GIRTH, NECK_GIRTH, above(STATURE, CERVICALE)],
    [HEAD_LENGTH, HEAD_BREADTH, HEAD_HEIGHT],
    [THIGH_GIRTH, THIGH_GIRTH, above(TROCHANTERION, EPICONDYLE)],
    [CALF_GIRTH, CALF_GIRTH, above(EPICONDYLE, MALLEOLUS)],
    [MALLEOLUS, FOOT_LENGTH, FOOT_LENGTH],
    [UPPER_ARM_GIRTH, UPPER_ARM_GIRTH, UPPER_ARM_LENGTH],
    [FOREARM_GIRTH, FOREARM_GIRTH, FOREARM_HAND_LENGTH],
];

/// Difference of two heights.
const fn above(upper: Measure, lower: Measure) -> Measure {
    let (mut difference, mut i) = (upper, 0);
    while i < 6 {
        difference[i / 3][i % 3] -= lower[i / 3][i % 3];
        i += 1;
    }
    difference
}

/// Children of 6 and 10 years: girth and length of each part relative to the reference's, and its mass, kg.
const CHILD_06: [[f64; 3]; PARTS] = [
    [0.6306, 0.6165, 2.764],
    [0.6306, 0.6165, 0.567],
    [0.6306, 0.6165, 5.875],
    [0.9061, 0.9061, 0.762],
    [0.9061, 0.9061, 3.134],
    [0.5593, 0.6109, 1.820],
    [0.6576, 0.6109, 0.985],
    [0.8440, 0.6109, 0.407],
    [0.6445, 0.6481, 0.514],
    [0.6138, 0.6481, 0.450],
];
const CHILD_10: [[f64; 3]; PARTS] = [
    [0.7579, 0.7252, 4.700],
    [0.7579, 0.7252, 0.964],
    [0.7579, 0.7252, 9.992],
    [0.9683, 0.9683, 0.931],
    [0.9683, 0.9683, 3.826],
    [0.7227, 0.7592, 3.779],
    [0.8148, 0.7592, 1.884],
    [1.0306, 0.7592, 0.754],
    [0.8620, 0.7692, 1.089],
    [0.8012, 0.7692, 0.907],
];

/// An adult.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Person {
    /// Sex.
    pub sex: Sex,
    /// Standing height.
    pub stature_m: f64,
    /// Mass of the whole body.
    pub mass_kg: f64,
}

/// Built-in adults: the reference itself, and those of 49 CFR 571.208 by their masses, with the statures commonly used
/// with them.
const PEOPLE: [(&str, Person); 4] = [
    ("female05", Person { sex: Sex::Female, stature_m: 1.511, mass_kg: 46.27 }),
    ("female50", Person { sex: Sex::Female, stature_m: 1.621, mass_kg: 59.3 }),
    ("male50", REFERENCE_PERSON),
    ("male95", Person { sex: Sex::Male, stature_m: 1.869, mass_kg: 97.52 }),
];
/// The reference person: a 50th-percentile male.
pub const REFERENCE_PERSON: Person = Person { sex: Sex::Male, stature_m: 1.7734, mass_kg: 173.55 * POUND_KG };

/// Range accepted by [`Person::is_within_reach`].
pub const REACH: &str = "an adult of 1.4 to 2.05 m with a body mass index of 17 to 45 kg/m²";

impl Person {
    /// The built-in person with this name.
    pub fn named(name: &str) -> Option<Person> {
        PEOPLE.iter().find(|(other, _)| *other == name).map(|(_, person)| *person)
    }

    /// Depth of the chest from stature and mass, a regression of the ANSUR II survey, m.
    pub fn chest_depth_m(&self) -> f64 {
        0.25813 - 0.08938 * self.stature_m + 1.7853e-3 * self.mass_kg
    }

    /// Whether the person is within the range of the surveys: see [`REACH`].
    pub fn is_within_reach(&self) -> bool {
        (1.4..=2.05).contains(&self.stature_m) && (17.0..=45.0).contains(&(self.mass_kg / self.stature_m.powi(2)))
    }

    /// A measure, mm.
    fn measure(&self, measure: &Measure) -> f64 {
        let [b_0, b_stature, b_mass] = measure[usize::from(self.sex == Sex::Female)];
        b_0 + b_stature * (1e3 * self.stature_m) + b_mass * self.mass_kg
    }

    /// A measure relative to the reference's.
    fn ratio(&self, measure: &Measure) -> f64 {
        self.measure(measure) / REFERENCE_PERSON.measure(measure)
    }

    /// The scaling, and the factor on all masses except head and neck that gives the person's mass: far from 1, the
    /// regressions do not fit this person.
    fn stretch(&self) -> (Stretch, f64) {
        let scale = MEASURES.each_ref().map(|measures| measures.each_ref().map(|m| self.ratio(m)));
        let by_volume = |k: usize| REFERENCE[k].0 * POUND_KG * scale[k].iter().product::<f64>();
        let head = by_volume(N) + by_volume(H);
        let rest: f64 = (0..PARTS).filter(|k| ![N, H].contains(k)).map(|k| both(k) * by_volume(k)).sum();
        let factor = (self.mass_kg - head) / rest;
        let mass_kg = std::array::from_fn(|k| by_volume(k) * if [N, H].contains(&k) { 1.0 } else { factor });
        let [shoulder_half_width, hip_half_width] = [BIACROMIAL, BICRISTAL].map(|m| self.ratio(&m));
        (Stretch { scale, mass_kg, shoulder_half_width, hip_half_width }, factor)
    }

    /// The body, and the factor on its masses: see the module.
    pub fn body(&self, division: Division) -> (Body, f64) {
        let (stretch, factor) = self.stretch();
        (stretch.body(division), factor)
    }
}

impl Body {
    /// The 50th-percentile male (1.773 m, 78.7 kg) of the GEBOD generator with the report's 17 spheres, and the neck
    /// joint of a dummy: `body.preset = "male50"`.
    pub fn male50() -> Self {
        Body { name: "male50".to_owned(), ..REFERENCE_PERSON.body(Division::default()).0 }
    }

    /// An adult by sex, stature and mass, as a scenario's `body.sex`, `body.stature`, `body.mass`; none outside the
    /// range of the surveys.
    pub fn person(sex: Sex, stature_m: f64, mass_kg: f64) -> Option<Self> {
        let person = Person { sex, stature_m, mass_kg };
        person.is_within_reach().then(|| person.body(Division::default()).0)
    }
}

/// The child with a preset's name.
pub fn child(name: &str, division: Division) -> Option<Body> {
    let (rows, [shoulder_m, hip_m]) = match name {
        "child06" => (&CHILD_06, [0.1082, 0.0497]),
        "child10" => (&CHILD_10, [0.1283, 0.0597]),
        _ => return None,
    };
    let [shoulder_inch, hip_inch] = REFERENCE_HALF_WIDTHS;
    let stretch = Stretch {
        scale: rows.map(|[girth, length, _]| [girth, girth, length]),
        mass_kg: rows.map(|[_, _, mass_kg]| mass_kg),
        shoulder_half_width: shoulder_m / (shoulder_inch * INCH_M),
        hip_half_width: hip_m / (hip_inch * INCH_M),
    };
    Some(stretch.body(division))
}

/// Number of this part in a body: 1 or 2.
const fn both(part: usize) -> f64 {
    if part < UL { 1.0 } else { 2.0 }
}

impl Stretch {
    /// Scaled length of a part along one of its axes, m; the reference's is in inches.
    fn along(&self, part: usize, axis: usize, inches: f64) -> f64 {
        self.scale[part][axis] * inches * INCH_M
    }

    /// Principal moments of a part, scaled as second moments of mass, S_xx = (I_y + I_z − I_x)/2, kg m².
    fn principal(&self, part: usize) -> [f64; 3] {
        let Part(pounds, [ix, iy, iz], _) = REFERENCE[part];
        let [sx, sy, sz] = self.scale[part];
        let heavier = 0.5 * INERTIA_KG_M2 * self.mass_kg[part] / (pounds * POUND_KG);
        let [xx, yy, zz] = [(iy + iz - ix) * sx * sx, (iz + ix - iy) * sy * sy, (ix + iy - iz) * sz * sz];
        [yy + zz, zz + xx, xx + yy].map(|inertia| heavier * inertia)
    }

    fn body(&self, division: Division) -> Body {
        let mut body = match division {
            Division::Twelve => self.merged(),
            Division::Fifteen | Division::Seventeen | Division::Nineteen => self.divided(division),
        };
        let radii_m = REFERENCE_SPHERES.map(|(inches, part, axis)| self.along(part, axis, inches));
        body.spheres = body.standard_spheres(&radii_m);
        body
    }

    /// Distance of a part's joint from the middle plane, m.
    fn half_width_m(&self, part: usize) -> f64 {
        let [shoulder_inch, hip_inch] = REFERENCE_HALF_WIDTHS;
        match part {
            UA => self.shoulder_half_width * shoulder_inch * INCH_M,
            UL => self.hip_half_width * hip_inch * INCH_M,
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use approx::{assert_abs_diff_eq, assert_relative_eq};

    use nalgebra::{Matrix3, Vector3};

    use super::*;
    use crate::body::SegmentProperties;

    /// Segments that a neck's place does not touch: length m, mass kg, ρ m, I_x, I_y, I_z kg m², as an independent
    /// computation gave them, rounded.
    type Row = (usize, [f64; 6]);
    const FIFTEEN: [(&str, [f64; 4]); 10] = [
        ("lower_torso", [6.834, 0.05050, 0.04158, 0.05873]),
        ("middle_torso", [1.147, 0.00546, 0.00287, 0.00807]),
        ("upper_torso", [13.787, 0.20325, 0.14924, 0.13273]),
        ("neck", [0.586, 0.00070, 0.00082, 0.00093]),
        ("head", [3.448, 0.01477, 0.01652, 0.01077]),
        ("left_thigh", [5.787, 0.06809, 0.07216, 0.02078]),
        ("left_lower_leg", [2.248, 0.02592, 0.02632, 0.00313]),
        ("left_foot", [0.477, 0.00028, 0.00150, 0.00160]),
        ("left_upper_arm", [0.859, 0.00405, 0.00426, 0.00070]),
        ("left_forearm", [0.864, 0.00989, 0.00984, 0.00050]),
    ];
    const FEMALE_05: [Row; 6] = [
        (0, [0.0654, 1.147, 0.0477, 0.00546, 0.00287, 0.00807]),
        (3, [0.0798, 6.834, 0.0323, 0.05050, 0.04158, 0.05873]),
        (4, [0.2191, 0.859, 0.1076, 0.00405, 0.00426, 0.00070]),
        (6, [0.3461, 0.864, 0.1956, 0.00989, 0.00984, 0.00050]),
        (8, [0.3709, 5.787, 0.2095, 0.06809, 0.07216, 0.02078]),
        (10, [0.4217, 2.725, 0.2281, 0.04924, 0.05263, 0.00649]),
    ];
    const MALE_95: [Row; 6] = [
        (0, [0.0828, 3.084, 0.0605, 0.02690, 0.01570, 0.04145]),
        (3, [0.1010, 14.246, 0.0408, 0.15073, 0.14302, 0.18229]),
        (4, [0.2761, 2.393, 0.1356, 0.01821, 0.01942, 0.00397]),
        (6, [0.4365, 2.220, 0.2466, 0.04061, 0.04040, 0.00242]),
        (8, [0.4669, 12.198, 0.2637, 0.22651, 0.23963, 0.06706]),
        (10, [0.5253, 5.679, 0.2804, 0.16171, 0.17374, 0.02180]),
    ];

    fn named(name: &str) -> (Body, f64) {
        Person::named(name).expect("a preset").body(Division::Twelve)
    }

    fn agrees(body: &Body, rows: &[Row], relative: f64) {
        for (n, expected) in rows {
            let p = &body.segments[*n];
            let i = p.inertia_kg_m2;
            let got = [p.length_m, p.mass_kg, p.cg_from_lower_end_m, i.x, i.y, i.z];
            let rounding = [5e-5, 5e-4, 5e-5, 2e-5, 2e-5, 2e-5];
            for (k, ((got, expected), rounding)) in got.iter().zip(expected).zip(rounding).enumerate() {
                let bound = 1.02 * rounding + relative * expected;
                assert!((got - expected).abs() <= bound, "segment {n}, number {k}: {got} and {expected}");
            }
        }
    }

    #[test]
    fn people_of_the_rule_are_those_of_an_independent_computation() {
        let ((small, small_factor), (large, large_factor)) = (named("female05"), named("male95"));
        agrees(&small, &FEMALE_05, 6e-4);
        agrees(&large, &MALE_95, 6e-4);
        assert_abs_diff_eq!(small_factor, 0.910, epsilon = 5e-4);
        assert_abs_diff_eq!(large_factor, 0.996, epsilon = 5e-4);
        assert_abs_diff_eq!(small.segments[1].mass_kg + small.segments[2].mass_kg, 13.787 + 4.034, epsilon = 1e-3);
        assert_abs_diff_eq!(small.shoulder_half_width_m, 0.1383, epsilon = 5e-5);
        assert_abs_diff_eq!(large.hip_half_width_m, 0.0910, epsilon = 5e-5);
        let radii_mm = [101, 135, 133, 69, 69, 55, 55, 49, 49, 95, 95, 66, 66, 63, 63, 51, 51];
        for (sphere, radius_mm) in large.spheres.iter().zip(radii_mm) {
            assert_abs_diff_eq!(1e3 * sphere.radius_m, f64::from(radius_mm), epsilon = 0.51);
        }
    }

    #[test]
    fn children_are_those_of_an_independent_computation() {
        let rows = [
            (0, [0.0482, 0.567, 0.0352, 0.00159, 0.00089, 0.00241]),
            (3, [0.0589, 2.764, 0.0238, 0.00995, 0.00913, 0.01174]),
            (8, [0.2692, 1.820, 0.1520, 0.01093, 0.01143, 0.00258]),
            (10, [0.3181, 1.391, 0.1580, 0.01543, 0.01670, 0.00227]),
        ];
        let body = child("child06", Division::Twelve).expect("a preset");
        agrees(&body, &rows, 2e-3);
        assert_abs_diff_eq!(body.mass_kg(), 21.45, epsilon = 0.01);
        assert_abs_diff_eq!(child("child10", Division::Twelve).expect("a preset").mass_kg(), 37.24, epsilon = 0.01);
    }

    /// The neck's place moves no matter: mass, centre of gravity and inertia of neck, head and upper torso together are those
    /// of a head that turns at the shoulders.
    #[test]
    fn the_neck_is_cut_where_a_dummys_is_and_nothing_is_lost() {
        let (body, _) = named("male50");
        let (torso, head) = (&body.segments[1], &body.segments[2]);
        assert_relative_eq!(head.cg_from_lower_end_m, 4.92 * INCH_M, max_relative = 1e-12);
        assert_relative_eq!(body.neck_height_m, 3.89 * INCH_M, max_relative = 1e-12);
        let joint_m = torso.length_m + body.neck_height_m;
        let lever = |mass_kg: f64, height_m: f64| mass_kg * height_m;
        let now =
            lever(torso.mass_kg, torso.cg_from_lower_end_m) + lever(head.mass_kg, joint_m + head.cg_from_lower_end_m);
        let before = lever(52.87, 6.99) + lever(11.55, 11.34 + 7.94);
        assert_relative_eq!(now, before * POUND_KG * INCH_M, max_relative = 2e-4);
        assert_relative_eq!(joint_m + head.length_m, (11.34 + 13.71) * INCH_M, max_relative = 1e-12);
        let upright = |p: &SegmentProperties, below_m: f64| {
            p.inertia_kg_m2.x + p.mass_kg * (below_m + p.cg_from_lower_end_m).powi(2)
        };
        let before = 4.2574 + 0.2728 + (52.87 * 6.99 * 6.99 + 11.55 * 19.28 * 19.28) / 386.089;
        assert_relative_eq!(upright(torso, 0.0) + upright(head, joint_m), before * INERTIA_KG_M2, max_relative = 2e-4);
    }

    #[test]
    fn every_person_within_reach_is_possible_and_has_their_mass() {
        for sex in [Sex::Female, Sex::Male] {
            for (stature_m, index) in
                (0..=13).flat_map(|i| (0..=14).map(move |j| (1.4 + 0.05 * f64::from(i), 17.01 + 1.99 * f64::from(j))))
            {
                let person = Person { sex, stature_m, mass_kg: index * stature_m * stature_m };
                assert!(person.is_within_reach() || stature_m > 2.05, "{person:?}");
                let (body, factor) = person.body(Division::Twelve);
                assert_relative_eq!(body.mass_kg(), person.mass_kg, max_relative = 1e-12);
                assert!((0.5..2.0).contains(&factor), "{person:?}: {factor}");
                for p in &body.segments {
                    let i = p.inertia_kg_m2;
                    assert!(p.length_m > 0.0 && p.mass_kg > 0.0 && i.min() > 0.0, "{person:?}: {p:?}");
                    assert!(2.0 * i.max() <= i.sum() * (1.0 + 1e-12), "{person:?}: {i}");
                }
            }
        }
    }

    /// Height of the centre of gravity of an upright body above T1, m.
    fn cg_height_m(body: &Body) -> f64 {
        let mut joint_m = vec![0.0; body.segments.len()];
        let mut moment = 0.0;
        for segment in body.tree.segments() {
            let n = segment.index();
            if let Some(joint) = body.tree.carrier(segment) {
                joint_m[n] = joint_m[body.tree[joint].proximal.index()] + body.offset_m(segment).z;
            }
            let p = body.segment(segment);
            moment += p.mass_kg * (joint_m[n] + (p.cg_m() - body.joint_m(segment)).z);
        }
        moment / body.mass_kg()
    }

    fn divided(name: &str) -> [Body; 3] {
        [Division::Twelve, Division::Fifteen, Division::Seventeen].map(|division| {
            let made = child(name, division);
            made.unwrap_or_else(|| Person::named(name).expect("a preset").body(division).0)
        })
    }

    /// Bodies of 15 and 17 segments have the mass and centre of gravity of the 12 segments.
    #[test]
    fn a_body_of_more_segments_is_the_same_body() {
        for name in ["female05", "male50", "male95", "child06", "child10"] {
            let [twelve, fifteen, seventeen] = divided(name);
            assert_eq!([fifteen.segments.len(), seventeen.segments.len()], [15, 17]);
            for body in [&fifteen, &seventeen] {
                assert_relative_eq!(body.mass_kg(), twelve.mass_kg(), max_relative = 1e-12);
                assert_abs_diff_eq!(cg_height_m(body), cg_height_m(&twelve), epsilon = 1e-12);
                assert_eq!(body.places.len() + 1, body.segments.len());
                assert_eq!(body.spheres.len(), 17);
                for p in &body.segments {
                    let i = p.inertia_kg_m2;
                    assert!(i.min() > 0.0 && 2.0 * i.max() <= i.sum() * (1.0 + 1e-12), "{name}: {i}");
                }
            }
            let marks = fifteen.tree.landmarks();
            let (head, neck) = (marks.head.unwrap(), marks.neck.unwrap());
            assert_eq!((fifteen.tree[head].name, fifteen.tree[neck].name), ("head", "neck"));
            assert_eq!(fifteen.tree[fifteen.tree[neck].proximal].name, "neck");
            assert_eq!((marks.legs().count(), marks.arms().filter(|arm| arm.end.is_some()).count()), (2, 0));
            assert_eq!(seventeen.tree.landmarks().arms().filter(|arm| arm.end.is_some()).count(), 2);
        }
    }

    /// Masses and principal moments of an independent computation, rounded.
    #[test]
    fn fifteen_segments_are_those_of_an_independent_computation() {
        let [_, female, _] = divided("female05");
        let rows = FIFTEEN;
        for (name, [mass_kg, ix, iy, iz]) in rows {
            let segment = female.tree.segment_named(name).expect("a segment");
            let p = female.segment(segment);
            assert_abs_diff_eq!(p.mass_kg, mass_kg, epsilon = 6e-4 + 6e-4 * mass_kg);
            for (got, expected) in p.inertia_kg_m2.iter().zip([ix, iy, iz]) {
                assert_abs_diff_eq!(*got, expected, epsilon = 1.5e-5 + 1e-3 * expected);
            }
        }
    }

    /// Upper torso and clavicles together are the upper torso of 17 segments, and the shoulders stay where they are.
    #[test]
    fn a_clavicle_takes_nothing_away() {
        for name in ["male50", "female05", "child06"] {
            let made = [Division::Seventeen, Division::Nineteen].map(|division| {
                child(name, division).unwrap_or_else(|| Person::named(name).expect("a preset").body(division).0)
            });
            let sums = made.each_ref().map(|body| {
                let of = |name: &str| body.tree.segment_named(name).map(|s| (*body.segment(s), s));
                let parts = ["upper_torso", "left_clavicle", "right_clavicle"].into_iter().filter_map(of);
                let (mut mass_kg, mut moment, mut tensor) = (0.0, Vector3::zeros(), Matrix3::zeros());
                for (p, segment) in parts {
                    let own = body.tree.carrier(segment).filter(|_| segment != body.tree.landmarks().chest.unwrap());
                    let lower_m = own.map_or(Vector3::zeros(), |_| body.socket_m(segment) - body.joint_m(segment));
                    let (at, turn) = (p.cg_m() + lower_m, p.principal.to_rotation_matrix());
                    mass_kg += p.mass_kg;
                    moment += at * p.mass_kg;
                    let steiner = Matrix3::from_diagonal_element(at.norm_squared()) - at * at.transpose();
                    tensor += turn * Matrix3::from_diagonal(&p.inertia_kg_m2) * turn.transpose() + steiner * p.mass_kg;
                }
                let shoulder = body.spheres[body.sphere("left_shoulder").unwrap()].clone();
                (mass_kg, moment, tensor, shoulder, body.mass_kg())
            });
            let [whole, split] = sums;
            assert_relative_eq!(split.0, whole.0, max_relative = 1e-12);
            assert_relative_eq!(split.4, whole.4, max_relative = 1e-12);
            assert_abs_diff_eq!(split.1, whole.1, epsilon = 1e-12);
            assert_abs_diff_eq!(split.2, whole.2, epsilon = 1e-12);
            assert_eq!(split.3.radius_m, whole.3.radius_m);
            assert_eq!(made[1].tree[split.3.segment].name, "left_clavicle");
            let chest = made[1].tree.segment_named("left_clavicle").unwrap();
            let lower_m = made[1].socket_m(chest) - made[1].joint_m(chest);
            let at = split.3.centre_from_lower_end_m + lower_m;
            assert_abs_diff_eq!(at, whole.3.centre_from_lower_end_m, epsilon = 1e-12);
        }
    }

    /// Forearm and hand together are the forearm of 15 segments.
    #[test]
    fn a_hand_takes_nothing_away() {
        let [_, whole, split] = divided("male50");
        let of = |body: &Body, name: &str| *body.segment(body.tree.segment_named(name).expect("a segment"));
        let [arm, forearm, hand] = [of(&whole, "left_forearm"), of(&split, "left_forearm"), of(&split, "left_hand")];
        let apart_m = forearm.cg_from_lower_end_m + hand.length_m - hand.cg_from_lower_end_m;
        let together = forearm.mass_kg + hand.mass_kg;
        let steiner = forearm.mass_kg * hand.mass_kg / together * apart_m * apart_m;
        let inertia = forearm.inertia_kg_m2 + hand.inertia_kg_m2 + Vector3::new(steiner, steiner, 0.0);
        assert_relative_eq!(together, arm.mass_kg, max_relative = 1e-12);
        assert_relative_eq!(inertia, arm.inertia_kg_m2, max_relative = 1e-9);
        assert_relative_eq!(forearm.length_m + hand.length_m, arm.length_m, max_relative = 1e-12);
        assert!(
            (1.04..=1.11).contains(&(hand.mass_kg / POUND_KG)) && (2.9..=3.0).contains(&(forearm.mass_kg / POUND_KG))
        );
    }
}
