//! The example studies in `scenarios/studies/`: each reads, fits its base scenario, and its samples become models.

use std::fs;
use std::path::{Path, PathBuf};

use occupant_core::vehicle::VehiclePath;
use occupant_scenario::Draft;
use occupant_study::{Study, StudyText, Value};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios/studies")
}

/// A file beside a study.
fn beside(name: &str) -> Result<Vec<u8>, String> {
    fs::read(folder().join(name)).map_err(|e| e.to_string())
}

fn bind(name: &str) -> Study {
    let bytes = beside(name).unwrap();
    let text = StudyText::read_bytes(&bytes, None, name).unwrap_or_else(|d| panic!("{d}"));
    let base = Draft::read_bytes(&beside(text.base()).unwrap(), None, text.base());
    let base = base.unwrap_or_else(|d| panic!("{d}"));
    text.bind(base, &[], &beside).unwrap_or_else(|d| panic!("{d}"))
}

fn examples() -> Vec<String> {
    let entries = fs::read_dir(folder()).unwrap().map(|e| e.unwrap().file_name());
    let mut names: Vec<String> =
        entries.filter_map(|n| n.into_string().ok()).filter(|n| n.ends_with(".toml")).collect();
    names.sort();
    names
}

#[test]
fn every_example_study_fits_its_base_and_its_samples_become_models() {
    let names = examples();
    assert!(names.len() >= 5, "{names:?}");
    for name in names {
        let study = bind(&name);
        assert!(study.warnings.is_empty(), "{name}: {}", study.warnings);
        let n = study.len();
        // the seats are what a user would run as they are: minutes
        let most = if name == "rear.toml" { 4000 } else { 200 };
        assert!((2..=most).contains(&n), "{name} has {n} runs, too many for an example");
        for index in [0, 1, n / 2, n - 1] {
            let draft = study.draft(index).unwrap_or_else(|d| panic!("{name} {index}: {d}"));
            let loaded = draft.load(&|file| Err(format!("no file {file}")));
            let loaded = loaded.unwrap_or_else(|d| panic!("{name} {index}: {d}"));
            loaded.model().unwrap_or_else(|d| panic!("{name} {index}: {d}"));
        }
    }
}

/// What a study draws is what the runs have: the sample's value stands in the plain data of its run.
#[test]
fn the_values_of_a_sample_arrive_in_its_run() {
    let study = bind("belt-slack-anchor.toml");
    for index in 0..study.len() {
        let loaded = study.draft(index).unwrap().load(&beside).unwrap();
        let (setup, _) = loaded.build().unwrap();
        let torso = setup.belts.iter().find(|b| b.name == "torso").unwrap();
        let sample = study.sample(index);
        assert_eq!(sample[2].value, Value::Number(torso.anchors_m[0].z));
        let slack = Value::Number(match torso.rest {
            occupant_core::forces::belt::RestLength::Slack { slack_m } => slack_m,
            ref other => panic!("{other:?}"),
        });
        assert_eq!(sample[1].value, slack);
    }
}

/// Every pulse of the study of shapes takes away the same speed; only the square one of 46 ms has 20 g.
#[test]
fn the_pulses_of_the_study_of_shapes_have_one_change_of_speed() {
    let study = bind("pulse-shape.toml");
    let speed_m_s = 20.0 * 0.447_04;
    for index in 0..study.len() {
        let loaded = study.draft(index).unwrap().load(&beside).unwrap();
        let (setup, _) = loaded.build().unwrap();
        let VehiclePath::Pulse(pulse) = &setup.path else {
            panic!("{:?}", setup.path);
        };
        assert!((pulse.pulse_delta_v_m_s() / speed_m_s - 1.0).abs() < 1e-12, "{index}");
        let duration = study.sample(index)[1].value.clone();
        let [start_s, end_s] = <[f64; 2]>::from(pulse.pulse_span_s());
        assert!(matches!(duration, Value::Number(s) if (s - (end_s - start_s)).abs() < 1e-15));
        // mean deceleration Δv/T times the shape's peak over its mean: 1, π/2 or 2
        let mean = speed_m_s / (end_s - start_s);
        let shape = match &study.sample(index)[0].value {
            Value::Text(shape) => shape.clone(),
            other => panic!("{other:?}"),
        };
        let peak_over_mean = match shape.as_str() {
            "square" => 1.0,
            "half_sine" => std::f64::consts::FRAC_PI_2,
            _ => 2.0,
        };
        let peak = pulse.peak_deceleration_m_s2();
        assert!((peak / (mean * peak_over_mean) - 1.0).abs() < 1e-12, "{shape}: {peak}");
    }
}
