//! Measures against those that laboratories computed from their own tests: records of NHTSA's vehicle database.
//!
//! The curves are not part of this repository. They are looked for in the folder that `OCCUPANT_CRASH_TESTS` names, else in
//! `../shared/reference/tests`; where there is none, the tests say so and are left out.

use std::path::Path;

use crash_measures::correlation::iso18571;
use crash_measures::measure::{HicWindow, hic, largest_magnitude, minimum, three_ms_cumulative};
use crash_measures::signal::STANDARD_GRAVITY_MPS2;
use occupant_core::model::Model;
use occupant_core::results::channel::{Series, matching};
use occupant_core::run::simulate::simulate;
use occupant_tests::measure::{assert_below, assert_within};
use occupant_tests::room::setup;

/// Columns of a table of a test, by name, at the interval of its first column.
pub(crate) struct Curves {
    pub(crate) names: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Curves {
    /// The table of this name. Tests that ask for one are ignored where `build.rs` has found no folder of crash tests.
    pub(crate) fn open(name: &str) -> Curves {
        let text = Curves::text(name);
        let mut lines = text.lines();
        let names = lines.next().expect("a heading").split(',').map(str::to_owned).collect();
        let rows = lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap_or(f64::NAN)).collect()).collect();
        Curves { names, rows }
    }

    fn text(name: &str) -> String {
        let Some(folder) = option_env!("CRASH_TESTS") else { panic!("no folder of crash tests: see `build.rs`") };
        let file = Path::new(folder).join(name);
        std::fs::read_to_string(&file).unwrap_or_else(|e| panic!("{}: {e}", file.display()))
    }

    /// Times and values of a mean curve, by time, from a table of curves that has two columns for each and three lines of heading.
    fn pair(name: &str, curve: &str) -> (Vec<f64>, Vec<f64>) {
        let text = Curves::text(name);
        let lines: Vec<Vec<&str>> = text.lines().map(|line| line.split(';').map(str::trim).collect()).collect();
        let is_of = |i: &usize| lines[0][*i] == curve && lines[1][*i] == "avg";
        let at = (0..lines[0].len()).find(is_of).unwrap_or_else(|| panic!("no curve {curve}"));
        let number = |line: &[&str], i: usize| line.get(i).and_then(|cell| cell.parse::<f64>().ok());
        let rows = lines[3..].iter().filter_map(|line| number(line, at).zip(number(line, at + 1)));
        let mut rows: Vec<(f64, f64)> = rows.collect();
        rows.sort_by(|a, b| a.0.total_cmp(&b.0));
        rows.into_iter().unzip()
    }

    pub(crate) fn column(&self, name: &str) -> Vec<f64> {
        let at = self.names.iter().position(|n| n.starts_with(name)).unwrap_or_else(|| panic!("no column {name}"));
        self.rows.iter().map(|row| row[at]).collect()
    }

    /// Magnitude of three columns in g, m/s².
    pub(crate) fn resultant(&self, names: [&str; 3]) -> Vec<f64> {
        let [x, y, z] = names.map(|name| self.column(name));
        let of = |((x, y), z): ((&f64, &f64), &f64)| STANDARD_GRAVITY_MPS2 * (x * x + y * y + z * z).sqrt();
        x.iter().zip(&y).zip(&z).map(of).collect()
    }

    fn interval_s(&self) -> f64 {
        let times = self.column("t_ms");
        1e-3 * (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64
    }
}

/// Value, t₁ and t₂ (ms) that a record prints, against ours: to all printed digits, the times to a sample.
fn same_hic(table: &str, occupant: &str, window: HicWindow, [value, from_ms, to_ms]: [f64; 3]) {
    let curves = Curves::open(table);
    let names = ["x", "y", "z"].map(|axis| format!("{occupant}_{axis}_g"));
    let resultant = curves.resultant(names.each_ref().map(String::as_str));
    let dt_s = curves.interval_s();
    let ours = hic(&resultant, dt_s, window).unwrap();
    assert_eq!(ours.value.round(), value, "{table} {occupant}");
    for (found, printed) in [(ours.start_s, from_ms), (ours.end_s, to_ms)] {
        assert!((1e3 * found - printed).abs() <= 1e3 * dt_s + 1e-9, "{table} {occupant}: {found} {printed}");
    }
}

#[test]
#[cfg_attr(not(crash_tests), ignore = "OCCUPANT_CRASH_TESTS names no folder of crash tests")]
fn the_head_injury_criterion_is_the_laboratorys_own() {
    same_hic("nhtsa-7292/head-raw-driver.csv", "driver", HicWindow::Ms36, [1114.0, 84.72, 106.72]);
    same_hic("nhtsa-10146/head-raw.csv", "driver", HicWindow::Ms15, [140.0, 77.7, 92.7]);
    same_hic("nhtsa-10146/head-raw.csv", "front-passenger", HicWindow::Ms15, [335.0, 67.8, 82.8]);
}

/// Within half a per cent of what a record prints.
fn near(what: &str, ours: f64, printed: f64) {
    assert!((ours / printed - 1.0).abs() < 5e-3, "{what}: {ours} {printed}");
}

#[test]
#[cfg_attr(not(crash_tests), ignore = "OCCUPANT_CRASH_TESTS names no folder of crash tests")]
fn peaks_of_femurs_and_belts_are_the_laboratorys_own() {
    for (table, left_n, right_n) in [
        ("nhtsa-7292/driver.csv", -1789.0, -5790.0),
        ("nhtsa-10146/driver.csv", -1923.0, -2345.0),
        ("nhtsa-10146/front-passenger.csv", -1182.0, -1378.0),
    ] {
        let curves = Curves::open(table);
        for (column, printed_n) in [("FMRL_ZL_LC_N", left_n), ("FMRR_ZL_LC_N", right_n)] {
            let ours = minimum(&curves.column(column), curves.interval_s()).unwrap();
            near(&format!("{table} {column}"), ours.value, printed_n);
        }
    }
    let curves = Curves::open("nhtsa-7292/driver.csv");
    for (column, printed_n) in [("LPBO", 6937.0), ("SHBT", 4845.0)] {
        let ours = largest_magnitude(&curves.column(column), curves.interval_s()).unwrap();
        near(column, ours.value.abs(), printed_n);
    }
}

#[test]
#[cfg_attr(not(crash_tests), ignore = "OCCUPANT_CRASH_TESTS names no folder of crash tests")]
fn three_milliseconds_of_the_chest_are_the_laboratorys_own() {
    let chest = ["CHST_XL_AC_g", "CHST_YL_AC_g", "CHST_ZL_AC_g"];
    let ours_g = |table| {
        let curves = Curves::open(table);
        let held = three_ms_cumulative(&curves.resultant(chest), curves.interval_s()).unwrap();
        held.level_mps2 / STANDARD_GRAVITY_MPS2
    };
    near("nhtsa-7292 chest, g", ours_g("nhtsa-7292/driver.csv"), 59.3);
    // this record holds whole numbers of g
    for table in ["nhtsa-10146/driver.csv", "nhtsa-10146/front-passenger.csv"] {
        let chest_g = ours_g(table);
        assert_eq!(chest_g.round(), 41.0, "{table}: {chest_g}");
    }
}

/// Straight lines through a curve, at 10 kHz from 0 to 125 ms; displacements (`is_way`) from where they begin.
fn sampled(time_s: &[f64], values: &[f64], is_way: bool) -> Vec<f64> {
    sampled_to(125, time_s, values, is_way)
}

/// The same to another end.
pub(crate) fn sampled_to(last_ms: i32, time_s: &[f64], values: &[f64], is_way: bool) -> Vec<f64> {
    let zero = if is_way { values[0] } else { 0.0 };
    let at = |t: f64| {
        let i = time_s.partition_point(|own| *own <= t).clamp(1, time_s.len() - 1);
        let share = (t - time_s[i - 1]) / (time_s[i] - time_s[i - 1]);
        values[i - 1] + share * (values[i] - values[i - 1]) - zero
    };
    (0..=10 * last_ms).map(|i| at(1e-4 * f64::from(i))).collect()
}

/// The pulse of the test as the path of a scenario.
fn sled_pulse() -> String {
    let pulse = Curves::open("gs1-shaw2009/sled-pulse.csv");
    let rows = pulse.rows.iter().filter(|row| (0.0..=160.0).contains(&row[0]));
    let sense = if pulse.column("sled_ax_g").iter().sum::<f64>() < 0.0 { -1.0 } else { 1.0 };
    let rows: Vec<String> = rows.map(|row| format!("[{}, {}]", row[0], sense * row[3])).collect();
    format!(
        "path={{ kind = \"pulse\", shape = \"tabulated\", speed = 11.82, columns = [\"t[ms]\", \"a[g]\"], rows = [{}] }}",
        rows.join(", ")
    )
}

/// The run of `scenarios/sled-person.toml` in the test's own pulse, and the error of its energy balance.
fn person_on_a_sled() -> (Series, f64) {
    let path = sled_pulse();
    let model = Model::new(setup(include_str!("../../scenarios/sled-person.toml"), &[&path])).unwrap();
    let mut series = Series::new(matching(&model, "*"));
    let outcome = simulate(&model, &mut series).unwrap();
    (series, outcome.energy.balance_error)
}

/// Five deflections of the chest, and the outer lap belt, against the corridors of eight men. Springs of the chest: sternum fitted to hub
/// tests alone, ribs to means of these men with another load path. Positions of the belt on the ribs, the lean of the trunk and the
/// stiffnesses of the rig were chosen with these corridors in view.
#[test]
#[cfg_attr(not(crash_tests), ignore = "OCCUPANT_CRASH_TESTS names no folder of crash tests")]
fn chest_and_lap_belt_of_a_person_on_a_sled_are_those_of_the_men() {
    let (series, balance) = person_on_a_sled();
    assert_below("energy balance", balance, 1e-5);
    let now = series.time_s.partition_point(|t| *t < 0.1);
    let corridors = Curves::open("gs1-shaw2009-chest/chest-corridors.csv");
    for (point, column) in [
        ("", "Sternum"),
        ("upper_left.", "Upper_left"),
        ("upper_right.", "Upper_right"),
        ("lower_left.", "Lower_left"),
        ("lower_right.", "Lower_right"),
    ] {
        // inward is negative there
        let ends = ["lo", "hi"].map(|end| -1e-3 * corridors.column(&format!("{column}_x_{end}_mm"))[100]);
        let own_m = series.of(&format!("chest.{point}deflection")).unwrap()[now];
        assert_within(&format!("{column} at 100 ms, m"), own_m, [ends[0].min(ends[1]), ends[0].max(ends[1])]);
    }
    let lap_n = series.of("strap.lap.1_3.force").unwrap();
    let most_n = lap_n.iter().fold(0.0, |most: f64, force| most.max(*force));
    assert_within("peak of the lap belt, N", most_n, [1600.0, 2200.0]);
    assert_below("lap belt at the start, N", lap_n[0], 1.0);
}

/// `scenarios/sled-person.toml` in the test's own pulse against the means of eight men (Shaw 2009): ISO/TS 18571 of 26 channels. The
/// bounds are what the presets reach, rounded down; docs/validation.md tells them all.
#[test]
#[cfg_attr(not(crash_tests), ignore = "OCCUPANT_CRASH_TESTS names no folder of crash tests")]
fn a_person_on_a_sled_moves_as_the_dead_did() {
    let (series, _) = person_on_a_sled();
    let [ways, belts] =
        ["kinematics", "shoulder-belt-8-tests"].map(|name| Curves::open(&format!("gs1-shaw2009/{name}.csv")));
    let rated = |channel: &str, time_ms: &[f64], measured: &[f64], is_way: bool| {
        let time_s: Vec<f64> = time_ms.iter().map(|t| 1e-3 * t).collect();
        let ours = sampled(&series.time_s, series.of(channel).unwrap(), is_way);
        iso18571(&sampled(&time_s, measured, is_way), &ours, 1e-4).unwrap().overall
    };
    let belt = |which: &str, channel: &str| {
        let mean = |row: &Vec<f64>| {
            let own = belts.names.iter().zip(row).filter(|(name, _)| name.starts_with(which));
            own.map(|(_, kn)| 1e3 * kn).sum::<f64>() / 8.0
        };
        let mean: Vec<f64> = belts.rows.iter().map(mean).collect();
        rated(channel, &belts.column("t_ms"), &mean, false)
    };
    let markers = ["head", "t1", "t8", "l2", "l4", "pelvis", "left_acromion", "right_acromion"];
    let columns = ["h", "t1", "t8", "l2", "l4", "p", "la", "ra"];
    let way = |which: usize, axis: &str| {
        let (time_ms, column) = (ways.column("time"), format!("{}{}m", columns[which], axis.to_uppercase()));
        let measured: Vec<f64> = ways.column(&column).iter().map(|mm| 1e-3 * mm).collect();
        rated(&format!("marker.{}.displacement.{axis}", markers[which]), &time_ms, &measured, true)
    };
    let found = [way(0, "x"), way(0, "z"), way(1, "x"), way(2, "x"), way(6, "x"), way(7, "x")];
    for (rating, least) in found.iter().zip([0.95, 0.82, 0.94, 0.93, 0.89, 0.86]) {
        assert!(*rating > least, "{found:.3?}");
    }
    let [upper, lower] =
        [belt("upper", "strap.torso.d_ring_shoulder.force"), belt("lower", "strap.torso.shoulder_buckle.force")];
    assert!(upper > 0.85 && lower > 0.81, "{upper:.3} {lower:.3}");
    // peaks within the range of the tests
    for (channel, low, high) in [
        ("marker.head.displacement.x", 0.320, 0.452),
        ("marker.t1.displacement.x", 0.228, 0.279),
        ("strap.torso.d_ring_shoulder.force", 5600.0, 8200.0),
    ] {
        let until = series.time_s.partition_point(|t| *t <= 0.125);
        let most = series.of(channel).unwrap()[..until].iter().fold(0.0, |most: f64, x| most.max(*x));
        assert!((low..=high).contains(&most), "{channel}: {most}");
    }
    let all: Vec<f64> = (0..8).flat_map(|which| ["x", "y", "z"].map(|axis| way(which, axis))).collect();
    let mean = all.iter().sum::<f64>() / 24.0;
    // the finite-element model of the same test has 0.65
    assert!(mean > 0.70, "{mean:.3} {all:.2?}");
}

/// `scenarios/near-side-wall.toml`, with the changes that its first lines give for 8 m/s.
fn person_at_a_wall(is_fast: bool) -> (Series, f64) {
    let text = include_str!("../../scenarios/near-side-wall.toml");
    let changes = text.lines().filter_map(|line| line.strip_prefix("#   --set ")).map(|set| set.replace('"', ""));
    let changes: Vec<String> = if is_fast { changes.collect() } else { Vec::new() };
    assert_eq!(changes.len(), if is_fast { 3 } else { 0 });
    let model = Model::new(setup(text, &changes.iter().map(String::as_str).collect::<Vec<_>>())).unwrap();
    let mut series = Series::new(matching(&model, "solid.*"));
    let outcome = simulate(&model, &mut series).unwrap();
    (series, outcome.energy.balance_error)
}

/// Plates on the side of a person against the mean peaks of seven men, N, and their times (Miller 2013). The pads were fitted to these
/// curves, the body was not: ribs and abdomen are those fitted from the front, the pelvis was fitted to a hub.
#[test]
fn plates_strike_the_side_of_a_person_as_hard_as_men() {
    for (is_fast, plates) in [
        // the ribs are too soft for a broad plate at 3 m/s
        (
            false,
            [("thorax", 1287.0, 0.6), ("abdomen", 1525.0, 0.75), ("pelvis", 2234.0, 0.75), ("thigh", 1612.0, 0.75)],
        ),
        (
            true,
            [("thorax", 3059.0, 0.75), ("abdomen", 2738.0, 0.75), ("pelvis", 3659.0, 0.75), ("thigh", 2568.0, 0.75)],
        ),
    ] {
        let (series, balance) = person_at_a_wall(is_fast);
        assert_below("energy balance", balance, 1e-4);
        for (plate, mean_n, least) in plates {
            let force_n = series.of(&format!("solid.{plate}.force.y")).unwrap();
            let peak_n = force_n.iter().fold(0.0, |most: f64, force| most.max(force.abs()));
            assert_within(&format!("{plate}, peak over the mean of the men"), peak_n / mean_n, [least, 1.25]);
        }
    }
}

/// ISO/TS 18571 of four plates against the means of the men: at 3 m/s over 80 ms, at 8 m/s over 60 ms.
#[test]
#[cfg_attr(not(crash_tests), ignore = "OCCUPANT_CRASH_TESTS names no folder of crash tests")]
fn plates_strike_the_side_of_a_person_as_they_struck_men() {
    for (is_fast, last_ms, least) in [(false, 80, 0.69), (true, 60, 0.67)] {
        let (series, _) = person_at_a_wall(is_fast);
        let file = format!("hub-and-wall/miller2013-{}ms.csv", if is_fast { 8 } else { 3 });
        let rated = |(plate, column): (&str, &str)| {
            let (time_s, force_n) = Curves::pair(&file, column);
            let ours: Vec<f64> =
                series.of(&format!("solid.{plate}.force.y")).unwrap().iter().map(|f| f.abs()).collect();
            let [theirs, ours] =
                [(&time_s, &force_n), (&series.time_s, &ours)].map(|(t, f)| sampled_to(last_ms, t, f, false));
            iso18571(&theirs, &ours, 1e-4).unwrap().overall
        };
        let all = [("thorax", "TX"), ("abdomen", "AB"), ("pelvis", "PLComb"), ("thigh", "FM")].map(rated);
        assert!(all.iter().sum::<f64>() / 4.0 > least, "{all:.3?}");
    }
}

/// The isolated necks of the dead, driven at T1 from behind at 2.6 m/s (Stemper 2004): angle of the head against T1 and retraction of
/// its centre, rated against the middle of the corridors. Both were in view when the neck of `person` was fitted.
#[test]
#[cfg_attr(not(crash_tests), ignore = "OCCUPANT_CRASH_TESTS names no folder of crash tests")]
fn a_neck_of_a_person_moves_as_those_of_the_dead_struck_from_behind() {
    let pulse = Curves::open("stemper2004-rear/t1-pulse.csv");
    let rows: Vec<String> = pulse.rows.iter().map(|row| format!("[{}, {}, 0]", 1e-3 * row[0], row[1])).collect();
    let set = [
        format!("path.rows=[{}]", rows.join(", ")),
        "path.speed=\"1 m/s\"".to_owned(),
        "time.end=0.126".to_owned(),
        "output.interval=\"1 ms\"".to_owned(),
        "mount.pitch=25".to_owned(),
        "mount.posture={ neck = 8, head = 0 }".to_owned(),
    ];
    let set: Vec<&str> = set.iter().map(String::as_str).collect();
    let model = Model::new(setup(include_str!("../../scenarios/neck-sled.toml"), &set)).unwrap();
    let mut series = Series::new(matching(&model, "*"));
    simulate(&model, &mut series).unwrap();
    let corridors = Curves::open("stemper2004-rear/corridors.csv");
    let middle = |names: [&str; 2]| -> Vec<f64> {
        let [low, high] = names.map(|name| corridors.column(name));
        low.iter().zip(&high).map(|(low, high)| 0.5 * (low + high)).collect()
    };
    let time_s: Vec<f64> = corridors.column("t_ms").iter().map(|t| 1e-3 * t).collect();
    let rated = |channel: &str, unit: f64, measured: &[f64]| {
        let from: Vec<f64> = series.of(channel).unwrap().to_vec();
        let ours: Vec<f64> = from.iter().map(|x| unit * (x - from[0])).collect();
        iso18571(&sampled(&time_s, measured, false), &sampled(&series.time_s, &ours, false), 1e-4).unwrap().overall
    };
    let angle =
        rated("head.rotation.y", 180.0 / std::f64::consts::PI, &middle(["Head_T1_angle_lo", "Head_T1_angle_hi"]));
    let retraction = rated("head.level_position.x", 1e3, &middle(["retraction_lo", "retraction_hi"]));
    assert!(angle > 0.85 && retraction > 0.95, "{angle:.3} {retraction:.3}");
}
