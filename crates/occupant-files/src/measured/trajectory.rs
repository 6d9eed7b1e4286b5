//! Trajectories of OpenSCENARIO XML, and tables of programs whose headings tell which program wrote them. Yaw comes first, then pitch,
//! then roll.

use std::path::Path;

use placed_text::{Cell, Sources, TextTable, decoded, name_and_unit, one_of, shown};
use roxmltree::{Document, Node};

use super::super::signals::{Recording, Signal, finite, scale_of, seconds_in};
use super::super::trouble::Trouble;
use super::Axes;
use crate::base::{Failure, ending, input_file, sha256};

/// Names of the columns, as in paths of scenarios; lengths, then angles.
const COLUMNS: [&str; 6] = ["x", "y", "z", "yaw", "pitch", "roll"];

/// Time, then [`COLUMNS`].
type Row = [f64; 7];

/// Table layout of a program.
struct Layout {
    /// Headings of [`Row`], in lower case.
    heads: [&'static str; 7],
    /// Heading of the object's name, if a table has several objects.
    object: Option<&'static str>,
    /// Units of lengths and angles without a unit in their headings.
    units: [&'static str; 2],
    /// Direction of the axes.
    axes: Axes,
    /// Note for the user.
    note: Option<&'static str>,
    /// Note if headings have no units.
    without_units: Option<&'static str>,
}

/// OpenSCENARIO and esmini.
const OPEN: Layout = Layout {
    heads: ["time", "x", "y", "z", "h", "p", "r"],
    object: Some("name"),
    units: ["m", "rad"],
    axes: Axes::ZUp,
    note: Some(
        "a trajectory follows the middle of the rear axle; give the distance of the centre of gravity ahead of it with --cg",
    ),
    without_units: None,
};

const LAYOUTS: [Layout; 3] = [
    OPEN,
    Layout {
        heads: ["time", "car.tx", "car.ty", "car.tz", "car.yaw", "car.pitch", "car.roll"],
        object: None,
        note: Some(
            "CarMaker gives the position of the car's own origin; give the distance of the centre of gravity ahead of it with --cg",
        ),
        ..OPEN
    },
    Layout {
        heads: ["time", "xpos", "ypos", "zpos", "yaw", "pitch", "roll"],
        object: None,
        units: ["ft", "deg"],
        axes: Axes::ZDown,
        note: Some(
            "Rec-Tec's table does not give its axes: y right and z down are assumed. If y or yaw is negative in a right turn, use --axes z_up",
        ),
        without_units: Some(
            "no units: feet and degrees are assumed. In a metric project, change [ft] to [m] in the headings of the path",
        ),
    },
];

/// A trajectory as in its file, with the units of [`COLUMNS`].
struct Found {
    rows: Vec<Row>,
    layout: &'static Layout,
    units: [String; 6],
    notes: Vec<String>,
}

/// Reads the trajectory of `object` (of the only one, if absent) or of the vehicle of this number (of the first, if
/// absent), with its axes; none if the file has none.
///
/// # Errors
/// Unreadable parts, with their problems.
pub(super) fn read(
    path: &Path,
    vehicle: Option<u32>,
    object: Option<&str>,
) -> Result<Option<(Recording, Axes)>, Failure> {
    let is_scenario = matches!(ending(path).as_str(), "xosc" | "xml");
    if !is_scenario && !matches!(ending(path).as_str(), "csv" | "txt" | "tsv" | "asc" | "dat") {
        return Ok(None);
    }
    let bytes = input_file::read(path)?;
    let Ok((text, _)) = decoded(&bytes) else { return Ok(None) };
    let text = text.as_str();
    let found = if is_scenario {
        one_vehicle(path, vehicle)?;
        let rows = of_scenario(path, text, object)?;
        Some(Found { rows, layout: &OPEN, units: OPEN.units_of_columns(), notes: Vec::new() })
    } else {
        of_table(path, text, vehicle, object)?
    };
    let Some(Found { rows, layout, units, mut notes }) = found else { return Ok(None) };
    if let Some(i) = (1..rows.len()).find(|&i| rows[i][0] <= rows[i - 1][0]) {
        let found = format!("time {} s after {} s", rows[i][0], rows[i - 1][0]);
        return Err(Trouble::of(path, found, "times that increase").into());
    }
    if rows.len() < 2 {
        return Err(
            Trouble::of(path, format!("{} places", rows.len()), "a trajectory with at least two positions").into()
        );
    }
    let time_s: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    let signal = |(i, name): (usize, &&str)| Signal {
        name: (*name).to_owned(),
        code: None,
        unit: Some(units[i].clone()),
        scale: scale_of(&units[i]),
        time_s: time_s.clone(),
        values: rows.iter().map(|row| row[i + 1]).collect(),
        place: path.display().to_string(),
    };
    let signals = COLUMNS.iter().enumerate().map(signal).collect();
    notes.extend(layout.note.map(str::to_owned));
    Ok(Some((Recording { path: path.to_owned(), sha256: sha256(&bytes), signals, notes }, layout.axes)))
}

/// Refuses a vehicle number other than 1 if the file has no numbers.
pub(super) fn one_vehicle(path: &Path, vehicle: Option<u32>) -> Result<(), Trouble> {
    match vehicle {
        None | Some(1) => Ok(()),
        Some(number) => {
            Err(Trouble::of(path, format!("no vehicle {number}"), "1, because the file has no vehicle numbers")
                .hint("choose one of several objects with --object"))
        }
    }
}

impl Layout {
    fn units_of_columns(&self) -> [String; 6] {
        std::array::from_fn(|i| self.units[i / 3].to_owned())
    }

    /// Columns of [`Row`] and of the object's name for a vehicle; time and name may be common to all.
    fn columns(&self, heads: &[(String, Option<u32>)], vehicle: u32) -> Option<Vec<usize>> {
        let own = |name: &str| heads.iter().position(|(head, of)| head == name && of.unwrap_or(1) == vehicle);
        let common = |name: &str| heads.iter().position(|(head, _)| head == name);
        let [time, rest @ ..] = &self.heads;
        let time = own(time).or_else(|| common(time));
        let rest = rest.iter().map(|name| own(name));
        std::iter::once(time).chain(rest).chain(self.object.map(common)).collect()
    }

    /// Seconds per unit of time, and the units of [`COLUMNS`], from the table.
    fn units_in(&self, path: &Path, table: &TextTable, columns: &[usize], line: usize) -> Result<Units, Trouble> {
        let told = |i: usize| table.unit(columns[i]).map(|(unit, _)| unit);
        let heading = |i: usize| table.headings[columns[i]].text;
        let wrong = |i: usize, unit: &str, expected: &str| {
            Trouble::at(path, line, format!("`{unit}` as the unit of `{}`", heading(i)), expected)
        };
        let second = match told(0) {
            None => 1.0,
            Some(unit) => seconds_in(unit).ok_or_else(|| wrong(0, unit, "a unit of time, such as s or ms"))?,
        };
        let (mut units, mut without) = (self.units_of_columns(), Vec::new());
        for (i, own) in (1..).zip(&mut units) {
            match told(i) {
                None => without.push(heading(i)),
                Some(unit) if scale_of(unit).map(|s| s.dimension) == scale_of(own).map(|s| s.dimension) => {
                    *own = unit.to_owned();
                }
                Some(unit) => return Err(wrong(i, unit, &format!("a unit of the kind of {own}"))),
            }
        }
        let note = self.without_units.filter(|_| !without.is_empty());
        Ok((second, units, note.map(|note| format!("{} {note}", without.join(", ")))))
    }
}

/// Seconds per unit of time, the units of [`COLUMNS`], and a note on them.
type Units = (f64, [String; 6], Option<String>);

/// The requested object, or the only one.
fn chosen(path: &Path, names: &[String], object: Option<&str>) -> Result<usize, Trouble> {
    let known: Vec<&str> = names.iter().map(String::as_str).collect();
    let (found, hint) = match (object, names) {
        (None, [_]) => return Ok(0),
        (Some(name), _) => match names.iter().position(|own| own == name) {
            Some(i) => return Ok(i),
            None => (format!("no object `{name}`"), "--object names one"),
        },
        (None, []) => ("no trajectory".to_owned(), "only a FollowTrajectoryAction with a Polyline can be read"),
        (None, _) => (format!("{} objects", names.len()), "--object names one"),
    };
    Err(Trouble::of(path, found, if known.is_empty() { "one".to_owned() } else { one_of(&known, '`') }).hint(hint))
}

/// A heading without its unit, and its vehicle number.
fn bare(heading: &str) -> (String, Option<u32>) {
    let whole = name_and_unit(heading).0;
    let name = whole.trim_end_matches(|c: char| c.is_ascii_digit());
    (name.to_lowercase(), whole[name.len()..].parse().ok())
}

/// Vehicles of a table by number, each with the indices of its columns.
type Vehicles = Vec<(u32, Vec<usize>)>;

/// The layout that matches these headings, and the columns of each vehicle.
fn layout_of(headings: &[Cell]) -> Option<(&'static Layout, Vehicles)> {
    let heads: Vec<_> = headings.iter().map(|heading| bare(heading.text)).collect();
    let mut numbers: Vec<u32> = heads.iter().map(|(_, number)| number.unwrap_or(1)).collect();
    numbers.sort_unstable();
    numbers.dedup();
    let vehicles =
        |l: &Layout| -> Vec<_> { numbers.iter().filter_map(|&n| Some((n, l.columns(&heads, n)?))).collect() };
    LAYOUTS.iter().map(|l| (l, vehicles(l))).find(|(_, vehicles)| !vehicles.is_empty())
}

/// Columns of the requested vehicle, or of the first, with a note on others.
fn own_columns(path: &Path, vehicles: Vehicles, asked: Option<u32>) -> Result<(Vec<usize>, Option<String>), Trouble> {
    let numbers: Vec<String> = vehicles.iter().map(|(number, _)| number.to_string()).collect();
    let note = (asked.is_none() && numbers.len() > 1).then(|| {
        format!("the path is that of vehicle {}; choose another with --vehicle: {}", numbers[0], numbers.join(", "))
    });
    let own = vehicles.into_iter().find(|(number, _)| asked.is_none_or(|asked| asked == *number));
    let own = own.ok_or_else(|| {
        let known: Vec<&str> = numbers.iter().map(String::as_str).collect();
        let found = format!("no vehicle {}", asked.unwrap_or_default());
        Trouble::of(path, found, one_of(&known, '`')).hint("--vehicle names one")
    })?;
    Ok((own.1, note))
}

fn of_table(path: &Path, text: &str, vehicle: Option<u32>, object: Option<&str>) -> Result<Option<Found>, Trouble> {
    let mut sources = Sources::new();
    let id = sources.add_named(path.display().to_string(), text);
    let Some(table) = TextTable::of(&sources, id, |unit| scale_of(unit).is_some()) else { return Ok(None) };
    let Some((layout, vehicles)) = layout_of(&table.headings) else { return Ok(None) };
    let (columns, others) = own_columns(path, vehicles, vehicle)?;
    let (second, units, note) = layout.units_in(path, &table, &columns, sources.position(table.first).line)?;
    let mut rows = rows(path, &sources, &table, (layout, &columns), object)?;
    rows.iter_mut().for_each(|row| row[0] *= second);
    // esmini logs the same time twice where a scenario restarts a step
    rows.dedup_by(|next, row| next[0] == row[0]);
    let notes = others.into_iter().chain(note).collect();
    Ok(Some(Found { rows, layout, units, notes }))
}

/// Rows of the requested object, times in the table's unit.
fn rows(
    path: &Path,
    sources: &Sources,
    table: &TextTable,
    (layout, columns): (&Layout, &[usize]),
    object: Option<&str>,
) -> Result<Vec<Row>, Trouble> {
    let mut names: Vec<String> = Vec::new();
    let mut rows: Vec<(usize, Row)> = Vec::new();
    for line in &table.lines {
        let cells = table.separator.cells(sources, *line);
        let number = |i: &usize| cells.get(*i).and_then(|cell| table.separator.number(cell).ok());
        let row: Option<Vec<f64>> = columns[..7].iter().map(number).collect();
        let Some(row) = row.and_then(|row| Row::try_from(row).ok()) else {
            let expected = format!("numbers for {}", layout.heads.join(", "));
            return Err(Trouble::at(
                path,
                sources.position(*line).line,
                "a line that does not belong to this table",
                expected,
            ));
        };
        let own = columns.get(7).and_then(|&i| cells.get(i)).map_or("", |cell| cell.text);
        let name = names.iter().position(|name| name == own).unwrap_or_else(|| {
            names.push(own.to_owned());
            names.len() - 1
        });
        rows.push((name, row));
    }
    let own = chosen(path, &names, object)?;
    Ok(rows.into_iter().filter(|(name, _)| *name == own).map(|(_, row)| row).collect())
}

/// Largest number of attributes of an element; the parser compares each with all others.
const MOST_ATTRIBUTES: usize = 200;

/// Largest number of attributes of an XML element, in one pass.
fn most_attributes(text: &str) -> usize {
    let (mut most, mut rest) = (0, text);
    while let Some(at) = rest.find('<') {
        rest = &rest[at..];
        let ends = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>"), ("<!", ">")];
        if let Some((_, end)) = ends.iter().find(|(begin, _)| rest.starts_with(begin)) {
            rest = rest.find(end).map_or("", |at| &rest[at..]);
            continue;
        }
        let (mut count, mut quote, mut length) = (0, None, rest.len());
        for (at, letter) in rest.bytes().enumerate() {
            match (letter, quote) {
                (b'>', None) => {
                    length = at;
                    break;
                }
                (b'"' | b'\'', None) => quote = Some(letter),
                (letter, Some(open)) if letter == open => quote = None,
                (b'=', None) => count += 1,
                _ => {}
            }
        }
        most = most.max(count);
        rest = &rest[length..];
    }
    most
}

fn of_scenario(path: &Path, text: &str, object: Option<&str>) -> Result<Vec<Row>, Trouble> {
    let attributes = most_attributes(text);
    if attributes > MOST_ATTRIBUTES {
        let found = format!("an element of {attributes} attributes");
        return Err(Trouble::of(path, found, format!("OpenSCENARIO, whose elements have {MOST_ATTRIBUTES} at most")));
    }
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
        let place =
            place.ok_or_else(|| Trouble::at(path, line(*vertex), "no WorldPosition", "positions in the world"))?;
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

/// The object that follows a trajectory, or the trajectory's name.
fn name_of(trajectory: Node) -> String {
    let entity = |node: Node| match node.tag_name().name() {
        "Private" => node.attribute("entityRef").map(str::to_owned),
        "ManeuverGroup" => node.descendants().find_map(|n| Some(n.attribute("entityRef")?.to_owned())),
        _ => None,
    };
    let own = || trajectory.attribute("name").unwrap_or_default().to_owned();
    trajectory.ancestors().find_map(entity).unwrap_or_else(own)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attributes_are_counted_in_one_pass_whatever_stands_between() {
        assert_eq!(most_attributes("<a/><b c='=' d=\"x > y\" e = '1'>f = g = h</b>"), 3);
        assert_eq!(most_attributes("<?xml version='1.0'?><!-- don't = = = --><![CDATA[a=b=c=d]]><a b='1'/>"), 1);
        assert_eq!(most_attributes("<a b='1' c='2"), 2);
        assert_eq!(most_attributes("no tag = at > all"), 0);
        let many: String = (0..100_000).map(|i| format!(" a{i}='1'")).collect();
        let begun = std::time::Instant::now();
        assert_eq!(most_attributes(&format!("<a{many}/>")), 100_000);
        // measured: 4 ms without optimisation
        assert!(begun.elapsed().as_secs_f64() < 2.0);
    }
}
