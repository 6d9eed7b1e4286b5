//! `occupant schema`.

use occupant_scenario::schema;
use occupant_study::schema_json;
use serde_json::Value as Json;

use crate::base::{Failure, talk};

/// Print the JSON Schema of a scenario or study, for completion and checks in an editor
///
/// Save it as occupant.schema.json beside the scenarios and put `#:schema ./occupant.schema.json` into their first line.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Of which kind of file; what `occupant fit` reads is a study with a section `fit`
    #[arg(long, value_enum, default_value_t = Document::Scenario)]
    of: Document,
}

/// A kind of file that people write.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Document {
    /// What `run` reads
    Scenario,
    /// What `sweep` and `fit` read
    Study,
}

impl Document {
    /// Its schema.
    pub(crate) fn schema(self) -> &'static Json {
        match self {
            Document::Scenario => schema(),
            Document::Study => schema_json(),
        }
    }

    /// What it is called.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Document::Scenario => "scenario",
            Document::Study => "study",
        }
    }
}

/// Prints the schema.
pub(crate) fn print(args: &Args) -> Result<(), Failure> {
    talk::print(&talk::json(args.of.schema())?)
}
