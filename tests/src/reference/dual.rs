//! Exact differentiation: numbers that carry a slope along one direction, and that nest.
//!
//! `Dual<f64>` gives a first derivative, `Dual<Dual<f64>>` a mixed second one, and so on.

use std::ops::{Add, Mul, Neg, Sub};

/// What the formulas of the reference need of a number.
pub trait Number: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self> {
    /// A number that does not vary.
    fn constant(value: f64) -> Self;
    /// Sine.
    fn sin(self) -> Self;
    /// Cosine.
    fn cos(self) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// 1/x.
    fn recip(self) -> Self;
    /// Angle of the point (`x`, `self`).
    fn atan2(self, x: Self) -> Self;
}

impl Number for f64 {
    fn constant(value: f64) -> Self {
        value
    }
    fn sin(self) -> Self {
        f64::sin(self)
    }
    fn cos(self) -> Self {
        f64::cos(self)
    }
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    fn recip(self) -> Self {
        f64::recip(self)
    }
    fn atan2(self, x: Self) -> Self {
        f64::atan2(self, x)
    }
}

/// f(x + τ·direction) to first order in τ: value f and slope df/dτ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<T> {
    /// f.
    pub value: T,
    /// df/dτ.
    pub slope: T,
}

impl<T> Dual<T> {
    /// A value that moves with a slope.
    pub const fn new(value: T, slope: T) -> Self {
        Dual { value, slope }
    }
}

impl<T: Number> Add for Dual<T> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Dual::new(self.value + b.value, self.slope + b.slope)
    }
}

impl<T: Number> Sub for Dual<T> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Dual::new(self.value - b.value, self.slope - b.slope)
    }
}

impl<T: Number> Mul for Dual<T> {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Dual::new(self.value * b.value, self.slope * b.value + self.value * b.slope)
    }
}

impl<T: Number> Neg for Dual<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Dual::new(-self.value, -self.slope)
    }
}

impl<T: Number> Number for Dual<T> {
    fn constant(value: f64) -> Self {
        Dual::new(T::constant(value), T::constant(0.0))
    }
    fn sin(self) -> Self {
        Dual::new(self.value.sin(), self.slope * self.value.cos())
    }
    fn cos(self) -> Self {
        Dual::new(self.value.cos(), -self.slope * self.value.sin())
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        Dual::new(root, self.slope * T::constant(0.5) * root.recip())
    }
    fn recip(self) -> Self {
        let inverse = self.value.recip();
        Dual::new(inverse, -self.slope * inverse * inverse)
    }
    fn atan2(self, x: Self) -> Self {
        // d atan2(y, x) = (x dy − y dx)/(x² + y²)
        let (y, r2) = (self, x.value * x.value + self.value * self.value);
        let slope = (x.value * y.slope - y.value * x.slope) * r2.recip();
        Dual::new(y.value.atan2(x.value), slope)
    }
}
