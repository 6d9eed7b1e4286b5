//! Titles, times and switches, the end of the numbers, the plot option (series 1–3, 15, 16).

use super::{Field, Format, SeriesLayout, TERMINATOR, Unit, ncard, only_card, real};
use crate::columns::Columns;

const fn text(first: u8, last: u8, variable: &'static str, description: &'static str) -> Field {
    Field { columns: Columns::new(first, last), format: Format::Text, variable, unit: Unit::One, description }
}

pub(super) const TITLE: SeriesLayout = SeriesLayout {
    number: 1,
    ncard: None,
    title: "title",
    cards: &[only_card("20A4", &[text(1, 80, "HED", "text printed at the top of each page")])],
};

pub(super) const TITLE_CONTINUED: SeriesLayout = SeriesLayout {
    number: 2,
    ncard: None,
    title: "title, continued",
    cards: &[only_card("20A4", &[text(1, 80, "HED", "second line of the title")])],
};

pub(super) const TIMES: SeriesLayout = SeriesLayout {
    number: 3,
    ncard: Some(3),
    title: "times and switches",
    cards: &[only_card(
        "7F10.0,I10",
        &[
            real(1, "T1", Unit::Second, "initial time"),
            real(11, "TF", Unit::Second, "final time"),
            real(21, "DT", Unit::Second, "step of the integration"),
            real(31, "DTPRNT", Unit::Second, "print interval"),
            real(
                41,
                "MREAD",
                Unit::One,
                "0: the vehicle path stands on series 12; else the number of stations to read from disk",
            ),
            real(51, "NPOS", Unit::One, "0: seating by series 4 and 10; 1: initial state on series 6"),
            real(61, "NDISK", Unit::One, "0: plot data go to disk; 1: they do not"),
            ncard("card number 3"),
        ],
    )],
};

pub(super) const END_OF_NUMBERS: SeriesLayout = SeriesLayout {
    number: 15,
    ncard: Some(TERMINATOR),
    title: "end of the numbers",
    cards: &[only_card("70X,I10", &[ncard("card number 1000")])],
};

pub(super) const PLOT: SeriesLayout = SeriesLayout {
    number: 16,
    ncard: None,
    title: "plot option",
    cards: &[only_card("A4", &[text(1, 4, "HED(1)", "STAN: plots of 14 variables against time; NONE: no plots")])],
};
