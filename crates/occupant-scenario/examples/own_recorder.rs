//! A recorder of your own: how near the driver's head comes to the hub of the steering wheel, and a run that ends as soon
//! as the head has turned back. A recorder sees every output of the run and keeps what it wants.
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use std::error::Error;

use nalgebra::Point3;
use occupant_core::forces::contact::surface::Outline;
use occupant_core::model::Model;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use occupant_scenario::{Format, Scenario};

/// Once the head is this much further away than it has been, it is on its way back, m.
const TURNED_BACK_M: f64 = 0.05;

/// Least distance of the head's surface from the hub.
#[derive(Debug, Default)]
pub(crate) struct HeadToHub {
    head: usize,
    hub_m: Point3<f64>,
    pub(crate) start_m: f64,
    /// Distance, m, and time, s.
    pub(crate) least: Option<(f64, f64)>,
}

impl Recorder for HeadToHub {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        self.head = model.body().sphere("head").ok_or("this body has no head")?;
        let wheel = model.setup().surfaces.iter().find(|s| s.name == "steering_wheel").ok_or("no steering wheel")?;
        let Outline::Disc { centre_m, .. } = wheel.outline else { return Err("the steering wheel is no disc".into()) };
        self.hub_m = centre_m;
        Ok(())
    }

    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        // places are in vehicle axes
        let radius_m = sample.model.body().spheres[self.head].radius_m;
        let distance_m = (sample.sphere_centre_m(self.head) - self.hub_m).norm() - radius_m;
        let least = match self.least {
            Some(least) if least.0 < distance_m => least,
            _ => (distance_m, sample.time_s),
        };
        if self.least.is_none() {
            self.start_m = distance_m;
        }
        self.least = Some(least);
        Ok(if distance_m > least.0 + TURNED_BACK_M { Flow::Stop } else { Flow::Continue })
    }
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let no_files = |name: &str| Err(format!("{name}: no files here"));
    let cases = [
        ("no belt", include_str!("../testdata/carts/cart-unbelted.toml")),
        ("lap belt", include_str!("../testdata/carts/cart-lap.toml")),
        ("lap and torso belt", include_str!("../testdata/carts/cart-lap-torso.toml")),
    ];
    for (belts, text) in cases {
        let (model, _) = Scenario::from_text(text, Format::Toml, belts, &no_files)?.model()?;
        let mut head = HeadToHub::default();
        let outcome = simulate(&model, &mut head)?;
        let (least_m, at_s) = head.least.ok_or("no output")?;
        println!(
            "{belts:19} head to hub {:3.0} cm at the start, least {:3.0} cm at {:3.0} ms; run ended at {:3.0} ms",
            100.0 * head.start_m,
            100.0 * least_m,
            1e3 * at_s,
            1e3 * outcome.time_s,
        );
    }
    Ok(())
}
