//! `[drive.barriers]`: the keys of what stands beside the road.

mod build;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::super::quantity::{FRACTION, NOT_NEGATIVE, POSITIVE};
use super::super::{Angle, Force, Length, Mass, Ratio, Stiffness};

/// What stands beside the road. Places are [x, y] in vehicle-space: x along the road, y to the right.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub(crate) enum BarrierSection {
    /// A rigid wall without end: all that lies behind a line.
    Wall(Box<WallSection>),
    /// A rigid upright cylinder.
    Pole(Box<PoleSection>),
    /// A rigid upright prism: a parapet's end, an abutment.
    Block(Box<BlockSection>),
    /// A guardrail on posts.
    Rail(Box<RailSection>),
    /// A crash cushion: a block that a force holds back over its stroke.
    Cushion(Box<CushionSection>),
    /// A sign or luminaire on a base that breaks away.
    Sign(Box<SignSection>),
}

/// A rigid wall.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct WallSection {
    /// A point of its face.
    pub(crate) at: [Length; 2],
    /// Direction in which its face looks, to the right of x; 180 deg if absent: against what comes along x.
    pub(crate) facing: Option<Angle>,
    /// "concrete": smooth concrete along a road, friction 0.2.
    #[schemars(extend("enum" = ["concrete"]))]
    pub(crate) preset: Option<String>,
    /// Friction; 0.55 if neither this nor a preset is given.
    pub(crate) friction: Option<Ratio<NOT_NEGATIVE>>,
}

/// A rigid pole.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["diameter", "preset"]]))]
pub(crate) struct PoleSection {
    /// Its axis.
    pub(crate) at: [Length; 2],
    /// Diameter.
    pub(crate) diameter: Option<Length<POSITIVE>>,
    /// "fmvss-214": the rigid pole of 254 mm of 49 CFR 571.214.
    #[schemars(extend("enum" = ["fmvss-214"]))]
    pub(crate) preset: Option<String>,
    /// Friction; 0.55 if absent.
    pub(crate) friction: Option<Ratio<NOT_NEGATIVE>>,
}

/// A rigid block.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["corners", "centre"]], "x-together" = [["centre", "lengths"]]))]
pub(crate) struct BlockSection {
    /// Corners [x, y] of a convex polygon, in their order round it.
    pub(crate) corners: Option<Vec<[Length; 2]>>,
    /// Middle of a rectangle, instead.
    pub(crate) centre: Option<[Length; 2]>,
    /// Its lengths along x and y before it is turned.
    pub(crate) lengths: Option<[Length<POSITIVE>; 2]>,
    /// How it is turned, to the right; 0 if absent.
    pub(crate) yaw: Option<Angle>,
    /// Friction; 0.55 if absent.
    pub(crate) friction: Option<Ratio<NOT_NEGATIVE>>,
}

/// A guardrail on posts, in plan; its ends are anchored. What is not said is its preset's.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RailSection {
    /// "w-beam": a W-beam on steel posts every 1.905 m, which it is if absent. Its section is the profile's; anchors, posts and
    /// their release are guesses that meet one deflection known from memory.
    #[schemars(extend("enum" = ["w-beam"]))]
    pub(crate) preset: Option<String>,
    /// Its two ends.
    pub(crate) line: [[Length; 2]; 2],
    /// Side from which it is hit, seen from its first end; where the first vehicle starts if absent.
    pub(crate) traffic: Option<Hand>,
    /// Height at which its force acts.
    pub(crate) height: Option<Length<POSITIVE>>,
    /// Heights of its lower and upper edge.
    pub(crate) edges: Option<[Length<NOT_NEGATIVE>; 2]>,
    /// Posts.
    #[serde(default)]
    pub(crate) posts: PostsSection,
    /// Stiffness of each anchor.
    pub(crate) anchor: Option<Stiffness<POSITIVE>>,
    /// Tension at which it yields.
    pub(crate) yields: Option<Force<POSITIVE>>,
    /// Friction along it.
    pub(crate) friction: Option<Ratio<NOT_NEGATIVE>>,
}

/// A side.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Hand {
    /// Left.
    Left,
    /// Right.
    Right,
}

/// Posts of a rail.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PostsSection {
    /// Distance between them.
    pub(crate) spacing: Option<Length<POSITIVE>>,
    /// Force at which a post yields.
    pub(crate) force: Option<Force<POSITIVE>>,
    /// Stiffness before that.
    pub(crate) stiffness: Option<Stiffness<POSITIVE>>,
    /// Way at which a post lets the rail go.
    pub(crate) release: Option<Length<POSITIVE>>,
    /// Mass that moves with each.
    pub(crate) mass: Option<Mass<POSITIVE>>,
}

/// A crash cushion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CushionSection {
    /// Middle of its nose.
    pub(crate) at: [Length; 2],
    /// Direction in which its nose looks, to the right of x; 180 deg if absent.
    pub(crate) facing: Option<Angle>,
    /// Width.
    pub(crate) width: Length<POSITIVE>,
    /// Length.
    pub(crate) length: Length<POSITIVE>,
    /// Mass that is taken along from the first touch.
    pub(crate) mass: Mass<POSITIVE>,
    /// Strokes, rising from 0; behind the last it stands as a wall.
    pub(crate) stroke: Vec<Length<NOT_NEGATIVE>>,
    /// Force at each, straight between.
    pub(crate) force: Vec<Force<NOT_NEGATIVE>>,
    /// Share of its energy that comes back; 0.05 if absent.
    pub(crate) returned: Option<Ratio<FRACTION>>,
    /// Friction; 0.55 if absent.
    pub(crate) friction: Option<Ratio<NOT_NEGATIVE>>,
}

/// A sign on a breakaway base.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SignSection {
    /// Axis of its support.
    pub(crate) at: [Length; 2],
    /// Diameter of its support.
    pub(crate) diameter: Length<POSITIVE>,
    /// Mass that is taken along.
    pub(crate) mass: Mass<POSITIVE>,
    /// Ways of its base, rising from 0; behind the last it is free.
    pub(crate) stroke: Vec<Length<NOT_NEGATIVE>>,
    /// Force at each, straight between: their integral is the energy of the base.
    pub(crate) force: Vec<Force<NOT_NEGATIVE>>,
    /// Friction; 0.55 if absent.
    pub(crate) friction: Option<Ratio<NOT_NEGATIVE>>,
}
