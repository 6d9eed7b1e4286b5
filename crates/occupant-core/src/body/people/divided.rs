//! The generator's 15 segments as a body, 17 with hands, and 19 with clavicles.
//!
//! Principal axes and joints are the generator's, except lateral positions, which are those of the 12. A hand is a
//! share of the forearm's mass beyond a wrist, so that both together keep mass, centre of gravity and inertia (the
//! splits are ours). A clavicle is a share of the upper torso's mass, with shoulder blade and flesh. It turns about the
//! sternoclavicular joint and carries the arm, so that a belt on one shoulder restrains that shoulder before the trunk.
//! 12. A hand is a share of the forearm's mass beyond a wrist, so that both together keep mass, centre of gravity and
//! inertia (the splits are ours). So is a clavicle one of the upper torso's mass, with shoulder blade and flesh: it turns about
//! the sternoclavicular joint and carries the arm, so that a belt on one shoulder holds back that shoulder before the trunk.

use nalgebra::{Matrix3, UnitQuaternion, Vector2, Vector3};

use super::{CT, Division, F, H, LA, LL, LT, N, PARTS, REFERENCE, Stretch, UA, UL, UT};
use crate::body::named::{NamedJoint, NamedLandmarks, tree};
use crate::body::tti12::TTI12;
use crate::body::{Body, JointKind, JointPlace, JointSite, SegmentProperties, Side};

/// Names of the parts, and distances of their ends above and below their centre of gravity, inches.
const ENDS: [(&str, [f64; 2]); PARTS] = [
    ("lower_torso", [2.24, 1.52]),
    ("middle_torso", [0.83, 2.25]),
    ("upper_torso", [4.35, 6.99]),
    ("neck", [2.51, 1.46]),
    ("head", [4.90, 1.93]),
    ("thigh", [7.55, 9.80]),
    ("lower_leg", [6.91, 9.78]),
    ("foot", [1.37, 1.39]),
    ("upper_arm", [5.22, 5.04]),
    ("forearm", [7.08, 9.20]),
];
/// A joint, with X and Z from the centre of gravity of both parts, inches.
type JointRow = (&'static str, usize, [f64; 2], usize, [f64; 2]);
const JOINTS: [JointRow; 9] = [
    ("upper_back", CT, [-1.76, 0.83], UT, [-0.32, -6.99]),
    ("neck_base", UT, [-0.27, 7.26], N, [-0.93, -1.46]),
    ("neck", N, [1.01, 2.51], H, [-0.83, -1.93]),
    ("lower_back", CT, [-2.39, -2.25], LT, [-1.45, 2.24]),
    ("shoulder", UT, [-0.96, 4.35], UA, [0.52, 5.22]),
    ("elbow", UA, [-0.64, -5.04], LA, [-0.51, 7.08]),
    ("hip", LT, [-0.51, -1.52], UL, [-0.32, 7.55]),
    ("knee", UL, [-0.23, -9.80], LL, [0.67, 6.91]),
    ("ankle", LL, [0.39, -9.78], F, [-2.76, 1.37]),
];
/// The hand: its share of the mass of forearm and hand (1.08 of 4.05 lb), and distances of the wrist and of its own
/// centre of gravity below that of both, inches. The wrist is from Drillis and Contini's 0.146 and 0.108 of stature.
const HAND: (f64, f64, f64) = (0.267, 2.28, 5.77);
/// A clavicle: its share of the upper torso's mass; its radii of gyration; and X, Y (of the left one) and Z of its
/// centre of gravity and of its joint from the upper torso's centre of gravity, inches. Its height is that over which
/// it is drawn.
const CLAVICLE: (f64, [f64; 3], [[f64; 3]; 2]) = (0.05, [2.0, 1.5, 2.0], [[-0.8, 4.0, 3.9], [2.0, 0.9, 5.9]]);
const CLAVICLE_HEIGHT: f64 = 2.0;
/// Largest moment of inertia of a clavicle, relative to the sum of the other two; ours.
const MOST_ABOUT_ONE: f64 = 0.99;

impl Stretch {
    /// The parts, limbs on both sides, as separate segments and joints.
    pub(super) fn divided(&self, division: Division) -> Body {
        let mut made = Made { stretch: self, division, joints: Vec::new(), segments: vec![self.segment(CT, division)] };
        for (name, proximal, from, distal, to) in JOINTS {
            let place = self.place(proximal, from, distal, to);
            let sides: &[Option<Side>] = if distal < UL { &[None] } else { &[Some(Side::Left), Some(Side::Right)] };
            for side in sides {
                if distal == UA && division.has_clavicles() {
                    made.clavicle(*side);
                }
                made.joint(name, [proximal, distal], place, *side);
            }
            if distal == LA && division.has_hands() {
                sides.iter().for_each(|side| made.wrist(*side));
            }
        }
        made.body()
    }

    /// Axes of a part that scale X and Z of its segment: the foot's X axis points up and its Z axis forward.
    const fn axes(part: usize) -> [usize; 2] {
        if part == F { [2, 0] } else { [0, 2] }
    }

    /// Centre of gravity of a part from the lower end of its segment: the foot's is forward of the ankle.
    fn cg_m(&self, part: usize) -> Vector3<f64> {
        let ahead = if part == F { self.along(F, 2, 2.76) } else { 0.0 };
        Vector3::new(ahead, 0.0, self.along(part, Self::axes(part)[1], ENDS[part].1[1]))
    }

    /// A part as a segment, without sub-parts that are segments of their own: the forearm without the hand.
    fn segment(&self, part: usize, division: Division) -> SegmentProperties {
        if part == LA && division.has_hands() {
            return self.forearm_and_hand()[0];
        }
        let whole = self.whole(part);
        if part == UT && division.has_clavicles() { self.without_clavicles(&whole) } else { whole }
    }

    /// A complete part as a segment.
    fn whole(&self, part: usize) -> SegmentProperties {
        let [above, below] = ENDS[part].1.map(|inches| self.along(part, Self::axes(part)[1], inches));
        let [ix, iy, iz] = self.principal(part);
        let inertia = if part == F { [iz, iy, ix] } else { [ix, iy, iz] };
        let cg_m = self.cg_m(part);
        SegmentProperties {
            cg_beside_m: Vector2::new(cg_m.x, cg_m.y),
            principal: UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -REFERENCE[part].2.to_radians()),
            ..SegmentProperties::new(above + below, self.mass_kg[part], cg_m.z, Vector3::from(inertia))
        }
    }

    /// Converts X, Y and Z in inches from the upper torso's centre of gravity to the lower end of the left clavicle,
    /// which is in the middle plane, below the shoulders by its height.
    fn on_clavicle(&self, inches: [f64; 3]) -> Vector3<f64> {
        let [x, y, z] = [0, 1, 2].map(|axis| self.along(UT, axis, inches[axis]));
        Vector3::new(x, y, z - self.along(UT, 2, ENDS[UT].1[0] - CLAVICLE_HEIGHT))
    }

    fn clavicle(&self, side: Option<Side>) -> SegmentProperties {
        let (share, gyration, [centre, _]) = CLAVICLE;
        let mass_kg = share * self.mass_kg[UT];
        let [x, y, z] = [0, 1, 2].map(|axis| mass_kg * self.along(UT, axis, gyration[axis]).powi(2));
        // a heavy woman's chest grows more in depth than in width: no body has more about one axis than about both others
        let x = x.min(MOST_ABOUT_ONE * (y + z));
        let cg_m = mirrored(self.on_clavicle(centre), side);
        let length_m = self.along(UT, 2, CLAVICLE_HEIGHT);
        SegmentProperties {
            cg_beside_m: cg_m.xy(),
            ..SegmentProperties::new(length_m, mass_kg, cg_m.z, Vector3::new(x, y, z))
        }
    }

    /// The upper torso without clavicles, so that together they have the mass, centre of gravity and inertia of the
    /// whole.
    fn without_clavicles(&self, whole: &SegmentProperties) -> SegmentProperties {
        let lower_m = Vector3::z() * (whole.length_m - self.along(UT, 2, CLAVICLE_HEIGHT));
        let parts = [Side::Left, Side::Right].map(|side| self.clavicle(Some(side)));
        let at = |p: &SegmentProperties| Vector3::new(p.cg_beside_m.x, p.cg_beside_m.y, p.cg_from_lower_end_m);
        let mass_kg = whole.mass_kg - parts.iter().map(|p| p.mass_kg).sum::<f64>();
        let moment = parts.iter().map(|p| (at(p) + lower_m) * p.mass_kg).sum::<Vector3<f64>>();
        let cg_m = (at(whole) * whole.mass_kg - moment) / mass_kg;
        let steiner = |arm: Vector3<f64>| Matrix3::from_diagonal_element(arm.norm_squared()) - arm * arm.transpose();
        let turn = whole.principal.to_rotation_matrix();
        let mut tensor = turn * Matrix3::from_diagonal(&whole.inertia_kg_m2) * turn.transpose();
        tensor -= steiner(cg_m - at(whole)) * mass_kg;
        for p in &parts {
            tensor -= Matrix3::from_diagonal(&p.inertia_kg_m2) + steiner(at(p) + lower_m - at(whole)) * p.mass_kg;
        }
        // of the products of inertia that of X and Z alone is left
        let angle = 0.5 * libm::atan(2.0 * tensor.m13 / (tensor.m33 - tensor.m11));
        let principal = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), angle);
        let turn = principal.to_rotation_matrix();
        SegmentProperties {
            cg_beside_m: cg_m.xy(),
            principal,
            ..SegmentProperties::new(whole.length_m, mass_kg, cg_m.z, (turn.transpose() * tensor * turn).diagonal())
        }
    }

    /// Forearm and hand: together they have mass, centre of gravity and inertia of the part, whose inertia is shared in
    /// proportion to m·L².
    fn forearm_and_hand(&self) -> [SegmentProperties; 2] {
        let z = |inches| self.along(LA, 2, inches);
        let (share, wrist, hand) = HAND;
        let forearm = hand * share / (1.0 - share);
        let [above, below] = ENDS[LA].1;
        let (lengths, shares) = ([z(above + wrist), z(below - wrist)], [1.0 - share, share]);
        let cg_m = [z(forearm + wrist), z(below - hand)];
        let apart_m = z(forearm + hand);
        let steiner = self.mass_kg[LA] * share * (1.0 - share) * apart_m * apart_m;
        let own = Vector3::from(self.principal(LA)) - Vector3::new(steiner, steiner, 0.0);
        let [weight, other] = [0, 1].map(|i| shares[i] * lengths[i] * lengths[i]);
        std::array::from_fn(|i| {
            let part = if i == 0 { weight } else { other } / (weight + other);
            SegmentProperties::new(lengths[i], shares[i] * self.mass_kg[LA], cg_m[i], own * part)
        })
    }

    /// A joint in the middle plane, from X and Z in inches from the centres of gravity of its parts.
    fn place(&self, proximal: usize, from: [f64; 2], distal: usize, to: [f64; 2]) -> JointPlace {
        let site = |part: usize, [x, z]: [f64; 2]| {
            let [along_x, along_z] = Self::axes(part);
            let seen = Vector3::new(self.along(part, along_x, x), 0.0, self.along(part, along_z, z));
            JointSite::at(self.cg_m(part) + seen)
        };
        JointPlace { proximal: site(proximal, from), distal: site(distal, to) }
    }
}

/// A body under construction from parts.
struct Made<'a> {
    stretch: &'a Stretch,
    division: Division,
    /// Name, kind, proximal and distal segment, location.
    joints: Vec<(String, JointKind, [String; 2], JointPlace)>,
    segments: Vec<SegmentProperties>,
}

/// Mirror image of a location on the left side.
fn mirrored(mut place: Vector3<f64>, side: Option<Side>) -> Vector3<f64> {
    place.y *= if side == Some(Side::Right) { -1.0 } else { 1.0 };
    place
}

/// A name for one side.
fn on(side: Option<Side>, name: &str) -> String {
    match side {
        None => name.to_owned(),
        Some(Side::Left) => format!("left_{name}"),
        Some(Side::Right) => format!("right_{name}"),
    }
}

impl Made<'_> {
    /// Adds a joint with the segment that it carries.
    fn joint(&mut self, name: &str, [proximal, distal]: [usize; 2], mut place: JointPlace, side: Option<Side>) {
        place.proximal.point_m.y = self.stretch.half_width_m(distal);
        place.proximal.point_m = mirrored(place.proximal.point_m, side);
        let of = |part: usize| on(side.filter(|_| part >= UL), ENDS[part].0);
        let kind = if [LL, LA].contains(&distal) { JointKind::Hinge } else { JointKind::Ball };
        if self.division.has_hands() && distal == LA {
            // seen from the lower end, which is the wrist
            place.distal.point_m.z = self.stretch.forearm_and_hand()[0].length_m;
        }
        let mut carrier = of(proximal);
        if self.division.has_clavicles() && distal == UA {
            carrier = on(side, "clavicle");
            place.proximal.point_m.z = self.stretch.along(UT, 2, CLAVICLE_HEIGHT);
        }
        self.joints.push((on(side, name), kind, [carrier, of(distal)], place));
        self.segments.push(self.stretch.segment(distal, self.division));
    }

    fn clavicle(&mut self, side: Option<Side>) {
        let (stretch, joint) = (self.stretch, CLAVICLE.2[1]);
        let distal = mirrored(stretch.on_clavicle(joint), side);
        let below_shoulders_m = stretch.along(UT, 2, ENDS[UT].1.iter().sum::<f64>() - CLAVICLE_HEIGHT);
        let place = JointPlace {
            proximal: JointSite::at(distal + Vector3::z() * below_shoulders_m),
            distal: JointSite::at(distal),
        };
        let names = [ENDS[UT].0.to_owned(), on(side, "clavicle")];
        self.joints.push((on(side, "sternoclavicular"), JointKind::Ball, names, place));
        self.segments.push(stretch.clavicle(side));
    }

    fn wrist(&mut self, side: Option<Side>) {
        let hand = self.stretch.forearm_and_hand()[1];
        let upper = JointSite::at(Vector3::z() * hand.length_m);
        let place = JointPlace { proximal: JointSite::at(Vector3::zeros()), distal: upper };
        self.joints.push((on(side, "wrist"), JointKind::Ball, [on(side, "forearm"), on(side, "hand")], place));
        self.segments.push(hand);
    }

    fn body(self) -> Body {
        let named = self.joints.iter().map(|(name, kind, [proximal, distal], place)| {
            let hangs = place.distal.point_m.z > 0.0 && !distal.ends_with("clavicle");
            NamedJoint { name, kind: *kind, proximal, distal, hangs }
        });
        let joints: Vec<NamedJoint<'_>> = named.collect();
        // all landmarks are among the parts
        let tree = tree(&joints, &NamedLandmarks::default()).unwrap_or(&TTI12);
        Body {
            name: "person".to_owned(),
            tree,
            segments: self.segments,
            places: self.joints.into_iter().map(|joint| joint.3).collect(),
            shoulder_half_width_m: self.stretch.half_width_m(UA),
            hip_half_width_m: self.stretch.half_width_m(UL),
            neck_height_m: 0.0,
            condyles_m: None,
            spheres: Vec::new(),
            plates: Vec::new(),
            chests: Vec::new(),
            sides: Vec::new(),
        }
    }
}
