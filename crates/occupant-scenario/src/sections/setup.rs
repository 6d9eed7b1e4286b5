//! Converts the sections of a checked scenario to the core's plain SI data.
//!
//! Words, numbers and names have passed the check; keys that depend on each other are combined here. Physical
//! contradictions are left to the model, which checks all plain data.

use serde::Deserialize;

use super::builder::Builder;
use super::drive::Drives;
use super::quantity::si_or;
use super::{
    BodySection, JointsSection, Scenario, bags, belts, body, chains, columns, drive, frames, joints, materials, mount,
    muscles, path, plates, plausible, posture, run, self_contact, solids, surfaces, triggers,
};
use crate::check::references;
use occupant_core::body::Body;
use occupant_core::forces::joint::Joints;
use occupant_core::model::setup::{STANDARD_GRAVITY_M_S2, Setup};
use occupant_core::vehicle::VehiclePath;
use placed_text::{Diagnostics, Document, Problem, locate, with_key};

/// Builds the plain data; `written` is the original scenario, `explicit` the one with presets written out, and
/// `document` the tree of the latter.
pub(crate) fn setup(
    written: &Scenario,
    explicit: &Scenario,
    document: &Document,
    drives: Option<&Drives>,
) -> Result<(Setup, Diagnostics), Diagnostics> {
    let b = &mut Builder { document, problems: Diagnostics::new(), drives };
    let is_part = explicit.mount.is_some();
    let preset = written.body.as_ref().and_then(|body| body.preset.as_deref());
    let whole = explicit.body.as_ref().and_then(|own| body::body(b, preset, own, is_part));
    let preset_joints = written.joints.as_ref().and_then(|joints| joints.preset.as_deref());
    if let (Some(preset), Some(whole)) = (preset_joints, &whole) {
        joints::check_neck(b, preset, whole.tree);
        joints::check_grown(b, preset, written.body.as_ref());
    }
    // what is said of joints that are left out is as good as what is said of all
    let joints = whole.as_ref().zip(explicit.joints.as_ref());
    let joints = joints.map(|(whole, own)| joints::joints(b, own, whole.tree));
    let names = whole.as_ref().map_or_else(Vec::new, |whole| muscles::joint_names(whole.tree));
    let held = |whole: Body| match &explicit.mount {
        Some(section) => mount::held(b, section, &whole),
        None => Some(whole),
    };
    let (Some(body), Some(joints)) = (whole.and_then(held), joints) else {
        return Err(std::mem::take(&mut b.problems));
    };
    let mut joints = joints.of_tree(body.tree);
    references(&document.root, None).into_iter().for_each(|problem| b.report(problem));
    let materials = materials::materials(b, explicit);
    let surfaces = surfaces::surfaces(b, explicit, &body);
    let solids = solids::solids(b, explicit, &body);
    let self_contact = self_contact::self_contact(b, explicit, &body);
    let belts = belts::belts(b, explicit, &body);
    let (posture, velocity) = posture::posture(b, explicit, &body);
    let time = run::time(b, explicit);
    let integrator = run::integrator(b, explicit, &time);
    let output = run::output(b, explicit, &body);
    let gravity_m_s2 = si_or(&explicit.gravity, STANDARD_GRAVITY_M_S2);
    let path = first_path(b, explicit, gravity_m_s2);
    let frames = frames::frames(b, explicit, gravity_m_s2);
    let columns = columns::columns(b, explicit, &frames);
    let bands = explicit.body.as_ref().map_or_else(Vec::new, |own| plates::bands(b, own, &body));
    let behind = plates::behind(explicit, (&surfaces, &solids), posture.as_ref());
    let (mut chains, mut bags) = (Vec::new(), Vec::new());
    if let Some(path) = &path {
        let triggers = triggers::triggers(b, explicit, triggers::Paths { first: path, others: &frames }, &time);
        joints.muscles = muscles::muscles(b, explicit, &names, &body, &triggers);
        chains = chains::chains(b, explicit, &body, &triggers);
        bags = bags::bags(b, explicit, &body, &triggers);
    }
    if written.occupants.is_empty() {
        for (name, bag) in explicit.bags.iter().filter(|(_, bag)| bag.occupant.is_some()) {
            let found = format!("`{}` in a scenario without `occupants`", bag.occupant.as_deref().unwrap_or_default());
            b.error(&(with_key("bags", name) + ".occupant"), found, "no `occupant`: the bag touches the one there is");
        }
    }
    check_provenance(b, written);
    let (Some(path), Some(posture), false) = (path, posture, b.problems.has_errors()) else {
        return Err(std::mem::take(&mut b.problems));
    };
    let setup = Setup {
        title: explicit.title.clone(),
        body,
        joints,
        gravity_m_s2,
        materials,
        surfaces,
        solids,
        edge_force: surfaces::edge_force(explicit),
        self_contact,
        belts,
        chains,
        bags,
        columns,
        bands,
        behind,
        own_forces: Vec::new(),
        path,
        scenery: drives.map_or_else(Vec::new, |drives| drive::scenery(explicit, drives)),
        facts: drives.map_or_else(Vec::new, drive::facts),
        logs: drives.map_or_else(Vec::new, drive::logs),
        frames,
        members: Vec::new(),
        posture,
        velocity,
        time,
        integrator,
        output,
    };
    plausible::check(b, &setup, explicit);
    Ok((setup, std::mem::take(&mut b.problems)))
}

/// The path of the first vehicle.
fn first_path(b: &mut Builder, s: &Scenario, gravity_m_s2: f64) -> Option<VehiclePath> {
    match s.first_path() {
        Some((at, section)) if at.len() == 1 => path::path(b, section, gravity_m_s2),
        Some((at, section)) => frames::moving(b, &at, section, gravity_m_s2),
        None => {
            b.error("", "no path", "path = { kind = … }, the motion of the vehicle, or `vehicles`");
            None
        }
    }
}

/// Builds the occupant alone; `document` is the tree of an explicit scenario that came from `preset`.
pub(crate) fn occupant(preset: &str, document: &Document) -> Option<(Body, Joints)> {
    let body = BodySection::deserialize(document.root.get("body")?).ok()?;
    let joints = JointsSection::deserialize(document.root.get("joints")?).ok()?;
    let b = &mut Builder { document, problems: Diagnostics::new(), drives: None };
    let body = body::body(b, Some(preset), &body, false)?;
    let joints = joints::joints(b, &joints, body.tree);
    (!b.problems.has_errors()).then_some((body, joints))
}

/// Warns of provenance entries whose path does not exist in the scenario.
fn check_provenance(b: &mut Builder, written: &Scenario) {
    for topic in written.provenance.keys() {
        let is_path = topic.contains('.') && !topic.contains(' ');
        if is_path && locate(&b.document.root, topic).is_none() {
            let found = format!("`{topic}` is not part of the scenario");
            let expected = "a path such as materials.seat, or a topic in words";
            b.report(Problem::warning(with_key("provenance", topic), found, expected));
        }
    }
}
