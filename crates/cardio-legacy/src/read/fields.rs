//! The numbers of one card, read by its layout.

use crate::cards::{CardId, CardLayout, Field, Format};
use crate::deck::Number;
use crate::diagnostics::{Diagnostic, Sink};
use crate::fortran::{FieldError, read_integer, read_real};
use crate::punched::{Columns, PunchedCard};
use crate::rule::Rule;

/// Columns in which a punch may number the cards of a deck, if the format leaves them free.
const SEQUENCE: Columns = Columns::new(73, 80);

/// Reads every field of a card except NCARD, which [`super::series`] reads, and checks the columns between.
pub(super) fn read_fields(card: &PunchedCard, layout: &CardLayout, id: CardId, sink: &mut Sink) -> Vec<Number> {
    check_free_columns(card, layout, id, sink);
    let mut read = |field: &Field| match &*field.variable {
        "NCARD" => Number::blank(),
        _ => FieldOnCard { card, id, field, name: layout.name_of(field, id.number) }.read(sink),
    };
    layout.fields.iter().map(&mut read).collect()
}

/// A numeric field of a card being read.
struct FieldOnCard<'a> {
    card: &'a PunchedCard,
    id: CardId,
    field: &'a Field,
    name: String,
}

impl FieldOnCard<'_> {
    fn read(&self, sink: &mut Sink) -> Number {
        let bytes = self.card.field(self.field.columns);
        let reading = match self.field.format {
            Format::Real => read_real(bytes),
            Format::Integer => read_integer(bytes),
            Format::Text => return Number::blank(),
        };
        match reading {
            Ok(reading) => {
                for surprise in reading.surprises {
                    self.surprising(surprise, &reading.digits).report(sink);
                }
                Number { value: reading.value, digits: reading.digits, blank: reading.blank }
            }
            Err(error) => {
                self.unreadable(&error).report(sink);
                Number::unreadable()
            }
        }
    }

    fn problem(&self, rule: Rule, message: String) -> Diagnostic {
        let problem = Diagnostic::new(rule, message).on(self.card).in_card(self.id).in_field(self.field);
        problem.variable(&self.name).expected(expectation(self.field))
    }

    fn unreadable(&self, error: &FieldError) -> Diagnostic {
        let (shown, what) = (self.card.text_of(self.field.columns), &self.field.meaning);
        match error {
            FieldError::Character { offset, found } => {
                let column = self.field.columns.first.saturating_add(u8::try_from(*offset).unwrap_or(0));
                let message = format!("`{shown}` is no number: {} in column {column}; {what}", character(*found));
                let remedy = "punch the number again; look whether a neighbouring field has slipped into these columns";
                self.problem(Rule::NotANumber, message).at(Columns::new(column, column)).remedy(remedy)
            }
            FieldError::NoDigits => self
                .problem(Rule::NotANumber, format!("`{shown}` has no digit; {what}"))
                .remedy("punch the number, or leave the field blank for zero"),
            FieldError::EmptyExponent => self
                .problem(Rule::NotANumber, format!("`{shown}` has an exponent without digits; {what}"))
                .remedy("move the number to the left so that its exponent ends inside the field"),
            FieldError::TooLarge { digits } => {
                let message = format!("`{shown}` reads as {digits}, more than the 360 could hold; {what}");
                self.problem(Rule::OutOfRange, message)
            }
        }
    }

    fn surprising(&self, rule: Rule, digits: &str) -> Diagnostic {
        let shown = self.card.text_of(self.field.columns);
        let reads = format!("`{shown}` reads as {digits}");
        let message = match rule {
            Rule::EmbeddedBlanks => format!("{reads}: FORTRAN IV takes blanks inside a number as zeros"),
            Rule::LeftJustified => format!("{reads}: FORTRAN IV takes the blanks behind the last digit as zeros"),
            Rule::BareExponent => format!("{reads}: an exponent without its letter"),
            Rule::LonePoint => format!("`{shown}` has no digit, and was zero on the 360"),
            Rule::SmallLetter => format!("`{shown}` has a small exponent letter, which no card punch had"),
            _ => format!("`{shown}` was zero on the 360, which held nothing smaller than 5.4e-79"),
        };
        let problem = self.problem(rule, message);
        match (rule, self.field.format) {
            (Rule::LeftJustified, Format::Integer) => problem.remedy("punch the integer at the right end of its field"),
            (Rule::LeftJustified, _) => {
                problem.remedy("punch a decimal point, or move the number to the right end of its field")
            }
            _ => problem,
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

/// Expected content of a field, as text.
fn expectation(field: &Field) -> String {
    let width = field.columns.width();
    match field.format {
        Format::Real if field.unit.symbol.is_empty() => format!("a number in F{width}.0"),
        Format::Real => format!("a number in F{width}.0, in {}", field.unit.symbol),
        Format::Integer => format!("an integer in I{width}, right-justified"),
        Format::Text => "text".to_owned(),
    }
}

/// Reports characters in columns without a field, except sequence numbers.
fn check_free_columns(card: &PunchedCard, layout: &CardLayout, id: CardId, sink: &mut Sink) {
    for gap in gaps(layout) {
        let is_punched = |column: &u8| !card.is_blank_in(Columns::new(*column, *column));
        let mut punched = (gap.first..=gap.last).filter(is_punched);
        let Some(first) = punched.next() else { continue };
        let punched = Columns::new(first, punched.next_back().unwrap_or(first));
        let message = format!("`{}` is in columns that the card leaves blank; it is not read", card.text_of(punched));
        Diagnostic::new(Rule::NotBlank, message)
            .on(card)
            .in_card(id)
            .at(punched)
            .expected(format!("blanks in {gap}"))
            .report(sink);
    }
}

/// Columns between the fields of a card; 73–80 are free for sequence numbers if no field reaches column 71.
fn gaps(layout: &CardLayout) -> Vec<Columns> {
    let mut next = 1;
    let mut gaps = Vec::new();
    for columns in layout.fields.iter().map(|field| field.columns).chain([SEQUENCE]) {
        if columns.first > next {
            gaps.push(Columns::new(next, columns.first - 1));
        }
        next = columns.last + 1;
    }
    gaps
}
