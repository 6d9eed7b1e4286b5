//! Start of the occupant and belts → series 4 and 10, or 6, and 13; the end of a run → series 6 and 14.

use std::collections::BTreeSet;

use occupant_core::body::tti12::{LOWER_BACK, UPPER_BACK};
use occupant_core::forces::belt::{Belt, RestLength};
use occupant_core::forces::contact::{PASSED, PairHistory};
use occupant_core::model::Model;
use occupant_core::model::seating::{InitialPosture, InitialVelocity, Seating, Settling};
use occupant_core::motion::report_coordinates::ReportCoordinates;
use occupant_core::results::sample::Sample;

use super::Back;
use super::joints::ball_of;
use crate::cards::{BELTS, POSTURE, SEATS, field_named};
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
        InitialPosture::Mounted(_) => back.misfit("mount: cards have no rig"),
        InitialPosture::Placed(_) => back.misfit("posture: cards seat a body, and put none anywhere else"),
        InitialPosture::Together => back.misfit("occupants: cards have one"),
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
    back.misfit_if(seating.settle == Settling::Limp, "posture.limp: cards seat a body whose joints hold the posture");
    if seating.settle == Settling::Not {
        let text = "posture.settle = false: cards do not say it; `convert --seating pelvis` gives it again";
        back.remarks.push(text.into());
    }
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
    for field in POSTURE {
        let key = field_named(field).and_then(|field| field.key.as_deref()).unwrap_or_default();
        match seating.angle_rad(key.trim_start_matches("posture.")) {
            Some(angle_rad) => back.set(field, angle_rad),
            None => back.misfit(format!("{key} is not given: cards have one angle for both sides")),
        }
    }
    back.misfit_if(seating.angles_rad.len() > POSTURE.len(), "posture: cards have six angles");
    back.set_all([("XHPV", seating.heels_m[0]), ("ZHPV", seating.heels_m[1])]);
}

/// Seat from the notes, if the lateral position does not determine it.
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
    back.set_numbered(number, [("SK1", w.k1_n_per_m), ("SK2", w.k2_n_per_m), ("DELC", w.break_m)]);
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

/// End of a run, as far as cards can hold it. They contain no largest deformations, so an extension by cards is
/// approximate.
#[derive(Debug, Clone, PartialEq)]
pub struct RunEnd {
    /// Time, s.
    pub time_s: f64,
    /// The report's coordinates and their rates, SI.
    pub coordinates: ReportCoordinates,
    /// β₀ of the upper and the lower back joint, rad: rest angles of the spine's springs.
    pub spine_rest_rad: [f64; 2],
    /// L₀ of the lap and of the torso belt, m, if present.
    pub belt_lengths_m: [Option<f64>; 2],
    /// Pairs (sphere, surface) that have passed the surface's edge, by the report's numbers.
    pub passed: Vec<(u32, u32)>,
}

impl RunEnd {
    /// End of a run from its last sample and β₀ of the two back joints, [`spine_rest`] of the first sample.
    ///
    ///
    /// None for a body other than the report's.
    pub fn after(spine_rest_rad: [f64; 2], last: &Sample<'_>, layout: &CompartmentLayout) -> Option<Self> {
        let model = last.model;
        let loops_round =
            |belt: &Belt, sphere: &str| model.body().spheres.get(belt.sphere).is_some_and(|s| s.name == sphere);
        let length = |sphere: &str| {
            let at = model.setup().belts.iter().position(|belt| loops_round(belt, sphere))?;
            Some(model.system().forces.belts.get(at)?.rest_length)
        };
        Some(Self {
            time_s: last.time_s,
            coordinates: last.report_coordinates()?,
            spine_rest_rad,
            belt_lengths_m: BELTS.map(|(_, _, sphere)| length(sphere)),
            passed: passed(last, layout),
        })
    }

    /// Fields of series 6 and their SI numbers.
    pub(super) fn fields(&self) -> impl Iterator<Item = (String, f64)> {
        let springs = ["BETA4", "BETA7"].map(str::to_owned).into_iter().zip(self.spine_rest_rad);
        let lengths = ["BLTLEO(1)", "BLTLEO(2)"].map(str::to_owned).into_iter().zip(self.belt_lengths_m);
        let lengths = lengths.filter_map(|(name, length_m)| Some((name, length_m?)));
        springs.chain(lengths).chain(coordinate_fields(&self.coordinates))
    }
}

/// β₀ of the upper and the lower back joint: the scenario's, or the angles at the start.
pub fn spine_rest(first: &Sample<'_>) -> [f64; 2] {
    let joints = &first.model.setup().joints;
    [UPPER_BACK, LOWER_BACK].map(|joint| {
        ball_of(joints, joint).spring.and_then(|s| s.rest_rad).unwrap_or_else(|| first.joint_angle_rad(joint))
    })
}

fn passed(sample: &Sample<'_>, layout: &CompartmentLayout) -> Vec<(u32, u32)> {
    let surfaces = &sample.model.setup().surfaces;
    let number = |surface: usize| surfaces.get(surface).and_then(|s| layout.number_of(&s.name));
    let numbers = |(sphere, surface): (usize, usize)| Some((u32::try_from(sphere + 1).ok()?, number(surface)?));
    let pairs = passed_pairs(sample.model, &sample.history.memory.contacts);
    pairs.filter_map(numbers).collect::<BTreeSet<_>>().into_iter().collect()
}

/// The pairs (sphere, surface), by index, that have passed a surface's edge: those with NARRY = 0.
pub fn passed_pairs(model: &Model, pairs: &[PairHistory<f64>]) -> impl Iterator<Item = (usize, usize)> {
    let contacts = &model.system().forces.contacts;
    let groups = contacts.groups.iter().flat_map(|group| group.pairs.clone().map(|at| (group.sphere, at)));
    let passed = groups.filter(|(_, at)| pairs.get(*at).is_some_and(|pair| pair.phase == PASSED));
    let parts = |at: usize| contacts.pairs.get(at).map_or(&[][..], |pair| &pair.parts);
    passed.flat_map(move |(sphere, at)| parts(at).iter().map(move |part| (sphere, part.surface)))
}

/// The fields of the coordinates and of their rates.
fn coordinate_fields(coordinates: &ReportCoordinates) -> impl Iterator<Item = (String, f64)> {
    let pairs = (1..).zip(coordinates.q.into_iter().zip(coordinates.rates));
    pairs.flat_map(|(n, (q, rate))| [(format!("Q0({n})"), q), (format!("QDO({n})"), rate)])
}
