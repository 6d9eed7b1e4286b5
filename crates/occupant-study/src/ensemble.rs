//! Ensembles: the same sample many times with small changes, to see which figures are stable.
//!
//! An occupant's motion after a hard contact is chaotic: the smallest change grows. Member 0 is the sample itself.
//! Every other member changes each place by its own random number, uniform within plus and minus the tolerance. The
//! numbers depend only on seed, member and place. So members of different samples have the same changes, and an
//! ensemble of 64 begins with that of 32.

use super::law::{Law, Value};
use super::parameter::{Assignment, Parameter, Target, changed, place};
use super::random::{Purpose, unit};
use super::section::ApplyChoice;
use occupant_scenario::{Draft, Place, rival_path};
use placed_text::{Problem, Value as Written};
use serde::Serialize;

/// Tolerances of the standard perturbations.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Tolerances {
    /// Of each angle of the posture, or of the initial state, rad.
    pub posture_rad: f64,
    /// Of heels and lateral seat place, or of the position in the initial state, m.
    pub place_m: f64,
    /// Of the strength of the pulse, relative.
    pub path: f64,
    /// Of the stiffness of each material and each belt, relative.
    pub stiffness: f64,
    /// Of mass and inertia of each segment of the body, relative.
    pub segments: f64,
}

impl Default for Tolerances {
    /// Repeatability of a test: 1°, 5 mm, 1 %, 2 %; the body is unchanged.
    fn default() -> Self {
        Tolerances {
            posture_rad: std::f64::consts::PI / 180.0,
            place_m: 0.005,
            path: 0.01,
            stiffness: 0.02,
            segments: 0.0,
        }
    }
}

/// Repetitions of each sample with small changes.
#[derive(Clone, Debug, PartialEq)]
pub struct Ensemble {
    /// Runs per sample, including the unchanged one.
    pub members: u64,
    /// The perturbations.
    pub perturbations: Vec<Perturbation>,
}

/// A random change of one value, or of several together.
#[derive(Clone, Debug, PartialEq)]
pub struct Perturbation {
    /// Largest change.
    pub change: Change,
    /// Values that it changes.
    pub targets: Vec<Target>,
}

/// Size of a change.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// Uniform, at most so much to both sides: absolute, SI units.
    Offset(f64),
    /// Uniform, at most so much to both sides: relative.
    Factor(f64),
    /// Drawn from a law: a value, a factor or an offset.
    Drawn(Law, ApplyChoice),
}

impl Ensemble {
    /// Perturbs the assignments of a sample for one of its members.
    pub(super) fn perturb(&self, member: u64, seed: u64, list: &mut Vec<Assignment>) {
        if member == 0 {
            return;
        }
        for (i, perturbation) in self.perturbations.iter().enumerate() {
            // −1 … 1
            let part = unit(seed, Purpose::Ensemble, member, i as u32);
            let way = 2.0 * part - 1.0;
            for target in &perturbation.targets {
                // a sample that gives the peak of a pulse has taken its change of speed away
                let rival = rival_path(&target.path);
                if list.iter().any(|a| Some(&a.path) == rival.as_ref()) {
                    continue;
                }
                let value = match &perturbation.change {
                    Change::Offset(most) => changed(target, list, |old| old + way * most),
                    Change::Factor(most) => changed(target, list, |old| old * (1.0 + way * most)),
                    Change::Drawn(law, apply) => drawn(law.quantile(part), *apply, target, list),
                };
                place(target, value, list);
            }
        }
    }
}

/// The value of a target after a draw.
fn drawn(draw: Value, apply: ApplyChoice, target: &Target, list: &[Assignment]) -> Value {
    match (apply, draw) {
        (ApplyChoice::Value, value) => value,
        (ApplyChoice::Factor, Value::Number(x)) => changed(target, list, |old| old * x),
        (ApplyChoice::Offset, Value::Number(x)) => changed(target, list, |old| old + x),
        _ => Value::Base,
    }
}

/// Perturbations of parameters by their laws.
pub(super) fn of_parameters(parameters: Vec<Parameter>) -> impl Iterator<Item = Perturbation> {
    parameters.into_iter().map(|p| Perturbation { change: Change::Drawn(p.law, p.apply), targets: p.targets })
}

/// One perturbation per existing path, independent of each other.
fn each(base: &Draft, paths: &[String], change: Change) -> Vec<Perturbation> {
    let found = paths.iter().filter_map(|path| targets(base, path).ok());
    found.flatten().map(|target| Perturbation { change: change.clone(), targets: vec![target] }).collect()
}

/// The numbers at a path.
pub(super) fn targets(base: &Draft, path: &str) -> Result<Vec<Target>, Problem> {
    let places = base.places(path)?;
    Ok(places.iter().filter(|p| p.si.is_some()).map(Target::of).collect())
}

/// Perturbations of each angle of the posture, or of the initial state.
pub(super) fn posture(base: &Draft, most_rad: f64) -> Vec<Perturbation> {
    let angles = ["middle_torso", "upper_torso", "head", "lower_torso", "upper_arms", "elbows"];
    let written = people(base).into_iter().flat_map(|person| {
        let seated = angles.iter().map(move |angle| format!("posture.{angle}"));
        let all = seated.chain(["stance.yaw", "stance.posture.*"].map(str::to_owned));
        all.map(move |path| format!("{person}{path}")).collect::<Vec<_>>()
    });
    // q₄ … q₃₁ are angles
    let exact = (3..31).map(|i| format!("initial_state.q[{i}]"));
    let paths: Vec<String> = written.chain(exact).collect();
    each(base, &paths, Change::Offset(most_rad))
}

/// Path prefix of each occupant: empty, or `occupants.NAME.`.
pub(super) fn people(base: &Draft) -> Vec<String> {
    let named = base.clone().get("occupants.*").unwrap_or_default();
    let own = named.into_iter().map(|(path, _)| format!("{path}."));
    std::iter::once(String::new()).chain(own).collect()
}

/// Perturbations of the occupant's position.
pub(super) fn seat_place(base: &Draft, most_m: f64) -> Vec<Perturbation> {
    let own = ["posture.heels[0]", "posture.heels[1]", "stance.at[0]", "stance.at[1]"];
    let own = people(base).into_iter().flat_map(|person| own.map(|path| format!("{person}{path}")));
    let written: Vec<String> = own.chain(["seats.*.y".to_owned()]).collect();
    let exact: Vec<String> = (0..3).map(|i| format!("initial_state.q[{i}]")).collect();
    // q₁ … q₃ have no unit of their own but are in the file's length
    let length_m = base.units().length_m();
    [each(base, &written, Change::Offset(most_m)), each(base, &exact, Change::Offset(most_m / length_m))].concat()
}

/// Perturbation of the strength of each vehicle's motion: its pulse, given by the base scenario or by a parameter, or
/// its table or record.
pub(super) fn path(base: &Draft, parameters: &[Parameter], most: f64) -> Vec<Perturbation> {
    let paths = ["path.peak", "path.delta_v"];
    let said = paths.iter().filter_map(|path| targets(base, path).ok());
    let mut strengths: Vec<Target> = said.flatten().collect();
    let varied = parameters.iter().flat_map(|p| &p.targets);
    for target in varied.filter(|t| paths.contains(&t.path.as_str())) {
        if !strengths.contains(target) {
            strengths.push(target.clone());
        }
    }
    let change = Change::Factor(most);
    // a record that is scaled to a delta-v is changed by it
    let has_delta_v = |target: &Target| {
        let delta_v = target.path.replace("strength", "delta_v");
        strengths.iter().any(|t| t.path == delta_v) || targets(base, &delta_v).is_ok_and(|found| !found.is_empty())
    };
    let recorded: Vec<Target> = recorded(base).into_iter().filter(|target| !has_delta_v(target)).collect();
    let recorded = recorded.into_iter().map(|target| Perturbation { change: change.clone(), targets: vec![target] });
    let pulse = Some(Perturbation { change: change.clone(), targets: strengths });
    let pulse = pulse.filter(|pulse| !pulse.targets.is_empty());
    let others = each(base, &["vehicles.*.path.peak", "vehicles.*.path.delta_v"].map(str::to_owned), change.clone());
    pulse.into_iter().chain(recorded).chain(others).collect()
}

/// The strength of each path that is a table, a tabulated pulse or a record; 1 if the scenario does not give it.
fn recorded(base: &Draft) -> Vec<Target> {
    let word = |path: &str| match base.places(path).ok()?.into_iter().next()?.value? {
        Written::String(word) => Some(word),
        _ => None,
    };
    let kinds = ["path.kind", "vehicles.*.path.kind"].iter().filter_map(|path| base.places(path).ok()).flatten();
    let is_recorded = |place: &Place| match &place.value {
        Some(Written::String(kind)) if kind == "pulse" => {
            word(&place.path.replace("kind", "shape")).as_deref() == Some("tabulated")
        }
        Some(Written::String(kind)) => ["table", "sensors"].contains(&kind.as_str()),
        _ => false,
    };
    let strength = |place: Place| {
        let path = format!("{}strength", place.path.strip_suffix("kind")?);
        let place = base.places(&path).ok()?.into_iter().next()?;
        Some(Target { base: Value::Number(place.si.unwrap_or(1.0)), ..Target::of(&place) })
    };
    kinds.filter(is_recorded).filter_map(strength).collect()
}

/// Perturbation of each material and each belt, both slopes of one together.
pub(super) fn stiffness(base: &Draft, most: f64) -> Vec<Perturbation> {
    let firsts = ["materials.*.k1", "belts.*.k1", "occupants.*.belts.*.k1"]
        .iter()
        .filter_map(|path| targets(base, path).ok())
        .flatten();
    firsts
        .map(|first| {
            let second = first.path.strip_suffix('1').map(|p| format!("{p}2"));
            let second = second.and_then(|path| targets(base, &path).ok());
            Perturbation {
                change: Change::Factor(most),
                targets: [first].into_iter().chain(second.into_iter().flatten()).collect(),
            }
        })
        .collect()
}

/// Perturbation of mass and inertia of each segment of the body, left and right together.
pub(super) fn segments(base: &Draft, most: f64) -> Vec<Perturbation> {
    let of = |(_, targets)| Perturbation { change: Change::Factor(most), targets };
    super::segments::segments(base).into_iter().map(of).collect()
}

/// Requested perturbations, named as in the command line and `[ensemble]`, that do not apply to the scenario.
pub fn without_place(base: &Draft, most: &Tolerances) -> Vec<&'static str> {
    let asked = [
        ("posture", most.posture_rad, posture(base, most.posture_rad)),
        ("place", most.place_m, seat_place(base, most.place_m)),
        ("path", most.path, path(base, &[], most.path)),
        ("stiffness", most.stiffness, stiffness(base, most.stiffness)),
        ("segments", most.segments, segments(base, most.segments)),
    ];
    let is_lost = |(_, amount, found): &&(_, f64, Vec<Perturbation>)| *amount > 0.0 && found.is_empty();
    asked.iter().filter(is_lost).map(|(name, ..)| *name).collect()
}

/// All standard perturbations that apply to the scenario.
pub(super) fn standard(base: &Draft, parameters: &[Parameter], most: &Tolerances) -> Vec<Perturbation> {
    [
        posture(base, most.posture_rad),
        seat_place(base, most.place_m),
        path(base, parameters, most.path),
        stiffness(base, most.stiffness),
        if most.segments > 0.0 { segments(base, most.segments) } else { Vec::new() },
    ]
    .concat()
}
