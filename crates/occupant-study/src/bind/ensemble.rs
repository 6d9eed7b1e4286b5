//! The `[ensemble]` of a study: tolerances find their places.

use super::Binder;
use super::law::{Quantities, kind_of};
use super::parameters::paths_at;
use crate::ensemble::{self, Change, Ensemble, Perturbation};
use crate::parameter::{Parameter, Target};
use crate::section::{ApplyChoice, EnsembleSection, PerturbationSection};
use occupant_core::scenario::Draft;
use occupant_core::scenario::sections::{Angle, Length, Ratio};

/// The ensemble of a study, if it has one. Without any tolerance it has the standard ones.
pub(super) fn bind(binder: &mut Binder, base: &Draft, parameters: &[Parameter]) -> Option<Ensemble> {
    let section = binder.text.section.ensemble.as_ref()?;
    let mut perturbations = tolerances(binder, base, parameters, section);
    for (i, written) in section.perturbations.iter().enumerate() {
        let at = format!("ensemble.perturbations[{i}]");
        perturbations.extend(perturbation(binder, written, &at));
    }
    if !has_tolerances(section) {
        perturbations = ensemble::standard(base, parameters, &ensemble::Tolerances::default());
    }
    Some(Ensemble { members: section.members, perturbations })
}

fn has_tolerances(section: &EnsembleSection) -> bool {
    section.posture.is_some()
        || section.place.is_some()
        || section.path.is_some()
        || section.stiffness.is_some()
        || !section.perturbations.is_empty()
}

fn tolerances(
    binder: &mut Binder,
    base: &Draft,
    parameters: &[Parameter],
    section: &EnsembleSection,
) -> Vec<Perturbation> {
    let posture = section.posture.as_ref().map(Angle::si);
    let place = section.place.as_ref().map(Length::si);
    let path = section.path.as_ref().map(Ratio::si);
    let stiffness = section.stiffness.as_ref().map(Ratio::si);
    let groups = [
        ("posture", posture.map(|most| ensemble::posture(base, most)), "a posture"),
        ("place", place.map(|most| ensemble::seat_place(base, most)), "a posture"),
        ("path", path.map(|most| ensemble::path(base, parameters, most)), "a pulse with `peak` or `delta_v`"),
        ("stiffness", stiffness.map(|most| ensemble::stiffness(base, most)), "materials or belts"),
    ];
    let mut all = Vec::new();
    for (key, found, expected) in groups {
        match found {
            Some(found) if found.is_empty() => {
                let words = format!("the base scenario has nothing that `{key}` could change");
                binder.error(&format!("ensemble.{key}"), words, expected, None);
            }
            Some(found) => all.extend(found),
            None => {}
        }
    }
    all
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
