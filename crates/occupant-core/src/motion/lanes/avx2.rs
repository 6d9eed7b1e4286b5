//! Four lanes in the 256-bit registers of x86-64 with AVX2.
//!
//! Every `unsafe` here is the call of an instruction of AVX; values of [`Avx2`] are made only where the processor has it.
#![allow(
    unsafe_code,
    reason = "the instructions of AVX2 are not there on every x86-64; dispatch asks the processor first"
)]

use std::arch::x86_64::*;
use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, Neg, Not, Sub, SubAssign};

use super::{Lanes, trig};
use crate::motion::scalar::Scalar;

/// Four numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx2(__m256d);

/// Four truth values: all bits of a lane, or none.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx2Mask(__m256d);

impl Add for Avx2 {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        // SAFETY: an operand exists, so the processor has AVX2 (module head); likewise below
        Avx2(unsafe { _mm256_add_pd(self.0, other.0) })
    }
}

impl Sub for Avx2 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        // SAFETY: an operand exists, so the processor has AVX2
        Avx2(unsafe { _mm256_sub_pd(self.0, other.0) })
    }
}

impl Mul for Avx2 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        // SAFETY: an operand exists, so the processor has AVX2
        Avx2(unsafe { _mm256_mul_pd(self.0, other.0) })
    }
}

impl Div for Avx2 {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        // SAFETY: an operand exists, so the processor has AVX2
        Avx2(unsafe { _mm256_div_pd(self.0, other.0) })
    }
}

impl Neg for Avx2 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: an operand exists, so the processor has AVX2
        Avx2(unsafe { _mm256_xor_pd(self.0, _mm256_set1_pd(-0.0)) })
    }
}

impl AddAssign for Avx2 {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Avx2 {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl BitAnd for Avx2Mask {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        // SAFETY: an operand exists, so the processor has AVX2
        Avx2Mask(unsafe { _mm256_and_pd(self.0, other.0) })
    }
}

impl BitOr for Avx2Mask {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        // SAFETY: an operand exists, so the processor has AVX2
        Avx2Mask(unsafe { _mm256_or_pd(self.0, other.0) })
    }
}

impl Not for Avx2Mask {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        // SAFETY: an operand exists, so the processor has AVX2
        Avx2Mask(unsafe { _mm256_xor_pd(self.0, _mm256_castsi256_pd(_mm256_set1_epi64x(-1))) })
    }
}

impl Scalar for Avx2 {
    type Mask = Avx2Mask;

    #[inline(always)]
    fn of(value: f64) -> Self {
        // SAFETY: the caller has asked the processor (module head)
        Avx2(unsafe { _mm256_set1_pd(value) })
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: an operand exists, so the processor has AVX2
        Avx2(unsafe { _mm256_sqrt_pd(self.0) })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: an operand exists, so the processor has AVX2
        Avx2(unsafe { _mm256_andnot_pd(_mm256_set1_pd(-0.0), self.0) })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // the instruction gives its second operand unless the first is greater
        // SAFETY: an operand exists, so the processor has AVX2
        Avx2(unsafe { _mm256_max_pd(other.0, self.0) })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: an operand exists, so the processor has AVX2
        Avx2(unsafe { _mm256_min_pd(other.0, self.0) })
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
    fn lt(self, other: Self) -> Avx2Mask {
        // SAFETY: an operand exists, so the processor has AVX2
        Avx2Mask(unsafe { _mm256_cmp_pd::<_CMP_LT_OQ>(self.0, other.0) })
    }
    #[inline(always)]
    fn select(mask: Avx2Mask, yes: Self, no: Self) -> Self {
        // SAFETY: an operand exists, so the processor has AVX2
        Avx2(unsafe { _mm256_blendv_pd(no.0, yes.0, mask.0) })
    }
    #[inline(always)]
    fn any(mask: Avx2Mask) -> bool {
        // SAFETY: an operand exists, so the processor has AVX2
        unsafe { _mm256_movemask_pd(mask.0) != 0 }
    }
}

impl Lanes for Avx2 {
    const COUNT: usize = 4;

    #[inline(always)]
    fn lane(&self, i: usize) -> f64 {
        // SAFETY: four doubles side by side
        let numbers = unsafe { &*(&raw const self.0).cast::<[f64; 4]>() };
        numbers[i]
    }
    #[inline(always)]
    fn set_lane(&mut self, i: usize, value: f64) {
        // SAFETY: four doubles side by side, borrowed for writing
        let numbers = unsafe { &mut *(&raw mut self.0).cast::<[f64; 4]>() };
        numbers[i] = value;
    }
    #[inline(always)]
    fn upper_half(self) -> Self {
        let upper = f64::from_bits(0xFFFF_FFFF_0000_0000);
        // SAFETY: an operand exists, so the processor has AVX2
        Avx2(unsafe { _mm256_and_pd(self.0, _mm256_set1_pd(upper)) })
    }
}
