//! What the run is: its origin, times, integrator, and what was said about it.

use occupant_core::forces::contact::EdgeForce;
use occupant_core::model::setup::Integrator;

use crate::jobs::print::case::Case;
use crate::jobs::print::page::Pages;
use crate::jobs::print::unit::Units;

/// Writes the first page.
pub(crate) fn write(pages: &mut Pages, case: &Case, units: &Units) {
    pages.begin("INPUT: RUN");
    let setup = case.model.setup();
    let known = |key: &str| case.file.run.get(key).map_or("-", String::as_str);
    pages.say(&format!("TITLE          {}", setup.title));
    pages.say(&format!("PROGRAM        {}", known("program")));
    pages.say(&format!("SCENARIO       {}", known("scenario")));
    pages.say(&format!("SHA-256        {}", known("scenario_sha256")));
    for (name, content) in &case.file.attachments {
        pages.say(&format!("ATTACHED       {name}, {} BYTES", content.len()));
    }
    if let (Some(from), Some(at)) = (case.file.run.get("resumed_from"), case.file.run.get("resumed_at_s")) {
        pages.say(&format!("RESUMED FROM   {from} AT {at} SEC"));
    }
    if let Some(overrides) = case.file.run.get("overrides") {
        for assignment in overrides.lines() {
            pages.say(&format!("CHANGED BY     --set {assignment}"));
        }
    }
    pages.say(&format!("UNITS          {}", units.name));
    let gravity = units.acceleration.show(setup.gravity_m_s2);
    pages.say(&format!("GRAVITY        {gravity} {}", units.acceleration.name));
    let time = &setup.time;
    pages.say(&format!("START          {} SEC", time.start_s));
    pages.say(&format!("END            {} SEC", time.end_s));
    pages.say(&format!("RECORDED EVERY {} SEC", time.output_s));
    pages.say(&format!("INTEGRATION    {}", integrator(&setup.integrator)));
    let edge_force = match setup.edge_force {
        EdgeForce::AtContactPoint => "AT THE CONTACT POINT",
        EdgeForce::AtCentre => "AT THE CENTER OF THE SPHERE",
    };
    pages.say(&format!("EDGE FORCE     {edge_force}"));
    pages.say("");
    pages.say("NOTATION       VEHICLE COORDINATES: X FORWARD, Y RIGHT, Z DOWN FROM THE C.G. OF THE VEHICLE");
    pages.say("               SEGMENT COORDINATES: X AHEAD, Y TO THE OCCUPANT'S LEFT, Z UP WHEN STANDING UPRIGHT, FROM THE C.G.");
    pages.say("               SPACE: X FORWARD, Y LEFT, Z UP");
    pages.say("               A MASS IN LB WEIGHS AS MANY LBF UNDER STANDARD GRAVITY");
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
