mod special;

use std::f64::consts::PI;

use super::*;
use crate::signal::STANDARD_GRAVITY_MPS2 as G;

/// A dummy that feels a half-sine of 60 g and 40 ms in head, chest and pelvis, and known neck and femur loads, at 10 kHz.
fn dummy() -> Signals {
    let time = |i: usize| i as f64 * 1e-4;
    let pulse = |t: f64| if (0.01..=0.05).contains(&t) { (PI * (t - 0.01) / 0.04).sin() } else { 0.0 };
    let history = |of: &dyn Fn(f64) -> f64| -> Vec<f64> { (0..1000).map(|i| of(time(i))).collect() };
    let still = || history(&|_| 0.0);
    let acceleration = || [history(&|t| -60.0 * G * pulse(t)), still(), still()];
    Signals {
        start_s: 0.5,
        interval_s: 1e-4,
        head_m_s2: acceleration(),
        chest_m_s2: acceleration(),
        pelvis_m_s2: acceleration(),
        head_rad_s: [20.0, 30.0, 10.0].map(|peak| history(&|t| peak * pulse(t))),
        head_rad_s2: [still(), still(), still()],
        neck_n: [still(), still(), history(&|t| 2000.0 * pulse(t))],
        neck_n_m: [still(), history(&|t| -50.0 * pulse(t)), still()],
        femur_n: [history(&|t| -6000.0 * pulse(t)), still()],
        ..Signals::new()
    }
}

fn of<'m>(measures: &'m [Measure], name: &str) -> &'m Measure {
    measures.iter().find(|m| m.name == name).unwrap()
}

#[track_caller]
fn near(measures: &[Measure], name: &str, expected: f64, relative: f64) {
    let value = of(measures, name).value.unwrap();
    assert!((value / expected - 1.0).abs() < relative, "{name}: {value} {expected}");
}

#[test]
fn known_pulses_give_known_measures() {
    let found = assess(&dummy(), &Options::default());
    // measured: 1.3e-5 for HIC and GSI, from sampling at 10 kHz
    near(&found, "hic15", 361.3591, 5e-5);
    near(&found, "hic36", 462.5037, 5e-5);
    near(&found, "head_3ms_cumulative", 59.5841 * G, 1e-5);
    near(&found, "chest_3ms_contiguous", 59.5841 * G, 1e-5);
    near(&found, "gsi", 510.478, 5e-5);
    near(&found, "pelvis_peak", 60.0 * G, 1e-9);
    near(&found, "bric", 0.654_202, 1e-5);
    near(&found, "nij", 0.664_229, 1e-5);
    near(&found, "neck_tension", 2000.0, 1e-9);
    near(&found, "neck_extension", 50.0, 1e-9);
    assert_eq!(of(&found, "neck_compression").value, Some(0.0));
    assert_eq!(of(&found, "neck_flexion").value, Some(0.0));
    near(&found, "right_femur", 6000.0, 1e-9);
    assert_eq!(of(&found, "left_femur").value, Some(0.0));
    // windows are counted in the run's own time
    let hic = of(&found, "hic15");
    let middle = 0.5 * (hic.from_s.unwrap() + hic.to_s.unwrap());
    assert!((middle - 0.53).abs() < 1e-4, "{middle}");
    let remark = of(&found, "nij").remark.as_deref();
    let crossed = "the curves of neck AIS3+, neck AIS4+ cross: do not quote their risks";
    assert_eq!(remark, Some(format!("in tension and extension; {crossed}").as_str()));
    let femur = of(&found, "right_femur");
    assert!((femur.risks[0].probability - 0.064_320).abs() < 1e-6);
}

#[test]
fn an_injury_that_is_worse_and_more_likely_is_marked() {
    // curves of Nij: AIS4+ above AIS3+ up to 0.690, AIS3+ above AIS2+ from 1.516 on
    for (nij, agree) in [(0.5, [true, false, false]), (1.0, [true; 3]), (2.0, [false, false, true])] {
        let mut signals = dummy();
        for values in [&mut signals.neck_n[2], &mut signals.neck_n_m[1]] {
            values.iter_mut().for_each(|v| *v *= nij / 0.664_229);
        }
        let found = assess(&signals, &Options::default());
        let risks = &of(&found, "nij").risks;
        assert_eq!(risks.iter().map(|risk| risk.agrees).collect::<Vec<_>>(), agree, "{risks:?}");
        assert!(risks.windows(2).all(|pair| pair[0].probability >= pair[1].probability || !pair[1].agrees));
    }
}

#[test]
fn limits_are_judged_with_their_margins() {
    let mut signals = dummy();
    for values in &mut signals.head_m_s2 {
        for v in values {
            *v *= 2.0;
        }
    }
    let found = assess(&signals, &Options::default());
    let hic = of(&found, "hic15");
    let value = hic.value.unwrap();
    let [judged] = hic.limits[..] else { panic!("{:?}", hic.limits) };
    assert_eq!((judged.rule, judged.most, judged.passed), ("FMVSS 208", 700.0, false));
    assert_eq!(judged.margin, 700.0 - value);
    let tension = of(&found, "neck_tension").limits[0];
    assert!(tension.passed && tension.most == 4170.0);
}

#[test]
fn a_part_that_is_not_there_is_said_to_be_none() {
    let mut signals = dummy();
    signals.pelvis_m_s2.iter_mut().flatten().for_each(|x| *x = f64::NAN);
    let found = assess(&signals, &Options::default());
    assert!(!of(&found, "pelvis_peak").has_part() && of(&found, "hic15").has_part());
}

#[test]
fn what_a_rigid_thorax_lacks_is_said_and_what_filters_need_too() {
    let found = assess(&dummy(), &Options::default());
    let deflection = of(&found, "chest_deflection");
    assert_eq!(deflection.value, None);
    assert!(deflection.remark.as_deref().unwrap().contains("rigid"));
    // at 1 kHz there is no CFC 1000, but CFC 180 there is
    let mut coarse = dummy();
    for values in coarse.head_m_s2.iter_mut().chain(&mut coarse.chest_m_s2) {
        *values = values.iter().copied().step_by(10).collect();
    }
    coarse.interval_s = 1e-3;
    let options = Options { filtering: Filtering::Classes(CfcFamily::Iso6487), ..Options::default() };
    let found = assess(&coarse, &options);
    let hic = of(&found, "hic15");
    assert_eq!((hic.value, hic.filter_class, hic.limits.len()), (None, 1000, 0));
    assert!(hic.remark.is_some());
    let chest = of(&found, "chest_peak");
    assert_eq!(chest.filter_class, 180);
    assert!((chest.value.unwrap() / (60.0 * G) - 1.0).abs() < 2e-3);
}

#[test]
fn filtered_measures_are_those_of_filtered_channels() {
    let options = Options { filtering: Filtering::Classes(CfcFamily::SaeJ211), ..Options::default() };
    let found = assess(&dummy(), &options);
    let chest = crate::signal::filter_cfc(
        &dummy().chest_m_s2[0],
        1e-4,
        crate::signal::ChannelClass::Cfc180,
        CfcFamily::SaeJ211,
    )
    .unwrap();
    let lowest = chest.iter().copied().fold(0.0, f64::min);
    assert_eq!(of(&found, "chest_peak").value, Some(-lowest));
}

#[test]
fn a_spike_of_one_sample_is_too_coarse_whichever_half_it_stands_in() {
    let at = |i: usize| {
        let mut signals = dummy();
        signals.chest_m_s2[0][i] *= 2.0;
        let measures = assess(&signals, &Options::default());
        let off = coarseness(&signals, &Options::default(), &measures);
        let of = |name| off[measures.iter().position(|m| m.name == name).unwrap()];
        [of("chest_peak"), of("head_peak")]
    };
    for [chest, head] in [at(300), at(301)] {
        assert!((chest - 0.5).abs() < 0.01 && head < 1e-4, "{chest} {head}");
    }
}

#[test]
fn what_rests_is_not_too_coarse_for_any_measure() {
    let mut signals = dummy();
    // a sample in seven, of next to nothing
    for values in signals.all_mut() {
        values.iter_mut().enumerate().for_each(|(i, value)| *value = if i % 7 == 0 { 1e-6 } else { 0.0 });
    }
    let measures = assess(&signals, &Options::default());
    let of = |name: &str| measures.iter().position(|m| m.name == name).unwrap();
    assert!(measures[of("damage")].value.is_some_and(|damage| damage > 0.0));
    assert_eq!(coarseness(&signals, &Options::default(), &measures)[of("damage")], 0.0);
}

/// NIC at contact may pass zero, where any change is much of itself: what NIC may be says what matters.
#[test]
fn what_has_no_limit_for_a_body_is_weighed_by_those_of_any_dummy() {
    let weights = ["nic", "nic_at_contact", "viscous_criterion", "damage", "nothing"].map(readings::weight);
    assert_eq!(weights, [Some(9.0), Some(9.0), Some(0.5), None, None]);
}

#[test]
fn too_few_samples_to_leave_any_out_are_too_coarse() {
    let mut signals = dummy();
    signals.all_mut().for_each(|values| *values = values.iter().copied().step_by(200).take(3).collect());
    signals.interval_s = 0.02;
    let measures = assess(&signals, &Options::default());
    let off = coarseness(&signals, &Options::default(), &measures);
    let spoiled = |name| off[measures.iter().position(|m| m.name == name).unwrap()];
    assert_eq!([spoiled("head_peak"), spoiled("neck_tension")], [1.0, 1.0]);
}

#[test]
fn too_little_to_measure_is_no_panic() {
    for options in
        [Options::default(), Options { filtering: Filtering::Classes(CfcFamily::Iso6487), ..Options::default() }]
    {
        let found = assess(&Signals::new(), &options);
        assert_eq!(found.len(), assess(&dummy(), &options).len());
        for m in &found {
            assert!(m.value.is_none() && m.remark.is_some(), "{m:?}");
        }
    }
}
