use super::*;

fn pulse(t: f64) -> f64 {
    if (0.0..=0.1).contains(&t) { 40.0 * (std::f64::consts::PI * t / 0.1).sin() } else { 0.0 }
}

fn sampled(curve: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..2000).map(|i| curve(f64::from(i) * 1e-4 - 0.02)).collect()
}

#[test]
fn identical_signals_rate_one() {
    let reference = sampled(pulse);
    let found = cora(&reference, &reference, 1e-4, &CoraSettings::default()).unwrap();
    assert!((found.overall - 1.0).abs() < 1e-12);
    // thresholds: asin(0.03)/π and asin(0.075)/π of 100 ms from either end, 1 % longer
    assert!((found.interval_s[0] - 0.0201).abs() < 2e-4 && (found.interval_s[1] - 0.1186).abs() < 2e-4);
}

#[test]
fn rounding_does_not_shift_signals_that_correlate_alike_at_every_lag() {
    // exponentials correlate by 1 whatever the lag, but for the last digits
    for rate_per_s in [0.0, 1.0, -7.0, 30.0] {
        let reference = sampled(|t| 3.7 * (rate_per_s * t).exp());
        let computed: Vec<f64> = reference.iter().map(|m| 1.1 * m).collect();
        let found = cora(&reference, &computed, 1e-4, &CoraSettings::default()).unwrap();
        assert_eq!((found.lag_s, found.phase), (0.0, 1.0), "{rate_per_s}/s");
        assert!(found.progression <= 1.0, "{rate_per_s}/s: {}", found.progression);
    }
}

#[test]
fn a_scaled_signal_loses_size_by_the_square_and_corridor_only() {
    let reference = sampled(pulse);
    let computed: Vec<f64> = reference.iter().map(|m| 1.25 * m).collect();
    let found = cora(&reference, &computed, 1e-4, &CoraSettings::default()).unwrap();
    assert!((found.progression - 1.0).abs() < 1e-12 && found.phase == 1.0 && found.lag_s == 0.0);
    assert!((found.size - 0.64).abs() < 1e-12);
    assert!(found.corridor < 1.0 && found.corridor > 0.5);
}

#[test]
fn a_constant_distance_in_the_corridor_has_a_closed_form() {
    let reference = vec![10.0; 100];
    let computed = vec![12.0; 100];
    // |d| = 0.2, between 0.05 and 0.5: ((0.5 − 0.2)/0.45)² = 4/9
    let found = cora(&reference, &computed, 1e-3, &CoraSettings::default()).unwrap();
    assert!((found.corridor - 4.0 / 9.0).abs() < 1e-12);
}

#[test]
fn a_late_signal_loses_phase_linearly() {
    let interval = CoraInterval::Between { start_s: 0.0, end_s: 0.15 };
    let settings = CoraSettings { interval, ..CoraSettings::default() };
    let found = cora(&sampled(pulse), &sampled(|t| pulse(t - 0.006)), 1e-4, &settings).unwrap();
    assert!((found.lag_s - 0.006).abs() < 1e-12);
    // 6 ms of 150 ms is 0.04: (0.12 − 0.04)/(0.12 − 0.01)
    assert!((found.phase - 0.08 / 0.11).abs() < 1e-12);
    assert!((found.progression - 1.0).abs() < 1e-12 && (found.size - 1.0).abs() < 1e-12);
    let early = cora(&sampled(|t| pulse(t - 0.006)), &sampled(pulse), 1e-4, &settings).unwrap();
    assert!((early.lag_s + 0.006).abs() < 1e-12);
}

#[test]
fn silence_and_bad_settings() {
    let reference = sampled(pulse);
    let silent = cora(&reference, &vec![0.0; 2000], 1e-4, &CoraSettings::default()).unwrap();
    assert_eq!((silent.progression, silent.size), (0.0, 0.0));
    let wrong = CoraSettings { outer_corridor: 0.01, ..CoraSettings::default() };
    assert!(matches!(cora(&reference, &reference, 1e-4, &wrong), Err(SignalError::OutOfRange { .. })));
    let empty =
        CoraSettings { interval: CoraInterval::Between { start_s: 0.15, end_s: 0.1 }, ..CoraSettings::default() };
    assert!(matches!(cora(&reference, &reference, 1e-4, &empty), Err(SignalError::TooShort { .. })));
}
