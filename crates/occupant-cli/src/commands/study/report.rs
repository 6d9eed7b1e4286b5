//! `occupant study report`.

use std::path::{Path, PathBuf};

use crate::base::{Existing, Failure, FileProblem, UnitsArg, deliver, file_name, is_page, json, print, progress, say};
use occupant_jobs::study::{Report, Tables, answer, matrix_text, page, paragraphs, subject, worst, write_tables};
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

    /// A limit besides those of rules, such as hic15=700 or 'head_excursion.forward=650 mm': the report says how probable it is
    /// that it is exceeded. May be repeated
    #[arg(long, value_name = "FIGURE=VALUE")]
    limit: Vec<String>,

    /// Print what can be quoted of each result as JSON, in SI units, instead of text
    #[arg(long)]
    json: bool,
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
    let mut report = Report::of(opened, &args.to, &args.limit, units, progress::show(false))?;
    let runs = worst::beside(&page_at);
    let force = args.force || (args.output.is_none() && is_page_of(&page_at, &subject(&report)));
    if !force {
        refuse_there(&page_at, &tables, &runs)?;
    } else if !args.force {
        say(&format!("note: replacing {}, an earlier report of this study (use -o to keep it)", page_at.display()));
    }
    for note in &report.notes {
        say(note);
    }
    let existing = Existing::by(force);
    write_tables(&report, &tables, existing)?;
    worst::write(&report, &runs, existing)?.iter().for_each(|note| say(note));
    report.runs = Some(file_name(&runs));
    if args.json {
        print(&json(&answer(&report))?)?;
    } else {
        print(&matrix_text(&report))?;
        print(&format!("\n{}", paragraphs(&report)))?;
    }
    deliver(&page_at, force, page(&report).as_bytes())
}

/// Refuses a page without .html, and names of the sweep's own files.
fn refuse_names(page: &Path, tables: &Tables, args: &ReportArgs) -> Result<(), Failure> {
    if !is_page(page) {
        return Err(Failure::with_help(format!("{} is not an .html file", page.display()), "use the extension .html"));
    }
    let names = ["results.parquet", "ensemble.parquet"];
    let own = |table: &PathBuf| {
        let mut ours = args.folders.iter().flat_map(|f| names.map(|n| f.join(n)));
        ours.any(|ours| same(&ours, table))
    };
    if let Some(table) = [&tables.numbers, &tables.samples, &tables.distribution].into_iter().find(|t| own(t)) {
        return Err(Failure::with_help(
            format!("{} is a table of the sweep", table.display()),
            "give the page another name",
        ));
    }
    Ok(())
}

/// Refuses existing files.
fn refuse_there(page: &Path, tables: &Tables, runs: &Path) -> Result<(), Failure> {
    let all = [page, &tables.numbers, &tables.samples, &tables.distribution, runs];
    let there = all.into_iter().find(|path| path.exists());
    there.map_or(Ok(()), |path| Err(FileProblem::Exists { path: path.to_owned() }.into()))
}

/// Whether two paths are the same file, existing or not.
fn same(a: &Path, b: &Path) -> bool {
    let whole = |p: &Path| {
        let folder = p.parent().filter(|f| !f.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new(".")).canonicalize().ok()?;
        Some(folder.join(p.file_name()?))
    };
    whole(a).is_some() && whole(a) == whole(b)
}
