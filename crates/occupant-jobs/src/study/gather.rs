//! From the rows of a journal to a table of samples: only the requested columns.

use std::collections::BTreeSet;

use occupant_core::results::summary::Caveat;
use occupant_study::spread::{Rule, Verdict, median};
use occupant_study::{Law, Study, Value};

use super::Samples;
use crate::base::{Failure, Show, Units};
use crate::ensemble::Judged;
use crate::files::study_folder::{Role, Row};
use crate::sweep::{Census, Extremes, Stored};
use occupant_files::table::Cell;

/// Number of runs listed at each end of a response.
const EXTREMES: usize = 3;

/// The table of a study, and the outcomes of its runs.
#[derive(Clone, Debug, Default)]
pub struct Gathered {
    /// One row for each sample that is finished.
    pub samples: Samples,
    /// By response: the extreme runs.
    pub extremes: Vec<Extremes<RunWithCaveats>>,
    /// By response: caveats on it.
    pub spoiled: Vec<Spoiled>,
    /// Outcomes of the runs.
    pub ends: Census,
    /// By response: the runs of the only sample, of a study that varies nothing but its ensemble.
    pub members: Vec<Vec<f64>>,
}

/// Index of a run, and its caveats on the figure.
pub type RunWithCaveats = (u64, String);

/// Number of runs with caveats on a figure, and the caveats.
#[derive(Clone, Debug, Default)]
pub struct Spoiled {
    /// Number of runs.
    pub runs: usize,
    /// Total number of runs with the figure.
    pub of: usize,
    /// Their names.
    pub names: BTreeSet<String>,
}

/// Reads all rows that are there; `figures` are the columns of the responses.
///
/// # Errors
/// A journal that cannot be read.
pub fn gather(opened: &Stored, figures: &[usize], units: Units, show: Show) -> Result<Gathered, Failure> {
    let study = &opened.plan.study;
    let columns = &opened.manifest.columns;
    let named: Vec<(String, String)> =
        figures.iter().map(|i| (columns[*i].name.clone(), columns[*i].unit.clone())).collect();
    let mut gathering = Gathering {
        study,
        figures,
        gathered: Gathered {
            samples: Samples::told_in(units, study, &named),
            extremes: vec![Extremes::new(EXTREMES); figures.len()],
            spoiled: vec![Spoiled::default(); figures.len()],
            ends: Census::new(&opened.manifest),
            members: Vec::new(),
        },
        members: vec![Vec::new(); figures.len()],
    };
    gathering.name_words(|at| columns.get(at).is_some_and(|c| c.role == Role::InputText));
    let bar = show.bar(gathering.gathered.ends.planned, "runs read");
    opened.journal.each_row(|row| {
        gathering.see(&row);
        if let Some(bar) = &bar {
            bar.set_position(row.index);
        }
        Ok(())
    })?;
    bar.iter().for_each(|bar| bar.clear());
    gathering.close();
    Ok(gathering.gathered)
}

struct Gathering<'a> {
    study: &'a Study,
    /// Columns of the responses.
    figures: &'a [usize],
    gathered: Gathered,
    /// By response: the members of the present sample so far.
    members: Vec<Vec<f64>>,
}

impl Spoiled {
    fn see(&mut self, value: f64, touching: &[&str]) {
        if value.is_finite() {
            self.of += 1;
            self.runs += usize::from(!touching.is_empty());
            self.names.extend(touching.iter().map(|name| (*name).to_owned()));
        }
    }
}

impl Gathering<'_> {
    /// Words in the order of the study's lists.
    fn name_words(&mut self, is_words: impl Fn(usize) -> bool) {
        for (at, parameter) in self.study.parameters.iter().enumerate() {
            if !is_words(at) {
                continue;
            }
            // those of a table are met as they come
            let words = self.gathered.samples.inputs[at].words.insert(Vec::new());
            if let Law::List(values) = &parameter.law {
                for known in values.iter().filter_map(word) {
                    place_of(words, &known);
                }
            }
        }
    }

    fn see(&mut self, row: &Row) {
        let cell = |at: usize| row.cells.get(at).and_then(Cell::number);
        let counts = self.gathered.ends.see(row);
        let (number, _) = self.study.sample_and_member(row.index);
        if self.gathered.samples.numbers.last() != Some(&number) {
            self.close();
            self.open(row);
        }
        let caveats: Vec<Caveat> = row.caveats().collect();
        for (i, at) in self.figures.iter().enumerate() {
            let value = cell(*at).filter(|_| counts).unwrap_or(f64::NAN);
            let figure = &self.gathered.samples.responses[i].name;
            let touching = caveats.iter().filter(|caveat| caveat.touches(figure)).map(|caveat| caveat.name.as_str());
            let touching: Vec<_> = touching.collect();
            self.gathered.spoiled[i].see(value, &touching);
            self.gathered.extremes[i].see(&(row.index, touching.join(", ")), value);
            self.members[i].push(value);
        }
    }

    /// Begins the row of a sample.
    fn open(&mut self, row: &Row) {
        let samples = &mut self.gathered.samples;
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
        if self.gathered.samples.is_empty() {
            return;
        }
        if self.study.samples() == 1 && self.study.members() > 1 {
            self.gathered.members = self.members.clone();
        }
        for (response, members) in self.gathered.samples.responses.iter_mut().zip(&mut self.members) {
            let there = members.iter().filter(|x| x.is_finite()).count();
            let value = median(members).filter(|_| 2 * there >= members.len());
            response.values.push(value.unwrap_or(f64::NAN));
            let judged = Judged::of(&response.name, &response.unit.si, members, Rule::default().relative);
            match judged.map(|j| j.verdict).filter(|_| members.len() > 1) {
                Some(Verdict::Stable) => response.stable[0] += 1,
                Some(Verdict::NotStable) => response.stable[1] += 1,
                Some(Verdict::TooFew) | None => {}
            }
            members.clear();
        }
    }
}

/// A list value as text of the table.
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
