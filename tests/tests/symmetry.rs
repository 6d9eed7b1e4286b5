//! What must not matter to the simulator: which side is left, which way is forward, how fast the whole scene moves.

use nalgebra::{Point3, UnitQuaternion, Vector3};
use occupant_core::body::tti12;
use occupant_core::forces::contact::solid::Shape;
use occupant_core::model::Model;
use occupant_core::model::seating::InitialPosture;
use occupant_core::model::setup::Setup;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use occupant_tests::{
    core_side::CoreSide,
    free_run::{FreeRun, distance},
    measure::assert_below,
    random::Random,
    reference::System,
    room::setup,
    space_state::SpaceState,
};

/// Random bodies, joints, forces and states, upright ones among them.
fn scenes() -> impl Iterator<Item = (Random, System, SpaceState)> {
    (0..100).map(|seed| {
        let mut random = Random::new(seed);
        let system = random.system();
        let state = if seed % 3 == 0 { random.vertical_state() } else { random.space_state() };
        (random, system, state)
    })
}

#[test]
fn the_mirror_image_of_a_scene_moves_in_the_mirror() {
    let mut worst: f64 = 0.0;
    for (_, system, state) in scenes() {
        let here = CoreSide::new(&system, &state).accelerations.mirrored();
        let there = CoreSide::new(&system.mirrored(), &state.mirrored()).accelerations;
        worst = worst.max(there.difference(&here));
    }
    assert!(worst < 1e-11, "{worst:e}"); // Measured: 3.5e-14.
}

#[test]
fn a_symmetric_body_in_a_symmetric_state_stays_symmetric() {
    let mut worst: f64 = 0.0;
    for seed in 0..10 {
        let mut random = Random::new(seed);
        let (mut system, mut state) = (random.system(), random.space_state());
        make_symmetric(&mut system, &mut state);
        let mut run = FreeRun::new(&system);
        let start = state.to_core();
        assert!(distance(&start, &state.mirrored().to_core()) < 1e-15);
        let end = run.run(&start, 1e-3, 100);
        assert!(distance(&start, &end) > 0.1, "it moves");
        worst = worst.max(end.t1().y.abs()).max((end.hinge()[0] - end.hinge()[1]).abs());
        worst = worst.max((end.hinge_rate()[2] - end.hinge_rate()[3]).abs());
        for (left, right) in [(4, 5), (6, 7)] {
            let (l, r) = (end.omega(left), end.omega(right));
            worst = worst.max((l.x + r.x).abs()).max((l.y - r.y).abs()).max((l.z + r.z).abs());
        }
    }
    assert!(worst < 1e-9, "{worst:e}"); // Measured: 0.
}

/// Gives the right side what the left has, and puts the trunk in the mirror's plane.
fn make_symmetric(system: &mut System, state: &mut SpaceState) {
    for (left, right) in [(4, 5), (6, 7), (8, 9), (10, 11)] {
        system.body.segments[right] = system.body.segments[left];
    }
    for (left, right) in [
        (tti12::LEFT_SHOULDER, tti12::RIGHT_SHOULDER),
        (tti12::LEFT_ELBOW, tti12::RIGHT_ELBOW),
        (tti12::LEFT_HIP, tti12::RIGHT_HIP),
        (tti12::LEFT_KNEE, tti12::RIGHT_KNEE),
    ] {
        system.joints = system.joints.clone().with(right, system.joints[left]);
    }
    for slot in 0..4 {
        let about_y = state.turn[slot].angle();
        state.turn[slot] = UnitQuaternion::from_scaled_axis(Vector3::y() * about_y);
        let w = &mut state.speed.angular[slot];
        (w.x, w.z) = (0.0, 0.0);
    }
    (state.t1.y, state.speed.t1.y) = (0.0, 0.0);
    let image = state.mirrored();
    for right in [5, 7] {
        state.turn[right] = image.turn[right];
        state.speed.angular[right] = image.speed.angular[right];
    }
    for right in [1, 3] {
        state.hinge[right] = image.hinge[right];
        state.speed.hinge[right] = image.speed.hinge[right];
    }
}

#[test]
fn a_scene_turned_about_the_vertical_moves_the_same_way() {
    let mut worst: f64 = 0.0;
    for (mut random, system, state) in scenes() {
        let yaw = UnitQuaternion::from_scaled_axis(Vector3::z() * random.between(-3.0, 3.0));
        let here = CoreSide::new(&system, &state).accelerations.turned(&yaw);
        let there = CoreSide::new(&system.turned(&yaw), &state.turned(&yaw)).accelerations;
        worst = worst.max(there.difference(&here));
    }
    assert!(worst < 1e-11, "{worst:e}"); // Measured: 3.0e-14.
}

#[test]
fn a_scene_that_is_elsewhere_and_moves_steadily_accelerates_the_same() {
    let mut worst: f64 = 0.0;
    for (mut random, system, state) in scenes() {
        let mut moved = state;
        moved.t1 += random.vector(100.0);
        moved.speed.t1 += random.vector(50.0);
        let here = CoreSide::new(&system, &state).accelerations;
        let there = CoreSide::new(&system, &moved).accelerations;
        worst = worst.max(there.difference(&here));
    }
    // Places 100 m away cost three digits of arms of 0.1 m.
    assert!(worst < 1e-10, "{worst:e}"); // Measured: 2.7e-13.
}

/// A whole run in the mirror: the driver among solids, full spheres, contact with itself, belts, limits.
#[test]
fn the_mirror_image_of_a_driver_among_solids_moves_in_the_mirror() {
    let set = [
        "body.sphere_set=full",
        "materials.flesh={ k1 = \"156 kN/m\", mu1 = 0.7, friction = 0.25 }",
        "self_contact={ skin = \"flesh\" }",
        "time.end=0.12",
        "posture.settle=false",
        // the forefeet of full spheres are ahead of the heels
        "posture.heels=[0.64, 0.33]",
    ];
    let here = setup(include_str!("../../tests/data/hand/cabin.toml"), &set);
    let there = mirrored(here.clone());
    let paths = |setup: Setup| {
        let model = Model::new(setup).unwrap();
        let mut places = Vec::new();
        let look = |s: &Sample<'_>| {
            let spheres = s.model.body().spheres.iter().enumerate();
            places.push(spheres.map(|(i, sphere)| (sphere.name.clone(), s.sphere_centre_m(i))).collect::<Vec<_>>());
        };
        let outcome = simulate(&model, Watch(look)).unwrap();
        assert!(outcome.first_touches.len() > 10);
        places
    };
    let other = |name: &str| match name.split_once('_') {
        Some(("left", part)) => format!("right_{part}"),
        Some(("right", part)) => format!("left_{part}"),
        _ => name.to_owned(),
    };
    let mut worst: f64 = 0.0;
    for (here, there) in paths(here).iter().zip(&paths(there)) {
        for (name, place) in here {
            let image = there.iter().find(|(image, _)| *image == other(name)).unwrap().1;
            worst = worst.max((place.coords - Vector3::new(image.x, -image.y, image.z)).norm());
        }
    }
    assert_below("paths in the mirror, m", worst, 1e-8);
}

/// Solids, belts and seat on the other side.
fn mirrored(mut setup: Setup) -> Setup {
    let flip = |p: &mut Point3<f64>| p.y = -p.y;
    for solid in &mut setup.solids {
        match &mut solid.shape {
            Shape::Prism { corners_m, .. } => corners_m.iter_mut().for_each(flip),
            Shape::Disc { centre_m, axis, .. } | Shape::Rim { centre_m, axis, .. } => {
                flip(centre_m);
                axis.y = -axis.y;
            }
            Shape::Capsule { ends_m, .. } => ends_m.iter_mut().for_each(flip),
            Shape::HalfSpace { point_m, normal } => {
                flip(point_m);
                normal.y = -normal.y;
            }
        }
    }
    setup.belts.iter_mut().flat_map(|belt| &mut belt.anchors_m).for_each(flip);
    if let InitialPosture::Seated(seating) = &mut setup.posture {
        seating.lateral_m = -seating.lateral_m;
    }
    setup
}
