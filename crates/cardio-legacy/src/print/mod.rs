//! The digital printout: a run as paged text, the report's list of results (its PRNTIN and ANSWER).
//!
//! First the echo of everything read and of the computed seating; then, for every print time, the vehicle, the segments
//! (items 1 to 4 of the report's "Output"), contacts, belts and energy (items 5 to 7); last the sheet that an extension
//! needs. A page has 60 lines of at most 132 columns and ends in a form feed.

mod belts;
mod case;
mod echo;
mod end_sheet;
mod loads;
mod page;
mod segments;
mod table;
mod unit;
mod vehicle;

pub use case::{Case, Recorded};
pub use unit::Units;

use occupant_core::results::recorder::{Recorder, Watch};
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::{Caveat, Summarizer};
use occupant_core::run::simulate::replay;
use page::{COLUMNS, Pages};
use table::Table;

/// Sections of the printout for a kind of force elements, besides contact surfaces and joints.
pub(crate) struct Element {
    /// Its name in headings.
    heading: &'static str,
    /// Section of the input.
    input: fn(&mut Pages, &Case, Units),
    /// Section of values at the start.
    start: fn(&mut Pages, &Case, Units),
    /// Section of an output.
    output: fn(&mut Pages, Units, &Sample<'_>),
    /// Section of values for an extension.
    end: fn(&mut Pages, &Case, Units),
}

/// All kinds, in the order of the printout.
pub(crate) const ELEMENTS: [Element; 1] = [belts::BELTS];

/// Their names in a heading.
fn headings() -> String {
    ELEMENTS.map(|element| element.heading).join(", ")
}

/// The whole printout.
///
/// `every_s` is the print interval (DTPRNT); without it every recorded output is printed.
///
/// # Errors
/// An output that cannot be evaluated; a print interval shorter than the recorded one.
pub fn printout(case: &Case, units: Units, every_s: Option<f64>) -> Result<String, String> {
    let mut pages = Pages::new(case.titles());
    echo::write(&mut pages, case, units);
    let times_s: Vec<f64> = case.file.checkpoints.iter().map(|c| c.time_s).collect();
    for output in chosen(&times_s, every_s, case.model.setup().time.output_s)? {
        pages.begin(&format!("TIME {:.6} SEC    OUTPUT {}", times_s[output], output));
        let mut page = Watch(|sample: &Sample<'_>| {
            vehicle::write(&mut pages, units, sample);
            segments::write(&mut pages, units, sample);
            loads::write(&mut pages, case, units, sample);
        });
        replay(&case.model, &case.file.checkpoints[output], &mut page).map_err(|e| e.to_string())?;
    }
    end_sheet::write(&mut pages, case, units, &caveats(case)?);
    Ok(pages.text())
}

/// Message for a print interval that is not a multiple of the recorded one, so that printed times are unevenly spaced.
pub fn uneven(case: &Case, every_s: f64) -> Option<String> {
    let output_s = case.model.setup().time.output_s;
    let outputs = every_s / output_s;
    ((outputs - outputs.round()).abs() > 1e-6).then(|| {
        format!(
            "the print interval, {every_s} s, is no multiple of the recorded one, {output_s} s: the first output at or after \
             each print time is printed, at uneven times"
        )
    })
}

/// Caveats on the results of the run.
fn caveats(case: &Case) -> Result<Vec<Caveat>, String> {
    let Some(last) = case.file.checkpoints.last() else {
        return Ok(Vec::new());
    };
    let mut summarizer = Summarizer::new();
    summarizer.begin(&case.model).map_err(|e| e.to_string())?;
    for checkpoint in &case.file.checkpoints {
        replay(&case.model, checkpoint, &mut summarizer).map_err(|e| e.to_string())?;
    }
    summarizer.end(&last.outcome(&case.model)).map_err(|e| e.to_string())?;
    let (status, reason) = case.file.ending.clone();
    Ok(summarizer.summary(None).map_or_else(Vec::new, |summary| summary.ended(status, reason).caveats))
}

/// Indices of the outputs to print: the first at or after each print time, and the last.
fn chosen(times_s: &[f64], every_s: Option<f64>, output_s: f64) -> Result<Vec<usize>, String> {
    let Some(every_s) = every_s else {
        return Ok((0..times_s.len()).collect());
    };
    if every_s.is_nan() || every_s < output_s * (1.0 - 1e-9) {
        return Err(format!("the print interval is {every_s} s, but the run was recorded every {output_s} s"));
    }
    let Some(&start_s) = times_s.first() else {
        return Ok(Vec::new());
    };
    let mut chosen = Vec::new();
    // the number of the next print time
    let mut next = 0.0;
    for (i, &time_s) in times_s.iter().enumerate() {
        // a time that misses its print time by rounding alone is that time
        let reached = (time_s - start_s) / every_s + 1e-9;
        if reached >= next || i + 1 == times_s.len() {
            chosen.push(i);
            next = reached.floor() + 1.0;
        }
    }
    Ok(chosen)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn print_times_take_the_first_output_at_or_after_them_and_the_last() {
        let times_s: Vec<f64> = (0..=10).map(|i| -0.01 + f64::from(i) * 0.001).collect();
        assert_eq!(chosen(&times_s, Some(0.004), 0.001), Ok(vec![0, 4, 8, 10]));
        assert_eq!(chosen(&times_s, Some(0.0025), 0.001), Ok(vec![0, 3, 5, 8, 10]));
        assert_eq!(chosen(&times_s, None, 0.001).map(|c| c.len()), Ok(11));
        assert!(chosen(&times_s, Some(0.0005), 0.001).is_err());
        assert!(chosen(&times_s, Some(f64::NAN), 0.001).is_err());
        assert_eq!(chosen(&[], Some(0.01), 0.001), Ok(vec![]));
    }
}
