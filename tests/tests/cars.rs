//! Dummies in two cars that no preset was fitted to: `scenarios/studies/blind-cars` against NHTSA's crash tests 7292 and 10146, where the curves are.
//! The bounds say what came of scenarios that were made before a curve of a dummy was looked at, hits and misses alike; docs/validation.md
//! tells why.

use crash_measures::correlation::iso18571;
use crash_measures::measure::{HicWindow, hic, largest_magnitude};
use crash_measures::signal::STANDARD_GRAVITY_MPS2;
use occupant_core::model::Model;
use occupant_core::results::channel::{Series, matching};
use occupant_core::run::simulate::simulate;
use occupant_tests::measure::assert_within;
use occupant_tests::room::setup;

use crate::laboratory::{Curves, sampled_to};

/// A car's motion from its two sides, as scenarios/studies/blind-cars/make_table.py makes it: accelerations midway between them, the yaw
/// rate that their difference integrates to.
fn motion(table: &str, speed: &str, [left, right]: [&str; 2]) -> String {
    let car = Curves::open(table);
    let middle = |axis: &str| {
        let [l, r] = [left, right].map(|side| format!("{side}_{axis}G_AC"));
        let has = car.names.iter().any(|name| name.starts_with(&l));
        has.then(|| car.column(&l).iter().zip(car.column(&r)).map(|(l, r)| (l + r) / 2.0).collect::<Vec<f64>>())
    };
    let time_ms = car.column("t_ms");
    let (ahead, across) = (
        middle("X").expect("sides with an accelerometer ahead"),
        middle("Y").unwrap_or_else(|| vec![0.0; time_ms.len()]),
    );
    let sides = car.column(left).into_iter().zip(car.column(right));
    let turning: Vec<f64> = sides.map(|(l, r)| (l - r) * STANDARD_GRAVITY_MPS2 / 1.45).collect();
    let rests = time_ms.partition_point(|t| *t < 0.0);
    let offset = turning[..rests].iter().sum::<f64>() / rests as f64;
    let (mut rate, mut rows) = (0.0, Vec::new());
    for (i, t) in time_ms.iter().enumerate() {
        if *t > 0.0 {
            rate += 1e-3 * (t - time_ms[i - 1]) * ((turning[i] + turning[i - 1]) / 2.0 - offset);
        }
        rows.push(format!("[{t}, {}, {}, {rate}]", ahead[i], across[i]));
    }
    let keys = r#"kind = "sensors", gravity = "removed", baseline = "10 ms", start = "0 ms", columns = ["t[ms]", "ax[g]", "ay[g]", "wz[rad/s]"]"#;
    format!("path={{ {keys}, speed = \"{speed}\", rows = [{}] }}", rows.join(", "))
}

/// A dummy in a car that nothing was fitted to, and what it felt.
struct Dummy {
    series: Series,
    name: &'static str,
    test: Curves,
}

impl Dummy {
    fn drive(scenario: &str, set: &[&str], name: &'static str, test: Curves) -> Dummy {
        let model = Model::new(setup(scenario, set)).unwrap();
        let mut series = Series::new(matching(&model, "*"));
        simulate(&model, &mut series).unwrap();
        Dummy { series, name, test }
    }

    /// ISO/TS 18571 over 0 to 150 ms, unfiltered but as the curves of the test are.
    fn rated(&self, channel: &str, measured: &[f64]) -> f64 {
        let time_s: Vec<f64> = self.test.column("t_ms").iter().map(|t| 1e-3 * t).collect();
        let ours = self.series.of(channel).unwrap_or_else(|| panic!("no channel {channel}"));
        let [measured, ours] =
            [(&time_s, measured), (&self.series.time_s, ours)].map(|(t, v)| sampled_to(150, t, v, false));
        iso18571(&measured, &ours, 1e-4).unwrap().overall
    }

    /// Of the resultants of head, chest and pelvis.
    fn felt(&self) -> [f64; 3] {
        [("head", "HDCG"), ("upper_torso", "CHST"), ("lower_torso", "PVCN")].map(|(segment, place)| {
            let axes = ["X", "Y", "Z"].map(|axis| format!("{place}_{axis}L_AC"));
            let measured = self.test.resultant(axes.each_ref().map(String::as_str));
            self.rated(&format!("{}{segment}.acceleration.resultant", self.name), &measured)
        })
    }

    fn hic(&self, who: &str, window: HicWindow) -> f64 {
        hic(self.series.of(&format!("{who}head.acceleration.resultant")).unwrap(), 2e-4, window).unwrap().value
    }

    fn peak(&self, channel: &str) -> f64 {
        largest_magnitude(self.series.of(channel).unwrap(), 2e-4).unwrap().value.abs()
    }
}

/// A Hybrid III 50th male with belts and no bag, and two 5th females, of whom the folder has no curves: NHTSA's record of them.
#[test]
#[cfg_attr(not(crash_tests), ignore = "OCCUPANT_CRASH_TESTS names no folder of crash tests")]
fn belted_dummies_of_a_car_to_car_test_are_hit_and_missed() {
    let sides = ["DSLF", "DSRF"];
    let path = motion("nhtsa-7292/vehicle.csv", "113.4 km/h", sides);
    let test = Curves::open("nhtsa-7292/driver.csv");
    let scenario = include_str!("../../scenarios/studies/blind-cars/taurus.toml");
    let car = Dummy::drive(scenario, &[&path], "driver.", test);
    let [head, chest, pelvis] = car.felt();
    assert!(head > 0.72 && chest > 0.71 && pelvis > 0.70, "{head:.3} {chest:.3} {pelvis:.3}");
    let [shoulder, lap] = [("SHBT", "d_ring_shoulder"), ("LPBO", "buckle_sill")]
        .map(|(column, strap)| car.rated(&format!("strap.driver.belt.{strap}.force"), &car.test.column(column)));
    assert!(shoulder > 0.77 && lap > 0.53, "{shoulder:.3} {lap:.3}");
    // the belts' greatest forces, 4845 and 6937 N in the record
    assert!((car.peak("strap.driver.belt.d_ring_shoulder.force") / 4845.0 - 1.0).abs() < 0.05);
    assert!((1.1..1.3).contains(&(car.peak("strap.driver.belt.buckle_sill.force") / 6937.0)));
    // missed: the head of the test struck a wheel that had come nearer
    let hic36 = car.hic("driver.", HicWindow::Ms36);
    assert!((120.0..300.0).contains(&hic36), "{hic36} of 1114");
    // missed: 504, 2077 N at her shoulder; her lap belt had 3255 N
    let hic36 = car.hic("passenger.", HicWindow::Ms36);
    assert!((130.0..260.0).contains(&hic36), "{hic36} of 504");
    assert!((1.7..2.4).contains(&(car.peak("strap.passenger.belt.d_ring_shoulder.force") / 2077.0)));
    assert!((car.peak("strap.passenger.belt.buckle_sill.force") / 3255.0 - 1.0).abs() < 0.2);
    // behind: 471
    let hic36 = car.hic("rear.", HicWindow::Ms36);
    assert!((hic36 / 471.0 - 1.0).abs() < 0.2, "{hic36} of 471");
}

/// A driver with belt and bag, the bag of another scenario: its numbers are made up, and the head goes through it.
#[test]
#[cfg_attr(not(crash_tests), ignore = "OCCUPANT_CRASH_TESTS names no folder of crash tests")]
fn a_driver_with_a_bag_that_is_made_up_is_held_at_the_chest_and_not_at_the_head() {
    let path = motion("nhtsa-10146/vehicle.csv", "57.09 km/h", ["FLLR", "FLRR"]);
    let test = Curves::open("nhtsa-10146/driver.csv");
    let car = Dummy::drive(include_str!("../../scenarios/studies/blind-cars/camry.toml"), &[&path], "", test);
    let [head, chest, pelvis] = car.felt();
    assert!((0.45..0.60).contains(&head) && chest > 0.71 && pelvis > 0.77, "{head:.3} {chest:.3} {pelvis:.3}");
    let hic15 = car.hic("", HicWindow::Ms15);
    assert!((300.0..600.0).contains(&hic15), "{hic15} of 140");
}

/// Deflections of the chests of two Hybrid III drivers, 18.8 mm at 84 ms and 23.2 mm at 67 ms in the records. The share of a belt was
/// fitted to the first one; the second one's bag is made up.
#[test]
#[cfg_attr(not(crash_tests), ignore = "OCCUPANT_CRASH_TESTS names no folder of crash tests")]
fn chests_of_two_drivers_go_in_about_as_far_as_the_records() {
    let deepest = |car: &Dummy, until_s: f64| {
        let all = car.series.of(&format!("{}chest.deflection", car.name)).unwrap().iter().zip(&car.series.time_s);
        all.filter(|(_, t)| **t <= until_s).fold((0.0, 0.0), |most, (d, t)| if *d > most.0 { (*d, *t) } else { most })
    };
    let path = motion("nhtsa-7292/vehicle.csv", "113.4 km/h", ["DSLF", "DSRF"]);
    let set = [&path, "occupants.driver.body.chest=dummy50"];
    let scenario = include_str!("../../scenarios/studies/blind-cars/taurus.toml");
    let car = Dummy::drive(scenario, &set, "driver.", Curves::open("nhtsa-7292/driver.csv"));
    let (deflection_m, time_s) = deepest(&car, 0.15);
    assert_within("7292, m", deflection_m, [0.015, 0.020]);
    assert_within("7292, s", time_s, [0.080, 0.095]);
    let path = motion("nhtsa-10146/vehicle.csv", "57.09 km/h", ["FLLR", "FLRR"]);
    let set = [&path, "body.chest=dummy50"];
    let scenario = include_str!("../../scenarios/studies/blind-cars/camry.toml");
    let car = Dummy::drive(scenario, &set, "", Curves::open("nhtsa-10146/driver.csv"));
    assert_within("10146 before the wheel, m", deepest(&car, 0.074).0, [0.015, 0.025]);
}

/// Three occupants with nothing known but the motion, the speed, the class, the person's size and, in 7292, that belts alone held: a pelvis
/// stays back under its lap belt as the tests' did. The wings of pelvises were set by a published skeleton, with these curves known.
#[test]
#[cfg_attr(not(crash_tests), ignore = "OCCUPANT_CRASH_TESTS names no folder of crash tests")]
fn occupants_of_a_car_of_a_class_move_about_as_dummies_did() {
    let head = "title = \"a car of a class\"\n[time]\nend = 0.16\n[output]\ninterval = \"0.2 ms\"\n[path]\nkind = \"sensors\"\n";
    let belts = "[car.seats.driver]\nlimiter = \"4 kN\"\npretensioner = 0\n[car.bags]\ndriver = false\n";
    let aside = "[posture]\nseat = \"passenger\"\n";
    let taurus = motion("nhtsa-7292/vehicle.csv", "113.4 km/h", ["DSLF", "DSRF"]);
    let camry = motion("nhtsa-10146/vehicle.csv", "57.09 km/h", ["FLLR", "FLRR"]);
    let rated = |file: &str, path: &str, body: &str, more: &str| {
        let scenario = format!("{head}[body]\n{body}\n{more}[car]\nclass = \"sedan\"\n");
        let car = Dummy::drive(&scenario, &[path], "", Curves::open(file));
        let mut all = Vec::new();
        for (segment, place) in [("head", "HDCG"), ("upper_torso", "CHST"), ("lower_torso", "PVCN")] {
            for (axis, sign) in [("x", 1.0), ("y", -1.0), ("z", -1.0)] {
                let measured = car.test.column(&format!("{place}_{}L_AC", axis.to_uppercase()));
                let measured: Vec<f64> = measured.iter().map(|a| sign * STANDARD_GRAVITY_MPS2 * a).collect();
                all.push(car.rated(&format!("{segment}.acceleration.{axis}"), &measured));
            }
        }
        all.extend(car.felt());
        for (femur, column) in [("left_femur.axial", "FMRL_ZL_LC"), ("right_femur.axial", "FMRR_ZL_LC")] {
            all.push(car.rated(femur, &car.test.column(column)));
        }
        // the mean, and that of the pelvis upward
        [all.iter().sum::<f64>() / all.len() as f64, all[8]]
    };
    let (him, her) = ("nhtsa-10146/driver.csv", "nhtsa-10146/front-passenger.csv");
    for (what, [mean, up], bounds) in [
        ("7292", rated("nhtsa-7292/driver.csv", &taurus, "preset = \"male50\"", belts), [0.6, 0.62]),
        ("7292, dummy", rated("nhtsa-7292/driver.csv", &taurus, "dummy = \"hybrid3_50m-like\"", belts), [0.57, 0.58]),
        ("10146", rated(him, &camry, "preset = \"male50\"", ""), [0.55, 0.6]),
        ("10146, dummy", rated(him, &camry, "dummy = \"hybrid3_50m-like\"", ""), [0.52, 0.6]),
        ("10146, beside him", rated(her, &camry, "preset = \"female05\"", aside), [0.48, 0.48]),
        ("10146, dummy beside him", rated(her, &camry, "dummy = \"hybrid3_5f-like\"", aside), [0.51, 0.32]),
    ] {
        assert_within(what, mean, [bounds[0], 1.0]);
        assert_within(&format!("{what}, pelvis upward"), up, [bounds[1], 1.0]);
    }
}
