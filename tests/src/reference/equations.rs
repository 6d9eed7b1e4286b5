//! Lagrange's equations (Eqs 47–53): D q̈ = E + F_p + F_s + Q_f + R.

use super::{
    DOF, System,
    dual::{Dual, Number},
    energy::{gravity_energy, kinetic_energy, spine_energy},
    forces::contact_forces,
    joints::damping_forces,
};
use nalgebra::{DMatrix, DVector};
use occupant_core::body::Body;

/// Every term of Eq. 53, and its solution.
#[derive(Clone, Debug)]
pub struct Equations {
    /// D.
    pub d: DMatrix<f64>,
    /// E, what is left of the kinetic energy's part with its sign reversed.
    pub e: [f64; DOF],
    /// F_p, gravity.
    pub f_p: [f64; DOF],
    /// F_s, springs.
    pub f_s: [f64; DOF],
    /// Q_f, external forces.
    pub q_f: [f64; DOF],
    /// R, dampers.
    pub r: [f64; DOF],
    /// q̈.
    pub accelerations: [f64; DOF],
}

/// All terms of Eq. 53 in one state.
///
/// # Panics
/// If D is not positive definite: at a singular posture.
pub fn equations_of_motion(system: &System, q: &[f64; DOF], rates: &[f64; DOF]) -> Equations {
    let System { body, joints, gravity, forces } = system;
    let d = mass_matrix(body, q, rates);
    let e = velocity_forces(body, q, rates);
    let f_p = std::array::from_fn(|j| -gravity_energy(body, gravity, &varied(q, j)).slope); // (51a)
    let f_s = std::array::from_fn(|j| -spine_energy(joints, &varied(q, j)).slope); // (51b)
    let q_f = contact_forces(body, forces, q);
    let r = damping_forces(joints, q, rates);
    let right = DVector::from_fn(DOF, |j, _| e[j] + f_p[j] + f_s[j] + q_f[j] + r[j]);
    let solution = d.clone().cholesky().expect("D is positive definite").solve(&right);
    let accelerations = std::array::from_fn(|j| solution[j]);
    Equations { d, e, f_p, f_s, q_f, r, accelerations }
}

/// D_jk = ∂²U/∂q̇_j∂q̇_k.
pub fn mass_matrix(body: &Body, q: &[f64; DOF], rates: &[f64; DOF]) -> DMatrix<f64> {
    let still = q.map(Number::constant);
    DMatrix::from_fn(DOF, DOF, |j, k| {
        let pushed = varied(&varied(rates, j), k);
        kinetic_energy::<Dual<Dual<f64>>>(body, &still, &pushed).slope.slope
    })
}

/// E_j = ∂U/∂q_j − Σ_k (∂²U/∂q̇_j∂q_k) q̇_k.
pub fn velocity_forces(body: &Body, q: &[f64; DOF], rates: &[f64; DOF]) -> [f64; DOF] {
    std::array::from_fn(|j| {
        let direct = kinetic_energy(body, &varied(q, j), &rates.map(Number::constant)).slope;
        let moved: [Dual<Dual<f64>>; DOF] =
            std::array::from_fn(|i| Dual::new(Dual::constant(q[i]), Dual::constant(rates[i])));
        let pushed = varied(rates, j).map(|rate| Dual::new(rate, Dual::constant(0.0)));
        direct - kinetic_energy(body, &moved, &pushed).slope.slope
    })
}

/// `x` with its element `j` as the variable of differentiation.
pub(super) fn varied<T: Number>(x: &[T; DOF], j: usize) -> [Dual<T>; DOF] {
    std::array::from_fn(|i| Dual::new(x[i], T::constant(if i == j { 1.0 } else { 0.0 })))
}
