//! Coplanar faces that share an edge act as one face; faces at an angle add.

use std::f64::consts::FRAC_PI_4;

use nalgebra::{Point3, Vector3};
use occupant_core::forces::contact::EdgeForce;
use occupant_core::forces::contact::material::Material;
use occupant_core::forces::contact::surface::{Facing, Frame, Outline, Surface};
use occupant_core::forces::contact::{PASSED, TOUCHING};
use occupant_tests::cases::{rectangle, smooth, spring};
use occupant_tests::measure::assert_below;
use occupant_tests::probe::{Probe, RADIUS_M};

const K: f64 = 2e4;

fn material() -> Vec<Material> {
    let mut lossy = smooth(spring(K, 0.02, 3.0 * K, 0.4, 0.6));
    lossy.friction = 0.5;
    vec![lossy]
}

fn probe(surfaces: Vec<Surface>) -> Probe {
    let high = Vector3::new(0.0, 0.0, 1.0);
    Probe::new(material(), surfaces, EdgeForce::AtCentre, high)
}

/// A knee's walk in x over the seam at x = 0, sinking and rising as it goes.
fn walk() -> impl Iterator<Item = Vector3<f64>> {
    (-300..=300).map(|i| {
        let x = f64::from(i) * 1e-3;
        Vector3::new(x, 0.04, RADIUS_M - 0.03 - 0.01 * (17.0 * x).sin())
    })
}

/// Greatest difference of force (N), moment (N·m) and Δ_m (m) between two sets of surfaces along the walk.
fn difference(one: Vec<Surface>, other: Vec<Surface>) -> f64 {
    let (mut a, mut b) = (probe(one), probe(other));
    let slide = Vector3::new(0.8, 0.1, 0.0);
    let mut worst = 0.0_f64;
    for at in walk() {
        let (p, q) = (a.moving(at, slide, Vector3::y()), b.moving(at, slide, Vector3::y()));
        assert_eq!((a.phase(0), b.phase(0)), (TOUCHING, TOUCHING));
        worst = worst
            .max((p.force_n - q.force_n).norm())
            .max((p.moment_n_m - q.moment_n_m).norm())
            .max((a.greatest_m(0) - b.greatest_m(0)).abs());
    }
    worst
}

#[test]
fn a_knee_that_slides_over_a_seam_feels_one_face() {
    let halves = vec![rectangle("left", [-0.5, 0.0], [-0.5, 0.5]), rectangle("right", [0.0, 0.5], [-0.5, 0.5])];
    assert_eq!(probe(halves.clone()).pairs(), 1);
    let whole = vec![rectangle("whole", [-0.5, 0.5], [-0.5, 0.5])];
    assert_eq!(difference(halves, whole), 0.0);
}

#[test]
fn a_chain_of_three_faces_is_one_face_in_any_order() {
    let [left, middle, right] = [[-0.5, -0.1], [-0.1, 0.15], [0.15, 0.5]];
    let face = |name: &str, x: [f64; 2]| rectangle(name, x, [-0.5, 0.5]);
    let parts = vec![face("left", left), face("right", right), face("middle", middle)];
    assert_eq!(probe(parts.clone()).pairs(), 1);
    let whole = vec![face("whole", [-0.5, 0.5])];
    assert_eq!(difference(parts, whole), 0.0);
}

#[test]
fn faces_that_share_part_of_an_edge_have_the_distance_to_their_union() {
    // an L: the right face reaches only from y = −0.1 to 0.1
    let (a, b) = (([-0.5, 0.0], [-0.5, 0.5]), ([0.0, 0.5], [-0.1, 0.1]));
    let mut l = probe(vec![rectangle("a", a.0, a.1), rectangle("b", b.0, b.1)]);
    assert_eq!(l.pairs(), 1);
    let distance = |(xs, ys): ([f64; 2], [f64; 2]), x: f64, y: f64| {
        let out = |c: f64, [low, high]: [f64; 2]| (low - c).max(c - high).max(0.0);
        out(x, xs).hypot(out(y, ys))
    };
    let (depth, mut worst) = (0.015, 0.0_f64);
    for i in 0..=60 {
        for j in 0..=60 {
            let (x, y) = (-0.2 + 0.01 * f64::from(i), -0.25 + 0.01 * f64::from(j));
            let d = distance(a, x, y).min(distance(b, x, y));
            let expected = K * depth * (1.0 - d / RADIUS_M).max(0.0);
            l.at(Vector3::new(x, y, 1.0));
            let force = l.at(Vector3::new(x, y, RADIUS_M - depth)).force_n.z;
            worst = worst.max((force - expected).abs());
        }
    }
    // Of 300 N.
    // Measured: 0.
    assert_below("force less w·K·Δ, N", worst, 1e-10);
}

#[test]
fn the_part_that_is_nearest_gives_the_material_and_the_name() {
    let mut stiff = smooth(spring(5.0 * K, 1.0, K, 1.0, 1.0));
    stiff.name = "stiff".into();
    let mut right = rectangle("right", [0.0, 0.5], [-0.5, 0.5]);
    right.material = 1;
    let surfaces = vec![rectangle("left", [-0.5, 0.0], [-0.5, 0.5]), right];
    let materials = vec![smooth(spring(K, 1.0, K, 1.0, 1.0)), stiff];
    let high = Vector3::new(0.0, 0.0, 1.0);
    let mut probe = Probe::new(materials, surfaces, EdgeForce::AtCentre, high);
    let mut force = |x: f64| {
        let load = probe.at(Vector3::new(x, 0.0, RADIUS_M - 0.01));
        (load.touches[0].part, load.force_n.z)
    };
    let (left, right) = (force(-0.01), force(0.01));
    assert_eq!((left.0, right.0), (0.0, 1.0));
    // Measured: 1.1e-13.
    assert_below("left, N", left.1 - K * 0.01, 1e-10);
    // Measured: 4.5e-13.
    assert_below("right, N", right.1 - 5.0 * K * 0.01, 1e-9);
}

#[test]
fn faces_that_only_touch_at_a_corner_or_leave_a_gap_stay_apart() {
    let corner = vec![rectangle("a", [-0.5, 0.0], [-0.5, 0.0]), rectangle("b", [0.0, 0.5], [0.0, 0.5])];
    assert_eq!(probe(corner).pairs(), 2);
    let gap = vec![rectangle("a", [-0.5, 0.0], [-0.5, 0.5]), rectangle("b", [0.001, 0.5], [-0.5, 0.5])];
    assert_eq!(probe(gap).pairs(), 2);
}

/// A square that rises from the Y′ axis at 45° to the left, and another to the right: a gutter.
fn gutter() -> [Surface; 2] {
    let side = |name: &str, sign: f64| {
        let (s, c) = FRAC_PI_4.sin_cos();
        let far = |y: f64| Point3::new(sign * c, y, s);
        Surface {
            name: name.into(),
            frame: Frame::Space,
            outline: Outline::Polygon(vec![
                Point3::new(0.0, -1.0, 0.0),
                Point3::new(0.0, 1.0, 0.0),
                far(1.0),
                far(-1.0),
            ]),
            facing: Facing::Towards(Point3::new(0.0, 0.0, 1.0)),
            material: 0,
            spheres: None,
        }
    };
    [side("left", -1.0), side("right", 1.0)]
}

#[test]
fn faces_that_meet_at_an_angle_act_separately_and_their_forces_add() {
    let [left, right] = gutter();
    let mut both = probe(vec![left.clone(), right.clone()]);
    let (mut left, mut right) = (probe(vec![left]), probe(vec![right]));
    assert_eq!(both.pairs(), 2);
    let mut worst = 0.0_f64;
    for i in -10..=10 {
        let at = Vector3::new(0.004 * f64::from(i), 0.0, 0.11);
        let slide = Vector3::new(0.3, 0.5, 0.0);
        let sum = left.moving(at, slide, Vector3::zeros()).force_n + right.moving(at, slide, Vector3::zeros()).force_n;
        let force = both.moving(at, slide, Vector3::zeros()).force_n;
        assert!(force.norm() > 100.0);
        worst = worst.max((force - sum).norm());
    }
    // Measured: 0.
    assert_below("sum of forces, N", worst, 1e-9);
}

#[test]
fn a_joined_pair_passes_only_beyond_the_union() {
    let halves = vec![rectangle("left", [-0.5, 0.0], [-0.5, 0.5]), rectangle("right", [0.0, 0.5], [-0.5, 0.5])];
    let mut probe = probe(halves);
    let at = |x: f64| Vector3::new(x, 0.0, RADIUS_M - 0.01);
    for (x, phase) in [(-0.3, TOUCHING), (0.3, TOUCHING), (0.55, TOUCHING), (0.61, PASSED)] {
        probe.at(at(x));
        assert_eq!(probe.phase(0), phase, "x = {x}");
    }
}
