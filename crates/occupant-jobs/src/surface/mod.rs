//! A surface from the record of one impact: force over depth, the way back and friction, each with its certainty.
//!
//! ```text
//! record ─ columns ─ contact (when, how deep) ─ curve (as many points as it bears) ─ certainty ─ surface file, plot, words
//! ```
//!
//! The impactor is a mass that meets the surface at a known speed: m ẍ = m g − F, twice integrated, is its depth, unless that
//! was measured. The law is one of those that materials have: straight lines, and on the way back a share of the work or a slope.

mod certainty;
mod contact;
mod curve;
mod depth;
mod law;
mod record;
mod text;

use crate::base::Failure;
use occupant_files::signals::Recording;

pub use certainty::Certainty;
pub use contact::Contact;
pub use law::{Back, Law};
pub use text::Origin;

/// Data of the impactor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Impactor {
    /// Mass, kg; needed unless force and depth were measured.
    pub mass_kg: Option<f64>,
    /// Speed at first contact, m/s; needed unless the depth was measured.
    pub speed_m_s: Option<f64>,
    /// Half width of its 95 % interval, m/s.
    pub speed_error_m_s: f64,
    /// Gravity component into the surface, m/s²: 0 for a horizontal impact.
    pub gravity_m_s2: f64,
    /// Angle between velocity and normal, rad.
    pub angle_rad: f64,
}

/// A fitted surface.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Loading and unloading.
    pub law: Law,
    /// Friction coefficient; none if not measured.
    pub friction: Option<f64>,
    /// 95 % intervals.
    pub certainty: Certainty,
    /// Contact in the record.
    pub contact: Contact,
    /// Computed depth, m, and force, N, of the impactor at the times of the contact.
    pub computed: Vec<[f64; 2]>,
    /// Agreement with the record.
    pub agreement: Agreement,
    /// Caveats.
    pub caveats: Vec<String>,
}

/// Agreement of the fitted surface with the record; ratios are computed over measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    /// Ratio of peak forces.
    pub peak_ratio: f64,
    /// Ratio of greatest depths.
    pub depth_ratio: f64,
    /// Ratio of dissipated work; none if unloading was not recorded.
    pub lost_ratio: Option<f64>,
    /// RMS difference of the forces, relative to the peak.
    pub residual: f64,
}

/// The surface fitted to a record, between two times, s.
///
/// # Errors
/// Columns without units or that cannot be told apart; no contact; an impactor that is not stopped, or comes back faster
/// than it went in; numbers of the impactor that are missing.
pub fn fit(recording: &Recording, impactor: &Impactor, window_s: [Option<f64>; 2]) -> Result<Surface, Failure> {
    let record = record::Record::of(recording, impactor, window_s)?;
    let choices = curve::choices(impactor, &Contact::of(&record, impactor)?)?;
    let law = curve::law(&choices[0].shape, &choices[0].contact);
    let contact = choices[0].contact.clone();
    if law.points.len() < 2 || law.points.windows(2).any(|pair| pair[1][0] <= pair[0][0]) {
        let found = format!("the depth does not grow with the force: {:.3} mm at the end", 1e3 * contact.greatest_m());
        return Err(refuse(found, "check the column of the depth and its sign, mass, speed and units"));
    }
    let friction = contact.friction(&record, impactor);
    let certainty = certainty::of(&record, impactor, &choices, &law);
    let computed = law::computed(&law, &contact, impactor);
    let agreement = law::agreement(&law, &contact, &computed);
    let mut caveats = [recording.notes.clone(), contact.caveats.clone()].concat();
    caveats.extend(friction.as_ref().and_then(|found| found.clone().err()));
    caveats.extend(text::cautions(&law, &contact, &agreement));
    Ok(Surface { law, friction: friction.and_then(Result::ok), certainty, contact, computed, agreement, caveats })
}

fn refuse(found: impl Into<String>, help: &str) -> Failure {
    Failure::with_help(found, help)
}
