//! Figures from runs, measured signals and limits.

use std::str::FromStr;

use occupant_core::results::channel::Channel;
use occupant_units::unit::{Shown, Unit};

use super::figure::{Axis, Curve, Figure, Limit, Style};
use super::standard::{Entry, Plot};
use occupant_files::history::{Column, Histories, UnitChoice, plotted};
use occupant_files::measured::Pair;
use occupant_files::signals::scale_of;

/// The histories of one run with its name in legends.
#[derive(Clone, Debug)]
pub struct RunCurves {
    /// Name; empty if the run is alone.
    pub label: String,
    /// Its histories.
    pub histories: Histories,
}

/// A measured signal drawn over a channel.
#[derive(Clone, Debug)]
pub struct Overlay {
    /// The channel.
    pub channel: String,
    /// Name of the file.
    pub file: String,
    /// The signal.
    pub pair: Pair,
}

/// `channel=value unit`: a level drawn in the plot of a channel.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitArgument {
    /// The channel.
    pub channel: String,
    /// Level as written.
    pub text: String,
    value: f64,
    unit: Option<String>,
}

impl FromStr for LimitArgument {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let expected = "expected CHANNEL=LEVEL, such as 'head.acceleration.resultant=80 g'";
        let (channel, level) = text.split_once('=').ok_or(expected)?;
        let level = level.trim();
        let places = (0..=level.len()).rev().filter(|at| level.is_char_boundary(*at));
        // the longest beginning that is a number, so that an exponent belongs to it
        let split = places.map(|at| level.split_at(at)).find_map(|(number, unit)| {
            let number = number.trim_end().parse::<f64>().ok().filter(|x| x.is_finite())?;
            Some((number, unit.trim()))
        });
        let (value, unit) = split.ok_or(expected)?;
        let unit = (!unit.is_empty()).then(|| unit.to_owned());
        if let Some(wrong) = unit.as_ref().filter(|unit| scale_of(unit).is_none()) {
            return Err(format!("`{wrong}` is not a unit; {expected}"));
        }
        Ok(LimitArgument { channel: channel.trim().to_owned(), text: level.to_owned(), value, unit })
    }
}

impl LimitArgument {
    /// The level in a displayed unit.
    ///
    /// # Errors
    /// A unit of another kind.
    fn level(&self, unit: Unit, shown: Shown) -> Result<f64, String> {
        let Some(written) = &self.unit else {
            return Ok(self.value);
        };
        match scale_of(written) {
            Some(scale) if scale.dimension == unit.dimension() => Ok(self.value * scale.factor / shown.si),
            _ => Err(format!(
                "--limit {}={}: `{written}` is not a unit of this channel, which is in {}",
                self.channel,
                self.text,
                shown.symbol()
            )),
        }
    }
}

/// Data of the figures.
#[derive(Clone, Debug)]
pub struct Material<'a> {
    /// Runs, at least one.
    pub runs: &'a [RunCurves],
    /// Measured signals.
    pub overlays: &'a [Overlay],
    /// Limits to be drawn.
    pub limits: &'a [LimitArgument],
    /// Channel on the horizontal axis; time if absent.
    pub x: Option<&'a str>,
    /// Units.
    pub units: UnitChoice,
    /// First and last time drawn, s.
    pub window_s: [f64; 2],
}

/// The figure of a plot.
///
/// # Errors
/// Channels of different units, a limit in another unit, more curves than can be distinguished.
pub fn figure(plot: &Plot, material: &Material<'_>) -> Result<Figure, String> {
    let unit = common_unit(plot, material.runs)?;
    let shown = plotted(unit, material.units);
    let mut curves = Vec::new();
    for (r, run) in material.runs.iter().enumerate() {
        for (e, entry) in plot.entries.iter().enumerate() {
            let Some(column) = column(&run.histories, &entry.channel) else {
                continue;
            };
            // a colour for each run and a dash for each channel, as long as there are enough
            let style = match (material.runs.len(), plot.entries.len()) {
                (1, _) => Style::of(e, 0),
                (runs, channels) if runs <= Style::COLOURS && channels <= Style::DASHES => Style::of(r, e),
                _ => Style::of(curves.len(), 0),
            };
            let points = points(run, column, shown, material);
            curves.push(Curve::new(label(entry, run, plot, material), style, points));
        }
    }
    if curves.len() > Style::DISTINCT {
        return Err(format!(
            "{} curves in the plot {}: at most {} can be distinguished",
            curves.len(),
            plot.title,
            Style::DISTINCT
        ));
    }
    for (e, entry) in plot.entries.iter().enumerate() {
        let measured = material.overlays.iter().filter(|o| o.channel == entry.channel);
        curves.extend(measured.map(|o| overlay(o, entry, e, plot, shown, material)));
    }
    let limits = material.limits.iter().filter(|limit| plot.entries.iter().any(|e| e.channel == limit.channel));
    let limits = limits.map(|limit| {
        let label = match plot.entries.len() {
            1 => format!("limit {}", limit.text),
            _ => format!("limit of {}: {}", limit.channel, limit.text),
        };
        Ok(Limit { label, level: limit.level(unit, shown)? })
    });
    let axes = [x_axis(material), Axis::of(&plot.axis, shown.symbol())];
    let limits = limits.collect::<Result<_, String>>()?;
    Ok(Figure { limits, empty: plot.empty.clone(), ..Figure::new(&plot.title, axes, curves) })
}

fn column<'a>(histories: &'a Histories, channel: &str) -> Option<&'a Column> {
    histories.columns.iter().find(|c| c.channel.name == channel)
}

fn channel_of<'a>(runs: &'a [RunCurves], name: &str) -> Option<&'a Channel> {
    runs.iter().find_map(|r| column(&r.histories, name)).map(|c| &c.channel)
}

fn common_unit(plot: &Plot, runs: &[RunCurves]) -> Result<Unit, String> {
    let mut channels = plot.entries.iter().filter_map(|entry| channel_of(runs, &entry.channel));
    let Some(first) = channels.next() else {
        return Ok(Unit::One);
    };
    match channels.find(|other| other.unit != first.unit) {
        None => Ok(first.unit),
        Some(other) => Err(format!(
            "{} is in {}, but {} in {}: one plot has one axis",
            first.name,
            first.unit.symbol(),
            other.name,
            other.unit.symbol()
        )),
    }
}

/// Label that distinguishes this curve from the others of its figure.
fn label(entry: &Entry, run: &RunCurves, plot: &Plot, material: &Material<'_>) -> String {
    let measured = material.overlays.iter().any(|o| plot.entries.iter().any(|e| e.channel == o.channel));
    match (run.label.as_str(), plot.entries.len()) {
        ("", 1) if measured => "run".to_owned(),
        ("", 1) => String::new(),
        ("", _) => entry.label.clone(),
        (run, 1) => run.to_owned(),
        (run, _) => format!("{} · {run}", entry.label),
    }
}

fn in_window(time_s: f64, [from, to]: [f64; 2]) -> bool {
    time_s >= from - 1e-9 && time_s <= to + 1e-9
}

fn points(run: &RunCurves, column: &Column, shown: Shown, material: &Material<'_>) -> Vec<[f64; 2]> {
    let time_s = &run.histories.time_s;
    let across: Vec<f64> = match material.x.map(|x| self::column(&run.histories, x)) {
        None => time_s.iter().map(|t| t * 1e3).collect(),
        Some(Some(x)) => {
            let size = plotted(x.channel.unit, material.units).si;
            x.values.iter().map(|v| v / size).collect()
        }
        Some(None) => Vec::new(),
    };
    let inside = |t: &f64| in_window(*t, material.window_s);
    let both = across.iter().zip(&column.values).zip(time_s);
    both.filter(|(_, t)| inside(t)).map(|((x, y), _)| [*x, y / shown.si]).collect()
}

fn overlay(overlay: &Overlay, entry: &Entry, dash: usize, plot: &Plot, shown: Shown, material: &Material<'_>) -> Curve {
    let pair = &overlay.pair;
    let label = match plot.entries.len() {
        1 => format!("test: {} ({})", pair.signal, overlay.file),
        _ => format!("test: {}, {} ({})", entry.label, pair.signal, overlay.file),
    };
    let inside = pair.time_s.iter().zip(&pair.values).filter(|(t, _)| in_window(**t, material.window_s));
    Curve::new(label, Style::measured(dash), inside.map(|(t, v)| [t * 1e3, v / shown.si]).collect())
}

fn x_axis(material: &Material<'_>) -> Axis {
    let across = material.x.and_then(|x| channel_of(material.runs, x));
    match across {
        Some(channel) => Axis::of(&channel.name, plotted(channel.unit, material.units).symbol()),
        None => Axis::of("time", "ms"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_read_with_their_units() {
        let limit: LimitArgument = "head.acceleration.resultant = 80 g".parse().unwrap();
        let acceleration = Unit::MetrePerSecondSquared;
        let si = plotted(acceleration, UnitChoice::Si);
        assert!((limit.level(acceleration, si).unwrap() - 784.532).abs() < 1e-9);
        assert!(limit.level(Unit::Newton, plotted(Unit::Newton, UnitChoice::Si)).is_err());
        let plain: LimitArgument = "neck.force.z=-1.5e3".parse().unwrap();
        assert_eq!(plain.level(Unit::Newton, plotted(Unit::Newton, UnitChoice::Si)), Ok(-1500.0));
        assert_eq!("a=4 kN".parse::<LimitArgument>().map(|l| l.value), Ok(4.0));
        assert!("a".parse::<LimitArgument>().is_err() && "a=b".parse::<LimitArgument>().is_err());
        assert!("a=3 furlong".parse::<LimitArgument>().is_err());
    }
}
