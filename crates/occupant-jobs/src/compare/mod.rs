//! Rating of a run against a test or another run, channel by channel.

mod couples;
mod protocol;
mod rating;

use std::path::Path;

use serde::Serialize;

use crate::base::text_table::Align::{Left, Right};
use crate::base::text_table::{NONE, Table, facts};
use crate::base::{Failure, file_name, program};
use crate::files::history::{Treatment, class_name};
use couples::{Couple, couples};
use occupant_files::measured::MapArgument;
use occupant_files::results::Results;
use rating::{Rating, rate};

pub use protocol::{PROTOCOLS, Protocol, Validation};
pub use rating::{RATE_HZ, Track, Window, overlap, sampled};

/// A requested comparison.
pub struct Request<'a> {
    /// Results of a run.
    pub computed: &'a Path,
    /// The measured signals.
    pub measured: &'a Path,
    /// Names and patterns; all common channels if empty.
    pub channels: &'a [String],
    /// Assignment of signals to channels.
    pub map: &'a [MapArgument],
    /// Position of the occupant in ISO-MME codes.
    pub seat: char,
    /// Time window.
    pub window: Window,
    /// Filter and interval.
    pub treatment: Treatment,
    /// Description of the filter.
    pub filter: String,
    /// The protocol that the model is validated by.
    pub protocol: Option<Protocol>,
}

/// The ratings, as `--json` prints them.
#[derive(Serialize)]
pub struct Comparison {
    program: String,
    computed: Source,
    measured: Source,
    filter: String,
    shift_s: f64,
    pairs: Vec<RatedPair>,
    /// Result of the protocol.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub protocol: Option<Validation>,
    /// Notes for the reader.
    pub notes: Vec<String>,
    /// Reasons why results are invalid, by run.
    #[serde(skip)]
    pub worthless: Vec<String>,
}

/// Metrics of the overview: name, key of the metric and of its score.
const METRICS: [(&str, &str, &str); 3] = [
    ("ISO/TS 18571", "iso18571", "overall"),
    ("CORA", "cora", "overall"),
    ("Sprague–Geers", "sprague_geers", "combined"),
];

/// A file that was read, and its SHA-256.
#[derive(Serialize)]
pub struct Source {
    /// The file.
    pub file: String,
    /// Its SHA-256.
    pub sha256: String,
}

#[derive(Serialize)]
struct RatedPair {
    channel: String,
    signal: String,
    filter: String,
    #[serde(flatten)]
    rating: Rating,
}

/// Notes collected during the comparison.
#[derive(Default)]
struct Remarks {
    notes: Vec<String>,
    worthless: Vec<String>,
}

impl Remarks {
    /// Applies the common rule to a run: one that failed or is out of balance has no valid results.
    fn judge(&mut self, run: &Results) {
        let name = run.path.display();
        if let Some(reason) = run.ending().and_then(|ending| ending.reason()) {
            self.worthless.push(format!("{name}: {reason}"));
        }
    }
}

/// Rates all pairs.
///
/// # Errors
/// Files that cannot be read, no signal in common, a pair without a common time.
pub fn compare(request: &Request<'_>) -> Result<Comparison, Failure> {
    let mut remarks = Remarks::default();
    let (couples, sha256) = couples(request, &mut remarks)?;
    if couples.is_empty() {
        return Err(nothing_common(request));
    }
    let rated = |couple: Couple| {
        let ours = Track { time_s: &couple.time_s, values: &couple.values };
        let theirs = Track { time_s: &couple.measured.time_s, values: &couple.measured.values };
        let rating = rate(ours, theirs, request.window)
            .map_err(|reason| Failure::plain(format!("{} cannot be compared: {reason}", couple.channel)))?;
        let filter = class_name(couple.class);
        Ok(RatedPair { channel: couple.channel, signal: couple.measured.signal, filter, rating })
    };
    let pairs = couples.into_iter().map(rated).collect::<Result<Vec<_>, Failure>>()?;
    let protocol = request.protocol.map(|protocol| protocol::validate(protocol, request, &pairs)).transpose()?;
    let [computed, measured] = sha256;
    let source = |path: &Path, sha256| Source { file: file_name(path), sha256 };
    Ok(Comparison {
        program: program(),
        computed: source(request.computed, computed),
        measured: source(request.measured, measured),
        filter: request.filter.clone(),
        shift_s: request.window.shift_s,
        pairs,
        protocol,
        notes: remarks.notes,
        worthless: remarks.worthless,
    })
}

fn nothing_common(request: &Request<'_>) -> Failure {
    let (computed, measured) = (request.computed.display(), request.measured.display());
    Failure::with_help(
        format!("no signal of {measured} matches a channel of {computed}"),
        "assign columns to channels: --map 'column[unit]=head.acceleration.x'; for another seat of an ISO-MME test use --seat",
    )
}

impl Comparison {
    /// All pairs in one line, or in a table if there are several.
    fn at_a_glance(&self) -> String {
        let scores = |pair: &RatedPair| METRICS.map(|(_, metric, score)| pair.rating.score(metric, score));
        let mean = |i: usize| {
            let known: Vec<f64> = self.pairs.iter().filter_map(|pair| scores(pair)[i]).collect();
            let sum: f64 = known.iter().sum();
            (!known.is_empty()).then(|| format!("{} {:.3}", METRICS[i].0, sum / known.len() as f64))
        };
        let count =
            if self.pairs.len() == 1 { "1 channel".to_owned() } else { format!("{} channels", self.pairs.len()) };
        let means: Vec<String> = (0..METRICS.len()).filter_map(mean).collect();
        let line =
            format!("{count}; mean of {}\n", if means.is_empty() { "nothing".to_owned() } else { means.join(", ") });
        if self.pairs.len() == 1 {
            return line;
        }
        let mut table = Table::new(&[(Left, &["channel"]), (Right, &METRICS.map(|(name, ..)| name))]);
        for pair in &self.pairs {
            let shown = scores(pair).map(|score| score.map_or(NONE.to_owned(), |score| format!("{score:.3}")));
            table.row(std::iter::once(pair.channel.clone()).chain(shown));
        }
        format!("{line}\n{}", table.text())
    }

    /// The ratings as text.
    pub fn text(&self) -> String {
        let mut text = format!(
            "{} compared with {}; shift {} ms; all ratings at {} kHz\n",
            self.computed.file,
            self.measured.file,
            self.shift_s * 1e3,
            RATE_HZ / 1e3
        );
        text.push_str(&self.at_a_glance());
        text.extend(self.protocol.iter().map(|protocol| format!("\n{}", protocol.text())));
        for pair in &self.pairs {
            let lines = facts(&pair.rating.lines(&pair.filter));
            text.push_str(&format!("\n{} against {}\n{lines}", pair.channel, pair.signal));
        }
        text
    }
}
