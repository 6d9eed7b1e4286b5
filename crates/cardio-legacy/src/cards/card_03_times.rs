//! Series 3: times and switches, and which series the switches ask for.

use super::SeriesLayout;
use super::field::{Field, ONE, SECOND, field};
use crate::rule::Rule;

pub(super) fn series() -> SeriesLayout {
    let path = "0: the vehicle path is on series 12; otherwise the number of stations to read from disk";
    SeriesLayout::new(3, "times and switches").first(
        3,
        "7F10.0,I10",
        [
            field("T1", SECOND, "initial time").key("time.start"),
            field("TF", SECOND, "final time").key("time.end"),
            field("DT", SECOND, "step of the integration")
                .key("integrator.step")
                .positive("the integration needs a step"),
            field("DTPRNT", SECOND, "print interval").key("output.interval").positive("printing needs an interval"),
            field("MREAD", ONE, path)
                .wrong_if(Rule::NotAWholeNumber, |n| n < 0.0 || n.fract() > 0.0, "this counts no stations")
                .expected("0. or a number of stations", "punch 0. if the path stands on series 12"),
            switch("NPOS", "0: seating by series 4 and 10; 1: initial state on series 6"),
            switch("NDISK", "0: plot data go to disk; 1: they do not"),
        ],
    )
}

fn switch(variable: &str, meaning: &str) -> Field {
    field(variable, ONE, meaning)
        .wrong_if(Rule::Impossible, |v| v != 0.0 && v != 1.0, "the switch has two positions")
        .expected("0. or 1., with the decimal point", "punch 0. or 1.")
}

/// Whether a series must be present.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Need {
    Needed,
    Optional,
    Unused,
}

/// The report's rules: 4 and 10, or 6, by NPOS; 12 by MREAD; 13 optional; 14 to extend a run (NPOS = 1).
pub(crate) fn need(series: u8, mread: Option<f64>, npos: Option<f64>) -> Need {
    match (series, mread, npos) {
        (14, _, Some(0.0)) => Need::Unused,
        (13 | 14, ..) => Need::Optional,
        (4 | 10, _, Some(0.0)) | (6, _, Some(1.0)) | (12, Some(0.0), _) => Need::Needed,
        (4 | 10, _, Some(1.0)) | (6, _, Some(0.0)) => Need::Unused,
        (12, Some(mread), _) if mread > 0.0 => Need::Unused,
        (4 | 6 | 10 | 12, ..) => Need::Optional,
        _ => Need::Needed,
    }
}
