//! `[car]`: the keys of a car in words. What they come to, [`crate::car`] writes in the words of the other sections.

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::quantity::{NOT_NEGATIVE, POSITIVE};
use super::three_point::Side;
use super::{Angle, Force, Length, Moment, Ratio, Stiffness, Time};

/// A class of cars.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum CarClass {
    /// A supermini.
    Small,
    /// A family car.
    #[default]
    Sedan,
    /// A sport utility vehicle.
    Suv,
    /// A van with up to three rows.
    Van,
    /// A pickup.
    Pickup,
    /// A seat on a sled, with belts and a foot rest and nothing else.
    Sled,
}

/// The inside of a car in words: seats, belts, bags, wheel, panel and shell of a class, and what of them is measured. It is written out
/// as solids, belts and the rest, and what the scenario says of those is laid over it. The origin is the design H-point of the front
/// seats (SAE J1100) in the car's middle plane: H30 over the driver's heel, x ahead, y right, z down.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CarSection {
    /// Class that gives all distances not said; "sedan" if absent.
    pub(crate) class: Option<CarClass>,
    /// The side of the steering wheel; "left" if absent.
    pub(crate) drive: Option<Side>,
    /// Height of the front H-point over the heels, H30.
    pub(crate) seat_height: Option<Length<POSITIVE>>,
    /// Front H-point from the middle plane, W20.
    pub(crate) seat_offset: Option<Length<POSITIVE>>,
    /// From the H-point of one row to that of the next, L50.
    pub(crate) couple: Option<Length<POSITIVE>>,
    /// Between the doors at the height of the shoulders, W3.
    pub(crate) shoulder_room: Option<Length<POSITIVE>>,
    /// Roof over the front H-point.
    pub(crate) roof: Option<Length<POSITIVE>>,
    /// Whether a console stands between the front seats; not in vans and pickups if absent, else it does.
    pub(crate) console: Option<bool>,
    /// Steering wheel.
    #[serde(default)]
    pub(crate) wheel: WheelSection,
    /// Instrument panel and knee bolster.
    #[serde(default)]
    pub(crate) panel: PanelSection,
    /// Air bags.
    #[serde(default)]
    pub(crate) bags: CarBagsSection,
    /// Sides that come in.
    #[serde(default)]
    pub(crate) intrusion: IntrusionsSection,
    /// Seats: "driver", "passenger", "rear_left", "rear_middle", "rear_right", "third_left", "third_middle", "third_right". Those in
    /// which somebody sits are there without being named.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) seats: IndexMap<String, CarSeatSection>,
}

/// The steering wheel, seen from the driver's design H-point.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct WheelSection {
    /// Centre of the rim ahead of the H-point.
    pub(crate) ahead: Option<Length<POSITIVE>>,
    /// Centre of the rim above the H-point, H17 - H30.
    pub(crate) above: Option<Length>,
    /// Its plane from the vertical, A18.
    pub(crate) angle: Option<Angle<NOT_NEGATIVE>>,
    /// Diameter, W9.
    pub(crate) diameter: Option<Length<POSITIVE>>,
    /// Force at which the column gives way; 2.5 kN if absent.
    pub(crate) column_force: Option<Force<POSITIVE>>,
    /// How far the column gives way; 100 mm if absent.
    pub(crate) column_stroke: Option<Length<POSITIVE>>,
}

/// Panel and knee bolster, seen from the front H-point.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PanelSection {
    /// Face of the panel before the passenger's chest, ahead of the H-point.
    pub(crate) ahead: Option<Length<POSITIVE>>,
    /// Top of the panel above the H-point.
    pub(crate) above: Option<Length>,
    /// Face of the knee bolster ahead of the H-point, at the height of the knees.
    pub(crate) bolster: Option<Length<POSITIVE>>,
    /// Stiffness of the bolster before one knee; 40 kN/m if absent.
    pub(crate) bolster_stiffness: Option<Stiffness<POSITIVE>>,
}

/// Air bags. All their numbers are made up: no measured inflator may be shipped.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CarBagsSection {
    /// Bag in the steering wheel; true if absent.
    pub(crate) driver: Option<bool>,
    /// Bag in the panel before a front passenger; true if absent.
    pub(crate) passenger: Option<bool>,
    /// From the crash sensor to firing; 9 ms if absent.
    pub(crate) delay: Option<Time<NOT_NEGATIVE>>,
    /// Factor on the area of the vents; 1 if absent.
    pub(crate) vent: Option<Ratio<POSITIVE>>,
}

/// Sides that come in, as what the car struck or was struck by pushes them. Pillars and roof stay.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct IntrusionsSection {
    /// The left door.
    pub(crate) left: Option<IntrusionSection>,
    /// The right door.
    pub(crate) right: Option<IntrusionSection>,
    /// Toe board, knee bolster and panel.
    pub(crate) front: Option<IntrusionSection>,
}

/// How far something comes in, and when: its speed rises evenly in the first fifth of the time and falls evenly in the rest, so that at most
/// it is twice the mean.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct IntrusionSection {
    /// How far it comes in for good.
    pub(crate) depth: Length<POSITIVE>,
    /// When it begins; 5 ms if absent.
    pub(crate) begins: Option<Time<NOT_NEGATIVE>>,
    /// How long it takes; 60 ms if absent.
    pub(crate) lasts: Option<Time<POSITIVE>>,
}

/// What holds somebody in a seat.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum CarBelt {
    /// A lap and shoulder belt on a retractor.
    #[default]
    ThreePoint,
    /// A lap belt.
    Lap,
    /// None, or one that is not worn.
    None,
}

/// A seat of a car.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CarSeatSection {
    /// How far it stands behind its design place; of the driver's seat, if absent, by the driver's stature (SAE J4004), else 0.
    pub(crate) track: Option<Length>,
    /// How far it stands above its design place; 0 if absent.
    pub(crate) height: Option<Length>,
    /// Lean of its back from the vertical; 20° in front and 24° behind if absent.
    pub(crate) recline: Option<Angle<NOT_NEGATIVE>>,
    /// Lateral place of its middle; by class if absent.
    pub(crate) y: Option<Length>,
    /// Moment about its recliner at which the back yields, such as 1.5 kN·m; it stays upright if absent.
    pub(crate) back_moment: Option<Moment<POSITIVE>>,
    /// Factor on the stiffness of its foam; 1 if absent.
    pub(crate) foam: Option<Ratio<POSITIVE>>,
    /// Height of a booster cushion for a child on it; none if absent.
    pub(crate) booster: Option<Length<POSITIVE>>,
    /// Head restraint behind the head of an average man, the backset; 50 mm if absent.
    pub(crate) head_gap: Option<Length<NOT_NEGATIVE>>,
    /// Top of the head restraint over the H-point along the back; 0.80 m if absent.
    pub(crate) head_height: Option<Length<POSITIVE>>,
    /// Belt; "three_point" if absent.
    pub(crate) belt: Option<CarBelt>,
    /// Force at which the belt's limiter pays out; 3 kN if absent.
    pub(crate) limiter: Option<Force<POSITIVE>>,
    /// Webbing that the pretensioner pulls in, 0 without one; 100 mm in front and 0 behind if absent.
    pub(crate) pretensioner: Option<Length<NOT_NEGATIVE>>,
    /// Webbing that a locked retractor still gives, the film on its spool; 30 mm if absent.
    pub(crate) film: Option<Length<POSITIVE>>,
    /// Loose webbing: a pretensioner takes it up first; what is left the belt gives before it holds. 0 if absent.
    pub(crate) slack: Option<Length<NOT_NEGATIVE>>,
    /// Upper anchor of the belt from the H-point.
    #[serde(default)]
    pub(crate) d_ring: AnchorSection,
    /// Buckle from the H-point; `outboard` is negative, towards the middle of the seat's inner side.
    #[serde(default)]
    pub(crate) buckle: AnchorSection,
    /// Outer lap anchor from the H-point.
    #[serde(default)]
    pub(crate) anchor: AnchorSection,
}

/// A place of a belt, seen from the seat's H-point.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct AnchorSection {
    /// Behind it.
    pub(crate) behind: Option<Length>,
    /// Outboard of it.
    pub(crate) outboard: Option<Length>,
    /// Above it.
    pub(crate) above: Option<Length>,
}
