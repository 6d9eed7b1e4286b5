//! Writes the report of a study beside its page.

use std::path::{Path, PathBuf};

use occupant_pictures::html::is_page_of;
use occupant_scenario::kind::UnitSystem;

use super::{Report, Tables, subject, worst, write_tables};
use crate::base::{Existing, Failure, FileProblem, Show, Units, file_name, is_page, say};
use crate::sweep::stored::{MadeBy, open};

/// A report that is asked for.
#[derive(Clone, Copy, Debug)]
pub struct Wanted<'a> {
    /// Folders of the sweep or its shards.
    pub folders: &'a [PathBuf],
    /// The page.
    pub page: &'a Path,
    /// Results to report; the customary ones if empty.
    pub to: &'a [String],
    /// Limits beside those of rules, such as `hic15=700`.
    pub limits: &'a [String],
    /// Whether existing files are replaced.
    pub force: bool,
    /// Whether the page has the name that nobody asked for: an earlier one of the same study is replaced.
    pub is_unasked: bool,
}

impl Wanted<'_> {
    /// Analyses the study and writes all but the page, which may be replaced then; `units` are those of numbers for people,
    /// by the scenario's.
    ///
    /// # Errors
    /// A folder that is none of a sweep, or one with damaged files; unknown results and limits; existing files.
    pub fn write(self, units: impl FnOnce(UnitSystem) -> Units, show: Show) -> Result<Report, Failure> {
        let (page_at, tables) = (self.page, Tables::beside(self.page));
        let opened = open(self.folders, MadeBy::AnyProgram)?;
        refuse_names(page_at, &tables, self.folders)?;
        let units = units(opened.plan.study.base.units());
        let mut report = Report::of(opened, self.to, self.limits, units, show)?;
        let runs = worst::beside(page_at);
        let force = self.force || (self.is_unasked && is_page_of(page_at, &subject(&report)));
        if !force {
            refuse_there(page_at, &tables, &runs)?;
        } else if !self.force {
            let name = page_at.display();
            say(&format!("note: replacing {name}, an earlier report of this study (use -o to keep it)"));
        }
        report.notes.iter().for_each(|note| say(note));
        let existing = Existing::by(force);
        write_tables(&report, &tables, existing)?;
        worst::write(&report, &runs, existing)?.iter().for_each(|note| say(note));
        report.runs = Some(file_name(&runs));
        Ok(report)
    }
}

/// Refuses a page without .html, and names of the sweep's own files.
fn refuse_names(page: &Path, tables: &Tables, folders: &[PathBuf]) -> Result<(), Failure> {
    if !is_page(page) {
        return Err(Failure::with_help(format!("{} is not an .html file", page.display()), "use the extension .html"));
    }
    let names = ["results.parquet", "ensemble.parquet"];
    let own = |table: &PathBuf| {
        let mut ours = folders.iter().flat_map(|f| names.map(|n| f.join(n)));
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
