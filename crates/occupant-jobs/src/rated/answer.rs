//! Ratings as `--json` prints them.

use crash_measures::rating::{Method, Outcome, Rated, RatedCriterion, RatedOccupant, RatedRegion, RatedTest, Rating};
use serde::Serialize;

/// A rating of several runs, tests or values.
#[derive(Serialize)]
pub struct Answer {
    rating: &'static str,
    title: &'static str,
    source: &'static str,
    remark: &'static str,
    /// What results are: points, limits, joint risk or demerits.
    kind: &'static str,
    results: Vec<Result>,
}

/// Result of one body, or of values.
#[derive(Serialize)]
pub struct Result {
    file: String,
    #[serde(skip_serializing_if = "String::is_empty")]
    occupant: String,
    /// What the body is not.
    notes: Vec<String>,
    tests: Vec<Test>,
    /// Sum of several tests.
    #[serde(skip_serializing_if = "Option::is_none")]
    sum: Option<Told>,
}

#[derive(Serialize)]
struct Test {
    test: &'static str,
    result: Option<Told>,
    occupants: Vec<Person>,
}

/// A result: with blanks that count nothing, with blanks at their best, most.
#[derive(Serialize)]
struct Told {
    now: f64,
    best: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    of: Option<f64>,
    words: String,
}

#[derive(Serialize)]
struct Person {
    case: &'static str,
    seat: &'static str,
    dummy: &'static str,
    capped: bool,
    /// Whether a caveat applies to what it is made of.
    doubtful: bool,
    result: Told,
    regions: Vec<Region>,
}

#[derive(Serialize)]
struct Region {
    region: &'static str,
    /// Worth of its worst criterion.
    worth: Option<f64>,
    doubtful: bool,
    result: Told,
    criteria: Vec<Criterion>,
}

#[derive(Serialize)]
struct Criterion {
    criterion: &'static str,
    unit: &'static str,
    value: Option<f64>,
    /// The word for the value, such as a colour.
    #[serde(skip_serializing_if = "Option::is_none")]
    word: Option<&'static str>,
    scale: String,
    cap: Option<f64>,
    worth: Option<f64>,
    /// Percent taken from the region.
    deducted: f64,
    capped: bool,
    doubtful: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    remark: Option<String>,
}

impl Answer {
    /// A rating with its results.
    pub fn new(rating: &'static Rating, results: Vec<Result>) -> Self {
        let kind = match rating.method {
            Method::Bands | Method::Sliding => "points",
            Method::Limits(_) => "limits",
            Method::Stars => "joint risk",
            Method::Demerits(_) => "demerits",
        };
        let Rating { name, title, source, remark, .. } = *rating;
        Answer { rating: name, title, source, remark, kind, results }
    }
}

impl Result {
    /// Result of a body of a file.
    pub fn new(file: &str, occupant: &str, notes: Vec<String>, rated: &Rated) -> Self {
        let method = rated.rating.method;
        let tests = rated.tests.iter().map(|test| Test::of(test, method)).collect();
        let sum = rated.sum.map(|sum| Told::of(&sum, method));
        Result { file: file.to_owned(), occupant: occupant.to_owned(), notes, tests, sum }
    }
}

impl Test {
    fn of(rated: &RatedTest, method: Method) -> Self {
        let occupants = rated.occupants.iter().map(|own| Person::of(own, method)).collect();
        let result = rated.outcome.map(|outcome| Told::of(&outcome, method));
        Test { test: rated.test.name, result, occupants }
    }
}

impl Told {
    fn of(outcome: &Outcome, method: Method) -> Self {
        Told { now: outcome.now, best: outcome.best, of: outcome.of, words: outcome.words(method) }
    }
}

impl Person {
    fn of(rated: &RatedOccupant, method: Method) -> Self {
        Person {
            case: rated.occupant.case,
            seat: rated.occupant.seat,
            dummy: rated.occupant.label,
            capped: rated.capped,
            doubtful: rated.doubtful,
            result: Told::of(&rated.outcome, method),
            regions: rated.regions.iter().map(|region| Region::of(region, method)).collect(),
        }
    }
}

impl Region {
    fn of(rated: &RatedRegion, method: Method) -> Self {
        Region {
            region: rated.region.name,
            worth: rated.worth,
            doubtful: rated.doubtful,
            result: Told::of(&rated.outcome, method),
            criteria: rated.criteria.iter().map(Criterion::of).collect(),
        }
    }
}

impl Criterion {
    fn of(rated: &RatedCriterion) -> Self {
        Criterion {
            criterion: rated.criterion.name,
            unit: rated.unit.symbol,
            value: rated.entry.value,
            word: rated.entry.value.and_then(|value| rated.criterion.scale.word(value)),
            scale: super::text::scale(rated),
            cap: rated.criterion.cap,
            worth: rated.worth,
            deducted: rated.deducted,
            capped: rated.capped,
            doubtful: rated.entry.doubtful,
            remark: rated.entry.remark.clone(),
        }
    }
}
