//! The step of all lanes, compiled for the instructions of the lanes, and the rate of a run alone, likewise.
//!
//! The kernel is generic and inlined whole; here it gets into functions that may use wide registers. [`Avx2`] and
//! [`Avx512`] values may only be made where [`has_avx2`] and [`has_avx512`] say so.

use crate::forces::History;
use crate::forces::Observer;
use crate::kernel::System;
use crate::motion::frame::Frames;
use crate::motion::integrate::rk4::{self, Stage};
use crate::motion::lanes::Lanes;
use crate::motion::state::State;

#[cfg(target_arch = "x86_64")]
use crate::motion::lanes::{Avx2, Avx512};

/// Everything that acts on the runs side by side, and what it remembers.
#[derive(Clone, Debug)]
pub(crate) struct Bench<L: Lanes> {
    pub system: System<L>,
    pub history: History<L>,
    /// At the step's start, middle and end.
    pub frames: [Frames<L>; 3],
}

impl<L: Lanes> Bench<L> {
    /// The rate at a stage of a step, in the instructions of the caller; with `START` the history takes over the state.
    #[inline(always)]
    fn rate<const START: bool>(&mut self, stage: Stage, state: &State<L>, observer: &mut impl Observer<L>) -> State<L> {
        let frames = &self.frames[stage as usize];
        self.system.rate_observed::<START>(state, frames, &mut self.history, observer)
    }
}

/// Lanes that some processors can compute with.
pub(crate) trait Machine: Lanes {
    /// The state after a step, and a 1 for every lane in which it is one of finite numbers. Each lane has its length of step;
    /// `observer` sees the first evaluation.
    fn step(
        bench: &mut Bench<Self>,
        state: &State<Self>,
        h: Self,
        observer: &mut impl Observer<Self>,
    ) -> (State<Self>, Self);
}

impl<L: Lanes> Bench<L> {
    /// One step, in the instructions of the caller; `rate` is [`Bench::rate`] compiled for them.
    #[inline(always)]
    fn step(
        &mut self,
        state: &State<L>,
        h: L,
        mut rate: impl FnMut(&mut Self, Stage, &State<L>) -> State<L>,
    ) -> (State<L>, L) {
        let next = rk4::step(state, h, |stage, state| rate(self, stage, state));
        let finite = L::select(next.finite(), L::one(), L::zero());
        (next, finite)
    }
}

impl System<f64> {
    /// [`System::rate_observed`] of a run alone, in the instructions of AVX where the processor has them: the same bits, a
    /// tenth to a seventh sooner.
    #[inline]
    pub fn rate_alone<const COMMIT: bool>(
        &self,
        state: &State<f64>,
        frames: &Frames<f64>,
        history: &mut History<f64>,
        observer: &mut impl Observer<f64>,
    ) -> State<f64> {
        #[cfg(target_arch = "x86_64")]
        let rate = x86_64::rate_alone::<COMMIT>(self, state, frames, history, observer);
        #[cfg(not(target_arch = "x86_64"))]
        let rate = self.rate_observed::<COMMIT>(state, frames, history, observer);
        rate
    }
}

#[cfg(test)]
impl<const N: usize> Machine for crate::motion::lanes::Plain<N> {
    fn step(
        bench: &mut Bench<Self>,
        state: &State<Self>,
        h: Self,
        observer: &mut impl Observer<Self>,
    ) -> (State<Self>, Self) {
        bench.step(state, h, |bench, stage, state| match stage {
            Stage::Start => bench.rate::<true>(stage, state, observer),
            _ => bench.rate::<false>(stage, state, &mut ()),
        })
    }
}

#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code, reason = "a function for instructions that not every processor has is unsafe to call")]
mod x86_64 {
    use super::*;
    use crate::motion::lanes::has_avx2;

    /// [`System::rate_alone`].
    #[inline]
    pub(super) fn rate_alone<const COMMIT: bool>(
        system: &System<f64>,
        state: &State<f64>,
        frames: &Frames<f64>,
        history: &mut History<f64>,
        observer: &mut impl Observer<f64>,
    ) -> State<f64> {
        if has_avx2() {
            // SAFETY: just asked
            unsafe { rate_alone_avx2::<COMMIT>(system, state, frames, history, observer) }
        } else {
            system.rate_observed::<COMMIT>(state, frames, history, observer)
        }
    }

    #[inline(never)]
    #[target_feature(enable = "avx2")]
    fn rate_alone_avx2<const COMMIT: bool>(
        system: &System<f64>,
        state: &State<f64>,
        frames: &Frames<f64>,
        history: &mut History<f64>,
        observer: &mut impl Observer<f64>,
    ) -> State<f64> {
        system.rate_observed::<COMMIT>(state, frames, history, observer)
    }

    impl Machine for Avx2 {
        fn step(
            bench: &mut Bench<Self>,
            state: &State<Self>,
            h: Self,
            observer: &mut impl Observer<Self>,
        ) -> (State<Self>, Self) {
            // SAFETY: `h` exists, so `has_avx2` was true
            unsafe { step_avx2(bench, state, h, observer) }
        }
    }

    #[target_feature(enable = "avx2")]
    fn step_avx2(
        bench: &mut Bench<Avx2>,
        state: &State<Avx2>,
        h: Avx2,
        observer: &mut impl Observer<Avx2>,
    ) -> (State<Avx2>, Avx2) {
        bench.step(state, h, |bench, stage, state| match stage {
            Stage::Start => rate_avx2::<true>(bench, stage, state, observer),
            _ => rate_avx2::<false>(bench, stage, state, &mut ()),
        })
    }

    #[inline(never)]
    #[target_feature(enable = "avx2")]
    fn rate_avx2<const START: bool>(
        bench: &mut Bench<Avx2>,
        stage: Stage,
        state: &State<Avx2>,
        observer: &mut impl Observer<Avx2>,
    ) -> State<Avx2> {
        bench.rate::<START>(stage, state, observer)
    }

    impl Machine for Avx512 {
        fn step(
            bench: &mut Bench<Self>,
            state: &State<Self>,
            h: Self,
            observer: &mut impl Observer<Self>,
        ) -> (State<Self>, Self) {
            // SAFETY: `h` exists, so `has_avx512` was true
            unsafe { step_avx512(bench, state, h, observer) }
        }
    }

    #[target_feature(enable = "avx512f,avx512dq")]
    fn step_avx512(
        bench: &mut Bench<Avx512>,
        state: &State<Avx512>,
        h: Avx512,
        observer: &mut impl Observer<Avx512>,
    ) -> (State<Avx512>, Avx512) {
        bench.step(state, h, |bench, stage, state| match stage {
            Stage::Start => rate_avx512::<true>(bench, stage, state, observer),
            _ => rate_avx512::<false>(bench, stage, state, &mut ()),
        })
    }

    #[inline(never)]
    #[target_feature(enable = "avx512f,avx512dq")]
    fn rate_avx512<const START: bool>(
        bench: &mut Bench<Avx512>,
        stage: Stage,
        state: &State<Avx512>,
        observer: &mut impl Observer<Avx512>,
    ) -> State<Avx512> {
        bench.rate::<START>(stage, state, observer)
    }
}
