//! Times that shift with the parameters.
//!
//! A step that ends at an event ends at another time when a parameter changes. The last direction of a dual is that time: how
//! everything moves as the step ends later, at fixed values of the parameters. When the step is taken, [`Clock::fix`] puts its end
//! where the parameters shift it to, x′ + ẋ t*′, and the next step begins there: what acts before the event acts longer, and what
//! acts after it shorter. That is the jump of the derivative at an event, (f⁻ − f⁺) t*′, in every number that is integrated or remembered,
//! by the formulae of the integrator itself.

use std::array::from_fn;

use occupant_core::forces::Memory;
use occupant_core::motion::dual::Dual;
use occupant_core::motion::frame::{Frames, Moving};
use occupant_core::motion::state::State;
use occupant_core::motion::vector::{M3, V3};

/// Slopes of a time in all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Clock<const N: usize>(pub [f64; N]);

impl<const N: usize> Clock<N> {
    /// A time that nothing shifts.
    pub const FIXED: Self = Clock([0.0; N]);

    /// The end of a step, free to shift.
    pub fn free() -> Self {
        Clock(from_fn(|k| if k + 1 == N { 1.0 } else { 0.0 }))
    }

    /// The time at which something comes to its level, of which this number, at the free end of a step, is what is left, as a part
    /// of a way that goes on.
    pub fn of_level(left: &Dual<N>) -> Option<Self> {
        let rate = left.slopes[N - 1];
        let shift = |k: usize| if k + 1 == N { 0.0 } else { -left.slopes[k] / rate };
        (rate < 0.0).then(|| Clock(from_fn(shift)))
    }

    /// Part `s` of the way from this time to the end of a step.
    pub fn towards_end(&self, s: f64) -> Self {
        Clock(from_fn(|k| (1.0 - s) * self.0[k] + s * Self::free().0[k]))
    }

    /// The time from this to a `later` one, s.
    pub fn until(&self, later: &Self, h: f64) -> Dual<N> {
        Dual::new(h, from_fn(|k| later.0[k] - self.0[k]))
    }

    /// A number at the free end of a step, where that end is at this time.
    fn fix(&self, x: &mut Dual<N>) {
        let rate = std::mem::replace(&mut x.slopes[N - 1], 0.0);
        for (slope, shift) in x.slopes.iter_mut().zip(&self.0) {
            *slope += rate * shift;
        }
    }

    /// A state.
    pub fn fix_state(&self, state: &mut State<Dual<N>>) {
        state.numbers_mut().iter_mut().for_each(|x| self.fix(x));
    }

    /// What is remembered; `spare` is of the same elements.
    pub fn fix_memory(&self, memory: &mut Memory<Dual<N>>, spare: &mut Memory<Dual<N>>) {
        memory.each(spare, &mut |x, _| self.fix(x));
    }

    /// Takes `frames` along with their time; `jerk` is how fast their accelerations change.
    pub fn carry(&self, frames: &mut Frames<Dual<N>>, jerk: &Jerk) {
        frames.time.slopes = self.0;
        for (i, moving) in frames.moving.iter_mut().enumerate() {
            self.carry_frame(moving, jerk.of(i));
        }
    }

    fn carry_frame(&self, moving: &mut Moving<Dual<N>>, [jerk, spin]: [V3<f64>; 2]) {
        let Moving { origin, axes, velocity, omega, acceleration, alpha } = moving;
        self.slide(origin, values(velocity));
        let M3 { x, y, z } = axes;
        for axis in [x, y, z] {
            self.slide(axis, values(omega).cross(values(axis)));
        }
        self.slide(velocity, values(acceleration));
        self.slide(omega, values(alpha));
        self.slide(acceleration, jerk);
        self.slide(alpha, spin);
    }

    fn slide(&self, v: &mut V3<Dual<N>>, rate: V3<f64>) {
        for (x, rate) in [(&mut v.x, rate.x), (&mut v.y, rate.y), (&mut v.z, rate.z)] {
            x.slopes.iter_mut().zip(&self.0).for_each(|(slope, shift)| *slope += rate * shift);
        }
    }
}

fn values<const N: usize>(v: &V3<Dual<N>>) -> V3<f64> {
    V3 { x: v.x.value, y: v.y.value, z: v.z.value }
}

/// How fast the accelerations of frames change over a step, m/s³ and rad/s³.
pub(super) struct Jerk {
    ends: Option<[Frames<f64>; 2]>,
}

impl Jerk {
    /// At an instant.
    pub const NONE: Jerk = Jerk { ends: None };

    /// Between two instants.
    pub fn between(start: &Frames<f64>, end: &Frames<f64>) -> Self {
        Jerk { ends: Some([*start, *end]) }
    }

    fn of(&self, frame: usize) -> [V3<f64>; 2] {
        let Some([start, end]) = &self.ends else { return [V3::zero(); 2] };
        let per_s = 1.0 / (end.time - start.time);
        let [a, b] = [start, end].map(|frames| &frames.moving[frame]);
        [(b.acceleration - a.acceleration) * per_s, (b.alpha - a.alpha) * per_s]
    }
}
