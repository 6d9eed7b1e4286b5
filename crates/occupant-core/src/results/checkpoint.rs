//! The complete memory of a run at an output, as plain data: a run resumed from it gives the same bits as an
//! uninterrupted one.
//!
//! It omits what follows from the scenario alone (β₀, L₀, the initial body): the model has it.

use crate::forces::stored::Archive;
use crate::forces::{Forces, History, Memory, Misfit, STORED};
use crate::model::Model;
use crate::motion::state::State;
use crate::quantity::FieldWords;
use crate::results::energy::{EnergyStart, Greatest, Rest};
use crate::results::outcome::{FirstTouch, Outcome, Status};
use crate::results::sample::{Effort, Switched};
use crate::results::told::{self, from_indices, to_indices};

/// A run at one of its outputs.
#[derive(Clone, Debug)]
pub struct Checkpoint {
    /// Index of the output, from 0.
    pub index: usize,
    /// Time, s.
    pub time_s: f64,
    /// Integrated state with its work sums: the numbers of a [`State`].
    pub state: Vec<f64>,
    /// Memory of the force elements, in the model's order.
    pub memory: Memory<f64>,
    /// First contacts so far, in order of time.
    pub first_touches: Vec<FirstTouch>,
    /// Largest values at the accepted steps so far, as plain numbers: [`Peaks`](super::peaks::Peaks); none if they were
    /// not recorded.
    pub peaks: Vec<f64>,
    /// State of the instrument readings at the step before: index of the next sample, its time, its readings.
    pub readings_before: Vec<f64>,
    /// Readings of instruments since the output before: [`Fine`](super::fine::Fine).
    pub readings: Vec<f32>,
    /// Events of force elements since the output before.
    pub events: Vec<Switched>,
    /// Sums and extremes.
    pub progress: Progress,
    /// Step of the error control that contains the output, if it continues beyond it.
    pub under_way: Option<StepStart>,
}

/// Equality to the bit, where instruments that a body lacks read NaN.
impl PartialEq for Checkpoint {
    fn eq(&self, other: &Self) -> bool {
        let same = |a: &[f64], b: &[f64]| a.iter().map(|x| x.to_bits()).eq(b.iter().map(|x| x.to_bits()));
        (self.index, self.time_s, &self.state) == (other.index, other.time_s, &other.state)
            && (&self.memory, &self.first_touches) == (&other.memory, &other.first_touches)
            && (&self.progress, &self.under_way) == (&other.progress, &other.under_way)
            && self.events == other.events
            && same(&self.peaks, &other.peaks)
            && same(&self.readings_before, &other.readings_before)
            && self.readings.iter().map(|x| x.to_bits()).eq(other.readings.iter().map(|x| x.to_bits()))
    }
}

/// A step that leads beyond an output, by its start: repeating it gives the same bits.
#[derive(Clone, Debug, PartialEq)]
pub struct StepStart {
    /// Its start, s.
    pub start_s: f64,
    /// Its end, s, after the output.
    pub end_s: f64,
    /// Numbers of the state at its start.
    pub state: Vec<f64>,
    /// Memory of the force elements there, in the model's order.
    pub memory: Memory<f64>,
}

/// A [`StepStart`] borrowed from the run.
#[derive(Clone, Copy, Debug)]
pub struct StepUnderWay<'a> {
    /// Start of the step, s.
    pub start_s: f64,
    /// Its end, s, after the output.
    pub end_s: f64,
    /// State at its start.
    pub state: &'a State<f64>,
    /// History of the force elements there.
    pub history: &'a History<f64>,
}

impl StepUnderWay<'_> {
    /// Copy as plain data.
    pub(crate) fn to_start(self) -> StepStart {
        let (state, memory) = (self.state.numbers().to_vec(), self.history.memory.clone());
        StepStart { start_s: self.start_s, end_s: self.end_s, state, memory }
    }
}

/// Sums and extremes of a run so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Progress {
    /// Work of the integrator.
    pub effort: Effort,
    /// Step that the error control has planned next, s.
    pub wanted_s: f64,
    /// Error of its last accepted step in units of the tolerance.
    pub step_error: f64,
    /// Reference energies of the balance.
    pub energy_start: EnergyStart,
    /// Largest energies so far.
    pub greatest: Greatest,
    /// State of rest of the bodies, for a run that ends at rest.
    pub rest: Rest,
}

impl Progress {
    #[rustfmt::skip]
    fn keep(&mut self, file: &mut dyn Archive) {
        file.count(words(15, "steps", "accepted steps so far"), &mut self.effort.steps);
        file.count(words(16, "rejected", "rejected steps so far"), &mut self.effort.rejected);
        file.count(words(17, "evaluations", "evaluations of the derivative so far"), &mut self.effort.evaluations);
        file.number(words(18, "last_step_s", "last accepted step"), &mut self.effort.step_s);
        file.number(words(19, "wanted_step_s", "step that the error control wants next"), &mut self.wanted_s);
        let start = &mut self.energy_start;
        file.number(words(20, "start_mechanical_j", "kinetic, gravity and spring energy at the start of the run"), &mut start.mechanical_j);
        for energy in STORED {
            if let Some(held) = energy.held_by {
                file.number(held.start, &mut start.stored_j[energy.at]);
            }
        }
        file.number(words(23, "greatest_kinetic_j", "largest kinetic energy relative to the vehicle so far"), &mut self.greatest.all.kinetic_j);
        file.number(words(24, "greatest_imbalance_j", "largest energy imbalance so far"), &mut self.greatest.all.imbalance_j);
        file.number(words(46, "greatest_work_j", "largest work of gravity and force elements so far"), &mut self.greatest.all.work_j);
        let own = file.numbers(words(64, "body_energies_j", "of several bodies, one behind the other: greatest kinetic energy relative to the vehicle, greatest work of gravity and force elements, and largest energy imbalance so far"), self.greatest.numbers());
        self.greatest.read(&own);
        file.number(words(56, "most_kinetic_j", "largest kinetic energy in space so far, of a run that ends at rest"), &mut self.rest.most_j);
        file.number(words(57, "still_since_s", "time since which the bodies are still, of a run that ends at rest; 1e30 while they are not"), &mut self.rest.since_s);
        file.number(words(25, "step_error", "error of the last accepted step in units of the tolerance"), &mut self.step_error);
    }
}

/// A checkpoint that does not belong to a model.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// Memory that does not fit the model's force elements.
    #[error(transparent)]
    Memory(#[from] Misfit),
    /// Time that does not fit its output, s.
    #[error("{}", other_time(*index, *found_s, *expected_s))]
    Time {
        /// Index of the output.
        index: usize,
        /// In the checkpoint.
        found_s: f64,
        /// In the model; none if the run has no such output.
        expected_s: Option<f64>,
    },
    /// An unfinished step that does not contain the output.
    #[error("the checkpoint of t = {time_s} s has a step under way from {start_s} s to {end_s} s")]
    Step {
        /// Its start, s.
        start_s: f64,
        /// Its end, s.
        end_s: f64,
        /// Time of the output, s.
        time_s: f64,
    },
    /// Readings, events and largest values of other elements, instruments or parts than the model's.
    #[error("the checkpoint has greatest values, readings or events that are not those of the scenario")]
    Readings,
    /// First contact of a sphere or surface that the model does not have.
    #[error("the checkpoint knows a touch of sphere {sphere} and surface {surface}, which the scenario does not have")]
    Touch {
        /// Index of the sphere.
        sphere: usize,
        /// Index of the surface.
        surface: usize,
    },
}

fn other_time(index: usize, found_s: f64, expected_s: Option<f64>) -> String {
    match expected_s {
        Some(expected_s) => format!(
            "the checkpoint of output {index} is of t = {found_s} s, the scenario's output {index} of t = {expected_s} s"
        ),
        None => format!("the checkpoint is output {index} at t = {found_s} s, and the scenario ends before it"),
    }
}

/// Description of `state` in files.
const STATE: &str = "in space axes, SI: T1; w, x, y, z of the free segments, the first and those on ball joints (of 12: middle_torso, \
upper_torso, head, lower_torso, left_upper_arm, right_upper_arm, left_thigh, right_thigh); hinges (of 12: left_forearm, right_forearm, \
left_lower_leg, right_lower_leg); velocity of T1; angular velocities of the free segments; hinge rates; work of contacts, friction, \
joints, belts, muscles, bags, columns, plates, vehicle: of 12 segments 79 numbers, 75 without the muscles, bags, columns and plates in files of 0.1.0; then the numbers of plates, bags and columns, each scaled to the order of 1";

const EVENTS: &str = "when something happened to force elements at the accepted steps since the output before, s";

const STEP: &str =
    "start and end of the step in which the output lies, if it goes on beyond it; the columns below tell its start";

const fn words(number: u32, stem: &'static str, meaning: &'static str) -> FieldWords {
    FieldWords { number, stem, meaning }
}

impl CheckpointError {
    /// Whether the values of the checkpoint have overflowed, and nothing else is wrong.
    pub fn is_blown_up(&self) -> bool {
        matches!(self, CheckpointError::Memory(Misfit::NotFinite))
    }
}

impl Checkpoint {
    /// Checkpoint from the fields of `file`; missing fields stay empty.
    pub fn stored(file: &mut dyn Archive) -> Self {
        let mut checkpoint = Checkpoint {
            index: 0,
            time_s: 0.0,
            state: Vec::new(),
            memory: Memory::none(),
            first_touches: Vec::new(),
            peaks: Vec::new(),
            readings_before: Vec::new(),
            readings: Vec::new(),
            events: Vec::new(),
            progress: Progress::default(),
            under_way: None,
        };
        checkpoint.keep(file);
        checkpoint
    }

    /// Reads or writes everything in a result file.
    pub fn keep(&mut self, file: &mut dyn Archive) {
        let mut index = self.index as u64;
        file.number(words(1, "time_s", "time of the scenario"), &mut self.time_s);
        file.count(words(2, "output", "number of the output, from 0"), &mut index);
        self.index = index as usize;
        self.state = file.numbers(words(3, "state", STATE), std::mem::take(&mut self.state));
        self.memory.keep(None, file);
        self.keep_touches(file);
        self.progress.keep(file);
        self.keep_seen(file);
        self.keep_step(file);
    }

    /// Results of the steps; files of 0.1.0 have none.
    fn keep_seen(&mut self, file: &mut dyn Archive) {
        // never written any more
        file.numbers(words(60, "step_peaks", "none: see greatest"), Vec::new());
        let peaks = "greatest values at the accepted steps so far, each with its time: what force elements track, what instruments of \
                     each body read, what each part of the body touches";
        let before = "the latest step: number of the next of the readings, its time, what instruments read there";
        let readings = "what instruments read since the output before, at equal times from the start of the run: of each body with \
                        any, in SAE J211 axes, accelerations of head, chest and pelvis (m/s²), angular velocity and acceleration of the \
                        head, force (N) and moment (N·m) of the neck, tension of the right and left femur (N); then what only some \
                        bodies and tests have: deflections of the chest, readings for side impact, loads of the lower legs, readings for \
                        rear impact";
        self.peaks = file.numbers(words(61, "greatest", peaks), std::mem::take(&mut self.peaks));
        let own = std::mem::take(&mut self.readings_before);
        self.readings_before = file.numbers(words(62, "readings_before", before), own);
        self.readings = file.singles(words(63, "readings", readings), std::mem::take(&mut self.readings));
        self.keep_events(file);
    }

    fn keep_events(&mut self, file: &mut dyn Archive) {
        let times_s = self.events.iter().map(|event| event.time_s).collect();
        let times_s = file.numbers(words(65, "event_times_s", EVENTS), times_s);
        let meaning =
            "of each event three numbers: place of its kind, of its element, of its words among those of the kind";
        let indices = file.indices(words(66, "events", meaning), to_indices(&self.events));
        match from_indices(&times_s, &indices) {
            Some(events) => self.events = events,
            None => file.refuse("events of force elements that this program does not know"),
        }
    }

    fn keep_touches(&mut self, file: &mut dyn Archive) {
        let touches = &self.first_touches;
        let spheres = touches.iter().map(|touch| touch.sphere as u32).collect();
        let surfaces = touches.iter().map(|touch| touch.surface as u32).collect();
        let times_s = touches.iter().map(|touch| touch.time_s).collect();
        let closing_m_s = touches.iter().map(|touch| touch.closing_m_s).collect();
        let speed_m_s = touches.iter().map(|touch| touch.speed_m_s).collect();
        let meaning = "index of the sphere of each first touch so far";
        let spheres = file.indices(words(11, "first_touch_sphere", meaning), spheres);
        let surfaces = file.indices(words(12, "first_touch_surface", "index of its surface"), surfaces);
        let times_s = file.numbers(words(13, "first_touch_time_s", "its time"), times_s);
        let closing_m_s = file.numbers(words(14, "first_touch_closing_m_s", "its closing speed"), closing_m_s);
        let speed_m_s = file.numbers(words(37, "first_touch_speed_m_s", "its speed"), speed_m_s);
        if [surfaces.len(), times_s.len(), closing_m_s.len()] != [spheres.len(); 3] {
            return file.refuse("lists of first touches that do not fit each other");
        }
        let touch = |(i, sphere): (usize, u32)| FirstTouch {
            sphere: sphere as usize,
            surface: surfaces[i] as usize,
            time_s: times_s[i],
            // files of 0.1.0 have none
            speed_m_s: speed_m_s.get(i).copied().unwrap_or(f64::NAN),
            closing_m_s: closing_m_s[i],
        };
        self.first_touches = spheres.into_iter().enumerate().map(touch).collect();
    }

    fn keep_step(&mut self, file: &mut dyn Archive) {
        let step = self.under_way.take();
        let (times_s, state, mut memory) = match step {
            Some(step) => (vec![step.start_s, step.end_s], step.state, step.memory),
            None => (Vec::new(), Vec::new(), Memory::none()),
        };
        let times_s = file.numbers(words(26, "step_times_s", STEP), times_s);
        file.begin_step();
        let state = file.numbers(words(27, "state", STATE), state);
        memory.keep(Some(&self.memory), file);
        match times_s[..] {
            [] => {}
            [start_s, end_s] => {
                self.under_way = Some(StepStart { start_s, end_s, state, memory });
            }
            _ => file.refuse("other than two times of a step"),
        }
    }

    /// Outcome of a run of `model` that ends here.
    pub fn outcome(&self, model: &Model) -> Outcome {
        Outcome {
            status: Status::Completed,
            time_s: self.time_s,
            effort: self.progress.effort,
            first_touches: self.first_touches.clone(),
            energy: self.progress.greatest.check(&model.masses_kg()),
        }
    }

    /// Whether a run of `model` can continue from here.
    ///
    /// # Errors
    /// The first thing that does not fit the model.
    pub fn check(&self, model: &Model) -> Result<(), CheckpointError> {
        self.check_at(model, true)
    }

    /// The same; `at_output`: whether it must be at one of the model's outputs.
    pub(crate) fn check_at(&self, model: &Model, at_output: bool) -> Result<(), CheckpointError> {
        let forces = &model.system().forces;
        self.memory.check_count(forces)?;
        Self::state_of(model, &self.state)?;
        let expected_s = model.output_time_s(self.index);
        // to the bit: a step from another time is another step
        let time = &model.setup().time;
        let is_right = if at_output {
            expected_s.map(f64::to_bits) == Some(self.time_s.to_bits())
        } else {
            (time.start_s..=time.end_s).contains(&self.time_s) && self.index <= model.output_count()
        };
        if !is_right {
            return Err(CheckpointError::Time { index: self.index, found_s: self.time_s, expected_s });
        }
        self.check_touches(model)?;
        if !told::fit(&self.events, forces) {
            return Err(CheckpointError::Readings);
        }
        if let Some(step) = &self.under_way {
            step.memory.check_count(forces)?;
            Self::state_of(model, &step.state)?;
            self.check_step(step, forces)?;
        }
        self.check_numbers(forces)
    }

    /// State of `model` with these numbers.
    ///
    /// # Errors
    /// Another number of them than the model's state has.
    pub fn state_of(model: &Model, numbers: &[f64]) -> Result<State<f64>, CheckpointError> {
        let (shape, of) = (model.start().state.shape(), "numbers of the state");
        let misfit = Misfit::Count { of, found: numbers.len(), expected: shape.len() };
        let mut numbers = numbers.to_vec();
        // older files have no work of plates, before that none of columns, then none of bags, those of 0.1.0 none of muscles; all stand before that of the
        // vehicle
        let missing = shape.len().saturating_sub(numbers.len());
        let owns_none = model.setup().bags.is_empty() && model.setup().columns.is_empty();
        if owns_none && model.alone().is_empty() && (1..=4).contains(&missing) {
            let vehicle = numbers.len() - 1;
            numbers.splice(vehicle..vehicle, vec![0.0; missing]);
        }
        State::from_numbers(shape, &numbers).ok_or(CheckpointError::Memory(misfit))
    }

    fn check_step(&self, step: &StepStart, forces: &Forces<f64>) -> Result<(), CheckpointError> {
        let &StepStart { start_s, end_s, .. } = step;
        let time_s = self.time_s;
        if start_s <= time_s && time_s < end_s && end_s.is_finite() {
            check_histories(&step.memory, &step.state, forces)
        } else {
            Err(CheckpointError::Step { start_s, end_s, time_s })
        }
    }

    fn check_touches(&self, model: &Model) -> Result<(), CheckpointError> {
        let (spheres, surfaces) = (model.body().spheres.len(), model.setup().surface_names().count());
        let strange = |t: &&FirstTouch| t.sphere >= spheres || t.surface >= surfaces;
        match self.first_touches.iter().find(strange) {
            Some(&FirstTouch { sphere, surface, .. }) => Err(CheckpointError::Touch { sphere, surface }),
            None => Ok(()),
        }
    }

    fn check_numbers(&self, forces: &Forces<f64>) -> Result<(), CheckpointError> {
        check_histories(&self.memory, &self.state, forces)?;
        let p = &self.progress;
        // energies may grow beyond all numbers, and a balance may be lost without end
        let numbers = [p.wanted_s, p.step_error, p.energy_start.mechanical_j];
        check_finite(numbers.into_iter().chain(p.energy_start.stored_j))
    }
}

fn check_histories(memory: &Memory<f64>, state: &[f64], forces: &Forces<f64>) -> Result<(), CheckpointError> {
    memory.check(forces)?;
    check_finite(state.iter().copied())
}

fn check_finite(numbers: impl IntoIterator<Item = f64>) -> Result<(), CheckpointError> {
    let are_finite = numbers.into_iter().all(f64::is_finite);
    are_finite.then_some(()).ok_or(CheckpointError::Memory(Misfit::NotFinite))
}
