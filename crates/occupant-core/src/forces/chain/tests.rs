//! The way of webbing, and straps of given lengths: closed forms, identities, and figures of another program.

use nalgebra::{Point3, Vector3};

use super::MOST_NODES;
use super::data::*;
use super::device::Phase;
use super::past::{ChainPast, NodePast};
use super::path::{Bend, Place, bends, turn};
use super::tension::{Course, Straps};
use crate::forces::function::Function;
use crate::motion::dual::Dual;
use crate::motion::scalar::Scalar;
use crate::motion::vector::{V3, v3};

fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1u64 << 53) as f64
}

fn place<S: Scalar>(centre: [f64; 3], radius: f64) -> Place<S> {
    let centre = V3::of(&Vector3::from(centre));
    Place { centre, radius: S::of(radius), is_sphere: radius > 0.0, may_leave: radius > 0.0 }
}

/// All nodes on, with normals as at a start.
fn on<S: Scalar>(places: &[Place<S>]) -> [NodePast<S>; MOST_NODES] {
    let mut past = [NodePast::none(); MOST_NODES];
    past.iter_mut().for_each(|node| node.on = S::one());
    let found = bends(places, &past);
    past.iter_mut().zip(&found).for_each(|(node, bend)| node.set_normal(bend.normal));
    past
}

fn length<S: Scalar>(found: &[Bend<S>]) -> S {
    found.iter().fold(S::zero(), |sum, bend| sum + bend.span + bend.arc)
}

fn two_spheres<S: Scalar>() -> [Place<S>; 4] {
    [
        place([-0.4, 0.3, -0.6], 0.0),
        place([0.0, 0.17, -0.45], 0.06),
        place([0.1, 0.02, -0.25], 0.12),
        place([-0.1, -0.25, 0.2], 0.0),
    ]
}

#[test]
fn two_spheres_have_the_length_that_another_program_found() {
    let places = two_spheres::<f64>();
    let found = bends(&places, &on(&places));
    assert!((length(&found) - 1.435_064_383_540_57).abs() < 1e-13, "{}", length(&found));
    assert!((found[1].wrap - 0.641_251_157_192_7).abs() < 1e-12 && (found[2].wrap - 1.191_446_769_752_6).abs() < 1e-12);
}

#[test]
fn forces_are_the_gradient_of_the_length_and_balance() {
    let mut seed = 11;
    for _ in 0..1000 {
        let mut at = two_spheres::<f64>();
        for place in &mut at {
            let mut some = || 0.06 * (random(&mut seed) - 0.5);
            place.centre += v3(some(), some(), some());
        }
        let past = on(&at);
        let found = bends(&at, &past);
        let pull = |bend: &Bend<f64>| (bend.back + bend.ahead).to_vector();
        let sum: Vector3<f64> = found.iter().map(pull).sum();
        let moment: Vector3<f64> = found.iter().zip(&at).map(|(b, p)| p.centre.to_vector().cross(&pull(b))).sum();
        // measured: 1.1e-15 and 4e-16 m
        assert!(sum.norm() < 1e-13 && moment.norm() < 1e-13, "{sum} {moment}");
        for k in 0..4 {
            for axis in 0..3 {
                let moved = |h: f64| {
                    let mut at = at;
                    let mut by = Vector3::zeros();
                    by[axis] = h;
                    at[k].centre += V3::of(&by);
                    length(&bends(&at, &past))
                };
                let slope = (moved(1e-5) - moved(-1e-5)) / 2e-5;
                // measured: 6e-10
                assert!((slope + pull(&found[k])[axis]).abs() < 1e-8, "node {k}: {slope} {}", pull(&found[k])[axis]);
            }
        }
    }
}

#[test]
fn a_frictionless_ring_off_the_way_is_passed_over() {
    let mut places = two_spheres::<f64>();
    places[1].may_leave = true;
    let mut past = on(&places);
    past[1].on = 0.0;
    let without = [places[0], places[2], places[3]];
    let (found, other) = (bends(&places, &past), bends(&without, &on(&without)));
    assert_eq!(length(&found), length(&other));
    assert_eq!((found[1].back, found[1].ahead, found[1].span), (V3::zero(), V3::zero(), 0.0));
    assert_eq!((found[0].ahead, found[2].back, found[3].back), (other[0].ahead, other[1].back, other[2].back));
}

#[test]
fn webbing_turns_by_the_angle_between_its_spans() {
    let angle = |a: f64| turn(v3(-1.0, 0.0, 0.0), v3(a.cos(), a.sin(), 0.0));
    for a in [0.0, 1e-9, 0.3, 1.0, 2.5, 3.1] {
        assert!((angle(a) - a).abs() < 1e-12, "{a}");
    }
}

/// f = 110 kN ε(1 + 2ε) as so many straight lines up to 20 %.
fn lines(count: usize, returned: f64) -> Function {
    let point = |i: usize| {
        let strain = 0.2 * i as f64 / count as f64;
        [strain, 110e3 * strain * (1.0 + 2.0 * strain)]
    };
    Function::lines((0..=count).map(point).collect(), returned)
}

fn webbing(returned: f64) -> Function {
    lines(20, returned)
}

fn chain(frictions: &[f64], webbing: Function, device: Device, rest: Rest) -> Chain {
    let node = |friction| Node {
        name: String::new(),
        site: Site::Vehicle(Point3::origin(), None),
        friction,
        strength_n: NEVER,
    };
    let mut nodes = vec![node(0.0)];
    nodes.extend(frictions.iter().copied().map(node));
    nodes.push(node(0.0));
    let straps = (0..=frictions.len()).map(|i| i.to_string()).collect();
    Chain {
        belt: "belt".to_owned(),
        nodes,
        straps,
        webbing,
        viscous: None,
        rest,
        device,
        release: Cue::NEVER,
        strength_n: NEVER,
    }
}

fn fixed() -> Device {
    Device { limiter: None, second: None, reel: None }
}

fn limiter(points: &[[f64; 2]]) -> Device {
    Device { limiter: Some(Function::lines(points.to_vec(), 0.01)), second: None, reel: None }
}

/// Straps, what they remember, and how they lie.
struct Rig {
    straps: Straps<f64>,
    past: ChainPast<f64>,
    course: Course<f64>,
    /// Work put in by what moves the ends, J.
    work: f64,
    pulls: [f64; MOST_NODES],
}

impl Rig {
    fn new(chain: &Chain, lengths: &[f64], turns: &[f64]) -> Rig {
        let straps = Straps::new(chain, (0..lengths.len()).collect());
        let mut course = Course { lengths: [0.0; MOST_NODES], turns: [0.0; MOST_NODES] };
        course.lengths[..lengths.len()].copy_from_slice(lengths);
        course.turns[1..=turns.len()].copy_from_slice(turns);
        let mut past = ChainPast::none();
        straps.start(0.0, straps.start_strain(lengths.iter().sum()), &course.lengths, &mut past);
        let mut rig = Rig { straps, past, course, work: 0.0, pulls: [0.0; MOST_NODES] };
        rig.pulls = rig.tensions();
        rig
    }

    fn tensions(&self) -> [f64; MOST_NODES] {
        let straps = self.straps.taut(self.past.device.time, &self.course, &self.past).solved.straps;
        straps.map(|strap| strap.tension)
    }

    /// A step of h to these lengths, and what is remembered of it.
    fn step(&mut self, h: f64, lengths: &[f64]) {
        let before = self.course.lengths;
        self.course.lengths[..lengths.len()].copy_from_slice(lengths);
        let time = self.past.device.time + h;
        let taut = self.straps.taut(time, &self.course, &self.past);
        let mut next = self.past;
        self.straps.commit(time, &taut, &self.past, &mut next);
        next.device.time = time;
        self.past = next;
        let now = taut.solved.straps.map(|strap| strap.tension);
        for i in 0..lengths.len() {
            self.work += 0.5 * (now[i] + self.pulls[i]) * (lengths[i] - before[i]);
        }
        self.pulls = now;
    }

    fn unstretched(&self) -> f64 {
        self.past.nodes.iter().map(|node| node.unstretched).sum()
    }

    fn stored(&self) -> f64 {
        let taut = self.straps.taut(self.past.device.time, &self.course, &self.past);
        (0..self.straps.starts.len()).map(|strap| self.straps.stored(&taut, strap)).sum()
    }

    fn lost(&self) -> f64 {
        self.past.nodes.iter().map(|node| node.lost).sum()
    }

    fn payout(&self) -> f64 {
        self.past.nodes[0].fed
    }
}

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
            let taut = rig.straps.taut(rig.past.device.time, &rig.course, &rig.past);
            // 1e-13 of the length; up to 1e-9 where five rings within their play or a rise within 10 µm leave no number between
            assert!(taut.solved.residual.abs() < 1e-8 * all, "{number}: {}", taut.solved.residual);
            assert!(rig.pulls.iter().all(|t| *t >= 0.0), "{number}: {:?}", rig.pulls);
        }
    }
}

fn reel(lock: Cue, pull: Option<Pull>, q: Option<&[[f64; 2]]>) -> Device {
    let limiter = q.and_then(|points| limiter(points).limiter);
    let reel = Reel { on_spool_m: 0.8, tension_n: 6.0, lock, lock_after: [0.0, 0.0], pull };
    Device { limiter, second: None, reel: Some(reel) }
}

fn at(due_s: f64) -> Cue {
    Cue { due_s, watch: None }
}

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
        straps.taut(rig.past.device.time, &course, &rig.past).solved.straps.map(|strap| strap.tension)
    };
    let at = rig.course.lengths[1] + 1e-3;
    let h = 1e-6;
    let by_length = [0, 1, 2].map(|i| (tension(at + h, 0.2)[i] - tension(at - h, 0.2)[i]) / (2.0 * h));
    let by_friction = [0, 1, 2].map(|i| (tension(at, 0.2 + h)[i] - tension(at, 0.2 - h)[i]) / (2.0 * h));
    let plain = |x: f64| Dual::<2>::of(x);
    let lift = |straps: &Straps<f64>| straps.zip(straps, &|x, _| plain(x));
    let mut straps = lift(&Straps::new(&data, vec![0, 1, 2]));
    straps.friction[1] = Dual::new(0.2, [0.0, 1.0]);
    let mut course = Course { lengths: rig.course.lengths.map(plain), turns: rig.course.turns.map(plain) };
    course.lengths[1] = Dual::new(at, [1.0, 0.0]);
    let past = rig.past.map(&mut |x| plain(x));
    let found = straps.taut(plain(rig.past.device.time), &course, &past).solved.straps;
    for i in 0..3 {
        let [one, two] = found[i].tension.slopes;
        // measured: 2e-7
        assert!((one / by_length[i] - 1.0).abs() < 1e-5, "{i}: {one} {}", by_length[i]);
        assert!((two - by_friction[i]).abs() < 1e-4 * by_friction[1].abs(), "{i}: {two} {}", by_friction[i]);
        assert_eq!(found[i].tension.value, tension(at, 0.2)[i]);
    }
}
