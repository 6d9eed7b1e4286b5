//! Results of an ensemble: `--json` prints them, and the tables on the terminal use them.

use occupant_study::Tolerances;
use occupant_study::spread::Verdict;
use serde::Serialize;

use super::judge::judge;
use super::{Bands, Judged, Left, Member};

/// An ensemble that has been run; SI units.
#[derive(Serialize)]
pub struct Report {
    /// Runs, the unchanged one included.
    pub members: u64,
    /// Runs that completed.
    pub completed: u64,
    /// What named the random numbers.
    pub seed: u64,
    /// How far the changes went.
    pub changes: Tolerances,
    /// Width of the middle 90 % that a stable figure may have, as a part of the median.
    pub within: f64,
    /// Runs that did not.
    pub failed: Vec<Failed>,
    /// All figures that some member has.
    pub figures: Vec<Judged>,
    /// Bands of the channels looked at.
    #[serde(flatten)]
    pub bands: Bands,
    /// Files of bands and plots.
    pub files: Vec<String>,
}

/// A member that did not complete, and why.
#[derive(Serialize)]
pub struct Failed {
    /// Number of the member.
    pub member: u64,
    /// Why.
    pub reason: String,
}

impl Report {
    /// Judges what the members left.
    pub fn of(
        nominal: &Left,
        others: &[Member],
        within: f64,
        bands: Bands,
        (seed, changes): (u64, Tolerances),
    ) -> Report {
        let failed = |(member, left): (u64, &Member)| Some(Failed { member, reason: left.as_ref().err()?.clone() });
        let failed: Vec<Failed> = (1..).zip(others).filter_map(failed).collect();
        let value = |i: usize, member: &Member| member.as_ref().map_or(f64::NAN, |left| left.value(i));
        let values = |i: usize| std::iter::once(nominal.value(i)).chain(others.iter().map(|m| value(i, m))).collect();
        let values: Vec<Vec<f64>> = (0..nominal.figures.len()).map(values).collect();
        let figures = nominal.figures.iter().zip(&values);
        let figures = judge(figures.map(|(f, values)| (f.name.as_str(), f.unit, &values[..])), within);
        let members = others.len() as u64 + 1;
        let completed = members - failed.len() as u64;
        Report { members, completed, seed, changes, within, failed, figures, bands, files: Vec::new() }
    }

    /// Names of the figures that are not stable.
    pub fn unstable(&self) -> Vec<&str> {
        let unstable = self.figures.iter().filter(|f| f.verdict == Verdict::NotStable);
        unstable.map(|f| f.name.as_str()).collect()
    }
}
