//! `drive.passes`: people who push the vehicle that carries them.

use std::thread;

use nalgebra::Vector3;
use occupant_core::model::Model;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use placed_text::Diagnostics;
use vehicle_motion::V3;
use vehicle_motion::chassis::{Chassis, Controls};

use super::{complaint, load, short_with};
use crate::{Drives, Loaded};

/// A light car on ice with a man on the seat of the short scenario; it runs into a standing one.
fn crash(passes: u32) -> String {
    let pulse =
        "kind = \"pulse\"\nshape = \"half_sine\"\nspeed = \"30 km/h\"\ndelta_v = \"30 km/h\"\nduration = \"100 ms\"\n";
    let drive = format!(
        r#"kind = "drive"
vehicle = "car"

[drive]
end = "0.15 s"
passes = {passes}
[drive.vehicles.car]
preset = "small"
payload = "from occupants"
drag_area = 0
start = {{ speed = "12 m/s" }}
[drive.vehicles.other]
preset = "sedan"
drag_area = 0
start = {{ x = "4.6 m", y = "0.3 m" }}
[drive.ground]
friction = 1e-9
"#
    );
    short_with(pulse, &drive)
}

fn loaded(text: &str) -> Loaded {
    load(text).unwrap_or_else(|e| panic!("{e}"))
}

fn driven(text: &str) -> Drives {
    loaded(text).drives().unwrap_or_else(|e| panic!("{e}")).0.unwrap()
}

/// Messages about a text, including warnings.
fn told(text: &str) -> String {
    match load(text).and_then(|loaded| loaded.drives()) {
        Ok((_, warnings)) => warnings.to_string(),
        Err(problems) => problems.to_string(),
    }
}

/// Linear momentum of the people in vehicle-space at the start and at the end of their run in these drives, N·s.
fn of_people(loaded: &Loaded, drives: &Drives) -> [V3; 2] {
    let model = Model::new(loaded.built(Some(drives)).unwrap().0).unwrap();
    let mass_kg = model.body().mass_kg();
    let mut all: Vec<V3> = Vec::new();
    let see = |sample: &Sample<'_>| {
        let velocity: Vector3<f64> = sample.centre_of_body(0).1 * mass_kg;
        all.push(V3::new(velocity.x, -velocity.y, -velocity.z));
    };
    simulate(&model, Watch(see)).unwrap();
    [all[0], all[all.len() - 1]]
}

/// Drives after exactly this many passes.
fn after(passes: u32) -> (Loaded, Drives) {
    let end = "time.end = \"150 ms\"\n";
    let exact = format!("{end}integrator.accuracy = \"reference\"\n");
    let loaded = loaded(&crash(passes).replacen(end, &exact, 1));
    let drives = loaded.passed_until(driven(&crash(0)), &mut Diagnostics::new(), 0.0).unwrap();
    assert_eq!(drives.changes_m.len(), passes as usize);
    (loaded, drives)
}

/// On ice, the cars and the man who pushed them keep their momentum across the level; with him in the last drive too, once
/// it is settled. The crush is less deep than with him as rigid mass, and each pass changes less.
#[test]
fn people_and_cars_keep_their_momentum_together() {
    let (_, before) = after(2);
    let (loaded, drives) = after(3);
    let lost = |people: [V3; 2]| {
        let mut sum = people;
        for (own, ride) in drives.vehicles.iter().zip(&drives.outcome.rides) {
            let chassis = Chassis::new(&own.car).unwrap();
            for (sum, station) in sum.iter_mut().zip([&ride.stations()[0], ride.last()]) {
                *sum += chassis.momenta(&station.state, &Controls::default())[0];
            }
        }
        let change = sum[1] - sum[0];
        change.x.hypot(change.y) / sum[0].x
    };
    let [pushing, settled] = [&before, &drives].map(|drives| lost(of_people(&loaded, drives)));
    let [with, without] = [&driven(&crash(0)), &drives].map(|drives| drives.outcome.damage[0].dynamic_m);
    // measured 1.8e-9 and 4.5e-9 after five passes with forces every 0.1 ms; changes of 15, 0.38, 0.021, 0.0013 mm
    assert!(pushing < 1e-6, "{pushing:e}");
    assert!(settled < 1e-5, "{settled:e}");
    assert!(drives.outcome.balance.abs() < 1e-4, "{}", drives.outcome.balance);
    let large = drives.changes_m.windows(2).filter(|pair| pair[0] > 1e-4);
    assert!(large.clone().all(|pair| pair[1] < 0.5 * pair[0]), "{:?}", drives.changes_m);
    assert!(without < 0.998 * with && without > 0.9 * with, "{with} {without}");
}

#[test]
fn passes_end_early_and_have_the_same_bits_in_threads() {
    let text = crash(8);
    let once = driven(&text);
    assert!(once.changes_m.len() < 6 && once.changes_m.last().is_some_and(|last| *last < 1e-3), "{:?}", once.changes_m);
    let other = thread::scope(|scope| scope.spawn(|| driven(&text)).join().unwrap());
    assert_eq!(once.changes_m, other.changes_m);
    assert_eq!(once.outcome.rides[0].last().state, other.outcome.rides[0].last().state);
    let setup = loaded(&text).build().unwrap().0;
    let fact = |name: &str| setup.facts.iter().find(|own| own.name == name).map(|own| own.value);
    assert_eq!(fact("drive.passes"), Some(once.changes_m.len() as f64));
    assert_eq!(fact("drive.pass_change"), once.changes_m.last().copied());
}

/// The first pass asked for is made, no more; none without.
#[test]
fn as_many_passes_as_asked_for() {
    assert!(driven(&crash(0)).changes_m.is_empty());
    assert_eq!(driven(&crash(1)).changes_m.len(), 1);
}

#[test]
fn what_is_wrong_with_passes_is_said() {
    let text = complaint(&crash(21));
    assert!(text.contains("21 passes") && text.contains("at most 20") && text.contains("drive.passes"), "{text}");
    let text = complaint(&crash(0).replace("passes = 0", "passes = -1"));
    assert!(text.contains("a whole number of at least 0"), "{text}");
    let text = complaint(&crash(0).replace("passes = 0", "passes = 99999999999"));
    assert!(text.contains("drive.passes"), "{text}");
    // nobody sits in a vehicle that drives
    let alone = crash(3).replace("kind = \"drive\"\nvehicle = \"car\"", "kind = \"fixed\"");
    let text = told(&alone.replace("payload = \"from occupants\"\n", ""));
    assert!(text.contains("nobody sits"), "{text}");
    // a heavy man in a light car
    let heavy = crash(0).replace("preset = \"small\"", "preset = \"small\"\nmass = \"700 kg\"");
    assert!(told(&heavy).contains("drive.passes = 3"), "{}", told(&heavy));
    let text = told(&heavy.replace("passes = 0", "passes = 1"));
    assert!(
        !text.contains("drive.passes = 3") && text.contains("pass 1, the last, still moved a vehicle by"),
        "{text}"
    );
}
