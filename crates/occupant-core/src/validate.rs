//! Checks of a [`Setup`] that need no geometry: every number finite and in its admissible range, every reference good.

use crate::body::{Body, Segment, SegmentProperties};
use crate::joint::{BallJoint, HingeJoint, Joints, Stop};
use crate::material::{BilinearSpring, Material};
use crate::problem::Problems;
use crate::setup::{Integrator, Setup, TimeSpan};

/// Reports every problem of the numbers of `setup`.
pub fn check(setup: &Setup, problems: &mut Problems) {
    check_body(&setup.body, problems);
    check_joints(&setup.joints, problems);
    check_materials(&setup.materials, problems);
    check_references(setup, problems);
    check_time(&setup.time, &setup.integrator, problems);
    if !(setup.gravity_m_s2 >= 0.0 && setup.gravity_m_s2.is_finite()) {
        problems.error(
            "gravity",
            format!("{} m/s²", setup.gravity_m_s2),
            "zero or a positive acceleration (it acts downwards)",
        );
    }
}

fn check_body(body: &Body, problems: &mut Problems) {
    for segment in Segment::ALL {
        let path = format!("body.segments.{}", segment.name());
        check_segment(body.segment(segment), &path, problems);
    }
    for (key, value) in [
        ("shoulder_half_width", body.shoulder_half_width_m),
        ("hip_half_width", body.hip_half_width_m),
    ] {
        at_least_zero(problems, &format!("body.{key}"), value, "m");
    }
    for (i, sphere) in body.spheres.iter().enumerate() {
        let path = format!("body.spheres.{}", sphere.name);
        positive(problems, &format!("{path}.radius"), sphere.radius_m, "m");
        let twin = body.spheres[..i].iter().any(|s| s.name == sphere.name);
        if twin {
            problems.error(
                &path,
                format!("a second sphere named {}", sphere.name),
                "unique names",
            );
        }
        let length = body.segment(sphere.segment).length_m;
        let z = sphere.centre_from_lower_end_m.z;
        let reach = sphere.centre_from_lower_end_m.coords.norm();
        if !reach.is_finite() {
            problems.error(
                &path,
                "a centre that is not a finite number",
                "finite coordinates",
            );
        } else if z < -0.5 * length || z > 1.5 * length {
            problems.error_with_hint(
                &path,
                format!(
                    "a centre {:.4} m along the {:.4} m long {}",
                    z,
                    length,
                    sphere.segment.name()
                ),
                "a sphere on its segment",
                "the centre is measured from the segment's lower end, upwards",
            );
        }
    }
}

fn check_segment(p: &SegmentProperties, path: &str, problems: &mut Problems) {
    positive(problems, &format!("{path}.length"), p.length_m, "m");
    positive(problems, &format!("{path}.mass"), p.mass_kg, "kg");
    let rho = p.cg_from_lower_end_m;
    if !(rho >= 0.0 && rho <= p.length_m) {
        problems.error(
            format!("{path}.cg"),
            format!(
                "ρ = {rho} m from the lower end of a segment of {} m",
                p.length_m
            ),
            "a centre of gravity between the segment's ends",
        );
    }
    let inertia = p.inertia_kg_m2;
    let mut sound = true;
    for (axis, value) in ["x", "y", "z"].iter().zip(inertia.iter()) {
        sound &= positive(
            problems,
            &format!("{path}.inertia"),
            *value,
            &format!("kg·m² about {axis}"),
        );
    }
    let sum: f64 = inertia.sum();
    for (axis, value) in ["I_x", "I_y", "I_z"].iter().zip(inertia.iter()) {
        // Iᵢ ≤ Iⱼ + Iₖ, with a part in 10⁹ for rounded input
        if sound && 2.0 * value > sum * (1.0 + 1e-9) {
            problems.error_with_hint(
                format!("{path}.inertia"),
                format!(
                    "{axis} = {value:.6} kg·m² exceeds the sum of the other two, {:.6}",
                    sum - value
                ),
                "principal moments that obey the triangle inequality",
                "no rigid body has such moments; look for a slipped digit or interchanged axes",
            );
        }
    }
}

fn check_joints(j: &Joints, problems: &mut Problems) {
    let balls = [
        ("neck", &j.neck),
        ("right_shoulder", &j.right_shoulder),
        ("left_shoulder", &j.left_shoulder),
        ("upper_back", &j.upper_back),
        ("lower_back", &j.lower_back),
        ("right_hip", &j.right_hip),
        ("left_hip", &j.left_hip),
    ];
    for (name, ball) in balls {
        check_ball(ball, &format!("joints.{name}"), problems);
    }
    let hinges = [
        ("left_elbow", &j.left_elbow),
        ("right_elbow", &j.right_elbow),
        ("right_knee", &j.right_knee),
        ("left_knee", &j.left_knee),
    ];
    for (name, hinge) in hinges {
        check_hinge(hinge, &format!("joints.{name}"), problems);
    }
    if !(0.0..=0.1).contains(&j.epsilon) {
        problems.error(
            "joints.epsilon",
            format!("{}", j.epsilon),
            "a number from 0 to 0.1",
        );
    }
}

fn check_ball(ball: &BallJoint, path: &str, problems: &mut Problems) {
    at_least_zero(
        problems,
        &format!("{path}.damping"),
        ball.damping_n_m_s,
        "N·m·s",
    );
    at_least_zero(
        problems,
        &format!("{path}.twist_damping"),
        ball.twist_damping_n_m_s,
        "N·m·s",
    );
    if let Some(stop) = &ball.stop {
        check_stop(
            stop,
            1.0,
            ball.damping_n_m_s,
            &format!("{path}.stop"),
            problems,
        );
        if stop.begin_rad < 0.0 || stop.full_rad > std::f64::consts::PI {
            problems.error(
                format!("{path}.stop"),
                format!(
                    "a stop from {:.1}° to {:.1}°",
                    stop.begin_rad.to_degrees(),
                    stop.full_rad.to_degrees()
                ),
                "angles between 0° and 180°, the range of the angle between two segments",
            );
        }
    }
    if let Some(spring) = &ball.spring {
        at_least_zero(
            problems,
            &format!("{path}.stiffness"),
            spring.stiffness_n_m,
            "N·m/rad",
        );
        if spring.rest_rad.is_some_and(|r| !r.is_finite()) {
            problems.error(
                format!("{path}.rest_angle"),
                "not a finite number",
                "an angle",
            );
        }
    }
}

fn check_hinge(hinge: &HingeJoint, path: &str, problems: &mut Problems) {
    at_least_zero(
        problems,
        &format!("{path}.damping"),
        hinge.damping_n_m_s,
        "N·m·s",
    );
    if let Some(stop) = &hinge.lower_stop {
        check_stop(
            stop,
            -1.0,
            hinge.damping_n_m_s,
            &format!("{path}.lower_stop"),
            problems,
        );
    }
    if let Some(stop) = &hinge.upper_stop {
        check_stop(
            stop,
            1.0,
            hinge.damping_n_m_s,
            &format!("{path}.upper_stop"),
            problems,
        );
    }
}

fn check_stop(stop: &Stop, sign: f64, damping: f64, path: &str, problems: &mut Problems) {
    at_least_zero(
        problems,
        &format!("{path}.damping"),
        stop.damping_n_m_s,
        "N·m·s",
    );
    let rise = sign * (stop.full_rad - stop.begin_rad);
    if !rise.is_finite() || rise < 0.0 {
        problems.error_with_hint(
            path,
            format!(
                "a stop that begins at {:.1}° and is full at {:.1}°",
                stop.begin_rad.to_degrees(),
                stop.full_rad.to_degrees()
            ),
            if sign > 0.0 {
                "`full` at or above `begin` for an upper stop"
            } else {
                "`full` at or below `begin` for a lower stop"
            },
            "interchange the two angles",
        );
    }
    if stop.damping_n_m_s < damping {
        problems.warning(
            path,
            format!(
                "damping at the stop {} N·m·s below the joint's own {damping} N·m·s",
                stop.damping_n_m_s
            ),
            "a stop that resists more than the free joint",
        );
    }
}

fn check_materials(materials: &[Material], problems: &mut Problems) {
    for m in materials {
        let path = format!("materials.{}", m.name);
        check_spring(&m.spring, &path, problems);
        at_least_zero(problems, &format!("{path}.friction"), m.friction, "");
        positive(
            problems,
            &format!("{path}.friction_speed"),
            m.friction_speed_m_s,
            "m/s",
        );
    }
}

fn check_spring(s: &BilinearSpring, path: &str, problems: &mut Problems) {
    at_least_zero(problems, &format!("{path}.k1"), s.k1_n_per_m, "N/m");
    at_least_zero(problems, &format!("{path}.k2"), s.k2_n_per_m, "N/m");
    at_least_zero(problems, &format!("{path}.break_at"), s.break_m, "m");
    for (key, value) in [("mu1", s.returned_1), ("mu2", s.returned_2)] {
        if !(0.0..=1.0).contains(&value) {
            problems.error(
                format!("{path}.{key}"),
                format!("{value}"),
                "a fraction of returned energy, from 0 to 1",
            );
        } else if value < crate::kernel::spring::LEAST_FRACTION {
            problems.warning(
                format!("{path}.{key}"),
                format!(
                    "{value}, which counts as {}",
                    crate::kernel::spring::LEAST_FRACTION
                ),
                "at least 0.01: unloading needs some slope",
            );
        }
    }
}

fn check_references(setup: &Setup, problems: &mut Problems) {
    let spheres = setup.body.spheres.len();
    for (i, surface) in setup.surfaces.iter().enumerate() {
        let path = format!("surfaces.{}", surface.name);
        if setup.surfaces[..i].iter().any(|s| s.name == surface.name) {
            problems.error(
                &path,
                format!("a second surface named {}", surface.name),
                "unique names",
            );
        }
        if surface.material >= setup.materials.len() {
            problems.error(
                format!("{path}.material"),
                "no such material",
                "a named material",
            );
        }
        if surface.spheres.iter().flatten().any(|&s| s >= spheres) {
            problems.error(
                format!("{path}.spheres"),
                "no such sphere",
                "spheres of the body",
            );
        }
    }
    for (i, belt) in setup.belts.iter().enumerate() {
        let path = format!("belts.{}", belt.name);
        if setup.belts[..i].iter().any(|b| b.name == belt.name) {
            problems.error(
                &path,
                format!("a second belt named {}", belt.name),
                "unique names",
            );
        }
        if belt.sphere >= spheres {
            problems.error(
                format!("{path}.sphere"),
                "no such sphere",
                "a sphere of the body",
            );
        }
        check_spring(&belt.webbing, &path, problems);
        if belt
            .anchors_m
            .iter()
            .any(|a| a.iter().any(|c| !c.is_finite()))
        {
            problems.error(
                format!("{path}.anchors"),
                "not finite numbers",
                "two points",
            );
        } else if (belt.anchors_m[0] - belt.anchors_m[1]).norm() < 1e-6 {
            problems.error(
                format!("{path}.anchors"),
                "two anchors in one place",
                "two points",
            );
        }
    }
}

fn check_time(time: &TimeSpan, integrator: &Integrator, problems: &mut Problems) {
    if !time.start_s.is_finite() || !time.end_s.is_finite() || time.end_s <= time.start_s {
        problems.error(
            "time",
            format!("a run from {} s to {} s", time.start_s, time.end_s),
            "an end after the start",
        );
    }
    positive(problems, "time.output", time.output_s, "s");
    match *integrator {
        Integrator::Rk4 { step_s } => {
            if positive(problems, "integrator.step", step_s, "s") {
                let steps = (time.end_s - time.start_s) / step_s;
                if steps > 1e9 {
                    problems.error(
                        "integrator.step",
                        format!("{step_s} s, {steps:.1e} steps"),
                        "fewer than 1e9 steps",
                    );
                }
            }
        }
        Integrator::Adaptive {
            relative,
            absolute_m,
            absolute_m_s,
            min_step_s,
            max_step_s,
        } => {
            positive(problems, "integrator.relative", relative, "");
            positive(problems, "integrator.absolute", absolute_m, "m");
            positive(problems, "integrator.absolute_speed", absolute_m_s, "m/s");
            positive(problems, "integrator.min_step", min_step_s, "s");
            if positive(problems, "integrator.max_step", max_step_s, "s") && max_step_s < min_step_s
            {
                problems.error(
                    "integrator.max_step",
                    format!("{max_step_s} s, below the smallest step {min_step_s} s"),
                    "a largest step above the smallest",
                );
            }
        }
    }
}

fn positive(problems: &mut Problems, path: &str, value: f64, unit: &str) -> bool {
    let good = value > 0.0 && value.is_finite();
    if !good {
        problems.error(
            path,
            format!("{value} {unit}").trim_end().to_owned(),
            "a positive number",
        );
    }
    good
}

fn at_least_zero(problems: &mut Problems, path: &str, value: f64, unit: &str) {
    if !(value >= 0.0 && value.is_finite()) {
        problems.error(
            path,
            format!("{value} {unit}").trim_end().to_owned(),
            "zero or a positive number",
        );
    }
}
