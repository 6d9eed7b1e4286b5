//! Names that refer to other parts of a scenario.

use placed_text::{Node, Problem, did_you_mean, follow, one_of, parse_path, targets, to_text};

/// Where a name stands, what it names, and the table that has things of that kind.
const REFERENCES: [(&str, &str, &str); 9] = [
    ("joints.*.set", "joint set", "joint_sets"),
    ("surfaces.*.material", "material", "materials"),
    ("surfaces.*.spheres[*]", "sphere", "body.spheres"),
    ("belts.*.sphere", "sphere", "body.spheres"),
    ("seats.*.cushion", "surface", "surfaces"),
    ("seats.*.back", "surface", "surfaces"),
    ("posture.seat", "seat", "seats"),
    ("initial_state.passed[*][0]", "sphere", "body.spheres"),
    ("initial_state.passed[*][1]", "surface", "surfaces"),
];

/// Names in an explicit scenario that lead nowhere; `spheres` are known besides those that it has.
pub(in crate::scenario) fn references(explicit: &Node, spheres: &[&str]) -> Vec<Problem> {
    let mut problems = Vec::new();
    for (pattern, what, table) in REFERENCES {
        let mut names = names_in(explicit, table);
        if what == "sphere" {
            names.extend(spheres.iter().filter(|s| !names.contains(s)).copied().collect::<Vec<_>>());
        }
        for steps in targets(explicit, &parse_path(pattern).unwrap_or_default()) {
            let Some(name) = follow(explicit, &steps).and_then(Node::as_str) else { continue };
            if !names.contains(&name) {
                let expected = match names.as_slice() {
                    [] => format!("a {what}; the scenario has none"),
                    names => one_of(names, '"'),
                };
                let found = format!("no {what} is named \"{name}\"");
                let hint = did_you_mean(name, &names, '"');
                problems.push(Problem::error(to_text(&steps), found, expected).with_hint(hint));
            }
        }
    }
    problems
}

/// The keys of a table, without those of things that are taken away.
fn names_in<'n>(explicit: &'n Node, table: &str) -> Vec<&'n str> {
    let node = follow(explicit, &parse_path(table).unwrap_or_default());
    let entries = node.and_then(Node::as_table).into_iter().flatten();
    entries.filter(|(_, e)| !e.node.is_removed()).map(|(key, _)| key.as_str()).collect()
}
