//! What fills a criterion: a value, or the reason why it is blank; and which measure it is made of.

use super::far_side::{COUNTERMEASURE, EXCURSION, RED_LINE};
use crate::injury::Measure;
use crate::signal::STANDARD_GRAVITY_MPS2;

/// A value of a criterion in the unit of its table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Entry {
    /// The value; none for a blank.
    pub value: Option<f64>,
    /// Reason for a blank, or a remark on the value.
    pub remark: Option<String>,
    /// Whether a caveat applies to the value, and so to what is made of it.
    pub doubtful: bool,
}

/// A unit of the tables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scaled {
    /// Symbol.
    pub symbol: &'static str,
    /// SI units in one.
    pub factor: f64,
}

const NUMBER: Scaled = Scaled { symbol: "", factor: 1.0 };
const PERCENT: Scaled = Scaled { symbol: "%", factor: 1.0 };
const GRAVITY: Scaled = Scaled { symbol: "g", factor: STANDARD_GRAVITY_MPS2 };
const KILONEWTON: Scaled = Scaled { symbol: "kN", factor: 1e3 };
const NEWTON_METRE: Scaled = Scaled { symbol: "N·m", factor: 1.0 };
const MILLIMETRE: Scaled = Scaled { symbol: "mm", factor: 1e-3 };
const METRE_PER_SECOND: Scaled = Scaled { symbol: "m/s", factor: 1.0 };

/// Measure of a criterion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instrument {
    /// Unit in the tables.
    pub unit: Scaled,
    /// Name of the measure; none if no measure is the criterion.
    pub measure: Option<&'static str>,
    /// Remark on the measure, or reason why there is none.
    pub remark: Option<&'static str>,
}

impl Entry {
    /// A value. One that is not finite is a blank.
    #[must_use]
    pub fn of(value: f64) -> Self {
        if value.is_finite() {
            Entry { value: Some(value), ..Entry::default() }
        } else {
            Entry::blank("not a finite number")
        }
    }

    /// No value, for a reason.
    #[must_use]
    pub fn blank(reason: impl Into<String>) -> Self {
        Entry { remark: Some(reason.into()), ..Entry::default() }
    }

    /// The criterion `name` of a region from measures; `spoils` says whether a caveat applies to a measure.
    #[must_use]
    pub fn from_measures(region: &str, name: &str, measures: &[Measure], spoils: &dyn Fn(&Measure) -> bool) -> Self {
        let instrument = instrument(region, name);
        let Some(wanted) = instrument.measure else {
            return Entry::blank(instrument.remark.unwrap_or("no measure of this program"));
        };
        let Some(measure) = measures.iter().find(|measure| measure.name == wanted) else {
            return Entry::blank(format!("no {wanted}: the body or the test has no such instrument"));
        };
        let remark = || measure.remark.clone().unwrap_or_else(|| format!("no {wanted}"));
        let entry = measure.value.map_or_else(|| Entry::blank(remark()), |v| Entry::of(v / instrument.unit.factor));
        let remark = entry.remark.or(instrument.remark.map(str::to_owned));
        Entry { remark, doubtful: entry.value.is_some() && spoils(measure), ..entry }
    }
}

/// A criterion that a measure gives.
const fn by(unit: Scaled, measure: &'static str) -> Instrument {
    Instrument { unit, measure: Some(measure), remark: None }
}

/// A criterion that a measure gives, with a remark.
const fn near(unit: Scaled, measure: &'static str, remark: &'static str) -> Instrument {
    Instrument { unit, measure: Some(measure), remark: Some(remark) }
}

/// A criterion without a measure.
const fn none(unit: Scaled, remark: &'static str) -> Instrument {
    Instrument { unit, measure: None, remark: Some(remark) }
}

const WORST_POINT: &str = "the deepest of the points measured";
const WORST_RIB: &str = "the deepest rib measured";
const SHEAR: &str = "resultant of x and y, at least as large as the x component";
const INSPECTED: &str = "seen by the inspector of the car";
const NO_CELL: &str = "no body here has this instrument";
const BELT: &str = "a force of the belt, not of the body: give it with --values";
const COLOUR: &str = "a colour by lines of the car: give it with --values";
const LATERAL: &str = "the lateral moment, which no measure here is";
const LOWER: &str = "a load of the lower neck, which no measure here is";
const LUMBAR: &str = "a load of the lumbar spine, which no measure here is";
const DURATION: &str = "rated by its duration, which no measure here does";

/// Unit and measure of each criterion of the tables, by its name, and by its region where that decides.
const INSTRUMENTS: &[(&str, &str, Instrument)] = &[
    ("Chest", "Ares-3ms", by(GRAVITY, "chest_3ms_cumulative")),
    ("Chest", "Viscous Criterion", by(METRE_PER_SECOND, "rib_viscous_criterion")),
    ("Abdomen", "Viscous Criterion", by(METRE_PER_SECOND, "abdomen_rib_viscous_criterion")),
    ("", "Ares", by(GRAVITY, "head_peak")),
    ("", "HIC15", by(NUMBER, "hic15")),
    ("", "HIC36", by(NUMBER, "hic36")),
    ("", "Ares-3ms", by(GRAVITY, "head_3ms_cumulative")),
    ("", "Fx,shear", near(KILONEWTON, "neck_shear", SHEAR)),
    ("", "Fz,tension", by(KILONEWTON, "neck_tension")),
    ("", "Fz,compression", by(KILONEWTON, "neck_compression")),
    ("", "My,extension", by(NEWTON_METRE, "neck_extension")),
    ("", "Fx,shear over time", none(NUMBER, DURATION)),
    ("", "Fz,tension over time", none(NUMBER, DURATION)),
    ("", "Fz,compression over time", none(NUMBER, DURATION)),
    ("", "Fx,shear over time, % of points", none(PERCENT, DURATION)),
    ("", "Fz,tension over time, % of points", none(PERCENT, DURATION)),
    ("", "Ffemur over time, right, % of points", none(PERCENT, DURATION)),
    ("", "Ffemur over time, left, % of points", none(PERCENT, DURATION)),
    ("", "Nij", by(NUMBER, "nij")),
    ("", "DAMAGE", by(NUMBER, "damage")),
    ("", "Dchest compression", by(MILLIMETRE, "chest_deflection")),
    ("", "Dchest compression, upper right", near(MILLIMETRE, "chest_deflection", WORST_POINT)),
    ("", "Dchest compression, upper left", near(MILLIMETRE, "chest_deflection", WORST_POINT)),
    ("", "Dchest compression, lower right", near(MILLIMETRE, "chest_deflection", WORST_POINT)),
    ("", "Dchest compression, lower left", near(MILLIMETRE, "chest_deflection", WORST_POINT)),
    ("", "Dchest compression, top", near(MILLIMETRE, "rib_deflection", WORST_RIB)),
    ("", "Dchest compression, middle", near(MILLIMETRE, "rib_deflection", WORST_RIB)),
    ("", "Dchest compression, bottom", near(MILLIMETRE, "rib_deflection", WORST_RIB)),
    ("", "Dabdomen compression, top", near(MILLIMETRE, "abdomen_rib_deflection", WORST_RIB)),
    ("", "Dabdomen compression, bottom", near(MILLIMETRE, "abdomen_rib_deflection", WORST_RIB)),
    ("", "Dabdomen compression, right", none(MILLIMETRE, NO_CELL)),
    ("", "Dabdomen compression, left", none(MILLIMETRE, NO_CELL)),
    ("", "Dchest compression, rate", by(METRE_PER_SECOND, "deflection_rate")),
    (
        "",
        "Chest index",
        near(MILLIMETRE, "chest_deflection", "the deflection: the belt lies at most 17 mm above the sternum's gauge"),
    ),
    ("", "Viscous Criterion", by(METRE_PER_SECOND, "viscous_criterion")),
    ("", "Chest acceleration, 3 ms", by(GRAVITY, "chest_3ms_cumulative")),
    ("", "Shoulder belt load", none(KILONEWTON, BELT)),
    ("", "Facetabulum, right", none(KILONEWTON, NO_CELL)),
    ("", "Facetabulum, left", none(KILONEWTON, NO_CELL)),
    ("", "Ffemur, right", by(KILONEWTON, "right_femur")),
    ("", "Ffemur, left", by(KILONEWTON, "left_femur")),
    ("", "Ffemur over time, right", by(NUMBER, "right_femur_duration_use")),
    ("", "Ffemur over time, left", by(NUMBER, "left_femur_duration_use")),
    ("", "Knee, thigh, hip, right", none(NUMBER, "rated by force and impulse of the femur together")),
    ("", "Knee, thigh, hip, left", none(NUMBER, "rated by force and impulse of the femur together")),
    ("", "Dknee, right", none(MILLIMETRE, NO_CELL)),
    ("", "Dknee, left", none(MILLIMETRE, NO_CELL)),
    ("", "Itibia, right", by(NUMBER, "right_tibia_index")),
    ("", "Itibia, left", by(NUMBER, "left_tibia_index")),
    ("", "Ftibia, right", by(KILONEWTON, "right_tibia_compression")),
    ("", "Ftibia, left", by(KILONEWTON, "left_tibia_compression")),
    ("", "Foot acceleration", none(GRAVITY, NO_CELL)),
    ("", "Pedal displacement - rearward", none(MILLIMETRE, INSPECTED)),
    ("", "Pedal displacement - vertical", none(MILLIMETRE, INSPECTED)),
    ("", "Pedal blocking", none(MILLIMETRE, INSPECTED)),
    ("", "Direct contact with pole", none(NUMBER, INSPECTED)),
    ("", "Shoulder load", by(KILONEWTON, "shoulder_force")),
    ("", "Fpubic symphysis", by(KILONEWTON, "pubic_force")),
    ("", "Facetabulum and ilium", by(KILONEWTON, "pelvis_force")),
    ("", "Rib deflection", by(MILLIMETRE, "rib_deflection")),
    ("", "Rib deflection, mean", none(MILLIMETRE, "the mean of five ribs, which no measure here is")),
    ("", "Rib deflection, rate", none(METRE_PER_SECOND, "no measure of this program")),
    ("", "Rib viscous criterion", by(METRE_PER_SECOND, "rib_viscous_criterion")),
    ("", "Lower spine, peak", by(GRAVITY, "lower_spine_peak")),
    ("", "Fabdomen", by(KILONEWTON, "abdomen_force")),
    ("", "Lower legs of the other tests", none(PERCENT, "the worst lower legs of the other frontal tests decide")),
    ("", EXCURSION, none(NUMBER, COLOUR)),
    ("", COUNTERMEASURE, none(NUMBER, INSPECTED)),
    ("", RED_LINE, none(NUMBER, INSPECTED)),
    ("", "Ftension, upper", by(KILONEWTON, "neck_tension")),
    ("", "Mflexion, upper", none(NEWTON_METRE, LATERAL)),
    ("", "Mextension, upper", by(NEWTON_METRE, "neck_extension")),
    ("", "Ftension, lower", none(KILONEWTON, LOWER)),
    ("", "Mflexion, lower", none(NEWTON_METRE, LOWER)),
    ("", "Mextension, lower", none(NEWTON_METRE, LOWER)),
    ("", "Fy lumbar", none(KILONEWTON, LUMBAR)),
    ("", "Fz lumbar", none(KILONEWTON, LUMBAR)),
    ("", "Mx lumbar", none(NEWTON_METRE, LUMBAR)),
    ("", "Inspection [%]", none(PERCENT, INSPECTED)),
];

/// Unit and measure of a criterion of a region.
#[must_use]
pub fn instrument(region: &str, name: &str) -> Instrument {
    let fits = |of: &&(&str, &str, Instrument)| of.1 == name && (of.0.is_empty() || of.0 == region);
    INSTRUMENTS.iter().find(fits).map_or(none(NUMBER, "no measure of this program"), |(_, _, found)| *found)
}
