//! Every number of every group is, to the bit, what the sample said.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{UnitQuaternion, Vector3};
use occupant_cli::mcap::StoredRun;
use occupant_core::body::tti12::*;
use occupant_core::body::{Joint, Segment};
use occupant_core::forces::{Element, belt, contact, joint};
use occupant_core::results::reaction::{femur_axial_n, reaction};
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use prost_reflect::{DynamicMessage, ReflectMessage};

use super::support::{Read, field, model, numbers, parts, read, record, text};

/// Field names with the numbers expected.
type Fields = Vec<(&'static str, Vec<f64>)>;

fn v(v: Vector3<f64>) -> Vec<f64> {
    vec![v.x, v.y, v.z]
}

fn q(q: UnitQuaternion<f64>) -> Vec<f64> {
    vec![q.i, q.j, q.k, q.w]
}

fn vehicle(s: &Sample<'_>) -> Fields {
    let m = s.vehicle;
    let attitude = s.vehicle_pose.attitude;
    vec![
        ("time_s", vec![s.time_s]),
        ("position_path_m", v(s.vehicle_pose.position_m)),
        ("roll_rad", vec![attitude.roll_rad]),
        ("pitch_rad", vec![attitude.pitch_rad]),
        ("yaw_rad", vec![attitude.yaw_rad]),
        ("velocity_space_m_s", v(m.velocity_m_s)),
        ("velocity_vehicle_m_s", v(m.rotation.tr_mul(&m.velocity_m_s))),
        ("acceleration_space_m_s2", v(m.acceleration_m_s2)),
        ("acceleration_vehicle_m_s2", v(m.rotation.tr_mul(&m.acceleration_m_s2))),
        ("angular_velocity_vehicle_rad_s", v(m.rotation.tr_mul(&m.angular_velocity_rad_s))),
        ("angular_acceleration_vehicle_rad_s2", v(m.rotation.tr_mul(&m.angular_acceleration_rad_s2))),
    ]
}

fn segment(s: &Sample<'_>, segment: Segment) -> Fields {
    let [upper, lower] = s.end_points_m(segment);
    let reading = s.specific_force_m_s2(segment);
    vec![
        ("time_s", vec![s.time_s]),
        ("upper_end_vehicle_m", v(upper.coords)),
        ("lower_end_vehicle_m", v(lower.coords)),
        ("cg_vehicle_m", v(s.cg_m(segment).coords)),
        ("orientation_in_vehicle", q(s.orientation(segment))),
        ("cg_acceleration_segment_m_s2", v(s.cg_acceleration_m_s2(segment))),
        ("accelerometer_segment_m_s2", v(reading)),
        ("accelerometer_resultant_m_s2", vec![reading.norm()]),
        ("angular_acceleration_segment_rad_s2", v(s.angular_acceleration_rad_s2(segment))),
        ("angular_velocity_segment_rad_s", v(s.angular_velocity_rad_s(segment))),
        ("cg_velocity_space_m_s", v(s.cg_velocity_m_s(segment))),
    ]
}

fn sphere(s: &Sample<'_>, sphere: usize) -> Fields {
    let force = s.sphere_force_n(sphere);
    vec![
        ("time_s", vec![s.time_s]),
        ("centre_vehicle_m", v(s.sphere_centre_m(sphere).coords)),
        ("contact_force_vehicle_n", v(force)),
        ("contact_force_resultant_n", vec![force.norm()]),
        ("belt_force_vehicle_n", v(s.sphere_pull_n(sphere, None).unwrap())),
    ]
}

fn belt(s: &Sample<'_>, belt: usize) -> Fields {
    let action = &s.actions.belts[belt];
    let force = action.force.to_vector();
    vec![
        ("time_s", vec![s.time_s]),
        ("loop_force_n", vec![action.loop_force]),
        ("restraining_force_vehicle_n", v(force)),
        ("restraining_force_resultant_n", vec![force.norm()]),
        ("elongation_m", vec![action.elongation]),
        ("length_m", vec![action.length]),
        ("wrap_rad", vec![action.wrap]),
        ("stored_j", vec![action.stored]),
    ]
}

fn joints(s: &Sample<'_>) -> Fields {
    let angle = |joint| vec![s.joint_angle_rad(joint)];
    vec![
        ("time_s", vec![s.time_s]),
        ("neck_rad", angle(NECK)),
        ("right_shoulder_rad", angle(RIGHT_SHOULDER)),
        ("left_shoulder_rad", angle(LEFT_SHOULDER)),
        ("upper_back_rad", angle(UPPER_BACK)),
        ("left_elbow_rad", angle(LEFT_ELBOW)),
        ("right_elbow_rad", angle(RIGHT_ELBOW)),
        ("lower_back_rad", angle(LOWER_BACK)),
        ("right_hip_rad", angle(RIGHT_HIP)),
        ("left_hip_rad", angle(LEFT_HIP)),
        ("right_knee_rad", angle(RIGHT_KNEE)),
        ("left_knee_rad", angle(LEFT_KNEE)),
    ]
}

fn joint_load(s: &Sample<'_>, joint: Joint) -> Fields {
    let load = reaction(s, joint);
    vec![("time_s", vec![s.time_s]), ("force_segment_n", v(load.force_n)), ("moment_segment_n_m", v(load.moment_n_m))]
}

fn instruments(s: &Sample<'_>) -> Fields {
    let neck = reaction(s, NECK);
    let at_joint = neck.moment_n_m;
    let moment_n_m = s.model.body().condyles_m.map_or(at_joint, |at| at_joint - at.cross(&neck.force_n));
    // J211 axes: right and down where the segment's are left and up
    let j211 = |v: Vector3<f64>| vec![v.x, -v.y, -v.z];
    vec![
        ("time_s", vec![s.time_s]),
        ("neck_force_j211_n", j211(neck.force_n)),
        ("neck_moment_j211_n_m", j211(moment_n_m)),
        ("right_femur_axial_n", vec![femur_axial_n(s, RIGHT_THIGH)]),
        ("left_femur_axial_n", vec![femur_axial_n(s, LEFT_THIGH)]),
    ]
}

fn energy(s: &Sample<'_>) -> Fields {
    let e = &s.energy;
    vec![
        ("time_s", vec![s.time_s]),
        ("kinetic_j", vec![e.kinetic_j]),
        ("kinetic_relative_j", vec![e.kinetic_relative_j]),
        ("gravity_j", vec![e.gravity_j]),
        ("spine_j", vec![e.stored_j[joint::JointMoments::STORED[0].at]]),
        ("contacts_j", vec![e.stored_j[contact::Contacts::STORED[0].at]]),
        ("belts_j", vec![e.stored_j[belt::Belts::STORED[0].at]]),
        ("lost_contacts_j", vec![e.lost_j[contact::PRESS]]),
        ("lost_friction_j", vec![e.lost_j[contact::FRICTION]]),
        ("lost_joints_j", vec![e.lost_j[joint::DAMPING]]),
        ("lost_belts_j", vec![e.lost_j[belt::STRETCH]]),
        ("vehicle_work_j", vec![e.vehicle_work_j]),
        ("balance_j", vec![e.balance_j]),
    ]
}

fn solver(s: &Sample<'_>) -> Fields {
    vec![
        ("time_s", vec![s.time_s]),
        ("steps", vec![s.effort.steps as f64]),
        ("rejected", vec![s.effort.rejected as f64]),
        ("evaluations", vec![s.effort.evaluations as f64]),
        ("last_step_s", vec![s.effort.step_s]),
    ]
}

fn coordinates(s: &Sample<'_>) -> Fields {
    let c = s.report_coordinates().unwrap();
    vec![("time_s", vec![s.time_s]), ("q_m_or_rad", c.q.to_vec()), ("q_rate_m_s_or_rad_s", c.rates.to_vec())]
}

/// All groups of a sample by topic.
fn expected(s: &Sample<'_>) -> BTreeMap<String, Fields> {
    let mut groups = BTreeMap::from([
        ("/vehicle".to_owned(), vehicle(s)),
        ("/occupant/joints".to_owned(), joints(s)),
        ("/occupant/instruments".to_owned(), instruments(s)),
        ("/energy".to_owned(), energy(s)),
        ("/solver".to_owned(), solver(s)),
        ("/occupant/report_coordinates".to_owned(), coordinates(s)),
    ]);
    for n in TTI12.segments() {
        groups.insert(format!("/occupant/segment/{}", TTI12[n].name), segment(s, n));
    }
    for joint in TTI12.joints() {
        let topic = format!("/occupant/joint/{}", TTI12[joint].name);
        groups.insert(topic, joint_load(s, joint));
    }
    for (i, own) in s.model.body().spheres.iter().enumerate() {
        groups.insert(format!("/occupant/sphere/{}", own.name), sphere(s, i));
    }
    for (i, own) in s.model.setup().belts.iter().enumerate() {
        groups.insert(format!("/belt/{}", own.name), belt(s, i));
    }
    groups
}

fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|x| x.to_bits()).collect()
}

#[test]
fn every_number_comes_back_to_the_bit() {
    let model = model();
    let mut samples = Vec::new();
    let (bytes, _) = record(&model, Watch(|s: &Sample<'_>| samples.push(expected(s))));
    let topics = read(&bytes);
    // −10 ms to 29.5 ms by 1 ms, and the end
    assert_eq!(samples.len(), 41);
    for (k, groups) in samples.iter().enumerate() {
        for (topic, fields) in groups {
            assert_eq!(topics[topic].len(), 41, "{topic}");
            let Read { ns, sequence, message } = &topics[topic][k];
            assert_eq!(*ns, if k < 40 { k as u64 * 1_000_000 } else { 39_500_000 });
            assert_eq!(*sequence, k as u32);
            for (name, numbers_then) in fields {
                let now = numbers(&field(message, name));
                assert_eq!(bits(&now), bits(numbers_then), "{topic}.{name} at output {k}");
            }
            assert_all_named(topic, message, fields);
        }
    }
    let groups: BTreeSet<_> = samples[0].keys().collect();
    let others = topics.keys().filter(|t| !groups.contains(t));
    let others: Vec<_> = others.map(String::as_str).collect();
    let scenes = ["belts", "body", "compartment", "forces", "labels", "spheres"];
    let scenes = scenes.map(|s| format!("/scene/{s}"));
    let mut known: Vec<&str> = scenes.iter().map(String::as_str).collect();
    known.splice(0..0, ["/checkpoint", "/log"]);
    known.push("/tf");
    assert_eq!(others, known);
}

/// The state, and the history of pairs and belts, with the signs of zeros: as text every bit shows.
#[test]
fn every_checkpoint_comes_back_to_the_bit() {
    let mut checkpoints = Vec::new();
    let watch = Watch(|s: &Sample<'_>| checkpoints.push(s.checkpoint()));
    let (bytes, _) = record(&model(), watch);
    let stored = StoredRun::read(&bytes).unwrap();
    assert_eq!(stored.checkpoints.len(), 41);
    assert_eq!(format!("{:?}", stored.checkpoints), format!("{checkpoints:?}"));
}

/// Every field of the message is one that the test knows, apart from those with tests of their own.
fn assert_all_named(topic: &str, message: &DynamicMessage, fields: &Fields) {
    for own in message.descriptor().fields() {
        let elsewhere = ["touches", "application_point_segment_m"].contains(&own.name());
        let known = fields.iter().any(|(name, _)| *name == own.name());
        assert!(known || elsewhere, "{topic}.{} is tested by nothing", own.name());
    }
}

#[test]
fn touches_come_back_one_by_one() {
    type Touch = (String, [f64; 12]);
    type Load = (Vec<Touch>, Option<Vec<f64>>);
    let model = model();
    let mut samples: Vec<Vec<Load>> = Vec::new();
    let watch = Watch(|s: &Sample<'_>| {
        let of_sphere = |i: usize| {
            let own = s.contacts().filter(|c| c.sphere == i);
            let touches = own.map(|c| {
                let (f, r, p) = (c.force_n, c.friction_n, c.point_m);
                let numbers = [c.depth_m, c.normal_force_n, f.x, f.y, f.z, r.x, r.y, r.z, p.x, p.y, p.z, c.slip_m_s];
                (s.model.setup().surfaces[c.surface].name.clone(), numbers)
            });
            (touches.collect(), s.application_point_m(i).map(v))
        };
        samples.push((0..s.model.body().spheres.len()).map(of_sphere).collect());
    });
    let (bytes, _) = record(&model, watch);
    let topics = read(&bytes);
    let mut seen = BTreeSet::new();
    for (k, spheres) in samples.iter().enumerate() {
        for (i, (touches, point)) in spheres.iter().enumerate() {
            let topic = format!("/occupant/sphere/{}", model.body().spheres[i].name);
            let message = &topics[&topic][k].message;
            let read: Vec<Touch> = parts(message, "touches").iter().map(read_touch).collect();
            assert_eq!(&read, touches, "{topic} at output {k}");
            assert_eq!(message.has_field_by_name("application_point_segment_m"), point.is_some());
            if let Some(point) = point {
                let now = numbers(&field(message, "application_point_segment_m"));
                assert_eq!(bits(&now), bits(point));
            }
            seen.extend(touches.iter().map(|(surface, _)| surface.clone()));
        }
    }
    // the test would say nothing of a run without contact
    assert!(seen.contains("Front cushion") && seen.len() >= 2, "{seen:?}");
}

fn read_touch(message: &DynamicMessage) -> (String, [f64; 12]) {
    let mut all = Vec::new();
    for name in ["depth_m", "normal_force_n"] {
        all.extend(numbers(&field(message, name)));
    }
    for name in ["force_vehicle_n", "friction_vehicle_n", "point_vehicle_m"] {
        all.extend(numbers(&field(message, name)));
    }
    all.extend(numbers(&field(message, "slip_m_s")));
    (text(message, "surface"), all.try_into().unwrap())
}
