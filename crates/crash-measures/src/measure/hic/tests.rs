use super::*;
use std::f64::consts::PI;

const G: f64 = STANDARD_GRAVITY_MPS2;

#[derive(Clone, Copy, Debug)]
enum Shape {
    Square,
    HalfSine,
    Haversine,
    Triangle,
}

fn unit(shape: Shape, x: f64) -> f64 {
    match shape {
        Shape::Square => 1.0,
        Shape::HalfSine => (PI * x).sin(),
        Shape::Haversine => (PI * x).sin().powi(2),
        Shape::Triangle => 1.0 - (2.0 * x - 1.0).abs(),
    }
}

/// Pulse of `peak_g` and `length_s` between zeros (a square stands alone: its flanks are vertical).
fn pulse(shape: Shape, peak_g: f64, length_s: f64, dt_s: f64) -> Vec<f64> {
    let quiet = if matches!(shape, Shape::Square) { 0 } else { whole_steps(0.01, dt_s) };
    let n = (length_s / dt_s).round() as usize;
    let inside = (0..=n).map(|i| G * peak_g * unit(shape, i as f64 / n as f64));
    let zeros = || std::iter::repeat_n(0.0, quiet);
    zeros().chain(inside).chain(zeros()).collect()
}

/// Closed forms, W large enough: (HIC/(A^2.5 T), window/T).
fn closed_form(shape: Shape) -> (f64, f64) {
    match shape {
        Shape::Square => (1.0, 1.0),
        Shape::HalfSine => (0.414_645_649_541_511_56, 0.670_229_661_063_360_9),
        Shape::Haversine => (0.302_938_854_957_896_6, 0.507_591_819_987_324_6),
        Shape::Triangle => (4.0 / 7.0 * (5.0f64 / 7.0).powf(2.5), 4.0 / 7.0),
    }
}

/// Closed form of a window-limited optimum, u = W/T below the free optimum.
fn limited(shape: Shape, peak_g: f64, length_s: f64, u: f64) -> f64 {
    let mean = match shape {
        Shape::HalfSine => 2.0 / PI * (0.5 * PI * u).sin() / u,
        Shape::Haversine => 0.5 * (u + (PI * u).sin() / PI) / u,
        Shape::Triangle => 1.0 - 0.5 * u,
        Shape::Square => 1.0,
    };
    peak_g.powf(2.5) * length_s * u * mean.powf(2.5)
}

#[test]
fn closed_forms_of_four_pulses_at_fine_sampling() {
    for shape in [Shape::Square, Shape::HalfSine, Shape::Haversine, Shape::Triangle] {
        for (peak_g, length_s) in [(100.0, 0.010), (150.0, 0.005), (60.0, 0.014)] {
            let signal = pulse(shape, peak_g, length_s, 2e-6);
            let found = hic(&signal, 2e-6, HicWindow::Ms15).unwrap();
            let (factor, u) = closed_form(shape);
            let expected = factor * f64::powf(peak_g, 2.5) * length_s;
            let error = (found.value / expected - 1.0).abs();
            // measured 5.1e-7 (haversine, 5 ms), the error of the chords
            assert!(error < 1e-6, "{shape:?} {peak_g} g: {error:e}");
            let window_error = (found.end_s - found.start_s - u * length_s).abs();
            assert!(window_error < 2e-6, "{shape:?}: window off by {window_error:e} s");
        }
    }
}

#[test]
fn window_limited_closed_forms() {
    for (shape, peak_g, length_s) in
        [(Shape::HalfSine, 60.0, 0.04), (Shape::HalfSine, 80.0, 0.1), (Shape::Haversine, 80.0, 0.1)]
    {
        for window in [HicWindow::Ms15, HicWindow::Ms36] {
            let u = (window.seconds() / length_s).min(closed_form(shape).1);
            let found = hic(&pulse(shape, peak_g, length_s, 1e-5), 1e-5, window).unwrap();
            let error = (found.value / limited(shape, peak_g, length_s, u) - 1.0).abs();
            // measured 1.3e-7 at most
            assert!(error < 1e-6, "{shape:?} {window:?}: {error:e}");
        }
    }
    // numbers printed in the collection of formulas
    let half_sine = pulse(Shape::HalfSine, 60.0, 0.04, 1e-5);
    assert!((hic(&half_sine, 1e-5, HicWindow::Ms15).unwrap().value - 361.3591).abs() < 2e-4);
    assert!((hic(&half_sine, 1e-5, HicWindow::Ms36).unwrap().value - 462.5037).abs() < 2e-4);
}

#[test]
fn the_longest_window_is_not_always_the_best() {
    // a non-negative 100 g / 10 ms half-sine in a record of zeros: both windows give 414.6
    let signal = pulse(Shape::HalfSine, 100.0, 0.01, 1e-4);
    let (w15, w36) = (hic(&signal, 1e-4, HicWindow::Ms15), hic(&signal, 1e-4, HicWindow::Ms36));
    assert_eq!(w15, w36);
    let found = w15.unwrap();
    assert!((found.value - 414.6456).abs() < 0.1); // measured 414.5605 at 10 kHz
    assert!(found.value > 414.4650, "at least the best of the sampled windows, 414.4651");
}

/// The best window that starts and ends on samples, by trying all.
fn best_on_samples(signal: &[f64], dt_s: f64, longest: usize) -> f64 {
    let integral = CumulativeIntegral::new(signal, dt_s).unwrap();
    let ends = |i| (i + 1..signal.len().min(i + longest + 1)).map(move |j| (i, j));
    let windows = (0..signal.len()).flat_map(ends);
    let values = windows.map(|(i, j)| hic_of_window(&integral, i as f64 * dt_s, j as f64 * dt_s).value);
    values.fold(0.0, f64::max)
}

#[test]
fn skipping_misses_no_window_on_samples() {
    let mut seed = 7u64;
    for case in 0..40 {
        let mut level = 0.0;
        let noise: Vec<f64> = (0..400)
            .map(|_| {
                seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
                level = 0.9 * level + ((seed >> 33) as f64 / (1u64 << 31) as f64 - 0.4 - 0.01 * case as f64) * 100.0;
                level
            })
            .collect();
        let on_samples = best_on_samples(&noise, 1e-4, 150);
        let found = hic(&noise, 1e-4, HicWindow::Ms15).unwrap().value;
        assert!(found >= on_samples * (1.0 - 1e-12), "case {case}: {found} {on_samples}");
    }
}

/// The best window of the line whose ends lie on a grid of `per` points an interval, an HIC.
fn best_on_grid(signal: &[f64], dt_s: f64, limit_s: f64, per: usize) -> f64 {
    let integral = CumulativeIntegral::new(signal, dt_s).unwrap();
    let fine_s = dt_s / per as f64;
    let at: Vec<f64> = (0..=(signal.len() - 1) * per).map(|i| integral.at(i as f64 * fine_s)).collect();
    let mut best_04: f64 = 0.0;
    for lag in 1..=whole_steps(limit_s, fine_s).min(at.len() - 1) {
        let gain = at.iter().zip(&at[lag..]).map(|(from, to)| to - from).fold(0.0, f64::max);
        best_04 = best_04.max(gain / G * (lag as f64 * fine_s).powf(-0.6));
    }
    best_04.powf(2.5)
}

#[test]
fn no_window_of_a_fine_grid_beats_the_best_one() {
    let mut seed = 11u64;
    let mut uniform = || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 33) as f64 / (1u64 << 31) as f64
    };
    let (dt_s, mut closest): (f64, f64) = (1e-3, 1.0);
    for case in 0..60 {
        // a pulse, noise, and spikes of one sample; a few signals change sign
        let (crest, noise, spikes) = (uniform() * 60.0, uniform() * 20.0, uniform() * 0.3);
        let sign = if case % 5 == 0 { -0.5 } else { 0.0 };
        let signal: Vec<f64> = (0..60)
            .map(|i| {
                let spike = if uniform() < spikes { 300.0 * uniform() } else { 0.0 };
                G * (crest * (PI * f64::from(i) / 59.0).sin() + noise * (uniform() + sign) + spike)
            })
            .collect();
        for limit_s in [0.004, 0.0103, 0.015, 0.036, 0.2] {
            let found = hic(&signal, dt_s, HicWindow::Other(limit_s)).unwrap();
            let integral = CumulativeIntegral::new(&signal, dt_s).unwrap();
            assert_eq!(found, hic_of_window(&integral, found.start_s, found.end_s));
            assert!(found.end_s - found.start_s <= limit_s * (1.0 + 1e-12));
            let on_grid = best_on_grid(&signal, dt_s, limit_s, 10);
            assert!(found.value >= on_grid * (1.0 - 1e-12), "case {case}, {limit_s} s: {found:?} {on_grid}");
            closest = closest.min(on_grid / found.value);
        }
    }
    // measured 0.9968
    assert!(closest > 0.99, "the grid has {closest} of the best window: it is no measure of it");
}

#[test]
fn a_lone_spike_counts_as_the_triangle_that_the_line_makes_of_it() {
    // the best triangle of two intervals; sample pairs see its mean over both, 2·(1/2)^2.5
    let mut signal = [0.0; 40];
    signal[17] = 100.0 * G;
    let found = hic(&signal, 1e-3, HicWindow::Ms15).unwrap();
    let triangle = closed_form(Shape::Triangle).0 * 1e5 * 2e-3;
    assert!((found.value / triangle - 1.0).abs() < 1e-12, "{} {triangle}", found.value);
    assert!((found.value / (1e5 * 1e-3 * 2.0 * 0.5f64.powf(2.5)) - 1.394).abs() < 1e-3);
    // a wider hump with as good a sampled window does not hide it
    signal[25..30].fill(39.0 * G);
    let with_hump = hic(&signal, 1e-3, HicWindow::Ms15).unwrap();
    assert!(with_hump.value >= best_on_grid(&signal, 1e-3, 0.015, 20));
}

#[test]
fn the_optimum_obeys_its_conditions() {
    // 16400/((t-68)²+400) + 1480/((t-93)²+18), t in ms: a two-peak head signal of a textbook page
    let signal: Vec<f64> = (0..=15000)
        .map(|i| {
            let ms = i as f64 * 0.01;
            G * (16400.0 / ((ms - 68.0).powi(2) + 400.0) + 1480.0 / ((ms - 93.0).powi(2) + 18.0))
        })
        .collect();
    let a = |s: f64| signal[(s / 1e-5).round() as usize] / G;
    let free = hic(&signal, 1e-5, HicWindow::Other(0.05)).unwrap();
    let mean = (free.value / (free.end_s - free.start_s)).powf(0.4);
    assert!((a(free.start_s) / (0.6 * mean) - 1.0).abs() < 1e-3, "{}", a(free.start_s) / mean);
    assert!((a(free.end_s) / (0.6 * mean) - 1.0).abs() < 1e-3);
    assert!((free.value - 728.903).abs() < 2e-2); // computed elsewhere at 10 kHz: 728.9030
    let limited = hic(&signal, 1e-5, HicWindow::Ms15).unwrap();
    assert!((limited.end_s - limited.start_s - 0.015).abs() < 1e-12);
    assert!((a(limited.start_s) / a(limited.end_s) - 1.0).abs() < 2e-3);
    assert!((limited.value - 534.1483).abs() < 2e-2);
    assert!((hic(&signal, 1e-5, HicWindow::Ms36).unwrap().value - 682.7424).abs() < 2e-2);
}

#[test]
fn published_examples() {
    // sin(20πt) g, 0..0.05 s, window 30 ms: 0.02048 between 10 and 40 ms
    let sine: Vec<f64> = (0..=500).map(|i| G * (20.0 * PI * i as f64 * 1e-4).sin()).collect();
    let found = hic(&sine, 1e-4, HicWindow::Other(0.03)).unwrap();
    assert!((found.value - 0.020_480_2).abs() < 1e-7);
    assert!((found.start_s - 0.010).abs() < 1e-6 && (found.end_s - 0.040).abs() < 1e-6);
    // 10·sin t over half a period: the best 36 ms stand around the crest
    let slow: Vec<f64> = (0..=3141).map(|i| 10.0 * G * (f64::from(i) * 1e-3).sin()).collect();
    let found = hic(&slow, 1e-3, HicWindow::Ms36).unwrap().value;
    let expected = 0.036 * (20.0 * 0.018f64.sin() / 0.036).powf(2.5);
    assert!((found / expected - 1.0).abs() < 1e-6); // measured 2.1e-7
    // 22000/((t − 74)² + 500), t in ms: the same head with an airbag, 10 kHz
    let airbag: Vec<f64> = (0..=1500).map(|i| G * 22_000.0 / ((f64::from(i) * 0.1 - 74.0).powi(2) + 500.0)).collect();
    for (window, expected) in
        [(HicWindow::Ms15, 176.141_965), (HicWindow::Ms36, 300.728_307), (HicWindow::Other(0.05), 315.247_615)]
    {
        // measured 2e-8, 3e-7 and, where the free window ends between samples, 6.6e-4
        assert!((hic(&airbag, 1e-4, window).unwrap().value - expected).abs() < 1e-3);
    }
}

#[test]
fn a_window_between_samples_is_used_in_full() {
    let constant = vec![10.0 * G; 50];
    let found = hic(&constant, 4e-4, HicWindow::Ms15).unwrap();
    assert!((found.value - 10f64.powf(2.5) * 0.015).abs() < 1e-9);
}

#[test]
fn quiet_and_unusable_signals() {
    assert_eq!(hic(&[0.0; 10], 1e-3, HicWindow::Ms15).unwrap().value, 0.0);
    assert_eq!(hic(&[-5.0; 10], 1e-3, HicWindow::Ms15).unwrap().value, 0.0);
    assert!(matches!(hic(&[1.0], 1e-3, HicWindow::Ms15), Err(SignalError::TooShort { .. })));
    assert!(matches!(hic(&[1.0; 9], 0.02, HicWindow::Ms15), Err(SignalError::TooBrief { .. })));
    assert!(matches!(hic(&[1.0, f64::INFINITY], 1e-3, HicWindow::Ms15), Err(SignalError::NotFinite { .. })));
    assert!(hic(&[1.0; 9], 1e-3, HicWindow::Other(-1.0)).is_err());
    assert!((hic_d(1000.0) - 920.86).abs() < 1e-9);
}

/// Best window on samples at 10 kHz, computed elsewhere by an exhaustive scan:
/// (shape, peak g, length s, HIC15, HIC36).
#[rustfmt::skip] // a table: one pulse a line
const SAMPLED_AT_10_KHZ: [(Shape, f64, f64, f64, f64); 8] = [
    (Shape::HalfSine, 100.0, 0.010, 414.465_075_268_739_8, 414.465_075_268_739_8),
    (Shape::Haversine, 100.0, 0.010, 302.778_852_579_676_77, 302.778_852_579_676_77),
    (Shape::HalfSine, 60.0, 0.040, 361.354_413_418_112_5, 462.497_717_640_292_6),
    (Shape::Haversine, 60.0, 0.040, 314.413_740_016_498_4, 337.890_124_897_896_4),
    (Shape::HalfSine, 80.0, 0.100, 838.978_104_571_747_4, 1_801.074_591_484_601),
    (Shape::Haversine, 80.0, 0.100, 819.898_730_115_943, 1_583.645_424_690_259_5),
    (Shape::HalfSine, 150.0, 0.005, 570.713_467_425_537_6, 570.713_467_425_537_6),
    (Shape::Haversine, 150.0, 0.005, 416.652_209_654_419_95, 416.652_209_654_419_95),
];

#[test]
fn windows_on_samples_match_an_exhaustive_scan_made_elsewhere() {
    for (shape, peak_g, length_s, hic15, hic36) in SAMPLED_AT_10_KHZ {
        let signal = pulse(shape, peak_g, length_s, 1e-4);
        for (longest, expected) in [(150, hic15), (360, hic36)] {
            let found = best_on_samples(&signal, 1e-4, longest);
            assert!((found / expected - 1.0).abs() < 1e-10, "{shape:?} {peak_g} g: {found} {expected}");
            // the best window of the line lies between that and the closed form, chords lying below the arc
            let u = (longest as f64 * 1e-4 / length_s).min(closed_form(shape).1);
            let of_line = hic(&signal, 1e-4, HicWindow::Other(longest as f64 * 1e-4)).unwrap().value;
            assert!(of_line >= found * (1.0 - 1e-12) && of_line <= limited(shape, peak_g, length_s, u) * (1.0 + 1e-9));
        }
    }
}
