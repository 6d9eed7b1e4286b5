//! Bands over time: the range of the middle 90 % of the members, and the time at which they diverge.

use crate::base::customary::BANDS;
use occupant_core::model::Model;
use occupant_core::results::channel::{Channel, matching};
use occupant_study::spread::Band;

use serde::Serialize;

use super::judge::smallest;
use crate::base::Failure;
use crate::files::history;
use occupant_files::table::{Cell, Kind, columns};

/// Largest memory for histories and bands: with everything else below 1 GB.
const MOST_BYTES: usize = 1 << 29;
/// Number of curves per band.
const CURVES: usize = 6;

/// The bands of an ensemble; in JSON without their values.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Bands {
    /// Times, s.
    #[serde(skip)]
    pub time_s: Vec<f64>,
    /// The channels.
    pub channels: Vec<ChannelBand>,
}

/// The band of a channel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChannelBand {
    /// Its name.
    pub name: String,
    /// SI unit, as in the catalogue.
    pub unit: &'static str,
    /// The unchanged run.
    #[serde(skip)]
    pub nominal: Vec<f64>,
    /// The quantiles at each output.
    #[serde(skip)]
    pub band: Band,
    /// Width of the middle 90 % at which the members count as diverged, in the unit.
    pub tolerance: f64,
    /// Time of divergence, s; none if they never diverge.
    pub lost_at_s: Option<f64>,
    /// Largest width of the middle 90 %, in the unit.
    pub widest: Option<f64>,
    /// Time of the largest width, s.
    pub widest_at_s: Option<f64>,
}

/// Channels selected by names and patterns, in the given order; the main ones if there are none.
///
/// # Errors
/// A name or pattern that fits no channel.
pub fn choose(model: &Model, names: &[String]) -> Result<Vec<Channel>, Failure> {
    if names.is_empty() {
        let main = BANDS.into_iter().flatten().flat_map(|(pattern, _)| matching(model, pattern));
        return Ok(main.collect());
    }
    history::choose(model, names)
}

/// Refuses histories that would not fit into memory.
///
/// # Errors
/// More than half a GiB.
pub fn refuse_too_much(members: u64, channels: usize, outputs: usize) -> Result<(), Failure> {
    let members = usize::try_from(members).unwrap_or(usize::MAX);
    let curves = members.saturating_add(CURVES).saturating_mul(channels);
    let bytes = curves.saturating_mul(outputs).saturating_mul(size_of::<f64>());
    if bytes <= MOST_BYTES {
        return Ok(());
    }
    Err(Failure::with_help(
        format!(
            "bands of {channels} channels, {outputs} outputs and {members} runs need {:.1} GiB; the limit is 0.5 GiB",
            bytes as f64 / f64::from(1 << 30)
        ),
        "select fewer channels with --channel, run fewer members, or set a longer output.interval",
    ))
}

impl Bands {
    /// Bands of these channels; the histories of the unchanged run come first. `relative` is the width at which members
    /// count as diverged, relative to a channel's range.
    pub fn of(channels: &[Channel], time_s: Vec<f64>, runs: &[&[Vec<f64>]], relative: f64) -> Bands {
        let band = |(i, channel): (usize, &Channel)| {
            let members: Vec<&[f64]> = runs.iter().filter_map(|r| r.get(i)).map(Vec::as_slice).collect();
            let band = Band::of(&members);
            let unit = channel.unit.symbol();
            let tolerance = (relative * range(&band.median)).max(smallest("", unit)).max(put_in(&band, unit));
            let widest = widest(&band, &time_s);
            ChannelBand {
                name: channel.name.clone(),
                unit,
                nominal: members.first().map(|m| m.to_vec()).unwrap_or_default(),
                lost_at_s: band.time_wider_than(&time_s, tolerance),
                widest: widest.map(|(width, _)| width),
                widest_at_s: widest.map(|(_, time_s)| time_s),
                tolerance,
                band,
            }
        };
        Bands { channels: channels.iter().enumerate().map(band).collect(), time_s }
    }

    /// Columns of a table of bands.
    pub fn columns() -> Vec<(&'static str, Kind)> {
        let values = ["time_s", "nominal", "q05", "q25", "median", "q75", "q95"];
        columns(&[(Kind::Text, &["channel", "unit"]), (Kind::MaybeNumber, &values)])
    }

    /// Rows of that table, one per channel and time, with the channel.
    pub fn rows(&self) -> impl Iterator<Item = (&ChannelBand, Vec<Cell>)> {
        let times = 0..self.time_s.len();
        self.channels.iter().flat_map(move |band| times.clone().map(move |i| (band, band.cells(&self.time_s, i))))
    }
}

impl ChannelBand {
    /// Channel, unit, time and the values of an output.
    fn cells(&self, time_s: &[f64], output: usize) -> Vec<Cell> {
        let b = &self.band;
        let values = [time_s, &self.nominal, &b.q05, &b.q25, &b.median, &b.q75, &b.q95];
        let mut cells = vec![Cell::text(&self.name), Cell::text(self.unit)];
        cells.extend(values.map(|v| v.get(output).map_or(Cell::Absent, |x| Cell::finite(*x))));
        cells
    }
}

/// Largest width of the middle 90 %, and its time.
fn widest(band: &Band, time_s: &[f64]) -> Option<(f64, f64)> {
    let widths = band.q95.iter().zip(&band.q05).map(|(high, low)| high - low);
    let timed = widths.zip(time_s.iter().copied()).filter(|(w, _)| w.is_finite());
    // the first of equal ones
    timed.reduce(|a, b| if b.0 > a.0 { b } else { a })
}

/// Twice the initial width of positions and angles: the perturbation itself, not its growth.
fn put_in(band: &Band, unit: &str) -> f64 {
    match (unit, band.q95.first(), band.q05.first()) {
        ("m" | "rad", Some(high), Some(low)) => 2.0 * (high - low),
        _ => 0.0,
    }
}

/// Largest minus least value: a position has no natural zero.
fn range(values: &[f64]) -> f64 {
    let finite = || values.iter().copied().filter(|x| x.is_finite());
    let range = finite().fold(f64::NEG_INFINITY, f64::max) - finite().fold(f64::INFINITY, f64::min);
    range.max(0.0)
}
