//! Series 15: the end of the numbers.

use super::SeriesLayout;

/// Card number that ends the numbers of a deck.
pub(crate) const TERMINATOR: u32 = 1000;

pub(super) fn series() -> SeriesLayout {
    SeriesLayout::new(15, "end of the numbers").first(TERMINATOR, "70X,I10", [])
}
