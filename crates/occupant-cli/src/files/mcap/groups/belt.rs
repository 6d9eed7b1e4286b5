//! Force and shape of one belt (report, "Output", item 7).

use crate::files::mcap::column::{Group, TIME, Value, column};
use Value::{Number, Vector};

/// Message `occupant.BeltState`; the index counts the belts.
pub(crate) const BELT: Group = Group {
    message: "BeltState",
    columns: &[
        TIME,
        column(2, "loop_force_n", Number(|s, i| s.belts[i].loop_force), "force in the webbing (item 7)"),
        column(
            3,
            "restraining_force_vehicle_n",
            Vector(|s, i| s.belts[i].force.to_vector()),
            "force on the sphere, at its centre (item 7)",
        ),
        column(4, "restraining_force_resultant_n", Number(|s, i| s.belts[i].force.to_vector().norm()), "its magnitude"),
        column(
            5,
            "elongation_m",
            Number(|s, i| s.belts[i].elongation),
            "length less the unstretched length; negative in slack",
        ),
        column(6, "length_m", Number(|s, i| s.belts[i].length), "length round the body"),
        column(
            7,
            "wrap_rad",
            Number(|s, i| s.belts[i].wrap),
            "angle over which the belt lies on the sphere; 0 or less: off the body",
        ),
        column(8, "stored_j", Number(|s, i| s.belts[i].stored), "recoverable energy"),
    ],
};
