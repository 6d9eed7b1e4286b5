//! What accuracy costs: error against evaluations and milliseconds, for rk4 at several steps and the adaptive integrator at
//! several tolerances, in the cart cases and the rollover.
//!
//! `cargo run --release -p occupant-bench --example work_precision -- DIRECTORY` writes `work-precision.csv` and two
//! drawings into DIRECTORY and prints the table of `docs/accuracy.md`.
//!
//! A single run may be right by luck: where in a step a contact happens to begin makes its error. So every point is the root
//! mean square over variants of its case, whose materials are a few per cent softer or stiffer. Each variant has its own
//! reference, rk4 at 4 µs; the adaptive integrator at a very fine tolerance, another method with other steps, tells how far
//! the reference itself is to be trusted.

mod drawing;
mod measure;

use std::fmt::Write as _;
use std::path::Path;

use measure::{Case, Errors, Point};
use occupant_core::model::setup::Integrator;

/// Cases and the ends of their runs, s: late in the rollover a touch of the start decides where an arm falls.
const CASES: [(&str, &str, f64); 4] = [
    ("cart-unbelted", include_str!("../../../../tests/data/carts/cart-unbelted.toml"), 0.2),
    ("cart-lap", include_str!("../../../../tests/data/carts/cart-lap.toml"), 0.2),
    ("cart-lap-torso", include_str!("../../../../tests/data/carts/cart-lap-torso.toml"), 0.2),
    ("rollover-quarter-turn", include_str!("../../../../scenarios/rollover-quarter-turn.toml"), 0.6),
];

/// Steps of rk4 as parts of the output interval of 1 ms.
const PARTS: [f64; 9] = [1.0, 2.0, 3.0, 4.0, 5.0, 8.0, 10.0, 20.0, 40.0];

/// Tolerances: relative; a tenth of it in m, ten times it in m/s.
const TOLERANCES: [f64; 11] = [1e-2, 3e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5, 3e-6, 1e-6];

/// The accuracy for which costs are compared: mm of the head's path and % of its peak acceleration.
const WANTED: (f64, f64) = (1.0, 0.1);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let directory = std::env::args().nth(1).ok_or("which directory?")?;
    let directory = Path::new(&directory);
    let mut all = Vec::new();
    for (name, text, end_s) in CASES {
        let case = Case::new(name, text, end_s)?;
        let trust = case.trust();
        let rk4 = PARTS.map(|parts| case.point(format!("rk4 {:.4} ms", 1.0 / parts), rk4(parts)));
        let adaptive = TOLERANCES.map(|t| case.point(format!("adaptive {t:e}"), adaptive(t)));
        say(name, trust, &rk4, &adaptive);
        all.push((name, rk4.to_vec(), adaptive.to_vec()));
    }
    std::fs::write(directory.join("work-precision.csv"), csv(&all))?;
    for (axis, of) in
        [("evaluations", (|p: &Point| p.evaluations) as fn(&Point) -> f64), ("milliseconds", |p| p.cpu_ms)]
    {
        let drawing = drawing::draw(&all, axis, of);
        std::fs::write(directory.join(format!("work-precision-{axis}.svg")), drawing)?;
    }
    Ok(())
}

fn rk4(parts: f64) -> Integrator {
    Integrator::Rk4 { step_s: 1e-3 / parts }
}

/// The adaptive integrator with all tolerances in proportion.
pub fn adaptive(tolerance: f64) -> Integrator {
    Integrator::Adaptive {
        relative: tolerance,
        absolute_m: 0.1 * tolerance,
        absolute_m_s: 10.0 * tolerance,
        min_step_s: 1e-9,
        max_step_s: 2e-3,
    }
}

/// The table of a case, and what the wanted accuracy costs.
#[allow(clippy::print_stdout, reason = "an example prints its result")]
fn say(name: &str, trust: Errors, rk4: &[Point], adaptive: &[Point]) {
    println!("\n### {name}\n");
    println!(
        "Reference trusted to {:.1e} mm, {:.1e} % of peak, {:.1e} % of HIC15, {:.1e} % of belt.\n",
        trust.path_mm, trust.peak, trust.hic, trust.belt
    );
    println!(
        "| integrator | evaluations | rejected | CPU ms | head path, mm | head peak, % | HIC15, % | belt peak, % |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for p in rk4.iter().chain(adaptive) {
        let e = &p.errors;
        println!(
            "| {} | {:.0} | {:.0} | {:.2} | {:.3} | {:.4} | {:.4} | {:.4} |",
            p.integrator, p.evaluations, p.rejected, p.cpu_ms, e.path_mm, e.peak, e.hic, e.belt
        );
    }
    let cheapest = |points: &[Point]| {
        let good = |p: &&Point| p.errors.path_mm <= WANTED.0 && p.errors.peak <= WANTED.1;
        let cost = |a: &&Point, b: &&Point| a.evaluations.total_cmp(&b.evaluations);
        points.iter().filter(good).min_by(cost).cloned()
    };
    if let (Some(a), Some(b)) = (cheapest(rk4), cheapest(adaptive)) {
        println!(
            "\n1 mm and 0.1 %: {} ({:.0} evaluations) against {} ({:.0}): {:.2} times fewer evaluations, {:.2} times less time.",
            a.integrator,
            a.evaluations,
            b.integrator,
            b.evaluations,
            a.evaluations / b.evaluations,
            a.cpu_ms / b.cpu_ms
        );
    }
}

fn csv(all: &[(&str, Vec<Point>, Vec<Point>)]) -> String {
    let mut text =
        "case,integrator,evaluations,rejected,cpu_ms,head_path_mm,head_peak_percent,hic15_percent,belt_peak_percent\n"
            .to_owned();
    for (case, rk4, adaptive) in all {
        for p in rk4.iter().chain(adaptive) {
            let e = &p.errors;
            let _ = writeln!(
                text,
                "{case},{},{:.1},{:.1},{:.3},{:.3e},{:.3e},{:.3e},{:.3e}",
                p.integrator, p.evaluations, p.rejected, p.cpu_ms, e.path_mm, e.peak, e.hic, e.belt
            );
        }
    }
    text
}
