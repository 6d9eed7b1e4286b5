//! The `[ensemble]` of a study: tolerances find their places.

use super::Binder;
use super::law::{Quantities, kind_of};
use super::parameters::paths_at;
use crate::ensemble::{self, Change, Ensemble, Perturbation};
use crate::parameter::{Parameter, Target};
use crate::section::{ApplyChoice, PerturbationSection};
use occupant_scenario::Draft;

/// The ensemble of a study, if any. Without tolerances it has the standard ones.
pub(super) fn bind(binder: &mut Binder, base: &Draft, parameters: &[Parameter]) -> Option<Ensemble> {
    let section = binder.text.section.ensemble.as_ref()?;
    let posture = section.posture.as_ref().map(|most| ensemble::posture(base, most.si()));
    let place = section.place.as_ref().map(|most| ensemble::seat_place(base, most.si()));
    let path = section.path.as_ref().map(|most| ensemble::path(base, parameters, most.si()));
    let stiffness = section.stiffness.as_ref().map(|most| ensemble::stiffness(base, most.si()));
    let segments = section.segments.as_ref().map(|most| ensemble::segments(base, most.si()));
    if segments.is_some() {
        binder.refuse_size(parameters, "ensemble.segments");
    }
    let groups = [
        ("posture", posture, "a posture"),
        ("place", place, "a posture"),
        ("path", path, "a path that moves: a pulse with `peak` or `delta_v`, a table or a record"),
        ("stiffness", stiffness, "materials or belts"),
        ("segments", segments, "a body"),
    ];
    let inputs = binder.inputs(&section.inputs, "ensemble.inputs", base);
    let says_nothing = section.perturbations.is_empty()
        && section.inputs.is_empty()
        && groups.iter().all(|(_, found, _)| found.is_none());
    let mut perturbations = Vec::new();
    if says_nothing {
        perturbations = ensemble::standard(base, parameters, &ensemble::Tolerances::default());
    }
    for (key, found, expected) in groups {
        if found.as_ref().is_some_and(Vec::is_empty) {
            let words = format!("the base scenario has nothing that `{key}` could change");
            binder.error(&format!("ensemble.{key}"), words, expected, None);
        }
        perturbations.extend(found.into_iter().flatten());
    }
    for (i, written) in section.perturbations.iter().enumerate() {
        perturbations.extend(perturbation(binder, written, &format!("ensemble.perturbations[{i}]")));
    }
    perturbations.extend(ensemble::of_parameters(inputs));
    Some(Ensemble { members: section.members, perturbations })
}

fn perturbation(binder: &mut Binder, section: &PerturbationSection, at: &str) -> Option<Perturbation> {
    let paths = paths_at(&section.path, &section.paths, at)?;
    let places = binder.places(&paths)?;
    let wanted = binder.common(&places, &paths[0].0)?;
    let apply = if section.factor.is_some() { ApplyChoice::Factor } else { ApplyChoice::Offset };
    if !binder.all_numbers(&places, &paths[0].0, apply) {
        return None;
    }
    let change = match (&section.factor, &section.offset) {
        (Some(factor), _) => Change::Factor(factor.si()),
        (None, Some(offset)) => {
            let quantities = Quantities { kind: kind_of(&wanted, apply), wanted: &wanted, units: binder.units() };
            Change::Offset(quantities.number(binder, offset, &format!("{at}.offset"))?)
        }
        (None, None) => return None,
    };
    Some(Perturbation { change, targets: places.iter().map(Target::of).collect() })
}
