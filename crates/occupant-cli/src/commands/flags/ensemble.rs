//! `occupant run --ensemble`: the flags, and the ensemble that they ask for.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use occupant_core::run::batch::Kernel;
use occupant_scenario::Draft;
use occupant_scenario::kind::{self, KINDS, UnitSystem};
use occupant_study::{InputWord, Study, Tolerances, without_place};
use occupant_units::unit::UnitError;
use placed_text::Value;

use super::sweep::engine;
use crate::base::{Existing, Failure, Units, note, refuse_input};
use occupant_files::table::Form;
use occupant_jobs::base::describe;
use occupant_jobs::ensemble::bands::{choose, refuse_too_much};
use occupant_jobs::ensemble::beside_run::{BandFile, Wanted};
use occupant_jobs::files::scenario::{Opened, inputs};
use occupant_pictures::Format;

/// Flags of an ensemble.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Ensemble")]
pub(crate) struct EnsembleArgs {
    /// Run the scenario N times with small random changes of posture, position, pulse and stiffness, and say which results
    /// are stable. The first run has no change
    #[arg(long, value_name = "N", conflicts_with = "resume", value_parser = clap::value_parser!(u32).range(2..=100_000))]
    ensemble: Option<u32>,

    /// Seed of the random changes
    #[arg(long, value_name = "N", default_value = "0", requires = "ensemble")]
    seed: u64,

    /// Number of threads; one per core if absent
    #[arg(long, value_name = "N", requires = "ensemble")]
    threads: Option<NonZeroUsize>,

    /// Size of the changes: posture='1 deg', place='5 mm', path=1% and stiffness=2% if absent. segments=15% also varies mass
    /// and inertia of each body segment. May be repeated
    #[arg(long, value_name = "WHAT=AMOUNT", requires = "ensemble")]
    change: Vec<String>,

    /// Uncertain inputs of a reconstruction that each run draws from ready distributions: scale, delta_v, shift, direction, seat,
    /// posture, belt, slack, friction, mass
    #[arg(long, value_name = "WORDS", requires = "ensemble", value_delimiter = ',')]
    vary: Vec<String>,

    /// Print a paragraph to quote for these results, by name or pattern, such as hic15,head.*
    #[arg(long, value_name = "RESULTS", requires = "ensemble", value_delimiter = ',')]
    quote: Vec<String>,

    /// A limit besides those of rules, such as hic15=700 or 'head_excursion.forward=650 mm', for the probability that it is
    /// exceeded. May be repeated
    #[arg(long, value_name = "RESULT=VALUE", requires = "ensemble")]
    limit: Vec<String>,

    /// A result is stable if the middle 90% of the runs span at most this fraction of the median
    #[arg(long, value_name = "FRACTION", default_value = "10%", requires = "ensemble")]
    stable_within: String,

    /// Write the bands over time as numbers (.csv, .parquet, .xlsx, .mat) or as a picture (.svg, .png). May be repeated
    #[arg(long, value_name = "FILE", requires = "ensemble")]
    bands: Vec<PathBuf>,

    /// Channels of the bands, by name or pattern, such as 'head.*,belt.*.force'; the main accelerations, forces and
    /// positions if absent
    #[arg(long = "channel", alias = "channels", value_name = "NAMES", requires = "ensemble")]
    channels: Vec<String>,
}

impl EnsembleArgs {
    /// The ensemble requested by the flags, if any.
    ///
    /// # Errors
    /// Amounts, channels and files that cannot be.
    pub(crate) fn wanted(
        &self,
        draft: &Draft,
        opened: &Opened,
        scenario: &Path,
        (existing, units): (Existing, Units),
    ) -> Result<Option<Wanted>, Failure> {
        let Some(members) = self.ensemble.map(u64::from) else {
            return Ok(None);
        };
        let changes = changes(&self.change)?;
        let lost = without_place(draft, &changes);
        let asked = |name: &&&str| self.change.iter().any(|change| change.trim_start().starts_with(**name));
        if let Some(name) = lost.iter().find(asked) {
            let found = format!("--change {name}: the scenario has nothing of this kind to change");
            return Err(Failure::with_help(found, "leave it out"));
        }
        if !lost.is_empty() {
            note(&format!("not changed, because the scenario has none: {}", lost.join(", ")));
        }
        let within = part("--stable-within", &self.stable_within)?;
        let channels = choose(&opened.model, &self.channels)?;
        refuse_too_much(members, channels.len(), opened.model.output_count())?;
        let files = self.bands.iter().map(|path| {
            inputs(scenario, &opened.loaded).iter().try_for_each(|input| refuse_input(path, input))?;
            if existing == Existing::Keep && path.exists() {
                let found = format!("{} exists", path.display());
                return Err(Failure::with_help(found, "--force replaces it"));
            }
            band_file(path).map(|kind| (path.clone(), kind))
        });
        let name = scenario.display().to_string();
        let words = self.vary.iter().map(|word| input(word)).collect::<Result<Vec<_>, _>>()?;
        let mut study = Study::of_ensemble(draft.clone(), name, members, self.seed, &changes);
        let varied =
            study.vary(&words).map_err(|found| Failure::with_help(format!("--vary: {found}"), "leave it out"))?;
        let inputs = varied.iter().map(|p| describe::input(p, &units.told_of(p, draft))).collect();
        Ok(Some(Wanted {
            inputs,
            limits: self.limit.clone(),
            quote: self.quote.clone(),
            files: files.collect::<Result<_, _>>()?,
            study,
            seed: self.seed,
            changes,
            within,
            engine: engine(self.threads, Kernel::best())?,
            channels,
            existing,
            units,
        }))
    }
}

/// The input with this word.
fn input(word: &str) -> Result<InputWord, Failure> {
    let words = InputWord::ALL.map(InputWord::word);
    let found = InputWord::ALL.into_iter().find(|input| input.word() == word.trim());
    found.ok_or_else(|| {
        Failure::with_help(format!("--vary {word}: unknown input"), &format!("give {}", words.join(", ")))
    })
}

fn band_file(path: &Path) -> Result<BandFile, Failure> {
    match (Form::of(path), Format::of(path)) {
        (Some(form), _) => Ok(BandFile::Table(form)),
        (None, Some(format)) => Ok(BandFile::Picture(format)),
        (None, None) => Err(Failure::with_help(
            format!("--bands {}: unknown file format", path.display()),
            "give NAME.csv, .parquet, .xlsx, .mat, .svg or .png",
        )),
    }
}

/// Largest relative change of a segment, so that it keeps some mass.
const MOST_OF_A_SEGMENT: f64 = 0.99;

/// The standard perturbations, changed by the flags.
fn changes(given: &[String]) -> Result<Tolerances, Failure> {
    let mut changes = Tolerances::default();
    for text in given {
        let refused = |found: &str| {
            Failure::with_help(
                format!("--change {text}: {found}"),
                "give posture='1 deg', place='5 mm', path='1 %', stiffness='2 %' or segments='15 %'",
            )
        };
        let (what, amount) = text.split_once('=').ok_or_else(|| refused("it has no `=`"))?;
        let amount = amount.trim();
        let si = |value: Result<f64, UnitError>| {
            value.map_err(|e| refused(&format!("{}; expected {}", e.found, e.expected)))
        };
        let (to, value, most) = match what.trim() {
            "posture" => (&mut changes.posture_rad, si(measured(kind::ANGLE, amount))?, f64::INFINITY),
            "place" => (&mut changes.place_m, si(measured(kind::LENGTH, amount))?, f64::INFINITY),
            "path" => (&mut changes.path, si(ratio(amount))?, 1.0),
            "stiffness" => (&mut changes.stiffness, si(ratio(amount))?, 1.0),
            "segments" => (&mut changes.segments, si(ratio(amount))?, MOST_OF_A_SEGMENT),
            other => return Err(refused(&format!("unknown name `{other}`"))),
        };
        if !(0.0..=most).contains(&value) {
            return Err(refused("the amount is out of range"));
        }
        *to = value;
    }
    Ok(changes)
}

/// A fraction such as `10 %` or 0.1, above 0.
fn part(flag: &str, text: &str) -> Result<f64, Failure> {
    let refused =
        |found: String| Failure::with_help(format!("{flag} {text}: {found}"), "give a fraction such as '10 %'");
    let value = ratio(text);
    let value = value.map_err(|e| refused(format!("{}; expected {}", e.found, e.expected)))?;
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(refused("it is not above 0".to_owned())) }
}

/// A value with its unit, in SI.
fn measured(kind: usize, text: &str) -> Result<f64, UnitError> {
    KINDS[kind].si(&Value::String(text.to_owned()), UnitSystem::Si)
}

/// `10 %` or a bare 0.1.
fn ratio(text: &str) -> Result<f64, UnitError> {
    KINDS[kind::RATIO].read(text.trim())
}
