//! Readings of the instruments at equal times, independent of the output interval; measures with windows use them.
//!
//! Instruments are read at the ends of steps, 10 to 20 thousand times a second during contact, and are linear in
//! between. Values at steps have the precision of an `f32`, in a run as in its file; values at outputs, from which
//! derivatives are made, have full precision.

use std::ops::Range;

use crate::kernel::instruments::{
    CHEST, CHEST_POINTS, PLACE, REAR, Reading, SIDE, SIDE_SIGNALS, TIBIA_SIGNALS, TIBIAE,
};
use crate::model::Model;
use crate::model::behind::restraints;
use crate::model::setup::Integrator;
use crate::results::rear;
use crate::results::sample::Sample;

/// Default interval of readings, s: as SAE J211 requires for CFC 1000.
pub const READINGS_S: f64 = 1e-4;

/// Count of numbers of one body in a sample: a reading without the head's position; then, if any body has a deformable
/// chest, its deflections; if any has sides that yield, [`SIDE_SIGNALS`]; if any has feet of its own, [`TIBIA_SIGNALS`]; then, in a
/// rear impact, [`REAR_SIGNALS`].
pub(crate) const SIGNALS: usize = PLACE;

/// Signals for rear impact: of T1, of the head restraint, of the head's speed and of the pelvis' position.
pub(crate) const REAR_SIGNALS: usize = 4;

/// Numbers of samples that are kept until they are sorted by signal: by hundreds at once that costs a fraction.
const BLOCK: usize = 1 << 15;

/// Instrument readings of a run since its last output.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fine {
    /// Start of the run, s.
    pub start_s: f64,
    /// Interval, s.
    pub interval_s: f64,
    /// Bodies (indices) with readings, in the order of a sample.
    pub(crate) bodies: Vec<usize>,
    /// Count of numbers of each body in a sample.
    each: usize,
    /// Count of those for side impact, before those of the legs.
    side: usize,
    /// Count of those of the lower legs, before those for rear impact; none in the file of an older program.
    legs: usize,
    /// Count of those for rear impact.
    pub(crate) rear: usize,
    /// Index of the next sample.
    pub(crate) next: usize,
    /// Time and readings of the step before.
    before_s: f64,
    before: Vec<f64>,
    /// Samples since the last output, one after another.
    samples: Vec<f64>,
    /// Buffer for a reading.
    now: Vec<f64>,
    /// Whether outputs are read, not steps.
    is_of_outputs: bool,
}

impl Fine {
    /// No readings yet, for a run of `model`.
    pub(crate) fn new(model: &Model) -> Self {
        let bodies = model.body().tree.bodies().into_iter().enumerate();
        let is_read =
            |of: usize, marks: &crate::body::Landmarks| of == 0 || marks.instruments().iter().any(Option::is_some);
        let bodies: Vec<usize> = bodies.filter(|(of, row)| is_read(*of, &row.landmarks)).map(|(of, _)| of).collect();
        let rear = if restraints(model.setup()).is_empty() { 0 } else { REAR_SIGNALS };
        let chest = if model.body().chests.is_empty() { 0 } else { CHEST_POINTS };
        let side = if model.body().sides.is_empty() { 0 } else { SIDE_SIGNALS };
        let feet = model.body().tree.bodies().into_iter().flat_map(|row| row.landmarks.legs());
        let legs = if feet.clone().any(|leg| leg.end.is_some()) { TIBIA_SIGNALS } else { 0 };
        let each = SIGNALS + chest + side + legs + rear;
        let count = each * bodies.len();
        let time = &model.setup().time;
        let interval_s = interval_s(model);
        let between = (time.output_s.min(time.end_s - time.start_s) / interval_s) as usize;
        let room = count * (between.min(1 << 20) + 64);
        Fine {
            start_s: time.start_s,
            interval_s,
            bodies,
            each,
            side,
            legs,
            rear,
            next: 0,
            before_s: f64::NAN,
            before: vec![f64::NAN; count],
            samples: Vec::with_capacity(room.min(1 << 20)),
            now: vec![f64::NAN; count],
            is_of_outputs: false,
        }
    }

    /// Largest number of samples of a whole run of `model`.
    pub(crate) fn most(model: &Model) -> usize {
        let time = &model.setup().time;
        (((time.end_s - time.start_s) / interval_s(model)) as usize).saturating_add(2)
    }

    /// Whether steps were not read, as in files before 0.2.
    pub(crate) fn is_unknown(&self) -> bool {
        self.next == 0
    }

    /// Takes the readings of a step and the forces of head restraints on heads, N, by body; those of the step before if
    /// none are given.
    pub(crate) fn see(&mut self, time_s: f64, readings: &[Reading<f64>], held: &[f64]) {
        let before = self.before.chunks_exact(self.each.max(1));
        for ((to, before), &of) in self.now.chunks_exact_mut(self.each.max(1)).zip(before).zip(&self.bodies) {
            let (own, more) = to.split_at_mut(SIGNALS);
            let (more, rear) = more.split_at_mut(more.len() - self.rear);
            let (more, legs) = more.split_at_mut(more.len() - self.legs);
            let (chest, side) = more.split_at_mut(more.len() - self.side);
            own.copy_from_slice(&readings[of][..SIGNALS]);
            chest.copy_from_slice(&readings[of][CHEST..][..chest.len()]);
            side.copy_from_slice(&readings[of][SIDE..][..side.len()]);
            legs.copy_from_slice(&readings[of][TIBIAE..][..legs.len()]);
            if let [t1, force, speed, place] = rear {
                [*t1, *speed, *place] = [readings[of][REAR], readings[of][REAR + 1], readings[of][REAR + 2]];
                *force = held.get(of).copied().unwrap_or(before[self.each - self.rear + 1]);
            }
        }
        if self.next == 0 {
            let is_of_outputs = self.is_of_outputs;
            self.samples.extend(self.now.iter().map(|x| kept(*x, is_of_outputs)));
            self.next = 1;
        } else if time_s > self.before_s {
            self.fill(time_s);
        } else {
            return;
        }
        self.before_s = time_s;
        self.before.copy_from_slice(&self.now);
    }

    /// Samples between the step before and the present one.
    fn fill(&mut self, time_s: f64) {
        loop {
            let due_s = self.start_s + self.next as f64 * self.interval_s;
            if due_s > time_s {
                return;
            }
            let s = (due_s - self.before_s) / (time_s - self.before_s);
            let is_of_outputs = self.is_of_outputs;
            let lines = self.before.iter().zip(&self.now).map(|(a, b)| kept(a + s * (b - a), is_of_outputs));
            self.samples.extend(lines);
            self.next += 1;
        }
    }

    /// Leaves out the loads of the lower legs, which the file of an older program lacks.
    fn forget_legs(&mut self) {
        self.each -= self.legs;
        self.legs = 0;
        let count = self.each * self.bodies.len();
        (self.before, self.now) = (vec![f64::NAN; count], vec![f64::NAN; count]);
    }

    /// Clears the samples after an output.
    pub(crate) fn clear(&mut self) {
        self.samples.clear();
    }

    /// Continues with the samples of `other`, of the same run, without allocation if the space suffices.
    pub(crate) fn go_on_with(&mut self, other: &Fine) {
        (self.interval_s, self.next, self.before_s) = (other.interval_s, other.next, other.before_s);
        (self.each, self.legs) = (other.each, other.legs);
        self.before.clone_from(&other.before);
        self.now.clone_from(&other.now);
        self.samples.extend_from_slice(&other.samples);
    }

    /// Makes room for the samples of several outputs.
    pub(crate) fn with_room(mut self) -> Self {
        self.samples.reserve(BLOCK + self.samples.capacity());
        self
    }

    /// Whether there are samples enough to be taken.
    pub(crate) fn is_full(&self) -> bool {
        self.samples.len() >= BLOCK
    }

    /// Takes an output as a step, for a run whose steps were not read.
    pub(crate) fn see_output(&mut self, sample: &Sample<'_>) {
        if self.is_unknown() {
            (self.interval_s, self.start_s) = (sample.model.setup().time.output_s, sample.time_s);
            self.is_of_outputs = true;
        }
        let held = rear::held(sample);
        self.see(sample.time_s, sample.readings, &held);
    }

    /// Places of the numbers for rear impact in a body's sample.
    pub(crate) fn rear_part(&self) -> Range<usize> {
        self.each - self.rear..self.each
    }

    /// Places of the loads of the lower legs.
    pub(crate) fn legs_part(&self) -> Range<usize> {
        let rear = self.rear_part();
        rear.start - self.legs..rear.start
    }

    /// Places of those for side impact.
    pub(crate) fn side_part(&self) -> Range<usize> {
        let legs = self.legs_part();
        legs.start - self.side..legs.start
    }

    /// Places of the deflections of the chest.
    pub(crate) fn chest_part(&self) -> Range<usize> {
        SIGNALS..self.side_part().start
    }

    /// Number of samples since the last output.
    pub(crate) fn count(&self) -> usize {
        self.samples.len() / (self.each * self.bodies.len())
    }

    /// Adds number `at` of each sample since they were last cleared to `values`, of a body among those read.
    pub(crate) fn push_column(&self, place: usize, at: usize, values: &mut Vec<f64>) {
        let mut next = self.each * place + at;
        // no iterator: each asks for its length, a division
        while let Some(number) = self.samples.get(next) {
            values.push(*number);
            next += self.each * self.bodies.len();
        }
    }

    /// Time of the first sample since the last output, s.
    pub(crate) fn first_s(&self) -> f64 {
        self.start_s + (self.next - self.count()) as f64 * self.interval_s
    }

    /// Samples since the last output, one after another, as in a file.
    pub(crate) fn singles(&self) -> Vec<f32> {
        self.samples.iter().map(|x| *x as f32).collect()
    }

    /// State as plain numbers: index of the next sample, its time, its readings.
    pub(crate) fn numbers(&self) -> Vec<f64> {
        if self.is_unknown() {
            return Vec::new();
        }
        [self.next as f64, self.before_s].into_iter().chain(self.before.iter().copied()).collect()
    }

    /// Sets the state from plain numbers; false if they are of another run.
    pub(crate) fn read(&mut self, numbers: &[f64], samples: &[f32]) -> bool {
        let [next, before_s, before @ ..] = numbers else { return false };
        if before.len() + self.legs * self.bodies.len() == self.before.len() {
            self.forget_legs();
        }
        let fits = before.len() == self.before.len() && samples.len().is_multiple_of(self.before.len().max(1));
        if fits && *next >= 1.0 {
            (self.next, self.before_s) = (*next as usize, *before_s);
            self.before.copy_from_slice(before);
            self.samples.clear();
            self.samples.extend(samples.iter().map(|x| f64::from(*x)));
        }
        fits && *next >= 1.0
    }
}

/// A number as stored.
#[inline(always)]
fn kept(number: f64, is_whole: bool) -> f64 {
    if is_whole { number } else { f64::from(number as f32) }
}

/// Interval of readings of a run of `model`, s: at least its fixed step.
pub fn interval_s(model: &Model) -> f64 {
    let asked_s = model.setup().output.readings_s.unwrap_or(READINGS_S);
    match model.setup().integrator {
        Integrator::Rk4 { step_s } => asked_s.max(step_s),
        Integrator::Adaptive { .. } => asked_s,
    }
}
