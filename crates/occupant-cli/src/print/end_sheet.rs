//! The last sheet: how the run ended, and what an extension needs (series 6 and 14 of the cards): the pairs with
//! NARRY(J,K) = 0, the coordinates, the rest angles of the spine and the belts' lengths.

use super::case::Case;
use super::echo::coordinates;
use super::last_state::LastState;
use super::page::Pages;
use super::table::Table;
use super::unit::Units;

/// A repeated run that ends farther than this from the recorded one is another run, m.
const SAME_M: f64 = 1e-6;

/// Writes the last sheet.
pub fn write(pages: &mut Pages, case: &Case, units: &Units, times_s: &[f64]) -> Result<(), String> {
    pages.begin("END OF SOLUTION");
    ending(pages, case, times_s);
    let Some(last) = times_s.len().checked_sub(1) else {
        return Ok(());
    };
    match LastState::repeated(case, last) {
        Ok(state) if state.difference_m <= SAME_M => extension(pages, case, units, &state),
        Ok(state) => withheld(
            pages,
            &format!(
                "REPEATED, THE RUN ENDS {:.3E} M AWAY FROM THE RECORDED ONE (ANOTHER VERSION, OR A RUN THAT WAS RESUMED)",
                state.difference_m
            ),
        ),
        Err(reason) => withheld(pages, &reason),
    }
    pages.block(&["END OF PRINTOUT".to_owned()], 0);
    Ok(())
}

/// How far the run got, loudly where it is not complete.
fn ending(pages: &mut Pages, case: &Case, times_s: &[f64]) {
    let end_s = case.model.setup().time.end_s;
    let reached = times_s.last().map_or_else(
        || "NO OUTPUT IS IN THE FILE".to_owned(),
        |t| {
            format!(
                "LAST OUTPUT AT {t:.6} SEC OF {end_s:.6} SEC, {} OUTPUTS",
                times_s.len()
            )
        },
    );
    let Some(result) = &case.file.result else {
        pages.say("*** PARTIAL: THE FILE WAS CUT OFF; IT HOLDS NO END OF THE RUN ***");
        pages.say(&reached);
        return;
    };
    let known = |key: &str| result.get(key).map_or("-", String::as_str);
    match known("status") {
        "completed" => pages.say("THE RUN REACHED ITS END TIME"),
        status => pages.say(&format!(
            "*** PARTIAL: THE RUN WAS NOT COMPLETED ({status}): {} ***",
            known("reason")
        )),
    }
    pages.say(&reached);
    if let Some(broken) = &case.file.broken {
        pages.say(&format!("*** THE FILE IS DAMAGED: {broken} ***"));
    }
    pages.say(&format!(
        "GREATEST ENERGY IMBALANCE {} OF THE GREATEST KINETIC ENERGY; {} STEPS, {} REJECTED, {} EVALUATIONS",
        known("balance_error"),
        known("steps"),
        known("rejected"),
        known("evaluations")
    ));
}

fn withheld(pages: &mut Pages, reason: &str) {
    pages.say("");
    pages.say("PAIRS WITH NARRY(J,K) = 0 AND COORDINATES AT THE END: NOT GIVEN.");
    pages.say(reason);
}

fn extension(pages: &mut Pages, case: &Case, units: &Units, state: &LastState) {
    pages.say("");
    pages.say("TO EXTEND THIS SOLUTION (CARDS OF SERIES 6 AND 14). THE PAIR STATES WERE FOUND BY REPEATING THE RUN;");
    match state.difference_m == 0.0 {
        true => pages.say("ITS END IS THE RECORDED ONE TO THE LAST BIT."),
        false => pages.say(&format!(
            "ITS END IS THE RECORDED ONE TO {:.1E} M.",
            state.difference_m
        )),
    }
    pages
        .say("THESE PAIRS CARRY NO GREATEST DEFORMATION, SO AN EXTENSION BY CARDS IS APPROXIMATE.");
    let numbers = match case.numbers_of_report {
        true => "SURFACE NUMBERS ARE THOSE OF THE CARDS",
        false => "SURFACES ARE NUMBERED IN THE ORDER OF THE SCENARIO",
    };
    pairs(
        pages,
        case,
        &format!("PAIRS WITH NARRY(J,K) = 0: THE SPHERE HAS PASSED THE SURFACE'S EDGE ({numbers})"),
        &state.passed,
    );
    coordinates(
        pages,
        units,
        "GENERALIZED COORDINATES AT THE END",
        &state.coordinates,
    );
    let [upper, lower] = state.spine_rest_rad;
    pages.say("");
    pages.say(&format!(
        "REST ANGLES OF THE BACK JOINTS: BETA4 {upper:.6} RAD, BETA7 {lower:.6} RAD"
    ));
    for (belt, law) in case
        .model
        .setup()
        .belts
        .iter()
        .zip(&case.model.system().belts)
    {
        pages.say(&format!(
            "UNSTRETCHED LENGTH OF THE BELT {}: {} {}",
            belt.name,
            units.length.show(law.rest_length),
            units.length.name
        ));
    }
}

/// A list of pairs, three to a line.
pub fn pairs(pages: &mut Pages, case: &Case, title: &str, passed: &[(usize, usize)]) {
    let head = ["J", "<SPHERE", "<K  SURFACE"];
    let mut table = Table::new(title, &[head, head, head].concat());
    for row in passed.chunks(3) {
        let pair = |&(sphere, surface): &(usize, usize)| {
            let name = case
                .model
                .body()
                .spheres
                .get(sphere)
                .map(|s| s.name.clone());
            [
                (sphere + 1).to_string(),
                name.unwrap_or_default(),
                case.surface(surface),
            ]
        };
        table.row(row.iter().flat_map(pair));
    }
    match table.is_empty() {
        true => pages.block(&[title.to_owned(), "NONE".to_owned()], 0),
        false => table.write(pages),
    }
}
