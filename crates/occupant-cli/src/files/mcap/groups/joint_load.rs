//! What a joint carries.

use occupant_core::body::joint::Joint;
use occupant_core::results::reaction::reaction;

use crate::files::mcap::column::{Group, TIME, Value, column};
use Value::Vector;

/// Message `occupant.JointLoad`; the index counts the joints in the report's order.
pub(crate) const JOINT_LOAD: Group = Group {
    message: "JointLoad",
    columns: &[
        TIME,
        column(
            2,
            "force_segment_n",
            Vector(|s, i| reaction(s, Joint::ALL[i]).force_n),
            "force that the proximal segment exerts on the distal one, in axes of the distal segment",
        ),
        column(
            3,
            "moment_segment_n_m",
            Vector(|s, i| reaction(s, Joint::ALL[i]).moment_n_m),
            "moment that the proximal segment exerts on the distal one; damper, stop and spring are part of it",
        ),
    ],
};
