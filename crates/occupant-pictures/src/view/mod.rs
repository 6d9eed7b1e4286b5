//! Orthographic views of the body in the compartment, as a strip of times: the report's Figs 21–38.
//!
//! All panels of a strip share one scale and one window. Everything is drawn in vehicle axes from the samples of the run.

mod dimensions;
mod hull;
mod layout;
mod legend;
mod panel;
mod projection;
mod sheet;
mod window;

use occupant_core::model::Model;

pub use projection::View;
pub use sheet::{draw, frames};

use super::body::Snapshot;

/// A strip of pictures.
pub struct Strip<'a> {
    /// The model.
    pub model: &'a Model,
    /// The moments, in order.
    pub moments: Vec<Snapshot>,
    /// The views, one per row.
    pub views: Vec<View>,
    /// Caption: origin of the pictures.
    pub origin: String,
    /// Distances drawn in the pictures of the first moment.
    pub dimensions: Vec<Measured>,
}

/// A distance or an angle, drawn as a line between its ends with its label.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Its label, such as `H30 250`.
    pub label: String,
    /// Its ends, vehicle axes, m.
    pub ends_m: [[f64; 3]; 2],
    /// Whether it is the angle of a line.
    pub is_angle: bool,
}
