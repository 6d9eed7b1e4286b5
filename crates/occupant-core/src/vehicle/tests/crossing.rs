use super::super::super::cursor::PathCursor;
use super::super::super::support::{Seeded, assert_below};
use super::super::profile::tests::profiles;
use super::*;

#[test]
fn the_time_found_has_lost_the_speed_and_no_earlier_one_has() {
    let mut seeded = Seeded(51);
    let (mut found, mut worst) = (0, 0.0f64);
    for profile in profiles() {
        let lost = |t_s: f64| profile.loss(t_s, &mut PathCursor::default()).speed_m_s;
        let fine = 4000;
        let samples: Vec<f64> = (0..=fine).map(|i| profile.duration_s() * f64::from(i) / f64::from(fine)).collect();
        let most = samples.iter().map(|t| lost(*t)).fold(0.0, f64::max);
        for _ in 0..20 {
            let speed_m_s = seeded.between(0.0, 1.2) * most.max(0.1);
            match time_of_loss(&profile, speed_m_s) {
                Some(time_s) => {
                    found += 1;
                    worst = worst.max((lost(time_s) - speed_m_s).abs());
                    let before = samples.iter().filter(|t| **t < time_s - 1e-9);
                    assert!(before.clone().all(|t| lost(*t) < speed_m_s), "{profile:?} {speed_m_s} {time_s}");
                }
                None => assert!(most < speed_m_s, "{profile:?} {speed_m_s}"),
            }
        }
    }
    assert!(found > 200, "{found} crossings were found");
    assert_below("speed at the time found, m/s", worst, 1e-13); // 3.6e-15
}

#[test]
fn a_pulse_that_just_suffices_stops_at_its_end_whatever_the_rounding() {
    let mut seeded = Seeded(52);
    for _ in 0..200 {
        let (peak_m_s2, duration_s) = (seeded.between(50.0, 400.0), seeded.between(0.03, 0.3));
        let nudge = 1.0 + seeded.between(-4e-16, 4e-16);
        let half_sine = Profile::HalfSine { peak_m_s2, duration_s };
        assert_eq!(time_of_loss(&half_sine, nudge * 2.0 * peak_m_s2 * duration_s / PI), Some(duration_s));
        let haversine = Profile::Haversine { peak_m_s2, duration_s };
        assert_eq!(time_of_loss(&haversine, nudge * 0.5 * peak_m_s2 * duration_s), Some(duration_s));
        let triangle = Profile::through(&[(0.0, 0.0), (0.4 * duration_s, peak_m_s2), (duration_s, 0.0)]);
        let time_s = time_of_loss(&triangle, nudge * 0.5 * peak_m_s2 * duration_s).expect("a stop");
        assert_below("end of the triangle", (time_s - duration_s).abs(), 1e-16); // 2.8e-17
    }
}

#[test]
fn from_rest_the_first_loss_counts_and_a_gain_must_be_used_up_before() {
    let first = |points: &[(f64, f64)]| time_of_loss(&Profile::through(points), 0.0);
    assert_eq!(first(&[(0.0, 5.0), (1.0, 5.0)]), Some(0.0));
    assert_eq!(first(&[(0.0, 0.0), (1.0, 0.0), (2.0, 3.0)]), Some(1.0));
    assert_eq!(first(&[(0.0, -5.0), (1.0, -5.0)]), None);
    // Gains 5 m/s up to 1 s, loses them by 2 s.
    assert_eq!(first(&[(0.0, -10.0), (2.0, 10.0)]), Some(2.0));
    assert_eq!(first(&[(0.0, -10.0), (1.0, 0.0), (2.0, 10.0)]), Some(2.0));
    assert_eq!(time_of_loss(&Profile::HalfSine { peak_m_s2: -10.0, duration_s: 0.1 }, 0.0), None);
    assert_eq!(time_of_loss(&Profile::HalfSine { peak_m_s2: 10.0, duration_s: 0.1 }, 0.0), Some(0.0));
}
