//! From the rows of a journal to a table of samples: only the columns that are asked for.

use occupant_study::ending::Balance;
use occupant_study::spread::{Verdict, median};
use occupant_study::{Law, Study, Value};

use super::extremes::Extremes;
use super::open::Opened;
use super::samples::Samples;
use crate::base::failure::Failure;
use crate::files::study_folder::manifest::Role;
use crate::files::study_folder::row::{Row, Status};
use crate::files::table::Cell;
use crate::jobs::ensemble::judge::{Judged, Tolerance};

/// So many different reasons are remembered.
const REASONS: usize = 12;

/// The table of a study, and how its runs ended.
#[derive(Clone, Debug, Default)]
pub(crate) struct Gathered {
    /// One row for each sample that is finished.
    pub(crate) samples: Samples,
    /// By response: the runs at its ends.
    pub(crate) extremes: Vec<Extremes>,
    /// How the runs ended.
    pub(crate) ends: Ends,
}

/// How the runs ended.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ends {
    /// All runs of the study.
    pub(crate) planned: u64,
    /// Runs that have ended, however.
    pub(crate) finished: u64,
    /// At their end time.
    pub(crate) completed: u64,
    /// The integration failed.
    pub(crate) failed: u64,
    /// The scenario was refused.
    pub(crate) refused: u64,
    /// The program broke off.
    pub(crate) broken: u64,
    /// Completed, with an energy balance that is off by more than 10 %: their figures count for nothing.
    pub(crate) doubtful: u64,
    /// Reasons of runs that did not complete: words, how many, the first run.
    pub(crate) reasons: Vec<(String, u64, u64)>,
    /// Runs with other reasons still.
    pub(crate) other_reasons: u64,
}

impl Ends {
    /// Finished runs without figures.
    pub(crate) fn without_figures(&self) -> u64 {
        self.finished - self.completed + self.doubtful
    }

    fn see(&mut self, row: &Row, doubtful: bool) {
        self.finished += 1;
        match row.status {
            Status::Completed => self.completed += 1,
            Status::Failed => self.failed += 1,
            Status::Refused => self.refused += 1,
            Status::Broken => self.broken += 1,
        }
        self.doubtful += u64::from(doubtful);
        if row.status == Status::Completed {
            return;
        }
        let known = self.reasons.iter().position(|r| r.0 == row.reason);
        match known {
            Some(at) => self.reasons[at].1 += 1,
            None if self.reasons.len() < REASONS => {
                self.reasons.push((row.reason.clone(), 1, row.index));
            }
            None => self.other_reasons += 1,
        }
    }
}

/// Reads all rows that are there; `figures` are the columns of the responses.
///
/// # Errors
/// A journal that cannot be read.
pub(crate) fn gather(opened: &Opened, figures: &[usize]) -> Result<Gathered, Failure> {
    let study = opened.plan.study();
    let columns = &opened.manifest.columns;
    let named: Vec<(String, String)> =
        figures.iter().map(|i| (columns[*i].name.clone(), columns[*i].unit.clone())).collect();
    let mut gathering = Gathering {
        study,
        figures,
        balance: columns.iter().position(|c| c.name == "energy.balance_error"),
        found: Gathered {
            samples: Samples::new(study, &named),
            extremes: vec![Extremes::default(); figures.len()],
            ends: Ends { planned: opened.manifest.samples, ..Ends::default() },
        },
        members: vec![Vec::new(); figures.len()],
    };
    gathering.name_words(|at| columns.get(at).is_some_and(|c| c.role == Role::InputText));
    opened.journal.each_row(|row| {
        gathering.see(&row);
        Ok(())
    })?;
    gathering.close();
    Ok(gathering.found)
}

struct Gathering<'a> {
    study: &'a Study,
    /// Columns of the responses.
    figures: &'a [usize],
    balance: Option<usize>,
    found: Gathered,
    /// By response: the members of the present sample so far.
    members: Vec<Vec<f64>>,
}

impl Gathering<'_> {
    /// Words in the order of the study's lists.
    fn name_words(&mut self, is_words: impl Fn(usize) -> bool) {
        for (at, parameter) in self.study.parameters().iter().enumerate() {
            if !is_words(at) {
                continue;
            }
            // those of a table are met as they come
            let words = self.found.samples.inputs[at].words.insert(Vec::new());
            if let Law::List(values) = &parameter.law {
                for known in values.iter().filter_map(word) {
                    place_of(words, &known);
                }
            }
        }
    }

    fn see(&mut self, row: &Row) {
        let cell = |at: usize| row.cells.get(at).and_then(Cell::number);
        let completed = row.status == Status::Completed;
        let balanced = |at| cell(at).is_some_and(|off| Balance::of(off) != Balance::Lost);
        let counts = completed && self.balance.is_none_or(balanced);
        self.found.ends.see(row, completed && !counts);
        let (number, _) = self.study.sample_and_member(row.index);
        if self.found.samples.numbers.last() != Some(&number) {
            self.close();
            self.open(row);
        }
        for (i, at) in self.figures.iter().enumerate() {
            let value = cell(*at).filter(|_| counts).unwrap_or(f64::NAN);
            self.found.extremes[i].see(row.index, value);
            self.members[i].push(value);
        }
    }

    /// Begins the row of a sample.
    fn open(&mut self, row: &Row) {
        let samples = &mut self.found.samples;
        samples.add(self.study, row.index);
        for (input, cell) in samples.inputs.iter_mut().zip(&row.cells) {
            let value = match cell {
                Cell::Number(x) => *x,
                Cell::Text(text) => place_of(input.words.get_or_insert_default(), text),
                Cell::Absent => f64::NAN,
            };
            input.values.push(value);
        }
    }

    /// Ends the row of a sample: the median of its members, if at least half of them have the figure.
    fn close(&mut self) {
        if self.found.samples.is_empty() {
            return;
        }
        for (response, members) in self.found.samples.responses.iter_mut().zip(&mut self.members) {
            let there = members.iter().filter(|x| x.is_finite()).count();
            let value = median(members).filter(|_| 2 * there >= members.len());
            response.values.push(value.unwrap_or(f64::NAN));
            let judged = Judged::of(&response.name, &response.unit, members, Tolerance::default());
            match judged.map(|j| j.verdict).filter(|_| members.len() > 1) {
                Some(Verdict::Stable) => response.stable[0] += 1,
                Some(Verdict::NotStable) => response.stable[1] += 1,
                Some(Verdict::TooFew) | None => {}
            }
            members.clear();
        }
    }
}

/// A value of a list as it stands in the table.
fn word(value: &Value) -> Option<String> {
    match value {
        Value::Number(x) => Some(x.to_string()),
        Value::Text(text) => Some(text.clone()),
        Value::Truth(b) => Some(b.to_string()),
        Value::Base => None,
    }
}

/// The place of a word among those known; a new one is added.
fn place_of(words: &mut Vec<String>, word: &str) -> f64 {
    let at = words.iter().position(|w| w == word).unwrap_or_else(|| {
        words.push(word.to_owned());
        words.len() - 1
    });
    at as f64
}
