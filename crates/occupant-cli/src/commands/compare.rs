//! `occupant compare`.

use std::path::{Path, PathBuf};

use occupant_core::results::channel::Channel;
use serde::Serialize;

use super::flags::history::{HistoryArgs, code_letter, time};
use crate::base::failure::{Done, Failure};
use crate::base::names::{file_name, program};
use crate::base::talk::{json, print, say};
use crate::base::text_table::facts;
use crate::files::history::{Filter, choose, class_name, load};
use crate::files::measured::{self, MapArgument, Pair, Wanted, is_recording, pairs};
use crate::files::results::Results;
use crate::files::signals::Recording;
use crate::jobs::compare::{RATE_HZ, Rating, Track, Window, rate};
use crate::pictures::plot::standard;

/// Rate how well a run follows a test: ISO/TS 18571, CORA, Sprague–Geers, ANOVA
///
/// The test is a text table (CSV), an ISO-MME test (its folder or .mme file) or another run. Signals belong to channels by
/// --map, by the same name, or by ISO-MME code, whose SAE J211 signs are turned into ours. Both sides are filtered alike,
/// cut to their common time and set to 10 kHz by straight lines, the rate of ISO/TS 18571; all four ratings use that.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The results of `occupant run`, or computed histories as CSV or ISO-MME
    #[arg(value_name = "COMPUTED")]
    computed: PathBuf,

    /// The test: CSV, ISO-MME folder or .mme file, or another run
    #[arg(value_name = "MEASURED")]
    measured: PathBuf,

    /// Channels by name or pattern; all that the test has if absent, of two runs those of the standard plots
    #[arg(long, value_name = "NAMES")]
    channel: Vec<String>,

    /// Which column of the test is which channel: 'column=channel', 'column[unit]=channel', 'column=-channel' for opposite
    /// signs
    #[arg(long, value_name = "MAP")]
    map: Vec<MapArgument>,

    /// Position of the occupant in the test's ISO-MME codes
    #[arg(long, value_name = "CODE", default_value = "1", value_parser = code_letter)]
    seat: char,

    /// First time to compare, such as '20 ms'
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    from: Option<String>,

    /// Last time to compare
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    to: Option<String>,

    /// Time added to the test's clock
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, default_value = "0")]
    shift: String,

    #[command(flatten)]
    treatment: HistoryArgs,

    /// Print JSON instead of a table
    #[arg(long)]
    json: bool,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Answer {
    program: String,
    computed: Source,
    measured: Source,
    filter: String,
    shift_s: f64,
    pairs: Vec<RatedPair>,
    notes: Vec<String>,
}

#[derive(Serialize)]
struct Source {
    file: String,
    sha256: String,
}

#[derive(Serialize)]
struct RatedPair {
    channel: String,
    signal: String,
    filter: String,
    #[serde(flatten)]
    rating: Rating,
}

/// A computed and a measured history of one channel.
struct Couple {
    channel: String,
    filter: String,
    time_s: Vec<f64>,
    values: Vec<f64>,
    measured: Pair,
}

/// Compares a run with a test.
pub(crate) fn compare(args: &Args) -> Result<Done, Failure> {
    let window = Window {
        from_s: args.from.as_deref().map(|t| time("--from", t)).transpose()?,
        to_s: args.to.as_deref().map(|t| time("--to", t)).transpose()?,
        shift_s: time("--shift", &args.shift)?,
    };
    let mut notes = Vec::new();
    let (couples, computed, measured) = couples(args, &mut notes)?;
    if couples.is_empty() {
        return Err(nothing_common(args));
    }
    let mut rated = Vec::with_capacity(couples.len());
    for couple in couples {
        let ours = Track { time_s: &couple.time_s, values: &couple.values };
        let theirs = Track { time_s: &couple.measured.time_s, values: &couple.measured.values };
        let rating = rate(ours, theirs, window)
            .map_err(|reason| Failure::plain(format!("{} cannot be compared: {reason}", couple.channel)))?;
        rated.push(RatedPair {
            channel: couple.channel,
            signal: couple.measured.signal,
            filter: couple.filter,
            rating,
        });
    }
    for note in &notes {
        say(&format!("note: {note}"));
    }
    let answer = Answer {
        program: program(),
        computed,
        measured,
        filter: args.treatment.words(),
        shift_s: window.shift_s,
        pairs: rated,
        notes,
    };
    match args.json {
        true => print(&json(&answer)?)?,
        false => print(&table(&answer))?,
    }
    Ok(Done::Well)
}

type Found = (Vec<Couple>, Source, Source);

fn couples(args: &Args, notes: &mut Vec<String>) -> Result<Found, Failure> {
    if is_recording(&args.computed) {
        return recorded_couples(args, notes);
    }
    let results = Results::open(&args.computed)?;
    let computed = source(&args.computed, &results.sha256);
    if !is_recording(&args.measured) {
        return run_couples(args, &results, computed, notes);
    }
    let recording = measured::read(&args.measured)?;
    notes.extend(recording.notes.iter().cloned());
    let channels = choose(&results.model, &args.channel)?;
    let wanted: Vec<Wanted> = channels.iter().map(Wanted::from).collect();
    let pairs = pairs(&recording, &wanted, &args.map, args.seat, notes)?;
    if pairs.is_empty() {
        return Ok((Vec::new(), computed, source(&args.measured, &recording.sha256)));
    }
    let chosen = pairs.iter().map(|p| channels[p.channel].clone()).collect();
    let histories = load(&results, chosen, args.treatment.treatment(None)?)?;
    notes.extend(histories.notes.iter().cloned());
    let mut couples = Vec::with_capacity(pairs.len());
    for (column, mut measured) in histories.columns.into_iter().zip(pairs) {
        if let Some(class) = column.class {
            measured.filter(class, args.treatment.coefficients)?;
        }
        couples.push(Couple {
            channel: column.channel.name.clone(),
            filter: class_name(column.class),
            time_s: histories.time_s.clone(),
            values: column.values,
            measured,
        });
    }
    Ok((couples, computed, source(&args.measured, &recording.sha256)))
}

/// Two runs: channels of the same name.
fn run_couples(args: &Args, results: &Results, computed: Source, notes: &mut Vec<String>) -> Result<Found, Failure> {
    if !args.map.is_empty() {
        return Err(Failure::with_help(
            "--map: channels of two runs have the same names",
            "choose them with --channel",
        ));
    }
    let other = Results::open(&args.measured)?;
    let channels = match args.channel.is_empty() {
        true => {
            let entries = standard(&results.model, false).into_iter().flat_map(|w| w.entries);
            choose(&results.model, &entries.map(|e| e.channel).collect::<Vec<_>>())?
        }
        false => choose(&results.model, &args.channel)?,
    };
    let theirs = occupant_core::results::channel::channels(&other.model);
    let in_both = |c: &Channel| theirs.iter().find(|t| t.name == c.name).cloned();
    let (ours, theirs): (Vec<Channel>, Vec<Channel>) =
        channels.into_iter().filter_map(|c| Some((c.clone(), in_both(&c)?))).unzip();
    let treatment = args.treatment.treatment(None)?;
    let (ours, theirs) = (load(results, ours, treatment)?, load(&other, theirs, treatment)?);
    notes.extend(ours.notes.iter().chain(&theirs.notes).cloned());
    let mut couples = Vec::with_capacity(ours.columns.len());
    for (column, other) in ours.columns.into_iter().zip(theirs.columns) {
        // what never happens in the other run (no contact, no belt) cannot be rated
        if other.values.iter().all(|v| v.abs() < 1e-100) {
            notes.push(format!("{}: zero throughout in {}, not rated", other.channel.name, args.measured.display()));
            continue;
        }
        couples.push(Couple {
            channel: column.channel.name.clone(),
            filter: class_name(column.class),
            time_s: ours.time_s.clone(),
            values: column.values,
            measured: Pair {
                channel: 0,
                signal: other.channel.name,
                time_s: theirs.time_s.clone(),
                values: other.values,
            },
        });
    }
    Ok((couples, computed, source(&args.measured, &other.sha256)))
}

/// Computed histories of another program.
fn recorded_couples(args: &Args, notes: &mut Vec<String>) -> Result<Found, Failure> {
    if !is_recording(&args.measured) {
        return Err(Failure::with_help(
            format!("{} is a run: the measured side comes last", args.measured.display()),
            "occupant compare RUN.mcap TEST.csv",
        ));
    }
    let class = match args.treatment.filter {
        Filter::J211 => {
            return Err(Failure::with_help(
                "--filter j211: columns do not say which channels they are",
                "give a class, such as --filter CFC180",
            ));
        }
        filter => filter.class_of(""),
    };
    let ours = measured::read(&args.computed)?;
    let theirs = measured::read(&args.measured)?;
    notes.extend(ours.notes.iter().chain(&theirs.notes).cloned());
    let wanted: Vec<Wanted> = ours
        .signals
        .iter()
        .filter(|s| args.channel.is_empty() || args.channel.contains(&s.name))
        .map(Wanted::from)
        .collect();
    let mut couples = Vec::new();
    for mut measured in pairs(&theirs, &wanted, &args.map, args.seat, notes)? {
        let mut computed = own(&ours, &wanted[measured.channel].name, notes)?;
        if let Some(class) = class {
            computed.filter(class, args.treatment.coefficients)?;
            measured.filter(class, args.treatment.coefficients)?;
        }
        couples.push(Couple {
            channel: computed.signal,
            filter: class_name(class),
            time_s: computed.time_s,
            values: computed.values,
            measured,
        });
    }
    let sources = (source(&args.computed, &ours.sha256), source(&args.measured, &theirs.sha256));
    Ok((couples, sources.0, sources.1))
}

/// A computed signal in SI.
fn own(recording: &Recording, name: &str, notes: &mut Vec<String>) -> Result<Pair, Failure> {
    let signal = recording.signals.iter().find(|s| s.name == name);
    let signal = signal.ok_or_else(|| Failure::plain(format!("no column `{name}`")))?;
    let found = pairs(recording, &[Wanted::from(signal)], &[], '1', notes)?;
    found.into_iter().next().ok_or_else(|| Failure::plain(format!("no column `{name}`")))
}

fn source(path: &Path, sha256: &str) -> Source {
    Source { file: file_name(path), sha256: sha256.to_owned() }
}

fn nothing_common(args: &Args) -> Failure {
    Failure::with_help(
        format!("no signal of {} belongs to a channel of {}", args.measured.display(), args.computed.display()),
        "say which column is which channel: --map 'column[unit]=head.acceleration.x'; for another seat of an ISO-MME test --seat",
    )
}

fn table(answer: &Answer) -> String {
    let mut text = format!(
        "{} against {}; shift {} ms; all ratings at {} kHz\n",
        answer.computed.file,
        answer.measured.file,
        answer.shift_s * 1e3,
        RATE_HZ / 1e3
    );
    for pair in &answer.pairs {
        text.push('\n');
        text.push_str(&pair_table(pair));
    }
    text
}

fn pair_table(pair: &RatedPair) -> String {
    let r = &pair.rating;
    let percent = |x: f64| format!("{:+.1} %", 100.0 * x);
    let mut lines = vec![(
        "compared",
        format!("{:.1} to {:.1} ms, {} samples, filter {}", r.from_s * 1e3, r.to_s * 1e3, r.samples, pair.filter),
    )];
    if let Some(s) = &r.iso18571 {
        let lag = match s.lag_s {
            0.0 => "not shifted".to_owned(),
            lag if lag > 0.0 => format!("computed {:.1} ms late", lag * 1e3),
            lag => format!("computed {:.1} ms early", -lag * 1e3),
        };
        lines.push((
            "ISO/TS 18571",
            format!(
                "{:.3} {}: corridor {:.3}, phase {:.3}, magnitude {:.3}, slope {:.3}; {lag}",
                s.overall, s.grade, s.corridor, s.phase, s.magnitude, s.slope
            ),
        ));
    }
    if let Some(s) = &r.cora {
        lines.push((
            "CORA",
            format!(
                "{:.3}: corridor {:.3}, cross-correlation {:.3} (progression {:.3}, size {:.3}, phase {:.3}); {:.1} to {:.1} ms",
                s.overall, s.corridor, s.cross_correlation, s.progression, s.size, s.phase,
                s.interval_s[0] * 1e3, s.interval_s[1] * 1e3
            ),
        ));
    }
    if let Some(s) = &r.sprague_geers {
        let verdict = if s.within_40_percent { "all within 40 %" } else { "not all within 40 %" };
        lines.push((
            "Sprague–Geers",
            format!(
                "magnitude {}, phase {}, combined {}; {verdict}",
                percent(s.magnitude),
                percent(s.phase),
                percent(s.combined)
            ),
        ));
    }
    if let Some(s) = &r.anova {
        let verdict = if s.within_5_and_35_percent { "within" } else { "not within" };
        lines.push((
            "ANOVA",
            format!(
                "mean residual {}, standard deviation {:.1} %; {verdict} 5 % and 35 %",
                percent(s.mean),
                100.0 * s.standard_deviation
            ),
        ));
    }
    lines.extend(r.problems.iter().map(|p| ("not rated", p.clone())));
    format!("{} against {}\n{}", pair.channel, pair.signal, facts(&lines))
}
