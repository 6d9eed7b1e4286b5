//! The kinds of quantity a scenario can hold: name, dimension, and the unit of a bare number in each unit system.

use serde::{Deserialize, Serialize};

/// Exponents of length, mass, time and angle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dimension {
    /// Length.
    pub length: i32,
    /// Mass.
    pub mass: i32,
    /// Time.
    pub time: i32,
    /// Plane angle, kept apart from plain numbers so that `15` and `15 deg` cannot be confused.
    pub angle: i32,
}

impl Dimension {
    /// A dimension from its four exponents.
    pub const fn new(length: i32, mass: i32, time: i32, angle: i32) -> Self {
        Dimension { length, mass, time, angle }
    }

    /// Whether a value of dimension `self` may stand where `wanted` is expected.
    ///
    /// The radian of "per radian" may be left out, as in `5.73 in·lbf·s` for a rotational damper.
    pub fn serves_as(self, wanted: Dimension) -> bool {
        let silent_radian = Dimension { angle: wanted.angle, ..self };
        self == wanted || (wanted.angle < 0 && self.angle == 0 && silent_radian == wanted)
    }
}

/// Which units bare numbers have.
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

/// A kind of quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kind {
    /// Name, as it appears in the schema.
    pub name: &'static str,
    /// With its article, for messages.
    pub noun: &'static str,
    /// Dimension.
    pub dimension: Dimension,
    /// Unit of a bare number under `units = "si"`; empty for plain numbers.
    pub si: &'static str,
    /// Unit of a bare number under `units = "in-lbf-s"`.
    pub inch_pound: &'static str,
    /// How it may be written.
    pub example: &'static str,
}

impl Kind {
    /// The unit of a bare number.
    pub const fn bare_unit(&self, units: UnitSystem) -> &'static str {
        match units {
            UnitSystem::Si => self.si,
            UnitSystem::InchPound => self.inch_pound,
        }
    }
}

const fn kind(
    name: &'static str,
    noun: &'static str,
    exponents: [i32; 4],
    [si, inch_pound]: [&'static str; 2],
    example: &'static str,
) -> Kind {
    let [length, mass, time, angle] = exponents;
    Kind { name, noun, dimension: Dimension::new(length, mass, time, angle), si, inch_pound, example }
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
pub const FORCE: usize = 7;
/// Moment of inertia.
pub const INERTIA: usize = 8;
/// Stiffness, force per length.
pub const STIFFNESS: usize = 9;
/// Rotational stiffness, torque per angle.
pub const ROTATIONAL_STIFFNESS: usize = 10;
/// Rotational damping, torque per angular velocity.
pub const ROTATIONAL_DAMPING: usize = 11;
/// Plain number.
pub const RATIO: usize = 12;

/// All kinds. Exponents are those of length, mass, time, angle.
#[rustfmt::skip]
pub const KINDS: [Kind; 13] = [
    kind("length", "a length", [1, 0, 0, 0], ["m", "in"], "0.3, \"12 in\", \"305 mm\""),
    kind("time", "a time", [0, 0, 1, 0], ["s", "s"], "0.08, \"80 ms\""),
    kind("angle", "an angle", [0, 0, 0, 1], ["deg", "deg"], "15, \"15 deg\", \"0.26 rad\""),
    kind("speed", "a speed", [1, 0, -1, 0], ["m/s", "in/s"], "8.9, \"20 mph\", \"32 km/h\""),
    kind("acceleration", "an acceleration", [1, 0, -2, 0], ["m/s^2", "in/s^2"], "9.81, \"17.9 g\", \"386.04 in/s^2\""),
    kind("angular velocity", "an angular velocity", [0, 0, -1, 1], ["deg/s", "deg/s"], "30, \"30 deg/s\", \"0.5 rad/s\""),
    kind("mass", "a mass", [0, 1, 0, 0], ["kg", "lbf·s^2/in"], "5.2, \"5.2 kg\", \"11.55 lb\""),
    kind("force", "a force", [1, 1, -2, 0], ["N", "lbf"], "51, \"51 N\", \"11.55 lbf\""),
    kind("moment of inertia", "a moment of inertia", [2, 1, 0, 0], ["kg·m^2", "lbf·in·s^2"], "0.03, \"0.03 kg m^2\", \"0.27 lbf in s^2\""),
    kind("stiffness", "a stiffness", [0, 1, -2, 0], ["N/m", "lbf/in"], "8400, \"8.4 kN/m\", \"48 lbf/in\""),
    kind("rotational stiffness", "a rotational stiffness", [2, 1, -2, -1], ["N·m/rad", "in·lbf/rad"], "113, \"113 N m/rad\", \"1000 in lbf/rad\""),
    kind("rotational damping", "a rotational damping", [2, 1, -1, -1], ["N·m·s/rad", "in·lbf·s/rad"], "0.65, \"5.73 in·lbf·s/rad\", \"0.1 in lbf s/deg\""),
    kind("ratio", "a plain number", [0, 0, 0, 0], ["", ""], "0.5, \"50 %\""),
];
