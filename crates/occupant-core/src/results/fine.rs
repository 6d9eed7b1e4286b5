//! Readings of the instruments at equal times, independent of the output interval; measures with windows use them.
//!
//! Instruments are read at the ends of steps, 10 to 20 thousand times a second during contact, and are linear in
//! between. Values at steps have the precision of an `f32`, in a run as in its file; values at outputs, from which
//! derivatives are made, have full precision.

use crate::kernel::instruments::{CHEST, CHEST_POINTS, PLACE, REAR, Reading};
use crate::model::Model;
use crate::model::behind::restraints;
use crate::model::setup::Integrator;
use crate::results::rear;
use crate::results::sample::Sample;

/// So often readings are taken unless a setup asks otherwise, s: as SAE J211 asks for CFC 1000.
pub const READINGS_S: f64 = 1e-4;

/// Numbers of the instruments of one body in a sample: those of a reading without the place of the head; behind them, where any
/// body has a chest that yields, its deflections; behind them, of a blow from behind, [`REAR_SIGNALS`].
pub(crate) const SIGNALS: usize = PLACE;

/// Of T1, of the head restraint, of the head's speed and of the pelvis' place.
pub(crate) const REAR_SIGNALS: usize = 4;

/// The readings of a run since its last output.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fine {
    /// Start of the run, s.
    pub start_s: f64,
    /// Interval, s.
    pub interval_s: f64,
    /// The bodies (indices) that are read, in the order of their readings in a sample.
    pub(crate) bodies: Vec<usize>,
    /// Numbers of each in a sample.
    each: usize,
    /// How many of these are of a blow from behind.
    pub(crate) rear: usize,
    /// Number of the next sample.
    pub(crate) next: usize,
    /// The step before: its time and readings.
    before_s: f64,
    before: Vec<f64>,
    /// The samples since the last output, one behind the other.
    samples: Vec<f64>,
    /// Room for a reading.
    now: Vec<f64>,
    /// Whether outputs are seen, not steps.
    is_of_outputs: bool,
}

impl Fine {
    /// None yet of a run of `model`.
    pub(crate) fn new(model: &Model) -> Self {
        let bodies = model.body().tree.bodies().into_iter().enumerate();
        let is_read =
            |of: usize, marks: &crate::body::Landmarks| of == 0 || marks.instruments().iter().any(Option::is_some);
        let bodies: Vec<usize> = bodies.filter(|(of, row)| is_read(*of, &row.landmarks)).map(|(of, _)| of).collect();
        let rear = if restraints(model.setup()).is_empty() { 0 } else { REAR_SIGNALS };
        let chest = if model.body().chests.is_empty() { 0 } else { CHEST_POINTS };
        let each = SIGNALS + chest + rear;
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
            rear,
            next: 0,
            before_s: f64::NAN,
            before: vec![f64::NAN; count],
            samples: Vec::with_capacity(room.min(1 << 20)),
            now: vec![f64::NAN; count],
            is_of_outputs: false,
        }
    }

    /// How many samples a whole run of `model` has at most.
    pub(crate) fn most(model: &Model) -> usize {
        let time = &model.setup().time;
        (((time.end_s - time.start_s) / interval_s(model)) as usize).saturating_add(2)
    }

    /// Whether nobody has read steps: in files before 0.2.
    pub(crate) fn is_unknown(&self) -> bool {
        self.next == 0
    }

    /// Looks at the readings of a step and at the forces of head restraints on heads, N, by body; those of the step before where none are told.
    pub(crate) fn see(&mut self, time_s: f64, readings: &[Reading<f64>], held: &[f64]) {
        let before = self.before.chunks_exact(self.each.max(1));
        for ((to, before), &of) in self.now.chunks_exact_mut(self.each.max(1)).zip(before).zip(&self.bodies) {
            let (own, more) = to.split_at_mut(SIGNALS);
            let (chest, rear) = more.split_at_mut(more.len() - self.rear);
            own.copy_from_slice(&readings[of][..SIGNALS]);
            chest.copy_from_slice(&readings[of][CHEST..][..chest.len()]);
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

    /// The samples between the step before and the one now.
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

    /// Forgets the samples, which an output has taken.
    pub(crate) fn clear(&mut self) {
        self.samples.clear();
    }

    /// Becomes what `other` is, of the same run; allocates nothing if there is room.
    pub(crate) fn take_over(&mut self, other: &Fine) {
        (self.interval_s, self.next, self.before_s) = (other.interval_s, other.next, other.before_s);
        self.before.clone_from(&other.before);
        self.samples.clone_from(&other.samples);
    }

    /// Sees an output as if it were a step, of a run of which nobody has read the steps.
    pub(crate) fn see_output(&mut self, sample: &Sample<'_>) {
        if self.is_unknown() {
            (self.interval_s, self.start_s) = (sample.model.setup().time.output_s, sample.time_s);
            self.is_of_outputs = true;
        }
        let held = rear::held(sample);
        self.see(sample.time_s, sample.readings, &held);
    }

    /// The part of a sample of one body that is of a blow from behind.
    pub(crate) fn rear_of<'s>(&self, sample: &'s [f64]) -> &'s [f64] {
        &sample[self.each - self.rear..]
    }

    /// Number and readings of the samples since the last output, of a body among those that are read.
    pub(crate) fn of(&self, place: usize) -> impl Iterator<Item = &[f64]> {
        let each = self.each;
        self.samples.chunks_exact(each * self.bodies.len()).map(move |all| &all[each * place..][..each])
    }

    /// Time of the first of the samples since the last output, s.
    pub(crate) fn first_s(&self) -> f64 {
        let count = self.samples.len() / (self.each * self.bodies.len());
        self.start_s + (self.next - count) as f64 * self.interval_s
    }

    /// The samples since the last output, one behind the other, as a file has them.
    pub(crate) fn singles(&self) -> Vec<f32> {
        self.samples.iter().map(|x| *x as f32).collect()
    }

    /// The step before as plain numbers: the number of the next sample, its time, its readings.
    pub(crate) fn numbers(&self) -> Vec<f64> {
        if self.is_unknown() {
            return Vec::new();
        }
        [self.next as f64, self.before_s].into_iter().chain(self.before.iter().copied()).collect()
    }

    /// From plain numbers, of a run of which `self` knows nothing; false where they are of another.
    pub(crate) fn read(&mut self, numbers: &[f64], samples: &[f32]) -> bool {
        let [next, before_s, before @ ..] = numbers else { return false };
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

/// A number as it is kept.
#[inline(always)]
fn kept(number: f64, is_whole: bool) -> f64 {
    if is_whole { number } else { f64::from(number as f32) }
}

/// The interval of readings of a run of `model`, s: no shorter than its fixed steps.
pub fn interval_s(model: &Model) -> f64 {
    let asked_s = model.setup().output.readings_s.unwrap_or(READINGS_S);
    match model.setup().integrator {
        Integrator::Rk4 { step_s } => asked_s.max(step_s),
        Integrator::Adaptive { .. } => asked_s,
    }
}
