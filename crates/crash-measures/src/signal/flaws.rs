//! What may be wrong with a recorded signal, found in its numbers: holes, levels that it does not pass, and rounding that spoils
//! derivatives.

use super::smooth::weight;
use std::f64::consts::PI;

/// A gap in the samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hole {
    /// Index of the last sample before it.
    pub after: usize,
    /// Time of that sample, s.
    pub from_s: f64,
    /// Time of the next sample, s.
    pub to_s: f64,
}

impl Hole {
    /// Duration of the gap, s.
    #[must_use]
    pub fn length_s(&self) -> f64 {
        self.to_s - self.from_s
    }
}

/// Samples at the largest or least value of a signal, as of a sensor at the end of its range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plateau {
    /// The value.
    pub value: f64,
    /// Number of samples with this value.
    pub samples: usize,
    /// Index of the first of the longest run.
    pub first: usize,
    /// Number of samples in the longest run.
    pub longest: usize,
}

/// The usual interval between times; zero for fewer than two.
#[must_use]
pub fn usual_interval(time_s: &[f64]) -> f64 {
    let mut steps: Vec<f64> = time_s.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.sort_unstable_by(f64::total_cmp);
    steps.get(steps.len() / 2).copied().unwrap_or(0.0)
}

/// Whether most intervals are equal, as of a recorder and not of points read from a drawing.
#[must_use]
pub fn is_sampled(time_s: &[f64]) -> bool {
    let usual_s = usual_interval(time_s);
    let steps = time_s.windows(2).map(|pair| pair[1] - pair[0]);
    2 * steps.filter(|step| (step - usual_s).abs() <= 0.1 * usual_s).count() >= time_s.len()
}

/// Gaps in increasing times: where most intervals are equal, those 1.5 times as long; elsewhere, those ten times the
/// usual one.
#[must_use]
pub fn holes(time_s: &[f64]) -> Vec<Hole> {
    let most_s = usual_interval(time_s) * if is_sampled(time_s) { 1.5 } else { 10.0 };
    let steps = time_s.windows(2).map(|pair| pair[1] - pair[0]);
    let wide = steps.enumerate().filter(|(_, step)| *step > most_s);
    wide.map(|(after, _)| Hole { after, from_s: time_s[after], to_s: time_s[after + 1] }).collect()
}

/// Times with gaps filled at the usual interval, and values interpolated linearly; non-finite values are filled
/// likewise. Nothing is added beyond the ends.
#[must_use]
pub fn bridged(time_s: &[f64], channels: &[Vec<f64>]) -> (Vec<f64>, Vec<Vec<f64>>) {
    let usual_s = usual_interval(time_s);
    let mut filled = Vec::with_capacity(time_s.len());
    let mut holes = holes(time_s).into_iter().peekable();
    for (i, &t_s) in time_s.iter().enumerate() {
        filled.push(t_s);
        if let Some(hole) = holes.next_if(|hole| hole.after == i) {
            let parts = (hole.length_s() / usual_s).round().max(1.0);
            filled.extend((1..parts as usize).map(|k| t_s + hole.length_s() * (k as f64 / parts)));
        }
    }
    let values = channels.iter().map(|channel| at_times(time_s, channel, &filled)).collect();
    (filled, values)
}

/// Values at other times of the same span, interpolated linearly between finite ones.
fn at_times(time_s: &[f64], values: &[f64], wanted_s: &[f64]) -> Vec<f64> {
    let known: Vec<(f64, f64)> =
        time_s.iter().copied().zip(values.iter().copied()).filter(|(_, v)| v.is_finite()).collect();
    let mut next = 0;
    let value = |&t_s: &f64| {
        while known.get(next).is_some_and(|(known_s, _)| *known_s < t_s) {
            next += 1;
        }
        match (next.checked_sub(1).and_then(|i| known.get(i)), known.get(next)) {
            (_, Some((known_s, value))) if *known_s == t_s => *value,
            (Some((from_s, from)), Some((to_s, to))) => from + (to - from) * ((t_s - from_s) / (to_s - from_s)),
            _ => f64::NAN,
        }
    };
    wanted_s.iter().map(value).collect()
}

/// The level at which a signal appears clipped: its largest or least value, if three samples in a row have it and the
/// signal reaches and leaves it, within two samples, by more than twice its smallest step. None if the plateau is at
/// the start or the end.
#[must_use]
pub fn plateau(values: &[f64]) -> Option<Plateau> {
    let steps = values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).filter(|step| *step > 0.0);
    let smallest = steps.fold(f64::INFINITY, f64::min);
    let (least, most) = values.iter().fold((0.0_f64, 0.0_f64), |(a, b), v| (a.min(*v), b.max(*v)));
    let reach = most.max(-least);
    let is_far = |level: &f64| *level != 0.0 && level.abs() >= 0.5 * reach;
    let far = |i: Option<usize>, level: f64| {
        i.and_then(|i| values.get(i)).is_some_and(|v| (v - level).abs() > 2.0 * smallest)
    };
    // within two samples: noise may lead over the edge in two steps
    let steep = |near: Option<usize>, next: Option<usize>, level: f64| far(near, level) || far(next, level);
    let of = |level: f64| {
        let mut found = Plateau { value: level, samples: 0, first: 0, longest: 0 };
        let mut i = 0;
        while i < values.len() {
            let run = values[i..].iter().take_while(|v| **v == level).count();
            let is_cut = run >= 3
                && steep(i.checked_sub(1), i.checked_sub(2), level)
                && steep(Some(i + run), Some(i + run + 1), level);
            found.samples += run;
            if is_cut && run > found.longest {
                (found.first, found.longest) = (i, run);
            }
            i += run.max(1);
        }
        (found.longest > 0).then_some(found)
    };
    [most, least].into_iter().filter(is_far).find_map(of)
}

/// Decimal resolution of all values, such as 0.001; none if it is finer than a millionth, or where second differences
/// are smaller than rounding would make them, as on a straight line through round numbers.
#[must_use]
pub fn resolution(values: &[f64]) -> Option<f64> {
    let fits =
        |scale: &f64| values.iter().all(|v| ((v * scale).round() - v * scale).abs() <= 1e-6 + 1e-9 * (v * scale).abs());
    let step = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6].into_iter().find(fits).map(|scale| 1.0 / scale)?;
    let second = values.windows(3).map(|v| v[0] - 2.0 * v[1] + v[2]);
    let square = second.map(|d| d * d).sum::<f64>() / values.len().saturating_sub(2).max(1) as f64;
    // rounding alone makes it half of the step squared
    (square > 0.05 * step * step).then_some(step)
}

/// RMS noise that rounding to `resolution` causes in the second derivative of the natural spline through samples `dt_s`
/// apart, in units of the values per s²; after the low-pass of [`smooth`](super::smooth()) if `cutoff_hz` is given.
#[must_use]
pub fn rounding_noise(resolution: f64, dt_s: f64, cutoff_hz: Option<f64>) -> f64 {
    const PARTS: usize = 512;
    let weight = cutoff_hz.map_or(0.0, |cutoff_hz| weight(cutoff_hz, dt_s));
    let gain = |k: usize| {
        let lift = 2.0 - 2.0 * libm::cos((k as f64 + 0.5) * PI / PARTS as f64);
        // second derivative of the spline, and the low-pass
        6.0 * lift / (6.0 - lift) / (1.0 + weight * lift * lift)
    };
    let square = (0..PARTS).map(|k| gain(k) * gain(k)).sum::<f64>() / PARTS as f64;
    resolution * (square / 12.0).sqrt() / (dt_s * dt_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holes_are_found_and_bridged_by_straight_lines() {
        let whole: Vec<f64> = (0..200).map(|i| f64::from(i) * 1e-3).collect();
        assert!(holes(&whole).is_empty());
        let cut: Vec<f64> = whole.iter().copied().filter(|t| !(0.0505..0.0905).contains(t)).collect();
        let found = holes(&cut);
        assert_eq!(found.len(), 1);
        assert!((found[0].from_s - 0.05).abs() < 1e-12 && (found[0].length_s() - 0.041).abs() < 1e-12, "{found:?}");
        let mut line: Vec<f64> = cut.iter().map(|t| 3.0 * t).collect();
        line[20] = f64::NAN;
        let (times, values) = bridged(&cut, &[line]);
        assert_eq!(times.len(), whole.len());
        assert!(times.iter().zip(&whole).all(|(a, b)| (a - b).abs() < 1e-12));
        assert!(values[0].iter().zip(&whole).all(|(v, t)| (v - 3.0 * t).abs() < 1e-12));
        // a recorder's uneven times are no holes
        assert!(holes(&[0.0, 0.1, 0.25, 0.3, 0.5, 0.55]).is_empty());
        assert!(holes(&[0.0]).is_empty() && holes(&[]).is_empty());
    }

    #[test]
    fn a_signal_that_is_cut_off_has_a_plateau_and_a_rounded_one_has_none() {
        let pulse = |i: i32| -12.0 * (f64::from(i) * PI / 400.0).sin() + 0.01 * f64::from((i * 7919) % 13);
        let clipped: Vec<f64> = (0..400).map(|i| pulse(i).max(-8.0)).collect();
        let found = plateau(&clipped).unwrap();
        assert!(found.value == -8.0 && found.longest > 150 && found.samples >= found.longest, "{found:?}");
        assert_eq!(plateau(&(0..400).map(pulse).collect::<Vec<_>>()), None);
        let rounded: Vec<f64> =
            (0..400).map(|i| (10.0 * 12.0 * (f64::from(i) * PI / 400.0).sin()).round() / 10.0).collect();
        assert_eq!(plateau(&rounded), None);
        assert_eq!(plateau(&[-10.0; 50]), None);
        assert_eq!(plateau(&[]), None);
    }

    #[test]
    fn rounding_is_found_with_its_noise() {
        let place: Vec<f64> = (0..300).map(|i| (22.137 * f64::from(i) * 0.01 * 1e3).round() / 1e3).collect();
        assert_eq!(resolution(&place), Some(1e-3));
        let line: Vec<f64> = (0..300).map(|i| 20.0 * f64::from(i) * 0.01).collect();
        assert_eq!(resolution(&line), None);
        assert_eq!(resolution(&[1.0, 1.0]), None);
        assert_eq!(resolution(&[0.0, PI]), None);
        // spline through white noise: √(mean of (6·(2 − 2 cos θ)/(4 + 2 cos θ))²) = 6
        let noise = rounding_noise(1e-3, 0.01, None);
        assert!((noise - 6.0 * 1e-3 / 12f64.sqrt() / 1e-4).abs() < 1e-3, "{noise}");
        // 0.239 of 1.766 g
        let smoothed = rounding_noise(1e-3, 0.01, Some(15.0)) / noise;
        assert!((smoothed - 0.135_26).abs() < 1e-4, "{smoothed}");
    }
}
