//! Belts, as data: one loop round one sphere, two anchors in the vehicle.
//!
//! Report: "Lap and Torso Restraint Belts", Eqs 95–108, Figs 17 and 18.

pub mod law;

use nalgebra::Point3;

use crate::forces::material::BilinearSpring;

/// How the unstretched length L₀ is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RestLength {
    /// L₀ = length at the start + slack; negative slack is preload.
    Slack {
        /// Slack.
        slack_m: f64,
    },
    /// L₀ itself.
    Given {
        /// L₀.
        length_m: f64,
    },
}

impl Default for RestLength {
    /// Neither slack nor preload.
    fn default() -> Self {
        RestLength::Slack { slack_m: 0.0 }
    }
}

/// A belt.
#[derive(Clone, Debug, PartialEq)]
pub struct Belt {
    /// Unique name, e.g. `lap`, `torso`.
    pub name: String,
    /// Index of the sphere that it loops round: pelvis for a lap belt, chest for a torso belt.
    pub sphere: usize,
    /// Anchor points, vehicle axes.
    pub anchors_m: [Point3<f64>; 2],
    /// Loop force over elongation. Fractions of 1 load and unload along one curve as in Fig. 18.
    pub webbing: BilinearSpring,
    /// Unstretched length.
    pub rest: RestLength,
}

impl Belt {
    /// A belt without slack round the sphere `sphere` (index), from anchor to anchor (vehicle axes).
    pub fn new(name: impl Into<String>, sphere: usize, anchors_m: [Point3<f64>; 2], webbing: BilinearSpring) -> Self {
        Belt { name: name.into(), sphere, anchors_m, webbing, rest: RestLength::default() }
    }
}
