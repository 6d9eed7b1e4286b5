//! Samples that would cost too much: rows with their reason, which hold nobody up.

use std::fs;

use occupant_core::run::batch::Kernel;

use super::{answer, column, err, folder_with, rows};

const STUDY: &str = r#"
    base = "case.toml"
    design.kind = "full_factorial"
    [set]
    "time.end" = "20 ms"
    [[parameters]]
    path = "joints.neck.damping"
    list = ["1 N m s/rad", "1e5 N m s/rad", "2 N m s/rad", "3 N m s/rad"]
"#;

#[test]
fn a_sample_beyond_its_evaluations_fails_alike_beside_others_and_alone() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    let case = fs::read_to_string(at.join("case.toml")).unwrap();
    for integrator in ["rk4", "adaptive"] {
        if integrator == "adaptive" {
            let adaptive = case.replace("step = \"0.1 ms\"", "").replace("kind = \"rk4\"", "kind = \"adaptive\"");
            fs::write(at.join("case.toml"), adaptive).unwrap();
        }
        let swept = |name: &str, more: &[&str]| {
            let words = [&["sweep", "study.toml", "-o", name, "--csv", "--threads", "1"], more].concat();
            // none completes if all are beyond it
            answer(at, &words);
            rows(at, name)
        };
        let free = swept(&format!("{integrator}-free"), &[]);
        let costs: Vec<f64> = column(&free, "solver.evaluations").iter().map(|n| n.parse().unwrap()).collect();
        // with fixed steps all cost the same
        let most = if integrator == "rk4" { (0.5 * costs[0]).floor() } else { costs[0].max(costs[2]).max(costs[3]) };
        assert!(integrator == "rk4" || costs[1] > 2.0 * most, "{costs:?}");
        let limit = format!("time.max_evaluations={most}");
        let here = |kernel: &&str| Kernel::named(kernel).is_some_and(Kernel::is_available);
        let limited: Vec<_> = ["scalar", "lanes4", "lanes8"]
            .into_iter()
            .filter(here)
            .map(|kernel| swept(&format!("{integrator}-{kernel}"), &["--set", &limit, "--kernel", kernel]))
            .collect();
        assert!(limited.iter().all(|table| *table == limited[0]), "{integrator}");
        let status = column(&limited[0], "status");
        let expected =
            if integrator == "rk4" { ["failed"; 4] } else { ["completed", "failed", "completed", "completed"] };
        assert_eq!(status, expected, "{integrator}");
        // the stiff one diverges with fixed steps
        let stopped = if integrator == "rk4" { 2 } else { 1 };
        let reason = &column(&limited[0], "reason")[stopped];
        assert!(reason.contains("`time.max_evaluations` permits") && reason.contains("too stiff"), "{reason}");
        let cost: f64 = column(&limited[0], "solver.evaluations")[stopped].parse().unwrap();
        assert!(cost > most && cost <= most + 8.0, "{cost} of {most}");
        // those that are within it have the bits of the study without it
        if integrator == "adaptive" {
            assert_eq!(column(&free, "hic15")[2], column(&limited[0], "hic15")[2]);
        }
    }
}

#[test]
fn a_run_beyond_its_wall_time_says_so() {
    let folder = folder_with(STUDY);
    let words = ["sweep", "study.toml", "-o", "late", "--csv", "--set", "time.max_wall_time=1e-9 s", "--quiet"];
    let said = err(&answer(folder.path(), &words));
    assert!(said.contains("no sample has valid results"), "{said}");
    let reasons = column(&rows(folder.path(), "late"), "reason");
    assert!(reasons.iter().all(|reason| reason.contains("longer than `time.max_wall_time` permits")), "{reasons:?}");
}
