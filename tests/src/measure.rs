//! Bounds whose measured values can be read: `cargo test -p occupant-tests -- --nocapture` prints them all.

/// Asserts that the size of `value` is below `bound`, and tells both.
#[expect(clippy::print_stdout, reason = "the measured values that stand beside the bounds are read from here")]
#[track_caller]
pub fn assert_below(what: &str, value: f64, bound: f64) {
    println!("measured {:9.2e}  bound {bound:7.1e}  {what}", value.abs());
    assert!(value.abs() < bound, "{what}: {value:e}, bound {bound:e}");
}

/// Asserts that `value` lies between two bounds, and tells all three.
#[expect(clippy::print_stdout, reason = "the measured values that stand beside the bounds are read from here")]
#[track_caller]
pub fn assert_within(what: &str, value: f64, [low, high]: [f64; 2]) {
    println!("measured {value:9.5}  between {low} and {high}  {what}");
    assert!(low < value && value < high, "{what}: {value}, expected {low} to {high}");
}
