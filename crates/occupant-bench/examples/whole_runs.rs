//! How far the default integrator is from the solution on everything in `scenarios/`, decks and templates included, over its whole
//! length, and on 64 rollovers whose driver leans otherwise.
//!
//! `cargo run --release -p occupant-bench --example whole_runs [-- WORD]` prints the table of `docs/accuracy.md`, of the cases whose
//! name has the word in it, in some five minutes. The reference is rk4 at 5 µs, outputs every 1 ms; how far another method with other
//! steps, error control at a hundredth of the default's tolerances, is from it tells what the reference is worth: differences below
//! that mean nothing.

use std::error::Error;
use std::path::{Path, PathBuf};

use nalgebra::Point3;
use occupant_core::model::Model;
use occupant_core::model::setup::{Integrator, Setup};
use occupant_core::results::outcome::Status;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use occupant_scenario::{Draft, Format};

/// What is varied of the rollover's posture, and by how many degrees to either side.
const LEANS: [(&str, f64); 6] = [
    ("middle_torso", 6.0),
    ("upper_torso", 6.0),
    ("head", 8.0),
    ("lower_torso", 6.0),
    ("upper_arms", 15.0),
    ("elbows", 15.0),
];

const POSTURES: u32 = 64;

const REFERENCE: Integrator = Integrator::Rk4 { step_s: 5e-6 };

/// The default with a hundredth of its tolerances.
const FINE: Integrator = Integrator::Adaptive {
    relative: 3e-10,
    absolute_m: 3e-11,
    absolute_m_s: 3e-9,
    min_step_s: 1e-12,
    max_step_s: 2e-3,
};

fn main() -> Result<(), Box<dyn Error>> {
    let wanted = std::env::args().nth(1).unwrap_or_default();
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios"));
    let mut cases: Vec<(String, PathBuf)> = Vec::new();
    for part in ["", "templates", "decks"] {
        for path in scenarios(&folder.join(part))? {
            let name = path.strip_prefix(folder)?.display().to_string();
            cases.push((name, path));
        }
    }
    head();
    for (name, path) in cases.iter().filter(|case| case.0.contains(&wanted)) {
        row(name, &Errors::of(&read(path, &[]).map_err(|problem| format!("{name}: {problem}"))?));
    }
    if "rollover, postures".contains(&wanted) {
        let rollover = folder.join("rollover-quarter-turn.toml");
        let postures = (1..=POSTURES).map(|i| Ok(Errors::of(&read(&rollover, &lean(i))?)));
        let mut all = postures.collect::<Result<Vec<_>, Box<dyn Error>>>()?;
        all.sort_by(|a, b| a.own.0.total_cmp(&b.own.0));
        for (name, i) in [("greatest", 0), ("second", 1), ("median", all.len() / 2)] {
            row(&format!("rollover, postures: the {name}"), &all[all.len() - 1 - i]);
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

/// The changes of posture number `i`: angles spread over their ranges by multiples of irrational numbers.
fn lean(i: u32) -> Vec<String> {
    let base = [15.0, 18.0, 5.0, 20.0, 35.0, -60.0];
    let spread = |k: usize| 2.0 * (f64::from(i) * f64::sqrt([2.0, 3.0, 5.0, 7.0, 11.0, 13.0][k])).fract() - 1.0;
    let change = |k: usize| format!("posture.{}={:.3}", LEANS[k].0, base[k] + LEANS[k].1 * spread(k));
    (0..LEANS.len()).map(change).collect()
}

fn read(path: &Path, changes: &[String]) -> Result<Setup, Box<dyn Error>> {
    let folder = path.parent().ok_or("no folder")?;
    let beside = |name: &str| std::fs::read(folder.join(name)).map_err(|e| e.to_string());
    let text = std::fs::read_to_string(path)?;
    let mut draft = Draft::read(&text, Format::Toml, "scenario").map_err(|problems| problems.to_string())?;
    for change in changes {
        draft.set(change).map_err(|problems| problems.to_string())?;
    }
    let built = draft.load(&beside).and_then(|loaded| loaded.build());
    Ok(built.map_err(|problems| problems.to_string())?.0)
}

/// The head's c.g., or that of the last segment of a part without one, at every output, and the largest reading there.
struct Run {
    path: Vec<Point3<f64>>,
    peak_m_s2: f64,
    evaluations: u64,
}

fn run(setup: &Setup, integrator: Integrator) -> Run {
    let mut setup = setup.clone();
    (setup.integrator, setup.time.output_s) = (integrator, 1e-3);
    let model = Model::new(setup).unwrap_or_else(|problems| panic!("{problems}"));
    let tree = model.body().tree;
    let head = tree.landmarks().head.unwrap_or_else(|| tree.segment(tree.segments().len() - 1));
    let (mut path, mut peak_m_s2) = (Vec::new(), 0.0_f64);
    let watch = Watch(|sample: &Sample<'_>| {
        path.push(sample.cg_m(head));
        peak_m_s2 = peak_m_s2.max(sample.specific_force_m_s2(head).norm());
    });
    let outcome = simulate(&model, watch).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(outcome.status, Status::Completed);
    Run { path, peak_m_s2, evaluations: outcome.effort.evaluations }
}

/// Of a case: head path in mm and head peak in % away from the reference, and evaluations.
struct Errors {
    end_s: f64,
    own: (f64, f64, u64),
    rk4: (f64, f64, u64),
    fine_mm: f64,
}

impl Errors {
    fn of(setup: &Setup) -> Errors {
        let exact = run(setup, REFERENCE);
        let apart = |integrator| {
            let run = run(setup, integrator);
            let path = run.path.iter().zip(&exact.path).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
            (1e3 * path, 100.0 * (run.peak_m_s2 - exact.peak_m_s2).abs() / exact.peak_m_s2.max(1.0), run.evaluations)
        };
        let rk4 = apart(Integrator::Rk4 { step_s: 1e-4 });
        Errors { end_s: setup.time.end_s, own: apart(Integrator::default()), rk4, fine_mm: apart(FINE).0 }
    }
}

#[allow(clippy::print_stdout, reason = "an example prints its result")]
fn head() {
    println!(
        "| case | end | default: head path, mm | head peak, % | evaluations | rk4 0.1 ms: mm | % | evaluations | fine: mm |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
}

#[allow(clippy::print_stdout, reason = "an example prints its result")]
fn row(name: &str, of: &Errors) {
    let cells = |(mm, percent, evaluations): (f64, f64, u64)| format!("{mm:.4} | {percent:.4} | {evaluations}");
    println!("| {name} | {} s | {} | {} | {:.4} |", of.end_s, cells(of.own), cells(of.rk4), of.fine_mm);
}
