//! A frame that yields along an axis or about one, as data.

use nalgebra::{Point3, Vector3};

use crate::forces::function::Function;

/// A frame that bodies and bags push against an inelastic force: along an axis, as an energy-absorbing steering column,
/// or about one against a moment, as a seat back on its recliner.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name and its frame's.
    pub name: String,
    /// The frame (index in [`Setup::frames`](crate::model::setup::Setup::frames)), whose own path is at rest in its parent.
    pub frame: usize,
    /// â, stroke direction, or rotation axis by the right-hand rule, in the parent's axes; any length.
    pub axis: Vector3<f64>,
    /// m_h, moving mass, kg.
    pub mass_kg: f64,
    /// Initial centre of that mass, the parent's axes, m.
    pub hub_m: Point3<f64>,
    /// f, yield force over the stroke (N over m), or moment over the angle (N·m over rad). Its unloading is ignored.
    pub force: Function,
    /// K, slope of unloading, N/m or N·m/rad; the largest slope of f if none.
    pub unload_n_per_m: Option<f64>,
    /// Hinge data, if it rotates.
    pub hinge: Option<Hinge>,
}

/// A hinge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hinge {
    /// A point of the axis, the parent's axes, m.
    pub at_m: Point3<f64>,
    /// J, about a parallel of the axis through the centre of the mass, kg·m².
    pub inertia_kg_m2: f64,
}

/// The columns and hinges of a setup.
#[derive(Clone, Copy, Debug)]
pub struct ColumnData<'a> {
    /// Columns and hinges.
    pub columns: &'a [Column],
    /// Gravity along −Z of space, m/s².
    pub gravity_m_s2: f64,
}

impl<'a> ColumnData<'a> {
    /// Hinges, or columns, each with its index among all.
    pub(super) fn those(self, turn: bool) -> impl Iterator<Item = (usize, &'a Column)> {
        self.columns.iter().enumerate().filter(move |(_, column)| column.turns() == turn)
    }
}

impl Column {
    /// Whether it is a hinge.
    pub fn turns(&self) -> bool {
        self.hinge.is_some()
    }

    /// m_h, kg, or m_h r² + J, kg·m²: its inertia.
    pub(super) fn inertia(&self) -> f64 {
        let Some(hinge) = self.hinge else { return self.mass_kg };
        let arm = self.axis.normalize().cross(&(self.hub_m - hinge.at_m));
        hinge.inertia_kg_m2 + self.mass_kg * arm.norm_squared()
    }

    /// K, N/m or N·m/rad.
    pub(super) fn stiffness_n_per_m(&self) -> f64 {
        self.unload_n_per_m.unwrap_or_else(|| self.force.steepest_loading())
    }

    /// End of the stroke: the start of a rising last interval, else the last point, m or rad.
    pub(super) fn end_m(&self) -> f64 {
        match self.force.points[..] {
            [.., from, to] if to[1] > from[1] && from[0] > 0.0 => from[0],
            [.., to] => to[0],
            [] => 0.0,
        }
    }
}
