//! `occupant measures`.

mod rating;
mod test;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crash_measures::injury::{Filtering, Measure, Options};
use crash_measures::measure::Dummy;
use crash_measures::rating::Rating;
use crash_measures::signal::CfcFamily;
use occupant_core::results::summary::{Caveat, Person, Summary};
use placed_text::shown;
use serde::Serialize;

use super::flags::history::{TestArgs, interval};
use super::tables::measures::{remarks, risks, side_by_side, table};
use super::tables::summary::Marks;
use crate::base::progress::Progress;
use crate::base::{Done, Failure, Units, UnitsArg, json, note, one_of, print};
use occupant_files::results::Results;
use occupant_jobs::files::history::{FAMILIES, family_name};
use occupant_jobs::judged::Impact;

/// Sample interval of filtered channels, s: the 10 kHz of SAE J211.
const FILTERED_S: f64 = 1e-4;

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

/// Filters: names on the command line, names in help.
const FILTERS: [(&str, &str, Asked); 4] = [
    ("none", "No filter", Asked::None),
    ("j211", "The SAE J211 class of each signal", Asked::Classes(None)),
    ("sae-j211", "The same with SAE J211 coefficients (older spelling)", Asked::Classes(Some(CfcFamily::SaeJ211))),
    ("iso6487", "The same with ISO 6487 coefficients (older spelling)", Asked::Classes(Some(CfcFamily::Iso6487))),
];

/// Requested filter, and the coefficients that an old name implies.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Asked {
    None,
    Classes(Option<CfcFamily>),
}

impl Args {
    fn filtering(&self) -> Filtering {
        match self.filter {
            Asked::None => Filtering::None,
            Asked::Classes(family) => Filtering::Classes(family.unwrap_or(self.coefficients)),
        }
    }
}

/// Dummies: names on the command line, names in help.
const DUMMIES: [(&str, &str, Dummy); 11] = [
    ("hybrid-iii-50m", "Hybrid III, 50th percentile male", Dummy::HybridIii50M),
    ("hybrid-iii-5f", "Hybrid III, 5th percentile female", Dummy::HybridIii5F),
    ("thor-50m", "THOR, 50th percentile male", Dummy::Thor50M),
    ("hybrid-iii-95m", "Hybrid III, 95th percentile male", Dummy::HybridIii95M),
    ("eurosid-1", "EuroSID-1, side impact", Dummy::EuroSid1),
    ("es-2", "ES-2, side impact", Dummy::Es2),
    ("es-2re", "ES-2re, side impact", Dummy::Es2Re),
    ("sid-iis", "SID-IIs, 5th percentile female, side impact", Dummy::SidIis),
    ("worldsid-50m", "WorldSID, 50th percentile male, side impact", Dummy::WorldSid50M),
    ("worldsid-5f", "WorldSID, 5th percentile female, side impact", Dummy::WorldSid5F),
    ("biorid-ii", "BioRID-II, rear impact", Dummy::BioRidIi),
];

#[derive(Serialize)]
struct Answer<'a> {
    file: &'a str,
    title: &'a str,
    complete: bool,
    /// Time span of the file's outputs, s.
    covers_s: [f64; 2],
    dummy: &'static str,
    #[serde(skip_serializing_if = "str::is_empty")]
    occupant: &'a str,
    measures: &'a [Measure],
    /// Measures of the other occupants.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    others: BTreeMap<&'a str, &'a [Measure]>,
    caveats: &'a [Caveat],
    notes: &'a [String],
}

/// A run with its measures.
struct Judged {
    file: String,
    results: Results,
    summary: Summary,
    impact: Impact,
    interval_ms: f64,
    notes: Vec<String>,
}

impl Judged {
    fn of(file: &Path, again_s: Option<f64>, options: Options, asked: Option<UnitsArg>) -> Result<Self, Failure> {
        let results = Results::open(file)?;
        // JSON is in SI units
        let units = asked.map_or(Units::default(), |asked| asked.or(results.loaded.scenario.units));
        let own_s = results.readings_s();
        let needed_s = (options.filtering != Filtering::None && own_s > 1.01 * FILTERED_S).then_some(FILTERED_S);
        // readings that the file has need no other run
        let again_s = again_s.or(needed_s).filter(|again_s| (again_s / own_s - 1.0).abs() > 1e-9);
        let [own_ms, interval_ms] = [own_s, again_s.unwrap_or(own_s)].map(|s| (1e9 * s).round() / 1e6);
        let mut notes = results.notes();
        let mut impact = Impact::default();
        let mut summary = match again_s {
            None => results.summary_judged(options, &mut impact)?,
            Some(interval_s) => {
                notes.push(format!(
                    "running the case again with samples every {interval_ms} ms; the file has one every {own_ms} ms"
                ));
                results.summary_again(options, interval_s, (&mut impact, Progress::new(false)))?
            }
        };
        // a dummy that was asked for has its limits, whatever the direction
        if options.by_size {
            impact.judge(&mut summary, &results.model);
            notes.extend(impact.reasons(units));
        }
        Ok(Judged { file: file.display().to_string(), results, summary, impact, interval_ms, notes })
    }

    /// Requested units, else those of its scenario.
    fn units(&self, args: &Args) -> Units {
        args.units.or(self.results.loaded.scenario.units)
    }

    fn answer(&self) -> Answer<'_> {
        Answer {
            file: &self.file,
            title: &self.results.model.setup().title,
            complete: self.results.is_complete(),
            covers_s: self.results.covers_s(),
            dummy: self.summary.dummy,
            occupant: self.summary.occupant,
            measures: &self.summary.measures,
            others: self.summary.others.iter().map(|(name, person)| (*name, &person.measures[..])).collect(),
            caveats: &self.summary.caveats,
            notes: &self.notes,
        }
    }
}

/// Prints the measures of runs.
pub(crate) fn measures(args: &Args) -> Result<Done, Failure> {
    let filtered = Options { filtering: args.filtering(), ..Options::default() };
    let options = args.dummy.map_or(filtered, |dummy| filtered.with(dummy));
    if args.runs.is_empty() {
        return rating::values_alone(args);
    }
    if args.runs.iter().any(|file| test::is_test(file)) {
        return test::measures(args, &options);
    }
    test::refuse_flags(args)?;
    let all = args.runs.iter().map(|file| Judged::of(file, args.interval, options, (!args.json).then_some(args.units)));
    let all = all.collect::<Result<Vec<_>, _>>()?;
    if let Some(rating) = args.rating {
        return rating::runs(args, rating, &all);
    }
    if args.json {
        let answers: Vec<_> = all.iter().map(Judged::answer).collect();
        print(&if let [one] = &answers[..] { json(one)? } else { json(&answers)? })?;
    } else if let [one] = &all[..] {
        one.notes.iter().for_each(note);
        print(&text(one, &options, (one.units(args), args.verdict)))?;
    } else {
        all.iter().for_each(|one| one.notes.iter().for_each(|text| note(&format!("{}: {text}", one.file))));
        let units = all.first().map_or(Units::default(), |one| one.units(args));
        print(&texts(&all, &options, units))?;
    }
    let others = all.iter().flat_map(|one| one.summary.others.values()).flat_map(|person| &person.measures);
    let exceeded = all.iter().flat_map(|one| &one.summary.measures).chain(others).any(Measure::is_exceeded);
    Ok(if exceeded && args.strict { Done::Unwell } else { Done::Well })
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
