//! Straps of given lengths: friction, webbing, books, the root, derivatives.

use super::super::MOST_NODES;
use super::super::data::*;
use super::super::march::{Tense, march};
use super::super::tension::{Course, Straps, Taut, Web};
use super::{Rig, chain, fixed, limiter, lines, random, reel, tensions, webbing};
use crate::forces::function::Function;
use crate::motion::dual::Dual;
use crate::motion::scalar::Scalar;

/// Three straps over two rings, the second and third drawn out in `commits`.
fn drawn(device: Device, commits: usize) -> Rig {
    let chain = chain(&[0.2, 0.2], lines(2000, 1.0), device, Rest::Slack(0.0));
    let mut rig = Rig::new(&chain, &[0.6, 1.1, 0.7], &[2.2, 2.0]);
    for i in 1..=commits {
        let s = 0.12 * i as f64 / commits as f64;
        rig.step(1e-4, &[0.6, 1.1 + s, 0.7 + 0.3 * s]);
    }
    rig
}

#[test]
fn friction_in_two_rings_is_that_of_a_capstan() {
    for commits in [1200, 300, 40] {
        let [a, b, c, ..] = drawn(fixed(), commits).pulls;
        // the figures are of the smooth curve; its lines are within 1e-6 of it
        for (found, expected) in [(a, 6374.743), (b, 9898.109), (c, 6634.901)] {
            assert!((found / expected - 1.0).abs() < 2e-6, "{commits}: {found} {expected}");
        }
        assert!((b / a - 0.44_f64.exp()).abs() < 1e-12 && (c / b - (-0.4_f64).exp()).abs() < 1e-12);
    }
    let rig = drawn(fixed(), 1200);
    assert!((1e3 * rig.past.nodes[1].fed - 29.902).abs() < 2e-3, "{}", rig.past.nodes[1].fed);
    assert!((1e3 * rig.past.nodes[2].fed + 1.972).abs() < 2e-3, "{}", rig.past.nodes[2].fed);
}

#[test]
fn a_limiter_holds_its_level_and_pays_out() {
    let steep = drawn(limiter(&[[0.0, 0.0], [1e-4, 4e3], [1.0, 4e3]]), 1200);
    let [a, b, c, ..] = steep.pulls;
    assert!((a - 4e3).abs() < 1e-9, "{a}");
    assert!((b - 6210.829).abs() < 1e-3 && (c / 6366.646 - 1.0).abs() < 3e-4, "{b} {c}");
    assert!((1e3 * steep.payout() - 40.167).abs() < 0.02, "{}", steep.payout());
    // what is taken up is stored or lost: measured 4e-5 of it, the trapezium's part
    let taken = steep.stored() + steep.lost();
    assert!((steep.work / taken - 1.0).abs() < 1e-4, "{} {taken}", steep.work);
    assert!((steep.unstretched() - steep.payout() - 2.4).abs() < 1e-12);
}

#[test]
fn a_belt_loaded_and_unloaded_at_random_keeps_its_length_and_its_books() {
    for (returned, viscous) in [(1.0, None), (0.4, None), (0.7, Some([20e3, 4e-3]))] {
        let mut data = chain(
            &[0.2, 0.0, 0.3],
            webbing(returned),
            limiter(&[[0.0, 0.0], [0.01, 3e3], [0.5, 4e3]]),
            Rest::Slack(0.01),
        );
        data.viscous = viscous;
        let lengths = [0.6, 0.4, 0.5, 0.7];
        let mut rig = Rig::new(&data, &lengths, &[2.2, 1.0, 2.0]);
        let (start, stored, mut seed, mut at) = (rig.unstretched(), rig.stored(), 5, lengths);
        for _ in 0..60 {
            let target = lengths.map(|l| l + 0.06 * (random(&mut seed) - 0.25));
            let from = at;
            for i in 1..=200 {
                at = std::array::from_fn(|k| from[k] + (target[k] - from[k]) * f64::from(i) / 200.0);
                let lost = rig.lost();
                rig.step(5e-5, &at);
                // friction and limiter never give but what is in the play: T μθ x_s
                let most = rig.pulls.iter().fold(0.0, |a: f64, b| a.max(*b));
                assert!(rig.lost() - lost > -(most * 0.6 * 5e-4).max(1e-3), "{} {most}", rig.lost() - lost);
                assert!((rig.unstretched() - rig.payout() - start).abs() < 1e-12);
            }
        }
        assert!(rig.past.nodes[0].fed > 0.0 && rig.lost() > 10.0);
        let gained = rig.stored() - stored + rig.lost();
        match viscous {
            // the sums are trapezia over steps of up to 0.3 mm
            None => assert!((rig.work / gained - 1.0).abs() < 5e-3, "{} {gained}", rig.work),
            // the viscous branch loses as well
            Some(_) => assert!(rig.work > gained + 1.0, "{} {gained}", rig.work),
        }
    }
}

#[test]
fn a_thousand_random_belts_find_their_root() {
    let mut seed = 1;
    for number in 0..1000 {
        let count = 1 + (random(&mut seed) * 5.0) as usize;
        let lengths: Vec<f64> = (0..=count).map(|_| 0.05 + random(&mut seed)).collect();
        let turns: Vec<f64> = (0..count).map(|_| 3.0 * random(&mut seed)).collect();
        let frictions: Vec<f64> = (0..count).map(|_| 0.5 * random(&mut seed)).collect();
        let device = match number % 3 {
            0 => fixed(),
            1 => limiter(&[[0.0, 0.0], [0.02 * random(&mut seed) + 1e-5, 2e3], [0.3, 2e3], [0.4, 9e3]]),
            _ => reel(Cue::NEVER, None, None),
        };
        let slack = Rest::Slack(0.05 * (random(&mut seed) - 0.5));
        let mut rig =
            Rig::new(&chain(&frictions, webbing(0.1 + 0.9 * random(&mut seed)), device, slack), &lengths, &turns);
        for _ in 0..50 {
            let next: Vec<f64> = lengths.iter().map(|l| l * (1.0 + 0.08 * (random(&mut seed) - 0.3))).collect();
            rig.step(1e-3, &next);
            let all: f64 = next.iter().sum();
            let mut web = Web::new();
            let taut = rig.straps.taut(rig.past.device.time, &rig.course, &rig.past, &mut web);
            let found = &taut.solved;
            assert_eq!(found.unsolved, 0.0, "{number}");
            // largest measured: 1.8e-9 m, five rings within their play
            assert!(found.residual.abs() <= 1e-13 * all || rig.is_last_bit(&taut), "{number}: {}", found.residual);
            assert!(rig.pulls.iter().all(|t| *t >= 0.0), "{number}: {:?}", rig.pulls);
        }
    }
}

impl Rig {
    /// Whether R has the other sign at the number next to the solution: nothing nearer to 0 can be written.
    fn is_last_bit(&self, taut: &Taut<'_, f64>) -> bool {
        let residual =
            |x: f64| march(&self.straps.webbing, &taut.feed, taut.runs, x, &mut [Tense::none(); MOST_NODES]).0;
        let x = taut.solved.x;
        // a step of Newton within the last bit may end one number beside
        let others = [x.next_down().next_down(), x.next_down(), x.next_up(), x.next_up().next_up()];
        others.into_iter().any(|next| residual(next) * residual(x) <= 0.0)
    }
}

/// A weight on a rope over a ring, with the rope sliding in one direction: rk4 keeps its order although webbing moves over at
/// accepted steps alone.
#[test]
fn rk4_keeps_its_order_while_webbing_slides() {
    let end = |steps: u32| {
        let webbing = Function::lines(vec![[0.0, 0.0], [1.0, 60e3]], 1.0);
        let data = chain(&[0.25], webbing, fixed(), Rest::Slack(0.0));
        let mut rig = Rig::new(&data, &[0.5, 0.6], &[1.4]);
        rig.past.nodes[1].play = 1.0;
        let (h, mass, mut x, mut v) = (0.03 / f64::from(steps), 40.0, 0.0, 2.0);
        for step in 0..steps {
            let time = h * f64::from(step);
            if step > 0 {
                rig.step(h, &[0.5, 0.6 + x]);
            }
            let pull = |s: f64, x: f64| {
                let mut course = rig.course;
                course.lengths[1] = 0.6 + x;
                9.81 - rig.straps.taut(time + s, &course, &rig.past, &mut Web::new()).straps[1].tension / mass
            };
            let k1 = [v, pull(0.0, x)];
            let k2 = [v + 0.5 * h * k1[1], pull(0.5 * h, x + 0.5 * h * k1[0])];
            let k3 = [v + 0.5 * h * k2[1], pull(0.5 * h, x + 0.5 * h * k2[0])];
            let k4 = [v + h * k3[1], pull(h, x + h * k3[0])];
            x += h / 6.0 * (k1[0] + 2.0 * k2[0] + 2.0 * k3[0] + k4[0]);
            v += h / 6.0 * (k1[1] + 2.0 * k2[1] + 2.0 * k3[1] + k4[1]);
        }
        // it has slid all the way, never back
        assert!(rig.past.nodes[1].play.abs() == 1.0 && v > 0.0, "{} {v}", rig.past.nodes[1].play);
        x
    };
    let [coarse, middle, fine] = [8, 16, 32].map(end);
    let order = ((coarse - middle) / (middle - fine)).abs().log2();
    assert!((order - 4.0).abs() < 0.3, "{order}: {coarse} {middle} {fine}");
}

#[test]
fn derivatives_are_those_of_differences() {
    let data = chain(&[0.2, 0.2], webbing(0.6), limiter(&[[0.0, 0.0], [0.02, 3e3], [0.5, 5e3]]), Rest::Slack(0.0));
    let mut rig = Rig::new(&data, &[0.6, 1.1, 0.7], &[2.2, 2.0]);
    for i in 1..=50 {
        rig.step(1e-4, &[0.6, 1.1 + 1.5e-3 * f64::from(i), 0.7]);
    }
    let tension = |length: f64, mu: f64| {
        let mut data = data.clone();
        data.nodes[1].friction = mu;
        let straps = Straps::new(&data, vec![0, 1, 2]);
        let mut course = rig.course;
        course.lengths[1] = length;
        tensions(&straps.taut(rig.past.device.time, &course, &rig.past, &mut Web::new()))
    };
    let at = rig.course.lengths[1] + 1e-3;
    let h = 1e-6;
    let by_length = [0, 1, 2].map(|i| (tension(at + h, 0.2)[i] - tension(at - h, 0.2)[i]) / (2.0 * h));
    let by_friction = [0, 1, 2].map(|i| (tension(at, 0.2 + h)[i] - tension(at, 0.2 - h)[i]) / (2.0 * h));
    let plain = |x: f64| Dual::<2>::of(x);
    let lift = |straps: &Straps<f64>| straps.zip(straps, &|x, _| plain(x));
    let mut straps = lift(&Straps::new(&data, vec![0, 1, 2]));
    straps.friction[1] = Dual::new(0.2, [0.0, 1.0]);
    let mut course =
        Course { lengths: rig.course.lengths.map(plain), turns: rig.course.turns.map(plain), ..Course::none() };
    course.lengths[1] = Dual::new(at, [1.0, 0.0]);
    let past = rig.past.map(&mut |x| plain(x));
    let mut web = Web::new();
    let found = straps.taut(plain(rig.past.device.time), &course, &past, &mut web).straps;
    for i in 0..3 {
        let [one, two] = found[i].tension.slopes;
        // measured: 2e-7
        assert!((one / by_length[i] - 1.0).abs() < 1e-5, "{i}: {one} {}", by_length[i]);
        assert!((two - by_friction[i]).abs() < 1e-4 * by_friction[1].abs(), "{i}: {two} {}", by_friction[i]);
        assert_eq!(found[i].tension.value, tension(at, 0.2)[i]);
    }
}
