//! Metadata records and attachments of a run in its file.
//!
//! The record `occupant.run` comes first. `occupant.result` comes last and describes how the run ended: a file without
//! it is an incomplete run.

use std::collections::BTreeMap;

use mcap::records::Metadata;
use occupant_core::model::Model;
use occupant_core::model::setup::Integrator;
use occupant_core::results::outcome::{Outcome, Status};

use crate::base::sha256;

/// Name of the first metadata record.
pub const RUN: &str = "occupant.run";
/// Name of the last metadata record.
pub const RESULT: &str = "occupant.result";

/// Name of the attachment with the scenario after all expansions and overrides.
pub const RESOLVED: &str = "resolved.toml";

/// Key of the first metadata record: settings of the run that are not in its scenario.
pub const BEYOND: &str = "beyond_scenario";

/// A text stored with the results.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Document {
    /// File name, without a folder.
    pub name: String,
    /// Media type, e.g. `application/toml`.
    pub media_type: String,
    /// Its bytes as read.
    pub content: Vec<u8>,
}

/// Origin of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct About {
    /// The program and its version, e.g. `occupant 0.1.0`.
    pub program: String,
    /// The scenario as it was read.
    pub scenario: Document,
    /// The scenario after all expansions and overrides, if it differs.
    pub resolved: Option<Document>,
    /// Further entries of the first metadata record, reproducible for the same scenario.
    pub notes: BTreeMap<String, String>,
}

/// The first metadata record, for a scenario that refers to `tables`.
pub fn run(about: &About, tables: &[Document], model: &Model) -> Metadata {
    let setup = model.setup();
    let mut entries = about.notes.clone();
    let mut put = |key: &str, value: String| entries.insert(key.to_owned(), value);
    put("program", about.program.clone());
    put("title", setup.title.clone());
    put("scenario", about.scenario.name.clone());
    put("scenario_sha256", sha256(&about.scenario.content));
    for table in tables {
        put(&format!("sha256 {}", table.name), sha256(&table.content));
    }
    put("body", setup.body.name.clone());
    put("body_mass_kg", setup.body.mass_kg().to_string());
    put("gravity_m_s2", setup.gravity_m_s2.to_string());
    put("start_s", setup.time.start_s.to_string());
    put("end_s", setup.time.end_s.to_string());
    put("output_s", setup.time.output_s.to_string());
    let beyond = setup.beyond_scenario();
    if !beyond.is_empty() {
        put(BEYOND, beyond.join(", "));
    }
    let offset = "log time 0 is the start of the run; add start_s for the scenario's time";
    put("time", offset.to_owned());
    put("edge_force", format!("{:?}", setup.edge_force));
    put("frames", FRAMES.to_owned());
    for (key, value) in integrator(&setup.integrator) {
        put(key, value);
    }
    Metadata { name: RUN.to_owned(), metadata: entries }
}

const FRAMES: &str = "space: X forward, Y left, Z up; vehicle: X forward, Y right, Z down, origin at its centre of \
gravity; occupant/<segment>: X forward, Y left, Z up when standing, origin at the segment's centre of gravity; \
path: X forward, Y right, Z down, origin of space. SI units, angles in rad.";

/// The last metadata record, after `outputs` outputs.
pub fn result(outcome: &Outcome, outputs: u64) -> Metadata {
    let (status, reason) = match &outcome.status {
        Status::Completed => ("completed", "reached its end time".to_owned()),
        Status::Stopped => ("stopped", "stopped before its end time".to_owned()),
        Status::Failed(error) => ("failed", error.to_string()),
    };
    let entries = [
        ("status", status.to_owned()),
        ("reason", reason),
        ("time_s", outcome.time_s.to_string()),
        ("outputs", outputs.to_string()),
        ("steps", outcome.effort.steps.to_string()),
        ("rejected", outcome.effort.rejected.to_string()),
        ("evaluations", outcome.effort.evaluations.to_string()),
        ("greatest_kinetic_j", outcome.energy.greatest_kinetic_j.to_string()),
        ("balance_error", outcome.energy.balance_error.to_string()),
        ("balance_reference", outcome.energy.reference.to_owned()),
    ];
    Metadata { name: RESULT.to_owned(), metadata: entries.map(|(k, v)| (k.to_owned(), v)).into() }
}

fn integrator(integrator: &Integrator) -> Vec<(&'static str, String)> {
    match *integrator {
        Integrator::Rk4 { step_s } => vec![("integrator", "rk4".to_owned()), ("step_s", step_s.to_string())],
        Integrator::Adaptive { relative, absolute_m, absolute_m_s, min_step_s, max_step_s } => vec![
            ("integrator", "adaptive".to_owned()),
            ("relative", relative.to_string()),
            ("absolute_m", absolute_m.to_string()),
            ("absolute_m_s", absolute_m_s.to_string()),
            ("min_step_s", min_step_s.to_string()),
            ("max_step_s", max_step_s.to_string()),
        ],
    }
}
