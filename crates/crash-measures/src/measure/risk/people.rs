//! Risk functions for people instead of dummies.

/// Number of broken ribs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum BrokenRibs {
    /// At least one.
    Any,
    /// More than six.
    MoreThanSix,
}

/// Compression of the chest (deflection over depth) at which half of the people of an age, in years, have broken ribs:
/// Kent et al. (ESV 2003), 93 subjects, all loads. None below 30 and above 70 years.
///
/// Only the values at 30 and 70 years were found, in an abstract; between them it is linear. The slope of the curve was not
/// found, so this is a single point of it, not a risk curve.
#[must_use]
pub fn even_odds_compression(ribs: BrokenRibs, age_years: f64) -> Option<f64> {
    let [at_30, at_70] = match ribs {
        BrokenRibs::Any => [0.35, 0.13],
        BrokenRibs::MoreThanSix => [0.43, 0.33],
    };
    (30.0..=70.0).contains(&age_years).then(|| at_30 + (at_70 - at_30) * (age_years - 30.0) / 40.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_points_of_the_abstract_and_nothing_beyond() {
        let of = |ribs| [30.0, 50.0, 70.0].map(|age| even_odds_compression(ribs, age).unwrap());
        assert_eq!(of(BrokenRibs::Any).map(|c| (1e4 * c).round()), [3500.0, 2400.0, 1300.0]);
        assert_eq!(of(BrokenRibs::MoreThanSix).map(|c| (1e4 * c).round()), [4300.0, 3800.0, 3300.0]);
        for age in [29.9, 70.1, f64::NAN, f64::INFINITY] {
            assert_eq!(even_odds_compression(BrokenRibs::Any, age), None);
        }
    }
}
