//! `[markers]`: the keys of a marker, converted to [`Marker`]s.

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Length;
use super::builder::Builder;
use super::quantity::point;
use occupant_core::body::Body;
use occupant_core::model::setup::{Marker, MarkerFrame};
use placed_text::{Problem, did_you_mean, one_of, with_key};

/// A point of a segment whose motion is recorded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MarkerSection {
    /// The segment that it is fixed to.
    pub(crate) segment: String,
    /// Its position from the segment's lower end, in segment axes (X forward, Y left, Z up when standing).
    pub(crate) place: [Length; 3],
    /// Frame of the results. "vehicle": position, velocity and acceleration relative to the vehicle. "space": relative
    /// to space. "segment": an accelerometer along the segment's SAE J211 axes. "vehicle" if absent.
    pub(crate) frame: Option<MarkerFrame>,
}

/// All markers, in the order written.
pub(super) fn markers(b: &mut Builder, sections: &IndexMap<String, MarkerSection>, body: &Body) -> Vec<Marker> {
    let names: Vec<&str> = body.tree.segment_rows().iter().map(|row| row.name).collect();
    let mut list = Vec::new();
    for (name, section) in sections {
        let Some(segment) = body.tree.segment_named(&section.segment) else {
            let found = format!("no segment is named \"{}\"", section.segment);
            let hint = did_you_mean(&section.segment, &names, '"');
            let path = with_key(&with_key("markers", name), "segment");
            b.report(Problem::error(path, found, one_of(&names, '"')).with_hint(hint));
            continue;
        };
        let frame = section.frame.unwrap_or_default();
        list.push(Marker { name: name.clone(), segment, place_from_lower_end_m: point(&section.place), frame });
    }
    list
}
