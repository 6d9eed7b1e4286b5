//! Any signal, however broken, gives a value or an error and never a panic.

use crate::correlation::{CoraSettings, anova, cora, iso18571, sprague_geers};
use crate::measure::*;
use crate::signal::{
    CfcFamily, ChannelClass, Interpolant, Interpolation, filter_cfc, integrate, moving_average, resample,
};

fn exercise(signal: &[f64], other: &[f64], dt_s: f64) -> usize {
    let mut values = 0;
    let mut count = |gave_value: bool| values += usize::from(gave_value);
    for window in [HicWindow::Ms15, HicWindow::Ms36, HicWindow::Other(dt_s)] {
        count(hic(signal, dt_s, window).is_ok());
    }
    count(three_ms_contiguous(signal, dt_s).is_ok());
    count(three_ms_cumulative(signal, dt_s).is_ok());
    count(severity_index(signal, dt_s).is_ok());
    count(nij(signal, other, dt_s, &NeckIntercepts::of(Dummy::HybridIii50M).unwrap()).is_ok());
    count(bric(signal, other, signal, dt_s, BricBasis::Average).is_ok());
    count(damage(signal, other, signal, dt_s).is_ok());
    count(viscous_criterion(signal, dt_s, ChestSize::HYBRID_III_50M).is_ok());
    count(duration_use(signal, dt_s, &DurationLimit::FEMUR_R94_N).is_ok());
    count(max_50ms_average(signal, dt_s).is_ok());
    count(flail_space(signal, other, dt_s, FlailDistances::default()).is_ok());
    count(thiv(signal, other, other, dt_s, HeadFlight::default()).is_ok());
    count(asi(signal, other, signal, dt_s, AsiEdition::Edition1998).is_ok());
    count(asi(signal, other, signal, dt_s, AsiEdition::Edition2010).is_ok());
    count(olc(signal, dt_s).is_ok());
    count(integrate(signal, dt_s, 0.0).is_ok());
    count(moving_average(signal, dt_s, 0.003).is_ok());
    for class in ChannelClass::ALL {
        count(filter_cfc(signal, dt_s, class, CfcFamily::Iso6487).is_ok());
    }
    count(resample(signal, dt_s, 1e-3).is_ok());
    count(Interpolant::new(other, signal, Interpolation::MonotoneCubic).is_ok_and(|i| i.value_at(0.1).is_finite()));
    count(iso18571(signal, other, dt_s).is_ok());
    count(cora(signal, other, dt_s, &CoraSettings::default()).is_ok());
    count(sprague_geers(signal, other).is_ok());
    count(anova(signal, other).is_ok());
    values
}

/// Chest, side, whiplash, legs.
fn exercise_parts(signal: &[f64], other: &[f64], dt_s: f64) -> usize {
    let contact = head_restraint_contact(signal, dt_s, &whiplash::RestraintContact::default());
    let found = contact.clone().ok().flatten();
    let points = FourPoints { upper_left_m: signal, upper_right_m: other, lower_left_m: other, lower_right_m: signal };
    let neck = whiplash::LowerNeckLoads { force_n: [signal, other, signal], moment_nm: [other, signal] };
    let critical = TibiaCriticals::REVISED_50M;
    [
        compression(signal, dt_s, 0.2).is_ok(),
        deepest_rib(&[signal, other], dt_s).is_ok(),
        deflection_rate(signal, dt_s).is_ok(),
        pc_score(&points, dt_s).is_ok(),
        force_sum(&[signal, other, signal], dt_s).is_ok(),
        contact.is_ok(),
        nic(signal, other, dt_s, found.as_ref()).is_ok(),
        nkm(signal, other, dt_s, &NkmIntercepts::MALE_50).is_ok(),
        whiplash::lower_neck_load(&neck, dt_s, &whiplash::LowerNeckIntercepts::default()).is_ok(),
        whiplash::greatest_until(signal, dt_s, dt_s).is_ok(),
        rebound_speed(signal, other, dt_s, dt_s).is_ok(),
        whiplash::relative_travel(signal, other, dt_s).is_ok(),
        tibia_index(signal, other, signal, dt_s, &critical).is_ok(),
        straight_moment(signal, other, tibia::UPPER_OFFSET_M).is_ok(),
        signal.first().is_some_and(|x| combined_thoracic_index(*x, dt_s, &ThoracicIntercepts::HYBRID_III_50M).is_ok()),
    ]
    .into_iter()
    .filter(|gave_value| *gave_value)
    .count()
}

/// Bits of a linear congruential generator.
fn random(seed: &mut u64) -> u64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    *seed >> 11
}

#[test]
fn broken_signals_never_panic() {
    let oddities = [0.0, -0.0, 1.0, -1.0, 1e-308, 1e308, -1e308, 5e-324, f64::NAN, f64::INFINITY, 1e9, -3.0];
    let intervals_s = [1e-4, 1e-3, 0.02, 1e-9, 1e-300, 1e300, 0.0, -1.0, f64::NAN, f64::INFINITY];
    let mut seed = 2026;
    let mut values = 0;
    for case in 0..250 {
        // a few cases with every oddity, most with finite ones only
        let kinds = if case % 4 == 0 { 12 } else { 4 + 2 * (case % 3) };
        let length = [0, 1, 2, 3, 5, 40, 300][(random(&mut seed) % 7) as usize];
        let mut draw = || -> Vec<f64> { (0..length).map(|_| oddities[(random(&mut seed) % kinds) as usize]).collect() };
        let (signal, other) = (draw(), draw());
        let dt_s = intervals_s[(random(&mut seed) % 10) as usize];
        values += exercise(&signal, &other, dt_s) + exercise_parts(&signal, &other, dt_s);
        // of unequal length
        exercise_parts(&signal, &other[..length / 2], dt_s);
    }
    assert!(values > 800, "the sweep must also reach the arithmetic: {values} values");
}

#[test]
fn a_sound_signal_reaches_every_function() {
    let signal: Vec<f64> = (0..4000).map(|i| -200.0 * (f64::from(i) * 1e-3).sin()).collect();
    let time_s: Vec<f64> = (0..4000).map(|i| f64::from(i) * 1e-4).collect();
    assert_eq!(exercise(&signal, &time_s, 1e-4), 29);
    assert_eq!(exercise_parts(&signal, &time_s, 1e-4), 15);
}
