//! Derivatives of everything that is made of outputs: figures, measures, channels.
//!
//! Not one of them is written anew. An output carries the state and all that is remembered, each with its derivative; so the
//! outputs displaced to first order by ±h are known exactly, and so is the model at p ± h. The recorders of a plain run
//! look at these outputs, and their answers are differenced and extrapolated (`sensitivity::ladder`). What is differenced
//! is a closed function of the displaced outputs, not a motion: its noise is that of rounding. Displacements of several
//! sizes are tried, as rounding asks for large ones and the kinks of force laws for small ones; of each figure that slope is
//! taken whose two extrapolations lie closest together. A peak, a window or a
//! 3 ms level is that of the outputs as samples: the sample that carries it stays the same for a small enough step.

use super::ladder::Slope;
use super::parameter::{Family, Parameter};
use super::trajectory::Trajectory;
use super::trouble::Trouble;
use occupant_core::model::Model;
use occupant_core::results::Unknown;
use occupant_core::results::channel::{Channel, Series, matches};
use occupant_core::results::checkpoint::{Checkpoint, Progress};
use occupant_core::results::energy::{EnergyStart, Greatest};
use occupant_core::results::recorder::{Recorder, Watch};
use occupant_core::results::summary::{Figure, Summarizer};
use occupant_core::run::simulate::replay;
use placed_text::Problem;
use placed_text::nearest;

/// Largest displacements of outputs, m and rad.
const FARTHEST: [f64; 3] = [1e-6, 2e-5, 4e-4];
/// Largest change of the parameter, relative to its size.
const LARGEST_PART: f64 = 1e-3;

/// Quantities to differentiate.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// Names of figures, as [`occupant_core::results::summary::Summary::figures`] has them.
    pub figures: Vec<String>,
    /// Channels of the model.
    pub channels: Vec<Channel>,
}

/// One answer per figure and per output of each channel.
#[derive(Clone, Debug, Default)]
pub struct Answers<T> {
    /// In the order of [`Request::figures`]; NaN where missing.
    pub figures: Vec<T>,
    /// By channel, then by output.
    pub channels: Vec<Vec<T>>,
}

/// Values of the figures and channels of a run.
pub type Values = Answers<f64>;

/// Derivatives of the figures and channels of a run by one parameter.
pub type Derivatives = Answers<Slope>;

/// Derivatives by `parameter`, the one of number `k` of the trajectory.
///
/// # Errors
/// A parameter that the trajectory has not; a figure that no run of the model has; a derivative beyond all numbers; an output that cannot be evaluated.
pub fn derivatives(
    model: &Model,
    parameter: &Parameter<'_>,
    trajectory: &Trajectory,
    k: usize,
    request: &Request,
) -> Result<Derivatives, Trouble> {
    if k >= trajectory.parameters() {
        let found = format!("parameter {k} of a trajectory with derivatives by {}", trajectory.parameters());
        return Err(Trouble::Output(found));
    }
    let reach = trajectory.reach(k);
    if !reach.is_finite() {
        return Err(Trouble::Output(format!("the derivative by `{}` overflows", parameter.name)));
    }
    let at_base = plain_values(model, trajectory, request)?;
    let mut best: Option<Derivatives> = None;
    for farthest in FARTHEST {
        let step = (farthest / reach).min(LARGEST_PART * parameter.size);
        let family = Family::new(model, parameter, step)?;
        let found = displaced(&family, parameter, trajectory, k, request, &at_base)?;
        match &mut best {
            None => best = Some(found),
            Some(best) => best.take_over(&found),
        }
    }
    best.ok_or_else(|| Trouble::Output("no displacement was tried".to_owned()))
}

/// Derivatives by outputs of the models of `family`.
fn displaced(
    family: &Family,
    parameter: &Parameter<'_>,
    trajectory: &Trajectory,
    k: usize,
    request: &Request,
    at_base: &Values,
) -> Result<Derivatives, Trouble> {
    let ladder = &family.ladder;
    let models = family.models.iter().zip(&ladder.points);
    let around = models.map(|(model, point)| {
        let by = point - parameter.nominal;
        values(model, trajectory, request, |output| trajectory.displaced(k, output, by))
    });
    let around: Vec<Values> = around.collect::<Result<_, _>>()?;
    let slopes = |of: &dyn Fn(&Values) -> Vec<f64>| {
        let around: Vec<Vec<f64>> = around.iter().map(of).collect();
        ladder.slopes(&of(at_base), &around)
    };
    Ok(Derivatives {
        figures: slopes(&|v| v.figures.clone()),
        channels: (0..request.channels.len()).map(|c| slopes(&|v| v.channels[c].clone())).collect(),
    })
}

impl Derivatives {
    /// Takes over the answers of another displacement where they are less uncertain.
    fn take_over(&mut self, other: &Derivatives) {
        let ours = self.channels.iter_mut().flatten();
        let ours = self.figures.iter_mut().chain(ours);
        let theirs = other.figures.iter().chain(other.channels.iter().flatten());
        for (a, b) in ours.zip(theirs) {
            if b.doubt < a.doubt {
                *a = *b;
            }
        }
    }
}

/// Values of the plain run.
///
/// # Errors
/// A figure that no run of the model has, or a channel of another model; an output that cannot be evaluated.
pub fn plain_values(model: &Model, trajectory: &Trajectory, request: &Request) -> Result<Values, Trouble> {
    values(model, trajectory, request, |output| trajectory.checkpoints[output].clone())
}

/// Values from outputs of `model` that need not come from its own run.
fn values(
    model: &Model,
    trajectory: &Trajectory,
    request: &Request,
    output: impl Fn(usize) -> Checkpoint,
) -> Result<Values, Trouble> {
    let mut recorder = (Summarizer::new(), Series::new(request.channels.clone()));
    recorder.begin(model)?;
    let mut progress: Option<Progress> = None;
    for i in 0..trajectory.checkpoints.len() {
        let mut checkpoint = output(i);
        // what steps between outputs have seen is not displaced: figures are made of these outputs alone
        checkpoint.peaks.clear();
        checkpoint.readings_before.clear();
        checkpoint.readings.clear();
        checkpoint.progress = match progress {
            Some(progress) => progress,
            None => from_the_start(model, &checkpoint)?,
        };
        let mut carry = Watch(|sample: &occupant_core::results::sample::Sample<'_>| {
            progress = Some(sample.progress);
        });
        replay(model, &checkpoint, &mut (&mut recorder, &mut carry)).map_err(|e| Trouble::Output(e.to_string()))?;
    }
    let mut outcome = trajectory.outcome.clone();
    if let Some(progress) = progress {
        outcome.energy.greatest_kinetic_j = progress.greatest.all.kinetic_j;
    }
    recorder.end(&outcome)?;
    let (summarizer, series) = recorder;
    let summary = summarizer.summary(None);
    let figures = summary.map_or_else(Vec::new, |s| s.figures(model));
    let known = || figures.iter().map(|figure| figure.name.as_str());
    if let Some(name) = request.figures.iter().find(|name| known().all(|own| own != **name)) {
        return Err(Trouble::Unknown(Unknown::new("measure", name, known())));
    }
    Ok(Values { figures: pick(&figures, &request.figures), channels: series.values })
}

/// Sums and extremes at the start of a run.
fn from_the_start(model: &Model, checkpoint: &Checkpoint) -> Result<Progress, Trouble> {
    let mut first = checkpoint.clone();
    first.progress.energy_start = EnergyStart::default();
    first.progress.greatest = Greatest::default();
    let mut start = EnergyStart::default();
    let mut watch = Watch(|sample: &occupant_core::results::sample::Sample<'_>| start = sample.energy.as_start());
    replay(model, &first, &mut watch).map_err(|e| Trouble::Output(e.to_string()))?;
    let mut progress = first.progress;
    progress.energy_start = start;
    Ok(progress)
}

/// Values of named figures; NaN where missing.
pub fn pick(figures: &[Figure], names: &[String]) -> Vec<f64> {
    let value = |name: &String| {
        let figure = figures.iter().find(|f| f.name == *name);
        figure.and_then(|f| f.value).unwrap_or(f64::NAN)
    };
    names.iter().map(value).collect()
}

/// Figures of a run selected by a name or a pattern with `*`. A pattern skips figures without a value or a derivative.
///
/// # Errors
/// A name or a pattern that fits none; a figure that the run has not, or that has no derivative.
pub fn chosen(figures: &[Figure], name: &str) -> Result<Vec<String>, Problem> {
    let refuse = |found: String, expected: &str| Problem::error("", found, expected);
    if name.contains('*') {
        let pieces: Vec<&str> = name.split('*').collect();
        let all: Vec<&Figure> = figures.iter().filter(|f| matches(&f.name, &pieces)).collect();
        let usable = all.iter().filter(|f| f.value.is_some() && without_derivative(&f.name).is_none());
        let found: Vec<String> = usable.map(|f| f.name.clone()).collect();
        return match (found.is_empty(), all.is_empty()) {
            (false, _) => Ok(found),
            (true, true) => Err(refuse(format!("there is no measure `{name}`"), "a measure of the run")),
            (true, false) => {
                let found = format!("no measure that matches `{name}` has a value and a derivative in this run");
                Err(refuse(found, "a measure that the run has"))
            }
        };
    }
    let Some(figure) = figures.iter().find(|f| f.name == name) else {
        let near = nearest(name, figures.iter().map(|f| f.name.as_str()));
        let expected = "a measure of the run, such as hic15, head.peak, belts.lap.peak";
        let problem = refuse(format!("there is no measure `{name}`"), expected);
        return Err(problem.with_hint(near.map(|n| format!("did you mean `{n}`?"))));
    };
    if let Some(reason) = without_derivative(name) {
        let found = format!("`{name}` has no derivative: {reason}");
        return Err(refuse(found, "a measure that changes with the motion"));
    }
    if figure.value.is_none() {
        let found = format!("`{name}` has no value in this run: the event did not happen");
        return Err(refuse(found, "a measure that the run has"));
    }
    Ok(vec![name.to_owned()])
}

/// Reason why a figure has no derivative here, if any.
pub fn without_derivative(name: &str) -> Option<&'static str> {
    let last = name.rsplit('.').next().unwrap_or(name);
    if name.starts_with("solver.") {
        return Some("it counts the integrator's work");
    }
    match last {
        "balance_error" => Some("it is an error of the integration"),
        "reached" => Some("it is the time at which the run ends"),
        "first_speed" => Some("it belongs to the accepted step at which the contact was seen"),
        _ if last == "time" || last.ends_with("_time") || last.ends_with("_time_s") => {
            Some("it is the time of an output, which jumps from one output to the next")
        }
        _ => None,
    }
}
