//! A vehicle as data: masses, axles, tyres, brakes. Classes and the rules by which their numbers follow.

use crate::body::{Body, Crush, Stiffness};
use crate::tyre::Tyre;
use crate::{GRAVITY_M_S2, V3, WHEELS};
use nalgebra::Matrix3;

/// A vehicle with four wheels.
#[derive(Clone, Debug, PartialEq)]
pub struct Car {
    /// Mass with load and wheels, kg.
    pub mass_kg: f64,
    /// Inertia about the centre of gravity, body axes, kg·m².
    pub inertia_kg_m2: Matrix3<f64>,
    /// Height of the centre of gravity over the road at rest, m.
    pub height_m: f64,
    /// Front axle.
    pub front: Axle,
    /// Rear axle.
    pub rear: Axle,
    /// Tyres.
    pub tyre: Tyre,
    /// ½ρ C_d A, N·s²/m².
    pub drag_n_s2_per_m2: f64,
    /// Shares of the brake torque by wheel; they sum to 1.
    pub brake_share: [f64; WHEELS],
    /// Shares of the drive torque by wheel; they sum to 1.
    pub drive_share: [f64; WHEELS],
    /// Share of Ackermann's difference between the angles of the front wheels.
    pub ackermann: f64,
    /// Outline, crush and hull.
    pub body: Body,
    /// People whose weight its springs and tyres carry at rest, but whose mass is not in `mass_kg`: they push the vehicle by
    /// a [`Wrench`](crate::world::Wrench).
    pub riders: Option<Riders>,
}

/// People who push their vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Riders {
    /// Mass of all of them, kg.
    pub mass_kg: f64,
    /// Their centre of gravity at rest from that of the vehicle, body axes, m.
    pub place_m: V3,
}

/// Two wheels on slides, mirrored about the middle plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axle {
    /// Position forward of the centre of gravity, m; negative behind.
    pub ahead_m: f64,
    /// Track width, m.
    pub track_m: f64,
    /// Mass that moves with each wheel, kg.
    pub wheel_kg: f64,
    /// Inertia of each wheel about its axle, kg·m².
    pub spin_kg_m2: f64,
    /// Rate at the wheel, N/m.
    pub rate_n_per_m: f64,
    /// Damping in jounce at the wheel, N·s/m.
    pub jounce_n_s_per_m: f64,
    /// Damping in rebound at the wheel, N·s/m.
    pub rebound_n_s_per_m: f64,
    /// Force per difference of the two wheels' jounce, N/m.
    pub anti_roll_n_per_m: f64,
    /// Height of the roll centre over the road, m.
    pub roll_centre_m: f64,
    /// Forward displacement of a wheel per metre of jounce: positive is anti-dive in front, negative anti-lift at the
    /// rear.
    pub anti_pitch: f64,
    /// Jounce at which the stop begins, m.
    pub jounce_stop_m: f64,
    /// Rebound at which the stop begins, m.
    pub rebound_stop_m: f64,
    /// Stiffness of the stops, N/m; it doubles over the first 0.1 m.
    pub stop_n_per_m: f64,
    /// Toe-in per metre of jounce, rad/m; mirrored.
    pub bump_steer_rad_per_m: f64,
    /// Camber per metre of jounce, rad/m: positive leans the tops inward; mirrored.
    pub bump_camber_rad_per_m: f64,
    /// Whether the wheels are steered.
    pub is_steered: bool,
}

/// Vehicle classes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// 1100 kg, as MASH's 1100C.
    Small,
    /// 1500 kg.
    Sedan,
    /// 2000 kg.
    Suv,
    /// 2150 kg.
    Van,
    /// 2270 kg, as MASH's 2270P.
    Pickup,
    /// 900 kg of EN 1317.
    En900,
    /// 1500 kg of EN 1317.
    En1500,
    /// BMW 320i of the 1980s.
    Bmw320i,
    /// VW Vanagon of the 1980s.
    Vanagon,
}

impl Class {
    /// All classes, in the order of their presets.
    pub const ALL: [Class; 9] = [
        Class::Small,
        Class::Sedan,
        Class::Suv,
        Class::Van,
        Class::Pickup,
        Class::En900,
        Class::En1500,
        Class::Bmw320i,
        Class::Vanagon,
    ];
}

/// Rules for springs, dampers and anti-roll bars of vehicles without their own values: front and rear.
pub(crate) struct Ride {
    /// Undamped natural frequencies of the body on its springs, Hz.
    pub hz: [f64; 2],
    /// Roll per g of lateral acceleration.
    pub roll_rad_per_g: f64,
    /// Shares of it that the axles resist.
    pub roll_shares: [f64; 2],
    /// Heights of the roll centres, m.
    pub roll_centres_m: [f64; 2],
    /// Mass of a wheel.
    pub wheel_kg: f64,
}

pub(crate) const RIDE: Ride = Ride {
    hz: [1.25, 1.4],
    roll_rad_per_g: 0.0873,
    roll_shares: [0.6, 0.4],
    roll_centres_m: [0.05, 0.10],
    wheel_kg: 40.0,
};

impl Axle {
    /// Values common to all presets; the rest is 0.
    pub(crate) fn usual() -> Self {
        Axle {
            ahead_m: 0.0,
            track_m: 0.0,
            wheel_kg: 0.0,
            spin_kg_m2: 1.0,
            rate_n_per_m: 0.0,
            jounce_n_s_per_m: 0.0,
            rebound_n_s_per_m: 0.0,
            anti_roll_n_per_m: 0.0,
            roll_centre_m: 0.0,
            anti_pitch: 0.0,
            jounce_stop_m: 0.08,
            rebound_stop_m: 0.09,
            stop_n_per_m: 2e5,
            bump_steer_rad_per_m: 0.0,
            bump_camber_rad_per_m: 0.0,
            is_steered: false,
        }
    }
}

impl Car {
    /// A vehicle of a class.
    pub fn of_class(class: Class) -> Self {
        class.preset().car()
    }

    /// Values common to all presets; the rest is 0 or empty.
    pub(crate) fn usual() -> Self {
        let none = Stiffness { a_n_per_m: 0.0, b_n_per_m2: 0.0 };
        Car {
            mass_kg: 0.0,
            inertia_kg_m2: Matrix3::zeros(),
            height_m: 0.0,
            front: Axle::usual(),
            rear: Axle::usual(),
            tyre: Tyre::usual(),
            drag_n_s2_per_m2: 0.4,
            brake_share: [0.35, 0.35, 0.15, 0.15],
            drive_share: [0.5, 0.5, 0.0, 0.0],
            ackermann: 1.0,
            body: Body::sized([0.0; 3], 0.0, Crush::of_faces(none, none, none)),
            riders: None,
        }
    }

    /// Axle of a wheel.
    pub fn axle(&self, wheel: usize) -> &Axle {
        if wheel < 2 { &self.front } else { &self.rear }
    }

    /// Wheelbase, m.
    pub fn wheelbase_m(&self) -> f64 {
        self.front.ahead_m - self.rear.ahead_m
    }

    /// Static stability factor T/2h, with the mean track.
    pub fn stability(&self) -> f64 {
        0.25 * (self.front.track_m + self.rear.track_m) / self.height_m
    }

    /// Static wheel loads of each axle on level ground, without riders, N: front, rear.
    pub fn static_loads_n(&self) -> [f64; 2] {
        let weight = 0.5 * self.mass_kg * GRAVITY_M_S2 / self.wheelbase_m();
        [-self.rear.ahead_m * weight, self.front.ahead_m * weight]
    }

    /// Static load of each wheel on level ground with riders, N: springs level a vehicle whose riders sit to one side.
    pub fn wheel_loads_n(&self) -> [f64; WHEELS] {
        let own = self.static_loads_n();
        let mut loads = [own[0], own[0], own[1], own[1]];
        let Some(riders) = &self.riders else { return loads };
        let weight = riders.mass_kg * GRAVITY_M_S2;
        let behind = (self.front.ahead_m - riders.place_m.x) / self.wheelbase_m();
        for (i, load) in loads.iter_mut().enumerate() {
            let share = if i < 2 { 1.0 - behind } else { behind };
            let side = if i.is_multiple_of(2) { -1.0 } else { 1.0 };
            *load += weight * share * (0.5 + side * riders.place_m.y / self.axle(i).track_m);
        }
        loads
    }

    /// The vehicle with a further load at a position in body axes, relative to the present centre of gravity, and the
    /// shift of the centre of gravity, m. Heights and axles are then relative to the new one.
    pub fn with_load(&self, mass_kg: f64, place_m: V3) -> (Self, V3) {
        let all_kg = self.mass_kg + mass_kg;
        let shift_m = place_m * (mass_kg / all_kg);
        let reduced_kg = self.mass_kg * mass_kg / all_kg;
        let steiner = (Matrix3::identity() * place_m.norm_squared() - place_m * place_m.transpose()) * reduced_kg;
        let mut loaded = self.clone();
        loaded.mass_kg = all_kg;
        loaded.inertia_kg_m2 += steiner;
        loaded.height_m -= shift_m.z;
        loaded.body.shift(shift_m.x, shift_m.y);
        for axle in [&mut loaded.front, &mut loaded.rear] {
            axle.ahead_m -= shift_m.x;
        }
        if let Some(riders) = &mut loaded.riders {
            riders.place_m -= shift_m;
        }
        (loaded, shift_m)
    }

    /// Checks the vehicle.
    ///
    /// # Errors
    /// The first number that no car can have.
    pub fn check(&self) -> Result<(), CarError> {
        let Car { tyre, .. } = self;
        let mut positive = vec![
            ("mass", self.mass_kg),
            ("height of the centre of gravity", self.height_m),
            ("tyre radius", tyre.radius_m),
            ("tyre stiffness", tyre.stiffness_n_per_m),
            ("relaxation length", tyre.relaxation_m),
            ("cornering stiffness", tyre.cornering_per_rad),
            ("slip stiffness", tyre.slip_stiffness),
            ("reference load", tyre.reference_load_n),
            ("load of the largest cornering stiffness", tyre.greatest_at),
            ("sliding speed", tyre.sliding_speed_m_s),
        ];
        for axle in [&self.front, &self.rear] {
            positive.extend([
                ("track width", axle.track_m),
                ("wheel mass", axle.wheel_kg),
                ("wheel inertia", axle.spin_kg_m2),
                ("spring rate", axle.rate_n_per_m),
                ("stiffness of the stops", axle.stop_n_per_m),
            ]);
        }
        if let Some(&(what, value)) = positive.iter().find(|(_, value)| !(*value > 0.0 && value.is_finite())) {
            return Err(CarError::NotPositive { what, value });
        }
        let at_least_zero = [
            ("friction", tyre.friction),
            ("tyre damping", tyre.damping_n_s_per_m),
            ("rolling resistance", tyre.rolling),
            ("ratio of sliding friction", tyre.sliding_share),
            ("drag", self.drag_n_s2_per_m2),
            ("crown radius", tyre.crown_m),
            ("front damping", self.front.jounce_n_s_per_m.min(self.front.rebound_n_s_per_m)),
            ("rear damping", self.rear.jounce_n_s_per_m.min(self.rear.rebound_n_s_per_m)),
            ("anti-roll rate", self.front.anti_roll_n_per_m.min(self.rear.anti_roll_n_per_m)),
        ];
        if let Some(&(what, value)) = at_least_zero.iter().find(|(_, value)| !(*value >= 0.0 && value.is_finite())) {
            return Err(CarError::Negative { what, value });
        }
        if tyre.crown_m >= tyre.radius_m {
            return Err(CarError::Crown { crown_m: tyre.crown_m, radius_m: tyre.radius_m });
        }
        if !(self.front.ahead_m > 0.0 && self.rear.ahead_m < 0.0) {
            return Err(CarError::Axles { front_m: self.front.ahead_m, rear_m: self.rear.ahead_m });
        }
        if let Some(riders) = &self.riders {
            let lightest_n = self.wheel_loads_n().into_iter().fold(f64::INFINITY, f64::min);
            let least = lightest_n.min(riders.mass_kg);
            if !(least >= 0.0 && least.is_finite() && riders.place_m.sum().is_finite()) {
                return Err(CarError::Riders { mass_kg: riders.mass_kg, lightest_n });
            }
        }
        let moments = self.inertia_kg_m2.symmetric_eigenvalues();
        let [x, y, z] = [moments.x, moments.y, moments.z];
        let is_inertia = x > 0.0 && y > 0.0 && z > 0.0 && x + y >= z && y + z >= x && z + x >= y;
        if !(is_inertia && (self.inertia_kg_m2 - self.inertia_kg_m2.transpose()).norm() < 1e-9 * x.max(y).max(z)) {
            return Err(CarError::Inertia);
        }
        for (what, shares) in [("brake", self.brake_share), ("drive", self.drive_share)] {
            let sum: f64 = shares.iter().sum();
            if shares.iter().any(|share| *share < 0.0) || (sum - 1.0).abs() > 1e-6 {
                return Err(CarError::Shares { what, sum });
            }
        }
        Ok(())
    }
}

/// Problems of a vehicle.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CarError {
    /// A number that must be above zero.
    #[error("the {what} is {value}; expected a number above 0")]
    NotPositive {
        /// Of what.
        what: &'static str,
        /// The number, SI.
        value: f64,
    },
    /// A number that must not be below zero.
    #[error("the {what} is {value}; expected a number of at least 0")]
    Negative {
        /// Of what.
        what: &'static str,
        /// The number, SI.
        value: f64,
    },
    /// A crown as large as the tyre.
    #[error("the crown radius of {crown_m} m must be below the tyre's radius of {radius_m} m")]
    Crown {
        /// Crown radius, m.
        crown_m: f64,
        /// Tyre radius, m.
        radius_m: f64,
    },
    /// Axles not on both sides of the centre of gravity.
    #[error(
        "the axles are {front_m} m and {rear_m} m ahead of the centre of gravity; expected the front axle ahead, the rear axle behind"
    )]
    Axles {
        /// Front, m.
        front_m: f64,
        /// Rear, m.
        rear_m: f64,
    },
    /// Riders who would tip the vehicle.
    #[error(
        "riders of {mass_kg} kg leave a wheel a load of {lightest_n} N at rest; expected at least 0 on every wheel"
    )]
    Riders {
        /// Their mass, kg.
        mass_kg: f64,
        /// Load of the lightest wheel, N.
        lightest_n: f64,
    },
    /// Impossible moments of inertia.
    #[error("the inertia is impossible: it must be symmetric, with positive moments, none above the sum of the others")]
    Inertia,
    /// No mass or inertia left for the body without its wheels.
    #[error("the wheels have all of the vehicle's mass or inertia")]
    Wheels,
    /// Shares that do not sum to 1.
    #[error("the {what} shares sum to {sum}; expected four shares of at least 0 that sum to 1")]
    Shares {
        /// Brake or drive.
        what: &'static str,
        /// Their sum.
        sum: f64,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_class_is_a_sound_car_that_rolls_five_degrees_per_g() {
        for class in Class::ALL {
            if matches!(class, Class::Bmw320i | Class::Vanagon) {
                Car::of_class(class).check().unwrap();
                continue;
            }
            let car = Car::of_class(class);
            car.check().unwrap();
            let stiffness =
                |axle: &Axle| (0.5 * axle.rate_n_per_m + axle.anti_roll_n_per_m) * axle.track_m * axle.track_m;
            let roll =
                car.mass_kg * GRAVITY_M_S2 * (car.height_m - 0.075) / (stiffness(&car.front) + stiffness(&car.rear));
            // stiff springs of the tall ones resist more than asked
            assert!((3.0..5.1).contains(&roll.to_degrees()), "{class:?}: {}", roll.to_degrees());
        }
    }

    #[test]
    fn mistakes_are_named() {
        let sedan = Car::of_class(Class::Sedan);
        let mut car = sedan.clone();
        car.rear.ahead_m = 0.5;
        assert_eq!(car.check(), Err(CarError::Axles { front_m: 1.1, rear_m: 0.5 }));
        let mut car = sedan.clone();
        car.inertia_kg_m2[(0, 0)] = 9000.0;
        assert_eq!(car.check(), Err(CarError::Inertia));
        let mut car = sedan.clone();
        car.mass_kg = f64::NAN;
        assert!(matches!(car.check(), Err(CarError::NotPositive { what: "mass", .. })));
        let mut car = sedan;
        car.brake_share = [0.5, 0.5, 0.5, 0.5];
        assert_eq!(car.check(), Err(CarError::Shares { what: "brake", sum: 2.0 }));
    }

    #[test]
    fn a_load_moves_the_centre_of_gravity() {
        let car = Car::of_class(Class::Sedan);
        let (loaded, shift_m) = car.with_load(300.0, V3::new(-0.3, 0.0, -0.1));
        assert!((shift_m.x + 0.05).abs() < 1e-12 && (loaded.front.ahead_m - 1.15).abs() < 1e-12);
        assert!((loaded.wheelbase_m() - car.wheelbase_m()).abs() < 1e-12);
        assert!((loaded.height_m - car.height_m - 0.1 / 6.0).abs() < 1e-12);
        loaded.check().unwrap();
    }
}
