//! Materials: what is wrong with them, the library, and runs with force functions.

use super::*;
use crate::Draft;
use crate::sections::schema;
use nalgebra::Vector3;
use occupant_core::forces::contact::material::Force;
use occupant_core::forces::function::{Shape, Unloading};
use occupant_core::model::Model;
use occupant_core::results::outcome::Status;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use occupant_core::vehicle::{TravelDirection, VehiclePath};

fn changed(changes: &[&str]) -> Result<(Model, String, Loaded), String> {
    let mut draft = Draft::read(SHORT, Format::Toml, "test").unwrap();
    changes.iter().for_each(|change| draft.set(change).unwrap());
    let loaded = draft.load(&no_files).map_err(|problems| problems.to_string())?;
    let (model, warnings) = loaded.model().map_err(|problems| problems.to_string())?;
    Ok((model, warnings.to_string(), loaded))
}

/// The material of the cushion as a force function, with more keys.
fn foam(more: &str) -> String {
    format!("materials.foam={{ depth = [0, 0.05, 0.1], force = [0, 400, 2400], friction = 0.8, {more} }}")
}

#[test]
fn what_is_wrong_with_materials_is_said_at_its_place() {
    for (change, expected) in [
        (foam("k1 = 4e4"), "`depth` and `k1` together"),
        (foam("returned = 0.5, unload_slope = 1e5"), "together"),
        (foam("mu1 = 0.5"), "`mu1` without `k1`"),
        ("materials.foam={ k1 = 1e4, mu1 = 0.5, friction = 0.4, returned = 0.5 }".to_owned(), "`returned` beside `k1`"),
        ("materials.foam={ k1 = 1e4, friction = 0.4 }".to_owned(), "no key `mu1`"),
        ("materials.foam={ k1 = 1e4, mu1 = 0.5 }".to_owned(), "no key `friction`"),
        ("materials.foam={ friction = 0.4 }".to_owned(), "none of `k1`, `depth`, `polynomial`, `library`, `file`"),
        ("materials.foam={ library = \"dash_10\" }".to_owned(), "did you mean \"dash_s10\"?"),
        (foam("returned_each = [0.5]"), "one for each interval"),
        (foam("unload_slope = 1e4"), "at least the largest slope of loading"),
        (foam("atb = { r = 0.3, g = 0.6 }"), "ATB's quadratic makes"),
        (foam("atb = { depth = [0, 0.1], r_each = [0.6], g = 0.1 }"), "the same number in both"),
        (foam("atb = { depth = [0, 0.1], r_each = [0.6, 1.2], g = 0.1 }"), "1.2"),
        (foam("polynomial = { depth = 0.1, force = [1, 2, 3] }"), "together"),
        (
            "materials.foam={ polynomial = { depth = 0.1, force = [2000, -4000, 1000] }, friction = 0.8 }".to_owned(),
            "below 0",
        ),
        (foam("unload_depth = [0, 1], unload_force = [0, 1]"), "`unload_force` without `unload_slope`"),
        (foam("rate = { speed = [-1, 0], factor = [1] }"), "the same number in both"),
        (foam("friction_over_slip = { speed = [0, 0.1], factor = [1, 0.3] }"), "sticks and slips"),
        (foam("shape = \"smooth\""), "\"monotone\""),
        (foam("self = 1"), "unknown key `self`"),
    ] {
        let said = match changed(&[&change]) {
            Ok((_, warnings, _)) => warnings,
            Err(said) => said,
        };
        assert!(said.contains(expected), "{change}: {said}");
    }
}

/// Names of the library that the schema lists for a section.
fn listed(section: &str) -> Vec<String> {
    let names = &schema()["$defs"][section]["properties"]["library"]["enum"];
    names.as_array().unwrap().iter().map(|name| name.as_str().unwrap().to_owned()).collect()
}

#[test]
fn every_entry_of_the_library_is_listed_sound_and_tells_its_source() {
    let library = crate::presets::library().unwrap();
    for (section, of) in [
        ("MaterialSection", "materials"),
        ("WebbingSection", "webbings"),
        ("LimiterSection", "limiters"),
        ("BagSection", "bags"),
    ] {
        let entries = library.root.get(of).unwrap().as_table().unwrap();
        let names: Vec<&String> = entries.keys().collect();
        assert_eq!(names, listed(section).iter().collect::<Vec<_>>(), "{of}");
        for name in names {
            assert!(library.root.get("provenance").unwrap().get(&format!("{of}.{name}")).is_some(), "{of}.{name}");
        }
    }
    for name in listed("MaterialSection") {
        let (model, warnings, loaded) = changed(&[&format!("materials.foam={{ library = {name:?} }}")]).unwrap();
        assert!(!warnings.contains("materials.foam"), "{name}: {warnings}");
        assert!(matches!(model.setup().materials[0].force, Force::Deflection(_)));
        assert!(loaded.explicit().provenance["materials.foam"].contains("SAE") || name != "column_1969");
        // what a result file holds can be read again
        let text = loaded.explicit().to_toml().unwrap();
        assert_eq!(build(&text).materials, model.setup().materials, "{name}");
    }
    for (name, of) in [("webbing_atb", "webbings"), ("webbing_ng", "webbings"), ("torsion_bar", "limiters")] {
        assert!(changed(&[&format!("{of}.x={{ library = {name:?} }}")]).is_ok(), "{name}");
    }
}

/// Change of speed, mean and peak deceleration of the pulses of tests of seats, as their rules tell them.
#[test]
fn pulses_of_the_library_have_the_numbers_of_their_rules() {
    let rules = [
        ("iiwpg_16", 16.0, 49.0, 98.1),
        ("fmvss_202a", 17.3, 54.7, 86.0),
        ("sra_16", 16.1, 42.35, 49.0),
        ("sra_24", 24.45, 63.15, 73.6),
    ];
    let library = crate::presets::library().unwrap().root.get("vehicles").unwrap().as_table().unwrap();
    assert_eq!(library.keys().collect::<Vec<_>>(), rules.map(|(name, ..)| name));
    for (name, km_h, mean, peak) in rules {
        let (model, _, loaded) = changed(&[&format!("path={{ kind = \"pulse\", library = {name:?} }}")]).unwrap();
        let VehiclePath::Pulse(path) = &model.setup().path else { panic!("a pulse") };
        let (from_s, to_s) = path.pulse_span_s();
        assert_eq!(
            path.definition().direction,
            TravelDirection::Along(Vector3::new(-1.0, 0.0, 0.0)),
            "{name}: from behind"
        );
        assert!((path.delta_v_m_s() * 3.6 - km_h).abs() < 0.07, "{name}: {}", path.delta_v_m_s());
        assert!((path.delta_v_m_s() / (to_s - from_s) / mean - 1.0).abs() < 0.002, "{name}");
        assert!((path.peak_deceleration_m_s2() / peak - 1.0).abs() < 0.005, "{name}");
        assert!(loaded.explicit().provenance["path"].contains("recalled"));
        assert_eq!(build(&loaded.explicit().to_toml().unwrap()).path, model.setup().path, "{name}");
    }
    let own = "path={ kind = \"pulse\", library = \"sra_24\", peak = \"5 g\", rise = \"20 ms\" }";
    let (model, ..) = changed(&[own]).unwrap();
    let VehiclePath::Pulse(path) = &model.setup().path else { panic!("a pulse") };
    assert!((path.peak_deceleration_m_s2() - 5.0 * 9.80665).abs() < 1e-9, "own keys hold");
    for (of, wanted) in [
        ("library = \"sra_42\"", "did you mean \"sra_24\"?"),
        ("speed = 5", "a pulse without `shape`"),
        ("shape = \"square\", peak = 9, duration = 0.1", "`path` has no key `speed`"),
        ("library = \"sra_24\", duration = 0.1", "this pulse shape does not use `duration`"),
    ] {
        let found = changed(&[&format!("path={{ kind = \"pulse\", {of} }}")]).unwrap_err();
        assert!(found.contains(wanted), "{of}: {found}");
    }
}

#[test]
fn what_is_said_beside_the_library_holds() {
    let own = "materials.foam={ library = \"dash_s10\", friction = 0.7, returned_each = [0.1, 0.2, 0.3, 0.4] }";
    let (model, ..) = changed(&[own]).unwrap();
    let material = &model.setup().materials[0];
    let Force::Deflection(law) = &material.force else { panic!("a spring") };
    assert_eq!((material.friction, &law.loading.returned[..]), (0.7, &[0.1, 0.2, 0.3, 0.4][..]));
    // 1000 lbf at 3 in
    assert_eq!(law.loading.points[3], [3.0 * 0.0254, 1000.0 * 4.448_221_615_260_5]);
    let one = ["materials.foam={ library = \"dash_s10\" }", "materials.foam.force[3]=\"1100 lbf\""];
    let (model, ..) = changed(&one).unwrap();
    let Force::Deflection(law) = &model.setup().materials[0].force else { panic!("a spring") };
    assert_eq!(law.loading.points[3], [3.0 * 0.0254, 1100.0 * 4.448_221_615_260_5]);
    let (model, ..) = changed(&["materials.foam={ library = \"dash_s10\", unload_slope = \"2000 lbf/in\" }"]).unwrap();
    let Force::Deflection(law) = &model.setup().materials[0].force else { panic!("a spring") };
    assert!(matches!(law.unloading, Unloading::Slope { .. }));
}

/// A run keeps its energy with every law, and a law that says the same as a spring moves a body as the spring does.
#[test]
fn runs_keep_their_energy_with_every_law() {
    let rk4 = "integrator={ kind = \"rk4\", step = \"0.1 ms\" }";
    let run = |change: &str| {
        let (model, ..) = changed(&[rk4, change]).unwrap_or_else(|said| panic!("{change}: {said}"));
        let (mut place, mut deepest) = (Vec::new(), 0.0_f64);
        let outcome = simulate(
            &model,
            Watch(|s: &Sample<'_>| {
                place.push(s.sphere_centre_m(0));
                deepest = s.actions.contacts.iter().fold(deepest, |most, touch| most.max(touch.depth));
            }),
        )
        .unwrap();
        assert_eq!(outcome.status, Status::Completed, "{change}");
        // measured: 2e-6 at most
        assert!(outcome.energy.balance_error < 1e-4, "{change}: {}", outcome.energy.balance_error);
        assert!(deepest > 0.02, "{change}: {deepest}");
        place
    };
    for more in [
        "returned_each = [0.5, 0.2]",
        "unload_slope = 8e4",
        "atb = { r = 0.3, g = 0.6 }",
        "spike = { depth = [0, 0.01, 0.03], force = [0, 300, 0] }, returned = 0.2",
        "rate = { speed = [-1, 0, 5], factor = [0.8, 1, 1.2] }, shape = \"monotone\"",
        "viscous = { force = 200, speed = 1 }, beyond = \"holds\"",
        "friction_over_slip = { speed = [0, 2], factor = [1, 0.6] }, friction_over_force = { force = [0, 900], factor = [1, 0.8] }",
    ] {
        run(&foam(more));
    }
    let spring = run("materials.foam={ k1 = 8e3, delta_b = 0.05, k2 = 4e4, mu1 = 0.5, mu2 = 0.2, friction = 0.8 }");
    let lines = run(&foam("returned_each = [0.5, 0.2]"));
    let apart = spring.iter().zip(&lines).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    // measured: 1e-12 m, rounding
    assert!(apart < 1e-9, "{apart}");
}

/// A polynomial in forces at a depth, and ATB's numbers over depths, come to the functions that they say.
#[test]
fn polynomials_and_tables_of_the_quadratic_come_to_their_functions() {
    let of = |text: &str| {
        let (model, ..) = changed(&[text]).unwrap_or_else(|said| panic!("{said}"));
        let Force::Deflection(law) = model.setup().materials[0].force.clone() else { panic!("no force function") };
        law
    };
    let law = of(
        "materials.foam={ polynomial = { depth = \"50 mm\", force = [100, 0, \"2.5 kN\"] }, returned = 0.4, friction = 0.8 }",
    );
    let Shape::Polynomial([c1, c2, c3]) = law.loading.shape else { panic!("{:?}", law.loading) };
    assert!(
        [c1, c2] == [2e3, 0.0]
            && (c3 / 2e7 - 1.0).abs() < 1e-15
            && law.loading.end() == 0.05
            && law.loading.returned == [0.4]
    );
    let table = "atb = { depth = [0.02, 0.1], r_each = [0.6, 0.5], g = 0.2 }";
    let law = of(&format!("materials.foam={{ depth = [0, 0.1], force = [0, 2000], friction = 0.8, {table} }}"));
    let rows = vec![[0.02, 0.6], [0.1, 0.5]];
    assert_eq!(law.unloading, Unloading::Quadratic { returned: rows, set: vec![[0.0, 0.2]] });
}
