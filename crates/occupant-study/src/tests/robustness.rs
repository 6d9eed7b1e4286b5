//! Any text gives a study or a list of problems, never a panic.

use super::super::StudyText;
use super::{base, no_files};
use occupant_scenario::Format;

const STUDY: &str = r#"base = "short.toml"
units = "in-lbf-s"
seed = 12
set = { "time.end" = "80 ms" }
keep = "worst 5 by hic15"
output.csv = true

[design]
kind = "sobol"
samples = 64

[[parameters]]
path = "joints.*.damping"
apply = "factor"
range = { from = 0.5, to = 2, scale = "log" }

[[parameters]]
name = "k"
paths = ["materials.foam.k1", "belts.lap.k1"]
distribution = { kind = "triangular", from = 40, mode = "60 lbf/in", to = 90 }

[[parameters]]
path = "path.shape"
list = ["square", "half_sine"]

[[correlations]]
between = ["k", "joints.*.damping"]
rank = 0.5

[ensemble]
members = 3
posture = "1 deg"
perturbations = [{ path = "belts.lap.anchors[0][2]", offset = 0.2 }]
"#;

/// Reads, binds, and if that succeeds computes the ends of the study.
fn try_all(text: &str, format: Format) -> bool {
    let Ok(text) = StudyText::read(text, format, "s") else {
        return false;
    };
    let Ok(study) = text.bind(base(), &[], &no_files) else {
        return false;
    };
    for index in [0, study.len() / 2, study.len().saturating_sub(1), u64::MAX] {
        let _ = study.role(index);
        let _ = study.draft(index);
    }
    true
}

#[test]
fn the_whole_study_works() {
    assert!(try_all(STUDY, Format::Toml));
}

#[test]
fn pieces_of_a_study_do_not_panic() {
    let ends = STUDY.char_indices().map(|(i, _)| i).step_by(3);
    for end in ends {
        try_all(&STUDY[..end], Format::Toml);
        try_all(&STUDY[end..], Format::Toml);
    }
}

#[test]
fn a_study_with_one_piece_replaced_does_not_panic() {
    let wild = ["-1", "1e308", "9223372036854775807", "0", "\"\"", "\"1e308 lbf\"", "[]", "{}", "true", "nan"];
    let lines: Vec<&str> = STUDY.lines().collect();
    let with = |i: usize, line: String| {
        let changed = lines.iter().enumerate().map(|(at, old)| if at == i { line.as_str() } else { *old });
        try_all(&changed.collect::<Vec<_>>().join("\n"), Format::Toml);
    };
    for (i, line) in lines.iter().enumerate() {
        let Some((key, value)) = line.split_once(" = ") else {
            continue;
        };
        for piece in wild {
            with(i, format!("{key} = {piece}"));
            // a digit within the line
            for (at, _) in value.match_indices(|c: char| c.is_ascii_digit()).take(3) {
                let (before, after) = (&value[..at], &value[at + 1..]);
                with(i, format!("{key} = {before}{piece}{after}"));
            }
        }
    }
}

#[test]
fn nonsense_is_refused() {
    for text in ["", "{}", "[]", "base", "base = 3", "{\"base\": null}", "\u{feff}", "\0"] {
        assert!(!try_all(text, Format::Toml), "{text}");
        assert!(!try_all(text, Format::Json), "{text}");
    }
}

#[test]
fn lists_of_ten_thousands_are_refused_at_once() {
    let parameters = "[[parameters]]\npath = \"nothing\"\n".repeat(1001);
    let sets: String = (0..1001).map(|i| format!("\"nothing{i}\" = 1\n")).collect();
    let paths = format!(
        "[[parameters]]\nname = \"all\"\npaths = [{}]\nrange = {{ from = 0, to = 1 }}\n",
        "\"nothing\", ".repeat(1001)
    );
    for (text, found) in [(parameters, "parameters"), (paths, "parameters"), (format!("[set]\n{sets}"), "set")] {
        let text = StudyText::read(&format!("base = \"short.toml\"\n{text}"), Format::Toml, "study.toml").unwrap();
        let problems = text.bind(base(), &[], &no_files).unwrap_err();
        assert_eq!(problems.len(), 1, "{problems}");
        assert!(problems.to_string().contains(&format!("= in: {found}")), "{problems}");
        assert!(problems.to_string().contains("1001 entries"), "{problems}");
    }
}
