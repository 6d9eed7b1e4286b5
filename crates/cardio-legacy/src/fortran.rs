//! Reading of one field of a card by the rules of FORTRAN IV.
//!
//! The report's formats are F10.0, F6.0, I2, I8 and I10. The rules are those of the IBM 360 compilers:
//!
//! * a blank is a zero wherever it stands after the first digit, sign or point; blanks before are void;
//! * a field that is all blank is zero (kept apart here as [`Reading::blank`], because it is a rule and not a number);
//! * a decimal point in the field overrules the format's count of decimals, which is 0 in every format of the report;
//! * an exponent is `E` or `D` with or without sign, or a sign alone: `1.5E3`, `1.5D+3`, `1.5-3`;
//! * a point alone, or behind a sign, is zero: the blanks behind it are digits, and to the 360 a field without digits was zero;
//! * integers take no point and no exponent.
//!
//! So `12` punched at the left of ten columns is 1 200 000 000. That is what the program read, hence what is read here;
//! [`Reading::surprises`] tell the caller where these rules gave something a reader of the card would not expect.

use crate::rule::Rule;

/// Largest double-precision number of the IBM 360, 16⁶³(1 − 16⁻¹⁴).
pub const LARGEST_REAL: f64 = 7.237_005_577_332_26e75;
/// Smallest positive number of the IBM 360, 16⁻⁶⁵.
pub const SMALLEST_REAL: f64 = 5.397_605_346_934_03e-79;

/// Content of a numeric field.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// The number; zero for a blank field.
    pub value: f64,
    /// Number in usual notation, with all digits of the card: `386.04`, `-0.5`, `1.5e-3`; `0` for a blank field.
    pub digits: String,
    /// Whether the field is blank.
    pub blank: bool,
    /// Rules that gave an unexpected reading: [`Rule::EmbeddedBlanks`], [`Rule::LeftJustified`] for blanks
    /// behind the last digit that were read as zeros, [`Rule::BareExponent`], [`Rule::SmallLetter`], [`Rule::Underflow`] for a
    /// number that the 360 read as zero, [`Rule::LonePoint`].
    pub surprises: Vec<Rule>,
}

/// Reason why a field contains no number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FieldError {
    /// Invalid character.
    Character {
        /// Position in the field, from 0.
        offset: usize,
        /// Byte in Latin-1.
        found: u8,
    },
    /// A sign without any digit.
    NoDigits,
    /// An exponent letter with nothing after it.
    EmptyExponent,
    /// Number too large for the IBM 360.
    TooLarge {
        /// Digits by the rules, with blanks as zeros.
        digits: String,
    },
}

/// Reads an F field without implied decimals (F10.0, F6.0), any width.
///
/// # Errors
/// [`FieldError`] when the field is neither blank nor a number of FORTRAN IV.
pub fn read_real(field: &[u8]) -> Result<Reading, FieldError> {
    if matches!(field.trim_ascii(), b"." | b"-." | b"+.") {
        return Ok(Reading { blank: false, surprises: vec![Rule::LonePoint], ..blank() });
    }
    let Some(parts) = split(field)? else { return Ok(blank()) };
    let mut surprises = parts.surprises.clone();
    let text = parts.as_rust();
    let value: f64 = text.parse().map_err(|_| FieldError::NoDigits)?;
    if value.abs() > LARGEST_REAL {
        return Err(FieldError::TooLarge { digits: text });
    }
    let zero = !parts.whole.bytes().chain(parts.fraction.iter().flat_map(|f| f.bytes())).any(|b| b != b'0');
    if !zero && value.abs() < SMALLEST_REAL {
        surprises.push(Rule::Underflow);
        return Ok(Reading { value: 0.0, digits: "0".into(), blank: false, surprises });
    }
    Ok(Reading { value, digits: text, blank: false, surprises })
}

/// Reads an I field (I2, I8, I10), any width.
///
/// # Errors
/// [`FieldError`] when the field is neither blank nor an integer of FORTRAN IV.
pub fn read_integer(field: &[u8]) -> Result<Reading, FieldError> {
    if let Some(offset) = field.iter().position(|b| !matches!(b, b' ' | b'+' | b'-' | b'0'..=b'9')) {
        return Err(FieldError::Character { offset, found: field[offset] });
    }
    read_real(field)
}

fn blank() -> Reading {
    Reading { value: 0.0, digits: "0".into(), blank: true, surprises: Vec::new() }
}

/// Parts of a number: sign, digits before and after the point, exponent.
#[derive(Default)]
struct Parts {
    negative: bool,
    whole: String,
    fraction: Option<String>,
    exponent: (bool, String),
    surprises: Vec<Rule>,
}

impl Parts {
    /// Adds a digit of the mantissa.
    fn push(&mut self, digit: char) {
        self.fraction.as_mut().unwrap_or(&mut self.whole).push(digit);
    }

    /// Adds a blank of the mantissa, the first byte of `rest`, as zero. It matters unless only zeros precede it in the
    /// whole part, or only an exponent or blanks follow it in the fraction.
    fn push_blank(&mut self, rest: &[u8], punched: bool) {
        let next = rest.iter().find(|b| **b != b' ');
        let surprise = match (&self.fraction, next) {
            (None, None) if punched => Rule::LeftJustified,
            (None, Some(_)) if punched => Rule::EmbeddedBlanks,
            (Some(_), Some(b'0'..=b'9')) => Rule::EmbeddedBlanks,
            _ => return,
        };
        self.push('0');
        note(&mut self.surprises, surprise);
    }

    /// Number in the notation of Rust and TOML, without leading zeros, with the card's other digits.
    fn as_rust(&self) -> String {
        let sign = |negative| if negative { "-" } else { "" };
        let mut text = sign(self.negative).to_owned();
        let whole = self.whole.trim_start_matches('0');
        text += if whole.is_empty() { "0" } else { whole };
        if let Some(fraction) = self.fraction.as_deref().filter(|f| !f.is_empty()) {
            text += &format!(".{fraction}");
        }
        let (negative, exponent) = &self.exponent;
        let exponent = exponent.trim_start_matches('0');
        if !exponent.is_empty() {
            text += &format!("e{}{exponent}", sign(*negative));
        }
        text
    }
}

/// Splits a field by the rules above; `None` if it is blank.
fn split(field: &[u8]) -> Result<Option<Parts>, FieldError> {
    let Some(start) = field.iter().position(|b| *b != b' ') else { return Ok(None) };
    let mut parts = Parts::default();
    let mut punched = false;
    let mut at = start;
    if matches!(field[at], b'+' | b'-') {
        parts.negative = field[at] == b'-';
        at += 1;
    }
    while let Some(&byte) = field.get(at) {
        match byte {
            b'0'..=b'9' => {
                punched = true;
                parts.push(char::from(byte));
            }
            b' ' => parts.push_blank(&field[at..], punched),
            b'.' if parts.fraction.is_none() => parts.fraction = Some(String::new()),
            b'+' | b'-' | b'E' | b'D' | b'e' | b'd' if punched => break,
            _ => return Err(FieldError::Character { offset: at, found: byte }),
        }
        at += 1;
    }
    if !punched {
        return Err(FieldError::NoDigits);
    }
    if at < field.len() {
        read_exponent(&field[at..], at, &mut parts)?;
    }
    Ok(Some(parts))
}

/// Reads `E3`, `D-3`, `+3`, `-3` and the following blanks, from `offset` in the field.
fn read_exponent(rest: &[u8], offset: usize, parts: &mut Parts) -> Result<(), FieldError> {
    match rest[0] {
        b'E' | b'D' => {}
        b'e' | b'd' => note(&mut parts.surprises, Rule::SmallLetter),
        _ => note(&mut parts.surprises, Rule::BareExponent),
    }
    let sign_at = usize::from(rest[0].is_ascii_alphabetic());
    let negative = rest.get(sign_at) == Some(&b'-');
    let digits_at = sign_at + usize::from(matches!(rest.get(sign_at), Some(b'+' | b'-')));
    let mut digits = String::new();
    for (index, byte) in rest.iter().enumerate().skip(digits_at) {
        match byte {
            b'0'..=b'9' => digits.push(char::from(*byte)),
            b' ' => {
                digits.push('0');
                if digits.bytes().any(|d| d != b'0') {
                    let trailing = rest[index..].iter().all(|b| *b == b' ');
                    let surprise = if trailing { Rule::LeftJustified } else { Rule::EmbeddedBlanks };
                    note(&mut parts.surprises, surprise);
                }
            }
            _ => return Err(FieldError::Character { offset: offset + index, found: *byte }),
        }
    }
    if !rest.iter().any(u8::is_ascii_digit) {
        return Err(FieldError::EmptyExponent);
    }
    parts.exponent = (negative, digits);
    Ok(())
}

fn note(surprises: &mut Vec<Rule>, surprise: Rule) {
    if !surprises.contains(&surprise) {
        surprises.push(surprise);
    }
}
