//! Eight lanes in the 512-bit registers of x86-64 with AVX-512 (F and DQ).
//!
//! Every `unsafe` here is the call of an instruction of AVX-512; values of [`Avx512`] are made only where the processor has it.
#![allow(
    unsafe_code,
    reason = "the instructions of AVX-512 are not there on every x86-64; dispatch asks the processor first"
)]

use std::arch::x86_64::*;
use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, Neg, Not, Sub, SubAssign};

use super::{Lanes, trig};
use crate::motion::scalar::Scalar;

/// Eight numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx512(__m512d);

/// Eight truth values, one bit each.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx512Mask(__mmask8);

impl Add for Avx512 {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        // SAFETY: an operand exists, so the processor has AVX-512 (module head); likewise below
        Avx512(unsafe { _mm512_add_pd(self.0, other.0) })
    }
}

impl Sub for Avx512 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        // SAFETY: an operand exists, so the processor has AVX-512
        Avx512(unsafe { _mm512_sub_pd(self.0, other.0) })
    }
}

impl Mul for Avx512 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        // SAFETY: an operand exists, so the processor has AVX-512
        Avx512(unsafe { _mm512_mul_pd(self.0, other.0) })
    }
}

impl Div for Avx512 {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        // SAFETY: an operand exists, so the processor has AVX-512
        Avx512(unsafe { _mm512_div_pd(self.0, other.0) })
    }
}

impl Neg for Avx512 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: an operand exists, so the processor has AVX-512
        Avx512(unsafe { _mm512_xor_pd(self.0, _mm512_set1_pd(-0.0)) })
    }
}

impl AddAssign for Avx512 {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Avx512 {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl BitAnd for Avx512Mask {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Avx512Mask(self.0 & other.0)
    }
}

impl BitOr for Avx512Mask {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Avx512Mask(self.0 | other.0)
    }
}

impl Not for Avx512Mask {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Avx512Mask(!self.0)
    }
}

impl Scalar for Avx512 {
    type Mask = Avx512Mask;

    #[inline(always)]
    fn of(value: f64) -> Self {
        // SAFETY: the caller has asked the processor (module head)
        Avx512(unsafe { _mm512_set1_pd(value) })
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: an operand exists, so the processor has AVX-512
        Avx512(unsafe { _mm512_sqrt_pd(self.0) })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: an operand exists, so the processor has AVX-512
        Avx512(unsafe { _mm512_abs_pd(self.0) })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // the instruction gives its second operand unless the first is greater
        // SAFETY: an operand exists, so the processor has AVX-512
        Avx512(unsafe { _mm512_max_pd(other.0, self.0) })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: an operand exists, so the processor has AVX-512
        Avx512(unsafe { _mm512_min_pd(other.0, self.0) })
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
    fn lt(self, other: Self) -> Avx512Mask {
        // SAFETY: an operand exists, so the processor has AVX-512
        Avx512Mask(unsafe { _mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.0, other.0) })
    }
    #[inline(always)]
    fn select(mask: Avx512Mask, yes: Self, no: Self) -> Self {
        // SAFETY: an operand exists, so the processor has AVX-512
        Avx512(unsafe { _mm512_mask_blend_pd(mask.0, no.0, yes.0) })
    }
    #[inline(always)]
    fn any(mask: Avx512Mask) -> bool {
        mask.0 != 0
    }
}

impl Lanes for Avx512 {
    const COUNT: usize = 8;

    #[inline(always)]
    fn lane(&self, i: usize) -> f64 {
        // SAFETY: eight doubles side by side
        let numbers = unsafe { &*(&raw const self.0).cast::<[f64; 8]>() };
        numbers[i]
    }
    #[inline(always)]
    fn set_lane(&mut self, i: usize, value: f64) {
        // SAFETY: eight doubles side by side, borrowed for writing
        let numbers = unsafe { &mut *(&raw mut self.0).cast::<[f64; 8]>() };
        numbers[i] = value;
    }
    #[inline(always)]
    fn upper_half(self) -> Self {
        let upper = f64::from_bits(0xFFFF_FFFF_0000_0000);
        // SAFETY: an operand exists, so the processor has AVX-512
        Avx512(unsafe { _mm512_and_pd(self.0, _mm512_set1_pd(upper)) })
    }
}
