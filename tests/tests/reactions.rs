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

/// A sled with feet on the floor.
const WITH_FEET: &str = include_str!("../../scenarios/sled-17-segments.toml");

/// Loads at the sites of a shank that nothing touches, by Newton's and Euler's laws of the piece between them: what the rest of the
/// leg does not account for is the inertia of the shank less that of its two ends, a quarter of the mass each.
#[test]
fn the_piece_between_the_sites_of_a_shank_obeys_newton_and_euler() {
    let model = Model::new(setup(WITH_FEET, &[])).unwrap();
    let legs = model.body().tree.landmarks().legs;
    let (mut seen, mut greatest, mut off) = (0, [0.0_f64; 2], [0.0_f64; 2]);
    for (side, leg) in [("right", legs.right), ("left", legs.left)] {
        let (shank, foot) = (leg.unwrap().lower.index(), leg.unwrap().end.unwrap().index());
        let channel = |site: &str, what: &str| {
            let name = |axis| format!("{side}_tibia.{site}.{what}.{axis}");
            ["x", "y", "z"].map(|axis| find(&model, &name(axis)).unwrap())
        };
        let all = [("upper", "force"), ("upper", "moment"), ("lower", "force"), ("lower", "moment")];
        let all = all.map(|(site, what)| channel(site, what));
        let watched = Watch(|s: &Sample<'_>| {
            let (k, a) = (&s.evaluation.kinematics, &s.evaluation.accelerations);
            let skeleton = &s.model.system().skeleton;
            if s.evaluation.wrench[shank].force.to_vector().norm() > 0.0 {
                return;
            }
            let axes = k.axes[shank].to_matrix();
            let [upper_force, upper_moment, lower_force, lower_moment] = all.each_ref().map(|vector| {
                let told = Vector3::from(vector.each_ref().map(|c| c.value(s)));
                axes * Vector3::new(told.x, -told.y, -told.z)
            });
            let [knee, ankle] = [shank, foot].map(|n| k.joint[n].to_vector());
            let along = |share: f64| knee + (ankle - knee) * share;
            let (alpha, omega) = (a.alpha[shank].to_vector(), k.omega[shank].to_vector());
            let felt = |place: Vector3<f64>| {
                let r = place - knee;
                let up = Vector3::new(0.0, 0.0, skeleton.gravity);
                a.joint[shank].to_vector() + alpha.cross(&r) + omega.cross(&omega.cross(&r)) + up
            };
            let segment = s.model.body().segment(leg.unwrap().lower);
            let cg = knee + axes * skeleton.links[shank].cg.to_vector();
            let ends = [0.125, 0.875].map(|share| (along(share), felt(along(share)) * (0.25 * segment.mass_kg)));
            let whole = felt(cg) * segment.mass_kg;
            let inertia = axes * nalgebra::Matrix3::from_diagonal(&segment.inertia_kg_m2) * axes.transpose();
            let spin = inertia * alpha + omega.cross(&(inertia * omega));
            let about = |place: Vector3<f64>, force: Vector3<f64>| (place - along(0.25)).cross(&force);
            let force = whole - ends[0].1 - ends[1].1;
            let moment = about(cg, whole) + spin - about(ends[0].0, ends[0].1) - about(ends[1].0, ends[1].1);
            let found = lower_force - upper_force;
            let turned = lower_moment - upper_moment + about(along(0.75), lower_force);
            off = [off[0].max((found - force).norm()), off[1].max((turned - moment).norm())];
            greatest = [greatest[0].max(lower_force.norm()), greatest[1].max(upper_moment.norm())];
            seen += 1;
        });
        simulate(&model, watched).unwrap();
    }
    assert!(seen > 100, "{seen}");
    assert!(greatest[0] > 500.0 && greatest[1] > 20.0, "{greatest:?}");
    assert_below("force, N", off[0], 1e-8);
    assert_below("moment, N*m", off[1], 1e-8);
}

const DRIVER: &str = include_str!("../../scenarios/templates/right-hand-drive.toml");

/// What the toe pan pushes along the shank compresses it, but for the inertia of the foot.
#[test]
fn feet_that_are_pressed_against_the_floor_compress_the_shanks() {
    let model = Model::new(setup(DRIVER, &["time.end=100 ms"])).unwrap();
    let axial = find(&model, "right_tibia.lower.force.z").unwrap();
    let foot = model.body().tree.landmarks().legs.right.unwrap().end.unwrap();
    let mut least = (0.0_f64, 0.0);
    let watched = Watch(|s: &Sample<'_>| {
        let n = foot.index();
        let along = s.evaluation.kinematics.axes[model.body().tree.landmarks().legs.right.unwrap().lower.index()];
        let push = along.to_matrix().column(2).dot(&s.evaluation.wrench[n].force.to_vector());
        if axial.value(s) < least.0 {
            least = (axial.value(s), push);
        }
    });
    simulate(&model, watched).unwrap();
    assert!(least.0 < -300.0 && (least.1 / -least.0 - 1.0).abs() < 0.5, "{least:?}");
}
