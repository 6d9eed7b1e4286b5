//! What a blow from behind adds to the measures of a run: closed forms of a body that floats until the car comes.

use crash_measures::injury::Measure;
use occupant_core::model::Model;
use occupant_core::model::setup::Setup;
use occupant_core::results::outcome::Status;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::simulate::simulate;
use occupant_tests::measure::assert_below;
use occupant_tests::room::setup;

/// A car that gets 10 m/s ahead within 100 ms, and a body at rest ahead of a head restraint.
const FLOATS: &str = r#"
title = "a body that floats ahead of a head restraint"
gravity = 0
time = { end = "60 ms" }
output = { interval = "1 ms" }
integrator = { kind = "rk4", step = "50 us" }
path = { kind = "pulse", shape = "square", speed = "10 m/s", direction = [-1, 0, 0], delta_v = "10 m/s", duration = "100 ms" }
body = { preset = "male50" }
joints = { preset = "male50" }
initial_state = { q = [9, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0], rates = [-10, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0] }

[materials]
foam = { k1 = "20 kN/m", mu1 = 0.3, friction = 0.2 }

[surfaces.head_restraint]
material = "foam"
spheres = ["head"]
points = [[8.8, -2, -2], [8.8, 2, -2], [8.8, 2, 2], [8.8, -2, 2]]
inside = [9, 0, 0]
"#;

fn measures(setup: Setup) -> Vec<Measure> {
    let model = Model::new(setup).unwrap();
    let mut summarizer = Summarizer::new();
    assert_eq!(simulate(&model, &mut summarizer).unwrap().status, Status::Completed);
    summarizer.summary(None).unwrap().measures
}

fn of<'m>(all: &'m [Measure], name: &str) -> &'m Measure {
    all.iter().find(|measure| measure.name == name).unwrap_or_else(|| panic!("no {name}"))
}

/// Where the back of the head begins ahead of the restraint, m.
fn gap_m() -> f64 {
    let model = Model::new(setup(FLOATS, &[])).unwrap();
    let (head, mut gap) = (model.body().sphere("head").unwrap(), None);
    let watch = Watch(|s: &Sample<'_>| {
        gap.get_or_insert(s.sphere_centre_m(head).x - s.model.body().spheres[head].radius_m - 8.8);
    });
    simulate(&model, watch).unwrap();
    gap.unwrap()
}

/// ½ a t² of the car is the gap when they meet; until then the head goes back at a t, T1 feels nothing.
#[test]
fn a_head_that_floats_meets_its_restraint_when_the_car_has_come_up() {
    let gap = gap_m();
    assert!((0.02..0.2).contains(&gap), "{gap}");
    let all = measures(setup(FLOATS, &["time.end=150 ms"]));
    let due_s = (2.0 * gap / 100.0).sqrt();
    let contact = of(&all, "head_contact_time");
    // readings every 0.1 ms, of which the first beyond 1 N counts
    assert!((contact.value.unwrap() - due_s - 1e-4).abs() < 3e-4, "{contact:?} {due_s}");
    assert!(contact.to_s.unwrap() > contact.from_s.unwrap() + 0.04, "{contact:?}");
    assert!(of(&all, "nic").value.unwrap() > 1.0);
}

#[test]
fn without_contact_places_and_speeds_are_those_of_the_car() {
    // a step longer than the last reading, which rounding would leave out
    let far = ["surfaces.head_restraint.points=[[7, -2, -2], [7, 2, -2], [7, 2, 2], [7, -2, 2]]", "time.end=60.05 ms"];
    let all = measures(setup(FLOATS, &far));
    assert!(of(&all, "head_contact_time").remark.as_deref().unwrap().contains("never in contact"));
    assert_below("pelvis, m", of(&all, "pelvis_travel_back").value.unwrap() - 0.5 * 100.0 * 0.06 * 0.06, 2e-6);
    assert_below("T1, m/s²", of(&all, "t1_acceleration").value.unwrap(), 1e-3);
    assert_below("NIC, m²/s²", of(&all, "nic").value.unwrap(), 1e-3);
    assert_below("rebound, m/s", of(&all, "rebound_speed").value.unwrap(), 1e-3);
}

/// From the front, from the side, without a head restraint: nothing of it is listed.
#[test]
fn only_a_blow_from_behind_on_a_head_restraint_is_one() {
    let other = "surfaces={ rest = { material = \"foam\", spheres = [\"head\"], points = [[8.8, -2, -2], [8.8, 2, -2], [8.8, 2, 2], [8.8, -2, 2]], inside = [9, 0, 0] } }";
    for set in ["path.direction=[1, 0, 0]", "path.direction=[0, 1, 0]", "path={ kind = \"fixed\" }", other] {
        let all = measures(setup(FLOATS, &[set]));
        assert!(all.iter().all(|measure| measure.name != "nic" && measure.name != "head_contact_time"), "{set}");
    }
    assert!(measures(setup(FLOATS, &["path.yaw=30"])).iter().any(|measure| measure.name == "nic"));
}
