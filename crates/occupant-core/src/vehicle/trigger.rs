//! Times at which a vehicle's motion fires a trigger.

use nalgebra::Vector3;

use super::{Interpolation, PathCursor, VehiclePath};

/// Interval between evaluations of the motion, s (ours).
const LOOK_S: f64 = 5e-5;
/// Largest number of evaluations: 500 s.
const MOST_LOOKS: f64 = 1e7;

/// Number of evaluations of a span after its start.
fn looks([start_s, end_s]: [f64; 2]) -> u64 {
    ((end_s - start_s) / LOOK_S).clamp(0.0, MOST_LOOKS) as u64
}

impl VehiclePath {
    /// Whether its accelerations are known: a linearly interpolated table has none.
    pub fn has_accelerations(&self) -> bool {
        !matches!(self, VehiclePath::Table(table) if table.interpolation() == Interpolation::Linear)
    }

    /// First time of a span, s, at which the acceleration of the vehicle's centre of gravity along its floor, or along
    /// the unit vector `way` in its axes, has been at least `threshold_m_s2` for `for_s` without interruption; none
    /// within the first 500 s.
    pub fn jolt_s(&self, span_s: [f64; 2], way: Option<Vector3<f64>>, threshold_m_s2: f64, for_s: f64) -> Option<f64> {
        let start_s = span_s[0];
        let mut cursor = PathCursor::default();
        let mut excess = |t_s: f64| {
            let motion = self.motion(t_s, t_s, &mut cursor);
            let own = motion.vector_to_frame(motion.acceleration_m_s2);
            way.map_or_else(|| own.xy().norm(), |way| own.dot(&way)) - threshold_m_s2
        };
        let (mut before, mut since_s) = (-1.0, start_s);
        for i in 0..=looks(span_s) {
            let t_s = start_s + i as f64 * LOOK_S;
            let now = excess(t_s);
            if before < 0.0 && now >= 0.0 && i > 0 {
                since_s = t_s - LOOK_S * now / (now - before);
            }
            if now >= 0.0 && t_s - since_s >= for_s {
                return Some(since_s + for_s);
            }
            before = now;
        }
        None
    }

    /// First time of a span, s, at which the change of velocity along the vehicle's floor has reached `threshold_m_s`
    /// since the acceleration last rose above `wake_m_s2`; none within the first 500 s.
    pub fn change_s(&self, span_s: [f64; 2], threshold_m_s: f64, wake_m_s2: f64) -> Option<f64> {
        let start_s = span_s[0];
        let mut cursor = PathCursor::default();
        let mut acceleration = |t_s: f64| {
            let motion = self.motion(t_s, t_s, &mut cursor);
            motion.vector_to_frame(motion.acceleration_m_s2).xy()
        };
        let (mut before, mut change) = (acceleration(start_s), nalgebra::Vector2::zeros());
        for i in 1..=looks(span_s) {
            let t_s = start_s + i as f64 * LOOK_S;
            let now = acceleration(t_s);
            let was = change.norm();
            change += (before + now) * (0.5 * LOOK_S);
            if now.norm() < wake_m_s2 {
                change = nalgebra::Vector2::zeros();
            } else if change.norm() >= threshold_m_s {
                return Some(t_s - LOOK_S * (change.norm() - threshold_m_s) / (change.norm() - was));
            }
            before = now;
        }
        None
    }
}
