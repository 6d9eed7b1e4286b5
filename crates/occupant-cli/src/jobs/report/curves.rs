//! The time histories of the page, taken from the channels of the run.

use crate::base::customary::*;
use occupant_core::model::Model;
use occupant_core::results::channel::{Channel, Series, channels, star};
use serde::Serialize;

use crate::base::Units;

use super::array::Array;

/// Spheres with the greatest contact forces that are plotted.
const MOST_SPHERES: usize = 8;

#[derive(Debug, Serialize)]
pub(crate) struct Plot {
    title: &'static str,
    unit: String,
    curves: Vec<Curve>,
}

#[derive(Debug, Serialize)]
struct Curve {
    name: String,
    meaning: String,
    values: Array,
}

/// A plot: its title, the unit that its channels are shown in, and its channels.
const RECIPES: [(&str, &str, &Curves); 9] = [
    ("Resultant acceleration", "g", ACCELERATIONS),
    ("Belt force", "kN", WEBBING),
    (CONTACT_FORCE, "kN", CONTACTS),
    ("Neck force on the head", "kN", NECK_FORCE),
    ("Neck moment on the head", "N·m", NECK_MOMENT),
    ("Femur axial force", "kN", FEMURS),
    ("Vehicle acceleration", "g", VEHICLE),
    // all but the last, the springs of the spine
    ("Energy", "kJ", ENERGIES.split_at(7).0),
    ("Energy balance error", "J", BALANCE),
];
const CONTACT_FORCE: &str = "Contact force";

/// A recorder of all channels that the plots need.
pub(crate) fn series(model: &Model) -> Series {
    let needed = |c: &Channel| {
        let mut all = RECIPES.iter().flat_map(|(_, _, curves)| *curves);
        all.any(|(pattern, _)| star(pattern, &c.name).is_some())
    };
    Series::new(channels(model).into_iter().filter(needed).collect())
}

/// The plots, without those that would be empty.
pub(crate) fn plots(series: &Series, units: Units) -> Vec<Plot> {
    let plots = RECIPES.into_iter().map(|(title, unit, wanted)| {
        let mut found = find(wanted, series);
        if title == CONTACT_FORCE {
            keep_greatest(&mut found);
        }
        let (per, shown) = units.over(unit);
        Plot { title, unit: shown, curves: found.into_iter().map(|f| curve(f, unit, per)).collect() }
    });
    plots.filter(|p| !p.curves.is_empty()).collect()
}

/// A curve under construction: its name, channel and values.
type Found<'a> = (String, &'a Channel, &'a Vec<f64>);

fn find<'a>(wanted: &Curves, series: &'a Series) -> Vec<Found<'a>> {
    let mut found = Vec::new();
    for (pattern, label) in wanted {
        for (channel, values) in series.channels.iter().zip(&series.values) {
            if let Some(stood_for) = star(pattern, &channel.name) {
                let name = label.replace('*', &stood_for.replace('_', " "));
                found.push((name, channel, values));
            }
        }
    }
    found
}

/// The curve in a unit of which so many are one of what is shown.
fn curve((name, channel, values): Found<'_>, unit: &'static str, per: f64) -> Curve {
    let per_si = channel.unit.shown_in(unit).per_si() / per;
    let mut shown = Array::default();
    shown.float32(values.iter().map(|v| v * per_si));
    Curve { name, meaning: format!("{}: {}", channel.name, channel.meaning), values: shown }
}

/// Leaves the spheres with the greatest forces, none that touched nothing, in the list's order.
fn keep_greatest(found: &mut Vec<Found<'_>>) {
    let peak = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let mut peaks: Vec<f64> = found.iter().map(|f| peak(f.2)).collect();
    peaks.sort_by(|a, b| b.total_cmp(a));
    let least = peaks.get(MOST_SPHERES - 1).copied().unwrap_or(0.0);
    found.retain(|f| peak(f.2) > 0.0 && peak(f.2) >= least);
}
