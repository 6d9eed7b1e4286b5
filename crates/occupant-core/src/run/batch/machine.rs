//! The step of all lanes, compiled for the instructions of the lanes.
//!
//! The kernel is generic and inlined whole; here it gets into functions that may use wide registers. Values of `Avx2` and
//! `Avx512` may only be made where [`has_avx2`](crate::motion::lanes::has_avx2) and
//! [`has_avx512`](crate::motion::lanes::has_avx512) say so.

use super::place::Witness;
use crate::forces::{Follow, History, Memory};
use crate::kernel::{Scratch, Situation, System};
use crate::motion::frame::Frames;
use crate::motion::integrate::rk4::{Stage, Stages};
use crate::motion::lanes::Lanes;
use crate::motion::state::State;

/// Everything that acts on the runs side by side, and what it remembers.
#[derive(Clone, Debug)]
pub(crate) struct Bench<L: Lanes> {
    pub state: State<L>,
    /// Where the latest step began, if anything can switch in any of the runs.
    pub rear: Option<Rear<L>>,
    pub stages: Stages<L>,
    pub around: Around<L>,
}

/// What a rate is computed from beside the state.
#[derive(Clone, Debug)]
pub(crate) struct Around<L: Lanes> {
    pub system: System<L>,
    pub history: History<L>,
    /// At the step's start, middle and end.
    pub frames: [Frames<L>; 3],
    pub scratch: Scratch<L>,
}

/// Where the latest step of all runs began, and where that under way does.
#[derive(Clone, Debug)]
pub(crate) struct Rear<L: Lanes> {
    // boxed, as they change hands at every step
    pub latest: Box<Start<L>>,
    pub ahead: Box<Start<L>>,
}

/// The start of a step: states, and what was remembered before the commit there.
#[derive(Clone, Debug)]
pub(crate) struct Start<L: Lanes> {
    pub state: State<L>,
    pub memory: Memory<L>,
}

impl<L: Lanes> Bench<L> {
    /// Keeps where the step ahead begins.
    pub fn keep_start(&mut self) {
        if let Some(rear) = &mut self.rear {
            rear.ahead.state = self.state;
            rear.ahead.memory.take_over(&self.around.history.memory);
        }
    }

    /// In which lanes the commit of the step just taken has shown that something switched within the latest.
    pub fn has_switched(&self) -> L {
        let mask = self.rear.as_ref().map(|rear| rear.ahead.memory.has_switched(&self.around.history.memory));
        mask.map_or(L::zero(), |mask| L::select(mask, L::one(), L::zero()))
    }

    /// The step just taken becomes the latest.
    pub fn shift(&mut self) {
        if let Some(rear) = &mut self.rear {
            std::mem::swap(&mut rear.latest, &mut rear.ahead);
        }
    }
}

/// Lanes that some processors can compute with.
pub(crate) trait Machine: Lanes {
    /// Begins steps, of which each lane has its length; returns the lengths that what is near bears. `witness` sees the
    /// evaluation.
    fn begin(bench: &mut Bench<Self>, h: Self, witness: &mut Witness<'_>) -> Self;

    /// Takes the rest of the steps; a 1 for every lane in which the state is one of finite numbers then.
    fn go(bench: &mut Bench<Self>, h: Self, witness: &mut Witness<'_>) -> Self;
}

impl<L: Lanes> Around<L> {
    /// The rate at a stage of a step, in the instructions of the caller; `witness` sees that of the start.
    #[inline(always)]
    fn rate(&mut self, stage: Stage, state: &State<L>, witness: &mut Witness<'_>, rate: &mut State<L>) {
        let accepted = stage == Stage::Start;
        let situation = Situation { state, frames: &self.frames[stage as usize], accepted };
        let mut witness = accepted.then(|| Follow(witness.anew()));
        let observer = &mut witness.as_mut();
        self.system.rate_with(&mut self.scratch, situation, &mut self.history, observer, rate);
        if let Some(Follow(witness)) = witness {
            self.system.read(&self.scratch, &self.frames[0], &mut |of, reading| witness.feel(of, reading));
        }
    }
}

impl<L: Lanes> Bench<L> {
    /// The first evaluation of a step, in the instructions of the caller; `rate` is [`Around::rate`] compiled for them.
    #[inline(always)]
    fn begin(&mut self, h: L, mut rate: impl FnMut(&mut Around<L>, Stage, &State<L>, &mut State<L>)) -> L {
        let Bench { state, stages, around, .. } = self;
        stages.begin(state, |stage, state, k| rate(around, stage, state, k));
        around.history.step(h)
    }

    /// The rest of it.
    #[inline(always)]
    fn go(&mut self, h: L, mut rate: impl FnMut(&mut Around<L>, Stage, &State<L>, &mut State<L>)) -> L {
        let Bench { state, stages, around, .. } = self;
        *state = *stages.go(state, h, |stage, state, k| rate(around, stage, state, k));
        L::select(self.state.finite(), L::one(), L::zero())
    }
}

/// The step of `$lanes`, in functions that may use the registers of `$features`.
#[cfg(target_arch = "x86_64")]
macro_rules! machine {
    ($lanes:ident, $features:literal, $module:ident) => {
        #[allow(unsafe_code, reason = "a function for instructions that not every processor has is unsafe to call")]
        mod $module {
            use super::*;
            use crate::motion::lanes::$lanes;

            impl Machine for $lanes {
                fn begin(bench: &mut Bench<Self>, h: Self, witness: &mut Witness<'_>) -> Self {
                    // SAFETY: `h` exists, so the processor has the instructions
                    unsafe { begin(bench, h, witness) }
                }

                fn go(bench: &mut Bench<Self>, h: Self, witness: &mut Witness<'_>) -> Self {
                    // SAFETY: `h` exists, so the processor has the instructions
                    unsafe { go(bench, h, witness) }
                }
            }

            #[target_feature(enable = $features)]
            fn begin(bench: &mut Bench<$lanes>, h: $lanes, witness: &mut Witness<'_>) -> $lanes {
                bench.begin(h, |around, stage, state, k| rate(around, stage, state, witness, k))
            }

            #[target_feature(enable = $features)]
            fn go(bench: &mut Bench<$lanes>, h: $lanes, witness: &mut Witness<'_>) -> $lanes {
                bench.go(h, |around, stage, state, k| rate(around, stage, state, witness, k))
            }

            #[inline(never)]
            #[target_feature(enable = $features)]
            fn rate(
                around: &mut Around<$lanes>,
                stage: Stage,
                state: &State<$lanes>,
                witness: &mut Witness<'_>,
                k: &mut State<$lanes>,
            ) {
                around.rate(stage, state, witness, k);
            }
        }
    };
}

#[cfg(target_arch = "x86_64")]
machine!(Avx2, "avx2", avx2);
#[cfg(target_arch = "x86_64")]
machine!(Avx512, "avx512f,avx512dq", avx512);

#[cfg(test)]
mod tests {
    use super::*;

    impl<const N: usize> Machine for crate::motion::lanes::Plain<N> {
        fn begin(bench: &mut Bench<Self>, h: Self, witness: &mut Witness<'_>) -> Self {
            bench.begin(h, |around, stage, state, k| around.rate(stage, state, witness, k))
        }

        fn go(bench: &mut Bench<Self>, h: Self, witness: &mut Witness<'_>) -> Self {
            bench.go(h, |around, stage, state, k| around.rate(stage, state, witness, k))
        }
    }
}
