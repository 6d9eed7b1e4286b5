//! `[belts]`: the keys of a belt; those with one sphere are converted to [`Belt`]s.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::Builder;
use super::materials::spring;
use super::nodes::NodeSection;
use super::quantity::{FRACTION, NOT_NEGATIVE, POSITIVE, point, si_or};
use super::retractors::StrokeSection;
use super::three_point::{Lap, Preset, Side};
use super::{Force, Length, Ratio, Scenario, Stiffness};
use occupant_core::body::Body;
use occupant_core::forces::belt::{Belt, RestLength};
use placed_text::with_key;

/// A belt: a loop round one sphere between two anchors, webbing over nodes, or a preset.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend(
    "x-exactly-one" = [["anchors", "nodes", "preset"]],
    "x-at-most-one" = [["slack", "length", "pretension"]],
    "x-together" = [["k2", "delta_b"], ["anchors", "sphere"], ["anchors", "k1"]],
))]
pub(crate) struct BeltSection {
    /// Name of the sphere of a loop, such as "pelvis" or "chest".
    pub(crate) sphere: Option<String>,
    /// The two anchor points [x, y, z] of a loop, vehicle axes.
    pub(crate) anchors: Option<[[Length; 3]; 2]>,
    /// K₁, loop force per elongation up to `delta_b`; 0 is a gap before it pulls.
    pub(crate) k1: Option<Stiffness<NOT_NEGATIVE>>,
    /// Δ_b, elongation at which the stiffness changes. Without it the loop is linear.
    pub(crate) delta_b: Option<Length<NOT_NEGATIVE>>,
    /// K₂, stiffness beyond `delta_b`.
    pub(crate) k2: Option<Stiffness<NOT_NEGATIVE>>,
    /// Slack, added to the initial length; negative is preload; 0 if absent. Give this or `length`.
    pub(crate) slack: Option<Length>,
    /// Unstretched length of the belt, without the webbing on a spool.
    pub(crate) length: Option<Length<POSITIVE>>,
    /// μ₁, fraction of the energy stored up to `delta_b` that unloading returns; 1 if absent, as in the report.
    pub(crate) mu1: Option<Ratio<FRACTION>>,
    /// μ₂, the same beyond `delta_b`; equal to `mu1` if absent.
    pub(crate) mu2: Option<Ratio<FRACTION>>,
    /// Points that the webbing passes, in order, from a retractor or an anchor to an anchor.
    pub(crate) nodes: Option<Vec<NodeSection>>,
    /// Name of the webbing of a belt with nodes or of a preset. If absent in a preset, polyester that stretches by 8 %
    /// at 11 kN.
    pub(crate) webbing: Option<String>,
    /// Initial tension, instead of `slack` or `length`. With an open retractor give none of them.
    pub(crate) pretension: Option<Force<NOT_NEGATIVE>>,
    /// Name of a load limiter at the first node.
    pub(crate) limiter: Option<String>,
    /// Name of the trigger that releases the belt for good.
    pub(crate) release: Option<String>,
    /// Tension at which the webbing tears; never if absent.
    pub(crate) strength: Option<Force<POSITIVE>>,
    /// A belt whose anchors follow from the seat and the body.
    pub(crate) preset: Option<Preset>,
    /// Of a preset: true if its tongue clamps the webbing, so that none passes from the shoulder to the lap; false if absent.
    pub(crate) locking_tongue: Option<bool>,
    /// Of a preset with `lap = "wings"`: how far above its usual place on the iliac wings the lap belt begins; 0 if absent.
    pub(crate) lap_above: Option<Length>,
    /// Vehicle side of a preset's upper anchor: "left" for a driver on the left.
    pub(crate) side: Option<Side>,
    /// Upper anchor or D-ring of a preset, vehicle axes. It and the next two follow from the seat if absent.
    pub(crate) d_ring: Option<[Length; 3]>,
    /// Of a preset: name of the frame that carries the upper anchor and the retractor, such as the hinge of a seat back; the vehicle
    /// if absent.
    pub(crate) d_ring_frame: Option<String>,
    /// Buckle of a preset, vehicle axes.
    pub(crate) buckle: Option<[Length; 3]>,
    /// Outer lap anchor of a preset, vehicle axes.
    pub(crate) anchor: Option<[Length; 3]>,
    /// Support of a preset's lap belt: "pelvis", the sphere, off which it cannot slide, or "wings", the iliac wings,
    /// off which it can slide up to the abdomen (submarining). "pelvis" if absent.
    pub(crate) lap: Option<Lap>,
    /// Name of the retractor of a preset.
    pub(crate) retractor: Option<String>,
    /// Buckle pretensioner of a preset; pulls the buckle towards its anchor.
    pub(crate) pretensioner: Option<StrokeSection>,
    /// False: the belt is not worn. True if absent.
    pub(crate) worn: Option<bool>,
}

impl BeltSection {
    pub(super) fn is_worn(&self) -> bool {
        self.worn != Some(false)
    }
}

/// Largest number of belts; settling evaluates them in hundreds of postures.
pub(super) const MOST: usize = 100;

/// All loops, in the order written.
pub(super) fn belts(b: &mut Builder, scenario: &Scenario, body: &Body) -> Vec<Belt> {
    if scenario.belts.len() > MOST {
        b.error("belts", format!("{} belts", scenario.belts.len()), format!("at most {MOST}"));
        return Vec::new();
    }
    let worn = scenario.belts.iter().filter(|(_, section)| section.is_worn());
    worn.filter_map(|(name, section)| belt(b, body, name, section)).collect()
}

fn belt(b: &mut Builder, body: &Body, name: &str, s: &BeltSection) -> Option<Belt> {
    let path = with_key("belts", name);
    let (Some(anchors), Some(sphere), Some(k1)) = (&s.anchors, &s.sphere, &s.k1) else {
        let keys = ["sphere", "k1", "k2", "delta_b", "mu1", "mu2"];
        b.refuse_keys(
            &path,
            &keys,
            |key| format!("`{key}` in a belt that is not a loop"),
            "`webbing`, or `sphere` and `anchors` for a loop",
        );
        return None;
    };
    let keys = [
        "webbing",
        "pretension",
        "limiter",
        "release",
        "strength",
        "side",
        "lap",
        "lap_above",
        "locking_tongue",
        "retractor",
        "pretensioner",
    ];
    b.refuse_keys(&path, &keys, |key| format!("`{key}` in a loop round one sphere"), "`nodes` instead of `anchors`");
    let sphere = b.sphere(&format!("{path}.sphere"), sphere, body);
    let webbing = spring(k1, &s.k2, &s.delta_b, si_or(&s.mu1, 1.0), &s.mu2);
    let plain = Belt::new(name, sphere, anchors.each_ref().map(point), webbing);
    let rest = match (&s.length, &s.slack) {
        (Some(length), _) => RestLength::Given { length_m: length.si() },
        (None, Some(slack)) => RestLength::Slack { slack_m: slack.si() },
        (None, None) => plain.rest,
    };
    Some(Belt { rest, ..plain })
}
