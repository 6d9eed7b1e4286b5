//! Regulations: met or not met. Limits of [`crate::measure::LIMITS`], and those that it lacks.

use super::super::scale::{Criterion, limited, most};
use super::super::{Method, Occupant, Rating, Region, Test, Total, region};
use crate::measure::{Blow, Dummy, Quantity, Rule};

use Dummy::{Es2, Es2Re, HybridIii5F, HybridIii50M, SidIis};

const FMVSS: &str = "NHTSA, 49 CFR 571.208, S6 and S15.3, as of October 2022, as read in pyisomme 1.1.0";
const R94: &str = "UN Regulation 94, as of December 2022, as read in pyisomme 1.1.0";
const R137: &str = "UN Regulation 137, as amended in 2023, as read in pyisomme 1.1.0";
const R95: &str = "UN Regulation 95, as of September 2023, as read in pyisomme 1.1.0";
const F214: &str = "NHTSA, 49 CFR 571.214, S7.2.5, S7.2.6 and S9.2, as of 2007, as read in secondary sources";
const REMARK: &str = "Injury criteria alone: what the regulation asks of the car (doors, fuel, steering wheel, containment) is not in it.";

const FMVSS_208: &[Region] = &[
    region("Head", 0.0, &[limited("HIC15", Quantity::Hic15)]),
    region(
        "Neck",
        0.0,
        &[
            limited("Nij", Quantity::Nij),
            limited("Fz,tension", Quantity::NeckTension),
            limited("Fz,compression", Quantity::NeckCompression),
        ],
    ),
    region(
        "Chest",
        0.0,
        &[
            limited("Chest acceleration, 3 ms", Quantity::ChestThreeMsCumulative),
            limited("Dchest compression", Quantity::ChestDeflection),
        ],
    ),
    region(
        "Femur",
        0.0,
        &[limited("Ffemur, right", Quantity::FemurAxial), limited("Ffemur, left", Quantity::FemurAxial)],
    ),
];
const HEAD_R94: &[Criterion] =
    &[limited("HIC36", Quantity::Hic36), limited("Ares-3ms", Quantity::HeadThreeMsCumulative)];
const NECK_R94: &[Criterion] =
    &[most("Fz,tension over time", 1.0), most("Fx,shear over time", 1.0), most("My,extension", 57.0)];
const CHEST_R94: &[Criterion] =
    &[most("Dchest compression", 42.0), limited("Viscous Criterion", Quantity::ViscousCriterion)];
const FEMUR_R94: &[Criterion] = &[
    limited("Ffemur over time, right", Quantity::FemurDurationUse),
    limited("Ffemur over time, left", Quantity::FemurDurationUse),
];
const LEGS_R94: &[Criterion] = &[
    limited("Itibia, right", Quantity::TibiaIndex),
    limited("Ftibia, right", Quantity::TibiaAxial),
    limited("Itibia, left", Quantity::TibiaIndex),
    limited("Ftibia, left", Quantity::TibiaAxial),
    most("Dknee, right", 15.0),
    most("Dknee, left", 15.0),
];
const REGIONS_R94: &[Region] = &[
    region("Head", 0.0, HEAD_R94),
    region("Neck", 0.0, NECK_R94),
    region("Chest & Abdomen", 0.0, CHEST_R94),
    region("Femur", 0.0, FEMUR_R94),
    region("Legs", 0.0, LEGS_R94),
];
const HEAD_R137: &[Criterion] = HEAD_R94;
const DRIVER_R137: &[Region] = &[
    region("Head", 0.0, HEAD_R137),
    region("Neck", 0.0, &[most("Fz,tension", 3.3), most("Fx,shear", 3.1), most("My,extension", 57.0)]),
    region(
        "Chest & Abdomen",
        0.0,
        &[
            limited("Dchest compression", Quantity::ChestDeflection),
            limited("Viscous Criterion", Quantity::ViscousCriterion),
        ],
    ),
    region("Femur", 0.0, &[most("Ffemur, right", 9.07), most("Ffemur, left", 9.07)]),
];
const PASSENGER_R137: &[Region] = &[
    region("Head", 0.0, HEAD_R137),
    region("Neck", 0.0, &[most("Fz,tension", 2.9), most("Fx,shear", 2.9), most("My,extension", 57.0)]),
    region(
        "Chest & Abdomen",
        0.0,
        &[most("Dchest compression", 34.0), limited("Viscous Criterion", Quantity::ViscousCriterion)],
    ),
    region("Femur", 0.0, &[most("Ffemur, right", 7.0), most("Ffemur, left", 7.0)]),
];
const REGIONS_R95: &[Region] = &[
    region("Head", 0.0, &[limited("HIC36", Quantity::Hic36)]),
    region(
        "Chest",
        0.0,
        &[
            limited("Rib deflection", Quantity::RibDeflection),
            limited("Rib viscous criterion", Quantity::RibViscousCriterion),
        ],
    ),
    region("Abdomen", 0.0, &[limited("Fabdomen", Quantity::AbdomenForce)]),
    region("Pelvis", 0.0, &[limited("Fpubic symphysis", Quantity::PubicForce)]),
];
const ES_2RE_214: &[Region] = &[
    region("Head", 0.0, &[limited("HIC36", Quantity::Hic36)]),
    region("Chest", 0.0, &[limited("Rib deflection", Quantity::RibDeflection)]),
    region("Abdomen", 0.0, &[limited("Fabdomen", Quantity::AbdomenForce)]),
    region("Pelvis", 0.0, &[limited("Fpubic symphysis", Quantity::PubicForce)]),
];
const SID_IIS_214: &[Region] = &[
    region("Head", 0.0, &[limited("HIC36", Quantity::Hic36)]),
    region("Lower spine", 0.0, &[limited("Lower spine, peak", Quantity::LowerSpinePeak)]),
    region("Pelvis", 0.0, &[limited("Facetabulum and ilium", Quantity::PelvisForce)]),
];

const fn occupant(seat: &'static str, dummy: Dummy, label: &'static str, regions: &'static [Region]) -> Occupant {
    Occupant { case: "", seat, label, dummy: Some(dummy), regions }
}

const fn rating(
    (name, title, source): (&'static str, &'static str, &'static str),
    rule: Rule,
    blow: Blow,
    tests: &'static [Test],
) -> Rating {
    Rating { name, title, source, remark: REMARK, blow, method: Method::Limits(rule), tests }
}

/// The regulations.
pub(super) const RATINGS: [Rating; 5] = [
    rating(
        ("fmvss-208", "FMVSS 208, 2022, frontal, adult dummies", FMVSS),
        Rule::Fmvss208,
        Blow::Front,
        &[Test {
            name: "frontal barrier",
            occupants: &[
                occupant("any seat", HybridIii50M, "Hybrid III 50M", FMVSS_208),
                occupant("any seat", HybridIii5F, "Hybrid III 5F", FMVSS_208),
            ],
            total: Total::Apart,
        }],
    ),
    rating(
        ("un-r94", "UN R94, 2022, frontal offset, 56 km/h", R94),
        Rule::UnR94,
        Blow::Front,
        &[Test {
            name: "deformable barrier, 56 km/h",
            occupants: &[occupant("front seats", HybridIii50M, "Hybrid III 50M", REGIONS_R94)],
            total: Total::Apart,
        }],
    ),
    rating(
        ("un-r137", "UN R137, 2023, frontal full width, 50 km/h", R137),
        Rule::UnR137,
        Blow::Front,
        &[Test {
            name: "rigid barrier, 50 km/h",
            occupants: &[
                occupant("Driver", HybridIii50M, "Hybrid III 50M", DRIVER_R137),
                occupant("Front Passenger", HybridIii5F, "Hybrid III 5F", PASSENGER_R137),
            ],
            total: Total::Apart,
        }],
    ),
    rating(
        ("un-r95", "UN R95, 2023, side barrier, 50 km/h", R95),
        Rule::UnR95,
        Blow::Side,
        &[Test {
            name: "side barrier, 50 km/h",
            occupants: &[occupant("Driver", Es2, "ES-2", REGIONS_R95)],
            total: Total::Apart,
        }],
    ),
    rating(
        ("fmvss-214", "FMVSS 214, 2007, side, barrier and pole", F214),
        Rule::Fmvss214,
        Blow::Side,
        &[Test {
            name: "side",
            occupants: &[
                occupant("any seat", Es2Re, "ES-2re", ES_2RE_214),
                occupant("any seat", SidIis, "SID-IIs", SID_IIS_214),
            ],
            total: Total::Apart,
        }],
    ),
];
