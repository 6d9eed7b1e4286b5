//! Joints as data: viscous dampers, stops and elastic springs.
//!
//! Report: "The Viscous Damper" (Eqs 69–77), "Joint Stops" (Figs 9–11), "Potential Energy due to Spinal Elasticity"
//! (Eqs 57–62).

use crate::body::joint::Joint;

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

impl Joints {
    /// The ball joints, in the order of [`super::BALLS`].
    pub fn balls(&self) -> [(Joint, &BallJoint); 7] {
        [
            (Joint::Neck, &self.neck),
            (Joint::RightShoulder, &self.right_shoulder),
            (Joint::LeftShoulder, &self.left_shoulder),
            (Joint::UpperBack, &self.upper_back),
            (Joint::LowerBack, &self.lower_back),
            (Joint::RightHip, &self.right_hip),
            (Joint::LeftHip, &self.left_hip),
        ]
    }

    /// The hinges, in the order of [`crate::motion::kinematics::LIMBS`].
    pub fn hinges(&self) -> [(Joint, &HingeJoint); 4] {
        [
            (Joint::LeftElbow, &self.left_elbow),
            (Joint::RightElbow, &self.right_elbow),
            (Joint::LeftKnee, &self.left_knee),
            (Joint::RightKnee, &self.right_knee),
        ]
    }
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
