//! The step of all lanes, compiled for the instructions of the lanes.
//!
//! The kernel is generic and fully inlined; here it is compiled into functions that may use wide registers. Values of
//! `Avx2` and `Avx512` may only be created if [`has_avx2`](crate::motion::lanes::has_avx2) and
//! [`has_avx512`](crate::motion::lanes::has_avx512) say so.

use super::bench::{Around, Bench};
use super::place::Witness;
use crate::forces::{Follow, History};
use crate::kernel::Situation;
use crate::motion::integrate::bogacki_shampine::{Errors, Stage as Trial};
use crate::motion::integrate::rk4::Stage;
use crate::motion::lanes::Lanes;
use crate::motion::state::State;
use crate::run::ahead::Ahead;

/// Lanes supported by some processors.
pub(crate) trait Machine: Lanes {
    /// Begins steps with a length per lane; returns the lengths that near pairs permit. `witness` sees the evaluation.
    fn begin(bench: &mut Bench<Self>, h: Self, witness: &mut Witness<'_>) -> Self;

    /// Takes the rest of the steps; 1 in every lane with a finite state.
    fn go(bench: &mut Bench<Self>, h: Self, witness: &mut Witness<'_>) -> Self;

    /// Under error control: rates at the starts of steps, in the lanes with 1; returns the lengths that near pairs
    /// permit. `witness` sees the evaluation.
    fn look(bench: &mut Bench<Self>, looks: Self, h: Self, witness: &mut Witness<'_>) -> Self;

    /// Tries steps under error control; 1 in every lane in which an element has switched by the end, where `witness`
    /// sees the evaluation.
    fn attempt(bench: &mut Bench<Self>, h: Self, witness: &mut Witness<'_>) -> (Errors<Self>, Self);

    /// After a shift: keeps the skipped pairs in the lanes with 1.
    fn keep_hints(bench: &mut Bench<Self>, kept: Self);
}

/// An evaluation of all lanes.
#[derive(Clone, Copy)]
pub(super) struct Call {
    /// Index of the frames.
    frames: usize,
    /// Whether the history is updated; the witness then sees it.
    accepted: bool,
}

impl From<Stage> for Call {
    #[inline(always)]
    fn from(stage: Stage) -> Self {
        Call { frames: stage as usize, accepted: stage == Stage::Start }
    }
}

impl<L: Lanes> Around<L> {
    /// Rate of `state`, in the instructions of the caller.
    #[inline(always)]
    fn rate(
        &mut self,
        call: Call,
        state: &State<L>,
        history: &mut History<L>,
        witness: &mut Witness<'_>,
        rate: &mut State<L>,
    ) {
        let Call { frames, accepted } = call;
        let situation = Situation { state, frames: &self.frames[frames], accepted };
        let mut witness = accepted.then(|| Follow(witness.anew()));
        let observer = &mut witness.as_mut();
        self.system.rate_with(&mut self.scratch, situation, history, observer, rate);
        if let Some(Follow(witness)) = witness {
            self.system.read(&self.scratch, &self.frames[frames], &mut |of, reading| witness.feel(of, reading));
        }
    }
}

/// [`Around::rate`], compiled for the instructions of the lanes.
trait Rate<L: Lanes>: Fn(&mut Around<L>, Call, &State<L>, &mut History<L>, &mut Witness<'_>, &mut State<L>) {}

impl<L: Lanes, F> Rate<L> for F where
    F: Fn(&mut Around<L>, Call, &State<L>, &mut History<L>, &mut Witness<'_>, &mut State<L>)
{
}

impl<L: Lanes> Bench<L> {
    /// First evaluation of a step, in the instructions of the caller; `rate` is [`Around::rate`] compiled for them.
    #[inline(always)]
    fn begin(&mut self, h: L, witness: &mut Witness<'_>, rate: impl Rate<L>) -> L {
        let Bench { state, stages, history, around, .. } = self;
        stages.begin(state, |stage, state, k| rate(around, stage.into(), state, history, witness, k));
        history.step(h)
    }

    /// Rest of the step.
    #[inline(always)]
    fn go(&mut self, h: L, witness: &mut Witness<'_>, rate: impl Rate<L>) -> L {
        let Bench { state, stages, history, around, .. } = self;
        let end = stages.go(state, h, |stage, state, k| rate(around, stage.into(), state, history, witness, k));
        state.take_over(end);
        L::select(self.state.finite(), L::one(), L::zero())
    }

    /// [`Machine::look`].
    #[inline(always)]
    fn look(&mut self, looks: L, h: L, witness: &mut Witness<'_>, rate: impl Rate<L>) -> L {
        let Bench { around, ahead: Some(ahead), .. } = self else { return h };
        let mask = looks.gt(L::zero());
        if L::any(mask) {
            ahead.begin_trial(&around.system.forces, h);
            let Ahead { to, after, trial, room, .. } = &mut **ahead;
            rate(around, Call { frames: 0, accepted: true }, to, trial, witness, &mut room.rate);
            after.blend_hints(trial, mask);
            ahead.end_trial();
        }
        ahead.after.step(h)
    }

    /// [`Machine::attempt`].
    #[inline(always)]
    fn attempt(&mut self, h: L, witness: &mut Witness<'_>, rate: impl Rate<L>) -> (Errors<L>, L) {
        let Bench { around, ahead: Some(ahead), tolerance, .. } = self else {
            return (Errors { whole: h, within: h }, h);
        };
        ahead.begin_trial(&around.system.forces, h);
        let Ahead { to, rates, after, trial, room, .. } = &mut **ahead;
        let mut frames = 0..;
        let errors = room.attempt(to, &rates[1], h, tolerance, |stage, state, k| {
            let call = Call { frames: frames.next().unwrap_or(0), accepted: stage == Trial::End };
            rate(around, call, state, trial, witness, k);
        });
        let switched = after.memory.has_switched(&trial.memory);
        ahead.end_trial();
        (errors, L::select(switched, L::one(), L::zero()))
    }

    /// [`Machine::keep_hints`].
    #[inline(always)]
    fn keep_hints(&mut self, kept: L) {
        if let Some(ahead) = &mut self.ahead {
            ahead.after.blend_hints(&ahead.before, kept.gt(L::zero()));
        }
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

                fn look(bench: &mut Bench<Self>, looks: Self, h: Self, witness: &mut Witness<'_>) -> Self {
                    // SAFETY: `h` exists, so the processor has the instructions
                    unsafe { look(bench, looks, h, witness) }
                }

                fn attempt(bench: &mut Bench<Self>, h: Self, witness: &mut Witness<'_>) -> (Errors<Self>, Self) {
                    // SAFETY: `h` exists, so the processor has the instructions
                    unsafe { attempt(bench, h, witness) }
                }

                fn keep_hints(bench: &mut Bench<Self>, kept: Self) {
                    // SAFETY: `kept` exists, so the processor has the instructions
                    unsafe { keep_hints(bench, kept) }
                }
            }

            #[target_feature(enable = $features)]
            fn begin(bench: &mut Bench<$lanes>, h: $lanes, witness: &mut Witness<'_>) -> $lanes {
                bench.begin(h, witness, |a, c, s, m, w, k| rate(a, c, s, m, w, k))
            }

            #[target_feature(enable = $features)]
            fn go(bench: &mut Bench<$lanes>, h: $lanes, witness: &mut Witness<'_>) -> $lanes {
                bench.go(h, witness, |a, c, s, m, w, k| rate(a, c, s, m, w, k))
            }

            #[target_feature(enable = $features)]
            fn look(bench: &mut Bench<$lanes>, looks: $lanes, h: $lanes, witness: &mut Witness<'_>) -> $lanes {
                bench.look(looks, h, witness, |a, c, s, m, w, k| rate(a, c, s, m, w, k))
            }

            #[target_feature(enable = $features)]
            fn attempt(bench: &mut Bench<$lanes>, h: $lanes, witness: &mut Witness<'_>) -> (Errors<$lanes>, $lanes) {
                bench.attempt(h, witness, |a, c, s, m, w, k| rate(a, c, s, m, w, k))
            }

            #[target_feature(enable = $features)]
            fn keep_hints(bench: &mut Bench<$lanes>, kept: $lanes) {
                bench.keep_hints(kept);
            }

            #[inline(never)]
            #[target_feature(enable = $features)]
            fn rate(
                around: &mut Around<$lanes>,
                call: Call,
                state: &State<$lanes>,
                history: &mut History<$lanes>,
                witness: &mut Witness<'_>,
                k: &mut State<$lanes>,
            ) {
                around.rate(call, state, history, witness, k);
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
            bench.begin(h, witness, Around::rate)
        }

        fn go(bench: &mut Bench<Self>, h: Self, witness: &mut Witness<'_>) -> Self {
            bench.go(h, witness, Around::rate)
        }

        fn look(bench: &mut Bench<Self>, looks: Self, h: Self, witness: &mut Witness<'_>) -> Self {
            bench.look(looks, h, witness, Around::rate)
        }

        fn attempt(bench: &mut Bench<Self>, h: Self, witness: &mut Witness<'_>) -> (Errors<Self>, Self) {
            bench.attempt(h, witness, Around::rate)
        }

        fn keep_hints(bench: &mut Bench<Self>, kept: Self) {
            bench.keep_hints(kept);
        }
    }
}
