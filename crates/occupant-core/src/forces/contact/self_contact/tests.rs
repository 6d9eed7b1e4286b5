use approx::assert_relative_eq;

use super::SelfContact;
use super::series::{series, springs};
use crate::body::{Body, shape};
use crate::forces::contact::material::Force;
use crate::forces::function::{DeflectionLaw, ForceDeflection};
use crate::forces::spring::{BilinearSpring, Spring};

fn spring(k1: f64, break_m: f64, k2: f64, mu1: f64, mu2: f64) -> BilinearSpring {
    BilinearSpring { returned_2: mu2, ..BilinearSpring::linear(k1, mu1).then(break_m, k2) }
}

/// Deformation of `spring` under `force_n` after it was pressed to `greatest_m`, by halving.
fn deformation_m(spring: &BilinearSpring, force_n: f64, greatest_m: f64) -> f64 {
    let law = Spring::<f64>::new(spring);
    let (mut low, mut high) = (0.0, greatest_m);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if law.respond(middle, greatest_m).0 < force_n { low = middle } else { high = middle }
    }
    high
}

/// Deformation at which the loading curve of `spring` reaches `force_n`.
fn loaded_m(spring: &BilinearSpring, force_n: f64) -> f64 {
    let first = spring.k1_n_per_m * spring.break_m;
    let is_first = force_n <= first || spring.k1_n_per_m == spring.k2_n_per_m;
    if is_first { force_n / spring.k1_n_per_m } else { spring.break_m + (force_n - first) / spring.k2_n_per_m }
}

/// Within the first range, loading and unloading, two skins in series are two springs that carry one force.
#[test]
fn two_skins_are_two_springs_with_one_force() {
    let one = spring(80e3, 0.02, 200e3, 0.7, 0.5);
    let other = spring(30e3, 0.06, 30e3, 0.3, 0.4);
    let pair = springs(&one, &other);
    assert_relative_eq!(pair.k1_n_per_m * pair.break_m, 1600.0, max_relative = 1e-12);
    for force_n in [100.0, 700.0, 1599.0] {
        let parts_m = [&one, &other].map(|spring| loaded_m(spring, force_n));
        let greatest_m = parts_m[0] + parts_m[1];
        assert_relative_eq!(loaded_m(&pair, force_n), greatest_m, max_relative = 1e-12);
        for share in [0.9, 0.5, 0.1] {
            let parts_m = [(&one, parts_m[0]), (&other, parts_m[1])].map(|(s, m)| deformation_m(s, share * force_n, m));
            let whole_m = deformation_m(&pair, share * force_n, greatest_m);
            // Measured: 2e-16.
            assert_relative_eq!(whole_m, parts_m[0] + parts_m[1], max_relative = 1e-10);
        }
    }
}

#[test]
fn beyond_the_first_knee_the_curves_meet_at_three_times_its_force() {
    for (one, other) in [
        (spring(80e3, 0.02, 200e3, 0.7, 0.5), spring(30e3, 0.06, 90e3, 0.3, 0.4)),
        (spring(155.9e3, 0.0254, 80.6e3, 0.7, 0.7), spring(155.9e3, 0.0254, 80.6e3, 0.7, 0.7)),
        (spring(1e6, 0.0, 1e6, 0.2, 0.2), spring(10e3, 0.03, 100e3, 1.0, 0.1)),
    ] {
        let pair = springs(&one, &other);
        let knee_n = pair.k1_n_per_m * pair.break_m;
        for force_n in [knee_n, 3.0 * knee_n] {
            let whole_m = loaded_m(&one, force_n) + loaded_m(&other, force_n);
            assert_relative_eq!(loaded_m(&pair, force_n), whole_m, max_relative = 1e-12);
        }
        // what comes back of the work between them is what comes back of both
        let work = |s: &BilinearSpring, force_n: f64| {
            let depth_m = loaded_m(s, force_n);
            let back = Spring::<f64>::new(s).respond(depth_m, depth_m).1;
            let all = Spring::<f64>::new(&BilinearSpring { returned_1: 1.0, returned_2: 1.0, ..*s });
            [back, all.respond(depth_m, depth_m).1]
        };
        let between = |s: &BilinearSpring| {
            let [low, high] = [knee_n, 3.0 * knee_n].map(|force_n| work(s, force_n));
            [high[0] - low[0], high[1] - low[1]]
        };
        let [a, b] = [&one, &other].map(between);
        assert!(pair.returned_2 > 0.0 && pair.returned_2 <= 1.0);
        assert_relative_eq!(between(&pair)[1], a[1] + b[1], max_relative = 0.05);
        assert_relative_eq!(pair.returned_2, (a[0] + b[0]) / (a[1] + b[1]), max_relative = 0.15);
    }
}

#[test]
fn skins_without_knees_have_a_pair_without_one() {
    let pair = springs(&BilinearSpring::linear(60e3, 0.5), &BilinearSpring::linear(30e3, 0.2));
    assert_relative_eq!(pair.k1_n_per_m, 20e3, max_relative = 1e-12);
    assert_eq!((pair.k1_n_per_m, pair.returned_1), (pair.k2_n_per_m, pair.returned_2));
    // compliances of unloading add: 0.5/60 + 0.2/30 = 0.015 per kN/m
    assert_relative_eq!(pair.returned_1 / pair.k1_n_per_m, 1.5e-5, max_relative = 1e-12);
}

/// A function and a spring in series yield, and go back, as both do under one force.
#[test]
fn skins_of_lines_are_two_functions_with_one_force() {
    let lines = ForceDeflection::lines(vec![[0.0, 0.0], [0.01, 100.0], [0.02, 900.0], [0.03, 1200.0]], 0.3);
    let plain = spring(30e3, 0.01, 90e3, 0.5, 0.9);
    let whole = series([(&lines.clone().into(), 2.0), (&plain.into(), 1.0)]);
    let Force::Deflection(whole) = whole else { panic!("a spring") };
    let (whole, one) = (DeflectionLaw::new(&whole, 1.0), DeflectionLaw::new(&lines, 2.0));
    for top in [50.0, 250.0, 700.0, 1900.0, 4000.0] {
        let deep = [one.depth_under(top).unwrap(), loaded_m(&plain, top)];
        let all = whole.depth_under(top).unwrap();
        // measured: 1e-15 m
        assert!((deep[0] + deep[1] - all).abs() < 1e-12, "{top}: {deep:?} {all}");
        for share in [0.8, 0.3, 0.05] {
            let force = share * top;
            let back = |depth: &dyn Fn(f64) -> f64, top: f64| {
                let (mut low, mut high) = (0.0, top);
                for _ in 0..80 {
                    let middle = 0.5 * (low + high);
                    (low, high) = if depth(middle) < force { (middle, high) } else { (low, middle) };
                }
                high
            };
            let parts = back(&|x| one.respond(x, deep[0], 0.0).0, deep[0]) + deformation_m(&plain, force, deep[1]);
            let both = back(&|x| whole.respond(x, all, 0.0).0, all);
            assert!((parts - both).abs() < 1e-12, "{top} {share}: {parts} {both}");
        }
    }
}

fn names(body: &Body) -> Vec<[&str; 2]> {
    let name = |sphere: usize| body.spheres[sphere].name.as_str();
    SelfContact::of(body, 0).pairs.iter().map(|pair| pair.map(name)).collect()
}

#[test]
fn hands_elbows_knees_thighs_shins_and_feet_meet_what_they_reach() {
    let body = Body::male50();
    let pairs = names(&body);
    // of 136
    assert_eq!(pairs.len(), 34, "{pairs:?}");
    for pair in
        [["head", "left_hand"], ["left_hand", "right_thigh"], ["right_hand", "left_hand"], ["right_shin", "left_foot"]]
    {
        assert!(pairs.contains(&pair), "{pair:?} of {pairs:?}");
    }
    assert!(!pairs.contains(&["head", "chest"]) && !pairs.contains(&["pelvis", "left_thigh"]));
}

#[test]
fn pairs_are_mirrored_and_never_neighbours() {
    let report = Body::male50();
    let body = Body { spheres: shape::full(&report, report.spheres.clone(), shape::APART), ..report };
    let pairs = names(&body);
    assert!(pairs.len() > 100, "{}", pairs.len());
    let other = |name: &str| match name.split_once('_') {
        Some(("left", part)) => format!("right_{part}"),
        Some(("right", part)) => format!("left_{part}"),
        _ => name.to_owned(),
    };
    let standing_m = body.standing_m();
    for [a, b] in &pairs {
        let image = [other(a), other(b)];
        assert!(pairs.iter().any(|[c, d]| image == [*c, *d] || image == [*d, *c]), "{a} and {b} have no image");
        let [i, j] = [a, b].map(|name| body.sphere(name).expect("a sphere"));
        let is_of_arm = |name: &str| ["hand", "elbow"].iter().any(|part| name.ends_with(part));
        let overlap_m = body.spheres[i].radius_m + body.spheres[j].radius_m - (standing_m[i] - standing_m[j]).norm();
        assert!(overlap_m <= 0.005 || is_of_arm(a) || is_of_arm(b), "{a} and {b}: {overlap_m}");
    }
}
