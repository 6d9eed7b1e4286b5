//! What decides on the samples of a study: the contents of its texts, whatever their comments and white space.

use std::fmt::Write;

use occupant_study::{Design, Study};
use placed_text::{Document, Node, Value};

use crate::base::sha256;
use crate::files::study_folder::{NamedBy, Text};

/// SHA-256 of the contents of study, scenario and tables. The rating of the study does not count; of a design whose first
/// samples stay as they are when there are more, the number of samples does not, nor does its table.
pub fn digest(study: &Study, texts: &[(&Text, &[u8])]) -> String {
    let grows = fixed(&study.design).is_none();
    let mut all = String::new();
    for (i, (text, bytes)) in texts.iter().filter(|(text, _)| text.by != NamedBy::Rating).enumerate() {
        let read = if i < 2 { Document::read_bytes(bytes, None, &text.name).ok() } else { None };
        let counts = match read {
            Some(document) => contents_of(&document.root, left_out(i == 0, grows)),
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

/// A tree as text, in the order written, without the keys of some paths.
fn contents_of(root: &Node, without: &[&str]) -> String {
    let mut to = String::new();
    write(&root.value, "", without, &mut to);
    to
}

/// Keys of a study that decide on no sample, and those of the number of samples.
const NOT_COUNTED: [&str; 3] = ["rating", "design.samples", "design.trajectories"];

/// What does not count of a study, or of another text.
fn left_out(is_study: bool, grows: bool) -> &'static [&'static str] {
    match (is_study, grows) {
        (true, true) => &NOT_COUNTED,
        (true, false) => &NOT_COUNTED[..1],
        (false, _) => &[],
    }
}

fn write(value: &Value, path: &str, without: &[&str], to: &mut String) {
    match value {
        Value::Array(items) => {
            to.push('[');
            items.iter().for_each(|item| {
                write(&item.value, "[]", without, to);
                to.push(',');
            });
            to.push(']');
        }
        Value::Table(table) => {
            to.push('{');
            for (key, entry) in table.iter() {
                let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                if without.contains(&path.as_str()) {
                    continue;
                }
                // into a text nothing fails
                let _never = write!(to, "{key:?}:");
                write_entry(&entry.node, &path, without, to);
            }
            to.push('}');
        }
        plain => _ = write!(to, "{plain:?}"),
    }
}

fn write_entry(node: &Node, path: &str, without: &[&str], to: &mut String) {
    write(&node.value, path, without, to);
    to.push(',');
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contents(text: &str, grows: bool) -> String {
        contents_of(&Document::read_bytes(text.as_bytes(), None, "a").unwrap().root, left_out(true, grows))
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
        // what rates the runs decides on none
        let rated = format!("{text}[rating]\nname = \"fmvss-208\"\n");
        assert_eq!(contents(text, false), contents(&rated, false));
        assert_ne!(contents(text, false), contents(&rated.replace("[rating]", "[other]"), false));
    }

    #[test]
    fn what_a_text_says_is_not_taken_for_structure() {
        assert_ne!(contents("a = \"1,\\\"b\\\":2\"", false), contents("a = \"1\"\nb = 2", false));
    }
}
