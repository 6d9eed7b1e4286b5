//! Series 14: what an extension of an earlier run needs.

use super::SeriesLayout;
use super::field::{Field, ONE, field};
use crate::rule::Rule;

pub(super) fn series() -> SeriesLayout {
    SeriesLayout::new(14, "pairs that no longer touch, to extend an earlier run")
        .first(14, "7F10.0,I10", [field("NOCRD", ONE, "number of pairs, one card each")])
        .counted(
            "2I2,F6.0",
            [
                index("J", "sphere", 17, |n| !(1.0..=17.0).contains(&n)),
                index("K", "surface", 25, |n| !(1.0..=25.0).contains(&n)),
                field("NARRY", ONE, "0 or blank: the sphere has passed the surface's edge")
                    .wrong_if(Rule::Impossible, |v| v != 0.0, "only pairs with NARRY = 0 are listed")
                    .expected("0. or blank", "leave the pair out"),
            ],
        )
}

fn index(variable: &str, what: &str, count: u32, beyond: fn(f64) -> bool) -> Field {
    field(variable, ONE, format!("{what}, 1–{count}, right-justified"))
        .wrong_if(Rule::BadIndex, beyond, "no such number")
        .expected(format!("1 to {count}, right-justified"), "copy it from the last sheet of the earlier run")
}
