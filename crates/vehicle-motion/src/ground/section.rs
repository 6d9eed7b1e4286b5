//! A cross-section extruded along the X axis.

use crate::V3;

/// A cross-section extruded along the X axis, with a grade: planes that meet at corners.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Section {
    /// Corners from left to right: distance right of the X axis and height there at X = 0, m. The outer planes
    /// continue.
    pub corners_m: Vec<[f64; 2]>,
    /// Upward normals of the planes between them, vehicle-space.
    pub normals: Vec<V3>,
    /// Rise along X.
    pub grade: f64,
    /// Whether some plane is steeper than 45°.
    pub has_steep: bool,
}

impl Section {
    /// Planes between corners that rise to the right.
    pub fn of(corners_m: Vec<[f64; 2]>, grade: f64) -> Self {
        let normals = corners_m.windows(2).map(|pair| {
            let cross_slope = (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0]);
            V3::new(-grade, -cross_slope, -1.0).normalize()
        });
        let normals: Vec<V3> = normals.collect();
        let has_steep = normals.iter().any(|normal| normal.y.abs() > -normal.z);
        Section { normals, corners_m, grade, has_steep }
    }

    /// Number of the plane at a distance right of the X axis.
    pub fn plane_at(&self, right_m: f64) -> usize {
        let inner = &self.corners_m[1..self.corners_m.len() - 1];
        inner.partition_point(|corner| corner[0] <= right_m)
    }

    /// The next plane from one towards a distance right of the X axis; the same within its corners.
    pub fn plane_towards(&self, plane: usize, right_m: f64) -> usize {
        let last = self.normals.len() - 1;
        if plane > 0 && right_m < self.corners_m[plane][0] {
            plane - 1
        } else if plane < last && right_m > self.corners_m[plane + 1][0] {
            plane + 1
        } else {
            plane
        }
    }

    /// The plane at a distance right of the X axis, if it extends by a distance to both sides.
    pub fn lone_plane(&self, right_m: f64, way_m: f64) -> Option<usize> {
        let plane = self.plane_at(right_m);
        let last = self.normals.len() - 1;
        let is_alone = (plane == 0 || self.corners_m[plane][0] < right_m - way_m)
            && (plane == last || self.corners_m[plane + 1][0] > right_m + way_m);
        is_alone.then_some(plane)
    }

    /// A point of a plane, vehicle-space, m.
    pub fn point_m(&self, plane: usize) -> V3 {
        let [right_m, height_m] = self.corners_m[plane];
        V3::new(0.0, right_m, -height_m)
    }

    /// Height at a distance right of the X axis, and X = 0, m.
    pub fn section_height_m(&self, right_m: f64) -> f64 {
        let plane = self.plane_at(right_m);
        let [from_m, to_m] = [self.corners_m[plane], self.corners_m[plane + 1]];
        from_m[1] + (to_m[1] - from_m[1]) * (right_m - from_m[0]) / (to_m[0] - from_m[0])
    }

    /// Height at a place, m.
    pub fn height_m(&self, x_m: f64, y_m: f64) -> f64 {
        self.section_height_m(y_m) + self.grade * x_m
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
            let far = libm::hypot(off[0], off[1]);
            if far < least {
                (least, away) = (far, off);
            }
        }
        // the foot of the plane's own normal may lie beyond its corner
        if least == over_m { (over_m, normal) } else { (least, (V3::y() * away[0] + across * away[1]) / least) }
    }

    /// Calls for each face beside an axle that a sphere penetrates: its number, depth, m, normal, and weight, from 0
    /// where the normal is at 53° to the axle to 1 at 37°. The upper edge of a face is rounded.
    pub fn beside(&self, centre_m: &V3, radius_m: f64, axle: &V3, mut with: impl FnMut(usize, f64, V3, f64)) {
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
                let far_m = libm::hypot(off[0], off[1]);
                (radius_m - far_m, (V3::y() * off[0] + across * off[1]) / far_m.max(1e-12))
            } else {
                (radius_m - normal.dot(&(centre_m - self.point_m(piece))), normal)
            };
            if depth_m < 0.5 {
                with(piece, depth_m, normal, counts);
            }
        }
    }
    /// Where a way from `base_m` that gains `rate` right of the X axis per length leaves a plane, and the next plane;
    /// none if it does not.
    #[inline]
    pub fn exit(&self, plane: usize, base_m: f64, rate: f64, forward: f64) -> Option<(f64, usize)> {
        let goes_right = rate * forward > 0.0;
        let is_outer = plane == if goes_right { self.normals.len() - 1 } else { 0 };
        if is_outer || rate == 0.0 {
            return None;
        }
        let corner_m = self.corners_m[if goes_right { plane + 1 } else { plane }][0];
        Some(((corner_m - base_m) / rate, if goes_right { plane + 1 } else { plane - 1 }))
    }
}
