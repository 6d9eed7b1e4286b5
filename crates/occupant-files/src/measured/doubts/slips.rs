//! Single values that a digit, a bit or a contact spoiled, and places that step.

use crash_measures::signal::{STANDARD_GRAVITY_MPS2 as G, usual_interval};
use placed_text::number;

use super::super::motion::{Column, Motion, MotionKind};
use super::is_rate;

/// Least outlier of accelerations that is reported, m/s².
const SLIP_M_S2: f64 = 5.0 * G;
/// Least acceleration caused by an outlier of positions that is reported, m/s².
const SPIKE_M_S2: f64 = 0.5 * G;
/// Least change of speed within a row that is reported, m/s.
const KINK_M_S: f64 = 1.0;
/// Least ratio of a flaw of positions to its surroundings, and their length in rows to each side.
const STANDS_OUT: f64 = 5.0;
const SURROUNDINGS: usize = 20;
/// Least fraction of the surrounding fourth differences that a flaw explains: an outlier explains 0.952 of a kink.
const EXPLAINED: f64 = 0.965;
/// Number of fourth differences examined around a flaw.
const SPAN: usize = 7;

/// Kinds of flaws in positions, seen in fourth differences.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Flaw {
    /// One value is wrong.
    Slip,
    /// All values from one on are shifted.
    Step,
    /// The velocity changes at a row.
    Kink,
}

/// Fourth differences of a flaw of size 1: an outlier, a step, a change of velocity. The flaw's row is the fifth after
/// the first of the span.
const PATTERNS: [(Flaw, [f64; SPAN]); 3] = [
    (Flaw::Slip, [0.0, 1.0, -4.0, 6.0, -4.0, 1.0, 0.0]),
    (Flaw::Step, [0.0, 1.0, -3.0, 3.0, -1.0, 0.0, 0.0]),
    (Flaw::Kink, [0.0, 0.0, 1.0, -2.0, 1.0, 0.0, 0.0]),
];

/// A flaw at a row, with its size in the column's unit.
struct Found {
    flaw: Flaw,
    row: usize,
    size: f64,
}

/// Reports a single value far from its neighbours.
pub(super) fn slip(motion: &Motion, column: &Column) -> Option<String> {
    if motion.kind == MotionKind::Places {
        return flaw_of_places(motion, column);
    }
    // a step is no slip: it leaves one neighbour near
    let apart = |v: &[f64]| match (v[1] - v[0]) * (v[1] - v[2]) > 0.0 {
        true => (v[1] - v[0]).abs().min((v[1] - v[2]).abs()),
        false => 0.0,
    };
    let all: Vec<f64> = column.values.windows(3).map(apart).collect();
    let at = (0..all.len()).max_by(|&a, &b| all[a].total_cmp(&all[b]))?;
    let mut sorted = all.clone();
    sorted.sort_unstable_by(|a, b| b.total_cmp(a));
    let least = match motion.kind {
        MotionKind::Accelerations if !is_rate(column) => SLIP_M_S2,
        _ => 1.0,
    };
    let stands_out = all[at] > 10.0 * sorted.get(1)? && all[at] * column.factor > least;
    stands_out.then(|| words_of_slip(motion, column, at + 1))
}

fn words_of_slip(motion: &Motion, column: &Column, row: usize) -> String {
    format!(
        "{} jumps in one row, at {} s to {} {}. If it is a mistake, empty that cell and use --bridge",
        column.name,
        number(motion.time_s[row]),
        number(column.values[row]),
        column.unit
    )
}

fn flaw_of_places(motion: &Motion, column: &Column) -> Option<String> {
    let Found { flaw, row, size } = worst(&column.values)?;
    let dt_s = usual_interval(&motion.time_s);
    let is_length = ["x", "y", "z"].contains(&column.name);
    // half a metre from the centre of gravity an angle moves so far
    let size_m = size.abs() * column.factor * if is_length { 1.0 } else { 0.5 };
    let (name, at) = (column.name, number(motion.time_s[row]));
    let round = |value: f64| number((value * 1e4).round() / 1e4);
    match flaw {
        Flaw::Slip | Flaw::Step if size_m < SPIKE_M_S2 * dt_s * dt_s => None,
        Flaw::Slip => Some(format!("{} (off by {} {})", words_of_slip(motion, column, row), round(size), column.unit)),
        Flaw::Step => Some(format!(
            "{name} steps by {} {} at {at} s, as if two records were joined. Accelerations there are those of the step; select a part with --from and --to",
            round(size),
            column.unit
        )),
        Flaw::Kink if is_length && size_m / dt_s > KINK_M_S => Some(format!(
            "the velocity along {name} changes by {:.1} m/s within the row at {at} s: an instantaneous impact, or rows too far apart. Accelerations there are those of the curve through the rows",
            size * column.factor / dt_s
        )),
        Flaw::Kink => None,
    }
}

/// The largest flaw relative to the fourth differences around it.
fn worst(values: &[f64]) -> Option<Found> {
    let fourth: Vec<f64> = values.windows(5).map(|v| v[0] + v[4] - 4.0 * (v[1] + v[3]) + 6.0 * v[2]).collect();
    let spans = (0..fourth.len().saturating_sub(SPAN - 1)).filter_map(|from| {
        let of = |(flaw, pattern): &(Flaw, [f64; SPAN])| (*flaw, fitted(&fourth[from..from + SPAN], pattern));
        let (flaw, (size, explained, left)) = PATTERNS.iter().map(of).min_by(|a, b| a.1.2.total_cmp(&b.1.2))?;
        let stands = (explained / 70.0).sqrt() * 6.0 / around(&fourth, from)?;
        let is_clear = explained > EXPLAINED * (explained + left) && stands > STANDS_OUT;
        is_clear.then_some((stands, Found { flaw, row: from + 5, size }))
    });
    spans.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, found)| found)
}

/// Size of a pattern fitted to a span, the sum of squares that it explains, and the rest.
fn fitted(span: &[f64], pattern: &[f64; SPAN]) -> (f64, f64, f64) {
    let dot: f64 = span.iter().zip(pattern).map(|(a, b)| a * b).sum();
    let square: f64 = pattern.iter().map(|b| b * b).sum();
    let whole: f64 = span.iter().map(|a| a * a).sum();
    let explained = dot * dot / square;
    (dot / square, explained, (whole - explained).max(0.0))
}

/// RMS beside a span; none if it is small.
fn around(fourth: &[f64], from: usize) -> Option<f64> {
    let before = &fourth[from.saturating_sub(SURROUNDINGS)..from];
    let after = &fourth[from + SPAN..(from + SPAN + SURROUNDINGS).min(fourth.len())];
    let count = before.len() + after.len();
    let square: f64 = before.iter().chain(after).map(|value| value * value).sum();
    (count >= SURROUNDINGS / 2).then(|| (square / count as f64).sqrt().max(f64::MIN_POSITIVE))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A car that brakes, in metres every 10 ms.
    fn way(flawed: impl Fn(usize, f64) -> f64) -> Vec<f64> {
        (0..111)
            .map(|i| {
                let t = 0.01 * i as f64;
                flawed(i, 27.8 * t - 0.4 * (9.0 * t).sin())
            })
            .collect()
    }

    #[test]
    fn slips_steps_and_kinks_are_told_apart_and_found_in_their_rows() {
        assert!(worst(&way(|_, x| x)).is_none());
        let found = |flawed: &dyn Fn(usize, f64) -> f64| {
            let found = worst(&way(flawed)).expect("a flaw");
            (found.flaw, found.row, (found.size * 1e4).round() / 1e4)
        };
        assert_eq!(found(&|i, x| x + if i == 30 { 0.0018 } else { 0.0 }), (Flaw::Slip, 30, 0.0018));
        assert_eq!(found(&|i, x| x + if i >= 30 { 0.01 } else { 0.0 }), (Flaw::Step, 30, 0.01));
        assert_eq!(found(&|i, x| x - 0.02 * i.saturating_sub(30) as f64), (Flaw::Kink, 30, -0.02));
        // rounded to 1 mm, where a slip of 5 mm still stands out
        let round = |x: f64| (x * 1e3).round() / 1e3;
        assert!(worst(&way(|_, x| round(x))).is_none());
        let (flaw, row, size) = found(&|i, x| round(x) + if i == 30 { 0.005 } else { 0.0 });
        assert!(flaw == Flaw::Slip && row == 30 && (size - 0.005).abs() < 0.0015, "{size}");
    }

    #[test]
    fn short_tables_have_no_flaws() {
        for count in 0..12 {
            assert!(worst(&way(|_, x| x)[..count]).is_none());
        }
    }
}
