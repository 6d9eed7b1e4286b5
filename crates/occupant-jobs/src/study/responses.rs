//! Responses of a report: the results that it analyses.

use crate::base::customary::FIGURES;
use occupant_core::results::channel::star;
use placed_text::nearest;

use super::Gathered;
use crate::base::Failure;
use crate::ensemble::judge::is_result;
use crate::files::study_folder::{Column, Manifest, Role};

/// Largest number of default figures.
const MOST: usize = 8;

/// Columns of the requested figures, or of all default ones.
///
/// # Errors
/// A name or pattern that fits no figure.
pub fn candidates(manifest: &Manifest, names: &[String]) -> Result<Vec<usize>, Failure> {
    let columns = &manifest.columns;
    let fitting = |pattern: &str| -> Vec<usize> {
        let is_it = |c: &Column| c.role == Role::Figure && star(pattern, &c.name).is_some();
        (0..columns.len()).filter(|i| is_it(&columns[*i])).collect()
    };
    if names.is_empty() {
        return Ok(FIGURES.iter().flat_map(|name| fitting(name)).collect());
    }
    let mut chosen: Vec<usize> = Vec::new();
    for name in names.iter().flat_map(|n| n.split(',')).map(str::trim) {
        let found = fitting(name);
        if found.is_empty() {
            return Err(unknown(manifest, name));
        }
        let new = found.into_iter().filter(|i| !chosen.contains(i));
        chosen.extend(new.collect::<Vec<_>>());
    }
    Ok(chosen)
}

fn unknown(manifest: &Manifest, name: &str) -> Failure {
    let figures = manifest.columns.iter().filter(|c| c.role == Role::Figure);
    let names: Vec<&str> = figures.map(|c| c.name.as_str()).collect();
    let help = match nearest(name, names.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => {
            let results = names.iter().copied().filter(|n| is_result(n));
            format!("the results are {}", results.collect::<Vec<_>>().join(", "))
        }
    };
    Failure::with_help(format!("--to: there is no result `{name}`"), &help)
}

/// Keeps the first default figures that vary, or the first ones if none does.
pub fn keep_telling(gathered: &mut Gathered) {
    let responses = gathered.samples.responses.len();
    let members = &gathered.members;
    let does = |i: &usize| gathered.values(*i).varies() || members.get(*i).is_some_and(|(_, others)| others.varies());
    let mut kept: Vec<usize> = (0..responses).filter(does).take(MOST).collect();
    if kept.is_empty() {
        kept.extend((responses > 0).then_some(0));
    }
    keep(&mut gathered.samples.responses, &kept);
    keep(&mut gathered.extremes, &kept);
    keep(&mut gathered.spoiled, &kept);
    keep(&mut gathered.members, &kept);
    keep(&mut gathered.figures, &kept);
    gathered.streams.iter_mut().for_each(|streams| keep(&mut streams.responses, &kept));
}

/// Keeps the items at these indices.
fn keep<T>(list: &mut Vec<T>, places: &[usize]) {
    let mut place = 0..;
    list.retain(|_| place.next().is_some_and(|at: usize| places.contains(&at)));
}
