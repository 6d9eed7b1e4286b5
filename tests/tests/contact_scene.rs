//! Contacts in the whole scene: the kernel's accelerations and powers with planes in space and in a moving vehicle against
//! the plain formulas fed into the reference.

use nalgebra::{Rotation3, Vector3};
use occupant_core::forces::contact::surface::Frame;
use occupant_core::forces::contact::{FRICTION, PRESS, Touch};
use occupant_core::forces::{History, Observer};
use occupant_core::kernel::{Evaluation, Situation};
use occupant_tests::{
    compartment::{Compartment, ContactForce},
    random::Random,
    reference::{SpaceMotion, System, equations_of_motion, space_accelerations},
    space_state::SpaceState,
};

/// A random body without other forces in a random compartment.
fn scene(seed: u64) -> (Random, System, Compartment) {
    let mut random = Random::new(seed);
    let mut system = random.system();
    system.forces.clear();
    let compartment = Compartment::random(&mut random);
    (random, system, compartment)
}

fn evaluate(system: &System, room: &Compartment, state: &SpaceState) -> Evaluation<f64> {
    let (kernel, frames, mut history) = room.kernel(system);
    kernel.evaluate(Situation::within(&state.to_core(), &frames), &mut history, &mut ())
}

fn accelerations(evaluation: &Evaluation<f64>) -> SpaceMotion {
    let found = &evaluation.accelerations;
    SpaceMotion::of_core(found)
}

#[test]
fn contact_forces_act_at_the_touching_point() {
    let (mut worst, mut touches): (f64, usize) = (0.0, 0);
    for seed in 0..40 {
        let (mut random, mut system, room) = scene(seed);
        let (mut q, rates) = random.report_state();
        (q[0], q[1], q[2]) = (0.1 * q[0], 0.1 * q[1], 0.1 * q[2]);
        let state = SpaceState::from_report(&system.body, &q, &rates);
        let found = evaluate(&system, &room, &state);
        let contacts = room.forces(&system, &q, &rates);
        touches += contacts.len();

        system.forces = contacts.iter().map(|c| c.force.clone()).collect();
        let solution = equations_of_motion(&system, &q, &rates).accelerations;
        let expected = space_accelerations(&q, &rates, &solution);
        worst = worst.max(accelerations(&found).difference(&expected));

        let sum = |f: fn(&ContactForce) -> f64| -> f64 { contacts.iter().map(f).sum() };
        let size = sum(|c| c.power.abs());
        let power = &found.power[0];
        let total = power.vehicle - power.sums[PRESS] - power.sums[FRICTION];
        worst = worst.max((total - sum(|c| c.power)).abs() / size);
        worst = worst.max((power.sums[FRICTION] - sum(|c| c.friction_loss)).abs() / size);
        worst = worst.max((power.vehicle - sum(|c| c.carried_power)).abs() / size);
    }
    assert!(touches > 500, "{touches}"); // Measured: 1027.
    assert!(worst < 1e-11, "{worst:e}"); // Measured: 3.9e-14.
}

#[test]
fn faces_that_are_far_at_a_commit_are_not_missed_before_the_next() {
    let mut new_touches = 0;
    for seed in 0..500 {
        let (mut random, system, room) = scene(seed);
        let (kernel, frames, mut culled) = room.kernel(&system);
        let mut state = random.space_state();
        state.t1 *= 0.1;
        let mut moved = state;
        moved.t1 += random.vector(0.025); // less than the 0.05 m that are always looked at
        let (state, moved) = (state.to_core(), moved.to_core());

        let mut before = Seen::default();
        kernel.rate(Situation::accepted(&state, &frames), &mut culled, &mut before);
        let mut all = History::new(&kernel.forces, culled.memory.clone());
        let (mut some, mut every) = (Seen::default(), Seen::default());
        let found = kernel.rate(Situation::within(&moved, &frames), &mut culled, &mut some);
        let expected = kernel.rate(Situation::within(&moved, &frames), &mut all, &mut every);
        assert_eq!(found, expected);
        assert_eq!(some.0, every.0);
        new_touches += every.0.iter().filter(|pair| !before.0.contains(pair)).count();
    }
    assert!(new_touches > 50, "{new_touches}"); // Measured: 87.
}

/// Pairs that touch.
#[derive(Default)]
struct Seen(Vec<usize>);

impl Observer<f64> for Seen {
    fn contacts(&mut self, touch: &Touch<f64>) {
        self.0.push(touch.pair);
    }
}

#[test]
fn a_scene_with_its_vehicle_turned_about_the_vertical_moves_the_same_way() {
    let mut worst: f64 = 0.0;
    for seed in 0..40 {
        let (mut random, system, room) = scene(seed);
        let room = in_the_vehicle(room);
        let state = random.vertical_state();
        let angle = random.between(-3.0, 3.0);
        let yaw = Rotation3::from_axis_angle(&Vector3::z_axis(), angle);
        let here = accelerations(&evaluate(&system, &room, &state));
        let turned = state.turned(&yaw.into());
        let there = accelerations(&evaluate(&system, &room.turned(&yaw), &turned));
        worst = worst.max(there.difference(&here.turned(&yaw.into())));
    }
    assert!(worst < 1e-11, "{worst:e}"); // Measured: 1.2e-14.
}

#[test]
fn a_scene_with_its_vehicle_in_steady_motion_accelerates_the_same() {
    let mut worst: f64 = 0.0;
    for seed in 0..40 {
        let (mut random, system, room) = scene(seed);
        let (mut room, state) = (in_the_vehicle(room), random.vertical_state());
        let here = accelerations(&evaluate(&system, &room, &state));
        let (away, speed) = (random.vector(100.0), random.vector(50.0));
        let mut moved = state;
        moved.t1 += away;
        moved.speed.t1 += speed;
        room.vehicle.origin += away;
        room.vehicle.velocity += speed;
        worst = worst.max(accelerations(&evaluate(&system, &room, &moved)).difference(&here));
    }
    assert!(worst < 1e-10, "{worst:e}"); // Measured: 1.0e-13.
}

fn in_the_vehicle(mut room: Compartment) -> Compartment {
    for surface in &mut room.surfaces {
        surface.frame = Frame::Vehicle;
    }
    room
}
