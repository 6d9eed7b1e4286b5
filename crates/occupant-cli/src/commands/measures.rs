//! `occupant measures`.

mod rating;
mod test;

use std::path::PathBuf;

use crash_measures::injury::{Filtering, Measure, Options};
use crash_measures::measure::Dummy;
use crash_measures::rating::Rating;
use crash_measures::signal::CfcFamily;
use occupant_core::results::summary::Person;
use placed_text::shown;

use super::flags::history::{TestArgs, interval};
use super::tables::measures::{remarks, risks, side_by_side, table};
use super::tables::summary::Marks;
use crate::base::progress::Progress;
use crate::base::{Done, Failure, Units, UnitsArg, json, note, one_of, print};
use occupant_files::results::Results;
use occupant_jobs::files::history::{FAMILIES, family_name};
use occupant_jobs::measures::{Asked, DUMMIES, FILTERS, Judged, options};

/// Print injury measures of runs and tests, with limits and risk curves
///
/// HIC, 3 ms levels, severity indices, BrIC, DAMAGE, neck and femur loads, Nij and others. Several runs share one
/// table, with a column each. Simulated signals have no noise and are not filtered unless --filter asks for it. Exit
/// code 1 if --strict is given and a limit is exceeded.
///
/// With --rating the measures are rated as a test is: points, stars, grades or a verdict, region by region. What a body
/// does not measure stays blank, with the reason.
///
/// A test is a CSV table, an ISO-MME test (its folder or .mme file) or an NHTSA test. Its signals are identified by
/// --map, by channel name (see `occupant channels`) or by ISO-MME code. Tests have noise: use --filter j211.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The results of `occupant run`, or tests: CSV, ISO-MME folder or .mme file
    #[arg(value_name = "RUN.mcap", required_unless_present = "values")]
    runs: Vec<PathBuf>,

    /// Rate by the tables and rules of a rating
    #[arg(long, value_name = "RATING", value_parser = rating::names())]
    rating: Option<&'static Rating>,

    /// Rate as these occupants of the rating: a part of case, seat and dummy, such as 'driver'. If absent, those with
    /// the dummy of the measures, else the first. Given once for each body, in the order of the runs, all are rated
    /// together
    #[arg(long, value_name = "OCCUPANT", requires = "rating")]
    place: Vec<String>,

    /// Values of the rating's criteria from a table (CSV, XLSX) with the columns Loadcase, Seat position, Dummy, Body
    /// region, Criteria, Value. They count before measures; without a run they are rated alone
    #[arg(long, value_name = "FILE", requires = "rating")]
    values: Option<PathBuf>,

    /// Write criteria, values and blanks in the layout of --values, which is that of Euro NCAP's template: .csv, .xlsx,
    /// .parquet
    #[arg(short, long, value_name = "FILE", requires = "rating")]
    output: Option<PathBuf>,

    /// Replace the file of -o
    #[arg(short, long, requires = "output")]
    force: bool,

    /// Filter each channel by its class (CFC: head 1000, neck 1000/600, chest 180, femur 600, head rotation 60)
    #[arg(long, value_name = "CLASS", default_value = "none", value_parser = one_of(&FILTERS))]
    filter: Asked,

    /// Standard for the filter coefficients
    #[arg(long, value_name = "STANDARD", default_value = "iso6487", value_parser = one_of(&FAMILIES))]
    coefficients: CfcFamily,

    /// Run the case again and sample it at this interval, such as '0.1 ms'. A file has samples every 0.1 ms, or every
    /// step if a fixed step is longer. A filter needs 0.1 ms and runs the case again if the file is coarser
    #[arg(long, value_name = "TIME", value_parser = interval)]
    interval: Option<f64>,

    /// The dummy whose limits and risk curves apply; the Hybrid III nearest in mass if absent
    #[arg(long, value_name = "DUMMY", value_parser = one_of(&DUMMIES))]
    dummy: Option<Dummy>,

    /// Print passed or EXCEEDED for people too. Limits are made for dummies, and for a person's body they are
    /// yardsticks
    #[arg(long)]
    verdict: bool,

    /// Exit with code 1 if a limit is exceeded
    #[arg(long)]
    strict: bool,

    #[command(flatten)]
    test: TestArgs,

    #[command(flatten)]
    units: UnitsArg,

    /// Print JSON instead of tables, in SI units; a list for several runs
    #[arg(long)]
    json: bool,
}

impl Args {
    fn options(&self) -> Options {
        options(self.filter, self.coefficients, self.dummy)
    }
}

/// Prints the measures of runs.
pub(crate) fn measures(args: &Args) -> Result<Done, Failure> {
    let options = args.options();
    if args.runs.is_empty() {
        return rating::values_alone(args);
    }
    if args.runs.iter().any(|file| test::is_test(file)) {
        return test::measures(args, &options);
    }
    test::refuse_flags(args)?;
    let judged = |file: &PathBuf| {
        let results = Results::open(file)?;
        // JSON is in SI units
        let units = if args.json { Units::default() } else { args.units.or(results.loaded.scenario.units) };
        Judged::of(results, args.interval, options, units, Progress::new(false))
    };
    let all = args.runs.iter().map(judged);
    let all = all.collect::<Result<Vec<_>, _>>()?;
    if let Some(rating) = args.rating {
        return rating::runs(args, rating, &all);
    }
    if args.json {
        let answers: Vec<_> = all.iter().map(Judged::answer).collect();
        print(&if let [one] = &answers[..] { json(one)? } else { json(&answers)? })?;
    } else if let [one] = &all[..] {
        one.notes.iter().for_each(note);
        print(&text(one, &options, (units(one, args), args.verdict)))?;
    } else {
        all.iter().for_each(|one| one.notes.iter().for_each(|text| note(&format!("{}: {text}", one.file))));
        let units = all.first().map_or(Units::default(), |one| units(one, args));
        print(&texts(&all, &options, units))?;
    }
    let others = all.iter().flat_map(|one| one.summary.others.values()).flat_map(|person| &person.measures);
    let exceeded = all.iter().flat_map(|one| &one.summary.measures).chain(others).any(Measure::is_exceeded);
    Ok(if exceeded && args.strict { Done::Unwell } else { Done::Well })
}

/// Requested units, else those of its scenario.
fn units(one: &Judged, args: &Args) -> Units {
    args.units.or(one.results.loaded.scenario.units)
}

/// Several runs, numbered, in one table.
fn texts(all: &[Judged], options: &Options, units: Units) -> String {
    let marks: Vec<_> = all.iter().map(|one| Marks::of(&one.summary.caveats)).collect();
    let runs = (1..).zip(all).map(|(number, one)| {
        let title = shown(&one.results.model.setup().title);
        format!("{number}  {}: {title}, readings every {} ms\n", shown(&one.file), one.interval_ms)
    });
    let columns: Vec<_> = all.iter().zip(&marks).map(|(one, marks)| (&one.summary.measures[..], marks)).collect();
    let remarks = (1..).zip(&marks).filter_map(|(number, marks)| {
        let lines = marks.explained()?;
        Some(lines.lines().map(|line| format!("{number}  {line}\n")).collect::<String>())
    });
    let mut dummies: Vec<_> = all.iter().map(|one| one.summary.dummy).collect();
    dummies.dedup();
    let (filter, dummy) = (filter(options), dummies.join(", of a "));
    [
        runs.collect::<String>() + &format!("{filter}; limits of a {dummy}\n"),
        side_by_side(&columns, units) + "> beyond a limit\n",
        remarks.collect(),
        JUDGEMENT.to_owned(),
    ]
    .join("\n")
}

fn filter(options: &Options) -> String {
    match options.filtering {
        Filtering::None => "unfiltered".to_owned(),
        Filtering::Classes(family) => format!("filtered by {} classes", family_name(family)),
    }
}

/// Sources of limits and curves.
const JUDGEMENT: &str =
    "Limits and risk curves come from secondary sources: check the regulation itself before a legal statement.\n";

fn text(one: &Judged, options: &Options, (units, verdict): (Units, bool)) -> String {
    let Judged { results, summary, interval_ms, .. } = one;
    let with_verdict = results.loaded.dummies();
    let (people, all) = (summary.people(), Marks::of(&summary.caveats));
    let filter = filter(options);
    let title = shown(&results.model.setup().title);
    let mut dummies: Vec<_> = people.iter().map(|(_, person)| person.dummy).collect();
    dummies.dedup();
    let dummy = dummies.join(", of a ");
    let mut parts =
        vec![format!("{title}\nreadings every {interval_ms} ms, {filter}; limits and risks of a {dummy}\n")];
    for (prefix, Person { measures, .. }) in &people {
        let marks = all.of_occupant(prefix);
        let judged = verdict || with_verdict.iter().any(|name| name == prefix.trim_end_matches('.'));
        let name = shown(prefix.trim_end_matches('.'));
        parts.extend((!prefix.is_empty()).then(|| format!("{name}\n")));
        parts.extend([table(measures, &marks, units, judged), risks(measures, &marks), remarks(measures)]);
    }
    // what the marks mean stands behind the first table
    parts.insert(if people.len() > 1 { parts.len() } else { 2 }, all.explained().unwrap_or_default());
    parts.push(JUDGEMENT.to_owned());
    parts.join("\n")
}
