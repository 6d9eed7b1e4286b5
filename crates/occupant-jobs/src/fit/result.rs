//! The result of a fit, in the form of fit.json. Nothing in it depends on the day, the machine or the number of threads.

use occupant_study::ApplyChoice;
use occupant_study::search::Stage;
use serde::Serialize;

use super::verdict::verdicts;
use super::{Accord, Answer, Fitted, FittedRuns, Fitting, Near, Record, Test, Verdict};
use crate::compare::Source;
use crate::files::history::class_name;

/// Correlation above which two parameters compensate each other.
pub const COMPENSATING: f64 = 0.9;

/// Content of fit.json.
#[derive(Serialize)]
pub struct FitResult {
    /// The program that computed it.
    pub program: String,
    /// Title of the study.
    pub title: String,
    /// The study.
    pub study: Source,
    /// Changes from the command line.
    pub overrides: Vec<String>,
    /// Objective that was minimised.
    pub objective: &'static str,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Budget of the global search, evaluations.
    pub budget: u64,
    /// Difference of scores that counts as converged.
    pub tolerance: f64,
    /// The tests.
    pub tests: Vec<Test>,
    /// Scores.
    pub score: Score,
    /// Definition of the intervals.
    pub near: NearOptimal,
    /// The parameters.
    pub parameters: Vec<ParameterEstimate>,
    /// Correlations among near-optimal sets, each pair once; pairs with a parameter at a bound are missing.
    pub correlations: Vec<Correlation>,
    /// Values in the fitted scenarios.
    pub written: Vec<Fitted>,
    /// The descents of the global search.
    pub descents: Vec<DescentResult>,
    /// Number of evaluations by purpose.
    pub evaluations: Evaluations,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

/// Scores; 0 for a run equal to the test.
#[derive(Serialize)]
pub struct Score {
    /// Score of the base scenario; none if it could not be run.
    pub before: Option<f64>,
    /// Score of the fitted scenario, with values as written.
    pub after: f64,
    /// The channels.
    pub channels: Vec<ChannelFit>,
}

/// A channel of a test.
#[derive(Serialize)]
pub struct ChannelFit {
    /// The test.
    pub test: String,
    /// The channel.
    pub channel: String,
    /// The measured signal.
    pub signal: String,
    /// Filter of both.
    pub filter: String,
    /// Weight.
    pub weight: f64,
    /// First and last time compared, s.
    pub window_s: [f64; 2],
    /// Misfit of the base scenario.
    pub before: Option<f64>,
    /// Misfit of the fitted scenario.
    pub after: f64,
    /// Agreement of the test with the fitted scenario.
    #[serde(flatten)]
    pub accord: Accord,
}

/// Definition of the intervals.
#[derive(Serialize)]
pub struct NearOptimal {
    /// Largest score of sets that count as equally good.
    pub score: f64,
    /// The criterion.
    #[serde(flatten)]
    pub near: Near,
    /// Number of evaluated sets that are equally good.
    pub sets: usize,
}

/// A parameter. Numbers are SI, angles in rad.
#[derive(Serialize)]
pub struct ParameterEstimate {
    /// Its name.
    pub name: String,
    /// SI unit; empty for factors and plain numbers.
    pub unit: &'static str,
    /// Display unit, and its SI value.
    #[serde(skip)]
    pub shown: (String, f64),
    /// How the number changes the scenario's value.
    pub apply: ApplyChoice,
    /// Paths that it changes.
    pub places: Vec<String>,
    /// Bounds of the search.
    pub bounds: [f64; 2],
    /// Whether the search was logarithmic.
    pub log: bool,
    /// The base scenario's value, if it is a single number.
    pub base: Option<f64>,
    /// The fitted value.
    pub value: f64,
    /// Interval in which the other parameters can compensate for it.
    pub interval: [f64; 2],
    /// Whether each end of the interval is set by a bound, of this or another parameter, or by a constraint, instead of the score.
    pub open: [bool; 2],
    /// Interval for this parameter alone.
    pub alone: [f64; 2],
    /// Least and largest value among the evaluated sets that are equally good.
    pub near_optimal: [f64; 2],
    /// Identifiability.
    pub verdict: Verdict,
    /// The verdict as text.
    pub words: String,
    /// Parameters that compensate for it.
    pub compensated_by: Vec<String>,
    /// All parameters and the score at both ends of the interval.
    pub ends: [IntervalEnd; 2],
}

/// An end of an interval.
#[derive(Serialize)]
pub struct IntervalEnd {
    /// The values of all parameters there, in their order.
    pub values: Vec<f64>,
    /// Score; lower is better.
    pub score: f64,
}

/// Correlation of two parameters.
#[derive(Serialize)]
pub struct Correlation {
    /// Names of both.
    pub between: [String; 2],
    /// From −1 to 1.
    pub correlation: f64,
}

/// Result of a descent.
#[derive(Serialize)]
pub struct DescentResult {
    /// Population.
    pub population: usize,
    /// Runs used.
    pub evaluations: u64,
    /// Least score.
    pub score: f64,
    /// Reason why it ended.
    pub ended: &'static str,
}

/// Numbers of evaluations.
#[derive(Serialize, Default)]
pub struct Evaluations {
    /// By the global search.
    pub search: usize,
    /// By the local refinement.
    pub refinement: usize,
    /// For curvature and intervals.
    pub intervals: usize,
    /// All, including the base scenario.
    pub all: usize,
    /// Trials that could not be run.
    pub failed: usize,
    /// Reason of the first failure.
    pub reason: Option<String>,
}

impl FitResult {
    /// Assembles the result.
    pub fn of(fitting: &Fitting, answer: &Answer, records: &[Record], fitted: FittedRuns) -> FitResult {
        let (misfit, study) = (fitting.fit.misfit, &fitting.manifest.texts[0]);
        let limit = misfit.of_cost(answer.best.value + answer.rise);
        let sets: Vec<&Record> = records.iter().filter(|r| r.at.is_some() && r.score <= limit).collect();
        let (parameters, evaluations) = (verdicts(fitting, answer, &sets), evaluations(records));
        let channels = channels(fitting, answer, &fitted.parts);
        let mut warnings = fitting.warnings.clone();
        warnings.extend(remarks(fitting, answer, &parameters, &evaluations));
        warnings.extend(channels.iter().filter_map(|c| c.accord.caution(&c.test, &c.channel)));
        warnings.extend(fitted.caveats);
        let after: Vec<f64> = fitted.parts.iter().map(|(misfit, _)| *misfit).collect();
        let before = answer.before.reason.is_none().then_some(answer.before.score);
        let descents = answer.global.descents.iter().map(|descent| DescentResult {
            population: descent.population,
            evaluations: descent.evaluations,
            score: descent.best.value,
            ended: descent.ending.words(),
        });
        FitResult {
            program: fitting.manifest.program.clone(),
            title: fitting.manifest.title.clone(),
            study: Source { file: study.name.clone(), sha256: study.sha256.clone() },
            overrides: fitting.overrides.clone(),
            objective: misfit.name(),
            seed: fitting.fit.seed,
            budget: fitting.fit.budget,
            tolerance: fitting.fit.tolerance,
            tests: fitting.tests.clone(),
            score: Score { before, after: fitting.combined(&after), channels },
            near: NearOptimal { score: limit, near: answer.near, sets: sets.len() },
            parameters,
            correlations: correlations(fitting, answer),
            written: fitted.written,
            descents: descents.collect(),
            evaluations,
            warnings,
        }
    }
}

fn channels(fitting: &Fitting, answer: &Answer, parts: &[(f64, Accord)]) -> Vec<ChannelFit> {
    let channels = fitting.targets().zip(parts).enumerate();
    let channels = channels.map(|(i, ((test, target), (after, accord)))| ChannelFit {
        test: fitting.tests[*test].name.clone(),
        channel: target.channel.name.clone(),
        signal: target.measured.signal.clone(),
        filter: class_name(target.class),
        weight: target.weight,
        window_s: target.window_s,
        before: answer.before.parts.get(i).copied(),
        after: *after,
        accord: *accord,
    });
    channels.collect()
}

fn correlations(fitting: &Fitting, answer: &Answer) -> Vec<Correlation> {
    let parameters = &fitting.parameters;
    let pairs = (0..parameters.len()).flat_map(|a| (a + 1..parameters.len()).map(move |b| [a, b]));
    let correlation = |[a, b]: [usize; 2]| {
        let between = [a, b].map(|i| parameters[i].name.clone());
        Some(Correlation { between, correlation: answer.shape.correlation(a, b)? })
    };
    pairs.filter_map(correlation).collect()
}

fn evaluations(records: &[Record]) -> Evaluations {
    let mut count = Evaluations { all: records.len(), ..Evaluations::default() };
    for record in records {
        match record.stage {
            None => {}
            Some(Stage::Sample | Stage::Model { .. } | Stage::Descent { .. }) => count.search += 1,
            Some(Stage::Refinement) => count.refinement += 1,
            Some(Stage::Scan | Stage::Shape | Stage::Profile) => count.intervals += 1,
        }
        if let Some(reason) = &record.reason {
            count.failed += 1;
            count.reason.get_or_insert_with(|| reason.clone());
        }
    }
    count
}

/// Remarks on the result.
fn remarks(
    fitting: &Fitting,
    answer: &Answer,
    parameters: &[ParameterEstimate],
    evaluations: &Evaluations,
) -> Vec<String> {
    let mut all = Vec::new();
    for parameter in parameters {
        let bound = match parameter.verdict {
            Verdict::AtLowerBound => "lower",
            Verdict::AtUpperBound => "upper",
            Verdict::AtConstraint => {
                all.push(format!("{} is {}: without it another value may fit better", parameter.name, parameter.words));
                continue;
            }
            _ => continue,
        };
        all.push(format!("{} is at its {bound} bound: a wider range may fit better", parameter.name));
    }
    if evaluations.failed > 0 {
        all.push(format!(
            "{} of {} candidates could not be run and rank worst; the first one: {}",
            evaluations.failed,
            evaluations.all,
            evaluations.reason.as_deref().unwrap_or("no reason")
        ));
    }
    if answer.before.reason.is_some() {
        all.push("the base scenario itself could not be run".to_owned());
    }
    let misfit = fitting.fit.misfit;
    let best = misfit.of_cost(answer.best.value);
    let limit = misfit.of_cost(answer.best.value + answer.rise);
    let descents = &answer.global.descents;
    let same = descents.iter().filter(|d| d.best.value <= limit.max(best + fitting.fit.tolerance));
    if descents.len() > 1 && same.count() < 2 {
        all.push("only one descent found this score: a larger budget may find a better one".to_owned());
    }
    all
}
