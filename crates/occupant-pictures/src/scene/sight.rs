//! What stands in the way of a line of sight.

use nalgebra::Point3;

/// Distance between the line of sight and a bar, m; infinite for a bar beyond the end.
pub(super) fn passes(eye: &Point3<f64>, end: &Point3<f64>, bar: [Point3<f64>; 2]) -> f64 {
    let (sight, along, between) = (end - eye, bar[1] - bar[0], eye - bar[0]);
    let (a, b, c) = (sight.norm_squared(), sight.dot(&along), along.norm_squared());
    let (d, e) = (sight.dot(&between), along.dot(&between));
    let below = a * c - b * b;
    if below < 1e-12 {
        return f64::INFINITY;
    }
    let share = (b * e - c * d) / below;
    let place = ((a * e - b * d) / below).clamp(0.0, 1.0);
    if (0.0..0.97).contains(&share) { (between + sight * share - along * place).norm() } else { f64::INFINITY }
}

/// Whether a line of sight goes through a convex polygon.
pub(super) fn meets(eye: &Point3<f64>, end: &Point3<f64>, side: &[Point3<f64>]) -> bool {
    if side.len() < 3 {
        return false;
    }
    let normal = (side[1] - side[0]).cross(&(side[2] - side[0]));
    let (from, to) = (normal.dot(&(eye - side[0])), normal.dot(&(end - side[0])));
    if from * to >= 0.0 {
        return false;
    }
    let at = eye + (end - eye) * (from / (from - to));
    let turns = (0..side.len()).map(|i| {
        let (a, b) = (side[i], side[(i + 1) % side.len()]);
        (b - a).cross(&(at - a)).dot(&normal)
    });
    let [least, most] = turns.fold([f64::MAX, f64::MIN], |[l, m], t| [l.min(t), m.max(t)]);
    least >= 0.0 || most <= 0.0
}
