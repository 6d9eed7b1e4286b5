//! Resultant of components.

use super::{SignalError, require_same_length};

/// √(x² + y² + z²), sample by sample, in the unit of the components.
///
/// # Errors
/// Components of different length.
pub fn resultant(x: &[f64], y: &[f64], z: &[f64]) -> Result<Vec<f64>, SignalError> {
    require_same_length("y component", y, x)?;
    require_same_length("z component", z, x)?;
    Ok(x.iter().zip(y).zip(z).map(|((x, y), z)| (x * x + y * y + z * z).sqrt()).collect())
}

/// √(x² + y²), sample by sample, in the unit of the components.
///
/// # Errors
/// Components of different length.
pub fn resultant2(x: &[f64], y: &[f64]) -> Result<Vec<f64>, SignalError> {
    require_same_length("y component", y, x)?;
    Ok(x.iter().zip(y).map(|(x, y)| (x * x + y * y).sqrt()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pythagoras() {
        assert_eq!(resultant(&[2.0, 0.0], &[-3.0, 0.0], &[6.0, -1.0]).unwrap(), [7.0, 1.0]);
        assert_eq!(resultant2(&[3.0], &[-4.0]).unwrap(), [5.0]);
        assert!(matches!(resultant(&[1.0], &[1.0, 2.0], &[1.0]), Err(SignalError::LengthMismatch { .. })));
    }
}
