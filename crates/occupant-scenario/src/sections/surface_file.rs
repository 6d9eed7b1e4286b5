//! Surface files: the material of one real surface, what of it was measured, and where it comes from.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::materials::MaterialSection;
use super::quantity::{NOT_NEGATIVE, POSITIVE};
use super::{Angle, Force, Length, Mass, Ratio, Speed, Stiffness};
use crate::kind::UnitSystem;

/// A real surface. `occupant surface` makes one from a record; a scenario takes it by `file` of a material.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SurfaceFile {
    /// What it is, in one line, such as "knee bolster of a 1994 sedan, left".
    pub(crate) title: String,
    /// Units of bare numbers; "si" if absent.
    pub(crate) units: Option<UnitSystem>,
    /// What it does in contact: the keys of `materials.NAME` of a scenario.
    pub(crate) material: MaterialSection,
    /// What of it was measured.
    pub(crate) measured: MeasuredSection,
    /// Where it comes from.
    pub(crate) provenance: OriginSection,
    /// 95 % intervals of fitted numbers.
    pub(crate) intervals: Option<IntervalSection>,
    /// How the fitted surface reproduces the record.
    pub(crate) agreement: Option<AgreementSection>,
}

/// What stands behind the parts of a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MeasuredSection {
    /// Force over depth while the depth grows.
    pub(crate) loading: Basis,
    /// Force on the way back. If "not_measured", the scenario gives `returned`, `unload_slope` or another way back.
    pub(crate) unloading: Basis,
    /// Friction. If "not_measured", the scenario gives `friction`.
    pub(crate) friction: Basis,
}

/// What stands behind a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Basis {
    /// Computed from a record.
    Measured,
    /// Read off a printed curve or table.
    Digitised,
    /// An estimate.
    MadeUp,
    /// Not known: the key is absent.
    NotMeasured,
}

/// The test and its source.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct OriginSection {
    /// Who measured it and where that is published: author, year, report number, figure or table; or the record and its owner.
    pub(crate) source: String,
    /// The part: make, model, year, place, how it was held.
    pub(crate) specimen: Option<String>,
    /// The impactor in words: form, face, guided or free.
    pub(crate) impactor: Option<String>,
    /// Its mass.
    pub(crate) mass: Option<Mass<POSITIVE>>,
    /// Radius of its face. A curve holds for this impactor: a larger or flatter one meets more force at the same depth.
    pub(crate) radius: Option<Length<POSITIVE>>,
    /// Speed at first contact.
    pub(crate) speed: Option<Speed<NOT_NEGATIVE>>,
    /// Angle between the velocity and the normal of the surface; 0 if absent.
    pub(crate) angle: Option<Angle>,
    /// When it was measured.
    pub(crate) date: Option<String>,
    /// What others may do with it, such as "CC0-1.0".
    pub(crate) licence: Option<String>,
    /// SHA-256 of the record.
    pub(crate) record_sha256: Option<String>,
    /// What is to be known before it is used.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) caveats: Vec<String>,
}

/// Least and greatest value of each fitted number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct IntervalSection {
    /// Of the force at each depth.
    pub(crate) force: Option<Vec<[Force; 2]>>,
    /// Of `returned`.
    pub(crate) returned: Option<[Ratio<NOT_NEGATIVE>; 2]>,
    /// Of `unload_slope`.
    pub(crate) unload_slope: Option<[Stiffness<NOT_NEGATIVE>; 2]>,
    /// Of `friction`.
    pub(crate) friction: Option<[Ratio; 2]>,
}

/// The impactor against the fitted surface, computed, and the record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct AgreementSection {
    /// Computed peak force over the measured one.
    pub(crate) peak_ratio: Ratio<NOT_NEGATIVE>,
    /// Computed greatest depth over that of the record.
    pub(crate) depth_ratio: Ratio<NOT_NEGATIVE>,
    /// Computed work that is lost over that of the record; absent if there is no rebound.
    pub(crate) lost_ratio: Option<Ratio<NOT_NEGATIVE>>,
    /// Root mean square difference of the forces over the measured peak.
    pub(crate) residual: Ratio<NOT_NEGATIVE>,
}
