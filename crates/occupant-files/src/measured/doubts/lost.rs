//! Samples that were lost, and what a recorder put in their place: a number that means none, the last value, or zero.

use crash_measures::signal::STANDARD_GRAVITY_MPS2 as G;
use placed_text::number;

use super::super::motion::{Column, Motion, MotionKind};
use super::is_rate;

/// Largest readings of a vehicle's sensors: accelerations, m/s²; rates, rad/s; velocity changes, m/s.
const MOST: [f64; 3] = [2000.0 * G, 200.0, 100.0];
/// Number of consecutive equal samples that is reported.
const HELD: usize = 8;
/// Largest fraction of equal neighbours for a test of held values; with more the column is rounded or drawn.
const MOSTLY: f64 = 0.05;
/// Least jump at the end of held values, in usual steps.
const JUMP: f64 = 5.0;

/// Reports a value beyond the range of sensors.
pub(super) fn absurd(motion: &Motion, column: &Column) -> Option<String> {
    let most = match motion.kind {
        MotionKind::Places => return None,
        _ if is_rate(column) => MOST[1],
        MotionKind::Accelerations => MOST[0],
        MotionKind::Changes => MOST[2],
    };
    let beyond = |value: &&f64| value.abs() * column.factor > most;
    let count = column.values.iter().filter(beyond).count();
    let at = column.values.iter().position(|value| beyond(&value))?;
    Some(format!(
        "{} is {} {} at {} s and {count} time{} beyond {} {}, more than any vehicle sensor reads. If it marks missing values, leave those cells empty and use --bridge; if the unit is wrong, give it with --columns",
        column.name,
        number(column.values[at]),
        column.unit,
        number(motion.time_s[at]),
        if count == 1 { "" } else { "s" },
        number((most / column.factor).round()),
        column.unit
    ))
}

/// First and last index of the longest run of equal values.
fn longest(values: &[f64]) -> Option<(usize, usize)> {
    let mut best: Option<(usize, usize)> = None;
    let mut from = 0;
    for i in 1..=values.len() {
        if i < values.len() && values[i] == values[from] {
            continue;
        }
        // what a record begins or ends with was not lost
        let is_within = from > 0 && i < values.len();
        if is_within && i - from >= HELD && best.is_none_or(|(a, b)| b - a < i - 1 - from) {
            best = Some((from, i - 1));
        }
        from = i;
    }
    best
}

/// Whether a column holds one value from `a` to `b`, varies elsewhere, and jumps where it continues.
fn is_held(values: &[f64], (a, b): (usize, usize)) -> bool {
    let mut steps: Vec<f64> = values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    let equal = steps.iter().filter(|step| **step == 0.0).count() - (b - a);
    let jump = steps[a - 1].max(steps[b]);
    steps.retain(|step| *step > 0.0);
    steps.sort_unstable_by(f64::total_cmp);
    let usual = steps[steps.len() / 2];
    (equal as f64) < MOSTLY * values.len() as f64 && jump > JUMP * usual
}

/// Reports values held by a recorder, or zeros, where samples were lost.
pub(super) fn held(motion: &Motion) -> Option<String> {
    let all = motion.columns.iter().filter_map(|column| Some((column, longest(&column.values)?)));
    let all: Vec<_> = all.filter(|(column, run)| is_held(&column.values, *run)).collect();
    let &(_, (a, b)) = all.first()?;
    let holds = |column: &&Column| column.values[a..=b].iter().all(|value| *value == column.values[a]);
    let same: Vec<&Column> = motion.columns.iter().filter(holds).collect();
    let is_zero = same.iter().all(|column| column.values[a] == 0.0);
    let names: Vec<&str> = same.iter().map(|column| column.name).collect();
    Some(format!(
        "{} {} from {} s to {} s, {} samples, and continue{} with a jump. If samples were lost there, empty those cells and use --bridge",
        names.join(", "),
        match (is_zero, same.len()) {
            (true, 1) => "is 0",
            (true, _) => "are 0",
            (false, 1) => "is constant",
            (false, _) => "are constant",
        },
        number(motion.time_s[a]),
        number(motion.time_s[b]),
        b - a + 1,
        if same.len() == 1 { "es" } else { "" }
    ))
}
