//! Unit expressions such as `lbf/in`, `in·lbf·s/rad`, `m/s^2`, `km/h`.
//!
//! A product is written with a blank, `·`, `*` or `-`; a quotient with `/`; a power with `^`, `**` or a raised digit. As
//! `a/b·c` is read differently by different people, a product after a quotient needs parentheses: `a/(b·c)`.
//!
//! `lb` is the pound of mass, `lbf` the pound of force; `g` is standard gravity, and there is no gram.

use std::f64::consts::PI;

use super::kind::Dimension;
use super::nearest::nearest;

/// A named unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Names; the first is the usual one.
    pub names: &'static [&'static str],
    /// What it measures.
    pub dimension: Dimension,
    /// SI units in one of it.
    pub factor: f64,
}

const fn unit(
    names: &'static [&'static str],
    [length, mass, time, angle]: [i32; 4],
    factor: f64,
) -> Unit {
    Unit {
        names,
        dimension: Dimension::new(length, mass, time, angle),
        factor,
    }
}

/// International pound, kg (exact, 1959).
const POUND_KG: f64 = 0.453_592_37;
/// Pound-force, N (exact: pound times standard gravity).
const POUND_FORCE_N: f64 = 4.448_221_615_260_5;
/// Standard gravity, m/s² (exact, 1901).
const GRAVITY_M_S2: f64 = 9.806_65;

/// All units, exponents of length, mass, time, angle. Every factor but π's is exact by definition.
#[rustfmt::skip]
pub const UNITS: &[Unit] = &[
    unit(&["m", "metre", "meter"], [1, 0, 0, 0], 1.0),
    unit(&["km"], [1, 0, 0, 0], 1000.0),
    unit(&["cm"], [1, 0, 0, 0], 0.01),
    unit(&["mm"], [1, 0, 0, 0], 0.001),
    unit(&["in", "inch", "inches"], [1, 0, 0, 0], 0.0254),
    unit(&["ft", "foot", "feet"], [1, 0, 0, 0], 0.3048),
    unit(&["yd", "yard"], [1, 0, 0, 0], 0.9144),
    unit(&["mi", "mile", "miles"], [1, 0, 0, 0], 1609.344),
    unit(&["s", "sec", "second", "seconds"], [0, 0, 1, 0], 1.0),
    unit(&["ms"], [0, 0, 1, 0], 0.001),
    unit(&["us", "µs", "μs"], [0, 0, 1, 0], 1e-6),
    unit(&["min"], [0, 0, 1, 0], 60.0),
    unit(&["h", "hr", "hour"], [0, 0, 1, 0], 3600.0),
    unit(&["deg", "°", "degree", "degrees"], [0, 0, 0, 1], PI / 180.0),
    unit(&["rad", "radian", "radians"], [0, 0, 0, 1], 1.0),
    unit(&["rev", "turn"], [0, 0, 0, 1], 2.0 * PI),
    unit(&["mph"], [1, 0, -1, 0], 0.447_04),
    unit(&["kph", "kmh"], [1, 0, -1, 0], 1.0 / 3.6),
    unit(&["knot", "knots"], [1, 0, -1, 0], 1852.0 / 3600.0),
    unit(&["g", "g0", "G"], [1, 0, -2, 0], GRAVITY_M_S2),
    unit(&["kg"], [0, 1, 0, 0], 1.0),
    unit(&["t", "tonne"], [0, 1, 0, 0], 1000.0),
    unit(&["lb", "lbm", "lbs"], [0, 1, 0, 0], POUND_KG),
    unit(&["oz"], [0, 1, 0, 0], POUND_KG / 16.0),
    unit(&["slug"], [0, 1, 0, 0], POUND_FORCE_N / 0.3048),
    unit(&["N"], [1, 1, -2, 0], 1.0),
    unit(&["kN"], [1, 1, -2, 0], 1000.0),
    unit(&["MN"], [1, 1, -2, 0], 1e6),
    unit(&["lbf"], [1, 1, -2, 0], POUND_FORCE_N),
    unit(&["kip"], [1, 1, -2, 0], 1000.0 * POUND_FORCE_N),
    unit(&["kgf", "kp"], [1, 1, -2, 0], GRAVITY_M_S2),
    unit(&["Nm"], [2, 1, -2, 0], 1.0),
    unit(&["J"], [2, 1, -2, 0], 1.0),
    unit(&["kJ"], [2, 1, -2, 0], 1000.0),
    unit(&["W"], [2, 1, -3, 0], 1.0),
    unit(&["Pa"], [-1, 1, -2, 0], 1.0),
    unit(&["kPa"], [-1, 1, -2, 0], 1000.0),
    unit(&["MPa"], [-1, 1, -2, 0], 1e6),
    unit(&["psi"], [-1, 1, -2, 0], POUND_FORCE_N / (0.0254 * 0.0254)),
    unit(&["Hz"], [0, 0, -1, 0], 1.0),
    unit(&["%"], [0, 0, 0, 0], 0.01),
];

/// What a unit expression amounts to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// Dimension.
    pub dimension: Dimension,
    /// SI units in one of it.
    pub factor: f64,
}

/// Why a quantity cannot be read, and where in its text (bytes).
#[derive(Clone, Debug, PartialEq)]
pub struct UnitError {
    /// First byte of the offending words.
    pub start: usize,
    /// One past the last.
    pub end: usize,
    /// What was found.
    pub found: String,
    /// What was expected.
    pub expected: String,
    /// How to mend it.
    pub hint: Option<String>,
}

/// Largest power of a base dimension that makes sense.
const MAX_EXPONENT: i32 = 9;

/// Deepest nesting of parentheses.
const MAX_DEPTH: usize = 8;

/// Reads a unit expression; `offset` is where it starts in the text that errors point into.
///
/// # Errors
/// Unknown units, misplaced signs, ambiguous quotients.
pub fn parse(text: &str, offset: usize) -> Result<Scale, UnitError> {
    let mut parser = Parser {
        tokens: tokens(text, offset)?,
        at: 0,
        end: offset + text.len(),
    };
    let scale = parser.expression(0)?;
    match parser.peek() {
        None => Ok(scale),
        Some(token) => Err(token.error("an unmatched `)`", "a unit")),
    }
}

#[derive(Clone, Debug, PartialEq)]
enum Word {
    Name(String),
    Power(i32),
    Times,
    Over,
    Open,
    Close,
}

#[derive(Clone, Debug, PartialEq)]
struct Token {
    word: Word,
    start: usize,
    end: usize,
}

impl Token {
    fn error(&self, found: impl Into<String>, expected: impl Into<String>) -> UnitError {
        UnitError {
            start: self.start,
            end: self.end,
            found: found.into(),
            expected: expected.into(),
            hint: None,
        }
    }
}

/// Splits a unit expression into words.
fn tokens(text: &str, offset: usize) -> Result<Vec<Token>, UnitError> {
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
                (Some(Word::Name(rest[..length].to_owned())), length)
            }
            _ => {
                let token = Token {
                    word: Word::Times,
                    start,
                    end: start + c.len_utf8(),
                };
                return Err(token.error(
                    format!("`{c}` in a unit"),
                    "units such as in, lbf, s joined by `·`, `/`, `^`",
                ));
            }
        };
        if let Some(word) = word {
            tokens.push(Token {
                word,
                start,
                end: start + length,
            });
        }
        rest = &rest[length..];
    }
    Ok(tokens)
}

fn is_name(c: char) -> bool {
    c.is_alphabetic() || matches!(c, '°' | '%' | '0')
}

/// Plain form of a raised character: a digit, or minus.
fn raised(c: char) -> Option<char> {
    Some(match c {
        '⁰' => '0',
        '¹' => '1',
        '²' => '2',
        '³' => '3',
        '⁴' => '4',
        '⁵' => '5',
        '⁶' => '6',
        '⁷' => '7',
        '⁸' => '8',
        '⁹' => '9',
        '⁻' => '-',
        _ => return None,
    })
}

/// `^2`, `^-1`, `**2`: `digits` follows the sign of `sign_length` bytes at `start`.
fn power(
    digits: &str,
    sign_length: usize,
    start: usize,
) -> Result<(Option<Word>, usize), UnitError> {
    let minus = usize::from(digits.starts_with('-'));
    let length = digits[minus..]
        .find(|c: char| !c.is_ascii_digit())
        .unwrap_or(digits.len() - minus)
        + minus;
    exponent(&digits[..length], start, sign_length + length)
}

fn raised_power(text: &str, start: usize) -> Result<(Option<Word>, usize), UnitError> {
    let length = text.find(|c| raised(c).is_none()).unwrap_or(text.len());
    let digits: String = text[..length].chars().filter_map(raised).collect();
    exponent(&digits, start, length)
}

fn exponent(digits: &str, start: usize, length: usize) -> Result<(Option<Word>, usize), UnitError> {
    match digits.parse::<i32>() {
        Ok(n) if n.abs() <= MAX_EXPONENT => Ok((Some(Word::Power(n)), length)),
        _ => Err(UnitError {
            start,
            end: start + length.max(1),
            found: "a power that cannot be read".into(),
            expected: format!("a whole number from -{MAX_EXPONENT} to {MAX_EXPONENT}, as in s^2"),
            hint: None,
        }),
    }
}

struct Parser {
    tokens: Vec<Token>,
    at: usize,
    end: usize,
}

impl Parser {
    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.at)
    }

    /// factor { [·] factor | / factor }
    fn expression(&mut self, depth: usize) -> Result<Scale, UnitError> {
        let mut product = self.factor(depth)?;
        let mut divided = false;
        while let Some(token) = self.peek().cloned() {
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
                        ..token.error(
                            "a product after `/`",
                            "parentheses that say what is divided",
                        )
                    });
                }
                Word::Times => {
                    self.at += 1;
                    1
                }
                _ => 1,
            };
            let factor = self.factor(depth)?;
            product = product
                .times(factor.power(sign))
                .ok_or_else(|| too_high(&token))?;
        }
        Ok(product)
    }

    /// name [power] | ( expression ) [power]
    fn factor(&mut self, depth: usize) -> Result<Scale, UnitError> {
        let Some(token) = self.peek().cloned() else {
            return Err(UnitError {
                start: self.end,
                end: self.end,
                found: "no unit where one should follow".into(),
                expected: "a unit such as in, lbf, s".into(),
                hint: None,
            });
        };
        self.at += 1;
        let base = match &token.word {
            Word::Name(name) => named(name, &token)?,
            Word::Open if depth < MAX_DEPTH => {
                let inner = self.expression(depth + 1)?;
                match self.peek() {
                    Some(t) if t.word == Word::Close => self.at += 1,
                    _ => return Err(token.error("`(` without its `)`", "`)`")),
                }
                inner
            }
            _ => {
                return Err(token.error(
                    "a sign where a unit should stand",
                    "a unit such as in, lbf, s",
                ));
            }
        };
        match self.peek().cloned() {
            Some(Token {
                word: Word::Power(n),
                ..
            }) => {
                self.at += 1;
                base.checked_power(n).ok_or_else(|| too_high(&token))
            }
            _ => Ok(base),
        }
    }
}

fn too_high(token: &Token) -> UnitError {
    token.error(
        "too high a power",
        format!("powers of at most {MAX_EXPONENT}"),
    )
}

/// Looks a unit up.
fn named(name: &str, token: &Token) -> Result<Scale, UnitError> {
    let known = UNITS.iter().find(|u| u.names.contains(&name));
    known
        .map(|u| Scale {
            dimension: u.dimension,
            factor: u.factor,
        })
        .ok_or_else(|| {
            let all = UNITS.iter().flat_map(|u| u.names.iter().copied());
            UnitError {
                hint: nearest(name, all).map(|n| format!("did you mean `{n}`?")),
                ..token.error(
                    format!("unknown unit `{name}`"),
                    "a unit such as m, in, s, deg, mph, g, kg, lb (mass), N, lbf (force)",
                )
            }
        })
}

impl Scale {
    fn checked_power(self, n: i32) -> Option<Scale> {
        let d = self.dimension;
        let raised = Scale {
            dimension: Dimension::new(d.length * n, d.mass * n, d.time * n, d.angle * n),
            factor: self.factor.powi(n),
        };
        raised.is_sensible().then_some(raised)
    }

    fn power(self, sign: i32) -> Scale {
        match sign {
            -1 => Scale {
                dimension: Dimension::new(
                    -self.dimension.length,
                    -self.dimension.mass,
                    -self.dimension.time,
                    -self.dimension.angle,
                ),
                factor: 1.0 / self.factor,
            },
            _ => self,
        }
    }

    fn times(self, other: Scale) -> Option<Scale> {
        let (a, b) = (self.dimension, other.dimension);
        let product = Scale {
            dimension: Dimension::new(
                a.length + b.length,
                a.mass + b.mass,
                a.time + b.time,
                a.angle + b.angle,
            ),
            factor: self.factor * other.factor,
        };
        product.is_sensible().then_some(product)
    }

    fn is_sensible(&self) -> bool {
        let d = self.dimension;
        [d.length, d.mass, d.time, d.angle]
            .iter()
            .all(|n| n.abs() <= MAX_EXPONENT)
            && self.factor.is_normal()
    }
}
