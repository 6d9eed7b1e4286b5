//! Forces on one contact sphere and the surfaces that it touches (report, "Output", items 5 and 6).

use crate::files::mcap::column::{Group, TIME, Value, column};
use Value::{Number, Perhaps, Touches, Vector};

/// Message `occupant.SphereLoad`; the index counts the body's spheres.
pub(crate) const SPHERE: Group = Group {
    message: "SphereLoad",
    columns: &[
        TIME,
        column(2, "centre_vehicle_m", Vector(|s, i| s.sphere_centre_m(i).coords), "centre"),
        column(
            3,
            "contact_force_vehicle_n",
            Vector(|s, i| s.sphere_force_n(i)),
            "sum of contact and friction forces, belts apart (item 5)",
        ),
        column(4, "contact_force_resultant_n", Number(|s, i| s.sphere_force_n(i).norm()), "its magnitude"),
        column(5, "belt_force_vehicle_n", Vector(|s, i| s.sphere_belt_force_n(i)), "sum of the forces of belts"),
        column(
            6,
            "application_point_segment_m",
            Perhaps(|s, i| s.application_point_m(i)),
            "where the contact force acts, from the centre; absent without contact (item 6, which asks it for head, chest and pelvis)",
        ),
        column(7, "touches", Touches, "surfaces touched, one by one (item 5)"),
    ],
};
