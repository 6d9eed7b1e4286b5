//! Variation of segment lengths among people of one sex, stature and mass: the residuals of the regressions.

use super::{CT, F, H, LA, LL, LT, MEASURES, N, PARTS, Person, Sex, UA, UL, UT};
use occupant_units::trig;

/// Standard errors of the regressions for the length of each part, mm, of men and of women: for a difference of two
/// heights both, as if the residuals were independent. The survey's own differences are not published; 0 where a length
/// is a single measure.
const ERRORS_MM: [[[f64; 2]; 2]; PARTS] = {
    let trunk = [[10.8, 25.8], [10.5, 23.0]];
    [
        trunk,
        trunk,
        trunk,
        [[0.0, 10.8], [0.0, 10.5]],
        [[6.0, 0.0], [6.3, 0.0]],
        [[25.8, 13.6], [23.0, 16.3]],
        [[13.6, 4.9], [16.3, 4.6]],
        [[8.9, 0.0], [8.3, 0.0]],
        [[10.6, 0.0], [10.3, 0.0]],
        [[14.3, 0.0], [15.2, 0.0]],
    ]
};

/// Parts of the segments, by their names without a side. A head with a neck is treated as a head.
const NAMES: [(&str, usize); 12] = [
    ("lower_torso", LT),
    ("middle_torso", CT),
    ("upper_torso", UT),
    ("neck", N),
    ("head", H),
    ("thigh", UL),
    ("lower_leg", LL),
    ("foot", F),
    ("upper_arm", UA),
    ("forearm", LA),
    ("hand", LA),
    ("clavicle", UT),
];

/// The normal distribution's 95 % quantile.
const QUANTILE_95: f64 = 1.645;

impl Person {
    /// Half width of the 90 % range of such people's lengths, relative to the length: 1.645 standard errors over the
    /// measure that scales the segment. None for a segment with another name.
    pub fn length_band(&self, segment: &str) -> Option<f64> {
        let side = ["left_", "right_"].iter().find_map(|side| segment.strip_prefix(side));
        let part = NAMES.iter().find(|(name, _)| *name == side.unwrap_or(segment))?.1;
        let [first, second] = ERRORS_MM[part][usize::from(self.sex == Sex::Female)];
        Some(QUANTILE_95 * trig::hypot(first, second) / self.measure(&MEASURES[part][2]))
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::super::REFERENCE_PERSON;

    /// By hand: a man of 1773.4 mm and 78.72 kg has a trunk of 537.3 mm, a thigh of 415.6 mm, an upper arm of 338.1 mm.
    #[test]
    fn bands_are_standard_errors_over_lengths() {
        for (segment, expected) in [
            ("upper_torso", 1.645 * 27.97 / 537.3),
            ("left_thigh", 1.645 * 29.16 / 415.6),
            ("right_upper_arm", 1.645 * 10.6 / 338.1),
            ("head", 1.645 * 6.0 / 131.1),
        ] {
            assert_abs_diff_eq!(REFERENCE_PERSON.length_band(segment).unwrap(), expected, epsilon = 1e-4);
        }
        assert_eq!(REFERENCE_PERSON.length_band("tail"), None);
    }

    #[test]
    fn every_segment_of_every_division_has_a_band() {
        use super::super::Division;
        for (division, segments) in
            [(Division::Twelve, 12), (Division::Fifteen, 15), (Division::Seventeen, 17), (Division::Nineteen, 19)]
        {
            let body = REFERENCE_PERSON.body(division).0;
            let bands = body.tree.segment_rows().iter().filter_map(|row| REFERENCE_PERSON.length_band(row.name));
            let bands: Vec<f64> = bands.collect();
            assert!(bands.len() == segments && bands.iter().all(|band| (0.02..0.2).contains(band)), "{bands:?}");
        }
    }
}
