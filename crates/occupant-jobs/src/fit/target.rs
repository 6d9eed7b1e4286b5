//! A measured channel, made ready to be compared: in the channel's unit, filtered, cut to its window, at 10 kHz.

use crash_measures::signal::{CfcFamily, ChannelClass, whole_steps};
use occupant_core::results::channel::Channel;
use occupant_study::spread::median;
use occupant_study::{FilterChoice, Misfit};

use super::Correction;
use crate::base::Failure;
use crate::compare::{RATE_HZ, Track, Window, overlap, sampled};
use crate::files::history::{Filter, Histories};
use occupant_files::measured::Pair;

/// Coefficients of the filter classes.
pub const FAMILY: CfcFamily = CfcFamily::Iso6487;

/// A measured channel of a test.
#[derive(Clone, Debug)]
pub struct Target {
    /// The channel.
    pub channel: Channel,
    /// Filter class of both sides.
    pub class: Option<ChannelClass>,
    /// Filter as given in the study.
    pub filter: Filter,
    /// Weight, including its test's.
    pub weight: f64,
    /// The measured signal, filtered, on the clock of the run.
    pub measured: Pair,
    /// First and last time compared, s.
    pub window_s: [f64; 2],
    /// The measured values at 10 kHz in that window.
    pub reference: Vec<f64>,
}

/// The filter for a word of a study.
pub fn filter_of(choice: FilterChoice) -> Filter {
    match choice {
        FilterChoice::None => Filter::None,
        FilterChoice::J211 => Filter::J211,
        FilterChoice::Cfc60 => Filter::Class(ChannelClass::Cfc60),
        FilterChoice::Cfc180 => Filter::Class(ChannelClass::Cfc180),
        FilterChoice::Cfc600 => Filter::Class(ChannelClass::Cfc600),
        FilterChoice::Cfc1000 => Filter::Class(ChannelClass::Cfc1000),
    }
}

impl Target {
    /// A measured signal prepared for comparison; `run_s` are first and last output of the run.
    ///
    /// # Errors
    /// No common time, missing values, samples that cannot be filtered, nothing in the signal.
    pub fn new(
        channel: Channel,
        filter: Filter,
        weight: f64,
        (mut measured, shift_s): (Pair, f64),
        window_s: [Option<f64>; 2],
        run_s: [f64; 2],
        misfit: Misfit,
    ) -> Result<Target, String> {
        let class = filter.class_of(&channel.name);
        if let Some(class) = class {
            let filtered = measured.filter(class, FAMILY);
            filtered.map_err(Failure::words)?;
        }
        measured.time_s.iter_mut().for_each(|t| *t += shift_s);
        let theirs = Track { time_s: &measured.time_s, values: &measured.values };
        let ours = Track { time_s: &run_s, values: &[0.0; 2] };
        let window = Window { from_s: window_s[0], to_s: window_s[1], shift_s: 0.0 };
        let [from_s, to_s] = overlap(ours, theirs, window)?;
        let samples = whole_steps(to_s - from_s, 1.0 / RATE_HZ) + 1;
        if samples as f64 > RATE_HZ * 100.0 {
            return Err(format!("{} s to compare: at most 100 s", to_s - from_s));
        }
        let reference = sampled(theirs, from_s, to_s, samples, "the measured signal")?;
        let itself = misfit.of(&reference, &reference, 1.0 / RATE_HZ);
        itself.map_err(|e| e.to_string())?;
        Ok(Target { channel, class, filter, weight, measured, window_s: [from_s, to_s], reference })
    }

    /// The median time between the samples of the measured signal, s.
    pub fn interval_s(&self) -> f64 {
        let pairs = self.measured.time_s.windows(2).map(|pair| pair[1] - pair[0]);
        median(&pairs.collect::<Vec<_>>()).unwrap_or(f64::INFINITY)
    }

    /// Computed values on the grid of the measured ones, with the corrections of the test.
    ///
    /// # Errors
    /// Histories without this channel, or with values missing in the window.
    pub fn computed(&self, histories: &Histories, test: Correction) -> Result<Vec<f64>, String> {
        let found = histories.columns.iter().find(|c| c.channel.name == self.channel.name);
        let column = found.ok_or_else(|| format!("no time history of {}", self.channel.name))?;
        let [from_s, to_s] = self.window_s.map(|t| t + test.offset_s);
        let track = Track { time_s: &histories.time_s, values: &column.values };
        let mut values = sampled(track, from_s, to_s, self.reference.len(), "the computed history")?;
        values.iter_mut().for_each(|v| *v *= test.gain);
        Ok(values)
    }

    /// Misfit of computed values.
    ///
    /// # Errors
    /// Values that cannot be compared.
    pub fn misfit(&self, misfit: Misfit, computed: &[f64]) -> Result<f64, String> {
        let found = misfit.of(&self.reference, computed, 1.0 / RATE_HZ);
        found.map_err(|e| format!("{}: {e}", self.channel.name))
    }
}
