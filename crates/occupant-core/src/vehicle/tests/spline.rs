use nalgebra::Vector6;

use super::super::support::{Seeded, assert_below};
use super::*;

const NATURAL: [Vector6<f64>; 2] = [Vector6::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0); 2];

fn stations(seeded: &mut Seeded, count: usize) -> (Vec<f64>, Vec<Vector6<f64>>) {
    let mut time_s = seeded.between(-1.0, 1.0);
    (0..count)
        .map(|_| {
            time_s += seeded.between(0.02, 0.5);
            (time_s, Vector6::from_fn(|_, _| seeded.between(-5.0, 5.0)))
        })
        .unzip()
}

#[test]
fn a_spline_meets_its_stations_with_continuous_slope_and_curvature() {
    let mut seeded = Seeded(11);
    let [mut value, mut rate, mut second, mut ends] = [0.0f64; 4];
    for (count, end) in (2..40).flat_map(|count| [(count, End::Given), (count, End::AtRest)]) {
        let (times_s, values) = stations(&mut seeded, count);
        let pieces = spline_pieces(&times_s, &values, NATURAL, end);
        assert_eq!(pieces.len(), count - 1);
        for i in 0..count - 1 {
            value = value.max((pieces[i].value(times_s[i]) - values[i]).amax());
            value = value.max((pieces[i].value(times_s[i + 1]) - values[i + 1]).amax());
            if i > 0 {
                let (before, after) = (&pieces[i - 1], &pieces[i]);
                rate = rate.max((before.rate(times_s[i]) - after.rate(times_s[i])).amax());
                second = second.max((before.second_rate(times_s[i]) - after.second_rate(times_s[i])).amax());
            }
        }
        ends = ends.max(pieces[0].second_rate(times_s[0]).amax());
        let last = (&pieces[count - 2], times_s[count - 1]);
        ends = ends.max(match end {
            End::Given => last.0.second_rate(last.1).amax(),
            End::AtRest => last.0.rate(last.1).amax(),
        });
    }
    // Slopes reach 500 per s, second derivatives 30 000 per s².
    assert_below("value", value, 1e-13); // 2.8e-14
    assert_below("slope", rate, 1e-12); // 1.8e-13
    assert_below("second derivative", second, 1e-11); // 2.7e-12
    assert_below("second derivative, or slope, at the ends", ends, 1e-11); // 4.5e-13
}

#[test]
fn a_spline_that_ends_at_rest_follows_what_comes_to_rest() {
    // 0.28 (1 − cos πt/T)/2 m, a panel that has come in by 28 cm after 80 ms, in stations every 10 ms
    let (most_m, end_s) = (0.28, 0.08);
    let place = |t: f64| 0.5 * most_m * (1.0 - (std::f64::consts::PI * t / end_s).cos());
    let times_s: Vec<f64> = (0..9).map(|i| 0.01 * f64::from(i)).collect();
    let values: Vec<_> = times_s.iter().map(|t| Vector6::repeat(place(*t))).collect();
    let end_m_s = [End::Given, End::AtRest].map(|end| {
        let pieces = spline_pieces(&times_s, &values, NATURAL, end);
        let off = |i: usize| (pieces[i / 10].value(1e-3 * i as f64).x - place(1e-3 * i as f64)).abs();
        // in the half where the end acts; measured: 4.1e-4 and 4.4e-6 m
        let off_m = (40..80).map(off).fold(0.0, f64::max);
        (pieces[7].rate(end_s).x.abs(), off_m)
    });
    // without, it is held at a speed from which it jumps
    assert!(end_m_s[0].0 > 0.1 && end_m_s[1].0 < 1e-12, "{end_m_s:?}");
    assert!(end_m_s[1].1 < 0.1 * end_m_s[0].1, "{end_m_s:?}");
}

#[test]
fn a_straight_line_stays_straight() {
    let mut seeded = Seeded(12);
    let (times_s, _) = stations(&mut seeded, 30);
    let (start, slope) = (Vector6::repeat(-2.0), Vector6::new(13.0, -0.5, 0.0, 0.1, 0.2, -3.0));
    let values: Vec<_> = times_s.iter().map(|t| start + slope * *t).collect();
    for pieces in [spline_pieces(&times_s, &values, NATURAL, End::Given), linear_pieces(&times_s, &values)] {
        let (mut value, mut rate, mut second) = (0.0f64, 0.0f64, 0.0f64);
        for piece in &pieces {
            let t = piece.start_s + seeded.between(0.0, 0.02);
            value = value.max((piece.value(t) - start - slope * t).amax());
            rate = rate.max((piece.rate(t) - slope).amax());
            second = second.max(piece.second_rate(t).amax());
        }
        assert_below("value", value, 1e-13); // 1.4e-14
        assert_below("slope", rate, 1e-12); // 1.2e-13
        assert_below("second derivative", second, 1e-11); // 9.3e-13
    }
}

#[test]
fn three_stations_by_hand() {
    // (0, 0), (1, 1), (2, 0): 4 M₁ = 6 (−1 − 1), M₁ = −3, so S = 1.5 t − 0.5 t³ up to t = 1.
    let values = [0.0, 1.0, 0.0].map(Vector6::repeat);
    let pieces = spline_pieces(&[0.0, 1.0, 2.0], &values, NATURAL, End::Given);
    assert_eq!(pieces[0].value(0.5), Vector6::repeat(0.6875));
    assert_eq!(pieces[0].rate(0.0), Vector6::repeat(1.5));
    assert_eq!(pieces[1].second_rate(1.0), Vector6::repeat(-3.0));
}
