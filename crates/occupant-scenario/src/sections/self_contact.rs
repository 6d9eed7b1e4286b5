//! `[self_contact]`: its keys, converted to a [`SelfContact`].

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Scenario;
use super::builder::{Builder, index_of};
use occupant_core::body::Body;
use occupant_core::forces::contact::self_contact::SelfContact;
use placed_text::with_key;

/// Lets parts of the body touch each other. If absent, they pass through each other, as in the report.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SelfContactSection {
    /// Name of the skin material in `materials`. Two skins deform in series.
    pub(crate) skin: String,
    /// Skin materials of single parts, by the names of parts or spheres.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) skins: IndexMap<String, String>,
    /// Pairs of parts that can touch. If absent: hands, elbows, knees, thighs, shins and feet with the parts within
    /// their reach, and arms with the ribs and the abdomen of a body with `sides`. Parts that share a joint, or overlap
    /// in a standing body, never touch.
    pub(crate) pairs: Option<Vec<[String; 2]>>,
}

/// The contact of the body with itself, if any.
pub(super) fn self_contact(b: &mut Builder, scenario: &Scenario, body: &Body) -> Option<SelfContact> {
    let section = scenario.self_contact.as_ref()?;
    let material = |name: &str| index_of(name, scenario.materials.keys().map(String::as_str));
    let mut own = SelfContact::of(body, material(&section.skin));
    for (part, skin) in &section.skins {
        let spheres = body.spheres_called(part);
        if spheres.is_empty() {
            b.sphere(&with_key("self_contact.skins", part), part, body);
        }
        spheres.into_iter().for_each(|sphere| own.skins[sphere] = material(skin));
    }
    if let Some(pairs) = &section.pairs {
        own.pairs = pairs.iter().enumerate().flat_map(|(i, pair)| named(b, body, i, pair)).collect();
        own.pairs.sort_unstable();
        own.pairs.dedup();
    }
    Some(own)
}

/// The pairs of spheres of a named pair of parts.
fn named(b: &mut Builder, body: &Body, i: usize, pair: &[String; 2]) -> Vec<[usize; 2]> {
    let path = format!("self_contact.pairs[{i}]");
    if b.spheres(&path, pair, body).len() < 2 {
        return Vec::new();
    }
    let spheres = SelfContact::between(body, [pair.clone()].into_iter());
    if spheres.is_empty() {
        let found = format!("{} and {}, which share a joint or overlap in a standing body", pair[0], pair[1]);
        b.error(&path, found, "parts that can be apart and then touch");
    }
    spheres
}
