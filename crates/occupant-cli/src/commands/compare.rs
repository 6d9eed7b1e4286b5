//! `occupant compare`.

use std::path::PathBuf;

use super::flags::history::{TestArgs, WindowArgs};
use crate::base::{Done, Failure, json, note, one_of, print, say};
use occupant_jobs::compare::{PROTOCOLS, Protocol, Request, Window, compare as rate};
use occupant_jobs::files::history::Treatment;

/// Rate how well a run matches a test: ISO/TS 18571, CORA, Sprague–Geers, ANOVA
///
/// The test is a CSV table, an ISO-MME test (its folder or .mme file) or another run. A signal is matched to a channel
/// by --map, by its name, or by its ISO-MME code; SAE J211 signs are converted. Both sides are filtered alike, cut to
/// their common time and resampled linearly to 10 kHz, as ISO/TS 18571 requires. Exit code 1 if a run failed or its
/// energy balance is off by more than 10 %: its ratings then mean nothing.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The results of `occupant run`, or computed histories as CSV or ISO-MME
    #[arg(value_name = "COMPUTED")]
    computed: PathBuf,

    /// The test: CSV, ISO-MME folder or .mme file, or another run
    #[arg(value_name = "MEASURED")]
    measured: PathBuf,

    /// Channels by name or pattern; if absent, all channels of the test, or those of the standard plots if it is a run
    #[arg(long, alias = "channels", value_name = "NAMES")]
    channel: Vec<String>,

    #[command(flatten)]
    test: TestArgs,

    #[command(flatten)]
    window: WindowArgs,

    #[command(flatten)]
    treatment: Treatment,

    /// Validate the model by a protocol for virtual testing: required sensors with at least 0.5 by ISO/TS 18571,
    /// criteria that lie less than 30 % of their limits apart
    #[arg(long, value_name = "PROTOCOL", value_parser = one_of(&PROTOCOLS))]
    protocol: Option<Protocol>,

    /// Exit with code 1 if the model is not valid by the protocol
    #[arg(long, requires = "protocol")]
    strict: bool,

    /// Print JSON instead of a table
    #[arg(long)]
    json: bool,
}

/// Compares a run with a test.
pub(crate) fn compare(args: &Args) -> Result<Done, Failure> {
    let comparison = rate(&Request {
        computed: &args.computed,
        measured: &args.measured,
        channels: &args.channel,
        map: &args.test.map,
        seat: args.test.seat,
        window: Window { from_s: args.window.from, to_s: args.window.to, shift_s: args.test.shift },
        treatment: args.treatment,
        filter: args.treatment.words(),
        protocol: args.protocol,
    })?;
    comparison.notes.iter().for_each(note);
    print(&if args.json { json(&comparison)? } else { comparison.text() })?;
    for reason in &comparison.worthless {
        say(&format!("error: the ratings mean nothing: {reason}"));
    }
    let is_valid = comparison.protocol.as_ref().is_none_or(|protocol| protocol.is_valid() == Some(true));
    let is_well = comparison.worthless.is_empty() && (is_valid || !args.strict);
    Ok(if is_well { Done::Well } else { Done::Unwell })
}
