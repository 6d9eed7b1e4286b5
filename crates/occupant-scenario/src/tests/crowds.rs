//! Very many of one thing: an answer or a complaint, and soon.

use std::fmt::Write as _;

use super::{load, short_with};

/// Messages on the short scenario with `head` and `count` rows; its settling if there is no error.
fn said(head: &str, count: usize, row: impl Fn(usize) -> String) -> Result<[f64; 2], String> {
    let mut text = format!("{}\n{head}\n", short_with("settle = false", "settle = true"));
    (0..count).for_each(|i| writeln!(text, "{}", row(i)).unwrap());
    let (model, _) = load(&text).and_then(|loaded| loaded.model()).map_err(|problems| problems.to_string())?;
    Ok(model.start().settled.map_or([0.0; 2], |s| [s.moved_m, s.residual_force_n]))
}

#[test]
fn triggers_and_belts_are_counted() {
    let chain = |i: usize| match i {
        99 => "t99 = { kind = \"time\", at = 0.01 }".to_owned(),
        _ => format!("t{i} = {{ kind = \"any\", of = [\"t{}\"] }}", i + 1),
    };
    assert!(said("[triggers]", 30_000, chain).unwrap_err().contains("30000 triggers"));
    assert!(said("[triggers]", 100, chain).is_ok());
    let belt = |i: usize| format!("[belts.b{i}]\nsphere = \"pelvis\"\nanchors = [[0, -1, 1], [0, 1, 1]]\nk1 = 1e3");
    assert!(said("", 200, belt).unwrap_err().contains("belts"));
}

#[test]
fn groups_of_triggers_are_worked_out_once() {
    // followed one by one these are 2^90 ways
    let web = |i: usize| match i {
        0 => "t0 = { kind = \"time\", at = 0.01 }".to_owned(),
        _ => format!("t{i} = {{ kind = \"all\", of = [\"t{0}\", \"t{0}\"] }}", i - 1),
    };
    assert!(said("[triggers]", 90, web).is_ok());
}

#[test]
fn what_is_far_does_not_change_how_a_body_settles() {
    let far = |i: usize| {
        let (x, y) = (20 + i % 50, i / 50);
        format!("q{i} = {{ kind = \"box\", material = \"foam\", centre = [{x}, {y}, 0], lengths = [0.1, 0.1, 0.1] }}")
    };
    let alone = said("", 0, far).unwrap();
    assert!(alone[0] > 1e-3 && alone[1] < 1.0, "{alone:?}");
    assert_eq!(said("[solids]", 2000, far).unwrap(), alone);
}

#[test]
fn surfaces_that_all_share_one_edge_are_refused() {
    let fan = |i: usize| {
        let end = 0.5 + 1e-5 * i as f64;
        format!(
            "[surfaces.q{i}]\nmaterial = \"foam\"\nfacing = \"order\"\npoints = [[20, 0, 0.5], [21, 0, 0.5], [{end:.5}, 1, 0.5]]"
        )
    };
    let found = said("", 3000, fan);
    assert!(found.clone().unwrap_err().contains("too many neighbours"), "{found:?}");
}

/// Each step of a run would evaluate all of them, and be as short as their total stiffness requires.
#[test]
fn a_body_that_touches_things_by_thousands_is_refused() {
    let under = |count: usize| {
        let boxes = (0..count).map(|i| {
            format!(
                "q{i} = {{ kind = \"box\", material = \"foam\", centre = [0, 0, 0.31], lengths = [0.5, 0.5, 0.5] }}\n"
            )
        });
        let text = format!("{}\n[solids]\n{}", super::SHORT, boxes.collect::<String>());
        load(&text).and_then(|loaded| loaded.model()).map(|_| ()).map_err(|problems| problems.to_string())
    };
    let said = under(1500).unwrap_err();
    assert!(
        said.contains("contacts of spheres with surfaces and solids at the start") && said.contains("at most 2000"),
        "{said}"
    );
    assert_eq!(under(100), Ok(()));
}
