//! A vehicle path from a program's own model: what a momentum reconstruction of an oblique collision knows, speed before,
//! change of velocity, yaw rate after it and its duration, becomes the motion that the occupant feels.
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use std::error::Error;
use std::f64::consts::PI;

use nalgebra::Vector3;
use occupant_core::model::Model;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::simulate::simulate;
use occupant_core::vehicle::{Attitude, VehicleMotion, VehiclePath, VehiclePose, VehicleState};
use occupant_scenario::{Format, Scenario};
use occupant_units::trig::sin_cos;

/// A collision whose force and yaw moment are half sines in time. Axes: x forward as the vehicle came, y right, z down.
#[derive(Debug)]
pub(crate) struct ObliqueCollision {
    pub(crate) speed_m_s: f64,
    pub(crate) delta_v_m_s: Vector3<f64>,
    pub(crate) yaw_rate_after_rad_s: f64,
    pub(crate) duration_s: f64,
}

impl VehicleMotion for ObliqueCollision {
    fn at(&self, t_s: f64) -> VehicleState {
        // done: part of the impulse that has acted; its derivative and its integral in time
        let phase = PI * (t_s / self.duration_s).clamp(0.0, 1.0);
        let (sin, cos) = sin_cos(phase);
        let done = 0.5 * (1.0 - cos);
        let done_rate = 0.5 * PI / self.duration_s * sin;
        let during_s = 0.5 * self.duration_s / PI * (phase - sin);
        let done_integral_s = during_s + (t_s - self.duration_s).max(0.0);

        let before = Vector3::new(self.speed_m_s, 0.0, 0.0);
        let yaw = Vector3::new(0.0, 0.0, self.yaw_rate_after_rad_s);
        VehicleState {
            pose: VehiclePose {
                position_m: before * t_s + self.delta_v_m_s * done_integral_s,
                attitude: Attitude { yaw_rad: yaw.z * done_integral_s, ..Attitude::default() },
            },
            velocity_m_s: before + self.delta_v_m_s * done,
            acceleration_m_s2: self.delta_v_m_s * done_rate,
            angle_rates_rad_s: yaw * done,
            angle_accelerations_rad_s2: yaw * done_rate,
        }
    }

    fn breaks_s(&self) -> Vec<f64> {
        vec![0.0, self.duration_s]
    }
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    // the compartment and the driver of a scenario, the vehicle's motion from here
    let text = include_str!("../scenarios/cart-lap-torso.toml");
    let no_files = |name: &str| Err(format!("{name}: no files here"));
    let (mut setup, _) = Scenario::from_text(text, Format::Toml, "cart-lap-torso.toml", &no_files)?.build()?;
    let collision = ObliqueCollision {
        speed_m_s: 15.0,
        delta_v_m_s: Vector3::new(-8.0, 3.0, 0.0), // struck at the front left corner
        yaw_rate_after_rad_s: 2.5,
        duration_s: 0.1,
    };
    let (delta_v_m_s, yaw_rad_s) = (collision.delta_v_m_s.norm(), collision.yaw_rate_after_rad_s);
    println!("Oblique collision: delta-v {delta_v_m_s:.1} m/s, then yawing at {:.0} deg/s", yaw_rad_s.to_degrees());
    setup.path = VehiclePath::own(collision);

    let mut summarizer = Summarizer::new();
    simulate(&Model::new(setup)?, &mut summarizer)?;
    let summary = summarizer.summary(None).ok_or("the run did not end")?;
    if let Some(head) = summary.head_excursion {
        let (cm, ms) = (100.0 * head.forward.value, 1e3 * head.forward.time_s);
        println!(
            "  the head moves {cm:.0} cm forward (at {ms:.0} ms) and {:.0} cm to the left",
            100.0 * head.left.value
        );
    }
    println!("  its acceleration peaks at {:.0} g", summary.accelerations.head.peak_g);
    for contact in summary.contacts.iter().filter(|c| !c.at_start) {
        let (t_ms, speed) = (1e3 * contact.time_s, contact.closing_m_s);
        println!("  {} meets {} at {t_ms:.0} ms with {speed:.1} m/s", contact.sphere, contact.surface);
    }
    Ok(())
}
