//! Bounded plane surfaces of the compartment and of the surroundings, as data.
//!
//! Report: "The Idealized Passenger Compartment", Eqs 84–92. The report's planes have no edges in print; bounded faces
//! are our decision (see the theory manual).

use nalgebra::{Point3, Vector3};

/// The frame a surface or an anchor is fixed to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Frame {
    /// X_v forward, Y_v right, Z_v down, origin at the vehicle's centre of gravity.
    #[default]
    Vehicle,
    /// Space: X′ forward, Y′ left, Z′ up.
    Space,
}

/// Outline of a surface, in the axes of its frame.
#[derive(Clone, Debug, PartialEq)]
pub enum Outline {
    /// Convex plane polygon, at least three corners in order.
    Polygon(Vec<Point3<f64>>),
    /// Circular disc.
    Disc {
        /// Centre.
        centre_m: Point3<f64>,
        /// Radius.
        radius_m: f64,
        /// Either normal of its plane; [`Facing`] decides the sense.
        axis: Vector3<f64>,
    },
    /// The whole plane through a point.
    Unbounded {
        /// Any point of the plane.
        point_m: Point3<f64>,
        /// Either normal of the plane; [`Facing`] decides the sense.
        axis: Vector3<f64>,
    },
}

/// Which side of a surface is open, i.e. where N̂ points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Facing {
    /// Towards this point.
    Towards(Point3<f64>),
    /// Polygon corners run counter-clockwise seen from the open side; for discs and planes `axis` itself is N̂.
    Order,
}

/// A surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Unique name.
    pub name: String,
    /// What it is fixed to.
    pub frame: Frame,
    /// Outline in that frame.
    pub outline: Outline,
    /// Open side.
    pub facing: Facing,
    /// Index into the materials.
    pub material: usize,
    /// Spheres that can touch it (indices); `None` is all.
    pub spheres: Option<Vec<usize>>,
}
