//! Runs of the variants of a case, their errors and their cost.

use std::time::Instant;

use nalgebra::Point3;
use occupant_core::body::tti12;
use occupant_core::model::Model;
use occupant_core::model::setup::{Integrator, Setup};
use occupant_core::results::outcome::{Outcome, Status};
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::{Effort, Sample};
use occupant_core::results::summary::Summarizer;
use occupant_core::run::simulate::simulate;
use occupant_scenario::{Format, Scenario};

/// Stiffness of all materials in the variants.
const VARIANTS: [f64; 8] = [0.93, 0.95, 0.97, 0.99, 1.01, 1.03, 1.05, 1.07];
/// The measures compared; a case without belts lacks the last two.
const FIGURES: [&str; 4] = ["head.peak", "hic15", "belts.lap.peak", "belts.torso.peak"];

/// Errors against the reference.
#[derive(Clone, Copy, Debug, Default)]
pub struct Errors {
    /// Largest distance of the head's c.g., mm.
    pub path_mm: f64,
    /// Of the peak of the head's acceleration, %.
    pub peak: f64,
    /// Of HIC15, %.
    pub hic: f64,
    /// Of the largest loop force, the worse of both belts, %.
    pub belt: f64,
}

/// An integrator on a case: root mean squares of errors, means of costs.
#[derive(Clone, Debug)]
pub struct Point {
    pub integrator: String,
    pub evaluations: f64,
    pub rejected: f64,
    pub cpu_ms: f64,
    pub errors: Errors,
}

/// A case with its variants and their references.
pub struct Case {
    name: &'static str,
    variants: Vec<(Setup, Run)>,
}

/// What is compared of a run.
struct Run {
    head: Vec<Point3<f64>>,
    figures: [Option<f64>; 4],
    effort: Effort,
}

impl Case {
    pub fn new(name: &'static str, text: &str, end_s: f64) -> Result<Self, String> {
        let alone = |file: &str| Err(format!("no file beside the text: {file}"));
        let scenario = Scenario::from_text(text, Format::Toml, name, &alone);
        let (mut base, _) = scenario.and_then(|s| s.build()).map_err(|problems| problems.to_string())?;
        (base.time.end_s, base.time.output_s) = (end_s, 1e-3);
        let variants = VARIANTS.map(|factor| {
            let mut setup = base.clone();
            for material in &mut setup.materials {
                let Some(spring) = material.force.bilinear_mut() else { continue };
                spring.k1_n_per_m *= factor;
                spring.k2_n_per_m *= factor;
            }
            let reference = run(&setup, Integrator::Rk4 { step_s: 4e-6 });
            (setup, reference)
        });
        Ok(Case { name, variants: variants.into() })
    }

    /// How far the references are from another method with other steps.
    pub fn trust(&self) -> Errors {
        let fine = super::adaptive(1e-8);
        self.point("fine".into(), fine).errors
    }

    /// Measures `integrator`.
    pub fn point(&self, name: String, integrator: Integrator) -> Point {
        let number = self.variants.len() as f64;
        let (mut squares, mut evaluations, mut rejected) = ([0.0; 4], 0.0, 0.0);
        for (setup, reference) in &self.variants {
            let run = run(setup, integrator);
            let e = run.errors(reference);
            for (sum, error) in squares.iter_mut().zip([e.path_mm, e.peak, e.hic, e.belt]) {
                *sum += error * error / number;
            }
            evaluations += run.effort.evaluations as f64 / number;
            rejected += run.effort.rejected as f64 / number;
        }
        let [path_mm, peak, hic, belt] = squares.map(f64::sqrt);
        Point {
            integrator: name,
            evaluations,
            rejected,
            cpu_ms: self.cpu_ms(integrator),
            errors: Errors { path_mm, peak, hic, belt },
        }
    }

    /// Processor time of a run with its outputs at 1 kHz, ms: the least of several means over all variants.
    fn cpu_ms(&self, integrator: Integrator) -> f64 {
        let models: Vec<Model> = self.variants.iter().map(|(setup, _)| model(setup, integrator)).collect();
        let mut best = f64::INFINITY;
        for _ in 0..3 {
            let clock = Clock::start();
            let mut runs = 0.0;
            // the system counts in ticks of some milliseconds
            while clock.wall_ms() < 60.0 {
                for model in &models {
                    simulate(model, ()).unwrap_or_else(|e| panic!("{}: {e}", self.name));
                    runs += 1.0;
                }
            }
            best = best.min(clock.ms() / runs);
        }
        best
    }
}

fn model(setup: &Setup, integrator: Integrator) -> Model {
    let mut setup = setup.clone();
    setup.integrator = integrator;
    Model::new(setup).unwrap_or_else(|problems| panic!("{problems}"))
}

fn run(setup: &Setup, integrator: Integrator) -> Run {
    let model = model(setup, integrator);
    let mut log = Log::default();
    let outcome = simulate(&model, &mut log).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(outcome.status, Status::Completed);
    let summary = log.summary.summary(None);
    let figures = summary.map(|s| s.figures(&model)).unwrap_or_default();
    Run {
        head: log.head,
        figures: FIGURES.map(|name| figures.iter().find(|f| f.name == name)?.value),
        effort: outcome.effort,
    }
}

impl Run {
    fn errors(&self, reference: &Run) -> Errors {
        let apart = self.head.iter().zip(&reference.head);
        let percent = |i: usize| match (self.figures[i], reference.figures[i]) {
            (Some(a), Some(b)) => 100.0 * (a / b - 1.0).abs(),
            _ => 0.0,
        };
        Errors {
            path_mm: 1e3 * apart.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max),
            peak: percent(0),
            hic: percent(1),
            belt: percent(2).max(percent(3)),
        }
    }
}

/// The head's path and the summary.
#[derive(Default)]
struct Log {
    head: Vec<Point3<f64>>,
    summary: Summarizer,
}

impl Recorder for Log {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        self.summary.begin(model)
    }
    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        self.head.push(sample.cg_m(tti12::HEAD));
        self.summary.record(sample)
    }
    fn end(&mut self, outcome: &Outcome) -> Result<(), RecorderError> {
        self.summary.end(outcome)
    }
}

/// Processor time of this thread where the system tells it, else the wall's.
struct Clock {
    wall: Instant,
    cpu_ms: Option<f64>,
}

impl Clock {
    fn start() -> Self {
        Clock { wall: Instant::now(), cpu_ms: cpu_ms() }
    }
    fn wall_ms(&self) -> f64 {
        self.wall.elapsed().as_secs_f64() * 1e3
    }
    fn ms(&self) -> f64 {
        match (self.cpu_ms, cpu_ms()) {
            (Some(then), Some(now)) => now - then,
            _ => self.wall_ms(),
        }
    }
}

/// Linux: nanoseconds on the processor, the first number of the file.
fn cpu_ms() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let ns: f64 = text.split(' ').next()?.parse().ok()?;
    Some(ns * 1e-6)
}
