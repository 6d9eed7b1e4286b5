//! Outline of a body in plan, with the nodes on it.

use crate::V3;
use crate::body::{Body, Crush, Row, Side};
use crate::crush::law::Law;

/// An edge of a convex outline: a corner, and the outward normal of the line through it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Edge {
    pub corner_m: [f64; 2],
    pub normal: [f64; 2],
    /// Its face.
    pub face: usize,
}

impl Edge {
    /// From one corner to the next, clockwise from above.
    fn between(from: [f64; 2], to: [f64; 2], face: usize) -> Self {
        let way = [to[0] - from[0], to[1] - from[1]];
        let length = libm::hypot(way[0], way[1]);
        Edge { corner_m: from, normal: [way[1] / length, -way[0] / length], face }
    }

    /// Height of a point over the line, m; negative inside.
    fn over_m(&self, point: [f64; 2]) -> f64 {
        (point[0] - self.corner_m[0]) * self.normal[0] + (point[1] - self.corner_m[1]) * self.normal[1]
    }
}

/// A face: one or more edges that push along a common normal.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Face {
    pub normal: [f64; 2],
    /// Law of the face, and of parts of it along the other direction, m.
    pub law: usize,
    pub hard: Vec<([f64; 2], usize)>,
}

/// A convex outline between two heights, in the axes of its body.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Outline {
    pub edges: Vec<Edge>,
    pub faces: Vec<Face>,
    /// Range of z (down), m.
    pub band_m: [f64; 2],
    /// Radius about the body's origin that contains it in plan, m; infinite for a half space.
    pub reach_m: f64,
}

/// A node on an outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Node {
    pub place_m: V3,
    /// Outward normal.
    pub normal: V3,
    /// Tributary width times its share of the stiffness, m.
    pub width_m: f64,
    pub law: usize,
    pub face: usize,
}

impl Outline {
    /// Whether a point is inside.
    pub fn holds(&self, point: &V3) -> bool {
        let plan = [point.x, point.y];
        self.band_m[0] <= point.z && point.z <= self.band_m[1] && self.edges.iter().all(|edge| edge.over_m(plan) < 0.0)
    }

    /// Depth of a point under a face, along the face's normal, m.
    pub fn depth_m(&self, face: usize, point: &V3) -> f64 {
        let normal = self.faces[face].normal;
        let of = |edge: &Edge| {
            let level = edge.normal[0] * normal[0] + edge.normal[1] * normal[1];
            -edge.over_m([point.x, point.y]) / level
        };
        self.edges.iter().filter(|edge| edge.face == face).map(of).fold(f64::INFINITY, f64::min)
    }

    /// The face through which a node moving from one point to another entered; if it started inside, the face of least
    /// depth.
    pub fn entered(&self, from: &V3, to: &V3) -> usize {
        let (start, end) = ([from.x, from.y], [to.x, to.y]);
        let late = |edge: &Edge| {
            let (a, b) = (edge.over_m(start), edge.over_m(end));
            (a > 0.0 && b < a).then(|| (a / (a - b), edge.face))
        };
        let crossed = self.edges.iter().filter_map(late).max_by(|a, b| a.0.total_cmp(&b.0));
        let shallow = || {
            let over = |edge: &Edge| edge.over_m(end);
            self.edges.iter().max_by(|a, b| over(a).total_cmp(&over(b))).map_or(0, |edge| edge.face)
        };
        crossed.map_or_else(shallow, |(_, face)| face)
    }

    /// Distance of a point outside in plan, m, negative inside, and the normal of the nearest edge.
    pub fn nearest(&self, point: &V3) -> (f64, [f64; 2]) {
        let over = self.edges.iter().map(|edge| (edge.over_m([point.x, point.y]), edge.normal));
        over.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::INFINITY, [1.0, 0.0]))
    }

    /// Distance of a point outside in plan, m; negative inside.
    pub fn gap_m(&self, point: &V3) -> f64 {
        self.edges.iter().map(|edge| edge.over_m([point.x, point.y])).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Whether a point is inside in plan, or outside by less than `spare_m`.
    pub fn is_near(&self, point: &V3, spare_m: f64) -> bool {
        self.edges.iter().all(|edge| edge.over_m([point.x, point.y]) < spare_m)
    }

    /// Law of a face at a point.
    pub fn law_at(&self, face: usize, point: &V3) -> usize {
        let Face { normal, law, hard, .. } = &self.faces[face];
        let along = if normal[0].abs() > normal[1].abs() { point.y } else { point.x };
        hard.iter().find(|(span, _)| span[0] <= along && along <= span[1]).map_or(*law, |(_, law)| *law)
    }

    /// Of any convex polygon of corners, clockwise from above; each edge is a face of law 0.
    pub fn of_corners(corners_m: &[[f64; 2]], band_m: [f64; 2]) -> Self {
        let n = corners_m.len();
        let edges: Vec<Edge> = (0..n).map(|i| Edge::between(corners_m[i], corners_m[(i + 1) % n], i)).collect();
        let faces = edges.iter().map(|edge| Face { normal: edge.normal, law: 0, hard: Vec::new() }).collect();
        let reach_m = corners_m.iter().map(|c| libm::hypot(c[0], c[1])).fold(0.0, f64::max);
        Outline { edges, faces, band_m, reach_m }
    }

    /// Least breadth of a polygon of these corners, m.
    pub fn breadth_m(&self, corners_m: &[[f64; 2]]) -> f64 {
        let across = |edge: &Edge| corners_m.iter().map(|corner| -edge.over_m(*corner)).fold(0.0, f64::max);
        self.edges.iter().map(across).fold(f64::INFINITY, f64::min)
    }

    /// Of all that lies behind a line with an outward normal.
    pub fn half_space(point_m: [f64; 2], normal: [f64; 2], band_m: [f64; 2]) -> Self {
        Outline {
            edges: vec![Edge { corner_m: point_m, normal, face: 0 }],
            faces: vec![Face { normal, law: 0, hard: Vec::new() }],
            band_m,
            reach_m: f64::INFINITY,
        }
    }

    /// The faces and normals along which an edge pushes. A cut corner counts for the end by its width across and for
    /// the side by its length along, so that a push from any direction finds its full width.
    fn pushed(&self, edge: &Edge) -> impl Iterator<Item = (usize, [f64; 2])> + '_ {
        let edge = *edge;
        let across = move |face: &Face| face.normal[0] * edge.normal[0] + face.normal[1] * edge.normal[1];
        let is_cut = across(&self.faces[edge.face]) < 1.0 - 1e-9;
        let faces = self.faces.iter().enumerate();
        let pushed = faces.filter(move |(i, face)| *i == edge.face || is_cut && across(face) > 1e-9);
        pushed.map(|(i, face)| (i, face.normal))
    }

    /// Nodes on all edges at distances of at most `spacing_m`, at one height z and with a share.
    pub fn nodes(&self, spacing_m: f64, z_m: f64, share: f64) -> Vec<Node> {
        let mut nodes = Vec::new();
        for (i, edge) in self.edges.iter().enumerate() {
            let next = self.edges[(i + 1) % self.edges.len()].corner_m;
            let way = [next[0] - edge.corner_m[0], next[1] - edge.corner_m[1]];
            let length_m = libm::hypot(way[0], way[1]);
            let count = (length_m / spacing_m).round().max(1.0) as usize;
            for (face, normal) in self.pushed(edge) {
                let across = normal[0] * edge.normal[0] + normal[1] * edge.normal[1];
                nodes.extend((0..count).map(|j| {
                    let s = (j as f64 + 0.5) / count as f64;
                    let place_m = V3::new(edge.corner_m[0] + s * way[0], edge.corner_m[1] + s * way[1], z_m);
                    Node {
                        place_m,
                        normal: V3::new(normal[0], normal[1], 0.0),
                        width_m: share * across * length_m / count as f64,
                        law: self.law_at(face, &place_m),
                        face,
                    }
                }));
            }
        }
        nodes
    }
}

/// Sides in the order of the faces of a vehicle's outline.
pub(crate) const SIDES: [Side; 4] = [Side::Front, Side::Right, Side::Rear, Side::Left];

/// Outline, nodes and laws of a vehicle whose centre of gravity stands at a height.
pub(crate) fn of_body(body: &Body, height_m: f64) -> (Outline, Vec<Node>, Vec<Law>) {
    let Body { front_m, length_m, width_m, corner_m: cut, band_m, crush, .. } = body;
    let (ahead, behind, half) = (*front_m, front_m - length_m, 0.5 * width_m);
    let mut corners = vec![
        ([ahead, -half + cut], 0),
        ([ahead, half - cut], 0),
        ([ahead - cut, half], 1),
        ([behind + cut, half], 2),
        ([behind, half - cut], 2),
        ([behind, -half + cut], 2),
        ([behind + cut, -half], 3),
        ([ahead - cut, -half], 0),
    ];
    if *cut <= 0.0 {
        corners = vec![([ahead, -half], 0), ([ahead, half], 1), ([behind, half], 2), ([behind, -half], 3)];
    }
    let n = corners.len();
    let edges = (0..n).map(|i| Edge::between(corners[i].0, corners[(i + 1) % n].0, corners[i].1)).collect();
    let law = |side: Side, factor: f64| Law::of(crush.of(side).scaled(factor, factor), crush.reading, crush.returned);
    let mut laws: Vec<Law> = SIDES.iter().map(|side| law(*side, 1.0)).collect();
    let mut faces: Vec<Face> = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]]
        .into_iter()
        .enumerate()
        .map(|(i, normal)| Face { normal, law: i, hard: Vec::new() })
        .collect();
    for hard in &crush.hard {
        let face = SIDES.iter().position(|side| *side == hard.side).unwrap_or(0);
        faces[face].hard.push((hard.span_m, laws.len()));
        laws.push(law(hard.side, hard.factor));
    }
    let reach_m = libm::hypot(ahead.max(-behind), half);
    let outline = Outline { edges, faces, band_m: [height_m - band_m[1], height_m - band_m[0]], reach_m };
    let nodes = nodes_of(&outline, crush, height_m);
    (outline, nodes, laws)
}

fn nodes_of(outline: &Outline, crush: &Crush, height_m: f64) -> Vec<Node> {
    let mut nodes = Vec::new();
    for (rows, is_end) in [(&crush.end_rows, true), (&crush.side_rows, false)] {
        for Row { height_m: over_road_m, share } in rows {
            let row = outline.nodes(crush.spacing_m, height_m - over_road_m, *share);
            nodes.extend(row.into_iter().filter(|node| node.face.is_multiple_of(2) == is_end));
        }
    }
    nodes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::car::{Car, Class};

    #[test]
    fn widths_of_the_nodes_are_those_of_the_sides() {
        let body = Car::of_class(Class::Sedan).body;
        for cut in [0.0, 0.15] {
            let (outline, nodes, _) = of_body(&Body { corner_m: cut, ..body.clone() }, 0.55);
            let width = |face: usize| nodes.iter().filter(|n| n.face == face).map(|n| n.width_m).sum::<f64>();
            for (face, expected) in [(0, 1.82), (2, 1.82), (1, 4.7), (3, 4.7)] {
                assert!((width(face) - expected).abs() < 1e-12, "{cut} {face}: {}", width(face));
            }
            assert!(nodes.iter().all(|node| outline.gap_m(&node.place_m).abs() < 1e-12));
        }
    }

    #[test]
    fn a_way_in_tells_its_face() {
        let (outline, ..) = of_body(&Car::of_class(Class::Sedan).body, 0.55);
        let at = |x: f64, y: f64| V3::new(x, y, 0.1);
        // through the front near the corner, deeper under it than under the side
        let (from, to) = (at(2.2, 0.7), at(1.7, 0.7));
        assert!(outline.holds(&to) && outline.entered(&from, &to) == 0);
        assert!((outline.depth_m(0, &to) - 0.35).abs() < 1e-12);
        // at the cut corner the depth along the front's normal is to the cut
        assert!((outline.depth_m(0, &at(1.7, 0.85)) - 0.26).abs() < 1e-9);
        assert_eq!(outline.entered(&at(0.0, 1.0), &at(0.0, 0.85)), 1);
        assert_eq!(outline.entered(&at(0.0, 0.88), &at(0.0, 0.85)), 1);
        assert!(!outline.holds(&V3::new(0.0, 0.0, -0.5)));
    }
}
