//! Bounded plane surfaces of the compartment and of the surroundings, as data.
//!
//! Report: "The Idealized Passenger Compartment". The report prints no edges of its planes; bounded faces are our
//! decision (see the theory manual).

use nalgebra::{Point3, Vector3};
use occupant_units::trig;
use serde::{Deserialize, Serialize};

use crate::motion::frame::{MOST_FRAMES, SPACE, VEHICLE};

/// What a surface is fixed to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "schema", schemars(rename = "FrameChoice"))]
pub enum Frame {
    /// The first vehicle: x forward, y right, z down from its centre of gravity.
    #[default]
    Vehicle,
    /// Space: x forward, y left, z up.
    Space,
    /// Another vehicle, the ground or a panel, by its position in [`crate::model::setup::Setup::frames`].
    #[serde(skip)]
    Other(usize),
    /// A segment (index), from its joint and in its own axes: the surface belongs to a body.
    #[serde(skip)]
    Segment(usize),
}

impl Frame {
    /// Place among the frames of an instant, where `carriers` are the segments that carry faces.
    pub(crate) fn index(self, carriers: &[usize]) -> usize {
        match self {
            Frame::Space => SPACE,
            Frame::Vehicle => VEHICLE,
            Frame::Other(i) => VEHICLE + 1 + i,
            Frame::Segment(segment) => MOST_FRAMES + carriers.iter().position(|n| *n == segment).unwrap_or_default(),
        }
    }

    /// The segment that carries it.
    pub(crate) fn segment(self) -> Option<usize> {
        if let Frame::Segment(segment) = self { Some(segment) } else { None }
    }

    /// Whether its Z points up, as that of space does.
    pub fn is_upright(self) -> bool {
        matches!(self, Frame::Space | Frame::Segment(_))
    }
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

impl Outline {
    /// A rectangle, trapezoid or triangle that looks like the line from `edge[0]` to `edge[1]` (x, z) from the side; it
    /// reaches `half_width_m` to either side of `y_m` at the first point and `end_half_width_m` at the second.
    pub fn strip(edge: [[f64; 2]; 2], y_m: f64, half_width_m: f64, end_half_width_m: f64) -> Self {
        let ([[x1, z1], [x2, z2]], y, near, far) = (edge, y_m, half_width_m, end_half_width_m);
        let mut corners = vec![Point3::new(x1, y - near, z1), Point3::new(x1, y + near, z1)];
        if far == 0.0 {
            corners.push(Point3::new(x2, y, z2));
        } else {
            corners.extend([Point3::new(x2, y + far, z2), Point3::new(x2, y - far, z2)]);
        }
        Outline::Polygon(corners)
    }

    /// A steering wheel: a disc that stands upright across the vehicle, its top tilted forward by `tilt_rad`.
    pub fn wheel(frame: Frame, centre_m: Point3<f64>, diameter_m: f64, tilt_rad: f64) -> Self {
        Outline::Disc { centre_m, radius_m: 0.5 * diameter_m, axis: wheel_axis(frame, tilt_rad) }
    }
}

/// Axis of a steering wheel that stands upright across the vehicle, its top tilted forward by `tilt_rad`.
pub fn wheel_axis(frame: Frame, tilt_rad: f64) -> Vector3<f64> {
    // Rearward and up: N̂ = (−cos τ, 0, −sin τ) in vehicle axes, z down; z is up in space.
    let (sin, cos) = trig::sin_cos(tilt_rad);
    match frame {
        _ if frame.is_upright() => Vector3::new(-cos, 0.0, sin),
        _ => Vector3::new(-cos, 0.0, -sin),
    }
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

impl Surface {
    /// A surface of the vehicle whose open side is that of the point `inside_m`, and that every sphere can touch.
    pub fn new(name: impl Into<String>, material: usize, outline: Outline, inside_m: Point3<f64>) -> Self {
        Surface {
            name: name.into(),
            frame: Frame::default(),
            outline,
            facing: Facing::Towards(inside_m),
            material,
            spheres: None,
        }
    }
}
