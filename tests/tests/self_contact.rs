//! A body that touches itself: momentum, energy, the same bits in lanes and when resumed, and limbs that do not go through.

use nalgebra::Vector3;
use occupant_core::model::Model;
use occupant_core::model::setup::Setup;
use occupant_core::results::checkpoint::Checkpoint;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::{Summarizer, Summary};
use occupant_core::run::simulate::{resume, simulate};
use occupant_tests::measure::assert_below;
use occupant_tests::room::{FINE, Last, ends_alike_side_by_side, run, setup};

/// A body afloat that brings hands, elbows and knees together.
const CLAP: &str = include_str!("../data/clap.toml");

fn clap(set: &[&str]) -> Setup {
    setup(CLAP, set)
}

/// Linear momentum, and angular momentum about the origin, space axes.
fn momenta(s: &Sample<'_>) -> [Vector3<f64>; 2] {
    let body = s.model.body();
    let segment = |segment| {
        let properties = body.segment(segment);
        let (place, velocity) = (s.vehicle.point_to_space(s.cg_m(segment).coords), s.cg_velocity_m_s(segment));
        let axes = s.evaluation.kinematics.axes[segment.index()].to_matrix();
        let spin = axes * properties.inertia_kg_m2.component_mul(&s.angular_velocity_rad_s(segment));
        let momentum = properties.mass_kg * velocity;
        [momentum, place.cross(&momentum) + spin]
    };
    let all = body.tree.segments().map(segment);
    all.fold([Vector3::zeros(); 2], |[p, l], [q, m]| [p + q, l + m])
}

#[test]
fn a_body_afloat_that_claps_keeps_its_momenta_and_its_energy() {
    let mut all = Vec::new();
    let mut touching = 0;
    let look = |s: &Sample<'_>| {
        all.push(momenta(s));
        touching += usize::from(s.contacts().next().is_some());
    };
    let (_, outcome) = run(clap(&[]), Watch(look));
    assert!(touching > 10 && outcome.first_touches.len() >= 4, "{:?}", outcome.first_touches);
    let drift = |k: usize| all.iter().map(|now| (now[k] - all[0][k]).norm()).fold(0.0, f64::max);
    // measured: 7.7e-9; the state has velocities of segments, so that momenta are kept to the integrator's order
    assert_below("linear momentum, N s", drift(0), 1e-7);
    assert_below("angular momentum, N m s", drift(1), 1e-4);
    assert_below("energy balance", outcome.energy.balance_error, 1e-5);
}

#[test]
fn without_losses_the_energy_is_all_there() {
    let set = ["materials.flesh.mu1=1", "materials.flesh.mu2=1", "materials.flesh.friction=0"];
    let mut energies = Vec::new();
    let (_, outcome) = run(clap(&set), Watch(|s: &Sample<'_>| energies.push(s.energy)));
    let most = energies.iter().map(|e| e.lost_j[0].abs() + e.lost_j[1].abs()).fold(0.0, f64::max);
    // Measured: 2.3e-5, what steps across the beginnings and ends of contacts miss.
    assert_below("energy that contacts dissipate, part of all", most / outcome.energy.greatest_kinetic_j, 1e-4);
}

/// What each sphere feels is opposite to what the other feels, at the same place.
#[test]
fn forces_of_a_pair_are_opposite_and_act_at_one_place() {
    let mut pairs = 0;
    let look = |s: &Sample<'_>| {
        let contacts: Vec<_> = s.contacts().collect();
        let base = s.model.setup().solids.len() + s.model.setup().surfaces.len();
        for one in &contacts {
            let other = contacts.iter().find(|c| c.sphere + base == one.surface && c.surface == one.sphere + base);
            let other = other.expect("the other side of the pair");
            assert!((one.force_n + other.force_n).norm() <= 1e-12 * one.force_n.norm());
            assert!((one.point_m - other.point_m).norm() < 1e-12);
            pairs += 1;
        }
    };
    run(clap(&[]), Watch(look));
    assert!(pairs > 50, "{pairs}");
}

fn summary(set: &[&str]) -> Summary {
    let mut summarizer = Summarizer::new();
    run(clap(set), &mut summarizer);
    summarizer.summary(None).unwrap()
}

#[test]
fn the_summary_tells_which_parts_met() {
    let summary = summary(&[]);
    for [part, other] in [["left_hand", "right_hand"], ["right_hand", "left_hand"]] {
        let met = summary.contacts.iter().find(|c| c.part == part && c.surface == other);
        let met = met.unwrap_or_else(|| panic!("{part} on {other} of {:?}", summary.contacts));
        assert!(!met.at_start && met.closing_m_s > 0.0 && met.speed_m_s >= met.closing_m_s);
        assert!(summary.sphere_forces.iter().any(|peak| peak.sphere == part && peak.force_n > 0.0));
    }
}

#[test]
fn a_run_resumed_while_the_body_touches_itself_has_the_bits_of_the_whole_run() {
    for set in [&[][..], &[FINE]] {
        let model = Model::new(clap(set)).unwrap();
        let mut checkpoints: Vec<(bool, Checkpoint)> = Vec::new();
        let look = |s: &Sample<'_>| checkpoints.push((s.contacts().next().is_some(), s.checkpoint()));
        simulate(&model, Watch(look)).unwrap();
        let (_, middle) = checkpoints.iter().find(|(touches, _)| *touches).unwrap().clone();
        let mut last = Last::default();
        resume(&model, &middle, &mut last).unwrap();
        assert!(last.0 == checkpoints.pop().map(|(_, checkpoint)| checkpoint));
    }
}

#[test]
fn bodies_that_touch_themselves_side_by_side_have_the_bits_of_bodies_alone() {
    ends_alike_side_by_side(|i| {
        let stiff = format!("materials.flesh.k1={}", 1.5e5 + 1e4 * f64::from(i));
        Model::new(clap(&[&stiff, "integrator.step=\"0.2 ms\""])).unwrap()
    });
}

#[test]
fn parts_that_overlap_at_the_start_are_told_and_feel_each_other_only_after_they_have_come_apart() {
    // hands in each other
    let model = Model::new(clap(&["initial_state.q[15]=-0.25", "initial_state.q[18]=0.25"])).unwrap();
    let words = model.warnings().to_string();
    assert!(words.contains("self_contact") && words.contains("overlap at the start"), "{words}");
    let mut first = None;
    let look = |s: &Sample<'_>| {
        first.get_or_insert(s.contacts().count());
    };
    simulate(&model, Watch(look)).unwrap();
    assert_eq!(first, Some(0));
}
