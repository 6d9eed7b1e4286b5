//! Report of a finished or running study: influence of each parameter with its uncertainty, and the commands to run it again.
//!
//! ```text
//! folder of a sweep ─ Stored ─ Samples (a table of inputs and responses) ─ Analysis of each response ─ numbers ─ page, Parquet
//!                           └ Streams, if there are too many for a table ┘
//! ```
//!
//! A study of more than [`streams::MOST_ROWS`] samples goes by once for its numbers, and once more for the table of samples.
//! Memory does not grow with its samples.

pub mod analysis;
pub mod bands;
pub mod caution;
mod command;
mod design;
mod gather;
mod groups;
mod matrix;
mod matters;
mod numbers;
mod page;
mod panels;
mod pictures;
mod plots;
mod quoting;
mod responses;
pub mod samples;
mod sections;
mod spread_plots;
pub mod streams;
mod tables;
pub mod worst;
mod writing;

pub use design::write_design;
pub use matrix::text as matrix_text;
pub use page::{page, subject};
pub use quoting::{Answer, all_words, answer, text as paragraphs};
pub use tables::{Tables, write as write_tables};
pub use writing::Wanted;

use crate::base::{Failure, Show, Units};
use crate::files::study_folder::Role;
use crate::quoted::{Limits, Statement, parse_limit};
use crate::sweep::Stored;
use analysis::{Analysis, ByDesign, Linear};
use gather::Gathered;
use groups::Groups;
use numbers::{Number, numbers};
use samples::{Input, Response, Samples};

/// Content of a study's report.
pub struct Report {
    /// Its folder.
    pub opened: Stored,
    gathered: Gathered,
    /// By response: its analysis, all its numbers, and what can be quoted.
    analyses: Vec<Analysed>,
    /// Folder of the scenarios of worst and best runs, from the folder of the page; none if they are not written.
    pub runs: Option<String>,
    /// Notes to read before using any number.
    pub notes: Vec<String>,
}

/// The analysis of a response, all its numbers, what can be quoted, and its values by crossed parameters or words.
type Analysed = (Analysis, Vec<Number>, Vec<Statement>, Groups);

/// A response with its analysis.
struct Finding<'a> {
    samples: &'a Samples,
    response: &'a Response,
    analysis: &'a Analysis,
    numbers: &'a [Number],
    statements: &'a [Statement],
    groups: &'a Groups,
    runs: Option<&'a str>,
}

impl Finding<'_> {
    /// Parameters, the most important first.
    fn order(&self) -> impl Iterator<Item = usize> + Clone {
        self.analysis.order.iter().copied()
    }

    fn number(&self, quantity: &str, parameter: usize) -> Option<&Number> {
        self.numbers.iter().find(|n| n.quantity == quantity && n.parameter == Some(parameter))
    }

    /// The value of a quantity; NaN without one.
    fn value(&self, quantity: &str, parameter: usize) -> f64 {
        self.number(quantity, parameter).map_or(f64::NAN, |n| n.estimate.value)
    }

    /// Name of the parameter of a number, or `one × other` of a pair; empty without one.
    fn parameters(&self, number: &Number) -> String {
        let names =
            [number.parameter, number.other].into_iter().flatten().map(|i| self.samples.inputs[i].name.as_str());
        names.collect::<Vec<_>>().join(" × ")
    }

    /// Whether a rule of its own marks a number, not one that marks all of the response.
    fn is_marked(&self, number: &Number) -> bool {
        number.mark != caution::lacking(self.analysis.spread.as_ref())
    }
}

impl Report {
    /// Reads the rows and analyses the responses that `names` asks for, the customary ones for none, with `limits` beside
    /// those of rules, such as `hic15=700`.
    ///
    /// # Errors
    /// A name that is none; a limit that is none; a journal that cannot be read.
    pub fn of(
        opened: Stored,
        names: &[String],
        limits: &[String],
        units: Units,
        show: Show,
    ) -> Result<Report, Failure> {
        let candidates = responses::candidates(&opened.manifest, names)?;
        let limits = limits_of(&opened, limits)?;
        let mut gathered = gather::gather(&opened, candidates, &limits, units, show)?;
        if names.is_empty() {
            responses::keep_telling(&mut gathered);
        }
        let about = quoting::about(&opened, &gathered, units);
        let responses = gathered.samples.responses.len();
        let bar = show.bar(responses as u64, "results analysed");
        let analyse = |i: usize| {
            let analysis = gathered.analysis(i, &opened.plan.study);
            let numbers = numbers(&opened, &gathered, &analysis);
            bar.iter().for_each(|bar| bar.set_position(i as u64 + 1));
            let statements = quoting::statements(&about, &opened, &gathered, &analysis, &limits, units);
            (analysis, numbers, statements, gathered.groups(i).into_owned())
        };
        let analyses = (0..responses).map(analyse).collect();
        bar.iter().for_each(|bar| bar.clear());
        Ok(Report { analyses, notes: caution::of_the_study(&opened, &gathered), runs: None, gathered, opened })
    }

    /// What can be quoted, by response.
    pub fn statements(&self) -> impl Iterator<Item = &Statement> {
        self.analyses.iter().flat_map(|(_, _, statements, _)| statements)
    }

    /// Results by response.
    fn findings(&self) -> impl Iterator<Item = Finding<'_>> {
        let samples = &self.gathered.samples;
        self.analyses.iter().map(move |(analysis, numbers, statements, groups)| {
            let response = &samples.responses[analysis.response];
            Finding { samples, response, analysis, numbers, statements, groups, runs: self.runs.as_deref() }
        })
    }
}

/// Limits of rules for the base scenario, and those asked for.
fn limits_of(opened: &Stored, asked: &[String]) -> Result<Limits, Failure> {
    let figures = opened.manifest.columns.iter().filter(|c| c.role == Role::Figure);
    let figures: Vec<(String, String)> = figures.map(|c| (c.name.clone(), c.unit.clone())).collect();
    let asked: Vec<_> = asked.iter().map(|text| parse_limit(text, &figures)).collect::<Result<_, _>>()?;
    Ok(Limits::new(opened.plan.base_model().as_ref(), asked.concat()))
}
