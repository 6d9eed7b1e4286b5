//! `occupant sweep status`.

use std::path::PathBuf;

use crate::base::{Failure, print};
use occupant_jobs::base::text_table::facts;
use occupant_jobs::files::study_folder::finished::ranges_text;
use occupant_jobs::files::study_folder::{Journal, Status};
use occupant_jobs::sweep::Census;
use occupant_jobs::sweep::stored::{MadeBy, Stored, open};
use occupant_jobs::sweep::words::ended;

/// Show how far a sweep is: finished, failed and missing samples, and the time to go
///
/// The sweep may be running. Nothing is written.
#[derive(Debug, clap::Args)]
pub(crate) struct StatusArgs {
    /// The folder of the sweep, or several folders with parts of one sweep, or addresses of object stores
    #[arg(value_name = "FOLDER", required = true)]
    folders: Vec<PathBuf>,

    /// Print all missing samples as FROM-TO, one range per line: `occupant sweep --range` computes one
    #[arg(long)]
    missing: bool,

    /// Print all samples that did not complete, one per line: number, status, reason, parted by tabs
    #[arg(long, conflicts_with = "missing")]
    failed: bool,
}

/// Most ranges of missing samples in the text.
const RANGES: usize = 8;

/// Tells how far a sweep is.
pub(crate) fn status(args: &StatusArgs) -> Result<(), Failure> {
    let Stored { manifest, journal, .. } = open(&args.folders, MadeBy::AnyProgram)?;
    let gaps = journal.finished.gaps(0..manifest.samples);
    if args.missing {
        let lines: Vec<String> = gaps.iter().map(|gap| format!("{}-{}\n", gap.start, gap.end - 1)).collect();
        return print(&lines.concat());
    }
    if args.failed {
        return print(&failed(&journal)?);
    }
    let (census, spent_s) = journal.census()?;
    print(&text(&census, spent_s, &ranges_text(&gaps, RANGES)))
}

/// A line for each sample that did not complete.
fn failed(journal: &Journal) -> Result<String, Failure> {
    let mut lines = String::new();
    journal.each_row(|row| {
        if !matches!(row.status, Status::Completed | Status::Excluded) {
            let reason = row.reason.replace(['\n', '\t'], " ");
            lines += &format!("{}\t{}\t{reason}\n", row.index, row.status.word());
        }
        Ok(())
    })?;
    Ok(lines)
}

fn text(census: &Census, spent_s: f64, missing: &str) -> String {
    let finished = census.finished();
    let to_go = census.planned - finished.min(census.planned);
    let percent = 100.0 * finished as f64 / census.planned.max(1) as f64;
    let mut lines = vec![("finished", format!("{finished} of {} samples, {percent:.1} %", census.planned))];
    if finished > 0 {
        let each_s = spent_s / finished as f64;
        lines.push(("samples", ended(census)));
        lines.extend(census.first.iter().map(|(index, reason)| ("", format!("{index}: {reason}"))));
        lines.extend(census.caveats().map(|caveat| ("caveat", caveat)));
        let rest = if to_go > 0 {
            format!(", about {:.0} s to go on one thread", each_s * to_go as f64)
        } else {
            String::new()
        };
        lines.push(("time", format!("{:.1} ms for each sample{rest}", 1e3 * each_s)));
    }
    if to_go > 0 {
        lines.push(("missing", missing.to_owned()));
        let next = "the same command of `occupant sweep` computes what is missing, with --range FROM-TO a part of it";
        lines.push(("next", next.to_owned()));
    }
    facts(&lines)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_finished_missing_and_to_go_is_told() {
        let census = Census {
            planned: 40,
            completed: 29,
            failed: 1,
            first: vec![(7, "too fast".to_owned())],
            ..Census::default()
        };
        let told = text(&census, 0.6, "30–39");
        for words in
            ["30 of 40 samples, 75.0 %", "29 completed, 1 failed", "7: too fast", "20.0 ms", "about 0 s", "30–39"]
        {
            assert!(told.contains(words), "{words}: {told}");
        }
        let none = text(&Census { planned: 40, ..Census::default() }, 0.0, "0–39");
        assert!(none.contains("0 of 40") && !none.contains("time") && none.contains("0–39"), "{none}");
        let all = text(&Census { planned: 1, completed: 1, ..Census::default() }, 0.6, "");
        assert!(!all.contains("missing") && !all.contains("to go"), "{all}");
    }
}
