//! Accelerations of a linearly interpolated table: second differences of its stations. Ours, only for output.
//!
//! Between stations the velocity of such a path is constant, and at them it jumps. The mean velocities of two neighbouring intervals
//! belong to their middles, so that at the station between them
//!
//! a_i = 2 (slope_i − slope_{i−1}) / (t_{i+1} − t_{i−1})
//!
//! with straight lines from station to station. It is of second order in the length of even intervals; rounding of the
//! stations appears divided by the square of that length. Before the second station it is that of the second. After the
//! last but one it stays constant if the table ends; if the vehicle then coasts or is at rest, that counts as one
//! more interval.

use nalgebra::Vector6;

use super::table::AfterEnd;

/// Second derivatives of six channels, per s², at times in increasing order.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Differences(Vec<(f64, Vector6<f64>)>);

impl Differences {
    /// Second derivatives of stations, of which there are at least two.
    pub(super) fn new(times_s: &[f64], values: &[Vector6<f64>], after: AfterEnd) -> Self {
        let last = times_s.len() - 1;
        let slope = |i: usize| (values[i + 1] - values[i]) / (times_s[i + 1] - times_s[i]);
        let within = |i: usize| (times_s[i], (slope(i) - slope(i - 1)) * (2.0 / (times_s[i + 1] - times_s[i - 1])));
        let mut all: Vec<_> = (1..last).map(within).collect();
        let length_s = times_s[last] - times_s[last - 1];
        match after {
            AfterEnd::Error => {}
            AfterEnd::Coast => all.push((times_s[last], Vector6::zeros())),
            AfterEnd::Hold => {
                all.push((times_s[last], slope(last - 1) * (-1.0 / length_s)));
                all.push((times_s[last] + length_s, Vector6::zeros()));
            }
        }
        Differences(all)
    }

    /// Second derivatives at `t_s`: linear between two times, constant beyond the first and the last. Zero for two
    /// stations, between which the velocity is constant.
    pub(super) fn at(&self, t_s: f64) -> Vector6<f64> {
        let after = self.0.partition_point(|(time_s, _)| *time_s <= t_s);
        match (after.checked_sub(1).map(|i| self.0[i]), self.0.get(after)) {
            (Some((from_s, from)), Some((to_s, to))) => from + (to - from) * ((t_s - from_s) / (to_s - from_s)),
            (Some((_, only)), None) | (None, Some(&(_, only))) => only,
            (None, None) => Vector6::zeros(),
        }
    }
}
