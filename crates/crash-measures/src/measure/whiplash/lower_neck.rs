//! Lower neck load index of Heitplatz et al. (ESV 2003).
//!
//! LNL(t) = √(M_x² + M_y²)/15 N·m + √(F_x² + F_y²)/250 N + |F_z|/900 N at the lower neck (T1). The intercepts are as
//! generally known; the paper was not read. They were made for a RID 2.

use crate::measure::{Peak, peak::maximum};
use crate::signal::{SignalError, require_positive, require_same_length, require_samples};

/// Loads that each alone give an index of 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LowerNeckIntercepts {
    /// Moment, N·m.
    pub moment_nm: f64,
    /// Shear, N.
    pub shear_n: f64,
    /// Axial force, N.
    pub axial_n: f64,
}

impl Default for LowerNeckIntercepts {
    fn default() -> Self {
        Self { moment_nm: 15.0, shear_n: 250.0, axial_n: 900.0 }
    }
}

/// Loads of the lower neck over time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LowerNeckLoads<'a> {
    /// Force along X, Y, Z, N.
    pub force_n: [&'a [f64]; 3],
    /// Moment about X and Y, N·m.
    pub moment_nm: [&'a [f64]; 2],
}

/// Largest lower neck load index, without unit.
///
/// # Errors
/// No sample, different lengths, a sample that is not finite, an interval or intercept that is not positive.
pub fn lower_neck_load(
    loads: &LowerNeckLoads,
    dt_s: f64,
    intercepts: &LowerNeckIntercepts,
) -> Result<Peak, SignalError> {
    let LowerNeckIntercepts { moment_nm, shear_n, axial_n } = *intercepts;
    for own in [moment_nm, shear_n, axial_n] {
        require_positive("intercept of the lower neck load", own)?;
    }
    let ([fx, fy, fz], [mx, my]) = (loads.force_n, loads.moment_nm);
    for own in [fx, fy, fz, mx, my] {
        require_samples("lower neck load", own, dt_s, 1)?;
        require_same_length("lower neck load", own, fx)?;
    }
    let at =
        |i: usize| libm::hypot(mx[i], my[i]) / moment_nm + libm::hypot(fx[i], fy[i]) / shear_n + fz[i].abs() / axial_n;
    maximum(&(0..fx.len()).map(at).collect::<Vec<_>>(), dt_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_add_at_one_time_and_any_sign() {
        let loads = LowerNeckLoads {
            force_n: [&[30.0, 0.0], &[-40.0, 0.0], &[-180.0, 90.0]],
            moment_nm: [&[0.0, 0.0], &[-6.0, 3.0]],
        };
        // 6/15 + 50/250 + 180/900
        let found = lower_neck_load(&loads, 1e-3, &LowerNeckIntercepts::default()).unwrap();
        assert!((found.value - 0.8).abs() < 1e-15 && found.time_s == 0.0, "{found:?}");
    }

    #[test]
    fn unusable_loads_are_named() {
        let empty: &[f64] = &[];
        let own = LowerNeckIntercepts::default();
        let of = |loads: &LowerNeckLoads, own| lower_neck_load(loads, 1e-3, own);
        assert!(of(&LowerNeckLoads { force_n: [empty; 3], moment_nm: [empty; 2] }, &own).is_err());
        let one: &[f64] = &[1.0];
        let loads = LowerNeckLoads { force_n: [one; 3], moment_nm: [one; 2] };
        assert!(
            of(&loads, &own).is_ok() && of(&LowerNeckLoads { moment_nm: [one, &[1.0; 2]], ..loads }, &own).is_err()
        );
        assert!(of(&loads, &LowerNeckIntercepts { shear_n: f64::NAN, ..own }).is_err());
    }
}
