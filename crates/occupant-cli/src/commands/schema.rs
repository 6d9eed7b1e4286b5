//! `occupant schema`.

use occupant_scenario::{schema, surface_schema};
use occupant_study::schema_json;
use serde_json::Value as Json;

use crate::base::{Failure, talk};

/// Print the JSON Schema of scenarios, studies or --json output
///
/// Your editor can complete and check scenarios with it. Save it as occupant.schema.json beside a scenario and make
/// `#:schema ./occupant.schema.json` the first line of the scenario.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The kind of file, or the command whose --json output is described
    #[arg(long, value_enum, default_value_t = Of::Scenario)]
    of: Of,
}

/// Documents with a schema.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum Of {
    /// A scenario, for `run`
    Scenario,
    /// A study, for `sweep`
    Study,
    /// A study with a section `fit`, for `fit`
    Fit,
    /// A surface file, written by `surface` and named by `file` of materials
    Surface,
    /// Output of `run --json`
    Run,
    /// Output of `check --json`
    Check,
    /// Output of `measures --json`
    Measures,
    /// Output of `measures --rating NAME --json`
    Rating,
    /// Output of `compare --json`
    Compare,
    /// Output of `risk --json`
    Risk,
    /// Output of `sensitivity --json`
    Sensitivity,
}

/// Kinds of files that people write.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Document {
    /// A scenario, for `run`
    Scenario,
    /// A study, for `sweep` and `fit`
    Study,
    /// A surface file, written by `surface` and named by `file` of materials
    Surface,
}

impl Document {
    /// Its schema.
    pub(crate) fn schema(self) -> &'static Json {
        match self {
            Document::Scenario => schema(),
            Document::Study => schema_json(),
            Document::Surface => surface_schema(),
        }
    }

    /// Its name.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Document::Scenario => "scenario",
            Document::Study => "study",
            Document::Surface => "surface",
        }
    }
}

/// Prints the schema.
pub(crate) fn print(args: &Args) -> Result<(), Failure> {
    let answer = match args.of {
        Of::Scenario => return talk::print(&crate::base::json(Document::Scenario.schema())?),
        Of::Study | Of::Fit => return talk::print(&crate::base::json(Document::Study.schema())?),
        Of::Surface => return talk::print(&crate::base::json(Document::Surface.schema())?),
        Of::Run => "run",
        Of::Check => "check",
        Of::Measures => "measures",
        Of::Rating => "rating",
        Of::Compare => "compare",
        Of::Risk => "risk",
        Of::Sensitivity => "sensitivity",
    };
    let all: serde_json::Result<Json> = serde_json::from_str(include_str!("schema/answers.json"));
    let mut all = all.map_err(|error| Failure::plain(format!("the schema is broken: {error}")))?;
    all["$ref"] = format!("#/$defs/{answer}").into();
    talk::print(&crate::base::json(&all)?)
}
