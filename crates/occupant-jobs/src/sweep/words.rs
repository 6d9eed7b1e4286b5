//! Result message of a sweep.

use std::path::PathBuf;

use super::{Census, Ensembles, Results};
use crate::base::text_table::Align::{Left, Right};
use crate::base::text_table::{Table, facts};
use crate::base::{Done, Units, say};
use crate::ensemble::text::{figure_table, is_shown, ranged};
use crate::files::study_folder::Held;
use occupant_study::{Design, Study};

/// Warns about a file system without locks; `doing` is the work that two processes could do at once.
pub fn warn_unlocked(held: &Held, doing: &str, quiet: bool) {
    if let (Some(reason), false) = (&held.unlocked, quiet) {
        say(&format!("warning: this file system has no locks ({reason}): make sure that no two processes are {doing}"));
    }
}

/// Reports damaged files of a folder, even for a quiet command.
pub fn tell_damaged(files: &[PathBuf]) {
    for file in files {
        say(&format!("damaged: {} was changed after it was written; it is made again", file.display()));
    }
}

/// Reports the results.
pub fn tell(results: &Results, work: Option<String>, next: &str, units: Units) -> String {
    let census = &results.census;
    let mut lines = vec![("samples", ended(census))];
    lines.extend(census.first.iter().map(|(index, reason)| ("", format!("{index}: {reason}"))));
    if census.doubtful > 0 {
        let found = "samples with an energy balance off by more than 10 %: their results mean nothing";
        lines.push(("doubtful", format!("{} {found}", census.doubtful)));
    }
    lines.extend(census.caveats().map(|caveat| ("caveat", caveat)));
    lines.extend(work.map(|work| ("computed", work)));
    let names: Vec<String> = results.files.iter().map(|f| f.display().to_string()).collect();
    lines.push(("written", names.join(", ")));
    lines.push(("next", next.to_owned()));
    let stable = results.ensembles.as_ref().map(|e| format!("\n{}", stable(e, units)));
    let ranges = if census.completed > 1 { format!("\n{}", ranges(results, units)) } else { String::new() };
    facts(&lines) + &ranges + &stable.unwrap_or_default()
}

/// Errors of Sobol' indices that are small enough to rank parameters.
const GOOD: f64 = 0.1;

/// Before a study for Sobol' indices runs: how far off its indices will be; none for other designs. The half width of a 95 % interval
/// is about 2/√N for N points: the products that an index is the mean of vary about as much as the measure.
pub fn indices(study: &Study) -> Option<String> {
    let Design::Saltelli { samples, .. } = &study.design else { return None };
    let off = (2.0 / (*samples as f64).sqrt()).min(1.0);
    let found = format!("Sobol' indices of {samples} points will be off by up to about {off:.2}");
    let needed = ((2.0 / GOOD) * (2.0 / GOOD)).ceil() as u64;
    let needed = needed.next_power_of_two();
    let runs = study.samples() / (*samples).max(1) * needed * study.members();
    Some(if off > GOOD { format!("{found}; for {GOOD} give {needed} points, {runs} runs") } else { found })
}

/// How samples ended: "29 completed, 1 failed".
pub fn ended(census: &Census) -> String {
    let all = [(census.failed, "failed"), (census.refused, "refused"), (census.broken, "on which the program stopped")];
    let left_out = Some((census.excluded, "excluded by constraints"));
    let rest =
        all.iter().chain(&left_out).filter(|(count, _)| *count > 0).map(|(count, word)| format!(", {count} {word}"));
    format!("{} completed{}", census.completed, rest.collect::<String>())
}

/// Whether a study came to anything: one without a single figure that counts did not, which is said.
pub fn judged(census: &Census) -> Done {
    if census.begun() == 0 || census.without_figures() < census.begun() {
        return Done::Well;
    }
    let why = census.first.first().map_or(String::new(), |(index, reason)| format!("; sample {index}: {reason}"));
    let all = if census.refused == census.begun() { "every sample is invalid" } else { "no sample has valid results" };
    say(&format!("error: {all}{why}\n = help: `occupant sweep STUDY --dry-run` tries the corners of the study"));
    Done::Unwell
}

/// Range of each figure, with its samples.
fn ranges(results: &Results, units: Units) -> String {
    let mut table =
        Table::new(&[(Left, &["figure"]), (Right, &["least", "in sample", "greatest", "in sample"]), (Left, &[""])]);
    for (name, unit, range) in &results.ranges {
        if let (Some((least, first)), Some((greatest, last))) = (range.best.first(), range.worst.first()) {
            let ([least, greatest], unit) = ranged([*least, *greatest], unit, units);
            table.row([name.clone(), least, first.to_string(), greatest, last.to_string(), unit]);
        }
    }
    table.text()
}

/// Report on the ensembles of a study.
fn stable(ensembles: &Ensembles, units: Units) -> String {
    let failed = match ensembles.failed {
        0 => String::new(),
        n => format!("; {n} runs did not complete, and no result of their samples counts as stable"),
    };
    let samples = match ensembles.samples {
        1 => "1 sample".to_owned(),
        n => format!("{n} samples"),
    };
    let lines = [("ensembles", format!("{samples}{failed}"))];
    let table = match ensembles.samples {
        0 | 1 => figure_table(&ensembles.first, units),
        _ => all_samples(ensembles),
    };
    format!("{}\n{table}", facts(&lines))
}

fn all_samples(ensembles: &Ensembles) -> String {
    let mut table =
        Table::new(&[(Left, &["figure"]), (Right, &["stable in", "NOT STABLE in", "too few runs in", "absent in"])]);
    for figure in ensembles.figures.iter().filter(|f| is_shown(&f.name)) {
        let counts = [figure.stable, figure.unstable, figure.too_few, figure.absent];
        table.row(std::iter::once(figure.name.clone()).chain(counts.map(|n| n.to_string())));
    }
    table.text()
}
