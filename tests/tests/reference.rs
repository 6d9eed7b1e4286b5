//! The reference formulation against laws that it was not built from: Newton and Euler, momentum, power, symmetry.

use nalgebra::{DMatrix, DVector, Vector3};
use occupant_tests::{
    random::Random,
    reference::{DOF, Dual, System, equations_of_motion, gravity_energy, kinetic_energy, spine_energy},
    segment_motion::segment_motions,
    space_state::SpaceState,
};

type Point = [f64; DOF];

/// Twenty random bodies in twenty random states.
fn scenes() -> impl Iterator<Item = (System, Point, Point)> {
    (0..20).map(|seed| {
        let mut random = Random::new(seed);
        let system = random.system();
        let (q, rates) = random.report_state();
        (system, q, rates)
    })
}

#[test]
fn the_mass_matrix_is_symmetric_and_positive_definite() {
    let (mut skew, mut least): (f64, f64) = (0.0, f64::INFINITY);
    for (system, q, rates) in scenes() {
        let d = equations_of_motion(&system, &q, &rates).d;
        let scale = d.diagonal().map(|x| 1.0 / x.sqrt());
        let scaled = DMatrix::from_fn(DOF, DOF, |j, k| scale[j] * d[(j, k)] * scale[k]);
        skew = skew.max((&scaled - scaled.transpose()).amax());
        least = least.min(scaled.symmetric_eigenvalues().min());
    }
    assert!(skew < 1e-14, "{skew:e}"); // Measured: 1.2e-16.
    assert!(least > 1e-3, "{least:e}"); // Measured: 4.2e-3, the least of 20 scenes.
}

#[test]
fn newton_and_euler_give_the_same_equations_of_motion() {
    let mut worst: f64 = 0.0;
    for (system, q, rates) in scenes() {
        let equations = equations_of_motion(&system, &q, &rates);
        let (d, e) = newton_euler(&system, &q, &rates);
        for j in 0..DOF {
            for k in 0..DOF {
                let size = (d[(j, j)] * d[(k, k)]).sqrt();
                worst = worst.max((equations.d[(j, k)] - d[(j, k)]).abs() / size);
            }
            worst = worst.max((equations.e[j] - e[j]).abs() / e.amax());
        }
    }
    assert!(worst < 1e-12, "{worst:e}"); // Measured: 6.9e-16.
}

/// D = Σ M JᵀJ + J_ωᵀ I J_ω and E = −Σ M Jᵀa₀ + J_ωᵀ(I α₀ + ω × I ω), a₀ and α₀ the accelerations for q̈ = 0, all from
/// the positions and from ω× = Ṫ Tᵀ: neither an energy nor Eqs 44–46 enter.
fn newton_euler(system: &System, q: &Point, rates: &Point) -> (DMatrix<f64>, DVector<f64>) {
    let motion = segment_motions(&system.body, q, rates, &[0.0; DOF]);
    let mut d = DMatrix::zeros(DOF, DOF);
    let mut e = DVector::zeros(DOF);
    let push = |j: usize| {
        let unit = std::array::from_fn(|k| if j == k { 1.0 } else { 0.0 });
        segment_motions(&system.body, q, &unit, &[0.0; DOF])
    };
    let columns: Vec<_> = (0..DOF).map(push).collect();
    for (i, segment) in system.body.segments.iter().enumerate() {
        let (mass, inertia) = (segment.mass_kg, motion[i].inertia);
        for (j, column) in columns.iter().enumerate() {
            let (v, omega) = (column[i].velocity, column[i].omega);
            e[j] -= mass * v.dot(&motion[i].acceleration) + omega.dot(&motion[i].moment);
            for (k, other) in columns.iter().enumerate() {
                d[(j, k)] += mass * v.dot(&other[i].velocity) + omega.dot(&(inertia * other[i].omega));
            }
        }
    }
    (d, e)
}

#[test]
fn forces_change_the_whole_body_s_momentum_and_joints_do_not() {
    let mut worst: f64 = 0.0;
    for (system, q, rates) in scenes() {
        let accelerations = equations_of_motion(&system, &q, &rates).accelerations;
        let motion = segment_motions(&system.body, &q, &rates, &accelerations);
        let (mut linear, mut angular, mut size) = (Vector3::zeros(), Vector3::zeros(), 0.0);
        for (segment, properties) in motion.iter().zip(&system.body.segments) {
            let push = properties.mass_kg * (segment.acceleration - system.gravity);
            linear += push;
            angular += segment.place.cross(&push) + segment.moment;
            size += push.norm();
        }
        for force in &system.forces {
            let segment = &motion[force.segment.index()];
            let cg = system.body.segment(force.segment).cg_from_lower_end_m;
            let arm = segment.turn * (force.point - Vector3::z() * cg);
            linear -= force.force;
            angular -= (segment.place + arm).cross(&force.force);
        }
        worst = worst.max(linear.amax() / size).max(angular.amax() / size);
    }
    assert!(worst < 1e-12, "{worst:e}"); // Measured: 3.0e-15.
}

#[test]
fn kinetic_energy_grows_by_the_power_of_the_forces() {
    let mut worst: f64 = 0.0;
    for (system, q, rates) in scenes() {
        let s = equations_of_motion(&system, &q, &rates);
        let growth = kinetic_energy(&system.body, &moving(&q, &rates), &moving(&rates, &s.accelerations)).slope;
        let parts = [&s.f_p, &s.f_s, &s.q_f, &s.r].map(|f| dot(f, &rates));
        let power: f64 = parts.iter().sum();
        let size: f64 = parts.iter().map(|p| p.abs()).sum();
        worst = worst.max((growth - power).abs() / size);
        assert!(parts[3] < 0.0, "dampers take energy");
    }
    assert!(worst < 1e-12, "{worst:e}"); // Measured: 4.9e-15.
}

#[test]
fn velocity_forces_balance_the_change_of_the_mass_matrix() {
    // q̇·E = −½ q̇ᵀ Ḋ q̇, Ḋ by central differences of order 4 of D itself.
    let mut worst: f64 = 0.0;
    for (system, q, rates) in scenes() {
        let u = DVector::from_row_slice(&rates);
        let h = 1e-4;
        let energy = |n: f64| {
            let there = std::array::from_fn(|j| q[j] + n * h * rates[j]);
            let d = equations_of_motion(&system, &there, &rates).d;
            0.5 * u.dot(&(d * &u))
        };
        let change = (8.0 * (energy(1.0) - energy(-1.0)) - (energy(2.0) - energy(-2.0))) / (12.0 * h);
        let power = dot(&equations_of_motion(&system, &q, &rates).e, &rates);
        worst = worst.max((power + change).abs() / change.abs());
    }
    assert!(worst < 1e-9, "{worst:e}"); // Measured: 1.4e-11.
}

#[test]
fn gravity_and_springs_are_slopes_of_their_energies() {
    // Central differences of order 4 of V_p and V_s.
    let mut worst: f64 = 0.0;
    for (system, q, rates) in scenes() {
        let s = equations_of_motion(&system, &q, &rates);
        let weight = system.body.mass_kg() * system.gravity.z;
        assert!((s.f_p[2] - weight).abs() < 1e-12 * weight.abs());
        let gravity = |q: &Point| gravity_energy(&system.body, &system.gravity, q);
        let springs = |q: &Point| spine_energy(&system.joints, q);
        for j in 0..DOF {
            worst = worst.max((s.f_p[j] + slope(&gravity, &q, j)).abs() / weight.abs());
            worst = worst.max((s.f_s[j] + slope(&springs, &q, j)).abs() / 400.0);
        }
    }
    assert!(worst < 1e-9, "{worst:e}"); // Measured: 6.6e-12.
}

#[test]
fn a_turned_scene_moves_the_same_way() {
    // Euler angles, D, E and all forces differ in the two scenes; only the motion is the same.
    let mut worst: f64 = 0.0;
    for (system, q, rates) in scenes() {
        let state = SpaceState::from_report(&system.body, &q, &rates);
        let here = system.accelerations_as_it_stands(&state);
        worst = worst.max(system.accelerations(&state).difference(&here));
    }
    assert!(worst < 1e-11, "{worst:e}"); // Measured: 1.1e-14.
}

#[test]
fn the_two_forms_of_a_state_convert_into_each_other() {
    let mut worst: f64 = 0.0;
    for (system, q, rates) in scenes() {
        let state = SpaceState::from_report(&system.body, &q, &rates);
        let (q2, rates2) = state.to_report();
        for j in 0..DOF {
            worst = worst.max((q[j] - q2[j]).abs()).max((rates[j] - rates2[j]).abs());
        }
    }
    assert!(worst < 1e-12, "{worst:e}"); // Measured: 5.8e-15.
}

/// x + τ ẋ.
fn moving(x: &Point, rate: &Point) -> [Dual<f64>; DOF] {
    std::array::from_fn(|j| Dual::new(x[j], rate[j]))
}

fn dot(a: &Point, b: &Point) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// ∂f/∂q_j by central differences of order 4.
fn slope(f: &impl Fn(&Point) -> f64, q: &Point, j: usize) -> f64 {
    let h = 2e-4;
    let at = |n: f64| {
        let mut there = *q;
        there[j] += n * h;
        f(&there)
    };
    (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h)
}
