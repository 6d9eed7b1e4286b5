//! The error of a run's integration, estimated by a second run with a finer one.

use nalgebra::Point3;
use occupant_core::model::Model;
use occupant_core::model::setup::{Integrator, Setup};
use occupant_core::results::outcome::Status;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::{Caveat, Figure, Summarizer, Summary};
use occupant_core::run::simulate::attempt;
use serde::Serialize;

use crate::base::text_table::{facts, number};
use crate::base::{Failure, Interrupt, Show, Units};
use crate::files::scenario::Opened;

/// Relative difference above which a figure is listed.
const NAMED: f64 = 1e-3;
/// Relative difference above which a figure is undetermined.
const UNDETERMINED: f64 = 0.05;
/// Differences that count as zero, by SI unit; 1e-3 for others, including plain numbers.
const LEAST: [(&str, f64); 4] = [("m", 1e-4), ("s", 1e-4), ("N", 1.0), ("m/s^2", 0.1)];
/// Largest number of figures listed, the worst first.
const MOST_NAMED: usize = 5;
/// Difference of head paths, m, above which the motion counts as chaotic.
const CHAOTIC_M: f64 = 5e-3;

/// Position of the head's c.g., or of the last segment without a head, m, in vehicle axes.
pub fn head_m(sample: &Sample<'_>) -> Point3<f64> {
    let tree = sample.model.body().tree;
    sample.cg_m(tree.landmarks().head.unwrap_or_else(|| tree.segment(tree.segments().len() - 1)))
}

/// Differences between a run and one with finer integration.
#[derive(Debug, Serialize)]
pub struct ErrorEstimate {
    /// Description of the finer integration.
    against: &'static str,
    /// Its evaluations.
    evaluations: u64,
    /// Largest distance between the head's c.g. positions at any output, m.
    head_path_m: f64,
    /// Every figure of the summary that both runs have.
    figures: Vec<FigureError>,
}

#[derive(Debug, Serialize)]
struct FigureError {
    name: String,
    unit: &'static str,
    /// Value in the run.
    value: f64,
    /// Value in the run minus that in the finer one.
    difference: f64,
}

impl FigureError {
    /// Whether the difference exceeds rounding errors around zero, such as lateral motion in a planar case.
    fn matters(&self) -> bool {
        let least = LEAST.iter().find(|(unit, _)| *unit == self.unit).map_or(1e-3, |(_, least)| *least);
        self.difference.abs() > least
    }

    /// Difference relative to the larger value; 0 for two zeros.
    fn relative(&self) -> f64 {
        let greatest = self.value.abs().max((self.value - self.difference).abs());
        if greatest > 0.0 { self.difference.abs() / greatest } else { 0.0 }
    }
}

/// Repeats the scenario of `summary`, with the head along `path`, with a quarter of the step or a tenth of the
/// tolerances.
///
/// # Errors
/// The finer run does not complete.
pub fn estimate(
    opened: &Opened,
    summary: &Summary,
    path: &[Point3<f64>],
    interrupt: &Interrupt,
    show: Show,
) -> Result<ErrorEstimate, Failure> {
    let unfinished = |reason: String| Failure::broke_off(format!("the error cannot be estimated: {reason}"));
    let setup = opened.model.setup();
    let (integrator, against) = finer(setup.integrator);
    let model = Model::new(Setup { integrator, ..setup.clone() })
        .map_err(|problems| unfinished(opened.loaded.diagnose(&problems).to_string()))?;
    let (mut summarizer, mut finer_path) = (Summarizer::new(), Vec::new());
    let bar = show.bar(model.output_count() as u64, "outputs of the finer run");
    let head = Watch(|sample: &Sample<'_>| {
        finer_path.push(head_m(sample));
        bar.iter().for_each(|bar| bar.set_position(sample.index as u64 + 1));
    });
    let outcome = attempt(&model, (interrupt.clone(), (&mut summarizer, head)));
    bar.iter().for_each(|bar| bar.clear());
    let outcome = outcome.map_err(|error| unfinished(error.to_string()))?;
    match (outcome.status, summarizer.summary(None)) {
        (Status::Completed, Some(finer)) => Ok(ErrorEstimate {
            against,
            evaluations: outcome.effort.evaluations,
            head_path_m: path.iter().zip(&finer_path).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max),
            figures: differences(summary.figures(&opened.model), finer.figures(&model)),
        }),
        (Status::Failed(error), _) => Err(unfinished(error.to_string())),
        _ => Err(unfinished("the finer run was interrupted".to_owned())),
    }
}

fn finer(integrator: Integrator) -> (Integrator, &'static str) {
    match integrator {
        Integrator::Rk4 { step_s } => (Integrator::Rk4 { step_s: step_s / 4.0 }, "rk4 at a quarter of the step"),
        Integrator::Adaptive { relative, absolute_m, absolute_m_s, min_step_s, max_step_s } => (
            Integrator::Adaptive {
                relative: relative / 10.0,
                absolute_m: absolute_m / 10.0,
                absolute_m_s: absolute_m_s / 10.0,
                min_step_s: min_step_s / 100.0,
                max_step_s,
            },
            "adaptive at a tenth of the tolerances",
        ),
    }
}

fn differences(run: Vec<Figure>, finer: Vec<Figure>) -> Vec<FigureError> {
    // the balance is an error itself
    let told = |figure: &Figure| !figure.is_of_work() && figure.name != "energy.balance_error";
    let both = run.into_iter().zip(finer).filter(|(a, _)| told(a));
    both.filter_map(|(a, b)| {
        let (value, finer) = (a.value?, b.value?);
        Some(FigureError { name: a.name, unit: a.unit, value, difference: value - finer })
    })
    .collect()
}

impl ErrorEstimate {
    /// Caveat on figures that differ in the finer run, and on the measures of the same names.
    pub fn caveat(&self, summary: &Summary) -> Option<Caveat> {
        let off = self.figures.iter().filter(|figure| figure.relative() > UNDETERMINED && figure.matters());
        let changed: Vec<(String, f64)> = off.map(|figure| (figure.name.clone(), figure.relative())).collect();
        let mut names: Vec<String> = changed.iter().map(|(name, _)| name.clone()).collect();
        for (prefix, person) in summary.people() {
            let measures = person.measures.iter().filter_map(|m| Some((m.name, format!("{prefix}{}", m.figure?))));
            let off = measures.filter(|(_, figure)| changed.iter().any(|(name, _)| name == figure));
            names.extend(off.map(|(name, _)| format!("{prefix}{name}")).collect::<Vec<_>>());
        }
        names.dedup();
        Caveat::undetermined(self.against, &changed, names)
    }

    /// Row for the table of the run.
    pub fn text(&self, units: Units) -> String {
        let mut off: Vec<&FigureError> = self.figures.iter().filter(|f| f.relative() > NAMED).collect();
        off.sort_by(|a, b| b.relative().total_cmp(&a.relative()));
        let named = off.iter().take(MOST_NAMED).map(|f| format!("{} {} %", f.name, number(100.0 * f.relative(), 1)));
        let figures = match (named.collect::<Vec<_>>().join(", "), off.len().saturating_sub(MOST_NAMED)) {
            (none, _) if none.is_empty() => "no result by more than 0.1 %".to_owned(),
            (some, 0) => some,
            (some, more) => format!("{some} and {more} more above 0.1 %"),
        };
        let mut lines = vec![
            ("integration error", format!("head path {}; {figures}", units.say(self.head_path_m * 1e3, "mm", 3))),
            ("", format!("estimated from {}, {} evaluations", self.against, self.evaluations)),
        ];
        if self.head_path_m > CHAOTIC_M {
            lines.push((
                "",
                "the motion amplifies small differences: quote only results that are stable in an ensemble (--ensemble)".to_owned(),
            ));
        }
        facts(&lines)
    }
}
