//! Materials of surfaces.

use serde::{Deserialize, Serialize};

use crate::forces::function::{Beyond, ForceDeflection};
use crate::forces::spring::BilinearSpring;
use placed_text::Problems;

/// Memory of crush.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "schema", schemars(rename = "MemoryChoice"))]
pub enum Memory {
    /// Forgotten when contact ends: padding that recovers.
    #[default]
    Reset,
    /// Kept for that sphere and surface: crushed metal.
    Retain,
}

/// A contact material.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Unique name.
    pub name: String,
    /// Normal force law.
    pub force: Force,
    /// f, coefficient of friction.
    pub friction: f64,
    /// Factors of f over the slip speed, m/s, and over the normal force, N; empty: 1.
    pub friction_factors: [Vec<[f64; 2]>; 2],
    /// v_s, speed at which friction reaches 1/√2 of its full value. Default 0.127 m/s (5 in/s).
    pub friction_speed_m_s: f64,
    /// Memory after the contact opens.
    pub memory: Memory,
    /// When a surface or solid of it breaks as a whole; none of what never does.
    pub breaks: Option<Breaking>,
}

/// A pane: it is whole for all parts of all bodies until one segment, with all its spheres together, reaches a limit, and
/// broken for all from then on. How deep it is pressed, and what that leaves, stays a matter of each sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct Breaking {
    /// What it bears.
    pub limit: Limit,
    /// Normal force over depth of what is left; none where nothing is.
    pub left: Option<Force>,
}

/// What a pane bears of one segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// Normal force, N.
    Force(f64),
    /// Work of loading, J: the area below force over depth up to the largest depth, without factors of speed and damper.
    Energy(f64),
}

impl Limit {
    /// Its number, N or J.
    pub fn value(self) -> f64 {
        let (Limit::Force(value) | Limit::Energy(value)) = self;
        value
    }
}

/// Normal force over depth.
#[derive(Clone, Debug, PartialEq)]
pub enum Force {
    /// Two straight lines.
    Bilinear(BilinearSpring),
    /// A force function.
    Deflection(Box<ForceDeflection>),
}

impl Force {
    /// The spring, if it is one of two lines.
    pub fn bilinear(&self) -> Option<&BilinearSpring> {
        if let Force::Bilinear(spring) = self { Some(spring) } else { None }
    }

    /// The spring to be changed, if it is one of two lines.
    pub fn bilinear_mut(&mut self) -> Option<&mut BilinearSpring> {
        if let Force::Bilinear(spring) = self { Some(spring) } else { None }
    }

    /// Slope of the stiffest branch, N/m.
    pub(crate) fn steepest_n_per_m(&self) -> f64 {
        match self {
            Force::Bilinear(spring) => spring.steepest_n_per_m(),
            Force::Deflection(law) => law.steepest(),
        }
    }

    /// Reports problems of it under `path`.
    pub(super) fn check(&self, path: &str, problems: &mut Problems) {
        match self {
            Force::Bilinear(spring) => spring.check(path, problems),
            Force::Deflection(law) => law.check(path, problems),
        }
    }

    /// Whether it is unknown beyond its last point.
    pub(super) fn ends(&self) -> bool {
        matches!(self, Force::Deflection(law) if law.loading.beyond == Beyond::Limits)
    }
}

impl From<BilinearSpring> for Force {
    fn from(spring: BilinearSpring) -> Self {
        Force::Bilinear(spring)
    }
}

impl From<ForceDeflection> for Force {
    fn from(law: ForceDeflection) -> Self {
        Force::Deflection(Box::new(law))
    }
}

impl Material {
    /// A material with the usual friction speed, which forgets its crush when a pair opens.
    pub fn new(name: impl Into<String>, force: impl Into<Force>, friction: f64) -> Self {
        Material {
            name: name.into(),
            force: force.into(),
            friction,
            friction_factors: [Vec::new(), Vec::new()],
            friction_speed_m_s: DEFAULT_FRICTION_SPEED_M_S,
            memory: Memory::default(),
            breaks: None,
        }
    }
}

/// v_s unless a scenario gives another: 5 in/s.
pub const DEFAULT_FRICTION_SPEED_M_S: f64 = 0.127;
