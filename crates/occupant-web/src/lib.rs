//! The page that simulates in a browser: what the command computes, asked for in JSON and answered in JSON.
//!
//! A page has no files and no terminal. It sends a request, a table with the key `do`, to [`call`], and shows what comes
//! back. The module for wasm32 (`abi`) passes both through its memory; natively the same function is called by tests.
//!
//! | `do` | also | answer |
//! |---|---|---|
//! | `about` | | program, templates, lessons |
//! | `schema` | | the schema of scenarios |
//! | `check` | a case | problems, each with line and column; the values that can be moved |
//! | `run` | a case | the run as the page of a report draws it; its summary as `occupant run --json` prints it |
//! | `study` | a case and a `study` as TOML | its samples, each as changes |
//! | `measure` | a case | the figures of its run, as a row of a study's table has them |
//! | `write` | a case | its text with the changes written into it |
//! | `save` | a case | the bytes of its result file |
//! | `open` | a `name`, and the bytes of a result file | its run, and the case it is of |
//!
//! A case is a `text` with its `name`, the changes of `--set` and the tables that it refers to:
//!
//! ```
//! let request = r#"{"do": "check", "case": {"name": "my.toml", "text": "title = 1", "set": [], "tables": {}}}"#;
//! let answer = occupant_web::call(request, &[], &mut |_| ());
//! assert!(answer.json.contains(r#""line":1,"column":9"#), "{}", answer.json);
//! ```

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

#[cfg(target_family = "wasm")]
mod abi;
mod case;
mod import;
mod knobs;
mod run;
mod study;

use occupant_files::base::program;
use occupant_jobs::templates::Template;
use serde::{Deserialize, Serialize};

use case::{Case, Refused};

/// What comes back of a request.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Answer {
    /// A table; with the key `refused` if the request could not be met.
    pub json: String,
    /// The file that was asked for; else empty.
    pub bytes: Vec<u8>,
}

/// A request.
#[derive(Debug, Deserialize)]
#[serde(tag = "do", rename_all = "snake_case")]
enum Request {
    About,
    Schema,
    Check {
        case: Case,
    },
    Run {
        case: Case,
        /// Names and patterns of channels to plot before the others.
        #[serde(default)]
        channels: Vec<String>,
    },
    Write {
        case: Case,
    },
    Save {
        case: Case,
    },
    Open {
        name: String,
    },
    Import {
        name: String,
        /// Sides of the vehicle that were struck.
        #[serde(default)]
        struck: Vec<String>,
    },
    Study {
        case: Case,
        study: String,
    },
    Measure {
        case: Case,
    },
}

/// Program and templates.
#[derive(Serialize)]
struct About {
    program: String,
    templates: Vec<Named>,
}

/// A text with changes.
#[derive(Serialize)]
struct Written {
    text: String,
}

/// A template with its text.
#[derive(Serialize)]
struct Named {
    name: &'static str,
    meaning: &'static str,
    text: String,
}

/// Meets a request, about a file where it opens one; `told` hears how much of a run is done, from 0 to 1.
pub fn call(request: &str, file: &[u8], told: &mut dyn FnMut(f64)) -> Answer {
    let met = serde_json::from_str(request).map_err(|e| Refused::plain(format!("a request that is not one: {e}")));
    met.and_then(|request| meet(request, file, told)).unwrap_or_else(|refused| Answer::of(&refused))
}

fn meet(request: Request, file: &[u8], told: &mut dyn FnMut(f64)) -> Result<Answer, Refused> {
    Ok(match request {
        Request::About => Answer::of(&About { program: program(), templates: templates() }),
        Request::Schema => Answer { json: occupant_scenario::schema().to_string(), bytes: Vec::new() },
        Request::Check { case } => Answer::of(&case.checked()),
        Request::Run { case, channels } => Answer::of(&run::run(&case, &channels, told)?),
        Request::Study { case, study } => Answer::of(&study::planned(&case, &study)?),
        Request::Measure { case } => Answer::of(&study::measured(&case)?),
        Request::Write { case } => Answer::of(&Written { text: case.written()? }),
        Request::Open { name } => Answer::of(&run::opened(&name, file)?),
        Request::Import { name, struck } => Answer::of(&import::imported(&name, file, &struck)?),
        Request::Save { case } => Answer { json: "{}".to_owned(), bytes: run::saved(&case, told)? },
    })
}

/// The scenarios among the templates.
fn templates() -> Vec<Named> {
    let scenarios = Template::ALL.into_iter().filter(|template| !template.is_study());
    scenarios.map(|t| Named { name: t.name, meaning: t.meaning, text: t.text() }).collect()
}

impl Answer {
    fn of(answer: &impl Serialize) -> Self {
        let json = serde_json::to_string(answer).unwrap_or_else(|_| r#"{"refused":{"words":"no JSON"}}"#.to_owned());
        Answer { json, bytes: Vec::new() }
    }
}
