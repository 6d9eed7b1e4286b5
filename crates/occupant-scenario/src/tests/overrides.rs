//! `path.to.key=value`.

use approx::assert_relative_eq;

use super::super::{Draft, Format};
use super::{SHORT, no_files};
use occupant_core::body::tti12;
use occupant_core::model::setup::Setup;

fn changed(assignments: &[&str]) -> Result<Setup, String> {
    let text = |e: super::Diagnostics| e.to_string();
    let mut draft = Draft::read(SHORT, Format::Toml, "s.toml").map_err(text)?;
    for assignment in assignments {
        draft.set(assignment).map_err(text)?;
    }
    let loaded = draft.load(&no_files).map_err(text)?;
    loaded.build().map(|(setup, _)| setup).map_err(text)
}

#[test]
fn values_are_toml_or_plain_text() {
    let setup = changed(&[
        "belts.lap.slack = \"1 in\"",
        "belts.lap.k1=80 kN/m",
        "belts.lap.anchors[1][2]=0.25",
        "posture.settle=true",
        "integrator.kind=rk4",
        "integrator.step=2e-4",
    ])
    .unwrap();
    let belt = &setup.belts[0];
    assert_eq!(belt.rest, occupant_core::forces::belt::RestLength::Slack { slack_m: 0.0254 });
    assert_relative_eq!(belt.webbing.k1_n_per_m, 80e3);
    assert_eq!(belt.anchors_m[1].z, 0.25);
    assert_eq!(setup.integrator, occupant_core::model::setup::Integrator::Rk4 { step_s: 2e-4 });
}

#[test]
fn a_number_without_a_digit_before_its_point_is_one() {
    let setup = changed(&["integrator.kind=rk4", "integrator.step=.0002", "belts.lap.anchors[1][2]=+.25"]).unwrap();
    assert_eq!(setup.integrator, occupant_core::model::setup::Integrator::Rk4 { step_s: 2e-4 });
    assert_eq!(setup.belts[0].anchors_m[1].z, 0.25);
}

#[test]
fn null_takes_away_what_stands_there() {
    let setup = changed(&["belts.lap=null"]).unwrap();
    assert_eq!(setup.belts.len(), changed(&[]).unwrap().belts.len() - 1);
    assert!(setup.belts.iter().all(|belt| belt.name != "lap"));
    let refused = changed(&["belts.nothing=null"]).unwrap_err();
    assert!(refused.contains("there is no `belts.nothing` to remove"), "{refused}");
}

#[test]
fn wildcards_reach_what_a_preset_says() {
    let setup = changed(&["joints.*.damping=0.5", "surfaces.*.half_width=0.3"]).unwrap();
    assert_eq!(setup.joints[tti12::NECK].ball().unwrap().damping_n_m_s, 0.5);
    assert_eq!(setup.joints[tti12::LEFT_KNEE].hinge().unwrap().damping_n_m_s, 0.5);
    // The stops of the preset stay.
    assert!(setup.joints[tti12::NECK].ball().unwrap().stop.is_some());
    // A stop's own damping is another key.
    assert!(setup.joints[tti12::NECK].ball().unwrap().stop.unwrap().damping_n_m_s > 1.0);
}

#[test]
fn one_number_of_a_presets_list_can_be_changed() {
    let (setup, plain) = (changed(&["body.segments.head.inertia[1]=0.5"]).unwrap(), changed(&[]).unwrap());
    let (head, before) = (setup.body.segments[2], plain.body.segments[2]);
    assert_eq!(head.inertia_kg_m2.y, 0.5);
    assert_eq!(head.inertia_kg_m2.x, before.inertia_kg_m2.x);
    assert_eq!(head.mass_kg, before.mass_kg);
}

#[test]
fn mass_replaces_a_presets_weight() {
    let setup = changed(&["body.segments.thighs.mass=9 kg"]).unwrap();
    assert_eq!(setup.body.segments[8].mass_kg, 9.0);
    assert_eq!(setup.body.segments[9].mass_kg, 9.0);
}

#[test]
fn values_can_be_read_before_they_are_changed() {
    let mut draft = Draft::read(SHORT, Format::Toml, "s.toml").unwrap();
    let found = draft.get("joints.*.damping").unwrap();
    assert_eq!(found.len(), 11);
    assert_eq!(found[0].0, "joints.neck.damping");
    let found = draft.get("path.speed").unwrap();
    assert_eq!(found[0].1, placed_text::Value::String("30 km/h".into()));
    assert!(draft.get("belts.*.slack").is_err());
}

#[test]
fn problems_are_reported_as_of_the_override() {
    for (assignment, expected) in [
        (
            "path.speed=30 mhp",
            "error: unknown unit `mhp`
 --> override of path.speed:1:4
  |
1 | 30 mhp
  |    ^^^
  = help: did you mean `mph`?
  = in: path.speed
  = expected: a unit such as m, in, s, deg, km/h, mph, g, kg, lb (mass), N, lbf (force)",
        ),
        (
            "belts.lap.k3=5",
            "error: unknown key `k3`
 --> override of belts.lap.k3:1:1
  |
1 | 5
  | ^
  = in: belts.lap
  = expected: `sphere`, `anchors`, `k1`, `delta_b`, `k2`, `slack`, `length`, `mu1`, `mu2`, \
             `nodes`, `webbing`, `pretension`, `limiter`, `release`, `strength`, `preset`, `locking_tongue`, `lap_above`, `side`, `d_ring`, `d_ring_frame`, `buckle`, `anchor`, `lap`, `retractor`, `pretensioner` or `worn`",
        ),
        (
            "belts.lap.anchors[2][0]=5",
            "error: `belts.lap.anchors` has no item 2
 --> override of belts.lap.anchors[2][0]
  = expected: the path of an existing key",
        ),
        (
            "joints.*.k1=5",
            "error: this scenario has no `joints.*.k1`
 --> override of joints.*.k1
  = expected: the path of an existing key",
        ),
        (
            "path.speed",
            "error: `path.speed` has no `=`
 --> override
  = expected: path.to.key=value",
        ),
    ] {
        assert_eq!(changed(&[assignment]).unwrap_err(), expected);
    }
}
