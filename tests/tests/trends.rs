//! What every textbook says of restraints, asked of the templates: more slack, a later bag, a harder limiter, a faster crash. Each row varies one
//! key of a template and names a measure that must rise or fall with it. And how much the number of spheres matters.

use std::fmt;
use std::thread;

use occupant_core::model::Model;
use occupant_core::results::summary::{RunStatus, Summarizer, Summary};
use occupant_core::run::simulate::simulate;
use occupant_tests::room::setup;

const DRIVER: &str = include_str!("../../scenarios/templates/driver.toml");
const SIDE: &str = include_str!("../../scenarios/templates/side.toml");
const REAR: &str = include_str!("../../scenarios/templates/rear.toml");
const REAR_SEAT: &str = include_str!("../../scenarios/templates/rear-seat.toml");
const WALL: &str = include_str!("../../scenarios/airbag-driver.toml");

const NO_BAG: &str = "car.bags.driver=false";
const NO_BELT: &str = "car.seats.driver.belt=none";
/// How far a step may go the wrong way, as a part of the value: teeth of single contacts.
const TEETH: f64 = 0.02;

fn summary(text: &str, set: &[&str]) -> Summary {
    let model = Model::new(setup(text, set)).unwrap_or_else(|problems| panic!("{set:?}: {problems}"));
    let mut summarizer = Summarizer::new();
    simulate(&model, &mut summarizer).unwrap();
    let summary = summarizer.summary(None).unwrap();
    assert_eq!(summary.status, RunStatus::Completed, "{set:?}");
    summary
}

/// A measure, or the way of the head ahead, m.
fn value(summary: &Summary, name: &str) -> f64 {
    match name {
        "excursion" => summary.head_excursion.as_ref().unwrap().forward.value,
        _ => summary.measures.iter().find(|m| m.name == name).and_then(|m| m.value).unwrap(),
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Trend {
    Rises,
    Falls,
}
use Trend::{Falls, Rises};

/// A template, settings for all runs, the settings of each run in turn, and measures with their trends.
struct Row<'a> {
    text: &'a str,
    always: &'a [&'a str],
    each: Vec<String>,
    trends: &'a [(&'a str, Trend)],
}

/// A row whose runs differ in one key.
fn row<'a>(
    text: &'a str,
    always: &'a [&'a str],
    key: &str,
    values: &[&str],
    trends: &'a [(&'a str, Trend)],
) -> Row<'a> {
    Row { text, always, each: values.iter().map(|value| format!("{key}={value}")).collect(), trends }
}

impl fmt::Display for Row<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?} {:?}", self.always, self.each)
    }
}

impl Row<'_> {
    /// What goes the wrong way, or not at all.
    fn wrong(&self) -> Vec<String> {
        let run = |each: &String| {
            let set: Vec<&str> = self.always.iter().copied().chain(each.split(';')).collect();
            summary(self.text, &set)
        };
        let runs: Vec<Summary> = self.each.iter().map(run).collect();
        let mut wrong = Vec::new();
        for (name, trend) in self.trends {
            let values: Vec<f64> = runs.iter().map(|run| value(run, name)).collect();
            let sign = if *trend == Rises { 1.0 } else { -1.0 };
            let goes_back = values.windows(2).any(|two| sign * (two[1] - two[0]) < -TEETH * two[0].abs());
            let (first, last) = (values[0], values[values.len() - 1]);
            if goes_back || sign * (last - first) < TEETH * first.abs() {
                wrong.push(format!("{self}: {name} {trend:?}: {values:?}"));
            }
        }
        wrong
    }
}

/// All rows, on two threads.
fn hold(rows: &[Row<'_>]) {
    let wrong = thread::scope(|scope| {
        let halves = [0, 1].map(|half| {
            scope.spawn(move || rows.iter().skip(half).step_by(2).flat_map(Row::wrong).collect::<Vec<_>>())
        });
        halves.map(|half| half.join().expect("runs")).concat()
    });
    assert!(wrong.is_empty(), "{wrong:#?}");
}

const HIC: &str = "hic15";
const CHEST: &str = "chest_3ms_cumulative";
const PELVIS: &str = "pelvis_3ms_cumulative";
const DEFLECTION: &str = "chest_deflection";

#[test]
fn belts_and_seats_do_what_textbooks_say() {
    hold(&[
        row(
            DRIVER,
            &[],
            "car.seats.driver.slack",
            &["0", "'60 mm'", "'100 mm'"],
            &[(HIC, Rises), (CHEST, Rises), (DEFLECTION, Rises), ("excursion", Rises)],
        ),
        row(
            DRIVER,
            &[],
            "car.seats.driver.limiter",
            &["'2 kN'", "'3 kN'", "'4 kN'", "'6 kN'"],
            &[(CHEST, Rises), (DEFLECTION, Rises), ("excursion", Falls)],
        ),
        row(
            DRIVER,
            &[],
            "car.seats.driver.pretensioner",
            &["0", "'50 mm'", "'100 mm'"],
            &[(HIC, Falls), (CHEST, Falls), (PELVIS, Falls)],
        ),
        row(DRIVER, &[], "car.seats.driver.foam", &["0.5", "1", "2", "4"], &[(CHEST, Rises), (PELVIS, Rises)]),
        row(DRIVER, &[], "car.seats.driver.d_ring.above", &["'50 cm'", "'58 cm'", "'66 cm'"], &[("excursion", Rises)]),
        row(DRIVER, &[NO_BAG], "car.seats.driver.belt", &["three_point", "lap", "none"], &[(HIC, Rises)]),
        // a chest over a lap belt alone swings into the wheel; of one without a belt the knees bear a part
        row(DRIVER, &[NO_BAG], "car.seats.driver.belt", &["three_point", "none"], &[(CHEST, Rises)]),
        row(REAR_SEAT, &[], "car.seats.rear_left.pretensioner", &["0", "'50 mm'", "'100 mm'"], &[(CHEST, Falls)]),
    ]);
}

#[test]
fn bags_wheels_and_bolsters_do_what_textbooks_say() {
    hold(&[
        row(DRIVER, &[], "car.bags.delay", &["'9 ms'", "'20 ms'", "'30 ms'", "'45 ms'", "'60 ms'"], &[(HIC, Rises)]),
        // later the belt has nearly stopped the chest
        row(DRIVER, &[], "car.bags.delay", &["'9 ms'", "'20 ms'", "'30 ms'", "'45 ms'"], &[(CHEST, Rises)]),
        row(DRIVER, &[], "car.bags.vent", &["0.25", "0.5", "1"], &[(HIC, Falls), ("excursion", Rises)]),
        row(DRIVER, &[], "car.bags.driver", &["true", "false"], &[(HIC, Rises), ("nij", Rises)]),
        row(WALL, &[], "car.bags.driver", &["true", "false"], &[(HIC, Rises), ("nij", Rises)]),
        row(DRIVER, &[], "car.wheel.column_force", &["'1 kN'", "'2.5 kN'", "'5 kN'", "'20 kN'"], &[(CHEST, Rises)]),
        row(
            DRIVER,
            &[],
            "car.wheel.ahead",
            &["'30 cm'", "'35 cm'", "'40 cm'", "'45 cm'"],
            &[("excursion", Rises), (DEFLECTION, Falls)],
        ),
        row(DRIVER, &[NO_BELT], "car.bags.driver", &["true", "false"], &[(HIC, Rises), (CHEST, Rises)]),
        // farther away, knees slide up its face
        row(DRIVER, &[NO_BELT], "car.panel.bolster", &["'48 cm'", "'52 cm'", "'56 cm'"], &[(PELVIS, Rises)]),
        row(
            DRIVER,
            &[NO_BELT],
            "car.panel.bolster_stiffness",
            &["'40 kN/m'", "'80 kN/m'", "'160 kN/m'"],
            &[("left_femur", Rises)],
        ),
    ]);
}

#[test]
fn crashes_and_people_do_what_textbooks_say() {
    let faster = |speed: &u32| format!("path.speed='{speed}km/h';path.delta_v='{speed}km/h'");
    let speeds =
        |text, trends| Row { text, always: &[], each: [40, 50, 56, 64, 72].iter().map(faster).collect(), trends };
    hold(&[
        speeds(DRIVER, &[(HIC, Rises), (CHEST, Rises), (PELVIS, Rises), (DEFLECTION, Rises), ("excursion", Rises)]),
        speeds(REAR_SEAT, &[(CHEST, Rises), (PELVIS, Rises), ("excursion", Rises)]),
        row(
            DRIVER,
            &[],
            "path.duration",
            &["0.07", "0.08", "0.1", "0.12"],
            &[(HIC, Falls), (CHEST, Falls), (DEFLECTION, Falls)],
        ),
        row(
            DRIVER,
            &[],
            "body.preset",
            &["female05", "female50", "male50", "male95"],
            &[(CHEST, Falls), (DEFLECTION, Rises), ("excursion", Rises)],
        ),
        row(DRIVER, &[], "car.seats.driver.recline", &["10", "20", "30"], &[("excursion", Rises)]),
        // a door that hardly comes in is met late and as fast
        row(SIDE, &[], "car.intrusion.left.depth", &["'15 cm'", "'25 cm'", "'35 cm'"], &[(PELVIS, Rises)]),
        row(SIDE, &[], "car.bags.side", &["left", "none"], &[(CHEST, Rises)]),
        row(REAR, &[], "car.seats.driver.head_gap", &["'10 mm'", "'30 mm'", "'50 mm'", "'80 mm'"], &[("nic", Rises)]),
        row(
            REAR,
            &[],
            "car.seats.driver.back_moment",
            &["'1.5 kN m'", "'3 kN m'", "'10 kN m'"],
            // not NIC: a stiffer back also brings the head to its restraint earlier
            &[("t1_acceleration", Rises)],
        ),
    ]);
}

/// The rows along the limbs with half and with twice their spheres: at most 3.1 %. Spheres of which each has its own force press a chest
/// harder: 6.4 % of a HIC15 of 48.
#[test]
fn half_and_twice_the_spheres_change_head_and_chest_by_less_than_five_percent() {
    let ways = [("body.sphere_spacing=2.4", 0.05), ("body.sphere_spacing=0.6", 0.05), ("body.sphere_set=full", 0.07)];
    for text in [DRIVER, WALL] {
        let default = summary(text, &[]);
        for (way, most) in ways {
            let other = summary(text, &[way]);
            for name in [HIC, CHEST, DEFLECTION] {
                let (was, is) = (value(&default, name), value(&other, name));
                assert!((is / was - 1.0).abs() < most, "{way}: {name} {was} {is}");
            }
        }
    }
}
