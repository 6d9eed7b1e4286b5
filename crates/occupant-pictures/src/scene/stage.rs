//! What stands in the picture: bodies, belts, bags, the car, other vehicles, the ground.

use nalgebra::{Isometry3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};
use occupant_core::forces::contact::flat_face::FlatFace;
use occupant_core::forces::contact::solid::{Shape, Solid};
use occupant_core::forces::contact::surface::{Frame, Outline};
use occupant_core::forces::shown::Section;
use occupant_core::model::Model;
use occupant_core::model::setup::GROUND;

use super::canvas::{Colour, MOST_GHOSTS, Paint, Piece, Veil};
use super::lens::V3;
use super::light::linear;
use super::shapes::{circle, cloth, farther, flat, placed, plane, polygons, ribbon, skull, wheel};
use super::sight::{meets, passes};
use crate::body::{Lump, Part, Snapshot, Tone, parts};
use crate::mesh::{FINE, Mesh, hull};

/// Room beside a line of sight within which a bar is in the way, m.
const BESIDE_M: f64 = 0.12;
/// Radius from which a surface in space is ground, m.
const WIDE_M: f64 = 2.0;
/// Corners from which a polygon of a vehicle's outside is a wheel.
const ROUND: usize = 12;
/// Depth of the drawn ground below the lowest thing where a model has none, m.
const BELOW_M: f64 = 0.02;
/// Largest difference of heights of a level ground, m.
const LEVEL_M: f64 = 1e-3;

const SKIN: Colour = [0.86, 0.67, 0.55];
const TROUSERS: Colour = [0.27, 0.30, 0.38];
/// Shirts of the people in their order.
pub(super) const SHIRTS: [Colour; 6] = [
    [0.20, 0.44, 0.72],
    [0.80, 0.42, 0.16],
    [0.30, 0.58, 0.34],
    [0.62, 0.34, 0.62],
    [0.75, 0.62, 0.20],
    [0.25, 0.60, 0.62],
];
/// Tints of other runs in their order, told apart by people who confuse red and green too.
pub(super) const TINTS: [Colour; MOST_GHOSTS] = [[0.85, 0.20, 0.55], [0.95, 0.68, 0.10], [0.10, 0.62, 0.50]];
/// Share of the tint in the colour of a ghost's thing.
const TINTED: f32 = 0.75;
/// Distance within which corners of two runs' things are the same, m.
const SAME_M: f64 = 1e-3;
const WEBBING: Colour = [0.78, 0.16, 0.12];
const SLACK: Colour = [0.45, 0.45, 0.47];
const SEAT: Colour = [0.50, 0.52, 0.56];
const FLOOR: Colour = [0.60, 0.61, 0.62];
const METAL: Colour = [0.30, 0.32, 0.35];
const EDGE: Colour = [0.24, 0.27, 0.31];
const GLASS: Colour = [0.55, 0.68, 0.78];
const OUTSIDE: Colour = [0.25, 0.36, 0.50];
const ASPHALT: Colour = [0.66, 0.66, 0.65];
const MARKS: Colour = [0.20, 0.20, 0.20];

/// What to draw of a moment, relative to an origin in space.
#[derive(Default)]
pub(super) struct Stage {
    pub(super) pieces: Vec<Piece>,
    /// Which pieces throw shadows: whole ones, and faint ones that are not drawn themselves.
    pub(super) shades: Vec<usize>,
    pub(super) faint: Vec<Piece>,
    pub(super) veils: Vec<Veil>,
}

/// What does not change from moment to moment.
pub(super) struct Cast<'a> {
    pub(super) model: &'a Model,
    parts: Vec<(Part, Mesh)>,
    /// Height of the ground that is drawn where the model has none, m.
    reference_m: Option<f64>,
    /// Solids between the eye and people, by index.
    hiding: Vec<bool>,
}

impl<'a> Cast<'a> {
    pub(super) fn of(model: &'a Model, first: Option<&Snapshot>) -> Self {
        let rounded = |part: Part| {
            let ends = if part.tone == Tone::Skin { skull(&part.ends) } else { part.ends };
            (part, hull(&ends, FINE))
        };
        let parts = parts(model.body()).into_iter().map(rounded).collect();
        let mut cast = Cast { model, parts, reference_m: None, hiding: Vec::new() };
        if !cast.has_ground() {
            cast.reference_m = first.map(|moment| cast.lowest_m(moment) - BELOW_M).filter(|z| z.is_finite());
        }
        cast
    }

    /// Finds which solids hide people from an eye, in some moments: they are drawn by their edges.
    pub(super) fn look_from(&mut self, sights: &[(Point3<f64>, &Snapshot)]) {
        let hides = |solid: &Solid| {
            sights.iter().any(|(eye, moment)| {
                let ends: Vec<_> = moment.spheres_m.iter().map(|at| in_space(moment, at)).collect();
                match &solid.shape {
                    Shape::Capsule { ends_m, radius_m } => {
                        let bar: Vec<_> =
                            moment.placed_m(solid.frame, ends_m).iter().map(|p| in_space(moment, p)).collect();
                        ends.iter().any(|end| passes(eye, end, [bar[0], bar[1]]) < radius_m + BESIDE_M)
                    }
                    Shape::Rim { .. } | Shape::HalfSpace { .. } => false,
                    _ => moment.solid_m(solid).iter().any(|side| {
                        let side: Vec<_> = side.iter().map(|p| in_space(moment, p)).collect();
                        ends.iter().any(|end| meets(eye, end, &side))
                    }),
                }
            })
        };
        let is_small = |solid: &Solid| solid.name.contains("wheel");
        self.hiding = self.model.setup().solids.iter().map(|solid| !is_small(solid) && hides(solid)).collect();
    }

    /// Whether the ground that is drawn is only a picture's.
    pub(super) fn has_ground(&self) -> bool {
        let setup = self.model.setup();
        let is_road = setup.scenery.iter().any(|own| own.name == "road" && !own.polygons_m.is_empty());
        let is_half =
            |s: &Solid| s.frame == Frame::Space && matches!(s.shape, Shape::HalfSpace { normal, .. } if normal.z > 0.5);
        is_road || self.model.faces().iter().any(|face| self.is_ground(face)) || setup.solids.iter().any(is_half)
    }

    /// Whether a surface is ground: level or a slope in space, without end or wider than a room.
    fn is_ground(&self, face: &FlatFace) -> bool {
        let is_wide = match &face.outline {
            Outline::Unbounded { .. } => true,
            Outline::Disc { radius_m, .. } => *radius_m > WIDE_M,
            Outline::Polygon(corners) => corners.iter().any(|p| (p - corners[0]).norm() > 2.0 * WIDE_M),
        };
        let is_still = match face.frame {
            Frame::Space => true,
            Frame::Other(i) => self.model.setup().frames.get(i).is_some_and(|frame| frame.name == GROUND),
            Frame::Vehicle | Frame::Segment(_) => false,
        };
        is_still && is_wide && face.normal.z.abs() > 0.5
    }

    fn lowest_m(&self, moment: &Snapshot) -> f64 {
        let body = self.model.body();
        let spheres =
            body.spheres.iter().zip(&moment.spheres_m).map(|(sphere, at)| in_space(moment, at).z - sphere.radius_m);
        let bounded = |(i, _): &(usize, _)| !matches!(self.model.faces()[*i].outline, Outline::Unbounded { .. });
        let faces = self.model.faces().iter().enumerate().filter(bounded).flat_map(|(_, face)| moment.corners_m(face));
        let solids = self.model.setup().solids.iter().filter(|s| s.frame == Frame::Vehicle);
        let solids = solids.filter(|s| !matches!(s.shape, Shape::HalfSpace { .. })).flat_map(|s| s.outline().concat());
        spheres.chain(faces.chain(solids).map(|p| in_space(moment, &p).z)).fold(f64::INFINITY, f64::min)
    }

    /// Everything at a moment.
    pub(super) fn stage(
        &self,
        moment: &Snapshot,
        origin: &Vector3<f64>,
        eye: &Point3<f64>,
        hidden: Option<usize>,
    ) -> Stage {
        let mut stage = Stage::default();
        let at = |p: &Point3<f64>| -> V3 { (in_space(moment, p).coords - origin).cast() };
        self.ground(&mut stage, moment, origin);
        self.compartment(&mut stage, moment, origin, eye);
        self.outsides(&mut stage, moment, &at);
        self.people(&mut stage, moment, origin, hidden);
        self.belts(&mut stage, moment, &at);
        bags(&mut stage, moment.sections.iter(), &at);
        stage
    }

    /// People, belts, bags, wheels and tyre marks of another run in one tint, and the edges of what is not where the
    /// pictured run has the same.
    pub(super) fn apparition(
        &self,
        moment: &Snapshot,
        origin: &Vector3<f64>,
        hidden: Option<usize>,
        tint: Colour,
        known: &[Edge],
    ) -> Stage {
        let mut stage = Stage::default();
        let at = |p: &Point3<f64>| -> V3 { (in_space(moment, p).coords - origin).cast() };
        self.people(&mut stage, moment, origin, hidden);
        self.belts(&mut stage, moment, &at);
        let is_other = |section: &&Section| !known.iter().any(|own| Edge::of_section(moment, section).is_at(own));
        bags(&mut stage, moment.sections.iter().filter(is_other), &at);
        stage.pieces.extend(self.marks(origin));
        for edge in self.edges(moment).iter().filter(|edge| !known.iter().any(|own| edge.is_at(own))) {
            let place = |p: &Point3<f64>| -> V3 { (p.coords - origin).cast() };
            let corners: Vec<V3> = edge.corners_m.iter().map(place).collect();
            match edge.of {
                Of::Wheel => stage.pieces.push(wheel(&edge.corners_m, &place)),
                Of::Outside => {
                    stage.outline(&corners, linear(OUTSIDE), 0.75, 1.6);
                    stage.veils.push(Veil::Sheet { corners, colour: linear(OUTSIDE), opacity: 0.10 });
                }
                Of::Inside => stage.outline(&corners, linear(EDGE), 0.35, 1.3),
            }
        }
        stage.tint(linear(tint));
        stage
    }

    /// What has edges at a moment, in space: surfaces, solids, outsides and barriers.
    pub(super) fn edges(&self, moment: &Snapshot) -> Vec<Edge> {
        let setup = self.model.setup();
        let is_part = |face: &&FlatFace| !self.is_ground(face) && !matches!(face.outline, Outline::Unbounded { .. });
        let faces = self.model.faces().iter().filter(is_part).map(|face| (moment.corners_m(face), Of::Inside));
        let solids = setup.solids.iter().flat_map(|solid| sides(moment, solid)).map(|side| (side, Of::Inside));
        let is_outer = |name: &str| name.ends_with("outside") || name.starts_with("barrier");
        let outer = setup.scenery.iter().filter(|own| is_outer(&own.name)).flat_map(|own| {
            let kind = |polygon: &Vec<_>| if polygon.len() < ROUND { Of::Outside } else { Of::Wheel };
            own.polygons_m.iter().map(move |polygon| (moment.placed_m(own.frame, polygon), kind(polygon)))
        });
        let placed = |(side, of): (Vec<Point3<f64>>, Of)| Edge {
            corners_m: side.iter().map(|p| in_space(moment, p)).collect(),
            of,
        };
        faces.chain(solids).chain(outer).map(placed).collect()
    }

    /// Tyre marks, over the ground that they are on.
    fn marks(&self, origin: &Vector3<f64>) -> impl Iterator<Item = Piece> {
        let marks = self.model.setup().scenery.iter().filter(|own| own.name.ends_with("marks"));
        marks.map(|own| Piece { before_m: 0.03, ..polygons(&own.polygons_m, origin, Paint::Matt(linear(MARKS))) })
    }

    fn people(&self, stage: &mut Stage, moment: &Snapshot, origin: &Vector3<f64>, hidden: Option<usize>) {
        let body = self.model.body();
        let vehicle = frame_pose(moment);
        for (part, mesh) in &self.parts {
            if hidden == Some(part.segment.index()) {
                continue;
            }
            let pose = vehicle * moment.poses[part.segment.index()];
            let colour = match part.tone {
                Tone::Skin => SKIN,
                Tone::Shirt => SHIRTS[body.tree.body_of(part.segment) % SHIRTS.len()],
                Tone::Trousers => TROUSERS,
            };
            stage.shades.push(stage.pieces.len());
            stage.pieces.push(placed(mesh, &pose, origin, Paint::Matt(linear(colour))));
        }
    }

    fn belts(&self, stage: &mut Stage, moment: &Snapshot, at: &dyn Fn(&Point3<f64>) -> V3) {
        let middles: Vec<V3> = self
            .parts
            .iter()
            .filter(|(p, _)| self.model.body().tree.is_trunk(p.segment))
            .map(|(p, _)| at(&moment.poses[p.segment.index()].translation.vector.into()))
            .collect();
        for line in &moment.lines {
            let points: Vec<V3> = line.points_m.iter().map(at).collect();
            let colour = if line.force_n > 0.0 { WEBBING } else { SLACK };
            if let Some(mut piece) = ribbon(&points, &middles) {
                piece.paint = Paint::Matt(linear(colour));
                stage.shades.push(stage.pieces.len());
                stage.pieces.push(piece);
            }
        }
    }

    fn ground(&self, stage: &mut Stage, moment: &Snapshot, origin: &Vector3<f64>) {
        let setup = self.model.setup();
        let paint = Paint::Grid(linear(ASPHALT));
        let about = moment.vehicle.origin_m;
        if let Some(road) = setup.scenery.iter().find(|own| own.name == "road") {
            let heights = road.polygons_m.iter().flatten().map(|p| p.z);
            let [low, high] = heights.fold([f64::MAX, f64::MIN], |[l, h], z| [l.min(z), h.max(z)]);
            if high - low < LEVEL_M {
                stage.pieces.push(plane(&Vector3::z(), low, &about, origin, paint));
            } else {
                stage.pieces.push(polygons(&farther(&road.polygons_m), origin, paint));
            }
        }
        for face in self.model.faces().iter().filter(|face| self.is_ground(face)) {
            let corners: Vec<_> = moment.corners_m(face).iter().map(|p| in_space(moment, p)).collect();
            let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0])).normalize();
            stage.pieces.push(plane(&normal, normal.dot(&corners[0].coords), &about, origin, paint));
        }
        for solid in setup.solids.iter().filter(|s| s.frame == Frame::Space) {
            if let Shape::HalfSpace { point_m, normal } = &solid.shape
                && normal.z > 0.5
            {
                let normal = normal.normalize();
                stage.pieces.push(plane(&normal, normal.dot(&point_m.coords), &about, origin, paint));
            }
        }
        if let Some(height) = self.reference_m {
            stage.pieces.push(plane(&Vector3::z(), height, &about, origin, paint));
        }
        stage.pieces.extend(self.marks(origin));
        for own in setup.scenery.iter().filter(|own| own.name.starts_with("barrier")) {
            stage.shades.push(stage.pieces.len());
            stage.pieces.push(polygons(&own.polygons_m, origin, Paint::Matt(linear([0.62, 0.64, 0.66]))));
        }
    }

    /// Surfaces and solids: whole where their open side faces the eye, else faint, so that nobody is hidden.
    fn compartment(&self, stage: &mut Stage, moment: &Snapshot, origin: &Vector3<f64>, eye: &Point3<f64>) {
        let setup = self.model.setup();
        for (surface, face) in setup.surfaces.iter().zip(self.model.faces()) {
            if self.is_ground(face) || matches!(face.outline, Outline::Unbounded { .. }) && face.frame != Frame::Vehicle
            {
                continue;
            }
            let corners: Vec<_> = moment.corners_m(face).iter().map(|p| in_space(moment, p)).collect();
            if corners.len() > 2 {
                let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
                let open = normal.dot(&(eye - corners[0])) > 0.0;
                stage.panel(&corners, origin, open, is_soft(&surface.name), is_floor(&surface.name));
            }
        }
        let solids = setup.solids.iter().zip(self.hiding.iter().copied().chain(std::iter::repeat(false)));
        for (solid, hides) in solids.filter(|(s, _)| !matches!(s.shape, Shape::HalfSpace { .. })) {
            if hides {
                self.ghost(stage, moment, origin, solid);
                continue;
            }
            if self.round(stage, moment, origin, solid) {
                continue;
            }
            for side in moment.solid_m(solid) {
                let corners: Vec<_> = side.iter().map(|p| in_space(moment, p)).collect();
                if corners.len() < 3 {
                    continue;
                }
                let whole = is_soft(&solid.name) || is_floor(&solid.name) || solid.frame != Frame::Vehicle;
                let is_wheel = solid.name.contains("wheel");
                let colour = if is_soft(&solid.name) {
                    SEAT
                } else if is_wheel {
                    METAL
                } else if whole {
                    FLOOR
                } else {
                    GLASS
                };
                // of a round plate, the rims alone
                let edged = matches!(solid.shape, Shape::Disc { .. }) == (corners.len() >= ROUND);
                stage.block(&corners, origin, whole || is_wheel, colour, edged);
            }
        }
    }

    /// The edges of a solid that would hide people.
    fn ghost(&self, stage: &mut Stage, moment: &Snapshot, origin: &Vector3<f64>, solid: &Solid) {
        let place = |p: &Point3<f64>| -> V3 { (in_space(moment, p).coords - origin).cast() };
        if let Shape::Capsule { ends_m, .. } = &solid.shape {
            let ends = moment.placed_m(solid.frame, ends_m);
            let ends = [place(&ends[0]), place(&ends[1])];
            return stage.veils.push(Veil::Line { ends, colour: linear(EDGE), opacity: 0.35, pixels: 3.0 });
        }
        for side in moment.solid_m(solid) {
            let corners: Vec<V3> = side.iter().map(place).collect();
            if corners.len() < ROUND {
                stage.outline(&corners, linear(EDGE), 0.22, 1.0);
            }
        }
    }

    /// A bar or a rim, whole; whether it is one.
    fn round(&self, stage: &mut Stage, moment: &Snapshot, origin: &Vector3<f64>, solid: &Solid) -> bool {
        let (points, radius_m) = match &solid.shape {
            Shape::Capsule { ends_m, radius_m } => (ends_m.to_vec(), *radius_m),
            Shape::Rim { centre_m, axis, ring_radius_m, tube_radius_m } => {
                (circle(centre_m, axis, *ring_radius_m), *tube_radius_m)
            }
            _ => return false,
        };
        let points: Vec<_> = moment.placed_m(solid.frame, &points).iter().map(|p| in_space(moment, p)).collect();
        let paint = Paint::Matt(linear(if is_soft(&solid.name) { SEAT } else { METAL }));
        for pair in points.windows(2) {
            let ends = [0, 1].map(|i| Lump { centre_m: pair[i].coords - origin, half_m: Vector3::repeat(radius_m) });
            stage.shades.push(stage.pieces.len());
            let mesh = hull(&ends, if points.len() > 2 { [12, 7] } else { FINE });
            stage.pieces.push(placed(&mesh, &Isometry3::identity(), &Vector3::zeros(), paint));
        }
        true
    }

    fn outsides(&self, stage: &mut Stage, moment: &Snapshot, at: &dyn Fn(&Point3<f64>) -> V3) {
        for own in self.model.setup().scenery.iter().filter(|own| own.name.ends_with("outside")) {
            for polygon in &own.polygons_m {
                let placed = moment.placed_m(own.frame, polygon);
                if polygon.len() >= ROUND {
                    let wheel = wheel(&placed, at);
                    stage.shades.push(stage.pieces.len());
                    stage.pieces.push(wheel);
                    continue;
                }
                let corners: Vec<V3> = placed.iter().map(at).collect();
                stage.outline(&corners, linear(OUTSIDE), 0.75, 1.6);
                stage.faint.push(flat(&corners, Paint::None));
                stage.veils.push(Veil::Sheet { corners, colour: linear(OUTSIDE), opacity: 0.10 });
            }
        }
    }
}

/// A polygon, or the ends of a bar, in space.
pub(super) struct Edge {
    corners_m: Vec<Point3<f64>>,
    of: Of,
}

/// What an edge belongs to.
#[derive(Clone, Copy)]
enum Of {
    Inside,
    Outside,
    Wheel,
}

impl Edge {
    /// The edge of a bag's section.
    pub(super) fn of_section(moment: &Snapshot, section: &Section) -> Self {
        Edge { corners_m: section.corners_m.iter().map(|p| in_space(moment, p)).collect(), of: Of::Inside }
    }

    fn is_at(&self, other: &Edge) -> bool {
        let mut pairs = self.corners_m.iter().zip(&other.corners_m);
        self.corners_m.len() == other.corners_m.len() && pairs.all(|(a, b)| (a - b).norm() < SAME_M)
    }
}

/// The sides of a solid whose edges are drawn, of a bar and a rim the middle line.
fn sides(moment: &Snapshot, solid: &Solid) -> Vec<Vec<Point3<f64>>> {
    match &solid.shape {
        Shape::HalfSpace { .. } => Vec::new(),
        Shape::Capsule { ends_m, .. } => vec![moment.placed_m(solid.frame, ends_m)],
        Shape::Rim { centre_m, axis, ring_radius_m, .. } => {
            vec![moment.placed_m(solid.frame, &circle(centre_m, axis, *ring_radius_m))]
        }
        // of a round plate, the rims alone
        Shape::Disc { .. } => moment.solid_m(solid).into_iter().filter(|side| side.len() >= ROUND).collect(),
        _ => moment.solid_m(solid).into_iter().filter(|side| side.len() < ROUND).collect(),
    }
}

impl Stage {
    /// Gives everything a tint.
    fn tint(&mut self, tint: Colour) {
        let tinted = |own: Colour| [0, 1, 2].map(|c| own[c] + TINTED * (tint[c] - own[c]));
        for piece in &mut self.pieces {
            if let Paint::Matt(colour) = &mut piece.paint {
                *colour = tinted(*colour);
            }
        }
        for veil in &mut self.veils {
            let (Veil::Sheet { colour, .. } | Veil::Line { colour, .. }) = veil;
            *colour = tinted(*colour);
        }
    }

    fn outline(&mut self, corners: &[V3], colour: Colour, opacity: f32, pixels: f32) {
        for (i, from) in corners.iter().enumerate() {
            let ends = [*from, corners[(i + 1) % corners.len()]];
            self.veils.push(Veil::Line { ends, colour, opacity, pixels });
        }
    }

    /// A plane part of the compartment.
    fn panel(&mut self, corners: &[Point3<f64>], origin: &Vector3<f64>, open: bool, soft: bool, floor: bool) {
        let corners: Vec<V3> = corners.iter().map(|p| (p.coords - origin).cast()).collect();
        let colour = linear(if soft {
            SEAT
        } else if floor {
            FLOOR
        } else {
            GLASS
        });
        self.outline(&corners, linear(EDGE), if open { 0.8 } else { 0.35 }, 1.3);
        if open && (soft || floor) {
            self.shades.push(self.pieces.len());
            self.pieces.push(flat(&corners, Paint::Matt(colour)));
        } else {
            let opacity = if open { 0.22 } else { 0.03 };
            self.veils.push(Veil::Sheet { corners, colour, opacity });
        }
    }

    /// A side of a solid.
    fn block(&mut self, corners: &[Point3<f64>], origin: &Vector3<f64>, whole: bool, colour: Colour, edged: bool) {
        let corners: Vec<V3> = corners.iter().map(|p| (p.coords - origin).cast()).collect();
        let colour = linear(colour);
        if edged {
            self.outline(&corners, linear(EDGE), 0.45, 1.1);
        }
        if whole {
            self.shades.push(self.pieces.len());
            self.pieces.push(flat(&corners, Paint::Matt(colour)));
        } else {
            self.veils.push(Veil::Sheet { corners, colour, opacity: 0.12 });
        }
    }
}

/// Whether a part of a car is upholstery, which stands behind and below people.
fn is_soft(name: &str) -> bool {
    ["seat", "cushion", "restraint", "back", "booster", "bench", "foam", "pan", "ramp"]
        .iter()
        .any(|word| name.contains(word))
        && !name.contains("panel")
}

/// Whether a part of a car is below the feet.
fn is_floor(name: &str) -> bool {
    name.contains("floor") || name.contains("toe")
}

/// A point of the vehicle's axes in space.
pub(super) fn in_space(moment: &Snapshot, p: &Point3<f64>) -> Point3<f64> {
    moment.vehicle.point_to_space(p.coords).into()
}

/// The vehicle's axes in space.
pub(super) fn frame_pose(moment: &Snapshot) -> Isometry3<f64> {
    let turned = Rotation3::from_matrix_unchecked(moment.vehicle.rotation);
    Isometry3::from_parts(Translation3::from(moment.vehicle.origin_m), UnitQuaternion::from_rotation_matrix(&turned))
}

/// Bags as cloth round all that their sections reach.
fn bags<'m>(stage: &mut Stage, sections: impl Iterator<Item = &'m Section>, at: &dyn Fn(&Point3<f64>) -> V3) {
    let mut cloths: Vec<(&str, Vec<V3>)> = Vec::new();
    for section in sections {
        let points = section.corners_m.iter().map(at).filter(|p| p.sum().is_finite());
        match cloths.iter_mut().find(|(name, _)| *name == section.name) {
            Some((_, known)) => known.extend(points),
            None => cloths.push((&section.name, points.collect())),
        }
    }
    stage.veils.extend(cloths.iter().flat_map(|(_, points)| cloth(points)));
}
