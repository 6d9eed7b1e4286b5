//! Excursion of the head.

use serde::ser::{Serialize, SerializeMap, Serializer};

use super::Peak;

/// Largest displacements of the centre of the head sphere since the start, vehicle axes, m; at least 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excursion {
    /// Forward, +X_v.
    pub forward: Peak,
    /// Rearward, −X_v.
    pub rearward: Peak,
    /// To the left, −Y_v.
    pub left: Peak,
    /// To the right, +Y_v.
    pub right: Peak,
    /// Upward, −Z_v.
    pub up: Peak,
    /// Downward, +Z_v.
    pub down: Peak,
}

impl Excursion {
    /// Nothing seen yet.
    pub(super) const NONE: Excursion = {
        let none = Peak::NONE;
        Excursion { forward: none, rearward: none, left: none, right: none, up: none, down: none }
    };

    /// All by name.
    pub fn ways(&self) -> [(&'static str, Peak); 6] {
        let Excursion { forward, rearward, left, right, up, down } = *self;
        [("forward", forward), ("rearward", rearward), ("left", left), ("right", right), ("up", up), ("down", down)]
    }
}

/// As `forward_m`, `forward_time_s` and so on.
impl Serialize for Excursion {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        for (way, peak) in self.ways() {
            map.serialize_entry(&format!("{way}_m"), &peak.value)?;
            map.serialize_entry(&format!("{way}_time_s"), &peak.time_s)?;
        }
        map.end()
    }
}
