//! Forces of surfaces and solids on the bodies, and how deep the bodies are in them.

use occupant_units::unit::Unit::{Metre, Newton};

use crate::forces::contact::surface::Frame;
use crate::quantity::{Axes, Owner, Quantity};
use crate::results::sample::Sample;

/// A surface or, after all surfaces, a solid, by its index, and the frame that carries it.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfSurface;

impl Owner for OfSurface {
    type At<'a> = (&'a Sample<'a>, usize, Frame);
}

type Of = Quantity<OfSurface>;

/// Time histories of a surface on `carrier`; result files have them by contact, with the spheres.
pub(super) fn quantities(carrier: Frame) -> [Of; 2] {
    let axes = if carrier == Frame::Space { Axes::Space } else { Axes::Vehicle };
    [
        Of::vector(Newton, axes, |(s, i, carrier)| s.surface_force_n(*i, *carrier))
            .channel("force", "sum of the contact and friction forces of the {} on all bodies"),
        Of::number(Metre, |(s, i, _)| s.surface_depth_m(*i))
            .channel("depth", "largest deformation where a body is in the {}; 0 without contact"),
    ]
}
