//! What a run tells: every vehicle and every surface has channels, and straight-line paths have accelerations.

use nalgebra::Vector3;
use occupant_core::model::Model;
use occupant_core::results::channel::{Series, channels};
use occupant_core::results::summary::{Summarizer, Summary};
use occupant_core::run::simulate::simulate;
use occupant_scenario::{Format, Scenario};
use occupant_tests::measure::assert_below;
use occupant_tests::rod::{Pin, Rod};
use occupant_tests::room::{FINE, setup};
use occupant_tests::strap::{FALLS, Strap, mass_text};

const TWO: &str = include_str!("../data/hand/two-vehicles.toml");
const LAP: &str = include_str!("../../scenarios/cart-lap.toml");
const SOLIDS: &str = include_str!("../../tests/data/hand/rear-seat-solids.toml");

fn model(text: &str) -> Model {
    let loaded = Scenario::from_text(text, Format::Toml, "test", &|name| Err(format!("no {name}")));
    loaded.and_then(|loaded| loaded.model()).unwrap_or_else(|problems| panic!("{problems}")).0
}

/// Every channel of a run.
fn told(model: &Model) -> Series {
    let mut series = Series::new(channels(model));
    simulate(model, &mut series).expect("a run");
    series
}

fn vector(series: &Series, name: &str, at: usize) -> Vector3<f64> {
    let component = |axis| series.of(&format!("{name}.{axis}")).unwrap_or_else(|| panic!("no channel {name}"))[at];
    Vector3::new(component("x"), component("y"), component("z"))
}

#[test]
fn every_vehicle_has_channels() {
    let series = told(&model(TWO));
    for at in [0, 30, 50, 179] {
        let t_s = series.time_s[at];
        // a haversine that takes 37 km/h in 0.1 s, along the axes of the car that comes towards the other
        let strength = 37.0 / 3.6 / 0.1;
        let a = if t_s < 0.1 { strength * (1.0 - (std::f64::consts::TAU * t_s / 0.1).cos()) } else { 0.0 };
        assert_below(
            "light",
            (vector(&series, "vehicle.light.acceleration", at) - Vector3::new(-a, 0.0, 0.0)).amax(),
            1e-6,
        );
    }
    let yaw = series.of("vehicle.light.yaw").expect("a yaw");
    assert_below("yaw", yaw[100] - std::f64::consts::PI, 1e-12);
    let first = vector(&series, "vehicle.light.position", 0);
    assert_below("place", (first - Vector3::new(2.2, 0.0, 0.0)).amax(), 1e-12);
    let last = [vector(&series, "vehicle.velocity", 180), vector(&series, "vehicle.light.velocity", 180)];
    assert_below("both go on together, each as its own axes have it", (last[0] + last[1]).amax(), 1e-9);
    assert!(series.of("vehicle.ground.yaw").is_none(), "the ground is no vehicle");
}

/// A neck driven at T1: what the chest does is an input, and there are no legs. A head that a mount lets go is measured.
#[test]
fn what_a_mount_moves_has_no_measures() {
    let measured = |text: &str| {
        let mut summarizer = Summarizer::new();
        simulate(&model(text), &mut summarizer).expect("a run");
        let summary = summarizer.summary(None).expect("an end");
        let names = summary.measures.iter().filter(|m| m.has_part()).map(|m| m.name);
        (names.collect::<Vec<_>>(), summary.accelerations)
    };
    let (neck, accelerations) = measured(include_str!("../../scenarios/neck-sled.toml"));
    assert!(neck.contains(&"hic15") && neck.contains(&"nij"), "{neck:?}");
    assert!(
        !neck
            .iter()
            .any(|name| ["chest_3ms", "chest_peak", "pelvis", "left_femur"].iter().any(|part| name.starts_with(part))),
        "{neck:?}"
    );
    assert!(accelerations.chest.peak_g.is_nan() && accelerations.head.peak_g > 10.0, "{accelerations:?}");
    let (head, accelerations) = measured(include_str!("../../scenarios/head-drop.toml"));
    assert!(head.contains(&"hic15") && accelerations.head.peak_g > 200.0, "{head:?}");
}

/// What surfaces and solids do to bodies is what spheres feel.
#[test]
fn forces_of_surfaces_add_up_to_those_on_the_spheres() {
    for text in [LAP, SOLIDS, TWO] {
        let series = told(&model(text));
        let sum = |of: &[&str], at: usize| -> Vector3<f64> {
            let is_of = |name: &&str| of.iter().any(|of| name.starts_with(of)) && name.ends_with(".force.x");
            let names = series.channels.iter().map(|channel| channel.name.as_str()).filter(is_of);
            names.map(|name| vector(&series, name.trim_end_matches(".x"), at)).sum()
        };
        let mut greatest = 0.0_f64;
        for at in (0..series.time_s.len()).step_by(7) {
            let (given, felt) = (sum(&["surface.", "solid."], at), sum(&["sphere."], at));
            greatest = greatest.max(felt.norm());
            assert_below("difference, N", (given - felt).amax(), 1e-8); // 4e-12
        }
        assert!(greatest > 1000.0, "something touched: {greatest} N");
        for channel in series.channels.iter().filter(|c| c.name.ends_with(".depth")) {
            let depths = series.of(&channel.name).expect("asked for");
            let force = format!("{}.force.resultant", channel.name.trim_end_matches(".depth"));
            let forces = series.of(&force).expect("a force");
            assert!(depths.iter().zip(forces).all(|(d, f)| *d >= 0.0 && (*d > 0.0 || *f == 0.0)), "{}", channel.name);
        }
    }
}

/// The stop of the cart as a table: its acceleration is that of the pulse, where it was 0 throughout.
#[test]
fn a_path_of_straight_lines_tells_its_acceleration() {
    let (before, path) = LAP.split_once("[path]").expect("a path");
    let (_, after) = path.split_once("\n\n").expect("more");
    let (v, length) = (20.0 * 0.44704, 0.08);
    let peak = v * std::f64::consts::PI / (2.0 * length);
    let place = |t: f64| {
        let (s, w) = (t.min(length), std::f64::consts::PI / length);
        v * s - peak / w * (s - (w * s).sin() / w)
    };
    let rows: Vec<String> = (0..=100).map(|i| f64::from(i) * 0.002).map(|t| format!("[{t}, {}]", place(t))).collect();
    let path = format!(
        "[path]\nkind = \"table\"\ninterpolation = \"linear\"\ncolumns = [\"t[s]\", \"x[m]\"]\nrows = [{}]\n\n",
        rows.join(", ")
    );
    let series = told(&model(&format!("{before}{path}{after}")));
    let meaning = &series.channels.iter().find(|c| c.name == "vehicle.acceleration.x").expect("a channel").meaning;
    assert!(meaning.contains("second differences"), "{meaning}");
    let told = series.of("vehicle.acceleration.x").expect("asked for");
    for (t_s, a) in series.time_s.iter().zip(told).filter(|(t_s, _)| (0.004..0.076).contains(*t_s)) {
        let expected = -peak * (std::f64::consts::PI * t_s / length).sin();
        assert_below("acceleration, of the peak", (a - expected) / peak, 0.005);
    }
}

/// The summary of a run with these outputs; the longest are longer than what happens.
fn summary_at(model: impl Fn(&str) -> Model, interval: &str) -> Summary {
    let mut summarizer = Summarizer::new();
    simulate(&model(&format!("output.interval={interval:?}")), &mut summarizer).expect("a run");
    summarizer.summary(None).expect("a summary")
}

const STEPS: [&str; 2] = [FINE, "integrator={ kind = \"rk4\", step = \"0.1 ms\" }"];

/// Webbing that tightens and goes slack several times.
#[test]
fn what_happens_to_belts_does_not_depend_on_the_outputs() {
    for integrator in STEPS {
        let case = Strap { is_fixed: true, speed_m_s: 2.0, gravity_m_s2: 100.0, end_s: 0.4, ..FALLS };
        let [often, seldom] =
            ["0.5 ms", "200 ms"].map(|at| summary_at(|interval| case.model(&[integrator, interval]), at).events);
        assert_eq!(often.len(), seldom.len(), "{often:?} {seldom:?}");
        assert!(often.len() > 4, "{often:?}");
        for (one, other) in often.iter().zip(&seldom) {
            assert_eq!((&one.name, &one.what), (&other.name, &other.what));
            // ends of steps of fixed length count from the output before
            assert!((one.time_s - other.time_s).abs() < 1e-12, "{one:?} {other:?}");
        }
        // they are told one after the other
        assert!(often.windows(2).all(|two| two[0].time_s < two[1].time_s && two[0].what != two[1].what), "{often:?}");
    }
}

/// A rod that goes 10° and more beyond a weak stop and comes back.
#[test]
fn a_joint_beyond_its_stop_is_marked_whatever_the_outputs() {
    let pin = Pin::Stop { begin_rad: 1.0, full_rad: 1.1, damping: 0.02 };
    let rod = Rod { mass_kg: 2.0, length_m: 0.4, pin, end_s: 1.2 };
    for integrator in STEPS {
        let [often, seldom] = ["1 ms", "1.2 s"].map(|at| {
            let caveats = summary_at(|interval| rod.model(&[integrator, interval]), at).caveats;
            caveats.into_iter().find(|caveat| caveat.name.ends_with("beyond_stop")).expect("a caveat").text
        });
        assert_eq!(often, seldom);
    }
}

/// A ball that goes through the axis of a soft bar and out beyond it.
#[test]
fn a_bar_that_is_passed_is_marked_whatever_the_outputs() {
    let text = mass_text([1.0, 0.0, 5.0, 0.0, 0.1])
        + "[materials]\nsoft = { k1 = 100, mu1 = 1, friction = 0 }\n[solids.bar]\nkind = \"capsule\"\nmaterial = \"soft\"\n\
           ends = [[-1, 0.001, 0.2], [1, 0.001, 0.2]]\nradius = 0.02\n";
    for integrator in STEPS {
        for at in ["1 ms", "0.1 s"] {
            let model = |interval: &str| Model::new(setup(&text, &[integrator, interval])).expect("a model");
            let caveats = summary_at(model, at).caveats;
            assert!(caveats.iter().any(|caveat| caveat.text.contains("went through bar")), "{at}: {caveats:?}");
        }
    }
}
