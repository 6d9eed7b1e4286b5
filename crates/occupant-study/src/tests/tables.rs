//! Samples from a CSV file.

use super::super::{StudyText, Value};
use super::base;
use occupant_scenario::{Diagnostics, Format};

const STUDY: &str = "base = \"short.toml\"
design = { kind = \"table\", file = \"samples.csv\" }

[[parameters]]
name = \"damping\"
path = \"joints.*.damping\"
apply = \"factor\"
";

fn with(csv: &str) -> Result<super::Study, Diagnostics> {
    let text = StudyText::read(STUDY, Format::Toml, "study.toml").unwrap();
    text.bind(base(), &[], &|file| match file {
        "samples.csv" => Ok(csv.as_bytes().to_vec()),
        _ => Err("not there".into()),
    })
}

#[test]
fn a_table_gives_the_samples_row_by_row() {
    let study = with("# ours\nbelts.lap.slack[mm], damping, path.shape\n\n10, 1, square\n25.4, 0.5, half_sine\n");
    let study = study.unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(study.len(), 2);
    let names: Vec<&str> = study.parameters.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["damping", "belts.lap.slack", "path.shape"]);
    let row: Vec<Value> = study.sample(1).into_iter().map(|s| s.value).collect();
    let wanted = [Value::Number(0.5), Value::Number(0.0254), Value::Text("half_sine".into())];
    assert_eq!(row, wanted);
    assert_eq!(study.assignments(1).len(), 13);
}

#[test]
fn everything_wrong_with_a_table_is_told_at_once() {
    let words = with("belts.lap.slck[mm], path.shape, posture.head\n1, sine, 2\n1, square\n").unwrap_err();
    assert_eq!(
        words.to_string(),
        r#"error: `belts.lap` has nothing named `slck`
 --> samples.csv:1:1
  = help: did you mean `slack`?
  = expected: the name of a parameter, or a path: one of anchor, anchors, buckle, d_ring, d_ring_frame, delta_b, k1, k2, lap, lap_above, length, limiter, locking_tongue, mu1, mu2, nodes, preset, pretension, pretensioner, release, retractor, side, slack, sphere, strength, webbing, worn

error: column `posture.head` without a unit
 --> samples.csv:1:33
  = expected: the unit of an angle in brackets, such as `posture.head[deg]`

error: no column `damping`
 --> samples.csv:1:1
  = expected: one column per parameter

error: `sine`
 --> samples.csv:2:4
  = expected: "half_sine", "haversine", "triangle", "trapezoid", "square" or "tabulated"

error: 2 values
 --> samples.csv:3:1
  = expected: 3, one for each column"#
    );
    let none = with("damping\n").unwrap_err().to_string();
    assert!(none.contains("a table without samples"), "{none}");
    let empty = with("").unwrap_err().to_string();
    assert!(empty.contains("an empty table"), "{empty}");
}
