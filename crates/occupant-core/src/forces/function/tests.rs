//! Force functions: identities, closed forms, and what the ATB program's quadratic truly returns.

use super::steps::Steps;
use super::*;
use crate::forces::spring::{BilinearSpring, Spring};
use crate::motion::dual::Dual;
use crate::motion::scalar::Scalar;
use placed_text::Problems;

fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1u64 << 53) as f64
}

#[test]
fn two_intervals_are_the_bilinear_spring_and_reach_inverts_it() {
    let spring =
        BilinearSpring { returned_1: 0.4, returned_2: 0.8, ..BilinearSpring::linear(5e3, 1.0).then(0.02, 9e3) };
    let points = vec![[0.0, 0.0], [0.02, 100.0], [0.05, 370.0]];
    let law = FunctionLaw::new(&Function { returned: vec![0.4, 0.8], ..Function::lines(points, 1.0) });
    let (old, mut seed) = (Spring::<f64>::new(&spring), 7);
    for _ in 0..2000 {
        let (x, most) = (0.06 * random(&mut seed), 0.06 * random(&mut seed));
        let greatest = most.max(x);
        let (force, energy) = old.respond(x, greatest);
        let found = law.respond(x, greatest);
        // largest measured difference: 1.2e-13 N
        assert!((found.force - force).abs() < 1e-11, "{} {force}", found.force);
        assert!((law.returned_to(found.loading)[1] - energy).abs() < 1e-12);
        if force > 0.0 {
            let set = law.set(greatest);
            let (back, give, loading) = law.reach(force, greatest, set);
            assert!((back - x).abs() < 1e-13, "{back} {x}");
            // where unloading begins the slope is that of either side
            assert!(greatest - x < 1e-9 || (give * found.slope - 1.0).abs() < 1e-12);
            let beside = law.reach_beside(force + 300.0 * (x - 0.01), greatest, set, [300.0, 0.01]);
            assert!((beside.0 - x).abs() < 1e-13 && (beside.2 - loading).abs() < 1e-12);
        }
    }
}

#[test]
fn what_a_closed_path_loses_follows_from_the_greatest_alone() {
    let points = vec![[0.0, 0.0], [0.01, 400.0], [0.03, 400.0], [0.05, 1000.0]];
    let law = FunctionLaw::new(&Function { returned: vec![0.5, 0.01, 0.7], ..Function::lines(points, 1.0) });
    let lost = |x: f64| {
        (0.5 * 400.0 * 0.01) * 0.5
            + (x.clamp(0.01, 0.03) - 0.01) * 400.0 * 0.99
            + (x.max(0.03) - 0.03) * (400.0 + 15e3 * (x.max(0.03) - 0.03)) * 0.3
    };
    let (mut seed, mut work, mut greatest, mut before) = (3, 0.0, 0.0_f64, (0.0, 0.0));
    for _ in 0..40 {
        let target = if random(&mut seed) < 0.3 { 0.0 } else { 0.05 * random(&mut seed) };
        for i in 1..=20_000 {
            let x = before.0 + (target - before.0) * f64::from(i) / 20_000.0;
            let (from, force) =
                if i == 1 { before } else { (before.0 + (target - before.0) * f64::from(i - 1) / 20_000.0, before.1) };
            greatest = greatest.max(x);
            let now = law.respond(x, greatest).force;
            work += 0.5 * (force + now) * (x - from);
            before.1 = now;
        }
        before.0 = target;
    }
    let stored = law.returned_to(law.respond(before.0, greatest).loading)[1];
    if greatest > 0.03 {
        // measured: 2e-5 J of 20 J, the corners' part of the sum over 20,000 steps
        assert!((work - stored - lost(greatest)).abs() < 1e-3, "{work} {stored} {}", lost(greatest));
    } else {
        panic!("the path must go beyond the plateau");
    }
}

/// A stiffening curve and one with a peak, with every kind of unloading.
fn laws() -> Vec<(&'static str, ForceDeflection)> {
    let points = vec![[0.0, 0.0], [0.01, 300.0], [0.03, 1200.0], [0.05, 3200.0]];
    let lines = |returned| ForceDeflection::lines(points.clone(), returned);
    let smooth = Function { shape: Shape::Monotone, beyond: Beyond::Holds, ..lines(0.6).loading };
    let peak = vec![[0.0, 0.0], [0.01, 2000.0], [0.02, 700.0], [0.05, 1500.0]];
    let slope = |n_per_m, least| Unloading::Slope { n_per_m, least };
    let least = vec![[0.0, 0.0], [0.02, 100.0], [0.05, 900.0]];
    let spike = vec![[0.0, 0.0], [0.004, 800.0], [0.012, 0.0]];
    vec![
        ("stretch", lines(0.4)),
        ("smooth", ForceDeflection { loading: smooth, ..lines(1.0) }),
        ("slope", ForceDeflection { unloading: slope(150e3, Vec::new()), ..lines(1.0) }),
        ("least", ForceDeflection { unloading: slope(120e3, least), ..lines(1.0) }),
        ("peak", ForceDeflection { unloading: slope(250e3, Vec::new()), ..ForceDeflection::lines(peak, 1.0) }),
        (
            "quadratic",
            ForceDeflection {
                unloading: Unloading::Quadratic { returned: vec![[0.0, 0.5]], set: vec![[0.0, 0.2]] },
                ..lines(1.0)
            },
        ),
        ("spike", ForceDeflection { spike, ..lines(0.3) }),
    ]
}

fn said(law: &ForceDeflection) -> Vec<String> {
    let mut problems = Problems::new();
    law.check("m", &mut problems);
    problems.iter().map(ToString::to_string).collect()
}

/// U is the antiderivative of the force at a constant largest deformation, and dissipation grows with that alone: so
/// the work along every path equals stored plus dissipated energy.
#[test]
fn the_force_is_the_slope_of_the_recoverable_energy() {
    let mut seed = 4;
    for (name, data) in laws() {
        assert!(said(&data).iter().all(|line| line.starts_with("warning")), "{name}: {:?}", said(&data));
        let law = DeflectionLaw::new(&data, 1.0);
        let lifted = law.zip(&law, &|x, _| Dual::<1>::of(x)).unwrap();
        let mut before = 0.0;
        for i in 1..=400 {
            let top = 0.06 * f64::from(i) / 400.0;
            let depth = top * random(&mut seed);
            let (force, energy) = lifted.respond(Dual::new(depth, [1.0]), Dual::of(top), Dual::of(0.0));
            // measured: 3e-12 of the force
            assert!((energy.slopes[0] - force.value).abs() < 1e-9 * (1.0 + force.value), "{name} at {depth} of {top}");
            let lost = law.loading(top)[1] - law.respond(top, top, 0.0).1;
            assert!(lost >= before - 1e-12, "{name}: {lost} after {before}");
            before = lost;
            // loading has the curve itself
            let own = law.loading(top)[0];
            assert!((law.respond(top, 0.5 * top, 0.0).0 - own).abs() < 1e-9 * own, "{name} at {top}");
        }
    }
}

#[test]
fn the_force_does_not_jump_on_any_path() {
    let mut seed = 8;
    for (name, data) in laws() {
        let (law, steepest) = (DeflectionLaw::new(&data, 1.0), data.steepest());
        let (mut x, mut greatest, mut last) = (0.0_f64, 0.0_f64, 0.0);
        for _ in 0..200 {
            let target = 0.055 * random(&mut seed);
            for _ in 0..500 {
                let step = ((target - x) / 3.0).clamp(-1e-5, 1e-5);
                (x, greatest) = (x + step, greatest.max(x + step));
                let force = law.respond(x, greatest, 0.0).0;
                // steepest is found at 200 places
                assert!(
                    (force - last).abs() <= 1.5 * steepest * step.abs() + 1e-9,
                    "{name} at {x} of {greatest}: {last} {force}"
                );
                last = force;
            }
        }
    }
}

/// A mass thrown against each law rebounds with the energy that the law returns.
#[test]
fn a_mass_rebounds_with_what_is_returned() {
    for (name, data) in laws() {
        let law = DeflectionLaw::new(&data, 1.0);
        let (h, mass) = (1e-7, 5.0);
        let (mut x, mut v, mut greatest) = (0.0_f64, 3.0_f64, 0.0_f64);
        let mut force = 0.0;
        loop {
            v -= 0.5 * h * force / mass;
            x += h * v;
            greatest = greatest.max(x);
            force = law.respond(x, greatest, v).0;
            v -= 0.5 * h * force / mass;
            if v < 0.0 && force == 0.0 {
                break;
            }
        }
        let (stored, taken) = (law.respond(greatest, greatest, 0.0).1, law.loading(greatest)[1]);
        assert!((taken / (0.5 * mass * 9.0) - 1.0).abs() < 1e-4, "{name}: {taken}");
        assert!((0.5 * mass * v * v / stored - 1.0).abs() < 1e-4, "{name}: {v}, {stored} of {taken}");
    }
}

/// F = kx c(ẋ) with c = 1 + aẋ over half a sine of amplitude d: ∮ kx aẋ² dt = ⅔ k a d³ ω.
#[test]
fn what_a_factor_of_speed_takes_is_its_closed_integral() {
    let (k, d, omega) = (50e3, 0.03, 80.0);
    let speed = d * omega;
    let a = 0.5 / speed;
    let rate = vec![[-speed, 0.5], [0.0, 1.0], [speed, 1.5]];
    let data = ForceDeflection { rate, ..ForceDeflection::lines(vec![[0.0, 0.0], [1.0, k]], 1.0) };
    assert!(said(&data).is_empty());
    let (law, count) = (DeflectionLaw::new(&data, 1.0), 20_000);
    let mut work = 0.0;
    for i in 0..count {
        let phase = std::f64::consts::PI * (f64::from(i) + 0.5) / f64::from(count);
        let (x, v) = (d * phase.sin(), speed * phase.cos());
        work += law.respond(x, d, v).0 * v * std::f64::consts::PI / omega / f64::from(count);
    }
    let expected = 2.0 / 3.0 * k * a * d.powi(3) * omega;
    assert!((work / expected - 1.0).abs() < 1e-7, "{work} {expected}");
}

#[test]
fn a_damper_is_there_from_its_depth_on_and_never_pulls() {
    let data =
        ForceDeflection { viscous: Some([200.0, 0.02]), ..ForceDeflection::lines(vec![[0.0, 0.0], [1.0, 1e4]], 1.0) };
    let law = DeflectionLaw::new(&data, 1.0);
    for (depth, closing, force) in [(0.0, 9.0, 0.0), (0.01, 4.0, 500.0), (0.03, 4.0, 1100.0), (0.03, -4.0, 0.0)] {
        assert!((law.respond(depth, depth, closing).0 - force).abs() < 1e-9, "{depth} {closing}");
    }
}

/// Fraction that the ATB program's quadratic returns of a curve's work, at its last point.
fn returned(points: Vec<[f64; 2]>, r: f64, g: f64) -> (f64, Vec<String>) {
    let unloading = Unloading::Quadratic { returned: vec![[0.0, r]], set: vec![[0.0, g]] };
    let data = ForceDeflection { unloading, ..ForceDeflection::lines(points, 1.0) };
    let (law, end) = (DeflectionLaw::new(&data, 1.0), data.loading.end());
    (law.respond(end, end, 0.0).1 / law.loading(end)[1], said(&data))
}

#[test]
fn the_quadratic_returns_what_its_cuts_let_it_and_says_so() {
    let line = || vec![[0.0, 0.0], [0.1, 1e4]];
    for (r, g, found) in
        [(0.2, 0.0, 2.0 / 3.0), (0.8, 0.0, 0.8), (1.0, 0.0, 1.0), (0.2, 0.3, 0.7 * 2.0 / 3.0), (0.9, 0.3, 0.7)]
    {
        let (share, said) = returned(line(), r, g);
        assert!((share - found).abs() < 1e-12, "{r} {g}: {share}");
        assert_eq!(said.is_empty(), (share - r).abs() < 0.01, "{said:?}");
    }
    // a cubic gives back more than it took, whatever R says: 4/3
    let cubic = (0..=1000).map(|i| [1e-4 * f64::from(i), 1e-5 * f64::from(i).powi(3)]).collect();
    let (share, said) = returned(cubic, 0.5, 0.0);
    assert!((share - 4.0 / 3.0).abs() < 1e-5, "{share}");
    assert!(said.iter().any(|line| line.contains("makes energy")), "{said:?}");
}

#[test]
fn a_smooth_curve_rises_with_its_points_and_passes_them() {
    let points = vec![[0.0, 0.0], [0.01, 10.0], [0.02, 900.0], [0.03, 910.0], [0.05, 5000.0]];
    let law = FunctionLaw::new(&Function { shape: Shape::Monotone, ..Function::lines(points.clone(), 1.0) });
    for [x, y] in points {
        assert!((law.value(x) - y).abs() < 1e-9, "{x}");
    }
    let values: Vec<f64> = (0..=700).map(|i| law.value(1e-4 * f64::from(i))).collect();
    assert!(values.windows(2).all(|pair| pair[1] >= pair[0]));
    // beyond the last point the last slope continues
    assert!((values[700] - 2.0 * values[600] + values[500]).abs() < 1e-9);
}

#[test]
fn laws_that_make_energy_or_cannot_be_followed_are_refused() {
    let plain = ForceDeflection::lines(vec![[0.0, 0.0], [0.01, 300.0], [0.03, 1200.0]], 0.5);
    let slope = |n_per_m, least: &[[f64; 2]]| Unloading::Slope { n_per_m, least: least.to_vec() };
    let falling = vec![[0.0, 0.0], [0.01, 300.0], [0.03, 100.0]];
    let steep = vec![[0.0, 0.0], [1e-3, 0.0], [2e-3, 5000.0], [0.01, 0.0]];
    for (law, expected) in [
        (ForceDeflection::lines(falling.clone(), 0.5), "needs `unload_slope`"),
        (ForceDeflection { unloading: slope(30e3, &[]), ..plain.clone() }, "at least the largest slope of loading"),
        (
            ForceDeflection { unloading: slope(60e3, &[[0.0, 0.0], [0.01, 400.0]]), ..plain.clone() },
            "below that of loading",
        ),
        (ForceDeflection { rate: vec![[-1.0, 1.2], [0.0, 1.0]], ..plain.clone() }, "factors that do not fall"),
        (ForceDeflection { rate: vec![[-1.0, 0.5], [1.0, 1.2]], ..plain.clone() }, "1 at speed 0"),
        (ForceDeflection { spike: vec![[0.0, 0.0], [0.01, 50.0]], ..plain.clone() }, "a force of 0 at its last point"),
        // a spike that rises more steeply than it fades stores more than was put in
        (ForceDeflection { spike: steep, ..plain.clone() }, "makes energy"),
        (ForceDeflection { viscous: Some([-1.0, 0.02]), ..plain.clone() }, "zero or a positive number"),
    ] {
        let all = said(&law);
        assert!(all.iter().any(|line| line.contains(expected)), "{expected}: {all:?}");
    }
    assert!(said(&ForceDeflection { unloading: slope(60e3, &[]), ..ForceDeflection::lines(falling, 1.0) }).is_empty());
}

#[test]
fn a_table_is_constant_beyond_its_rows() {
    let table = Steps::<f64>::new(&[[-1.0, 0.8], [0.0, 1.0], [5.0, 1.2]]);
    for (x, y) in [(-3.0, 0.8), (-0.5, 0.9), (2.5, 1.1), (9.0, 1.2)] {
        assert!((table.at(x) - y).abs() < 1e-15, "{x}");
    }
    assert_eq!(Steps::<f64>::new(&[]).scale(7.0, 3.0), 7.0);
}

#[test]
fn a_polynomial_is_one_cubic_up_to_its_end() {
    let law = FunctionLaw::new(&Function::polynomial([2e3, -3e4, 9e5], 0.05, 0.4));
    let exact = |x: f64| 2e3 * x - 3e4 * x * x + 9e5 * x * x * x;
    for x in [0.0, 0.01, 0.033, 0.05] {
        assert!((law.value(x) - exact(x)).abs() < 1e-12, "{x}");
        let work = 1e3 * x * x - 1e4 * x * x * x + 2.25e5 * x.powi(4);
        let [_, back, lost] = law.returned_to(x);
        assert!((back - 0.4 * work).abs() < 1e-12 && (lost - 0.6 * work).abs() < 1e-12, "{x}");
    }
    // beyond the end its last slope continues
    let slope = 2e3 - 6e4 * 0.05 + 27e5 * 0.0025;
    assert!((law.value(0.06) - exact(0.05) - 0.01 * slope).abs() < 1e-9);
    let scaled = FunctionLaw::new(&Function::polynomial([2e3, -3e4, 9e5], 0.05, 0.4).times(0.5));
    assert!((scaled.value(0.02) - 0.5 * exact(0.02)).abs() < 1e-12);
    let check = |c| {
        let loading = Function::polynomial(c, 0.05, 1.0);
        said(&ForceDeflection { loading, ..ForceDeflection::lines(Vec::new(), 1.0) })
    };
    assert!(check([2e3, -3e4, 9e5]).is_empty());
    assert!(check([2e3, -9e4, 9e5]).iter().any(|line| line.contains("falls before its end")));
}

#[test]
fn the_quadratic_takes_its_numbers_from_tables_over_the_greatest_depth() {
    let rows = |from, to| vec![[0.01, from], [0.03, to]];
    let line = || ForceDeflection::lines(vec![[0.0, 0.0], [0.04, 4e3]], 1.0);
    let table =
        ForceDeflection { unloading: Unloading::Quadratic { returned: rows(0.7, 0.5), set: rows(0.1, 0.3) }, ..line() };
    let law = DeflectionLaw::<f64>::new(&table, 1.0);
    for (top, r, g) in [(0.005, 0.7, 0.1), (0.02, 0.6, 0.2), (0.04, 0.5, 0.3)] {
        let plain = Unloading::Quadratic { returned: vec![[0.0, r]], set: vec![[0.0, g]] };
        let plain = DeflectionLaw::new(&ForceDeflection { unloading: plain, ..line() }, 1.0);
        for part in [0.2, 0.5, 0.9, 1.0] {
            let [(a, b), (c, d)] = [&law, &plain].map(|law| law.respond(part * top, top, 0.0));
            assert!((a - c).abs() < 1e-9 && (b - d).abs() < 1e-12, "{top} {part}: {a} {c}");
        }
        // straight loading returns exactly R where (1 - G)·2/3 <= R <= 1 - G
        assert!((law.respond(top, top, 0.0).1 / law.loading(top)[1] - r).abs() < 1e-12, "{top}");
    }
    assert!(said(&table).iter().all(|line| !line.contains("makes energy")), "{:?}", said(&table));
    // a share that grows with depth faster than the work gives back what was lost before
    let growing = Unloading::Quadratic { returned: vec![[0.02, 0.7], [0.021, 1.0]], set: vec![[0.0, 0.0]] };
    assert!(said(&ForceDeflection { unloading: growing, ..line() }).iter().any(|line| line.contains("makes energy")));
}

#[test]
fn a_law_that_ends_gives_no_number_beyond_its_end() {
    let points = vec![[0.0, 0.0], [0.04, 4e3]];
    let ends = Function { beyond: Beyond::Limits, ..Function::lines(points, 0.5) };
    let law = DeflectionLaw::new(&ForceDeflection { loading: ends, ..ForceDeflection::lines(Vec::new(), 1.0) }, 1.0);
    // within a step it continues; what an accepted step has brought beyond the end is not known
    assert!((law.respond(0.041, 0.04, 0.0).0 - 4.1e3).abs() < 1e-9);
    assert!(law.respond(0.03, 0.0401, 0.0).0.is_nan());
    let why = law.overrun("it", 0.0401).unwrap();
    assert!(why.contains("it went to 40.1 mm") && why.ends_with(": 40.0 mm"), "{why}");
}
