//! Measures of what only some bodies and tests read.

use std::f64::consts::PI;

use super::super::*;
use super::{dummy, near, of};
use crate::measure::Dummy;
use crate::signal::STANDARD_GRAVITY_MPS2 as G;

const DT_S: f64 = 1e-4;

/// The dummy of the other tests, who reads this too.
fn reads(special: impl IntoIterator<Item = (Special, Vec<f64>)>) -> Signals {
    Signals { special: special.into_iter().collect(), start_s: 0.0, ..dummy() }
}

fn history(of: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..1000).map(|i| of(i as f64 * DT_S)).collect()
}

/// Half a sine from 10 to 50 ms.
fn pulse(peak: f64) -> Vec<f64> {
    history(|t| if (0.01..=0.05).contains(&t) { peak * (PI * (t - 0.01) / 0.04).sin() } else { 0.0 })
}

fn judged_by(dummy: Dummy, signals: &Signals) -> Vec<Measure> {
    assess(signals, &Options::default().with(dummy))
}

fn names(measures: &[Measure]) -> Vec<&'static str> {
    measures.iter().map(|m| m.name).collect()
}

#[test]
fn measures_are_listed_where_their_signals_are() {
    let bare = assess(&reads([]), &Options::default());
    let more = assess(&reads([(Special::ChestDeflection, pulse(0.04))]), &Options::default());
    let new: Vec<_> = names(&more).into_iter().filter(|name| !names(&bare).contains(name)).collect();
    assert_eq!(new, ["chest_compression", "deflection_rate", "viscous_criterion", "cti"]);
    // short tables have no room for what is not there
    let deflection = of(&bare, "chest_deflection");
    assert!(!deflection.brief && deflection.figure.is_none() && of(&more, "chest_deflection").brief);
    // those of the bare one keep their values
    for own in bare.iter().filter(|m| m.name != "chest_deflection") {
        assert_eq!(of(&more, own.name), own);
    }
    // without samples they stand there still, so that a run that fails has the same names
    let empty = assess(
        &Signals { special: [(Special::ChestDeflection, vec![])].into(), ..Signals::new() },
        &Options::default(),
    );
    assert_eq!(names(&empty), names(&more));
    assert!(empty.iter().all(|m| m.value.is_none() && m.remark.is_some()));
}

#[test]
fn a_chest_that_gives_way_is_judged_by_its_dummy() {
    let signals = reads([(Special::ChestDeflection, pulse(0.040))]);
    let found = judged_by(Dummy::HybridIii50M, &signals);
    near(&found, "chest_deflection", 0.040, 1e-12);
    near(&found, "chest_compression", 0.040 / 0.229, 1e-12);
    // s A² π/(2 T D_c); at the kinks of the pulse differences of five points overshoot, but D is next to nothing there
    near(&found, "viscous_criterion", 1.3 * 0.04 * 0.04 * PI / (2.0 * 0.04 * 0.229), 1e-6);
    near(&found, "cti", 59.5841 / 90.0 + 40.0 / 103.0, 1e-5);
    let deflection = of(&found, "chest_deflection");
    assert!((deflection.risks[0].probability - 0.124_424).abs() < 1e-6);
    let limits: Vec<_> = deflection.limits.iter().map(|l| (l.rule, (1e3 * l.most).round(), l.passed)).collect();
    assert_eq!(
        limits,
        [("FMVSS 208", 63.0, true), ("UN R94", 50.0, true), ("UN R137", 42.0, true), ("Euro NCAP MPDB", 42.0, true)]
    );
    // another dummy, other constants; a THOR has no viscous criterion and no combined index
    near(&judged_by(Dummy::HybridIii5F, &signals), "chest_compression", 0.040 / 0.187, 1e-12);
    let thor = judged_by(Dummy::Thor50M, &signals);
    assert_eq!(of(&thor, "viscous_criterion").remark.as_deref(), Some("the THOR 50M has no such criterion"));
    assert!((of(&thor, "chest_deflection").risks[0].probability - 0.277_687).abs() < 1e-6);
    assert_eq!(of(&thor, "cti").value, None);
    // nor has a dummy of the side a sternum, nor a frontal one ribs
    let side = judged_by(Dummy::WorldSid50M, &signals);
    assert_eq!((of(&side, "viscous_criterion").value, of(&side, "chest_compression").value), (None, None));
    let ribs = judged_by(Dummy::HybridIii50M, &reads([(Special::Rib(0), pulse(0.03))]));
    assert_eq!(of(&ribs, "rib_viscous_criterion").value, None);
}

#[test]
fn of_a_person_no_limit_and_no_risk_of_a_dummy_is_told() {
    let four = ChestPoint::ALL.into_iter().zip([0.045, 0.036, 0.049, -0.034]);
    let signals = reads(four.map(|(point, peak)| (Special::ChestPoint(point), pulse(peak))));
    let person = Signals { person: Some(Person { chest_depth_m: 0.245, age_years: Some(50.0) }), ..signals.clone() };
    let found = assess(&person, &Options::default());
    near(&found, "chest_deflection", 0.049, 1e-12);
    near(&found, "chest_compression", 0.2, 1e-12);
    near(&found, "viscous_criterion", 0.049 * 0.049 * PI / (2.0 * 0.04 * 0.245), 1e-6);
    near(&found, "pc_score", 6.745_096, 1e-6);
    for name in ["chest_deflection", "chest_compression", "viscous_criterion", "cti", "pc_score", "deflection_rate"] {
        let own = of(&found, name);
        assert!(own.limits.is_empty() && own.risks.is_empty(), "{own:?}");
    }
    assert!(of(&found, "cti").remark.as_deref().unwrap().contains("for a person, use it only to compare"));
    assert!(of(&found, "chest_compression").remark.as_deref().unwrap().contains("24 %, and more than six at 38 %"));
    // of a dummy the same numbers have them
    assert!(!of(&assess(&signals, &Options::default()), "chest_deflection").limits.is_empty());
}

#[test]
fn a_blow_from_the_side_is_judged_by_rules_of_the_side() {
    let ribs = [0.030, 0.041, 0.020].into_iter().enumerate().map(|(i, peak)| (Special::Rib(i as u8), pulse(peak)));
    let cells = [900.0, -1000.0, 700.0].into_iter().enumerate().map(|(i, n)| (Special::Abdomen(i as u8), pulse(n)));
    let spine = [(0, 0.0), (1, 60.0 * G), (2, 0.0)].map(|(axis, peak)| (Special::LowerSpine(axis), pulse(peak)));
    let signals = reads(ribs.chain(cells).chain(spine).chain([(Special::Pubic, pulse(-4000.0))]));
    let found = judged_by(Dummy::Es2, &signals);
    near(&found, "rib_deflection", 0.041, 1e-12);
    assert_eq!(of(&found, "rib_deflection").remark.as_deref(), Some("rib 2 of 3 from above"));
    near(&found, "rib_viscous_criterion", 0.041 * 0.041 * PI / (2.0 * 0.04 * 0.140), 1e-6);
    near(&found, "abdomen_force", 2600.0, 1e-12);
    near(&found, "lower_spine_3ms_cumulative", 59.5841 * G, 1e-5);
    let of_r95 = |name| {
        let limits = &of(&found, name).limits;
        assert!(limits.iter().all(|l| l.rule == "UN R95"), "{limits:?}");
        limits.iter().map(|l| l.passed).collect::<Vec<_>>()
    };
    assert_eq!(["rib_deflection", "rib_viscous_criterion", "pubic_force", "hic36"].map(of_r95), [[true]; 4]);
    assert_eq!(of_r95("abdomen_force"), [false]);
    // what a dummy of the side has not
    assert_eq!(of(&found, "nij").remark.as_deref(), Some("the ES-2 has no such criterion"));
    assert!(of(&found, "hic15").limits.is_empty() && of(&found, "chest_3ms_cumulative").limits.is_empty());
    let es2re = judged_by(Dummy::Es2Re, &signals);
    assert_eq!(of(&es2re, "rib_deflection").limits[0].rule, "FMVSS 214");
    assert!((of(&es2re, "pubic_force").risks[0].probability - 1.0 / (1.0 + (7.5969f64 - 4.4).exp())).abs() < 1e-9);
    // of a frontal one nothing is judged, and there are no frontal ribs
    let frontal = judged_by(Dummy::HybridIii50M, &signals);
    assert!(of(&frontal, "rib_deflection").limits.is_empty() && of(&frontal, "rib_deflection").risks.is_empty());
}

/// What a simulated body with ribs to the side reads.
fn struck_aside(sides: Ribs) -> Signals {
    let pelvis = match sides {
        Ribs::Dummy => (Special::Pubic, pulse(3000.0)),
        Ribs::Person { .. } => (Special::Pelvis(0), pulse(3000.0)),
    };
    let cells = [(Special::Rib(0), pulse(0.043)), (Special::Abdomen(0), pulse(2400.0)), pelvis];
    Signals { sides: Some(sides), ..reads(cells) }
}

/// By size a body of 78 kg is an ES-2, and its ribs have the limits of the ES-2re as well; a woman of 48 kg is a SID-IIs.
#[test]
fn simulated_ribs_of_a_dummy_have_limits_of_its_kind() {
    let signals = struck_aside(Ribs::Dummy);
    let found = assess(&signals, &Options::default().for_side(78.0));
    let limits = |name| of(&found, name).limits.iter().map(|l| (l.rule, l.passed)).collect::<Vec<_>>();
    assert_eq!(limits("rib_deflection"), [("UN R95", false), ("FMVSS 214", true)]);
    assert_eq!(limits("abdomen_force"), [("UN R95", true), ("FMVSS 214", true)]);
    assert_eq!(limits("hic36").len(), 2);
    near(&found, "rib_viscous_criterion", 0.043 * 0.043 * PI / (2.0 * 0.04 * 0.140), 1e-6);
    assert_eq!(limits("pubic_force"), [("UN R95", true), ("FMVSS 214", true)]);
    let small = Options::default().for_side(48.0);
    assert_eq!((small.dummy, small.also), (Dummy::SidIis, None));
    // a dummy that was asked for stays the only one
    let asked = Options::default().with(Dummy::WorldSid50M).for_side(78.0);
    assert_eq!((asked.dummy, asked.also), (Dummy::WorldSid50M, None));
    let found = assess(&signals, &asked);
    assert!(of(&found, "rib_deflection").limits.iter().all(|l| l.rule.starts_with("Euro NCAP") || l.rule == "UN R135"));
}

#[test]
fn ribs_of_a_person_have_no_limit_of_a_dummy() {
    let signals = struck_aside(Ribs::Person { half_breadth_m: 0.16 });
    let found = assess(&signals, &Options::default().for_side(78.0));
    near(&found, "rib_viscous_criterion", 0.043 * 0.043 * PI / (2.0 * 0.04 * 0.16), 1e-6);
    for name in ["rib_deflection", "rib_viscous_criterion", "abdomen_force", "pelvis_force"] {
        let own = of(&found, name);
        assert!(own.value.is_some() && own.limits.is_empty() && own.risks.is_empty(), "{own:?}");
    }
    assert!(!of(&found, "hic36").limits.is_empty());
    let pubic = of(&found, "pubic_force");
    assert!(pubic.value.is_none() && !pubic.brief && pubic.remark.as_deref().unwrap().contains("no load cell"));
    // a recorded test without such a body says nothing of a pelvis
    assert!(
        assess(&reads([(Special::Rib(0), pulse(0.03))]), &Options::default()).iter().all(|m| m.name != "pubic_force")
    );
}

/// A whiplash test: T1 accelerates forward with 50 m/s² from the start; the head is at rest, and touches its restraint from
/// 40 to 90 ms.
fn rear() -> Signals {
    let mut signals = reads([
        (Special::T1, history(|_| 50.0)),
        (Special::HeadRestraint, history(|t| if (0.0399..0.0901).contains(&t) { 80.0 } else { 0.0 })),
        (Special::HeadSpeed, history(|t| 4.5 * (2.0 * PI * t / 0.1 - PI).sin())),
        (Special::PelvisPlace, history(|t| 0.3 - t)),
    ]);
    signals.head_m_s2 = [history(|_| 10.0), history(|_| 0.0), history(|_| 0.0)];
    signals.neck_n[0] = pulse(169.0);
    signals.neck_n_m[1] = pulse(-9.5);
    signals
}

#[test]
fn a_blow_from_behind_is_told_up_to_the_end_of_contact() {
    let found = judged_by(Dummy::BioRidIi, &rear());
    near(&found, "head_contact_time", 0.0399, 1e-9);
    // 8 + (40 t)² at the end of contact, 90 ms, and at its begin
    near(&found, "nic", 8.0 + 1600.0 * 0.09 * 0.09, 1e-9);
    near(&found, "nic_at_contact", 8.0 + 1600.0 * 0.0399 * 0.0399, 1e-9);
    near(&found, "nkm", 0.4, 1e-9);
    near(&found, "neck_shear_ahead", 169.0, 1e-9);
    near(&found, "t1_acceleration", 50.0, 1e-12);
    near(&found, "rebound_speed", 4.5, 1e-6);
    near(&found, "pelvis_travel_back", 0.0999, 1e-9);
    let nic = of(&found, "nic");
    let limits: Vec<_> = nic.limits.iter().map(|l| (l.rule, l.most, l.passed, l.quoted)).collect();
    assert_eq!(
        limits,
        [
            ("Euro NCAP whiplash low", 15.0, false, false),
            ("Euro NCAP whiplash medium", 24.0, true, false),
            ("Euro NCAP whiplash high", 23.0, true, false)
        ]
    );
    assert_eq!(of(&found, "neck_tension").limits.len(), 3);
    // a frontal dummy reads the same, and no rule of the front speaks of it
    assert!(of(&judged_by(Dummy::HybridIii50M, &rear()), "nic").limits.is_empty());
    // who reads nothing of it has nothing of it, unless the dummy is asked for
    assert!(assess(&dummy(), &Options::default()).iter().all(|m| m.name != "nkm"));
    assert!(judged_by(Dummy::BioRidIi, &dummy()).iter().any(|m| m.name == "nkm"));
}

#[test]
fn without_contact_it_is_said_and_the_whole_record_counts() {
    let mut signals = rear();
    signals.special.insert(Special::HeadRestraint, history(|_| 0.0));
    let found = judged_by(Dummy::BioRidIi, &signals);
    for name in ["head_contact_time", "nic_at_contact"] {
        assert!(of(&found, name).remark.as_deref().unwrap().contains("never in contact"));
    }
    near(&found, "nic", 8.0 + 1600.0 * 0.0999 * 0.0999, 1e-9);
    assert_eq!(names(&found), names(&judged_by(Dummy::BioRidIi, &rear())));
}

#[test]
fn lower_legs_give_the_greater_index_of_their_load_cells() {
    let site = |site, moment: f64, force: f64| {
        [
            (Special::Tibia(site, TibiaLoad::MomentX), pulse(0.6 * moment)),
            (Special::Tibia(site, TibiaLoad::MomentY), pulse(-0.8 * moment)),
            (Special::Tibia(site, TibiaLoad::ForceZ), pulse(force)),
        ]
    };
    let all = site(TibiaSite::LeftUpper, 90.0, -3590.0).into_iter().chain(site(TibiaSite::LeftLower, 45.0, -7180.0));
    let signals = reads(all);
    let found = judged_by(Dummy::HybridIii50M, &signals);
    near(&found, "left_tibia_index", 0.5, 1e-12); // 90/225 + 3.59/35.9 above 45/225 + 7.18/35.9
    near(&found, "left_tibia_compression", 7180.0, 1e-12);
    assert!(found.iter().all(|m| !m.name.starts_with("right_tibia")));
    assert_eq!(of(&judged_by(Dummy::SidIis, &signals), "left_tibia_index").value, None);
    let limits: Vec<_> = of(&found, "left_tibia_index").limits.iter().map(|l| (l.rule, l.most)).collect();
    assert_eq!(limits, [("UN R94", 1.3), ("Euro NCAP MPDB", 1.3)]);
}

#[test]
fn filters_take_each_signal_by_its_class() {
    let options = Options { filtering: Filtering::Classes(CfcFamily::SaeJ211), ..Options::default() };
    let found = assess(&reads([(Special::ChestDeflection, pulse(0.04)), (Special::Pubic, pulse(900.0))]), &options);
    let filtered = |peak, class| {
        crate::signal::filter_cfc(&pulse(peak), DT_S, class, CfcFamily::SaeJ211)
            .unwrap()
            .into_iter()
            .fold(0.0, f64::max)
    };
    assert_eq!(of(&found, "chest_deflection").value, Some(filtered(0.04, crate::signal::ChannelClass::Cfc180)));
    assert_eq!(of(&found, "pubic_force").value, Some(filtered(900.0, crate::signal::ChannelClass::Cfc600)));
    assert_eq!((of(&found, "chest_deflection").filter_class, of(&found, "pubic_force").filter_class), (180, 600));
}

#[test]
fn hostile_signals_are_told_and_never_panic() {
    let bad: [Vec<f64>; 5] = [vec![], vec![f64::NAN; 1000], vec![1e308; 1000], vec![0.0], history(|_| f64::INFINITY)];
    for values in bad {
        for dummy in Dummy::ALL {
            let signals = Signals {
                person: Some(Person { chest_depth_m: f64::NAN, age_years: Some(f64::INFINITY) }),
                ..reads(Special::all().map(|which| (which, values.clone())))
            };
            for own in judged_by(dummy, &signals) {
                assert!(own.value.is_none_or(f64::is_finite), "{own:?}");
            }
            let measures = judged_by(dummy, &signals);
            let off = coarseness(&signals, &Options::default().with(dummy), &measures);
            assert_eq!(off.len(), measures.len());
        }
    }
    // of every length up to a few samples
    for length in 0..6 {
        let mut signals = reads(Special::all().map(|which| (which, vec![1.0; length])));
        signals.all_mut().for_each(|values| values.truncate(length));
        let measures = assess(&signals, &Options::default());
        assert_eq!(coarseness(&signals, &Options::default(), &measures).len(), measures.len());
    }
}
