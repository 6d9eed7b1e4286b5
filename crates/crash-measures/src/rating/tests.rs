//! Results by hand.

use super::*;
use std::collections::BTreeSet;

/// A rating of one occupant from values by criterion; all others have `rest`, or are blank.
fn rated(name: &str, place: &str, values: &[(&str, f64)], rest: Option<f64>) -> RatedOccupant {
    let rating = Rating::named(name).unwrap();
    let fill = |_: &Occupant, _: &Region, criterion: &Criterion| {
        let given = values.iter().find(|(known, _)| *known == criterion.name).map(|(_, value)| *value);
        let rest = rest.filter(|_| criterion.name != INSPECTION.name);
        given.or(rest).map_or_else(|| Entry::blank("not given"), Entry::of)
    };
    let found = rating.rate(|own| own.place() == place, fill);
    let [test] = &found.tests[..] else { panic!("{place} of {name}") };
    test.occupants[0].clone()
}

fn points(rated: &RatedOccupant) -> Vec<f64> {
    rated.regions.iter().map(|region| region.outcome.now).collect()
}

const DRIVER: &str = "FWDB-35, Driver, HIII-05";

/// HIC15 600 (40 %), 34 mm (0 %, capped from there), femur 4 kN (40 %: bands 2.6, 3.8, 5, 6.2), legs below their
/// limits.
#[test]
fn the_worst_criterion_decides_a_region_and_a_cap_takes_all() {
    let values = [("Ares", 90.0), ("HIC15", 600.0), ("Ares-3ms", 70.0), ("Ffemur, left", 4.0)];
    let found = rated("euro-ncap-2026-full-width", DRIVER, &values, Some(0.0));
    assert_eq!(points(&found), [0.5, 1.25, 0.5, 1.25]);
    assert_eq!((found.outcome.now, found.outcome.best, found.outcome.of), (3.5, 3.5, Some(5.0)));
    assert_eq!(found.outcome.words(Method::Bands), "3.500 of 5 points");
    let deep = [&values[..], &[("Dchest compression", 34.0)]].concat();
    let found = rated("euro-ncap-2026-full-width", DRIVER, &deep, Some(0.0));
    assert_eq!((points(&found)[1], found.capped, found.outcome.now, found.outcome.best), (0.0, true, 0.0, 0.0));
}

/// Without a hard contact the head has all points, whatever its HIC; but a cap stays a cap.
#[test]
fn without_a_contact_the_head_is_not_asked() {
    let head = |peak: f64, hic: f64| {
        let values = [("Ares", peak), ("HIC15", hic), ("Ares-3ms", 79.0)];
        rated("euro-ncap-2026-full-width", DRIVER, &values, Some(0.0))
    };
    assert_eq!(points(&head(79.99, 650.0))[0], 1.25);
    // 79.995 g are 80.00
    assert_eq!(points(&head(79.995, 650.0))[0], 0.25);
    assert!(head(10.0, 700.0).capped && !head(10.0, 699.99).capped);
    assert_eq!(head(10.0, 650.0).regions[0].criteria[1].worth, None);
}

/// Modifiers take percent off a region: belt 40, pedals 20 and 50, an inspector 25.
#[test]
fn modifiers_and_inspections_are_taken_off() {
    let with = |values: &[(&str, f64)]| points(&rated("euro-ncap-2026-full-width", DRIVER, values, Some(0.0)));
    assert_eq!(with(&[("Shoulder belt load", 6.0)])[1], 0.75);
    assert_eq!(with(&[("Pedal displacement - rearward", 100.0), ("Pedal blocking", 50.0)])[3], 0.375);
    assert_eq!(with(&[("Inspection [%]", 25.0)]), [0.9375; 4]);
    assert_eq!(with(&[("Pedal displacement - rearward", 200.0), ("Pedal blocking", 50.0)])[3], 0.0);
}

/// Blanks have no points, and the other end of the interval is what they could have.
#[test]
fn what_a_blank_leaves_open_is_said() {
    let values = [("Ares", 50.0), ("Fx,shear", 0.5), ("Fz,tension", 0.5), ("My,extension", 40.0)];
    let found = rated("euro-ncap-2026-full-width", DRIVER, &values, None);
    // the extension moment: bands 36, 40.33, 44.67, 49
    assert_eq!(points(&found), [1.0, 0.0, 0.0, 0.0]);
    assert_eq!((found.outcome.now, found.outcome.best), (1.0, 4.75));
    assert!(found.outcome.is_open() && found.outcome.words(Method::Bands).contains("4.750 of 5 points with blanks"));
    let empty = rated("euro-ncap-2026-full-width", DRIVER, &[], None);
    assert_eq!((empty.outcome.now, empty.outcome.best, empty.capped), (0.0, 5.0, false));
}

/// The arm that strikes the head in a pole test: a peak with a low HIC15 does not cap.
#[test]
fn an_arm_is_no_pole() {
    let with = |hic: f64, peak: f64| {
        let values = [("HIC15", hic), ("Ares", peak)];
        rated("euro-ncap-2026-side-pole", "Pole-32, Driver, WorldSID-50", &values, Some(0.0)).capped
    };
    assert!(with(500.0, 80.0) && !with(499.99, 80.0) && !with(600.0, 79.99) && with(700.0, 0.0));
    let values = [("Direct contact with pole", 1.0)];
    assert!(rated("euro-ncap-2026-side-pole", "Pole-32, Driver, WorldSID-50", &values, Some(0.0)).capped);
}

/// The far side from values by load case and criterion; all others are 0: no load, `Green`, `No`.
fn far_side(values: &[(&str, &str, Option<f64>)]) -> Rated {
    let fill = |occupant: &Occupant, _: &Region, criterion: &Criterion| {
        let given = values.iter().find(|(case, name, _)| *case == occupant.case && *name == criterion.name);
        given.map_or(Some(0.0), |given| given.2).map_or_else(|| Entry::blank("not given"), Entry::of)
    };
    Rating::named("euro-ncap-2026-far-side").unwrap().rate(|_| true, fill)
}

fn far_side_points(values: &[(&str, &str, f64)]) -> f64 {
    let values: Vec<_> = values.iter().map(|(case, name, value)| (*case, *name, Some(*value))).collect();
    let outcome = far_side(&values).tests[0].outcome.unwrap();
    assert_eq!((outcome.of, outcome.is_open()), (Some(10.0), false));
    outcome.now
}

const COLOUR: &str = "Farside excursion";
const BAG: &str = "Countermeasure?";
const FAR_LINE: &str = "Red line >125 mm outboard of the orange line ?";

/// Five parts of 2 points. Orange is worth 25 %, with a countermeasure 75 %; red 25 %, with a far red line 50 %.
#[test]
fn the_far_side_has_points_by_colours() {
    let (main, pole) = (("Main-AEMDB", COLOUR), ("Main-Pole", COLOUR));
    let of = |colour: f64, rest: &[(&str, &str, f64)]| far_side_points(&[&[(main.0, main.1, colour)], rest].concat());
    assert_eq!([0.0, 1.0].map(|colour| of(colour, &[])), [10.0, 9.0]);
    // the green robustness cases of the barrier are two colours off
    assert_eq!(of(2.0, &[]), 6.5);
    assert_eq!(of(2.0, &[("Main-AEMDB", BAG, 1.0)]), 7.5);
    assert_eq!(of(3.0, &[("Main-AEMDB", BAG, 1.0)]), 6.5);
    let red = [("Main-AEMDB", BAG, 1.0), ("Main-AEMDB", FAR_LINE, 1.0)];
    assert_eq!(of(3.0, &red), 7.0);
    // one of four alone counts; so does one of the two seats
    assert_eq!(far_side_points(&[("Robustness-AEMDB90high", COLOUR, 2.0)]), 8.0);
    assert_eq!(far_side_points(&[(pole.0, pole.1, 1.0), ("Robustness-Pole90", COLOUR, 2.0)]), 9.0);
    assert_eq!(far_side_points(&[("Pole-32", "Ares-3ms", 79.994)]), 10.0);
    assert_eq!(far_side_points(&[("Pole-32", "Ares-3ms", 79.995)]), 8.0);
    // (50 - 12.34) % of 2 points are 0.7532; 99.99 % of 2 points 1.9998; the sum is rounded, not its parts
    let seen = [red[0], red[1], ("Main-AEMDB", "Inspection [%]", 12.34), ("Main-Pole", "Inspection [%]", 0.01)];
    assert_eq!(of(3.0, &seen), 6.753);
}

/// A load takes the points of main and robustness cases, a colour those of the main cases; never those of Pole-32.
/// Pelvis and lumbar spine take nothing.
#[test]
fn caps_of_the_far_side_reach_other_cases() {
    assert_eq!([79.99, 80.0].map(|peak| far_side_points(&[("Main-Pole", "Ares", peak)])), [10.0, 2.0]);
    assert_eq!([3.73, 3.74].map(|load| far_side_points(&[("Main-AEMDB", "Ftension, lower", load)])), [10.0, 2.0]);
    let capping = [("Main-Pole", COLOUR, 4.0)];
    assert_eq!(far_side_points(&capping), 4.0);
    let beside = [("Robustness-Pole75high", COLOUR, 4.0), ("Robustness-Pole90", COLOUR, 4.0)];
    assert_eq!(far_side_points(&[&capping[..], &beside].concat()), 6.0);
    assert_eq!(far_side_points(&[&capping[..], &[("Main-AEMDB", "HIC15", 700.0)]].concat()), 2.0);
    let lumbar = far_side(&[("Main-Pole", "Fy lumbar", Some(9.0))]);
    let own = &lumbar.tests[0].occupants[3];
    assert_eq!((own.regions[4].criteria[1].deducted, own.outcome.now), (25.0, 2.0));
}

/// A main case without a colour leaves its robustness cases open too; unanswered questions count as no.
#[test]
fn blanks_of_the_far_side_are_open() {
    let of = |values: &[_]| {
        let outcome = far_side(values).tests[0].outcome.unwrap();
        (outcome.now, outcome.best)
    };
    assert_eq!(of(&[("Main-Pole", COLOUR, None)]), (6.0, 10.0));
    assert_eq!(of(&[("Robustness-Pole90", COLOUR, None)]), (8.0, 10.0));
    assert_eq!(of(&[("Main-Pole", COLOUR, Some(1.0)), ("Main-Pole", BAG, None)]), (9.0, 10.0));
    let red = [("Main-Pole", COLOUR, Some(3.0)), ("Main-Pole", BAG, Some(1.0)), ("Main-Pole", FAR_LINE, None)];
    assert_eq!(of(&red), (6.5, 7.0));
    assert_eq!(of(&[("Pole-32", "HIC15", None)]), (8.0, 10.0));
    // alone, a robustness case has nothing to be near to
    let rating = Rating::named("euro-ncap-2026-far-side").unwrap();
    let alone = rating.rate(|own| own.case == "Robustness-Pole90", |_, _, _| Entry::of(0.0));
    let outcome = alone.tests[0].occupants[0].outcome;
    assert_eq!((outcome.now, outcome.best, alone.tests[0].outcome, alone.is_unmet()), (0.0, 2.0, None, false));
}

/// 15, 10 and 10 points; no sum where a test or an occupant is missing.
#[test]
fn tests_of_a_stage_have_a_sum() {
    let rating = Rating::named("euro-ncap-2026-side").unwrap();
    let sum = |case: &str| rating.rate(|own| own.case != case, |_, _, _| Entry::of(0.0)).sum;
    let whole = sum("").unwrap();
    assert_eq!((whole.now, whole.best, whole.of), (35.0, 35.0, Some(35.0)));
    assert!(sum("AEMDB-60").is_none() && sum("Robustness-Pole90").is_none());
    assert!(far_side(&[]).sum.is_none());
}

/// Virtual tests have the legs of the others: none if any has none.
#[test]
fn virtual_legs_are_those_of_the_other_tests() {
    let rating = Rating::named("euro-ncap-2026-sled").unwrap();
    let legs = |tibia: f64| {
        let fill = |occupant: &Occupant, _: &Region, criterion: &Criterion| {
            let is_struck = occupant.case == "Sled-High" && criterion.name == "Ftibia, left";
            match criterion.scale {
                Scale::Others => Entry::blank("of the others"),
                Scale::Percent => Entry::default(),
                _ => Entry::of(if is_struck { tibia } else { 0.0 }),
            }
        };
        let found = rating.rate(|_| true, fill);
        let [test] = &found.tests[..] else { panic!() };
        let last = test.occupants.last().unwrap().regions.last().unwrap();
        (last.outcome.now, last.outcome.best, test.outcome.unwrap().now)
    };
    // 10 kN for a 95th, 8 kN for a 5th percentile; 0.20833 six times and 0.3125 lost
    assert_eq!(legs(7.99), (0.208_33, 0.208_33, 10.0));
    assert_eq!(legs(10.0).0, 0.0);
    assert!((legs(10.0).2 - (10.0 - 6.0 * 0.208_333 - 2.0 * 0.3125)).abs() < 2e-3);
}

/// 26 mm of 18 to 34 are half of the 4 points, 0.875 m/s a quarter; each occupant has 16, the test 8.
#[test]
fn sliding_scales_of_2023_are_lines() {
    let values = [("Dchest compression", 26.0), ("Viscous Criterion", 0.875), ("Ffemur, right", 3.5), ("Ares", 50.0)];
    let found = rated("euro-ncap-full-width", "Driver, HIII-05", &values, Some(0.0));
    assert_eq!(found.outcome.of, Some(16.0));
    assert!((found.outcome.now - (4.0 + 4.0 + 1.0 + 3.0)).abs() < 1e-12, "{found:?}");
    // at the limit no points, beyond it the cap
    let at = |depth| rated("euro-ncap-full-width", "Driver, HIII-05", &[("Dchest compression", depth)], Some(0.0));
    assert!(!at(34.0).capped && at(34.1).capped);
    let rating = Rating::named("euro-ncap-full-width").unwrap();
    let all =
        rating.rate(|_| true, |_, _, criterion| Entry::of(if criterion.name == "Inspection [%]" { 25.0 } else { 0.0 }));
    assert_eq!(all.tests[0].outcome.map(|outcome| (outcome.now, outcome.of)), Some((6.0, Some(8.0))));
}

/// The worst region of driver and passenger counts in the MPDB test, and half of the sum.
#[test]
fn the_mpdb_test_takes_the_worse_of_both() {
    let rating = Rating::named("euro-ncap-mpdb").unwrap();
    let fill = |occupant: &Occupant, _: &Region, criterion: &Criterion| match criterion.name {
        "Inspection [%]" => Entry::default(),
        name if name.contains("% of points") => Entry::of(100.0),
        "Itibia, left" if occupant.seat == "Driver" => Entry::of(0.85),
        "Dchest compression" => Entry::of(32.0),
        _ => Entry::of(0.0),
    };
    let outcome = rating.rate(|_| true, fill).tests[0].outcome.unwrap();
    // 4 + 2 + 4 + 2, halved
    assert!((outcome.now - 6.0).abs() < 1e-12 && outcome.of == Some(8.0), "{outcome:?}");
}

/// The joint risk is that of the curves: HIC15 700 gives 11.1629 %, the rest what they have without load.
#[test]
fn stars_come_from_the_joint_risk() {
    use crate::measure::risk::{chest_deflection_risk, hic_risk, joint_risk, neck_axial_risk, nij_risk};
    use crate::measure::{Dummy, Severity};
    let dummy = Dummy::HybridIii50M;
    let values = [("HIC15", 700.0), ("Nij", 0.5), ("Fz,tension", 2.0), ("Dchest compression", 40.0)];
    let found = rated("us-ncap-frontal", "Driver, Hybrid III 50M", &values, Some(0.0));
    let neck = nij_risk(0.5, Severity::Ais3, dummy).unwrap().max(neck_axial_risk(2000.0, dummy).unwrap());
    let femur = crate::measure::risk::femur_risk(0.0, dummy).unwrap();
    let chest = chest_deflection_risk(0.040, dummy).unwrap();
    let joint = joint_risk(&[hic_risk(700.0, Severity::Ais3).unwrap(), neck, chest, femur]);
    assert!((found.outcome.now - joint).abs() < 1e-12 && (found.regions[0].outcome.now - 0.111_629).abs() < 1e-6);
    // 29.9 %: two stars
    assert!(found.outcome.words(Method::Stars).starts_with("2 stars (joint risk 29."), "{:?}", found.outcome);
    let blank = rated("us-ncap-frontal", "Driver, Hybrid III 50M", &values[..3], Some(0.0));
    assert!(blank.outcome.best <= blank.outcome.now);
}

/// Limits are those of the table of limits, and a blank is neither met nor not met.
#[test]
fn rules_are_met_not_met_or_open() {
    let with = |values: &[(&str, f64)], rest| rated("fmvss-208", "any seat, Hybrid III 5F", values, rest).outcome;
    assert_eq!(with(&[], Some(0.0)).words(Method::Limits(Rule::Fmvss208)), "met");
    assert_eq!(with(&[("Dchest compression", 52.0), ("Ffemur, left", 6.805)], Some(0.0)).now, 1.0);
    assert_eq!(with(&[("Dchest compression", 52.001)], Some(0.0)).words(Method::Limits(Rule::Fmvss208)), "NOT MET");
    assert_eq!(with(&[("HIC15", 100.0)], None).words(Method::Limits(Rule::Fmvss208)), "open");
    assert_eq!(with(&[("HIC15", 701.0)], None).words(Method::Limits(Rule::Fmvss208)), "NOT MET");
    // 42 mm for the driver of R137, 34 mm for its passenger
    for (place, most) in [("Driver, Hybrid III 50M", 42.0), ("Front Passenger, Hybrid III 5F", 34.0)] {
        let at = |depth| rated("un-r137", place, &[("Dchest compression", depth)], Some(0.0)).outcome.now;
        assert_eq!((at(most), at(most + 0.01)), (1.0, 0.0));
    }
}

/// Demerits: chest acceptable 2, tibia marginal 4: six are beyond the five of a good one.
#[test]
fn grades_have_demerits() {
    let values = [("Dchest compression", 55.0), ("Itibia, left", 1.1)];
    let found = rated("iihs-moderate-overlap", "Driver, Hybrid III 50M", &values, Some(0.0));
    assert_eq!(points(&found), [0.0, 2.0, 0.0, 4.0]);
    assert_eq!(found.outcome.words(Rating::named("iihs-moderate-overlap").unwrap().method), "acceptable (6 demerits)");
    // a single rib beyond 50 mm is marginal, beyond 55 mm poor
    let rib = |depth| points(&rated("iihs-side", "Driver, SID-IIs", &[("Rib deflection", depth)], Some(0.0)))[1];
    assert_eq!([50.0, 50.1, 55.1].map(rib), [0.0, 10.0, 35.0]);
}

/// A caveat on a value marks its region and its occupant, not others.
#[test]
fn a_doubtful_value_marks_what_is_made_of_it() {
    let rating = Rating::named("euro-ncap-2026-full-width").unwrap();
    let fill = |_: &Occupant, region: &Region, criterion: &Criterion| Entry {
        doubtful: region.name == "Chest & Abdomen" && criterion.name == "Dchest compression",
        ..Entry::of(0.0)
    };
    let found = rating.rate(|own| own.place() == DRIVER, fill);
    let own = &found.tests[0].occupants[0];
    assert_eq!(own.regions.iter().map(|region| region.doubtful).collect::<Vec<_>>(), [false, true, false, false]);
    assert!(own.doubtful && found.tests[0].outcome.is_none());
}

#[test]
fn hostile_values_are_blanks_or_count_as_they_are() {
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(Entry::of(value).value, None);
    }
    for value in [-1e300, -5.0, 0.0, 1e300, f64::MIN_POSITIVE] {
        for rating in RATINGS.iter() {
            let found = rating.rate(|_| true, |_, _, _| Entry::of(value));
            for own in found.tests.iter().flat_map(|test| &test.occupants) {
                let Outcome { now, best, of } = own.outcome;
                let most = of.unwrap_or(1e3);
                assert!((0.0..=most).contains(&now) && (0.0..=most).contains(&best), "{} {value} {now}", rating.name);
            }
        }
    }
}

/// The sum of demerits of both occupants grades the test.
#[test]
fn a_test_of_the_iihs_has_the_demerits_of_both() {
    let rating = Rating::named("iihs-moderate-overlap").unwrap();
    let fill = |_: &Occupant, _: &Region, own: &Criterion| match own.name {
        "Dchest compression" => Entry::of(55.0),
        "Chest index" => Entry::of(41.0),
        _ => Entry::of(0.0),
    };
    let outcome = rating.rate(|_| true, fill).tests[0].outcome.unwrap();
    assert_eq!(outcome.words(rating.method), "marginal (12 demerits)");
}

/// Whatever is blank: at its best it is never worse, and filling a blank never leaves the interval.
#[test]
fn a_filled_blank_stays_within_its_interval() {
    let mut state = 1_u64;
    let mut chance = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f64 / f64::from(1 << 24)
    };
    for rating in RATINGS.iter().flat_map(|rating| std::iter::repeat_n(rating, 40)) {
        let mut values = std::collections::HashMap::new();
        let mut value = |place: String, own: &Criterion| -> (f64, bool) {
            let high = match own.scale {
                Scale::Bands { low, .. } | Scale::Sliding { low, .. } | Scale::Most(low) => low.max(1.0),
                Scale::Grades(bounds) => bounds[0],
                Scale::Gate { below, .. } => below,
                Scale::Excursion | Scale::Beside(_) => 4.0,
                _ => own.cap.unwrap_or(1.0),
            };
            *values.entry(place + own.name).or_insert_with(|| (1.3 * high * chance(), chance() < 0.3))
        };
        let place = |own: &Occupant, region: &Region| own.place() + region.name;
        let is_plain = |own: &Criterion| {
            !matches!(own.scale, Scale::Deduction(_) | Scale::Percent | Scale::Cap | Scale::CapUnless { .. })
        };
        let cell = std::cell::RefCell::new(&mut value);
        let fill = |occupant: &Occupant, region: &Region, own: &Criterion, holes: bool| {
            if matches!(own.scale, Scale::Others) {
                return Entry::blank("of the others");
            }
            let (value, is_blank) = (*cell.borrow_mut())(place(occupant, region), own);
            match is_plain(own) {
                true if is_blank && holes => Entry::blank("blank"),
                true => Entry::of(value),
                false => Entry::of(0.0),
            }
        };
        let whole = rating.rate(|_| true, |occupant, region, own| fill(occupant, region, own, false));
        let holed = rating.rate(|_| true, |occupant, region, own| fill(occupant, region, own, true));
        let all = |rated: &Rated| rated.tests.iter().flat_map(|test| test.occupants.clone()).collect::<Vec<_>>();
        for (whole, holed) in all(&whole).iter().zip(all(&holed)) {
            let [now, best, filled] = [holed.outcome.now, holed.outcome.best, whole.outcome.now];
            let (low, high) = (now.min(best), now.max(best));
            // a blank may hide a cap, which takes what is known
            let low = if whole.capped { 0.0 } else { low };
            assert!(
                (low - 1e-9..=high + 1e-9).contains(&filled),
                "{} {}: {now} {best} {filled}",
                rating.name,
                whole.occupant.place()
            );
        }
    }
}

/// So does a load that caps the cases of others.
#[test]
fn a_doubtful_cap_marks_all_that_it_reaches() {
    let rating = Rating::named("euro-ncap-2026-far-side").unwrap();
    let fill = |occupant: &Occupant, _: &Region, criterion: &Criterion| {
        let is_cap = occupant.case == "Main-Pole" && criterion.name == "HIC15";
        Entry { doubtful: is_cap, ..Entry::of(if is_cap { 700.0 } else { 0.0 }) }
    };
    let found = rating.rate(|_| true, fill);
    let marks: Vec<_> = found.tests[0].occupants.iter().map(|own| (own.capped, own.doubtful)).collect();
    assert!(marks[..2].iter().all(|own| *own == (false, false)) && marks[2..].iter().all(|own| *own == (true, true)));
}

/// Every table is whole: names once, instruments for all, a document with a year, points that make the sums of the
/// template.
#[test]
fn tables_are_whole() {
    let measures: BTreeSet<&str> =
        crate::injury::assess(&crate::injury::Signals::new(), &crate::injury::Options::default())
            .iter()
            .map(|measure| measure.name)
            .collect();
    assert!(measures.contains("hic15"));
    let mut names = BTreeSet::new();
    for rating in RATINGS.iter() {
        assert!(names.insert(rating.name) && rating.source.contains("20"), "{}", rating.name);
        let places: BTreeSet<String> = rating.occupants().map(Occupant::place).collect();
        assert_eq!(places.len(), rating.occupants().count(), "{}", rating.name);
        for (occupant, region) in rating.occupants().flat_map(|own| own.regions.iter().map(move |region| (own, region)))
        {
            let known: BTreeSet<&str> = region.criteria.iter().map(|own| own.name).collect();
            assert_eq!(known.len(), region.criteria.len(), "{} {}", occupant.place(), region.name);
            for own in region.criteria {
                let found = instrument(region.name, own.name);
                assert!(
                    found.measure.is_some()
                        || found.remark != Some("no measure of this program")
                        || own.name == "Rib deflection, rate",
                    "{}",
                    own.name
                );
                let limit = own.scale.most(found.unit.factor, rating.method, occupant.dummy);
                assert_eq!(
                    matches!(own.scale, Scale::Rule(_) | Scale::Most(_)),
                    limit.is_some(),
                    "{} {}",
                    rating.name,
                    own.name
                );
            }
        }
    }
    for test in RATINGS.iter().flat_map(|rating| rating.tests) {
        if let Total::WorstOfParts(sizes) = test.total {
            assert_eq!(sizes.iter().sum::<usize>(), test.occupants.len());
        }
    }
    let most = |name: &str| -> Vec<f64> {
        let tests = Rating::named(name).unwrap().tests.iter();
        tests.map(|test| test.occupants.iter().flat_map(|own| own.regions).map(|region| region.points).sum()).collect()
    };
    let close = |found: Vec<f64>, expected: &[f64]| found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-3);
    assert!(
        close(most("euro-ncap-2026-frontal"), &[20.0, 10.0, 10.0]) && close(most("euro-ncap-2026-side"), &[15.0, 10.0])
    );
}
