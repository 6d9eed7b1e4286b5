//! `[time]`, `[integrator]`, `[output]` → [`TimeSpan`], [`Integrator`], [`OutputOptions`].

use super::builder::Builder;
use crate::forces::contact::EdgeForce;
use crate::model::setup::{Integrator, OutputOptions, TimeSpan};
use crate::scenario::model::{AdaptiveSection, EdgeForceChoice, IntegratorSection, Scenario};

/// Time between records unless given: 1 ms.
const DEFAULT_OUTPUT_S: f64 = 1e-3;

/// Start, end and output interval.
pub(super) fn time(b: &mut Builder, s: &Scenario) -> TimeSpan {
    let interval = s.output.as_ref().and_then(|o| o.interval.clone());
    let span = TimeSpan {
        start_s: b.optional("time.start", &s.time.start, 0.0),
        end_s: b.si("time.end", &s.time.end),
        output_s: b.optional("output.interval", &interval, DEFAULT_OUTPUT_S),
    };
    if span.end_s <= span.start_s {
        let found = format!("a run from {} s to {} s", span.start_s, span.end_s);
        b.error("time.end", found, "an end after the start");
    }
    span
}

/// The integrator; the defaults are chosen in `docs/accuracy.md`.
pub(super) fn integrator(b: &mut Builder, s: &Scenario) -> Integrator {
    match &s.integrator {
        None => adaptive(b, &AdaptiveSection::default()),
        Some(IntegratorSection::Rk4(rk4)) => Integrator::Rk4 { step_s: b.si("integrator.step", &rk4.step) },
        Some(IntegratorSection::Adaptive(a)) => adaptive(b, a),
    }
}

fn adaptive(b: &mut Builder, a: &AdaptiveSection) -> Integrator {
    let (min_step_s, max_step_s) =
        (b.optional("integrator.min_step", &a.min_step, 1e-8), b.optional("integrator.max_step", &a.max_step, 2e-3));
    if max_step_s < min_step_s {
        let found = format!("a largest step of {max_step_s} s below the smallest, {min_step_s} s");
        b.error("integrator.max_step", found, "min_step ≤ max_step");
    }
    Integrator::Adaptive {
        relative: b.optional("integrator.relative", &a.relative, 3e-6),
        absolute_m: b.optional("integrator.absolute_length", &a.absolute_length, 3e-7),
        absolute_m_s: b.optional("integrator.absolute_speed", &a.absolute_speed, 3e-5),
        min_step_s,
        max_step_s,
    }
}

/// Where the edge force acts.
pub(super) fn edge_force(s: &Scenario) -> EdgeForce {
    match s.contact.as_ref().and_then(|c| c.edge_force) {
        Some(EdgeForceChoice::Centre) => EdgeForce::AtCentre,
        Some(EdgeForceChoice::ContactPoint) | None => EdgeForce::AtContactPoint,
    }
}

/// Extra outputs.
pub(super) fn output(s: &Scenario) -> OutputOptions {
    OutputOptions { report_coordinates: s.output.as_ref().and_then(|o| o.report_coordinates) == Some(true) }
}
