//! Start of the occupant and belts → series 4 and 10, or 6, and 13.

use occupant_core::body::tti12::{LOWER_BACK, UPPER_BACK};
use occupant_core::forces::belt::{Belt, RestLength};
use occupant_core::model::seating::{InitialPosture, InitialVelocity, Seating};

use super::Back;
use super::extension::coordinate_fields;
use super::joints::ball_of;
use crate::cards::{BELTS, POSTURE, SEATS};
use crate::compartment::CompartmentLayout;

pub(super) fn read(back: &mut Back<'_>, layout: &CompartmentLayout) {
    let joints = &back.setup.joints;
    let springs = [("upper_back", UPPER_BACK), ("lower_back", LOWER_BACK)]
        .map(|(name, joint)| (name, ball_of(joints, joint).spring));
    match &back.setup.posture {
        InitialPosture::Seated(seating) => {
            back.deck.set("NPOS", "0");
            seated(back, layout, seating);
            match back.setup.velocity {
                InitialVelocity::Given(v) => back.set_all([("VXVC", v.x), ("VYVC", v.y), ("VZVC", v.z)]),
                _ => back.misfit(
                    "posture.velocity is not given: cards need the occupant's velocity in vehicle axes (series 4)",
                ),
            }
            back.misfit_if(
                springs.iter().any(|(_, spring)| spring.is_some_and(|s| s.rest_rad.is_some())),
                "joints.*.rest_angle beside a posture: cards take β₀ from the posture if NPOS = 0",
            );
        }
        InitialPosture::Coordinates(coordinates) | InitialPosture::Continued { coordinates, .. } => {
            back.deck.set("NPOS", "1");
            coordinate_fields(coordinates).for_each(|(name, si)| back.set(name, si));
            for (joint, spring) in springs {
                back.misfit_if(
                    spring.is_some_and(|s| s.rest_rad.is_none()),
                    format!("joints.{joint} without rest_angle: a deck with NPOS = 1 needs β₀ (BETA4, BETA7)"),
                );
            }
        }
    }
    if let InitialPosture::Continued { passed, .. } = &back.setup.posture {
        passed_on(back, layout, passed);
    }
    belts(back);
}

/// Passed pairs by the report's numbers.
fn passed_on(back: &mut Back<'_>, layout: &CompartmentLayout, passed: &[(usize, usize)]) {
    for &(sphere, surface) in passed {
        let name = back.setup.surfaces.get(surface).map_or("", |s| &s.name);
        match layout.number_of(name) {
            Some(number) => back.passed.push(((sphere + 1).to_string(), number.to_string())),
            None => back.misfit(format!("initial_state.passed names {name}, which is none of the 25 surfaces")),
        }
    }
}

fn seated(back: &mut Back<'_>, layout: &CompartmentLayout, seating: &Seating) {
    back.misfit_if(seating.settle, "posture.settle: cards have no settling");
    let number = |at: usize| back.setup.surfaces.get(at).and_then(|s| layout.number_of(&s.name));
    let (cushion, rest) = (number(seating.cushion), number(seating.back));
    let right_hand_drive = back.digits("SWP").is_some_and(|d| d.starts_with('-'));
    let is_left = (seating.lateral_m < 0.0) != right_hand_drive;
    let is_seat = |at: &usize| Some(SEATS[*at].cushion) == cushion && Some(SEATS[*at].back) == rest;
    let mut seats = (0..SEATS.len()).filter(is_seat);
    let seat = kept_seat(back).filter(is_seat).or_else(|| seats.find(|at| SEATS[*at].is_left == is_left));
    let is_left = seat.map_or(is_left, |at| SEATS[at].is_left);
    match seat {
        Some(at) => back.deck.set("NOPTSP", &(at + 1).to_string()),
        None => back.misfit(
            "posture.seat: cards have driver, right front, left rear and right rear on the front and rear seats",
        ),
    }
    let lateral_m = if is_left { -seating.lateral_m } else { seating.lateral_m };
    back.agree("SWP", lateral_m, "the seat's place sideways");
    let angles = seating.lean_rad.into_iter().chain([seating.upper_arms_rad, seating.elbows_rad]);
    for (field, angle) in POSTURE.into_iter().zip(angles) {
        back.set(field, angle);
    }
    back.set_all([("XHPV", seating.heels_m[0]), ("ZHPV", seating.heels_m[1])]);
}

/// The seat by the notes, where the place sideways does not tell it.
fn kept_seat(back: &Back<'_>) -> Option<usize> {
    let digits = back.kept.get("NOPTSP")?;
    (0..SEATS.len()).find(|at| digits.parse() == Ok((at + 1) as f64))
}

fn belts(back: &mut Back<'_>) {
    let setup = back.setup;
    let exact = !matches!(setup.posture, InitialPosture::Seated(_));
    let mut used = 0;
    back.deck.add_series(13, 0);
    for belt in &setup.belts {
        let sphere = setup.body.spheres.get(belt.sphere).map_or("", |s| s.name.as_str());
        match BELTS.iter().find(|b| b.2 == sphere) {
            Some((number, ..)) if used & number == 0 => {
                used |= number;
                read_belt(back, belt, *number, exact);
            }
            Some((_, name, _)) => back.misfit(format!("belts.{}: cards have one {name} belt", belt.name)),
            None => back.misfit(format!("belts.{}: the cards' belts loop round pelvis and chest", belt.name)),
        }
    }
    back.deck.set("NOPBLT", &used.to_string());
    if used == 0 {
        back.deck.remove_series(13);
    }
}

fn read_belt(back: &mut Back<'_>, belt: &Belt, number: u32, exact: bool) {
    for (end, anchor) in [1, 2].into_iter().zip(&belt.anchors_m) {
        for (axis, place) in [1, 2, 3].into_iter().zip(anchor.iter()) {
            back.set(format!("P{end}({number},{axis})"), *place);
        }
    }
    let w = &belt.webbing;
    for (field, si) in [("SK1", w.k1_n_per_m), ("SK2", w.k2_n_per_m), ("DELC", w.break_m)] {
        back.set(format!("{field}({number})"), si);
    }
    let returns_all = w.returned_1 == 1.0 && w.returned_2 == 1.0;
    back.misfit_if(!returns_all, format!("belts.{}.mu1, mu2: the cards' webbing gives all its energy back", belt.name));
    match (belt.rest, exact) {
        (RestLength::Slack { slack_m }, false) => back.set(format!("SLACK({number})"), slack_m),
        (RestLength::Given { length_m }, true) => back.set(format!("BLTLEO({number})"), length_m),
        (RestLength::Given { .. }, false) => {
            back.misfit(format!("belts.{}.length: with a posture cards take slack", belt.name))
        }
        (RestLength::Slack { .. }, true) => {
            back.misfit(format!("belts.{}: with an exact state cards take its length (BLTLEO)", belt.name))
        }
    }
}
