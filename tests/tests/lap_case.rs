//! The lap-belted occupant on the cart against an independent program (dynamics by a general engine, force laws from a
//! separate reading of the model; it has the edge force at the contact point).

use nalgebra::{Point3, Vector3};
use occupant_core::body::tti12;
use occupant_core::model::Model;
use occupant_core::model::setup::Integrator;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use occupant_tests::cart::lap;
use occupant_tests::cases::{INCH_M, LBF_N};
use occupant_tests::measure::assert_below;
use serde::Deserialize;

#[derive(Deserialize)]
struct Reference {
    samples: Vec<Row>,
}

/// One instant: vehicle axes, inches and pounds.
#[derive(Deserialize)]
struct Row {
    time_s: f64,
    sphere_centres: Vec<[f64; 3]>,
    /// Norm of contact, friction and belt force together.
    sphere_forces: Vec<f64>,
    lap_belt: f64,
    head_cg_acc: [f64; 3],
    chest_cg_acc: [f64; 3],
    pelvis_cg_acc: [f64; 3],
}

fn reference() -> Vec<Row> {
    let text = include_str!("../data/cart-lap.json");
    let reference: Reference = serde_json::from_str(text).unwrap();
    reference.samples
}

/// Greatest differences over a time span: places in m, forces and accelerations as fractions of the greatest ones.
#[derive(Clone, Copy, Default)]
struct Difference {
    place_m: f64,
    force: f64,
    belt: f64,
    acceleration: f64,
}

fn compare(sample: &Sample<'_>, row: &Row, peak: &Peaks, worst: &mut Difference) {
    for i in 0..17 {
        let [x, y, z] = row.sphere_centres[i];
        let place = Point3::new(x, y, z) * INCH_M;
        worst.place_m = worst.place_m.max((sample.sphere_centre_m(i) - place).norm());
        let force = (sample.sphere_force_n(i) + sample.sphere_pull_n(i, None).unwrap()).norm();
        let expected = row.sphere_forces[i] * LBF_N;
        worst.force = worst.force.max((force - expected).abs() / peak.force_n);
    }
    let belt = sample.actions.belts[0].loop_force - row.lap_belt * LBF_N;
    worst.belt = worst.belt.max(belt.abs() / peak.belt_n);
    for (segment, expected) in [
        (tti12::HEAD, row.head_cg_acc),
        (tti12::UPPER_TORSO, row.chest_cg_acc),
        (tti12::LOWER_TORSO, row.pelvis_cg_acc),
    ] {
        let expected = Vector3::from(expected) * INCH_M;
        let off = (sample.cg_acceleration_m_s2(segment) - expected).norm();
        worst.acceleration = worst.acceleration.max(off / peak.acceleration_m_s2);
    }
}

/// Greatest values of the reference.
struct Peaks {
    force_n: f64,
    belt_n: f64,
    acceleration_m_s2: f64,
}

fn peaks(rows: &[Row]) -> Peaks {
    let greatest = |values: Vec<f64>| values.into_iter().fold(0.0, f64::max);
    let forces = rows.iter().flat_map(|r| r.sphere_forces.clone()).collect();
    let norm = |a: &[f64; 3]| Vector3::from(*a).norm();
    Peaks {
        force_n: greatest(forces) * LBF_N,
        belt_n: greatest(rows.iter().map(|r| r.lap_belt).collect()) * LBF_N,
        acceleration_m_s2: greatest(rows.iter().map(|r| norm(&r.head_cg_acc)).collect()) * INCH_M,
    }
}

/// Differences until 0.1 s and after it.
fn differences(step_s: f64) -> [Difference; 2] {
    let rows = reference();
    let peak = peaks(&rows);
    let mut worst = [Difference::default(); 2];
    let mut setup = lap(Integrator::Rk4 { step_s });
    setup.time.output_s = 5e-3;
    let model = Model::new(setup).unwrap();
    simulate(
        &model,
        Watch(|s: &Sample<'_>| {
            let row = &rows[s.index];
            assert!((s.time_s - row.time_s).abs() < 1e-9);
            let late = usize::from(s.time_s > 0.1 + 1e-9);
            compare(s, row, &peak, &mut worst[late]);
        }),
    )
    .unwrap();
    worst
}

#[test]
fn at_its_own_step_the_independent_program_gives_the_same_motion_and_forces() {
    let [early, late] = differences(5e-5);
    for (when, d) in [("until 0.1 s", early), ("after 0.1 s", late)] {
        // The reference is rounded to about 1e-8 m and 1e-4 lb.
        // Measured: 1.9e-8.
        assert_below(&format!("sphere paths {when}, m"), d.place_m, 1e-5);
        // Measured: 1.6e-8.
        assert_below(&format!("sphere forces {when}, of the peak"), d.force, 1e-5);
        // Measured: 2.9e-8.
        assert_below(&format!("belt force {when}, of its peak"), d.belt, 1e-5);
        // Measured: 9.8e-9.
        assert_below(&format!("accelerations {when}, of the peak"), d.acceleration, 1e-5);
    }
}

#[test]
fn at_twice_its_step_the_difference_is_that_of_the_step() {
    let [early, late] = differences(1e-4);
    // Measured: 6.6e-4.
    assert_below("sphere paths until 0.1 s, m", early.place_m, 1e-3);
    // Measured: 8.4e-5.
    assert_below("sphere forces until 0.1 s, of the peak", early.force, 5e-3);
    // Measured: 1.6e-5.
    assert_below("belt force until 0.1 s, of its peak", early.belt, 5e-3);
    // after the first hard head contact
    // Measured: 2.5e-4.
    assert_below("sphere forces after 0.1 s, of the peak", late.force, 2e-2);
    // Measured: 2.1e-4.
    assert_below("belt force after 0.1 s, of its peak", late.belt, 2e-2);
}
