//! The shell command that runs one sample again.
//!
//! It names the copies in the folder of the sweep, so it gives the same figures wherever the folder is moved. It
//! contains the resulting values instead of factors and offsets, with enough digits for the same bits.

use std::path::Path;

use crate::base::file_name;
use crate::files::study_folder::{Manifest, NamedBy};
use crate::sweep::Plan;

/// The command that repeats a run of the study, from the folder of the sweep. None if it cannot be written for a shell.
pub fn command(plan: &Plan, manifest: &Manifest, run: u64) -> Option<String> {
    let (args, _) = plan.command(run);
    let base = manifest.texts.iter().find(|t| t.by == NamedBy::StudyAsBase)?;
    let mut words = vec!["occupant".to_owned(), "run".to_owned(), base.copy.clone()];
    for change in args.overrides.into_iter().chain(tables(plan, manifest, run)) {
        words.extend(["--set".to_owned(), change]);
    }
    words.extend(["-o".to_owned(), format!("sample-{run:06}.mcap")]);
    let quoted: Option<Vec<String>> = words.iter().map(|w| quoted(w)).collect();
    quoted.map(|words| words.join(" "))
}

/// Copies of the files referred to by the sample's scenario, next to its own copy.
fn tables(plan: &Plan, manifest: &Manifest, run: u64) -> Vec<String> {
    let named = plan.study.draft(run).map_or_else(|_| Vec::new(), |mut draft| draft.files());
    let copied = |(path, name): (String, String)| {
        let text = manifest.texts.iter().find(|t| t.by == NamedBy::Scenario && t.name == name)?;
        let copy = file_name(Path::new(&text.copy));
        Some(format!("{path}={}", serde_json::Value::from(copy)))
    };
    named.into_iter().filter_map(copied).collect()
}

/// A word quoted for a POSIX shell; none if it has a character that no argument may have.
pub fn quoted(word: &str) -> Option<String> {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_./=,:@%+-".contains(c);
    match word {
        _ if word.contains('\0') => None,
        _ if !word.is_empty() && word.chars().all(plain) => Some(word.to_owned()),
        _ => Some(format!("'{}'", word.replace('\'', "'\\''"))),
    }
}

#[cfg(test)]
mod tests {
    use super::quoted;

    /// A shell of POSIX: Windows has none of its own.
    #[cfg(unix)]
    #[test]
    fn a_shell_reads_back_what_was_quoted() {
        let words = [
            "a",
            "joints.*.damping=2",
            "it's $HOME `x` \"y\" \\ !",
            "",
            "two\nlines",
            "é 20 N·m",
            "a'b''c",
            "~",
            "#no",
        ];
        for word in words {
            let script = format!("printf %s {}", quoted(word).unwrap());
            let output = std::process::Command::new("sh").args(["-c", &script]).output();
            assert_eq!(output.unwrap().stdout, word.as_bytes(), "{word}");
        }
        assert_eq!(quoted("a\0b"), None);
        assert_eq!(quoted("speed=3.5").as_deref(), Some("speed=3.5"));
    }
}
