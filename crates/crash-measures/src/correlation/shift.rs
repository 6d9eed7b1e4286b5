//! The shift in time at which two signals agree best.

/// Overlap of two equally long signals after a shift.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shifted<'a> {
    /// Part of the reference that overlaps.
    pub reference: &'a [f64],
    /// Part of the computed signal that overlaps.
    pub computed: &'a [f64],
    /// Samples by which the computed signal is late; negative where it is early.
    pub lag: isize,
    /// Agreement at this shift.
    pub agreement: f64,
}

/// Least gain of a lag over the best one before it; smaller differences are rounding.
const TIE: f64 = 1e-12;

/// Tries lags of 0, then ±1, ±2 … up to `most` and keeps the best agreement; among equals (to 1e−12) the
/// smallest lag, and late before early.
pub(super) fn best_shift<'a>(
    reference: &'a [f64],
    computed: &'a [f64],
    most: usize,
    agreement: impl Fn(&[f64], &[f64]) -> f64,
) -> Shifted<'a> {
    let n = reference.len();
    let mut best = Shifted { reference, computed, lag: 0, agreement: agreement(reference, computed) };
    let mut consider = |reference: &'a [f64], computed: &'a [f64], lag: isize| {
        let agreement = agreement(reference, computed);
        if agreement > best.agreement + TIE {
            best = Shifted { reference, computed, lag, agreement };
        }
    };
    for lag in 1..=most.min(n.saturating_sub(2)) {
        consider(&reference[..n - lag], &computed[lag..], lag as isize);
        consider(&reference[lag..], &computed[..n - lag], -(lag as isize));
    }
    best
}
