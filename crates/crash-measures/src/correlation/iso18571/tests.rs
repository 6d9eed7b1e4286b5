use super::*;

fn sampled(n: u32, curve: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..n).map(|i| curve(f64::from(i) * 1e-4)).collect()
}

fn check(found: Iso18571, corridor: f64, phase: f64, magnitude: f64, slope: f64, overall: f64) {
    let pairs = [
        (found.corridor, corridor),
        (found.phase, phase),
        (found.magnitude, magnitude),
        (found.slope, slope),
        (found.overall, overall),
    ];
    for (found, expected) in pairs {
        assert!((found - expected).abs() < 6e-8, "{found} {expected}"); // vectors have seven digits
    }
}

#[test]
fn recorded_pair() {
    let column = |text: &str| -> Vec<f64> {
        text.lines().map(|line| line.split_once(',').unwrap().1.parse().unwrap()).collect()
    };
    let reference = column(include_str!("../../../tests/data/iso18571_reference.csv"));
    let computed = column(include_str!("../../../tests/data/iso18571_computed.csv"));
    let found = iso18571(&reference, &computed, 1e-4).unwrap();
    check(found, 0.652_890_7, 0.941_666_7, 0.950_654_0, 0.956_686_5, 0.830_957_7);
    assert!((found.lag_s.abs() - 7e-4).abs() < 1e-12);
    assert_eq!(found.grade(), Iso18571Grade::Good);
}

#[test]
fn scaled_sine() {
    let reference = sampled(1500, |t| (20.0 * t).sin());
    let computed = sampled(1500, |t| 1.3 * (20.0 * t).sin());
    let found = iso18571(&reference, &computed, 1e-4).unwrap();
    check(found, 0.477_862_7, 1.0, 0.759_706_0, 0.85, 0.713_086_3);
    assert_eq!(found.grade(), Iso18571Grade::Fair);
}

#[test]
fn late_half_sine() {
    let pulse = |t: f64| {
        if (0.0..=0.08).contains(&t) { 50.0 * (std::f64::consts::PI * t / 0.08).sin() } else { 0.0 }
    };
    let found = iso18571(&sampled(1000, pulse), &sampled(1000, |t| 0.9 * pulse(t - 0.003)), 1e-4).unwrap();
    check(found, 0.838_555_9, 0.85, 0.950_917_9, 0.95, 0.885_605_9);
    assert!((found.lag_s - 0.003).abs() < 1e-12);
}

#[test]
fn identical_signals_rate_one_and_opposite_ones_low() {
    let reference = sampled(600, |t| (60.0 * t).sin());
    let same = iso18571(&reference, &reference, 1e-4).unwrap();
    assert_eq!((same.overall, same.grade()), (1.0, Iso18571Grade::Excellent));
    let opposite: Vec<f64> = reference.iter().map(|m| -m).collect();
    let found = iso18571(&reference, &opposite, 1e-4).unwrap();
    assert_eq!(found.grade(), Iso18571Grade::Poor);
    // a constant answer correlates with nothing and is not shifted
    assert_eq!(iso18571(&reference, &[0.3; 600], 1e-4).unwrap().lag_s, 0.0);
}

#[test]
fn rounding_does_not_shift_signals_that_correlate_alike_at_every_lag() {
    // a line correlates with a line by 1 whatever the lag, but for the last digits
    for (slope, offset) in [(1.0, 0.0), (0.1, 7.3), (-9.806_65, 1e3), (1.0 / 3.0, -40.0)] {
        for n in [20, 137, 500, 1000] {
            let line = sampled(n, |t| offset + slope * t);
            let same = iso18571(&line, &line, 1e-4).unwrap();
            assert_eq!((same.overall, same.lag_s), (1.0, 0.0), "{slope} t + {offset}, {n} samples");
            let steeper: Vec<f64> = line.iter().map(|y| 1.1 * y).collect();
            assert_eq!(iso18571(&line, &steeper, 1e-4).unwrap().lag_s, 0.0, "{slope} t + {offset}, {n} samples");
        }
    }
}

#[test]
fn unusable_pairs_are_named() {
    let signal = sampled(100, |t| t);
    assert!(matches!(iso18571(&signal, &signal, 1e-3), Err(SignalError::OutOfRange { .. })));
    assert!(matches!(iso18571(&signal, &signal[1..], 1e-4), Err(SignalError::LengthMismatch { .. })));
    assert!(matches!(iso18571(&[0.0; 100], &signal, 1e-4), Err(SignalError::NoContent { .. })));
    assert!(matches!(iso18571(&[1.0; 100], &signal, 1e-4), Err(SignalError::NoContent { .. })));
    assert!(matches!(iso18571(&signal[..9], &signal[..9], 1e-4), Err(SignalError::TooShort { .. })));
}
