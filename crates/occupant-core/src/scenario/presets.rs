//! The occupants that come with the program, for programs that do without a text. Their numbers stand once, in
//! `scenario/presets`, and are read here as a scenario's are.

use std::sync::OnceLock;

use super::expand::expand;
use super::sections::occupant;
use crate::body::Body;
use crate::forces::joint::Joints;
use placed_text::{Document, Format};

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
    MALE50.get_or_init(|| read("male50").expect("the preset is part of the program, and a test builds it"))
}

/// The occupant of a scenario that says nothing but the name of a preset.
fn read(preset: &str) -> Option<(Body, Joints)> {
    let text = format!("body = {{ preset = \"{preset}\" }}\njoints = {{ preset = \"{preset}\" }}\n");
    let mut document = Document::read(&text, Format::Toml, "preset").ok()?;
    document.root = expand(&mut document.sources, &document.root);
    occupant(preset, &document)
}
