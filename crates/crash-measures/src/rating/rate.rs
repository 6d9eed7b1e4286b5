//! The result of a rating.
//!
//! It is computed twice: with blanks as the rating body counts them, and with blanks at their best. What the two differ
//! by is what is open.

use std::collections::HashMap;

use super::entry::{Entry, Scaled, instrument};
use super::far_side::{self, COUNTERMEASURE, EXCURSION, RED_LINE};
use super::round::half_up;
use super::scale::{Criterion, Scale};
use super::{Method, Occupant, Rating, Region, Test, Total};
use crate::measure::risk::{joint_risk, us_ncap_frontal_stars};

/// Name of the percentage that an inspector takes from a region.
pub const INSPECTION: Criterion = super::scale::criterion("Inspection [%]", Scale::Percent);

/// What a blank counts as.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Blank {
    /// Nothing: no points.
    Nothing,
    /// The best value.
    Best,
}

/// A result, with blanks that count nothing and with blanks at their best: points, demerits, joint risk, or 1 for met
/// and 0 for not met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Blanks count nothing.
    pub now: f64,
    /// Blanks at their best.
    pub best: f64,
    /// Most points; none without points.
    pub of: Option<f64>,
}

/// A rating with its results.
#[derive(Clone, Debug)]
pub struct Rated {
    /// The rating.
    pub rating: &'static Rating,
    /// Results of its tests, without occupants that were not filled.
    pub tests: Vec<RatedTest>,
    /// Sum of several tests with points; none if a result is missing.
    pub sum: Option<Outcome>,
}

/// Result of a test.
#[derive(Clone, Debug)]
pub struct RatedTest {
    /// The test.
    pub test: &'static Test,
    /// Its occupants.
    pub occupants: Vec<RatedOccupant>,
    /// Common result of all occupants; none if some are missing or none is defined.
    pub outcome: Option<Outcome>,
}

/// Result of an occupant.
#[derive(Clone, Debug)]
pub struct RatedOccupant {
    /// The occupant.
    pub occupant: &'static Occupant,
    /// Regions.
    pub regions: Vec<RatedRegion>,
    /// Whether a cap takes all points.
    pub capped: bool,
    /// Sum of the regions.
    pub outcome: Outcome,
    /// Whether a caveat applies to a value in it.
    pub doubtful: bool,
}

/// Result of a region.
#[derive(Clone, Debug)]
pub struct RatedRegion {
    /// The region.
    pub region: &'static Region,
    /// Criteria.
    pub criteria: Vec<RatedCriterion>,
    /// Percent of the points before deductions, or worth of the worst criterion, with blanks that count nothing; none
    /// if nothing is asked.
    pub worth: Option<f64>,
    /// Result.
    pub outcome: Outcome,
    /// Whether a caveat applies to a value in it.
    pub doubtful: bool,
}

/// Result of a criterion.
#[derive(Clone, Debug)]
pub struct RatedCriterion {
    /// The criterion.
    pub criterion: Criterion,
    /// Its unit.
    pub unit: Scaled,
    /// Value or reason for a blank.
    pub entry: Entry,
    /// Largest value allowed, if the scale is such a limit.
    pub most: Option<f64>,
    /// Worth of the value; none if it is blank or not asked.
    pub worth: Option<f64>,
    /// Percent taken from the region.
    pub deducted: f64,
    /// Whether it takes all points of the occupant.
    pub capped: bool,
}

/// Place of a criterion: occupant by its index in the rating, region, name.
type Place = (usize, &'static str, &'static str);

/// One occupant to be rated.
struct Person<'a> {
    rating: &'static Rating,
    occupant: &'static Occupant,
    index: usize,
    filled: &'a HashMap<Place, Entry>,
    /// Worst lower legs of other tests, with blanks that count nothing and at their best; none if none is there.
    others: Option<[f64; 2]>,
}

impl Rating {
    /// Rates occupants. `fill` gives the entry of each criterion of an occupant; occupants for which `is_there` is
    /// false are left out.
    #[must_use]
    pub fn rate(
        &'static self,
        is_there: impl Fn(&Occupant) -> bool,
        fill: impl Fn(&Occupant, &Region, &Criterion) -> Entry,
    ) -> Rated {
        let there: Vec<_> = self.occupants().enumerate().filter(|(_, occupant)| is_there(occupant)).collect();
        let mut filled = HashMap::new();
        for (index, occupant) in &there {
            for region in occupant.regions {
                for criterion in region.criteria.iter().chain([&INSPECTION]) {
                    filled.insert((*index, region.name, criterion.name), fill(occupant, region, criterion));
                }
            }
        }
        let mut legs: Option<[f64; 2]> = None;
        let mut index = 0;
        let tests = self.tests.iter().map(|test| {
            let mut occupants = Vec::new();
            for occupant in test.occupants {
                if there.iter().any(|(known, _)| *known == index) {
                    let rated = Person { rating: self, occupant, index, filled: &filled, others: legs }.rated();
                    legs = worse_legs(legs, &rated);
                    occupants.push(rated);
                }
                index += 1;
            }
            if matches!(test.total, Total::WorstOfParts(_)) {
                far_side::share_caps(&mut occupants);
            }
            let outcome = (occupants.len() == test.occupants.len()).then(|| total(self.method, test, &occupants));
            RatedTest { test, occupants, outcome: outcome.flatten() }
        });
        let tests: Vec<RatedTest> = tests.collect();
        let sum = if self.method == Method::Bands { sum_of(&tests) } else { None };
        let tests = tests.into_iter().filter(|test| !test.occupants.is_empty()).collect();
        Rated { rating: self, tests, sum }
    }
}

/// Sum of several tests.
fn sum_of(tests: &[RatedTest]) -> Option<Outcome> {
    let all = tests.iter().map(|test| test.outcome).collect::<Option<Vec<_>>>().filter(|all| all.len() > 1)?;
    let of = |of: fn(&Outcome) -> f64| half_up(all.iter().map(of).sum(), 3);
    Some(Outcome { now: of(|one| one.now), best: of(|one| one.best), of: all.iter().map(|one| one.of).sum() })
}

/// Occupants in runs of these lengths.
fn parts<'a>(occupants: &'a [RatedOccupant], sizes: &'a [usize]) -> impl Iterator<Item = &'a [RatedOccupant]> {
    sizes.iter().scan(occupants, |rest, size| {
        let (part, others) = rest.split_at_checked(*size)?;
        *rest = others;
        Some(part)
    })
}

/// The worst lower legs so far, of criteria of this program's tables that are no result of others.
fn worse_legs(known: Option<[f64; 2]>, rated: &RatedOccupant) -> Option<[f64; 2]> {
    let legs = rated.regions.iter().find(|region| region.region.name == LOWER_LEGS);
    let own = legs.filter(|legs| legs.criteria.iter().any(|c| c.criterion.is_scored() && !is_of_others(&c.criterion)));
    let Some(own) = own.and_then(|legs| Some([legs.worth?, legs.best_worth()])) else { return known };
    let [now, best] = known.unwrap_or([100.0; 2]);
    Some([now.min(own[0]), best.min(own[1])])
}

fn is_of_others(criterion: &Criterion) -> bool {
    matches!(criterion.scale, Scale::Others)
}

/// The region that tests with virtual legs take from the others.
pub(super) const LOWER_LEGS: &str = "Lower Leg, Foot & Ankle";

/// Common result of all occupants of a test.
fn total(method: Method, test: &Test, occupants: &[RatedOccupant]) -> Option<Outcome> {
    let of_all = |of: &dyn Fn(&Outcome) -> f64| -> Option<f64> {
        match test.total {
            Total::Apart => None,
            Total::Sum(factor) => Some(factor * occupants.iter().map(|rated| of(&rated.outcome)).sum::<f64>()),
            Total::WorstOfParts(sizes) => {
                let worst =
                    |part: &[RatedOccupant]| part.iter().map(|own| of(&own.outcome)).fold(f64::INFINITY, f64::min);
                Some(parts(occupants, sizes).map(worst).sum())
            }
            Total::WorstRegions(factor) => {
                let capped = occupants.iter().any(|rated| rated.capped);
                let regions = occupants.first()?.regions.iter().enumerate();
                let worst = regions.map(|(i, _)| {
                    let all = occupants.iter().filter_map(|rated| rated.regions.get(i));
                    all.map(|region| of(&region.outcome)).fold(f64::INFINITY, f64::min)
                });
                Some(if capped { 0.0 } else { factor * worst.sum::<f64>() })
            }
        }
    };
    let rounded = |value: f64| if method == Method::Bands { half_up(value, 3) } else { value };
    let (now, best) = (rounded(of_all(&|outcome| outcome.now)?), rounded(of_all(&|outcome| outcome.best)?));
    let of_each = || occupants.iter().map(|rated| rated.outcome.of);
    let most = match test.total {
        Total::Sum(factor) => of_each().sum::<Option<f64>>().map(|sum| factor * sum),
        Total::WorstRegions(factor) => of_each().next().flatten().map(|each| factor * each),
        Total::WorstOfParts(sizes) => {
            parts(occupants, sizes).filter_map(|part| part.first()).map(|own| own.outcome.of).sum::<Option<f64>>()
        }
        Total::Apart => None,
    };
    Some(Outcome { now, best, of: most.map(|most| half_up(most, 3)) })
}

impl Person<'_> {
    fn entry(&self, region: &Region, criterion: &Criterion) -> Entry {
        self.filled.get(&(self.index, region.name, criterion.name)).cloned().unwrap_or_default()
    }

    /// A value of the head's gate, wherever it stands.
    fn gate(&self) -> Option<(f64, bool, Option<f64>)> {
        self.occupant.regions.iter().find_map(|region| {
            region.criteria.iter().find_map(|criterion| match criterion.scale {
                Scale::Gate { below, full } => Some((below, full, self.entry(region, criterion).value)),
                _ => None,
            })
        })
    }

    /// Whether gated criteria are asked. A blank gate counts as a contact; at its best it is none.
    fn is_asked(&self, blank: Blank) -> bool {
        match self.gate() {
            None => true,
            Some((_, _, None)) => blank == Blank::Nothing,
            Some((below, _, Some(value))) => self.rounded(value) >= below,
        }
    }

    fn rounded(&self, value: f64) -> f64 {
        if self.rating.method == Method::Bands { half_up(value, 2) } else { value }
    }

    fn rated(&self) -> RatedOccupant {
        let regions: Vec<_> = self.occupant.regions.iter().map(|region| self.region(region)).collect();
        let capped = regions.iter().flat_map(|region| &region.criteria).any(|criterion| criterion.capped);
        let of = |of: fn(&Outcome) -> f64| self.sum(regions.iter().map(|region| of(&region.outcome)), capped);
        let (now, best) = (of(|outcome| outcome.now), of(|outcome| outcome.best));
        let most = self.has_points().then(|| regions.iter().map(|region| region.region.points).sum());
        let doubtful = regions.iter().any(|region| region.doubtful);
        let outcome = Outcome { now, best, of: most.map(|most| half_up(most, 4)) };
        RatedOccupant { occupant: self.occupant, regions, capped, outcome, doubtful }
    }

    fn has_points(&self) -> bool {
        matches!(self.rating.method, Method::Bands | Method::Sliding)
    }

    /// All regions together.
    fn sum(&self, regions: impl Iterator<Item = f64>, capped: bool) -> f64 {
        match self.rating.method {
            Method::Bands | Method::Sliding if capped => 0.0,
            Method::Bands => half_up(regions.sum(), 4),
            Method::Sliding | Method::Demerits(_) => regions.sum(),
            Method::Limits(_) => regions.fold(1.0, f64::min),
            Method::Stars => joint_risk(&regions.collect::<Vec<_>>()),
        }
    }

    fn region(&self, region: &'static Region) -> RatedRegion {
        let all = region.criteria.iter().map(|criterion| self.criterion(region, criterion));
        let inspected = Some(self.criterion(region, &INSPECTION)).filter(|own| own.entry.value.is_some());
        let criteria: Vec<_> = all.chain(inspected).collect();
        let deducted: f64 = criteria.iter().map(|own| own.deducted).sum();
        let [now, best] = [Blank::Nothing, Blank::Best].map(|blank| self.worst(region, &criteria, blank));
        let outcome = Outcome {
            now: self.result(region, now, deducted),
            best: self.result(region, best, deducted),
            of: self.has_points().then_some(region.points),
        };
        let doubtful = criteria.iter().any(|own| own.entry.doubtful && self.matters(own));
        RatedRegion { region, criteria, worth: now, outcome, doubtful }
    }

    /// Whether a criterion has a part in the result.
    fn matters(&self, own: &RatedCriterion) -> bool {
        own.worth.is_some() || own.capped || own.deducted > 0.0 || matches!(own.criterion.scale, Scale::Gate { .. })
    }

    fn criterion(&self, region: &Region, criterion: &Criterion) -> RatedCriterion {
        let entry = self.entry(region, criterion);
        let unit = instrument(region.name, criterion.name).unit;
        let (method, dummy) = (self.rating.method, self.occupant.dummy);
        let most = criterion.scale.most(unit.factor, method, dummy);
        let is_asked = !criterion.gated || self.is_asked(Blank::Nothing);
        let worth = entry.value.filter(|_| is_asked);
        let worth = worth.and_then(|value| self.worth(region, criterion, value, Blank::Nothing));
        let spared =
            matches!(criterion.scale, Scale::CapUnless { other, below } if self.is_below(region, other, below));
        let capped = entry.value.is_some_and(|value| criterion.caps(value, method)) && !spared;
        let deducted = entry.value.map_or(0.0, |value| criterion.deducted(value));
        RatedCriterion { criterion: *criterion, unit, entry, most, worth, deducted, capped }
    }

    /// What a value is worth; other blanks may matter.
    fn worth(&self, region: &Region, criterion: &Criterion, value: f64, blank: Blank) -> Option<f64> {
        let is_so = |name| self.is_so(region, name, blank);
        match criterion.scale {
            Scale::Excursion => Some(far_side::worth(value, is_so(COUNTERMEASURE), is_so(RED_LINE))),
            Scale::Beside(main) => self.worth_beside(region, value, main, blank),
            scale => {
                let factor = instrument(region.name, criterion.name).unit.factor;
                scale.worth(value, factor, self.rating.method, self.occupant.dummy)
            }
        }
    }

    /// Whether the answer to a question is yes.
    fn is_so(&self, region: &Region, name: &str, blank: Blank) -> bool {
        let question = region.criteria.iter().find(|criterion| criterion.name == name);
        let answer = question.and_then(|question| self.entry(region, question).value);
        answer.map_or(blank == Blank::Best, |answer| answer > 0.0)
    }

    /// What a colour is worth beside that of the main case; nothing is known without it.
    fn worth_beside(&self, region: &Region, value: f64, main: &str, blank: Blank) -> Option<f64> {
        let index = self.rating.occupants().position(|own| own.case == main);
        let main = index.and_then(|index| self.filled.get(&(index, region.name, EXCURSION))?.value);
        main.map_or((blank == Blank::Best).then_some(100.0), |main| Some(far_side::worth_beside(value, main)))
    }

    fn is_below(&self, region: &Region, other: &str, below: f64) -> bool {
        let other = region.criteria.iter().find(|criterion| criterion.name == other);
        other.and_then(|other| self.entry(region, other).value).is_some_and(|value| self.rounded(value) < below)
    }

    /// Worth of the worst criterion that is asked; none if there is none.
    fn worst(&self, region: &Region, criteria: &[RatedCriterion], blank: Blank) -> Option<f64> {
        let is_asked = self.is_asked(blank);
        let of = |own: &RatedCriterion| match own.criterion.scale {
            Scale::Gate { full, .. } => (full && !is_asked).then_some(100.0),
            Scale::Others if own.entry.value.is_none() => self.of_others(blank),
            _ if !own.criterion.is_scored() || own.criterion.gated && !is_asked => None,
            scale => match (own.entry.value, blank) {
                (None, Blank::Nothing) => Some(0.0),
                (None, Blank::Best) => Some(scale.best()),
                (Some(_), Blank::Nothing) => own.worth,
                (Some(value), Blank::Best) => self.worth(region, &own.criterion, value, blank),
            },
        };
        let worst = criteria.iter().filter_map(of).reduce(f64::min);
        if region.name == LOWER_LEGS && self.lacks_a_region() && criteria.iter().any(|c| is_of_others(&c.criterion)) {
            return worst.map(|worst| if blank == Blank::Nothing { 0.0 } else { worst });
        }
        worst
    }

    /// Legs that other tests decide.
    fn of_others(&self, blank: Blank) -> Option<f64> {
        let legs = self.others.map(|others| others[usize::from(blank == Blank::Best)]);
        Some(legs.map_or(if blank == Blank::Best { 100.0 } else { 0.0 }, |legs| if legs > 0.0 { 100.0 } else { 0.0 }))
    }

    /// Whether all criteria of another region are blank: virtual legs then have no points.
    fn lacks_a_region(&self) -> bool {
        let is_blank = |region: &Region| {
            let scored = region.criteria.iter().filter(|own| !matches!(own.scale, Scale::Deduction(_)));
            scored.clone().all(|own| self.entry(region, own).value.is_none())
        };
        self.occupant.regions.iter().filter(|region| region.name != LOWER_LEGS).any(is_blank)
    }

    /// Points, demerits, risk or verdict of a region from the worth of its worst criterion.
    fn result(&self, region: &Region, worth: Option<f64>, deducted: f64) -> f64 {
        match self.rating.method {
            Method::Bands => half_up(worth.map_or(0.0, |worth| (worth - deducted).max(0.0) * region.points / 100.0), 5),
            Method::Sliding => worth.map_or(0.0, |worth| (worth - deducted).max(0.0) * region.points / 100.0),
            Method::Limits(_) => worth.map_or(1.0, |worth| worth / 100.0),
            Method::Stars => worth.map_or(0.0, |worth| 1.0 - worth / 100.0),
            Method::Demerits(_) => region.demerits[3 - worth.map_or(3, |worth| worth.clamp(0.0, 3.0) as usize)],
        }
    }
}

impl Rated {
    /// Whether anything is lost: a limit that is not met, a cap, a region without points, a poor one.
    #[must_use]
    pub fn is_unmet(&self) -> bool {
        let all = self.tests.iter().flat_map(|test| &test.occupants);
        all.clone().any(|own| own.capped) || all.flat_map(|own| &own.regions).any(RatedRegion::is_lost)
    }
}

impl RatedOccupant {
    /// Takes all points.
    pub(super) fn cap(&mut self) {
        (self.capped, self.outcome.now, self.outcome.best) = (true, 0.0, 0.0);
    }
}

impl RatedRegion {
    /// Whether a value takes everything that it can give.
    fn is_lost(&self) -> bool {
        self.criteria.iter().any(|own| own.worth == Some(0.0))
    }

    /// Worth with blanks at their best.
    fn best_worth(&self) -> f64 {
        let blank = |own: &&RatedCriterion| own.criterion.is_scored() && own.entry.value.is_none();
        let known = self.criteria.iter().filter_map(|own| own.worth).reduce(f64::min);
        let blanks = self.criteria.iter().find(blank).map(|own| own.criterion.scale.best());
        known.or(blanks).unwrap_or(100.0)
    }
}

impl Outcome {
    /// Whether blanks matter.
    #[must_use]
    pub fn is_open(&self) -> bool {
        self.now != self.best
    }

    /// In words: points, `met`, stars, a grade.
    #[must_use]
    pub fn words(&self, method: Method) -> String {
        let [now, best] = [self.now, self.best].map(|value| one(value, self.of, method));
        if now == best { now } else { between(&now, &best, method) }
    }
}

fn between(now: &str, best: &str, method: Method) -> String {
    match method {
        Method::Limits(_) => "open".to_owned(),
        _ => format!("{now}; {best} with blanks at their best"),
    }
}

fn one(value: f64, of: Option<f64>, method: Method) -> String {
    match method {
        Method::Bands | Method::Sliding => format!("{value:.3} of {} points", of.map_or(0.0, |of| of)),
        Method::Limits(_) => if value > 0.0 { "met" } else { "NOT MET" }.to_owned(),
        Method::Stars => {
            let stars = us_ncap_frontal_stars(value);
            let words = |stars: u8| if stars == 1 { "1 star".to_owned() } else { format!("{stars} stars") };
            format!("{} (joint risk {:.1} %)", stars.map_or("–".to_owned(), words), 100.0 * value)
        }
        Method::Demerits(bounds) => {
            let grade = ["good", "acceptable", "marginal", "poor"][bounds.iter().filter(|most| value > **most).count()];
            format!("{grade} ({value} demerits)")
        }
    }
}
