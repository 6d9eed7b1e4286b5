//! Webbing on a rough sphere: a drum that stands, turns by itself, or is turned by a weight on the webbing.

use nalgebra::{Point3, Vector3};

use super::super::data::*;
use super::super::law::{Now, Room};
use super::super::past::ChainPast;
use super::super::{ChainLaw, Chains};
use super::{chain, fixed};
use crate::body::Body;
use crate::body::tti12::TTI12;
use crate::forces::element::{Element, Instant, Load};
use crate::forces::function::Function;
use crate::forces::sphere::Site as Sphere;
use crate::motion::dual::Dual;
use crate::motion::frame::Frames;
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::Layout;
use crate::motion::scalar::Scalar;
use crate::motion::state::{Shape, State};
use crate::motion::vector::{M3, V3, v3};

const RADIUS: f64 = 0.1;
const FRICTION: f64 = 0.3;
/// N per unit of strain.
const STIFF: f64 = 50e3;

/// A drum at the origin that turns about y, with webbing over its top from a fixed point ahead of it to one that moves behind it.
struct Drum {
    law: ChainLaw<f64>,
    past: ChainPast<f64>,
}

/// Its angle, and where the webbing ends.
#[derive(Clone, Copy)]
struct Posture {
    turned: f64,
    end: Vector3<f64>,
}

fn kinematics<S: Scalar>(turned: S, end: Vector3<f64>) -> Kinematics<S> {
    let mut k = Kinematics::blank();
    let ((sine, cosine), (o, one)) = (turned.sin_cos(), (S::zero(), S::one()));
    // x ahead, y right, z down: about y the top goes back
    k.axes[0] = M3 { x: v3(cosine, o, -sine), y: v3(o, one, o), z: v3(sine, o, cosine) };
    k.joint[1] = V3::of(&end);
    k
}

impl Drum {
    fn new(posture: Posture, friction: f64, rest: Rest) -> Drum {
        let (body, webbing) = (Body::male50(), Function::lines(vec![[0.0, 0.0], [1.0, STIFF]], 1.0));
        let mut data = chain(&[friction], webbing, fixed(), rest);
        data.nodes[0].site = Site::Vehicle(Point3::from(START), None);
        data.nodes[1].site = Site::Sphere(0);
        let end = body.joint_m(body.tree.segment(1));
        data.nodes[2].site = Site::Segment(1, Point3::from(end), None);
        let law = ChainLaw::new(&data, 0, &body);
        let past = at(0.0, posture, |at| {
            let (whole, past) = law.lie(at);
            law.start(at, whole, &past)
        });
        Drum { law, past }
    }

    fn now<T>(&self, time: f64, posture: Posture, look: impl FnOnce(&Now<'_, f64>) -> T) -> T {
        at(time, posture, |at| look(&self.law.now(at, &self.past, &mut Room::new(), false)))
    }

    /// Tensions, and the moment on the drum about y.
    fn pulls(&self, time: f64, posture: Posture) -> ([f64; 2], f64) {
        self.now(time, posture, |now| (tensions_of(now), self.law.couple(now, 1, 1).y))
    }

    fn commit(&mut self, time: f64, posture: Posture) {
        let Drum { law, past } = self;
        at(time, posture, |at| commit(law, at, past));
    }
}

/// An accepted step.
fn commit(law: &ChainLaw<f64>, at: &Instant<'_, f64>, past: &mut ChainPast<f64>) {
    let (at, mut load) = (Instant { accepted: true, ..*at }, Load::zero(&Layout::of(&TTI12), []));
    let (law, mut room) = (vec![law.clone()], Some(Box::new(Room::new())));
    Chains::apply(&law, &at, std::slice::from_mut(past), &mut room, &mut load, &mut |_| {});
}

fn at<T>(time: f64, posture: Posture, f: impl FnOnce(&Instant<'_, f64>) -> T) -> T {
    among(&[RADIUS], time, &kinematics(posture.turned, posture.end), f)
}

/// With a sphere on each of the first segments.
fn among<T>(radii: &[f64], time: f64, k: &Kinematics<f64>, f: impl FnOnce(&Instant<'_, f64>) -> T) -> T {
    let sphere =
        |(segment, &radius): (usize, &f64)| Sphere { segment, offset: V3::zero(), radius, knee: None, ride: None };
    let spheres: Vec<_> = radii.iter().enumerate().map(sphere).collect();
    let (state, frames) = (State::zero(Shape::new(0, 0)), Frames::still(time));
    f(&Instant { k, state: &state, frames: &frames, carried: &[], spheres: &spheres, accepted: false })
}

const START: Vector3<f64> = Vector3::new(0.5, 0.0, 0.2);
const END: Vector3<f64> = Vector3::new(-0.5, 0.0, 0.2);

const TAUT: Rest = Rest::Pretension(1000.0);

/// W for an end there.
fn wrap(end: Vector3<f64>) -> f64 {
    let beside = |point: Vector3<f64>| (RADIUS / point.norm()).acos();
    std::f64::consts::TAU - START.angle(&end) - beside(START) - beside(end)
}

#[test]
fn webbing_drawn_over_a_drum_that_stands_has_the_tensions_of_a_capstan() {
    for friction in [0.1, 0.3, 0.7] {
        let (still, pulled) = (0.0, END - Vector3::new(0.03, 0.0, 0.0));
        let mut drum = Drum::new(Posture { turned: still, end: END }, friction, TAUT);
        for i in 1..=30 {
            let end = END + (pulled - END) * f64::from(i) / 30.0;
            drum.commit(1e-3 * f64::from(i), Posture { turned: still, end });
        }
        let ([a, b], moment) = drum.pulls(0.03, Posture { turned: still, end: pulled });
        assert!((b / a / (friction * wrap(pulled)).exp() - 1.0).abs() < 1e-12, "{friction}: {a} {b}");
        assert!((moment - RADIUS * (b - a)).abs() < 1e-9 * moment, "{friction}: {moment}");
    }
}

/// A drum takes webbing along with its surface as long as the ratio of tensions allows: each strap of the length N stretches by
/// what the surface moves, ½rφ a strain of rφ/N. Beyond, the webbing slips and the tensions stay.
#[test]
fn a_drum_that_turns_takes_webbing_along_until_it_slips() {
    let mut drum = Drum::new(Posture { turned: 0.0, end: END }, FRICTION, TAUT);
    let run = |drum: &mut Drum, to: f64, start: f64| {
        for i in 1..=100 {
            let turned = start + (to - start) * f64::from(i) / 100.0;
            drum.commit(drum.past.device.time + 1e-4, Posture { turned, end: END });
        }
    };
    let wrap = wrap(END);
    let length = (END.norm_squared() - RADIUS * RADIUS).sqrt() + 0.5 * RADIUS * wrap;
    let unstretched = length / (1.0 + 1000.0 / STIFF);
    // 1/k of the play beside that of the webbing, per newton: x_s μW T/2
    let small = 2e-3;
    run(&mut drum, small, 0.0);
    let ([a, b], moment) = drum.pulls(drum.past.device.time, Posture { turned: small, end: END });
    let by_webbing = 2.0 * STIFF * RADIUS * small / unstretched;
    let play = 5e-4 / (FRICTION * wrap * 1000.0);
    let expected = by_webbing / (1.0 + 2.0 * STIFF / unstretched * play);
    assert!(((a - b) / expected - 1.0).abs() < 0.02, "{} {expected}", a - b);
    assert!((moment - RADIUS * (b - a)).abs() < 1e-12 && moment < 0.0);
    // carried over by more than half the arc: the mark stays on it, and the webbing slips at the ratio of a capstan
    for turned in [0.3, 0.6, 1.2] {
        run(&mut drum, turned, small);
        let ([a, b], _) = drum.pulls(drum.past.device.time, Posture { turned, end: END });
        assert!((a / b / (FRICTION * wrap).exp() - 1.0).abs() < 1e-12, "{turned}: {a} {b}");
        assert!((0.0..=RADIUS * wrap).contains(&drum.past.nodes[1].way), "{}", drum.past.nodes[1].way);
    }
    let sum = |drum: &Drum| drum.past.nodes[0].unstretched + drum.past.nodes[1].unstretched;
    assert!((sum(&drum) - 2.0 * unstretched).abs() < 1e-12);
}

/// A weight falls on webbing over a drum that it turns, the webbing slipping one way: rk4 keeps its order, and what the webbing
/// takes up is stored or lost in friction.
#[test]
fn a_weight_turns_a_drum_over_which_webbing_slips() {
    let (mass, inertia) = (40.0, 2.0);
    let end = |steps: u32| {
        // angle, speed of the drum; way, speed of the weight
        let posture = |y: [f64; 4]| Posture { turned: y[0], end: END + Vector3::new(0.0, 0.0, y[2]) };
        let mut drum = Drum::new(posture([0.0; 4]), FRICTION, Rest::Slack(0.0));
        drum.past.nodes[1].play = 1.0;
        let h = 0.02 / f64::from(steps);
        let (mut y, mut work) = ([0.0, -1.0, 0.0, 1.5], 0.0);
        for step in 0..steps {
            let time = h * f64::from(step);
            drum.commit(time, posture(y));
            let rate = |s: f64, y: [f64; 4]| {
                let law = &drum.law;
                let (pull, moment) =
                    drum.now(time + s, posture(y), |now| (law.forces(now)[2], law.couple(now, 1, 1).y));
                ([y[1], moment / inertia, y[3], 9.81 + pull.z / mass], -pull.z * y[3] - moment * y[1])
            };
            let along = |k: [f64; 4], s: f64| std::array::from_fn(|i| y[i] + s * k[i]);
            let (k1, p1) = rate(0.0, y);
            let (k2, p2) = rate(0.5 * h, along(k1, 0.5 * h));
            let (k3, p3) = rate(0.5 * h, along(k2, 0.5 * h));
            let (k4, p4) = rate(h, along(k3, h));
            work += h / 6.0 * (p1 + 2.0 * p2 + 2.0 * p3 + p4);
            y = std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
        }
        let last = 0.02;
        drum.commit(last, posture(y));
        let stored = drum.now(last, posture(y), |now| drum.law.straps.stored_in_all(&now.taut));
        let held = stored + drum.past.nodes.iter().map(|node| node.lost).sum::<f64>();
        assert_eq!(drum.past.nodes[1].play, 1.0);
        (y, work, held)
    };
    let [coarse, middle, fine] = [16, 32, 64].map(|steps| end(steps).0);
    for i in 0..4 {
        let order = ((coarse[i] - middle[i]) / (middle[i] - fine[i])).abs().log2();
        assert!((order - 4.0).abs() < 0.4, "{i}: {order}: {coarse:?} {middle:?} {fine:?}");
    }
    let (_, work, held) = end(640);
    let (_, none, start) = end(0);
    // the book is a sum of trapezia
    assert!(none == 0.0 && work > 1.0 && ((held - start) / work - 1.0).abs() < 1e-4, "{work} {held} {start}");
}

/// Tensions of the drum's straps at an angle, with any kind of number.
fn tensions<S: Scalar>(law: &ChainLaw<S>, past: &ChainPast<S>, turned: S) -> [S; 2] {
    let k = kinematics(turned, END);
    let spheres = [Sphere { segment: 0, offset: V3::zero(), radius: S::of(RADIUS), knee: None, ride: None }];
    let state = State::zero(Shape::new(0, 0));
    let frames = Frames::still(S::of(1.0));
    let at = Instant { k: &k, state: &state, frames: &frames, carried: &[], spheres: &spheres, accepted: false };
    tensions_of(&law.now(&at, past, &mut Room::new(), false))
}

/// Of the straps before and behind the drum.
fn tensions_of<S: Scalar>(now: &Now<'_, S>) -> [S; 2] {
    [0, 1].map(|strap| now.taut.straps[strap].tension)
}

/// Stuck within its play, slipping, and with the mark at the end of the arc.
#[test]
fn derivatives_on_a_drum_are_those_of_differences() {
    for (from, by) in [(0.0, 1e-3), (0.1, 0.02), (1.2, -2e-4), (1.2, 0.02)] {
        let mut drum = Drum::new(Posture { turned: 0.0, end: END }, FRICTION, TAUT);
        for i in 1..=100 {
            drum.commit(1e-3 * f64::from(i), Posture { turned: from * f64::from(i) / 100.0, end: END });
        }
        let Drum { law, past } = drum;
        let (angle, h) = (from + by, 1e-7);
        let [more, less] = [h, -h].map(|h| tensions(&law, &past, angle + h));
        let dual = law.zip(&law, &|x, _| Dual::<1>::of(x));
        let found = tensions(&dual, &past.map(&mut |x| Dual::<1>::of(x)), Dual::new(angle, [1.0]));
        for i in 0..2 {
            let slope = (more[i] - less[i]) / (2.0 * h);
            // measured: 1e-6 of it
            assert!((found[i].slopes[0] - slope).abs() < 1e-4 * slope.abs() + 1e-3, "{from} {by}: {found:?} {slope}");
            assert_eq!(found[i].value, tensions(&law, &past, angle)[i]);
        }
    }
}

/// A sphere that comes on beside another, and goes off again, turns the other's plane: the length jumps, no tension does, and
/// what the webbing that is taken up held is booked.
#[test]
fn a_sphere_that_comes_on_beside_another_changes_no_tension() {
    let (body, webbing) = (Body::male50(), Function::lines(vec![[0.0, 0.0], [1.0, STIFF]], 1.0));
    let mut data = chain(&[0.0, 0.0], webbing, fixed(), TAUT);
    data.nodes[0].site = Site::Vehicle(Point3::new(0.5, -0.2, 0.2), None);
    data.nodes[1].site = Site::Sphere(0);
    data.nodes[2].site = Site::Sphere(1);
    data.nodes[3].site = Site::Vehicle(Point3::new(-0.7, 0.3, 0.25), None);
    let law = ChainLaw::new(&data, 0, &body);
    let look = |time: f64, height: f64, f: &mut dyn FnMut(&Instant<'_, f64>)| {
        let mut k = Kinematics::blank();
        // from the line between the first sphere and the end, up and to the side
        k.joint[1] = v3(-0.35, 0.15 + 0.5 * height, 0.125 - height);
        among(&[RADIUS, 0.04], time, &k, |at| f(at));
    };
    let mut past = ChainPast::none();
    look(0.0, 0.002, &mut |at| {
        let (whole, lies) = law.lie(at);
        past = law.start(at, whole, &lies);
    });
    assert_eq!((past.nodes[1].on, past.nodes[2].on), (1.0, 0.0));
    let (mut changes, mut jumps) = (0, Vec::new());
    for i in 1..=4000 {
        // up and down again
        let height = 0.002 + 0.1 * (1.0 - (f64::from(i) / 2000.0 - 1.0).abs());
        look(1e-4 * f64::from(i), height, &mut |at| {
            let (mut room, was) = (Room::new(), past);
            let before = law.now(at, &was, &mut room, false).taut;
            commit(&law, at, &mut past);
            let mut room = Room::new();
            let after = law.now(at, &past, &mut room, false).taut;
            let [from, to] = [&before, &after].map(|taut| taut.straps[0].tension);
            assert!((to / from - 1.0).abs() < 1e-12, "{i}: {from} {to}");
            changes += u32::from(was.nodes[2].on != past.nodes[2].on);
            let taken = past.nodes[0].unstretched - was.nodes[0].unstretched;
            let booked = past.nodes[0].lost - was.nodes[0].lost;
            let held = law.straps.stored_in_all(&before) - law.straps.stored_in_all(&after);
            assert!((booked - held).abs() < 1e-9, "{i}: {booked} {held}");
            if taken != 0.0 {
                jumps.push(taken);
            }
        });
    }
    // measured: lengths jump by 9 mm where it comes on and back where it goes off
    assert!(changes == 2 && jumps.len() == 2 && jumps.iter().all(|jump| jump.abs() > 1e-7), "{changes}: {jumps:?}");
}
