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

/// Derivatives of a time in all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Clock<const N: usize>(pub [f64; N]);

impl<const N: usize> Clock<N> {
    /// A time that does not shift.
    pub const FIXED: Self = Clock([0.0; N]);

    /// The end of a step, free to shift.
    pub fn free() -> Self {
        Clock(from_fn(|k| if k + 1 == N { 1.0 } else { 0.0 }))
    }

    /// The time at which a quantity reaches its level; `left` is the remaining distance at the free end of a step, as a
    /// fraction.
    pub fn of_level(left: &Dual<N>) -> Option<Self> {
        let rate = left.slopes[N - 1];
        let shift = |k: usize| if k + 1 == N { 0.0 } else { -left.slopes[k] / rate };
        (rate < 0.0).then(|| Clock(from_fn(shift)))
    }

    /// Time at fraction `s` between this time and the end of a step.
    pub fn towards_end(&self, s: f64) -> Self {
        Clock(from_fn(|k| (1.0 - s) * self.0[k] + s * Self::free().0[k]))
    }

    /// Duration from this time to a `later` one, s.
    pub fn until(&self, later: &Self, h: f64) -> Dual<N> {
        Dual::new(h, from_fn(|k| later.0[k] - self.0[k]))
    }

    /// Fixes the end time of a step for a number there.
    fn fix(&self, x: &mut Dual<N>) {
        let rate = std::mem::replace(&mut x.slopes[N - 1], 0.0);
        for (slope, shift) in x.slopes.iter_mut().zip(&self.0) {
            *slope += rate * shift;
        }
    }

    /// The same for a state.
    pub fn fix_state(&self, state: &mut State<Dual<N>>) {
        state.numbers_mut().iter_mut().for_each(|x| self.fix(x));
    }

    /// The same for stored state; `spare` is of the same elements.
    pub fn fix_memory(&self, memory: &mut Memory<Dual<N>>, spare: &mut Memory<Dual<N>>) {
        memory.each(spare, &mut |x, _| self.fix(x));
    }

    /// Moves `frames` along with their time; `jerk` is the rate of change of their accelerations.
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

/// Rate of change of frame accelerations over a step, m/s³ and rad/s³.
pub(super) struct Jerk {
    ends: Option<[Frames<f64>; 2]>,
}

impl Jerk {
    /// For an instant.
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

#[cfg(test)]
mod tests {
    use super::*;
    use occupant_core::body::tti12::TTI12;
    use occupant_core::motion::integrate::{bogacki_shampine, rk4};
    use occupant_core::motion::layout::Layout;
    use occupant_core::motion::state::{Quat, Shape};

    type D = Dual<2>;

    /// A mass on a line at 0, with this speed.
    fn mass(speed_m_s: f64) -> State<D> {
        let o = Dual::new(0.0, [0.0; 2]);
        let mut state = State::zero(Shape::of(&Layout::of(&TTI12)));
        state.set_velocity(V3 { x: Dual::new(speed_m_s, [0.0; 2]), y: o, z: o });
        for slot in state.turns() {
            state.set_orientation(slot, Quat { w: Dual::new(1.0, [0.0; 2]), v: V3::zero() });
        }
        state
    }

    /// Its rate under an acceleration.
    fn rate(state: &State<D>, acceleration_m_s2: f64) -> State<D> {
        let o = Dual::new(0.0, [0.0; 2]);
        let mut rate = State::zero(state.shape());
        rate.set_t1(state.velocity());
        rate.set_velocity(V3 { x: Dual::new(acceleration_m_s2, [0.0; 2]), y: o, z: o });
        rate
    }

    type Step = fn(&State<D>, D, f64) -> State<D>;

    /// A step under an acceleration by either method.
    const STEPS: [Step; 2] = [
        |state, h, a| rk4::step(state, h, |_, state, k| *k = rate(state, a)),
        |state, h, a| bogacki_shampine::stages(state, &rate(state, a), h, |_, state, k| *k = rate(state, a)).0,
    ];

    /// From 0 to `event_s` under the first acceleration, from there to `end_s` under the second; `end` tells where the first step
    /// ends when the parameter changes. Place and speed in the end.
    fn run(
        step: Step,
        speed: f64,
        [a, b]: [f64; 2],
        [event_s, end_s]: [f64; 2],
        end: impl Fn(D) -> Clock<2>,
    ) -> [D; 2] {
        let h = Clock::FIXED.until(&Clock::free(), event_s);
        let mut state = step(&mass(speed), h, a);
        let begun = end(state.t1().x);
        begun.fix_state(&mut state);
        let state = step(&state, begun.until(&Clock::FIXED, end_s - event_s), b);
        [state.t1().x, state.velocity().x]
    }

    /// A force that sets in at t_d: v = a (t − t_d), so dv/dt_d = −a and dx/dt_d = −a (t − t_d).
    #[test]
    fn a_force_that_sets_in_later_acts_shorter() {
        let (a, [begins_s, end_s]) = (70.0, [0.02, 0.05]);
        for step in STEPS {
            let [x, v] = run(step, 3.0, [0.0, a], [begins_s, end_s], |_| Clock([1.0, 0.0]));
            assert!((v.slopes[0] + a).abs() < 1e-12, "{v:?}");
            assert!((x.slopes[0] + a * (end_s - begins_s)).abs() < 1e-12, "{x:?}");
        }
    }

    /// Webbing that runs out against −c until the payout L and is held with −b from there: L = v t* − c t*²/2, dt*/dL = 1/(v − c t*),
    /// and behind t* dv/dL = (b − c) dt*/dL, dx/dL = (t − t*) dv/dL.
    #[test]
    fn a_spool_that_locks_later_lets_more_out() {
        let (speed, [c, b], [locks_s, end_s]) = (5.0, [20.0, 300.0], [0.03, 0.04]);
        let payout = speed * locks_s - 0.5 * c * locks_s * locks_s;
        let shift = 1.0 / (speed - c * locks_s);
        for step in STEPS {
            let level = Dual::new(payout, [1.0, 0.0]);
            let end = |x: D| Clock::of_level(&(level - x)).expect("a level that is reached");
            let [x, v] = run(step, speed, [-c, -b], [locks_s, end_s], end);
            let expected = (b - c) * shift;
            assert!((v.slopes[0] / expected - 1.0).abs() < 1e-12, "{v:?} {expected}");
            assert!((x.slopes[0] / (expected * (end_s - locks_s)) - 1.0).abs() < 1e-11, "{x:?}");
        }
    }
}
