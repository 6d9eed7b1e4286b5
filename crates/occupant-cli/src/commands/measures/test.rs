//! Measures of tests: tables, ISO-MME, NHTSA.

use std::path::Path;

use crash_measures::injury::{Measure, Options, assess};
use occupant_files::measured;
use occupant_jobs::instruments::Instruments;
use placed_text::shown;
use serde::Serialize;

use super::{Args, JUDGEMENT, filter};
use crate::base::{Done, Failure, Units, ending, json, note, print};
use crate::commands::tables::measures::{remarks, risks, side_by_side, table};
use crate::commands::tables::summary::Marks;

/// Whether a file or folder is a test instead of a result file.
pub(super) fn is_test(file: &Path) -> bool {
    file.is_dir() || ["csv", "txt", "tsv", "mme", "tdms", "ev5"].contains(&ending(file).as_str())
}

/// A test with its measures.
struct Judged {
    file: String,
    read: Instruments,
    measures: Vec<Measure>,
}

#[derive(Serialize)]
struct Answer<'a> {
    file: &'a str,
    /// Time span of the signals, s.
    covers_s: [f64; 2],
    interval_s: f64,
    dummy: &'static str,
    /// Signals with the columns they are read from.
    signals: Vec<[&'a str; 2]>,
    measures: &'a [Measure],
    notes: &'a [String],
}

impl Judged {
    fn of(file: &Path, args: &Args, options: &Options) -> Result<Self, Failure> {
        let recording = measured::read(file)?;
        let mut read = Instruments::of(&recording, &args.test.map, args.test.seat, args.test.shift)?;
        let measures: Vec<_> = assess(&read.signals, options).into_iter().filter(is_of_test).collect();
        let [from_s, to_s] = read.span_s();
        let half_s = 0.5 * read.signals.interval_s;
        let is_at = |time_s: Option<f64>, end_s: f64| time_s.is_some_and(|time_s| (time_s - end_s).abs() < half_s);
        let is_cut = |m: &&Measure| m.name.starts_with("hic") && (is_at(m.from_s, from_s) || is_at(m.to_s, to_s));
        let cut = measures.iter().filter(is_cut).filter(|m| m.value.is_some_and(|hic| hic >= 1.0));
        read.notes.extend(
            cut.map(|m| format!("{}: its interval ends with the record, so the value is at least this", m.name)),
        );
        Ok(Judged { file: file.display().to_string(), read, measures })
    }

    fn interval_ms(&self) -> f64 {
        (1e9 * self.read.signals.interval_s).round() / 1e6
    }

    fn answer(&self, options: &Options) -> Answer<'_> {
        Answer {
            file: &self.file,
            covers_s: self.read.span_s(),
            interval_s: self.read.signals.interval_s,
            dummy: options.dummy.name(),
            signals: self.read.read.iter().map(|(name, column)| [name.as_str(), column.as_str()]).collect(),
            measures: &self.measures,
            notes: &self.read.notes,
        }
    }

    /// Signals with their columns, one per line.
    fn columns(&self) -> String {
        let line = |(name, column): &(String, String)| {
            if name == column { format!("{name}\n") } else { format!("{name}: {}\n", shown(column)) }
        };
        self.read.read.iter().map(line).collect()
    }

    fn text(&self, options: &Options, units: Units) -> String {
        let head = format!(
            "{}\nsamples every {} ms, {}; limits and risks of a {}\n",
            shown(&self.file),
            self.interval_ms(),
            filter(options),
            options.dummy.name()
        );
        let marks = Marks::default();
        let measures = &self.measures;
        let parts = [table(measures, &marks, units, true), risks(measures, &marks), remarks(measures)];
        let filled = parts.into_iter().filter(|part| !part.is_empty());
        let read = format!("read from\n{}", self.columns());
        [head].into_iter().chain(filled).chain([read, JUDGEMENT.to_owned()]).collect::<Vec<_>>().join("\n")
    }
}

/// Whether a test has the signals of the measure; remarks on rigid chests apply to bodies only.
fn is_of_test(measure: &Measure) -> bool {
    measure.has_part() && (measure.value.is_some() || measure.figure.is_some())
}

/// Prints the measures of tests.
pub(super) fn measures(args: &Args, options: &Options) -> Result<Done, Failure> {
    if args.interval.is_some() {
        return Err(Failure::with_help("--interval: a test cannot be run again", "leave it out"));
    }
    if let Some(run) = args.runs.iter().find(|file| !is_test(file)) {
        return Err(Failure::with_help(
            format!("{} is a run, but another file is a test", run.display()),
            "give only runs or only tests",
        ));
    }
    let all = args.runs.iter().map(|file| Judged::of(file, args, options)).collect::<Result<Vec<_>, _>>()?;
    if let Some(rating) = args.rating {
        let tests: Vec<_> = all.iter().map(|one| (one.file.as_str(), &one.measures[..], &one.read.notes[..])).collect();
        return super::rating::tests(args, rating, options.dummy, &tests);
    }
    let units = args.units.or(None);
    if args.json {
        let answers: Vec<_> = all.iter().map(|one| one.answer(options)).collect();
        print(&if let [one] = &answers[..] { json(one)? } else { json(&answers)? })?;
    } else {
        all.iter().flat_map(|one| &one.read.notes).for_each(note);
        print(&if let [one] = &all[..] { one.text(options, units) } else { texts(&all, options, units) })?;
    }
    let exceeded = all.iter().flat_map(|one| &one.measures).any(Measure::is_exceeded);
    Ok(if exceeded && args.strict { Done::Unwell } else { Done::Well })
}

/// Several tests, numbered, in one table.
fn texts(all: &[Judged], options: &Options, units: Units) -> String {
    let tests = (1..)
        .zip(all)
        .map(|(number, one)| format!("{number}  {}, samples every {} ms\n", shown(&one.file), one.interval_ms()));
    let marks = Marks::default();
    let columns: Vec<_> = all.iter().map(|one| (&one.measures[..], &marks)).collect();
    [
        tests.collect::<String>() + &format!("{}; limits of a {}\n", filter(options), options.dummy.name()),
        side_by_side(&columns, units) + "> beyond a limit\n",
        JUDGEMENT.to_owned(),
    ]
    .join("\n")
}

/// Refuses flags that apply to runs only.
pub(super) fn refuse_flags(args: &Args) -> Result<(), Failure> {
    let mend = "leave it out, or give a test";
    match () {
        () if !args.test.map.is_empty() => Err(Failure::with_help("--map: the signals of a run need no map", mend)),
        () if args.test.shift != 0.0 => Err(Failure::with_help("--shift: a run has its own clock", mend)),
        () => Ok(()),
    }
}
