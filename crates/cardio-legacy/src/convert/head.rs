//! Title, notes, gravity, times (cards 1–3, 11e).

use super::ConvertOptions;
use super::writer::{Writer, escaped, quoted};
use crate::compartment::CompartmentLayout;
use crate::deck::Plot;
use crate::notes::{self, kept_of, to_notes};

pub(super) fn write(w: &mut Writer<'_>, options: &ConvertOptions, layout: &CompartmentLayout) {
    let [title, more] = w.deck.titles().clone();
    w.comment(format!("{title}\n{more}").trim_end());
    w.comment("\n");
    w.comment(&format!(
        "Converted from the card deck {}. Numbers are the cards'; comments name the cards they come from.",
        options.deck_name
    ));
    w.blank_line();
    w.set_with("title", &quoted(if title.is_empty() { "untitled" } else { &title }), "card 1");
    w.set_with("units", "\"in-lbf-s\"", "bare numbers: in, lbf, s; angles in degrees");
    w.field_with("GR", "card 11e, GR");
    let mut kept = kept_of(w.deck);
    if title.is_empty() {
        kept.insert(notes::TITLE_1.into(), String::new());
    }
    super::compartment::keep_left_out(w, layout, &mut kept);
    w.blank_line();
    w.raw(&format!("notes = \"\"\"\n{}\"\"\"\n", escaped(&to_notes(&kept))));
    times(w);
    switches(w);
}

fn times(w: &mut Writer<'_>) {
    w.table("time", "Card 3");
    w.field("T1");
    w.field("TF");
    w.table("integrator", "Card 3; the report's method with its fixed step");
    w.set("kind", "\"rk4\"");
    w.field("DT");
    w.table("output", "Card 3");
    w.field("DTPRNT");
    if w.value("NDISK") == 0.0 {
        w.set_with("report_coordinates", "true", "NDISK = 0: data for plots go to disk");
    }
}

/// Switches with another meaning today.
fn switches(w: &mut Writer<'_>) {
    let on_disk = w.value("NDISK") == 0.0;
    let plots = match w.deck.plot() {
        Plot::Standard if on_disk => {
            "STAN (card 16): 14 plots were drawn, of variables that the report does not name; `occupant run` of the deck draws fourteen of our choice, `occupant plot` those of any run"
        }
        Plot::Standard => {
            "STAN (card 16) asks for 14 plots of data that NDISK = 1 (card 3) kept off the disk; `occupant run` of the deck draws fourteen of our choice, `occupant plot` those of any run"
        }
        Plot::None => "NONE (card 16): no plots were drawn; `occupant plot` can draw them from any run nevertheless",
    };
    let disk = if on_disk {
        "NDISK = 0 (card 3): plot data went to disk; the report's coordinates are recorded as well"
    } else {
        "NDISK = 1 (card 3): no plot data went to disk; the results are written nevertheless"
    };
    w.report.assumptions.extend([plots.to_owned(), disk.to_owned()]);
    w.report.assumptions.push("friction grows with sliding speed below 5 in/s and joint angles are smoothed by ε = 0.001, as everywhere in this program".into());
    for (series, text) in [
        (6, "series 6 (coordinates): NPOS = 0 seats the occupant"),
        (4, "series 4 (velocity): NPOS = 1 takes the state from series 6"),
        (10, "series 10 (seating): NPOS = 1 takes the state from series 6"),
        (12, "series 12 (path): MREAD ≠ 0 takes it from the path file"),
    ] {
        if w.deck.has_series(series) && w.deck.is_superfluous(series) {
            w.report.ignored.push(text.to_owned());
        }
    }
    let pairs = w.deck.passed_pairs().len();
    if w.deck.has_series(14) && w.value("NPOS") == 1.0 {
        w.report.assumptions.push(format!(
            "series 14: its {pairs} pairs have passed each other, all others that overlap touch. Cards carry no greatest \
             deformation, so an extension by cards is approximate; `occupant run --resume` of the recorded run is exact"
        ));
    } else if w.deck.has_series(14) {
        w.report.ignored.push(format!(
            "series 14 ({pairs} passed pairs): NPOS = 0 seats the occupant, and there is no run to extend"
        ));
    }
}
