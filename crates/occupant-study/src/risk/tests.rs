//! Closed forms and vectors through the whole chain, and what is left out and why.

use nalgebra::Vector3;

use super::*;
use crash_measures::measure::limits::{Grade, Rule};
use crash_measures::signal::{CfcFamily, ChannelClass, STANDARD_GRAVITY_MPS2 as G, SignalError};
use occupant_core::vehicle::{
    AccelerationRecord, AfterEnd, Interpolation, PulseDefinition, PulsePath, PulseShape, Station, Strength, TablePath,
    TravelDirection, VehiclePath, VehiclePose,
};
use occupant_scenario::read_record;

/// Accelerations in g and a yaw rate in deg/s, all constant over 0.2 s; the other rates are zero.
fn steady(x_g: f64, y_g: f64, z_g: f64, yaw_rate: f64, dt_s: f64) -> AccelerationRecord {
    let count = (0.2 / dt_s).round() as usize + 1;
    let level = |value: f64| Some(vec![value; count]);
    AccelerationRecord {
        time_s: (0..count).map(|i| i as f64 * dt_s).collect(),
        acceleration_m_s2: [level(x_g * G), level(y_g * G), level(z_g * G)],
        rate_rad_s: [level(0.0), level(0.0), level(yaw_rate.to_radians())],
    }
}

fn with_cfc(class: ChannelClass) -> Preparation {
    Preparation { filter: Some((class, CfcFamily::Iso6487)), ..Preparation::default() }
}

fn risk_of(record: &AccelerationRecord, preparation: &Preparation) -> VehicleRisk {
    let signals = prepare(record, preparation).unwrap();
    VehicleRisk::of(&signals, &Flight::default())
}

#[test]
fn steady_accelerations_give_the_closed_forms_through_filter_and_all() {
    let risk = risk_of(&steady(-10.0, 5.0, 1.0, 0.0, 1e-4), &with_cfc(ChannelClass::Cfc180));
    let flail = risk.flail.unwrap();
    assert!((flail.impact_s.unwrap() - 0.110_619).abs() < 1e-6);
    assert!((flail.oiv_x_mps - 10.8480).abs() < 5e-5 && (flail.oiv_y_mps - 5.4240).abs() < 5e-5);
    assert!((flail.ora_x.unwrap().value + 10.0 * G).abs() < 1e-8);
    let thiv = risk.thiv.unwrap();
    // 3.6 √(1.25 · 1.2 m · 10 g): 2.6e-6
    let oblique = 3.6 * (1.25 * 1.2 * 10.0 * G).sqrt();
    assert!((thiv.speed_kmh() - oblique).abs() < 1e-4, "{thiv:?}");
    assert!((thiv.phd.unwrap().value - 125f64.sqrt() * G).abs() < 1e-8);
    let asi = ((10.0f64 / 12.0).powi(2) + (5.0f64 / 9.0).powi(2) + 0.01).sqrt();
    for found in [risk.asi_1998, risk.asi_2010] {
        assert!((found.unwrap().value - asi).abs() < 1e-9);
    }
    let averages = risk.max_50ms.map(|m| m.unwrap().value / G);
    for (found, expected) in averages.into_iter().zip([-10.0, 5.0, 1.0]) {
        assert!((found - expected).abs() < 1e-9);
    }
    assert!((risk.olc.unwrap().olc_mps2 - 60.0 / 47.0 * 10.0 * G).abs() < 1e-7);
    let change = risk.velocity_change[0].clone().unwrap();
    assert!((change.final_m_s + 2.0 * G).abs() < 1e-9 && change.largest.value == change.final_m_s);
}

#[test]
fn the_yawing_vector_of_thiv_comes_through() {
    let record = steady(-8.0, 6.0, 0.0, 100.0, 1e-5);
    let risk = risk_of(&record, &Preparation::default());
    assert!((risk.thiv.unwrap().speed_kmh() - 33.396_092).abs() < 2e-6);
    let signals = prepare(&record, &Preparation::default()).unwrap();
    let ahead = Flight { head: HeadFlight { start_x_m: 0.3, ..Default::default() }, ..Flight::default() };
    let risk = VehicleRisk::of(&signals, &ahead);
    assert!((risk.thiv.unwrap().speed_kmh() - 32.053_305).abs() < 2e-6);
    // 100 deg/s for 0.2 s
    let yaw = risk.angles.largest[2].clone().unwrap();
    assert!(risk.angles.of_attitude && (yaw.value.to_degrees() - 20.0).abs() < 1e-9);
}

#[test]
fn sensors_away_from_the_centre_are_moved_to_it() {
    // a spin that speeds up: the c.g. stays where it is
    let (arm, slope, dt_s) = (Vector3::new(1.2, -0.4, 0.3), 5.0, 1e-3);
    let time_s: Vec<f64> = (0..400).map(|i| f64::from(i) * dt_s).collect();
    let omega = |t: f64| Vector3::new(0.5, -0.2, 1.0) * (2.0 + slope * t);
    let felt = |t: f64| {
        let alpha = Vector3::new(0.5, -0.2, 1.0) * slope;
        alpha.cross(&arm) + omega(t).cross(&omega(t).cross(&arm))
    };
    let of = |f: &dyn Fn(f64) -> Vector3<f64>| {
        [0, 1, 2].map(|axis| Some(time_s.iter().map(|&t| f(t)[axis]).collect::<Vec<f64>>()))
    };
    let record = AccelerationRecord { acceleration_m_s2: of(&felt), rate_rad_s: of(&omega), time_s: time_s.clone() };
    let preparation = Preparation { offset_m: arm.into(), ..Preparation::default() };
    let signals = prepare(&record, &preparation).unwrap();
    for channel in signals.channels[..3].iter().flatten() {
        // measured 2.1e-14
        assert!(channel.iter().all(|a| a.abs() < 1e-12), "{channel:?}");
    }
    let planar = AccelerationRecord { rate_rad_s: [None, None, record.rate_rad_s[2].clone()], ..record };
    assert_eq!(
        prepare(&planar, &preparation).unwrap_err().to_string(),
        "sensors away from the centre of gravity need all three rates; wx, wy are missing"
    );
}

#[test]
fn gravity_in_the_vertical_channel_is_added_back() {
    let preparation = Preparation { gravity: VerticalGravity::Included, ..Preparation::default() };
    let risk = risk_of(&steady(-10.0, 0.0, -1.0, 0.0, 1e-3), &preparation);
    assert!(risk.max_50ms[2].clone().unwrap().value.abs() < 1e-12);
}

#[test]
fn missing_channels_leave_their_measures_out_with_the_reason() {
    let mut record = steady(-10.0, 0.0, 0.0, 0.0, 1e-3);
    record.acceleration_m_s2[2] = None;
    record.rate_rad_s = [const { None }; 3];
    let risk = risk_of(&record, &Preparation::default());
    assert!(risk.flail.is_ok() && risk.max_50ms[0].is_ok() && risk.olc.is_ok());
    assert_eq!(risk.thiv.unwrap_err(), Missing::Channels(vec!["wz"]));
    assert_eq!(risk.asi_1998.unwrap_err(), Missing::Channels(vec!["az"]));
    assert_eq!(risk.angles.largest[0].clone().unwrap_err().to_string(), "needs wx, which the record does not have");
    record.acceleration_m_s2[1] = None;
    let risk = risk_of(&record, &Preparation::default());
    assert_eq!(risk.thiv.unwrap_err(), Missing::Channels(vec!["ay", "wz"]));
}

#[test]
fn rates_of_a_vehicle_that_rolls_over_give_its_roll() {
    let mut record = steady(0.0, 0.0, 0.0, 0.0, 1e-3);
    record.rate_rad_s[0] = Some(vec![10.0; record.time_s.len()]);
    let risk = risk_of(&record, &Preparation::default());
    assert!((risk.angles.largest[0].clone().unwrap().value - 2.0).abs() < 1e-12);
    // alone, a rate is integrated by itself
    record.rate_rad_s = [None, Some(vec![1.0; record.time_s.len()]), None];
    let risk = risk_of(&record, &Preparation::default());
    assert!(!risk.angles.of_attitude);
    assert!((risk.angles.largest[1].clone().unwrap().value - 0.2).abs() < 1e-12);
    assert!(risk.angles.largest[2].is_err());
}

#[test]
fn uneven_samples_are_refused_unless_an_interval_is_given() {
    let mut record = steady(-10.0, 0.0, 0.0, 0.0, 1e-3);
    record.time_s[100] += 4e-4;
    assert!(matches!(
        prepare(&record, &Preparation::default()),
        Err(Unprepared::Channel { name: "t", error: SignalError::NotUniform { index: 100, .. } })
    ));
    let preparation = Preparation { interval_s: Some(5e-4), ..with_cfc(ChannelClass::Cfc180) };
    let flail = risk_of(&record, &preparation).flail.unwrap();
    assert!((flail.oiv_x_mps - 10.8480).abs() < 5e-5);
}

#[test]
fn samples_too_coarse_for_the_filter_are_refused() {
    let record = steady(-10.0, 0.0, 0.0, 0.0, 2e-3);
    assert!(matches!(
        prepare(&record, &with_cfc(ChannelClass::Cfc180)),
        Err(Unprepared::Channel { name: "ax", error: SignalError::CornerAboveNyquist { .. } })
    ));
    assert!(prepare(&record, &with_cfc(ChannelClass::Cfc60)).is_ok());
}

#[test]
fn the_record_is_cut_to_first_contact() {
    // 1 g before the contact at 0.1 s would move the occupant
    let mut record = steady(-10.0, 0.0, 0.0, 0.0, 1e-3);
    record.time_s.iter_mut().for_each(|t| *t -= 0.05);
    let preparation = Preparation { start_s: Some(0.0), end_s: Some(0.14), ..Preparation::default() };
    let signals = prepare(&record, &preparation).unwrap();
    assert_eq!(signals.samples(), 141);
    assert!(signals.start_s.abs() < 1e-12 && (signals.end_s() - 0.14).abs() < 1e-12);
    for (start_s, end_s) in [(-0.1, 0.1), (0.0, 0.3), (0.1, 0.1), (f64::NAN, 0.1)] {
        let outside = Preparation { start_s: Some(start_s), end_s: Some(end_s), ..Preparation::default() };
        assert!(matches!(prepare(&record, &outside), Err(Unprepared::Window { .. })));
    }
}

#[test]
fn a_pulse_gives_its_own_velocity_change_and_peak() {
    let path = VehiclePath::Pulse(
        PulsePath::new(PulseDefinition {
            initial: VehiclePose::default(),
            initial_speed_m_s: 15.0,
            direction: TravelDirection::Heading,
            starts_at_s: 0.0,
            shape: PulseShape::HalfSine { strength: Strength::DeltaV(15.0), duration_s: 0.1 },
            rebound_m_s: None,
        })
        .unwrap(),
    );
    let record = sampled(&path, 0.0, 0.2, 1e-4).unwrap();
    assert_eq!(record.time_s.len(), 2001);
    let risk = risk_of(&record, &Preparation::default());
    let change = risk.velocity_change[0].clone().unwrap();
    // trapezoids through a half sine: 8.2e-7 relative
    assert!((change.final_m_s + 15.0).abs() < 2e-5, "{change:?}");
    assert!(risk.velocity_change[1].clone().unwrap().final_m_s == 0.0);
}

#[test]
fn straight_lines_between_stations_keep_their_velocity_change() {
    let stations = (0..=4)
        .map(|i| {
            let t = 0.1 * f64::from(i);
            Station::new(t, [20.0 * t - 10.0 * t * t, 0.0, 0.0], [0.0; 3])
        })
        .collect();
    let table = TablePath::new(stations, Interpolation::Linear, AfterEnd::Error).unwrap();
    let path = VehiclePath::Table(table);
    let record = sampled(&path, 0.0, 0.4, 1e-3).unwrap();
    let risk = risk_of(&record, &Preparation::default());
    // 19 m/s in the first interval, 13 m/s in the last
    let change = risk.velocity_change[0].clone().unwrap().final_m_s;
    assert!((change + 6.0).abs() < 1e-9, "{change}");
    assert_eq!(sampled(&path, 0.0, 0.4, 0.0), None);
    assert_eq!(sampled(&path, 0.0, 0.4, 1e-12), None);
    assert_eq!(sampled(&path, 0.4, 0.4, 1e-3), None);
}

#[test]
fn rules_judge_each_component_and_each_edition_its_own_index() {
    let risk = risk_of(&steady(-14.0, 4.0, 0.0, 0.0, 1e-4), &Preparation::default());
    let all = judge(&risk, &[Rule::Mash2016, Rule::En1317Edition1998, Rule::En1317Edition2010]);
    let of = |rule, measure, grade| {
        let found = all.iter().find(|j| j.limit.rule == rule && j.measure == measure && j.limit.grade == grade);
        *found.unwrap()
    };
    // √(2·14 g·0.6 m) = 12.84 m/s
    let oiv = of(Rule::Mash2016, "OIV x", Grade::Maximum);
    assert!(oiv.breaks_the_rule() && (oiv.value.unwrap() - 12.8356).abs() < 1e-3);
    let lateral = of(Rule::Mash2016, "OIV y", Grade::Maximum);
    assert!(lateral.verdict.unwrap().passed);
    let ora = of(Rule::Mash2016, "ORA x", Grade::Preferred);
    assert!((ora.value.unwrap() / G - 14.0).abs() < 1e-9 && ora.verdict.unwrap().passed);
    // ASI √((14/12)² + (4/9)²) = 1.248: class B
    let class_a = of(Rule::En1317Edition2010, "ASI (2010)", Grade::ClassA);
    assert!(!class_a.verdict.unwrap().passed && !class_a.breaks_the_rule());
    assert!(of(Rule::En1317Edition1998, "ASI (1998)", Grade::ClassB).verdict.unwrap().passed);
    assert!(all.iter().all(|j| !(j.limit.rule == Rule::En1317Edition2010 && j.measure == "PHD")));
    let nothing = risk_of(
        &AccelerationRecord { acceleration_m_s2: [const { None }; 3], ..steady(0.0, 0.0, 0.0, 0.0, 1e-3) },
        &Preparation::default(),
    );
    let unjudged = judge(&nothing, &ROADSIDE_RULES);
    assert!(unjudged.iter().all(|j| !j.breaks_the_rule()));
    // angles need rates alone, and those of this record are zero
    let (angles, others): (Vec<&Judgement>, Vec<&Judgement>) =
        unjudged.iter().partition(|j| matches!(j.measure, "roll" | "pitch"));
    assert!(!angles.is_empty() && angles.iter().all(|j| j.value == Some(0.0)), "{angles:?}");
    assert!(others.iter().all(|j| j.value.is_none()), "{others:?}");
}

#[test]
fn any_bytes_give_measures_or_reasons() {
    let mut seed = 7u64;
    let mut random = |below: usize| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize % below
    };
    let spice = b"\n,[]#.-e0123456789tx\xff\xef\xbb\xbf ";
    let mut measured = 0;
    for _ in 0..3000 {
        let mut bytes = b"t[ms],ax[g],ay[m/s^2],wz[deg/s]\n0,-1,2,3\n1,-1.5,2,3\n2,-2e0,2,3\n3,-1,2,4\n".to_vec();
        for _ in 0..random(4) {
            let at = random(bytes.len());
            match random(3) {
                0 => bytes[at] = spice[random(spice.len())],
                1 => bytes.insert(at, spice[random(spice.len())]),
                _ => drop(bytes.remove(at)),
            }
        }
        if let Ok(file) = read_record(&bytes, "a.csv", None)
            && let Ok(signals) = prepare(&file.record, &Preparation::default())
        {
            let _risk = VehicleRisk::of(&signals, &Flight::default());
            measured += 1;
        }
    }
    assert!(measured > 300, "only {measured} got through");
}
