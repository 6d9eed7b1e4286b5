//! The ground: a cross-section that runs along the X axis, with a grade, curbs, and zones of friction.

mod disc;
mod footprint;

pub use footprint::Footprint;

use crate::V3;
use libm::tan;

/// A cross-section extruded along the X axis, with a grade: planes that meet at corners.
#[derive(Clone, Debug, PartialEq)]
pub struct Ground {
    /// Corners from left to right: distance right of the X axis and height there at X = 0, m. The outer planes
    /// continue.
    corners_m: Vec<[f64; 2]>,
    /// Upward normals of the planes between them, vehicle-space.
    normals: Vec<V3>,
    /// Rise along X.
    grade: f64,
    has_steep: bool,
    zones: Vec<Zone>,
}

/// A strip of ground with properties of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Zone {
    /// Its name.
    pub name: String,
    /// From and to, right of the X axis, m.
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

    /// This ground with curbs, each of which raises everything to its right.
    ///
    /// # Errors
    /// A face that is not between level and upright, or curbs whose faces overlap.
    pub fn with_curbs(&self, curbs: &[Curb]) -> Result<Self, GroundError> {
        let mut ground = self.clone();
        for &Curb { right_m, height_m, face_rad } in curbs {
            let breadth_m = height_m.abs() / tan(face_rad);
            let upright = face_rad > 0.0 && face_rad < core::f64::consts::FRAC_PI_2;
            if !(upright && height_m.is_finite() && right_m.is_finite() && breadth_m > 0.0) {
                return Err(GroundError::Curb { right_m, height_m, face_rad });
            }
            let foot_m = [right_m, ground.section_height_m(right_m)];
            let top_m = [right_m + breadth_m, ground.section_height_m(right_m + breadth_m) + height_m];
            let left = ground.corners_m.iter().copied().filter(|corner| corner[0] < right_m);
            let right = ground.corners_m.iter().filter(|corner| corner[0] > top_m[0]);
            let lifted = right.map(|corner| [corner[0], corner[1] + height_m]);
            let mut corners_m: Vec<[f64; 2]> = left.chain([foot_m, top_m]).chain(lifted).collect();
            // the outer planes keep their slopes
            if corners_m[0] == foot_m {
                corners_m.insert(0, [right_m - 1.0, ground.section_height_m(right_m - 1.0)]);
            }
            if corners_m[corners_m.len() - 1] == top_m {
                let beyond_m = top_m[0] + 1.0;
                corners_m.push([beyond_m, ground.section_height_m(beyond_m) + height_m]);
            }
            ground = Ground { zones: ground.zones, ..Ground::section(corners_m, ground.grade)? };
        }
        Ok(ground)
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

    fn of(corners_m: Vec<[f64; 2]>, grade: f64) -> Self {
        let normals = corners_m.windows(2).map(|pair| {
            let cross_slope = (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0]);
            V3::new(-grade, -cross_slope, -1.0).normalize()
        });
        let normals: Vec<V3> = normals.collect();
        let has_steep = normals.iter().any(|normal| normal.y.abs() > -normal.z);
        Ground { normals, corners_m, grade, has_steep, zones: Vec::new() }
    }

    /// Number of the plane at a distance right of the X axis.
    fn plane_at(&self, right_m: f64) -> usize {
        let inner = &self.corners_m[1..self.corners_m.len() - 1];
        inner.partition_point(|corner| corner[0] <= right_m)
    }

    /// The plane at a distance right of the X axis, if it extends by a distance to both sides.
    pub(crate) fn lone_plane(&self, right_m: f64, way_m: f64) -> Option<usize> {
        let plane = self.plane_at(right_m);
        let last = self.normals.len() - 1;
        let is_alone = (plane == 0 || self.corners_m[plane][0] < right_m - way_m)
            && (plane == last || self.corners_m[plane + 1][0] > right_m + way_m);
        is_alone.then_some(plane)
    }

    /// A point of a plane, vehicle-space, m.
    fn point_m(&self, plane: usize) -> V3 {
        let [right_m, height_m] = self.corners_m[plane];
        V3::new(0.0, right_m, -height_m)
    }

    fn section_height_m(&self, right_m: f64) -> f64 {
        let plane = self.plane_at(right_m);
        let [from_m, to_m] = [self.corners_m[plane], self.corners_m[plane + 1]];
        from_m[1] + (to_m[1] - from_m[1]) * (right_m - from_m[0]) / (to_m[0] - from_m[0])
    }

    /// Corners of the cross-section from left to right: right of the X axis and height at X = 0, m. The outer planes
    /// continue.
    pub fn corners_m(&self) -> &[[f64; 2]] {
        &self.corners_m
    }

    /// Height at a place, m.
    pub fn height_m(&self, x_m: f64, y_m: f64) -> f64 {
        self.section_height_m(y_m) + self.grade * x_m
    }

    /// Upward normal at a distance right of the X axis, vehicle-space.
    pub fn normal(&self, right_m: f64) -> V3 {
        self.normals[self.plane_at(right_m)]
    }

    /// Normal and a point of the plane at a distance right of the X axis, if it continues to both sides.
    pub(crate) fn lone(&self, right_m: f64, way_m: f64) -> Option<(V3, V3)> {
        self.lone_plane(right_m, way_m).map(|plane| (self.normals[plane], self.point_m(plane)))
    }

    /// Whether some face is steeper than 45°.
    pub(crate) fn has_steep(&self) -> bool {
        self.has_steep
    }

    /// Pieces within `far_m` of a distance right of the X axis.
    fn pieces(&self, right_m: f64, far_m: f64) -> core::ops::RangeInclusive<usize> {
        self.plane_at(right_m - far_m)..=self.plane_at(right_m + far_m)
    }

    /// A piece seen along the extrusion: its ends, right and down across the grade, m.
    fn seen(&self, piece: usize) -> [[f64; 2]; 2] {
        let slant = (1.0 + self.grade * self.grade).sqrt();
        [0, 1].map(|j| {
            let [right_m, height_m] = self.corners_m[piece + j];
            [right_m, -height_m / slant]
        })
    }

    /// Distance of a point to the ground, m, negative below it, and the direction away from the ground, vehicle-space.
    /// Convex corners are rounded.
    pub fn distance(&self, point_m: &V3) -> (f64, V3) {
        let plane = self.plane_at(point_m.y);
        let normal = self.normals[plane];
        let over_m = normal.dot(&(point_m - self.point_m(plane)));
        if over_m <= 0.0 || over_m > 1.0 {
            return (over_m, normal);
        }
        let slant = (1.0 + self.grade * self.grade).sqrt();
        let across = V3::new(self.grade / slant, 0.0, 1.0 / slant);
        let (right_m, down_m) = (point_m.y, point_m.dot(&across));
        let (mut least, mut away) = (over_m, [0.0; 2]);
        let last = self.normals.len() - 1;
        for piece in self.pieces(right_m, over_m).filter(|piece| *piece != plane || last == 0) {
            let [from, to] = self.seen(piece);
            let way = [to[0] - from[0], to[1] - from[1]];
            let to_point = [right_m - from[0], down_m - from[1]];
            let share = (to_point[0] * way[0] + to_point[1] * way[1]) / (way[0] * way[0] + way[1] * way[1]);
            let share = share.clamp(0.0, 1.0);
            let off = [to_point[0] - share * way[0], to_point[1] - share * way[1]];
            let far = off[0].hypot(off[1]);
            if far < least {
                (least, away) = (far, off);
            }
        }
        // the foot of the plane's own normal may lie beyond its corner
        if least == over_m { (over_m, normal) } else { (least, (V3::y() * away[0] + across * away[1]) / least) }
    }

    /// Calls for each face beside an axle that a sphere penetrates: its number, depth, m, normal, and weight, from 0
    /// where the normal is at 53° to the axle to 1 at 37°. The upper edge of a face is rounded.
    pub(crate) fn beside(&self, centre_m: &V3, radius_m: f64, axle: &V3, mut with: impl FnMut(usize, f64, V3, f64)) {
        let slant = (1.0 + self.grade * self.grade).sqrt();
        let across = V3::new(self.grade / slant, 0.0, 1.0 / slant);
        let point = [centre_m.y, centre_m.dot(&across)];
        for piece in self.pieces(centre_m.y, 0.5) {
            let normal = self.normals[piece];
            let counts = ((normal.dot(axle).abs() - 0.6) / 0.2).clamp(0.0, 1.0);
            if counts == 0.0 {
                continue;
            }
            let [from, to] = self.seen(piece);
            let (top, foot) = if from[1] < to[1] { (from, to) } else { (to, from) };
            let up = [top[0] - foot[0], top[1] - foot[1]];
            let off = [point[0] - top[0], point[1] - top[1]];
            let (depth_m, normal) = if off[0] * up[0] + off[1] * up[1] > 0.0 {
                let far_m = off[0].hypot(off[1]);
                (radius_m - far_m, (V3::y() * off[0] + across * off[1]) / far_m.max(1e-12))
            } else {
                (radius_m - normal.dot(&(centre_m - self.point_m(piece))), normal)
            };
            if depth_m < 0.5 {
                with(piece, depth_m, normal, counts);
            }
        }
    }

    /// The zone at a distance right of the X axis.
    pub fn zone(&self, right_m: f64) -> Option<&Zone> {
        self.zones.iter().rev().find(|zone| (zone.right_m[0]..=zone.right_m[1]).contains(&right_m))
    }
}

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
