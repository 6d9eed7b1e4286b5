//! All measures of a run as one flat list: for tables of many runs, for studies, for fits.

use std::collections::HashSet;

use occupant_units::unit::Unit::{
    self, Joule, Metre, MetrePerSecond, MetrePerSecondSquared, Newton, One, Radian, Second,
};

use super::{Acceleration, Excursion, FirstContact, Level, Person, Summary, Throw};
use crate::forces::table::{Cell, Table};
use crate::model::Model;

/// One result of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Dotted name without blanks, e.g. `head.peak`. In names of elements and spheres, characters other than letters,
    /// digits, `_` and `-` become `_`.
    pub name: String,
    /// Unit; `1` for a dimensionless number.
    pub unit: &'static str,
    /// Value; none if the run has none, such as the time of a contact that did not occur.
    pub value: Option<f64>,
}

impl Figure {
    /// Whether it describes the computation and the end of the run, not the motion.
    pub fn is_of_work(&self) -> bool {
        self.name.starts_with("solver.") || self.name.starts_with("run.")
    }
}

impl Summary {
    /// Every result of this summary of a run of `model`. Names and their order depend only on the force elements and
    /// spheres of the model, so they are the same for all runs of a study.
    pub fn figures(&self, model: &Model) -> Vec<Figure> {
        let mut list = List::default();
        let people = self.people();
        for (prefix, Person { accelerations: a, .. }) in &people {
            for (part, readings) in [("head", &a.head), ("chest", &a.chest), ("pelvis", &a.pelvis)] {
                list.acceleration(&format!("{prefix}{part}"), readings);
            }
        }
        self.list_elements(&mut list);
        self.list_contacts(&mut list, model);
        for (prefix, Person { head_excursion, measures, .. }) in &people {
            if model.body().sphere(&format!("{prefix}head")).is_some() {
                list.excursion(prefix, head_excursion.as_ref());
            }
            for measure in measures {
                // those of the accelerations stand above
                let new = measure.figure.map(|name| format!("{prefix}{name}")).filter(|name| !list.has(name));
                if let Some(name) = new {
                    list.add(name, measure.unit, measure.value);
                }
            }
        }
        for body in model.body().tree.bodies().iter().filter(|_| model.setup().is_open()) {
            let prefix = if body.name.is_empty() { String::new() } else { format!("{}.", body.name) };
            list.throw(&prefix, self.throws.get(body.name));
            let ejection = self.ejections.get(body.name);
            list.add(format!("{prefix}ejection.parts"), One, ejection.map_or(0.0, |out| out.parts.len() as f64));
            let first_s = ejection.and_then(|out| Some(out.parts.first()?.time_s));
            list.add(format!("{prefix}ejection.first_time"), Second, first_s);
            list.add(format!("{prefix}ejection.complete_time"), Second, ejection.and_then(|out| out.complete_s));
        }
        list.add("run.reached", Second, self.reached_s);
        list.add("energy.balance_error", One, self.energy.balance_error);
        list.add("energy.greatest_kinetic", Joule, self.energy.greatest_kinetic_j);
        list.add("solver.steps", One, self.solver.steps as f64);
        list.add("solver.rejected", One, self.solver.rejected as f64);
        list.add("solver.evaluations", One, self.solver.evaluations as f64);
        list.add("solver.outputs", One, self.solver.outputs as f64);
        list.figures
    }

    fn list_elements(&self, list: &mut List) {
        for (of, Table { columns, rows }) in &self.elements {
            for row in rows {
                let name = row.values().next().and_then(Cell::text).unwrap_or_default();
                for (column, cell) in columns.iter().zip(row.values()) {
                    if let Some((measure, unit)) = column.measure {
                        list.add(format!("{of}.{}.{measure}", word(name)), unit, cell.number());
                    }
                }
            }
        }
    }

    /// Largest force on every part of the body, 0 without contact, and its first contact.
    fn list_contacts(&self, list: &mut List, model: &Model) {
        for part in model.body().parts() {
            let name = format!("contacts.{}", word(part));
            let peak = self.sphere_forces.iter().find(|p| p.sphere == part);
            list.add(format!("{name}.peak"), Newton, peak.map_or(0.0, |p| p.force_n));
            list.add(format!("{name}.peak_time"), Second, peak.map(|p| p.time_s));
            let depth_m = peak.map_or(0.0, |p| p.penetration_m);
            list.add(format!("{name}.penetration"), Metre, depth_m);
            let first = self.first_contacts.iter().find(|f| f.sphere == part);
            if let Some(FirstContact { contact, .. }) = first {
                let contact = contact.as_ref();
                list.add(format!("{name}.first_time"), Second, contact.map(|c| c.time_s));
                list.add(format!("{name}.first_speed"), MetrePerSecond, contact.map(|c| c.speed_m_s));
                list.add(format!("{name}.first_closing"), MetrePerSecond, contact.map(|c| c.closing_m_s));
            }
        }
    }
}

/// The list being made.
#[derive(Default)]
struct List {
    figures: Vec<Figure>,
    names: HashSet<String>,
}

impl List {
    fn has(&self, name: &str) -> bool {
        self.names.contains(name)
    }

    fn add(&mut self, name: impl Into<String>, unit: Unit, value: impl Into<Option<f64>>) {
        let mut name = name.into();
        // two names that differ only in characters that stand as `_`
        while self.has(&name) {
            name.push('_');
        }
        self.names.insert(name.clone());
        let value = value.into().filter(|x| x.is_finite());
        self.figures.push(Figure { name, unit: unit.symbol(), value });
    }

    fn acceleration(&mut self, part: &str, readings: &Acceleration) {
        let level = |level: Option<Level>| level.map(|l| l.level_m_s2);
        self.add(format!("{part}.peak"), MetrePerSecondSquared, readings.peak_m_s2);
        self.add(format!("{part}.peak_time"), Second, readings.peak_time_s);
        let held = level(readings.three_ms_contiguous);
        self.add(format!("{part}.three_ms_contiguous"), MetrePerSecondSquared, held);
        let total = level(readings.three_ms_cumulative);
        self.add(format!("{part}.three_ms_cumulative"), MetrePerSecondSquared, total);
    }

    /// Throw of a body; results without values if it was not thrown.
    fn throw(&mut self, prefix: &str, throw: Option<&Throw>) {
        let launch = throw.and_then(|throw| throw.launch.as_ref());
        let landing = throw.and_then(|throw| throw.landing.as_ref());
        let searle = throw.and_then(|throw| throw.searle.as_ref());
        let figures = [
            ("struck_time", Second, throw.map(|t| t.struck_s)),
            ("distance", Metre, throw.map(|t| t.distance_m)),
            ("height", Metre, throw.map(|t| t.height_m)),
            ("end_speed", MetrePerSecond, throw.map(|t| t.end_speed_m_s)),
            ("landing_time", Second, landing.map(|l| l.time_s)),
            ("landing_distance", Metre, landing.map(|l| l.distance_m)),
            ("landing_speed", MetrePerSecond, landing.map(|l| l.speed_m_s)),
            ("launch_time", Second, launch.map(|l| l.time_s)),
            ("launch_speed", MetrePerSecond, launch.map(|l| l.speed_m_s)),
            ("launch_angle", Radian, launch.map(|l| l.angle_deg.to_radians())),
            ("airborne_distance", Metre, throw.and_then(|t| t.airborne_m)),
            ("slide_distance", Metre, throw.and_then(|t| t.slide_m)),
            ("from_launch", Metre, throw.and_then(|t| t.from_launch_m)),
            ("searle_least_speed", MetrePerSecond, searle.map(|s| s.speeds_m_s[0])),
            ("searle_greatest_speed", MetrePerSecond, searle.map(|s| s.speeds_m_s[1])),
            ("drag_factor", One, searle.and_then(|s| s.drag_factor)),
        ];
        for (name, unit, value) in figures {
            self.add(format!("{prefix}throw.{name}"), unit, value);
        }
    }

    fn excursion(&mut self, prefix: &str, of: Option<&Excursion>) {
        for (way, peak) in of.copied().unwrap_or(Excursion::NONE).ways() {
            self.add(format!("{prefix}head_excursion.{way}"), Metre, peak.value);
            self.add(format!("{prefix}head_excursion.{way}_time"), Second, peak.time_s);
        }
    }
}

/// Name of an element or sphere as one word of a dotted name.
pub fn word(name: &str) -> String {
    let plain = |c: char| if c.is_alphanumeric() || c == '_' || c == '-' { c } else { '_' };
    name.chars().map(plain).collect()
}
