//! Cards from a deck, in the normalised form.
//!
//! The normalised form: series in the report's order, segments and surfaces by number, pairs as listed; every number
//! right-justified in its field with its decimal point and the card's digits; a blank that means zero written `0.`;
//! fields without effect (the belt that is not in use, SLACK if NPOS = 1) left as blank as they were; the card number
//! where the report's table has it; nothing in free columns; no trailing blanks; LF behind each card.

use crate::cards::Format;
use crate::deck::{Deck, DeckCard, Number};

impl Deck {
    /// Deck as cards, from the titles to the plot card. The final card FINI belongs to the file: [`write_file`].
    pub fn write(&self) -> String {
        let mut text = String::new();
        for title in self.titles() {
            push_line(&mut text, title);
        }
        for card in self.cards() {
            push_line(&mut text, &self.punch_card(card));
        }
        push_line(&mut text, self.plot().word());
        text
    }

    /// Deck without parts that have no effect: series that its switches make superfluous, numbers of the disabled belt.
    /// A conversion to a scenario and back keeps this.
    pub fn normalised(&self) -> Deck {
        let used = self.cards().iter().filter(|card| !self.is_superfluous(card.id.series));
        let blanked = used.map(|card| {
            let kept = |(name, _, number): (String, _, &Number)| {
                if self.is_unused(&name) { Number::blank() } else { number.clone() }
            };
            DeckCard { numbers: card.named().map(kept).collect(), ..card.clone() }
        });
        Deck::assemble(self.titles().clone(), blanked.collect(), self.plot())
    }

    fn punch_card(&self, card: &DeckCard) -> String {
        let mut line = String::new();
        for (name, field, number) in card.named() {
            let text = match field.format {
                Format::Integer => format!("{:.0}", number.value),
                Format::Real if number.blank && self.has_no_effect(&name) => String::new(),
                Format::Real => punch_real(number, field.columns.width()),
                Format::Text => String::new(),
            };
            // at the right end of the field; what is too long, which `punch_real` prevents, is cut on the left
            let width = usize::from(field.columns.last) - line.len();
            let text = format!("{text:>width$}");
            line.push_str(&text[text.len() - width..]);
        }
        line
    }
}

/// File of decks as bytes of Latin-1, with the final card FINI. Characters outside Latin-1 become `?`.
pub fn write_file(decks: &[Deck]) -> Vec<u8> {
    let mut text: String = decks.iter().map(Deck::write).collect();
    text.push_str("FINI\n");
    text.chars().map(|c| u8::try_from(u32::from(c)).unwrap_or(b'?')).collect()
}

fn push_line(text: &mut String, line: &str) {
    text.push_str(line.trim_end_matches(' '));
    text.push('\n');
}

/// A number for an F field: with its point where there is room, with all its digits.
///
/// A number read from a field of this width always fits, because each form below is at most as long as the one read;
/// another one is rounded to as many significant digits as there is room for.
pub(crate) fn punch_real(number: &Number, width: usize) -> String {
    if number.value == 0.0 {
        return "0.".to_owned();
    }
    fitting_form(&number.digits, width)
        .or_else(|| (0..17).rev().find_map(|places| rounded_form(number.value, places, width)))
        .unwrap_or_else(|| "0.".to_owned())
}

/// A number rounded to one digit and `places` more, in the first notation that fits: without exponent, with one digit
/// before the point, with all digits before it (`7000000002`, `1.234E-6`, `1234567-20`).
fn rounded_form(value: f64, places: usize, width: usize) -> Option<String> {
    let scientific = format!("{value:.places$e}");
    let rounded: f64 = scientific.parse().ok()?;
    let (mantissa, exponent) = scientific.split_once('e')?;
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let fraction = fraction.trim_end_matches('0');
    let exponent: i32 = exponent.parse().ok()?;
    let shifted = exponent - i32::try_from(fraction.len()).ok()?;
    let notations =
        [format!("{rounded}"), format!("{whole}.{fraction}e{exponent}"), format!("{whole}{fraction}e{shifted}")];
    notations.iter().filter(|_| rounded != 0.0).find_map(|digits| fitting_form(digits, width))
}

/// Notations of digits, the plainest first; the first one that fits.
fn fitting_form(digits: &str, width: usize) -> Option<String> {
    let (mantissa, exponent) = digits.split_once('e').map_or((digits, None), |(m, e)| (m, Some(e)));
    let pointed = if mantissa.contains('.') { mantissa.to_owned() } else { format!("{mantissa}.") };
    let short = pointed.replacen("0.", ".", usize::from(pointed.trim_start_matches('-').starts_with("0.")));
    let bare = short.trim_end_matches('.');
    let forms = match exponent {
        None => vec![pointed.clone(), short.clone(), bare.to_owned()],
        Some(exponent) => {
            let signed = if exponent.starts_with('-') { exponent.to_owned() } else { format!("+{exponent}") };
            vec![
                format!("{pointed}E{exponent}"),
                format!("{short}E{exponent}"),
                format!("{bare}E{exponent}"),
                format!("{short}{signed}"),
                format!("{bare}{signed}"),
            ]
        }
    };
    forms.into_iter().find(|form| form.len() <= width)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn punched(value: f64) -> String {
        let number = Number { value, digits: format!("{value:e}"), blank: false };
        punch_real(&number, 10)
    }

    #[test]
    fn numbers_that_fit_keep_all_their_digits() {
        // The first was punched 7.0000E9: a rounded form was tried before the exact one without exponent.
        for (value, text) in [
            (7_000_000_002.0, "7000000002"),
            (-123_456_789.0, "-123456789"),
            (1.234567e-14, "1234567-20"),
            (1.234_567_8e16, "12345678E9"),
            (0.123_456_789, ".123456789"),
            (1.234e-6, "1.234E-6"),
        ] {
            assert_eq!(punched(value), text);
            let read = crate::fortran::read_real(format!("{text:>10}").as_bytes());
            assert_eq!(read.map(|r| r.value), Ok(value));
        }
    }

    #[test]
    fn numbers_that_do_not_fit_keep_as_many_digits_as_do() {
        assert_eq!(punched(1.0 / 3.0), ".333333333");
        assert_eq!(punched(-1.0 / 3.0), "-.33333333");
        assert_eq!(punched(7_000_000_002.5), "7000000002");
        assert_eq!(punched(12_345_678_901.0), "12345679E3");
        assert_eq!(punched(-1.0 / 3.0 * 1e-70), "-333333-76");
    }
}
