//! A checked scenario → the core's plain SI data.
//!
//! The words have passed the check; here names are looked up and keys that only make sense together are put together.
//! Numbers that contradict the physics are left to the model, which checks plain data whoever made it.

mod belts;
mod body;
mod builder;
mod joints;
mod path;
mod plausible;
mod posture;
mod presets;
mod pulse;
mod run;
pub(super) mod sensors;
mod surfaces;

use builder::Builder;

use super::diagnostic::Diagnostics;
use super::document::Node;
use super::model::Scenario;
use super::source::{SourceId, Sources};
use crate::model::setup::Setup;

/// Builds the plain data; `written` is the scenario as it was written, `explicit` the one with presets written out, and
/// `root` the tree of the latter.
pub(super) fn build(
    written: &Scenario,
    explicit: &Scenario,
    root: &Node,
    sources: &Sources,
    path_table: Option<SourceId>,
) -> Result<(Setup, Diagnostics), Diagnostics> {
    let mut b = Builder::new(sources, root, written.units.unwrap_or_default());
    let body = body::body(&mut b, written.body.preset.as_deref(), &explicit.body);
    let joints = joints::joints(&mut b, &explicit.joints);
    let materials = surfaces::materials(&mut b, explicit);
    let surfaces = surfaces::surfaces(&mut b, explicit, &body);
    let belts = belts::belts(&mut b, explicit, &body);
    let (posture, velocity) = posture::posture(&mut b, explicit, &body);
    let time = run::time(&mut b, explicit);
    let integrator = run::integrator(&mut b, explicit);
    let output = run::output(explicit);
    let gravity_m_s2 = b.optional("gravity", &explicit.gravity, crate::model::setup::STANDARD_GRAVITY_M_S2);
    let path = path::path(&mut b, &explicit.path, path_table, gravity_m_s2);
    b.check_provenance(written);
    let title = explicit.title.clone();
    let (Some(path), Some(posture), false) = (path, posture, b.problems.has_errors()) else {
        return Err(b.problems);
    };
    let setup = Setup {
        title,
        body,
        joints,
        gravity_m_s2,
        materials,
        surfaces,
        edge_force: run::edge_force(explicit),
        belts,
        path,
        posture,
        velocity,
        time,
        integrator,
        output,
    };
    plausible::check(&mut b, &setup, explicit);
    Ok((setup, b.problems))
}
