//! Units and digits of the printout: inches and pounds as in 1970, or SI.

use std::f64::consts::PI;

use occupant_core::model::setup::STANDARD_GRAVITY_M_S2;

/// A unit: its name in headings, its size and the decimals that are worth printing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Unit {
    /// Name in headings.
    pub(crate) name: &'static str,
    /// SI units in one of it.
    si: f64,
    decimals: usize,
}

/// The units of a printout.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Units {
    /// Name of the system.
    pub(crate) name: &'static str,
    pub(crate) length: Unit,
    pub(crate) speed: Unit,
    pub(crate) acceleration: Unit,
    pub(crate) force: Unit,
    pub(crate) mass: Unit,
    pub(crate) inertia: Unit,
    pub(crate) stiffness: Unit,
    pub(crate) energy: Unit,
    pub(crate) moment: Unit,
    pub(crate) joint_stiffness: Unit,
    pub(crate) joint_damping: Unit,
}

/// International inch, m (exact).
const INCH_M: f64 = 0.0254;
/// International pound, kg (exact).
const POUND_KG: f64 = 0.453_592_37;
/// Pound-force, N (exact).
const POUND_FORCE_N: f64 = POUND_KG * STANDARD_GRAVITY_M_S2;

const fn unit(name: &'static str, si: f64, decimals: usize) -> Unit {
    Unit { name, si, decimals }
}

/// Metre, kilogram, newton.
pub(crate) const SI: Units = Units {
    name: "SI",
    length: unit("M", 1.0, 4),
    speed: unit("M/S", 1.0, 3),
    acceleration: unit("M/S2", 1.0, 2),
    force: unit("N", 1.0, 1),
    mass: unit("KG", 1.0, 4),
    inertia: unit("KG-M2", 1.0, 5),
    stiffness: unit("N/M", 1.0, 1),
    energy: unit("J", 1.0, 2),
    moment: unit("N-M", 1.0, 2),
    joint_stiffness: unit("N-M/RAD", 1.0, 2),
    joint_damping: unit("N-M-S/RAD", 1.0, 3),
};

/// Inch, pound-force, second; masses as weights in pounds, inertias in lbf-in-s².
pub(crate) const INCH_POUND: Units = Units {
    name: "INCH-POUND",
    length: unit("IN", INCH_M, 3),
    speed: unit("IN/S", INCH_M, 2),
    acceleration: unit("IN/S2", INCH_M, 1),
    force: unit("LBF", POUND_FORCE_N, 2),
    mass: unit("LB", POUND_KG, 3),
    inertia: unit("LBF-IN-S2", POUND_FORCE_N * INCH_M, 4),
    stiffness: unit("LBF/IN", POUND_FORCE_N / INCH_M, 2),
    energy: unit("IN-LBF", POUND_FORCE_N * INCH_M, 1),
    moment: unit("IN-LBF", POUND_FORCE_N * INCH_M, 1),
    joint_stiffness: unit("IN-LBF/RAD", POUND_FORCE_N * INCH_M, 2),
    joint_damping: unit("IN-LBF-S/RAD", POUND_FORCE_N * INCH_M, 3),
};

pub(crate) const DEGREE: Unit = unit("DEG", PI / 180.0, 2);
pub(crate) const G: Unit = unit("G", STANDARD_GRAVITY_M_S2, 3);
/// Angular velocity.
pub(crate) const RAD_S: Unit = unit("RAD/S", 1.0, 3);
/// Angular acceleration.
pub(crate) const RAD_S2: Unit = unit("RAD/S2", 1.0, 2);
/// Plain number.
pub(crate) const RATIO: Unit = unit("-", 1.0, 4);

impl Unit {
    /// An SI value in this unit with its decimals; with an exponent where no column would hold it.
    pub(crate) fn show(&self, si: f64) -> String {
        let (value, decimals) = (si / self.si, self.decimals);
        if value == 0.0 || value.abs() < 1e7 && value.abs() >= 0.5 * 0.1_f64.powi(decimals as i32) {
            // minus zero is zero
            return format!("{:.decimals$}", value + 0.0);
        }
        match value.is_finite() {
            true => format!("{value:.3E}"),
            false => value.to_string().to_uppercase(),
        }
    }

    /// SI units in one of it.
    pub(crate) const fn size(&self) -> f64 {
        self.si
    }

    /// The same as [`Unit::show`], or `-` where there is none.
    pub(crate) fn perhaps(&self, si: Option<f64>) -> String {
        si.map_or_else(|| "-".to_owned(), |si| self.show(si))
    }

    /// Three components.
    pub(crate) fn vector(&self, si: impl Into<[f64; 3]>) -> [String; 3] {
        si.into().map(|component| self.show(component))
    }

    /// Three components in words.
    pub(crate) fn point(&self, si: [f64; 3]) -> String {
        format!("({})", self.vector(si).join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_digits() {
        assert_eq!(INCH_POUND.length.show(0.254), "10.000");
        assert_eq!(INCH_POUND.force.show(POUND_FORCE_N), "1.00");
        assert_eq!(SI.length.show(-0.12344), "-0.1234");
        assert_eq!(SI.force.show(-0.0), "0.0");
        assert_eq!(SI.force.show(0.001), "1.000E-3");
        assert_eq!(SI.force.show(2.5e9), "2.500E9");
        assert_eq!(SI.force.show(f64::NAN), "NAN");
    }
}
