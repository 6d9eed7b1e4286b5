//! The energy ledger and the work of the integrator.

use crash_measures::unit::Unit::{Joule, Second};

use crate::forces::{belt, contact, joint};
use crate::quantity::{Owner, Quantity};
use crate::results::energy::EnergyLedger;
use crate::results::sample::Effort;

impl Owner for EnergyLedger {
    type At<'a> = EnergyLedger;
}

impl Owner for Effort {
    type At<'a> = Effort;
}

type Of = Quantity<EnergyLedger>;

const fn energy(
    number: u32,
    name: &'static str,
    of: fn(&EnergyLedger) -> f64,
    history: &'static str,
    meaning: &'static str,
) -> Of {
    Of::number(Joule, of).channel(name, history).field(number, name, meaning)
}

/// Message `EnergyLedger`.
#[rustfmt::skip]
pub(super) const ENERGIES: &[Of] = &[
    energy(2, "kinetic", |e| e.kinetic_j, "kinetic energy in space", "kinetic energy in space"),
    energy(3, "kinetic_relative", |e| e.kinetic_relative_j, "kinetic energy of the motion relative to the vehicle", "kinetic energy of the motion relative to the vehicle"),
    energy(4, "gravity", |e| e.gravity_j, "potential energy of gravity, zero at Z′ = 0", "M g Z', zero at Z' = 0"),
    energy(5, "spine", |e| e.stored_j[joint::STORED], "stored in the joints' springs", "stored in joint springs"),
    energy(6, "contacts", |e| e.stored_j[contact::STORED], "stored in contacts", "recoverable, in contacts"),
    energy(7, "belts", |e| e.stored_j[belt::STORED], "stored in belts", "recoverable, in belts"),
    energy(8, "lost_contacts", |e| e.lost_j[contact::PRESS], "dissipated by contacts", "dissipated by contacts since the start"),
    energy(9, "lost_friction", |e| e.lost_j[contact::FRICTION], "dissipated by friction", "dissipated by friction since the start"),
    energy(10, "lost_joints", |e| e.lost_j[joint::DAMPING], "dissipated by joints", "dissipated by joint dampers and stops since the start"),
    energy(11, "lost_belts", |e| e.lost_j[belt::STRETCH], "dissipated by belts", "dissipated by belts since the start"),
    energy(12, "vehicle_work", |e| e.vehicle_work_j, "work of the vehicle on the occupant", "work of the moving vehicle on the occupant since the start"),
    energy(13, "balance", |e| e.balance_j, "present sum less the sum at the start", "present sum less the sum at the start; 0 for an exact integration"),
];

type Work = Quantity<Effort>;

/// Message `SolverState`.
pub(super) const EFFORT: &[Work] = &[
    Work::count(|e| e.steps).field(2, "steps", "accepted steps so far"),
    Work::count(|e| e.rejected).field(3, "rejected", "rejected steps so far"),
    Work::count(|e| e.evaluations).field(4, "evaluations", "evaluations of the derivative so far"),
    Work::number(Second, |e| e.step_s).field(5, "last_step", "last accepted step"),
];
