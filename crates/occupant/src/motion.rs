//! Motion of the vehicle of a case.

use occupant_core::vehicle::{PulseDefinition, PulsePath, PulseShape, VehiclePath, VehicleState};
use placed_text::with_key;

use crate::{Case, Error, ErrorKind};

impl Case {
    /// Sets the vehicle's path. [`Case::model`] refuses a text's triggers that were computed for another path.
    pub fn path(&mut self, path: VehiclePath) {
        self.setup_mut().path = path;
    }

    /// Straight motion at a speed, m/s, decelerated by a pulse.
    ///
    /// # Errors
    /// An impossible pulse.
    pub fn pulse(&mut self, speed_m_s: f64, shape: PulseShape) -> Result<(), Error> {
        self.path(VehiclePath::Pulse(PulsePath::new(PulseDefinition::new(speed_m_s, shape))?));
        Ok(())
    }

    /// The vehicle's motion is given during the run with [`Run::push`](crate::Run::push). It starts with the state
    /// `start`.
    ///
    /// # Errors
    /// A text with triggers that need the path in advance. The case then stays unchanged.
    pub fn live(&mut self, start: VehicleState) -> Result<(), Error> {
        if let Some((triggers, _)) = &self.look_ahead {
            return Err(looked_ahead(triggers));
        }
        self.path(VehiclePath::live(start));
        Ok(())
    }

    /// Whether the triggers that need the path in advance were computed for the present path.
    pub(crate) fn check_triggers(&self) -> Result<(), Error> {
        match &self.look_ahead {
            Some((triggers, path)) if *path != self.setup.path => Err(looked_ahead(triggers)),
            _ => Ok(()),
        }
    }
}

/// Triggers computed for another path.
fn looked_ahead(triggers: &[String]) -> Error {
    let names: Vec<String> = triggers.iter().map(|name| with_key("triggers", name)).collect();
    let found = "triggers that were evaluated on the path of the text, which is to be replaced";
    let expected = "triggers by time or by what a belt does, set in the `Scenario` before it becomes a case";
    Error::new(ErrorKind::Case, format!("{}: {found}; expected {expected}", names.join(", ")))
}
