//! Checks of a column.

use super::data::Column;
use crate::forces::function::Goes;
use placed_text::{Problems, number, with_key};

pub(super) fn data(column: &Column, problems: &mut Problems) {
    let path = with_key("frames", &column.name);
    let at = |key: &str| format!("{path}.{key}");
    let size = column.axis.norm();
    if !(size > 0.0 && size.is_finite()) {
        problems.error(
            at("axis"),
            "no direction",
            if column.turns() { "the axis that it turns about" } else { "the way that it gives: away from the driver" },
        );
    }
    if column.hub_m.iter().any(|c| !c.is_finite()) {
        let key = if column.turns() { "centre" } else { "origin" };
        problems.error(at(key), "not finite numbers", "the middle of the mass that moves");
    }
    problems.check_positive(&at("mass"), column.mass_kg, "kg");
    if let Some(hinge) = column.hinge {
        problems.check_positive(&at("inertia"), hinge.inertia_kg_m2, "kg m^2");
        if hinge.at_m.iter().any(|c| !c.is_finite()) {
            problems.error(at("origin"), "not finite numbers", "a point of the axis");
        }
    }
    let (law, slope_key, what, unit) = match column.hinge {
        None => ("force", "unload_slope", "force", "N/m"),
        Some(_) => ("moment", "unload_stiffness", "moment", "N·m/rad"),
    };
    column.force.check(&at(law), Goes::Anywhere, &format!("{what}s of at least 0"), problems);
    let (steepest, slope) = (column.force.steepest_loading(), column.stiffness_n_per_m());
    if !(slope > 0.0 && slope.is_finite()) {
        let expected = format!("a first rise, to where the {} yields", if column.turns() { "hinge" } else { "column" });
        problems.error(at(law), format!("a {what} that never rises"), expected);
    } else if slope < steepest * (1.0 - 1e-9) {
        let found = format!("{} {unit}, the {what} rises by {} {unit}", number(slope), number(steepest));
        let expected = format!("no less than the largest slope of the {what}: otherwise unloading would create energy");
        problems.error(at(slope_key), found, expected);
    }
}
