//! Inputs of a reconstruction: the keys of a path that they vary, against closed forms, and their words.

use super::{SHORT, complaint, numbers, study};
use crate::{Change, Distribution, InputWord, Law, StudyText, Tolerances, Value};
use occupant_core::vehicle::{PathCursor, VehiclePath};
use occupant_scenario::{Draft, Format, Scenario};

const PULSE: &str =
    "kind = \"pulse\"\nshape = \"half_sine\"\nspeed = \"30 km/h\"\ndelta_v = \"30 km/h\"\nduration = \"100 ms\"";
/// A delta-v record of a recorder: 8 m/s forward lost, 2 m/s to the right gained.
const RECORD: &str =
    "kind = \"sensors\"\nspeed = 15\nafter = \"coast\"\ncolumns = [\"t[s]\", \"dvx[m/s]\", \"dvy[m/s]\"]
rows = [[0, 0, 0], [0.02, -1, 0.2], [0.05, -5, 1.5], [0.08, -7.5, 2], [0.1, -8, 2], [0.12, -8, 2]]";
/// A sled's accelerations.
const SLED: &str = "kind = \"table\"\nafter = \"coast\"\ncolumns = [\"t[s]\", \"ax[m/s^2]\"]
rows = [[0, 0], [0.03, -150], [0.07, -150], [0.1, 0]]";
const TABULATED: &str = "kind = \"pulse\"\nshape = \"tabulated\"\nspeed = 20\ncolumns = [\"t[s]\", \"a[m/s^2]\"]
rows = [[0, 0], [0.05, 200], [0.1, 0]]";

fn text(path: &str) -> String {
    assert!(SHORT.contains(PULSE));
    SHORT.replace(PULSE, path)
}

fn path(keys: &str) -> Result<VehiclePath, String> {
    let loaded = Scenario::from_text(&text(keys), Format::Toml, "s.toml", &super::no_files);
    loaded.and_then(|loaded| loaded.build()).map(|(setup, _)| setup.path).map_err(|e| e.to_string())
}

/// Velocity of a path at a time, ahead and to the right, m/s.
fn velocity(path: &VehiclePath, t_s: f64) -> [f64; 2] {
    let v = path.motion(t_s, t_s, &mut PathCursor::default()).velocity_m_s;
    // motions have Y to the left
    [v.x, -v.y]
}

fn close(found: [f64; 2], wanted: [f64; 2], within: f64) {
    assert!(found.iter().zip(&wanted).all(|(a, b)| (a - b).abs() < within), "{found:?}, not {wanted:?}");
}

#[test]
fn a_record_is_scaled_to_a_delta_v() {
    // the record's own is √(8² + 2²) m/s
    let scaled = path(&format!("{RECORD}\ndelta_v = \"10 m/s\"")).unwrap();
    let factor = 10.0 / 68_f64.sqrt();
    // measured: 2e-14
    close(velocity(&scaled, 0.12), [15.0 - 8.0 * factor, 2.0 * factor], 1e-6);
    let half = path(&format!("{RECORD}\ndelta_v = \"10 m/s\"\nstrength = 0.5")).unwrap();
    close(velocity(&half, 0.12), [15.0 - 4.0 * factor, factor], 1e-6);
    // the sled loses 150·(0.03/2 + 0.04 + 0.03/2) = 10.5 m/s
    close(velocity(&path(&format!("{SLED}\ndelta_v = 21")).unwrap(), 0.1), [-21.0, 0.0], 1e-6);
    // a triangle of 0.1 s and 200 m/s² takes 10 m/s away
    let table = path(&format!("{TABULATED}\ndelta_v = 15")).unwrap();
    close(velocity(&table, 0.15), [5.0, 0.0], 1e-9);
    close(velocity(&path(&format!("{TABULATED}\nstrength = 0.5")).unwrap(), 0.15), [15.0, 0.0], 1e-9);
    let moves = "[0.02, -1, 0.2], [0.05, -5, 1.5], [0.08, -7.5, 2], [0.1, -8, 2], [0.12, -8, 2]";
    assert!(RECORD.contains(moves));
    let found = path(&format!("{}\ndelta_v = 10", RECORD.replace(moves, "[0.2, 0, 0]"))).unwrap_err();
    assert!(found.contains("velocity does not change"), "{found}");
}

#[test]
fn a_change_of_velocity_is_turned_against_the_vehicle() {
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    // (−8, 2) turned clockwise seen from above, z down: x' = cos x − sin y, y' = sin x + cos y
    let turned = path(&format!("{RECORD}\nturn = 30")).unwrap();
    close(velocity(&turned, 0.12), [15.0 - 8.0 * cos - 2.0 * sin, -8.0 * sin + 2.0 * cos], 1e-9);
    close(velocity(&path(&format!("{SLED}\nturn = 30")).unwrap(), 0.1), [-10.5 * cos, -10.5 * sin], 1e-6);
    // a pulse turns the travel: the vehicle moves to the right before it, and loses that
    let pulse = path(&format!("{PULSE}\nturn = 30")).unwrap();
    close(velocity(&pulse, 0.0), [30.0 / 3.6 * cos, 30.0 / 3.6 * sin], 1e-12);
    // steady travel, also to the side, is not turned
    let steady = "kind = \"table\"\nafter = \"coast\"\ncolumns = [\"t[s]\", \"x[m]\", \"y[m]\"]\nrows = [[0, 0, 0], [0.1, 1, 0.5], [0.2, 2, 1]]";
    close(velocity(&path(&format!("{steady}\nturn = 30")).unwrap(), 0.15), [10.0, 5.0], 1e-9);
    // axes with y to the left and z up: the same turn
    let up = RECORD.replace("0.2]", "-0.2]").replace("1.5]", "-1.5]").replace(", 2]", ", -2]");
    let up = path(&format!("{up}\naxes = \"z_up\"\nturn = 30")).unwrap();
    close(velocity(&up, 0.12), velocity(&turned, 0.12), 1e-12);
}

#[test]
fn a_record_is_shifted_in_time() {
    for record in [RECORD, SLED] {
        let plain = path(record).unwrap();
        for shift_s in [0.007, -0.007] {
            let shifted = path(&format!("{record}\nshift = {shift_s}")).unwrap();
            for t_s in [0.0, 0.02, 0.05, 0.09] {
                // measured: 0.027, where a record now begins smoothly
                close(velocity(&shifted, t_s), velocity(&plain, (t_s - shift_s).max(0.0)), 0.05);
            }
        }
        // until its first time it keeps its speed
        close(velocity(&path(&format!("{record}\nshift = 0.007")).unwrap(), 0.003), velocity(&plain, 0.0), 2e-2);
    }
}

#[test]
fn without_the_keys_no_bit_changes() {
    for keys in [RECORD, SLED, TABULATED, PULSE] {
        let plain = path(keys).unwrap();
        assert_eq!(path(&format!("{keys}\nturn = 0")).unwrap(), plain);
        if !keys.contains("pulse") {
            assert_eq!(path(&format!("{keys}\nshift = 0")).unwrap(), plain);
        }
    }
}

fn words(base: &str, list: &str) -> Result<crate::Study, String> {
    let study = format!("base = \"b.toml\"\ndesign = {{ kind = \"monte_carlo\", samples = 50 }}\n{list}");
    let base = Draft::read(base, Format::Toml, "b.toml").unwrap();
    let text = StudyText::read(&study, Format::Toml, "study.toml").unwrap();
    text.bind(base, &[], &super::no_files).map_err(|e| e.to_string())
}

fn parameters(words_: &[&str]) -> String {
    words_.iter().map(|word| format!("[[parameters]]\ninput = \"{word}\"\n")).collect()
}

#[test]
fn one_word_gives_an_input_with_its_distribution() {
    let all = parameters(&["scale", "shift", "direction", "posture", "friction", "mass"]);
    for (keys, strength, clock) in [
        (PULSE, "path.delta_v", "path.start"),
        (RECORD, "path.strength", "path.shift"),
        (SLED, "path.strength", "path.shift"),
        (TABULATED, "path.strength", "path.start"),
    ] {
        let study = words(&text(keys), &all).unwrap_or_else(|e| panic!("{keys}: {e}"));
        let names: Vec<&str> = study.parameters.iter().map(|p| p.name.as_str()).collect();
        assert_eq!(names, ["scale", "shift", "direction", "posture", "friction", "mass"]);
        assert_eq!(study.parameters[0].targets[0].path, strength);
        assert_eq!(study.parameters[1].targets[0].path, clock);
        assert!(study.parameters.iter().all(|p| !p.source.is_empty()));
        let few = study.draft(17).unwrap().check();
        assert!(!few.has_errors(), "{keys}: {few}");
        let direction: Vec<f64> = (0..50).map(|i| numbers(&study, i)[2].to_degrees()).collect();
        assert!(direction.iter().all(|x| x.abs() < 7.5) && direction.iter().any(|x| x.abs() > 3.0), "{direction:?}");
    }
    let belt =
        words(&text(PULSE).replace("k1 = \"70 kN/m\"", "k1 = \"70 kN/m\"\nslack = 0.01"), &parameters(&["slack"]));
    assert_eq!(
        belt.unwrap().parameters[0].law,
        Law::Distribution(Distribution::Triangular { from: 0.0, mode: 0.0, to: 0.06 })
    );
    let delta_v = words(&text(&format!("{RECORD}\ndelta_v = 12")), &parameters(&["delta_v"])).unwrap();
    let Law::Distribution(Distribution::TruncatedNormal { mean, sd, .. }) = delta_v.parameters[0].law else { panic!() };
    assert!((mean - 12.0).abs() < 1e-12 && (sd - 0.6).abs() < 1e-12, "{mean} {sd}");
}

#[test]
fn an_input_that_the_scenario_lacks_is_refused_with_what_it_needs() {
    for (word, needs) in [
        ("seat", "a [car] with seats"),
        ("belt", "belts with `d_ring`"),
        ("slack", "belts with `slack`"),
        ("delta_v", "`path.delta_v`"),
    ] {
        let found = words(&text(RECORD), &parameters(&[word])).unwrap_err();
        assert!(found.contains(&format!("no input `{word}`")) && found.contains(needs), "{found}");
    }
    let found = complaint("[[parameters]]\ninput = \"speed\"");
    assert!(found.contains("speed"), "{found}");
    let both = StudyText::read(
        "base = \"b.toml\"\n[[parameters]]\ninput = \"mass\"\npath = \"gravity\"",
        Format::Toml,
        "s.toml",
    );
    assert!(both.is_err());
}

#[test]
fn members_of_an_ensemble_draw_inputs_from_their_distributions() {
    let study = study(
        "design.kind = \"full_factorial\"\n[[parameters]]\npath = \"path.speed\"\nlist = [\"30 km/h\"]\n[ensemble]\nmembers = 400\ninputs = [\"direction\", \"friction\"]",
    );
    let ensemble = study.ensemble.as_ref().unwrap();
    assert!(ensemble.perturbations.iter().all(|p| matches!(p.change, Change::Drawn(..))));
    assert_eq!(ensemble.perturbations.len(), 2);
    let turn = |member: u64| {
        let list = study.assignments(member);
        list.iter().find(|a| a.path == "path.turn").map(|a| match a.value {
            Value::Number(x) => x.to_degrees(),
            _ => panic!(),
        })
    };
    // member 0 is unchanged
    assert_eq!(turn(0), None);
    let values: Vec<f64> = (1..400).map(|member| turn(member).unwrap()).collect();
    let mean = values.iter().sum::<f64>() / 399.0;
    let sd = (values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / 398.0).sqrt();
    // 2.5° before it is cut off at three of them: 2.46°
    assert!(mean.abs() < 0.4 && (sd - 2.46).abs() < 0.25, "{mean} {sd}");

    let base = Draft::read(SHORT, Format::Toml, "s.toml").unwrap();
    let mut study = crate::Study::of_ensemble(base, "s.toml", 5, 1, &Tolerances::default());
    let before = study.ensemble.as_ref().unwrap().perturbations.len();
    assert_eq!(study.vary(&[InputWord::Direction]).unwrap()[0].name, "direction");
    assert_eq!(study.ensemble.as_ref().unwrap().perturbations.len(), before + 1);
    assert!(study.vary(&[InputWord::Seat]).unwrap_err().contains("[car]"));
}
