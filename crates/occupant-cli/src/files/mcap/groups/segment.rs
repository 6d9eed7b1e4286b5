//! Place and motion of one segment (report, "Output", items 1 to 4).

use occupant_core::body::Segment;

use crate::files::mcap::column::{Group, TIME, Value, column};
use Value::{Number, Rotation, Vector};

/// Message `occupant.SegmentState`; the index counts [`Segment::ALL`].
pub(crate) const SEGMENT: Group = Group {
    message: "SegmentState",
    columns: &[
        TIME,
        column(
            2,
            "upper_end_vehicle_m",
            Vector(|s, i| s.end_points_m(Segment::ALL[i])[0].coords),
            "upper end (item 1)",
        ),
        column(
            3,
            "lower_end_vehicle_m",
            Vector(|s, i| s.end_points_m(Segment::ALL[i])[1].coords),
            "lower end; the far end of a limb (item 1)",
        ),
        column(4, "cg_vehicle_m", Vector(|s, i| s.cg_m(Segment::ALL[i]).coords), "centre of gravity"),
        column(
            5,
            "orientation_in_vehicle",
            Rotation(|s, i| s.orientation(Segment::ALL[i])),
            "turns segment axes into vehicle axes",
        ),
        column(
            6,
            "cg_acceleration_segment_m_s2",
            Vector(|s, i| s.cg_acceleration_m_s2(Segment::ALL[i])),
            "kinematic acceleration of the centre of gravity (item 2)",
        ),
        column(
            7,
            "accelerometer_segment_m_s2",
            Vector(|s, i| s.specific_force_m_s2(Segment::ALL[i])),
            "what an accelerometer there reads: the same less gravity (item 2)",
        ),
        column(
            8,
            "accelerometer_resultant_m_s2",
            Number(|s, i| s.specific_force_m_s2(Segment::ALL[i]).norm()),
            "magnitude of the accelerometer's reading",
        ),
        column(
            9,
            "angular_acceleration_segment_rad_s2",
            Vector(|s, i| s.angular_acceleration_rad_s2(Segment::ALL[i])),
            "angular acceleration in space, along the segment's axes (item 3)",
        ),
        column(
            10,
            "angular_velocity_segment_rad_s",
            Vector(|s, i| s.angular_velocity_rad_s(Segment::ALL[i])),
            "angular velocity in space, along the segment's axes (item 4)",
        ),
        column(
            11,
            "cg_velocity_space_m_s",
            Vector(|s, i| s.cg_velocity_m_s(Segment::ALL[i])),
            "velocity of the centre of gravity",
        ),
    ],
};
