//! SI units of results.

/// The SI unit of a channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unit {
    /// m.
    Metre,
    /// m/s.
    MetrePerSecond,
    /// m/s².
    MetrePerSecondSquared,
    /// rad.
    Radian,
    /// rad/s.
    RadianPerSecond,
    /// rad/s².
    RadianPerSecondSquared,
    /// N.
    Newton,
    /// N·m.
    NewtonMetre,
    /// J.
    Joule,
    /// s.
    Second,
    /// A number.
    One,
}

impl Unit {
    /// What it measures, in words.
    pub const fn quantity(self) -> &'static str {
        match self {
            Unit::Metre => "length",
            Unit::MetrePerSecond => "velocity",
            Unit::MetrePerSecondSquared => "acceleration",
            Unit::Radian => "angle",
            Unit::RadianPerSecond => "angular velocity",
            Unit::RadianPerSecondSquared => "angular acceleration",
            Unit::Newton => "force",
            Unit::NewtonMetre => "moment",
            Unit::Joule => "energy",
            Unit::Second => "time",
            Unit::One => "number",
        }
    }

    /// Its symbol.
    pub const fn symbol(self) -> &'static str {
        match self {
            Unit::Metre => "m",
            Unit::MetrePerSecond => "m/s",
            Unit::MetrePerSecondSquared => "m/s²",
            Unit::Radian => "rad",
            Unit::RadianPerSecond => "rad/s",
            Unit::RadianPerSecondSquared => "rad/s²",
            Unit::Newton => "N",
            Unit::NewtonMetre => "N·m",
            Unit::Joule => "J",
            Unit::Second => "s",
            Unit::One => "1",
        }
    }
}
