//! Lanes in the wide registers of x86-64: four doubles with AVX2, eight with AVX-512 (F and DQ).
//!
//! Every `unsafe` here is the call of an instruction; values of [`Avx2`] and [`Avx512`] are created only if the
//! processor has theirs ([`has_avx2`](super::has_avx2), [`has_avx512`](super::has_avx512)).
#![allow(
    unsafe_code,
    unused_unsafe,
    reason = "the instructions of AVX are not there on every x86-64; dispatch asks the processor first; some masks are plain bits"
)]

use std::arch::x86_64::*;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use super::{Lanes, trig};
use crate::motion::scalar::{Scalar, in_place};

/// Lanes in one register and their truth values: each operation as an expression of registers.
macro_rules! lanes {
    (
        $Lanes:ident($Register:ty), $count:literal of them; $Mask:ident($Bits:ty);
        of |$value:ident| $of:expr;
        operators { $($On:ident: $Operator:ident $operator:ident |$left:ident $(, $right:ident)?| $result:expr;)* }
        functions { $($function:ident |$x:ident $(, $y:ident)?| $f:expr => $Out:ident;)* }
        select |$mask:ident, $yes:ident, $no:ident| $select:expr;
        any |$truths:ident| $any:expr;
        bits |$number:ident, $kept:ident| $and:expr;
    ) => {
        #[doc = concat!(stringify!($count), " numbers.")]
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct $Lanes($Register);

        #[doc = concat!(stringify!($count), " truth values.")]
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct $Mask($Bits);

        $(impl $Operator for $On {
            type Output = Self;
            #[inline(always)]
            fn $operator(self $(, $right: Self)?) -> Self {
                let $left = self.0;
                $(let $right = $right.0;)?
                // SAFETY: an operand exists, so the processor has the instruction (module head)
                $On(unsafe { $result })
            }
        })*

        in_place!([] $Lanes);

        impl Scalar for $Lanes {
            const IS_WIDE: bool = true;

            type Mask = $Mask;

            #[inline(always)]
            fn of($value: f64) -> Self {
                // SAFETY: the caller has asked the processor (module head)
                $Lanes(unsafe { $of })
            }
            $(#[inline(always)]
            fn $function(self $(, $y: Self)?) -> $Out {
                let $x = self.0;
                $(let $y = $y.0;)?
                // SAFETY: an operand exists, so the processor has the instruction
                $Out(unsafe { $f })
            })*
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
            fn select($mask: $Mask, $yes: Self, $no: Self) -> Self {
                let ($mask, $yes, $no) = ($mask.0, $yes.0, $no.0);
                // SAFETY: an operand exists, so the processor has the instruction
                $Lanes(unsafe { $select })
            }
            #[inline(always)]
            fn any($truths: $Mask) -> bool {
                let $truths = $truths.0;
                // SAFETY: an operand exists, so the processor has the instruction
                unsafe { $any }
            }
        }

        impl Lanes for $Lanes {
            const COUNT: usize = $count;

            #[inline(always)]
            fn lane(&self, i: usize) -> f64 {
                // SAFETY: so many doubles side by side
                let numbers = unsafe { &*(&raw const self.0).cast::<[f64; $count]>() };
                numbers[i]
            }
            #[inline(always)]
            fn set_lane(&mut self, i: usize, value: f64) {
                // SAFETY: so many doubles side by side, borrowed for writing
                let numbers = unsafe { &mut *(&raw mut self.0).cast::<[f64; $count]>() };
                numbers[i] = value;
            }
            #[inline(always)]
            fn upper_half(self) -> Self {
                let $number = self.0;
                let $kept = Self::of(f64::from_bits(0xFFFF_FFFF_0000_0000)).0;
                // SAFETY: an operand exists, so the processor has the instruction
                $Lanes(unsafe { $and })
            }
        }
    };
}

// min and max: the instructions give their second operand unless the first is less, or greater

lanes! {
    Avx2(__m256d), 4 of them; Avx2Mask(__m256d);
    of |value| _mm256_set1_pd(value);
    operators {
        Avx2: Add add |a, b| _mm256_add_pd(a, b);
        Avx2: Sub sub |a, b| _mm256_sub_pd(a, b);
        Avx2: Mul mul |a, b| _mm256_mul_pd(a, b);
        Avx2: Div div |a, b| _mm256_div_pd(a, b);
        Avx2: Neg neg |a| _mm256_xor_pd(a, _mm256_set1_pd(-0.0));
        Avx2Mask: BitAnd bitand |a, b| _mm256_and_pd(a, b);
        Avx2Mask: BitOr bitor |a, b| _mm256_or_pd(a, b);
        Avx2Mask: Not not |a| _mm256_xor_pd(a, _mm256_castsi256_pd(_mm256_set1_epi64x(-1)));
    }
    functions {
        sqrt |a| _mm256_sqrt_pd(a) => Avx2;
        abs |a| _mm256_andnot_pd(_mm256_set1_pd(-0.0), a) => Avx2;
        max |a, b| _mm256_max_pd(b, a) => Avx2;
        min |a, b| _mm256_min_pd(b, a) => Avx2;
        lt |a, b| _mm256_cmp_pd::<_CMP_LT_OQ>(a, b) => Avx2Mask;
    }
    select |mask, yes, no| _mm256_blendv_pd(no, yes, mask);
    any |mask| _mm256_movemask_pd(mask) != 0;
    bits |number, kept| _mm256_and_pd(number, kept);
}

lanes! {
    Avx512(__m512d), 8 of them; Avx512Mask(__mmask8);
    of |value| _mm512_set1_pd(value);
    operators {
        Avx512: Add add |a, b| _mm512_add_pd(a, b);
        Avx512: Sub sub |a, b| _mm512_sub_pd(a, b);
        Avx512: Mul mul |a, b| _mm512_mul_pd(a, b);
        Avx512: Div div |a, b| _mm512_div_pd(a, b);
        Avx512: Neg neg |a| _mm512_xor_pd(a, _mm512_set1_pd(-0.0));
        Avx512Mask: BitAnd bitand |a, b| a & b;
        Avx512Mask: BitOr bitor |a, b| a | b;
        Avx512Mask: Not not |a| !a;
    }
    functions {
        sqrt |a| _mm512_sqrt_pd(a) => Avx512;
        abs |a| _mm512_abs_pd(a) => Avx512;
        max |a, b| _mm512_max_pd(b, a) => Avx512;
        min |a, b| _mm512_min_pd(b, a) => Avx512;
        lt |a, b| _mm512_cmp_pd_mask::<_CMP_LT_OQ>(a, b) => Avx512Mask;
    }
    select |mask, yes, no| _mm512_mask_blend_pd(mask, no, yes);
    any |mask| mask != 0;
    bits |number, kept| _mm512_and_pd(number, kept);
}
