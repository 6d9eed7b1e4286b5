//! The motion of a vehicle as a path: the results at the accepted steps, smooth in between.
//!
//! Position by quintic Hermite polynomials through position, velocity and acceleration; attitude by R = R₀ exp(φ) with
//! φ quintic through the rotation from one step to the next and its rates. There are no Euler angles: a car may stand
//! on its nose. Accelerations at the steps are those of the force laws, not differences of positions.

use crate::V3;
use crate::ride::{Ride, Station};
use nalgebra::{Matrix3, UnitQuaternion};

/// Least interval of stations, s: for shorter ones, rounding of positions exceeds the acceleration.
const CLOSE_S: f64 = 2e-4;

/// Pose and motion of a point fixed in a vehicle. Vectors are in vehicle-space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Place, m.
    pub position_m: V3,
    /// Body axes to vehicle-space.
    pub rotation: Matrix3<f64>,
    /// Velocity, m/s.
    pub velocity_m_s: V3,
    /// Acceleration, m/s².
    pub acceleration_m_s2: V3,
    /// Angular velocity, rad/s.
    pub turning_rad_s: V3,
    /// Angular acceleration, rad/s².
    pub turning_rate_rad_s2: V3,
}

/// The motion of a point fixed in a vehicle over a drive.
#[derive(Clone, Debug, PartialEq)]
pub struct DrivenPath {
    stations: Vec<Place>,
    /// From each station to the next.
    spans: Vec<Span>,
}

/// A point of the vehicle at a station; rates of turning in body axes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    time_s: f64,
    attitude: UnitQuaternion<f64>,
    place: [V3; 3],
    turning: [V3; 2],
}

/// Quintics between two stations, over the share of the time.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Span {
    place: Quintic,
    turn: Quintic,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Quintic([V3; 6]);

impl DrivenPath {
    /// Path of the point at `point_m` in the body axes of a ride, from its centre of gravity.
    pub fn of(ride: &Ride, point_m: V3) -> Self {
        let all = ride.stations();
        let mut kept: Vec<&Station> = Vec::with_capacity(all.len());
        for (i, station) in all.iter().enumerate() {
            let is_last = i + 1 == all.len();
            if kept.last().is_some_and(|before| station.time_s - before.time_s < CLOSE_S) {
                if !is_last {
                    continue;
                }
                if kept.len() > 1 {
                    kept.pop();
                }
            }
            kept.push(station);
        }
        let stations: Vec<Place> = kept.into_iter().map(|station| Place::of(station, &point_m)).collect();
        let spans = stations.windows(2).map(|pair| Span::between(&pair[0], &pair[1])).collect();
        DrivenPath { stations, spans }
    }

    /// First and last time, s.
    pub fn span_s(&self) -> [f64; 2] {
        [self.stations[0].time_s, self.stations[self.stations.len() - 1].time_s]
    }

    /// Times of the stations, s, rising.
    pub fn times_s(&self) -> impl Iterator<Item = f64> + '_ {
        self.stations.iter().map(|station| station.time_s)
    }

    /// The motion at a time; that at the ends for times outside.
    pub fn at(&self, time_s: f64) -> Motion {
        let next = self.stations.partition_point(|station| station.time_s <= time_s);
        let from = &self.stations[next.saturating_sub(1)];
        match self.spans.get(next.wrapping_sub(1)) {
            Some(span) if time_s > from.time_s => {
                let h = self.stations[next].time_s - from.time_s;
                span.at(from, (time_s - from.time_s) / h, h)
            }
            _ => from.motion(),
        }
    }
}

impl Place {
    fn of(station: &Station, point_m: &V3) -> Self {
        let Station { rotation_rad_s: turning, turning_rad_s2: rate, attitude, .. } = station;
        let swings = turning.cross(&turning.cross(point_m));
        Place {
            time_s: station.time_s,
            attitude: *attitude,
            place: [
                station.position_m + attitude * point_m,
                station.velocity_m_s + attitude * turning.cross(point_m),
                station.acceleration_m_s2 + attitude * (rate.cross(point_m) + swings),
            ],
            turning: [*turning, *rate],
        }
    }

    fn motion(&self) -> Motion {
        let rotation = *self.attitude.to_rotation_matrix().matrix();
        let ([position_m, velocity_m_s, acceleration_m_s2], [turning, rate]) = (self.place, self.turning);
        Motion {
            position_m,
            rotation,
            velocity_m_s,
            acceleration_m_s2,
            turning_rad_s: rotation * turning,
            turning_rate_rad_s2: rotation * rate,
        }
    }
}

impl Span {
    fn between(from: &Place, to: &Place) -> Self {
        let h = to.time_s - from.time_s;
        let [turning, rate] = to.turning;
        let turn = turn(&from.attitude, &to.attitude);
        // Ω = J φ̇ and Ω̇ = J φ̈ + J̇ φ̇, J = 1 at the beginning
        let series = Series::of(turn.norm_squared());
        let back = series.right_jacobian(&turn).try_inverse().unwrap_or_else(Matrix3::identity);
        let speed = back * turning;
        let end = [turn, speed, back * (rate - series.jacobian_rate(&turn, &speed))];
        let begin = [V3::zeros(), from.turning[0], from.turning[1]];
        Span { place: Quintic::through(from.place, to.place, h), turn: Quintic::through(begin, end, h) }
    }

    fn at(&self, from: &Place, share: f64, h: f64) -> Motion {
        let [position_m, velocity_m_s, acceleration_m_s2] = self.place.at(share, h);
        let [turn, speed, rate] = self.turn.at(share, h);
        let series = Series::of(turn.norm_squared());
        let rotation = from.attitude.to_rotation_matrix().matrix() * series.exp(&turn);
        let jacobian = series.right_jacobian(&turn);
        Motion {
            position_m,
            rotation,
            velocity_m_s,
            acceleration_m_s2,
            turning_rad_s: rotation * (jacobian * speed),
            turning_rate_rad_s2: rotation * (jacobian * rate + series.jacobian_rate(&turn, &speed)),
        }
    }
}

impl Quintic {
    /// Through value, rate and second rate at both ends of `h` s.
    fn through([p0, v0, a0]: [V3; 3], [p1, v1, a1]: [V3; 3], h: f64) -> Self {
        let (v0, v1, a0, a1) = (v0 * h, v1 * h, a0 * (h * h), a1 * (h * h));
        let (way, speed, rate) = (p1 - p0 - v0 - a0 * 0.5, v1 - v0 - a0, a1 - a0);
        Quintic([
            p0,
            v0,
            a0 * 0.5,
            way * 10.0 - speed * 4.0 + rate * 0.5,
            speed * 7.0 - way * 15.0 - rate,
            way * 6.0 - speed * 3.0 + rate * 0.5,
        ])
    }

    /// Value, rate and second rate at a share of `h` s.
    fn at(&self, s: f64, h: f64) -> [V3; 3] {
        let [a, b, c, d, e, f] = self.0;
        [
            a + (b + (c + (d + (e + f * s) * s) * s) * s) * s,
            (b + (c * 2.0 + (d * 3.0 + (e * 4.0 + f * (5.0 * s)) * s) * s) * s) / h,
            (c * 2.0 + (d * 6.0 + (e * 12.0 + f * (20.0 * s)) * s) * s) / (h * h),
        ]
    }
}

/// Rotation vector from one attitude to another, rad.
fn turn(from: &UnitQuaternion<f64>, to: &UnitQuaternion<f64>) -> V3 {
    let between = (from.inverse() * to).into_inner();
    let between = if between.w < 0.0 { -between } else { between };
    let sine = between.imag().norm();
    let factor = if sine > 0.0 { 2.0 * libm::atan2(sine, between.w) / sine } else { 2.0 };
    between.imag() * factor
}

/// sin θ/θ, A = (1 − cos θ)/θ², B = (θ − sin θ)/θ³, and A′/θ, B′/θ, all power series in θ²: no angle is small.
struct Series {
    sine: f64,
    a: f64,
    b: f64,
    a_rate: f64,
    b_rate: f64,
}

impl Series {
    fn of(square: f64) -> Self {
        let mut of = Series { sine: 0.0, a: 0.0, b: 0.0, a_rate: 0.0, b_rate: 0.0 };
        // (−x)ᵏ/(2k + 1)!; between two steps θ < 1, at π the last term is 1e-15
        let mut term = 1.0;
        for k in 0..14 {
            let two = 2.0 * f64::from(k);
            let (a, b) = (term / (two + 2.0), term / ((two + 2.0) * (two + 3.0)));
            of.sine += term;
            of.a += a;
            of.b += b;
            // d/dθ of θ²ᵏ over θ is 2k θ²ᵏ⁻²
            let next = -term / ((two + 2.0) * (two + 3.0));
            of.a_rate += (two + 2.0) * next / (two + 4.0);
            of.b_rate += (two + 2.0) * next / ((two + 4.0) * (two + 5.0));
            term = next * square;
        }
        of
    }

    /// exp φ
    fn exp(&self, turn: &V3) -> Matrix3<f64> {
        let cross = turn.cross_matrix();
        Matrix3::identity() + cross * self.sine + cross * cross * self.a
    }

    /// J = 1 − A[φ]× + B[φ]×²
    fn right_jacobian(&self, turn: &V3) -> Matrix3<f64> {
        let cross = turn.cross_matrix();
        Matrix3::identity() - cross * self.a + cross * cross * self.b
    }

    /// J̇ φ̇
    fn jacobian_rate(&self, turn: &V3, speed: &V3) -> V3 {
        let (along, across) = (turn.dot(speed), turn.cross(speed));
        // φ̇×φ̇ = 0
        across * (-self.a_rate * along) + turn.cross(&across) * (self.b_rate * along) + speed.cross(&across) * self.b
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::car::{Car, Class};
    use crate::driver::{Driver, Steering, Table};
    use crate::ground::Ground;
    use crate::run::{Drive, Start};

    fn into_the_ditch() -> Ride {
        let ground = Ground::section(vec![[-50.0, 0.0], [3.0, 0.0], [12.0, -3.0], [24.0, 0.0], [80.0, 0.0]], 0.0);
        let steering = Table::new(vec![0.0, 0.5, 1.0], vec![0.0, 0.05, -0.1]).unwrap();
        let driver = Driver { steering: Steering::Table(steering), ..Driver::coasting() };
        let drive = Drive::new(&Car::of_class(Class::Sedan), ground.unwrap(), driver).unwrap();
        drive.run(&Start { speed_m_s: 25.0, yaw_rad: 0.26, ..Start::default() }, 3.0).unwrap()
    }

    /// At the stations the path is what was computed, from before and from behind.
    #[test]
    fn it_meets_place_velocity_and_acceleration_at_the_steps() {
        let ride = into_the_ditch();
        let path = DrivenPath::of(&ride, V3::zeros());
        for pair in path.stations.windows(2) {
            let [from, to] = [&pair[0], &pair[1]];
            let h = to.time_s - from.time_s;
            let (end, expected) = (Span::between(from, to).at(from, 1.0, h), to.motion());
            assert_eq!(path.at(to.time_s), expected);
            let gap = |a: V3, b: V3| (a - b).norm() / (1.0 + b.norm());
            // measured 2e-14, 7e-16, 7e-16; the second derivatives carry the last digit of a place over h²
            assert!(
                (end.rotation - expected.rotation).norm() < 1e-12 && gap(end.position_m, expected.position_m) < 1e-12
            );
            assert!(gap(end.velocity_m_s, expected.velocity_m_s) < 1e-12 * (1.0 + 1e-2 / h), "{h}");
            assert!(gap(end.turning_rad_s, expected.turning_rad_s) < 1e-12, "{h}");
            let rounding = 60.0 * f64::EPSILON * (1.0 + to.place[0].norm()) / (h * h);
            assert!(gap(end.acceleration_m_s2, expected.acceleration_m_s2) < 1e-12 + rounding, "{h}");
            assert!(gap(end.turning_rate_rad_s2, expected.turning_rate_rad_s2) < 1e-9, "{h}");
        }
    }

    /// Rates are those of the places and attitudes in between, for a point off the centre of gravity, too.
    #[test]
    fn rates_are_derivatives() {
        let path = DrivenPath::of(&into_the_ditch(), V3::new(0.3, -0.4, -0.2));
        let e = 1e-5;
        for i in 1..290 {
            let t = 0.01 * f64::from(i) + 0.0013;
            let [before, at, after] = [path.at(t - e), path.at(t), path.at(t + e)];
            let velocity = (after.position_m - before.position_m) / (2.0 * e);
            let acceleration = (after.velocity_m_s - before.velocity_m_s) / (2.0 * e);
            let turned = (after.rotation - before.rotation) * at.rotation.transpose() / (2.0 * e);
            let turning = V3::new(turned[(2, 1)], turned[(0, 2)], turned[(1, 0)]);
            let rate = (after.turning_rad_s - before.turning_rad_s) / (2.0 * e);
            assert!((velocity - at.velocity_m_s).norm() < 1e-5, "{t}");
            assert!((acceleration - at.acceleration_m_s2).norm() < 0.1, "{t} {acceleration} {}", at.acceleration_m_s2);
            assert!((turning - at.turning_rad_s).norm() < 1e-5, "{t}");
            assert!((rate - at.turning_rate_rad_s2).norm() < 0.1, "{t} {rate} {}", at.turning_rate_rad_s2);
        }
    }

    /// Turns of any size: exp and its rates against quaternions.
    #[test]
    fn the_series_hold_up_to_half_a_turn() {
        for turn in [V3::new(1e-9, 0.0, 0.0), V3::new(0.3, -0.2, 0.1), V3::new(1.5, -2.0, 1.0)] {
            let series = Series::of(turn.norm_squared());
            let expected = UnitQuaternion::from_scaled_axis(turn).to_rotation_matrix();
            assert!((series.exp(&turn) - expected.matrix()).norm() < 1e-13);
            let (speed, e) = (V3::new(0.7, 0.4, -1.1), 1e-6);
            let of = |t: V3| Series::of(t.norm_squared()).right_jacobian(&t) * speed;
            let found = (of(turn + speed * e) - of(turn - speed * e)) / (2.0 * e);
            assert!((found - series.jacobian_rate(&turn, &speed)).norm() < 1e-8);
        }
    }
}
