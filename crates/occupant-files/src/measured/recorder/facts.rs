//! What a report says beside its tables: belts, firing times, the largest velocity change, the direction of the impact, its signs.

use std::path::Path;

use occupant_scenario::folded;
use occupant_units::unit::Unit;
use placed_text::{is_missing, number as number_in_words};

use super::grid::{Grid, Line, Table, column_of, number, number_and_unit, parts};
use super::words::{self, has, state};
use crate::signals::{scale_of, seconds_in};
use crate::trouble::Trouble;

/// Something said, in [`folded`] letters, with its line and its event.
#[derive(Clone, Debug)]
pub(super) struct Fact {
    pub(super) key: String,
    pub(super) value: String,
    pub(super) line: usize,
    pub(super) event: Option<String>,
    /// The last title above it.
    pub(super) section: String,
}

/// A device: when it fired, or that it did not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fired {
    /// At a time after time zero, s.
    At(f64),
    /// At an unknown time.
    Yes,
    /// Not at all.
    No,
}

/// What the signs of a report mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Signs {
    /// Positive is a gain of speed, as in SAE J1698.
    Sae,
    /// Positive is a loss of speed.
    Loss,
    /// All numbers are magnitudes.
    None,
}

/// Direction of the impact: whether in front, behind, left, right.
#[derive(Clone, Debug, Default)]
pub(super) struct Struck {
    pub(super) front: Option<String>,
    pub(super) rear: Option<String>,
    pub(super) left: Option<String>,
    pub(super) right: Option<String>,
}

/// A value and where it was said.
pub(super) type Said<T> = Option<(T, usize)>;

/// All that is used.
#[derive(Clone, Debug, Default)]
pub(super) struct Facts {
    pub(super) belt: Said<bool>,
    pub(super) passenger_belt: Said<bool>,
    pub(super) bag: Said<Fired>,
    pub(super) pretensioner: Said<Fired>,
    pub(super) speed_m_s: Said<f64>,
    /// Largest longitudinal and lateral velocity change, m/s.
    pub(super) most_m_s: [Said<f64>; 2],
    pub(super) signs: Said<Signs>,
    /// Whether positive lateral values point to the left.
    pub(super) is_left_positive: bool,
    pub(super) struck: Struck,
    pub(super) is_braked: bool,
    pub(super) notes: Vec<String>,
}

/// What counts events or times between them.
const COUNTS: words::Stems = &[
    "number of",
    "events recovered",
    "anzahl",
    "nombre d",
    "numero de eventos",
    "from event",
    "to event",
    "between",
    "von ereignis",
];

/// The event that a line names: its number, or `most recent`, `1st prior`.
pub(super) fn event_of(text: &str) -> Option<String> {
    if has(text, COUNTS) {
        return None;
    }
    for (words, label) in [
        (
            &["most recent event", "letztes ereignis", "evenement le plus recent", "evento mas reciente", "saishin"][..],
            "most recent",
        ),
        (&["1st prior event", "first prior event"], "1st prior"),
        (&["2nd prior event", "second prior event"], "2nd prior"),
        (&["first record"], "1"),
        (&["second record"], "2"),
    ] {
        if words.iter().any(|word| text.contains(word)) {
            return Some(label.to_owned());
        }
    }
    let names = [
        "event record",
        "event number",
        "event no",
        "event id",
        "event",
        "record",
        "ereignis",
        "evenement",
        "evento",
        "jisho",
        "ibento",
        "crash event",
    ];
    let number_after = |name: &&str| {
        let at = text.match_indices(*name).find(|(at, _)| !text[..*at].ends_with(char::is_alphanumeric))?.0;
        let rest = text[at + name.len()..].trim_start_matches([' ', '#', ':', '.', '-', '°', 'n', 'r', 'º']);
        let digits: String = rest.chars().take_while(char::is_ascii_digit).collect();
        (!digits.is_empty() && digits.len() < 4 && !rest[digits.len()..].starts_with(['.', ',', '/'])).then_some(digits)
    };
    let found: Vec<String> = names.iter().filter_map(number_after).collect();
    found.first().cloned()
}

/// Facts in the lines between tables and in columns of words, and the event of each table.
pub(super) fn read(grid: &Grid) -> (Vec<Fact>, Vec<Option<String>>) {
    let mut facts = Vec::new();
    let mut events = vec![None; grid.tables.len()];
    let mut event: Option<String> = None;
    let mut next = 0;
    let mut head: Option<&Line> = None;
    let mut section = String::new();
    let mut last = 0;
    for (at, line) in &grid.words {
        settle(grid, &mut events, &mut next, *at, &event, &mut facts);
        if let Some(found) = event_of(&line.words()) {
            event = Some(found);
        }
        // a head serves the lines directly below it
        head = head.filter(|_| line.number <= last + 1);
        last = line.number;
        if is_head(line) {
            head = Some(line);
        }
        if line.filled() == 1 && !line.words().contains(": ") {
            section = line.words();
        }
        facts.extend(said(line, head).into_iter().map(|(key, value)| Fact {
            key: folded(&key),
            value: folded(&value),
            line: line.number,
            event: event.clone(),
            section: section.clone(),
        }));
    }
    settle(grid, &mut events, &mut next, usize::MAX, &event, &mut facts);
    (facts, events)
}

/// Gives the tables before a line their event, and takes what their columns of words say last.
fn settle(
    grid: &Grid,
    events: &mut [Option<String>],
    next: &mut usize,
    at: usize,
    event: &Option<String>,
    facts: &mut Vec<Fact>,
) {
    while let Some(table) = grid.tables.get(*next).filter(|table| table.at < at) {
        events[*next] = event.clone();
        facts.extend(of_columns(table).map(|(key, value, line)| Fact {
            key,
            value,
            line,
            event: event.clone(),
            section: String::new(),
        }));
        *next += 1;
    }
}

/// The last word in each column of words.
fn of_columns(table: &Table) -> impl Iterator<Item = (String, String, usize)> {
    table.heads.iter().enumerate().filter_map(|(i, head)| {
        let cell = |(line, cells): &(usize, Vec<String>)| {
            cells.get(i).filter(|cell| state(cell).is_some()).map(|cell| (*line, cell.clone()))
        };
        let (line, value) = table.rows.iter().rev().find_map(cell)?;
        Some((folded(head), folded(&value), line))
    })
}

fn is_value(cell: &str) -> bool {
    let text = folded(cell);
    let names = has(&text, words::BELT) || has(&text, words::BAG) || has(&text, words::PRETENSIONER);
    number(cell).is_some()
        || is_missing(cell)
        || (state(cell).is_some() && !names && cell.split_whitespace().count() < 5)
}

/// Whether a line names devices or seats above lines of their states.
fn is_head(line: &Line) -> bool {
    let rest: Vec<&String> = line.cells.iter().skip(1).filter(|cell| !cell.is_empty()).collect();
    let names = |cell: &&String| {
        let text = folded(cell);
        [words::BELT, words::BAG, words::PRETENSIONER, words::DRIVER, words::PASSENGER]
            .iter()
            .any(|stems| has(&text, stems))
    };
    // two cells may as well be a key and its value
    let is_table = rest.len() > 1
        || has(&folded(&line.cells[0]), words::SEAT) && rest.iter().all(|cell| cell.split_whitespace().count() < 4);
    is_table && rest.iter().any(names) && !rest.iter().any(|cell| is_value(cell))
}

/// Keys and values of a line.
fn said(line: &Line, head: Option<&Line>) -> Vec<(String, String)> {
    let cells: Vec<&str> = line.cells.iter().map(String::as_str).collect();
    let filled: Vec<&str> = cells.iter().copied().filter(|cell| !cell.is_empty()).collect();
    let pair = |key: &str, value: &str| (key.trim_end_matches([':', '=', ' ']).to_owned(), value.to_owned());
    // a sentence with commas, as in `Air bag deployment, driver: 15 ms`
    let has_value = |cell: &&str| cell.split_once(": ").is_some_and(|(_, value)| !value.trim().is_empty());
    if filled.len() > 1
        && !has_value(&filled[0])
        && filled.last().is_some_and(has_value)
        && !filled[1..].iter().any(|cell| is_value(cell))
    {
        let text = filled.join(", ");
        return text.rsplit_once(": ").map(|(key, value)| vec![pair(key, value)]).unwrap_or_default();
    }
    if filled.len() > 1 && has_value(&filled[0]) && !filled[1..].iter().any(|cell| cell.contains(':')) {
        let text = filled.join(", ");
        return text.split_once(": ").map(|(key, value)| vec![pair(key, value)]).unwrap_or_default();
    }
    if filled.len() > 1 && filled.iter().all(has_value) {
        return filled.iter().filter_map(|cell| cell.split_once(": ")).map(|(key, value)| pair(key, value)).collect();
    }
    match filled[..] {
        [] => Vec::new(),
        [text] => {
            let split = text.split_once(':').or_else(|| text.split_once(" = "));
            vec![split.map_or_else(|| pair(text, text), |(key, value)| pair(key, value.trim()))]
        }
        [key, value, unit] if number(value).is_some() && scale_of(unit).is_some() => {
            vec![pair(key, &format!("{value} {unit}"))]
        }
        _ if filled.len().is_multiple_of(2)
            && filled.len() > 2
            && filled.chunks(2).all(|c| !is_value(c[0]) && is_value(c[1])) =>
        {
            filled.chunks(2).map(|c| pair(c[0], c[1])).collect()
        }
        _ => {
            let above = |k: usize| {
                head.filter(|head| head.number != line.number)
                    .and_then(|head| head.cells.get(k))
                    .map_or("", String::as_str)
            };
            let value =
                |k: usize| (!cells[k].is_empty()).then(|| pair(&format!("{} {}", cells[0], above(k)), cells[k]));
            (1..cells.len()).filter_map(value).collect()
        }
    }
}

impl Facts {
    /// The facts of an event.
    ///
    /// # Errors
    /// Facts that contradict each other.
    pub(super) fn of(path: &Path, all: &[Fact], event: Option<&str>) -> Result<Self, Trouble> {
        let is_own = |fact: &&Fact| fact.event.is_none() || event.is_none() || fact.event.as_deref() == event;
        let own: Vec<&Fact> = all.iter().filter(is_own).collect();
        let mut facts = Facts::default();
        let mut vin: Option<(String, usize)> = None;
        for fact in own {
            facts.take(path, fact)?;
            let number = vin_in(fact);
            if let (Some((first, line)), Some(other)) = (&vin, &number) {
                let length = first.len().min(other.len()).min(10);
                if first[..length] != other[..length] {
                    return Err(Trouble::at(
                        path,
                        fact.line,
                        format!("two vehicles: VIN {first} in line {line} and {other}"),
                        "the report of one vehicle",
                    )
                    .hint("save each vehicle's report as a file of its own"));
                }
            }
            vin = vin.or(number.map(|number| (number, fact.line)));
        }
        Ok(facts)
    }

    fn take(&mut self, path: &Path, fact: &Fact) -> Result<(), Trouble> {
        let Fact { key, value, line, section, .. } = fact;
        // `driver buckled, passenger unbuckled`
        if has(value, words::DRIVER) && has(value, words::PASSENGER) {
            let clauses: Vec<&str> = value.split([',', ';', '/']).collect();
            if clauses.len() > 1 && key != value {
                return clauses.iter().try_for_each(|clause| {
                    let clause = clause.trim();
                    self.take(path, &Fact { key: format!("{key} {clause}"), value: clause.to_owned(), ..fact.clone() })
                });
            }
            return Ok(());
        }
        let device = |text: &str| [words::BELT, words::BAG, words::PRETENSIONER].iter().any(|stems| has(text, stems));
        if has(key, words::FIRING) && !device(key) && !device(value) && device(section) && key != value {
            let key = format!("{section} {key}");
            return self.take(path, &Fact { key, section: String::new(), ..fact.clone() });
        }
        let both = format!("{key} {value}");
        let is_lamp = has(key, words::OTHER_BAG);
        let is_passenger = has(key, words::PASSENGER) && !has(key, words::DRIVER)
            || !has(key, words::DRIVER) && has(value, words::PASSENGER);
        let is_short = both.split_whitespace().count() < 24;
        self.take_signs(path, fact)?;
        if has(&both, words::PRETENSIONER) {
            if !is_passenger && is_short {
                self.notes.extend(set_fired(path, &mut self.pretensioner, fact, "the pretensioner")?);
            }
        } else if has(&both, words::BAG) {
            if !is_passenger && !is_lamp && !has(key, words::LATER_STAGE) && is_short {
                self.notes.extend(set_fired(path, &mut self.bag, fact, "the driver's front bag")?);
            }
        } else if has(&both, words::BELT) || has(value, words::BELTED) && (has(key, words::DRIVER) || is_passenger) {
            if !is_lamp && is_short {
                self.take_belt(path, fact, is_passenger)?;
            }
        } else if has(key, words::SPEED_AT_IMPACT) {
            self.speed_m_s =
                quantity(fact, Unit::MetrePerSecond).map(f64::abs).map(|speed| (speed, *line)).or(self.speed_m_s);
        } else if has(key, words::MAXIMUM) && is_change(key) {
            let axis = usize::from(has(key, &["lateral", "quer", "sayu", "laterale"]));
            let is_other = has(key, &["resultant", "result", "vertical", "gesamt"]);
            if let Some(most) = quantity(fact, Unit::MetrePerSecond).filter(|_| !is_other) {
                self.most_m_s[axis] = Some((most, *line));
            }
        } else if has(key, words::BRAKE) {
            self.is_braked |= state(value) == Some(true);
        } else if has(key, words::COMPLETE) && state(value) == Some(false) {
            self.notes.push(format!(
                "the recorder says that its record is not complete (line {line}): the pulse may be cut off"
            ));
        } else if has(key, words::SEAT_TRACK) && key != value && !is_missing(value) {
            self.notes.push(format!("not used: {key}: {value} (line {line}); car.seats.driver.track takes a distance"));
        } else if key.contains("event") && is_no_deployment(value) {
            self.notes.extend(set_fired(
                path,
                &mut self.bag,
                &Fact { value: "no".to_owned(), ..fact.clone() },
                "the driver's front bag",
            )?);
        }
        if is_short && !has(&both, words::BAG) {
            self.take_direction(fact);
        }
        Ok(())
    }

    fn take_belt(&mut self, path: &Path, fact: &Fact, is_passenger: bool) -> Result<(), Trouble> {
        let slot = if is_passenger { &mut self.passenger_belt } else { &mut self.belt };
        let who = if is_passenger { "the passenger's belt" } else { "the driver's belt" };
        let Some(worn) = state(&fact.value) else {
            if number(&fact.value).is_some() {
                self.notes.push(format!(
                    "{who} has the code {} without a meaning (line {}): not used",
                    fact.value, fact.line
                ));
            }
            return Ok(());
        };
        match slot {
            Some((told, line)) if *told != worn => Err(contradiction(
                path,
                fact.line,
                &format!("{who} is {} here and {} in line {line}", worn_words(worn), worn_words(*told)),
            )
            .hint("correct one of the two lines")),
            Some(_) => Ok(()),
            None => {
                *slot = Some((worn, fact.line));
                Ok(())
            }
        }
    }

    /// What positive means.
    fn take_signs(&mut self, path: &Path, fact: &Fact) -> Result<(), Trouble> {
        let text = if fact.key == fact.value { fact.key.clone() } else { format!("{} {}", fact.key, fact.value) };
        let clauses = || text.split([',', ';', '.', '|', '(']);
        let negative = |clause: &str| has(clause, &["negative", "negativ", "negatif", "negativo", "minus", "menos"]);
        let column = column_of(&fact.key);
        let towards = |stems| has(&fact.value, stems);
        let found = match column {
            Some("dvx" | "ax") if towards(&["rearward", "backward", "ruckwarts"]) => Some(Signs::Loss),
            Some("dvx" | "ax") if towards(&["forward", "vorwarts"]) => Some(Signs::Sae),
            Some("dvy" | "ay") if towards(&["right to left", "leftward"]) => {
                self.is_left_positive = true;
                None
            }
            _ if has(&text, words::UNSIGNED) => Some(Signs::None),
            _ if text.contains("j1698") || text.contains("j211") => Some(Signs::Sae),
            _ => clauses().find_map(|clause| match () {
                () if has(clause, words::POSITIVE) && has(clause, words::LOSS) && !negative(clause) => {
                    Some(Signs::Loss)
                }
                () if negative(clause) && has(clause, words::LOSS) => Some(Signs::Sae),
                () if has(clause, words::POSITIVE) && has(clause, words::FORWARD) && !negative(clause) => {
                    Some(Signs::Sae)
                }
                () => None,
            }),
        };
        match (self.signs, found) {
            (Some((told, line)), Some(found)) if told != found => {
                Err(contradiction(path, fact.line, &format!("another meaning of positive numbers than in line {line}"))
                    .hint(STRUCK))
            }
            (None, Some(found)) => {
                self.signs = Some((found, fact.line));
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn take_direction(&mut self, fact: &Fact) {
        let Fact { key, value, line, .. } = fact;
        let is_title = key == value;
        let is_seat = |text: &str| {
            has(text, words::PASSENGER) || has(text, words::DRIVER) && !has(text, &["driver side", "driver's side"])
        };
        if !has(key, words::IMPACT)
            || has(key, words::PRE_CRASH)
            || is_seat(key)
            || is_title && key.split_whitespace().count() > 6
        {
            return;
        }
        let answer = state(value);
        let text = if answer == Some(true) && !is_title { key } else { value };
        if answer == Some(false) && !is_title || is_no_deployment(text) {
            return;
        }
        let degrees = number_and_unit(value)
            .filter(|_| has(key, &["pdof", "principal"]) && !value.contains("clock"))
            .map(|(degrees, _)| degrees.rem_euclid(360.0));
        let near = |angle: f64| {
            degrees.is_some_and(|d| {
                let off = (d - angle).abs();
                off.min(360.0 - off) <= 45.0
            })
        };
        let words =
            Some(format!("`{}` in line {line}", if is_title { value.clone() } else { format!("{key}: {value}") }));
        let is = |stems: words::Stems| has(text, stems) && degrees.is_none();
        let found = [
            is(words::FRONT) || text == "avant" || near(0.0),
            is(words::REAR) || near(180.0),
            is(words::LEFT) || near(270.0),
            is(words::RIGHT) || near(90.0),
        ];
        // a list of choices
        if found[0] && found[1] || found[2] && found[3] {
            return;
        }
        let Struck { front, rear, left, right } = &mut self.struck;
        for (slot, _) in
            [front, rear, left, right].into_iter().zip(found).filter(|(slot, found)| *found && slot.is_none())
        {
            slot.clone_from(&words);
        }
    }
}

/// The option that settles signs.
pub(super) const STRUCK: &str =
    "say where the vehicle was struck with --struck front, rear, left or right; it gives the velocity change its sign";

pub(super) fn contradiction(path: &Path, line: usize, found: &str) -> Trouble {
    Trouble::at(path, line, format!("the report contradicts itself: {found}"), "a report whose parts agree")
}

pub(super) fn worn_words(worn: bool) -> &'static str {
    if worn { "fastened" } else { "not fastened" }
}

fn is_change(key: &str) -> bool {
    [
        "delta",
        "δ",
        "dv",
        "velocity change",
        "change in velocity",
        "geschwindigkeitsanderung",
        "variation de vitesse",
        "cambio de velocidad",
        "variacion de velocidad",
        "sokudo henka",
    ]
    .iter()
    .any(|word| key.contains(word))
}

fn is_no_deployment(text: &str) -> bool {
    [
        "non-deploy",
        "nondeploy",
        "non deploy",
        "no deploy",
        "not deployed",
        "keine auslosung",
        "sans declenchement",
        "sin despliegue",
    ]
    .iter()
    .any(|word| text.contains(word))
}

/// A quantity with its unit in value or key, SI.
fn quantity(fact: &Fact, unit: Unit) -> Option<f64> {
    let (value, behind) = number_and_unit(&fact.value)?;
    let own = behind.split(['[', '(']).next().unwrap_or_default().trim().to_owned();
    let unit_of = |text: &str| scale_of(text).filter(|scale| scale.dimension == unit.dimension());
    let scale = unit_of(&own).or_else(|| parts(&fact.key).1.as_deref().and_then(unit_of));
    // behind or within the key
    let within = || {
        fact.key
            .split(['(', '[', ')', ']', ' ', ','])
            .find_map(|word| unit_of(word).filter(|_| word.len() > 1 && word != "-"))
    };
    Some(value * scale.or_else(within)?.factor)
}

fn set_fired(path: &Path, slot: &mut Said<Fired>, fact: &Fact, what: &str) -> Result<Option<String>, Trouble> {
    let marks_missing = |value: f64| (value - 254.0).abs() < 2.0 || value > 5000.0;
    let found = match number_and_unit(&fact.value) {
        Some((value, _)) if marks_missing(value) || value < 0.0 => return Ok(None),
        Some((value, rest)) => {
            let within = |text: &str| {
                text.split(['(', '[', ')', ']', ' ', ',']).find_map(|word| seconds_in(word).filter(|_| word.len() > 1))
            };
            match seconds_in(&rest).or_else(|| within(&fact.key)) {
                Some(factor) => Fired::At(value * factor),
                None if has(
                    &fact.key,
                    &["time", "zeit", "temps", "tiempo", "jikan", "deploy", "zundung", "auslosung"],
                ) =>
                {
                    return Ok(Some(format!(
                        "{what}: {} in line {} has no unit of time: not used",
                        fact.value, fact.line
                    )));
                }
                None => return Ok(None),
            }
        }
        None => match state(&fact.value) {
            Some(false) => Fired::No,
            _ if time_within(&fact.value).is_some() => Fired::At(time_within(&fact.value).unwrap_or_default()),
            Some(true) => Fired::Yes,
            None => return Ok(None),
        },
    };
    if let Fired::At(time_s) = found
        && time_s > LATEST_S
    {
        let found = format!("{what} fires {} s after time zero", number_in_words(time_s));
        return Err(Trouble::at(path, fact.line, found, "at most 1 s").hint("correct the unit of time"));
    }
    match *slot {
        Some((told, line)) if (told == Fired::No) != (found == Fired::No) => {
            let [here, there] = [found, told].map(|fired| if fired == Fired::No { "did not fire" } else { "fired" });
            return Err(contradiction(path, fact.line, &format!("{what} {here}, in line {line} it {there}"))
                .hint("correct one of the two lines"));
        }
        Some((Fired::At(told), _)) => {
            let earlier = if let Fired::At(time) = found { time.min(told) } else { told };
            *slot = Some((Fired::At(earlier), fact.line));
        }
        _ => *slot = Some((found, fact.line)),
    }
    Ok(None)
}

/// Latest firing after time zero, s.
const LATEST_S: f64 = 1.0;

/// A time within words, `fired at 12 ms`, s.
fn time_within(text: &str) -> Option<f64> {
    let words: Vec<&str> = text.split([' ', ',', ':', '(', ')']).filter(|word| !word.is_empty()).collect();
    let time = |pair: &[&str]| Some(number(pair[0])? * seconds_in(pair[1]).filter(|_| pair[1].len() > 1)?);
    words.windows(2).find_map(time)
}

fn vin_in(fact: &Fact) -> Option<String> {
    let is_key = has(&fact.key, &["vin", "fahrgestellnummer", "fahrzeug-ident", "numero de chassis", "shadai"])
        && fact.key != fact.value;
    let plain: String = fact.value.chars().take_while(|c| c.is_ascii_alphanumeric()).collect();
    (is_key && plain.len() > 7 && plain.contains(|c: char| c.is_ascii_digit())).then_some(plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn events_are_named() {
        for (text, event) in [
            ("pre-crash data (most recent event, trg 2)", Some("most recent")),
            ("event record 2", Some("2")),
            ("ereignis 1", Some("1")),
            ("evenement n° 2", Some("2")),
            ("number of events 2", None),
            ("time from event 1 to 2 0.4 s", None),
            ("longitudinal crash pulse", None),
            ("system status at event", None),
            ("event date 2024", None),
        ] {
            assert_eq!(event_of(text).as_deref(), event, "{text}");
        }
    }

    #[test]
    fn states_of_seats_are_read_in_either_direction() {
        for text in [
            "Item,Driver,Passenger\nSeat belt,Buckled,Unbuckled\nFront air bag deployment (ms),14,N/A\n",
            "Seat,Belt,Front air bag deployment (ms)\nDriver,Buckled,14\nPassenger,Unbuckled,N/A\n",
            "Safety belt status, driver: Buckled\nSafety belt status, passenger: Not buckled\nAir bag deployment, driver: 14 ms\n",
            "Driver belt;Buckled;Passenger belt;Unbuckled\nDriver air bag deployment time;14;ms\n",
        ] {
            let grid = Grid::of(text).unwrap();
            let (facts, _) = read(&grid);
            let facts = Facts::of(Path::new("r.csv"), &facts, None).unwrap();
            assert_eq!(facts.belt.map(|said| said.0), Some(true), "{text}");
            assert_eq!(facts.passenger_belt.map(|said| said.0), Some(false), "{text}");
            assert_eq!(facts.bag.map(|said| said.0), Some(Fired::At(0.014)), "{text}{grid:?}");
        }
    }
}
