//! The ground: a cross-section along the X axis or along a road, or a grid of heights; with zones of friction.

mod disc;
mod footprint;
mod mesh;
mod road;
mod section;

pub use footprint::Footprint;
pub use mesh::Mesh;
pub use road::{Road, Station};

use crate::V3;
use libm::tan;
use section::Section;

/// The ground. Its heights are positive up.
#[derive(Clone, Debug, PartialEq)]
pub struct Ground {
    shape: Shape,
    zones: Vec<Zone>,
}

/// Faces that meet at edges.
#[derive(Clone, Debug, PartialEq)]
enum Shape {
    Section(Section),
    Mesh(Box<Mesh>),
}

/// A strip of ground with properties of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Zone {
    /// Its name.
    pub name: String,
    /// From and to, right of the X axis or of the road's line, m.
    pub right_m: [f64; 2],
    /// Factor on the friction of tyres.
    pub friction: f64,
    /// Further factor on lateral sliding: soil that furrows.
    pub lateral: f64,
    /// Rolling resistance over load, in place of the tyre's; none keeps the tyre's.
    pub rolling: Option<f64>,
}

/// A curb: a step up to the right along X.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curb {
    /// Foot of its face, right of the X axis, m.
    pub right_m: f64,
    /// Height, m; negative steps down.
    pub height_m: f64,
    /// Angle of its face to the level, rad; below π/2.
    pub face_rad: f64,
}

/// Problems of a ground.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GroundError {
    /// Too few corners.
    #[error("a cross-section of {0} corners; expected at least two")]
    TooFew(usize),
    /// Corners that do not rise to the right, or are not numbers.
    #[error("corner {number} of the cross-section lies at {right_m} m; expected a number above {before_m} m")]
    Order {
        /// Its number, counted from 1.
        number: usize,
        /// Its position, m.
        right_m: f64,
        /// Position of the one before, m.
        before_m: f64,
    },
    /// A curb that does not fit.
    #[error(
        "a curb of {height_m} m at {right_m} m with a face of {face_rad} rad; expected an angle above 0 and below π/2"
    )]
    Curb {
        /// Its foot, m.
        right_m: f64,
        /// Its height, m.
        height_m: f64,
        /// The angle of its face, rad.
        face_rad: f64,
    },
    /// Curbs on a ground that is no cross-section along the X axis.
    #[error("curbs need a cross-section along the x axis")]
    CurbsOnMesh,
    /// A grid without extent, or with heights that do not fill it.
    #[error("a grid of {rows} by {columns} heights with {heights} numbers; expected at least 2 by 2, and all of them")]
    Grid {
        /// Number of heights along X.
        rows: usize,
        /// Number of heights along Y.
        columns: usize,
        /// Number of heights given.
        heights: usize,
    },
    /// A distance between heights that is not above 0.
    #[error("a grid with {0} m between its heights; expected more than 0")]
    Spacing(f64),
    /// A road that cannot be laid out.
    #[error("{0}")]
    Road(String),
    /// A zone with a factor below zero or without breadth.
    #[error("zone `{0}` needs a friction and a lateral factor of at least 0, and an end right of its start")]
    Zone(String),
    /// A height or grade that is not a number.
    #[error("the heights and the grade of the ground must be numbers")]
    NotFinite,
}

impl Ground {
    /// A level plane at height 0.
    pub fn level() -> Self {
        Ground::of([[-1e4, 0.0], [1e4, 0.0]].into(), 0.0)
    }

    /// A plane through the origin: rise along X, and rise to the right.
    pub fn plane(grade: f64, cross_slope: f64) -> Self {
        Ground::of([[-1e4, -1e4 * cross_slope], [1e4, 1e4 * cross_slope]].into(), grade)
    }

    /// A cross-section of corners from left to right (right of the X axis, height; m), with a rise along X.
    ///
    /// # Errors
    /// Fewer than two corners, corners that do not go to the right, numbers that are not finite.
    pub fn section(corners_m: Vec<[f64; 2]>, grade: f64) -> Result<Self, GroundError> {
        if corners_m.len() < 2 {
            return Err(GroundError::TooFew(corners_m.len()));
        }
        if !grade.is_finite() || corners_m.iter().any(|[_, height]| !height.is_finite()) {
            return Err(GroundError::NotFinite);
        }
        for (i, pair) in corners_m.windows(2).enumerate() {
            let ([before_m, _], [right_m, _]) = (pair[0], pair[1]);
            if !(right_m > before_m && right_m.is_finite() && before_m.is_finite()) {
                return Err(GroundError::Order { number: i + 2, right_m, before_m });
            }
        }
        Ok(Ground::of(corners_m, grade))
    }

    /// Faces of a grid of heights or along a road.
    pub fn mesh(mesh: Mesh) -> Self {
        Ground { shape: Shape::Mesh(Box::new(mesh)), zones: Vec::new() }
    }

    fn of(corners_m: Vec<[f64; 2]>, grade: f64) -> Self {
        Ground { shape: Shape::Section(Section::of(corners_m, grade)), zones: Vec::new() }
    }

    /// This ground with curbs, each of which raises everything to its right.
    ///
    /// # Errors
    /// A face that is not between level and upright, or curbs whose faces overlap.
    pub fn with_curbs(&self, curbs: &[Curb]) -> Result<Self, GroundError> {
        if curbs.is_empty() {
            return Ok(self.clone());
        }
        let Shape::Section(section) = &self.shape else { return Err(GroundError::CurbsOnMesh) };
        let mut section = section.clone();
        for &Curb { right_m, height_m, face_rad } in curbs {
            let breadth_m = height_m.abs() / tan(face_rad);
            let upright = face_rad > 0.0 && face_rad < core::f64::consts::FRAC_PI_2;
            if !(upright && height_m.is_finite() && right_m.is_finite() && breadth_m > 0.0) {
                return Err(GroundError::Curb { right_m, height_m, face_rad });
            }
            let foot_m = [right_m, section.section_height_m(right_m)];
            let top_m = [right_m + breadth_m, section.section_height_m(right_m + breadth_m) + height_m];
            let left = section.corners_m.iter().copied().filter(|corner| corner[0] < right_m);
            let right = section.corners_m.iter().filter(|corner| corner[0] > top_m[0]);
            let lifted = right.map(|corner| [corner[0], corner[1] + height_m]);
            let mut corners_m: Vec<[f64; 2]> = left.chain([foot_m, top_m]).chain(lifted).collect();
            // the outer planes keep their slopes
            if corners_m[0] == foot_m {
                corners_m.insert(0, [right_m - 1.0, section.section_height_m(right_m - 1.0)]);
            }
            if corners_m[corners_m.len() - 1] == top_m {
                let beyond_m = top_m[0] + 1.0;
                corners_m.push([beyond_m, section.section_height_m(beyond_m) + height_m]);
            }
            let Shape::Section(raised) = Ground::section(corners_m, section.grade)?.shape else { break };
            section = raised;
        }
        Ok(Ground { shape: Shape::Section(section), zones: self.zones.clone() })
    }

    /// This ground with zones; of those that hold a point the last counts.
    ///
    /// # Errors
    /// A zone without breadth, or with a factor below zero.
    pub fn with_zones(mut self, zones: Vec<Zone>) -> Result<Self, GroundError> {
        let is_sound = |zone: &Zone| {
            let factors = [zone.friction, zone.lateral, zone.rolling.unwrap_or(0.0)];
            zone.right_m[0] < zone.right_m[1] && factors.iter().all(|x| *x >= 0.0 && x.is_finite())
        };
        if let Some(zone) = zones.iter().find(|zone| !is_sound(zone)) {
            return Err(GroundError::Zone(zone.name.clone()));
        }
        self.zones = zones;
        Ok(self)
    }

    /// Corners of the cross-section from left to right: right of the X axis and height at X = 0, m. The outer planes
    /// continue. None of a grid and of a road.
    pub fn corners_m(&self) -> &[[f64; 2]] {
        match &self.shape {
            Shape::Section(section) => &section.corners_m,
            Shape::Mesh(_) => &[],
        }
    }

    /// The faces of a grid or a road; none of a cross-section along the X axis.
    pub fn as_mesh(&self) -> Option<&Mesh> {
        match &self.shape {
            Shape::Section(_) => None,
            Shape::Mesh(mesh) => Some(mesh),
        }
    }

    /// Height at a place, m.
    pub fn height_m(&self, x_m: f64, y_m: f64) -> f64 {
        match &self.shape {
            Shape::Section(section) => section.height_m(x_m, y_m),
            Shape::Mesh(mesh) => mesh.height_m(x_m, y_m),
        }
    }

    /// Whether the heights at a place were given: it lies within the rim of a grid, or between the first and the last
    /// corner of a cross-section.
    pub fn is_given(&self, x_m: f64, y_m: f64) -> bool {
        match &self.shape {
            Shape::Section(section) => {
                let corners = &section.corners_m;
                (corners[0][0]..=corners[corners.len() - 1][0]).contains(&y_m)
            }
            Shape::Mesh(mesh) => mesh.is_given(x_m, y_m),
        }
    }

    /// Upward normal at a place, vehicle-space.
    pub fn normal(&self, x_m: f64, y_m: f64) -> V3 {
        self.face_normal(self.face_at(x_m, y_m))
    }

    /// Number of the face at a place.
    fn face_at(&self, x_m: f64, y_m: f64) -> usize {
        match &self.shape {
            Shape::Section(section) => section.plane_at(y_m),
            Shape::Mesh(mesh) => mesh.face_at(x_m, y_m),
        }
    }

    /// The face at a place in plan, as far as one step from another face leads.
    fn face_towards(&self, face: usize, at_m: [f64; 2]) -> usize {
        match &self.shape {
            Shape::Section(section) => section.plane_towards(face, at_m[1]),
            Shape::Mesh(mesh) => mesh.face_towards(face, at_m),
        }
    }

    /// Upward normal of a face, vehicle-space.
    #[inline]
    fn face_normal(&self, face: usize) -> V3 {
        match &self.shape {
            Shape::Section(section) => section.normals[face],
            Shape::Mesh(mesh) => mesh.normals[face],
        }
    }

    /// A point of a face, vehicle-space, m.
    #[inline]
    fn face_point_m(&self, face: usize) -> V3 {
        match &self.shape {
            Shape::Section(section) => section.point_m(face),
            Shape::Mesh(mesh) => mesh.point_m(face),
        }
    }

    /// The face at a place, if it extends by a distance to all sides.
    fn lone_face(&self, x_m: f64, y_m: f64, way_m: f64) -> Option<usize> {
        match &self.shape {
            Shape::Section(section) => section.lone_plane(y_m, way_m),
            Shape::Mesh(mesh) => mesh.lone_face(x_m, y_m, way_m),
        }
    }

    /// Where a straight way in plan, from `base_m` by `rate` per length, leaves a face, and the face beyond; none if it
    /// does not. `forward` is 1 ahead and −1 back.
    #[inline]
    fn exit(&self, face: usize, base_m: [f64; 2], rate: [f64; 2], forward: f64) -> Option<(f64, usize)> {
        match &self.shape {
            Shape::Section(section) => section.exit(face, base_m[1], rate[1], forward),
            Shape::Mesh(mesh) => mesh.exit(face, base_m, rate, forward),
        }
    }

    /// Normal and a point of the face at a place, if it extends by a distance to all sides.
    pub(crate) fn lone(&self, x_m: f64, y_m: f64, way_m: f64) -> Option<(V3, V3)> {
        let face = self.lone_face(x_m, y_m, way_m)?;
        Some((self.face_normal(face), self.face_point_m(face)))
    }

    /// Whether the edges of wheels meet some face steeper than 45°: of a cross-section along the X axis alone.
    pub(crate) fn has_steep(&self) -> bool {
        matches!(&self.shape, Shape::Section(section) if section.has_steep)
    }

    /// Distance of a point to the ground, m, negative below it, and the direction away from the ground, vehicle-space.
    /// Convex edges are rounded. From 1 m on the face below alone may tell it.
    pub fn distance(&self, point_m: &V3) -> (f64, V3) {
        self.distance_within(point_m, 1.0)
    }

    /// The same; of a mesh, what is further off than `within_m` may be given by the face below alone.
    pub(crate) fn distance_within(&self, point_m: &V3, within_m: f64) -> (f64, V3) {
        match &self.shape {
            Shape::Section(section) => section.distance(point_m),
            Shape::Mesh(mesh) => mesh.distance(point_m, within_m),
        }
    }

    /// Calls for each face beside an axle that a sphere penetrates: its number, depth, m, normal, and weight, from 0
    /// where the normal is at 53° to the axle to 1 at 37°.
    pub(crate) fn beside(&self, centre_m: &V3, radius_m: f64, axle: &V3, with: impl FnMut(usize, f64, V3, f64)) {
        if let Shape::Section(section) = &self.shape {
            section.beside(centre_m, radius_m, axle, with);
        }
    }

    /// The zone at a place.
    pub fn zone(&self, x_m: f64, y_m: f64) -> Option<&Zone> {
        if self.zones.is_empty() {
            return None;
        }
        let right_m = self.offset_m(x_m, y_m);
        self.zones.iter().rev().find(|zone| (zone.right_m[0]..=zone.right_m[1]).contains(&right_m))
    }

    /// All zones, in the order in which the last counts.
    pub fn zones(&self) -> &[Zone] {
        &self.zones
    }

    /// Distance of a place right of the X axis, or of the road's line, m.
    pub fn offset_m(&self, x_m: f64, y_m: f64) -> f64 {
        match &self.shape {
            Shape::Section(_) => y_m,
            Shape::Mesh(mesh) => mesh.offset_m(x_m, y_m),
        }
    }

    /// The line at a distance right of the X axis, or of the road's line, in plan: X and Y, m.
    pub fn line_at_m(&self, right_m: f64) -> Vec<[f64; 2]> {
        match &self.shape {
            Shape::Section(_) => vec![[-FAR_M, right_m], [FAR_M, right_m]],
            Shape::Mesh(mesh) => mesh.line_at_m(right_m),
        }
    }
}

/// How far the ground goes on, m.
const FAR_M: f64 = 1e4;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curb_lifts_what_lies_right_of_it() {
        let face_rad = 80f64.to_radians();
        let curbs = [Curb { right_m: 3.0, height_m: 0.15, face_rad }, Curb { right_m: 7.0, height_m: -0.1, face_rad }];
        let ground = Ground::plane(0.0, 0.02).with_curbs(&curbs).unwrap();
        for (right_m, height_m) in [(2.9, 0.058), (3.1, 0.212), (6.9, 0.288), (7.1, 0.192), (50.0, 1.05)] {
            assert!(
                (ground.height_m(0.0, right_m) - height_m).abs() < 1e-9,
                "{right_m}: {}",
                ground.height_m(0.0, right_m)
            );
        }
    }

    #[test]
    fn heights_beyond_the_rim_are_not_given() {
        let section = Ground::section(vec![[-2.0, 0.0], [3.0, 1.0]], 0.0).unwrap();
        let grid = Ground::mesh(Mesh::grid([-1.0, -2.0], [1.0, 5.0], [3, 2], &[0.0; 6]).unwrap());
        let stations = vec![Station { at_m: 0.0, corners_m: vec![[-2.0, 0.0], [3.0, 1.0]] }];
        let line_m = vec![[0.0, 0.0], [50.0, 0.0]];
        let road = Ground::mesh(Road { line_m, radius_m: 30.0, stations, grade: 0.0 }.mesh().unwrap());
        for (y_m, is_given) in [(-2.1, false), (-1.9, true), (2.9, true), (3.1, false)] {
            for ground in [&section, &grid, &road] {
                assert_eq!(ground.is_given(0.0, y_m), is_given, "{y_m}");
            }
        }
        // a grid ends ahead, too
        let ahead = [&section, &grid, &road].map(|ground| ground.is_given(1.5, 0.0));
        assert_eq!(ahead, [true, false, true]);
        assert!(Ground::level().is_given(0.0, 900.0));
    }

    #[test]
    fn mistakes_are_told_with_their_place() {
        let wrong = Ground::section(vec![[0.0, 0.0], [5.0, 1.0], [4.0, 0.0]], 0.0).unwrap_err();
        assert_eq!(wrong, GroundError::Order { number: 3, right_m: 4.0, before_m: 5.0 });
        assert_eq!(Ground::section(vec![[0.0, 0.0]], 0.0), Err(GroundError::TooFew(1)));
        assert_eq!(Ground::section(vec![[0.0, f64::NAN], [1.0, 0.0]], 0.0), Err(GroundError::NotFinite));
        let curb = Curb { right_m: 0.0, height_m: 0.1, face_rad: 2.0 };
        assert!(Ground::level().with_curbs(&[curb]).is_err());
        let zone = Zone { name: "ice".into(), right_m: [1.0, 0.0], friction: 0.1, lateral: 1.0, rolling: None };
        assert_eq!(Ground::level().with_zones(vec![zone]), Err(GroundError::Zone("ice".into())));
    }
}
