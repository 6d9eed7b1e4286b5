//! Trajectories of OpenSCENARIO XML, and tables of programs whose headings tell which program wrote them. Yaw comes first, then pitch,
//! then roll.

use std::path::Path;

use placed_text::{name_and_unit, one_of, shown};
use roxmltree::{Document, Node};

use super::super::signals::{Recording, Signal, finite, scale_of};
use super::super::trouble::Trouble;
use crate::base::{Failure, ending, input_file, sha256};

/// Names of the columns as paths of scenarios have them; lengths, then angles.
const COLUMNS: [&str; 6] = ["x", "y", "z", "yaw", "pitch", "roll"];

/// Time, then [`COLUMNS`].
type Row = [f64; 7];

/// What a program writes.
struct Layout {
    /// Its headings of [`Row`], in small letters.
    heads: [&'static str; 7],
    /// The heading of the object's name, where a table holds several.
    object: Option<&'static str>,
    /// Units of lengths and angles.
    units: [&'static str; 2],
    /// Whether axes are forward, left, up.
    z_up: bool,
    /// What to know of it.
    note: Option<&'static str>,
}

/// Of OpenSCENARIO, and of esmini.
const OPEN: Layout = Layout {
    heads: ["time", "x", "y", "z", "h", "p", "r"],
    object: Some("name"),
    units: ["m", "rad"],
    z_up: true,
    note: Some("a trajectory follows the middle of the rear axle; --cg says how far ahead the centre of gravity is"),
};

const LAYOUTS: [Layout; 3] = [
    OPEN,
    Layout {
        heads: ["time", "car.tx", "car.ty", "car.tz", "car.yaw", "car.pitch", "car.roll"],
        object: None,
        note: Some(
            "CarMaker tells where the origin of the car's own axes is; --cg says how far ahead of it the centre of gravity is",
        ),
        ..OPEN
    },
    Layout {
        heads: ["time", "xpos", "ypos", "zpos", "yaw", "pitch", "roll"],
        object: None,
        units: ["ft", "deg"],
        z_up: false,
        note: Some(
            "Rec-Tec's table does not tell its units and axes: taken as feet and degrees, y to the right and z down. In a metric \
             project [ft] in the headings of the path is to be [m]; where a turn to the right has y or yaw below 0, \
             axes = \"z_up\" belongs into [path]",
        ),
    },
];

/// Reads the trajectory of `object` (of the only one, if absent), and whether its axes are forward, left, up; none of a file that
/// holds none.
///
/// # Errors
/// What cannot be read, and what is wrong in it.
pub(super) fn read(path: &Path, object: Option<&str>) -> Result<Option<(Recording, bool)>, Failure> {
    let is_scenario = matches!(ending(path).as_str(), "xosc" | "xml");
    if !is_scenario && !matches!(ending(path).as_str(), "csv" | "txt" | "tsv" | "asc" | "dat") {
        return Ok(None);
    }
    let bytes = input_file::read(path)?;
    let Ok(text) = std::str::from_utf8(&bytes) else { return Ok(None) };
    let found =
        if is_scenario { Some((of_scenario(path, text, object)?, &OPEN)) } else { of_table(path, text, object)? };
    let Some((rows, layout)) = found else { return Ok(None) };
    if let Some(i) = (1..rows.len()).find(|&i| rows[i][0] <= rows[i - 1][0]) {
        let found = format!("time {} s after {} s", rows[i][0], rows[i - 1][0]);
        return Err(Trouble::of(path, found, "times that increase").into());
    }
    if rows.len() < 2 {
        return Err(Trouble::of(path, format!("{} places", rows.len()), "a trajectory of two places or more").into());
    }
    let time_s: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    let unit = |i: usize| layout.units[i / 3];
    let signal = |(i, name): (usize, &&str)| Signal {
        name: (*name).to_owned(),
        code: None,
        unit: Some(unit(i).to_owned()),
        scale: scale_of(unit(i)),
        time_s: time_s.clone(),
        values: rows.iter().map(|row| row[i + 1]).collect(),
        place: path.display().to_string(),
    };
    let signals = COLUMNS.iter().enumerate().map(signal).collect();
    let notes = layout.note.map(str::to_owned).into_iter().collect();
    Ok(Some((Recording { path: path.to_owned(), sha256: sha256(&bytes), signals, notes }, layout.z_up)))
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

/// The cells of a line: commas or semicolons stand between them, or blanks.
fn cells(line: &str) -> Vec<&str> {
    let is_between = |c: char| matches!(c, ',' | ';');
    if line.contains(is_between) {
        line.split(is_between).map(str::trim).collect()
    } else {
        line.split_whitespace().collect()
    }
}

/// A heading without its unit and without the number of its vehicle.
fn bare(heading: &str) -> String {
    name_and_unit(heading).0.trim_end_matches(|c: char| c.is_ascii_digit()).to_lowercase()
}

/// The program that these headings tell of, and the columns of [`Row`] and of the object's name.
fn layout_of(headings: &[&str]) -> Option<(&'static Layout, Vec<usize>)> {
    let heads: Vec<String> = headings.iter().map(|heading| bare(heading)).collect();
    let at = |name: &&str| heads.iter().position(|head| head == name);
    LAYOUTS.iter().find_map(|l| Some((l, l.heads.iter().chain(&l.object).map(at).collect::<Option<_>>()?)))
}

type Found = (Vec<Row>, &'static Layout);

fn of_table(path: &Path, text: &str, object: Option<&str>) -> Result<Option<Found>, Trouble> {
    // a line about the log may stand first
    let lines = || (1..).zip(text.trim_start_matches('\u{feff}').lines());
    let told = lines().take(2).find_map(|(number, line)| Some((number, layout_of(&cells(line))?)));
    let Some((head, (layout, columns))) = told else { return Ok(None) };
    let mut names: Vec<String> = Vec::new();
    let mut rows: Vec<(usize, Row)> = Vec::new();
    for (number, line) in lines().skip(head).filter(|(_, line)| !line.trim().is_empty()) {
        let cells = cells(line);
        let row: Option<Vec<f64>> = columns[..7].iter().map(|&i| cells.get(i).and_then(|cell| finite(cell))).collect();
        let Some(row) = row.and_then(|row| Row::try_from(row).ok()) else {
            let expected = format!("numbers for {}", layout.heads.join(", "));
            return Err(Trouble::at(path, number, "a line that is not of this table", expected));
        };
        let own = columns.get(7).and_then(|&i| cells.get(i)).copied().unwrap_or_default();
        let name = names.iter().position(|name| name == own).unwrap_or_else(|| {
            names.push(own.to_owned());
            names.len() - 1
        });
        rows.push((name, row));
    }
    let own = chosen(path, &names, object)?;
    let mut rows: Vec<Row> = rows.into_iter().filter(|(name, _)| *name == own).map(|(_, row)| row).collect();
    // esmini logs the same time twice where a scenario restarts a step
    rows.dedup_by(|next, row| next[0] == row[0]);
    Ok(Some((rows, layout)))
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
