//! Flags that exports, plots and comparisons share: filter and coefficients.

use occupant_core::scenario::kind::{KINDS, TIME};

use crate::base::failure::Failure;
use crate::files::history::{Family, Filter, Treatment};

/// What is done to time histories.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct HistoryArgs {
    /// Filter: CFC60, CFC180, CFC600, CFC1000, j211 (each channel the class of its quantity) or none
    #[arg(long, value_name = "CLASS", default_value = "none")]
    pub(crate) filter: Filter,

    /// Coefficients of the filter classes
    #[arg(long, value_name = "STANDARD", default_value = "iso6487")]
    pub(crate) coefficients: Family,
}

impl HistoryArgs {
    /// With an interval in words.
    ///
    /// # Errors
    /// An interval that is none.
    pub(crate) fn treatment(self, interval: Option<&str>) -> Result<Treatment, Failure> {
        let interval_s = interval.map(|text| time("--interval", text)).transpose()?;
        if let (Some(text), Some(seconds)) = (interval, interval_s)
            && seconds <= 0.0
        {
            return Err(Failure::with_help(
                format!("--interval {text}: not an interval of samples; expected a time above zero"),
                "give a time such as '1 ms'",
            ));
        }
        Ok(Treatment { filter: self.filter, family: self.coefficients, interval_s })
    }

    /// Name of the coefficients.
    pub(crate) const fn family_name(self) -> &'static str {
        match self.coefficients {
            Family::Iso6487 => "ISO 6487",
            Family::SaeJ211 => "SAE J211",
        }
    }

    /// The filter in words.
    pub(crate) fn words(self) -> String {
        match self.filter {
            Filter::None => "none".to_owned(),
            filter => format!("{} ({} coefficients)", filter.words(), self.family_name()),
        }
    }
}

/// A time in words, s; a bare number is in seconds.
///
/// # Errors
/// What is no time.
pub(crate) fn time(flag: &str, text: &str) -> Result<f64, Failure> {
    let wrong = |expected: &str| {
        Failure::with_help(
            format!("{flag} {text}: not a time; expected {expected}"),
            "give a number with its unit, such as '80 ms'",
        )
    };
    match KINDS[TIME].read(text) {
        Ok(seconds) if seconds.is_finite() => Ok(seconds),
        Ok(_) => Err(wrong("a finite time")),
        Err(error) => Err(wrong(&error.expected)),
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
