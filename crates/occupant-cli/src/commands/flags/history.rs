//! Flags that exports, plots, comparisons and prints share: times, signals of a test.

use occupant_files::measured::MapArgument;

pub(crate) use occupant_jobs::files::history::{interval, seconds};

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

/// A position in an ISO-MME code.
pub(crate) fn code_letter(text: &str) -> Result<char, String> {
    let mut letters = text.chars();
    match (letters.next(), letters.next()) {
        (Some(c), None) if c.is_ascii_digit() || c.is_ascii_uppercase() => Ok(c),
        _ => Err("expected one digit or capital".to_owned()),
    }
}
