//! Several spheres in one bag: what they displace together.

use super::*;
use crate::motion::vector::v3;
use shape::{displaced, full_depth, section};
use union::{Cap, Union, lens, unite};

/// A sphere before a flat face or one of radius R, by its place beside the others and its depth.
fn cap([y, z, depth]: [f64; 3], radius: f64, face: Option<f64>) -> Cap<f64> {
    let d = depth.max(0.0);
    let ([area, volume], [_, slope]) = (displaced(d, radius, face), section(d, radius, face));
    Cap {
        on: f64::from(u8::from(depth > 0.0)),
        depth,
        closing: 0.0,
        full: full_depth(radius, face),
        radius,
        reach: 1.0,
        area,
        slope,
        volume,
        distance: radius - depth,
        gradient: v3(1.0, 0.0, 0.0),
        seen: v3(radius - depth, y, z),
        velocity: V3::zero(),
    }
}

fn together(list: &[([f64; 3], f64)], face: Option<f64>) -> Union<f64> {
    let caps: Vec<_> = list.iter().map(|(place, radius)| cap(*place, *radius, face)).collect();
    unite(&caps, face)
}

/// Lens of two discs by the formula for circular segments, also with one disc within the other or outside it.
#[test]
fn a_lens_is_two_segments_of_circles() {
    let pi = std::f64::consts::PI;
    let areas = [pi * 0.01, pi * 0.0036];
    for (d, expected) in [(0.2, 0.0), (0.03, pi * 0.0036), (0.0, pi * 0.0036)] {
        let [area, by_d, ..] = lens(d.max(1e-4), areas);
        assert!((area - expected).abs() < 1e-15 && by_d.abs() < 1e-15, "{d}: {area}");
    }
    // two equal circles through each other's middles
    let [area, ..] = lens(0.1, [pi * 0.01; 2]);
    assert!((area - 0.01 * (2.0 * pi / 3.0 - 0.75_f64.sqrt())).abs() < 1e-16);
}

/// Spheres in one place are one, a small one within a large one is nothing, and two far from each other are two.
#[test]
fn spheres_in_one_place_are_one_and_apart_they_are_as_many() {
    for face in [None, Some(0.5)] {
        for depth in [0.02, 0.09, 0.2] {
            let large = ([0.0, 0.0, depth], 0.1);
            let alone = together(&[large], face);
            for count in 2..6 {
                let many = together(&vec![large; count], face);
                // what is taken for beside each other is 0.1 mm at least, 1e-3 of the radius
                assert!((many.area / alone.area - 1.0).abs() < 2e-3 * count as f64, "{count} {depth}: {}", many.area);
                assert!((many.volume / alone.volume - 1.0).abs() < 2e-3 * count as f64, "{count} {depth}");
            }
            // measured: 5.5e-3, by Simpson's rule over the corner where the small one is as wide as it gets
            let within = together(&[large, ([0.01, 0.02, 0.5 * depth], 0.04)], face);
            assert!((within.volume / alone.volume - 1.0).abs() < 8e-3, "{depth}: {}", within.volume);
            assert!((within.area / alone.area - 1.0).abs() < 8e-3, "{depth}: {}", within.area);
            let apart = together(&[large, ([0.0, 0.3, depth], 0.1)], face);
            assert!((apart.area / alone.area - 2.0).abs() < 1e-14 && (apart.volume / alone.volume - 2.0).abs() < 1e-14);
        }
    }
}

/// Two deep spheres before a flat face press with the union of their discs.
#[test]
fn two_deep_spheres_press_with_the_union_of_their_discs() {
    let pi = std::f64::consts::PI;
    for d in [0.02, 0.07, 0.1, 0.15] {
        let both = together(&[([0.0, 0.0, 0.25], 0.1), ([d, 0.0, 0.25], 0.1)], None);
        let [common, ..] = lens(d.hypot(1e-4), [pi * 0.01; 2]);
        assert!((both.area - (pi * 0.02 - common)).abs() < 1e-15, "{d}: {}", both.area);
    }
}

/// By list of spheres and at 6 and 15 cm of depth: volume, m³, and area, m², counted on a grid of 0.5 mm.
const COUNTED: [[[f64; 2]; 2]; 4] = [
    [[0.001024, 0.02630], [0.003594, 0.02886]],
    [[0.001201, 0.02971], [0.004045, 0.03182]],
    [[0.001380, 0.04427], [0.006384, 0.05862]],
    [[0.002122, 0.04463], [0.007128, 0.05862]],
];

/// Areas and volumes of unions counted point by point by another program: a head of three spheres, as many more between them, a chest
/// of three, an arm before a chest.
#[test]
fn unions_are_those_that_another_program_counts() {
    let head = [([0.0, 0.0, 0.0], 0.092), ([0.0, 0.06, 0.0], 0.055), ([0.0, 0.092, -0.005], 0.032)];
    let more = [([0.02, 0.02, 0.0], 0.08), ([-0.02, 0.02, 0.0], 0.08), ([0.0, 0.03, 0.0], 0.08)];
    let chest = [([0.0, 0.0, 0.0], 0.12), ([0.065, 0.0, -0.02], 0.096), ([-0.065, 0.0, -0.02], 0.096)];
    let arm = [-0.1, -0.04, 0.02, 0.08].map(|y| ([y, 0.03, 0.03], 0.04));
    let lists = [head.to_vec(), [head, more].concat(), chest.to_vec(), [&chest[..], &arm].concat()];
    for (list, counted) in lists.iter().zip(COUNTED) {
        for (depth, [volume, area]) in [0.06, 0.15].into_iter().zip(counted) {
            let deep: Vec<_> = list.iter().map(|([y, z, d], r)| ([*y, *z, d + depth], *r)).collect();
            let union = together(&deep, None);
            let alone: f64 = deep.iter().map(|([.., d], r)| displaced(*d, *r, None)[0]).sum();
            let [v, a] = [union.volume / volume, union.area / area];
            // measured: 0.94 to 1.06; each for itself they would have 1.36 to 3.1 times the area
            assert!((0.92..1.08).contains(&v) && (0.92..1.08).contains(&a), "{depth}: {v:.3} {a:.3}");
            assert!(alone > 1.3 * area);
        }
    }
}

/// Slopes of the volume against differences, spheres of all sizes and depths among each other.
#[test]
fn forces_are_the_slopes_of_the_volume() {
    for face in [None, Some(0.45)] {
        let list = [
            ([0.0, 0.0, 0.05], 0.09),
            ([0.05, 0.01, 0.07], 0.06),
            ([0.0, 0.08, 0.03], 0.05),
            ([0.02, 0.03, 0.12], 0.04),
            ([0.021, 0.03, 0.19], 0.05),
        ];
        let union = together(&list, face);
        for (i, (slope, aside)) in union.slopes.iter().enumerate().take(list.len()) {
            let along = |k: usize| {
                let h = 1e-6;
                let [above, below] = [h, -h].map(|h| {
                    let mut moved = list;
                    moved[i].0[k] += h;
                    together(&moved, face).volume
                });
                (above - below) / (2.0 * h)
            };
            // a sphere that goes deeper comes no nearer to another before a flat face: aside has no part along the depth
            for (k, found) in [aside.y, aside.z, *slope].into_iter().enumerate() {
                assert!((found - along(k)).abs() < 2e-8, "{face:?} {i} {k}: {found} {}", along(k));
            }
            assert!(aside.x.abs() < 1e-15, "{}", aside.x);
        }
    }
}

/// A body of four spheres that overlap falls onto a closed ball, off its middle: it rises as high again.
#[test]
fn a_body_of_many_spheres_rises_as_high_again() {
    let shape = Shape::Sphere { centre_m: Point3::new(0.04, 0.03, -0.08), radius_m: 0.243 };
    let bag = Bag { shape, spheres: vec![(0, 1.0), (1, 1.0), (2, 1.5), (3, 1.0)], ..closed() };
    let mut rig = Rig::filled(&bag, 1.05 * 101_325.0, 300.0, 0.06);
    let beside = |x: f64, y: f64, z: f64| Vector3::new(x, y, z);
    rig.others =
        vec![(beside(0.08, 0.0, 0.02), 0.08), (beside(0.0, 0.07, -0.01), 0.07), (beside(0.05, 0.05, 0.03), 0.05)];
    (rig.mass, rig.gravity, rig.place) = (Some(10.0), GRAVITY, [0.32, 0.0]);
    let mut lowest = rig.place[0];
    while rig.time < 2.0 && !(rig.time > 0.1 && rig.place[1] < 0.0 && rig.place[0] > 0.31) {
        rig.step(1e-5);
        lowest = lowest.min(rig.place[0]);
    }
    assert!(lowest < 0.22, "{lowest}");
    let energy = 10.0 * (GRAVITY * (rig.place[0] - 0.32) + 0.5 * rig.place[1] * rig.place[1]);
    assert!(energy.abs() < 1e-9 * 10.0 * GRAVITY * (0.32 - lowest), "{energy:e} {lowest}");
}

/// Impulse of a dome's cover on a plate: the momentum that arrives, m A u²/(3V_f λ²(1 − λ_0)).
#[test]
fn a_cover_leaves_its_momentum_to_what_is_in_its_way() {
    let shape = Shape::Dome { axis: Vector3::z(), depth_m: 0.30, radius_m: 0.33, face_radius_m: 0.55, edge_m: 0.05 };
    let plain = Bag { shape, fires_s: 0.0, deploy_s: 0.025, spheres: vec![(0, 1.0)], ..closed() };
    let push = |cover_kg: f64, time: f64, place: [f64; 2]| {
        let mut rig = Rig::new(&[Bag { cover_kg, ..plain.clone() }]);
        (rig.time, rig.place) = (time, place);
        let own = rig.own.clone();
        rig.rates(true, time, place, &own);
        let action = rig.actions[0];
        (action.pushes[0].z, action.volume)
    };
    for (time, speed) in [(0.004, 0.0), (0.010, -5.0), (0.02, 3.0)] {
        let share: f64 = 0.02 + 0.98 * time / 0.025;
        let scale = share.cbrt();
        let place = [0.30 * scale + 0.12 - 0.01, speed];
        let blow = push(0.3, time, place).0 - push(0.0, time, place).0;
        let u = 0.30 * scale * 0.98 / 0.025 / (3.0 * share) - speed;
        let [area, _] = displaced(0.01, 0.12, Some(0.55));
        let expected = 0.3 * area * u * u / (3.0 * 0.06 * scale * scale * (1.0 - 0.02_f64.cbrt()));
        assert!((blow / expected - 1.0).abs() < 1e-9, "{time}: {blow} {expected}");
    }
    // unfolded it throws nothing, and nothing at what runs ahead of it
    assert_eq!(push(0.3, 0.03, [0.41, 0.0]).0, push(0.0, 0.03, [0.41, 0.0]).0);
    assert_eq!(push(0.3, 0.02, [0.28 + 0.12, 30.0]).0, push(0.0, 0.02, [0.28 + 0.12, 30.0]).0);
}

/// Picture of a dome compressed by a sphere: no corner is within the sphere, and the other corners are unchanged.
#[test]
fn pictures_show_a_bag_pressed_in() {
    let shape = Shape::Dome { axis: Vector3::z(), depth_m: 0.30, radius_m: 0.33, face_radius_m: 0.55, edge_m: 0.05 };
    let capsule = Shape::Capsule { ends_m: [Point3::new(0.0, -0.5, 0.2), Point3::new(0.0, 0.5, 0.2)], radius_m: 0.12 };
    for shape in [shape, capsule] {
        let bag = Bag { shape, ..closed() };
        let (middle, radius) = (Point3::new(0.02, 0.05, 0.33), 0.1);
        let place = |point: Point3<f64>| point;
        let [plain, pressed] = [&[][..], &[(middle, radius)]].map(|list| outline::sections(&bag, 1.0, place, list));
        let corners = plain.iter().zip(&pressed).flat_map(|(a, b)| a.corners_m.iter().zip(&b.corners_m));
        let mut moved = 0;
        for (before, after) in corners {
            assert!((after - middle).norm() > radius - 1e-12, "{after}");
            if (before - middle).norm() < radius {
                moved += 1;
                assert!(((after - middle).norm() - radius).abs() < 1e-12, "{after}");
            }
        }
        assert!(moved > 3, "{moved}");
    }
}

/// At the rim of a dome depths can differ by more than the distance. Forces beside each other stay as large as the discs.
#[test]
fn spheres_at_a_rim_press_no_more_than_their_discs() {
    let rim = v3(0.9, 0.8, 0.0);
    let mut most: f64 = 0.0;
    for i in 0..200 {
        let off = 0.06 * f64::from(i) / 150.0;
        let mut both = [cap([0.0, 0.0, 0.05], 0.1, None), cap([0.0, 0.0, 0.05 + off], 0.1, None)];
        for (cap, y) in both.iter_mut().zip([0.0, 0.06]) {
            (cap.seen, cap.gradient) = (v3(0.0, y, 0.0), rim);
        }
        let union = unite(&both, None);
        most = most.max(union.slopes[1].1.norm_squared().sqrt() / union.area);
        assert!(off < 0.0601 || union.slopes[1].1.norm_squared() == 0.0, "{off}: the volume does not change");
    }
    assert!((0.1..1.5).contains(&most), "{most}");
}
