//! Units that cannot be, or hardly can.

use crash_measures::signal::STANDARD_GRAVITY_MPS2 as G;
use placed_text::number;

use super::super::motion::{Column, Motion};
use super::zero::rest;
use super::{REST_S, integral, is_rate, mean};

/// Largest velocity change of a road vehicle in a crash, m/s.
const MOST_CHANGE_M_S: f64 = 45.0;
/// Largest number of turns of a rolling car.
const MOST_TURNS: f64 = 6.0;
/// Largest angular rate of a vehicle, mean over 10 ms, rad/s.
const FASTEST_RAD_S: f64 = 20.0;
/// Range of accelerations, between those of tyres and those of crashes, m/s², in which the unit m/s² is doubted.
const WEAK_M_S2: [f64; 2] = [G, 2.5 * G];
/// Rate, rad/s, below which it is doubted if the lateral velocity change exceeds this, m/s.
const SLOW: (f64, f64) = (0.1, 3.0);
/// Least rounding of accelerations that is reported, m/s².
const ROUGH_M_S2: f64 = 0.5 * G;

pub(super) fn wrong_unit(column: &Column, time_s: &[f64]) -> Option<String> {
    let whole = integral(&column.values, time_s) * column.factor;
    let (name, unit) = (column.name, &column.unit);
    if is_rate(column) {
        let turns = whole / std::f64::consts::TAU;
        let is_rad = unit.to_lowercase().contains("rad");
        let (other, mend) = if is_rad { ("deg/s", "[deg/s]") } else { ("another unit", "[…]") };
        let fastest = column.factor * strongest(column, time_s);
        let why = match () {
            () if turns.abs() > MOST_TURNS => format!("turns the vehicle {} times", number(turns.round())),
            () if fastest > FASTEST_RAD_S => {
                format!("turns the vehicle {} times a second", number((fastest / std::f64::consts::TAU).round()))
            }
            () => return None,
        };
        return Some(format!("{name} in {unit} {why}: if it is in {other}, use --columns, such as '{name}{mend}'"));
    }
    let start = rest(time_s, None).map(|[from, to]| mean(&column.values[from..to]))?;
    let stands_at = |value: f64| (start.abs() / value - 1.0).abs() < 0.03;
    let other = if (column.factor - G).abs() < 1e-9 { "m/s^2" } else { "g" };
    let gravity = name == "az" && column.factor * start.abs() > 0.5 && stands_at(if other == "g" { 1.0 } else { G });
    let too_much = whole.abs() > MOST_CHANGE_M_S;
    (gravity || too_much).then(|| {
        let why = match gravity {
            true => format!("begins at {} {unit}", number((start * 1e3).round() / 1e3)),
            false => format!("changes the velocity by {} km/h", number((whole * 3.6).round())),
        };
        format!("{name} in {unit} {why}: if it is in {other}, use --columns, such as '{name}[{other}]'")
    })
}

/// Largest magnitude of a 10 ms mean, in the column's unit.
fn strongest(column: &Column, time_s: &[f64]) -> f64 {
    let whole: Vec<f64> = std::iter::once(0.0)
        .chain(time_s.windows(2).zip(column.values.windows(2)).scan(0.0, |sum, (t, v)| {
            *sum += 0.5 * (t[1] - t[0]) * (v[0] + v[1]);
            Some(*sum)
        }))
        .collect();
    let mean = |i: usize| {
        let j = time_s.partition_point(|t| *t < time_s[i] + REST_S[0] - 1e-9);
        (j < time_s.len()).then(|| ((whole[j] - whole[i]) / (time_s[j] - time_s[i])).abs())
    };
    (0..time_s.len()).filter_map(mean).fold(0.0, f64::max)
}

/// Reports accelerations in m/s² as weak as those of tyres: they may be in g.
pub(super) fn weak(motion: &Motion) -> Option<String> {
    let all: Vec<&Column> = motion.columns.iter().filter(|c| !is_rate(c) && (c.factor - 1.0).abs() < 1e-9).collect();
    let most = all.iter().map(|column| strongest(column, &motion.time_s)).fold(0.0, f64::max);
    (WEAK_M_S2[0]..WEAK_M_S2[1]).contains(&most).then(|| {
        format!(
            "no acceleration exceeds {:.1} g (mean of 10 ms): if they are in g, use --columns, such as '{}[g]'",
            most / G,
            all[0].name
        )
    })
}

/// Reports rates in deg/s that hardly turn a vehicle with a large lateral velocity change: they may be in rad/s.
pub(super) fn slow(motion: &Motion) -> Option<String> {
    let all: Vec<&Column> = motion.columns.iter().filter(|c| is_rate(c) && (c.factor - 1.0).abs() > 1e-9).collect();
    let most = all.iter().map(|column| column.factor * strongest(column, &motion.time_s)).fold(0.0, f64::max);
    let aside = integral(&motion.si("ay")?, &motion.time_s).abs();
    (0.05 * SLOW.0 < most && most < SLOW.0 && aside > SLOW.1).then(|| {
        format!(
            "the velocity changes by {} km/h laterally, and no rate exceeds {:.1} deg/s (mean of 10 ms): if rates are in rad/s, use --columns, such as '{}[rad/s]'",
            number((aside * 3.6).round()),
            most.to_degrees(),
            all[0].name
        )
    })
}

/// Reports accelerations rounded to about 1 g.
pub(super) fn rough(motion: &Motion) -> Option<String> {
    let step = |c: &Column| {
        let is_round = |step: &f64| c.values.iter().all(|v| (v / step - (v / step).round()).abs() < 1e-6);
        let steps = [10.0, 5.0, 2.0, 1.0, 0.5].into_iter().filter(|step| step * c.factor >= ROUGH_M_S2);
        let (least, most) =
            c.values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(*v), b.max(*v)));
        // a few levels say nothing
        steps.filter(|step| !is_rate(c) && most - least > 3.0 * step).find(is_round)
    };
    let all: Vec<(&Column, f64)> = motion.columns.iter().filter_map(|c| Some((c, step(c)?))).collect();
    let (column, step) = all.first()?;
    let names: Vec<&str> = all.iter().map(|(column, _)| column.name).collect();
    let half = number(0.5 * step);
    Some(format!(
        "{} are rounded to {} {unit}: anything below {half} {unit} is lost; `occupant risk --sensor-error offset='{half} {unit}'` gives intervals for the measures",
        names.join(", "),
        number(*step),
        unit = column.unit
    ))
}
