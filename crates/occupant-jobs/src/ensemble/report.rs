//! Results of an ensemble: `--json` prints them, and the tables on the terminal use them.

use occupant_study::Tolerances;
use occupant_study::spread::Verdict;
use serde::Serialize;

use super::judge::judge;
use super::{Bands, Judged, Left, Member};
use crate::quoted::Statement;

/// Results of an ensemble; SI units.
#[derive(Serialize)]
pub struct Report {
    /// Number of runs, including the unchanged one.
    pub members: u64,
    /// Runs that completed.
    pub completed: u64,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Tolerances of the perturbations.
    pub changes: Tolerances,
    /// Largest width of the middle 90 % of a stable figure, relative to the median.
    pub within: f64,
    /// Runs that did not complete.
    pub failed: Vec<Failed>,
    /// All figures that any member has.
    pub figures: Vec<Judged>,
    /// Bands of the selected channels.
    #[serde(flatten)]
    pub bands: Bands,
    /// Files of bands and plots.
    pub files: Vec<String>,
    /// Inputs drawn from ready distributions, described.
    pub inputs: Vec<String>,
    /// What the changed runs say of each figure.
    pub quotes: Vec<Statement>,
    /// Names of figures whose paragraphs are printed.
    #[serde(skip)]
    pub quote: Vec<String>,
}

/// A member that did not complete, with the reason.
#[derive(Serialize)]
pub struct Failed {
    /// Number of the member.
    pub member: u64,
    /// The reason.
    pub reason: String,
}

impl Report {
    /// Assesses the results of the members.
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
        let (files, inputs, quotes, quote) = Default::default();
        Report { members, completed, seed, changes, within, failed, figures, bands, files, inputs, quotes, quote }
    }

    /// Names of the figures that are not stable.
    pub fn unstable(&self) -> Vec<&str> {
        let unstable = self.figures.iter().filter(|f| f.verdict == Verdict::NotStable);
        unstable.map(|f| f.name.as_str()).collect()
    }
}
