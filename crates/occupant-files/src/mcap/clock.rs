//! Simulation time as the file's time: nanoseconds from the start of the run.

/// `log_time` and `publish_time` of an event at `time_s` in a run from `start_s`, not before the start.
pub fn nanoseconds(time_s: f64, start_s: f64) -> u64 {
    // a float that is negative or not a number becomes 0 here
    ((time_s - start_s) * 1e9).round() as u64
}

/// Number of outputs per recorded frame of the scene, for at most `most_per_s` frames a second.
pub fn stride(output_s: f64, most_per_s: u32) -> usize {
    // an output rate that misses the limit by rounding alone still counts as the limit
    (1.0 / (output_s * f64::from(most_per_s)) - 1e-9).ceil().max(1.0) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_counts_from_the_start() {
        assert_eq!(nanoseconds(-0.05, -0.05), 0);
        assert_eq!(nanoseconds(0.001, -0.05), 51_000_000);
        assert_eq!(nanoseconds(f64::NAN, 0.0), 0);
    }

    #[test]
    fn frames_are_at_most_as_many_as_asked() {
        assert_eq!(stride(0.001, 500), 2);
        assert_eq!(stride(0.002, 500), 1);
        assert_eq!(stride(0.0001, 500), 20);
        assert_eq!(stride(0.0003, 500), 7);
        assert_eq!(stride(0.1, 500), 1);
    }
}
