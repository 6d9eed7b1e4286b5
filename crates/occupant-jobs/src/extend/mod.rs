//! The procedure of 1970 for longer runs: run a deck to its end, then punch the deck that continues it.

mod cost;

use std::path::Path;

use cardio_legacy::{
    CompartmentLayout, ConvertOptions, Deck, FromScenario, PathSource, RunEnd, spine_rest, write_file,
};
use occupant_core::model::Model;
use occupant_core::results::outcome::Status;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::{attempt, replay};
use occupant_core::vehicle::VehiclePath;
use occupant_scenario::{Draft, Format};

use crate::base::{Failure, file_name, say};
use crate::files::scenario;
use crate::run::FirstOutput;
use occupant_files::mcap::StoredRun;

/// Runs a deck's scenario and returns the file of the deck that continues it.
///
/// # Errors
/// A scenario that is refused, a run that does not reach its end, a time before that end or beyond the vehicle's path.
pub fn extend(
    deck: &Deck,
    toml: &str,
    options: &ConvertOptions,
    final_s: f64,
    quiet: bool,
) -> Result<Vec<u8>, Failure> {
    let layout = layout_or_ours(options.compartment.as_ref())?;
    let beside = match &options.path {
        Some(PathSource::Csv { text, .. }) => text.clone(),
        _ => String::new(),
    };
    let resolver = |_: &str| Ok(beside.clone().into_bytes());
    let refused = |problems: occupant_scenario::Diagnostics| Failure::CouldNotRun(problems.to_string());
    let loaded =
        Draft::read(toml, Format::Toml, "converted scenario").and_then(|d| d.load(&resolver)).map_err(refused)?;
    let (model, _) = loaded.model().map_err(refused)?;
    refuse_time(final_s, model.setup().time.end_s, &model)?;
    let end = run_end(&model, &layout)?;
    if !quiet {
        say(&format!("ran to {} s", end.time_s));
    }
    let next = deck.extended(&end, final_s).map_err(|found| Failure::CouldNotRun(found.to_string()))?;
    if !quiet {
        let longer = Draft::read(toml, Format::Toml, "converted scenario").map_err(refused)?;
        let goes_on = || cost::until(longer, final_s, &resolver).and_then(|model| cost::histories(&model, None));
        say(&cost::words(goes_on(), cost::of_deck(&next, options, &resolver)));
    }
    Ok(write_file(&[next]))
}

/// The deck that continues from the last checkpoint of a result file, with remarks.
///
/// # Errors
/// A file without checkpoint or scenario, a scenario that does not fit on cards, a time before the file's end or beyond the
/// vehicle's path.
pub fn extend_run(
    file: &Path,
    bytes: &[u8],
    layout: Option<&CompartmentLayout>,
    final_s: f64,
) -> Result<FromScenario, Failure> {
    let name = file.display();
    let stored = StoredRun::read(bytes).map_err(|e| Failure::plain(format!("{name}: {e}")))?;
    let last = stored.checkpoints.last();
    let lacking = || Failure::plain(format!("{name} holds no checkpoint{}", stored.because()));
    let last = last.ok_or_else(lacking)?;
    let (loaded, model, _) = scenario::stored(file, &stored)?;
    refuse_time(final_s, last.time_s, &model)?;
    let cards = Deck::from_scenario(&loaded, layout);
    let mut cards = cards.map_err(|e| Failure::CouldNotRun(format!("error: {name}: {e}")))?;
    let layout = layout_or_ours(layout)?;
    let broke = |error: &dyn std::error::Error| Failure::broke_off(format!("{name}: {error}"));
    let (mut rest, mut end) = ([0.0; 2], None);
    attempt(&model, (Watch(|s: &Sample<'_>| rest = spine_rest(s)), FirstOutput)).map_err(|e| broke(&e))?;
    let mut watch = Watch(|s: &Sample<'_>| end = RunEnd::after(rest, s, &layout));
    replay(&model, last, &mut watch).map_err(|e| broke(&e))?;
    let end = end.ok_or_else(|| Failure::plain(format!("{name} holds no checkpoint")))?;
    let next = cards.deck.extended(&end, final_s);
    cards.deck = next.map_err(|found| Failure::CouldNotRun(format!("{name}: {found}")))?;
    cards.remarks.extend(stored.flaw().map(|flaw| format!("{name} is {flaw}")));
    cards.remarks.push(format!("continues from t = {} s; `occupant run --resume` is exact", end.time_s));
    let resolver = |name: &str| table_of(&stored, name);
    let longer = loaded.explicit().to_toml().map_err(|error| error.to_string());
    let goes_on = longer
        .and_then(|text| Draft::read(&text, Format::Toml, "scenario").map_err(|problems| problems.to_string()))
        .and_then(|draft| cost::until(draft, final_s, &resolver))
        .and_then(|model| cost::histories(&model, Some(last)));
    cards.remarks.push(cost::words(goes_on, cost::of_deck(&cards.deck, &ConvertOptions::default(), &resolver)));
    Ok(cards)
}

/// A table stored in a result file.
fn table_of(stored: &StoredRun, name: &str) -> Result<Vec<u8>, String> {
    let found = stored.attachments.get(name).or_else(|| stored.attachments.get(&file_name(Path::new(name))));
    found.cloned().ok_or_else(|| format!("there is no {name}"))
}

/// The given compartment, else the built-in reconstruction.
fn layout_or_ours(given: Option<&CompartmentLayout>) -> Result<CompartmentLayout, Failure> {
    given.cloned().map_or_else(|| CompartmentLayout::reconstruction().map_err(Failure::plain), Ok)
}

/// Refuses a time not after the end of the run, or without stations of the path.
fn refuse_time(final_s: f64, end_s: f64, model: &Model) -> Result<(), Failure> {
    if let VehiclePath::Table(path) = &model.setup().path
        && final_s > path.span_s().1
    {
        let last_s = path.span_s().1;
        let found = format!("--extend {final_s} s is after the last station of the vehicle's path, {last_s} s");
        return Err(Failure::with_help(found, "add stations to the path, or give an earlier time"));
    }
    if final_s.is_nan() || final_s <= end_s {
        let found = format!("--extend {final_s} s is not after the end of the run, {end_s} s");
        return Err(Failure::with_help(found, "give a later time"));
    }
    Ok(())
}

fn run_end(model: &Model, layout: &CompartmentLayout) -> Result<RunEnd, Failure> {
    let (mut rest, mut end) = (None, None);
    let watch = Watch(|sample: &Sample<'_>| {
        let rest = *rest.get_or_insert_with(|| spine_rest(sample));
        end = RunEnd::after(rest, sample, layout);
    });
    let outcome = attempt(model, watch).map_err(Failure::broke_off)?;
    match (outcome.status, end) {
        (Status::Completed, Some(end)) => Ok(end),
        (status, _) => Err(Failure::broke_off(format!("the run did not reach its end: {status:?}"))),
    }
}
