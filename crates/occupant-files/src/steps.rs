//! Caveats of a run with a fixed step that follow from that step alone.

use occupant_core::diagnosis::{FrictionWatch, RK4_STABILITY_LIMIT, diagnose};
use occupant_core::model::Model;
use occupant_core::model::setup::Integrator;
use occupant_core::results::summary::{Caveat, Summary};

/// Caveats of a step too long for the active contacts or for friction; none under error control.
pub fn caveats(model: &Model, friction: &FrictionWatch, summary: &Summary) -> Vec<Caveat> {
    if !matches!(model.setup().integrator, Integrator::Rk4 { .. }) {
        return Vec::new();
    }
    let diagnosis = diagnose(model);
    let Some(step_s) = diagnosis.run.step_s else { return Vec::new() };
    let too_long = Caveat::step_too_long(step_s, RK4_STABILITY_LIMIT, &diagnosis.too_fast(), summary);
    let unstable = friction.unstable(model);
    let worst = unstable.iter().max_by(|a, b| a.number.total_cmp(&b.number));
    let chatters = worst.map(|one| Caveat::chatters(&one.sphere, &one.surface, step_s, one.time_s));
    too_long.into_iter().chain(chatters).collect()
}
