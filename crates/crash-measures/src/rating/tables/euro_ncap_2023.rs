//! Euro NCAP of 2023: points on sliding scales, as read in the open program pyisomme 1.1.0 (MIT), which cites the
//! protocol.

use super::super::scale::{Criterion, deduction, gate, sliding};
use super::super::{Method, Occupant, Rating, Test, Total, region};
use crate::measure::{Blow, Dummy};

const SOURCE: &str =
    "Euro NCAP, Assessment Protocol, Adult Occupant Protection, version 9.3, December 2023, as read in pyisomme 1.1.0";
const REMARK: &str =
    "Without modifiers of an inspector: airbags, steering column, pedals, doors, submarining, excursion.";

const HEAD: &[Criterion] = &[
    gate("Ares", 80.0, true),
    sliding("HIC15", 500.0, 700.0).cap(700.0).gated(),
    sliding("Ares-3ms", 72.0, 80.0).cap(80.0).gated(),
];
const NECK_5F: &[Criterion] =
    &[sliding("Fx,shear", 1.2, 1.95), sliding("Fz,tension", 1.7, 2.62), sliding("My,extension", 36.0, 49.0)];
const NECK_5F_DRIVER: &[Criterion] = &[
    sliding("Fx,shear", 1.2, 1.95).cap(2.7),
    sliding("Fz,tension", 1.7, 2.62).cap(2.9),
    sliding("My,extension", 36.0, 49.0).cap(57.0),
];
const CHEST_5F: &[Criterion] = &[
    sliding("Dchest compression", 18.0, 34.0).cap(34.0),
    sliding("Viscous Criterion", 0.5, 1.0).cap(1.0),
    deduction("Shoulder belt load", &[(6.0, 50.0)]),
];
const FEMUR_5F: &[Criterion] = &[sliding("Ffemur, right", 2.6, 6.2), sliding("Ffemur, left", 2.6, 6.2)];

/// Percent of the points of a criterion that is rated by its duration.
const fn over_time(name: &'static str) -> Criterion {
    sliding(name, 100.0, 0.0)
}

const HEAD_THOR: &[Criterion] = &[
    gate("Ares", 80.0, true),
    sliding("HIC15", 500.0, 700.0).cap(700.0).gated(),
    sliding("Ares-3ms", 72.0, 80.0).cap(80.0).gated(),
    deduction("DAMAGE", &[(0.42, 25.0), (0.47, 50.0)]),
    sliding("Fx,shear", 1.9, 3.1).cap(3.1),
    sliding("Fz,tension", 2.7, 3.3).cap(3.3),
    sliding("My,extension", 42.0, 57.0).cap(57.0),
];
const CHEST_THOR: &[Criterion] = &[
    sliding("Dchest compression, upper right", 35.0, 60.0).cap(60.0),
    sliding("Dchest compression, upper left", 35.0, 60.0).cap(60.0),
    sliding("Dchest compression, lower right", 35.0, 60.0).cap(60.0),
    sliding("Dchest compression, lower left", 35.0, 60.0).cap(60.0),
    sliding("Dabdomen compression, right", 88.0, 88.0),
    sliding("Dabdomen compression, left", 88.0, 88.0),
    deduction("Shoulder belt load", &[(6.0, 50.0)]),
];
const KNEES_THOR: &[Criterion] = &[
    sliding("Facetabulum, right", 3.28, 4.1),
    sliding("Facetabulum, left", 3.28, 4.1),
    over_time("Ffemur over time, right, % of points"),
    over_time("Ffemur over time, left, % of points"),
    sliding("Dknee, right", 6.0, 15.0),
    sliding("Dknee, left", 6.0, 15.0),
];
const LEGS: &[Criterion] = &[
    sliding("Itibia, right", 0.4, 1.3),
    sliding("Ftibia, right", 2.0, 8.0),
    sliding("Itibia, left", 0.4, 1.3),
    sliding("Ftibia, left", 2.0, 8.0),
];
const HEAD_50M: &[Criterion] = &[
    gate("Ares", 80.0, true),
    sliding("HIC15", 500.0, 700.0).cap(700.0).gated(),
    sliding("Ares-3ms", 72.0, 80.0).cap(80.0).gated(),
    over_time("Fx,shear over time, % of points"),
    over_time("Fz,tension over time, % of points"),
    sliding("My,extension", 42.0, 57.0).cap(57.0),
];
const CHEST_50M: &[Criterion] = &[
    sliding("Dchest compression", 22.0, 42.0).cap(42.0),
    sliding("Viscous Criterion", 0.5, 1.0).cap(1.0),
    deduction("Shoulder belt load", &[(6.0, 50.0)]),
];
const KNEES_50M: &[Criterion] = &[
    over_time("Ffemur over time, right, % of points"),
    over_time("Ffemur over time, left, % of points"),
    sliding("Dknee, right", 6.0, 15.0),
    sliding("Dknee, left", 6.0, 15.0),
];

const HEAD_SIDE: &[Criterion] = &[sliding("HIC15", 500.0, 700.0).cap(700.0), sliding("Ares-3ms", 72.0, 80.0).cap(80.0)];
const HEAD_POLE: &[Criterion] = &[sliding("HIC15", 700.0, 700.0).cap(700.0), sliding("Ares", 80.0, 80.0).cap(80.0)];
const CHEST_SIDE: &[Criterion] = &[
    sliding("Dchest compression, top", 28.0, 50.0).cap(50.0),
    sliding("Dchest compression, middle", 28.0, 50.0).cap(50.0),
    sliding("Dchest compression, bottom", 28.0, 50.0).cap(50.0),
    sliding("Viscous Criterion", 1.0, 1.0),
    sliding("Shoulder load", 3.0, 3.0),
];
const CHEST_POLE: &[Criterion] = &[
    sliding("Dchest compression, top", 28.0, 50.0).cap(55.0),
    sliding("Dchest compression, middle", 28.0, 50.0).cap(55.0),
    sliding("Dchest compression, bottom", 28.0, 50.0).cap(55.0),
    sliding("Viscous Criterion", 1.0, 1.0),
    sliding("Shoulder load", 3.0, 3.0),
];
const ABDOMEN: &[Criterion] = &[
    sliding("Dabdomen compression, top", 47.0, 65.0).cap(65.0),
    sliding("Dabdomen compression, bottom", 47.0, 65.0).cap(65.0),
    sliding("Viscous Criterion", 1.0, 1.0),
];
const PELVIS: &[Criterion] = &[sliding("Fpubic symphysis", 1.7, 2.8).cap(2.8)];

const fn occupant(
    seat: &'static str,
    label: &'static str,
    dummy: Dummy,
    regions: &'static [super::super::Region],
) -> Occupant {
    Occupant { case: "", seat, label, dummy: Some(dummy), regions }
}

const FULL_WIDTH: Test = Test {
    name: "full width, 50 km/h",
    occupants: &[
        occupant(
            "Driver",
            "HIII-05",
            Dummy::HybridIii5F,
            &[
                region("Head", 4.0, HEAD),
                region("Neck", 4.0, NECK_5F_DRIVER),
                region("Chest", 4.0, CHEST_5F),
                region("Knee, Femur & Pelvis", 4.0, FEMUR_5F),
            ],
        ),
        occupant(
            "Rear Passenger",
            "HIII-05",
            Dummy::HybridIii5F,
            &[
                region("Head", 4.0, HEAD),
                region("Neck", 4.0, NECK_5F),
                region("Chest", 4.0, CHEST_5F),
                region("Knee, Femur & Pelvis", 4.0, FEMUR_5F),
            ],
        ),
    ],
    total: Total::Sum(0.25),
};
const MPDB: Test = Test {
    name: "MPDB, 50 km/h",
    occupants: &[
        occupant(
            "Driver",
            "THOR-50",
            Dummy::Thor50M,
            &[
                region("Head & Neck", 4.0, HEAD_THOR),
                region("Chest & Abdomen", 4.0, CHEST_THOR),
                region("Knee, Femur & Pelvis", 4.0, KNEES_THOR),
                region("Lower Leg, Foot & Ankle", 4.0, LEGS),
            ],
        ),
        occupant(
            "Front Passenger",
            "HIII-50",
            Dummy::HybridIii50M,
            &[
                region("Head & Neck", 4.0, HEAD_50M),
                region("Chest & Abdomen", 4.0, CHEST_50M),
                region("Knee, Femur & Pelvis", 4.0, KNEES_50M),
                region("Lower Leg, Foot & Ankle", 4.0, LEGS),
            ],
        ),
    ],
    total: Total::WorstRegions(0.5),
};
const BARRIER: Test = Test {
    name: "side barrier, 60 km/h",
    occupants: &[occupant(
        "Driver",
        "WorldSID-50",
        Dummy::WorldSid50M,
        &[
            region("Head", 4.0, HEAD_SIDE),
            region("Chest", 4.0, CHEST_SIDE),
            region("Abdomen", 4.0, ABDOMEN),
            region("Pelvis", 4.0, PELVIS),
        ],
    )],
    total: Total::Apart,
};
const POLE: Test = Test {
    name: "side pole, 32 km/h",
    occupants: &[occupant(
        "Driver",
        "WorldSID-50",
        Dummy::WorldSid50M,
        &[
            region("Head", 4.0, HEAD_POLE),
            region("Chest", 4.0, CHEST_POLE),
            region("Abdomen", 4.0, ABDOMEN),
            region("Pelvis", 4.0, PELVIS),
        ],
    )],
    total: Total::Apart,
};

const fn rating(name: &'static str, title: &'static str, blow: Blow, tests: &'static [Test]) -> Rating {
    Rating { name, title, source: SOURCE, remark: REMARK, blow, method: Method::Sliding, tests }
}

/// The ratings of this edition.
pub(super) const RATINGS: [Rating; 4] = [
    rating("euro-ncap-full-width", "Euro NCAP 2023, frontal full width", Blow::Front, &[FULL_WIDTH]),
    rating("euro-ncap-mpdb", "Euro NCAP 2023, frontal MPDB, occupants", Blow::Front, &[MPDB]),
    rating("euro-ncap-side-barrier", "Euro NCAP 2023, side barrier", Blow::Side, &[BARRIER]),
    rating("euro-ncap-side-pole", "Euro NCAP 2023, side pole", Blow::Side, &[POLE]),
];
