//! Units: closed forms, spellings that mean the same, slips that are refused.

use crate::kind::{
    ACCELERATION, ANGLE, ANGULAR_VELOCITY, FORCE, INERTIA, KINDS, LENGTH, MASS, RATIO, ROTATIONAL_DAMPING, SPEED,
    STIFFNESS, TIME, UnitSystem,
};
use occupant_units::unit::{Dimension, UNITS, UnitError, parse};
use placed_text::Value;

fn read(text: &str, kind: usize) -> Result<f64, UnitError> {
    KINDS[kind].si(&Value::String(text.into()), UnitSystem::Si)
}

fn value(text: &str, kind: usize) -> f64 {
    read(text, kind).unwrap_or_else(|e| panic!("{text}: {e:?}"))
}

/// Relative difference at most 4 units in the last place; measured: at most 2.
fn assert_same(a: f64, b: f64) {
    assert!((a - b).abs() <= 4.0 * f64::EPSILON * b.abs(), "{a:e} is not {b:e}");
}

#[test]
fn definitions_are_exact() {
    for (text, kind, si) in [
        ("12 in", LENGTH, 0.3048),
        ("1 ft", LENGTH, 0.3048),
        ("305 mm", LENGTH, 0.305),
        ("80 ms", TIME, 0.08),
        ("20 mph", SPEED, 8.9408),
        ("352 in/s", SPEED, 8.9408),
        ("36 km/h", SPEED, 10.0),
        ("17.9 g", ACCELERATION, 17.9 * 9.80665),
        ("386.04 in/s^2", ACCELERATION, 9.805416),
        ("11.55 lb", MASS, 11.55 * 0.45359237),
        ("1 lbf", FORCE, 4.4482216152605),
        ("48 lbf/in", STIFFNESS, 48.0 * 4.4482216152605 / 0.0254),
        ("8.4 kN/m", STIFFNESS, 8400.0),
        ("1 lbf in s^2", INERTIA, 4.4482216152605 * 0.0254),
        ("1 lbf s^2/in", MASS, 4.4482216152605 / 0.0254),
        ("1 slug", MASS, 4.4482216152605 / 0.3048),
        ("180 deg", ANGLE, std::f64::consts::PI),
        ("1 rev/s", ANGULAR_VELOCITY, std::f64::consts::TAU),
        ("1 in·lbf·s/rad", ROTATIONAL_DAMPING, 4.4482216152605 * 0.0254),
        ("50 %", RATIO, 0.5),
        // A weight in pounds weighs that in pounds-force at one g.
        ("1 lb g", FORCE, 4.4482216152605),
    ] {
        assert_same(value(text, kind), si);
    }
}

#[test]
fn per_degree_is_180_over_pi_times_per_radian() {
    let per_degree = value("0.1 in lbf s / deg", ROTATIONAL_DAMPING);
    let per_radian = value("1 in·lbf·s/rad", ROTATIONAL_DAMPING);
    assert_same(per_degree, 0.1 * 180.0 / std::f64::consts::PI * per_radian);
    // The ATB default of 0.1 in·lbf·s/deg is 5.73 in·lbf·s/rad to three figures.
    assert!((per_degree / per_radian - 5.73).abs() < 0.005);
}

#[test]
fn spellings_mean_the_same() {
    for (kind, spellings) in [
        (
            STIFFNESS,
            vec!["48 lbf/in", "48lbf/in", "+48.0 lbf·in^-1", "4.8e1 lbf in⁻¹", "48 lbf/(in)", " 48 lbf * in**-1 "],
        ),
        (ROTATIONAL_DAMPING, vec!["6 in lbf s/rad", "6 in-lbf-s/rad", "6 in·lbf·s", "6 lbf in s rad^-1", "6 s·lbf×in"]),
        (
            ACCELERATION,
            vec!["9.80665 m/s^2", "9.80665 m/s²", "9.80665 m/s/s", "9.80665 m s⁻²", "1 g", "9.80665 m/(s·s)"],
        ),
        (LENGTH, vec!["-3 in", "−3 in", "-3inch", "-3e0 in"]),
    ] {
        let first = value(spellings[0], kind);
        for text in spellings {
            assert_same(value(text, kind), first);
        }
    }
}

#[test]
fn bare_numbers_follow_the_unit_system() {
    let bare = |x: f64, kind: usize, units| KINDS[kind].si(&Value::Float(x), units).unwrap();
    assert_same(bare(2.0, LENGTH, UnitSystem::Si), 2.0);
    assert_same(bare(2.0, LENGTH, UnitSystem::InchPound), 0.0508);
    assert_same(bare(90.0, ANGLE, UnitSystem::Si), std::f64::consts::FRAC_PI_2);
    assert_same(bare(90.0, ANGLE, UnitSystem::InchPound), std::f64::consts::FRAC_PI_2);
    // lbf·s²/in, so that mass times in/s² is lbf.
    let (m, a) = (bare(1.0, MASS, UnitSystem::InchPound), bare(1.0, ACCELERATION, UnitSystem::InchPound));
    assert_same(m * a, bare(1.0, FORCE, UnitSystem::InchPound));
    // Damping is per radian though angles are in degrees.
    assert_same(bare(1.0, ROTATIONAL_DAMPING, UnitSystem::Si), 1.0);
}

#[test]
fn every_bare_unit_measures_its_kind() {
    for kind in KINDS {
        for unit in [UnitSystem::Si, UnitSystem::InchPound].map(|units| kind.bare_unit(units)) {
            if !unit.is_empty() {
                assert_eq!(parse(unit, 0).unwrap().dimension, kind.unit.dimension(), "{}", kind.name);
            }
        }
        for example in kind.example.split(", ") {
            if let Some(text) = example.strip_prefix('"') {
                let written = Value::String(text.trim_end_matches('"').into());
                kind.si(&written, UnitSystem::Si).unwrap();
            }
        }
    }
}

#[test]
fn unit_names_are_unique() {
    let mut names: Vec<&str> = UNITS.iter().flat_map(|u| u.names.iter().copied()).collect();
    let count = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), count);
}

#[test]
fn wrong_units_are_refused_with_their_place() {
    for (text, kind, words, found, hint) in [
        (
            "48 lb/in",
            STIFFNESS,
            "lb/in",
            "`lb/in` is not the unit of a stiffness",
            Some("the pound of force is `lbf`: \"48 lbf/in\""),
        ),
        ("11.5 lbf", MASS, "lbf", "`lbf` is not the unit of a mass", Some("the pound of mass is `lb`: \"11.5 lb\"")),
        ("20 MPH", SPEED, "MPH", "unknown unit `MPH`", Some("did you mean `mph`?")),
        ("5 kn", FORCE, "kn", "unknown unit `kn`", Some("did you mean `kN`?")),
        ("3 blorp", LENGTH, "blorp", "unknown unit `blorp`", None),
        ("15", ANGLE, "15", "a number without unit in quotes, `15`", Some("write 15 without quotes")),
        (".2", ANGLE, ".2", "a number without unit in quotes, `.2`", Some("write 0.2 without quotes")),
        ("1,5 m", LENGTH, "1,5 m", "a comma in the number `1,5 m`", Some("decimals are written with a point")),
        ("fast", SPEED, "fast", "`fast` does not start with a number", None),
        ("", SPEED, "", "`` does not start with a number", None),
        (
            "1 in/s·s",
            ACCELERATION,
            "·",
            "a product after `/`",
            Some("write a/(b·c) if both divide, a·c/b if only b does"),
        ),
        ("1 m/", SPEED, "", "a missing unit", None),
        ("1 (m", LENGTH, "(", "`(` without `)`", None),
        ("1 m)", LENGTH, ")", "an unmatched `)`", None),
        ("1 m^99", LENGTH, "^99", "a power that cannot be read", None),
        ("1 m^x", LENGTH, "^", "a power that cannot be read", None),
        ("1 m^9^9", LENGTH, "^9", "a sign instead of a unit", None),
        ("1 m^9·m", LENGTH, "·", "too high a power", None),
        ("1 $", LENGTH, "$", "`$` in a unit", None),
        ("1e999 m", LENGTH, "1e999 m", "`1e999 m` is not finite", None),
        ("1 rad", ROTATIONAL_DAMPING, "rad", "`rad` is not the unit of a rotational damping", None),
    ] {
        let error = read(text, kind).expect_err(text);
        assert_eq!(&text[error.start..error.end], words, "{text}: {error:?}");
        assert_eq!(error.found, found, "{text}");
        assert_eq!(error.hint.as_deref(), hint, "{text}");
    }
}

#[test]
fn the_radian_may_be_silent_only_below_the_line() {
    let (torque, per_radian) = (Dimension::new(2, 1, -2, 0), Dimension::new(2, 1, -2, -1));
    assert!(torque.serves_as(per_radian));
    assert!(!per_radian.serves_as(torque));
    assert!(!Dimension::default().serves_as(Dimension::new(0, 0, 0, 1)));
}
