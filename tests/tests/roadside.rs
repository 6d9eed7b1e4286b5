//! The occupant of long, weak events: on a side slope, braked, in a lane change. What is compared stands in `docs/roadside.md`.

use occupant_core::model::Model;
use occupant_core::results::channel::{Series, find};
use occupant_core::run::simulate::simulate;
use occupant_scenario::{Draft, Format};
use occupant_tests::measure::{assert_below, assert_within};

/// A file of the repository's scenarios.
fn file(name: &str) -> String {
    std::fs::read_to_string(format!("{}/../scenarios/{name}", env!("CARGO_MANIFEST_DIR"))).expect(name)
}

const COARSE: &str = "output.interval=\"10 ms\"";
const BRAKING: &str = "path={ kind = \"pulse\", shape = \"trapezoid\", speed = \"80 km/h\", peak = \"1 g\", start = \"0.1 s\", \
                       rise = \"0.2 s\", plateau = \"0.6 s\", fall = \"0.1 s\" }";

fn model(set: &[&str]) -> Model {
    let mut draft = Draft::read(&file("side-slope.toml"), Format::Toml, "side-slope").unwrap();
    set.iter().for_each(|assignment| draft.set(assignment).unwrap());
    let beside = |name: &str| Ok::<_, String>(file(name).into_bytes());
    draft.load(&beside).and_then(|loaded| loaded.model()).unwrap_or_else(|e| panic!("{e}")).0
}

/// Values of channels over a run.
fn histories(model: &Model, names: &[&str]) -> Vec<Vec<f64>> {
    let mut series = Series::new(names.iter().map(|name| find(model, name).expect("a channel")).collect());
    let outcome = simulate(model, &mut series).unwrap();
    assert_below("energy balance", outcome.energy.balance_error, 1e-4);
    series.values
}

/// Least and greatest way from the start.
fn way(values: &[f64]) -> [f64; 2] {
    let from = values[0];
    values.iter().fold([0.0, 0.0], |[least, most], x| [f64::min(least, x - from), f64::max(most, x - from)])
}

fn greatest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

#[test]
fn on_the_side_slope_the_driver_sits_upright_and_holds_the_wheel() {
    let names = [
        "head.position.y",
        "head.position.x",
        "joint.neck.angle",
        "joint.neck_base.angle",
        "left_hand.position.z",
        "right_hand.position.z",
        "head.acceleration.resultant",
    ];
    let seen = histories(&model(&[COARSE]), &names);
    // Measured: 0.118 to the left, 0.099 to the right, 0.034 ahead; the former driver lay flat.
    let [left_m, right_m] = way(&seen[0]);
    assert_within("head to the left, m", -left_m, [0.06, 0.20]);
    assert_within("head to the right, m", right_m, [0.05, 0.20]);
    assert_below("head ahead, m", way(&seen[1])[1], 0.10);
    // Measured: 15.3, 8.6; 101 before.
    assert_below("neck, °", greatest(&seen[2]).to_degrees(), 25.0);
    assert_below("base of the neck, °", greatest(&seen[3]).to_degrees(), 20.0);
    for hand in &seen[4..6] {
        // Measured: 0.076 and 0.027, along the rim.
        assert_below("a hand off its place, m", way(hand).into_iter().fold(0.0, |most, x| most.max(x.abs())), 0.12);
    }
    // Measured: 22.
    assert_below("reading of the head, m/s²", greatest(&seen[6]), 35.0);
}

#[test]
fn who_sits_on_the_road_begins_at_rest() {
    let seen =
        histories(&model(&["path={ kind = \"fixed\" }", "time.end=0.5", COARSE]), &["head.acceleration.resultant"]);
    let off = seen[0].iter().map(|a| (a / 9.80665 - 1.0).abs()).fold(0.0, f64::max);
    // Measured: 1.9e-4.
    assert_below("head off 1 g", off, 0.02);
}

/// Drivers and passengers who were braked in traffic: head 97 ± 47 mm, chest 55 ± 26 mm (`docs/roadside.md`, 1).
#[test]
fn braked_head_and_chest_go_as_far_as_those_of_volunteers_within_a_standard_deviation() {
    let ahead = |path: &str, tone: &str| {
        let seen =
            histories(&model(&[path, "time.end=1.0", COARSE, tone]), &["head.position.x", "upper_torso.position.x"]);
        [way(&seen[0])[1], way(&seen[1])[1]]
    };
    let gentle = BRAKING.replace("1 g", "0.6 g");
    // Measured: 0.089 and 0.039 as he is, 0.114 and 0.049 with half the strength; at 1 g 0.109 and 0.145.
    let [full, half] = ["muscles.*.tone=1", "muscles.*.tone=0.5"].map(|tone| ahead(&gentle, tone));
    for [head, chest] in [full, half] {
        assert_within("head ahead, m", head, [0.050, 0.144]);
        assert_within("chest ahead, m", chest, [0.029, 0.081]);
    }
    let hard = ["muscles.*.tone=1", "muscles.*.tone=0.5"].map(|tone| ahead(BRAKING, tone)[0]);
    assert!(full[0] < half[0] && full[0] < hard[0] && hard[0] < hard[1], "{full:?} {half:?} {hard:?}");
}
