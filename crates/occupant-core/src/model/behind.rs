//! Whether a setup is a rear impact on a seat with a head restraint, which has whiplash measures.
//!
//! A head restraint is a surface or solid with `head_restraint` in its name. It is a rear impact if the vehicle that
//! carries it gains at least 1 m/s forward along its own X within 150 ms, and more than it loses within any such time.

use crate::forces::contact::surface::Frame;
use crate::model::setup::Setup;
use crate::vehicle::{PathCursor, VehiclePath};

/// Part of the name by which head restraints are known.
const NAME: &str = "head_restraint";
/// Duration within which a crash changes the speed, s, and the least change, m/s.
const WITHIN_S: f64 = 0.15;
const LEAST_M_S: f64 = 1.0;
/// Samples of the path within that time.
const LOOKS: usize = 15;
/// Largest number of samples of a long path.
const MOST_LOOKS: usize = 2000;

/// Surfaces (indices among all that can be touched) that are head restraints in a rear impact.
pub(crate) fn restraints(setup: &Setup) -> Vec<usize> {
    let frames = setup.surfaces.iter().map(|own| own.frame).chain(setup.solids.iter().map(|own| own.frame));
    let named = setup.surface_names().zip(frames).enumerate().filter(|(_, (name, _))| name.contains(NAME));
    let struck = |frame: Frame| match setup.belongs_to(frame) {
        Frame::Vehicle => is_from_behind(&setup.path, [setup.time.start_s, setup.time.end_s]),
        Frame::Other(i) => is_from_behind(&setup.frames[i].path, [setup.time.start_s, setup.time.end_s]),
        Frame::Space | Frame::Segment(_) => false,
    };
    named.filter(|(_, (_, frame))| struck(*frame)).map(|(i, _)| i).collect()
}

fn is_from_behind(path: &VehiclePath, [start_s, end_s]: [f64; 2]) -> bool {
    let step_s = (WITHIN_S / LOOKS as f64).max((end_s - start_s) / MOST_LOOKS as f64);
    let mut cursor = PathCursor::default();
    let count = ((end_s - start_s) / step_s).ceil() as usize + 1;
    let speeds: Vec<_> = (0..count)
        .map(|i| {
            let t_s = (start_s + i as f64 * step_s).min(end_s);
            let motion = path.motion(t_s, t_s, &mut cursor);
            (motion.velocity_m_s, motion.rotation.column(0).into_owned())
        })
        .collect();
    let (mut ahead, mut back) = (0.0_f64, 0.0_f64);
    for (i, (before, axis)) in speeds.iter().enumerate() {
        for (after, _) in &speeds[i..(i + LOOKS + 1).min(speeds.len())] {
            let gained = (after - before).dot(axis);
            (ahead, back) = (ahead.max(gained), back.max(-gained));
        }
    }
    ahead >= LEAST_M_S && ahead > back
}
