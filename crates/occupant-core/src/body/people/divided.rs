//! The generator's 15 segments as a body of their own, and 17 with hands.
//!
//! Principal axes and joints are as the generator has them, but for what lies beside the middle plane, which is that of the
//! 12. A hand is a share of the forearm's mass beyond a wrist, so that both together keep mass, centre of gravity and
//! inertia (the split is ours).

use nalgebra::{UnitQuaternion, Vector2, Vector3};

use super::{CT, F, H, LA, LL, LT, N, PARTS, REFERENCE, Stretch, UA, UL, UT};
use crate::body::named::{NamedJoint, NamedLandmarks, tree};
use crate::body::tti12::TTI12;
use crate::body::{Body, JointKind, JointPlace, JointSite, SegmentProperties, Side};

/// Names of the parts, and how far their ends are above and below their centre of gravity, inches.
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
/// A joint on both of its parts, with X and Z from the centre of gravity of each, inches.
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
/// The hand: its share of the mass of forearm and hand (1.08 of 4.05 lb), and how far the wrist and its own centre of
/// gravity are below that of both, inches. The wrist is where Drillis and Contini's 0.146 and 0.108 of stature meet.
const HAND: (f64, f64, f64) = (0.267, 2.28, 5.77);
impl Stretch {
    /// The parts, limbs on both sides, as segments and joints of their own.
    pub(super) fn divided(&self, has_hands: bool) -> Body {
        let mut made =
            Made { stretch: self, has_hands, joints: Vec::new(), segments: vec![self.segment(CT, has_hands)] };
        for (name, proximal, from, distal, to) in JOINTS {
            let place = self.place(proximal, from, distal, to);
            let sides: &[Option<Side>] = if distal < UL { &[None] } else { &[Some(Side::Left), Some(Side::Right)] };
            sides.iter().for_each(|side| made.joint(name, [proximal, distal], place, *side));
            if has_hands && distal == LA {
                sides.iter().for_each(|side| made.wrist(*side));
            }
        }
        made.body()
    }

    /// Axes of a part along which X and Z of its segment grow: the foot's X axis points up and its Z axis ahead.
    const fn axes(part: usize) -> [usize; 2] {
        if part == F { [2, 0] } else { [0, 2] }
    }

    /// Centre of gravity of a part from the lower end of its segment: the foot's is ahead of the ankle.
    fn cg_m(&self, part: usize) -> Vector3<f64> {
        let ahead = if part == F { self.along(F, 2, 2.76) } else { 0.0 };
        Vector3::new(ahead, 0.0, self.along(part, Self::axes(part)[1], ENDS[part].1[1]))
    }

    /// A part as a segment; of forearm and hand the forearm where the hand is another.
    fn segment(&self, part: usize, has_hands: bool) -> SegmentProperties {
        if has_hands && part == LA {
            return self.forearm_and_hand()[0];
        }
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

    /// Both keep mass, centre of gravity and inertia of the part that they were, whose inertia they share as m·L².
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

/// A body of parts under construction.
struct Made<'a> {
    stretch: &'a Stretch,
    has_hands: bool,
    /// Name, kind, proximal and distal segment, place.
    joints: Vec<(String, JointKind, [String; 2], JointPlace)>,
    segments: Vec<SegmentProperties>,
}

/// A name of one side.
fn on(side: Option<Side>, name: &str) -> String {
    match side {
        None => name.to_owned(),
        Some(Side::Left) => format!("left_{name}"),
        Some(Side::Right) => format!("right_{name}"),
    }
}

impl Made<'_> {
    /// A joint with the segment that it carries.
    fn joint(&mut self, name: &str, [proximal, distal]: [usize; 2], mut place: JointPlace, side: Option<Side>) {
        let beside_m = self.stretch.half_width_m(distal);
        place.proximal.point_m.y = if side == Some(Side::Right) { -beside_m } else { beside_m };
        let of = |part: usize| on(side.filter(|_| part >= UL), ENDS[part].0);
        let kind = if [LL, LA].contains(&distal) { JointKind::Hinge } else { JointKind::Ball };
        if self.has_hands && distal == LA {
            // seen from the lower end, which is the wrist
            place.distal.point_m.z = self.stretch.forearm_and_hand()[0].length_m;
        }
        self.joints.push((on(side, name), kind, [of(proximal), of(distal)], place));
        self.segments.push(self.stretch.segment(distal, self.has_hands));
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
            let hangs = place.distal.point_m.z > 0.0;
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
        }
    }
}
