//! From the rows of a journal to a table of samples: only the requested columns.

use std::borrow::Cow;
use std::collections::BTreeMap;

use occupant_core::results::summary::Caveat;
use occupant_study::sketch::Sketch;
use occupant_study::spread::{Spread, Verdict};
use occupant_study::{Law, Study, Value};

use super::analysis::independent;
use super::groups::Groups;
use super::streams::{Line, MOST_ROWS, Streams, Thinning};
use super::{Analysis, Input, Samples};
use crate::base::{Failure, Show, Units};
use crate::ensemble::judge::rule;
use crate::files::study_folder::{Role, Row, Status};
use crate::quoted::Limits;
use crate::sweep::{Census, Extremes, Stored};
use occupant_files::table::Cell;

/// Number of runs listed at each end of a response.
const EXTREMES: usize = 3;
/// Largest number of different words of a parameter.
const MOST_WORDS: usize = 1000;

/// The table of a study, and the outcomes of its runs.
#[derive(Clone, Debug, Default)]
pub struct Gathered {
    /// One row for each sample that is finished and not excluded; a part of them if the study is large.
    pub samples: Samples,
    /// Of a large study: what is left of all its samples.
    pub streams: Option<Streams>,
    /// Columns of the responses.
    pub figures: Vec<usize>,
    /// By response: the extreme runs.
    pub extremes: Vec<Extremes<RunWithCaveats>>,
    /// By response: caveats on it.
    pub spoiled: Vec<Spoiled>,
    /// Outcomes of the runs.
    pub ends: Census,
    /// By response: the unchanged run and the others of the only sample, of a study that varies nothing but its ensemble.
    pub members: Vec<(f64, Sketch)>,
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
    /// Their names, with the number of runs.
    pub names: BTreeMap<String, usize>,
}

impl Gathered {
    /// Number of samples that are finished.
    pub fn len(&self) -> u64 {
        self.streams.as_ref().map_or(self.samples.len() as u64, |streams| streams.samples)
    }

    /// Values of a response.
    pub fn values(&self, response: usize) -> Cow<'_, Sketch> {
        let stream = self.streams.as_ref().map(|streams| &streams.responses[response].values);
        let table = || Cow::Owned(Sketch::exact(&self.samples.responses[response].values));
        stream.map_or_else(table, Cow::Borrowed)
    }

    /// Values of a response in the rows of Saltelli's blocks A and B.
    pub fn independent(&self, response: usize) -> Cow<'_, Sketch> {
        let stream = self.streams.as_ref().and_then(|streams| streams.responses[response].independent.as_ref());
        let values = &self.samples.responses[response].values;
        let rows = || independent(&self.samples).into_iter().map(|row| values[row]).collect::<Vec<_>>();
        stream.map_or_else(|| Cow::Owned(Sketch::exact(&rows())), Cow::Borrowed)
    }

    /// Values of a response by crossed parameters or words.
    pub fn groups(&self, response: usize) -> Cow<'_, Groups> {
        let stream = self.streams.as_ref().map(|streams| &streams.responses[response].groups);
        let table = || Cow::Owned(Groups::of_table(&self.samples, &self.samples.responses[response].values));
        stream.map_or_else(table, Cow::Borrowed)
    }

    /// Analyses a response.
    pub fn analysis(&self, response: usize, study: &Study) -> Analysis {
        match &self.streams {
            Some(streams) => streams.analysis(&self.samples, response, study),
            None => Analysis::of(&self.samples, response, study),
        }
    }
}

/// A sample that is finished.
#[derive(Clone, Debug)]
pub struct Sample {
    /// Its number.
    pub number: u64,
    /// Its first run.
    pub first: Row,
    /// By response: the median of its members, if at least half of them have it; else NaN.
    pub values: Vec<f64>,
    /// By response: the members, and whether they agree.
    members: Vec<(Sketch, Option<Verdict>)>,
}

/// Reads all rows that are there; `figures` are the columns of the responses.
///
/// # Errors
/// A journal that cannot be read.
pub fn gather(
    opened: &Stored,
    figures: Vec<usize>,
    limits: &Limits,
    units: Units,
    show: Show,
) -> Result<Gathered, Failure> {
    let (study, columns) = (&opened.plan.study, &opened.manifest.columns);
    let named: Vec<(String, String)> =
        figures.iter().map(|i| (columns[*i].name.clone(), columns[*i].unit.clone())).collect();
    let mut gathered = Gathered {
        samples: Samples::told_in(units, study, &named),
        extremes: vec![Extremes::new(EXTREMES); figures.len()],
        spoiled: vec![Spoiled::default(); figures.len()],
        ends: Census::new(&opened.manifest),
        ..Gathered::default()
    };
    let thinning = Thinning::of(study, MOST_ROWS);
    gathered.name_words(study, |at| columns.get(at).is_some_and(|c| c.role == Role::InputText));
    if thinning.every() > 1 {
        let Samples { inputs, responses, .. } = &gathered.samples;
        gathered.streams = Some(Streams::new(study, inputs, responses, limits));
        gathered.samples.one_in = thinning.every();
    }
    let is_single = study.samples() == 1 && study.members() > 1;
    let limits_of = |name: &str| limits.of(name).into_iter().map(|limit| limit.most).collect::<Vec<_>>();
    let none = |(name, _): &(String, String)| (f64::NAN, Sketch::new(MOST_ROWS as usize).counting(limits_of(name)));
    gathered.members = named.iter().filter(|_| is_single).map(none).collect();
    let bar = show.bar(gathered.ends.planned, "runs read");
    let mut sampling = Sampling::new(study, &figures, &named);
    each_row(opened, |row| {
        bar.iter().for_each(|bar| bar.set_position(row.index));
        gathered.see(&row, &figures);
        sampling.see(row, &mut |sample| {
            gathered.take(study, &thinning, &sample);
            Ok(())
        })
    })?;
    sampling.close(&mut |sample| {
        gathered.take(study, &thinning, &sample);
        Ok(())
    })?;
    gathered.streams.iter_mut().for_each(Streams::close);
    gathered.figures = figures;
    bar.iter().for_each(|bar| bar.clear());
    Ok(gathered)
}

/// Passes on each sample that is finished and not excluded, with these columns of responses.
///
/// # Errors
/// A journal that cannot be read; what `see` says.
pub fn each_sample(
    opened: &Stored,
    figures: &[usize],
    mut see: impl FnMut(Sample) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let columns = &opened.manifest.columns;
    let named: Vec<(String, String)> =
        figures.iter().map(|i| (columns[*i].name.clone(), columns[*i].unit.clone())).collect();
    let mut sampling = Sampling::new(&opened.plan.study, figures, &named);
    each_row(opened, |row| sampling.see(row, &mut see))?;
    sampling.close(&mut see)
}

/// Passes on each row that was there when the study was opened.
fn each_row(opened: &Stored, mut see: impl FnMut(Row) -> Result<(), Failure>) -> Result<(), Failure> {
    let was_there = |row: &Row| opened.journal.finished.has(row.index);
    opened.journal.each_row(|row| if was_there(&row) { see(row) } else { Ok(()) })
}

/// From runs to samples.
struct Sampling<'a> {
    study: &'a Study,
    /// Columns of the responses, with their names and units.
    figures: &'a [usize],
    named: &'a [(String, String)],
    present: Option<Sample>,
}

impl<'a> Sampling<'a> {
    fn new(study: &'a Study, figures: &'a [usize], named: &'a [(String, String)]) -> Self {
        Sampling { study, figures, named, present: None }
    }

    fn see(&mut self, row: Row, ended: &mut impl FnMut(Sample) -> Result<(), Failure>) -> Result<(), Failure> {
        if row.status == Status::Excluded {
            return Ok(());
        }
        let (number, _) = self.study.sample_and_member(row.index);
        if self.present.as_ref().is_some_and(|present| present.number != number) {
            self.close(ended)?;
        }
        let counts = has_figures(&row);
        let value = |at: &usize| row.cells.get(*at).and_then(Cell::number).filter(|_| counts).unwrap_or(f64::NAN);
        let values: Vec<f64> = self.figures.iter().map(value).collect();
        if self.study.members() == 1 {
            return ended(Sample { number, first: row, values, members: Vec::new() });
        }
        let none = || vec![(Sketch::new(MOST_ROWS as usize), None); values.len()];
        let begin = || Sample { number, first: row, values: Vec::new(), members: none() };
        let present = self.present.get_or_insert_with(begin);
        present.members.iter_mut().zip(&values).for_each(|((members, _), value)| members.see(*value));
        Ok(())
    }

    /// Ends the present sample.
    fn close(&mut self, ended: &mut impl FnMut(Sample) -> Result<(), Failure>) -> Result<(), Failure> {
        let Some(mut sample) = self.present.take() else { return Ok(()) };
        for ((members, verdict), (name, unit)) in sample.members.iter_mut().zip(self.named) {
            let spread = Spread::of_sketch(members);
            let counts = members.len() >= members.missing();
            sample.values.push(spread.filter(|_| counts).map_or(f64::NAN, |spread| spread.median));
            let are_several = members.len() + members.missing() > 1;
            *verdict = spread.filter(|_| are_several).map(|spread| spread.verdict(&rule(name, unit)));
        }
        ended(sample)
    }
}

/// Whether the figures of a run are valid.
fn has_figures(row: &Row) -> bool {
    row.status == Status::Completed && !row.caveats().any(|c| !c.is_note() && c.name == Caveat::BALANCE_LOST)
}

impl Spoiled {
    fn see(&mut self, value: f64, touching: &[&str]) {
        if value.is_finite() {
            self.of += 1;
            self.runs += usize::from(!touching.is_empty());
            touching.iter().for_each(|name| *self.names.entry((*name).to_owned()).or_default() += 1);
        }
    }
}

impl Gathered {
    /// Words in the order of the study's lists.
    fn name_words(&mut self, study: &Study, is_words: impl Fn(usize) -> bool) {
        for (at, parameter) in study.parameters.iter().enumerate() {
            if !is_words(at) {
                continue;
            }
            // those of a table are met as they come
            let words = self.samples.inputs[at].words.insert(Vec::new());
            if let Law::List(values) = &parameter.law {
                for known in values.iter().filter_map(word) {
                    place_of(words, &known);
                }
            }
        }
    }

    /// Counts a run.
    fn see(&mut self, row: &Row, figures: &[usize]) {
        let counts = self.ends.see(row);
        if row.status == Status::Excluded {
            return;
        }
        let caveats: Vec<Caveat> = row.caveats().collect();
        for (i, at) in figures.iter().enumerate() {
            let value = row.cells.get(*at).and_then(Cell::number).filter(|_| counts).unwrap_or(f64::NAN);
            let figure = &self.samples.responses[i].name;
            let touching = caveats.iter().filter(|caveat| caveat.touches(figure)).map(|caveat| caveat.name.as_str());
            let touching: Vec<_> = touching.collect();
            self.spoiled[i].see(value, &touching);
            self.extremes[i].see(&(row.index, touching.join(", ")), value);
            if let Some((unchanged, others)) = self.members.get_mut(i) {
                if row.index == 0 { *unchanged = value } else { others.see(value) }
            }
        }
    }

    /// Takes a sample that is finished.
    fn take(&mut self, study: &Study, thinning: &Thinning, sample: &Sample) {
        let inputs = self.samples.inputs.iter_mut().zip(&sample.first.cells);
        let place = |(input, cell): (&mut Input, &Cell)| match cell {
            Cell::Number(x) => *x,
            Cell::Text(text) => place_of(input.words.get_or_insert_default(), text),
            Cell::Absent => f64::NAN,
        };
        let inputs: Vec<f64> = inputs.map(place).collect();
        if self.streams.is_none() || thinning.keeps(sample.number) {
            self.samples.add(study, sample.first.index);
            self.samples.inputs.iter_mut().zip(&inputs).for_each(|(input, value)| input.values.push(*value));
            let responses = self.samples.responses.iter_mut().zip(&sample.values);
            responses.for_each(|(response, value)| response.values.push(*value));
        }
        for (response, (_, verdict)) in self.samples.responses.iter_mut().zip(&sample.members) {
            match verdict {
                Some(Verdict::Stable) => response.stable[0] += 1,
                Some(Verdict::NotStable) => response.stable[1] += 1,
                Some(Verdict::TooFew) | None => {}
            }
        }
        if let Some(streams) = &mut self.streams {
            let seen = self.samples.inputs.iter_mut().zip(&inputs).filter(|(_, value)| value.is_finite());
            seen.for_each(|(input, value)| {
                let [low, high] = input.beyond.unwrap_or([*value; 2]);
                input.beyond = Some([low.min(*value), high.max(*value)]);
            });
            let role = study.role(sample.first.index);
            streams.see(Line { number: sample.number, role, inputs, values: sample.values.clone() });
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

/// The place of a word among those known; a new one is added. Beyond [`MOST_WORDS`] all have one place.
fn place_of(words: &mut Vec<String>, word: &str) -> f64 {
    let at = words.iter().position(|w| w == word).unwrap_or_else(|| {
        if words.len() <= MOST_WORDS {
            words.push(if words.len() < MOST_WORDS { word } else { "others" }.to_owned());
        }
        words.len() - 1
    });
    at as f64
}
