//! A steering column that gives way, as data.

use nalgebra::{Point3, Vector3};

use crate::forces::function::Function;

/// An energy-absorbing steering column: a frame that bodies and bags push along an axis against a force that does not come back.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name, that of the frame.
    pub name: String,
    /// The frame (index in [`Setup::frames`](crate::model::setup::Setup::frames)), whose own path stands still in its parent.
    pub frame: usize,
    /// â, the way that it gives, along the parent's axes; any length.
    pub axis: Vector3<f64>,
    /// m_h, of all that strokes, kg.
    pub mass_kg: f64,
    /// The middle of that mass before it strokes, the parent's axes, m.
    pub hub_m: Point3<f64>,
    /// f over the stroke: where it yields. What it says of unloading does not count.
    pub force: Function,
    /// K, slope of unloading, N/m; the greatest slope of f if none.
    pub unload_n_per_m: Option<f64>,
}

/// The columns of a setup.
#[derive(Clone, Copy, Debug)]
pub struct ColumnData<'a> {
    /// All of them.
    pub columns: &'a [Column],
    /// Gravity along −Z of space, m/s².
    pub gravity_m_s2: f64,
}

impl Column {
    /// K, N/m.
    pub(super) fn stiffness_n_per_m(&self) -> f64 {
        self.unload_n_per_m.unwrap_or_else(|| self.force.steepest_loading())
    }

    /// The stroke at which it ends: where a last interval that rises begins, else its last point, m.
    pub(super) fn end_m(&self) -> f64 {
        match self.force.points[..] {
            [.., from, to] if to[1] > from[1] && from[0] > 0.0 => from[0],
            [.., to] => to[0],
            [] => 0.0,
        }
    }
}
