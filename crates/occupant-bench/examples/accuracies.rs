//! What `integrator.accuracy` leaves of heads' paths and of peaks, in everything that `scenarios/` holds, each in eight variants whose
//! materials are 7 % softer to 7 % stiffer, over its whole length.
//!
//! `cargo run --release -p occupant-bench --example accuracies [-- WORD]` prints the table of `docs/accuracy.md`, of the scenarios
//! whose name has the word in it. The reference is error control at 1e-9, at 1e-10 in runs beyond 0.35 s.

use std::error::Error;
use std::path::{Path, PathBuf};

use nalgebra::Point3;
use occupant_core::body::Segment;
use occupant_core::forces::contact::material::Force;
use occupant_core::forces::function::Unloading;
use occupant_core::model::Model;
use occupant_core::model::accuracy::Accuracy;
use occupant_core::model::setup::{Integrator, Setup};
use occupant_core::results::outcome::Status;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::simulate::simulate;
use occupant_scenario::{Draft, Format};

/// Stiffness of all materials in the variants.
const VARIANTS: [f64; 8] = [0.93, 0.95, 0.97, 0.99, 1.01, 1.03, 1.05, 1.07];
/// What is measured.
const ACCURACIES: [Accuracy; 2] = [Accuracy::Survey, Accuracy::Engineering];
/// What is compared of a run besides the paths.
const PEAKS: [&str; 6] =
    ["head.peak", "chest.peak", "pelvis.peak", "head.three_ms_contiguous", "chest.three_ms_contiguous", "hic15"];
/// Those below this are noise, m/s² and the like.
const LEAST: f64 = 20.0;

fn main() -> Result<(), Box<dyn Error>> {
    let wanted = std::env::args().nth(1).unwrap_or_default();
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios"));
    head();
    for part in ["", "templates"] {
        for path in scenarios(&folder.join(part))? {
            let name = path.strip_prefix(folder)?.display().to_string();
            if name.contains(&wanted) {
                case(&name, &path).map_err(|problem| format!("{name}: {problem}"))?;
            }
        }
    }
    Ok(())
}

fn scenarios(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let paths = std::fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<std::io::Result<Vec<_>>>()?;
    let mut paths: Vec<PathBuf> =
        paths.into_iter().filter(|path| path.extension().is_some_and(|e| e == "toml")).collect();
    paths.sort();
    Ok(paths)
}

fn read(path: &Path) -> Result<Setup, Box<dyn Error>> {
    let folder = path.parent().ok_or("no folder")?;
    let beside = |name: &str| std::fs::read(folder.join(name)).map_err(|e| e.to_string());
    let draft = Draft::read(&std::fs::read_to_string(path)?, Format::Toml, "scenario");
    let built = draft.and_then(|draft| draft.load(&beside)).and_then(|loaded| loaded.build());
    Ok(built.map_err(|problems| problems.to_string())?.0)
}

/// `setup` with all materials `factor` times as stiff.
fn stiffer(setup: &Setup, factor: f64) -> Setup {
    let mut setup = setup.clone();
    for material in &mut setup.materials {
        match &mut material.force {
            Force::Bilinear(spring) => {
                spring.k1_n_per_m *= factor;
                spring.k2_n_per_m *= factor;
            }
            Force::Deflection(law) => {
                law.loading.points.iter_mut().for_each(|point| point[1] *= factor);
                if let Unloading::Slope { n_per_m, .. } = &mut law.unloading {
                    *n_per_m *= factor;
                }
            }
        }
    }
    setup
}

/// Error control that others are judged by.
fn reference(span_s: f64) -> Integrator {
    let relative = if span_s > 0.35 { 1e-10 } else { 1e-9 };
    let (absolute_m, absolute_m_s) = (0.1 * relative, 10.0 * relative);
    Integrator::Adaptive { relative, absolute_m, absolute_m_s, min_step_s: 1e-13, max_step_s: 2e-3 }
}

/// What is compared of a run: each head's c.g. at every output, or that of the last segment of a part without one, and peaks.
struct Run {
    paths: Vec<Vec<Point3<f64>>>,
    peaks: Vec<(String, f64)>,
    evaluations: f64,
}

fn run(setup: &Setup, integrator: Integrator) -> Result<Run, Box<dyn Error>> {
    let mut setup = setup.clone();
    (setup.integrator, setup.time.output_s) = (integrator, 1e-3);
    let model = Model::new(setup).map_err(|problems| problems.to_string())?;
    let tree = model.body().tree;
    let last = tree.segment(tree.segments().len() - 1);
    let heads: Vec<Segment> = tree.bodies().iter().map(|body| body.landmarks.head.unwrap_or(last)).collect();
    let mut paths = vec![Vec::new(); heads.len()];
    let mut summarizer = Summarizer::new();
    let watch = Watch(|sample: &Sample<'_>| {
        paths.iter_mut().zip(&heads).for_each(|(path, head)| path.push(sample.cg_m(*head)));
    });
    let outcome = simulate(&model, (watch, &mut summarizer))?;
    if outcome.status != Status::Completed {
        return Err(format!("{:?}", outcome.status).into());
    }
    let figures = summarizer.summary(None).map(|summary| summary.figures(&model)).unwrap_or_default();
    let is_peak = |name: &str| PEAKS.iter().any(|peak| name.ends_with(peak));
    let peaks = figures.into_iter().filter(|f| is_peak(&f.name)).filter_map(|f| Some((f.name, f.value?)));
    let peaks = peaks.filter(|(_, value)| *value > LEAST);
    Ok(Run { paths, peaks: peaks.collect(), evaluations: outcome.effort.evaluations as f64 })
}

impl Run {
    /// Largest distance of a head, mm, and the largest error of heads' peaks and of any peak, %.
    fn errors(&self, exact: &Run) -> [f64; 3] {
        let apart = self.paths.iter().flatten().zip(exact.paths.iter().flatten());
        let path_mm = 1e3 * apart.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        let percent = |(name, value): &(String, f64)| {
            let own = self.peaks.iter().find(|(own, _)| own == name).map_or(0.0, |(_, own)| *own);
            100.0 * (own / value - 1.0).abs()
        };
        let heads = exact.peaks.iter().filter(|(name, _)| name.ends_with("head.peak"));
        [path_mm, heads.map(percent).fold(0.0, f64::max), exact.peaks.iter().map(percent).fold(0.0, f64::max)]
    }
}

#[allow(clippy::print_stdout, reason = "an example prints its result")]
fn head() {
    let columns = ["head path, mm", "head peak, %", "any peak, %", "evaluations"].join(" | ");
    println!("| scenario | survey: {columns} | engineering: {columns} |\n|{}", "---|".repeat(9));
}

#[allow(clippy::print_stdout, reason = "an example prints its result")]
fn case(name: &str, path: &Path) -> Result<(), Box<dyn Error>> {
    let base = read(path)?;
    let span_s = base.time.end_s - base.time.start_s;
    let mut cells = [[0.0_f64; 4]; ACCURACIES.len()];
    for factor in VARIANTS {
        let setup = stiffer(&base, factor);
        let exact = run(&setup, reference(span_s))?;
        for (cells, accuracy) in cells.iter_mut().zip(ACCURACIES) {
            let run = run(&setup, accuracy.integrator(span_s))?;
            cells.iter_mut().zip(run.errors(&exact)).for_each(|(most, own)| *most = most.max(own));
            cells[3] += run.evaluations / VARIANTS.len() as f64;
        }
    }
    let words =
        cells.map(|[path, head, any, evaluations]| format!("{path:.3} | {head:.3} | {any:.3} | {evaluations:.0}"));
    println!("| {name} | {} |", words.join(" | "));
    Ok(())
}
