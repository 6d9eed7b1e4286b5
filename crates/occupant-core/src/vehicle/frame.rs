//! Pose and motion of a moving frame at one instant (Eqs 81 to 83).

use nalgebra::{Matrix3, Vector3};

use super::VehiclePose;
use super::attitude::{Attitude, rotation_by};

/// Pose and motion of a moving frame at one instant, all in space axes (X′ forward, Y′ left, Z′ up), SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameMotion {
    /// Position of the frame's origin, m. For a vehicle F·X_vc (Eq. 82).
    pub origin_m: Vector3<f64>,
    /// Rotation from the frame's axes to the space axes: R_v = F·A (Eq. 82).
    pub rotation: Matrix3<f64>,
    /// Velocity of the origin, m/s.
    pub velocity_m_s: Vector3<f64>,
    /// Angular velocity of the frame, rad/s.
    pub angular_velocity_rad_s: Vector3<f64>,
    /// Acceleration of the origin, m/s².
    pub acceleration_m_s2: Vector3<f64>,
    /// Angular acceleration of the frame, rad/s².
    pub angular_acceleration_rad_s2: Vector3<f64>,
}

impl FrameMotion {
    /// The space frame itself: origin at zero, at rest.
    pub(crate) const fn space() -> Self {
        let zero = Vector3::new(0.0, 0.0, 0.0);
        FrameMotion {
            origin_m: zero,
            rotation: Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
            velocity_m_s: zero,
            angular_velocity_rad_s: zero,
            acceleration_m_s2: zero,
            angular_acceleration_rad_s2: zero,
        }
    }

    /// Motion of a frame that does not exist.
    pub(crate) fn nowhere() -> Self {
        let none = Vector3::repeat(f64::NAN);
        FrameMotion {
            origin_m: none,
            rotation: Matrix3::repeat(f64::NAN),
            velocity_m_s: none,
            angular_velocity_rad_s: none,
            acceleration_m_s2: none,
            angular_acceleration_rad_s2: none,
        }
    }

    /// Whether all values are finite.
    pub(crate) fn is_finite(&self) -> bool {
        let vectors = [self.velocity_m_s, self.angular_velocity_rad_s, self.acceleration_m_s2];
        let sum = self.rotation.sum() + self.angular_acceleration_rad_s2.sum() + self.origin_m.sum();
        sum.is_finite() && vectors.iter().all(|v| v.sum().is_finite())
    }

    /// Space point of a point given in the frame, m.
    pub fn point_to_space(&self, point_frame_m: Vector3<f64>) -> Vector3<f64> {
        // X′ = F·X_vc + F·A·X_v (82)
        self.origin_m + self.rotation * point_frame_m
    }

    /// Point in the frame of a point given in space, m.
    pub fn point_to_frame(&self, point_space_m: Vector3<f64>) -> Vector3<f64> {
        // X_v = Aᵀ·F·X′ − Aᵀ·X_vc (83)
        self.rotation.tr_mul(&(point_space_m - self.origin_m))
    }

    /// Space components of a vector given in the frame (Eq. 94).
    pub fn vector_to_space(&self, vector_frame: Vector3<f64>) -> Vector3<f64> {
        self.rotation * vector_frame
    }

    /// Frame components of a vector given in space.
    pub fn vector_to_frame(&self, vector_space: Vector3<f64>) -> Vector3<f64> {
        self.rotation.tr_mul(&vector_space)
    }

    /// Velocity in space, m/s, of the frame's point at `point_space_m`.
    pub(crate) fn velocity_at(&self, point_space_m: Vector3<f64>) -> Vector3<f64> {
        // v + ω × r
        self.velocity_m_s + self.angular_velocity_rad_s.cross(&(point_space_m - self.origin_m))
    }

    /// The same frame `duration_s` later, with constant velocity and angular velocity in space.
    pub(super) fn coasted(&self, duration_s: f64) -> Self {
        FrameMotion {
            origin_m: self.origin_m + self.velocity_m_s * duration_s,
            rotation: rotation_by(self.angular_velocity_rad_s * duration_s) * self.rotation,
            acceleration_m_s2: Vector3::zeros(),
            angular_acceleration_rad_s2: Vector3::zeros(),
            ..*self
        }
    }

    /// A frame at rest at a pose in vehicle-space.
    pub(super) fn at_rest(pose: &VehiclePose) -> Self {
        let rotation = rotation_to_space(pose.attitude.matrix());
        FrameMotion { origin_m: to_space(pose.position_m), rotation, ..FrameMotion::space() }
    }

    /// Its pose in vehicle-space, with roll, pitch and yaw nearest to those of `near`.
    pub(super) fn pose(&self, near: &Attitude) -> VehiclePose {
        let attitude = Attitude::from_matrix(&rotation_to_space(self.rotation), near);
        VehiclePose { position_m: to_space(self.origin_m), attitude }
    }

    /// The same pose, at rest.
    pub(crate) fn held(&self) -> Self {
        FrameMotion { origin_m: self.origin_m, rotation: self.rotation, ..FrameMotion::space() }
    }
}

/// F·v: a vehicle-space vector (X′_v forward, Y′_v right, Z′_v down) along the space axes (Eq. 81).
///
/// F = diag(1, −1, −1) is a half turn about X′, a proper rotation: angular velocities go by the same rule.
pub(super) fn to_space(vector: Vector3<f64>) -> Vector3<f64> {
    Vector3::new(vector.x, -vector.y, -vector.z)
}

/// F·A: `matrix` with rows 2 and 3 negated.
pub(super) fn rotation_to_space(matrix: Matrix3<f64>) -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0)) * matrix
}
