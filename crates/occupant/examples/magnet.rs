//! A magnet in a knob pulls the driver's hand while the car brakes, told frame by frame; HIC in the end.
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use occupant::prelude::*;

/// Between hand and knob: 0.5 N·m² over the square of the distance, 500 N at most.
#[derive(Debug)]
struct Magnet(Place, Place);

impl Force for Magnet {
    fn apply(&self, scene: &Scene<'_>, _memory: &[f64], pushes: &mut Pushes<'_, '_>) {
        let way_m = scene.motion(&self.1).place_m - scene.motion(&self.0).place_m;
        let pull_n = (0.5 / way_m.norm_squared()).min(500.0);
        pushes.between(&self.0, &self.1, way_m.normalize() * pull_n);
        pushes.show(0, pull_n);
    }

    fn channels(&self) -> Vec<ForceChannel> {
        vec![ForceChannel::new("pull", Unit::Newton)]
    }
}

pub(crate) fn main() -> Result<(), Error> {
    let mut case = Case::from_toml(include_str!("driver.toml"))?;
    let knob = Place::Frame(Frame::Vehicle, Point3::new(0.35, -0.1, -0.1));
    case.force("magnet", Magnet(case.sphere("right_hand")?.into(), knob));
    case.live(VehicleState { velocity_m_s: Vector3::new(8.9, 0.0, 0.0), ..Default::default() })?;
    let model = case.model()?;
    let (mut run, mut log) = (Run::new(&model), Log::new(&model));
    while run.time_s() < run.end_s() {
        run.record(&mut log)?;
        let braking_m_s2 = if run.vehicle().velocity_m_s.x > 0.0 { -150.0 } else { 0.0 };
        run.push((run.time_s() + 1e-3).min(run.end_s()), &VehicleInput::acceleration([braking_m_s2, 0.0, 0.0]))?;
        run.advance_to(run.known_until_s())?;
    }
    let results = log.end(run)?;
    let pull_n = results.channel("own_force.magnet.pull")?.iter().copied().fold(0.0, f64::max);
    println!("HIC15 {:.0}, greatest pull {pull_n:.1} N", results.measure(Hic15)?);
    Ok(())
}
