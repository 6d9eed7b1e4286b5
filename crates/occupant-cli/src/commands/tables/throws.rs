//! Throws of bodies, in the terms of accident reconstruction.

use occupant_core::results::summary::{Degree, Landing, Launch, Searle, Summary, Throw, ThrowStart};
use placed_text::shown;

use super::summary::{Marks, ms};
use crate::base::Units;
use crate::base::text_table::Align::{Left, Right};
use crate::base::text_table::{NONE, facts, number, table};

/// Throw distances of struck bodies; none without any.
pub(super) fn throws(summary: &Summary, marks: &Marks, units: Units) -> Option<String> {
    let all = summary.throws.iter().map(|(name, throw)| one(name, throw, marks, units));
    (!summary.throws.is_empty()).then(|| all.collect::<Vec<_>>().join("\n"))
}

/// Ejections from the compartment of a vehicle; none without any.
pub(super) fn ejections(summary: &Summary, marks: &Marks) -> Option<String> {
    let all = summary.ejections.iter().map(|(name, ejection)| {
        let of = if name.is_empty() { "occupant".to_owned() } else { shown(name).to_string() };
        let degree = match (ejection.degree, ejection.complete_s) {
            (Degree::Complete, Some(time_s)) => format!("complete: the whole {of} outside at {} ms", ms(time_s)),
            _ if ejection.inside.is_empty() => format!("partial: the {of} was never completely outside"),
            _ => format!("partial: {} never outside", ejection.inside.join(", ")),
        };
        let prefix = if name.is_empty() { String::new() } else { format!("{name}.") };
        let marks = marks.of_occupant(&prefix);
        let rows = ejection.parts.iter().map(|exit| {
            let past = exit.past.as_deref().map_or(NONE.to_owned(), |past| shown(past).to_string());
            [shown(&exit.part).to_string(), marks.put("ejection", ms(exit.time_s)), exit.side.words().to_owned(), past]
        });
        let heads = [(Left, &["ejected"][..]), (Right, &["at, ms"]), (Left, &["to", "past"])];
        format!("ejection {degree}\n{}", table(&heads, rows))
    });
    (!summary.ejections.is_empty()).then(|| all.collect::<Vec<_>>().join("\n"))
}

/// Text of one throw.
struct Words<'a> {
    marks: Marks<'a>,
    units: Units,
}

fn one(name: &str, throw: &Throw, marks: &Marks, units: Units) -> String {
    let prefix = if name.is_empty() { String::new() } else { format!("{name}.") };
    let words = Words { marks: marks.of_occupant(&prefix), units };
    let of = if name.is_empty() { "occupant".to_owned() } else { shown(name).to_string() };
    let start = match throw.from {
        ThrowStart::Struck => "struck by something other than its own vehicle",
        ThrowStart::Blow => "impact on its vehicle; the throw counts from there",
        ThrowStart::Launch => "leaves its vehicle; the throw counts from there",
        ThrowStart::Ground => "touches the ground; the throw counts from there",
    };
    let mut lines = vec![("throw", of), ("start", format!("{} ms, {start}", ms(throw.struck_s)))];
    lines.extend(throw.launch.as_ref().map(|launch| ("launch", words.launch(launch))));
    lines.extend(throw.landing.as_ref().map(|landing| ("landing", words.landing(landing))));
    lines.push(("distance", words.distance(throw)));
    lines.extend(throw.searle.as_ref().map(|searle| ("Searle", words.searle(searle, throw))));
    facts(&lines)
}

impl Words<'_> {
    fn metres(&self, figure: &str, metres: f64) -> String {
        self.marks.put(&format!("throw.{figure}"), self.units.say(metres, "m", 2)).trim_end().to_owned()
    }

    fn speed(&self, figure: &str, m_s: f64) -> String {
        let speed = self.units.say(m_s, "m/s", 2);
        // what a tachometer shows
        let customary =
            if self.units.symbol("m/s") == "m/s" { format!(" ({} km/h)", number(3.6 * m_s, 1)) } else { String::new() };
        self.marks.put(&format!("throw.{figure}"), format!("{speed}{customary}")).trim_end().to_owned()
    }

    fn launch(&self, launch: &Launch) -> String {
        format!(
            "{} ms, {} on, {}, {}",
            ms(launch.time_s),
            self.metres("launch_distance", launch.distance_m),
            self.speed("launch_speed", launch.speed_m_s),
            slope(launch.angle_deg)
        )
    }

    fn landing(&self, landing: &Landing) -> String {
        format!(
            "{} ms, {} on ({} first, {} on), {}, {}",
            ms(landing.time_s),
            self.metres("landing_distance", landing.distance_m),
            shown(&landing.sphere),
            self.metres("landing_touch_distance", landing.touch_distance_m),
            self.speed("landing_speed", landing.speed_m_s),
            slope(-landing.angle_deg)
        )
    }

    fn distance(&self, throw: &Throw) -> String {
        let parts = [
            throw.airborne_m.map(|m| format!("airborne {}", self.metres("airborne_distance", m))),
            throw.slide_m.map(|m| format!("sliding {}", self.metres("slide_distance", m))),
            throw.from_launch_m.map(|m| format!("{} from the launch", self.metres("from_launch", m))),
        ];
        let parts: Vec<String> = parts.into_iter().flatten().collect();
        let end = if throw.at_rest {
            "to rest".to_owned()
        } else {
            format!("so far, still at {}", self.speed("end_speed", throw.end_speed_m_s))
        };
        let of = if parts.is_empty() { String::new() } else { format!(": {}", parts.join(", ")) };
        format!("{} {end}{of}", self.metres("distance", throw.distance_m))
    }

    fn searle(&self, searle: &Searle, throw: &Throw) -> String {
        let Searle { friction, fall_m, speeds_m_s: [slow, fast], distances_m: [near, far], drag_factor } = *searle;
        let gone_m = throw.from_launch_m.unwrap_or(f64::NAN);
        let drag = drag_factor.map_or(String::new(), |factor| format!(": a drag factor of {}", number(factor, 2)));
        format!(
            "{} to {} from the throw distance, with friction {} and a fall of {}; at its launch speed it would go {} to {}, it went {}{drag}",
            self.speed("searle_least_speed", slow),
            self.speed("searle_greatest_speed", fast),
            number(friction, 2),
            self.units.say(fall_m, "m", 2),
            self.units.say(near, "m", 2),
            self.units.say(far, "m", 2),
            self.units.say(gone_m, "m", 2)
        )
    }
}

/// Angle of a velocity above the horizontal.
fn slope(above_deg: f64) -> String {
    format!("{:.1}° {} the horizontal", above_deg.abs(), if above_deg < 0.0 { "below" } else { "above" })
}
