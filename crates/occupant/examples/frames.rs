//! A driving simulator's loop: 1000 frames a second, each told and looked at, for as many seconds as are asked for.
//! Prints what a frame costs beside the integration, and how much memory the program holds.
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use std::time::{Duration, Instant};

use occupant::prelude::*;

fn main() -> Result<(), Error> {
    let seconds = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(5.0_f64);
    let mut case = Case::from_toml(include_str!("driver.toml"))?;
    case.live(VehicleState { velocity_m_s: Vector3::new(8.9, 0.0, 0.0), ..Default::default() })?;
    case.integrator(Integrator::Rk4 { step_s: 5e-4 });
    case.ends_at(seconds + 1.0);
    let model = case.model()?;
    let head = case.segment("head")?.segment();
    let mut run = Run::new(&model);
    let [mut told, mut stepped, mut looked] = [Duration::ZERO; 3];
    let mut begun_kb = 0;
    for frame in 1..=(seconds * 1e3) as u32 {
        let time_s = 1e-3 * f64::from(frame);
        let began = Instant::now();
        // a slalom
        let aside_m_s2 = 2.0 * (time_s * 3.0).sin();
        run.push(time_s, &VehicleInput::acceleration([0.0, aside_m_s2, 0.0]))?;
        told += began.elapsed();
        let began = Instant::now();
        run.advance_to(time_s)?;
        stepped += began.elapsed();
        let began = Instant::now();
        run.look(|sample| (sample.cg_m(head), sample.orientation(head)))?;
        looked += began.elapsed();
        if frame == 2000 {
            begun_kb = memory_kb();
        }
    }
    let micros = |spent: Duration| spent.as_secs_f64() / seconds * 1e3;
    println!(
        "a frame: told in {:.2} µs, stepped in {:.1} µs, looked at in {:.1} µs",
        micros(told),
        micros(stepped),
        micros(looked)
    );
    println!("memory: {begun_kb} kB after 2 s, {} kB at the end", memory_kb());
    Ok(())
}

/// What the program holds, where the system says.
fn memory_kb() -> u64 {
    let text = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = text.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    line.and_then(|rest| rest.trim().strip_suffix(" kB")?.trim().parse().ok()).unwrap_or(0)
}
