//! The run: its origin, times, integrator, and its warnings.

use occupant_core::forces::contact::EdgeForce;
use occupant_core::model::setup::Integrator;
use occupant_units::unit::Unit::MetrePerSecondSquared;

use crate::print::{Case, Pages, Units};

/// Writes the first page.
pub(crate) fn write(pages: &mut Pages, case: &Case, units: Units) {
    pages.begin("INPUT: RUN");
    let setup = case.model.setup();
    pages.fact("TITLE", &setup.title);
    pages.fact("PROGRAM", case.known("program"));
    pages.fact("SCENARIO", case.known("scenario"));
    pages.fact("SHA-256", case.known("scenario_sha256"));
    for (name, content) in &case.file.attachments {
        pages.fact("ATTACHED", format!("{name}, {} BYTES", content.len()));
    }
    if let (Some(from), Some(at)) = (case.file.run.get("resumed_from"), case.file.run.get("resumed_at_s")) {
        pages.fact("RESUMED FROM", format!("{from} AT {at} SEC"));
    }
    if let Some(overrides) = case.file.run.get("overrides") {
        overrides.lines().for_each(|assignment| pages.fact("CHANGED BY", format!("--set {assignment}")));
    }
    pages.fact("UNITS", units.name());
    pages.fact("GRAVITY", units.of(MetrePerSecondSquared).say(setup.gravity_m_s2));
    let time = &setup.time;
    pages.fact("START", format!("{} SEC", time.start_s));
    pages.fact("END", format!("{} SEC", time.end_s));
    pages.fact("RECORDED EVERY", format!("{} SEC", time.output_s));
    pages.fact("INTEGRATION", integrator(&setup.integrator));
    let edge_force = match setup.edge_force {
        EdgeForce::AtContactPoint => "AT THE CONTACT POINT",
        EdgeForce::AtCentre => "AT THE CENTER OF THE SPHERE",
    };
    pages.fact("EDGE FORCE", edge_force);
    pages.say("");
    pages.fact("NOTATION", "VEHICLE COORDINATES: X FORWARD, Y RIGHT, Z DOWN FROM THE C.G. OF THE VEHICLE");
    let segment = "SEGMENT COORDINATES: X AHEAD, Y TO THE OCCUPANT'S LEFT, Z UP WHEN STANDING UPRIGHT, FROM THE C.G.";
    pages.fact("", segment);
    pages.fact("", "SPACE: X FORWARD, Y LEFT, Z UP");
    pages.fact("", "A MASS IN LB WEIGHS AS MANY LBF UNDER STANDARD GRAVITY");
    if let Some(notes) = &case.loaded.scenario.notes {
        pages.say("");
        pages.say("NOTES");
        pages.say(notes.trim_end());
    }
    for warning in &case.warnings {
        pages.say("");
        pages.say(warning);
    }
}

fn integrator(integrator: &Integrator) -> String {
    match *integrator {
        Integrator::Rk4 { step_s } => format!("RUNGE-KUTTA, FOURTH ORDER, STEP {step_s} SEC"),
        Integrator::Adaptive { relative, absolute_m, absolute_m_s, min_step_s, max_step_s } => format!(
            "RUNGE-KUTTA 5(4) WITH ERROR CONTROL: RELATIVE {relative:e}, ABSOLUTE {absolute_m:e} M AND {absolute_m_s:e} M/S, STEP FROM {min_step_s:e} TO {max_step_s:e} SEC"
        ),
    }
}
