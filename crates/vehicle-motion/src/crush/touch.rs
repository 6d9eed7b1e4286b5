//! Nodes of one body against the outline of another.
//!
//! A node remembers the face through which it entered. Its depth under that face, and its largest force per width so
//! far, give its force, along the normal of the face. The force acts on both bodies at the same point, so momenta are
//! conserved.

use crate::V3;
use crate::crush::law::Series;
use crate::crush::outline::{Node, Outline};
use core::ops::Range;
use nalgebra::Matrix3;

/// Distance along the face, and height, within which a node of a narrow body marks nodes of the other, m; sides have
/// other rows than ends.
const NEXT_M: f64 = 0.05;
const LEVEL_M: f64 = 0.155;
/// Least cosine between a node's normal and the contact for damage: excludes nodes of a side that passes a wall.
pub(crate) const SQUARE: f64 = 0.2;
/// Regularisation speed of friction, m/s.
const TURNS_M_S: f64 = 0.127;

/// Pose and motion of a body, vehicle-space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pose {
    pub at_m: V3,
    pub axes: Matrix3<f64>,
    pub velocity_m_s: V3,
    pub turning_rad_s: V3,
}

impl Pose {
    /// Of what is at rest with its axes along those of space.
    pub fn standing(at_m: V3) -> Self {
        Pose { at_m, axes: Matrix3::identity(), velocity_m_s: V3::zeros(), turning_rad_s: V3::zeros() }
    }

    /// Velocity of the body at a place.
    pub fn velocity_at(&self, place_m: &V3) -> V3 {
        self.velocity_m_s + self.turning_rad_s.cross(&(place_m - self.at_m))
    }
}

/// Load on a body: force and moment about its origin, vehicle-space, and powers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Push {
    pub force_n: V3,
    pub moment_n_m: V3,
    /// Power absorbed by its structure, W.
    pub crushing_w: f64,
    /// Power dissipated in sliding along a partner, W.
    pub rubbing_w: f64,
}

/// A body as partner in contact: its outline and its nodes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Shape {
    pub outline: Outline,
    pub nodes: Vec<Node>,
    /// Runs of nodes, so that those far away are passed over together.
    runs: Vec<Run>,
}

/// Nodes next to each other, and a sphere that holds them.
#[derive(Clone, Debug, PartialEq)]
struct Run {
    nodes: Range<usize>,
    centre_m: V3,
    radius_m: f64,
}

/// Nodes of a run.
const RUN: usize = 8;

impl Shape {
    /// An outline with its nodes, neighbours next to each other.
    pub fn new(outline: Outline, nodes: Vec<Node>) -> Self {
        let run = |(i, own): (usize, &[Node])| {
            let centre_m = own.iter().map(|node| node.place_m).sum::<V3>() / own.len() as f64;
            let radius_m = own.iter().map(|node| (node.place_m - centre_m).norm()).fold(0.0, f64::max);
            Run { nodes: i * RUN..i * RUN + own.len(), centre_m, radius_m }
        };
        let runs = nodes.chunks(RUN).enumerate().map(run).collect();
        Shape { outline, nodes, runs }
    }

    /// The nodes, with their numbers, of all runs that may reach into an outline.
    fn nodes_within<'a>(
        &'a self,
        view: &'a View,
        outline: &'a Outline,
    ) -> impl Iterator<Item = (usize, &'a Node)> + 'a {
        let is_near = move |run: &&Run| outline.is_near(&view.place(&run.centre_m), run.radius_m + 1e-9);
        let near = self.runs.iter().filter(is_near);
        near.flat_map(|run| run.nodes.clone().map(|i| (i, &self.nodes[i])))
    }
}

/// Nodes of one body against the outline of another.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Pass {
    /// Body whose nodes count.
    pub nodes_of: usize,
    /// Body whose outline counts.
    pub outline_of: usize,
    /// Number of the list of largest forces of the nodes.
    pub memory: usize,
    /// ½ where both bodies' nodes count.
    pub weight: f64,
    pub friction: f64,
    /// By law of the node, then law of the face; `columns` laws of faces.
    pub series: Vec<Series>,
    pub columns: usize,
    /// Shares of both bodies in friction losses.
    pub rubbing: [f64; 2],
    /// Whether the outline's body is the deformable one, as for a pole's nodes in a car.
    pub outline_crushes: bool,
}

/// No face: the node has not entered.
pub(crate) const NO_FACE: u8 = u8::MAX;

/// Stored state of the nodes: the face through which each entered, and its largest force per width, N/m.
pub(crate) struct Marks<'a> {
    pub faces: &'a [u8],
    pub most: &'a [f64],
}

/// A node inside an outline, in the outline's axes.
struct Met {
    at_m: V3,
    face: usize,
    normal: V3,
    depth_m: f64,
    /// Cosine of the angle to the face.
    facing: f64,
}

/// Both bodies of a pass, from the outline's axes.
struct View {
    turn: Matrix3<f64>,
    shift: V3,
}

impl View {
    fn of(nodes: &Pose, outline: &Pose) -> Self {
        let back = outline.axes.transpose();
        View { turn: back * nodes.axes, shift: back * (nodes.at_m - outline.at_m) }
    }

    fn place(&self, place_m: &V3) -> V3 {
        self.turn * place_m + self.shift
    }
}

impl Pass {
    /// Whether the bodies are too far apart to touch, by more than `spare_m`.
    pub fn is_apart(&self, shapes: &[Shape], poses: &[Pose], spare_m: f64) -> bool {
        let [a, b] = [self.nodes_of, self.outline_of];
        let reach_m = shapes[a].outline.reach_m + shapes[b].outline.reach_m + spare_m;
        let way = poses[a].at_m - poses[b].at_m;
        if reach_m == f64::INFINITY {
            return shapes[b].outline.gap_m(&way) > shapes[a].outline.reach_m + spare_m;
        }
        way.x * way.x + way.y * way.y > reach_m * reach_m
    }

    fn met(&self, node: &Node, face: u8, outline: &Outline, now: &View, before: &View) -> Option<Met> {
        let (at_m, face) = inside(node, face, outline, now, before)?;
        Self::met_at(node, (at_m, face), outline, now)
    }

    /// A node at a place inside an outline, by the face through which it came.
    fn met_at(node: &Node, (at_m, face): (V3, usize), outline: &Outline, now: &View) -> Option<Met> {
        let [x, y] = outline.faces[face].normal;
        let normal = V3::new(x, y, 0.0);
        let depth_m = outline.depth_m(face, &at_m);
        let facing = -(now.turn * node.normal).dot(&normal);
        (depth_m > 0.0 && facing > 0.0).then_some(Met { at_m, face, normal, depth_m, facing })
    }

    fn series(&self, node: &Node, outline: &Outline, met: &Met) -> &Series {
        &self.series[node.law * self.columns + outline.law_at(met.face, &met.at_m)]
    }

    /// Adds the forces on both bodies; `before` are the poses at the last accepted step. Returns the sum of the forces' sizes.
    pub fn push(&self, marks: &Marks, shapes: &[Shape], poses: &[Pose], before: &[Pose], pushes: &mut [Push]) -> f64 {
        if self.is_apart(shapes, poses, 0.0) {
            return 0.0;
        }
        let [a, b] = [self.nodes_of, self.outline_of];
        let outline = &shapes[b].outline;
        let (now, past) = (View::of(&poses[a], &poses[b]), View::of(&before[a], &before[b]));
        // relative velocity of the bodies at a place q: slides + turns × q, in the outline's axes
        let back = poses[b].axes.transpose();
        let slides = back * (poses[a].velocity_at(&poses[b].at_m) - poses[b].velocity_m_s);
        let turns = back * (poses[a].turning_rad_s - poses[b].turning_rad_s);
        let (mut force, mut about_b, mut size) = (V3::zeros(), V3::zeros(), 0.0);
        let (mut crushing, mut first_w, mut rubbing) = (0.0, 0.0, 0.0);
        for (i, node) in shapes[a].nodes_within(&now, outline) {
            let Some(met) = self.met(node, marks.faces[i], outline, &now, &past) else { continue };
            let pressure = self.series(node, outline, &met).pressure(met.depth_m, marks.most[i]);
            let normal_n = self.weight * pressure.force_n_per_m * node.width_m * met.facing;
            if normal_n == 0.0 {
                continue;
            }
            let velocity = slides + turns.cross(&met.at_m);
            let closing = -velocity.dot(&met.normal);
            let along = velocity + met.normal * closing;
            let speed = (along.norm_squared() + TURNS_M_S * TURNS_M_S).sqrt();
            let f = met.normal * normal_n - along * (self.friction * normal_n / speed);
            force += f;
            about_b += met.at_m.cross(&f);
            size += normal_n;
            crushing += normal_n * closing;
            first_w += normal_n * closing * pressure.first;
            rubbing += self.friction * normal_n * along.norm_squared() / speed;
        }
        if size > 0.0 {
            let about_a = about_b - now.shift.cross(&force);
            let axes = poses[b].axes;
            let (force, about_a, about_b) = (axes * force, axes * about_a, axes * about_b);
            let first_w = if self.outline_crushes { crushing - first_w } else { first_w };
            add(&mut pushes[a], force, about_a, first_w, self.rubbing[0] * rubbing);
            add(&mut pushes[b], -force, -about_b, crushing - first_w, self.rubbing[1] * rubbing);
        }
        size
    }

    /// Stores the faces through which nodes came in, and their largest forces.
    pub fn commit(&self, faces: &mut [u8], most: &mut [f64], shapes: &[Shape], poses: &[Pose], before: &[Pose]) {
        if self.is_apart(shapes, poses, 0.0) {
            return;
        }
        let [a, b] = [self.nodes_of, self.outline_of];
        let outline = &shapes[b].outline;
        let (now, past) = (View::of(&poses[a], &poses[b]), View::of(&before[a], &before[b]));
        for (i, node) in shapes[a].nodes_within(&now, outline) {
            let Some((at_m, face)) = inside(node, faces[i], outline, &now, &past) else { continue };
            // also what does not face it yet: it may turn to it later
            faces[i] = face as u8;
            let Some(met) = Self::met_at(node, (at_m, face), outline, &now) else { continue };
            if met.facing > SQUARE {
                most[i] = most[i].max(self.series(node, outline, &met).load(met.depth_m));
            }
        }
    }

    /// The node nearest to the outline in plan: distance, m, negative inside, and position in vehicle-space.
    pub fn nearest(&self, shapes: &[Shape], poses: &[Pose]) -> Option<(f64, V3)> {
        let [a, b] = [self.nodes_of, self.outline_of];
        let (outline, now) = (&shapes[b].outline, View::of(&poses[a], &poses[b]));
        let mut nearest: Option<(f64, V3)> = None;
        for run in &shapes[a].runs {
            let least_m = nearest.map_or(f64::INFINITY, |(gap_m, _)| gap_m);
            if outline.gap_m(&now.place(&run.centre_m)) - run.radius_m > least_m {
                continue;
            }
            let nodes = shapes[a].nodes[run.nodes.clone()].iter().map(|node| now.place(&node.place_m));
            let level = nodes.filter(|at| outline.band_m[0] <= at.z && at.z <= outline.band_m[1]);
            let own = level.map(|at| (outline.gap_m(&at), at)).min_by(|x, y| x.0.total_cmp(&y.0));
            nearest = own.filter(|(gap_m, _)| *gap_m < least_m).or(nearest);
        }
        nearest.map(|(gap_m, at)| (gap_m, poses[b].at_m + poses[b].axes * at))
    }

    /// Whether a node is inside the outline.
    pub fn touches(&self, shapes: &[Shape], poses: &[Pose]) -> bool {
        let [a, b] = [self.nodes_of, self.outline_of];
        let (outline, now) = (&shapes[b].outline, View::of(&poses[a], &poses[b]));
        shapes[a].nodes_within(&now, outline).any(|(_, node)| outline.holds(&now.place(&node.place_m)))
    }

    /// Its way, m.
    pub fn gap_m(&self, shapes: &[Shape], poses: &[Pose]) -> f64 {
        self.nearest(shapes, poses).map_or(f64::INFINITY, |(gap_m, _)| gap_m)
    }

    /// Transfers the dents made by nodes of a narrow body to neighbouring nodes of the outline's body.
    pub fn mark(&self, marks: &Marks, on: &mut [f64], shapes: &[Shape], poses: &[Pose]) {
        let [a, b] = [self.nodes_of, self.outline_of];
        let (outline, now) = (&shapes[b].outline, View::of(&poses[a], &poses[b]));
        for (i, node) in shapes[a].nodes_within(&now, outline) {
            let Some(met) = self.met(node, marks.faces[i], outline, &now, &now) else { continue };
            let is_end = outline.faces[met.face].normal[0] != 0.0;
            for (own, most) in shapes[b].nodes.iter().zip(on.iter_mut()).filter(|(own, _)| own.face == met.face) {
                let way = own.place_m - met.at_m;
                let aside_m = if is_end { way.y } else { way.x };
                if aside_m.abs() <= NEXT_M && way.z.abs() <= LEVEL_M && own.normal.dot(&met.normal) > 0.99 {
                    *most = most.max(marks.most[i]);
                }
            }
        }
    }
}

/// Where a node is within an outline, in its axes, and through which face it came in.
fn inside(node: &Node, face: u8, outline: &Outline, now: &View, before: &View) -> Option<(V3, usize)> {
    let at_m = now.place(&node.place_m);
    if !outline.holds(&at_m) {
        return None;
    }
    let entered = || outline.entered(&before.place(&node.place_m), &at_m);
    Some((at_m, if face == NO_FACE { entered() } else { usize::from(face) }))
}

fn add(push: &mut Push, force_n: V3, moment_n_m: V3, crushing_w: f64, rubbing_w: f64) {
    push.force_n += force_n;
    push.moment_n_m += moment_n_m;
    push.crushing_w += crushing_w;
    push.rubbing_w += rubbing_w;
}
