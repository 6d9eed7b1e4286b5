//! Throw of a body: from the blow, through the air, over the ground, to rest.
//!
//! The terms are those of accident reconstruction. The *throw distance* is the horizontal distance of the centre of
//! gravity of the whole body from its position at the blow to its position at rest. The *launch* is when it leaves what
//! struck or carried it. From there to the first contact with the ground it is *airborne*; from then on it *slides*,
//! whether it slides, rolls or bounces. [`Flight`](super::flight::Flight) finds these moments in a run. Positions and
//! velocities are in space.

use nalgebra::Vector3;
use occupant_units::trig;
use serde::Serialize;

use super::searle::{Searle, Way};
use crate::body::ContactSphere;

/// Speed at the end of a run below which a body is at rest, m/s.
const AT_REST_M_S: f64 = 0.1;

/// Throw of a body.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Throw {
    /// Reference of its distances.
    pub from: ThrowStart,
    /// Its time, s.
    pub struck_s: f64,
    /// Separation from the striking or carrying object; none before it.
    pub launch: Option<Launch>,
    /// Start and end of the times without contact other than with itself, s.
    pub airborne_s: Vec<[f64; 2]>,
    /// Horizontal distance from launch to landing, m.
    pub airborne_m: Option<f64>,
    /// First contact with the ground after the launch, for a body that was airborne between.
    pub landing: Option<Landing>,
    /// Horizontal distance from landing to the end, m; from the launch for a body that was never airborne.
    pub slide_m: Option<f64>,
    /// Throw distance, from the blow to the end, m.
    pub distance_m: f64,
    /// Horizontal distance from launch to the end, m.
    pub from_launch_m: Option<f64>,
    /// Largest height of its centre of gravity above that at the blow, m.
    pub height_m: f64,
    /// Speed at the end, m/s.
    pub end_speed_m_s: f64,
    /// Whether it is at rest at the end. If not, distances are those so far.
    pub at_rest: bool,
    /// Searle's bounds; none for a body that is not at rest, or without friction on the ground after the launch.
    pub searle: Option<Searle>,
}

/// Reference of the distances of a throw.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ThrowStart {
    /// First contact with a vehicle other than its own.
    Struck,
    /// The blow on the vehicle that carried it.
    Blow,
    /// The launch: no blow on the vehicle that carried it was found.
    Launch,
    /// First contact with the ground: neither was found.
    Ground,
}

/// Separation of a body from the striking or carrying object.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Launch {
    /// First output without contact with it, s.
    pub time_s: f64,
    /// Speed of the centre of gravity of the whole body.
    pub speed_m_s: f64,
    /// Angle of that velocity above the horizontal.
    pub angle_deg: f64,
    /// Horizontal distance from its position at the blow, m.
    pub distance_m: f64,
    /// Height of the centre of gravity above that at the end, m.
    pub height_m: f64,
}

/// Landing of a body on the ground.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Landing {
    /// Time, s.
    pub time_s: f64,
    /// Sphere of the first contact.
    pub sphere: String,
    /// Speed of the centre of gravity of the whole body.
    pub speed_m_s: f64,
    /// Angle of that velocity below the horizontal.
    pub angle_deg: f64,
    /// Horizontal distance of the centre of gravity from its position at the blow, m.
    pub distance_m: f64,
    /// Horizontal distance of the touching sphere, m.
    pub touch_distance_m: f64,
}

/// Centre of gravity of a body at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Moment {
    pub time_s: f64,
    pub place_m: Vector3<f64>,
    pub velocity_m_s: Vector3<f64>,
}

/// First contact with the ground at the end of a flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Touchdown {
    pub at: Moment,
    /// Index of the touching sphere.
    pub sphere: usize,
    pub sphere_m: Vector3<f64>,
}

/// Course of a throw in a run.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Course {
    pub from: ThrowStart,
    pub start: Moment,
    pub launch: Option<Moment>,
    pub landing: Option<Touchdown>,
    pub end: Moment,
    pub highest_m: f64,
    pub airborne_s: Vec<[f64; 2]>,
    /// Coefficient of friction on the ground.
    pub friction: Option<f64>,
    pub gravity_m_s2: f64,
}

impl Moment {
    /// Horizontal distance from another position, m.
    fn away_m(&self, other: &Moment) -> f64 {
        (self.place_m - other.place_m).xy().norm()
    }

    fn speed_m_s(&self) -> f64 {
        self.velocity_m_s.norm()
    }

    /// Angle of the velocity above the horizontal.
    fn rise_deg(&self) -> f64 {
        trig::atan2(self.velocity_m_s.z, self.velocity_m_s.xy().norm()).to_degrees()
    }

    /// Earlier time, on the same straight line.
    pub(super) fn before(self, time_s: f64) -> Self {
        let back_s = self.time_s - time_s;
        Moment { time_s, place_m: self.place_m - self.velocity_m_s * back_s, ..self }
    }
}

impl Course {
    pub(super) fn throw(self, spheres: &[ContactSphere]) -> Throw {
        let Course { start, end, launch, .. } = &self;
        let at_rest = end.speed_m_s() < AT_REST_M_S;
        let fall_m = |launch: &Moment| launch.place_m.z - end.place_m.z;
        let landing = self.landing.as_ref();
        let slides_from = landing.map(|landing| &landing.at).or(launch.as_ref());
        let searle = launch.as_ref().zip(self.friction).filter(|(_, friction)| at_rest && *friction > 0.0);
        Throw {
            from: self.from,
            struck_s: start.time_s,
            launch: launch.as_ref().map(|at| Launch {
                time_s: at.time_s,
                speed_m_s: at.speed_m_s(),
                angle_deg: at.rise_deg(),
                distance_m: at.away_m(start),
                height_m: fall_m(at),
            }),
            airborne_m: launch.as_ref().zip(landing).map(|(launch, landing)| landing.at.away_m(launch)),
            landing: landing.map(|Touchdown { at, sphere, sphere_m }| Landing {
                time_s: at.time_s,
                sphere: spheres.get(*sphere).map(|sphere| sphere.name.clone()).unwrap_or_default(),
                speed_m_s: at.speed_m_s(),
                angle_deg: -at.rise_deg(),
                distance_m: at.away_m(start),
                touch_distance_m: (sphere_m - start.place_m).xy().norm(),
            }),
            slide_m: slides_from.map(|from| end.away_m(from)),
            distance_m: end.away_m(start),
            from_launch_m: launch.as_ref().map(|at| end.away_m(at)),
            height_m: self.highest_m,
            end_speed_m_s: end.speed_m_s(),
            at_rest,
            searle: searle.map(|(at, friction)| {
                Searle::new(&Way {
                    friction,
                    gravity_m_s2: self.gravity_m_s2,
                    fall_m: fall_m(at),
                    distance_m: end.away_m(start),
                    from_launch_m: end.away_m(at),
                    speed_m_s: at.speed_m_s(),
                    angle_rad: at.rise_deg().to_radians(),
                })
            }),
            airborne_s: self.airborne_s,
        }
    }
}
