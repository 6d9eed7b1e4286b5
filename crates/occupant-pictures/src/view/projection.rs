//! The three views. Vehicle axes: X forward, Y right, Z down. Depth counts towards the viewer.

use nalgebra::{Point3, Vector3};

/// Direction of view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum View {
    /// From the vehicle's right: forward is to the right.
    Side,
    /// From above: forward is to the right, the vehicle's right is down.
    Top,
    /// From the front: the vehicle's left is to the right.
    Front,
}

impl View {
    /// Name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            View::Side => "side",
            View::Top => "top",
            View::Front => "front",
        }
    }

    /// The direction in words.
    pub const fn from(self) -> &'static str {
        match self {
            View::Side => "from the right",
            View::Top => "from above",
            View::Front => "from ahead",
        }
    }

    /// Names and signs of the vehicle axes in the picture: along its x, along its y (down).
    pub const fn axes(self) -> [(&'static str, f64); 2] {
        match self {
            View::Side => [("X", 1.0), ("Z", 1.0)],
            View::Top => [("X", 1.0), ("Y", 1.0)],
            View::Front => [("Y", -1.0), ("Z", 1.0)],
        }
    }

    /// Picture x (right), picture y (down) and depth of a vector.
    pub fn turn(self, v: Vector3<f64>) -> Vector3<f64> {
        match self {
            View::Side => Vector3::new(v.x, v.z, v.y),
            View::Top => Vector3::new(v.x, v.y, -v.z),
            View::Front => Vector3::new(-v.y, v.z, v.x),
        }
    }

    /// Picture coordinates of a point, m.
    pub fn place(self, p: &Point3<f64>) -> [f64; 2] {
        let v = self.turn(p.coords);
        [v.x, v.y]
    }

    /// Depth of a point, m.
    pub fn depth(self, p: &Point3<f64>) -> f64 {
        self.turn(p.coords).z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Picture right × picture up = towards the viewer: no view is mirrored.
    #[test]
    fn no_view_is_a_mirror_image() {
        for &view in &[View::Side, View::Top, View::Front] {
            let axis = |i| view.turn(Vector3::ith(i, 1.0));
            let matrix = nalgebra::Matrix3::from_columns(&[axis(0), axis(1), axis(2)]);
            // picture y runs down, so right-handed axes turn left-handed
            assert_eq!(matrix.determinant(), -1.0, "{view:?}");
        }
    }

    #[test]
    fn the_axes_of_a_view_point_where_it_says() {
        for &view in &[View::Side, View::Top, View::Front] {
            for (row, (name, sense)) in view.axes().into_iter().enumerate() {
                let axis = ["X", "Y", "Z"].iter().position(|n| *n == name).unwrap();
                assert_eq!(view.turn(Vector3::ith(axis, 1.0))[row], sense);
            }
        }
    }
}
