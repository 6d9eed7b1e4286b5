//! Rounding of Euro NCAP 2026: half up in decimals, as spreadsheets do, after noise of the binary number is removed.

/// Decimals to which the noise of a binary number is removed first.
const GUARD: u32 = 9;
/// Beyond this a double has no nine decimals.
const LARGEST: f64 = 1e15;

/// A value rounded half away from zero to some decimals, at most nine.
pub(super) fn half_up(value: f64, decimals: u32) -> f64 {
    if !value.is_finite() || value.abs() >= LARGEST {
        return value;
    }
    // the text is that of the exact binary value
    let text = format!("{:.*}", GUARD as usize, value.abs());
    let guarded: i128 = text
        .chars()
        .filter(char::is_ascii_digit)
        .fold(0, |sum, digit| 10 * sum + i128::from(digit.to_digit(10).unwrap_or(0)));
    let step = 10_i128.pow(GUARD - decimals.min(GUARD));
    let rounded = (guarded + step / 2) / step;
    (rounded as f64 / 10_f64.powi(decimals.min(GUARD) as i32)).copysign(value)
}

#[cfg(test)]
mod tests {
    use super::half_up;

    #[test]
    fn halves_go_up_whatever_the_binary_number_next_to_them() {
        for (value, decimals, rounded) in [
            (0.075, 2, 0.08),
            (1.005, 2, 1.01),
            (0.474_999_999_999_999_9, 2, 0.48),
            (2.674_999, 2, 2.67),
            (-0.125, 2, -0.13),
            (499.995, 2, 500.0),
            (0.208_333_333_333_333, 5, 0.208_33),
            (3.0, 2, 3.0),
        ] {
            assert_eq!(half_up(value, decimals), rounded, "{value}");
        }
        assert!(half_up(f64::NAN, 2).is_nan());
        assert_eq!((half_up(f64::INFINITY, 2), half_up(1e300, 2)), (f64::INFINITY, 1e300));
    }
}
