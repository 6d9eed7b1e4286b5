//! Series 1 and 2: the title.

use super::SeriesLayout;
use super::field::{ONE, field};

pub(super) fn title() -> SeriesLayout {
    SeriesLayout::new(1, "title").then("20A4", [field("HED", ONE, "text printed at the top of each page")])
}

pub(super) fn title_continued() -> SeriesLayout {
    SeriesLayout::new(2, "title, continued").then("20A4", [field("HED", ONE, "second line of the title")])
}
