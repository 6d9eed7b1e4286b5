//! Records of a path scaled to a delta-v and moved in time.

use super::Time;
use super::number_table::NumberTable;
use super::quantity::si_or;
use occupant_core::vehicle::{PathCursor, VehiclePath};

/// What `delta_v` needs.
pub(super) const CHANGES: &str = "a table in which the velocity changes, or no `delta_v`";

/// The strength with which a path has this largest change of the horizontal velocity, m/s, by the secant method: a strength
/// acts in proportion unless the vehicle turns.
///
/// # Errors
/// A path without a change of velocity, or one that no strength scales to it.
pub(super) fn scale_to(
    asked_m_s: f64,
    table: &NumberTable,
    path: impl Fn(f64) -> Option<VehiclePath>,
) -> Result<f64, String> {
    let change = |strength: f64| path(strength).map(|path| delta_v_m_s(&path, table));
    let unscaled = || "a delta-v to which no strength scales the table".to_owned();
    let own = change(1.0).ok_or_else(unscaled)?;
    if own < 1e-6 {
        return Err("a `delta_v` beside a table in which the velocity does not change".to_owned());
    }
    let (mut before, mut strength) = ((0.0, 0.0), asked_m_s / own);
    for _ in 0..40 {
        let found = change(strength).ok_or_else(unscaled)?;
        let slope = (found - before.1) / (strength - before.0);
        if (found - asked_m_s).abs() <= 1e-10 * asked_m_s {
            return Ok(strength);
        }
        before = (strength, found);
        strength += (asked_m_s - found) / slope;
        if !(strength.is_finite() && strength > 0.0) {
            break;
        }
    }
    Err(unscaled())
}

/// Largest change of the horizontal velocity from the first time of a table on, at its times and between, m/s.
fn delta_v_m_s(path: &VehiclePath, table: &NumberTable) -> f64 {
    const BETWEEN: usize = 8;
    let mut cursor = PathCursor::default();
    let mut velocity = |t_s: f64| path.motion(t_s, t_s, &mut cursor).velocity_m_s;
    let first = velocity(table.rows.first().map_or(0.0, |row| row[0]));
    let mut most: f64 = 0.0;
    for pair in table.rows.windows(2) {
        for i in 1..=BETWEEN {
            let part = i as f64 / BETWEEN as f64;
            let change = velocity(pair[0][0] * (1.0 - part) + pair[1][0] * part) - first;
            most = most.max(change.xy().norm());
        }
    }
    most
}

/// Moves the clock of a table. A table that begins later gets a row at its old first time, made by `before` of that time
/// and the first two rows.
pub(super) fn shift(table: &mut NumberTable, shift: &Option<Time>, before: impl Fn(f64, &[f64], &[f64]) -> Vec<f64>) {
    let shift_s = si_or(shift, 0.0);
    let Some(old_s) = table.rows.first().map(|row| row[0]).filter(|_| shift_s != 0.0) else { return };
    table.rows.iter_mut().for_each(|row| row[0] += shift_s);
    if let (true, [first, second, ..]) = (shift_s > 0.0, &table.rows[..]) {
        let mut row = before(old_s, first, second);
        row[0] = old_s;
        table.rows.insert(0, row);
        if let Some(span) = table.row_spans.first().copied() {
            table.row_spans.insert(0, span);
        }
    }
}
