//! What switches within a step: spools that lock, pretensioners that stall, limiters that yield, webbing that is freed, each
//! against an integration of its own that ends a step exactly where its level is reached; and what a belt holds at most.

use nalgebra::Point3;
use occupant_core::body::Segment;
use occupant_core::model::Model;
use occupant_core::results::checkpoint::Checkpoint;
use occupant_core::results::outcome::{Outcome, Status};
use occupant_core::results::recorder::{Flow, Recorder, RecorderError, Watch};
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::simulate::{resume, simulate};
use occupant_tests::measure::assert_below;
use occupant_tests::room::{ends_alike_side_by_side, setup};

/// A mass of 20 kg on one strap to the origin, along z; what belongs to a case stands behind.
const ON_A_STRAP: &str = r#"
title = "a mass on a strap"
units = "si"
[output]
interval = "0.5 ms"
[path]
kind = "fixed"
[body.segments.a]
length = 0.2
cg_from_lower_end = 0.1
mass = 19.5
inertia = [0.0995, 0.0995, 0.0995]
[body.segments.b]
length = 0.2
cg_from_lower_end = 0.1
mass = 0.5
inertia = [0.0005, 0.0005, 0.0005]
[body.joints.j]
proximal = "a"
distal = "b"
kind = "fixed"
on_proximal = [0, 0, 0.1]
on_distal = [0, 0, 0.1]
[body.spheres.ball]
segment = "a"
centre = [0, 0, 0.1]
radius = 0.1
[body.landmarks]
head = "a"
chest = "a"
pelvis = "a"
[joints.all]
damping = 0
[webbings.w]
strain = [0, 1]
force = ["0 kN", "50 kN"]
returned = 1
"#;

const MASS_KG: f64 = 20.0;
const WEBBING_N: f64 = 50e3;
const SPOOL_N: f64 = 6.0;

const INTEGRATORS: [&str; 3] = [
    "integrator={ kind = \"adaptive\" }",
    "integrator={ kind = \"rk4\", step = \"0.1 ms\" }",
    "integrator={ kind = \"rk4\", step = \"0.37 ms\" }",
];

/// What is prescribed of a case.
#[derive(Clone, Copy)]
struct Strap {
    place_m: f64,
    speed_m_s: f64,
    gravity_m_s2: f64,
    end_s: f64,
    /// Where the limiter yields, m and N.
    knee: [f64; 2],
    /// When the lock begins, and what is paid out until it is done, m.
    lock: Option<[f64; 2]>,
    /// When the pretensioner fires, its speed, m/s, for how long, s, and its force, N.
    pull: Option<[f64; 4]>,
}

impl Strap {
    fn text(&self) -> String {
        let Strap { place_m, speed_m_s, gravity_m_s2, end_s, knee: [yields_m, level_n], .. } = *self;
        let mut retractor = format!("spool_tension = \"{SPOOL_N} N\"\non_spool = \"3 m\"\nlimiter = \"q\"\n");
        let mut triggers = String::new();
        if let Some([at_s, payout_m]) = self.lock {
            triggers += &format!("[triggers.locks]\nkind = \"time\"\nat = {at_s}\n");
            retractor += &format!("lock = {{ trigger = \"locks\", payout = {payout_m} }}\n");
        }
        if let Some([at_s, speed, lasts_s, stall_n]) = self.pull {
            triggers += &format!("[triggers.fires]\nkind = \"time\"\nat = {at_s}\n");
            let way = speed * lasts_s;
            retractor += &format!(
                "pretensioner = {{ trigger = \"fires\", times = [0, {lasts_s}], pull = [0, {way}], stall_force = {stall_n} }}\n"
            );
        }
        format!(
            "gravity = {gravity_m_s2}\n{ON_A_STRAP}\n[time]\nend = {end_s}\n[mount]\nsegment = \"a\"\nframe = \"vehicle\"\n\
             point = [0, 0, 0.1]\nplace = [0, 0, {place_m}]\nroll = 0\npitch = 0\nyaw = 0\nlet_go = [0, 0, {speed_m_s}]\n\
             {triggers}[limiters.q]\npayout = [0, {yields_m}, 3]\nforce = [0, {level_n}, {level_n}]\nreturned = 0.01\n\
             [retractors.r]\n{retractor}[belts.b]\nwebbing = \"w\"\nnodes = [{{ name = \"a0\", at = [0, 0, 0], retractor = \"r\" }}, \
             {{ name = \"e\", on = \"a\", at = [0, 0, 0.1] }}]\n"
        )
    }

    fn model(&self, set: &[&str]) -> Model {
        // the first keys of the text come before its first table
        let text = self.text();
        let (gravity, rest) = text.split_once('\n').unwrap();
        let text = rest.replacen("units = \"si\"", &format!("units = \"si\"\n{gravity}"), 1);
        Model::new(setup(&text, set)).unwrap()
    }

    /// Where the mass is at the end: by steps of the classical method of 2 µs, one of which ends where a level is reached.
    fn expected(&self) -> Course {
        Course::of(self)
    }
}

/// The mass and its strap, by themselves.
#[derive(Clone, Copy)]
struct Course {
    case: Strap,
    unstretched_m: f64,
    t: f64,
    z: f64,
    v: f64,
    phase: Phase,
    most_n: f64,
    switched_s: [f64; 2],
}

#[derive(Clone, Copy, PartialEq)]
enum Phase {
    Open,
    /// To this payout.
    Locking(f64),
    /// From this payout.
    Pulling(f64),
    /// p − δ, and the greatest δ.
    Locked(f64, f64),
}

impl Course {
    fn of(case: &Strap) -> Course {
        let unstretched_m = case.place_m / (1.0 + SPOOL_N / WEBBING_N);
        let (z, v) = (case.place_m, case.speed_m_s);
        let mut at =
            Course { case: *case, unstretched_m, t: 0.0, z, v, phase: Phase::Open, most_n: 0.0, switched_s: [0.0; 2] };
        let count = (case.end_s / 2e-6).round() as u64;
        for i in 1..=count {
            let end_s = case.end_s * i as f64 / count as f64;
            while at.t < end_s {
                at = at.up_to(end_s);
            }
        }
        at
    }

    /// Payout that leaves this tension.
    fn payout(&self, z: f64, tension: f64) -> f64 {
        z / (1.0 + tension / WEBBING_N) - self.unstretched_m
    }

    fn tension_at(&self, z: f64, payout: f64) -> f64 {
        (WEBBING_N * (z / (self.unstretched_m + payout) - 1.0)).max(0.0)
    }

    /// Force of the limiter.
    fn limiter(&self, delta: f64, greatest: f64) -> f64 {
        let [yields_m, level_n] = self.case.knee;
        let f = |x: f64| (level_n * x / yields_m).clamp(0.0, level_n);
        // of each interval a hundredth comes back
        if delta >= greatest { f(delta) } else { f(greatest - (greatest - delta) / 0.01) }
    }

    fn tension(&self, t: f64, z: f64) -> f64 {
        match self.phase {
            Phase::Open | Phase::Locking(_) => SPOOL_N,
            Phase::Pulling(from_m) => {
                let [at_s, speed, lasts_s, _] = self.case.pull.unwrap();
                self.tension_at(z, from_m - speed * (t - at_s).clamp(0.0, lasts_s))
            }
            Phase::Locked(base, greatest) => {
                let (mut low, mut high) = (-0.5, 3.0);
                for _ in 0..60 {
                    let delta = 0.5 * (low + high);
                    if self.limiter(delta, greatest) < self.tension_at(z, base + delta) {
                        low = delta
                    } else {
                        high = delta
                    }
                }
                self.limiter(0.5 * (low + high), greatest)
            }
        }
    }

    /// By a step of the classical method.
    fn stepped(&self, end_s: f64) -> Course {
        let (h, mut next) = (end_s - self.t, *self);
        let rate = |t: f64, z: f64, v: f64| (v, self.case.gravity_m_s2 - self.tension(t, z) / MASS_KG);
        let (a1, b1) = rate(self.t, self.z, self.v);
        let (a2, b2) = rate(self.t + 0.5 * h, self.z + 0.5 * h * a1, self.v + 0.5 * h * b1);
        let (a3, b3) = rate(self.t + 0.5 * h, self.z + 0.5 * h * a2, self.v + 0.5 * h * b2);
        let (a4, b4) = rate(end_s, self.z + h * a3, self.v + h * b3);
        next.t = end_s;
        next.z += h / 6.0 * (a1 + 2.0 * (a2 + a3) + a4);
        next.v += h / 6.0 * (b1 + 2.0 * (b2 + b3) + b4);
        next
    }

    /// How far it is beyond what ends its phase.
    fn beyond(&self) -> f64 {
        match self.phase {
            Phase::Open => {
                let lock_s = self.case.lock.map_or(f64::INFINITY, |lock| lock[0]);
                let fire_s = self.case.pull.map_or(f64::INFINITY, |pull| pull[0]);
                self.t - lock_s.min(fire_s)
            }
            Phase::Locking(payout) => self.payout(self.z, SPOOL_N) - payout,
            Phase::Pulling(_) => {
                let [at_s, _, lasts_s, stall_n] = self.case.pull.unwrap();
                (self.tension(self.t, self.z) - stall_n.min(self.case.knee[1])).max(self.t - (at_s + lasts_s))
            }
            Phase::Locked(..) => f64::NEG_INFINITY,
        }
    }

    fn up_to(&self, end_s: f64) -> Course {
        let mut next = self.stepped(end_s);
        if next.beyond() >= 0.0 {
            let (mut low, mut high) = (self.t, end_s);
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                if self.stepped(middle).beyond() < 0.0 { low = middle } else { high = middle }
            }
            next = self.stepped(high);
            next.switch();
        }
        let tension = next.tension(next.t, next.z);
        next.most_n = next.most_n.max(tension);
        if let Phase::Locked(base, greatest) = &mut next.phase {
            let delta = self.payout(next.z, tension) - *base;
            *greatest = greatest.max(delta);
        }
        next
    }

    fn switch(&mut self) {
        let tension = self.tension(self.t, self.z);
        let payout = self.payout(self.z, tension);
        self.switched_s = [self.switched_s[1], self.t];
        self.phase = match (self.phase, self.case.lock) {
            (Phase::Open, Some([_, more])) => Phase::Locking(payout + more),
            (Phase::Open, None) => Phase::Pulling(payout),
            _ => {
                let [yields_m, level_n] = self.case.knee;
                let delta = yields_m * tension.min(level_n) / level_n;
                Phase::Locked(payout - delta, delta)
            }
        };
    }
}

/// Place of the mass at the end, and the greatest tension at an output.
fn run(model: &Model) -> [f64; 2] {
    let (mut z, mut most_n) = (f64::NAN, 0.0_f64);
    let watch = Watch(|s: &Sample<'_>| {
        z = s.sphere_centre_m(0).z;
        most_n = most_n.max(s.actions.chains[0].force);
    });
    assert_eq!(simulate(model, watch).unwrap().status, Status::Completed);
    [z, most_n]
}

/// Numbers spread evenly over (0, 1), the same in every run.
fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1_u64 << 53) as f64
}

fn within(seed: &mut u64, from: f64, to: f64) -> f64 {
    from + (to - from) * random(seed)
}

#[test]
fn a_mass_on_a_spool_that_locks_goes_as_far_as_a_closed_integration_says() {
    let mut seed = 33;
    let mut worst = 0.0_f64;
    for _ in 0..12 {
        let level_n = within(&mut seed, 800.0, 2500.0);
        let case = Strap {
            place_m: 0.5,
            speed_m_s: within(&mut seed, 1.0, 5.0),
            gravity_m_s2: 9.806_65,
            end_s: 0.06,
            knee: [within(&mut seed, 0.01, 0.05), level_n],
            lock: Some([within(&mut seed, 0.004, 0.02), within(&mut seed, 0.002, 0.03)]),
            pull: None,
        };
        let expected = case.expected();
        for integrator in INTEGRATORS {
            let [z, _] = run(&case.model(&[integrator]));
            worst = worst.max((z - expected.z).abs() / (expected.z - case.place_m).abs());
        }
    }
    assert_below("way of the mass", worst, 1e-4);
}

#[test]
fn a_pretensioner_stalls_at_its_force_or_at_the_level_of_the_limiter() {
    let mut seed = 7;
    let (mut worst, mut over) = (0.0_f64, 0.0_f64);
    for i in 0..12 {
        let level_n = within(&mut seed, 1000.0, 4000.0);
        let stall_n = level_n * if i % 2 == 0 { within(&mut seed, 0.4, 0.95) } else { within(&mut seed, 1.05, 3.0) };
        let case = Strap {
            place_m: 1.0,
            speed_m_s: within(&mut seed, -0.5, 2.0),
            gravity_m_s2: 0.0,
            end_s: 0.03,
            knee: [within(&mut seed, 0.01, 0.05), level_n],
            lock: None,
            pull: Some([within(&mut seed, 0.005, 0.01), within(&mut seed, 4.0, 12.0), 0.012, stall_n]),
        };
        let expected = case.expected();
        for integrator in INTEGRATORS {
            // a stall force above the limiter needs a last interval that holds it
            let steep = format!(
                "limiters.q={{ payout = [0, {}, 3, 3.01], force = [0, {level_n}, {level_n}, 20000], returned = 0.01 }}",
                case.knee[0]
            );
            let [z, most_n] = run(&case.model(&[integrator, &steep]));
            worst = worst.max((z - expected.z).abs() / (expected.z - case.place_m).abs());
            over = over.max(most_n / level_n.min(expected.most_n.max(1.0)) - 1.0);
        }
    }
    // some of these masses go a few mm only: the worst of three methods, 1.54e-4 of its way
    assert_below("way of the mass", worst, 2e-4);
    assert_below("tension above what it can be", over, 1e-4);
}

/// A mass that falls on a spool, which locks 20 mm after 20 ms.
const FALLS: Strap = Strap {
    place_m: 0.5,
    speed_m_s: 3.0,
    gravity_m_s2: 9.806_65,
    end_s: 0.06,
    knee: [0.03, 1000.0],
    lock: Some([0.02, 0.02]),
    pull: None,
};

/// A pretensioner that stalls.
const PULLED: Strap = Strap {
    place_m: 1.0,
    speed_m_s: 0.0,
    gravity_m_s2: 0.0,
    end_s: 0.03,
    knee: [0.03, 3000.0],
    lock: None,
    pull: Some([0.013, 7.5, 0.008, 1500.0]),
};

/// Whatever the outputs, and whether a step ends at one.
#[test]
fn a_summary_tells_when_a_spool_locks_whatever_the_outputs() {
    for (case, what) in [(FALLS, "locks"), (PULLED, "locks")] {
        let [_, expected_s] = case.expected().switched_s;
        for integrator in INTEGRATORS {
            for interval in ["0.1 ms", "0.5 ms", "1 ms", "5 ms"] {
                let model = case.model(&[integrator, &format!("output.interval=\"{interval}\"")]);
                let mut summarizer = Summarizer::new();
                simulate(&model, &mut summarizer).unwrap();
                let events = summarizer.summary(None).unwrap().events;
                let times: Vec<f64> = events.iter().filter(|e| e.what == what).map(|e| e.time_s).collect();
                assert_eq!(times.len(), 1, "{integrator} {interval} {events:?}");
                // the time of a switch is found to a thousandth of the step
                assert_below(&format!("{integrator} {interval}"), times[0] - expected_s, 2e-6);
            }
        }
    }
}

#[test]
fn a_run_in_which_something_switches_goes_on_from_any_output_with_the_same_bits() {
    for case in [FALLS, PULLED] {
        for integrator in INTEGRATORS {
            let model = case.model(&[integrator, "output.interval=\"0.3 ms\""]);
            let mut all: Vec<Checkpoint> = Vec::new();
            simulate(&model, Watch(|s: &Sample<'_>| all.push(s.checkpoint()))).unwrap();
            for (i, from) in all.iter().enumerate().step_by(3) {
                let mut again: Vec<Checkpoint> = Vec::new();
                resume(&model, from, Watch(|s: &Sample<'_>| again.push(s.checkpoint()))).unwrap();
                assert!(again[..] == all[i..], "{integrator}, from output {i}");
            }
        }
    }
}

#[test]
fn switches_side_by_side_have_the_bits_of_each_alone() {
    for (k, case) in [FALLS, PULLED].into_iter().enumerate() {
        ends_alike_side_by_side(|i| {
            let mut case = Strap { speed_m_s: case.speed_m_s + 0.37 * f64::from(i), ..case };
            case.knee[1] *= 1.0 + 0.1 * f64::from(i);
            case.model(&[INTEGRATORS[1 + k], "output.interval=\"0.9 ms\""])
        });
    }
}

/// A mass of 20 kg that a belt over two rings and a guide on it stops: what differs from belt to belt stands behind.
fn three_point(seed: &mut u64) -> (String, f64) {
    let mut number = |from: f64, to: f64| within(seed, from, to);
    let level_n = number(1500.0, 6000.0);
    let (yields_m, stall_n) = (number(0.005, 0.04), level_n * number(0.3, 1.6));
    let (stiff_n, speed, place_y) = (number(2e5, 1.5e6), number(6.0, 16.0), number(-0.05, 0.05));
    let (lock_s, payout_m, fires_s) = (number(0.0, 0.02), number(0.0, 0.02), number(0.0, 0.04));
    let (lasts_s, way_m, frictions) = (number(0.005, 0.012), number(0.02, 0.12), [(); 3].map(|()| number(0.0, 0.35)));
    let [ring, guide, tongue] = frictions;
    let text = ON_A_STRAP
        .replacen("units = \"si\"", "units = \"si\"\ngravity = 0", 1)
        .replace("force = [\"0 kN\", \"50 kN\"]", &format!("force = [0, {stiff_n}]"))
        + &format!(
            "[time]\nend = 0.08\n[mount]\nsegment = \"a\"\nframe = \"vehicle\"\npoint = [0, 0, 0.1]\nplace = [0, {place_y}, 0]\n\
             roll = 0\npitch = 0\nyaw = 0\nlet_go = [{speed}, 0, 0]\n[triggers.locks]\nkind = \"time\"\nat = {lock_s}\n\
             [triggers.fires]\nkind = \"time\"\nat = {fires_s}\n[limiters.q]\npayout = [0, {yields_m}, 3, 3.01]\n\
             force = [0, {level_n}, {level_n}, 50000]\nreturned = 0.01\n[retractors.r]\nspool_tension = \"6 N\"\non_spool = \"3 m\"\n\
             limiter = \"q\"\nlock = {{ trigger = \"locks\", payout = {payout_m} }}\n\
             pretensioner = {{ trigger = \"fires\", times = [0, {lasts_s}], pull = [0, {way_m}], stall_force = {stall_n} }}\n\
             [belts.b]\nwebbing = \"w\"\nnodes = [\n{{ name = \"reel\", at = [-0.3, -0.3, 0.4], retractor = \"r\" }},\n\
             {{ name = \"ring\", at = [-0.25, -0.3, -0.4], friction = {ring} }},\n\
             {{ name = \"chest\", on = \"a\", at = [0.1, 0, 0.1], friction = {guide} }},\n\
             {{ name = \"tongue\", at = [-0.2, 0.25, 0.3], friction = {tongue} }},\n\
             {{ name = \"sill\", at = [-0.2, -0.25, 0.35] }}]\n"
        );
    (text, level_n)
}

/// Whichever acts first, and whatever still pulls: the first strap holds the level of the limiter at most, and each behind it
/// that times e^(μθ) of the rings between.
#[test]
fn no_belt_with_a_limiter_and_a_pretensioner_holds_more_than_the_level_and_the_friction_of_its_rings() {
    let (mut seed, mut worst, mut yields) = (1, 0.0_f64, 0);
    for _ in 0..500 {
        let (text, level_n) = three_point(&mut seed);
        let model = Model::new(setup(&text, &["integrator={ kind = \"adaptive\" }"])).unwrap();
        let friction: Vec<f64> = model.setup().chains[0].nodes.iter().map(|node| node.friction).collect();
        let mut has_yielded = false;
        let watch = Watch(|s: &Sample<'_>| {
            let mut most_n = level_n;
            for (i, strap) in s.actions.chains.iter().enumerate() {
                most_n *= if i > 0 { (friction[i] * strap.turn).exp() } else { 1.0 };
                worst = worst.max(strap.force / most_n - 1.0);
            }
            has_yielded |= s.actions.chains[0].force > 0.999 * level_n;
        });
        assert_eq!(simulate(&model, watch).unwrap().status, Status::Completed);
        yields += u32::from(has_yielded);
    }
    assert!(yields > 250, "{yields}");
    assert_below("above level and friction", worst, 1e-3);
}

/// What a belt does at most changes little with the force, the level and the delay of its devices, wherever they are.
#[test]
fn forces_do_not_jump_with_stall_force_level_and_delay() {
    let (text, level_n) = three_point(&mut 5);
    let peak = |set: &str| {
        let model = Model::new(setup(&text, &["integrator={ kind = \"adaptive\" }", set])).unwrap();
        let mut most_n = 0.0_f64;
        simulate(&model, Watch(|s: &Sample<'_>| most_n = most_n.max(s.actions.chains[1].force))).unwrap();
        most_n
    };
    let key = "retractors.r.pretensioner";
    let stalls = (0..40).map(|i| format!("{key}.stall_force={}", level_n * (0.8 + 0.01 * f64::from(i))));
    let delays = (0..40).map(|i| format!("{key}.delay={}", 1e-3 * f64::from(i)));
    for sweep in [stalls.collect::<Vec<_>>(), delays.collect()] {
        let peaks: Vec<f64> = sweep.iter().map(|set| peak(set)).collect();
        let jump = peaks.windows(2).map(|pair| (pair[1] / pair[0] - 1.0).abs()).fold(0.0, f64::max);
        assert_below("change from one to the next", jump, 0.05);
    }
}

/// Keeps the head's path beside a summary.
struct Log {
    head: Segment,
    path: Vec<Point3<f64>>,
    summarizer: Summarizer,
}

impl Recorder for Log {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        self.summarizer.begin(model)
    }

    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        self.path.push(sample.cg_m(self.head));
        self.summarizer.record(sample)
    }

    fn end(&mut self, outcome: &Outcome) -> Result<(), RecorderError> {
        self.summarizer.end(outcome)
    }
}

/// The head's path, m, and the greatest of its accelerations, m/s², with how many evaluations that took.
fn head(text: &str, set: &[&str]) -> (Vec<Point3<f64>>, f64, u64) {
    let model = Model::new(setup(text, set)).unwrap();
    let head = model.body().tree.landmarks().head.unwrap();
    let mut log = Log { head, path: Vec::new(), summarizer: Summarizer::new() };
    let outcome = simulate(&model, &mut log).unwrap();
    let Log { path, summarizer, .. } = log;
    assert_eq!(outcome.status, Status::Completed);
    (path, summarizer.summary(None).unwrap().accelerations.head.peak_m_s2, outcome.effort.evaluations)
}

/// Belts, a bag and a column under the default integrator against short steps of rk4.
#[test]
fn shipped_restraints_are_within_a_tenth_of_a_millimetre_of_short_steps() {
    let cases = [
        ("three-point", include_str!("../../scenarios/three-point.toml")),
        ("airbag-driver", include_str!("../../scenarios/airbag-driver.toml")),
        ("column-driver", include_str!("../../scenarios/column-driver.toml")),
    ];
    for (name, text) in cases {
        let outputs = "output.interval=\"1 ms\"";
        let (path, peak, _) = head(text, &[outputs]);
        let short = "integrator={ kind = \"rk4\", step = \"5 us\" }";
        let (expected, expected_peak, _) = head(text, &[outputs, short]);
        let off_m = path.iter().zip(&expected).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        assert_below(name, off_m, 1e-4);
        assert_below(name, peak / expected_peak - 1.0, 1e-3);
    }
}
