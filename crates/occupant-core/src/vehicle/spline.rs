//! Cubic splines, and piecewise linear interpolation, through the stations of a table.
//!
//! One piece between two stations is a cubic in s = t − t_i with six channels at once: x, y, z, roll, pitch, yaw.

use nalgebra::Vector6;

/// The cubic between two stations: value + rate·s + half_second·s² + sixth_third·s³.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    /// Time of the station at which the piece starts, s.
    pub start_s: f64,
    value: Vector6<f64>,
    rate: Vector6<f64>,
    half_second: Vector6<f64>,
    sixth_third: Vector6<f64>,
}

impl Piece {
    /// The six channels at `t_s`.
    pub(crate) fn value(&self, t_s: f64) -> Vector6<f64> {
        let s = t_s - self.start_s;
        self.value + (self.rate + (self.half_second + self.sixth_third * s) * s) * s
    }

    /// Their first derivatives at `t_s`, per s.
    pub(crate) fn rate(&self, t_s: f64) -> Vector6<f64> {
        let s = t_s - self.start_s;
        self.rate + (self.half_second * 2.0 + self.sixth_third * (3.0 * s)) * s
    }

    /// Their second derivatives at `t_s`, per s².
    pub(crate) fn second_rate(&self, t_s: f64) -> Vector6<f64> {
        let s = t_s - self.start_s;
        self.half_second * 2.0 + self.sixth_third * (6.0 * s)
    }
}

/// Straight lines through the stations (the report's interpolation): one piece fewer than stations.
pub(super) fn linear_pieces(times_s: &[f64], values: &[Vector6<f64>]) -> Vec<Piece> {
    pieces(times_s, values, &vec![Vector6::zeros(); values.len()])
}

/// End condition of a spline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// A given second derivative; zero is a natural end.
    Given,
    /// Zero velocity: a vehicle or panel held there does not jump.
    AtRest,
}

/// The cubic spline through the stations: twice continuously differentiable, with the second derivatives `ends` at its first and,
/// unless it ends at rest, at its last station. Times increase.
pub(super) fn spline_pieces(times_s: &[f64], values: &[Vector6<f64>], ends: [Vector6<f64>; 2], end: End) -> Vec<Piece> {
    pieces(times_s, values, &second_derivatives(times_s, values, ends, end))
}

/// Pieces between stations with the given second derivatives at the stations.
fn pieces(times_s: &[f64], values: &[Vector6<f64>], seconds: &[Vector6<f64>]) -> Vec<Piece> {
    (0..values.len().saturating_sub(1))
        .map(|i| {
            let length_s = times_s[i + 1] - times_s[i];
            let slope = (values[i + 1] - values[i]) / length_s;
            Piece {
                start_s: times_s[i],
                value: values[i],
                // y′_i = (y_{i+1} − y_i)/h − h (2 M_i + M_{i+1})/6
                rate: slope - (seconds[i] * 2.0 + seconds[i + 1]) * (length_s / 6.0),
                half_second: seconds[i] * 0.5,
                sixth_third: (seconds[i + 1] - seconds[i]) / (6.0 * length_s),
            }
        })
        .collect()
}

/// Second derivatives M_i of the spline at its stations: M_0 as given, between
/// h_{i−1} M_{i−1} + 2 (h_{i−1} + h_i) M_i + h_i M_{i+1} = 6 (slope_i − slope_{i−1}), and at the end M_n as given or, of one at
/// rest, h_{n−1} M_{n−1} + 2 h_{n−1} M_n = 6 (0 − slope_{n−1}).
fn second_derivatives(
    times_s: &[f64],
    values: &[Vector6<f64>],
    [first, last]: [Vector6<f64>; 2],
    end: End,
) -> Vec<Vector6<f64>> {
    let count = values.len();
    let length = |i: usize| times_s[i + 1] - times_s[i];
    let slope = |i: usize| (values[i + 1] - values[i]) / length(i);
    let mut seconds = vec![Vector6::zeros(); count];
    if let [start, .., end] = &mut seconds[..] {
        (*start, *end) = (first, last);
    }
    let mut ratios = vec![0.0; count];
    // Forward sweep: M_i = seconds_i − ratio_i M_{i+1}
    for i in 1..count.saturating_sub(1) {
        let pivot = 2.0 * (length(i - 1) + length(i)) - length(i - 1) * ratios[i - 1];
        ratios[i] = length(i) / pivot;
        seconds[i] = ((slope(i) - slope(i - 1)) * 6.0 - seconds[i - 1] * length(i - 1)) / pivot;
    }
    if let (End::AtRest, Some(last)) = (end, count.checked_sub(1).filter(|last| *last > 0)) {
        let h = length(last - 1);
        seconds[last] = (slope(last - 1) * -6.0 - seconds[last - 1] * h) / (h * (2.0 - ratios[last - 1]));
    }
    for i in (1..count.saturating_sub(1)).rev() {
        let next = seconds[i + 1];
        seconds[i] -= next * ratios[i];
    }
    seconds
}

#[cfg(test)]
#[path = "tests/spline.rs"]
mod tests;
