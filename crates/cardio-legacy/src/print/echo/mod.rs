//! The echo of everything read, and of what was computed from it before the first step (the report's PRNTIN).

mod body;
mod cards;
mod compartment;
mod joints;
mod path;
mod run;
mod seating;
mod sensors;

pub(crate) use seating::coordinates;

use super::{Case, ELEMENTS, Pages, Units, headings};

/// Writes the echo.
pub(crate) fn write(pages: &mut Pages, case: &Case, units: Units) {
    let units = units.as_read();
    run::write(pages, case, units);
    cards::write(pages, case);
    pages.begin("INPUT: OCCUPANT");
    body::write(pages, case, units);
    joints::write(pages, case, units);
    pages.begin(&format!("INPUT: COMPARTMENT AND {}", headings()));
    compartment::write(pages, case, units);
    ELEMENTS.iter().for_each(|element| (element.input)(pages, case, units));
    pages.begin("INPUT: PATH OF THE VEHICLE");
    path::write(pages, case, units);
    pages.begin("INPUT AND COMPUTED: THE OCCUPANT AT THE START");
    seating::write(pages, case, units);
}
