//! Quantiles, intervals and histograms against closed forms.

use super::*;
use crate::normal;
use crate::random::{Purpose, unit};

/// Sample number `seed` of a distribution by its quantile function.
fn sample(seed: u64, n: usize, of: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..n).map(|i| of(unit(seed, Purpose::MonteCarlo, i as u64, 0))).collect()
}

/// P(B ≤ k) of the binomial distribution (n, p) by its definition, with plain factorials.
fn cumulative(n: usize, p: f64, k: usize) -> f64 {
    let choose = |k: usize| (1..=k).fold(1.0, |c, i| c * (n - k + i) as f64 / i as f64);
    (0..=k).map(|k| choose(k) * p.powi(k as i32) * (1.0 - p).powi((n - k) as i32)).sum()
}

#[test]
fn ranks_are_the_innermost_ones_with_two_and_a_half_per_cent_to_each_side() {
    for n in 1..=200 {
        for part in PARTS {
            let [low, high] = ranks(n, part);
            let missed_below = |l: usize| if l == 0 { 0.0 } else { cumulative(n, part, l - 1) };
            let l = low.unwrap_or(0);
            assert!(missed_below(l) <= TAIL + 1e-12 && missed_below(l + 1) > TAIL - 1e-12, "{n} {part} {l}");
            let missed_above = |u: usize| 1.0 - cumulative(n, part, u - 1);
            match high {
                Some(u) => assert!(
                    missed_above(u) <= TAIL + 1e-12 && (u == 1 || missed_above(u - 1) > TAIL - 1e-12),
                    "{n} {part} {u}"
                ),
                None => assert!(missed_above(n) > TAIL - 1e-12),
            }
            // both ends exist from the number on that is said to be needed
            assert_eq!(low.is_some() && high.is_some(), n >= needed(part), "{n} {part}");
        }
    }
    // as in tables: 95 % interval of the median of 10 values from rank 2 to 9, of 100 from 40 to 61
    assert_eq!([ranks(10, 0.5), ranks(100, 0.5)], [[Some(2), Some(9)], [Some(40), Some(61)]]);
    assert_eq!(PARTS.map(needed), [146, 72, 13, 6, 13, 72, 146]);
}

#[test]
fn the_estimate_lies_within_its_interval_and_large_samples_do_not_underflow() {
    for n in (1..400).chain([1_000, 20_000, 1_000_000]) {
        let values: Vec<f64> = (0..n).map(|i| i as f64).collect();
        for q in quantiles(&Ordered::of(&values)) {
            assert!(q.low.is_none_or(|low| low <= q.value) && q.high.is_none_or(|high| high >= q.value), "{n} {q:?}");
        }
    }
}

/// Coverage of the intervals over many samples of known distributions: 4000 samples of 60 and of 200 values. Order
/// statistics cover at least 95 % each; a sampling error of 4000 is 0.34 %.
#[test]
fn intervals_cover_the_true_quantiles_of_three_distributions() {
    const SAMPLES: u64 = 4000;
    let uniform: fn(f64) -> f64 = |u| 3.0 + 2.0 * u;
    let normal: fn(f64) -> f64 = |u| 500.0 + 80.0 * normal::quantile(u);
    let exponential: fn(f64) -> f64 = |u| -ln(1.0 - u);
    let mut least: f64 = 1.0;
    for of in [uniform, normal, exponential] {
        for n in [60, 200] {
            let mut covered = [0_u32; PARTS.len()];
            for seed in 0..SAMPLES {
                for (i, q) in quantiles(&Ordered::of(&sample(seed, n, of))).iter().enumerate() {
                    let truth = of(q.part);
                    let misses = q.low.is_some_and(|low| low > truth) || q.high.is_some_and(|high| high <= truth);
                    covered[i] += u32::from(!misses);
                }
            }
            let part = covered.map(|c| f64::from(c) / SAMPLES as f64);
            least = part.into_iter().fold(least, f64::min);
        }
    }
    // measured: 0.9603
    assert!(least > 0.945, "{least}");
}

/// A linear model y = 2 a + 3 b of two uniform inputs: its quantiles are known, √(2·6·p) in the first part of the trapezoid.
#[test]
fn quantiles_of_a_linear_model_are_found() {
    let (n, mut worst) = (20_000, 0.0_f64);
    let values: Vec<f64> =
        (0..n).map(|i| 2.0 * unit(7, Purpose::MonteCarlo, i, 0) + 3.0 * unit(7, Purpose::MonteCarlo, i, 1)).collect();
    // density of 2a + 3b: y/6 up to 2, 1/3 up to 3, (5 − y)/6 up to 5
    let truth = |p: f64| match p {
        p if p <= 1.0 / 3.0 => (12.0 * p).sqrt(),
        p if p <= 2.0 / 3.0 => 2.0 + 3.0 * (p - 1.0 / 3.0),
        p => 5.0 - (12.0 * (1.0 - p)).sqrt(),
    };
    for q in quantiles(&Ordered::of(&values)) {
        let truth = truth(q.part);
        assert!(q.low.unwrap() <= truth && truth <= q.high.unwrap(), "{q:?} {truth}");
        worst = worst.max((q.value - truth).abs());
    }
    // measured: 0.015
    assert!(worst < 0.03, "{worst}");
    // P(y > 4) = 1/12
    let e = exceedance(&Sketch::exact(&values), 4.0).unwrap();
    assert!(e.low < 1.0 / 12.0 && 1.0 / 12.0 < e.high && (e.probability - 1.0 / 12.0).abs() < 0.005, "{e:?}");
}

#[test]
fn wilsons_interval_has_its_published_values_and_its_coverage() {
    // R. G. Newcombe, "Two-sided confidence intervals for the single proportion", Statistics in Medicine 17 (1998), table I
    for (some, all, low, high) in
        [(81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0.0, 0.1611), (1, 29, 0.0061, 0.1718)]
    {
        let found = wilson(some, all).unwrap();
        assert!((found[0] - low).abs() < 5e-5 && (found[1] - high).abs() < 5e-5, "{some} of {all}: {found:?}");
    }
    assert_eq!((wilson(0, 0), wilson(5, 5).unwrap()[1]), (None, 1.0));
    // coverage on the average over p, by the binomial distribution itself
    let n = 50;
    let covered = |p: f64| {
        let (first, weights) = binomial(n, p);
        let within = |k: usize| wilson(k, n).is_some_and(|[low, high]| low <= p && p <= high);
        weights.iter().enumerate().filter(|(i, _)| within(first + i)).map(|(_, w)| w).sum::<f64>()
    };
    let mean = (1..1000).map(|i| covered(f64::from(i) / 1000.0)).sum::<f64>() / 999.0;
    // measured: 0.9517
    assert!((0.945..0.96).contains(&mean), "{mean}");
}

#[test]
fn a_limit_is_exceeded_only_by_what_is_above_it() {
    let e = exceedance(&Sketch::exact(&[1.0, 2.0, f64::NAN, 3.0, 2.0]), 2.0).unwrap();
    assert_eq!((e.above, e.of, e.probability), (1, 4, 0.25));
    assert_eq!(exceedance(&Sketch::exact(&[f64::NAN]), 2.0), None);
    // 0.5 needs most: 2·1.96·0.5/√n = 0.1 at n = 384, less z² of Wilson's
    assert_eq!((needed_for(0.5), needed_for(0.0)), (381, 35));
}

#[test]
fn a_histogram_counts_each_value_once_between_round_ends() {
    let values = sample(3, 500, |u| 0.5 + 0.1 * normal::quantile(u));
    let found = histogram(&Ordered::of(&values), 1e-3).unwrap();
    assert_eq!(found.counts.iter().sum::<usize>(), 500);
    // 2·IQR·n^(−1/3) = 34 mm
    assert!((found.width - 0.05).abs() < 1e-12 && (found.from / 0.05 - (found.from / 0.05).round()).abs() < 1e-9);
    for (i, count) in found.counts.iter().enumerate() {
        let [from, to] = [i, i + 1].map(|i| found.from + i as f64 * found.width);
        assert_eq!(*count, values.iter().filter(|x| (from..to).contains(*x)).count());
    }
    assert_eq!((histogram(&Ordered::of(&[2.0, 2.0]), 1.0), histogram(&Ordered::default(), 1.0)), (None, None));
    // most alike, one far away: no more bars than can be drawn
    let mut far = vec![1.0; 100];
    far.push(1e6);
    assert!(histogram(&Ordered::of(&far), 1.0).unwrap().counts.len() <= 42);
    assert_eq!([0.0021, 3.4, 7.0, 1.0, 50.0].map(round_up), [0.005, 5.0, 10.0, 1.0, 50.0]);
}
