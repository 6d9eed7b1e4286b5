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

/// What there is a schema of.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum Of {
    /// What `run` reads
    Scenario,
    /// What `sweep` reads
    Study,
    /// What `fit` reads: a study with a section `fit`
    Fit,
    /// What `surface` writes and materials name by `file`
    Surface,
    /// What `run --json` prints
    Run,
    /// What `check --json` prints
    Check,
    /// What `measures --json` prints
    Measures,
    /// What `compare --json` prints
    Compare,
    /// What `risk --json` prints
    Risk,
    /// What `sensitivity --json` prints
    Sensitivity,
}

/// A kind of file that people write.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Document {
    /// What `run` reads
    Scenario,
    /// What `sweep` and `fit` read
    Study,
    /// What `surface` writes and materials name by `file`
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

    /// What it is called.
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
        Of::Compare => "compare",
        Of::Risk => "risk",
        Of::Sensitivity => "sensitivity",
    };
    let all: serde_json::Result<Json> = serde_json::from_str(include_str!("schema/answers.json"));
    let mut all = all.map_err(|error| Failure::plain(format!("the schema is broken: {error}")))?;
    all["$ref"] = format!("#/$defs/{answer}").into();
    talk::print(&crate::base::json(&all)?)
}
