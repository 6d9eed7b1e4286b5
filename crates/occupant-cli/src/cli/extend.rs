//! The procedure of 1970 for longer runs: run a deck to its end, then punch the deck that goes on from there.

use cardio_legacy::{
    CompartmentLayout, ConvertOptions, Deck, PathSource, RunEnd, spine_rest, write_file,
};
use occupant_core::model::Model;
use occupant_core::recorder::Watch;
use occupant_core::sample::Sample;
use occupant_core::scenario::{Draft, Format};
use occupant_core::simulate::{Status, simulate};

use super::exit::Failure;
use super::speak::say;

/// Runs a deck's scenario and gives the file of the deck that goes on from there.
///
/// # Errors
/// A scenario that is refused, a run that does not reach its end, a time before that end.
pub fn extend(
    deck: &Deck,
    toml: &str,
    options: &ConvertOptions,
    final_s: f64,
    quiet: bool,
) -> Result<Vec<u8>, Failure> {
    let layout = match &options.compartment {
        Some(layout) => layout.clone(),
        None => CompartmentLayout::reconstruction().map_err(Failure::plain)?,
    };
    let beside = match &options.path {
        Some(PathSource::Csv { text, .. }) => text.clone(),
        _ => String::new(),
    };
    let resolver = |_: &str| Ok(beside.clone().into_bytes());
    let refused =
        |problems: occupant_core::scenario::Diagnostics| Failure::CouldNotRun(problems.to_string());
    let loaded = Draft::read(toml, Format::Toml, "converted scenario")
        .and_then(|d| d.load(&resolver))
        .map_err(refused)?;
    let (model, _) = loaded.model().map_err(refused)?;
    let end = run_end(&model, &layout)?;
    if final_s.is_nan() || final_s <= end.time_s {
        let found = format!(
            "--extend {final_s} s lies not after the end of the run, {} s",
            end.time_s
        );
        return Err(Failure::with_help(found, "give a later time"));
    }
    if !quiet {
        say(&format!(
            "ran to {} s; cards carry no greatest deformations, so the extension is approximate",
            end.time_s
        ));
    }
    Ok(write_file(&[deck.extended(&end, final_s)]))
}

fn run_end(model: &Model, layout: &CompartmentLayout) -> Result<RunEnd, Failure> {
    let (mut rest, mut end) = (None, None);
    let watch = Watch(|sample: &Sample<'_>| {
        let rest = *rest.get_or_insert_with(|| spine_rest(sample));
        end = Some(RunEnd::after(rest, sample, layout));
    });
    let outcome =
        simulate(model, watch).map_err(|error| Failure::BrokeOff(format!("error: {error}")))?;
    match (outcome.status, end) {
        (Status::Completed, Some(end)) => Ok(end),
        (status, _) => Err(Failure::BrokeOff(format!(
            "error: the run did not reach its end: {status:?}"
        ))),
    }
}
