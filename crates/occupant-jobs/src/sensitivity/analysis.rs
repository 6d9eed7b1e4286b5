//! The work of `occupant sensitivity`.

use std::collections::HashSet;
use std::sync::OnceLock;
use std::time::Instant;

use occupant_core::model::Model;
use occupant_core::results::outcome::Status;
use occupant_core::results::summary::{Figure, Summarizer};
use occupant_core::run::simulate::attempt;
use occupant_scenario::{Draft, Resolver};
use occupant_study::sensitivity::finite::{Neighbours, neighbours_watched, tightly};
use occupant_study::sensitivity::measures::{Derivatives, Request, Values, chosen, derivatives, pick, plain_values};
use occupant_study::sensitivity::verdict::{Comparison, compare};
use occupant_study::sensitivity::{Built, Parameter, Trajectory, follow_watched, parameter};
use placed_text::Problem;

use crate::base::progress::Bar;
use crate::base::{Failure, Show};
use crate::files::history::choose;
use crate::files::scenario::counted;

/// A request with resolved names.
pub struct Asked<'a> {
    /// The parameters.
    pub parameters: Vec<Parameter<'a>>,
    /// Figures and channels to differentiate.
    pub request: Request,
    /// Units of the figures.
    pub units: Vec<&'static str>,
}

/// The plain run, the run in dual numbers and the finite changes.
pub struct Analysis {
    /// The plain run's values.
    pub values: Values,
    /// The run with its derivatives.
    pub trajectory: Trajectory,
    /// Derivatives of the models, by parameter.
    pub built: Vec<Built>,
    /// By parameter.
    pub derivatives: Vec<Derivatives>,
    /// Runs with finite changes of the parameters.
    pub neighbours: Neighbours,
    /// By parameter, then by figure.
    pub comparisons: Vec<Vec<Comparison>>,
    /// Wall time of a plain run and of the dual run, s.
    pub cost_s: [f64; 2],
}

/// Arguments of the command line.
pub struct Words<'a> {
    /// Names of parameters.
    pub to: &'a [String],
    /// Names of figures.
    pub of: &'a [String],
    /// Names of channels.
    pub channels: &'a [String],
}

/// Resolves the arguments.
///
/// # Errors
/// Everything that is not there, at once.
pub fn ask<'a>(
    draft: &'a Draft,
    model: &Model,
    resolver: Resolver<'a>,
    words: &Words<'_>,
) -> Result<Asked<'a>, Failure> {
    let mut wrong: Vec<String> = Vec::new();
    let parameters = gather(words.of, &mut wrong, |path| {
        parameter(draft, path, resolver).map(|one| vec![one]).map_err(|p| described("--of", &p))
    });
    let channels = gather(words.channels, &mut wrong, |name| {
        choose(model, &[name.to_owned()])
            .map_err(|refused| refused.words().replacen("error: ", "error: --channel: ", 1))
    });
    let figures = figures(model)?;
    let names =
        gather(words.to, &mut wrong, |name| chosen(&figures, name).map_err(|problem| described("--to", &problem)));
    if !wrong.is_empty() {
        let count = counted(wrong.len());
        return Err(Failure::CouldNotRun(format!("{}\n\n{count}, nothing was computed", wrong.join("\n"))));
    }
    let parameters = distinct(parameters, |p| &p.name);
    let channels = distinct(channels, |c| &c.name);
    let names = distinct(names, |n| n);
    let unit = |name: &String| figures.iter().find(|f| f.name == *name).map_or("1", |f| f.unit);
    Ok(Asked { parameters, units: names.iter().map(unit).collect(), request: Request { figures: names, channels } })
}

/// Resolves the items of lists; errors go to `wrong`.
fn gather<T>(lists: &[String], wrong: &mut Vec<String>, named: impl Fn(&str) -> Result<Vec<T>, String>) -> Vec<T> {
    let mut all = Vec::new();
    for item in split(lists) {
        match named(&item) {
            Ok(more) => all.extend(more),
            Err(message) => wrong.push(message),
        }
    }
    all
}

/// Items with unique names, the first of each.
fn distinct<T>(mut items: Vec<T>, name: impl Fn(&T) -> &String) -> Vec<T> {
    let mut seen = HashSet::new();
    items.retain(|item| seen.insert(name(item).clone()));
    items
}

/// Splits lists at commas, except within double quotes.
fn split(lists: &[String]) -> Vec<String> {
    let mut items = Vec::new();
    for list in lists {
        let mut quoted = false;
        let parts = list.split(|c: char| {
            quoted ^= c == '"';
            c == ',' && !quoted
        });
        items.extend(parts.map(|part| part.trim().to_owned()));
    }
    items
}

fn described(flag: &str, problem: &Problem) -> String {
    let hint = problem.hint.iter().map(|hint| format!("\n = help: {hint}")).collect::<String>();
    format!("error: {flag}: {}\n = expected: {}{hint}", problem.found, problem.expected)
}

/// The figures of the plain run.
fn figures(model: &Model) -> Result<Vec<Figure>, Failure> {
    let mut summarizer = Summarizer::new();
    let broken = |e| Failure::broke_off(format!("the run stopped: {e}"));
    let outcome = attempt(model, &mut summarizer).map_err(broken)?;
    if let Status::Failed(reason) = outcome.status {
        return Err(Failure::broke_off(format!("the run did not complete, so it has no derivative: {reason}")));
    }
    let summary = summarizer.summary(None);
    Ok(summary.map_or_else(Vec::new, |s| s.figures(model)))
}

/// Progress bar of a stage, created at its first step.
struct Stage {
    show: Show,
    what: &'static str,
    bar: OnceLock<Option<Box<dyn Bar>>>,
}

impl Stage {
    fn new(show: Show, what: &'static str) -> Self {
        Stage { show, what, bar: OnceLock::new() }
    }

    /// Sets the progress: `done` of `all`.
    fn is_at(&self, done: usize, all: usize) {
        if let Some(bar) = self.bar.get_or_init(|| self.show.bar(all as u64, self.what)) {
            bar.set_position(done as u64);
        }
    }
}

impl Drop for Stage {
    fn drop(&mut self) {
        if let Some(Some(bar)) = self.bar.get() {
            bar.clear();
        }
    }
}

/// Computes all derivatives and shows the progress by stage.
///
/// # Errors
/// Every parameter that has none; a run that cannot be followed.
pub fn analyse(model: &Model, asked: &Asked<'_>, show: Show) -> Result<Analysis, Failure> {
    let (mut built, mut wrong) = (Vec::new(), Vec::new());
    for parameter in &asked.parameters {
        match Built::new(model, parameter) {
            Ok(one) => built.push(one),
            Err(trouble) => wrong.push(format!("error: --of: {trouble}")),
        }
    }
    if !wrong.is_empty() {
        return Err(Failure::CouldNotRun(wrong.join("\n")));
    }
    let begun = Instant::now();
    let figures = figures(model)?;
    let plain_s = begun.elapsed().as_secs_f64();
    let Request { figures: names, channels } = &asked.request;
    let mut values = Values { figures: pick(&figures, names), ..Values::default() };
    let (mut all, mut cost_s) = (vec![Derivatives::default(); asked.parameters.len()], [plain_s, 0.0]);
    let mut trajectory = None;
    if !names.is_empty() {
        let finely: Vec<Parameter<'_>> = asked.parameters.iter().map(|p| p.of_models(tightly)).collect();
        let request = Request { figures: names.clone(), channels: Vec::new() };
        let model = tightly(model.clone());
        let (found, of) = derive(&model, &finely, &mut built, &request, &mut cost_s[1], show)?;
        all.iter_mut().zip(of).for_each(|(all, of)| all.figures = of.figures);
        trajectory = Some(found);
    }
    if !channels.is_empty() {
        let request = Request { figures: Vec::new(), channels: channels.clone() };
        let (found, of) = derive(model, &asked.parameters, &mut built, &request, &mut cost_s[1], show)?;
        values.channels = plain_values(model, &found, &request).map_err(Failure::broke_off)?.channels;
        all.iter_mut().zip(of).for_each(|(all, of)| all.channels = of.channels);
        trajectory = Some(found);
    }
    let Some(trajectory) = trajectory else { return Err(Failure::CouldNotRun("nothing was asked for".to_owned())) };
    let checked: &[Parameter<'_>] = if names.is_empty() { &[] } else { &asked.parameters };
    let runs = Stage::new(show, "runs to check them");
    let step_s = mean_step_s(model, &trajectory);
    let neighbours = neighbours_watched(model, checked, step_s, names, &|done, all| runs.is_at(done, all));
    drop(runs);
    let compare = |(k, parameter): (usize, &Parameter<'_>)| {
        let one = |i: usize| compare(&all[k].figures[i], parameter.size, &neighbours, k, i);
        (0..names.len()).map(one).collect()
    };
    let comparisons = asked.parameters.iter().enumerate().map(compare).collect();
    Ok(Analysis { values, trajectory, built, derivatives: all, neighbours, comparisons, cost_s })
}

/// The dual run and the derivatives by parameter; `cost_s` is the time of the former.
fn derive(
    model: &Model,
    parameters: &[Parameter<'_>],
    built: &mut [Built],
    request: &Request,
    cost_s: &mut f64,
    show: Show,
) -> Result<(Trajectory, Vec<Derivatives>), Failure> {
    let begun = Instant::now();
    let outputs = Stage::new(show, "outputs with derivatives");
    let trajectory = follow_watched(model, built, &mut |done, all| outputs.is_at(done, all));
    let trajectory = trajectory.map_err(Failure::broke_off)?;
    drop(outputs);
    *cost_s = begun.elapsed().as_secs_f64();
    let done = Stage::new(show, "parameters");
    let of = parameters.iter().enumerate().map(|(k, parameter)| {
        done.is_at(k, parameters.len());
        derivatives(model, parameter, &trajectory, k, request)
    });
    let of = of.collect::<Result<_, _>>().map_err(Failure::broke_off)?;
    Ok((trajectory, of))
}

fn mean_step_s(model: &Model, trajectory: &Trajectory) -> f64 {
    (trajectory.outcome.time_s - model.setup().time.start_s) / trajectory.outcome.effort.steps.max(1) as f64
}

/// Relative sensitivity: relative change of the figure per relative change of the parameter; none if one of them is 0.
pub fn relative(derivative: f64, value: f64, nominal: f64) -> Option<f64> {
    let relative = derivative * nominal / value;
    (value != 0.0 && nominal != 0.0 && relative.is_finite()).then_some(relative)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_split_at_commas_outside_quotes() {
        let lists = ["a.b, c".to_owned(), "surfaces.\"x, y\".k1".to_owned()];
        assert_eq!(split(&lists), ["a.b", "c", "surfaces.\"x, y\".k1"]);
    }

    #[test]
    fn nothing_is_relative_to_nothing() {
        assert_eq!(relative(3.0, 2.0, 4.0), Some(6.0));
        assert_eq!(relative(3.0, 0.0, 4.0), None);
        assert_eq!(relative(3.0, 2.0, 0.0), None);
    }
}
