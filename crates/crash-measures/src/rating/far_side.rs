//! Far side of Euro NCAP 2026: colours of the head's excursion, and caps that reach other cases.

use super::Scale;
use super::rate::RatedOccupant;

/// Colours of the head's excursion, the best first. Their place in this list is the value of the criterion.
pub const COLOURS: [&str; 5] = ["Green", "Yellow", "Orange", "Red", "Capping"];
/// Place of the last colour.
const CAPPING: usize = COLOURS.len() - 1;

/// The criterion of the colour.
pub(super) const EXCURSION: &str = "Farside excursion";
/// Whether the car has a countermeasure, such as a bag between the seats.
pub(super) const COUNTERMEASURE: &str = "Countermeasure?";
/// Whether the red line lies far out.
pub(super) const RED_LINE: &str = "Red line >125 mm outboard of the orange line ?";

/// Place of the colour of a value.
pub(super) fn colour(value: f64) -> usize {
    value.clamp(0.0, CAPPING as f64).round() as usize
}

/// Whether a colour takes all points.
pub(super) fn caps(value: f64) -> bool {
    colour(value) == CAPPING
}

/// Percent of the points of a main case by its colour.
pub(super) fn worth(value: f64, has_countermeasure: bool, is_red_far: bool) -> f64 {
    match (colour(value), has_countermeasure) {
        (0, _) | (1, true) => 100.0,
        (2, true) => 75.0,
        (1, false) => 50.0,
        (3, true) if is_red_far => 50.0,
        (2, false) | (3, true) => 25.0,
        _ => 0.0,
    }
}

/// Percent of the points of a robustness case: all if its colour is that of the main case or next to it. Nothing is
/// next to capping.
pub(super) fn worth_beside(value: f64, main: f64) -> f64 {
    let (own, main) = (colour(value), colour(main));
    let is_near = own == main || own.abs_diff(main) == 1 && own.max(main) < CAPPING;
    if is_near { 100.0 } else { 0.0 }
}

/// A load that caps a main case takes the points of main and robustness cases, a colour those of the main cases.
pub(super) fn share_caps(occupants: &mut [RatedOccupant]) {
    let is_main = |scale: &Scale| matches!(scale, Scale::Excursion);
    let is_either = |scale: &Scale| matches!(scale, Scale::Excursion | Scale::Beside(_));
    let criteria =
        |own: &RatedOccupant| own.regions.iter().flat_map(|region| region.criteria.clone()).collect::<Vec<_>>();
    let caps: Vec<_> = occupants.iter().flat_map(criteria).filter(|own| own.capped).collect();
    let is_doubtful = caps.iter().any(|own| own.entry.doubtful);
    let by_load = caps.iter().any(|own| !is_main(&own.criterion.scale));
    for own in occupants {
        let mut scales = own.occupant.regions.iter().flat_map(|region| region.criteria).map(|own| &own.scale);
        let is_reached = if by_load { scales.any(is_either) } else { !caps.is_empty() && scales.any(is_main) };
        if is_reached {
            own.cap();
            own.doubtful |= is_doubtful;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_countermeasure_and_a_far_red_line_are_worth_points() {
        let of = |countermeasure, far| [0.0, 1.0, 2.0, 3.0, 4.0].map(|value| worth(value, countermeasure, far));
        assert_eq!(of(false, false), [100.0, 50.0, 25.0, 0.0, 0.0]);
        assert_eq!(of(false, true), of(false, false));
        assert_eq!(of(true, false), [100.0, 100.0, 75.0, 25.0, 0.0]);
        assert_eq!(of(true, true), [100.0, 100.0, 75.0, 50.0, 0.0]);
    }

    #[test]
    fn a_robust_colour_is_at_most_one_off() {
        let of = |main| [0.0, 1.0, 2.0, 3.0, 4.0].map(|value| worth_beside(value, main) > 0.0);
        assert_eq!(of(0.0), [true, true, false, false, false]);
        assert_eq!(of(2.0), [false, true, true, true, false]);
        assert_eq!(of(3.0), [false, false, true, true, false]);
        assert_eq!(of(4.0), [false, false, false, false, true]);
    }
}
