//! A driving simulator's loop: 1000 frames a second, each told and looked at, for as many seconds as are asked for, beside the same
//! run of a path that is known beforehand. Prints what a frame costs more, and how much memory the program holds.
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use std::time::{Duration, Instant};

use occupant::prelude::*;

const SPEED_M_S: f64 = 8.9;

/// A slalom that is known beforehand: 2 m/s² to either side.
#[derive(Debug)]
struct Slalom;

impl VehicleMotion for Slalom {
    fn at(&self, t_s: f64) -> VehicleState {
        let phase = 3.0 * t_s;
        let mut state = begun();
        state.pose.position_m = Vector3::new(SPEED_M_S * t_s, 2.0 * (phase - phase.sin()) / 9.0, 0.0);
        state.velocity_m_s.y = 2.0 * (1.0 - phase.cos()) / 3.0;
        state.acceleration_m_s2.y = 2.0 * phase.sin();
        state
    }
}

fn begun() -> VehicleState {
    VehicleState { velocity_m_s: Vector3::new(SPEED_M_S, 0.0, 0.0), ..Default::default() }
}

fn main() -> Result<(), Error> {
    let seconds = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(5.0_f64);
    let mut case = Case::from_toml(include_str!("driver.toml"))?;
    case.integrator(Integrator::Rk4 { step_s: 5e-4 });
    case.ends_at(seconds + 1.0);
    let mut known = case.clone();
    known.path(VehiclePath::own(Slalom));
    case.live(begun())?;
    let (model, known, head) = (case.model()?, known.model()?, case.segment("head")?.segment());
    let (mut run, mut beside) = (Run::new(&model), Run::new(&known));
    let [mut told, mut stepped, mut looked, mut without] = [Duration::ZERO; 4];
    let mut early_kb = 0;
    for frame in 1..=(seconds * 1e3) as u32 {
        let time_s = 1e-3 * f64::from(frame);
        let aside_m_s2 = 2.0 * (3.0 * (time_s - 5e-4)).sin();
        told += timed(|| run.push(time_s, &VehicleInput::acceleration([0.0, aside_m_s2, 0.0])))?;
        stepped += timed(|| run.advance_to(time_s))?;
        looked += timed(|| run.look(|sample| (sample.cg_m(head), sample.orientation(head))))?;
        without += timed(|| beside.advance_to(time_s))?;
        if frame == 5000 {
            early_kb = memory_kb();
        }
    }
    let micros = |spent: Duration| spent.as_secs_f64() / seconds * 1e3;
    let [told, stepped, looked, without] = [told, stepped, looked, without].map(micros);
    println!("a frame: told in {told:.2} µs, stepped in {stepped:.1} µs, looked at in {looked:.1} µs");
    println!("known beforehand: stepped in {without:.1} µs, so that telling costs {:.1} µs", told + stepped - without);
    println!("memory: {early_kb} kB after 5 s, {} kB at the end", memory_kb());
    Ok(())
}

/// How long it takes.
fn timed<T, E: Into<Error>>(work: impl FnOnce() -> Result<T, E>) -> Result<Duration, Error> {
    let began = Instant::now();
    work().map_err(Into::into)?;
    Ok(began.elapsed())
}

/// What the program holds, where the system says.
fn memory_kb() -> u64 {
    let text = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = text.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    line.and_then(|rest| rest.trim().strip_suffix(" kB")?.trim().parse().ok()).unwrap_or(0)
}
