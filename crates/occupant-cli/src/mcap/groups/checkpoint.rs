//! All that the run carries on from an output, so that it can go on from there bit for bit.
//!
//! Pairs are numbered as the model numbers them; those in no list are open and have no greatest deformation.

use occupant_core::kernel::contact::{PASSED, PairHistory, TOUCHING};
use occupant_core::sample::Sample;

use crate::mcap::column::{Group, TIME, Value, column};
use Value::{Count, Indices, Number, Numbers};

/// Message `occupant.Checkpoint`; `mcap::stored` reads it.
#[rustfmt::skip]
pub const CHECKPOINT: Group = Group {
    message: "Checkpoint",
    columns: &[
        TIME,
        column(2, "output", Count(|s, _| s.index as u64), "number of the output, from 0"),
        column(3, "state", Numbers(|s| s.state.to_numbers().to_vec()), STATE),
        column(4, "pairs", Count(|s, _| s.history.pairs.len() as u64), "how many pairs of a sphere and a face there are"),
        column(5, "passed", Indices(|s| pairs(s, |p| p.phase == PASSED)), "pairs whose sphere went round the edge"),
        column(6, "touching", Indices(|s| pairs(s, |p| p.phase == TOUCHING)), "pairs that touch"),
        column(7, "deformed", Indices(|s| pairs(s, is_deformed)), "pairs that remember a deformation"),
        column(8, "greatest_deformation_m", Numbers(greatest), "of each pair in `deformed`"),
        column(9, "belt_normal_vehicle", Numbers(normals), "x, y, z of the normal of each belt's plane"),
        column(10, "belt_greatest_elongation_m", Numbers(|s| s.history.belts.iter().map(|b| b.greatest).collect()), "of each belt"),
        column(11, "first_touch_sphere", Indices(|s| s.first_touches.iter().map(|t| t.sphere as u32).collect()), "index of the sphere of each first touch so far"),
        column(12, "first_touch_surface", Indices(|s| s.first_touches.iter().map(|t| t.surface as u32).collect()), "index of its surface"),
        column(13, "first_touch_time_s", Numbers(|s| s.first_touches.iter().map(|t| t.time_s).collect()), "its time"),
        column(14, "first_touch_closing_m_s", Numbers(|s| s.first_touches.iter().map(|t| t.closing_m_s).collect()), "its closing speed"),
        column(15, "steps", Count(|s, _| s.progress.effort.steps), "accepted steps so far"),
        column(16, "rejected", Count(|s, _| s.progress.effort.rejected), "rejected steps so far"),
        column(17, "evaluations", Count(|s, _| s.progress.effort.evaluations), "evaluations of the derivative so far"),
        column(18, "last_step_s", Number(|s, _| s.progress.effort.step_s), "last accepted step"),
        column(19, "wanted_step_s", Number(|s, _| s.progress.wanted_s), "step that the error control wants next"),
        column(20, "start_mechanical_j", Number(|s, _| s.progress.energy_start.mechanical_j), "kinetic, gravity and spring energy at the start of the run"),
        column(21, "start_contacts_j", Number(|s, _| s.progress.energy_start.contacts_j), "stored in contacts at the start of the run"),
        column(22, "start_belts_j", Number(|s, _| s.progress.energy_start.belts_j), "stored in belts at the start of the run"),
        column(23, "greatest_kinetic_j", Number(|s, _| s.progress.greatest_kinetic_j), "greatest kinetic energy relative to the vehicle so far"),
        column(24, "greatest_imbalance_j", Number(|s, _| s.progress.greatest_imbalance_j), "greatest energy imbalance so far"),
    ],
};

const STATE: &str = "75 numbers in space axes, SI: T1; w, x, y, z of the 8 free segments (middle_torso, upper_torso, head, \
lower_torso, left_upper_arm, right_upper_arm, left_thigh, right_thigh); 4 hinges (left_forearm, right_forearm, left_lower_leg, \
right_lower_leg); velocity of T1; angular velocities of the 8; hinge rates; work of contacts, friction, joints, belts, vehicle";

fn is_deformed(pair: &PairHistory<f64>) -> bool {
    pair.greatest != 0.0
}

/// Numbers of the pairs that are `so`.
fn pairs(sample: &Sample<'_>, so: impl Fn(&PairHistory<f64>) -> bool) -> Vec<u32> {
    let numbered = (0..).zip(&sample.history.pairs);
    numbered.filter(|(_, p)| so(p)).map(|(i, _)| i).collect()
}

fn greatest(sample: &Sample<'_>) -> Vec<f64> {
    let deformed = sample.history.pairs.iter().filter(|p| is_deformed(p));
    deformed.map(|p| p.greatest).collect()
}

fn normals(sample: &Sample<'_>) -> Vec<f64> {
    let belts = sample.history.belts.iter();
    belts
        .flat_map(|b| [b.normal.x, b.normal.y, b.normal.z])
        .collect()
}
