//! What decides on the samples of a study: the contents of its texts, whatever their comments and white space.

use std::fmt::Write;

use occupant_study::{Design, Study};
use placed_text::{Document, Node, Value};

use crate::base::sha256;
use crate::files::study_folder::{NamedBy, Text};

/// SHA-256 of the contents of study, scenario and tables. Of a design whose first samples stay as they are when there are more,
/// the number of samples does not count, nor does its table.
pub fn digest(study: &Study, texts: &[(&Text, &[u8])]) -> String {
    let grows = fixed(&study.design).is_none();
    let mut all = String::new();
    for (i, (text, bytes)) in texts.iter().enumerate() {
        let read = if i < 2 { Document::read_bytes(bytes, None, &text.name).ok() } else { None };
        let counts = match read {
            Some(document) => contents_of(&document.root, i == 0 && grows),
            None if grows && is_table_of(&study.design, text) => String::new(),
            None => text.sha256.clone(),
        };
        all += &format!("{:?} {:?} {counts}\n", text.by, text.name);
    }
    sha256(all.as_bytes())
}

/// Why the first samples of a design are others if there are more; none where they stay.
pub fn fixed(design: &Design) -> Option<&'static str> {
    match design {
        Design::LatinHypercube { .. } => Some("a Latin hypercube of another size has other samples"),
        Design::FullFactorial | Design::OneAtATime { .. } => Some("with other values the samples have other numbers"),
        Design::Single => Some("an ensemble of another size"),
        Design::Sobol { .. } | Design::MonteCarlo { .. } | Design::Table { .. } => None,
        Design::Saltelli { .. } | Design::Morris { .. } => None,
    }
}

fn is_table_of(design: &Design, text: &Text) -> bool {
    matches!(design, Design::Table { file, .. } if text.by == NamedBy::Study && text.name == *file)
}

/// A tree as text, in the order written.
fn contents_of(root: &Node, without_count: bool) -> String {
    let mut to = String::new();
    write(&root.value, "", without_count, &mut to);
    to
}

/// Keys of the number of samples.
const COUNTS: [&str; 2] = ["design.samples", "design.trajectories"];

fn write(value: &Value, path: &str, without_count: bool, to: &mut String) {
    match value {
        Value::Array(items) => {
            to.push('[');
            items.iter().for_each(|item| {
                write(&item.value, "[]", without_count, to);
                to.push(',');
            });
            to.push(']');
        }
        Value::Table(table) => {
            to.push('{');
            for (key, entry) in table.iter() {
                let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                if without_count && COUNTS.contains(&path.as_str()) {
                    continue;
                }
                // into a text nothing fails
                let _never = write!(to, "{key:?}:");
                write_entry(&entry.node, &path, without_count, to);
            }
            to.push('}');
        }
        plain => _ = write!(to, "{plain:?}"),
    }
}

fn write_entry(node: &Node, path: &str, without_count: bool, to: &mut String) {
    write(&node.value, path, without_count, to);
    to.push(',');
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contents(text: &str, without_count: bool) -> String {
        contents_of(&Document::read_bytes(text.as_bytes(), None, "a").unwrap().root, without_count)
    }

    #[test]
    fn comments_and_white_space_do_not_count_and_all_else_does() {
        let text = "a = 1\n[design]\nkind = \"sobol\"\nsamples = 8\n[[b]]\nc = [1.5, true]\n";
        let same = "# new\na=1 # one\n\n[design]\nkind = 'sobol'\nsamples = 8\n[[b]]\nc = [ 1.50, true ]\n";
        assert_eq!(contents(text, false), contents(same, false));
        for (old, new) in [("1.5", "1.25"), ("true", "false"), ("c =", "d ="), ("a = 1", "a = 1.0"), ("sobol", "sobo")]
        {
            assert_ne!(contents(text, true), contents(&text.replace(old, new), true), "{old} → {new}");
        }
        let more = text.replace("samples = 8", "samples = 16");
        assert_ne!(contents(text, false), contents(&more, false));
        assert_eq!(contents(text, true), contents(&more, true));
        // a number of the same name elsewhere counts
        let elsewhere = |n: u64| format!("{text}samples = {n}\n");
        assert_ne!(contents(&elsewhere(1), true), contents(&elsewhere(2), true));
    }

    #[test]
    fn what_a_text_says_is_not_taken_for_structure() {
        assert_ne!(contents("a = \"1,\\\"b\\\":2\"", false), contents("a = \"1\"\nb = 2", false));
    }
}
