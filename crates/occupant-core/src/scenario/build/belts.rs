//! `[belts]` → [`Belt`]s.

use super::builder::Builder;
use super::surfaces::spring;
use crate::body::Body;
use crate::forces::belt::{Belt, RestLength};
use crate::scenario::model::{BeltSection, Scenario};
use crate::scenario::path_text::with_key;

/// All belts, in the order written.
pub(super) fn belts(b: &mut Builder, scenario: &Scenario, body: &Body) -> Vec<Belt> {
    let each = scenario.belts.iter();
    each.map(|(name, section)| belt(b, body, name, section)).collect()
}

fn belt(b: &mut Builder, body: &Body, name: &str, section: &BeltSection) -> Belt {
    let path = with_key("belts", name);
    let spheres = body.spheres.iter().map(|s| s.name.as_str());
    let returned_1 = b.optional(&with_key(&path, "mu1"), &section.mu1, 1.0);
    let sphere = b.index_of(&with_key(&path, "sphere"), "sphere", &section.sphere, spheres);
    let anchors_m = [0, 1].map(|i| b.point(&format!("{path}.anchors[{i}]"), &section.anchors[i]));
    let webbing = spring(b, &path, (&section.k1, &section.k2, &section.delta_b), (returned_1, &section.mu2));
    let plain = Belt::new(name, sphere, anchors_m, webbing);
    let rest = match (&section.length, &section.slack) {
        (Some(length), _) => RestLength::Given { length_m: b.si(&with_key(&path, "length"), length) },
        (None, Some(slack)) => RestLength::Slack { slack_m: b.si(&with_key(&path, "slack"), slack) },
        (None, None) => plain.rest,
    };
    Belt { rest, ..plain }
}
