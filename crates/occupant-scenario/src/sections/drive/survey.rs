//! Ground along a line with bends, and ground from a grid of heights.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vehicle_motion::ground::{Ground, GroundError, Mesh, Road, Station};

use super::super::Length;
use super::super::builder::Builder;
use super::super::number_table::{Column, column, read_csv};
use super::super::quantity::{POSITIVE, all_si, si_or};
use super::ground::RoadSection;
use crate::kind;
use placed_text::with_key;

/// The line of a road in plan. It continues straight before the first point and behind the last.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LineSection {
    /// Points [x, y].
    pub(crate) points: Vec<[Length; 2]>,
    /// Radius of the bends at the inner points; required if there are any.
    pub(crate) radius: Option<Length<POSITIVE>>,
}

/// Corners of a cross-section at a place along the line, from left to right.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct StationSection {
    /// Distance along the line from its first point.
    pub(crate) at: Length,
    /// Distances to the right of the line, increasing.
    pub(crate) right: Vec<Length>,
    /// Height at each.
    pub(crate) height: Vec<Length>,
}

/// Heights on a regular grid, with triangles between them. Beyond its rim the ground is level outwards.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["file", "height"]]))]
pub(crate) struct GridSection {
    /// CSV file beside the scenario, one line for each point in any order; its first line names the columns and their
    /// units: `x[m],y[m],height[m]`.
    pub(crate) file: Option<String>,
    /// First point [x, y] of `height`.
    pub(crate) from: Option<[Length; 2]>,
    /// Distance of the points along x and along y.
    pub(crate) step: Option<[Length<POSITIVE>; 2]>,
    /// Heights: a list for each x, each from left to right.
    pub(crate) height: Option<Vec<Vec<Length>>>,
}

/// Columns of a table of heights.
const COLUMNS: [Column; 3] =
    [column("x", kind::LENGTH, true), column("y", kind::LENGTH, true), column("height", kind::LENGTH, true)];
/// Part of a step by which distances of points may differ.
const ROUGH: f64 = 0.01;

/// Corners of a cross-section, m; a mistake is reported.
pub(super) fn corners_m(b: &mut Builder, at: &str, right: &[Length], height: &[Length]) -> Option<Vec<[f64; 2]>> {
    if right.len() != height.len() {
        let found = format!("{} distances and {} heights", right.len(), height.len());
        b.error(at, found, "a height for each distance");
        return None;
    }
    let corners: Vec<[f64; 2]> = right.iter().zip(height).map(|(right, height)| [right.si(), height.si()]).collect();
    match Ground::section(corners.clone(), 0.0) {
        Ok(_) => Some(corners),
        Err(GroundError::Order { number, .. }) => {
            let last = format!("{at}.right[{}]", number - 1);
            let found = format!("corner {number} is not to the right of the previous one");
            b.error(&last, found, "distances that rise from left to right");
            None
        }
        Err(error) => {
            b.error(at, error.to_string(), "ground that a wheel can stand on");
            None
        }
    }
}

/// The ground along a line, or with cross-sections that change; `section_m` are the corners of its only one.
pub(super) fn road(b: &mut Builder, at: &str, s: &RoadSection, section_m: Vec<[f64; 2]>) -> Option<Ground> {
    let mut stations = Vec::new();
    for (i, own) in s.sections.iter().enumerate() {
        let corners_m = corners_m(b, &format!("{at}.sections[{i}]"), &own.right, &own.height)?;
        stations.push(Station { at_m: own.at.si(), corners_m });
    }
    if stations.is_empty() {
        stations.push(Station { at_m: 0.0, corners_m: section_m });
    }
    let line_m = match &s.line {
        Some(line) => line.points.iter().map(all_si).collect(),
        None => vec![[0.0, 0.0], [1.0, 0.0]],
    };
    let radius = s.line.as_ref().and_then(|line| line.radius.as_ref());
    if line_m.len() > 2 && radius.is_none() {
        b.error(&with_key(at, "line"), "a line with bends and no radius", "`radius`, such as \"80 m\"");
        return None;
    }
    let road =
        Road { line_m, radius_m: radius.map_or(1.0, |radius| radius.si()), stations, grade: si_or(&s.grade, 0.0) };
    match road.mesh() {
        Ok(mesh) => Some(Ground::mesh(mesh)),
        Err(error) => {
            let key = if s.line.is_some() { "line" } else { "sections" };
            b.error(&with_key(at, key), error.to_string(), "a road that can be laid out");
            None
        }
    }
}

/// The ground of a grid of heights.
pub(super) fn grid(b: &mut Builder, at: &str, s: &GridSection) -> Option<Ground> {
    let made = match &s.file {
        Some(file) => {
            let table = read_csv(&b.document.sources, b.document.sources.named(file)?, &COLUMNS, None);
            let rows = table.map_err(|problems| b.problems.extend(problems)).ok()?.rows;
            from_points(&rows.iter().map(|row| [row[0], row[1], row[2]]).collect::<Vec<_>>())
        }
        None => {
            let heights = s.height.as_deref().unwrap_or_default();
            let columns = heights.first().map_or(0, Vec::len);
            if let Some(i) = heights.iter().position(|row| row.len() != columns) {
                let found = format!("{} heights, and {columns} in the first list", heights[i].len());
                b.error(&format!("{at}.height[{i}]"), found, "lists of the same length");
                return None;
            }
            let (Some(from), Some(step)) = (&s.from, &s.step) else {
                b.error(
                    at,
                    "heights without a place",
                    "`from`, the first point, and `step`, the distance of the points",
                );
                return None;
            };
            let heights_m: Vec<f64> = heights.iter().flatten().map(Length::si).collect();
            Mesh::grid(all_si(from), step.each_ref().map(|step| step.si()), [heights.len(), columns], &heights_m)
                .map_err(|error| error.to_string())
        }
    };
    match made {
        Ok(mesh) => Some(Ground::mesh(mesh)),
        Err(found) => {
            b.error(at, found, "heights that fill a regular grid");
            None
        }
    }
}

/// The grid that points in any order fill.
fn from_points(points_m: &[[f64; 3]]) -> Result<Mesh, String> {
    let lines = |axis: usize| {
        let mut all: Vec<f64> = points_m.iter().map(|point| point[axis]).collect();
        all.sort_by(f64::total_cmp);
        let most = all.last().copied().unwrap_or(0.0).abs().max(all.first().copied().unwrap_or(0.0).abs());
        // the same place, but for rounding
        all.dedup_by(|b, a| *b - *a <= 1e-9 * most.max(1.0));
        all
    };
    let lines = [lines(0), lines(1)];
    let counts = [lines[0].len(), lines[1].len()];
    if counts.iter().any(|count| *count < 2) {
        return Err(format!("points at {} places of x and {} of y; expected at least 2 of each", counts[0], counts[1]));
    }
    let step_m = [0, 1].map(|i| (lines[i][counts[i] - 1] - lines[i][0]) / (counts[i] - 1) as f64);
    for (name, places) in ["x", "y"].into_iter().zip(&lines) {
        let mut gaps: Vec<f64> = places.windows(2).map(|pair| pair[1] - pair[0]).collect();
        gaps.sort_by(f64::total_cmp);
        let usual_m = gaps[gaps.len() / 2];
        let is_off = |pair: &&[f64]| (pair[1] - pair[0] - usual_m).abs() > ROUGH * usual_m;
        if let Some([from, to]) = places.windows(2).find(is_off) {
            let gap_m = to - from;
            return Err(format!(
                "{name} = {from} m and next {to} m, {gap_m:.3} m apart, where most are {usual_m:.3} m apart"
            ));
        }
    }
    let cells = counts[0].checked_mul(counts[1]).filter(|cells| *cells == points_m.len());
    let Some(cells) = cells else {
        let [rows, columns] = counts;
        return Err(format!("{} points at {rows} places of x and {columns} of y", points_m.len()));
    };
    let mut heights_m = vec![f64::NAN; cells];
    for [x, y, height_m] in points_m {
        let place = |i: usize, at: f64| ((at - lines[i][0]) / step_m[i]).round() as usize;
        let cell = place(0, *x) * counts[1] + place(1, *y);
        if !heights_m[cell].is_nan() {
            return Err(format!("the point x = {x} m, y = {y} m twice"));
        }
        heights_m[cell] = *height_m;
    }
    Mesh::grid([lines[0][0], lines[1][0]], step_m, counts, &heights_m).map_err(|error| error.to_string())
}
