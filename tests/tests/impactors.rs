//! Impactors on a chest, a pelvis and a knee: the limits of 49 CFR 572, and what the impactor loses the body gets.

use nalgebra::Vector3;
use occupant_core::model::Model;
use occupant_core::results::outcome::Status;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use occupant_tests::measure::assert_below;
use occupant_tests::room::setup;

const CHEST: &str = include_str!("../../scenarios/impactor-chest.toml");
const PELVIS: &str = include_str!("../../scenarios/impactor-pelvis.toml");
const KNEE: &str = include_str!("../../scenarios/impactor-knee.toml");

const LBF_N: f64 = 4.448_221_615_260_5;

/// What the sphere felt of the impactor, the only loose body, at every output: time, force on it, depth.
struct Blow {
    felt: Vec<(f64, Vector3<f64>, f64)>,
    /// Change of the impactor's velocity, m/s.
    change: Vector3<f64>,
    mass_kg: f64,
}

impl Blow {
    fn peak_n(&self) -> f64 {
        self.felt.iter().map(|(_, force, _)| force.norm()).fold(0.0, f64::max)
    }

    fn deepest_m(&self) -> f64 {
        self.felt.iter().map(|(.., depth)| *depth).fold(0.0, f64::max)
    }

    /// ∫F dt along an axis, trapezoids, N s.
    fn impulse(&self, axis: usize) -> f64 {
        self.felt.windows(2).map(|w| 0.5 * (w[1].0 - w[0].0) * (w[0].1[axis] + w[1].1[axis])).sum()
    }

    /// Share of the work of loading that unloading does not return.
    fn hysteresis(&self, axis: usize) -> f64 {
        let work = self.felt.windows(2).map(|w| 0.5 * (w[1].2 - w[0].2) * (w[0].1[axis] + w[1].1[axis]).abs());
        let (loading, unloading): (Vec<f64>, Vec<f64>) = work.partition(|work| *work > 0.0);
        1.0 + unloading.iter().sum::<f64>() / loading.iter().sum::<f64>()
    }

    /// What the impactor loses along its way the sphere gets.
    fn assert_handed_over(&self, axis: usize) {
        let lost = -self.mass_kg * self.change[axis];
        assert_below("momentum handed over", (self.impulse(axis) / lost - 1.0).abs(), 1e-3);
    }
}

fn blow(text: &str, set: &[&str], sphere: &str) -> Blow {
    let model = Model::new(setup(text, set)).unwrap();
    let body = model.body();
    let struck = body.spheres.iter().position(|own| own.name == sphere).unwrap();
    let mass_kg = body.segments.last().unwrap().mass_kg;
    let (mut felt, mut first, mut change) = (Vec::new(), None, Vector3::zeros());
    let look = Watch(|s: &Sample<'_>| {
        let depth = s.contacts().filter(|own| own.sphere == struck).map(|own| own.depth_m).fold(0.0, f64::max);
        felt.push((s.time_s, s.sphere_force_n(struck), depth));
        // space has y to the left and z up, forces are in vehicle axes
        let speed = s.centre_of_body(1).1.component_mul(&Vector3::new(1.0, -1.0, -1.0));
        change = speed - *first.get_or_insert(speed);
    });
    assert_eq!(simulate(&model, look).unwrap().status, Status::Completed);
    Blow { felt, change, mass_kg }
}

#[test]
fn the_chest_of_a_dummy_gives_way_as_572_34_asks() {
    let blow = blow(CHEST, &[], "sitter.chest");
    let (peak, deep, lost) = (blow.peak_n() / LBF_N, blow.deepest_m() / 0.0254, blow.hysteresis(0));
    assert!((1160.0..=1325.0).contains(&peak), "{peak} lbf");
    assert!((2.5..=2.86).contains(&deep), "{deep} in");
    assert!((0.69..=0.85).contains(&lost), "{lost}");
    blow.assert_handed_over(0);
}

/// 572.134: force and deflection together, no more force before them, and what is lost.
#[test]
fn the_chest_of_a_small_woman_gives_way_as_572_134_asks() {
    let set = [
        "occupants.sitter.body.preset=female05",
        "occupants.sitter.joints.preset=dummy05f-like",
        "solids.face.material=dummy05f",
        "loose.hub.mass=13.97 kg",
        "loose.hub.at=[0.013, 0, -0.43]",
    ];
    let blow = blow(CHEST, &set, "sitter.chest");
    let (deep_m, lost) = (blow.deepest_m(), blow.hysteresis(0));
    let between = |from_m: f64| {
        let felt = blow.felt.iter().filter(|(.., depth)| *depth >= from_m);
        felt.map(|(_, force, _)| force.norm()).fold(0.0, f64::max)
    };
    assert!((0.050..=0.058).contains(&deep_m), "{deep_m} m");
    assert!((3900.0..=4400.0).contains(&between(0.050)) && between(0.018) <= 4600.0, "{} N", between(0.050));
    assert!((0.69..=0.85).contains(&lost), "{lost}");
    blow.assert_handed_over(0);
}

/// Peaks and deflections between the least and the greatest of Lebarbé (2012). One skin: its constants were fitted at 6.7 m/s.
#[test]
fn the_chest_of_a_person_lies_between_the_tests_at_both_speeds() {
    for (speed, force_n, depth_m) in
        [("-6.7", 3165.0..=6353.0, 0.0668..=0.1028), ("-4.3", 1536.0..=2638.0, 0.0393..=0.0904)]
    {
        let velocity = format!("loose.hub.velocity=[{speed}, 0, 0]");
        let blow = blow(CHEST, &["solids.face.material=person", &velocity], "sitter.chest");
        assert!(force_n.contains(&blow.peak_n()), "{speed} m/s: {} N", blow.peak_n());
        assert!(depth_m.contains(&blow.deepest_m()), "{speed} m/s: {} m", blow.deepest_m());
        blow.assert_handed_over(0);
    }
}

/// Peaks between those of Viano (1989): his corridor at 5.2 m/s, where the skin was fitted, the four tests at 9.8 m/s.
#[test]
fn the_pelvis_peaks_where_the_tests_do_at_both_speeds() {
    for (speed, force_n) in [("5.2", 5000.0..=8000.0), ("9.8", 9350.0..=12727.0)] {
        let blow = blow(PELVIS, &[&format!("loose.hub.velocity=[0, {speed}, 0]")], "person.pelvis");
        assert!(force_n.contains(&blow.peak_n()), "{speed} m/s: {} N", blow.peak_n());
        blow.assert_handed_over(1);
    }
}

/// 572.35, 572.136 and 572.126 with one skin, and its closed form: a linear spring and a held thigh, F = v √(k m).
#[test]
fn held_knees_of_three_dummies_meet_their_limits() {
    let feet = 0.3048;
    for (set, speed_m_s, low_n, high_n) in [
        (vec![], 6.9 * feet, 1060.0 * LBF_N, 1300.0 * LBF_N),
        (vec!["body.preset=female05", "joints.preset=dummy05f-like", "loose.probe.mass=2.99"], 2.1, 3450.0, 4060.0),
        (vec!["body.preset=child06", "joints.preset=dummy06c-like", "loose.probe.mass=0.82"], 2.1, 2000.0, 3000.0),
    ] {
        let velocity = format!("loose.probe.velocity=[{}, 0, 0]", -speed_m_s);
        let blow = blow(KNEE, &[set, vec![velocity.as_str()]].concat(), "left_knee");
        assert!((low_n..=high_n).contains(&blow.peak_n()), "{} N", blow.peak_n());
        let closed_n = speed_m_s * f64::sqrt(1170e3 * blow.mass_kg);
        assert_below("peak", (blow.peak_n() / closed_n - 1.0).abs(), 2e-3);
        blow.assert_handed_over(0);
    }
}
