//! Series 15: the end of the numbers.

use super::SeriesLayout;

/// The series that ends the numbers of a deck.
pub(crate) const END_OF_NUMBERS: u8 = 15;

pub(super) fn series() -> SeriesLayout {
    SeriesLayout::new(END_OF_NUMBERS, "end of the numbers").first(1000, "70X,I10", [])
}
