//! `occupant study report`.

use std::path::{Path, PathBuf};

use crate::base::{Existing, Failure, FileProblem, UnitsArg, deliver, is_page, print, progress, say};
use occupant_jobs::study::{Report, Tables, matrix_text, page, subject, write_tables};
use occupant_jobs::sweep::stored::{MadeBy, open};
use occupant_pictures::html::is_page_of;

/// Make an HTML page of a study: which inputs matter, how much, and the worst cases
///
/// The sweep may be finished or still running. The page opens in any browser and needs no network. Its numbers are also
/// written to REPORT.parquet beside it, and the samples to REPORT-samples.parquet.
#[derive(Debug, clap::Args)]
pub(crate) struct ReportArgs {
    /// The folder of `occupant sweep`, or several folders with shards of one sweep
    #[arg(value_name = "FOLDER", required = true)]
    folders: Vec<PathBuf>,

    /// The page; FOLDER/report.html if absent. An earlier report of the same study is replaced
    #[arg(short, long, value_name = "FILE.html")]
    output: Option<PathBuf>,

    /// Replace existing files
    #[arg(short, long)]
    force: bool,

    #[command(flatten)]
    units: UnitsArg,

    /// Results to report, such as hic15,belts.*.peak; if absent, those of head, chest, pelvis and belts that vary
    #[arg(long, value_name = "FIGURES", value_delimiter = ',')]
    to: Vec<String>,
}

/// Makes the report of a study.
pub(crate) fn report(args: &ReportArgs) -> Result<(), Failure> {
    let Some(first) = args.folders.first() else {
        return Err(Failure::plain("give the folder of a sweep"));
    };
    let page_at = args.output.clone().unwrap_or_else(|| first.join("report.html"));
    let tables = Tables::beside(&page_at);
    let opened = open(&args.folders, MadeBy::AnyProgram)?;
    refuse_names(&page_at, &tables, args)?;
    let units = args.units.or(Some(opened.plan.study.base.units()));
    let report = Report::of(opened, &args.to, units, progress::show(false))?;
    let force = args.force || (args.output.is_none() && is_page_of(&page_at, &subject(&report)));
    if !force {
        refuse_there(&page_at, &tables)?;
    } else if !args.force {
        say(&format!("note: replacing {}, an earlier report of this study (use -o to keep it)", page_at.display()));
    }
    for note in &report.notes {
        say(note);
    }
    let existing = Existing::by(force);
    write_tables(&report, &tables, existing)?;
    print(&matrix_text(&report))?;
    deliver(&page_at, force, page(&report).as_bytes())
}

/// Refuses names that are no page, and files of the sweep itself.
fn refuse_names(page: &Path, tables: &Tables, args: &ReportArgs) -> Result<(), Failure> {
    if !is_page(page) {
        return Err(Failure::with_help(format!("{} is not an .html file", page.display()), "use the extension .html"));
    }
    let names = ["results.parquet", "ensemble.parquet"];
    let own = |table: &PathBuf| {
        let mut ours = args.folders.iter().flat_map(|f| names.map(|n| f.join(n)));
        ours.any(|ours| same(&ours, table))
    };
    if let Some(table) = [&tables.numbers, &tables.samples].into_iter().find(|t| own(t)) {
        return Err(Failure::with_help(
            format!("{} is a table of the sweep", table.display()),
            "give the page another name",
        ));
    }
    Ok(())
}

/// Refuses files that are there.
fn refuse_there(page: &Path, tables: &Tables) -> Result<(), Failure> {
    let there = [page, &tables.numbers, &tables.samples].into_iter().find(|path| path.exists());
    there.map_or(Ok(()), |path| Err(FileProblem::Exists { path: path.to_owned() }.into()))
}

/// Whether two names lead to the same place, files that are not there yet included.
fn same(a: &Path, b: &Path) -> bool {
    let whole = |p: &Path| {
        let folder = p.parent().filter(|f| !f.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new(".")).canonicalize().ok()?;
        Some(folder.join(p.file_name()?))
    };
    whole(a).is_some() && whole(a) == whole(b)
}
