//! `occupant schema`.

use occupant_core::scenario::schema;

use crate::base::{Failure, talk};

/// Print the JSON Schema of a scenario, for completion and checks in an editor
///
/// Save it as occupant.schema.json beside the scenarios and put `#:schema ./occupant.schema.json` into their first line.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {}

/// Prints the schema.
pub(crate) fn print(_args: &Args) -> Result<(), Failure> {
    talk::print(&talk::json(schema())?)
}
