//! Origin of a run: the information in its file, and how the run ended.

use occupant_core::model::Model;
use occupant_core::results::summary::{RunStatus, Summary};

use crate::base::Units;
use occupant_files::results::Results;

/// Summary line of the run: end time, body, quality of the integration.
pub fn facts(model: &Model, summary: &Summary, units: Units) -> String {
    let body = &model.setup().body;
    let energy = &summary.energy;
    format!(
        "{:.1} to {:.1} ms; {}, {}; {}, {} steps, energy balance off by {:.1e} of the {}",
        summary.start_s * 1e3,
        summary.reached_s * 1e3,
        body.name,
        units.say(body.mass_kg(), "kg", 1),
        summary.solver.integrator,
        summary.solver.steps,
        energy.balance_error,
        energy.reference
    )
}

/// How the run ended: keys and values.
pub fn ending(summary: &Summary, outputs: usize) -> Vec<[String; 2]> {
    let mut lines = Vec::new();
    let mut put = |key: &str, value: String| lines.push([key.to_owned(), value]);
    let status = match summary.status {
        RunStatus::Completed => "completed",
        RunStatus::Interrupted => "interrupted",
        RunStatus::Failed => "failed",
    };
    let reason = summary.reason.as_ref().map(|r| format!(": {r}"));
    put("status", format!("{status}{}", reason.unwrap_or_default()));
    put("reached", format!("{} s of {} s", summary.reached_s, summary.end_s));
    put("steps", summary.solver.steps.to_string());
    if summary.solver.rejected > 0 {
        put("steps rejected", summary.solver.rejected.to_string());
    }
    put("outputs", outputs.to_string());
    lines
}

/// Its file: keys and values.
pub fn origin(results: &Results) -> Vec<[String; 2]> {
    let mut lines = Vec::new();
    let mut put = |key: &str, value: String| lines.push([key.to_owned(), value]);
    put("results", results.path.display().to_string());
    put("results, SHA-256", results.sha256.clone());
    for (key, value) in &results.run {
        put(&key.replace('_', " "), value.clone());
    }
    lines
}
