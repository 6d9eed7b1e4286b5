//! The vehicle's path → series 12.

use occupant_core::vehicle::{AfterEnd, Interpolation, Station, TablePath, VehiclePath};

use super::Back;

pub(super) fn read(back: &mut Back<'_>) {
    let setup = back.setup;
    if let Some(stations) = back.kept.get("MREAD").filter(|d| d.parse::<f64>().is_ok_and(|v| v > 0.0)).cloned() {
        back.deck.set("MREAD", &stations);
        back.remarks.push(format!(
            "MREAD = {stations} as in the deck that the scenario came from: the path stays outside the cards"
        ));
        return;
    }
    back.deck.set("MREAD", "0");
    match &setup.path {
        VehiclePath::Table(table) => read_table(back, table),
        VehiclePath::Fixed(path) => {
            let pose = path.pose();
            let ends = [setup.time.start_s, setup.time.end_s].map(|time_s| Station { time_s, pose });
            stations(back, &ends);
        }
        VehiclePath::Pulse(_) => {
            back.misfit("path.kind: cards take a table of stations, not a pulse");
        }
        _ => back.misfit("path.kind: cards take a table of stations, not what sensors recorded"),
    }
}

fn read_table(back: &mut Back<'_>, table: &TablePath) {
    back.misfit_if(
        table.interpolation() != Interpolation::Linear,
        "path.interpolation = \"spline\": cards have straight lines between stations (\"linear\")",
    );
    let runs_past = table.span_s().1 < back.setup.time.end_s;
    back.misfit_if(
        runs_past && table.after() != AfterEnd::Error,
        "path.after: a deck must have stations up to its final time",
    );
    stations(back, table.stations());
}

fn stations(back: &mut Back<'_>, stations: &[Station]) {
    back.deck.add_series(12, u32::try_from(stations.len()).unwrap_or(u32::MAX));
    back.deck.set("NVPOS", &stations.len().to_string());
    for (n, station) in (1..).zip(stations) {
        let (place, attitude) = (station.pose.position_m, station.pose.attitude);
        back.set_numbered(n, [("CALT", station.time_s), ("CALX", place.x), ("CALY", place.y), ("CALZ", place.z)]);
        let angles = [("CALPH", attitude.roll_rad), ("CALTH", attitude.pitch_rad), ("CALPS", attitude.yaw_rad)];
        back.set_numbered(n, angles);
    }
}
