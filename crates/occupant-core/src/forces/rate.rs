//! Rates of the equations of motion: the rate of a single spring or damper.
//!
//! A spring K against an effective mass m oscillates with ω = √(K/m); a damper J against an effective inertia I decays
//! with J/I.

use serde::Serialize;

/// A rate of the equations of motion.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Rate {
    /// Name of the sphere, belt or joint.
    pub of: String,
    /// Source: the material, the belt's sphere, or the joint's damper or spring.
    pub by: String,
    /// Effective mass in kg, or effective inertia in kg·m².
    pub effective: f64,
    /// Stiffness in N/m or N·m/rad, or damping in N·m·s/rad.
    pub coefficient: f64,
    /// 1/rate, s.
    pub time_scale_s: f64,
}

impl Rate {
    /// Rate of a spring.
    pub(crate) fn of_spring(of: String, by: String, effective: f64, stiffness: f64) -> Rate {
        Rate { of, by, effective, coefficient: stiffness, time_scale_s: (effective / stiffness).sqrt() }
    }

    /// Rate of a damper, if there is any.
    pub(crate) fn of_damper(of: &str, inertia_kg_m2: f64, damping_n_m_s: f64) -> Option<Rate> {
        (damping_n_m_s > 0.0).then(|| Rate {
            of: of.to_owned(),
            by: "damper".to_owned(),
            effective: inertia_kg_m2,
            coefficient: damping_n_m_s,
            time_scale_s: inertia_kg_m2 / damping_n_m_s,
        })
    }
}
