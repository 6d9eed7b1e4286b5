pub(crate) mod plain;

use super::*;
use occupant_units::trig;

/// A fixed sequence of numbers in [0, 1).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        // Knuth's linear congruential generator
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Numbers of all magnitudes, and special values.
fn numbers(scale: f64) -> Vec<f64> {
    let mut all = vec![
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.5,
        -0.5,
        2.0,
        0.4375,
        0.6875,
        1.1875,
        2.4375,
        1e-9,
        -1e-9,
        1e-17,
        1e-300,
        5e-324,
        1e19,
        1e300,
        f64::MAX,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
    ];
    for word in
        [0x3FE9_21FB_u64, 0x4002_D97C, 0x400F_6A7A, 0x3FF9_21FB, 0x4009_21FB, 0x3E46_A09E, 0x3FE0_0000, 0x3FF0_0000]
    {
        for bits in [word << 32, (word << 32) - 1, (word + 1) << 32, ((word + 1) << 32) - 1] {
            let x = f64::from_bits(bits);
            all.extend([x, -x]);
        }
    }
    let mut random = Numbers(7);
    for i in 0..40_000 {
        let size = if i % 4 == 0 { 10_f64.powf(20.0 * random.next() - 14.0) } else { scale };
        all.push(size * (2.0 * random.next() - 1.0));
    }
    while all.len() % 8 != 0 {
        all.push(0.7);
    }
    all
}

fn gather<L: Lanes>(numbers: &[f64]) -> L {
    let mut lanes = L::zero();
    for (i, x) in numbers.iter().enumerate() {
        lanes.set_lane(i, *x);
    }
    lanes
}

/// Bits, or one pattern for all NaNs: their sign and payload are irrelevant.
fn bits(x: f64) -> u64 {
    if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() }
}

/// Compares a function of lanes with that of numbers.
fn compare<L: Lanes>(
    name: &str,
    (a, b): (&[f64], &[f64]),
    of_lanes: impl Fn(L, L) -> L,
    of_numbers: impl Fn(f64, f64) -> f64,
) {
    for (a, b) in a.chunks_exact(L::COUNT).zip(b.chunks_exact(L::COUNT)) {
        let found = of_lanes(gather(a), gather(b));
        for i in 0..L::COUNT {
            let expected = of_numbers(a[i], b[i]);
            let same = bits(found.lane(i)) == bits(expected);
            assert!(same, "{name}({:e}, {:e}): {:e}, not {expected:e}", a[i], b[i], found.lane(i));
        }
    }
}

fn check<L: Lanes>() {
    let angles = numbers(4.2);
    let cosines = numbers(1.0);
    let mut others = numbers(3.0);
    others.reverse();
    let pair = (&angles[..], &others[..]);
    compare::<L>("add", pair, |a, b| a + b, |a, b| a + b);
    compare::<L>("sub", pair, |a, b| a - b, |a, b| a - b);
    compare::<L>("mul", pair, |a, b| a * b, |a, b| a * b);
    compare::<L>("div", pair, |a, b| a / b, |a, b| a / b);
    compare::<L>("neg", pair, |a, _| -a, |a, _| -a);
    compare::<L>("abs", pair, |a, _| a.abs(), |a, _| a.abs());
    compare::<L>("sqrt", pair, |a, _| a.sqrt(), |a, _| a.sqrt());
    compare::<L>("max", pair, |a, b| a.max(b), <f64 as Scalar>::max);
    compare::<L>("min", pair, |a, b| a.min(b), <f64 as Scalar>::min);
    let chosen = |a: L, b: L| L::select(!a.lt(b) & b.gt(-a) | a.lt(L::zero()), a, b);
    let choice = |a: f64, b: f64| {
        let less = a < b;
        if !less && b > -a || a < 0.0 { a } else { b }
    };
    compare::<L>("select", pair, chosen, choice);
    compare::<L>("sin", pair, |a, _| a.sin_cos().0, |a, _| trig::sin_cos(a).0);
    compare::<L>("cos", pair, |a, _| a.sin_cos().1, |a, _| trig::sin_cos(a).1);
    compare::<L>("atan2", pair, |a, b| a.atan2(b), trig::atan2);
    let one = (&cosines[..], &others[..]);
    compare::<L>("acos", one, |a, _| a.acos(), |a, _| trig::acos(a));
    let upper = |a: f64| f64::from_bits(a.to_bits() >> 32 << 32);
    compare::<L>("upper half", one, |a, _| a.upper_half(), |a, _| upper(a));
    // the odd numbers above put most groups into the branch of one by one: ordinary ones alone as well
    let ordinary = |scale: f64, off: f64| -> Vec<f64> {
        let mut random = Numbers(11);
        (0..80_000).map(|_| off + scale * (2.0 * random.next() - 1.0)).collect()
    };
    let (x, y) = (ordinary(3.9, 0.0), ordinary(1.0, 1e-3));
    compare::<L>("sin", (&x, &y), |a, _| a.sin_cos().0, |a, _| trig::sin_cos(a).0);
    compare::<L>("cos", (&x, &y), |a, _| a.sin_cos().1, |a, _| trig::sin_cos(a).1);
    compare::<L>("acos", (&ordinary(0.999, 0.0), &y), |a, _| a.acos(), |a, _| trig::acos(a));
    let mut y = y;
    y.reverse();
    compare::<L>("atan2", (&x, &y), |a, b| a.atan2(b), trig::atan2);
}

#[test]
fn an_array_of_lanes_has_the_bits_of_numbers() {
    check::<Plain<1>>();
    check::<Plain<4>>();
}

#[test]
#[cfg(target_arch = "x86_64")]
fn registers_of_lanes_have_the_bits_of_numbers() {
    if has_avx2() {
        check::<Avx2>();
    }
    if has_avx512() {
        check::<Avx512>();
    }
}
