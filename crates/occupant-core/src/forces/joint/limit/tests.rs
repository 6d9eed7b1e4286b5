//! Angles, torques and energies of elastic limits.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

use super::*;
use crate::body::Body;
use crate::body::tti12::{LEFT_HIP, LEFT_SHOULDER, LOWER_BACK, NECK, RIGHT_HIP, RIGHT_SHOULDER, TTI12};
use crate::forces::function::Function;
use crate::forces::joint::DAMPING;
use crate::forces::joint::Joints;
use crate::forces::joint::limit::{Centre, LOST_AT, Limits, STORED_AT};
use crate::model::Model;
use crate::model::setup::{Integrator, Setup, SetupBuilder};
use crate::motion::dual::Dual;
use crate::motion::mobility::Mobility;
use crate::motion::report_coordinates::DOF;
use crate::motion::vector::M3;
use crate::results::energy::EnergyLedger;
use crate::results::recorder::Watch;
use crate::results::sample::Sample;
use crate::run::simulate::simulate;
use crate::tests::placed;

/// Numbers from −1 to 1 (an additive sequence, the same in every run).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> Vector3<f64> {
        Vector3::new(self.next(), self.next(), self.next())
    }

    fn turn(&mut self) -> Matrix3<f64> {
        let q = nalgebra::Quaternion::new(self.next(), self.next(), self.next(), self.next());
        *UnitQuaternion::from_quaternion(q).to_rotation_matrix().matrix()
    }
}

fn quadratic(returned: f64) -> Stop<f64> {
    Stop::polynomial([3.0, 40.0, 5.0], returned)
}

fn azimuthal() -> Bend<f64> {
    let points = [[0.0, 60.0], [60.0, 45.0], [120.0, 55.0], [180.0, 70.0], [270.0, 38.0]];
    Bend::new(Curve::periodic(&points.map(|point| point.map(f64::to_radians))), quadratic(1.0))
}

fn twisting() -> Turn<f64> {
    Turn::new([-0.6, 0.9], quadratic(1.0))
}

fn pose(joint: Joint, pitch_rad: f64, k: &Matrix3<f64>, l: &Matrix3<f64>) -> Pose<f64> {
    Triads::new(&Body::male50(), joint, &Centre::Pitch { pitch_rad }).pose(&M3::of(k), &M3::of(l))
}

/// Both limits of a ball joint.
fn both(joint: Joint) -> LimitLaw<f64> {
    LimitLaw {
        joint,
        site: Site::Ball,
        segments: (0, 1),
        triads: Triads::new(&Body::male50(), joint, &Centre::Pitch { pitch_rad: 0.3 }),
        bend: Some(azimuthal()),
        turn: Some(twisting()),
        friction: None,
        lock: None,
    }
}

/// Potential and moment of both limits.
fn loaded<S: Scalar>(law: &LimitLaw<S>, k: &M3<S>, l: &M3<S>) -> LimitAction<S> {
    let mut past = LimitHistory { stops: [Past::none(); 2], lock: LockPast::none() };
    let mut action = LimitAction::none(law.joint);
    law.act_ball(false, &law.triads.pose(k, l), &mut past, &mut action);
    action
}

/// Axes of a segment that turns about `axis`: their derivative by the angle is the slope.
fn turning(axes: &Matrix3<f64>, axis: &Vector3<f64>) -> M3<Dual<1>> {
    let slopes = M3::of(&(axis.cross_matrix() * axes));
    M3::of(axes).zip(&slopes, &|x, slope| Dual::new(x, [slope]))
}

#[test]
fn moments_are_the_gradient_of_the_stored_energy() {
    let (mut numbers, mut worst, mut bent) = (Numbers(7), 0.0_f64, 0);
    for joint in [NECK, RIGHT_HIP, LEFT_HIP, LOWER_BACK, LEFT_SHOULDER].repeat(400) {
        let (k, l, axis) = (numbers.turn(), numbers.turn(), numbers.vector().normalize());
        let law = both(joint);
        let dual = law.zip(&law, &|x, _| Dual::new(x, [0.0]));
        let found = loaded(&law, &M3::of(&k), &M3::of(&l));
        let stored = loaded(&dual, &turning(&k, &Vector3::zeros()), &turning(&l, &axis)).stored;
        let scale = 1.0 + found.stop.norm_squared().sqrt();
        worst = worst.max((stored.slopes[0] + found.stop.to_vector().dot(&axis)).abs() / scale);
        bent += usize::from(found.stored > 0.0);
    }
    assert!(bent > 1500, "{bent}");
    assert!(worst < 1e-9, "{worst:e}");
}

/// The spring of a lock has equal stiffness in all directions and a potential: a rotation by ρ gives the moment −Kρ.
#[test]
fn a_lock_is_a_spring_in_all_directions() {
    let (mut numbers, mut worst) = (Numbers(21), 0.0_f64);
    let lock = Lock { until: 1e30, stiffness: 80.0, slips: false, relock_below: 0.0 };
    let dual = lock.zip(&lock, &|x, _| Dual::new(x, [0.0]));
    for _ in 0..500 {
        let (k, start, axis) = (numbers.turn(), numbers.turn(), numbers.vector().normalize());
        let turn = numbers.vector() * 1.7;
        let l = Rotation3::new(turn).matrix() * start;
        let omega = V3::<f64>::zero();
        let axes = (M3::of(&k), M3::of(&l));
        let pair = Pair { axes: (&axes.0, &axes.1), omega, time: 0.0, accepted: false };
        let begun = M3::of(&start);
        let past = LockPast::start(&Pair { axes: (&axes.0, &begun), omega, time: 0.0, accepted: false });
        let (moment, stored) = lock.respond(&pair, &past);
        assert!((moment.to_vector() + turn * 80.0).norm() < 1e-10, "{moment:?}");
        assert!((stored - 40.0 * turn.norm_squared()).abs() < 1e-10);
        let seeded = (turning(&k, &Vector3::zeros()), turning(&l, &axis));
        let pair =
            Pair { axes: (&seeded.0, &seeded.1), omega: V3::zero(), time: Dual::new(0.0, [0.0]), accepted: false };
        let (_, by_angle) = dual.respond(&pair, &past.map(&mut |x| Dual::new(x, [0.0])));
        worst = worst.max((by_angle.slopes[0] + moment.to_vector().dot(&axis)).abs());
    }
    assert!(worst < 1e-9, "{worst:e}");
}

#[test]
fn angles_are_those_of_a_limb_that_is_bent_and_then_twisted() {
    let mut numbers = Numbers(3);
    for (joint, hand) in [(NECK, 1.0), (RIGHT_HIP, 1.0), (LEFT_HIP, -1.0)] {
        let up = if joint == NECK { 1.0 } else { -1.0 };
        for _ in 0..200 {
            let (bend, azimuth, twist) = (1.5 + 1.4 * numbers.next(), PI * numbers.next(), PI * numbers.next());
            let k = numbers.turn();
            // the reference axes of E.1, swung about ĉ × (direction of the azimuth) and turned about ẑ
            let (c, x) = (k * Vector3::z() * up, k * Vector3::x());
            let y = c.cross(&x) * hand;
            let towards = x * azimuth.cos() + y * azimuth.sin();
            let swing = Rotation3::new(c.cross(&towards) * bend);
            let turned = Rotation3::new(swing * c * (twist * hand)) * swing * k;
            let pose = pose(joint, 0.0, &k, &turned);
            let found = [pose.bend(), pose.azimuth(), pose.twist()];
            for (found, expected) in found.into_iter().zip([bend, azimuth, twist]) {
                assert!((found - expected).abs() < 1e-12, "{found} for {expected}");
            }
        }
    }
}

#[test]
fn a_positive_pitch_brings_a_head_forward_and_a_hanging_limb_back() {
    let one = Matrix3::identity();
    for (joint, azimuth) in [(NECK, PI), (RIGHT_HIP, 0.0)] {
        let pose = pose(joint, 0.2, &one, &one);
        assert!((pose.bend() - 0.2).abs() < 1e-15 && (pose.azimuth().abs() - azimuth).abs() < 1e-15);
    }
}

#[test]
fn left_joints_mirror_right_ones() {
    let (mut numbers, mirror) = (Numbers(11), Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, 1.0)));
    for (right, left) in [(RIGHT_HIP, LEFT_HIP), (RIGHT_SHOULDER, LEFT_SHOULDER)].repeat(100) {
        let (k, l) = (numbers.turn(), numbers.turn());
        let here = loaded(&both(right), &M3::of(&k), &M3::of(&l));
        let there = loaded(&both(left), &M3::of(&(mirror * k * mirror)), &M3::of(&(mirror * l * mirror)));
        assert!((here.stored - there.stored).abs() < 1e-12 * (1.0 + here.stored));
        // a moment is an axial vector
        let mirrored = -(mirror * here.stop.to_vector());
        assert!((mirrored - there.stop.to_vector()).norm() < 1e-10 * (1.0 + mirrored.norm()));
    }
}

#[test]
fn nothing_jumps_where_the_azimuth_does() {
    let bend = azimuthal();
    let [(a, slope_a), (b, slope_b)] = [PI - 1e-9, -PI + 1e-9].map(|angle| bend.angle.around(angle));
    assert!((a - b).abs() < 1e-8 && (slope_a - slope_b).abs() < 1e-7);
    assert!((bend.angle.around(270_f64.to_radians() - 2.0 * PI).0.to_degrees() - 38.0).abs() < 1e-12);
}

/// Straight and fully bent postures have no azimuth: no 0/0, with dual numbers either.
#[test]
fn straight_and_folded_joints_have_finite_torques_and_slopes() {
    let one = M3::of(&Matrix3::identity());
    let flat = M3::of(&Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0)));
    let law = Triads::new(&Body::male50(), NECK, &Centre::Pitch { pitch_rad: 0.0 });
    let dual = |x: f64, _: f64| Dual::<1>::new(x, [0.0]);
    let [bend, turn] = [azimuthal(), azimuthal()].map(|bend| Bend {
        angle: bend.angle.zip(&bend.angle, &dual),
        stop: bend.stop.zip(&bend.stop, &dual),
        gate: Dual::of(2.0),
    });
    for (l, bend) in [(one, bend), (flat, turn)] {
        let seeded = |m: M3<f64>| m.zip(&m, &|x, _| Dual::new(x, [0.3]));
        let pose = law.zip(&law, &dual).pose(&seeded(one), &seeded(l));
        let mut action = LimitAction::none(NECK);
        bend.act(true, &pose, &mut Past::none(), &mut action);
        for x in [action.stop.x, action.stop.y, action.stop.z, action.stored, action.excess] {
            assert!(x.value.is_finite() && x.slopes[0].is_finite(), "{action:?}");
        }
    }
}

/// Along any path of the angle, the work done equals stored plus dissipated energy, regardless of commits on the way.
#[test]
fn work_is_what_is_stored_and_lost() {
    let mut numbers = Numbers(5);
    let table = Stop::new(&Function::lines(vec![[0.0, 0.0], [0.2, 4.0], [0.3, 40.0]], 0.3));
    for stop in [quadratic(0.6), quadratic(1.0), table] {
        let (mut past, mut angle, mut work) = (Past::none(), -0.1, 0.0);
        for _ in 0..60 {
            let to = 0.35 * numbers.next() + 0.15;
            let count = 2000;
            for i in 0..count {
                let at = angle + (to - angle) * (f64::from(i) + 0.5) / f64::from(count);
                work += past.respond(&stop, at).torque * (to - angle) / f64::from(count);
                past.commit(&stop, at);
            }
            angle = to;
            past.commit(&stop, angle);
            let reply = past.respond(&stop, angle);
            assert!(reply.stored >= 0.0 && reply.lost >= 0.0);
            assert!(
                (work - reply.stored - reply.lost).abs() < 2e-4 * (1.0 + work),
                "{work} {} {}",
                reply.stored,
                reply.lost
            );
        }
    }
}

/// A floating body without gravity and damping, its head nodding forward at this rate, rad/s, with these changes of its
/// joints.
pub(in crate::forces::joint) fn nodding(rate: f64, change: impl FnOnce(&mut Joints)) -> Model {
    let mut joints = Joints::free(&TTI12);
    change(&mut joints);
    let mut case = SetupBuilder::new("nod", Body::male50(), joints);
    (case.setup.gravity_m_s2, case.setup.time.output_s) = (0.0, 2e-4);
    let mut rates = [0.0; DOF];
    rates[10] = rate; // θ̇ of the head
    // as fine as the books that are asked for
    let integrator = Integrator::default();
    Model::new(Setup { integrator, ..placed(case, [0.0; DOF], rates, 0.12) }).unwrap()
}

/// The same with this limit in the neck.
fn with_neck(rate: f64, neck: Limits) -> Model {
    nodding(rate, |joints| joints.limits.push(neck))
}

/// A neck without limits.
pub(in crate::forces::joint) fn free_neck() -> Limits {
    Limits { joint: NECK, centre: Centre::Pitch { pitch_rad: 0.0 }, bend: None, turn: None, friction: None, lock: None }
}

/// A lock that opens at this moment, N·m, which it reaches at 2°.
fn lock(until: f64) -> Lock<f64> {
    Lock { until, stiffness: until / 2_f64.to_radians(), slips: false, relock_below: 0.0 }
}

/// Dry friction of 15 N·m, full above 12°/s.
const RUBBING: Friction<f64> = Friction { torque: 15.0, speed: 12.0 * PI / 180.0 };

fn energies(model: &Model) -> (Vec<(EnergyLedger, f64)>, f64) {
    let mut list = Vec::new();
    let outcome = simulate(model, Watch(|s: &Sample<'_>| list.push((s.energy, s.actions.limits[0].excess)))).unwrap();
    (list, outcome.energy.balance_error)
}

#[test]
fn a_swing_into_a_limit_returns_its_share() {
    for (returned, least) in [(1.0, 5.0), (0.4, 5.0)] {
        let bend = Bend::new(Curve::constant(20_f64.to_radians()), Stop::polynomial([30.0, 200.0, 0.0], returned));
        let (list, balance_error) = energies(&with_neck(20.0, Limits { bend: Some(bend), ..free_neck() }));
        let peak = list.iter().map(|(e, _)| e.stored_j[STORED_AT] + e.stored_j[LOST_AT]).fold(0.0, f64::max);
        let taken = |e: &EnergyLedger| e.stored_j[STORED_AT];
        let deepest = (0..list.len()).max_by(|&a, &b| taken(&list[a].0).total_cmp(&taken(&list[b].0))).unwrap();
        // a stop that loses energy lets go before the joint is back inside its limit
        let (end, _) = list[deepest..].iter().find(|(e, _)| taken(e) == 0.0).unwrap();
        let begin = list[0].0;
        assert!(peak > least, "{peak}");
        let lost = begin.kinetic_j - end.kinetic_j;
        // measured: 1.9e-7 of the kinetic energy; 1e-5 J of 18 J
        assert!(balance_error < 1e-6, "{balance_error:e}");
        assert!((lost - (1.0 - returned) * peak).abs() < 1e-3 * peak, "{lost} of {peak}");
    }
}

#[test]
fn friction_takes_energy_and_brings_the_joint_to_rest() {
    let (list, balance_error) = energies(&with_neck(20.0, Limits { friction: Some(RUBBING), ..free_neck() }));
    let (begin, end) = (list[0].0, list.last().unwrap().0);
    assert!(balance_error < 1e-6, "{balance_error:e}");
    assert!(end.lost_j[DAMPING] > 0.1 * begin.kinetic_j);
    assert!((begin.kinetic_j - end.kinetic_j - end.lost_j[DAMPING]).abs() < 1e-5 * begin.kinetic_j);
}

/// Actions of the neck at every output, and the energy error of the run.
fn actions(model: &Model) -> (Vec<(f64, LimitAction<f64>)>, f64) {
    let mut list = Vec::new();
    let outcome = simulate(model, Watch(|s: &Sample<'_>| list.push((s.time_s, s.actions.limits[0])))).unwrap();
    (list, outcome.energy.balance_error)
}

/// Small oscillations of a head on a locked neck have the period given by stiffness and inertia.
#[test]
fn a_locked_joint_swings_in_its_period() {
    let closed = Lock { stiffness: 2000.0, ..lock(1e30) };
    let model = with_neck(0.2, Limits { lock: Some(closed), ..free_neck() });
    let (list, _) = actions(&model);
    let mobility = Mobility::new(&model.system().skeleton, &model.start().state);
    let (inner, outer) = model.system().forces.limits[0].segments;
    let period = 2.0 * PI / (2000.0 * mobility.of_joint(inner, outer).m22).sqrt();
    let crossings = list.windows(2).filter_map(|both| {
        let [(t, a), (next, b)] = [both[0], both[1]].map(|(t, action)| (t, action.lock.y));
        (a * b < 0.0).then(|| t + (next - t) * a / (a - b))
    });
    let crossings: Vec<f64> = crossings.collect();
    let halves = (crossings.len() - 1) as f64;
    let found = 2.0 * (crossings.last().unwrap() - crossings[0]) / halves;
    assert!(halves > 5.0 && (found / period - 1.0).abs() < 2e-3, "{found} for {period}");
}

#[test]
fn a_lock_opens_at_its_moment_and_loses_what_it_stored() {
    let (list, balance_error) = actions(&with_neck(20.0, Limits { lock: Some(lock(40.0)), ..free_neck() }));
    let (first, last) = (list[0].1, list.last().unwrap().1);
    assert_eq!((first.closed, last.closed, last.stored), (1.0, 0.0, 0.0));
    // ½ T_y²/K with T_y reached at 2°
    let stored = 0.5 * 40.0 * 2_f64.to_radians();
    assert!((last.lost / stored - 1.0).abs() < 1e-3, "{} for {stored}", last.lost);
    assert!(balance_error < 1e-6, "{balance_error:e}");
}

#[test]
fn a_slipping_lock_loses_its_moment_times_the_slip() {
    let slipping = Lock { slips: true, ..lock(15.0) };
    let (list, balance_error) = actions(&with_neck(20.0, Limits { lock: Some(slipping), ..free_neck() }));
    let most = list.iter().map(|(_, action)| action.lock.norm_squared().sqrt()).fold(0.0, f64::max);
    let last = list.last().unwrap().1;
    assert!(most < 15.0 * (1.0 + 1e-12) && last.closed == 1.0, "{most}");
    // the neck has bent by the slip and by what the spring gave way
    let bent = list.iter().map(|(_, action)| action.angles[0]).fold(0.0, f64::max);
    let slip = bent - 2_f64.to_radians();
    assert!(last.lost > 1.0 && (last.lost / (15.0 * slip) - 1.0).abs() < 0.02, "{} {slip}", last.lost);
    assert!(balance_error < 1e-5, "{balance_error:e}");
}

#[test]
fn an_open_lock_closes_where_the_joint_comes_to_rest() {
    let closing = Lock { relock_below: 0.5_f64.to_radians(), ..lock(10.0) };
    let neck = Limits { lock: Some(closing), friction: Some(RUBBING), ..free_neck() };
    let (list, _) = actions(&with_neck(20.0, neck));
    let closed: Vec<f64> = list.iter().map(|(_, action)| action.closed).collect();
    let opens = closed.iter().position(|closed| *closed == 0.0).unwrap();
    assert!(closed[opens..].contains(&1.0));
}
