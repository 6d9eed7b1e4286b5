//! `[car]`: the keys of a car in words. What they come to, [`crate::car`] writes in the words of the other sections.

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::quantity::{NOT_NEGATIVE, POSITIVE};
use super::three_point::Side;
use super::{Angle, Force, Length, Moment, Ratio, Stiffness, Time};

/// Name of an expanded car in messages.
pub(crate) const CAR_TITLE: &str = "car";

/// Class of a car.
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
    /// A seat on a sled, with belts and a foot rest only.
    Sled,
}

/// When a car was built: what of belts, bags and head restraints it has by default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) enum CarYears {
    /// Up to about 1985: belts without limiter and pretensioner, no air bags.
    #[serde(rename = "1970s")]
    Seventies,
    /// Front air bags, the same belts.
    #[serde(rename = "1990s")]
    Nineties,
    /// Limiters and pretensioners in front, head restraints of before 2009.
    #[serde(rename = "2000s")]
    TwoThousands,
    /// From about 2009 on.
    #[default]
    #[serde(rename = "present")]
    Present,
}

/// The interior of a car: seats, belts, air bags, steering wheel, panel and body shell of a class, with your own measurements. It is
/// expanded to solids, belts and other sections, which your own entries override. The origin is on the centreline at the design
/// H-point of the front seats (SAE J1100): H30 above the driver's heel, x forward, y right, z down.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CarSection {
    /// Vehicle class, which gives all dimensions that are absent; "sedan" if absent.
    pub(crate) class: Option<CarClass>,
    /// When it was built: "1970s", "1990s", "2000s" or "present", which gives all belts, bags and head restraints that
    /// are absent; "present" if absent.
    pub(crate) years: Option<CarYears>,
    /// The side of the steering wheel; "left" if absent.
    pub(crate) drive: Option<Side>,
    /// Height of the front H-point above the heels, H30.
    pub(crate) seat_height: Option<Length<POSITIVE>>,
    /// Lateral distance of the front H-point from the centreline, W20.
    pub(crate) seat_offset: Option<Length<POSITIVE>>,
    /// Distance between the H-points of two seat rows, L50.
    pub(crate) couple: Option<Length<POSITIVE>>,
    /// Width between the doors at shoulder height, W3.
    pub(crate) shoulder_room: Option<Length<POSITIVE>>,
    /// Height of the roof above the front H-point.
    pub(crate) roof: Option<Length<POSITIVE>>,
    /// True: a console between the front seats. If absent, true except in vans and pickups.
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
    /// Intrusion of doors and front.
    #[serde(default)]
    pub(crate) intrusion: IntrusionsSection,
    /// Seats: "driver", "passenger", "rear_left", "rear_middle", "rear_right", "third_left", "third_middle",
    /// "third_right". An occupied seat exists without being named here.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) seats: IndexMap<String, CarSeatSection>,
}

/// The steering wheel, measured from the driver's design H-point.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct WheelSection {
    /// Distance of the wheel centre ahead of the H-point.
    pub(crate) ahead: Option<Length<POSITIVE>>,
    /// Height of the wheel centre above the H-point, H17 - H30.
    pub(crate) above: Option<Length>,
    /// Angle of its plane from the vertical, A18.
    pub(crate) angle: Option<Angle<NOT_NEGATIVE>>,
    /// Diameter, W9.
    pub(crate) diameter: Option<Length<POSITIVE>>,
    /// Force at which the column collapses; 2.5 kN if absent.
    pub(crate) column_force: Option<Force<POSITIVE>>,
    /// Stroke of the column; 100 mm if absent.
    pub(crate) column_stroke: Option<Length<POSITIVE>>,
}

/// Instrument panel and knee bolster, measured from the front H-point.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PanelSection {
    /// Distance of the panel's face, in front of the passenger's chest, ahead of the H-point.
    pub(crate) ahead: Option<Length<POSITIVE>>,
    /// Height of the panel's top above the H-point.
    pub(crate) above: Option<Length>,
    /// Distance of the knee bolster's face ahead of the H-point, at knee height.
    pub(crate) bolster: Option<Length<POSITIVE>>,
    /// Stiffness of the bolster under one knee; by years if absent, 40 kN/m at present.
    pub(crate) bolster_stiffness: Option<Stiffness<POSITIVE>>,
}

/// Air bags. All their values are estimates, because no measured inflator may be shipped.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CarBagsSection {
    /// True: an air bag in the steering wheel. By years if absent, true at present.
    pub(crate) driver: Option<bool>,
    /// True: an air bag in the panel for a front passenger. By years if absent, true at present.
    pub(crate) passenger: Option<bool>,
    /// Curtain air bags in front of the side windows; "none" if absent. An impact on their side fires them.
    pub(crate) curtain: Option<CarSides>,
    /// Side air bags in the outer bolsters of occupied seats beside a door; "none" if absent. An impact on their side fires them.
    pub(crate) side: Option<CarSides>,
    /// Time from the crash sensor to firing; 9 ms for front bags and 4 ms for curtains and side bags if absent.
    pub(crate) delay: Option<Time<NOT_NEGATIVE>>,
    /// Factor on the area of the vents; 1 if absent.
    pub(crate) vent: Option<Ratio<POSITIVE>>,
}

/// Sides of a car.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum CarSides {
    /// Neither.
    #[default]
    None,
    /// The left one.
    Left,
    /// The right one.
    Right,
    /// Both.
    Both,
}

impl CarSides {
    /// Those of either.
    pub(crate) fn with(self, other: CarSides) -> CarSides {
        match (self, other) {
            (CarSides::None, one) | (one, CarSides::None) => one,
            (one, other) if one == other => one,
            _ => CarSides::Both,
        }
    }

    /// Their names and directions.
    pub(crate) fn each(self) -> impl Iterator<Item = (&'static str, f64)> {
        let left = matches!(self, CarSides::Left | CarSides::Both).then_some(("left", -1.0));
        let right = matches!(self, CarSides::Right | CarSides::Both).then_some(("right", 1.0));
        left.into_iter().chain(right)
    }
}

/// Intrusion of the compartment by the collision partner. Pillars and roof stay in place.
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

/// Depth and time of an intrusion. Its speed rises linearly during the first fifth of the time and falls linearly
/// during the rest, with a peak of twice the mean.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct IntrusionSection {
    /// Final intrusion.
    pub(crate) depth: Length<POSITIVE>,
    /// Start time; 5 ms if absent.
    pub(crate) begins: Option<Time<NOT_NEGATIVE>>,
    /// Duration; 60 ms if absent.
    pub(crate) lasts: Option<Time<POSITIVE>>,
}

/// The belt of a seat.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum CarBelt {
    /// A lap and shoulder belt on a retractor.
    #[default]
    ThreePoint,
    /// The same with retractor and D-ring in the seat's back, which leans, slides and yields with them; buckle and lap anchor stand on
    /// the seat's base.
    Seat,
    /// A lap belt.
    Lap,
    /// No belt, or a belt that is not worn.
    None,
}

/// A seat of a car.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CarSeatSection {
    /// Distance behind its design position. If absent, by stature for a person who drives (SAE J4004), -120 mm for a small
    /// female dummy in front (FMVSS 208), else 0.
    pub(crate) track: Option<Length>,
    /// Height above its design position; 0 if absent.
    pub(crate) height: Option<Length>,
    /// Angle of its back from the vertical, A40; 20° in front and 24° in the rear if absent.
    pub(crate) recline: Option<Angle<NOT_NEGATIVE>>,
    /// Lateral position of its centre; by class if absent.
    pub(crate) y: Option<Length>,
    /// Moment at which its recliner yields, such as 1.5 kN·m. If absent, that of its years under who sits in front, before the present
    /// and with two people at most; 3.75 kN·m with `belt = "seat"`; else the back is fixed.
    pub(crate) back_moment: Option<Moment<POSITIVE>>,
    /// Factor on the stiffness of its foam; 1 if absent.
    pub(crate) foam: Option<Ratio<POSITIVE>>,
    /// Height of a child's booster cushion; none if absent.
    pub(crate) booster: Option<Length<POSITIVE>>,
    /// Backset: distance of the head restraint behind an average man's head; by model year if absent, 50 mm at present.
    pub(crate) head_gap: Option<Length<NOT_NEGATIVE>>,
    /// Height of the head restraint's top above the H-point, along the back; by years if absent, 0.80 m at present.
    pub(crate) head_height: Option<Length<POSITIVE>>,
    /// Belt type; "three_point" if absent.
    pub(crate) belt: Option<CarBelt>,
    /// Force of the belt's load limiter; by years if absent: 3 kN at present, none before 2000.
    pub(crate) limiter: Option<Force<POSITIVE>>,
    /// Webbing that the pretensioner pulls in, 0 without one; by years if absent: 100 mm in front and 0 in the rear at present, none before
    /// 2000.
    pub(crate) pretensioner: Option<Length<NOT_NEGATIVE>>,
    /// Film spool-out: webbing paid out by a locked retractor; 30 mm if absent.
    pub(crate) film: Option<Length<POSITIVE>>,
    /// Slack of the belt. A pretensioner takes it up first. 0 if absent.
    pub(crate) slack: Option<Length<NOT_NEGATIVE>>,
    /// True: the tongue clamps the webbing, and none passes from the shoulder to the lap; false if absent.
    pub(crate) locking_tongue: Option<bool>,
    /// Height of the lap belt above its usual position on the pelvis; negative is below; 0 if absent.
    pub(crate) lap_above: Option<Length>,
    /// Upper anchor (D-ring) of the belt, from the H-point. If absent it is on the pillar, in line with the seat's
    /// design position; with `belt = "seat"` it is at the upper outer corner of the back.
    #[serde(default)]
    pub(crate) d_ring: AnchorSection,
    /// Buckle, from the H-point; `outboard` is negative, towards the inner side.
    #[serde(default)]
    pub(crate) buckle: AnchorSection,
    /// Outer lap anchor, from the H-point.
    #[serde(default)]
    pub(crate) anchor: AnchorSection,
}

/// A point of a belt, measured from the seat's H-point.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct AnchorSection {
    /// Distance behind it.
    pub(crate) behind: Option<Length>,
    /// Distance outboard of it.
    pub(crate) outboard: Option<Length>,
    /// Distance above it.
    pub(crate) above: Option<Length>,
}
