//! A body that may be thrown, followed from output to output.
//!
//! Contacts are with the ground, or with what carries or strikes it: its own vehicle, another one, faces on another
//! body. Its own parts and the parts of other bodies do not count: a hand on the head is not a landing.

use nalgebra::Vector3;

use super::throw::{Course, Moment, Throw, ThrowStart, Touchdown};
use crate::body::ContactSphere;
use crate::forces::contact::Touch;
use crate::forces::contact::surface::Frame;
use crate::model::Model;
use crate::model::setup::{STANDARD_GRAVITY_M_S2, Setup};
use crate::motion::frame::MOST_FRAMES;
use crate::results::sample::Sample;
use crate::vehicle::FrameMotion;

/// Time without contact below which a body does not count as airborne, s.
const AIRBORNE_S: f64 = 0.01;
/// Acceleration beyond that of tyres, above which a vehicle counts as struck, m/s²: 2 g.
const BLOW_M_S2: f64 = 2.0 * STANDARD_GRAVITY_M_S2;
/// Time over which changes of velocity count, for a linearly interpolated path without accelerations, s.
const WINDOW_S: f64 = 0.02;

/// A body that may be thrown.
#[derive(Clone, Debug)]
pub(super) struct Flight {
    of: usize,
    pub name: &'static str,
    /// Frames at rest: space, the ground and what they carry.
    still: Vec<usize>,
    /// Frames of its home vehicle; none for a body that stands, walks or lies on the ground.
    homes: Vec<usize>,
    gravity_m_s2: f64,
    /// The blow, and the start of the present search window, with the velocity of the home.
    blow: Option<Moment>,
    window: Option<(Moment, Vector3<f64>)>,
    highest_m: f64,
    airborne_s: Vec<[f64; 2]>,
    /// Start of the present time without contact, and whether it left a carrier then.
    free: Option<(Moment, bool)>,
    /// Last output with a carrier in contact, and whether that was the last output with any contact.
    carried: Option<Moment>,
    was_carried: bool,
    /// Longest flight from a carrier to the ground.
    flown: Option<(Moment, Touchdown)>,
    /// First contact with the ground, and its friction.
    grounded: Option<Moment>,
    friction: Option<f64>,
    now: Option<Moment>,
}

/// Contacts of a body at an output, without those with itself and with other bodies.
#[derive(Default)]
struct Touched {
    carrier: bool,
    /// First contact of a vehicle other than its home, if any.
    striker_s: Option<f64>,
    /// First contact with the ground, and its friction.
    ground: Option<(Touchdown, f64)>,
}

impl Flight {
    /// Those of all bodies of a model in which they may be struck.
    pub(super) fn all(model: &Model) -> Vec<Flight> {
        let setup = model.setup();
        if !setup.is_open() {
            return Vec::new();
        }
        let bodies = model.body().tree.bodies().into_iter().enumerate().zip(setup.homes());
        bodies.map(|((of, row), home)| Flight::new(setup, of, row.name, home)).collect()
    }

    fn new(setup: &Setup, of: usize, name: &'static str, home: Frame) -> Self {
        let all = || [Frame::Space, Frame::Vehicle].into_iter().chain((0..setup.frames.len()).map(Frame::Other));
        let is_still = |frame: Frame| setup.is_ground(setup.belongs_to(frame));
        let with_home = |frame: &Frame| setup.belongs_to(*frame) == home && !is_still(home);
        let index = |frame: Frame| frame.index(&[]);
        Flight {
            of,
            name,
            still: all().filter(|frame| is_still(*frame)).map(index).collect(),
            homes: all().filter(with_home).map(index).collect(),
            gravity_m_s2: setup.gravity_m_s2,
            blow: None,
            window: None,
            highest_m: 0.0,
            airborne_s: Vec::new(),
            free: None,
            carried: None,
            was_carried: false,
            flown: None,
            grounded: None,
            friction: None,
            now: None,
        }
    }

    pub(super) fn see(&mut self, sample: &Sample<'_>) {
        let (place_m, velocity_m_s) = sample.centre_of_body(self.of);
        let now = Moment { time_s: sample.time_s, place_m, velocity_m_s };
        let touched = self.touched(sample, now);
        if self.homes.is_empty() {
            self.blow = self.blow.or(touched.striker_s.map(|time_s| now.before(time_s)));
        } else {
            self.see_blow(now, &sample.homes[self.of]);
        }
        if let Some(blow) = &self.blow {
            self.highest_m = self.highest_m.max(now.place_m.z - blow.place_m.z);
        }
        self.now = Some(now);
        if touched.carrier {
            self.carried = Some(now);
        }
        if let Some((touchdown, friction)) = touched.ground.as_ref().filter(|_| !touched.carrier) {
            self.grounded.get_or_insert(touchdown.at);
            self.friction.get_or_insert(*friction);
        }
        if !touched.carrier && touched.ground.is_none() {
            self.free.get_or_insert((now, self.was_carried));
            return;
        }
        self.was_carried = touched.carrier;
        if let Some((since, from_carrier)) = self.free.take() {
            self.end_flight(since, from_carrier, now, touched);
        }
    }

    /// Ends a time without contact.
    fn end_flight(&mut self, since: Moment, from_carrier: bool, now: Moment, touched: Touched) {
        let landing = touched.ground.filter(|_| !touched.carrier);
        let end_s = landing.as_ref().map_or(now.time_s, |(touchdown, _)| touchdown.at.time_s);
        if end_s - since.time_s < AIRBORNE_S {
            return;
        }
        self.airborne_s.push([since.time_s, end_s]);
        let longest_s = self.flown.as_ref().map_or(0.0, |(from, to)| to.at.time_s - from.time_s);
        let is_thrown = from_carrier && (self.blow.is_some() || !self.homes.is_empty());
        if let Some((touchdown, friction)) = landing.filter(|_| is_thrown && end_s - since.time_s > longest_s) {
            self.flown = Some((since, touchdown));
            self.friction = Some(friction);
        }
    }

    /// Searches for the blow on the home vehicle.
    fn see_blow(&mut self, now: Moment, home: &FrameMotion) {
        let (window, velocity) = *self.window.get_or_insert((now, home.velocity_m_s));
        if self.blow.is_some() {
            return;
        }
        if home.acceleration_m_s2.norm() > BLOW_M_S2 {
            self.blow = Some(now);
            return;
        }
        let span_s = now.time_s - window.time_s;
        if span_s >= WINDOW_S {
            let is_blow = (home.velocity_m_s - velocity).norm() > BLOW_M_S2 * span_s;
            self.blow = is_blow.then_some(window);
            self.window = Some((now, home.velocity_m_s));
        }
    }

    fn touched(&self, sample: &Sample<'_>, now: Moment) -> Touched {
        let system = sample.model.system();
        let (contacts, spheres) = (&system.forces.contacts, &system.spheres);
        let body_of = |segment: usize| system.skeleton.layout.rows()[segment].body;
        let mut touched = Touched::default();
        for touch in &sample.actions.contacts {
            let is_own = body_of(spheres[touch.sphere].segment) == self.of;
            if contacts.is_of_bodies(touch) || !is_own {
                continue;
            }
            let carrier = touch.frame.checked_sub(MOST_FRAMES).map(|i| body_of(contacts.carriers[i]));
            if self.still.contains(&touch.frame) {
                let first = Touchdown {
                    at: now.before(self.first_s(sample, touch, now.time_s)),
                    sphere: touch.sphere,
                    sphere_m: system.sphere(&sample.evaluation.kinematics, touch.sphere).1.to_vector(),
                };
                if touched.ground.as_ref().is_none_or(|(known, _)| first.at.time_s < known.at.time_s) {
                    touched.ground = Some((first, contacts.friction(touch)));
                }
            } else if carrier != Some(self.of) {
                touched.carrier = true;
                if !self.homes.contains(&touch.frame) {
                    let time_s = self.first_s(sample, touch, now.time_s);
                    touched.striker_s = Some(touched.striker_s.map_or(time_s, |known: f64| known.min(time_s)));
                }
            }
        }
        touched
    }

    /// Start of a contact: at a step since the output before if it is the first of its sphere and surface, else now.
    fn first_s(&self, sample: &Sample<'_>, touch: &Touch<f64>, now_s: f64) -> f64 {
        let surface = sample.model.system().forces.contacts.surface(touch.pair, touch.part as usize);
        let before_s = self.now.map_or(now_s, |before| before.time_s);
        let first = sample.first_touches.iter().rev().find(|t| t.sphere == touch.sphere && t.surface == surface);
        first.map_or(now_s, |first| first.time_s).clamp(before_s.min(now_s), now_s)
    }

    /// Resulting throw; none for a body that was not struck, or that is still with its vehicle.
    pub(super) fn throw(&self, spheres: &[ContactSphere]) -> Option<Throw> {
        let end = self.now?;
        let is_carried = self.carried.is_some_and(|carried| carried.time_s == end.time_s);
        let left = self.carried.filter(|_| !is_carried && self.grounded.is_some());
        let launch = self.flown.as_ref().map(|(from, _)| *from).or(left);
        let of_home = || self.blow.filter(|blow| launch.is_none_or(|launch| blow.time_s <= launch.time_s));
        let (from, start) = if self.homes.is_empty() {
            (ThrowStart::Struck, self.blow?)
        } else {
            let grounded = self.grounded?;
            let blow = of_home().map(|blow| (ThrowStart::Blow, blow));
            blow.or(launch.map(|at| (ThrowStart::Launch, at))).unwrap_or((ThrowStart::Ground, grounded))
        };
        let course = Course {
            from,
            start,
            launch: launch.filter(|launch| launch.time_s >= start.time_s),
            landing: self.flown.map(|(_, landing)| landing),
            end,
            highest_m: self.highest_m,
            airborne_s: self.airborne_s.clone(),
            friction: self.friction,
            gravity_m_s2: self.gravity_m_s2,
        };
        Some(course.throw(spheres))
    }
}
