//! Summary of one run: peaks with their times, 3 ms levels, first contacts, energy balance, work of the integrator.
//!
//! A [`Summarizer`] is a [`crate::results::recorder::Recorder`]; it needs little memory. Peaks are taken at the
//! accepted steps; levels and measures with windows from readings at 10 kHz, linear in between. Nothing is filtered.

mod caveat;
mod compartment;
mod elements;
mod events;
mod excursion;
mod figures;
mod flight;
mod limits;
mod peak;
mod person;
mod searle;
mod signs;
mod slide;
mod strokes;
mod summarizer;
mod throw;

use crate::forces::table::InOrder;
use serde::Serialize;

use crash_measures::injury::Measure;

use crate::forces::table::Tables;
use crate::results::energy::EnergyCheck;

pub use caveat::Caveat;
pub use compartment::{Degree, Ejection, Exit, Side};
pub use events::Event;
pub(crate) use excursion::Excursion;
pub use figures::{Figure, word};
pub use limits::FigureLimit;
pub use peak::Peak;
pub use searle::Searle;
pub use summarizer::Summarizer;
pub use throw::{Landing, Launch, Throw, ThrowStart};

/// Summary of one run. Serialised, it is the output of `occupant run --json`; every name carries its unit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// The scenario's title.
    pub title: String,
    /// End of the run.
    pub status: RunStatus,
    /// Reason, if it did not complete.
    pub reason: Option<String>,
    /// Start of the run, s.
    pub start_s: f64,
    /// Time reached, s.
    pub reached_s: f64,
    /// Planned end, s.
    pub end_s: f64,
    /// Name of the occupant of accelerations, head excursion and measures; empty for a single occupant.
    #[serde(skip_serializing_if = "str::is_empty")]
    pub occupant: &'static str,
    /// Accelerometer readings at the centres of gravity.
    pub accelerations: Accelerations,
    /// Peaks of force elements.
    #[serde(flatten)]
    pub elements: Tables,
    /// Events of belts over several nodes: the first hundred.
    pub events: Vec<Event>,
    /// Number of further events.
    pub more_events: u64,
    /// First contacts of the parts of the body after the start.
    pub first_contacts: Vec<FirstContact>,
    /// Every first contact of a part of the body with a surface, in the order in which they happened.
    pub contacts: Vec<ContactBegin>,
    /// Largest contact force on each part of the body with contact, in the body's order.
    pub sphere_forces: Vec<SpherePeak>,
    /// Displacement of the head's centre since the start; none without a sphere `head`.
    pub head_excursion: Option<Excursion>,
    /// Dummy of the limits and risks.
    pub dummy: &'static str,
    /// Injury measures, by default with the Hybrid III nearest in mass and unfiltered.
    pub measures: Vec<Measure>,
    /// The same of the other occupants, by their names.
    #[serde(skip_serializing_if = "InOrder::is_empty")]
    pub others: InOrder<&'static str, Person>,
    /// Throws of struck bodies, by their names, in models with other frames than one vehicle's and space.
    #[serde(skip_serializing_if = "InOrder::is_empty")]
    pub throws: InOrder<&'static str, Throw>,
    /// Ejections from a vehicle, by the names of the bodies whose head, chest or pelvis left it.
    #[serde(skip_serializing_if = "InOrder::is_empty")]
    pub ejections: InOrder<&'static str, Ejection>,
    /// Reasons why results should not be quoted as they are.
    pub caveats: Vec<Caveat>,
    /// Energy balance.
    pub energy: EnergyCheck,
    /// Work of the integrator.
    pub solver: Solver,
}

impl Summary {
    /// The same summary of a run that ended in this way: results of an incomplete run count up to its end.
    pub fn ended(mut self, status: RunStatus, reason: Option<String>) -> Self {
        self.caveats.splice(..0, Caveat::of_ending(status, self.reached_s));
        Summary { status, reason, ..self }
    }
}

impl Summary {
    /// The same summary of a file with a part of a run, described by `text`: no result is of the whole run.
    pub fn of_part(mut self, text: String) -> Self {
        self.caveats.insert(0, Caveat::of_part(text));
        self
    }

    /// The same summary of a file that resumes a run at `from_s`.
    pub fn of_rest(mut self, from_s: f64) -> Self {
        self.caveats.insert(0, Caveat::of_rest(from_s, &self));
        self
    }
}

/// Results of one of several occupants.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Person {
    /// As [`Summary::accelerations`].
    pub accelerations: Accelerations,
    /// As [`Summary::head_excursion`].
    pub head_excursion: Option<Excursion>,
    /// As [`Summary::dummy`].
    pub dummy: &'static str,
    /// As [`Summary::measures`].
    pub measures: Vec<Measure>,
}

impl Person {
    /// Names of the results that are times for which `is_when` holds, or that belong to a window with such a start.
    fn figures_when(&self, is_when: impl Fn(f64) -> bool) -> Vec<String> {
        let a = &self.accelerations;
        let parts = [("head", &a.head), ("chest", &a.chest), ("pelvis", &a.pelvis)].into_iter();
        let times = parts.flat_map(|(part, own)| {
            let levels =
                [("three_ms_contiguous", own.three_ms_contiguous), ("three_ms_cumulative", own.three_ms_cumulative)];
            let levels = levels.map(|(name, level)| (name, level.map(|level| level.from_s)));
            let all = levels.into_iter().chain([("peak", Some(own.peak_time_s)), ("peak_time", Some(own.peak_time_s))]);
            all.map(move |(name, time_s)| (format!("{part}.{name}"), time_s))
        });
        let measures = self.measures.iter().filter_map(|measure| Some((measure.figure?.to_owned(), measure.from_s)));
        let then = times.chain(measures).filter(|(_, time_s)| time_s.is_some_and(&is_when));
        let mut names: Vec<String> = then.map(|(name, _)| name).collect();
        names.sort();
        names.dedup();
        names
    }
}

impl Summary {
    /// All occupants by the prefix of their results: empty for a single one, else the name and a dot.
    pub fn people(&self) -> Vec<(String, Person)> {
        let first = Person {
            accelerations: self.accelerations,
            head_excursion: self.head_excursion,
            dummy: self.dummy,
            measures: self.measures.clone(),
        };
        let prefix = |name: &str| if name.is_empty() { String::new() } else { format!("{name}.") };
        let others = self.others.iter().map(|(name, person)| (prefix(name), person.clone()));
        std::iter::once((prefix(self.occupant), first)).chain(others).collect()
    }
}

/// End of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RunStatus {
    /// At its end time.
    Completed,
    /// Interrupted.
    Interrupted,
    /// The integration failed.
    Failed,
}

/// Resultant accelerometer readings (acceleration minus gravity) of the three parts that have limits.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Accelerations {
    /// Segment 3.
    pub head: Acceleration,
    /// Segment 2, the upper torso.
    pub chest: Acceleration,
    /// Segment 4, the lower torso.
    pub pelvis: Acceleration,
}

/// A resultant acceleration. One g is 9.80665 m/s².
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Acceleration {
    /// Peak.
    pub peak_m_s2: f64,
    /// Peak in g.
    pub peak_g: f64,
    /// Time of the peak.
    pub peak_time_s: f64,
    /// Level held for 3 ms without interruption; none in a shorter run.
    pub three_ms_contiguous: Option<Level>,
    /// Level exceeded for 3 ms in total.
    pub three_ms_cumulative: Option<Level>,
}

/// A level held for a time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Level {
    /// The level.
    pub level_m_s2: f64,
    /// Level in g.
    pub level_g: f64,
    /// Start of the interval above it, the first of them where the time is cumulative.
    pub from_s: f64,
    /// End of the interval above it, the last of them where the time is cumulative.
    pub to_s: f64,
}

/// First contact of a part of the body after the start of the run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FirstContact {
    /// Name of the part; without a full set of spheres, that of its one sphere.
    pub sphere: String,
    /// The contact; none without any new contact.
    pub contact: Option<ContactBegin>,
}

/// First contact of a part of the body with a surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ContactBegin {
    /// Name of the part of the body.
    pub part: String,
    /// Name of its sphere.
    pub sphere: String,
    /// Name of the surface.
    pub surface: String,
    /// Time, s; the start of the run for contacts at the start.
    pub time_s: f64,
    /// Speed of the sphere's centre relative to the surface, m/s; NaN in files of version 0.1.0.
    pub speed_m_s: f64,
    /// Its component towards the surface, m/s.
    pub closing_m_s: f64,
    /// Whether the contact exists at the start.
    pub at_start: bool,
}

/// Largest contact force on a part of the body: vector sum of normal, edge and friction forces of all surfaces on all
/// its spheres, without other elements.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SpherePeak {
    /// Name of the part; without a full set of spheres, that of its one sphere.
    pub sphere: String,
    /// Largest force.
    pub force_n: f64,
    /// Its time, s.
    pub time_s: f64,
    /// Surface with the largest normal force at that time.
    pub surface: String,
    /// Largest contact penetration Δ at any time, m. Not a deflection of the body, which is rigid.
    pub penetration_m: f64,
    /// Its time, s.
    pub penetration_time_s: f64,
    /// Largest penetration of a solid as a fraction of its thickness there; 0 without contact of a solid of finite
    /// thickness.
    pub thickness_used: f64,
}

/// Work of the integrator.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Solver {
    /// Name of the integrator.
    pub integrator: &'static str,
    /// Accepted steps.
    pub steps: u64,
    /// Steps tried and rejected.
    pub rejected: u64,
    /// Evaluations of the derivative.
    pub evaluations: u64,
    /// Outputs recorded.
    pub outputs: usize,
    /// Run time, given by the caller, s; none if not measured.
    pub wall_time_s: Option<f64>,
}

#[cfg(test)]
mod tests;
