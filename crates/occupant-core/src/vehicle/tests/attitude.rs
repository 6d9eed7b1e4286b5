use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::super::support::{Seeded, assert_below, differentiate, omega_of};
use super::*;

/// Rotation about axis 0, 1 or 2, from the standard library's sine and cosine.
fn about(axis: usize, angle: f64) -> Matrix3<f64> {
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut matrix = Matrix3::identity();
    matrix[(next, next)] = angle.cos();
    matrix[(next, last)] = -angle.sin();
    matrix[(last, next)] = angle.sin();
    matrix[(last, last)] = angle.cos();
    matrix
}

/// A random attitude; every third is within a milliradian of nose up or nose down.
fn attitude(seeded: &mut Seeded, number: usize) -> Attitude {
    let mut angles = seeded.vector(-PI, PI);
    angles.y = match number % 3 {
        0 => FRAC_PI_2.copysign(angles.y) + seeded.between(-1e-3, 1e-3),
        _ => angles.y / 2.0,
    };
    Attitude::from_vector(angles)
}

#[test]
fn the_matrix_is_yaw_then_pitch_then_roll() {
    let mut seeded = Seeded(1);
    let mut worst: f64 = 0.0;
    for number in 0..300 {
        let a = attitude(&mut seeded, number);
        let product = about(2, a.yaw_rad) * about(1, a.pitch_rad) * about(0, a.roll_rad);
        worst = worst.max((a.matrix() - product).amax());
    }
    assert_below("A − R_z R_y R_x", worst, 1e-15); // 2.2e-16
}

#[test]
fn angular_velocity_turns_the_matrix() {
    let mut seeded = Seeded(2);
    let (mut worst, mut worst_acceleration) = (0.0f64, 0.0f64);
    for number in 0..300 {
        let angles = attitude(&mut seeded, number).to_vector();
        let (rates, seconds) = (seeded.vector(-3.0, 3.0), seeded.vector(-20.0, 20.0));
        let at = |t: f64| turning(angles + rates * t + seconds * (0.5 * t * t), rates + seconds * t, seconds);
        let derivative = differentiate(|t| at(t).matrix, 0.0, 1e-3);
        let now = at(0.0);
        let omega = omega_of(now.matrix, derivative, 1e-8);
        worst = worst.max((omega - now.velocity_rad_s).amax());
        let alpha = differentiate(|t| at(t).velocity_rad_s, 0.0, 1e-3);
        worst_acceleration = worst_acceleration.max((alpha - now.acceleration_rad_s2).amax());
    }
    assert_below("ω", worst, 1e-8); // 2.7e-09
    assert_below("α", worst_acceleration, 1e-7); // 8.7e-09
}

#[test]
fn angles_come_back_from_the_matrix_nearest_to_the_given_ones() {
    let mut seeded = Seeded(3);
    let mut worst: f64 = 0.0;
    for _ in 0..300 {
        // Any pitch at all, so that both names of an attitude are asked for.
        let asked = Attitude::from_vector(seeded.vector(-9.0, 9.0));
        if asked.pitch_rad.cos().abs() < 0.05 {
            continue;
        }
        let near = Attitude::from_vector(asked.to_vector() + seeded.vector(-0.3, 0.3));
        let found = Attitude::from_matrix(&asked.matrix(), &near);
        worst = worst.max((found.to_vector() - asked.to_vector()).amax());
    }
    assert_below("angle", worst, 1e-14); // 8.9e-16
}

#[test]
fn nose_up_and_nose_down_keep_the_roll_and_the_attitude() {
    for pitch_rad in [FRAC_PI_2, -FRAC_PI_2] {
        let asked = Attitude { roll_rad: 0.4, pitch_rad, yaw_rad: -1.1 };
        let found = Attitude::from_matrix(&asked.matrix(), &Attitude { yaw_rad: -1.0, ..asked });
        assert_below("roll", (found.roll_rad - 0.4).abs(), 1e-14); // 0
        assert_below("yaw", (found.yaw_rad + 1.1).abs(), 1e-14); // 0
        assert_below("matrix", (found.matrix() - asked.matrix()).amax(), 1e-15); // 0
    }
}

#[test]
fn unwrapping_adds_whole_turns_and_never_changes_the_attitude() {
    let previous = Attitude { roll_rad: 0.0, pitch_rad: 0.0, yaw_rad: 3.1 };
    let next = Attitude { yaw_rad: -3.1, ..previous }.unwrapped_after(&previous);
    assert_below("yaw", (next.yaw_rad - (TAU - 3.1)).abs(), 1e-15); // 0
    // Past the vertical: (φ, θ, ψ) = (π, 1.5, π) is (0, π − 1.5, 0).
    let rising = Attitude { roll_rad: 0.0, pitch_rad: 1.55, yaw_rad: 0.0 };
    let over = Attitude { roll_rad: PI, pitch_rad: 1.5, yaw_rad: PI };
    let named = over.unwrapped_after(&rising);
    assert_below(
        "angles",
        (named.to_vector() - Vector3::new(0.0, PI - 1.5, 0.0)).amax(),
        1e-15, // 0
    );
    assert_below("matrix", (named.matrix() - over.matrix()).amax(), 1e-15); // 1.2e-16
}

#[test]
fn the_exponential_is_the_rotation_about_its_axis() {
    let mut seeded = Seeded(4);
    let (mut apart, mut skewed, mut composed) = (0.0f64, 0.0f64, 0.0f64);
    for _ in 0..200 {
        let turn = seeded.vector(-4.0, 4.0);
        let rotation = rotation_by(turn);
        skewed = skewed.max((rotation * rotation.transpose() - Matrix3::identity()).amax());
        let part = seeded.between(-1.0, 2.0);
        composed = composed.max((rotation_by(turn * part) * rotation_by(turn * (1.0 - part)) - rotation).amax());
        let axis = (seeded.between(0.0, 3.0) as usize).min(2);
        let mut about_axis = Vector3::zeros();
        about_axis[axis] = turn.x;
        apart = apart.max((rotation_by(about_axis) - about(axis, turn.x)).amax());
    }
    assert_below("R Rᵀ − 1", skewed, 1e-14); // 1.6e-15
    assert_below("exp(a) exp(b) − exp(a + b)", composed, 1e-14); // 1.8e-15
    assert_below("about an axis", apart, 1e-14); // 5.6e-16
    // Both sides of the switch to the limit at small angles.
    let tiny = Vector3::new(0.6, 0.0, 0.8);
    let jump = (rotation_by(tiny * 1.01e-8) - rotation_by(tiny * 0.99e-8)) / 2e-10 - tiny.cross_matrix();
    assert_below("jump at the switch", jump.amax(), 1e-7); // 4.8e-09
}
