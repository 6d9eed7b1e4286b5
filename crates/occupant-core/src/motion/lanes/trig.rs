//! Sines and arcs of all lanes at once, with the bits of [`occupant_units::trig`].
//!
//! The operations are those of the library behind `occupant_units::trig` (the algorithms of Sun's fdlibm), in the same order; its
//! branches are selections here. Arguments that an occupant never has (zeros, infinities, angles beyond 5π/4 or within
//! 10⁻⁶ of π/2) go to the library one by one.

use super::Lanes;
use occupant_units::trig;

/// π/2 in two and in three parts, as the library splits it.
const HALF_PI_1: f64 = f64::from_bits(0x3FF9_21FB_5440_0000);
const HALF_PI_1T: f64 = f64::from_bits(0x3DD0_B461_1A62_6331);
const HALF_PI_HI: f64 = f64::from_bits(0x3FF9_21FB_5444_2D18);
const HALF_PI_LO: f64 = f64::from_bits(0x3C91_A626_3314_5C07);
const PI_HI: f64 = f64::from_bits(0x4009_21FB_5444_2D18);
const PI_LO: f64 = f64::from_bits(0x3CA1_A626_3314_5C07);

/// The least number whose upper 32 bits are `word`.
const fn from_upper(word: u32) -> f64 {
    f64::from_bits((word as u64) << 32)
}

/// Sine and cosine.
#[inline(always)]
pub(crate) fn sin_cos<L: Lanes>(x: L) -> (L, L) {
    let size = x.abs();
    let below = |upper: u32| size.lt(L::of(from_upper(upper)));
    // about π/4, 3π/4 and 5π/4, where the quarter turns begin; π/2 and π, where the reduction cancels
    let (first, second) = (below(0x3FE9_21FC), below(0x4002_D97D));
    let cancels = (!below(0x3FF9_21FB) & below(0x3FF9_21FC)) | (!below(0x4009_21FB) & below(0x4009_21FC));
    let tiny = below(0x3E46_A09E);
    if !L::all(below(0x400F_6A7B) & !cancels) {
        return sin_cos_one_by_one(x);
    }
    let (o, one) = (L::zero(), L::one());
    let sign = L::select(x.lt(o), -one, one);
    let turns = L::select(first, o, L::select(second, sign, sign + sign));
    let z = x - turns * L::of(HALF_PI_1);
    let tail = turns * L::of(HALF_PI_1T);
    let y0 = z - tail;
    let y1 = (z - y0) - tail;
    let (s, c) = (kernel_sin(y0, y1, first), kernel_cos(y0, y1));
    let quarter = second & !first;
    let half = !second;
    let sine = L::select(half, -s, L::select(quarter, c * turns, s));
    let cosine = L::select(half, -c, L::select(quarter, -(s * turns), c));
    (L::select(tiny, x, sine), L::select(tiny, one, cosine))
}

/// sin(x + y) for |x| ≤ π/4 and a small y; `alone` where y = 0.
#[inline(always)]
fn kernel_sin<L: Lanes>(x: L, y: L, alone: L::Mask) -> L {
    let c = |bits| L::of(f64::from_bits(bits));
    let s1 = c(0xBFC5_5555_5555_5549);
    let z = x * x;
    let w = z * z;
    let r = c(0x3F81_1111_1110_F8A6)
        + z * (c(0xBF2A_01A0_19C1_61D5) + z * c(0x3EC7_1DE3_57B1_FE7D))
        + z * w * (c(0xBE5A_E5E6_8A2B_9CEB) + z * c(0x3DE5_D93A_5ACF_D57C));
    let v = z * x;
    let short = x + v * (s1 + z * r);
    let long = x - ((z * (L::of(0.5) * y - v * r) - y) - v * s1);
    L::select(alone, short, long)
}

/// cos(x + y) for |x| ≤ π/4 and a small y.
#[inline(always)]
fn kernel_cos<L: Lanes>(x: L, y: L) -> L {
    let c = |bits| L::of(f64::from_bits(bits));
    let one = L::one();
    let z = x * x;
    let w = z * z;
    let r = z * (c(0x3FA5_5555_5555_554C) + z * (c(0xBF56_C16C_16C1_5177) + z * c(0x3EFA_01A0_19CB_1590)))
        + w * w * (c(0xBE92_7E4F_809C_52AD) + z * (c(0x3E21_EE9E_BDB4_B1C4) + z * c(0xBDA8_FAE9_BE88_38D4)));
    let hz = L::of(0.5) * z;
    let w = one - hz;
    w + (((one - w) - hz) + (z * r - x * y))
}

/// Angle of the point (`x`, `y`).
#[inline(always)]
pub(crate) fn atan2<L: Lanes>(y: L, x: L) -> L {
    let o = L::zero();
    let (size_x, size_y) = (x.abs(), y.abs());
    // neither vanishes, none much greater than the other
    let usual = |a: L, b: L| L::of(1e-250).lt(a) & a.lt(L::of(1e250)) & a.lt(b * L::of(1e18));
    if !L::all(usual(size_x, size_y) & usual(size_y, size_x)) {
        return atan2_one_by_one(y, x);
    }
    let z = atan_of_positive((y / x).abs());
    let z = L::select(x.lt(o), L::of(PI_HI) - (z - L::of(PI_LO)), z);
    L::select(y.lt(o), -z, z)
}

/// Arc tangent of a positive number below 2⁶⁶.
#[inline(always)]
fn atan_of_positive<L: Lanes>(x: L) -> L {
    let (one, two, half3) = (L::one(), L::of(2.0), L::of(1.5));
    let below = |limit: f64| x.lt(L::of(limit));
    let (r0, r1, r2, r3) = (below(0.4375), below(0.6875), below(1.1875), below(2.4375));
    let by_range =
        |a: L, b: L, c: L, d: L, e: L| L::select(r0, a, L::select(r1, b, L::select(r2, c, L::select(r3, d, e))));
    let over = by_range(x, two * x - one, x - one, x - half3, -one);
    let under = by_range(one, two + x, x + one, one + half3 * x, x);
    let bits = |b| L::of(f64::from_bits(b));
    let o = L::zero();
    let hi = by_range(
        o,
        bits(0x3FDD_AC67_0561_BB4F),
        bits(0x3FE9_21FB_5444_2D18),
        bits(0x3FEF_730B_D281_F69B),
        bits(HALF_PI_HI.to_bits()),
    );
    let lo = by_range(
        o,
        bits(0x3C7A_2B7F_222F_65E2),
        bits(0x3C81_A626_3314_5C07),
        bits(0x3C70_0788_7AF0_CBBD),
        bits(HALF_PI_LO.to_bits()),
    );
    let t = over / under;
    let z = t * t;
    let w = z * z;
    let c = |bits| L::of(f64::from_bits(bits));
    let s1 = z
        * (c(0x3FD5_5555_5555_550D)
            + w * (c(0x3FC2_4924_9200_83FF)
                + w * (c(0x3FB7_45CD_C54C_206E)
                    + w * (c(0x3FB1_0D66_A0D0_3D51) + w * (c(0x3FA9_7B4B_2476_0DEB) + w * c(0x3F90_AD3A_E322_DA11))))));
    let s2 = w
        * (c(0xBFC9_9999_9998_EBC4)
            + w * (c(0xBFBC_71C6_FE23_1671)
                + w * (c(0xBFB3_B0F2_AF74_9A6D) + w * (c(0xBFAD_DE2D_52DE_FD9A) + w * c(0xBFA2_B444_2C6A_6C2F)))));
    hi - (t * (s1 + s2) - lo - t)
}

/// Arc cosine.
#[inline(always)]
pub(crate) fn acos<L: Lanes>(x: L) -> L {
    let (one, two, half) = (L::one(), L::of(2.0), L::of(0.5));
    let (hi, lo) = (L::of(HALF_PI_HI), L::of(HALF_PI_LO));
    let size = x.abs();
    if !L::all(L::of(1e-16).lt(size) & size.lt(one)) {
        return acos_one_by_one(x);
    }
    let small = size.lt(half);
    let z = L::select(small, x * x, (one - size) * half);
    let r = acos_rational(z);
    let near_half_pi = hi - (x - (lo - x * r));
    let s = z.sqrt();
    let near_pi = two * (hi - (s + (r * s - lo)));
    let df = s.upper_half();
    let c = (z - df * df) / (s + df);
    let near_zero = two * (df + (r * s + c));
    let far = L::select(x.lt(L::zero()), near_pi, near_zero);
    L::select(small, near_half_pi, far)
}

#[inline(always)]
fn acos_rational<L: Lanes>(z: L) -> L {
    let c = |bits| L::of(f64::from_bits(bits));
    let p = z
        * (c(0x3FC5_5555_5555_5555)
            + z * (c(0xBFD4_D612_03EB_6F7D)
                + z * (c(0x3FC9_C155_0E88_4455)
                    + z * (c(0xBFA4_8228_B568_8F3B) + z * (c(0x3F49_EFE0_7501_B288) + z * c(0x3F02_3DE1_0DFD_F709))))));
    let q = L::one()
        + z * (c(0xC003_3A27_1C8A_2D4B)
            + z * (c(0x4000_2AE5_9C59_8AC8) + z * (c(0xBFE6_066C_1B8D_0159) + z * c(0x3FB3_B8C5_B12E_9282))));
    p / q
}

#[cold]
#[inline(never)]
fn sin_cos_one_by_one<L: Lanes>(x: L) -> (L, L) {
    let (mut sine, mut cosine) = (x, x);
    for i in 0..L::COUNT {
        let (s, c) = trig::sin_cos(x.lane(i));
        sine.set_lane(i, s);
        cosine.set_lane(i, c);
    }
    (sine, cosine)
}

#[cold]
#[inline(never)]
fn atan2_one_by_one<L: Lanes>(mut y: L, x: L) -> L {
    for i in 0..L::COUNT {
        y.set_lane(i, trig::atan2(y.lane(i), x.lane(i)));
    }
    y
}

#[cold]
#[inline(never)]
fn acos_one_by_one<L: Lanes>(mut x: L) -> L {
    for i in 0..L::COUNT {
        x.set_lane(i, trig::acos(x.lane(i)));
    }
    x
}
