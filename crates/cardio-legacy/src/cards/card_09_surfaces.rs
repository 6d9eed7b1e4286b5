//! Series 9: deformation and friction of the 25 surfaces.

use super::SeriesLayout;
use super::field::{Field, INCH, ONE, STIFFNESS, field};
use crate::rule::Rule;

pub(super) fn series() -> SeriesLayout {
    SeriesLayout::new(9, "deformation and friction of the 25 surfaces").first(9, "7F10.0,I10", []).each(
        25,
        "I2,8X,6F10.0",
        [
            field("J", ONE, "number of the surface, 1–25, right-justified"),
            field("STIF1", STIFFNESS, "first and smaller stiffness")
                .not_negative("stiffness")
                .wrong_if(Rule::Unlikely, |v| v == 0.0, "the surface resists nothing up to DELB")
                .expected("a stiffness in lbf/in", "punch the stiffness, unless a gap is meant"),
            field("STIF2", STIFFNESS, "second and larger stiffness")
                .not_negative("stiffness")
                .wrong_if(Rule::Unlikely, |v| v == 0.0, "the surface resists no more beyond DELB")
                .expected("a stiffness in lbf/in", "punch STIF1 again for a linear spring"),
            field("DELB", INCH, "deformation at which the second stiffness begins").not_negative("deformation"),
            fraction("AMU1", "fraction of the energy given back up to DELB"),
            fraction("AMU2", "fraction of the energy given back beyond DELB"),
            field("COFR", ONE, "coefficient of friction")
                .not_negative("coefficient of friction")
                .wrong_if(Rule::Unlikely, |v| v > 2.0, "more than any pair of materials has")
                .expected("0 to about 1", "divide percents by 100"),
        ],
    )
}

fn fraction(variable: &str, meaning: &str) -> Field {
    field(variable, ONE, meaning)
        .wrong_if(Rule::Impossible, |v| !(0.0..=1.0).contains(&v), "a fraction of the energy")
        .expected("0 to 1", "divide percents by 100")
}
