//! What an exported file says of itself and its columns.

use serde::Serialize;

use crate::base::{file_name, program};
use crate::files::history::{Column, Histories, UnitChoice, class_name, shown};
use crate::files::results::Results;

/// The run and what was done to its histories.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct About {
    /// Program and version that exported.
    pub(crate) program: String,
    /// Title of the scenario.
    pub(crate) title: String,
    /// Name of the result file.
    pub(crate) source: String,
    /// Its SHA-256.
    pub(crate) source_sha256: String,
    /// Whether the run reached its end.
    pub(crate) complete: bool,
    /// Unit system.
    pub(crate) units: &'static str,
    /// Filter asked for.
    pub(crate) filter: String,
    /// Coefficients of the filter; absent without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) filter_coefficients: Option<&'static str>,
    /// What a reader should know.
    pub(crate) notes: Vec<String>,
    /// The columns, time first.
    pub(crate) columns: Vec<ColumnAbout>,
}

#[derive(Clone, Debug, Serialize)]
pub(crate) struct ColumnAbout {
    pub(crate) name: String,
    /// Unit of the values, in ASCII.
    pub(crate) unit: String,
    /// Axes.
    pub(crate) frame: &'static str,
    /// Filter class applied.
    pub(crate) filter: String,
    pub(crate) meaning: String,
}

impl ColumnAbout {
    /// The first column of every table.
    pub(crate) fn time() -> Self {
        ColumnAbout {
            name: "time".to_owned(),
            unit: "s".to_owned(),
            frame: "none",
            filter: "none".to_owned(),
            meaning: "time of the run".to_owned(),
        }
    }
}

impl About {
    /// Of these histories; `filter` in words.
    pub(crate) fn new(
        results: &Results,
        histories: &Histories,
        units: UnitChoice,
        filter: String,
        coefficients: Option<&'static str>,
    ) -> Self {
        let of = |c: &Column| ColumnAbout {
            name: c.channel.name.clone(),
            unit: shown(c.channel.unit, units).ascii(),
            frame: c.channel.axes.name(),
            filter: class_name(c.class),
            meaning: c.channel.meaning.clone(),
        };
        About {
            program: program(),
            title: results.loaded.scenario.title.clone(),
            source: file_name(&results.path),
            source_sha256: results.sha256.clone(),
            complete: results.is_complete(),
            units: units.name(),
            filter,
            filter_coefficients: coefficients,
            notes: histories.notes.clone(),
            columns: std::iter::once(ColumnAbout::time()).chain(histories.columns.iter().map(of)).collect(),
        }
    }
}
