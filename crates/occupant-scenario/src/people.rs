//! Known differences between people and the body of a scenario.

use crate::Loaded;
use occupant_core::body::people::{Person, REFERENCE_PERSON};
use occupant_core::diagnosis::BodyFigures;

/// Presets of children.
const CHILDREN: &str = "a child's segment lengths come from stature and sitting height alone, not from a survey: vary each by at least ±15 % in a study";

impl Loaded {
    /// Adds the variation among people to the figures of a body, for a person's body or a preset that is one: for
    /// lengths that the scenario does not change.
    pub fn compare_with_people(&self, figures: &mut BodyFigures) {
        let Some(section) = &self.scenario.body else { return };
        let preset = section.preset.as_deref();
        figures.weak = preset.filter(|name| name.starts_with("child")).map(|_| CHILDREN);
        let named = preset.and_then(Person::named);
        if named.is_none() && !section.describes_a_person() {
            return;
        }
        let person = section.person(named.unwrap_or(REFERENCE_PERSON));
        let body = person.body(section.division().unwrap_or_default()).0;
        for (row, made) in body.tree.segment_rows().iter().zip(&body.segments) {
            let found = figures.segments.iter_mut().find(|figures| figures.segment == row.name);
            let Some(of) = found.filter(|f| (f.length_m - made.length_m).abs() < 1e-9) else { continue };
            let band = person.length_band(row.name);
            of.length_band_m = band.map(|part| [1.0 - part, 1.0 + part].map(|factor| factor * made.length_m));
        }
    }
}
