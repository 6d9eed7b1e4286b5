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

pub(crate) use projection::View;
pub(crate) use sheet::{draw, frames};

use super::body::Snapshot;

/// What is drawn.
pub(crate) struct Strip<'a> {
    pub(crate) model: &'a Model,
    /// The moments, in order.
    pub(crate) moments: Vec<Snapshot>,
    /// The rows.
    pub(crate) views: Vec<View>,
    /// Small print: where the pictures come from.
    pub(crate) origin: String,
}
