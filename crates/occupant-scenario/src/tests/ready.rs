//! A copy of a prepared scenario is what a scenario read anew with the same changes is, and is refused for the same reasons.

use super::super::{Draft, Format};
use super::no_files;

const DRIVER: &str = include_str!("../../testdata/hand/three-point.toml");
const IN_A_CAR: &str = include_str!("../../../../scenarios/three-point.toml");
const CART: &str = include_str!("../../../../scenarios/cart-lap-torso.toml");

/// Plain data and warnings, or problems, as texts to the bit.
fn outcome(mut draft: Draft, changes: &[&str]) -> String {
    for change in changes {
        if let Err(problems) = draft.set(change) {
            return problems.to_string();
        }
    }
    match draft.load(&no_files) {
        Err(problems) => problems.to_string(),
        Ok(loaded) => {
            let explicit = loaded.explicit().to_toml().unwrap();
            let written = loaded.scenario.to_toml().unwrap();
            match loaded.build() {
                Err(problems) => format!("{written}{explicit}{problems}"),
                Ok((setup, warnings)) => format!("{written}{explicit}{setup:?}{warnings}"),
            }
        }
    }
}

#[test]
fn samples_of_a_prepared_scenario_are_those_of_the_text() {
    // values of plain sections; sections that others hang on; keys that come and go; what is wrong
    let changes: [&[&str]; 31] = [
        &[],
        &["time.end=\"1 ms\""],
        &["materials.seat.k1=3e4", "materials.seat.friction=0.3"],
        &["materials.foam.k1=\"13 kN/m\"", "path.speed=\"50 km/h\"", "posture.seat=\"driver\""],
        &["posture.head=7", "solids.floor.material=\"foam\""],
        &["belts.lap.slack=0.01", "belts.torso.anchors[0][2]=-20"],
        &["retractors.driver.limiter=null"],
        &["limiters.torsion_bar.force=[\"0 kN\", \"5 kN\", \"5 kN\", \"12 kN\"]"],
        &["materials.foam={ library = \"seat_cushion\" }"],
        &["body.segments.head.mass=\"5 kg\""],
        &["body={ sex = \"female\", stature = \"1.6 m\", mass = \"60 kg\" }"],
        &["materials.*.k1=\"13 kN/m\""],
        &["car.seats.driver.limiter=\"5 kN\""],
        &["car.seats.driver.limiter=\"5 kN\"", "joints.*.damping=2"],
        &["joints.*.damping=2"],
        &["joints.neck.damping=3", "materials.seat.k1=3e4"],
        &["joints.all.damping=\"5 N m s/rad\""],
        &["joints.left_knee.lower_stop.begin=5", "joints.shoulders.damping=4"],
        &["joints.left_knee.twist_damping=1"],
        &["joints.neck.damping=-1"],
        &["joints.nose.damping=1"],
        &["joints.preset=\"person\""],
        &["units=\"si\""],
        &["gravity=0"],
        &["contact.edge_force=\"centre\""],
        &["integrator.accuracy=\"survey\""],
        &["title=\"another\"", "notes=\"none\""],
        &["materials.foam.k1=\"13 kN\""],
        &["materials.foam.k3=1"],
        &["path=3"],
        &["belts.*.slack=0.001", "surfaces.*.material=\"nothing\""],
    ];
    for text in [DRIVER, IN_A_CAR, CART] {
        let plain = Draft::read(text, Format::Toml, "base.toml").unwrap();
        let prepared = plain.clone().prepared();
        for change in changes {
            assert_eq!(outcome(prepared.clone(), change), outcome(plain.clone(), change), "{change:?}");
            // prepared once more where it has been changed
            let twice = prepared.clone().prepared();
            assert_eq!(outcome(twice, change), outcome(plain.clone(), change), "{change:?}");
        }
    }
}

#[test]
fn a_scenario_that_is_wrong_stays_so() {
    let wrong = Draft::read("title = 3", Format::Toml, "base.toml").unwrap();
    assert_eq!(outcome(wrong.clone().prepared(), &[]), outcome(wrong.clone(), &[]));
    let mended = ["title=\"right\"", "time.end=1"];
    assert_eq!(outcome(wrong.clone().prepared(), &mended), outcome(wrong, &mended));
}
