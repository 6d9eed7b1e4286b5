//! The lens: where it stands, where it looks, and what of space falls on which pixel.

use nalgebra::{Point3, Vector3};
use occupant_units::trig;

/// Distance before the eye at which pictures begin, m.
pub(super) const NEAR_M: f32 = 0.05;
/// Distance between eye and target below which there is no direction of view, m.
const APART_M: f64 = 1e-6;

/// A vector in the picture's computation.
pub(super) type V3 = Vector3<f32>;

/// A camera in space: X forward, Y left, Z up, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Where it stands.
    pub eye_m: Point3<f64>,
    /// What it looks at.
    pub target_m: Point3<f64>,
    /// What is up in the picture; any length, not along the view.
    pub up: Vector3<f64>,
    /// Angle that the picture's height covers, rad.
    pub height_rad: f64,
}

/// A lens before a picture of some size, relative to an origin near what is drawn.
#[derive(Clone, Debug)]
pub(super) struct Frustum {
    pub(super) eye: V3,
    /// To the right, up and forward.
    pub(super) axes: [V3; 3],
    /// Pixels per unit of slope.
    pub(super) focal: f32,
    pub(super) size: [usize; 2],
}

impl Lens {
    /// Whether it looks somewhere: finite, with eye and target apart, and an angle between 1° and 170°.
    pub fn looks(&self) -> bool {
        let numbers = self.eye_m.coords.sum() + self.target_m.coords.sum() + self.up.sum();
        let angle = (1f64.to_radians()..=170f64.to_radians()).contains(&self.height_rad);
        numbers.is_finite() && angle && (self.target_m - self.eye_m).norm() > APART_M
    }

    /// The lens before a picture; a lens that looks nowhere looks forward from its eye, or from the origin.
    pub(super) fn before(&self, origin_m: &Vector3<f64>, size: [usize; 2]) -> Frustum {
        let sound = if self.looks() { *self } else { self.mended(origin_m) };
        let forward = (sound.target_m - sound.eye_m).normalize();
        let right = forward.cross(&sound.up).try_normalize(1e-9);
        // straight up or down: forward is up in the picture
        let right = right.or_else(|| forward.cross(&Vector3::x()).try_normalize(1e-9)).unwrap_or_else(Vector3::y);
        let (sine, cosine) = trig::sin_cos(0.5 * sound.height_rad);
        Frustum {
            eye: (sound.eye_m.coords - origin_m).cast(),
            axes: [right, right.cross(&forward), forward].map(|axis| axis.cast()),
            focal: (0.5 * size[1] as f64 * cosine / sine) as f32,
            size,
        }
    }

    fn mended(&self, origin_m: &Vector3<f64>) -> Self {
        let eye = if self.eye_m.coords.sum().is_finite() { self.eye_m } else { Point3::from(*origin_m) };
        Lens { eye_m: eye, target_m: eye + Vector3::x(), up: Vector3::z(), height_rad: 0.7 }
    }
}

impl Frustum {
    /// A point to the right, up and forward of the eye.
    pub(super) fn seen(&self, point: &V3) -> V3 {
        let from = point - self.eye;
        V3::new(self.axes[0].dot(&from), self.axes[1].dot(&from), self.axes[2].dot(&from))
    }

    /// Pixel of a seen point before the eye: x right, y down.
    pub(super) fn pixel(&self, seen: &V3) -> [f32; 2] {
        let [width, height] = self.size.map(|pixels| 0.5 * pixels as f32);
        [width + self.focal * seen.x / seen.z, height - self.focal * seen.y / seen.z]
    }

    /// Direction from the eye through a pixel, one unit forward.
    pub(super) fn ray(&self, x: f32, y: f32) -> V3 {
        let [width, height] = self.size.map(|pixels| 0.5 * pixels as f32);
        self.axes[2] + self.axes[0] * ((x - width) / self.focal) + self.axes[1] * ((height - y) / self.focal)
    }

    /// The planes of the picture's edges, and that before the eye: normals inwards, distance from the eye.
    pub(super) fn planes(&self) -> [(V3, f32); 5] {
        let [wide, high] = self.size.map(|pixels| 0.5 * pixels as f32 / self.focal);
        [
            (V3::new(0.0, 0.0, 1.0), NEAR_M),
            (V3::new(1.0, 0.0, wide), 0.0),
            (V3::new(-1.0, 0.0, wide), 0.0),
            (V3::new(0.0, 1.0, high), 0.0),
            (V3::new(0.0, -1.0, high), 0.0),
        ]
    }
}
