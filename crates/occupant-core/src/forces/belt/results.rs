//! What a belt contributes to the results (report, "Output", item 7).

use crash_measures::unit::Unit::{Joule, Metre, Newton, Radian};

use super::law::BeltAction;
use crate::quantity::{Axes, Owner, Quantity};

impl Owner for BeltAction<f64> {
    type At<'a> = BeltAction<f64>;
}

type Of = Quantity<BeltAction<f64>>;

/// Message `BeltState`.
pub const QUANTITIES: &[Of] = &[
    Of::number(Newton, |b| b.loop_force).channel("force", "loop force of the {}").field(
        2,
        "loop_force",
        "force in the webbing (item 7)",
    ),
    Of::number(Metre, |b| b.elongation).channel("elongation", "elongation of the {}").field(
        5,
        "elongation",
        "length less the unstretched length; negative in slack",
    ),
    Of::vector(Newton, Axes::Vehicle, |b| b.force.to_vector())
        .channel("body_force", "force on the body of the {}")
        .field(3, "restraining_force", "force on the sphere, at its centre (item 7)")
        .resultant(4, "restraining_force", "its magnitude"),
    Of::number(Metre, |b| b.length).field(6, "length", "length round the body"),
    Of::number(Radian, |b| b.wrap).field(
        7,
        "wrap",
        "angle over which the belt lies on the sphere; 0 or less: off the body",
    ),
    Of::number(Joule, |b| b.stored).field(8, "stored", "recoverable energy"),
];
