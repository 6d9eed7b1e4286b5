//! Finite changes of a parameter, run in full: how far the straight line of the derivative holds.

use std::ops::ControlFlow;

use rayon::prelude::*;

use super::ladder::Slope;
use super::measures::pick;
use super::parameter::Parameter;
use crate::ending::Ending;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::batch::{Ended, Job, Kernel, simulate_many};

/// Changes as parts of a parameter's size, to either side.
pub const CHANGES: [f64; 4] = [1e-4, 1e-3, 3e-3, 1e-2];
/// The derivative holds while it is off by no more than this.
pub const HOLDS: f64 = 0.1;
/// A change of a figure below this part of its value is no influence.
const NO_INFLUENCE: f64 = 1e-9;
/// A secant is compared with at least this part of the figure over the parameter's size.
const LEAST: f64 = 1e-6;

/// The figures of the runs to either side of a parameter's value.
#[derive(Clone, Debug)]
pub struct Finite {
    /// The change as a part of the parameter's size.
    pub part: f64,
    /// The change.
    pub change: f64,
    /// Figures below and above, each not a number where the run has none or did not complete.
    pub figures: [Vec<f64>; 2],
}

/// How far a derivative can be relied upon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// The change of the figure is the derivative's within a part `off`, for changes of the parameter up to a part
    /// `up_to` of its size.
    Holds {
        /// Greatest distance of a secant from the derivative, as a part of the derivative.
        off: f64,
        /// Largest change looked at for which that is so.
        up_to: f64,
    },
    /// The figure does not change.
    NoInfluence,
    /// Already the smallest change looked at gives another slope.
    NotReliable {
        /// Distance of a secant from the derivative, as a part of the derivative.
        off: f64,
        /// The change.
        at: f64,
    },
    /// No run beside this one has the figure.
    Unchecked,
}

/// A derivative beside the secants of finite changes.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// By change, in the order of the changes: slopes of the secants below and above; not a number without a run.
    pub secants: Vec<[f64; 2]>,
    /// By change: the greatest distance of a secant from the derivative, as a part of the derivative.
    pub off: Vec<f64>,
    /// What follows.
    pub verdict: Verdict,
}

/// Runs the models beside the values of the parameters, on all threads of rayon's pool; `figures` are the names asked for.
/// By parameter, then by change; the same bits for any number of threads.
pub fn finite_changes(parameters: &[Parameter<'_>], parts: &[f64], figures: &[String]) -> Vec<Vec<Finite>> {
    let none = [vec![f64::NAN; figures.len()], vec![f64::NAN; figures.len()]];
    let beside = |size: f64, part: f64| Finite { part, change: part * size, figures: none.clone() };
    let mut all: Vec<Vec<Finite>> =
        parameters.iter().map(|of| parts.iter().map(|part| beside(of.size, *part)).collect()).collect();
    let mut jobs = Vec::new();
    for (number, (parameter, finite)) in parameters.iter().zip(&all).enumerate() {
        for (i, Finite { change, .. }) in finite.iter().enumerate() {
            for (side, change) in [-change, *change].into_iter().enumerate() {
                // a value that the scenario refuses has no run
                let model = (parameter.model_at)(parameter.nominal + change).ok();
                jobs.extend(model.map(|model| Job { tag: (number, i, side), model, recorder: Summarizer::new() }));
            }
        }
    }
    let on_a_thread = jobs.len().div_ceil(rayon::current_num_threads()).max(1);
    let ran: Vec<_> = jobs.into_par_iter().chunks(on_a_thread).flat_map_iter(|jobs| run(jobs, figures)).collect();
    for ((number, i, side), figures) in ran {
        all[number][i].figures[side] = figures;
    }
    all
}

/// The figures of the runs that have completed.
fn run<T>(jobs: Vec<Job<T, Summarizer>>, figures: &[String]) -> Vec<(T, Vec<f64>)> {
    let mut all = Vec::with_capacity(jobs.len());
    simulate_many(Kernel::best(), jobs, |ended: Ended<T, Summarizer>| {
        let completed = ended.outcome.is_ok_and(|o| Ending::of(&o) == Some(Ending::Completed));
        if let (true, Some(summary)) = (completed, ended.recorder.summary(None)) {
            all.push((ended.tag, pick(&summary.figures(&ended.model), figures)));
        }
        ControlFlow::Continue(())
    });
    all
}

/// Compares the derivative of figure `i`, whose value is `value`, with the finite changes of a parameter of this size.
pub fn compare(slope: &Slope, value: f64, size: f64, finite: &[Finite], i: usize) -> Comparison {
    let secant = |f: &Finite, side: usize| {
        let change = if side == 0 { -f.change } else { f.change };
        (f.figures[side][i] - value) / change
    };
    let secants: Vec<[f64; 2]> = finite.iter().map(|f| [secant(f, 0), secant(f, 1)]).collect();
    let scale = value.abs() / size;
    let base = slope.value.abs().max(LEAST * scale);
    let off: Vec<f64> = secants
        .iter()
        .map(|pair| {
            let known = pair.iter().filter(|s| s.is_finite());
            let far = known.map(|s| (s - slope.value).abs());
            let far = far.reduce(f64::max).unwrap_or(f64::NAN);
            if far == 0.0 { 0.0 } else { far / base }
        })
        .collect();
    let still = |s: f64| s.abs() <= NO_INFLUENCE * scale || s == 0.0;
    let all_still = still(slope.value) && secants.iter().flatten().all(|s| !s.is_finite() || still(*s));
    let verdict = verdict(finite, &off, all_still);
    Comparison { secants, off, verdict }
}

fn verdict(finite: &[Finite], off: &[f64], all_still: bool) -> Verdict {
    let mut known: Vec<(f64, f64)> =
        finite.iter().zip(off).filter(|(_, off)| off.is_finite()).map(|(f, off)| (f.part, *off)).collect();
    known.sort_by(|a, b| a.0.total_cmp(&b.0));
    let Some(&(at, first)) = known.first() else { return Verdict::Unchecked };
    if all_still {
        return Verdict::NoInfluence;
    }
    let mut verdict = Verdict::NotReliable { off: first, at };
    let mut worst = 0.0_f64;
    for (part, off) in known {
        worst = worst.max(off);
        if worst > HOLDS {
            break;
        }
        verdict = Verdict::Holds { off: worst, up_to: part };
    }
    verdict
}
