//! Coupled passes of `[drive]`: the vehicles, the people in them, and the vehicles again with the forces of the people.

use occupant_core::model::Model;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use placed_text::{Diagnostics, Problem};

use super::loaded::Loaded;
use super::sections::{Drives, Pushers};

/// A change of all positions below which no further pass is made, m.
const SETTLED_M: f64 = 1e-3;
/// Longest interval at which the force of people is taken, s.
const LOOK_S: f64 = 2.5e-4;

impl Loaded {
    /// Drives with the forces of people after at most as many passes as the scenario asks for; `drives` has people as mass.
    ///
    /// # Errors
    /// People who cannot be simulated, and drives that break off.
    pub(super) fn passed(&self, drives: Drives, problems: &mut Diagnostics) -> Result<Drives, Diagnostics> {
        self.passed_until(drives, problems, SETTLED_M)
    }

    /// The same until all positions change by less than `settled_m`, m.
    pub(super) fn passed_until(
        &self,
        drives: Drives,
        problems: &mut Diagnostics,
        settled_m: f64,
    ) -> Result<Drives, Diagnostics> {
        let asked = self.explicit().drive.as_ref().and_then(|drive| drive.passes).unwrap_or(0);
        let at = |problem: Problem| self.document().place(problem);
        if asked > 0 && Pushers::of(self.explicit(), &drives).is_none() {
            let expected = "0, or people in a vehicle whose path is that of a vehicle of `drive`";
            problems.add(Problem::warning("drive.passes", "passes of vehicles in which nobody sits", expected), at);
            return Ok(drives);
        }
        let mut last = drives.clone();
        for pass in 1..=asked {
            let Some(mut pushers) = Pushers::of(self.explicit(), &drives) else { break };
            let broke = |what: String| {
                let found = format!("pass {pass} broke off: {what}");
                Diagnostics::from(at(Problem::error(
                    "drive.passes",
                    found,
                    "0, or people who can be simulated to the end",
                )))
            };
            let mut setup = self.built(Some(&last))?.0;
            setup.time.output_s /= (setup.time.output_s / LOOK_S).ceil().max(1.0);
            let model = Model::new(setup).map_err(|problems| self.diagnose(&problems))?;
            simulate(&model, Watch(|sample: &Sample<'_>| pushers.see(sample)))
                .map_err(|error| broke(error.to_string()))?;
            last = last.again(self.explicit(), &drives, &pushers.pushes).map_err(|error| broke(error.to_string()))?;
            if last.changes_m.last().is_some_and(|change_m| *change_m < settled_m) {
                break;
            }
        }
        if let Some(change_m) = last.changes_m.last().filter(|change_m| **change_m >= settled_m) {
            let found = format!("pass {asked}, the last, still moved a vehicle by {:.1} mm", 1e3 * change_m);
            let expected =
                format!("more passes: they end once all positions change by less than {} mm", 1e3 * settled_m);
            problems.add(Problem::warning("drive.passes", found, expected), at);
        }
        Ok(last)
    }
}
