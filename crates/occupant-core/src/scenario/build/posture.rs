//! `[seats]`, `[posture]`, `[initial_state]` → [`InitialPosture`] and [`InitialVelocity`].

use nalgebra::Vector3;

use super::builder::Builder;
use crate::body::Body;
use crate::model::seating::{InitialPosture, InitialVelocity, Seating};
use crate::motion::report_coordinates::{DOF, ReportCoordinates};
use crate::scenario::kind::UnitSystem;
use crate::scenario::model::{InitialStateSection, PostureSection, Scenario};

/// Position and velocity at the start.
pub(super) fn posture(b: &mut Builder, s: &Scenario, body: &Body) -> (Option<InitialPosture>, InitialVelocity) {
    check_seats(b, s);
    match (&s.posture, &s.initial_state) {
        (Some(posture), _) => (seating(b, s, posture).map(InitialPosture::Seated), velocity(b, posture)),
        (None, Some(state)) => (state_of(b, s, state, body), InitialVelocity::default()),
        (None, None) => (None, InitialVelocity::default()),
    }
}

/// Every seat must stand on surfaces that exist, whether or not somebody sits on it.
fn check_seats(b: &mut Builder, s: &Scenario) {
    for (name, seat) in &s.seats {
        for (key, surface) in [("cushion", &seat.cushion), ("back", &seat.back)] {
            let names = s.surfaces.keys().map(String::as_str);
            b.index_of(&format!("seats.{name}.{key}"), "surface", surface, names);
        }
    }
}

fn seating(b: &mut Builder, s: &Scenario, p: &PostureSection) -> Option<Seating> {
    let names = s.seats.keys().map(String::as_str);
    let at = b.index_of("posture.seat", "seat", &p.seat, names);
    let (name, seat) = s.seats.get_index(at)?;
    Some(Seating {
        cushion: s.surfaces.get_index_of(&seat.cushion)?,
        back: s.surfaces.get_index_of(&seat.back)?,
        lateral_m: b.optional(&format!("seats.{name}.y"), &seat.y, 0.0),
        lean_rad: [
            b.si("posture.middle_torso", &p.middle_torso),
            b.si("posture.upper_torso", &p.upper_torso),
            b.si("posture.head", &p.head),
            b.si("posture.lower_torso", &p.lower_torso),
        ],
        upper_arms_rad: b.si("posture.upper_arms", &p.upper_arms),
        elbows_rad: b.si("posture.elbows", &p.elbows),
        heels_m: [b.si("posture.heels[0]", &p.heels[0]), b.si("posture.heels[1]", &p.heels[1])],
        settle: p.settle.unwrap_or(false),
    })
}

fn velocity(b: &mut Builder, p: &PostureSection) -> InitialVelocity {
    match (&p.velocity, p.moves_with_vehicle) {
        (Some(v), _) => InitialVelocity::Given(Vector3::from(b.triple("posture.velocity", v))),
        (None, Some(false)) => InitialVelocity::VehicleOrigin,
        (None, Some(true)) => InitialVelocity::WithVehicle,
        (None, None) => InitialVelocity::default(),
    }
}

/// The exact state, with the pairs that have passed where they are told.
fn state_of(b: &mut Builder, s: &Scenario, state: &InitialStateSection, body: &Body) -> Option<InitialPosture> {
    let coordinates = Box::new(coordinates(b, state)?);
    let Some(pairs) = &state.passed else {
        return Some(InitialPosture::Coordinates(coordinates));
    };
    let mut passed = Vec::with_capacity(pairs.len());
    for (i, [sphere, surface]) in pairs.iter().enumerate() {
        let path = |part: usize| format!("initial_state.passed[{i}][{part}]");
        let spheres = body.spheres.iter().map(|s| s.name.as_str());
        let surfaces = s.surfaces.keys().map(String::as_str);
        let meeting = s.surfaces.get(surface).and_then(|f| f.spheres.as_ref());
        if meeting.is_some_and(|spheres| !spheres.contains(sphere)) {
            b.error_with_hint(
                &path(0),
                format!("`{surface}` cannot be passed by `{sphere}`: it is not among its `spheres`"),
                format!("one of the spheres of `surfaces.{surface}.spheres`"),
                format!("add \"{sphere}\" to them, or leave this pair out"),
            );
        }
        passed.push((
            b.index_of(&path(0), "sphere", sphere, spheres),
            b.index_of(&path(1), "surface", surface, surfaces),
        ));
    }
    Some(InitialPosture::Continued { coordinates, passed })
}

/// q₁–q₃ are lengths in the file's unit, all others radians.
fn coordinates(b: &mut Builder, section: &InitialStateSection) -> Option<ReportCoordinates> {
    let length_m = match b.units {
        UnitSystem::Si => 1.0,
        UnitSystem::InchPound => 0.0254,
    };
    let si = |values: &[f64]| -> Option<[f64; DOF]> {
        let scaled = values.iter().enumerate();
        let scaled: Vec<f64> = scaled.map(|(i, x)| if i < 3 { x * length_m } else { *x }).collect();
        scaled.try_into().ok()
    };
    Some(ReportCoordinates { q: si(&section.q)?, rates: si(&section.rates)? })
}
