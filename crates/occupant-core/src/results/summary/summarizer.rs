//! The recorder that makes a [`Summary`].

use nalgebra::{Point3, Vector3};

use super::elements::ElementPeaks;
use super::signs::Signs;
use super::{
    Acceleration, Accelerations, Caveat, ContactBegin, Excursion, FirstContact, Level, Peak, RunStatus, Solver,
    SpherePeak, Summary,
};
use crate::body::Body;
use crate::model::Model;
use crate::model::setup::{STANDARD_GRAVITY_M_S2, TimeSpan};
use crate::results::outcome::{FirstTouch, Outcome, Status};
use crate::results::recorder::{Flow, Recorder, RecorderError};
use crate::results::sample::Sample;
use crash_measures::injury::{self, Measure, Options, Readings, Signals};
use crash_measures::measure::ThreeMs;

/// Spheres whose first contacts are summarised.
const STRUCK: [&str; 4] = ["head", "chest", "left_knee", "right_knee"];

/// Measures that change by more of their value without every other output are not quoted to a per cent.
const COARSE: f64 = 0.02;

/// Collects a [`Summary`]. Allocates at the start of a run and at its end, never between.
#[derive(Clone, Debug, Default)]
pub struct Summarizer {
    options: Options,
    case: Option<Case>,
    head: Option<usize>,
    outputs: usize,
    /// Of head, chest and pelvis.
    accelerations: [Option<Peak>; 3],
    elements: ElementPeaks,
    spheres: Vec<SphereTrack>,
    pub(super) signals: Signals,
    head_start: Option<Point3<f64>>,
    /// Of the head.
    excursion: Option<Excursion>,
    outcome: Option<Outcome>,
    signs: Signs,
}

/// What is known of a run before its start.
#[derive(Clone, Debug)]
struct Case {
    title: String,
    body: Body,
    surfaces: Vec<String>,
    integrator: &'static str,
    time: TimeSpan,
}

#[derive(Clone, Copy, Debug)]
struct SphereTrack {
    force: Peak,
    penetration: Peak,
    surface: usize,
}

impl Summarizer {
    /// Nothing seen yet.
    pub fn new() -> Self {
        Summarizer::default()
    }

    /// Nothing seen yet; measures will be compared with what `options` say.
    pub fn judging(options: Options) -> Self {
        Summarizer { options, ..Summarizer::default() }
    }

    /// The summary of the run that has ended; `None` before its end. `wall_time_s` is what the caller's clock says.
    pub fn summary(&self, wall_time_s: Option<f64>) -> Option<Summary> {
        let (outcome, case) = (self.outcome.as_ref()?, self.case.as_ref()?);
        let time = &case.time;
        let readings = Readings::new(&self.signals, &self.options);
        let parts = [&readings.head, &readings.chest, &readings.pelvis];
        let [head, chest, pelvis] = std::array::from_fn(|i| self.acceleration(i, parts[i], time));
        let contacts = contacts(outcome, case);
        let (status, reason) = ending(&outcome.status);
        let measures = readings.measures();
        let summary = Summary {
            title: case.title.clone(),
            status: RunStatus::Completed,
            reason: None,
            start_s: time.start_s,
            reached_s: outcome.time_s,
            end_s: time.end_s,
            accelerations: Accelerations { head, chest, pelvis },
            elements: self.elements.tables(),
            first_contacts: first_contacts(&contacts, &case.body),
            contacts,
            sphere_forces: self.sphere_forces(case),
            head_excursion: self.excursion,
            caveats: Caveat::of_balance(&outcome.energy).into_iter().chain(self.caveats(case, &measures)).collect(),
            measures,
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

    fn acceleration(&self, i: usize, levels: &injury::Acceleration, time: &TimeSpan) -> Acceleration {
        let peak = self.accelerations[i].unwrap_or(Peak { value: 0.0, time_s: time.start_s });
        let level = |held: &ThreeMs| Level {
            level_m_s2: held.level_mps2,
            level_g: in_g(held.level_mps2),
            from_s: self.signals.start_s + held.start_s,
            to_s: self.signals.start_s + held.end_s,
        };
        Acceleration {
            peak_m_s2: peak.value,
            peak_g: in_g(peak.value),
            peak_time_s: peak.time_s,
            three_ms_contiguous: levels.three_ms_contiguous.as_ref().ok().map(level),
            three_ms_cumulative: levels.three_ms_cumulative.as_ref().ok().map(level),
        }
    }

    /// What the outputs show of the body, then what is to know of measures alone.
    fn caveats(&self, case: &Case, measures: &[Measure]) -> Vec<Caveat> {
        let mut caveats = self.signs.caveats(&case.body, &case.surfaces);
        let off = injury::coarseness(&self.signals, &self.options, measures);
        let off: Vec<_> = measures.iter().zip(off).filter(|(_, off)| *off > COARSE).collect();
        let of_measures = [
            Caveat::too_coarse(self.signals.interval_s, &off),
            Caveat::other_dummy(self.options.dummy, case.body.mass_kg(), measures),
        ];
        caveats.extend(of_measures.into_iter().flatten());
        caveats
    }

    fn sphere_forces(&self, case: &Case) -> Vec<SpherePeak> {
        let named = case.body.spheres.iter().zip(&self.spheres);
        named
            .filter(|(_, track)| track.force.value > 0.0)
            .map(|(sphere, track)| SpherePeak {
                sphere: sphere.name.clone(),
                force_n: track.force.value,
                time_s: track.force.time_s,
                surface: case.surfaces[track.surface].clone(),
                penetration_m: track.penetration.value.max(0.0),
                penetration_time_s: track.penetration.time_s,
            })
            .collect()
    }

    fn see_accelerations(&mut self, sample: &Sample<'_>) {
        let marks = sample.model.body().tree.landmarks();
        for (peak, segment) in self.accelerations.iter_mut().zip([marks.head, marks.chest, marks.pelvis]) {
            peak.get_or_insert(Peak::NONE).see(sample.specific_force_m_s2(segment).norm(), sample.time_s);
        }
    }

    fn see_contacts(&mut self, sample: &Sample<'_>) {
        // touches come sphere by sphere or frame by frame: add up first, then compare
        for (sphere, track) in self.spheres.iter_mut().enumerate() {
            if !sample.actions.contacts.iter().any(|t| t.sphere == sphere) {
                continue;
            }
            let mut sum_n = Vector3::zeros();
            let mut hardest = Peak::NONE;
            let mut surface = 0;
            for contact in sample.contacts().filter(|c| c.sphere == sphere) {
                sum_n += contact.force_n;
                track.penetration.see(contact.depth_m, sample.time_s);
                if hardest.see(contact.normal_force_n, sample.time_s) {
                    surface = contact.surface;
                }
            }
            if track.force.see(sum_n.norm(), sample.time_s) {
                track.surface = surface;
            }
        }
    }

    fn see_head(&mut self, sample: &Sample<'_>) {
        let Some(head) = self.head else {
            return;
        };
        let place = sample.sphere_centre_m(head);
        let moved = place - *self.head_start.get_or_insert(place);
        let Excursion { forward, rearward, left, right, up, down } = self.excursion.get_or_insert(Excursion::NONE);
        let axes = [[forward, rearward], [right, left], [down, up]];
        for ([along, against], moved) in axes.into_iter().zip([moved.x, moved.y, moved.z]) {
            along.see(moved, sample.time_s);
            against.see(-moved, sample.time_s);
        }
    }
}

impl Recorder for Summarizer {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        let setup = model.setup();
        let case = Case {
            title: setup.title.clone(),
            body: setup.body.clone(),
            surfaces: setup.surface_names().map(str::to_owned).collect(),
            integrator: setup.integrator.name(),
            time: setup.time,
        };
        let sphere = SphereTrack { force: Peak::NONE, penetration: Peak::NONE, surface: 0 };
        *self = Summarizer {
            signals: begun(model)?,
            options: self.options,
            head: setup.body.sphere("head"),
            elements: ElementPeaks::new(model),
            spheres: vec![sphere; setup.body.spheres.len()],
            signs: Signs::new(model),
            case: Some(case),
            ..Summarizer::default()
        };
        Ok(())
    }

    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        self.outputs += 1;
        self.see_accelerations(sample);
        self.see_contacts(sample);
        self.elements.see(sample);
        self.see_head(sample);
        self.signs.see(sample);
        self.signals.record(sample)?;
        Ok(Flow::Continue)
    }

    fn end(&mut self, outcome: &Outcome) -> Result<(), RecorderError> {
        self.outcome = Some(outcome.clone());
        Ok(())
    }
}

fn contacts(outcome: &Outcome, case: &Case) -> Vec<ContactBegin> {
    let contact = |t: &FirstTouch| ContactBegin {
        sphere: case.body.spheres[t.sphere].name.clone(),
        surface: case.surfaces[t.surface].clone(),
        time_s: t.time_s,
        speed_m_s: t.speed_m_s,
        closing_m_s: t.closing_m_s,
        at_start: t.time_s <= case.time.start_s,
    };
    outcome.first_touches.iter().map(contact).collect()
}

fn first_contacts(contacts: &[ContactBegin], body: &Body) -> Vec<FirstContact> {
    let present = STRUCK.iter().filter(|name| body.sphere(name).is_some());
    let first = |name: &&str| FirstContact {
        sphere: (*name).to_owned(),
        contact: contacts.iter().find(|c| c.sphere == *name && !c.at_start).cloned(),
    };
    present.map(first).collect()
}

fn ending(status: &Status) -> (RunStatus, Option<String>) {
    match status {
        Status::Completed => (RunStatus::Completed, None),
        Status::Stopped => (RunStatus::Interrupted, Some("stopped before its end time".to_owned())),
        Status::Failed(error) => (RunStatus::Failed, Some(error.to_string())),
    }
}

/// Instruments with room for a whole run.
fn begun(model: &Model) -> Result<Signals, RecorderError> {
    let mut signals = Signals::new();
    signals.begin(model)?;
    Ok(signals)
}

fn in_g(acceleration_m_s2: f64) -> f64 {
    acceleration_m_s2 / STANDARD_GRAVITY_M_S2
}
