//! A mass on one strap, by itself: what a spool, its limiters and its pretensioner do to it, by steps of the classical method
//! one of which ends wherever something switches. It shares no code with the model.

use crate::room::setup;
use occupant_core::model::Model;
use occupant_core::results::outcome::Status;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;

/// Step of the reference, s.
const STEP_S: f64 = 5e-6;

/// What sets something off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cue {
    /// A time, s.
    At(f64),
    /// This quantity at a threshold, for how long, s.
    Watch(Watched, f64, f64),
}

/// What a trigger watches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Watched {
    /// N.
    Tension,
    /// m.
    Payout,
    /// m/s.
    Speed,
}

/// A pretensioner that pulls webbing in evenly.
#[derive(Clone, Copy, Debug)]
pub struct Pull {
    /// What fires it.
    pub cue: Cue,
    /// From that until it acts, s.
    pub delay_s: f64,
    /// How fast, m/s.
    pub speed_m_s: f64,
    /// For how long, s.
    pub lasts_s: f64,
    /// Tension at which it stops, N.
    pub stall_n: f64,
}

/// A mass on one strap to the origin, along z.
#[derive(Clone, Copy, Debug)]
pub struct Strap {
    /// kg.
    pub mass_kg: f64,
    /// Tension of the webbing over its strain, N.
    pub webbing_n: f64,
    /// Tension of the open spool, N.
    pub spool_n: f64,
    /// Where it begins, m.
    pub place_m: f64,
    /// How fast, m/s.
    pub speed_m_s: f64,
    /// Along the strap, m/s².
    pub gravity_m_s2: f64,
    /// s.
    pub end_s: f64,
    /// Where the limiter yields, m and N.
    pub knee: [f64; 2],
    /// Part of the work of the limiters that unloading returns.
    pub returned: f64,
    /// What locks the spool, and what is paid out until it is locked, m.
    pub lock: Option<(Cue, f64)>,
    /// The pretensioner.
    pub pull: Option<Pull>,
    /// What lets a second limiter take over, where that yields, m and N, and in which time, s.
    pub second: Option<(Cue, [f64; 2], f64)>,
    /// What frees the belt.
    pub release: Option<Cue>,
    /// Tension at which it tears, N.
    pub strength_n: Option<f64>,
    /// Part of the work of the webbing that unloading returns.
    pub webbing_returned: f64,
    /// Whether it ends at an anchor instead of a spool.
    pub is_fixed: bool,
}

/// A mass that falls on a spool, which locks 20 mm after 20 ms.
pub const FALLS: Strap = Strap {
    mass_kg: 20.0,
    webbing_n: 50e3,
    spool_n: 6.0,
    place_m: 0.5,
    speed_m_s: 3.0,
    gravity_m_s2: 9.806_65,
    end_s: 0.06,
    knee: [0.03, 1000.0],
    returned: 0.01,
    lock: Some((Cue::At(0.02), 0.02)),
    pull: None,
    second: None,
    release: None,
    strength_n: None,
    webbing_returned: 1.0,
    is_fixed: false,
};

/// A pretensioner that stalls.
pub const PULLED: Strap = Strap {
    place_m: 1.0,
    speed_m_s: 0.0,
    gravity_m_s2: 0.0,
    end_s: 0.03,
    knee: [0.03, 3000.0],
    lock: None,
    pull: Some(Pull { cue: Cue::At(0.013), delay_s: 0.0, speed_m_s: 7.5, lasts_s: 0.008, stall_n: 1500.0 }),
    ..FALLS
};

/// Beginning of a scenario: a mass (kg), a ball of 0.1 m, at a place along z (m) with a speed (m/s), under gravity (m/s²), for a
/// time (s).
pub fn mass_text([mass_kg, place_m, speed_m_s, gravity_m_s2, end_s]: [f64; 5]) -> String {
    let heavy_kg = mass_kg - 0.5;
    format!(
        "title = \"a mass\"\nunits = \"si\"\ngravity = {gravity_m_s2}\n[output]\ninterval = \"0.5 ms\"\n\
         [path]\nkind = \"fixed\"\n[body.segments.a]\nlength = 0.2\ncg_from_lower_end = 0.1\nmass = {heavy_kg}\n\
         inertia = [0.1, 0.1, 0.1]\n[body.segments.b]\nlength = 0.2\ncg_from_lower_end = 0.1\nmass = 0.5\n\
         inertia = [0.0005, 0.0005, 0.0005]\n[body.joints.j]\nproximal = \"a\"\ndistal = \"b\"\nkind = \"fixed\"\n\
         on_proximal = [0, 0, 0.1]\non_distal = [0, 0, 0.1]\n[body.spheres.ball]\nsegment = \"a\"\n\
         centre = [0, 0, 0.1]\nradius = 0.1\n[body.landmarks]\nhead = \"a\"\nchest = \"a\"\npelvis = \"a\"\n\
         [joints.all]\ndamping = 0\n[time]\nend = {end_s}\n[mount]\nsegment = \"a\"\nframe = \"vehicle\"\n\
         point = [0, 0, 0.1]\nplace = [0, 0, {place_m}]\nroll = 0\npitch = 0\nyaw = 0\nlet_go = [0, 0, {speed_m_s}]\n"
    )
}

impl Cue {
    fn text(self, name: &str) -> String {
        match self {
            Cue::At(at_s) => format!("[triggers.{name}]\nkind = \"time\"\nat = {at_s}\n"),
            Cue::Watch(of, threshold, lasting_s) => {
                let kind = match of {
                    Watched::Tension => "belt_tension",
                    Watched::Payout => "payout",
                    Watched::Speed => "payout_speed",
                };
                format!("[triggers.{name}]\nkind = \"{kind}\"\nthreshold = {threshold}\nfor = {lasting_s}\n")
            }
        }
    }
}

impl Strap {
    fn text(&self) -> String {
        let mut retractor = format!("spool_tension = {}\non_spool = \"3 m\"\nlimiter = \"q\"\n", self.spool_n);
        let mut triggers = String::new();
        let (returned, mut limiters) = (self.returned, String::new());
        let mut limiter = |name: &str, [yields_m, level_n]: [f64; 2]| {
            limiters += &format!(
                "[limiters.{name}]\npayout = [0, {yields_m}, 3, 3.01]\nforce = [0, {level_n}, {level_n}, 50000]\n\
                 returned = {returned}\n"
            );
        };
        limiter("q", self.knee);
        if let Some((cue, payout_m)) = self.lock {
            triggers += &cue.text("locks");
            retractor += &format!("lock = {{ trigger = \"locks\", payout = {payout_m} }}\n");
        }
        if let Some(Pull { cue, delay_s, speed_m_s, lasts_s, stall_n }) = self.pull {
            triggers += &cue.text("fires");
            let way = speed_m_s * lasts_s;
            retractor += &format!(
                "pretensioner = {{ trigger = \"fires\", delay = {delay_s}, times = [0, {lasts_s}], pull = [0, {way}], \
                 stall_force = {stall_n} }}\n"
            );
        }
        if let Some((cue, knee, over_s)) = self.second {
            triggers += &cue.text("switches");
            limiter("q2", knee);
            retractor +=
                &format!("second_limiter = {{ limiter = \"q2\", trigger = \"switches\", within = {over_s} }}\n");
        }
        let mut belt = String::new();
        if let Some(cue) = self.release {
            triggers += &cue.text("frees");
            belt += "release = \"frees\"\n";
        }
        if let Some(strength_n) = self.strength_n {
            belt += &format!("strength = {strength_n}\n");
        }
        let Strap { mass_kg, webbing_n, place_m, speed_m_s, gravity_m_s2, end_s, webbing_returned, .. } = *self;
        let (retractors, held) = match self.is_fixed {
            true => (String::new(), String::new()),
            false => (format!("{triggers}{limiters}[retractors.r]\n{retractor}"), ", retractor = \"r\"".to_owned()),
        };
        let mass = mass_text([mass_kg, place_m, speed_m_s, gravity_m_s2, end_s]);
        format!(
            "{mass}[webbings.w]\nstrain = [0, 1]\nforce = [0, {webbing_n}]\nreturned = {webbing_returned}\n\
             {retractors}[belts.b]\nwebbing = \"w\"\n{belt}nodes = [\
             {{ name = \"a0\", at = [0, 0, 0]{held} }}, {{ name = \"e\", on = \"a\", at = [0, 0, 0.1] }}]\n"
        )
    }

    /// The model with these assignments.
    pub fn model(&self, set: &[&str]) -> Model {
        Model::new(setup(&self.text(), set)).unwrap()
    }

    /// Place and greatest tension at an output of the model with these assignments, m and N.
    pub fn run(&self, set: &[&str]) -> [f64; 2] {
        let (mut z, mut most_n) = (f64::NAN, 0.0_f64);
        let watch = Watch(|s: &Sample<'_>| {
            z = s.sphere_centre_m(0).z;
            most_n = most_n.max(s.actions.chains[0].force);
        });
        assert_eq!(simulate(&self.model(set), watch).unwrap().status, Status::Completed);
        [z, most_n]
    }

    /// The mass at the end.
    pub fn expected(&self) -> Course {
        let count = (self.end_s / STEP_S).round() as u64;
        (1..=count).fold(Course::new(self), |at, i| at.up_to(self.end_s * i as f64 / count as f64))
    }
}

/// A cue on its way.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    cue: Option<Cue>,
    delay_s: f64,
    since_s: Option<f64>,
    due_s: Option<f64>,
}

/// The mass and its strap, by themselves.
#[derive(Clone, Copy, Debug)]
pub struct Course {
    case: Strap,
    unstretched_m: f64,
    /// Greatest strain so far.
    strained: f64,
    /// s.
    pub t: f64,
    /// m.
    pub z: f64,
    /// m/s.
    pub v: f64,
    phase: Phase,
    /// In the order lock, pull, second, release.
    cues: [Waiting; 4],
    has_pulled: bool,
    is_free: bool,
    /// Greatest δ so far, m.
    greatest_m: f64,
    /// Greatest tension, N.
    pub most_n: f64,
    /// Furthest way from the start, m.
    pub way_m: f64,
    /// When anything switched, s.
    pub switched_s: [f64; 16],
    /// How often.
    pub switches: usize,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Phase {
    Fixed,
    Open,
    /// To this payout.
    Locking(f64),
    /// From this payout.
    Pulling(f64),
    /// p − δ, and the greatest δ.
    Locked(f64, f64),
}

impl Course {
    fn new(case: &Strap) -> Course {
        let Strap { lock, pull, second, release, .. } = *case;
        let wait = |cue: Option<Cue>, delay_s: f64| {
            let due_s = match cue {
                Some(Cue::At(at_s)) => Some(at_s + delay_s),
                _ => None,
            };
            Waiting { cue, delay_s, since_s: None, due_s }
        };
        Course {
            case: *case,
            unstretched_m: if case.is_fixed {
                case.place_m
            } else {
                case.place_m / (1.0 + case.spool_n / case.webbing_n)
            },
            strained: if case.is_fixed { 0.0 } else { case.spool_n / case.webbing_n },
            t: 0.0,
            z: case.place_m,
            v: case.speed_m_s,
            phase: if case.is_fixed { Phase::Fixed } else { Phase::Open },
            cues: [
                wait(lock.map(|lock| lock.0), 0.0),
                wait(pull.map(|pull| pull.cue), pull.map_or(0.0, |pull| pull.delay_s)),
                wait(second.map(|second| second.0), 0.0),
                wait(release, 0.0),
            ],
            has_pulled: false,
            is_free: false,
            greatest_m: 0.0,
            most_n: 0.0,
            way_m: 0.0,
            switched_s: [0.0; 16],
            switches: 0,
        }
    }

    /// Payout that leaves this tension.
    fn payout_at(&self, tension: f64) -> f64 {
        let (strain, most) = (tension / self.case.webbing_n, self.strained);
        let strain = if strain < most { most - (most - strain) * self.case.webbing_returned } else { strain };
        self.z / (1.0 + strain) - self.unstretched_m
    }

    fn stretched(&self, payout: f64) -> f64 {
        let (strain, most) = (self.z / (self.unstretched_m + payout) - 1.0, self.strained);
        let loading = if strain < most { most - (most - strain) / self.case.webbing_returned } else { strain };
        (self.case.webbing_n * loading).max(0.0)
    }

    /// Share of the second limiter.
    fn share(&self) -> f64 {
        let over = self.case.second.zip(self.cues[2].due_s);
        over.map_or(0.0, |((_, _, over_s), due_s)| ((self.t - due_s) / over_s).clamp(0.0, 1.0))
    }

    /// Force of the limiters.
    fn limiter(&self, delta: f64, greatest: f64) -> f64 {
        let of = |[yields_m, level_n]: [f64; 2]| {
            let f = |x: f64| (level_n * x / yields_m).clamp(0.0, level_n);
            if delta >= greatest { f(delta) } else { f(greatest - (greatest - delta) / self.case.returned) }
        };
        let share = self.share();
        let second = self.case.second.map_or(0.0, |second| of(second.1));
        of(self.case.knee) * (1.0 - share) + second * share
    }

    /// The force at which the limiters yield.
    fn level(&self) -> f64 {
        let second = self.case.second.map_or(0.0, |second| second.1[1]);
        self.case.knee[1] * (1.0 - self.share()) + second * self.share()
    }

    /// The δ between these at which `rising` turns positive.
    fn root([mut low, mut high]: [f64; 2], rising: impl Fn(f64) -> f64) -> f64 {
        for _ in 0..52 {
            let middle = 0.5 * (low + high);
            if rising(middle) < 0.0 { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }

    /// N.
    pub fn tension(&self) -> f64 {
        match self.phase {
            _ if self.is_free => 0.0,
            Phase::Fixed => self.stretched(0.0),
            Phase::Open | Phase::Locking(_) => self.case.spool_n,
            Phase::Pulling(from_m) => {
                let (pull, due_s) = (self.case.pull.unwrap(), self.cues[1].due_s.unwrap());
                self.stretched(from_m - pull.speed_m_s * (self.t - due_s).clamp(0.0, pull.lasts_s))
            }
            Phase::Locked(base, greatest) => {
                let over = |delta: f64| self.limiter(delta, greatest) - self.stretched(base + delta);
                self.limiter(Self::root([-0.1, greatest + 0.1], over), greatest)
            }
        }
    }

    fn payout(&self) -> f64 {
        self.payout_at(self.tension())
    }

    fn moved(&self, t: f64, z: f64, v: f64) -> Course {
        Course { t, z, v, ..*self }
    }

    /// By a step of the classical method.
    fn stepped(&self, end_s: f64) -> Course {
        let (h, from) = (end_s - self.t, *self);
        let pull = |at: &Course| (at.v, at.case.gravity_m_s2 - at.tension() / at.case.mass_kg);
        let ahead = |h: f64, (a, b): (f64, f64)| from.moved(from.t + h, from.z + h * a, from.v + h * b);
        let one = pull(self);
        let two = pull(&ahead(0.5 * h, one));
        let three = pull(&ahead(0.5 * h, two));
        let four = pull(&ahead(h, three));
        let mean = |a: f64, b: f64, c: f64, d: f64| (a + 2.0 * (b + c) + d) / 6.0;
        let next = ahead(h, (mean(one.0, two.0, three.0, four.0), mean(one.1, two.1, three.1, four.1)));
        next.moved(end_s, next.z, next.v)
    }

    fn watched(&self, of: Watched) -> f64 {
        match of {
            Watched::Tension => self.tension(),
            Watched::Payout => self.payout(),
            // of an open spool
            Watched::Speed => self.v / (1.0 + self.case.spool_n / self.case.webbing_n),
        }
    }

    /// How far it is beyond what switches next; at 0 that is due.
    fn beyond(&self) -> f64 {
        let of_cue = |waiting: &Waiting| match (waiting.cue, waiting.due_s) {
            (Some(Cue::Watch(of, threshold, lasting_s)), None) => {
                let held = waiting.since_s.map_or(f64::NEG_INFINITY, |since_s| self.t - since_s - lasting_s);
                let begins = self.watched(of) - threshold;
                if waiting.since_s.is_some() { held.max(-1e-12 - begins) } else { begins }
            }
            _ => f64::NEG_INFINITY,
        };
        let is_due = |waiting: &Waiting| waiting.due_s.map_or(f64::NEG_INFINITY, |due_s| self.t - due_s);
        let [lock, pull, second, release] = &self.cues;
        let mut beyond = self.cues.iter().map(of_cue).fold(f64::NEG_INFINITY, f64::max);
        if matches!(self.phase, Phase::Open) {
            beyond = beyond.max(is_due(lock));
        }
        if !self.has_pulled {
            beyond = beyond.max(is_due(pull));
        }
        if let (Some(due_s), Some((_, _, over_s))) = (second.due_s, self.case.second) {
            // corners in time of the shares
            let nearest = [due_s, due_s + over_s].into_iter().find(|at_s| self.last_s() < *at_s);
            beyond = beyond.max(nearest.map_or(f64::NEG_INFINITY, |at_s| self.t - at_s));
        }
        if !self.is_free {
            beyond = beyond.max(is_due(release));
            beyond = beyond.max(self.case.strength_n.map_or(f64::NEG_INFINITY, |most| self.tension() - most));
        }
        match self.phase {
            Phase::Locking(payout) => beyond.max(self.payout() - payout),
            Phase::Pulling(_) => {
                let pull = self.case.pull.unwrap();
                let over_s = self.t - self.cues[1].due_s.unwrap() - pull.lasts_s;
                beyond.max(self.tension() - pull.stall_n.min(self.level())).max(over_s)
            }
            _ => beyond,
        }
    }

    fn last_s(&self) -> f64 {
        self.switches.checked_sub(1).map_or(f64::NEG_INFINITY, |last| self.switched_s[last % 16])
    }

    fn up_to(mut self, end_s: f64) -> Course {
        while self.t < end_s {
            let mut next = self.stepped(end_s);
            if next.beyond() >= 0.0 {
                let (mut low, mut high) = (self.t, end_s);
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if self.stepped(middle).beyond() < 0.0 { low = middle } else { high = middle }
                }
                next = self.stepped(high);
                next.switch();
                // two at the same time
                for _ in 0..4 {
                    if next.beyond() >= 0.0 {
                        next.switch();
                    }
                }
            }
            let tension = next.tension();
            next.most_n = next.most_n.max(tension);
            next.way_m = next.way_m.max((next.z - next.case.place_m).abs());
            next.strained = next.strained.max(tension / next.case.webbing_n);
            if let Phase::Locked(base, greatest) = next.phase {
                next.greatest_m = greatest.max(next.payout() - base);
                next.phase = Phase::Locked(base, next.greatest_m);
            }
            self = next;
        }
        self
    }

    fn lock(&mut self, tension: f64) {
        let payout = self.payout_at(tension);
        let least = tension.min(self.level() * (1.0 - 1e-12));
        let greatest = self.greatest_m;
        let delta = Self::root([-0.1, greatest + 0.2], |delta| self.limiter(delta, greatest) - least);
        self.greatest_m = greatest.max(delta);
        self.phase = Phase::Locked(payout - delta, self.greatest_m);
    }

    /// Does what is due.
    fn switch(&mut self) {
        let (t, tension, payout) = (self.t, self.tension(), self.payout());
        self.switched_s[self.switches % 16] = t;
        self.switches += 1;
        for k in 0..4 {
            let Waiting { cue: Some(Cue::Watch(of, threshold, lasting_s)), due_s: None, .. } = self.cues[k] else {
                continue;
            };
            let holds = self.watched(of) >= threshold - 1e-12;
            let own = &mut self.cues[k];
            own.since_s = if holds { own.since_s.or(Some(t)) } else { None };
            if own.since_s.is_some_and(|since_s| t - since_s >= lasting_s - 1e-12) {
                own.due_s = Some(t + own.delay_s);
            }
        }
        let is_due = |waiting: &Waiting| waiting.due_s.is_some_and(|due_s| t >= due_s - 1e-12);
        let most = self.case.pull.map_or(f64::INFINITY, |pull| pull.stall_n).min(self.level());
        if is_due(&self.cues[3]) || self.case.strength_n.is_some_and(|most| tension >= most - 1e-9) {
            self.is_free = true;
        }
        if is_due(&self.cues[1]) && !self.has_pulled {
            self.has_pulled = true;
            if tension < most {
                self.phase = Phase::Pulling(payout);
            } else if !matches!(self.phase, Phase::Locked(..)) {
                self.lock(tension);
            }
        }
        match (self.phase, self.case.pull) {
            (Phase::Pulling(_), Some(pull)) => {
                let is_over = t - self.cues[1].due_s.unwrap() >= pull.lasts_s - 1e-12;
                if is_over || tension >= most - 1e-9 {
                    self.lock(tension);
                }
            }
            (Phase::Open, _) if is_due(&self.cues[0]) => {
                self.phase = Phase::Locking(payout + self.case.lock.unwrap().1);
            }
            _ => {}
        }
        if let Phase::Locking(to_m) = self.phase
            && payout >= to_m - 1e-12
        {
            self.lock(tension);
        }
    }
}
