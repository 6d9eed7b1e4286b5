//! The ensembles of a study, from its finished table: what is stable, by sample and measure.
//!
//! The table stands in the order of the index and the members of a sample are neighbours, so it is read once from its begin
//! to its end, a row group at a time: memory grows with columns and members, not with samples. Bands over time are not
//! made here, for a sweep keeps no histories: see [`super::study_bands`].

use std::fs::File;
use std::path::{Path, PathBuf};

use occupant_study::ending::Balance;
use occupant_study::spread::Verdict;
use parquet::column::reader::get_typed_column_reader;
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType};
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, RowGroupReader, SerializedFileReader};

use super::judge::{Judged, Tolerance, is_result, judge, rule, word};
use crate::base::failure::Failure;
use crate::base::output_file::Existing;
use crate::files::study_folder::manifest::{Manifest, Role};
use crate::files::table::{Cell, Form, Kind, TableFile};

const COLUMNS: [(&str, Kind); 16] = [
    ("sample", Kind::Count),
    ("figure", Kind::Text),
    ("unit", Kind::Text),
    ("nominal", Kind::MaybeNumber),
    ("members", Kind::Count),
    ("missing", Kind::Count),
    ("failed", Kind::Count),
    ("least", Kind::MaybeNumber),
    ("q05", Kind::MaybeNumber),
    ("q25", Kind::MaybeNumber),
    ("median", Kind::MaybeNumber),
    ("q75", Kind::MaybeNumber),
    ("q95", Kind::MaybeNumber),
    ("greatest", Kind::MaybeNumber),
    ("tolerance", Kind::MaybeNumber),
    ("verdict", Kind::Text),
];

/// What the ensembles of a study came to.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ensembles {
    /// Samples of the design.
    pub(crate) samples: u64,
    /// Members that did not complete, in all samples together.
    pub(crate) failed: u64,
    /// By figure that some sample has.
    pub(crate) figures: Vec<Counted>,
    pub(crate) first: Vec<Judged>,
    /// Files that were written.
    pub(crate) files: Vec<PathBuf>,
}

/// In how many samples a figure is stable.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Counted {
    /// Name of the figure.
    pub(crate) name: String,
    /// Samples in which it is stable.
    pub(crate) stable: u64,
    /// Samples in which it is not.
    pub(crate) unstable: u64,
    /// Samples with too few members.
    pub(crate) too_few: u64,
    /// Samples in which no member has it.
    pub(crate) absent: u64,
}

/// Where things stand in the table.
struct Places {
    sample: usize,
    status: usize,
    balance: Option<usize>,
    /// Name, unit and column of each figure.
    figures: Vec<(String, String, usize)>,
}

/// Whether a sweep has ensembles.
pub(crate) fn has_ensembles(manifest: &Manifest) -> bool {
    manifest.columns.iter().any(|c| c.name == SAMPLE)
}

const SAMPLE: &str = "input.ensemble.sample";

/// Reads the finished table beside which `ensemble.parquet` is written, and `ensemble.csv` where asked for.
///
/// # Errors
/// A table that cannot be read; a file that cannot be written.
pub(crate) fn write(table: &Path, manifest: &Manifest, csv: bool) -> Result<Ensembles, Failure> {
    let broke_off = |reason: &dyn std::fmt::Display| Failure::BrokeOff(format!("error: {} {reason}", table.display()));
    let unread = |error: ParquetError| broke_off(&format!("cannot be read: {error}"));
    let file = File::open(table).map_err(|e| unread(e.into()))?;
    let reader = SerializedFileReader::new(file).map_err(unread)?;
    let places = Places::of(&reader, manifest).ok_or_else(|| broke_off(&"has no ensembles"))?;
    let mut writing = Writing::begin(table, csv, &places)?;
    let mut present: Option<Sample> = None;
    for i in 0..reader.num_row_groups() {
        let group = reader.get_row_group(i).map_err(unread)?;
        let rows = Rows::read(group.as_ref(), &places).map_err(unread)?;
        for row in 0..rows.sample.len() {
            let number = rows.sample[row].unwrap_or(0.0) as u64;
            if let Some(finished) = present.take_if(|s| s.number != number) {
                writing.sample(&finished, &places)?;
            }
            let sample = present.get_or_insert_with(|| Sample::new(number, places.figures.len()));
            sample.see(&rows, row);
        }
    }
    if let Some(last) = present {
        writing.sample(&last, &places)?;
    }
    writing.finish()
}

impl Places {
    fn of(reader: &SerializedFileReader<File>, manifest: &Manifest) -> Option<Places> {
        let columns = reader.metadata().file_metadata().schema_descr().columns();
        let place = |name: &str| columns.iter().position(|c| c.name() == name);
        let figures = manifest.columns.iter();
        let figures = figures.filter(|c| c.role == Role::Figure && is_result(&c.name));
        Some(Places {
            sample: place(SAMPLE)?,
            status: place("status")?,
            balance: place("energy.balance_error"),
            figures: figures.filter_map(|c| Some((c.name.clone(), c.unit.clone(), place(&c.name)?))).collect(),
        })
    }
}

/// The rows of a group, column by column.
struct Rows {
    sample: Vec<Option<f64>>,
    completed: Vec<bool>,
    figures: Vec<Vec<Option<f64>>>,
}

impl Rows {
    fn read(group: &dyn RowGroupReader, places: &Places) -> Result<Rows, ParquetError> {
        let status = values::<ByteArrayType>(group, places.status)?;
        let is_completed = |s: &Option<ByteArray>| s.as_ref().is_some_and(|s| s.data() == b"completed");
        let mut completed: Vec<bool> = status.iter().map(is_completed).collect();
        if let Some(balance) = places.balance {
            let errors = values::<DoubleType>(group, balance)?;
            for (ok, error) in completed.iter_mut().zip(errors) {
                *ok &= error.is_some_and(|e| Balance::of(e) != Balance::Lost);
            }
        }
        let figures = places.figures.iter();
        Ok(Rows {
            sample: values::<DoubleType>(group, places.sample)?,
            completed,
            figures: figures.map(|(_, _, column)| values::<DoubleType>(group, *column)).collect::<Result<_, _>>()?,
        })
    }
}

/// The values of a column, absent ones included.
fn values<T: DataType>(group: &dyn RowGroupReader, column: usize) -> Result<Vec<Option<T::T>>, ParquetError> {
    let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
    let optional = group.metadata().column(column).column_descr().max_def_level() > 0;
    let mut reader = get_typed_column_reader::<T>(group.get_column_reader(column)?);
    let (mut values, mut levels) = (Vec::with_capacity(rows), Vec::new());
    while values.len() < rows {
        let definitions = optional.then_some(&mut levels);
        let (records, _, _) = reader.read_records(rows, definitions, None, &mut values)?;
        if records == 0 {
            break;
        }
    }
    if !optional {
        return Ok(values.into_iter().map(Some).collect());
    }
    let mut values = values.into_iter();
    let value = |level: &i16| (*level > 0).then(|| values.next()).flatten();
    Ok(levels.iter().map(value).collect())
}

/// The members of a sample so far.
struct Sample {
    number: u64,
    failed: u64,
    /// By figure: a value for each member, NaN where it has none.
    values: Vec<Vec<f64>>,
}

impl Sample {
    fn new(number: u64, figures: usize) -> Self {
        Sample { number, failed: 0, values: vec![Vec::new(); figures] }
    }

    fn see(&mut self, rows: &Rows, row: usize) {
        let completed = rows.completed.get(row).copied().unwrap_or(false);
        self.failed += u64::from(!completed);
        for (values, figure) in self.values.iter_mut().zip(&rows.figures) {
            let value = figure.get(row).copied().flatten().filter(|_| completed);
            values.push(value.unwrap_or(f64::NAN));
        }
    }
}

/// The files being written, and what is counted meanwhile.
struct Writing {
    tables: Vec<TableFile>,
    found: Ensembles,
    tolerance: Tolerance,
}

impl Writing {
    fn begin(table: &Path, csv: bool, places: &Places) -> Result<Self, Failure> {
        let forms = [(Form::Parquet, "ensemble.parquet"), (Form::Csv, "ensemble.csv")];
        let tolerance = Tolerance::default();
        let about = [("occupant.stable_within", tolerance.relative.to_string())];
        let asked = forms.iter().filter(|(form, _)| csv || *form == Form::Parquet);
        let tables = asked.map(|(form, name)| {
            TableFile::create(table.with_file_name(name), *form, Existing::Replace, &COLUMNS, &about)
        });
        let counted = |(name, _, _): &(String, String, usize)| Counted {
            name: name.clone(),
            stable: 0,
            unstable: 0,
            too_few: 0,
            absent: 0,
        };
        Ok(Writing {
            tables: tables.collect::<Result<_, _>>()?,
            found: Ensembles { figures: places.figures.iter().map(counted).collect(), ..Ensembles::default() },
            tolerance,
        })
    }

    fn sample(&mut self, sample: &Sample, places: &Places) -> Result<(), Failure> {
        self.found.samples += 1;
        self.found.failed += sample.failed;
        let figures = places.figures.iter().zip(&sample.values);
        let figures = figures.map(|((name, unit, _), values)| (name.as_str(), unit.as_str(), values.clone()));
        let judged = judge(figures, self.tolerance);
        for counted in &mut self.found.figures {
            let figure = judged.iter().find(|j| j.name == counted.name);
            *match figure.map(|j| j.verdict) {
                Some(Verdict::Stable) => &mut counted.stable,
                Some(Verdict::NotStable) => &mut counted.unstable,
                Some(Verdict::TooFew) => &mut counted.too_few,
                None => &mut counted.absent,
            } += 1;
        }
        for figure in &judged {
            let row = row(sample, figure, self.tolerance);
            for table in &mut self.tables {
                table.row(row.clone())?;
            }
        }
        if self.found.samples == 1 {
            self.found.first = judged;
        }
        Ok(())
    }

    fn finish(mut self) -> Result<Ensembles, Failure> {
        for table in self.tables {
            self.found.files.push(table.publish()?);
        }
        Ok(self.found)
    }
}

fn row(sample: &Sample, judged: &Judged, tolerance: Tolerance) -> Vec<Cell> {
    let s = &judged.spread;
    let rule = rule(&judged.name, &judged.unit, tolerance);
    let within = (rule.relative * s.median.abs()).max(rule.absolute);
    let mut row = vec![
        Cell::count(sample.number),
        Cell::text(&judged.name),
        Cell::text(&judged.unit),
        judged.nominal.map_or(Cell::Absent, Cell::finite),
        Cell::count(s.members as u64),
        Cell::count(s.missing as u64),
        Cell::count(sample.failed),
    ];
    let spread = [s.least, s.q05, s.q25, s.median, s.q75, s.q95, s.greatest, within];
    row.extend(spread.map(Cell::finite));
    row.push(Cell::text(word(judged.verdict)));
    row
}
