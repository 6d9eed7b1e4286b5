//! Forces on the contact spheres and the surfaces that they touch (report, "Output", items 5 and 6).

use occupant_units::unit::Unit::{Metre, MetrePerSecond, Newton, One};

use crate::quantity::{Axes, Kind, Owner, Quantity, Take, Value, values};
use crate::results::sample::{Contact, Sample};

/// A contact sphere, by its index.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfSphere;

impl Owner for OfSphere {
    type At<'a> = (&'a Sample<'a>, usize);
}

type Of = Quantity<OfSphere>;

/// Message `SphereLoad`.
pub(super) const QUANTITIES: &[Of] = &[
    Of::vector(Metre, Axes::Vehicle, |(s, i)| s.sphere_centre_m(*i).coords)
        .channel("position", "centre of the {}")
        .field(2, "centre", "centre"),
    Of::vector(Newton, Axes::Vehicle, |(s, i)| s.sphere_force_n(*i))
        .channel("force", "all contact forces on the {}, belts apart")
        .field(3, "contact_force", "sum of contact and friction forces, belts apart (item 5)")
        .resultant(4, "contact_force", "its magnitude"),
    Of::vector(Newton, Axes::Vehicle, |(s, i)| s.pull_n(*i, |pull| pull.of == "belt"))
        .channel("belt_force", "belt forces on the {}")
        .field(5, "belt_force", "sum of the forces of belts"),
    Of::number(Metre, |(s, i)| s.penetration_m(*i)).channel("penetration", "largest contact penetration of the {}"),
    Of::perhaps(Metre, Axes::Segment, |(s, i)| s.application_point_m(*i)).field(
        6,
        "application_point",
        "where the contact force acts, from the centre; absent without contact (item 6, which asks it for head, chest and pelvis)",
    ),
    Of::new(One, Axes::None, Take::Parts("occupant.Touch", |at| touches(at))).field(7, "touches", "surfaces touched, one by one (item 5)"),
];

/// Forces of bags on a sphere, if there are any.
pub(super) const OF_BAGS: &[Of] = &[Of::vector(Newton, Axes::Vehicle, |(s, i)| s.pull_n(*i, |pull| pull.of == "bag"))
    .channel("bag_force", "bag forces on the {}")
    .field(8, "bag_force", "sum of the forces of bags")];

fn touches<'a>((s, i): &(&'a Sample<'a>, usize)) -> Vec<Vec<(u32, Value)>> {
    s.contacts().filter(|c| c.sphere == *i).map(|c| values(TOUCH, &(*s, c))).collect()
}

/// A sphere and a surface in contact.
#[derive(Clone, Copy, Debug)]
struct OfTouch;

impl Owner for OfTouch {
    type At<'a> = (&'a Sample<'a>, Contact);
}

type Part = Quantity<OfTouch>;

/// Message `Touch` within `SphereLoad`.
const TOUCH: &[Part] = &[
    Part::new(
        One,
        Axes::None,
        Take::Text(|(s, c)| s.model.setup().surface_name(c.surface).unwrap_or_default().to_owned()),
    )
    .field(1, "surface", ""),
    Part::number(Metre, |(_, c)| c.depth_m).field(2, "depth", ""),
    Part::number(Newton, |(_, c)| c.normal_force_n).field(3, "normal_force", ""),
    Part::vector(Newton, Axes::Vehicle, |(_, c)| c.force_n).field(4, "force", ""),
    Part::vector(Newton, Axes::Vehicle, |(_, c)| c.friction_n).field(5, "friction", ""),
    Part::vector(Metre, Axes::Vehicle, |(_, c)| c.point_m.coords).field(6, "point", ""),
    Part::number(MetrePerSecond, |(_, c)| c.slip_m_s).field(7, "slip", ""),
    Part::vector(Newton, Axes::Vehicle, |(_, c)| c.edge_n).field(8, "edge_force", ""),
    Part::vector(Metre, Axes::Vehicle, |(_, c)| c.edge_point_m.coords).field(9, "edge_point", ""),
];

/// Number, name and type of the fields of the message `Touch`.
pub fn touch() -> Vec<(u32, String, Kind)> {
    TOUCH.iter().filter_map(|q| q.field.map(|words| (words.number, q.field_name(words.stem), q.kind()))).collect()
}
