//! Lanes as an array, which every processor has: to test the others against.

use std::array::from_fn;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use crate::motion::lanes::{Lanes, trig};
use crate::motion::scalar::{Scalar, in_place};

/// N numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Plain<const N: usize>([f64; N]);

/// N truth values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct PlainMask<const N: usize>([bool; N]);

impl<const N: usize> Plain<N> {
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Plain(from_fn(|i| f(self.0[i], other.0[i])))
    }
}

impl<const N: usize> Add for Plain<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl<const N: usize> Sub for Plain<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl<const N: usize> Mul for Plain<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl<const N: usize> Div for Plain<N> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }
}

impl<const N: usize> Neg for Plain<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Plain(self.0.map(|a| -a))
    }
}

in_place!([const N: usize] Plain<N>);

impl<const N: usize> BitAnd for PlainMask<N> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        PlainMask(from_fn(|i| self.0[i] & other.0[i]))
    }
}

impl<const N: usize> BitOr for PlainMask<N> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        PlainMask(from_fn(|i| self.0[i] | other.0[i]))
    }
}

impl<const N: usize> Not for PlainMask<N> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        PlainMask(self.0.map(|a| !a))
    }
}

impl<const N: usize> Scalar for Plain<N> {
    type Mask = PlainMask<N>;

    #[inline(always)]
    fn of(value: f64) -> Self {
        Plain([value; N])
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Plain(self.0.map(f64::sqrt))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Plain(self.0.map(f64::abs))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.zip(other, <f64 as Scalar>::max)
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.zip(other, <f64 as Scalar>::min)
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
    fn lt(self, other: Self) -> PlainMask<N> {
        PlainMask(from_fn(|i| self.0[i] < other.0[i]))
    }
    #[inline(always)]
    fn select(mask: PlainMask<N>, yes: Self, no: Self) -> Self {
        Plain(from_fn(|i| if mask.0[i] { yes.0[i] } else { no.0[i] }))
    }
    #[inline(always)]
    fn any(mask: PlainMask<N>) -> bool {
        mask.0.contains(&true)
    }
}

impl<const N: usize> Lanes for Plain<N> {
    const COUNT: usize = N;

    #[inline(always)]
    fn lane(&self, i: usize) -> f64 {
        self.0[i]
    }
    #[inline(always)]
    fn set_lane(&mut self, i: usize, value: f64) {
        self.0[i] = value;
    }
    #[inline(always)]
    fn upper_half(self) -> Self {
        Plain(self.0.map(|a| f64::from_bits(a.to_bits() & 0xFFFF_FFFF_0000_0000)))
    }
}
