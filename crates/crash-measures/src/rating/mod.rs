//! Ratings of crash tests: points, stars, grades or a verdict from measures, with the tables and rules of those who
//! rate.
//!
//! A [`Rating`] is data: tests, their occupants, regions of the body, criteria with scales. [`Rating::rate`] computes
//! any of them from [`Entry`]s, one per criterion. A criterion without a value is blank. What that leaves open is said:
//! every result is an interval, from blanks that count as the rating body counts them (no points) to blanks at their
//! best.
//!
//! Every table names the document it rests on, its version and year, and where it was read. Sums over what an inspector
//! sees (modifiers, structure, excursion) hold without them unless they are given.

mod entry;
mod far_side;
mod rate;
mod round;
mod scale;
mod tables;

use crate::measure::{Blow, Dummy, Rule};

pub use entry::{Entry, Instrument, Scaled, instrument};
pub use far_side::COLOURS;
pub use rate::{INSPECTION, Outcome, Rated, RatedCriterion, RatedOccupant, RatedRegion, RatedTest};
pub use scale::{Criterion, Scale};
pub use tables::RATINGS;

/// How criteria make a result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// Points in five steps of colour, with the rounding of Euro NCAP 2026.
    Bands,
    /// Points on a line from the higher to the lower performance limit.
    Sliding,
    /// Met or not met.
    Limits(Rule),
    /// Stars from the joint risk.
    Stars,
    /// Good, acceptable, marginal, poor: largest sums of demerits of the first three.
    Demerits([f64; 3]),
}

/// A rating.
#[derive(Clone, Copy, Debug)]
pub struct Rating {
    /// Name, such as `euro-ncap-2026-full-width`.
    pub name: &'static str,
    /// Full name with its year.
    pub title: &'static str,
    /// The document with version and year, and where it was read.
    pub source: &'static str,
    /// What the result lacks, whatever the body.
    pub remark: &'static str,
    /// Direction of the test.
    pub blow: Blow,
    /// How criteria make a result.
    pub method: Method,
    /// Its tests.
    pub tests: &'static [Test],
}

/// One test of a rating.
#[derive(Clone, Copy, Debug)]
pub struct Test {
    /// Name.
    pub name: &'static str,
    /// Its occupants.
    pub occupants: &'static [Occupant],
    /// How occupants make the result of the test.
    pub total: Total,
}

/// How occupants make the result of a test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Total {
    /// Sum of all, times a factor.
    Sum(f64),
    /// Sum of the worst of each region, times a factor.
    WorstRegions(f64),
    /// Sum of the worst occupant of each part. Parts are runs of occupants of these lengths.
    WorstOfParts(&'static [usize]),
    /// No common result.
    Apart,
}

/// A dummy at a place in a test.
#[derive(Clone, Copy, Debug)]
pub struct Occupant {
    /// Load case.
    pub case: &'static str,
    /// Seat.
    pub seat: &'static str,
    /// The dummy as the table calls it.
    pub label: &'static str,
    /// The same dummy as it is called here; none for dummies that are not known here.
    pub dummy: Option<Dummy>,
    /// Regions of its body.
    pub regions: &'static [Region],
}

/// A region of the body.
#[derive(Clone, Copy, Debug)]
pub struct Region {
    /// Name.
    pub name: &'static str,
    /// Most points; unused where none are given.
    pub points: f64,
    /// Demerits of good, acceptable, marginal and poor.
    pub demerits: [f64; 4],
    /// Its criteria: the worst counts.
    pub criteria: &'static [Criterion],
}

impl Rating {
    /// The rating of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Rating> {
        RATINGS.iter().find(|rating| rating.name == name)
    }

    /// Every occupant of every test.
    pub fn occupants(&self) -> impl Iterator<Item = &'static Occupant> {
        self.tests.iter().flat_map(|test| test.occupants)
    }
}

impl Occupant {
    /// Place as text, such as `FWDB-35, Driver, HIII-05`.
    #[must_use]
    pub fn place(&self) -> String {
        [self.case, self.seat, self.label].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(", ")
    }
}

/// A region whose worst criterion gives points.
const fn region(name: &'static str, points: f64, criteria: &'static [Criterion]) -> Region {
    Region { name, points, demerits: [0.0; 4], criteria }
}

/// A region whose worst criterion gives demerits.
const fn graded(name: &'static str, demerits: [f64; 4], criteria: &'static [Criterion]) -> Region {
    Region { name, points: 0.0, demerits, criteria }
}

#[cfg(test)]
mod tests;
