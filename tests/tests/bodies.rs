//! Bodies of more than the report's 12 segments: that they move, and that a joint that does not turn changes nothing.

use nalgebra::Vector3;
use occupant_core::body::Body;
use occupant_core::model::Model;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::{RunStatus, Summarizer, Summary};
use occupant_core::run::simulate::simulate;
use occupant_tests::measure::assert_below;
use occupant_tests::room::setup;

const SLED: &str = include_str!("../../scenarios/sled-17-segments.toml");

/// Fixed steps, s.
const FIXED: [&str; 2] = ["integrator.kind=rk4", "integrator.step=1e-4"];

fn model(overrides: &[&str]) -> Model {
    Model::new(setup(SLED, overrides)).unwrap_or_else(|problems| panic!("{problems}"))
}

fn summary(model: &Model) -> Summary {
    let mut summarizer = Summarizer::new();
    simulate(model, &mut summarizer).unwrap();
    summarizer.summary(None).unwrap()
}

/// What a run shows at every output.
fn seen<T>(model: &Model, look: impl Fn(&Sample<'_>) -> T) -> Vec<T> {
    let mut seen = Vec::new();
    simulate(model, Watch(|s: &Sample<'_>| seen.push(look(s)))).unwrap();
    seen
}

fn head_m(s: &Sample<'_>) -> Vector3<f64> {
    s.cg_m(s.model.body().tree.landmarks().head.unwrap()).coords
}

#[test]
fn the_neck_of_seventeen_segments_moves_in_two_joints() {
    // Measured: 9.0e-8 with fixed steps, 8.7e-6 with error control.
    for (steps, bound) in [(&FIXED[..], 1e-6), (&[], 3e-5)] {
        let summary = summary(&model(steps));
        assert_eq!(summary.status, RunStatus::Completed);
        assert_below("energy balance", summary.energy.balance_error, bound);
    }
    let model = model(&[]);
    let tree = model.body().tree;
    assert_eq!((tree.segments().len(), tree.joints().len()), (17, 16));
    for name in ["neck_base", "neck", "left_ankle", "right_wrist"] {
        let joint = tree.joints().find(|joint| tree[*joint].name == name).unwrap();
        let angles = seen(&model, |s| s.joint_angle_rad(joint).to_degrees());
        let most = angles.iter().fold(f64::NEG_INFINITY, |most, angle| most.max(*angle));
        let least = angles.iter().fold(f64::INFINITY, |least, angle| least.min(*angle));
        // Measured: 18 to 54°, 2 to 44°, 0 to 41°, 0 to 34°.
        assert!(most - least > 20.0, "{name}: {least} to {most}");
        assert!(most < 70.0, "{name}: {most}");
    }
}

#[test]
fn left_and_right_of_seventeen_segments_are_alike() {
    // the torso belt alone is not
    let mut setup = setup(SLED, &["time.end=0.1"]);
    setup.belts.retain(|belt| belt.name == "lap");
    let model = Model::new(setup).unwrap_or_else(|problems| panic!("{problems}"));
    let beside = seen(&model, |s| head_m(s).y.abs());
    // Measured: 3.9e-15.
    assert_below("head beside the middle plane, m", beside.into_iter().fold(0.0, f64::max), 1e-12);
}

/// A kilogram of a lower leg, with its own share of the inertia, as a segment on a joint that does not turn.
fn ballast() -> String {
    let leg = Body::male50().segments[10];
    let share = 1.0 / leg.mass_kg;
    let list = |part: f64| {
        let own = leg.inertia_kg_m2 * part;
        format!("[{:e}, {:e}, {:e}]", own.x, own.y, own.z)
    };
    format!(
        "[body.segments.left_lower_leg]\nmass = {:e}\ninertia = {}\n[body.segments.ballast]\nlength = {:e}\n\
         cg_from_lower_end = {:e}\nmass = 1\ninertia = {}\n[body.joints.screw]\nproximal = \"left_lower_leg\"\n\
         distal = \"ballast\"\nkind = \"fixed\"\non_proximal = [0, 0, 0]\non_distal = [0, 0, 0]\n",
        leg.mass_kg - 1.0,
        list(1.0 - share),
        leg.length_m,
        leg.cg_from_lower_end_m,
        list(share),
    )
}

#[test]
fn twelve_segments_with_a_part_screwed_on_move_as_the_twelve() {
    let plain: String =
        SLED.lines().filter(|line| !line.starts_with("neck = ")).map(|line| format!("{line}\n")).collect();
    let run = |text: &str| {
        // error control looks at every coordinate, and would take other steps
        let setup = setup(text, &[&["body.segment_count=12", "time.end=0.08"][..], &FIXED].concat());
        let model = Model::new(setup).unwrap_or_else(|problems| panic!("{problems}"));
        (model.body().tree.segments().len(), seen(&model, head_m))
    };
    let ((count, alone), (more, screwed)) = (run(&plain), run(&(plain.clone() + &ballast())));
    assert_eq!((count, more), (12, 13));
    let apart = alone.iter().zip(&screwed).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    // Measured: 3e-16.
    assert_below("heads apart, m", apart, 1e-12);
}
