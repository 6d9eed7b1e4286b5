//! Bags that a sphere presses in.

use super::*;

fn with_sphere(bag: Bag) -> Bag {
    Bag { spheres: vec![(0, 1.0)], ..bag }
}

/// pV^γ stays.
#[test]
fn gas_that_is_pressed_together_follows_the_adiabat() {
    // a sphere as wide as 10 l at its depth of half a radius
    let volume = std::f64::consts::PI * (0.12 * 0.06 * 0.06 - 0.06_f64.powi(3) / 3.0);
    let bag = Bag { spheres: vec![(0, 0.010 / volume)], ..closed() };
    let mut rig = Rig::filled(&bag, 110_000.0, 300.0, 0.06);
    rig.place = [0.16 + 0.12, -1.0];
    rig.run(0.06, 1e-4);
    assert!((rig.actions[0].volume - 0.05).abs() < 1e-12);
    assert!((rig.absolute() - 141_986.296).abs() < 1e-3, "{}", rig.absolute());
    // measured: 4e-9, of the sum over steps
    assert!(rig.actions[0].residual < 1e-8, "{:e}", rig.actions[0].residual);
}

/// Weight of 10 kg on a bag at 1.05 p_a: it rests 25.805163 mm deep and swings with 3.221852 Hz,
/// k = γpA²/V + p_g dA/dδ.
#[test]
fn a_mass_on_a_bag_rests_and_swings_as_the_gas_spring_says() {
    let bag = with_sphere(closed());
    let mut rig = Rig::filled(&bag, 1.05 * 101_325.0, 300.0, 0.06);
    (rig.mass, rig.gravity) = (Some(10.0), GRAVITY);
    let depth = 0.025_805_163;
    // pressed in without a loss, then left a little above where it rests
    let top = 0.16 + 0.12;
    (rig.place, rig.mass) = ([top, -0.1], None);
    rig.run(depth / 0.1, depth / 0.1 / 2000.0);
    (rig.mass, rig.place[1]) = (Some(10.0), 0.0);
    let (place, own, time) = (rig.place, rig.own.clone(), rig.time);
    let acceleration = rig.rates(true, time, place, &own)[1];
    assert!(acceleration.abs() < 1e-5, "{acceleration:e}");
    rig.place[1] = 1e-4;
    let mut crossings = Vec::new();
    let mut before = rig.place[0];
    for _ in 0..20_000 {
        rig.step(1e-4);
        if before < top - depth && rig.place[0] >= top - depth {
            crossings.push(rig.time - (rig.place[0] - top + depth) / rig.place[1]);
        }
        before = rig.place[0];
    }
    let count = crossings.len() - 1;
    let frequency = count as f64 / (crossings[count] - crossings[0]);
    assert!((frequency - 3.221_852).abs() < 2e-5, "{frequency}");
}

/// A mass that falls onto a closed bag rebounds to where it fell from; on a vented one the books of body and gas close.
#[test]
fn a_mass_that_falls_onto_a_closed_bag_rises_as_high_again() {
    let bag = with_sphere(closed());
    let mut rig = Rig::filled(&bag, 1.05 * 101_325.0, 300.0, 0.06);
    (rig.mass, rig.gravity, rig.place) = (Some(10.0), GRAVITY, [0.30, 0.0]);
    let mut lowest = rig.place[0];
    while rig.time < 2.0 && !(rig.time > 0.1 && rig.place[1] < 0.0 && rig.place[0] > 0.29) {
        rig.step(1e-5);
        lowest = lowest.min(rig.place[0]);
    }
    assert!(lowest < 0.24, "{lowest}");
    let energy = 10.0 * (GRAVITY * (rig.place[0] - 0.30) + 0.5 * rig.place[1] * rig.place[1]);
    // measured: 7e-10 of what it has fallen
    assert!(energy.abs() < 1e-9 * 10.0 * GRAVITY * (0.30 - lowest), "{energy:e}");
}

/// The dome of the sketch, under a mass of 10 kg that comes at 6 m/s, fired so late that it presses on a bag hardly unfolded.
#[test]
fn work_on_a_dome_is_the_gass_even_where_it_has_hardly_unfolded() {
    let shape = Shape::Dome { axis: Vector3::z(), depth_m: 0.23, radius_m: 0.33, face_radius_m: 0.533, edge_m: 0.1 };
    let rows = vec![[0.0, 0.0, 700.0], [0.004, 2.2, 700.0], [0.02, 1.2, 600.0], [0.045, 0.0, 500.0]];
    let inflator = Inflator { gas: IDEAL, due_s: 0.0, rows, tank: None };
    let vent = Vent { area_m2: 2.5e-3, discharge: 0.7, opens_at_pa: 5e3, due_s: NEVER };
    let late = Bag { shape, fires_s: 0.0, deploy_s: 0.025, inflators: vec![inflator], vents: vec![vent], ..closed() };
    for height in [0.15, 0.25, 0.35, 0.5] {
        let mut rig = Rig::new(&[with_sphere(late.clone())]);
        (rig.mass, rig.place) = (Some(10.0), [height, -6.0]);
        let start = 0.5 * 10.0 * 36.0;
        let mut least: f64 = 0.0;
        for _ in 0..1500 {
            rig.step(1e-4);
            rig.look();
            least = least.min(rig.actions[0].pressure);
            assert!(
                rig.place[1].abs() < 60.0 && rig.absolute() < 2e6,
                "{height} at {}: {:?}",
                rig.time,
                rig.actions[0]
            );
        }
        let action = rig.actions[0];
        let lost = start - 0.5 * 10.0 * rig.place[1] * rig.place[1];
        // measured: 2e-8 of the start's energy and 3e-5 of the gas's where it fires into the sphere, 1e-11 and 2e-6 in position
        assert!((lost - action.work).abs() < 1e-7 * start, "{height}: {lost} {}", action.work);
        assert!(action.residual < 1e-4, "{height}: {:e}", action.residual);
        assert!(least >= 0.0);
    }
}

/// Forces on the sphere and on the mount are one; a second bag beside it feels nothing of it.
#[test]
fn two_bags_are_independent() {
    let one = with_sphere(closed());
    let other = Bag {
        mount_m: Point3::new(3.0, 0.0, 0.0),
        shape: Shape::Sphere { centre_m: Point3::new(3.0, 0.0, 0.2), radius_m: 0.24 },
        ..one.clone()
    };
    let mut both = Rig::new(&[one.clone(), other]);
    let mut alone = Rig::new(&[one]);
    let gas = Rig::filled(&with_sphere(closed()), 130_000.0, 350.0, 0.06).own;
    for rig in [&mut both, &mut alone] {
        let count = gas.len();
        rig.own[..count].copy_from_slice(&gas);
        (rig.mass, rig.gravity, rig.place) = (Some(10.0), GRAVITY, [0.25, -1.0]);
        rig.run(0.05, 1e-4);
    }
    assert_eq!((both.place, &both.own[..gas.len()]), (alone.place, &alone.own[..]));
    let (push, mount) = (both.actions[0].pushes[0], both.actions[0].force);
    assert!(push.z > 100.0 && mount.z == -push.z && mount.x == -push.x, "{push:?} {mount:?}");
    assert_eq!(both.actions[1].pressure, 0.0);
}
