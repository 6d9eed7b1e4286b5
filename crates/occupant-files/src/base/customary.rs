//! Defaults: the channels of plots, of the page and of bands over time, and the figures of studies. Each list is here
//! once, in the order of display.

/// Channels by pattern ([`star`](occupant_core::results::channel::star)), each with the name of its curve, in which `*` is what the star stands
/// for.
pub type Curves = [(&'static str, &'static str)];

/// What the accelerometers of a dummy read.
pub const ACCELERATIONS: &Curves = &[
    ("head.acceleration.resultant", "head"),
    ("upper_torso.acceleration.resultant", "chest"),
    ("lower_torso.acceleration.resultant", "pelvis"),
];
/// Loop forces and tensions of straps.
pub const WEBBING: &Curves = &[("belt.*.force", "*"), ("strap.*.force", "*")];
/// Forces on all contact spheres.
pub const CONTACTS: &Curves = &[("sphere.*.force.resultant", "*")];
/// Forces on those that are loaded most in frontal crashes.
pub const FRONTAL_CONTACTS: &Curves = &[
    ("sphere.head.force.resultant", "head"),
    ("sphere.chest.force.resultant", "chest"),
    ("sphere.right_knee.force.resultant", "right knee"),
    ("sphere.left_knee.force.resultant", "left knee"),
];
/// Force of the neck on the head.
pub const NECK_FORCE: &Curves =
    &[("neck.force.x", "shear x"), ("neck.force.y", "shear y"), ("neck.force.z", "axial z")];
/// Moment of the neck on the head.
pub const NECK_MOMENT: &Curves = &[("neck.moment.x", "x"), ("neck.moment.y", "y, + flexion"), ("neck.moment.z", "z")];
/// Axial forces of the thighs.
pub const FEMURS: &Curves = &[("left_femur.axial", "left"), ("right_femur.axial", "right")];
/// The vehicle's motion.
pub const VEHICLE: &Curves =
    &[("vehicle.acceleration.x", "x"), ("vehicle.acceleration.y", "y"), ("vehicle.acceleration.z", "z")];
/// Where the energy is, or went: first what matters most.
pub const ENERGIES: &Curves = &[
    ("energy.kinetic_relative", "kinetic, relative to the vehicle"),
    ("energy.contacts", "stored in contacts"),
    ("energy.belts", "stored in belts"),
    ("energy.lost_contacts", "lost in contacts"),
    ("energy.lost_friction", "lost in friction"),
    ("energy.lost_joints", "lost in joints"),
    ("energy.lost_belts", "lost in belts"),
    ("energy.spine", "spine springs"),
];
/// The same of one of several bodies.
pub const ENERGIES_OF_BODY: &Curves = &[
    ("energy.kinetic", "kinetic, in space"),
    ("energy.elements", "stored in and lost by force elements"),
    ("energy.vehicle_work", "work of vehicles"),
    ("energy.others_work", "work of other bodies"),
];
/// How far the energies are from a balance.
pub const BALANCE: &Curves = &[("energy.balance", "imbalance")];

/// Patterns of the channels whose bands over time are looked at.
pub const BANDS: [&Curves; 6] = [
    ACCELERATIONS,
    WEBBING,
    FRONTAL_CONTACTS,
    &[("neck.force.resultant", ""), ("neck.moment.resultant", "")],
    &[("right_femur.axial", ""), ("left_femur.axial", "")],
    &[("sphere.head.position.x", ""), ("sphere.head.position.y", ""), ("sphere.head.position.z", "")],
];

/// Patterns of the figures that studies report on, most telling first; the first four exist in rear impacts alone.
pub const FIGURES: [&str; 16] = [
    "nic",
    "nkm",
    "t1_acceleration",
    "head_contact_time",
    "hic15",
    "head.peak",
    "head.three_ms_cumulative",
    "chest.peak",
    "chest_deflection",
    "chest.three_ms_cumulative",
    "pelvis.peak",
    "belts.*.peak",
    "head_excursion.forward",
    "nij",
    "right_femur",
    "left_femur",
];
