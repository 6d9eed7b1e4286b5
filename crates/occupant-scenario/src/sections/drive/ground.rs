//! `[drive.ground]`: its keys, converted to the ground.

use occupant_units::trig;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vehicle_motion::ground::{Curb, Ground, Zone};

use super::super::builder::Builder;
use super::super::quantity::{NOT_NEGATIVE, POSITIVE, si_or};
use super::super::{Angle, Length, Ratio};
use super::survey::{self, GridSection, LineSection, StationSection};
use placed_text::{Problem, with_key};

/// The ground that vehicles drive on.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-at-most-one" = [["section", "sections", "ditch", "cross_slope", "grid"], ["grid", "line"], ["grid", "curbs"], ["grid", "grade"]]))]
pub(crate) struct RoadSection {
    /// Tyre friction for a tyre grip of 1; 0.76 if absent, dry asphalt (0.64 to 0.88 in 95 % of tests).
    pub(crate) friction: Option<Ratio<POSITIVE>>,
    /// Grade: rise along x, or along the line; 0 if absent.
    pub(crate) grade: Option<Ratio>,
    /// Cross slope of a plane: rise to the right, such as -0.02; 0 if absent.
    pub(crate) cross_slope: Option<Ratio>,
    /// Cross-section along x: shoulder, slopes, ditch.
    pub(crate) section: Option<CrossSection>,
    /// A ditch beside the road by its slopes, instead of `section`.
    pub(crate) ditch: Option<DitchSection>,
    /// Line in plan that the cross-section follows, instead of the x axis: `right` counts from it.
    pub(crate) line: Option<LineSection>,
    /// Cross-sections at places along the line, instead of `section`; the ground changes linearly between them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) sections: Vec<StationSection>,
    /// Heights on a regular grid, instead of a cross-section.
    pub(crate) grid: Option<GridSection>,
    /// Curbs along x. Each raises the ground to its right.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) curbs: Vec<CurbSection>,
    /// Strips along x, or along the line, with their own friction. Where strips overlap, the last one counts.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) zones: Vec<ZoneSection>,
}

/// Corners of a cross-section from left to right. The outer slopes continue beyond the last corners.
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
    /// Left and right boundary, to the right of the x axis.
    pub(crate) right: [Length; 2],
    /// Friction of tyres with grip 1.
    pub(crate) friction: Ratio<NOT_NEGATIVE>,
    /// Further factor on lateral sliding, as in furrowing soil; 1 if absent.
    pub(crate) lateral: Option<Ratio<NOT_NEGATIVE>>,
    /// Coefficient of rolling resistance; that of the tyre if absent.
    pub(crate) rolling: Option<Ratio<NOT_NEGATIVE>>,
}

/// Default friction of a road.
const DRY_ASPHALT: f64 = 0.76;
const AT: &str = "drive.ground";

impl DitchSection {
    /// Corners of the cross-section from left to right: right, up, m. The road on its left and the land on its right
    /// are level.
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

/// Warns of a slope steeper than 1V:1H, which was probably given as height over length.
const STEEPEST: f64 = 1.0;
/// Distance of a level corner beside a slope, m; the ground continues beyond it.
const LEVEL_M: f64 = 5.0;

/// The ground and its friction outside of zones.
pub(super) fn ground(b: &mut Builder, section: Option<&RoadSection>) -> (Ground, f64) {
    let none = RoadSection::default();
    let s = section.unwrap_or(&none);
    let friction = si_or(&s.friction, DRY_ASPHALT);
    let grade = si_or(&s.grade, 0.0);
    let mut refused = Vec::new();
    let Some(mut ground) = bare(b, s, grade) else { return (Ground::level(), friction) };
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

/// The ground without curbs and zones; none after a mistake.
fn bare(b: &mut Builder, s: &RoadSection, grade: f64) -> Option<Ground> {
    if let Some(grid) = &s.grid {
        return survey::grid(b, &with_key(AT, "grid"), grid);
    }
    let corners_m = match (&s.section, &s.ditch) {
        (Some(section), _) => Some(survey::corners_m(b, &with_key(AT, "section"), &section.right, &section.height)?),
        (_, Some(ditch)) => {
            warn_of_steep(b, ditch);
            Some(ditch.corners_m())
        }
        _ => None,
    };
    let cross_slope = si_or(&s.cross_slope, 0.0);
    if s.line.is_some() || !s.sections.is_empty() {
        let plane = || [-LEVEL_M, LEVEL_M].map(|right_m| [right_m, right_m * cross_slope]).into();
        return survey::road(b, AT, s, corners_m.unwrap_or_else(plane));
    }
    let Some(corners_m) = corners_m else { return Some(Ground::plane(grade, cross_slope)) };
    match Ground::section(corners_m, grade) {
        Ok(ground) => Some(ground),
        Err(error) => {
            let key = if s.section.is_some() { "section" } else { "ditch" };
            b.error(&with_key(AT, key), error.to_string(), "ground that a wheel can stand on");
            None
        }
    }
}

fn warn_of_steep(b: &mut Builder, ditch: &DitchSection) {
    let slopes = [("foreslope", Some(&ditch.foreslope)), ("backslope", ditch.backslope.as_ref())];
    for (key, slope) in slopes.into_iter().filter_map(|(key, slope)| Some((key, slope?.si()))) {
        if slope < STEEPEST {
            let degrees = trig::atan(1.0 / slope).to_degrees();
            let found = format!("{slope} m of length for 1 m of height, a slope of {degrees:.0}°");
            let hint = format!("horizontal length per unit of height: 1V:4H and 25 % are both `{key} = 4`");
            let expected = format!("{STEEPEST} or more");
            let place = with_key(&with_key(AT, "ditch"), key);
            b.report(Problem::warning(&place, found, expected).with_hint(Some(hint)));
        }
    }
}
