//! Measured against computed before and after a fit: one sheet for each test, one figure for each channel.

use occupant_core::results::channel::Series;

use super::experiment::in_group;
use super::{Correction, Fitting, Target};
use crate::files::history::{Filter, Histories, UnitChoice};
use occupant_pictures::plot::{self, Entry, Figure, Material, Overlay, Plot, RunCurves, Sheet, sheet};

/// Runs of an experiment before and after.
pub struct Pair {
    /// The base scenario; none if it could not be run.
    pub before: Option<Series>,
    /// The fitted one.
    pub after: Series,
}

/// A sheet per test, with its name and the corrected test. `runs` has a pair per experiment; `lines` are below the
/// headings.
///
/// # Errors
/// Histories that cannot be drawn.
pub fn sheets(
    fitting: &Fitting,
    corrections: &[Correction],
    runs: &[Pair],
    lines: &[String],
) -> Result<Vec<(String, String)>, String> {
    let mut sheets = Vec::new();
    for (number, test) in fitting.tests.iter().enumerate() {
        let experiment = &fitting.experiments[test.experiment];
        let Pair { before, after } = &runs[test.experiment];
        let computed = [("before", before.as_ref()), ("fitted", Some(after))];
        let computed = computed.into_iter().filter_map(|(label, series)| {
            let histories = experiment.histories(series?);
            Some(histories.map(|groups| (label, groups)))
        });
        let computed = computed.collect::<Result<Vec<_>, String>>()?;
        let own = experiment.targets.iter().filter(|(test, _)| *test == number);
        let figures = own.map(|(_, target)| figure(target, corrections[number], &test.file, &computed));
        let words = Sheet { title: format!("{}: measured and fitted", test.name), lines: lines.to_vec(), columns: 2 };
        sheets.push((test.name.clone(), sheet(&words, &figures.collect::<Result<Vec<_>, _>>()?)));
    }
    Ok(sheets)
}

/// Histories of a run by filter, and the name of the run.
type Computed = (&'static str, Vec<(Filter, Histories)>);

fn figure(target: &Target, correction: Correction, file: &str, computed: &[Computed]) -> Result<Figure, String> {
    let mut pair = target.measured.clone();
    pair.time_s.iter_mut().for_each(|t| *t += correction.offset_s);
    pair.values.iter_mut().for_each(|v| *v /= correction.gain);
    let curves = |(label, groups): &Computed| {
        let histories = in_group(groups, target.filter)?.clone();
        Ok(RunCurves { label: (*label).to_owned(), histories })
    };
    let runs = computed.iter().map(curves).collect::<Result<Vec<_>, String>>()?;
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
