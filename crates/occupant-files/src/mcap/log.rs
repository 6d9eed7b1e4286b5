//! `/log`: warnings, first contacts, how the run ended.

use occupant_core::model::Model;
use occupant_core::results::outcome::{FirstTouch, Outcome, Status};

use super::foxglove::Level;
use super::wire::Wire;

/// A `foxglove.Log`.
pub fn write(wire: &mut Wire, ns: u64, level: Level, message: &str) {
    wire.time(1, ns);
    wire.count(2, level as u64);
    wire.text(3, message);
    wire.text(4, "occupant");
    wire.text(5, "");
    wire.index(6, 0);
}

/// Names for the log, which is written when the model is no longer available.
#[derive(Debug)]
pub struct Names {
    spheres: Vec<String>,
    surfaces: Vec<String>,
}

impl Names {
    /// Names of a model.
    pub fn of(model: &Model) -> Self {
        let setup = model.setup();
        Names {
            spheres: setup.body.spheres.iter().map(|s| s.name.clone()).collect(),
            surfaces: setup.surface_names().map(str::to_owned).collect(),
        }
    }

    /// A first contact in words.
    pub fn first_touch(&self, touch: &FirstTouch) -> String {
        format!(
            "{} touches {} first at t = {:.6} s, at {:.3} m/s, closing at {:.3} m/s",
            self.spheres[touch.sphere], self.surfaces[touch.surface], touch.time_s, touch.speed_m_s, touch.closing_m_s
        )
    }
}

/// Message about the end of the run, and its level.
pub fn end(outcome: &Outcome) -> (Level, String) {
    match &outcome.status {
        Status::Completed => (Level::Info, format!("completed at t = {:.6} s", outcome.time_s)),
        Status::Stopped => (Level::Warning, format!("stopped at t = {:.6} s", outcome.time_s)),
        Status::Failed(error) => (Level::Error, format!("failed: {error}")),
    }
}
