//! Names that refer to other parts of a scenario.

use indexmap::IndexSet;
use placed_text::{Node, Problem, did_you_mean, follow, one_of, parse_path, targets, to_text};

/// Path of a name, its kind, and the tables that define names of this kind.
const REFERENCES: [(&str, &str, &str); 35] = [
    ("joints.*.set", "joint set", "joint_sets"),
    ("muscles.trigger", "trigger", "triggers"),
    ("muscles.*.trigger", "trigger", "triggers"),
    ("surfaces.*.material", "material", "materials"),
    ("surfaces.*.spheres[*]", "sphere", "body.spheres"),
    ("solids.*.material", "material", "materials"),
    ("solids.*.spheres[*]", "sphere", "body.spheres"),
    ("triggers.*.of[*]", "trigger", "triggers"),
    ("bags.*.trigger", "trigger", "triggers"),
    ("bags.*.inflators[*].trigger", "trigger", "triggers"),
    ("bags.*.vents[*].trigger", "trigger", "triggers"),
    ("bags.*.spheres[*]", "sphere", "body.spheres"),
    ("belts.*.sphere", "sphere", "body.spheres"),
    ("belts.*.webbing", "webbing", "webbings"),
    ("belts.*.limiter", "limiter", "limiters"),
    ("belts.*.retractor", "retractor", "retractors"),
    ("belts.*.release", "trigger", "triggers"),
    ("belts.*.nodes[*].sphere", "sphere", "body.spheres"),
    ("belts.*.nodes[*].retractor", "retractor", "retractors"),
    ("belts.*.nodes[*].pretensioner.trigger", "trigger", "triggers"),
    ("belts.*.pretensioner.trigger", "trigger", "triggers"),
    ("retractors.*.lock.trigger", "trigger", "triggers"),
    ("retractors.*.limiter", "limiter", "limiters"),
    ("retractors.*.second_limiter.limiter", "limiter", "limiters"),
    ("retractors.*.second_limiter.trigger", "trigger", "triggers"),
    ("retractors.*.pretensioner.trigger", "trigger", "triggers"),
    ("self_contact.skin", "material", "materials"),
    ("self_contact.skins.*", "material", "materials"),
    ("self_contact.pairs[*][0]", "sphere", "body.spheres"),
    ("self_contact.pairs[*][1]", "sphere", "body.spheres"),
    ("seats.*.cushion", "surface", "surfaces|solids"),
    ("seats.*.back", "surface", "surfaces|solids"),
    ("posture.seat", "seat", "seats"),
    ("initial_state.passed[*][0]", "sphere", "body.spheres"),
    ("initial_state.passed[*][1]", "surface", "surfaces"),
];

/// Number of problems shown.
const SHOWN: usize = 50;

/// Unknown names in an explicit scenario; `spheres` are known in addition to its own. Without them, names of spheres
/// are left to the code that has the body.
pub(crate) fn references(explicit: &Node, spheres: Option<&[String]>) -> Vec<Problem> {
    let mut problems = Vec::new();
    for (pattern, what, tables) in REFERENCES.into_iter().filter(|of| of.1 != "sphere" || spheres.is_some()) {
        let places = targets(explicit, &parse_path(pattern).unwrap_or_default());
        if places.is_empty() {
            continue;
        }
        let mut names: IndexSet<&str> = tables.split('|').flat_map(|table| names_in(explicit, table)).collect();
        if what == "sphere" {
            names.extend(spheres.iter().copied().flatten().map(String::as_str));
        }
        let listed: Vec<&str> = names.iter().copied().collect();
        for steps in places {
            let Some(name) = follow(explicit, &steps).and_then(Node::as_str) else { continue };
            if !names.contains(name) {
                let found = format!("no {what} is named \"{name}\"");
                let problem = Problem::error(to_text(&steps), found, format!("a {what} of the scenario"));
                // a search for what was meant looks at all names: not for problems that are only counted
                problems.push(match listed.as_slice() {
                    _ if problems.len() > SHOWN => problem,
                    [] => Problem { expected: format!("a {what}; the scenario has none"), ..problem },
                    names => {
                        Problem { expected: one_of(names, '"'), ..problem }.with_hint(did_you_mean(name, names, '"'))
                    }
                });
            }
        }
    }
    problems
}

/// The keys of a table, without removed entries.
fn names_in<'n>(explicit: &'n Node, table: &str) -> impl Iterator<Item = &'n str> {
    let node = follow(explicit, &parse_path(table).unwrap_or_default());
    let entries = node.and_then(Node::as_table).into_iter().flatten();
    entries.filter(|(_, e)| !e.node.is_removed()).map(|(key, _)| key.as_str())
}
