//! The recorder that makes a [`Summary`].

use crate::forces::table::InOrder;

use super::compartment::Compartment;
use super::elements::Elements;
use super::events::Events;
use super::flight::Flight;
use super::person::Watched;
use super::signs::Signs;
use super::{Caveat, ContactBegin, Ejection, FirstContact, Person, RunStatus, Solver, SpherePeak, Summary, word};
use crate::body::{Body, ContactSphere};
use crate::forces::bag::Bag;
use crate::forces::chain::{Chain, plain_laps};
use crate::kernel::instruments::{READINGS, Reading};
use crate::model::Model;
use crate::model::settle::Settled;
use crate::model::setup::{Setup, TimeSpan};
use crate::results::fine::Fine;
use crate::results::outcome::{Outcome, Status};
use crate::results::peaks::{PartPeak, Peaks};
use crate::results::recorder::{Flow, Recorder, RecorderError};
use crate::results::sample::Sample;
use crash_measures::injury::{self, Measure, Options, Signals};

/// Relative change without every second reading above which measures get a caveat. The change is about the error: see
/// `measures.md`.
const COARSE: f64 = 0.01;

/// Collects a [`Summary`]. Allocates at the start of a run and at its end, never between.
#[derive(Clone, Debug, Default)]
pub struct Summarizer {
    options: Options,
    case: Option<Case>,
    outputs: usize,
    /// By body with a head, a chest or a pelvis; at least one.
    pub(super) people: Vec<Watched>,
    flights: Vec<Flight>,
    compartments: Vec<Compartment>,
    elements: Elements,
    events: Events,
    /// Largest values at all accepted steps (at outputs for a run whose steps were not recorded); and those at the
    /// latest output.
    seen: Peaks,
    now: Peaks,
    /// Whether they are those of steps.
    are_of_steps: bool,
    /// Readings not yet sorted by signal; time and readings of the latest output.
    fine: Fine,
    latest_s: f64,
    latest: Vec<Reading<f64>>,
    outcome: Option<Outcome>,
    signs: Signs,
}

/// Data of a run before its start.
#[derive(Clone, Debug)]
struct Case {
    title: String,
    body: Body,
    /// Touchable objects: surfaces, solids, and with contact of the body with itself the parts of its spheres.
    surfaces: Vec<String>,
    meets_itself: bool,
    chains: Vec<Chain>,
    bags: Vec<Bag>,
    /// Whether there is any geometry at rest outside vehicles.
    has_ground: bool,
    /// Whether parts of the body may be missing, as on a rig.
    is_on_rig: bool,
    /// [`Joints::is_half_a_neck`](crate::forces::joint::Joints::is_half_a_neck).
    is_half_a_neck: bool,
    /// By name: bodies that are not at rest at the start.
    unbalanced: Vec<(&'static str, Settled)>,
    integrator: &'static str,
    time: TimeSpan,
    names_hash: u64,
}

impl Case {
    /// Caveats of bodies that are not at rest at the start, with the results of the affected time.
    fn caveats_of_start(&self, people: &[(&'static str, Person, &Signals)], touched: &[SpherePeak]) -> Vec<Caveat> {
        let is_early = |time_s: f64| time_s < self.time.start_s + Settled::FADES_S;
        let one = |(name, left): &(&'static str, Settled)| {
            let prefix = if name.is_empty() { String::new() } else { format!("{name}.") };
            let own = people.iter().filter(|(person, ..)| person == name);
            let mut early: Vec<String> = own
                .flat_map(|(_, person, _)| person.figures_when(is_early))
                .map(|figure| prefix.clone() + &figure)
                .collect();
            let own = touched.iter().filter(|touch| touch.sphere.starts_with(&prefix) && is_early(touch.time_s));
            early.extend(own.map(|touch| format!("contacts.{}.*", word(&touch.sphere))));
            Caveat::unbalanced(left, early).with_subject(name)
        };
        self.unbalanced.iter().map(one).collect()
    }
}

impl Summarizer {
    /// Empty summarizer.
    pub fn new() -> Self {
        Summarizer::default()
    }

    /// Empty summarizer with other measures, limits and filters.
    pub fn judging(options: Options) -> Self {
        Summarizer { options, ..Summarizer::default() }
    }

    /// Summary of the run that has ended; `None` before its end. `wall_time_s` is measured by the caller.
    pub fn summary(&self, wall_time_s: Option<f64>) -> Option<Summary> {
        let (outcome, case) = (self.outcome.as_ref()?, self.case.as_ref()?);
        let time = &case.time;
        let peaks = self.peaks();
        let people = self.persons(&peaks);
        let signs = self.signs.with_steps(&self.elements, &peaks, &case.body);
        let caveats = self.caveats(case, &signs, &people, outcome.time_s);
        let sphere_forces = sphere_forces(case, &peaks);
        let unbalanced = case.caveats_of_start(&people, &sphere_forces);
        let on_rigid: Vec<_> = sphere_forces.iter().filter_map(|one| Caveat::on_rigid(&case.body, one)).collect();
        let ejections = self.ejections(case);
        let by_chance = Self::by_chance(&people, &ejections);
        let mut people = people.into_iter().map(|(name, person, _)| (name, person));
        let (occupant, Person { accelerations, head_excursion, dummy, measures }) = people.next()?;
        let contacts = contacts(outcome, case);
        let throws: InOrder<_, _> =
            self.flights.iter().filter_map(|flight| Some((flight.name, flight.throw(&case.body.spheres)?))).collect();
        let on_the_way = throws.iter().filter_map(|(name, throw)| Caveat::not_at_rest(name, throw));
        let (status, reason) = ending(&outcome.status);
        let summary = Summary {
            title: case.title.clone(),
            status: RunStatus::Completed,
            reason: None,
            start_s: time.start_s,
            reached_s: outcome.time_s,
            end_s: time.end_s,
            occupant,
            accelerations,
            elements: self.elements.tables(&peaks.elements),
            events: self.events.list(),
            more_events: self.events.more(),
            first_contacts: first_contacts(&contacts, &case.body),
            contacts,
            sphere_forces,
            head_excursion,
            dummy,
            measures,
            others: people.collect(),
            caveats: Caveat::of_balance(&outcome.energy)
                .into_iter()
                .chain(Caveat::of_rough_balance(&outcome.energy))
                .chain(caveats)
                .chain(unbalanced)
                .chain(on_rigid)
                .chain(Self::unmet(case, &ejections))
                .chain(by_chance)
                .chain(on_the_way)
                .collect(),
            throws,
            ejections,
            energy: outcome.energy,
            solver: Solver {
                integrator: case.integrator,
                steps: outcome.effort.steps,
                rejected: outcome.effort.rejected,
                evaluations: outcome.effort.evaluations,
                outputs: self.outputs,
                wall_time_s,
            },
        };
        Some(summary.ended(status, reason))
    }

    /// Largest values of the whole run.
    fn peaks(&self) -> Peaks {
        let mut peaks = self.seen.clone();
        peaks.merge(&self.now);
        peaks
    }

    /// All bodies with results, with the signals of their measures.
    fn persons(&self, peaks: &Peaks) -> Vec<(&'static str, Person, &Signals)> {
        self.people.iter().map(|one| (one.name, one.person(&self.options, peaks), &one.signals)).collect()
    }

    /// Ejections by body.
    fn ejections(&self, case: &Case) -> InOrder<&'static str, Ejection> {
        let all = self.compartments.iter();
        all.filter_map(|of| Some((of.name, of.ejection(&case.body.spheres, &case.surfaces)?))).collect()
    }

    /// Caveats of ejected bodies: on their verdict, throw, and results of later times.
    fn by_chance(
        people: &[(&'static str, Person, &Signals)],
        ejections: &InOrder<&'static str, Ejection>,
    ) -> Vec<Caveat> {
        let one = |(name, ejection): (&&'static str, &Ejection)| {
            let from_s = ejection.parts.first()?.time_s;
            let own = people.iter().filter(|(person, ..)| person == name);
            let later = own.flat_map(|(_, person, _)| person.figures_when(|time_s| time_s >= from_s)).collect();
            Some(Caveat::by_chance(ejection, later)?.of_occupant(name))
        };
        ejections.iter().filter_map(one).collect()
    }

    /// Parts that left a compartment where there is no geometry outside.
    fn unmet(case: &Case, ejections: &InOrder<&'static str, Ejection>) -> Vec<Caveat> {
        let all = ejections.values().filter(|_| !case.has_ground).flat_map(|ejection| &ejection.parts);
        let tree = &case.body.tree;
        let is_measured = |sphere: &ContactSphere| {
            let marks = &tree.bodies()[tree.body_of(sphere.segment)].landmarks;
            marks.instruments().contains(&Some(sphere.segment))
        };
        let spheres = || case.body.spheres.iter();
        let sphere = |part: &str| spheres().position(|sphere| sphere.part == part && is_measured(sphere));
        all.filter_map(|exit| Some(Caveat::left_compartment(&case.body, sphere(&exit.part)?, exit))).collect()
    }

    /// Caveats of the outputs, then those of necks and of measures alone.
    fn caveats(
        &self,
        case: &Case,
        signs: &Signs,
        people: &[(&'static str, Person, &Signals)],
        reached_s: f64,
    ) -> Vec<Caveat> {
        let mut caveats = signs.caveats(&case.body, &case.surfaces, &case.chains, &case.bags);
        caveats.extend(case.is_half_a_neck.then(Caveat::half_a_neck));
        caveats.extend(case.body.chests.iter().map(Caveat::of_chest));
        caveats.extend(case.body.sides.iter().map(Caveat::of_sides));
        caveats.extend(plain_laps(&case.chains, &case.body).map(|(chain, _)| Caveat::submarining_unseen(chain)));
        for (one, (name, person, signals)) in self.people.iter().zip(people) {
            let (measures, options) = (&person.measures, one.options(&self.options));
            let off = injury::coarseness(signals, &options, measures);
            let off: Vec<_> = measures.iter().zip(off).filter(|(_, off)| *off > COARSE).collect();
            let cut: Vec<_> = measures.iter().filter(|m| is_cut_off(m, reached_s - signals.interval_s)).collect();
            let own = [
                Caveat::cut_off(reached_s, &cut),
                Caveat::too_coarse(signals.interval_s, &off, self.are_of_steps),
                if case.is_on_rig { None } else { Caveat::other_dummy(options.dummy, one.mass_kg, measures) },
            ];
            caveats.extend(own.into_iter().flatten().map(|caveat| caveat.of_occupant(name)));
        }
        caveats
    }

    fn see_steps(&mut self, sample: &Sample<'_>) {
        self.are_of_steps = !sample.step_peaks.are_unknown();
        self.now.take_over(sample.now);
        if self.are_of_steps {
            self.seen.take_over(sample.step_peaks);
            self.fine.go_on_with(sample.fine);
        } else {
            self.seen.merge(sample.now);
            self.fine.see_output(sample);
        }
        if self.fine.is_full() {
            self.take_readings();
        }
        self.latest_s = sample.time_s;
        self.latest.clone_from_slice(sample.readings);
    }
}

impl Summarizer {
    /// Sorts the readings by signal.
    fn take_readings(&mut self) {
        for (place, one) in self.people.iter_mut().enumerate() {
            one.take(place, &self.fine);
        }
        self.fine.clear();
    }
}

/// Largest forces on the parts with contact.
fn sphere_forces(case: &Case, peaks: &Peaks) -> Vec<SpherePeak> {
    let named = case.body.parts().zip(&peaks.parts).filter(|(_, track)| track.force.value > 0.0);
    let one = |(part, track): (&str, &PartPeak)| SpherePeak {
        sphere: part.to_owned(),
        force_n: track.force.value,
        time_s: track.force.time_s,
        surface: case.surfaces[track.surface].clone(),
        penetration_m: track.penetration.value.max(0.0),
        penetration_time_s: track.penetration.time_s,
        thickness_used: track.used,
    };
    named.map(one).collect()
}

impl Recorder for Summarizer {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        let setup = model.setup();
        let case = Case {
            title: setup.title.clone(),
            body: setup.body.clone(),
            surfaces: touchable(setup),
            meets_itself: setup.self_contact.is_some(),
            chains: setup.chains.clone(),
            bags: setup.bags.clone(),
            has_ground: has_ground(setup),
            is_on_rig: setup.is_on_rig(),
            is_half_a_neck: setup.joints.is_half_a_neck(),
            unbalanced: unbalanced(model),
            integrator: setup.integrator.name(),
            time: setup.time,
            names_hash: model.names_hash(),
        };
        let (elements, fine) = (Elements::new(model), Fine::new(model).with_room());
        let bodies = model.system().instruments.len();
        let none = Peaks::none(elements.count(), bodies, setup.body.parts().count());
        *self = Summarizer {
            people: Watched::all(model, &fine),
            flights: Flight::all(model),
            compartments: Compartment::all(model),
            options: self.options,
            elements,
            events: Events::new(model),
            seen: none.clone(),
            now: none,
            fine,
            latest: vec![[f64::NAN; READINGS]; bodies],
            signs: Signs::new(model),
            case: Some(case),
            ..Summarizer::default()
        };
        Ok(())
    }

    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        if self.case.as_ref().is_none_or(|case| case.names_hash != sample.model.names_hash()) {
            return Err("a summarizer begins with the run that it sums up: `Recorder::begin`".into());
        }
        self.outputs += 1;
        self.see_steps(sample);
        self.events.see(sample);
        self.signs.see(sample);
        self.flights.iter_mut().for_each(|flight| flight.see(sample));
        self.compartments.iter_mut().for_each(|compartment| compartment.see(sample));
        Ok(Flow::Continue)
    }

    fn end(&mut self, outcome: &Outcome) -> Result<(), RecorderError> {
        if self.are_of_steps {
            // up to the end of the run, which may lie within a step
            self.fine.see(self.latest_s, &self.latest, &[]);
        }
        self.take_readings();
        let (peaks, are_of_steps) = (self.peaks(), self.are_of_steps);
        self.people.iter_mut().for_each(|one| one.complete(&peaks, are_of_steps));
        self.outcome = Some(outcome.clone());
        Ok(())
    }
}

/// Bodies that are not at rest at the start.
fn unbalanced(model: &Model) -> Vec<(&'static str, Settled)> {
    let all = if model.alone().is_empty() { std::slice::from_ref(model) } else { model.alone() };
    let left = all.iter().map(|alone| alone.start().unsettled.or(alone.start().settled));
    let bodies = model.body().tree.bodies().into_iter().map(|body| body.name);
    bodies.zip(left).filter_map(|(name, left)| Some((name, left.filter(Settled::is_unbalanced)?))).collect()
}

/// Names of surfaces and solids, and of the parts whose spheres others can touch.
fn touchable(setup: &Setup) -> Vec<String> {
    let fixed = setup.surfaces.len() + setup.solids.len();
    let parts = setup.self_contact.iter().flat_map(|_| setup.body.spheres.iter().map(|sphere| sphere.part.as_str()));
    setup.surface_names().take(fixed).chain(parts).map(str::to_owned).collect()
}

/// Whether any surface or solid is at rest.
fn has_ground(setup: &Setup) -> bool {
    let frames = setup.surfaces.iter().map(|own| own.frame).chain(setup.solids.iter().map(|own| own.frame));
    frames.into_iter().any(|frame| setup.is_ground(setup.belongs_to(frame)))
}

/// Whether the window of a measure's maximum ends after `last_s`, and its value is relevant compared with the limits.
fn is_cut_off(measure: &Measure, last_s: f64) -> bool {
    let is_window = measure.from_s.zip(measure.to_s).is_some_and(|(from_s, to_s)| from_s < to_s && to_s > last_s);
    let value = measure.value.unwrap_or(0.0);
    is_window && measure.limits.iter().any(|limit| value > COARSE * limit.most)
}

/// First contacts by part; a contact of two parts of the body counts for both.
fn contacts(outcome: &Outcome, case: &Case) -> Vec<ContactBegin> {
    let spheres = &case.body.spheres;
    let mut list: Vec<ContactBegin> = Vec::new();
    for touch in &outcome.first_touches {
        let fixed = case.surfaces.len().saturating_sub(spheres.len());
        let other = touch.surface.checked_sub(fixed).filter(|_| case.meets_itself);
        let both = [Some((touch.sphere, touch.surface)), other.map(|other| (other, fixed + touch.sphere))];
        for (sphere, surface) in both.into_iter().flatten() {
            let (sphere, surface) = (&spheres[sphere], &case.surfaces[surface]);
            if list.iter().all(|known| known.part != sphere.part || known.surface != *surface) {
                list.push(ContactBegin {
                    part: sphere.part.clone(),
                    sphere: sphere.name.clone(),
                    surface: surface.clone(),
                    time_s: touch.time_s,
                    speed_m_s: touch.speed_m_s,
                    closing_m_s: touch.closing_m_s,
                    at_start: touch.time_s <= case.time.start_s,
                });
            }
        }
    }
    list
}

fn first_contacts(contacts: &[ContactBegin], body: &Body) -> Vec<FirstContact> {
    let first = |part: &str| FirstContact {
        sphere: part.to_owned(),
        contact: contacts.iter().find(|c| c.part == part && !c.at_start).cloned(),
    };
    body.parts().map(first).collect()
}

fn ending(status: &Status) -> (RunStatus, Option<String>) {
    match status {
        Status::Completed => (RunStatus::Completed, None),
        Status::Stopped => (RunStatus::Interrupted, Some("stopped before its end time".to_owned())),
        Status::Failed(error) => (RunStatus::Failed, Some(error.to_string())),
    }
}
