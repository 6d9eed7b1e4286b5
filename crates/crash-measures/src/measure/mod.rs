//! Measures of injury and of occupant risk, from signals alone.
//!
//! Every function takes samples in SI with one interval, assumes the channel filtered as its page
//! says (see [`crate::signal`]), and returns a value with its unit in the name and the time where it
//! stands, counted from the first sample. Formulas were collected from open sources that cite the
//! standards; the standards themselves were not at hand, so nothing here claims to be their text.
//!
//! A criterion knows for which dummy it was made: constants come by [`Dummy`], and none are given for one that has no such
//! criterion. Of a person a dummy's criterion is a yardstick to compare runs by.

pub mod asi;
pub mod bric;
pub mod damage;
pub mod dummy;
pub mod femur;
pub mod flail_space;
pub mod hic;
pub mod limits;
pub mod max_average;
pub mod neck;
pub mod olc;
pub mod peak;
pub mod risk;
pub mod severity_index;
pub mod side;
pub mod thiv;
pub mod thorax;
pub mod three_ms;
pub mod tibia;
pub mod whiplash;

pub use asi::{Asi, AsiEdition, SeverityClass, asi};
pub use bric::{Bric, BricBasis, bric};
pub use damage::damage;
pub use dummy::{Blow, Dummy};
pub use femur::{DurationLimit, DurationUse, duration_use};
pub use flail_space::{FlailDistances, FlailSpace, flail_space};
pub use hic::{Hic, HicWindow, hic, hic_d};
pub use limits::{Basis, Grade, LIMITS, Limit, Quantity, Rule, Verdict, limits};
pub use max_average::max_50ms_average;
pub use neck::{NeckIntercepts, NeckMode, Nij, condyle_moment, nij};
pub use olc::{Olc, olc};
pub use peak::{Peak, largest_magnitude, maximum, minimum, peak_towards};
pub use risk::Severity;
pub use severity_index::severity_index;
pub use side::force_sum;
pub use thiv::{HeadFlight, Thiv, thiv};
pub use thorax::{
    ChestSize, Compression, DeepestRib, FourPoints, ThoracicIntercepts, combined_thoracic_index, compression,
    deepest_rib, deflection_rate, pc_score, viscous_criterion,
};
pub use three_ms::{
    ThreeMs, clip_contiguous, clip_cumulative, three_ms_both, three_ms_contiguous, three_ms_cumulative,
};
pub use tibia::{TibiaCriticals, straight_moment, tibia_index};
pub use whiplash::{HeadContact, Nic, Nkm, NkmIntercepts, head_restraint_contact, nic, nkm, rebound_speed};

#[cfg(test)]
mod tests {
    mod any_input;
}
