//! The `[fit]` in a study.

use indexmap::IndexMap;

use super::*;
use crate::{Bounds, FilterChoice, Misfit};

const PARAMETERS: &str = r#"
    [[parameters]]
    name = "friction"
    path = "materials.foam.friction"
    range = { from = 0.1, to = 1.6, scale = "log" }
    [[parameters]]
    name = "mu1"
    path = "materials.foam.mu1"
    distribution = { kind = "triangular", from = 0.2, mode = 0.3, to = 1 }
"#;

fn text(more: &str) -> StudyText {
    let text = format!("base = \"short.toml\"\n{more}\n{PARAMETERS}");
    StudyText::read(&text, Format::Toml, "study.toml").unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn what_is_left_out_has_its_standard() {
    let fit = text("").fit().unwrap();
    assert_eq!((fit.misfit, fit.filter), (Misfit::Rms, FilterChoice::None));
    assert_eq!((fit.budget, fit.population, fit.tolerance), (800, 16, 1e-4));
    assert!(fit.channels.is_empty() && fit.tests.is_empty() && fit.near.is_none());
}

#[test]
fn times_are_in_seconds_and_channels_and_tests_as_written() {
    let fit = text(
        r#"
        seed = 9
        [fit]
        objective = "iso18571"
        filter = "CFC60"
        from = "5 ms"
        to = 0.1
        channels = [{ channel = "a", weight = 2 }, { channel = "b", filter = "none" }]
        [[fit.tests]]
        file = "a.csv"
        shift = "-2 ms"
        set = { "time.end" = "0.1 s" }
        [[fit.tests]]
        base = "other.toml"
        seat = "3"
        weight = 0.5
        "#,
    );
    let fit = fit.fit().unwrap();
    assert_eq!((fit.misfit, fit.seed), (Misfit::Iso18571, 9));
    assert_eq!(fit.window_s, [Some(0.005), Some(0.1)]);
    let filters: Vec<FilterChoice> = fit.channels.iter().map(|c| c.filter.unwrap_or(fit.filter)).collect();
    assert_eq!(filters, [FilterChoice::Cfc60, FilterChoice::None]);
    assert_eq!((fit.channels[0].weight(), fit.channels[1].weight()), (2.0, 1.0));
    assert_eq!((fit.tests[0].shift_s(), fit.tests[0].seat()), (-0.002, '1'));
    assert_eq!((fit.tests[1].weight(), fit.tests[1].seat()), (0.5, '3'));
}

#[test]
fn parts_of_the_way_between_the_ends_lead_to_values_and_back() {
    let text = text("[design]\nkind = \"monte_carlo\"\nsamples = 3");
    let set = IndexMap::new();
    let study = text.bind_fit(base(), (&set, ""), &[], &no_files).unwrap();
    let bounds: Vec<Bounds> = study.parameters.iter().filter_map(|p| p.law.bounds()).collect();
    assert_eq!(bounds[1], Bounds { from: 0.2, to: 1.0, log: false });
    // the middle of a logarithmic range: √(0.1 · 1.6)
    assert!((bounds[0].value(0.5) - 0.4).abs() < 1e-15);
    for u in [0.0, 0.3, 1.0] {
        assert!((bounds[0].part(bounds[0].value(u)) - u).abs() < 1e-15);
    }
    // the design is for sweeps
    assert_eq!(study.len(), 1);
    let put = study.assignments_of(&[0.4, 0.5]);
    let put: Vec<String> = put.iter().map(|a| format!("{}={}", a.path, a.text())).collect();
    assert_eq!(put, ["materials.foam.friction=0.4", "materials.foam.mu1=0.5"]);
}

#[test]
fn parameters_without_ends_are_told_by_a_fit_and_not_by_a_sweep() {
    let list = "range = { from = 0.1, to = 1.6, scale = \"log\" }";
    let written = format!(
        "base = \"short.toml\"\ndesign = {{ kind = \"monte_carlo\", samples = 3 }}\n{}",
        PARAMETERS.replace(list, "list = [0.3, 0.4]")
    );
    let text = StudyText::read(&written, Format::Toml, "study.toml").unwrap();
    assert!(text.bind(base(), &[], &no_files).is_ok());
    let set = IndexMap::new();
    let message = text.bind_fit(base(), (&set, ""), &[], &no_files);
    let message = message.unwrap_err().to_string();
    assert!(message.contains("`friction` has no range to search"), "{message}");
    assert!(message.contains("study.toml:4:"), "{message}");
}

#[test]
fn what_a_test_has_besides_is_told_where_it_stands() {
    let text = text("[[fit.tests]]\nfile = \"a.csv\"\nset = { \"materials.foam.k9\" = 3 }");
    let fit = text.fit().unwrap();
    let message = text.bind_fit(base(), (&fit.tests[0].set, "fit.tests[0].set"), &[], &no_files);
    let message = message.unwrap_err().to_string();
    assert!(message.contains("k9"), "{message}");
}
