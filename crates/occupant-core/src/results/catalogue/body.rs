//! Place and motion of the segments (report, "Output", items 1 to 4), the dummy's load cells, the report's coordinates.

use nalgebra::Vector3;
use occupant_units::unit::Unit::{
    Metre, MetrePerSecond, MetrePerSecondSquared, Newton, NewtonMetre, One, RadianPerSecond, RadianPerSecondSquared,
};

use crate::body::tree::{Landmarks, Segment};
use crate::kernel::instruments;
use crate::quantity::{Axes, Owner, Quantity, Take, to_j211};
use crate::results::reaction::{Reaction, carried_by_mount, mount_load, tibia_load};
use crate::results::sample::Sample;

/// A segment.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfSegment;

impl Owner for OfSegment {
    type At<'a> = (&'a Sample<'a>, Segment);
}

type Of = Quantity<OfSegment>;

/// Message `SegmentState`.
pub(super) const SEGMENT: &[Of] = &[
    Of::vector(MetrePerSecondSquared, Axes::Segment, |(s, n)| s.specific_force_m_s2(*n))
        .channel(
            "acceleration",
            "accelerometer reading (acceleration minus gravity) at the centre of gravity of the {}",
        )
        .field(7, "accelerometer", "accelerometer reading: the same minus gravity (item 2)")
        .resultant(8, "accelerometer", "magnitude of the accelerometer's reading"),
    Of::vector(MetrePerSecondSquared, Axes::Segment, |(s, n)| s.cg_acceleration_m_s2(*n))
        .channel("kinematic_acceleration", "kinematic acceleration of the centre of gravity of the {}")
        .field(6, "cg_acceleration", "kinematic acceleration of the centre of gravity (item 2)"),
    Of::vector(RadianPerSecond, Axes::Segment, |(s, n)| s.angular_velocity_rad_s(*n))
        .channel("angular_velocity", "absolute angular velocity of the {}")
        .field(10, "angular_velocity", "angular velocity in space, along the segment's axes (item 4)"),
    Of::vector(RadianPerSecondSquared, Axes::Segment, |(s, n)| s.angular_acceleration_rad_s2(*n))
        .channel("angular_acceleration", "angular acceleration of the {}")
        .field(9, "angular_acceleration", "angular acceleration in space, along the segment's axes (item 3)"),
    Of::vector(MetrePerSecond, Axes::Vehicle, |(s, n)| s.vehicle.vector_to_frame(s.cg_velocity_m_s(*n)))
        .channel("velocity", "absolute velocity of the centre of gravity of the {}"),
    Of::vector(Metre, Axes::Vehicle, |(s, n)| s.cg_m(*n).coords)
        .channel("position", "position of the centre of gravity of the {}")
        .field(4, "cg", "centre of gravity"),
    Of::vector(Metre, Axes::Vehicle, |(s, n)| s.end_points_m(*n)[0].coords).field(2, "upper_end", "upper end (item 1)"),
    Of::vector(Metre, Axes::Vehicle, |(s, n)| s.end_points_m(*n)[1].coords).field(
        3,
        "lower_end",
        "lower end; the far end of a limb (item 1)",
    ),
    Of::new(One, Axes::Vehicle, Take::Rotation(|(s, n)| s.orientation(*n))).field(
        5,
        "orientation_in",
        "turns segment axes into vehicle axes",
    ),
    Of::vector(MetrePerSecond, Axes::Space, |(s, n)| s.cg_velocity_m_s(*n)).field(
        11,
        "cg_velocity",
        "velocity of the centre of gravity",
    ),
];

/// A body with its instruments.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfBody;

impl Owner for OfBody {
    type At<'a> = Sample<'a>;
}

type Instrument = Quantity<OfBody>;

/// Message `Instruments`: readings of a dummy's load cells.
pub(super) fn of_dummy(marks: &Landmarks) -> impl Iterator<Item = Instrument> {
    let femurs = marks.legs.right.map(|_| RIGHT_FEMUR).into_iter().chain(marks.legs.left.map(|_| LEFT_FEMUR));
    let legs = [(marks.legs.right, RIGHT_TIBIA), (marks.legs.left, LEFT_TIBIA)].into_iter();
    let tibiae = legs.filter(|(leg, _)| leg.is_some_and(|leg| leg.end.is_some())).flat_map(|(_, own)| own);
    marks.neck.map(|_| NECK).into_iter().flatten().chain(femurs).chain(tibiae)
}

/// Message `MountLoad`, of a body on a mount.
pub(super) const MOUNT: &[Instrument] = &[
    Instrument::vector(Newton, Axes::J211, |s| to_j211(at_mount(s).force_n))
        .channel("mount.force", "force of the mount on the segment that it holds, along that segment's SAE J211 axes")
        .field(2, "force", "force on the segment that is held, along its SAE J211 axes"),
    Instrument::vector(NewtonMetre, Axes::J211, |s| to_j211(at_mount(s).moment_n_m))
        .channel("mount.moment", "moment of the mount on the segment that it holds, at the point where it holds it")
        .field(3, "moment", "moment on the segment that is held, at the point where it is held"),
    Instrument::vector(Newton, Axes::J211, |s| to_j211(carried(s).force_n))
        .channel("mount.carried_force", "force of the mounted segment on everything that it carries: mount.force without the share of the segment's own mass and contacts")
        .field(4, "carried_force", "force of the segment that is held on all that it carries, without its own mass and contacts"),
    Instrument::vector(NewtonMetre, Axes::J211, |s| to_j211(carried(s).moment_n_m))
        .channel("mount.carried_moment", "moment of the mounted segment on everything that it carries, at the mounting point: mount.moment without the share of the segment's own mass and contacts")
        .field(5, "carried_moment", "moment of the segment that is held on all that it carries, at the point where it is held"),
];

fn at_mount(s: &Sample<'_>) -> Reaction {
    mount_load(s).unwrap_or(NONE)
}

fn carried(s: &Sample<'_>) -> Reaction {
    carried_by_mount(s).unwrap_or(NONE)
}

const NONE: Reaction = {
    let none = Vector3::new(f64::NAN, f64::NAN, f64::NAN);
    Reaction { force_n: none, moment_n_m: none }
};

/// Three readings of the instruments of a body.
fn read(s: &Sample<'_>, from: usize) -> Vector3<f64> {
    Vector3::from_column_slice(&s.readings[s.of][from..from + 3])
}

const NECK: [Instrument; 2] = [
    Instrument::vector(Newton, Axes::J211, |s| read(s, instruments::NECK))
        .channel(
            "neck.force",
            "upper neck force on the head at its joint: +x shear that pushes the head forward, +z tension",
        )
        .field(2, "neck_force", "upper neck force on the head at its joint, SAE J211 axes: +z tension"),
    Instrument::vector(NewtonMetre, Axes::J211, |s| read(s, instruments::NECK + 3))
        .channel("neck.moment", "upper neck moment on the head at the condyles (at its joint where the body has none): +y in flexion")
        .field(3, "neck_moment", "upper neck moment on the head at the condyles (at its joint where the body has none), SAE J211 axes: +y flexion"),
];
const RIGHT_FEMUR: Instrument = Instrument::number(Newton, |s| s.readings[s.of][instruments::FEMURS])
    .channel("right_femur.axial", FEMUR)
    .field(4, "right_femur_axial", "axial force at the knee end of the right thigh, tension positive");
const LEFT_FEMUR: Instrument = Instrument::number(Newton, |s| s.readings[s.of][instruments::FEMURS + 1])
    .channel("left_femur.axial", FEMUR)
    .field(5, "left_femur_axial", "axial force at the knee end of the left thigh, tension positive");

const RIGHT_TIBIA: [Instrument; 4] = [
    tibia_force(|s| tibia(s, 0)).channel("right_tibia.upper.force", UPPER).field(6, "right_tibia_upper_force", UPPER),
    tibia_moment(|s| tibia_turn(s, 0)).channel("right_tibia.upper.moment", TURN).field(
        7,
        "right_tibia_upper_moment",
        TURN,
    ),
    tibia_force(|s| tibia(s, 1)).channel("right_tibia.lower.force", LOWER).field(8, "right_tibia_lower_force", LOWER),
    tibia_moment(|s| tibia_turn(s, 1)).channel("right_tibia.lower.moment", TURN).field(
        9,
        "right_tibia_lower_moment",
        TURN,
    ),
];
const LEFT_TIBIA: [Instrument; 4] = [
    tibia_force(|s| tibia(s, 2)).channel("left_tibia.upper.force", UPPER).field(10, "left_tibia_upper_force", UPPER),
    tibia_moment(|s| tibia_turn(s, 2)).channel("left_tibia.upper.moment", TURN).field(
        11,
        "left_tibia_upper_moment",
        TURN,
    ),
    tibia_force(|s| tibia(s, 3)).channel("left_tibia.lower.force", LOWER).field(12, "left_tibia_lower_force", LOWER),
    tibia_moment(|s| tibia_turn(s, 3)).channel("left_tibia.lower.moment", TURN).field(
        13,
        "left_tibia_lower_moment",
        TURN,
    ),
];

const UPPER: &str =
    "force of the leg below on the leg above, a quarter of the shank below the knee, SAE J211 axes: +z tension";
const LOWER: &str =
    "force of the leg below on the leg above, a quarter of the shank above the ankle, SAE J211 axes: +z tension";
const TURN: &str =
    "moment of the leg below on the leg above at the place of that force, SAE J211 axes: +y pushes the foot forward";

const fn tibia_force(of: fn(&Sample<'_>) -> Vector3<f64>) -> Instrument {
    Instrument::vector(Newton, Axes::J211, of)
}

const fn tibia_moment(of: fn(&Sample<'_>) -> Vector3<f64>) -> Instrument {
    Instrument::vector(NewtonMetre, Axes::J211, of)
}

fn tibia(s: &Sample<'_>, site: usize) -> Vector3<f64> {
    tibia_load(s, site)[0]
}

fn tibia_turn(s: &Sample<'_>, site: usize) -> Vector3<f64> {
    tibia_load(s, site)[1]
}

const FEMUR: &str = "axial force at the knee end of the thigh, tension positive";

/// Message `ReportCoordinates`, on request.
pub(super) const REPORT_COORDINATES: &[Instrument] = &[
    Instrument::new(One, Axes::None, Take::Numbers(|s| s.report_coordinates().map_or_else(Vec::new, |c| c.q.to_vec())))
        .field(2, "q_m_or_rad", "q1 to q31 in the report's order: q1 to q3 in m, the angles in rad"),
    Instrument::new(
        One,
        Axes::None,
        Take::Numbers(|s| s.report_coordinates().map_or_else(Vec::new, |c| c.rates.to_vec())),
    )
    .field(3, "q_rate_m_s_or_rad_s", "their rates"),
];
