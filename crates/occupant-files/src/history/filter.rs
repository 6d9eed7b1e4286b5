//! The filter class of a channel.

use std::str::FromStr;

use crash_measures::signal::{CfcFamily, ChannelClass, SignalError, filter_cfc};

/// The requested filter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filter {
    /// No filter.
    None,
    /// One class for all channels.
    Class(ChannelClass),
    /// The SAE J211 class of each channel's quantity.
    J211,
}

/// Coefficients of the filter classes: names on the command line, names elsewhere.
pub const FAMILIES: [(&str, &str, CfcFamily); 2] =
    [("iso6487", "ISO 6487", CfcFamily::Iso6487), ("sae-j211", "SAE J211", CfcFamily::SaeJ211)];

/// Name of a family of filter coefficients.
pub fn family_name(family: CfcFamily) -> &'static str {
    FAMILIES.iter().find(|row| row.2 == family).map_or("", |row| row.1)
}

impl FromStr for Filter {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let word = text.trim().to_ascii_lowercase();
        match word.as_str() {
            "none" => return Ok(Filter::None),
            "j211" => return Ok(Filter::J211),
            _ => {}
        }
        let number = word.strip_prefix("cfc").unwrap_or(&word).trim();
        let class = number.parse().ok().and_then(ChannelClass::from_number);
        class.map(Filter::Class).ok_or_else(|| "expected CFC60, CFC180, CFC600, CFC1000, j211 or none".to_owned())
    }
}

impl Filter {
    /// Class of a channel; none if it stays unfiltered.
    pub fn class_of(self, channel: &str) -> Option<ChannelClass> {
        match self {
            Filter::None => None,
            Filter::Class(class) => Some(class),
            Filter::J211 => j211_class(channel),
        }
    }

    /// Description.
    pub fn words(self) -> String {
        match self {
            Filter::None => "none".to_owned(),
            Filter::Class(class) => format!("CFC {}", class.hertz()),
            Filter::J211 => "the SAE J211 class of each channel".to_owned(),
        }
    }
}

/// The class of a channel's quantity, as crash test programs apply SAE J211: head 1000, chest 180, pelvis 1000, neck and
/// femurs and tibiae 600, belts and vehicle acceleration 60, angular velocity of the head 60, of each occupant. It gives none to what no transducer of a
/// dummy measures (contact forces, joint loads, angles, energies); pelvis, belts and vehicle are common practice and not
/// read in the standard.
fn j211_class(channel: &str) -> Option<ChannelClass> {
    use ChannelClass::*;
    let words: Vec<&str> = channel.split('.').collect();
    match words.as_slice() {
        [.., "head" | "lower_torso", "acceleration", _] => Some(Cfc1000),
        [.., "upper_torso" | "middle_torso", "acceleration", _] => Some(Cfc180),
        [.., "neck", "force" | "moment", _] => Some(Cfc600),
        [.., "right_femur" | "left_femur", "axial"] => Some(Cfc600),
        [.., "right_tibia" | "left_tibia", _, "force" | "moment", _] => Some(Cfc600),
        ["belt" | "strap", .., "force"] | ["vehicle", .., "acceleration", _] => Some(Cfc60),
        [.., "head", "angular_velocity", _] => Some(Cfc60),
        _ => None,
    }
}

/// A filtered channel, with a remark if its samples are sparser than SAE J211 requires.
///
/// # Errors
/// Samples too far apart for the class, or not finite.
pub fn filtered(values: &[f64], dt_s: f64, class: ChannelClass, family: CfcFamily) -> Result<Vec<f64>, String> {
    filter_cfc(values, dt_s, class, family).map_err(|error| match error {
        SignalError::CornerAboveNyquist { corner_hz, .. } => format!(
            "CFC {} needs more than {:.0} samples per second (SAE J211 asks for {:.0}); there are {:.0} per second",
            class.hertz(),
            2.0 * corner_hz,
            10.0 * class.hertz(),
            1.0 / dt_s
        ),
        other => other.to_string(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_are_read_in_any_case_and_refused_in_words() {
        assert_eq!("CFC180".parse(), Ok(Filter::Class(ChannelClass::Cfc180)));
        assert_eq!("cfc 1000".parse(), Ok(Filter::Class(ChannelClass::Cfc1000)));
        assert_eq!("60".parse(), Ok(Filter::Class(ChannelClass::Cfc60)));
        assert_eq!("J211".parse(), Ok(Filter::J211));
        assert!("CFC100".parse::<Filter>().is_err() && "".parse::<Filter>().is_err());
    }

    #[test]
    fn j211_gives_classes_to_what_transducers_measure() {
        let class = |name| Filter::J211.class_of(name);
        assert_eq!(class("head.acceleration.resultant"), Some(ChannelClass::Cfc1000));
        assert_eq!(class("upper_torso.acceleration.x"), Some(ChannelClass::Cfc180));
        assert_eq!(class("belt.lap.force"), Some(ChannelClass::Cfc60));
        assert_eq!(class("strap.driver.belt.d_ring_shoulder.force"), Some(ChannelClass::Cfc60));
        assert_eq!(class("left_femur.axial"), Some(ChannelClass::Cfc600));
        assert_eq!(class("passenger.left_tibia.upper.moment.y"), Some(ChannelClass::Cfc600));
        assert_eq!(class("passenger.upper_torso.acceleration.x"), Some(ChannelClass::Cfc180));
        assert_eq!(class("vehicle.acceleration.x"), class("vehicle.other.acceleration.x"));
        assert_eq!(class("vehicle.other.acceleration.x"), Some(ChannelClass::Cfc60));
        assert_eq!(class("energy.kinetic"), None);
        assert_eq!(class("sphere.head.force.x"), None);
    }
}
