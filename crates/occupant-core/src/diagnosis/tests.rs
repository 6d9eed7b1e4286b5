use nalgebra::{SymmetricEigen, Vector3};

use super::*;
use crate::body::tti12::TTI12;
use crate::model::setup::{Integrator, Setup};
use crate::motion::dynamics::{Wrench, solve};
use crate::motion::frame::Moving;
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::MOST_SEGMENTS;
use crate::motion::mobility::greatest;
use crate::motion::vector::V3;
use crate::results::energy::kinetic;
use crate::run::simulate::simulate;
use crate::tests::{crooked, hard, lowest_m};

/// A body in a crooked posture that nothing touches.
fn free_body() -> Model {
    Model::new(crooked(0.1, None)).unwrap()
}

/// The same body over a floor in space that its lowest spheres press by a little.
fn standing_on(friction: f64, step_ms: f64) -> Model {
    let setup = crooked(0.02, Some((lowest_m() + 0.005, hard(friction))));
    Model::new(Setup { integrator: Integrator::Rk4 { step_s: 1e-3 * step_ms }, ..setup }).unwrap()
}

#[test]
fn an_impulse_at_a_point_gives_the_kinetic_energy_that_its_mobility_says() {
    // u = D⁻¹JᵀF has ½uᵀDu = ½F·(JD⁻¹Jᵀ)F: energy and mobility come from different code
    let model = free_body();
    let mobility = mobility_of(&model);
    let k = &mobility.kinematics;
    let skeleton = &model.system().skeleton;
    let force = Vector3::new(0.7, -1.1, 0.4);
    for segment in TTI12.segments() {
        let n = segment.index();
        let arm = V3 { x: 0.05, y: -0.02, z: 0.11 };
        let mut loads = [Wrench::zero(); MOST_SEGMENTS];
        loads[n] = Wrench { force: V3::of(&force), moment: arm.cross(V3::of(&force)) };
        let base = solve(skeleton, k, &[0.0; 4], &[Wrench::zero(); MOST_SEGMENTS]);
        let pushed = solve(skeleton, k, &[0.0; 4], &loads);
        let mut moving = model.start().state.still();
        moving.set_velocity(pushed.joint[0] - base.joint[0]);
        for (slot, &n) in skeleton.layout.free().iter().enumerate() {
            moving.set_omega(slot, pushed.alpha[n] - base.alpha[n]);
        }
        for (i, rate) in moving.hinge_rate_mut().iter_mut().enumerate() {
            *rate = pushed.hinge[i] - base.hinge[i];
        }
        let energy_j = kinetic(skeleton, &Kinematics::new(skeleton, &moving), &Moving::space());
        let by_mobility = 0.5 * force.dot(&(mobility.of_point(n, k.joint[n] + arm) * force));
        // measured: 4.6e-15
        assert!((energy_j / by_mobility - 1.0).abs() < 1e-11, "{segment:?}: {energy_j} against {by_mobility}");
    }
}

#[test]
fn a_spring_rate_is_that_of_stiffness_and_mass() {
    let d = diagnose(&standing_on(0.5, 0.1));
    assert_eq!(d.sphere_rates.len(), 17);
    for s in &d.sphere_rates {
        // 50 kN/m at μ₁ = 0.5 unloads at 100 kN/m
        assert_eq!(s.rate.coefficient, 1e5, "{}", s.rate.of);
        let expected = (s.rate.effective / 1e5).sqrt();
        assert_eq!(s.rate.time_scale_s, expected);
        assert!(s.rate.effective > 0.05 && s.rate.effective < 40.0, "{s:?}");
    }
    let fastest = d.fastest.as_ref().unwrap();
    let least = d.sphere_rates.iter().map(|s| s.rate.time_scale_s);
    let least = least.chain(d.other_rates.iter().map(|r| r.time_scale_s));
    assert_eq!(fastest.time_scale_s, least.fold(f64::INFINITY, f64::min));
    assert!(d.step_is_stable());
}

#[test]
fn a_step_beyond_the_stability_limit_is_found() {
    let stable = diagnose(&standing_on(0.5, 0.1));
    let number = stable.step_by_time_scale.unwrap();
    let limit_ms = 0.1 * RK4_STABILITY_LIMIT / number;
    let just = |factor: f64| diagnose(&standing_on(0.5, limit_ms * factor));
    assert!(just(0.99).step_is_stable());
    assert!(!just(1.01).step_is_stable());
}

#[test]
fn friction_warns_where_its_stability_number_passes_that_of_the_method() {
    // the watch and the limit of `check` are two ways to the same number
    let model = standing_on(0.8, 0.1);
    let mut watch = FrictionWatch::new();
    simulate(&model, &mut watch).unwrap();
    assert!(watch.unstable(&model).is_empty(), "{:?}", watch.unstable(&model));
    assert!(watch.warnings(&model).is_empty());

    let slippery = standing_on(2000.0, 0.1);
    let mut watch = FrictionWatch::new();
    simulate(&slippery, &mut watch).unwrap();
    let found = watch.unstable(&slippery);
    let d = diagnose(&slippery);
    assert!(!found.is_empty());
    for f in &found {
        let sphere = d.sphere_rates.iter().find(|s| s.rate.of == f.sphere).unwrap();
        let limit_n = sphere.friction_limit_n.unwrap();
        let expected = friction::LIMIT * f.normal_force_n / limit_n;
        assert!((f.number / expected - 1.0).abs() < 1e-12);
        assert!(f.number > friction::LIMIT);
    }
    let spheres: std::collections::BTreeSet<&str> = found.iter().map(|f| f.sphere.as_str()).collect();
    assert_eq!(spheres.len(), found.len(), "once for each sphere and material");
}

#[test]
fn contacts_at_the_start_are_those_of_the_first_output() {
    let d = diagnose(&standing_on(0.5, 0.1));
    assert!(!d.contacts.is_empty());
    for c in &d.contacts {
        assert_eq!(c.surface, "floor");
        // on the loading curve: F = K₁Δ
        assert!((c.normal_force_n - 5e4 * c.depth_m).abs() < 1e-9 * c.normal_force_n, "{c:?}");
    }
    assert_eq!(d.body.degrees_of_freedom, 31);
    assert!((d.body.segments.iter().map(|s| s.mass_kg).sum::<f64>() - d.body.mass_kg).abs() < 1e-12);
}

#[test]
fn a_point_responds_as_the_change_of_its_velocity_under_an_impulse_says() {
    // reciprocity and positive work: the mobility is symmetric and positive for any point of any segment
    let model = free_body();
    let mobility = mobility_of(&model);
    for segment in TTI12.segments() {
        let n = segment.index();
        let point = mobility.kinematics.joint[n] + V3 { x: 0.03, y: -0.05, z: 0.1 };
        let raw = mobility.of_point(n, point);
        let eigenvalues = SymmetricEigen::new(raw).eigenvalues;
        assert!(eigenvalues.min() > 0.0, "{segment:?}: {eigenvalues}");
        // no point can be lighter than nothing or heavier than the body
        let lightest = 1.0 / greatest(raw);
        assert!(lightest < model.body().mass_kg(), "{segment:?}");
    }
}

#[test]
fn a_force_through_the_whole_body_moves_its_mass() {
    // Σ over segments of the response to M_n·g is g itself: the tree falls as one
    let model = free_body();
    let mobility = mobility_of(&model);
    let k = &mobility.kinematics;
    let skeleton = &model.system().skeleton;
    let mut loads = [Wrench::zero(); MOST_SEGMENTS];
    for (n, link) in skeleton.links.iter().enumerate() {
        let force = V3 { x: link.mass, y: 0.0, z: 0.0 };
        loads[n] = Wrench { force, moment: (k.cg(skeleton, n) - k.joint[n]).cross(force) };
    }
    let a = mobility.loaded(&loads);
    for segment in TTI12.segments() {
        let n = segment.index();
        let change = a.joint[n] - mobility.unloaded.joint[n];
        // measured: 6.7e-16, and 5.2e-15 for the angular part
        assert!((change.x - 1.0).abs() < 1e-12, "{segment:?}: {change:?}");
        assert!(a.alpha[n].norm_squared().sqrt() < 1e-11, "{segment:?}");
    }
}
