//! All that the run carries on from an output, so that it can go on from there bit for bit.
//!
//! Pairs are numbered as the model numbers them; those in no list are open and have no greatest deformation.

use crash_measures::unit::Unit;
use occupant_core::forces::contact::{PASSED, PairHistory, TOUCHING};
use occupant_core::forces::{History, belt, contact};
use occupant_core::quantity::{Axes, Quantity, Take};
use occupant_core::results::catalogue::{Message, Run};
use occupant_core::results::checkpoint::StepUnderWay;
use occupant_core::results::sample::Sample;

use Take::{Count, Indices, Number, Numbers};

pub(super) const TOPIC: &str = "/checkpoint";

/// Message `occupant.Checkpoint`; `mcap::stored` reads it.
pub(super) fn checkpoint() -> Message {
    Message::of("Checkpoint", TOPIC, FIELDS)
}

const fn field(number: u32, name: &'static str, take: Take<Run>, meaning: &'static str) -> Quantity<Run> {
    Quantity::new(Unit::One, Axes::None, take).field(number, name, meaning)
}

#[rustfmt::skip]
const FIELDS: &[Quantity<Run>] = &[
    field(2, "output", Count(|s| s.index as u64), "number of the output, from 0"),
    field(3, "state", Numbers(|s| s.state.to_numbers().to_vec()), STATE),
    field(4, "pairs", Count(|s| s.history.memory.contacts.len() as u64), "how many pairs of a sphere and a face there are"),
    field(5, "passed", Indices(|s| pairs(s.history, |p| p.phase == PASSED)), "pairs whose sphere went round the edge"),
    field(6, "touching", Indices(|s| pairs(s.history, |p| p.phase == TOUCHING)), "pairs that touch"),
    field(7, "deformed", Indices(|s| pairs(s.history, is_deformed)), "pairs that remember a deformation"),
    field(8, "greatest_deformation_m", Numbers(|s| greatest(s.history)), "of each pair in `deformed`"),
    field(9, "belt_normal_vehicle", Numbers(|s| normals(s.history)), "x, y, z of the normal of each belt's plane"),
    field(10, "belt_greatest_elongation_m", Numbers(|s| elongations(s.history)), "of each belt"),
    field(11, "first_touch_sphere", Indices(|s| s.first_touches.iter().map(|t| t.sphere as u32).collect()), "index of the sphere of each first touch so far"),
    field(12, "first_touch_surface", Indices(|s| s.first_touches.iter().map(|t| t.surface as u32).collect()), "index of its surface"),
    field(13, "first_touch_time_s", Numbers(|s| s.first_touches.iter().map(|t| t.time_s).collect()), "its time"),
    field(14, "first_touch_closing_m_s", Numbers(|s| s.first_touches.iter().map(|t| t.closing_m_s).collect()), "its closing speed"),
    field(15, "steps", Count(|s| s.progress.effort.steps), "accepted steps so far"),
    field(16, "rejected", Count(|s| s.progress.effort.rejected), "rejected steps so far"),
    field(17, "evaluations", Count(|s| s.progress.effort.evaluations), "evaluations of the derivative so far"),
    field(18, "last_step_s", Number(|s| s.progress.effort.step_s), "last accepted step"),
    field(19, "wanted_step_s", Number(|s| s.progress.wanted_s), "step that the error control wants next"),
    field(20, "start_mechanical_j", Number(|s| s.progress.energy_start.mechanical_j), "kinetic, gravity and spring energy at the start of the run"),
    field(21, "start_contacts_j", Number(|s| s.progress.energy_start.stored_j[contact::STORED]), "stored in contacts at the start of the run"),
    field(22, "start_belts_j", Number(|s| s.progress.energy_start.stored_j[belt::STORED]), "stored in belts at the start of the run"),
    field(23, "greatest_kinetic_j", Number(|s| s.progress.greatest_kinetic_j), "greatest kinetic energy relative to the vehicle so far"),
    field(24, "greatest_imbalance_j", Number(|s| s.progress.greatest_imbalance_j), "greatest energy imbalance so far"),
    field(25, "step_error", Number(|s| s.progress.step_error), "error of the last accepted step in units of the tolerance"),
    field(26, "step_times_s", Numbers(|s| of_step(s, |step| vec![step.start_s, step.end_s])), "start and end of the step in which the output lies, if it goes on beyond it; the columns below tell its start"),
    field(27, "step_state", Numbers(|s| of_step(s, |step| step.state.to_numbers().to_vec())), "as `state`"),
    field(28, "step_passed", Indices(|s| of_step(s, |step| pairs(step.history, |p| p.phase == PASSED))), "as `passed`"),
    field(29, "step_touching", Indices(|s| of_step(s, |step| pairs(step.history, |p| p.phase == TOUCHING))), "as `touching`"),
    field(30, "step_deformed", Indices(|s| of_step(s, |step| pairs(step.history, is_deformed))), "as `deformed`"),
    field(31, "step_greatest_deformation_m", Numbers(|s| of_step(s, |step| greatest(step.history))), "as `greatest_deformation_m`"),
    field(32, "step_belt_normal_vehicle", Numbers(|s| of_step(s, |step| normals(step.history))), "as `belt_normal_vehicle`"),
    field(33, "step_belt_greatest_elongation_m", Numbers(|s| of_step(s, |step| elongations(step.history))), "as `belt_greatest_elongation_m`"),
];

const STATE: &str = "75 numbers in space axes, SI: T1; w, x, y, z of the 8 free segments (middle_torso, upper_torso, head, \
lower_torso, left_upper_arm, right_upper_arm, left_thigh, right_thigh); 4 hinges (left_forearm, right_forearm, left_lower_leg, \
right_lower_leg); velocity of T1; angular velocities of the 8; hinge rates; work of contacts, friction, joints, belts, vehicle";

fn is_deformed(pair: &PairHistory<f64>) -> bool {
    pair.greatest != 0.0
}

/// What `of` tells of the step under way; nothing if there is none.
fn of_step<T>(sample: &Sample<'_>, of: impl Fn(StepUnderWay<'_>) -> Vec<T>) -> Vec<T> {
    sample.under_way.map(of).unwrap_or_default()
}

/// Numbers of the pairs that are `so`.
fn pairs(history: &History<f64>, so: impl Fn(&PairHistory<f64>) -> bool) -> Vec<u32> {
    let numbered = (0..).zip(&history.memory.contacts);
    numbered.filter(|(_, p)| so(p)).map(|(i, _)| i).collect()
}

fn greatest(history: &History<f64>) -> Vec<f64> {
    let deformed = history.memory.contacts.iter().filter(|p| is_deformed(p));
    deformed.map(|p| p.greatest).collect()
}

fn normals(history: &History<f64>) -> Vec<f64> {
    let belts = history.memory.belts.iter();
    belts.flat_map(|b| [b.normal.x, b.normal.y, b.normal.z]).collect()
}

fn elongations(history: &History<f64>) -> Vec<f64> {
    history.memory.belts.iter().map(|b| b.greatest).collect()
}
