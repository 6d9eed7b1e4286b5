//! Outlines: the projection of an ellipsoid is an ellipse, that of a convex hull the hull of its parts' projections.

use occupant_units::trig;
use std::f64::consts::TAU;

use nalgebra::{Isometry3, Matrix2x3, Matrix3, SMatrix};

use super::projection::View;
use crate::body::{Lump, Part};

/// Points round an ellipse.
const POINTS: usize = 40;

/// Outline of a part at its segment's pose, picture axes, m.
pub fn outline(part: &Part, pose: &Isometry3<f64>, view: View) -> Vec<[f64; 2]> {
    let mut points: Vec<[f64; 2]> = Vec::with_capacity(2 * POINTS);
    for lump in &part.ends {
        points.extend(ellipse(lump, pose, view));
    }
    convex(points)
}

/// The ellipse that an ellipsoid x = c + M u, |u| = 1 projects to: with the projection P and B = P M, its support in the
/// direction d is |Bᵀd|, reached at B Bᵀd / |Bᵀd|.
fn ellipse(lump: &Lump, pose: &Isometry3<f64>, view: View) -> impl Iterator<Item = [f64; 2]> + use<> {
    let centre = view.place(&(pose * nalgebra::Point3::from(lump.centre_m)));
    let axes = pose.rotation.to_rotation_matrix() * Matrix3::from_diagonal(&lump.half_m);
    let columns = [0, 1, 2].map(|i| view.turn(axes.column(i).into_owned()).xy());
    let b: Matrix2x3<f64> = SMatrix::from_columns(&columns);
    (0..POINTS).map(move |i| {
        let (sin, cos) = trig::sin_cos(TAU * i as f64 / POINTS as f64);
        let along = b.transpose() * nalgebra::Vector2::new(cos, sin);
        let edge = b * along / along.norm().max(1e-12);
        [centre[0] + edge.x, centre[1] + edge.y]
    })
}

/// The convex hull of points (monotone chain), in order.
pub fn convex(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let mut hull = half(points.iter().copied());
    let mut other = half(points.iter().rev().copied());
    hull.pop();
    other.pop();
    hull.append(&mut other);
    hull
}

fn half(points: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let mut chain: Vec<[f64; 2]> = Vec::new();
    for c in points {
        while let [.., a, b] = chain[..] {
            let turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            if turn > 0.0 {
                break;
            }
            chain.pop();
        }
        chain.push(c);
    }
    chain
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Tone;
    use nalgebra::{Translation3, UnitQuaternion, Vector3};
    use occupant_core::body::tti12::HEAD;

    #[test]
    fn a_hull_drops_what_lies_inside() {
        let points = vec![[0.0, 0.0], [1.0, 1.0], [2.0, 0.0], [1.0, 0.2], [1.0, 0.0]];
        assert_eq!(convex(points), [[0.0, 0.0], [2.0, 0.0], [1.0, 1.0]]);
    }

    /// A ball's outline is its circle however it is turned; that of an ellipsoid reaches as far as its half axes.
    #[test]
    fn ellipsoids_project_to_their_outlines() {
        let lump = |half_m| Lump { centre_m: Vector3::new(0.1, 0.0, 0.0), half_m };
        let part = |half_m| Part { segment: HEAD, tone: Tone::Skin, ends: [lump(half_m); 2] };
        let turn = UnitQuaternion::from_euler_angles(0.3, -0.7, 1.1);
        let pose = Isometry3::from_parts(Translation3::new(1.0, 2.0, 3.0), turn);
        let centre = View::Side.place(&(pose * nalgebra::Point3::new(0.1, 0.0, 0.0)));
        for [x, y] in outline(&part(Vector3::repeat(0.2)), &pose, View::Side) {
            let distance = (x - centre[0]).hypot(y - centre[1]);
            assert!((distance - 0.2).abs() < 1e-12);
        }
        let level = Isometry3::from_parts(pose.translation, UnitQuaternion::identity());
        let top = outline(&part(Vector3::new(0.1, 0.2, 0.3)), &level, View::Top);
        let reach = |axis: usize| top.iter().map(|p| p[axis]).fold(f64::MIN, f64::max);
        assert!((reach(0) - 1.2).abs() < 1e-12 && (reach(1) - 2.2).abs() < 1e-12);
    }
}
