//! Solids: bodies with thickness, which resist spheres from all sides.
//!
//! A bounded face acts only from its front, and a sphere that comes over an edge may pass it. A solid has a signed
//! distance φ, and Δ = r − φ is a function of the sphere's centre, including around its edges and corners. The report
//! has none.

mod build;
mod concave;
mod distance;
mod faced;
mod outline;
mod system;
#[cfg(test)]
mod tests;

pub(crate) use build::build;
pub(crate) use concave::{CONCAVE_WITHIN_M, concave_rad};
pub(crate) use faced::Faced;
use occupant_units::trig;
pub(crate) use system::{Member, Solids, lever};

use nalgebra::{Matrix3, Point3, Vector3};

use crate::forces::contact::flat_face::FlatFace;
use crate::forces::contact::near::Bounds;
use crate::forces::contact::surface::{Frame, Outline};

/// A body with thickness that spheres can touch.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// Unique name, also among surfaces.
    pub name: String,
    /// What it is fixed to.
    pub frame: Frame,
    /// Shape in that frame.
    pub shape: Shape,
    /// Index into the materials.
    pub material: usize,
    /// Solids of one group, which have one frame and one material, are met as one body.
    pub group: Option<String>,
    /// Spheres that can touch it (indices); `None` is all.
    pub spheres: Option<Vec<usize>>,
}

/// Shape of a solid, rounded edges included, in the axes of its frame.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A convex plane polygon, its corners in any order, and what lies to both sides of it.
    Prism {
        /// Corners, 3 to 12.
        corners_m: Vec<Point3<f64>>,
        /// Half the length along the polygon's normal.
        half_width_m: f64,
        /// Radius of its edges and corners.
        rounding_m: f64,
    },
    /// A round plate.
    Disc {
        /// Middle.
        centre_m: Point3<f64>,
        /// Either direction of its axis.
        axis: Vector3<f64>,
        /// Radius.
        radius_m: f64,
        /// Length along the axis.
        thickness_m: f64,
        /// Radius of its edges.
        rounding_m: f64,
    },
    /// All that is near a straight line: a column, a pillar, a bar.
    Capsule {
        /// Ends of the line.
        ends_m: [Point3<f64>; 2],
        /// How near.
        radius_m: f64,
    },
    /// All that is near a circle: the rim of a steering wheel.
    Rim {
        /// Middle of the circle.
        centre_m: Point3<f64>,
        /// Either normal of its plane.
        axis: Vector3<f64>,
        /// Radius of the circle.
        ring_radius_m: f64,
        /// How near.
        tube_radius_m: f64,
    },
    /// All that is behind a plane.
    HalfSpace {
        /// Any point of the plane.
        point_m: Point3<f64>,
        /// Its normal, out of the solid.
        normal: Vector3<f64>,
    },
}

impl Shape {
    /// A box with the lengths `lengths_m` along the axes that are the columns of `axes`.
    pub fn block(centre_m: Point3<f64>, lengths_m: Vector3<f64>, axes: &Matrix3<f64>, rounding_m: f64) -> Self {
        let half = 0.5 * lengths_m;
        let [u, v] = [0, 1].map(|i| axes.column(i) * half[i]);
        let corners_m = [u + v, v - u, -u - v, u - v].map(|arm| centre_m + arm).to_vec();
        Shape::Prism { corners_m, half_width_m: half.z, rounding_m }
    }

    /// Radius of a bar; none of what is no capsule or rim.
    pub(crate) fn bar_radius_m(&self) -> Option<f64> {
        match self {
            Shape::Capsule { radius_m, .. } | Shape::Rim { tube_radius_m: radius_m, .. } => Some(*radius_m),
            _ => None,
        }
    }

    /// A box that holds it.
    pub(crate) fn bounds(&self) -> Bounds {
        match self {
            Shape::Prism { corners_m, half_width_m, .. } => {
                // corners that make no prism are refused elsewhere
                let arm = build::flat(corners_m).map_or(Vector3::repeat(1.0), |(_, normal, _)| normal) * *half_width_m;
                corners_m.iter().fold(Bounds::NONE, |all, p| all.and(Bounds::of(&[p - arm, p + arm])))
            }
            Shape::Disc { centre_m, radius_m, thickness_m, .. } => {
                Bounds::ball(centre_m, trig::hypot(*radius_m, 0.5 * thickness_m))
            }
            Shape::Capsule { ends_m, radius_m } => Bounds::of(ends_m).grown(*radius_m),
            Shape::Rim { centre_m, ring_radius_m, tube_radius_m, .. } => {
                Bounds::ball(centre_m, ring_radius_m + tube_radius_m)
            }
            Shape::HalfSpace { point_m, .. } => Bounds::ball(point_m, f64::INFINITY),
        }
    }

    /// A plate with this polygon in front and `thickness_m` behind its open side; none for an outline of another kind.
    pub fn plate(front: &FlatFace, thickness_m: f64, rounding_m: f64) -> Option<Self> {
        let Outline::Polygon(corners) = &front.outline else { return None };
        let half_width_m = 0.5 * thickness_m;
        let corners_m = corners.iter().map(|p| p - front.normal * half_width_m).collect();
        Some(Shape::Prism { corners_m, half_width_m, rounding_m })
    }
}
