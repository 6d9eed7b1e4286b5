//! Built-in joints.

use super::data::{AngularSpring, BallJoint, HingeJoint, Joints, Stop};
use crate::body::tti12::*;

/// in·lbf in N·m.
const INCH_POUND_N_M: f64 = 0.0254 * 4.448_221_615_260_5;
const DEGREE_RAD: f64 = std::f64::consts::PI / 180.0;

impl Joints {
    /// A starting set of dampings, stops and spinal springs for grown-ups: `joints.preset = "male50"`.
    ///
    /// Ours. Limits of elbows and knees are those of the report; dampings and other limits are of the size used with the ATB
    /// program.
    pub fn male50() -> Self {
        let hinge = HingeJoint { damping_n_m_s: 6.0 * INCH_POUND_N_M, ..HingeJoint::default() };
        let elbow =
            HingeJoint { lower_stop: stop(-125.0, -130.0, 200.0), upper_stop: stop(-15.0, -10.0, 200.0), ..hinge };
        let knee = HingeJoint { lower_stop: stop(5.0, 0.0, 400.0), upper_stop: stop(135.0, 140.0, 400.0), ..hinge };
        let spring = AngularSpring { stiffness_n_m: 1000.0 * INCH_POUND_N_M, rest_rad: None };
        let back = |begin_deg| BallJoint { spring: Some(spring), ..ball(6.0, stop(begin_deg, begin_deg + 5.0, 800.0)) };
        let (shoulder, hip) = (ball(6.0, stop(170.0, 175.0, 300.0)), ball(6.0, stop(115.0, 120.0, 600.0)));
        Joints::free(&TTI12)
            .with(NECK, ball(20.0, stop(45.0, 60.0, 120.0)))
            .with(UPPER_BACK, back(30.0))
            .with(LOWER_BACK, back(35.0))
            .with(RIGHT_SHOULDER, shoulder)
            .with(LEFT_SHOULDER, shoulder)
            .with(RIGHT_HIP, hip)
            .with(LEFT_HIP, hip)
            .with(RIGHT_ELBOW, elbow)
            .with(LEFT_ELBOW, elbow)
            .with(RIGHT_KNEE, knee)
            .with(LEFT_KNEE, knee)
    }
}

/// Ball joint with this damping, in·lbf·s/rad.
fn ball(damping: f64, stop: Option<Stop>) -> BallJoint {
    BallJoint { damping_n_m_s: damping * INCH_POUND_N_M, stop, ..BallJoint::default() }
}

/// Stop by its angles in degrees and its damping in in·lbf·s/rad.
fn stop(begin_deg: f64, full_deg: f64, damping: f64) -> Option<Stop> {
    let [begin_rad, full_rad] = [begin_deg, full_deg].map(|angle_deg| angle_deg * DEGREE_RAD);
    Some(Stop { begin_rad, full_rad, damping_n_m_s: damping * INCH_POUND_N_M })
}
