//! The short table at the end of a run.

use std::collections::BTreeSet;

use occupant_core::results::energy::EnergyCheck;
use occupant_core::results::summary::{
    Acceleration, Caveat, ContactBegin, Event, FirstContact, Level, Peak, Person, RunStatus, Summary, word,
};
use placed_text::shown;

use super::throws::{ejections, throws};
use super::{elements, measures};
use crate::base::text_table::Align::{Left, Right};
use crate::base::text_table::{NONE, facts, number, table, without_zeros};
use crate::base::{Units, quoted};
use occupant_jobs::base::describe::caveat;
use occupant_jobs::run::recording::Written;

/// Marks of results that should not be quoted: `!` for those with a caveat, a star for those not stable in an ensemble.
#[derive(Clone, Debug, Default)]
pub(crate) struct Marks<'a> {
    caveats: &'a [Caveat],
    /// Prefix of the names of figures of one of several occupants.
    prefix: &'a str,
    /// Unstable figures; none without an ensemble.
    unstable: Option<BTreeSet<&'a str>>,
}

impl<'a> Marks<'a> {
    pub(crate) fn of(caveats: &'a [Caveat]) -> Self {
        Marks { caveats, prefix: "", unstable: None }
    }

    pub(crate) fn and_unstable(self, unstable: impl IntoIterator<Item = &'a str>) -> Self {
        Marks { unstable: Some(unstable.into_iter().collect()), ..self }
    }

    /// Marks for the figures of an occupant with this name prefix.
    pub(crate) fn of_occupant(&self, prefix: &'a str) -> Self {
        Marks { prefix, ..self.clone() }
    }

    /// Whether a caveat applies to the figure.
    pub(crate) fn spoils(&self, figure: &str) -> bool {
        let figure = format!("{}{figure}", self.prefix);
        self.caveats.iter().any(|caveat| caveat.touches(&figure))
    }

    /// Text of a figure with its marks, padded so that columns stay aligned.
    pub(crate) fn put(&self, figure: &str, mut text: String) -> String {
        if !self.caveats.is_empty() {
            text.push(if self.spoils(figure) { '!' } else { ' ' });
        }
        if let Some(unstable) = &self.unstable {
            text.push(if unstable.contains(format!("{}{figure}", self.prefix).as_str()) { '*' } else { ' ' });
        }
        text
    }

    /// Explanation of the marks, one line per caveat; none if nothing is marked.
    pub(crate) fn explained(&self) -> Option<String> {
        let star = self.unstable.iter().filter(|unstable| !unstable.is_empty());
        let star = star.map(|_| "* NOT STABLE under small changes, see below\n".to_owned());
        let lines: Vec<_> = self.caveats.iter().map(caveat).chain(star).collect();
        (!lines.is_empty()).then(|| lines.concat())
    }
}

/// The summary: title, accelerations, force elements, first contacts, caveats.
pub(crate) fn summary_table(
    summary: &Summary,
    written: &Written,
    marks: &Marks,
    units: Units,
    dummies: &[String],
) -> String {
    let mut parts = vec![title(summary), accelerations(summary, marks)];
    parts.extend(elements::texts(&summary.elements, marks, units));
    parts.extend(events(&summary.events, summary.more_events));
    if !summary.first_contacts.is_empty() {
        parts.push(first_contacts(summary, marks, units));
    }
    for (prefix, person) in summary.people() {
        let brief = person.measures.iter().filter(|m| m.brief);
        let judged = dummies.iter().any(|name| name == prefix.trim_end_matches('.'));
        let own = measures::table(brief, &marks.of_occupant(&prefix), units, judged);
        parts.push(if prefix.is_empty() { own } else { format!("{}\n{own}", shown(prefix.trim_end_matches('.'))) });
    }
    parts.extend(ejections(summary, marks));
    parts.extend(throws(summary, marks, units));
    parts.extend(marks.explained());
    parts.push(trust(summary, written, marks, units));
    parts.join("\n")
}

fn title(summary: &Summary) -> String {
    let reached = format!("{} to {} ms", ms(summary.start_s), ms(summary.reached_s));
    let ending = match summary.status {
        RunStatus::Completed => reached,
        RunStatus::Interrupted => format!("INTERRUPTED: {reached} of {} ms", ms(summary.end_s)),
        RunStatus::Failed => format!("FAILED: {reached} of {} ms", ms(summary.end_s)),
    };
    let every = (summary.reached_s - summary.start_s) / summary.solver.outputs.saturating_sub(1).max(1) as f64;
    let outputs = format!("outputs every {} ms", without_zeros(&number(every * 1e3, 3)));
    format!("{}\n{ending}, {outputs}\n", shown(&summary.title))
}

fn accelerations(summary: &Summary, marks: &Marks) -> String {
    let heads = ["peak, g", "at, ms", "3 ms held, g", "from–to, ms", "3 ms in total, g"];
    let people = summary.people();
    let parts = people.iter().flat_map(|(prefix, Person { accelerations: a, .. })| {
        let parts = [("head", &a.head), ("chest", &a.chest), ("pelvis", &a.pelvis)];
        parts.map(|(name, part)| (format!("{prefix}{name}"), part))
    });
    // a part of a body on a mount lacks some
    let there = parts.filter(|(_, part)| !part.peak_g.is_nan());
    let rows = there.map(|(name, part)| acceleration(&name, part, marks));
    table(&[(Left, &["acceleration"]), (Right, &heads)], rows)
}

fn acceleration(name: &str, part: &Acceleration, marks: &Marks) -> [String; 6] {
    let held = part.three_ms_contiguous;
    let total = part.three_ms_cumulative;
    let level = |l: Option<Level>| l.map_or(NONE.to_owned(), |l| number(l.level_g, 1));
    let mark = |figure: &str, text| marks.put(&format!("{name}.{figure}"), text);
    [
        name.to_owned(),
        mark("peak", number(part.peak_g, 1)),
        mark("peak_time", ms(part.peak_time_s)),
        mark("three_ms_contiguous", level(held)),
        mark("three_ms_contiguous", held.map_or(NONE.to_owned(), |l| format!("{}–{}", ms(l.from_s), ms(l.to_s)))),
        mark("three_ms_cumulative", level(total)),
    ]
}

/// Events in order; none without events.
fn events(events: &[Event], more: u64) -> Option<String> {
    let rows = events.iter().map(|event| [ms(event.time_s), format!("{} {}", shown(&event.name), event.what)]);
    let rest = if more > 0 { format!("and {more} more events\n") } else { String::new() };
    (!events.is_empty()).then(|| table(&[(Right, &["at, ms"]), (Left, &["event"])], rows) + &rest)
}

/// Parts with a row even without contact; others get a row only with a contact force.
const ALWAYS: [&str; 4] = ["head", "chest", "left_knee", "right_knee"];

fn first_contacts(summary: &Summary, marks: &Marks, units: Units) -> String {
    let heads = ["at, ms", "speed, m/s", "closing, m/s", "depth, mm", "peak force, N", "at, ms"];
    let heads = heads.map(|head| units.heading(head));
    let heads = heads.each_ref().map(String::as_str);
    let is_loaded = |part: &str| summary.sphere_forces.iter().any(|p| p.sphere == part && p.force_n > 0.0);
    let is_shown = |first: &&FirstContact| {
        first.contact.is_some() || is_loaded(&first.sphere) || ALWAYS.contains(&first.sphere.as_str())
    };
    let rows = summary.first_contacts.iter().filter(is_shown).flat_map(|first| rows_of(summary, first, marks, units));
    table(&[(Left, &["contact", "surface"]), (Right, &heads)], rows)
}

/// One row per surface touched by a part; the peak force of the run is in the row of its surface.
fn rows_of(summary: &Summary, first: &FirstContact, marks: &Marks, units: Units) -> Vec<[String; 8]> {
    let peak = summary.sphere_forces.iter().find(|p| p.sphere == first.sphere);
    let none = || NONE.to_owned();
    let name = word(&first.sphere);
    let mark = |figure: &str, text| marks.put(&format!("contacts.{name}.{figure}"), text);
    let force = match peak {
        Some(p) => [
            mark("penetration", units.number(p.penetration_m * 1e3, "mm", 0)),
            mark("peak", units.number(p.force_n, "N", 0)),
            mark("peak_time", ms(p.time_s)),
        ],
        None => [none(), none(), none()],
    };
    let own = summary.contacts.iter().filter(|c| c.part == first.sphere);
    let mut touches: Vec<[String; 4]> = own.map(|contact| touch(contact, units)).collect();
    let is_first = |t: &&[String; 4]| Some(&t[1]) == first.contact.as_ref().map(|c| ms(c.time_s)).as_ref();
    let arrival = touches.iter().position(|t| is_first(&t));
    for (i, [_, texts @ ..]) in touches.iter_mut().enumerate() {
        for (text, figure) in texts.iter_mut().zip(["first_time", "first_speed", "first_closing"]) {
            // later touches are no figures of a study, but as good or bad as the first
            *text = mark(if arrival == Some(i) { figure } else { "touch" }, std::mem::take(text));
        }
    }
    if touches.is_empty() {
        touches.push([none(), none(), none(), none()]);
    }
    let on = peak.and_then(|p| touches.iter().position(|t| t[0] == p.surface));
    if let (Some(p), None) = (peak, on) {
        touches.push([p.surface.clone(), none(), none(), none()]);
    }
    let on = on.unwrap_or(touches.len() - 1);
    let row = |(i, [surface, at, speed, closing]): (usize, [String; 4])| {
        let name = if i == 0 { first.sphere.clone() } else { String::new() };
        let [depth, n, when] = if i == on { force.clone() } else { Default::default() };
        [name, surface, at, speed, closing, depth, n, when]
    };
    touches.into_iter().enumerate().map(row).collect()
}

/// Surface, time, speed and normal speed of a contact; a contact at the start has no speed.
fn touch(contact: &ContactBegin, units: Units) -> [String; 4] {
    let [time, speed, closing] = if contact.at_start {
        ["at start", NONE, NONE].map(str::to_owned)
    } else {
        let speed = |m_s| units.number(m_s, "m/s", 2);
        [ms(contact.time_s), speed(contact.speed_m_s), speed(contact.closing_m_s)]
    };
    [contact.surface.clone(), time, speed, closing]
}

fn trust(summary: &Summary, written: &Written, marks: &Marks, units: Units) -> String {
    let mut lines = Vec::new();
    for (prefix, Person { head_excursion, .. }) in summary.people() {
        let Some(e) = &head_excursion else { continue };
        let mark =
            |figure: &str, text| marks.put(&format!("{prefix}head_excursion.{figure}"), text).trim_end().to_owned();
        let mm = |way: &str, peak: Peak| mark(way, format!("{way} {}", units.say(peak.value * 1e3, "mm", 0)));
        let ways = [
            format!("{} at {}", mm("forward", e.forward), mark("forward_time", format!("{} ms", ms(e.forward.time_s)))),
            mm("up", e.up),
            mm("down", e.down),
            mm("left", e.left),
            mm("right", e.right),
        ];
        let of = if prefix.is_empty() { String::new() } else { format!("{}: ", shown(prefix.trim_end_matches('.'))) };
        lines.push(("head excursion", format!("{of}{}", ways.join(", "))));
    }
    let EnergyCheck { balance_error, reference, reference_j, .. } = summary.energy;
    let error = if balance_error.is_finite() { format!("error {balance_error:.1e}") } else { "not known".to_owned() };
    let error = marks.put("energy.balance_error", error);
    let of = units.say(reference_j, "J", if reference_j < 1.0 { 4 } else { 0 });
    lines.push(("energy balance", format!("{} of the {reference}, {of}", error.trim_end())));
    lines.push(("integration", integration(summary)));
    match written {
        Written::Nothing => {}
        Written::Complete(path) => {
            lines.push(("written", path.display().to_string()));
            lines.push(("next", format!("occupant report {0}; occupant measures {0}", quoted(path.display()))));
        }
        Written::Partial(path) => lines.push(("written", format!("{} (partial)", path.display()))),
    }
    facts(&lines)
}

fn integration(summary: &Summary) -> String {
    let s = &summary.solver;
    let rejected = match s.rejected {
        0 => String::new(),
        n => format!(" ({n} rejected)"),
    };
    let time = s.wall_time_s.map_or(String::new(), |t| format!(", {t:.3} s of wall time"));
    format!("{}, {} steps{rejected}, {} evaluations, {} outputs{time}", s.integrator, s.steps, s.evaluations, s.outputs)
}

/// Seconds as milliseconds.
pub(super) fn ms(time_s: f64) -> String {
    format!("{:.1}", time_s * 1e3)
}
