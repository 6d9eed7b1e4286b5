//! The motion sheet: position, angles and speed of the vehicle and of each segment, every 1/20 s.

use std::fmt::Write as _;

use crate::base::Failure;
use crate::files::history::choose;
use occupant_files::results::Results;

/// Interval of the rows, s.
const INTERVAL_S: f64 = 0.05;
/// Columns of a row.
pub(super) const COLUMNS: [&str; 9] =
    ["part", "time_s", "x_m", "y_m", "z_m", "yaw_deg", "pitch_deg", "roll_deg", "speed_m_s"];

/// Channels of the vehicle, in the order of the columns.
const OF_VEHICLE: [&str; 7] = [
    "vehicle.position.x",
    "vehicle.position.y",
    "vehicle.position.z",
    "vehicle.yaw",
    "vehicle.pitch",
    "vehicle.roll",
    "vehicle.velocity.resultant",
];

/// Rows by part, then time.
pub(super) struct Sheet(pub Vec<(String, f64, [f64; 7])>);

impl Sheet {
    /// The table as CSV, numbers with all their digits.
    pub(super) fn csv(&self) -> String {
        let mut text = COLUMNS.join(",") + "\n";
        for (part, time_s, row) in &self.0 {
            _ = write!(text, "\"{}\",{time_s}", part.replace('"', "\"\""));
            row.iter().for_each(|value| _ = write!(text, ",{value}"));
            text.push('\n');
        }
        text
    }
}

/// Of each output nearest to a multiple of the interval.
pub(super) fn sheet(results: &Results) -> Result<Sheet, Failure> {
    let names = OF_VEHICLE.map(str::to_owned);
    let series = results.series(choose(&results.model, &names)?)?;
    let rows = rows(&series.time_s);
    let vehicle = rows.iter().map(|row| {
        let mut values = OF_VEHICLE.map(|name| series.of(name).map_or(f64::NAN, |values| values[*row]));
        values[3..6].iter_mut().for_each(|angle| *angle = angle.to_degrees());
        ("vehicle".to_owned(), series.time_s[*row], values)
    });
    let mut all: Vec<_> = vehicle.collect();
    let tree = &results.model.body().tree;
    for (segment, row) in tree.segments().zip(tree.segment_rows()) {
        let mut at = 0;
        results.watch(|sample| {
            if rows.contains(&at) {
                let (place, speed) = (sample.cg_m(segment), sample.cg_velocity_m_s(segment).norm());
                let (roll, pitch, yaw) = sample.orientation(segment).euler_angles();
                let [yaw, pitch, roll] = [yaw, pitch, roll].map(f64::to_degrees);
                all.push((row.name.to_string(), sample.time_s, [place.x, place.y, place.z, yaw, pitch, roll, speed]));
            }
            at += 1;
        })?;
    }
    Ok(Sheet(all))
}

/// Indices of the outputs nearest to the multiples of the interval since the start, the last output included.
fn rows(times_s: &[f64]) -> Vec<usize> {
    let (Some(start), Some(end)) = (times_s.first(), times_s.last()) else { return Vec::new() };
    let count = ((end - start) / INTERVAL_S + 1e-9).floor() as usize;
    let nearest = |wanted: f64| {
        let after = times_s.partition_point(|time| *time < wanted).min(times_s.len() - 1);
        let before = after.saturating_sub(1);
        if wanted - times_s[before] < times_s[after] - wanted { before } else { after }
    };
    let mut rows: Vec<usize> = (0..=count).map(|i| nearest(start + i as f64 * INTERVAL_S)).collect();
    rows.push(times_s.len() - 1);
    rows.dedup();
    rows
}

#[cfg(test)]
mod tests {
    use super::rows;

    #[test]
    fn the_outputs_nearest_to_twentieths_of_a_second_and_the_last_are_taken() {
        let times: Vec<f64> = (0..=40).map(|i| i as f64 * 0.003).collect();
        assert_eq!(rows(&times), [0, 17, 33, 40]);
        assert_eq!(rows(&[0.0]), [0]);
        assert!(rows(&[]).is_empty());
    }
}
