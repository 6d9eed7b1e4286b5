//! `[webbings]`, `[limiters]`, `[retractors]` and the nodes of `[belts]`: their keys, and the [`Chain`]s they come to.

use nalgebra::{Point3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::belts::BeltSection;
use super::builder::Builder;
use super::quantity::{FRACTION, NOT_NEGATIVE, POSITIVE, all_si, point, si_or};
use super::triggers::Triggers;
use super::{Force, Length, Ratio, Scenario, Speed, Time, three_point};
use crate::body::Body;
use crate::forces::chain::{Chain, Cue, Device, NEVER, Node, Pull, Reel, Rest, Site, Stroke, Track};
use crate::forces::function::Function;
use placed_text::with_key;

/// μ of a limiter: a torsion bar does not wind back.
const LIMITER_RETURNS: f64 = 0.01;
/// Time in which the force moves to a second limiter, s.
const SWITCH_S: f64 = 5e-3;
/// Speed at which webbing slides across a track for each kN beyond friction, m/s: a drag of 100 N·s/m.
const SLIDE_M_S: f64 = 10.0;
/// Greatest speed of webbing that a pretensioner of given force pulls in, m/s.
const PULL_M_S: f64 = 15.0;

/// Webbing: its tension over its strain, straight between points; beyond the last the last line goes on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-at-most-one" = [["returned", "returned_each"]]))]
pub(crate) struct WebbingSection {
    /// Strains, from 0 on.
    pub(crate) strain: Vec<Ratio<NOT_NEGATIVE>>,
    /// Tension at each.
    pub(crate) force: Vec<Force<NOT_NEGATIVE>>,
    /// Fraction of its work that unloading returns; 1 if absent.
    pub(crate) returned: Option<Ratio<FRACTION>>,
    /// The same for each interval.
    pub(crate) returned_each: Option<Vec<Ratio<FRACTION>>>,
    /// Damping: a spring that gives way with a time constant, beside the webbing.
    pub(crate) viscous: Option<ViscousSection>,
}

/// A spring that gives way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ViscousSection {
    /// Tension per unit of strain.
    pub(crate) stiffness: Force<POSITIVE>,
    /// Time constant.
    pub(crate) time: Time<POSITIVE>,
}

/// A limiter: belt force over the webbing that it has given; a first rise is webbing that tightens on the spool.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-at-most-one" = [["returned", "returned_each"]]))]
pub(crate) struct LimiterSection {
    /// Webbing given, from 0 on.
    pub(crate) payout: Vec<Length<NOT_NEGATIVE>>,
    /// Force at each; must not fall.
    pub(crate) force: Vec<Force<NOT_NEGATIVE>>,
    /// Fraction of its work that unloading returns; 0.01 if absent, as of a torsion bar.
    pub(crate) returned: Option<Ratio<FRACTION>>,
    /// The same for each interval.
    pub(crate) returned_each: Option<Vec<Ratio<FRACTION>>>,
}

/// A retractor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RetractorSection {
    /// Webbing on the spool at the start; 1 m if absent.
    pub(crate) on_spool: Option<Length<POSITIVE>>,
    /// Tension while it is open; 6 N if absent.
    pub(crate) spool_tension: Option<Force<POSITIVE>>,
    /// What locks it; without it a pretensioner alone does.
    pub(crate) lock: Option<LockSection>,
    /// Name of the limiter; locked, it gives nothing if absent.
    pub(crate) limiter: Option<String>,
    /// A limiter that takes over.
    pub(crate) second_limiter: Option<SecondLimiterSection>,
    /// Pretensioner.
    pub(crate) pretensioner: Option<PullSection>,
}

/// What locks a retractor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LockSection {
    /// Name of the trigger.
    pub(crate) trigger: String,
    /// Webbing that leaves the spool from the trigger until it is locked; 0 if absent.
    pub(crate) payout: Option<Length<NOT_NEGATIVE>>,
    /// Time from the trigger until it is locked in any case.
    pub(crate) within: Option<Time<NOT_NEGATIVE>>,
}

/// A limiter that takes over from the first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SecondLimiterSection {
    /// Its name.
    pub(crate) limiter: String,
    /// Name of the trigger.
    pub(crate) trigger: String,
    /// Time in which the force moves over; 5 ms if absent.
    pub(crate) within: Option<Time<POSITIVE>>,
}

/// A pretensioner of a retractor: webbing pulled in, or a force.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["pull", "force"]]))]
pub(crate) struct PullSection {
    /// Name of the trigger.
    pub(crate) trigger: String,
    /// Time from the trigger until it acts; 0 if absent.
    pub(crate) delay: Option<Time<NOT_NEGATIVE>>,
    /// Times since it acts, from 0 on; it ends with the last.
    pub(crate) times: Vec<Time<NOT_NEGATIVE>>,
    /// Webbing pulled in at each; must not fall.
    pub(crate) pull: Option<Vec<Length<NOT_NEGATIVE>>>,
    /// Force at each.
    pub(crate) force: Option<Vec<Force<NOT_NEGATIVE>>>,
    /// Greatest speed of webbing that a force pulls in; 15 m/s if absent.
    pub(crate) speed: Option<Speed<POSITIVE>>,
    /// Tension at which it stops; none if absent.
    pub(crate) stall_force: Option<Force<POSITIVE>>,
}

/// A pretensioner that pulls a buckle or an anchor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct StrokeSection {
    /// Name of the trigger.
    pub(crate) trigger: String,
    /// Time from the trigger until it acts; 0 if absent.
    pub(crate) delay: Option<Time<NOT_NEGATIVE>>,
    /// Which way it pulls, vehicle axes; away from the belt, if absent down and back.
    pub(crate) direction: Option<[Ratio; 3]>,
    /// Times since it acts, from 0 on.
    pub(crate) times: Vec<Time<NOT_NEGATIVE>>,
    /// Its way at each; must not fall.
    pub(crate) pull: Vec<Length<NOT_NEGATIVE>>,
    /// Force against it at which it stops for good; none if absent.
    pub(crate) stall_force: Option<Force<POSITIVE>>,
}

/// A place that webbing passes: a point of the vehicle (`at`), of a segment (`on`, `at`), an arc of a segment (`on`, `track`) or
/// a sphere of the body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["at", "track", "sphere"]], "x-at-most-one" = [["sphere", "on"]]))]
pub(crate) struct NodeSection {
    /// Its name; that of the sphere, or its number, if absent.
    pub(crate) name: Option<String>,
    /// Place [x, y, z]: vehicle axes, or with `on` segment axes from the segment's lower end.
    pub(crate) at: Option<[Length; 3]>,
    /// Name of the segment that carries it.
    pub(crate) on: Option<String>,
    /// Name of the sphere that the webbing wraps.
    pub(crate) sphere: Option<String>,
    /// Inner end, crown and outer end of an arc across which the webbing slides, segment axes from the segment's lower end. It
    /// begins at the crown, and comes off beyond the outer end or where it pulls away from the body.
    pub(crate) track: Option<[[Length; 3]; 3]>,
    /// Friction across a track; 0.3 if absent.
    pub(crate) across: Option<Ratio<NOT_NEGATIVE>>,
    /// Speed at which webbing slides across a track for each kN beyond friction; 10 m/s if absent.
    pub(crate) slide_speed: Option<Speed<POSITIVE>>,
    /// Direction away from the body, segment axes: webbing that pulls that way comes off. Without it a guide holds for ever.
    pub(crate) normal: Option<[Ratio; 3]>,
    /// Friction along the webbing; 0 if absent.
    pub(crate) friction: Option<Ratio<NOT_NEGATIVE>>,
    /// True: the webbing is sewn fast here.
    pub(crate) tie: Option<bool>,
    /// Name of the retractor of the first node.
    pub(crate) retractor: Option<String>,
    /// Force at which the webbing comes out of it; never if absent.
    pub(crate) strength: Option<Force<POSITIVE>>,
    /// Pretensioner that pulls a point of the vehicle.
    pub(crate) pretensioner: Option<StrokeSection>,
}

impl NodeSection {
    /// One of which nothing is said.
    pub(super) fn none() -> Self {
        NodeSection {
            name: None,
            at: None,
            on: None,
            sphere: None,
            track: None,
            across: None,
            slide_speed: None,
            normal: None,
            friction: None,
            tie: None,
            retractor: None,
            strength: None,
            pretensioner: None,
        }
    }
}

/// Everything that belts refer to.
struct Parts<'a> {
    scenario: &'a Scenario,
    body: &'a Body,
    triggers: &'a Triggers<'a>,
}

/// All belts with nodes, in the order written; one for each part between ties.
pub(super) fn chains(b: &mut Builder, scenario: &Scenario, body: &Body, triggers: &Triggers<'_>) -> Vec<Chain> {
    let parts = Parts { scenario, body, triggers };
    let mut list = Vec::new();
    for (name, section) in &scenario.belts {
        let path = with_key("belts", name);
        let nodes = match (&section.nodes, &section.preset) {
            (Some(nodes), _) => {
                let keys = ["side", "retractor", "pretensioner"];
                b.refuse_keys(
                    &path,
                    &keys,
                    |key| format!("`{key}` of a belt with nodes"),
                    "`retractor` and `pretensioner` of a node",
                );
                nodes.clone()
            }
            (None, Some(preset)) => three_point::nodes(b, scenario, body, &path, section, *preset),
            (None, None) => continue,
        };
        parts.belt(b, name, section, &nodes, &mut list);
    }
    list
}

impl Parts<'_> {
    fn belt(&self, b: &mut Builder, name: &str, s: &BeltSection, sections: &[NodeSection], list: &mut Vec<Chain>) {
        let path = with_key("belts", name);
        let (webbing, viscous) = self.webbing(b, &path, s);
        let mut device = self.device(b, &path, s, sections);
        let rest = match (&s.slack, &s.pretension, &s.length) {
            (_, Some(tension), _) => Rest::Pretension(tension.si()),
            (_, _, Some(length)) => Rest::Length(length.si()),
            (slack, ..) => Rest::Slack(si_or(slack, 0.0)),
        };
        if device.reel.is_some() {
            let expected = "none of them: the spool's tension is the belt's";
            b.refuse_keys(
                &path,
                &["slack", "pretension", "length"],
                |key| format!("`{key}` with a retractor"),
                expected,
            );
        }
        let nodes: Vec<Node> =
            sections.iter().enumerate().map(|(i, node)| self.node(b, &format!("{path}.nodes[{i}]"), i, node)).collect();
        let last = nodes.len().saturating_sub(1);
        let is_tie = |i: usize| i == last || sections[i].tie == Some(true);
        let mut from = 0;
        for to in (1..nodes.len()).filter(|i| is_tie(*i)) {
            let nodes = nodes[from..=to].to_vec();
            let rubs = |i: &usize| *i == 0 || *i + 1 == nodes.len() || nodes[*i].friction > 0.0;
            let ends: Vec<usize> = (0..nodes.len()).filter(rubs).collect();
            let straps = ends.windows(2).map(|e| format!("{name}.{}_{}", nodes[e[0]].name, nodes[e[1]].name)).collect();
            let release = s.release.as_deref().map_or(Cue::NEVER, |trigger| self.triggers.cue(trigger, 0.0));
            let (webbing, strength_n) = (webbing.clone(), si_or(&s.strength, NEVER));
            let fixed = Device { limiter: None, second: None, reel: None };
            let device = std::mem::replace(&mut device, fixed);
            list.push(Chain {
                belt: name.to_owned(),
                nodes,
                straps,
                webbing,
                viscous,
                rest,
                device,
                release,
                strength_n,
            });
            from = to;
        }
    }

    fn webbing(&self, b: &mut Builder, path: &str, s: &BeltSection) -> (Function, Option<[f64; 2]>) {
        let Some(name) = &s.webbing else {
            if s.preset.is_none() {
                b.error(path, format!("`{path}` has no key `webbing`"), "webbing = the name of one in `webbings`");
            }
            return (three_point::webbing(), None);
        };
        let Some(webbing) = self.scenario.webbings.get(name) else { return (three_point::webbing(), None) };
        let at = with_key("webbings", name);
        let points = points(b, &at, ["strain", "force"], &webbing.strain, &webbing.force);
        let returned = returned(&webbing.returned, &webbing.returned_each, 1.0, points.len());
        let viscous = webbing.viscous.as_ref().map(|viscous| [viscous.stiffness.si(), viscous.time.si()]);
        (Function { points, returned }, viscous)
    }

    fn limiter(&self, b: &mut Builder, name: &str) -> Option<Function> {
        let limiter = self.scenario.limiters.get(name)?;
        let points = points(b, &with_key("limiters", name), ["payout", "force"], &limiter.payout, &limiter.force);
        let returned = returned(&limiter.returned, &limiter.returned_each, LIMITER_RETURNS, points.len());
        Some(Function { points, returned })
    }

    /// What holds the first node; a retractor anywhere else is an error.
    fn device(&self, b: &mut Builder, path: &str, s: &BeltSection, nodes: &[NodeSection]) -> Device {
        for (i, _) in nodes.iter().enumerate().skip(1).filter(|(_, node)| node.retractor.is_some()) {
            let expected = "the retractor at the first node: list the nodes the other way round";
            b.error(&format!("{path}.nodes[{i}].retractor"), format!("a retractor at node {}", i + 1), expected);
        }
        let reel = nodes.first().and_then(|node| node.retractor.as_ref()).and_then(|n| self.scenario.retractors.get(n));
        let Some(section) = reel else {
            let limiter = s.limiter.as_ref().and_then(|name| self.limiter(b, name));
            return Device { limiter, second: None, reel: None };
        };
        if s.limiter.is_some() {
            b.error(&format!("{path}.limiter"), "a limiter of a belt with a retractor", "`limiter` of the retractor");
        }
        if section.second_limiter.is_some() && section.limiter.is_none() {
            b.error(path, "a retractor with a second limiter and no first", "`limiter` of the retractor");
        }
        let second = |second: &SecondLimiterSection, b: &mut Builder| {
            let limiter = self.limiter(b, &second.limiter)?;
            Some((limiter, self.triggers.cue(&second.trigger, 0.0), si_or(&second.within, SWITCH_S)))
        };
        Device {
            limiter: section.limiter.as_ref().and_then(|name| self.limiter(b, name)),
            second: section.second_limiter.as_ref().and_then(|section| second(section, b)),
            reel: Some(self.reel(b, section)),
        }
    }

    fn reel(&self, b: &mut Builder, s: &RetractorSection) -> Reel {
        let lock = s.lock.as_ref();
        let within = lock.and_then(|lock| lock.within.as_ref());
        Reel {
            on_spool_m: si_or(&s.on_spool, 1.0),
            tension_n: si_or(&s.spool_tension, 6.0),
            lock: lock.map_or(Cue::NEVER, |lock| self.triggers.cue(&lock.trigger, 0.0)),
            lock_after: [lock.map_or(0.0, |lock| si_or(&lock.payout, 0.0)), within.map_or(NEVER, |within| within.si())],
            pull: s.pretensioner.as_ref().map(|pull| self.pull(b, pull)),
        }
    }

    fn pull(&self, b: &mut Builder, s: &PullSection) -> Pull {
        let path = "retractors.*.pretensioner";
        let table = match (&s.pull, &s.force) {
            (Some(pull), _) => points(b, path, ["times", "pull"], &s.times, pull),
            (None, Some(force)) => points(b, path, ["times", "force"], &s.times, force),
            (None, None) => Vec::new(),
        };
        Pull {
            cue: self.triggers.cue(&s.trigger, si_or(&s.delay, 0.0)),
            table,
            by_force: s.force.as_ref().map(|_| si_or(&s.speed, PULL_M_S)),
            stall_n: si_or(&s.stall_force, NEVER),
        }
    }

    fn node(&self, b: &mut Builder, path: &str, i: usize, s: &NodeSection) -> Node {
        let name = s.name.clone().or_else(|| s.sphere.clone()).unwrap_or_else(|| (i + 1).to_string());
        let site = self.site(b, path, s);
        Node { name, site, friction: si_or(&s.friction, 0.0), strength_n: si_or(&s.strength, NEVER) }
    }

    fn site(&self, b: &mut Builder, path: &str, s: &NodeSection) -> Site {
        if let Some(sphere) = &s.sphere {
            return Site::Sphere(b.sphere(&format!("{path}.sphere"), sphere, self.body));
        }
        let at = s.at.as_ref().map_or(Point3::origin(), point);
        let Some(segment) = &s.on else {
            b.refuse_keys(
                path,
                &["track", "normal"],
                |key| format!("`{key}` without `on`"),
                "on = the name of a segment",
            );
            let stroke = s.pretensioner.as_ref().map(|stroke| self.stroke(b, path, stroke));
            return Site::Vehicle(at, stroke);
        };
        let tree = self.body.tree;
        let names: Vec<&str> = tree.segment_rows().iter().map(|row| row.name).collect();
        let index = names.iter().position(|name| name == segment).unwrap_or_else(|| {
            b.unknown(&format!("{path}.on"), "segment", segment, &names);
            0
        });
        b.refuse_keys(
            path,
            &["pretensioner"],
            |key| format!("`{key}` of a point of the body"),
            "a point of the vehicle",
        );
        match &s.track {
            Some(points) => Site::Track(
                index,
                Track {
                    points_m: points.each_ref().map(point),
                    friction: si_or(&s.across, 0.3),
                    drag_n_s_m: 1e3 / si_or(&s.slide_speed, SLIDE_M_S),
                },
            ),
            None => Site::Segment(index, at, s.normal.as_ref().map(|normal| direction(all_si(normal)))),
        }
    }

    fn stroke(&self, b: &mut Builder, path: &str, s: &StrokeSection) -> Stroke {
        let path = format!("{path}.pretensioner");
        let way = points(b, &path, ["times", "pull"], &s.times, &s.pull);
        let due_s = self.triggers.time_s(b, &format!("{path}.trigger"), &s.trigger);
        Stroke {
            due_s: due_s.map_or(NEVER, |at_s| at_s + si_or(&s.delay, 0.0)),
            direction: direction(s.direction.as_ref().map_or([-0.5, 0.0, 0.866], all_si)),
            way,
            stall_n: si_or(&s.stall_force, NEVER),
        }
    }
}

/// A unit vector; one of no length stays so.
fn direction(along: [f64; 3]) -> Vector3<f64> {
    let along = Vector3::from(along);
    along.try_normalize(1e-12).unwrap_or(along)
}

/// Points from two lists of equal length.
fn points<const A: usize, const B: usize, const C: usize, const D: usize>(
    b: &mut Builder,
    path: &str,
    [x, y]: [&str; 2],
    xs: &[super::Quantity<A, B>],
    ys: &[super::Quantity<C, D>],
) -> Vec<[f64; 2]> {
    if xs.len() != ys.len() {
        let found = format!("{} numbers in `{x}`, {} in `{y}`", xs.len(), ys.len());
        b.error(path, found, "as many in one as in the other");
    }
    xs.iter().zip(ys).map(|(x, y)| [x.si(), y.si()]).collect()
}

/// μ of each interval.
fn returned(one: &Option<Ratio<FRACTION>>, each: &Option<Vec<Ratio<FRACTION>>>, usual: f64, points: usize) -> Vec<f64> {
    match each {
        Some(each) => each.iter().map(Ratio::si).collect(),
        None => vec![si_or(one, usual); points.saturating_sub(1)],
    }
}
