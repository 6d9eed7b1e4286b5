//! Distances from shapes and what spheres displace of them.

use super::*;
use crate::motion::vector::v3;
use shape::{ShapeLaw, displaced, size};

/// A is the derivative of V, and V of a sphere wholly behind a flat face is half of it and a cylinder.
#[test]
fn the_area_is_the_derivative_of_the_volume() {
    for (r, face) in [(0.1, None), (0.1, Some(0.5)), (0.12, Some(0.09)), (0.1, Some(0.1))] {
        for i in 1..60 {
            let depth = 0.004 * f64::from(i);
            let h = 1e-5;
            let [above, below] = [depth + h, depth - h].map(|depth| displaced(depth, r, face)[1]);
            let [area, volume] = displaced(depth, r, face);
            assert!(((above - below) / (2.0 * h) - area).abs() < 1e-6, "{r} {face:?} {depth}");
            assert!(volume > 0.0);
        }
    }
    let pi = std::f64::consts::PI;
    let [area, volume] = displaced(0.25, 0.1, None);
    assert!((area - pi * 0.01).abs() < 1e-15 && (volume - pi * 0.01 * (2.0 / 3.0 * 0.1 + 0.15)).abs() < 1e-15);
    // what two balls have in common, by its own closed form at d = 0.5
    let [_, lens] = displaced(0.1, 0.1, Some(0.5));
    let cap = |r: f64, h: f64| pi * h * h * (r - h / 3.0);
    let x: f64 = (0.25 - 0.01 + 0.25) / (2.0 * 0.5);
    assert!((lens - cap(0.5, 0.5 - x) - cap(0.1, 0.1 - (0.5 - x))).abs() < 1e-15);
}

/// Distances against their gradients; along the axis and beside a dome they are those of its face and side.
#[test]
fn gradients_are_those_of_the_distances() {
    let dome = Shape::Dome {
        axis: Vector3::new(-1.0, 0.2, -0.4),
        depth_m: 0.23,
        radius_m: 0.33,
        face_radius_m: 0.533,
        edge_m: 0.1,
    };
    let ball = Shape::Sphere { centre_m: Point3::new(0.0, 0.1, 0.2), radius_m: 0.25 };
    let capsule = Shape::Capsule { ends_m: [Point3::new(0.1, -0.3, 0.0), Point3::new(0.0, 0.3, 0.1)], radius_m: 0.2 };
    for shape in [dome, ball, capsule] {
        let law = ShapeLaw::new(&Bag { shape, ..closed() });
        for i in 0..400 {
            let x = |k: f64| (f64::from(i) * k).sin() * 0.5;
            let (place, scale) = (v3(x(1.3), x(2.1), x(3.7)), 0.3 + 0.7 * x(0.9).abs());
            let near = law.near(place, scale);
            let h = 1e-6;
            for along in [v3(1.0, 0.0, 0.0), v3(0.0, 1.0, 0.0), v3(0.0, 0.0, 1.0)] {
                let [ahead, behind] = [h, -h].map(|h| law.near(place + along * h, scale).distance);
                let slope = (ahead - behind) / (2.0 * h);
                let corner = (near.gradient.dot(along) - slope).abs();
                // the dome's inside has a ridge where face and side are equally near
                assert!(corner < 1e-6 || near.distance < 0.0, "{shape:?} {place:?}: {corner:e}");
            }
        }
    }
    let law = ShapeLaw::new(&Bag { shape: dome, ..closed() });
    let axis = V3::of(&Vector3::new(-1.0, 0.2, -0.4).normalize());
    assert!((law.near(axis * 0.3, 1.0).distance - 0.07).abs() < 1e-15);
    let side = v3(0.0, 1.0, 0.5) * (1.0 / 1.25_f64.sqrt());
    assert!((law.near(side * 0.4 + axis * -0.3, 1.0).distance - 0.07).abs() < 1e-12);
}

/// Volumes of shapes against a count of points.
#[test]
fn shapes_hold_what_they_say() {
    let dome = Shape::Dome { axis: Vector3::z(), depth_m: 0.23, radius_m: 0.33, face_radius_m: 0.533, edge_m: 0.06 };
    let capsule = Shape::Capsule { ends_m: [Point3::new(0.0, -0.3, 0.25), Point3::new(0.0, 0.3, 0.25)], radius_m: 0.2 };
    let ball = Shape::Sphere { centre_m: Point3::new(0.0, 0.0, 0.3), radius_m: 0.25 };
    for (shape, off) in [(dome, 0.02), (capsule, 0.005), (ball, 0.005)] {
        let law = ShapeLaw::new(&Bag { shape, ..closed() });
        let (step, mut count) = (0.01, 0);
        for i in 0..160_i32 * 160 * 80 {
            let place = [i % 160 - 80, i / 160 % 160 - 80, i / 25_600].map(|n| step * (f64::from(n) + 0.5));
            count += i32::from(law.near(v3(place[0], place[1], place[2]), 1.0).distance < 0.0);
        }
        let counted = f64::from(count) * step.powi(3);
        let [volume, area] = size(&shape);
        assert!((volume / counted - 1.0).abs() < off, "{shape:?}: {volume} {counted}");
        assert!(area > 4.835 * volume.powf(2.0 / 3.0), "no body has less area than a ball");
    }
}

/// Nothing pulls a sphere that has come to the middle of a ball; it is held until it is out.
#[test]
fn a_sphere_in_the_middle_of_a_ball_feels_nothing_until_it_is_out() {
    let shape = Shape::Sphere { centre_m: Point3::new(0.0, 0.0, 0.0), radius_m: 0.243 };
    let bag = Bag { shape, spheres: vec![(0, 1.0)], ..closed() };
    let mut rig = Rig::filled(&bag, 103_000.0, 300.0, 0.06);
    (rig.mass, rig.place) = (Some(1000.0), [0.5, -5.0]);
    let mut bottomed = 0.0;
    while rig.place[0] > -0.35 {
        rig.step(1e-4);
        let action = rig.look();
        if action.bottoms > 0.0 {
            bottomed = rig.place[0];
            assert_eq!(action.pushes[0], V3::zero(), "{bottomed}");
        }
    }
    // came in from above, held behind the middle and down to where it leaves
    assert!(bottomed < -0.3, "{bottomed}");
    rig.run(rig.time + 0.05, 1e-4);
    assert_eq!(rig.actions[0].bottoms, 0.0);
}
