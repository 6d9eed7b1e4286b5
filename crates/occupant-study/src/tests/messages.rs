//! Every kind of complaint, as a user reads it.

use super::complaint;

fn expect(text: &str, wanted: &str) {
    assert_eq!(complaint(text), wanted, "\n{}", complaint(text));
}

#[test]
fn wrong_words_are_told_all_at_once() {
    expect(
        "sed = 3
design = { kind = \"latin_hypercub\", samples = 9 }
[[parameters]]
path = \"belts.lap.k1\"
grid = { from = 1, to = 2, steps = 1 }
list = []
",
        r#"error: unknown key `sed`
 --> study.toml:2:1
  |
2 | sed = 3
  | ^^^
  = help: did you mean `seed`?
  = expected: `title`, `notes`, `units`, `base`, `seed`, `set`, `parameters`, `correlations`, `constraints`, `design`, `ensemble`, `fit`, `optimise`, `keep`, `output` or `rating`

error: "latin_hypercub" is not a value of `kind`
 --> study.toml:3:19
  |
3 | design = { kind = "latin_hypercub", samples = 9 }
  |                   ^^^^^^^^^^^^^^^^
  = help: did you mean "latin_hypercube"?
  = in: design.kind
  = expected: "full_factorial", "latin_hypercube", "sobol", "monte_carlo", "one_at_a_time", "table", "saltelli" or "morris"

error: `1` is out of range
 --> study.toml:6:36
  |
6 | grid = { from = 1, to = 2, steps = 1 }
  |                                    ^
  = in: parameters[0].grid.steps
  = expected: a whole number of at least 2

error: an empty list
 --> study.toml:7:8
  |
7 | list = []
  |        ^^
  = in: parameters[0].list
  = expected: a list of at least 1

error: `grid` and `list` together
 --> study.toml:7:1
  |
7 | list = []
  | ^^^^
  = in: parameters[0]
  = expected: only one of them"#,
    );
}

#[test]
fn paths_that_lead_nowhere_are_told() {
    expect(
        "design = { kind = \"monte_carlo\", samples = 9 }
[[parameters]]
path = \"joints.nek.damping\"
range = { from = 1, to = 2 }
[[parameters]]
path = \"joints.*.dampng\"
range = { from = 1, to = 2 }
[[parameters]]
path = \"materials.seat.k1\"
range = { from = 1, to = 2 }
[[parameters]]
path = \"belts.lap\"
range = { from = 1, to = 2 }
",
        r#"error: `joints` has nothing named `nek`
 --> study.toml:4:8
  |
4 | path = "joints.nek.damping"
  |        ^^^^^^^^^^^^^^^^^^^^
  = help: did you mean `neck`?
  = in: parameters[0].path
  = expected: one of all, elbows, epsilon, hips, knees, left_elbow, left_hip, left_knee, left_shoulder, lower_back, neck, preset, right_elbow, right_hip, right_knee, right_shoulder, shoulders, upper_back

error: `joints.*.dampng` matches nothing in the base scenario
 --> study.toml:7:8
  |
7 | path = "joints.*.dampng"
  |        ^^^^^^^^^^^^^^^^^
  = help: did you mean `damping`?
  = in: parameters[1].path
  = expected: the path of an existing value

error: `materials` has nothing named `seat`
  --> study.toml:10:8
   |
10 | path = "materials.seat.k1"
   |        ^^^^^^^^^^^^^^^^^^^
   = in: parameters[2].path
   = expected: one of foam

error: `belts.lap` is a table or list, not a single value
  --> study.toml:13:8
   |
13 | path = "belts.lap"
   |        ^^^^^^^^^^^
   = in: parameters[3].path
   = expected: the path of a number or a name"#,
    );
}

#[test]
fn a_wildcard_that_matches_nothing_says_what_may_be_meant() {
    for (path, meant) in [
        ("material.*.k1", "did you mean `materials`?"),
        ("belts.*.anchors[*][7]", "matches nothing"),
        ("*.*.frction", "did you mean `friction`?"),
        ("joints.nek.*", "did you mean `neck`?"),
    ] {
        let words = complaint(&format!(
            "design = {{ kind = \"monte_carlo\", samples = 9 }}
[[parameters]]
path = \"{path}\"
range = {{ from = 1, to = 2 }}
"
        ));
        assert!(words.contains(meant), "{path}: {words}");
    }
}

#[test]
fn numbers_that_make_no_sense_are_told() {
    expect(
        "design = { kind = \"monte_carlo\", samples = 9 }
[[parameters]]
path = \"joints.neck.damping\"
range = { from = \"1 N/m\", to = 2 }
[[parameters]]
path = \"joints.left_knee.damping\"
range = { from = 0, to = 2, scale = \"log\" }
[[parameters]]
path = \"joints.right_knee.damping\"
range = { from = 3, to = 2 }
[[parameters]]
path = \"materials.foam.k1\"
distribution = { kind = \"normal\", mean = 3, sd = 0 }
",
        r#"error: `N/m` is not the unit of a rotational damping
 --> study.toml:5:18
  |
5 | range = { from = "1 N/m", to = 2 }
  |                  ^^^^^^^
  = in: parameters[0].range.from
  = expected: a rotational damping: 0.65, "5.73 in·lbf·s/rad", "0.1 in lbf s/deg"

error: `from` is not above zero on a logarithmic scale
 --> study.toml:8:18
  |
8 | range = { from = 0, to = 2, scale = "log" }
  |                  ^
  = in: parameters[1].range.from
  = expected: two ends above zero

error: `from` is above `to`
  --> study.toml:11:26
   |
11 | range = { from = 3, to = 2 }
   |                          ^
   = in: parameters[2].range.to
   = expected: `from` below `to`

error: a standard deviation that is not above zero
  --> study.toml:14:50
   |
14 | distribution = { kind = "normal", mean = 3, sd = 0 }
   |                                                  ^
   = in: parameters[3].distribution.sd
   = expected: a standard deviation above zero"#,
    );
}

#[test]
fn a_value_that_the_scenario_cannot_have_is_told() {
    expect(
        "design = { kind = \"monte_carlo\", samples = 9 }
[[parameters]]
path = \"materials.foam.k1\"
range = { from = -1, to = 2 }
",
        r#"error: `materials.foam.k1` makes the scenario invalid: `-1.0 N/m` is out of range
 --> study.toml:3:1
  |
3 | [[parameters]]
  | ^^^^^^^^^^^^^^
  = in: parameters[0]
  = expected: a stiffness of at least 0"#,
    );
}

#[test]
fn a_normal_distribution_that_may_leave_what_is_possible_is_warned_of() {
    let study = super::study(
        "design = { kind = \"monte_carlo\", samples = 9 }
[[parameters]]
path = \"materials.foam.friction\"
distribution = { kind = \"normal\", mean = 0.3, sd = 0.1 }
",
    );
    assert_eq!(
        study.warnings.to_string(),
        r#"warning: `materials.foam.friction` makes the scenario invalid: `-0.1753424308822899` is out of range
 --> study.toml:3:1
  |
3 | [[parameters]]
  | ^^^^^^^^^^^^^^
  = in: parameters[0]
  = expected: a plain number of at least 0
  = help: a "truncated_normal" distribution stays within the possible range"#
    );
}

#[test]
fn factors_need_numbers() {
    expect(
        "design = { kind = \"monte_carlo\", samples = 9 }
[[parameters]]
path = \"surfaces.floor.material\"
apply = \"factor\"
range = { from = 1, to = 2 }
[[parameters]]
path = \"path.shape\"
range = { from = 1, to = 2 }
[[parameters]]
name = \"shape\"
path = \"path.shape\"
list = [\"squar\", 3]
[[parameters]]
paths = [\"materials.foam.k1\", \"materials.foam.friction\"]
range = { from = 1, to = 2 }
",
        r#"error: `surfaces.floor.material` is a text, so it cannot be multiplied
 --> study.toml:4:8
  |
4 | path = "surfaces.floor.material"
  |        ^^^^^^^^^^^^^^^^^^^^^^^^^
  = in: parameters[0].path
  = expected: the path of numbers in the base scenario

error: numbers for a name
 --> study.toml:7:1
  |
7 | [[parameters]]
  | ^^^^^^^^^^^^^^
  = in: parameters[1]
  = expected: a `list` of values

error: "squar" is not one of its names
  --> study.toml:13:9
   |
13 | list = ["squar", 3]
   |         ^^^^^^^
   = help: did you mean "square"?
   = in: parameters[2].list[0]
   = expected: "half_sine", "haversine", "triangle", "trapezoid", "square" or "tabulated"

error: a number instead of a name
  --> study.toml:13:18
   |
13 | list = ["squar", 3]
   |                  ^
   = in: parameters[2].list[1]
   = expected: a name

error: `materials.foam.k1` is a stiffness, `materials.foam.friction` is a plain number
  --> study.toml:15:10
   |
15 | paths = ["materials.foam.k1", "materials.foam.friction"]
   |          ^^^^^^^^^^^^^^^^^^^
   = in: parameters[3].paths[0]
   = expected: paths of one quantity"#,
    );
}

#[test]
fn parameters_that_get_in_each_others_way_are_told() {
    expect(
        "design = { kind = \"monte_carlo\", samples = 9 }
[[parameters]]
name = \"a\"
path = \"joints.*.damping\"
apply = \"factor\"
range = { from = 1, to = 2 }
[[parameters]]
name = \"a\"
path = \"joints.neck.damping\"
range = { from = 1, to = 2 }
",
        r#"error: two parameters named `a`
 --> study.toml:8:1
  |
8 | [[parameters]]
  | ^^^^^^^^^^^^^^
  = in: parameters[1]
  = expected: a unique name
  = help: name = "…"

error: `joints.neck.damping` is already varied by `a`
 --> study.toml:8:1
  |
8 | [[parameters]]
  | ^^^^^^^^^^^^^^
  = in: parameters[1]
  = expected: each key varied by one parameter
  = help: a factor or an offset may come after a value, not before it"#,
    );
}

#[test]
fn correlations_that_contradict_each_other_are_told() {
    let parameter = |name: &str, path: &str| {
        format!("[[parameters]]\nname = \"{name}\"\npath = \"{path}\"\nrange = {{ from = 0, to = 1 }}\n")
    };
    let text = format!(
        "design = {{ kind = \"monte_carlo\", samples = 9 }}\n{}{}{}[[correlations]]
between = [\"a\", \"b\"]
rank = 0.9
[[correlations]]
between = [\"b\", \"c\"]
rank = 0.9
[[correlations]]
between = [\"a\", \"c\"]
rank = -0.9
",
        parameter("a", "materials.foam.friction"),
        parameter("b", "materials.foam.mu1"),
        parameter("c", "belts.lap.mu1"),
    );
    expect(
        &text,
        r#"error: correlations that contradict each other: their matrix is not positive definite
  --> study.toml:15:1
   |
15 | [[correlations]]
   | ^^^^^^^^^^^^^^^^
   = in: correlations
   = expected: a positive definite matrix
   = help: if a correlates with b and b with c, then a must correlate with c to some degree"#,
    );
    let unknown = text.replace("[\"a\", \"c\"]", "[\"a\", \"d\"]");
    let words = complaint(&unknown);
    assert!(words.contains("no parameter is named \"d\""), "{words}");
    let factorial = text.replace("kind = \"monte_carlo\", samples = 9", "kind = \"one_at_a_time\"");
    let words = complaint(&factorial);
    assert!(words.contains("correlations in a design that does not support them"), "{words}");
}

#[test]
fn designs_that_do_not_fit_are_told() {
    let one = "[[parameters]]\npath = \"materials.foam.friction\"\nrange = { from = 0, to = 1 }\n";
    expect(
        one,
        r#"error: parameters without a `design`
 --> study.toml
  = expected: how the samples are chosen
  = help: design = { kind = "latin_hypercube", samples = 100 }"#,
    );
    expect(
        &format!("design.kind = \"full_factorial\"\n{one}"),
        r#"error: `materials.foam.friction` has no list of values
 --> study.toml:2:1
  |
2 | design.kind = "full_factorial"
  | ^^^^^^
  = in: design
  = expected: a `grid` or a `list` for each parameter
  = help: or choose another design, such as "latin_hypercube""#,
    );
    expect(
        "",
        r#"error: the study varies nothing
 --> study.toml
  = expected: `parameters` and a `design`, or an `ensemble`"#,
    );
    expect(
        &format!(
            "keep = \"best 5 by hic\"\ndesign = {{ kind = \"morris\", trajectories = 3, levels = 5, tail = 0.5 }}\n{one}"
        ),
        r#"error: "best 5 by hic" does not say which runs to keep
 --> study.toml:2:8
  |
2 | keep = "best 5 by hic"
  |        ^^^^^^^^^^^^^^^
  = in: keep
  = expected: "all", "none", a list of indices, or such as "worst 5 by hic15"

error: `5` is not an even number
 --> study.toml:3:56
  |
3 | design = { kind = "morris", trajectories = 3, levels = 5, tail = 0.5 }
  |                                                        ^
  = in: design.levels
  = expected: an even number of levels, such as 4

error: a tail of 0.5
 --> study.toml:3:66
  |
3 | design = { kind = "morris", trajectories = 3, levels = 5, tail = 0.5 }
  |                                                                  ^^^
  = in: design.tail
  = expected: a part below 0.5"#,
    );
    let words = complaint("design.kind = \"full_factorial\"");
    assert!(words.contains("a design without parameters"), "{words}");
    let bare = "design.kind = \"full_factorial\"\n[[parameters]]\npath = \"materials.foam.friction\"\n";
    assert!(complaint(bare).contains("a parameter without values"));
}

#[test]
fn crossed_parameters_that_cannot_be_are_told() {
    let of = |design: &str, rest: &str| {
        let text = format!("design = {{ {design} }}\n[[parameters]]\npath = \"belts.lap.k1\"\nname = \"k\"\n{rest}\n");
        complaint(&text)
    };
    let sampled = "kind = \"monte_carlo\", samples = 9";
    let range = "range = { from = 60000, to = 80000 }";
    let list = "list = [60000, 80000]\ncrossed = true";
    let shape =
        "[[parameters]]\npath = \"path.shape\"\nname = \"shape\"\nlist = [\"half_sine\", \"square\"]\ncrossed = true";
    let correlated = format!("{range}\n{shape}\n[[correlations]]\nbetween = [\"k\", \"shape\"]\nrank = 0.5");
    for (found, wanted) in [
        (of(sampled, &format!("{range}\ncrossed = true")), "`crossed` without a list of values"),
        (of("kind = \"full_factorial\"", list), "`crossed` in a design that does not sample"),
        (of(sampled, list), "all parameters are crossed: nothing is sampled"),
        (of(sampled, &correlated), "`shape` is crossed with all samples"),
        (of("kind = \"monte_carlo\", samples = 9000000", &format!("{range}\n{shape}")), "18000000 runs"),
        (of(sampled, "[[parameters]]\nsegments = \"5 %\"\ncrossed = true"), "`crossed` without a list of values"),
    ] {
        assert!(found.contains(wanted), "{wanted}: {found}");
    }
}
