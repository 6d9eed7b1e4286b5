//! Length, wrap and gradient of the way.

use nalgebra::Vector3;

use super::super::MOST_NODES;
use super::super::past::NodePast;
use super::super::path::{self, Bend, Place, turn};
use super::random;
use crate::motion::scalar::Scalar;
use crate::motion::vector::{V3, v3};

fn place<S: Scalar>(centre: [f64; 3], radius: f64) -> Place<S> {
    let centre = V3::of(&Vector3::from(centre));
    let is_sphere = radius > 0.0;
    Place { centre, radius: S::of(radius), is_sphere, may_leave: is_sphere, ..Place::nowhere() }
}

fn bends<S: Scalar>(places: &[Place<S>], past: &[NodePast<S>; MOST_NODES]) -> [Bend<S>; MOST_NODES] {
    let mut list = [Bend::none(); MOST_NODES];
    path::bends(places, past, &mut list);
    list
}

/// All nodes on.
fn on<S: Scalar>() -> [NodePast<S>; MOST_NODES] {
    let mut past = [NodePast::none(); MOST_NODES];
    past.iter_mut().for_each(|node| node.on = S::one());
    past
}

/// Places with normals as at a start.
fn sensed<S: Scalar>(places: &[Place<S>]) -> Vec<Place<S>> {
    let found = bends(places, &on());
    places.iter().zip(&found).map(|(place, bend)| Place { sense: bend.normal, ..*place }).collect()
}

fn length<S: Scalar>(found: &[Bend<S>]) -> S {
    found.iter().fold(S::zero(), |sum, bend| sum + bend.span + bend.arc)
}

fn two_spheres<S: Scalar>() -> [Place<S>; 4] {
    [
        place([-0.4, 0.3, -0.6], 0.0),
        place([0.0, 0.17, -0.45], 0.06),
        place([0.1, 0.02, -0.25], 0.12),
        place([-0.1, -0.25, 0.2], 0.0),
    ]
}

#[test]
fn two_spheres_have_the_length_that_another_program_found() {
    let found = bends(&two_spheres::<f64>(), &on());
    assert!((length(&found) - 1.435_064_383_540_57).abs() < 1e-13, "{}", length(&found));
    assert!((found[1].wrap - 0.641_251_157_192_7).abs() < 1e-12 && (found[2].wrap - 1.191_446_769_752_6).abs() < 1e-12);
}

#[test]
fn forces_are_the_gradient_of_the_length_and_balance() {
    let mut seed = 11;
    for _ in 0..1000 {
        let mut at = two_spheres::<f64>();
        for place in &mut at {
            let mut some = || 0.06 * (random(&mut seed) - 0.5);
            place.centre += v3(some(), some(), some());
        }
        let (at, past) = (sensed(&at), on());
        let found = bends(&at, &past);
        let pull = |bend: &Bend<f64>| (bend.back + bend.ahead).to_vector();
        let sum: Vector3<f64> = found.iter().map(pull).sum();
        let moment: Vector3<f64> = found.iter().zip(&at).map(|(b, p)| p.centre.to_vector().cross(&pull(b))).sum();
        // measured: 1.1e-15 and 4e-16 m
        assert!(sum.norm() < 1e-13 && moment.norm() < 1e-13, "{sum} {moment}");
        for k in 0..4 {
            for axis in 0..3 {
                let moved = |h: f64| {
                    let mut at = at.clone();
                    let mut by = Vector3::zeros();
                    by[axis] = h;
                    at[k].centre += V3::of(&by);
                    length(&bends(&at, &past))
                };
                let slope = (moved(1e-5) - moved(-1e-5)) / 2e-5;
                // measured: 6e-10
                assert!((slope + pull(&found[k])[axis]).abs() < 1e-8, "node {k}: {slope} {}", pull(&found[k])[axis]);
            }
        }
    }
}

#[test]
fn a_frictionless_ring_off_the_way_is_passed_over() {
    let mut places = two_spheres::<f64>();
    places[1].may_leave = true;
    let places = sensed(&places);
    let mut past = on();
    past[1].on = 0.0;
    let without = [places[0], places[2], places[3]];
    let (found, other) = (bends(&places, &past), bends(&without, &on()));
    assert_eq!(length(&found), length(&other));
    assert_eq!((found[1].back, found[1].ahead, found[1].span), (V3::zero(), V3::zero(), 0.0));
    assert_eq!((found[0].ahead, found[2].back, found[3].back), (other[0].ahead, other[1].back, other[2].back));
}

#[test]
fn webbing_turns_by_the_angle_between_its_spans() {
    let angle = |a: f64| turn(v3(-1.0, 0.0, 0.0), v3(a.cos(), a.sin(), 0.0));
    for a in [0.0, 1e-9, 0.3, 1.0, 2.5, 3.1] {
        assert!((angle(a) - a).abs() < 1e-12, "{a}");
    }
}

/// When a sphere comes into or out of contact, the webbing has equal lengths with and without it: to ½W²S₋S₊/(S₋ + S₊).
#[test]
fn a_sphere_that_comes_on_changes_the_length_by_the_square_of_its_wrap() {
    for wrap in [2e-3_f64, -2e-3, 2e-4] {
        // between two points 0.3 m to either side of it, along x
        let height = 0.06 * (0.5 * wrap).cos() - 0.3 * (0.5 * wrap).sin();
        let places = [place([-0.3, 0.0, 0.0], 0.0), place([0.0, 0.0, height], 0.06), place([0.3, 0.0, 0.0], 0.0)];
        let (mut places, mut past) = (sensed(&places), on());
        // webbing runs below the sphere's centre
        places[1].sense = v3(0.0, 1.0, 0.0);
        let found = bends(&places, &past);
        if (found[1].wrap - wrap).abs() > 0.1 {
            places[1].sense = v3(0.0, -1.0, 0.0);
        }
        let (with, span) = (bends(&places, &past), 0.3);
        assert!((with[1].wrap - wrap).abs() < 2e-6, "{} {wrap}", with[1].wrap);
        past[1].on = 0.0;
        let apart = length(&with) - length(&bends(&places, &past));
        let expected = 0.5 * wrap * wrap * span * span / (2.0 * span);
        assert!((apart.abs() - expected).abs() < 0.02 * expected + 1e-12, "{apart} {expected}");
        // 0.3 µm at 2 mrad: no force jumps by more than what that pulls
        assert!(apart.abs() < 4e-7);
    }
}
