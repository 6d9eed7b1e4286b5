//! A mass that falls into a ball of gas with a hole that opens at a pressure, by itself.

use crate::room::setup;
use crate::steps::{step, until};
use crate::strap::mass_text;
use occupant_core::model::Model;
use std::f64::consts::PI;

/// Step of the reference, s. All corners in time are multiples of it.
const STEP_S: f64 = 5e-6;
/// Radius of the ball that falls, m.
const BALL_M: f64 = 0.1;
/// Air around: Pa, K, and its R, a, b of c_p = a + bT.
const AMBIENT: [f64; 2] = [101_325.0, 293.15];
const AIR: [f64; 3] = [287.05, 930.4, 0.2091];
const NITROGEN: [f64; 3] = [296.8, 962.7, 0.1988];
/// Part of its volume that a folded bag has.
const FOLDED: f64 = 0.02;
/// When the inflator blows, s, and how hot, K.
const TIMES_S: [f64; 4] = [0.0, 0.003, 0.012, 0.03];
const HOT_K: [f64; 4] = [620.0, 600.0, 500.0, 400.0];
/// When the bag is unfolded, s.
const UNFOLDED_S: f64 = 0.015;

/// A mass above a bag.
#[derive(Clone, Copy, Debug)]
pub struct GasBag {
    /// kg.
    pub mass_kg: f64,
    /// Between the surfaces of ball and bag, m.
    pub above_m: f64,
    /// Downwards, m/s.
    pub speed_m_s: f64,
    /// m/s².
    pub gravity_m_s2: f64,
    /// m.
    pub radius_m: f64,
    /// At the second and third of four times, kg/s.
    pub flow_kg_s: [f64; 2],
    /// C_d A of the hole, m², and the gauge pressure that opens it, Pa.
    pub hole_m2: f64,
    /// Pa.
    pub opens_at_pa: f64,
    /// C_d A of a hole that is open from the start, m².
    pub leak_m2: f64,
    /// s.
    pub end_s: f64,
}

/// Place and speed of the mass, masses of air and nitrogen, U + p_aV.
type State = [f64; 5];

/// The gas at an instant.
struct Gas {
    temperature: f64,
    gauge: f64,
    enthalpy: f64,
    gamma: f64,
    mass_r: f64,
}

impl GasBag {
    /// The model with these assignments.
    pub fn model(&self, set: &[&str]) -> Model {
        let GasBag { radius_m, flow_kg_s: [second, third], hole_m2, opens_at_pa, leak_m2, .. } = *self;
        let mass = mass_text([self.mass_kg, 0.0, self.speed_m_s, self.gravity_m_s2, self.end_s]);
        let middle_m = self.middle_m();
        let text = format!(
            "{mass}[triggers.now]\nkind = \"time\"\nat = 0\n[bags.g]\ntrigger = \"now\"\ndeploy = {UNFOLDED_S}\n\
             mount = [0, 0, {}]\nsphere = {{ centre = [0, 0, {middle_m}], radius = {radius_m} }}\nspheres = [\"ball\"]\n\
             inflators = [{{ gas = {{ nitrogen = 1 }}, times = {TIMES_S:?}, flow = [0, {second}, {third}, 0], \
             temperature = {HOT_K:?} }}]\nvents = [{{ area = {hole_m2}, discharge = 1, opens_at = {opens_at_pa} }}, \
             {{ area = {leak_m2}, discharge = 1 }}]\n",
            middle_m + radius_m
        );
        Model::new(setup(&text, set)).unwrap()
    }

    /// Where the middle of the bag is below where the mass begins, m.
    fn middle_m(&self) -> f64 {
        self.above_m + BALL_M + self.radius_m
    }

    /// Volume of the envelope and its rate, m³ and m³/s.
    fn envelope(&self, t: f64) -> [f64; 2] {
        let whole = 4.0 / 3.0 * PI * self.radius_m.powi(3);
        let rate = (1.0 - FOLDED) / UNFOLDED_S;
        // at a corner in time the step that is taken decides
        if t < UNFOLDED_S - 1e-9 { [whole * (FOLDED + rate * t), whole * rate] } else { [whole, 0.0] }
    }

    /// Volume and section of the lens of ball and bag, m³ and m².
    fn lens(&self, z: f64) -> [f64; 2] {
        let (r, big, d) = (BALL_M, self.radius_m, self.middle_m() - z);
        if d >= r + big {
            return [0.0; 2];
        }
        let radical = 4.0 * d * d * big * big - (d * d - r * r + big * big).powi(2);
        let squares = d * d + 2.0 * d * (r + big) - 3.0 * (r - big).powi(2);
        [PI * (r + big - d).powi(2) * squares / (12.0 * d), PI * radical / (4.0 * d * d)]
    }

    fn gas(&self, t: f64, [z, _, air, other, total]: State) -> Gas {
        let [p_a, _] = AMBIENT;
        let sum = |of: fn([f64; 3]) -> f64| air * of(AIR) + other * of(NITROGEN);
        let (mass_r, b, c) = (sum(|g| g[0]), sum(|g| g[1] - g[0]), sum(|g| g[2]));
        let hot = |energy: f64, b: f64| 2.0 * energy / (b + (b * b + 2.0 * c * energy).sqrt());
        let free = self.envelope(t)[0] - self.lens(z)[0];
        let slack = hot(total, b + mass_r);
        let is_full = mass_r * slack > p_a * free;
        let temperature = if is_full { hot(total - p_a * free, b) } else { slack };
        Gas {
            temperature,
            gauge: if is_full { mass_r * temperature / free - p_a } else { 0.0 },
            enthalpy: (b + mass_r + 0.5 * c * temperature) * temperature / (air + other),
            gamma: 1.0 + mass_r / (b + c * temperature),
            mass_r,
        }
    }

    /// Gauge pressure, Pa.
    fn gauge(&self, t: f64, y: State) -> f64 {
        self.gas(t, y).gauge
    }

    /// Mass flow through a hole of 1 m², kg/s.
    fn outflow(gas: &Gas, mass: f64) -> f64 {
        let ([p_a, _], gamma) = (AMBIENT, gas.gamma);
        let p = p_a + gas.gauge.max(200.0);
        let chokes = (2.0 / (gamma + 1.0)).powf(gamma / (gamma - 1.0));
        let ratio = (p_a / p).max(chokes);
        let shape = 2.0 * gamma / (gamma - 1.0) * (ratio.powf(2.0 / gamma) - ratio.powf((gamma + 1.0) / gamma));
        p / (gas.mass_r * gas.temperature / mass).sqrt() * shape.sqrt() * (gas.gauge / 200.0).min(1.0)
    }

    /// Flow of the inflator, kg/s, and what it brings, W.
    fn blows(&self, t: f64) -> [f64; 2] {
        let Some(i) = (0..3).find(|i| t < TIMES_S[i + 1] && t >= TIMES_S[*i]) else { return [0.0; 2] };
        let part = (t - TIMES_S[i]) / (TIMES_S[i + 1] - TIMES_S[i]);
        let flows = [0.0, self.flow_kg_s[0], self.flow_kg_s[1], 0.0];
        let [flow, hot] = [flows, HOT_K].map(|row| row[i] + part * (row[i + 1] - row[i]));
        [flow, flow * (NITROGEN[1] + 0.5 * NITROGEN[2] * hot) * hot]
    }

    fn rate(&self, t: f64, y: State, is_open: bool) -> State {
        let ([z, v, air, other, _], gas) = (y, self.gas(t, y));
        let ([_, area], [_, grows], [flow, brings]) = (self.lens(z), self.envelope(t), self.blows(t));
        let hole = self.leak_m2 + if is_open { self.hole_m2 } else { 0.0 };
        let out = hole * Self::outflow(&gas, air + other);
        let share = out / (air + other);
        let energy = brings - out * gas.enthalpy - gas.gauge * (grows - area * v);
        [v, self.gravity_m_s2 - gas.gauge * area / self.mass_kg, -air * share, flow - other * share, energy]
    }

    /// Place of the mass (m) and gauge pressure (Pa) at the end, the furthest way (m), the greatest pressure (Pa), and when the hole
    /// opened (s).
    pub fn expected(&self) -> ([f64; 4], Option<f64>) {
        let [p_a, t_a] = AMBIENT;
        let folded = p_a * self.envelope(0.0)[0];
        let mut y =
            [0.0, self.speed_m_s, folded / (AIR[0] * t_a), 0.0, (AIR[1] + 0.5 * AIR[2] * t_a) * folded / AIR[0]];
        let (mut opened_s, mut most) = (None, [0.0_f64; 2]);
        for i in 0..(self.end_s / STEP_S).round() as u64 {
            let (mut t, end_s) = (STEP_S * i as f64, STEP_S * (i + 1) as f64);
            // what jumps at the end of a step belongs to the next
            let rate = |is_open: bool| move |at: f64, y: State| self.rate(at.min(end_s - 1e-10), y, is_open);
            if opened_s.is_none()
                && let Some(h) = until(t, end_s - t, y, &rate(false), |t, y| self.gauge(t, y) - self.opens_at_pa)
            {
                y = step(t, h, y, &rate(false));
                t += h;
                opened_s = Some(t);
            }
            y = step(t, end_s - t, y, &rate(opened_s.is_some()));
            most = [most[0].max(y[0].abs()), most[1].max(self.gauge(end_s, y))];
        }
        ([y[0], self.gauge(self.end_s, y), most[0], most[1]], opened_s)
    }
}
