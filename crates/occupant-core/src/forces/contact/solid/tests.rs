//! Distances against closed forms and an independent reference, gradients, remembered faces, work on closed paths.

use nalgebra::{Matrix3, Point3, Rotation3, Vector3};

use super::{Faced, Shape, build};
use crate::forces::contact::{FACE, OPEN};
use crate::motion::dual::Dual;
use crate::motion::vector::V3;

type V = Vector3<f64>;

/// Random numbers from 0 to 1, the same at every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn vector(&mut self, size: f64) -> V {
        V::from_fn(|_, _| self.between(-size, size))
    }

    fn turn(&mut self) -> Matrix3<f64> {
        *Rotation3::from_euler_angles(self.between(-3.0, 3.0), self.between(-1.5, 1.5), self.between(-3.0, 3.0))
            .matrix()
    }
}

fn made(shape: &Shape) -> Faced<f64> {
    build(shape).unwrap_or_else(|(found, expected)| panic!("{found}, expected {expected}"))
}

fn phi(shape: &Faced<f64>, place: V) -> f64 {
    shape.whole.distance(V3::of(&place)).phi
}

fn normal(shape: &Faced<f64>, place: V) -> V {
    shape.whole.distance(V3::of(&place)).normal.to_vector()
}

fn cube(rounding_m: f64) -> Shape {
    Shape::block(Point3::origin(), V::new(0.4, 0.2, 0.1), &Matrix3::identity(), rounding_m)
}

/// A prism of a random convex polygon in a random attitude: its shape, its corners and its half width.
fn random_prism(random: &mut Random) -> (Shape, Vec<V>, V, f64) {
    let count = 3 + (random.next() * 8.0) as usize;
    let mut angles: Vec<f64> = (0..count).map(|i| (i as f64 + random.between(0.1, 0.9)) / count as f64).collect();
    angles.sort_by(f64::total_cmp);
    let (turn, centre, half) = (random.turn(), random.vector(2.0), random.between(0.02, 0.3));
    // on an ellipse, so convex
    let (a, b) = (random.between(0.1, 0.5), random.between(0.1, 0.5));
    let corner = |t: &f64| {
        let t = t * std::f64::consts::TAU;
        centre + turn * V::new(a * t.cos(), b * t.sin(), 0.0)
    };
    let corners: Vec<V> = angles.iter().map(corner).collect();
    let mut shuffled: Vec<Point3<f64>> = corners.iter().map(|c| Point3::from(*c)).collect();
    shuffled.rotate_left(1);
    shuffled.swap(0, count - 1);
    let shape = Shape::Prism { corners_m: shuffled, half_width_m: half, rounding_m: 0.0 };
    (shape, corners, turn.column(2).into(), half)
}

/// Signed distance of a convex prism by trying every face, edge and corner.
fn reference(corners: &[V], axis: V, half: f64, place: V) -> f64 {
    let count = corners.len();
    let mut planes = vec![(axis, axis.dot(&corners[0]) + half), (-axis, half - axis.dot(&corners[0]))];
    let mut candidates: Vec<V> = Vec::new();
    for i in 0..count {
        let (p, q) = (corners[i], corners[(i + 1) % count]);
        let out = (q - p).cross(&axis).normalize();
        planes.push((out, out.dot(&p)));
        let segments = [
            (p + axis * half, q + axis * half),
            (p - axis * half, q - axis * half),
            (p + axis * half, p - axis * half),
        ];
        for (a, b) in segments {
            let t = (place - a).dot(&(b - a)) / (b - a).norm_squared();
            candidates.push(a + (b - a) * t.clamp(0.0, 1.0));
        }
    }
    let off: Vec<f64> = planes.iter().map(|(n, g)| n.dot(&place) - g).collect();
    let deepest = off.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if deepest <= 0.0 {
        return deepest;
    }
    let feet = planes.iter().zip(&off).map(|((n, _), off)| place - n * *off);
    let inside = |p: &V| planes.iter().all(|(n, g)| n.dot(p) - g < 1e-13);
    candidates.extend(feet.filter(inside));
    candidates.iter().map(|p| (place - p).norm()).fold(f64::INFINITY, f64::min)
}

#[test]
fn a_box_tells_what_a_distance_is_at_least() {
    let mut random = Random(11);
    for _ in 0..60 {
        let (centre, axis) = (random.vector(1.0), random.vector(1.0));
        let middle = Point3::from(centre);
        let (size, part) = (random.between(0.1, 0.5), random.between(0.01, 0.09));
        let shapes = [
            random_prism(&mut random).0,
            Shape::block(middle, V::new(0.4, 0.2, 0.1), &random.turn(), 0.5 * part),
            Shape::Disc { centre_m: middle, axis, radius_m: size, thickness_m: 2.2 * part, rounding_m: part },
            Shape::Capsule { ends_m: [middle, middle + axis], radius_m: size },
            Shape::Rim { centre_m: middle, axis, ring_radius_m: size, tube_radius_m: part },
        ];
        for shape in shapes.iter().map(made) {
            for far in [1.0, 3.0] {
                let place = random.vector(far);
                assert!(shape.at_least(V3::of(&place)) <= phi(&shape, place), "{shape:?} {place}");
            }
            // far away along an axis of the frame both are the same
            for way in [V::x(), -V::x(), V::y(), -V::y(), V::z(), -V::z()] {
                let off_m = phi(&shape, way * 1e4) - shape.at_least(V3::of(&(way * 1e4)));
                assert!((0.0..1e-3).contains(&off_m), "{shape:?} {way} {off_m}");
            }
        }
        let behind = made(&Shape::HalfSpace { point_m: middle, normal: axis });
        assert_eq!(behind.at_least(V3::of(&random.vector(9.0))), f64::NEG_INFINITY);
    }
}

#[test]
fn distances_of_a_box_are_those_of_its_face_edge_and_corner() {
    let (sharp, round) = (made(&cube(0.0)), made(&cube(0.02)));
    for shape in [&sharp, &round] {
        assert!((phi(shape, V::new(0.5, 0.01, 0.0)) - 0.3).abs() < 1e-15, "a face");
        assert!((phi(shape, V::new(0.0, 0.0, 0.03)) + 0.02).abs() < 1e-15, "inside");
    }
    assert!((phi(&sharp, V::new(0.5, 0.5, 0.0)) - 0.3f64.hypot(0.4)).abs() < 1e-15, "an edge");
    assert!((phi(&sharp, V::new(0.5, 0.5, 0.25)) - V::new(0.3, 0.4, 0.2).norm()).abs() < 1e-15, "a corner");
    // the corner of the finished solid is a ball about a point 20 mm inside
    let rounded = V::new(0.32, 0.42, 0.22).norm() - 0.02;
    assert!((phi(&round, V::new(0.5, 0.5, 0.25)) - rounded).abs() < 1e-15, "a rounded corner");
}

#[test]
fn distances_of_round_solids_are_closed_forms() {
    let centre_m = Point3::new(0.1, -0.2, 0.3);
    let axis = V::new(0.0, 0.0, 2.0);
    let place = |x: f64, y: f64, z: f64| centre_m.coords + V::new(x, y, z);
    let disc = made(&Shape::Disc { centre_m, axis, radius_m: 0.2, thickness_m: 0.02, rounding_m: 0.0 });
    assert!((phi(&disc, place(0.3, 0.4, 0.05)) - 0.3f64.hypot(0.04)).abs() < 1e-15);
    assert!((phi(&disc, place(0.0, 0.0, 0.005)) + 0.005).abs() < 1e-15);
    let rim = made(&Shape::Rim { centre_m, axis, ring_radius_m: 0.2, tube_radius_m: 0.015 });
    assert!((phi(&rim, place(0.3, 0.4, 0.1)) - (0.3f64.hypot(0.1) - 0.015)).abs() < 1e-15);
    assert!((phi(&rim, centre_m.coords) - 0.185).abs() < 1e-15);
    let ends_m = [centre_m, centre_m + V::new(0.0, 0.0, 0.5)];
    let bar = made(&Shape::Capsule { ends_m, radius_m: 0.03 });
    assert!((phi(&bar, place(0.03, 0.04, 0.2)) - 0.02).abs() < 1e-15);
    assert!((phi(&bar, place(0.0, 0.03, -0.04)) - 0.02).abs() < 1e-15);
    let ground = made(&Shape::HalfSpace { point_m: centre_m, normal: axis });
    assert!((phi(&ground, place(7.0, -3.0, 0.25)) - 0.25).abs() < 1e-14);
    assert!((phi(&ground, place(7.0, -3.0, -0.25)) + 0.25).abs() < 1e-14);
}

#[test]
fn random_prisms_have_the_distance_of_an_independent_reference() {
    let random = &mut Random(1);
    for _ in 0..60 {
        let (shape, corners, axis, half) = random_prism(random);
        let shape = made(&shape);
        for _ in 0..60 {
            let place = shape.whole.centre.to_vector() + random.vector(0.7);
            let (found, expected) = (phi(&shape, place), reference(&corners, axis, half, place));
            assert!((found - expected).abs() < 1e-12, "{found} and {expected}");
        }
    }
}

#[test]
fn gradients_are_those_of_differences_and_of_dual_numbers() {
    let random = &mut Random(2);
    let (disc, bar) = (
        Shape::Disc {
            centre_m: Point3::origin(),
            axis: random.vector(1.0),
            radius_m: 0.2,
            thickness_m: 0.1,
            rounding_m: 0.01,
        },
        Shape::Capsule { ends_m: [Point3::new(-0.1, 0.2, 0.0), Point3::new(0.2, 0.0, 0.1)], radius_m: 0.1 },
    );
    let rim =
        Shape::Rim { centre_m: Point3::origin(), axis: random.vector(1.0), ring_radius_m: 0.3, tube_radius_m: 0.1 };
    let mut compared = 0;
    for shape in [random_prism(random).0, cube(0.02), disc, bar, rim] {
        let shape = made(&shape);
        let like = shape.zip(&shape, &|x, _| Dual::<3>::new(x, [0.0; 3])).expect("the same form");
        for _ in 0..200 {
            let place = shape.whole.centre.to_vector() + random.vector(0.5);
            let n = normal(&shape, place);
            assert!((n.norm() - 1.0).abs() < 1e-12);
            let slope = |h: f64| {
                V::from_fn(|i, _| {
                    let step = V::ith(i, h);
                    (phi(&shape, place + step) - phi(&shape, place - step)) / (2.0 * h)
                })
            };
            // 10 mm from kinks the same normal is found all round
            let smooth = (0..6).all(|i| {
                let step = V::ith(i % 3, if i < 3 { 0.01 } else { -0.01 });
                (normal(&shape, place + step) - n).norm() < 0.3
            });
            if smooth {
                assert!((slope(1e-5) - n).norm() < 1e-7, "{} and {n}", slope(1e-5));
                let dual = |i: usize| Dual::new(place[i], V::ith(i, 1.0).into());
                let found = like.whole.distance(V3 { x: dual(0), y: dual(1), z: dual(2) });
                assert!((V::from(found.phi.slopes) - n).norm() < 1e-12);
                assert!(
                    V::new(found.normal.x.slopes[0], found.normal.y.slopes[1], found.normal.z.slopes[2])
                        .norm()
                        .is_finite()
                );
                compared += 1;
            }
        }
    }
    assert!(compared > 300, "{compared}");
}

#[test]
fn where_faces_are_equally_near_the_normal_is_a_unit_vector() {
    let axis = V::z();
    let disc =
        made(&Shape::Disc { centre_m: Point3::origin(), axis, radius_m: 0.2, thickness_m: 0.4, rounding_m: 0.0 });
    let rim = made(&Shape::Rim { centre_m: Point3::origin(), axis, ring_radius_m: 0.2, tube_radius_m: 0.02 });
    let bar = made(&Shape::Capsule { ends_m: [Point3::origin(), Point3::new(0.0, 0.0, 1.0)], radius_m: 0.1 });
    let (sharp, round) = (made(&cube(0.0)), made(&cube(0.02)));
    let on_corner = V::new(0.2, 0.1, 0.05);
    let drawn_in = V::new(0.18, 0.08, 0.03);
    let ties = [
        (&sharp, V::zeros()),
        (&sharp, on_corner),
        (&sharp, V::new(0.2, 0.1, 0.0)),
        (&sharp, V::new(0.17, 0.07, 0.02)),
        (&round, drawn_in),
        (&disc, V::zeros()),
        (&disc, V::new(0.2, 0.0, 0.2)),
        (&disc, V::new(0.0, 0.0, 0.3)),
        (&rim, V::zeros()),
        (&rim, V::new(0.0, 0.2, 0.0)),
        (&bar, V::zeros()),
        (&bar, V::new(0.0, 0.0, 0.5)),
        (&bar, V::new(0.0, 0.0, -1.0)),
    ];
    for (shape, place) in ties {
        assert!((normal(shape, place).norm() - 1.0).abs() < 1e-15, "{place}");
        assert!((0..shape.faces.len()).all(|k| {
            let kept = shape.distance(V3::of(&place), FACE + k as f64);
            (kept.normal.to_vector().norm() - 1.0).abs() < 1e-15 && kept.phi.is_finite()
        }));
    }
}

#[test]
fn shapes_without_thickness_are_refused() {
    let at = Point3::new;
    let prism = |corners_m: &[Point3<f64>], rounding_m| Shape::Prism {
        corners_m: corners_m.to_vec(),
        half_width_m: 0.1,
        rounding_m,
    };
    let square = [at(0.0, 0.0, 0.0), at(0.0, 1.0, 0.0), at(1.0, 1.0, 0.0), at(1.0, 0.0, 0.0)];
    let [a, b, c, d] = square;
    assert!(build(&prism(&square, 0.05)).is_ok());
    for (shape, word) in [
        (prism(&[a, b], 0.0), "2 corners"),
        (prism(&[a, b, at(0.0, 2.0, 0.0)], 0.0), "one line"),
        (prism(&[a, b, c, at(1.0, 0.0, 0.01)], 0.0), "off the plane"),
        (prism(&[a, b, c, d, at(0.5, 0.5, 0.0)], 0.0), "convex hull"),
        (prism(&[a, b, c, d, a], 0.0), "convex hull"),
        (prism(&square, 0.1), "rounded"),
        (prism(&[a, b, at(0.05, 0.5, 0.0)], 0.09), "take away"),
        (Shape::Prism { corners_m: square.to_vec(), half_width_m: 0.0, rounding_m: 0.0 }, "half width"),
        (Shape::Capsule { ends_m: [a, a], radius_m: 0.1 }, "one place"),
        (Shape::Rim { centre_m: a, axis: V::z(), ring_radius_m: 0.1, tube_radius_m: 0.1 }, "tube"),
        (Shape::Disc { centre_m: a, axis: V::zeros(), radius_m: 0.1, thickness_m: 0.1, rounding_m: 0.0 }, "axis"),
        (Shape::HalfSpace { point_m: at(f64::NAN, 0.0, 0.0), normal: V::z() }, "finite"),
    ] {
        let (found, _) = build(&shape).expect_err("a shape without thickness");
        assert!(found.contains(word), "{found}");
    }
}

/// Leads a sphere of radius `r` along a closed path with commits; returns the work that an elastic force of 1 N/m takes and
/// the largest jump of φ at a commit, and whether φ_k was ever another than φ.
fn led(shape: &Faced<f64>, r: f64, steps: usize, path: impl Fn(f64) -> V) -> (f64, f64, bool) {
    let (mut phase, mut work, mut jump, mut was_other) = (OPEN, 0.0, 0.0f64, false);
    let mut at = path(0.0);
    shape.commit(V3::of(&at), r, &mut phase);
    for i in 1..=steps {
        let next = path(i as f64 / steps as f64);
        let middle = shape.distance(V3::of(&(0.5 * (at + next))), phase);
        work += (r - middle.phi).max(0.0) * middle.normal.to_vector().dot(&(at - next));
        let before = shape.distance(V3::of(&next), phase).phi;
        let after = shape.commit(V3::of(&next), r, &mut phase).phi;
        if before < r {
            jump = jump.max((after - before).abs());
        }
        was_other |= phi(shape, next) > after + 1e-9;
        at = next;
    }
    (work, jump, was_other)
}

#[test]
fn closed_paths_take_no_work_however_deep() {
    let random = &mut Random(3);
    let (mut deep, mut most) = (0, [0.0f64; 2]);
    for i in 0..20 {
        let shape = if i % 2 == 0 { cube(0.0) } else { random_prism(random).0 };
        let shape = made(&shape);
        // from outside through the middle, out behind, and back by another way
        let (middle, wide) = (shape.whole.centre.to_vector(), random.turn().column(0).into_owned());
        let tall = random.vector(0.2);
        let path = |t: f64| {
            let (sine, cosine) = (std::f64::consts::TAU * t).sin_cos();
            middle + wide * cosine + tall * (sine + 0.5 * sine * cosine)
        };
        for (most, steps) in most.iter_mut().zip([8_000, 64_000]) {
            let (work, jump, was_other) = led(&shape, 0.1, steps, path);
            *most = most.max(work.abs());
            deep += usize::from(was_other && steps == 8_000);
            assert!(jump < 1e-12, "{i}: φ_k jumps by {jump}");
        }
    }
    // of some 0.5 J that are put in; where N̂ turns at once the sum is first order in the step
    assert!(most[0] < 4e-4 && most[1] < 5e-5, "{most:?}");
    assert!(deep > 5, "only {deep} paths went past the middle");
}

#[test]
fn a_sphere_led_round_at_one_depth_takes_no_work() {
    let random = &mut Random(4);
    for _ in 0..10 {
        let (shape, corners, ..) = random_prism(random);
        let shape = made(&shape);
        let (r, middle) = (0.08, shape.whole.centre.to_vector());
        // where φ = 0.03 on rays round the section; the force is 0.05 N, the way about 2 m
        let ahead = (corners[0] - middle).normalize();
        let aside = shape.whole.axes.z.to_vector().cross(&ahead);
        let path = |t: f64| {
            let t = std::f64::consts::TAU * t;
            let ray = ahead * t.cos() + aside * t.sin();
            let (mut low, mut high) = (0.0, 2.0);
            for _ in 0..60 {
                let half = 0.5 * (low + high);
                if phi(&shape, middle + ray * half) < 0.03 { low = half } else { high = half }
            }
            middle + ray * low
        };
        let (work, jump, was_other) = led(&shape, r, 4_000, path);
        assert!(work.abs() < 1e-6 && jump < 1e-12 && !was_other, "{work} {jump} {was_other}");
    }
}

#[test]
fn a_cushion_that_is_pressed_through_pushes_up_and_lets_out_sideways() {
    let shape = made(&Shape::block(Point3::origin(), V::new(0.5, 0.5, 0.1), &Matrix3::identity(), 0.0));
    let (r, mut phase) = (0.03, OPEN);
    // the centre down to 95 % of the thickness, then out to the side
    let down = (0..=100).map(|i| V::new(0.0, 0.02, 0.1 - 0.145 * i as f64 / 100.0));
    let aside = (0..=300).map(|i| V::new(0.0, 0.02 + 0.35 * i as f64 / 300.0, -0.045));
    let mut last = 0.0;
    for place in down.chain(aside) {
        let centre = V3::of(&place);
        let before = shape.distance(centre, phase).phi;
        let found = shape.commit(centre, r, &mut phase);
        assert!((before - found.phi).abs() < 1e-12 || before >= r);
        // slope 1: no jump between places either
        assert!(last == 0.0 || (found.phi - last).abs() < 2e-3, "{last} → {}", found.phi);
        last = found.phi;
        if place.y == 0.02 && place.z < 0.07 {
            assert_eq!(found.normal.to_vector(), V::z());
        }
    }
    assert_eq!(phase, OPEN);
}

#[test]
fn a_head_thrown_at_a_seat_back_never_comes_out_behind() {
    let shape = made(&Shape::block(Point3::origin(), V::new(0.12, 0.5, 0.6), &Matrix3::identity(), 0.02));
    let (r, mass, k, h) = (0.09, 5.0, 60e3, 1e-5);
    let force = |x: V, phase: f64| {
        let d = shape.distance(V3::of(&x), phase);
        d.normal.to_vector() * (k * (r - d.phi).max(0.0))
    };
    let energy = |x: V, v: V, phase: f64| {
        let depth = (r - shape.distance(V3::of(&x), phase).phi).max(0.0);
        0.5 * mass * v.norm_squared() + 0.5 * k * depth * depth
    };
    let mut deepest = 0.0f64;
    for height in 0..10 {
        for direction in 0..60 {
            let turn = std::f64::consts::TAU * direction as f64 / 60.0;
            // more than half the thickness below the top: nearer to it a head goes over
            let aim = V::new(0.0, 0.0, 0.02 * height as f64);
            let flight = V::new(turn.cos(), 0.1, turn.sin()).normalize();
            let (mut x, mut v, mut phase) = (aim - flight * 0.8, flight * 14.0, OPEN);
            while phi(&shape, x) > r + 0.01 && x.norm() < 2.0 {
                x += flight * 0.005;
            }
            let begun = energy(x, v, phase);
            let mut came_in = None;
            for _ in 0..6000 {
                shape.commit(V3::of(&x), r, &mut phase);
                let here = shape.distance(V3::of(&x), phase);
                if here.phi < r {
                    came_in.get_or_insert_with(|| shape.faces[(phase - FACE) as usize].normal.to_vector());
                    deepest = deepest.max(r - here.phi);
                    assert!(force(x, phase).norm() > 0.0);
                } else if let (Some(side), true) = (came_in, v.dot(&x) > 0.0) {
                    // out again: not through the face that looks away from where it came in
                    assert!(
                        here.normal.to_vector().dot(&side) > -0.5,
                        "{direction} {height}: in by {side}, out by {}",
                        here.normal.to_vector()
                    );
                    break;
                }
                let a = |x: V| force(x, phase) / mass;
                // velocity Verlet
                let half = v + a(x) * (0.5 * h);
                x += half * h;
                v = half + a(x) * (0.5 * h);
            }
            assert!((energy(x, v, phase) / begun - 1.0).abs() < 1e-2, "{}", energy(x, v, phase) / begun);
        }
    }
    assert!(deepest > r + 0.01, "the centre went in: {deepest}");
}
