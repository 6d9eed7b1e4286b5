//! IIHS: good, acceptable, marginal or poor, and demerits, as read in the open program pyisomme 1.1.0 (MIT), which
//! cites the guidelines.

use super::super::scale::{Criterion, grades};
use super::super::{Method, Occupant, Rating, Region, Test, Total, graded};
use crate::measure::{Blow, Dummy};

const MODERATE: &str = "IIHS, Moderate Overlap Crashworthiness Evaluation 2.0, Rating Guidelines, version III, February 2026, as read in pyisomme 1.1.0";
const SIDE: &str = "IIHS, Side Impact Crashworthiness Evaluation 2.0, Rating Guidelines, version IV, April 2024, as read in pyisomme 1.1.0";
const REMARK: &str = "The grade is that of the injury measures alone: structure, restraints and kinematics, head protection and \
    downgrades for hard contacts are not in it.";

const HEAD_NECK_50M: &[Criterion] = &[
    grades("HIC15", 560.0, 700.0, 840.0),
    grades("Nij", 0.8, 1.0, 1.2),
    grades("Fz,tension", 2.6, 3.3, 4.0),
    grades("Fz,compression", 3.2, 4.0, 4.8),
    over_time("Fz,tension over time"),
    over_time("Fz,compression over time"),
    over_time("Fx,shear over time"),
];
const CHEST_50M: &[Criterion] = &[
    grades("Chest acceleration, 3 ms", 60.0, 75.0, 90.0),
    grades("Dchest compression", 50.0, 60.0, 75.0),
    grades("Dchest compression, rate", 6.6, 8.2, 9.8),
    grades("Viscous Criterion", 0.8, 1.0, 1.2),
];
const THIGH_50M: &[Criterion] =
    &[grades("Knee, thigh, hip, right", 0.05, 0.15, 0.25), grades("Knee, thigh, hip, left", 0.05, 0.15, 0.25)];
const LEGS_50M: &[Criterion] = &[
    grades("Dknee, right", 12.0, 15.0, 18.0),
    grades("Dknee, left", 12.0, 15.0, 18.0),
    grades("Itibia, right", 0.8, 1.0, 1.2),
    grades("Itibia, left", 0.8, 1.0, 1.2),
    grades("Ftibia, right", 4.0, 6.0, 8.0),
    grades("Ftibia, left", 4.0, 6.0, 8.0),
    grades("Foot acceleration", 150.0, 200.0, 260.0),
];
const HEAD_NECK_5F: &[Criterion] = &[
    grades("HIC15", 560.0, 700.0, 840.0),
    grades("Nij", 0.8, 1.0, 1.2),
    grades("Fz,tension", 2.0, 2.4, 2.8),
    grades("Fz,compression", 2.0, 2.5, 3.0),
];
const CHEST_5F: &[Criterion] = &[
    grades("Chest index", 35.0, 40.0, 45.0),
    // up to 5.9 kN good, else marginal
    grades("Shoulder belt load", 5.9, 5.9, f64::MAX),
];
const THIGH_5F: &[Criterion] = &[grades("Ffemur, right", 4.9, 6.2, 7.4), grades("Ffemur, left", 4.9, 6.2, 7.4)];
const HEAD_NECK_SIDE: &[Criterion] = &[
    grades("HIC15", 623.0, 779.0, 935.0),
    grades("Fz,tension", 2.1, 2.5, 2.9),
    grades("Fz,compression", 2.5, 3.0, 3.5),
];
const TORSO: &[Criterion] = &[
    grades("Rib deflection, mean", 28.0, 38.0, 48.0),
    // a single rib: at least marginal beyond 50 mm, poor beyond 55 mm
    grades("Rib deflection", 50.0, 50.0, 55.0),
    grades("Rib deflection, rate", 8.2, 9.8, 11.5),
    grades("Rib viscous criterion", 1.0, 1.2, 1.4),
];
const PELVIS: &[Criterion] = &[grades("Facetabulum and ilium", 4.0, 5.0, 6.0)];

const HIGH: [f64; 4] = [0.0, 2.0, 10.0, 20.0];
const THIGH: [f64; 4] = [0.0, 2.0, 6.0, 10.0];
const LEGS: [f64; 4] = [0.0, 1.0, 4.0, 6.0];
const HIGH_SIDE: [f64; 4] = [0.0, 2.0, 10.0, 35.0];

/// A curve of force over duration: good within it, acceptable beyond.
const fn over_time(name: &'static str) -> Criterion {
    grades(name, 1.0, f64::MAX, f64::MAX)
}

const SIDE_REGIONS: &[Region] = &[
    graded("Head and neck", HIGH_SIDE, HEAD_NECK_SIDE),
    graded("Torso", HIGH_SIDE, TORSO),
    graded("Pelvis", THIGH, PELVIS),
];

const fn occupant(seat: &'static str, label: &'static str, dummy: Dummy, regions: &'static [Region]) -> Occupant {
    Occupant { case: "", seat, label, dummy: Some(dummy), regions }
}

/// The ratings of this institute.
pub(super) const RATINGS: [Rating; 2] = [
    Rating {
        name: "iihs-moderate-overlap",
        title: "IIHS 2026, frontal moderate overlap 2.0",
        source: MODERATE,
        remark: REMARK,
        blow: Blow::Front,
        method: Method::Demerits([5.0, 10.0, 24.0]),
        tests: &[Test {
            name: "moderate overlap, 64 km/h",
            occupants: &[
                occupant(
                    "Driver",
                    "Hybrid III 50M",
                    Dummy::HybridIii50M,
                    &[
                        graded("Head and neck", HIGH, HEAD_NECK_50M),
                        graded("Chest", HIGH, CHEST_50M),
                        graded("Thigh and hip", THIGH, THIGH_50M),
                        graded("Leg and foot", LEGS, LEGS_50M),
                    ],
                ),
                occupant(
                    "Rear Passenger",
                    "Hybrid III 5F",
                    Dummy::HybridIii5F,
                    &[
                        graded("Head and neck", HIGH, HEAD_NECK_5F),
                        graded("Chest", HIGH, CHEST_5F),
                        graded("Thigh", THIGH, THIGH_5F),
                    ],
                ),
            ],
            total: Total::Sum(1.0),
        }],
    },
    Rating {
        name: "iihs-side",
        title: "IIHS 2024, side 2.0",
        source: SIDE,
        remark: REMARK,
        blow: Blow::Side,
        method: Method::Demerits([8.0, 20.0, 34.0]),
        tests: &[Test {
            name: "side, 60 km/h",
            occupants: &[
                occupant("Driver", "SID-IIs", Dummy::SidIis, SIDE_REGIONS),
                occupant("Rear Passenger", "SID-IIs", Dummy::SidIis, SIDE_REGIONS),
            ],
            total: Total::Sum(1.0),
        }],
    },
];
