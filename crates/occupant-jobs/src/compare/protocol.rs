//! Validation of a model by the rules of a protocol for virtual testing: required sensors by ISO/TS 18571, criteria by
//! their amplitude.
//!
//! A sensor with three axes has the mean of their scores, weighed by the largest magnitudes of the computed axes. A
//! criterion is divided by its limit; if the test reaches half of it, both may differ by less than 0.3.

use std::path::Path;

use crash_measures::injury::{Filtering, Measure, Options, assess};
use crash_measures::rating::{Rating, Scale, instrument};
use occupant_files::measured::{self, is_recording};
use occupant_files::results::Results;
use placed_text::number;
use serde::Serialize;

use super::{RatedPair, Request};
use crate::base::Failure;
use crate::base::text_table::Align::{Left, Right};
use crate::base::text_table::{NONE, Table, number as decimals};
use crate::files::history::Filter;
use crate::instruments::Instruments;

/// Least score of a sensor.
const LEAST_SCORE: f64 = 0.5;
/// Part of its limit from which on a criterion of the test counts.
const COUNTS_FROM: f64 = 0.5;
/// Difference of a criterion over its limit that is too much.
const TOO_FAR: f64 = 0.3;

/// A protocol.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Protocol {
    /// Euro NCAP, far side.
    FarSide,
    /// Euro NCAP, frontal.
    Frontal,
}

/// Protocols: names on the command line, names in help.
pub const PROTOCOLS: [(&str, &str, Protocol); 2] = [
    ("far-side", "Euro NCAP, Virtual Far Side Simulation & Assessment Protocol, version 1.0, 2023", Protocol::FarSide),
    ("frontal", "Euro NCAP, Virtual Testing, frontal impact, 2026 (sensors as selected)", Protocol::Frontal),
];

/// A required sensor: name, and how its channels are recognised.
struct Sensor {
    name: &'static str,
    /// Part of ISO-MME codes from the third character on, and the dimension.
    code: (&'static str, &'static str),
    /// Start of a channel of a run.
    channel: &'static str,
    /// What this channel stands in for; nothing if it is the sensor.
    stands_in: &'static str,
}

const fn sensor(name: &'static str, code: (&'static str, &'static str), channel: &'static str) -> Sensor {
    Sensor { name, code, channel, stands_in: "" }
}

/// Sensors of the far-side protocol.
const FAR_SIDE: [Sensor; 6] = [
    sensor("head angular velocity", ("HEAD", "AV"), "head.angular_velocity."),
    Sensor {
        stands_in: "the upper torso stands in for T4",
        ..sensor("T4 acceleration", ("THSP04", "AC"), "upper_torso.acceleration.")
    },
    sensor("T12 acceleration", ("THSP12", "AC"), "lower_spine.acceleration."),
    sensor("pelvis acceleration", ("PELV", "AC"), "lower_torso.acceleration."),
    Sensor {
        stands_in: "the vehicle's frame stands in for the B-pillar",
        ..sensor("B-pillar acceleration", ("BPIL", "AC"), "vehicle.acceleration.")
    },
    sensor("shoulder belt force", ("SEBE", "FO"), "belt."),
];

/// Criteria of the far-side protocol: measure, name, SI units in the unit shown, unit, limit.
const HEAD: [(&str, &str, f64, &str, f64); 2] = [
    ("hic15", "HIC15", 1.0, "", 700.0),
    ("head_3ms_cumulative", "head, 3 ms", crash_measures::signal::STANDARD_GRAVITY_MPS2, "g", 80.0),
];

/// The rating whose lower performance limits hold in the frontal protocol.
const FRONTAL_LIMITS: &str = "euro-ncap-2026-sled";

impl Protocol {
    fn source(self) -> &'static str {
        match self {
            Self::FarSide => {
                "Euro NCAP, Virtual Far Side Simulation & Assessment Protocol, version 1.0, June 2023, as read in pyisomme 1.1.0"
            }
            Self::Frontal => {
                "Euro NCAP, Crash Protection, Virtual Testing, 2026, 5.3.2 and 5.4.2, as read in the manual of Oasys Workflows 22.1; its list of sensors (5.4.1) was not at hand: all channels that are compared count"
            }
        }
    }

    fn sensors(self) -> &'static [Sensor] {
        match self {
            Self::FarSide => &FAR_SIDE,
            Self::Frontal => &[],
        }
    }
}

/// A model against the protocol.
#[derive(Serialize)]
pub struct Validation {
    source: &'static str,
    /// Whether it is valid; none if something required is missing and nothing fails.
    valid: Option<bool>,
    dummy: &'static str,
    sensors: Vec<SensorScore>,
    criteria: Vec<Amplitude>,
}

#[derive(Serialize)]
struct SensorScore {
    sensor: String,
    channels: Vec<Axis>,
    /// From 0 to 1; none if it is missing.
    score: Option<f64>,
    passed: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    remark: Option<String>,
}

#[derive(Serialize)]
struct Axis {
    channel: String,
    score: f64,
    weight: f64,
}

/// A criterion of both sides over its limit.
#[derive(Serialize)]
struct Amplitude {
    criterion: String,
    unit: &'static str,
    limit: f64,
    measured: Option<f64>,
    computed: Option<f64>,
    /// Measured and computed value over the limit, and how far they lie apart.
    measured_part: Option<f64>,
    computed_part: Option<f64>,
    difference: Option<f64>,
    passed: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    remark: Option<String>,
}

/// A criterion to be compared: measure, name, SI units in the unit shown, unit, limit.
type Wanted = (&'static str, String, f64, &'static str, f64);

/// Validates the pairs of a comparison, and the criteria of both sides.
///
/// # Errors
/// Files that cannot be read.
pub(super) fn validate(protocol: Protocol, request: &Request<'_>, pairs: &[RatedPair]) -> Result<Validation, Failure> {
    let [computed, measured] = [request.computed, request.measured].map(|path| side(path, request));
    let (dummy, computed) = computed?;
    let measured = measured?.1;
    let sensors: Vec<_> = match protocol.sensors() {
        [] => pairs.iter().map(|pair| score(&pair.channel, vec![pair], None)).collect(),
        required => required.iter().map(|sensor| sensor.score(pairs)).collect(),
    };
    let criteria: Vec<_> =
        wanted(protocol, dummy).into_iter().map(|wanted| Amplitude::of(wanted, &measured, &computed)).collect();
    let passed = sensors.iter().map(|own| own.passed).chain(criteria.iter().map(|own| own.passed)).collect::<Vec<_>>();
    let is_whole = !criteria.is_empty() && passed.iter().all(Option::is_some);
    let valid = if passed.contains(&Some(false)) { Some(false) } else { is_whole.then_some(true) };
    Ok(Validation { source: protocol.source(), valid, dummy, sensors, criteria })
}

/// The measures of a side, or why there are none.
type Side = Result<Vec<Measure>, String>;

fn side(path: &Path, request: &Request<'_>) -> Result<(&'static str, Side), Failure> {
    let filtering = match request.treatment.filter {
        Filter::None => Filtering::None,
        _ => Filtering::Classes(request.treatment.family),
    };
    let options = Options { filtering, ..Options::default() };
    if !is_recording(path) {
        let summary = Results::open(path)?.summary_judged(options, ())?;
        return Ok((summary.dummy, Ok(summary.measures)));
    }
    let read = Instruments::of(&measured::read(path)?, request.map, request.seat, request.window.shift_s);
    let measures = read.map(|read| assess(&read.signals, &options)).map_err(|failure| failure.words());
    Ok((options.dummy.name(), measures))
}

fn wanted(protocol: Protocol, dummy: &str) -> Vec<Wanted> {
    if protocol == Protocol::FarSide {
        return HEAD
            .iter()
            .map(|(measure, name, factor, unit, limit)| (*measure, (*name).to_owned(), *factor, *unit, *limit))
            .collect();
    }
    let occupants = Rating::named(FRONTAL_LIMITS).into_iter().flat_map(Rating::occupants);
    let own = occupants.filter(|own| own.dummy.is_some_and(|known| known.name() == dummy)).take(1);
    let criteria =
        own.flat_map(|own| own.regions.iter().flat_map(|region| region.criteria.iter().map(|one| (region.name, one))));
    let limited = criteria.filter_map(|(region, own)| match own.scale {
        Scale::Bands { low, .. } => {
            let found = instrument(region, own.name);
            Some((found.measure.unwrap_or(""), own.name.to_owned(), found.unit.factor, found.unit.symbol, low))
        }
        _ => None,
    });
    limited.collect()
}

impl Sensor {
    /// Whether a pair is of this sensor, and whether its channel stands in for it.
    fn is_of(&self, pair: &RatedPair) -> Option<bool> {
        let (location, dimension) = self.code;
        let has_code = |name: &str| {
            let name = name.trim();
            let belt = location != "SEBE" || name.get(10..12).is_some_and(|point| point.eq_ignore_ascii_case("B3"));
            name.get(2..2 + location.len()).is_some_and(|part| part.eq_ignore_ascii_case(location))
                && name.get(12..14).is_some_and(|part| part.eq_ignore_ascii_case(dimension))
                && belt
        };
        if has_code(&pair.signal) || has_code(&pair.channel) {
            return Some(false);
        }
        let is_channel = pair.channel.starts_with(self.channel) && (location != "SEBE" || is_shoulder(&pair.channel));
        is_channel.then_some(!self.stands_in.is_empty())
    }

    fn score(&self, pairs: &[RatedPair]) -> SensorScore {
        let own: Vec<_> = pairs.iter().filter_map(|pair| Some((pair, self.is_of(pair)?))).collect();
        // the sensor itself before what stands in for it
        let stands_in = own.iter().all(|(_, stands_in)| *stands_in);
        let axes: Vec<_> = own.iter().filter(|(_, other)| *other == stands_in).map(|(pair, _)| *pair).collect();
        let remark = (stands_in && !axes.is_empty() && !self.stands_in.is_empty()).then(|| self.stands_in.to_owned());
        let missing = self.missing(&axes);
        SensorScore { passed: None, ..score(self.name, axes, remark) }.judged(missing)
    }

    /// What is missing: the sensor, or some of its axes.
    fn missing(&self, axes: &[&RatedPair]) -> Option<String> {
        let expected = if self.code.1 == "FO" { 1 } else { 3 };
        match axes.len() {
            0 => Some(format!("missing: no pair of channels `{}…` or {}…{}", self.channel, self.code.0, self.code.1)),
            found if found < expected => Some(format!("{found} of {expected} axes")),
            _ => None,
        }
    }
}

/// Whether a belt is the shoulder part.
fn is_shoulder(channel: &str) -> bool {
    ["torso", "shoulder", "diagonal", "chest"].iter().any(|word| channel.contains(word)) && channel.ends_with(".force")
}

impl SensorScore {
    /// The verdict; none if something is missing.
    fn judged(self, missing: Option<String>) -> Self {
        let passed = self.score.filter(|_| missing.is_none()).map(|score| score >= LEAST_SCORE);
        let remark = match (missing, self.remark.clone()) {
            (Some(missing), Some(known)) => Some(format!("{missing}; {known}")),
            (missing, known) => missing.or(known),
        };
        SensorScore { passed, remark, ..self }
    }
}

/// The score of a sensor from those of its axes.
fn score(name: &str, axes: Vec<&RatedPair>, remark: Option<String>) -> SensorScore {
    let peak = |pair: &RatedPair| pair.rating.largest_computed();
    let sum: f64 = axes.iter().map(|pair| peak(pair)).sum();
    let weight = |pair: &RatedPair| if sum > 0.0 { peak(pair) / sum } else { 1.0 / axes.len() as f64 };
    let scores: Option<Vec<Axis>> = axes
        .iter()
        .map(|pair| {
            let score = pair.rating.score("iso18571", "overall")?;
            Some(Axis { channel: pair.channel.clone(), score, weight: weight(pair) })
        })
        .collect();
    let known = scores.filter(|all| !all.is_empty());
    let score = known.as_ref().map(|all| all.iter().map(|axis| axis.score * axis.weight).sum());
    let remark = if known.is_none() && !axes.is_empty() { Some("an axis cannot be rated".to_owned()) } else { remark };
    let passed = score.map(|score: f64| score >= LEAST_SCORE);
    SensorScore { sensor: name.to_owned(), channels: known.unwrap_or_default(), score, passed, remark }
}

impl Amplitude {
    fn of((measure, criterion, factor, unit, limit): Wanted, measured: &Side, computed: &Side) -> Self {
        let value = |side: &Side, which: &str| match side {
            Err(reason) => Err(format!("{which}: {}", reason.lines().next().unwrap_or_default())),
            Ok(all) => {
                let own = all.iter().find(|own| own.name == measure);
                let value = own.and_then(|own| own.value).filter(|value| value.is_finite());
                value.map(|value| value / factor).ok_or_else(|| {
                    let why = own.and_then(|own| own.remark.clone()).unwrap_or_else(|| "not measured".to_owned());
                    format!("{which}: {why}")
                })
            }
        };
        let (measured, computed) = (value(measured, "test"), value(computed, "computed"));
        let part = |side: &Result<f64, String>| side.as_ref().ok().map(|value| value / limit);
        let (measured_part, computed_part) = (part(&measured), part(&computed));
        let difference = measured_part.zip(computed_part).map(|(a, b)| (a - b).abs());
        let passed = match (measured_part, difference) {
            (Some(part), _) if part < COUNTS_FROM => Some(true),
            (_, difference) => difference.map(|apart| apart < TOO_FAR),
        };
        let small = measured_part
            .filter(|part| *part < COUNTS_FROM)
            .map(|_| "below half of the limit: not compared".to_owned());
        let remark = small.or_else(|| measured.as_ref().err().or(computed.as_ref().err()).cloned());
        let (measured, computed) = (measured.ok(), computed.ok());
        Amplitude {
            criterion,
            unit,
            limit,
            measured,
            computed,
            measured_part,
            computed_part,
            difference,
            passed,
            remark,
        }
    }
}

impl Validation {
    /// Whether the protocol is met; none if something required is missing.
    pub fn is_valid(&self) -> Option<bool> {
        self.valid
    }

    /// The tables that the protocol asks for.
    pub fn text(&self) -> String {
        let verdict = match self.valid {
            Some(true) => "valid",
            Some(false) => "NOT valid",
            None => "open: something required is missing",
        };
        let parts =
            [format!("Model {verdict}\n{}\n", self.source), self.sensor_table(), self.criteria_table(), self.remarks()];
        parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("\n")
    }

    fn sensor_table(&self) -> String {
        let mut table = Table::new(&[
            (Left, &["sensor"]),
            (Right, &["ISO 18571", "at least"]),
            (Left, &[""]),
            (Left, &["axis"]),
            (Right, &["score", "weight"]),
        ]);
        for own in &self.sensors {
            let score = own.score.map_or(NONE.to_owned(), |score| decimals(score, 3));
            let mut left = vec![own.sensor.clone(), score, decimals(LEAST_SCORE, 1), word(own.passed)];
            let axes = own
                .channels
                .iter()
                .map(|axis| vec![axis.channel.clone(), decimals(axis.score, 3), decimals(axis.weight, 3)]);
            let axes: Vec<_> = if own.channels.is_empty() { vec![Vec::new()] } else { axes.collect() };
            for axis in axes {
                table.row(left.into_iter().chain(axis));
                left = vec![String::new(); 4];
            }
        }
        table.text()
    }

    fn criteria_table(&self) -> String {
        let heads = ["test", "computed", "limit"];
        let parts = ["test, %", "computed, %", "apart, %"];
        let mut table =
            Table::new(&[(Left, &["criterion"]), (Right, &heads), (Left, &["unit"]), (Right, &parts), (Left, &[""])]);
        let percent = |part: Option<f64>| part.map_or(NONE.to_owned(), |part| decimals(100.0 * part, 1));
        for own in &self.criteria {
            let value = |value: Option<f64>| value.map_or(NONE.to_owned(), |value| decimals(value, 2));
            table.row([
                own.criterion.clone(),
                value(own.measured),
                value(own.computed),
                number(own.limit),
                own.unit.to_owned(),
                percent(own.measured_part),
                percent(own.computed_part),
                percent(own.difference),
                word(own.passed),
            ]);
        }
        if self.criteria.is_empty() { String::new() } else { table.text() }
    }

    fn remarks(&self) -> String {
        let sensors = self.sensors.iter().filter_map(|own| Some((own.sensor.as_str(), own.remark.as_ref()?)));
        let criteria = self.criteria.iter().filter_map(|own| Some((own.criterion.as_str(), own.remark.as_ref()?)));
        sensors.chain(criteria).map(|(name, remark)| format!("{name}: {remark}\n")).collect()
    }
}

fn word(passed: Option<bool>) -> String {
    match passed {
        Some(true) => "passed",
        Some(false) => "FAILED",
        None => "missing",
    }
    .to_owned()
}
