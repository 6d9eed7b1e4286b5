//! Designs for sensitivity analysis: Saltelli's blocks and Morris's trajectories.

use super::super::{Block, Role};
use super::{numbers, study};

/// Three parameters between 0 and 1.
fn cube(design: &str) -> super::Study {
    let parameter = |name: &str, path: &str| {
        format!("[[parameters]]\nname = \"{name}\"\npath = \"{path}\"\nrange = {{ from = 0, to = 1 }}\n")
    };
    study(&format!(
        "design = {design}\n{}{}{}",
        parameter("a", "materials.foam.friction"),
        parameter("b", "materials.foam.mu1"),
        parameter("c", "belts.lap.mu1"),
    ))
}

#[test]
fn saltelli_blocks_mix_the_columns_of_a_and_b() {
    for (second_order, len) in [(false, 5), (true, 8)] {
        let study = cube(&format!("{{ kind = \"saltelli\", samples = 16, second_order = {second_order} }}"));
        assert_eq!(study.len(), 16 * len);
        for point in 0..16 {
            let row = |i: u64| numbers(&study, point * len + i);
            let role = |i: u64| study.role(point * len + i);
            let (a, b) = (row(0), row(len - 1));
            assert_eq!(role(0), Role::Saltelli { point, block: Block::A });
            assert_eq!(role(len - 1), Role::Saltelli { point, block: Block::B });
            for parameter in 0..3 {
                let mut ab = a.clone();
                ab[parameter] = b[parameter];
                let at = 1 + parameter as u64;
                assert_eq!(row(at), ab);
                assert_eq!(role(at), Role::Saltelli { point, block: Block::Ab { parameter } });
                if second_order {
                    let mut ba = b.clone();
                    ba[parameter] = a[parameter];
                    assert_eq!(row(at + 3), ba);
                    assert_eq!(role(at + 3), Role::Saltelli { point, block: Block::Ba { parameter } });
                }
            }
            assert!((0..3).all(|d| a[d] != b[d]));
        }
    }
}

/// First-order indices of f = 4a + 2b + c with Saltelli's estimator: 16/21, 4/21, 1/21.
#[test]
fn saltelli_blocks_give_the_indices_of_a_linear_function() {
    let n = 1024;
    let study = cube(&format!("{{ kind = \"saltelli\", samples = {n} }}"));
    let f = |i: u64| {
        let x = numbers(&study, i);
        4.0 * x[0] + 2.0 * x[1] + x[2]
    };
    for (d, share) in [16.0, 4.0, 1.0].into_iter().enumerate() {
        // Sᵢ = ⟨f_B (f_ABᵢ − f_A)⟩/V
        let sum: f64 = (0..n).map(|j| (f(5 * j + 4) - 3.5) * (f(5 * j + 1 + d as u64) - f(5 * j))).sum();
        // measured: at most 3.6e-4
        let index = sum / n as f64 / (21.0 / 12.0);
        assert!((index - share / 21.0).abs() < 2e-3, "{d}: {index}");
    }
}

#[test]
fn a_morris_trajectory_changes_each_parameter_once_by_one_step() {
    for levels in [2, 4, 8] {
        let study = cube(&format!("{{ kind = \"morris\", trajectories = 40, levels = {levels} }}"));
        assert_eq!(study.len(), 160);
        let step = levels as f64 / (2.0 * (levels as f64 - 1.0));
        let mut orders = std::collections::HashSet::new();
        for trajectory in 0..40 {
            let mut order = Vec::new();
            for i in 1..4 {
                let index = trajectory * 4 + i;
                let (before, after) = (numbers(&study, index - 1), numbers(&study, index));
                let moved: Vec<usize> = (0..3).filter(|d| before[*d] != after[*d]).collect();
                let [d] = moved[..] else { panic!("{moved:?} at {index}") };
                assert!(((after[d] - before[d]).abs() - step).abs() < 1e-15);
                let Role::Morris { trajectory: of, step, changed: Some((changed, by)) } = study.role(index) else {
                    panic!("{:?}", study.role(index))
                };
                assert_eq!((of, step, changed), (trajectory, i as usize, d));
                assert!((after[d] - before[d] - by).abs() < 1e-15);
                order.push(d);
            }
            order.sort_unstable_by_key(|d| *d);
            assert_eq!(order, [0, 1, 2]);
            let changed = |i: u64| match study.role(trajectory * 4 + i) {
                Role::Morris { changed, .. } => changed.map(|(parameter, _)| parameter),
                other => panic!("{other:?}"),
            };
            orders.insert([1, 2, 3].map(changed));
            assert!(matches!(study.role(trajectory * 4), Role::Morris { step: 0, changed: None, .. }));
        }
        // all six orders of three parameters occur
        assert_eq!(orders.len(), 6);
        // values are levels
        for i in 0..160 {
            for x in numbers(&study, i) {
                let level = x * (levels as f64 - 1.0);
                assert!((level - level.round()).abs() < 1e-12, "{x}");
            }
        }
    }
}
