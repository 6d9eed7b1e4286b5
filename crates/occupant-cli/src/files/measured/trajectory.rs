//! Trajectories of OpenSCENARIO XML and of esmini's tables: x forward, y left, z up, yaw, then pitch, then roll.

use std::path::Path;

use placed_text::{one_of, shown};
use roxmltree::{Document, Node};

use super::super::signals::{Recording, Signal, finite, scale_of};
use super::super::trouble::Trouble;
use crate::base::{Failure, ending, input_file, sha256};

/// Names of the columns as paths of scenarios have them, and their units.
const COLUMNS: [(&str, &str); 6] =
    [("x", "m"), ("y", "m"), ("z", "m"), ("yaw", "rad"), ("pitch", "rad"), ("roll", "rad")];

/// Time, then [`COLUMNS`].
type Row = [f64; 7];

/// Headings of esmini's table, in its order.
const ESMINI: [&str; 9] = ["time", "id", "name", "x", "y", "z", "h", "p", "r"];

/// Reads the trajectory of `object` (of the only one, if absent); none of a file that holds none.
///
/// # Errors
/// What cannot be read, and what is wrong in it.
pub(super) fn read(path: &Path, object: Option<&str>) -> Result<Option<Recording>, Failure> {
    let is_scenario = matches!(ending(path).as_str(), "xosc" | "xml");
    if !is_scenario && !matches!(ending(path).as_str(), "csv" | "txt") {
        return Ok(None);
    }
    let bytes = input_file::read(path)?;
    let Ok(text) = std::str::from_utf8(&bytes) else { return Ok(None) };
    let found = if is_scenario { Some(of_scenario(path, text, object)?) } else { of_table(path, text, object)? };
    let Some(rows) = found else { return Ok(None) };
    if let Some(i) = (1..rows.len()).find(|&i| rows[i][0] <= rows[i - 1][0]) {
        let found = format!("time {} s after {} s", rows[i][0], rows[i - 1][0]);
        return Err(Trouble::of(path, found, "times that increase").into());
    }
    if rows.len() < 2 {
        return Err(Trouble::of(path, format!("{} places", rows.len()), "a trajectory of two places or more").into());
    }
    let time_s: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    let signal = |(i, (name, unit)): (usize, &(&str, &str))| Signal {
        name: (*name).to_owned(),
        code: None,
        unit: Some((*unit).to_owned()),
        scale: scale_of(unit),
        time_s: time_s.clone(),
        values: rows.iter().map(|row| row[i + 1]).collect(),
        place: path.display().to_string(),
    };
    let signals = COLUMNS.iter().enumerate().map(signal).collect();
    Ok(Some(Recording { path: path.to_owned(), sha256: sha256(&bytes), signals, notes: Vec::new() }))
}

/// The object that is asked for, or the only one.
fn chosen(path: &Path, names: &[String], object: Option<&str>) -> Result<usize, Trouble> {
    let known: Vec<&str> = names.iter().map(String::as_str).collect();
    let (found, hint) = match (object, names) {
        (None, [_]) => return Ok(0),
        (Some(name), _) => match names.iter().position(|own| own == name) {
            Some(i) => return Ok(i),
            None => (format!("no object `{name}`"), "--object names one"),
        },
        (None, []) => ("no trajectory".to_owned(), "a FollowTrajectoryAction with a Polyline is read"),
        (None, _) => (format!("{} objects", names.len()), "--object names one"),
    };
    Err(Trouble::of(path, found, if known.is_empty() { "one".to_owned() } else { one_of(&known, '`') }).hint(hint))
}

fn of_table(path: &Path, text: &str, object: Option<&str>) -> Result<Option<Vec<Row>>, Trouble> {
    let cells = |line: &'_ str| -> Vec<String> { line.split(',').map(|cell| cell.trim().to_lowercase()).collect() };
    // a line about the log may stand first
    let lines = || (1..).zip(text.lines());
    let Some((head, _)) = lines().take(2).find(|(_, line)| cells(line).starts_with(&ESMINI.map(str::to_owned))) else {
        return Ok(None);
    };
    let mut names: Vec<String> = Vec::new();
    let mut rows: Vec<(usize, Row)> = Vec::new();
    for (number, line) in lines().skip(head).filter(|(_, line)| !line.trim().is_empty()) {
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        let at = |i: usize| cells.get(i).and_then(|cell| finite(cell));
        let row: Option<Vec<f64>> = [0, 3, 4, 5, 6, 7, 8].iter().map(|&i| at(i)).collect();
        let Some(row) = row.and_then(|row| Row::try_from(row).ok()) else {
            return Err(Trouble::at(
                path,
                number,
                "a line that is not of this table",
                "time, id, name, x, y, z, h, p, r",
            ));
        };
        let name = names.iter().position(|own| own == cells[2]).unwrap_or_else(|| {
            names.push(cells[2].to_owned());
            names.len() - 1
        });
        rows.push((name, row));
    }
    let own = chosen(path, &names, object)?;
    let mut rows: Vec<Row> = rows.into_iter().filter(|(name, _)| *name == own).map(|(_, row)| row).collect();
    // esmini logs the same time twice where a scenario restarts a step
    rows.dedup_by(|next, row| next[0] == row[0]);
    Ok(Some(rows))
}

fn of_scenario(path: &Path, text: &str, object: Option<&str>) -> Result<Vec<Row>, Trouble> {
    let document =
        Document::parse(text).map_err(|error| Trouble::of(path, format!("no XML: {error}"), "OpenSCENARIO"))?;
    let trajectories: Vec<Node> = document.descendants().filter(|n| n.has_tag_name("Trajectory")).collect();
    let names: Vec<String> = trajectories.iter().map(|node| name_of(*node)).collect();
    let own = trajectories[chosen(path, &names, object)?];
    let line = |node: Node| document.text_pos_at(node.range().start).row as usize;
    let vertices: Vec<Node> = own.descendants().filter(|n| n.has_tag_name("Vertex")).collect();
    if vertices.is_empty() {
        let shape = own.descendants().find(|n| ["Clothoid", "Nurbs"].contains(&n.tag_name().name()));
        let found = shape.map_or("a trajectory without vertices".to_owned(), |n| format!("a {}", n.tag_name().name()));
        return Err(Trouble::at(path, line(own), found, "a Polyline of vertices with times"));
    }
    let row = |vertex: &Node| {
        let place = vertex.descendants().find(|n| n.has_tag_name("WorldPosition"));
        let place = place.ok_or_else(|| Trouble::at(path, line(*vertex), "no WorldPosition", "places in the world"))?;
        let number = |node: Node, name: &str, needed: bool| match node.attribute(name) {
            None if !needed => Ok(0.0),
            None => Err(Trouble::at(path, line(node), format!("no `{name}`"), "a time, x and y of each vertex")),
            Some(text) => finite(text).ok_or_else(|| {
                Trouble::at(
                    path,
                    line(node),
                    format!("{name} = `{}`", shown(text)),
                    "a number; parameters are not read",
                )
            }),
        };
        let [t, x, y] = [(*vertex, "time"), (place, "x"), (place, "y")].map(|(node, name)| number(node, name, true));
        let [z, h, p, r] = ["z", "h", "p", "r"].map(|name| number(place, name, false));
        Ok([t?, x?, y?, z?, h?, p?, r?])
    };
    vertices.iter().map(row).collect()
}

/// The object that follows a trajectory, or the trajectory's own name.
fn name_of(trajectory: Node) -> String {
    let entity = |node: Node| match node.tag_name().name() {
        "Private" => node.attribute("entityRef").map(str::to_owned),
        "ManeuverGroup" => node.descendants().find_map(|n| Some(n.attribute("entityRef")?.to_owned())),
        _ => None,
    };
    let own = || trajectory.attribute("name").unwrap_or_default().to_owned();
    trajectory.ancestors().find_map(entity).unwrap_or_else(own)
}
