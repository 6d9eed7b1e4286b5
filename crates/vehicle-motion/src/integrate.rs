//! The pair of Bogacki and Shampine, orders 3 and 2, with error control (Appl. Math. Lett. 2 (1989) 321).

use crate::state::{MOTION, State};

/// Scales of the step error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Of places and jounces, m.
    pub place_m: f64,
    /// Of velocities, and of spins and rotations times 1 m, m/s.
    pub speed_m_s: f64,
    /// Of each number, relative.
    pub relative: f64,
    /// Longest step, s.
    pub longest_s: f64,
}

impl Default for Tolerance {
    fn default() -> Self {
        Tolerance { place_m: 1e-5, speed_m_s: 1e-4, relative: 1e-5, longest_s: 0.02 }
    }
}

/// State vector: vehicles, then everything else that moves, position and speed alternating.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Stack {
    pub cars: Vec<State>,
    pub more: Vec<f64>,
    /// Index of the first light mass: rails.
    pub light_from: usize,
}

impl Stack {
    fn numbers(&self) -> impl Iterator<Item = &f64> {
        self.cars.iter().flat_map(|car| car.0.iter()).chain(&self.more)
    }

    /// Sets this to a state and shares of rates.
    fn set(&mut self, state: &Stack, parts: &[(f64, &Stack)]) {
        self.clone_from(state);
        for (share, rate) in parts {
            for (to, by) in self.cars.iter_mut().zip(&rate.cars) {
                to.0.iter_mut().zip(&by.0).for_each(|(to, by)| *to += share * by);
            }
            self.more.iter_mut().zip(&rate.more).for_each(|(to, by)| *to += share * by);
        }
    }
}

/// The embedded pair with its stages.
pub(crate) struct Pair {
    /// State after the last attempted step, and its rate there.
    pub end: Stack,
    pub end_rate: Stack,
    stages: [Stack; 2],
    middle: Stack,
}

impl Pair {
    /// For states of the size of this one.
    pub fn of(state: &Stack) -> Self {
        let room = || state.clone();
        Pair { end: room(), end_rate: room(), stages: [room(), room()], middle: room() }
    }

    /// Tries a step of `h` s from `state`, whose rate is `k1`, and returns its error in units of the tolerance; `rate` is called
    /// with the share of the step.
    pub fn attempt(
        &mut self,
        state: &Stack,
        k1: &Stack,
        h: f64,
        tolerance: &Tolerance,
        mut rate: impl FnMut(f64, &Stack, &mut Stack),
    ) -> f64 {
        let [k2, k3] = &mut self.stages;
        self.middle.set(state, &[(0.5 * h, k1)]);
        rate(0.5, &self.middle, k2);
        self.middle.set(state, &[(0.75 * h, k2)]);
        rate(0.75, &self.middle, k3);
        self.end.set(state, &[(2.0 / 9.0 * h, k1), (h / 3.0, k2), (4.0 / 9.0 * h, k3)]);
        for car in &mut self.end.cars {
            let length = car.0[3..7].iter().map(|x| x * x).sum::<f64>().sqrt();
            car.0[3..7].iter_mut().for_each(|x| *x /= length);
        }
        rate(1.0, &self.end, &mut self.end_rate);
        // third-order weights less 7/24, 1/4, 1/3, 1/8
        let weights = [-5.0 / 72.0, 1.0 / 12.0, 1.0 / 9.0, -1.0 / 8.0];
        let error = |ks: [f64; 4]| h * weights.iter().zip(ks).map(|(w, k)| w * k).sum::<f64>();
        let mut most = 0.0f64;
        // a number that is none counts as far too large
        let mut judge = |share: f64| most = if share.is_nan() { f64::INFINITY } else { most.max(share.abs()) };
        for (c, car) in self.end.cars.iter().enumerate() {
            let rates = [k1, &*k2, &*k3, &self.end_rate].map(|k| &k.cars[c].0);
            for i in 0..MOTION {
                judge(error(rates.map(|k| k[i])) / scale(i, car, tolerance));
            }
        }
        for (i, value) in self.end.more.iter().enumerate() {
            // light masses that shake do the vehicles no harm
            let [place, speed] = if i < self.end.light_from { [1.0, 1.0] } else { [10.0, 100.0] };
            let speed_m_s = speed * tolerance.speed_m_s + tolerance.relative * value.abs();
            let of = if i % 2 == 0 { place * tolerance.place_m } else { speed_m_s };
            judge(error([k1, &*k2, &*k3, &self.end_rate].map(|k| k.more[i])) / of);
        }
        most
    }

    /// Whether the end is finite.
    pub fn is_finite(&self) -> bool {
        self.end.numbers().all(|x| x.is_finite())
    }
}

/// Largest error of a number of the state.
fn scale(i: usize, state: &State, tolerance: &Tolerance) -> f64 {
    let relative = tolerance.relative * state.0[i].abs();
    match i {
        // a place far from the origin is no less exact
        0..3 => tolerance.place_m,
        13..17 => tolerance.place_m,
        3..7 => tolerance.place_m,
        7..13 | 17..21 => tolerance.speed_m_s + relative,
        21..25 => 3.0 * tolerance.speed_m_s + relative,
        // slips; work follows what is integrated
        _ => 10.0 * tolerance.place_m,
    }
}

/// The next step after one of `h` s with an error, s (Gustafsson's proportional–integral control).
pub(crate) fn next_step(h: f64, error: f64, before: f64, is_accepted: bool) -> f64 {
    if !error.is_finite() {
        return 0.1 * h;
    }
    let error = error.max(1e-6);
    if is_accepted {
        let growth = 0.9 * libm::pow(error, -0.7 / 3.0) * libm::pow(before.max(1e-4), 0.4 / 3.0);
        h * growth.clamp(0.2, 4.0)
    } else {
        h * (0.9 * libm::pow(error, -1.0 / 3.0)).clamp(0.1, 0.9)
    }
}
