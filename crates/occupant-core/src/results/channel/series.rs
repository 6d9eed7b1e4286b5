//! Time histories of chosen channels.

use super::Channel;
use crate::model::Model;
use crate::results::recorder::{Flow, Recorder, RecorderError};
use crate::results::sample::Sample;

/// A recorder that keeps the values of chosen channels at every output.
#[derive(Clone, Debug, Default)]
pub struct Series {
    /// The channels.
    pub channels: Vec<Channel>,
    /// Output times, s.
    pub time_s: Vec<f64>,
    /// By channel: a value for each output time, in the channel's SI unit.
    pub values: Vec<Vec<f64>>,
}

impl Series {
    /// Nothing seen yet.
    pub fn new(channels: Vec<Channel>) -> Self {
        let values = vec![Vec::new(); channels.len()];
        Series { channels, time_s: Vec::new(), values }
    }

    /// Values of the channel of this name, if it was chosen.
    pub fn of(&self, name: &str) -> Option<&[f64]> {
        let at = self.channels.iter().position(|c| c.name == name)?;
        Some(&self.values[at])
    }
}

impl Recorder for Series {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        let outputs = model.output_count();
        self.time_s.clear();
        self.time_s.reserve(outputs);
        for values in &mut self.values {
            values.clear();
            values.reserve(outputs);
        }
        Ok(())
    }

    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        self.time_s.push(sample.time_s);
        for (values, channel) in self.values.iter_mut().zip(&self.channels) {
            values.push(channel.value(sample));
        }
        Ok(Flow::Continue)
    }
}
