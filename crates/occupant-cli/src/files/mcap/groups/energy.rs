//! The energy ledger.

use crate::files::mcap::column::{Group, TIME, Value, column};
use Value::Number;

/// Message `occupant.EnergyLedger`.
pub(crate) const ENERGY: Group = Group {
    message: "EnergyLedger",
    columns: &[
        TIME,
        column(2, "kinetic_j", Number(|s, _| s.energy.kinetic_j), "kinetic energy in space"),
        column(
            3,
            "kinetic_relative_j",
            Number(|s, _| s.energy.kinetic_relative_j),
            "kinetic energy of the motion relative to the vehicle",
        ),
        column(4, "gravity_j", Number(|s, _| s.energy.gravity_j), "M g Z', zero at Z' = 0"),
        column(5, "spine_j", Number(|s, _| s.energy.spine_j), "stored in joint springs"),
        column(6, "contacts_j", Number(|s, _| s.energy.contacts_j), "recoverable, in contacts"),
        column(7, "belts_j", Number(|s, _| s.energy.belts_j), "recoverable, in belts"),
        column(8, "lost_contacts_j", Number(|s, _| s.energy.lost_contacts_j), "dissipated by contacts since the start"),
        column(9, "lost_friction_j", Number(|s, _| s.energy.lost_friction_j), "dissipated by friction since the start"),
        column(
            10,
            "lost_joints_j",
            Number(|s, _| s.energy.lost_joints_j),
            "dissipated by joint dampers and stops since the start",
        ),
        column(11, "lost_belts_j", Number(|s, _| s.energy.lost_belts_j), "dissipated by belts since the start"),
        column(
            12,
            "vehicle_work_j",
            Number(|s, _| s.energy.vehicle_work_j),
            "work of the moving vehicle on the occupant since the start",
        ),
        column(
            13,
            "balance_j",
            Number(|s, _| s.energy.balance_j),
            "present sum less the sum at the start; 0 for an exact integration",
        ),
    ],
};
