//! Figures that cannot be trusted, of scenarios that come with the program.

use super::no_files;
use crate::{Draft, Format};
use occupant_core::results::summary::{Summarizer, Summary};
use occupant_core::run::simulate::simulate;

/// The caveats of a scenario of this repository with changes.
fn caveats_of(scenario: &str, changes: &[(&str, &str)]) -> (Summary, Vec<String>) {
    let mut draft = Draft::read(scenario, Format::Toml, "shipped").unwrap();
    for (path, value) in changes {
        draft.set_value(path, value).unwrap_or_else(|problems| panic!("{problems}"));
    }
    let model =
        draft.load(&no_files).and_then(|loaded| loaded.model()).unwrap_or_else(|problems| panic!("{problems}")).0;
    let mut summarizer = Summarizer::new();
    simulate(&model, &mut summarizer).unwrap();
    let summary = summarizer.summary(None).unwrap();
    let names = summary.caveats.iter().map(|caveat| caveat.name.clone()).collect();
    (summary, names)
}

const BELTED: &str = include_str!("../../testdata/carts/cart-lap-torso.toml");

#[test]
fn a_neck_beyond_its_stop_takes_the_neck_figures_with_it_and_no_others() {
    let (summary, names) = caveats_of(BELTED, &[]);
    let neck = summary.caveats.iter().find(|caveat| caveat.name == "neck_beyond_stop").unwrap();
    assert!(neck.text.starts_with("neck beyond its stop: 119° at 131.7 ms"), "{}", neck.text);
    assert!(["nij", "neck_tension", "neck_flexion"].iter().all(|figure| neck.touches(figure)));
    assert!(!["hic15", "head.peak", "chest.peak", "left_femur"].iter().any(|figure| neck.touches(figure)));
    // a pelvis 181 mm deep in its cushion, shins behind the panel
    for name in ["pelvis_too_deep", "left_shin_passed", "right_lower_leg_cut"] {
        assert!(names.iter().any(|found| found == name), "{name} is not among {names:?}");
    }
    let json = serde_json::to_value(&summary).unwrap();
    assert_eq!(json["caveats"][0]["figures"], serde_json::json!(["nij", "neck_*"]));
    // stops that reach further
    let far = "{ begin = \"45 deg\", full = \"170 deg\", damping = \"120 in lbf s/rad\" }";
    let (_, names) = caveats_of(BELTED, &[("joints.neck.stop", far)]);
    assert!(!names.iter().any(|name| name == "neck_beyond_stop"), "{names:?}");
}

#[test]
fn a_head_that_flies_through_a_seat_takes_its_figures_with_it() {
    let seat = include_str!("../../testdata/hand/rear-seat.toml");
    let lap = &seat[seat.find("[belts.lap]").unwrap()..seat.find("[materials]").unwrap()];
    let (summary, _) = caveats_of(&seat.replace(lap, ""), &[]);
    let head = summary.caveats.iter().find(|caveat| caveat.name == "head_passed").unwrap();
    assert!(head.text.contains("through front_seat") && head.text.contains("without force"), "{}", head.text);
    assert!(["hic15", "head.peak", "head_3ms_cumulative", "contacts.head.peak"].iter().all(|f| head.touches(f)));
    assert!(!head.touches("chest.peak") && !head.touches("left_femur"));
    let (_, names) = caveats_of(seat, &[]);
    assert!(!names.iter().any(|name| name == "head_passed"), "{names:?}");
}

/// A figure belongs to the steps: how often a run is recorded makes no difference to it.
#[test]
fn figures_do_not_know_how_often_a_run_is_recorded() {
    let unbelted = include_str!("../../testdata/carts/cart-unbelted.toml");
    for scenario in [BELTED, unbelted] {
        let of = |interval: &str| {
            let (summary, names) = caveats_of(scenario, &[("output.interval", interval)]);
            assert!(names.iter().all(|name| !name.ends_with("too_coarse")), "{names:?}");
            summary
        };
        let fine = of("0.1 ms");
        for coarse in ["1 ms", "2 ms", "5 ms"].map(of) {
            for (a, b) in fine.measures.iter().zip(&coarse.measures) {
                let (Some(x), Some(y)) = (a.value, b.value) else { continue };
                // steps of a fixed length end at outputs, to the rounding; measured: 9e-14
                assert!((x - y).abs() <= 1e-10 * x.abs().max(1e-6), "{}: {x} {y}", a.name);
            }
            for (a, b) in fine.sphere_forces.iter().zip(&coarse.sphere_forces) {
                // measured: 2e-13
                assert!((a.force_n / b.force_n - 1.0).abs() < 1e-10, "{a:?} {b:?}");
            }
        }
    }
}

#[test]
fn readings_too_coarse_say_so() {
    let steps = [("integrator.step", "2 ms"), ("output.interval", "2 ms")];
    let (summary, _) = caveats_of(include_str!("../../testdata/carts/cart-unbelted.toml"), &steps);
    let coarse = summary.caveats.into_iter().find(|caveat| caveat.name == "readings_too_coarse").unwrap();
    assert!(coarse.touches("nij") && coarse.text.contains("readings every 2 ms"), "{coarse:?}");
}

#[test]
fn an_absurd_vehicle_does_not_hide_the_error_of_the_energy_balance() {
    // 1000 km/s: the kinetic energy in the vehicle would hide any error
    let away = ("path", "{ kind = \"pulse\", shape = \"half_sine\", speed = 0, delta_v = -1e6, duration = \"0.1 s\" }");
    let (summary, names) = caveats_of(BELTED, &[away, ("time.end", "5 ms"), ("output.interval", "5 ms")]);
    let energy = serde_json::to_value(&summary).unwrap()["energy"].clone();
    assert_eq!(
        (&energy["reference"], &energy["balance"]),
        (&"largest work of gravity and force elements".into(), &"lost".into())
    );
    let [error, reference_j, kinetic_j] =
        ["balance_error", "reference_j", "greatest_kinetic_j"].map(|key| energy[key].as_f64().unwrap());
    assert!(error > 0.0 && reference_j < 0.01 * kinetic_j, "{energy}");
    assert!(names[0] == "energy_balance_lost" && summary.caveats[0].touches("hic15"), "{names:?}");
    assert!(
        summary.caveats[0].text.contains("is impossible for an occupant: the results mean nothing"),
        "{:?}",
        summary.caveats[0]
    );
}
