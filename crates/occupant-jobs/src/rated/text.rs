//! Ratings as text.

use crash_measures::rating::{Method, Rated, RatedCriterion, RatedOccupant, RatedRegion, Scale};
use placed_text::{number, shown};

use crate::base::text_table::Align::{Left, Right};
use crate::base::text_table::{self, NONE, Table};

/// Tables of all occupants, results of the tests and their sum, blanks with their reasons.
pub fn text(rated: &Rated) -> String {
    let mut parts = Vec::new();
    for test in &rated.tests {
        for person in &test.occupants {
            parts.push(occupant(person, rated.rating.method));
        }
        let result = test.outcome.map(|outcome| outcome.words(rated.rating.method));
        parts.extend(result.map(|words| format!("{}: {words}\n", test.test.name)));
    }
    let sum = rated.sum.map(|sum| sum.words(rated.rating.method));
    parts.extend(sum.map(|words| format!("all tests: {words}\n")));
    parts.join("\n")
}

fn occupant(person: &RatedOccupant, method: Method) -> String {
    let mut table = Table::new(&[
        (Left, &["region", "criterion"]),
        (Right, &["value"]),
        (Left, &["unit", "scale"]),
        (Right, &["cap", "worth", heading(method)]),
    ]);
    for region in &person.regions {
        let mut left = [region.region.name.to_owned(), points(region, method)];
        for criterion in &region.criteria {
            let [name, result] = std::mem::take(&mut left);
            table.row([name].into_iter().chain(cells(criterion, method)).chain([result]));
        }
    }
    let mark = if person.doubtful { "! " } else { "" };
    let capped = if person.capped { ", capped" } else { "" };
    let words = person.outcome.words(method);
    let place = shown(&person.occupant.place()).to_string();
    format!("{place}: {mark}{words}{capped}\n{}{}", table.text(), remarks(person))
}

fn heading(method: Method) -> &'static str {
    match method {
        Method::Bands | Method::Sliding => "points",
        Method::Limits(_) => "verdict",
        Method::Stars => "risk, %",
        Method::Demerits(_) => "demerits",
    }
}

/// Result of a region; an interval if blanks matter.
fn points(region: &RatedRegion, method: Method) -> String {
    let of = |value: f64| match method {
        Method::Bands | Method::Sliding => format!("{value:.3}"),
        Method::Limits(_) => if value > 0.0 { "met" } else { "NOT MET" }.to_owned(),
        Method::Stars => text_table::number(100.0 * value, 1),
        Method::Demerits(_) => number(value),
    };
    let outcome = region.outcome;
    let mark = if region.doubtful { "!" } else { "" };
    match (outcome.is_open(), method) {
        (false, Method::Bands) if region.region.points == 0.0 => String::new(),
        (false, _) => of(outcome.now) + mark,
        (true, Method::Limits(_)) => "open".to_owned() + mark,
        (true, _) => format!("{}–{}{mark}", of(outcome.now), of(outcome.best)),
    }
}

fn cells(own: &RatedCriterion, method: Method) -> [String; 6] {
    let mark = if own.entry.doubtful { "!" } else { "" };
    let shown = |value| own.criterion.scale.word(value).map_or_else(|| rounded(value), str::to_owned);
    let value = own.entry.value.map_or(NONE.to_owned(), |value| shown(value) + mark);
    let cap = own.criterion.cap.filter(|_| !matches!(own.criterion.scale, Scale::Cap | Scale::CapUnless { .. }));
    [
        own.criterion.name.to_owned(),
        value,
        own.unit.symbol.to_owned(),
        scale(own),
        cap.map(number).unwrap_or_default(),
        worth(own, method),
    ]
}

/// Four significant digits.
fn rounded(value: f64) -> String {
    let decimals = match value.abs() {
        size if size >= 1000.0 => 0,
        size if size >= 100.0 => 1,
        size if size >= 10.0 => 2,
        _ => 3,
    };
    text_table::number(value, decimals)
}

/// The scale of a criterion in words.
pub(super) fn scale(own: &RatedCriterion) -> String {
    let bound = |value: f64| if value < f64::MAX { number(value) } else { NONE.to_owned() };
    match own.criterion.scale {
        Scale::Bands { high, low } | Scale::Sliding { high, low } if high == low => format!("below {}", number(low)),
        Scale::Bands { high, low } | Scale::Sliding { high, low } => format!("{} to {}", number(high), number(low)),
        Scale::Most(_) | Scale::Rule(_) => own.most.map_or("no limit".to_owned(), |most| format!("≤ {}", digits(most))),
        Scale::Grades(bounds) => bounds.map(bound).join(" / "),
        Scale::Risk(_) => "risk curve".to_owned(),
        Scale::Deduction(steps) => {
            let step = |(from, percent): &(f64, f64)| format!("−{} % ≥ {}", number(*percent), number(*from));
            steps.iter().map(step).collect::<Vec<_>>().join(", ")
        }
        Scale::Percent => "taken off".to_owned(),
        Scale::Cap | Scale::CapUnless { .. } => format!("cap {}", own.criterion.cap.map(number).unwrap_or_default()),
        Scale::Gate { below, .. } => format!("contact ≥ {}", number(below)),
        Scale::Others => "none or all".to_owned(),
        Scale::Excursion => "colour".to_owned(),
        Scale::Beside(main) => format!("near the colour of {main}"),
        Scale::Answer => "yes or no".to_owned(),
    }
}

/// A limit that was SI, without the noise of its unit.
fn digits(value: f64) -> String {
    number((value * 1e6).round() / 1e6)
}

fn worth(own: &RatedCriterion, method: Method) -> String {
    if own.capped {
        return "CAPPED".to_owned();
    }
    let told = |worth: f64| match method {
        Method::Bands | Method::Sliding => format!("{} %", text_table::number(worth, 0)),
        Method::Limits(_) => if worth > 0.0 { "met" } else { "NOT MET" }.to_owned(),
        Method::Stars => text_table::number(100.0 - worth, 1),
        Method::Demerits(_) => ["poor", "marginal", "acceptable", "good"][worth.clamp(0.0, 3.0) as usize].to_owned(),
    };
    match (own.worth, own.entry.value) {
        (Some(worth), _) => told(worth),
        (None, None) => NONE.to_owned(),
        (None, Some(_)) if own.deducted > 0.0 => format!("−{} %", number(own.deducted)),
        (None, Some(_)) if own.criterion.gated => "not asked".to_owned(),
        (None, Some(_)) => String::new(),
    }
}

/// Blanks and values with a remark, one line for all with the same words.
fn remarks(person: &RatedOccupant) -> String {
    let mut known: Vec<(String, Vec<&str>)> = Vec::new();
    for own in person.regions.iter().flat_map(|region| &region.criteria) {
        let Some(words) = &own.entry.remark else { continue };
        let words = if own.entry.value.is_none() { format!("blank, {words}") } else { words.clone() };
        match known.iter_mut().find(|(text, _)| *text == words) {
            Some((_, names)) => names.push(own.criterion.name),
            None => known.push((words, vec![own.criterion.name])),
        }
    }
    known.iter().map(|(words, names)| format!("{}: {words}\n", names.join("; "))).collect()
}
