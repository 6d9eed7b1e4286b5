//! What only some bodies and tests read: deflections of the chest, load cells of side dummies, instruments of whiplash tests,
//! lower legs.

use crate::signal::ChannelClass::{self, Cfc60, Cfc180, Cfc600, Cfc1000};
use occupant_units::unit::Unit;
use std::fmt;

/// A signal recorded by some bodies and tests only. Deflections are positive inward; forces, moments and accelerations
/// have the signs of SAE J1733.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Special {
    /// Deflection of the sternum, m.
    ChestDeflection,
    /// Deflection of a point of the chest, m.
    ChestPoint(ChestPoint),
    /// Deflection of a chest rib in side impact, m: 0 is the upper one, 2 the lower one.
    Rib(u8),
    /// Deflection of an abdominal rib in side impact, m: 0 is the upper one.
    AbdomenRib(u8),
    /// Force of a load cell of the abdomen, N: front, middle, rear.
    Abdomen(u8),
    /// Lateral force of the shoulder, N.
    Shoulder,
    /// Force of the pubic symphysis, N.
    Pubic,
    /// Force of a load cell of the pelvis of a SID-IIs, N: acetabulum, ilium.
    Pelvis(u8),
    /// Acceleration of the lower spine (T12) along X, Y, Z, m/s².
    LowerSpine(u8),
    /// Forward acceleration of T1, m/s².
    T1,
    /// Force between head and head restraint, N.
    HeadRestraint,
    /// Forward speed of the head relative to the vehicle, m/s.
    HeadSpeed,
    /// Forward position of the pelvis relative to the seat, m.
    PelvisPlace,
    /// Force of the lower neck along X, Y, Z, N.
    LowerNeckForce(u8),
    /// Moment of the lower neck about X, Y, N·m.
    LowerNeckMoment(u8),
    /// A load measured in a lower leg.
    Tibia(TibiaSite, TibiaLoad),
}

/// A measuring point of a THOR's chest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ChestPoint {
    /// Upper left.
    UpperLeft,
    /// Upper right.
    UpperRight,
    /// Lower left.
    LowerLeft,
    /// Lower right.
    LowerRight,
}

/// A load cell of the lower legs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TibiaSite {
    /// Right, below the knee.
    RightUpper,
    /// Right, above the ankle.
    RightLower,
    /// Left, below the knee.
    LeftUpper,
    /// Left, above the ankle.
    LeftLower,
}

/// Quantity measured by a load cell of a lower leg.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TibiaLoad {
    /// Moment about X, N·m.
    MomentX,
    /// Moment about Y, N·m.
    MomentY,
    /// Axial force, N: tension positive.
    ForceZ,
}

use ChestPoint::{LowerLeft, LowerRight, UpperLeft, UpperRight};
use TibiaLoad::{ForceZ, MomentX, MomentY};
use TibiaSite::{LeftLower, LeftUpper, RightLower, RightUpper};

impl ChestPoint {
    /// All four: upper left and right, lower left and right.
    pub const ALL: [Self; 4] = [UpperLeft, UpperRight, LowerLeft, LowerRight];
}

impl TibiaSite {
    /// All four.
    pub const ALL: [Self; 4] = [RightUpper, RightLower, LeftUpper, LeftLower];
}

impl Special {
    /// Every signal.
    pub fn all() -> impl Iterator<Item = Self> {
        let several = |most: u8, of: fn(u8) -> Self| (0..most).map(of);
        let legs = TibiaSite::ALL.into_iter();
        [Self::ChestDeflection]
            .into_iter()
            .chain(ChestPoint::ALL.into_iter().map(Self::ChestPoint))
            .chain(several(3, Self::Rib))
            .chain(several(2, Self::AbdomenRib))
            .chain(several(3, Self::Abdomen))
            .chain([Self::Shoulder, Self::Pubic])
            .chain(several(2, Self::Pelvis))
            .chain(several(3, Self::LowerSpine))
            .chain([Self::T1, Self::HeadRestraint, Self::HeadSpeed, Self::PelvisPlace])
            .chain(several(3, Self::LowerNeckForce))
            .chain(several(2, Self::LowerNeckMoment))
            .chain(legs.flat_map(|site| [MomentX, MomentY, ForceZ].map(|load| Self::Tibia(site, load))))
    }

    /// Its unit.
    #[must_use]
    pub fn unit(self) -> Unit {
        match self {
            Self::ChestDeflection | Self::ChestPoint(_) | Self::Rib(_) | Self::AbdomenRib(_) | Self::PelvisPlace => {
                Unit::Metre
            }
            Self::LowerSpine(_) | Self::T1 => Unit::MetrePerSecondSquared,
            Self::HeadSpeed => Unit::MetrePerSecond,
            Self::LowerNeckMoment(_) | Self::Tibia(_, MomentX | MomentY) => Unit::NewtonMetre,
            _ => Unit::Newton,
        }
    }

    /// The filter class of SAE J211 as its criterion uses it.
    #[must_use]
    pub fn class(self) -> ChannelClass {
        match self {
            Self::ChestDeflection | Self::ChestPoint(_) | Self::Rib(_) | Self::AbdomenRib(_) | Self::LowerSpine(_) => {
                Cfc180
            }
            Self::T1 | Self::HeadSpeed | Self::PelvisPlace => Cfc60,
            Self::LowerNeckForce(_) => Cfc1000,
            _ => Cfc600,
        }
    }
}

impl fmt::Display for Special {
    /// Its name, such as `chest.upper_left.deflection`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let axis = |i: u8| ["x", "y", "z"].get(usize::from(i)).copied().unwrap_or("?");
        let cell = |names: [&'static str; 3], i: u8| names.get(usize::from(i)).copied().unwrap_or("?");
        match *self {
            Self::ChestDeflection => f.write_str("chest.deflection"),
            Self::ChestPoint(point) => {
                let name = ["upper_left", "upper_right", "lower_left", "lower_right"][point as usize];
                write!(f, "chest.{name}.deflection")
            }
            Self::Rib(i) => write!(f, "rib_{}.deflection", u32::from(i) + 1),
            Self::AbdomenRib(i) => write!(f, "abdomen_rib_{}.deflection", u32::from(i) + 1),
            Self::Abdomen(i) => write!(f, "abdomen.{}.force", cell(["front", "middle", "rear"], i)),
            Self::Shoulder => f.write_str("shoulder.force"),
            Self::Pubic => f.write_str("pubic.force"),
            Self::Pelvis(i) => write!(f, "pelvis.{}.force", cell(["acetabulum", "ilium", "?"], i)),
            Self::LowerSpine(i) => write!(f, "lower_spine.acceleration.{}", axis(i)),
            Self::T1 => f.write_str("t1.acceleration.x"),
            Self::HeadRestraint => f.write_str("head_restraint.force"),
            Self::HeadSpeed => f.write_str("head.speed_in_vehicle.x"),
            Self::PelvisPlace => f.write_str("pelvis.place_in_seat.x"),
            Self::LowerNeckForce(i) => write!(f, "lower_neck.force.{}", axis(i)),
            Self::LowerNeckMoment(i) => write!(f, "lower_neck.moment.{}", axis(i)),
            Self::Tibia(site, load) => {
                let site =
                    ["right_tibia.upper", "right_tibia.lower", "left_tibia.upper", "left_tibia.lower"][site as usize];
                write!(f, "{site}.{}", ["moment.x", "moment.y", "force.z"][load as usize])
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_signal_has_a_name_of_its_own() {
        let names: BTreeSet<String> = Special::all().map(|which| which.to_string()).collect();
        assert_eq!((names.len(), Special::all().count()), (41, 41));
        assert!(names.iter().all(|name| !name.contains('?')), "{names:?}");
    }
}
