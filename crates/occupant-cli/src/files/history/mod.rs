//! Time histories taken from a run: chosen by name, filtered, resampled, in the units asked for.
//!
//! Exports, plots and comparisons are made of these. Everything is SI until it is shown.
//! Opens no file: results come to it open.

mod choose;
mod filter;
mod load;
mod unit;

use crash_measures::signal::ChannelClass;
use occupant_core::results::channel::Channel;

pub(crate) use choose::choose;
pub(crate) use filter::{Filter, family_name, filtered};
pub(crate) use load::{Treatment, Untreated, asked, load, treated};
pub(crate) use unit::{UnitChoice, plotted, shown};

/// Channels of one run over common times.
#[derive(Clone, Debug)]
pub(crate) struct Histories {
    pub(crate) time_s: Vec<f64>,
    /// The channels in the order asked for.
    pub(crate) columns: Vec<Column>,
    /// What was done that a reader should know.
    pub(crate) notes: Vec<String>,
}

/// One channel of a run.
#[derive(Clone, Debug)]
pub(crate) struct Column {
    pub(crate) channel: Channel,
    /// The filter class that was applied.
    pub(crate) class: Option<ChannelClass>,
    /// Values in the channel's SI unit, one a time.
    pub(crate) values: Vec<f64>,
}

/// `CFC 180`, or `none`.
pub(crate) fn class_name(class: Option<ChannelClass>) -> String {
    class.map_or_else(|| "none".to_owned(), |c| format!("CFC {}", c.hertz()))
}
