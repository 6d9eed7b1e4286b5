//! Webbing on a rough sphere: a drum that stands, turns by itself, or is turned by a weight on the webbing.

use nalgebra::{Point3, Vector3};

use super::super::ChainLaw;
use super::super::data::*;
use super::super::law::Now;
use super::super::past::ChainPast;
use super::{chain, fixed};
use crate::body::Body;
use crate::forces::element::Instant;
use crate::forces::function::Function;
use crate::forces::sphere::Site as Sphere;
use crate::motion::frame::{Frames, Moving};
use crate::motion::kinematics::Kinematics;
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

fn kinematics(posture: Posture) -> Kinematics<f64> {
    let mut k = Kinematics::blank();
    let (sine, cosine) = crash_measures::trig::sin_cos(posture.turned);
    // x ahead, y right, z down: about y the top goes back
    k.axes[0] = M3 { x: v3(cosine, 0.0, -sine), y: v3(0.0, 1.0, 0.0), z: v3(sine, 0.0, cosine) };
    k.joint[1] = V3::of(&posture.end);
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

    fn now(&self, time: f64, posture: Posture) -> Now<'_, f64> {
        at(time, posture, |at| self.law.now(at, &self.past))
    }

    /// Tensions, and the moment on the drum about y.
    fn pulls(&self, time: f64, posture: Posture) -> ([f64; 2], f64) {
        let now = self.now(time, posture);
        let [a, b, ..] = now.taut.solved.straps;
        ([a.tension, b.tension], self.law.couple(&now, 1, 1).y)
    }

    fn commit(&mut self, time: f64, posture: Posture) {
        let Drum { law, past } = self;
        at(time, posture, |at| {
            let now = law.now(at, past);
            law.commit(at, &now, past);
        });
    }
}

fn at<T>(time: f64, posture: Posture, f: impl FnOnce(&Instant<'_, f64>) -> T) -> T {
    let spheres = [Sphere { segment: 0, offset: V3::zero(), radius: RADIUS }];
    let (k, state) = (kinematics(posture), State::zero(Shape::new(0, 0)));
    let frames = Frames { time, moving: [Moving::space(); 2] };
    f(&Instant { k: &k, state: &state, frames: &frames, spheres: &spheres })
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
                let now = drum.now(time + s, posture(y));
                let pull = drum.law.forces(&now)[2].to_vector();
                let moment = drum.law.couple(&now, 1, 1).y;
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
        let taut = drum.now(last, posture(y)).taut;
        let held = drum.law.straps.stored_in_all(&taut) + drum.past.nodes.iter().map(|node| node.lost).sum::<f64>();
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
