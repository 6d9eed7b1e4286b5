//! Contact time of the head with its restraint.

use crate::signal::{SignalError, require_positive, require_samples};

/// Definition of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RestraintContact {
    /// Force above which there is contact, N.
    pub least_n: f64,
    /// Shortest duration of a contact, s.
    pub shortest_s: f64,
    /// Longest gap within a contact, s.
    pub longest_gap_s: f64,
}

impl Default for RestraintContact {
    /// As in Euro NCAP's whiplash test: more than 40 ms, gaps up to 1 ms (from memory); from 1 N, our value: a test
    /// uses a foil that closes a circuit.
    fn default() -> Self {
        Self { least_n: 1.0, shortest_s: 0.040, longest_gap_s: 0.001 }
    }
}

/// The first lasting contact of head and restraint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeadContact {
    /// T-HRC(start), s: the start of a straight line through the first two samples in contact, not before the last sample
    /// without contact.
    pub start_s: f64,
    /// T-HRC(end), s: the last sample in contact; that of the record if the contact does not end.
    pub end_s: f64,
}

/// The first contact in the force between head and restraint, N (magnitudes); none if there is none.
///
/// # Errors
/// No sample, a sample that is not finite, an interval or force that is not positive, a duration that is negative.
pub fn head_restraint_contact(
    force_n: &[f64],
    dt_s: f64,
    rule: &RestraintContact,
) -> Result<Option<HeadContact>, SignalError> {
    require_samples("force of the head restraint", force_n, dt_s, 1)?;
    require_positive("least force of a contact (N)", rule.least_n)?;
    for (what, found) in
        [("shortest contact (s)", rule.shortest_s), ("longest gap of a contact (s)", rule.longest_gap_s)]
    {
        if !(found.is_finite() && found >= 0.0) {
            return Err(SignalError::OutOfRange { what, found, expected: "a number, zero or more" });
        }
    }
    let counts = |c: &HeadContact| c.end_s - c.start_s > rule.shortest_s * (1.0 - 1e-9);
    let mut open = None::<HeadContact>;
    for time_s in touches(force_n, dt_s, rule.least_n) {
        open = match open {
            Some(known) if time_s - known.end_s <= rule.longest_gap_s * (1.0 + 1e-9) + dt_s => {
                Some(HeadContact { end_s: time_s, ..known })
            }
            Some(known) if counts(&known) => return Ok(Some(begun(force_n, dt_s, rule.least_n, known))),
            _ => Some(HeadContact { start_s: time_s, end_s: time_s }),
        };
    }
    Ok(open.filter(counts).map(|known| begun(force_n, dt_s, rule.least_n, known)))
}

/// A contact with its start between samples: a start on samples would move by one with every other sample left out.
fn begun(force_n: &[f64], dt_s: f64, least_n: f64, known: HeadContact) -> HeadContact {
    let first = (known.start_s / dt_s).round() as usize;
    let (Some(here), Some(next)) = (force_n.get(first), force_n.get(first + 1)) else { return known };
    let slope = next.abs() - here.abs();
    if first == 0 || slope <= 0.0 {
        return known;
    }
    let before = ((here.abs() - least_n) / slope).min(1.0);
    HeadContact { start_s: (first as f64 - before) * dt_s, ..known }
}

/// Times of the samples in contact.
fn touches(force_n: &[f64], dt_s: f64, least_n: f64) -> impl Iterator<Item = f64> {
    let all = force_n.iter().enumerate();
    all.filter(move |(_, force)| force.abs() >= least_n).map(move |(i, _)| i as f64 * dt_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT_S: f64 = 1e-3;

    /// Contact at these milliseconds of 200.
    fn touching(during: &[std::ops::RangeInclusive<usize>]) -> Vec<f64> {
        (0..200).map(|i| if during.iter().any(|ms| ms.contains(&i)) { -50.0 } else { 0.0 }).collect()
    }

    fn found(during: &[std::ops::RangeInclusive<usize>]) -> Option<[f64; 2]> {
        let found = head_restraint_contact(&touching(during), DT_S, &RestraintContact::default()).unwrap();
        found.map(|c| [c.start_s, c.end_s].map(|s| (1e3 * s).round()))
    }

    #[test]
    fn a_touch_is_no_contact_and_a_short_gap_does_not_end_one() {
        assert_eq!(found(&[60..=120]), Some([60.0, 120.0]));
        assert_eq!(found(&[40..=45, 60..=120]), Some([60.0, 120.0]));
        // one sample without force: a gap of 1 ms
        assert_eq!(found(&[60..=70, 72..=120]), Some([60.0, 120.0]));
        // three of them begin anew
        assert_eq!(found(&[60..=70, 74..=120]), Some([74.0, 120.0]));
        // the first that lasts counts, the rest of the record too
        assert_eq!(found(&[60..=120, 150..=199]), Some([60.0, 120.0]));
        assert_eq!(found(&[150..=199]), Some([150.0, 199.0]));
        assert_eq!(found(&[60..=80]), None);
        assert_eq!(found(&[]), None);
    }

    /// A force that rises in a line from 60.3 ms on, read every 1 ms and every 2 ms.
    #[test]
    fn a_contact_begins_between_samples() {
        for step in [1, 2] {
            let dt_s = step as f64 * DT_S;
            let force: Vec<f64> =
                (0..=200 / step).map(|i| 1e5 * ((i * step) as f64 * DT_S - 0.0603).max(0.0)).collect();
            let found = head_restraint_contact(&force, dt_s, &RestraintContact::default()).unwrap().unwrap();
            assert!((found.start_s - 0.06031).abs() < 1e-12, "{}", found.start_s);
        }
    }

    #[test]
    fn unusable_rules_are_named() {
        let rule = RestraintContact::default();
        let of = |rule| head_restraint_contact(&[1.0; 9], DT_S, &rule);
        assert!(matches!(of(RestraintContact { least_n: 0.0, ..rule }), Err(SignalError::OutOfRange { .. })));
        assert!(matches!(of(RestraintContact { shortest_s: -1.0, ..rule }), Err(SignalError::OutOfRange { .. })));
        assert!(matches!(
            of(RestraintContact { longest_gap_s: f64::NAN, ..rule }),
            Err(SignalError::OutOfRange { .. })
        ));
        assert!(head_restraint_contact(&[], DT_S, &rule).is_err());
    }
}
