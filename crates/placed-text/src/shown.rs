//! Text from outside as messages and tables show it.

/// Largest number of characters of a message shown.
const LONGEST: usize = 600;

/// Whether a character controls the terminal instead of being text: control characters, and marks that change the
/// writing direction.
fn is_hidden(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// A text with hidden characters escaped as in JSON, `\u001b`, except line ends, tabs and form feeds.
pub fn plain(text: &str) -> String {
    escaped(text.chars(), |c| is_hidden(c) && !matches!(c, '\n' | '\t' | '\u{c}'))
}

/// A number for display: with an exponent instead of many zeros, `1e-300`, and with 15 digits, which hide conversion
/// errors (700 ms are 0.7 s, not 0.7000000000000001).
pub fn number(value: f64) -> String {
    let value = format!("{value:.14e}").parse().unwrap_or(value);
    let is_plain = value == 0.0 || !value.is_finite() || (1e-6..1e12).contains(&value.abs());
    if is_plain { value.to_string() } else { format!("{value:e}") }
}

/// A text in one line: hidden characters escaped, the middle of a long one left out.
pub fn shown(text: &str) -> String {
    shortened(text, LONGEST)
}

/// As [`shown`], in at most `most` characters.
pub fn shortened(text: &str, most: usize) -> String {
    let half = most / 2;
    if text.len() <= most || text.chars().nth(most).is_none() {
        return escaped(text.chars(), is_hidden);
    }
    let end: Vec<char> = text.chars().rev().take(half).collect();
    let ends = text.chars().take(most - half - 1).chain(['…']).chain(end.into_iter().rev());
    escaped(ends, is_hidden)
}

/// Characters of a quoted line: hidden ones escaped, a tab as one blank.
pub(crate) fn quoted(line: &[char]) -> String {
    escaped(line.iter().map(|c| if *c == '\t' { ' ' } else { *c }), is_hidden)
}

fn escaped(chars: impl Iterator<Item = char>, is_hidden: impl Fn(char) -> bool) -> String {
    let mut text = String::new();
    for c in chars {
        if is_hidden(c) {
            text.push_str(&format!("\\u{:04x}", u32::from(c)));
        } else {
            text.push(c);
        }
    }
    text
}

/// A number with at most this many decimals, without trailing zeros.
pub fn trimmed(value: f64, decimals: usize) -> String {
    without_zeros(&format!("{value:.decimals$}")).to_owned()
}

/// Digits of a decimal number without trailing zeros.
pub fn without_zeros(digits: &str) -> &str {
    digits.trim_end_matches('0').trim_end_matches('.')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_hidden_is_shown_and_nothing_is_long() {
        assert_eq!(shown("a\u{1b}[31m\u{202e}\n\u{9b}é"), "a\\u001b[31m\\u202e\\u000a\\u009bé");
        assert_eq!(plain("a\n\tb\u{c}\r\u{7f}"), "a\n\tb\u{c}\\u000d\\u007f");
        assert_eq!(shortened(&"é".repeat(9), 9), "é".repeat(9));
        assert_eq!(shortened("0123456789", 5), "01…89");
        assert_eq!(shown(&"x".repeat(100_000_000)).chars().count(), LONGEST);
    }

    #[test]
    fn numbers_have_no_rows_of_zeros() {
        let written = [0.0, -0.25, 1e-6, 123_456_789.0, 1e-300, -2.5e300, f64::INFINITY, 1e-7].map(number);
        assert_eq!(written, ["0", "-0.25", "0.000001", "123456789", "1e-300", "-2.5e300", "inf", "1e-7"]);
        assert_eq!([700.0 * 1e-3, 0.1 + 0.2, f64::NAN].map(number), ["0.7", "0.3", "NaN"]);
    }
}
