//! Loads at the joints, against what a joint can and cannot carry.

use approx::assert_relative_eq;
use nalgebra::Vector3;
use occupant_core::body::tti12::{self, TTI12};
use occupant_core::model::Model;
use occupant_core::model::setup::Integrator;
use occupant_core::results::channel::{channels, find, matching};
use occupant_core::results::reaction::{femur_axial_n, reaction};
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use occupant_tests::cart::lap;
use occupant_tests::measure::assert_below;
use occupant_tests::room::setup;

fn cart() -> Model {
    Model::new(lap(Integrator::Rk4 { step_s: 2e-4 })).unwrap()
}

/// Calls `look` at every output of the lap case, contacts, belt and stops at work.
fn watch(model: &Model, mut look: impl FnMut(&Sample<'_>)) {
    let mut outputs = 0;
    let watched = Watch(|s: &Sample<'_>| {
        outputs += 1;
        look(s);
    });
    simulate(model, watched).unwrap();
    assert_eq!(outputs, 201);
}

#[test]
fn a_ball_joint_carries_no_moment_but_that_of_its_damper_stop_and_spring() {
    let mut worst = 0.0_f64;
    let mut greatest = 0.0_f64;
    watch(&cart(), |s| {
        let k = &s.evaluation.kinematics;
        let joints = &s.model.system().forces.joints;
        for (i, ball) in joints.balls.iter().enumerate() {
            let (joint, outer) = (ball.joint, ball.segments.1);
            let moment = joints.ball(i, k).moment;
            let passive = k.axes[outer].into_frame(moment).to_vector();
            let carried = reaction(s, joint).moment_n_m;
            worst = worst.max((carried - passive).norm());
            greatest = greatest.max(carried.norm());
        }
    });
    // measured: 1.5e-12 of up to 1.1e3 N·m
    assert!(greatest > 100.0, "{greatest}");
}

#[test]
fn a_hinge_carries_its_torque_about_its_axis_and_more_across() {
    let mut worst = 0.0_f64;
    let mut across = 0.0_f64;
    watch(&cart(), |s| {
        let k = &s.evaluation.kinematics;
        let joints = &s.model.system().forces.joints;
        let passive = joints.loads(k, s.state, &s.model.system().skeleton.layout).wrench;
        for joint in joints.hinges.iter().map(|hinge| hinge.joint) {
            let n = TTI12[joint].distal.index();
            let torque = k.axes[n].y.dot(passive[n].moment);
            let carried = reaction(s, joint).moment_n_m;
            worst = worst.max((carried.y - torque).abs());
            across = across.max(carried.xz().norm());
        }
    });
    assert!(across > 1.0, "{across}");
}

#[test]
fn the_halves_at_t1_pull_with_the_same_force_and_the_whole_body_obeys_newton() {
    let mut worst = 0.0_f64;
    watch(&cart(), |s| {
        let skeleton = &s.model.system().skeleton;
        let (k, a) = (&s.evaluation.kinematics, &s.evaluation.accelerations);
        // all that the lower half needs, by Newton's law of its parts and the force at T1 alone
        let mut needed = Vector3::zeros();
        for n in [0, 3, 8, 9, 10, 11] {
            let mut inertial = a.cg(skeleton, k, n).to_vector();
            inertial.z += skeleton.gravity;
            needed += inertial * skeleton.links[n].mass - s.evaluation.wrench[n].force.to_vector();
        }
        let at_t1 = reaction(s, tti12::UPPER_BACK).force_n;
        let at_t1 = k.axes[1].to_matrix() * at_t1;
        worst = worst.max((at_t1 + needed).norm());
    });
    // measured: 6.7e-12 N
}

#[test]
fn channels_say_the_same_as_reactions() {
    let model = cart();
    let neck = ["x", "y", "z"].map(|c| find(&model, &format!("neck.force.{c}")).unwrap());
    let femur = find(&model, "left_femur.axial").unwrap();
    watch(&model, |s| {
        // J211 axes: right and down instead of left and up
        let force = reaction(s, tti12::NECK).force_n;
        let told = Vector3::from(neck.each_ref().map(|c| c.value(s)));
        assert_eq!(told, Vector3::new(force.x, -force.y, -force.z));
        assert_eq!(femur.value(s), femur_axial_n(s, tti12::LEFT_THIGH));
    });
}

#[test]
fn a_hanging_head_pulls_at_the_neck_and_a_standing_one_presses() {
    // at the start nothing has moved: with the vehicle at rest the neck carries what the head weighs and what it is given
    let model = cart();
    let mut first = None;
    watch(&model, |s| {
        first.get_or_insert_with(|| {
            let r = reaction(s, tti12::NECK);
            let a = s.specific_force_m_s2(tti12::HEAD);
            (r, a)
        });
    });
    let (neck, head_reading) = first.unwrap();
    let mass_kg = model.body().segment(tti12::HEAD).mass_kg;
    // nothing but the neck touches the head: its reading times its mass is the neck's force
    assert_relative_eq!(neck.force_n, head_reading * mass_kg, epsilon = 1e-9);
    // the head stands on the neck: pushed up, which is compression
    assert!(neck.force_n.z > 0.0);
    let tension = find(&model, "neck.force.z").unwrap();
    watch(&model, |s| {
        if s.index == 0 {
            assert!(tension.value(s) < 0.0);
        }
    });
}

#[test]
fn every_channel_has_its_own_name_and_a_finite_value() {
    let model = cart();
    let all = channels(&model);
    let names: std::collections::BTreeSet<&str> = all.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names.len(), all.len());
    assert!(all.len() > 500, "{}", all.len());
    assert_eq!(matching(&model, "belt.lap.*").len(), 6);
    let near = find(&model, "head.aceleration.x").unwrap_err();
    assert_eq!(near.nearest.as_deref(), Some("head.acceleration.x"));
    watch(&model, |s| {
        for channel in &all {
            assert!(channel.value(s).is_finite(), "{}", channel.name);
        }
    });
}

#[test]
fn loads_of_the_upper_neck_are_those_at_the_condyles_and_follow_from_the_head_alone() {
    let mut driver = setup(include_str!("../../tests/data/hand/cabin.toml"), &["time.end = 0.1"]);
    driver.time.output_s = 2e-3;
    let model = Model::new(driver).unwrap();
    let channel = |name: &str| ["x", "y", "z"].map(|c| find(&model, &format!("{name}.{c}")).unwrap());
    let (force, moment) = (channel("neck.force"), channel("neck.moment"));
    let head = *model.body().segment(tti12::HEAD);
    let condyles_m = model.body().condyles_m.unwrap();
    let (mut worst, mut greatest) = (0.0_f64, 0.0_f64);
    let watched = Watch(|s: &Sample<'_>| {
        // nothing touches the head: what moves it comes through the neck. J211 axes: right and down instead of left and up
        let [f, m] = [&force, &moment].map(|of| Vector3::from(of.each_ref().map(|c| c.value(s))));
        let carried = s.specific_force_m_s2(tti12::HEAD) * head.mass_kg;
        let (omega, alpha) = (s.angular_velocity_rad_s(tti12::HEAD), s.angular_acceleration_rad_s2(tti12::HEAD));
        let by_inertia = |v: Vector3<f64>| head.inertia_kg_m2.component_mul(&v);
        let arm = Vector3::z() * head.cg_from_lower_end_m - condyles_m;
        let about_condyles = by_inertia(alpha) + omega.cross(&by_inertia(omega)) + arm.cross(&carried);
        worst = worst.max((Vector3::new(f.x, -f.y, -f.z) - carried).norm());
        worst = worst.max((Vector3::new(m.x, -m.y, -m.z) - about_condyles).norm());
        greatest = greatest.max(m.norm());
    });
    simulate(&model, watched).unwrap();
    assert_below("loads of the upper neck, N and N·m", worst, 1e-8);
    assert!(greatest > 50.0, "{greatest}");
}
