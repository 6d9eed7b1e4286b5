//! Devices at the first node: spools, limiters, pretensioners, release.

use super::super::data::*;
use super::super::device::Phase;
use super::super::tension::Web;
use super::super::{Chains, MOST_NODES};
use super::{Rig, at, chain, fixed, limiter, reel, webbing};
use crate::body::Body;
use crate::forces::element::Element;
use crate::forces::function::Function;
use crate::model::Model;
use crate::results::outcome::StepError;
use crate::run::Course;
use crate::tests::case_in_code::cart;
use crate::tests::three_point;

#[test]
fn a_spool_locks_without_a_jump_and_its_limiter_meets_its_curve_again() {
    let film: &[[f64; 2]] = &[[0.0, 0.0], [0.03, 4e3], [0.5, 4e3]];
    for lock_ms in [3, 11, 25] {
        let data = chain(&[0.2], webbing(1.0), reel(at(1e-3 * f64::from(lock_ms)), None, Some(film)), Rest::Slack(0.0));
        let mut rig = Rig::new(&data, &[0.5, 1.0], &[1.5]);
        let mut last = 6.0;
        let mut length = 1.0;
        for i in 1..=1200 {
            length += if (300..500).contains(&i) { -1e-4 } else { 2e-4 };
            let before = rig.past.device.phase;
            rig.step(1e-4, &[0.5, length]);
            let t = rig.pulls[0];
            if before < Phase::LOCKED && rig.past.device.phase == Phase::LOCKED {
                assert!((t - 6.0).abs() < 1e-9 && (rig.tensions()[0] - 6.0).abs() < 1e-9, "{t}");
            }
            // 0.2 mm on a belt of 110 kN: no step is above what that pulls
            assert!((t - last).abs() < 60.0, "{i}: {last} {t}");
            last = t;
        }
        assert_eq!(rig.past.device.phase, Phase::LOCKED);
        assert!((last - 4e3).abs() < 1e-9, "{last}");
    }
}

#[test]
fn a_watched_spool_locks_when_webbing_is_jerked_off_and_not_before() {
    let watch = Watch { of: Watched::PayoutAcceleration, threshold: 20.0, lasting_s: 1e-3, delay_s: 0.0 };
    let lock = Cue { due_s: NEVER, watch: Some(watch) };
    let locked_at = |acceleration: f64| {
        let mut rig = Rig::new(&chain(&[], webbing(1.0), reel(lock, None, None), Rest::Slack(0.0)), &[0.5], &[]);
        (1..=600).find_map(|i| {
            let t = 1e-4 * f64::from(i);
            rig.step(1e-4, &[0.5 + 0.5 * acceleration * t * t]);
            (rig.past.device.phase == Phase::LOCKED).then_some((t, rig.payout()))
        })
    };
    assert_eq!(locked_at(10.0), None);
    // the average lags: (ṗ − v_f)/τ = a(1 − e^(−t/τ)) reaches 20 of 30 m/s² after 1.0986 τ, then 1 ms
    let (t, payout) = locked_at(30.0).unwrap();
    let expected = 5e-3 * 3.0_f64.ln() + 1e-3;
    assert!((t - expected).abs() < 3e-4, "{t} {expected}");
    assert!((payout - 0.5 * 30.0 * t * t).abs() < 1e-4, "{payout}");
}

#[test]
fn a_pretensioner_takes_slack_in_first_and_stalls_at_its_force() {
    let pull = |by_force, table: &[[f64; 2]], stall_n| Pull { cue: at(5e-3), table: table.to_vec(), by_force, stall_n };
    let by_way = pull(None, &[[0.0, 0.0], [10e-3, 0.1]], 2e3);
    let by_force = pull(Some(8.0), &[[0.0, 1500.0], [50e-3, 1500.0]], NEVER);
    for (pull, most) in [(by_way, 2e3 + 1.2e3), (by_force, 1501.0)] {
        let mut rig =
            Rig::new(&chain(&[], webbing(1.0), reel(at(0.0), Some(pull), None), Rest::Slack(0.0)), &[1.0], &[]);
        // the belt goes slack by 30 mm while its spool is locked
        for i in 1..=40 {
            rig.step(1e-4, &[1.0 - 7.5e-4 * f64::from(i)]);
        }
        let mut tight_at = None;
        for i in 1..=600 {
            rig.step(1e-4, &[0.97]);
            if rig.pulls[0] > 0.0 && tight_at.is_none() {
                tight_at = Some((i, rig.payout()));
            }
        }
        let (_, payout) = tight_at.unwrap();
        assert!((payout + 0.03).abs() < 1.2e-3, "tight after {payout}");
        assert_eq!(rig.past.device.phase, Phase::LOCKED);
        assert!(rig.pulls[0] > 1400.0 && rig.pulls[0] < most, "{}", rig.pulls[0]);
        // what it has done is in the webbing
        let (driven, stored) = (rig.past.device.driven, rig.stored());
        assert!((driven / stored - 1.0).abs() < 0.03, "{driven} {stored}");
    }
}

#[test]
fn a_force_released_is_gone() {
    let mut data = chain(&[0.2], webbing(1.0), fixed(), Rest::Pretension(500.0));
    data.release = at(1e-3);
    let mut rig = Rig::new(&data, &[0.5, 0.5], &[1.0]);
    rig.step(9e-4, &[0.51, 0.5]);
    assert!(rig.pulls[0] > 500.0);
    rig.step(1e-4, &[0.51, 0.5]);
    rig.step(1e-4, &[0.52, 0.5]);
    assert_eq!(rig.pulls, [0.0; MOST_NODES]);
}

/// On a plateau, the force moves from one limiter to the other linearly in time, and the released energy is dissipated.
#[test]
fn a_second_limiter_takes_over_within_its_time() {
    let mut device = reel(at(0.0), None, Some(&[[0.0, 0.0], [0.01, 4e3], [0.6, 4e3]]));
    let second = Function::lines(vec![[0.0, 0.0], [0.01, 1.5e3], [0.6, 1.5e3]], 0.01);
    device.second = Some((second, at(0.05), 5e-3));
    let mut rig = Rig::new(&chain(&[], webbing(1.0), device, Rest::Slack(0.0)), &[1.0], &[]);
    let stored = rig.stored();
    for i in 1..=1000 {
        rig.step(1e-4, &[1.0 + 2e-4 * f64::from(i)]);
        let share = ((1e-4 * f64::from(i) - 0.05) / 5e-3).clamp(0.0, 1.0);
        if i > 450 {
            let expected = 4e3 + (1.5e3 - 4e3) * share;
            assert!((rig.pulls[0] - expected).abs() < 1e-6 * expected, "{i}: {} {expected}", rig.pulls[0]);
        }
    }
    assert!(rig.payout() > 0.1);
    let gained = rig.stored() - stored + rig.lost();
    assert!((rig.work / gained - 1.0).abs() < 2e-3, "{} {gained}", rig.work);
}

/// A limiter at a belt's anchor returns its work less its dissipation, and stops where its curve is steep.
#[test]
fn a_limiter_at_an_anchor_bottoms_where_it_is_steep() {
    let mut rig = drawn_out(limiter(&[[0.0, 0.0], [0.002, 3e3], [0.08, 3e3], [0.082, 40e3]]), 0.12);
    assert!(rig.pulls[0] > 3e3 && rig.past.device.greatest > 0.08, "{} {}", rig.pulls[0], rig.past.device.greatest);
    let (greatest, held) = (rig.past.device.greatest, rig.work);
    for i in 1..=600 {
        rig.step(1e-4, &[1.12 - 2e-4 * f64::from(i)]);
    }
    // slack, with what it gave still given
    assert_eq!((rig.pulls[0], rig.past.device.greatest), (0.0, greatest));
    assert!(
        rig.work < held && (rig.work / (rig.stored() + rig.lost()) - 1.0).abs() < 2e-3,
        "{} {}",
        rig.work,
        rig.lost()
    );
}

fn drawn_out(device: Device, by: f64) -> Rig {
    let mut rig = Rig::new(&chain(&[], webbing(0.7), device, Rest::Slack(0.0)), &[1.0], &[]);
    for i in 1..=1200 {
        rig.step(1e-4, &[1.0 + by * f64::from(i) / 1200.0]);
    }
    rig
}

/// NaN is reported with the belt and not used as a motion.
#[test]
fn tensions_that_are_not_found_are_told() {
    let data = chain(&[0.2], webbing(1.0), fixed(), Rest::Slack(0.0));
    let mut rig = Rig::new(&data, &[0.5, 0.5], &[1.0]);
    rig.course.lengths[1] = f64::NAN;
    let mut web = Web::new();
    let taut = rig.straps.taut(1e-4, &rig.course, &rig.past, &mut web);
    assert!(taut.solved.unsolved > 0.0 && taut.straps[0].tension.is_nan());
    rig.past.device.unsolved = 3e-4;
    let law = Chains::new(std::slice::from_ref(&data), &Body::male50());
    let why = Chains::failure(&[data], &law, &[rig.past]).unwrap();
    assert_eq!(why, "no tensions were found of the belt belt: 3.0e-4 m of webbing are left over");
}

/// A run ends there with the belt's name.
#[test]
fn a_run_without_tensions_ends_with_its_belt() {
    let mut setup = cart().unwrap();
    setup.chains.push(three_point(&setup.body, 0.0));
    let model = Model::new(setup).unwrap();
    let mut run = Course::new(&model);
    run.history.memory.chains[0].nodes[0].unstretched = f64::NAN;
    let ended = run.advance_to(&model, 1e-3);
    let Err(StepError::Unsolved { time_s, why, .. }) = ended else { panic!("{ended:?}") };
    assert!(time_s == 0.0 && why.contains("of the belt driver"), "{why}");
}
