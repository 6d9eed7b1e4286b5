//! From a result file, and the names that a person gives, to histories.

use crash_measures::signal::{CfcFamily, Interpolant, Interpolation, resultant, uniform_interval};
use occupant_core::model::Model;
use occupant_core::results::channel::{Channel, Series, channels, find, matching};
use placed_text::number;

use super::filter::family_name;
use super::{Column, Filter, Histories, filtered};
use crate::base::Failure;
use crate::results::Results;

/// Processing of histories: filter, then resample.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
pub struct Treatment {
    /// Filter: CFC60, CFC180, CFC600, CFC1000, j211 (the SAE J211 class of each channel) or none
    #[cfg_attr(feature = "clap", arg(long, value_name = "CLASS", default_value = "none"))]
    pub filter: Filter,

    /// Standard for the filter coefficients
    #[cfg_attr(feature = "clap", arg(long = "coefficients", value_name = "STANDARD", default_value = "iso6487", value_parser = crate::base::one_of(&super::FAMILIES)))]
    pub family: CfcFamily,

    // the new interval, s; that of the outputs if absent
    /// The new interval, s; that of the outputs if absent.
    #[cfg_attr(feature = "clap", arg(skip))]
    pub interval_s: Option<f64>,
}

impl Treatment {
    /// Description of the filter.
    pub fn words(self) -> String {
        match self.filter {
            Filter::None => "none".to_owned(),
            filter => format!("{} ({} coefficients)", filter.words(), family_name(self.family)),
        }
    }
}

/// Histories of these channels of a run.
///
/// A filtered resultant is that of the filtered components.
///
/// # Errors
/// Outputs too far apart for the filter, or an interval that is none.
pub fn load(results: &Results, channels: Vec<Channel>, treatment: Treatment) -> Result<Histories, Failure> {
    let asked = asked(&results.model, &channels, treatment.filter);
    let series = results.series(asked)?;
    let treated = treated(&results.model, channels, series, treatment);
    let mut histories = treated.map_err(|error| match error {
        Untreated::Run(what) => Failure::plain(format!("{}: {what}", results.path.display())),
        Untreated::Channel { name, reason } => too_coarse(results, &name, &reason),
    })?;
    histories.notes.splice(0..0, results.notes().into_iter().chain(results.doubt()));
    Ok(histories)
}

/// Reason why histories cannot be processed as requested.
#[derive(Clone, Debug, PartialEq)]
pub enum Untreated {
    /// No channel can be.
    Run(String),
    /// One channel cannot be.
    Channel {
        /// The channel.
        name: String,
        /// The reason.
        reason: String,
    },
}

fn not_given(name: &str) -> Untreated {
    Untreated::Channel { name: name.to_owned(), reason: "its values are not among those given".to_owned() }
}

/// The channels whose values [`treated`] needs to compute these channels.
pub fn asked(model: &Model, channels: &[Channel], filter: Filter) -> Vec<Channel> {
    let mut asked = channels.to_vec();
    if filter != Filter::None {
        asked.extend(channels.iter().flat_map(|c| components(model, c)));
    }
    asked
}

/// Histories of channels computed from their values at the outputs.
///
/// # Errors
/// Outputs too far apart for the filter, or an interval that is none; a channel that is not among the values.
pub fn treated(
    model: &Model,
    channels: Vec<Channel>,
    mut series: Series,
    treatment: Treatment,
) -> Result<Histories, Untreated> {
    let mut notes = Vec::new();
    let dt_s = match treatment.filter {
        Filter::None => None,
        _ => Some(even(&mut series, &mut notes).map_err(Untreated::Run)?),
    };
    let mut columns = Vec::with_capacity(channels.len());
    for channel in channels {
        let class = treatment.filter.class_of(&channel.name);
        let values = match (class, dt_s) {
            (Some(class), Some(dt_s)) => {
                let apply = |name: &str| {
                    let raw = series.of(name).ok_or("its values are not among those given")?;
                    filtered(raw, dt_s, class, treatment.family)
                };
                let found = filtered_channel(model, &channel, &apply);
                found.map_err(|reason| Untreated::Channel { name: channel.name.clone(), reason })?
            }
            _ => series.of(&channel.name).ok_or_else(|| not_given(&channel.name))?.to_vec(),
        };
        columns.push(Column { channel, class, values });
    }
    let mut histories = Histories { time_s: series.time_s, columns, notes };
    if let Some(interval_s) = treatment.interval_s {
        resample(&mut histories, interval_s).map_err(Untreated::Run)?;
    }
    Ok(histories)
}

/// X, Y and Z of a resultant; none of another channel.
fn components(model: &Model, channel: &Channel) -> Vec<Channel> {
    let Some(vector) = channel.name.strip_suffix(".resultant") else {
        return Vec::new();
    };
    let named = |axis: &str| find(model, &format!("{vector}.{axis}")).ok();
    ["x", "y", "z"].into_iter().filter_map(named).collect()
}

fn filtered_channel(
    model: &Model,
    channel: &Channel,
    apply: &impl Fn(&str) -> Result<Vec<f64>, String>,
) -> Result<Vec<f64>, String> {
    let parts = components(model, channel);
    let [x, y, z] = parts.as_slice() else {
        return apply(&channel.name);
    };
    let (x, y, z) = (apply(&x.name)?, apply(&y.name)?, apply(&z.name)?);
    resultant(&x, &y, &z).map_err(|e| e.to_string())
}

/// Interval of the outputs. A last output that is not a whole interval after the one before is left out.
fn even(series: &mut Series, notes: &mut Vec<String>) -> Result<f64, String> {
    uniform_interval(&series.time_s).or_else(|error| {
        let last = series.time_s.len().saturating_sub(1);
        let dt_s = uniform_interval(&series.time_s[..last]).map_err(|_| format!("it cannot be filtered: {error}"))?;
        notes.push(format!(
            "the last output, at {} s, is not a whole interval after the one before and is skipped",
            series.time_s[last]
        ));
        series.time_s.truncate(last);
        series.values.iter_mut().for_each(|v| v.truncate(last));
        Ok(dt_s)
    })
}

fn too_coarse(results: &Results, channel: &str, reason: &str) -> Failure {
    Failure::with_help(
        format!("{}: {channel} cannot be filtered: {reason}", results.path.display()),
        "run with a shorter output.interval (--set 'output.interval=\"0.1 ms\"'), choose a lower class, or leave the channel out",
    )
}

/// Largest number of values (a gigabyte); more is taken for a mistake.
const MOST_VALUES: f64 = 5e7;

fn resample(histories: &mut Histories, interval_s: f64) -> Result<(), String> {
    let time_s = std::mem::take(&mut histories.time_s);
    let recorded_s = (time_s.len() > 1).then(|| (time_s[time_s.len() - 1] - time_s[0]) / (time_s.len() - 1) as f64);
    let samples = time_s.last().zip(time_s.first()).map_or(0.0, |(last, first)| (last - first) / interval_s);
    if samples * histories.columns.len() as f64 > MOST_VALUES {
        let of = histories.columns.len();
        return Err(format!(
            "samples every {} s make {samples:.1e} for each of {of} channels; choose an interval with at most {MOST_VALUES:.0e} values in all",
            number(interval_s)
        ));
    }
    for column in &mut histories.columns {
        let line = Interpolant::new(&time_s, &column.values, Interpolation::Linear);
        let line = line.map_err(|e| format!("{}: {e}", column.channel.name))?;
        column.values = line.resample(interval_s).map_err(|e| e.to_string())?;
    }
    let count = histories.columns.first().map_or(0, |c| c.values.len());
    let start_s = time_s.first().copied().unwrap_or_default();
    histories.time_s = (0..count).map(|i| start_s + i as f64 * interval_s).collect();
    if recorded_s.is_some_and(|r| interval_s > 1.5 * r) && histories.columns.iter().any(|c| c.class.is_none()) {
        histories.notes.push(format!(
            "unfiltered outputs are sampled every {interval_s} s, which is coarser than the outputs: peaks between samples are lost"
        ));
    }
    Ok(())
}

/// Channels selected by names and patterns (`head.*`), each once, in the given order; all if there are no names. Also
/// the patterns without a match, if another name has one.
///
/// # Errors
/// A name or pattern that fits no channel.
pub fn choose<'a>(model: &Model, names: &'a [String]) -> Result<(Vec<Channel>, Vec<&'a str>), Failure> {
    if names.is_empty() {
        return Ok((channels(model), Vec::new()));
    }
    let (mut chosen, mut missing): (Vec<Channel>, Vec<&str>) = (Vec::new(), Vec::new());
    for name in names.iter().flat_map(|n| n.split(',')).map(str::trim) {
        let found = fitting(model, name);
        if found.is_empty() {
            missing.push(name);
        }
        for channel in found {
            if chosen.iter().all(|c| c.name != channel.name) {
                chosen.push(channel);
            }
        }
    }
    match missing.split_first() {
        None => Ok((chosen, missing)),
        // a pattern asks for what there may be
        Some(_) if !chosen.is_empty() && missing.iter().all(|name| name.contains('*')) => Ok((chosen, missing)),
        Some((first, others)) => Err(unknown(model, first, others)),
    }
}

/// Channels matched by a name or a pattern.
fn fitting(model: &Model, name: &str) -> Vec<Channel> {
    if name.contains('*') { matching(model, name) } else { find(model, name).into_iter().collect() }
}

fn unknown(model: &Model, name: &str, others: &[&str]) -> Failure {
    let nearest = if name.contains('*') { None } else { find(model, name).err().and_then(|unknown| unknown.nearest) };
    let inside = matching(model, &format!("*{name}*"));
    let help = match (nearest, inside.first()) {
        (Some(nearest), _) => format!("did you mean `{nearest}`?"),
        (None, Some(one)) => format!(
            "give a complete name, such as `{}`, or use `*` for any part; `occupant channels` lists them",
            one.name
        ),
        (None, None) => {
            "names look like head.acceleration.x, belt.lap.force, energy.balance; `occupant channels` lists them"
                .to_owned()
        }
    };
    let all: Vec<String> = std::iter::once(&name).chain(others).map(|name| format!("`{name}`")).collect();
    Failure::with_help(format!("there is no channel {}", all.join(", ")), &help)
}
