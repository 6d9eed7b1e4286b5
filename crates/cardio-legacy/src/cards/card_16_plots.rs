//! Series 16: the plot option.

use super::SeriesLayout;
use super::field::{ONE, field};

pub(super) fn series() -> SeriesLayout {
    let meaning = "STAN: plots of 14 variables against time; NONE: no plots";
    SeriesLayout::new(16, "plot option").then("A4", [field("HED(1)", ONE, meaning)])
}
