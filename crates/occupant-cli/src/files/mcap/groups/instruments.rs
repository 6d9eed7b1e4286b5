//! What the load cells of a dummy would read.

use nalgebra::Vector3;
use occupant_core::body::Segment;
use occupant_core::body::joint::Joint;
use occupant_core::results::reaction::{femur_axial_n, reaction};

use crate::files::mcap::column::{Group, TIME, Value, column};
use Value::{Number, Vector};

/// Segment axes (left, up) to SAE J211 axes (right, down).
fn j211(v: Vector3<f64>) -> Vector3<f64> {
    Vector3::new(v.x, -v.y, -v.z)
}

/// Message `occupant.Instruments`.
pub(crate) const INSTRUMENTS: Group = Group {
    message: "Instruments",
    columns: &[
        TIME,
        column(
            2,
            "neck_force_j211_n",
            Vector(|s, _| j211(reaction(s, Joint::Neck).force_n)),
            "upper neck force on the head at its joint, SAE J211 axes: +z tension",
        ),
        column(
            3,
            "neck_moment_j211_n_m",
            Vector(|s, _| j211(reaction(s, Joint::Neck).moment_n_m)),
            "upper neck moment on the head at its joint, SAE J211 axes: +y flexion",
        ),
        column(
            4,
            "right_femur_axial_n",
            Number(|s, _| femur_axial_n(s, Segment::RightThigh)),
            "axial force at the knee end of the right thigh, tension positive",
        ),
        column(
            5,
            "left_femur_axial_n",
            Number(|s, _| femur_axial_n(s, Segment::LeftThigh)),
            "axial force at the knee end of the left thigh, tension positive",
        ),
    ],
};
