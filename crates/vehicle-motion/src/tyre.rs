//! The tyre in the plane of contact: a brush on combined slip, with a relaxation length.
//!
//! The transient slips ζ are bounded, |ζ| < ζ_m, at any speed: they do not accumulate at rest, and there is no division
//! by a speed at lock. In steady state ζ gives the slip ς = −V_s/|V_r|. At rest the tyre is a spring, so a parked car
//! stays on its slope.

use libm::{atan, exp, sin};

/// Bound of the transient slips.
pub const SLIP_BOUND: f64 = 0.1;
/// Stiffness of the rim relative to that of the tyre, to which it is added.
const RIM_GAIN: f64 = 9.0;

/// A tyre; one kind for all wheels of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tyre {
    /// Free radius, m.
    pub radius_m: f64,
    /// Radius of the crown across the tread, m.
    pub crown_m: f64,
    /// Radial stiffness, N/m.
    pub stiffness_n_per_m: f64,
    /// Radial damping, N·s/m.
    pub damping_n_s_per_m: f64,
    /// Depth from which the rim bears, ten times as stiff, m.
    pub rim_depth_m: f64,
    /// Peak friction on a surface of factor 1.
    pub friction: f64,
    /// Friction of fast sliding relative to peak friction.
    pub sliding_share: f64,
    /// Sliding speed over which friction falls from the peak to that of fast sliding, m/s.
    pub sliding_speed_m_s: f64,
    /// Cornering stiffness per load at the reference load, 1/rad.
    pub cornering_per_rad: f64,
    /// Reference load, N.
    pub reference_load_n: f64,
    /// Load of the largest cornering stiffness, relative to the reference load.
    pub greatest_at: f64,
    /// Longitudinal slip stiffness per load.
    pub slip_stiffness: f64,
    /// Camber stiffness per load, 1/rad.
    pub camber_per_rad: f64,
    /// Loss of friction with load, per reference load.
    pub friction_loss: f64,
    /// Relaxation length, m.
    pub relaxation_m: f64,
    /// Damping of slip at low speed, N·s/m.
    pub slow_damping_n_s_per_m: f64,
    /// Rolling resistance over load.
    pub rolling: f64,
}

impl Tyre {
    /// A typical passenger car tyre. Stiffnesses are between published tyres (ADAMS' in the CommonRoad models, Project
    /// Chrono's sedan); relaxation, camber and damping are estimates.
    pub fn usual() -> Self {
        Tyre {
            radius_m: 0.32,
            crown_m: 0.1,
            stiffness_n_per_m: 2e5,
            damping_n_s_per_m: 150.0,
            rim_depth_m: 0.055,
            friction: 0.76,
            sliding_share: 1.0,
            sliding_speed_m_s: 4.0,
            cornering_per_rad: 12.0,
            reference_load_n: 4000.0,
            greatest_at: 1.8,
            slip_stiffness: 18.0,
            camber_per_rad: 1.0,
            friction_loss: 0.0,
            relaxation_m: 0.35,
            slow_damping_n_s_per_m: 2500.0,
            rolling: 0.012,
        }
    }

    /// Longitudinal and lateral slip stiffness under a load, N.
    pub fn stiffnesses_n(&self, load_n: f64) -> [f64; 2] {
        let over = |load: f64| sin(2.0 * atan(load / (self.greatest_at * self.reference_load_n)));
        // C_y = c_α F₀ sin(2 atan(F_z/(q F₀)))/sin(2 atan(1/q))
        let lateral = self.cornering_per_rad * self.reference_load_n * over(load_n) / over(self.reference_load_n);
        [self.slip_stiffness * load_n, lateral]
    }

    /// Force of the radial spring at a depth, N.
    pub fn radial_n(&self, depth_m: f64) -> f64 {
        self.stiffness_n_per_m * (depth_m + RIM_GAIN * (depth_m - self.rim_depth_m).max(0.0))
    }

    /// Its energy, J.
    pub fn radial_j(&self, depth_m: f64) -> f64 {
        let beyond_m = (depth_m - self.rim_depth_m).max(0.0);
        self.stiffness_n_per_m * (0.5 * depth_m * depth_m + 0.5 * RIM_GAIN * beyond_m * beyond_m)
    }

    /// Depth at which it bears a load, m.
    pub fn depth_m(&self, load_n: f64) -> f64 {
        let soft_m = load_n / self.stiffness_n_per_m;
        soft_m - RIM_GAIN / (1.0 + RIM_GAIN) * (soft_m - self.rim_depth_m).max(0.0)
    }

    /// Friction at a sliding speed, load, and surface factor.
    pub fn friction_at(&self, slide_m_s: f64, load_n: f64, surface: f64) -> f64 {
        let fall = self.sliding_share + (1.0 - self.sliding_share) * exp(-slide_m_s / self.sliding_speed_m_s);
        let loaded = (1.0 - self.friction_loss * (load_n / self.reference_load_n - 1.0)).max(0.3);
        self.friction * fall * surface * loaded
    }

    /// Rates of the transient slips, 1/s, while the contact slides with `slide_m_s` and the tread rolls with `roll_m_s`.
    pub fn slip_rates(&self, slips: [f64; 2], slide_m_s: [f64; 2], roll_m_s: f64) -> [f64; 2] {
        let [x, y] = slide_m_s;
        // σ ζ̇ = −V_s − (|V_r| + |V_s|/ζ_m) ζ
        let decay = roll_m_s.abs() + (x * x + y * y).sqrt() / SLIP_BOUND;
        [(-x - decay * slips[0]) / self.relaxation_m, (-y - decay * slips[1]) / self.relaxation_m]
    }

    /// Slips of the law, from the transient ones.
    pub fn steady_slips(slips: [f64; 2]) -> [f64; 2] {
        let size = (slips[0] * slips[0] + slips[1] * slips[1]).sqrt().min(SLIP_BOUND * (1.0 - 1e-9));
        let gain = 1.0 / (1.0 - size / SLIP_BOUND);
        slips.map(|slip| slip * gain)
    }
}

/// Shear force of the brush, ahead and to the right, N: `slips` by `stiffness_n`, at most μF_z.
///
/// F = μF_z (1 − (1 − z)³) with z = |f|/(3μF_z), f = C ς. Its direction goes by the stiffnesses at small slip and against the
/// sliding velocity when all of the contact slides.
pub fn shear_n(slips: [f64; 2], stiffness_n: [f64; 2], most_n: f64) -> [f64; 2] {
    let along = [stiffness_n[0] * slips[0], stiffness_n[1] * slips[1]];
    let elastic = (along[0] * along[0] + along[1] * along[1]).sqrt();
    if elastic == 0.0 || most_n <= 0.0 {
        return [0.0; 2];
    }
    let used = (elastic / (3.0 * most_n)).min(1.0);
    let left = 1.0 - used;
    let size = most_n * (1.0 - left * left * left);
    let even = (stiffness_n[0] * stiffness_n[1]).sqrt();
    let turned = [0, 1].map(|j| (stiffness_n[j] + (even - stiffness_n[j]) * used) * slips[j]);
    let length = (turned[0] * turned[0] + turned[1] * turned[1]).sqrt();
    turned.map(|x| size * x / length)
}

/// Utilisation z of friction by a shear force; 1 for full sliding.
pub fn saturation(slips: [f64; 2], stiffness_n: [f64; 2], most_n: f64) -> f64 {
    let along = [stiffness_n[0] * slips[0], stiffness_n[1] * slips[1]];
    let elastic = (along[0] * along[0] + along[1] * along[1]).sqrt();
    if most_n > 0.0 { (elastic / (3.0 * most_n)).min(1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Worked out in 30 digits by hand of the law: F_z 4000 N, μ 0.8, C_x 18 F_z, C_y 12 F_z.
    #[test]
    fn the_law_gives_the_forces_worked_out_elsewhere() {
        let cases = [
            ([0.01, 0.0], [667.35, 0.0]),
            ([0.05, 0.0], [2418.75, 0.0]),
            ([0.2, 0.0], [3200.0, 0.0]),
            ([0.0, 0.02], [0.0, 867.20]),
            ([0.0, 0.05], [0.0, 1850.0]),
            ([0.0, 0.1], [0.0, 2800.0]),
            ([0.0, 0.2], [0.0, 3200.0]),
            ([0.05, 0.05], [2084.221231, 1668.188581]),
            ([-0.1, 0.1], [-2305.517726, 2214.714051]),
            ([1.0, 1.0], [2262.741700, 2262.741700]),
        ];
        for (slips, expected) in cases {
            let found = shear_n(slips, [72e3, 48e3], 3200.0);
            // the references are rounded to the digits shown
            assert!(
                (0..2).all(|j| (found[j] - expected[j]).abs() < 6e-3),
                "{slips:?}: {found:?}, expected {expected:?}"
            );
        }
    }

    /// A locked wheel whose sliding direction turns: the slips stay below their bound, and force opposes sliding on average.
    #[test]
    fn slips_stay_bounded_and_take_energy() {
        let tyre = Tyre::usual();
        let (mut slips, mut lost_j, step_s) = ([0.0; 2], 0.0, 1e-5);
        for i in 0..300_000 {
            let angle = 4.0 * step_s * f64::from(i);
            let slide = [5.0 * libm::cos(angle), 5.0 * sin(angle)];
            let rates = tyre.slip_rates(slips, slide, 0.0);
            slips = [0, 1].map(|j| slips[j] + step_s * rates[j]);
            assert!(slips[0].hypot(slips[1]) < SLIP_BOUND * (1.0 + 1e-9));
            let force = shear_n(Tyre::steady_slips(slips), [72e3, 48e3], 3200.0);
            lost_j -= step_s * (force[0] * slide[0] + force[1] * slide[1]);
        }
        // sliding as a whole for 3 s: 3200 N · 5 m/s · 3 s; measured 47 919 J
        assert!((lost_j - 48e3).abs() < 200.0, "{lost_j}");
    }
}
