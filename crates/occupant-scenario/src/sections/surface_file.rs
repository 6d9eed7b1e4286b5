//! Surface files: the material of one real surface, what of it was measured, and where it comes from.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::materials::MaterialSection;
use super::quantity::{NOT_NEGATIVE, POSITIVE};
use super::{Angle, Force, Length, Mass, Ratio, Speed, Stiffness};
use crate::kind::UnitSystem;

/// A real surface. `occupant surface` makes one from a record; a scenario refers to it by `file` of a material.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SurfaceFile {
    /// Description in one line, such as "knee bolster of a 1994 sedan, left".
    pub(crate) title: String,
    /// Units of bare numbers; "si" if absent.
    pub(crate) units: Option<UnitSystem>,
    /// Contact properties: the keys of `materials.NAME` of a scenario.
    pub(crate) material: MaterialSection,
    /// Basis of each property.
    pub(crate) measured: MeasuredSection,
    /// Provenance.
    pub(crate) provenance: OriginSection,
    /// 95 % intervals of fitted numbers.
    pub(crate) intervals: Option<IntervalSection>,
    /// Agreement of the fitted surface with the record.
    pub(crate) agreement: Option<AgreementSection>,
}

/// Basis of the properties of a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MeasuredSection {
    /// Loading curve.
    pub(crate) loading: Basis,
    /// Unloading. If "not_measured", the scenario gives `returned`, `unload_slope` or another unloading.
    pub(crate) unloading: Basis,
    /// Friction. If "not_measured", the scenario gives `friction`.
    pub(crate) friction: Basis,
}

/// Basis of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Basis {
    /// Computed from a record.
    Measured,
    /// Digitised from a printed curve or table.
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
    /// Author and publication: author, year, report number, figure or table; or the record and its owner.
    pub(crate) source: String,
    /// Specimen: make, model, year, position, mounting.
    pub(crate) specimen: Option<String>,
    /// Description of the impactor: form, face, guided or free.
    pub(crate) impactor: Option<String>,
    /// Its mass.
    pub(crate) mass: Option<Mass<POSITIVE>>,
    /// Radius of its face. A curve is valid for this impactor: a larger or flatter one gives more force at the same
    /// depth.
    pub(crate) radius: Option<Length<POSITIVE>>,
    /// Speed at first contact.
    pub(crate) speed: Option<Speed<NOT_NEGATIVE>>,
    /// Angle between the velocity and the normal of the surface; 0 if absent.
    pub(crate) angle: Option<Angle>,
    /// Date of the measurement.
    pub(crate) date: Option<String>,
    /// Licence for reuse, such as "CC0-1.0".
    pub(crate) licence: Option<String>,
    /// SHA-256 of the record.
    pub(crate) record_sha256: Option<String>,
    /// Caveats.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) caveats: Vec<String>,
}

/// Ranges of the fitted numbers.
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

/// Agreement of the computed impact on the fitted surface with the record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct AgreementSection {
    /// Computed peak force over the measured one.
    pub(crate) peak_ratio: Ratio<NOT_NEGATIVE>,
    /// Computed greatest depth over that of the record.
    pub(crate) depth_ratio: Ratio<NOT_NEGATIVE>,
    /// Computed dissipated work over that of the record; absent if there is no rebound.
    pub(crate) lost_ratio: Option<Ratio<NOT_NEGATIVE>>,
    /// Root mean square difference of the forces over the measured peak.
    pub(crate) residual: Ratio<NOT_NEGATIVE>,
}
