//! The numbers of one card, read by its layout.

use crate::card::{Card, latin1};
use crate::columns::Columns;
use crate::deck::Number;
use crate::diagnostic::{Finding, Sink};
use crate::field::{FieldError, Reading, Surprise, read_integer, read_real};
use crate::layout::{CardId, CardLayout, Field, Format};
use crate::rule::Rule;

/// Columns in which a punch may number the cards of a deck, where the format leaves them free.
const SEQUENCE: Columns = Columns::new(73, 80);

/// Reads every field of a card but NCARD, which [`crate::series_reader`] reads, and looks at the columns in between.
pub(crate) fn read_fields(card: &Card, layout: &CardLayout, id: CardId, sink: &mut Sink) -> Vec<Number> {
    check_free_columns(card, layout, id, sink);
    layout
        .fields
        .iter()
        .map(|field| match field.variable {
            "NCARD" => Number::blank(),
            _ => read_field(card, layout, field, id, sink),
        })
        .collect()
}

/// Reads one numeric field.
pub(crate) fn read_field(card: &Card, layout: &CardLayout, field: &Field, id: CardId, sink: &mut Sink) -> Number {
    let bytes = card.field(field.columns);
    let reading = match field.format {
        Format::Real => read_real(bytes),
        Format::Integer => read_integer(bytes),
        Format::Text => return Number::blank(),
    };
    let name = layout.name_of(field, id.number);
    let finding = |rule, message: String| Finding::new(rule, message).on(card).in_card(id).variable(name.clone());
    match reading {
        Ok(reading) => {
            for surprise in &reading.surprises {
                sink.report(surprise_finding(*surprise, bytes, &reading, field, finding));
            }
            Number { value: reading.value, digits: reading.digits, blank: reading.blank }
        }
        Err(error) => {
            sink.report(error_finding(&error, bytes, field, finding));
            Number::unreadable()
        }
    }
}

fn error_finding(
    error: &FieldError,
    bytes: &[u8],
    field: &Field,
    finding: impl Fn(Rule, String) -> Finding,
) -> Finding {
    let what = field.description;
    let shown = latin1(bytes);
    let expected = expectation(field);
    let (rule, message, columns, remedy) = match error {
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
    };
    finding(rule, message).at(columns).expected(expected).remedy(remedy)
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
        Format::Real if field.unit.symbol().is_empty() => format!("a number in F{width}.0"),
        Format::Real => format!("a number in F{width}.0, in {}", field.unit.symbol()),
        Format::Integer => format!("an integer in I{width}, right-justified"),
        Format::Text => "text".to_owned(),
    }
}

fn surprise_finding(
    surprise: Surprise,
    bytes: &[u8],
    reading: &Reading,
    field: &Field,
    finding: impl Fn(Rule, String) -> Finding,
) -> Finding {
    let shown = latin1(bytes);
    let digits = &reading.digits;
    let (rule, message, remedy) = match surprise {
        Surprise::EmbeddedBlanks => (
            Rule::EmbeddedBlanks,
            format!("`{shown}` reads as {digits}: FORTRAN IV takes blanks inside a number as zeros"),
            "close the gap, or punch the zeros",
        ),
        Surprise::TrailingBlanks => (
            Rule::LeftJustified,
            format!("`{shown}` reads as {digits}: FORTRAN IV takes the blanks behind the last digit as zeros"),
            if field.format == Format::Integer {
                "punch the integer at the right end of its field"
            } else {
                "punch a decimal point, or move the number to the right end of its field"
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
    finding(rule, message).at(field.columns).expected(expectation(field)).remedy(remedy)
}

/// Reports what stands in columns that no field covers, sequence numbers excepted.
fn check_free_columns(card: &Card, layout: &CardLayout, id: CardId, sink: &mut Sink) {
    for gap in gaps(layout) {
        if card.is_blank_in(gap) {
            continue;
        }
        let field = card.field(gap);
        let first = field.iter().position(|b| *b != b' ').unwrap_or(0);
        let last = field.iter().rposition(|b| *b != b' ').unwrap_or(0);
        let at = |offset: usize| gap.first + u8::try_from(offset).unwrap_or(0);
        let punched = Columns::new(at(first), at(last));
        sink.report(
            Finding::new(
                Rule::NotBlank,
                format!("`{}` stands where the card is blank; it is not read", card.text_of(punched)),
            )
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
    for field in layout.fields {
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
