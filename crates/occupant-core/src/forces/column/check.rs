//! What is wrong with a column by itself.

use super::data::Column;
use crate::forces::function::Goes;
use placed_text::{Problems, number, with_key};

pub(super) fn data(column: &Column, problems: &mut Problems) {
    let path = with_key("frames", &column.name);
    let at = |key: &str| format!("{path}.{key}");
    let size = column.axis.norm();
    if !(size > 0.0 && size.is_finite()) {
        problems.error(at("axis"), "no direction", "the way that it gives: away from the driver");
    }
    if column.hub_m.iter().any(|c| !c.is_finite()) {
        problems.error(at("origin"), "not finite numbers", "the middle of the mass that strokes");
    }
    problems.check_positive(&at("mass"), column.mass_kg, "kg");
    let falls = "forces of at least 0";
    column.force.check(&at("force"), Goes::Anywhere, falls, problems);
    let (steepest, slope) = (column.force.steepest_loading(), column.stiffness_n_per_m());
    if !(slope > 0.0 && slope.is_finite()) {
        problems.error(at("force"), "a force that never rises", "a first rise, to where the column yields");
    } else if slope < steepest * (1.0 - 1e-9) {
        let found = format!("{} N/m, the force rises by {} N/m", number(slope), number(steepest));
        let expected = "no less than the greatest slope of the force: unloading would make energy";
        problems.error(at("unload_slope"), found, expected);
    }
}
