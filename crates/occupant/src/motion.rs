//! How the vehicle of a case moves.

use occupant_core::vehicle::{PulseDefinition, PulsePath, PulseShape, VehiclePath, VehicleState};
use placed_text::with_key;

use crate::{Case, Error, ErrorKind};

impl Case {
    /// Gives the vehicle a path. A text's triggers that look ahead along another path are refused by [`Case::model`].
    pub fn path(&mut self, path: VehiclePath) {
        self.setup_mut().path = path;
    }

    /// Lets the vehicle go straight ahead, m/s, slowed by a pulse.
    ///
    /// # Errors
    /// A pulse that cannot be.
    pub fn pulse(&mut self, speed_m_s: f64, shape: PulseShape) -> Result<(), Error> {
        self.path(VehiclePath::Pulse(PulsePath::new(PulseDefinition::new(speed_m_s, shape))?));
        Ok(())
    }

    /// Leaves the vehicle's motion to be told on the way: [`Run::push`](crate::Run::push). It begins as `start` says.
    ///
    /// # Errors
    /// A text with triggers that look ahead along its path: of what is not known nothing can be looked at. Nothing is changed then.
    pub fn live(&mut self, start: VehicleState) -> Result<(), Error> {
        if let Some((triggers, _)) = &self.look_ahead {
            return Err(looked_ahead(triggers));
        }
        self.path(VehiclePath::live(start));
        Ok(())
    }

    /// Whether the triggers that look ahead have seen the path that there is.
    pub(crate) fn check_triggers(&self) -> Result<(), Error> {
        match &self.look_ahead {
            Some((triggers, path)) if *path != self.setup.path => Err(looked_ahead(triggers)),
            _ => Ok(()),
        }
    }
}

/// The triggers that look ahead along a path that is no longer there.
fn looked_ahead(triggers: &[String]) -> Error {
    let names: Vec<String> = triggers.iter().map(|name| with_key("triggers", name)).collect();
    let found = "triggers that were evaluated on the path of the text, which is to be replaced";
    let expected = "triggers by time or by what a belt does, set in the `Scenario` before it becomes a case";
    Error::new(ErrorKind::Case, format!("{}: {found}; expected {expected}", names.join(", ")))
}
