//! `[belts]`: the keys of a belt, and the [`Belt`] they come to.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::Builder;
use super::materials::spring;
use super::quantity::{FRACTION, NOT_NEGATIVE, POSITIVE, point, si_or};
use super::{Length, Ratio, Scenario, Stiffness};
use crate::body::Body;
use crate::forces::belt::{Belt, RestLength};
use placed_text::with_key;

/// A belt that loops round one sphere of the body: the pelvis for a lap belt, the chest for a torso belt.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-at-most-one" = [["slack", "length"]], "x-together" = [["k2", "delta_b"]]))]
pub(crate) struct BeltSection {
    /// Name of the sphere, such as "pelvis" or "chest".
    pub(crate) sphere: String,
    /// The two anchor points [x, y, z], vehicle axes.
    pub(crate) anchors: [[Length; 3]; 2],
    /// K₁, loop force per elongation of the belt up to `delta_b`.
    pub(crate) k1: Stiffness<POSITIVE>,
    /// Elongation at which the stiffness changes. Without it the webbing is linear.
    pub(crate) delta_b: Option<Length<NOT_NEGATIVE>>,
    /// K₂, stiffness beyond `delta_b`.
    pub(crate) k2: Option<Stiffness<NOT_NEGATIVE>>,
    /// Added to the length at the start; negative is preload; 0 if absent. Give this or `length`.
    pub(crate) slack: Option<Length>,
    /// Unstretched length of the loop.
    pub(crate) length: Option<Length<POSITIVE>>,
    /// μ₁, fraction of the energy stored up to `delta_b` that unloading returns; 1 if absent, as in the report.
    pub(crate) mu1: Option<Ratio<FRACTION>>,
    /// μ₂, the same beyond `delta_b`; equal to `mu1` if absent.
    pub(crate) mu2: Option<Ratio<FRACTION>>,
}

/// All belts, in the order written.
pub(super) fn belts(b: &mut Builder, scenario: &Scenario, body: &Body) -> Vec<Belt> {
    scenario.belts.iter().map(|(name, section)| belt(b, body, name, section)).collect()
}

fn belt(b: &mut Builder, body: &Body, name: &str, s: &BeltSection) -> Belt {
    let sphere = b.sphere(&format!("{}.sphere", with_key("belts", name)), &s.sphere, body);
    let webbing = spring(&s.k1, &s.k2, &s.delta_b, si_or(&s.mu1, 1.0), &s.mu2);
    let plain = Belt::new(name, sphere, s.anchors.each_ref().map(point), webbing);
    let rest = match (&s.length, &s.slack) {
        (Some(length), _) => RestLength::Given { length_m: length.si() },
        (None, Some(slack)) => RestLength::Slack { slack_m: slack.si() },
        (None, None) => plain.rest,
    };
    Belt { rest, ..plain }
}
