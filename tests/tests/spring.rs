//! The bilinear dissipative spring: energy returned, continuity, reloading, memory, and drops on it.

use nalgebra::Vector3;
use occupant_core::forces::contact::EdgeForce;
use occupant_core::forces::contact::material::{Material, Memory};
use occupant_core::forces::spring::{BilinearSpring, Spring};
use occupant_core::model::Model;
use occupant_core::results::recorder::Watch;
use occupant_core::run::simulate::simulate;
use occupant_tests::cases::{afloat, pillar, plane, smooth, spring, straight};
use occupant_tests::measure::assert_below;
use occupant_tests::probe::{Probe, RADIUS_M};

/// Laws with both ranges, with equal and unequal fractions, softening as well as stiffening.
fn laws() -> Vec<BilinearSpring> {
    let mut out = Vec::new();
    for (k1, break_m, k2) in [(8e3, 0.05, 47e3), (5e4, 0.02, 7e4), (3e4, 0.03, 1e4)] {
        for (mu1, mu2) in [(1.0, 1.0), (0.5, 0.5), (0.3, 0.8), (0.9, 0.05), (0.01, 1.0)] {
            out.push(spring(k1, break_m, k2, mu1, mu2));
        }
    }
    out
}

/// Energies stored in the two ranges at `top` (m), J: closed form of the loading curve.
fn stored_by_range(s: &BilinearSpring, top: f64) -> (f64, f64) {
    let (a, b) = (top.min(s.break_m), (top - s.break_m).max(0.0));
    let first = 0.5 * s.k1_n_per_m * a * a;
    (first, s.k1_n_per_m * a * b + 0.5 * s.k2_n_per_m * b * b)
}

/// ∫F dΔ from `from` to `to` by Gauss–Legendre points on each of the pieces between the law's kinks.
fn area(law: &Spring<f64>, greatest: f64, kinks: &[f64], from: f64, to: f64) -> f64 {
    let mut cuts: Vec<f64> = kinks.iter().map(|k| k.clamp(from, to)).collect();
    cuts.extend([from, to]);
    cuts.sort_by(f64::total_cmp);
    let piece = |a: f64, b: f64| {
        let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
        let at = |x: f64| law.respond(middle + half * x, greatest).0;
        let node = (1.0_f64 / 3.0).sqrt();
        half * (at(node) + at(-node))
    };
    cuts.windows(2).map(|w| piece(w[0], w[1])).sum()
}

/// Where the unloading line from `top` reaches zero, and where it changes slope.
fn unloading_kinks(s: &BilinearSpring, top: f64) -> [f64; 2] {
    let (a, b) = (top.min(s.break_m), (top - s.break_m).max(0.0));
    let set = top - (s.returned_1 * a + s.returned_2 * b);
    [set, set + s.returned_1 * a]
}

#[test]
fn unloading_returns_mu_1_of_range_1_and_mu_2_of_range_2() {
    let mut worst = 0.0_f64;
    for s in laws() {
        let law = Spring::new(&s);
        for top in [0.3 * s.break_m, s.break_m, 1.7 * s.break_m, 6.0 * s.break_m] {
            let taken = area(&law, 0.0, &[s.break_m], 0.0, top);
            let given = area(&law, top, &unloading_kinks(&s, top), 0.0, top);
            let (first, second) = stored_by_range(&s, top);
            let expected = s.returned_1 * first + s.returned_2 * second;
            let recoverable = law.respond(top, top).1;
            worst = worst
                .max((taken / (first + second) - 1.0).abs())
                .max((given / expected - 1.0).abs())
                .max((recoverable / expected - 1.0).abs());
        }
    }
    // Measured: 1.4e-14.
    assert_below("energy returned, relative", worst, 1e-12);
}

#[test]
fn the_recoverable_energy_is_the_area_that_is_left_under_the_unloading_line() {
    let mut worst = 0.0_f64;
    for s in laws() {
        let law = Spring::new(&s);
        let top = 2.4 * s.break_m;
        let whole = law.respond(top, top).1;
        for i in 0..=40 {
            let depth = top * f64::from(i) / 40.0;
            let left = area(&law, top, &unloading_kinks(&s, top), 0.0, depth);
            worst = worst.max((law.respond(depth, top).1 - left).abs() / whole);
        }
    }
    // Measured: 4.3e-16.
    assert_below("area left, relative", worst, 1e-12);
}

#[test]
fn the_force_has_no_jump_anywhere() {
    for s in laws() {
        let law = Spring::new(&s);
        for top in [0.0, 0.5 * s.break_m, 3.0 * s.break_m] {
            let (step, slope) = (1e-4 * s.break_m, law.steepest());
            let mut last = law.respond(0.0, top).0;
            for i in 1..=60_000 {
                let force = law.respond(f64::from(i) * step, top).0;
                // a jump would exceed the steepest slope times the step
                assert!((force - last).abs() <= slope * step * (1.0 + 1e-6));
                last = force;
            }
        }
    }
}

#[test]
fn a_spring_that_returns_all_retraces_its_loading_curve() {
    let s = spring(8e3, 0.05, 47e3, 1.0, 1.0);
    let law = Spring::new(&s);
    let mut worst = 0.0_f64;
    for i in 0..=300 {
        let depth = 0.0005 * f64::from(i);
        let (loading, unloading) = (law.respond(depth, 0.0).0, law.respond(depth, 0.15).0);
        worst = worst.max((loading - unloading).abs() / law.respond(0.15, 0.0).0);
    }
    // Measured: 8.9e-17.
    assert_below("loading against unloading, of the greatest force", worst, 1e-13);
}

/// Leads a probe on the plane Z′ = 0 through deformations (m) and returns the forces, N.
fn pressed(material: &Material, depths_m: &[f64]) -> Vec<f64> {
    let high = Vector3::z() * 1.0;
    let surfaces = vec![plane(Vector3::z())];
    let mut probe = Probe::new(vec![material.clone()], surfaces, EdgeForce::AtCentre, high);
    let lead = |&depth: &f64| probe.at(Vector3::z() * (RADIUS_M - depth)).force_n.z;
    depths_m.iter().map(lead).collect()
}

#[test]
fn reloading_runs_along_the_unloading_line_and_then_along_the_loading_curve() {
    let s = spring(8e3, 0.01, 47e3, 0.4, 0.6);
    let forces = pressed(&smooth(s), &[0.02, 0.017, 0.012, 0.017, 0.02, 0.03]);
    let line = |depth: f64| {
        let set = 0.02 - (0.4 * 0.01 + 0.6 * 0.01);
        let e: f64 = depth - set;
        (8e3 / 0.4 * e.clamp(0.0, 0.004)) + 47e3 / 0.6 * (e - 0.004).max(0.0)
    };
    let curve = |depth: f64| 80.0 + 47e3 * (depth - 0.01);
    let expected = [curve(0.02), line(0.017), line(0.012), line(0.017), curve(0.02), curve(0.03)];
    let worst = forces.iter().zip(expected).map(|(f, e)| (f - e).abs() / e);
    // Measured: 2.7e-15.
    assert_below("force along the walk, relative", worst.fold(0.0, f64::max), 1e-12);
    assert_eq!(forces[1].to_bits(), forces[3].to_bits());
}

#[test]
fn padding_forgets_its_crush_when_the_pair_opens_and_crushed_metal_does_not() {
    let s = spring(8e3, 0.05, 47e3, 0.5, 0.5);
    let depths = [0.02, -0.01, 0.015];
    let padding = pressed(&smooth(s), &depths);
    let metal = Material { memory: Memory::Retain, ..smooth(s) };
    let metal = pressed(&metal, &depths);
    let tiny = 1e-10;
    assert!((padding[2] - 8e3 * 0.015).abs() < tiny);
    // set at 0.01, slope 8e3/0.5: 80 N at 0.015
    assert!((metal[2] - 16e3 * 0.005).abs() < tiny);
    assert_eq!((padding[1], metal[1]), (0.0, 0.0));
}

#[test]
fn a_fraction_of_zero_counts_as_a_hundredth_and_is_reported_once() {
    let mut setup = afloat(pillar(), 0.1, 1e-3);
    setup.materials = vec![smooth(spring(8e3, 0.05, 47e3, 0.0, 1.0))];
    setup.surfaces = vec![plane(Vector3::z())];
    setup.posture = straight(Vector3::z() * 5.0, Vector3::zeros());
    let model = Model::new(setup).unwrap();
    let warnings: Vec<_> = model.warnings().iter().map(|p| p.path.as_str()).collect();
    assert_eq!(warnings, ["materials.smooth.mu1"]);
    let law = Spring::<f64>::new(&spring(8e3, 0.05, 47e3, 0.0, 1.0));
    let returned = law.respond(0.03, 0.03).1 / (0.5 * 8e3 * 0.03 * 0.03);
    // Measured: 1.7e-18.
    assert_below("fraction returned", returned - 0.01, 1e-15);
}

/// Drops the pillar on its feet without gravity: fraction of its kinetic energy after the rebound, and greatest Δ, m.
fn drop(s: BilinearSpring, speed_m_s: f64, step_s: f64) -> (f64, f64) {
    let mut setup = afloat(pillar(), 0.4, step_s);
    let legs: f64 = [0, 3, 8, 10].map(|n| setup.body.segments[n].length_m).iter().sum();
    let foot = setup.body.sphere("left_foot").unwrap();
    let r = setup.body.spheres[foot].radius_m;
    setup.materials = vec![smooth(s)];
    let mut ground = plane(Vector3::z());
    ground.spheres = Some(vec![foot]);
    setup.surfaces = vec![ground];
    // the foot's sphere lies 1 mm above the ground, its centre r above the leg's lower end
    let t1 = legs + 1e-3;
    assert!(setup.body.spheres[foot].centre_from_lower_end_m.z == r);
    setup.posture = straight(Vector3::z() * t1, Vector3::z() * -speed_m_s);
    setup.time.output_s = step_s;
    let model = Model::new(setup).unwrap();
    let (mut first, mut last, mut greatest) = (None, 0.0, 0.0_f64);
    let outcome = simulate(
        &model,
        Watch(|s: &occupant_core::results::sample::Sample<'_>| {
            first.get_or_insert(s.energy.kinetic_j);
            last = s.energy.kinetic_j;
            greatest = s.contacts().map(|c| c.depth_m).fold(greatest, f64::max);
        }),
    )
    .unwrap();
    assert_eq!(outcome.first_touches.len(), 1);
    (last / first.unwrap(), greatest)
}

#[test]
fn a_body_dropped_within_range_1_keeps_mu_1_of_its_energy() {
    let s = spring(4e4, 0.3, 9e4, 0.35, 0.9);
    let (fraction, greatest) = drop(s, 3.0, 1e-5);
    assert!(greatest > 0.1 && greatest < 0.3);
    // Measured: 3.9e-9.
    assert_below("fraction kept", fraction - 0.35, 1e-6);
}

#[test]
fn a_body_dropped_into_range_2_keeps_mu_1_and_mu_2_of_their_shares() {
    let s = spring(4e4, 0.04, 9e4, 0.35, 0.8);
    let speed = 3.0;
    let (fraction, greatest) = drop(s, speed, 1e-5);
    assert!(greatest > 0.05);
    let mass = pillar().mass_kg();
    let (energy, first) = (0.5 * mass * speed * speed, 0.5 * 4e4 * 0.04 * 0.04);
    let expected = (0.35 * first + 0.8 * (energy - first)) / energy;
    // Measured: 3.9e-9.
    assert_below("fraction kept", fraction - expected, 1e-6);
}

#[test]
fn a_dropped_body_sinks_as_deep_as_its_energy_says() {
    let (k, speed) = (4e4, 3.0);
    let (_, greatest) = drop(spring(k, 0.3, k, 1.0, 1.0), speed, 1e-5);
    let expected = speed * (pillar().mass_kg() / k).sqrt();
    // the outputs straddle the turning point
    // Measured: 1.1e-9.
    assert_below("depth, relative", greatest / expected - 1.0, 1e-7);
}
