//! Depths of a contact, measured or computed.

use super::Impactor;

/// Index of the greatest depth.
pub(super) fn greatest(depth_m: &[f64]) -> usize {
    (0..depth_m.len()).fold(0, |most, i| if depth_m[i] > depth_m[most] { i } else { most })
}

/// Measured depths from first contact on.
pub(super) fn measured(times: &[f64], depth: &[f64], from: usize, start_s: f64) -> Vec<f64> {
    let before = from.saturating_sub(1);
    let last = times.len() - 1;
    let (a, b) = (before.min(last), from.min(last));
    let span = times[b] - times[a];
    let share = if span > 0.0 { (start_s - times[a]) / span } else { 0.0 };
    let zero = depth[a] + share * (depth[b] - depth[a]);
    std::iter::once(0.0).chain(depth[from.min(depth.len())..].iter().map(|x| x - zero)).collect()
}

/// Depths from m ẍ = m g − F, linear between samples.
pub(super) fn integrated(times: &[f64], force_n: &[f64], impactor: &Impactor, speed: f64) -> Vec<f64> {
    let mass = impactor.mass_kg.unwrap_or(f64::NAN);
    let acceleration = |i: usize| impactor.gravity_m_s2 - force_n[i] / mass;
    let (mut x, mut v) = (0.0, speed);
    let mut depth = vec![0.0];
    for i in 1..times.len() {
        let (dt, a, b) = (times[i] - times[i - 1], acceleration(i - 1), acceleration(i));
        x += dt * v + dt * dt * (a / 3.0 + b / 6.0);
        v += 0.5 * dt * (a + b);
        depth.push(x);
    }
    depth
}
