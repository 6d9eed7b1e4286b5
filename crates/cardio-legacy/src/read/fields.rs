//! The numbers of one card, read by its layout.

use crate::cards::{CardId, CardLayout, Field, Format};
use crate::deck::Number;
use crate::diagnostics::{Diagnostic, Sink};
use crate::fortran::{FieldError, Surprise, read_integer, read_real};
use crate::punched::{Columns, PunchedCard, latin1};
use crate::rule::Rule;

/// Columns in which a punch may number the cards of a deck, where the format leaves them free.
const SEQUENCE: Columns = Columns::new(73, 80);

/// Reads every field of a card but NCARD, which [`super::series`] reads, and looks at the columns in between.
pub(super) fn read_fields(card: &PunchedCard, layout: &CardLayout, id: CardId, sink: &mut Sink) -> Vec<Number> {
    check_free_columns(card, layout, id, sink);
    let mut read = |field: &Field| match &*field.variable {
        "NCARD" => Number::blank(),
        _ => read_field(card, layout, field, id, sink),
    };
    layout.fields.iter().map(&mut read).collect()
}

/// Reads one numeric field.
fn read_field(card: &PunchedCard, layout: &CardLayout, field: &Field, id: CardId, sink: &mut Sink) -> Number {
    let bytes = card.field(field.columns);
    let reading = match field.format {
        Format::Real => read_real(bytes),
        Format::Integer => read_integer(bytes),
        Format::Text => return Number::blank(),
    };
    let mut report = |(rule, message, columns, remedy): Problem| {
        sink.report(
            Diagnostic::new(rule, message)
                .on(card)
                .in_card(id)
                .variable(layout.name_of(field, id.number))
                .at(columns)
                .expected(expectation(field))
                .remedy(remedy),
        );
    };
    match reading {
        Ok(reading) => {
            reading.surprises.iter().for_each(|surprise| report(surprising(*surprise, bytes, &reading.digits, field)));
            Number { value: reading.value, digits: reading.digits, blank: reading.blank }
        }
        Err(error) => {
            report(unreadable(&error, bytes, field));
            Number::unreadable()
        }
    }
}

/// What is wrong with a field: rule, message, columns, remedy.
type Problem = (Rule, String, Columns, &'static str);

fn unreadable(error: &FieldError, bytes: &[u8], field: &Field) -> Problem {
    let what = &field.meaning;
    let shown = latin1(bytes);
    match error {
        FieldError::Character { offset, found } => {
            let column = field.columns.first.saturating_add(u8::try_from(*offset).unwrap_or(0));
            let message = format!("`{shown}` is no number: {} in column {column}; {what}", character(*found));
            let remedy = "punch the number again; look whether a neighbouring field has slipped into these columns";
            (Rule::NotANumber, message, Columns::new(column, column), remedy)
        }
        FieldError::NoDigits => {
            let message = format!("`{shown}` has no digit; {what}");
            (Rule::NotANumber, message, field.columns, "punch the number, or leave the field blank for zero")
        }
        FieldError::EmptyExponent => {
            let message = format!("`{shown}` has an exponent without digits; {what}");
            let remedy = "move the number to the left so that its exponent ends inside the field";
            (Rule::NotANumber, message, field.columns, remedy)
        }
        FieldError::TooLarge { digits } => {
            let message = format!("`{shown}` reads as {digits}, more than the 360 could hold; {what}");
            let remedy = "an exponent must end in the last column of the field, because blanks behind it are zeros";
            (Rule::OutOfRange, message, field.columns, remedy)
        }
    }
}

fn character(byte: u8) -> String {
    match byte {
        b' ' => "a blank".to_owned(),
        0x21..=0x7e | 0xa0.. => format!("`{}`", char::from(byte)),
        _ => format!("the control character 0x{byte:02x}"),
    }
}

/// What a field takes, in words.
fn expectation(field: &Field) -> String {
    let width = field.columns.width();
    match field.format {
        Format::Real if field.unit.symbol.is_empty() => format!("a number in F{width}.0"),
        Format::Real => format!("a number in F{width}.0, in {}", field.unit.symbol),
        Format::Integer => format!("an integer in I{width}, right-justified"),
        Format::Text => "text".to_owned(),
    }
}

fn surprising(surprise: Surprise, bytes: &[u8], digits: &str, field: &Field) -> Problem {
    let shown = latin1(bytes);
    let (rule, message, remedy) = match surprise {
        Surprise::EmbeddedBlanks => (
            Rule::EmbeddedBlanks,
            format!("`{shown}` reads as {digits}: FORTRAN IV takes blanks inside a number as zeros"),
            "close the gap, or punch the zeros",
        ),
        Surprise::TrailingBlanks => (
            Rule::LeftJustified,
            format!("`{shown}` reads as {digits}: FORTRAN IV takes the blanks behind the last digit as zeros"),
            match field.format {
                Format::Integer => "punch the integer at the right end of its field",
                _ => "punch a decimal point, or move the number to the right end of its field",
            },
        ),
        Surprise::BareExponent => {
            (Rule::BareExponent, format!("`{shown}` reads as {digits}: an exponent without its letter"), "punch the E")
        }
        Surprise::SmallLetter => (
            Rule::SmallLetter,
            format!("`{shown}` has a small exponent letter, which no card punch had"),
            "punch E or D",
        ),
        Surprise::Underflow => (
            Rule::Underflow,
            format!("`{shown}` was zero on the 360, which held nothing smaller than 5.4e-79"),
            "punch 0.",
        ),
    };
    (rule, message, field.columns, remedy)
}

/// Reports what stands in columns that no field covers, sequence numbers excepted.
fn check_free_columns(card: &PunchedCard, layout: &CardLayout, id: CardId, sink: &mut Sink) {
    for gap in gaps(layout) {
        if card.is_blank_in(gap) {
            continue;
        }
        let field = card.field(gap);
        let first = field.iter().position(|b| *b != b' ').unwrap_or(0);
        let last = field.iter().rposition(|b| *b != b' ').unwrap_or(0);
        let at = |offset: usize| gap.first + u8::try_from(offset).unwrap_or(0);
        let punched = Columns::new(at(first), at(last));
        let message = format!("`{}` stands where the card is blank; it is not read", card.text_of(punched));
        sink.report(
            Diagnostic::new(Rule::NotBlank, message)
                .on(card)
                .in_card(id)
                .at(punched)
                .expected(format!("blanks in {gap}"))
                .remedy("look whether a number has slipped out of its columns, or remove it"),
        );
    }
}

/// The columns between the fields of a card; 73–80 are free for sequence numbers where no field reaches column 71.
fn gaps(layout: &CardLayout) -> Vec<Columns> {
    let mut gaps = Vec::new();
    let mut next = 1;
    for field in &layout.fields {
        if field.columns.first > next {
            gaps.push(Columns::new(next, field.columns.first - 1));
        }
        next = field.columns.last + 1;
    }
    if next < SEQUENCE.first {
        gaps.push(Columns::new(next, SEQUENCE.first - 1));
    }
    gaps
}
