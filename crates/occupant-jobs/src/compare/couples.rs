//! Pairs of computed and measured histories: of a run and a test, two runs, or two tables.

use crash_measures::signal::ChannelClass;
use occupant_core::results::channel::{Channel, channels};

use super::{Remarks, Request};
use crate::base::Failure;
use crate::files::history::{Filter, Treatment, choose, filtered, load};
use occupant_files::measured::{self, Pair, Wanted, is_recording, pairs};
use occupant_files::results::Results;
use occupant_files::signals::Recording;
use occupant_pictures::plot::standard;

/// Largest value of a history that counts as zero.
const ZERO: f64 = 1e-100;

/// A computed and a measured history of one channel, both filtered.
pub(super) struct Couple {
    pub(super) channel: String,
    /// Filter class applied.
    pub(super) class: Option<ChannelClass>,
    pub(super) time_s: Vec<f64>,
    pub(super) values: Vec<f64>,
    pub(super) measured: Pair,
}

/// All couples, and the SHA-256 of both sides.
type Coupled = (Vec<Couple>, [String; 2]);

/// The requested couples.
///
/// # Errors
/// Files that cannot be read, names that are unknown, signals that cannot be filtered.
pub(super) fn couples(request: &Request<'_>, remarks: &mut Remarks) -> Result<Coupled, Failure> {
    let (computed, measured) = (request.computed, request.measured);
    if is_recording(computed) && !is_recording(measured) {
        return Err(Failure::with_help(
            format!("{} is a run: give the run first and the test last", measured.display()),
            "occupant compare RUN.mcap TEST.csv",
        ));
    }
    if is_recording(computed) {
        return two_tables(request, remarks);
    }
    let run = Results::open(computed)?;
    remarks.judge(&run);
    if is_recording(measured) { run_and_test(request, &run, remarks) } else { two_runs(request, &run, remarks) }
}

fn run_and_test(request: &Request<'_>, run: &Results, remarks: &mut Remarks) -> Result<Coupled, Failure> {
    let test = read(request.measured, remarks)?;
    let channels = choose(&run.model, request.channels)?;
    let channels = filterable(channels, &[run], request.treatment, &mut remarks.notes);
    let wanted: Vec<Wanted> = channels.iter().map(|channel| Wanted::of(&run.model, channel)).collect();
    let pairs = pairs(&test, &wanted, request.map, request.seat, &mut remarks.notes)?;
    let sha256 = [run.sha256.clone(), test.sha256];
    if pairs.is_empty() {
        return Ok((Vec::new(), sha256));
    }
    let chosen = pairs.iter().map(|p| channels[p.channel].clone()).collect();
    let histories = load(run, chosen, request.treatment)?;
    remarks.notes.extend(histories.notes);
    let mut couples = Vec::new();
    for (column, mut measured) in histories.columns.into_iter().zip(pairs) {
        let filtered = column.class.map(|class| measured.filter(class, request.treatment.family));
        match filtered.transpose() {
            // only who asks for one class wants it of every channel
            Err(failure) if request.treatment.filter == Filter::J211 => {
                remarks.notes.push(format!("{} is skipped: {}", column.channel.name, failure.words()));
                continue;
            }
            filtered => filtered?,
        };
        let time_s = histories.time_s.clone();
        couples.push(Couple {
            channel: column.channel.name,
            class: column.class,
            time_s,
            values: column.values,
            measured,
        });
    }
    Ok((couples, sha256))
}

/// Two runs: channels of the same name.
fn two_runs(request: &Request<'_>, run: &Results, remarks: &mut Remarks) -> Result<Coupled, Failure> {
    if !request.map.is_empty() {
        return Err(Failure::with_help(
            "--map: channels of two runs have the same names",
            "choose them with --channel",
        ));
    }
    let other = Results::open(request.measured)?;
    remarks.judge(&other);
    let wanted = match request.channels {
        [] => {
            let entries = standard(&run.model, false).into_iter().flat_map(|plot| plot.entries);
            choose(&run.model, &entries.map(|e| e.channel).collect::<Vec<_>>())?
        }
        names => choose(&run.model, names)?,
    };
    let theirs = channels(&other.model);
    let in_both = |c: &Channel| theirs.iter().find(|t| t.name == c.name).cloned();
    let (ours, theirs): (Vec<Channel>, Vec<Channel>) =
        filterable(wanted, &[run, &other], request.treatment, &mut remarks.notes)
            .into_iter()
            .filter_map(|c| Some((c.clone(), in_both(&c)?)))
            .unzip();
    let (ours, theirs) = (load(run, ours, request.treatment)?, load(&other, theirs, request.treatment)?);
    remarks.notes.extend(ours.notes.into_iter().chain(theirs.notes));
    let in_common = ours.columns.len();
    let mut couples = Vec::with_capacity(in_common);
    for (column, other) in ours.columns.into_iter().zip(theirs.columns) {
        let signal = other.channel.name;
        // what never happens in the other run (no contact, no belt) cannot be rated
        if other.values.iter().all(|v| v.abs() < ZERO) {
            remarks
                .notes
                .push(format!("{signal}: zero throughout in {}, so it is not rated", request.measured.display()));
            continue;
        }
        couples.push(Couple {
            channel: column.channel.name,
            class: column.class,
            time_s: ours.time_s.clone(),
            values: column.values,
            measured: Pair { channel: 0, signal, time_s: theirs.time_s.clone(), values: other.values },
        });
    }
    if couples.is_empty() && in_common > 0 {
        let mut reasons = vec![format!("all selected channels are zero throughout in {}", request.measured.display())];
        reasons.extend(remarks.worthless.iter().cloned());
        reasons.dedup();
        return Err(Failure::with_help(
            format!("nothing can be rated: {}", reasons.join("; ")),
            "choose other channels with --channel",
        ));
    }
    Ok((couples, [run.sha256.clone(), other.sha256]))
}

/// Drops channels whose class needs denser outputs than the run has, with a note, if classes are chosen by SAE J211. If
/// one class is requested for all channels, `load` refuses such a channel.
fn filterable(
    channels: Vec<Channel>,
    runs: &[&Results],
    treatment: Treatment,
    notes: &mut Vec<String>,
) -> Vec<Channel> {
    if treatment.filter != Filter::J211 {
        return channels;
    }
    let longest_s = runs.iter().map(|run| run.model.setup().time.output_s).fold(0.0, f64::max);
    let can_be = |channel: &Channel| {
        let class = treatment.filter.class_of(&channel.name);
        class.is_none_or(|class| filtered(&[0.0; 100], longest_s, class, treatment.family).is_ok())
    };
    let (kept, left): (Vec<Channel>, Vec<Channel>) = channels.into_iter().partition(can_be);
    if !left.is_empty() {
        let names: Vec<&str> = left.iter().map(|channel| channel.name.as_str()).collect();
        notes.push(format!(
            "skipped, because outputs every {} ms are too coarse for their SAE J211 classes: {}; run again with output.interval = \"0.1 ms\"",
            (1e9 * longest_s).round() / 1e6,
            names.join(", ")
        ));
    }
    kept
}

/// Computed histories of another program.
fn two_tables(request: &Request<'_>, remarks: &mut Remarks) -> Result<Coupled, Failure> {
    let class = match request.treatment.filter {
        Filter::J211 => {
            return Err(Failure::with_help(
                "--filter j211: the columns have no channel names",
                "give one class for all, such as --filter CFC180",
            ));
        }
        filter => filter.class_of(""),
    };
    let (ours, theirs) = (read(request.computed, remarks)?, read(request.measured, remarks)?);
    let asked = |name: &String| request.channels.is_empty() || request.channels.contains(name);
    let wanted: Vec<Wanted> = ours.signals.iter().filter(|s| asked(&s.name)).map(Wanted::from).collect();
    let mut couples = Vec::new();
    for mut measured in pairs(&theirs, &wanted, request.map, request.seat, &mut remarks.notes)? {
        let mut computed = own(&ours, &wanted[measured.channel].name, &mut remarks.notes)?;
        if let Some(class) = class {
            computed.filter(class, request.treatment.family)?;
            measured.filter(class, request.treatment.family)?;
        }
        let Pair { signal: channel, time_s, values, .. } = computed;
        couples.push(Couple { channel, class, time_s, values, measured });
    }
    Ok((couples, [ours.sha256, theirs.sha256]))
}

fn read(path: &std::path::Path, remarks: &mut Remarks) -> Result<Recording, Failure> {
    let recording = measured::read(path)?;
    remarks.notes.extend(recording.notes.iter().cloned());
    Ok(recording)
}

/// A computed signal in SI.
fn own(recording: &Recording, name: &str, notes: &mut Vec<String>) -> Result<Pair, Failure> {
    let missing = || Failure::plain(format!("no column `{name}`"));
    let signal = recording.signals.iter().find(|s| s.name == name).ok_or_else(missing)?;
    let found = pairs(recording, &[Wanted::from(signal)], &[], '1', notes)?;
    found.into_iter().next().ok_or_else(missing)
}
