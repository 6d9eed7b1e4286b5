//! Units of derivatives.

/// Unit of a derivative: that of the figure per that of the parameter.
pub fn per(measure: &str, parameter: &str) -> String {
    let bare = |unit: &str| unit == "1" || unit.is_empty();
    let parameter_in_brackets =
        if parameter.contains(['*', '·', '/', '^', ' ']) { format!("({parameter})") } else { parameter.to_owned() };
    match (bare(measure), bare(parameter)) {
        (true, true) => "1".to_owned(),
        (false, true) => measure.to_owned(),
        (_, false) => format!("{}/{parameter_in_brackets}", if bare(measure) { "1" } else { measure }),
    }
}

/// A unit in ASCII.
pub fn ascii(unit: &str) -> String {
    unit.replace('·', "*").replace('²', "^2")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_derivative_has_a_unit() {
        assert_eq!(per("m/s^2", "N/m"), "m/s^2/(N/m)");
        assert_eq!(per("1", "rad"), "1/rad");
        assert_eq!(per("N", "1"), "N");
        assert_eq!(per("1", "1"), "1");
        assert_eq!(ascii(&per("N", "N·m·s/rad")), "N/(N*m*s/rad)");
    }
}
