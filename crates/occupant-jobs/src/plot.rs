//! Curves of each plot: standard plots or channels by name, of one or more runs, with measured signals.

use std::path::PathBuf;

use occupant_core::quantity::Axes;
use occupant_core::results::channel::{Channel, find};

use crate::base::{Failure, file_name};
use crate::files::history::{AxisChoice, Treatment, UnitChoice, choose, load};
use occupant_files::measured::{self, MapArgument, Wanted, pairs};
use occupant_files::results::Results;
use occupant_pictures::plot::{Entry, Figure, LimitArgument, Material, Overlay, Plot, RunCurves, figure, standard};

/// A requested set of plots.
pub struct Request<'a> {
    /// Runs, at least one.
    pub runs: &'a [Results],
    /// Names of the channels of each plot; the standard plots if empty.
    pub channels: &'a [String],
    /// Channel on the horizontal axis; time if absent.
    pub x: Option<&'a str>,
    /// Limits to draw.
    pub limits: &'a [LimitArgument],
    /// Files of measured signals.
    pub tests: &'a [PathBuf],
    /// Assignment of signals to channels.
    pub map: &'a [MapArgument],
    /// Position of the occupant in ISO-MME codes.
    pub seat: char,
    /// Time added to the tests, s.
    pub shift_s: f64,
    /// Filter and interval.
    pub treatment: Treatment,
    /// Units.
    pub units: UnitChoice,
    /// Axes.
    pub axes: AxisChoice,
    /// First and last time drawn.
    pub window_s: [f64; 2],
}

/// The plots, and notes on them.
///
/// # Errors
/// Channels that no run has, signals that belong to no channel, channels of different units in a plot.
pub fn plots(request: &Request<'_>) -> Result<(Vec<Figure>, Vec<String>), Failure> {
    let plots = match request.channels {
        [] => standard_plots(request.runs),
        names => names.iter().map(|names| own_plot(names, request)).collect::<Result<_, _>>()?,
    };
    let names = channel_names(&plots, request.x);
    let mut notes = Vec::new();
    let curves = run_curves(request, &names, &mut notes)?;
    let overlays = overlays(request, &names, &mut notes)?;
    if let Some(limit) = request.limits.iter().find(|l| !names.contains(&l.channel)) {
        return Err(Failure::with_help(
            format!("--limit: no plot shows the channel `{}`", limit.channel),
            "choose a channel that is plotted, or add a plot with --channel",
        ));
    }
    let material = Material {
        runs: &curves,
        overlays: &overlays,
        limits: request.limits,
        x: request.x,
        units: request.units,
        window_s: request.window_s,
    };
    let figures = plots.iter().map(|plot| figure(plot, &material)).collect::<Result<_, _>>();
    let separate = "put these channels on another plot with a second --channel";
    Ok((figures.map_err(|reason| Failure::with_help(reason, separate))?, notes))
}

/// Standard plots with the channels of any run; those missing in the first run come last.
fn standard_plots(runs: &[Results]) -> Vec<Plot> {
    let mut plots = standard(&runs[0].model, runs.len() > 1);
    for more in runs[1..].iter().flat_map(|other| standard(&other.model, true)) {
        match plots.iter_mut().find(|plot| plot.title == more.title) {
            Some(plot) => {
                let new: Vec<Entry> = more.entries.into_iter().filter(|e| !plot.entries.contains(e)).collect();
                plot.entries.extend(new);
            }
            None => plots.push(more),
        }
    }
    plots
}

/// A plot of named channels, as defined by the first run that has them.
fn own_plot(names: &str, request: &Request<'_>) -> Result<Plot, Failure> {
    let mut first_refusal = None;
    for run in request.runs {
        match choose(&run.model, &[names.to_owned()]) {
            Ok(channels) => return Ok(plot_of(names, &channels, request.axes)),
            Err(refusal) => first_refusal = first_refusal.or(Some(refusal)),
        }
    }
    Err(first_refusal.unwrap_or_else(|| Failure::plain("give a run")))
}

fn plot_of(names: &str, channels: &[Channel], axes: AxisChoice) -> Plot {
    let title = match channels {
        [one] if one.axes != Axes::None => format!("{}, {} axes", one.name, axes.of(one).0.name()),
        [one] => one.name.clone(),
        _ => names.split(',').map(str::trim).collect::<Vec<_>>().join(", "),
    };
    let entry = |c: &Channel| Entry { channel: c.name.clone(), label: c.name.clone() };
    Plot {
        title,
        axis: channels.first().map_or("", |c| c.unit.quantity()).to_owned(),
        entries: channels.iter().map(entry).collect(),
        empty: "no value in this time".to_owned(),
    }
}

/// Channels needed by any plot, each once.
fn channel_names(plots: &[Plot], x: Option<&str>) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    let drawn = plots.iter().flat_map(|plot| &plot.entries).map(|e| e.channel.as_str());
    for name in drawn.chain(x) {
        if names.iter().all(|n| n != name) {
            names.push(name.to_owned());
        }
    }
    names
}

fn run_curves(request: &Request<'_>, names: &[String], notes: &mut Vec<String>) -> Result<Vec<RunCurves>, Failure> {
    if let Some(x) = request.x {
        for run in request.runs {
            choose(&run.model, &[x.to_owned()])?;
        }
    }
    let mut curves = Vec::with_capacity(request.runs.len());
    for (run, label) in request.runs.iter().zip(labels(request.runs)) {
        let mut channels = Vec::with_capacity(names.len());
        for name in names {
            match find(&run.model, name) {
                Ok(channel) => channels.push(channel),
                Err(_) => notes.push(format!("{} has no channel {name}", run.path.display())),
            }
        }
        let histories = request.axes.turned(load(run, channels, request.treatment)?);
        notes.extend(histories.notes.iter().cloned());
        curves.push(RunCurves { label, histories });
    }
    Ok(curves)
}

/// Names of runs in legends: file names, with as much of the path as distinguishes them.
fn labels(runs: &[Results]) -> Vec<String> {
    if runs.len() == 1 {
        return vec![String::new()];
    }
    let stem = |r: &Results| r.path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let label = |(i, run): (usize, &Results)| {
        if runs.iter().filter(|r| stem(r) == stem(run)).count() == 1 {
            return stem(run);
        }
        let path = run.path.display().to_string();
        match runs.iter().filter(|r| r.path == run.path).count() {
            1 => path,
            _ => format!("{path} ({})", i + 1),
        }
    };
    runs.iter().enumerate().map(label).collect()
}

fn overlays(request: &Request<'_>, names: &[String], notes: &mut Vec<String>) -> Result<Vec<Overlay>, Failure> {
    let known = |n: &String| request.runs.iter().find_map(|r| Some((&r.model, find(&r.model, n).ok()?)));
    let (models, known): (Vec<_>, Vec<Channel>) = names.iter().filter_map(known).unzip();
    let wanted: Vec<Wanted> = models.into_iter().zip(&known).map(|(model, own)| Wanted::of(model, own)).collect();
    let mut overlays = Vec::new();
    for path in request.tests {
        let recording = measured::read(path)?;
        notes.extend(recording.notes.iter().cloned());
        let belonging = pairs(&recording, &wanted, request.map, request.seat, notes)?;
        if belonging.is_empty() {
            return Err(Failure::with_help(
                format!("no signal of {} matches a plotted channel", path.display()),
                "assign columns to channels: --map 'column[unit]=head.acceleration.x'",
            ));
        }
        for mut pair in belonging {
            let channel = wanted[pair.channel].name.clone();
            if let Some(class) = request.treatment.filter.class_of(&channel) {
                pair.filter(class, request.treatment.family)?;
            }
            pair.time_s.iter_mut().for_each(|t| *t += request.shift_s);
            let sign = request.axes.of(&known[pair.channel]).1;
            pair.values.iter_mut().for_each(|value| *value *= sign);
            overlays.push(Overlay { channel, file: file_name(path), pair });
        }
    }
    Ok(overlays)
}
