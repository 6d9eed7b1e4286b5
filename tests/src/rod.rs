//! A rod on a pin that falls from level, and what its joint does to it, by itself.

use crate::room::setup;
use crate::steps::{step, until};
use occupant_core::model::Model;
use occupant_core::results::outcome::Status;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;

/// Step of the reference, s.
const STEP_S: f64 = 5e-6;
const GRAVITY_M_S2: f64 = 9.806_65;
/// An open lock closes after the joint was slow for so long, s.
const CALM_S: f64 = 5e-3;

/// What acts in the pin.
#[derive(Clone, Copy, Debug)]
pub enum Pin {
    /// Beyond an angle either way, rad, a torque over what is beyond, N·m/rad, of whose work unloading returns a part.
    Limit {
        /// Where it begins, rad.
        from_rad: f64,
        /// N·m/rad.
        per_rad: f64,
        /// Part of the work that unloading returns.
        returned: f64,
    },
    /// Damping while it moves into this, which begins at an angle either way and is full at another, rad, N·m·s.
    Stop {
        /// Where it begins, rad.
        begin_rad: f64,
        /// Where it is full, rad.
        full_rad: f64,
        /// N·m·s/rad there.
        damping: f64,
    },
    /// Held with N·m/rad until a moment, N·m, and again where it has been slower than a speed, rad/s.
    Lock {
        /// Moment at which it opens, N·m.
        until: f64,
        /// N·m/rad.
        per_rad: f64,
        /// Below which it closes, rad/s.
        below: f64,
    },
}

/// A rod that begins level, at rest.
#[derive(Clone, Copy, Debug)]
pub struct Rod {
    /// kg.
    pub mass_kg: f64,
    /// m.
    pub length_m: f64,
    /// In its pin.
    pub pin: Pin,
    /// s.
    pub end_s: f64,
}

/// A text of a rod of a mass (kg) and a length (m) whose pin has these keys, for a time (s).
pub fn text(mass_kg: f64, length_m: f64, pin: &str, end_s: f64) -> String {
    let spin = mass_kg * length_m * length_m / 12.0;
    format!(
        "title = \"a rod\"\nunits = \"si\"\ngravity = {GRAVITY_M_S2}\n[time]\nend = {end_s}\n[output]\ninterval = \"1 ms\"\n\
         [path]\nkind = \"fixed\"\n[body.segments.a]\nlength = 0.2\ncg_from_lower_end = 0.1\nmass = 5\n\
         inertia = [0.1, 0.1, 0.1]\n[body.segments.b]\nlength = {length_m}\ncg_from_lower_end = {}\nmass = {mass_kg}\n\
         inertia = [{spin}, {spin}, {spin}]\n[body.joints.j]\nproximal = \"a\"\ndistal = \"b\"\nkind = \"pin\"\n\
         on_proximal = [0, 0, 0.1]\non_distal = [0, 0, 0]\n[body.landmarks]\nhead = \"b\"\n[mount]\nsegment = \"a\"\n\
         frame = \"vehicle\"\npoint = [0, 0, 0.1]\nplace = [0, 0, 0]\nroll = 0\npitch = 90\nyaw = 0\n[joints.j]\n\
         damping = 0\n{pin}\n",
        0.5 * length_m
    )
}

/// A rod on its way: angle below level, rad, its rate, and what its pin remembers.
#[derive(Clone, Copy, Debug)]
struct Course {
    y: [f64; 2],
    /// Greatest angle beyond the limit since it was last within, rad.
    greatest: f64,
    /// The angle at which the lock is closed, if it is, rad.
    held: Option<f64>,
    /// When the lock was last closed or fast, s.
    restless_s: f64,
}

/// What a rod has come to.
#[derive(Clone, Copy, Debug, Default)]
pub struct Swung {
    /// Angle, rad.
    pub angle: f64,
    /// All that it has turned, rad.
    pub way: f64,
    /// How often its limit, stop or lock has begun to act or has closed.
    pub begins: u32,
}

impl Rod {
    /// The model with these assignments.
    pub fn model(&self, set: &[&str]) -> Model {
        let deg = f64::to_degrees;
        let pin = match self.pin {
            Pin::Limit { from_rad, per_rad, returned } => {
                let range = [-deg(from_rad), deg(from_rad)];
                format!("angle_limit = {{ range = {range:?}, torque = {{ c1 = {per_rad}, returned = {returned} }} }}")
            }
            Pin::Stop { begin_rad, full_rad, damping } => {
                let stop = |sign: f64| {
                    let [begin, full] = [begin_rad, full_rad].map(|angle| sign * deg(angle));
                    format!("{{ begin = {begin}, full = {full}, damping = {damping} }}")
                };
                format!("lower_stop = {}\nupper_stop = {}", stop(-1.0), stop(1.0))
            }
            Pin::Lock { until, per_rad, below } => {
                format!("lock = {{ until = {until}, stiffness = {per_rad}, relock_below = {} }}", deg(below))
            }
        };
        Model::new(setup(&text(self.mass_kg, self.length_m, &pin, self.end_s), set)).unwrap()
    }

    /// Angle below level at the end of the model with these assignments, rad.
    pub fn run(&self, set: &[&str]) -> f64 {
        let (mut ahead, mut angle) = (0.0, f64::NAN);
        let watch = Watch(|s: &Sample<'_>| {
            let cg = s.cg_m(s.model.body().tree.landmarks().head.unwrap());
            if s.index == 0 {
                ahead = cg.x.signum();
            }
            angle = cg.z.atan2(ahead * cg.x);
        });
        assert_eq!(simulate(&self.model(set), watch).unwrap().status, Status::Completed);
        angle
    }

    /// Torque that turns it up, N·m.
    fn torque(&self, course: &Course, [angle, rate]: [f64; 2]) -> f64 {
        match self.pin {
            Pin::Limit { from_rad, per_rad, returned } => {
                let (beyond, most) = (angle.abs() - from_rad, course.greatest);
                let loading = if beyond < most { most - (most - beyond) / returned } else { beyond };
                angle.signum() * per_rad * loading.max(0.0)
            }
            Pin::Stop { begin_rad, full_rad, damping } => {
                let part = ((angle.abs() - begin_rad) / (full_rad - begin_rad)).clamp(0.0, 1.0);
                if angle * rate > 0.0 { part * damping * rate } else { 0.0 }
            }
            Pin::Lock { per_rad, .. } => course.held.map_or(0.0, |held| per_rad * (angle - held)),
        }
    }

    /// How far it is beyond what its pin does next.
    fn beyond(&self, course: &Course, t: f64, [angle, rate]: [f64; 2]) -> f64 {
        match self.pin {
            Pin::Limit { from_rad, .. } => {
                let beyond = angle.abs() - from_rad;
                if course.greatest > 0.0 { -beyond } else { beyond }
            }
            Pin::Stop { .. } => -1.0,
            Pin::Lock { until, per_rad, below } => match course.held {
                Some(held) => per_rad * (angle - held).abs() - until,
                // fast or slow from the start of a part of a step on, and no longer
                None if course.restless_s.is_infinite() => below - rate.abs(),
                None => (rate.abs() - below).max(t - course.restless_s - CALM_S),
            },
        }
    }

    /// Does what is due; whether something begins.
    fn switch(&self, course: &mut Course, t: f64) -> bool {
        let [angle, rate] = course.y;
        match self.pin {
            Pin::Limit { from_rad, .. } => {
                course.greatest = if course.greatest > 0.0 { 0.0 } else { angle.abs() - from_rad };
                course.greatest > 0.0
            }
            Pin::Stop { .. } => false,
            Pin::Lock { below, .. } => {
                let is_fast = rate.abs() > below;
                match course.held {
                    Some(_) => (course.held, course.restless_s) = (None, if is_fast { f64::INFINITY } else { t }),
                    None if course.restless_s.is_infinite() => course.restless_s = t,
                    None if is_fast => course.restless_s = f64::INFINITY,
                    None => course.held = Some(angle),
                }
                course.held.is_some()
            }
        }
    }

    /// The rod at the end.
    pub fn expected(&self) -> Swung {
        let arm = 0.5 * self.length_m;
        let about = self.mass_kg * (self.length_m * self.length_m / 12.0 + arm * arm);
        let held = matches!(self.pin, Pin::Lock { .. }).then_some(0.0);
        let mut course = Course { y: [0.0; 2], greatest: 0.0, held, restless_s: 0.0 };
        let mut swung = Swung::default();
        for i in 0..(self.end_s / STEP_S).round() as u64 {
            let (mut t, end_s) = (STEP_S * i as f64, STEP_S * (i + 1) as f64);
            let was = course.y[0];
            for _ in 0..4 {
                let before = course;
                let rate = |_: f64, y: [f64; 2]| {
                    let fall = self.mass_kg * GRAVITY_M_S2 * arm * y[0].cos();
                    [y[1], (fall - self.torque(&before, y)) / about]
                };
                let part = until(t, end_s - t, course.y, &rate, |t, y| self.beyond(&before, t, y));
                let h = part.unwrap_or(end_s - t);
                (course.y, t) = (step(t, h, course.y, &rate), t + h);
                if part.is_none() {
                    break;
                }
                swung.begins += u32::from(self.switch(&mut course, t));
            }
            if let Pin::Limit { from_rad, .. } = self.pin
                && course.greatest > 0.0
            {
                course.greatest = course.greatest.max(course.y[0].abs() - from_rad);
            }
            if let Pin::Stop { begin_rad, .. } = self.pin {
                swung.begins += u32::from(was.abs() < begin_rad && course.y[0].abs() >= begin_rad);
            }
            swung.way += (course.y[0] - was).abs();
        }
        swung.angle = course.y[0];
        swung
    }
}
