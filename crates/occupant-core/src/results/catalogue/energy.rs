//! The energy ledger and the work of the integrator.

use occupant_units::unit::Unit::Second;

use crate::quantity::{Energy, Owner, Quantity, energy};
use crate::results::energy::EnergyLedger;
use crate::results::sample::Effort;

impl Owner for Effort {
    type At<'a> = Effort;
}

/// An energy of the ledger.
pub(super) type Part = (fn(&EnergyLedger) -> f64, Quantity<Energy>);

/// First energies of the message `EnergyLedger`, before those of the force elements.
#[rustfmt::skip]
pub(super) const MOTION: [Part; 3] = [
    (|e| e.kinetic_j, energy(2, "kinetic", "kinetic energy in space", "kinetic energy in space")),
    (|e| e.kinetic_relative_j, energy(3, "kinetic_relative", RELATIVE, RELATIVE)),
    (|e| e.gravity_j, energy(4, "gravity", "potential energy of gravity, zero at Z′ = 0", "M g Z', zero at Z' = 0")),
];

const RELATIVE: &str = "kinetic energy of the motion relative to the vehicle";

/// Last energies of that message.
#[rustfmt::skip]
pub(super) const BALANCE: [Part; 2] = [
    (|e| e.vehicle_work_j, energy(12, "vehicle_work", "work of the vehicle on the occupant", "work of the moving vehicle on the occupant since the start")),
    (|e| e.balance_j, energy(13, "balance", "present sum less the sum at the start", "present sum less the sum at the start; 0 for an exact integration")),
];

/// Message `EnergyOfBody`: energies of one of several bodies.
#[rustfmt::skip]
pub(super) const OF_BODY: [Part; 6] = [
    (|e| e.kinetic_j, energy(2, "kinetic", "kinetic energy of {} in space", "kinetic energy in space")),
    (|e| e.gravity_j, energy(3, "gravity", "potential energy of {}, zero at Z′ = 0", "M g Z', zero at Z' = 0")),
    (|e| e.stored_j.iter().sum::<f64>() + e.lost_j.iter().sum::<f64>(), energy(4, "elements", "energy of {} that force elements store and have lost", "stored in and lost by the force elements that are in its books")),
    (|e| e.vehicle_work_j, energy(5, "vehicle_work", "work of vehicles and panels on {}", "work of moving vehicles and panels since the start")),
    (|e| e.others_work_j, energy(6, "others_work", "work of other bodies on {}", "work of other bodies since the start: what one gets another gives")),
    (|e| e.balance_j, energy(7, "balance", "present sum of {} less the sum at the start", "present sum less the sum at the start; 0 for an exact integration")),
];

type Work = Quantity<Effort>;

/// Message `SolverState`.
pub(super) const EFFORT: &[Work] = &[
    Work::count(|e| e.steps).field(2, "steps", "accepted steps so far"),
    Work::count(|e| e.rejected).field(3, "rejected", "rejected steps so far"),
    Work::count(|e| e.evaluations).field(4, "evaluations", "evaluations of the derivative so far"),
    Work::number(Second, |e| e.step_s).field(5, "last_step", "last accepted step"),
];
