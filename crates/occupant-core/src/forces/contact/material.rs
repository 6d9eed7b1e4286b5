//! What a surface is made of.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::forces::spring::BilinearSpring;

/// Whether crush is remembered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "MemoryChoice")]
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
    pub spring: BilinearSpring,
    /// f, coefficient of friction.
    pub friction: f64,
    /// v_s, speed at which friction reaches 1/√2 of its full value. Default 0.127 m/s (5 in/s).
    pub friction_speed_m_s: f64,
    /// What is remembered after opening.
    pub memory: Memory,
}

impl Material {
    /// A material with the usual friction speed, which forgets its crush when a pair opens.
    pub fn new(name: impl Into<String>, spring: BilinearSpring, friction: f64) -> Self {
        Material {
            name: name.into(),
            spring,
            friction,
            friction_speed_m_s: DEFAULT_FRICTION_SPEED_M_S,
            memory: Memory::default(),
        }
    }
}

/// v_s unless a scenario gives another: 5 in/s.
pub const DEFAULT_FRICTION_SPEED_M_S: f64 = 0.127;
