//! A single run: its rate with AVX instructions if the processor has them, and all results of an evaluation.

use crate::forces::{History, Load, Observer};
use crate::kernel::{Evaluation, Scratch, Situation, System};
use crate::motion::dynamics::Wrench;
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::MOST_SEGMENTS;
use crate::motion::state::State;

impl System<f64> {
    /// `System::rate_with` of a run alone, in the instructions of AVX where the processor has them: the same bits,
    /// 10 to 15 % faster.
    #[inline]
    pub fn rate_alone(
        &self,
        scratch: &mut Scratch<f64>,
        situation: Situation<'_, f64>,
        history: &mut History<f64>,
        observer: &mut impl Observer<f64>,
        rate: &mut State<f64>,
    ) {
        #[cfg(target_arch = "x86_64")]
        x86_64::rate_alone(self, scratch, situation, history, observer, rate);
        #[cfg(not(target_arch = "x86_64"))]
        self.rate_once(scratch, situation, history, observer, rate);
    }

    /// Rate of change of the state; see [`System::rate_with`].
    pub fn rate(
        &self,
        situation: Situation<'_, f64>,
        history: &mut History<f64>,
        observer: &mut dyn Observer<f64>,
    ) -> State<f64> {
        let mut rate = State::zero(situation.state.shape());
        self.rate_once(&mut Scratch::blank(self), situation, history, observer, &mut rate);
        rate
    }

    /// All results of [`System::rate`] with their intermediate values.
    pub fn evaluate(
        &self,
        situation: Situation<'_, f64>,
        history: &mut History<f64>,
        observer: &mut dyn Observer<f64>,
    ) -> Evaluation<f64> {
        self.evaluate_with(&mut Scratch::blank(self), situation, history, observer)
    }

    /// [`System::evaluate`] with scratch space.
    pub(crate) fn evaluate_with(
        &self,
        scratch: &mut Scratch<f64>,
        situation: Situation<'_, f64>,
        history: &mut History<f64>,
        observer: &mut dyn Observer<f64>,
    ) -> Evaluation<f64> {
        self.derive_once(scratch, situation, history, observer);
        let Scratch { kinematics, load: Load { wrench, power, outer, knees, resist, .. }, sweep, .. } = &*scratch;
        Evaluation {
            kinematics: *kinematics,
            wrench: *wrench,
            accelerations: sweep.accelerations,
            power: *power,
            outer: *outer,
            knees: *knees,
            resist: *resist,
        }
    }

    /// Motion and loads of [`System::evaluate`], without gravity, in scratch space: nothing is copied.
    pub(crate) fn loads<'s>(
        &self,
        scratch: &'s mut Scratch<f64>,
        situation: Situation<'_, f64>,
        history: &mut History<f64>,
    ) -> (&'s Kinematics<f64>, &'s [Wrench<f64>; MOST_SEGMENTS]) {
        self.bear_once(scratch, situation, history, &mut ());
        (&scratch.kinematics, &scratch.load.wrench)
    }

    /// [`System::rate_with`] by [`System::derive_once`].
    fn rate_once(
        &self,
        scratch: &mut Scratch<f64>,
        situation: Situation<'_, f64>,
        history: &mut History<f64>,
        observer: &mut dyn Observer<f64>,
        rate: &mut State<f64>,
    ) {
        self.derive_once(scratch, situation, history, observer);
        scratch.write_rate(&self.skeleton, situation.state, rate);
    }

    /// [`System::derive`] without special instructions: outside the steps of a single run.
    #[inline(never)]
    fn derive_once(
        &self,
        scratch: &mut Scratch<f64>,
        situation: Situation<'_, f64>,
        history: &mut History<f64>,
        observer: &mut dyn Observer<f64>,
    ) {
        self.bear_once(scratch, situation, history, observer);
        self.solve(scratch, situation);
    }

    /// [`System::bear`] without special instructions. It is inlined wherever it is called.
    #[inline(never)]
    fn bear_once(
        &self,
        scratch: &mut Scratch<f64>,
        situation: Situation<'_, f64>,
        history: &mut History<f64>,
        observer: &mut dyn Observer<f64>,
    ) {
        self.bear(scratch, situation, history, observer);
    }
}

#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code, reason = "a function for instructions that not every processor has is unsafe to call")]
mod x86_64 {
    use super::*;
    use crate::motion::lanes::has_avx2;

    /// [`System::rate_alone`].
    #[inline(always)]
    pub(super) fn rate_alone(
        system: &System<f64>,
        scratch: &mut Scratch<f64>,
        situation: Situation<'_, f64>,
        history: &mut History<f64>,
        observer: &mut impl Observer<f64>,
        rate: &mut State<f64>,
    ) {
        if has_avx2() {
            // SAFETY: just asked
            unsafe { rate_alone_avx2(system, scratch, situation, history, observer, rate) }
        } else {
            system.rate_once(scratch, situation, history, observer, rate)
        }
    }

    #[inline(never)]
    #[target_feature(enable = "avx2")]
    fn rate_alone_avx2(
        system: &System<f64>,
        scratch: &mut Scratch<f64>,
        situation: Situation<'_, f64>,
        history: &mut History<f64>,
        observer: &mut impl Observer<f64>,
        rate: &mut State<f64>,
    ) {
        system.rate_with(scratch, situation, history, observer, rate)
    }
}
