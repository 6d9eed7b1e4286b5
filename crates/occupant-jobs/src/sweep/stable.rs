//! The ensembles of a study: what is stable, by sample and measure.
//!
//! Rows come in the order of their numbers and the members of a sample are neighbours, so one sample is held at a time:
//! memory grows with columns and members, not with samples. Bands over time are not made here, for a sweep keeps no
//! histories.

use std::path::PathBuf;

use occupant_study::spread::{Rule, Verdict};

use crate::base::{Existing, Failure};
use crate::ensemble::Judged;
use crate::ensemble::judge::{is_result, judge};
use crate::files::study_folder::{Folder, Manifest, Role, Row};
use occupant_files::table::{Cell, Form, Kind, TableFile, columns};

/// Column with the sample index of a run.
const SAMPLE: &str = "input.ensemble.sample";

/// Results of a study's ensembles.
#[derive(Clone, Debug, Default)]
pub struct Ensembles {
    /// Samples of the design.
    pub samples: u64,
    /// Number of incomplete members over all samples.
    pub failed: u64,
    /// By figure that any sample has.
    pub figures: Vec<Counted>,
    /// Figures of the first sample.
    pub first: Vec<Judged>,
    /// Files that were written.
    pub files: Vec<PathBuf>,
}

/// Number of samples in which a figure is stable.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counted {
    /// Name of the figure.
    pub name: String,
    /// Samples in which it is stable.
    pub stable: u64,
    /// Samples in which it is not.
    pub unstable: u64,
    /// Samples with too few members.
    pub too_few: u64,
    /// Samples in which no member has it.
    pub absent: u64,
}

/// Assesses samples as their members complete, and writes `ensemble.parquet`, and `ensemble.csv` if requested.
pub struct Stable {
    /// Column of the sample index.
    sample: usize,
    /// Name, unit and column of each figure.
    figures: Vec<(String, String, usize)>,
    present: Option<Sample>,
    tables: Vec<TableFile>,
    ensembles: Ensembles,
}

/// Members of a sample so far.
struct Sample {
    number: u64,
    failed: u64,
    /// By figure: one value per member, NaN where missing.
    values: Vec<Vec<f64>>,
}

impl Stable {
    /// Begins the tables; none for a sweep without ensembles.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn begin(folder: &Folder, manifest: &Manifest, csv: bool) -> Result<Option<Stable>, Failure> {
        let all = || manifest.columns.iter().enumerate();
        let Some((sample, _)) = all().find(|(_, c)| c.name == SAMPLE) else {
            return Ok(None);
        };
        let figures = all().filter(|(_, c)| c.role == Role::Figure && is_result(&c.name));
        let figures: Vec<_> = figures.map(|(at, c)| (c.name.clone(), c.unit.clone(), at)).collect();
        let counted = figures.iter().map(|(name, _, _)| Counted { name: name.clone(), ..Counted::default() });
        let ensembles = Ensembles { figures: counted.collect(), ..Ensembles::default() };
        let about = [("occupant.stable_within", Rule::default().relative.to_string())];
        let spread = ["least", "q05", "q25", "median", "q75", "q95", "greatest", "tolerance"];
        let columns = columns(&[
            (Kind::Count, &["sample"]),
            (Kind::Text, &["figure", "unit"]),
            (Kind::MaybeNumber, &["nominal"]),
            (Kind::Count, &["members", "missing", "failed"]),
            (Kind::MaybeNumber, &spread),
            (Kind::Text, &["verdict"]),
        ]);
        let forms = [(Form::Parquet, "ensemble.parquet"), (Form::Csv, "ensemble.csv")];
        let tables = forms
            .into_iter()
            .take(1 + usize::from(csv))
            .map(|(form, name)| TableFile::create(folder.path.join(name), form, Existing::Replace, &columns, &about));
        Ok(Some(Stable { sample, figures, present: None, tables: tables.collect::<Result<_, _>>()?, ensembles }))
    }

    /// Considers the next run; `counts` tells whether its figures are valid.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn see(&mut self, row: &Row, counts: bool) -> Result<(), Failure> {
        let number = |at: usize| row.cells.get(at).and_then(Cell::number);
        let sample = number(self.sample).unwrap_or(0.0) as u64;
        if let Some(finished) = self.present.take_if(|s| s.number != sample) {
            self.judge(&finished)?;
        }
        let none = || Sample { number: sample, failed: 0, values: vec![Vec::new(); self.figures.len()] };
        let sample = self.present.get_or_insert_with(none);
        sample.failed += u64::from(!counts);
        for (values, (_, _, at)) in sample.values.iter_mut().zip(&self.figures) {
            values.push(number(*at).filter(|_| counts).unwrap_or(f64::NAN));
        }
        Ok(())
    }

    fn judge(&mut self, sample: &Sample) -> Result<(), Failure> {
        self.ensembles.samples += 1;
        self.ensembles.failed += sample.failed;
        let figures = self.figures.iter().zip(&sample.values);
        let figures = figures.map(|((name, unit, _), values)| (name.as_str(), unit.as_str(), &values[..]));
        let judged = judge(figures, Rule::default().relative);
        for counted in &mut self.ensembles.figures {
            let figure = judged.iter().find(|j| j.name == counted.name);
            *match figure.map(|j| j.verdict) {
                Some(Verdict::Stable) => &mut counted.stable,
                Some(Verdict::NotStable) => &mut counted.unstable,
                Some(Verdict::TooFew) => &mut counted.too_few,
                None => &mut counted.absent,
            } += 1;
        }
        for figure in &judged {
            let row = sample.row(figure);
            self.tables.iter_mut().try_for_each(|table| table.row(row.clone()))?;
        }
        if self.ensembles.samples == 1 {
            self.ensembles.first = judged;
        }
        Ok(())
    }

    /// Renames the complete files.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn finish(mut self) -> Result<Ensembles, Failure> {
        if let Some(last) = self.present.take() {
            self.judge(&last)?;
        }
        self.ensembles.files = self.tables.into_iter().map(TableFile::publish).collect::<Result<_, _>>()?;
        Ok(self.ensembles)
    }
}

impl Sample {
    fn row(&self, figure: &Judged) -> Vec<Cell> {
        let s = &figure.spread;
        let mut row = vec![
            Cell::count(self.number),
            Cell::text(&figure.name),
            Cell::text(&figure.unit),
            figure.nominal.map_or(Cell::Absent, Cell::finite),
        ];
        row.extend([s.members as u64, s.missing as u64, self.failed].map(Cell::count));
        let spread = [s.least, s.q05, s.q25, s.median, s.q75, s.q95, s.greatest, figure.tolerance];
        row.extend(spread.map(Cell::finite));
        row.push(Cell::text(figure.verdict.word()));
        row
    }
}
