//! US NCAP: stars from the joint risk of head, neck, chest and femur, or of head, chest, abdomen and pelvis.

use super::super::scale::{Criterion, risk};
use super::super::{Method, Occupant, Rating, Region, Test, Total, region};
use crate::measure::risk::{
    abdomen_force_risk, chest_deflection_risk, femur_risk, hic_risk, neck_axial_risk, nij_risk, pelvis_force_risk,
    rib_deflection_risk,
};
use crate::measure::{Blow, Dummy, Severity};

use Dummy::{Es2Re, HybridIii5F, HybridIii50M, SidIis};
use Severity::{Ais2, Ais3};

const SOURCE: &str = "NHTSA, New Car Assessment Program, 73 FR 40016, July 2008: curves as read in open programs that cite the SafetyCompanion 2023/24, bounds of the stars as read in pyisomme 1.1.0";
const REMARK: &str =
    "Stars of one occupant in one test; NHTSA averages the tests of a car and adds its rollover resistance.";

const HEAD: &[Criterion] = &[risk("HIC15", |hic| hic_risk(hic, Ais3))];
const HEAD_SIDE: &[Criterion] = &[risk("HIC36", |hic| hic_risk(hic, Ais3))];
const NECK_50M: &[Criterion] = &[
    risk("Nij", |nij| nij_risk(nij, Ais3, HybridIii50M)),
    risk("Fz,tension", |force| neck_axial_risk(force, HybridIii50M)),
    risk("Fz,compression", |force| neck_axial_risk(force, HybridIii50M)),
];
const NECK_5F: &[Criterion] = &[
    risk("Nij", |nij| nij_risk(nij, Ais3, HybridIii5F)),
    risk("Fz,tension", |force| neck_axial_risk(force, HybridIii5F)),
    risk("Fz,compression", |force| neck_axial_risk(force, HybridIii5F)),
];
const CHEST_50M: &[Criterion] = &[risk("Dchest compression", |depth| chest_deflection_risk(depth, HybridIii50M))];
const CHEST_5F: &[Criterion] = &[risk("Dchest compression", |depth| chest_deflection_risk(depth, HybridIii5F))];
const FEMUR_50M: &[Criterion] = &[
    risk("Ffemur, right", |force| femur_risk(force, HybridIii50M)),
    risk("Ffemur, left", |force| femur_risk(force, HybridIii50M)),
];
const FEMUR_5F: &[Criterion] = &[
    risk("Ffemur, right", |force| femur_risk(force, HybridIii5F)),
    risk("Ffemur, left", |force| femur_risk(force, HybridIii5F)),
];
const RIBS: &[Criterion] = &[risk("Rib deflection", |depth| rib_deflection_risk(depth, Es2Re))];
const ABDOMEN: &[Criterion] = &[risk("Fabdomen", |force| abdomen_force_risk(force, Es2Re))];
const PUBIS: &[Criterion] = &[risk("Fpubic symphysis", |force| pelvis_force_risk(force, Ais3, Es2Re))];
const PELVIS: &[Criterion] = &[risk("Facetabulum and ilium", |force| pelvis_force_risk(force, Ais2, SidIis))];

const fn occupant(
    case: &'static str,
    seat: &'static str,
    label: &'static str,
    dummy: Dummy,
    regions: &'static [Region],
) -> Occupant {
    Occupant { case, seat, label, dummy: Some(dummy), regions }
}

const fn rating(name: &'static str, title: &'static str, blow: Blow, tests: &'static [Test]) -> Rating {
    Rating { name, title, source: SOURCE, remark: REMARK, blow, method: Method::Stars, tests }
}

/// The ratings of this program.
pub(super) const RATINGS: [Rating; 2] = [
    rating(
        "us-ncap-frontal",
        "US NCAP 2011, frontal, 56 km/h",
        Blow::Front,
        &[Test {
            name: "rigid wall, 56 km/h",
            occupants: &[
                occupant(
                    "",
                    "Driver",
                    "Hybrid III 50M",
                    HybridIii50M,
                    &[
                        region("Head", 0.0, HEAD),
                        region("Neck", 0.0, NECK_50M),
                        region("Chest", 0.0, CHEST_50M),
                        region("Femur", 0.0, FEMUR_50M),
                    ],
                ),
                occupant(
                    "",
                    "Front Passenger",
                    "Hybrid III 5F",
                    HybridIii5F,
                    &[
                        region("Head", 0.0, HEAD),
                        region("Neck", 0.0, NECK_5F),
                        region("Chest", 0.0, CHEST_5F),
                        region("Femur", 0.0, FEMUR_5F),
                    ],
                ),
            ],
            total: Total::Apart,
        }],
    ),
    rating(
        "us-ncap-side",
        "US NCAP 2011, side, barrier and pole",
        Blow::Side,
        &[Test {
            name: "side",
            occupants: &[
                occupant(
                    "barrier",
                    "Driver",
                    "ES-2re",
                    Es2Re,
                    &[
                        region("Head", 0.0, HEAD_SIDE),
                        region("Chest", 0.0, RIBS),
                        region("Abdomen", 0.0, ABDOMEN),
                        region("Pelvis", 0.0, PUBIS),
                    ],
                ),
                occupant(
                    "barrier",
                    "Rear Passenger",
                    "SID-IIs",
                    SidIis,
                    &[region("Head", 0.0, HEAD_SIDE), region("Pelvis", 0.0, PELVIS)],
                ),
                occupant(
                    "pole",
                    "Driver",
                    "SID-IIs",
                    SidIis,
                    &[region("Head", 0.0, HEAD_SIDE), region("Pelvis", 0.0, PELVIS)],
                ),
            ],
            total: Total::Apart,
        }],
    ),
];
