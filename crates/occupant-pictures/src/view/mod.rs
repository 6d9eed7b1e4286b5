//! Orthographic views of the body in the compartment, as a strip of times: the report's Figs 21–38.
//!
//! All panels of a strip share one scale and one window. Everything is drawn in vehicle axes from the samples of the run.

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

/// What is drawn.
pub struct Strip<'a> {
    /// The model.
    pub model: &'a Model,
    /// The moments, in order.
    pub moments: Vec<Snapshot>,
    /// The rows.
    pub views: Vec<View>,
    /// Small print: where the pictures come from.
    pub origin: String,
}
