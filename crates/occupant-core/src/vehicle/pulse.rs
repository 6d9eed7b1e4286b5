//! A vehicle that travels straight on with a fixed attitude and is slowed by a deceleration pulse. All of it is ours; the
//! report knows only tables.
//!
//! Before the pulse the speed is the initial one, after it the last one. A pulse stronger than the initial speed brings
//! the vehicle to rest, exactly, and it stays there for the rest of the pulse. With a rebound the speed continues to
//! fall to minus the rebound and stays there.

mod crossing;
mod profile;
mod shape;

use nalgebra::Vector3;

use super::cursor::PathCursor;
use super::frame::{FrameMotion, to_space};
use super::problem::{PathProblem, expect_finite};
use super::{VehiclePose, expect_finite_pose};
use crossing::time_of_loss;
use profile::Profile;
use shape::expect_not_negative;
pub use shape::{DecelerationPoint, PulseShape, Strength};

/// Direction of travel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum TravelDirection {
    /// Along the vehicle's X axis, nose first.
    #[default]
    Heading,
    /// Along this vector in vehicle-space axes, of any length above zero.
    Along(Vector3<f64>),
}

/// Input of a pulse.
#[derive(Clone, Debug, PartialEq)]
pub struct PulseDefinition {
    /// Pose at t = 0; the attitude is constant.
    pub initial: VehiclePose,
    /// Speed in the direction of travel up to the pulse, m/s, zero or more.
    pub initial_speed_m_s: f64,
    /// Direction of travel.
    pub direction: TravelDirection,
    /// Start of the pulse, s, zero or later.
    pub starts_at_s: f64,
    /// Deceleration over time.
    pub shape: PulseShape,
    /// Rebound speed, m/s, down to which the pulse may push the vehicle back; without it the vehicle stays at rest once
    /// stopped.
    pub rebound_m_s: Option<f64>,
}

impl PulseDefinition {
    /// A vehicle that travels nose first from the origin, with the pulse from t = 0, and stays at rest once stopped.
    pub fn new(initial_speed_m_s: f64, shape: PulseShape) -> Self {
        PulseDefinition {
            initial: VehiclePose::default(),
            initial_speed_m_s,
            direction: TravelDirection::default(),
            starts_at_s: 0.0,
            shape,
            rebound_m_s: None,
        }
    }
}

/// Time and distance at which the vehicle comes to rest, momentarily or finally.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Time of the run, s.
    pub time_s: f64,
    /// Distance travelled since the beginning of the deceleration, m.
    pub distance_m: f64,
}

/// Path along a pulse, checked.
#[derive(Clone, Debug, PartialEq)]
pub struct PulsePath {
    definition: PulseDefinition,
    /// Unit vector of travel in vehicle-space axes.
    direction: Vector3<f64>,
    profile: Profile,
    /// Start of the deceleration, s.
    begin_s: f64,
    /// First time of zero speed after the deceleration began.
    stop: Option<Stop>,
    /// Time from which the speed stays at minus the rebound speed (zero without one).
    floor: Option<Stop>,
    /// Pose, with zero velocities and accelerations.
    at_rest: FrameMotion,
    /// Unit vector of travel in space axes.
    direction_space: Vector3<f64>,
}

impl PulsePath {
    /// A path along the pulse of `definition`.
    ///
    /// # Errors
    /// Everything that is wrong with the definition at once.
    pub fn new(definition: PulseDefinition) -> Result<Self, Vec<PathProblem>> {
        let mut problems = Vec::new();
        find_problems(&definition, &mut problems);
        let direction = definition.direction.unit(&definition.initial, &mut problems);
        let profile = match definition.shape.profile() {
            Ok(profile) if problems.is_empty() => profile,
            Ok(_) => return Err(problems),
            Err(more) => return Err([problems, more].concat()),
        };
        let begin_s = definition.starts_at_s + definition.shape.delay_s();
        if begin_s < 0.0 {
            let expected = "0 s or later: the initial speed and position are those at 0 s";
            return Err(vec![PathProblem::new(format!("the pulse begins at {begin_s} s"), expected)]);
        }
        let stop_after_loss = |speed_m_s: f64| {
            let since_s = time_of_loss(&profile, speed_m_s)?;
            let lost_m = profile.loss(since_s, &mut PathCursor::default()).distance_m;
            Some(Stop { time_s: begin_s + since_s, distance_m: definition.initial_speed_m_s * since_s - lost_m })
        };
        let stop = stop_after_loss(definition.initial_speed_m_s);
        let floor = stop_after_loss(definition.initial_speed_m_s + definition.rebound_m_s.unwrap_or(0.0));
        if let Some(floor) = floor.filter(|_| definition.initial_speed_m_s == 0.0)
            && holds_back(&profile, floor.time_s - begin_s, floor.distance_m)
        {
            return Err(vec![held_back(floor.time_s)]);
        }
        let at_rest = FrameMotion::at_rest(&definition.initial);
        let direction_space = to_space(direction);
        Ok(PulsePath { definition, direction, profile, begin_s, stop, floor, at_rest, direction_space })
    }

    /// Definition of the path.
    pub fn definition(&self) -> &PulseDefinition {
        &self.definition
    }

    /// Start of the deceleration and end of the pulse, s.
    pub fn pulse_span_s(&self) -> (f64, f64) {
        (self.begin_s, self.begin_s + self.profile.duration_s())
    }

    /// Prescribed deceleration of largest magnitude, with its sign, m/s².
    pub fn peak_deceleration_m_s2(&self) -> f64 {
        self.profile.peak_m_s2()
    }

    /// Change of velocity prescribed by the whole pulse, m/s; the vehicle may stop earlier.
    pub fn pulse_delta_v_m_s(&self) -> f64 {
        self.profile.loss(self.profile.duration_s(), &mut PathCursor::default()).speed_m_s
    }

    /// Actual change of velocity of the vehicle, m/s: initial minus final speed.
    pub fn delta_v_m_s(&self) -> f64 {
        match self.floor {
            Some(_) => self.definition.initial_speed_m_s + self.definition.rebound_m_s.unwrap_or(0.0),
            None => self.pulse_delta_v_m_s(),
        }
    }

    /// First stop of the vehicle, if the pulse stops it.
    pub fn stop(&self) -> Option<Stop> {
        self.stop
    }

    /// Pose and motion at `t_s`, in space axes.
    pub(crate) fn motion(&self, t_s: f64, cursor: &mut PathCursor) -> FrameMotion {
        let travel = self.travel(t_s, cursor);
        FrameMotion {
            origin_m: self.at_rest.origin_m + self.direction_space * travel.distance_m,
            velocity_m_s: self.direction_space * travel.speed_m_s,
            acceleration_m_s2: self.direction_space * travel.acceleration_m_s2,
            ..self.at_rest
        }
    }

    /// Position and attitude at `t_s`, for output.
    pub(crate) fn pose(&self, t_s: f64, cursor: &mut PathCursor) -> VehiclePose {
        let initial = self.definition.initial;
        VehiclePose { position_m: initial.position_m + self.direction * self.travel(t_s, cursor).distance_m, ..initial }
    }

    /// Times at which the acceleration or its slope jumps, s, in increasing order.
    pub(crate) fn breaks_s(&self) -> Vec<f64> {
        let (begin_s, end_s) = self.pulse_span_s();
        let mut breaks_s = match &self.profile {
            Profile::Ramps(ramps) => ramps.iter().map(|ramp| begin_s + ramp.start_s).collect(),
            Profile::HalfSine { .. } | Profile::Haversine { .. } => vec![begin_s],
        };
        breaks_s.push(end_s);
        if let Some(floor) = self.floor {
            breaks_s.retain(|time_s| *time_s < floor.time_s);
            breaks_s.push(floor.time_s);
        }
        breaks_s
    }

    /// Distance from the position at t = 0, speed and acceleration in the direction of travel.
    fn travel(&self, t_s: f64, cursor: &mut PathCursor) -> Travel {
        let initial_m_s = self.definition.initial_speed_m_s;
        if let Some(floor) = self.floor.filter(|floor| t_s >= floor.time_s) {
            let speed_m_s = 0.0 - self.definition.rebound_m_s.unwrap_or(0.0);
            let distance_m = initial_m_s * self.begin_s + floor.distance_m + speed_m_s * (t_s - floor.time_s);
            return Travel { distance_m, speed_m_s, acceleration_m_s2: 0.0 };
        }
        let loss = self.profile.loss(t_s - self.begin_s, cursor);
        Travel {
            distance_m: initial_m_s * t_s - loss.distance_m,
            speed_m_s: initial_m_s - loss.speed_m_s,
            acceleration_m_s2: -loss.deceleration_m_s2,
        }
    }
}

/// Motion along the direction of travel.
struct Travel {
    distance_m: f64,
    speed_m_s: f64,
    acceleration_m_s2: f64,
}

/// Problems of a definition, without those of its shape.
fn find_problems(definition: &PulseDefinition, problems: &mut Vec<PathProblem>) {
    expect_finite_pose(problems, &definition.initial);
    expect_not_negative(problems, "initial speed", definition.initial_speed_m_s);
    expect_finite(problems, "start of the pulse", definition.starts_at_s);
    if let Some(rebound_m_s) = definition.rebound_m_s {
        expect_not_negative(problems, "rebound", rebound_m_s);
    }
}

/// Whether a vehicle that starts at rest and is at rest from τ = `since_s` on never got going: it has not moved, or
/// was to be faster afterwards than ever before. Without this the noise before a measured thrust would stop the
/// vehicle, and the thrust would be lost in silence.
fn holds_back(profile: &Profile, since_s: f64, distance_m: f64) -> bool {
    let before_m_s = profile.greatest_gain_m_s(0.0, since_s);
    let after_m_s = profile.greatest_gain_m_s(since_s, profile.duration_s());
    distance_m == 0.0 || after_m_s > before_m_s
}

/// A vehicle at rest that the pulse holds back before accelerating it.
fn held_back(stop_s: f64) -> PathProblem {
    let found = format!(
        "the initial speed is 0 and the pulse decelerates before it has set the vehicle going, so that the vehicle stands \
         still from {stop_s} s on; give an initial speed, or a negative deceleration for a vehicle that is accelerated, or a \
         rebound for one that may move back"
    );
    PathProblem::new(found, "a path that is possible")
}

impl TravelDirection {
    /// Unit vector in vehicle-space axes; a problem for a zero vector.
    pub(super) fn unit(self, initial: &VehiclePose, problems: &mut Vec<PathProblem>) -> Vector3<f64> {
        let TravelDirection::Along(vector) = self else {
            return initial.attitude.matrix().column(0).into_owned();
        };
        let size = vector.amax();
        expect_finite(problems, "direction of travel", vector.sum());
        if size == 0.0 {
            problems.push(PathProblem::new("the direction of travel is zero", "a vector with a length"));
        }
        // Through the largest component first, so that no vector is too long or too short to be squared.
        (vector / size).normalize()
    }
}

#[cfg(test)]
#[path = "tests/pulse.rs"]
mod tests;
