//! The eleven joints: viscous dampers, stops and elastic springs, as data.
//!
//! Report: "The Viscous Damper" (Eqs 69–77), "Joint Stops" (Figs 9–11), "Potential Energy due to Spinal Elasticity"
//! (Eqs 57–62). The force laws themselves stand in `kernel`.

/// A joint, in the report's numbering (Fig. 8).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Joint {
    /// 1, segments 2 and 3.
    Neck,
    /// 2, segments 2 and 6.
    RightShoulder,
    /// 3, segments 2 and 5.
    LeftShoulder,
    /// 4, segments 1 and 2.
    UpperBack,
    /// 5, hinge, segments 5 and 7.
    LeftElbow,
    /// 6, hinge, segments 6 and 8.
    RightElbow,
    /// 7, segments 1 and 4.
    LowerBack,
    /// 8, segments 4 and 10.
    RightHip,
    /// 9, segments 4 and 9.
    LeftHip,
    /// 10, hinge, segments 10 and 12.
    RightKnee,
    /// 11, hinge, segments 9 and 11.
    LeftKnee,
}

impl Joint {
    /// All joints in the report's order.
    pub const ALL: [Joint; 11] = [
        Joint::Neck,
        Joint::RightShoulder,
        Joint::LeftShoulder,
        Joint::UpperBack,
        Joint::LeftElbow,
        Joint::RightElbow,
        Joint::LowerBack,
        Joint::RightHip,
        Joint::LeftHip,
        Joint::RightKnee,
        Joint::LeftKnee,
    ];

    /// The report's number, 1 to 11.
    pub const fn number(self) -> usize {
        self as usize + 1
    }

    /// Name used in scenarios and result channels.
    pub const fn name(self) -> &'static str {
        [
            "neck",
            "right_shoulder",
            "left_shoulder",
            "upper_back",
            "left_elbow",
            "right_elbow",
            "lower_back",
            "right_hip",
            "left_hip",
            "right_knee",
            "left_knee",
        ][self as usize]
    }

    /// Elbows and knees turn about Y only.
    pub const fn is_hinge(self) -> bool {
        matches!(self, Joint::LeftElbow | Joint::RightElbow | Joint::RightKnee | Joint::LeftKnee)
    }
}

/// Damping that rises towards a limit of travel (Figs 9–11): from the joint's normal damping at `begin_rad` linearly to
/// `damping_n_m_s` at `full_rad`, constant beyond, and only while the joint moves towards the limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// β_N or α_N.
    pub begin_rad: f64,
    /// β_S or α_S. Above `begin_rad` for an upper stop, below it for a hinge's lower stop.
    pub full_rad: f64,
    /// J_S, N·m·s/rad.
    pub damping_n_m_s: f64,
}

/// Rotational spring in β (Eqs 57–62): V = ½ K (β − β₀)².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AngularSpring {
    /// K, N·m/rad.
    pub stiffness_n_m: f64,
    /// β₀; `None` takes the joint's angle at the start of the run.
    pub rest_rad: Option<f64>,
}

/// A ball joint; β is the angle between the Z axes of the two segments.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BallJoint {
    /// J_N, N·m·s/rad.
    pub damping_n_m_s: f64,
    /// J_t, resistance to relative turning about the distal segment's Z; 0 in the report.
    pub twist_damping_n_m_s: f64,
    /// Limit of β.
    pub stop: Option<Stop>,
    /// Elasticity; the report has it in the two back joints.
    pub spring: Option<AngularSpring>,
}

/// An elbow or a knee; α is the turn of the distal segment about the common Y axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HingeJoint {
    /// J_N, N·m·s/rad.
    pub damping_n_m_s: f64,
    /// Works while α falls.
    pub lower_stop: Option<Stop>,
    /// Works while α rises.
    pub upper_stop: Option<Stop>,
}

/// All joints of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joints {
    /// 1.
    pub neck: BallJoint,
    /// 2.
    pub right_shoulder: BallJoint,
    /// 3.
    pub left_shoulder: BallJoint,
    /// 4.
    pub upper_back: BallJoint,
    /// 5.
    pub left_elbow: HingeJoint,
    /// 6.
    pub right_elbow: HingeJoint,
    /// 7.
    pub lower_back: BallJoint,
    /// 8.
    pub right_hip: BallJoint,
    /// 9.
    pub left_hip: BallJoint,
    /// 10.
    pub right_knee: HingeJoint,
    /// 11.
    pub left_knee: HingeJoint,
    /// ε that keeps β smooth where the two Z axes are parallel; 0 is the report's formula. Default 1e−3.
    pub epsilon: f64,
}

impl Default for Joints {
    /// Free joints: no damping, no stop, no spring.
    fn default() -> Self {
        let (ball, hinge) = (BallJoint::default(), HingeJoint::default());
        Joints {
            neck: ball,
            right_shoulder: ball,
            left_shoulder: ball,
            upper_back: ball,
            left_elbow: hinge,
            right_elbow: hinge,
            lower_back: ball,
            right_hip: ball,
            left_hip: ball,
            right_knee: hinge,
            left_knee: hinge,
            epsilon: 1e-3,
        }
    }
}
