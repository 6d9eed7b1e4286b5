//! `[time]`, `[integrator]`, `[output]` → [`TimeSpan`], [`Integrator`], [`OutputOptions`].

use super::builder::Builder;
use crate::forces::contact::EdgeForce;
use crate::model::setup::{DEFAULT_OUTPUT_S, Integrator, OutputOptions, TimeSpan};
use crate::scenario::model::{AdaptiveSection, EdgeForceChoice, IntegratorSection, Scenario};

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

/// The integrator.
pub(super) fn integrator(b: &mut Builder, s: &Scenario) -> Integrator {
    match &s.integrator {
        None => adaptive(b, &AdaptiveSection::default()),
        Some(IntegratorSection::Rk4(rk4)) => Integrator::Rk4 { step_s: b.si("integrator.step", &rk4.step) },
        Some(IntegratorSection::Adaptive(a)) => adaptive(b, a),
    }
}

fn adaptive(b: &mut Builder, a: &AdaptiveSection) -> Integrator {
    let mut integrator = Integrator::default();
    if let Integrator::Adaptive { relative, absolute_m, absolute_m_s, min_step_s, max_step_s } = &mut integrator {
        *min_step_s = b.optional("integrator.min_step", &a.min_step, *min_step_s);
        *max_step_s = b.optional("integrator.max_step", &a.max_step, *max_step_s);
        if max_step_s < min_step_s {
            let found = format!("a largest step of {max_step_s} s below the smallest, {min_step_s} s");
            b.error("integrator.max_step", found, "min_step ≤ max_step");
        }
        *relative = b.optional("integrator.relative", &a.relative, *relative);
        *absolute_m = b.optional("integrator.absolute_length", &a.absolute_length, *absolute_m);
        *absolute_m_s = b.optional("integrator.absolute_speed", &a.absolute_speed, *absolute_m_s);
    }
    integrator
}

/// Where the edge force acts.
pub(super) fn edge_force(s: &Scenario) -> EdgeForce {
    match s.contact.as_ref().and_then(|c| c.edge_force) {
        Some(EdgeForceChoice::Centre) => EdgeForce::AtCentre,
        Some(EdgeForceChoice::ContactPoint) => EdgeForce::AtContactPoint,
        None => EdgeForce::default(),
    }
}

/// Extra outputs.
pub(super) fn output(s: &Scenario) -> OutputOptions {
    OutputOptions { report_coordinates: s.output.as_ref().and_then(|o| o.report_coordinates) == Some(true) }
}
