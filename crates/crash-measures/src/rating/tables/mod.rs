//! The tables, one room for each body that rates.

mod euro_ncap_2023;
mod euro_ncap_2026;
mod iihs;
mod rules;
mod us_ncap;

use std::sync::LazyLock;

use super::Rating;

/// Every rating.
pub static RATINGS: LazyLock<Vec<Rating>> = LazyLock::new(|| {
    let all: [&[Rating]; 5] =
        [&euro_ncap_2026::RATINGS, &euro_ncap_2023::RATINGS, &us_ncap::RATINGS, &iihs::RATINGS, &rules::RATINGS];
    all.concat()
});
