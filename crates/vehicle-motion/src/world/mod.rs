//! Everything in one simulation: vehicles, ground, barriers, impacts, with one integrator.

mod contact;
mod damage;
mod evaluate;
mod outcome;
mod pulse;
mod run;
pub(crate) mod setup;

pub use contact::{Contact, Partner, Struck};
pub use damage::{Damage, Dent, Profile};

use crate::barrier::Barrier;
use crate::car::{Car, CarError};
use crate::driver::{Driver, Table};
use crate::ground::Ground;
use crate::integrate::Tolerance;
use crate::ride::{Ride, Start};
use crate::state::State;
use crate::{V3, WHEEL_NAMES};

/// Vehicles and their surroundings.
#[derive(Clone, Debug)]
pub struct World {
    /// Vehicles.
    pub cars: Vec<Entry>,
    /// The ground.
    pub ground: Ground,
    /// Barriers.
    pub barriers: Vec<Barrier>,
    /// Impacts by impulse and momentum. Pairs named here do not crush.
    pub impulses: Vec<Impact>,
    /// Friction between vehicles.
    pub friction: f64,
    /// Error tolerances.
    pub tolerance: Tolerance,
}

impl Default for World {
    fn default() -> Self {
        World {
            cars: Vec::new(),
            ground: Ground::level(),
            barriers: Vec::new(),
            impulses: Vec::new(),
            friction: 0.55,
            tolerance: Tolerance::default(),
        }
    }
}

/// A vehicle of a world.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The vehicle.
    pub car: Car,
    /// Driver.
    pub driver: Driver,
    /// Its start.
    pub begin: Begin,
    /// Load from its occupants.
    pub push: Option<Wrench>,
}

impl Entry {
    /// Of a vehicle without people who push it.
    pub fn new(car: Car, driver: Driver, begin: Begin) -> Self {
        Entry { car, driver, begin, push: None }
    }
}

/// Start of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "one for each vehicle")]
pub enum Begin {
    /// In equilibrium on the ground at a position.
    At(Start),
    /// With a state.
    State(State),
}

/// A force and a moment about a point of the vehicle over time, in its axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Wrench {
    /// Place from the centre of gravity, body axes, m.
    pub about_m: V3,
    /// Force x, y, z, N, then moment x, y, z, N·m.
    pub components: [Table; 6],
}

/// An impact by impulse and momentum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// The vehicle that is counted first, and its partner.
    pub between: (usize, Partner),
    /// Time, s; none: at the first contact of their outlines.
    pub time_s: Option<f64>,
    /// Position, X and Y, m; none: the point of first contact.
    pub at_m: Option<[f64; 2]>,
    /// Direction of the line of contact's normal, clockwise from X, rad; either sense.
    pub normal_rad: f64,
    /// Restitution.
    pub restitution: f64,
    /// Largest ratio of the impulse along the contact to that across it.
    pub friction: f64,
    /// Duration, s; 0: instantaneous.
    pub duration_s: f64,
}

/// An impact that did not act; its pair passes through each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Missed {
    /// Number of the impact.
    pub impact: usize,
    /// Why.
    pub why: Miss,
}

/// Why an impact did not act.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Miss {
    /// The outlines do not touch.
    Untouched,
    /// At this time, s, the two do not close along its normal.
    Separate(f64),
    /// At this time, s, its impulse would add energy.
    Gains(f64),
    /// Its place lies outside of the outline of one of the two.
    Away {
        /// When, s.
        time_s: f64,
        /// How far, m.
        by_m: f64,
    },
}

impl core::fmt::Display for Miss {
    fn fmt(&self, f: &mut core::fmt::Formatter) -> core::fmt::Result {
        match self {
            Miss::Untouched => write!(f, "their outlines do not touch"),
            Miss::Separate(time_s) => write!(f, "at {time_s:.3} s they do not close along its normal"),
            Miss::Gains(time_s) => write!(f, "at {time_s:.3} s its impulse would add energy"),
            Miss::Away { time_s, by_m } => {
                write!(f, "at {time_s:.3} s its place is {by_m:.2} m away from the outline of one of them")
            }
        }
    }
}

/// Results of a run.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The motion of each vehicle.
    pub rides: Vec<Ride>,
    /// Contacts in the order of their first contacts.
    pub contacts: Vec<Contact>,
    /// Impacts that did not act, by number.
    pub missed: Vec<Missed>,
    /// Damage of each vehicle.
    pub damage: Vec<Damage>,
    /// Travel of each barrier; 0 for fixed ones.
    pub slides: Vec<Slid>,
    /// Deformation of rails.
    pub rails: Vec<Bent>,
    /// Evaluations of the rates.
    pub evaluations: u64,
    /// Steps that were tried and rejected.
    pub rejected: u64,
    /// Error of the energy balance over the largest kinetic energy.
    pub balance: f64,
}

/// Travel of a barrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slid {
    /// Largest displacement, m.
    pub most_m: f64,
    /// Direction, clockwise from X, rad.
    pub direction_rad: f64,
    /// Speed at the end, m/s.
    pub speed_m_s: f64,
}

/// Deformation of a rail.
#[derive(Clone, Debug, PartialEq)]
pub struct Bent {
    /// Number of the barrier.
    pub barrier: usize,
    /// Largest deflection while it lasted, m.
    pub deflection_m: f64,
    /// Largest tension, N.
    pub tension_n: f64,
    /// Posts that let go.
    pub released: usize,
    /// Its line at the end, X and Y, m.
    pub line_m: Vec<[f64; 2]>,
    /// Its lines while it moved, at most one every 5 ms.
    pub moving: Vec<Bend>,
}

/// A rail at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Bend {
    /// When, s.
    pub time_s: f64,
    /// Its line, X and Y, m.
    pub line_m: Vec<[f64; 2]>,
}

/// Reason why a simulation failed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum WorldError {
    /// Problems of a vehicle.
    #[error("vehicle {}: {what}", car + 1)]
    Car {
        /// Its number.
        car: usize,
        /// What.
        what: CarError,
    },
    /// An invalid start or end time.
    #[error("the start of the drive must be finite numbers, and its end a time above 0")]
    Start,
    /// An impact that comes too late.
    #[error("impact {} at {time_s} s comes after the end of the drive at {end_s} s", impact + 1)]
    Late {
        /// Its number.
        impact: usize,
        /// Its time, s.
        time_s: f64,
        /// The end, s.
        end_s: f64,
    },
    /// Two vehicles that start within each other.
    #[error("vehicles {} and {} overlap by {depth_m:.3} m at the start", between.0 + 1, between.1 + 1)]
    Overlap {
        /// Their numbers.
        between: (usize, usize),
        /// Penetration, m.
        depth_m: f64,
    },
    /// A vehicle that starts within a barrier.
    #[error("vehicle {} overlaps barrier {} by {depth_m:.3} m at the start", car + 1, barrier + 1)]
    InBarrier {
        /// Number of the vehicle.
        car: usize,
        /// Number of the barrier.
        barrier: usize,
        /// Penetration, m.
        depth_m: f64,
    },
    /// A vehicle that starts with a wheel within the ground: across a curb or an edge.
    #[error(
        "vehicle {}: its {} wheel is {depth_m:.3} m deep in the ground at the start; expected at most {most_m:.3} m: \
         move the start, or the curb or edge that it lies across",
        car + 1, WHEEL_NAMES[*wheel]
    )]
    Buried {
        /// Number of the vehicle.
        car: usize,
        /// Number of the wheel.
        wheel: usize,
        /// Its depth, m.
        depth_m: f64,
        /// Depth at which its rim bears, or twice that at rest, m.
        most_m: f64,
    },
    /// An invalid barrier.
    #[error("barrier {}: {what}", barrier + 1)]
    Barrier {
        /// Its number.
        barrier: usize,
        /// Problem, and expected value.
        what: &'static str,
    },
    /// Steps became too short.
    #[error("at {time_s} s the step fell below {step_s} s: parts are too stiff, or inputs are implausible")]
    Step {
        /// When, s.
        time_s: f64,
        /// The step, s.
        step_s: f64,
    },
}
