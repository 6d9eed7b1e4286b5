//! Unit expressions such as `lbf/in`, `in·lbf·s/rad`, `m/s^2`, `km/h`.
//!
//! A product is written with a blank, `·`, `*` or `-`; a quotient with `/`; a power with `^`, `**` or a raised digit. As
//! `a/b·c` is read differently by different people, a product after a quotient needs parentheses: `a/(b·c)`.
//!
//! `lb` is the pound of mass, `lbf` the pound of force; `g` is standard gravity, and there is no gram.

use super::named::{MAX_EXPONENT, Scale, named, usual_writing};

/// Deepest nesting of parentheses.
const MAX_DEPTH: usize = 8;

/// Reason why a quantity cannot be parsed, with the position in its text (bytes).
#[derive(Clone, Debug, PartialEq)]
pub struct UnitError {
    /// First byte of the offending words.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
    /// What was found.
    pub found: String,
    /// What was expected.
    pub expected: String,
    /// How to correct it.
    pub hint: Option<String>,
}

impl UnitError {
    /// An error from byte `start` to byte `end`, with what was found and expected.
    pub fn new(start: usize, end: usize, found: impl Into<String>, expected: impl Into<String>) -> Self {
        UnitError { start, end, found: found.into(), expected: expected.into(), hint: None }
    }
}

/// Parses a unit expression; `offset` is its start in the text of error positions.
///
/// # Errors
/// Unknown units, misplaced signs, ambiguous quotients.
pub fn parse(text: &str, offset: usize) -> Result<Scale, UnitError> {
    let mut parser = Parser { tokens: tokens(text, offset)?, at: 0, end: offset + text.len() };
    let scale = parser.expression(0)?;
    match parser.peek() {
        None => Ok(scale),
        Some(token) => Err(token.error("an unmatched `)`", "a unit")),
    }
}

/// Reads a unit as headings of recorders and laboratories have it: as [`parse`] does, but also in capitals, with `'s` behind it, and with a
/// digit for a power: `MPH`, `DEG/SEC`, `G'S`, `m/s2`.
///
/// # Errors
/// As [`parse`], of the text as it stands.
pub fn parse_heading(text: &str) -> Result<Scale, UnitError> {
    parse(text, 0).or_else(|error| {
        let plain = text.trim_matches(['.', ' ']).replace(['\'', '’'], "");
        let mut usual = String::new();
        let mut rest = plain.as_str();
        while let Some(c) = rest.chars().next() {
            let length = rest.find(|c: char| !c.is_alphabetic()).unwrap_or(rest.len()).max(c.len_utf8());
            let word = &rest[..length];
            if c.is_ascii_digit() && usual.ends_with(char::is_alphabetic) {
                usual.push('^');
            }
            let of_many = word.strip_suffix(['s', 'S']).filter(|one| one.eq_ignore_ascii_case("g"));
            usual.push_str(usual_writing(of_many.unwrap_or(word)).unwrap_or(word));
            rest = &rest[length..];
        }
        parse(&usual, 0).or_else(|_| spelled(&plain).map_or(Err(error), |unit| parse(unit, 0)))
    })
}

/// Units that headings write out, and their short form.
#[rustfmt::skip]
const SPELLED: [(&str, &[&str]); 6] = [
    ("ms", &["millisecond", "milliseconds", "millisec", "millisekunden", "millisekunde", "milliseconde", "millisecondes", "milisegundos",
        "milisegundo", "miribyo", "miribyou"]),
    ("s", &["secs", "sekunden", "sekunde", "sek", "seconde", "secondes", "segundos", "segundo", "seg", "byo", "byou"]),
    ("mph", &["mi/hr", "miles per hour", "miles/h", "miles/hour", "mile/h", "m.p.h"]),
    ("km/h", &["km/hr", "km per hour", "kilometers per hour", "kilometres per hour", "stundenkilometer", "k.p.h", "km/std", "km / h"]),
    ("m/s", &["meters per second", "metres per second", "m/sek", "m/seg"]),
    ("m/s^2", &["m/s/s", "m/sek^2", "m/sek2", "m/sec2", "m/sec^2", "m/s²"]),
];

fn spelled(unit: &str) -> Option<&'static str> {
    let unit = unit.trim().to_lowercase();
    SPELLED.iter().find(|(_, names)| names.contains(&unit.as_str())).map(|(short, _)| *short)
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Word<'a> {
    Name(&'a str),
    Power(i32),
    Times,
    Over,
    Open,
    Close,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Token<'a> {
    word: Word<'a>,
    start: usize,
    end: usize,
}

impl Token<'_> {
    fn error(&self, found: impl Into<String>, expected: impl Into<String>) -> UnitError {
        UnitError::new(self.start, self.end, found, expected)
    }
}

/// Splits a unit expression into tokens.
fn tokens(text: &str, offset: usize) -> Result<Vec<Token<'_>>, UnitError> {
    let mut tokens = Vec::new();
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let start = offset + text.len() - rest.len();
        let (word, length) = match c {
            _ if c.is_whitespace() => (None, c.len_utf8()),
            '/' => (Some(Word::Over), 1),
            '(' => (Some(Word::Open), 1),
            ')' => (Some(Word::Close), 1),
            '*' if rest.starts_with("**") => power(&rest[2..], 2, start)?,
            '^' => power(&rest[1..], 1, start)?,
            '*' | '·' | '⋅' | '×' | '-' => (Some(Word::Times), c.len_utf8()),
            _ if raised(c).is_some() => raised_power(rest, start)?,
            _ if is_name(c) => {
                let length = rest.find(|c| !is_name(c)).unwrap_or(rest.len());
                (Some(Word::Name(&rest[..length])), length)
            }
            _ => {
                let expected = "units such as in, lbf, s joined by `·`, `/`, `^`";
                return Err(UnitError::new(start, start + c.len_utf8(), format!("`{c}` in a unit"), expected));
            }
        };
        if let Some(word) = word {
            tokens.push(Token { word, start, end: start + length });
        }
        rest = &rest[length..];
    }
    Ok(tokens)
}

fn is_name(c: char) -> bool {
    c.is_alphabetic() || matches!(c, '°' | '%' | '0')
}

/// Plain form of a superscript character: a digit, or minus.
fn raised(c: char) -> Option<char> {
    let at = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻".chars().position(|r| r == c)?;
    "0123456789-".chars().nth(at)
}

/// `^2`, `^-1`, `**2`: `digits` follows the sign of `sign_length` bytes at `start`.
fn power(digits: &str, sign_length: usize, start: usize) -> Result<(Option<Word<'static>>, usize), UnitError> {
    let minus = usize::from(digits.starts_with('-'));
    let length = digits[minus..].find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len() - minus) + minus;
    exponent(&digits[..length], start, sign_length + length)
}

fn raised_power(text: &str, start: usize) -> Result<(Option<Word<'static>>, usize), UnitError> {
    let length = text.find(|c| raised(c).is_none()).unwrap_or(text.len());
    let digits: String = text[..length].chars().filter_map(raised).collect();
    exponent(&digits, start, length)
}

fn exponent(digits: &str, start: usize, length: usize) -> Result<(Option<Word<'static>>, usize), UnitError> {
    match digits.parse::<i32>() {
        Ok(n) if n.abs() <= MAX_EXPONENT => Ok((Some(Word::Power(n)), length)),
        _ => {
            let expected = format!("a whole number from -{MAX_EXPONENT} to {MAX_EXPONENT}, as in s^2");
            Err(UnitError::new(start, start + length.max(1), "a power that cannot be read", expected))
        }
    }
}

struct Parser<'a> {
    tokens: Vec<Token<'a>>,
    at: usize,
    end: usize,
}

impl<'a> Parser<'a> {
    fn peek(&self) -> Option<&Token<'a>> {
        self.tokens.get(self.at)
    }

    /// factor { [·] factor | / factor }
    fn expression(&mut self, depth: usize) -> Result<Scale, UnitError> {
        let mut product = self.factor(depth)?;
        let mut divided = false;
        while let Some(token) = self.peek().copied() {
            let sign = match token.word {
                Word::Close => break,
                Word::Over => {
                    self.at += 1;
                    divided = true;
                    -1
                }
                Word::Times | Word::Name(_) | Word::Open | Word::Power(_) if divided => {
                    return Err(UnitError {
                        hint: Some("write a/(b·c) if both divide, a·c/b if only b does".into()),
                        ..token.error("a product after `/`", "parentheses around the divisor")
                    });
                }
                Word::Times => {
                    self.at += 1;
                    1
                }
                _ => 1,
            };
            let factor = self.factor(depth)?;
            product = factor.power(sign).and_then(|f| product.times(f)).ok_or_else(|| too_high(&token))?;
        }
        Ok(product)
    }

    /// name [power] | ( expression ) [power]
    fn factor(&mut self, depth: usize) -> Result<Scale, UnitError> {
        let Some(token) = self.peek().copied() else {
            let found = "a missing unit";
            return Err(UnitError::new(self.end, self.end, found, "a unit such as in, lbf, s"));
        };
        self.at += 1;
        let base = match token.word {
            Word::Name(name) => named(name, token.start, token.end)?,
            Word::Open if depth < MAX_DEPTH => {
                let inner = self.expression(depth + 1)?;
                match self.peek() {
                    Some(t) if t.word == Word::Close => self.at += 1,
                    _ => return Err(token.error("`(` without `)`", "`)`")),
                }
                inner
            }
            _ => return Err(token.error("a sign instead of a unit", "a unit such as in, lbf, s")),
        };
        match self.peek().copied() {
            Some(Token { word: Word::Power(n), .. }) => {
                self.at += 1;
                base.power(n).ok_or_else(|| too_high(&token))
            }
            _ => Ok(base),
        }
    }
}

fn too_high(token: &Token<'_>) -> UnitError {
    token.error("too high a power", format!("powers of at most {MAX_EXPONENT}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_of_headings_are_read_in_any_letters() {
        for (written, usual) in [
            ("MPH", "mph"),
            ("KPH", "kph"),
            ("km/H", "km/h"),
            ("SEC", "s"),
            ("MSEC", "ms"),
            ("msec", "ms"),
            ("IN", "in"),
            ("FT/SEC", "ft/s"),
            ("DEG", "deg"),
            ("Deg/Sec", "deg/s"),
            ("deg/sec", "deg/s"),
            ("G's", "g"),
            ("G", "g"),
            ("gs", "g"),
            ("m/s2", "m/s^2"),
            ("M/S^2", "m/s^2"),
            ("M/S**2", "m/s^2"),
            ("m/(s*s)", "m/s^2"),
            ("KN", "kN"),
            ("RAD/S", "rad/s"),
            ("Millisekunden", "ms"),
            ("miles per hour", "mph"),
            ("km/hr", "km/h"),
        ] {
            assert_eq!(parse_heading(written).ok(), parse(usual, 0).ok(), "{written}");
            assert!(parse(usual, 0).is_ok());
        }
        for none in ["", "x", "off", "#1", "2", "é"] {
            assert!(parse_heading(none).is_err(), "{none}");
        }
        // a scenario's own quantities stay strict
        assert!(parse("MPH", 0).is_err() && parse("m/s2", 0).is_err());
    }
}
