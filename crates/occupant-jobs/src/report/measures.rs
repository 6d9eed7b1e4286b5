//! The table of measures: injury measures against limits, then the run's summary.

use crash_measures::injury;
use occupant_core::forces::table::{Cell, Holds, Table};
use occupant_core::results::summary::{Caveat, Peak, Person, Summary, word};
use occupant_scenario::kind::UnitSystem;
use occupant_units::unit::{Shown, Unit};
use serde::Serialize;

use super::data::Occupant;
use super::ride_down::RideDown;
use crate::base::Units;

/// A row of the table.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Measure {
    group: &'static str,
    name: String,
    value: Option<f64>,
    unit: String,
    /// Time, s; the start of an interval.
    time_s: Option<f64>,
    /// Largest value allowed, in the same unit.
    limit: Option<f64>,
    /// The dummy of the limit.
    dummy: Option<&'static str>,
    /// The occupant, of several.
    occupant: Option<String>,
    /// The rule that sets the limit.
    rule: Option<String>,
    /// `passed` or `failed`.
    verdict: Option<&'static str>,
    /// Reason for a missing value, or a remark.
    remark: Option<String>,
    /// Indices of the caveats that apply to it.
    caveats: Vec<usize>,
    /// Name used by caveats.
    #[serde(skip)]
    figure: String,
}

impl Measure {
    fn new(group: &'static str, name: impl Into<String>, figure: impl Into<String>, unit: Shown) -> Self {
        Measure { group, name: name.into(), figure: figure.into(), unit: unit.symbol(), ..Measure::default() }
    }

    /// The row with its caveats.
    fn judged(self, caveats: &[Caveat]) -> Self {
        let touching = || {
            caveats
                .iter()
                .filter(|caveat| !caveat.is_note())
                .enumerate()
                .filter(|(_, caveat)| caveat.touches(&self.figure))
        };
        // a part of a run fails, but does not pass
        let is_part = touching().any(|(_, caveat)| caveat.name == Caveat::PART);
        let verdict = self.verdict.filter(|verdict| !is_part || *verdict == "failed");
        Measure { caveats: touching().map(|(place, _)| place).collect(), verdict, ..self }
    }
}

/// All rows, by group.
pub fn measures(summary: &Summary, ride: &RideDown, occupants: &[Occupant], units: Units) -> Vec<Measure> {
    let own = |((prefix, person), occupant): ((String, Person), &Occupant)| {
        let rows: Vec<_> = person.measures.iter().flat_map(|m| injury_rows(m, units)).collect();
        let (judged, dummy) = (occupant.judged, occupant.dummy);
        rows.into_iter().map(move |row| Measure {
            verdict: row.verdict.filter(|_| judged),
            dummy: row.limit.map(|_| dummy),
            name: format!("{prefix}{}", row.name),
            figure: format!("{prefix}{}", row.figure),
            ..row
        })
    };
    let mut rows: Vec<_> = summary.people().into_iter().zip(occupants).flat_map(own).collect();
    add_loads(&mut rows, summary, units);
    add_excursion(&mut rows, summary, units);
    add_ejections(&mut rows, summary);
    add_throws(&mut rows, summary, units);
    add_ride_down(&mut rows, ride, units);
    let energy = &summary.energy;
    let group = "Energy";
    let mut add = |name: &str, figure: &str, value: f64, unit| {
        rows.push(Measure { value: Some(value), ..Measure::new(group, name, figure, unit) });
    };
    let percent = Unit::One.shown_in("%");
    let imbalance = format!("Largest energy imbalance, of the {}", energy.reference);
    add(&imbalance, "energy.balance_error", 100.0 * energy.balance_error, percent);
    let kinetic = "Largest kinetic energy, relative to the vehicle";
    let joule = engineering(Unit::Joule, units);
    add(kinetic, "energy.greatest_kinetic", energy.greatest_kinetic_j * joule.per_si(), joule);
    let whose = |row: Measure| {
        let occupant = Occupant::owner(occupants, &row.name).map(|one| one.name.clone());
        Measure { occupant, ..row }
    };
    rows.into_iter().map(|row| whose(row.judged(&summary.caveats))).collect()
}

/// A row per limit of an injury measure, or one without.
fn injury_rows(m: &injury::Measure, units: Units) -> Vec<Measure> {
    let unit = engineering(m.unit, units);
    let first = Measure {
        value: m.value.map(|v| v * unit.per_si()),
        time_s: m.from_s,
        remark: m.remark.clone(),
        ..Measure::new("Injury measures, unfiltered", m.label, m.figure.unwrap_or(m.name), unit)
    };
    if m.limits.is_empty() {
        return vec![first];
    }
    let row = |judgement: &injury::Judgement| Measure {
        limit: Some(judgement.most * unit.per_si()),
        rule: Some(if judgement.quoted {
            judgement.rule.to_owned()
        } else {
            format!("{}, as generally known", judgement.rule)
        }),
        verdict: Some(if judgement.passed { "passed" } else { "failed" }),
        ..first.clone()
    };
    m.limits.iter().map(row).collect()
}

/// Engineering unit of a quantity.
fn engineering(unit: Unit, units: Units) -> Shown {
    match unit {
        _ if units.system == UnitSystem::InchPound => unit.shown_to_people(true),
        Unit::MetrePerSecondSquared => unit.shown_in("g"),
        Unit::Newton => unit.shown_in("kN"),
        other => other.shown(),
    }
}

fn add_loads(rows: &mut Vec<Measure>, summary: &Summary, units: Units) {
    rows.extend(summary.elements.iter().flat_map(|(of, table)| element_rows(of, table, units)));
    rows.extend(summary.sphere_forces.iter().map(|s| {
        let figure = format!("contacts.{}.peak", word(&s.sphere));
        load(format!("{} against {}", s.sphere, s.surface), figure, Some(s.force_n), Some(s.time_s), units)
    }));
}

/// The row of a force.
fn load(name: String, figure: String, force_n: Option<f64>, time_s: Option<f64>, units: Units) -> Measure {
    let unit = engineering(Unit::Newton, units);
    let value = force_n.map(|force_n| force_n / unit.si);
    Measure { value, time_s, ..Measure::new("Loads", name, figure, unit) }
}

/// Peaks of force elements with a time: `Belt lap, loop force`, `Joint neck, stop moment`.
fn element_rows(list: &str, table: &Table, units: Units) -> impl Iterator<Item = Measure> {
    let of = table.columns[0].heading;
    let of = of[..1].to_uppercase() + &of[1..];
    let peaks = table.columns.windows(2).filter(|both| both[1].holds == Holds::Time);
    let all = peaks.flat_map(|peak| table.rows.iter().map(move |row| (&peak[0], &peak[1], row)));
    all.filter_map(move |(peak, time, row)| {
        let time_s = row[time.key].number()?;
        let (what, unit) = peak.heading.rsplit_once(", ").unwrap_or((peak.heading, ""));
        let element = row.values().next().and_then(Cell::text).unwrap_or_default();
        let name = format!("{of} {element}, {what}");
        let figure = format!("{list}.{}.{}", word(element), peak.measure.map_or(peak.key, |(measure, _)| measure));
        let value = row[peak.key].number();
        if unit == "N" {
            return Some(load(name, figure, value, Some(time_s), units));
        }
        let (per, unit) = units.over(unit);
        let own = Measure::new("Loads", name, figure, Unit::One.shown());
        Some(Measure { value: value.map(|x| x * peak.scale / per), time_s: Some(time_s), unit, ..own })
    })
}

fn add_ride_down(rows: &mut Vec<Measure>, ride: &RideDown, units: Units) {
    let group = "Ride-down and work";
    let (length, joule) =
        (Unit::Metre.shown_to_people(units.system == UnitSystem::InchPound), engineering(Unit::Joule, units));
    let mut add = |name: String, figure: String, value: f64, unit: Shown, remark: Option<&str>| {
        let remark = remark.map(str::to_owned);
        rows.push(Measure { value: Some(value * unit.per_si()), remark, ..Measure::new(group, name, figure, unit) });
    };
    for stopped in ride.stopped() {
        let (part, figure) = (&stopped.part, |what: &str| format!("ride_down.{}.{what}", word(&stopped.part)));
        let remark = "travel of the vehicle while the part decelerates: from a loss of 2 % of its speed to its largest forward excursion. Added to the excursion in the vehicle, it is the stopping distance";
        add(format!("{part}, ride-down distance"), figure("distance"), stopped.ride_down_m, length, Some(remark));
        add(format!("{part}, forward travel in the vehicle"), figure("in_vehicle"), stopped.in_vehicle_m, length, None);
    }
    if let Some(share) = ride.share() {
        let remark = "work of the body on the moving vehicle, as a fraction of its initial kinetic energy";
        add(
            "Kinetic energy ridden down".to_owned(),
            "ride_down.share".to_owned(),
            share,
            Unit::One.shown_in("%"),
            Some(remark),
        );
    }
    for (name, work_j) in ride.works_j() {
        add(format!("Energy absorbed by {name}"), format!("work.{}", word(&name)), work_j, joule, None);
    }
}

/// Verdict for each occupant who left the compartment, with the part, place and time.
fn add_ejections(rows: &mut Vec<Measure>, summary: &Summary) {
    let group = "Ejection";
    for (name, ejection) in &summary.ejections {
        let prefix = if name.is_empty() { String::new() } else { format!("{name}.") };
        let (verdict, at_s) = match ejection.complete_s {
            Some(complete_s) => ("complete: the whole body outside at one time", Some(complete_s)),
            None => ("partial", ejection.parts.first().map(|exit| exit.time_s)),
        };
        let (figure, unit) = (format!("{prefix}ejection.parts"), Unit::One.shown());
        let row = |name: String| Measure::new(group, name, figure.clone(), unit);
        let count = Some(ejection.parts.len() as f64);
        rows.push(Measure {
            value: count,
            time_s: at_s,
            ..row(format!("{prefix}ejection, {verdict}; parts that left"))
        });
        rows.extend(ejection.parts.iter().map(|exit| {
            let past = exit.past.as_ref().map_or(String::new(), |past| format!(", past {past}"));
            let words = format!("{} leaves {}{past}", exit.part.replace('_', " "), exit.side.words());
            Measure { time_s: Some(exit.time_s), ..row(words) }
        }));
    }
}

/// Distances and speeds of thrown bodies, with Searle's bounds.
fn add_throws(rows: &mut Vec<Measure>, summary: &Summary, units: Units) {
    let is_inch_pound = units.system == UnitSystem::InchPound;
    // ways of metres
    let shown = |unit: Unit| if is_inch_pound { unit.shown_to_people(true) } else { unit.shown() };
    for (name, throw) in &summary.throws {
        let prefix = if name.is_empty() { String::new() } else { format!("{name}.") };
        let mut add =
            |name: &str, figure: &str, value: Option<f64>, unit: Shown, time_s: Option<f64>, remark: Option<String>| {
                let Some(value) = value else { return };
                let own = Measure::new("Throw", format!("{prefix}{name}"), format!("{prefix}throw.{figure}"), unit);
                rows.push(Measure { value: Some(value * unit.per_si()), time_s, remark, ..own });
            };
        let (m, m_s) = (shown(Unit::Metre), shown(Unit::MetrePerSecond));
        let (launch, landing) = (throw.launch.as_ref(), throw.landing.as_ref());
        let so_far = (!throw.at_rest).then(|| "so far: the body still moves at the end of the run".to_owned());
        add("throw distance", "distance", Some(throw.distance_m), m, Some(throw.struck_s), so_far);
        let at_s = launch.map(|l| l.time_s);
        add("launch, speed", "launch_speed", launch.map(|l| l.speed_m_s), m_s, at_s, None);
        let angle = launch.map(|l| l.angle_deg.to_radians());
        add(
            "launch, angle above the horizontal",
            "launch_angle",
            angle,
            Unit::Radian.shown_to_people(false),
            at_s,
            None,
        );
        let touched = landing.map(|l| format!("{} first", l.sphere));
        let at_s = landing.map(|l| l.time_s);
        add("landing, speed", "landing_speed", landing.map(|l| l.speed_m_s), m_s, at_s, touched);
        add("airborne", "airborne_distance", throw.airborne_m, m, None, None);
        add("sliding", "slide_distance", throw.slide_m, m, None, None);
        add("greatest height gained", "height", Some(throw.height_m), m, None, None);
        let Some(searle) = &throw.searle else { continue };
        let friction = format!(
            "from the throw distance, with friction {:.2} and a fall of {:.2} m",
            searle.friction, searle.fall_m
        );
        add("Searle, least speed", "searle_least_speed", Some(searle.speeds_m_s[0]), m_s, None, None);
        add("Searle, greatest speed", "searle_greatest_speed", Some(searle.speeds_m_s[1]), m_s, None, Some(friction));
        let drag = searle.drag_factor.map(|drag| {
            format!("the run went {:.2} m: a drag factor of {drag:.2}", throw.from_launch_m.unwrap_or(f64::NAN))
        });
        add("Searle, least distance at the launch speed", "from_launch", Some(searle.distances_m[0]), m, None, None);
        add("Searle, greatest distance at the launch speed", "from_launch", Some(searle.distances_m[1]), m, None, drag);
    }
}

fn add_excursion(rows: &mut Vec<Measure>, summary: &Summary, units: Units) {
    let is_inch_pound = units.system == UnitSystem::InchPound;
    for (prefix, Person { head_excursion, .. }) in summary.people() {
        for (way, Peak { value, time_s }) in head_excursion.iter().flat_map(|e| e.ways()) {
            let (group, unit) = ("Head excursion in the vehicle", Unit::Metre.shown_to_people(is_inch_pound));
            let figure = format!("{prefix}head_excursion.{way}");
            let (value, time_s) = (Some(value * unit.per_si()), Some(time_s));
            rows.push(Measure { value, time_s, ..Measure::new(group, format!("{prefix}{way}"), figure, unit) });
        }
    }
}
