//! Series 7: radii of the contact spheres.

use occupant_core::body::tti12::TTI12;

use super::SeriesLayout;
use super::field::{Field, INCH, field};
use crate::rule::Rule;

pub(super) fn series() -> SeriesLayout {
    SeriesLayout::new(7, "radii of the contact spheres")
        .first(7, "7F10.0,I8", [])
        .then("8F10.0", (1..).zip(TTI12.spheres()).map(|(n, row)| radius(n, &row.name.replace('_', " "))))
}

fn radius(n: u32, sphere: &str) -> Field {
    field(format!("RS({n})"), INCH, format!("radius of sphere {n}, {sphere}"))
        .positive("radius of a contact sphere")
        .wrong_if(Rule::Unlikely, |r| r > 12.0, "a sphere wider than any part of a body")
        .expected("a radius in inches", "look for the decimal point")
}
