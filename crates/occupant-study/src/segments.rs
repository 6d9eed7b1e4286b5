//! Masses of the segments of a body, with the uncertainty of anthropometric tables.
//!
//! Two generations of anthropometry differ by 10 to 20 % in the mass of a limb of a person of the same size, so that
//! ±15 % a segment is what a study of a person's body has to allow for. Left and right are alike in every person;
//! moments of inertia grow with the mass, since the shape stays.

use super::ensemble::targets;
use super::parameter::Target;
use occupant_scenario::Draft;
use placed_text::{Step, parse_path};

/// Keys that change the mass of a segment.
const NUMBERS: [&str; 5] = ["mass", "weight", "inertia[0]", "inertia[1]", "inertia[2]"];
/// Keys that change the size of the body: its segments are then not those of the base.
const SIZES: [&str; 5] = ["preset", "sex", "stature", "mass", "segment_count"];

/// Segments of the base scenario's body, left and right together, with the paths of their mass and inertia.
pub(super) fn segments(base: &Draft) -> Vec<(String, Vec<Target>)> {
    let mut all: Vec<(String, Vec<Target>)> = Vec::new();
    for target in NUMBERS.iter().filter_map(|key| targets(base, &format!("body.segments.*.{key}")).ok()).flatten() {
        let steps = parse_path(&target.path).unwrap_or_default();
        let Some(Step::Key(segment)) = steps.get(2) else { continue };
        let side = ["left_", "right_"].iter().find_map(|side| segment.strip_prefix(side));
        let name = side.unwrap_or(segment);
        match all.iter_mut().find(|(known, _)| known == name) {
            Some((_, places)) => places.push(target),
            None => all.push((name.to_owned(), vec![target])),
        }
    }
    all
}

/// The first of these targets that changes the size of the body.
pub(super) fn size<'t>(places: impl Iterator<Item = &'t Target>) -> Option<&'t str> {
    let is_size = |path: &str| path.strip_prefix("body.").is_some_and(|key| SIZES.contains(&key));
    places.map(|target| target.path.as_str()).find(|path| is_size(path))
}
