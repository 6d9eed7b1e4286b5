//! Zero errors and drift of sensors, by their rests.

use crash_measures::signal::STANDARD_GRAVITY_MPS2 as G;
use placed_text::number;

use super::super::motion::Motion;
use super::{Known, REST_S, is_rate, mean};

/// Least zero offsets that are reported: accelerations, m/s²; rates, rad/s.
const ZERO: [f64; 2] = [0.05 * G, 0.5 * std::f64::consts::PI / 180.0];

/// Samples before first contact, at most the last tenth of a second; if unknown, the first 10 ms.
pub(super) fn rest(time_s: &[f64], contact_s: Option<f64>) -> Option<[usize; 2]> {
    let first_s = *time_s.first()?;
    let until_s = contact_s.unwrap_or(first_s + REST_S[0]).min(first_s + REST_S[1]);
    let to = time_s.partition_point(|t| *t < until_s - 1e-9);
    (to >= 2).then_some([0, to])
}

/// Mean and standard deviation.
fn spread(part: &[f64]) -> (f64, f64) {
    let mean = mean(part);
    (mean, (part.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / part.len() as f64).sqrt())
}

pub(super) fn zero_errors(motion: &Motion, known: Known, said: &mut Vec<String>) {
    let time_s = &motion.time_s;
    let (first_s, last_s) = (time_s[0], time_s[time_s.len() - 1]);
    // time before first contact is a rest
    let contact_s = known.contact_s.or_else(|| (first_s < 0.0 && last_s > 0.0).then_some(0.0));
    let Some(contact_s) = contact_s.filter(|contact_s| contact_s - first_s >= REST_S[0]) else { return };
    let Some([from, to]) = rest(time_s, Some(contact_s)) else { return };
    let length_s = time_s[to - 1] - time_s[from];
    let tail = time_s.partition_point(|t| *t < last_s - REST_S[0].max(length_s));
    let (mut offsets, mut drifts, mut still) = (Vec::new(), Vec::new(), true);
    // a vehicle may go on braking along x and turning about z; any other mean at its end is not its motion
    let mut astray = Vec::new();
    for column in &motion.columns {
        let (begin, noise) = spread(&column.values[from..to]);
        let (end, end_noise) = spread(&column.values[tail..]);
        let [least, gravity] = if is_rate(column) { [ZERO[1], 0.0] } else { [ZERO[0], G] };
        let stands = |error: f64, lift: f64| column.name == "az" && (error * column.factor + lift).abs() < 0.2 * G;
        let lift = [gravity, -gravity].into_iter().find(|lift| gravity > 0.0 && stands(begin, *lift)).unwrap_or(0.0);
        let error = begin * column.factor + lift;
        let sure = 4.0 * noise * column.factor / ((to - from) as f64).sqrt();
        let words = |error: f64| {
            format!("{} {} {}", column.name, number((1e3 * error / column.factor).round() / 1e3), column.unit)
        };
        if error.abs() > least.max(sure) {
            offsets.push(words(error));
        }
        still &= end_noise <= 1.5 * noise + 0.2 * least / column.factor;
        if ((end - begin) * column.factor).abs() > least.max(2.0 * sure) {
            drifts.push(words((end - begin) * column.factor));
            astray.push(column.name);
        }
    }
    let ms = number((length_s * 1e3).round());
    if !offsets.is_empty() && !known.baseline[0] {
        said.push(format!(
            "at rest before first contact the record reads {}: remove it with --baseline '{ms} ms'",
            offsets.join(", ")
        ));
    }
    let has = |name: &str| astray.contains(&name);
    let drifted = ["az", "wx", "wy"].into_iter().any(has) || has("ay") != has("wz");
    if drifted && still && !known.baseline[1] {
        said.push(format!(
            "between its quiet start and end the record drifts by {}: if the vehicle is at rest in both, remove the drift with --baseline '{ms} ms' --baseline-end '{ms} ms'",
            drifts.join(", ")
        ));
    }
}
