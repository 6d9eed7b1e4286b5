//! X-Y plots of time histories as SVG.
//!
//! A [`Figure`] holds curves in the units shown; `draw` sets it into a rectangle so that nothing overlaps: its margins are
//! measured from its labels, the legend stands below the axes, names that are too long lose their middle.

mod assemble;
mod curve;
mod draw;
mod figure;
mod legend;
mod scale;
mod sheet;
mod standard;

pub use assemble::{LimitArgument, Material, Overlay, RunCurves, figure};
pub use figure::{Axis, Curve, Figure, Style};
pub use sheet::{Sheet, inline, sheet};
pub use standard::{Entry, Plot, standard};
