//! A drive as an MCAP file: what happens, drawn and in numbers.

use std::f64::consts::PI;
use std::io::Cursor;

use nalgebra::{Point3, Rotation3, UnitQuaternion, Vector3};
use occupant_files::mcap::Document;
use occupant_files::mcap::about::RESOLVED;
use occupant_files::mcap::drive::{DriveFile, Painted, Track};
use occupant_scenario::{Drawing, Drives, drawings, moving_rails};
use vehicle_motion::path::Motion;

use super::{Driven, json, table};
use crate::base::{Failure, program};

/// The file's bytes, with the scenario as a text; a row of each vehicle's numbers every `interval_s`.
///
/// # Errors
/// What the writer of the file reports.
pub fn film(
    drives: &Drives,
    all: &[Driven],
    title: &str,
    scenario: String,
    interval_s: f64,
) -> Result<Vec<u8>, Failure> {
    let document = |name: &str, media_type: &str, content| Document {
        name: name.to_owned(),
        media_type: media_type.to_owned(),
        content,
    };
    let report = serde_json::to_vec_pretty(&json(drives, all)).map_err(|e| Failure::plain(e.to_string()))?;
    let rails = moving_rails(drives);
    let moves = |own: &Drawing| rails.iter().any(|(i, _)| own.name == barrier(drives, *i));
    let still = drawings(drives).into_iter().filter(|own| !moves(own));
    let scenery = still.map(|Drawing { name, vehicle, polygons_m }| Painted { name, vehicle, polygons_m }).collect();
    let file = DriveFile {
        program: program(),
        title: title.to_owned(),
        documents: vec![
            document(RESOLVED, "application/toml", scenario.into_bytes()),
            document("report.json", "application/json", report),
        ],
        scenery,
        moving: moving(drives, &rails),
        vehicles: (0..drives.vehicles.len()).map(|i| track(drives, i, interval_s)).collect(),
        events: events(drives, all),
    };
    Ok(file.write(Cursor::new(Vec::new())).map_err(|e| Failure::plain(e.to_string()))?.into_inner())
}

/// From a time on, s, polygons, m.
type Moves = (f64, Vec<Vec<Point3<f64>>>);

fn barrier(drives: &Drives, number: usize) -> String {
    format!("barrier {}", drives.barriers[number].0)
}

/// All rails together at each time at which one of them moves.
fn moving(drives: &Drives, rails: &[(usize, Vec<Moves>)]) -> Vec<(f64, Vec<Painted>)> {
    let mut times_s: Vec<f64> = rails.iter().flat_map(|(_, moves)| moves.iter().map(|own| own.0)).collect();
    times_s.sort_by(f64::total_cmp);
    times_s.dedup();
    let at = |time_s: f64| {
        let painted = |(number, moves): &(usize, Vec<Moves>)| {
            let last = moves.partition_point(|own| own.0 <= time_s).checked_sub(1)?;
            Some(Painted { name: barrier(drives, *number), vehicle: None, polygons_m: moves[last].1.clone() })
        };
        (time_s, rails.iter().filter_map(painted).collect())
    };
    times_s.into_iter().map(at).collect()
}

fn track(drives: &Drives, number: usize, interval_s: f64) -> Track {
    let (columns, rows, motions) = table::rows(drives, number, interval_s);
    // from y right, z down to y left, z up
    let over = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), PI);
    let pose = |motion: &Motion| {
        let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(motion.rotation));
        let at = motion.position_m;
        (Vector3::new(at.x, -at.y, -at.z), over * turn)
    };
    Track { name: drives.vehicles[number].name.clone(), columns, rows, poses: motions.iter().map(pose).collect() }
}

/// Events of all vehicles in the order of their times.
fn events(drives: &Drives, all: &[Driven]) -> Vec<(f64, String)> {
    let of = |driven: &Driven| {
        let name = &drives.vehicles[driven.number].name;
        driven.events.iter().map(|event| (event.time_s, format!("{name}: {}", event.what))).collect::<Vec<_>>()
    };
    let mut events: Vec<(f64, String)> = all.iter().flat_map(of).collect();
    events.sort_by(|a, b| a.0.total_cmp(&b.0));
    events
}
