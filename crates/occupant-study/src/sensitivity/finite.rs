//! Finite changes of a parameter, run in full and compared with the run itself, at tolerances for which step errors are
//! negligible.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::measures::pick;
use super::parameter::{Parameter, fine_interval_s};
use occupant_core::model::Model;
use occupant_core::model::setup::Integrator;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::batch::{Ended, Job, Kernel, simulate_many};
use occupant_scenario::ending::Ending;

/// Finite changes to either side, relative to a parameter's size.
pub const CHANGES: [f64; 3] = [2e-3, 5e-3, 1e-2];
/// Least change of a time, in steps: smaller ones may fall between two steps.
const STEPS: f64 = 4.0;
/// Largest relative change of a time.
const MOST: f64 = 0.2;
/// Factor on the tolerances and the least step of the run, or of the defaults where these are tighter.
const TIGHTER: f64 = 0.01;
/// Finest tolerances and steps that a model allows.
const FINEST: [f64; 4] = [1e-13, 1e-14, 1e-13, 1e-15];

/// Result of a run at a changed parameter value.
#[derive(Clone, Debug, PartialEq)]
pub enum Beside {
    /// The scenario refuses the value.
    Refused,
    /// The run was not completed.
    Broken,
    /// The results.
    Ran(Seen),
}

/// Requested results of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Seen {
    /// Figures; NaN where missing.
    pub figures: Vec<f64>,
    /// Time of each, s; NaN where unknown.
    pub times_s: Vec<f64>,
    /// First contacts in order, as sphere and surface.
    pub touches: Vec<[usize; 2]>,
}

/// The runs to either side of a parameter's value.
#[derive(Clone, Debug)]
pub struct Finite {
    /// The change relative to the parameter's size.
    pub part: f64,
    /// The change.
    pub change: f64,
    /// Runs below and above.
    pub sides: [Beside; 2],
}

/// The nominal run and its neighbours.
#[derive(Clone, Debug)]
pub struct Neighbours {
    /// At the nominal values of all parameters.
    pub here: Beside,
    /// By parameter, then by change.
    pub finite: Vec<Vec<Finite>>,
}

/// Relative changes to try for a parameter of this size and unit, with mean steps of `step_s`.
pub fn changes(parameter: &Parameter<'_>, step_s: f64) -> Vec<f64> {
    let several = (STEPS * step_s / parameter.size).min(MOST);
    let more = (parameter.unit == "s" && several > CHANGES[CHANGES.len() - 1]).then_some(several);
    CHANGES.into_iter().chain(more).collect()
}

/// Runs `model` and its neighbours, on all threads of rayon's pool; `figures` are the names requested, `step_s` the
/// mean step. Same bits for any number of threads.
pub fn neighbours(model: &Model, parameters: &[Parameter<'_>], step_s: f64, figures: &[String]) -> Neighbours {
    neighbours_watched(model, parameters, step_s, figures, &|_, _| ())
}

/// The same; `ran` is called with the number of finished runs and of all runs, from any thread.
pub fn neighbours_watched(
    model: &Model,
    parameters: &[Parameter<'_>],
    step_s: f64,
    figures: &[String],
    ran: &(dyn Fn(usize, usize) + Sync),
) -> Neighbours {
    let beside = |size: f64, part: f64| Finite { part, change: part * size, sides: [Beside::Refused, Beside::Refused] };
    let of = |of: &Parameter<'_>| changes(of, step_s).into_iter().map(|part| beside(of.size, part)).collect();
    let mut all = Neighbours { here: Beside::Broken, finite: parameters.iter().map(of).collect() };
    let mut jobs = vec![job(None, model.clone())];
    for (number, (parameter, finite)) in parameters.iter().zip(&all.finite).enumerate() {
        for (i, Finite { change, .. }) in finite.iter().enumerate() {
            for (side, change) in [-change, *change].into_iter().enumerate() {
                let model = (parameter.model_at)(parameter.nominal + change).ok();
                jobs.extend(model.map(|model| job(Some((number, i, side)), model)));
            }
        }
    }
    let (count, done) = (jobs.len(), AtomicUsize::new(0));
    let on_a_thread = count.div_ceil(rayon::current_num_threads()).max(1);
    let ended = || ran(done.fetch_add(1, Ordering::Relaxed) + 1, count);
    let jobs = jobs.into_par_iter().chunks(on_a_thread);
    let results: Vec<_> = jobs.flat_map_iter(|jobs| run(jobs, figures, &ended)).collect();
    for (place, seen) in results {
        match place {
            None => all.here = seen,
            Some((number, i, side)) => all.finite[number][i].sides[side] = seen,
        }
    }
    all
}

/// The same case at tight tolerances, recorded densely enough for figures to be differentiated.
pub fn tightly(model: Model) -> Model {
    let integrator = tight(&model.setup().integrator);
    // what a model cannot have it keeps as it was
    let model = model.clone().with_integrator(integrator).unwrap_or(model);
    model.clone().with_outputs_every(fine_interval_s(&model)).unwrap_or(model)
}

/// A run at tight tolerances.
fn job<T>(tag: T, model: Model) -> Job<T, Summarizer> {
    Job { tag, model: tightly(model), recorder: Summarizer::new() }
}

fn tight(own: &Integrator) -> Integrator {
    let mut tight = Integrator::default();
    if let Integrator::Adaptive { relative, absolute_m, absolute_m_s, min_step_s, max_step_s } = &mut tight {
        if let Integrator::Adaptive {
            relative: r,
            absolute_m: m,
            absolute_m_s: v,
            min_step_s: least,
            max_step_s: most,
        } = own
        {
            let pairs =
                [(&mut *relative, r), (&mut *absolute_m, m), (&mut *absolute_m_s, v), (&mut *min_step_s, least)];
            for (to, own) in pairs.into_iter().chain([(max_step_s, most)]) {
                *to = to.min(*own);
            }
        }
        // where a force jumps the error goes with the step: a tighter tolerance needs a shorter one
        let all = [relative, absolute_m, absolute_m_s, min_step_s].into_iter().zip(FINEST);
        all.for_each(|(x, finest)| *x = (*x * TIGHTER).max(finest));
    }
    tight
}

/// Results of the runs.
fn run<T>(jobs: Vec<Job<T, Summarizer>>, figures: &[String], ran: &impl Fn()) -> Vec<(T, Beside)> {
    let mut all = Vec::with_capacity(jobs.len());
    let times: Vec<String> = figures.iter().map(|name| format!("{name}_time")).collect();
    simulate_many(Kernel::best(), jobs, |ended: Ended<T, Summarizer>| {
        let Ended { tag, model, recorder, outcome, .. } = ended;
        let completed = outcome.ok().filter(|o| Ending::of(o) == Some(Ending::Completed));
        let seen = completed.zip(recorder.summary(None)).map(|(outcome, summary)| {
            let list = summary.figures(&model);
            let touches = outcome.first_touches.iter().map(|touch| [touch.sphere, touch.surface]).collect();
            Seen { figures: pick(&list, figures), times_s: pick(&list, &times), touches }
        });
        all.push((tag, seen.map_or(Beside::Broken, Beside::Ran)));
        ran();
        ControlFlow::Continue(())
    });
    all
}

impl Beside {
    /// Figure `i`, if the run has it.
    pub fn figure(&self, i: usize) -> Option<f64> {
        self.seen().and_then(|seen| seen.figures.get(i).copied()).filter(|x| x.is_finite())
    }

    /// The results, if it was completed.
    pub fn seen(&self) -> Option<&Seen> {
        if let Beside::Ran(seen) = self { Some(seen) } else { None }
    }
}
