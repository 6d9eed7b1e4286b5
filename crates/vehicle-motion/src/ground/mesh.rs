//! Triangles over a lattice of corners: a grid of heights, or cross-sections along a road.
//!
//! Corners lie in rows. Each cell between two rows and two columns has two triangles on both sides of the diagonal from
//! its first corner. Four cells meet at a corner, so that neighbours are found without a search.

use super::{FAR_M, GroundError};
use crate::V3;

/// Rings of cells around the one below that may be nearest to a point above an edge.
const RINGS: isize = 2;
/// Cosine of the turn up to which rows of a road make a block, within which a place is found by halving.
const BLOCK_TURNS: f64 = 0.5;

/// Number of rows of a bend that a drawing takes together.
const ROWS_DRAWN: usize = 5;

/// Triangles that make the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Corners row by row, each from left to right: X, Y, Z, m.
    corners_m: Vec<V3>,
    /// Number of corners of a row.
    across: usize,
    /// Upward normals of the triangles: two for each cell.
    pub(super) normals: Vec<V3>,
    place: Place,
}

/// How the cell at a place is found.
#[derive(Clone, Debug, PartialEq)]
enum Place {
    /// Rows and columns at equal distances behind the first, which lies far away as the last does.
    Grid { from_m: [f64; 2], step_m: [f64; 2] },
    /// Rows across a line.
    Line { rows: Vec<Row>, blocks: Vec<Reach> },
}

/// A row across a road: where the line passes, and the direction of the line there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Row {
    pub at_m: [f64; 2],
    pub way: [f64; 2],
}

impl Row {
    /// Distance of a place ahead of the row, and to the right of the line, m.
    fn seen_m(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let off = [x - self.at_m[0], y - self.at_m[1]];
        [off[0] * self.way[0] + off[1] * self.way[1], off[1] * self.way[0] - off[0] * self.way[1]]
    }

    /// The place at a distance to the right of the line, m.
    pub fn place_m(&self, right_m: f64) -> [f64; 2] {
        [self.at_m[0] - self.way[1] * right_m, self.at_m[1] + self.way[0] * right_m]
    }
}

/// Extent of a block of rows in plan: least and largest X and Y of its cells, m.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Reach {
    /// The first row, and the row that ends the last cell.
    rows: [usize; 2],
    low_m: [f64; 2],
    high_m: [f64; 2],
}

impl Mesh {
    /// A grid of heights: those at X = `from_m[0]`, from left to right, then those of the next X, and so on. Beyond its
    /// rim the ground is level outwards.
    ///
    /// # Errors
    /// Fewer than two rows or columns, another number of heights, numbers that are not finite, a step that is not
    /// above 0.
    pub fn grid(
        from_m: [f64; 2],
        step_m: [f64; 2],
        [rows, columns]: [usize; 2],
        heights_m: &[f64],
    ) -> Result<Self, GroundError> {
        if rows < 2 || columns < 2 || rows.checked_mul(columns) != Some(heights_m.len()) {
            return Err(GroundError::Grid { rows, columns, heights: heights_m.len() });
        }
        if let Some(step_m) = step_m.iter().find(|step_m| !(**step_m > 0.0 && step_m.is_finite())) {
            return Err(GroundError::Spacing(*step_m));
        }
        if heights_m.iter().chain(&from_m).any(|x| !x.is_finite()) {
            return Err(GroundError::NotFinite);
        }
        // a rim far away, as high as the edge
        let line = |axis: usize, count: usize| {
            (0..count + 2).map(move |i| {
                let inner = i.clamp(1, count) - 1;
                let at_m = from_m[axis] + inner as f64 * step_m[axis];
                let beyond_m = if i == 0 { -FAR_M } else { FAR_M * f64::from(u8::from(i == count + 1)) };
                (inner, at_m + beyond_m)
            })
        };
        let corner =
            |(i, x): (usize, f64)| line(1, columns).map(move |(j, y)| V3::new(x, y, -heights_m[i * columns + j]));
        let corners_m = line(0, rows).flat_map(corner).collect();
        Ok(Mesh::of(corners_m, columns + 2, Place::Grid { from_m, step_m }))
    }

    /// Cross-sections at rows across a line.
    pub(super) fn along(rows: Vec<Row>, corners_m: Vec<V3>) -> Self {
        let across = corners_m.len() / rows.len();
        let cells: Vec<&[V3]> = corners_m.chunks_exact(across).collect();
        let reach = |first: usize, last: usize| {
            let held = || cells[first..=last].iter().copied().flatten();
            let low = |axis: usize| held().map(|corner| corner[axis]).fold(f64::INFINITY, f64::min);
            let high = |axis: usize| held().map(|corner| corner[axis]).fold(f64::NEG_INFINITY, f64::max);
            Reach { rows: [first, last], low_m: [low(0), low(1)], high_m: [high(0), high(1)] }
        };
        let (mut blocks, mut first) = (Vec::new(), 0);
        let last = rows.len() - 1;
        while first < last {
            let turns = |row: &Row| {
                let way = rows[first].way;
                row.way[0] * way[0] + row.way[1] * way[1] < BLOCK_TURNS
            };
            // at least one cell; the first and the last, which reach far, for themselves
            let most = if first == 0 { 1 } else { (last - 1).max(first + 1) };
            let end = (first + 1..most).find(|row| turns(&rows[row + 1])).unwrap_or(most);
            blocks.push(reach(first, end));
            first = end;
        }
        Mesh::of(corners_m, across, Place::Line { rows, blocks })
    }

    fn of(corners_m: Vec<V3>, across: usize, place: Place) -> Self {
        let mut mesh = Mesh { corners_m, across, normals: Vec::new(), place };
        let normal = |face: usize| {
            let [a, b, c] = mesh.face_m(face);
            (c - a).cross(&(b - a)).normalize()
        };
        mesh.normals = (0..2 * (mesh.rows() - 1) * (across - 1)).map(normal).collect();
        mesh
    }

    fn rows(&self) -> usize {
        self.corners_m.len() / self.across
    }

    /// Corners of a triangle, clockwise from above, m.
    fn face_m(&self, face: usize) -> [V3; 3] {
        let (row, column) = self.cell(face);
        let at = |i: usize, j: usize| self.corners_m[(row + i) * self.across + column + j];
        if face.is_multiple_of(2) { [at(0, 0), at(1, 0), at(1, 1)] } else { [at(0, 0), at(1, 1), at(0, 1)] }
    }

    /// The ground to draw: of a grid its triangles, of a road four corners for some metres of its way. Corners go
    /// clockwise from above, m.
    pub fn pieces_m(&self) -> Vec<Vec<V3>> {
        if let Place::Grid { .. } = self.place {
            return (0..self.normals.len()).map(|face| self.face_m(face).to_vec()).collect();
        }
        let last = self.rows() - 1;
        // the first and the last row lie far away
        let mut rows: Vec<usize> = core::iter::once(0).chain((1..last).step_by(ROWS_DRAWN)).collect();
        rows.extend([last - 1, last].into_iter().filter(|row| *row > rows[rows.len() - 1]).collect::<Vec<_>>());
        let at = |i: usize, j: usize| self.corners_m[i * self.across + j];
        let piece = |(from, to): (usize, usize)| {
            (0..self.across - 1).map(move |j| vec![at(from, j), at(to, j), at(to, j + 1), at(from, j + 1)])
        };
        rows.windows(2).flat_map(|pair| piece((pair[0], pair[1]))).collect()
    }

    fn cell(&self, face: usize) -> (usize, usize) {
        let cell = face / 2;
        (cell / (self.across - 1), cell % (self.across - 1))
    }

    fn face_of(&self, row: usize, column: usize, half: usize) -> usize {
        2 * (row * (self.across - 1) + column) + half
    }

    /// A point of a face, m.
    pub(super) fn point_m(&self, face: usize) -> V3 {
        let (row, column) = self.cell(face);
        self.corners_m[row * self.across + column]
    }

    /// The triangle at a place; outside of all the one whose edge is near.
    pub(super) fn face_at(&self, x_m: f64, y_m: f64) -> usize {
        let at_m = [x_m, y_m];
        let (row, column) = match &self.place {
            Place::Grid { from_m, step_m } => {
                let line = |axis: usize, cells: usize| {
                    let over = ((at_m[axis] - from_m[axis]) / step_m[axis]).floor() + 1.0;
                    over.clamp(0.0, cells as f64 - 1.0) as usize
                };
                (line(0, self.rows() - 1), line(1, self.across - 1))
            }
            Place::Line { rows, blocks } => {
                let row = row_at(rows, blocks, at_m);
                let beyond = |column: &usize| {
                    let corner = |i: usize| self.corners_m[(row + i) * self.across + column + 1];
                    right_of(&corner(0), &corner(1), at_m) >= 0.0
                };
                (row, (0..self.across - 2).take_while(beyond).count())
            }
        };
        let [a, _, c] = self.face_m(self.face_of(row, column, 0));
        self.face_of(row, column, usize::from(right_of(&a, &c, at_m) > 0.0))
    }

    /// The triangle at a place that is likely to be in a known one.
    pub(super) fn face_towards(&self, face: usize, at_m: [f64; 2]) -> usize {
        let [a, b, c] = self.face_m(face);
        let is_in = [(a, b), (b, c), (c, a)].iter().all(|(from, to)| right_of(from, to, at_m) >= 0.0);
        if is_in { face } else { self.face_at(at_m[0], at_m[1]) }
    }

    /// Height at a place, m.
    pub(super) fn height_m(&self, x_m: f64, y_m: f64) -> f64 {
        let face = self.face_at(x_m, y_m);
        let (normal, point) = (self.normals[face], self.point_m(face));
        ((x_m - point.x) * normal.x + (y_m - point.y) * normal.y) / normal.z - point.z
    }

    /// Whether a place lies within the corners that were given: those outside of them were added.
    pub(super) fn is_given(&self, x_m: f64, y_m: f64) -> bool {
        let (row, column) = self.cell(self.face_at(x_m, y_m));
        let ends = matches!(self.place, Place::Grid { .. });
        let is_inner = |i: usize, count: usize| i > 0 && i + 1 < count;
        is_inner(column, self.across - 1) && (!ends || is_inner(row, self.rows() - 1))
    }

    /// The face at a place, if its cell is flat and extends by a distance to all sides.
    pub(super) fn lone_face(&self, x_m: f64, y_m: f64, way_m: f64) -> Option<usize> {
        let face = self.face_at(x_m, y_m);
        let first = face & !1;
        if (self.normals[first] - self.normals[first + 1]).norm_squared() > 1e-24 {
            return None;
        }
        self.is_within(face, &V3::new(x_m, y_m, 0.0), way_m).then_some(first)
    }

    /// Where a straight way in plan leaves a triangle, and the triangle beyond that edge; none at the rim.
    pub(super) fn exit(&self, face: usize, base_m: [f64; 2], rate: [f64; 2], forward: f64) -> Option<(f64, usize)> {
        let [a, b, c] = self.face_m(face);
        let mut first: Option<(f64, usize)> = None;
        for (edge, (from, to)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
            let inward = (to.x - from.x) * rate[1] - (to.y - from.y) * rate[0];
            if inward * forward < 0.0 {
                let x = -right_of(&from, &to, base_m) / inward;
                if first.is_none_or(|(least, _)| x * forward < least * forward) {
                    first = Some((x, edge));
                }
            }
        }
        let (x, edge) = first?;
        Some((x, self.beyond(face, edge)?))
    }

    /// The triangle beyond an edge of another.
    fn beyond(&self, face: usize, edge: usize) -> Option<usize> {
        let (row, column) = self.cell(face);
        match (face % 2, edge) {
            (0, 0) => Some(self.face_of(row, column.checked_sub(1)?, 1)),
            (0, 1) => (row + 2 < self.rows()).then(|| self.face_of(row + 1, column, 1)),
            (0, _) | (1, 0) => Some(face ^ 1),
            (_, 1) => (column + 2 < self.across).then(|| self.face_of(row, column + 1, 0)),
            _ => Some(self.face_of(row.checked_sub(1)?, column, 0)),
        }
    }

    /// Distance of a point to the triangles, m, negative below, and the direction away from them. What is further off than
    /// `within_m` may be given by the face below alone.
    pub(super) fn distance(&self, point_m: &V3, within_m: f64) -> (f64, V3) {
        let face = self.face_at(point_m.x, point_m.y);
        let normal = self.normals[face];
        let over_m = normal.dot(&(point_m - self.point_m(face)));
        let (mut least_m, mut away) = (over_m.min(within_m), normal);
        if over_m <= 0.0 {
            return (over_m, normal);
        }
        let rings = if self.is_within(face, point_m, least_m) { 0 } else { RINGS };
        let (row, column) = self.cell(face);
        for i in -rings..=rings {
            let Some(i) = row.checked_add_signed(i).filter(|i| i + 1 < self.rows()) else { continue };
            for j in -rings..=rings {
                let Some(j) = column.checked_add_signed(j).filter(|j| j + 1 < self.across) else { continue };
                if self.aside_m(i, j, point_m) >= least_m {
                    continue;
                }
                for other in [0, 1].map(|half| self.face_of(i, j, half)) {
                    // no point of a triangle is nearer than its plane
                    let plane = self.normals[other];
                    if plane == normal || plane.dot(&(point_m - self.point_m(other))) >= least_m {
                        continue;
                    }
                    let off = point_m - nearest(self.face_m(other), point_m);
                    let far_m = off.norm();
                    if far_m < least_m {
                        (least_m, away) = (far_m, off / far_m.max(1e-12));
                    }
                }
            }
        }
        if least_m < over_m.min(within_m) { (least_m, away) } else { (over_m, normal) }
    }

    /// Whether the cell of a face reaches further than this from a point to all sides in plan, m.
    fn is_within(&self, face: usize, point_m: &V3, way_m: f64) -> bool {
        let first = face & !1;
        let ([a, b, c], [.., d]) = (self.face_m(first), self.face_m(first + 1));
        [(a, b), (b, c), (c, d), (d, a)].into_iter().all(|(from, to)| {
            let (x, y) = (to.x - from.x, to.y - from.y);
            let right = right_of(&from, &to, [point_m.x, point_m.y]);
            right > 0.0 && right * right > way_m * way_m * (x * x + y * y)
        })
    }

    /// How far a point lies beside the box around a cell in plan, m.
    fn aside_m(&self, row: usize, column: usize, point_m: &V3) -> f64 {
        let at = |i: usize, j: usize| &self.corners_m[(row + i) * self.across + column + j];
        let (a, b, c, d) = (at(0, 0), at(1, 0), at(1, 1), at(0, 1));
        let beside = |axis: usize| {
            let low = a[axis].min(b[axis]).min(c[axis]).min(d[axis]);
            let high = a[axis].max(b[axis]).max(c[axis]).max(d[axis]);
            (low - point_m[axis]).max(point_m[axis] - high)
        };
        beside(0).max(beside(1))
    }

    /// Distance of a place right of the X axis, or of the road's line, m.
    pub(super) fn offset_m(&self, x_m: f64, y_m: f64) -> f64 {
        let Place::Line { rows, blocks } = &self.place else { return y_m };
        let row = row_at(rows, blocks, [x_m, y_m]);
        let [[from, left], [to, right]] = [0, 1].map(|i| rows[row + i].seen_m([x_m, y_m]));
        let share = if from > to { (from / (from - to)).clamp(0.0, 1.0) } else { 0.0 };
        left + share * (right - left)
    }

    /// The line at a distance right of the X axis, or of the road's line, in plan, m.
    pub(super) fn line_at_m(&self, right_m: f64) -> Vec<[f64; 2]> {
        match &self.place {
            Place::Grid { .. } => vec![[-FAR_M, right_m], [FAR_M, right_m]],
            Place::Line { rows, .. } => rows.iter().map(|row| row.place_m(right_m)).collect(),
        }
    }

    /// The lines of corners along a road in plan, m; none of a grid.
    pub fn edges_m(&self) -> Vec<Vec<[f64; 2]>> {
        if let Place::Grid { .. } = self.place {
            return Vec::new();
        }
        let line = |j: usize| self.corners_m.iter().skip(j).step_by(self.across).map(|at| [at.x, at.y]).collect();
        (1..self.across - 1).map(line).collect()
    }
}

/// The number of the row behind a place: where the line passes nearest, if it passes more than once.
fn row_at(rows: &[Row], blocks: &[Reach], at_m: [f64; 2]) -> usize {
    let mut best = (f64::INFINITY, 0);
    for reach in blocks {
        let is_in = |axis: usize| (reach.low_m[axis]..=reach.high_m[axis]).contains(&at_m[axis]);
        if !(is_in(0) && is_in(1)) {
            continue;
        }
        let [mut row, mut end] = reach.rows;
        if rows[row].seen_m(at_m)[0] < 0.0 || rows[end].seen_m(at_m)[0] >= 0.0 {
            continue;
        }
        while end - row > 1 {
            let middle = row.midpoint(end);
            if rows[middle].seen_m(at_m)[0] >= 0.0 { row = middle } else { end = middle }
        }
        let right_m = rows[end].seen_m(at_m)[1].abs();
        if right_m < best.0 {
            best = (right_m, row);
        }
    }
    if best.0 < f64::INFINITY { best.1 } else { nearest_row(rows, at_m) }
}

/// Of a place beyond all cells: the row whose point of the line is nearest.
fn nearest_row(rows: &[Row], at_m: [f64; 2]) -> usize {
    let far = |row: &Row| {
        let off = [at_m[0] - row.at_m[0], at_m[1] - row.at_m[1]];
        off[0] * off[0] + off[1] * off[1]
    };
    let inner = rows.len() - 2;
    let nearest = (0..=inner).min_by(|a, b| far(&rows[*a]).total_cmp(&far(&rows[*b])));
    let nearest = nearest.unwrap_or(0);
    if rows[nearest].seen_m(at_m)[0] < 0.0 { nearest.saturating_sub(1) } else { nearest }
}

/// Twice the area of the triangle of an edge and a place in plan: above 0 to the right of the edge.
#[inline]
fn right_of(from: &V3, to: &V3, [x, y]: [f64; 2]) -> f64 {
    (to.x - from.x) * (y - from.y) - (to.y - from.y) * (x - from.x)
}

/// The point of a triangle nearest to another point (Ericson, Real-Time Collision Detection, 5.1.5).
fn nearest([a, b, c]: [V3; 3], p: &V3) -> V3 {
    let (ab, ac) = (b - a, c - a);
    let along = |from: V3| [ab.dot(&(p - from)), ac.dot(&(p - from))];
    let [[d1, d2], [d3, d4], [d5, d6]] = [along(a), along(b), along(c)];
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let (va, vb, vc) = (d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2);
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let whole = va + vb + vc;
    a + ab * (vb / whole) + ac * (vc / whole)
}
