//! Measures of a run with other filters, limits of another dummy, or readings at another interval.

use std::collections::BTreeMap;

use crash_measures::injury::{Filtering, Measure, Options};
use crash_measures::measure::Dummy;
use crash_measures::signal::CfcFamily;
use occupant_core::results::recorder::Recorder;
use occupant_core::results::summary::{Caveat, Summary};
use serde::Serialize;

use crate::base::{Failure, Units};
use crate::judged::Impact;
use occupant_files::results::Results;

/// Sample interval of filtered channels, s: the 10 kHz of SAE J211.
const FILTERED_S: f64 = 1e-4;

/// Filters: names on the command line, names in help.
pub const FILTERS: [(&str, &str, Asked); 4] = [
    ("none", "No filter", Asked::None),
    ("j211", "The SAE J211 class of each signal", Asked::Classes(None)),
    ("sae-j211", "The same with SAE J211 coefficients (older spelling)", Asked::Classes(Some(CfcFamily::SaeJ211))),
    ("iso6487", "The same with ISO 6487 coefficients (older spelling)", Asked::Classes(Some(CfcFamily::Iso6487))),
];

/// Requested filter, and the coefficients that an old name implies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Asked {
    /// None.
    None,
    /// The class of each signal.
    Classes(Option<CfcFamily>),
}

/// Dummies: names on the command line, names in help.
pub const DUMMIES: [(&str, &str, Dummy); 11] = [
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

/// Settings of measures: a filter, the coefficients where it names none, and a dummy if one is asked for.
pub fn options(filter: Asked, coefficients: CfcFamily, dummy: Option<Dummy>) -> Options {
    let filtering = match filter {
        Asked::None => Filtering::None,
        Asked::Classes(family) => Filtering::Classes(family.unwrap_or(coefficients)),
    };
    let filtered = Options { filtering, ..Options::default() };
    dummy.map_or(filtered, |dummy| filtered.with(dummy))
}

/// The JSON answer.
#[derive(Serialize)]
pub struct Answer<'a> {
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
pub struct Judged {
    /// Its file.
    pub file: String,
    /// The run.
    pub results: Results,
    /// Its summary, with the measures.
    pub summary: Summary,
    /// What happened to the vehicles.
    pub impact: Impact,
    /// Interval of the readings, ms.
    pub interval_ms: f64,
    /// Notes for the reader.
    pub notes: Vec<String>,
}

impl Judged {
    /// Judges a run; with `again_s` it is run again with readings at this interval, s, seen by `watcher`. Reasons are in
    /// these units.
    ///
    /// # Errors
    /// A run that cannot be computed again.
    pub fn of(
        results: Results,
        again_s: Option<f64>,
        options: Options,
        units: Units,
        watcher: impl Recorder,
    ) -> Result<Self, Failure> {
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
                results.summary_again(options, interval_s, (&mut impact, watcher))?
            }
        };
        // a dummy that was asked for has its limits, whatever the direction
        if options.by_size {
            impact.judge(&mut summary, &results.model);
            notes.extend(impact.reasons(units));
        }
        Ok(Judged { file: results.path.display().to_string(), results, summary, impact, interval_ms, notes })
    }

    /// What `--json` prints.
    pub fn answer(&self) -> Answer<'_> {
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
