//! Bands over time: within which the middle 90 % of the members lie, and when they part.

use occupant_core::model::Model;
use occupant_core::results::channel::{Channel, matching};
use occupant_core::results::customary::BANDS;
use occupant_study::spread::Band;

use super::judge::{Tolerance, smallest};
use crate::base::failure::Failure;
use crate::files::history;

/// Memory that histories may take.
const MOST_BYTES: usize = 1 << 30;

/// The bands of an ensemble.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Bands {
    pub(crate) time_s: Vec<f64>,
    pub(crate) channels: Vec<ChannelBand>,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ChannelBand {
    /// Name of the channel.
    pub(crate) name: String,
    pub(crate) unit: &'static str,
    /// The unchanged run.
    pub(crate) nominal: Vec<f64>,
    /// Quantiles of the members.
    pub(crate) band: Band,
    /// Width of the middle 90 % from which on the members count as parted.
    pub(crate) tolerance: f64,
    /// When they first are wider apart; none if never.
    pub(crate) lost_at_s: Option<f64>,
    /// Greatest width of the middle 90 %, and its time.
    pub(crate) widest: Option<(f64, f64)>,
}

/// The channels that names and patterns ask for, in the order asked; the main ones for none.
///
/// # Errors
/// A name or pattern that fits no channel.
pub(crate) fn choose(model: &Model, names: &[String]) -> Result<Vec<Channel>, Failure> {
    if names.is_empty() {
        let main = BANDS.into_iter().flatten().flat_map(|(pattern, _)| matching(model, pattern));
        return Ok(main.collect());
    }
    history::choose(model, names)
}

/// Refuses histories that would not fit into memory.
///
/// # Errors
/// More than one GiB.
pub(crate) fn refuse_too_much(members: u64, channels: usize, outputs: usize) -> Result<(), Failure> {
    let members = usize::try_from(members).unwrap_or(usize::MAX);
    let bytes = members.saturating_mul(channels).saturating_mul(outputs).saturating_mul(size_of::<f64>());
    if bytes <= MOST_BYTES {
        return Ok(());
    }
    Err(Failure::with_help(
        format!(
            "bands of {channels} channels over {outputs} outputs of {members} members need {:.1} GiB, more than the 1 GiB allowed",
            bytes as f64 / MOST_BYTES as f64
        ),
        "ask for fewer --channels or members, or set a longer output.interval",
    ))
}

impl Bands {
    /// The bands of these channels; the histories of the unchanged run come first.
    pub(crate) fn of(channels: &[Channel], time_s: Vec<f64>, runs: &[&[Vec<f64>]], tolerance: Tolerance) -> Bands {
        let band = |(i, channel): (usize, &Channel)| {
            let members: Vec<&[f64]> = runs.iter().filter_map(|r| r.get(i)).map(Vec::as_slice).collect();
            let band = Band::of(&members);
            let unit = channel.unit.symbol();
            let within = (tolerance.relative * range(&band.median)).max(smallest("", unit)).max(put_in(&band, unit));
            ChannelBand {
                name: channel.name.clone(),
                unit,
                nominal: members.first().map(|m| m.to_vec()).unwrap_or_default(),
                lost_at_s: band.time_wider_than(&time_s, within),
                widest: widest(&band, &time_s),
                tolerance: within,
                band,
            }
        };
        Bands { channels: channels.iter().enumerate().map(band).collect(), time_s }
    }
}

/// Greatest width of the middle 90 %, and its time.
fn widest(band: &Band, time_s: &[f64]) -> Option<(f64, f64)> {
    let widths = band.q95.iter().zip(&band.q05).map(|(high, low)| high - low);
    let timed = widths.zip(time_s.iter().copied()).filter(|(w, _)| w.is_finite());
    // the first of equal ones
    timed.reduce(|a, b| if b.0 > a.0 { b } else { a })
}

/// Twice the width at the start, of places and angles: that is what the changes have put in, and no growth.
fn put_in(band: &Band, unit: &str) -> f64 {
    match (unit, band.q95.first(), band.q05.first()) {
        ("m" | "rad", Some(high), Some(low)) => 2.0 * (high - low),
        _ => 0.0,
    }
}

/// Greatest less least: a place has no zero that its size could be told from.
fn range(values: &[f64]) -> f64 {
    let finite = || values.iter().copied().filter(|x| x.is_finite());
    let range = finite().fold(f64::NEG_INFINITY, f64::max) - finite().fold(f64::INFINITY, f64::min);
    range.max(0.0)
}
