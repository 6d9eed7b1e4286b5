use super::super::super::support::{Seeded, assert_below, integrate};
use super::*;

/// One profile of each kind, and random tables.
pub(in super::super) fn profiles() -> Vec<Profile> {
    let mut seeded = Seeded(41);
    let mut profiles = vec![
        Profile::HalfSine { peak_m_s2: 170.0, duration_s: 0.08 },
        Profile::Haversine { peak_m_s2: 250.0, duration_s: 0.11 },
        Profile::HalfSine { peak_m_s2: -90.0, duration_s: 0.2 },
        Profile::through(&[(0.0, 0.0), (0.0, 120.0), (0.1, 120.0), (0.1, 0.0)]),
        Profile::through(&[(0.0, 0.0), (0.03, 200.0), (0.05, 200.0), (0.12, 0.0)]),
    ];
    for count in 2..20 {
        let mut time_s = 0.0;
        let points: Vec<(f64, f64)> = (0..count)
            .map(|i| {
                time_s += if i == 0 { 0.0 } else { seeded.between(0.002, 0.02) };
                (time_s, seeded.between(-60.0, 150.0))
            })
            .collect();
        profiles.push(Profile::through(&points));
    }
    profiles
}

#[test]
fn speed_and_distance_lost_are_the_integrals_of_the_deceleration() {
    let mut seeded = Seeded(42);
    let (mut speed, mut distance) = (0.0f64, 0.0f64);
    for profile in profiles() {
        let at = |t_s: f64| profile.loss(t_s, &mut PathCursor::default());
        let corners: Vec<f64> = match &profile {
            Profile::Ramps(ramps) => ramps.iter().map(|ramp| ramp.start_s).collect(),
            _ => vec![0.0],
        };
        let to_s = profile.duration_s() * seeded.between(0.1, 1.0);
        let (mut quadrature, mut second) = (0.0, 0.0);
        for (i, from_s) in corners.iter().enumerate() {
            let until_s = corners.get(i + 1).copied().unwrap_or(profile.duration_s()).min(to_s);
            if until_s > *from_s {
                quadrature += integrate(|t| at(t).deceleration_m_s2, *from_s, until_s, 8);
                second += integrate(|t| at(t).speed_m_s, *from_s, until_s, 8);
            }
        }
        speed = speed.max((quadrature - at(to_s).speed_m_s).abs());
        distance = distance.max((second - at(to_s).distance_m).abs());
    }
    assert_below("speed, m/s", speed, 1e-14); // 2.7e-15
    assert_below("distance, m", distance, 1e-16); // 1.4e-17
}

#[test]
fn speed_and_distance_run_on_across_corners_and_after_the_end() {
    for profile in profiles() {
        let at = |t_s: f64| profile.loss(t_s, &mut PathCursor::default());
        let mut corners = vec![0.0, profile.duration_s()];
        if let Profile::Ramps(ramps) = &profile {
            corners.extend(ramps.iter().map(|ramp| ramp.start_s));
        }
        for corner_s in corners {
            let (before, after) = (at(corner_s - 1e-13), at(corner_s + 1e-13));
            assert_below(
                "speed, m/s",
                (after.speed_m_s - before.speed_m_s).abs(),
                1e-10, // 4.0e-11; 250 m/s² over 2e-13 s
            );
            let travelled_m = before.speed_m_s * 2e-13;
            assert_below(
                "distance, m",
                (after.distance_m - before.distance_m - travelled_m).abs(),
                1e-14, // 3.4e-16
            );
        }
        let (end, later) = (at(profile.duration_s()), at(profile.duration_s() + 2.0));
        assert_eq!((later.deceleration_m_s2, later.speed_m_s), (0.0, end.speed_m_s));
        assert_below(
            "distance, m",
            (later.distance_m - end.distance_m - 2.0 * end.speed_m_s).abs(),
            1e-13, // 3.6e-15
        );
        assert_eq!(at(-0.5), Loss { deceleration_m_s2: 0.0, speed_m_s: 0.0, distance_m: 0.0 });
    }
}
