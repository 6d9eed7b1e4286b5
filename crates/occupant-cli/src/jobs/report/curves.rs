//! The time histories of the page, taken from the channels of the run.

use occupant_core::model::Model;
use occupant_core::model::setup::STANDARD_GRAVITY_M_S2;
use occupant_core::results::channel::{Channel, Series, channels};
use serde::Serialize;

use super::array::Array;

/// Spheres with the greatest contact forces that are plotted.
const MOST_SPHERES: usize = 8;

#[derive(Debug, Serialize)]
pub(crate) struct Plot {
    title: &'static str,
    unit: &'static str,
    curves: Vec<Curve>,
}

#[derive(Debug, Serialize)]
struct Curve {
    name: String,
    meaning: String,
    values: Array,
}

/// What a plot shows: channels by name, `*` for anything, with the label of the curve; `*` there is what the star stood for.
struct Recipe {
    title: &'static str,
    unit: &'static str,
    per_si: f64,
    channels: &'static [(&'static str, &'static str)],
}

const RECIPES: [Recipe; 9] = [
    Recipe {
        title: "Resultant acceleration",
        unit: "g",
        per_si: 1.0 / STANDARD_GRAVITY_M_S2,
        channels: &[
            ("head.acceleration.resultant", "head"),
            ("upper_torso.acceleration.resultant", "chest"),
            ("lower_torso.acceleration.resultant", "pelvis"),
        ],
    },
    Recipe { title: "Belt force", unit: "kN", per_si: 1e-3, channels: &[("belt.*.force", "*")] },
    Recipe { title: CONTACTS, unit: "kN", per_si: 1e-3, channels: &[("sphere.*.force.resultant", "*")] },
    Recipe {
        title: "Neck force on the head",
        unit: "kN",
        per_si: 1e-3,
        channels: &[("neck.force.x", "shear x"), ("neck.force.y", "shear y"), ("neck.force.z", "axial z")],
    },
    Recipe {
        title: "Neck moment on the head",
        unit: "N·m",
        per_si: 1.0,
        channels: &[("neck.moment.x", "x"), ("neck.moment.y", "y, + flexion"), ("neck.moment.z", "z")],
    },
    Recipe {
        title: "Femur axial force",
        unit: "kN",
        per_si: 1e-3,
        channels: &[("left_femur.axial", "left"), ("right_femur.axial", "right")],
    },
    Recipe {
        title: "Vehicle acceleration",
        unit: "g",
        per_si: 1.0 / STANDARD_GRAVITY_M_S2,
        channels: &[("vehicle.acceleration.x", "x"), ("vehicle.acceleration.y", "y"), ("vehicle.acceleration.z", "z")],
    },
    Recipe {
        title: "Energy",
        unit: "kJ",
        per_si: 1e-3,
        channels: &[
            ("energy.kinetic_relative", "kinetic, in the vehicle"),
            ("energy.contacts", "stored in contacts"),
            ("energy.belts", "stored in belts"),
            ("energy.lost_contacts", "lost in contacts"),
            ("energy.lost_friction", "lost in friction"),
            ("energy.lost_joints", "lost in joints"),
            ("energy.lost_belts", "lost in belts"),
        ],
    },
    Recipe { title: "Energy balance error", unit: "J", per_si: 1.0, channels: &[("energy.balance", "imbalance")] },
];
const CONTACTS: &str = "Contact force";

/// A recorder of all channels that the plots need.
pub(crate) fn series(model: &Model) -> Series {
    let needed = |c: &Channel| {
        let mut all = RECIPES.iter().flat_map(|r| r.channels);
        all.any(|(pattern, _)| star(pattern, &c.name).is_some())
    };
    Series::new(channels(model).into_iter().filter(needed).collect())
}

/// The plots, without those that would be empty.
pub(crate) fn plots(series: &Series) -> Vec<Plot> {
    let plots =
        RECIPES.iter().map(|recipe| Plot { title: recipe.title, unit: recipe.unit, curves: curves(recipe, series) });
    plots.filter(|p| !p.curves.is_empty()).collect()
}

fn curves(recipe: &Recipe, series: &Series) -> Vec<Curve> {
    let mut found = Vec::new();
    for (pattern, label) in recipe.channels {
        for (channel, values) in series.channels.iter().zip(&series.values) {
            if let Some(stood_for) = star(pattern, &channel.name) {
                let name = label.replace('*', &stood_for.replace('_', " "));
                found.push((name, channel, values));
            }
        }
    }
    if recipe.title == CONTACTS {
        keep_greatest(&mut found);
    }
    let curve = |(name, channel, values): (String, &Channel, &Vec<f64>)| Curve {
        name,
        meaning: format!("{}: {}", channel.name, channel.meaning),
        values: Array::float32(values.iter().map(|v| v * recipe.per_si)),
    };
    found.into_iter().map(curve).collect()
}

/// Leaves the spheres with the greatest forces, none that touched nothing, in the list's order.
fn keep_greatest(found: &mut Vec<(String, &Channel, &Vec<f64>)>) {
    let peak = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let mut peaks: Vec<f64> = found.iter().map(|f| peak(f.2)).collect();
    peaks.sort_by(|a, b| b.total_cmp(a));
    let least = peaks.get(MOST_SPHERES - 1).copied().unwrap_or(0.0);
    found.retain(|f| peak(f.2) > 0.0 && peak(f.2) >= least);
}

/// What the star of a pattern with at most one stands for in a name; empty without a star.
fn star(pattern: &str, name: &str) -> Option<String> {
    match pattern.split_once('*') {
        None => (pattern == name).then(String::new),
        Some((before, after)) => {
            let middle = name.strip_prefix(before)?.strip_suffix(after)?;
            (!middle.is_empty()).then(|| middle.to_owned())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_star_is_one_name() {
        let found = star("sphere.*.force.resultant", "sphere.left_knee.force.resultant");
        assert_eq!(found.as_deref(), Some("left_knee"));
        assert_eq!(star("belt.*.force", "belt.lap.elongation"), None);
        assert_eq!(star("a", "a").as_deref(), Some(""));
    }
}
