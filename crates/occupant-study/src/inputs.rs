//! Inputs of a reconstruction by one word each, with a ready distribution and its source.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::ensemble;
use crate::law::{Distribution, Law, Value};
use crate::parameter::{Parameter, Target};
use crate::section::ApplyChoice;
use crate::segments::segments;
use occupant_scenario::{Draft, Usual};
use std::f64::consts::PI;

/// An uncertain input of a reconstruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum InputWord {
    /// Size of the pulse, table or record of each vehicle: a factor, normal, 1 ± 0.05, cut to 0.85 … 1.15.
    Scale,
    /// `path.delta_v` of the base: normal, ± 5 % of it, cut to ± 15 %.
    DeltaV,
    /// Clock of the pulse, table or record of each vehicle: uniform, ± 5 ms; a pulse that starts before 5 ms: later by 0 … 10 ms.
    Shift,
    /// Direction of the change of velocity (PDOF), `path.turn` of each vehicle: normal, ± 2.5°, cut to ± 7.5°.
    Direction,
    /// `track` of each seat in `[car]`: its usual distribution.
    Seat,
    /// Torso of each occupant: `recline` of each seat in `[car]` in its usual distribution, else the posture's torso angles
    /// together: normal, ± 4°, cut to ± 10°.
    Posture,
    /// Belt on the shoulder and pelvis: `d_ring.behind`, `d_ring.above` and `lap_above` of each seat in `[car]` in their usual
    /// distributions, else `d_ring` of each belt: normal, ± 40 mm along X, ± 30 mm along Z.
    Belt,
    /// Slack of each belt: triangular, likeliest 0, to 60 mm.
    Slack,
    /// Friction of all materials together: a factor, log-uniform, 0.7 … 1.4.
    Friction,
    /// Mass of each occupant: a factor, normal, 1 ± 0.03, cut to 0.9 … 1.1; of the segments if the body has no `mass`.
    Mass,
}

impl InputWord {
    /// All words.
    pub const ALL: [InputWord; 10] = [
        InputWord::Scale,
        InputWord::DeltaV,
        InputWord::Shift,
        InputWord::Direction,
        InputWord::Seat,
        InputWord::Posture,
        InputWord::Belt,
        InputWord::Slack,
        InputWord::Friction,
        InputWord::Mass,
    ];

    /// The word in a study.
    pub fn word(self) -> &'static str {
        match self {
            InputWord::Scale => "scale",
            InputWord::DeltaV => "delta_v",
            InputWord::Shift => "shift",
            InputWord::Direction => "direction",
            InputWord::Seat => "seat",
            InputWord::Posture => "posture",
            InputWord::Belt => "belt",
            InputWord::Slack => "slack",
            InputWord::Friction => "friction",
            InputWord::Mass => "mass",
        }
    }

    /// Where its distribution comes from, or that it is a guess.
    pub fn source(self) -> &'static str {
        match self {
            InputWord::Scale | InputWord::DeltaV => {
                "guess: the ± 10 % that 49 CFR 563 allows a recorder's delta-v, taken as two standard deviations"
            }
            InputWord::Shift => "guess: half of the 10 ms between two values of a recorder (49 CFR 563)",
            InputWord::Direction => "guess: ± 5° as two standard deviations",
            InputWord::Seat => "guess, from the lengths of seat tracks in SAE J4004",
            InputWord::Posture => "guess, after Reed et al., Human Factors 42 (2000)",
            InputWord::Belt => {
                "guess for the D-ring (Reed, Ebert: SAE 2013-01-1157); lap belt: Reed, Ebert, Hallman, Stapp 57 (2013)"
            }
            InputWord::Slack => "belted drivers of US cars, model years 1974 to 1987 (Maryland)",
            InputWord::Friction => "guess",
            InputWord::Mass => "guess: a stated weight against a measured one, with clothes",
        }
    }

    /// What a scenario needs to have this input.
    fn needs(self) -> &'static str {
        match self {
            InputWord::Scale => "a path that moves: a pulse, a table or a record",
            InputWord::DeltaV => "`path.delta_v` in the base scenario",
            InputWord::Shift | InputWord::Direction => "a path that is a pulse, a table or a record",
            InputWord::Seat => "a [car] with seats; of other seats vary the places by `paths` and `apply = \"offset\"`",
            InputWord::Posture => "a [car] with seats, or a `posture`",
            InputWord::Belt => "a [car] with seats, or belts with `d_ring`",
            InputWord::Slack => "a [car] with seats, or belts with `slack`",
            InputWord::Friction => "`materials` with `friction`",
            InputWord::Mass => "a body with `mass` beside `sex` and `stature`; without a [car] any body",
        }
    }

    /// Its parameters in a scenario, one for each independent value.
    ///
    /// # Errors
    /// What the scenario would need.
    pub(crate) fn parameters(self, base: &Draft) -> Result<Vec<Parameter>, &'static str> {
        let found: Vec<Ready> = match self {
            InputWord::Scale => scale(base),
            InputWord::DeltaV => delta_v(base),
            InputWord::Shift => shift(base),
            InputWord::Direction => each(kinds(base), |path| turn(base, path)),
            InputWord::Seat => seats(base, &["track"]),
            InputWord::Posture => or_else(seats(base, &["recline"]), || torsos(base)),
            InputWord::Belt => or_else(seats(base, &["d_ring.behind", "d_ring.above", "lap_above"]), || rings(base)),
            InputWord::Slack => or_else(seats(base, &["slack"]), || slack(base)),
            InputWord::Friction => {
                together(base, &["materials.*.friction"], ApplyChoice::Factor, log_uniform(0.7, 1.4))
            }
            InputWord::Mass => mass(base),
        };
        if found.is_empty() {
            return Err(self.needs());
        }
        let is_one = found.len() == 1;
        let parameter = |ready: Ready| {
            let first = ready.targets[0].path.clone();
            Parameter {
                name: if is_one { self.word().to_owned() } else { format!("{}.{first}", self.word()) },
                unit: if ready.apply == ApplyChoice::Factor { "" } else { ready.targets[0].unit },
                apply: ready.apply,
                law: Law::Distribution(ready.law),
                crossed: false,
                targets: ready.targets,
                source: self.source(),
            }
        };
        Ok(found.into_iter().map(parameter).collect())
    }
}

/// One value of an input.
struct Ready {
    apply: ApplyChoice,
    law: Distribution<f64>,
    targets: Vec<Target>,
}

fn normal(mean: f64, sd: f64, most: f64) -> Distribution<f64> {
    Distribution::TruncatedNormal { mean, sd, from: mean - most, to: mean + most }
}

fn log_uniform(from: f64, to: f64) -> Distribution<f64> {
    Distribution::LogUniform { from, to }
}

fn or_else(found: Vec<Ready>, other: impl FnOnce() -> Vec<Ready>) -> Vec<Ready> {
    if found.is_empty() { other() } else { found }
}

fn each(paths: Vec<String>, of: impl Fn(&str) -> Option<Ready>) -> Vec<Ready> {
    paths.iter().filter_map(|path| of(path)).collect()
}

/// The numbers at patterns, changed as one.
fn together(base: &Draft, patterns: &[&str], apply: ApplyChoice, law: Distribution<f64>) -> Vec<Ready> {
    let targets: Vec<Target> =
        patterns.iter().filter_map(|path| ensemble::targets(base, path).ok()).flatten().collect();
    if targets.is_empty() { Vec::new() } else { vec![Ready { apply, law, targets }] }
}

/// Beginnings of the paths of vehicles that are pulses, tables or records: `path.`, `vehicles.NAME.path.`.
fn kinds(base: &Draft) -> Vec<String> {
    let found = ["path.kind", "vehicles.*.path.kind"].iter().filter_map(|path| base.places(path).ok()).flatten();
    let kinds = ["pulse", "table", "sensors"];
    let moves = found.filter(|place| {
        let kind = place.value.as_ref().and_then(|value| match value {
            placed_text::Value::String(kind) => Some(kind.as_str()),
            _ => None,
        });
        kind.is_some_and(|kind| kinds.contains(&kind))
    });
    moves.filter_map(|place| Some(place.path.strip_suffix("kind")?.to_owned())).collect()
}

/// The value at a path; `absent` if the scenario does not give it.
fn number_or(base: &Draft, path: &str, absent: f64) -> Option<Target> {
    let place = base.places(path).ok()?.into_iter().next()?;
    Some(Target { base: Value::Number(place.si.unwrap_or(absent)), ..Target::of(&place) })
}

fn scale(base: &Draft) -> Vec<Ready> {
    let all = ensemble::path(base, &[], 0.0).into_iter();
    all.map(|found| Ready { apply: ApplyChoice::Factor, law: normal(1.0, 0.05, 0.15), targets: found.targets })
        .collect()
}

fn delta_v(base: &Draft) -> Vec<Ready> {
    let found = ensemble::targets(base, "path.delta_v").unwrap_or_default();
    let value = |target: Target| {
        let Value::Number(own) = target.base else { return None };
        let law = normal(own, 0.05 * own.abs(), 0.15 * own.abs());
        (own != 0.0).then_some(Ready { apply: ApplyChoice::Value, law, targets: vec![target] })
    };
    found.into_iter().filter_map(value).collect()
}

fn shift(base: &Draft) -> Vec<Ready> {
    const HALF_S: f64 = 0.005;
    each(kinds(base), |path| {
        let record = number_or(base, &format!("{path}shift"), 0.0);
        let target = record.or_else(|| number_or(base, &format!("{path}start"), 0.0))?;
        let is_early = target.path.ends_with("start") && matches!(target.base, Value::Number(at_s) if at_s < HALF_S);
        let law = if is_early {
            Distribution::Uniform { from: 0.0, to: 2.0 * HALF_S }
        } else {
            Distribution::Uniform { from: -HALF_S, to: HALF_S }
        };
        Some(Ready { apply: ApplyChoice::Offset, law, targets: vec![target] })
    })
}

fn turn(base: &Draft, path: &str) -> Option<Ready> {
    const DEGREE: f64 = PI / 180.0;
    let target = number_or(base, &format!("{path}turn"), 0.0)?;
    Some(Ready { apply: ApplyChoice::Offset, law: normal(0.0, 2.5 * DEGREE, 7.5 * DEGREE), targets: vec![target] })
}

/// Keys of each seat of a car, in their usual distributions.
fn seats(base: &Draft, keys: &[&str]) -> Vec<Ready> {
    let named = base.clone().get("car.seats.*").unwrap_or_default();
    let all = named.iter().flat_map(|(seat, _)| keys.iter().map(move |key| format!("{seat}.{key}")));
    let ready = |path: String| {
        let law = of_usual(base.usual(&path)?);
        let target = base.places(&path).ok()?.first().map(Target::of)?;
        Some(Ready { apply: ApplyChoice::Value, law, targets: vec![target] })
    };
    all.filter_map(ready).collect()
}

/// A built-in distribution as a law.
pub(crate) fn of_usual(usual: Usual) -> Distribution<f64> {
    match usual {
        Usual::Normal { mean_sd: [mean, sd], ends: [from, to] } => Distribution::TruncatedNormal { mean, sd, from, to },
        Usual::Falling { mode, to } => Distribution::Triangular { from: mode, mode, to },
    }
}

fn torsos(base: &Draft) -> Vec<Ready> {
    let all = ensemble::people(base).into_iter().flat_map(|person| {
        let angles = ["lower_torso", "middle_torso", "upper_torso"].map(|angle| format!("{person}posture.{angle}"));
        together(base, &angles.each_ref().map(String::as_str), ApplyChoice::Offset, normal(0.0, 0.07, 0.175))
    });
    all.collect()
}

fn rings(base: &Draft) -> Vec<Ready> {
    let along = |axis: usize, sd_m: f64, most_m: f64| {
        let patterns = ["belts.*.d_ring", "occupants.*.belts.*.d_ring"].map(|path| format!("{path}[{axis}]"));
        let found = patterns.iter().filter_map(|path| ensemble::targets(base, path).ok()).flatten();
        let one =
            move |target| Ready { apply: ApplyChoice::Offset, law: normal(0.0, sd_m, most_m), targets: vec![target] };
        found.map(one).collect::<Vec<_>>()
    };
    [along(0, 0.04, 0.10), along(2, 0.03, 0.08)].into_iter().flatten().collect()
}

fn slack(base: &Draft) -> Vec<Ready> {
    let patterns = ["belts.*.slack", "occupants.*.belts.*.slack"];
    let found = patterns.iter().filter_map(|path| ensemble::targets(base, path).ok()).flatten();
    let law = Distribution::Triangular { from: 0.0, mode: 0.0, to: 0.06 };
    found.map(|target| Ready { apply: ApplyChoice::Value, law: law.clone(), targets: vec![target] }).collect()
}

fn mass(base: &Draft) -> Vec<Ready> {
    let law = || normal(1.0, 0.03, 0.10);
    let of = |person: &String| {
        let whole = ["mass", "weight"].map(|key| format!("{person}body.{key}"));
        together(base, &whole.each_ref().map(String::as_str), ApplyChoice::Factor, law())
    };
    let found: Vec<Ready> = ensemble::people(base).iter().flat_map(of).collect();
    or_else(found, || {
        // in a [car] the segments of a preset cannot be changed one by one
        let is_in_car = base.clone().get("car.seats").is_ok();
        let found = if is_in_car { Vec::new() } else { segments(base) };
        let targets: Vec<Target> = found.into_iter().flat_map(|(_, targets)| targets).collect();
        if targets.is_empty() { Vec::new() } else { vec![Ready { apply: ApplyChoice::Factor, law: law(), targets }] }
    })
}
