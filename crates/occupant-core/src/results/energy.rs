//! The energy ledger: every joule of the occupant accounted for at each output.
//!
//! Kinetic, gravity and stored energies are functions of the state; work sums are integrated with the integrator's own
//! weights. With W_v the work of the moving vehicle on the occupant, kinetic + gravity + stored energy without a work
//! sum + Σ work sums − W_v is constant.

use std::ops::Range;

use serde::Serialize;

use crate::forces::contact::FASTEST_M_S;
use crate::forces::{HeldBy, STORED, STORES, StoredEnergy};
use crate::motion::frame::Moving;
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::MOST_BODIES;
use crate::motion::skeleton::{Skeleton, Slide};
use crate::motion::state::{WORK_SUMS, Work};
use crate::motion::vector::V3;

/// Energies of one instant, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyLedger {
    /// Kinetic energy in space.
    pub kinetic_j: f64,
    /// Kinetic energy of the motion relative to the vehicle (velocities minus the vehicle's rigid-body field).
    pub kinetic_relative_j: f64,
    /// M g Z′, zero at Z′ = 0.
    pub gravity_j: f64,
    /// Stored (recoverable) in force elements or dissipated according to their memory, in the order of `STORED`.
    pub stored_j: [f64; STORES],
    /// Dissipated since the start, in the order of `SUMS`: work done on the elements less stored energy.
    pub lost_j: [f64; WORK_SUMS],
    /// Work done on the occupant by moving vehicles and panels since the start.
    pub vehicle_work_j: f64,
    /// Work done on it by other bodies since the start; the sum over all bodies is 0.
    pub others_work_j: f64,
    /// Present sum less the sum at the start; 0 for exact integration.
    pub balance_j: f64,
}

/// Reference energies of the balance, at the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyStart {
    /// Stored in force elements, in the order of `STORED`, J; 0 for energies outside all work sums.
    pub stored_j: [f64; STORES],
    /// Sum of kinetic and gravity energy and of stored energies outside all work sums, J.
    pub mechanical_j: f64,
}

impl EnergyLedger {
    /// Ledger of a body (index) at one instant; `home` is the motion of its vehicle, `stored_j` the stored energies of
    /// force elements.
    pub(crate) fn new(
        (bodies, body): (&Skeleton<f64>, usize),
        k: &Kinematics<f64>,
        home: &Moving<f64>,
        stored_j: [f64; STORES],
        work: &Work<f64>,
        start: &EnergyStart,
    ) -> Self {
        let segments = bodies.layout.trunks()[body].segments();
        let mut ledger = EnergyLedger {
            kinetic_j: kinetic_of(bodies, segments.clone(), k, &Moving::space()),
            kinetic_relative_j: kinetic_of(bodies, segments.clone(), k, home),
            gravity_j: gravity_of(bodies, segments, k),
            stored_j,
            lost_j: work.sums,
            vehicle_work_j: work.vehicle,
            others_work_j: work.others,
            balance_j: 0.0,
        };
        for energy in STORED {
            if let Some(HeldBy { sum, .. }) = energy.held_by {
                ledger.lost_j[sum] = ledger.lost_j[sum] + start.stored_j[energy.at] - stored_j[energy.at];
            }
        }
        let spent: f64 = work.sums.iter().sum();
        ledger.balance_j = ledger.mechanical_j() + spent - work.vehicle - work.others - start.mechanical_j;
        ledger
    }

    /// Ledger of several bodies together.
    pub(crate) fn sum(all: &[EnergyLedger]) -> Self {
        let [first, others @ ..] = all else { return EnergyLedger::default() };
        others.iter().fold(*first, |sum, own| EnergyLedger {
            kinetic_j: sum.kinetic_j + own.kinetic_j,
            kinetic_relative_j: sum.kinetic_relative_j + own.kinetic_relative_j,
            gravity_j: sum.gravity_j + own.gravity_j,
            stored_j: std::array::from_fn(|i| sum.stored_j[i] + own.stored_j[i]),
            lost_j: std::array::from_fn(|i| sum.lost_j[i] + own.lost_j[i]),
            vehicle_work_j: sum.vehicle_work_j + own.vehicle_work_j,
            others_work_j: sum.others_work_j + own.others_work_j,
            balance_j: sum.balance_j + own.balance_j,
        })
    }

    /// Reference energies of this instant.
    pub fn as_start(&self) -> EnergyStart {
        let held = |energy: StoredEnergy| energy.held_by.map_or(0.0, |_| self.stored_j[energy.at]);
        EnergyStart { stored_j: STORED.map(held), mechanical_j: self.mechanical_j() }
    }

    /// Kinetic and gravity energy and stored energies outside all work sums.
    fn mechanical_j(&self) -> f64 {
        // U + V with V = V_p + V_s (49)
        let without = STORED.iter().filter(|energy| energy.held_by.is_none());
        without.fold(self.kinetic_j + self.gravity_j, |sum, energy| sum + self.stored_j[energy.at])
    }
}

/// Largest energies among the outputs of a run so far, J: of all bodies together, and of each if there are several.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Greatest {
    /// Of all bodies together.
    pub all: Extremes,
    /// By body; empty for a single body.
    pub each: [Extremes; MOST_BODIES],
}

/// Largest energies of some bodies so far, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extremes {
    /// Kinetic energy relative to the vehicle.
    pub kinetic_j: f64,
    /// Work of gravity and of force elements since the start, as sum of magnitudes. The vehicle's work is excluded: it
    /// depends on the frame of reference.
    pub work_j: f64,
    /// Energy imbalance.
    pub imbalance_j: f64,
}

impl Greatest {
    /// Energy error of a run of bodies of `masses_kg`: of all together, or of the body with the largest own error,
    /// which a heavy one would hide.
    pub(crate) fn check(&self, masses_kg: &[f64]) -> EnergyCheck {
        let all = self.all.check(masses_kg.iter().sum());
        if masses_kg.len() < 2 {
            return all;
        }
        let own = self.each.iter().zip(masses_kg).map(|(extremes, mass_kg)| extremes.check_of_one(*mass_kg));
        own.fold(all, |worst, own| if own.balance_error > worst.balance_error { own } else { worst })
    }

    /// Values of each body as plain numbers: kinetic energy, work, imbalance; empty for a single body.
    pub(crate) fn numbers(&self) -> Vec<f64> {
        let count = self.each.iter().rposition(|own| *own != Extremes::default()).map_or(0, |last| last + 1);
        self.each[..count].iter().flat_map(|own| [own.kinetic_j, own.work_j, own.imbalance_j]).collect()
    }

    /// Sets the values from [`Greatest::numbers`].
    pub(crate) fn read(&mut self, numbers: &[f64]) {
        let (rows, _) = numbers.as_chunks();
        for (own, &[kinetic_j, work_j, imbalance_j]) in self.each.iter_mut().zip(rows) {
            *own = Extremes { kinetic_j, work_j, imbalance_j };
        }
    }
}

impl Extremes {
    /// Updates the maxima at an output; `work_j` is the work of gravity and force elements.
    pub(crate) fn see(&mut self, energy: &EnergyLedger, work_j: f64) {
        self.kinetic_j = self.kinetic_j.max(energy.kinetic_relative_j);
        self.work_j = self.work_j.max(work_j);
        // sums that ran away are no balance
        let imbalance_j = if energy.balance_j.is_nan() { f64::INFINITY } else { energy.balance_j.abs() };
        self.imbalance_j = self.imbalance_j.max(imbalance_j);
    }

    /// The same for one of several bodies, relative to the greater of its kinetic energy and its work: work from other
    /// bodies is as exact as they are.
    fn check_of_one(&self, mass_kg: f64) -> EnergyCheck {
        let reference_j = self.kinetic_j.max(self.work_j).max(0.5 * mass_kg * REST_M_S * REST_M_S);
        let balance_error = self.imbalance_j / reference_j;
        EnergyCheck {
            balance_error,
            reference: "largest energy of one of the bodies",
            reference_j,
            greatest_kinetic_j: self.kinetic_j,
            balance: Balance::of(balance_error),
        }
    }

    /// Energy error of a run of a body of `mass_kg`.
    fn check(&self, mass_kg: f64) -> EnergyCheck {
        let [rest_j, fastest_j] = [REST_M_S, FASTEST_M_S].map(|speed_m_s| 0.5 * mass_kg * speed_m_s * speed_m_s);
        let is_of_vehicle = self.kinetic_j > fastest_j;
        let (reference, reference_j) = if is_of_vehicle {
            ("largest work of gravity and force elements", self.work_j)
        } else if self.kinetic_j > 0.0 && self.kinetic_j < rest_j {
            // of a body that sits still there is nothing but rounding to be compared
            ("kinetic energy at 1 cm/s", rest_j)
        } else {
            ("largest kinetic energy relative to the vehicle", self.kinetic_j)
        };
        let balance_error = self.imbalance_j / reference_j;
        let balance = match balance_error {
            _ if is_of_vehicle => Balance::Lost,
            _ if self.imbalance_j == 0.0 => Balance::Kept,
            error => Balance::of(error),
        };
        EnergyCheck { balance_error, reference, reference_j, greatest_kinetic_j: self.kinetic_j, balance }
    }
}

/// State of rest of the bodies of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rest {
    /// Largest kinetic energy in space so far, J.
    pub most_j: f64,
    /// Time since when all bodies have had almost none of it, s; 1e30 while any has.
    pub since_s: f64,
}

/// Fraction of the largest kinetic energy of all below which a body is at rest.
const STILL: f64 = 1e-4;
/// Time at rest after which a run counts as at rest, s.
const REST_S: f64 = 0.2;
/// A time after the end of every run, s.
const NEVER: f64 = 1e30;

impl Default for Rest {
    fn default() -> Self {
        Rest { most_j: 0.0, since_s: NEVER }
    }
}

impl Rest {
    /// Updates it at an output with these kinetic energies in space by body, J.
    pub(crate) fn see(&mut self, time_s: f64, kinetic_j: &[f64]) {
        let total_j: f64 = kinetic_j.iter().sum();
        self.most_j = self.most_j.max(total_j);
        let is_still = kinetic_j.iter().all(|own_j| *own_j < STILL * self.most_j);
        self.since_s = if is_still { self.since_s.min(time_s) } else { NEVER };
    }

    /// Whether the bodies are at rest.
    pub(crate) fn is_over(&self, time_s: f64) -> bool {
        time_s - self.since_s >= REST_S
    }
}

/// Speed below which a body counts as sitting still, m/s.
const REST_M_S: f64 = 0.01;

/// Energy error of a run, up to its last output.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct EnergyCheck {
    /// Largest imbalance among the outputs as a fraction of the reference; NaN, `null` in JSON, without any motion or
    /// force.
    pub balance_error: f64,
    /// Text of the reference: the largest kinetic energy relative to the vehicle; above 100 m/s, which is the vehicle's
    /// speed, the largest work of gravity and force elements; below 1 cm/s, the kinetic energy at 1 cm/s.
    pub reference: &'static str,
    /// Value of the reference, J.
    pub reference_j: f64,
    /// Largest kinetic energy relative to the vehicle, J.
    pub greatest_kinetic_j: f64,
    /// Verdict on the results.
    pub balance: Balance,
}

impl EnergyCheck {
    /// The finding, as text.
    pub fn found(&self) -> String {
        let EnergyCheck { balance_error, reference, greatest_kinetic_j: kinetic_j, .. } = self;
        match Balance::of(*balance_error) {
            _ if !balance_error.is_finite() => "not known".to_owned(),
            Balance::Lost => format!("off by {:.0} % of the {reference}", 100.0 * balance_error),
            _ if self.balance == Balance::Lost => {
                format!(
                    "meaningless: a kinetic energy of {kinetic_j:.1e} J relative to the vehicle is impossible for an occupant"
                )
            }
            _ => format!("off by {:.1} % of the {reference}", 100.0 * balance_error),
        }
    }
}

/// Reliability of the results of a run by its energy balance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Balance {
    /// Error at most 1 %.
    Kept,
    /// Error above 1 %: results are doubtful.
    Doubtful,
    /// Error above 10 % or unknown, or speeds in the vehicle above 100 m/s, which contacts cannot follow: results are
    /// invalid.
    Lost,
}

impl Balance {
    /// Verdict for a `balance_error`.
    fn of(error: f64) -> Balance {
        match error {
            error if error <= 0.01 => Balance::Kept,
            error if error <= 0.1 => Balance::Doubtful,
            _ => Balance::Lost,
        }
    }
}

/// ½ Σ (M v·v + ω·Iω) of the motion relative to a frame (Eq. 54), J.
pub fn kinetic(bodies: &Skeleton<f64>, k: &Kinematics<f64>, frame: &Moving<f64>) -> f64 {
    kinetic_of(bodies, 0..bodies.links.len(), k, frame)
}

/// Kinetic energy of some segments.
fn kinetic_of(bodies: &Skeleton<f64>, segments: Range<usize>, k: &Kinematics<f64>, frame: &Moving<f64>) -> f64 {
    let segment = |n: usize| {
        let link = &bodies.links[n];
        let v = k.cg_velocity(bodies, n) - frame.velocity_at(k.cg(bodies, n));
        let w = k.axes[n].into_frame(k.omega[n] - frame.omega);
        let spin = link.by_inertia(w);
        link.mass * v.norm_squared() + spin.x * w.x + spin.y * w.y + spin.z * w.z
    };
    0.5 * (segments.clone().map(segment).sum::<f64>() + slid(bodies, segments, k, frame))
}

/// Σ m v·v of plates of some segments, less the value without sliding.
fn slid(bodies: &Skeleton<f64>, segments: Range<usize>, k: &Kinematics<f64>, frame: &Moving<f64>) -> f64 {
    let slides = bodies.slides[..k.sliding].iter().enumerate().filter(|(_, slide)| segments.contains(&slide.segment));
    let one = |(i, slide): (usize, &Slide<f64>)| {
        let (n, slid) = (slide.segment, &k.slides[i]);
        let at = |arm: V3<f64>| k.joint_velocity[n] + k.omega[n].cross(arm) - frame.velocity_at(k.joint[n] + arm);
        let now = at(slid.arm()) + slid.axis * slid.speed;
        slide.mass * (now.norm_squared() - at(slid.rest).norm_squared())
    };
    slides.map(one).sum()
}

/// Σ M g Z′ (Eq. 55 with Z′₀ = 0), J.
pub fn gravity(bodies: &Skeleton<f64>, k: &Kinematics<f64>) -> f64 {
    gravity_of(bodies, 0..bodies.links.len(), k)
}

/// The same by body.
pub(crate) fn gravity_by_body(bodies: &Skeleton<f64>, k: &Kinematics<f64>) -> [f64; MOST_BODIES] {
    let mut own_j = [0.0; MOST_BODIES];
    for (own_j, trunk) in own_j.iter_mut().zip(bodies.layout.trunks()) {
        *own_j = gravity_of(bodies, trunk.segments(), k);
    }
    own_j
}

/// Gravity energy of some segments.
fn gravity_of(bodies: &Skeleton<f64>, segments: Range<usize>, k: &Kinematics<f64>) -> f64 {
    let height = |n: usize| bodies.links[n].mass * k.cg(bodies, n).z;
    let slides =
        bodies.slides[..k.sliding].iter().zip(&k.slides).filter(|(slide, _)| segments.contains(&slide.segment));
    let slid: f64 = slides.map(|(slide, slid)| slide.mass * slid.axis.z * slid.way).sum();
    bodies.gravity * (segments.clone().map(height).sum::<f64>() + slid)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_body_that_sits_still_is_judged_by_what_matters_and_not_by_what_rounding_leaves() {
        let still = |imbalance_j| Extremes { kinetic_j: 1e-14, work_j: 1e-9, imbalance_j }.check(79.0);
        assert_eq!((still(1e-8).balance, still(1e-8).reference), (Balance::Kept, "kinetic energy at 1 cm/s"));
        assert_eq!(still(1e-3).balance, Balance::Lost);
        // nothing moved or pulled: nothing is known
        assert!(Greatest::default().check(&[79.0]).balance_error.is_nan());
    }

    #[test]
    fn a_heavy_body_does_not_hide_what_a_light_one_has_lost() {
        let [light, heavy] = [[9e2, 9e2, 3e2], [1e7, 1e7, 1.0]].map(|[kinetic_j, work_j, imbalance_j]| Extremes {
            kinetic_j,
            work_j,
            imbalance_j,
        });
        let all = Extremes { kinetic_j: 1e7, work_j: 1e7, imbalance_j: 3e2 };
        let mut greatest = Greatest { all, ..Greatest::default() };
        (greatest.each[0], greatest.each[1]) = (light, heavy);
        let found = greatest.check(&[79.0, 2e4]);
        assert_eq!((found.balance, found.reference), (Balance::Lost, "largest energy of one of the bodies"));
        assert!((found.balance_error - 1.0 / 3.0).abs() < 1e-12);
        let mut read = Greatest { all, ..Greatest::default() };
        read.read(&greatest.numbers());
        assert_eq!(read, greatest);
        // alone, a body is judged as all are
        assert_eq!(greatest.check(&[2e4]).balance, Balance::Kept);
    }
}
