//! `[drive.barriers]`: the keys of obstacles beside the road.

mod build;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::super::quantity::{FRACTION, NOT_NEGATIVE, POSITIVE};
use super::super::{Angle, Force, Length, Mass, Ratio, Stiffness};

/// An obstacle beside the road. Positions are [x, y] in vehicle-space: x along the road, y to the right.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub(crate) enum BarrierSection {
    /// A rigid wall of unlimited length: everything behind a line.
    Wall(Box<WallSection>),
    /// A rigid upright cylinder.
    Pole(Box<PoleSection>),
    /// A rigid upright prism, such as a parapet end or an abutment.
    Block(Box<BlockSection>),
    /// A guardrail on posts.
    Rail(Box<RailSection>),
    /// A crash cushion: a block that resists with a force over its stroke.
    Cushion(Box<CushionSection>),
    /// A sign or luminaire on a breakaway base.
    Sign(Box<SignSection>),
}

/// A rigid wall.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct WallSection {
    /// A point on its face.
    pub(crate) at: [Length; 2],
    /// Outward direction of its face, to the right of x; 180 deg if absent: towards traffic along x.
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
    /// Corners [x, y] of a convex polygon, in order.
    pub(crate) corners: Option<Vec<[Length; 2]>>,
    /// Centre of a rectangle, instead of `corners`.
    pub(crate) centre: Option<[Length; 2]>,
    /// Its lengths along x and y, before rotation.
    pub(crate) lengths: Option<[Length<POSITIVE>; 2]>,
    /// Its rotation, to the right; 0 if absent.
    pub(crate) yaw: Option<Angle>,
    /// Friction; 0.55 if absent.
    pub(crate) friction: Option<Ratio<NOT_NEGATIVE>>,
}

/// A guardrail on posts, in plan; its ends are anchored. Keys that are absent take the values of the preset.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RailSection {
    /// "w-beam": a W-beam on steel posts every 1.905 m; the default. The section is that of the profile. Anchors, posts
    /// and their release are estimates, tuned to one remembered deflection.
    #[schemars(extend("enum" = ["w-beam"]))]
    pub(crate) preset: Option<String>,
    /// Its two ends.
    pub(crate) line: [[Length; 2]; 2],
    /// Struck side, seen from its first end; the side on which the first vehicle starts if absent.
    pub(crate) traffic: Option<Hand>,
    /// Height of its resultant force.
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
    /// Post spacing.
    pub(crate) spacing: Option<Length<POSITIVE>>,
    /// Force at which a post yields.
    pub(crate) force: Option<Force<POSITIVE>>,
    /// Stiffness of a post before it yields.
    pub(crate) stiffness: Option<Stiffness<POSITIVE>>,
    /// Displacement at which a post releases the rail.
    pub(crate) release: Option<Length<POSITIVE>>,
    /// Mass that moves with each post.
    pub(crate) mass: Option<Mass<POSITIVE>>,
}

/// A crash cushion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CushionSection {
    /// Middle of its nose.
    pub(crate) at: [Length; 2],
    /// Outward direction of its nose, to the right of x; 180 deg if absent.
    pub(crate) facing: Option<Angle>,
    /// "en1317-3-80" or "en1317-3-100": estimates that stop the cars of EN 1317-3 at 80 and 100 km/h. Keys that are given
    /// replace its values; without a preset all of width, length, mass, stroke and force are needed.
    #[schemars(extend("enum" = ["en1317-3-80", "en1317-3-100"]))]
    pub(crate) preset: Option<String>,
    /// Width.
    pub(crate) width: Option<Length<POSITIVE>>,
    /// Length.
    pub(crate) length: Option<Length<POSITIVE>>,
    /// Mass that moves with the vehicle from first contact.
    pub(crate) mass: Option<Mass<POSITIVE>>,
    /// Strokes, increasing from 0; beyond the last it acts as a wall.
    pub(crate) stroke: Option<Vec<Length<NOT_NEGATIVE>>>,
    /// Force at each stroke, linear between.
    pub(crate) force: Option<Vec<Force<NOT_NEGATIVE>>>,
    /// Fraction of its energy that is restored; 0.05 if absent.
    pub(crate) returned: Option<Ratio<FRACTION>>,
    /// Friction; 0.55 if absent.
    pub(crate) friction: Option<Ratio<NOT_NEGATIVE>>,
}

/// A sign on a breakaway base.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SignSection {
    /// Position of its support.
    pub(crate) at: [Length; 2],
    /// "en12767-ne", "en12767-le" or "en12767-he": estimates that a car of 900 kg leaves at 100 km/h with the speed of that
    /// category of EN 12767. Keys that are given replace its values; without a preset all of diameter, mass, stroke and
    /// force are needed.
    #[schemars(extend("enum" = ["en12767-ne", "en12767-le", "en12767-he"]))]
    pub(crate) preset: Option<String>,
    /// Diameter of its support.
    pub(crate) diameter: Option<Length<POSITIVE>>,
    /// Mass that moves with the vehicle.
    pub(crate) mass: Option<Mass<POSITIVE>>,
    /// Displacements of its base, increasing from 0; beyond the last it is free.
    pub(crate) stroke: Option<Vec<Length<NOT_NEGATIVE>>>,
    /// Force at each displacement, linear between. The integral is the breakaway energy.
    pub(crate) force: Option<Vec<Force<NOT_NEGATIVE>>>,
    /// Friction; 0.55 if absent.
    pub(crate) friction: Option<Ratio<NOT_NEGATIVE>>,
}
