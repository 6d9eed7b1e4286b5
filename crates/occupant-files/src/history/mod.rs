//! Time histories taken from a run: chosen by name, filtered, resampled, in the units asked for.
//!
//! Exports, plots and comparisons are made of these. Everything is SI until it is shown.
//! Opens no file: results come to it open.

mod filter;
mod load;

use crash_measures::signal::ChannelClass;
use occupant_core::quantity::Axes;
use occupant_core::results::channel::Channel;
use occupant_units::unit::{Shown, Unit};

pub use filter::{FAMILIES, Filter, family_name, filtered};
pub use load::{Treatment, Untreated, asked, choose, load, treated};

/// Channels of one run over common times.
#[derive(Clone, Debug)]
pub struct Histories {
    /// Times, s.
    pub time_s: Vec<f64>,
    /// The channels in the requested order.
    pub columns: Vec<Column>,
    /// Remarks on the processing.
    pub notes: Vec<String>,
}

impl Histories {
    /// Whether every channel has a value for each time.
    ///
    /// # Errors
    /// The first that has not, as text.
    pub fn check(&self) -> Result<(), String> {
        let count = self.time_s.len();
        match self.columns.iter().find(|column| column.values.len() != count) {
            Some(odd) => {
                let (found, name) = (odd.values.len(), &odd.channel.name);
                Err(format!("{found} values of {name} at {count} times; expected one for each"))
            }
            None => Ok(()),
        }
    }
}

/// One channel of a run.
#[derive(Clone, Debug)]
pub struct Column {
    /// The channel.
    pub channel: Channel,
    /// Filter class applied.
    pub class: Option<ChannelClass>,
    /// Values in the channel's SI unit, one per time.
    pub values: Vec<f64>,
}

/// `CFC 180`, or `none`.
pub fn class_name(class: Option<ChannelClass>) -> String {
    class.map_or_else(|| "none".to_owned(), |c| format!("CFC {}", c.hertz()))
}

/// Choice of units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum UnitChoice {
    /// Metre, second, newton
    Si,
    /// As si, but accelerations in g (9.80665 m/s²)
    G,
    /// Inch, pound-force, second
    #[cfg_attr(feature = "clap", value(name = "in-lbf-s", alias = "inch-pound"))]
    InchPound,
}

impl UnitChoice {
    /// Name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            UnitChoice::Si => "si",
            UnitChoice::G => "g",
            UnitChoice::InchPound => "in-lbf-s",
        }
    }
}

/// Axes of quantities that belong to a segment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum AxisChoice {
    /// X ahead, Y left, Z up, of who stands upright
    #[default]
    Segment,
    /// SAE J211: X ahead, Y right, Z down
    J211,
}

impl AxisChoice {
    /// Axes of a channel, and the sign to multiply its values by.
    pub fn of(self, channel: &Channel) -> (Axes, f64) {
        if self == AxisChoice::Segment || channel.axes != Axes::Segment {
            return (channel.axes, 1.0);
        }
        let is_across = [".y", ".z"].iter().any(|end| channel.name.ends_with(end));
        (Axes::J211, if is_across { -1.0 } else { 1.0 })
    }

    /// The histories converted to these axes.
    pub fn turned(self, mut histories: Histories) -> Histories {
        for column in &mut histories.columns {
            let (axes, sign) = self.of(&column.channel);
            column.channel.axes = axes;
            column.values.iter_mut().for_each(|value| *value *= sign);
        }
        histories
    }
}

/// The unit for a channel's values; angles in radians.
pub fn shown(unit: Unit, choice: UnitChoice) -> Shown {
    match (unit, choice) {
        (Unit::MetrePerSecondSquared, UnitChoice::G) => unit.shown_in("g"),
        (_, UnitChoice::InchPound) => unit.shown_in_inch_pound(),
        _ => unit.shown(),
    }
}

/// The unit for a plot: as [`shown`], but angles in degrees and times in milliseconds.
pub fn plotted(unit: Unit, choice: UnitChoice) -> Shown {
    match unit {
        Unit::Radian => unit.shown_in("deg"),
        Unit::Second => unit.shown_in("ms"),
        _ => shown(unit, choice),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use occupant_units::unit::parse;

    /// The names in headings are read back by the reader of unit expressions, as the same size and dimension.
    #[test]
    fn every_unit_reads_back() {
        use Unit::*;
        let dynamic = [Metre, MetrePerSecond, MetrePerSecondSquared, Newton, NewtonMetre, Joule, Second];
        for unit in dynamic.into_iter().chain([Radian, RadianPerSecond, RadianPerSecondSquared]) {
            for choice in [UnitChoice::Si, UnitChoice::G, UnitChoice::InchPound] {
                for shown in [shown(unit, choice), plotted(unit, choice)] {
                    let scale = parse(&shown.ascii(), 0).unwrap();
                    assert_eq!((scale.dimension, scale.factor), (unit.dimension(), shown.si), "{}", shown.ascii());
                }
            }
        }
    }
}
