//! Which figures of the runs a report is about.

use occupant_core::problem::nearest;

use super::gather::Gathered;
use super::samples::varies;
use crate::base::failure::Failure;
use crate::files::study_folder::manifest::{Column, Manifest, Role};
use crate::jobs::ensemble::judge::is_result;

/// What is looked at unless figures are asked for; `*` stands for one word.
const CUSTOMARY: [&str; 11] = [
    "hic15",
    "head.peak",
    "head.three_ms_cumulative",
    "chest.peak",
    "chest.three_ms_cumulative",
    "pelvis.peak",
    "belts.*.peak",
    "head_excursion.forward",
    "nij",
    "right_femur",
    "left_femur",
];
/// At most so many of them.
const MOST: usize = 8;

/// The columns of the figures that are asked for, or of all customary ones.
///
/// # Errors
/// A name or pattern that fits no figure.
pub(crate) fn candidates(manifest: &Manifest, names: &[String]) -> Result<Vec<usize>, Failure> {
    let columns = &manifest.columns;
    let fitting = |pattern: &str| -> Vec<usize> {
        let is_it = |c: &Column| c.role == Role::Figure && fits(pattern, &c.name);
        (0..columns.len()).filter(|i| is_it(&columns[*i])).collect()
    };
    if names.is_empty() {
        return Ok(CUSTOMARY.iter().flat_map(|name| fitting(name)).collect());
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
            format!("the figures are {}", results.collect::<Vec<_>>().join(", "))
        }
    };
    Failure::with_help(format!("--to: no figure is named `{name}`"), &help)
}

/// Whether a name fits a pattern with at most one `*`.
fn fits(pattern: &str, name: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == name,
        Some((before, after)) => {
            let rest = name.strip_prefix(before);
            rest.and_then(|r| r.strip_suffix(after)).is_some_and(|middle| !middle.is_empty())
        }
    }
}

/// Of the customary figures leaves the first that vary, or the first of all where none does.
pub(crate) fn keep_telling(gathered: &mut Gathered) {
    let responses = &gathered.samples.responses;
    let mut kept: Vec<usize> = (0..responses.len()).filter(|i| varies(&responses[*i].values)).take(MOST).collect();
    if kept.is_empty() {
        kept.extend((!responses.is_empty()).then_some(0));
    }
    keep(&mut gathered.samples.responses, &kept);
    keep(&mut gathered.extremes, &kept);
}

/// Leaves the items at these places.
fn keep<T>(list: &mut Vec<T>, places: &[usize]) {
    let mut place = 0..;
    list.retain(|_| place.next().is_some_and(|at: usize| places.contains(&at)));
}

#[cfg(test)]
mod tests {
    use super::fits;

    #[test]
    fn a_star_is_some_word() {
        assert!(fits("belts.*.peak", "belts.lap.peak"));
        assert!(!fits("belts.*.peak", "belts.lap.peak_time"));
        assert!(!fits("belts.*.peak", "belts..peak"));
        assert!(fits("hic15", "hic15") && !fits("hic15", "hic1"));
    }
}
