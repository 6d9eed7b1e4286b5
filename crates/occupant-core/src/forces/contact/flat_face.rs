//! Flat faces: surfaces with a resolved plane and open side, and the seams between them.
//!
//! Report: Eqs 84, 86, 87 (N̂ and G). Our decision: coplanar faces of one frame that share an edge act as one face.

use nalgebra::{Point3, Vector3};
use occupant_units::trig;

use crate::forces::contact::near::{Bounds, NearPairs, near_pairs};
use crate::forces::contact::surface::{Facing, Frame, Outline, Surface};
use placed_text::Problems;

/// Points closer than this are the same point, m.
pub(super) const SAME_M: f64 = 1e-6;
/// Largest number of corners of a polygon; more is a disc, or a mistake.
const MOST_CORNERS: usize = 100;
/// cos 30°.
const COS_30: f64 = 0.866_025_403_784_438_6;

/// A surface whose plane and open side are known, in the axes of its frame.
#[derive(Clone, Debug, PartialEq)]
pub struct FlatFace {
    /// Frame that carries it.
    pub frame: Frame,
    /// N̂, towards the open side.
    pub normal: Vector3<f64>,
    /// G of the plane's equation N̂·x = G (86), m.
    pub offset_m: f64,
    /// Outline; polygon corners run counter-clockwise seen from the open side.
    pub outline: Outline,
}

impl FlatFace {
    /// Resolves a surface; problems are reported under `path`.
    pub fn new(surface: &Surface, path: &str, problems: &mut Problems) -> Option<FlatFace> {
        let outline = surface.outline.clone();
        let (point, axis) = match &outline {
            Outline::Polygon(corners) => polygon_plane(corners, path, problems)?,
            Outline::Disc { centre_m, radius_m, axis } => {
                if !(*radius_m > 0.0 && radius_m.is_finite()) {
                    problems.error(path, format!("radius {radius_m} m"), "a positive radius");
                    return None;
                }
                (*centre_m, *axis)
            }
            Outline::Unbounded { point_m, axis } => (*point_m, *axis),
        };
        let Some(normal) = axis.try_normalize(1e-12).filter(|n| n.iter().all(|c| c.is_finite())) else {
            problems.error(path, "a normal of length zero", "a direction");
            return None;
        };
        // N̂ (84)
        let normal = match surface.facing {
            Facing::Order => normal,
            Facing::Towards(inside) => {
                let height = normal.dot(&(inside - point));
                if height.abs() < SAME_M || !height.is_finite() {
                    problems.error_with_hint(
                        path,
                        "the point that should tell the open side lies in the surface's plane",
                        "a point on the open side",
                        "give another `inside` point, or the corners counter-clockwise seen from the open side",
                    );
                    return None;
                }
                normal * height.signum()
            }
        };
        let outline = match outline {
            Outline::Polygon(mut corners) => {
                if normal.dot(&axis) < 0.0 {
                    corners.reverse();
                }
                Outline::Polygon(corners)
            }
            other => other,
        };
        // G from a point of the plane (87)
        let offset_m = normal.dot(&point.coords);
        if !point.coords.iter().all(|x| x.is_finite()) || !offset_m.is_finite() {
            problems.error(path, format!("a point at {:?}", point.coords.as_slice()), "finite coordinates, m");
            return None;
        }
        Some(FlatFace { frame: surface.frame, normal, offset_m, outline })
    }

    /// Axes u, v of the plane with u × v = N̂.
    pub fn plane_axes(&self) -> (Vector3<f64>, Vector3<f64>) {
        plane_axes(&self.normal)
    }

    /// The corners of a polygon; of another outline none.
    fn corners(&self) -> &[Point3<f64>] {
        if let Outline::Polygon(corners) = &self.outline { corners } else { &[] }
    }

    /// True if the two faces lie in one plane of one frame and look the same way.
    fn is_coplanar_with(&self, other: &FlatFace) -> bool {
        (self.offset_m - other.offset_m).abs() < SAME_M
            && self.frame == other.frame
            && self.normal.dot(&other.normal) > 0.0
            && self.normal.cross(&other.normal).norm() < SAME_M
    }

    /// True if the two faces share part of an edge.
    fn shares_an_edge_with(&self, other: &FlatFace) -> bool {
        sides(self.corners()).any(|s| sides(other.corners()).any(|t| overlap(s, t)))
    }

    /// Polygons of one plane whose boxes touch.
    pub(super) fn neighbours(faces: &[FlatFace]) -> NearPairs {
        let boxes: Vec<Bounds> = faces.iter().map(|face| Bounds::of(face.corners())).collect();
        near_pairs(&boxes, SAME_M, |i, j| faces[i].is_coplanar_with(&faces[j]))
    }

    /// Faces (indices) of one plane that share part of an edge.
    pub(super) fn seams(faces: &[FlatFace]) -> impl Iterator<Item = [usize; 2]> {
        let near = FlatFace::neighbours(faces).pairs;
        near.into_iter().filter(|[i, j]| faces[*i].shares_an_edge_with(&faces[*j]))
    }

    /// Polygons (indices) of `list` that share a corner as [`FlatFace::has_corner_with`] says.
    pub(crate) fn corners_among(faces: &[FlatFace], list: &[usize]) -> Vec<[usize; 2]> {
        let boxes: Vec<Bounds> = list.iter().map(|i| Bounds::of(faces[*i].corners())).collect();
        let turns = |i: usize, j: usize| faces[list[i]].normal.dot(&faces[list[j]].normal) < COS_30;
        let near = near_pairs(&boxes, SAME_M, turns).pairs.into_iter().map(|pair| pair.map(|i| list[i]));
        near.filter(|[i, j]| faces[*i].has_corner_with(&faces[*j])).collect()
    }

    /// True if the two faces of one frame share part of an edge from which both fall away by more than 30° together: a corner
    /// that a sphere may come round without touching either.
    fn has_corner_with(&self, other: &FlatFace) -> bool {
        let is_behind = |face: &FlatFace, p: &Point3<f64>| face.normal.dot(&p.coords) - face.offset_m < SAME_M;
        self.frame == other.frame
            && self.normal.dot(&other.normal) < COS_30
            && other.corners().iter().all(|p| is_behind(self, p))
            && self.corners().iter().all(|p| is_behind(other, p))
            && self.shares_an_edge_with(other)
    }
}

/// Axes u, v of a plane with u × v = `normal`, a unit vector.
pub(super) fn plane_axes(normal: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
    let u = Vector3::ith(normal.iamin(), 1.0).cross(normal).normalize();
    (u, normal.cross(&u))
}

type Side = (Point3<f64>, Point3<f64>);

fn sides(corners: &[Point3<f64>]) -> impl Iterator<Item = Side> + '_ {
    (0..corners.len()).map(|i| (corners[i], corners[(i + 1) % corners.len()]))
}

/// True if two sides lie on one line and have more than a point in common.
fn overlap(a: Side, b: Side) -> bool {
    let direction = (a.1 - a.0).normalize();
    let length = (a.1 - a.0).norm();
    let place = |p: Point3<f64>| {
        let from = p - a.0;
        let along = from.dot(&direction);
        (along, (from - direction * along).norm())
    };
    let ((s, off_s), (t, off_t)) = (place(b.0), place(b.1));
    let common = s.max(t).min(length) - s.min(t).max(0.0);
    off_s < SAME_M && off_t < SAME_M && common > SAME_M
}

/// A point of a convex polygon's plane and its normal for counter-clockwise corners.
fn polygon_plane(corners: &[Point3<f64>], path: &str, problems: &mut Problems) -> Option<(Point3<f64>, Vector3<f64>)> {
    let n = corners.len();
    if n < 3 {
        problems.error(path, format!("{n} corners"), "at least three");
        return None;
    }
    if n > MOST_CORNERS {
        problems.error(path, format!("{n} corners"), format!("at most {MOST_CORNERS}, or a disc"));
        return None;
    }
    if corners.iter().any(|p| p.iter().any(|c| !c.is_finite())) {
        problems.error(path, "a corner that is not a finite number", "finite coordinates");
        return None;
    }
    for (i, (p, q)) in sides(corners).enumerate() {
        if (q - p).norm() < SAME_M {
            problems.error(path, format!("corners {} and {} coincide", i + 1, (i + 1) % n + 1), "different corners");
            return None;
        }
    }
    // twice the vector area
    let area: Vector3<f64> = sides(corners).map(|(p, q)| (p - corners[0]).cross(&(q - corners[0]))).sum();
    let size = corners.iter().map(|p| (p - corners[0]).norm()).fold(0.0, f64::max);
    if area.norm() < SAME_M * size {
        problems.error(path, "corners on one line", "corners that span a plane");
        return None;
    }
    let normal = area.normalize();
    let warp = corners.iter().map(|p| normal.dot(&(p - corners[0])).abs()).fold(0.0, f64::max);
    if warp > 1e-3 * size {
        problems.error_with_hint(
            path,
            format!("corners that leave their plane by {:.1} mm", warp * 1e3),
            "a plane polygon",
            "split it into triangles",
        );
        return None;
    }
    for i in 0..n {
        let (p, q, r) = (corners[i], corners[(i + 1) % n], corners[(i + 2) % n]);
        if (q - p).cross(&(r - q)).dot(&normal) < -1e-9 * size * size {
            problems.error_with_hint(
                path,
                format!("the outline turns inwards at corner {}", (i + 1) % n + 1),
                "a convex polygon, corners in order",
                "order the corners, or split the surface",
            );
            return None;
        }
    }
    // turning one way at every corner is not enough: a star does so too, but turns by more than once round
    let turn = |i: usize| {
        let (p, q, r) = (corners[i], corners[(i + 1) % n], corners[(i + 2) % n]);
        trig::atan2((q - p).cross(&(r - q)).dot(&normal), (q - p).dot(&(r - q)))
    };
    if (0..n).map(turn).sum::<f64>() > 1.5 * std::f64::consts::TAU {
        problems.error_with_hint(
            path,
            "an outline that goes round more than once",
            "a convex polygon, corners in order",
            "order the corners, or split the surface",
        );
        return None;
    }
    Some((corners[0], normal))
}
