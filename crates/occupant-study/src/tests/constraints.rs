//! Constraints between parameters.

use indexmap::IndexMap;

use super::*;

const SQUARE: &str = r#"
    seed = 7
    [[parameters]]
    name = "a"
    path = "materials.foam.friction"
    range = { from = 0, to = 1 }
    [[parameters]]
    name = "b"
    path = "materials.foam.mu1"
    range = { from = 0, to = 1 }
"#;

fn square(design: &str, constraint: &str) -> String {
    format!("{SQUARE}\n{constraint}\n[design]\n{design}")
}

const ABOVE: &str = "[[constraints]]\nname = \"a above b\"\nsum = { a = 1, b = -1 }\nmin = 0";

/// Samples have the same values, with a constraint or without, and half of them break this one.
#[test]
fn a_sample_is_judged_by_its_own_values_and_keeps_its_number() {
    for kind in ["sobol", "monte_carlo", "latin_hypercube"] {
        let design = format!("kind = \"{kind}\"\nsamples = 256");
        let [plain, within] = ["", ABOVE].map(|constraint| study(&square(&design, constraint)));
        let mut excluded = 0;
        for index in 0..256 {
            let values = numbers(&within, index);
            assert_eq!(values, numbers(&plain, index));
            let why = within.excluded(index);
            assert_eq!(why.is_some(), values[0] < values[1], "{kind} {index}");
            assert!(why.iter().all(|why| why == "the sum of constraint `a above b` is below 0"), "{why:?}");
            excluded += u32::from(why.is_some());
        }
        // measured: 128, 131, 126
        assert!((112..144).contains(&excluded), "{kind}: {excluded}");
        assert_eq!((plain.len(), within.len(), plain.excluded(3)), (256, 256, None));
    }
}

#[test]
fn limits_are_in_their_own_units_and_a_member_shares_the_fate_of_its_sample() {
    let of = |limits: &str| {
        study(&format!(
            "design.kind = \"full_factorial\"
            ensemble.members = 3
            [[parameters]]
            path = \"belts.lap.k1\"
            grid = {{ from = \"60 kN/m\", to = \"80 kN/m\", steps = 3 }}
            [[parameters]]
            path = \"materials.foam.k1\"
            grid = {{ from = \"10 kN/m\", to = \"30 kN/m\", steps = 3 }}
            [[constraints]]
            sum = {{ \"belts.lap.k1\" = 0.5, \"materials.foam.k1\" = -1 }}
            {limits}"
        ))
    };
    let left = |study: &Study| -> Vec<u64> { (0..27).filter(|run| study.excluded(*run).is_none()).collect() };
    let both = of("min = \"5000 N/m\"\nmax = 15_000");
    // 30 to 40 less 10 to 30 kN/m: 20 10 0, 25 15 5, 30 20 10
    let expected = [1, 4, 5, 8].into_iter().flat_map(|sample| 3 * sample..3 * sample + 3);
    assert_eq!(left(&both), expected.collect::<Vec<_>>());
    assert!(both.excluded(0).unwrap().ends_with("`constraints[0]` is above 15000 N/m"), "{:?}", both.excluded(0));
    assert_eq!(left(&of("max = \"0 lbf/in\"")).len(), 3);
}

#[test]
fn corners_that_break_a_constraint_are_none() {
    let count = |constraint: &str| study(&square("kind = \"sobol\"\nsamples = 4", constraint)).corners().len();
    // alone: a at 0 and 1, b at 0 and 1 beside the base, of 0.4 and 0.3; then four together
    assert_eq!(count(""), 8);
    let found = study(&square("kind = \"sobol\"\nsamples = 4", ABOVE)).corners();
    for corner in &found {
        let value = |i: usize| corner.values.iter().find(|(at, _)| *at == i).map(|(_, value)| value.clone());
        assert!((value(0), value(1)) != (Some(Value::Number(0.0)), Some(Value::Number(1.0))), "{corner:?}");
    }
    assert!((3..8).contains(&found.len()), "{found:?}");
}

fn refused(constraint: &str, words: &[&str]) {
    for design in ["kind = \"sobol\"\nsamples = 16", "kind = \"monte_carlo\"\nsamples = 3"] {
        let said = complaint(&square(design, constraint));
        words.iter().for_each(|words| assert!(said.contains(words), "{words}: {said}"));
    }
}

#[test]
fn what_makes_no_sense_is_told_with_its_place() {
    let of = |keys: &str| format!("[[constraints]]\n{keys}");
    refused(
        &of("sum = { a = 1, c = 1 }\nmin = 0"),
        &["no parameter is named \"c\"", "constraints[0].sum.c", "\"a\" or \"b\""],
    );
    refused(&of("sum = { a = 1 }\nmin = 2\nmax = 1"), &["`max` is below `min`", "constraints[0].max"]);
    refused(&of("sum = { a = 1 }"), &["a constraint without limits"]);
    refused(&of("sum = {}\nmin = 0"), &["a sum of nothing"]);
    refused(&of("min = 0"), &["sum"]);
    refused(&of("sum = { a = -0.0 }\nmin = 0"), &["a factor of 0", "constraints[0].sum.a"]);
    for factor in ["nan", "inf"] {
        refused(&of(&format!("sum = {{ a = {factor} }}\nmin = 0")), &["constraints[0].sum.a", "a number"]);
    }
    refused(&of("sum = { a = 1 }\nmin = \"1 N\""), &["`N` is not the unit of a plain number", "constraints[0].min"]);
    refused(&of("sum = { a = 1 }\nmin = 2"), &["no point of the ranges keeps all of them"]);
    refused(&of("sum = { a = 1 }\nmin = 0.99999"), &["samples breaks a constraint", "of the first, the sum of"]);
    refused(&of("sum = { a = 1 }\nmin = inf"), &["constraints[0].min"]);
    refused(&of("sum = { a = \"1\" }\nmin = 0"), &["sum"]);
    refused(&format!("{ABOVE}\n{ABOVE}"), &["two constraints named \"a above b\""]);
    refused(
        &format!(
            "[[parameters]]\npath = \"belts.lap.k1\"\nrange = {{ from = 1, to = 2 }}\n{}",
            of("sum = { a = 1, \"belts.lap.k1\" = 1 }\nmin = 0")
        ),
        &["`a` is a plain number, `belts.lap.k1` is in N/m", "parameters of one quantity"],
    );
    refused(
        &format!(
            "[[parameters]]\npath = \"path.shape\"\nlist = [\"square\"]\n{}",
            of("sum = { \"path.shape\" = 1 }\nmin = 0")
        ),
        &["`path.shape` has values that are no numbers"],
    );
    refused(
        &format!(
            "[[parameters]]\nname = \"c\"\npath = \"belts.lap.k1\"\nlist = [1, 2]\ncrossed = true\n{}",
            of("sum = { c = 1 }\nmin = 0")
        ),
        &["`c` is crossed with all samples"],
    );
}

#[test]
fn designs_that_are_analysed_as_a_whole_refuse_constraints() {
    for design in ["kind = \"saltelli\"\nsamples = 4", "kind = \"morris\"\ntrajectories = 4"] {
        let said = complaint(&square(design, ABOVE));
        assert!(said.contains("only analysed as a whole") && said.contains("\"sobol\""), "{said}");
    }
    // a factor on two paths with one value each is a number; two values that differ are none
    let text = |apply: &str| {
        format!(
            "design.kind = \"one_at_a_time\"
            [[parameters]]
            name = \"k\"
            paths = [\"belts.lap.k1\", \"materials.foam.k1\"]
            {apply}
            [[constraints]]
            sum = {{ k = 1 }}
            max = 9e9"
        )
    };
    let said = complaint(&text("range = { from = 1000, to = 2000 }"));
    assert!(said.contains("`k` has no single value in the base scenario"), "{said}");
    assert_eq!(complaint(&text("apply = \"factor\"\nrange = { from = 0.5, to = 2 }")), "");
}

#[test]
fn a_base_that_breaks_a_constraint_is_told_where_it_is_run_and_a_search_needs_a_point() {
    let read = |constraint: &str| {
        let text = format!("base = \"short.toml\"\n{SQUARE}\n[[constraints]]\n{constraint}");
        StudyText::read(&text, Format::Toml, "study.toml").unwrap()
    };
    let optimise = |constraint: &str| read(constraint).bind_optimise(base(), &[], &no_files);
    let kept = optimise("sum = { a = 1, b = 1 }\nmax = 2").unwrap();
    assert!(kept.warnings.is_empty() && kept.relations.len() == 1, "{}", kept.warnings);
    let warned = optimise("sum = { a = 1, b = 1 }\nmin = 1.99").unwrap().warnings.to_string();
    assert!(warned.contains("the base scenario breaks a constraint: the sum of"), "{warned}");
    let none = optimise("sum = { a = 1, b = 1 }\nmin = 2.5").unwrap_err().to_string();
    assert!(none.contains("no point of the ranges keeps all of them"), "{none}");
    let fit = read("sum = { a = 1, b = 1 }\nmin = 2.5").bind_fit(base(), (&IndexMap::new(), ""), &[], &no_files);
    assert!(fit.unwrap_err().to_string().contains("no point of the ranges"));
}
