//! The channels of a record as pictures: accelerations with their 50 ms averages, rates, velocity changes, angles, the severity index.

use crash_measures::measure::{AsiEdition, asi};
use crash_measures::signal::{STANDARD_GRAVITY_MPS2 as G, integrate, moving_average};
use occupant_study::risk::{AXES, VehicleSignals};

use super::Report;
use occupant_pictures::plot::{Axis, Curve, Figure, Style};

/// Largest number of points of a curve; beyond it, the least and largest of each part are drawn.
const POINTS: usize = 1200;

/// All plots that the channels allow.
pub(super) fn plots(report: &Report) -> Vec<Figure> {
    let signals = &report.signals;
    let mut plots: Vec<Figure> = (0..3).filter_map(|axis| acceleration(signals, axis)).collect();
    plots.extend(several(signals, "Velocity change", "velocity", "m/s", |channels, axis| {
        integrate(channels[axis].as_ref()?, signals.dt_s, 0.0).ok()
    }));
    plots.extend(several(signals, "Rates", "rate", "deg/s", |channels, axis| {
        Some(channels[3 + axis].as_ref()?.iter().map(|rate| rate.to_degrees()).collect())
    }));
    let angles = &report.risk.angles.histories;
    let angle = |axis: usize| Some(angles[axis].as_ref().ok()?.iter().map(|angle| angle.to_degrees()).collect());
    let names = ["roll", "pitch", "yaw"];
    plots.extend(figure(
        signals,
        "Angles",
        "angle",
        "deg",
        (0..3).filter_map(|i| Some((names[i].to_owned(), 0.0, angle(i)?))),
    ));
    plots.extend(severity(signals));
    plots
}

fn acceleration(signals: &VehicleSignals, axis: usize) -> Option<Figure> {
    let own: Vec<f64> = signals.channels[axis].as_ref()?.iter().map(|a| a / G).collect();
    let average = moving_average(&own, signals.dt_s, 0.05).ok();
    let curves = [Some(("filtered".to_owned(), 0.0, own)), average.map(|a| ("50 ms average".to_owned(), 0.025, a))];
    let title = format!("Acceleration {} of the centre of gravity", AXES[axis]);
    figure(signals, &title, "acceleration", "g", curves.into_iter().flatten())
}

/// One curve per axis.
fn several(
    signals: &VehicleSignals,
    title: &str,
    name: &str,
    unit: &str,
    of: impl Fn(&[Option<Vec<f64>>; 6], usize) -> Option<Vec<f64>>,
) -> Option<Figure> {
    let curves = (0..3).filter_map(|axis| Some((AXES[axis].to_owned(), 0.0, of(&signals.channels, axis)?)));
    figure(signals, title, name, unit, curves)
}

fn severity(signals: &VehicleSignals) -> Option<Figure> {
    let [Some(x), Some(y), Some(z), ..] = &signals.channels else { return None };
    let history = |edition, name: &str, shift_s| {
        Some((format!("EN 1317-1:{name}"), shift_s, asi(x, y, z, signals.dt_s, edition).ok()?.history))
    };
    let curves = [history(AsiEdition::Edition2010, "2010", 0.0), history(AsiEdition::Edition1998, "1998", 0.025)];
    figure(signals, "Acceleration severity index", "ASI", "", curves.into_iter().flatten())
}

/// A plot of curves, each with name, delay relative to the record, s, and values; none without curves.
fn figure(
    signals: &VehicleSignals,
    title: &str,
    name: &str,
    unit: &str,
    curves: impl IntoIterator<Item = (String, f64, Vec<f64>)>,
) -> Option<Figure> {
    let curve = |(i, (label, later_s, values)): (usize, (String, f64, Vec<f64>))| {
        let time = |i: usize| signals.start_s + later_s + i as f64 * signals.dt_s;
        Curve::new(label, Style::of(i, 0), thinned(&values).into_iter().map(|i| [time(i), values[i]]).collect())
    };
    let curves: Vec<Curve> = curves.into_iter().enumerate().map(curve).collect();
    (!curves.is_empty()).then(|| Figure {
        title: title.to_owned(),
        x: Axis::of("time", "s"),
        y: Axis::of(name, unit),
        curves,
        limits: Vec::new(),
        empty: String::new(),
    })
}

/// Indices of the samples to draw: all, or the least and largest of each part.
fn thinned(values: &[f64]) -> Vec<usize> {
    if values.len() <= POINTS {
        return (0..values.len()).collect();
    }
    let part = (2 * values.len()).div_ceil(POINTS);
    let ends = |from: usize| {
        let all = from..(from + part).min(values.len());
        let least = all.clone().min_by(|&a, &b| values[a].total_cmp(&values[b])).unwrap_or(from);
        let most = all.max_by(|&a, &b| values[a].total_cmp(&values[b])).unwrap_or(from);
        let mut ends = vec![least.min(most), least.max(most)];
        ends.dedup();
        ends
    };
    (0..values.len()).step_by(part).flat_map(ends).collect()
}
