//! The kinds of quantity in a scenario: their names and notation, the meaning of bare numbers in each unit system, and
//! the conversion to SI units.

use occupant_units::unit::{Dimension, Scale, Unit, UnitError, parse, parse_heading};
use serde::{Deserialize, Serialize};

use placed_text::Value;

/// Units of bare numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
pub enum UnitSystem {
    /// Metre, kilogram, second; angles in degrees.
    #[default]
    #[serde(rename = "si")]
    Si,
    /// Inch, pound-force, second; mass in lbf·s²/in; angles in degrees.
    #[serde(rename = "in-lbf-s")]
    InchPound,
}

impl UnitSystem {
    /// Metres in one unit of length.
    pub const fn length_m(self) -> f64 {
        match self {
            UnitSystem::Si => 1.0,
            UnitSystem::InchPound => 0.0254,
        }
    }
}

/// A kind of quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kind {
    /// Name, as it appears in the schema.
    pub name: &'static str,
    /// With its article, for messages.
    pub noun: &'static str,
    /// Its SI unit.
    pub unit: Unit,
    /// Permitted notation.
    pub example: &'static str,
}

const fn kind(name: &'static str, noun: &'static str, unit: Unit, example: &'static str) -> Kind {
    Kind { name, noun, unit, example }
}

/// Index of "length" in [`KINDS`]; the names below likewise.
pub const LENGTH: usize = 0;
/// Time.
pub const TIME: usize = 1;
/// Plane angle.
pub const ANGLE: usize = 2;
/// Speed.
pub const SPEED: usize = 3;
/// Acceleration.
pub const ACCELERATION: usize = 4;
/// Angular velocity.
pub const ANGULAR_VELOCITY: usize = 5;
/// Mass.
pub const MASS: usize = 6;
/// Force.
pub(crate) const FORCE: usize = 7;
/// Moment of inertia.
pub(crate) const INERTIA: usize = 8;
/// Stiffness, force per length.
pub(crate) const STIFFNESS: usize = 9;
/// Rotational stiffness, torque per angle.
pub(crate) const ROTATIONAL_STIFFNESS: usize = 10;
/// Rotational damping, torque per angular velocity.
pub(crate) const ROTATIONAL_DAMPING: usize = 11;
/// Plain number.
pub const RATIO: usize = 12;
/// Moment of a force.
pub(crate) const MOMENT: usize = 13;
/// Moment per angle squared.
pub(crate) const MOMENT_PER_ANGLE_2: usize = 14;
/// Moment per angle cubed.
pub(crate) const MOMENT_PER_ANGLE_3: usize = 15;

/// Area.
pub(crate) const AREA: usize = 16;
/// Volume.
pub(crate) const VOLUME: usize = 17;
/// Pressure.
pub(crate) const PRESSURE: usize = 18;
/// Temperature.
pub(crate) const TEMPERATURE: usize = 19;
/// Mass flow.
pub(crate) const MASS_FLOW: usize = 20;
/// Molar mass.
pub(crate) const MOLAR_MASS: usize = 21;
/// Specific heat.
pub(crate) const SPECIFIC_HEAT: usize = 22;
/// Specific heat per kelvin.
pub(crate) const SPECIFIC_HEAT_SLOPE: usize = 23;
/// Heat transfer.
pub(crate) const HEAT_TRANSFER: usize = 24;
/// Frequency.
pub const FREQUENCY: usize = 25;
/// Damping, force per speed.
pub(crate) const DAMPING: usize = 26;
/// Damping by the square of speed.
pub(crate) const QUADRATIC_DAMPING: usize = 27;
/// Energy.
pub(crate) const ENERGY: usize = 28;

/// All kinds.
#[rustfmt::skip]
pub const KINDS: [Kind; 29] = [
    kind("length", "a length", Unit::Metre, "0.3, \"12 in\", \"305 mm\""),
    kind("time", "a time", Unit::Second, "0.08, \"80 ms\""),
    kind("angle", "an angle", Unit::Radian, "15, \"15 deg\", \"0.26 rad\""),
    kind("speed", "a speed", Unit::MetrePerSecond, "8.9, \"20 mph\", \"32 km/h\""),
    kind("acceleration", "an acceleration", Unit::MetrePerSecondSquared, "9.81, \"17.9 g\", \"386.04 in/s^2\""),
    kind("angular velocity", "an angular velocity", Unit::RadianPerSecond, "30, \"30 deg/s\", \"0.5 rad/s\""),
    kind("mass", "a mass", Unit::Kilogram, "5.2, \"5.2 kg\", \"11.55 lb\""),
    kind("force", "a force", Unit::Newton, "51, \"51 N\", \"11.55 lbf\""),
    kind("moment of inertia", "a moment of inertia", Unit::KilogramMetreSquared, "0.03, \"0.03 kg m^2\", \"0.27 lbf in s^2\""),
    kind("stiffness", "a stiffness", Unit::NewtonPerMetre, "8400, \"8.4 kN/m\", \"48 lbf/in\""),
    kind("rotational stiffness", "a rotational stiffness", Unit::NewtonMetrePerRadian, "113, \"113 N m/rad\", \"1000 in lbf/rad\""),
    kind("rotational damping", "a rotational damping", Unit::NewtonMetreSecondPerRadian, "0.65, \"5.73 in·lbf·s/rad\", \"0.1 in lbf s/deg\""),
    kind("ratio", "a plain number", Unit::One, "0.5, \"50 %\""),
    kind("moment", "a moment", Unit::NewtonMetre, "12, \"12 N m\", \"100 in lbf\""),
    kind("moment per angle squared", "a moment per angle squared", Unit::NewtonMetrePerRadianSquared, "371, \"371 N m/rad^2\", \"1 in lbf/deg^2\""),
    kind("moment per angle cubed", "a moment per angle cubed", Unit::NewtonMetrePerRadianCubed, "100, \"100 N m/rad^3\", \"0.01 in lbf/deg^3\""),
    kind("area", "an area", Unit::MetreSquared, "0.0025, \"25 cm^2\", \"3.9 in^2\""),
    kind("volume", "a volume", Unit::MetreCubed, "0.06, \"60 l\", \"3660 in^3\""),
    kind("pressure", "a pressure", Unit::Pascal, "5000, \"5 kPa\", \"0.73 psi\""),
    kind("temperature", "a temperature above absolute zero", Unit::Kelvin, "293, \"293 K\""),
    kind("mass flow", "a mass flow", Unit::KilogramPerSecond, "2.2, \"2.2 kg/s\""),
    kind("molar mass", "a molar mass", Unit::KilogramPerMole, "0.033, \"33 kg/kmol\""),
    kind("specific heat", "a specific heat", Unit::JoulePerKilogramKelvin, "1070, \"1070 J/(kg K)\""),
    kind("specific heat per kelvin", "a specific heat per kelvin", Unit::JoulePerKilogramKelvinSquared, "0.2, \"0.2 J/(kg K^2)\""),
    kind("heat transfer", "a heat transfer", Unit::WattPerMetreSquaredKelvin, "50, \"50 W/(m^2 K)\""),
    kind("frequency", "a frequency", Unit::Hertz, "15, \"15 Hz\""),
    kind("damping", "a damping", Unit::NewtonSecondPerMetre, "640, \"640 N s/m\""),
    kind("quadratic damping", "a damping by the square of speed", Unit::NewtonSecondSquaredPerMetreSquared, "116, \"116 N s^2/m^2\""),
    kind("energy", "an energy", Unit::Joule, "20, \"20 J\", \"177 in lbf\""),
];

impl Kind {
    /// The kind with this name.
    pub(super) fn named(name: &str) -> Option<&'static Kind> {
        KINDS.iter().find(|k| k.name == name)
    }

    /// The unit of a bare number: that of the system, except degrees for angles; empty for plain numbers.
    pub const fn bare_unit(&self, units: UnitSystem) -> &'static str {
        match (self.unit, units) {
            (Unit::Radian, _) => "deg",
            (Unit::RadianPerSecond, _) => "deg/s",
            (unit, UnitSystem::Si) => unit.expression(),
            (unit, UnitSystem::InchPound) => unit.inch_pound(),
        }
    }

    /// Its name and notation, for messages.
    pub(crate) fn expected(&self) -> String {
        format!("{}: {}", self.noun, self.example)
    }

    /// A value as a number in SI units, angles in radians.
    ///
    /// # Errors
    /// No number, no number with a unit of this kind, or a number that is not finite.
    pub fn si(&self, written: &Value, units: UnitSystem) -> Result<f64, UnitError> {
        if let Value::String(text) = written {
            return self.text_si(text);
        }
        let Some(value) = written.number() else {
            let found = format!("{} instead of {}", written.kind(), self.noun);
            return Err(whole("", found, self.expected()));
        };
        let unit = self.bare_unit(units);
        let factor = if unit.is_empty() { 1.0 } else { parse(unit, 0)?.factor };
        finite(value * factor, &value.to_string())
    }

    /// A number of a command's flag: bare in SI units, angles in degrees, or with its unit.
    ///
    /// # Errors
    /// As [`Kind::si`].
    pub fn read(&self, text: &str) -> Result<f64, UnitError> {
        let written = text.trim().parse().map_or_else(|_| Value::String(text.to_owned()), Value::Float);
        self.si(&written, UnitSystem::Si)
    }

    /// Reads `"48 lbf/in"` and the like.
    fn text_si(&self, text: &str) -> Result<f64, UnitError> {
        let whole = |found: String, hint: Option<String>| UnitError { hint, ..whole(text, found, self.expected()) };
        let (number, start) =
            split_number(text).ok_or_else(|| whole(format!("`{text}` does not start with a number"), None))?;
        let unit_text = text[start..].trim_end();
        if unit_text.is_empty() {
            let hint = format!("write {} without quotes", plain(text.trim()));
            return Err(whole(format!("a number without unit in quotes, `{text}`"), Some(hint)));
        }
        if unit_text.starts_with(',') {
            let hint = "decimals are written with a point".to_owned();
            return Err(whole(format!("a comma in the number `{text}`"), Some(hint)));
        }
        let scale = parse(unit_text, start)?;
        if !self.is_measured_in(scale) {
            let found = format!("`{unit_text}` is not the unit of {}", self.noun);
            let hint = self.pound_hint(number, unit_text, scale);
            return Err(UnitError { start, end: start + unit_text.len(), ..whole(found, hint) });
        }
        finite(number * scale.factor, text)
    }

    fn dimension(&self) -> Dimension {
        self.unit.dimension()
    }

    fn is_measured_in(&self, scale: Scale) -> bool {
        scale.dimension.serves_as(self.dimension())
    }

    /// SI units in one of the unit in brackets after the name of a column, `x[mm]`.
    ///
    /// # Errors
    /// No unit, an invalid unit, or a unit of another quantity. Positions are those of the unit's text.
    pub fn column_factor(&self, name: &str, unit: Option<&str>) -> Result<f64, UnitError> {
        let expected =
            format!("the unit of {} in brackets, such as `{name}[{}]`", self.noun, self.bare_unit(UnitSystem::Si));
        let Some(unit) = unit else { return Err(whole(name, format!("column `{name}` without a unit"), expected)) };
        match parse_heading(unit) {
            Ok(scale) if self.is_measured_in(scale) => Ok(scale.factor),
            Ok(_) => Err(whole(unit, format!("`{unit}` is not the unit of {}", self.noun), expected)),
            Err(error) => Err(UnitError { expected, ..error }),
        }
    }

    /// The usual mistake: pounds of mass for pounds of force, or the reverse.
    fn pound_hint(&self, number: f64, unit_text: &str, scale: Scale) -> Option<String> {
        if self.unit == Unit::One || scale.dimension == self.dimension() {
            return None;
        }
        let slips = [("lbf", "lb", "mass"), ("lb", "lbf", "force"), ("lbs", "lbf", "force")];
        slips.into_iter().find_map(|(wrong, right, what)| {
            let swapped: String = words(unit_text).map(|w| if w == wrong { right } else { w }).collect();
            let fits = parse(&swapped, 0).is_ok_and(|s| self.is_measured_in(s));
            fits.then(|| format!("the pound of {what} is `{right}`: \"{number} {swapped}\""))
        })
    }
}

fn finite(value: f64, text: &str) -> Result<f64, UnitError> {
    if value.is_finite() {
        return Ok(value);
    }
    Err(whole(text, format!("`{text}` is not finite"), "a finite number".into()))
}

/// An error about a whole text.
fn whole(text: &str, found: String, expected: String) -> UnitError {
    UnitError::new(0, text.len(), found, expected)
}

/// The number at the start of a text, and where its unit starts.
pub(super) fn split_number(text: &str) -> Option<(f64, usize)> {
    let start = text.len() - text.trim_start().len();
    let body = &text[start..];
    let (sign, body_start) = match body.chars().next()? {
        '-' => (-1.0, 1),
        '−' => (-1.0, '−'.len_utf8()),
        '+' => (1.0, 1),
        _ => (1.0, 0),
    };
    let digits = &body[body_start..];
    let bytes = digits.as_bytes();
    let run = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let mut length = run(0);
    if bytes.get(length) == Some(&b'.') {
        length += 1 + run(length + 1);
    }
    if matches!(bytes.get(length), Some(b'e' | b'E')) {
        let signed = usize::from(matches!(bytes.get(length + 1), Some(b'-' | b'+')));
        let exponent = run((length + 1 + signed).min(bytes.len()));
        if exponent > 0 {
            length += 1 + signed + exponent;
        }
    }
    let value: f64 = digits[..length].parse().ok()?;
    let unit = &digits[length..];
    let blanks = unit.len() - unit.trim_start().len();
    Some((sign * value, start + body_start + length + blanks))
}

/// Splits into runs of letters and single other characters.
fn words(text: &str) -> impl Iterator<Item = &str> {
    let mut rest = text;
    std::iter::from_fn(move || {
        let first = rest.chars().next()?;
        let length = if first.is_alphabetic() {
            rest.find(|c: char| !c.is_alphabetic()).unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        let (word, tail) = rest.split_at(length);
        rest = tail;
        Some(word)
    })
}
/// The digits of a number in TOML's form: with digits on both sides of the point.
fn plain(digits: &str) -> String {
    let (sign, digits) = match digits.strip_prefix(['-', '+']) {
        Some(rest) => (&digits[..1], rest),
        None => ("", digits),
    };
    let begun = if digits.starts_with('.') { format!("0{digits}") } else { digits.to_owned() };
    let ended =
        if begun.ends_with('.') { format!("{begun}0") } else { begun.replace(".e", ".0e").replace(".E", ".0E") };
    format!("{sign}{ended}")
}
