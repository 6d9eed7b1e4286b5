//! Reports of event data recorders as they are: preambles, several tables, words beside numbers.
//!
//! A report is split into its tables ([`grid`]); each is read as any table is, signal by signal. Lines of words give belts, firing times
//! and signs ([`facts`]); the pulse is checked against them ([`pulse`]). What the report leaves open is asked for.

mod facts;
mod grid;
mod pulse;
mod words;

use std::path::Path;

use occupant_scenario::{column_named, folded, speed_named};
use occupant_units::unit::Unit;
use placed_text::{is_missing, number};

use super::table;
use crate::base::Failure;
use crate::signals::{Recording, Signal, scale_of};
use crate::trouble::Trouble;
use facts::{Facts, Said, contradiction};
use grid::{Grid, Table, column_of, number_and_unit, parts, second, second_unit};
use pulse::{Heading, Pulse};
use words::has;

pub use facts::Fired;

/// How velocity changes are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DeltaV {
    /// Since time zero.
    Cumulative,
    /// Since the row before.
    Interval,
}

/// Names of [`DeltaV`], with their meaning.
pub const DELTA_V: [(&str, &str, DeltaV); 2] = [
    ("cumulative", "Each row is the change since time zero", DeltaV::Cumulative),
    ("interval", "Each row is the change since the row before", DeltaV::Interval),
];

/// Sides of a vehicle, with the sign of the velocity change along x and y.
pub const SIDES: [(&str, &str, [i8; 2]); 4] = [
    ("front", "It loses speed", [-1, 0]),
    ("rear", "It gains speed", [1, 0]),
    ("left", "It is pushed to the right", [0, 1]),
    ("right", "It is pushed to the left", [0, -1]),
];

/// What a user says about a report.
#[derive(Clone, Copy, Debug, Default)]
pub struct Hints<'a> {
    /// The event, if there are several.
    pub event: Option<&'a str>,
    /// Signs of the velocity change along x and y; 0 if unknown.
    pub struck: Option<[i8; 2]>,
    /// How velocity changes are given.
    pub delta_v: Option<DeltaV>,
    /// Speed at impact, m/s.
    pub speed_m_s: Option<f64>,
}

/// What a report says about the occupant and the start of the crash.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// Speed at impact, m/s, with the line that says it.
    pub speed_m_s: Option<(f64, usize)>,
    /// Whether the driver's belt was fastened.
    pub belt: Option<(bool, usize)>,
    /// The driver's front bag.
    pub bag: Option<(Fired, usize)>,
    /// The driver's pretensioner.
    pub pretensioner: Option<(Fired, usize)>,
}

/// Reads a report; none if the text has no crash pulse with headings.
///
/// # Errors
/// Contradictions, questions that only the user can answer, problems of its tables.
pub(super) fn read(
    path: &Path,
    text: &str,
    hints: Hints,
    sha256: &str,
) -> Result<Option<(Recording, Report)>, Failure> {
    let Some(grid) = Grid::of(text) else { return Ok(None) };
    let tables: Vec<Known> = grid.tables.iter().map(Known::of).collect();
    tables.iter().try_for_each(|known| known.check_units(path))?;
    if !tables.iter().any(Known::is_pulse) {
        return Ok(None);
    }
    let (all, events) = facts::read(&grid);
    let event = chosen(path, &tables, &events, hints.event)?;
    let facts = Facts::of(path, &all, event.as_deref())?;
    let is_own = |own: &Option<String>| own.is_none() || event.is_none() || *own == event;
    let mine: Vec<&Known> = tables.iter().zip(&events).filter(|(_, own)| is_own(own)).map(|(table, _)| table).collect();
    check_speeds_of_other_events(path, &tables, &events, event.as_deref(), hints)?;
    let mut recording =
        Recording { path: path.to_owned(), sha256: sha256.to_owned(), signals: Vec::new(), notes: Vec::new() };
    let mut headings = Vec::new();
    let is_plain = grid.words.is_empty() && grid.tables.len() == 1 && tables[0].is_plain();
    for known in mine.iter().filter(|known| known.is_pulse() || known.has("v")) {
        let own = if is_plain { text.to_owned() } else { known.text(path, &mut recording.notes)? };
        let read = table::read(path, &own, None, sha256.to_owned())?;
        recording.notes.extend(read.notes);
        headings.extend(known.headings());
        add(path, &mut recording, read.signals)?;
    }
    if let Some(event) = &event {
        recording.notes.push(format!("the event is {event}"));
        let mut others: Vec<&String> =
            all.iter().filter_map(|fact| fact.event.as_ref()).chain(events.iter().flatten()).collect();
        others.retain(|other| *other != event);
        others.sort();
        others.dedup();
        recording.notes.extend((!others.is_empty()).then(|| {
            format!(
                "what belongs to other events is left out: {}",
                others.iter().map(|o| o.as_str()).collect::<Vec<_>>().join(", ")
            )
        }));
    }
    let table_speed = recorded_speed(&recording);
    let speed = settled_speed(path, &facts, table_speed.as_ref(), hints)?;
    let at = table_speed.as_ref().filter(|(_, t_s, _)| facts.is_braked && *t_s < -0.05 && facts.speed_m_s.is_none());
    if let Some((_, t_s, _)) = at {
        recording.notes.push(format!(
            "the brake was on: after {} s the vehicle may have lost up to {} km/h more before the impact",
            number(*t_s),
            number((-t_s * 0.8 * 35.3).round())
        ));
    }
    Pulse { path, facts: &facts, hints, headings: &headings, speed }.settle(&mut recording)?;
    recording.notes.extend(facts.notes.iter().cloned());
    recording.notes.extend(devices(&facts, !grid.words.is_empty()));
    recording.notes.extend(passenger(facts.passenger_belt));
    recording.notes.extend(unused(&mine));
    let report =
        Report { speed_m_s: facts.speed_m_s, belt: facts.belt, bag: facts.bag, pretensioner: facts.pretensioner };
    Ok(Some((recording, report)))
}

/// Speed recorded before the crash: its name, and the last value at or before time zero, s and m/s.
pub fn recorded_speed(recording: &Recording) -> Option<(String, f64, f64)> {
    let speed = Unit::MetrePerSecond.dimension();
    let is_speed = |signal: &&Signal| speed_named(&signal.name) && signal.scale.is_some_and(|s| s.dimension == speed);
    let signal = recording.signals.iter().find(is_speed)?;
    let mut told = signal.time_s.iter().zip(&signal.values).filter(|(t, v)| **t <= 0.0 && v.is_finite());
    let (t_s, value) = told.next_back()?;
    Some((signal.name.clone(), *t_s, value * signal.scale?.factor))
}

/// The event whose tables are read: the only one with a pulse, or the one that was asked for.
fn chosen(
    path: &Path,
    tables: &[Known],
    events: &[Option<String>],
    asked: Option<&str>,
) -> Result<Option<String>, Failure> {
    let mut with_pulse: Vec<&String> = Vec::new();
    for (_, event) in tables.iter().zip(events).filter(|(table, _)| table.is_pulse()) {
        with_pulse.extend(event.as_ref().filter(|event| !with_pulse.contains(event)));
    }
    let names = || with_pulse.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    if let Some(asked) = asked {
        let found = with_pulse.iter().find(|event| event.eq_ignore_ascii_case(asked.trim()));
        return match found {
            Some(event) => Ok(Some((*event).clone())),
            None => {
                let expected = if with_pulse.is_empty() {
                    "no --event: the report names none".to_owned()
                } else {
                    format!("one of {}", names())
                };
                Err(Trouble::of(path, format!("no crash pulse of an event `{asked}`"), expected).into())
            }
        };
    }
    match with_pulse[..] {
        [] => Ok(None),
        [event] => Ok(Some(event.clone())),
        _ => {
            let told = tables
                .iter()
                .zip(events)
                .filter_map(|(table, event)| Some(format!("{}: {}", event.as_ref()?, table.most()?)));
            let told: Vec<String> = told.collect();
            Err(Trouble::of(
                path,
                format!("crash pulses of {} events ({})", with_pulse.len(), told.join("; ")),
                "one event",
            )
            .hint(format!("choose one with --event: {}", names()))
            .into())
        }
    }
}

/// Refuses a pre-crash table that belongs only to another event than the pulse.
fn check_speeds_of_other_events(
    path: &Path,
    tables: &[Known],
    events: &[Option<String>],
    event: Option<&str>,
    hints: Hints,
) -> Result<(), Failure> {
    let Some(event) = event.filter(|_| hints.event.is_none()) else { return Ok(()) };
    let speeds = || tables.iter().zip(events).filter(|(table, _)| table.has("v"));
    let other = speeds().find(|(_, own)| own.as_deref().is_some_and(|own| own != event));
    let has_own = speeds().any(|(_, own)| own.as_deref().is_none_or(|own| own == event));
    match other.filter(|_| !has_own) {
        Some((table, Some(own))) => Err(contradiction(
            path,
            table.table.line,
            &format!("the speeds are those of event {own}, the crash pulse is that of event {event}"),
        )
        .hint(format!("--event '{event}' takes the pulse without the speeds; give the speed with --speed"))
        .into()),
        _ => Ok(()),
    }
}

/// Adds signals of a table; a quantity that another column or table gave must agree.
fn add(path: &Path, recording: &mut Recording, signals: Vec<Signal>) -> Result<(), Failure> {
    for signal in signals {
        let column = column_of(&written(&signal));
        let same = recording.signals.iter().find(|other| column.is_some() && column_of(&written(other)) == column);
        match same {
            None => recording.signals.push(signal),
            Some(other) if agree(&signal, other) => recording.notes.push(format!(
                "`{}` is given again as `{}` with the same values: the second is left out",
                written(other),
                written(&signal)
            )),
            // two sensors, or two filters: the reader of motion says which it takes
            Some(other) if signal.name != other.name && !speed_named(&signal.name) => recording.signals.push(signal),
            Some(other) => {
                let found = format!(
                    "`{}` at {} has other values than `{}` at {}",
                    written(&signal),
                    signal.place,
                    written(other),
                    other.place
                );
                return Err(contradiction(path, 1, &found)
                    .hint("delete one of the two, or choose an event with --event")
                    .into());
            }
        }
    }
    Ok(())
}

/// Name and unit of a signal.
fn written(signal: &Signal) -> String {
    signal.unit.as_ref().map_or_else(|| signal.name.clone(), |unit| format!("{} [{unit}]", signal.name))
}

/// Whether two signals are one within their rounding.
fn agree(a: &Signal, b: &Signal) -> bool {
    let of = |signal: &Signal| signal.scale.map_or(1.0, |scale| scale.factor);
    let least = 1.05 * of(a).max(of(b));
    let near = |(x, y): (&f64, &f64)| {
        let (x, y) = (x * of(a), y * of(b));
        x.is_nan() || y.is_nan() || (x - y).abs() <= least.min(0.5) + 0.02 * x.abs()
    };
    a.time_s == b.time_s && a.values.iter().zip(&b.values).all(near)
}

/// The speed for checks, m/s, with its words: as given, as told for the impact, or the last before it.
fn settled_speed(
    path: &Path,
    facts: &Facts,
    table: Option<&(String, f64, f64)>,
    hints: Hints,
) -> Result<Option<(f64, String)>, Failure> {
    let of_table = table.map(|(name, t_s, speed)| (*speed, format!("{name} at {} s", number(*t_s))));
    if let (Some((told, line)), Some((name, t_s, speed))) = (facts.speed_m_s, table) {
        // it may brake or speed up in between
        let most = 1.5 + 0.1 * speed.abs() - t_s * 10.0;
        if (told - speed).abs() > most && hints.speed_m_s.is_none() {
            let found = format!(
                "the speed at impact is {} km/h here, and {name} {} km/h at {} s",
                number((told * 36.0).round() / 10.0),
                number((speed * 36.0).round() / 10.0),
                number(*t_s)
            );
            return Err(contradiction(path, line, &found).hint("give the speed at impact with --speed").into());
        }
    }
    let given = hints.speed_m_s.map(|speed| (speed, "--speed".to_owned()));
    let told = facts.speed_m_s.map(|(speed, line)| (speed, format!("the speed at impact (line {line})")));
    Ok(given.or(told).or(of_table))
}

/// What is known of belt, bag and pretensioner, in words.
fn devices(facts: &Facts, is_report: bool) -> Vec<String> {
    let fired = |what: &str, said: Said<Fired>| {
        let (fired, line) = said?;
        Some(match fired {
            Fired::At(time_s) => format!("{what} fired at {} ms (line {line})", number((time_s * 1e6).round() / 1e3)),
            Fired::Yes => {
                format!("{what} fired at an unknown time (line {line}): the trigger of the car's class is kept")
            }
            Fired::No => format!("{what} did not fire (line {line})"),
        })
    };
    let belt = match facts.belt {
        Some((worn, line)) => Some(format!("the driver's belt was {} (line {line})", facts::worn_words(worn))),
        None => is_report
            .then(|| "the report does not say whether the driver's belt was fastened: it is assumed so".to_owned()),
    };
    [belt, fired("the driver's front bag", facts.bag), fired("the driver's pretensioner", facts.pretensioner)]
        .into_iter()
        .flatten()
        .collect()
}

/// Beside a table of the user's own columns: what the rest of the report says.
///
/// # Errors
/// As [`read`].
pub(super) fn beside(path: &Path, text: &str, hints: Hints, sha256: &str) -> Result<Report, Failure> {
    let Some(grid) = Grid::of(text) else { return Ok(Report::default()) };
    let (all, events) = facts::read(&grid);
    let facts = Facts::of(path, &all, hints.event)?;
    let mut speed_m_s = facts.speed_m_s;
    for (table, event) in grid.tables.iter().zip(&events) {
        let known = Known::of(table);
        let is_own = hints.event.is_none() || event.is_none() || event.as_deref() == hints.event;
        if speed_m_s.is_none() && is_own && known.has("v") && !known.is_pulse() {
            let own = table::read(path, &known.text(path, &mut Vec::new())?, None, sha256.to_owned())?;
            speed_m_s = recorded_speed(&own).map(|(_, _, speed)| (speed, table.line));
        }
    }
    Ok(Report { speed_m_s, belt: facts.belt, bag: facts.bag, pretensioner: facts.pretensioner })
}

fn passenger(belt: Said<bool>) -> Option<String> {
    let (worn, line) = belt?;
    Some(format!(
        "the passenger's belt was {} (line {line}); the scenario has a driver only",
        if worn { "fastened" } else { "not fastened" }
    ))
}

/// Columns of words that are used nowhere.
fn unused(tables: &[&Known]) -> Option<String> {
    let is_used = |head: &str| {
        let head = folded(head);
        [words::BELT, words::BAG, words::PRETENSIONER, words::BRAKE].iter().any(|stems| has(&head, stems))
    };
    let words = |known: &&Known| -> Vec<String> {
        let heads = known.table.heads.iter().enumerate();
        heads
            .filter(|(i, head)| known.is_words[*i] && !head.is_empty() && !is_used(head))
            .map(|(_, head)| format!("`{head}`"))
            .collect()
    };
    let all: Vec<String> = tables.iter().flat_map(words).collect();
    (!all.is_empty()).then(|| format!("columns of words that are not used: {}", all.join(", ")))
}

/// A table and the columns that it has.
struct Known<'a> {
    table: &'a Table,
    columns: Vec<Option<&'static str>>,
    names: Vec<Plain>,
    is_words: Vec<bool>,
    time: usize,
}

/// A heading without words of sign and kind.
#[derive(Clone, Debug)]
struct Plain {
    name: String,
    unit: Option<String>,
    is_loss: bool,
    told: Option<DeltaV>,
}

impl<'a> Known<'a> {
    fn of(table: &'a Table) -> Self {
        let names: Vec<Plain> = table.heads.iter().enumerate().map(|(i, head)| plain(head, table, i)).collect();
        let whole = |plain: &Plain| {
            plain.unit.as_ref().map_or_else(|| plain.name.clone(), |unit| format!("{} [{unit}]", plain.name))
        };
        let columns: Vec<_> = names.iter().map(|plain| column_of(&whole(plain))).collect();
        let time = columns.iter().position(|column| *column == Some("t")).unwrap_or(0);
        let is_words = (0..names.len()).map(|i| i != time && is_of_words(table, i)).collect();
        Known { table, columns, names, is_words, time }
    }

    /// Refuses a quantity in a unit of another.
    fn check_units(&self, path: &Path) -> Result<(), Trouble> {
        for (plain, _) in self.names.iter().zip(&self.columns).filter(|(_, column)| column.is_none()) {
            let named = column_named(&plain.name).filter(|name| ["dvx", "dvy", "ax", "ay", "az", "a"].contains(name));
            let expected = match named {
                Some("dvx" | "dvy") => "a unit of velocity, such as km/h or mph",
                Some(_) => "a unit of acceleration, such as g or m/s^2",
                None if speed_named(&plain.name) => "a unit of velocity, such as km/h or mph",
                None => continue,
            };
            let is_other = |unit: &&String| scale_of(unit).is_some_and(|scale| scale.dimension != Default::default());
            if let Some(unit) = plain.unit.as_ref().filter(is_other) {
                let found = format!("`{unit}` as the unit of `{}`", plain.name);
                return Err(Trouble::at(path, self.table.line, found, expected)
                    .hint("correct the heading, or name all columns with their units with --columns"));
            }
        }
        Ok(())
    }

    fn has(&self, name: &str) -> bool {
        self.columns.contains(&Some(name))
    }

    fn is_pulse(&self) -> bool {
        ["dvx", "dvy", "ax", "ay"].iter().any(|name| self.has(name))
    }

    /// Whether it can be read as it stands.
    fn is_plain(&self) -> bool {
        let times: Vec<Option<f64>> = self.times();
        let is_whole = self.table.rows.iter().all(|(_, cells)| cells.len() == self.table.heads.len());
        let is_usual = |plain: &Plain| !plain.is_loss && plain.told.is_none();
        let is_bare =
            |cell: &String| !cell.starts_with('(') && number_and_unit(cell).is_none_or(|(_, rest)| rest.is_empty());
        let has_slash = |head: &String| head.contains('/') && placed_text::name_and_unit(head).1.is_none();
        is_whole
            && self.table.rows.iter().all(|(_, cells)| cells.iter().all(is_bare))
            && !self.table.heads.iter().any(has_slash)
            && times.iter().all(Option::is_some)
            && times.windows(2).all(|pair| pair[0] < pair[1])
            && self.names.iter().all(is_usual)
            && !self.is_words.contains(&true)
            && self.table.heads.iter().all(|head| second_unit(head).is_none())
            && self
                .names
                .iter()
                .zip(&self.table.heads)
                .all(|(plain, head)| plain.unit.is_none() || parts(head).1.is_some())
    }

    fn times(&self) -> Vec<Option<f64>> {
        self.table.rows.iter().map(|(_, cells)| cells.get(self.time).and_then(|cell| grid::number(cell))).collect()
    }

    fn headings(&self) -> Vec<Heading> {
        let heading = |plain: &Plain| Heading {
            name: plain.name.clone(),
            line: self.table.line,
            is_loss: plain.is_loss,
            told: plain.told,
        };
        self.names.iter().map(heading).collect()
    }

    /// The largest velocity change, in words.
    fn most(&self) -> Option<String> {
        let i = self.columns.iter().position(|column| matches!(column, Some("dvx" | "ax" | "dvy" | "ay")))?;
        let values = self.table.rows.iter().filter_map(|(_, cells)| grid::number(cells.get(i)?));
        let most = values.fold(0.0_f64, |most, v| if v.abs() > most.abs() { v } else { most });
        Some(format!("{} up to {}", self.table.heads[i], number(most)))
    }

    /// The table as a text with tabs, its lines where they were.
    fn text(&self, path: &Path, notes: &mut Vec<String>) -> Result<String, Failure> {
        let rows = self.rows(path, notes)?;
        let mut text = String::new();
        let mut line = 1;
        let mut put = |at: usize, cells: Vec<String>, text: &mut String| {
            while line < at {
                *text += "\n";
                line += 1;
            }
            *text += &cells.join("\t");
            *text += "\n";
            line += 1;
        };
        let head = |i: usize| match (&self.names[i], self.is_words[i]) {
            (_, true) => "-".to_owned(),
            (Plain { name, unit: Some(unit), .. }, _) => format!("{name} [{unit}]"),
            (Plain { name, .. }, _) => name.clone(),
        };
        let order: Vec<usize> =
            (0..self.names.len()).filter(|i| *i == self.time || !self.names[*i].name.is_empty()).collect();
        put(self.table.line, order.iter().map(|i| head(*i)).collect(), &mut text);
        for (at, cells) in rows {
            put(at, order.iter().map(|i| cells[*i].clone()).collect(), &mut text);
        }
        Ok(text)
    }

    /// Rows of numbers in the order of their times.
    fn rows(&self, path: &Path, notes: &mut Vec<String>) -> Result<Vec<(usize, Vec<String>)>, Failure> {
        let width = self.names.len();
        let mut rows: Vec<(usize, f64, Vec<String>)> = Vec::new();
        let mut times = self.times();
        let fall = times.windows(2).filter(|pair| pair[1] < pair[0]).count();
        let is_backwards = fall > 0 && fall + 1 >= times.len();
        let title =
            format!("{} {}", self.table.title, folded(&self.table.heads.get(self.time).cloned().unwrap_or_default()));
        let is_before = times.iter().flatten().all(|t| *t >= 0.0)
            && self.has("v")
            && !self.is_pulse()
            && (has(&folded(&self.table.heads[self.time]), words::BEFORE)
                || is_backwards && has(&title, words::PRE_CRASH));
        if is_before {
            times.iter_mut().flatten().for_each(|t| *t = 0.0 - *t);
            notes.push(format!("the times of line {} count back from the crash: taken as negative", self.table.line));
        }
        for ((line, cells), time) in self.table.rows.iter().zip(fill_times(&times, &self.table.rows, notes)) {
            let mut cells: Vec<String> = (0..width)
                .map(|i| self.cell(path, *line, cells.get(i).map_or("", String::as_str), i))
                .collect::<Result<_, _>>()?;
            let Some(time) = time else { continue };
            cells[self.time] = format!("{time}");
            rows.push((*line, time, cells));
        }
        if rows.windows(2).filter(|pair| pair[1].1 < pair[0].1).count() + 1 == rows.len() {
            let lines: Vec<usize> = rows.iter().map(|row| row.0).collect();
            rows.reverse();
            rows.iter_mut().zip(lines).for_each(|(row, line)| row.0 = line);
        }
        self.without_repeats(path, rows, notes)
    }

    /// A cell as the reader of tables takes it.
    fn cell(&self, path: &Path, line: usize, cell: &str, column: usize) -> Result<String, Failure> {
        if self.is_words[column] {
            return Ok("N/A".to_owned());
        }
        let Some((value, rest)) = number_and_unit(cell) else {
            let is_known = is_missing(cell) || words::state(cell).is_some() || cell.chars().all(|c| "*-. ".contains(c));
            let is_word = !cell.contains(|c: char| c.is_ascii_digit());
            return if is_known || is_word { Ok("N/A".to_owned()) } else { Ok(cell.to_owned()) };
        };
        let own = scale_of(rest.trim_matches(['[', ']', '(', ')']))
            .filter(|_| !rest.is_empty() && !rest.starts_with(['[', '(']));
        let unit = self.names[column].unit.as_deref().and_then(scale_of);
        if own.zip(unit).is_some_and(|(own, unit)| own != unit) {
            let found = format!("`{cell}` under `{}`", self.table.heads[column]);
            return Err(Trouble::at(path, line, found, "the unit of the heading").into());
        }
        let other = second_unit(&self.table.heads[column]).and_then(|unit| scale_of(&unit));
        if let (Some(second), Some(unit), Some(other)) = (second(cell), unit, other) {
            let (a, b) = (value * unit.factor, second * other.factor);
            if (a - b).abs() > unit.factor.max(other.factor) * 1.05 + 0.01 * a.abs() {
                return Err(contradiction(
                    path,
                    line,
                    &format!("`{cell}` under `{}`: the two units disagree", self.table.heads[column]),
                )
                .hint("delete one of the two")
                .into());
            }
        }
        Ok(format!("{value}"))
    }

    /// Rows without those that repeat a time; other values at one time are an error.
    fn without_repeats(
        &self,
        path: &Path,
        rows: Vec<(usize, f64, Vec<String>)>,
        notes: &mut Vec<String>,
    ) -> Result<Vec<(usize, Vec<String>)>, Failure> {
        let mut kept: Vec<(usize, f64, Vec<String>)> = Vec::new();
        let mut repeated = Vec::new();
        for (line, time, cells) in rows {
            match kept.last_mut().filter(|(_, before, _)| *before == time) {
                None => kept.push((line, time, cells)),
                Some((first, _, own)) => {
                    let differs = |(a, b): (&String, &String)| a != b && !is_missing(a) && !is_missing(b);
                    if own.iter().zip(&cells).any(differs) {
                        return Err(contradiction(
                            path,
                            line,
                            &format!("the time {} has other values here than in line {first}", number(time)),
                        )
                        .hint("delete the wrong row, or correct its time")
                        .into());
                    }
                    // each may have what the other lacks
                    own.iter_mut().zip(cells).filter(|(a, _)| is_missing(a)).for_each(|(a, b)| *a = b);
                    repeated.push(line.to_string());
                }
            }
        }
        if !repeated.is_empty() {
            notes.push(format!(
                "repeated times are left out: {} {}",
                if repeated.len() > 1 { "lines" } else { "line" },
                repeated.join(", ")
            ));
        }
        Ok(kept.into_iter().map(|(line, _, cells)| (line, cells)).collect())
    }
}

/// Times with a missing one between two rows of a regular table filled; a time that stands twice where the next is lacking is moved there.
fn fill_times(times: &[Option<f64>], rows: &[(usize, Vec<String>)], notes: &mut Vec<String>) -> Vec<Option<f64>> {
    let mut filled = times.to_vec();
    let steps: Vec<f64> = times.windows(2).filter_map(|pair| Some(pair[1]? - pair[0]?)).collect();
    let mut sorted = steps.clone();
    sorted.sort_unstable_by(f64::total_cmp);
    let Some(step) = sorted.get(sorted.len() / 2).copied().filter(|step| *step != 0.0) else { return filled };
    let near = |a: f64, b: f64| (a - b).abs() < 0.01 * step.abs();
    for i in 1..times.len().saturating_sub(1) {
        let (Some(before), Some(after)) = (filled[i - 1], times[i + 1]) else { continue };
        let fits = near(after - before, 2.0 * step);
        match times[i] {
            None if fits => {
                filled[i] = Some(before + step);
                notes.push(format!(
                    "line {} has no time: {} is filled in between its neighbours",
                    rows[i].0,
                    number(before + step)
                ));
            }
            Some(own) if fits && own == before => {
                filled[i] = Some(before + step);
                notes.push(format!(
                    "line {} repeats the time {}: {} is taken, which is lacking",
                    rows[i].0,
                    number(own),
                    number(before + step)
                ));
            }
            _ => {}
        }
    }
    let lost: Vec<String> =
        filled.iter().zip(rows).filter(|(time, _)| time.is_none()).map(|(_, (line, _))| line.to_string()).collect();
    if !lost.is_empty() {
        notes.push(format!(
            "rows without a time are left out: {} {}",
            if lost.len() > 1 { "lines" } else { "line" },
            lost.join(", ")
        ));
    }
    filled
}

/// Whether a column has more words than numbers.
fn is_of_words(table: &Table, column: usize) -> bool {
    let cells = || table.rows.iter().filter_map(|(_, cells)| cells.get(column)).filter(|cell| !is_missing(cell));
    let numbers = cells().filter(|cell| grid::number(cell).is_some()).count();
    cells().count() > 2 * numbers
}

/// The heading of a column; its unit also from its cells or from the title, its direction from the title.
fn plain(head: &str, table: &Table, column: usize) -> Plain {
    let (whole, unit) = parts(head);
    // what stands in brackets may explain the sign
    let name = match column_named(&whole).is_some() || speed_named(&whole) || !whole.contains(['(', '[']) {
        true => whole.clone(),
        false => without_brackets(&whole),
    };
    let brackets = folded(&whole);
    let is_told_loss = has(&brackets, words::POSITIVE) && has(&brackets, words::LOSS)
        || brackets.contains("+ = ") && has(&brackets, words::LOSS);
    let text = folded(&name);
    let is_acceleration =
        |word: &str| ["decel", "verzog", "verzoeg", "desaceler", "gensokudo"].iter().any(|stem| word.starts_with(stem));
    let mut is_loss = false;
    let mut told = None;
    let title_of = |stems| has(&text, stems) || has(&table.title, stems);
    if title_of(words::INTERVAL) && !has(&table.title, &["sampling interval"]) {
        told = Some(DeltaV::Interval);
    } else if title_of(words::CUMULATIVE) {
        told = Some(DeltaV::Cumulative);
    }
    let drop_units = has(&text, words::INTERVAL);
    let word = |word: &str| -> String {
        let loss = has(word, words::LOSS)
            || ["langsverzog", "querverzog", "laengsverzoeg", "querverzoeg"].iter().any(|stem| word.starts_with(stem));
        is_loss |= loss;
        match () {
            () if word.starts_with("langsverzog") || word.starts_with("laengsverzoeg") => "ax".to_owned(),
            () if word.starts_with("querverzog") || word.starts_with("querverzoeg") => "ay".to_owned(),
            () if loss && is_acceleration(word) => "acceleration".to_owned(),
            () if loss => "change".to_owned(),
            () if drop_units && (has(word, words::INTERVAL) || INTERVAL_WORDS.contains(&word)) => String::new(),
            () => word.to_owned(),
        }
    };
    let pieces: Vec<String> =
        text.split(|c: char| !(c.is_alphanumeric() || c == '\'')).filter(|word| !word.is_empty()).map(word).collect();
    let known = |name: &str| column_named(name).is_some() || speed_named(name);
    let mut name =
        if is_loss || drop_units || !known(&name) && known(&pieces.join(" ")) { pieces.join(" ") } else { name };
    let unit = unit.or_else(|| unit_of_cells(table, column)).or_else(|| unit_of_title(table, &name));
    // `LATERAL CRASH PULSE` above `Delta-V (km/h)`
    let is_bare = matches!(column_named(&name), Some("dvx" | "a"))
        && column_named(&format!("{name} lateral")) != column_named(&name);
    let lacks_direction = is_bare
        && !["x", "longitudinal", "long", "langs", "zengo"]
            .iter()
            .any(|word| folded(&name).split([' ', ',']).any(|own| own == *word));
    let [along, across] =
        [&["longitudinal", "langs", "zengo", "x"][..], &["lateral", "quer", "sayu", "y"]].map(|stems| {
            table
                .title
                .split(|c: char| !c.is_alphanumeric())
                .any(|word| stems.iter().any(|stem| word == *stem || stem.len() > 3 && word.starts_with(stem)))
        });
    if lacks_direction && across != along {
        name += if across { " lateral" } else { " longitudinal" };
    }
    Plain { name, unit, is_loss: is_loss || is_told_loss, told }
}

/// A heading without what stands in brackets.
fn without_brackets(head: &str) -> String {
    let mut depth = 0_u32;
    let outside = |c: &char| {
        depth = match c {
            '(' | '[' => depth + 1,
            ')' | ']' => depth.saturating_sub(1),
            _ => depth,
        };
        depth == 0 && !")]".contains(*c)
    };
    head.chars().filter(outside).collect::<String>().trim().to_owned()
}

/// Words that come with a change per interval.
const INTERVAL_WORDS: [&str; 12] =
    ["per", "each", "je", "pro", "par", "por", "cada", "ms", "msec", "step", "sample", "schritt"];

/// A unit in all numbers of a column, `48 mph`.
fn unit_of_cells(table: &Table, column: usize) -> Option<String> {
    let mut numbers = table.rows.iter().filter_map(|(_, cells)| number_and_unit(cells.get(column)?));
    let unit = numbers.next()?.1;
    (scale_of(&unit).is_some() && !unit.starts_with(['[', '(', '-']) && numbers.all(|(_, own)| own == unit))
        .then_some(unit)
}

/// A unit in brackets in the title, if it suits the column.
fn unit_of_title(table: &Table, name: &str) -> Option<String> {
    let suits = |unit: &&str| {
        let dimension = scale_of(unit).map(|scale| scale.dimension);
        dimension.is_some_and(|dimension| {
            occupant_scenario::column_in(name, dimension).is_some()
                || speed_named(name) && dimension == Unit::MetrePerSecond.dimension()
        })
    };
    table
        .title
        .split(['(', ')', '[', ']', ','])
        .map(str::trim)
        .filter(|unit| unit.len() > 1 || *unit == "g")
        .find(suits)
        .map(str::to_owned)
}
