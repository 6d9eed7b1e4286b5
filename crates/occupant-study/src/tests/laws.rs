//! Distributions against their moments and quantiles, and correlations.

use super::super::law::{Distribution, Law, Value};
use super::{numbers, study};

fn at(law: &Law, p: f64) -> f64 {
    match law.quantile(p) {
        Value::Number(x) => x,
        other => panic!("{other:?}"),
    }
}

/// Mean and variance of a law: the mean over 100 000 midpoints of equal probability.
fn moments(law: &Law) -> [f64; 2] {
    let n = 100_000;
    let x: Vec<f64> = (0..n).map(|i| at(law, (i as f64 + 0.5) / n as f64)).collect();
    let mean = x.iter().sum::<f64>() / n as f64;
    [mean, x.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / n as f64]
}

#[test]
fn distributions_have_their_moments() {
    let [a, b, c] = [2.0_f64, 8.0, 3.0];
    let log = (b / a).ln();
    let log_mean = (b - a) / log;
    // φ and Φ at the cuts ±1 of a normal distribution with mean 5 and standard deviation 3
    let (density, inside) = (0.241_970_724_519_143_37, 0.682_689_492_137_085_9);
    for (law, mean, variance) in [
        (Law::Distribution(Distribution::Uniform { from: a, to: b }), 5.0, 3.0),
        (
            Law::Distribution(Distribution::LogUniform { from: a, to: b }),
            log_mean,
            (b * b - a * a) / (2.0 * log) - log_mean.powi(2),
        ),
        (Law::Distribution(Distribution::Normal { mean: -1.0, sd: 2.0 }), -1.0, 4.0),
        (
            Law::Distribution(Distribution::Triangular { from: a, mode: c, to: b }),
            (a + b + c) / 3.0,
            (a * a + b * b + c * c - a * b - a * c - b * c) / 18.0,
        ),
        (
            Law::Distribution(Distribution::TruncatedNormal { mean: 5.0, sd: 3.0, from: a, to: b }),
            5.0,
            9.0 * (1.0 - 2.0 * density / inside),
        ),
    ] {
        let [m, v] = moments(&law);
        // measured: at most 5.8e-9 and 1.4e-5, the latter in the tails of the normal distribution
        assert!((m - mean).abs() < 1e-6, "{law:?}: mean {m}, not {mean}");
        assert!((v / variance - 1.0).abs() < 1e-4, "{law:?}: variance {v}, not {variance}");
    }
}

#[test]
fn quantiles_end_where_they_should() {
    for law in [
        Law::Distribution(Distribution::Uniform { from: 0.1, to: 0.7 }),
        Law::Distribution(Distribution::LogUniform { from: 0.1, to: 0.7 }),
        Law::Distribution(Distribution::Triangular { from: 0.1, mode: 0.1, to: 0.7 }),
        Law::Distribution(Distribution::Triangular { from: 0.1, mode: 0.7, to: 0.7 }),
        Law::Distribution(Distribution::TruncatedNormal { mean: -4.0, sd: 0.5, from: 0.1, to: 0.7 }),
        Law::Distribution(Distribution::TruncatedNormal { mean: 9.0, sd: 1.0, from: 0.1, to: 0.7 }),
    ] {
        assert!((at(&law, 0.0) - 0.1).abs() < 1e-12, "{law:?}");
        assert!((at(&law, 1.0) - 0.7).abs() < 1e-12, "{law:?}");
        let between: Vec<f64> = (0..=50).map(|i| at(&law, f64::from(i) / 50.0)).collect();
        assert!(between.windows(2).all(|w| w[0] < w[1]), "{law:?}");
    }
    let triangle = Law::Distribution(Distribution::Triangular { from: 0.0, mode: 1.0, to: 4.0 });
    // a quarter of the area lies below the mode
    assert!((at(&triangle, 0.25) - 1.0).abs() < 1e-15);
    let list = Law::List(["a", "b", "c"].map(|t| Value::Text(t.into())).to_vec());
    let drawn: Vec<Value> = [0.0, 0.3, 0.34, 0.66, 0.67, 1.0].map(|p| list.quantile(p)).to_vec();
    let wanted = ["a", "a", "b", "b", "c", "c"].map(|t| Value::Text(t.into()));
    assert_eq!(drawn, wanted);
}

/// Spearman's rank correlation of two columns.
fn rank_correlation(x: &[f64], y: &[f64]) -> f64 {
    let ranks = |x: &[f64]| {
        let mut order: Vec<usize> = (0..x.len()).collect();
        order.sort_by(|a, b| x[*a].total_cmp(&x[*b]));
        let mut ranks = vec![0.0; x.len()];
        order.iter().enumerate().for_each(|(rank, i)| ranks[*i] = rank as f64);
        ranks
    };
    let (a, b, n) = (ranks(x), ranks(y), x.len() as f64);
    let d2: f64 = a.iter().zip(&b).map(|(a, b)| (a - b).powi(2)).sum();
    1.0 - 6.0 * d2 / (n * (n * n - 1.0))
}

#[test]
fn correlations_are_reached_and_distributions_kept() {
    for design in ["monte_carlo", "latin_hypercube", "sobol"] {
        let n = 8192;
        let study = study(&format!(
            "design = {{ kind = \"{design}\", samples = {n} }}
            [[parameters]]
            name = \"mu\"
            path = \"materials.foam.friction\"
            range = {{ from = 0, to = 1 }}
            [[parameters]]
            name = \"k\"
            path = \"materials.foam.k1\"
            distribution = {{ kind = \"log_uniform\", from = 1000, to = 9000 }}
            [[parameters]]
            name = \"head\"
            path = \"posture.head\"
            distribution = {{ kind = \"normal\", mean = \"5 deg\", sd = \"1 deg\" }}
            [[parameters]]
            name = \"slack\"
            path = \"belts.lap.slack\"
            range = {{ from = 0, to = \"5 cm\" }}
            [[correlations]]
            between = [\"mu\", \"k\"]
            rank = 0.6
            [[correlations]]
            between = [\"head\", \"k\"]
            rank = -0.3"
        ));
        let mut columns = vec![Vec::new(); 4];
        for i in 0..n {
            for (column, x) in columns.iter_mut().zip(numbers(&study, i)) {
                column.push(x);
            }
        }
        for (a, b, wanted) in [(0, 1, 0.6), (1, 2, -0.3), (0, 2, 0.0), (0, 3, 0.0), (1, 3, 0.0)] {
            let found = rank_correlation(&columns[a], &columns[b]);
            // standard error about 0.011 for random samples; measured: at most 0.016, 0.017 and 3e-4 in the order of designs
            assert!((found - wanted).abs() < 0.03, "{design} {a} {b}: {found}");
        }
        // each fifth of the friction holds a fifth of the samples
        let below = columns[0].iter().filter(|x| **x < 0.2).count() as f64 / n as f64;
        assert!((below - 0.2).abs() < 0.015, "{design}: {below}");
        let middle = columns[1].iter().filter(|x| **x < 3000.0).count() as f64 / n as f64;
        assert!((middle - 0.5).abs() < 0.02, "{design}: {middle}");
    }
}
