//! Flags that exports, plots, comparisons and prints share: times, signals of a test.

use occupant_scenario::kind::{KINDS, TIME};

use occupant_files::measured::MapArgument;

/// Time window that is shown or compared, s.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct WindowArgs {
    /// Begin at this time, such as '20 ms'
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, value_parser = seconds)]
    pub(crate) from: Option<f64>,

    /// End at this time
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, value_parser = seconds)]
    pub(crate) to: Option<f64>,
}

/// Assignment of a test's signals to channels, and their time shift.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct TestArgs {
    /// Assign a column of the test to a channel: 'column=channel', 'column[unit]=channel', or 'column=-channel' to reverse
    /// the sign
    #[arg(long, value_name = "MAP")]
    pub(crate) map: Vec<MapArgument>,

    /// Position code of the occupant in the test's ISO-MME channel names
    #[arg(long, value_name = "CODE", default_value = "1", value_parser = code_letter)]
    pub(crate) seat: char,

    /// Shift the test by this time
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, default_value = "0", value_parser = seconds)]
    pub(crate) shift: f64,
}

/// A time as text, s; a bare number is in seconds.
///
/// # Errors
/// An invalid time.
pub(crate) fn seconds(text: &str) -> Result<f64, String> {
    let wrong = |expected: &str| format!("not a time; expected {expected}, such as '80 ms'");
    match KINDS[TIME].read(text) {
        Ok(seconds) if seconds.is_finite() => Ok(seconds),
        Ok(_) => Err(wrong("a finite time")),
        Err(error) => Err(wrong(&error.expected)),
    }
}

/// An interval between samples or prints as text, s.
///
/// # Errors
/// An invalid time, or one that is not above zero.
pub(crate) fn interval(text: &str) -> Result<f64, String> {
    match seconds(text)? {
        seconds if seconds > 0.0 => Ok(seconds),
        _ => Err("not an interval; expected a time above zero, such as '1 ms'".to_owned()),
    }
}

/// A position in an ISO-MME code.
pub(crate) fn code_letter(text: &str) -> Result<char, String> {
    let mut letters = text.chars();
    match (letters.next(), letters.next()) {
        (Some(c), None) if c.is_ascii_digit() || c.is_ascii_uppercase() => Ok(c),
        _ => Err("expected one digit or capital".to_owned()),
    }
}
