//! The occupant's body: 12 rigid segments and the spheres that can touch things.
//!
//! Report: "Body Geometry and Coordinate Systems", Fig. 1, Fig. 5, Eqs 13–26. Segment axes are X ahead, Y to the
//! occupant's left and Z up when the occupant stands upright with hanging arms; they are principal axes.

pub mod joint;

use nalgebra::{Point3, Vector3};

/// Number of rigid segments.
pub const SEGMENTS: usize = 12;

/// A rigid segment, in the report's order (segment number = index + 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Segment {
    /// 1, whose upper end is the reference point T1.
    MiddleTorso,
    /// 2, above T1.
    UpperTorso,
    /// 3.
    Head,
    /// 4, the pelvis.
    LowerTorso,
    /// 5.
    LeftUpperArm,
    /// 6.
    RightUpperArm,
    /// 7, with the hand.
    LeftForearm,
    /// 8, with the hand.
    RightForearm,
    /// 9.
    LeftThigh,
    /// 10.
    RightThigh,
    /// 11, with the foot.
    LeftLowerLeg,
    /// 12, with the foot.
    RightLowerLeg,
}

impl Segment {
    /// All segments in the report's order.
    pub const ALL: [Segment; SEGMENTS] = [
        Segment::MiddleTorso,
        Segment::UpperTorso,
        Segment::Head,
        Segment::LowerTorso,
        Segment::LeftUpperArm,
        Segment::RightUpperArm,
        Segment::LeftForearm,
        Segment::RightForearm,
        Segment::LeftThigh,
        Segment::RightThigh,
        Segment::LeftLowerLeg,
        Segment::RightLowerLeg,
    ];

    /// Position in [`Segment::ALL`], 0 to 11.
    pub const fn index(self) -> usize {
        self as usize
    }

    /// The report's number, 1 to 12.
    pub const fn number(self) -> usize {
        self as usize + 1
    }

    /// Name used in scenarios and result channels.
    pub const fn name(self) -> &'static str {
        [
            "middle_torso",
            "upper_torso",
            "head",
            "lower_torso",
            "left_upper_arm",
            "right_upper_arm",
            "left_forearm",
            "right_forearm",
            "left_thigh",
            "right_thigh",
            "left_lower_leg",
            "right_lower_leg",
        ][self as usize]
    }

    /// True for the limbs and the lower torso's chain: segments that hang from their upper end.
    ///
    /// Only the upper torso and the head stand on their lower end.
    pub const fn hangs(self) -> bool {
        !matches!(self, Segment::UpperTorso | Segment::Head)
    }
}

/// Mass and geometry of one segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentProperties {
    /// L, distance between the segment's ends.
    pub length_m: f64,
    /// M.
    pub mass_kg: f64,
    /// ρ, distance of the centre of gravity from the lower end (the distal end of a limb).
    pub cg_from_lower_end_m: f64,
    /// I_x, I_y, I_z about the centre of gravity, principal.
    pub inertia_kg_m2: Vector3<f64>,
}

/// A sphere fixed to a segment, the only part of the body that touches surfaces and belts.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactSphere {
    /// Unique name, e.g. `head`, `left_knee`.
    pub name: String,
    /// The segment that carries it.
    pub segment: Segment,
    /// Centre in segment axes, measured from the segment's lower end.
    pub centre_from_lower_end_m: Point3<f64>,
    /// r.
    pub radius_m: f64,
}

/// Names of the report's 17 spheres in the report's order (sphere number = index + 1).
pub const SPHERE_NAMES: [&str; 17] = [
    "head",
    "chest",
    "pelvis",
    "right_shoulder",
    "left_shoulder",
    "right_elbow",
    "left_elbow",
    "right_hand",
    "left_hand",
    "right_thigh",
    "left_thigh",
    "right_knee",
    "left_knee",
    "right_shin",
    "left_shin",
    "right_foot",
    "left_foot",
];

/// A whole body.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Where it comes from, e.g. `male50`.
    pub name: String,
    /// Properties of the segments, in the report's order.
    pub segments: [SegmentProperties; SEGMENTS],
    /// L_s, distance of a shoulder joint from the upper end of segment 2 along Y₂.
    pub shoulder_half_width_m: f64,
    /// L_H, distance of a hip joint from the lower end of segment 4 along Y₄.
    pub hip_half_width_m: f64,
    /// Contact spheres; the report's 17 unless a scenario says otherwise.
    pub spheres: Vec<ContactSphere>,
}

impl Body {
    /// Properties of one segment.
    pub fn segment(&self, segment: Segment) -> &SegmentProperties {
        &self.segments[segment.index()]
    }

    /// Σ M.
    pub fn mass_kg(&self) -> f64 {
        self.segments.iter().map(|s| s.mass_kg).sum()
    }

    /// Index of the sphere with this name.
    pub fn sphere(&self, name: &str) -> Option<usize> {
        self.spheres.iter().position(|s| s.name == name)
    }
}

/// The report's 17 spheres (Fig. 5) for given segments; `radius_m` in the report's order.
pub fn standard_spheres(
    segments: &[SegmentProperties; SEGMENTS],
    shoulder_half_width_m: f64,
    radius_m: &[f64; 17],
) -> Vec<ContactSphere> {
    use Segment::*;
    let length = |s: Segment| segments[s.index()].length_m;
    let r = radius_m;
    let (l_s, l_2) = (shoulder_half_width_m, length(UpperTorso));
    let along = |segment: Segment, z: f64| (segment, Point3::new(0.0, 0.0, z));
    // Heights are above the lower end; distances "from the hip, knee or elbow" are from the upper end.
    let places = [
        along(Head, length(Head) - r[0]),
        along(UpperTorso, l_2 - 0.9 * r[1]),
        along(LowerTorso, 0.0),
        (UpperTorso, Point3::new(0.0, -l_s, l_2)),
        (UpperTorso, Point3::new(0.0, l_s, l_2)),
        along(RightUpperArm, 0.0),
        along(LeftUpperArm, 0.0),
        along(RightForearm, r[7]),
        along(LeftForearm, r[8]),
        along(RightThigh, 0.6 * length(RightThigh)),
        along(LeftThigh, 0.6 * length(LeftThigh)),
        along(RightThigh, 0.0),
        along(LeftThigh, 0.0),
        along(RightLowerLeg, 0.6 * length(RightLowerLeg)),
        along(LeftLowerLeg, 0.6 * length(LeftLowerLeg)),
        along(RightLowerLeg, r[15]),
        along(LeftLowerLeg, r[16]),
    ];
    places
        .into_iter()
        .zip(SPHERE_NAMES.iter().zip(r))
        .map(|((segment, centre), (name, &radius))| ContactSphere {
            name: (*name).to_owned(),
            segment,
            centre_from_lower_end_m: centre,
            radius_m: radius,
        })
        .collect()
}
