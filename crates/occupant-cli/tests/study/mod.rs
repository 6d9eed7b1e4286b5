//! `occupant study report` as sentences: what stands on the page, what its commands give, what it refuses; and its analyses
//! on functions whose answers are known.

mod again;
mod bands;
mod known;
mod page;
mod quoted;
mod refused;

use std::fs;
use std::path::Path;

use occupant_cli::results::Results;

use crate::common::{self, answer, done, err, occupant, spoken};

/// A fresh folder with the case as case.toml and a study of it, whose runs are short.
fn folder_with(study: &str) -> tempfile::TempDir {
    common::folder_with(&format!("base = \"case.toml\"\n{study}"))
}

/// The same, swept into out/.
fn swept(study: &str) -> tempfile::TempDir {
    let folder = folder_with(study);
    let words = ["sweep", "study.toml", "-o", "out", "--csv", "--quiet"];
    done(folder.path(), &words);
    folder
}

/// The page of out/.
fn page(folder: &Path) -> String {
    done(folder, &["study", "report", "out", "--force"]);
    fs::read_to_string(folder.join("out/report.html")).expect("a page")
}

/// All figures of a results file.
fn figures(file: &Path) -> Vec<(String, Option<f64>)> {
    let results = Results::open(file).unwrap_or_else(|e| panic!("{e:?}"));
    let summary = results.summary().unwrap_or_else(|e| panic!("{e:?}"));
    let figures = summary.figures(&results.model).into_iter();
    figures.map(|f| (f.name, f.value)).collect()
}

/// Two parameters, 24 samples.
const STUDY: &str = r#"
title = "damping <and> speed"
seed = 3
design = { kind = "latin_hypercube", samples = 24 }
set = { "time.end" = "30 ms", "output.interval" = "0.5 ms" }

[[parameters]]
path = "joints.neck.damping"
range = { from = "10 in lbf s/rad", to = "40 in lbf s/rad" }

[[parameters]]
name = "speed"
path = "path.speed"
range = { from = "15 mph", to = "25 mph" }
"#;
