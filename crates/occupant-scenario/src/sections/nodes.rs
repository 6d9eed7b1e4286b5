//! Nodes of belts: their keys, converted to [`Node`]s.

use indexmap::IndexMap;
use nalgebra::Point3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::Builder;
use super::chains::Parts;
use super::plates::{self, PlaceRide};
use super::quantity::{NOT_NEGATIVE, POSITIVE, all_si, point, si_or};
use super::retractors::{StrokeSection, direction};
use super::wings;
use super::{Force, Length, Ratio, Speed};
use occupant_core::forces::chain::{NEVER, Next, Node, Site, Track};
use occupant_core::forces::contact::surface::Frame;

/// Sliding speed of webbing across a track per kN beyond friction, m/s: a drag of 100 N·s/m.
const SLIDE_M_S: f64 = 10.0;

/// A point that the webbing passes: a point of the vehicle (`at`), of a segment (`on`, `at`), an arc of a segment
/// (`on`, `track`) or a sphere of the body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["at", "track", "sphere", "wing"]], "x-at-most-one" = [["sphere", "on", "wing"], ["ride", "lies_on"]]))]
pub(crate) struct NodeSection {
    /// Its name; that of the sphere, or its number, if absent.
    pub(crate) name: Option<String>,
    /// Position [x, y, z] in vehicle axes, or in those of `frame`; with `on`, in segment axes from the segment's lower end.
    pub(crate) at: Option<[Length; 3]>,
    /// Name of the segment that it is fixed to.
    pub(crate) on: Option<String>,
    /// Of a point of the vehicle: name of the frame that carries it, such as the hinge of a seat back, which the webbing then turns;
    /// the vehicle if absent.
    pub(crate) frame: Option<String>,
    /// Name of the sphere that the webbing wraps.
    pub(crate) sphere: Option<String>,
    /// Inner end, crown and outer end of an arc across which the webbing slides, in segment axes from the segment's
    /// lower end. The webbing starts at the crown. It slides off beyond the outer end, or lifts off where it pulls away
    /// from the body.
    pub(crate) track: Option<[[Length; 3]; 3]>,
    /// "left" or "right": the iliac wing of that side, a track on the pelvis for the lap belt, at an estimated
    /// position. Webbing that slides up off it lies on the abdomen.
    pub(crate) wing: Option<WingSide>,
    /// For a wing: initial height of the webbing above its usual position; 0 if absent.
    pub(crate) above: Option<Length>,
    /// For a track: the body point that supports the webbing after it has slid off. If absent, the webbing then has no
    /// contact here.
    pub(crate) then: Option<NextSection>,
    /// Friction across a track; 0.3 if absent, 0.25 of a wing.
    pub(crate) across: Option<Ratio<NOT_NEGATIVE>>,
    /// Sliding speed of webbing across a track, per kN beyond friction; 10 m/s if absent.
    pub(crate) slide_speed: Option<Speed<POSITIVE>>,
    /// Direction away from the body, segment axes. Webbing pulled that way lifts off. If absent, it never does.
    pub(crate) normal: Option<[Ratio; 3]>,
    /// Friction along the webbing; 0 if absent.
    pub(crate) friction: Option<Ratio<NOT_NEGATIVE>>,
    /// True: the webbing is fixed here.
    pub(crate) tie: Option<bool>,
    /// Name of the retractor of the first node.
    pub(crate) retractor: Option<String>,
    /// For a point of a segment: share of each plate's deflection that it follows, 0 to 1, by the plate's name; none if
    /// absent. A sphere has its own `ride`.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) ride: IndexMap<String, Ratio>,
    /// "chest": a point of the upper torso follows the plates near it, depending on its position.
    pub(crate) lies_on: Option<PlaceRide>,
    /// Force at which the webbing releases from it; never if absent.
    pub(crate) strength: Option<Force<POSITIVE>>,
    /// Pretensioner that pulls this vehicle point.
    pub(crate) pretensioner: Option<StrokeSection>,
}

/// A side of the pelvis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum WingSide {
    /// The left one, at positive Y of the pelvis.
    Left,
    /// The right one.
    Right,
}

/// A point of a segment that supports webbing after it has slid off.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct NextSection {
    /// Name of the segment.
    pub(crate) on: String,
    /// Position from the segment's lower end, segment axes.
    pub(crate) at: [Length; 3],
    /// Share of the deflection of each plate of that segment that it follows, 0 to 1, by the plate's name; none if
    /// absent.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) ride: IndexMap<String, Ratio>,
}

impl NodeSection {
    /// A node without any key.
    pub(super) fn none() -> Self {
        NodeSection {
            name: None,
            at: None,
            on: None,
            frame: None,
            sphere: None,
            track: None,
            wing: None,
            above: None,
            then: None,
            across: None,
            slide_speed: None,
            normal: None,
            friction: None,
            tie: None,
            retractor: None,
            ride: IndexMap::new(),
            lies_on: None,
            strength: None,
            pretensioner: None,
        }
    }
}

impl Parts<'_> {
    pub(super) fn node(&self, b: &mut Builder, path: &str, i: usize, s: &NodeSection) -> Node {
        let name = s.name.clone().or_else(|| s.sphere.clone()).unwrap_or_else(|| (i + 1).to_string());
        let site = self.site(b, path, s);
        let mut ride = plates::node(b, path, s, &site, self.body);
        if s.wing.is_some() && ride.is_empty() {
            ride = wings::flesh(self.body);
        }
        let frame = self.carrier(b, path, s);
        Node { name, site, friction: si_or(&s.friction, 0.0), strength_n: si_or(&s.strength, NEVER), ride, frame }
    }

    /// What carries a point of the vehicle: a frame on it.
    fn carrier(&self, b: &mut Builder, path: &str, s: &NodeSection) -> Option<Frame> {
        let (name, at) = (s.frame.as_deref()?, format!("{path}.frame"));
        if s.on.is_some() || s.at.is_none() {
            b.error(&at, "`frame` in a node of the body", "`frame` in a node with `at` and without `on`");
            return None;
        }
        let frame = b.frame(self.scenario, &at, Some(name));
        if self.scenario.vehicle_of(frame).is_none() {
            b.error(&at, format!("`{name}`, which is no part of a vehicle"), "a vehicle, or a frame on one");
        }
        (frame != Frame::Vehicle).then_some(frame)
    }

    fn site(&self, b: &mut Builder, path: &str, s: &NodeSection) -> Site {
        if let Some(sphere) = &s.sphere {
            b.refuse_keys(path, &["above"], |key| format!("`{key}` in a node without `wing`"), "a node with `wing`");
            return Site::Sphere(b.sphere(&format!("{path}.sphere"), sphere, self.body));
        }
        let then = s.then.as_ref().and_then(|then| self.next(b, &format!("{path}.then"), then));
        if let Some(side) = s.wing {
            b.refuse_keys(
                path,
                &["normal", "pretensioner"],
                |key| format!("`{key}` in a node with `wing`"),
                "neither of them",
            );
            let track = wings::track(b, path, self.body, (side, si_or(&s.above, 0.0)));
            let across = si_or(&s.across, wings::ACROSS);
            let drag_n_s_m = 1e3 / si_or(&s.slide_speed, SLIDE_M_S);
            return track.map_or(Site::Vehicle(Point3::origin(), None), |(segment, track)| {
                let then = then.or(track.then);
                Site::Track(segment, Track { friction: across, drag_n_s_m, then, ..track })
            });
        }
        b.refuse_keys(path, &["above"], |key| format!("`{key}` in a node without `wing`"), "a node with `wing`");
        let at = s.at.as_ref().map_or(Point3::origin(), point);
        let Some(segment) = &s.on else {
            b.refuse_keys(
                path,
                &["track", "normal", "then"],
                |key| format!("`{key}` without `on`"),
                "on = the name of a segment",
            );
            let stroke = s.pretensioner.as_ref().map(|stroke| self.stroke(b, path, stroke));
            return Site::Vehicle(at, stroke);
        };
        let index = self.segment(b, path, segment).unwrap_or(0);
        b.refuse_keys(path, &["pretensioner"], |key| format!("`{key}` in a node on the body"), "a node on the vehicle");
        match &s.track {
            Some(points) => Site::Track(
                index,
                Track {
                    points_m: points.each_ref().map(point),
                    friction: si_or(&s.across, 0.3),
                    drag_n_s_m: 1e3 / si_or(&s.slide_speed, SLIDE_M_S),
                    wing: None,
                    then,
                },
            ),
            None if s.then.is_some() => {
                b.error(&format!("{path}.then"), "`then` in a node without a track", "a node with `track` or `wing`");
                Site::Segment(index, at, None)
            }
            None => Site::Segment(index, at, s.normal.as_ref().map(|normal| direction(all_si(normal)))),
        }
    }

    fn segment(&self, b: &mut Builder, path: &str, segment: &str) -> Option<usize> {
        let names: Vec<&str> = self.body.tree.segment_rows().iter().map(|row| row.name).collect();
        let index = names.iter().position(|name| *name == segment);
        if index.is_none() {
            b.unknown(&format!("{path}.on"), "segment", segment, &names);
        }
        index
    }

    fn next(&self, b: &mut Builder, path: &str, s: &NextSection) -> Option<Next> {
        let ride = plates::shares(b, &format!("{path}.ride"), &s.ride, self.body);
        Some(Next { segment: self.segment(b, path, &s.on)?, point_m: point(&s.at), ride })
    }
}
