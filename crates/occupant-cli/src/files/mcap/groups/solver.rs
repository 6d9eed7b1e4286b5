//! Work of the integrator.

use crate::files::mcap::column::{Group, TIME, Value, column};
use Value::{Count, Number};

/// Message `occupant.SolverState`.
pub(crate) const SOLVER: Group = Group {
    message: "SolverState",
    columns: &[
        TIME,
        column(2, "steps", Count(|s, _| s.effort.steps), "accepted steps so far"),
        column(3, "rejected", Count(|s, _| s.effort.rejected), "rejected steps so far"),
        column(4, "evaluations", Count(|s, _| s.effort.evaluations), "evaluations of the derivative so far"),
        column(5, "last_step_s", Number(|s, _| s.effort.step_s), "last accepted step"),
    ],
};
