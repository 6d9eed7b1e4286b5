//! `[drive.ground]`: its keys, converted to the ground.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vehicle_motion::ground::{Curb, Ground, GroundError, Zone};

use super::super::builder::Builder;
use super::super::quantity::{NOT_NEGATIVE, POSITIVE, si_or};
use super::super::{Angle, Length, Ratio};
use placed_text::{Problem, with_key};

/// What vehicles drive on.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-at-most-one" = [["section", "ditch", "cross_slope"]]))]
pub(crate) struct RoadSection {
    /// Tyre friction for a tyre grip of 1; 0.76 if absent, dry asphalt (0.64 to 0.88 in 95 % of tests).
    pub(crate) friction: Option<Ratio<POSITIVE>>,
    /// Grade: rise along x; 0 if absent.
    pub(crate) grade: Option<Ratio>,
    /// Cross slope of a plane: rise to the right, such as -0.02; 0 if absent.
    pub(crate) cross_slope: Option<Ratio>,
    /// Cross-section along x: shoulder, slopes, ditch.
    pub(crate) section: Option<CrossSection>,
    /// A ditch beside the road by its slopes, instead of `section`.
    pub(crate) ditch: Option<DitchSection>,
    /// Curbs along x. Each raises the ground to its right.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) curbs: Vec<CurbSection>,
    /// Strips along x with their own friction. Where strips overlap, the last one counts.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) zones: Vec<ZoneSection>,
}

/// Corners of a cross-section from left to right. The outer slopes go on beyond the last corners.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CrossSection {
    /// Distances to the right of the x axis, increasing.
    pub(crate) right: Vec<Length>,
    /// Height at each.
    pub(crate) height: Vec<Length>,
}

/// A level road with a ditch to its right: foreslope, bottom, backslope.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DitchSection {
    /// Start of the foreslope, to the right of the x axis.
    pub(crate) edge: Length,
    /// Horizontal length per unit of fall: 4 is a slope of 1V:4H.
    pub(crate) foreslope: Ratio<POSITIVE>,
    /// Depth of the bottom below the road.
    pub(crate) depth: Length<POSITIVE>,
    /// Width of the bottom; 0 if absent: a V.
    pub(crate) bottom: Option<Length<NOT_NEGATIVE>>,
    /// Horizontal length per unit of rise; no backslope if absent.
    pub(crate) backslope: Option<Ratio<POSITIVE>>,
    /// Height of the backslope; the depth of the ditch if absent. The ground beyond is level.
    pub(crate) rise: Option<Length<POSITIVE>>,
}

/// A curb along x.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CurbSection {
    /// Foot of its face, to the right of the x axis.
    pub(crate) right: Length,
    /// Height of the step up to the right; negative is a step down.
    pub(crate) height: Length,
    /// Angle of its face to the horizontal, below 90 deg; 80 deg if absent.
    pub(crate) face: Option<Angle>,
}

/// A strip of ground.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ZoneSection {
    /// Name used in events.
    pub(crate) name: String,
    /// From and to, to the right of the x axis.
    pub(crate) right: [Length; 2],
    /// Friction of tyres of grip 1.
    pub(crate) friction: Ratio<NOT_NEGATIVE>,
    /// Extra factor when a tyre slides sideways, such as furrowing soil; 1 if absent.
    pub(crate) lateral: Option<Ratio<NOT_NEGATIVE>>,
    /// Coefficient of rolling resistance; that of the tyre if absent.
    pub(crate) rolling: Option<Ratio<NOT_NEGATIVE>>,
}

/// Friction of a road if none is given.
const DRY_ASPHALT: f64 = 0.76;
const AT: &str = "drive.ground";

impl DitchSection {
    /// Corners of the cross-section from left to right: right, up, m. The road is level to its left, the land behind to its right.
    fn corners_m(&self) -> Vec<[f64; 2]> {
        let (edge_m, depth_m) = (self.edge.si(), self.depth.si());
        let foot_m = edge_m + self.foreslope.si() * depth_m;
        let mut corners = vec![[edge_m - LEVEL_M, 0.0], [edge_m, 0.0], [foot_m, -depth_m]];
        let bottom_m = foot_m + si_or(&self.bottom, 0.0);
        if bottom_m > foot_m {
            corners.push([bottom_m, -depth_m]);
        }
        let top_m = match &self.backslope {
            Some(slope) => {
                let rise_m = si_or(&self.rise, depth_m);
                corners.push([bottom_m + slope.si() * rise_m, rise_m - depth_m]);
                bottom_m + slope.si() * rise_m
            }
            None => bottom_m,
        };
        let last_m = corners[corners.len() - 1][1];
        corners.push([top_m + LEVEL_M, last_m]);
        corners
    }
}

/// A slope of a roadside that is steeper than 1V:1H was probably given as height over length.
const STEEPEST: f64 = 1.0;
/// Distance of a level corner beside a slope, m; the ground continues beyond it.
const LEVEL_M: f64 = 5.0;

/// The ground and its friction outside of zones.
pub(super) fn ground(b: &mut Builder, section: Option<&RoadSection>) -> (Ground, f64) {
    let none = RoadSection::default();
    let s = section.unwrap_or(&none);
    let friction = si_or(&s.friction, DRY_ASPHALT);
    let grade = si_or(&s.grade, 0.0);
    let (mut ground, mut refused) = (Ground::plane(grade, si_or(&s.cross_slope, 0.0)), Vec::new());
    if let Some(section) = &s.section {
        let at = with_key(AT, "section");
        if section.right.len() != section.height.len() {
            let found = format!("{} distances and {} heights", section.right.len(), section.height.len());
            b.error(&at, found, "a height for each distance");
            return (ground, friction);
        }
        let corners = section.right.iter().zip(&section.height).map(|(right, height)| [right.si(), height.si()]);
        match Ground::section(corners.collect(), grade) {
            Ok(own) => ground = own,
            Err(GroundError::Order { number, .. }) => {
                let last = format!("{at}.right[{}]", number - 1);
                let found = format!("corner {number} is not to the right of the previous one");
                b.error(&last, found, "distances that rise from left to right");
            }
            Err(error) => refused.push((at, error)),
        }
    }
    if let Some(ditch) = &s.ditch {
        let slopes = [("foreslope", Some(&ditch.foreslope)), ("backslope", ditch.backslope.as_ref())];
        for (key, slope) in slopes.into_iter().filter_map(|(key, slope)| Some((key, slope?.si()))) {
            if slope < STEEPEST {
                let found = format!(
                    "{slope} m of length for 1 m of height, a slope of {:.0}°",
                    (1.0 / slope).atan().to_degrees()
                );
                let hint = format!("horizontal length per unit of height: 1V:4H and 25 % are both `{key} = 4`");
                let expected = format!("{STEEPEST} or more");
                let place = with_key(&with_key(AT, "ditch"), key);
                b.report(Problem::warning(&place, found, expected).with_hint(Some(hint)));
            }
        }
        match Ground::section(ditch.corners_m(), grade) {
            Ok(own) => ground = own,
            Err(error) => refused.push((with_key(AT, "ditch"), error)),
        }
    }
    let curb = |c: &CurbSection| Curb {
        right_m: c.right.si(),
        height_m: c.height.si(),
        face_rad: si_or(&c.face, 80f64.to_radians()),
    };
    for (i, section) in s.curbs.iter().enumerate() {
        match ground.with_curbs(&[curb(section)]) {
            Ok(own) => ground = own,
            Err(error) => refused.push((format!("{AT}.curbs[{i}]"), error)),
        }
    }
    let zone = |z: &ZoneSection| Zone {
        name: z.name.clone(),
        right_m: [z.right[0].si(), z.right[1].si()],
        friction: z.friction.si() / friction,
        lateral: si_or(&z.lateral, 1.0),
        rolling: z.rolling.as_ref().map(|rolling| rolling.si()),
    };
    for (i, section) in s.zones.iter().enumerate() {
        if let Err(error) = Ground::level().with_zones(vec![zone(section)]) {
            refused.push((format!("{AT}.zones[{i}]"), error));
        }
    }
    if refused.is_empty() {
        ground = ground.clone().with_zones(s.zones.iter().map(zone).collect()).unwrap_or(ground);
    }
    for (at, error) in refused {
        b.error(&at, error.to_string(), "ground that a wheel can stand on");
    }
    (ground, friction)
}
