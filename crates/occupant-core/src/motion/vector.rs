//! Vectors and matrices of the kernel: only what it needs, over any `Scalar`.

use std::ops::{Add, Mul, Neg, Sub};

use nalgebra::{Matrix3, Vector3};

use crate::motion::scalar::{Scalar, in_place};

/// A vector of three components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct V3<S> {
    /// First component.
    pub x: S,
    /// Second component.
    pub y: S,
    /// Third component.
    pub z: S,
}

/// A vector from its components.
#[inline(always)]
pub fn v3<S>(x: S, y: S, z: S) -> V3<S> {
    V3 { x, y, z }
}

impl<S: Copy> V3<S> {
    /// f applied to corresponding numbers of this and `other`.
    #[inline(always)]
    pub(crate) fn zip<A: Copy, T>(&self, other: &V3<A>, f: &impl Fn(S, A) -> T) -> V3<T> {
        v3(f(self.x, other.x), f(self.y, other.y), f(self.z, other.z))
    }
}

impl<S: Scalar> V3<S> {
    /// The null vector.
    #[inline(always)]
    pub fn zero() -> Self {
        v3(S::zero(), S::zero(), S::zero())
    }

    /// The same constant vector in every lane.
    #[inline(always)]
    pub fn of(v: &Vector3<f64>) -> Self {
        v3(S::of(v.x), S::of(v.y), S::of(v.z))
    }

    /// a · b.
    #[inline(always)]
    pub fn dot(self, b: Self) -> S {
        self.x * b.x + self.y * b.y + self.z * b.z
    }

    /// a × b.
    #[inline(always)]
    pub fn cross(self, b: Self) -> Self {
        v3(self.y * b.z - self.z * b.y, self.z * b.x - self.x * b.z, self.x * b.y - self.y * b.x)
    }

    /// a · a.
    #[inline(always)]
    pub fn norm_squared(self) -> S {
        self.dot(self)
    }

    /// `yes` where the mask is true, else `no`.
    #[inline(always)]
    pub(crate) fn select(mask: S::Mask, yes: Self, no: Self) -> Self {
        v3(S::select(mask, yes.x, no.x), S::select(mask, yes.y, no.y), S::select(mask, yes.z, no.z))
    }
}

impl V3<f64> {
    /// The same as a vector of the linear algebra library.
    pub fn to_vector(self) -> Vector3<f64> {
        Vector3::new(self.x, self.y, self.z)
    }
}

impl<S: Scalar> Add for V3<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        v3(self.x + b.x, self.y + b.y, self.z + b.z)
    }
}

impl<S: Scalar> Sub for V3<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        v3(self.x - b.x, self.y - b.y, self.z - b.z)
    }
}

impl<S: Scalar> Neg for V3<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        v3(-self.x, -self.y, -self.z)
    }
}

impl<S: Scalar> Mul<S> for V3<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, k: S) -> Self {
        v3(self.x * k, self.y * k, self.z * k)
    }
}

in_place!([S: Scalar] V3<S>);

/// A 3 × 3 matrix by columns; for an orientation the columns are the axes X, Y, Z of the turned frame, ī, j̄, k̄ of a segment
/// (59).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct M3<S> {
    /// First column.
    pub x: V3<S>,
    /// Second column.
    pub y: V3<S>,
    /// Third column; of a segment k̄, its Z axis (60).
    pub z: V3<S>,
}

impl<S: Copy> M3<S> {
    /// f applied to corresponding numbers of this and `other`.
    #[inline(always)]
    pub(crate) fn zip<A: Copy, T>(&self, other: &M3<A>, f: &impl Fn(S, A) -> T) -> M3<T> {
        M3 { x: self.x.zip(&other.x, f), y: self.y.zip(&other.y, f), z: self.z.zip(&other.z, f) }
    }
}

impl<S: Scalar> M3<S> {
    /// The same constant matrix in every lane.
    #[inline(always)]
    pub fn of(m: &Matrix3<f64>) -> Self {
        let column = |x, y, z| v3(S::of(x), S::of(y), S::of(z));
        M3 { x: column(m.m11, m.m21, m.m31), y: column(m.m12, m.m22, m.m32), z: column(m.m13, m.m23, m.m33) }
    }

    /// The unit matrix.
    #[inline(always)]
    pub(crate) fn identity() -> Self {
        M3::of(&Matrix3::identity())
    }

    /// M v: components in the frame → components outside it; X′ = Tⁿ X_n (1).
    #[inline(always)]
    pub fn out(&self, v: V3<S>) -> V3<S> {
        self.x * v.x + self.y * v.y + self.z * v.z
    }

    /// M N.
    #[inline(always)]
    pub(crate) fn times(&self, n: &Self) -> Self {
        M3 { x: self.out(n.x), y: self.out(n.y), z: self.out(n.z) }
    }

    /// Mᵀ.
    #[inline(always)]
    pub(crate) fn transposed(&self) -> Self {
        let (x, y, z) = (self.x, self.y, self.z);
        M3 { x: v3(x.x, y.x, z.x), y: v3(x.y, y.y, z.y), z: v3(x.z, y.z, z.z) }
    }

    /// Mᵀ v: components outside → components in the frame; X_n = Tⁿᵀ X′ (7), X_m = T^nmᵀ X′ (12).
    #[inline(always)]
    pub fn into_frame(&self, v: V3<S>) -> V3<S> {
        v3(self.x.dot(v), self.y.dot(v), self.z.dot(v))
    }
}

impl M3<f64> {
    /// The same as a matrix of the linear algebra library.
    pub fn to_matrix(self) -> Matrix3<f64> {
        Matrix3::from_columns(&[self.x.to_vector(), self.y.to_vector(), self.z.to_vector()])
    }
}

/// A symmetric 3 × 3 matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sym3<S> {
    /// Element 1,1.
    pub xx: S,
    /// Element 2,2.
    pub yy: S,
    /// Element 3,3.
    pub zz: S,
    /// Element 1,2.
    pub xy: S,
    /// Element 1,3.
    pub xz: S,
    /// Element 2,3.
    pub yz: S,
}

impl<S: Copy> Sym3<S> {
    /// f applied to corresponding numbers of this and `other`.
    #[inline(always)]
    pub(crate) fn zip<A: Copy, T>(&self, other: &Sym3<A>, f: &impl Fn(S, A) -> T) -> Sym3<T> {
        Sym3 {
            xx: f(self.xx, other.xx),
            yy: f(self.yy, other.yy),
            zz: f(self.zz, other.zz),
            xy: f(self.xy, other.xy),
            xz: f(self.xz, other.xz),
            yz: f(self.yz, other.yz),
        }
    }
}

impl<S: Scalar> Sym3<S> {
    /// The symmetric part of a matrix.
    pub(crate) fn of(m: &Matrix3<f64>) -> Self {
        let mean = |a: f64, b: f64| S::of(0.5 * (a + b));
        let [xy, xz, yz] = [mean(m.m12, m.m21), mean(m.m13, m.m31), mean(m.m23, m.m32)];
        Sym3 { xx: S::of(m.m11), yy: S::of(m.m22), zz: S::of(m.m33), xy, xz, yz }
    }

    /// R M Rᵀ: in the axes outside the frame whose axes are R.
    #[inline(always)]
    pub(crate) fn out(&self, axes: &M3<S>) -> Self {
        let mut sum = Sym3::scaled_identity(self.zz);
        // with 1 = XXᵀ + YYᵀ + ZZᵀ
        sum.add_outer(self.xx - self.zz, axes.x);
        sum.add_outer(self.yy - self.zz, axes.y);
        sum.add_outer_pair(self.xy, axes.x, axes.y);
        sum.add_outer_pair(self.xz, axes.x, axes.z);
        sum.add_outer_pair(self.yz, axes.y, axes.z);
        sum
    }

    /// k·1.
    #[inline(always)]
    pub(crate) fn scaled_identity(k: S) -> Self {
        let o = S::zero();
        Sym3 { xx: k, yy: k, zz: k, xy: o, xz: o, yz: o }
    }

    /// Adds k v vᵀ.
    #[inline(always)]
    pub(crate) fn add_outer(&mut self, k: S, v: V3<S>) {
        let kv = v * k;
        self.xx += kv.x * v.x;
        self.yy += kv.y * v.y;
        self.zz += kv.z * v.z;
        self.xy += kv.x * v.y;
        self.xz += kv.x * v.z;
        self.yz += kv.y * v.z;
    }

    /// Adds k (v wᵀ + w vᵀ).
    #[inline(always)]
    pub(crate) fn add_outer_pair(&mut self, k: S, v: V3<S>, w: V3<S>) {
        let kv = v * k;
        self.xx += kv.x * w.x + kv.x * w.x;
        self.yy += kv.y * w.y + kv.y * w.y;
        self.zz += kv.z * w.z + kv.z * w.z;
        self.xy += kv.x * w.y + kv.y * w.x;
        self.xz += kv.x * w.z + kv.z * w.x;
        self.yz += kv.y * w.z + kv.z * w.y;
    }

    /// M v.
    #[inline(always)]
    pub(crate) fn mul(&self, v: V3<S>) -> V3<S> {
        v3(self.row_x().dot(v), self.row_y().dot(v), self.row_z().dot(v))
    }

    /// First row.
    #[inline(always)]
    pub(crate) fn row_x(&self) -> V3<S> {
        v3(self.xx, self.xy, self.xz)
    }

    /// Second row.
    #[inline(always)]
    pub(crate) fn row_y(&self) -> V3<S> {
        v3(self.xy, self.yy, self.yz)
    }

    /// Third row.
    #[inline(always)]
    pub(crate) fn row_z(&self) -> V3<S> {
        v3(self.xz, self.yz, self.zz)
    }

    /// M⁻¹ by cofactors; M must be positive definite.
    #[inline(always)]
    pub(crate) fn inverse(&self) -> Self {
        let xx = self.yy * self.zz - self.yz * self.yz;
        let xy = self.xz * self.yz - self.xy * self.zz;
        let xz = self.xy * self.yz - self.xz * self.yy;
        let k = S::one() / (self.xx * xx + self.xy * xy + self.xz * xz);
        Sym3 {
            xx: xx * k,
            yy: (self.xx * self.zz - self.xz * self.xz) * k,
            zz: (self.xx * self.yy - self.xy * self.xy) * k,
            xy: xy * k,
            xz: xz * k,
            yz: (self.xy * self.xz - self.xx * self.yz) * k,
        }
    }
}

in_place!([S: Scalar] Sym3<S>);

impl<S: Scalar> Sub for Sym3<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        self.zip(&b, &|a, b| a - b)
    }
}

impl<S: Scalar> Add for Sym3<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Sym3 {
            xx: self.xx + b.xx,
            yy: self.yy + b.yy,
            zz: self.zz + b.zz,
            xy: self.xy + b.xy,
            xz: self.xz + b.xz,
            yz: self.yz + b.yz,
        }
    }
}
