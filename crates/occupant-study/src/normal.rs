//! The standard normal distribution and its inverse.

use std::f64::consts::FRAC_1_SQRT_2;

use occupant_units::trig::{erfc, ln};

/// Φ(z), the cumulative standard normal distribution.
pub(super) fn cumulative(z: f64) -> f64 {
    // Φ(z) = ½ erfc(−z/√2)
    0.5 * erfc(-z * FRAC_1_SQRT_2)
}

/// Φ⁻¹(p) for p in (0, 1); −∞ and ∞ at its ends, NaN outside.
///
/// M. J. Wichura, "Algorithm AS 241: the percentage points of the normal distribution", Applied Statistics 37 (1988),
/// PPND16: three rational functions, accurate to about 1 part in 10¹⁶.
pub fn quantile(p: f64) -> f64 {
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        let r = 0.180625 - q * q;
        return q * ratio(r, &CENTRE);
    }
    let tail = if q < 0.0 { p } else { 1.0 - p };
    if tail <= 0.0 {
        return if tail == 0.0 { q.signum() * f64::INFINITY } else { f64::NAN };
    }
    let r = (-ln(tail)).sqrt();
    let z = if r <= 5.0 { ratio(r - 1.6, &SHOULDER) } else { ratio(r - 5.0, &TAIL) };
    if q < 0.0 { -z } else { z }
}

/// Numerator and denominator of a rational function, lowest power first.
type Ratio = [[f64; 8]; 2];

fn ratio(x: f64, [above, below]: &Ratio) -> f64 {
    let value = |c: &[f64; 8]| c.iter().rev().fold(0.0, |sum, c| sum * x + c);
    value(above) / value(below)
}

/// |p − ½| ≤ 0.425, in 0.180625 − (p − ½)².
#[rustfmt::skip]
const CENTRE: Ratio = [
    [3.387_132_872_796_366_5e0, 1.331_416_678_917_843_8e2, 1.971_590_950_306_551_3e3, 1.373_169_376_550_946e4,
     4.592_195_393_154_987e4, 6.726_577_092_700_87e4, 3.343_057_558_358_813e4, 2.509_080_928_730_122_7e3],
    [1.0, 4.231_333_070_160_091e1, 6.871_870_074_920_579e2, 5.394_196_021_424_751e3,
     2.121_379_430_158_66e4, 3.930_789_580_009_271e4, 2.872_908_573_572_194_3e4, 5.226_495_278_852_854e3],
];

/// √(−ln tail) ≤ 5, in it less 1.6.
#[rustfmt::skip]
const SHOULDER: Ratio = [
    [1.423_437_110_749_683_5, 4.630_337_846_156_546, 5.769_497_221_460_691, 3.647_848_324_763_204_5,
     1.270_458_252_452_368_4, 2.417_807_251_774_506e-1, 2.272_384_498_926_918_4e-2, 7.745_450_142_783_414e-4],
    [1.0, 2.053_191_626_637_759, 1.676_384_830_183_803_8, 6.897_673_349_851e-1,
     1.481_039_764_274_800_8e-1, 1.519_866_656_361_645_7e-2, 5.475_938_084_995_345e-4, 1.050_750_071_644_416_9e-9],
];

/// √(−ln tail) > 5, in it less 5.
#[rustfmt::skip]
const TAIL: Ratio = [
    [6.657_904_643_501_103, 5.463_784_911_164_114, 1.784_826_539_917_291_3, 2.965_605_718_285_048_7e-1,
     2.653_218_952_657_612_4e-2, 1.242_660_947_388_078_4e-3, 2.711_555_568_743_487_6e-5, 2.010_334_399_292_288_1e-7],
    [1.0, 5.998_322_065_558_88e-1, 1.369_298_809_227_358e-1, 1.487_536_129_085_061_5e-2,
     7.868_691_311_456_133e-4, 1.846_318_317_510_054_8e-5, 1.421_511_758_316_446e-7, 2.044_263_103_389_939_8e-15],
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Values printed with the algorithm, and of tables to sixteen digits.
    #[test]
    fn agrees_with_published_values() {
        for (p, z) in [
            (0.25, -0.674_489_750_196_081_7),
            (0.001, -3.090_232_306_167_813_5),
            (1e-20, -9.262_340_089_798_408),
            (0.975, 1.959_963_984_540_054),
            (0.5, 0.0),
        ] {
            // the published values have sixteen digits
            assert!((quantile(p) - z).abs() <= 1e-15 * z.abs(), "{p}: {}", quantile(p));
        }
        assert_eq!(quantile(0.0), f64::NEG_INFINITY);
        assert_eq!(quantile(1.0), f64::INFINITY);
        assert!(quantile(-0.1).is_nan() && quantile(1.1).is_nan());
    }

    /// An independent function leads back: Φ(Φ⁻¹(p)) = p, from the middle to far into the tail.
    #[test]
    fn is_the_inverse_of_the_error_function() {
        let mut worst: f64 = 0.0;
        for i in 1..2000 {
            let p = f64::from(i) / 2000.0;
            worst = worst.max((cumulative(quantile(p)) / p - 1.0).abs());
        }
        for exponent in 1..300 {
            let p = 10_f64.powi(-exponent);
            // a relative error ε of z is one of z²·ε of the tail
            let z = quantile(p);
            worst = worst.max((cumulative(z) / p - 1.0).abs() / (1.0 + z * z));
        }
        // measured: 2.0e-15
        assert!(worst < 5e-15, "{worst:e}");
    }
}
