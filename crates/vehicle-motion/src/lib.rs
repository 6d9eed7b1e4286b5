//! Motion of road vehicles on pavement, slopes and ditches.
//!
//! A vehicle is a rigid body of six degrees of freedom that carries four wheels. Each wheel slides along its
//! suspension, spins, and touches the ground with a brush tyre on combined slip, which also holds a parked car on a
//! slope. The crate contains no occupants, reads no files, prints nothing and starts no thread. The same input gives
//! the same bits on every machine.
//!
//! # A run
//!
//! ```
//! use vehicle_motion::car::{Car, Class};
//! use vehicle_motion::driver::{Driver, Table};
//! use vehicle_motion::ground::Ground;
//! use vehicle_motion::run::{Drive, Start};
//!
//! // a sedan at 30 m/s brakes with all wheels locked on dry asphalt
//! let mut car = Car::of_class(Class::Sedan);
//! car.tyre.friction = 0.76;
//! let driver = Driver { brake_n_m: Table::constant(20e3), ..Driver::coasting() };
//! let drive = Drive::new(&car, Ground::level(), driver)?;
//! let ride = drive.run(&Start { speed_m_s: 30.0, ..Start::default() }, 6.0)?;
//! let stop_m = ride.last().position_m.x;
//! assert!((55.0..65.0).contains(&stop_m)); // v²/(2 μ g) = 60.4 m
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Axes and names
//!
//! | name | means |
//! |---|---|
//! | vehicle-space | X forward, Y right, Z down, fixed; gravity along +Z. Heights and slopes are positive up |
//! | body axes | x forward, y right, z down (SAE J670); origin at the vehicle's centre of gravity with its load |
//! | wheels | 0 left front, 1 right front, 2 left rear, 3 right rear |
//! | jounce | travel of a wheel along its slide, up positive |
//! | spin | absolute speed of a wheel about its axle, positive when it rolls forward |
//! | `_m`, `_rad_s`, `_n_per_m`, … | SI unit of a number; there are no others |
//!
//! # Modules
//!
//! | module | contents |
//! |---|---|
//! | [`car`] | the vehicle as data, checks |
//! | [`presets`] | vehicles by class, and how far their numbers can be trusted |
//! | [`body`] | outline, stiffness of the faces, spheres of the hull |
//! | [`ground`] | cross-sections along an axis or a road with bends, grids of heights, curbs, zones of friction; contact of a wheel |
//! | [`tyre`] | the law of slip and shear force |
//! | [`driver`] | steering, brake and drive over time; a driver who follows a line; the reaction to a collision |
//! | [`state`] | numbers of a vehicle's state, and sums of work |
//! | [`chassis`] | equations of motion: the rate of change of the state |
//! | [`crush`] | force per width over crush, outlines and nodes, contacts that conserve momentum |
//! | [`barrier`] | walls, poles, blocks, cushions, signs, rails |
//! | [`impulse`] | impacts by impulse and momentum |
//! | [`integrate`] | a Bogacki–Shampine pair with error control |
//! | [`world`] | vehicles, ground, barriers and impacts in one run; contacts and damage |
//! | [`run`] | one vehicle from its start to its end, its stations and the energy balance |
//! | [`marks`] | where tyres leave marks |
//! | [`path`] | the motion of a point of a vehicle, smooth between the steps |

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod barrier;
pub mod body;
pub mod car;
pub mod chassis;
pub mod crush;
pub mod driver;
pub mod ground;
mod hull;
pub mod impulse;
pub mod integrate;
pub mod marks;
pub mod path;
pub mod presets;
mod rail;
pub mod ride;
pub mod run;
mod slider;
pub mod state;
pub mod tyre;
mod vehicle;
pub mod world;

/// A vector in m, m/s, N …, in the axes that its name says.
pub type V3 = nalgebra::Vector3<f64>;

/// Acceleration of gravity, m/s².
pub const GRAVITY_M_S2: f64 = 9.80665;

/// Left front, right front, left rear, right rear.
pub const WHEELS: usize = 4;

/// Their names.
pub const WHEEL_NAMES: [&str; WHEELS] = ["left front", "right front", "left rear", "right rear"];
