//! `[contact]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How contact forces act.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ContactSection {
    /// Where the in-plane force of a surface's edge acts on a sphere; "contact_point" if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub edge_force: Option<EdgeForceChoice>,
}

/// Where the edge force acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EdgeForceChoice {
    /// At the point of contact, like the rest of the contact force.
    ContactPoint,
    /// At the sphere's centre, where the edge force conserves energy on a turning segment too.
    Centre,
}
