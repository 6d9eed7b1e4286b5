//! Euro NCAP 2026: the tables of the calculator `euroncap-rating-2026` 5.4.9 (Euro NCAP IVZW and IVEX, Apache-2.0), for
//! frontal and side impacts. Loads in kN, mm, g, N·m.
//!
//! A region has the percentage of its worst criterion, less its modifiers. Without a hard contact of the head (largest
//! acceleration below 80 g) HIC15 and the 3 ms level are not asked. Left out: whiplash, pedestrians.
//!
//! The far side has five parts of 2 points: both seats of the pole test, the two main cases, and robustness cases of
//! barrier and pole. The main cases have points by the colour of the head's excursion, and loads that cap. The
//! calculator reads modifiers of pelvis and lumbar spine but takes nothing off for them.

use super::super::far_side::{COUNTERMEASURE, EXCURSION, RED_LINE};
use super::super::rate::LOWER_LEGS;
use super::super::scale::{Criterion, Scale, bands, cap, criterion, deduction, gate};
use super::super::{Method, Occupant, Rating, Region, Test, Total, region};
use crate::measure::{Blow, Dummy};

const SOURCE: &str = "Euro NCAP, calculator euroncap-rating-2026, version 5.4.9, 2026 (Apache-2.0), which implements the Euro NCAP protocols of 2026 for crash protection";
const REMARK: &str = "Without what an inspector takes off, unless it is given as `Inspection [%]` of a region.";

const FAR_SIDE_REMARK: &str = "Without what an inspector takes off, unless it is given as `Inspection [%]` of a region. On the far side, both seats of Pole-32, the robustness cases of the barrier and those of the pole count once, by their worst; pelvis and lumbar spine take nothing off, as in the calculator. Whether a body sat on the far side is not checked.";

/// HIC15 below which a peak of the head in a pole test is taken as a blow of the arm.
const ARM_HIC15: f64 = 500.0;

type Of = (&'static str, Option<Dummy>);
const THOR_50: Of = ("THOR-50", Some(Dummy::Thor50M));
const HIII_05: Of = ("HIII-05", Some(Dummy::HybridIii5F));
const HIII_50: Of = ("HIII-50", Some(Dummy::HybridIii50M));
const HIII_95: Of = ("HIII-95", Some(Dummy::HybridIii95M));
const WORLDSID_50: Of = ("WorldSID-50", Some(Dummy::WorldSid50M));
const WORLDSID_50_FAR_SIDE: Of = ("WorldSID-50-Farside", Some(Dummy::WorldSid50M));
const Q6: Of = ("Q6", None);
const Q10: Of = ("Q10", None);
const Q6_SIDE: Of = ("Q6-Side", None);
const Q10_SIDE: Of = ("Q10-Side", None);

const fn occupant(case: &'static str, seat: &'static str, (label, dummy): Of, regions: &'static [Region]) -> Occupant {
    Occupant { case, seat, label, dummy, regions }
}

const fn test(name: &'static str, occupants: &'static [Occupant]) -> Test {
    Test { name, occupants, total: Total::Sum(1.0) }
}

const fn rating(name: &'static str, title: &'static str, blow: Blow, tests: &'static [Test]) -> Rating {
    Rating { name, title, source: SOURCE, remark: REMARK, blow, method: Method::Bands, tests }
}

const OFFSET_TEST: Test = test("Offset", OFFSET);
const FULL_WIDTH_TEST: Test = test("FW", FULL_WIDTH);
const SLED_TEST: Test = test("Sled & VT", SLED);
const BARRIER_TEST: Test = test("MDB", SIDE_BARRIER);
const POLE_TEST: Test = test("Pole", SIDE_POLE);
const FAR_SIDE_TEST: Test = Test { name: "Farside", occupants: FAR_SIDE, total: Total::WorstOfParts(&[2, 1, 1, 4, 2]) };

/// The ratings of this edition.
pub(super) const RATINGS: [Rating; 8] = [
    rating(
        "euro-ncap-2026-frontal",
        "Euro NCAP 2026, frontal impact: offset, full width, sled and virtual tests",
        Blow::Front,
        &[OFFSET_TEST, FULL_WIDTH_TEST, SLED_TEST],
    ),
    rating("euro-ncap-2026-offset", "Euro NCAP 2026, frontal offset (MPDB)", Blow::Front, &[OFFSET_TEST]),
    rating("euro-ncap-2026-full-width", "Euro NCAP 2026, frontal full width", Blow::Front, &[FULL_WIDTH_TEST]),
    rating("euro-ncap-2026-sled", "Euro NCAP 2026, frontal sled and virtual tests", Blow::Front, &[SLED_TEST]),
    Rating {
        remark: FAR_SIDE_REMARK,
        ..rating(
            "euro-ncap-2026-side",
            "Euro NCAP 2026, side impact: barrier, pole and far side",
            Blow::Side,
            &[BARRIER_TEST, POLE_TEST, FAR_SIDE_TEST],
        )
    },
    rating("euro-ncap-2026-side-barrier", "Euro NCAP 2026, side barrier", Blow::Side, &[BARRIER_TEST]),
    rating("euro-ncap-2026-side-pole", "Euro NCAP 2026, side pole", Blow::Side, &[POLE_TEST]),
    Rating {
        remark: FAR_SIDE_REMARK,
        ..rating("euro-ncap-2026-far-side", "Euro NCAP 2026, far side", Blow::Side, &[FAR_SIDE_TEST])
    },
];

/// Legs that virtual tests take from the others.
const OTHERS: &[Criterion] = &[criterion("Lower legs of the other tests", Scale::Others)];

const THOR_50_HEAD_NECK: &[Criterion] = &[
    gate("Ares", 80.0, true),
    bands("HIC15", 500.0, 700.0).cap(700.0).gated(),
    bands("Ares-3ms", 72.0, 80.0).cap(80.0).gated(),
    bands("Fx,shear", 1.9, 3.1).cap(3.1),
    bands("Fz,tension", 2.7, 3.3).cap(3.3),
    bands("My,extension", 42.0, 57.0).cap(57.0),
    deduction("DAMAGE", &[(0.42, 20.0), (0.47, 40.0)]),
];
const THOR_50_CHEST_ABDOMEN: &[Criterion] = &[
    bands("Dchest compression, upper right", 35.0, 60.0).cap(60.0),
    bands("Dchest compression, upper left", 35.0, 60.0).cap(60.0),
    bands("Dchest compression, lower right", 35.0, 60.0).cap(60.0),
    bands("Dchest compression, lower left", 35.0, 60.0).cap(60.0),
    bands("Dabdomen compression, right", 88.0, 88.0),
    bands("Dabdomen compression, left", 88.0, 88.0),
    deduction("Shoulder belt load", &[(6.0, 40.0)]),
];
const THOR_50_KNEE_FEMUR_PELVIS: &[Criterion] = &[
    bands("Facetabulum, right", 3.3, 4.1),
    bands("Ffemur, right", 3.8, 9.1),
    bands("Dknee, right", 6.0, 15.0),
    bands("Facetabulum, left", 3.3, 4.1),
    bands("Ffemur, left", 3.8, 9.1),
    bands("Dknee, left", 6.0, 15.0),
];
const THOR_50_LEGS_AND_PEDALS: &[Criterion] = &[
    bands("Itibia, right", 0.4, 1.3),
    bands("Ftibia, right", 2.0, 8.0),
    bands("Itibia, left", 0.4, 1.3),
    bands("Ftibia, left", 2.0, 8.0),
    deduction("Pedal displacement - rearward", &[(100.0, 50.0), (200.0, 100.0)]),
    deduction("Pedal displacement - vertical", &[(72.0, 20.0)]),
    deduction("Pedal blocking", &[(50.0, 20.0)]),
];
const HIII_05_HEAD_NECK: &[Criterion] = &[
    gate("Ares", 80.0, true),
    bands("HIC15", 500.0, 700.0).cap(700.0).gated(),
    bands("Ares-3ms", 72.0, 80.0).cap(80.0).gated(),
    bands("Fx,shear", 1.2, 2.0),
    bands("Fz,tension", 1.7, 2.6),
    bands("My,extension", 36.0, 49.0),
];
const HIII_05_CHEST_ABDOMEN: &[Criterion] = &[
    bands("Dchest compression", 18.0, 34.0).cap(34.0),
    bands("Viscous Criterion", 0.5, 1.0).cap(1.0),
    deduction("Shoulder belt load", &[(6.0, 40.0)]),
];
const HIII_05_KNEE_FEMUR_PELVIS: &[Criterion] = &[
    bands("Ffemur, right", 2.6, 6.2),
    bands("Dknee, right", 6.0, 15.0),
    bands("Ffemur, left", 2.6, 6.2),
    bands("Dknee, left", 6.0, 15.0),
];
const HIII_05_LEGS: &[Criterion] = &[
    bands("Itibia, right", 1.3, 1.3),
    bands("Ftibia, right", 8.0, 8.0),
    bands("Itibia, left", 1.3, 1.3),
    bands("Ftibia, left", 8.0, 8.0),
];
const Q6_HEAD: &[Criterion] = &[
    gate("Ares", 80.0, false),
    bands("HIC15", 500.0, 700.0).cap(700.0).gated(),
    bands("Ares-3ms", 60.0, 80.0).cap(80.0),
];
const Q6_NECK: &[Criterion] = &[bands("Fz,tension", 1.7, 2.62), bands("My,extension", 36.0, 36.0).gated()];
const Q6_CHEST: &[Criterion] = &[bands("Dchest compression", 30.0, 42.0)];
const Q10_NECK: &[Criterion] = &[bands("Fz,tension", 1.7, 2.62), bands("My,extension", 49.0, 49.0).gated()];
const Q10_CHEST: &[Criterion] =
    &[bands("Dchest compression", 56.0, 56.0).cap(56.0), bands("Ares-3ms", 41.0, 55.0).cap(55.0)];
const HIII_05_HEAD_NECK_DRIVER: &[Criterion] = &[
    gate("Ares", 80.0, true),
    bands("HIC15", 500.0, 700.0).cap(700.0).gated(),
    bands("Ares-3ms", 72.0, 80.0).cap(80.0).gated(),
    bands("Fx,shear", 1.2, 2.0).cap(2.7),
    bands("Fz,tension", 1.7, 2.6).cap(2.9),
    bands("My,extension", 36.0, 49.0).cap(57.0),
];
const HIII_05_LEGS_AND_PEDALS: &[Criterion] = &[
    bands("Itibia, right", 1.3, 1.3),
    bands("Ftibia, right", 8.0, 8.0),
    bands("Itibia, left", 1.3, 1.3),
    bands("Ftibia, left", 8.0, 8.0),
    deduction("Pedal displacement - rearward", &[(100.0, 50.0), (200.0, 100.0)]),
    deduction("Pedal displacement - vertical", &[(72.0, 20.0)]),
    deduction("Pedal blocking", &[(50.0, 20.0)]),
];
const THOR_50_CHEST_ABDOMEN_FULL_WIDTH: &[Criterion] = &[
    bands("Dchest compression, upper right", 29.0, 54.0).cap(54.0),
    bands("Dchest compression, upper left", 29.0, 54.0).cap(54.0),
    bands("Dchest compression, lower right", 29.0, 54.0).cap(54.0),
    bands("Dchest compression, lower left", 29.0, 54.0).cap(54.0),
    bands("Dabdomen compression, right", 88.0, 88.0),
    bands("Dabdomen compression, left", 88.0, 88.0),
    deduction("Shoulder belt load", &[(6.0, 40.0)]),
];
const THOR_50_LEGS: &[Criterion] = &[
    bands("Itibia, right", 0.4, 1.3),
    bands("Ftibia, right", 2.0, 8.0),
    bands("Itibia, left", 0.4, 1.3),
    bands("Ftibia, left", 2.0, 8.0),
];
const HIII_50_HEAD_NECK: &[Criterion] = &[
    gate("Ares", 80.0, true),
    bands("HIC15", 500.0, 700.0).gated(),
    bands("Ares-3ms", 72.0, 80.0).gated(),
    bands("Fx,shear", 1.9, 3.1),
    bands("Fz,tension", 2.7, 3.3),
    bands("My,extension", 42.0, 57.0),
];
const HIII_50_CHEST_ABDOMEN: &[Criterion] = &[
    bands("Dchest compression", 20.0, 42.0),
    bands("Viscous Criterion", 0.5, 1.0),
    deduction("Shoulder belt load", &[(6.0, 40.0)]),
];
const HIII_50_KNEE_FEMUR_PELVIS: &[Criterion] = &[
    bands("Ffemur, right", 3.8, 9.1),
    bands("Dknee, right", 6.0, 15.0),
    bands("Ffemur, left", 3.8, 9.1),
    bands("Dknee, left", 6.0, 15.0),
];
const HIII_95_HEAD_NECK: &[Criterion] = &[
    gate("Ares", 80.0, true),
    bands("HIC15", 500.0, 700.0).gated(),
    bands("Ares-3ms", 72.0, 80.0).gated(),
    bands("Fx,shear", 2.3, 3.8),
    bands("Fz,tension", 3.3, 4.0),
    bands("My,extension", 56.0, 76.0),
];
const HIII_95_CHEST_ABDOMEN: &[Criterion] =
    &[bands("Dchest compression", 28.0, 55.0), bands("Viscous Criterion", 0.5, 1.0)];
const HIII_95_KNEE_FEMUR_PELVIS: &[Criterion] = &[
    bands("Ffemur, right", 4.8, 11.5),
    bands("Dknee, right", 6.0, 17.0),
    bands("Ffemur, left", 4.8, 11.5),
    bands("Dknee, left", 6.0, 17.0),
];
const HIII_95_LEGS: &[Criterion] = &[
    bands("Itibia, right", 1.3, 1.3),
    bands("Ftibia, right", 10.0, 10.0),
    bands("Itibia, left", 1.3, 1.3),
    bands("Ftibia, left", 10.0, 10.0),
];
const HIII_05_HEAD_NECK_SLED: &[Criterion] = &[
    gate("Ares", 80.0, true),
    bands("HIC15", 500.0, 700.0).gated(),
    bands("Ares-3ms", 72.0, 80.0).gated(),
    bands("Fx,shear", 1.2, 2.0),
    bands("Fz,tension", 1.7, 2.6),
    bands("My,extension", 36.0, 49.0),
];
const HIII_05_CHEST_ABDOMEN_HIGH: &[Criterion] = &[
    bands("Dchest compression", 22.0, 42.0),
    bands("Viscous Criterion", 0.5, 1.0),
    deduction("Shoulder belt load", &[(6.0, 40.0)]),
];
const HIII_50_FEMUR: &[Criterion] = &[bands("Ffemur, right", 3.8, 9.1), bands("Ffemur, left", 3.8, 9.1)];
const HIII_05_CHEST_ABDOMEN_LOW: &[Criterion] = &[
    bands("Dchest compression", 18.0, 34.0),
    bands("Viscous Criterion", 0.5, 1.0),
    deduction("Shoulder belt load", &[(6.0, 40.0)]),
];
const HIII_05_FEMUR: &[Criterion] = &[bands("Ffemur, right", 2.6, 6.2), bands("Ffemur, left", 2.6, 6.2)];
const HIII_95_FEMUR: &[Criterion] = &[bands("Ffemur, right", 4.8, 11.5), bands("Ffemur, left", 4.8, 11.5)];
const WORLDSID_50_HEAD: &[Criterion] =
    &[cap("Ares", 80.0), bands("HIC15", 500.0, 700.0).cap(700.0), bands("Ares-3ms", 72.0, 80.0).cap(80.0)];
const WORLDSID_50_CHEST: &[Criterion] = &[
    bands("Dchest compression, top", 28.0, 50.0).cap(50.0),
    bands("Dchest compression, middle", 28.0, 50.0).cap(50.0),
    bands("Dchest compression, bottom", 28.0, 50.0).cap(50.0),
    deduction("Shoulder load", &[(3.0, 100.0)]),
    deduction("Viscous Criterion", &[(1.0, 100.0)]),
];
const WORLDSID_50_ABDOMEN: &[Criterion] = &[
    bands("Dabdomen compression, top", 47.0, 65.0).cap(65.0),
    bands("Dabdomen compression, bottom", 47.0, 65.0).cap(65.0),
    deduction("Viscous Criterion", &[(1.0, 100.0)]),
];
const WORLDSID_50_PELVIS: &[Criterion] = &[bands("Fpubic symphysis", 1.7, 2.8).cap(2.8)];
const Q10_SIDE_NECK: &[Criterion] = &[bands("Fz,tension", 2.2, 2.2)];
const Q10_SIDE_CHEST: &[Criterion] = &[bands("Ares-3ms", 67.0, 67.0)];
const Q6_SIDE_NECK: &[Criterion] = &[bands("Fz,tension", 2.4, 2.4)];
const WORLDSID_50_HEAD_POLE: &[Criterion] = &[
    cap("Ares", 80.0).unless("HIC15", ARM_HIC15),
    bands("HIC15", 500.0, 700.0).cap(700.0),
    bands("Ares-3ms", 72.0, 80.0).cap(80.0),
    cap("Direct contact with pole", 1.0),
];
const WORLDSID_50_CHEST_POLE: &[Criterion] = &[
    bands("Dchest compression, top", 28.0, 50.0).cap(55.0),
    bands("Dchest compression, middle", 28.0, 50.0).cap(55.0),
    bands("Dchest compression, bottom", 28.0, 50.0).cap(55.0),
    deduction("Shoulder load", &[(3.0, 100.0)]),
    deduction("Viscous Criterion", &[(1.0, 100.0)]),
];
const OFFSET: &[Occupant] = &[
    occupant(
        "MPDB-50",
        "Driver",
        THOR_50,
        &[
            region("Head & Neck", 1.25, THOR_50_HEAD_NECK),
            region("Chest & Abdomen", 1.25, THOR_50_CHEST_ABDOMEN),
            region("Knee, Femur & Pelvis", 1.25, THOR_50_KNEE_FEMUR_PELVIS),
            region(LOWER_LEGS, 1.25, THOR_50_LEGS_AND_PEDALS),
        ],
    ),
    occupant(
        "MPDB-50",
        "Front Passenger",
        HIII_05,
        &[
            region("Head & Neck", 1.25, HIII_05_HEAD_NECK),
            region("Chest & Abdomen", 1.25, HIII_05_CHEST_ABDOMEN),
            region("Knee, Femur & Pelvis", 1.25, HIII_05_KNEE_FEMUR_PELVIS),
            region(LOWER_LEGS, 1.25, HIII_05_LEGS),
        ],
    ),
    occupant(
        "MPDB-50",
        "Behind Driver",
        Q6,
        &[region("Head", 2.5, Q6_HEAD), region("Neck", 1.25, Q6_NECK), region("Chest", 1.25, Q6_CHEST)],
    ),
    occupant(
        "MPDB-50",
        "Behind Passenger",
        Q10,
        &[region("Head", 2.5, Q6_HEAD), region("Neck", 1.25, Q10_NECK), region("Chest", 1.25, Q10_CHEST)],
    ),
];
const FULL_WIDTH: &[Occupant] = &[
    occupant(
        "FWDB-35",
        "Driver",
        HIII_05,
        &[
            region("Head & Neck", 1.25, HIII_05_HEAD_NECK_DRIVER),
            region("Chest & Abdomen", 1.25, HIII_05_CHEST_ABDOMEN),
            region("Knee, Femur & Pelvis", 1.25, HIII_05_KNEE_FEMUR_PELVIS),
            region(LOWER_LEGS, 1.25, HIII_05_LEGS_AND_PEDALS),
        ],
    ),
    occupant(
        "FWDB-35",
        "Front Passenger",
        THOR_50,
        &[
            region("Head & Neck", 0.625, THOR_50_HEAD_NECK),
            region("Chest & Abdomen", 0.625, THOR_50_CHEST_ABDOMEN_FULL_WIDTH),
            region("Knee, Femur & Pelvis", 0.625, THOR_50_KNEE_FEMUR_PELVIS),
            region(LOWER_LEGS, 0.625, THOR_50_LEGS),
        ],
    ),
    occupant(
        "FWDB-35",
        "Behind Passenger",
        HIII_05,
        &[
            region("Head & Neck", 0.625, HIII_05_HEAD_NECK),
            region("Chest & Abdomen", 1.25, HIII_05_CHEST_ABDOMEN),
            region("Knee, Femur & Pelvis", 0.625, HIII_05_KNEE_FEMUR_PELVIS),
        ],
    ),
];
const SLED: &[Occupant] = &[
    occupant(
        "Sled-Mid",
        "Driver",
        HIII_50,
        &[
            region("Head & Neck", 0.3125, HIII_50_HEAD_NECK),
            region("Chest & Abdomen", 0.3125, HIII_50_CHEST_ABDOMEN),
            region("Knee, Femur & Pelvis", 0.3125, HIII_50_KNEE_FEMUR_PELVIS),
            region(LOWER_LEGS, 0.3125, THOR_50_LEGS),
        ],
    ),
    occupant(
        "Sled-Mid",
        "Front Passenger",
        HIII_95,
        &[
            region("Head & Neck", 0.3125, HIII_95_HEAD_NECK),
            region("Chest & Abdomen", 0.3125, HIII_95_CHEST_ABDOMEN),
            region("Knee, Femur & Pelvis", 0.3125, HIII_95_KNEE_FEMUR_PELVIS),
            region(LOWER_LEGS, 0.3125, HIII_95_LEGS),
        ],
    ),
    occupant(
        "Sled-High",
        "Driver",
        HIII_95,
        &[
            region("Head & Neck", 0.3125, HIII_95_HEAD_NECK),
            region("Chest & Abdomen", 0.3125, HIII_95_CHEST_ABDOMEN),
            region("Knee, Femur & Pelvis", 0.3125, HIII_95_KNEE_FEMUR_PELVIS),
            region(LOWER_LEGS, 0.3125, HIII_95_LEGS),
        ],
    ),
    occupant(
        "Sled-High",
        "Front Passenger",
        HIII_05,
        &[
            region("Head & Neck", 0.3125, HIII_05_HEAD_NECK_SLED),
            region("Chest & Abdomen", 0.3125, HIII_05_CHEST_ABDOMEN_HIGH),
            region("Knee, Femur & Pelvis", 0.3125, HIII_05_KNEE_FEMUR_PELVIS),
            region(LOWER_LEGS, 0.3125, HIII_05_LEGS),
        ],
    ),
    occupant(
        "Virtual-Low",
        "Driver",
        HIII_50,
        &[
            region("Head & Neck", 0.20833, HIII_50_HEAD_NECK),
            region("Chest & Abdomen", 0.20833, HIII_50_CHEST_ABDOMEN),
            region("Knee, Femur & Pelvis", 0.20833, HIII_50_FEMUR),
            region(LOWER_LEGS, 0.20833, OTHERS),
        ],
    ),
    occupant(
        "Virtual-Low",
        "Front Passenger",
        HIII_05,
        &[
            region("Head & Neck", 0.20833, HIII_05_HEAD_NECK_SLED),
            region("Chest & Abdomen", 0.20833, HIII_05_CHEST_ABDOMEN_LOW),
            region("Knee, Femur & Pelvis", 0.20833, HIII_05_FEMUR),
            region(LOWER_LEGS, 0.20833, OTHERS),
        ],
    ),
    occupant(
        "Virtual-Low",
        "Driver",
        HIII_05,
        &[
            region("Head & Neck", 0.20833, HIII_05_HEAD_NECK_SLED),
            region("Chest & Abdomen", 0.20833, HIII_05_CHEST_ABDOMEN_LOW),
            region("Knee, Femur & Pelvis", 0.20833, HIII_05_FEMUR),
            region(LOWER_LEGS, 0.20833, OTHERS),
        ],
    ),
    occupant(
        "Virtual-Low",
        "Front Passenger",
        HIII_50,
        &[
            region("Head & Neck", 0.20833, HIII_50_HEAD_NECK),
            region("Chest & Abdomen", 0.20833, HIII_50_CHEST_ABDOMEN),
            region("Knee, Femur & Pelvis", 0.20833, HIII_50_FEMUR),
            region(LOWER_LEGS, 0.20833, OTHERS),
        ],
    ),
    occupant(
        "Virtual-High",
        "Driver",
        HIII_05,
        &[
            region("Head & Neck", 0.20833, HIII_05_HEAD_NECK_SLED),
            region("Chest & Abdomen", 0.20833, HIII_05_CHEST_ABDOMEN_HIGH),
            region("Knee, Femur & Pelvis", 0.20833, HIII_05_FEMUR),
            region(LOWER_LEGS, 0.20833, OTHERS),
        ],
    ),
    occupant(
        "Virtual-High",
        "Front Passenger",
        HIII_95,
        &[
            region("Head & Neck", 0.20833, HIII_95_HEAD_NECK),
            region("Chest & Abdomen", 0.20833, HIII_95_CHEST_ABDOMEN),
            region("Knee, Femur & Pelvis", 0.20833, HIII_95_FEMUR),
            region(LOWER_LEGS, 0.20833, OTHERS),
        ],
    ),
];
const SIDE_BARRIER: &[Occupant] = &[
    occupant(
        "AEMDB-60",
        "Driver",
        WORLDSID_50,
        &[
            region("Head", 2.5, WORLDSID_50_HEAD),
            region("Chest", 2.5, WORLDSID_50_CHEST),
            region("Abdomen", 2.5, WORLDSID_50_ABDOMEN),
            region("Pelvis", 2.5, WORLDSID_50_PELVIS),
        ],
    ),
    occupant(
        "AEMDB-60",
        "Behind Driver",
        Q10_SIDE,
        &[region("Head", 1.25, Q6_HEAD), region("Neck", 0.625, Q10_SIDE_NECK), region("Chest", 0.625, Q10_SIDE_CHEST)],
    ),
    occupant(
        "AEMDB-60",
        "Behind Passenger",
        Q6_SIDE,
        &[region("Head", 1.25, Q6_HEAD), region("Neck", 0.625, Q6_SIDE_NECK), region("Chest", 0.625, Q10_SIDE_CHEST)],
    ),
];
const SIDE_POLE: &[Occupant] = &[occupant(
    "Pole-32",
    "Driver",
    WORLDSID_50,
    &[
        region("Head", 2.5, WORLDSID_50_HEAD_POLE),
        region("Chest", 2.5, WORLDSID_50_CHEST_POLE),
        region("Abdomen", 2.5, WORLDSID_50_ABDOMEN),
        region("Pelvis", 2.5, WORLDSID_50_PELVIS),
    ],
)];
const FAR_SIDE_POLE_HEAD: &[Criterion] = &[bands("HIC15", 700.0, 700.0), bands("Ares-3ms", 80.0, 80.0)];
const FAR_SIDE_HEAD: &[Criterion] = &[
    cap("Ares", 80.0),
    cap("HIC15", 700.0),
    cap("Ares-3ms", 80.0),
    criterion(EXCURSION, Scale::Excursion),
    criterion(COUNTERMEASURE, Scale::Answer),
    criterion(RED_LINE, Scale::Answer),
];
const FAR_SIDE_NECK: &[Criterion] = &[
    cap("Ftension, upper", 3.74),
    cap("Mflexion, upper", 248.0),
    cap("Mextension, upper", 50.0),
    cap("Ftension, lower", 3.74),
    cap("Mflexion, lower", 248.0),
    cap("Mextension, lower", 100.0),
];
const FAR_SIDE_CHEST: &[Criterion] = &[
    cap("Dchest compression, top", 50.0),
    cap("Dchest compression, middle", 50.0),
    cap("Dchest compression, bottom", 50.0),
];
const FAR_SIDE_ABDOMEN: &[Criterion] =
    &[cap("Dabdomen compression, top", 65.0), cap("Dabdomen compression, bottom", 65.0)];
const FAR_SIDE_PELVIS: &[Criterion] = &[
    deduction("Fpubic symphysis", &[(2.8, 25.0)]),
    deduction("Fy lumbar", &[(2.0, 25.0)]),
    deduction("Fz lumbar", &[(3.5, 25.0)]),
    deduction("Mx lumbar", &[(120.0, 25.0)]),
];
const FAR_SIDE_MAIN: &[Region] = &[
    region("Head", 2.0, FAR_SIDE_HEAD),
    region("Neck", 0.0, FAR_SIDE_NECK),
    region("Chest", 0.0, FAR_SIDE_CHEST),
    region("Abdomen", 0.0, FAR_SIDE_ABDOMEN),
    region("Pelvis", 0.0, FAR_SIDE_PELVIS),
];
const BESIDE_BARRIER: &[Region] = &[region("Head", 2.0, &[criterion(EXCURSION, Scale::Beside("Main-AEMDB"))])];
const BESIDE_POLE: &[Region] = &[region("Head", 2.0, &[criterion(EXCURSION, Scale::Beside("Main-Pole"))])];
const FAR_SIDE: &[Occupant] = &[
    occupant("Pole-32", "Driver", WORLDSID_50_FAR_SIDE, &[region("Head", 2.0, FAR_SIDE_POLE_HEAD)]),
    occupant("Pole-32", "Front Passenger", WORLDSID_50_FAR_SIDE, &[region("Head", 2.0, FAR_SIDE_POLE_HEAD)]),
    occupant("Main-AEMDB", "Driver", WORLDSID_50, FAR_SIDE_MAIN),
    occupant("Main-Pole", "Driver", WORLDSID_50, FAR_SIDE_MAIN),
    occupant("Robustness-AEMDB60", "Driver", WORLDSID_50, BESIDE_BARRIER),
    occupant("Robustness-AEMDB75high", "Driver", WORLDSID_50, BESIDE_BARRIER),
    occupant("Robustness-AEMDB90", "Driver", WORLDSID_50, BESIDE_BARRIER),
    occupant("Robustness-AEMDB90high", "Driver", WORLDSID_50, BESIDE_BARRIER),
    occupant("Robustness-Pole75high", "Driver", WORLDSID_50, BESIDE_POLE),
    occupant("Robustness-Pole90", "Driver", WORLDSID_50, BESIDE_POLE),
];
