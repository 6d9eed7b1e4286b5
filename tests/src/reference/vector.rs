//! Three components of any [`Number`].

use super::dual::{Dual, Number};
use nalgebra::Vector3;
use std::ops::{Add, Mul, Sub};

/// A vector in space or segment axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector<T>(pub [T; 3]);

impl<T: Number> Vector<T> {
    /// A vector that does not vary.
    pub fn constant(v: &Vector3<f64>) -> Self {
        Vector([v.x, v.y, v.z].map(T::constant))
    }

    /// a·b.
    pub fn dot(self, b: Self) -> T {
        let ([ax, ay, az], [bx, by, bz]) = (self.0, b.0);
        ax * bx + ay * by + az * bz
    }

    /// a×b.
    pub fn cross(self, b: Self) -> Self {
        let ([ax, ay, az], [bx, by, bz]) = (self.0, b.0);
        Vector([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx])
    }
}

impl<T: Number> Vector<Dual<T>> {
    /// Derivative of each component.
    pub fn slope(self) -> Vector<T> {
        Vector(self.0.map(|c| c.slope))
    }

    /// Value of each component.
    pub fn value(self) -> Vector<T> {
        Vector(self.0.map(|c| c.value))
    }
}

impl From<Vector<f64>> for Vector3<f64> {
    fn from(v: Vector<f64>) -> Self {
        Vector3::from(v.0)
    }
}

impl<T: Number> Add for Vector<T> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Vector(std::array::from_fn(|i| self.0[i] + b.0[i]))
    }
}

impl<T: Number> Sub for Vector<T> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Vector(std::array::from_fn(|i| self.0[i] - b.0[i]))
    }
}

impl<T: Number> Mul<Vector<T>> for f64 {
    type Output = Vector<T>;
    fn mul(self, v: Vector<T>) -> Vector<T> {
        Vector(v.0.map(|c| T::constant(self) * c))
    }
}

impl<T: Number> Mul<T> for Vector<T> {
    type Output = Self;
    fn mul(self, factor: T) -> Self {
        Vector(self.0.map(|c| c * factor))
    }
}
