//! Where a run comes from: what the file says of itself, and how the run ended.

use occupant_core::results::summary::{RunStatus, Summary};

use crate::files::results::Results;

/// Key and value, in order.
pub(crate) fn lines(results: &Results, summary: &Summary) -> Vec<[String; 2]> {
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
    put("outputs", results.checkpoints.len().to_string());
    put("results", results.path.display().to_string());
    put("results, SHA-256", results.sha256.clone());
    for (key, value) in &results.run {
        put(&key.replace('_', " "), value.clone());
    }
    lines
}
