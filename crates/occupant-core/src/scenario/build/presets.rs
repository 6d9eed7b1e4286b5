//! The occupants that come with the program, for programs that do without a text. Their numbers stand once, in
//! `scenario/presets`, and are read here as a scenario's are.

use std::sync::OnceLock;

use serde::de::DeserializeOwned;

use super::builder::Builder;
use super::{body, joints};
use crate::body::Body;
use crate::forces::joint::Joints;
use crate::scenario::document::Node;
use crate::scenario::expand::expand;
use crate::scenario::kind::UnitSystem;
use crate::scenario::model::{BodySection, JointsSection};
use crate::scenario::source::Sources;
use crate::scenario::toml_text;

impl Body {
    /// The 50th-percentile male (78.7 kg) of the GEBOD generator, with the report's 17 spheres: `body.preset = "male50"`.
    pub fn male50() -> Self {
        male50().0.clone()
    }
}

impl Joints {
    /// A starting set of dampings, stops and spinal springs for [`Body::male50`]: `joints.preset = "male50"`.
    pub fn male50() -> Self {
        male50().1.clone()
    }
}

fn male50() -> &'static (Body, Joints) {
    static MALE50: OnceLock<(Body, Joints)> = OnceLock::new();
    MALE50.get_or_init(|| occupant("male50").expect("the preset is part of the program, and a test builds it"))
}

/// The occupant of a scenario that says nothing but the name of a preset.
fn occupant(preset: &str) -> Option<(Body, Joints)> {
    let mut sources = Sources::new();
    let text = format!("body = {{ preset = \"{preset}\" }}\njoints = {{ preset = \"{preset}\" }}\n");
    let id = sources.add("preset", text);
    let root = toml_text::parse(&sources, id).ok()?;
    let explicit = expand(&mut sources, &root);
    let (body_section, joints_section): (BodySection, JointsSection) =
        (section(&explicit, "body")?, section(&explicit, "joints")?);
    let mut b = Builder::new(&sources, &explicit, UnitSystem::default());
    let occupant = (body::body(&mut b, Some(preset), &body_section), joints::joints(&mut b, &joints_section));
    (!b.problems.has_errors()).then_some(occupant)
}

fn section<T: DeserializeOwned>(root: &Node, key: &str) -> Option<T> {
    T::deserialize(root.get(key)?.to_json()).ok()
}
