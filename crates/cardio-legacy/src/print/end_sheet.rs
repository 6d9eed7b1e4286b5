//! The last sheet: how the run ended, and what an extension needs (series 6 and 14 of the cards): the pairs with
//! NARRY(J,K) = 0, the coordinates, the rest angles of the spine and what the elements keep.

use occupant_core::body::tti12::{LOWER_BACK, UPPER_BACK};
use occupant_core::motion::kinematics::Kinematics;
use occupant_core::motion::report_coordinates::ReportCoordinates;
use occupant_core::results::checkpoint::Checkpoint;
use occupant_core::results::summary::Caveat;

use super::echo::coordinates;
use super::{Case, ELEMENTS, Pages, Table, Units};

/// Writes the last sheet.
pub(crate) fn write(pages: &mut Pages, case: &Case, units: Units, caveats: &[Caveat]) {
    pages.begin("END OF SOLUTION");
    ending(pages, case);
    caveats.iter().for_each(|caveat| pages.say(&format!("*** {}", caveat.text)));
    if let Some(last) = case.file.checkpoints.last() {
        extension(pages, case, units, last);
    }
    pages.block(&["END OF PRINTOUT".to_owned()], 0);
}

/// End of the run, with emphasis if it is incomplete.
fn ending(pages: &mut Pages, case: &Case) {
    let end_s = case.model.setup().time.end_s;
    let outputs = &case.file.checkpoints;
    let reached = outputs.last().map_or_else(
        || "NO OUTPUT IS IN THE FILE".to_owned(),
        |last| format!("LAST OUTPUT AT {:.6} SEC OF {end_s:.6} SEC, {} OUTPUTS", last.time_s, outputs.len()),
    );
    let Some(result) = &case.file.result else {
        pages.say("*** PARTIAL: THE FILE WAS CUT OFF; IT HOLDS NO END OF THE RUN ***");
        pages.say(&reached);
        return;
    };
    let known = |key: &str| result.get(key).map_or("-", String::as_str);
    let imbalance: f64 = known("balance_error").parse().unwrap_or(f64::NAN);
    // files of 0.1.0 do not say it
    let reference = result.get("balance_reference").map_or("greatest kinetic energy", |words| words);
    match known("status") {
        "completed" => pages.say("THE RUN REACHED ITS END TIME"),
        status => pages.say(&format!("*** PARTIAL: THE RUN WAS NOT COMPLETED ({status}): {} ***", known("reason"))),
    }
    pages.say(&reached);
    pages.say(&format!(
        "GREATEST ENERGY IMBALANCE {imbalance:.2E} OF THE {}; {} STEPS, {} REJECTED, {} EVALUATIONS",
        reference.to_uppercase(),
        known("steps"),
        known("rejected"),
        known("evaluations")
    ));
}

fn extension(pages: &mut Pages, case: &Case, units: Units, checkpoint: &Checkpoint) {
    pages.say("");
    if !case.is_of_report() {
        return pages.say("CARDS HAVE ROOM FOR THE REPORT'S BODY ALONE; `occupant run --resume` CONTINUES THIS RUN.");
    }
    pages.say("TO EXTEND THIS SOLUTION BY CARDS (SERIES 6 AND 14), FROM THE CHECKPOINT OF THE LAST OUTPUT.");
    pages.say("CARDS CARRY NO GREATEST DEFORMATION, SO AN EXTENSION BY CARDS IS APPROXIMATE; `occupant run --resume` IS EXACT.");
    let numbers = if case.numbers_of_report {
        "SURFACE NUMBERS ARE THOSE OF THE CARDS"
    } else {
        "SURFACES ARE NUMBERED IN THE ORDER OF THE SCENARIO"
    };
    pairs(
        pages,
        case,
        &format!("PAIRS WITH NARRY(J,K) = 0: THE SPHERE HAS PASSED THE SURFACE'S EDGE ({numbers})"),
        &case.passed(&checkpoint.memory.contacts),
    );
    let state = Checkpoint::state_of(&case.model, &checkpoint.state);
    if let Some(q) = state.ok().and_then(|state| ReportCoordinates::from_state(&state)) {
        coordinates(pages, units, "GENERALIZED COORDINATES AT THE END", &q);
    }
    pages.say("");
    let [upper, lower] = spine_rest_rad(case);
    pages.say(&format!("REST ANGLES OF THE BACK JOINTS: BETA4 {upper:.6} RAD, BETA7 {lower:.6} RAD"));
    ELEMENTS.iter().for_each(|element| (element.end)(pages, case, units));
}

/// β₀ of the upper and the lower back joint, rad: the scenario's, or the angles at the start.
fn spine_rest_rad(case: &Case) -> [f64; 2] {
    let (system, joints) = (case.model.system(), &case.model.setup().joints);
    let start = Kinematics::new(&system.skeleton, &case.model.start().state);
    [UPPER_BACK, LOWER_BACK].map(|joint| {
        let ball = system.forces.joints.balls.iter().position(|ball| ball.joint == joint);
        let at_start = ball.map_or(f64::NAN, |i| system.forces.joints.beta(i, &start));
        joints[joint].ball().and_then(|data| data.spring?.rest_rad).unwrap_or(at_start)
    })
}

/// A list of pairs, two per line.
pub(crate) fn pairs(pages: &mut Pages, case: &Case, title: &str, passed: &[(usize, usize)]) {
    let mut table = Table::new(title, "J|<SPHERE|<K  SURFACE|J|<SPHERE|<K  SURFACE");
    for row in passed.chunks(2) {
        let pair = |&(sphere, surface): &(usize, usize)| {
            [(sphere + 1).to_string(), case.sphere(sphere), case.surface(surface)]
        };
        table.row(row.iter().flat_map(pair));
    }
    table.write_or(pages, &[title, "NONE"]);
}
