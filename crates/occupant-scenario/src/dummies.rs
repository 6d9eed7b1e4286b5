//! `body.dummy`: body, joints and chest of a dummy by one name; other keys of the scenario override them.

use serde::Deserialize;

use crate::sections::DummyChoice;
use placed_text::Node;

/// Whether any body of a scenario uses `dummy`.
pub(super) fn any(root: &Node) -> bool {
    bodies(root).next().is_some()
}

/// The dummies of a scenario, as keys of the other sections.
pub(super) fn words(root: &Node) -> String {
    let one = |(prefix, body): (String, &Node)| {
        let choice = DummyChoice::deserialize(body.get("dummy")?).ok()?;
        let ([person, chest, joints], head_kg) = parts(choice);
        Some(format!(
            "[{prefix}body]\npreset = \"{person}\"\nsegment_count = 17\nchest = \"{chest}\"\nsegments.head.mass = \"{head_kg} kg\"\n\
             [{prefix}joints]\npreset = \"{joints}\"\n\n"
        ))
    };
    bodies(root).filter_map(one).collect()
}

/// Prefix of the sections of each body that names a dummy, and its section.
fn bodies(root: &Node) -> impl Iterator<Item = (String, &Node)> {
    let several = root.get("occupants").and_then(Node::as_table).into_iter().flatten();
    let several = several.map(|(name, entry)| (format!("occupants.{name}."), &entry.node));
    let all = std::iter::once((String::new(), root)).chain(several);
    all.filter_map(|(prefix, own)| Some((prefix, own.get("body")?))).filter(|(_, body)| body.get("dummy").is_some())
}

/// Body, chest and joints, and the head mass for which its neck was fitted, kg.
fn parts(choice: DummyChoice) -> ([&'static str; 3], f64) {
    match choice {
        DummyChoice::HybridIii50M => (["male50", "dummy50", "dummy50-like"], 4.54),
        DummyChoice::HybridIii5F => (["female05", "dummy05f", "dummy05f-like"], 3.69),
        DummyChoice::HybridIii6C => (["child06", "rigid", "dummy06c-like"], 3.47),
        DummyChoice::HybridIi => (["male50", "rigid", "dummy50-1973-like"], 4.54),
    }
}
