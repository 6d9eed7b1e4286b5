//! The time histories of the page, taken from the channels of the run.

use std::collections::HashSet;

use crate::base::customary::*;
use occupant_core::model::Model;
use occupant_core::results::channel::{Channel, Series, channels, star};
use serde::Serialize;

use crate::base::Units;

use super::array::Array;

/// Largest number of spheres whose contact forces are plotted.
const MOST_SPHERES: usize = 8;

/// A plot.
#[derive(Debug, Serialize)]
pub struct Plot {
    title: String,
    unit: String,
    /// The occupant, of several.
    occupant: Option<String>,
    curves: Vec<Curve>,
}

#[derive(Debug, Serialize)]
struct Curve {
    name: String,
    meaning: String,
    values: Array,
}

/// A plot: title, display unit, and channels.
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
/// Titles of plots with each occupant's own channels; with several occupants, names are prefixed.
const OWN: [&str; 4] = [RECIPES[0].0, RECIPES[3].0, RECIPES[4].0, RECIPES[5].0];

/// A recorder of all channels needed by the plots, and of the chosen ones.
pub fn series(model: &Model, chosen: &[Channel]) -> Series {
    let needed = |c: &Channel| {
        let after = c.name.split_once('.').map_or("", |(_, after)| after);
        RECIPES.iter().any(|(title, _, curves)| {
            let is_in = |name: &str| curves.iter().any(|(pattern, _)| star(pattern, name).is_some());
            is_in(&c.name) || OWN.contains(title) && is_in(after)
        })
    };
    let is_chosen = |c: &Channel| chosen.iter().any(|one| one.name == c.name);
    Series::new(channels(model).into_iter().filter(|c| is_chosen(c) || needed(c)).collect())
}

/// Plots of the chosen channels, one for each unit.
pub fn own_plots(series: &Series, chosen: &[Channel], units: Units) -> Vec<Plot> {
    let mut kinds: Vec<&'static str> = chosen.iter().map(|c| c.unit.symbol()).collect();
    let mut seen = HashSet::new();
    kinds.retain(|unit| seen.insert(*unit));
    let found = |c: &&Channel| series.channels.iter().position(|own| own.name == c.name);
    let plot = |unit: &'static str| {
        let (per, shown) = units.over(unit);
        let own = chosen.iter().filter(|c| c.unit.symbol() == unit).filter_map(|c| found(&c));
        let own = own.map(|i| (series.channels[i].name.clone(), &series.channels[i], &series.values[i]));
        let curves: Vec<Curve> = own.map(|found| curve(found, unit, per)).collect();
        Plot { title: titled(&curves), unit: shown, occupant: None, curves }
    };
    kinds.into_iter().map(plot).collect()
}

/// Names of the first curves, and how many more there are.
fn titled(curves: &[Curve]) -> String {
    match curves {
        [one] => one.name.clone(),
        [one, other] => format!("{}, {}", one.name, other.name),
        [one, rest @ ..] => format!("{} and {} more", one.name, rest.len()),
        [] => String::new(),
    }
}

/// The plots, without empty ones. Prefixes are those of each occupant's channels.
pub fn plots(series: &Series, prefixes: &[String], units: Units) -> Vec<Plot> {
    let of_each = |recipe: (&'static str, _, _)| {
        let prefixes = if OWN.contains(&recipe.0) { prefixes } else { &[String::new()] };
        prefixes.iter().map(move |prefix| (recipe, prefix.clone())).collect::<Vec<_>>()
    };
    let plots = RECIPES.into_iter().flat_map(of_each).map(|((title, unit, wanted), prefix)| {
        let mut found = find(wanted, &prefix, series);
        if title == CONTACT_FORCE {
            keep_greatest(&mut found);
        }
        let (per, shown) = units.over(unit);
        let whose = prefix.strip_suffix('.').map_or(String::new(), |name| format!(", {}", name.replace('_', " ")));
        Plot {
            title: format!("{title}{whose}"),
            unit: shown,
            occupant: prefix.strip_suffix('.').map(str::to_owned),
            curves: found.into_iter().map(|f| curve(f, unit, per)).collect(),
        }
    });
    plots.filter(|p| !p.curves.is_empty()).collect()
}

/// A curve under construction: its name, channel and values.
type Found<'a> = (String, &'a Channel, &'a Vec<f64>);

fn find<'a>(wanted: &Curves, prefix: &str, series: &'a Series) -> Vec<Found<'a>> {
    let mut found = Vec::new();
    for (pattern, label) in wanted {
        for (channel, values) in series.channels.iter().zip(&series.values) {
            if let Some(stood_for) = channel.name.strip_prefix(prefix).and_then(|name| star(pattern, name)) {
                let name = label.replace('*', &stood_for.replace('_', " "));
                found.push((name, channel, values));
            }
        }
    }
    found
}

/// The curve, scaled by `per` from `unit`.
fn curve((name, channel, values): Found<'_>, unit: &'static str, per: f64) -> Curve {
    let per_si = channel.unit.shown_in(unit).per_si() / per;
    let mut shown = Array::default();
    shown.float32(values.iter().map(|v| v * per_si));
    Curve { name, meaning: format!("{}: {}", channel.name, channel.meaning), values: shown }
}

/// Keeps the spheres with the largest forces, in the list's order; those without contact are dropped.
fn keep_greatest(found: &mut Vec<Found<'_>>) {
    let peak = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let mut peaks: Vec<f64> = found.iter().map(|f| peak(f.2)).collect();
    peaks.sort_by(|a, b| b.total_cmp(a));
    let least = peaks.get(MOST_SPHERES - 1).copied().unwrap_or(0.0);
    found.retain(|f| peak(f.2) > 0.0 && peak(f.2) >= least);
}
