//! A vehicle path as a record.

use nalgebra::Vector3;

use occupant_core::vehicle::{AccelerationRecord, Interpolation, PathCursor, VehiclePath};

/// Largest number of samples of a path: each takes half a kilobyte of results.
const MOST_SAMPLES: f64 = 1.5e6;

/// Accelerations and rates of the c.g. along the vehicle's axes from `start_s` to `end_s`, `dt_s` apart; none for a span or an
/// interval that is not positive, or more than 1.5 million samples.
///
/// Between the stations of a straight-line table the vehicle has no acceleration, and at them its velocity jumps. There the
/// acceleration of a sample is the velocity change from half an interval before to half an interval after it, over the
/// interval, so that its integral is the velocity change.
pub fn sampled(path: &VehiclePath, start_s: f64, end_s: f64, dt_s: f64) -> Option<AccelerationRecord> {
    let steps = ((end_s - start_s) / dt_s + 1e-6).floor();
    if !(dt_s > 0.0 && (1.0..MOST_SAMPLES).contains(&steps)) {
        return None;
    }
    let mut cursor = PathCursor::default();
    let mut record = AccelerationRecord::default();
    let mut channels: [Vec<f64>; 6] = Default::default();
    for i in 0..=steps as usize {
        let t_s = start_s + i as f64 * dt_s;
        let motion = path.motion(t_s, t_s, &mut cursor);
        let acceleration = match path {
            VehiclePath::Table(table) if table.interpolation() == Interpolation::Linear => {
                jump(path, table.span_s(), t_s, dt_s, &mut cursor)
            }
            _ => motion.acceleration_m_s2,
        };
        let along = motion.vector_to_frame(acceleration);
        let about = motion.vector_to_frame(motion.angular_velocity_rad_s);
        record.time_s.push(t_s);
        for (channel, value) in channels.iter_mut().zip(along.iter().chain(&about)) {
            channel.push(*value);
        }
    }
    let [ax, ay, az, wx, wy, wz] = channels.map(Some);
    record.acceleration_m_s2 = [ax, ay, az];
    record.rate_rad_s = [wx, wy, wz];
    Some(record)
}

/// Jump of the velocity at `t_s`, spread over the interval, m/s²; at the ends of the table half of it is inside.
fn jump(
    path: &VehiclePath,
    (first_s, last_s): (f64, f64),
    t_s: f64,
    dt_s: f64,
    cursor: &mut PathCursor,
) -> Vector3<f64> {
    let mut velocity = |t: f64| {
        let t = t.clamp(first_s, last_s);
        path.motion(t, t, cursor).velocity_m_s
    };
    (velocity(t_s + 0.5 * dt_s) - velocity(t_s - 0.5 * dt_s)) / dt_s
}
