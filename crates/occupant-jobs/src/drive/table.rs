//! The motion of a vehicle as a table.

use std::path::{Path, PathBuf};

use nalgebra::Vector3;
use occupant_core::vehicle::{Attitude, PathCursor};
use occupant_scenario::Drives;
use vehicle_motion::path::Motion;
use vehicle_motion::run::Station;

use super::{WHEELS, slip_rad};
use crate::base::{Existing, Failure};
use occupant_files::table::{Cell, Form, Kind, TableFile};

/// Data of a row.
pub struct Moment<'a> {
    motion: Motion,
    attitude: Attitude,
    /// The stations before and after.
    stations: [&'a Station; 2],
    share: f64,
    time_s: f64,
}

/// A column: its heading and its value.
pub struct Column {
    heading: String,
    value: Box<dyn Fn(&Moment<'_>) -> f64>,
}

fn column(heading: &str, value: impl Fn(&Moment<'_>) -> f64 + 'static) -> Column {
    Column { heading: heading.to_owned(), value: Box::new(value) }
}

impl Moment<'_> {
    /// A value interpolated linearly between the stations.
    fn between(&self, of: impl Fn(&Station) -> f64) -> f64 {
        let [from, to] = self.stations.map(of);
        from + (to - from) * self.share
    }

    /// A vehicle-space vector in vehicle axes.
    fn along(&self, of: Vector3<f64>) -> Vector3<f64> {
        self.motion.rotation.tr_mul(&of)
    }
}

/// Position and angles.
pub fn path_columns() -> Vec<Column> {
    vec![
        column("t[s]", |m| m.time_s),
        column("x[m]", |m| m.motion.position_m.x),
        column("y[m]", |m| m.motion.position_m.y),
        column("z[m]", |m| m.motion.position_m.z),
        column("roll[deg]", |m| m.attitude.roll_rad.to_degrees()),
        column("pitch[deg]", |m| m.attitude.pitch_rad.to_degrees()),
        column("yaw[deg]", |m| m.attitude.yaw_rad.to_degrees()),
    ]
}

/// All columns.
pub fn columns() -> Vec<Column> {
    let mut all = path_columns();
    all.push(column("speed[m/s]", |m| m.motion.velocity_m_s.norm()));
    all.push(column("slip_angle[deg]", |m| m.between(slip_rad).to_degrees()));
    for (i, name) in ["x", "y", "z"].into_iter().enumerate() {
        all.push(column(&format!("a{name}[m/s^2]"), move |m| m.along(m.motion.acceleration_m_s2)[i]));
    }
    for (i, name) in ["x", "y", "z"].into_iter().enumerate() {
        all.push(column(&format!("w{name}[deg/s]"), move |m| m.along(m.motion.turning_rad_s)[i].to_degrees()));
    }
    all.push(column("steer[deg]", |m| m.between(|station| station.steer_rad).to_degrees()));
    all.push(column("crush[m]", |m| m.between(|station| station.crush_m)));
    all.push(column("struck[N]", |m| m.between(|station| station.struck_n.norm())));
    for (i, [name, _]) in WHEELS.iter().enumerate() {
        let heading = |of: &str| format!("wheel.{name}.{of}");
        all.push(column(&heading("load[N]"), move |m| m.between(|s| s.wheels[i].load_n)));
        all.push(column(&heading("travel[m]"), move |m| m.between(|s| s.state.jounce_m()[i])));
        all.push(column(&heading("spin[rad/s]"), move |m| m.between(|s| s.state.spin_rad_s()[i])));
        all.push(column(&heading("brake[N*m]"), move |m| m.between(|s| s.wheels[i].brake_n_m)));
        all.push(column(&heading("slide_x[m/s]"), move |m| m.between(|s| s.wheels[i].slide_m_s[0])));
        all.push(column(&heading("slide_y[m/s]"), move |m| m.between(|s| s.wheels[i].slide_m_s[1])));
        all.push(column(&heading("force_x[N]"), move |m| m.between(|s| s.wheels[i].shear_n[0])));
        all.push(column(&heading("force_y[N]"), move |m| m.between(|s| s.wheels[i].shear_n[1])));
        all.push(column(&heading("saturation[-]"), move |m| m.between(|s| s.wheels[i].saturation)));
    }
    all
}

/// Writes a vehicle's motion; positions, accelerations and rates are those of the compartment's origin, without
/// gravity.
///
/// # Errors
/// An error of the writer.
pub fn write(
    path: &Path,
    form: Form,
    force: bool,
    drives: &Drives,
    vehicle: usize,
    columns: &[Column],
    interval_s: f64,
) -> Result<PathBuf, Failure> {
    let headings: Vec<(&str, Kind)> = columns.iter().map(|column| (column.heading.as_str(), Kind::Number)).collect();
    let about = [("vehicle", drives.vehicles[vehicle].name.clone())];
    let mut table = TableFile::create(path.to_owned(), form, Existing::by(force), &headings, &about)?;
    for moment in moments(drives, vehicle, interval_s) {
        table.row(columns.iter().map(|column| Cell::finite((column.value)(&moment))).collect())?;
    }
    table.publish()
}

/// Headings and rows of all columns, and the motion of the compartment in each row.
pub(super) fn rows(drives: &Drives, vehicle: usize, interval_s: f64) -> (Vec<String>, Vec<Vec<f64>>, Vec<Motion>) {
    let columns = columns();
    let row = |moment: &Moment<'_>| columns.iter().map(|column| (column.value)(moment)).collect();
    let (rows, motions) = moments(drives, vehicle, interval_s).map(|moment| (row(&moment), moment.motion)).unzip();
    (columns.iter().map(|column| column.heading.clone()).collect(), rows, motions)
}

/// The moments of a drive at equal times.
fn moments(drives: &Drives, vehicle: usize, interval_s: f64) -> impl Iterator<Item = Moment<'_>> {
    let (motion, stations) = (drives.motion(vehicle), drives.outcome.rides[vehicle].stations());
    let end_s = stations[stations.len() - 1].time_s;
    let mut cursor = PathCursor::default();
    (0..=(end_s / interval_s + 1e-6) as usize).map(move |i| {
        let time_s = (i as f64 * interval_s).min(end_s);
        let next = stations.partition_point(|station| station.time_s <= time_s).clamp(1, stations.len().max(2) - 1);
        let pair = [&stations[next - 1], &stations[next.min(stations.len() - 1)]];
        let span_s = pair[1].time_s - pair[0].time_s;
        Moment {
            motion: motion.at(time_s),
            attitude: drives.path(vehicle).attitude(time_s, &mut cursor).attitude,
            stations: pair,
            share: if span_s > 0.0 { ((time_s - pair[0].time_s) / span_s).clamp(0.0, 1.0) } else { 0.0 },
            time_s,
        }
    })
}
