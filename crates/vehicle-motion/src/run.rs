//! A drive of one vehicle from its start to its end, and its results: stations and the energy balance.

use crate::car::Car;
use crate::chassis::Chassis;
use crate::driver::Driver;
use crate::ground::Ground;
use crate::integrate::Tolerance;
pub use crate::ride::{Ride, Start, Station};
use crate::state::State;
use crate::world::{Begin, Entry, World, WorldError};

/// One vehicle, its driver and the ground.
#[derive(Clone, Debug)]
pub struct Drive {
    chassis: Chassis,
    world: World,
    /// Error tolerances.
    pub tolerance: Tolerance,
}

impl Drive {
    /// Of a vehicle.
    ///
    /// # Errors
    /// Problems of the vehicle.
    pub fn new(car: &Car, ground: Ground, driver: Driver) -> Result<Self, WorldError> {
        let chassis = Chassis::new(car).map_err(|what| WorldError::Car { car: 0, what })?;
        let entry = Entry::new(car.clone(), driver, Begin::At(Start::default()));
        let world = World { cars: vec![entry], ground, ..World::default() };
        Ok(Drive { chassis, world, tolerance: Tolerance::default() })
    }

    /// The equations of motion.
    pub fn chassis(&self) -> &Chassis {
        &self.chassis
    }

    /// Initial state: on the ground, wheels rolling unless they are locked.
    pub fn state_at(&self, start: &Start) -> State {
        self.chassis.state_at(start, &self.world.ground)
    }

    /// Drives from a start for `end_s` s.
    ///
    /// # Errors
    /// A start that is not finite, or with a wheel within the ground; steps that become too short.
    pub fn run(&self, start: &Start, end_s: f64) -> Result<Ride, WorldError> {
        self.begun(Begin::At(*start), end_s)
    }

    /// Drives from a state for `end_s` s.
    ///
    /// # Errors
    /// A state that is not finite; steps that become too short.
    pub fn run_from(&self, start: State, end_s: f64) -> Result<Ride, WorldError> {
        self.begun(Begin::State(start), end_s)
    }

    fn begun(&self, begin: Begin, end_s: f64) -> Result<Ride, WorldError> {
        let mut world = self.world.clone();
        world.tolerance = self.tolerance;
        world.cars[0].begin = begin;
        Ok(world.run(end_s)?.rides.swap_remove(0))
    }
}
