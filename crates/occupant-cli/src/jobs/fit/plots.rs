//! Measured against computed before and after a fit: one sheet for each test, one figure for each channel.

use occupant_core::results::channel::Series;

use super::experiment::in_group;
use super::{Correction, Experiment, Fitting, Target};
use crate::files::history::{Filter, Histories, UnitChoice};
use crate::pictures::plot::{self, Entry, Figure, Material, Overlay, Plot, RunCurves, Sheet, sheet};

/// Runs of an experiment before and after.
pub(crate) struct Pair {
    /// The base scenario; none if it could not be run.
    pub(crate) before: Option<Series>,
    /// The fitted one.
    pub(crate) after: Series,
}

/// The sheet of each test, with its name, the test as corrected. `runs` has a pair for each experiment; `lines` stand below the headings.
///
/// # Errors
/// Histories that cannot be drawn.
pub(crate) fn sheets(
    fitting: &Fitting,
    corrections: &[Correction],
    runs: &[Pair],
    lines: &[String],
) -> Result<Vec<(String, String)>, String> {
    let mut sheets = Vec::new();
    for (number, test) in fitting.tests.iter().enumerate() {
        let experiment = &fitting.experiments[test.experiment];
        let drawn = figures_of(experiment, (number, corrections[number]), &test.file, &runs[test.experiment])?;
        let words = Sheet { title: format!("{}: measured and fitted", test.name), lines: lines.to_vec(), columns: 2 };
        sheets.push((test.name.clone(), sheet(&words, &drawn)));
    }
    Ok(sheets)
}

type Groups = Vec<(Filter, Histories)>;

fn figures_of(
    experiment: &Experiment,
    (test, correction): (usize, Correction),
    file: &str,
    runs: &Pair,
) -> Result<Vec<Figure>, String> {
    let after = experiment.histories(&runs.after)?;
    let before = runs.before.as_ref().map(|series| experiment.histories(series)).transpose()?;
    let own = experiment.targets.iter().filter(|(t, _)| *t == test);
    own.map(|(_, target)| figure(target, correction, file, before.as_ref(), &after)).collect()
}

fn figure(
    target: &Target,
    correction: Correction,
    file: &str,
    before: Option<&Groups>,
    after: &Groups,
) -> Result<Figure, String> {
    let mut pair = target.measured.clone();
    pair.time_s.iter_mut().for_each(|t| *t += correction.offset_s);
    pair.values.iter_mut().for_each(|v| *v /= correction.gain);
    let shown = [before.map(|groups| ("before", groups)), Some(("fitted", after))].into_iter().flatten();
    let runs = shown.map(|(label, groups)| {
        let histories = in_group(groups, target.filter)?.clone();
        Ok(RunCurves { label: label.to_owned(), histories })
    });
    let runs = runs.collect::<Result<Vec<_>, String>>()?;
    let overlay = Overlay {
        channel: target.channel.name.clone(),
        file: file.rsplit(['/', '\\']).next().unwrap_or(file).to_owned(),
        pair,
    };
    let plot = Plot {
        title: target.channel.name.clone(),
        axis: target.channel.unit.quantity().to_owned(),
        entries: vec![Entry { channel: target.channel.name.clone(), label: target.channel.name.clone() }],
        empty: String::new(),
    };
    let material = Material {
        runs: &runs,
        overlays: std::slice::from_ref(&overlay),
        limits: &[],
        x: None,
        units: UnitChoice::Si,
        window_s: target.window_s.map(|t| t + correction.offset_s),
    };
    plot::figure(&plot, &material)
}
