//! Steering, brake and drive over time; a driver who follows a line.

use core::cmp::Ordering;

use crate::{GRAVITY_M_S2, V3};
use libm::{atan, atan2, sin, tan};

/// A number over time, linear between points and constant outside.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    times_s: Vec<f64>,
    values: Vec<f64>,
}

/// Problems of a table or a line.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TableError {
    /// Lists of unlike length, or empty.
    #[error("{times} times and {values} values; expected the same number of each, at least one")]
    Lengths {
        /// Number of times.
        times: usize,
        /// Number of values.
        values: usize,
    },
    /// Times that do not rise.
    #[error("time {number} is {time_s} s; expected a number above {before_s} s")]
    Order {
        /// Its number, counted from 1.
        number: usize,
        /// The time, s.
        time_s: f64,
        /// The time before, s.
        before_s: f64,
    },
    /// A value that is not finite.
    #[error("value {0} is not a finite number")]
    NotFinite(usize),
    /// A line of one point, or of two that coincide.
    #[error("a line needs at least two points, and no two in a row at one place")]
    Line,
}

impl Table {
    /// Values at times, s.
    ///
    /// # Errors
    /// Unlike lengths, times that do not rise, numbers that are not finite.
    pub fn new(times_s: Vec<f64>, values: Vec<f64>) -> Result<Self, TableError> {
        if times_s.len() != values.len() || times_s.is_empty() {
            return Err(TableError::Lengths { times: times_s.len(), values: values.len() });
        }
        if let Some(i) =
            (1..times_s.len()).find(|&i| times_s[i].partial_cmp(&times_s[i - 1]) != Some(Ordering::Greater))
        {
            return Err(TableError::Order { number: i + 1, time_s: times_s[i], before_s: times_s[i - 1] });
        }
        if let Some(i) = (0..values.len()).find(|&i| !(values[i].is_finite() && times_s[i].is_finite())) {
            return Err(TableError::NotFinite(i + 1));
        }
        Ok(Table { times_s, values })
    }

    /// One value at all times.
    pub fn constant(value: f64) -> Self {
        Table { times_s: vec![0.0], values: vec![value] }
    }

    /// Value at a time.
    pub fn at(&self, time_s: f64) -> f64 {
        let next = self.times_s.partition_point(|t| *t <= time_s);
        if next == 0 || next == self.times_s.len() {
            return self.values[next.saturating_sub(1)];
        }
        let [from_s, to_s] = [self.times_s[next - 1], self.times_s[next]];
        let [from, to] = [self.values[next - 1], self.values[next]];
        from + (to - from) * (time_s - from_s) / (to_s - from_s)
    }

    /// Its slope at a time.
    fn slope_at(&self, time_s: f64) -> f64 {
        let next = self.times_s.partition_point(|t| *t <= time_s);
        if next == 0 || next == self.times_s.len() {
            return 0.0;
        }
        (self.values[next] - self.values[next - 1]) / (self.times_s[next] - self.times_s[next - 1])
    }

    /// Times of its kinks, s.
    pub fn corners_s(&self) -> &[f64] {
        if self.times_s.len() < 2 { &[] } else { &self.times_s }
    }
}

/// Driver model. Torques are sums over the wheels.
#[derive(Clone, Debug, PartialEq)]
pub struct Driver {
    /// Steering.
    pub steering: Steering,
    /// Brake torque, N·m.
    pub brake_n_m: Table,
    /// Drive torque, N·m; negative brakes by the engine.
    pub drive_n_m: Table,
    /// Target speed, instead of drive and brake torques, m/s.
    pub speed_m_s: Option<Table>,
    /// Times from which wheels are locked, s.
    pub locked_from_s: [Option<f64>; crate::WHEELS],
    /// Wheels that lock at the first collision.
    pub locked_on_impact: [bool; crate::WHEELS],
    /// Reaction to the first collision.
    pub on_impact: OnImpact,
}

/// Reaction to the first collision; the steering wheel is held unless he continues.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum OnImpact {
    /// Releases the pedals.
    #[default]
    Release,
    /// Holds the pedals.
    Hold,
    /// Brakes with this torque, N·m, without drive.
    Brake(f64),
    /// Continues unchanged.
    Continue,
}

/// Mean angle of the front wheels; positive to the right.
#[derive(Clone, Debug, PartialEq)]
pub enum Steering {
    /// Road-wheel angle over time, rad.
    Table(Table),
    /// A driver who follows a line.
    Follow(Follower),
}

impl Driver {
    /// No steering and no pedals.
    pub fn coasting() -> Self {
        Driver {
            steering: Steering::Table(Table::constant(0.0)),
            brake_n_m: Table::constant(0.0),
            drive_n_m: Table::constant(0.0),
            speed_m_s: None,
            locked_from_s: [None; crate::WHEELS],
            locked_on_impact: [false; crate::WHEELS],
            on_impact: OnImpact::Release,
        }
    }

    /// Acceleration towards the target speed, m/s², with a time constant of 0.2 s and no more than a driver asks for; none
    /// without a target, or after a first collision.
    pub(crate) fn speeds_up_m_s2(&self, time_s: f64, speed_m_s: f64, hit_s: Option<f64>) -> Option<f64> {
        let table = self.speed_m_s.as_ref().filter(|_| hit_s.is_none() || self.on_impact == OnImpact::Continue)?;
        let slope = table.slope_at(time_s);
        let wanted = slope + (table.at(time_s) - speed_m_s) / SPEED_S;
        let least = (slope - SPARE_M_S2).clamp(-MOST_M_S2, -BRAKES_M_S2);
        let most = (slope + SPARE_M_S2).clamp(DRIVES_M_S2, MOST_M_S2);
        Some(wanted.clamp(least, most))
    }

    /// Brake and drive torque at a time, N·m, after a first collision at another.
    pub(crate) fn pedals(&self, time_s: f64, hit_s: Option<f64>) -> [f64; 2] {
        let at = |time_s: f64| [self.brake_n_m.at(time_s), self.drive_n_m.at(time_s)];
        match (hit_s, self.on_impact) {
            (None, _) | (_, OnImpact::Continue) => at(time_s),
            (Some(hit_s), OnImpact::Hold) => at(time_s.min(hit_s)),
            (Some(_), OnImpact::Release) => [0.0, 0.0],
            (Some(_), OnImpact::Brake(torque_n_m)) => [torque_n_m, 0.0],
        }
    }

    /// Times at which an input may have a kink, s, in order.
    pub(crate) fn corners_s(&self) -> Vec<f64> {
        let mut all: Vec<f64> = [Some(&self.brake_n_m), Some(&self.drive_n_m), self.speed_m_s.as_ref()]
            .into_iter()
            .flatten()
            .flat_map(Table::corners_s)
            .copied()
            .collect();
        if let Steering::Table(table) = &self.steering {
            all.extend(table.corners_s());
        }
        all.extend(self.locked_from_s.iter().flatten());
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    }
}

/// Path-following driver (pure pursuit): aims at a point of the line some distance ahead, updates every 10 ms, and
/// reacts after a delay.
#[derive(Clone, Debug, PartialEq)]
pub struct Follower {
    /// Corners of the line, X and Y, m.
    line_m: Vec<[f64; 2]>,
    /// Reaction time, s.
    pub delay_s: f64,
    /// Largest rate of the road-wheel angle, rad/s.
    pub rate_rad_s: f64,
    /// Largest road-wheel angle, rad.
    pub most_rad: f64,
    /// Time at which he stops steering, s; the angle is then held.
    pub until_s: f64,
}

/// Time constant of speed control, s.
const SPEED_S: f64 = 0.2;
/// Largest acceleration and deceleration that a driver asks for to reach a speed, m/s²: estimates. Cars reach 0.3 to
/// 0.5 g at full throttle from rest and 0.7 to 0.9 g in a full stop on dry asphalt.
const DRIVES_M_S2: f64 = 0.4 * GRAVITY_M_S2;
const BRAKES_M_S2: f64 = 0.8 * GRAVITY_M_S2;
/// What he may ask for beyond the slope of a table that is steeper, and his limit even then, m/s².
const SPARE_M_S2: f64 = 0.1 * GRAVITY_M_S2;
const MOST_M_S2: f64 = GRAVITY_M_S2;

/// Angle beyond that of a turn at 1 g without slip, past which he steers no further, rad: an estimate. Tyres grip best at
/// slip angles of 0.1 to 0.2.
const GRIPPED_RAD: f64 = 0.1;

/// Update interval of the driver, s.
pub const LOOK_S: f64 = 0.01;
/// Least preview distance, m, and preview time, s.
const PREVIEW_M: f64 = 6.0;
const PREVIEW_S: f64 = 0.6;
/// Least way along the line to the point he aims at over the preview distance, and its inverse the largest: a line that
/// turns by less than 30° within the preview, or a car that heads as far away from it, reaches neither.
const PREVIEW_SHARE: f64 = 0.866;

impl Follower {
    /// Along a line with 0.1 s of delay and 600 °/s at a steering wheel of ratio 16.
    ///
    /// # Errors
    /// A line of fewer than two points, or with two in a row at one place.
    pub fn new(line_m: Vec<[f64; 2]>) -> Result<Self, TableError> {
        let is_line = line_m.len() >= 2 && line_m.windows(2).all(|pair| pair[0] != pair[1]);
        if !is_line || line_m.iter().flatten().any(|x| !x.is_finite()) {
            return Err(TableError::Line);
        }
        let rate_rad_s = 600f64.to_radians() / 16.0;
        Ok(Follower { line_m, delay_s: 0.1, rate_rad_s, most_rad: 0.5, until_s: f64::INFINITY })
    }

    /// The point of the line nearest to a place, m, and its way along the line, m, of those whose way lies within bounds. The
    /// last piece has no end: he drives on.
    fn nearest_m(&self, place: [f64; 2], [least_m, most_m]: [f64; 2]) -> ([f64; 2], f64) {
        let pieces = self.line_m.len() - 1;
        let mut from_m = 0.0;
        let (mut nearest, mut least) = ((self.line_m[0], 0.0), f64::INFINITY);
        for (i, pair) in self.line_m.windows(2).enumerate() {
            let way = [0, 1].map(|j| pair[1][j] - pair[0][j]);
            let square = way[0] * way[0] + way[1] * way[1];
            let length_m = square.sqrt();
            let end = if i + 1 == pieces { f64::INFINITY } else { 1.0 };
            let [first, last] = [(least_m - from_m) / length_m, (most_m - from_m) / length_m];
            if first <= end && last >= 0.0 {
                let share = [0, 1].map(|j| (place[j] - pair[0][j]) * way[j]).iter().sum::<f64>() / square;
                let share = share.clamp(first.max(0.0), last.min(end));
                let point = [0, 1].map(|j| pair[0][j] + share * way[j]);
                let far = (point[0] - place[0]) * (point[0] - place[0]) + (point[1] - place[1]) * (point[1] - place[1]);
                if far < least {
                    (nearest, least) = ((point, from_m + share * length_m), far);
                }
            }
            from_m += length_m;
        }
        nearest
    }

    /// Road-wheel angle demanded, rad, with the car at `position_m`, heading `yaw_rad`, at `velocity_m_s`. `along_m` is how far
    /// along the line he has come, none before he first looks.
    ///
    /// He aims at the point of the line nearest to the place one preview distance ahead of the car. The way along the line
    /// from the car to that point stays near the preview distance, so that he turns at a corner of any angle.
    pub fn wants_rad(
        &self,
        along_m: &mut Option<f64>,
        position_m: V3,
        yaw_rad: f64,
        velocity_m_s: V3,
        rear_m: f64,
        wheelbase_m: f64,
    ) -> f64 {
        let speed_m_s = libm::hypot(velocity_m_s.x, velocity_m_s.y);
        let preview_m = PREVIEW_M.max(PREVIEW_S * speed_m_s);
        let (sine, cosine) = libm::sincos(yaw_rad);
        let ahead = |way_m: f64| [position_m.x + way_m * cosine, position_m.y + way_m * sine];
        // onwards only, and not across to a part of the line far ahead
        let come = along_m.map_or([0.0, f64::INFINITY], |come_m| [come_m, come_m + preview_m]);
        let (_, come_m) = self.nearest_m(ahead(0.0), come);
        *along_m = Some(come_m);
        // ahead of its first point he heads for the line as it comes
        let least_m = if come_m > 0.0 { come_m + preview_m * PREVIEW_SHARE } else { 0.0 };
        let ([x, y], _) = self.nearest_m(ahead(preview_m), [least_m, come_m + preview_m / PREVIEW_SHARE]);
        let [rear_x, rear_y] = ahead(rear_m);
        let (to_x, to_y) = (x - rear_x, y - rear_y);
        let bearing = atan2(to_y, to_x) - yaw_rad;
        // δ = atan(2L sin η/d); what lies behind is turned to as what lies abreast
        let aside = if libm::cos(bearing) < 0.0 { 1f64.copysign(sin(bearing)) } else { sin(bearing) };
        let distance_m = (to_x * to_x + to_y * to_y).sqrt().max(1e-3);
        let gripped_rad = atan(wheelbase_m * GRAVITY_M_S2 / (speed_m_s * speed_m_s)) + GRIPPED_RAD;
        // a skid leaves him as much about the direction of travel
        let [x, y] = [velocity_m_s.x * cosine + velocity_m_s.y * sine, velocity_m_s.y * cosine - velocity_m_s.x * sine];
        let skids_rad = atan2(y, x);
        let [least_rad, most_rad] = [skids_rad.min(0.0) - gripped_rad, skids_rad.max(0.0) + gripped_rad];
        let wanted_rad = atan(2.0 * wheelbase_m * aside / distance_m);
        wanted_rad.clamp(least_rad, most_rad).clamp(-self.most_rad, self.most_rad)
    }
}

/// Angles of the left and right front wheel, rad, for a mean angle: cot δ_out − cot δ_in = A T/L.
pub fn ackermann_rad(mean_rad: f64, share: f64, track_m: f64, wheelbase_m: f64) -> [f64; 2] {
    let slope = tan(mean_rad);
    let half = 0.5 * share * track_m * slope / wheelbase_m;
    // cot δ_left = cot δ + AT/2L: a turn to the right has the left wheel outside
    [slope / (1.0 + half), slope / (1.0 - half)].map(atan)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_hold_their_ends_and_refuse_disorder() {
        let table = Table::new(vec![1.0, 2.0], vec![0.0, 10.0]).unwrap();
        assert_eq!([0.0, 1.5, 3.0].map(|t| table.at(t)), [0.0, 5.0, 10.0]);
        assert_eq!(
            Table::new(vec![1.0, 1.0], vec![0.0, 1.0]),
            Err(TableError::Order { number: 2, time_s: 1.0, before_s: 1.0 })
        );
        assert_eq!(Table::new(vec![], vec![]), Err(TableError::Lengths { times: 0, values: 0 }));
        assert_eq!(Table::new(vec![0.0], vec![f64::NAN]), Err(TableError::NotFinite(1)));
        assert_eq!(Follower::new(vec![[0.0, 0.0], [0.0, 0.0]]), Err(TableError::Line));
    }

    #[test]
    fn ackermanns_wheels_turn_about_one_point() {
        let [left, right] = ackermann_rad(0.2, 1.0, 1.5, 2.7);
        assert!((1.0 / tan(left) - 1.0 / tan(right) - 1.5 / 2.7).abs() < 1e-12 && left < right);
        assert_eq!(ackermann_rad(0.0, 1.0, 1.5, 2.7), [0.0; 2]);
    }

    #[test]
    fn on_the_line_he_steers_straight() {
        let line = Follower::new(vec![[0.0, 0.0], [100.0, 0.0]]).unwrap();
        let wants = |place_m: V3| line.wants_rad(&mut None, place_m, 0.0, V3::x() * 20.0, -1.6, 2.7);
        assert!(wants(V3::new(10.0, 0.0, 0.0)).abs() < 1e-15);
        assert!(wants(V3::new(10.0, -1.0, 0.0)) > 0.0);
    }
}
