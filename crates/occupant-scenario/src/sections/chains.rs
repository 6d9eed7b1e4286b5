//! Belts with nodes, converted to [`Chain`]s.

use super::belts::{self, BeltSection};
use super::builder::Builder;
use super::nodes::NodeSection;
use super::quantity::si_or;
use super::triggers::Triggers;
use super::{Scenario, three_point};
use occupant_core::body::Body;
use occupant_core::forces::chain::{Chain, Cue, Device, NEVER, Node, Rest};
use occupant_core::forces::contact::surface::Frame;
use occupant_core::forces::function::Function;
use placed_text::with_key;

/// Objects that belts refer to.
pub(super) struct Parts<'a> {
    pub(super) scenario: &'a Scenario,
    pub(super) body: &'a Body,
    pub(super) triggers: &'a Triggers<'a>,
}

/// All belts with nodes, in the order written; one per part between ties.
pub(super) fn chains(b: &mut Builder, scenario: &Scenario, body: &Body, triggers: &Triggers<'_>) -> Vec<Chain> {
    let parts = Parts { scenario, body, triggers };
    let mut list = Vec::new();
    let is_told = scenario.belts.len() <= belts::MOST;
    for (name, section) in scenario.belts.iter().filter(|(_, own)| is_told && own.is_worn()) {
        let path = with_key("belts", name);
        let nodes = match (&section.nodes, &section.preset) {
            (Some(nodes), _) => {
                let keys = ["side", "retractor", "pretensioner", "lap_above", "locking_tongue"];
                b.refuse_keys(
                    &path,
                    &keys,
                    |key| format!("`{key}` in a belt with nodes"),
                    "what it stands for in one of its nodes",
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
        let rest = rest(s);
        if device.reel.is_some() {
            let expected = "none of them: the spool sets the belt's tension";
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
            let rubs = |i: &usize| *i == 0 || *i + 1 == nodes.len() || nodes[*i].parts();
            let ends: Vec<usize> = (0..nodes.len()).filter(rubs).collect();
            let straps = ends.windows(2).map(|e| format!("{name}.{}_{}", nodes[e[0]].name, nodes[e[1]].name)).collect();
            let release = s.release.as_deref().map_or(Cue::NEVER, |trigger| self.triggers.cue(trigger, 0.0));
            let (webbing, strength_n) = (webbing.clone(), si_or(&s.strength, NEVER));
            let fixed = Device { limiter: None, second: None, reel: None };
            let device = std::mem::replace(&mut device, fixed);
            list.push(Chain {
                belt: name.to_owned(),
                frame: Frame::Vehicle,
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
            return (three_point::webbing(b), None);
        };
        match self.scenario.webbings.get(name) {
            Some(webbing) => webbing.function(b, &with_key("webbings", name)),
            None => (three_point::webbing(b), None),
        }
    }
}

/// Source of the unstretched length.
fn rest(s: &BeltSection) -> Rest {
    match (&s.slack, &s.pretension, &s.length) {
        (_, Some(tension), _) => Rest::Pretension(tension.si()),
        (_, _, Some(length)) => Rest::Length(length.si()),
        (slack, ..) => Rest::Slack(si_or(slack, 0.0)),
    }
}
