//! The one scalar trait of the derivative kernel.
//!
//! The kernel (kinematics, force laws, recursion) is written once over [`Scalar`]: `f64` for a single run; vectors of
//! lanes (several scenarios at once) and dual numbers (exact sensitivities) fit the same trait. A comparison gives a
//! [`Scalar::Mask`]; [`Scalar::select`] selects per lane, and [`Scalar::any`] lets the kernel skip work that no lane
//! needs.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, Neg, Not, Sub, SubAssign};

use occupant_units::trig;

/// `+=` and `-=` of a type by its `+` and `-`.
macro_rules! in_place {
    ([$($parameter:tt)*] $Type:ty) => {
        impl<$($parameter)*> std::ops::AddAssign for $Type {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }

        impl<$($parameter)*> std::ops::SubAssign for $Type {
            #[inline(always)]
            fn sub_assign(&mut self, other: Self) {
                *self = *self - other;
            }
        }
    };
}
pub(crate) use in_place;

/// A real number, or several side by side.
pub trait Scalar:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + 'static
{
    /// Whether numbers carry derivatives.
    const HAS_SLOPES: bool = false;

    /// Whether numbers fill wide registers, which only functions compiled for them can use: code for such numbers must
    /// be part of its caller. Otherwise, large parts are functions shared by all callers.
    const IS_WIDE: bool = false;

    /// One truth value per lane.
    type Mask: Copy + Debug + BitAnd<Output = Self::Mask> + BitOr<Output = Self::Mask> + Not<Output = Self::Mask>;

    /// The same constant in every lane.
    fn of(value: f64) -> Self;
    /// √x.
    fn sqrt(self) -> Self;
    /// |x|.
    fn abs(self) -> Self;
    /// The greater of two.
    fn max(self, other: Self) -> Self;
    /// The lesser of two.
    fn min(self, other: Self) -> Self;
    /// sin x and cos x, x in radians.
    fn sin_cos(self) -> (Self, Self);
    /// The angle of the vector (`x`, `self`), −π to π.
    fn atan2(self, x: Self) -> Self;
    /// arccos x, 0 to π.
    fn acos(self) -> Self;
    /// self < other.
    fn lt(self, other: Self) -> Self::Mask;
    /// `yes` where the mask is true, else `no`.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// True if any lane is.
    fn any(mask: Self::Mask) -> bool;

    /// self > other.
    #[inline(always)]
    fn gt(self, other: Self) -> Self::Mask {
        other.lt(self)
    }

    /// The same truth value in every lane.
    #[inline(always)]
    fn truth(value: bool) -> Self::Mask {
        let (left, right) = if value { (0.0, 1.0) } else { (0.0, 0.0) };
        Self::of(left).lt(Self::of(right))
    }

    /// 0 in every lane.
    #[inline(always)]
    fn zero() -> Self {
        Self::of(0.0)
    }

    /// 1 in every lane.
    #[inline(always)]
    fn one() -> Self {
        Self::of(1.0)
    }

    /// The number without its derivatives.
    #[inline(always)]
    fn value_alone(self) -> Self {
        self
    }

    /// x limited to 0…1.
    #[inline(always)]
    fn clamp01(self) -> Self {
        self.max(Self::zero()).min(Self::one())
    }
}

impl Scalar for f64 {
    type Mask = bool;

    #[inline(always)]
    fn of(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self < other { other } else { self }
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        trig::sin_cos(self)
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        trig::atan2(self, x)
    }
    #[inline(always)]
    fn acos(self) -> Self {
        trig::acos(self)
    }
    #[inline(always)]
    fn lt(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn any(mask: bool) -> bool {
        mask
    }
}
