//! `keep` of a study: the runs whose time histories are kept.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};
use serde_json::Value as Json;

/// Runs whose full result file is kept.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum KeepSection {
    /// "all", "none", "worst 5 by hic15".
    Words(String),
    /// Indices.
    Indices(Vec<Json>),
}

impl JsonSchema for KeepSection {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "keep".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": ["string", "array"],
            "items": { "type": "integer", "minimum": 0 },
            "x-example": "\"all\", \"none\", [0, 12, 99], \"worst 5 by hic15\"",
        })
    }
}

/// Runs whose full result file is kept.
#[derive(Clone, Debug, PartialEq, Default)]
pub enum Keep {
    /// All runs.
    All,
    /// None.
    #[default]
    None,
    /// Runs with these indices.
    Indices(Vec<u64>),
    /// Runs with the largest values of a measure.
    Worst {
        /// Number of runs.
        count: u64,
        /// Name of the measure, such as `hic15`.
        measure: String,
    },
}

impl Keep {
    /// The choice that a section describes.
    ///
    /// # Errors
    /// The invalid text found.
    pub(super) fn read(section: &KeepSection) -> Result<Keep, String> {
        match section {
            KeepSection::Words(words) => {
                Keep::from_words(words).ok_or_else(|| format!("\"{words}\" does not say which runs to keep"))
            }
            KeepSection::Indices(items) => {
                let index =
                    |item: &Json| item.as_u64().ok_or_else(|| format!("`{item}` is not an index, counted from 0"));
                Ok(Keep::of(items.iter().map(index).collect::<Result<_, _>>()?))
            }
        }
    }

    /// Runs with these indices.
    pub fn of(mut indices: Vec<u64>) -> Keep {
        indices.sort_unstable();
        indices.dedup();
        Keep::Indices(indices)
    }

    /// The choice described by words such as `all` or `worst 5 by hic15`; none if they mean nothing.
    pub fn from_words(words: &str) -> Option<Keep> {
        let words: Vec<&str> = words.split_whitespace().collect();
        match words.as_slice() {
            ["all"] => Some(Keep::All),
            ["none"] => Some(Keep::None),
            ["worst", count, "by", measure] => {
                Some(Keep::Worst { count: count.parse().ok().filter(|n| *n > 0)?, measure: (*measure).to_owned() })
            }
            _ => None,
        }
    }
}
